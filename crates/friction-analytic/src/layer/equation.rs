//! The dual integral equations of a layer (Lebedev & Ufliand 1958, J. Appl. Math. Mech. 22, 442), lengths in thicknesses:
//!
//! ```text
//! q(x) − (2/π) ∫₀^∞ [1 − M(ξ)] cos ξx ∫₀^a q(s) cos ξs ds dξ = d − g(x)  for 0 ≤ x < a,      F = 2 E* ∫₀^a q dx,
//! ```
//!
//! with the equivalent line g of the body on a half space; where the body is smooth at the edge, q(a) = 0. The kernel is
//! analytic, and so is q + g, whatever g is: both integrals by Lobatto's rules converge exponentially.
//!
//! With q = d φ − ψ, φ = 1 + …, the force of a flat punch is that of a half space under one of the radius ∫₀^a φ dx.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_2_PI;
use std::rc::Rc;

use indenters::Axisymmetric;
use nalgebra::linalg::Cholesky;
use nalgebra::{DMatrix, DVector, Dyn};
use numerics::{LobattoRule, lobatto_rule};
use rheology::layer_deficit;

use crate::FrictionError;

/// Where 1 − M is below 1e-12.
const SHORTEST_WAVE: f64 = 17.0;
/// Points of the integral over ξ, and more of them for each thickness of the radius; of q; and of a piece of the line. With
/// these, twice as many change the depth and the force of a punch by less than 1e-9 up to a hundred thicknesses.
const WAVES: [f64; 2] = [45.0, 11.5];
const NODES: [f64; 2] = [16.0, 4.0];
const HEIGHTS: [f64; 2] = [30.0, 6.0];

/// The number of points is a multiple of this one, so that radii next to each other have the same rule.
const STEP: usize = 8;

/// Wave numbers ξ = L (1 ∓ t)/2 over the thickness, in pairs, and rules for integrals along the line.
pub(super) struct Waves {
    pairs: Vec<Pair>,
    rules: RefCell<BTreeMap<usize, Rc<[[f64; 2]]>>>,
}

/// t, and for both signs the roots of (2/π) (1 − M) times the weight.
struct Pair {
    t: f64,
    roots: [f64; 2],
}

impl Waves {
    /// For contacts up to a radius.
    pub(super) fn new(poisson_ratio: f64, widest: f64) -> Self {
        let rule = rule(n_points(WAVES, widest));
        let root = |part: f64, weight: f64| {
            let kernel = FRAC_2_PI * layer_deficit(SHORTEST_WAVE * part, poisson_ratio);
            (SHORTEST_WAVE * weight * kernel).sqrt()
        };
        let pair = |&[part, weight]: &[f64; 2]| Pair {
            t: 1.0 - 2.0 * part,
            roots: [part, 1.0 - part].map(|part| root(part, weight)),
        };
        Self {
            pairs: rule[..rule.len() / 2].iter().map(pair).collect(),
            rules: RefCell::default(),
        }
    }

    fn count(&self) -> usize {
        2 * self.pairs.len()
    }

    /// √(2/π (1 − M)) cos ξx of all waves.
    fn at(&self, x: f64) -> impl Iterator<Item = f64> {
        let half = 0.5 * SHORTEST_WAVE * x;
        let (sine, cosine) = half.sin_cos();
        self.pairs.iter().flat_map(move |pair| {
            let (s, c) = (half * pair.t).sin_cos();
            let [even, odd] = [cosine * c, sine * s];
            [pair.roots[0] * (even + odd), pair.roots[1] * (even - odd)]
        })
    }

    /// A rule on [0, 1] for a length in thicknesses.
    fn rule(&self, points: [f64; 2], length: f64) -> Rc<[[f64; 2]]> {
        let n_points = n_points(points, length);
        let mut rules = self.rules.borrow_mut();
        Rc::clone(rules.entry(n_points).or_insert_with(|| rule(n_points)))
    }
}

/// As many points as a length in thicknesses needs.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a few hundred"
)]
fn n_points([fewest, per_length]: [f64; 2], length: f64) -> usize {
    ((fewest + per_length * length) as usize).next_multiple_of(STEP)
}

/// Lobatto's rule on [0, 1].
fn rule(n_points: usize) -> Rc<[[f64; 2]]> {
    let LobattoRule { nodes, weights } = lobatto_rule(n_points);
    let unit = |(t, weight): (f64, f64)| [0.5 * (1.0 + t), 0.5 * weight];
    nodes.into_iter().zip(weights).map(unit).collect()
}

/// The line of a body in a layer of a thickness, and its integrals up to its kinks.
pub(super) struct Heights<'a> {
    body: &'a dyn Axisymmetric,
    thickness: f64,
    waves: &'a Waves,
    /// Where the line rises from, and its kinks up to the widest contact; with the integrals up to there.
    sums: Vec<Sums>,
}

/// The line at x, and ∫₀^x g ds and ∫₀^x g(s) cos ξs ds.
#[derive(Clone)]
pub(super) struct Sums {
    radius: f64,
    height: f64,
    area: f64,
    waves: DVector<f64>,
}

impl<'a> Heights<'a> {
    pub(super) fn new(
        body: &'a dyn Axisymmetric,
        thickness: f64,
        waves: &'a Waves,
        widest: f64,
    ) -> Self {
        let nothing = Sums {
            radius: 0.0,
            height: 0.0,
            area: 0.0,
            waves: DVector::zeros(waves.count()),
        };
        let mut heights = Self {
            body,
            thickness,
            waves,
            sums: vec![nothing],
        };
        let kinks = body.kinks().into_iter().map(|kink| kink.radius);
        for kink in kinks.filter(|kink| *kink < widest) {
            let sums = heights.up_to(kink);
            // Up to the edge of a flat end there is nothing to be summed.
            if sums.height == 0.0 {
                heights.sums.clear();
            }
            heights.sums.push(sums);
        }
        heights
    }

    /// Where the line begins to rise, and its kinks.
    pub(super) fn kinks(&self) -> impl Iterator<Item = f64> {
        self.sums.iter().map(|sums| sums.radius)
    }

    /// Up to a radius, \[m].
    pub(super) fn up_to(&self, radius: f64) -> Sums {
        let before = self.sums.partition_point(|sums| sums.radius < radius);
        let mut sums = self.sums[before.max(1) - 1].clone();
        let start = sums.radius;
        let rule = self.waves.rule(HEIGHTS, (radius - start) / self.thickness);
        for &[part, weight] in rule.iter() {
            // Dense at both ends, where a line may be a root or a logarithm.
            let place = part.powi(3) * (10.0 - 15.0 * part + 6.0 * part * part);
            let density = 30.0 * (part * (1.0 - part)).powi(2);
            let x = start + (radius - start) * place;
            let height = self.body.line_height(x);
            let height = weight * density * (radius - start) / self.thickness * height;
            sums.area += height;
            let waves = self.waves.at(x / self.thickness);
            let pairs = sums.waves.iter_mut().zip(waves);
            pairs.for_each(|(sum, wave)| *sum += height * wave);
        }
        sums.radius = radius;
        sums.height = self.body.line_height(radius);
        sums
    }
}

/// The equations on a disc; G with 1 − G Gᵀ their matrix, symmetric by the roots of the weights.
pub(super) struct Disc {
    waves: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
    /// φ times the root of the weight, and that of the weight at the edge.
    punch: DVector<f64>,
    edge: f64,
    /// ∫ φ dx.
    radius: f64,
}

impl Disc {
    /// Of a radius in thicknesses.
    pub(super) fn new(waves: &Waves, radius: f64) -> Result<Self, FrictionError> {
        let nodes = waves.rule(NODES, radius);
        let nodes = nodes.iter();
        let nodes: Vec<[f64; 2]> = nodes
            .map(|[part, weight]| [radius * part, (radius * weight).sqrt()])
            .collect();
        let row = |[x, root]: &[f64; 2]| waves.at(*x).map(|wave| root * wave).collect::<Vec<_>>();
        let rows: Vec<f64> = nodes.iter().flat_map(row).collect();
        let waves = DMatrix::from_row_slice(nodes.len(), waves.count(), &rows);
        let matrix = DMatrix::identity(nodes.len(), nodes.len()) - &waves * waves.transpose();
        let factor = Cholesky::new(matrix).ok_or(FrictionError::NotConverged {
            quantity: "contact on the layer",
            value: radius,
            error: f64::INFINITY,
        })?;
        let roots = DVector::from_iterator(nodes.len(), nodes.iter().map(|[_, root]| *root));
        let punch = factor.solve(&roots);
        Ok(Self {
            radius: roots.dot(&punch),
            edge: roots[nodes.len() - 1],
            waves,
            factor,
            punch,
        })
    }

    /// Radius of the punch that is as stiff on the half space, in thicknesses.
    pub(super) const fn radius(&self) -> f64 {
        self.radius
    }

    /// φ at the edge.
    pub(super) fn at_edge(&self) -> f64 {
        self.punch[self.punch.len() - 1] / self.edge
    }

    /// The depth at which q vanishes at the edge.
    pub(super) fn depth(&self, sums: &Sums) -> f64 {
        let rest = self.factor.solve(&(&self.waves * &sums.waves));
        (sums.height + rest[rest.len() - 1] / self.edge) / self.at_edge()
    }

    /// ∫₀^a q dx at a depth: ∫ φ (d − g) dx.
    pub(super) fn load(&self, sums: &Sums, depth: f64) -> f64 {
        let rest = self.waves.tr_mul(&self.punch).dot(&sums.waves);
        self.radius * depth - (sums.area + rest)
    }
}
