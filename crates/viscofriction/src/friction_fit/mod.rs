//! Friction as a rheometer: the moduli of a scene's material from measured friction over speed and temperature.

mod error;
mod family;
mod model;
mod prior;
mod progress;

use std::path::Path;
use std::sync::PoisonError;

use measurements::MeasurementError;
use measurements::friction::{
    FreeParameter, FrictionFit, FrictionFitting, FrictionMinimum, FrictionNoise, FrictionPoint,
};
use numerics::positive;
use serde::Serialize;

pub use error::FrictionFitError;
pub use prior::FrictionPrior;
pub use progress::{FitProgress, FitStage};

use crate::files::ReadFile;
use crate::scene::{Edges, Indenter, MaterialTable, Scene, SceneError};
use crate::solve::Problem;
use family::Family;
use model::Model;

/// What of the material is sought.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Free {
    /// Moduli and viscosities, and of power laws exponent and time; the times of a Prony series stay.
    #[default]
    Moduli,
    /// The constants of the shift law.
    Shift,
    /// All of these.
    Both,
}

/// How friction is fitted.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FrictionFitOptions {
    /// What is sought.
    pub free: Free,
    /// Errors of points without a standard error.
    pub noise: FrictionNoise,
    /// What is known of the moduli before the fit.
    pub prior: FrictionPrior,
}

/// A material found from friction.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[must_use]
pub struct FittedFriction {
    /// What the points say about the parameters.
    pub fit: FrictionFit,
    /// The material, with its shift law.
    pub material: MaterialTable,
    /// The points.
    pub points: Vec<FrictionPoint>,
    /// Speeds at the temperature of the material, by point, \[m/s].
    pub shifted_velocities: Vec<f64>,
    /// Largest relative error of the computed friction.
    pub solver_error: f64,
    /// What was taken to be known of the moduli before the fit.
    pub prior: FrictionPrior,
}

/// Points of the first search.
const FEW: usize = 8;
/// Factors of all moduli, or of the constants of the law, with which a search may begin, as powers of ten.
const SCALES: [f64; 7] = [0.0, -0.5, 0.5, -1.0, 1.0, -1.5, 1.5];
/// How many of them lead on, where none explains the points.
const STARTS: usize = 4;
/// Corrections of the grids, and the change of a logarithm below which another one changes nothing.
const CORRECTIONS: usize = 4;
const NEAR: f64 = 0.2;

/// Finds what is free of the material of a scene from points of its body; speeds, and forces and temperatures where they have
/// some, are those of the points. `watch` is told what the fit has reached.
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
    if let FrictionPrior::Relative(prior) = options.prior {
        positive("prior", prior).map_err(MeasurementError::from)?;
    }
    FrictionPoint::check_all(points).map_err(MeasurementError::from)?;
    let scene = with_load(scene, points)?;
    let family = Family::new(&scene, (folder, read), options.free)?;
    family.check_temperatures(points)?;
    let problem = Problem::new(&family.scene, folder, read)?;
    let mut model = Model::new(&family, &problem, points)?;
    let (parameters, start) = family.parameters(points);
    let known = family.known(options.prior);
    let prior = family.prior(known, &start);
    let fitting = FrictionFitting::new(points, &parameters, prior.as_ref(), options.noise)?;
    let start = first_search(&model, &family, (&fitting, &parameters), &start, watch)?;
    let (found, solver_error) = corrected(&mut model, &fitting, start, watch)?;
    let logs = &found.minimum.parameters;
    let shifted = points.iter().map(|point| {
        let (log, _) = family.shift_of(point, logs)?;
        Ok(point.velocity * log.exp())
    });
    let shifted = shifted.collect::<Result<_, rheology::RheologyError>>();
    let residual = fitting.mean_residual(&found);
    let of = parameters.len();
    let intervals = |done: usize| {
        let stage = FitStage::Intervals { done, of };
        watch(&FitProgress { stage, residual });
    };
    Ok(FittedFriction {
        fit: fitting.fit(&model, &found, &intervals)?,
        material: family.found(logs, points)?,
        points: points.to_vec(),
        shifted_velocities: shifted
            .map_err(|error| SceneError::at("material", error.to_string()))?,
        solver_error,
        prior: known,
    })
}

/// The scene at the speed and force of the first point, which stand for those of all.
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

/// Refuses surfaces without end and motions, before a surface is drawn or a motion followed.
fn check_scene(scene: &Scene) -> Result<(), SceneError> {
    let is_endless = match &scene.indenter {
        Indenter::SelfAffine(_) | Indenter::Spectrum(_) => true,
        Indenter::HeightMap(map) => map.edges != Edges::Wall,
        _ => false,
    };
    if is_endless {
        return Err(SceneError::at("indenter", ENDLESS_SURFACE));
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

const ENDLESS_SURFACE: &str = "moduli are not fitted to the friction of a rough surface without end, of which every point is a computation \
     of minutes; take the moduli from fit-material, or fit them to the friction of a ball or a cylinder on the same material, and \
     compare the friction of this scene with the measured one by `viscofriction sweep` over load.velocity";
const STEADY_SLIDING: &str = "friction is fitted at constant speeds, which are those of the table; leave this out, and give normal_force \
     without a motion";

/// A minimum of few points that explains them, or the best from some scales.
fn first_search(
    model: &Model,
    family: &Family,
    (fitting, parameters): (&FrictionFitting, &[FreeParameter]),
    start: &[f64],
    watch: &(dyn Fn(&FitProgress) + Sync),
) -> Result<Vec<f64>, FrictionFitError> {
    let few = model.some(model.points.len().div_ceil(FEW));
    let points = few.points.clone();
    let of_few = fitting.of(&points);
    let scaled = |decades: f64| -> Vec<f64> {
        let shift = decades * std::f64::consts::LN_10;
        let values = start.iter().zip(parameters).enumerate();
        let moved = values.map(|(k, (value, parameter))| {
            let [lowest, highest] = parameter.range.bounds;
            let is_scaled = family.is_stress(k) || family.n_of_material() == 0;
            let by = if is_scaled { shift } else { 0.0 };
            (value + by).clamp(lowest, highest)
        });
        moved.collect()
    };
    let mut tried = SCALES.map(|decades| {
        let start = scaled(decades);
        let sum = of_few.sum(&few, &start);
        (sum.unwrap_or(f64::INFINITY), start)
    });
    // The moduli of the scene come first.
    tried[1..].sort_by(|one, other| one.0.total_cmp(&other.0));
    let sum = |found: &FrictionMinimum| found.minimum.model.sum;
    let mut best: Option<FrictionMinimum> = None;
    for (done, (_, start)) in tried.iter().take(STARTS).enumerate() {
        let residual = best.as_ref().and_then(|best| of_few.mean_residual(best));
        let stage = FitStage::Starts { done, of: STARTS };
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

/// The minimum of all points, with grids that are corrected beside it.
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
        let solver_error = model.correct(&start)?;
        corrected += 1;
        let found = fitting.minimum(model, &start);
        let found = found.ok_or_else(|| not_converged(model))?;
        residual = fitting.mean_residual(&found);
        let moved = found.minimum.parameters.iter().zip(&start);
        let moved = moved
            .map(|(new, old)| (new - old).abs())
            .fold(0.0, f64::max);
        if moved < NEAR || corrected == CORRECTIONS {
            return Ok((found, solver_error));
        }
        start = found.minimum.parameters;
    }
}

fn not_converged(model: &Model) -> FrictionFitError {
    let refused = model.refused.lock().unwrap_or_else(PoisonError::into_inner);
    match refused.clone() {
        Some(why) => FrictionFitError::NotConverged { why: Box::new(why) },
        None => MeasurementError::NotConverged.into(),
    }
}

impl FittedFriction {
    /// The material as a file for scenes.
    ///
    /// # Errors
    /// Where it cannot be written as TOML.
    pub fn material_file(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(&toml::Table::from_iter([(
            "material".to_owned(),
            toml::Value::try_from(&self.material)?,
        )]))
    }
}
