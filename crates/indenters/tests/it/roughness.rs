//! Numbers and spectra of maps whose waves are known.

use std::f64::consts::{PI, TAU};

use casebook::assert_close;
use indenters::HeightMap;
use indenters::rough::{PowerSpectrum, Roughness, SelfAffine};

/// `cycles` of a wave of amplitude 2e-6 along x over a map of 3e-3 × 1e-3, with its crests along y.
fn wave(shape: [usize; 2], cycles: f64) -> HeightMap {
    let [rows, columns] = shape;
    let place = |index: usize| (index / columns) as f64 / rows as f64;
    let height = |index: usize| 2e-6 * (TAU * cycles * place(index) + 0.3).cos();
    let heights = (0..rows * columns).map(height).collect();
    let spacing = [3e-3 / rows as f64, 1e-3 / columns as f64];
    HeightMap::from_gaps(shape, spacing, heights).expect("a map")
}

#[test]
fn a_wave_has_the_numbers_of_its_formula() {
    let q = TAU * 5.0 / 3e-3;
    let (rms, map) = (2e-6 / 2.0_f64.sqrt(), wave([2000, 4], 5.0));
    let of_waves = Roughness::of(&map, true).expect("numbers");
    for (name, value, expected) in [
        ("Sq", of_waves.rms_height, rms),
        ("Sa", of_waves.mean_deviation, 4e-6 / PI),
        ("Sku", of_waves.kurtosis, 1.5),
        ("Sp", of_waves.peak, 2e-6),
        ("Sv", of_waves.pit, 2e-6),
        ("slope along x", of_waves.rms_slopes[0], rms * q),
    ] {
        assert_close!(value => expected, within 1e-5; "{name}");
    }
    assert!(of_waves.skewness.abs() < 1e-9 && of_waves.rms_slopes[1] == 0.0);
    assert_close!(of_waves.rms_gradient() => rms * q, within 1e-10);
    assert_close!(of_waves.rms_curvature => 0.5 * rms * q * q, within 1e-10);
    assert_close!(of_waves.nayak => 1.5, within 1e-10);
    // Steps of whole periods, from the first row to the last: their mean square is less by the sinc of half a step.
    let map = wave([101, 4], 5.05);
    let (q, half) = (TAU * 5.05 / 3e-3, PI * 0.05);
    let of_steps = Roughness::of(&map, false).expect("numbers");
    let slope = rms * q * half.sin() / half;
    assert_close!(of_steps.rms_gradient() => slope, within 1e-10);
    assert_close!(of_steps.rms_curvature => 0.5 * slope * slope / rms, within 1e-2);
}

/// Peaks of the body are low heights of its map, which point into it.
#[test]
fn spikes_on_a_plain_have_a_positive_skewness() {
    let mut heights = vec![1.0; 100];
    heights[44] = 0.0;
    let map = HeightMap::from_gaps([10, 10], [1.0; 2], heights).expect("a map");
    let spike = Roughness::of(&map, false).expect("numbers");
    assert_close!(spike.skewness => 0.98 / 0.0099_f64.sqrt(), within 1e-12; "Ssk");
    assert_close!(spike.peak => 0.99, within 1e-12; "Sp");
}

#[test]
fn spectra_hold_the_variance_of_the_heights() {
    let surface = SelfAffine {
        period: [2.0, 1.0],
        hurst_exponent: 0.6,
        rms_slope: 0.2,
        longest_wavelength: 1.0,
        shortest_wavelength: 0.05,
        roll_off_wavelength: 0.5,
        seed: 4,
    };
    let surface = surface.surface().expect("a surface");
    let (shape, spacing) = ([150, 90], [2.0 / 150.0, 1.0 / 90.0]);
    let heights = surface.heights(shape).expect("heights");
    let map = HeightMap::from_gaps(shape, spacing, heights).expect("a map");
    let numbers = Roughness::of(&map, true).expect("numbers");
    assert_close!(numbers.rms_gradient() => 0.2, within 1e-12; "Sdq");
    let spectrum = PowerSpectrum::of(&map, true).expect("a spectrum");
    let variance = numbers.rms_height.powi(2);
    let cell = PI * TAU;
    let of_waves = spectrum.waves.waves().iter();
    let of_waves: f64 = of_waves.map(|wave| 2.0 * spectrum.density(wave)).sum();
    assert_close!(of_waves * cell => variance, within 1e-12; "waves");
    let rings = spectrum.radial.iter();
    let rings: f64 = rings
        .map(|ring| 2.0 * ring.density * ring.waves as f64)
        .sum();
    assert_close!(rings * cell => variance, within 1e-12; "rings");
    for (profile, step) in spectrum.profiles.iter().zip([PI, TAU]) {
        let both = profile.iter().skip(1).map(|[_, density]| 2.0 * density);
        let all = profile[0][1] + both.sum::<f64>();
        assert_close!(all * step => variance, within 1e-12; "profiles");
        assert_close!(profile[3][0] => 3.0 * step, within 1e-12; "wave number");
    }
}

/// A wave that does not fit makes a step at the edge, which the window hides: at three times the wave number the spectrum of
/// the step is a ten thousandth of the peak.
#[test]
fn the_window_hides_the_edges() {
    let map = wave([512, 64], 20.5);
    let spectrum = |repeats: bool| PowerSpectrum::of(&map, repeats).expect("a spectrum");
    let part = |spectrum: &PowerSpectrum| {
        let profile = spectrum.profiles[0].iter().map(|[_, density]| *density);
        let highest = profile.clone().fold(0.0, f64::max);
        spectrum.profiles[0][61][1] / highest
    };
    let [open, hidden] = [true, false].map(|repeats| part(&spectrum(repeats)));
    assert!(open > 1e-5 && hidden < 1e-8, "{open} and {hidden}");
    let profile = spectrum(false).profiles[0].clone();
    let both: f64 = profile
        .iter()
        .skip(1)
        .map(|[_, density]| 2.0 * density)
        .sum();
    // The window along y has waves of its own; their mean is two thirds.
    assert_close!(both * TAU / 3e-3 => 2e-12, within 1e-2; "variance");
}

/// Squares of such lengths are infinite or 0, and their ratios no numbers.
#[test]
fn lengths_whose_powers_are_no_numbers_are_refused() {
    let map = |scale: f64, spacing: f64| {
        let heights = (0..16).map(|index| scale * f64::from(index * index % 7));
        HeightMap::from_gaps([4, 4], [1.0, spacing], heights.collect()).expect("a map")
    };
    for (scale, spacing, named) in [
        (1e200, 1.0, "largest height"),
        (1e-200, 1.0, "largest height"),
        (1.0, 1e-160, "spacing along y"),
    ] {
        let map = map(scale, spacing);
        let spectrum = PowerSpectrum::of(&map, false).map(drop);
        for refused in [Roughness::of(&map, false).map(drop), spectrum] {
            let said = refused.expect_err("too far from 1").to_string();
            assert!(said.contains(named) && said.contains("units"), "{said}");
        }
    }
    let spread =
        [1e-29, 1e29].map(|scale| Roughness::of(&map(scale, 1.0), false).map(|of| of.nayak));
    let [small, large] = spread.map(|nayak| nayak.expect("numbers"));
    assert_close!(small => large, within 1e-12; "Nayak's parameter has no unit");
    // Waves of two elements are not resolved, so that no wave remains.
    let board = (0..16)
        .map(|index| f64::from((index / 4 + index) % 2))
        .collect();
    let board = HeightMap::from_gaps([4, 4], [1.0; 2], board).expect("a map");
    Roughness::of(&board, true).expect_err("no slopes");
}
