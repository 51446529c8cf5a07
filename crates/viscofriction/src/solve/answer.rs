//! The answer of a method: quantities in SI units, each with its error.

use bem_halfspace::GapField;
use bem_halfspace::heat::DepthProfile;
use bem_halfspace::slide::PressureField;
use bem_halfspace::steady::SteadyOptions;
use numerics::{ErrorParts, Estimate, ValueWithError};
use serde::ser::{Serialize, SerializeMap as _, Serializer};

use super::body::Body;
use super::curve::Curve;
use super::cut_off::WithoutShortestOctave;
use super::dissipation::Dissipation;
use super::error::{Result, SolveError};
use super::half_space::Simple;
use super::heat::TemperatureField;
use super::omission::Omission;
use super::problem::{Motion, Problem};
use super::realisations::Ensemble;
use super::sensitivity::{Budget, Sensitivity, SpectralSensitivity};
use super::warning::Warning;
use crate::quantity::{ByQuantity, QUANTITIES, Quantity, scattered};
use crate::scene::{Method, Model};

/// The answer to one problem, in SI units; quantities that the method does not compute are `None`.
///
/// The JSON of an answer is flat: each quantity is followed by its absolute error, for example `friction_coefficient` by
/// `friction_coefficient_error`. The error is 0 for quantities that are given or exact.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Answer {
    /// The method that computed the answer.
    pub method: Method,
    /// The model of the elastomer.
    pub model: Model,
    /// μ = F_h/F_N, for a motion ∫ F_t dx / ∫ F_N |dx|; `None` if nothing slides.
    pub friction_coefficient: Option<Estimate>,
    /// Part of the friction coefficient from the dissipation in the bulk; `None` without an interface, where it is all of it.
    pub friction_from_hysteresis: Option<Estimate>,
    /// Part of the friction coefficient from the shear of the contact area, τ_f A/F_N; `None` without an interface.
    pub friction_from_shear: Option<Estimate>,
    /// Largest |F_t|/F_N during a motion; `None` if the load is not a motion.
    pub peak_friction: Option<Estimate>,
    /// Energy dissipated per cycle of a reciprocating motion, \[J]; `None` for other loads.
    pub dissipated_energy: Option<Estimate>,
    /// Normal force F_N, \[N], or \[N/m] for a cylinder.
    pub normal_force: Estimate,
    /// Depth of the lowest point below the undeformed surface, \[m]; for a periodic surface that of its mean plane.
    /// `None` if it is unbounded or not known, as on a half space under a cylinder or a periodic surface.
    pub indentation_depth: Option<Estimate>,
    /// Parts of the error of the friction coefficient; without sliding, of the depth, or of the force at a given depth.
    pub error_parts: ErrorParts,
    /// Contact area, \[m²], or contact width \[m] for a cylinder; `None` if the method is one-dimensional.
    pub contact_area: Option<Estimate>,
    /// Largest pressure, \[Pa]; `None` if it is not known or grows without limit as the grid is refined.
    pub peak_pressure: Option<Estimate>,
    /// Mean pressure of a periodic surface, \[Pa]; `None` for other bodies. [`normal_force`](Self::normal_force) and
    /// [`contact_area`](Self::contact_area) are those of one period.
    pub mean_pressure: Option<Estimate>,
    /// Contact area as a fraction of the period; `None` if the body is not periodic.
    pub area_fraction: Option<Estimate>,
    /// Friction coefficient of a periodic surface from the power that the material dissipates; `None` if the state is not stationary.
    pub friction_from_dissipation: Option<Estimate>,
    /// Largest rise of the temperature in the contact above that of the surroundings, \[K]; `None` without heat.
    pub largest_temperature_rise: Option<Estimate>,
    /// Mean rise of the temperature over the contact area, \[K]; `None` without heat.
    pub mean_temperature_rise: Option<Estimate>,
    /// Mean rise of the temperature of the material, weighted with the power that it dissipates, \[K]; that of the contact area if it
    /// dissipates none, and `None` without heat.
    pub(crate) dissipation_weighted_rise: Option<Estimate>,
    /// Temperature rise below the surface; `None` without heat and if the material dissipates none.
    pub(crate) temperature_by_depth: Option<DepthProfile>,
    /// Temperature of the material, which is that of the surroundings plus its mean rise in the depth, weighted with the power that it
    /// dissipates, \[°C]; that of the contact area if it dissipates none. The shear strength is that at the mean temperature of the contact
    /// area. `None` if neither depends on the temperature.
    pub effective_temperature: Option<Estimate>,
    /// Temperature of which this state is the fixed point, with the share of the contact area, \[°C].
    pub(crate) fixed_point_temperature: Option<Estimate>,
    /// Largest change of the friction coefficient if material and shear strength have the temperature of the surroundings or the largest
    /// one in the contact; `None` without an effective temperature, and if these temperatures are outside the range of the laws.
    pub temperature_model_spread: Option<Estimate>,
    /// Amplitude of the equivalent strain, weighted with the dissipated power, at which the moduli are; `None` without strain dependence.
    pub strain: Option<Estimate>,
    /// Factor of the storage modulus at this strain.
    pub storage_factor: Option<Estimate>,
    /// Factor of the loss modulus at this strain.
    pub loss_factor: Option<Estimate>,
    /// The answer with the moduli of small strains; `None` without strain dependence.
    pub linear: Option<Box<Self>>,
    /// Persson's theory for the same waves; `None` unless the state is stationary sliding on a half space without a fitted series.
    pub persson: Option<Persson>,
    /// Answer without the shortest octave of a periodic surface; `None` for transients, and if no wave remains.
    pub without_shortest_octave: Option<WithoutShortestOctave>,
    /// Bounding rectangle of the contact; `None` if nothing touches or it is not known.
    pub contact_box: Option<ContactBox>,
    /// Fractions of the dissipated power by their origin.
    pub dissipation: Dissipation,
    /// Number of unknowns: pressures, elements or polynomials; 0 for a closed form.
    pub unknowns: usize,
    /// Iterations or time steps on the finest grid.
    pub iterations: usize,
    /// True if forces and areas are per unit length along y.
    pub is_per_length: bool,
    /// Limits of the validity of the answer.
    pub warnings: Vec<Warning>,
    /// Reason why the request was not met; `None` unless the answer comes from a [`SolveError`].
    pub not_reached: Option<String>,
    /// Physical effects that the model leaves out, from a fixed list of words.
    pub not_modelled: Vec<&'static str>,
    /// Computations that the method could skip for this scene.
    pub left_out: Vec<Omission>,
    /// Derivatives with respect to the numbers of the scene; empty unless [requested](super::with_sensitivity()).
    pub sensitivity: Vec<Sensitivity>,
    /// Derivatives with respect to the modulus at each frequency; `None` unless [requested](super::spectral_sensitivity()).
    pub spectral_sensitivity: Option<SpectralSensitivity>,
    /// The random surfaces that the answer averages; `None` for one surface and for bodies that are not random.
    pub ensemble: Option<Ensemble>,
    /// Uncertainty budget; empty unless it was requested and the scene states uncertainties.
    pub budget: Budget,
    /// Finest boundary-element grid of a body that is not periodic.
    pub(crate) grid: Option<Grid>,
    /// Options of the finest grid of a stationary contact.
    pub(crate) stationary: Option<SteadyOptions>,
    /// Elements along x and y of the finest grid of a periodic surface.
    pub(crate) period_grid: Option<[usize; 2]>,
    /// Fields and histories.
    pub fields: Fields,
}

/// Persson's theory for the waves of a surface, summed exactly.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Persson {
    /// Contact area as a fraction of the period (Persson 2001).
    pub area_fraction: f64,
    /// Contact-area fraction of Xu and others (2024), γ = 0.45, whose pressure distribution is narrower at small contact areas.
    pub area_fraction_xu: f64,
    /// Friction coefficient with S = 1 (Persson 2001).
    pub friction_coefficient: f64,
    /// Friction coefficient with S = (1 + P²)/2 (Persson 2006).
    pub friction_coefficient_2006: f64,
}

impl Persson {
    /// The numbers by their names in JSON; the CSV prefixes them with `persson_`.
    fn named(theory: Option<&Self>) -> [(&'static str, Option<f64>); 4] {
        [
            ("area_fraction", theory.map(|one| one.area_fraction)),
            ("area_fraction_xu", theory.map(|one| one.area_fraction_xu)),
            (
                "friction_coefficient",
                theory.map(|one| one.friction_coefficient),
            ),
            (
                "friction_coefficient_2006",
                theory.map(|one| one.friction_coefficient_2006),
            ),
        ]
    }

    /// Mean over several surfaces; `None` if the theory is missing for one.
    pub(crate) fn mean(theories: impl IntoIterator<Item = Option<Self>>) -> Option<Self> {
        let theories: Vec<Self> = theories.into_iter().collect::<Option<_>>()?;
        let mean =
            |of: fn(&Self) -> f64| theories.iter().map(of).sum::<f64>() / theories.len() as f64;
        Some(Self {
            area_fraction: mean(|one| one.area_fraction),
            area_fraction_xu: mean(|one| one.area_fraction_xu),
            friction_coefficient: mean(|one| one.friction_coefficient),
            friction_coefficient_2006: mean(|one| one.friction_coefficient_2006),
        })
    }
}

/// Bounding rectangle of the contact, relative to the lowest point of the body, \[m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactBox {
    /// Rear and front end along the direction of motion, \[m].
    pub x: [f64; 2],
    /// Ends across the direction of motion, \[m]; `None` for one-dimensional methods and for a cylinder.
    pub y: Option<[f64; 2]>,
    /// Absolute error of each end, \[m].
    pub error: f64,
}

/// Finest boundary-element grid behind an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    /// Elements of the footprint on either side of the element under the lowest point: behind and ahead, right and left.
    pub(crate) footprint: [[usize; 2]; 2],
    /// True if the equations of the contact were factorised.
    pub(crate) factorised: bool,
}

/// Fields and histories behind an answer; empty if the method does not compute them.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Fields {
    /// Pressure on the half space, \[Pa].
    pub pressure: Option<PressureField>,
    /// Gap between body and elastomer around the contact, or below a period: h + u − d, \[m]; of a problem that
    /// [asks](super::Problem::with_gap) for it, where the pressure is known.
    ///
    /// It is that of the finest grid, evaluated up to half an element behind the centres. In the contact it is 0 within the tolerance of
    /// the contact solver. `None` if the body does not cover the box of the contact.
    pub gap: Option<GapField>,
    /// Temperature rise of the surface of the elastomer.
    pub temperature: Option<TemperatureField>,
    /// Position \[m] and line load \[N/m] along the contact of the one-dimensional model.
    pub line_load: Vec<[f64; 2]>,
    /// Position \[m] and pressure \[Pa] across the contact of a cylinder, or along a diameter under a body of revolution without
    /// sliding.
    pub line_pressure: Vec<[f64; 2]>,
    /// Time steps from first touch to the requested state.
    pub history: Vec<HistoryRow>,
    /// Points of the requested history or motion, or of the indentation [since first touch](super::with_fields()).
    pub curve: Curve,
    /// Steps of an indentation history, with its points among them: time \[s], depth \[m] and force \[N]; empty if only the points are
    /// known.
    pub history_steps: Vec<[f64; 3]>,
    /// Steps of a motion: time \[s], position \[m] and tangential force \[N].
    pub motion_steps: Vec<[f64; 3]>,
}

/// One time step of sliding.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct HistoryRow {
    /// Sliding distance since first touch, \[m].
    pub sliding_distance_m: f64,
    /// Time since first touch, \[s].
    pub time_s: f64,
    /// Indentation depth of the lowest point, or of the mean plane of a periodic surface, \[m].
    pub indentation_depth_m: f64,
    /// Friction coefficient F_h/F_N at this step.
    pub friction_coefficient: f64,
    /// Contact area over normal force at this step, \[1/Pa], with which shear is added to the friction; `None` in the one-dimensional
    /// model.
    #[serde(skip)]
    pub(crate) area_over_force: Option<f64>,
}

/// A value with the absolute error `relative_error` times its size.
pub(crate) const fn within(value: f64, relative_error: f64) -> Estimate {
    Estimate::new(value, relative_error * value.abs())
}

impl Answer {
    /// An answer that holds only the normal force.
    pub(crate) fn new(method: Method, model: Model, normal_force: Estimate) -> Self {
        Self {
            method,
            model,
            normal_force,
            ..Self::default()
        }
    }

    /// Tangential force F_h = μ F_N, \[N] or \[N/m]; `None` if nothing slides.
    pub fn tangential_force(&self) -> Option<Estimate> {
        let (friction, force) = (self.friction_coefficient?, self.normal_force);
        let error = friction.error * force.value + friction.value.abs() * force.error;
        Some(Estimate::new(friction.value * force.value, error))
    }

    /// Largest rise of the temperature at the surface or of a depth, \[K]; 0 without heat.
    pub(crate) fn hottest_rise(&self) -> f64 {
        let of_surface = self.largest_temperature_rise.map_or(0.0, |rise| rise.value);
        let below = self.temperature_by_depth.as_ref();
        below.map_or(of_surface, |below| below.largest().max(of_surface))
    }

    /// Friction coefficient from the dissipation in the bulk; `None` if nothing slides.
    pub fn hysteresis(&self) -> Option<Estimate> {
        self.friction_from_hysteresis.or(self.friction_coefficient)
    }

    /// Mean pressure F_N/A in the contact, \[Pa]; `None` without a contact area that is positive within its error.
    pub fn mean_contact_pressure(&self) -> Option<Estimate> {
        let (force, area) = (self.normal_force, self.contact_area?);
        let smallest_area = area.value - area.error;
        // Within the errors of force and area the largest mean pressure is farther from the stated one than the smallest, so it
        // gives the error.
        (smallest_area > 0.0).then(|| {
            let mean = force.value / area.value;
            Estimate::new(mean, (force.value + force.error) / smallest_area - mean)
        })
    }

    /// The quantity that the requested relative error refers to: the friction coefficient. Without sliding it is the area fraction
    /// of a periodic surface, else the depth, or the force at a given depth.
    pub fn requested_quantity(&self) -> Estimate {
        let force = self.normal_force;
        let depth_under_force = self.indentation_depth.filter(|_| force.error == 0.0);
        self.friction_coefficient
            .or(self.area_fraction)
            .or(depth_under_force)
            .unwrap_or(force)
    }

    /// All numbers by their names in CSV; `None` if a number is not known.
    pub fn numbers(&self) -> Vec<(String, Option<f64>)> {
        let mut numbers = Vec::new();
        for quantity in &QUANTITIES {
            let (key, known) = (quantity.key, (quantity.of)(self));
            numbers.push((key.to_owned(), known.map(|known| known.value)));
            numbers.push((format!("{key}_error"), known.map(|known| known.error)));
        }
        let parts = self.error_parts.named();
        numbers.extend(parts.map(|(name, part)| (format!("error_{name}"), part)));
        let contact = self.contact_box.as_ref();
        let edges = contact.map_or([None; 4], ContactBox::edges);
        let error = ("contact_box_error", contact.map(|contact| contact.error));
        let named = EDGES.into_iter().zip(edges).chain([error]);
        numbers.extend(named.map(|(name, number)| (name.to_owned(), number)));
        let theory = Persson::named(self.persson.as_ref()).into_iter();
        numbers.extend(theory.map(|(name, number)| (format!("persson_{name}"), number)));
        let scatter = self.ensemble.as_ref().map(|ensemble| &ensemble.scatter);
        for Quantity { key, .. } in scattered() {
            let known = scatter.and_then(|scatter| scatter.of(key));
            let error = known.map(|known| known.standard_error);
            numbers.push((format!("{key}_standard_error"), error));
            let deviation = known.map(|known| known.standard_deviation);
            numbers.push((format!("{key}_scatter"), deviation));
        }
        let shares = self.dissipation.shares().into_iter();
        numbers.extend(shares.map(|(name, share)| (format!("dissipation_{name}"), share)));
        numbers
    }

    /// Names of all [`numbers`](Self::numbers) of an answer, which are the columns of the CSV.
    pub fn columns() -> Vec<String> {
        let numbers = Self::default().numbers().into_iter();
        numbers.map(|(name, _)| name).collect()
    }

    /// Rejects unphysical numbers: underflow, which leaves neither digits nor an error estimate, and negative friction, by which
    /// a material would return more energy than it receives. Friction that is negative within its error is set to 0 and keeps
    /// the error.
    ///
    /// Before the stationary state, a surface without mirror symmetry may have negative friction.
    pub(crate) fn physical(mut self, problem: &Problem) -> Result<Self> {
        if matches!(problem.motion(), Motion::History { .. } | Motion::Moving(_)) {
            return Ok(self);
        }
        let may_be_pulled = matches!(problem.body(), Body::HeightMap(_) | Body::Periodic(_));
        if let Some(friction) = &mut self.friction_coefficient
            && friction.value < 0.0
            && !(may_be_pulled && self.method == Method::BemTransient)
        {
            let ValueWithError { value, error } = **friction;
            if error < -value {
                return Err(SolveError::NegativeFriction { value, error });
            }
            *friction = Estimate::new(0.0, error);
        }
        // Discard an area or a pressure whose extrapolated value is not positive within its error.
        for quantity in [&mut self.contact_area, &mut self.peak_pressure] {
            *quantity = quantity.filter(|known| known.value > 0.0 || known.error < -known.value);
        }
        // Reject underflow. Exactly 0 is allowed for friction on an elastic material, and with an error that does not underflow.
        let is_elastic = problem.simple() == Some(&Simple::Elastic);
        let is_lost = |known: Estimate, may_vanish: bool| {
            let is_zero = known.value == 0.0 && (may_vanish || known.error >= f64::MIN_POSITIVE);
            known.value.abs() < f64::MIN_POSITIVE && !is_zero
        };
        let lost = QUANTITIES.iter().find_map(|quantity| {
            let known = (quantity.of)(&self)?;
            let may_vanish = is_elastic && quantity.is_dissipative;
            is_lost(known, may_vanish).then_some((quantity.key, known.value))
        });
        let width = self.contact_box.as_ref().map(|one| one.x[1] - one.x[0]);
        let lost_width = width.filter(|width| is_lost(Estimate::exact(*width), false));
        if let Some((key, value)) = lost.or(lost_width.map(|width| ("contact_box", width))) {
            let quantity = key.to_owned();
            return Err(SolveError::OutOfRange { quantity, value });
        }
        Ok(self)
    }

    /// Rejects an answer with a quantity that overflows although its inputs do not, such as an area from a length.
    pub(crate) fn finite(self) -> Result<Self> {
        let numbers = self.numbers().into_iter();
        let mut known = numbers.filter_map(|(name, value)| Some((name, value?)));
        match known.find(|(_, value)| !value.is_finite()) {
            None => Ok(self),
            Some((quantity, value)) => Err(SolveError::OutOfRange { quantity, value }),
        }
    }
}

/// Names of the edges of the contact in JSON and CSV.
const EDGES: [&str; 4] = ["x_min", "x_max", "y_min", "y_max"];

impl ContactBox {
    /// A contact interval, without a width across the motion.
    pub(crate) const fn along(x: [f64; 2], error: f64) -> Self {
        Self { x, y: None, error }
    }

    /// The contact rectangle with the ends `x` along and `y` across the motion, all with the same error, \[m].
    pub(crate) const fn around(x: [f64; 2], y: [f64; 2], error: f64) -> Self {
        let y = Some(y);
        Self { x, y, error }
    }

    /// The ends of the rectangle in the order of [`EDGES`], \[m]; those along y are `None` if it has no width.
    fn edges(&self) -> [Option<f64>; 4] {
        let [rear, front] = self.x.map(Some);
        let [right, left] = self.y.map_or([None; 2], |y| y.map(Some));
        [rear, front, right, left]
    }
}

impl Serialize for ContactBox {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let edges = EDGES.into_iter().zip(self.edges());
        serializer.collect_map(edges.filter_map(|(name, edge)| Some((name, edge?))))
    }
}

impl Serialize for Answer {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("method", &self.method)?;
        map.serialize_entry("model", &self.model)?;
        let is_rise = |quantity: &Quantity| quantity.key.ends_with(TEMPERATURE_RISE);
        let is_linear = |quantity: &Quantity| quantity.key == LINEAR_FRICTION;
        let known = |quantity: &Quantity, of_rises: bool| {
            (quantity.of)(self).filter(|_| is_rise(quantity) == of_rises && !is_linear(quantity))
        };
        ByQuantity::new(|quantity| known(quantity, false)).serialize_into(&mut map)?;
        let rises = ByQuantity::new(|quantity| known(quantity, true));
        if !rises.is_empty() {
            let rises = rises.with_keys(|key| key.trim_end_matches(TEMPERATURE_RISE));
            map.serialize_entry("temperature_rise", &rises)?;
        }
        if let Some(linear) = &self.linear {
            // All quantities, without the parts, warnings and fields of that answer.
            let numbers = ByQuantity::new(|quantity| (quantity.of)(linear));
            map.serialize_entry("linear", &numbers)?;
        }
        for (key, error) in self.budget.material().iter() {
            map.serialize_entry(&format!("{key}_material_error"), &error)?;
        }
        self.serialize_rough(&mut map)?;
        if let Some(contact) = &self.contact_box {
            map.serialize_entry("contact_box", contact)?;
            map.serialize_entry("contact_box_error", &contact.error)?;
        }
        if self.dissipation != Dissipation::default() {
            map.serialize_entry("dissipation", &self.dissipation)?;
        }
        if !self.error_parts.is_none() {
            map.serialize_entry("error_parts", &self.error_parts)?;
        }
        if !self.fields.curve.times.is_empty() {
            self.fields.curve.serialize_into(&mut map)?;
        }
        if !self.sensitivity.is_empty() {
            map.serialize_entry("sensitivity", &self.sensitivity)?;
        }
        if let Some(spectral) = &self.spectral_sensitivity {
            map.serialize_entry("spectral_sensitivity", spectral)?;
        }
        if !self.budget.entries.is_empty() {
            map.serialize_entry("budget", &self.budget)?;
        }
        map.serialize_entry("unknowns", &self.unknowns)?;
        map.serialize_entry("iterations", &self.iterations)?;
        if let Some(why) = &self.not_reached {
            map.serialize_entry("not_reached", why)?;
        }
        map.serialize_entry("warnings", &self.warnings)?;
        map.serialize_entry("not_modelled", &self.not_modelled)?;
        map.serialize_entry("left_out", &self.left_out)?;
        map.end()
    }
}

/// Key of the friction coefficient with the moduli of small strains; in JSON it is in the object `linear`.
pub(crate) const LINEAR_FRICTION: &str = "linear_friction_coefficient";

/// End of the keys of the temperature rises; in JSON they are entries of an object `temperature_rise`, by the words before it.
const TEMPERATURE_RISE: &str = "_temperature_rise";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::solve::solve;

    fn problem(body: &str, material: &str, rest: &str) -> Problem {
        let text = format!("[indenter.{body}\n[material.{material}\n[load]\n{rest}");
        let scene: Scene = text.parse().expect("a scene");
        Problem::try_from(&scene).expect("a problem")
    }

    /// The area is the square of a finite radius, and the tangential force a product of two finite numbers; both may overflow.
    #[test]
    fn what_underflows_is_no_answer() {
        let pressed = "normal_force = 1e-300\nvelocity = 0.0\n[solve]\nduration = 1.0";
        let slid = "normal_force = 1e-30\nvelocity = 1e-9\n[solve]\nmodel = \"line\"";
        for (slope, material, rest, lost) in [
            (
                "1",
                "elastic]\nshear_modulus = 1e20",
                pressed,
                "contact_area",
            ),
            (
                "1e-300",
                "viscous]\nviscosity = 1e6",
                slid,
                "tangential_force",
            ),
        ] {
            let asked = problem(&format!("cone]\nslope = {slope}"), material, rest);
            let refused = solve(&asked);
            let holds = matches!(&refused, Err(SolveError::OutOfRange { quantity, .. }) if quantity == lost);
            assert!(holds, "{lost}: {refused:?}");
        }
    }

    #[test]
    fn friction_below_zero_is_refused_or_zero_within_its_bar() {
        let sliding = "normal_force = 1.0\nvelocity = 0.01\n";
        let asked = problem("cone]\nslope = 0.1", "viscous]\nviscosity = 1e4", sliding);
        let of = |value| {
            let friction = Estimate::new(value, 0.01);
            let force = Estimate::exact(1.0);
            let answer = Answer {
                friction_coefficient: Some(friction),
                ..Answer::new(Method::BemSteady, Model::HalfSpace, force)
            };
            answer
                .physical(&asked)
                .map(|answer| answer.friction_coefficient)
        };
        assert_eq!(
            of(-0.009),
            Ok(Some(Estimate::new(0.0, 0.01))),
            "within its bar"
        );
        let [value, error] = [-0.011, 0.01];
        let refused = SolveError::NegativeFriction { value, error };
        assert_eq!(of(value), Err(refused), "by more than its bar");
    }
}
