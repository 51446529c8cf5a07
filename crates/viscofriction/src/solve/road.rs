//! A rough surface without its shortest waves, octave by octave.

use numerics::Progress;

use super::answer::{Answer, Persson};
use super::body::Body;
use super::error::{Result, SolveError};
use super::plan::plan;
use super::problem::Problem;
use crate::scene::SceneError;

/// A surface without the waves shorter than a length.
#[derive(Debug)]
pub struct CutOff {
    /// Waves shorter than this are left out, \[m].
    pub shortest_wavelength: f64,
    /// Root mean square slope of what is left; of random surfaces that of the first.
    pub rms_slope: f64,
    /// What it answers.
    pub answer: Result<Answer>,
}

impl CutOff {
    /// The answer, or what was reached of it.
    pub fn known(&self) -> Option<&Answer> {
        self.answer.as_ref().map_or_else(SolveError::reached, Some)
    }

    /// Persson's theory of what is left.
    pub fn persson(&self) -> Option<Persson> {
        self.known()?.rough?.persson
    }

    /// What the waves that are left out add to the friction by Persson's theory of 2006, times what was solved of those that are not
    /// over what it says of them: it knows how friction grows with the waves better than how large it is. `all` is the same surface
    /// with all its waves.
    pub fn still_to_come(&self, all: &Self) -> Option<f64> {
        let theory = |one: &Self| one.persson().map(|one| one.friction_coefficient_2006);
        let (all, left) = (theory(all)?, theory(self)?);
        let solved = self.known()?.friction_coefficient?.value;
        // Waves that rub nothing leave nothing to scale.
        (left > 0.0).then(|| (all - left) * solved / left)
    }
}

/// Solves a rough surface with all its waves, then without those shorter than twice the shortest, four times and so on, so many times
/// at most, as long as waves are left; `done` is told how many are solved.
///
/// # Errors
/// [`SceneError`] for a body that is no sum of waves.
pub fn cut_offs(
    mut problem: Problem,
    count: usize,
    watch: &dyn Progress,
    mut done: impl FnMut(&CutOff),
) -> Result<Vec<CutOff>, SceneError> {
    let mut found = Vec::new();
    let first = match problem.body() {
        Body::Periodic(surface) => surface.shortest_wavelength(),
        _ => 0.0,
    };
    let mut shortest_wavelength = first;
    problem = problem.without_waves_below(first)?;
    loop {
        let rms_slope = match problem.body() {
            Body::Periodic(surface) => surface.rms_slope(),
            _ => f64::NAN,
        };
        let answer = plan(&problem).map_err(SolveError::from);
        let cut_off = CutOff {
            shortest_wavelength,
            rms_slope,
            answer: answer.and_then(|plan| plan.solve(watch)),
        };
        done(&cut_off);
        found.push(cut_off);
        shortest_wavelength *= 2.0;
        match problem.without_waves_below(shortest_wavelength) {
            Ok(coarser) if found.len() < count => problem = coarser,
            _ => return Ok(found),
        }
    }
}
