//! A layer of finite thickness t, bonded to a rigid base and free of friction above.
//!
//! A wave of pressure moves its surface by `û = 2 p̂ M(|q|t)/(|q| E*)`, with E* as for the half space, where M is 1. So every
//! half-space method answers for a layer when the potential 1/r of a point is replaced by
//!
//! ```text
//! 1/r + c(r/t)/t,        c(ρ) = ∫_0^∞ [M(s) − 1] J₀(sρ) ds,
//! ```
//!
//! of which the second part is analytic for |Im ρ| < 2, and both together decay like e^(−0.7 ρ) or faster.

use std::f64::consts::{FRAC_PI_4, PI};
use std::sync::{Arc, Mutex, PoisonError};

use numerics::{InvalidParameter, LobattoRule, in_range, lobatto_rule, whole_part};
use rheology::Material;

use crate::influence;
use crate::substrate::rectangle::integrate_smooth;

/// What a surface is pressed into: every [`Material`] stands for a half space, and [`Layer`] makes a layer of it.
pub trait Elastomer {
    /// What it is made of.
    fn material(&self) -> Box<dyn Material + '_>;

    /// Its thickness, \[m]; infinite for a half space.
    fn thickness(&self) -> f64;
}

impl<M: Material + ?Sized> Elastomer for M {
    fn material(&self) -> Box<dyn Material + '_> {
        Box::new(self)
    }

    fn thickness(&self) -> f64 {
        f64::INFINITY
    }
}

/// A layer of a material, bonded to a rigid base.
#[derive(Debug)]
pub struct Layer<'a, M: ?Sized> {
    material: &'a M,
    thickness: f64,
}

impl<'a, M: Material + ?Sized> Layer<'a, M> {
    /// A layer of a thickness greater than 0 \[m]; an infinite one is a half space.
    ///
    /// # Errors
    /// [`InvalidParameter`] for another number.
    pub fn new(material: &'a M, thickness: f64) -> Result<Self, InvalidParameter> {
        in_range("thickness", thickness, thickness > 0.0, "greater than 0")?;
        Ok(Self {
            material,
            thickness,
        })
    }
}

impl<M: Material + ?Sized> Elastomer for Layer<'_, M> {
    fn material(&self) -> Box<dyn Material + '_> {
        Box::new(self.material)
    }

    fn thickness(&self) -> f64 {
        self.thickness
    }
}

/// Ratio M(s) of the compliance of a layer on a rigid base to that of the half space, for a wave of pressure with s = |q|t ≥ 0
/// and −1 < ν ≤ 1/2, to rounding: `(1 − 2ν) s/(2 (1 − ν)²)` for long waves, 2 s³/3 where ν is 1/2, and 1 for short ones.
pub fn layer_factor(s: f64, poisson_ratio: f64) -> f64 {
    if s > SHORTEST_WAVE {
        return 1.0 + deficit(s.min(1e3), poisson_ratio);
    }
    let (kappa, decay) = (3.0 - 4.0 * poisson_ratio, (-2.0 * s).exp());
    // Times 2 e^(−2s), so that nothing overflows; the difference sinh 2s − 2s is a series where it would cancel.
    let excess = if s < 0.5 {
        let square = 4.0 * s * s;
        let series = (1..=10).rev().fold(0.0, |sum, n| {
            square / f64::from(2 * n * (2 * n + 1)) * (1.0 + sum)
        });
        4.0 * s * series * decay
    } else {
        1.0 - decay * decay - 4.0 * s * decay
    };
    let numerator = 8.0 * s * decay * (1.0 - 2.0 * poisson_ratio) + kappa * excess;
    numerator / denominator(s, poisson_ratio)
}

/// 2 e^(−2s) times the denominator of M.
fn denominator(s: f64, poisson_ratio: f64) -> f64 {
    let (kappa, decay) = (3.0 - 4.0 * poisson_ratio, (-2.0 * s).exp());
    2.0 * decay * (constant(poisson_ratio) + 2.0 * s * s) + kappa * (1.0 + decay * decay)
}

fn constant(poisson_ratio: f64) -> f64 {
    5.0 - 4.0 * poisson_ratio * (3.0 - 2.0 * poisson_ratio)
}

/// M(s) − 1 without cancellation.
fn deficit(s: f64, poisson_ratio: f64) -> f64 {
    let (kappa, decay) = (3.0 - 4.0 * poisson_ratio, (-2.0 * s).exp());
    let rest = kappa * decay + 2.0 * s * (1.0 + s) + constant(poisson_ratio);
    -2.0 * decay * rest / denominator(s, poisson_ratio)
}

/// A half space, or a layer with its thickness in the unit of the lengths of a grid.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Base(Option<Thin>);

#[derive(Debug, Clone)]
struct Thin {
    thickness: f64,
    poisson_ratio: f64,
    correction: Arc<Correction>,
}

impl PartialEq for Thin {
    fn eq(&self, other: &Self) -> bool {
        let same = |a: f64, b: f64| a.total_cmp(&b).is_eq();
        same(self.thickness, other.thickness) && same(self.poisson_ratio, other.poisson_ratio)
    }
}

impl Base {
    pub(crate) fn of(elastomer: &(impl Elastomer + ?Sized)) -> Self {
        let thickness = elastomer.thickness();
        Self(thickness.is_finite().then(|| {
            let poisson_ratio = elastomer.material().poisson_ratio();
            Thin {
                thickness,
                poisson_ratio,
                correction: Correction::of(poisson_ratio),
            }
        }))
    }

    /// The same with lengths in edges of an element; refuses a layer that is thinner by far.
    pub(crate) fn in_units_of(&self, edge: f64) -> Result<Self, InvalidParameter> {
        let Some(thin) = self.0.clone() else {
            return Ok(Self(None));
        };
        let is_resolved = thin.thickness >= edge / LONGEST_EDGE;
        let allowed = "at least 1/32 of the edge of an element (below about 1/150 of the contact a layer is a Winkler \
                       foundation, or where it is incompressible a film)";
        in_range("thickness", thin.thickness, is_resolved, allowed)?;
        let thickness = thin.thickness / edge;
        Ok(Self(Some(Thin { thickness, ..thin })))
    }

    pub(crate) const fn is_layer(&self) -> bool {
        self.0.is_some()
    }

    /// |q|/M(|q|t), the |q| > 0 of the wave that a half space would resist as much.
    pub(crate) fn stiffness(&self, wave_number: f64) -> f64 {
        self.0.as_ref().map_or(wave_number, |thin| {
            wave_number / layer_factor(wave_number * thin.thickness, thin.poisson_ratio)
        })
    }

    /// The same, and for waves longer than about the thickness that of a wave as long: what an incompressible layer resists in
    /// longer ones depends on the load around, which it is squeezed out under.
    pub(crate) fn local_stiffness(&self, wave_number: f64) -> f64 {
        let longest = self.0.as_ref().map_or(0.0, |thin| 2.0 / thin.thickness);
        self.stiffness(wave_number.max(longest))
    }

    /// M/|q| of the mean: by how much a layer gives way under a load that is the same everywhere; 0 for a half space, where
    /// displacements are measured from their mean.
    pub(crate) fn mean(&self) -> f64 {
        self.0.as_ref().map_or(0.0, |thin| {
            let nu = thin.poisson_ratio;
            0.5 * thin.thickness * (1.0 - 2.0 * nu) / (1.0 - nu).powi(2)
        })
    }

    /// By how much softer than a half space the base is under a load of about that length.
    pub(crate) fn softness(&self, length: f64) -> f64 {
        // A Winkler foundation gives way under a flat punch of that radius by as much.
        let wave_number = FRAC_PI_4.recip() / length;
        wave_number / self.stiffness(wave_number)
    }

    /// Where contact may occur over about that length from the middle of a body h ∼ r^p, as a multiple of the heights where a
    /// half space may be touched: a thin layer that hardly shrinks rises around the contact, and meets the body up to the
    /// height (1 + p/2) d where it does not shrink at all.
    pub(crate) fn rise(&self, half_length: f64, exponent: f64) -> f64 {
        self.0.as_ref().map_or(1.0, |thin| {
            let slenderness = (half_length / thin.thickness / SLENDER).min(1.0);
            let shrinks = (10.0 * (0.5 - thin.poisson_ratio)).clamp(0.0, 1.0);
            1.0 + slenderness * (ROOM + 0.5 * exponent * (1.0 - shrinks))
        })
    }

    /// Distance beyond which nothing moves.
    pub(crate) fn reach(&self) -> f64 {
        self.0
            .as_ref()
            .map_or(f64::INFINITY, |thin| REACH * thin.thickness)
    }

    /// Displacement by a uniformly loaded rectangle, as [`influence`].
    pub(crate) fn influence(&self, offset: [f64; 2], edges: [f64; 2]) -> f64 {
        let Some(thin) = &self.0 else {
            return influence(offset, edges);
        };
        // Of the rectangle only what is not too far to move anything.
        let reach = self.reach();
        let [mut centre, mut seen] = [offset, edges];
        for axis in 0..2 {
            let half = 0.5 * edges[axis];
            let [first, last] = [
                (offset[axis] - half).max(-reach),
                (offset[axis] + half).min(reach),
            ];
            if first >= last {
                return 0.0;
            }
            if last - first < edges[axis] {
                (centre[axis], seen[axis]) = (0.5 * (first + last), last - first);
            }
        }
        let unit = thin.thickness;
        let table = &thin.correction;
        let [offset, edges] = [centre, seen].map(|lengths| lengths.map(|length| length / unit));
        let smooth = integrate_smooth(SINGULAR, (offset, edges), &|x, y| {
            table.at((x * x + y * y).sqrt())
        });
        influence(centre, seen) + unit * smooth
    }
}

/// Edge of an element in thicknesses, at most.
const LONGEST_EDGE: f64 = 32.0;
/// From how many thicknesses on a layer is thin, and how much more room there is at its rim than that.
const SLENDER: f64 = 5.0;
const ROOM: f64 = 0.2;
/// Distance from 0 at which c is singular, along the imaginary axis.
const SINGULAR: f64 = 2.0;
/// Where 1/ρ + c is below 1e-15 of 1.
const REACH: f64 = 44.0;
/// Where 1 − M is.
const SHORTEST_WAVE: f64 = 24.0;
/// Panels and points of the integral over s: as many as follow J₀(sρ) up to the reach.
const WAVE_PANELS: u8 = 8;
const WAVE_POINTS: usize = 96;
/// Length in distances to the singularities of the panels of ρ on which c is integrated, and of those on which it is kept;
/// with as many coefficients as give 1e-12.
const PANEL: f64 = 0.5;
const TERMS: usize = 16;
const SHORT_PANEL: f64 = 0.0625;
const FEW_TERMS: usize = 6;

/// c(ρ) up to the reach, on short panels of the same length.
#[derive(Debug)]
struct Correction(Vec<Panel<FEW_TERMS>>);

/// Tables of the last Poisson ratios, of which a solution needs one again and again.
static KNOWN: Mutex<Vec<(u64, Arc<Correction>)>> = Mutex::new(Vec::new());
const KEPT: usize = 8;

impl Correction {
    fn of(poisson_ratio: f64) -> Arc<Self> {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        let ratio = poisson_ratio.to_bits();
        if let Some((_, table)) = known.iter().find(|(other, _)| *other == ratio) {
            return Arc::clone(table);
        }
        let table = Arc::new(Self::new(poisson_ratio));
        if known.len() == KEPT {
            known.remove(0);
        }
        known.push((ratio, Arc::clone(&table)));
        table
    }

    fn new(poisson_ratio: f64) -> Self {
        let LobattoRule { nodes, weights } = lobatto_rule(WAVE_POINTS);
        let half = 0.5 * SHORTEST_WAVE / f64::from(WAVE_PANELS);
        let waves: Vec<[f64; 2]> = (0..WAVE_PANELS)
            .flat_map(|panel| {
                let middle = half * f64::from(2 * panel + 1);
                let rule = nodes.iter().zip(&weights);
                rule.map(move |(t, weight)| [middle + half * t, half * weight])
            })
            .map(|[s, weight]| [s, weight * deficit(s, poisson_ratio)])
            .collect();
        let integral = |rho: f64| -> f64 {
            let waves = waves.iter().map(|[s, weight]| weight * libm::j0(s * rho));
            waves.sum()
        };
        let mut panels: Vec<Panel<TERMS>> = Vec::new();
        let mut start = 0.0;
        while start < REACH {
            let length = PANEL * f64::hypot(start, SINGULAR);
            panels.push(Panel::new([start, length], integral));
            start += length;
        }
        let value = |rho: f64| {
            let panel = panels.partition_point(|panel| panel.start <= rho);
            panels[panel.max(1) - 1].at(rho)
        };
        let starts = (0..).map(|index| SHORT_PANEL * f64::from(index));
        let starts = starts.take_while(|start| *start < REACH);
        Self(
            starts
                .map(|start| Panel::new([start, SHORT_PANEL], value))
                .collect(),
        )
    }

    fn at(&self, rho: f64) -> f64 {
        let panel = self.0.get(whole_part(rho / SHORT_PANEL));
        panel.map_or_else(|| -rho.recip(), |panel| panel.at(rho))
    }
}

/// A polynomial on a part of the line.
#[derive(Debug)]
struct Panel<const N: usize> {
    start: f64,
    /// 2 over its length.
    scale: f64,
    /// Of the powers of the distance from its middle in half lengths.
    coefficients: [f64; N],
}

impl<const N: usize> Panel<N> {
    /// The Chebyshev series of a function, as powers by the recurrence of Clenshaw (1955).
    fn new([start, length]: [f64; 2], function: impl Fn(f64) -> f64) -> Self {
        let angle = |index: usize| PI * (index as f64 + 0.5) / N as f64;
        let value = |index| function(start + 0.5 * length * (1.0 + angle(index).cos()));
        let values: [f64; N] = std::array::from_fn(value);
        let coefficient = |order: usize| {
            let terms = values.iter().enumerate();
            let terms = terms.map(|(index, value)| value * (order as f64 * angle(index)).cos());
            terms.sum::<f64>() / N as f64
        };
        let [mut last, mut coefficients] = [[0.0; N]; 2];
        for order in (0..N).rev() {
            let twice = if order == 0 { 1.0 } else { 2.0 };
            let next = std::array::from_fn(|power| match power {
                0 => twice * coefficient(order) - last[0],
                _ => twice * coefficients[power - 1] - last[power],
            });
            (last, coefficients) = (coefficients, next);
        }
        Self {
            start,
            scale: 2.0 / length,
            coefficients,
        }
    }

    fn at(&self, rho: f64) -> f64 {
        let x = self.scale * (rho - self.start) - 1.0;
        let coefficients = self.coefficients.iter().rev();
        coefficients.fold(0.0, |sum, coefficient| sum * x + coefficient)
    }
}

#[cfg(test)]
mod tests {
    use rheology::Elastic;

    use super::*;

    /// Its parts are integrated by shorter rules.
    #[test]
    fn a_rectangle_moves_the_surface_like_its_parts() {
        let material = Elastic::new(1.0).expect("a modulus");
        for thickness in [0.3, 1.0, 2.6, 4.2, 13.0, 130.0] {
            let base = Base::of(&Layer::new(&material, thickness).expect("a thickness"));
            for [x, y] in [[0.0, 0.0], [2.0, 1.0], [9.0, 30.0]] {
                let part = |index: u8| {
                    let [row, column] = [index / 4, index % 4].map(|n| f64::from(n) / 4.0 - 0.375);
                    base.influence([x + row, y + 0.5 * column], [0.25, 0.125])
                };
                let whole = base.influence([x, y], [1.0, 0.5]);
                let error = (0..16).map(part).sum::<f64>() - whole;
                assert!(error.abs() < 5e-12, "{error:e} at {x}, {y} on {thickness}");
            }
        }
    }
}
