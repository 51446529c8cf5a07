//! The load of a contact.

/// One value per element, zero at first.
#[derive(Debug, Clone)]
pub(super) struct Load {
    values: Vec<f64>,
    is_touched: bool,
}

impl Load {
    pub(super) fn new(n_elements: usize) -> Self {
        Self {
            values: vec![0.0; n_elements],
            is_touched: false,
        }
    }

    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    pub(super) fn values_mut(&mut self) -> &mut [f64] {
        self.is_touched = true;
        &mut self.values
    }

    /// The values, unless nothing was ever written to them: they are zero then, and the system would have to provide
    /// their memory page by page for whoever reads them.
    pub(super) fn touched(&self) -> Option<&[f64]> {
        self.is_touched.then_some(&self.values)
    }
}
