//! Contacts that are hard to find, because some waves are ten thousand times as soft as others.

use bem_halfspace::periodic::steady_on_grid;
use bem_halfspace::{Grid, PeriodicLoad, PeriodicOptions};
use indenters::rough::SelfAffine;
use rheology::Prony;

use crate::support::prony;

/// Moduli of 1 and a ratio, with the relaxation time 1.
fn standard_solid(ratio: f64) -> Prony {
    prony([1.0, 0.0], &[(ratio - 1.0, 1.0)])
}

/// Asserts that a contact is found within a number of operator applications.
///
/// The surface has waves from a longest to a shortest one, slides on a solid under a mean pressure, and has the given number of elements
/// along each edge.
fn assert_found(
    (surface, n): ((f64, f64, f64, u64), usize),
    (material, mean_pressure, velocity): (&Prony, f64, f64),
    max_applications: usize,
) {
    let (longest, shortest, hurst_exponent, seed) = surface;
    let surface = SelfAffine {
        period: [1.0; 2],
        hurst_exponent,
        rms_slope: 0.1,
        longest_wavelength: longest * 1.000_000_1,
        shortest_wavelength: 0.999_999_9 / shortest,
        roll_off_wavelength: longest,
        seed,
    };
    let heights = surface.surface().expect("a surface").heights([n; 2]);
    let heights = heights.expect("heights");
    let load = PeriodicLoad::new(mean_pressure, velocity).expect("a load");
    let options = PeriodicOptions {
        max_applications,
        ..PeriodicOptions::default()
    };
    let grid = Grid::new([n; 2], [1.0 / n as f64; 2]).expect("a grid");
    let solved = steady_on_grid(&grid, &heights, material, &load, &options);
    assert!(solved.is_ok(), "{solved:?}");
}

/// Waves along the motion are so soft that removing tension from a contact displaces all others by more than they penetrate. Whether a
/// search fails by this depends on all digits.
#[test]
fn removed_tension_activates_no_other_elements() {
    assert_found(
        ((0.5, 11.0, 0.477_496_675_541_850_16, 93), 256),
        (
            &standard_solid(24_975.672_227_854_41),
            1.932_758_811_269_640_3,
            6.013_923_721_978_102e-4,
        ),
        300,
    );
}

/// The equations of a contact with few gaps need a Krylov basis of a hundred directions and more without truncation.
#[test]
fn a_dense_contact_needs_an_untruncated_basis() {
    assert_found(
        ((1.0, 7.0, 0.684, 187), 256),
        (&standard_solid(87_593.0), 22_092.0, 0.316_23),
        900,
    );
}

/// With few open elements the complement is solved directly.
#[test]
fn a_contact_with_few_gaps_is_found() {
    assert_found(
        ((0.5, 11.0, 0.477_496_675_541_850_16, 93), 192),
        (
            &standard_solid(83_252.240_759_514_7),
            37_725.957_633_804_41,
            5.905_513_392_777_748,
        ),
        600,
    );
}

/// A light contact of many patches, which the exchange rule must find together and not one after the other.
#[test]
fn isolated_exchanges_follow_non_improving_ones() {
    let dashpot = prony([1.0, 0.05], &[]);
    assert_found(
        ((0.5, 8.0, 0.458, 11), 256),
        (&dashpot, 1.972, 2112.0),
        1000,
    );
}
