//! The depth scale of sliding on any material.
//!
//! A body at the depth D has a contact of about the length a, the distance at which the height of the body is D. At the sliding
//! speed v the material stays in the contact for about the time a/v. For the creep compliance J and the Poisson ratio ν, the
//! force in the one-dimensional model is about 4 a D/(2 (1 − ν) J(a/v)). Hence the normal force F_N leads to
//!
//! ```text
//! D = h(a) = 2 (1 − ν) F_N J(a/v)/(4 a)
//! ```
//!
//! which is F_N/(4ηv) for any body on a dashpot of the viscosity η. The equation has one solution for every body that rises,
//! because J(t)/t never increases. A profile that is infinite along y presses with a force F' per length, and
//!
//! ```text
//! D = h(a) = 2 (1 − ν) F' J(a/v)/(2π)
//! ```
//!
//! where a is half the contact of a cylinder on an elastic half space. On a track J(a/v) contains the effect of all passes before.
//!
//! Theory: docs/theory/stationary-half-space.md, "Any linear viscoelastic material", "Units", and "Line contact".

use std::f64::consts::{FRAC_PI_4, TAU};

use indenters::{IndenterError, SlidingLoad, Surface, check_lowest_point, checked_height};
use numerics::{in_range, positive};

use crate::stationary::steady::sliding_creep::SlidingCreep;
use crate::{BemError, Elastomer};

/// Number of bisections of the logarithm of the contact length, which begin with a factor of 2 between its bounds. Derived: they
/// leave 2⁻⁶⁰ of an octave, which is below rounding.
const BISECTIONS: usize = 60;
/// Largest number of doublings or halvings of the contact length in the search for its bounds. Derived: beyond 2^±900 heights and
/// forces leave the range of numbers.
const MAX_DOUBLINGS: usize = 900;
/// Number of directions in which the height of a surface is averaged, for a scale that need not be exact. Chosen; from 4 to 32 no
/// answer changes by more than 1e-10 of its bar.
const HEIGHT_DIRECTIONS: u8 = 8;

/// Depth scale D of a body of the height `height(a)` at the distance a from its lowest point, \[m]. Contacts are at most as long as
/// `max_length`, and none has lasted longer than the sliding distance takes.
pub(super) fn depth_scale(
    creep: &SlidingCreep,
    normal_force: f64,
    height: impl Fn(f64) -> Result<f64, BemError>,
    max_length: f64,
    sliding_distance: f64,
) -> Result<f64, BemError> {
    // On a dashpot the depth scale D does not depend on the body, unless the sliding distance is shorter than the contact.
    if creep.only_flows() {
        let depth = 0.25 * normal_force * creep.flow_per_length();
        if sliding_distance >= max_length || height(sliding_distance)? >= depth {
            return Ok(positive("F_N / (4 η v)", depth)?);
        }
    }
    let depth = |length: f64| -> Result<f64, BemError> {
        Ok(0.25 * normal_force * (creep.compliance_of_contact(length, sliding_distance)? / length))
    };
    let length = contact_length(height, depth, max_length)?;
    Ok(positive("2 (1 - ν) F_N J(a/v) / (4 a)", depth(length)?)?)
}

/// Scales of a profile in plane strain.
pub(super) struct ProfileScale {
    /// Depth scale D, \[m].
    pub(super) depth_scale: f64,
    /// Distance a from the lowest point at which the profile is D high, half the contact of a cylinder on an elastic half space, \[m].
    pub(super) half_length: f64,
}

/// Scales of a profile under a force per length, \[N/m].
///
/// # Errors
/// [`BemError::InvalidParameter`] for a half space that flows: in plane strain a line load sinks the faster the longer it is, without
/// limit.
pub(super) fn profile_scale(
    profile: &dyn Surface,
    creep: &SlidingCreep,
    force_per_length: f64,
) -> Result<ProfileScale, BemError> {
    let fluidity = creep.fluidity();
    let allowed =
        "0 under a line load: a surface that flows sinks the faster the longer the line is";
    in_range("fluidity", fluidity, fluidity <= 0.0, allowed)?;
    // Find the half length at which the mean height of rear and front equals the depth of a contact of that length.
    check_lowest_point(profile, f64::INFINITY)?;
    let height = |distance: f64| -> Result<f64, BemError> {
        let at = |x: f64| checked_height(profile.height([x, 0.0]), [x, 0.0]);
        Ok(0.5 * (at(-distance)? + at(distance)?))
    };
    let depth = |length: f64| -> Result<f64, BemError> {
        Ok(force_per_length / TAU * creep.compliance_of_contact(length, f64::INFINITY)?)
    };
    let half_length = contact_length(height, depth, f64::INFINITY)?;
    let depth_scale = positive("2 (1 - ν) F' J(a/v) / (2π)", depth(half_length)?)?;
    check_lowest_point(profile, depth_scale)?;
    Ok(ProfileScale {
        depth_scale,
        half_length,
    })
}

/// The length a \[m] with `height(a)` = `depth(a)`, the depth of a contact of that length, or `max_length` if that is shorter; by
/// bisection.
fn contact_length(
    height: impl Fn(f64) -> Result<f64, BemError>,
    depth: impl Fn(f64) -> Result<f64, BemError>,
    max_length: f64,
) -> Result<f64, BemError> {
    let is_too_long =
        |length: f64| -> Result<bool, BemError> { Ok(height(length)? >= depth(length)?) };
    // Without a largest length double the upper bound until a contact of that length is too long. Then halve the lower bound
    // until it is not.
    let mut upper = if max_length.is_finite() {
        max_length
    } else {
        1.0
    };
    for _ in 0..MAX_DOUBLINGS {
        if max_length.is_finite() || is_too_long(upper)? {
            break;
        }
        upper *= 2.0;
    }
    let mut lower = upper;
    for _ in 0..MAX_DOUBLINGS {
        if !is_too_long(lower)? {
            break;
        }
        (lower, upper) = (0.5 * lower, lower);
    }
    // Bisect the logarithm of the length between both bounds.
    for _ in 0..BISECTIONS {
        // The geometric mean is computed from the ratio of the bounds, so that rounding does not depend on the unit of length.
        let middle = lower * (upper / lower).sqrt();
        if is_too_long(middle)? {
            upper = middle;
        } else {
            lower = middle;
        }
    }
    Ok(upper)
}

/// Depth scale D of a surface under a force, \[m].
///
/// # Errors
/// [`BemError::Indenter`] for a surface whose height at the origin is not 0, and for a height that is NaN or −∞.
pub(crate) fn depth_scale_of_surface(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
) -> Result<f64, BemError> {
    check_lowest_point(surface, f64::INFINITY)?;
    let creep = SlidingCreep::for_load(elastomer, load)?;
    let force = load.require_normal_force()?;
    let body = surface.as_axisymmetric();
    let height = |distance| match body {
        Some(body) => Ok(checked_height(
            body.profile_height(distance),
            [distance, 0.0],
        )?),
        None => mean_height(surface, distance),
    };
    let max_length = body.map_or(f64::INFINITY, |body| body.max_radius());
    let sliding_distance = load.sliding_distance().unwrap_or(f64::INFINITY);
    let depth = depth_scale(&creep, force, height, max_length, sliding_distance)?;
    check_lowest_point(surface, depth)?;
    Ok(depth)
}

/// Mean height of a surface at a `distance` \[m] from its lowest point, over [`HEIGHT_DIRECTIONS`], \[m].
pub(super) fn mean_height(surface: &dyn Surface, distance: f64) -> Result<f64, BemError> {
    let height_along = |direction: u8| {
        let (sine, cosine) = (FRAC_PI_4 * f64::from(direction)).sin_cos();
        let position = [distance * cosine, distance * sine];
        checked_height(surface.height(position), position)
    };
    let sum: f64 = (0..HEIGHT_DIRECTIONS)
        .map(height_along)
        .sum::<Result<f64, IndenterError>>()?;
    Ok(sum / f64::from(HEIGHT_DIRECTIONS))
}
