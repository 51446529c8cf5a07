//! Propagation of the modulus error of an approximating Prony series into all error estimates.

use numerics::{Estimate, ValueWithError};

use super::answer::Answer;
use super::body::Body;
use super::curve::{AREA, DEPTH, FORCE};
use super::error::{Result, SolveError};
use super::expansion::Expansion;
use super::problem::{Motion, Problem};
use super::validity::mean_slope;
use crate::quantity::{QUANTITIES, Quantity, Unit};
use crate::scene::{Accuracy, Method, Model};

/// Fraction of the requested relative error that is requested of the method if a Prony series approximates the material. Chosen;
/// the rest is left for the error of the series.
const SOLVER_ERROR_SHARE: f64 = 0.95;
/// Bound of the ratio of the relative change of a quantity to the relative change of the moduli. Chosen: twice the largest
/// known ratio. A force at a given depth is proportional to the moduli. Under a given force depth and radius change less,
/// area and peak pressure at most twice as much.
pub(super) const MODULUS_ERROR_AMPLIFICATION: f64 = 4.0;

impl Problem {
    /// Relative error of the moduli; 0 if the material is exact.
    pub(crate) fn modulus_error(&self) -> f64 {
        self.expansion()
            .map_or(0.0, |expansion| expansion.relative_error)
    }

    /// Accuracy requested of the method: [`SOLVER_ERROR_SHARE`] of the relative error asked for if a series approximates the
    /// material, else that of the problem.
    pub(crate) fn solver_accuracy(&self) -> Accuracy {
        match self.accuracy() {
            Accuracy::RelativeError(error) if self.expansion().is_some() => {
                Accuracy::RelativeError(SOLVER_ERROR_SHARE * error)
            }
            other => other,
        }
    }

    /// Adds the error of the moduli to the error estimates; an error if the contact needs times outside the range of the series.
    pub(crate) fn with_modulus_error(&self, answer: Answer) -> Result<Answer> {
        let without = answer.requested_quantity().error;
        let mut answer = self.with_wider_bars(answer)?;
        let part = answer.requested_quantity().error - without;
        if part > 0.0 {
            answer.error_parts.material = Some(part);
        }
        Ok(answer)
    }

    /// Widens the error estimates by the error of the moduli.
    fn with_wider_bars(&self, answer: Answer) -> Result<Answer> {
        let Some(expansion) = self.expansion() else {
            return Ok(answer);
        };
        self.check_times(&answer, expansion.time_range)?;
        let relative = MODULUS_ERROR_AMPLIFICATION * expansion.relative_error;
        if let Motion::History { .. } = self.motion() {
            return Ok(match answer.method {
                Method::BemTransient => answer.curve_widened(relative),
                // Answers of the one-dimensional model remain as they are, because they include the modulus error already.
                _ => answer,
            });
        }
        let slope = mean_slope(self.body(), &answer).unwrap_or(0.0);
        let mut widened = answer.widened(relative, slope);
        if widened.model == Model::HalfSpace && matches!(self.motion(), Motion::Sliding(_)) {
            // State no depth, because far from a sliding contact the surface subsides by creep at times beyond every range.
            widened.indentation_depth = None;
        }
        self.with_long_waves(widened, &expansion)
    }

    /// Widens the error of the friction of a line contact by the fraction from waves slower than the creep of the series
    /// ([`Expansion::slow_wave_fraction`]). An error if this fraction exceeds the requested relative error.
    fn with_long_waves(&self, mut answer: Answer, expansion: &Expansion) -> Result<Answer> {
        let (Body::Cylinder(_), Motion::Sliding(load)) = (self.body(), self.motion()) else {
            return Ok(answer);
        };
        let contact = answer.contact_box.as_ref();
        let length = contact.map_or(0.0, |contact| contact.x[1] - contact.x[0]);
        // If only waves longer than the thickness of a layer are slower than the series, leave the error: they cause negligible
        // displacement.
        if self.thickness() < expansion.creeps_until * load.velocity() {
            return Ok(answer);
        }
        let part = expansion.slow_wave_fraction(length / load.velocity());
        if let Accuracy::RelativeError(asked) = self.accuracy()
            && part > asked
        {
            let longest = expansion.time_range[1];
            return Err(SolveError::BeyondTimeRange {
                part: part.min(1.0),
                asked,
                longest,
            });
        }
        answer.friction_coefficient = answer
            .friction_coefficient
            .map(|friction| friction.widened(part * friction.value.abs()));
        Ok(answer)
    }

    /// An error if the total error exceeds the requested one; `None` for a history and for an exact material.
    pub(crate) fn missed(&self, answer: &Answer) -> Option<SolveError> {
        let ValueWithError { value, error } = *answer.requested_quantity();
        let series = self.expansion()?.relative_error;
        match self.accuracy() {
            Accuracy::RelativeError(asked)
                if !matches!(self.motion(), Motion::History { .. })
                    && error > asked * value.abs() =>
            {
                Some(SolveError::SeriesTooCoarse {
                    asked,
                    series,
                    value,
                    error,
                })
            }
            _ => None,
        }
    }

    /// Rejects a contact whose time scales are outside the time range of the series.
    fn check_times(&self, answer: &Answer, [shortest, longest]: [f64; 2]) -> Result<()> {
        let contact = answer.contact_box.as_ref();
        let length = contact.map(|contact| contact.x[1] - contact.x[0]);
        let times = match self.motion() {
            Motion::Sliding(load) => {
                let lengths = [length, load.sliding_distance()].into_iter().flatten();
                lengths.map(|length| length / load.velocity()).collect()
            }
            Motion::Pressing(_) | Motion::History { .. } | Motion::Moving(_) => self.durations(),
        };
        let is_outside = |time: &f64| !(shortest..=longest).contains(time);
        match times.into_iter().find(is_outside) {
            None => Ok(()),
            Some(time) => Err(SolveError::OutsideTimeRange {
                time,
                shortest,
                longest,
            }),
        }
    }
}

impl Answer {
    /// Widens the errors of all computed quantities by `relative`, the amplified error of the moduli. That of friction is
    /// relative to the mean `slope` in contact, of which friction is a small fraction on a nearly elastic material; that of a
    /// dissipated energy grows in the same ratio.
    fn widened(mut self, relative: f64, slope: f64) -> Self {
        let slope_over_friction = self
            .friction_coefficient
            .map(|known| known.value.abs())
            .filter(|friction| *friction > 0.0)
            .map_or(1.0, |friction| (slope / friction).max(1.0));
        let scale = |quantity: &Quantity, value: f64| match (quantity.is_dissipative, quantity.unit)
        {
            (false, _) => value,
            (true, Unit::NUMBER) => value.max(slope),
            (true, _) => value * slope_over_friction,
        };
        let found = |known: &&mut Estimate| known.error > 0.0; // An error of 0 marks a given quantity.
        for quantity in &QUANTITIES {
            let known = quantity.field.and_then(|field| field(&mut self).as_mut());
            if let Some(known) = known.filter(found) {
                *known = known.widened(relative * scale(quantity, known.value.abs()));
            }
        }
        if self.normal_force.error > 0.0 {
            self.normal_force = self
                .normal_force
                .widened(relative * self.normal_force.value.abs());
        }
        if let Some(contact) = &mut self.contact_box {
            contact.error += relative * (contact.x[1] - contact.x[0]);
        }
        self
    }

    /// Widens the errors at all points of a history by `relative` times the largest value of each quantity; the last point
    /// becomes the answer.
    fn curve_widened(mut self, relative: f64) -> Self {
        let curve = &mut self.fields.curve;
        for column in &mut curve.columns {
            let widened = relative * column.largest();
            let found = column.values.iter_mut().filter(|found| found.error > 0.0);
            found.for_each(|found| *found = found.widened(widened));
        }
        self.normal_force = curve.last(FORCE).unwrap_or(self.normal_force);
        self.indentation_depth = curve.last(DEPTH);
        self.contact_area = curve.last(AREA);
        self
    }
}

#[cfg(test)]
mod tests {
    use rheology::Springpot;

    use super::*;
    use crate::scene::Scene;
    use crate::solve::LINEAR_FRICTION;
    use crate::solve::solve;

    const LOADS: [&str; 5] = [
        "normal_force = 2.0\nvelocity = 0.01\n[solve]\nmodel = \"line\"\nrelative_error = 1e-5",
        "indentation_depth = 1e-5\nvelocity = 0.1\n[solve]\nmodel = \"line\"\nrelative_error = 1e-5",
        "normal_force = 2.0\nvelocity = 0.01\n[solve]\nelements = 24",
        "normal_force = 2.0\nvelocity = 0.0\n[solve]\nduration = 100.0",
        "indentation_depth = 1e-5\nvelocity = 0.0\n[solve]\nduration = 100.0",
    ];

    /// The Prony series of a springpot as a material of its own, and the error that [`MODULUS_ERROR_AMPLIFICATION`] multiplies.
    fn coarse(exponent: f64) -> (String, f64) {
        let element = Springpot::new(1e6, exponent).expect("a springpot");
        let series = element.expand([1e-3, 1e3], 1e-3).expect("a series");
        let branches = series.spectrum.branches().iter().map(|branch| {
            let (modulus, time) = (branch.modulus, branch.relaxation_time);
            format!("{{ modulus = {modulus:e}, relaxation_time = {time:e} }}")
        });
        let branches = branches.collect::<Vec<_>>().join(", ");
        let modulus = series.spectrum.equilibrium_modulus();
        let viscosity = series.spectrum.viscosity();
        let table = format!(
            "prony]\nequilibrium_modulus = {modulus:e}\nviscosity = {viscosity:e}\nbranches = [{branches}]"
        );
        (table, 2.0 * series.relative_error / (1.0 - exponent))
    }

    /// Friction, which may be 0, and all other quantities except the depth in sliding on the half space.
    fn quantities(answer: &Answer) -> (f64, Vec<Estimate>) {
        let slides = answer.friction_coefficient.is_some() && answer.model == Model::HalfSpace;
        let depth = answer.indentation_depth.filter(|_| !slides);
        let found = [
            Some(answer.normal_force),
            depth,
            answer.contact_area,
            answer.peak_pressure,
        ];
        let friction = answer.friction_coefficient.map_or(0.0, |mu| mu.value);
        (friction, found.into_iter().flatten().collect())
    }

    /// Given quantities, with the error 0, stay as they are; friction coefficients have the error of the slope.
    #[test]
    fn every_computed_quantity_has_the_error_of_the_series() {
        let [computed, given] = [Estimate::new(0.25, 1e-9), Estimate::exact(0.25)];
        let mut answer = Answer::new(Method::BemSteady, Model::HalfSpace, computed);
        let fields = || QUANTITIES.iter().filter_map(|quantity| quantity.field);
        fields().for_each(|field| *field(&mut answer) = Some(computed));
        answer.mean_pressure = Some(given);
        let widened = answer.widened(0.01, 0.5);
        assert_eq!(widened.mean_pressure, Some(given), "a given pressure");
        for quantity in QUANTITIES
            .iter()
            .filter(|quantity| !["mean_pressure", LINEAR_FRICTION].contains(&quantity.key))
        {
            let known = (quantity.of)(&widened).expect("a quantity");
            let factor = if quantity.is_dissipative { 2.0 } else { 1.0 };
            let expected = 0.01 * factor * known.value;
            assert!(
                known.error >= expected,
                "{}: {known:?} for {expected}",
                quantity.key
            );
            // Products and quotients of quantities have the errors of both, hence up to twice the expected error.
            assert!(
                known.error < 2.1 * expected,
                "{}: {known:?} for {expected}",
                quantity.key
            );
        }
    }

    /// The creep of long waves under a line contact never ends, so its friction depends on times beyond every range.
    #[test]
    fn the_friction_of_a_line_contact_knows_what_is_beyond_the_range() {
        let answer = |longest: f64, exponent: f64| {
            let text = format!(
                "[indenter.cylinder]\nradius = 1.0\n[material.springpot]\ncoefficient = 1e4\nexponent = {exponent}\n\
                 time_range = [1e-3, {longest:e}]\n[load]\nnormal_force = 50.0\nvelocity = 1.0\n[solve]\n\
                 relative_error = 0.01"
            );
            let scene: Scene = text.parse().expect("a scene");
            solve(&Problem::try_from(&scene).expect("a problem"))
        };
        let friction = |longest, exponent| {
            let answer = answer(longest, exponent).expect("an answer");
            answer.friction_coefficient.expect("a friction")
        };
        let [short, long] = [1.0, 1e4].map(|longest| friction(longest, 0.5));
        let missing = (short.value - long.value).abs();
        let widened = short.error - long.error;
        assert!(missing > 1e-4 * long.value, "{missing}");
        assert!(
            missing < widened && widened < 8.0 * missing,
            "{missing}, {widened}"
        );
        let refused = answer(1.0, 0.9)
            .expect_err("half of it is beyond")
            .to_string();
        assert!(refused.contains("time_range"), "{refused}");
    }

    /// The error of a coarse series changes no answer by more than the modulus error in its error estimate.
    #[test]
    fn bars_hold_the_error_of_a_series() {
        let cases = [0.05, 0.4, 0.9].map(|exponent| LOADS.map(|load| (exponent, load)));
        for (exponent, load) in cases.concat() {
            let answer = |material: &str| {
                let text = format!(
                    "[indenter.sphere]\nradius = 5e-3\n[material.{material}\n[load]\n{load}"
                );
                let scene: Scene = text.parse().expect("a scene");
                let problem = Problem::try_from(&scene).expect("a problem");
                let answer = solve(&problem).expect("an answer");
                let slope = mean_slope(problem.body(), &answer).expect("a slope");
                (quantities(&answer), slope)
            };
            let pot = format!(
                "springpot]\ncoefficient = 1e6\nexponent = {exponent}\ntime_range = [1e-3, 1e3]"
            );
            let (table, error) = coarse(exponent);
            let ((friction, exact), slope) = answer(&pot);
            let ((changed, other), _) = answer(&table);
            let mut changes = vec![(changed - friction).abs() / slope];
            let others = exact.iter().zip(&other);
            changes.extend(others.map(|(a, b)| (b.value / a.value - 1.0).abs()));
            let largest = changes.iter().copied().fold(0.0, f64::max) / error;
            assert!(
                largest < MODULUS_ERROR_AMPLIFICATION && largest > 1e-4,
                "exponent {exponent}, {load}: changes by {largest} times {error:e}; friction first {changes:?}"
            );
        }
    }
}
