use std::f64::consts::TAU;
use std::ops::Range;

use casebook::{NEGATIVE, NOT_POSITIVE, assert_close, refuses};
use rheology::fit::{
    Control, IdentifyOptions, LongTimeLimit, MeasuredCurve, ModulusPoint, RelaxationPoint, identify,
};
use rheology::{RelaxationSpectrum, RheologyError};

use crate::support::{named_spectrum, spectrum};

/// Number of the pairs `x, y, …` of a table with two header lines.
fn table(text: &str) -> Vec<Vec<f64>> {
    let rows = text.lines().skip(2);
    rows.map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect()
}

fn point([angular_frequency, storage, loss]: [f64; 3]) -> ModulusPoint {
    ModulusPoint {
        angular_frequency,
        storage,
        loss,
    }
}

/// Measured at ten frequencies per decade, each number changed to what the apparatus shows of the `k`-th.
fn measured(
    material: &RelaxationSpectrum,
    decades: Range<i32>,
    shown: impl Fn(f64, [f64; 3]) -> [f64; 3],
) -> MeasuredCurve {
    let points = (10 * decades.start..=10 * decades.end).map(|k| {
        let omega = 10_f64.powf(0.1 * f64::from(k));
        let modulus = material.complex_modulus(omega).unwrap();
        let nth = f64::from(k - 10 * decades.start);
        point(shown(nth, [omega, modulus.storage, modulus.loss]))
    });
    MeasuredCurve::oscillation(points.collect()).unwrap()
}

fn oscillation(material: &RelaxationSpectrum, decades: Range<i32>) -> MeasuredCurve {
    measured(material, decades, |_, point| point)
}

/// Asserts that two spectra have the same branches, moduli and times each within a relative tolerance.
fn assert_same_branches(
    new: &RelaxationSpectrum,
    old: &RelaxationSpectrum,
    [modulus, time]: [f64; 2],
) {
    let counts = [new, old].map(|spectrum| spectrum.branches().len());
    assert_eq!(counts[0], counts[1], "{new:?}, expected {old:?}");
    for (new, old) in new.branches().iter().zip(old.branches()) {
        assert_close!(new.modulus => old.modulus, within modulus);
        assert_close!(new.relaxation_time => old.relaxation_time, within time);
    }
}

fn solid(control: Control) -> IdentifyOptions {
    IdentifyOptions {
        long_time_limit: LongTimeLimit::Solid,
        control,
    }
}

#[test]
fn exact_data_give_back_their_spectrum() {
    let solid = spectrum(1e5, 0.0, &[5e6, 2e7, 3e5], &[1e-5, 1e-2, 1e2]);
    let liquid = spectrum(0.0, 0.0, &[5e6, 2e5, 3e3], &[1e-4, 1e-1, 1e2]);
    let relaxing = (-80..=60).map(|k| {
        let time = 10_f64.powf(0.1 * f64::from(k));
        let modulus = solid.relaxation_modulus(time).unwrap();
        RelaxationPoint { time, modulus }
    });
    let relaxing = MeasuredCurve::relaxation(relaxing.collect()).unwrap();
    for (given, curve, long_time_limit) in [
        (&solid, oscillation(&solid, -4..8), LongTimeLimit::Solid),
        (&solid, relaxing, LongTimeLimit::Solid),
        (&liquid, oscillation(&liquid, -4..8), LongTimeLimit::Liquid),
    ] {
        let options = IdentifyOptions {
            long_time_limit,
            control: Control::Branches(3),
        };
        let found = identify(&curve, &options).unwrap();
        // The refinement stops when the squares fall by less than 1e-4 of themselves.
        assert!(
            found.rms_relative_error < 1e-6,
            "{long_time_limit:?}: {found:?}"
        );
        assert_close!(
            found.spectrum.equilibrium_modulus() => given.equilibrium_modulus(),
            within 1e-5
        );
        assert_same_branches(&found.spectrum, given, [1e-5; 2]);
    }
}

/// Asserts that fits have at most the given number of branches and smaller squares than those of pyvisco.
fn assert_better_than_pyvisco(
    curve: &MeasuredCurve,
    rows: &[(Control, usize, f64)],
    squares: impl Fn(&RelaxationSpectrum) -> f64,
) {
    for &(control, most, peer) in rows {
        let found = identify(curve, &solid(control)).unwrap().spectrum;
        let squares = squares(&found);
        assert!(
            found.branches().len() <= most && squares < peer,
            "{control:?}: squares {squares:e}, pyvisco {peer:e}, {found:?}"
        );
    }
}

/// pyvisco 2.1.3 on its own examples/freq_user_master.csv, `prony.discretize(df, "round", 20)`, squares of the errors over
/// the square of the last storage modulus: 3.866e-2 by `prony.fit`, 1.3385e-2 with `opt=True` in 0.92 s; with its default
/// of 26 terms 3.602e-2 and 8.822e-3.
#[test]
fn twenty_branches_fit_pyviscos_frequency_data_better_than_pyvisco() {
    let data = table(include_str!("../data/pyvisco_frequency_master.csv"));
    let points = data.iter().map(|row| point([TAU * row[0], row[1], row[2]]));
    let curve = MeasuredCurve::oscillation(points.collect()).unwrap();
    let scale = data.last().unwrap()[1];
    let rows = [
        (Control::Branches(20), 20, 1.3385e-2),
        (Control::Branches(26), 26, 8.822e-3),
        (IdentifyOptions::default().control, 20, 1.3385e-2),
    ];
    assert_better_than_pyvisco(&curve, &rows, |found| {
        let errors = data.iter().map(|row| {
            let modulus = found.complex_modulus(TAU * row[0]).unwrap();
            (modulus.storage - row[1]).hypot(modulus.loss - row[2]) / scale
        });
        errors.map(|error| error * error).sum()
    });
}

/// pyvisco 2.1.3 on its own examples/time_user_master.csv, squares of the errors over the square of the first modulus,
/// `opt=True`: 3.856e-3 with 20 terms ("round"), 4.139e-4 with its default of 31.
#[test]
fn pyviscos_relaxation_data_are_fitted_better_than_by_pyvisco() {
    let data = table(include_str!("../data/pyvisco_time_master.csv"));
    let points = data.iter().map(|row| RelaxationPoint {
        time: row[0],
        modulus: row[1],
    });
    let curve = MeasuredCurve::relaxation(points.collect()).unwrap();
    let rows = [(20, 3.856e-3), (31, 4.139e-4)];
    let rows = rows.map(|(n_branches, peer)| (Control::Branches(n_branches), n_branches, peer));
    assert_better_than_pyvisco(&curve, &rows, |found| {
        let errors = data.iter().map(|row| {
            let modulus = found.relaxation_modulus(row[0]).unwrap();
            ((modulus - row[1]) / data[0][1]).powi(2)
        });
        errors.sum()
    });
}

/// As many branches as the data have, and no more.
#[test]
fn parsimony_finds_the_number_of_branches() {
    let noise = |k: f64| 1.0 + 0.01 * (12.9898 * k).sin();
    let given = spectrum(1e5, 0.0, &[5e6, 2e7, 3e5], &[1e-5, 1e-2, 1e2]);
    let curve = measured(&given, -4..8, |k, [omega, storage, loss]| {
        [omega, storage * noise(2.0 * k), loss * noise(2.0 * k + 1.0)]
    });
    let found = identify(&curve, &solid(Control::Parsimony { tolerance: 0.05 })).unwrap();
    // Errors of 1 %, of random sign, over some forty numbers per branch.
    assert_same_branches(&found.spectrum, &given, [5e-3, 1e-2]);
}

/// Tikhonov: the stronger, the smoother and the farther from the data.
/// Of a rubber that relaxes at all times, with a scatter of 1 %: as far as the times may move, scatter draws branches there, and with
/// a factor of 10 those far outside double the loss.
#[test]
fn no_branch_is_far_outside_of_what_was_measured() {
    let times: Vec<f64> = (-18..=8).map(|k| 10_f64.powf(0.5 * f64::from(k))).collect();
    let moduli: Vec<f64> = times.iter().map(|t| 1e5 + 4e3 / t.sqrt()).collect();
    let rubber = spectrum(1e6, 0.0, &moduli, &times);
    for seed in 1..=20 {
        let curve = measured(&rubber, 0..3, |nth, [omega, storage, loss]| {
            let noise = |k: f64| 1.0 + 0.014 * (k * (nth + 31.0 * f64::from(seed))).sin();
            [omega, storage * noise(12.9898), loss * noise(78.233)]
        });
        let [lowest, highest] = curve.frequencies();
        assert_close!(lowest => 1.0, within 1e-12);
        assert_close!(highest => 1e3, within 1e-12);
        for control in [Control::Branches(5), IdentifyOptions::default().control] {
            let found = identify(&curve, &solid(control)).unwrap().spectrum;
            for branch in found.branches() {
                let time = branch.relaxation_time;
                let is_near = (0.5e-3 * (1.0 - 1e-9)..=2.0 * (1.0 + 1e-9)).contains(&time);
                assert!(is_near, "{seed}, {control:?}: {time} s in {found:?}");
            }
        }
    }
}

#[test]
fn smoothing_trades_closeness_for_smoothness() {
    let curve = oscillation(&named_spectrum("P10"), -6..9);
    let mut last = (0.0, f64::INFINITY);
    for weight in [0.0, 0.1, 1.0, 10.0] {
        let n_branches = 40;
        let found = identify(&curve, &solid(Control::Smooth { n_branches, weight })).unwrap();
        let logs = found.spectrum.branches().iter().map(|b| b.modulus.ln());
        let logs: Vec<f64> = logs.collect();
        let bends = logs.windows(3).map(|m| (m[0] - 2.0 * m[1] + m[2]).powi(2));
        let roughness = bends.sum::<f64>() / logs.len() as f64;
        assert!(
            found.rms_relative_error > last.0 && roughness < last.1,
            "weight {weight}: roughness {roughness}, error and roughness before {last:?}, {found:?}"
        );
        last = (found.rms_relative_error, roughness);
    }
}

#[test]
fn identification_does_not_depend_on_units() {
    let given = named_spectrum("P10");
    let in_other_units =
        |_, [omega, storage, loss]: [f64; 3]| [omega * 1e9, storage * 1e-12, loss * 1e-12];
    let options = solid(Control::Branches(6));
    let found = identify(&oscillation(&given, -4..8), &options).unwrap();
    let scaled = identify(&measured(&given, -4..8, in_other_units), &options).unwrap();
    assert_close!(scaled.rms_relative_error => found.rms_relative_error, within 1e-9);
    let [new, old] = [&scaled, &found].map(|found| found.spectrum.branches());
    for (new, old) in new.iter().zip(old) {
        // The refinement stops where its squares are flat to 1e-4; rounding moves the place.
        assert_close!(new.modulus * 1e12 => old.modulus, within 1e-6);
        assert_close!(new.relaxation_time * 1e9 => old.relaxation_time, within 1e-6);
    }
}

/// As they are, no positive branches come closer than a fifth to them; one branch does not come closer to a broad spectrum.
#[test]
fn swapped_moduli_and_noise_are_refused_and_bad_fits_are_not() {
    let given = spectrum(1e5, 0.0, &[5e6, 2e7, 3e5], &[1e-5, 1e-2, 1e2]);
    let swap = |_, [omega, storage, loss]: [f64; 3]| [omega, loss, storage];
    let one = solid(Control::Branches(1));
    let refused = identify(&measured(&given, -4..8, swap), &one);
    let seen = matches!(refused, Err(RheologyError::SwappedModuli { given, swapped })
        if given > 0.2 && swapped < 1e-3);
    assert!(seen, "{refused:?}");
    let found = identify(&oscillation(&given, -4..8), &one).unwrap();
    assert!(found.rms_relative_error > 0.2, "{found:?}");
    let errors = (-40..=80).map(|k| {
        let omega = 10_f64.powf(0.1 * f64::from(k));
        let [fit, exact] = [&found.spectrum, &given].map(|m| m.complex_modulus(omega).unwrap());
        let off = (fit.storage - exact.storage).hypot(fit.loss - exact.loss);
        (off / exact.storage.hypot(exact.loss)).powi(2)
    });
    let rms = (errors.sum::<f64>() / 121.0).sqrt();
    assert_close!(found.rms_relative_error => rms, within 1e-12);
    let noise = |k, [omega, storage, loss]: [f64; 3]| {
        [omega, storage * 9_f64.powf(f64::sin(9.0 * k)), loss]
    };
    let noisy = identify(&measured(&given, -4..8, noise), &one);
    let seen = matches!(noisy, Err(RheologyError::NoMaterial { storage, .. }) if storage > 0.2);
    assert!(seen, "{noisy:?}");
}

#[test]
fn curves_that_are_not_measurements_are_refused() {
    let good = point([1.0; 3]);
    let next = |numbers| MeasuredCurve::oscillation(vec![good, point(numbers)]);
    let not_increasing = &[1.0, 0.5, f64::NAN];
    let frequency = "angular_frequency of points[1]";
    refuses(frequency, not_increasing, |x| next([x, 1.0, 1.0]));
    refuses("storage of points[1]", NEGATIVE, |x| next([2.0, x, 1.0]));
    refuses("loss of points[1]", NEGATIVE, |x| next([2.0, 1.0, x]));
    refuses("modulus of points[1]", &[0.0], |x| next([2.0, x, x]));
    let relaxing = |[time, modulus]: [f64; 2]| {
        let points = [[1.0, 1.0], [time, modulus]];
        let point = |[time, modulus]: [f64; 2]| RelaxationPoint { time, modulus };
        MeasuredCurve::relaxation(points.map(point).to_vec())
    };
    refuses("time of points[1]", not_increasing, |x| relaxing([x, 1.0]));
    let modulus = "modulus of points[1]";
    refuses(modulus, NOT_POSITIVE, |x| relaxing([2.0, x]));
    let few = MeasuredCurve::oscillation(vec![good]).unwrap_err();
    let message = "at least 2 points are needed, but there are 1";
    assert_eq!(few.to_string(), message, "one point");
    let curve = next([2.0, 1.0, 1.0]).unwrap();
    let identified = |control| identify(&curve, &solid(control));
    let n_branches = "n_branches";
    refuses(n_branches, &[0.0], |_| identified(Control::Branches(0)));
    refuses(n_branches, &[201.0], |_| identified(Control::Branches(201)));
    refuses("tolerance", NOT_POSITIVE, |tolerance| {
        identified(Control::Parsimony { tolerance })
    });
    let n_branches = 3;
    refuses("weight", NEGATIVE, |weight| {
        identified(Control::Smooth { n_branches, weight })
    });
}
