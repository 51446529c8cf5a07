//! What the outline of a contact by elements leaves unknown of its area.
//!
//! Counted areas are corrected by the mean excess of an edge over all directions of the outline. Those of a rough surface are not
//! spread quite evenly. The outlines of grooves have only one direction: where a line passes a elements along x while it passes b
//! along y, the centres of elements lie on lines beside it that are 1/(a + b) of an edge apart, and the area is unknown by half of
//! that at every edge.

use indenters::rough::{PeriodicSurface, Wave};
use numerics::Estimate;

use crate::elements::area::{self, EXCESS_PER_EDGE};
use crate::{Grid, PressureField};

/// Part of the excess by which the areas of rough contacts still differ: of 821 of them, with four to 16 elements per shortest wave
/// on the coarsest of three grids, two differ by more than this and what the refinements changed, and 93 without it.
const PART_OF_EXCESS: f64 = 0.15;
/// Elements by which other waves move the outline of grooves, up to which it stays straight.
const STRAIGHT: f64 = 0.5;

/// The part of the period in contact, and what the outline leaves unknown of it.
pub(super) fn area_fraction(field: &PressureField, surface: &PeriodicSurface) -> Estimate {
    let found = area::area_fraction(field.grid.shape()[1], &field.pressure);
    let part = match grooves(surface, &field.grid) {
        Some([along_x, along_y]) => 0.5 / (EXCESS_PER_EDGE * (along_x + along_y) as f64),
        None => 0.0,
    };
    Estimate::new(found.area, PART_OF_EXCESS.max(part) * found.excess)
}

/// Elements along x and y, without a common factor, which the lines of a surface pass that has only grooves, as far as the grid tells.
fn grooves(surface: &PeriodicSurface, grid: &Grid) -> Option<[usize; 2]> {
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
    let of = |waves: Vec<Wave>| PeriodicSurface::new(surface.period(), waves);
    let moved = of(others).map_or(0.0, |others| others.rms_height());
    let [dx, dy] = grid.spacing();
    if moved > STRAIGHT * dx.max(dy) * of(along).ok()?.rms_slope() {
        return None;
    }
    let [rows, columns] = grid.shape();
    let [n, m] = steepest
        .numbers
        .map(|number| number.unsigned_abs() as usize);
    let passed = [m * rows, n * columns];
    let (mut common, mut rest) = (passed[0], passed[1]);
    while rest > 0 {
        (common, rest) = (rest, common % rest);
    }
    Some(passed.map(|elements| elements / common))
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
        grooves(&surface, &grid)
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
