//! Work on parts of fields, side by side where there are threads, with results that do not depend on their number.

use std::ops::Range;

/// Smaller bands would cost more to hand out than to work on.
const MIN_ELEMENTS: usize = 1 << 13;

/// The rows of a grid in bands, which depend on the shape of the grid alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bands {
    shape: [usize; 2],
    /// Even, so that blocks of two by two elements lie in one band.
    rows_per_band: usize,
}

impl Bands {
    pub(crate) const fn new(shape: [usize; 2]) -> Self {
        Self {
            shape,
            rows_per_band: 2 * MIN_ELEMENTS.div_ceil(2 * shape[1]),
        }
    }

    pub(crate) const fn rows_per_band(&self) -> usize {
        self.rows_per_band
    }

    pub(crate) const fn n_bands(&self) -> usize {
        self.shape[0].div_ceil(self.rows_per_band)
    }

    /// The rows of a band.
    pub(crate) fn rows(&self, band: usize) -> Range<usize> {
        let start = band * self.rows_per_band;
        start..(start + self.rows_per_band).min(self.shape[0])
    }

    /// The elements of a band.
    pub(crate) fn elements(&self, band: usize) -> Range<usize> {
        let rows = self.rows(band);
        rows.start * self.shape[1]..rows.end * self.shape[1]
    }

    /// Does the work of every band on its part of the fields, which have one value per element.
    pub(crate) fn fold<const N: usize, T: Send, R: Send>(
        &self,
        fields: [&mut [T]; N],
        work: impl Fn(usize, [&mut [T]; N]) -> R + Sync,
        combine: impl Fn(R, R) -> R + Sync,
    ) -> R {
        let unit = self.rows_per_band * self.shape[1];
        let fields = fields.map(|field| (field, unit));
        fold_parts(0..self.n_bands(), fields, &work, &combine)
    }

    /// Does the work of every band on its part of the fields.
    pub(crate) fn for_each<const N: usize, T: Send>(
        &self,
        fields: [&mut [T]; N],
        work: impl Fn(usize, [&mut [T]; N]) + Sync,
    ) {
        self.fold(fields, work, |(), ()| ());
    }

    /// What the bands contribute, combined pairwise.
    pub(crate) fn gather<R: Send>(
        &self,
        work: impl Fn(usize) -> R + Sync,
        combine: impl Fn(R, R) -> R + Sync,
    ) -> R {
        self.fold::<0, (), R>([], |band, []| work(band), combine)
    }

    /// Sum of what the bands contribute.
    pub(crate) fn sum(&self, work: impl Fn(usize) -> f64 + Sync) -> f64 {
        self.gather(work, |left, right| left + right)
    }
}

/// Does the work of every part of a range on its part of the fields, of which each has so many values per part.
///
/// The halves of the range are combined, and those are of their halves: the order is always the same.
pub(crate) fn fold_parts<const N: usize, T: Send, R: Send>(
    parts: Range<usize>,
    fields: Fields<T, N>,
    work: &(impl Fn(usize, [&mut [T]; N]) -> R + Sync),
    combine: &(impl Fn(R, R) -> R + Sync),
) -> R {
    if parts.len() <= 1 {
        return work(parts.start, fields.map(|(field, _)| field));
    }
    let middle = parts.start + parts.len() / 2;
    let (lower, upper) = split(fields, middle - parts.start);
    let (left, right) = join(
        || fold_parts(parts.start..middle, lower, work, combine),
        || fold_parts(middle..parts.end, upper, work, combine),
    );
    combine(left, right)
}

/// Fields, and how many values of each belong to a part.
type Fields<'a, T, const N: usize> = [(&'a mut [T], usize); N];

/// The fields before and behind so many parts.
fn split<T, const N: usize>(fields: Fields<T, N>, parts: usize) -> (Fields<T, N>, Fields<T, N>) {
    let mut behind = [(); N].map(|()| (<&mut [T]>::default(), 0));
    let mut slots = behind.iter_mut();
    let before = fields.map(|(field, unit)| {
        let (lower, upper) = field.split_at_mut(parts * unit);
        if let Some(slot) = slots.next() {
            *slot = (upper, unit);
        }
        (lower, unit)
    });
    (before, behind)
}

/// Copies of a value, first touched by the threads that share the memory from then on.
#[cfg(feature = "rayon")]
pub(crate) fn copies<T: Copy + Send + Sync>(value: T, count: usize) -> Vec<T> {
    use rayon::prelude::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
    let mut values = Vec::new();
    let numbers = (0..count).into_par_iter().with_min_len(MIN_ELEMENTS);
    numbers.map(|_| value).collect_into_vec(&mut values);
    values
}

/// Copies of a value.
#[cfg(not(feature = "rayon"))]
pub(crate) fn copies<T: Copy>(value: T, count: usize) -> Vec<T> {
    vec![value; count]
}

#[cfg(feature = "rayon")]
fn join<L: Send, R: Send>(
    left: impl FnOnce() -> L + Send,
    right: impl FnOnce() -> R + Send,
) -> (L, R) {
    rayon::join(left, right)
}

#[cfg(not(feature = "rayon"))]
fn join<L, R>(left: impl FnOnce() -> L, right: impl FnOnce() -> R) -> (L, R) {
    (left(), right())
}
