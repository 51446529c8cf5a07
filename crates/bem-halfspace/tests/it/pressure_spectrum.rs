//! The parts of a dissipated power by frequency are those of the waves of the pressure.

use std::f64::consts::{PI, TAU};

use bem_halfspace::slide::PressureField;
use bem_halfspace::{Grid, Layer};
use rheology::{KelvinVoigt, Material, StationaryCreep, StressBand};

use crate::support::{assert_near, viscous};

fn below(bands: &[StressBand], material: &dyn Material, frequency: f64) -> f64 {
    let window = [frequency, f64::INFINITY];
    let parts = StationaryCreep::from(material.creep()).outside_window(window, bands.to_vec());
    let parts = parts.expect("something is dissipated");
    assert_near((frequency, "above"), parts.above, 0.0, 0.0);
    parts.below
}

/// The waves of Hertz' pressure are (sin s − s cos s)/s³ with s = |q| a; of a Kelvin–Voigt material that is slow the power of a
/// wave goes like ω², and of a dashpot it does not depend on ω. The parts with ω < κ v/a by quadrature over the waves (Python, the
/// midpoint rule with 400 000 values of s below 400).
const HERTZ: [[f64; 3]; 4] = [
    [0.3, 0.006_571, 0.341_29],
    [1.0, 0.128_520, 0.716_74],
    [2.0, 0.482_195, 0.931_65],
    [4.0, 0.806_226, 0.995_45],
];

#[test]
fn waves_of_hertz_pressure_dissipate_as_theory_says() {
    let n = 60;
    let spacing = 2.0 / f64::from(n);
    let grid = Grid::new([60; 2], [spacing; 2]).expect("a grid");
    let at = |k: i32| spacing * (f64::from(k) + 0.5) - 1.0;
    let places = (0..n).flat_map(|row| (0..n).map(move |column| [at(row), at(column)]));
    let pressure = places.map(|[x, y]| (1.0 - x * x - y * y).max(0.0).sqrt());
    let field = PressureField {
        grid,
        origin: [at(0); 2],
        pressure: pressure.collect(),
    };
    let velocity = 1e-3;
    let slow = KelvinVoigt::new(1e6, 1.0).expect("a material");
    let fluid = viscous(1e4);
    for [wave, solid, liquid] in HERTZ {
        let bands = field.spectrum(&slow, velocity);
        // Bands blur what is in one of them, which is more where long waves dissipate as much as short ones.
        assert_near(
            (wave, "solid"),
            below(&bands, &slow, wave * velocity),
            solid,
            0.01,
        );
        let bands = field.spectrum(&fluid, velocity);
        assert_near(
            (wave, "fluid"),
            below(&bands, &fluid, wave * velocity),
            liquid,
            0.03,
        );
    }
}

/// A layer resists long waves: of two waves of equal pressure on a thin one the long one dissipates (|q|t)³ of what it does on a
/// half space.
#[test]
fn each_wave_of_a_period_has_one_frequency() {
    let n = 32;
    let grid = Grid::new([32, 4], [1.0 / 32.0; 2]).expect("a grid");
    let waves = |row: i32| {
        let x = TAU * f64::from(row) / f64::from(n);
        3.0 + x.cos() + (8.0 * x).cos()
    };
    let field = PressureField {
        grid,
        origin: [0.0; 2],
        pressure: (0..n).flat_map(|row| [waves(row); 4]).collect(),
    };
    let solid = KelvinVoigt::new(1e6, 1.0).expect("a material");
    // Power goes like ω² 1/|q|: of the waves 1 and 8 that is 1/9 and 8/9.
    let part = |frequency: f64| below(&field.periodic_spectrum(&solid, 2.0), &solid, frequency);
    assert_near("below the long wave", part(3.99 * PI), 0.0, 1e-9);
    assert_near("between them", part(4.01 * PI), 1.0 / 9.0, 1e-9);
    assert_near("above the short one", part(32.01 * PI), 1.0, 1e-9);
    let thickness = 0.01;
    let layer = Layer::new(&solid, thickness).expect("a layer");
    let [long, short] = [1.0, 8.0].map(|wave| {
        let length = TAU * wave;
        wave * bem_halfspace::layer_factor(length * thickness, 0.5)
    });
    let on_layer = below(&field.periodic_spectrum(&layer, 2.0), &solid, 4.01 * PI);
    assert_near("on a layer", on_layer, long / (long + short), 1e-9);
}
