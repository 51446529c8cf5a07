//! The profile on which the normal force of a pressed body depends.

use crate::{Axisymmetric, IndenterError, contact_radius};

/// The profile g(x) for which a Winkler foundation gives the normal force of a body at every depth.
///
/// For a body of revolution on a half space it is the equivalent line (Heß 2011); a layer has another profile.
pub trait EquivalentProfile: Send + Sync {
    /// Position x ≥ 0 at which the profile has a `height` > 0, \[m].
    ///
    /// # Errors
    /// [`IndenterError`] if the profile does not reach the height.
    fn position(&self, height: f64) -> Result<f64, IndenterError>;

    /// Closed form of [`position`](Self::position) for a height that the profile reaches, \[m]; `None` if there is none.
    fn closed_position(&self, height: f64) -> Option<f64>;

    /// Height at a position ≥ 0, \[m]; `+∞` beyond the end of the profile.
    fn height_at(&self, position: f64) -> f64;

    /// Position of the end of the profile, \[m]; `+∞` if it has none.
    fn end(&self) -> f64;

    /// Leading exponent p of g ∼ x^p; `+∞` for a flat end.
    fn apex_exponent(&self) -> f64;

    /// Whether the foundation is exact for a surface that the body has left and touches again.
    fn is_exact_where_touched_again(&self) -> bool;
}

impl<B: Axisymmetric + ?Sized> EquivalentProfile for B {
    fn position(&self, height: f64) -> Result<f64, IndenterError> {
        let closed = self.closed_radius(height);
        closed.map_or_else(|| contact_radius(self, height), Ok)
    }

    fn closed_position(&self, height: f64) -> Option<f64> {
        self.closed_radius(height)
    }

    fn height_at(&self, position: f64) -> f64 {
        self.line_height(position)
    }

    fn end(&self) -> f64 {
        self.max_radius()
    }

    fn apex_exponent(&self) -> f64 {
        self.profile_exponent()
    }

    fn is_exact_where_touched_again(&self) -> bool {
        true
    }
}
