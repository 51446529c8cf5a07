//! One scene: whether its answer makes sense, and what the relations say of it.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Instant;

use anyhow::Result;
use serde::{Deserialize, Serialize};
use strum::IntoEnumIterator as _;
use viscofriction::Estimate;
use viscofriction::scene::{Method, Model};
use viscofriction::solve::{Answer, SolveError, plan};

use super::patience::Patience;
use super::relation::{self, Derived, Relation};
use super::units::factor;
use crate::evidence::request::presses;
use crate::evidence::sample::{Case, Range, methods, sample};
use crate::random::Random;

/// What one relation says of one scene.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) seed: u64,
    pub(super) scene: usize,
    indenter: String,
    material: String,
    /// What moves, and what is held constant.
    pub(super) motion: String,
    /// `answer` for what an answer must be in itself.
    pub(super) relation: String,
    pub(super) method: String,
    other_method: String,
    pub(super) verdict: Verdict,
    /// The quantity that differs most, relative to what it may.
    pub(super) quantity: String,
    value: Option<f64>,
    other_value: Option<f64>,
    allowed: Option<f64>,
    /// Deviation over what is allowed.
    pub(super) part: Option<f64>,
    /// What was computed for it \[s], with one thread.
    seconds: f64,
    /// Why there is no answer, or what is wrong with it.
    pub(super) message: String,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Verdict {
    #[default]
    Holds,
    /// Both answer, and not the same.
    Differs,
    /// No answer of the scene, or of the other one where it may be refused.
    Refused,
    /// It takes longer than a search can wait.
    Unfinished,
    /// An answer that cannot be, or two scenes that are the same one, of which one only is answered.
    Wrong,
}

/// Relations that are tried of one scene.
const TRIED: usize = 2;
/// Relative difference between answers of the same scene in other words, of which only the rounding differs, and part of
/// their bars that the last iteration may leave.
const ROUNDING: f64 = 1e-9;
const ITERATED: f64 = 0.05;
/// Relative difference between a layer and the half space, some times the contact over the thickness, if long waves find the
/// material no softer than the contact does; and what says nothing any more.
const THICK: f64 = 1e-5;
const VAGUE: f64 = 0.01;
/// d ln F/d ln d and d ln μ/d ln d are smaller for all bodies.
const STEEPEST: f64 = 4.0;

/// Draws the scene with this number, and judges it; a scene that contradicts itself stays in its folder.
pub(super) fn judge(seed: u64, number: usize, range: &Range, out: &Path) -> Result<Vec<Row>> {
    let mut random = Random::new(seed.wrapping_mul(1_000_003).wrapping_add(number as u64));
    let folder = out.join(format!("agreement-{seed}-{number}"));
    let case = sample(&mut random, range, &folder)?;
    let judged = judged(&case, &folder, &mut random);
    let about = about(&case);
    let row = |row: Row| Row {
        seed,
        scene: number,
        indenter: about[0].clone(),
        material: about[1].clone(),
        motion: about[2].clone(),
        ..row
    };
    let rows: Vec<Row> = judged?.into_iter().map(row).collect();
    if rows.iter().any(|row| row.verdict.contradicts()) {
        case.write(&folder, "scene.toml")?;
    } else if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    Ok(rows)
}

impl Verdict {
    pub(super) const fn contradicts(self) -> bool {
        matches!(self, Self::Differs | Self::Wrong)
    }
}

fn about(case: &Case) -> [String; 3] {
    let scene = &case.scene;
    let name = |key: String| {
        key.split_once('.')
            .map_or(key.clone(), |(_, name)| name.to_owned())
    };
    let load = &scene.load;
    let motion = match (load.velocity, &scene.solve) {
        (None, _) => "history",
        (Some(velocity), _) if velocity <= 0.0 => "pressed",
        (_, solve) if solve.duration.or(solve.sliding_distance).is_some() => "from first touch",
        _ => "stationary",
    };
    let depths = load
        .history
        .as_ref()
        .map(|points| points[0].indentation_depth);
    let depth = depths.unwrap_or(load.indentation_depth);
    let control = if depth.is_some() { "depth" } else { "force" };
    let layer = if scene.layer.is_some() { ", layer" } else { "" };
    let model = scene.solve.model.map_or("", |_| ", line");
    let motion = format!("{motion}, {control}{layer}{model}");
    [
        name(scene.indenter.key()),
        name(scene.material.key()),
        motion,
    ]
}

fn judged(case: &Case, folder: &Path, random: &mut Random) -> Result<Vec<Row>> {
    let mut row = Row::of("answer");
    let started = Instant::now();
    let answer = answer(case, folder, None, 1);
    row.seconds = started.elapsed().as_secs_f64();
    let answer = match answer {
        Ok(answer) => answer,
        Err(message) => {
            row.verdict = Verdict::refusal(&message);
            return Ok(vec![Row { message, ..row }]);
        }
    };
    row.method = answer.method.name().to_owned();
    if let Some(problem) = problem_of(&answer) {
        (row.verdict, row.message) = (Verdict::Wrong, problem);
    }
    let mut rows = vec![row];
    let mut relations: Vec<Relation> = Relation::iter().collect();
    while rows.len() <= TRIED && !relations.is_empty() {
        let place = random.choice(&(0..relations.len()).collect::<Vec<_>>());
        let relation = relations.swap_remove(place);
        if let Some(derived) = relation.derive(case, &answer, random) {
            let other = other_method(relation, case, folder, random, answer.method);
            if relation != Relation::OtherMethod || other.is_some() {
                let derived = Derived {
                    method: other,
                    vague: match relation {
                        Relation::ThickLayer => THICK * relation::softening(case, folder)?,
                        _ => 0.0,
                    },
                    ..derived
                };
                if derived.vague > VAGUE {
                    continue;
                }
                let started = Instant::now();
                let row = compared(relation, &answer, &derived, folder)?;
                let seconds = started.elapsed().as_secs_f64();
                rows.push(Row { seconds, ..row });
            }
        }
    }
    Ok(rows)
}

impl Row {
    fn of(relation: &str) -> Self {
        Self {
            relation: relation.to_owned(),
            ..Self::default()
        }
    }

    /// Whether its body has one of the names between blanks.
    pub(super) fn is_of(&self, bodies: &str) -> bool {
        bodies.split(' ').any(|body| body == self.indenter)
    }

    /// On the half space or a layer.
    pub(super) fn slides(&self) -> bool {
        let slides = ["stationary", "from first touch"];
        slides.iter().any(|motion| self.motion.starts_with(motion)) && !self.motion.contains("line")
    }
}

impl Verdict {
    fn refusal(message: &str) -> Self {
        let is_bad = |bad: &&str| message.contains(bad);
        if [PANIC, "NaN", "inf "].iter().any(is_bad) {
            Self::Wrong
        } else if message.starts_with(UNFINISHED) {
            Self::Unfinished
        } else {
            Self::Refused
        }
    }
}

const PANIC: &str = "panicked: ";
const UNFINISHED: &str = "not finished: ";

/// The answer, or the sentence that says why there is none.
fn answer(
    case: &Case,
    folder: &Path,
    method: Option<Method>,
    threads: usize,
) -> Result<Answer, String> {
    let mut case = case.clone();
    case.scene.solve.method = method;
    let solved = || {
        let problem = case.problem(folder).map_err(|error| format!("{error:#}"))?;
        let patience = Patience::default();
        let plan = plan(&problem).map_err(SolveError::from);
        let solved = plan.and_then(|plan| plan.solve(&patience));
        solved.map_err(|error| {
            let unfinished = if patience.has_ended() { UNFINISHED } else { "" };
            format!("{unfinished}{error}")
        })
    };
    let solved =
        || catch_unwind(AssertUnwindSafe(solved)).unwrap_or_else(|panic| Err(said(&*panic)));
    // Of scenes that are solved at the same time none takes the threads of another; and a worker of the search that waited
    // for a pool would begin further scenes meanwhile, a thread that is not one of its workers does not.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| error.to_string())?;
    std::thread::scope(|scope| scope.spawn(|| pool.install(solved)).join())
        .unwrap_or_else(|panic| Err(said(&*panic)))
}

fn said(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    format!("{PANIC}{}", text.unwrap_or_default())
}

/// Another method that answers the scene.
fn other_method(
    relation: Relation,
    case: &Case,
    folder: &Path,
    random: &mut Random,
    chosen: Method,
) -> Option<Method> {
    if relation != Relation::OtherMethod {
        return None;
    }
    // Where nothing slides both models are the same.
    let model = case.scene.solve.model.unwrap_or(Model::HalfSpace);
    let is_of_model = |method: &Method| {
        presses(&case.scene) || method.model().is_none_or(|of_method| of_method == model)
    };
    let is_offered = |method: &Method| {
        let mut case = case.clone();
        case.scene.solve.method = Some(*method);
        let problem = case.problem(folder);
        let is_other = *method != chosen && is_of_model(method);
        is_other && problem.is_ok_and(|problem| plan(&problem).is_ok())
    };
    let offered: Vec<Method> = methods().filter(is_offered).collect();
    (!offered.is_empty()).then(|| random.choice(&offered))
}

/// What no answer may be.
fn problem_of(answer: &Answer) -> Option<String> {
    for (name, known) in quantities(answer) {
        if !(known.value.is_finite() && known.error.is_finite()) {
            return Some(format!("{name} is {} ± {}", known.value, known.error));
        }
        let signed = "x_min x_max y_min y_max indentation_depth work dissipation_shortest_octave";
        if known.value < 0.0 && !signed.split(' ').any(|signed| signed == name) {
            return Some(format!(
                "{name} is negative: {} ± {}",
                known.value, known.error
            ));
        }
    }
    let mean = answer.normal_force.value / answer.contact_area?.value;
    let peak = answer.peak_pressure?;
    (peak.value + peak.error < mean * (1.0 - 1e-9) - mean * spread(answer)).then(|| {
        format!(
            "the peak pressure {} ± {} is below the mean {mean}",
            peak.value, peak.error
        )
    })
}

/// Relative errors of force and area.
fn spread(answer: &Answer) -> f64 {
    answer.contact_area.as_ref().map_or(0.0, relative) + relative(&answer.normal_force)
}

fn relative(known: &Estimate) -> f64 {
    known.error / known.value
}

/// All numbers with their errors; those of theories are exact, and those of the corners of a contact share one.
fn quantities(answer: &Answer) -> Vec<(String, Estimate)> {
    let numbers = answer.numbers();
    let find = |name: &str| numbers.iter().find(|(other, _)| other == name)?.1;
    let is_error = |name: &str| name.ends_with("_error") || name.starts_with("error_");
    let known = numbers.iter().filter(|(name, _)| !is_error(name));
    let known = known.filter_map(|(name, value)| {
        let corner = name.ends_with("_min") || name.ends_with("_max");
        let error = if corner { "contact_box" } else { name };
        let error = find(&format!("{error}_error")).unwrap_or(0.0);
        Some((name.clone(), Estimate::new((*value)?, error)))
    });
    known.collect()
}

/// Solves the other scene, and compares all that both know.
fn compared(relation: Relation, one: &Answer, derived: &Derived, folder: &Path) -> Result<Row> {
    let mut row = Row::of(relation.into());
    row.method = one.method.name().to_owned();
    let folder = folder.join("other");
    let threads = if relation == Relation::OtherThreads {
        3
    } else {
        1
    };
    let other = match answer(&derived.case, &folder, derived.method, threads) {
        Ok(other) => other,
        Err(message) => {
            row.verdict = match Verdict::refusal(&message) {
                // On other elements an error may be missed by little.
                Verdict::Refused if !relation.is_exact() && message.contains("not reached") => {
                    Verdict::Refused
                }
                Verdict::Refused if relation.is_same() => Verdict::Wrong,
                verdict => verdict,
            };
            row.message = message;
            if row.verdict.contradicts() {
                derived.case.write(&folder, "scene.toml")?;
            }
            return Ok(row);
        }
    };
    row.other_method = other.method.name().to_owned();
    for (name, pair) in pairs(relation, one, &other, derived) {
        let allowed = allowed(relation, &name, &pair, [one, &other], derived);
        let deviation = match relation {
            Relation::MoreLoad => (pair[0].value - pair[1].value).max(0.0),
            _ => (pair[0].value - pair[1].value).abs(),
        };
        // A quantity whose unit is not known here cannot be compared, which is not to be overlooked.
        let part = match deviation {
            0.0 => 0.0,
            _ if deviation.is_nan() => f64::INFINITY,
            _ => deviation / allowed,
        };
        if row.part.is_none_or(|worst| part > worst) {
            row.part = Some(part.min(f64::MAX));
            (row.value, row.other_value) = (Some(pair[0].value), Some(pair[1].value));
            (row.allowed, row.quantity) = (Some(allowed), name);
        }
    }
    if row.part.is_some_and(|part| part > 1.0) {
        row.verdict = Verdict::Differs;
        derived.case.write(&folder, "scene.toml")?;
    }
    Ok(row)
}

/// The quantities that both know and the relation compares, in the units of the first.
fn pairs(
    relation: Relation,
    one: &Answer,
    other: &Answer,
    derived: &Derived,
) -> Vec<(String, [Estimate; 2])> {
    let of_other = quantities(other);
    let compared = |name: &str| match relation {
        // Shares of the dissipation have no bars.
        _ if name.starts_with("dissipation") => relation.is_exact(),
        // What slides on facets may leave the inner ones under more load.
        Relation::MoreLoad if name == "contact_area" => presses(&derived.case.scene),
        Relation::MoreLoad => ["normal_force", "indentation_depth"].contains(&name),
        Relation::OtherControl => !name.starts_with(['x', 'y']) && name != "peak_pressure",
        Relation::ThickLayer => !name.starts_with("persson"),
        // What is at the left is then at the right.
        Relation::Mirrored => !name.starts_with('y'),
        _ => true,
    };
    let mut pairs = Vec::new();
    for (name, known) in quantities(one) {
        let found = of_other.iter().find(|(other, _)| *other == name);
        if let Some((_, found)) = found.filter(|_| compared(&name)) {
            let factor = factor(&name, one.is_per_length, derived.powers).unwrap_or(f64::NAN);
            pairs.push((name, [known, *found * factor.recip()]));
        }
    }
    let curve = &one.fields.curve;
    for column in &curve.columns {
        let name = column.name[0];
        let Some(of_other) = other.fields.curve.column(name) else {
            continue;
        };
        let factor = factor(name, false, derived.powers).unwrap_or(f64::NAN);
        let places = places(relation, &curve.times);
        let error = column.error() + of_other.error() / factor;
        // Rounding is relative to the largest value of a curve.
        let largest = column.largest();
        for (place, known) in places.into_iter().zip(&column.values) {
            let Some(found) = of_other.values.get(place) else {
                continue;
            };
            let pair = [known.value, found.value / factor];
            let bar = 0.5 * (error + ROUNDING * largest);
            pairs.push((name.to_owned(), pair.map(|value| Estimate::new(value, bar))));
        }
    }
    pairs
}

/// Where the points of a history are in the other one.
fn places(relation: Relation, times: &[f64]) -> Vec<usize> {
    let mut place = usize::from(relation == Relation::LaterHistory);
    let has_middles = relation == Relation::SubdividedHistory;
    let mut places = vec![place];
    for pair in times.windows(2) {
        place += 1 + usize::from(has_middles && pair[1] > pair[0]);
        places.push(place);
    }
    places
}

/// By how much a quantity may differ; under another name a scene may have another method.
fn allowed(
    relation: Relation,
    name: &str,
    [one, other]: &[Estimate; 2],
    [of, of_other]: [&Answer; 2],
    derived: &Derived,
) -> f64 {
    let size = one.value.abs().max(other.value.abs());
    // A share of the friction is as exact as the friction, at best.
    let bars = if name.starts_with("dissipation") {
        let frictions = [of, of_other].map(|of| of.friction_coefficient.as_ref());
        frictions.into_iter().flatten().map(relative).sum()
    } else {
        one.error + other.error
    };
    match relation {
        Relation::OtherThreads => 0.0,
        _ if relation.is_exact() && of.method == of_other.method => {
            let has_powers = relation::has_powers(&derived.case.scene);
            ROUNDING * size + if has_powers { bars } else { ITERATED * bars }
        }
        Relation::OtherControl => {
            // What was found and is now given has an error, which the other quantities inherit.
            let given = [Some(of.normal_force), of.indentation_depth]
                .into_iter()
                .flatten();
            let inherited = given
                .map(|known| known.error / known.value.abs())
                .fold(0.0, f64::max);
            let is_given = ["normal_force", "indentation_depth"].contains(&name);
            let steepest = if is_given { STEEPEST } else { 2.0 * STEEPEST };
            bars + (steepest * inherited + ROUNDING) * size
        }
        _ => bars + (derived.vague + ROUNDING * 1e-3) * size,
    }
}
