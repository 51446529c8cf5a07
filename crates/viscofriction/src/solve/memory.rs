//! The memory that a method needs, known before each of its grids.

use std::sync::OnceLock;

use bem_halfspace::indent::{indent_along_memory, indent_memory};
use bem_halfspace::{move_along_memory, periodic, slide::slide_memory, steady::steady_memory};
use indenters::EquivalentLine;
use indenters::rough::PeriodicSurface;
use numerics::{FIRST_ELEMENTS, Watch};

use super::body::Body;
use super::error::SolveError;
use super::problem::Motion::{History, Moving, Pressing, Sliding};
use super::problem::Problem;
use crate::scene::Method::{self, BemSteady, BemTransient, MdrTransient};
use crate::scene::{Accuracy, SceneError};

/// Refuses a method that needs more memory than is allowed, also for the grids that the shortest waves of a periodic surface need.
pub(super) fn check_memory(problem: &Problem, method: Method) -> Result<(), SceneError> {
    let (elements, change) = match (problem.accuracy(), problem.body(), problem.motion()) {
        (Accuracy::Elements(elements), ..) => (elements, ["solve.elements", "fewer elements"]),
        (_, Body::Periodic(surface), Moving(_)) => {
            let change = ["solve.max_memory", "a longer shortest_wavelength"];
            (periodic::elements_of_motion(surface), change)
        }
        (_, Body::Periodic(surface), _) => return check_waves(problem, surface),
        _ => (FIRST_ELEMENTS, OTHERWISE),
    };
    check(problem, method, elements, change)
}

/// Refuses waves for which even the coarsest grids with error bars are too large.
fn check_waves(problem: &Problem, surface: &PeriodicSurface) -> Result<(), SceneError> {
    let most = periodic::largest_grid(problem.max_memory().map(|bytes| bytes as f64));
    let elements = periodic::elements_for_bars(surface);
    if elements <= most {
        return Ok(());
    }
    let largest = surface.largest_numbers();
    let shapes = (1..usize::BITS).map(|power| largest.map(|number| ((2 * number) >> power).max(1)));
    let told = |shape| surface.told_by(shape);
    let mut told = shapes.filter_map(told);
    let Some(kept) = told.find(|kept| periodic::elements_for_bars(kept) <= most) else {
        let problem = format!(
            "the largest grid that it allows a periodic surface has {most} elements, too few for an error bar with any waves"
        );
        return Err(SceneError::at("solve.max_memory", problem));
    };
    let numbers = kept.largest_numbers();
    let wavelengths = [0, 1].map(|axis| surface.period()[axis] / numbers[axis] as f64);
    let wavelengths = wavelengths.into_iter().filter(|length| length.is_finite());
    let shortest = wavelengths.fold(0.0, f64::max);
    let [x, y] = numbers.map(|number| 2 * number + 1);
    let problem = format!(
        "the shortest waves need a grid of {elements:.3e} elements for an error bar, and the memory allowed is for {most:.3e}: leave \
         out waves shorter than shortest_wavelength = {shortest:e} m, or give a larger solve.max_memory; a map of at most {x} × {y} heights may keep all of its waves"
    );
    Err(SceneError::at("indenter", problem))
}

/// The key, and what to give, where the number of elements is not given.
const OTHERWISE: [&str; 2] = ["solve.max_memory", "another method"];

fn check(
    problem: &Problem,
    method: Method,
    elements: usize,
    [key, finer]: [&'static str; 2],
) -> Result<(), SceneError> {
    let Some((needed, allowed)) = needed(problem, method, elements).zip(problem.max_memory())
    else {
        return Ok(());
    };
    if needed <= allowed as f64 {
        return Ok(());
    }
    let shorter = match method {
        BemTransient | MdrTransient => ", a shorter sliding_distance",
        _ => "",
    };
    let [needed, allowed] = [needed, allowed as f64].map(written);
    let problem = format!(
        "{} needs up to {needed} of memory for {elements} elements along the contact, and max_memory allows {allowed}; \
         give {finer}{shorter} or a larger max_memory",
        method.name()
    );
    Err(SceneError::at(key, problem))
}

/// Ends a refinement before a grid that needs more memory than [`Problem::max_memory`].
#[derive(Debug)]
pub(super) struct Limited<'a> {
    problem: &'a Problem,
    method: Method,
    watch: &'a dyn Watch,
    refused: OnceLock<SceneError>,
}

impl<'a> Limited<'a> {
    pub(super) const fn new(problem: &'a Problem, method: Method, watch: &'a dyn Watch) -> Self {
        Self {
            problem,
            method,
            watch,
            refused: OnceLock::new(),
        }
    }

    /// What was reached, and why no more.
    pub(super) fn or_memory(self, reached: SolveError) -> SolveError {
        match self.refused.into_inner() {
            Some(refused) => SolveError::MemoryReached {
                reached: Box::new(reached),
                refused,
            },
            None => reached,
        }
    }
}

impl Watch for Limited<'_> {
    fn allows(&self, elements: usize) -> bool {
        let fits = check(self.problem, self.method, elements, OTHERWISE);
        let fits = fits.map_err(|refused| drop(self.refused.set(refused)));
        fits.is_ok() && self.watch.allows(elements)
    }

    fn done(&self, part: f64) {
        self.watch.done(part);
    }
}

/// Of methods that march or have elements, \[bytes]; none of the others, and where the problem is refused anyway.
pub(super) fn needed(problem: &Problem, method: Method, elements: usize) -> Option<f64> {
    let elastomer = problem.elastomer().ok()?;
    if let Body::Periodic(surface) = problem.body() {
        let needed = match problem.moving() {
            Some(load) => periodic::move_along_memory(surface, &elastomer, load, elements),
            None => periodic::memory(surface, elements),
        };
        return needed.ok();
    }
    let surface = problem.body().surface()?;
    match (method, problem.motion()) {
        (BemSteady, Sliding(load)) => steady_memory(surface, &elastomer, &load, elements).ok(),
        (BemTransient, Sliding(load)) => slide_memory(surface, &elastomer, &load, elements).ok(),
        (BemTransient, Pressing(load)) => indent_memory(surface, &elastomer, &load, elements).ok(),
        (BemTransient, History(_)) => {
            indent_along_memory(surface, &elastomer, problem.history(), elements).ok()
        }
        (MdrTransient, Sliding(load)) => {
            let line = EquivalentLine(surface.as_axisymmetric()?);
            mdr_core::slide_memory(&line, problem.material(), &load, elements).ok()
        }
        (BemTransient, Moving(_)) => {
            move_along_memory(surface, &elastomer, problem.moving()?, elements).ok()
        }
        (MdrTransient, Moving(_)) => {
            let line = EquivalentLine(surface.as_axisymmetric()?);
            mdr_core::move_along_memory(&line, problem.material(), problem.moving()?, elements).ok()
        }
        _ => None,
    }
}

fn written(bytes: f64) -> String {
    if bytes >= 2.0_f64.powi(60) {
        return "more than an exbibyte".to_owned();
    }
    let mut units = [(30, "GiB"), (20, "MiB"), (10, "KiB")].into_iter();
    let unit = units.find(|(power, _)| bytes >= 2.0_f64.powi(*power));
    let (power, unit) = unit.unwrap_or((0, "B"));
    let size = 2.0_f64.powi(power);
    format!("{:.1} {unit}", bytes / size)
}
