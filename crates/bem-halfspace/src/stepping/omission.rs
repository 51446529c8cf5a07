//! What a march leaves out, so that what that saves can be measured.

use indenters::Surface;

use super::Stepping;
use crate::BemError;

/// A part of the work that [`slide`](crate::slide::slide) leaves out where a scene does not need it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SlideOmission {
    /// The elements of the footprint around the contact, while it is solved.
    OutsideContact,
    /// The displacement of the rows that the footprint has left behind for good.
    RowsBehind,
}

impl<S: Surface + ?Sized> Stepping<'_, S> {
    /// Does the work of an omission too. After a step that is refused: rows are left behind already, and the loads of
    /// the box would be lost.
    pub(crate) fn keep(&mut self, omission: SlideOmission) -> Result<(), BemError> {
        if self.steps_done > 0 {
            return Err(BemError::InvalidParameter {
                parameter: "steps done",
                value: self.steps_done as f64,
                allowed: "zero for a march that leaves out less",
            });
        }
        self.kept = Some(omission);
        if omission == SlideOmission::OutsideContact {
            self.contact_box = self.box_at_lowest(&self.heights)?;
        }
        Ok(())
    }
}
