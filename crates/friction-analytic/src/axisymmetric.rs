//! Stationary sliding of any body of revolution, by quadrature.
//!
//! ```text
//! h̃(x_d) = d        μ = (1/d) ∫₀^x_d h̃'(x)² dx        (16)
//! ```

use indenters::{Axisymmetric, IndenterError, SlidingLoad, contact_radius};
use rheology::Viscous;

use crate::slope_energy::{divergence_cause, slope_energy};
use crate::stationary::checked_depth;
use crate::{FrictionError, StationarySliding};

/// Stationary depth, contact line and coefficient of friction of a body of revolution, from (12) and (16).
///
/// # Errors
/// [`FrictionError::FrictionDiverges`] with its cause; [`FrictionError::NoStationaryState`] when the body is not high
/// enough; [`FrictionError::Indenter`] when its line turns downwards inside the contact;
/// [`FrictionError::NotConverged`] when the integral is known to less than ten digits.
pub fn axisymmetric_sliding(
    body: &(impl Axisymmetric + ?Sized),
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<StationarySliding, FrictionError> {
    let depth = checked_depth(material, load)?;
    let radius = contact_radius(body, depth).map_err(no_stationary_state)?;
    if let Some(cause) = divergence_cause(body, radius, depth) {
        return Err(FrictionError::FrictionDiverges {
            cause,
            indentation_depth: depth,
            contact_length: radius,
        });
    }
    let energy = slope_energy(body, radius)?;
    // The contact radius is rounded too, and moves the end of the integral.
    let end = body.line_slope(radius).powi(2) * radius;
    Ok(StationarySliding {
        indentation_depth: depth,
        contact_line: vec![[0.0, radius]],
        friction_coefficient: energy.value / depth,
        error: (energy.error + 4.0 * f64::EPSILON * (energy.value + end)) / depth,
    })
}

/// Remark 4: a line that ends below the stationary depth has no stationary state.
pub(crate) fn no_stationary_state(error: IndenterError) -> FrictionError {
    match error {
        IndenterError::NotHighEnough { available, depth } => FrictionError::NoStationaryState {
            needed_depth: depth,
            available_depth: available,
        },
        other => other.into(),
    }
}
