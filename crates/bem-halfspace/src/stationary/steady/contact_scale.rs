//! The depth scale of sliding on any material.
//!
//! A body that dips to the depth D below the surface has a contact of about the length a at which it is D high; an
//! element stays in it for the time a/v, and the one-dimensional model carries about the force 4 a D/J(a/v). So
//!
//! ```text
//! D = h(a) = 2 (1 − ν) F_N J(a/v)/(4 a)
//! ```
//!
//! which is F_N/(4ηv) for the dashpot, whatever the body, and has one solution for every body that rises, because
//! J(t)/t never increases. A profile that is infinite along y presses with a force F' per length, and
//!
//! ```text
//! D = h(a) = 2 (1 − ν) F' J(a/v)/(2π)
//! ```
//!
//! where a is half the contact of a cylinder on an elastic half space. On a track J(a/v) is that of the passes before too.

use std::f64::consts::{FRAC_PI_4, TAU};

use indenters::{SlidingLoad, Surface};
use numerics::{in_range, positive};

use crate::stationary::steady::sliding_creep::SlidingCreep;
use crate::{BemError, Elastomer};

/// Halvings of the logarithm of the length: all the digits there are.
const BISECTIONS: usize = 60;
/// Doublings of the length until there is no solution.
const MAX_DOUBLINGS: usize = 900;
/// Directions in which the height of a surface is averaged.
const HEIGHT_DIRECTIONS: u8 = 8;

/// D of a body that is `height(a)` high at the distance a from its lowest point, at most `largest` away, when it has slid a
/// distance: a contact that is longer has lasted no longer than that.
pub(super) fn depth_scale(
    creep: &SlidingCreep,
    normal_force: f64,
    height: impl Fn(f64) -> f64,
    [largest, distance]: [f64; 2],
) -> Result<f64, BemError> {
    if creep.only_flows() {
        let depth = 0.25 * normal_force * creep.flow_per_length();
        if distance >= largest || height(distance) >= depth {
            return Ok(positive("F_N / (4 η v)", depth)?);
        }
    }
    let depth = |length: f64| -> Result<f64, BemError> {
        Ok(0.25 * normal_force * (creep.compliance_of_contact(length, distance)? / length))
    };
    let length = contact_length(height, depth, largest)?;
    Ok(positive("2 (1 - ν) F_N J(a/v) / (4 a)", depth(length)?)?)
}

/// D of a profile, and the distance a from its lowest point at which it is as high, \[m].
///
/// A half space that flows has none: in plane strain a line load sinks the faster the longer it is, without limit.
pub(super) fn profile_scale(
    profile: &dyn Surface,
    creep: &SlidingCreep,
    force_per_length: f64,
) -> Result<[f64; 2], BemError> {
    let fluidity = creep.fluidity();
    let allowed =
        "0 under a line load: a surface that flows sinks the faster the longer the line is";
    in_range("fluidity", fluidity, fluidity <= 0.0, allowed)?;
    let height = |distance: f64| {
        let [rear, front] = [-distance, distance].map(|x| profile.height([x, 0.0]));
        0.5 * (rear + front)
    };
    let depth = |length: f64| -> Result<f64, BemError> {
        Ok(force_per_length / TAU * creep.compliance_of_contact(length, f64::INFINITY)?)
    };
    let length = contact_length(height, depth, f64::INFINITY)?;
    let depth = positive("2 (1 - ν) F' J(a/v) / (2π)", depth(length)?)?;
    Ok([depth, length])
}

/// The length at which a body is as high as the load is deep.
fn contact_length(
    height: impl Fn(f64) -> f64,
    depth: impl Fn(f64) -> Result<f64, BemError>,
    largest: f64,
) -> Result<f64, BemError> {
    let too_long = |length: f64| -> Result<bool, BemError> { Ok(height(length) >= depth(length)?) };
    let mut upper = if largest.is_finite() { largest } else { 1.0 };
    for _ in 0..MAX_DOUBLINGS {
        if largest.is_finite() || too_long(upper)? {
            break;
        }
        upper *= 2.0;
    }
    let mut lower = upper;
    for _ in 0..MAX_DOUBLINGS {
        if !too_long(lower)? {
            break;
        }
        (lower, upper) = (0.5 * lower, lower);
    }
    for _ in 0..BISECTIONS {
        // The root of a ratio, so that another unit of length changes no rounding.
        let middle = lower * (upper / lower).sqrt();
        if too_long(middle)? {
            upper = middle;
        } else {
            lower = middle;
        }
    }
    Ok(upper)
}

/// D of a surface under a force, \[m].
pub(crate) fn depth_scale_of_surface(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
) -> Result<f64, BemError> {
    let creep = SlidingCreep::for_load(elastomer, load)?;
    let force = load.require_normal_force()?;
    let body = surface.as_axisymmetric();
    let height = |distance| match body {
        Some(body) => body.profile_height(distance),
        None => mean_height(surface, distance),
    };
    let largest = body.map_or(f64::INFINITY, |body| body.max_radius());
    let distance = load.sliding_distance().unwrap_or(f64::INFINITY);
    depth_scale(&creep, force, height, [largest, distance])
}

/// Mean height at a distance from the lowest point, \[m].
pub(super) fn mean_height(surface: &dyn Surface, distance: f64) -> f64 {
    let along = |direction: u8| {
        let (sine, cosine) = (FRAC_PI_4 * f64::from(direction)).sin_cos();
        surface.height([distance * cosine, distance * sine])
    };
    (0..HEIGHT_DIRECTIONS).map(along).sum::<f64>() / f64::from(HEIGHT_DIRECTIONS)
}
