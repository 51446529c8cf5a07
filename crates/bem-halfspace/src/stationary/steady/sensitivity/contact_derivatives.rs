//! The contact on one grid with the derivatives of its quantities: friction, depth or force, area.
//!
//! Theory: the [module](super) and docs/sensitivity.md, "What is known of them".

use indenters::{Control, Surface};

use crate::BemError;
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::sensitivity::Change;
use crate::stationary::steady::sensitivity::basis::{Basis, KernelParameters};
use crate::stationary::steady::sensitivity::collocation_points::{
    CollocationPoints, FrictionSlope, Height, differences,
};
use crate::stationary::steady::sensitivity::correlation::Correlation;
use crate::stationary::steady::sensitivity::loaded_contact::{AdjointLoads, LoadedContact};
use crate::stationary::steady::sliding_creep::{CreepOverDistance, SlidingCreep};
use crate::stationary::steady::{Reuse, SteadyOptions, SteadySliding, solve_on_mesh};

/// Relative step of the central differences by all lengths of a body; chosen.
const DILATION_STEP: f64 = 1e-5;

/// A contact on one grid with the gradients of its quantities.
#[derive(Debug)]
pub(super) struct ContactDerivatives {
    /// The friction coefficient at which the derivatives are taken.
    pub(super) friction_coefficient: f64,
    points: CollocationPoints,
    /// Fraction of the load on each element, its image included.
    load_fractions: Vec<f64>,
    /// In this order: the friction; the depth under a force or the force at a depth, where it has a meaning; the two measures of the
    /// contact, its area and its boundary weight, unless the body has edges.
    gradients: Vec<QuantityGradient>,
    control: Control,
    n_unknowns: usize,
    /// True if the last two gradients are those of the measures.
    has_measures: bool,
    /// `None` under a body with edges, where the elements at the edges do not change sides, and where a larger scale does not enlarge
    /// the contact.
    pub(super) dilation: Option<Dilation>,
}

/// Derivatives by the logarithm of all lengths, on fixed elements, see the [module](super).
#[derive(Debug)]
pub(super) struct Dilation {
    /// Defect R of the scaling identity of each quantity but the measures: its derivative less the expected one.
    pub(super) defects: Vec<f64>,
    /// Derivative of the area.
    area: f64,
    /// Derivative of the boundary weight.
    boundary_weight: f64,
    /// Exact derivative of the logarithm of the area.
    area_exponent: f64,
}

impl Dilation {
    /// True if the dilated contact is larger, by both measures.
    fn is_growth(&self) -> bool {
        self.area > 0.0 && self.boundary_weight > 0.0
    }
}

/// The gradient of one quantity, in units of the mesh unless stated otherwise.
#[derive(Debug)]
struct QuantityGradient {
    /// The SI value of the unit of the quantity.
    unit: f64,
    /// By the height of each element, its image included.
    by_height: Vec<f64>,
    /// By the force or the depth, whichever is given; in SI units.
    by_load: f64,
    /// By the logarithm of the thickness of the layer, in SI units.
    by_log_thickness: f64,
    /// By the logarithm of the length of the track, in SI units.
    by_log_track: f64,
    basis: Basis,
}

/// A gradient whose correlation is not yet contracted with kernels.
struct UnassembledGradient {
    unit: f64,
    by_height: Vec<f64>,
    /// In units of the quantity.
    by_load: f64,
    correlation: Correlation,
}

/// A contact whose gradients are not yet assembled.
struct UnassembledState {
    friction_coefficient: f64,
    points: CollocationPoints,
    load_fractions: Vec<f64>,
    gradients: Vec<UnassembledGradient>,
    kernel: KernelParameters,
    n_unknowns: usize,
}

impl ContactDerivatives {
    /// The contacts on shifted grids of one spacing; each kernel is computed once for all of them.
    pub(super) fn on_grids(
        surface: &dyn Surface,
        loading: &Loading,
        grids: impl Iterator<Item = SteadyOptions>,
        reuse: &mut Reuse,
    ) -> Result<Vec<Self>, BemError> {
        // Solve the contacts and their adjoint equations.
        let mut unassembled = grids
            .map(|options| UnassembledState::new(surface, loading, options, reuse))
            .collect::<Result<Vec<_>, _>>()?;
        let Some(kernel) = unassembled.first().map(|one| one.kernel.clone()) else {
            return Ok(Vec::new());
        };

        // Contract the correlations of all contacts with the kernels.
        let correlations = unassembled
            .iter_mut()
            .flat_map(|one| &mut one.gradients)
            .map(|gradient| std::mem::take(&mut gradient.correlation))
            .collect();
        let bases = Basis::contract_all(correlations, &kernel);
        let by_reference: Vec<&Basis> = bases.iter().collect();
        let by_log_thickness = Basis::by_thickness(&by_reference)?;
        let by_log_track = Basis::by_track(&by_reference)?;

        // Assemble the gradients; then the defects of the scaling identity.
        let mut contracted = bases.into_iter().zip(by_log_thickness).zip(by_log_track);
        let assemble = |state: UnassembledState| -> Result<Self, BemError> {
            let gradients = state.gradients.into_iter().zip(&mut contracted).map(
                |(gradient, ((basis, by_log_thickness), by_log_track))| QuantityGradient {
                    unit: gradient.unit,
                    by_height: gradient.by_height,
                    by_load: gradient.unit * gradient.by_load,
                    by_log_thickness: gradient.unit * by_log_thickness,
                    by_log_track: gradient.unit * by_log_track,
                    basis,
                },
            );
            let mut assembled = Self {
                friction_coefficient: state.friction_coefficient,
                points: state.points,
                load_fractions: state.load_fractions,
                gradients: gradients.collect(),
                control: loading.control,
                n_unknowns: state.n_unknowns,
                has_measures: !loading.has_edges,
                dilation: None,
            };
            if assembled.has_measures {
                let dilation = assembled.by_dilation(surface, loading.strip)?;
                assembled.dilation = Some(dilation).filter(Dilation::is_growth);
            }
            Ok(assembled)
        };
        unassembled.into_iter().map(assemble).collect()
    }

    /// Derivatives by ln λ, with λ a factor on all lengths: of the body, the layer, the track and the sliding per time. The force grows
    /// like λ², in plane strain like λ.
    fn by_dilation(&self, surface: &dyn Surface, strip: Option<f64>) -> Result<Dilation, BemError> {
        // Central differences by the heights of the body alone, and by all its lengths.
        let stretched = |width: f64, height: f64| {
            move |[x, y]: [f64; 2]| height * surface.height([x / width, y / width])
        };
        let [smaller, larger] = [1.0 - DILATION_STEP, 1.0 + DILATION_STEP];
        let log_step = (larger / smaller).ln();
        let by_height = self.between_heights(&stretched(1.0, smaller), &stretched(1.0, larger))?;
        let by_lengths =
            self.between_heights(&stretched(smaller, smaller), &stretched(larger, larger))?;

        // Exponents of λ in the given load, and in the other one. The force on a strip is the force per length times its length.
        let force_exponent = if strip.is_some() { 1.0 } else { 2.0 };
        let (given, given_exponent, other_exponent) = match self.control {
            Control::NormalForce(force) => (force / strip.unwrap_or(1.0), force_exponent, 1.0),
            Control::IndentationDepth(depth) => (depth, 1.0, force_exponent),
        };

        // Compare with the scaling identity. On fixed elements the equations are linear: heights and given load together scale the
        // other load. The friction does not depend on λ; the measures are popped below.
        let has_other = self.gradients.len() > 3;
        let mut defects = Vec::new();
        for (index, gradient) in self.gradients.iter().enumerate() {
            let by_load = given * gradient.by_load;
            let derivative = by_lengths[index] / log_step
                + gradient.by_log_thickness
                + gradient.by_log_track
                + given_exponent * by_load
                + gradient.unit * gradient.basis.by_velocity();
            let expected = if index == 1 && has_other {
                other_exponent * (by_height[index] / log_step + by_load)
            } else {
                0.0
            };
            defects.push(derivative - expected);
        }
        let measures = pop_measures(&mut defects);
        Ok(Dilation {
            area: measures.area,
            boundary_weight: measures.boundary_weight,
            defects,
            area_exponent: force_exponent,
        })
    }

    /// The change from one body to another.
    pub(super) fn between_bodies(
        &self,
        [from, to]: [&dyn Surface; 2],
    ) -> Result<Change<f64>, BemError> {
        let changes = self.between_heights(&|point| from.height(point), &|point| to.height(point));
        Ok(self.with_moving_boundary(changes?))
    }

    /// The change of each quantity from one body to another, on fixed elements.
    fn between_heights(&self, from: Height, to: Height) -> Result<Vec<f64>, BemError> {
        let heights = differences(self.points.heights(from)?, &self.points.heights(to)?);
        let slope_terms = differences(
            self.points.explicit_slope_terms(from)?,
            &self.points.explicit_slope_terms(to)?,
        );
        let change = |gradient: &QuantityGradient| {
            gradient.unit * weighted_sum(&gradient.by_height, &heights)
        };
        let mut changes: Vec<f64> = self.gradients.iter().map(change).collect();
        if let Some(friction) = changes.first_mut() {
            *friction +=
                self.points.slope_unit() * weighted_sum(&self.load_fractions, &slope_terms);
        }
        Ok(changes)
    }

    /// The change from one material and velocity to another, on the base of the contact.
    pub(super) fn between_materials(
        &self,
        ends: [&SlidingCreep; 2],
    ) -> Result<Change<f64>, BemError> {
        // With as many retardation elements as here the derivatives by them suffice; otherwise contract both whole kernels.
        let [from, to] = ends.map(SlidingCreep::over_distance);
        if self.has_same_retardations(&from) && self.has_same_retardations(&to) {
            return Ok(self.by_basis(|basis| basis.between_creeps(&from, &to)));
        }
        let [from, to] = ends.map(|end| Basis::to_elastomer(&self.bases(), end));
        let pairs = from?.into_iter().zip(to?).zip(&self.gradients);
        let changes = pairs.map(|((from, to), gradient)| gradient.unit * (to - from));
        Ok(self.with_moving_boundary(changes.collect()))
    }

    /// The change from the elastomer of each contact to another; each kernel is computed once for all contacts.
    pub(super) fn all_to_elastomer(
        contacts: &[Self],
        creep: &SlidingCreep,
    ) -> Result<Vec<Change<f64>>, BemError> {
        let gradients = contacts.iter().flat_map(|contact| &contact.gradients);
        let bases: Vec<&Basis> = gradients.map(|gradient| &gradient.basis).collect();
        let mut changes = Basis::to_elastomer(&bases, creep)?.into_iter();
        let of_contact = |contact: &Self| {
            let pairs = contact.gradients.iter().zip(&mut changes);
            let changes = pairs.map(|(gradient, change)| gradient.unit * change);
            contact.with_moving_boundary(changes.collect())
        };
        Ok(contacts.iter().map(of_contact).collect())
    }

    /// The derivatives by the logarithms of the storage and of the loss modulus in each band of frequencies.
    pub(super) fn by_moduli(&self, bands: &[[f64; 2]]) -> Result<Vec<[Change<f64>; 2]>, BemError> {
        let of_band = |sums: Vec<[f64; 2]>| {
            [0, 1].map(|modulus| {
                let pairs = self.gradients.iter().zip(&sums);
                let changes = pairs.map(|(gradient, sums)| gradient.unit * sums[modulus]);
                self.with_moving_boundary(changes.collect())
            })
        };
        let sums = Basis::by_moduli(&self.bases(), bands)?;
        Ok(sums.into_iter().map(of_band).collect())
    }

    /// The derivative by the given force or depth.
    pub(super) fn by_load(&self) -> Change<f64> {
        self.by(|gradient| gradient.by_load)
    }

    /// The derivative by the logarithm of the velocity.
    pub(super) fn by_velocity(&self) -> Change<f64> {
        self.by_basis(Basis::by_velocity)
    }

    /// The derivative by the logarithm of the thickness of the layer.
    pub(super) fn by_thickness(&self) -> Change<f64> {
        self.by(|gradient| gradient.by_log_thickness)
    }

    /// The derivative by the logarithm of the length of the track.
    pub(super) fn by_track(&self) -> Change<f64> {
        self.by(|gradient| gradient.by_log_track)
    }

    /// Number of unknown pressures.
    pub(super) const fn n_unknowns(&self) -> usize {
        self.n_unknowns
    }

    /// The given force or depth.
    pub(super) const fn given(&self) -> f64 {
        let (Control::NormalForce(given) | Control::IndentationDepth(given)) = self.control;
        given
    }

    fn has_same_retardations(&self, creep: &CreepOverDistance) -> bool {
        let mut gradients = self.gradients.iter();
        gradients.all(|one| one.basis.has_same_retardations(creep))
    }

    fn bases(&self) -> Vec<&Basis> {
        self.gradients.iter().map(|one| &one.basis).collect()
    }

    fn by(&self, derivative: impl Fn(&QuantityGradient) -> f64) -> Change<f64> {
        self.with_moving_boundary(self.gradients.iter().map(derivative).collect())
    }

    fn by_basis(&self, change: impl Fn(&Basis) -> f64) -> Change<f64> {
        self.by(|gradient| gradient.unit * change(&gradient.basis))
    }

    /// Adds the effect of the moving contact boundary to changes of all quantities on fixed elements. It is −R times the change of the
    /// boundary weight over that by dilation, with the defects R of the scaling identity.
    fn with_moving_boundary(&self, mut changes: Vec<f64>) -> Change<f64> {
        let measures = self.has_measures.then(|| pop_measures(&mut changes));
        let known = self.dilation.as_ref().zip(measures);
        let contact_area = known.map(|(dilation, measures)| {
            // Growth of the contact in units of ln λ.
            let growth = measures.boundary_weight / dilation.boundary_weight;
            for (change, defect) in changes.iter_mut().zip(&dilation.defects) {
                *change -= growth * defect;
            }
            dilation.area_exponent * measures.area / dilation.area
        });
        // The quantities in their order.
        let mut changes = changes.into_iter();
        let friction_coefficient = changes.next().unwrap_or(f64::NAN);
        let other = changes.next();
        let (indentation_depth, normal_force) = match self.control {
            Control::NormalForce(_) => (other, None),
            Control::IndentationDepth(_) => (None, other),
        };
        Change {
            friction_coefficient,
            indentation_depth,
            normal_force,
            contact_area,
        }
    }
}

/// Changes of the two measures of a contact.
struct Measures {
    area: f64,
    boundary_weight: f64,
}

/// Removes the measures, which are the last two, from the quantities.
fn pop_measures(quantities: &mut Vec<f64>) -> Measures {
    let mut last = || quantities.pop().unwrap_or(f64::NAN);
    let boundary_weight = last();
    Measures {
        area: last(),
        boundary_weight,
    }
}

fn weighted_sum(weights: &[f64], values: &[f64]) -> f64 {
    let pairs = weights.iter().zip(values);
    pairs.map(|(weight, value)| weight * value).sum()
}

impl UnassembledState {
    /// Solves the contact on one grid, and the adjoint equations of its quantities.
    fn new(
        surface: &dyn Surface,
        loading: &Loading,
        options: SteadyOptions,
        reuse: &mut Reuse,
    ) -> Result<Self, BemError> {
        let (mesh, solution) = solve_on_mesh(surface, loading, &options, reuse)?;
        reuse.solution = Some(SteadySliding::new(&mesh, &solution)?);
        // Slopes whose mean under the load is the friction.
        let contact = LoadedContact::new(&mesh, &solution, &mut reuse.plans)?;
        let points = CollocationPoints::new(&contact, loading);
        let slope_terms = points.explicit_slope_terms(&|point| surface.height(point))?;
        let slopes = match points.slope {
            FrictionSlope::Body => contact.slopes_of_body(slope_terms),
            _ => contact.slopes_of_surface(&slope_terms, &mut reuse.plans),
        };
        // Adjoint loads of all quantities.
        let (mean_slope, adjoint) = contact.adjoint(&slopes, &mut reuse.plans)?;
        let loads = contact.elements.iter().zip(&contact.loads);
        let load_fractions =
            loads.map(|(&element, load)| mesh.weight(element) * load / contact.total);
        let assembly = GradientAssembly {
            contact: &contact,
            loading,
            adjoint,
            slope: points.slope,
        };
        Ok(Self {
            friction_coefficient: mean_slope * points.slope_unit(),
            load_fractions: load_fractions.collect(),
            n_unknowns: contact.n_touching(),
            gradients: assembly.all(),
            kernel: KernelParameters::new(&loading.creep, &mesh)?,
            points,
        })
    }
}

/// What the gradients of one contact are made of.
struct GradientAssembly<'a> {
    contact: &'a LoadedContact<'a>,
    loading: &'a Loading,
    adjoint: AdjointLoads,
    slope: FrictionSlope,
}

impl GradientAssembly<'_> {
    /// The gradients in the order of [`ContactDerivatives::gradients`].
    fn all(&self) -> Vec<UnassembledGradient> {
        let Loading {
            control,
            strip,
            creep,
            depth_scale,
            ..
        } = self.loading;
        // The quantities that depend on the depth, in terms of the derivative of the total load by the depth.
        let stiffness = self.contact.sum(&self.adjoint.depth);
        let other = match control {
            Control::NormalForce(_) => {
                let has_depth = creep.fluidity() <= 0.0 && strip.is_none();
                let by_load = self.load_per_force() / stiffness;
                has_depth
                    .then(|| self.proportional_to_depth(*depth_scale, stiffness.recip(), by_load))
            }
            Control::IndentationDepth(_) => {
                let unit = self.contact.mesh.loading.force_of(1.0);
                Some(self.proportional_to_depth(unit, -1.0, stiffness / depth_scale))
            }
        };

        // All gradients in their order.
        let mut gradients = vec![self.friction(stiffness)];
        gradients.extend(other);
        let measures = self.contact.measures().zip(&self.adjoint.measures);
        gradients.extend(measures.map(|(measure, by_loads)| {
            let mut gradient = self.function_of_loads(by_loads, 1.0, stiffness);
            gradient.correlation = gradient
                .correlation
                .with_second_difference(measure.by_second_difference);
            gradient
        }));
        gradients
    }

    /// Total load in the units of the mesh per unit of the given force, or depth.
    fn load_per_force(&self) -> f64 {
        let Loading { control, strip, .. } = self.loading;
        let (Control::NormalForce(given) | Control::IndentationDepth(given)) = control;
        self.contact.total * strip.unwrap_or(1.0) / given
    }

    fn friction(&self, stiffness: f64) -> UnassembledGradient {
        let unit = self.loading.depth_scale / self.contact.mesh.options.spacing[0];
        let mut gradient = self.function_of_loads(&self.adjoint.friction, unit, stiffness);
        if self.slope != FrictionSlope::Body {
            gradient.correlation = gradient.correlation.plus(&self.contact.slope_correlation());
        }
        gradient
    }

    /// The gradient of a function of the loads, from its adjoint loads.
    fn function_of_loads(
        &self,
        by_loads: &[f64],
        unit: f64,
        stiffness: f64,
    ) -> UnassembledGradient {
        let by_depth = self.contact.sum(by_loads);
        // Under a force the depth δ is a further unknown: add the constant that keeps the total load.
        let (constant, by_load) = match self.loading.control {
            Control::NormalForce(_) => (
                by_depth / stiffness,
                by_depth / stiffness * self.load_per_force(),
            ),
            Control::IndentationDepth(_) => (0.0, by_depth / self.loading.depth_scale),
        };
        let pairs = by_loads.iter().zip(&self.adjoint.depth);
        let adjoint: Vec<f64> = pairs.map(|(one, depth)| constant * depth - one).collect();
        self.gradient(unit, &adjoint, by_load)
    }

    /// The gradient of a quantity whose adjoint loads are `factor` times those of the depth.
    fn proportional_to_depth(&self, unit: f64, factor: f64, by_load: f64) -> UnassembledGradient {
        let depth = self.adjoint.depth.iter();
        let adjoint: Vec<f64> = depth.map(|load| factor * load).collect();
        self.gradient(unit, &adjoint, by_load)
    }

    fn gradient(&self, unit: f64, adjoint: &[f64], by_load: f64) -> UnassembledGradient {
        let LoadedContact { mesh, elements, .. } = self.contact;
        let pairs = elements.iter().zip(adjoint);
        let by_height = pairs.map(|(&element, load)| mesh.weight(element) * load);
        UnassembledGradient {
            unit,
            by_height: by_height.collect(),
            by_load,
            correlation: self.contact.correlation(adjoint),
        }
    }
}
