//! What a method answers: quantities in SI, each with its error.

use bem_halfspace::slide::PressureField;
use bem_halfspace::steady::{LineOptions, SteadyOptions};
use numerics::{ErrorParts, Estimate, ValueWithError};
use serde::ser::{Serialize, SerializeMap as _, Serializer};

use super::body::Body;
use super::curve::Curve;
use super::cut_off::WithoutShortestOctave;
use super::dissipation::Dissipation;
use super::error::{Result, SolveError};
use super::half_space::Simple;
use super::omission::Omission;
use super::problem::{Motion, Problem};
use super::realisations::Ensemble;
use super::sensitivity::{Budget, Sensitivity, SpectralSensitivity};
use crate::scene::{Method, Model};

/// One result in SI; what a method does not know is left out.
///
/// As JSON it is flat: every quantity is followed by its absolute error, `friction_coefficient` by
/// `friction_coefficient_error`; the error of what was given, or is exact, is 0.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Answer {
    /// The method that was asked.
    pub method: Method,
    /// What the elastomer was taken to be.
    pub model: Model,
    /// μ = F_h/F_N, of a motion ∫ F_t dx / ∫ F_N |dx|; none where nothing slides.
    pub friction_coefficient: Option<Estimate>,
    /// The largest |F_t|/F_N of a motion; none of any other.
    pub peak_friction: Option<Estimate>,
    /// Energy that is dissipated in a cycle of a motion to and fro, \[J].
    pub dissipated_energy: Option<Estimate>,
    /// F_N, \[N], or \[N/m] of a cylinder.
    pub normal_force: Estimate,
    /// Depth of the lowest point below the undeformed surface, \[m], and of the mean plane of a periodic surface; none where
    /// it has no end.
    pub indentation_depth: Option<Estimate>,
    /// Parts of the error of the friction coefficient; where nothing slides of the depth, or of the force at a given depth.
    pub error_parts: ErrorParts,
    /// \[m²], or the width \[m] of a cylinder's contact; none on a line.
    pub contact_area: Option<Estimate>,
    /// \[Pa]; none where it grows without limit on finer elements.
    pub peak_pressure: Option<Estimate>,
    /// What is said of rough surfaces only.
    pub rough: Option<RoughAnswer>,
    /// The rectangle around the contact.
    pub contact_box: Option<ContactBox>,
    /// Where the dissipated power comes from.
    pub dissipation: Dissipation,
    /// Unknown pressures, elements or polynomials at the same time; none in a closed form.
    pub unknowns: usize,
    /// Iterations or time steps on the finest resolution.
    pub iterations: usize,
    /// Whether forces and areas are per length along y.
    pub is_per_length: bool,
    /// Sentences about the validity of the answer.
    pub warnings: Vec<String>,
    /// Why it is not what was asked, of an answer that a [`SolveError`] holds.
    pub not_reached: Option<String>,
    /// What a reader might take to be in the answer, and is not: words of a fixed list.
    pub not_modelled: Vec<&'static str>,
    /// Parts of the method that the scene did not need.
    pub left_out: Vec<Omission>,
    /// How much it depends on the numbers of its scene, where [that](super::with_sensitivity()) was asked for.
    pub sensitivity: Vec<Sensitivity>,
    /// How much it depends on the modulus at each frequency, where [that](super::spectral_sensitivity()) was asked for.
    pub spectral_sensitivity: Option<SpectralSensitivity>,
    /// The surfaces of which it is the mean; none of a body that is not random, and of one surface alone.
    pub ensemble: Option<Ensemble>,
    /// What makes it uncertain, where that was asked for and its scene says what is uncertain.
    pub budget: Budget,
    /// The finest boundary elements.
    pub(crate) grid: Option<Grid>,
    /// Those of a stationary contact.
    pub(crate) stationary: Option<StationaryGrid>,
    /// Elements of the finest grid of a period.
    pub(crate) period_grid: Option<[usize; 2]>,
    /// Fields and histories.
    pub fields: Fields,
}

/// What is said of a periodic surface beside other bodies; `normal_force` and `contact_area` are those of one period.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RoughAnswer {
    /// \[Pa].
    pub mean_pressure: Estimate,
    /// Part of the period in contact.
    pub area_fraction: Estimate,
    /// The friction coefficient from the power that the material dissipates, of a stationary state.
    pub friction_from_dissipation: Option<Estimate>,
    /// Persson's theory of the same waves in the stationary state on a half space; none elsewhere.
    pub persson: Option<Persson>,
    /// Where the contact is stationary or at rest, and waves are left.
    pub without_shortest_octave: Option<WithoutShortestOctave>,
}

/// Persson's theory of the waves of a surface, exact as a sum.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Persson {
    /// Part of the period in contact, as in 2001.
    pub area_fraction: f64,
    /// The same of Xu and others (2024) with γ = 0.45, in which pressures differ less where less is in contact.
    pub area_fraction_xu: f64,
    /// Friction coefficient with S = 1, as in 2001.
    pub friction_coefficient: f64,
    /// Friction coefficient with S = (1 + P²)/2, as in 2006.
    pub friction_coefficient_2006: f64,
}

/// The rectangle around the contact, relative to the lowest point, \[m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactBox {
    /// Rear and front end along the direction of motion.
    pub x: [f64; 2],
    /// Ends across it; none on a line.
    pub y: Option<[f64; 2]>,
    /// Absolute error of each end.
    pub error: f64,
}

/// The finest boundary elements behind an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    /// Elements of the footprint behind and ahead of, right and left of the one under the lowest point.
    pub(crate) footprint: [[usize; 2]; 2],
    /// Whether the contact was factorised.
    pub(crate) factorised: bool,
}

/// The finest grid of a stationary contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum StationaryGrid {
    Contact(SteadyOptions),
    Line(LineOptions),
}

/// Fields and histories behind an answer; what a method does not have is empty.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Fields {
    /// Pressure on the half space.
    pub pressure: Option<PressureField>,
    /// Position \[m] and load per length \[N/m] along the contact of a line.
    pub line_load: Vec<[f64; 2]>,
    /// Position \[m] and pressure \[Pa] across the contact of a cylinder, or along a diameter under a body of revolution that
    /// does not slide.
    pub line_pressure: Vec<[f64; 2]>,
    /// From first touch to the state that was asked for.
    pub history: Vec<HistoryRow>,
    /// The points of the history or motion that was asked for, or [since touch](super::with_fields()).
    pub curve: Curve,
    /// The steps of a motion: time \[s], position \[m] and tangential force \[N].
    pub motion_steps: Vec<[f64; 3]>,
}

/// One step of sliding.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct HistoryRow {
    /// Since first touch, \[m].
    pub sliding_distance_m: f64,
    /// Since first touch, \[s].
    pub time_s: f64,
    /// Depth of the lowest point, or of the mean plane of a periodic surface, \[m].
    pub indentation_depth_m: f64,
    /// F_h/F_N of the step.
    pub friction_coefficient: f64,
}

/// A value that is known to a relative error.
pub(crate) const fn within(value: f64, relative_error: f64) -> Estimate {
    Estimate::new(value, relative_error * value.abs())
}

impl Answer {
    /// An answer that knows nothing yet but the force.
    pub(crate) fn new(method: Method, model: Model, normal_force: Estimate) -> Self {
        Self {
            method,
            model,
            friction_coefficient: None,
            peak_friction: None,
            dissipated_energy: None,
            normal_force,
            indentation_depth: None,
            error_parts: ErrorParts::NONE,
            contact_area: None,
            peak_pressure: None,
            rough: None,
            contact_box: None,
            dissipation: Dissipation::default(),
            unknowns: 0,
            iterations: 0,
            is_per_length: false,
            warnings: Vec::new(),
            not_reached: None,
            not_modelled: Vec::new(),
            left_out: Vec::new(),
            sensitivity: Vec::new(),
            spectral_sensitivity: None,
            ensemble: None,
            budget: Budget::default(),
            stationary: None,
            period_grid: None,
            grid: None,
            fields: Fields::default(),
        }
    }

    /// F_h = μ F_N, \[N] or \[N/m]; none where nothing slides.
    pub fn tangential_force(&self) -> Option<Estimate> {
        let (friction, force) = (self.friction_coefficient?, self.normal_force);
        let error = friction.error * force.value + friction.value.abs() * force.error;
        Some(Estimate::new(friction.value * force.value, error))
    }

    /// The friction coefficient, or where nothing slides the area fraction of a periodic surface, the depth, or the force at a
    /// given depth: what the relative error is asked of.
    pub fn requested_quantity(&self) -> Estimate {
        let (force, depth) = (self.normal_force, self.indentation_depth);
        let depth = depth.filter(|_| force.error == 0.0);
        let area = self.rough.map(|rough| rough.area_fraction);
        self.friction_coefficient
            .or(area)
            .or(depth)
            .unwrap_or(force)
    }

    /// Quantities by their names in JSON and CSV, in this order, each with its error.
    fn quantities(&self) -> [(&str, Option<Estimate>); 11] {
        let rough = |of: fn(RoughAnswer) -> Estimate| self.rough.map(of);
        let dissipation = self.rough.and_then(|rough| rough.friction_from_dissipation);
        [
            ("friction_coefficient", self.friction_coefficient),
            ("normal_force", Some(self.normal_force)),
            ("tangential_force", self.tangential_force()),
            ("indentation_depth", self.indentation_depth),
            ("contact_area", self.contact_area),
            ("peak_pressure", self.peak_pressure),
            ("mean_pressure", rough(|rough| rough.mean_pressure)),
            ("area_fraction", rough(|rough| rough.area_fraction)),
            ("friction_from_dissipation", dissipation),
            ("peak_friction", self.peak_friction),
            ("dissipated_energy", self.dissipated_energy),
        ]
    }

    /// All numbers by their names in CSV; those that are not known stay empty.
    pub fn numbers(&self) -> Vec<(String, Option<f64>)> {
        let mut numbers = Vec::new();
        for (name, known) in self.quantities() {
            numbers.push((name.to_owned(), known.map(|known| known.value)));
            numbers.push((format!("{name}_error"), known.map(|known| known.error)));
        }
        let parts = self.error_parts.named();
        numbers.extend(parts.map(|(name, part)| (format!("error_{name}"), part)));
        let contact = self.contact_box.as_ref();
        let edges = contact.map_or([None; 4], ContactBox::edges);
        let theory = self.rough.and_then(|rough| rough.persson);
        let friction = theory.map(|one| one.friction_coefficient);
        let friction_2006 = theory.map(|one| one.friction_coefficient_2006);
        let others = [
            ("contact_box_error", contact.map(|contact| contact.error)),
            ("persson_area_fraction", theory.map(|one| one.area_fraction)),
            (
                "persson_area_fraction_xu",
                theory.map(|one| one.area_fraction_xu),
            ),
            ("persson_friction_coefficient", friction),
            ("persson_friction_coefficient_2006", friction_2006),
        ];
        let others = EDGES.into_iter().zip(edges).chain(others);
        numbers.extend(others.map(|(name, number)| (name.to_owned(), number)));
        for (name, scatter) in self.scatters() {
            let known = scatter.map(|one| one.standard_error);
            numbers.push((format!("{name}_standard_error"), known));
            let known = scatter.map(|one| one.standard_deviation);
            numbers.push((format!("{name}_scatter"), known));
        }
        let shares = self.dissipation.shares().into_iter();
        numbers.extend(shares.map(|(name, share)| (format!("dissipation_{name}"), share)));
        numbers
    }

    /// The names of all [`numbers`](Self::numbers).
    pub fn columns() -> Vec<String> {
        let empty = Self::new(Method::Analytic, Model::HalfSpace, Estimate::exact(0.0));
        empty.numbers().into_iter().map(|(name, _)| name).collect()
    }

    /// Refuses numbers that no contact has: one so close to 0 that it has lost its digits, and with them its bar, and a
    /// friction below 0, by which a material would give back more energy than it takes. Friction that came out below 0
    /// within its bar is 0 with that bar, which holds all that is left of it.
    ///
    /// On the way to the stationary state a surface that is not its own mirror image may be pulled along.
    pub(crate) fn physical(mut self, problem: &Problem) -> Result<Self> {
        if matches!(problem.motion(), Motion::History(_) | Motion::Moving(_)) {
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
        // Of an area or a pressure whose extrapolation is not even positive nothing is known.
        for quantity in [&mut self.contact_area, &mut self.peak_pressure] {
            *quantity = quantity.filter(|known| known.value > 0.0 || known.error < -known.value);
        }
        let is_elastic = problem.simple() == Some(&Simple::Elastic);
        let is_lost = |name: &str, known: Estimate| {
            let is_exact = is_elastic && (name.contains("friction") || name == "tangential_force");
            let is_zero = known.value == 0.0 && (is_exact || known.error >= f64::MIN_POSITIVE);
            known.value.abs() < f64::MIN_POSITIVE && !is_zero
        };
        let quantities = self.quantities().into_iter();
        let known = quantities.filter_map(|(name, known)| Some((name, known?)));
        let width = self.contact_box.as_ref().map(|one| one.x[1] - one.x[0]);
        let width = width.map(|width| ("contact_box", Estimate::exact(width)));
        let mut known = known.chain(width);
        if let Some((name, known)) = known.find(|(name, known)| is_lost(name, *known)) {
            let (quantity, value) = (name.to_owned(), known.value);
            return Err(SolveError::OutOfRange { quantity, value });
        }
        drop(known);
        Ok(self)
    }

    /// Refuses a quantity that overflows although what it follows from does not, such as an area from a length.
    pub(crate) fn finite(self) -> Result<Self> {
        let numbers = self.numbers().into_iter();
        let mut known = numbers.filter_map(|(name, value)| Some((name, value?)));
        match known.find(|(_, value)| !value.is_finite()) {
            None => Ok(self),
            Some((quantity, value)) => Err(SolveError::OutOfRange { quantity, value }),
        }
    }
}

/// The edges of the contact by their names.
const EDGES: [&str; 4] = ["x_min", "x_max", "y_min", "y_max"];

impl ContactBox {
    /// On a line.
    pub(crate) const fn along(x: [f64; 2], error: f64) -> Self {
        Self { x, y: None, error }
    }

    /// On a surface.
    pub(crate) const fn around(x: [f64; 2], y: [f64; 2], error: f64) -> Self {
        let y = Some(y);
        Self { x, y, error }
    }

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
        let of_material = self.budget.material();
        for (name, known) in self.quantities() {
            if let Some(known) = known {
                map.serialize_entry(name, &known.value)?;
                map.serialize_entry(&format!("{name}_error"), &known.error)?;
            }
            if let Some(error) = of_material.of(name) {
                map.serialize_entry(&format!("{name}_material_error"), &error)?;
            }
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

    /// The area is the square of a radius that is a number, and the tangential force the product of two.
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
