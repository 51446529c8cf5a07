//! Friction of the measured points as a function of the material parameters, with derivatives.
//!
//! On the half space each point is solved on one coarse grid. Its friction is multiplied by the ratio to a solution with an error
//! estimate at nearby parameters, because this ratio depends on them only weakly.

use std::sync::{Mutex, PoisonError};

use bem_halfspace::Layer;
use bem_halfspace::steady::sensitivity::SensitivityOnGrid;
use bem_halfspace::steady::{steady, steady_grid, steady_line, steady_line_grid};
use indenters::{Control, Cylinder, SlidingLoad, Surface};
use measurements::friction::{FrictionModel, FrictionPoint, ModelledPoint};
use numerics::{Estimate, SilentProgress};
#[cfg(feature = "rayon")]
use rayon::prelude::*;
use rheology::Material;

use super::FrictionFitError;
use super::family::Family;
use crate::scene::{Method, Model as Dimensions, SceneError};
use crate::solve::body::{Body, Revolution};
use crate::solve::half_space::simple;
use crate::solve::mdr;
use crate::solve::work::closed_line;
use crate::solve::{Motion, Problem, Result, SolveError};

/// Elements along the contact of the coarse solutions. Their friction is off by about 1 %, which the correction removes, and
/// its logarithmic derivatives by up to 5 % (measured, docs/fit-friction.md).
const COARSE_ELEMENTS: usize = 8;
/// Number of elements along the contact in the first search. Chosen: the search only has to find the right one of several minima.
const FIRST_SEARCH_ELEMENTS: usize = 5;
/// Relative error of friction requested of the fine solutions that correct the coarse ones. Chosen, below the scatter of measured
/// friction.
const CORRECTION_ERROR: f64 = 5e-3;
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
    /// A finite body on the half space or layer.
    Surface(&'a dyn Surface),
    /// A cylinder on the half space or layer, in plane strain.
    Cylinder(&'a Cylinder),
    /// A body of revolution in the one-dimensional model.
    Line(&'a Revolution),
}

/// Friction of all points as a function of the parameters of a family of materials.
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
    /// Ratio of the friction of the fine solution to that of the coarse one, for each point; 1 before the first correction.
    corrections: Vec<f64>,
    /// The last error of the model; `None` if there was none.
    pub(super) refused: Mutex<Option<FrictionFitError>>,
}

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
        Ok(Self {
            forward: forward(problem)?,
            family,
            thickness: problem.thickness(),
            track: problem.track(),
            control,
            elements: COARSE_ELEMENTS,
            points: points.to_vec(),
            corrections: vec![1.0; points.len()],
            refused: Mutex::new(None),
        })
    }

    /// The model of every `step`-th point, beginning with the first, with [`FIRST_SEARCH_ELEMENTS`] along the contact.
    pub(super) fn every_nth_point(&self, step: usize) -> Self {
        let is_kept = |index: &usize| index.is_multiple_of(step);
        let places = || (0..self.points.len()).filter(is_kept);
        Self {
            forward: match self.forward {
                Forward::Surface(surface) => Forward::Surface(surface),
                Forward::Cylinder(cylinder) => Forward::Cylinder(cylinder),
                Forward::Line(body) => Forward::Line(body),
            },
            points: places().map(|index| self.points[index]).collect(),
            corrections: places().map(|index| self.corrections[index]).collect(),
            elements: FIRST_SEARCH_ELEMENTS,
            refused: Mutex::new(None),
            ..*self
        }
    }

    /// Computes the ratio of fine to coarse friction of every point at these logarithms of the parameters. Returns the largest
    /// relative error of a fine solution, that of the corrected friction. The one-dimensional model needs no correction.
    pub(super) fn correct(
        &mut self,
        parameters: &[f64],
    ) -> std::result::Result<f64, FrictionFitError> {
        if let Forward::Line(_) = self.forward {
            return Ok(LINE_ERROR);
        }
        let materials = self.materials(parameters, false)?;
        let of_point = |point: &FrictionPoint| {
            let load = self.reduced_load(point, parameters)?;
            let coarse = self
                .coarse_solution(&*materials.own, &load)?
                .friction_coefficient();
            let fine = self.refined_friction(&*materials.own, &load)?;
            Ok((fine.value / coarse, fine.error / fine.value))
        };
        let found = self.at_all_points(of_point)?;
        let worst = found.iter().map(|(_, error)| *error).fold(0.0, f64::max);
        self.corrections = found.into_iter().map(|(ratio, _)| ratio).collect();
        Ok(worst)
    }

    /// Applies a function to all points, in parallel; results are in the order of the points. The error is that of the first
    /// point that has one.
    fn at_all_points<T: Send>(
        &self,
        of_point: impl Fn(&FrictionPoint) -> Result<T> + Sync,
    ) -> std::result::Result<Vec<T>, FrictionFitError> {
        let numbered = |(index, point): (usize, &FrictionPoint)| {
            of_point(point).map_err(|why| FrictionFitError::NotSolved {
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

    /// Solution on a grid of `self.elements` along the contact, with its adjoint; an error in the one-dimensional model.
    fn coarse_solution(
        &self,
        material: &dyn Material,
        load: &SlidingLoad,
    ) -> Result<SensitivityOnGrid> {
        let layer = Layer::new(material, self.thickness).map_err(bem_halfspace::BemError::from)?;
        Ok(match self.forward {
            Forward::Cylinder(cylinder) => {
                let grid = steady_line_grid(cylinder, &layer, load, self.elements)?;
                SensitivityOnGrid::of_line(cylinder, &layer, load, &grid)?
            }
            Forward::Surface(surface) => {
                let grid = steady_grid(surface, &layer, load, self.elements)?;
                SensitivityOnGrid::new(surface, &layer, load, &grid)?
            }
            Forward::Line(_) => return Err(no_derivatives(Method::MdrSteady)),
        })
    }

    /// Friction coefficient with an error estimate, to the relative error [`CORRECTION_ERROR`]; that of the one-dimensional
    /// model counts as exact.
    fn refined_friction(&self, material: &dyn Material, load: &SlidingLoad) -> Result<Estimate> {
        let layer = Layer::new(material, self.thickness).map_err(bem_halfspace::BemError::from)?;
        Ok(match self.forward {
            Forward::Cylinder(cylinder) => {
                steady_line(cylinder, &layer, load, CORRECTION_ERROR)?.friction_coefficient
            }
            Forward::Surface(surface) => {
                steady(surface, &layer, load, CORRECTION_ERROR)?.friction_coefficient
            }
            Forward::Line(body) => Estimate::exact(self.line_friction(body, material, load)?),
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

    /// Uncorrected friction μ; its derivatives ∂ ln μ/∂ ln θ by the free numbers θ of the material; and ∂ ln μ/∂ ln v, which is
    /// 0 unless the shift law is free.
    fn with_derivatives(
        &self,
        materials: &Materials,
        load: &SlidingLoad,
    ) -> Result<(f64, Vec<f64>, f64)> {
        let (velocity, step) = (load.velocity(), self.step());
        let faster = [-1.0, 1.0].map(|side: f64| velocity * (side * step).exp());
        // The one-dimensional model is so cheap and accurate that central differences of ln μ serve as derivatives.
        if let Forward::Line(body) = self.forward {
            let of = |material: &dyn Material, load: &SlidingLoad| {
                Ok::<f64, SolveError>(self.line_friction(body, material, load)?.ln())
            };
            let log = of(&*materials.own, load)?;
            let slope = |[below, above]: &[Box<dyn Material>; 2]| {
                Ok((of(&**above, load)? - of(&**below, load)?) / (2.0 * step))
            };
            let slopes = materials.beside.iter().map(slope).collect::<Result<_>>()?;
            let at = |velocity: f64| of(&*materials.own, &self.at_speed(load.control(), velocity)?);
            let by_speed = if self.family.shift_is_free() {
                (at(faster[1])? - at(faster[0])?) / (2.0 * step)
            } else {
                0.0
            };
            return Ok((log.exp(), slopes, by_speed));
        }
        // On the half space one solution and its adjoint give the change between any two materials or speeds.
        let grid = self.coarse_solution(&*materials.own, load)?;
        let friction = grid.friction_coefficient();
        let relative = |ends: [&dyn Material; 2], velocities: [f64; 2]| -> Result<f64> {
            let change = grid.between_materials(ends, velocities)?;
            Ok(change.friction_coefficient / (2.0 * step * friction))
        };
        let slopes = materials
            .beside
            .iter()
            .map(|[below, above]| relative([&**below, &**above], [velocity; 2]))
            .collect::<Result<_>>()?;
        let by_speed = if self.family.shift_is_free() {
            relative([&*materials.own; 2], faster)?
        } else {
            0.0
        };
        Ok((friction, slopes, by_speed))
    }

    /// Corrected friction of all points, with derivatives ∂ ln μ by the logarithms of all parameters. Those by the constants of
    /// the shift law follow from the velocity a_T v: (∂ ln μ/∂ ln v)(∂ ln a_T/∂ ln C).
    fn corrected_friction(
        &self,
        parameters: &[f64],
    ) -> std::result::Result<Vec<ModelledPoint>, FrictionFitError> {
        let materials = self.materials(parameters, true)?;
        let mut modelled = self.at_all_points(|point| {
            let load = self.reduced_load(point, parameters)?;
            let (friction, mut slopes, by_speed) = self.with_derivatives(&materials, &load)?;
            let (_, by_law) = self.family.shift_of(point, parameters)?;
            slopes.extend(by_law.iter().map(|slope| by_speed * slope));
            Ok(ModelledPoint {
                friction_coefficient: friction,
                slopes,
            })
        })?;
        for (point, correction) in modelled.iter_mut().zip(&self.corrections) {
            point.friction_coefficient *= correction;
        }
        Ok(modelled)
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
        (Dimensions::HalfSpace, Body::Cylinder(cylinder)) => Ok(Forward::Cylinder(cylinder)),
        (Dimensions::HalfSpace, body) if body.surface().is_some() => {
            let surface = body.surface();
            let none = || SceneError::at("indenter", ONE_BODY);
            Ok(Forward::Surface(surface.ok_or_else(none)?))
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
