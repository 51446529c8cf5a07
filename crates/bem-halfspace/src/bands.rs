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
    pub(crate) fn fold<const N: usize, R: Send>(
        &self,
        fields: [&mut [f64]; N],
        work: impl Fn(usize, [&mut [f64]; N]) -> R + Sync,
        combine: impl Fn(R, R) -> R + Sync,
    ) -> R {
        let unit = self.rows_per_band * self.shape[1];
        let fields = fields.map(|field| (field, unit));
        fold_parts(0..self.n_bands(), fields, &work, &combine)
    }

    /// Does the work of every band on its part of the fields.
    pub(crate) fn for_each<const N: usize>(
        &self,
        fields: [&mut [f64]; N],
        work: impl Fn(usize, [&mut [f64]; N]) + Sync,
    ) {
        self.fold(fields, work, |(), ()| ());
    }

    /// Sum of what the bands contribute, pairwise.
    pub(crate) fn sum(&self, work: impl Fn(usize) -> f64 + Sync) -> f64 {
        self.fold([], |band, []| work(band), |left, right| left + right)
    }
}

/// Does the work of every part of a range on its part of the fields, of which each has so many values per part.
///
/// The halves of the range are combined, and those are of their halves: the order is always the same.
pub(crate) fn fold_parts<const N: usize, R: Send>(
    parts: Range<usize>,
    fields: [(&mut [f64], usize); N],
    work: &(impl Fn(usize, [&mut [f64]; N]) -> R + Sync),
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

type Fields<'a, const N: usize> = [(&'a mut [f64], usize); N];

/// The fields before and behind so many parts.
fn split<const N: usize>(fields: Fields<N>, parts: usize) -> (Fields<N>, Fields<N>) {
    let mut behind = [(); N].map(|()| (<&mut [f64]>::default(), 0));
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
