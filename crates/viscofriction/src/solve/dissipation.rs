//! Origin of the power dissipated in a stationary state.

use bem_halfspace::line_spectrum;
use friction_analytic::{ElasticContact, slow_sliding_spectrum};
use rheology::{OutsideWindow, StationaryCreep, StressBand};
use serde::ser::{Serialize, Serializer};

use super::answer::Answer;
use super::body::Body;
use super::problem::{Motion, Problem};
use crate::scene::Model;

/// Fractions of the dissipated power, equal to those of the friction; `None` if not known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dissipation {
    /// Fraction from frequencies at which the material was not measured.
    pub outside_window: Option<f64>,
    /// Fraction from frequencies below the measured window.
    pub below_window: Option<f64>,
    /// Fraction from frequencies above the measured window.
    pub above_window: Option<f64>,
    /// Fraction lost without the shortest octave of a rough surface; negative if friction is larger without it.
    pub shortest_octave: Option<f64>,
}

/// Fraction of the friction that comes from outside the measured frequencies, above which a warning is given. Chosen:
/// extrapolated moduli may be wrong by their own size, and the friction then by a tenth.
const MAX_EXTRAPOLATED_FRACTION: f64 = 0.1;

impl Dissipation {
    /// Whether the fraction of the friction from outside the measured frequencies is so large that the answer has a warning.
    pub fn is_extrapolated(&self) -> bool {
        let outside = self.outside_window;
        outside.is_some_and(|fraction| fraction > MAX_EXTRAPOLATED_FRACTION)
    }

    /// The fractions by their names in JSON; the CSV prefixes them with `dissipation_`.
    pub(super) const fn shares(&self) -> [(&'static str, Option<f64>); 4] {
        [
            ("outside_window", self.outside_window),
            ("below_window", self.below_window),
            ("above_window", self.above_window),
            ("shortest_octave", self.shortest_octave),
        ]
    }
}

impl Serialize for Dissipation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let known = self.shares().into_iter();
        serializer.collect_map(known.filter_map(|(name, share)| Some((name, share?))))
    }
}

/// Fractions of the friction of an answer outside the measured frequencies and in the shortest octave of waves; `None` where
/// they
/// are not known.
pub(super) fn dissipation(problem: &Problem, answer: &Answer) -> Dissipation {
    let outside = outside_window(problem, answer);
    let without = answer.without_shortest_octave;
    Dissipation {
        outside_window: outside.map(|parts| parts.below + parts.above),
        below_window: outside.map(|parts| parts.below),
        above_window: outside.map(|parts| parts.above),
        shortest_octave: without.and_then(|without| without.share(answer.friction_coefficient)),
    }
}

/// Fractions of the dissipated power below and above the measured frequencies, for sliding at constant speed v, where a wave of
/// wave number q along x has the frequency v q. A march from rest is treated as stationary at its end. `None` for other motions
/// and without measured frequencies.
fn outside_window(problem: &Problem, answer: &Answer) -> Option<OutsideWindow> {
    let (Some(window), Motion::Sliding(load)) = (problem.window(), problem.motion()) else {
        return None;
    };
    // On a track the waves of the pressure are harmonics of its length, which this spectrum does not represent.
    if problem.track().is_some() {
        return None;
    }
    let velocity = load.velocity();
    let creep = StationaryCreep::new(problem.material(), problem.modulus_factors()).ok()?;
    if answer.model == Model::Line {
        // Every element of the Winkler foundation has the same compliance, whatever the wavelength.
        let bands = creep
            .retarded()
            .bands_along(&answer.fields.line_load, velocity, |_| 1.0);
        return creep.outside_window(window, bands);
    }
    creep.outside_window(window, stress_spectrum(problem, answer, velocity)?)
}

/// Frequency spectrum of the moving pressure on the half space or layer, in bands of angular frequency, for a velocity \[m/s].
/// `None` if the answer has no pressure field and no contact from which one follows.
fn stress_spectrum(problem: &Problem, answer: &Answer, velocity: f64) -> Option<Vec<StressBand>> {
    let elastomer = problem.elastomer().ok()?;
    let fields = &answer.fields;
    match (problem.body(), &fields.pressure, &answer.contact_box) {
        (Body::Periodic(_), Some(pressure), _) => {
            Some(pressure.periodic_spectrum(&elastomer, velocity))
        }
        (_, Some(pressure), _) => Some(pressure.spectrum(&elastomer, velocity)),
        (Body::Cylinder(_), None, _) => {
            Some(line_spectrum(&fields.line_pressure, &elastomer, velocity))
        }
        (Body::Revolution(body), None, Some(contact)) => {
            let contact_radius = contact.x[1];
            let contact = ElasticContact {
                contact_radius,
                velocity,
            };
            Some(slow_sliding_spectrum(&**body, contact))
        }
        _ => None,
    }
}
