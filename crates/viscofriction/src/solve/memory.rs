//! Memory estimates of the methods, evaluated before each grid.

use std::sync::OnceLock;

use bem_halfspace::indent::{indent_along_memory, indent_memory};
use bem_halfspace::{move_along_memory, periodic, slide::slide_memory, steady::steady_memory};
use indenters::rough::PeriodicSurface;
use indenters::{EquivalentLine, MovingLoad, Surface};
use mdr_core::elements_of_motion;
use numerics::{FIRST_ELEMENTS, Progress, whole_part};

use super::body::Body;
use super::error::{Result, SolveError};
use super::problem::Motion::{History, Moving, Pressing, Sliding};
use super::problem::Problem;
use crate::scene::Method::{self, BemSteady, BemTransient, MdrTransient};
use crate::scene::{Accuracy, SceneError};

/// Rejects a method whose first grid, or for a periodic surface the coarsest grid with error estimates, exceeds the memory limit.
pub(super) fn check_memory(problem: &Problem, method: Method) -> Result<(), SceneError> {
    match check_first_grid(problem, method) {
        Err(SolveError::Scene(refused)) => Err(refused),
        // Memory cannot be estimated after another error, which is reported when the problem is solved.
        _ => Ok(()),
    }
}

/// Rejects a first grid that exceeds the memory limit or the largest number of time steps.
pub(super) fn check_first_grid(problem: &Problem, method: Method) -> Result<()> {
    let (elements, change) = match (problem.accuracy(), problem.body(), problem.motion()) {
        (Accuracy::Elements(elements), ..) => (elements, ["solve.elements", "fewer elements"]),
        (_, Body::Periodic(surface), Moving(_)) => {
            let change = ["solve.max_memory", "a longer shortest_wavelength"];
            (periodic::elements_of_motion(surface), change)
        }
        (_, Body::Periodic(surface), _) => return Ok(check_waves(problem, surface)?),
        (_, body, Moving(load)) if method == MdrTransient => (
            elements_of_line_motion(problem, body, load)?,
            CHOSEN_BY_METHOD,
        ),
        _ => (FIRST_ELEMENTS, CHOSEN_BY_METHOD),
    };
    check_grid(problem, method, elements, change)
}

/// Elements along the contact of the first grid of a motion in the one-dimensional model.
fn elements_of_line_motion(problem: &Problem, body: &Body, load: &MovingLoad) -> Result<usize> {
    let Some(surface) = body.surface().and_then(Surface::as_axisymmetric) else {
        return Ok(FIRST_ELEMENTS);
    };
    let line = EquivalentLine(surface);
    Ok(elements_of_motion(&line, problem.material(), load)?)
}

/// Rejects a surface for which even the coarsest grids with error estimates exceed the limit.
fn check_waves(problem: &Problem, surface: &PeriodicSurface) -> Result<(), SceneError> {
    let most = periodic::largest_grid(problem.max_memory().map(|bytes| bytes as f64));
    let elements = periodic::elements_for_bars(surface);
    if elements <= most {
        return Ok(());
    }
    problem.set_short_of_memory();
    // The message proposes a smaller set of waves: those resolved on the largest of successively halved grids that fits into the
    // memory.
    let largest = surface.largest_numbers();
    let shapes = (1..usize::BITS).map(|power| largest.map(|number| ((2 * number) >> power).max(1)));
    let resolved_on = |shape| surface.resolved_on(shape);
    let mut resolved = shapes.filter_map(resolved_on);
    let kept = resolved
        .find(|kept| periodic::elements_for_bars(kept) <= most)
        .map(|kept| kept.largest_numbers());
    Err(too_large([elements, most], surface.period(), kept))
}

/// Rejects a random surface for which every grid exceeds the limit of `memory` \[bytes], before its waves are drawn; lengths in
/// \[m].
pub(super) fn check_waves_to_draw(
    period: [f64; 2],
    shortest_wavelength: f64,
    memory: Option<u64>,
) -> Result<(), SceneError> {
    let numbers = period.map(|period| period / shortest_wavelength);
    let is_drawn = |number: &f64| *number > 0.0 && *number < f64::from(u32::MAX);
    if !numbers.iter().all(is_drawn) {
        // Numbers out of range need no estimate, because the constructor of the surface rejects them by parameter name.
        return Ok(());
    }
    let n_waves = numbers.map(whole_part);
    let most = periodic::largest_grid(memory.map(|bytes| bytes as f64));
    let elements = periodic::fewest_elements(n_waves);
    if elements <= most {
        return Ok(());
    }
    let kept = (1..usize::BITS)
        .map(|power| n_waves.map(|number| number >> power))
        .take_while(|kept| *kept != [0; 2])
        .find(|kept| periodic::fewest_elements(*kept) <= most);
    Err(too_large([elements, most], period, kept))
}

/// The error for waves that need a grid of `elements` elements where `most` are allowed. `kept` are the largest numbers of
/// waves along the periods \[m] that fit; `None` if not even one wave does.
fn too_large([elements, most]: [f64; 2], period: [f64; 2], kept: Option<[usize; 2]>) -> SceneError {
    let Some(numbers) = kept else {
        let problem = format!(
            "the largest grid that it allows a periodic surface has {most} elements, too few for an error bar with any waves"
        );
        return SceneError::at("solve.max_memory", problem);
    };
    let wavelengths = [0, 1].map(|axis| period[axis] / numbers[axis] as f64);
    let shortest = wavelengths
        .into_iter()
        .filter(|length| length.is_finite())
        .fold(0.0, f64::max);
    let [x, y] = numbers.map(|number| 2 * number + 1);
    let problem = format!(
        "the shortest waves need a grid of {elements:.3e} elements for an error bar, and the memory allowed is for {most:.3e}: leave \
         out waves shorter than shortest_wavelength = {shortest:e} m, or give a larger solve.max_memory; a map of at most {x} × {y} heights may keep all of its waves"
    );
    SceneError::at("indenter", problem)
}

/// Key to change and advice in the message about too much memory, if the method chooses the number of elements.
const CHOSEN_BY_METHOD: [&str; 2] = ["solve.max_memory", "another method"];

/// Rejects a grid of `elements` elements along the contact if it exceeds the memory limit or the largest number of time steps.
/// `key` is the key to change, `finer` the advice.
fn check_grid(
    problem: &Problem,
    method: Method,
    elements: usize,
    [key, finer]: [&'static str; 2],
) -> Result<()> {
    let Some((needed, allowed)) =
        memory_needed(problem, method, elements)?.zip(problem.max_memory())
    else {
        return Ok(());
    };
    if needed <= allowed as f64 {
        return Ok(());
    }
    problem.set_short_of_memory();
    let shorter = match method {
        BemTransient | MdrTransient => ", a shorter sliding_distance",
        _ => "",
    };
    let [needed, allowed] = [needed, allowed as f64].map(binary_size);
    let problem = format!(
        "{} needs up to {needed} of memory for {elements} elements along the contact, and max_memory allows {allowed}; \
         give {finer}{shorter} or a larger max_memory",
        method.name()
    );
    Err(SceneError::at(key, problem).into())
}

/// Progress that stops a refinement before a grid exceeds [`Problem::max_memory`] or the largest number of time steps.
#[derive(Debug)]
pub(super) struct Limited<'a> {
    problem: &'a Problem,
    method: Method,
    watch: &'a dyn Progress,
    refused: OnceLock<SolveError>,
}

impl<'a> Limited<'a> {
    /// Wraps the progress of the caller; nothing is refused yet.
    pub(super) const fn new(problem: &'a Problem, method: Method, watch: &'a dyn Progress) -> Self {
        Self {
            problem,
            method,
            watch,
            refused: OnceLock::new(),
        }
    }

    /// Adds the refusal of the next grid, if there was one, to the error of the method.
    pub(super) fn or_memory(self, reached: SolveError) -> SolveError {
        match self.refused.into_inner() {
            Some(refused) => SolveError::MemoryReached {
                reached: Box::new(reached),
                refused: Box::new(refused),
            },
            None => reached,
        }
    }
}

impl Progress for Limited<'_> {
    fn may_refine(&self, elements: usize) -> bool {
        let fits = check_grid(self.problem, self.method, elements, CHOSEN_BY_METHOD)
            .map_err(|refused| drop(self.refused.set(refused)));
        fits.is_ok() && self.watch.may_refine(elements)
    }

    fn report(&self, fraction: f64) {
        self.watch.report(fraction);
    }
}

/// Memory needed by a grid of `elements` elements along the contact, \[bytes]; `None` for methods without a memory estimate.
///
/// # Errors
/// Those of the method that do not need a solution, such as a parameter out of range.
pub(super) fn memory_needed(
    problem: &Problem,
    method: Method,
    elements: usize,
) -> Result<Option<f64>> {
    let elastomer = problem.elastomer()?;
    if let Body::Periodic(surface) = problem.body() {
        let needed = match problem.motion() {
            Moving(load) => periodic::move_along_memory(surface, &elastomer, load, elements),
            _ => periodic::memory(surface, elements),
        };
        return Ok(Some(needed?));
    }
    let Some(surface) = problem.body().surface() else {
        return Ok(None);
    };
    let (material, line) = (problem.material(), surface.as_axisymmetric());
    Ok(Some(match (method, problem.motion(), line) {
        (BemSteady, Sliding(load), _) => steady_memory(surface, &elastomer, load, elements)?,
        (BemTransient, Sliding(load), _) => slide_memory(surface, &elastomer, load, elements)?,
        (BemTransient, Pressing(load), _) => indent_memory(surface, &elastomer, load, elements)?,
        (BemTransient, History { points, .. }, _) => {
            indent_along_memory(surface, &elastomer, points, elements)?
        }
        (BemTransient, Moving(load), _) => move_along_memory(surface, &elastomer, load, elements)?,
        (MdrTransient, Sliding(load), Some(body)) => {
            mdr_core::slide_memory(&EquivalentLine(body), material, load, elements)?
        }
        (MdrTransient, Moving(load), Some(body)) => {
            mdr_core::move_along_memory(&EquivalentLine(body), material, load, elements)?
        }
        _ => return Ok(None),
    }))
}

/// A memory size \[bytes] as text in binary units, such as "1.5 GiB".
fn binary_size(bytes: f64) -> String {
    if bytes >= 2.0_f64.powi(60) {
        return "more than an exbibyte".to_owned();
    }
    let mut units = [(30, "GiB"), (20, "MiB"), (10, "KiB")].into_iter();
    let unit = units.find(|(power, _)| bytes >= 2.0_f64.powi(*power));
    let (power, unit) = unit.unwrap_or((0, "B"));
    let size = 2.0_f64.powi(power);
    format!("{:.1} {unit}", bytes / size)
}
