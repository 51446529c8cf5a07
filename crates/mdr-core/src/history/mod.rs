//! Pressing, unloading and pressing again, along any path of the depth or the force.
//!
//! ```text
//! w(x, t) = η₀ ḋ + ∫_s^t G(t − t') ḋ dt'        of an element in contact since s(x), as long as w > 0
//! F(t) = 8/(2 (1 − ν)) ∫₀^a w dx
//! ```
//! d is the depth, a the contact radius, and ν the Poisson ratio. G is the relaxation modulus without the parallel dashpot, whose
//! viscosity is η₀.
//!
//! Each element of the line comes into contact and separates on its own. On a half space that is exact as long as the
//! contact is a disc (Ting 1966, J. Appl. Mech. 33, 845; Argatov & Popov 2016, ZAMM 96, 956).
//!
//! [`approach`] is the closed form for one growth and one shrinkage; [`contact`] takes over where elements come into contact
//! again, and [`force`] seeks the depth of a given force. See also docs/theory/line-viscoelastic.md, "Step by step".

mod approach;
mod contact;
mod derivatives;
mod element;
mod force;
mod integrals;

mod path;
mod radius;
mod work;

use indenters::{Control, EquivalentProfile, HistoryPoint};
use numerics::{Estimate, between_zero_and_one, finite, in_range, not_negative, positive};
use rheology::{Material, check_spectra};

pub use self::derivatives::{ForceDerivatives, force_derivatives};
pub use self::work::work_along;

use self::approach::Approach;
use self::contact::Contact;
use self::force::ForceHistory;
use self::path::Path;
use self::radius::Radii;
use crate::MdrError;
use crate::error;

/// The contact at one point of a history; an error of 0 says that a quantity is given.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CurvePoint {
    /// Time, \[s].
    pub time: f64,
    /// Depth d of the lowest point, \[m].
    pub indentation_depth: Estimate,
    /// Normal force F_N, \[N], at the end of the segment that leads there: with a parallel dashpot it jumps where the speed does.
    pub normal_force: Estimate,
    /// Radius a of the contact circle, \[m]; 0 without contact.
    pub contact_radius: Estimate,
}

/// Options of [`indent_along`] and [`work_along`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryOptions {
    /// Relative error of the modulus of a material that approximates another one, as a Prony series a springpot
    /// ([`PronyExpansion::relative_error`](rheology::PronyExpansion::relative_error)); it is part of all error bars.
    pub modulus_error: f64,
    /// Error that the depth may have once a contact under a force has shrunk, relative to the largest depth. Everything else
    /// is exact.
    pub relative_error: f64,
}

impl Default for HistoryOptions {
    /// Options for moduli without error, and depths to a relative error of one part in a thousand.
    fn default() -> Self {
        Self {
            modulus_error: 0.0,
            relative_error: 1e-3,
        }
    }
}

/// Presses a body into an undeformed material along a path of the depth or of the force, with any number of unloadings.
///
/// The surface is at rest before the first point. A body that is below the surface at that point, or pressed, jumps to it.
/// Along a path of the depth everything is exact up to rounding; between two points the edge of the contact may turn once.
/// Under a force the depth is exact as long as the contact does not shrink; without force the body touches the surface.
/// The profile of a body on a layer is exact only until the contact grows again after it has shrunk, and is refused there.
///
/// ```
/// use mdr_core::indenters::{Control, HistoryPoint, PowerProfile};
/// use mdr_core::rheology::{StandardSolid, StandardSolidParameters};
/// use mdr_core::{HistoryOptions, indent_along};
///
/// let ball = PowerProfile::paraboloid(50.0)?;
/// let rubber = StandardSolid::new(StandardSolidParameters {
///     equilibrium_modulus: 1e6,
///     maxwell_modulus: 1e6,
///     viscosity: 1e6,
/// })?;
/// let depth = |time, depth| HistoryPoint { time, control: Control::IndentationDepth(depth) };
/// let history = [depth(0.0, 0.0), depth(1.0, 1e-4), depth(2.0, 0.0)];
/// let curve = indent_along(&ball, &rubber, &history, &HistoryOptions::default())?;
/// // The surface has not recovered, so that the body leaves it before it is back.
/// assert!(curve[1].normal_force.value > 0.0 && curve[2].normal_force.value == 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// - [`MdrError::InvalidParameter`] for times that decrease, forces below 0, force and depth in one history, and a jump of the
///   depth on a material with a parallel dashpot; [`MdrError::Empty`] without points.
/// - [`MdrError::Indenter`] when the line of the body turns down or ends before the largest depth.
/// - [`MdrError::DepthBeyondEdge`] when the contact would reach a vertical edge, as the equator of a sphere;
///   [`MdrError::ForceBeyondEdge`] when it would under a force, or the line turns down or ends.
/// - [`MdrError::NotADisc`] when a part of the contact would open inside it, or close outside.
/// - [`MdrError::TouchedAgain`] when the contact grows again on the profile of a body on a layer.
/// - [`MdrError::HistoryNotReached`] for a depth known less well than asked for; [`MdrError::NonFinite`].
pub fn indent_along(
    body: &dyn EquivalentProfile,
    material: &dyn Material,
    history: &[HistoryPoint],
    options: &HistoryOptions,
) -> Result<Vec<CurvePoint>, MdrError> {
    not_negative("modulus_error", options.modulus_error)?;
    between_zero_and_one("relative_error", options.relative_error)?;
    let points = validated_points(history)?;
    if points.iter().all(|[_, value]| *value <= 0.0) {
        let unloaded = |point: [f64; 2]| unloaded_point(point[0], point[1]);
        return Ok(points.into_iter().map(unloaded).collect());
    }
    // The trait object is made from a reference to the argument, because only a sized type can become one.
    let material: &dyn Material = &material;
    check_spectra(material)?;
    let curve = match history[0].control {
        Control::IndentationDepth(_) => follow_depths(body, material, &points, options)?,
        Control::NormalForce(_) => ForceHistory {
            body,
            material,
            options: *options,
            points,
        }
        .curve()
        .and_then(|curve| refuse_inexact_recontact(body, curve))?,
    };
    for point in &curve {
        let (force, depth) = (point.normal_force, point.indentation_depth);
        error::finite("normal force", force.value, point.time)?;
        error::finite("indentation depth", depth.value, point.time)?;
    }
    Ok(curve)
}

/// A point of the curve without load, at a time \[s] and depth \[m].
const fn unloaded_point(time: f64, depth: f64) -> CurvePoint {
    CurvePoint {
        time,
        indentation_depth: Estimate::exact(depth),
        normal_force: Estimate::exact(0.0),
        contact_radius: Estimate::exact(0.0),
    }
}

/// Pairs of a time \[s] and a depth \[m], or of a time and a force \[N], of a valid history; refuses others.
fn validated_points(history: &[HistoryPoint]) -> Result<Vec<[f64; 2]>, MdrError> {
    let is_force = |point: &HistoryPoint| matches!(point.control, Control::NormalForce(_));
    let first = history.first().ok_or(MdrError::Empty { list: "history" })?;
    let mut before = first.time;
    let mut points = Vec::with_capacity(history.len());
    // Check times, values, and that all points have the same kind of control.
    for point in history {
        let time = finite("time", point.time)?;
        not_negative("time between two points", time - before)?;
        before = time;
        let value = match point.control {
            Control::IndentationDepth(depth) => finite("indentation_depth", depth)?,
            Control::NormalForce(force) => not_negative("normal_force", force)?,
        };
        let allowed = "a force at all points of a history, or a depth at all";
        let is_same_kind = is_force(point) == is_force(first);
        in_range("control", value, is_same_kind, allowed)?;
        points.push([time, value]);
    }
    Ok(points)
}

/// Follows a path of the depth, pairs of a time \[s] and a depth \[m], in closed form, or from event to event once elements come into
/// contact again.
fn follow_depths(
    body: &dyn EquivalentProfile,
    material: &dyn Material,
    points: &[[f64; 2]],
    options: &HistoryOptions,
) -> Result<Vec<CurvePoint>, MdrError> {
    let deepest = points.iter().map(|[_, depth]| *depth).fold(0.0, f64::max);
    let mut errors = CurveErrors {
        factor: 8.0 / material.half_space_factor(),
        modulus_error: options.modulus_error,
        largest_force: 0.0,
    };
    let radii = Radii::new(body, deepest)?;
    let spectrum = material.relaxation();
    // On a parallel dashpot a jump of the depth would take an infinite force.
    for pair in points.windows(2).filter(|_| spectrum.viscosity() > 0.0) {
        positive("time between two depths", pair[1][0] - pair[0][0])?;
    }
    if spectrum.viscosity() > 0.0 && points[0][1] > 0.0 {
        // A body that begins below the surface would jump to its first point, which a parallel dashpot does not allow.
        positive("time between two depths", 0.0)?;
    }
    // Integrate in closed form, as long as no element comes into contact again.
    let mut approach = Approach::new(radii.clone(), &spectrum, points.len(), false);
    approach.start(points[0][0], points[0][1]);
    let mut curve = Vec::with_capacity(points.len());
    for point in points {
        approach.follow(point[0], point[1]);
        if approach.has_recontact {
            if !body.is_exact_where_touched_again() {
                return Err(MdrError::TouchedAgain { time: point[0] });
            }
            // With recontact start again at the first point, from event to event.
            errors.largest_force = 0.0;
            return follow_recontact(body, material, points, radii, errors);
        }
        curve.push(errors.point(&approach.contact_sums()));
    }
    Ok(curve)
}

/// Refuses a contact that grows again after it has shrunk, unless the profile is exact for that too.
fn refuse_inexact_recontact(
    body: &dyn EquivalentProfile,
    curve: Vec<CurvePoint>,
) -> Result<Vec<CurvePoint>, MdrError> {
    let mut widest = 0.0;
    let mut has_shrunk = false;
    let mut before = Estimate::exact(0.0);
    // Find a point at which a contact that has shrunk grows again.
    for point in &curve {
        let contact_radius = point.contact_radius;
        let differs = |radius: f64| radius > contact_radius.error + before.error;
        if has_shrunk
            && differs(contact_radius.value - before.value)
            && !body.is_exact_where_touched_again()
        {
            return Err(MdrError::TouchedAgain { time: point.time });
        }
        has_shrunk |= differs(widest - contact_radius.value);
        widest = contact_radius.value.max(widest);
        before = contact_radius;
    }
    Ok(curve)
}

/// Follows the whole path of times \[s] and depths \[m] again, element by element, for a contact that grows over elements which have
/// separated.
fn follow_recontact(
    body: &dyn EquivalentProfile,
    material: &dyn Material,
    points: &[[f64; 2]],
    radii: Radii,
    mut errors: CurveErrors,
) -> Result<Vec<CurvePoint>, MdrError> {
    let mut path = Path::new(material);
    // The path begins at or above the surface; a body below it jumps there from the surface.
    path.push(points[0][0], points[0][1].min(0.0));
    let begins_above = points[0][1] <= 0.0;
    let mut curve = Vec::with_capacity(points.len());
    curve.extend(begins_above.then(|| unloaded_point(points[0][0], points[0][1])));
    let mut contact = Contact::new(body, path, radii);
    for [time, depth] in &points[curve.len()..] {
        contact.follow(*time, *depth)?;
        curve.push(errors.point(&contact.contact_sums()));
    }
    Ok(curve)
}

/// Error model of the points of a curve.
struct CurveErrors {
    /// Factor 8/(2 (1 − ν)) from the sum of the loads to the force.
    factor: f64,
    /// Relative error of the moduli, as [`HistoryOptions::modulus_error`].
    modulus_error: f64,
    /// Largest force so far, \[N].
    largest_force: f64,
}

/// Rounding of a sum of loads or of their rates, relative to the sum of the sizes of its terms. Measured: 64 units in the last
/// place bound the errors that tests find by a comparison with 40 digits.
pub(crate) const SUM_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Sums over a contact, and the sizes of their terms, from which their rounding follows.
#[derive(Debug, Clone, Copy, Default)]
struct ContactSums {
    /// Time, \[s].
    time: f64,
    /// Indentation depth, \[m].
    depth: f64,
    /// Sum of the loads of all elements, \[N].
    load: f64,
    /// Sum of the sizes of the terms in it, \[N].
    terms: f64,
    /// Error of the sum by anything but rounding, \[N].
    load_error: f64,
    /// Contact radius, \[m].
    radius: f64,
    /// Change of the radius by a load at the edge as large as the terms that cancel in it, \[m].
    edge_change: f64,
}

impl CurveErrors {
    /// The point of the curve with force, depth and radius of the present contact, and their errors by rounding, moduli and
    /// polynomials.
    fn point(&mut self, contact: &ContactSums) -> CurvePoint {
        let ContactSums { time, depth, .. } = *contact;
        let force = self.factor * contact.load;
        self.largest_force = self.largest_force.max(force);
        let rounding = SUM_ROUNDING * contact.terms + contact.load_error;
        // A shift of the edge changes the force in second order only, because its elements carry nothing.
        let expansion = 2.0 * self.modulus_error * self.largest_force;
        let edge_error = (SUM_ROUNDING + 2.0 * self.modulus_error) * contact.edge_change;
        let radius_error = radius::TAIL_TOLERANCE * contact.radius + edge_error;
        CurvePoint {
            time,
            indentation_depth: Estimate::exact(depth),
            normal_force: Estimate::new(force, self.factor * rounding + expansion),
            contact_radius: Estimate::new(contact.radius, radius_error),
        }
    }
}
