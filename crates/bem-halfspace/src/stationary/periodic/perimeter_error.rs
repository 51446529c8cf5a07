//! Error of the contact area after the perimeter correction.
//!
//! Counted areas are corrected by the mean excess of an edge over all directions of the contact boundary (`elements/area.rs`).
//! The directions on a rough surface are not quite uniform, and unidirectional roughness (grooves) has only one. Let a line pass
//! a elements along x while it passes b along y. The centres of elements then lie on lines parallel to it that are 1/(a + b) of
//! an edge apart. The area is unknown by half of that at every edge.
//!
//! Theory: docs/theory/rough-surfaces.md.

use indenters::rough::{PeriodicSurface, Wave};
use numerics::Estimate;

use crate::Grid;
use crate::elements::area::{self, EXCESS_PER_EDGE};

/// Remaining error of the area of a rough contact, as a fraction of the perimeter correction.
///
/// Measured on 821 contacts, with four to 16 elements per shortest wave on the coarsest of three grids. Two differ by more than
/// this error and the changes on refinement together, and 93 by more than the changes alone. It has a case of `evidence tuning`.
const REMAINING_FRACTION: f64 = 0.15;

/// Fraction of the period in contact, with the error of its perimeter correction.
pub(crate) fn area_fraction(grid: &Grid, pressure: &[f64], surface: &PeriodicSurface) -> Estimate {
    let found = area::area_fraction(grid.shape()[1], pressure);
    let part = match groove_direction(surface, grid) {
        Some([along_x, along_y]) => 0.5 / (EXCESS_PER_EDGE * (along_x + along_y) as f64),
        None => 0.0,
    };
    let error = REMAINING_FRACTION.max(part) * found.perimeter_correction;
    Estimate::new(found.area, error)
}

/// Direction of the lines of unidirectional roughness: the numbers [a, b] of elements along x and y, without a common factor,
/// that a line passes (head of this file).
///
/// `None` if other waves displace the contact boundary by more than half an element, so that it passes other elements.
fn groove_direction(surface: &PeriodicSurface, grid: &Grid) -> Option<[usize; 2]> {
    // The grooves are the waves with the direction of the steepest one.
    let slope = |wave: &Wave| {
        let [x, y] = surface.wave_vector(wave);
        wave.amplitude.abs() * x.hypot(y)
    };
    let waves = surface.waves();
    let steepest = waves
        .iter()
        .max_by(|one, other| slope(one).total_cmp(&slope(other)))?;
    let [n, m] = steepest.numbers.map(i64::from);
    let is_along = |wave: &&Wave| m * i64::from(wave.numbers[0]) == n * i64::from(wave.numbers[1]);
    let (along, others): (Vec<Wave>, Vec<Wave>) = waves.iter().partition(is_along);
    // The other waves displace the boundary by their height over the slope of the grooves. If that is too much, it is not straight.
    let with_waves = |waves: Vec<Wave>| PeriodicSurface::new(surface.period(), waves);
    let other_height = with_waves(others).map_or(0.0, |others| others.rms_height());
    let [dx, dy] = grid.spacing();
    if other_height > 0.5 * dx.max(dy) * with_waves(along).ok()?.rms_slope() {
        return None;
    }
    let [rows, columns] = grid.shape();
    let [n, m] = steepest
        .numbers
        .map(|number| number.unsigned_abs() as usize);
    // A line passes these numbers of elements over whole periods. Divide both by their greatest common divisor (Euclid).
    let passed = [m * rows, n * columns];
    let (mut divisor, mut remainder) = (passed[0], passed[1]);
    while remainder > 0 {
        (divisor, remainder) = (remainder, divisor % remainder);
    }
    Some(passed.map(|elements| elements / divisor))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passed(waves: &[([i32; 2], f64)], shape: [usize; 2]) -> Option<[usize; 2]> {
        let wave = |(numbers, amplitude): &([i32; 2], f64)| Wave {
            numbers: *numbers,
            amplitude: *amplitude,
            phase: 0.3,
        };
        let waves = waves.iter().map(wave).collect();
        let surface = PeriodicSurface::new([1.0; 2], waves).expect("a surface");
        let grid = Grid::new(shape, shape.map(|n| 1.0 / n as f64)).expect("a grid");
        groove_direction(&surface, &grid)
    }

    #[test]
    fn lines_of_grooves_pass_elements_in_proportion() {
        assert_eq!(passed(&[([3, 0], 1.0)], [64, 8]), Some([0, 1]));
        assert_eq!(passed(&[([0, -2], 1.0)], [8, 64]), Some([1, 0]));
        assert_eq!(
            passed(&[([2, -1], 1.0), ([-6, 3], 0.1)], [64; 2]),
            Some([1, 2])
        );
        assert_eq!(passed(&[([1, 1], 1.0)], [64, 32]), Some([2, 1]));
    }

    /// A hundredth of the waves across moves their outline by a tenth of the coarse elements, and by more than one of the fine ones.
    #[test]
    fn roughness_across_grooves_bends_them_on_fine_grids() {
        let waves = [([1, 0], 1.0), ([2, 5], 0.01)];
        assert_eq!(passed(&waves, [64; 2]), Some([0, 1]));
        assert_eq!(passed(&waves, [1024; 2]), None);
        assert_eq!(passed(&[([1, 0], 1.0), ([0, 1], 0.9)], [64; 2]), None);
    }
}
