//! One experiment: a known material is measured with errors, a series is fitted to the points, and a body slides over both.

use std::f64::consts::{LN_10, TAU};

use anyhow::{Context as _, Result};
use measurements::moduli::{Shifting, master_curve};
use numerics::whole_part;
use rheology::fit::{Identification, IdentifyOptions, Isotherm, ModulusPoint, identify};
use rheology::{KELVIN_AT_ZERO_CELSIUS, RelaxationBranch, RelaxationSpectrum, WlfShift};
use serde::{Deserialize, Serialize};
use viscofriction::scene::{Branch, Covariance, MaterialTable, Scene};
use viscofriction::solve::{Problem, solve};

use crate::evidence::request::{answer, differentiated};
use crate::random::Random;

/// What `experiments.toml` holds; there the keys are described. Numbers are drawn between the two ends of a range.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Experiments {
    /// Number of experiments of a full run and of a quick one.
    pub(super) count: [u32; 2],
    /// Relative standard deviation of the errors of G' and of G''.
    noise: [f64; 2],
    /// Standard deviation of the true temperature of an isotherm from the stated one, \[K].
    temperature: [f64; 2],
    /// Relative standard deviation of the factor that all moduli of an isotherm share.
    factor: [f64; 2],
    /// Number of isotherms.
    isotherms: [f64; 2],
    /// Temperature between neighbouring isotherms, \[K].
    step: [f64; 2],
    /// Number of frequencies of an isotherm.
    points: [f64; 2],
    /// Lowest and highest frequency of every isotherm, \[Hz]; not a range.
    frequency: [f64; 2],
    /// C₁ and C₂ \[K] of the law by Williams, Landel & Ferry of the true materials; not a range.
    wlf: [f64; 2],
    /// Where ln(v/a) is between the ends of the measured window, from 0 to 1; a is the radius of the contact.
    inside: [f64; 2],
    /// Factor by which v/a is beyond an end of the window, where the answer must warn.
    outside: [f64; 2],
    /// The materials, taken in turn.
    material: Vec<TrueMaterial>,
    /// Body, load and options; material and speed are replaced.
    scene: Scene,
}

/// A material whose branches follow a smooth spectrum H(τ), at 20 °C.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct TrueMaterial {
    /// For the tables.
    name: String,
    /// \[Pa].
    equilibrium_modulus: f64,
    /// Branches per decade of τ.
    per_decade: f64,
    /// Terms of H.
    #[serde(default)]
    peaks: Vec<Peak>,
    /// A further term of H.
    power: Option<Power>,
}

/// modulus · exp(−(log₁₀(τ/time)/decades)²).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Peak {
    /// \[Pa].
    modulus: f64,
    /// \[s].
    time: f64,
    /// Width.
    decades: f64,
}

/// modulus · (τ/1 s)^(−exponent).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Power {
    /// \[Pa].
    modulus: f64,
    /// Without a unit.
    exponent: f64,
}

/// The outcome of an experiment, and what was drawn for it; a row of `material.csv`.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Found {
    /// Name of the true material.
    pub(super) material: String,
    /// Number of isotherms.
    pub(super) isotherms: usize,
    /// Whether the moduli change with the absolute temperature.
    pub(super) is_entropic: bool,
    /// Standard deviations of the errors, as in [`Experiments`].
    noise_storage: f64,
    noise_loss: f64,
    temperature_scatter_k: f64,
    factor_scatter: f64,
    /// Number of branches of the fitted series.
    branches: usize,
    /// Speed within the window.
    velocity_m_per_s: f64,
    /// Friction coefficient on the fitted material.
    friction: f64,
    /// Friction coefficient on the true material.
    true_friction: f64,
    /// Standard uncertainty of the friction by the covariance of the moduli.
    pub(super) material_error: f64,
    /// Ratio of `friction` minus `true_friction` to this uncertainty.
    pub(super) deviation: f64,
    /// Whether the answer at a speed beyond the window says that the material is extrapolated.
    pub(super) warns_outside: bool,
}

impl Found {
    /// Ratio of the standard uncertainty of the friction, due to the material, to the friction.
    pub(super) fn relative_error(&self) -> f64 {
        self.material_error / self.friction
    }
}

/// Decimal logarithms of the shortest and the longest relaxation time of the true materials, \[s].
const DECADES: [f64; 2] = [-9.0, 3.0];
/// Temperature of the middle isotherm, at which the material is wanted, \[°C].
const REFERENCE_TEMPERATURE: f64 = 20.0;

impl TrueMaterial {
    /// The branches at 20 °C, each with the modulus H(τ).
    fn spectrum(&self) -> Result<RelaxationSpectrum> {
        let n = ((DECADES[1] - DECADES[0]) * self.per_decade).round();
        let branch = |k: usize| {
            let decade = DECADES[0] + k as f64 / self.per_decade;
            let peaks = self.peaks.iter().map(|peak| {
                let distance = (decade - peak.time.log10()) / peak.decades;
                peak.modulus * (-distance * distance).exp()
            });
            let power = self.power.as_ref().map_or(0.0, |power| {
                power.modulus * 10_f64.powf(-power.exponent * decade)
            });
            RelaxationBranch::new(peaks.sum::<f64>() + power, 10_f64.powf(decade))
        };
        let branches = (0..=whole_part(n)).map(branch).collect();
        let modulus = self.equilibrium_modulus;
        Ok(RelaxationSpectrum::new(modulus, 0.0, branches)?)
    }
}

/// What was drawn for one experiment; units as in [`Experiments`].
struct Drawn {
    /// For what is drawn later.
    random: Random,
    /// Number of isotherms.
    isotherms: usize,
    /// Whether moduli are proportional to the absolute temperature, b_T = T/T_r.
    is_entropic: bool,
    /// Relative noise of G' and of G''.
    noise: [f64; 2],
    /// Standard deviation of the temperature of an isotherm.
    temperature: f64,
    /// Standard deviation of the factor of an isotherm.
    factor: f64,
}

impl Experiments {
    /// Carries out the experiment of this number, which is also the seed of all that is drawn.
    pub(super) fn run(&self, number: u32) -> Result<Found> {
        let mut random = Random::new(u64::from(number));
        let [fewest, most] = self.isotherms;
        let n_materials = self.material.len();
        let drawn = Drawn {
            isotherms: whole_part(fewest + (random.uniform() * (most - fewest + 1.0)).floor()),
            noise: [random.between(self.noise), random.between(self.noise)],
            temperature: random.between(self.temperature),
            factor: random.between(self.factor),
            // A material is entropic every other time that it is used.
            is_entropic: (number as usize / n_materials) % 2 == 1,
            random,
        };
        let material = &self.material[number as usize % n_materials];
        let found = self.fitted(material, drawn);
        found.with_context(|| format!("experiment {number}"))
    }

    /// Measures and fits a material, and slides over it at one speed within the window of frequencies and at one beyond.
    fn fitted(&self, material: &TrueMaterial, mut drawn: Drawn) -> Result<Found> {
        let truth = material.spectrum()?;
        let isotherms = self.measured(&truth, &mut drawn)?;
        let (fit, window) = fit(&isotherms)?;
        let [true_table, fitted_table] = [
            series(&truth, None, window),
            series(&fit.spectrum, Some(&fit), window),
        ];
        // Compute the friction on both materials at a frequency within the window, and the uncertainty that the covariance of the
        // moduli gives it.
        let part = drawn.random.between(self.inside);
        let omega = (window[0].ln() + part * (window[1] / window[0]).ln()).exp();
        let velocity = self.velocity(&truth, omega)?;
        let known = answer(&self.slid(&true_table, velocity))?;
        let scene = self.slid(&fitted_table, velocity);
        let problem = Problem::try_from(&scene)?;
        let found = differentiated(&scene, &problem, solve(&problem)?)?;
        // Compute the friction at a frequency beyond one end of the window, only to see whether the answer warns.
        let factor = drawn.random.between(self.outside);
        let omega = match drawn.random.uniform() {
            ..0.5 => window[0] / factor,
            _ => window[1] * factor,
        };
        let beyond = answer(&self.slid(&fitted_table, self.velocity(&truth, omega)?))?;
        let [friction, true_friction] =
            [&found, &known].map(|answer| answer.requested_quantity().value);
        let material_error = found
            .budget
            .material()
            .of("friction_coefficient")
            .context("a covariance")?;
        Ok(Found {
            material: material.name.clone(),
            isotherms: drawn.isotherms,
            is_entropic: drawn.is_entropic,
            noise_storage: drawn.noise[0],
            noise_loss: drawn.noise[1],
            temperature_scatter_k: drawn.temperature,
            factor_scatter: drawn.factor,
            branches: fit.spectrum.branches().len(),
            velocity_m_per_s: velocity,
            friction,
            true_friction,
            material_error,
            deviation: (friction - true_friction) / material_error,
            warns_outside: beyond.dissipation.is_extrapolated(),
        })
    }

    /// Isotherms of the material with all errors. The middle one is at [`REFERENCE_TEMPERATURE`].
    fn measured(&self, truth: &RelaxationSpectrum, drawn: &mut Drawn) -> Result<Vec<Isotherm>> {
        let law = WlfShift::new(self.wlf[0], self.wlf[1], REFERENCE_TEMPERATURE)?;
        let step = drawn.random.between(self.step);
        let n_points = drawn.random.between(self.points).round();
        let ratio = (self.frequency[1] / self.frequency[0]).ln() / (n_points - 1.0);
        let middle = (drawn.isotherms / 2) as f64;
        let isotherm = |place: usize| {
            let temperature = REFERENCE_TEMPERATURE + step * (place as f64 - middle);
            let own = temperature + drawn.temperature * drawn.random.normal();
            let log_factor = LN_10 * law.log10_factor(own)?;
            let mut factor = 1.0 + drawn.factor * drawn.random.normal();
            if drawn.is_entropic {
                let kelvin = |celsius: f64| celsius + KELVIN_AT_ZERO_CELSIUS;
                factor *= kelvin(own) / kelvin(REFERENCE_TEMPERATURE);
            }
            let point = |k: usize| {
                let omega = TAU * self.frequency[0] * (ratio * k as f64).exp();
                let modulus = truth.complex_modulus(omega * log_factor.exp())?;
                let [storage, loss] = drawn
                    .noise
                    .map(|noise| factor * (1.0 + noise * drawn.random.normal()));
                Ok(ModulusPoint {
                    angular_frequency: omega,
                    storage: modulus.storage * storage,
                    loss: modulus.loss * loss,
                })
            };
            let points = (0..whole_part(n_points)).map(point);
            Ok(Isotherm {
                temperature,
                points: points.collect::<Result<_>>()?,
            })
        };
        (0..drawn.isotherms).map(isotherm).collect()
    }

    /// The speed \[m/s] at which the ball slides over the radius a of its contact in 1/ω: v = ω a, with a³ = 3 F R/(16 |G*(ω)|)
    /// by Hertz for an incompressible half space.
    fn velocity(&self, truth: &RelaxationSpectrum, omega: f64) -> Result<f64> {
        let modulus = truth.complex_modulus(omega)?;
        let magnitude = modulus.storage.hypot(modulus.loss);
        let force = self.scene.load.normal_force.context("a force")?;
        Ok(omega * (3.0 * force * BALL_RADIUS / (16.0 * magnitude)).cbrt())
    }

    /// The scene on a material at a speed \[m/s].
    fn slid(&self, material: &MaterialTable, velocity: f64) -> Scene {
        let mut scene = self.scene.clone();
        scene.material = material.clone();
        scene.load.velocity = Some(velocity);
        scene
    }
}

/// The series that `fit-material` identifies from isotherms, and the window \[rad/s] of the master curve.
fn fit(isotherms: &[Isotherm]) -> Result<(Identification, [f64; 2])> {
    let shifting = Shifting {
        reference_temperature: Some(REFERENCE_TEMPERATURE),
        ..Shifting::default()
    };
    let curve = master_curve(isotherms, true, shifting)?.master.curve;
    let found = identify(&curve, &IdentifyOptions::default())?;
    Ok((found, curve.frequencies()))
}

/// Radius of the ball \[m], as in the scene of `experiments.toml`; only for the choice of the speed.
const BALL_RADIUS: f64 = 5e-3;

/// The material of a scene: a series with the window \[rad/s] in which it was measured, and the covariance of `fit`.
fn series(
    spectrum: &RelaxationSpectrum,
    fit: Option<&Identification>,
    window: [f64; 2],
) -> MaterialTable {
    let branch = |one: &RelaxationBranch| Branch {
        modulus: one.modulus,
        relaxation_time: one.relaxation_time,
    };
    let covariance = fit.and_then(|fit| fit.covariance.as_ref());
    MaterialTable::Prony {
        equilibrium_modulus: spectrum.equilibrium_modulus(),
        viscosity: 0.0,
        branches: spectrum.branches().iter().map(branch).collect(),
        poisson_ratio: 0.5,
        valid_frequencies: Some(window),
        shift: None,
        approximation: None,
        covariance: covariance.map(|known| Covariance {
            relative: known.relative.clone(),
            method: Some(known.description()),
        }),
    }
}
