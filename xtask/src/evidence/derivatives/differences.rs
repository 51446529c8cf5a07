//! Derivatives of the answer to one scene, compared with central differences of far more exact answers.

use anyhow::{Context as _, Result};
use serde::{Deserialize, Serialize};
use toml::Value;
use viscofriction::scene::{Method, Model, Scene};
use viscofriction::solve::{Answer, Problem, Sensitivity, plan, solve};
use viscofriction::{Estimate, Quantity};

use crate::evidence::request::{derivatives, number_at};
use crate::evidence::sample::NumberedScene;
use crate::random::Random;

/// Positions in steps h and weights of a central difference of fourth order: `12 h f' = 8 (f₁ − f₋₁) − (f₂ − f₋₂)`.
const STENCIL: [[f64; 2]; 4] = [[-2.0, 1.0], [-1.0, -8.0], [1.0, 8.0], [2.0, -1.0]];
/// Ratio of the sum of weight times value over [`STENCIL`] to h f', by which it is divided.
const STENCIL_DIVISOR: f64 = 12.0;
/// Factor in an estimate of the remainder r₄ = h⁴ f⁽⁵⁾/30 of fourth order by the remainder r₂ = h² f‴/6 of second order: r₄ = 7.2
/// r₂²/f′. It is exact for f = ln |x − x₀| with any x₀, the shape of a power law near x₀.
const REMAINDER_RATIO: f64 = 7.2;
/// Kinds of bodies that end in a flat or have an edge.
const FLAT_ENDED: [&str; 3] = ["flat-punch", "flat-cone", "truncated-paraboloid"];

/// A method, on which scenes it is judged, and how accurate its answers are to be; a table of the file of the experiment.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct Asked {
    /// Name of the range from which its scenes are drawn.
    pub(super) range: String,
    /// One of this number of scenes is taken.
    pub(super) one_scene_of: usize,
    pub(super) method: Method,
    model: Model,
    /// Requested of the answer that is differentiated.
    relative_error: f64,
    /// What is requested of the answers that are differenced.
    reference: Reference,
    /// True if scenes keep their heat and strain dependence, and those without are left out; else all lose it.
    #[serde(default)]
    moduli_follow: bool,
    /// h: step of the logarithm of the number that is changed.
    step: f64,
    /// Number of scenes from which those are taken.
    pub(super) scenes: usize,
    /// Largest memory of an answer, if not that of the scene.
    memory: Option<String>,
    /// Largest memory of an answer that is differenced, if not that of the one that is differentiated.
    reference_memory: Option<String>,
}

/// Request of the answers that are differenced.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Reference {
    /// A relative error, from which that of the difference follows.
    RelativeError(f64),
    /// Two numbers of elements: on given elements neighbouring answers have nearly the same errors, and the distance of both differences is
    /// the error of the first one.
    Elements([usize; 2]),
}

/// One derivative of the logarithm of a quantity by that of a number of the scene, and the difference that is its reference.
/// All values are without a unit; errors are absolute.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Derivative {
    scene: usize,
    pub(super) group: String,
    indenter: String,
    material: String,
    parameter: String,
    quantity: &'static str,
    value: f64,
    pub(super) error_bar: f64,
    reference: f64,
    pub(super) reference_error: f64,
    /// The largest derivative of this quantity by a number of the scene.
    pub(super) largest: f64,
    pub(super) deviation: f64,
    #[serde(skip)]
    pub(super) method: &'static str,
}

impl Derivative {
    /// True if the deviation of the derivative is within its error bar and the error of its reference.
    pub(super) fn holds(&self) -> bool {
        self.deviation <= self.error_bar + self.reference_error
    }
}

/// A method that could not answer a scene, and why.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Refusal {
    scene: usize,
    method: &'static str,
    reason: String,
}

impl Refusal {
    /// Row for a scene whose differentiation was refused.
    pub(super) fn new(scene: usize, asked: &Asked, error: &anyhow::Error) -> Self {
        Self {
            scene,
            method: asked.method.name(),
            reason: format!("{error:#}"),
        }
    }
}

/// The derivatives of a scene by up to `count` of its numbers, with their references; empty where the method does not offer the
/// scene or has no derivatives.
pub(super) fn compared(
    NumberedScene { number, scene }: &NumberedScene,
    asked: &Asked,
    count: usize,
) -> Result<Vec<Derivative>> {
    let mut scene = asked.scene(scene);
    scene.solve.relative_error = Some(asked.relative_error);
    let is_left_out = asked.moduli_follow && scene.heat.is_none() && scene.strain.is_none();
    let problem = Problem::try_from(&scene)?;
    if is_left_out || plan(&problem).is_err() {
        return Ok(Vec::new());
    }
    let known = derivatives(&scene, &problem, solve(&problem)?)?;
    let mut random = Random::new(*number as u64);
    let mut rows = Vec::new();
    for one in chosen(&known, &scene, asked, &mut random, count) {
        let answers = asked.references(&scene, &one.parameter)?;
        for (quantity, known_as) in one.derivatives.iter() {
            let Some(reference) = reference(&answers, quantity, asked.step) else {
                continue;
            };
            rows.push(Derivative {
                scene: *number,
                group: asked.group(&scene),
                indenter: scene.indenter.key(),
                material: scene.material.key(),
                parameter: one.parameter.clone(),
                quantity,
                value: known_as.value,
                error_bar: known_as.error,
                reference: reference.value,
                reference_error: reference.error,
                largest: largest(&known, quantity),
                deviation: (known_as.value - reference.value).abs(),
                method: asked.method.name(),
            });
        }
    }
    Ok(rows)
}

/// Up to `count` random derivatives by numbers that may be larger by two steps; one at its upper bound may not.
fn chosen<'a>(
    known: &'a [Sensitivity],
    scene: &Scene,
    asked: &Asked,
    random: &mut Random,
    count: usize,
) -> Vec<&'a Sensitivity> {
    let may_change = |one: &&Sensitivity| {
        let largest = asked.changed(scene, &one.parameter, 2.0);
        largest.is_ok_and(|scene| Problem::try_from(&scene).is_ok())
    };
    let mut others: Vec<&Sensitivity> = known.iter().filter(may_change).collect();
    let mut chosen = Vec::new();
    while chosen.len() < count && !others.is_empty() {
        let indices: Vec<usize> = (0..others.len()).collect();
        chosen.push(others.swap_remove(random.choice(&indices)));
    }
    chosen
}

/// The largest modulus of the derivatives of a quantity; 0 if there is none.
fn largest(known: &[Sensitivity], quantity: &str) -> f64 {
    known
        .iter()
        .filter_map(|one| one.derivatives.of(quantity))
        .map(|derivative| derivative.value.abs())
        .fold(0.0, f64::max)
}

/// The derivative of the logarithm of a quantity from answers to one request, or from those on two numbers of elements.
fn reference(answers: &[Vec<Answer>], name: &str, step: f64) -> Option<Estimate> {
    match answers {
        [fine, coarse] => {
            let value = |answers: &[Answer]| Some(difference(answers, name, step)?.value);
            let [fine, coarse] = [value(fine)?, value(coarse)?];
            Some(Estimate::new(fine, (fine - coarse).abs()))
        }
        [exact] => difference(exact, name, step),
        _ => None,
    }
}

/// The derivative of the logarithm of the quantity `name` from `answers` at the positions of [`STENCIL`]. Its error has two
/// parts: those of the answers, as if independent of each other, and the estimated remainder of the difference. `None` where an
/// answer has no such quantity or it is not positive.
fn difference(answers: &[Answer], name: &str, step: f64) -> Option<Estimate> {
    let (mut sum, mut near, mut squares) = (0.0, 0.0, 0.0);
    for (answer, [steps, weight]) in answers.iter().zip(STENCIL) {
        let known = (Quantity::named(name)?.of)(answer)?;
        sum += weight * known.value.ln();
        if steps.abs() <= 1.0 {
            near += steps * known.value.ln();
        }
        squares += (weight * known.error / known.value).powi(2);
    }
    let width = STENCIL_DIVISOR * step;
    let fourth = sum / width;
    let second = near / (2.0 * step);
    // Estimate the remainder of the fourth order from that of the second, which is the distance of both orders.
    let apart = (fourth - second).abs();
    let left = apart * (REMAINDER_RATIO * apart / fourth.abs()).min(1.0);
    let known = Estimate::new(fourth, squares.sqrt() / width + left);
    (known.value.is_finite() && known.error.is_finite()).then_some(known)
}

impl Asked {
    /// The scene with this method, its model and memory, without a requested accuracy.
    fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.solve.method = Some(self.method);
        scene.solve.model = Some(self.model);
        if !self.moduli_follow {
            (scene.heat, scene.strain) = (None, None);
        }
        if self.model == Model::Line {
            // The one-dimensional model knows no contact area, on which shear acts.
            scene.interface = None;
        }
        scene.solve.relative_error = None;
        if self.memory.is_some() {
            scene.solve.max_memory.clone_from(&self.memory);
        }
        scene
    }

    /// The answers that are differenced, once or on two numbers of elements.
    fn references(&self, scene: &Scene, parameter: &str) -> Result<Vec<Vec<Answer>>> {
        let mut exact = self.scene(scene);
        match self.reference {
            Reference::RelativeError(error) => {
                exact.solve.relative_error = Some(error);
                Ok(vec![self.answers(exact, parameter)?])
            }
            Reference::Elements(numbers) => {
                let on_elements = |elements: usize| {
                    let mut scene = exact.clone();
                    scene.solve.elements = Some(elements);
                    self.answers(scene, parameter)
                };
                numbers.into_iter().map(on_elements).collect()
            }
        }
    }

    /// The answers at the positions of [`STENCIL`] around a scene, of whose numbers that at the path `parameter` changes.
    fn answers(&self, mut exact: Scene, parameter: &str) -> Result<Vec<Answer>> {
        if self.reference_memory.is_some() {
            exact.solve.max_memory.clone_from(&self.reference_memory);
        }
        let solved = |[steps, _]: [f64; 2]| -> Result<Answer> {
            let scene = self.changed(&exact, parameter, steps)?;
            // If the requested error is missed, the answer is still a reference with the error that it states.
            let solved = solve(&Problem::try_from(&scene)?);
            let reached = solved.or_else(|failure| failure.reached().cloned().ok_or(failure));
            Ok(reached?)
        };
        STENCIL.into_iter().map(solved).collect()
    }

    /// The scene with the number at `path` multiplied by exp(`steps` h).
    fn changed(&self, scene: &Scene, path: &str, steps: f64) -> Result<Scene> {
        let mut value = Value::try_from(scene)?;
        let number = number_at(&mut value, path).with_context(|| format!("no number {path}"))?;
        *number *= (steps * self.step).exp();
        Ok(value.try_into()?)
    }

    /// Method and, for the stationary half space, kind of body in words; a line of the table.
    fn group(&self, scene: &Scene) -> String {
        let key = scene.indenter.key();
        let kind = key.split('.').nth(1).unwrap_or_default();
        let body = match kind {
            _ if self.method != Method::BemSteady => "",
            "self-affine" if self.moduli_follow => ", rough, heat or strain",
            _ if self.moduli_follow => ", heat or strain",
            "self-affine" => ", rough",
            _ if scene.layer.is_some() => ", layer",
            "cylinder" => ", cylinder",
            _ if FLAT_ENDED.contains(&kind) => ", flat end",
            _ => ", half space",
        };
        format!("{}{body}", self.method.name())
    }
}
