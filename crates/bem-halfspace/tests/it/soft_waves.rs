//! Contacts that are hard to find, because some waves are ten thousand times as soft as others.

use bem_halfspace::periodic::steady_on_grid;
use bem_halfspace::{Grid, PeriodicLoad, PeriodicOptions};
use indenters::rough::SelfAffine;

use crate::support::prony;

/// Waves along the motion are so soft that the tension that is taken from a contact moves all others by more than they penetrate;
/// whether a search goes astray by it depends on all digits.
#[test]
fn what_is_taken_from_a_contact_brings_no_others_in() {
    let surface = SelfAffine {
        period: [1.0; 2],
        hurst_exponent: 0.477_496_675_541_850_16,
        rms_slope: 0.1,
        longest_wavelength: 0.5 * 1.000_000_1,
        shortest_wavelength: 0.999_999_9 / 11.0,
        roll_off_wavelength: 0.5,
        seed: 93,
    };
    let n = 256;
    let heights = surface.surface().expect("a surface").heights([n; 2]);
    let heights = heights.expect("heights");
    let material = prony([1.0, 0.0], &[(24_975.672_227_854_41 - 1.0, 1.0)]);
    let load = PeriodicLoad::new(1.932_758_811_269_640_3, 6.013_923_721_978_102e-4);
    let options = PeriodicOptions {
        max_products: 300,
        ..PeriodicOptions::default()
    };
    let load = load.expect("a load");
    let grid = Grid::new([n; 2], [1.0 / n as f64; 2]).expect("a grid");
    let solved = steady_on_grid(&grid, &heights, &material, &load, &options);
    assert!(solved.is_ok(), "{solved:?}");
}
