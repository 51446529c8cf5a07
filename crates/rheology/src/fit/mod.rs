//! Materials from measurements: master curves and Prony series.

mod bridge;
mod covariance;
mod creep;
mod curve;
mod expand;
mod identify;
mod master_curve;
mod nnls;
mod overlap;
mod refine;
mod sign_changes;
mod superposition;
mod system;

pub use covariance::ModuliCovariance;
pub use creep::{CreepPoint, relaxation_of_creep};
pub use curve::{MeasuredCurve, ModulusPoint, RelaxationPoint};
pub use expand::expand;
pub use identify::{
    Control, Identification, IdentifyOptions, LongTimeLimit, RelativeError, identify,
};
pub use master_curve::{
    Isotherm, IsothermShift, MasterCurve, automatic_master_curve, shifted_master_curve,
};
pub use sign_changes::SignChanges;
pub use superposition::{SuperpositionOptions, VerticalChoice, VerticalShift};
