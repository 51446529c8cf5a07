//! Exchange rule of active sets: which elements that violate the contact conditions (Karush–Kuhn–Tucker or KKT conditions) change
//! sides.
//!
//! Elements in tension leave the active set, penetrating elements enter it (block principal pivoting, Júdice & Pires 1994). The set of
//! saturated elements changes alike. An update is *non-improving* if there are at least as many violations as in an earlier one, or if
//! the initial residual on the active set exceeds that on the set before. The rule gets more cautious with the number of non-improving
//! updates in a row:
//!
//! 1. At first all violating elements are exchanged.
//! 2. Then only violations that are the largest within a radius are exchanged, so that neighbours do not change sides back and forth
//!    together. The radius, which is one element at first, doubles every [`UPDATES_PER_RADIUS`] updates.
//! 3. When the radius exceeds the grid, the single violating element of the highest index is exchanged. If the operator has a positive
//!    definite symmetric part, no active set then occurs twice, so that the violations become fewer after finitely many updates (Murty
//!    1974).
//!
//! The conjugate gradients of a static contact, whose operator is symmetric, omit the second stage (`iteration.rs`).
//!
//! Theory: docs/theory/stationary-half-space.md, "The equations of one contact".

/// Number of successive non-improving updates after which the exclusion radius of local maxima doubles; it begins with one element,
/// which excludes none. Chosen (case of `evidence tuning`). Fewer updates turn to slower exchanges sooner, more of them repeat
/// exchanges that cycle; the contact that is found is the same.
///
/// Measured on 160 light periodic contacts on dashpots whose moduli grow with the frequency: all were found with it, with 90
/// operator applications each. With a rule that exchanges the violations above a fraction of the largest one, four were not
/// found.
const UPDATES_PER_RADIUS: u32 = 10;

/// An element that violates the KKT conditions: in the active set under tension, or outside it with penetration; saturated with an open
/// gap, or loaded beyond the limit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Violation {
    /// Row-major index of the element.
    pub(crate) element: usize,
    /// Row and column of the element.
    pub(crate) place: [usize; 2],
    /// Violation as a length: penetration or open gap, or for an inadmissible load that load times the self-influence. In the unit
    /// of the heights of the problem, \[m] or depth scale.
    pub(crate) size: f64,
}

/// Count of updates of an active set that do not improve it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stagnation {
    /// Smallest number of violations in any update so far.
    fewest_violations: usize,
    /// Non-improving updates since the last improvement.
    non_improving: u32,
}

impl Default for Stagnation {
    /// The count before the first update, which improves on any number of violations.
    fn default() -> Self {
        Self {
            fewest_violations: usize::MAX,
            non_improving: 0,
        }
    }
}

impl Stagnation {
    /// Exclusion radius of local maxima, in elements.
    fn radius(&self) -> usize {
        let doublings = self.non_improving.saturating_sub(1) / UPDATES_PER_RADIUS;
        1_usize.checked_shl(doublings).unwrap_or(usize::MAX)
    }

    /// True while all violating elements are exchanged.
    pub(super) fn allows_block_updates(&self) -> bool {
        self.radius() == 1
    }

    /// Records the number of violations of an update. The update counts as non-improving if there are not fewer than ever before, or
    /// if `residual_grows`.
    pub(super) fn record(&mut self, violations: usize, residual_grows: bool) {
        let improves = violations < self.fewest_violations && !residual_grows;
        self.fewest_violations = self.fewest_violations.min(violations);
        self.non_improving = if improves { 0 } else { self.non_improving + 1 };
    }
}

/// The exchange rule with the history that it depends on.
pub(crate) struct ExchangeRule {
    /// Rows and columns of the grid. Neighbourhoods wrap around its edges.
    shape: [usize; 2],
    /// Count of the non-improving updates.
    stagnation: Stagnation,
}

impl ExchangeRule {
    /// The rule on a grid with a number of rows and columns, before the first update of its active set.
    pub(crate) fn new(shape: [usize; 2]) -> Self {
        Self {
            shape,
            stagnation: Stagnation::default(),
        }
    }

    /// True if single elements are exchanged, which requires accurate solutions.
    pub(crate) fn exchanges_single_elements(&self) -> bool {
        self.stagnation.radius() > self.shape[0].max(self.shape[1])
    }

    /// Selects the elements to exchange among the violations, which are sorted by element, and records the update.
    ///
    /// `residual_grows` is true if the initial residual on this active set exceeds that on the set before. Returns row-major indices
    /// of elements, in no particular order.
    pub(crate) fn select(&mut self, violations: &[Violation], residual_grows: bool) -> Vec<usize> {
        let mut elements = violations.iter().map(|violation| violation.element);
        let selected = if self.stagnation.allows_block_updates() {
            elements.collect()
        } else if self.exchanges_single_elements() {
            elements.next_back().into_iter().collect()
        } else {
            self.local_maxima(violations, self.stagnation.radius())
        };
        self.stagnation.record(violations.len(), residual_grows);
        selected
    }

    /// Elements of locally largest violations, no two of them fewer than `radius` rows and columns apart; chosen greedily, from the
    /// largest violation on.
    fn local_maxima(&self, violations: &[Violation], radius: usize) -> Vec<usize> {
        let mut by_size = violations.to_vec();
        by_size.sort_by(|one, other| other.size.total_cmp(&one.size));
        let [rows, columns] = self.shape;
        // This closure lists the indices within the radius around `index`, on an axis of `count` elements that wraps around.
        let around = |index: usize, count: usize| {
            let reach = (radius - 1).min(count / 2);
            (count + index - reach..=count + index + reach).map(move |near| near % count)
        };
        // Take the largest remaining violation, and exclude its neighbourhood.
        let mut is_excluded = vec![false; rows * columns];
        let mut maxima = Vec::new();
        for Violation { element, place, .. } in by_size {
            let [row, column] = place;
            if is_excluded[row * columns + column] {
                continue;
            }
            maxima.push(element);
            for row in around(row, rows) {
                for column in around(column, columns) {
                    is_excluded[row * columns + column] = true;
                }
            }
        }
        maxima
    }
}

#[cfg(test)]
mod tests {
    use super::{ExchangeRule, UPDATES_PER_RADIUS, Violation};

    /// A row of violations, each larger than the one before.
    #[test]
    fn fewer_and_fewer_elements_change_until_it_is_the_last() {
        let violation = |element: u32| Violation {
            element: element as usize,
            place: [1, element as usize],
            size: f64::from(element),
        };
        let violations: Vec<Violation> = (0..16).map(violation).collect();
        let mut rule = ExchangeRule::new([3, 32]);
        // All elements, then the radii 2, 4, 8, 16 and 32 on 32 columns, and at last one update with a single element.
        let mut selected = (0..2 + 6 * UPDATES_PER_RADIUS).map(|_| rule.select(&violations, false));
        let mut next = |count: u32| selected.by_ref().take(count as usize).last();
        // The first update always counts as an improvement, on any number of violations.
        assert_eq!(next(2 + UPDATES_PER_RADIUS), Some((0..16).collect()));
        assert_eq!(
            next(UPDATES_PER_RADIUS),
            Some((0..8).rev().map(|n| 2 * n + 1).collect())
        );
        assert_eq!(next(UPDATES_PER_RADIUS), Some(vec![15, 11, 7, 3]));
        assert_eq!(next(3 * UPDATES_PER_RADIUS), Some(vec![15]));
        let mut single = violations;
        single[0].size = 100.0;
        assert!(rule.exchanges_single_elements());
        assert_eq!(rule.select(&single, false), [15]);
        single.pop();
        rule.select(&single, true);
        assert!(rule.exchanges_single_elements());
        single.pop();
        rule.select(&single, false);
        assert_eq!(
            (rule.stagnation.radius(), rule.select(&single, false).len()),
            (1, 14)
        );
    }
}
