//! Which of the elements on the wrong side of a contact change it, when the contact is searched by block principal pivoting: those
//! in tension leave it, and those that penetrate come into it.
//!
//! All of them change at once. A contact is in vain if no fewer elements are on the wrong side than with one before it, or if the
//! residual that it began with is larger than that of the one before it. After some in vain, only the largest violation of those
//! near to each other changes sides, so that neighbours do not flip to and fro together, and near means the farther the more
//! contacts are in vain. When all elements of the grid are near to each other, it is the last violation of all: where the operator has
//! a positive symmetric part, no active set comes twice then, so that fewer elements are on the wrong side after a finite number of
//! them (Murty 1974).

/// Contacts in vain up to which all violating elements change sides.
const ALL: i32 = 10;
/// Contacts in vain after which the distance at which violations count as near doubles, from two elements. Of 160 light contacts of
/// dashpots that repeat themselves, whose moduli grow with the frequency, all were found so, with 90 products each; where the
/// violations above a part of the largest one change instead, four were not found.
const AS_NEAR: i32 = 10;

/// An element in tension or penetrating, at its row and column, and by how much, in a unit that is the same for both.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Violation {
    pub(crate) element: usize,
    pub(crate) place: [usize; 2],
    pub(crate) size: f64,
}

/// How the number of violations falls.
pub(crate) struct Pivots {
    /// Rows and columns among which near elements are sought, as if they repeated themselves.
    shape: [usize; 2],
    /// Contacts in vain up to which violations far from each other change sides together.
    several_until: i32,
    fewest: usize,
    /// Contacts since there were fewest.
    vain: i32,
}

impl Pivots {
    pub(crate) fn new(shape: [usize; 2]) -> Self {
        let farthest = shape[0].max(shape[1]) / 2;
        let doublings = (1..).find(|doublings| 1_usize << doublings > farthest);
        Self {
            shape,
            several_until: ALL + AS_NEAR * doublings.unwrap_or(1),
            fewest: usize::MAX,
            vain: 0,
        }
    }

    /// Contacts in vain.
    pub(crate) const fn in_vain(&self) -> i32 {
        self.vain
    }

    /// Whether single elements change, which takes accurate solutions.
    pub(crate) const fn are_single(&self) -> bool {
        self.vain > self.several_until
    }

    /// The elements that change sides, of the violations of the next contact, which come in the order of their elements; `grows` says
    /// that this contact began with a larger residual than the one before it.
    pub(crate) fn choose(&mut self, violations: &[Violation], grows: bool) -> Vec<usize> {
        let mut elements = violations.iter().map(|violation| violation.element);
        let chosen = match self.vain {
            0..=ALL => elements.collect(),
            vain if vain <= self.several_until => {
                self.largest_apart(violations, 2 << ((vain - ALL - 1) / AS_NEAR))
            }
            _ => elements.next_back().into_iter().collect(),
        };
        let are_fewer = violations.len() < self.fewest;
        self.fewest = self.fewest.min(violations.len());
        self.vain = if are_fewer && !grows {
            0
        } else {
            self.vain + 1
        };
        chosen
    }

    /// The largest violations, each with no larger one of these nearer than a distance in elements along both axes.
    fn largest_apart(&self, violations: &[Violation], distance: usize) -> Vec<usize> {
        let mut violations = violations.to_vec();
        violations.sort_by(|one, other| other.size.total_cmp(&one.size));
        let [rows, columns] = self.shape;
        let around = |place: usize, count: usize| {
            let reach = (distance - 1).min(count / 2);
            (count + place - reach..=count + place + reach).map(move |near| near % count)
        };
        let mut is_near = vec![false; rows * columns];
        let mut largest = Vec::new();
        for Violation { element, place, .. } in violations {
            let [row, column] = place;
            if is_near[row * columns + column] {
                continue;
            }
            largest.push(element);
            for row in around(row, rows) {
                for column in around(column, columns) {
                    is_near[row * columns + column] = true;
                }
            }
        }
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::{ALL, AS_NEAR, Pivots, Violation};

    /// Of a row of violations, each larger than the one before.
    #[test]
    fn fewer_and_fewer_elements_change_until_it_is_the_last() {
        let violation = |element: u32| Violation {
            element: element as usize,
            place: [1, element as usize],
            size: f64::from(element),
        };
        let violations: Vec<Violation> = (0..16).map(violation).collect();
        let mut pivots = Pivots::new([3, 32]);
        let several_until = pivots.several_until;
        assert_eq!(several_until, ALL + 5 * AS_NEAR, "of 32 columns");
        let mut chosen = (0..several_until + 2).map(|_| pivots.choose(&violations, false));
        let mut next = |count: i32| chosen.by_ref().take(count as usize).last();
        // The first contact is not in vain.
        assert_eq!(next(2 + ALL), Some((0..16).collect()));
        assert_eq!(
            next(AS_NEAR),
            Some((0..8).rev().map(|n| 2 * n + 1).collect())
        );
        assert_eq!(next(AS_NEAR), Some(vec![15, 11, 7, 3]));
        assert_eq!(next(several_until - ALL - 2 * AS_NEAR), Some(vec![15]));
        let mut single = violations;
        single[0].size = 100.0;
        assert!(pivots.are_single());
        assert_eq!(pivots.choose(&single, false), [15]);
        single.pop();
        pivots.choose(&single, true);
        assert!(pivots.are_single());
        single.pop();
        pivots.choose(&single, false);
        assert_eq!(
            (pivots.in_vain(), pivots.choose(&single, false).len()),
            (0, 14)
        );
    }
}
