//! Integrals Φ_k of the branch loads over the contact.

use super::{Contact, EXACT_QUADRATURE_TOLERANCE};
use crate::branches::{decay_from_mean, moments};
use crate::history::element::{EdgeDirection, EdgeMove};
use crate::history::path::{DecayedHistory, SegmentTime};
use crate::history::radius::N_COEFFICIENTS;

/// Largest number of times that a panel of the quadrature over a ring is halved. Chosen to limit the time: a branch load that jumps is
/// then resolved to 2⁻¹² of the panel. The change by the last halving counts as error in any case, so that a smaller number
/// widens bars.
const MAX_PANEL_DIVISIONS: u32 = 12;
/// Ratio of the error that is assumed for a panel to its change by the last division. Derived: where a branch load jumps inside a
/// panel, each half keeps an error as large as the change, together 2; the other factor of 2 is a margin.
const QUADRATURE_ERROR_OVER_CHANGE: f64 = 4.0;

impl Contact<'_> {
    /// Integrals Φ_k over the present rings at a later time, branch by branch, \[N]; also sets the modulus of the element at the
    /// edge.
    pub(super) fn sums_at(&mut self, at: SegmentTime) -> Vec<f64> {
        let n_branches = self.path.n_branches();
        let Some(ring) = self.rings.last().copied() else {
            return vec![0.0; n_branches];
        };
        let mut sums = self.inner_sums[(self.rings.len() - 1) * n_branches..].to_vec();
        self.edge_modulus = None;

        // A ring of new elements has grown, and the edge may have stopped since.
        if ring.direction == EdgeDirection::FirstContact {
            self.add_growth(&ring, &mut sums);
            if ring.to != at {
                let past = self.path.decayed_history(ring.to, at);
                advance_without_growth(&mut sums, ring.outer, &past);
                self.edge_modulus = Some(self.path.modulus(&past));
            }
            return sums;
        }

        // Elements that came into contact again are summed by quadrature. Those inside stay in contact.
        let past = self.path.decayed_history(ring.from, at);
        advance_without_growth(&mut sums, ring.inner, &past);
        self.edge_modulus = Some(self.path.modulus(&past));
        let in_ring = self.ring_sums(&ring, at);
        let pairs = sums.iter_mut().zip(in_ring);
        pairs.for_each(|(sum, in_ring)| *sum += in_ring);
        sums
    }

    /// Advances the `sums` Φ_k from the beginning to the end of the time in which the contact grows over a ring of new elements,
    /// \[N].
    fn add_growth(&self, ring: &EdgeMove, sums: &mut [f64]) {
        let path = &self.path;
        let step = path.time(ring.to) - path.time(ring.from);
        let depths = [ring.from, ring.to].map(|at| path.depth(at));
        let radius = self.radii.polynomial_between(depths);
        let mut buffer = [0.0; N_COEFFICIENTS];
        let row = &mut buffer[..radius.terms().len()];
        for ((sum, rate), modulus) in sums.iter_mut().zip(&path.rates).zip(&path.moduli) {
            moments(rate * step, row);
            let terms = radius.terms().iter().zip(&*row);
            let mean: f64 = terms.map(|(a, moment)| a * moment).sum();
            *sum = decay_from_mean(rate * step, row[0]) * *sum
                + modulus * (depths[1] - depths[0]) * mean;
        }
    }

    /// Integrals ∫ σ_k dx over a ring of elements that came into contact again, by adaptive Gauss–Lobatto quadrature, \[N].
    fn ring_sums(&mut self, ring: &EdgeMove, at: SegmentTime) -> Vec<f64> {
        let mut radii = vec![ring.inner, ring.outer];
        // Panels end where earlier moves of the edge began or ended; such kinks are small, and matter only for exact sums.
        let is_exact = self.tolerance <= EXACT_QUADRATURE_TOLERANCE;
        let inside = |radius: &f64| is_exact && *radius > ring.inner && *radius < ring.outer;
        let earlier = self.edge_moves[..ring.n_earlier].iter();
        radii.extend(
            earlier
                .flat_map(|edge_move| [edge_move.inner, edge_move.outer])
                .filter(inside),
        );
        radii.sort_by(f64::total_cmp);
        radii.dedup();
        let mut sums = vec![0.0; self.path.n_branches()];
        let tolerance = self.tolerance * self.path.scale(at) * ring.outer;
        let panel = |ends: [f64; 2]| (ends, self.panel(ring, ends, at), 0);
        let panels = radii.windows(2).map(|ends| panel([ends[0], ends[1]]));
        let mut open: Vec<([f64; 2], Vec<f64>, u32)> = panels.collect();

        // Each panel is halved until its sums change by no more than the tolerance, or it has been halved as often as allowed.
        while let Some((ends, whole, divisions)) = open.pop() {
            let middle = 0.5 * (ends[0] + ends[1]);
            let halves = [[ends[0], middle], [middle, ends[1]]];
            let parts = halves.map(|ends| self.panel(ring, ends, at));
            let pairs = parts[0].iter().zip(&parts[1]);
            let fine = pairs.map(|(one, other)| one + other);
            let change: f64 = fine.clone().zip(&whole).map(|(a, b)| (a - b).abs()).sum();
            if change <= tolerance || divisions == MAX_PANEL_DIVISIONS {
                self.quadrature_error += QUADRATURE_ERROR_OVER_CHANGE * change;
                let pairs = sums.iter_mut().zip(fine);
                pairs.for_each(|(sum, part)| *sum += part);
            } else {
                let divided = halves.into_iter().zip(parts);
                open.extend(divided.map(|(ends, part)| (ends, part, divisions + 1)));
            }
        }
        sums
    }

    /// Integrals ∫ σ_k dx over one panel of a ring, between two radii \[m], at a time, \[N].
    fn panel(&self, ring: &EdgeMove, radii: [f64; 2], at: SegmentTime) -> Vec<f64> {
        let mut sums = vec![0.0; self.path.n_branches()];
        let half = 0.5 * (radii[1] - radii[0]);
        for (node, weight) in self.rule.nodes.iter().zip(&self.rule.weights) {
            let branch_loads = self.loads_in(ring, radii[0] + half * (1.0 + node), at);
            for (sum, branch_load) in sums.iter_mut().zip(branch_loads) {
                *sum += half * weight * branch_load;
            }
        }
        sums
    }
}

/// Advances the integrals Φ_k \[N] over the elements inside a `radius` \[m], all of which stay in contact over the time of `past`: Φ_k
/// decays, and gains the radius times the branch load that each element gains.
fn advance_without_growth(sums: &mut [f64], radius: f64, past: &DecayedHistory) {
    for ((sum, decay), gained) in sums.iter_mut().zip(&past.decays).zip(&past.gained_loads) {
        *sum = decay * *sum + radius * gained;
    }
}
