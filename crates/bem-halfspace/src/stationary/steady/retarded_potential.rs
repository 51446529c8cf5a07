//! The load potential of an element as filtered by retardation elements, row by row from ahead.
//!
//! The potential is replaced by polynomials on panels, and the exponentials are integrated exactly. Panels are at most as long as their
//! distance from the edges of the loaded element, where the potential is singular. With n points on a panel, the error is of the order
//! ρ⁻ⁿ of the potential. ρ is the sum of the half axes of the ellipse around the panel that reaches the singularity (Bernstein): 6 for
//! a panel next to it, 4 distance/length far away. Where the potential is smooth over several rows, the polynomial interpolates its
//! values at the rows, each of which is computed once. A layer adds a part whose singularities are not closer than
//! the edges.
//!
//! Theory: docs/theory/stationary-half-space.md, "Any linear viscoelastic material", and "A track" for the start on a track.

use std::collections::VecDeque;
use std::ops::Range;

use numerics::NEGLIGIBLE_EXPONENT;

use crate::Base;
use crate::parallel::reductions::dot;
use crate::stationary::steady::exponential_rule::{ExponentialRule, MAX_POINTS};
use crate::stationary::steady::sliding_creep::ElementCreep;

/// A rule with a number of points, and the smallest distance from the edges of the loaded element from which it is accurate to eleven
/// digits.
struct DistanceRule {
    /// Smallest distance, in the lengths of [`PANEL_RULES`] or [`ROW_RULES`].
    min_distance: f64,
    /// Number of points of the rule.
    n_points: usize,
}

/// Rule of `n_points` points that is accurate from the distance `min_distance` on.
const fn from_distance(min_distance: f64, n_points: usize) -> DistanceRule {
    DistanceRule {
        min_distance,
        n_points,
    }
}

/// Gauss–Lobatto rules on a panel, from the fewest points on; distances are in panel lengths. Derived: with n points the error is
/// of the order ρ⁻ⁿ, with ρ as at the head of this file, which is below 1e-11 for the first three.
const PANEL_RULES: [DistanceRule; 4] = [
    from_distance(256.0, 4),
    from_distance(24.0, 6),
    from_distance(6.0, 8),
    from_distance(1.0, MAX_POINTS),
];
/// Rules that interpolate the values at rows, from the fewest points on; distances are in rows. Derived: the error is (1/2 · 3/2
/// · …)² over the power of the distance from the nearest row, which is below 1e-11 for each rule.
const ROW_RULES: [DistanceRule; 3] = [
    from_distance(86.0, 6),
    from_distance(41.0, 8),
    from_distance(29.0, 10),
];
/// Number of rows that are stored on either side of an element. Derived: half the points of the longest of [`ROW_RULES`].
const ROWS_PER_SIDE: usize = 5;
/// Length, in Δx, below which a panel next to a singularity on its own line is not divided further. Chosen as 2⁻²⁶, the square
/// root of the rounding error; with 1e-12 no answer changes by more than 1e-10 of its bar.
const MIN_PANEL_LENGTH: f64 = 1.0 / (1_u64 << 26) as f64;

/// An interval along x, with lengths in Δx.
#[derive(Debug, Clone, Copy)]
struct PotentialPanel {
    /// Position of the rear end, in Δx.
    start: f64,
    /// Length of the panel, in Δx.
    length: f64,
    /// Index of the rule of the panel in [`PANEL_RULES`].
    rule: usize,
}

/// A retardation element with the weights of all rules on one element of the grid.
struct RetardationRule {
    /// Rate Δx/(v λ) of the exponential over one element of the grid.
    rate: f64,
    /// Fraction of J_k in J(Δx/v).
    compliance: f64,
    /// Decay e^(−rate) over one element of the grid.
    decay: f64,
    /// Weights of each of [`PANEL_RULES`], times the compliance.
    weights: [[f64; MAX_POINTS]; PANEL_RULES.len()],
    /// Weights of each of [`ROW_RULES`], times the compliance.
    row_weights: [[f64; MAX_POINTS]; ROW_RULES.len()],
}

/// Displacements by all retardation elements on one row of the table, the current row; [`step`](Self::step) moves it back along x.
/// Lengths are in Δx.
pub(super) struct RetardedPotential {
    /// Retardation elements of the material.
    retardations: Vec<RetardationRule>,
    /// The rules of [`PANEL_RULES`].
    rules: [ExponentialRule; PANEL_RULES.len()],
    /// Base, with lengths in Δx.
    base: Base,
    /// Aspect ratio Δy/Δx.
    aspect: f64,
    /// Number of columns of the table.
    n_columns: usize,
    /// Position along x of the current row.
    position: f64,
    /// Displacements at the current row, `[retardation element][column]`.
    values: Vec<f64>,
    /// Parts of the values that come from the element between the current row and the row ahead.
    increments: Vec<f64>,
    /// Potential V by row and column, for the rows around the element ahead of the current row.
    rows: VecDeque<Vec<f64>>,
}

impl RetardedPotential {
    /// Prepares the recursion along rows, which starts one element ahead of the position `first`, in Δx, and covers `n_columns`
    /// columns.
    pub(super) fn new(creep: &ElementCreep, first: f64, aspect: f64, n_columns: usize) -> Self {
        // For each retardation element compute the decay over an element of the grid, and the weights of all rules times its
        // compliance.
        let rules = PANEL_RULES.map(|rule| ExponentialRule::new(rule.n_points));
        let row_rules = ROW_RULES.map(|rule| ExponentialRule::on_integers(rule.n_points));
        let retardations = creep.retardations.iter().map(|element| {
            let (rate, compliance) = (element.rate, element.compliance());
            let weights = |rule: &ExponentialRule| rule.weights(rate).map(|w| compliance * w);
            RetardationRule {
                rate,
                compliance,
                decay: element.decay(),
                weights: rules.each_ref().map(weights),
                row_weights: row_rules.each_ref().map(weights),
            }
        });

        // The recursion starts so far ahead of the load that all rows of its rules are ahead of it, from the integral over everything
        // further ahead or once around the track.
        let min_distance = 2.0 * ROWS_PER_SIDE as f64;
        let rows_ahead = match creep.track {
            None => (min_distance - first).max(0.0).ceil(),
            Some(_) => 0.0,
        };
        let position = first + 1.0 + rows_ahead;
        let mut start = Self {
            retardations: retardations.collect(),
            rules,
            base: creep.base.clone(),
            aspect,
            n_columns,
            position,
            values: vec![0.0; creep.retardations.len() * n_columns],
            increments: vec![0.0; creep.retardations.len() * n_columns],
            rows: VecDeque::with_capacity(2 * ROWS_PER_SIDE),
        };
        match creep.track {
            None => start.start_from_infinity(),
            Some(track) => start.start_around_track(track),
        }

        // Store the potentials of the rows around the start, and step back to the row ahead of the first one of the table.
        for row in (1..=2 * ROWS_PER_SIDE).rev() {
            start.push_row(position - ROWS_PER_SIDE as f64 + row as f64);
        }
        while start.position > first + 1.5 {
            start.step(start.position - 1.0);
        }
        start
    }

    /// Potential V of the loaded element at a position along x, in a column.
    fn potential(&self, x: f64, column: usize) -> f64 {
        let offset = [x, column as f64 * self.aspect];
        self.base.influence(offset, [1.0, self.aspect])
    }

    /// Stores the potentials of the row at `x`, the next one behind, in place of those of the row furthest ahead.
    fn push_row(&mut self, x: f64) {
        self.rows.truncate(2 * ROWS_PER_SIDE - 1);
        let row = (0..self.n_columns).map(|column| self.potential(x, column));
        self.rows.push_front(row.collect());
    }

    /// Sets the values at the first row to the integral over everything ahead of it.
    fn start_from_infinity(&mut self) {
        // Divide the line ahead into panels whose lengths are proportional to their distance. They end where all exponentials or
        // the potential have decayed.
        let rates = self.retardations.iter().map(|element| element.rate);
        let slowest = rates.fold(f64::MAX, f64::min);
        let mut ends = vec![self.position];
        let mut end = self.position;
        let influence_end = 1.0 + self.base.influence_radius();
        while slowest * (end - self.position) < NEGLIGIBLE_EXPONENT
            && end < influence_end.min(1e150)
        {
            end *= 2.0;
            ends.push(end);
        }
        // Integrate panel by panel, from the far end towards the load.
        let rule = PANEL_RULES.len() - 1;
        for pair in ends.windows(2).rev() {
            let (start, length) = (pair[0], pair[1] - pair[0]);
            let panel = PotentialPanel {
                start,
                length,
                rule,
            };
            self.integrate_over_panel(&panel, 0..self.n_columns);
        }
    }

    /// Sets the values at the first row of a track to the integral once around it, over 1 − e^(−rate·track).
    fn start_around_track(&mut self, track: f64) {
        let half = 0.5 * track;
        // The edges of the loaded element lie on the line of the first column only, so that this one has panels of its own.
        for columns in [0..1, 1..self.n_columns] {
            let lateral_distance = self.lateral_distance(columns.start);
            for part in [[-half, self.position], [self.position, half]] {
                for panel in panels(part, lateral_distance).iter().rev() {
                    self.integrate_over_panel(panel, columns.clone());
                }
            }
        }
        // All further turns around the track add a geometric series.
        let values = self.values.chunks_exact_mut(self.n_columns);
        for (element, values) in self.retardations.iter().zip(values) {
            let relaxed = -(-element.rate * track).exp_m1();
            values.iter_mut().for_each(|value| *value /= relaxed);
        }
    }

    /// Integrates the values of some columns from the front to the rear of a panel.
    fn integrate_over_panel(&mut self, panel: &PotentialPanel, columns: Range<usize>) {
        let elements = self.retardations.iter();
        let steps: Vec<_> = elements
            .map(|element| self.panel_step(element, panel))
            .collect();
        for column in columns {
            let potentials = self.potentials_at_nodes(panel, column);
            for (index, (decay, weights)) in steps.iter().enumerate() {
                let value = &mut self.values[index * self.n_columns + column];
                *value = decay * *value + dot(weights, &potentials);
            }
        }
    }

    /// Distance of a column from the loaded element along y, 0 for the column of the element.
    fn lateral_distance(&self, column: usize) -> f64 {
        (self.aspect * (column as f64 - 0.5)).max(0.0)
    }

    /// Decay over a panel, and weights of the potentials at its nodes, times the compliance.
    fn panel_step(
        &self,
        retardation: &RetardationRule,
        panel: &PotentialPanel,
    ) -> (f64, [f64; MAX_POINTS]) {
        let rate = retardation.rate * panel.length;
        let weights = self.rules[panel.rule]
            .weights(rate)
            .map(|weight| retardation.compliance * weight);
        ((-rate).exp(), weights)
    }

    /// Potentials at the nodes of a panel, 0 beyond their number.
    fn potentials_at_nodes(&self, panel: &PotentialPanel, column: usize) -> [f64; MAX_POINTS] {
        let mut potentials = [0.0; MAX_POINTS];
        for (potential, node) in potentials.iter_mut().zip(&self.rules[panel.rule].nodes) {
            *potential = self.potential(panel.start + panel.length * node, column);
        }
        potentials
    }

    /// Moves to the row at `x`, one element behind the current one: one step of the recursion.
    pub(super) fn step(&mut self, x: f64) {
        self.push_row(x + 1.0 - ROWS_PER_SIDE as f64);
        for column in 0..self.n_columns {
            // Integrate over the element between the two rows, by the cheapest rule for its distance from the singular edges.
            let lateral_distance = self.lateral_distance(column);
            let distance = distance_from_edges([x, x + 1.0], lateral_distance);
            let mut potentials = [0.0; MAX_POINTS];
            if let Some(rule) = fewest_points(&ROW_RULES, distance) {
                // Far away: interpolate the values at the rows around the element.
                let n_points = ROW_RULES[rule].n_points;
                let rows = self.rows.iter().skip(ROWS_PER_SIDE - n_points / 2);
                for (potential, row) in potentials[..n_points].iter_mut().zip(rows) {
                    *potential = row[column];
                }
                self.set_increments(column, &potentials[..n_points], |one| {
                    &one.row_weights[rule]
                });
            } else if let Some(rule) = fewest_points(&PANEL_RULES, distance) {
                // Far enough from the singularity one panel suffices. Its ends are rows that are stored already.
                let last = PANEL_RULES[rule].n_points - 1;
                for (index, node) in self.rules[rule].nodes.iter().enumerate() {
                    potentials[index] = match index {
                        0 => self.rows[ROWS_PER_SIDE - 1][column],
                        _ if index == last => self.rows[ROWS_PER_SIDE][column],
                        _ => self.potential(x + node, column),
                    };
                }
                self.set_increments(column, &potentials[..=last], |one| &one.weights[rule]);
            } else {
                // Near the edges divide the element into panels that shorten towards the singularity, and integrate from the front on.
                for increment in self.increments[column..].iter_mut().step_by(self.n_columns) {
                    *increment = 0.0;
                }
                for panel in panels([x, x + 1.0], lateral_distance).iter().rev() {
                    let potentials = self.potentials_at_nodes(panel, column);
                    for (index, retardation) in self.retardations.iter().enumerate() {
                        let (decay, weights) = self.panel_step(retardation, panel);
                        let increment = &mut self.increments[index * self.n_columns + column];
                        *increment = decay * *increment + dot(&weights, &potentials);
                    }
                }
            }

            // The values of the row ahead decay over the element, and the part from within the element is added.
            for (index, element) in self.retardations.iter().enumerate() {
                let entry = index * self.n_columns + column;
                self.values[entry] = element.decay * self.values[entry] + self.increments[entry];
            }
        }
        self.position = x;
    }

    /// Sets the increments of a column from the potentials at the nodes of a rule.
    fn set_increments(
        &mut self,
        column: usize,
        potentials: &[f64],
        weights: impl Fn(&RetardationRule) -> &[f64; MAX_POINTS],
    ) {
        for (index, element) in self.retardations.iter().enumerate() {
            self.increments[index * self.n_columns + column] = dot(weights(element), potentials);
        }
    }

    /// Potential of the loaded element at the current row.
    pub(super) fn load_potential(&self, column: usize) -> f64 {
        self.rows[ROWS_PER_SIDE - 1][column]
    }

    /// Displacement by all retardation elements at the current row.
    pub(super) fn displacement(&self, column: usize) -> f64 {
        self.values[column..].iter().step_by(self.n_columns).sum()
    }

    /// Displacements by the retardation element of an index at the current row, one for each column.
    pub(super) fn retardation_part(&self, index: usize) -> &[f64] {
        &self.values[index * self.n_columns..][..self.n_columns]
    }

    /// Part of the [displacement](Self::displacement) that creeps between the row ahead and the current one.
    pub(super) fn creep_within_element(&self, column: usize) -> f64 {
        let increments = self.increments[column..].iter();
        increments.step_by(self.n_columns).sum()
    }
}

/// Distance of an interval along x from the edges of the loaded element at ±1/2; `lateral_distance` is the distance along y.
fn distance_from_edges(interval: [f64; 2], lateral_distance: f64) -> f64 {
    let from_edge = |edge: f64| (interval[0] - edge).max(edge - interval[1]).max(0.0);
    let along = from_edge(-0.5).min(from_edge(0.5));
    (along * along + lateral_distance * lateral_distance).sqrt()
}

/// Index of the rule with the fewest points that is accurate at a distance. `None` if the distance is too short for all.
fn fewest_points(rules: &[DistanceRule], distance: f64) -> Option<usize> {
    rules.iter().position(|rule| distance >= rule.min_distance)
}

/// Panels of an interval along x, from rear to front: divided where the potential is singular, then halved until one of the rules is
/// accurate on each. `lateral_distance` is the distance from the loaded element along y, in Δx.
fn panels(interval: [f64; 2], lateral_distance: f64) -> Vec<PotentialPanel> {
    let [start, end] = interval;
    // Divide the interval at the edges of the loaded element, where the potential is singular.
    let mut ends = vec![start, -0.5, 0.5, end];
    ends.retain(|position| (start..=end).contains(position));
    ends.dedup();
    let mut panels = Vec::new();
    for pair in ends.windows(2) {
        subdivide([pair[0], pair[1]], lateral_distance, &mut panels);
    }
    panels
}

/// Appends the panels of an interval without a singularity inside, halving it until a rule is accurate.
fn subdivide(interval: [f64; 2], lateral_distance: f64, panels: &mut Vec<PotentialPanel>) {
    let [start, end] = interval;
    let length = end - start;
    let distance = distance_from_edges(interval, lateral_distance);
    let rule = fewest_points(&PANEL_RULES, distance / length)
        .or((length <= MIN_PANEL_LENGTH).then_some(PANEL_RULES.len() - 1));
    if let Some(rule) = rule {
        panels.push(PotentialPanel {
            start,
            length,
            rule,
        });
        return;
    }
    // No rule is accurate on the whole interval: halve it.
    let middle = 0.5 * (start + end);
    subdivide([start, middle], lateral_distance, panels);
    subdivide([middle, end], lateral_distance, panels);
}

#[cfg(test)]
mod tests {
    use numerics::integrate;
    use rheology::Elastic;

    use super::*;
    use crate::stationary::steady::sliding_creep::RetardationElement;
    use crate::{Elastomer, Layer};

    /// Retarded potential q ∫ e^(−q s) V(x + s) ds by the double-exponential rule, between all points where the integrand has a
    /// scale; on a track once around it, with V of the nearest image, over 1 − e^(−q L).
    fn reference(rate: f64, [x, y]: [f64; 2], base: &Base, scene: &Scene) -> f64 {
        let track = scene.track.unwrap_or(f64::INFINITY);
        let [end, turn] = [track.min(60.0 / rate), 0.5 * track - x];
        let decays = (-3..=5).map(|power| 2.0_f64.powi(power) / rate);
        let from_edges = (-3..60).step_by(2).flat_map(|power| {
            let distance = 0.5 + 2.0_f64.powi(power);
            [distance - x, track - distance - x, track + distance - x]
        });
        let edges = [-0.5 - x, 0.5 - x, track - 0.5 - x, track + 0.5 - x];
        let ends = decays.chain(from_edges).chain(edges);
        let mut ends: Vec<f64> = ends.chain([0.0, turn, end]).collect();
        ends.retain(|distance| (0.0..=end).contains(distance));
        ends.sort_by(f64::total_cmp);
        let integrand = |s: f64| {
            let image = if s > turn { x + s - track } else { x + s };
            rate * (-rate * s).exp() * base.influence([image, y], [1.0, scene.aspect])
        };
        let parts = ends.windows(2).filter(|pair| pair[0] < pair[1]);
        let parts = parts.map(|pair| integrate(integrand, [pair[0], pair[1]], 1e-13).value);
        parts.sum::<f64>() / -(-rate * track).exp_m1()
    }

    #[derive(Debug)]
    struct Scene {
        shift: f64,
        aspect: f64,
        thickness: f64,
        track: Option<f64>,
    }

    impl Scene {
        fn of_half_space([shift, aspect]: [f64; 2], track: Option<f64>) -> Self {
            Self {
                shift,
                aspect,
                thickness: f64::INFINITY,
                track,
            }
        }
    }

    #[test]
    fn the_recursion_agrees_with_quadrature_for_any_rate() {
        let elements = [
            [-0.5, 0.5],
            [-0.37, 0.5],
            [0.0, 1.0],
            [-0.1, 1e-3],
            [-0.2, 1e4],
        ];
        let rows = [30, 80, 98, 120, 129, 130, 131, 160, 230];
        // Neighbouring elements of the list take every second rate, and all rates between them.
        for (first, element) in [-12, -9].into_iter().cycle().zip(elements) {
            for decade in (first..=12).step_by(6) {
                let scene = Scene::of_half_space(element, None);
                check(10.0_f64.powi(decade), &scene, 130, &rows);
            }
        }
        for thickness in [0.04, 0.5, 8.0] {
            let scene = Scene {
                thickness,
                ..Scene::of_half_space([-0.37, 0.5], None)
            };
            check(0.1, &scene, 130, &rows);
        }
    }

    /// On tracks hardly longer than twice the table, and on long ones.
    #[test]
    fn on_a_track_the_recursion_agrees_with_quadrature_around_it() {
        let rows = [0, 20, 29, 30, 31, 60];
        for (element, track) in [
            ([-0.5, 0.5], 130.0),
            ([-0.37, 0.5], 62.3),
            ([0.0, 1.0], 1e3),
            ([-0.2, 1e4], 1e5),
        ] {
            for decade in (-12..=6).step_by(6) {
                let scene = Scene::of_half_space(element, Some(track));
                check(10.0_f64.powi(decade), &scene, 30, &rows);
            }
        }
        let layer = Scene {
            thickness: 8.0,
            ..Scene::of_half_space([-0.37, 0.5], Some(70.0))
        };
        check(0.1, &layer, 30, &rows);
    }

    /// Compares some rows of a table that begins `ahead` rows ahead of the load.
    fn check(rate: f64, scene: &Scene, ahead: i32, rows: &[i32]) {
        let material = Elastic::new(1.0).expect("a modulus");
        let layer = Layer::new(&material, scene.thickness).expect("a thickness");
        let retardation = RetardationElement {
            rate,
            share: -(-rate).exp_m1(),
        };
        let creep = ElementCreep {
            collocation_shift: scene.shift,
            retardations: vec![retardation],
            track: scene.track,
            base: layer.base(),
            ..ElementCreep::default()
        };
        let first = f64::from(ahead) + scene.shift;
        let mut retarded = RetardedPotential::new(&creep, first, scene.aspect, 4);
        for row in 0..=rows[rows.len() - 1] {
            let x = first - f64::from(row);
            retarded.step(x);
            if !rows.contains(&row) {
                continue;
            }
            for column in [0, 1, 3] {
                let y = f64::from(column) * scene.aspect;
                let by = |base| reference(rate, [x, y], &base, scene);
                let expected = by(layer.base());
                // Far away a layer leaves little of the potential, so that the error is compared with the value on a half space.
                let of_half_space = if scene.thickness.is_finite() {
                    by(Base::default())
                } else {
                    expected
                };
                let actual = retarded.displacement(column as usize);
                let error = (actual - expected).abs() / of_half_space;
                assert!(error < 1e-10, "{error:e} at {:?}", (rate, scene, [x, y]));
            }
        }
    }
}
