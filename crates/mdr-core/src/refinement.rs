//! Limits and orders that the refinements of [`slide`](crate::slide()) and [`move_along`](crate::move_along) share.

/// Elements along the contact beyond which a refinement stops. Chosen.
pub(crate) const MAX_ELEMENTS_ALONG_CONTACT: usize = 4096;
/// Power of the number of elements with which the work grows: the number of steps grows in proportion to it.
pub(crate) const WORK_EXPONENT: f64 = 2.0;
/// Smallest order of convergence that is assumed; below it nothing converges.
pub(crate) const MIN_ORDER: f64 = 0.1;
/// Largest order of convergence that is assumed. Smooth bodies have a better one, but the place of their contact boundary
/// between the elements makes it unsafe to assume more.
pub(crate) const MAX_ORDER: f64 = 1.0;
/// Elements of a foundation per element of the contact, about and at most, for the estimate of memory.
pub(crate) const FOUNDATION_PER_CONTACT: f64 = 4.0;
