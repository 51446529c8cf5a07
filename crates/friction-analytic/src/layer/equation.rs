//! The dual integral equations of a layer (Lebedev & Ufliand 1958, J. Appl. Math. Mech. 22, 442), lengths in thicknesses:
//!
//! ```text
//! q(x) − (2/π) ∫₀^∞ [1 − M(ξ)] cos ξx ∫₀^a q(s) cos ξs ds dξ = d − g(x)  for 0 ≤ x < a,      F = 2 E* ∫₀^a q dx,
//! ```
//!
//! Here g is the equivalent line of the body on a half space, a the contact radius, and d the depth. M(ξ) is the ratio of the
//! compliance of the layer to that of the half space, for a wave of the wave number ξ. Where the body is smooth at the edge,
//! q(a) = 0. The kernel is analytic, and so is q + g for any g: Gauss–Lobatto rules for both integrals converge exponentially.
//!
//! With q = d φ − ψ, φ = 1 + …, the force of a flat punch is that of a half space under one of the radius ∫₀^a φ dx.
//! Comparisons with other solutions: docs/layers.md, "What it was compared with".

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

/// Wave number times the thickness at which the integral over ξ ends. Derived: from there on 1 − M is below 1e-12.
const MAX_WAVE_NUMBER: f64 = 17.0;
/// Number of points of the rule over the wave number, which grows with the contact radius.
///
/// Chosen together with [`CONTACT_POINTS`] and [`LINE_POINTS`]: doubling all three changes the depth and the force of a punch by less
/// than 1e-9 up to a radius of a hundred thicknesses.
const WAVE_POINTS: PointCount = PointCount::new(45.0, 11.5);
/// Number of points of the rule over the contact for q, which grows with the contact radius. Chosen together with
/// [`WAVE_POINTS`], whose doc has the effect of twice as many.
const CONTACT_POINTS: PointCount = PointCount::new(16.0, 4.0);
/// Number of points of the rule over one smooth piece of the equivalent line, which grows with the length of the piece. Chosen
/// together with [`WAVE_POINTS`], whose doc has the effect of twice as many.
const LINE_POINTS: PointCount = PointCount::new(30.0, 6.0);
/// Number of which every number of points is a multiple, so that similar radii share a rule. Chosen: it only raises the numbers
/// of points, by up to seven.
const POINT_MULTIPLE: usize = 8;

/// Number of points of a rule as a function of a length.
#[derive(Clone, Copy)]
struct PointCount {
    /// Points for a length of 0.
    fixed: f64,
    /// Further points for each thickness of the length.
    per_thickness: f64,
}

impl PointCount {
    /// A number of points that grows linearly with the length: `fixed` plus `per_thickness` times the length in thicknesses.
    const fn new(fixed: f64, per_thickness: f64) -> Self {
        Self {
            fixed,
            per_thickness,
        }
    }

    /// Number of points for a length in thicknesses.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few hundred"
    )]
    fn for_length(self, length: f64) -> usize {
        ((self.fixed + self.per_thickness * length) as usize).next_multiple_of(POINT_MULTIPLE)
    }
}

/// Quadrature over the wave number ξ = L (1 ∓ t)/2 in inverse thicknesses, and rules for integrals along the line.
pub(super) struct WaveQuadrature {
    /// Nodes and weights over the wave number.
    pairs: Vec<WavePair>,
    /// Rules on [0, 1] by their numbers of points.
    rules: RefCell<BTreeMap<usize, Rc<[[f64; 2]]>>>,
}

/// Two nodes that lie symmetrically about L/2.
struct WavePair {
    /// Distance of both nodes from L/2, over L/2.
    t: f64,
    /// Root √(w (2/π) (1 − M)) with the weight w of the rule, at both nodes.
    root_weights: [f64; 2],
}

impl WaveQuadrature {
    /// Nodes and weights over the wave number, for contacts up to a radius in thicknesses.
    pub(super) fn new(poisson_ratio: f64, max_radius: f64) -> Self {
        let rule = unit_rule(WAVE_POINTS.for_length(max_radius));
        let root_weight = |part: f64, weight: f64| {
            let kernel = FRAC_2_PI * layer_deficit(MAX_WAVE_NUMBER * part, poisson_ratio);
            (MAX_WAVE_NUMBER * weight * kernel).sqrt()
        };
        let pair = |&[part, weight]: &[f64; 2]| WavePair {
            t: 1.0 - 2.0 * part,
            root_weights: [part, 1.0 - part].map(|part| root_weight(part, weight)),
        };
        Self {
            pairs: rule[..rule.len() / 2].iter().map(pair).collect(),
            rules: RefCell::default(),
        }
    }

    /// Number of wave numbers: two for each pair.
    fn n_waves(&self) -> usize {
        2 * self.pairs.len()
    }

    /// Weighted cosines √(weight (2/π) (1 − M)) cos ξx for all wave numbers, by the addition theorem from one sine and cosine per pair.
    fn cosines_at(&self, x: f64) -> impl Iterator<Item = f64> {
        let half = 0.5 * MAX_WAVE_NUMBER * x;
        let (sine, cosine) = half.sin_cos();
        self.pairs.iter().flat_map(move |pair| {
            let (s, c) = (half * pair.t).sin_cos();
            let [even, odd] = [cosine * c, sine * s];
            let [first, second] = pair.root_weights;
            [first * (even + odd), second * (even - odd)]
        })
    }

    /// The rule on [0, 1] for a length in thicknesses, computed once for each number of points.
    fn rule(&self, points: PointCount, length: f64) -> Rc<[[f64; 2]]> {
        let n_points = points.for_length(length);
        let mut rules = self.rules.borrow_mut();
        Rc::clone(rules.entry(n_points).or_insert_with(|| unit_rule(n_points)))
    }
}

/// Gauss–Lobatto rule on [0, 1], as pairs of node and weight.
fn unit_rule(n_points: usize) -> Rc<[[f64; 2]]> {
    let LobattoRule { nodes, weights } = lobatto_rule(n_points);
    let unit = |(t, weight): (f64, f64)| [0.5 * (1.0 + t), 0.5 * weight];
    nodes.into_iter().zip(weights).map(unit).collect()
}

/// The equivalent line of a body on a layer, with its integrals up to its kinks.
pub(super) struct EquivalentLine<'a> {
    /// Body that is pressed into the layer.
    body: &'a dyn Axisymmetric,
    /// Thickness of the layer, \[m].
    thickness: f64,
    /// Wave numbers of the integrals.
    waves: &'a WaveQuadrature,
    /// Integrals up to the point from which the line rises, and up to its kinks inside the widest contact.
    at_kinks: Vec<LineIntegrals>,
}

/// Integrals of the equivalent line from 0 to a radius.
#[derive(Clone)]
pub(super) struct LineIntegrals {
    /// The radius, \[m].
    radius: f64,
    /// Height g of the line at the radius, \[m].
    height: f64,
    /// Area below the line, ∫₀^x g ds, divided by the thickness, \[m].
    area: f64,
    /// Cosine transform of the line, ∫₀^x g(s) cos ξs ds, for all wave numbers, with the factors of [`WaveQuadrature::cosines_at`].
    waves: DVector<f64>,
}

impl<'a> EquivalentLine<'a> {
    /// The line of a body on a layer, for contacts up to a largest radius, \[m].
    pub(super) fn new(
        body: &'a dyn Axisymmetric,
        thickness: f64,
        waves: &'a WaveQuadrature,
        max_radius: f64,
    ) -> Self {
        let at_zero = LineIntegrals {
            radius: 0.0,
            height: 0.0,
            area: 0.0,
            waves: DVector::zeros(waves.n_waves()),
        };
        let mut line = Self {
            body,
            thickness,
            waves,
            at_kinks: vec![at_zero],
        };
        let kinks = body.kinks().into_iter().map(|kink| kink.radius);
        for kink in kinks.filter(|kink| *kink < max_radius) {
            let integrals = line.integrals_to(kink);
            // A flat end contributes nothing: the line rises from its edge.
            if integrals.height == 0.0 {
                line.at_kinks.clear();
            }
            line.at_kinks.push(integrals);
        }
        line
    }

    /// The radius from which the line rises, and those of its kinks, \[m].
    pub(super) fn kinks(&self) -> impl Iterator<Item = f64> {
        self.at_kinks.iter().map(|integrals| integrals.radius)
    }

    /// The integrals up to a radius, \[m], from the last kink before it on.
    pub(super) fn integrals_to(&self, radius: f64) -> LineIntegrals {
        let before = self
            .at_kinks
            .partition_point(|integrals| integrals.radius < radius);
        let mut integrals = self.at_kinks[before.max(1) - 1].clone();
        let start = integrals.radius;
        let rule = self
            .waves
            .rule(LINE_POINTS, (radius - start) / self.thickness);
        for &[part, weight] in rule.iter() {
            // The nodes are dense at both ends, where a line may behave like a root or a logarithm.
            let position = part.powi(3) * (10.0 - 15.0 * part + 6.0 * part * part);
            let density = 30.0 * (part * (1.0 - part)).powi(2);
            let x = start + (radius - start) * position;
            let height = self.body.line_height(x);
            let weighted = weight * density * (radius - start) / self.thickness * height;
            integrals.area += weighted;
            let cosines = self.waves.cosines_at(x / self.thickness);
            let pairs = integrals.waves.iter_mut().zip(cosines);
            pairs.for_each(|(sum, cosine)| *sum += weighted * cosine);
        }
        integrals.radius = radius;
        integrals.height = self.body.line_height(radius);
        integrals
    }
}

/// The discretised equations of a contact disc, (1 − C Cᵀ) (√w q) = √w (d − g).
///
/// C has the entries √w_i √(weight (2/π) (1 − M)) cos ξ_j x_i. The roots of the weights make the matrix symmetric.
pub(super) struct ContactDisc {
    /// Matrix C of the cosines of the wave numbers at the nodes.
    cosines: DMatrix<f64>,
    /// Cholesky factors of 1 − C Cᵀ.
    factors: Cholesky<f64, Dyn>,
    /// Solution for the flat punch: √w φ at the nodes.
    punch: DVector<f64>,
    /// Root of the weight of the node at the edge, √w.
    root_weight_at_edge: f64,
    /// Radius of the flat punch of the same stiffness on the half space, ∫ φ dx, divided by the thickness.
    equivalent_radius: f64,
}

impl ContactDisc {
    /// Factorises the equations of a contact disc, for all right-hand sides. The radius is given in thicknesses.
    pub(super) fn new(waves: &WaveQuadrature, radius: f64) -> Result<Self, FrictionError> {
        // Each node is a position x_i in the contact with the root √w_i of its weight.
        let nodes: Vec<[f64; 2]> = waves
            .rule(CONTACT_POINTS, radius)
            .iter()
            .map(|[part, weight]| [radius * part, (radius * weight).sqrt()])
            .collect();
        // The matrix C has one row for each node and one column for each wave number. 1 − C Cᵀ is factorised once, for all
        // right-hand sides.
        let row = |&[x, root]: &[f64; 2]| waves.cosines_at(x).map(move |cosine| root * cosine);
        let entries: Vec<f64> = nodes.iter().flat_map(row).collect();
        let cosines = DMatrix::from_row_slice(nodes.len(), waves.n_waves(), &entries);
        let matrix = DMatrix::identity(nodes.len(), nodes.len()) - &cosines * cosines.transpose();
        let factors = Cholesky::new(matrix).ok_or(FrictionError::NotConverged {
            quantity: "contact on the layer",
            value: radius,
            error: f64::INFINITY,
        })?;
        // The solution φ of the equations for d − g = 1 is that of a flat punch; its integral is the equivalent radius.
        let root_weights = DVector::from_iterator(nodes.len(), nodes.iter().map(|[_, root]| *root));
        let punch = factors.solve(&root_weights);
        Ok(Self {
            equivalent_radius: root_weights.dot(&punch),
            root_weight_at_edge: root_weights[nodes.len() - 1],
            cosines,
            factors,
            punch,
        })
    }

    /// Radius of the punch that has the same stiffness on the half space, in thicknesses.
    pub(super) const fn equivalent_radius(&self) -> f64 {
        self.equivalent_radius
    }

    /// Solution φ(a) of the flat punch at the edge of the contact.
    fn punch_at_edge(&self) -> f64 {
        self.punch[self.punch.len() - 1] / self.root_weight_at_edge
    }

    /// The depth \[m] at which the load per length q of the line vanishes at the edge of the contact.
    pub(super) fn depth(&self, integrals: &LineIntegrals) -> f64 {
        let correction = self.factors.solve(&(&self.cosines * &integrals.waves));
        let at_edge = correction[correction.len() - 1] / self.root_weight_at_edge;
        (integrals.height + at_edge) / self.punch_at_edge()
    }

    /// Load ∫₀^a q dx at a depth, from ∫ φ (d − g) dx, divided by the thickness, \[m].
    pub(super) fn load(&self, integrals: &LineIntegrals, depth: f64) -> f64 {
        let correction = self.cosines.tr_mul(&self.punch).dot(&integrals.waves);
        self.equivalent_radius * depth - (integrals.area + correction)
    }
}
