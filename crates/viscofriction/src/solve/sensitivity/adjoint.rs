//! Derivatives of stationary half-space contacts: one adjoint solution per quantity, whatever the number of parameters.

use bem_halfspace::Elastomer;
use bem_halfspace::periodic::sensitivity::PeriodicSensitivity;
use bem_halfspace::steady::sensitivity::{ByModuli, Change, SteadySensitivity};
use indenters::{Control, SlidingLoad, Surface};
use numerics::{Estimate, WorkProgress};
use rheology::Material;

use super::Sensitivity;
use super::parameters::{Number, Numbers};
use crate::quantity::{ByQuantity, Quantity};
use crate::scene::{Method, SceneError};
use crate::solve::answer::Answer;
use crate::solve::body::Body;
use crate::solve::error::{Result, SolveError};
use crate::solve::problem::{Motion, Problem};
use crate::solve::work::rough;

/// Relative change of a number of the scene, to either side. The adjoint method differentiates between the two bodies or
/// materials with the changed numbers. Chosen: the truncation error, of the order of the square of the change, is far below the
/// error estimates.
const RELATIVE_STEP: f64 = 1e-5;
/// Error if a body or an answer has no adjoint solution.
const NO_DERIVATIVES: SolveError = SolveError::NoSensitivity {
    method: Method::BemSteady,
};

/// Derivatives by each number, from one adjoint solution.
pub(super) fn sensitivities(
    (numbers, all): (&Numbers, &[Number]),
    problem: &Problem,
    (load, answer): (&SlidingLoad, &Answer),
    mut progress: WorkProgress,
) -> Result<Vec<Sensitivity>> {
    let contact = Contact::new(problem, load, answer)?;
    let of = |number: &Number| {
        let ends = neighbours(numbers, problem, number)?;
        let contact = change_between_ends(&contact, number, &ends)?;
        let change = AnswerChange::new(contact, &ends)?;
        let width = (ends[1].1 / ends[0].1).ln();
        progress.add(1.0);
        Ok(log_derivatives(number.path.clone(), answer, change, width))
    };
    all.iter().map(of).collect()
}

/// Rejects an ensemble of random surfaces.
pub(super) fn check_surfaces(problem: &Problem) -> Result<(), SceneError> {
    if problem.realisations() > 1 {
        let why = "derivatives are those of one surface; leave out its realisations";
        return Err(SceneError::at("indenter", why));
    }
    Ok(())
}

/// The contact of an answer on its finest grid, with one adjoint solution per quantity.
pub(super) enum Contact {
    /// A finite body, or a cylinder in plane strain.
    Single(Box<SteadySensitivity>),
    /// A periodic surface.
    Periodic(Box<PeriodicSensitivity>),
}

impl Contact {
    /// Solves the adjoint equations on the finest grid of an answer. Refuses ensembles, and answers without such a grid.
    pub(super) fn new(problem: &Problem, load: &SlidingLoad, answer: &Answer) -> Result<Self> {
        check_surfaces(problem)?;
        let elastomer = problem.elastomer()?;
        Ok(match (problem.body(), answer.stationary) {
            (body, Some(options)) => {
                let body = body.steady_body().ok_or(NO_DERIVATIVES)?;
                let near = SteadySensitivity::new(body, &elastomer, load, &options);
                Self::Single(Box::new(near?))
            }
            (Body::Periodic(surface), _) => {
                let pressure = answer.fields.pressure.as_ref().ok_or(NO_DERIVATIVES)?;
                let load = rough(problem, surface).map_err(|_| NO_DERIVATIVES)?.load;
                let near = PeriodicSensitivity::new(surface, &elastomer, &load, pressure);
                Self::Periodic(Box::new(near?))
            }
            _ => return Err(NO_DERIVATIVES),
        })
    }

    /// Changes of the quantities per change of the logarithm of storage and loss modulus, in the bands between consecutive
    /// `frequencies` \[rad/s].
    pub(super) fn by_moduli(&self, frequencies: &[f64]) -> Result<Vec<ByModuli>> {
        Ok(match self {
            Self::Single(near) => near.by_moduli(frequencies),
            Self::Periodic(near) => near.by_moduli(frequencies),
        }?)
    }

    /// Changes of the quantities per change of the given load: force \[N], mean pressure \[Pa] or depth \[m].
    fn by_load(&self) -> Change<Estimate> {
        match self {
            Self::Single(near) => near.by_load(),
            Self::Periodic(near) => near.by_load(),
        }
    }

    /// Changes of the quantities from the first to the second of two bodies, to first order in the difference of their heights.
    fn between_bodies(&self, bodies: [&Body; 2]) -> Result<Change<Estimate>> {
        Ok(match self {
            Self::Single(near) => {
                let [from, to] = bodies.map(surface);
                near.between_bodies([from?, to?])
            }
            Self::Periodic(near) => match bodies {
                [Body::Periodic(from), Body::Periodic(to)] => near.between_surfaces([from, to]),
                _ => return Err(NO_DERIVATIVES),
            },
        }?)
    }

    /// Changes of the quantities from the first to the second of two materials, each at its velocity \[m/s], to first order in
    /// the difference of their compliances.
    fn between_materials(
        &self,
        materials: [&dyn Material; 2],
        velocities: [f64; 2],
    ) -> Result<Change<Estimate>> {
        Ok(match self {
            Self::Single(near) => near.between_materials(materials, velocities),
            Self::Periodic(near) => near.between_materials(materials, velocities),
        }?)
    }
}

/// The problems on both sides of a number, with its values. At the end of the allowed range one of them is the number itself.
fn neighbours(
    numbers: &Numbers,
    problem: &Problem,
    number: &Number,
) -> Result<[(Problem, f64); 2], SceneError> {
    let at = |factor: f64| {
        let value = factor * number.value;
        Ok::<_, SceneError>((numbers.problem(problem, number, value)?, value))
    };
    match (at(1.0 - RELATIVE_STEP), at(1.0 + RELATIVE_STEP)) {
        (Err(error), Err(_)) => Err(error),
        (low, high) => Ok([low.or_else(|_| at(1.0))?, high.or_else(|_| at(1.0))?]),
    }
}

/// Changes of the quantities between the two `ends`, the problems with a smaller and a larger value of a number and these
/// values. The derivative that it follows from is chosen by the table and the key of the number.
fn change_between_ends(
    contact: &Contact,
    number: &Number,
    ends: &[(Problem, f64); 2],
) -> Result<Change<Estimate>> {
    let [from, to] = [&ends[0].0, &ends[1].0];
    let velocity = |problem: &Problem| match problem.motion() {
        Motion::Sliding(load) => load.velocity(),
        _ => f64::NAN,
    };
    let velocities = [from, to].map(velocity);
    let is_layer = to.thickness().is_finite();
    Ok(match number.ends() {
        ["interface", _] => scaled(contact.by_load(), 0.0),
        [
            "load",
            "normal_force" | "mean_pressure" | "indentation_depth",
        ] => scaled(contact.by_load(), ends[1].1 - ends[0].1),
        ["indenter", _] => contact.between_bodies([from.body(), to.body()])?,
        ["layer", _] if let Contact::Single(near) = contact => {
            scaled(near.by_thickness(), (ends[1].1 / ends[0].1).ln())
        }
        ["load", "track"] if let Contact::Single(near) = contact => {
            scaled(near.by_track(), (ends[1].1 / ends[0].1).ln())
        }
        // The elastomer of a layer depends on its thickness and on the Poisson ratio. Take the end of the step that differs from
        // the present value, and convert the change to the distance of both ends in logarithms.
        ["layer", _] | ["material", "poisson_ratio"] if is_layer => match contact {
            Contact::Single(near) => {
                let [low, high] = ends;
                let (other, value) = if high.1 > number.value { high } else { low };
                let change = near.to_elastomer(&other.elastomer()?, velocities[0])?;
                scaled(change, (high.1 / low.1).ln() / (value / number.value).ln())
            }
            Contact::Periodic(near) => {
                let [from, to] = [from.elastomer()?, to.elastomer()?];
                near.between_elastomers([&from as &dyn Elastomer, &to], velocities)?
            }
        },
        _ => contact.between_materials([from.material(), to.material()], velocities)?,
    })
}

/// Surface of a finite body or a cylinder.
fn surface(body: &Body) -> Result<&dyn Surface> {
    let body = body.steady_body().ok_or(NO_DERIVATIVES)?;
    Ok(body.surface())
}

/// The changes of all quantities, with their errors, times `factor`.
fn scaled(change: Change<Estimate>, factor: f64) -> Change<Estimate> {
    change.map(|value| *value * factor)
}

/// Logarithmic derivatives d ln q/d ln θ of the quantities q of an answer by a parameter θ, from the `change` of all quantities
/// for a change `width` of ln θ.
pub(super) fn log_derivatives(
    parameter: String,
    answer: &Answer,
    change: AnswerChange,
    width: f64,
) -> Sensitivity {
    let derivative = |of: &Quantity| Some((of.log_change?)(answer, &change)? * width.recip());
    Sensitivity {
        parameter,
        derivatives: ByQuantity::new(derivative),
    }
}

/// The change of an answer to first order: of its contact, and of what the contact does not depend on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AnswerChange {
    /// Changes of the quantities of the contact.
    pub(crate) contact: Change<Estimate>,
    /// Change of ln(τ_f/F_N) for the shear strength τ_f and a given normal force F_N; of ln τ_f at a given depth. 0 without shear.
    log_shear_over_load: f64,
}

impl AnswerChange {
    /// The change between two problems, with the values of the number in which they differ.
    fn new(contact: Change<Estimate>, ends: &[(Problem, f64); 2]) -> Result<Self> {
        let logs = |(problem, _): &(Problem, f64)| -> Result<Option<f64>> {
            let load = match problem.motion().control() {
                Control::NormalForce(force) => force,
                Control::IndentationDepth(_) => 1.0,
            };
            Ok((problem.shear_strength()?).map(|strength| (strength / load).ln()))
        };
        let [from, to] = [logs(&ends[0])?, logs(&ends[1])?];
        Ok(Self {
            contact,
            log_shear_over_load: to.zip(from).map_or(0.0, |(to, from)| to - from),
        })
    }

    /// The change of a contact whose load and shear strength stay.
    pub(super) const fn of_contact(contact: Change<Estimate>) -> Self {
        Self {
            contact,
            log_shear_over_load: 0.0,
        }
    }

    /// The change of a contact whose shear strength grows by one e-fold.
    pub(super) const fn of_shear_strength() -> Self {
        /// Change of a quantity that does not depend on the shear strength.
        const NO_CHANGE: Estimate = Estimate::exact(0.0);
        Self {
            contact: Change {
                friction_coefficient: NO_CHANGE,
                indentation_depth: None,
                normal_force: None,
                contact_area: Some(NO_CHANGE),
            },
            log_shear_over_load: 1.0,
        }
    }

    /// Change of the logarithm of the friction from shear, ln(τ_f A/F_N); `None` if that of the contact area is not known.
    pub(crate) fn of_log_shear(&self, answer: &Answer) -> Option<Estimate> {
        let area = self.contact.contact_area?;
        let force = relative_change(self.contact.normal_force, Some(answer.normal_force))
            .unwrap_or(Estimate::exact(0.0));
        Some(area + force * -1.0 + Estimate::exact(self.log_shear_over_load))
    }
}

/// Change of the logarithm of a quantity; `None` if the quantity is given or 0. Its value is extrapolated, so it differs from the
/// value on the grid of the change by up to its error.
pub(crate) fn relative_change(
    change: Option<Estimate>,
    value: Option<Estimate>,
) -> Option<Estimate> {
    let (change, value) = change.zip(value.filter(|value| value.value != 0.0))?;
    let relative = change * value.value.recip();
    let of_value = relative.value * value.error / value.value;
    Some(relative.widened(of_value.abs()))
}
