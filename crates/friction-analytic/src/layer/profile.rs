//! The force of a body on a layer at any depth, as that of another profile on the half space.
//!
//! An increment of the depth moves the contact like a flat punch of its radius a, so that on a layer
//!
//! ```text
//! dF/dd = 2 E* A(a),      A = ∫₀^a φ dx ≥ a
//! ```
//!
//! and springs side by side have this force under the profile g(A(a)) = d(a). With a constant Poisson ratio the influence of
//! a pressure factorises into time and place, on a layer as on a half space, and so Ting's argument and the force ∫ G df hold
//! on both: as long as the contact grows once and shrinks once.

use indenters::{Axisymmetric, EquivalentProfile, IndenterError, contact_radius};
use numerics::{Estimate, bracketed_root, in_range, positive};

use super::BondedLayer;
use super::equation::{Disc, Heights, Waves};
use super::series::Series;
use crate::FrictionError;

/// Last terms of a series, and those with which it is still taken.
const TOLERANCE: f64 = 1e-8;
const WORST: f64 = 5e-8;
/// The error of a radius is less than so many last terms of both series behind it, and what they leave out.
const BAR: f64 = 20.0;
const LEFT_OUT: f64 = 2e-8;
/// A contact on a layer is less than three times as wide as on a half space at the same depth, on a film; how it is sought.
const WIDER: f64 = 3.0;
const STEP: f64 = 1.25;
const ENOUGH: f64 = 1.02;
/// A map with this σ is hardly bent.
const STRAIGHT: f64 = 10.0;
/// Powers by which a map is denser at its beginning; the second for bodies of several powers, as r + r^1.3.
const GRADINGS: [f64; 2] = [1.0, 6.0];
/// How close a contact may come to a vertical edge, such as the equator of a sphere.
const EDGE: f64 = 0.99;

/// The profile of a body on a layer, up to a depth.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerProfile {
    exponent: f64,
    end: f64,
    /// By increasing depth, from kink to kink of the body.
    pieces: Vec<Piece>,
    relative_error: f64,
}

/// Equivalent radius and radius of the contact, over the depth.
#[derive(Debug, Clone, PartialEq)]
struct Piece {
    along: Map,
    /// Both are multiples of this power of y.
    apex: f64,
    radii: Series,
}

/// x from −1 to 1 to a value between two others: start + length yᵐ, y = σ sinh(½ (1 + x) asinh(1/σ)).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Map {
    ends: [f64; 2],
    power: f64,
    sigma: f64,
    /// asinh(1/σ).
    reach: f64,
}

impl Map {
    fn new(ends: [f64; 2], power: f64, sigma: f64) -> Self {
        let reach = sigma.recip().asinh();
        Self {
            ends,
            power,
            sigma,
            reach,
        }
    }

    fn y(&self, x: f64) -> f64 {
        self.sigma * (0.5 * (1.0 + x) * self.reach).sinh()
    }

    fn value(&self, x: f64) -> f64 {
        let [start, end] = self.ends;
        start + (end - start) * self.y(x).powf(self.power)
    }

    /// y and x of a value.
    fn place(&self, value: f64) -> [f64; 2] {
        let [start, end] = self.ends;
        let y = ((value - start) / (end - start)).powf(self.power.recip());
        let x = 2.0 * (y / self.sigma).asinh() / self.reach - 1.0;
        [y, x]
    }
}

impl LayerProfile {
    /// Of a body up to a depth > 0, \[m].
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for a depth that is no positive number, and for a thickness of which the contact would
    /// be more than a hundred wide; [`FrictionError::Indenter`] and [`FrictionError::BeyondEdge`] where the body ends before, or
    /// its contact does not grow with the depth; [`FrictionError::NotConverged`].
    pub fn new(
        body: &dyn Axisymmetric,
        layer: &BondedLayer,
        depth: f64,
    ) -> Result<Self, FrictionError> {
        Self::reaching(body, layer, [depth, depth])
    }

    /// The same at least up to a depth, and up to a larger one if all that lets it.
    ///
    /// # Errors
    /// Those of [`Self::new`] for the first depth.
    pub fn reaching(
        body: &dyn Axisymmetric,
        layer: &BondedLayer,
        [needed, wanted]: [f64; 2],
    ) -> Result<Self, FrictionError> {
        let (needed, depth) = (positive("depth", needed)?, positive("depth", wanted)?);
        let end = body.max_radius();
        if end.is_finite() && body.line_height(end) == 0.0 {
            return Self::of_punch(layer, end);
        }
        let edge = if body.line_height(end) == f64::INFINITY {
            EDGE * end
        } else {
            end
        };
        let half_space = match contact_radius(body, depth) {
            Ok(radius) => radius,
            Err(IndenterError::NonMonotoneLine {
                limiting_radius, ..
            }) => limiting_radius,
            Err(IndenterError::NotHighEnough { .. }) => end,
            Err(other) => return Err(other.into()),
        };
        let limit = edge.min(layer.widest());
        let widest = limit.min(WIDER * half_space);
        let waves = Waves::new(layer.poisson_ratio, widest / layer.thickness);
        let on = OnLayer::new(body, layer, &waves, widest);
        let radius = on.radius_at(depth, [half_space.min(widest), widest])?;
        // Where the contact is narrower than it may be, fewer waves do.
        let waves = Waves::new(layer.poisson_ratio, radius / layer.thickness);
        let on = OnLayer::new(body, layer, &waves, radius);
        let available = on.contact(radius)?[1];
        if available >= needed {
            return on.profile(radius);
        }
        let is_thick = radius < layer.widest();
        let allowed = "at least a hundredth of the radius of the contact";
        in_range("thickness", layer.thickness, is_thick, allowed)?;
        Err(if edge < end {
            FrictionError::BeyondEdge { radius: end }
        } else {
            let depth = needed;
            IndenterError::NotHighEnough { available, depth }.into()
        })
    }

    /// A flat punch has the same contact at all depths.
    fn of_punch(layer: &BondedLayer, radius: f64) -> Result<Self, FrictionError> {
        let stiff = layer.punch_radius(radius)?;
        let constant = |_| Ok::<_, FrictionError>([stiff, radius]);
        let radii = Series::of(constant, f64::INFINITY)?;
        Ok(Self {
            exponent: f64::INFINITY,
            // To the last digit where all its contacts end.
            end: radii.at(0.0)[0],
            pieces: vec![Piece {
                along: Map::new([0.0, f64::INFINITY], 1.0, 1.0),
                apex: 0.0,
                radii,
            }],
            relative_error: LEFT_OUT,
        })
    }

    /// The largest depth that is known, \[m].
    pub fn depth(&self) -> f64 {
        self.pieces[self.pieces.len() - 1].along.ends[1]
    }

    /// Relative error of all radii at a depth; as large an error of the modulus has the same effect on a force.
    pub const fn relative_error(&self) -> f64 {
        self.relative_error
    }

    /// Radius of the contact, \[m], whose equivalent radius is given.
    pub fn contact_radius(&self, equivalent: Estimate) -> Estimate {
        if equivalent.value <= 0.0 {
            return equivalent;
        }
        let depth = self.height_at(equivalent.value).min(self.depth());
        let [stiff, radius] = self.radii(depth);
        // The equivalent radius grows faster than the radius.
        let error = equivalent.error * (radius / stiff) + self.relative_error * radius;
        Estimate::new(radius, error)
    }

    fn radii(&self, depth: f64) -> [f64; 2] {
        let place = self
            .pieces
            .partition_point(|piece| piece.along.ends[1] < depth);
        self.pieces[place.min(self.pieces.len() - 1)].radii(depth)
    }
}

impl Piece {
    fn radii(&self, depth: f64) -> [f64; 2] {
        if self.along.ends[1].is_infinite() {
            return self.radii.at(0.0);
        }
        let [y, x] = self.along.place(depth);
        let factor = y.powf(self.apex);
        self.radii
            .at(x.clamp(-1.0, 1.0))
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
        let excess = |depth: f64| self.radii(depth)[0] - position;
        if position > self.end {
            return f64::INFINITY;
        }
        // A punch is flat.
        if self.depth().is_infinite() {
            return 0.0;
        }
        bracketed_root(excess, [0.0, self.depth()]).unwrap_or(0.0)
    }

    fn end(&self) -> f64 {
        self.end
    }

    fn apex_exponent(&self) -> f64 {
        self.exponent
    }

    /// The surface beside a load moves with it.
    fn is_exact_where_touched_again(&self) -> bool {
        false
    }
}

/// A body and a layer.
struct OnLayer<'a> {
    body: &'a dyn Axisymmetric,
    thickness: f64,
    waves: &'a Waves,
    heights: Heights<'a>,
}

/// What the contacts between two kinks of a body are: ln A/a, and the depth over the height of the line.
struct Contacts {
    along: Map,
    ratios: Series,
}

impl<'a> OnLayer<'a> {
    /// For contacts up to a radius.
    fn new(body: &'a dyn Axisymmetric, layer: &BondedLayer, waves: &'a Waves, widest: f64) -> Self {
        let thickness = layer.thickness;
        let heights = Heights::new(body, thickness, waves, widest);
        Self {
            body,
            thickness,
            heights,
            waves,
        }
    }

    /// Equivalent radius and depth of a contact.
    fn contact(&self, radius: f64) -> Result<[f64; 2], FrictionError> {
        let disc = Disc::new(self.waves, radius / self.thickness)?;
        let sums = self.heights.up_to(radius);
        Ok([self.thickness * disc.radius(), disc.depth(&sums)])
    }

    /// A radius between two others at which a depth is reached; the second one where it is not.
    fn radius_at(&self, depth: f64, [mut radius, widest]: [f64; 2]) -> Result<f64, FrictionError> {
        let [mut before, mut here] = [[0.0; 2], [radius, self.contact(radius)?[1]]];
        while here[0] < widest && here[1] < depth {
            before = here;
            radius = (STEP * radius).min(widest);
            here = [radius, self.contact(radius)?[1]];
        }
        // The equations take longer by the cube of the radius, so that not much more than the depth is worth a step.
        let part = (ENOUGH * depth / before[1]).ln() / (here[1] / before[1]).ln();
        if before[1] > 0.0 && part < 1.0 {
            radius = before[0] * (here[0] / before[0]).powf(part);
            if self.contact(radius)?[1] < depth {
                radius = here[0];
            }
        }
        Ok(radius)
    }

    /// Up to a radius of the contact.
    fn profile(&self, radius: f64) -> Result<LayerProfile, FrictionError> {
        let kinks = self.heights.kinks().filter(|kink| *kink < radius);
        let ends: Vec<f64> = kinks.chain([radius]).collect();
        let mut profile = LayerProfile {
            exponent: self.body.profile_exponent(),
            end: self.contact(radius)?[0],
            pieces: Vec::with_capacity(ends.len()),
            relative_error: 0.0,
        };
        let mut deep = 0.0;
        for pair in ends.windows(2) {
            let (piece, error) = self.graded([pair[0], pair[1]], deep)?;
            deep = piece.along.ends[1];
            profile.relative_error = profile.relative_error.max(error);
            profile.pieces.push(piece);
        }
        Ok(profile)
    }

    /// Between two kinks of the body, from a depth, with its relative error; dense at the beginning where other powers count there
    /// than the first.
    fn graded(&self, ends: [f64; 2], start: f64) -> Result<(Piece, f64), FrictionError> {
        let mut least = f64::INFINITY;
        for grading in GRADINGS {
            let contacts = self.contacts(ends, grading)?;
            let piece = self.piece(&contacts, start, grading)?;
            let tail = contacts.ratios.tail + piece.radii.tail / piece.radii.at(1.0)[1];
            if tail <= WORST {
                return Ok((piece, BAR * tail + LEFT_OUT));
            }
            least = least.min(tail);
        }
        Err(FrictionError::NotConverged {
            quantity: "radius of the contact over that on the half space",
            value: 1.0,
            error: BAR * least,
        })
    }

    /// In the radius contacts are smooth at an apex, and behind a kink of the body in the root of the distance.
    fn contacts(&self, ends: [f64; 2], grading: f64) -> Result<Contacts, FrictionError> {
        let power = grading * if ends[0] > 0.0 { 2.0 } else { 1.0 };
        let sigma = (self.thickness + ends[0]) / (ends[1] - ends[0]);
        let along = Map::new(ends, power, sigma.min(STRAIGHT));
        let ratios = |x: f64| {
            let radius = along.value(x);
            let [stiff, depth] = self.contact(radius)?;
            Ok::<_, FrictionError>([(stiff / radius).ln(), depth / self.body.line_height(radius)])
        };
        Ok(Contacts {
            along,
            ratios: Series::of(ratios, TOLERANCE)?,
        })
    }

    /// The same over the depth, from where the piece before has ended.
    fn piece(&self, contacts: &Contacts, start: f64, grading: f64) -> Result<Piece, FrictionError> {
        let [inner, outer] = contacts.along.ends;
        let ratios = |radius: f64| contacts.ratios.at(contacts.along.place(radius)[1]);
        let depth = |radius: f64| self.body.line_height(radius) * ratios(radius)[1];
        self.check_rise(&contacts.along, &depth)?;
        let is_apex = inner == 0.0;
        let power = if is_apex {
            self.body.profile_exponent()
        } else {
            2.0
        };
        let mut along = Map::new([start, depth(outer)], grading * power, STRAIGHT);
        // Where radii are no longer as on a half space, or on the half space far from the kink.
        let scale = self
            .thickness
            .min(if is_apex { f64::INFINITY } else { inner });
        if inner + scale < outer {
            let sigma = along.place(depth(inner + scale))[0];
            along = Map::new(along.ends, along.power, sigma);
        }
        let radii = |x: f64| {
            let target = along.value(x);
            let excess = |radius: f64| depth(radius) - target;
            let bracket = [inner, outer];
            let nearer = if x < 0.0 { inner } else { outer };
            let radius = bracketed_root(excess, bracket).unwrap_or(nearer);
            let factor = if is_apex {
                along.y(x).powf(-grading)
            } else {
                1.0
            };
            Ok::<_, FrictionError>([factor * radius * ratios(radius)[0].exp(), factor * radius])
        };
        let tolerance = TOLERANCE * outer;
        Ok(Piece {
            radii: Series::of(radii, tolerance)?,
            along,
            apex: if is_apex { grading } else { 0.0 },
        })
    }

    /// Refuses a body that would have to be lifted for its contact to grow.
    fn check_rise(&self, along: &Map, depth: &impl Fn(f64) -> f64) -> Result<(), FrictionError> {
        let places =
            (0..=N_PLACES).map(|k| along.value(2.0 * f64::from(k) / f64::from(N_PLACES) - 1.0));
        let places: Vec<f64> = places.collect();
        let turn = places
            .windows(2)
            .find(|pair| depth(pair[1]) < depth(pair[0]));
        turn.map_or(Ok(()), |pair| {
            Err(FrictionError::Indenter(IndenterError::NonMonotoneLine {
                limiting_radius: pair[0],
                limiting_depth: depth(pair[0]),
                depth: depth(along.ends[1]),
            }))
        })
    }
}

/// Places between two kinks at which it is looked whether the depth rises.
const N_PLACES: u8 = 64;
