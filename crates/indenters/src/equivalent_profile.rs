//! What the force of a pressed body depends on.

use crate::{Axisymmetric, IndenterError, contact_radius};

/// The profile g(x) which springs side by side resist with the force of a body at every depth: of a body of revolution on a
/// half space its equivalent line (Heß 2011), on a layer another one.
pub trait EquivalentProfile: Send + Sync {
    /// Position x ≥ 0 at which it has a `height` > 0, \[m].
    ///
    /// # Errors
    /// [`IndenterError`] where it has none.
    fn position(&self, height: f64) -> Result<f64, IndenterError>;

    /// The same where it is known without a search, of a height up to one that has a position.
    fn closed_position(&self, height: f64) -> Option<f64>;

    /// Height at a position ≥ 0, \[m]; `+∞` where it has ended.
    fn height_at(&self, position: f64) -> f64;

    /// Where it ends, \[m]; `+∞` if it does not.
    fn end(&self) -> f64;

    /// Leading exponent p of g ∼ x^p; `+∞` for a flat end.
    fn apex_exponent(&self) -> f64;

    /// Whether the springs also stand for a surface that the body has left and touches again.
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
