//! A scene whose numbers are known to be right.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use bem_halfspace::{BemError, Layer};
use indenters::{Control, HistoryPoint, IndenterError, MovingLoad, PressingLoad, SlidingLoad};
use numerics::positive;
use rheology::{Material, RheologyError};

use super::body::{Body, BodyOfScene, body};
use super::error::SolveError;
use super::expansion::Expansion;
use super::half_space::{Simple, half_space, simple};
use super::sensitivity::check_uncertainties;
use crate::files::{Files, ReadFile};
use crate::scene::{Accuracy, Method, Model, Scene, SceneError};
use crate::text::WrongInput;

/// What is asked of the methods.
///
/// It is read only, because its parts belong together: to ask something else, change the scene.
///
/// ```compile_fail
/// fn another_material(problem: &mut viscofriction::Problem) {
///     problem.material = Box::new(viscofriction::rheology::Elastic::new(1e6).unwrap());
/// }
/// ```
#[derive(Debug)]
pub struct Problem {
    body: Body,
    warnings: Vec<String>,
    material: Box<dyn Material>,
    thickness: f64,
    expansion: Option<Expansion>,
    window: Option<[f64; 2]>,
    motion: Motion,
    history: Vec<HistoryPoint>,
    moving: Option<MovingLoad>,
    accuracy: Accuracy,
    method: Option<Method>,
    model: Model,
    threads: Option<usize>,
    max_memory: Option<u64>,
    /// Whether the limit of the memory has refused a grid.
    is_short_of_memory: Arc<AtomicBool>,
    simple: Option<Simple>,
    realisations: Option<Realisations>,
    shortest_wavelength: Option<f64>,
}

/// From what the surfaces of a random body are drawn.
#[derive(Debug, Clone)]
struct Realisations {
    /// At most.
    count: u64,
    /// Relative standard error at which they are enough.
    standard_error: Option<f64>,
    scene: Scene,
    folder: PathBuf,
    read: ReadFile,
}

/// How the body moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// Slides under a force or at a depth, without end or over a distance.
    Sliding(SlidingLoad),
    /// Is pressed with a force or to a depth for a time, without sliding.
    Pressing(PressingLoad),
    /// Follows [`Problem::history`], which ends with this.
    History(Control),
    /// Moves as [`Problem::moving`] says, pressed with this at most.
    Moving(Control),
}

impl Motion {
    /// Force or depth.
    pub const fn control(&self) -> Control {
        match self {
            Self::Sliding(load) => load.control(),
            Self::Pressing(load) => load.control(),
            Self::History(control) | Self::Moving(control) => *control,
        }
    }

    /// Sliding distance since first touch, \[m]; none for the stationary state, and where nothing slides.
    pub fn sliding_distance(&self) -> Option<f64> {
        match self {
            Self::Sliding(load) => load.sliding_distance(),
            Self::Pressing(_) | Self::History(_) | Self::Moving(_) => None,
        }
    }
}

impl Problem {
    /// The problem of a scene; files that it names are in `folder` and read by `read`.
    ///
    /// # Errors
    /// [`SceneError`] for the first number that is out of range.
    pub fn new(scene: &Scene, folder: &Path, read: ReadFile) -> Result<Self, SceneError> {
        let files = Files::of(scene, folder, read)?;
        let body = body(&scene.indenter, &files)?;
        Self::with_body(scene, body, folder, read)
    }

    /// The problem of a scene with another body in the place of its indenter.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn with_body(
        scene: &Scene,
        BodyOfScene { body, warnings }: BodyOfScene,
        folder: &Path,
        read: ReadFile,
    ) -> Result<Self, SceneError> {
        let files = Files::of(scene, folder, read)?;
        let history = scene.load.checked_history(&files)?;
        let history = history.unwrap_or_default();
        let moving = scene.load.checked_motion(body.period_area(), &files)?;
        let motion = match (history.last(), &moving) {
            (Some(last), _) => ended(scene, Motion::History(last.control))?,
            (_, Some(moving)) => ended(scene, Motion::Moving(moving.largest_control()))?,
            _ => motion(scene, &body)?,
        };
        let elastomer = half_space(&scene.material, &files)?;
        let thickness = match scene.layer {
            Some(layer) => positive("layer.thickness", layer.thickness)?,
            None => f64::INFINITY,
        };
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
        let problem = Self {
            body,
            warnings,
            simple: simple(&*elastomer.material).map_err(not_reduced)?,
            material: elastomer.material,
            thickness,
            expansion: elastomer.expansion,
            window: elastomer.window,
            motion,
            history,
            moving,
            accuracy: scene.solve.accuracy()?,
            method: scene.solve.method,
            model: scene.solve.model.or(of_method).unwrap_or(Model::HalfSpace),
            threads: scene.solve.checked_threads()?,
            max_memory: files.memory,
            is_short_of_memory: Arc::default(),
            realisations,
            shortest_wavelength: None,
        };
        problem.check_control()?;
        problem.check_track()?;
        problem.check_layer()?;
        check_uncertainties(scene, folder, read)?;
        Ok(problem)
    }

    /// To another accuracy, which need not be one that scenes may ask for.
    #[must_use]
    pub const fn with_accuracy(mut self, accuracy: Accuracy) -> Self {
        self.accuracy = accuracy;
        self
    }

    /// With a limit of memory, \[bytes], where the scene gives none.
    #[must_use]
    pub fn or_max_memory(mut self, bytes: Option<u64>) -> Self {
        self.max_memory = self.max_memory.or(bytes);
        self
    }

    /// How many random surfaces the answer is the mean of, at most; 1 of any other body.
    pub fn realisations(&self) -> u64 {
        self.realisations.as_ref().map_or(1, |of| of.count)
    }

    /// Relative standard error of the mean at which no more random surfaces are drawn.
    pub fn standard_error(&self) -> Option<f64> {
        self.realisations.as_ref().and_then(|of| of.standard_error)
    }

    /// The seeds of the random surfaces.
    pub(super) fn seeds(&self) -> Vec<u64> {
        let all = self.realisations.iter();
        let seed = |of: &Realisations, index| Some(of.scene.indenter.realisation(index)?.1);
        all.flat_map(|of| (0..of.count).filter_map(move |index| seed(of, index)))
            .collect()
    }

    /// The same problem of one of the random surfaces, counted from 0, with a part of the memory.
    pub(super) fn of_surface(&self, surface: u64, parts: u64) -> Result<Self, SceneError> {
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
        let mut problem = Self::new(&scene, &of.folder, of.read)?;
        problem.accuracy = self.accuracy;
        if parts == 1 {
            problem.is_short_of_memory = Arc::clone(&self.is_short_of_memory);
        }
        if let Some(shortest) = self.shortest_wavelength {
            problem = problem.without_waves_below(shortest)?;
        }
        Ok(problem)
    }

    /// Without the waves of a periodic surface that are shorter than a length \[m].
    ///
    /// # Errors
    /// [`SceneError`] where no wave is left, and for any other body.
    pub fn without_waves_below(mut self, shortest: f64) -> Result<Self, SceneError> {
        let Body::Periodic(surface) = &self.body else {
            let problem = "only a surface that repeats itself is a sum of waves: a self-affine one, one of a spectrum, and a height map \
                           with edges = \"periodic\" or \"mirrored\"";
            return Err(SceneError::at("indenter", problem));
        };
        let kept = surface.without_waves_below(shortest).ok_or_else(|| {
            let problem = format!("it has no wave of {shortest:e} m or longer");
            SceneError::at("indenter", problem)
        })?;
        self.body = Body::Periodic(kept);
        self.shortest_wavelength = Some(shortest);
        Ok(self)
    }

    /// The rigid body.
    pub const fn body(&self) -> &Body {
        &self.body
    }

    /// Sentences about the files of the body, which every answer carries.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The elastomer.
    pub fn material(&self) -> &dyn Material {
        &*self.material
    }

    /// Thickness of the elastomer, \[m]; infinite for a half space.
    pub const fn thickness(&self) -> f64 {
        self.thickness
    }

    /// How well the series stands for another law; none of a material that stands for itself.
    pub const fn expansion(&self) -> Option<Expansion> {
        self.expansion
    }

    /// The frequencies in which the material was measured, \[rad/s]; none of one that is known at all.
    pub const fn window(&self) -> Option<[f64; 2]> {
        self.window
    }

    /// How the body is pressed and moves.
    pub const fn motion(&self) -> Motion {
        self.motion
    }

    /// Points of the history that the body follows; none of any other motion.
    pub fn history(&self) -> &[HistoryPoint] {
        &self.history
    }

    /// How the body moves along the surface, to and fro or through points; none of any other motion.
    pub const fn moving(&self) -> Option<&MovingLoad> {
        self.moving.as_ref()
    }

    /// Length of the track after which the body comes back to the same place, \[m]; none where it never does.
    pub const fn track(&self) -> Option<f64> {
        match self.motion {
            Motion::Sliding(load) => load.track(),
            _ => None,
        }
    }

    /// How long a force or a depth is held, or the parts of a history between two times take and all of it, \[s]; none of
    /// sliding.
    pub(super) fn durations(&self) -> Vec<f64> {
        match self.motion {
            Motion::Sliding(_) => Vec::new(),
            Motion::Pressing(load) => vec![load.duration()],
            Motion::Moving(_) => {
                let stages = self.moving.iter().flat_map(MovingLoad::stages);
                let each = stages.map(indenters::Stage::duration);
                let all = self.moving.iter().map(MovingLoad::duration);
                each.chain(all).collect()
            }
            Motion::History(_) => {
                let between = self.history.windows(2);
                let between = between.map(|pair| pair[1].time - pair[0].time);
                let all = self.history.last().zip(self.history.first());
                let all = all.map(|(last, first)| last.time - first.time);
                between.filter(|time| *time > 0.0).chain(all).collect()
            }
        }
    }

    /// How well the answer is asked for.
    pub const fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// The method that the scene names; without it the cheapest is taken.
    pub const fn method(&self) -> Option<Method> {
        self.method
    }

    /// What the elastomer is taken to be.
    pub const fn model(&self) -> Model {
        self.model
    }

    /// Threads that the scene asks for; the caller provides them.
    pub const fn threads(&self) -> Option<usize> {
        self.threads
    }

    /// Memory that one solution may take, \[bytes]; none for as much as it needs.
    pub const fn max_memory(&self) -> Option<u64> {
        self.max_memory
    }

    /// Whether the limit of the memory has refused a grid, so that the answer may be another one with more.
    pub fn is_short_of_memory(&self) -> bool {
        self.is_short_of_memory.load(Ordering::Relaxed)
    }

    /// Remembers that the limit of the memory has refused a grid.
    pub(super) fn set_short_of_memory(&self) {
        self.is_short_of_memory.store(true, Ordering::Relaxed);
    }

    /// The material, where it is one of those that have closed forms.
    pub(crate) const fn simple(&self) -> Option<&Simple> {
        self.simple.as_ref()
    }

    /// What the body is pressed into.
    pub(crate) fn elastomer(&self) -> Result<Layer<'_, dyn Material>, SolveError> {
        Ok(Layer::new(&*self.material, self.thickness).map_err(BemError::from)?)
    }

    /// Refuses a depth on the half space, which depends on times beyond every range.
    fn check_control(&self) -> Result<(), SceneError> {
        if self.expansion.is_some()
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

    /// Refuses a layer on the one-dimensional model.
    fn check_layer(&self) -> Result<(), SceneError> {
        if self.thickness.is_finite() && self.model == Model::Line {
            let problem = "the scene asks for the one-dimensional model, and it knows no layer; boundary elements do";
            return Err(SceneError::at("layer", problem));
        }
        Ok(())
    }

    /// Refuses a track that no method knows.
    fn check_track(&self) -> Result<(), SceneError> {
        let problem = match self.track() {
            Some(_) if matches!(self.body, Body::Periodic(_)) => OWN_PERIOD,
            Some(_) if self.material.creep().fluidity() > 0.0 => NO_PASS,
            _ => return Ok(()),
        };
        Err(SceneError::at("load.track", problem))
    }
}

/// A scene that names no file.
impl TryFrom<&Scene> for Problem {
    type Error = SceneError;

    fn try_from(scene: &Scene) -> Result<Self, SceneError> {
        Self::new(scene, Path::new(""), no_files)
    }
}

fn no_files(path: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    let problem = "a scene in memory names no file; Problem::new reads one";
    Err(WrongInput(format!("{}: {problem}", path.display())))
}

/// A motion that says itself when it ends.
fn ended(scene: &Scene, motion: Motion) -> Result<Motion, SceneError> {
    let times = [
        ("solve.duration", scene.solve.duration),
        ("solve.sliding_distance", scene.solve.sliding_distance),
    ];
    let problem = match motion {
        Motion::History(_) => "a history ends with its last point; leave this out",
        _ => {
            "a motion ends with its last point, or goes on until its cycles are alike; leave this out"
        }
    };
    SceneError::none_given(&times, problem)?;
    SceneError::none_given(&[("load.track", scene.load.track)], NO_TRACK)?;
    Ok(motion)
}

const NO_TRACK: &str =
    "a track needs a body that slides at load.velocity, and nothing slides here; leave this out";
const OWN_PERIOD: &str = "a periodic surface meets each place again after its own period, which is its track; leave this out";
const NO_PASS: &str = "a material that flows gives way further in every pass, and none is like the one before; give it an equilibrium \
                       modulus, or leave the track out";
const ENDLESS: &str =
    "on a track the stationary state is answered, which has no duration and no sliding_distance";

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
