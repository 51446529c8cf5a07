//! Scenes by lot: bodies, materials, loads and units over decades, as a person would type them.

use std::path::Path;

use crate::random::Random;
use anyhow::{Result, bail};
use indenters::Axisymmetric;

use crate::run::{Body, Question};
use crate::scene_file::{Indenter, MaterialTable, SceneFile, scene_file};

/// A scene; its parts are inline tables of a scene file.
#[derive(Debug)]
pub(super) struct Scene {
    pub(super) number: usize,
    pub(super) indenter: String,
    pub(super) material: String,
    pub(super) load: String,
    /// The same, read.
    pub(super) file: SceneFile,
}

/// Units of length \[m], stress \[Pa] and time \[s], in which all numbers of a scene are moderate.
#[derive(Debug, Clone, Copy)]
struct Units {
    length: f64,
    stress: f64,
    time: f64,
}

/// What is done with the body.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Motion {
    Pressed,
    /// Cone or paraboloid on a dashpot, over a distance from first touch, which has a closed form.
    OnTheWay,
    Stationary,
}

/// Depth over the length of a contact within a flat end.
const FLAT: f64 = 0.1;
/// Part of the stationary scenes that are held at a depth instead of under a force.
const AT_DEPTH: f64 = 0.1;

const MOTIONS: [Motion; 6] = [
    Motion::Pressed,
    Motion::OnTheWay,
    Motion::Stationary,
    Motion::Stationary,
    Motion::Stationary,
    Motion::Stationary,
];

/// The scene with this number, from the next numbers of the generator.
pub(super) fn scene(number: usize, random: &mut Random) -> Result<Scene> {
    let units = Units {
        length: decades(random, 4.0),
        stress: decades(random, 6.0),
        time: decades(random, 4.0),
    };
    let motion = choice(random, &MOTIONS);
    let indenter = match motion {
        Motion::OnTheWay => choice(random, &KNOWN_WAYS)(random, units),
        _ => choice(random, &BODIES)(random, units),
    };
    let slides_on_edge = motion == Motion::Stationary && WITH_EDGE.contains(&indenter.0);
    let material = match motion {
        Motion::OnTheWay => viscous(random, units),
        _ if slides_on_edge => choice(random, &WITHOUT_DASHPOT)(random, units),
        _ => choice(random, &MATERIALS)(random, units),
    };
    let compressible = between(random, [-0.9, 0.5]);
    let ratio = choice(random, &[0.5, compressible]);
    let (kind, keys) = material;
    let material = inline(&(kind, format!("{keys}, poisson_ratio = {ratio:?}")));
    let indenter = inline(&indenter);
    let parts = format!("indenter = {indenter}\nmaterial = {material}\n");
    let load = load(random, (motion, units), &parts)?;
    Ok(Scene {
        number,
        file: scene_file(format!("{parts}{load}\n").parse()?)?,
        indenter,
        material,
        load,
    })
}

/// A force or depth under which the contact is about as long as is drawn.
fn load(random: &mut Random, (motion, units): (Motion, Units), parts: &str) -> Result<String> {
    let contact = 0.5 * decades(random, 0.5) * units.length;
    let time = decades(random, 2.0) * units.time;
    let way = 3.0 * decades(random, 0.5) * contact;
    let at_depth = motion == Motion::Stationary && random.uniform() < AT_DEPTH;
    let (velocity, solve) = match motion {
        Motion::Pressed => (0.0, format!("\nsolve = {{ duration = {time:?} }}")),
        Motion::OnTheWay => (
            contact / time,
            format!("\nsolve = {{ sliding_distance = {way:?} }}"),
        ),
        Motion::Stationary => (contact / time, String::new()),
    };
    let with = |control: &str, value: f64| {
        format!("load = {{ {control} = {value:?}, velocity = {velocity:?} }}{solve}")
    };
    let [force, depth] = force_and_depth(parts, &with("normal_force", 1.0), [contact, time])?;
    Ok(if at_depth {
        with("indentation_depth", depth)
    } else {
        with("normal_force", force)
    })
}

/// D = h(a) = 2 (1 − ν) F J(t)/(4 a); at least a tenth of the contact where the end is flat.
fn force_and_depth(parts: &str, load: &str, [contact, time]: [f64; 2]) -> Result<[f64; 2]> {
    let file = scene_file(format!("{parts}{load}").parse()?)?;
    let question = Question::new(&file, Path::new(""), crate::run::no_files)?;
    let Body::Revolution(body) = &question.body else {
        bail!("only bodies of revolution are drawn");
    };
    let depth = match body.profile_height(contact) {
        height if height > 0.0 => height,
        _ => FLAT * contact,
    };
    let material = &*question.material;
    let compliance = material.half_space_factor() * material.creep_compliance(time)?;
    Ok([4.0 * contact * depth / compliance, depth])
}

/// The name of a table, and its keys.
type Table = (&'static str, String);
type Draw = fn(&mut Random, Units) -> Table;

/// Bodies whose way into the stationary state is known.
const KNOWN_WAYS: [Draw; 2] = [cone, paraboloid];

fn inline((name, keys): &Table) -> String {
    format!("{{ {name} = {{ {keys} }} }}")
}

const BODIES: [Draw; 11] = [
    power,
    power,
    cusp,
    cone,
    paraboloid,
    sphere,
    superposition,
    flat_cone,
    round_tipped_cone,
    hyperboloid,
    truncated_paraboloid,
];

/// Bodies with an edge, at which the friction of a dashpot is infinite.
const WITH_EDGE: [&str; 2] = ["flat-cone", "truncated-paraboloid"];

fn power(random: &mut Random, units: Units) -> Table {
    ("power", term(between(random, [1.0, 5.0]), units))
}

/// The slope is infinite at the lowest point.
fn cusp(random: &mut Random, units: Units) -> Table {
    ("power", term(between(random, [0.6, 1.0]), units))
}

fn term(p: f64, units: Units) -> String {
    let coefficient = units.length.powf(1.0 - p);
    format!("coefficient = {coefficient:?}, exponent = {p:?}")
}

fn cone(random: &mut Random, _: Units) -> Table {
    ("cone", format!("slope = {:?}", decades(random, 2.0)))
}

fn paraboloid(random: &mut Random, units: Units) -> Table {
    let curvature = decades(random, 1.0) / units.length;
    ("paraboloid", format!("curvature = {curvature:?}"))
}

/// The radius is at least twice that of the largest contact.
fn sphere(random: &mut Random, units: Units) -> Table {
    let radius = 4.0 * 10_f64.powf(random.uniform()) * units.length;
    ("sphere", format!("radius = {radius:?}"))
}

fn superposition(random: &mut Random, units: Units) -> Table {
    let exponents = [[1.0, 2.0], [2.0, 4.0]].map(|range| between(random, range));
    let [low, high] = exponents.map(|p| term(p, units));
    (
        "superposition",
        format!("terms = [{{ {low} }}, {{ {high} }}]"),
    )
}

fn flat_cone(random: &mut Random, units: Units) -> Table {
    ("flat-cone", tip(random, units))
}

fn round_tipped_cone(random: &mut Random, units: Units) -> Table {
    ("round-tipped-cone", tip(random, units))
}

fn hyperboloid(random: &mut Random, units: Units) -> Table {
    ("hyperboloid", tip(random, units))
}

fn tip(random: &mut Random, units: Units) -> String {
    let radius = 0.3 * decades(random, 0.5) * units.length;
    let slope = 0.5 * decades(random, 0.5);
    format!("radius = {radius:?}, slope = {slope:?}")
}

fn truncated_paraboloid(random: &mut Random, units: Units) -> Table {
    let radius = 0.3 * decades(random, 0.5) * units.length;
    let curvature = decades(random, 0.5) / units.length;
    (
        "truncated-paraboloid",
        format!("radius = {radius:?}, curvature = {curvature:?}"),
    )
}

/// The dashpot more often: every method answers there.
const MATERIALS: [Draw; 8] = [
    viscous,
    viscous,
    viscous,
    elastic,
    kelvin_voigt,
    maxwell,
    standard_solid,
    prony,
];

const WITHOUT_DASHPOT: [Draw; 4] = [elastic, maxwell, standard_solid, prony];

fn viscous(_: &mut Random, units: Units) -> Table {
    let viscosity = units.stress * units.time;
    ("viscous", format!("viscosity = {viscosity:?}"))
}

fn elastic(_: &mut Random, units: Units) -> Table {
    ("elastic", format!("shear_modulus = {:?}", units.stress))
}

fn kelvin_voigt(random: &mut Random, units: Units) -> Table {
    ("kelvin-voigt", spring_and_dashpot(random, units))
}

fn maxwell(random: &mut Random, units: Units) -> Table {
    ("maxwell", spring_and_dashpot(random, units))
}

fn spring_and_dashpot(random: &mut Random, units: Units) -> String {
    let modulus = units.stress;
    let viscosity = modulus * units.time * decades(random, 1.0);
    format!("shear_modulus = {modulus:?}, viscosity = {viscosity:?}")
}

fn standard_solid(random: &mut Random, units: Units) -> Table {
    let modulus = units.stress;
    let glassy = modulus * decades(random, 2.0);
    let viscosity = glassy * units.time * decades(random, 1.0);
    let keys = format!(
        "equilibrium_modulus = {modulus:?}, maxwell_modulus = {glassy:?}, viscosity = {viscosity:?}"
    );
    ("standard-solid", keys)
}

fn prony(random: &mut Random, units: Units) -> Table {
    let count = choice(random, &[1, 2, 3, 4]);
    let branch = |_| {
        let modulus = units.stress * decades(random, 2.0);
        let time = units.time * decades(random, 2.0);
        format!("{{ modulus = {modulus:?}, relaxation_time = {time:?} }}")
    };
    let branches: Vec<String> = (0..count).map(branch).collect();
    let (modulus, branches) = (units.stress, branches.join(", "));
    let keys = format!("equilibrium_modulus = {modulus:?}, branches = [{branches}]");
    ("prony", keys)
}

/// 10^x with x between −n and n.
pub(super) fn decades(random: &mut Random, n: f64) -> f64 {
    10_f64.powf(between(random, [-n, n]))
}

pub(super) fn between(random: &mut Random, [low, high]: [f64; 2]) -> f64 {
    low + (high - low) * random.uniform()
}

/// One of the items, each as likely as any other.
pub(super) fn choice<T: Copy, const N: usize>(random: &mut Random, items: &[T; N]) -> T {
    let mark = random.uniform() * N as f64;
    let index = (1..N).take_while(|&index| index as f64 <= mark).count();
    items[index]
}

impl Scene {
    /// Whether the equivalent line is infinitely steep somewhere.
    pub(super) fn is_sharp(&self) -> bool {
        let has_cusp =
            matches!(&self.file.indenter, Indenter::Power(power) if power.exponent < 1.0);
        has_cusp || self.has_edge()
    }

    /// Whether the slope jumps upwards.
    pub(super) fn has_edge(&self) -> bool {
        let key = self.file.indenter.key();
        WITH_EDGE.iter().any(|name| key.ends_with(name))
    }

    /// Whether the half space has no friction, whatever slides over it.
    pub(super) fn is_elastic(&self) -> bool {
        matches!(&self.file.material, MaterialTable::Elastic(_))
    }

    pub(super) fn is_viscous(&self) -> bool {
        matches!(&self.file.material, MaterialTable::Viscous(_))
    }

    /// Whether nothing slides.
    pub(super) fn presses(&self) -> bool {
        self.file.load.velocity <= 0.0
    }
}
