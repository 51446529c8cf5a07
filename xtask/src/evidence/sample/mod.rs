//! Random scenes over all that a scene can be: every kind of body and material is drawn from the types of the scene file, so
//! that the compiler refuses one that is forgotten.

mod parts;

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use clap::Args;
use strum::IntoEnumIterator as _;
use viscofriction::npy::to_npy;
use viscofriction::scene::{
    IndenterKind, Layer, Load, LoadPoint, MaterialKind, MaterialTable, Method, Model, Scene, Solve,
};
use viscofriction::solve::{Body, Problem, body, half_space, plan};
use viscofriction::{Files, WrongInput};

use crate::output::write_atomically;
use crate::random::Random;

/// Which scenes.
#[derive(Debug, Default, Args)]
pub(super) struct Options {
    /// Number of scenes, from 1 to 100000 [default: 5000 of agreement, 300 of calibration, fewer of a quick run].
    #[arg(long, value_name = "N")]
    scenes: Option<usize>,
    /// Which scenes; the same seed gives the same ones [default: 2014].
    #[arg(long)]
    seed: Option<u64>,
}

const SEED: u64 = 2014;
const MOST_SCENES: usize = 100_000;

impl Options {
    pub(super) fn seed(&self) -> u64 {
        self.seed.unwrap_or(SEED)
    }

    /// How many scenes, if that is a number that can be.
    pub(super) fn count(&self, usual: usize) -> Result<usize> {
        let count = self.scenes.unwrap_or(usual);
        let wrong = format!("--scenes {count} is not from 1 to {MOST_SCENES}");
        ensure!((1..=MOST_SCENES).contains(&count), WrongInput(wrong));
        Ok(count)
    }
}

/// A scene, and what the files hold that it names.
#[derive(Debug, Clone)]
pub(super) struct Case {
    pub(super) scene: Scene,
    /// Lengths of a profile or a height map.
    pub(super) lengths: Option<Lengths>,
    /// The material of a file.
    pub(super) material: Option<MaterialTable>,
    /// About half the length of the contact, \[m].
    pub(super) contact: f64,
}

/// A file of lengths \[m], row by row.
#[derive(Debug, Clone)]
pub(super) struct Lengths {
    file: &'static str,
    pub(super) columns: usize,
    pub(super) values: Vec<f64>,
}

/// Relative errors that are asked for.
const ERRORS: [f64; 4] = [0.1, 0.05, 0.02, 0.01];
/// Files that scenes name.
const HEIGHTS: [&str; 2] = ["heights.npy", "heights.csv"];
const PROFILE: &str = "profile.csv";
const MATERIAL: &str = "material.toml";

/// Reads a file of a case.
pub(super) fn read(path: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    std::fs::read(path).map_err(|error| WrongInput(format!("{}: {error}", path.display())))
}

impl Case {
    /// Writes the scene, as `viscofriction run` takes it, and its files into a folder.
    pub(super) fn write(&self, folder: &Path, name: &str) -> Result<()> {
        let text = toml::to_string(&self.scene).context("a scene as text")?;
        write_atomically(&folder.join(name), text.as_bytes())?;
        self.write_files(folder)
    }

    fn write_files(&self, folder: &Path) -> Result<()> {
        if let Some(lengths) = &self.lengths {
            write_atomically(&folder.join(lengths.file), &lengths.contents())?;
        }
        if let Some(material) = &self.material {
            let text = toml::to_string(&BTreeMap::from([("material", material)]))?;
            write_atomically(&folder.join(MATERIAL), text.as_bytes())?;
        }
        Ok(())
    }

    /// The problem that the scene states, or what is wrong with it.
    pub(super) fn problem(&self, folder: &Path) -> Result<Problem> {
        self.write_files(folder)?;
        Ok(Problem::new(&self.scene, folder, read)?)
    }
}

impl Lengths {
    fn contents(&self) -> Vec<u8> {
        let rows = self.values.chunks(self.columns);
        if self.file == HEIGHTS[0] {
            return to_npy(&self.values, &[rows.len(), self.columns]);
        }
        let header = (self.file == PROFILE).then(|| "radius_m,height_m".to_owned());
        let line = |row: &[f64]| {
            let cells: Vec<String> = row.iter().map(|value| format!("{value:?}")).collect();
            cells.join(",")
        };
        let lines: Vec<String> = header.into_iter().chain(rows.map(line)).collect();
        lines.join("\n").into()
    }
}

/// What scenes are drawn from.
#[derive(Debug, Clone)]
pub(super) struct Range {
    pub(super) bodies: Vec<IndenterKind>,
    pub(super) materials: Vec<MaterialKind>,
    pub(super) motions: &'static [Motion],
    /// Half the decades over which the units of length and time are spread; stresses over twice as many.
    pub(super) decades: &'static [f64],
    /// Half the decades over which the time of contact is spread around that of the material.
    pub(super) speeds: f64,
    /// Part of the scenes that are on a layer.
    pub(super) layers: f64,
    /// Part of them that are held at a depth.
    pub(super) depths: f64,
    /// Half the decades over which the distances from first touch are spread around three contacts.
    pub(super) distances: f64,
    /// Memory of one solution, which bounds the size of a scene.
    pub(super) memory: &'static str,
}

/// What is done with a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Motion {
    Stationary,
    /// From first touch.
    SlidingForTime,
    SlidingOverDistance,
    Pressed,
    History,
}

/// A scene that is drawn.
struct Sample<'a> {
    random: &'a mut Random,
    /// Units in which the numbers of the scene are moderate, \[m], \[Pa], \[s].
    length: f64,
    stress: f64,
    time: f64,
    /// Half the length of the contact, and the time in which the body slides over it or is pressed.
    contact: f64,
    contact_time: f64,
    lengths: Option<Lengths>,
    material: Option<MaterialTable>,
}

/// The next scene of the generator; its files are tried in `folder`.
pub(super) fn sample(random: &mut Random, range: &Range, folder: &Path) -> Result<Case> {
    let decades = random.choice(range.decades);
    let [length, stress, time] = [1.0, 2.0, 1.0].map(|more| random.decades(decades * more));
    let contact = 0.3 * random.decades(0.3) * length;
    let contact_time = random.decades(range.speeds) * time;
    let (kind, material) = (
        random.choice(&range.bodies),
        random.choice(&range.materials),
    );
    let mut sample = Sample {
        random,
        length,
        stress,
        time,
        contact,
        contact_time,
        lengths: None,
        material: None,
    };
    let indenter = sample.body(kind);
    let material = sample.half_space(material);
    let is_thin = sample.random.uniform() < range.layers;
    let thickness = contact * 10_f64.powf(sample.random.between([-1.3, 2.0]));
    let mut case = Case {
        scene: Scene {
            indenter,
            material,
            layer: is_thin.then_some(Layer { thickness }),
            load: EMPTY,
            solve: Solve::default(),
        },
        lengths: sample.lengths.take(),
        material: sample.material.take(),
        contact,
    };
    case.write_files(folder)?;
    for _ in 0..TRIALS {
        (case.scene.load, case.scene.solve) = (EMPTY, Solve::default());
        sample.motion(&mut case.scene, range, folder)?;
        let problem = case.problem(folder);
        if problem.is_ok_and(|problem| plan(&problem).is_ok()) {
            break;
        }
    }
    Ok(case)
}

/// Motions that are drawn for a body until one has a method, or the last one is refused.
const TRIALS: usize = 3;
const EMPTY: Load = Load {
    normal_force: None,
    indentation_depth: None,
    mean_pressure: None,
    velocity: None,
    history: None,
    history_file: None,
};

impl Sample<'_> {
    /// Load, motion, model and what is asked.
    fn motion(&mut self, scene: &mut Scene, range: &Range, folder: &Path) -> Result<()> {
        let files = Files::of(scene, folder, read)?;
        let body = body(&scene.indenter, &files)?.body;
        let [force, depth] = self.load(scene, &body, &files)?;
        let is_round = matches!(body, Body::Revolution(_)) && scene.layer.is_none();
        if is_round && self.random.uniform() < 0.25 {
            scene.solve.model = Some(Model::Line);
        }
        scene.solve.relative_error = Some(self.random.choice(&ERRORS));
        scene.solve.max_memory = Some(range.memory.to_owned());
        let at_depth = self.random.uniform() < range.depths;
        let motion = self.random.choice(range.motions);
        if let Body::Periodic(surface) = &body {
            let area: f64 = surface.period().iter().product();
            scene.load.mean_pressure = Some(force / area);
        } else if motion == Motion::History {
            scene.load.history =
                Some(self.history(if at_depth { None } else { Some(force) }, depth));
            return Ok(());
        } else if at_depth {
            scene.load.indentation_depth = Some(depth);
        } else {
            scene.load.normal_force = Some(force);
        }
        let velocity = 2.0 * self.contact / self.contact_time;
        let lengths = 3.0 * self.random.decades(range.distances);
        let slides = !matches!(motion, Motion::Pressed | Motion::History);
        scene.load.velocity = Some(if slides { velocity } else { 0.0 });
        match motion {
            Motion::Stationary => {}
            Motion::SlidingForTime => scene.solve.duration = Some(lengths * self.contact_time),
            Motion::SlidingOverDistance => {
                scene.solve.sliding_distance = Some(lengths * self.contact);
            }
            Motion::Pressed | Motion::History => scene.solve.duration = Some(self.contact_time),
        }
        Ok(())
    }

    /// Force \[N] and depth \[m] of a contact of about the length that was drawn: D = h(a) = 2 (1 − ν) F J(t)/(4 a).
    fn load(&mut self, scene: &Scene, body: &Body, files: &Files<'_>) -> Result<[f64; 2]> {
        let material = half_space(&scene.material, files)?.material;
        let compliance =
            material.half_space_factor() * material.creep_compliance(self.contact_time)?;
        let depth = match body {
            Body::Revolution(body) => match body.profile_height(self.contact) {
                height if height > 0.0 => height,
                _ => 0.02 * self.contact,
            },
            Body::Periodic(surface) => {
                let area: f64 = surface.period().iter().product();
                let pressure = surface.rms_slope() * 10_f64.powf(self.random.between([-2.0, 0.5]));
                return Ok([pressure * area / compliance, 0.0]);
            }
            Body::Cylinder(cylinder) => {
                // F' J(t) 2 (1 − ν) = π a²/R.
                let force = self.contact * self.contact / cylinder.radius() / compliance;
                return Ok([force, 0.01 * self.contact]);
            }
            Body::HeightMap(_) => 0.02 * self.contact,
        };
        Ok([4.0 * self.contact * depth / compliance, depth])
    }

    /// Up to six points that rise and fall, with dwells and jumps, of a force or, without one, of a depth.
    fn history(&mut self, force: Option<f64>, depth: f64) -> Vec<LoadPoint> {
        let count = self.random.choice(&[2, 3, 4, 6]);
        let (mut time, mut level) = (0.0, 0.0);
        let mut points = Vec::new();
        for _ in 0..count {
            points.push(LoadPoint {
                time,
                normal_force: force.map(|force| force * level),
                indentation_depth: force.is_none().then_some(depth * level),
            });
            let step = self.contact_time * self.random.decades(1.0);
            time += self.random.choice(&[step, step, step, step, 0.0]);
            let next = self.random.uniform();
            level = self.random.choice(&[next, next, next, level, 0.0]);
        }
        points
    }
}

/// The methods, from the types of the scene file.
pub(super) fn methods() -> impl Iterator<Item = Method> {
    Method::iter()
}
