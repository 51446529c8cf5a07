//! Equally spaced coordinates, as columns of a file hold them: exact, rounded to their digits, or with gaps.

use numerics::whole_part;

/// Part of a spacing by which an exact coordinate may miss its place.
const MISS: f64 = 0.01;
/// Part of a spacing by which a rounded coordinate may miss its place: with a gap it would be half a spacing.
const MOST_ROUNDED: f64 = 0.3;
/// Part of the range of coordinates within which two are the same.
const SAME: f64 = 1e-6;

/// Equally spaced coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    pub(super) first: f64,
    pub(super) step: f64,
    pub(super) count: usize,
    /// By how much a coordinate may miss its place.
    tolerance: f64,
}

impl Axis {
    /// The axis of coordinates in any order, written with so many `significant` digits: with as many points as there are
    /// different coordinates, or, where some are left out, with their median or smallest distance; rounded coordinates with the
    /// fewest points of which no more than a half are left out.
    ///
    /// # Errors
    /// What is wrong with coordinates that are not equally spaced.
    pub(super) fn of(mut values: Vec<f64>, significant: i32) -> Result<Self, String> {
        values.sort_by(f64::total_cmp);
        let ends = values.first().copied().zip(values.last().copied());
        let (first, last) = ends.ok_or("no points")?;
        let range = last - first;
        // One unit of the last digit of the largest.
        let digits = first.abs().max(last.abs()).log10().floor();
        let resolution = 10.0_f64.powf(digits + 1.0 - f64::from(significant));
        values.dedup_by(|next, before| *next - *before <= SAME * range);
        let mut steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.sort_by(f64::total_cmp);
        let (Some(smallest), true) = (steps.first().copied(), range > 0.0) else {
            return Err(format!(
                "coordinates from {first} to {last}, where a grid has two or more"
            ));
        };
        let (median, fewest) = (steps[steps.len() / 2], steps.len());
        let axis = |count: f64, tolerance: f64| Self {
            first,
            step: range / count,
            count: whole_part(count) + 1,
            tolerance,
        };
        let likely = [fewest as f64, range / median, range / smallest].map(f64::round);
        let likely = likely.into_iter().filter(|count| count.is_finite());
        let exact = likely.map(|count| axis(count, MISS * range / count));
        // Rounding hides the distance of neighbours.
        let rounded = (fewest..=2 * fewest).map(|count| {
            let count = count as f64;
            axis(count, resolution.min(MOST_ROUNDED * range / count))
        });
        let found = exact.chain(rounded).find(|axis| axis.has_all(&values));
        found.ok_or_else(|| Self::irregular(&values, range))
    }

    /// Whether all coordinates, which are different, have places of their own.
    fn has_all(&self, values: &[f64]) -> bool {
        let places: Option<Vec<usize>> = values.iter().map(|value| self.place(*value)).collect();
        places.is_some_and(|places| places.windows(2).all(|pair| pair[0] < pair[1]))
    }

    /// The place of a coordinate, counted from 0; `None` if it is beside the grid.
    pub(super) fn place(&self, value: f64) -> Option<usize> {
        let place = (value - self.first) / self.step;
        let miss = (place - place.round()).abs() * self.step;
        // Of the first and last coordinate the rounding is a part, too.
        let slack = 1e-9 * self.step;
        (miss <= self.tolerance + slack).then(|| whole_part(place.round().max(0.0)))
    }

    fn irregular(values: &[f64], range: f64) -> String {
        let step = range / (values.len() - 1) as f64;
        let miss =
            |(index, value): &(usize, &f64)| (*value - values[0] - *index as f64 * step).abs();
        let places = values.iter().enumerate();
        let worst = places.max_by(|one, other| miss(one).total_cmp(&miss(other)));
        let value = worst.map_or(values[0], |(_, value)| *value);
        format!(
            "coordinates as {value} beside a grid of {step:e}; interpolate scattered points to a grid first"
        )
    }
}

/// Digits of a number from the first that is not 0 on.
#[cfg(any(test, feature = "topography"))]
pub(super) fn significant_digits(cell: &str) -> i32 {
    let (mantissa, _) = cell.split_once(['e', 'E']).unwrap_or((cell, ""));
    let digits = mantissa.bytes().filter(u8::is_ascii_digit);
    i32::try_from(digits.skip_while(|digit| *digit == b'0').count()).unwrap_or(i32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(
        step: f64,
        places: impl Iterator<Item = u32>,
        digits: usize,
    ) -> Result<Axis, String> {
        let cells = places.map(|place| format!("{:.digits$e}", f64::from(place) * step));
        let cells: Vec<String> = cells.collect();
        let significant = cells.iter().map(|cell| significant_digits(cell)).max();
        let values = cells.iter().map(|cell| cell.parse().expect("a number"));
        Axis::of(values.collect(), significant.unwrap_or(0))
    }

    #[test]
    fn rounded_coordinates_and_gaps_have_the_spacing_of_the_grid() {
        for (digits, step) in [
            (2, 1.037e-6),
            (3, 1.037e-6),
            (5, 7.0 / 3.0),
            (9, 0.1),
            (15, 0.1),
        ] {
            for gap in [99, 0, 1, 20, 46] {
                let places = (0..48).filter(|place| *place != gap);
                let axis = written(step, places, digits).expect("an axis");
                let count = if gap == 0 { 47 } else { 48 };
                let off = axis.step / step - 1.0;
                assert!(
                    axis.count == count && off.abs() < 5e-3,
                    "{digits} digits, {gap}: {axis:?}"
                );
            }
        }
        let scattered = (0..20).map(|place| f64::from(place) + 0.1 * f64::from(place * place % 7));
        Axis::of(scattered.collect(), 9).expect_err("no grid");
        Axis::of(vec![1.0, 1.0], 1).expect_err("one column");
    }
}
