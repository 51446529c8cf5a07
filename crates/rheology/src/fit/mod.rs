//! Materials from measurements: master curves, and the Prony series behind them.

mod covariance;
mod creep;
mod curve;
mod expand;
mod identify;
mod master_curve;
mod nnls;
mod refine;
mod system;

pub use covariance::ModuliCovariance;
pub use creep::{CreepPoint, relaxation_of_creep};
pub use curve::{MeasuredCurve, ModulusPoint, RelaxationPoint};
pub use expand::expand;
pub use identify::{Control, Ending, Identification, IdentifyOptions, RelativeError, identify};
pub use master_curve::{Isotherm, MasterCurve, automatic_master_curve, shifted_master_curve};
