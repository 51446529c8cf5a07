//! Detection of equally spaced coordinates in a column of a file: exact, rounded to their digits, or with gaps.

use numerics::whole_part;

/// Largest ratio of the deviation of an exact coordinate from its node to the spacing. Chosen: a larger one may be rounding of
/// the written digits, which is tried next.
const EXACT_TOLERANCE: f64 = 0.01;
/// Largest ratio of the deviation of a rounded coordinate from its node to the spacing. Chosen; a gap makes it 0.5.
const MAX_ROUNDING_TOLERANCE: f64 = 0.3;
/// Ratio of the distance of two coordinates to the range of all up to which they count as equal. Chosen: a grid has at most a
/// million nodes along an axis.
const DUPLICATE_TOLERANCE: f64 = 1e-6;

/// Equally spaced coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    /// First coordinate.
    pub(super) first: f64,
    /// Distance between two nodes.
    pub(super) step: f64,
    /// Number of nodes.
    pub(super) count: usize,
    /// Largest deviation of a coordinate from its node, in the unit of the coordinates.
    tolerance: f64,
}

impl Axis {
    /// Axis of coordinates in any order, written with a number of `significant` digits.
    ///
    /// Candidates for the number of intervals are that of different coordinates, then those by the median and the smallest
    /// distance, which differ if points are left out. Rounded coordinates take the smallest number for which at most half of
    /// the nodes are empty.
    ///
    /// # Errors
    /// A description of coordinates that are not equally spaced.
    pub(super) fn of(mut values: Vec<f64>, significant: i32) -> Result<Self, String> {
        values.sort_by(f64::total_cmp);
        let ends = values.first().copied().zip(values.last().copied());
        let (first, last) = ends.ok_or("no points")?;
        let range = last - first;
        // The resolution of written coordinates is one unit of the last digit of the largest one.
        let digits = first.abs().max(last.abs()).log10().floor();
        let resolution = 10.0_f64.powf(digits + 1.0 - f64::from(significant));
        values.dedup_by(|next, before| *next - *before <= DUPLICATE_TOLERANCE * range);
        let mut steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.sort_by(f64::total_cmp);
        let (Some(smallest), true) = (steps.first().copied(), range > 0.0) else {
            return Err(format!(
                "coordinates from {first} to {last}, where a grid has two or more"
            ));
        };
        let (median, n_intervals) = (steps[steps.len() / 2], steps.len());
        let axis = |count: f64, tolerance: f64| Self {
            first,
            step: range / count,
            count: whole_part(count) + 1,
            tolerance,
        };
        let exact = [n_intervals as f64, range / median, range / smallest]
            .map(f64::round)
            .into_iter()
            .filter(|count| count.is_finite())
            .map(|count| axis(count, EXACT_TOLERANCE * range / count));
        // Rounded coordinates do not show their spacing exactly, so try all numbers of intervals up to twice the smallest.
        let rounded = (n_intervals..=2 * n_intervals).map(|count| {
            let count = count as f64;
            axis(
                count,
                resolution.min(MAX_ROUNDING_TOLERANCE * range / count),
            )
        });
        let found = exact
            .chain(rounded)
            .find(|axis| axis.has_distinct_nodes(&values));
        found.ok_or_else(|| Self::irregular(&values, range))
    }

    /// Whether all coordinates, which are different and increase, lie on different nodes.
    fn has_distinct_nodes(&self, values: &[f64]) -> bool {
        let nodes: Option<Vec<usize>> = values.iter().map(|value| self.node(*value)).collect();
        nodes.is_some_and(|nodes| nodes.windows(2).all(|pair| pair[0] < pair[1]))
    }

    /// Index of the node at a coordinate; `None` if the coordinate is off the grid.
    pub(super) fn node(&self, value: f64) -> Option<usize> {
        let node = (value - self.first) / self.step;
        let deviation = (node - node.round()).abs() * self.step;
        // Allow for the rounding of the step itself, which comes from the first and the last coordinate.
        let edge_rounding = 1e-9 * self.step;
        (deviation <= self.tolerance + edge_rounding).then(|| whole_part(node.round().max(0.0)))
    }

    /// Description of coordinates off any grid, with the one of the largest deviation.
    fn irregular(values: &[f64], range: f64) -> String {
        let step = range / (values.len() - 1) as f64;
        let deviation =
            |(index, value): &(usize, &f64)| (*value - values[0] - *index as f64 * step).abs();
        let nodes = values.iter().enumerate();
        let worst = nodes.max_by(|one, other| deviation(one).total_cmp(&deviation(other)));
        let value = worst.map_or(values[0], |(_, value)| *value);
        format!(
            "coordinates as {value} beside a grid of {step:e}; interpolate scattered points to a grid first"
        )
    }
}

/// Number of significant digits of a number in a text: those of its mantissa without leading zeros.
#[cfg(any(test, feature = "topography"))]
pub(super) fn significant_digits(cell: &str) -> i32 {
    let (mantissa, _) = cell.split_once(['e', 'E']).unwrap_or((cell, ""));
    let digits = mantissa.bytes().filter(u8::is_ascii_digit);
    i32::try_from(digits.skip_while(|digit| *digit == b'0').count()).unwrap_or(i32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(step: f64, nodes: impl Iterator<Item = u32>, digits: usize) -> Result<Axis, String> {
        let cells = nodes.map(|node| format!("{:.digits$e}", f64::from(node) * step));
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
                let nodes = (0..48).filter(|node| *node != gap);
                let axis = written(step, nodes, digits).expect("an axis");
                let count = if gap == 0 { 47 } else { 48 };
                let off = axis.step / step - 1.0;
                assert!(
                    axis.count == count && off.abs() < 5e-3,
                    "{digits} digits, {gap}: {axis:?}"
                );
            }
        }
        let scattered = (0..20).map(|node| f64::from(node) + 0.1 * f64::from(node * node % 7));
        Axis::of(scattered.collect(), 9).expect_err("no grid");
        Axis::of(vec![1.0, 1.0], 1).expect_err("one column");
    }
}
