//! Relations between two answers that must hold whatever the scene is.

use std::path::Path;

use anyhow::Result;
use strum::{EnumIter, IntoStaticStr};
use viscofriction::scene::{
    Branch, Edges, HeightsAre, Indenter, Layer, LoadPoint, MaterialTable, Method, Scene, Term,
};
use viscofriction::solve::Answer;

use super::units::in_other_units;
use crate::evidence::sample::Case;
use crate::random::Random;

/// What is done to a scene, and what its answer must then be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum Relation {
    /// Another method answers the same.
    OtherMethod,
    /// A quarter of the error.
    QuarterOfTheError,
    /// The force at the depth that was found, or the depth under the force.
    OtherControl,
    /// A layer that is a million times as thick as the contact is a half space.
    ThickLayer,
    /// More load, more depth and area.
    MoreLoad,
    /// All lengths, stresses and times multiplied by powers of two.
    OtherUnits,
    /// The same body or material under another name.
    OtherName,
    /// Branches split in two and in another order.
    SplitBranches,
    /// A height map mirrored across the motion.
    Mirrored,
    /// A height map whose file holds the heights of the surface instead of gaps, seen from the other end.
    OtherFile,
    /// One thread and three.
    OtherThreads,
    /// A history that begins later, after a time without load.
    LaterHistory,
    /// A history with more points on the same path.
    SubdividedHistory,
}

/// A scene that was derived from another one, and what its quantities are multiples of.
pub(super) struct Derived {
    pub(super) case: Case,
    /// Powers of two by which lengths, stresses and times were multiplied.
    pub(super) powers: [i32; 3],
    /// The method that is asked; none for that of the scene.
    pub(super) method: Option<Method>,
    /// By how much the truth of the other scene may differ, relative to that of the first.
    pub(super) vague: f64,
}

/// A layer is a half space where it is so many contacts thick.
const THICK: f64 = 1e6;
/// Factor of the load that is larger.
const MORE: f64 = 1.5;
/// Largest power of two of a unit.
const POWERS: f64 = 12.0;

impl Relation {
    /// Whether both answers are the same numbers up to rounding, instead of within their bars.
    ///
    /// Elements lie elsewhere on a mirrored map, and the depth under a falling force is extrapolated from the parts of its
    /// history.
    pub(super) const fn is_exact(self) -> bool {
        matches!(
            self,
            Self::OtherUnits
                | Self::OtherName
                | Self::SplitBranches
                | Self::OtherFile
                | Self::OtherThreads
        )
    }

    /// Whether it is the same scene in other words, of which both forms are answered or none.
    pub(super) const fn is_same(self) -> bool {
        let is_history = matches!(self, Self::LaterHistory | Self::SubdividedHistory);
        self.is_exact() || is_history || matches!(self, Self::Mirrored)
    }

    /// The other scene; none where the relation says nothing.
    pub(super) fn derive(
        self,
        case: &Case,
        answer: &Answer,
        random: &mut Random,
    ) -> Option<Derived> {
        let mut derived = Derived {
            case: case.clone(),
            powers: [0; 3],
            method: None,
            vague: 0.0,
        };
        let scene = &mut derived.case.scene;
        match self {
            // The method is chosen by the caller, who knows what is offered.
            Self::OtherMethod | Self::OtherThreads => {}
            Self::QuarterOfTheError => *scene.solve.relative_error.as_mut()? *= 0.25,
            Self::OtherControl => other_control(scene, answer)?,
            Self::ThickLayer => {
                let lowest_one = scene.layer.is_none() && scene.solve.model.is_none();
                let thickness = THICK * case.contact;
                let layer =
                    (lowest_one && !is_periodic(&scene.indenter)).then_some(Layer { thickness });
                scene.layer = Some(layer?);
            }
            Self::MoreLoad => {
                let load = &mut scene.load;
                let given = [&mut load.normal_force, &mut load.indentation_depth];
                let given = given.into_iter().chain([&mut load.mean_pressure]);
                *given.into_iter().flatten().next()? *= MORE;
            }
            Self::OtherUnits => {
                let powers = [0; 3].map(|_| random.between([-POWERS, POWERS]).round());
                #[expect(clippy::cast_possible_truncation, reason = "whole and small")]
                let powers = powers.map(|power| power as i32);
                derived.powers = powers;
                in_other_units(&mut derived.case, powers);
            }
            Self::OtherName => renamed(scene, case.material.as_ref())?,
            Self::SplitBranches => {
                let MaterialTable::Prony { branches, .. } = &mut scene.material else {
                    return None;
                };
                *branches = split(branches)?;
            }
            Self::Mirrored => other_map(&mut derived.case, false)?,
            Self::OtherFile => other_map(&mut derived.case, true)?,
            Self::LaterHistory => later(
                scene.load.history.as_mut()?,
                case.scene.load.history.as_ref()?,
            )?,
            Self::SubdividedHistory => {
                let points = scene.load.history.as_mut()?;
                *points = subdivided(points);
            }
        }
        Some(derived)
    }
}

/// How much softer the material is for waves as long as a thick layer than for those of the contact that slides over it; 1 at
/// rest.
pub(super) fn softening(case: &Case, folder: &Path) -> Result<f64> {
    let velocity = case.scene.load.velocity.unwrap_or_default();
    if velocity <= 0.0 {
        return Ok(1.0);
    }
    let problem = case.problem(folder)?;
    let compliance = |length: f64| problem.material().creep_compliance(length / velocity);
    match [THICK, 1.0].map(|times| compliance(times * case.contact)) {
        [Ok(long), Ok(short)] => Ok(long / short),
        _ => Ok(f64::INFINITY),
    }
}

/// Whether another unit rounds the numbers of a scene, which may move an element over the edge of the contact.
pub(super) const fn has_powers(scene: &Scene) -> bool {
    use MaterialTable::{FractionalMaxwell, Springpot};
    let material = matches!(scene.material, Springpot { .. } | FractionalMaxwell { .. });
    material
        || matches!(
            scene.indenter,
            Indenter::Power { .. } | Indenter::Superposition { .. }
        )
}

fn is_periodic(indenter: &Indenter) -> bool {
    match indenter {
        Indenter::SelfAffine(_) => true,
        Indenter::HeightMap(map) => map.edges != Edges::Wall,
        _ => false,
    }
}

/// What was found, given; only of states that do not depend on how they were reached.
fn other_control(scene: &mut Scene, answer: &Answer) -> Option<()> {
    let is_elastic = matches!(scene.material, MaterialTable::Elastic { .. });
    let is_stationary = scene
        .solve
        .duration
        .or(scene.solve.sliding_distance)
        .is_none();
    if !(is_elastic || is_stationary) {
        return None;
    }
    let load = &mut scene.load;
    let found = |known: f64| (known > 0.0 && known.is_finite()).then_some(known);
    match (load.normal_force.take(), load.indentation_depth.take()) {
        (Some(_), None) => load.indentation_depth = Some(found(answer.indentation_depth?.value)?),
        (None, Some(_)) => load.normal_force = Some(found(answer.normal_force.value)?),
        _ => return None,
    }
    Some(())
}

/// The map mirrored across the motion, or in another file of the same surface; none of other bodies.
fn other_map(case: &mut Case, is_turned: bool) -> Option<()> {
    let Indenter::HeightMap(map) = &mut case.scene.indenter else {
        return None;
    };
    let lengths = case.lengths.as_mut()?;
    // All heights in the opposite order are the map turned by 180 degrees.
    if is_turned {
        map.direction = 180.0;
        map.heights_are = HeightsAre::Surface;
        lengths
            .values
            .iter_mut()
            .for_each(|height| *height = -*height);
    } else {
        let rows = lengths.values.chunks_mut(lengths.columns);
        rows.for_each(<[f64]>::reverse);
    }
    lengths.values.reverse();
    Some(())
}

/// The body or the material under another name; none where there is no other one.
fn renamed(scene: &mut Scene, of_file: Option<&MaterialTable>) -> Option<()> {
    let body = other_body(&scene.indenter);
    let material = match &scene.material {
        MaterialTable::File { temperature, .. } => Some(at(of_file?, *temperature)?),
        material => other_material(material),
    };
    if body.is_none() && material.is_none() {
        return None;
    }
    scene.indenter = body.unwrap_or_else(|| scene.indenter.clone());
    scene.material = material.unwrap_or_else(|| scene.material.clone());
    Some(())
}

/// What a file of a material holds, at a temperature.
fn at(of_file: &MaterialTable, temperature: Option<f64>) -> Option<MaterialTable> {
    let mut material = of_file.clone();
    let exponent = match (of_file.shift(), temperature) {
        (Some(shift), Some(temperature)) => shift.log10_factor(temperature).ok()?,
        _ => 0.0,
    };
    let factor = 10_f64.powf(exponent);
    if let MaterialTable::Prony {
        branches,
        viscosity,
        valid_frequencies,
        shift,
        ..
    } = &mut material
    {
        branches
            .iter_mut()
            .for_each(|one| one.relaxation_time *= factor);
        *viscosity *= factor;
        let window = valid_frequencies.iter_mut().flatten();
        window.for_each(|frequency| *frequency /= factor);
        *shift = None;
    }
    Some(material)
}

fn other_body(indenter: &Indenter) -> Option<Indenter> {
    let power = |coefficient, exponent| Indenter::Power {
        coefficient,
        exponent,
    };
    match indenter {
        Indenter::Cone { slope } => Some(power(*slope, 1.0)),
        Indenter::Paraboloid { curvature } => Some(power(*curvature, 2.0)),
        Indenter::Power {
            coefficient,
            exponent,
        } => {
            let terms = vec![Term {
                coefficient: *coefficient,
                exponent: *exponent,
            }];
            Some(Indenter::Superposition { terms })
        }
        Indenter::Superposition { terms } => {
            let terms = terms.iter().rev().cloned().collect();
            Some(Indenter::Superposition { terms })
        }
        _ => None,
    }
}

fn other_material(material: &MaterialTable) -> Option<MaterialTable> {
    let branch = |modulus: f64, viscosity: f64| Branch {
        modulus,
        relaxation_time: viscosity / modulus,
    };
    let poisson_ratio = material.poisson_ratio()?;
    let prony = |equilibrium_modulus, viscosity, branches| {
        Some(MaterialTable::Prony {
            equilibrium_modulus,
            viscosity,
            branches,
            poisson_ratio,
            valid_frequencies: None,
            shift: None,
            approximation: None,
        })
    };
    match *material {
        MaterialTable::Viscous { viscosity, .. } => prony(0.0, viscosity, Vec::new()),
        MaterialTable::Elastic { shear_modulus, .. } => prony(shear_modulus, 0.0, Vec::new()),
        MaterialTable::KelvinVoigt {
            shear_modulus,
            viscosity,
            ..
        } => prony(shear_modulus, viscosity, Vec::new()),
        MaterialTable::Maxwell {
            shear_modulus,
            viscosity,
            ..
        } => prony(0.0, 0.0, vec![branch(shear_modulus, viscosity)]),
        MaterialTable::StandardSolid {
            equilibrium_modulus,
            maxwell_modulus,
            viscosity,
            ..
        } => prony(
            equilibrium_modulus,
            0.0,
            vec![branch(maxwell_modulus, viscosity)],
        ),
        _ => None,
    }
}

/// Each branch as a quarter and three quarters, in the opposite order.
fn split(branches: &[Branch]) -> Option<Vec<Branch>> {
    let part = |branch: &Branch, part: f64| Branch {
        modulus: part * branch.modulus,
        relaxation_time: branch.relaxation_time,
    };
    let parts = branches.iter().rev();
    let parts = parts.flat_map(|branch| [part(branch, 0.25), part(branch, 0.75)]);
    (!branches.is_empty()).then(|| parts.collect())
}

/// The history after half of its duration without load; only of one that begins with none.
fn later(points: &mut Vec<LoadPoint>, before: &[LoadPoint]) -> Option<()> {
    let first = before[0];
    let is_free = first.normal_force.or(first.indentation_depth)? <= 0.0;
    let time = 0.5 * before[before.len() - 1].time;
    points.iter_mut().for_each(|point| point.time += time);
    points.insert(0, LoadPoint { time: 0.0, ..first });
    is_free.then_some(())
}

/// With the middles of all straight parts that take time.
fn subdivided(points: &[LoadPoint]) -> Vec<LoadPoint> {
    let middle = |pair: &[LoadPoint]| {
        let [one, other] = [pair[0], pair[1]];
        let mean = |of: fn(&LoadPoint) -> Option<f64>| Some(0.5 * (of(&one)? + of(&other)?));
        let middle = LoadPoint {
            time: 0.5 * (one.time + other.time),
            normal_force: mean(|point| point.normal_force),
            indentation_depth: mean(|point| point.indentation_depth),
        };
        let is_part = other.time > one.time;
        [Some(one), is_part.then_some(middle)].into_iter().flatten()
    };
    let all = points.windows(2).flat_map(middle);
    all.chain(points.last().copied()).collect()
}
