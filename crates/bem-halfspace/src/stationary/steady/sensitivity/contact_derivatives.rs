//! The contact on one grid with the derivatives of its quantities: friction, depth or force, area.
//!
//! All derivatives are those under a constant force; those at a constant depth follow from them, because the force is a parameter.
//!
//! Theory: the [module](super) and docs/theory/sensitivities.md, "How they are computed".

use indenters::{Control, Surface};

use crate::BemError;
use crate::elements::contact_boundary::BoundaryDerivatives;
use crate::parallel::reductions::dot;
use crate::stationary::change::Change;
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::sensitivity::collocation_points::{
    CollocationPoints, FrictionSlope, Height, differences,
};
use crate::stationary::steady::sensitivity::kernel_gradient::{
    GridKernel, KernelGradient, LENGTH_STEP,
};
use crate::stationary::steady::sensitivity::loaded_contact::LoadedContact;
use crate::stationary::steady::{Reuse, SteadyOptions, SteadySliding, solve_on_mesh};

/// A contact on one grid with the gradients of its quantities.
#[derive(Debug)]
pub(super) struct ContactDerivatives {
    /// The friction coefficient at which the derivatives are taken.
    pub(super) friction_coefficient: f64,
    /// Points at which the body enters the equations.
    points: CollocationPoints,
    /// Gradients of all quantities on fixed elements, under a constant force; that of the area is not yet one of its logarithm.
    gradients: Change<Gradient>,
    /// Gradient of the boundary weight; `None` under a body with edges.
    boundary_weight: Option<Gradient>,
    /// The given force \[N] or depth \[m].
    control: Control,
    /// Normal force, \[N]; in plane strain per length, \[N/m].
    pub(super) normal_force: f64,
    /// Contact area as the pressure weights it, \[m²]; in plane strain a width, \[m].
    pub(super) effective_area: f64,
    /// Indentation depth, \[m].
    depth: f64,
    /// Number of unknown pressures.
    pub(super) n_unknowns: usize,
    /// Derivatives by the scale of all lengths. `None` under a body with edges, where the elements at the edges do not change
    /// sides, and where a larger scale does not enlarge the contact.
    pub(super) dilation: Option<Dilation>,
}

/// Derivatives by the logarithm of all lengths, on fixed elements, see the [module](super).
#[derive(Debug)]
pub(super) struct Dilation {
    /// Defects R of the scaling identity of friction and depth: the derivative less the expected one.
    pub(super) defects: Change<f64>,
    /// Derivative of the area, in elements.
    area: f64,
    /// Derivative of the boundary weight.
    boundary_weight: f64,
    /// Exact derivative of the logarithm of the area.
    area_exponent: f64,
}

/// The gradient of one quantity on fixed elements under a constant force, in SI units.
#[derive(Debug)]
pub(super) struct Gradient {
    /// Derivatives by the height of each element, its image included; heights are in units of the depth scale.
    by_height: Vec<f64>,
    /// Derivatives by the explicit slope term of each element; empty for all quantities but the friction.
    by_slope_term: Vec<f64>,
    /// Derivative by the normal force, in plane strain per length.
    by_force: f64,
    /// Derivatives by the kernel.
    pub(super) kernel: KernelGradient,
}

impl Gradient {
    /// The change of the quantity by changes of heights and explicit slope terms, to first order.
    fn change_by_body(&self, heights: &[f64], slope_terms: &[f64]) -> f64 {
        dot(&self.by_height, heights) + dot(&self.by_slope_term, slope_terms)
    }
}

impl ContactDerivatives {
    /// Solves the contact on one grid, and the adjoint equations of its quantities; the kernel is still to be contracted.
    pub(super) fn new(
        surface: &dyn Surface,
        loading: &Loading,
        options: &SteadyOptions,
        reuse: &mut Reuse,
    ) -> Result<Self, BemError> {
        let (mesh, solution) = solve_on_mesh(surface, loading, options, reuse)?;
        reuse.solution = Some(SteadySliding::new(&mesh, &solution)?);

        // Derive each quantity by the loads and gaps: the mean slope, the total load at a unit depth, and the area and boundary weight.
        let mut contact = LoadedContact::new(&mesh, &mut reuse.plans, &solution);
        let points = CollocationPoints::new(&mesh, &contact.elements, loading);
        let slope_terms = points.explicit_slope_terms(&|point| surface.height(point))?;
        let friction = contact.mean_slope(points.slope, slope_terms);
        let mut unit_depth = vec![1.0; contact.n_touching];
        unit_depth.resize(contact.elements.len(), 0.0);
        let boundary = (!loading.has_edges)
            .then(|| contact.boundary())
            .transpose()?;
        let measures = boundary
            .as_ref()
            .map(|boundary| [&boundary.area, &boundary.boundary_weight]);
        let mut derivatives = vec![&friction.by_loads[..], &unit_depth];
        derivatives.extend(measures.iter().flatten().map(|one| &one.by_values[..]));

        // Solve for the adjoint loads of all quantities. Those of a unit depth keep the force constant.
        let adjoint = contact.adjoint_loads(&derivatives)?;
        let system = BorderedSystem {
            unit_depth: &adjoint[1],
            stiffness: contact.sum(&adjoint[1]),
            force_per_load: mesh.loading.force_of(1.0) / loading.strip.unwrap_or(1.0),
            compliance: loading.creep.compliance(options.spacing[0])?,
            contact: &contact,
        };
        let squared_loads = dot(&contact.weighted_by_images(&contact.loads), &contact.loads);
        let element = options.spacing[0] * options.spacing[1] / loading.strip.unwrap_or(1.0);
        // Form the gradients on fixed elements. The friction also depends on the body and the kernel explicitly.
        let has_depth = loading.creep.fluidity() <= 0.0 && loading.strip.is_none();
        let mut gradients = Change {
            friction_coefficient: system.gradient(&adjoint[0], points.slope_unit()),
            indentation_depth: has_depth.then(|| system.depth_gradient(loading.depth_scale)),
            normal_force: None,
            contact_area: measures.map(|[area, _]| system.measure_gradient(&adjoint[2], area)),
        };
        // Add the explicit terms of the friction: slopes of the body or of the displacements.
        let by_slope_term = contact.weighted_by_images(&contact.loads).into_iter();
        let slope_factor = points.slope_unit() / contact.total;
        let friction_gradient = &mut gradients.friction_coefficient;
        friction_gradient.by_slope_term = by_slope_term.map(|load| slope_factor * load).collect();
        if points.slope != FrictionSlope::Body {
            let slopes = contact.correlation(&contact.loads).slope();
            let factor = slope_factor / system.compliance;
            friction_gradient
                .kernel
                .correlation
                .add_scaled(factor, &slopes);
        }
        Ok(Self {
            friction_coefficient: friction.value * points.slope_unit(),
            points,
            gradients,
            boundary_weight: measures
                .map(|[_, weight]| system.measure_gradient(&adjoint[3], weight)),
            control: loading.control,
            normal_force: system.force_per_load * contact.total,
            effective_area: element * contact.total.powi(2) / squared_loads,
            depth: loading.depth_scale * solution.depth,
            n_unknowns: contact.n_touching,
            dilation: None,
        })
    }

    /// The derivatives by the kernel of all quantities.
    pub(super) fn kernel_gradients(&mut self) -> impl Iterator<Item = &mut KernelGradient> {
        let Change {
            friction_coefficient,
            indentation_depth,
            contact_area,
            ..
        } = &mut self.gradients;
        let optional = [indentation_depth, contact_area, &mut self.boundary_weight];
        let all = std::iter::once(friction_coefficient).chain(optional.into_iter().flatten());
        all.map(|gradient| &mut gradient.kernel)
    }

    /// Finds the derivatives by ln λ, with λ a factor on all lengths: of the body, the layer, the track and the sliding per time. The
    /// force grows like λ², in plane strain like λ.
    pub(super) fn find_dilation(
        &mut self,
        surface: &dyn Surface,
        strip: Option<f64>,
        kernel: &GridKernel,
    ) -> Result<(), BemError> {
        let Some((area, boundary_weight)) = self
            .gradients
            .contact_area
            .as_ref()
            .zip(self.boundary_weight.as_ref())
        else {
            return Ok(());
        };
        // Stretch all lengths of the body by a factor, and take central differences of heights and slope terms by its logarithm.
        let stretched =
            |factor: f64| move |[x, y]: [f64; 2]| factor * surface.height([x / factor, y / factor]);
        let ends = [1.0 - LENGTH_STEP, 1.0 + LENGTH_STEP];
        let by_body = self.between_heights(&stretched(ends[0]), &stretched(ends[1]))?;
        let log_step = (ends[1] / ends[0]).ln();

        // Compare with the scaling identity. If all lengths grow by the factor λ, the friction does not change, and the depth is
        // proportional to λ.
        let force_exponent = if strip.is_some() { 1.0 } else { 2.0 };
        let by_velocity = kernel.by_velocity();
        let derivative = |gradient: &Gradient| {
            by_body(gradient) / log_step
                + gradient.kernel.by_log_thickness
                + gradient.kernel.by_log_track
                + force_exponent * self.normal_force * gradient.by_force
                + gradient.kernel.by_creep(&by_velocity)
        };
        let mut defects = self.gradients.map(derivative);
        if let Some(depth) = &mut defects.indentation_depth {
            *depth -= self.depth;
        }
        let dilation = Dilation {
            defects,
            area: derivative(area),
            boundary_weight: derivative(boundary_weight),
            area_exponent: force_exponent,
        };
        // The correction divides by both derivatives, so that a larger scale must enlarge the contact.
        let is_growth = dilation.area > 0.0 && dilation.boundary_weight > 0.0;
        self.dilation = is_growth.then_some(dilation);
        Ok(())
    }

    /// Returns a function that gives, for the gradient of a quantity, its change from one body to another on fixed elements.
    fn between_heights(
        &self,
        from: Height,
        to: Height,
    ) -> Result<impl Fn(&Gradient) -> f64 + use<>, BemError> {
        let heights = differences(self.points.heights(from)?, &self.points.heights(to)?);
        let slope_terms = differences(
            self.points.explicit_slope_terms(from)?,
            &self.points.explicit_slope_terms(to)?,
        );
        Ok(move |gradient: &Gradient| gradient.change_by_body(&heights, &slope_terms))
    }

    /// Change of all quantities to first order when one body replaces another, under the given force or at the given depth.
    pub(super) fn between_bodies(
        &self,
        bodies: [&dyn Surface; 2],
    ) -> Result<Change<f64>, BemError> {
        let [from, to] = bodies;
        let change = self.between_heights(&|point| from.height(point), &|point| to.height(point));
        Ok(self.total_change(change?))
    }

    /// Derivative of all quantities by the prescribed force, per newton, or by the prescribed depth, per metre.
    pub(super) fn by_load(&self) -> Change<f64> {
        let by_force = self.under_force(|gradient| gradient.by_force);
        match self.control {
            Control::NormalForce(_) => by_force,
            Control::IndentationDepth(_) => Change::by_depth(&by_force),
        }
    }

    /// The change of all quantities while the prescribed force or depth is held fixed. `on_fixed_elements(gradient)` is the change of
    /// one quantity on fixed elements under a constant force.
    pub(super) fn total_change(&self, on_fixed_elements: impl Fn(&Gradient) -> f64) -> Change<f64> {
        let under_force = self.under_force(on_fixed_elements);
        match self.control {
            Control::NormalForce(_) => under_force,
            Control::IndentationDepth(_) => {
                under_force.at_constant_depth(&self.under_force(|gradient| gradient.by_force))
            }
        }
    }

    /// The change of each quantity under a constant force: that on fixed elements plus the effect of the moving contact boundary. The
    /// latter is −R times the change of the boundary weight over that by dilation, with the defects R of the scaling identity.
    fn under_force(&self, on_fixed_elements: impl Fn(&Gradient) -> f64) -> Change<f64> {
        let fixed = self.gradients.map(&on_fixed_elements);
        let Some((dilation, weight)) = self.dilation.as_ref().zip(self.boundary_weight.as_ref())
        else {
            return Change {
                contact_area: None,
                ..fixed
            };
        };
        // Express the growth of the contact by the factor λ on all lengths that would cause it, as ln λ.
        let growth = on_fixed_elements(weight) / dilation.boundary_weight;
        let defects = &dilation.defects;
        let depth = fixed.indentation_depth.zip(defects.indentation_depth);
        let area = fixed.contact_area;
        Change {
            friction_coefficient: fixed.friction_coefficient
                - growth * defects.friction_coefficient,
            indentation_depth: depth.map(|(change, defect)| change - growth * defect),
            normal_force: None,
            contact_area: area.map(|change| dilation.area_exponent * change / dilation.area),
        }
    }
}

/// The adjoint equations of a contact under a constant force: bordered by the depth, which is a further unknown.
struct BorderedSystem<'a> {
    /// Elements, loads and kernel of the contact.
    contact: &'a LoadedContact<'a>,
    /// Adjoint loads of a unit depth.
    unit_depth: &'a [f64],
    /// Sum of the adjoint loads of a unit depth.
    stiffness: f64,
    /// Normal force of a unit of the total load, in plane strain per length.
    force_per_load: f64,
    /// Compliance over the length of an element, the unit of the kernel of the mesh, \[1/Pa].
    compliance: f64,
}

impl BorderedSystem<'_> {
    /// The gradient of a function of loads and gaps from its adjoint loads; `unit` is the SI value of its unit on the mesh.
    fn gradient(&self, adjoint: &[f64], unit: f64) -> Gradient {
        self.with_depth_response(adjoint, self.contact.sum(adjoint) / self.stiffness, unit)
    }

    /// Gradient of the depth \[m] by heights, force and kernel, for the unit `depth_scale` \[m] of depths on the mesh.
    fn depth_gradient(&self, depth_scale: f64) -> Gradient {
        let no_loads = vec![0.0; self.unit_depth.len()];
        self.with_depth_response(&no_loads, self.stiffness.recip(), depth_scale)
    }

    /// The gradient of a measure of the contact, its area or boundary weight, which also depends on the kernel explicitly.
    fn measure_gradient(&self, adjoint: &[f64], measure: &BoundaryDerivatives) -> Gradient {
        let mut gradient = self.gradient(adjoint, 1.0);
        let by_second_difference = measure.by_second_difference;
        gradient
            .kernel
            .correlation
            .add_second_difference(by_second_difference.map(|one| one / self.compliance));
        gradient
    }

    /// The gradient for the adjoint loads λ = η λ₁ − `adjoint`, with those λ₁ of a unit depth; `unit` as for
    /// [`gradient`](Self::gradient).
    fn with_depth_response(&self, adjoint: &[f64], eta: f64, unit: f64) -> Gradient {
        let pairs = adjoint.iter().zip(self.unit_depth);
        let loads: Vec<f64> = pairs
            .map(|(one, depth)| unit * (eta * depth - one))
            .collect();
        let mut correlation = self.contact.correlation(&loads);
        correlation.scale(self.compliance.recip());
        Gradient {
            by_height: self.contact.weighted_by_images(&loads),
            by_slope_term: Vec::new(),
            by_force: unit * eta / self.force_per_load,
            kernel: KernelGradient::new(correlation),
        }
    }
}
