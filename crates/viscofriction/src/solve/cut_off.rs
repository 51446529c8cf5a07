//! Sensitivity of an answer to the shortest waves of a rough surface.

use bem_halfspace::{BemError, PeriodicEstimate, PeriodicSliding, Reached};
use indenters::rough::PeriodicSurface;
use numerics::{Accuracy, CappedProgress, Estimate, Request};
use serde::Serialize;
use serde::ser::{SerializeMap as _, Serializer};

use super::answer::Answer;
use super::warning::Warning;
use crate::quantity::ByQuantity;

/// Relative change of friction or area by the shortest octave of the waves, above which a warning is given. Chosen: it is
/// well above the error bars, and each further octave may change the answer as much.
const MAX_CHANGE: f64 = 0.1;
/// Smallest relative error requested of the answer without the shortest octave of the waves. Chosen: well below the change
/// [`MAX_CHANGE`] to detect.
const MIN_RELATIVE_ERROR: f64 = 0.03;

/// The answer without the shortest octave, the waves shorter than twice the shortest wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WithoutShortestOctave {
    /// Friction coefficient; `None` if nothing slides.
    pub friction_coefficient: Option<Estimate>,
    /// Contact area as a fraction of the period.
    pub area_fraction: Estimate,
    /// Root mean square slope of the remaining surface.
    pub rms_slope: f64,
}

impl WithoutShortestOctave {
    /// Solves without the shortest octave, to the requested relative error but at least [`MIN_RELATIVE_ERROR`]. No grid has more
    /// elements along an edge than the `finest` grid of the answer itself. `None` if no wave remains or the solution fails.
    pub(super) fn of(
        surface: &PeriodicSurface,
        request: Request,
        finest: [usize; 2],
        solve: impl FnOnce(
            &PeriodicSurface,
            Request,
        ) -> Result<PeriodicEstimate<PeriodicSliding>, BemError>,
    ) -> Option<Self> {
        let left = surface.without_shortest_octave()?;
        let relative_error = match request.accuracy {
            Accuracy::RelativeError(error) => error.max(MIN_RELATIVE_ERROR),
            Accuracy::Elements(_) => MIN_RELATIVE_ERROR,
        };
        let request = Request {
            accuracy: relative_error.into(),
            watch: &CappedProgress {
                watch: request.watch,
                max_elements: finest[0].max(finest[1]),
            },
        };
        let found = match solve(&left, request) {
            Ok(found) => found,
            // Use a solution that misses the requested error too, because it still states a valid error.
            Err(BemError::NotReached { reached, .. }) => match *reached {
                Reached::Periodic(found) => found,
                _ => return None,
            },
            Err(_) => return None,
        };
        Some(Self {
            friction_coefficient: Some(found.friction_coefficient),
            area_fraction: found.area_fraction,
            rms_slope: left.rms_slope(),
        })
    }

    /// Fraction of the friction due to the shortest octave; negative if the octave reduces friction, `None` without friction.
    pub(super) fn share(&self, friction: Option<Estimate>) -> Option<f64> {
        let (friction, without) = (friction?, self.friction_coefficient?);
        (friction.value > 0.0).then(|| 1.0 - without.value / friction.value)
    }

    /// A warning if friction or area without the octave differs by more than [`MAX_CHANGE`], and by more than both error
    /// estimates. `slope` is the rms slope of the whole surface.
    pub(super) fn warning(&self, answer: &Answer, slope: f64) -> Option<Warning> {
        // Pair the friction coefficient, and the area fraction, of the whole surface with that of the surface without its
        // shortest octave.
        let changes = [
            answer.friction_coefficient.zip(self.friction_coefficient),
            answer.area_fraction.map(|area| (area, self.area_fraction)),
        ]
        .map(|change| change.filter(|(with, _)| with.value > 0.0));
        let matters = |(with, without): (Estimate, Estimate)| {
            let change = (with.value - without.value).abs();
            change > MAX_CHANGE * with.value && change > with.error + without.error
        };
        if !changes.into_iter().flatten().any(matters) {
            return None;
        }
        let factor = |(with, without): (Estimate, Estimate)| without.value / with.value;
        let [friction_factor, area_factor] = changes.map(|change| change.map(factor));
        // Compute the rms slope of the octave itself: mean square slopes add up over waves, so it is the root of a difference of
        // squares.
        let octave = ((slope + self.rms_slope) * (slope - self.rms_slope))
            .max(0.0)
            .sqrt();
        Some(Warning::ShortestWaves {
            relative_slope: octave / slope,
            friction_factor,
            area_factor,
        })
    }
}

impl Serialize for WithoutShortestOctave {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        let known = ByQuantity::new(|quantity| match quantity.key {
            "friction_coefficient" => self.friction_coefficient,
            "area_fraction" => Some(self.area_fraction),
            _ => None,
        });
        known.serialize_into(&mut map)?;
        map.serialize_entry("rms_slope", &self.rms_slope)?;
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use indenters::rough::Wave;

    use super::*;

    #[test]
    fn no_finer_grid_is_begun_than_the_answer_has() {
        let wave = |number| Wave {
            numbers: [number, 0],
            amplitude: 1e-3,
            phase: 0.0,
        };
        let surface = PeriodicSurface::new([1.0; 2], vec![wave(1), wave(4)]).expect("a surface");
        let mut asked = Vec::new();
        let request = Accuracy::Elements(128).into();
        let without = WithoutShortestOctave::of(&surface, request, [128, 64], |left, request| {
            assert_eq!(left.waves().len(), 1);
            asked.extend([64, 128, 129].map(|elements| request.watch.may_refine(elements)));
            Err(BemError::FlowsUnderWaves)
        });
        assert_eq!((without, asked), (None, vec![true, true, false]));
    }
}
