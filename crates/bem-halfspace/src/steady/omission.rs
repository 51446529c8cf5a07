//! What the stationary solver leaves out, so that what that saves can be measured.

/// A part of the work that [`steady`](crate::steady::steady()) leaves out where a scene does not need it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SteadyOmission {
    /// The elements around the contact, while its gaps are closed by transforms.
    OutsideContact,
    /// Transforms and iteration, where a contact is small enough to be factorised.
    Transforms,
}
