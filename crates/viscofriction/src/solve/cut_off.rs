//! Whether an answer depends on where the waves of a rough surface were cut off.

use bem_halfspace::{BemError, PeriodicEstimate, PeriodicSliding, Reached};
use indenters::rough::PeriodicSurface;
use numerics::{Accuracy, CappedProgress, Estimate, Request};
use serde::Serialize;
use serde::ser::{SerializeMap as _, Serializer};

use super::answer::RoughAnswer;

/// Relative change of friction, area and slope by the shortest octave above which they are not converged in the cut-off.
const MOST: f64 = 0.1;
/// Least relative error of the answer without the octave: it need only tell whether that matters.
const RELATIVE_ERROR: f64 = 0.03;

/// The answer without the waves of the shortest octave, those shorter than twice the shortest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WithoutShortestOctave {
    /// None where nothing slides.
    pub friction_coefficient: Option<Estimate>,
    /// Part of the period in contact.
    pub area_fraction: Estimate,
    /// Root mean square slope of the surface.
    pub rms_slope: f64,
}

impl WithoutShortestOctave {
    /// Solves to the relative error asked for, or a larger one, on no more elements along an edge than the `finest` grid of the
    /// answer itself has; none where no wave or no answer is left.
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
            Accuracy::RelativeError(error) => error.max(RELATIVE_ERROR),
            Accuracy::Elements(_) => RELATIVE_ERROR,
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

    /// The part of the friction that comes from the shortest octave; below 0 where it takes some away, and none where nothing
    /// rubs.
    pub(super) fn share(&self, friction: Option<Estimate>) -> Option<f64> {
        let (friction, without) = (friction?, self.friction_coefficient?);
        (friction.value > 0.0).then(|| 1.0 - without.value / friction.value)
    }

    /// A sentence where friction or area changes by more than bars explain.
    pub(super) fn warning(
        &self,
        friction: Option<Estimate>,
        rough: RoughAnswer,
        slope: f64,
    ) -> Option<String> {
        let changes = [
            ("the friction", friction, self.friction_coefficient),
            (
                "the area",
                Some(rough.area_fraction),
                Some(self.area_fraction),
            ),
        ];
        let known = changes
            .into_iter()
            .filter_map(|(name, with, without)| Some((name, with?, without?)));
        let known: Vec<(&str, Estimate, Estimate)> =
            known.filter(|(_, with, _)| with.value > 0.0).collect();
        let matters = |(_, with, without): &(&str, Estimate, Estimate)| {
            let change = (with.value - without.value).abs();
            change > MOST * with.value && change > with.error + without.error
        };
        if !known.iter().any(matters) {
            return None;
        }
        let changes = known.iter().map(|(name, with, without)| {
            format!(
                "{name} would be {:.2} times as large",
                without.value / with.value
            )
        });
        let changes: Vec<String> = changes.collect();
        // Squares of slopes add up over waves.
        let octave = ((slope + self.rms_slope) * (slope - self.rms_slope))
            .max(0.0)
            .sqrt();
        Some(format!(
            "the answer depends on the shortest waves that were kept: without the shortest octave, whose own root mean square \
             slope is {:.0} % of that of all waves, {}",
            100.0 * octave / slope,
            changes.join(" and ")
        ))
    }
}

impl Serialize for WithoutShortestOctave {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        let area = Some(self.area_fraction);
        for (name, known) in [
            ("friction_coefficient", self.friction_coefficient),
            ("area_fraction", area),
        ] {
            if let Some(known) = known {
                map.serialize_entry(name, &known.value)?;
                map.serialize_entry(&format!("{name}_error"), &known.error)?;
            }
        }
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
