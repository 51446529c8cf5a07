//! Transforms and spectra, which depend on sizes only: computed once, and shared by the active sets, grids and shifts of a problem.

use std::sync::Arc;

use crate::stationary::steady::filter::Filters;
use crate::stationary::steady::sliding_creep::ElementCreep;
use crate::stationary::steady::wake_table::WakeTable;
use crate::stationary::steady::wiener_hopf;
use crate::transform::fast_length::fast_length;
use crate::transform::plane_transform::PlaneTransform;
use crate::transform::plane_transform::complex_product::{Spectrum, signed_offset};

/// Number of transform periods whose spectra are kept. Chosen to limit the memory: beyond it the oldest spectra are dropped, and
/// computed anew when they are needed. The boxes of successive active sets have about the same size.
const MAX_CACHED_PERIODS: usize = 4;

/// Kernel tables and spectra, which depend only on the creep over an element, the aspect ratio of the elements and the size of a box.
#[derive(Debug, Default)]
pub(super) struct Plans {
    /// Influence coefficients up to the largest offsets so far.
    table: Arc<WakeTable>,
    /// Spectra of the kernel, by period.
    kernels: Vec<Arc<Filters<1>>>,
    /// Spectra of the inverse Wiener–Hopf factors, by period.
    factors: Vec<Arc<Filters<2>>>,
}

impl Plans {
    /// Extends the table of the kernel to boxes of up to `shape` elements, and returns it. Tables and spectra of another creep or
    /// aspect ratio are dropped.
    pub(super) fn prepare(
        &mut self,
        creep: &ElementCreep,
        aspect: f64,
        shape: [usize; 2],
    ) -> Arc<WakeTable> {
        // Tables and spectra for another creep or aspect ratio are of no use, and are dropped.
        let is_other_aspect = self.table.aspect.total_cmp(&aspect).is_ne();
        if is_other_aspect || self.table.creep != *creep {
            *self = Self::default();
        }
        let factor_period = wiener_hopf::period(shape);
        let max_offsets =
            [0, 1].map(|axis| padded_length(shape[axis]).max(factor_period[axis]) / 2);
        WakeTable::cover(&mut self.table, creep, aspect, max_offsets);
        Arc::clone(&self.table)
    }

    /// Spectrum of the kernel for loads and displacements within a box of `shape` elements, cached by period.
    pub(super) fn kernel(&mut self, shape: [usize; 2]) -> Arc<Filters<1>> {
        let (padded, table) = (shape.map(padded_length), &self.table);
        cached(&mut self.kernels, padded, |transform| {
            let value = |row, column| table.displacement(signed_offset(row, padded[0]), column);
            [transform.spectrum(value, |_, _| {})]
        })
    }

    /// Spectra of the inverse Wiener–Hopf factors for a box of `shape` elements, cached by period.
    pub(super) fn inverse_factors(&mut self, shape: [usize; 2]) -> Arc<Filters<2>> {
        let (padded, table) = (wiener_hopf::period(shape), &self.table);
        cached(&mut self.factors, padded, |transform| {
            wiener_hopf::inverse_factors(table, transform)
        })
    }
}

/// The filters of the period `padded` from the cache `kept`, or new ones from `spectra(transform)`, which replace the oldest if the
/// cache is full.
fn cached<const N: usize>(
    kept: &mut Vec<Arc<Filters<N>>>,
    padded: [usize; 2],
    spectra: impl FnOnce(&PlaneTransform) -> [Spectrum; N],
) -> Arc<Filters<N>> {
    let same_period = |filters: &&Arc<Filters<N>>| filters.transform.padded == padded;
    if let Some(filters) = kept.iter().find(same_period) {
        return Arc::clone(filters);
    }
    if kept.len() == MAX_CACHED_PERIODS {
        kept.remove(0);
    }
    let transform = PlaneTransform::new(padded);
    let spectra = spectra(&transform);
    let filters = Arc::new(Filters { transform, spectra });
    kept.push(Arc::clone(&filters));
    filters
}

/// A period that is fast to transform, and long enough that `n` elements are not affected by their periodic images.
fn padded_length(n: usize) -> usize {
    fast_length(2 * n - 1)
}
