//! One scene: whether its answer is possible at all, and whether it obeys randomly chosen relations.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use anyhow::{Context as _, Result};
use bem_halfspace::BemError;
use cpu_time::ThreadTime;
use mdr_core::MdrError;
use serde::{Deserialize, Serialize};
use strum::IntoEnumIterator as _;
use viscofriction::scene::{Method, Scene};
use viscofriction::solve::{Answer, SolveError, plan};
use viscofriction::{Estimate, Progress};

use super::derivatives;
use super::relation::{Answered, Derived, Relation, has_powers};
use crate::evidence::request::presses;
use crate::evidence::sample::{Case, Source, sample};
use crate::meter::measure;
use crate::random::Random;

/// The outcome of one relation for one scene; a row of `agreement.csv`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    /// Seed of the whole search.
    pub(super) seed: u64,
    /// Number within the search.
    pub(super) scene: usize,
    /// Kinds of body and material.
    indenter: String,
    material: String,
    pub(super) motion: Motion,
    /// True if a depth is given, and not a force.
    pub(super) is_at_depth: bool,
    /// True on a layer.
    pub(super) has_layer: bool,
    /// True in the one-dimensional model.
    is_line: bool,
    /// Name of the [`Relation`]; `answer` for what a single answer must fulfil.
    pub(super) relation: String,
    /// Methods that gave the two answers.
    pub(super) method: String,
    other_method: String,
    pub(super) verdict: Verdict,
    /// The quantity with the largest deviation over allowed deviation; then its values in both answers, in SI and in the unit
    /// of the first scene, and the allowed deviation.
    pub(super) quantity: String,
    value: Option<f64>,
    other_value: Option<f64>,
    allowed: Option<f64>,
    /// Deviation over what is allowed.
    pub(super) part: Option<f64>,
    /// Time on the wall clock \[s] of the answer that was computed for this row, by one thread unless the relation says
    /// otherwise.
    seconds: f64,
    /// Why there is no answer, or what is wrong with it.
    pub(super) message: String,
}

/// How the body of a scene moves.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Motion {
    #[default]
    Stationary,
    FromFirstTouch,
    Track,
    Reciprocating,
    ThroughPoints,
    Pressed,
    History,
}

/// Outcome of a comparison.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Verdict {
    #[default]
    Holds,
    /// Both scenes are answered, and some quantity deviates by more than it may.
    Differs,
    /// The first scene is not answered, or the other one is not and may be refused.
    Refused,
    /// The accuracy was not reached before [`REFINEMENT_TIME_LIMIT`].
    Unfinished,
    /// An answer that is impossible, a panic, or only one answer of two scenes that are the same one.
    Wrong,
}

/// Number of relations that are tried with one scene. Chosen: more scenes find more contradictions than more relations of each.
const RELATIONS_PER_SCENE: usize = 2;
/// Relative difference allowed between answers to two forms of the same scene, which differ by rounding only. Chosen: many
/// roundings are amplified by ill-conditioned contacts, but no discretisation error that matters is smaller.
const ROUNDING_TOLERANCE: f64 = 1e-9;
/// Ratio of the difference between answers to two forms of the same scene to the sum of their error bars, which iterations that
/// stop at their tolerance may leave. Chosen.
const ITERATION_TOLERANCE: f64 = 0.05;
/// Assumed bound of d ln F/d ln d and d ln μ/d ln d of the bodies that are drawn, with the normal force F, the depth d and the
/// friction μ. It bounds how much an error of the given quantity is amplified in the others.
const MAX_LOG_SLOPE: f64 = 4.0;
/// Processor time of a thread after which it begins no finer grid. Chosen, so that thousands of scenes are affordable.
const REFINEMENT_TIME_LIMIT: Duration = Duration::from_secs(10);

/// Draws the scene with this number, which depends on `seed` and `number` only, and judges it. The folder
/// `agreement-SEED-NUMBER` in `out` with the files of the scene is kept only if its answers contradict each other.
pub(super) fn judge(seed: u64, number: usize, source: &Source, out: &Path) -> Result<Vec<Row>> {
    let mut random = Random::new(seed.wrapping_mul(1_000_003).wrapping_add(number as u64));
    let folder = out.join(format!("agreement-{seed}-{number}"));
    let case = sample(&mut random, source, &folder)?;
    let mut rows = judged(&case, &folder, &mut random)?;
    rows.iter_mut().for_each(|row| row.describe(&case));
    for row in &mut rows {
        (row.seed, row.scene) = (seed, number);
    }
    if rows.iter().any(|row| row.verdict.contradicts()) {
        case.write(&folder, "scene.toml")?;
    } else if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    Ok(rows)
}

impl Motion {
    /// The motion of a scene.
    const fn of(Scene { load, solve, .. }: &Scene) -> Self {
        match load.velocity {
            None if load.stroke.is_some() => Self::Reciprocating,
            None if load.motion.is_some() => Self::ThroughPoints,
            None => Self::History,
            _ if load.track.is_some() => Self::Track,
            Some(velocity) if velocity <= 0.0 => Self::Pressed,
            _ if solve.duration.is_some() || solve.sliding_distance.is_some() => {
                Self::FromFirstTouch
            }
            _ => Self::Stationary,
        }
    }
}

/// First the row `answer`, then, if there is an answer, those of [`RELATIONS_PER_SCENE`] relations that `random` chooses among
/// those that apply. Identity and motion of the scene are not filled in yet.
fn judged(case: &Case, folder: &Path, random: &mut Random) -> Result<Vec<Row>> {
    let mut row = Row::of("answer");
    let (answer, cost) = measure(|| answer(case, folder, None, 1));
    row.seconds = cost.seconds;
    let answer = match answer {
        Ok(answer) => answer,
        Err(failure) => return Ok(vec![row.failed(failure)]),
    };
    row.method = answer.method.name().to_owned();
    if let Some(problem) = problem_of(&answer) {
        (row.verdict, row.message) = (Verdict::Wrong, problem);
    }
    let mut rows = vec![row];
    let mut relations: Vec<Relation> = Relation::iter().collect();
    let answer = &answer;
    let first = Answered {
        case,
        folder,
        answer,
    };
    while rows.len() <= RELATIONS_PER_SCENE && !relations.is_empty() {
        let place = random.choice(&(0..relations.len()).collect::<Vec<_>>());
        let relation = relations.swap_remove(place);
        if relation == Relation::Derivatives {
            rows.extend(added_up(first)?);
        } else if let Some(derived) = relation.derive(first, random)? {
            let (row, cost) = measure(|| compared(relation, first, &derived));
            let seconds = cost.seconds;
            rows.push(Row { seconds, ..row? });
        }
    }
    Ok(rows)
}

impl Row {
    /// The row of a relation, everything else empty.
    fn of(relation: &str) -> Self {
        Self {
            relation: relation.to_owned(),
            ..Self::default()
        }
    }

    /// With the comparison of the largest deviation over allowed deviation, and the verdict about it.
    fn judged(mut self, comparisons: Vec<Comparison>) -> Self {
        for comparison in comparisons {
            let part = comparison.part();
            if self.part.is_none_or(|worst| part > worst) {
                self.part = Some(part.min(f64::MAX));
                [self.value, self.other_value] = comparison.values.map(Some);
                self.allowed = Some(comparison.allowed);
                self.quantity = comparison.quantity;
            }
        }
        if self.part.is_some_and(|part| part > 1.0) {
            self.verdict = Verdict::Differs;
        }
        self
    }

    /// The row of a scene without an answer.
    fn failed(self, failure: Failure) -> Self {
        Self {
            verdict: failure.verdict,
            message: failure.message,
            ..self
        }
    }

    /// Fills in body, material, motion, control, layer and model of the scene.
    fn describe(&mut self, Case { scene, .. }: &Case) {
        self.indenter = scene.indenter.key().replace("indenter.", "");
        self.material = scene.material.key().replace("material.", "");
        self.motion = Motion::of(scene);
        let history = scene.load.history.as_ref();
        let depth = scene.load.indentation_depth;
        let depth = history.map_or(depth, |points| points[0].indentation_depth);
        self.is_at_depth = depth.is_some();
        self.has_layer = scene.layer.is_some();
        self.is_line = scene.solve.model.is_some();
    }

    /// Whether its body is of one of the kinds that `bodies` names, separated by blanks.
    pub(super) fn is_of(&self, bodies: &str) -> bool {
        bodies.split(' ').any(|body| body == self.indenter)
    }

    /// Whether it slides, on the half space or a layer and not in the one-dimensional model.
    pub(super) fn slides(&self) -> bool {
        !self.is_line && !matches!(self.motion, Motion::Pressed | Motion::History)
    }
}

/// Two values of a quantity, and by how much they may deviate.
pub(super) struct Comparison {
    /// Name of the quantity.
    pub(super) quantity: String,
    /// Values of the first and of the other answer, in the unit of the first.
    pub(super) values: [f64; 2],
    /// Difference that counts as a deviation; not negative, in the same unit.
    pub(super) deviation: f64,
    /// Largest deviation with which the relation holds.
    pub(super) allowed: f64,
}

impl Comparison {
    /// Deviation over allowed deviation; 0 without a deviation, even where none is allowed, and infinite of NaN.
    fn part(&self) -> f64 {
        match self.deviation {
            0.0 => 0.0,
            deviation if deviation.is_nan() => f64::INFINITY,
            deviation => deviation / self.allowed,
        }
    }
}

impl Verdict {
    /// Whether it shows that something is wrong.
    pub(super) const fn contradicts(self) -> bool {
        matches!(self, Self::Differs | Self::Wrong)
    }
}

/// Why a scene has no answer that counts.
struct Failure {
    verdict: Verdict,
    /// Whether an answer was found whose error bar is wider than what was asked for.
    is_less_exact: bool,
    message: String,
}

impl Failure {
    /// A failure with this verdict; `Wrong` if the message shows a number that is NaN or infinite, which none may.
    fn new(verdict: Verdict, message: String) -> Self {
        let is_shown = |text| message.contains(text);
        let verdict = if is_shown("NaN") || is_shown("inf ") {
            Verdict::Wrong
        } else {
            verdict
        };
        Self {
            verdict,
            is_less_exact: false,
            message,
        }
    }

    /// The failure of a scene that the solver refuses.
    fn refusal(error: &SolveError) -> Self {
        Self {
            is_less_exact: misses(error),
            ..Self::new(Verdict::Refused, error.to_string())
        }
    }
}

/// Whether the error only says that the accuracy was not reached.
fn misses(error: &SolveError) -> bool {
    match error {
        SolveError::MemoryReached { reached, .. } => misses(reached),
        SolveError::NotReached { why, .. } => misses(why),
        SolveError::SeriesTooCoarse { .. } | SolveError::TooFewSurfaces { .. } => true,
        SolveError::HalfSpace(error) => matches!(error, BemError::NotReached { .. }),
        SolveError::Line(error) => matches!(
            error,
            MdrError::NotConverged { .. }
                | MdrError::WorkNotReached(_)
                | MdrError::HistoryNotReached { .. }
                | MdrError::SlidingNotReached { .. }
                | MdrError::MotionNotReached { .. }
        ),
        _ => false,
    }
}

/// Ends a refinement whose thread has worked longer than [`REFINEMENT_TIME_LIMIT`]. Processor time of the thread is measured,
/// so that the outcome depends little on how busy the machine is.
#[derive(Debug)]
struct TimeLimit {
    /// Processor time of the thread at which it has to end.
    end: Duration,
    has_ended: AtomicBool,
}

impl Progress for TimeLimit {
    fn may_refine(&self, _: usize) -> bool {
        let is_early = ThreadTime::now().as_duration() < self.end;
        self.has_ended.fetch_or(!is_early, Ordering::Relaxed);
        is_early
    }

    fn report(&self, _: f64) {}
}

/// The answer to a scene by `method`, or by that of the scene, on `threads` threads; or why there is none. A panic is a
/// failure.
fn answer(
    case: &Case,
    folder: &Path,
    method: Option<Method>,
    threads: usize,
) -> Result<Answer, Failure> {
    let mut case = case.clone();
    case.scene.solve.method = method;
    let solved = || {
        let problem = case.problem(folder);
        let problem =
            problem.map_err(|error| Failure::new(Verdict::Refused, format!("{error:#}")))?;
        let time_limit = TimeLimit {
            end: ThreadTime::now().as_duration() + REFINEMENT_TIME_LIMIT,
            has_ended: AtomicBool::new(false),
        };
        let plan = plan(&problem).map_err(SolveError::from);
        let solved = plan.and_then(|plan| plan.solve(&time_limit));
        solved.map_err(|error| match time_limit.has_ended.into_inner() {
            true => Failure::new(Verdict::Unfinished, format!("not finished: {error}")),
            false => Failure::refusal(&error),
        })
    };
    // Solve in a pool of its own, so that scenes that are solved at the same time take no threads from each other. Start it from
    // a new thread: a worker of the search that waited for a pool would begin further scenes meanwhile.
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Failure::new(Verdict::Refused, error.to_string()))?;
    let solved = std::thread::scope(|scope| scope.spawn(|| pool.install(solved)).join());
    solved.unwrap_or_else(|panic| {
        let owned = panic.downcast_ref::<String>().map(String::as_str);
        let text = owned.or_else(|| panic.downcast_ref::<&str>().copied());
        let message = format!("panicked: {}", text.unwrap_or_default());
        Err(Failure::new(Verdict::Wrong, message))
    })
}

/// What is impossible about an answer: a value that is not finite, a negative value of a quantity that cannot be, or a peak
/// pressure below the mean one. `None` if nothing is.
fn problem_of(answer: &Answer) -> Option<String> {
    for (name, known) in quantities(answer) {
        let [value, error] = [known.value, known.error];
        if !(value.is_finite() && error.is_finite()) {
            return Some(format!("{name} is {value} ± {error}"));
        }
        let is_of = |names: &str| names.split(' ').any(|one| one == name);
        // Friction of an elastic material is 0, which numerical methods meet only within their error bars, so it may be slightly
        // negative.
        let rubs = is_of(
            "dissipated_energy friction_coefficient friction_from_hysteresis tangential_force",
        );
        let is_signed =
            is_of("x_min x_max y_min y_max indentation_depth work dissipation_shortest_octave");
        if value < if rubs { -error } else { 0.0 } && !is_signed {
            return Some(format!("{name} is negative: {value} ± {error}"));
        }
    }
    let (area, peak) = (answer.contact_area?, answer.peak_pressure?);
    let [value, error] = [peak.value, peak.error];
    let mean = answer.normal_force.value / area.value;
    let spread = area.relative_error() + answer.normal_force.relative_error();
    let is_below = value + error < mean * (1.0 - 1e-9) - mean * spread;
    is_below.then(|| format!("the peak pressure {value} ± {error} is below the mean {mean}"))
}

/// All numbers of an answer by name, with their absolute errors. The extremes of a contact share that of `contact_box`; a
/// number without an error, such as one of a closed theory, counts as exact.
pub(super) fn quantities(answer: &Answer) -> Vec<(String, Estimate)> {
    let numbers = answer.numbers();
    let find = |name: &str| numbers.iter().find(|(other, _)| other == name)?.1;
    let is_error = |name: &str| name.ends_with("_error") || name.starts_with("error_");
    let values = numbers.iter().filter(|(name, _)| !is_error(name));
    values
        .filter_map(|(name, value)| {
            let is_extreme = name.ends_with("_min") || name.ends_with("_max");
            let owner_of_error = if is_extreme { "contact_box" } else { name };
            let error = find(&format!("{owner_of_error}_error")).unwrap_or(0.0);
            Some((name.clone(), Estimate::new((*value)?, error)))
        })
        .collect()
}

/// The row of [`Relation::Derivatives`], with the sum that is farthest from what it must be; `None` where it does not apply.
fn added_up(first: Answered) -> Result<Option<Row>> {
    let (sums, cost) = measure(|| derivatives::sums(first));
    let mut row = Row::of(Relation::Derivatives.into());
    row.method = first.answer.method.name().to_owned();
    row.seconds = cost.seconds;
    let sums = match sums.map_err(anyhow::Error::downcast::<SolveError>) {
        Ok(sums) => sums,
        Err(Ok(error)) => return Ok(Some(row.failed(Failure::refusal(&error)))),
        Err(Err(error)) => return Err(error),
    };
    Ok((!sums.is_empty()).then(|| row.judged(sums)))
}

/// Solves the derived scene, and compares all quantities that both answers have. Keeps its files if they contradict each other.
fn compared(relation: Relation, first: Answered, derived: &Derived) -> Result<Row> {
    let mut row = Row::of(relation.into());
    row.method = first.answer.method.name().to_owned();
    let folder = first.folder.join("other");
    let threads = match relation {
        Relation::OtherThreads => 3,
        _ => 1,
    };
    match answer(&derived.case, &folder, derived.method, threads) {
        Ok(other) => {
            row.other_method = other.method.name().to_owned();
            let one = first.answer;
            let pair = Pair {
                relation,
                one,
                other: &other,
                derived,
            };
            row = row.judged(pair.comparisons()?);
        }
        Err(failure) => {
            // If the relation changes the elements, the requested error may be missed by little, which is no contradiction.
            let may_be_missed = !relation.is_exact() && failure.is_less_exact;
            row = row.failed(failure);
            if row.verdict == Verdict::Refused && relation.is_same() && !may_be_missed {
                row.verdict = Verdict::Wrong;
            }
        }
    }
    if row.verdict.contradicts() {
        derived.case.write(&folder, "scene.toml")?;
    }
    Ok(row)
}

/// Answers of two scenes between which a relation holds.
struct Pair<'a> {
    relation: Relation,
    one: &'a Answer,
    other: &'a Answer,
    derived: &'a Derived,
}

impl Pair<'_> {
    /// A comparison of each quantity. Under more load only a value that falls is a deviation.
    fn comparisons(&self) -> Result<Vec<Comparison>> {
        let comparison = |(quantity, [one, other]): (String, [Estimate; 2])| Comparison {
            deviation: match self.relation {
                Relation::MoreLoad => (one.value - other.value).max(0.0),
                _ => (one.value - other.value).abs(),
            },
            allowed: self.allowed(&quantity, [one, other]),
            values: [one.value, other.value],
            quantity,
        };
        Ok(self.quantities()?.into_iter().map(comparison).collect())
    }

    /// Whether the relation says anything about a quantity.
    fn is_compared(&self, name: &str) -> bool {
        match self.relation {
            // Shares of the dissipation have no error bars, so they are compared only if both answers must be equal.
            _ if name.starts_with("dissipation") => self.relation.is_exact(),
            // Under more load a body that slides on facets may leave the inner ones, so that its area is compared only if it is
            // pressed.
            Relation::MoreLoad if name == "contact_area" => presses(&self.derived.case.scene),
            Relation::MoreLoad => ["normal_force", "indentation_depth"].contains(&name),
            // At the depth of softer moduli, those of small strains carry another force.
            Relation::OtherControl => {
                !name.starts_with(['x', 'y'])
                    && !["peak_pressure", "linear_friction_coefficient"].contains(&name)
            }
            Relation::ThickLayer => !name.starts_with("persson"),
            // Mirroring exchanges left and right, so the edges along y are not compared.
            Relation::Mirrored => !name.starts_with('y'),
            _ => true,
        }
    }

    /// The quantities that both answers have and the relation compares, then all points of their curves over time, in the units
    /// of the first.
    fn quantities(&self) -> Result<Vec<(String, [Estimate; 2])>> {
        let Self { one, other, .. } = self;
        let factors = self.derived.powers.factors(one.is_per_length)?;
        let factor = |name: &str| {
            let factor = factors.get(name).copied();
            factor.with_context(|| format!("{name} has no unit"))
        };
        let of_other = quantities(other);
        let mut pairs = Vec::new();
        for (name, known) in quantities(one) {
            let found = of_other.iter().find(|(other, _)| *other == name);
            if let Some((_, found)) = found.filter(|_| self.is_compared(&name)) {
                let found = *found * factor(&name)?.recip();
                pairs.push((name, [known, found]));
            }
        }
        let curve = &one.fields.curve;
        // A motion with more points has values at other times, so its curves are not compared.
        let columns = match self.relation {
            Relation::SubdividedMotion => &[][..],
            _ => &curve.columns[..],
        };
        for column in columns {
            let name = column.name[0];
            // Do not compare tangential forces under more load, because friction may become smaller or change its direction.
            let rubs = name == "tangential_force" && self.relation == Relation::MoreLoad;
            let Some(of_other) = other.fields.curve.column(name).filter(|_| !rubs) else {
                continue;
            };
            let factor = factor(name)?;
            let error = column.error() + of_other.error() / factor;
            // Rounding is relative to the largest value of a curve.
            let bar = 0.5 * (error + ROUNDING_TOLERANCE * column.largest());
            for (place, known) in self.places(&curve.times).into_iter().zip(&column.values) {
                if let Some(found) = of_other.values.get(place) {
                    let pair = [known.value, found.value / factor];
                    pairs.push((name.to_owned(), pair.map(|value| Estimate::new(value, bar))));
                }
            }
        }
        Ok(pairs)
    }

    /// The index in the other history of each point of this one, whose dates are `times`.
    fn places(&self, times: &[f64]) -> Vec<usize> {
        let mut place = usize::from(self.relation == Relation::LaterHistory);
        let has_middles = self.relation == Relation::SubdividedHistory;
        let mut places = vec![place];
        for pair in times.windows(2) {
            place += 1 + usize::from(has_middles && pair[1] > pair[0]);
            places.push(place);
        }
        places
    }

    /// By how much a quantity may differ: nothing between numbers of threads; rounding and what iterations leave between forms
    /// of the same scene, if both are solved by the same method; otherwise the sum of both error bars and what the relation
    /// adds.
    fn allowed(&self, name: &str, [one, other]: [Estimate; 2]) -> f64 {
        let size = one.value.abs().max(other.value.abs());
        let answers = [self.one, self.other];
        // The error of a share of the dissipation is at least the relative error of the friction.
        let bars = if name.starts_with("dissipation") {
            let frictions = answers.map(|of| of.friction_coefficient.as_ref());
            frictions
                .into_iter()
                .flatten()
                .map(Estimate::relative_error)
                .sum()
        } else {
            one.error + other.error
        };
        match self.relation {
            Relation::OtherThreads => 0.0,
            relation if relation.is_exact() && self.one.method == self.other.method => {
                let has_powers = has_powers(&self.derived.case.scene);
                let part = if has_powers { 1.0 } else { ITERATION_TOLERANCE };
                ROUNDING_TOLERANCE * size + part * bars
            }
            Relation::OtherControl => {
                // A quantity that was computed and is given in the other scene has an error, which the other quantities inherit.
                let given = [Some(self.one.normal_force), self.one.indentation_depth];
                let errors = given.iter().flatten().map(Estimate::relative_error);
                let inherited = errors.fold(0.0, f64::max);
                let is_given = ["normal_force", "indentation_depth"].contains(&name);
                let orders = if is_given { 1.0 } else { 2.0 };
                bars + (orders * MAX_LOG_SLOPE * inherited + ROUNDING_TOLERANCE) * size
            }
            _ => bars + (self.derived.truth_difference + ROUNDING_TOLERANCE * 1e-3) * size,
        }
    }
}
