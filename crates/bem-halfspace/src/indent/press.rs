//! One control, constant in time.
//!
//! While the contact grows, or stays as it is, a constant force acts on every material like the force F J(t) on a spring of
//! unit modulus, and a constant depth makes G(t) times its force (Lee & Radok 1960), with J and G taken
//! 2 (1 − ν) times as compliant. So one elastic contact is all that has to be solved.

use indenters::{Control, PressingLoad, Surface, contact_radius};
use numerics::{Accuracy, ErrorParts, Estimate};
use rheology::{Elastic, Material};

use super::elements_across;
use crate::bars::{self, Quantities, Resolution, Target};
use crate::error::{check_contact_elements, positive};
use crate::plan::GridPlan;
use crate::slide::PressureField;
use crate::stepping::{Route, Stepping};
use crate::{BemError, ContactOptions, GridOptions};

/// Elements along the contact after which the error asked for is given up.
const LARGEST_GRID: usize = 512;
/// Depth and force converge faster than that, cusps or not.
const ORDER: f64 = 1.0;

/// A contact under a control that was constant, on one grid.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct PressSolution {
    /// Depth of the lowest point, \[m].
    pub indentation_depth: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Area of the elements in contact, \[m²].
    pub contact_area: f64,
    /// Ends of the contact along x relative to the lowest point, \[m].
    pub contact_x: [f64; 2],
    /// Ends of the contact along y relative to the lowest point, \[m].
    pub contact_y: [f64; 2],
    /// Number of elements in contact.
    pub n_contact: usize,
    /// Iterations of the contact solver.
    pub iterations: usize,
    /// Pressure over the contact; none under a force on a material that creeps, where it depends on how the contact has
    /// grown.
    pub pressure: Option<PressureField>,
}

/// A contact under a control that was constant, with its error bars; an error of 0 says that the quantity is given.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct PressEstimate {
    /// Depth of the lowest point, \[m].
    pub indentation_depth: Estimate,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// What the error of the depth, or of the force where the depth is given, consists of.
    pub error_parts: ErrorParts,
    /// Contact area, \[m²].
    pub contact_area: Estimate,
    /// Largest pressure \[Pa], of smooth bodies of revolution, where the pressure is known; everywhere else it grows without
    /// limit on refinement, or is not known to have one.
    pub peak_pressure: Option<Estimate>,
    /// Error of the ends of the contact along x and y in [`finest`](Self::finest), \[m].
    pub contact_box_error: f64,
    /// The contact on the finest grid.
    pub finest: PressSolution,
    /// The finest grid.
    pub options: GridOptions,
}

/// Presses `surface` into a half space and waits until the material has come to rest, to a relative error of depth or
/// force, whichever is not given; or with a number of elements along the contact, about, and whatever error that has.
///
/// # Errors
/// [`BemError::NoEquilibrium`] for a material that flows; [`BemError::Indenter`] for a contact beyond the end of the body; [`BemError::DepthNotReached`] and [`BemError::ForceNotReached`]
/// with what was reached on the finest grid allowed; otherwise like [`press_on_grid`].
pub fn press(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    control: Control,
    accuracy: impl Into<Accuracy>,
) -> Result<PressEstimate, BemError> {
    estimate(
        &surface,
        &Spring::at_rest(material)?,
        control,
        accuracy.into(),
    )
}

/// Presses `surface` into a half space for a time, with a control that is constant from first touch on, to a relative error
/// of depth or force, whichever is not given; or with a number of elements along the contact, about.
///
/// # Errors
/// [`BemError::InvalidParameter`] where a depth was held for so long that no force is left; otherwise like [`press`].
pub fn indent(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    load: &PressingLoad,
    accuracy: impl Into<Accuracy>,
) -> Result<PressEstimate, BemError> {
    estimate(
        &surface,
        &Spring::after(material, load)?,
        load.control(),
        accuracy.into(),
    )
}

/// Like [`press`], on one grid.
///
/// # Errors
/// [`BemError::NoEquilibrium`]; [`BemError::InvalidParameter`] for numbers out of range; [`BemError::GridTooLarge`];
/// [`BemError::GridTooCoarse`] when the contact covers fewer than three elements along x or y;
/// [`BemError::ContactReachesBoundary`]; [`BemError::ContactNotConverged`]; [`BemError::InvalidHeight`];
/// [`BemError::Material`].
pub fn press_on_grid(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    control: Control,
    options: &GridOptions,
) -> Result<PressSolution, BemError> {
    Spring::at_rest(material)?.solve(&surface, control, options)
}

/// Like [`indent`], on one grid.
///
/// # Errors
/// As for [`press_on_grid`], and [`BemError::InvalidParameter`] where a depth was held for so long that no force is left.
pub fn indent_on_grid(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    load: &PressingLoad,
    options: &GridOptions,
) -> Result<PressSolution, BemError> {
    Spring::after(material, load)?.solve(&surface, load.control(), options)
}

/// The spring that stands for a material under a constant control.
struct Spring {
    /// 2 (1 − ν) J, or its inverse where the depth is given, \[1/Pa].
    compliance: f64,
    /// Whether its pressure is that of the material too.
    has_pressure: bool,
}

impl Spring {
    fn at_rest(material: &(impl Material + ?Sized)) -> Result<Self, BemError> {
        let modulus = material.relaxation().equilibrium_modulus();
        if modulus == 0.0 {
            return Err(BemError::NoEquilibrium);
        }
        Ok(Self {
            compliance: positive("2 (1 - ν) / G", material.half_space_factor() / modulus)?,
            has_pressure: true,
        })
    }

    fn after(material: &(impl Material + ?Sized), load: &PressingLoad) -> Result<Self, BemError> {
        let (factor, duration) = (material.half_space_factor(), load.duration());
        let creep = material.creep();
        let is_elastic = creep.elements().is_empty() && creep.fluidity() == 0.0;
        Ok(match load.control() {
            Control::NormalForce(_) => Self {
                compliance: factor * material.creep_compliance(duration)?,
                has_pressure: is_elastic,
            },
            Control::IndentationDepth(_) => {
                let stiffness = material.relaxation_modulus(duration)? / factor;
                Self {
                    compliance: positive("relaxation modulus of a depth held so long", stiffness)?
                        .recip(),
                    has_pressure: true,
                }
            }
        })
    }

    /// The control of the spring of unit modulus.
    fn scaled(&self, control: Control) -> Result<Control, BemError> {
        Ok(match control {
            Control::NormalForce(force) => {
                let force = positive("normal_force", force)?;
                Control::NormalForce(positive("compliance × force", force * self.compliance)?)
            }
            Control::IndentationDepth(depth) => {
                Control::IndentationDepth(positive("indentation_depth", depth)?)
            }
        })
    }

    fn solve(
        &self,
        surface: &dyn Surface,
        control: Control,
        options: &GridOptions,
    ) -> Result<PressSolution, BemError> {
        let spacing = positive("spacing along x", options.spacing[0])?;
        let step = (1.0, 0.0, self.scaled(control)?);
        let route = Route::through(std::iter::once(step), spacing)?;
        let leg = route.legs[0];
        let mut stepping = Stepping::new(surface, &Elastic::new(1.0)?, route, options)?;
        let instant = stepping.follow(leg)?;
        check_contact_elements(elements_across(&instant))?;
        let [contact_x, contact_y] = stepping.edges(&stepping.contact_bounds(), 0.0);
        let mut pressure = stepping.pressure()?;
        for value in &mut pressure.pressure {
            *value /= self.compliance;
        }
        Ok(PressSolution {
            indentation_depth: instant.indentation_depth,
            normal_force: match control {
                Control::NormalForce(force) => force,
                Control::IndentationDepth(_) => instant.normal_force / self.compliance,
            },
            contact_area: instant.n_contact as f64 * pressure.grid.element_area(),
            contact_x,
            contact_y,
            n_contact: instant.n_contact,
            iterations: instant.iterations,
            pressure: self.has_pressure.then_some(pressure),
        })
    }
}

fn estimate(
    surface: &dyn Surface,
    spring: &Spring,
    control: Control,
    accuracy: Accuracy,
) -> Result<PressEstimate, BemError> {
    let plan = GridPlan::pressed(surface, spring.scaled(control)?)?;
    let options = |elements: usize| {
        let spacing = 2.0 * plan.length() / elements as f64;
        GridOptions::new([spacing; 2], plan.footprint.widened(spacing))
    };
    let resolution = Resolution {
        accuracy,
        target: Target::Depth,
        largest: LARGEST_GRID,
        order: ORDER,
    };
    let resolved = bars::resolve(
        &resolution,
        |elements| {
            Ok((
                elements,
                spring.solve(surface, control, &options(elements))?,
            ))
        },
        |(_, state)| quantities(state),
        |elements, (_, state)| iteration_errors(elements, state),
    )?;
    let ((elements, finest), known) = (resolved.finest, resolved.estimates);
    let options = options(elements);
    if let Some(body) = surface.as_axisymmetric() {
        // Refuses a contact beyond the end of the body, as beyond the equator of a sphere.
        contact_radius(body, finest.indentation_depth)?;
    }
    let has_peak = finest.pressure.is_some() && bars::peak_has_limit(surface, &Elastic::new(1.0)?);
    Ok(PressEstimate {
        indentation_depth: bars::depth(control, known.indentation_depth),
        normal_force: bars::force(control, known.normal_force),
        error_parts: match control {
            Control::NormalForce(_) => resolved.parts.indentation_depth,
            Control::IndentationDepth(_) => resolved.parts.normal_force,
        },
        contact_area: known.contact_area,
        peak_pressure: has_peak.then_some(known.peak_pressure),
        contact_box_error: bars::of_box(options.spacing),
        finest,
        options,
    })
}

fn quantities(state: &PressSolution) -> Quantities<f64> {
    Quantities {
        friction_coefficient: 0.0,
        normal_force: state.normal_force,
        indentation_depth: state.indentation_depth,
        contact_area: state.contact_area,
        peak_pressure: state.pressure.as_ref().map_or(0.0, PressureField::largest),
    }
}

/// How much a residual of the size of the tolerance changes: the depth by as much, and the force by as many times that part
/// as there are elements along the contact.
fn iteration_errors(elements: usize, state: &PressSolution) -> Quantities<ErrorParts> {
    let tolerance = ContactOptions::default().tolerance;
    let part = |error: f64| ErrorParts {
        iteration: Some(tolerance * error),
        ..ErrorParts::NONE
    };
    Quantities {
        indentation_depth: part(state.indentation_depth),
        normal_force: part(elements as f64 * state.normal_force),
        ..Quantities::all(ErrorParts::NONE)
    }
}
