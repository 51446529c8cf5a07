//! Transforms and spectra, which depend on sizes only: made once, and shared by the contacts, grids and shifts of a
//! problem.

use std::sync::Arc;

use crate::fast_length::fast_length;
use crate::plane_transform::PlaneTransform;
use crate::steady::filter::Spectrum;
use crate::steady::sliding_creep::ElementCreep;
use crate::steady::wake_table::WakeTable;
use crate::steady::wiener_hopf::InverseFactors;

/// Periods that are kept: the boxes of successive contacts have about the same size.
const KEPT: usize = 4;

/// The stationary kernel in Fourier space.
#[derive(Debug)]
pub(super) struct KernelSpectrum {
    pub(super) transform: PlaneTransform,
    pub(super) spectrum: Spectrum,
}

/// What depends on the creep over an element, on the aspect ratio of the elements and on the size of a box only.
#[derive(Debug, Default)]
pub(super) struct Plans {
    table: Arc<WakeTable>,
    kernels: Vec<Arc<KernelSpectrum>>,
    factors: Vec<Arc<InverseFactors>>,
}

impl Plans {
    /// Makes ready for boxes of up to `shape` elements and returns the table of the kernel.
    pub(super) fn cover(
        &mut self,
        creep: &ElementCreep,
        aspect: f64,
        shape: [usize; 2],
    ) -> Arc<WakeTable> {
        if !self.table.is_for(creep, aspect) {
            *self = Self::default();
        }
        let filtered = InverseFactors::period(shape);
        let reach = [0, 1].map(|axis| free_period(shape[axis]).max(filtered[axis]) / 2);
        WakeTable::cover(&mut self.table, creep, aspect, reach);
        Arc::clone(&self.table)
    }

    /// The kernel for loads and displacements within a box of `shape` elements.
    pub(super) fn kernel(&mut self, shape: [usize; 2]) -> Arc<KernelSpectrum> {
        let padded = shape.map(free_period);
        let table = &self.table;
        recent(
            &mut self.kernels,
            |kernel| kernel.transform.padded == padded,
            || {
                let transform = PlaneTransform::new(padded);
                let value = |row, column| table.at(signed_offset(row, padded[0]), column);
                let spectrum = transform.spectrum(value, |_, _| {});
                KernelSpectrum {
                    transform,
                    spectrum,
                }
            },
        )
    }

    /// The inverse Wiener–Hopf factors for a box of `shape` elements.
    pub(super) fn inverse_factors(&mut self, shape: [usize; 2]) -> Arc<InverseFactors> {
        let padded = InverseFactors::period(shape);
        let table = &self.table;
        recent(
            &mut self.factors,
            |factors| factors.transform.padded == padded,
            || InverseFactors::new(table, padded),
        )
    }
}

/// The kept item that matches, or a new one in the place of the oldest.
fn recent<T>(
    kept: &mut Vec<Arc<T>>,
    matches: impl Fn(&T) -> bool,
    make: impl FnOnce() -> T,
) -> Arc<T> {
    if let Some(item) = kept.iter().find(|item| matches(item)) {
        return Arc::clone(item);
    }
    if kept.len() == KEPT {
        kept.remove(0);
    }
    let item = Arc::new(make());
    kept.push(Arc::clone(&item));
    item
}

/// A period that is fast to transform and keeps `n` elements free of their images.
fn free_period(n: usize) -> usize {
    fast_length(2 * n - 1)
}

/// Offset of an index within a period, negative in its upper half.
pub(super) const fn signed_offset(index: usize, period: usize) -> isize {
    if index <= period / 2 {
        index.cast_signed()
    } else {
        index.cast_signed() - period.cast_signed()
    }
}
