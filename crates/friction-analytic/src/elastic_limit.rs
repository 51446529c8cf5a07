//! Friction of a solid at very low and very high speed, where the contact is nearly elastic.
//!
//! ```text
//! F_N = 8 G ∫₀^a x h̃' dx,   G = G_∞ (slow) or G(0+) (fast)
//! slow:  F_h = 8 η_0 v ∫₀^a h̃'² dx on the line, exactly half of it on the half space,   η_0 = ∫₀^∞ (G(t) − G_∞) dt
//! fast:  F_h = (8 α/v) ∫₀^a (d − h̃)² dx on both,                                        α = −dG/dt(0+)
//! ```
//! h̃ is the height of the equivalent line, a the contact radius, d = h̃(a) the depth, and v the speed. The moduli and
//! viscosities of the material are divided by 2 (1 − ν).
//!
//! Slow, on the half space: inside the contact the pressure is the elastic one, shifted by x_s = η_0 v/G_∞, so that
//! F_h = (x_s/2) ∫ p ∇²h dA, and ∫ p ∇²h dA = 8 G ∫₀^a h̃'² dx. Fast: F_h = 2 (α/G) W/v with the elastic energy W, which
//! is the same in both models.

use indenters::{Axisymmetric, contact_radius};
use numerics::positive;
use rheology::{Material, check_spectra};

use crate::FrictionError;
use crate::axisymmetric::{refuse_divergence, squared_slope_integral};
use crate::error::representable;
use crate::indentation::checked_moment;
use crate::pieces::{accept_accurate, ends_outside_apex, integrate_pieces};

/// Size and speed of a contact that slides over a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ElasticContact {
    /// Radius a of the contact circle, \[m]; half the contact length on the line.
    pub contact_radius: f64,
    /// Sliding speed v, \[m/s].
    pub velocity: f64,
}

/// Leading term of the friction in the limit of low or of high speed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct ElasticLimitFriction {
    /// Normal force of the elastic contact, \[N].
    pub normal_force: f64,
    /// Friction coefficient of the one-dimensional model.
    pub line: f64,
    /// Friction coefficient of the half space.
    pub half_space: f64,
}

/// Friction at low speed, v τ ≪ a: proportional to the speed, and on the half space exactly half of that on the line.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] or [`FrictionError::Indenter`] for a speed or a radius that is not positive, a radius
/// that the body does not reach, or a fluid;
/// [`FrictionError::FrictionDiverges`] where ∫ h̃'² dx does; [`FrictionError::NotConverged`] when an integral is known to
/// less than ten digits.
pub fn low_speed_friction(
    body: &dyn Axisymmetric,
    solid: &dyn Material,
    contact: ElasticContact,
) -> Result<ElasticLimitFriction, FrictionError> {
    check_spectra(solid)?;
    let depth = checked_depth(body, contact)?;
    let radius = contact.contact_radius;
    refuse_divergence(body, -radius, radius, depth)?;
    // The force is 8 G times this moment.
    let moment = checked_moment(body, radius)?;
    let relaxation = solid.relaxation();
    // A fluid has no elastic limit at low speed.
    let modulus = positive("equilibrium_modulus", relaxation.equilibrium_modulus())?;
    // `shift` is x_s = η_0 v/G_∞; the viscosity η_0 contains the parallel dashpot and all branches.
    let shift = relaxation.zero_shear_viscosity() * contact.velocity / modulus;
    let line = shift * (squared_slope_integral(body, radius)?.value / moment);
    let force = 8.0 * (modulus / solid.half_space_factor()) * moment;
    checked_limit(force, line, 0.5 * line)
}

/// Friction at high speed, v τ ≫ a: inversely proportional to the speed, and the same on half space and line.
///
/// It is finite for all profiles, including those whose viscous friction diverges.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] or [`FrictionError::Indenter`] for a speed or a radius that is not positive, a radius
/// that the body does not reach, or a material with a parallel dashpot;
/// [`FrictionError::NotConverged`] when an integral is known to less than ten digits.
pub fn high_speed_friction(
    body: &dyn Axisymmetric,
    solid: &dyn Material,
    contact: ElasticContact,
) -> Result<ElasticLimitFriction, FrictionError> {
    check_spectra(solid)?;
    let depth = checked_depth(body, contact)?;
    let moment = checked_moment(body, contact.contact_radius)?;
    let relaxation = solid.relaxation();
    // A material with a parallel dashpot has no elastic limit at high speed.
    let glass = positive("glass_modulus", relaxation.glass_modulus())?;
    // `rate` is α/G(0+), where α = Σ G_i/τ_i is the rate at which the modulus begins to fall.
    let branches = relaxation.branches().iter();
    let rates = branches.map(|branch| branch.modulus / glass / branch.relaxation_time);
    let rate: f64 = rates.sum();
    // The friction is proportional to ∫₀^a (d − h̃)² dx, the squared compression of the line.
    let mut ends = ends_outside_apex(body, contact.contact_radius);
    ends.insert(0, 0.0);
    let integral = integrate_pieces(|x| (depth - body.line_height(x)).powi(2), &ends);
    let squared_compression = accept_accurate("squared compression", integral)?.value;
    // The friction coefficient is μ = (8 α/v) ∫ (d − h̃)² dx/F_N, with F_N = 8 G(0+) times the moment.
    let friction = rate / contact.velocity * (squared_compression / moment);
    let force = 8.0 * (glass / solid.half_space_factor()) * moment;
    checked_limit(force, friction, friction)
}

/// The limit with a normal force \[N] and friction coefficients on line and half space, or [`FrictionError::OutOfRange`] if
/// one is not positive and finite.
fn checked_limit(
    normal_force: f64,
    line: f64,
    half_space: f64,
) -> Result<ElasticLimitFriction, FrictionError> {
    Ok(ElasticLimitFriction {
        line: representable("friction coefficient", line)?,
        half_space,
        normal_force: representable("normal force", normal_force)?,
    })
}

/// Depth of the elastic contact, \[m], if body and contact are valid.
fn checked_depth(body: &dyn Axisymmetric, contact: ElasticContact) -> Result<f64, FrictionError> {
    positive("velocity", contact.velocity)?;
    let radius = positive("contact_radius", contact.contact_radius)?;
    let depth = representable("indentation depth", body.checked_line_height(radius)?)?;
    // `contact_radius` refuses a line that turns downwards inside the contact.
    contact_radius(body, depth)?;
    Ok(depth)
}
