//! Cut-off series: a rough surface without its shortest waves, octave by octave.

use numerics::Progress;

use super::answer::{Answer, Persson};
use super::body::Body;
use super::error::{Result, SolveError};
use super::plan::plan;
use super::problem::Problem;
use crate::scene::SceneError;

/// One member of the cut-off series.
#[derive(Debug)]
pub struct CutOff {
    /// Cut-off wavelength: shorter waves are left out, \[m].
    pub shortest_wavelength: f64,
    /// Root mean square slope of the remaining surface; for random surfaces that of the first.
    pub rms_slope: f64,
    /// The answer for the remaining surface.
    pub answer: Result<Answer>,
}

impl CutOff {
    /// The answer, also one that does not meet the request.
    pub fn known(&self) -> Option<&Answer> {
        self.answer.as_ref().map_or_else(SolveError::reached, Some)
    }

    /// Persson's theory for the remaining waves; `None` if it does not apply.
    pub fn persson(&self) -> Option<Persson> {
        self.known()?.persson
    }

    /// Estimated hysteresis of the omitted waves: their friction in Persson's theory (2006), scaled by the ratio of solved to
    /// theoretical friction of the remaining waves. The theory predicts the growth of friction better than its magnitude.
    /// `all` is the surface with all its waves.
    pub fn still_to_come(&self, all: &Self) -> Option<f64> {
        let theory = |one: &Self| one.persson().map(|one| one.friction_coefficient_2006);
        let (all, left) = (theory(all)?, theory(self)?);
        // The theory is one of hysteresis: leave out the shear of the contact.
        let solved = self.known()?.hysteresis()?.value;
        // If the remaining waves cause no friction, the ratio is not defined, and nothing is returned.
        (left > 0.0).then(|| (all - left) * solved / left)
    }
}

/// Solves a rough surface with all its waves, then without those shorter than 2, 4, 8, … times the shortest, up to `count`
/// surfaces or until no wave remains. `done` receives each result.
///
/// # Errors
/// [`SceneError`] for a body that is not a sum of waves.
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
    // This call removes no wave; it brings the body of the first row into the same form as those of the others, or refuses it.
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
