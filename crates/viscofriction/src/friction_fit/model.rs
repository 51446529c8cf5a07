//! Friction of the measured points as a function of the parameters, with derivatives.
//!
//! ```text
//! μ = μ_hysteresis + τ_f A/F_N
//! ```
//! On the half space the contact of each point is solved on one coarse grid. Its hysteresis and its area are multiplied by the
//! ratios to a solution with error estimates at nearby parameters, because these ratios depend on them only weakly. If the
//! parameters are those of the shear strength τ_f alone, the contacts do not depend on them, and are solved once.

use std::sync::{Mutex, PoisonError};

use bem_halfspace::Layer;
use bem_halfspace::steady::sensitivity::SensitivityOnGrid;
use bem_halfspace::steady::{SteadyBody, steady, steady_grid};
use indenters::{Control, SlidingLoad};
use measurements::friction::{FrictionModel, FrictionPoint, ModelledPoint};
use numerics::{Accuracy, Estimate, SilentProgress};
#[cfg(feature = "rayon")]
use rayon::prelude::*;
use rheology::Material;

use super::FrictionFitError;
use super::family::Family;
use super::shear::Strength;
use crate::scene::Revolution;
use crate::scene::{Method, Model as Dimensions, SceneError};
use crate::solve::body::Body;
use crate::solve::half_space::simple;
use crate::solve::mdr;
use crate::solve::shear::NO_AREA_ON_LINE;
use crate::solve::work::closed_line;
use crate::solve::{Motion, Problem, Result, SolveError};

/// Elements along the contact of the coarse solutions. Their friction is off by about 1 %, which the correction removes, and
/// its logarithmic derivatives by up to 5 % (measured, docs/fit-friction.md).
const COARSE_ELEMENTS: usize = 8;
/// Number of elements along the contact in the first search. Chosen: the search only has to find the right one of several minima.
const FIRST_SEARCH_ELEMENTS: usize = 5;
/// Relative error requested of the friction of the fine solutions that correct the coarse ones. Chosen, below the scatter of measured
/// friction.
const CORRECTION_ERROR: f64 = 5e-3;
/// Number of elements along the contact of a body with which its area, on which shear acts, is solved if that of the fine solution
/// has a larger error than [`CORRECTION_ERROR`]. Chosen: the area of a ball then has an error of 0.3 %.
const AREA_ELEMENTS: usize = 64;
/// Number of elements along the width of a contact in plane strain, for the same purpose. Chosen: the width then has an error of one
/// to two elements, 0.1 to 0.2 %.
const WIDTH_ELEMENTS: usize = 1024;
/// Relative error of friction requested of the one-dimensional model. Chosen, so small that differences of friction give
/// derivatives.
const LINE_ERROR: f64 = 1e-9;
/// Change of the natural logarithm of a parameter between the two materials whose difference of compliances enters the
/// adjoint method. Chosen: the truncation error is far below the 5 % by which coarse derivatives are off, and the difference
/// far above rounding.
const ADJOINT_STEP: f64 = 1e-5;
/// Change of the natural logarithm of a parameter for central differences of the friction of the one-dimensional model. Chosen:
/// the error of a derivative is about the ratio of [`LINE_ERROR`] to this step.
const DIFFERENCE_STEP: f64 = 1e-4;

/// The body on its model, which decide how the friction of a point is solved.
enum Forward<'a> {
    /// A finite body or a cylinder on the half space or layer.
    HalfSpace(SteadyBody<'a>),
    /// A body of revolution in the one-dimensional model.
    Line(&'a Revolution),
}

/// The parts of a friction μ = hysteresis + τ_f `area_over_force`, or a number of each of them.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Parts<T> {
    /// Friction coefficient from hysteresis.
    hysteresis: T,
    /// Contact area over normal force, \[1/Pa]; 0 in the one-dimensional model, which has no area.
    area_over_force: T,
}

/// The contact of a point.
struct Contact {
    parts: Parts<f64>,
    /// Derivatives of the logarithms of the parts by those of the free parameters of the material and of the shift law.
    slopes: Vec<Parts<f64>>,
}

/// Friction of all points as a function of the parameters of a family of scenes.
pub(super) struct Model<'a> {
    family: &'a Family<'a>,
    forward: Forward<'a>,
    /// Thickness of the elastomer, \[m]; infinite for a half space.
    thickness: f64,
    /// Length of the track after which the body returns, \[m]; `None` if it never does.
    track: Option<f64>,
    /// Force or depth of the scene, for points without a force of their own.
    control: Control,
    /// Number of elements along the contact in the coarse solutions. With it their friction is off by about 1 %, which the
    /// correction removes, and its logarithmic derivatives by up to 5 % (measured, docs/fit-friction.md).
    elements: usize,
    pub(super) points: Vec<FrictionPoint>,
    /// Fine solution of each point at the parameters of the last correction; none before the first.
    fine: Vec<Parts<Estimate>>,
    /// Ratio of the fine to the coarse solution of each point; 1 before the first correction.
    corrections: Vec<Parts<f64>>,
    /// The last error of the model; `None` if there was none.
    pub(super) refused: Mutex<Option<FrictionFitError>>,
}

/// Ratio of the fine to the coarse solution of a point before the first correction.
const NOT_CORRECTED: Parts<f64> = Parts {
    hysteresis: 1.0,
    area_over_force: 1.0,
};

/// The material at the parameters, and the pairs of materials with one parameter of the material decreased and increased by the
/// step of its logarithm.
struct Materials {
    own: Box<dyn Material>,
    beside: Vec<[Box<dyn Material>; 2]>,
}

impl<'a> Model<'a> {
    /// The model of measured points, not yet corrected. Refuses a time march, a given depth if moduli are free, and a body that
    /// is neither single nor a cylinder.
    pub(super) fn new(
        family: &'a Family<'a>,
        problem: &'a Problem,
        points: &[FrictionPoint],
    ) -> std::result::Result<Self, FrictionFitError> {
        let control = match problem.motion() {
            Motion::Sliding(load) if load.sliding_distance().is_none() => load.control(),
            _ => {
                let problem = "friction is fitted in the stationary state, without duration and sliding_distance: leave them out";
                return Err(SceneError::at("solve", problem).into());
            }
        };
        let is_known = family.n_of_material() == 0 || matches!(control, Control::NormalForce(_));
        if !is_known {
            let problem = "at a given depth the friction stays the same when all moduli are multiplied by one number, so that it does \
                           not tell them; give normal_force";
            return Err(SceneError::at("load.indentation_depth", problem).into());
        }
        let forward = forward(problem)?;
        if family.has_shear() && matches!(forward, Forward::Line(_)) {
            return Err(SceneError::at("interface", NO_AREA_ON_LINE).into());
        }
        Ok(Self {
            forward,
            family,
            thickness: problem.thickness(),
            track: problem.track(),
            control,
            elements: COARSE_ELEMENTS,
            points: points.to_vec(),
            fine: Vec::new(),
            corrections: vec![NOT_CORRECTED; points.len()],
            refused: Mutex::new(None),
        })
    }

    /// The model of every `step`-th point, beginning with the first, with [`FIRST_SEARCH_ELEMENTS`] along the contact.
    pub(super) fn every_nth_point(&self, step: usize) -> Self {
        let is_kept = |index: &usize| index.is_multiple_of(step);
        let places = || (0..self.points.len()).filter(is_kept);
        Self {
            forward: match self.forward {
                Forward::HalfSpace(body) => Forward::HalfSpace(body),
                Forward::Line(body) => Forward::Line(body),
            },
            points: places().map(|index| self.points[index]).collect(),
            fine: places()
                .filter_map(|index| self.fine.get(index).copied())
                .collect(),
            corrections: places().map(|index| self.corrections[index]).collect(),
            elements: FIRST_SEARCH_ELEMENTS,
            refused: Mutex::new(None),
            ..*self
        }
    }

    /// Computes the ratio of fine to coarse solution of every point at these logarithms of the parameters; of a fixed material only
    /// the fine solutions, once. Returns the largest relative error of the corrected friction. The one-dimensional model needs no
    /// correction.
    pub(super) fn correct(
        &mut self,
        parameters: &[f64],
    ) -> std::result::Result<f64, FrictionFitError> {
        if let Forward::Line(_) = self.forward {
            return Ok(LINE_ERROR);
        }
        if !self.family.is_material_fixed() || self.fine.is_empty() {
            let material = self.materials(parameters, false)?.own;
            let of_point = |_, point: &FrictionPoint| {
                let load = self.reduced_load(point, parameters)?;
                let fine = self.fine_solution(&*material, point, &load)?;
                if self.family.is_material_fixed() {
                    return Ok((fine, NOT_CORRECTED));
                }
                let coarse = self.coarse_parts(point, &self.coarse_solution(&*material, &load)?)?;
                let correction = Parts {
                    hysteresis: fine.hysteresis.value / coarse.hysteresis,
                    area_over_force: fine.area_over_force.value / coarse.area_over_force,
                };
                Ok((fine, correction))
            };
            (self.fine, self.corrections) = self.at_all_points(of_point)?.into_iter().unzip();
        }
        let strengths = self.family.strengths(&self.points, parameters)?;
        let errors = self.fine.iter().zip(strengths).map(|(fine, strength)| {
            let friction = fine.hysteresis + fine.area_over_force * strength.value;
            friction.error / friction.value
        });
        Ok(errors.fold(0.0, f64::max))
    }

    /// Applies a function to all points and their indices, in parallel; results are in the order of the points. The error is that
    /// of the first point that has one.
    fn at_all_points<T: Send>(
        &self,
        of_point: impl Fn(usize, &FrictionPoint) -> Result<T> + Sync,
    ) -> std::result::Result<Vec<T>, FrictionFitError> {
        let numbered = |(index, point): (usize, &FrictionPoint)| {
            of_point(index, point).map_err(|why| FrictionFitError::NotSolved {
                point: index + 1,
                velocity: point.velocity,
                why,
            })
        };
        #[cfg(feature = "rayon")]
        let found: Vec<_> = self.points.par_iter().enumerate().map(numbered).collect();
        #[cfg(not(feature = "rayon"))]
        let found: Vec<_> = self.points.iter().enumerate().map(numbered).collect();
        // If several points fail, the error of the first point is returned, independent of the order of computation.
        found.into_iter().collect()
    }

    /// The material at the logarithms of the parameters. With `with_neighbours` also those needed for derivatives by the
    /// parameters of the material.
    fn materials(
        &self,
        parameters: &[f64],
        with_neighbours: bool,
    ) -> std::result::Result<Materials, SceneError> {
        let n = if with_neighbours {
            self.family.n_of_material()
        } else {
            0
        };
        let beside = (0..n).map(|k| {
            let at = |side: f64| {
                let mut moved = parameters.to_vec();
                moved[k] += side * self.step();
                self.family.material(&moved)
            };
            Ok([at(-1.0)?, at(1.0)?])
        });
        Ok(Materials {
            own: self.family.material(parameters)?,
            beside: beside.collect::<std::result::Result<_, SceneError>>()?,
        })
    }

    /// Change of the logarithm of a parameter, or of the velocity, for the derivatives of this forward problem.
    const fn step(&self) -> f64 {
        match self.forward {
            Forward::Line(_) => DIFFERENCE_STEP,
            _ => ADJOINT_STEP,
        }
    }

    /// The load at the reference temperature with the same friction as the point: velocity a_T v, a given force divided by the
    /// factor b_T of the moduli, a given depth unchanged.
    fn reduced_load(&self, point: &FrictionPoint, parameters: &[f64]) -> Result<SlidingLoad> {
        let (shift, _) = self.family.shift_of(point, parameters)?;
        let factor = self.family.modulus_factor_of(point)?;
        let control = point
            .normal_force
            .map_or(self.control, Control::NormalForce);
        let control = match control {
            Control::NormalForce(force) => Control::NormalForce(force / factor),
            other => other,
        };
        self.at_speed(control, point.velocity * shift.exp())
    }

    /// A sliding load at a velocity \[m/s], on the track of the scene if it has one.
    fn at_speed(&self, control: Control, velocity: f64) -> Result<SlidingLoad> {
        let load = SlidingLoad::with(control, velocity)?;
        Ok(self.track.map_or(Ok(load), |track| load.on_track(track))?)
    }

    /// The body on the half space or layer; an error in the one-dimensional model.
    fn half_space_body(&self) -> Result<SteadyBody<'_>> {
        match self.forward {
            Forward::HalfSpace(body) => Ok(body),
            Forward::Line(_) => Err(no_derivatives(Method::MdrSteady)),
        }
    }

    /// Solution on a grid of `self.elements` along the contact, with its adjoint; an error in the one-dimensional model.
    fn coarse_solution(
        &self,
        material: &dyn Material,
        load: &SlidingLoad,
    ) -> Result<SensitivityOnGrid> {
        let layer = Layer::new(material, self.thickness).map_err(bem_halfspace::BemError::from)?;
        let body = self.half_space_body()?;
        let grid = steady_grid(body, &layer, load, self.elements)?;
        Ok(SensitivityOnGrid::new(body, &layer, load, &grid)?)
    }

    /// The parts of the friction of a point on a coarse grid; see [`SensitivityOnGrid::effective_area`] for its area.
    fn coarse_parts(&self, point: &FrictionPoint, grid: &SensitivityOnGrid) -> Result<Parts<f64>> {
        // At the temperature of the point the force is larger by the factor of the moduli, for the same area.
        let force = grid.normal_force() * self.family.modulus_factor_of(point)?;
        Ok(Parts {
            hysteresis: grid.friction_coefficient(),
            area_over_force: grid.effective_area() / force,
        })
    }

    /// The parts of the friction of a point with error estimates, hysteresis to the relative error [`CORRECTION_ERROR`].
    fn fine_solution(
        &self,
        material: &dyn Material,
        point: &FrictionPoint,
        load: &SlidingLoad,
    ) -> Result<Parts<Estimate>> {
        let layer = Layer::new(material, self.thickness).map_err(bem_halfspace::BemError::from)?;
        let body = self.half_space_body()?;
        let solve = |accuracy: Accuracy| steady(body, &layer, load, accuracy);
        let elements = match body {
            SteadyBody::Line(_) => WIDTH_ELEMENTS,
            SteadyBody::Body(_) => AREA_ELEMENTS,
        };
        // The request is for the error of hysteresis. That of the area may be larger, and falls as the elements become shorter.
        let found = solve(Accuracy::RelativeError(CORRECTION_ERROR))?;
        let of_area = if self.family.has_shear() && !found.contact_area.is_within(CORRECTION_ERROR)
        {
            solve(Accuracy::Elements(elements))?
        } else {
            found.clone()
        };
        let (area, force) = (of_area.contact_area, of_area.normal_force);
        let ratio = area.value / (force.value * self.family.modulus_factor_of(point)?);
        let relative_error = area.relative_error() + force.relative_error();
        Ok(Parts {
            hysteresis: found.friction_coefficient,
            area_over_force: Estimate::new(ratio, ratio * relative_error),
        })
    }

    /// Friction coefficient of the one-dimensional model, in closed form if there is one and the scene has no track.
    fn line_friction(
        &self,
        body: &Revolution,
        material: &dyn Material,
        load: &SlidingLoad,
    ) -> Result<f64> {
        let simple = simple(material)?;
        let closed = closed_line(simple.as_ref(), body, *load);
        let answer = match closed.ok().filter(|_| self.track.is_none()) {
            Some(closed) => closed(&SilentProgress)?,
            None => mdr::stationary(&**body, material, load, LINE_ERROR)?,
        };
        let friction = answer.friction_coefficient.map(|friction| friction.value);
        friction.ok_or_else(|| no_derivatives(answer.method))
    }

    /// The uncorrected contact of a point, with derivatives by the free numbers of the material and the constants of the shift law.
    /// The latter follow from the velocity a_T v: (∂ ln μ/∂ ln v)(∂ ln a_T/∂ ln C).
    fn contact(
        &self,
        materials: &Materials,
        point: &FrictionPoint,
        parameters: &[f64],
    ) -> Result<Contact> {
        let load = self.reduced_load(point, parameters)?;
        let (velocity, step) = (load.velocity(), self.step());
        let faster = [-1.0, 1.0].map(|side: f64| velocity * (side * step).exp());
        let (_, by_law) = self.family.shift_of(point, parameters)?;
        let own = &*materials.own;
        let per_log = |change: f64| change / (2.0 * step);
        // The one-dimensional model is so cheap and accurate that central differences of ln μ serve as derivatives.
        if let Forward::Line(body) = self.forward {
            let of = |material: &dyn Material, load: &SlidingLoad| {
                Ok::<f64, SolveError>(self.line_friction(body, material, load)?.ln())
            };
            let hysteresis = |hysteresis: f64| Parts {
                hysteresis,
                area_over_force: 0.0,
            };
            let slope = |[below, above]: &[Box<dyn Material>; 2]| {
                let change = of(&**above, &load)? - of(&**below, &load)?;
                Ok(hysteresis(per_log(change)))
            };
            let mut slopes: Vec<_> = materials.beside.iter().map(slope).collect::<Result<_>>()?;
            if self.family.shift_is_free() {
                let at = |velocity: f64| of(own, &self.at_speed(load.control(), velocity)?);
                let by_speed = per_log(at(faster[1])? - at(faster[0])?);
                slopes.extend(by_law.iter().map(|slope| hysteresis(by_speed * slope)));
            }
            return Ok(Contact {
                parts: hysteresis(of(own, &load)?.exp()),
                slopes,
            });
        }
        // On the half space one solution and its adjoint give the change between any two materials or speeds.
        let grid = self.coarse_solution(own, &load)?;
        let parts = self.coarse_parts(point, &grid)?;
        let between = |ends: [&dyn Material; 2], velocities: [f64; 2]| -> Result<Parts<f64>> {
            let change = grid.between_materials(ends, velocities)?;
            let area = match change.contact_area {
                None if self.family.has_shear() => return Err(SolveError::NoAreaDerivative),
                area => area.unwrap_or_default(),
            };
            let force = change.normal_force.unwrap_or_default() / grid.normal_force();
            Ok(Parts {
                hysteresis: per_log(change.friction_coefficient / parts.hysteresis),
                area_over_force: per_log(area - force),
            })
        };
        let mut slopes: Vec<_> = materials
            .beside
            .iter()
            .map(|[below, above]| between([&**below, &**above], [velocity; 2]))
            .collect::<Result<_>>()?;
        if self.family.shift_is_free() {
            let by_speed = between([own; 2], faster)?;
            slopes.extend(by_law.iter().map(|slope| Parts {
                hysteresis: by_speed.hysteresis * slope,
                area_over_force: by_speed.area_over_force * slope,
            }));
        }
        Ok(Contact { parts, slopes })
    }

    /// The corrected contacts of all points, which are the fine solutions if the material is fixed.
    fn contacts(&self, parameters: &[f64]) -> std::result::Result<Vec<Contact>, FrictionFitError> {
        if self.family.is_material_fixed() {
            let value = |fine: &Parts<Estimate>| Contact {
                parts: Parts {
                    hysteresis: fine.hysteresis.value,
                    area_over_force: fine.area_over_force.value,
                },
                slopes: Vec::new(),
            };
            return Ok(self.fine.iter().map(value).collect());
        }
        let materials = self.materials(parameters, true)?;
        self.at_all_points(|index, point| {
            let mut contact = self.contact(&materials, point, parameters)?;
            contact.parts.hysteresis *= self.corrections[index].hysteresis;
            contact.parts.area_over_force *= self.corrections[index].area_over_force;
            Ok(contact)
        })
    }

    /// Corrected friction of all points, with derivatives ∂ ln μ by the logarithms of all parameters.
    fn corrected_friction(
        &self,
        parameters: &[f64],
    ) -> std::result::Result<Vec<ModelledPoint>, FrictionFitError> {
        let strengths = self.family.strengths(&self.points, parameters)?;
        let contacts = self.contacts(parameters)?;
        let sheared = contacts.into_iter().zip(strengths);
        Ok(sheared
            .map(|(contact, strength)| contact.with_shear(&strength))
            .collect())
    }
}

impl Contact {
    /// The sum of hysteresis and shear, with derivatives by all parameters: those of the contact, then those of the shear strength.
    fn with_shear(&self, strength: &Strength) -> ModelledPoint {
        let hysteresis = self.parts.hysteresis;
        let shear = strength.value * self.parts.area_over_force;
        let friction = hysteresis + shear;
        let by_contact = self.slopes.iter().map(|slopes| {
            (hysteresis * slopes.hysteresis + shear * slopes.area_over_force) / friction
        });
        let by_strength = strength.slopes.iter().map(|slope| shear * slope / friction);
        ModelledPoint {
            friction_coefficient: friction,
            slopes: by_contact.chain(by_strength).collect(),
        }
    }
}

impl FrictionModel for Model<'_> {
    fn friction(&self, parameters: &[f64]) -> Option<Vec<ModelledPoint>> {
        match self.corrected_friction(parameters) {
            Ok(modelled) => Some(modelled),
            Err(why) => {
                *self.refused.lock().unwrap_or_else(PoisonError::into_inner) = Some(why);
                None
            }
        }
    }
}

/// Body and model of a problem. An error for periodic surfaces, and unless the body is one of revolution in the one-dimensional
/// model.
fn forward(problem: &Problem) -> std::result::Result<Forward<'_>, FrictionFitError> {
    match (problem.model(), problem.body()) {
        (Dimensions::Line, Body::Revolution(body)) => Ok(Forward::Line(body)),
        (Dimensions::HalfSpace, body) => {
            let none = || SceneError::at("indenter", ONE_BODY);
            Ok(Forward::HalfSpace(body.steady_body().ok_or_else(none)?))
        }
        _ => Err(SceneError::at("indenter", ONE_BODY).into()),
    }
}

/// Message if a fit has no forward model for the body of the scene.
const ONE_BODY: &str = "moduli are fitted to the friction of a single body or a cylinder on the half space, and of a body of revolution \
     in the one-dimensional model; give one of these";

/// Error if `method` gives no friction, or no derivatives of it.
const fn no_derivatives(method: Method) -> SolveError {
    SolveError::NoSensitivity { method }
}
