//! Random scenes: bodies, materials, loads and units over decades, as a person would type them.

use std::f64::consts::PI;

use anyhow::{Result, bail};
use serde::Serialize;
use viscofriction::scene::{self, Indenter};
use viscofriction::solve::{Body, Problem};

use crate::random::Random;

pub(super) struct Scene {
    pub(super) label: Label,
    pub(super) file: scene::Scene,
}

/// Its number and its parts, which are inline tables of a scene file.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Label {
    #[serde(rename = "scene")]
    pub(super) number: usize,
    indenter: String,
    material: String,
    load: String,
}

/// What is done with the body.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Motion {
    Pressed,
    /// Cone or paraboloid on a dashpot, over a distance from first touch, which has a closed form.
    FromFirstTouch,
    Stationary,
}

/// Most scenes are stationary.
const MOTIONS: [Motion; 6] = {
    let mut motions = [Motion::Stationary; 6];
    motions[0] = Motion::Pressed;
    motions[1] = Motion::FromFirstTouch;
    motions
};
/// Kinds of bodies and materials, some more often than others.
const BODIES: &str = "power power cusp cone paraboloid sphere superposition flat-cone round-tipped-cone hyperboloid \
                      truncated-paraboloid";
/// Bodies whose motion from first touch is known.
const KNOWN_FROM_FIRST_TOUCH: &str = "cone paraboloid";
/// Bodies with an edge, at which the friction of a dashpot is infinite.
const WITH_EDGE: [&str; 2] = ["flat-cone", "truncated-paraboloid"];
/// The dashpot more often: every method solves it.
const MATERIALS: &str = "viscous viscous viscous elastic kelvin-voigt maxwell standard-solid prony";
const SOLIDS_OF_HUNTER: &str = "kelvin-voigt standard-solid";
const WITHOUT_DASHPOT: &str = "elastic maxwell standard-solid prony";
/// Depth over the length of a contact within a flat end.
const FLAT: f64 = 0.1;
/// Part of the stationary scenes that are held at a depth instead of under a force.
const AT_DEPTH: f64 = 0.1;

/// The scene with this number, from the next numbers of the generator.
pub(super) fn scene(number: usize, random: &mut Random) -> Result<Scene> {
    let mut sample = Sample::new(random);
    let motion = sample.random.choice(&MOTIONS);
    let body = match motion {
        Motion::FromFirstTouch => sample.random.word(KNOWN_FROM_FIRST_TOUCH),
        _ => sample.random.word(BODIES),
    };
    let indenter = format!("{{ {} }}", sample.body(body));
    let material = match motion {
        Motion::FromFirstTouch => "viscous",
        Motion::Stationary if WITH_EDGE.contains(&body) => sample.random.word(WITHOUT_DASHPOT),
        _ => sample.random.word(MATERIALS),
    };
    let material = sample.half_space(material);
    let load = sample.load(motion, &parts(&indenter, &material))?;
    Scene::new(number, [indenter, material, load])
}

/// A cylinder that slides on a solid with one relaxation time, of which the closed form is known.
pub(super) fn cylinder(number: usize, random: &mut Random) -> Result<Scene> {
    let mut sample = Sample::new(random);
    let indenter = format!("{{ {} }}", sample.body("cylinder"));
    let material = sample.random.word(SOLIDS_OF_HUNTER);
    let material = sample.half_space(material);
    let load = sample.line_load(&parts(&indenter, &material))?;
    Scene::new(number, [indenter, material, load])
}

fn parts(indenter: &str, material: &str) -> String {
    format!("indenter = {indenter}\nmaterial = {material}\n")
}

/// Units of length \[m], stress \[Pa] and time \[s], in which all numbers of a scene are moderate.
struct Sample<'a> {
    random: &'a mut Random,
    length: f64,
    stress: f64,
    time: f64,
}

impl<'a> Sample<'a> {
    fn new(random: &'a mut Random) -> Self {
        Self {
            length: random.decades(4.0),
            stress: random.decades(6.0),
            time: random.decades(4.0),
            random,
        }
    }

    /// A table of a scene file.
    fn body(&mut self, kind: &str) -> String {
        let (length, random) = (self.length, &mut *self.random);
        match kind {
            "power" => format!("power = {{ {} }}", self.term([1.0, 5.0])),
            // The slope is infinite at the lowest point.
            "cusp" => format!("power = {{ {} }}", self.term([0.6, 1.0])),
            "cone" => format!("cone = {{ slope = {:?} }}", random.decades(2.0)),
            "paraboloid" => {
                let curvature = random.decades(1.0) / length;
                format!("paraboloid = {{ curvature = {curvature:?} }}")
            }
            // The radius is at least twice that of the largest contact.
            "sphere" | "cylinder" => {
                let radius = 4.0 * 10_f64.powf(random.uniform()) * length;
                format!("{kind} = {{ radius = {radius:?} }}")
            }
            "superposition" => {
                let exponents = [[1.0, 2.0], [2.0, 4.0]].map(|range| random.between(range));
                let [low, high] = exponents.map(|p| power_term(p, length));
                format!("superposition = {{ terms = [{{ {low} }}, {{ {high} }}] }}")
            }
            // Cones with a tip and worn paraboloids.
            _ => {
                let radius = 0.3 * random.decades(0.5) * length;
                let (key, value) = match kind {
                    "truncated-paraboloid" => ("curvature", random.decades(0.5) / length),
                    _ => ("slope", 0.5 * random.decades(0.5)),
                };
                format!("{kind} = {{ radius = {radius:?}, {key} = {value:?} }}")
            }
        }
    }

    fn term(&mut self, exponents: [f64; 2]) -> String {
        power_term(self.random.between(exponents), self.length)
    }

    /// A table of a scene file, incompressible or not.
    fn half_space(&mut self, kind: &str) -> String {
        let keys = self.material(kind);
        let compressible = self.random.between([-0.9, 0.5]);
        let ratio = self.random.choice(&[0.5, compressible]);
        format!("{{ {kind} = {{ {keys}, poisson_ratio = {ratio:?} }} }}")
    }

    /// The keys of its table.
    fn material(&mut self, kind: &str) -> String {
        let (stress, time, random) = (self.stress, self.time, &mut *self.random);
        match kind {
            "viscous" => format!("viscosity = {:?}", stress * time),
            "elastic" => format!("shear_modulus = {stress:?}"),
            "standard-solid" => {
                let glassy = stress * random.decades(2.0);
                let viscosity = glassy * time * random.decades(1.0);
                format!(
                    "equilibrium_modulus = {stress:?}, maxwell_modulus = {glassy:?}, viscosity = {viscosity:?}"
                )
            }
            "prony" => {
                let count = random.choice(&[1, 2, 3, 4]);
                let branch = |_| {
                    let (modulus, time) =
                        (stress * random.decades(2.0), time * random.decades(2.0));
                    format!("{{ modulus = {modulus:?}, relaxation_time = {time:?} }}")
                };
                let branches: Vec<String> = (0..count).map(branch).collect();
                let branches = branches.join(", ");
                format!("equilibrium_modulus = {stress:?}, branches = [{branches}]")
            }
            // Kelvin–Voigt and Maxwell.
            _ => {
                let viscosity = stress * time * random.decades(1.0);
                format!("shear_modulus = {stress:?}, viscosity = {viscosity:?}")
            }
        }
    }

    /// A force or depth under which the contact is about half as long as the unit of length.
    fn load(&mut self, motion: Motion, parts: &str) -> Result<String> {
        let random = &mut *self.random;
        let contact = 0.5 * random.decades(0.5) * self.length;
        let time = random.decades(2.0) * self.time;
        let distance = 3.0 * random.decades(0.5) * contact;
        let at_depth = motion == Motion::Stationary && random.uniform() < AT_DEPTH;
        let velocity = if motion == Motion::Pressed {
            0.0
        } else {
            contact / time
        };
        let solve = match motion {
            Motion::Pressed => format!("\nsolve = {{ duration = {time:?} }}"),
            Motion::FromFirstTouch => format!("\nsolve = {{ sliding_distance = {distance:?} }}"),
            Motion::Stationary => String::new(),
        };
        let with = |control: &str, value: f64| {
            format!("load = {{ {control} = {value:?}, velocity = {velocity:?} }}{solve}")
        };
        let unit_force = format!("{parts}{}", with("normal_force", 1.0));
        let [force, depth] = force_and_depth(&unit_force, contact, time)?;
        Ok(if at_depth {
            with("indentation_depth", depth)
        } else {
            with("normal_force", force)
        })
    }

    /// A force per length under which the contact is about half as long as the unit of length: F' J(t) 2 (1 − ν) = π a²/R.
    fn line_load(&mut self, parts: &str) -> Result<String> {
        let random = &mut *self.random;
        let contact = 0.5 * random.decades(0.5) * self.length;
        let time = random.decades(2.0) * self.time;
        let velocity = contact / time;
        let with =
            |force: f64| format!("load = {{ normal_force = {force:?}, velocity = {velocity:?} }}");
        let problem = Problem::try_from(&format!("{parts}{}", with(1.0)).parse::<scene::Scene>()?)?;
        let Body::Cylinder(cylinder) = problem.body() else {
            bail!("no cylinder");
        };
        let compliance =
            problem.material().half_space_factor() * problem.material().creep_compliance(time)?;
        Ok(with(
            PI * (0.5 * contact).powi(2) / (cylinder.radius() * compliance),
        ))
    }
}

fn power_term(exponent: f64, length: f64) -> String {
    let coefficient = length.powf(1.0 - exponent);
    format!("coefficient = {coefficient:?}, exponent = {exponent:?}")
}

/// D = h(a) = 2 (1 − ν) F J(t)/(4 a); at least a tenth of the contact where the end is flat.
fn force_and_depth(scene: &str, contact: f64, time: f64) -> Result<[f64; 2]> {
    let problem = Problem::try_from(&scene.parse::<scene::Scene>()?)?;
    let Body::Revolution(body) = problem.body() else {
        bail!("all random bodies are bodies of revolution");
    };
    let depth = match body.profile_height(contact) {
        height if height > 0.0 => height,
        _ => FLAT * contact,
    };
    let material = problem.material();
    let compliance = material.half_space_factor() * material.creep_compliance(time)?;
    Ok([4.0 * contact * depth / compliance, depth])
}

impl Scene {
    fn new(number: usize, [indenter, material, load]: [String; 3]) -> Result<Self> {
        Ok(Self {
            file: format!("{}{load}\n", parts(&indenter, &material)).parse()?,
            label: Label {
                number,
                indenter,
                material,
                load,
            },
        })
    }

    pub(super) fn is_cylinder(&self) -> bool {
        matches!(self.file.indenter, Indenter::Cylinder { .. })
    }

    /// Whether the equivalent line is infinitely steep somewhere.
    pub(super) fn is_sharp(&self) -> bool {
        let has_cusp =
            matches!(self.file.indenter, Indenter::Power { exponent, .. } if exponent < 1.0);
        has_cusp || self.has_edge()
    }

    /// Whether the slope jumps upwards.
    pub(super) fn has_edge(&self) -> bool {
        let key = self.file.indenter.key();
        WITH_EDGE.iter().any(|name| key.ends_with(name))
    }
}
