//! Equivalent profile: the body whose force on springs side by side is, at every depth, that of a body on a layer.
//!
//! An increment of the depth moves the contact like a flat punch of its radius a, so that on a layer
//!
//! ```text
//! dF/dd = 2 E* A(a),      A = ∫₀^a φ dx ≥ a
//! ```
//!
//! and springs side by side have this force under the profile g(A(a)) = d(a). With a constant Poisson ratio the influence of
//! a pressure factorises into time and place, on a layer as on a half space. So Ting's argument and the force ∫ G df hold on
//! both, as long as the contact grows once and shrinks once. See docs/layers.md, "Pressed and pulled back".
//!
//! A profile is computed in three steps:
//! 1. find a contact radius at which the depth is reached;
//! 2. between kinks, expand ln(A/a) and the depth over the height of the line into Chebyshev series of a;
//! 3. invert the depth, and expand A and a into Chebyshev series of d.

use indenters::{Axisymmetric, EquivalentProfile, IndenterError, contact_radius};
use numerics::{Estimate, bracketed_root, in_range, positive};

use super::BondedLayer;
use super::chebyshev::ChebyshevPair;
use super::equation::{ContactDisc, EquivalentLine, WaveQuadrature};
use crate::FrictionError;

/// Largest absolute value of the last coefficients, relative to the radius, at which a Chebyshev series is not refined
/// further. Chosen at the accuracy of the equations (case of `evidence tuning`).
const SERIES_TOLERANCE: f64 = 1e-8;
/// Largest sum of the last coefficients of both series, relative to the radius, with which a profile is accepted. It is 1e-6
/// divided by [`ERROR_OVER_TAIL`], so that radii are known to 1e-6.
const MAX_TAIL: f64 = 1e-6 / ERROR_OVER_TAIL;
/// Upper bound of the ratio of the relative error of a radius to the sum of the last coefficients of both series behind it.
/// Chosen (case of `evidence tuning`).
///
/// The test `the_profile_is_known_within_its_error` compares it with single contacts.
const ERROR_OVER_TAIL: f64 = 20.0;
/// Upper bound of the relative error of a radius by the small terms that the series skip; the error of the truncated tail is
/// added to it. Derived: the dropped terms of either of two series add up to its tolerance.
const LEFT_OUT_TERMS_ERROR: f64 = 2.0 * SERIES_TOLERANCE;
/// Upper bound of the ratio of the contact radius on a layer to that on the half space at the same depth. Derived: it is largest
/// on a film, on which the profile c r^p has the height (1 + p/2) d at the contact boundary. The ratio [(1 + p/2) √π Γ(p/2 +
/// 1)/Γ(p/2 + 1/2)]^(1/p) falls with p, from 2.7 at p = 1/2. A larger bound costs wave numbers that are not needed.
const MAX_RADIUS_RATIO: f64 = 3.0;
/// Factor on the radius per step of the search for a depth. Chosen: it changes the number of evaluations only. A larger one may
/// end at a larger radius, whose equations take longer.
const SEARCH_GROWTH: f64 = 1.25;
/// Largest parameter σ of a [`GradedMap`]. Derived: with it, x ↦ y is linear to 2e-3, the relative size 1/(6 σ²) of the next
/// term. It decides the number of coefficients, not the radii.
const MAX_SIGMA: f64 = 10.0;
/// Grading exponents of the maps that are tried one after the other. The first is a plain map; the second is needed for bodies of
/// several powers, such as r + r^1.3. Chosen (case of `evidence tuning`); the tail decides which is taken.
const GRADING_EXPONENTS: [f64; 2] = [1.0, 6.0];
/// Largest ratio of the contact radius to the radius of a vertical edge of the body, such as the equator of a sphere. Chosen:
/// closer to the edge the slope grows without limit, and series converge slowly. Depths that would need a larger contact are
/// refused as [`FrictionError::BeyondEdge`].
const MAX_RADIUS_OVER_EDGE: f64 = 0.99;
/// Number of intervals between two kinks at whose ends the depth is checked to increase. Chosen: it only refuses bodies, and a
/// depth that falls and rises within one interval is not noticed.
const MONOTONICITY_INTERVALS: u8 = 64;

/// The equivalent profile of a body on a layer, up to a depth.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerProfile {
    /// Exponent of the body at its apex.
    exponent: f64,
    /// Equivalent radius at the largest depth, \[m].
    end: f64,
    /// Pieces by increasing depth, from kink to kink of the body.
    pieces: Vec<Piece>,
    /// Upper bound of the relative error of all radii.
    relative_error: f64,
}

/// Equivalent radius A and contact radius a as functions of the depth.
#[derive(Debug, Clone, PartialEq)]
struct Piece {
    /// Map of x onto the depths of the piece, \[m].
    depths: GradedMap,
    /// Exponent e of the factor y^e in both radii.
    apex_exponent: f64,
    /// Series of both radii over x, A/y^e and a/y^e.
    radii: ChebyshevPair,
}

/// Map of x from −1 to 1 onto an interval: start + length yᵐ, y = σ sinh(½ (1 + x) asinh(1/σ)).
#[derive(Debug, Clone, Copy, PartialEq)]
struct GradedMap {
    /// Start and end of the interval onto which the map goes, in its unit.
    ends: [f64; 2],
    /// Grading exponent m of the map.
    power: f64,
    /// Scale σ of y on which the nodes are dense at the start.
    sigma: f64,
    /// Inverse hyperbolic sine of 1/σ.
    asinh: f64,
}

impl GradedMap {
    /// The map onto an interval, with the exponent m and the scale σ.
    fn new(ends: [f64; 2], power: f64, sigma: f64) -> Self {
        Self {
            ends,
            power,
            sigma,
            asinh: sigma.recip().asinh(),
        }
    }

    /// Coordinate y from 0 to 1 at a position x from −1 to 1.
    fn y(&self, x: f64) -> f64 {
        self.sigma * (0.5 * (1.0 + x) * self.asinh).sinh()
    }

    /// The value of the interval at a position x from −1 to 1.
    fn value(&self, x: f64) -> f64 {
        let [start, end] = self.ends;
        start + (end - start) * self.y(x).powf(self.power)
    }

    /// Coordinates y and x, in this order, of a value in the interval.
    fn inverse(&self, value: f64) -> [f64; 2] {
        let [start, end] = self.ends;
        let y = ((value - start) / (end - start)).powf(self.power.recip());
        let x = 2.0 * (y / self.sigma).asinh() / self.asinh - 1.0;
        [y, x]
    }
}

impl LayerProfile {
    /// The equivalent profile of a body up to a depth > 0, \[m].
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for a depth that is no positive number, or a contact radius above a hundred
    /// thicknesses; [`FrictionError::Indenter`] and [`FrictionError::BeyondEdge`] if the body ends before, or its contact does
    /// not grow with the depth; [`FrictionError::NotConverged`] if the series need too many terms.
    pub fn new(
        body: &dyn Axisymmetric,
        layer: &BondedLayer,
        depth: f64,
    ) -> Result<Self, FrictionError> {
        Self::reaching(body, layer, depth, depth)
    }

    /// The equivalent profile of a body up to the `wanted` depth \[m], or to the largest one that body and layer allow.
    ///
    /// It is an error if that is less than the `needed` depth \[m].
    ///
    /// # Errors
    /// Those of [`Self::new`] for the needed depth.
    pub fn reaching(
        body: &dyn Axisymmetric,
        layer: &BondedLayer,
        needed: f64,
        wanted: f64,
    ) -> Result<Self, FrictionError> {
        positive("depth", needed)?;
        positive("depth", wanted)?;
        // A flat punch has the same contact at all depths.
        let end = body.max_radius();
        if end.is_finite() && body.line_height(end) == 0.0 {
            return Self::of_punch(layer, end);
        }

        // Bound the contact radius by the body, the layer, and the contact on the half space.
        let edge = if body.line_height(end) == f64::INFINITY {
            MAX_RADIUS_OVER_EDGE * end
        } else {
            end
        };
        let half_space_radius = match contact_radius(body, wanted) {
            Ok(radius) => radius,
            Err(IndenterError::NonMonotoneLine {
                limiting_radius, ..
            }) => limiting_radius,
            Err(IndenterError::NotHighEnough { .. }) => end,
            Err(other) => return Err(other.into()),
        };
        let max_radius = edge
            .min(layer.max_contact_radius())
            .min(MAX_RADIUS_RATIO * half_space_radius);

        // The contact on the half space is the start of the search for a radius that reaches the wanted depth.
        let search_waves = WaveQuadrature::new(layer.poisson_ratio, max_radius / layer.thickness);
        let search_problem = LayerProblem::new(body, layer, &search_waves, max_radius);
        let start = half_space_radius.min(max_radius);
        let radius = search_problem.radius_reaching(wanted, [start, max_radius])?;

        // Expand with the wave numbers that this radius needs, which may be fewer.
        let waves = WaveQuadrature::new(layer.poisson_ratio, radius / layer.thickness);
        let problem = LayerProblem::new(body, layer, &waves, radius);
        let available = problem.contact(radius)?.depth;
        if available >= needed {
            return problem.profile(radius);
        }
        // Name the reason why the needed depth is not reached.
        let is_thick = radius < layer.max_contact_radius();
        let allowed = "at least a hundredth of the radius of the contact";
        in_range("thickness", layer.thickness, is_thick, allowed)?;
        Err(if edge < end {
            FrictionError::BeyondEdge { radius: end }
        } else {
            let depth = needed;
            IndenterError::NotHighEnough { available, depth }.into()
        })
    }

    /// The profile of a flat punch, which has the same contact radius and equivalent radius at all depths.
    fn of_punch(layer: &BondedLayer, radius: f64) -> Result<Self, FrictionError> {
        let equivalent_radius = layer.equivalent_punch_radius(radius)?;
        let constant = |_| Ok::<_, FrictionError>([equivalent_radius, radius]);
        let radii = ChebyshevPair::interpolate(constant, f64::INFINITY)?;
        Ok(Self {
            exponent: f64::INFINITY,
            // The end is evaluated from the series, so that it agrees with the radius at every depth to the last digit.
            end: radii.evaluate(0.0)[0],
            pieces: vec![Piece {
                depths: GradedMap::new([0.0, f64::INFINITY], 1.0, 1.0),
                apex_exponent: 0.0,
                radii,
            }],
            relative_error: LEFT_OUT_TERMS_ERROR,
        })
    }

    /// The largest depth of the profile, \[m]; infinite for a flat punch.
    pub fn depth(&self) -> f64 {
        self.pieces[self.pieces.len() - 1].depths.ends[1]
    }

    /// Upper bound of the relative error of the radii at a depth. An equal relative error of the modulus changes a force as
    /// much.
    pub const fn relative_error(&self) -> f64 {
        self.relative_error
    }

    /// Contact radius for a given equivalent radius, \[m].
    pub fn contact_radius(&self, equivalent: Estimate) -> Estimate {
        if equivalent.value <= 0.0 {
            return equivalent;
        }
        let depth = self.height_at(equivalent.value).min(self.depth());
        let [equivalent_radius, radius] = self.radii(depth);
        // The equivalent radius grows faster than the contact radius.
        let error = equivalent.error * (radius / equivalent_radius) + self.relative_error * radius;
        Estimate::new(radius, error)
    }

    /// Equivalent radius and contact radius at a depth, \[m].
    fn radii(&self, depth: f64) -> [f64; 2] {
        let index = self
            .pieces
            .partition_point(|piece| piece.depths.ends[1] < depth);
        self.pieces[index.min(self.pieces.len() - 1)].radii(depth)
    }
}

impl Piece {
    /// Equivalent radius and contact radius at a depth, \[m].
    fn radii(&self, depth: f64) -> [f64; 2] {
        if self.depths.ends[1].is_infinite() {
            return self.radii.evaluate(0.0);
        }
        let [y, x] = self.depths.inverse(depth);
        let factor = y.powf(self.apex_exponent);
        self.radii
            .evaluate(x.clamp(-1.0, 1.0))
            .map(|radius| factor * radius)
    }
}

impl EquivalentProfile for LayerProfile {
    fn position(&self, height: f64) -> Result<f64, IndenterError> {
        let depth = positive("depth", height)?;
        let available = self.depth();
        if depth > available {
            return Err(IndenterError::NotHighEnough { available, depth });
        }
        Ok(self.radii(depth)[0])
    }

    fn closed_position(&self, height: f64) -> Option<f64> {
        Some(self.radii(height)[0])
    }

    fn height_at(&self, position: f64) -> f64 {
        let radius_excess = |depth: f64| self.radii(depth)[0] - position;
        if position > self.end {
            return f64::INFINITY;
        }
        // A flat punch has the height 0 up to its edge.
        if self.depth().is_infinite() {
            return 0.0;
        }
        bracketed_root(radius_excess, [0.0, self.depth()]).unwrap_or(0.0)
    }

    fn end(&self) -> f64 {
        self.end
    }

    fn apex_exponent(&self) -> f64 {
        self.exponent
    }

    /// False, because the surface outside the contact moves with the load.
    fn is_exact_where_touched_again(&self) -> bool {
        false
    }
}

/// The contact problem of a body and a layer.
struct LayerProblem<'a> {
    /// Body that is pressed into the layer.
    body: &'a dyn Axisymmetric,
    /// Thickness of the layer, \[m].
    thickness: f64,
    /// Wave numbers of the integrals.
    waves: &'a WaveQuadrature,
    /// Equivalent line of the body on a half space.
    line: EquivalentLine<'a>,
}

/// A contact of given radius.
#[derive(Clone, Copy)]
struct ContactOnLayer {
    /// Contact radius a, \[m].
    radius: f64,
    /// Equivalent radius A, \[m].
    equivalent_radius: f64,
    /// Indentation depth d, \[m].
    depth: f64,
}

/// The contacts between two kinks of a body.
struct ContactSeries {
    /// Map of x onto the contact radii, \[m].
    contact_radii: GradedMap,
    /// Series over x of ln(A/a), and of the depth over the height of the line.
    ratios: ChebyshevPair,
}

impl<'a> LayerProblem<'a> {
    /// The contacts of a body on a layer up to a largest radius, \[m], with the quadrature over wave numbers for it.
    fn new(
        body: &'a dyn Axisymmetric,
        layer: &BondedLayer,
        waves: &'a WaveQuadrature,
        max_radius: f64,
    ) -> Self {
        let thickness = layer.thickness;
        Self {
            body,
            thickness,
            waves,
            line: EquivalentLine::new(body, thickness, waves, max_radius),
        }
    }

    /// Equivalent radius and depth of the contact of a radius \[m], from the equations of its disc.
    fn contact(&self, radius: f64) -> Result<ContactOnLayer, FrictionError> {
        let disc = ContactDisc::new(self.waves, radius / self.thickness)?;
        Ok(ContactOnLayer {
            radius,
            equivalent_radius: self.thickness * disc.equivalent_radius(),
            depth: disc.depth(&self.line.integrals_to(radius)),
        })
    }

    /// A radius of an interval at which a depth is reached, \[m]; the end of the interval if none is.
    fn radius_reaching(&self, depth: f64, interval: [f64; 2]) -> Result<f64, FrictionError> {
        let [start, end] = interval;
        // Enlarge the contact until it is deep enough.
        let mut previous: Option<ContactOnLayer> = None;
        let mut contact = self.contact(start)?;
        while contact.radius < end && contact.depth < depth {
            previous = Some(contact);
            contact = self.contact((SEARCH_GROWTH * contact.radius).min(end))?;
        }

        // Interpolate the radius as a power of the depth, and keep it if it is deep enough: the cost of the equations grows like the
        // cube of the radius.
        if let Some(previous) = previous.filter(|previous| previous.depth > 0.0) {
            let part = (depth / previous.depth).ln() / (contact.depth / previous.depth).ln();
            let radius = previous.radius * (contact.radius / previous.radius).powf(part);
            if part < 1.0 && self.contact(radius)?.depth >= depth {
                return Ok(radius);
            }
        }
        Ok(contact.radius)
    }

    /// The equivalent profile up to a contact radius, \[m].
    fn profile(&self, radius: f64) -> Result<LayerProfile, FrictionError> {
        // The profile has one piece between any two kinks; each piece starts at the depth at which the one before ends.
        let kinks = self.line.kinks().filter(|kink| *kink < radius);
        let ends: Vec<f64> = kinks.chain([radius]).collect();
        let mut profile = LayerProfile {
            exponent: self.body.profile_exponent(),
            end: self.contact(radius)?.equivalent_radius,
            pieces: Vec::with_capacity(ends.len()),
            relative_error: 0.0,
        };
        let mut depth = 0.0;
        for pair in ends.windows(2) {
            let (piece, error) = self.piece_between([pair[0], pair[1]], depth)?;
            depth = piece.depths.ends[1];
            profile.relative_error = profile.relative_error.max(error);
            profile.pieces.push(piece);
        }
        Ok(profile)
    }

    /// The piece between two contact radii from a depth on, and its relative error.
    ///
    /// The nodes are dense at the beginning if the first grading does not converge, because other powers of the body count
    /// there than the leading one.
    fn piece_between(
        &self,
        radii: [f64; 2],
        start_depth: f64,
    ) -> Result<(Piece, f64), FrictionError> {
        let mut smallest_tail = f64::INFINITY;
        for grading in GRADING_EXPONENTS {
            let contacts = self.contact_series(radii, grading)?;
            let piece = self.invert_depth(&contacts, start_depth, grading)?;
            // The last coefficients of both expansions add up to the tail that bounds the error of the radii.
            let tail = contacts.ratios.tail + piece.radii.tail / piece.radii.evaluate(1.0)[1];
            if tail <= MAX_TAIL {
                return Ok((piece, ERROR_OVER_TAIL * tail + LEFT_OUT_TERMS_ERROR));
            }
            smallest_tail = smallest_tail.min(tail);
        }
        Err(FrictionError::NotConverged {
            quantity: "radius of the contact over that on the half space",
            value: 1.0,
            error: ERROR_OVER_TAIL * smallest_tail,
        })
    }

    /// Expands the contacts between two radii \[m] into series over a map with the exponent `grading`, twice that behind a kink.
    fn contact_series(
        &self,
        radii: [f64; 2],
        grading: f64,
    ) -> Result<ContactSeries, FrictionError> {
        // Contacts are smooth in the radius at an apex, and in the root of the distance behind a kink of the body.
        let power = grading * if radii[0] > 0.0 { 2.0 } else { 1.0 };
        let sigma = (self.thickness + radii[0]) / (radii[1] - radii[0]);
        let contact_radii = GradedMap::new(radii, power, sigma.min(MAX_SIGMA));
        let ratios = |x: f64| {
            let contact = self.contact(contact_radii.value(x))?;
            Ok::<_, FrictionError>([
                (contact.equivalent_radius / contact.radius).ln(),
                contact.depth / self.body.line_height(contact.radius),
            ])
        };
        Ok(ContactSeries {
            contact_radii,
            ratios: ChebyshevPair::interpolate(ratios, SERIES_TOLERANCE)?,
        })
    }

    /// Inverts the depth of a series of contacts, and expands both radii as functions of the depth from `start_depth` on, \[m],
    /// on a map with the same exponent `grading`.
    fn invert_depth(
        &self,
        contacts: &ContactSeries,
        start_depth: f64,
        grading: f64,
    ) -> Result<Piece, FrictionError> {
        let [inner, outer] = contacts.contact_radii.ends;
        let ratios = |radius: f64| {
            contacts
                .ratios
                .evaluate(contacts.contact_radii.inverse(radius)[1])
        };
        let depth = |radius: f64| self.body.line_height(radius) * ratios(radius)[1];
        check_increasing(&contacts.contact_radii, depth)?;

        // The map of the depth has the leading power of the depth as a function of the radius. Its scale σ comes from the
        // length on which the radii change to those of a thin layer, or to those far from a kink.
        let is_apex = inner == 0.0;
        let exponent = self.body.profile_exponent();
        let power = if is_apex { exponent } else { 2.0 };
        let nearly_linear = GradedMap::new([start_depth, depth(outer)], grading * power, MAX_SIGMA);
        let scale = self
            .thickness
            .min(if is_apex { f64::INFINITY } else { inner });
        let depths = if inner + scale < outer {
            let sigma = nearly_linear.inverse(depth(inner + scale))[0];
            GradedMap::new(nearly_linear.ends, nearly_linear.power, sigma)
        } else {
            nearly_linear
        };

        // At each node the contact radius a solves d(a) = `target`. At an apex both radii are divided by y^`grading`.
        let radii = |x: f64| {
            let target = depths.value(x);
            let depth_excess = |radius: f64| depth(radius) - target;
            let nearer_end = if x < 0.0 { inner } else { outer };
            let radius = bracketed_root(depth_excess, [inner, outer]).unwrap_or(nearer_end);
            let factor = if is_apex {
                depths.y(x).powf(-grading)
            } else {
                1.0
            };
            Ok::<_, FrictionError>([factor * radius * ratios(radius)[0].exp(), factor * radius])
        };
        Ok(Piece {
            radii: ChebyshevPair::interpolate(radii, SERIES_TOLERANCE * outer)?,
            depths,
            apex_exponent: if is_apex { grading } else { 0.0 },
        })
    }
}

/// Refuses a body that would have to be lifted for its contact to grow; `depth` is that of a contact radius, both in \[m].
fn check_increasing(
    contact_radii: &GradedMap,
    depth: impl Fn(f64) -> f64,
) -> Result<(), FrictionError> {
    let radii: Vec<f64> = (0..=MONOTONICITY_INTERVALS)
        .map(|k| contact_radii.value(2.0 * f64::from(k) / f64::from(MONOTONICITY_INTERVALS) - 1.0))
        .collect();
    let turn = radii
        .windows(2)
        .find(|pair| depth(pair[1]) < depth(pair[0]));
    turn.map_or(Ok(()), |pair| {
        Err(FrictionError::Indenter(IndenterError::NonMonotoneLine {
            limiting_radius: pair[0],
            limiting_depth: depth(pair[0]),
            depth: depth(contact_radii.ends[1]),
        }))
    })
}
