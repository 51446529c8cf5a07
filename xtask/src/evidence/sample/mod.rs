//! Random scenes over all that a scene can be: every kind of body and material of the scene file, with numbers within the
//! ranges of its keys, or as `recipes.toml` describes it.

mod draw;

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use clap::Args;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use strum::IntoEnumIterator as _;
use toml::{Table, Value};
use viscofriction::WrongInput;
use viscofriction::npy::to_npy;
use viscofriction::scene::{
    IndenterKind, Key, Layer, Load, MaterialKind, MaterialTable, Scene, Solve, kinds,
};
use viscofriction::solve::{Problem, plan};

use crate::output::write_atomically;
use crate::random::Random;
use draw::Sample;

/// Which scenes.
#[derive(Debug, Default, Args)]
pub(super) struct Options {
    /// Number of scenes, from 1 to 100000 [default: 5000 of agreement, 300 of calibration, 200 of derivatives, fewer of a quick
    /// run].
    #[arg(long, value_name = "N")]
    scenes: Option<usize>,
    /// Which scenes; the same seed gives the same ones [default: 2014].
    #[arg(long)]
    seed: Option<u64>,
}

/// Seed of the random scenes unless the command line gives one. Chosen; any number would do.
const SEED: u64 = 2014;
/// Largest number of scenes that may be requested. Chosen, so that a mistyped number is refused.
const MAX_SCENES: usize = 100_000;

impl Options {
    /// The seed asked for, or [`SEED`].
    pub(super) fn seed(&self) -> u64 {
        self.seed.unwrap_or(SEED)
    }

    /// The number of scenes asked for, or `usual`; fails unless it is from 1 to [`MAX_SCENES`].
    pub(super) fn count(&self, usual: usize) -> Result<usize> {
        let count = self.scenes.unwrap_or(usual);
        let wrong = format!("--scenes {count} is not from 1 to {MAX_SCENES}");
        ensure!((1..=MAX_SCENES).contains(&count), WrongInput(wrong));
        Ok(count)
    }
}

/// A scene and the contents of the files that it names.
#[derive(Debug, Clone)]
pub(super) struct Case {
    pub(super) scene: Scene,
    /// The file of its body: a profile, a height map or a spectrum.
    pub(super) lengths: Option<Lengths>,
    /// The material in the file of its material.
    pub(super) material: Option<MaterialTable>,
    /// About half the length of the contact, \[m].
    pub(super) contact: f64,
}

/// A file of lengths \[m], or of wave numbers \[1/m] and densities \[m⁴].
#[derive(Debug, Clone)]
pub(super) struct Lengths {
    /// Name of the file.
    pub(super) file: &'static str,
    /// Numbers in a row.
    pub(super) columns: usize,
    /// All numbers, row by row.
    pub(super) values: Vec<f64>,
}

/// Names of files of height maps to which a scene refers.
const HEIGHTS: [&str; 2] = ["heights.npy", "heights.csv"];
/// Name of the file with a profile to which a scene refers.
const PROFILE: &str = "profile.csv";
/// Name of the file with a spectrum to which a scene refers.
pub(super) const SPECTRUM: &str = "spectrum.csv";
/// Name of the file with a material to which a scene refers.
const MATERIAL: &str = "material.toml";

/// Reads a file of a case, whatever its size; a reader of files as [`Problem::new`] needs one.
fn read(path: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    std::fs::read(path).map_err(|error| WrongInput(format!("{}: {error}", path.display())))
}

impl Case {
    /// Writes the scene, as `viscofriction run` takes it, and its files into a folder.
    pub(super) fn write(&self, folder: &Path, name: &str) -> Result<()> {
        let text = toml::to_string(&self.scene).context("a scene as text")?;
        write_atomically(&folder.join(name), text.as_bytes())?;
        self.write_files(folder)
    }

    /// Writes the files of the case without the scene.
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

    /// True if a method answers the scene.
    fn is_offered(&self, folder: &Path) -> bool {
        self.problem(folder)
            .is_ok_and(|problem| plan(&problem).is_ok())
    }

    /// Changes the scene if a method still answers it then.
    fn keep_if_offered(&mut self, folder: &Path, change: impl FnOnce(&mut Scene)) {
        let before = self.scene.clone();
        change(&mut self.scene);
        if !self.is_offered(folder) {
            self.scene = before;
        }
    }

    /// The problem that the scene states, or what is wrong with it. Writes its files into `folder`, from where they are read.
    pub(super) fn problem(&self, folder: &Path) -> Result<Problem> {
        self.write_files(folder)?;
        Ok(Problem::new(&self.scene, folder, read)?)
    }
}

impl Lengths {
    /// Multiplies all lengths by `factor`; wave numbers and densities accordingly.
    pub(super) fn scale(&mut self, factor: f64) {
        // Choose the powers of the length in the two columns: a spectrum has wave numbers and densities, other files have
        // lengths.
        let powers = if self.file == SPECTRUM {
            [-1, 4]
        } else {
            [1; 2]
        };
        let values = self.values.iter_mut().enumerate();
        values.for_each(|(place, value)| *value *= factor.powi(powers[place % 2]));
    }

    /// Contents of the file: NPY, or CSV with every number in full, under a header unless it is a height map.
    fn contents(&self) -> Vec<u8> {
        let rows = self.values.chunks(self.columns);
        if self.file == HEIGHTS[0] {
            return to_npy(&self.values, &[rows.len(), self.columns]);
        }
        let header = match self.file {
            PROFILE => Some("radius_m,height_m".to_owned()),
            SPECTRUM => Some("wave_number,density".to_owned()),
            _ => None,
        };
        let line = |row: &[f64]| {
            let cells: Vec<String> = row.iter().map(|value| format!("{value:?}")).collect();
            cells.join(",")
        };
        let lines: Vec<String> = header.into_iter().chain(rows.map(line)).collect();
        lines.join("\n").into()
    }
}

/// From what random scenes are drawn; a range of `recipes.toml`.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct Range {
    /// Kinds of bodies and materials that are left out.
    #[serde(default)]
    without: Vec<String>,
    /// Kinds that alone are drawn; all if it is empty.
    #[serde(default)]
    only: Vec<String>,
    /// One of them is drawn; those listed several times more often.
    motions: Vec<Motion>,
    /// One value n is drawn: units of length and time are 10^x in SI with |x| up to n, units of stress with |x| up to 2 n.
    decades: Vec<f64>,
    /// The time of contact is that of the material times 10^x with |x| up to this.
    speeds: f64,
    /// Part of the scenes that are on a layer.
    layers: f64,
    /// Part of them that are held at a depth.
    depths: f64,
    /// Distances from first touch are three times half the contact length, times 10^x with |x| up to this.
    pub(super) distances: f64,
    /// One of these relative errors is requested.
    #[serde(default = "errors")]
    pub(super) errors: Vec<f64>,
    /// Largest memory of one solution, such as `48 MiB`, which bounds the size of its grids.
    pub(super) memory: String,
}

/// Relative errors of a range that names none.
fn errors() -> Vec<f64> {
    vec![0.1, 0.05, 0.02, 0.01]
}

/// What is done with a body; it slides from first touch for a time or over a distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Motion {
    Stationary,
    SlidingForTime,
    SlidingOverDistance,
    Pressed,
    History,
    /// Reciprocating motion.
    Stroke,
    /// Through points.
    Path,
    /// The stationary state of a body that comes back to the same place.
    Track,
}

/// What `recipes.toml` holds.
#[derive(Debug, Clone, Deserialize)]
struct Recipes {
    /// By name.
    range: BTreeMap<String, Range>,
    /// For kinds of bodies that need one: a table in which `$NAME` stands for what was drawn under this name.
    indenter: Table,
    /// For kinds of materials that need one: a table in which `$NAME` stands for what was drawn under this name.
    material: Table,
}

/// A scene and its number among those of a seed, counted from 1.
pub(super) struct NumberedScene {
    pub(super) number: usize,
    pub(super) scene: Scene,
}

/// What random scenes are drawn from, and how.
#[derive(Debug, Clone)]
pub(super) struct Source {
    pub(super) range: Range,
    recipes: Recipes,
}

impl Source {
    /// The range of `recipes.toml` with this name.
    pub(super) fn new(range: &str) -> Result<Self> {
        let recipes: Recipes = toml::from_str(include_str!("recipes.toml"))?;
        let range = recipes.range.get(range).context("a range")?.clone();
        Ok(Self { range, recipes })
    }

    /// The first `count` scenes of a seed, from a range that draws no files.
    pub(super) fn scenes(&self, seed: u64, count: usize) -> Result<Vec<NumberedScene>> {
        let mut random = Random::new(seed);
        let scene = |number| {
            let scene = sample(&mut random, self, Path::new(""))?.scene;
            Ok(NumberedScene { number, scene })
        };
        (1..=count).map(scene).collect()
    }

    /// The kinds among `all` that the range allows.
    fn kinds<K: Into<&'static str>>(&self, all: impl Iterator<Item = K>) -> Vec<&'static str> {
        let Range { only, without, .. } = &self.range;
        let is_in = |list: &[String], kind: &str| list.iter().any(|one| one == kind);
        let is_drawn =
            |kind: &&str| (only.is_empty() || is_in(only, kind)) && !is_in(without, kind);
        all.map(Into::into).filter(is_drawn).collect()
    }
}

/// The body or the material of a kind, as its recipe describes it, filled with what was drawn. A key that the recipe leaves out
/// has what was drawn under its own name.
pub(super) fn made<T: DeserializeOwned>(recipes: &Table, kind: &str, drawn: &Table) -> Result<T> {
    let mut recipe: Table = keys_of(kind)
        .map(|key| (key.name.to_owned(), format!("${}", key.name).into()))
        .collect();
    if let Some(own) = recipes.get(kind).and_then(Value::as_table) {
        recipe.extend(own.clone());
    }
    let value = filled(&recipe.into(), drawn).context("a table is filled")?;
    Ok(Value::from(Table::from_iter([(kind.to_owned(), value)])).try_into()?)
}

/// The keys of a kind of body or material that are required, and those whose default is a number.
pub(super) fn keys_of(kind: &str) -> impl Iterator<Item = Key> {
    let all = ["Indenter", "MaterialTable"]
        .map(kinds)
        .into_iter()
        .flatten();
    let keys = all
        .filter(move |one| one.name == kind)
        .flat_map(|one| one.keys);
    keys.filter(|key| key.is_required || key.words["default"].is_number())
}

/// A value of a recipe in which each text `$NAME` is replaced by what was drawn under NAME. `None` where that was not drawn; in
/// a table, the key is then left out.
pub(super) fn filled(value: &Value, drawn: &Table) -> Option<Value> {
    match value {
        Value::String(text) => match text.strip_prefix('$') {
            Some(name) => drawn.get(name).cloned(),
            None => Some(value.clone()),
        },
        Value::Array(items) => {
            let filled: Option<Vec<_>> = items.iter().map(|item| filled(item, drawn)).collect();
            filled.map(Value::from)
        }
        Value::Table(items) => {
            let filled = |(key, item): (&String, _)| Some((key.clone(), filled(item, drawn)?));
            Some(Value::Table(items.iter().filter_map(filled).collect()))
        }
        other => Some(other.clone()),
    }
}

/// The next scene of the generator. Its files are written to `folder`, where the problem is tried. Up to [`MAX_DRAWN_MOTIONS`]
/// motions are drawn until a method exists, so that few scenes are wasted on combinations that are refused.
pub(super) fn sample(random: &mut Random, source: &Source, folder: &Path) -> Result<Case> {
    let Source { range, recipes } = source;
    // Draw the units and the contact first: all other numbers are moderate in these units.
    let decades = random.choice(&range.decades);
    let [length, stress, time] = [1.0, 2.0, 1.0].map(|more| random.decades(decades * more));
    let contact = 0.3 * random.decades(0.3) * length;
    let contact_time = random.decades(range.speeds) * time;
    let kind = random.choice(&source.kinds(IndenterKind::iter()));
    let material_kind = random.choice(&source.kinds(MaterialKind::iter()));
    let mut sample = Sample {
        random,
        length,
        stress,
        time,
        contact,
        contact_time,
        lengths: None,
        drawn: Table::new(),
    };
    sample.draw_body(kind)?;
    sample.draw_numbers(kind, &recipes.indenter)?;
    let indenter = made(&recipes.indenter, kind, &sample.drawn)?;
    sample.draw_material(material_kind)?;
    sample.draw_numbers(material_kind, &recipes.material)?;
    let material = made(&recipes.material, material_kind, &sample.drawn)?;
    // The file of a material holds a series with the numbers that were drawn for it.
    let is_of_file = material_kind == "file";
    let of_file = is_of_file.then(|| made(&recipes.material, "prony", &sample.drawn));
    let is_thin = sample.random.uniform() < range.layers;
    let thickness = contact * 10_f64.powf(sample.random.between([-1.3, 2.0]));
    let mut case = Case {
        scene: Scene {
            layer: is_thin.then_some(Layer { thickness }),
            ..Scene::new(indenter, material, Load::default())
        },
        lengths: sample.lengths.take(),
        material: of_file.transpose()?,
        contact,
    };
    case.write_files(folder)?;
    for _ in 0..MAX_DRAWN_MOTIONS {
        (case.scene.load, case.scene.solve) = (Load::default(), Solve::default());
        sample.motion(&mut case.scene, range, folder)?;
        if case.is_offered(folder) {
            break;
        }
    }
    // Draw shear, heat and strain dependence last and from a copy of the generator, so that all other numbers of this scene and of the
    // next ones are those that they have without. Scenes in which nothing slides stay without.
    let mut copied = sample.random.clone();
    sample.random = &mut copied;
    let interface = sample.interface();
    if sample.random.uniform() < SHEAR_SHARE {
        case.keep_if_offered(folder, |scene| scene.interface = Some(interface));
    }
    let mut heat = sample.heat();
    if sample.random.uniform() < HEAT_SHARE {
        if !case.scene.indenter.is_periodic() {
            heat.duration = None;
        }
        case.keep_if_offered(folder, |scene| scene.heat = Some(heat));
    }
    let strain = sample.strain();
    if sample.random.uniform() < STRAIN_SHARE {
        case.keep_if_offered(folder, |scene| scene.strain = Some(strain));
    }
    Ok(case)
}

/// Part of the scenes that have a shear strength, if something slides. Chosen.
const SHEAR_SHARE: f64 = 0.4;

/// Part of the scenes that have heat, if it is computed for them. Chosen: many are on layers, compressible or in the one-dimensional model,
/// which have none.
const HEAT_SHARE: f64 = 0.7;

/// Part of the scenes that have strain dependence, if it is computed for them. Chosen: such a scene is solved ten times.
const STRAIN_SHARE: f64 = 0.3;

/// Largest number of motions that are drawn for a body and a material until some method takes one. Chosen; the last one stays
/// even if it is refused, since refusals have to be right too.
const MAX_DRAWN_MOTIONS: usize = 3;
