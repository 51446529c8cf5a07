//! Pressing with a force or depth that is constant in time.
//!
//! While the contact does not shrink, a constant force F acts on every material like the force 2 (1 − ν) J(t) F on an elastic half
//! space of unit compliance, the *spring*. A constant depth causes G(t)/(2 (1 − ν)) times the force of the spring (Lee & Radok
//! 1960). So one elastic contact is all that has to be solved.

use std::f64::consts::{FRAC_1_PI, PI};

use indenters::{Axisymmetric, Control, FlatPunch, PressingLoad, Surface, line_radius};
use numerics::{ErrorParts, Request, positive};
use rheology::{Compressible, Elastic, Material as _};

use crate::elements::gap_field::GapField;
use crate::elements::pressure_field::PressureField;
use crate::error::check_contact_elements;
use crate::estimate::bars::{self, ContactEstimate, OnGrid, Resolution, Target};
use crate::estimate::plan::GridPlan;
use crate::estimate::quantities::Quantities;
use crate::estimate::refinement_limits::PRESS;
use crate::march::{March, Motion};
use crate::substrate::base::check_unchanged_moduli;
use crate::{Base, BemError, Elastomer, Footprint, GridOptions, Layer};

/// Convergence order that error estimates assume for depth and force. Chosen as a lower bound, which also holds under cusps; a
/// higher order makes bars narrower.
pub(super) const PRESSED_ORDER: f64 = 1.0;
/// Convergence order of the counted contact area without sliding. Derived: the longest straight runs of a smooth outline of n
/// elements have √n edges and are displaced by up to half an element, an error of √n/2 elements in an area of about n² elements.
pub(super) const PRESSED_AREA_ORDER: f64 = 1.5;
/// Factor on n^(−3/4) in the smallest relative error of depth or force, for n elements in contact.
///
/// Near the outline the pressure grows like the root of the distance, so that the outermost elements carry a part n^(−3/4) of the
/// force. Each of them is in contact or not as a whole, which different grids may have in common by chance. Measured: twice the
/// median deviation of the random scenes of docs/calibration.md. It has a case of `evidence tuning`.
const BOUNDARY_ERROR_FACTOR: f64 = 0.07;
/// Difference between the radius of a disc of elements and that of the flat punch that it replaces, in edges of an element.
///
/// Uniform pressures do not follow the singular pressure at the edge of the punch; the wider disc is as stiff as the punch.
/// Measured on a half space: with it, 160 to 512 elements along a disc err by 3e-5 to 5e-7 in the stiffness. An error of the
/// widening by a tenth moves the stiffness by 0.02 over the number of elements along the disc.
const PUNCH_WIDENING: f64 = 0.113;
/// Smallest number of elements along a disc that replaces a flat punch. Derived: with fewer, grids of different spacings have the
/// same disc, so that no error can be estimated.
const MIN_ELEMENTS_OF_DISC: usize = 4;

/// Upper bound of the memory per element of the symmetry-reduced domain, \[bytes]. Measured: a test compares it with the memory taken
/// (tests/it/memory.rs).
pub(super) const PRESS_BYTES_PER_ELEMENT: f64 = 600.0;

/// A contact under a control that was constant, on one grid.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct PressSolution {
    /// Depth of the lowest point, \[m].
    pub indentation_depth: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// [Area](PressureField::contact_area) of the contact, \[m²].
    pub contact_area: f64,
    /// Discretisation error of the contact area, because its outline lies anywhere within the outermost elements, \[m²].
    pub(crate) contact_area_uncertainty: f64,
    /// Measure of the singularity of the pressure along the outline of the contact: 1 under a flat punch, near 0 where the pressure
    /// vanishes like a root.
    pub(crate) edge_singularity: f64,
    /// Ends of the contact along x relative to the lowest point, \[m].
    pub contact_x: [f64; 2],
    /// Ends of the contact along y relative to the lowest point, \[m].
    pub contact_y: [f64; 2],
    /// Number of elements in contact.
    pub n_contact: usize,
    /// Iterations of the contact solver.
    pub iterations: usize,
    /// Pressure over the contact; `None` under a force on a material that creeps, where it depends on the history of the contact.
    pub pressure: Option<PressureField>,
    /// Gap around the contact; `None` if the body does not cover the box of the contact.
    pub gap: Option<GapField>,
}

/// A contact under a control that was constant, with its error bars.
pub type PressEstimate = ContactEstimate<PressSolution, GridOptions>;

/// Presses `surface` into a half space and waits until the material has come to rest. The accuracy is a relative error of the
/// depth if the force is given, or of the force if the depth is given. It may also be an approximate number of elements along the
/// contact.
///
/// ```
/// use bem_halfspace::indenters::PowerProfile;
/// use bem_halfspace::{Control, press, rheology::Elastic};
///
/// // Hertz (1882), with the modulus 2 G/(1 − ν) = 4 G of an incompressible half space.
/// let (ball, rubber) = (PowerProfile::paraboloid(50.0)?, Elastic::new(1e6)?);
/// let pressed = press(&ball, &rubber, Control::IndentationDepth(1e-4), 1e-2)?;
/// let hertz = 4.0 / 3.0 * 4e6 * 0.01_f64.sqrt() * 1e-4_f64.powf(1.5);
/// let force = pressed.normal_force;
/// assert!((force.value - hertz).abs() <= force.error && force.error <= 1e-2 * force.value);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BemError::NoEquilibrium`] for a material that flows; [`BemError::InvalidParameter`] for numbers out of range;
/// [`BemError::Indenter`] for a contact beyond the end of the body, and for heights that are NaN or −∞, or not 0 at the origin; [`BemError::NotReached`] with what was reached on the finest grid
/// allowed; [`BemError::GridTooLarge`]; [`BemError::GridTooCoarse`] when the contact covers fewer than three elements along x or y;
/// [`BemError::ContactReachesBoundary`]; [`BemError::ContactNotConverged`]; [`BemError::Material`].
pub fn press<'w>(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    control: Control,
    request: impl Into<Request<'w>>,
) -> Result<PressEstimate, BemError> {
    let spring = Spring::at_rest(elastomer)?;
    refine_press(surface, &spring, control, request.into())
}

/// Presses `surface` into a half space for a time, with a force or depth that is constant from first touch on. The accuracy is a
/// relative error of the depth if the force is given, or of the force if the depth is given. It may also be an approximate number
/// of elements along the contact.
///
/// ```
/// use bem_halfspace::indenters::PowerProfile;
/// use bem_halfspace::{Control, PressingLoad, indent, rheology::Viscous};
///
/// // A cone sinks into a dashpot as into a spring of the modulus η/t (Sneddon 1965): d² = (π/8) slope F t/η.
/// let (cone, fluid) = (PowerProfile::cone(0.5)?, Viscous::new(1e4)?);
/// let load = PressingLoad::new(Control::NormalForce(2.0), 10.0)?;
/// let depth = indent(&cone, &fluid, &load, 1e-2)?.indentation_depth.ok_or("a depth")?;
/// let sneddon = (std::f64::consts::PI / 8.0 * 0.5 * 2.0 * 10.0 / 1e4).sqrt();
/// assert!((depth.value - sneddon).abs() <= depth.error);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BemError::InvalidParameter`] where a depth was held for so long that no force is left; otherwise like [`press`].
pub fn indent<'w>(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &PressingLoad,
    request: impl Into<Request<'w>>,
) -> Result<PressEstimate, BemError> {
    let spring = Spring::after(elastomer, load)?;
    refine_press(surface, &spring, load.control(), request.into())
}

/// Upper bound of the memory of [`indent`] for a number of elements along the contact, \[bytes].
///
/// # Errors
/// As for [`indent`], before anything is solved.
pub fn indent_memory(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &PressingLoad,
    elements: usize,
) -> Result<f64, BemError> {
    let plan = Spring::after(elastomer, load)?.plan(surface, load.control())?;
    Ok(PRESS_BYTES_PER_ELEMENT * n_followed(surface, &pressed_grid(&plan, elements)))
}

/// Approximate number of elements of the symmetry-reduced domain of a grid, for the mirrors of a surface.
pub(super) fn n_followed(surface: &dyn Surface, options: &GridOptions) -> f64 {
    let mirrored = surface.mirrors().into_iter().filter(|mirrored| *mirrored);
    let followed: f64 = mirrored.map(|_| 0.5).product();
    followed * options.footprint.n_elements(options.spacing)
}

/// Grid of square elements, about `elements` of them along the pressed contact, which is twice as long as [`GridPlan::length`].
pub(super) fn pressed_grid(plan: &GridPlan, elements: usize) -> GridOptions {
    let spacing = 2.0 * plan.length() / elements as f64;
    GridOptions::new([spacing; 2], plan.footprint.widened(spacing))
}

/// The rectangle in which contact may occur at the end of a pressing load.
pub(crate) fn footprint_after(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &PressingLoad,
) -> Result<Footprint, BemError> {
    let plan = Spring::after(elastomer, load)?.plan(surface, load.control())?;
    Ok(plan.footprint)
}

/// The elastic contact that is equivalent to that of a material under a constant control (Lee & Radok 1960). It consists of an elastic
/// material of unit compliance, and of the factor from forces on the viscoelastic material to forces on the elastic one.
pub(super) struct Spring {
    /// Elastic material of the compliance 2 (1 − ν)/G = 1/Pa, with the Poisson ratio of the material.
    unit: Compressible,
    /// Base of the material: a half space of the same material, or a substrate.
    base: Base,
    /// Compliance 2 (1 − ν) J under a force, or 2 (1 − ν)/G at a depth, \[1/Pa].
    compliance: f64,
    /// True if the pressure of the material is that of the spring over the compliance.
    has_pressure: bool,
}

impl Spring {
    /// The spring of a material at equilibrium. Fails with [`BemError::NoEquilibrium`] for one that flows.
    fn at_rest(elastomer: &dyn Elastomer) -> Result<Self, BemError> {
        check_unchanged_moduli(elastomer)?;
        let material = elastomer.material();
        let modulus = material.relaxation().equilibrium_modulus();
        if modulus == 0.0 {
            return Err(BemError::NoEquilibrium);
        }
        let compliance = positive("2 (1 - ν) / G", material.half_space_factor() / modulus)?;
        Self::new(elastomer, compliance, true)
    }

    /// Spring of the compliance 2 (1 − ν) J \[1/Pa], with the Poisson ratio and the base of an elastomer.
    pub(super) fn new(
        elastomer: &dyn Elastomer,
        compliance: f64,
        has_pressure: bool,
    ) -> Result<Self, BemError> {
        let material = elastomer.material();
        let spring = Elastic::new(material.half_space_factor())?;
        Ok(Self {
            unit: Compressible::new(&spring, material.poisson_ratio())?,
            base: elastomer.base(),
            compliance,
            has_pressure,
        })
    }

    /// The spring as an elastomer: its elastic material on the base.
    fn layer(&self) -> Layer<'_, Compressible> {
        Layer::over(&self.unit, self.base.clone())
    }

    /// Plan of the grids for a body that is pressed into the material.
    pub(super) fn plan(
        &self,
        surface: &dyn Surface,
        control: Control,
    ) -> Result<GridPlan, BemError> {
        GridPlan::pressed(surface, &self.layer(), self.control_of_spring(control)?)
    }

    /// The spring that a material is equivalent to at the end of a load: its creep compliance under a force, its relaxation modulus
    /// at a depth.
    pub(super) fn after(elastomer: &dyn Elastomer, load: &PressingLoad) -> Result<Self, BemError> {
        check_unchanged_moduli(elastomer)?;
        let material = elastomer.material();
        // A force acts through the creep compliance, a depth through the relaxation modulus. If the material creeps under a force, the
        // pressure depends on the history, unlike force and depth.
        let (factor, duration) = (material.half_space_factor(), load.duration());
        let is_elastic = material.creep().is_elastic();
        match load.control() {
            Control::NormalForce(_) => {
                let compliance = factor * material.creep_compliance(duration)?;
                Self::new(elastomer, compliance, is_elastic)
            }
            Control::IndentationDepth(_) => {
                let stiffness = material.relaxation_modulus(duration)? / factor;
                let stiffness = positive("relaxation modulus of a depth held so long", stiffness)?;
                Self::new(elastomer, stiffness.recip(), true)
            }
        }
    }

    /// The control of the spring: a force times the compliance, or the same depth. Fails unless both are positive.
    fn control_of_spring(&self, control: Control) -> Result<Control, BemError> {
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

    /// Solves the contact of the spring on one grid, in one step of a march, and divides its pressures and forces by the compliance.
    fn solve(
        &self,
        surface: &dyn Surface,
        control: Control,
        options: &GridOptions,
    ) -> Result<PressSolution, BemError> {
        // On an elastic material one step of any duration is the static contact.
        let motion = Motion {
            time: 1.0,
            position: 0.0,
            control: self.control_of_spring(control)?,
        };
        let mut march = March::new(surface, &self.layer(), &[motion], options)?;
        let row = march.solve_first_step()?;
        check_contact_elements(march.elements_across())?;
        // Convert the contact of the spring to that of the material, whose pressures are those of the spring over the compliance.
        let [contact_x, contact_y] = march.contact_edges();
        let mut pressure = march.pressure()?;
        for value in &mut pressure.pressure {
            *value /= self.compliance;
        }
        Ok(PressSolution {
            indentation_depth: row.indentation_depth,
            normal_force: match control {
                Control::NormalForce(force) => force,
                Control::IndentationDepth(_) => row.normal_force / self.compliance,
            },
            contact_area: row.contact_area,
            contact_area_uncertainty: row.contact_area_uncertainty,
            edge_singularity: march.edge_singularity(),
            contact_x,
            contact_y,
            n_contact: row.n_contact,
            iterations: row.iterations,
            pressure: self.has_pressure.then_some(pressure),
            gap: march.gap()?,
        })
    }
}

/// Refines the contact of a spring until the depth, or the force at a given depth, has the error asked for.
///
/// A flat punch is replaced by a disc of elements that is as stiff ([`PUNCH_WIDENING`]); its contact area is exact.
fn refine_press(
    surface: &dyn Surface,
    spring: &Spring,
    control: Control,
    request: Request,
) -> Result<PressEstimate, BemError> {
    let plan = spring.plan(surface, control)?;
    let resolution = Resolution {
        goal: PRESS.goal(request, PRESSED_ORDER),
        control,
        target: Target::Depth,
        has_peak: spring.has_pressure && bars::peak_has_limit(surface, &spring.unit),
    };
    // A flat punch is replaced by a wider disc of whole elements, and keeps its own area.
    let punch = surface.as_axisymmetric().and_then(radius_of_punch);
    let solve = |elements: usize, _: &dyn Fn(f64)| {
        let mut options = pressed_grid(&plan, elements);
        let state = if let Some(radius) = punch {
            if elements < MIN_ELEMENTS_OF_DISC {
                let needed = MIN_ELEMENTS_OF_DISC;
                return Err(BemError::GridTooCoarse { elements, needed });
            }
            // Refuse more elements than a grid may have before counting those of a disc.
            options.footprint.elements(options.spacing)?;
            let [spacing, wider] = disc_of_elements(radius, elements);
            options.spacing = [spacing; 2];
            let mut state = spring.solve(&FlatPunch::new(wider)?, control, &options)?;
            state.contact_area = PI * radius * radius;
            state.contact_area_uncertainty = 0.0;
            state.edge_singularity = 0.0;
            state
        } else {
            spring.solve(surface, control, &options)?
        };
        Ok(state.on_grid(control, options, elements))
    };
    bars::resolve(&resolution, solve, |estimate: PressEstimate| {
        if let Some(body) = surface.as_axisymmetric() {
            // Refuse a contact beyond the end of the body, as beyond the equator of a sphere.
            line_radius(body, estimate.finest.indentation_depth)?;
        }
        Ok(estimate)
    })
}

/// The radius of a flat punch, \[m]; `None` for any other body.
fn radius_of_punch(body: &dyn Axisymmetric) -> Option<f64> {
    let radius = body.max_radius();
    (radius.is_finite() && body.profile_height(radius) <= 0.0).then_some(radius)
}

/// [spacing, radius of a disc] for a flat punch of a `radius`, with about `elements` elements along it; the disc is wider than the
/// punch by [`PUNCH_WIDENING`] elements; lengths in \[m].
///
/// The spacing is such that the elements with their centres in the disc have exactly its area. On other spacings the two areas differ
/// by about the root of the number of elements.
fn disc_of_elements(radius: f64, elements: usize) -> [f64; 2] {
    // This closure counts the elements whose centres lie within a radius (Gauss circle problem). Its argument is the square of
    // the radius in elements.
    let within = |square: f64| {
        let row = |place: u32| (square - f64::from(place).powi(2)).sqrt().floor();
        let rows = (1_u32..).map(row).take_while(|half| *half >= 0.0);
        2.0 * row(0) + 1.0 + rows.map(|half| 2.0 * (2.0 * half + 1.0)).sum::<f64>()
    };
    // Search for the first radius at which the disc has the area of its elements. Squared distances of centres are integers, so
    // that the count is constant between two integers.
    let mut square = (0.5 * elements as f64).powi(2).ceil();
    loop {
        let squared_radius = within(square) * FRAC_1_PI;
        if (square..square + 1.0).contains(&squared_radius) {
            let wide = squared_radius.sqrt();
            let spacing = radius / (wide - PUNCH_WIDENING);
            return [spacing, wide * spacing];
        }
        square += 1.0;
    }
}

impl PressSolution {
    /// Input of [`bars::resolve`] for one grid: the solution, and the errors that differences between grids do not reveal.
    ///
    /// A residual of the relative size ε of the contact tolerance changes the depth by the fraction ε, and the force at a given
    /// depth by the fraction n ε on n elements along the contact.
    fn on_grid(
        self,
        control: Control,
        options: GridOptions,
        elements: usize,
    ) -> OnGrid<Self, GridOptions> {
        let (target, tolerance_factor) = match control {
            Control::NormalForce(_) => (self.indentation_depth, 1.0),
            Control::IndentationDepth(_) => (self.normal_force, elements as f64),
        };
        let n_contact = self.n_contact as f64;
        // Where the pressure is singular, the outline is that of the elements: it is too narrow by the widening of a punch, and
        // the number of elements scatters. The perimeter correction of the area holds only for pressures that vanish like a root.
        let excess = n_contact * options.spacing.iter().product::<f64>() - self.contact_area;
        let edge_error = self.edge_singularity
            * (PUNCH_WIDENING * (PI / n_contact).sqrt()
                + 0.5 * self.contact_area_uncertainty / self.contact_area);
        OnGrid {
            quantities: Quantities {
                friction_coefficient: 0.0,
                normal_force: self.normal_force,
                indentation_depth: self.indentation_depth,
                contact_area: self.contact_area,
                peak_pressure: self.pressure.as_ref().map_or(0.0, PressureField::largest),
            },
            common_error: ErrorParts {
                iteration: Some(options.contact.tolerance * tolerance_factor * target),
                ..ErrorParts::NONE
            },
            target_uncertainty: (BOUNDARY_ERROR_FACTOR * n_contact.powf(-0.75) + edge_error)
                * target.abs(),
            area_uncertainty: self.contact_area_uncertainty + self.edge_singularity * excess,
            area_order: Some(PRESSED_AREA_ORDER),
            spacing: options.spacing[0],
            state: self,
            options,
        }
    }
}
