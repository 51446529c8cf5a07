//! Grids of the refinements of one contact, and of marches: first and finest grid, and how the work grows.

use numerics::{FIRST_ELEMENTS, Goal, Request};

/// Exponent of the work of a contact as a function of the elements along it. Derived: transforms of all elements along x and y
/// dominate, and finer grids need hardly more operator applications.
const CONTACT_WORK_EXPONENT: f64 = 2.0;
/// Exponent of the work of a march as a function of the elements along the contact. Derived: the number of steps is proportional
/// to them.
pub(crate) const MARCH_WORK_EXPONENT: f64 = CONTACT_WORK_EXPONENT + 1.0;
/// Convergence order of a march under a smooth body in the spacing. Derived: that of steps over which the load is held.
pub(crate) const MARCH_ORDER: f64 = 1.0;
/// Factor on the discretisation error if the refinement ends because a relative error is met: grids are then selected whose
/// estimated error is small by chance. Chosen on the random scenes of docs/calibration.md (case of `evidence tuning`).
const SELECTION_FACTOR: f64 = 2.0;

/// Resolution policy of a refinement in elements along the contact.
pub(crate) struct RefinementLimits {
    /// Number of elements of the first error estimate.
    initial_elements: usize,
    /// Number of elements from which on the refinement stops, also if the error is too large, so that its time is limited.
    max_elements: usize,
    /// Exponent of the work as a function of the elements along the contact.
    work_exponent: f64,
    /// Factor on the discretisation error if a relative error ends the refinement.
    selection_factor: f64,
}

/// Limits for a contact under a constant force or depth. The largest number of elements is chosen to limit the time: the finest
/// grid takes minutes.
pub(crate) const PRESS: RefinementLimits = RefinementLimits {
    initial_elements: FIRST_ELEMENTS,
    max_elements: 512,
    work_exponent: CONTACT_WORK_EXPONENT,
    selection_factor: SELECTION_FACTOR,
};
/// Limits for a history of a pressed contact. The largest number of elements is chosen to limit the time: it is half that of
/// [`PRESS`], because each grid takes many contacts.
pub(crate) const HISTORY: RefinementLimits = RefinementLimits {
    max_elements: 256,
    ..PRESS
};
/// Limits for a stationary state on a given number of elements, which has no largest value.
pub(crate) const STATIONARY: RefinementLimits = RefinementLimits {
    max_elements: usize::MAX,
    ..PRESS
};
/// Limits for a march from first touch. The largest number of elements is chosen to limit the time: the finest grid takes about a
/// minute.
pub(crate) const SLIDE: RefinementLimits = RefinementLimits {
    max_elements: 32,
    work_exponent: MARCH_WORK_EXPONENT,
    ..PRESS
};
/// Limits for any motion. The largest number of elements is chosen to limit the time: a cycle takes about a minute on the finest
/// grid. Most strokes reach an error of 2 % on the first grid (docs/theory/transient-half-space.md, "Linear loads").
pub(crate) const MOTION: RefinementLimits = RefinementLimits {
    initial_elements: 8,
    max_elements: 48,
    selection_factor: 1.0,
    ..SLIDE
};

impl RefinementLimits {
    /// The goal of a refinement for a request, with the convergence order of its quantities.
    pub(crate) const fn goal<'w>(&self, request: Request<'w>, order: f64) -> Goal<'w> {
        Goal {
            request,
            initial_elements: self.initial_elements,
            max_elements: self.max_elements,
            order,
            work_exponent: self.work_exponent,
            extra_work: 0.0,
            selection_factor: self.selection_factor,
        }
    }
}
