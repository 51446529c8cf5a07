//! Fit of the moduli of a material, and of the shear strength of its contact, to friction measured over speed and temperature.

mod error;
mod family;
mod model;
mod prior;
mod progress;
mod shear;

use std::path::Path;
use std::sync::PoisonError;

use measurements::friction::{
    FreeParameter, FrictionFit, FrictionFitting, FrictionMinimum, FrictionNoise, FrictionPoint,
};
use measurements::{Finding, MeasurementError};
use numerics::positive;
use serde::{Deserialize, Serialize};

pub use error::FrictionFitError;
pub use prior::FrictionPrior;
pub use progress::{FitProgress, FitStage};

use crate::files::ReadFile;
use crate::scene::{Interface, MaterialTable, Scene, SceneError};
use crate::solve::Problem;
use family::Family;
use model::Model;

/// Parameters of a scene that may be sought together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Free {
    /// Moduli and viscosities, and of power laws exponent and time; the times of a Prony series stay.
    Moduli,
    /// The constants of the shift law.
    Shift,
    /// The numbers of the interface: its shear strength, and of a bell velocity, width and activation energy.
    Interface,
}

/// Options of the fit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrictionFitOptions {
    /// The free parameters. If it is empty, they are those of the interface, or the moduli in a scene without one.
    pub free: Vec<Free>,
    /// Noise model of points without a standard error.
    pub noise: FrictionNoise,
    /// Prior of the moduli.
    pub prior: FrictionPrior,
}

/// A scene fitted to friction.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[must_use]
pub struct FittedFriction {
    /// Fitted parameters with their statistics.
    pub fit: FrictionFit,
    /// The parameters that were sought.
    pub free: Vec<Free>,
    /// The fitted material, with its shift law.
    pub material: MaterialTable,
    /// The fitted interface; `None` if the scene has none.
    pub interface: Option<Interface>,
    /// The measured points.
    pub points: Vec<FrictionPoint>,
    /// Reduced velocity a_T v of each point, at the reference temperature, \[m/s].
    pub shifted_velocities: Vec<f64>,
    /// Largest relative error of the computed friction among the points.
    pub solver_error: f64,
    /// The prior that was applied.
    pub prior: FrictionPrior,
}

/// Largest number of measured points in the first search; of more points every n-th is taken. Chosen: the search finds start
/// values only.
const FIRST_SEARCH_POINTS: usize = 8;
/// Powers of ten by which all moduli are multiplied at the starts of the first search. If no modulus is free, they multiply
/// the constants of the shift law, and if these are not free either, the velocity of the largest shear strength. Chosen: steps of
/// a factor of 3 up to 32 either way, more than the error of a modulus from another sample of the material.
const START_DECADES: [f64; 7] = [0.0, -0.5, 0.5, -1.0, 1.0, -1.5, 1.5];
/// Largest number of starts from which the first search follows the sum of squares to a minimum: the start of the scene and
/// those with the smallest sums. Chosen: about half of the scaled starts, as a bound of the time.
const MAX_STARTS: usize = 4;
/// Largest number of times that the ratio of fine to coarse solution is computed for all points. Chosen: it bounds the time,
/// most of which fine solutions take. After the last one the fit ends even if the parameters have moved by more than
/// [`CORRECTION_REACH`].
const MAX_CORRECTIONS: usize = 4;
/// Largest change of the natural logarithm of any parameter up to which the ratio of fine to coarse solution still counts as
/// known. After a larger change the ratio is computed again. Chosen: the ratio is near 1, and changes far more slowly than
/// the friction.
const CORRECTION_REACH: f64 = 0.2;

/// Fits the free parameters of the material and the interface of a scene to measured friction of its body. Velocities, and forces
/// and temperatures if stated, are those of the points. `watch` receives the progress.
///
/// # Errors
/// [`FrictionFitError`] with the reason.
pub fn fit_friction(
    scene: &Scene,
    (folder, read): (&Path, ReadFile),
    points: &[FrictionPoint],
    options: &FrictionFitOptions,
    watch: &(dyn Fn(&FitProgress) + Sync),
) -> Result<FittedFriction, FrictionFitError> {
    // Refuse a prior, points or a scene that cannot be used, before anything is computed.
    if let FrictionPrior::Relative(prior) = options.prior {
        positive("prior", prior).map_err(MeasurementError::from)?;
    }
    FrictionPoint::check_all(points).map_err(MeasurementError::from)?;
    let scene = with_load(scene, points)?;
    let free = match (&options.free[..], &scene.interface) {
        ([], Some(_)) => vec![Free::Interface],
        ([], None) => vec![Free::Moduli],
        (given, _) => given.to_vec(),
    };
    let family = Family::new(&scene, (folder, read), &free, points)?;
    family.check_temperatures(points)?;
    // The problem is that of hysteresis. The family adds the shear of each point at its own temperature.
    let interface = None;
    let without_shear = Scene {
        interface,
        ..family.scene.clone()
    };
    let problem = Problem::new(&without_shear, folder, read)?;
    let mut model = Model::new(&family, &problem, points)?;
    // Set up the least squares: the free parameters with their start values, and what is known of them before the fit as a prior.
    let (parameters, start) = family.parameters(points);
    let known = family.known(options.prior);
    let prior = family.prior(known, &start);
    let fitting = FrictionFitting::new(points, &parameters, prior.as_ref(), options.noise)?;
    family.strengths(points, &start)?;
    if family.is_material_fixed() {
        let (stage, residual) = (FitStage::Contacts, None);
        watch(&FitProgress { stage, residual });
        model.correct(&start)?;
    }
    // Fit a part of the points on coarse grids for the start values, then all points on grids corrected by fine solutions.
    let start = first_search(&model, &family, (&fitting, &parameters), &start, watch)?;
    let (found, solver_error) = corrected(&mut model, &fitting, start, watch)?;
    // Evaluate the minimum: the velocities reduced to the reference temperature by the shift law, the statistics and the
    // intervals.
    let logs = &found.minimum.parameters;
    let reduced_velocity = |point: &FrictionPoint| {
        let (log, _) = family.shift_of(point, logs)?;
        Ok(point.velocity * log.exp())
    };
    let shifted = points
        .iter()
        .map(reduced_velocity)
        .collect::<Result<_, rheology::RheologyError>>();
    let residual = fitting.mean_residual(&found);
    let of = parameters.len();
    let intervals = |done: usize| {
        let stage = FitStage::Intervals { done, of };
        watch(&FitProgress { stage, residual });
    };
    let mut fit = fitting.fit(&model, &found, &intervals)?;
    fit.flags.extend(undetermined_shear(&fit));
    Ok(FittedFriction {
        fit,
        free,
        material: family.fitted_table(logs, points)?,
        interface: family.interface(logs)?,
        points: points.to_vec(),
        shifted_velocities: shifted
            .map_err(|error| SceneError::at("material", error.to_string()))?,
        solver_error,
        prior: known,
    })
}

/// Warning if the points do not determine some number of the interface.
fn undetermined_shear(fit: &FrictionFit) -> Option<String> {
    let findings = fit.findings.iter();
    let is_open =
        |finding: &&Finding| finding.estimate.is_none() && finding.name.starts_with("interface.");
    let open: Vec<&str> = findings.filter(is_open).map(|one| &one.name[..]).collect();
    (!open.is_empty()).then(|| {
        format!(
            "the points do not determine {}: the shear strength of the fit holds at their speeds and temperatures only",
            open.join(", ")
        )
    })
}

/// The scene with the velocity of the first point, and its force if all points have one and the scene prescribes no depth.
/// Checked once, it stands for all points.
fn with_load(scene: &Scene, points: &[FrictionPoint]) -> Result<Scene, FrictionFitError> {
    let first = points.first().ok_or(MeasurementError::TooFewPoints {
        needed: 1,
        given: 0,
    })?;
    check_scene(scene)?;
    let mut scene = scene.clone();
    scene.load.velocity = Some(first.velocity);
    let has_force = points.iter().all(|point| point.normal_force.is_some());
    if has_force && scene.load.indentation_depth.is_none() {
        scene.load.normal_force = first.normal_force;
    }
    Ok(scene)
}

/// Rejects periodic surfaces, motions and histories, before a random surface is drawn or a file read.
fn check_scene(scene: &Scene) -> Result<(), SceneError> {
    if scene.indenter.is_periodic() {
        return Err(SceneError::at("indenter", ENDLESS_SURFACE));
    }
    if scene.heat.is_some() {
        return Err(SceneError::at("heat", WITHOUT_HEAT));
    }
    if scene.strain.is_some() {
        return Err(SceneError::at("strain", WITHOUT_STRAIN));
    }
    let load = &scene.load;
    let moves = [
        ("stroke", load.stroke.is_some()),
        ("motion", load.motion.is_some()),
        ("motion_file", load.motion_file.is_some()),
        ("history", load.history.is_some()),
        ("history_file", load.history_file.is_some()),
    ];
    match moves.iter().find(|(_, is_given)| *is_given) {
        Some((key, _)) => Err(SceneError::at(format!("load.{key}"), STEADY_SLIDING)),
        None => Ok(()),
    }
}

/// Message if the body of the scene is a periodic surface, to which moduli are not fitted.
const ENDLESS_SURFACE: &str = "moduli are not fitted to the friction of a rough surface without end, of which every point is a computation \
     of minutes; take the moduli from fit-material, or fit them to the friction of a ball or a cylinder on the same material, and \
     compare the friction of this scene with the measured one by `viscofriction sweep` over load.velocity";
/// Message if the scene has heat, which the model of the fit does not contain.
const WITHOUT_HEAT: &str = "the fit takes the temperatures of the table as those of the material in the contact; give measurements at \
     speeds at which it is not heated, and leave [heat] out";
/// Message if the scene has strain dependence, by which moduli would not be free.
const WITHOUT_STRAIN: &str = "the fit takes moduli that do not depend on the strain; leave [strain] out, and compare by `viscofriction sweep`";
/// Message if the scene has a motion or a history instead of sliding at constant speed.
const STEADY_SLIDING: &str = "friction is fitted at constant speeds, which are those of the table; leave this out, and give normal_force \
     without a motion";

/// Least squares of at most [`FIRST_SEARCH_POINTS`] points on coarser grids, or of all points if their contacts are solved already.
/// The starts are `start` itself, then its multiples by [`START_DECADES`] in order of their sum of squares. Returns the logarithms
/// of the parameters at the first minimum that noise explains, else at the lowest minimum.
fn first_search(
    model: &Model,
    family: &Family,
    (fitting, parameters): (&FrictionFitting, &[FreeParameter]),
    start: &[f64],
    watch: &(dyn Fn(&FitProgress) + Sync),
) -> Result<Vec<f64>, FrictionFitError> {
    let step = if family.is_material_fixed() {
        1
    } else {
        model.points.len().div_ceil(FIRST_SEARCH_POINTS)
    };
    let few = model.every_nth_point(step);
    let points = few.points.clone();
    let of_few = fitting.of(&points);
    let scaled = |decades: f64| -> Vec<f64> {
        let shift = decades * std::f64::consts::LN_10;
        let values = start.iter().zip(parameters).enumerate();
        let moved = values.map(|(k, (value, parameter))| {
            let [lowest, highest] = parameter.range.bounds;
            let by = if family.is_scaled_at_start(k) {
                shift
            } else {
                0.0
            };
            (value + by).clamp(lowest, highest)
        });
        moved.collect()
    };
    // Compute the sum of squares at each scaled start, so that the search begins only from the best ones.
    let mut tried = START_DECADES.map(|decades| {
        let start = scaled(decades);
        let sum = of_few.sum(&few, &start);
        (sum.unwrap_or(f64::INFINITY), start)
    });
    // Sort the starts by their sums. The start of the scene itself stays first, whatever its sum is.
    tried[1..].sort_by(|one, other| one.0.total_cmp(&other.0));
    // Follow the sum of squares from the best starts to a minimum, and keep the lowest one. End early if noise explains its sum.
    let sum = |found: &FrictionMinimum| found.minimum.model.sum;
    let mut best: Option<FrictionMinimum> = None;
    for (done, (_, start)) in tried.iter().take(MAX_STARTS).enumerate() {
        let residual = best.as_ref().and_then(|best| of_few.mean_residual(best));
        let stage = FitStage::Starts {
            done,
            of: MAX_STARTS,
        };
        watch(&FitProgress { stage, residual });
        let found = of_few.minimum(&few, start);
        let known = best.as_ref().map_or(f64::INFINITY, sum);
        best = found.filter(|found| sum(found) < known).or(best);
        if best.as_ref().is_some_and(|best| of_few.explains(sum(best))) {
            break;
        }
    }
    let best = best.ok_or_else(|| not_converged(&few))?;
    Ok(best.minimum.parameters)
}

/// Least squares of all points, with the coarse solutions corrected at the start of each round. Rounds end when the parameters
/// move by less than [`CORRECTION_REACH`]. Returns the minimum and the largest relative error of the corrected friction.
fn corrected(
    model: &mut Model,
    fitting: &FrictionFitting,
    mut start: Vec<f64>,
    watch: &(dyn Fn(&FitProgress) + Sync),
) -> Result<(FrictionMinimum, f64), FrictionFitError> {
    let (mut corrected, mut residual) = (0, None);
    loop {
        let stage = FitStage::LeastSquares { done: corrected };
        watch(&FitProgress { stage, residual });
        // Compute the ratio of fine to coarse solutions at the current parameters, then minimise with these ratios held constant.
        let solver_error = model.correct(&start)?;
        corrected += 1;
        let found = fitting
            .minimum(model, &start)
            .ok_or_else(|| not_converged(model))?;
        residual = fitting.mean_residual(&found);
        // Stop if the minimum is so close to the parameters of the correction that the ratios still hold there.
        let moved = found
            .minimum
            .parameters
            .iter()
            .zip(&start)
            .map(|(new, old)| (new - old).abs())
            .fold(0.0, f64::max);
        if moved < CORRECTION_REACH || corrected == MAX_CORRECTIONS {
            return Ok((found, solver_error));
        }
        start = found.minimum.parameters;
    }
}

/// Error if no minimum was found: caused by the last error of the model, if there was one.
fn not_converged(model: &Model) -> FrictionFitError {
    let refused = model.refused.lock().unwrap_or_else(PoisonError::into_inner);
    match refused.clone() {
        Some(why) => FrictionFitError::NotConverged { why: Box::new(why) },
        None => MeasurementError::NotConverged.into(),
    }
}

/// Number of speeds at which a fitted curve is computed for the output. Chosen; it does not change the fit.
const N_CURVE: usize = 40;
/// Relative error requested of the friction along a fitted curve. Chosen; it does not change the fit.
const CURVE_ERROR: f64 = 5e-3;

impl FittedFriction {
    /// Friction of the fitted scene over the reduced velocity \[m/s], at equal factors over the range of the points; `scene` and
    /// `files` are those of the fit.
    ///
    /// It is empty if the points have several forces, or shear at another than the reference temperature, because friction is then no
    /// function of the reduced velocity. Velocities at which the scene has no answer are left out.
    pub fn curve(&self, scene: &Scene, (folder, read): (&Path, ReadFile)) -> Vec<[f64; 2]> {
        let has_one_force = self
            .points
            .windows(2)
            .all(|pair| pair[0].normal_force == pair[1].normal_force);
        let mut pairs = self.points.iter().zip(&self.shifted_velocities);
        let has_no_shift = pairs.all(|(point, shifted)| point.velocity.total_cmp(shifted).is_eq());
        let range = self.shifted_velocities.iter();
        let [low, high] = range.fold([f64::INFINITY, 0.0_f64], |[low, high], velocity| {
            [low.min(*velocity), high.max(*velocity)]
        });
        let Ok(mut scene) = with_load(scene, &self.points) else {
            return Vec::new();
        };
        let is_function = has_one_force && (has_no_shift || self.interface.is_none());
        if !is_function || high <= low {
            return Vec::new();
        }
        scene.material = self.material.clone();
        scene.interface.clone_from(&self.interface);
        scene.solve.relative_error = Some(CURVE_ERROR);
        scene.solve.elements = None;
        let point = |index: usize| {
            let part = index as f64 / (N_CURVE - 1) as f64;
            let velocity = low * (high / low).powf(part);
            let mut scene = scene.clone();
            scene.load.velocity = Some(velocity);
            let problem = Problem::new(&scene, folder, read).ok()?;
            let answer = crate::solve::solve(&problem).ok()?;
            Some([velocity, answer.friction_coefficient?.value])
        };
        (0..N_CURVE).filter_map(point).collect()
    }

    /// The material as a TOML file for scenes.
    ///
    /// # Errors
    /// If the material cannot be written as TOML.
    pub fn material_file(&self) -> Result<String, toml::ser::Error> {
        table_file("material", &self.material)
    }

    /// The interface as TOML for scenes; `None` if the scene has none.
    ///
    /// # Errors
    /// If the interface cannot be written as TOML.
    pub fn interface_file(&self) -> Result<Option<String>, toml::ser::Error> {
        let interface = self.interface.as_ref();
        interface
            .map(|table| table_file("interface", table))
            .transpose()
    }
}

/// TOML with one table.
fn table_file(name: &str, table: &impl Serialize) -> Result<String, toml::ser::Error> {
    let value = toml::Value::try_from(table)?;
    toml::to_string(&toml::Table::from_iter([(name.to_owned(), value)]))
}
