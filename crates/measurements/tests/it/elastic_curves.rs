//! The way in of an elastic sphere has one modulus, of whatever material it is asked for.

use std::fmt::Write as _;

use indenters::PowerProfile;
use measurements::indentation::{
    FitOptions, IndentationCurve, IndentationFit, Note, Rheology, fit_indentation,
};
use rayon::prelude::*;

use crate::support::Normal;
use crate::synthetic::{n_curves, write_table};

const RADIUS: f64 = 5e-6;
/// Shear modulus of an incompressible material, \[Pa].
const MODULUS: f64 = 1e3 / 3.0;
const CONTACT_POINT: f64 = 1.3e-8;

/// The force of Hertz with noise of 0.3 % of its peak, from 2 µm above the surface to 1 µm below it, in a second.
fn curve(seed: u64) -> IndentationCurve {
    let mut normal = Normal(seed);
    let time: Vec<f64> = (0..600).map(|i| f64::from(i) / 599.0).collect();
    let depth: Vec<f64> = time.iter().map(|time| 3e-6 * time - 2e-6).collect();
    let force = depth.iter().map(|depth| {
        let contact = (depth - CONTACT_POINT).max(0.0);
        16.0 / 3.0 * MODULUS * RADIUS.sqrt() * contact.powf(1.5) + 1.2e-11 * normal.draw()
    });
    IndentationCurve {
        force: force.collect(),
        time,
        depth,
    }
}

fn fitted(rheology: Rheology, profile: bool, seed: u64) -> IndentationFit {
    let body = PowerProfile::paraboloid(0.5 / RADIUS).expect("a paraboloid");
    let options = FitOptions {
        rheology,
        profile,
        ..FitOptions::default()
    };
    fit_indentation(&body, &curve(seed), &options).expect("a fit")
}

#[test]
fn the_modulus_of_an_elastic_curve_is_within_its_interval() {
    let n = n_curves(60);
    let fits = (0..n).into_par_iter().map(|seed| {
        let seed_of_noise = 7 + 1_000_003 * seed as u64;
        let fit = fitted(Rheology::Elastic, seed % 2 == 0, seed_of_noise);
        let findings = fit.findings;
        let estimate = findings[0].estimate.expect("it is determined");
        let [lower, upper] = findings[0].interval.map(|end| end.expect("an end"));
        assert_eq!(findings[0].name, "G", "seed {seed}");
        let missed = [lower > MODULUS, upper < MODULUS];
        (estimate.value, estimate.error, missed, fit.flags.is_empty())
    });
    let fits: Vec<(f64, f64, [bool; 2], bool)> = fits.collect();
    let flagged = fits.iter().filter(|fit| !fit.3).count();
    let mean = fits.iter().map(|fit| fit.0).sum::<f64>() / n as f64;
    let error = fits.iter().map(|fit| fit.1).sum::<f64>() / n as f64;
    let missed = [0, 1].map(|side| fits.iter().filter(|fit| fit.2[side]).count());
    let part = 1.0 - (missed[0] + missed[1]) as f64 / n as f64;
    let off = mean / MODULUS - 1.0;
    let said = format!(
        "{n} curves: mean off by {off:e}, standard error {error:.4} Pa, {part} inside, missed {missed:?}, {flagged} flagged\n"
    );
    write_table("elastic.txt", &said);
    assert!(off.abs() < 3e-3, "the mean is off by {off:e}");
    assert!(flagged <= 1 + n / 100, "{flagged} of {n} flagged");
    // Four standard deviations of the number of intervals that hold.
    let allowed = 4.0 * (0.95 * 0.05 / n as f64).sqrt();
    assert!((part - 0.95).abs() < allowed, "{part} inside, {missed:?}");
}

#[test]
fn a_material_that_relaxes_is_not_made_up_for_an_elastic_curve() {
    let n = n_curves(8);
    let mut table = String::new();
    for rheology in [Rheology::StandardSolid, Rheology::Prony, Rheology::PowerLaw] {
        let fits = (0..n).into_par_iter().map(|seed| {
            let fit = fitted(rheology, false, 11 + 1_000_003 * seed as u64);
            let (findings, notes) = (fit.findings, fit.notes);
            let is_elastic = notes == [Note::ElasticInstead];
            assert_eq!(is_elastic, findings[0].name == "G", "{findings:?}");
            let estimate = findings[0].estimate.expect("it is determined");
            let off = (estimate.value - MODULUS).abs();
            let is_close = !is_elastic || off < 5.0 * estimate.error;
            assert!(is_close, "{rheology:?}, seed {seed}: {estimate:?}");
            is_elastic
        });
        let elastic = fits.filter(|is_elastic| *is_elastic).count();
        writeln!(table, "{rheology:?}: {elastic} of {n} elastic").expect("text");
        // One of hundreds by chance.
        assert!(elastic * 50 >= n * 49, "{rheology:?}: {elastic} of {n}");
    }
    write_table("elastic-instead.txt", &table);
}
