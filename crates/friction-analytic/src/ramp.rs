//! A power profile pressed into a viscoelastic half space at a constant rate (Lee & Radok 1960, J. Appl. Mech. 27, 438).
//!
//! While a contact grows, the force is the elastic one with a history integral. At the depth d = V t and with q = 1 + 1/p,
//!
//! ```text
//! F(t) = 8/(2 (1 − ν)) p/(p + 1) d a [G_∞ + q η/t + Σ G_i M(t/τ_i)],    a = (d/(κ c))^(1/p)
//! M(y) = q ∫₀^1 e^(−y (1 − u)) u^(q−1) du = ₁F₁(1; q + 1; −y)
//! ```

use indenters::PowerProfile;
use numerics::{NEGLIGIBLE_EXPONENT, positive};
use rheology::{Material, check_spectra};

use crate::FrictionError;
use crate::error::representable;
use crate::pieces::{accept_accurate, integrate_pieces};

/// End of a ramp: a depth that has grown at a constant rate since first touch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DepthRamp {
    /// Indentation depth d at the end, \[m].
    pub indentation_depth: f64,
    /// Time t since first touch, \[s].
    pub time: f64,
}

/// Normal force of a power profile at the end of a ramp of the depth, \[N], on half space and one-dimensional model alike.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for a depth or time that is not positive; [`FrictionError::OutOfRange`] when the
/// force overflows or underflows; [`FrictionError::NotConverged`] when M is known to less than ten digits.
pub fn ramp_force(
    profile: &PowerProfile,
    material: &dyn Material,
    ramp: DepthRamp,
) -> Result<f64, FrictionError> {
    check_spectra(material)?;
    let depth = positive("indentation_depth", ramp.indentation_depth)?;
    let time = positive("time", ramp.time)?;
    let p = profile.exponent();
    let relaxation = material.relaxation();
    let power = 1.0 + p.recip();
    // `modulus` is the bracket in F(t): the spring, the dashpot, and then one term for each branch.
    let mut modulus = relaxation.equilibrium_modulus() + power * relaxation.viscosity() / time;
    for branch in relaxation.branches() {
        let rate = time / branch.relaxation_time;
        // M is integrated over 1 − u, the time before the end of the ramp as a fraction of the duration.
        let integrand = |before: f64| (-rate * before).exp() * (1.0 - before).powf(power - 1.0);
        let integral = integrate_pieces(integrand, &[0.0, (NEGLIGIBLE_EXPONENT / rate).min(1.0)]);
        modulus += branch.modulus * power * accept_accurate("memory of a ramp", integral)?.value;
    }
    let depth_times_radius = depth * profile.line_position(depth);
    let force = 8.0 / material.half_space_factor() * modulus * (depth_times_radius / power);
    representable("normal force", force)
}
