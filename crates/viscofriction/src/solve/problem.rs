//! The validated problem of a scene.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use bem_halfspace::heat::DepthProfile;
use bem_halfspace::{BemError, Layer, ShiftOfWave, WaveShift};
use indenters::{Control, HistoryPoint, IndenterError, MovingLoad, PressingLoad, SlidingLoad};
use numerics::positive;
use rheology::{Material, ModulusFactors, RheologyError, StrainDependence};

use super::body::{Body, BodyOfScene, body};
use super::error::SolveError;
use super::expansion::Expansion;
use super::half_space::{Simple, simple};
use super::heat::Heating;
use super::parts::Parts;
use super::sensitivity::check_uncertainties;
use super::shear::Shear;
use crate::files::{Files, ReadFile};
use crate::scene::{Accuracy, Method, Model, Scene, SceneError, Shift};
use crate::text::WrongInput;

/// A validated scene, as the methods receive it.
///
/// It is immutable because its parts depend on each other: to solve another problem, change the scene.
///
/// ```compile_fail
/// fn another_material(problem: &mut viscofriction::Problem) {
///     problem.material = Box::new(viscofriction::rheology::Elastic::new(1e6).unwrap());
/// }
/// ```
#[derive(Debug, Clone)]
pub struct Problem {
    /// Body and elastomer.
    parts: Parts,
    /// Thickness of the elastomer, \[m]; infinite for a half space.
    thickness: f64,
    motion: Motion,
    /// Shear strength of the contact; `None` if only hysteresis is computed.
    shear: Option<Shear>,
    /// Heat of sliding; `None` if the temperature is not computed.
    heating: Option<Heating>,
    /// Factors of the moduli over the strain; `None` for the moduli of small strains.
    strain: Option<StrainDependence>,
    /// Factors of the moduli at one strain.
    factors: ModulusFactors,
    /// Temperature rise below a periodic surface; `None` for one temperature.
    by_depth: Option<DepthProfile>,
    /// Shift of the material by the wavelength, which follows from it.
    wave_shift: Option<WaveShift>,
    accuracy: Accuracy,
    method: Option<Method>,
    model: Model,
    threads: Option<usize>,
    /// Memory limit of one solution, \[bytes]; `None` for no limit.
    max_memory: Option<u64>,
    /// True once the memory limit has rejected a grid.
    is_short_of_memory: Arc<AtomicBool>,
    /// The material reduced to one with closed forms; `None` if it has none.
    simple: Option<Simple>,
    /// The scene from which random surfaces are drawn; `None` for a single surface.
    realisations: Option<Realisations>,
    /// Length \[m] below which waves of the surface were removed; `None` if none were.
    shortest_wavelength: Option<f64>,
    /// True if the answer has the gap between body and elastomer.
    wants_gap: bool,
}

/// The source of the surfaces of a random body.
#[derive(Debug, Clone)]
struct Realisations {
    /// Largest number of surfaces.
    count: u64,
    /// Relative standard error of the mean at which sampling stops; `None` for all `count` surfaces.
    standard_error: Option<f64>,
    /// The scene, from which the problem of each surface is built.
    scene: Scene,
    folder: PathBuf,
    read: ReadFile,
}

/// Load and motion of the body.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// Sliding under a force or at a depth, to the stationary state or over a distance.
    Sliding(SlidingLoad),
    /// Indentation with a force or to a depth for a duration, without sliding.
    Pressing(PressingLoad),
    /// Indentation along a history.
    History {
        /// Forces or depths over time.
        points: Vec<HistoryPoint>,
        /// Force or depth of the last point.
        last: Control,
    },
    /// Reciprocating motion, or motion through given positions.
    Moving(MovingLoad),
}

impl Motion {
    /// The given force or depth: of a history the last, of a motion the largest.
    pub fn control(&self) -> Control {
        match self {
            Self::Sliding(load) => load.control(),
            Self::Pressing(load) => load.control(),
            Self::History { last, .. } => *last,
            Self::Moving(load) => load.largest_control(),
        }
    }

    /// Sliding distance since first touch, \[m]; `None` for the stationary state, and unless the body slides at constant speed.
    pub fn sliding_distance(&self) -> Option<f64> {
        match self {
            Self::Sliding(load) => load.sliding_distance(),
            Self::Pressing(_) | Self::History { .. } | Self::Moving(_) => None,
        }
    }
}

impl Problem {
    /// The problem of a scene; files that it names are in `folder` and read by `read`.
    ///
    /// # Errors
    /// [`SceneError`] for the first number that is out of range.
    pub fn new(scene: &Scene, folder: &Path, read: ReadFile) -> Result<Self, SceneError> {
        let parts = Parts::new(scene, &Files::of(scene, folder, read)?)?;
        Self::with_parts(scene, parts, folder, read)
    }

    /// The problem of a scene with the given body and elastomer in the place of its own.
    ///
    /// # Errors
    /// [`SceneError`] for a scene that [`Self::new`] refuses, too.
    pub fn with_parts(
        scene: &Scene,
        parts: Parts,
        folder: &Path,
        read: ReadFile,
    ) -> Result<Self, SceneError> {
        let files = Files::of(scene, folder, read)?;
        let body = &parts.body.body;
        // Read the load, and classify the problem by what it contains: a history of indentation, a motion along the surface, or
        // one load.
        let points = scene.load.checked_history(&files)?.unwrap_or_default();
        let moving = scene.load.checked_motion(body.period_area(), &files)?;
        let motion = match (points.last().map(|last| last.control), moving) {
            (Some(last), _) => ended(scene, Motion::History { points, last })?,
            (None, Some(moving)) => ended(scene, Motion::Moving(moving))?,
            (None, None) => motion(scene, body)?,
        };
        let thickness = match scene.layer {
            Some(layer) => positive("layer.thickness", layer.thickness)?,
            None => f64::INFINITY,
        };
        let strain = scene.strain.as_ref().map(|table| table.law(&files));
        let law = scene.interface.as_ref().map(|table| table.law(&files));
        let heating = Heating::of(scene, &parts.half_space)?;
        let ambient = heating.as_ref().and_then(|heating| heating.ambient);
        let temperature = ambient.or(parts.half_space.temperature());
        let shear = law.transpose()?.map(|law| Shear {
            law,
            temperature,
            factor: 1.0,
        });
        let not_reduced = |error: RheologyError| SceneError::at("material", error.to_string());
        let of_method = scene.solve.method.and_then(Method::model);
        let (count, standard_error) = scene.indenter.realisations()?;
        let realisations = (count > 1).then(|| Realisations {
            count,
            standard_error,
            scene: scene.clone(),
            folder: folder.to_owned(),
            read,
        });
        let mut problem = Self {
            simple: simple(&*parts.half_space.material).map_err(not_reduced)?,
            parts,
            thickness,
            motion,
            shear,
            heating,
            strain: strain.transpose()?,
            factors: ModulusFactors::NONE,
            by_depth: None,
            wave_shift: None,
            accuracy: scene
                .solve
                .accuracy(scene.strain.is_some() || scene.heat.is_some())?,
            method: scene.solve.method,
            model: scene.solve.model.or(of_method).unwrap_or(Model::HalfSpace),
            threads: scene.solve.checked_threads()?,
            max_memory: files.memory,
            is_short_of_memory: Arc::default(),
            realisations,
            shortest_wavelength: None,
            wants_gap: false,
        };
        if let Some(ambient) = ambient {
            let refused = |error: SceneError| error.moved_to("heat.ambient_temperature");
            problem = problem.at_temperature(ambient).map_err(refused)?;
        }
        // Reject combinations of body, material and load that no method answers, and uncertainties that are out of range.
        problem.check_control()?;
        problem.check_track()?;
        problem.check_layer()?;
        problem.check_interface()?;
        problem.check_heat()?;
        problem.check_strain()?;
        check_uncertainties(scene, folder, read)?;
        Ok(problem)
    }

    /// Replaces the accuracy, also by one that scenes may not request.
    #[must_use]
    pub const fn with_accuracy(mut self, accuracy: Accuracy) -> Self {
        self.accuracy = accuracy;
        self
    }

    /// Asks for the [gap](super::answer::Fields::gap) between body and elastomer, which takes one more product with the kernel.
    #[must_use]
    pub const fn with_gap(mut self) -> Self {
        self.wants_gap = true;
        self
    }

    /// True if the answer has the gap between body and elastomer.
    pub(super) const fn wants_gap(&self) -> bool {
        self.wants_gap
    }

    /// Sets a memory limit, \[bytes], unless the scene gives one.
    #[must_use]
    pub fn or_max_memory(mut self, bytes: Option<u64>) -> Self {
        self.max_memory = self.max_memory.or(bytes);
        self
    }

    /// Largest number of random surfaces to average; 1 for other bodies.
    pub fn realisations(&self) -> u64 {
        self.realisations.as_ref().map_or(1, |of| of.count)
    }

    /// Relative standard error of the mean at which sampling of random surfaces stops; `None` if it is not requested.
    pub fn standard_error(&self) -> Option<f64> {
        self.realisations.as_ref().and_then(|of| of.standard_error)
    }

    /// Seeds of the random surfaces; empty for other bodies.
    pub(super) fn seeds(&self) -> Vec<u64> {
        let all = self.realisations.iter();
        let seed = |of: &Realisations, index| Some(of.scene.indenter.realisation(index)?.1);
        all.flat_map(|of| (0..of.count).filter_map(move |index| seed(of, index)))
            .collect()
    }

    /// The problem for one of the random surfaces, counted from 0, with one of `parts` equal parts of the memory. It has the
    /// same accuracy and cut-off wavelength.
    pub(super) fn realisation_problem(&self, surface: u64, parts: u64) -> Result<Self, SceneError> {
        let nothing_random = || SceneError::at("indenter", "no surface is drawn".to_owned());
        let of = self.realisations.as_ref().ok_or_else(nothing_random)?;
        let (indenter, _) = of
            .scene
            .indenter
            .realisation(surface)
            .ok_or_else(nothing_random)?;
        let mut scene = of.scene.clone();
        scene.indenter = indenter;
        scene.solve.limit_memory(self.max_memory, parts)?;
        let files = Files::of(&scene, &of.folder, of.read)?;
        let with_surface = Parts {
            body: Arc::new(body(&scene.indenter, &files)?),
            ..self.parts.clone()
        };
        let mut problem = Self::with_parts(&scene, with_surface, &of.folder, of.read)?;
        problem.accuracy = self.accuracy;
        problem.wants_gap = self.wants_gap;
        if parts == 1 {
            problem.is_short_of_memory = Arc::clone(&self.is_short_of_memory);
        }
        if let Some(shortest) = self.shortest_wavelength {
            problem = problem.without_waves_below(shortest)?;
        }
        Ok(problem)
    }

    /// Removes the waves of a periodic surface that are shorter than a length \[m].
    ///
    /// # Errors
    /// [`SceneError`] if no wave remains, and for any other body.
    pub fn without_waves_below(mut self, shortest: f64) -> Result<Self, SceneError> {
        let Body::Periodic(surface) = self.body() else {
            let problem = "only a surface that repeats itself is a sum of waves: a self-affine one, one of a spectrum, and a height map \
                           with edges = \"periodic\" or \"mirrored\"";
            return Err(SceneError::at("indenter", problem));
        };
        let kept = surface.without_waves_below(shortest).ok_or_else(|| {
            let problem = format!("it has no wave of {shortest:e} m or longer");
            SceneError::at("indenter", problem)
        })?;
        self.parts.body = Arc::new(BodyOfScene {
            body: Body::Periodic(kept),
            warnings: self.warnings().to_vec(),
        });
        self.shortest_wavelength = Some(shortest);
        Ok(self)
    }

    /// Rigid body that is pressed or slides.
    pub fn body(&self) -> &Body {
        &self.parts.body.body
    }

    /// Body and elastomer without the load, to be shared with problems of other loads.
    pub const fn parts(&self) -> &Parts {
        &self.parts
    }

    /// Warnings about the files of the body, repeated by every answer.
    pub fn warnings(&self) -> &[String] {
        &self.parts.body.warnings
    }

    /// Linear viscoelastic material of the elastomer.
    pub fn material(&self) -> &dyn Material {
        &*self.parts.half_space.material
    }

    /// Thickness of the elastomer, \[m]; infinite for a half space.
    pub const fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Accuracy of the Prony series that approximates the material; `None` if the material is exact.
    pub fn expansion(&self) -> Option<Expansion> {
        self.parts.half_space.expansion
    }

    /// Range of angular frequencies covered by measurements, \[rad/s]; `None` if the scene states none.
    pub fn window(&self) -> Option<[f64; 2]> {
        self.parts.half_space.window
    }

    /// Load and motion of the body.
    pub const fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Shear strength of the contact; `None` if only hysteresis is computed.
    pub(super) const fn shear(&self) -> Option<&Shear> {
        self.shear.as_ref()
    }

    /// Heat of sliding; `None` if the temperature is not computed.
    pub(super) const fn heating(&self) -> Option<&Heating> {
        self.heating.as_ref()
    }

    /// Factors of the moduli over the strain; `None` for the moduli of small strains.
    pub(super) const fn strain_dependence(&self) -> Option<&StrainDependence> {
        self.strain.as_ref()
    }

    /// Factors of the moduli.
    pub(super) const fn modulus_factors(&self) -> ModulusFactors {
        self.factors
    }

    /// The problem whose moduli have factors.
    pub(super) fn with_modulus_factors(&self, factors: ModulusFactors) -> Self {
        Self {
            factors,
            ..self.clone()
        }
    }

    /// The problem with another factor on its shear strength.
    pub(super) fn with_shear_factor(mut self, factor: f64) -> Self {
        if let Some(shear) = &mut self.shear {
            shear.factor = factor;
        }
        self
    }

    /// The problem with the moduli of small strains.
    pub(super) fn at_small_strains(&self) -> Self {
        Self {
            strain: None,
            ..self.clone()
        }
    }

    /// True if the answer depends on the temperature: the material has a shift law, or the shear strength depends on it.
    pub(super) fn depends_on_temperature(&self) -> bool {
        self.shift().is_some() || self.shear_depends_on_temperature()
    }

    /// True if the shear strength depends on the temperature.
    pub(super) fn shear_depends_on_temperature(&self) -> bool {
        let depends = |shear: &Shear| shear.law.strength.depends_on_temperature();
        self.shear.as_ref().is_some_and(depends)
    }

    /// Temperature dependence of the material; `None` if it is not known.
    pub(super) fn shift(&self) -> Option<&Shift> {
        self.parts.half_space.shift()
    }

    /// Highest temperature at which material and shear strength are known, \[°C]; infinite if there is none.
    pub(super) fn highest_temperature(&self) -> f64 {
        let of_shear = self
            .shear
            .as_ref()
            .map(|shear| shear.law.strength.highest_temperature());
        let of_material = self.shift().map(|shift| shift.temperature_range[1]);
        [of_shear, of_material]
            .into_iter()
            .flatten()
            .fold(f64::INFINITY, f64::min)
    }

    /// The problem with material and shear strength at a temperature \[°C]; those that do not depend on it stay the same.
    ///
    /// # Errors
    /// [`SceneError`] for a temperature outside the range of the shift law.
    pub(super) fn at_temperature(&self, celsius: f64) -> Result<Self, SceneError> {
        let mut problem = Self {
            by_depth: None,
            wave_shift: None,
            ..self.clone()
        };
        if let Some(shifted) = self.parts.half_space.at(celsius) {
            let half_space = shifted?;
            let not_reduced = |error: RheologyError| SceneError::at("material", error.to_string());
            problem.simple = simple(&*half_space.material).map_err(not_reduced)?;
            problem.parts.half_space = Arc::new(half_space);
        }
        if let Some(shear) = &mut problem.shear {
            shear.temperature = Some(celsius);
        }
        Ok(problem)
    }

    /// The problem whose material has the temperature of the depth where it dissipates, and whose shear strength has that of the contact: the
    /// temperature `ambient` \[°C] and the rise below the surface. On a period each wave has a temperature, by which the material of the
    /// problem itself is shifted.
    ///
    /// What is hotter than the laws allow takes their highest temperature.
    ///
    /// # Errors
    /// [`SceneError`] as for [`Self::at_temperature`].
    pub(super) fn with_rises(
        mut self,
        ambient: f64,
        by_depth: DepthProfile,
    ) -> Result<Self, SceneError> {
        let highest = self.highest_temperature();
        // Rises may be negative by rounding.
        let at = |rise: f64| (ambient + rise).min(highest).max(ambient);
        if !matches!(self.body(), Body::Periodic(_)) {
            self = self.at_temperature(at(by_depth.mean().value))?;
        } else if let Some(shift) = self.parts.half_space.shift() {
            let refused = |error: RheologyError| SceneError::at("heat", error.to_string());
            let wave = |wave_number: f64| {
                let celsius = at(by_depth.of_wave(wave_number));
                Ok(ShiftOfWave {
                    wave_number,
                    time_factor: 10_f64.powf(shift.log10_factor(celsius)?),
                    modulus_factor: shift.modulus_factor(celsius)?,
                })
            };
            let waves = by_depth.wave_numbers().into_iter().map(wave);
            let waves = waves.collect::<Result<Vec<_>, _>>().map_err(refused)?;
            let shift = WaveShift::new(&waves);
            self.wave_shift = Some(shift.map_err(|error| refused(error.into()))?);
        }
        if let Some(shear) = &mut self.shear {
            shear.temperature = Some(at(by_depth.contact()));
        }
        self.by_depth = Some(by_depth);
        Ok(self)
    }

    /// Temperature rise below the surface; `None` for one temperature.
    pub(super) const fn by_depth(&self) -> Option<&DepthProfile> {
        self.by_depth.as_ref()
    }

    /// Shift of the material by the wavelength; `None` for the same material under all waves.
    pub(super) const fn wave_shift(&self) -> Option<&WaveShift> {
        self.wave_shift.as_ref()
    }

    /// Length of the closed track, after which the body returns to the same place, \[m]; `None` without a track.
    pub const fn track(&self) -> Option<f64> {
        match &self.motion {
            Motion::Sliding(load) => load.track(),
            _ => None,
        }
    }

    /// Time scales of the load, \[s]: the holding time, or the stages of a history or motion and its total duration. Empty for
    /// sliding at constant speed.
    pub(super) fn durations(&self) -> Vec<f64> {
        match &self.motion {
            Motion::Sliding(_) => Vec::new(),
            Motion::Pressing(load) => vec![load.duration()],
            Motion::Moving(load) => {
                let each = load.stages().iter().map(indenters::Stage::duration);
                each.chain([load.duration()]).collect()
            }
            Motion::History { points, .. } => {
                let between = points.windows(2).map(|pair| pair[1].time - pair[0].time);
                let ends = points.last().zip(points.first());
                let all = ends.map(|(last, first)| last.time - first.time);
                between.filter(|time| *time > 0.0).chain(all).collect()
            }
        }
    }

    /// Accuracy that is requested of the answer.
    pub const fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// The method that the scene names; `None` if the cheapest is chosen.
    pub const fn method(&self) -> Option<Method> {
        self.method
    }

    /// Model of the elastomer: half space or layer, or the one-dimensional model.
    pub const fn model(&self) -> Model {
        self.model
    }

    /// Number of threads that the scene requests; the caller provides them.
    pub const fn threads(&self) -> Option<usize> {
        self.threads
    }

    /// Memory limit of one solution, \[bytes]; `None` for no limit.
    pub const fn max_memory(&self) -> Option<u64> {
        self.max_memory
    }

    /// True if the memory limit has rejected a grid, so that more memory may change the answer.
    pub fn is_short_of_memory(&self) -> bool {
        self.is_short_of_memory.load(Ordering::Relaxed)
    }

    /// Records that the memory limit has rejected a grid.
    pub(super) fn set_short_of_memory(&self) {
        self.is_short_of_memory.store(true, Ordering::Relaxed);
    }

    /// The reduced material if it has closed forms, else `None`.
    pub(crate) const fn simple(&self) -> Option<&Simple> {
        self.simple.as_ref()
    }

    /// The viscoelastic layer, or the half space if the scene has no layer.
    pub(crate) fn elastomer(&self) -> Result<Layer<'_, dyn Material>, SolveError> {
        let layer = Layer::new(&*self.parts.half_space.material, self.thickness);
        let layer = layer.map_err(BemError::from)?;
        let layer = layer.with_modulus_factors(self.factors);
        Ok(match &self.wave_shift {
            None => layer,
            Some(shift) => layer.with_wave_shift(shift.clone()),
        })
    }

    /// Rejects sliding at a given depth over a half space whose material a Prony series approximates: the force depends on
    /// times beyond every range.
    fn check_control(&self) -> Result<(), SceneError> {
        if self.expansion().is_some()
            && self.model == Model::HalfSpace
            && matches!(self.motion, Motion::Sliding(_))
            && matches!(self.motion.control(), Control::IndentationDepth(_))
        {
            let problem = "on the half space the depth in sliding depends on times beyond time_range of the \
                           material; give load.normal_force";
            return Err(SceneError::at("load.indentation_depth", problem));
        }
        Ok(())
    }

    /// Rejects a layer in the one-dimensional model.
    fn check_layer(&self) -> Result<(), SceneError> {
        if self.thickness.is_finite() && self.model == Model::Line {
            let problem = "the scene asks for the one-dimensional model, and it knows no layer; boundary elements do";
            return Err(SceneError::at("layer", problem));
        }
        Ok(())
    }

    /// Rejects a track of a periodic surface or on a material that flows.
    fn check_track(&self) -> Result<(), SceneError> {
        let problem = match self.track() {
            Some(_) if matches!(self.body(), Body::Periodic(_)) => OWN_PERIOD,
            Some(_) if self.material().creep().fluidity() > 0.0 => NO_PASS,
            _ => return Ok(()),
        };
        Err(SceneError::at("load.track", problem))
    }
}

/// The problem of a scene that names no file.
impl TryFrom<&Scene> for Problem {
    type Error = SceneError;

    fn try_from(scene: &Scene) -> Result<Self, SceneError> {
        Self::new(scene, Path::new(""), no_files)
    }
}

/// Rejects a file reference in a scene without a folder.
fn no_files(path: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    let problem = "a scene in memory names no file; Problem::new reads one";
    Err(WrongInput(format!("{}: {problem}", path.display())))
}

/// A history or motion as given, which ends with its own points or cycles; rejects a duration, a distance and a track beside
/// it.
fn ended(scene: &Scene, motion: Motion) -> Result<Motion, SceneError> {
    let times = [
        ("solve.duration", scene.solve.duration),
        ("solve.sliding_distance", scene.solve.sliding_distance),
    ];
    let problem = match motion {
        Motion::History { .. } => "a history ends with its last point; leave this out",
        _ => {
            "a motion ends with its last point, or goes on until its cycles are alike; leave this out"
        }
    };
    SceneError::none_given(&times, problem)?;
    SceneError::none_given(&[("load.track", scene.load.track)], NO_TRACK)?;
    Ok(motion)
}

/// Message for a track without sliding at constant speed.
const NO_TRACK: &str =
    "a track needs a body that slides at load.velocity, and nothing slides here; leave this out";
/// Message for a track with a periodic surface.
const OWN_PERIOD: &str = "a periodic surface meets each place again after its own period, which is its track; leave this out";
/// Message for a track on a material that flows.
const NO_PASS: &str = "a material that flows gives way further in every pass, and none is like the one before; give it an equilibrium \
                       modulus, or leave the track out";
/// Message for a track with a duration or a sliding distance.
const ENDLESS: &str =
    "on a track the stationary state is answered, which has no duration and no sliding_distance";

/// Sliding at constant speed if the velocity of the scene is positive, else indentation for its duration. Rejects a track
/// beside a duration or distance.
fn motion(scene: &Scene, body: &Body) -> Result<Motion, SceneError> {
    let wrong = |error: IndenterError| SceneError::at("load", error.to_string());
    let control = scene.load.control(body.period_area())?;
    let velocity = scene.load.checked_velocity()?;
    if velocity > 0.0 {
        let load = SlidingLoad::with(control, velocity).map_err(wrong)?;
        let distance = scene.solve.distance(velocity)?;
        let load = match (distance, scene.load.checked_track()?) {
            (Some(_), Some(_)) => return Err(SceneError::at("load.track", ENDLESS)),
            (Some(distance), None) => load.after(distance),
            (None, Some(track)) => load.on_track(track),
            (None, None) => Ok(load),
        };
        return load.map(Motion::Sliding).map_err(wrong);
    }
    SceneError::none_given(&[("load.track", scene.load.track)], NO_TRACK)?;
    let load = PressingLoad::new(control, scene.solve.indentation_time()?);
    load.map(Motion::Pressing).map_err(wrong)
}
