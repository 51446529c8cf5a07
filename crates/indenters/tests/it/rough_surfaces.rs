//! Periodic surfaces are the same on every grid, and random ones have the spectrum asked for.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use casebook::{NOT_POSITIVE, assert_matches, refuses};
use indenters::rough::{PeriodicSurface, SelfAffine, TabulatedSpectrum, Wave};
use indenters::{HeightMap, IndenterError};

const RANDOM: SelfAffine = SelfAffine {
    period: [2.0, 1.0],
    hurst_exponent: 0.8,
    rms_slope: 0.1,
    longest_wavelength: 0.5,
    shortest_wavelength: 0.04,
    roll_off_wavelength: 0.25,
    seed: 7,
};

#[test]
fn heights_are_the_sum_of_the_waves_on_any_grid() {
    let numbers = [[0, 2], [3, 0], [2, -3], [-1, 2]];
    let waves: Vec<Wave> = (numbers.into_iter().zip([0.3, 0.2, 0.5, 0.1]))
        .map(|(numbers, amplitude)| Wave {
            numbers,
            amplitude,
            phase: 4.0 * amplitude,
        })
        .collect();
    let surface = PeriodicSurface::new([0.5, 3.0], waves.clone()).expect("a surface");
    for [rows, columns] in [[7, 7], [8, 9], [30, 12]] {
        let heights = surface.heights([rows, columns]).expect("heights");
        for (index, height) in heights.into_iter().enumerate() {
            let x = (index / columns) as f64 / rows as f64;
            let y = (index % columns) as f64 / columns as f64;
            let wave = |wave: &Wave| {
                let [m, n] = wave.numbers.map(f64::from);
                wave.amplitude * (TAU * (m * x + n * y) + wave.phase).cos()
            };
            let expected: f64 = waves.iter().map(wave).sum();
            let off = (height - expected).abs();
            assert!(off < 1e-14, "{height}, not {expected} at {index}");
        }
    }
    // Two elements are needed per shortest wave.
    let few = surface.heights([6, 9]).expect_err("too few elements");
    assert_eq!(few.parameter, "elements along x", "{few}");
    let few = surface.heights([7, 6]).expect_err("too few elements");
    assert_eq!(few.parameter, "elements along y", "{few}");
}

#[test]
fn the_rms_slope_is_that_of_the_surface() {
    let surface = RANDOM.surface().expect("a surface");
    let (n, slope) = (128, surface.rms_slope());
    assert!((slope - 0.1).abs() < 1e-15, "{slope}");
    // Differences of the eighth order, whose error is (q Δ)^8/630 of a wave.
    let heights = surface.heights([8 * n, 4 * n]).expect("heights");
    let at = |row: usize, column: usize| heights[row % (8 * n) * 4 * n + column % (4 * n)];
    let spacing = 0.25 / n as f64;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let square = |index: usize| {
        let [row, column] = [index / (4 * n) + 8 * n, index % (4 * n) + 4 * n];
        let sum = |difference: &dyn Fn(usize) -> f64| -> f64 {
            let terms = weights.iter().zip(1..);
            terms.map(|(weight, k)| weight * difference(k)).sum::<f64>() / spacing
        };
        let along_x = sum(&|k| at(row + k, column) - at(row - k, column));
        let along_y = sum(&|k| at(row, column + k) - at(row, column - k));
        along_x * along_x + along_y * along_y
    };
    let mean = (0..heights.len()).map(square).sum::<f64>() / heights.len() as f64;
    assert!((mean.sqrt() - 0.1).abs() < 1e-7, "{}", mean.sqrt());
}

#[test]
fn amplitudes_depend_on_the_wave_vector_and_the_seed_only() {
    let of = |asked: SelfAffine| asked.surface().expect("a surface");
    let (all, other) = (of(RANDOM), of(SelfAffine { seed: 8, ..RANDOM }));
    let shortest_wavelength = 0.08;
    let half = of(SelfAffine {
        shortest_wavelength,
        ..RANDOM
    });
    let find = |wave: &Wave| {
        let mut waves = all.waves().iter();
        let same = waves.find(|other| other.numbers == wave.numbers);
        *same.expect("the same wave")
    };
    let ratio = find(&half.waves()[0]).amplitude / half.waves()[0].amplitude;
    for wave in half.waves() {
        let same = find(wave);
        let [turned, scaled] = [same.phase - wave.phase, same.amplitude / wave.amplitude];
        let is_same = turned.abs() < 1e-15 && (scaled / ratio - 1.0).abs() < 1e-13;
        assert!(is_same, "{wave:?}, {same:?}");
    }
    let is_changed = |wave: &Wave| find(wave).phase.to_bits() != wave.phase.to_bits();
    assert!(other.waves().iter().all(is_changed), "another seed");
    assert_eq!(other.waves().len(), all.waves().len(), "as many waves");
    // One of two opposite waves with 2 <= |(m, 2 n)| <= 25, each with its own phase.
    let period = [1.0, 0.5];
    let narrow = of(SelfAffine { period, ..RANDOM });
    let is_part = |[m, n]: &[i32; 2]| (4..=625).contains(&(m * m + 4 * n * n));
    let numbers = (-25..=25).flat_map(|m| (-25..=25).map(move |n| [m, n]));
    let phases = narrow.waves().iter().map(|wave| wave.phase.to_bits());
    let counts = [narrow.waves().len(), BTreeSet::from_iter(phases).len()];
    assert_eq!(counts, [numbers.filter(is_part).count() / 2; 2], "waves");
}

/// 0.3/0.1 is less than 3, and a wave of a third of the period is as long as the shortest one all the same.
#[test]
fn wave_lengths_that_are_rounded_parts_of_the_period_are_drawn() {
    let asked = SelfAffine {
        period: [0.3; 2],
        longest_wavelength: 0.3,
        roll_off_wavelength: 0.3,
        shortest_wavelength: 0.1,
        ..RANDOM
    };
    let surface = asked.surface().expect("a surface");
    assert_eq!(surface.largest_numbers(), [3; 2], "{surface:?}");
}

/// The mean squares of amplitudes fall like the spectrum, and are constant above the roll-off wave length.
#[test]
fn the_spectrum_is_self_affine() {
    let mut means = [0.0; 3];
    let bands = [[2.0, 4.0], [7.0, 8.0], [22.0, 25.0]];
    for seed in 0..20 {
        let surface = SelfAffine { seed, ..RANDOM }.surface().expect("a surface");
        for (mean, [from, to]) in means.iter_mut().zip(bands) {
            // In units of the spectrum asked for.
            let squares = surface.waves().iter().filter_map(|wave| {
                let [m, n] = wave.numbers.map(f64::from);
                let inverse = (0.5 * m).hypot(n);
                let spectrum = (inverse / 4.0).max(1.0).powf(-3.6);
                (inverse >= from && inverse <= to).then(|| wave.amplitude.powi(2) / spectrum)
            });
            let squares: Vec<f64> = squares.collect();
            *mean += squares.iter().sum::<f64>() / squares.len() as f64 / 20.0;
        }
    }
    // At least 40 waves on 20 surfaces: the mean square of 800 Gaussian numbers is known to 4 %.
    for mean in means {
        assert!((mean / means[0] - 1.0).abs() < 0.2, "{means:?}");
    }
}

#[test]
fn impossible_spectra_are_refused() {
    type Change = fn(&mut SelfAffine);
    let bad: [(&str, Change); 6] = [
        ("hurst_exponent", |asked| asked.hurst_exponent = 1.0),
        ("rms_slope", |asked| asked.rms_slope = f64::NAN),
        ("period along x", |asked| asked.period = [0.0, 1.0]),
        ("period along x", |asked| asked.shortest_wavelength = 1e-9),
        ("roll_off_wavelength", |asked| {
            asked.roll_off_wavelength = 0.6;
        }),
        ("shortest_wavelength", |asked| {
            asked.longest_wavelength = 0.3;
            asked.roll_off_wavelength = 0.2997;
            asked.shortest_wavelength = 0.2995;
        }),
    ];
    for (name, change) in bad {
        let mut asked = RANDOM;
        change(&mut asked);
        let message = asked.surface().expect_err(name).to_string();
        assert!(message.starts_with(name), "{message} instead of {name}");
    }
}

/// On its own grid a map is met at every point, but for waves of two elements; and a sum of waves is found again.
#[test]
fn a_periodic_map_is_a_sum_of_waves() {
    let surface = RANDOM.surface().expect("a surface");
    for [rows, columns] in [[128, 64], [101, 75]] {
        let heights = surface.heights([rows, columns]).expect("heights");
        let spacing = [2.0 / rows as f64, 1.0 / columns as f64];
        let map = HeightMap::from_gaps([rows, columns], spacing, heights).expect("a map");
        let found = PeriodicSurface::from_map(&map, 0.0).expect("waves");
        assert_eq!(found.waves().len(), surface.waves().len(), "as many waves");
        for wave in found.waves() {
            let is_same = |other: &&Wave| {
                let numbers = other.numbers;
                numbers == wave.numbers || numbers.map(|number| -number) == wave.numbers
            };
            let same = surface.waves().iter().find(is_same).expect("the same wave");
            let phase = if same.numbers == wave.numbers {
                same.phase
            } else {
                -same.phase
            };
            let turned = (wave.phase - phase) / TAU;
            let off = (turned - turned.round()).abs() * TAU
                + (wave.amplitude / same.amplitude - 1.0).abs();
            assert!(off < 1e-9, "{wave:?}, {same:?}");
        }
        let smooth = PeriodicSurface::from_map(&map, 0.1).expect("longer waves");
        let longest = smooth.waves().iter().map(|wave| smooth.wave_vector(wave));
        let shortest = longest
            .map(|[x, y]| TAU / x.hypot(y))
            .fold(f64::INFINITY, f64::min);
        assert!((0.1..0.11).contains(&shortest), "shortest wave {shortest}");
        PeriodicSurface::from_map(&map, 3.0).expect_err("no wave is so long");
    }
    let flat = HeightMap::from_gaps([4, 4], [1.0; 2], vec![1.0; 16]).expect("a map");
    let refused = PeriodicSurface::from_map(&flat, 0.0).expect_err("a plane");
    let said = refused.to_string();
    assert!(
        said.starts_with("largest height above the lowest"),
        "{said}"
    );
    // Waves of two elements alone are none that heights tell.
    let heights = [1.0, 0.0, 1.0, 0.0].repeat(4);
    let board = HeightMap::from_gaps([4, 4], [1.0; 2], heights).expect("a map");
    PeriodicSurface::from_map(&board, 0.0).expect_err("two elements per wave");
}

#[test]
fn a_surface_needs_waves() {
    let nothing = PeriodicSurface::new([1.0; 2], Vec::new());
    assert_matches!(nothing, Err(IndenterError::TooFew { .. }));
    let new = |length, wave| PeriodicSurface::new([1.0, length], vec![wave]);
    let (wave, bad) = (
        RANDOM.surface().expect("a surface").waves()[0],
        &[f64::NAN, f64::INFINITY],
    );
    refuses("period along y", NOT_POSITIVE, |length| new(length, wave));
    refuses("amplitude", bad, |amplitude| {
        new(1.0, Wave { amplitude, ..wave })
    });
    refuses("phase", bad, |phase| new(1.0, Wave { phase, ..wave }));
}

/// Rows without waves end a table, and one in the middle is a density of 0: the slope is the integral that is known.
#[test]
fn rows_of_density_zero_have_no_waves() {
    let wave_numbers = vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    let table =
        |densities: [f64; 7]| TabulatedSpectrum::new(wave_numbers.clone(), densities.to_vec());
    let found = table([0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0]).expect("a spectrum");
    let [longest, shortest] = found.wavelengths();
    assert!((longest - TAU / 3.0).abs() < 1e-15 && (shortest - TAU / 5.0).abs() < 1e-15);
    // ∫ q³ |q − 4| dq from 3 to 5
    let integral = |q: f64| 4.0 * q.powi(4) / 4.0 - q.powi(5) / 5.0;
    let square = TAU * (2.0 * integral(4.0) - integral(3.0) - integral(5.0));
    let off = found.rms_slope().powi(2) / square - 1.0;
    assert!(off.abs() < 1e-12, "{off}");
    let drawn = found.surface([TAU; 2], TAU / 5.0, 1).expect("a surface");
    let wave = |numbers| drawn.waves().iter().find(|wave| wave.numbers == numbers);
    let none = wave([4, 0]).expect("a wave").amplitude;
    assert!(
        none < 1e-15 && wave([5, 0]).is_some_and(|wave| wave.amplitude > 0.0),
        "{none}"
    );
    for densities in [
        [0.0; 7],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, -1.0],
    ] {
        table(densities).expect_err("no spectrum");
    }
}

/// A table of the self-affine spectrum draws the same surface; its slope is the mean of those that it draws.
#[test]
fn a_table_of_a_spectrum_draws_the_same_surfaces() {
    let lengths = [0.5, 0.25, 0.04];
    let wave_numbers = lengths.map(|length| TAU / length);
    let table = |factor: f64| {
        let falls = |q: &f64| factor * (q / wave_numbers[1]).max(1.0).powf(-3.6);
        let densities = wave_numbers.iter().map(falls).collect();
        TabulatedSpectrum::new(wave_numbers.to_vec(), densities).expect("a spectrum")
    };
    let asked = RANDOM.surface().expect("a surface");
    let draw = |table: &TabulatedSpectrum, seed| {
        let drawn = table.surface(RANDOM.period, 0.04, seed);
        drawn.expect("a surface")
    };
    let factor = (0.1 / draw(&table(1.0), 7).rms_slope()).powi(2);
    let table = table(factor);
    let found = draw(&table, 7);
    assert_eq!(found.waves().len(), asked.waves().len(), "as many waves");
    for (one, other) in found.waves().iter().zip(asked.waves()) {
        let is_same = one.numbers == other.numbers && one.phase.to_bits() == other.phase.to_bits();
        let off = one.amplitude / other.amplitude - 1.0;
        assert!(is_same && off.abs() < 1e-12, "{one:?}, {other:?}");
    }
    // 950 Gaussian waves on each of 40 surfaces: their mean square is known to 1 %, and sums over wave vectors are integrals to 2.
    let squares = (0..40).map(|seed| draw(&table, seed).rms_slope().powi(2));
    let ratio = squares.sum::<f64>() / 40.0 / table.rms_slope().powi(2);
    assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
    let short = table.surface(RANDOM.period, 0.039, 7);
    let said = short.expect_err("the table ends before").to_string();
    assert!(said.starts_with("shortest_wavelength"), "{said}");
    for (wave_numbers, densities, name) in [
        ([1.0, 1.0], vec![1.0; 2], "wave numbers"),
        ([1.0, 2.0], vec![1.0], "wave numbers"),
        ([0.0, 2.0], vec![1.0; 2], "wave number"),
        ([1.0, 2.0], vec![1.0, 0.0], "density"),
    ] {
        let refused = TabulatedSpectrum::new(wave_numbers.to_vec(), densities);
        let said = refused.expect_err(name).to_string();
        assert!(said.contains(name), "{said}");
    }
}

#[test]
fn without_short_waves_are_all_the_others() {
    let surface = RANDOM.surface().expect("a surface");
    let shortest = surface.shortest_wavelength();
    assert!((0.04..0.041).contains(&shortest), "{shortest}");
    let whole = surface.without_waves_below(shortest);
    assert_eq!(whole.as_ref(), Some(&surface), "all waves");
    let half = surface.without_waves_below(2.0 * shortest);
    assert_eq!(half, surface.without_shortest_octave(), "an octave less");
    assert_eq!(surface.without_waves_below(0.6), None, "none is so long");
    for shape in [[200, 200], [16, 200], [1, 1]] {
        let resolved = surface.resolved_on(shape);
        let waves = resolved
            .as_ref()
            .map_or(&[][..], |resolved| resolved.waves());
        let is_told = |wave: &&Wave| {
            let numbers = wave
                .numbers
                .map(|number| 2 * number.unsigned_abs() as usize);
            numbers[0] < shape[0] && numbers[1] < shape[1]
        };
        let expected = surface.waves().iter().filter(is_told).count();
        assert_eq!(waves.len(), expected, "{shape:?}");
        assert_eq!(resolved.is_some(), expected > 0, "{shape:?}");
    }
}
