//! Contact with a periodic surface: Westergaard's wave from first touch to full contact, and rough surfaces near full
//! contact.

use std::f64::consts::PI;

use bem_halfspace::indenters::rough::SelfAffine;
use bem_halfspace::periodic::steady_on_grid;
use bem_halfspace::rheology::Elastic;
use bem_halfspace::{
    Contact, ContactOptions, ContactState, Control, Convolution, Grid, PeriodicLoad,
    PeriodicOptions,
};
use casebook::group;

#[cfg(feature = "rough")]
use crate::support::random_surface;
use crate::support::{Pressing, assert_close, assert_near, assert_refused};

const OPTIONS: ContactOptions = ContactOptions {
    tolerance: 1e-11,
    max_iterations: 500,
};

/// Wave h = D (1 − cos kx) of length 1 on `n` elements per wave and two across, crest in the middle of the first.
fn wave(n: usize, amplitude: f64, shear_modulus: f64) -> Pressing {
    let edge = 1.0 / n as f64;
    // Elements of another width show whether both spacings are used.
    let grid = Grid::new([n, 2], [edge, 3.0 * edge]).expect("a valid grid");
    let height = |[row, _]: [f64; 2]| amplitude * (1.0 - (2.0 * PI * row * edge).cos());
    Pressing {
        compliance: 1.0 / shear_modulus,
        options: OPTIONS,
        ..Pressing::new(Convolution::periodic(&grid), height)
    }
}

fn solve_under(body: &Pressing, mean_pressure: f64) -> (Contact, ContactState) {
    let grid = body.convolution.grid();
    let area = grid.element_area() * grid.n_elements() as f64;
    body.solve(Control::NormalForce(mean_pressure * area))
}

/// Mean relative deviation of the pressure from Westergaard's, weighted with the pressure, that of the half-width of
/// contact, and the pressure on the crest.
fn westergaard_error(n: usize, [amplitude, mean, half_width]: [f64; 3]) -> [f64; 3] {
    let (contact, state) = solve_under(&wave(n, amplitude, 1.0), mean);
    let edge = (PI * half_width).sin().powi(2);
    let exact = |row: usize| {
        let angle = PI * row as f64 / n as f64;
        let inside = (edge - angle.sin().powi(2)).max(0.0);
        2.0 * mean * angle.cos().abs() / edge * inside.sqrt()
    };
    let deviations = (0..n).map(|row| (state.pressure()[2 * row] - exact(row)).abs());
    let width = contact.n_contact as f64 / 2.0 / n as f64;
    [
        deviations.sum::<f64>() / n as f64 / mean,
        0.5 * width - half_width,
        state.pressure()[0],
    ]
}

#[test]
fn westergaards_pressure_is_reached_from_first_touch_to_full_contact() {
    let cases = group("BEM-08").into_iter();
    for case in cases.filter(|case| case.has_input("G")) {
        let half_width = case.expected("a").expect("a half-width");
        let scene = [case.input("amplitude"), case.input("p_mean"), half_width];
        let [coarse, fine] = [128, 512].map(|n| westergaard_error(n, scene));
        // Between samples the spectral kernel sees a trigonometric polynomial; at the edge of the contact, where the
        // pressure is like a square root, that errs by the spacing to the power 3/2 when averaged.
        let order = (coarse[0] / fine[0]).log2() / 2.0;
        let holds = order > 1.2 && fine[0] < 1e-3 && fine[1].abs() <= 1.0 / 512.0;
        assert!(holds, "{case:?}: order {order}, {coarse:?}, {fine:?}");
        // On the crest, far from the edge, the order is higher.
        case.check_within("p0", fine[2], 1e-3);
    }
}

/// Beyond p* = 2 G k D, and not before, the wave is flat and the pressure is its mean plus p* cos kx, exactly on any grid.
#[test]
fn full_contact_of_a_wave_is_exact() {
    let (n, amplitude, shear_modulus) = (48, 0.01, 2.5);
    let body = wave(n, amplitude, shear_modulus);
    let full = 2.0 * shear_modulus * 2.0 * PI * amplitude;
    let (before, _) = solve_under(&body, 0.999 * full);
    assert!(before.n_contact < 2 * n, "not full before: {before:?}");
    for mean in [1.001 * full, 3.0 * full] {
        let (contact, state) = solve_under(&body, mean);
        assert_eq!(contact.n_contact, 2 * n, "{contact:?}");
        // The depth is the mean height.
        assert_close(mean, contact.indentation_depth, amplitude, 1e-10);
        for row in 0..n {
            let expected = mean + full * (2.0 * PI * row as f64 / n as f64).cos();
            let actual = state.pressure()[2 * row];
            assert_near((mean, row), actual, expected, 1e-9 * mean);
        }
    }
}

/// From the mean height on the contact is full, and no depth determines its pressure.
#[test]
fn the_depth_that_a_force_causes_has_that_force_unless_the_contact_is_full() {
    let body = wave(64, 0.01, 1.0);
    let (given, _) = solve_under(&body, 0.03);
    let (found, _) = body.solve(Control::IndentationDepth(given.indentation_depth));
    assert_close("force", found.normal_force, given.normal_force, 1e-8);
    for depth in [0.010_000_1, 0.5] {
        let mut state = ContactState::new(&body.convolution);
        let refused = body.solve_from(&mut state, Control::IndentationDepth(depth));
        assert_refused(depth, refused, "indentation_depth");
    }
}

/// Waves of many lengths and all directions with fixed pseudo-random phases over `n` × `n` elements of side 1, each
/// times a factor of its wave number.
fn rough(n: usize, factor: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut seed = 1_u64;
    let mut phase = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 * PI
    };
    let short = (0..24).flat_map(|k| [[k, 24 - k], [k, k - 24]]);
    let waves = short.chain([[3, 1], [2, -5], [7, 4], [0, 6]]).map(|wave| {
        let [x, y] = wave.map(|k| 2.0 * PI * f64::from(k));
        let q = x.hypot(y);
        [x, y, factor(q) * q.powf(-1.8), phase()]
    });
    let waves: Vec<[f64; 4]> = waves.collect();
    let height = |index: usize| -> f64 {
        let [x, y] = [index / n, index % n].map(|k| k as f64 / n as f64);
        let wave = |[k, l, a, phase]: &[f64; 4]| a * (k * x + l * y + phase).cos();
        waves.iter().map(wave).sum()
    };
    (0..n * n).map(height).collect()
}

/// Contacts of all sizes take about the same number of iterations, the last holes included; and the contact is full
/// from the mean pressure on that cancels the tension 2 G |q| h of the deepest valley.
#[test]
fn no_contact_stalls_from_one_element_to_full() {
    let n = 128;
    let grid = Grid::new([n, n], [1.0 / n as f64; 2]).expect("a valid grid");
    let body = Pressing {
        heights: rough(n, |_| 1.0),
        options: OPTIONS,
        ..Pressing::new(Convolution::periodic(&grid), |_| 0.0)
    };
    let full = rough(n, |q| 2.0 * q).into_iter().fold(0.0, f64::max);
    let mut parts = Vec::new();
    for part in [1e-9, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 0.999, 1.001] {
        let (contact, state) = body.solve(Control::NormalForce(part * full));
        assert!(contact.iterations < 60, "{part} of full: {contact:?}");
        let force: f64 = state.pressure().iter().sum::<f64>() * grid.element_area();
        assert_close(part, force, part * full, 1e-12);
        parts.push(contact.n_contact);
    }
    assert!(parts.is_sorted(), "more force, more contact: {parts:?}");
    let [first, .., before, last] = parts[..] else {
        panic!("{parts:?}")
    };
    assert_eq!((first, last), (1, n * n), "first touch and full contact");
    let missing = 1..n * n / 100;
    assert!(missing.contains(&(n * n - before)), "{parts:?}");
}

/// Part of the elements in contact, and that without their excess at edges, of surfaces with two decades of waves.
fn areas_of_two_decades(edge: usize, mean_pressure: f64, seed: u64) -> [f64; 2] {
    let surface = SelfAffine {
        period: [1.0; 2],
        hurst_exponent: 0.8,
        rms_slope: 0.2766,
        longest_wavelength: 1.000_001,
        shortest_wavelength: 0.009_999_99,
        roll_off_wavelength: 1.000_001,
        seed,
    };
    let surface = surface.surface().expect("a surface");
    let heights = surface.heights([edge; 2]).expect("heights");
    let grid = Grid::new([edge; 2], [1.0 / edge as f64; 2]).expect("a grid");
    // E* = 1.
    let spring = Elastic::new(0.25).expect("a spring");
    let load = PeriodicLoad::new(mean_pressure, 0.0).expect("a load");
    let options = PeriodicOptions {
        tolerance: 1e-5,
        ..PeriodicOptions::default()
    };
    let found = steady_on_grid(&grid, &heights, &spring, &load, &options).expect("a contact");
    let pressures = found.pressure.pressure.iter();
    let count = pressures.filter(|pressure| **pressure > 0.0).count();
    [count as f64 / grid.n_elements() as f64, found.area_fraction]
}

/// Areas that Zhou computed by Green's functions, published with Xu's work on Persson's theory: they are those of elements in
/// contact on four elements per shortest wave.
#[test]
fn areas_of_two_decades_of_waves_are_those_of_zhou() {
    for (mean_pressure, zhou) in [(0.04, 0.28459), (0.147, 0.77187), (0.37, 0.99513)] {
        let surfaces = [1, 2, 3].map(|seed| areas_of_two_decades(400, mean_pressure, seed)[0]);
        let mean = surfaces.iter().sum::<f64>() / 3.0;
        assert_close("area", mean, zhou, 0.02);
    }
}

/// Without their excess at edges the areas hardly depend on the elements, on as few as four per shortest wave.
#[test]
fn corrected_areas_hardly_depend_on_the_elements() {
    let [few, many] = [400, 800].map(|edge| areas_of_two_decades(edge, 0.04, 1));
    assert!(few[0] > 1.025 * many[0], "{few:?} {many:?}");
    assert_close("area", few[1], many[1], 0.004);
}

/// Gaps that are smaller than an element may hide between any; the area of a wave is (2/π) asin √(p̄/p*) (Westergaard 1939).
#[cfg(feature = "rough")]
#[test]
fn bars_hold_gaps_between_elements_that_are_all_in_contact() {
    use bem_halfspace::indenters::rough::{PeriodicSurface, Wave};
    use bem_halfspace::periodic::steady;

    use crate::support::elastic;
    let (modulus, amplitude, finest) = (3.0, 0.01, 128.0);
    // E* = 4G.
    let closing = 4.0 * modulus * PI * amplitude;
    for in_element in [0.0, 0.3, 0.5] {
        let wave = Wave {
            numbers: [1, 0],
            amplitude,
            phase: -2.0 * PI * in_element / finest,
        };
        let surface = PeriodicSurface::new([1.0; 2], vec![wave]).expect("a surface");
        let area = |missing: f64| {
            let load = PeriodicLoad::new(closing * (1.0 - missing), 0.0).expect("a load");
            let state = steady(&surface, &elastic(modulus), &load, 0.1).expect("a state");
            state.area_fraction
        };
        for missing in [3e-3_f64, 3e-4, 1e-4, 1e-6] {
            let exact = 2.0 / PI * f64::asin((1.0 - missing).sqrt());
            let found = area(missing);
            assert_near(missing, found.value, exact, found.error);
        }
        let closed = area(-0.01);
        assert!(closed.error < 1e-11, "{closed:?}");
        assert_near(in_element, closed.value, 1.0, closed.error);
    }
}

/// The edges of grooves err the same way everywhere; their area is that of a wave along the motion.
#[cfg(feature = "rough")]
#[test]
fn bars_hold_areas_of_grooves_in_any_direction() {
    use bem_halfspace::indenters::rough::{PeriodicSurface, Wave};
    use bem_halfspace::periodic::steady;

    use crate::support::elastic;
    let (modulus, amplitude) = (3.0, 0.01);
    for numbers in [[1, 0], [0, 3], [1, 1], [-2, 1], [1, 3]] {
        for case in 1..=8 {
            let part = 0.11 * f64::from(case);
            let wave = Wave {
                numbers,
                amplitude,
                phase: f64::from(case),
            };
            let surface = PeriodicSurface::new([1.0; 2], vec![wave]).expect("a surface");
            let [m, n] = numbers.map(f64::from);
            let closing = 4.0 * modulus * PI * m.hypot(n) * amplitude;
            let load = PeriodicLoad::new(closing * part, 0.0).expect("a load");
            let state = steady(&surface, &elastic(modulus), &load, 0.1).expect("a state");
            let exact = 2.0 / PI * part.sqrt().asin();
            let area = state.area_fraction;
            assert_near((numbers, part), area.value, exact, area.error);
            assert!(
                area.error < 0.1 * area.value,
                "{numbers:?}, {part}: {area:?}"
            );
        }
    }
}

/// Bars hold the areas of surfaces that change little from grid to grid by chance, on a quarter and a sixteenth of the elements
/// along an edge.
#[cfg(feature = "rough")]
#[test]
fn bars_hold_the_staircase_error_of_an_area() {
    use bem_halfspace::numerics::Accuracy;
    use bem_halfspace::periodic::steady;

    use crate::support::prony;
    for seed in [1, 18, 37] {
        let surface = random_surface([0.3, 0.25, 1.0 / 12.0], seed);
        let material = prony([1.0, 0.0], &[(5.0, 1.0)]);
        let load = PeriodicLoad::new(0.016, 2.0).expect("a load");
        let [coarse, fine] = [256, 1024].map(|elements| {
            let found = steady(&surface, &material, &load, Accuracy::Elements(elements));
            found.expect("a state").area_fraction
        });
        assert_near(seed, coarse.value, fine.value, coarse.error);
        assert!(fine.error < 0.02 * fine.value, "{seed}: {fine:?}");
    }
}

/// Four elements per shortest wave suffice to find whether a contact is full: the gap between them follows from the waves.
#[cfg(feature = "rough")]
#[test]
fn a_contact_that_is_hardly_full_has_no_gaps_in_its_bars() {
    use bem_halfspace::indenters::rough::PeriodicSurface;
    use bem_halfspace::periodic::steady;

    use crate::support::elastic;
    let modulus = 3.0;
    let surface = random_surface([0.5, 0.5, 1.0 / 16.0], 8);
    // The pressure E* |q|/2 that closes each wave, E* = 4 G.
    let mut waves = surface.waves().to_vec();
    for wave in &mut waves {
        let [q_x, q_y] = surface.wave_vector(wave);
        wave.amplitude *= 2.0 * modulus * q_x.hypot(q_y);
    }
    let closing = PeriodicSurface::new([1.0; 2], waves).expect("a surface of pressures");
    let closing = closing.heights([1024; 2]).expect("pressures");
    let closing = closing.into_iter().fold(0.0, f64::max);
    let area = |mean_pressure: f64| {
        let load = PeriodicLoad::new(mean_pressure, 0.0).expect("a load");
        let state = steady(&surface, &elastic(modulus), &load, 0.1).expect("a state");
        assert_eq!(state.finest.pressure.grid.shape(), [256; 2]);
        state.area_fraction
    };
    let full = area(1.02 * closing);
    assert!(full.error < 1e-9, "{full:?}");
    let open = area((1.0 - 1e-5) * closing);
    assert!(
        open.value - open.error < 1.0 && open.error < 1e-3,
        "{open:?}"
    );
}
