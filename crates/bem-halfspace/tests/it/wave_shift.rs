//! Times and moduli that depend on the wavelength of the pressure.

#![cfg(feature = "rough")]

use std::f64::consts::PI;

use bem_halfspace::indenters::rough::{PeriodicSurface, Wave};
use bem_halfspace::indenters::{PowerProfile, PressingLoad, SlidingLoad};
use bem_halfspace::periodic::sensitivity::PeriodicSensitivity;
use bem_halfspace::{
    BemError, Control, Layer, PeriodicLoad, ShiftOfWave, WaveShift, indent, periodic, slide, steady,
};
use rheology::{Material, StandardSolid, StandardSolidParameters};

const PERIOD: f64 = 1e-3;
const VELOCITY: f64 = 0.05;

fn solid() -> StandardSolid {
    StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: 1e6,
        maxwell_modulus: 4e6,
        viscosity: 4e6 * 5e-3,
    })
    .expect("a material")
}

/// Wave numbers in periods, amplitude \[m], and factors of times and moduli of two waves.
const WAVES: [([i32; 2], f64, [f64; 2]); 2] =
    [([1, 0], 4e-6, [1.0, 1.0]), ([3, 2], 1e-6, [0.1, 1.5])];

/// Wave numbers q_x and |q|, \[rad/m].
fn wave_numbers(numbers: [i32; 2]) -> [f64; 2] {
    let [q_x, q_y] = numbers.map(|number| 2.0 * PI * f64::from(number) / PERIOD);
    [q_x, q_x.hypot(q_y)]
}

fn shift() -> WaveShift {
    let of_wave = |(numbers, _, [time_factor, modulus_factor]): &([i32; 2], f64, [f64; 2])| {
        let [_, wave_number] = wave_numbers(*numbers);
        ShiftOfWave {
            wave_number,
            time_factor: *time_factor,
            modulus_factor: *modulus_factor,
        }
    };
    WaveShift::new(&WAVES.iter().map(of_wave).collect::<Vec<_>>()).expect("a shift")
}

/// Friction of full contact is the sum of q q_x a² b G″(a_T q_x v) over the mean pressure, with the factors of each wave.
#[test]
fn every_wave_has_its_own_moduli() {
    let wave = |(numbers, amplitude, _): &([i32; 2], f64, [f64; 2])| Wave {
        numbers: *numbers,
        amplitude: *amplitude,
        phase: 0.3,
    };
    let waves = WAVES.iter().map(wave).collect();
    let surface = PeriodicSurface::new([PERIOD; 2], waves).expect("a surface");
    let (material, mean_pressure) = (solid(), 1e6);
    let elastomer = Layer::new(&material, f64::INFINITY).expect("a half space");
    let elastomer = elastomer.with_wave_shift(shift());
    let load = PeriodicLoad::new(mean_pressure, VELOCITY).expect("a load");
    let state = periodic::steady(&surface, &elastomer, &load, 1e-3).expect("a state");
    let friction = |is_shifted: bool| -> f64 {
        let of_wave = |(numbers, amplitude, factors): &([i32; 2], f64, [f64; 2])| {
            let [q_x, q] = wave_numbers(*numbers);
            let [time, modulus] = if is_shifted { *factors } else { [1.0; 2] };
            let frequency = q_x * VELOCITY * time;
            let loss = material.complex_modulus(frequency).expect("a modulus").loss;
            q * q_x * amplitude * amplitude * modulus * loss / mean_pressure
        };
        WAVES.iter().map(of_wave).sum()
    };
    let found = state.friction_coefficient;
    let expected = friction(true);
    assert!(
        state.area_fraction.value > 1.0 - 1e-9,
        "{}",
        state.area_fraction
    );
    assert!(
        (found.value - expected).abs() <= found.error.max(1e-9 * expected),
        "{found}, not {expected}"
    );
    assert!(
        (friction(false) / expected - 1.0).abs() > 0.1,
        "the shift matters"
    );
}

/// Bodies, motions, histories and derivatives refuse a shift, as do surfaces at rest.
#[test]
fn only_periods_that_slide_have_a_shift() {
    let material = solid();
    let elastomer = Layer::new(&material, f64::INFINITY).expect("a half space");
    let elastomer = elastomer.with_wave_shift(shift());
    let body = PowerProfile::paraboloid(50.0).expect("a body");
    let is_refused = |error: Option<BemError>| {
        assert!(
            matches!(error, Some(BemError::WaveShiftWithoutPeriod)),
            "{error:?}"
        );
    };
    let load = SlidingLoad::new(0.1, VELOCITY).expect("a load");
    is_refused(steady(&body, &elastomer, &load, 0.1).err());
    let marched = load.after(1e-3).expect("a distance");
    is_refused(slide(&body, &elastomer, &marched, 0.1).err());
    let pressed = PressingLoad::new(Control::NormalForce(0.1), 1.0).expect("a load");
    is_refused(indent(&body, &elastomer, &pressed, 0.1).err());
    let wave = Wave {
        numbers: [1, 0],
        amplitude: 1e-6,
        phase: 0.0,
    };
    let surface = PeriodicSurface::new([PERIOD; 2], vec![wave]).expect("a surface");
    let pressed = PeriodicLoad::pressed(1e5, 1.0).expect("a load");
    is_refused(periodic::steady(&surface, &elastomer, &pressed, 0.1).err());
    let load = PeriodicLoad::new(1e5, VELOCITY).expect("a load");
    let state = periodic::steady(&surface, &elastomer, &load, 0.1).expect("a state");
    let pressure = &state.finest.pressure;
    is_refused(PeriodicSensitivity::new(&surface, &elastomer, &load, pressure).err());
}
