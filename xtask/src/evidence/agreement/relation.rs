//! Relations between the answers of two scenes that must hold whatever the scene is (metamorphic testing).

use std::path::Path;

use anyhow::Result;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use strum::{EnumIter, IntoEnumIterator as _, IntoStaticStr};
use toml::{Table, Value};
use viscofriction::scene::{
    Approximation, Branch, Indenter, Layer, LoadPoint, MaterialTable, Method, Model, MotionPoint,
    Scene,
};
use viscofriction::solve::{Answer, plan};

use super::surfaces::{as_spectrum, other_map, resampled};
use super::units::Powers;
use crate::evidence::request::presses;
use crate::evidence::sample::{Case, filled};
use crate::random::Random;

/// What is done to a scene, and what its answer must then be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum Relation {
    /// Another method answers the same.
    OtherMethod,
    /// A quarter of the error is requested.
    QuarterOfTheError,
    /// A number of elements is given instead of an error.
    GivenElements,
    /// The depth that was found is given instead of the force, or the force instead of the depth.
    OtherControl,
    /// A layer that is [`THICKNESS_OVER_CONTACT`] times as thick as the contact acts as a half space.
    ThickLayer,
    /// Under [`LOAD_FACTOR`] times the load, force, depth and area do not fall.
    MoreLoad,
    /// All lengths, stresses and times multiplied by powers of two.
    OtherUnits,
    /// The body or material is described under the name of an equivalent one.
    OtherName,
    /// Branches split in two and in another order.
    SplitBranches,
    /// Moduli that are off by as much as they are said to be.
    OtherSeries,
    /// A height map mirrored across the motion.
    Mirrored,
    /// A height map whose file holds the heights of the surface instead of gaps, seen from the other end.
    OtherFile,
    /// A height map that repeats itself, with twice as many heights along both edges.
    Resampled,
    /// Derivatives by all numbers of the scene add up to what other units demand; see [`super::derivatives`].
    Derivatives,
    /// Three threads give the bits that one gives.
    OtherThreads,
    /// A track so long that everything is forgotten before the body comes back acts as a straight one.
    LongTrack,
    /// A motion through more points on the same path, and much later.
    SubdividedMotion,
    /// A history that begins later, after a time without load.
    LaterHistory,
    /// A history with more points on the same path.
    SubdividedHistory,
}

/// A scene, the folder of its files, and its answer.
#[derive(Clone, Copy)]
pub(super) struct Answered<'a> {
    pub(super) case: &'a Case,
    pub(super) folder: &'a Path,
    pub(super) answer: &'a Answer,
}

/// A scene that was derived from another one, and what follows for its answer.
pub(super) struct Derived {
    /// The derived scene with its files.
    pub(super) case: Case,
    /// Ratios of the units of the derived scene to those of the first one.
    pub(super) powers: Powers,
    /// The method that is to solve it; `None` for that of the scene or the one that is chosen for it.
    pub(super) method: Option<Method>,
    /// Relative difference between the exact answers of both scenes, at most; 0 where the relation is exact in theory.
    pub(super) truth_difference: f64,
}

/// Ratio of the thickness of a layer that acts as a half space to half the contact length. Chosen, so that [`LAYER_DIFFERENCE`]
/// is small.
const THICKNESS_OVER_CONTACT: f64 = 1e6;
/// Largest relative difference between such a layer and the half space, if long waves find the material no softer than the
/// contact does. Derived: ten times the ratio of half the contact length to the thickness.
const LAYER_DIFFERENCE: f64 = 1e-5;
/// Relative difference between layer and half space above which the relation is not tried. Chosen: a larger tolerance would
/// hide most contradictions.
const MAX_LAYER_DIFFERENCE: f64 = 0.01;
/// Ratio of the larger load to the given one. Chosen, so that its effects are well above the error bars.
const LOAD_FACTOR: f64 = 1.5;
/// Number of elements along a contact for [`Relation::GivenElements`]. Chosen: it is cheap and not a power of two.
const ELEMENTS: usize = 40;
/// Number of elements along the period of a surface that slides or rests, for [`Relation::GivenElements`]. Chosen: a power of two
/// suits the Fourier transform.
const ELEMENTS_OF_PERIOD: usize = 256;
/// Number of elements along the period of a surface that reciprocates or follows points, for [`Relation::GivenElements`]. Chosen
/// smaller, since a cycle takes as many steps as there are elements in a stroke.
const ELEMENTS_OF_MOTION: usize = 64;
/// Relative error that the series of [`other_series`] has and states. Chosen: it is below most requested errors, so that
/// scenes remain solvable, and far above rounding.
const SERIES_ERROR: f64 = 1e-4;
/// Factor by which the times for which [`SERIES_ERROR`] is stated go beyond the shortest and the longest relaxation time. Chosen,
/// so that no scene needs other times.
const SERIES_RANGE_FACTOR: f64 = 1e12;
/// Ratio of the length of a track to half the contact length. Chosen far larger than the ratio of any relaxation time of the
/// drawn materials to the time of a contact.
const TRACK_OVER_CONTACT: f64 = 1e15;
/// Ratio of the date at which the later motion begins to its duration. Chosen: the elapsed time must be subtracted without losing
/// digits.
const START_OVER_DURATION: f64 = 1e6;
/// Largest |n| of the factor 2^n by which a unit is changed: factors up to 4096. Chosen: it is more than from metres to
/// millimetres. Powers of two change no digit of a number, so that answers must agree to rounding.
const MAX_POWER_OF_TWO: f64 = 12.0;

impl Relation {
    /// Whether both answers are the same numbers up to rounding, instead of within their bars.
    ///
    /// Elements lie elsewhere on a mirrored map, and the depth under a falling force is extrapolated from the parts of its
    /// history.
    pub(super) const fn is_exact(self) -> bool {
        use Relation::{OtherFile, OtherName, OtherThreads, OtherUnits, SplitBranches};
        matches!(
            self,
            OtherUnits | OtherName | SplitBranches | OtherFile | OtherThreads
        )
    }

    /// Whether both scenes are the same one in another form, so that both are answered or none.
    pub(super) const fn is_same(self) -> bool {
        use Relation::{LaterHistory, Mirrored, SubdividedHistory};
        let motions = matches!(self, Self::SubdividedMotion);
        self.is_exact() || motions || matches!(self, LaterHistory | SubdividedHistory | Mirrored)
    }

    /// The derived scene; `None` where the relation does not apply. [`Relation::Derivatives`] derives none.
    pub(super) fn derive(self, first: Answered, random: &mut Random) -> Result<Option<Derived>> {
        let mut derived = Derived {
            case: first.case.clone(),
            powers: Powers::default(),
            method: None,
            truth_difference: 0.0,
        };
        let Derived {
            case,
            powers,
            method,
            truth_difference,
        } = &mut derived;
        let changed = match self {
            Self::OtherThreads => Some(()),
            Self::OtherMethod => {
                *method = other_method(first, random);
                method.map(|_| ())
            }
            Self::ThickLayer => {
                let is_changed = thick_layer(case);
                if is_changed.is_some() {
                    *truth_difference = LAYER_DIFFERENCE * softening(first)?;
                }
                is_changed.filter(|()| *truth_difference <= MAX_LAYER_DIFFERENCE)
            }
            Self::OtherUnits => {
                *powers = drawn(random);
                powers.apply(case)?;
                Some(())
            }
            Self::OtherName => renamed(case)?,
            Self::LongTrack => long_track(case),
            Self::Mirrored => other_map(case, false),
            Self::OtherFile => other_map(case, true),
            Self::Resampled => resampled(case),
            _ => self.change(&mut case.scene, first.answer),
        };
        Ok(changed.map(|()| derived))
    }

    /// Changes a scene without its files, as the relation demands; `None` where it does not apply.
    fn change(self, scene: &mut Scene, answer: &Answer) -> Option<()> {
        match self {
            Self::QuarterOfTheError => *scene.solve.relative_error.as_mut()? *= 0.25,
            Self::GivenElements => {
                let moves = scene.load.stroke.is_some() || scene.load.motion.is_some();
                let elements = match scene.indenter.is_periodic() {
                    true if moves => ELEMENTS_OF_MOTION,
                    true => ELEMENTS_OF_PERIOD,
                    false => ELEMENTS,
                };
                scene.solve.relative_error.take()?;
                scene.solve.elements = Some(elements);
            }
            Self::OtherControl => other_control(scene, answer)?,
            Self::OtherSeries => other_series(&mut scene.material)?,
            Self::MoreLoad => {
                let load = &mut scene.load;
                let controls = [
                    &mut load.normal_force,
                    &mut load.indentation_depth,
                    &mut load.mean_pressure,
                ];
                *controls.into_iter().flatten().next()? *= LOAD_FACTOR;
            }
            Self::SplitBranches => {
                let MaterialTable::Prony { branches, .. } = &mut scene.material else {
                    return None;
                };
                *branches = split(branches)?;
            }
            Self::SubdividedMotion => {
                let points = scene.load.motion.as_mut()?;
                *points = with_middles(points, middle_of_motion);
                let date = START_OVER_DURATION * points.last()?.time;
                points.iter_mut().for_each(|point| point.time += date);
            }
            Self::LaterHistory => later(scene.load.history.as_mut()?)?,
            Self::SubdividedHistory => {
                let points = scene.load.history.as_mut()?;
                *points = with_middles(points, middle_of_history);
            }
            _ => return None,
        }
        Some(())
    }
}

/// A random one of the other methods that answer the scene in the same model; `None` where there is none.
fn other_method(first: Answered, random: &mut Random) -> Option<Method> {
    let scene = &first.case.scene;
    // All methods are compared where nothing slides, because both models are the same there.
    let model = scene.solve.model.unwrap_or(Model::HalfSpace);
    let is_of_model = |method: &Method| {
        presses(scene) || method.model().is_none_or(|of_method| of_method == model)
    };
    let is_offered = |method: &Method| {
        let mut case = first.case.clone();
        case.scene.solve.method = Some(*method);
        let problem = case.problem(first.folder);
        let is_other = *method != first.answer.method && is_of_model(method);
        is_other && problem.is_ok_and(|problem| plan(&problem).is_ok())
    };
    let offered: Vec<Method> = Method::iter().filter(is_offered).collect();
    (!offered.is_empty()).then(|| random.choice(&offered))
}

/// True if heat or strain below the surface is computed, which is done on fresh half spaces only.
const fn has_bulk(scene: &Scene) -> bool {
    scene.heat.is_some() || scene.strain.is_some()
}

/// Puts a thick layer on a rigid base in place of the half space; `None` where the surface of the body is periodic, or the
/// scene has a layer or the one-dimensional model.
fn thick_layer(case: &mut Case) -> Option<()> {
    let thickness = THICKNESS_OVER_CONTACT * case.contact;
    let scene = &mut case.scene;
    let is_periodic = scene.indenter.is_periodic();
    let is_half_space = scene.layer.is_none() && !has_bulk(scene) && scene.solve.model.is_none();
    scene.layer = (is_half_space && !is_periodic).then_some(Layer { thickness });
    scene.layer.map(|_| ())
}

/// Closes the path of a body that slides in a stationary state into a long track; `None` for others and of periodic surfaces.
fn long_track(case: &mut Case) -> Option<()> {
    let track = TRACK_OVER_CONTACT * case.contact;
    let has_bulk = has_bulk(&case.scene);
    let Scene {
        indenter,
        load,
        solve,
        ..
    } = &mut case.scene;
    let slides = !has_bulk && load.velocity.is_some_and(|velocity| velocity > 0.0);
    let ends = solve.duration.or(solve.sliding_distance).or(load.track);
    let is_stationary = slides && ends.is_none() && !indenter.is_periodic();
    load.track = is_stationary.then_some(track);
    load.track.map(|_| ())
}

/// Ratio of the creep compliance J(L/v) for the length L of a thick layer to that for half the contact length, at the speed v. It
/// says how much softer the material is for waves as long as the layer. 1 at rest; infinite where a compliance is.
fn softening(Answered { case, folder, .. }: Answered) -> Result<f64> {
    let velocity = case.scene.load.velocity.unwrap_or_default();
    if velocity <= 0.0 {
        return Ok(1.0);
    }
    let problem = case.problem(folder)?;
    let compliance = |length: f64| problem.material().creep_compliance(length / velocity);
    match [THICKNESS_OVER_CONTACT, 1.0].map(|times| compliance(times * case.contact)) {
        [Ok(long), Ok(short)] => Ok(long / short),
        _ => Ok(f64::INFINITY),
    }
}

/// Random powers of two up to [`MAX_POWER_OF_TWO`], positive and negative.
fn drawn(random: &mut Random) -> Powers {
    #[expect(clippy::cast_possible_truncation, reason = "whole and small")]
    let [length, stress, time] = [0; 3].map(|_| {
        random
            .between([-MAX_POWER_OF_TWO, MAX_POWER_OF_TWO])
            .round() as i32
    });
    Powers {
        length,
        stress,
        time,
    }
}

/// Whether the scene has powers of numbers with exponents that are not whole, which round differently in other units. That may
/// move an element over the edge of the contact.
pub(super) const fn has_powers(scene: &Scene) -> bool {
    use MaterialTable::{FractionalMaxwell, Springpot};
    let material = matches!(scene.material, Springpot { .. } | FractionalMaxwell { .. });
    let body = &scene.indenter;
    material
        || matches!(
            body,
            Indenter::Power { .. } | Indenter::Superposition { .. }
        )
}

/// Gives the depth that was found instead of the force, or the force instead of the depth; `None` where the state depends on
/// how it was reached, and where neither or both are given.
fn other_control(scene: &mut Scene, answer: &Answer) -> Option<()> {
    let is_elastic = matches!(scene.material, MaterialTable::Elastic { .. });
    let solve = &scene.solve;
    if !is_elastic && solve.duration.or(solve.sliding_distance).is_some() {
        return None;
    }
    let load = &mut scene.load;
    // A motion is not compared, because it has another force at every point of a depth that is held.
    if load.stroke.is_some() || load.motion.is_some() {
        return None;
    }
    let found = |known: f64| (known > 0.0 && known.is_finite()).then_some(known);
    match (load.normal_force.take(), load.indentation_depth.take()) {
        (Some(_), None) => load.indentation_depth = Some(found(answer.indentation_depth?.value)?),
        (None, Some(_)) => load.normal_force = Some(found(answer.normal_force.value)?),
        _ => return None,
    }
    Some(())
}

/// Contents of `other_names.toml`: how a body or a material of one kind is written as one of another kind.
#[derive(Deserialize)]
struct Names {
    /// For each kind of body a table of the other kind, with the keys of the first for numbers.
    indenter: Table,
    /// For each kind of material a table of the other kind, with the keys of the first for numbers.
    material: Table,
}

/// Replaces body and material by equivalent ones of other kinds; `None` where neither has an equivalent.
fn renamed(case: &mut Case) -> Result<Option<()>> {
    let names: Names = toml::from_str(include_str!("other_names.toml"))?;
    let scene = &mut case.scene;
    let body = match &mut scene.indenter {
        Indenter::SelfAffine(surface) => {
            let (other, table) = as_spectrum(surface)?;
            case.lengths = Some(table);
            Some(other)
        }
        Indenter::Superposition { terms } => {
            terms.reverse();
            Some(scene.indenter.clone())
        }
        body => other_name(body, &names.indenter)?,
    };
    let material = match &scene.material {
        MaterialTable::File { temperature, .. } => {
            let of_file = case.material.as_ref();
            of_file.and_then(|of_file| at(of_file, *temperature))
        }
        material => other_name(material, &names.material)?,
    };
    let is_changed = body.is_some() || material.is_some();
    scene.indenter = body.unwrap_or_else(|| scene.indenter.clone());
    scene.material = material.unwrap_or_else(|| scene.material.clone());
    Ok(is_changed.then_some(()))
}

/// The equivalent of a body or a material `of` by the rules of `names`; `None` where there is no rule for its kind.
fn other_name<T: Serialize + DeserializeOwned>(of: &T, names: &Table) -> Result<Option<T>> {
    let table = Value::try_from(of)?;
    let kinds = table.as_table().into_iter().flatten();
    let mut with_rule = kinds.filter_map(|(kind, numbers)| names.get(kind).zip(numbers.as_table()));
    let Some((name, given)) = with_rule.next() else {
        return Ok(None);
    };
    let mut numbers = given.clone();
    let number = |name: &str| numbers.get(name).and_then(Value::as_float);
    let modulus = number("maxwell_modulus").or(number("shear_modulus"));
    if let Some((modulus, viscosity)) = modulus.zip(number("viscosity")) {
        numbers.insert("relaxation_time".to_owned(), (viscosity / modulus).into());
    }
    let other = filled(name, &numbers);
    Ok(other.map(Value::try_into).transpose()?)
}

/// The Prony series of a file, shifted to a temperature \[°C]: moduli times b_T, relaxation times times a_T, without a shift
/// function. `None` where the shift does not hold.
fn at(of_file: &MaterialTable, temperature: Option<f64>) -> Option<MaterialTable> {
    let mut material = of_file.clone();
    let [exponent, of_moduli] = match (of_file.shift(), temperature) {
        (Some(shift), Some(temperature)) => [
            shift.log10_factor(temperature).ok()?,
            shift.modulus_factor(temperature).ok()?,
        ],
        _ => [0.0, 1.0],
    };
    let factor = 10_f64.powf(exponent);
    if let MaterialTable::Prony {
        equilibrium_modulus,
        branches,
        viscosity,
        valid_frequencies,
        shift,
        ..
    } = &mut material
    {
        for branch in branches.iter_mut() {
            branch.modulus *= of_moduli;
        }
        *equilibrium_modulus *= of_moduli;
        *viscosity *= of_moduli;
        let times = branches.iter_mut().map(|one| &mut one.relaxation_time);
        times.chain([viscosity]).for_each(|time| *time *= factor);
        let window = valid_frequencies.iter_mut().flatten();
        window.for_each(|frequency| *frequency /= factor);
        *shift = None;
    }
    Some(material)
}

/// Makes every other term of a Prony series too large by [`SERIES_ERROR`] and the others too small, and states this as the
/// error of the series. `None` for other materials and of a series that already states one.
fn other_series(material: &mut MaterialTable) -> Option<()> {
    let MaterialTable::Prony {
        equilibrium_modulus,
        viscosity,
        branches,
        approximation: approximation @ None,
        ..
    } = material
    else {
        return None;
    };
    let times = branches.iter().map(|branch| branch.relaxation_time);
    let shortest = times.clone().reduce(f64::min)?;
    let longest = times.fold(shortest, f64::max);
    let moduli = branches.iter_mut().map(|branch| &mut branch.modulus);
    let terms = moduli.chain([equilibrium_modulus, viscosity]);
    for (nth, term) in terms.enumerate() {
        *term *= 1.0 + [SERIES_ERROR, -SERIES_ERROR][nth % 2];
    }
    *approximation = Some(Approximation {
        relative_error: SERIES_ERROR,
        time_range: [
            shortest / SERIES_RANGE_FACTOR,
            longest * SERIES_RANGE_FACTOR,
        ],
    });
    Some(())
}

/// Each branch as two of the same relaxation time, with a quarter and three quarters of its modulus, in the opposite order.
fn split(branches: &[Branch]) -> Option<Vec<Branch>> {
    let part = |branch: &Branch, part: f64| Branch {
        modulus: part * branch.modulus,
        relaxation_time: branch.relaxation_time,
    };
    let reversed = branches.iter().rev();
    let parts = reversed.flat_map(|branch| [part(branch, 0.25), part(branch, 0.75)]);
    (!branches.is_empty()).then(|| parts.collect())
}

/// Puts half of the duration of a history without load before it; `None` where it does not begin without load.
fn later(points: &mut Vec<LoadPoint>) -> Option<()> {
    let first = *points.first()?;
    let is_free = first.normal_force.or(first.indentation_depth)? <= 0.0;
    let time = 0.5 * points.last()?.time;
    points.iter_mut().for_each(|point| point.time += time);
    points.insert(0, LoadPoint { time: 0.0, ..first });
    is_free.then_some(())
}

/// The points with `middle` of each neighbouring pair between them; where that is `None`, nothing is inserted.
fn with_middles<P: Copy>(points: &[P], middle: impl Fn(P, P) -> Option<P>) -> Vec<P> {
    let pairs = points.windows(2);
    let all = pairs.flat_map(|pair| [Some(pair[0]), middle(pair[0], pair[1])]);
    all.flatten().chain(points.last().copied()).collect()
}

/// The point halfway between two points of a motion.
fn middle_of_motion(one: MotionPoint, other: MotionPoint) -> Option<MotionPoint> {
    let time = 0.5 * (one.time + other.time);
    let position = 0.5 * (one.position + other.position);
    Some(MotionPoint {
        time,
        position,
        ..one
    })
}

/// The point halfway between two points of a history; `None` for a jump, which takes no time.
fn middle_of_history(one: LoadPoint, other: LoadPoint) -> Option<LoadPoint> {
    let mean = |of: fn(&LoadPoint) -> Option<f64>| Some(0.5 * (of(&one)? + of(&other)?));
    (other.time > one.time).then(|| LoadPoint {
        time: 0.5 * (one.time + other.time),
        normal_force: mean(|point| point.normal_force),
        indentation_depth: mean(|point| point.indentation_depth),
    })
}
