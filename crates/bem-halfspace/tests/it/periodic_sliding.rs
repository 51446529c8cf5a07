//! Stationary sliding of periodic surfaces: known frictions and areas, limits, and invariances.

use std::f64::consts::PI;

use bem_halfspace::periodic::steady_on_grid;
use bem_halfspace::{
    BemError, Control, Convolution, Grid, PeriodicLoad, PeriodicOptions, PeriodicSliding,
};
use casebook::{RoughCase, rough_cases};
use indenters::rough::SelfAffine;
use rheology::Material;
use rustfft::num_complex::Complex;

use crate::support::{
    Pressing, assert_all_close, assert_close, assert_near, assert_refused, elastic, prony,
    random_surface, viscous,
};

/// Heights of waves [m, n, a, φ] over a unit square, `copies` of it along x, from `origin` on.
fn heights(
    waves: &[[f64; 4]],
    [rows, columns]: [usize; 2],
    copies: usize,
    origin: f64,
) -> Vec<f64> {
    let height = |index: usize| -> f64 {
        let x = copies as f64 * (index / columns) as f64 / rows as f64 + origin;
        let y = (index % columns) as f64 / columns as f64;
        let wave = |[m, n, a, phase]: &[f64; 4]| a * (2.0 * PI * (m * x + n * y) + phase).cos();
        waves.iter().map(wave).sum()
    };
    (0..rows * columns).map(height).collect()
}

/// Elements of the unit square.
fn unit_square(n: usize) -> Grid {
    Grid::new([n; 2], [1.0 / n as f64; 2]).expect("a valid grid")
}

fn slide(
    grid: &Grid,
    heights: &[f64],
    material: &impl Material,
    load: [f64; 2],
) -> Result<PeriodicSliding, BemError> {
    let load = PeriodicLoad::new(load[0], load[1])?;
    let options = PeriodicOptions {
        tolerance: 1e-8,
        ..PeriodicOptions::default()
    };
    steady_on_grid(grid, heights, material, &load, &options)
}

fn solve(case: &RoughCase, n: usize) -> PeriodicSliding {
    let heights = heights(&case.waves, [n; 2], 1, 0.0);
    let load = [case.mean_pressure, case.velocity];
    let solved = slide(&unit_square(n), &heights, &case.material, load);
    solved.unwrap_or_else(|error| panic!("{}: {error}", case.id))
}

fn frictions(solved: &PeriodicSliding) -> [f64; 2] {
    [
        solved.friction_coefficient,
        solved.friction_from_dissipation,
    ]
}

#[test]
fn friction_and_area_are_those_of_the_casebook() {
    for case in rough_cases("cases") {
        let solved = solve(&case, 128);
        let frictions = frictions(&solved);
        // The gradient is right where the friction is a large part of the slope, the dissipation where the shortest waves
        // dissipate little; their difference tells how far either may be off.
        let exact = case.friction_coefficient;
        let off = frictions.map(|friction| (friction / exact - 1.0).abs());
        let (best, difference) = (off[0].min(off[1]), (frictions[0] - frictions[1]) / exact);
        let holds = best < 5e-3 && best < difference.abs() + 1e-3;
        assert!(holds && solved.applications < 60, "{}: {solved:?}", case.id);
        // On five elements per shortest asperity in contact the counted area is 15 % too large.
        assert_close(&case.id, solved.area_fraction, case.area, 0.065);
    }
}

#[test]
fn full_contact_is_exact() {
    for case in rough_cases("full_contact") {
        let frictions = frictions(&solve(&case, 48));
        assert_all_close(&case.id, frictions, [case.friction_coefficient; 2], 1e-11);
    }
}

#[test]
fn at_rest_the_contact_is_the_elastic_one() {
    let case = &rough_cases("cases")[2];
    let (n, modulus) = (96, 3.0);
    let (grid, heights) = (unit_square(n), heights(&case.waves, [n; 2], 1, 0.0));
    let solved = slide(&grid, &heights, &elastic(modulus), [0.02, 0.0]).expect("a contact");
    let body = Pressing {
        compliance: 1.0 / modulus,
        heights,
        ..Pressing::new(Convolution::periodic(&grid), |_| 0.0)
    };
    let (contact, state) = body.solve(Control::NormalForce(0.02));
    for (actual, expected) in solved.pressure.pressure.iter().zip(state.pressure()) {
        assert_near("pressure", *actual, *expected, 1e-5);
    }
    let mean = body.heights.iter().sum::<f64>() / body.heights.len() as f64;
    let depth = solved.mean_depth + mean;
    assert_near("depth", depth, contact.indentation_depth, 1e-8);
    assert_near("friction", solved.friction_from_dissipation, 0.0, 1e-15);
}

/// To the first order in the velocity, p̄ μ = Σ |p̂|² |q_x| (1 − ν) J″(q_x v) / |q| with the pressure at rest.
#[test]
fn slow_friction_is_the_dissipation_of_the_elastic_pressure() {
    let case = &rough_cases("cases")[0];
    let (n, velocity) = (64, 1e-7);
    let slow = |velocity: f64| RoughCase {
        velocity,
        ..case.clone()
    };
    let pressure = solve(&slow(0.0), n).pressure.pressure;
    let turn = |index: usize| Complex::from_polar(1.0, -2.0 * PI * (index % n) as f64 / n as f64);
    let along = |line: &dyn Fn(usize) -> Complex<f64>, m: usize| -> Complex<f64> {
        (0..n).map(|index| line(index) * turn(m * index)).sum()
    };
    let row = |index: usize, m: usize| along(&|k| Complex::from(pressure[index * n + k]), m);
    let rows: Vec<_> = (0..n * n).map(|wave| row(wave % n, wave / n)).collect();
    let power = |wave: usize| {
        let whole = |m: usize| 2.0 * PI * (m as f64 - if 2 * m > n { n as f64 } else { 0.0 });
        let [q_x, q_y] = [wave / n, wave % n].map(whole);
        let amplitude = along(&|index| rows[wave % n * n + index], wave / n) / (n * n) as f64;
        let compliance = case
            .material
            .creep()
            .complex_compliance(q_x.abs() * velocity);
        let loss = compliance.expect("a compliance").loss * case.material.half_space_factor() / 2.0;
        amplitude.norm_sqr() * q_x.abs() * loss / q_x.hypot(q_y).max(1.0)
    };
    // The shortest wave along x stands for both directions of sliding.
    let waves = (0..n * n).filter(|wave| 2 * (wave / n) != n);
    let expected = waves.map(power).sum::<f64>() / case.mean_pressure;
    let actual = solve(&slow(velocity), n).friction_from_dissipation;
    assert_close("slow", actual, expected, 1e-4);
}

#[test]
fn units_translation_copies_and_split_branches_change_nothing() {
    let case = &rough_cases("cases")[4];
    let n = 64;
    let [p0, v] = [case.mean_pressure, case.velocity];
    let expected = solve(case, n);
    let check = |solved: Result<PeriodicSliding, BemError>, slope: f64| {
        let solved = solved.expect("a state");
        let actual = frictions(&solved).map(|friction| friction / slope);
        assert_all_close(&solved, actual, frictions(&expected), 1e-6);
        let area = expected.area_fraction;
        assert_close(&solved, solved.area_fraction, area, 1e-6);
    };
    let grid = unit_square(n);
    let shape = heights(&case.waves, [n; 2], 1, 0.0);
    let moved = heights(&case.waves, [n; 2], 1, 0.375);
    check(slide(&grid, &moved, &case.material, [p0, v]), 1.0);
    let split = prony([0.25, 0.0], &[(1.0, 1.0), (1.25, 1.0)]);
    check(slide(&grid, &shape, &split, [p0, v]), 1.0);
    let long = Grid::new([2 * n, n], [1.0 / n as f64; 2]).expect("a grid");
    let copies = heights(&case.waves, [2 * n, n], 2, 0.0);
    check(slide(&long, &copies, &case.material, [p0, v]), 1.0);
    let (length, pressure, time, steep) = (1e-6, 1e7, 1e-5, 0.3);
    let small = Grid::new([n; 2], [length / n as f64; 2]).expect("a grid");
    let scaled: Vec<f64> = shape.iter().map(|height| height * length * steep).collect();
    let stiff = prony([0.25 * pressure, 0.0], &[(2.25 * pressure, time)]);
    let load = [p0 * pressure * steep, v * length / time];
    check(slide(&small, &scaled, &stiff, load), steep);
}

#[test]
fn what_has_no_stationary_state_is_refused() {
    let grid = Grid::new([16, 16], [1.0; 2]).expect("a grid");
    let wave = heights(&[[1.0, 0.0, 0.1, 0.0]], [16, 16], 1, 0.0);
    let (solid, fluid) = (elastic(1.0), viscous(1.0));
    let mut hole = wave.clone();
    hole[17] = f64::NAN;
    let row = Grid::new([1, 256], [1.0; 2]).expect("a grid");
    let load = [1.0, 1.0];
    let flowing = slide(&grid, &wave, &fluid, load);
    assert_refused("a dashpot", flowing, "FlowsUnderWaves");
    let with_hole = slide(&grid, &hole, &solid, load);
    let text = format!("{with_hole:?}");
    assert!(text.contains("row: 1, column: 1,"), "{text}");
    assert_refused("a hole", with_hole, "InvalidHeight");
    for (grid, heights, load, name) in [
        (&grid, &wave[1..], load, "LengthMismatch"),
        (&grid, &[0.5; 256][..], load, "height"),
        (&row, &wave[..], load, "rows of heights"),
        (&grid, &wave[..], [0.0, 1.0], "mean_pressure"),
        (&grid, &wave[..], [f64::NAN, 1.0], "mean_pressure"),
        (&grid, &wave[..], [1.0, -1.0], "velocity"),
        (&grid, &wave[..], [1.0, f64::INFINITY], "velocity"),
    ] {
        assert_refused((name, load), slide(grid, heights, &solid, load), name);
    }
}

/// Twenty branches over six decades of time, the slowest a thousand times stiffer than the fastest, from 2 to
/// 60 per cent of the area; and one branch a thousand times stiffer than the spring beside it, in contact on 70 per cent,
/// whose softest waves answer every change of the pressures.
#[test]
fn no_spectrum_keeps_the_contact_from_being_found() {
    let branch = |k: i32| (1.5_f64.powi(k), 10.0_f64.powf(f64::from(k) / 3.0 - 5.0));
    let branches: Vec<_> = (0..20).map(branch).collect();
    let many = (prony([1.0, 0.0], &branches), 0.25, 0.8);
    let one = (prony([1.0, 0.0], &[(999.0, 1.0)]), 0.5, 0.9);
    for ((material, longest, hurst_exponent), n, load, most) in [
        (&many, 128, [5.0, 0.01], 80),
        (&many, 128, [5.0, 1.0], 80),
        (&many, 128, [5.0, 100.0], 80),
        (&many, 128, [400.0, 1.0], 80),
        (&many, 128, [1000.0, 100.0], 80),
        (&one, 256, [3.0, 2.154e-4], 130),
    ] {
        let surface = SelfAffine {
            period: [1.0; 2],
            hurst_exponent: *hurst_exponent,
            rms_slope: 0.1,
            longest_wavelength: *longest,
            shortest_wavelength: 8.0 / n as f64,
            roll_off_wavelength: *longest,
            seed: 1,
        };
        let heights = surface.surface().expect("a surface").heights([n; 2]);
        let solved = slide(&unit_square(n), &heights.expect("heights"), material, load);
        let count = solved.expect("a contact").applications;
        assert!(count < most, "{load:?}: {count} applications of K");
    }
}

/// The waves across the motion are up to a million times as soft as all others, so that what comes in beside much tension does not
/// belong there.
#[test]
fn light_contacts_of_fast_dashpots_are_found() {
    for seed in [0, 3, 4] {
        let surface = random_surface([0.5, 0.5, 1.0 / 16.0], seed);
        let heights = surface.heights([128; 2]).expect("heights");
        let solved = slide(
            &unit_square(128),
            &heights,
            &prony([1.0, 1.0], &[]),
            [1e3, 1e4],
        );
        let count = solved.expect("a contact").applications;
        assert!(count < 400, "{seed}: {count} applications of K");
    }
}

/// Five elements of 128² carry the load; those of the coarser grids are beside gaps so wide that all of them would be lost between
/// them, and half of the elements be taken for the contact.
#[cfg(feature = "rough")]
#[test]
fn a_light_contact_goes_on_from_the_coarser_grid() {
    let n = 128;
    let surface = random_surface([0.8, 0.5, 6.0 / 128.0], 5);
    let heights = surface.heights([n; 2]);
    let material = prony([1.0, 0.0], &[(5e3, 1.0)]);
    let heights = heights.expect("heights");
    let solved = slide(&unit_square(n), &heights, &material, [2e-4, 1e-4]).expect("a contact");
    let touching = solved.pressure.pressure.iter().filter(|p| **p > 0.0);
    assert!(touching.count() < 10, "{solved:?}");
    assert!(solved.applications < 30, "{solved:?}");
}

/// Moduli whose ratio is 10² to 10⁶, grids of odd numbers of long elements, contacts from some elements to almost all; under a pressure,
/// and at the depth that it causes.
#[cfg(feature = "rough")]
#[test]
fn every_contact_on_a_small_grid_is_found() {
    // The last one takes more operator applications than are allowed if all of its contacts are solved by minimal residuals.
    for case in (380..420_u32).chain([795]) {
        // Evenly spread over all parameters.
        let part = |root: f64| (f64::from(case + 1) * root.sqrt()).fract();
        let shape = [21, 27 + 2 * (case as usize % 5)];
        let surface = SelfAffine {
            period: [1.0, 0.5 + part(2.0)],
            hurst_exponent: 0.1 + 0.8 * part(3.0),
            rms_slope: 0.1,
            longest_wavelength: 2.0,
            shortest_wavelength: 0.13,
            roll_off_wavelength: 2.0,
            seed: u64::from(case),
        };
        let surface = surface.surface().expect("a surface");
        let spacing = [0, 1].map(|axis| surface.period()[axis] / shape[axis] as f64);
        let grid = Grid::new(shape, spacing).expect("a grid");
        let heights = surface.heights(shape).expect("heights");
        let ratio = 10.0_f64.powf(2.0 + 4.0 * part(5.0));
        let material = prony([1.0, 0.0], &[(ratio - 1.0, 1.0)]);
        let velocity = 10.0_f64.powf(2.0 - 5.0 * part(7.0)) / ratio.sqrt();
        let frequency = 2.0 * PI * velocity;
        let modulus = material.relaxation().complex_modulus(frequency);
        let modulus = modulus.expect("a modulus").storage;
        let load = [modulus * 10.0_f64.powf(-0.5 - 3.0 * part(11.0)), velocity];
        let found = |solved: Result<PeriodicSliding, BemError>| {
            solved.unwrap_or_else(|error| panic!("{case}: {ratio}, {load:?}: {error}"))
        };
        let pressed = found(slide(&grid, &heights, &material, load));
        // At its depth the contact has the same pressure, unless it is full.
        if pressed.mean_depth < 0.0 {
            let at_depth = PeriodicLoad::at_depth(pressed.mean_depth, velocity).expect("a load");
            let options = PeriodicOptions {
                tolerance: 1e-8,
                ..PeriodicOptions::default()
            };
            let held = steady_on_grid(&grid, &heights, &material, &at_depth, &options);
            let pressures = found(held).pressure.pressure;
            let mean_pressure = pressures.iter().sum::<f64>() / pressures.len() as f64;
            assert_close(case, mean_pressure, load[0], 1e-4);
        }
    }
}

/// One summit touches with one element on the first grids, whose slope is no friction: -0.011 instead of 1.6e-4. A denser contact
/// is known the better the smaller the error asked for, also where that is not reached.
#[cfg(feature = "rough")]
#[test]
fn smaller_errors_never_make_worse_answers_nor_few_elements_any() {
    use bem_halfspace::periodic::steady;
    use numerics::MaxElements;

    use crate::support::within;
    let surface = SelfAffine {
        period: [1e-2; 2],
        hurst_exponent: 0.8,
        rms_slope: 0.1,
        longest_wavelength: 5e-3,
        shortest_wavelength: 1.25e-3,
        roll_off_wavelength: 5e-3,
        seed: 1,
    };
    let surface = surface.surface().expect("a surface");
    let material = prony([1e6, 0.0], &[(9e6, 0.01)]);
    let under = |pressure: f64, relative_error: f64| {
        let load = PeriodicLoad::new(pressure, 0.05).expect("a load");
        steady(
            &surface,
            &material,
            &load,
            within(relative_error, &MaxElements(256)),
        )
    };
    let light = under(1.0, 0.05);
    match light {
        Err(BemError::NotReached { value, error, .. }) => assert!(error >= value, "{error}"),
        other => panic!("{other:?}"),
    }
    let mut before = f64::INFINITY;
    for asked in [0.3, 0.03, 0.01, 1e-3, 1e-6] {
        let error = match under(1e4, asked) {
            Ok(answer) => answer.friction_coefficient.error,
            Err(BemError::NotReached { error, .. }) => error,
            Err(other) => panic!("{asked}: {other}"),
        };
        assert!(error <= before, "{asked}: {error} after {before}");
        before = error;
    }
}

/// The bars of friction and area hold the numbers of the casebook, whose own uncertainty is smaller; so do those of the mean
/// pressure between the ends of the bar of the depth.
#[cfg(feature = "rough")]
#[test]
fn the_bars_of_the_casebook_hold() {
    use bem_halfspace::periodic::steady;
    use indenters::rough::{PeriodicSurface, Wave};
    use numerics::ValueWithError;
    for case in rough_cases("cases") {
        #[expect(clippy::cast_possible_truncation, reason = "whole numbers")]
        let wave = |[m, n, amplitude, phase]: &[f64; 4]| Wave {
            numbers: [*m as i32, *n as i32],
            amplitude: *amplitude,
            phase: *phase,
        };
        let waves = case.waves.iter().map(wave).collect();
        let surface = PeriodicSurface::new([1.0; 2], waves).expect("a surface");
        let load = PeriodicLoad::new(case.mean_pressure, case.velocity).expect("a load");
        let estimate = steady(&surface, &case.material, &load, 0.1);
        let estimate = estimate.unwrap_or_else(|error| panic!("{}: {error}", case.id));
        let (bar, exact) = (estimate.friction_coefficient, case.friction_coefficient);
        assert_near(&case.id, bar.value, exact, bar.error);
        let bar = estimate.area_fraction;
        assert_near(&case.id, bar.value, case.area, bar.error);
        let held = |depth| {
            let load = PeriodicLoad::at_depth(depth, case.velocity)?;
            steady(&surface, &case.material, &load, 0.1)
        };
        let ValueWithError { value, error } = *estimate.mean_depth;
        if value + error >= 0.0 {
            assert_refused(&case.id, held(0.0), "mean_depth");
            continue;
        }
        let [higher, deeper] = [value - error, value + error].map(|depth| {
            let held =
                held(depth).unwrap_or_else(|error| panic!("{} at {depth}: {error}", case.id));
            assert_near(&case.id, held.mean_depth.value, depth, 0.0);
            held.mean_pressure
        });
        let holds = higher.value - higher.error <= case.mean_pressure
            && case.mean_pressure <= deeper.value + deeper.error;
        assert!(holds, "{}: {higher:?} to {deeper:?}", case.id);
    }
}

/// A compressible layer is pressed as deep by its mean pressure as it says, and carries as much there; deeper than touch.
#[cfg(feature = "rough")]
#[test]
fn depth_and_pressure_agree_on_a_layer() {
    use bem_halfspace::Layer;
    use bem_halfspace::periodic::steady;
    use indenters::rough::{PeriodicSurface, Wave};
    use rheology::Compressible;

    use crate::support::assert_bars_agree;

    let wave = |n| Wave {
        numbers: [n, 1],
        amplitude: 0.01,
        phase: 0.3,
    };
    let surface = PeriodicSurface::new([1.0; 2], vec![wave(1), wave(2)]).expect("a surface");
    let solid = Compressible::new(&prony([0.25, 0.0], &[(2.25, 1.0)]), 0.3).expect("a ratio");
    let layer = Layer::new(&solid, 0.1).expect("a thickness");
    let load = PeriodicLoad::new(0.01, 0.1).expect("a load");
    let under = steady(&surface, &layer, &load, 1e-2).expect("a state");
    let at = |depth| steady(&surface, &layer, &PeriodicLoad::at_depth(depth, 0.1)?, 1e-2);
    let held = at(under.mean_depth.value).expect("a state");
    let pressure = held.mean_pressure;
    assert_near("mean pressure", pressure.value, 0.01, pressure.error);
    assert!(pressure.error <= 1e-4, "{pressure:?}");
    let frictions = [under.friction_coefficient, held.friction_coefficient];
    assert_bars_agree("friction", frictions[0], frictions[1]);
    for depth in [-0.1, f64::NAN] {
        assert_refused(depth, at(depth), "mean_depth");
    }
}

/// As many waves as a map of 64² heights has, on two elements per height and edge against eight; ratios of moduli and areas as of
/// roads.
#[cfg(feature = "rough")]
#[test]
fn bars_on_four_elements_per_shortest_wave_hold() {
    use bem_halfspace::periodic::steady;
    use numerics::Accuracy;

    use crate::support::assert_bars_agree;
    for (case, (ratio, pressure)) in [(10.0, 0.02), (100.0, 0.1), (1000.0, 0.3)]
        .into_iter()
        .enumerate()
    {
        let surface = random_surface([0.8, 0.25, 1.0 / 31.0], case as u64);
        let material = prony([1.0, 0.0], &[(ratio - 1.0, 1.0)]);
        let load = PeriodicLoad::new(pressure, 0.01).expect("a load");
        let [coarse, fine] = [128, 512].map(|elements| {
            let found = steady(&surface, &material, &load, Accuracy::Elements(elements));
            found.unwrap_or_else(|error| panic!("{ratio}: {error}"))
        });
        assert_eq!(coarse.finest.pressure.grid.shape(), [128; 2], "shape");
        let pairs = [
            (coarse.friction_coefficient, fine.friction_coefficient, 0.3),
            (coarse.area_fraction, fine.area_fraction, 2.5),
        ];
        for (coarse, fine, most) in pairs {
            assert_bars_agree(ratio, coarse, fine);
            let is_useful = coarse.error < most * coarse.value && fine.error < coarse.error;
            assert!(is_useful, "{ratio}: {coarse:?}, {fine:?}");
        }
    }
}
