//! One contact on one grid with the derivatives of its quantities.

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

/// Relative step of the differences by all lengths of a body.
const DILATION: f64 = 1e-5;

/// A contact, and what each of its quantities asks of a change.
#[derive(Debug)]
pub(super) struct State {
    /// Of which the derivatives are.
    pub(super) friction_coefficient: f64,
    points: CollocationPoints,
    /// Part of the load on each element, its image included.
    shares: Vec<f64>,
    /// Of the friction, of the depth under a force or the force at a depth, where that has a meaning, and, unless the body has
    /// edges, of the area and of the growth.
    gradients: Vec<QuantityGradient>,
    /// Of each of them by the logarithms of the thickness of a layer and of the length of a track.
    by_thickness: Vec<f64>,
    by_track: Vec<f64>,
    control: Control,
    n_unknowns: usize,
    /// Whether the last two gradients are those of the area and of the growth.
    has_measures: bool,
    /// None of a body with edges, whose elements at them stay where they are, and where the rim does not move as it must.
    pub(super) dilation: Option<Dilation>,
}

/// What the dilation of all lengths changes, with the elements where they are; see the [module](super).
#[derive(Debug)]
pub(super) struct Dilation {
    /// Of each quantity, beyond what it has to be.
    pub(super) excess: Vec<f64>,
    /// Of the area and of the growth.
    area: f64,
    growth: f64,
    /// Of the logarithm of the area, which is what it has to be.
    power_of_area: f64,
}

impl Dilation {
    /// Whether a dilation contact is the larger one, by both measures.
    fn is_growth(&self) -> bool {
        self.area > 0.0 && self.growth > 0.0
    }
}

/// A quantity in the units of the mesh.
#[derive(Debug)]
struct QuantityGradient {
    unit: f64,
    /// By the height of each element, its image included.
    by_height: Vec<f64>,
    /// By the force or the depth, whichever is given, both in SI.
    by_load: f64,
    basis: Basis,
}

/// A contact whose kernels are not assemble yet.
struct UnassembledState {
    friction_coefficient: f64,
    points: CollocationPoints,
    shares: Vec<f64>,
    unassembled_gradients: Vec<UnassembledGradient>,
    kernel: KernelParameters,
    n_unknowns: usize,
}

impl State {
    /// Those of shifted grids of one spacing, whose kernels are computed once for all.
    pub(super) fn all(
        surface: &dyn Surface,
        loading: &Loading,
        grids: impl Iterator<Item = SteadyOptions>,
        reuse: &mut Reuse,
    ) -> Result<Vec<Self>, BemError> {
        let unassembled =
            grids.map(|options| UnassembledState::new(surface, loading, options, reuse));
        let mut unassembled = unassembled.collect::<Result<Vec<_>, _>>()?;
        let Some(kernel) = unassembled.first().map(|one| one.kernel.clone()) else {
            return Ok(Vec::new());
        };
        let unassembled_gradients = unassembled
            .iter_mut()
            .flat_map(|one| &mut one.unassembled_gradients);
        let correlation: Vec<Correlation> = unassembled_gradients
            .map(|draft| std::mem::take(&mut draft.correlation))
            .collect();
        let bases = Basis::of_all(correlation, &kernel);
        let all: Vec<&Basis> = bases.iter().collect();
        let by_lengths = Basis::by_thickness(&all)?
            .into_iter()
            .zip(Basis::by_track(&all)?);
        let by_lengths: Vec<(f64, f64)> = by_lengths.collect();
        let mut sums = bases.into_iter().zip(by_lengths);
        let states = unassembled.into_iter().map(|one| {
            let mut state = one.assemble(&mut sums, loading);
            if state.has_measures {
                let dilation = state.dilation(surface, loading.strip)?;
                state.dilation = Some(dilation).filter(Dilation::is_growth);
            }
            Ok(state)
        });
        states.collect()
    }
}

impl UnassembledState {
    fn new(
        surface: &dyn Surface,
        loading: &Loading,
        options: SteadyOptions,
        reuse: &mut Reuse,
    ) -> Result<Self, BemError> {
        let (mesh, solution) = solve_on_mesh(surface, loading, &options, reuse)?;
        reuse.solution = Some(SteadySliding::new(&mesh, &solution)?);
        let contact = LoadedContact::new(&mesh, &solution, &mut reuse.plans)?;
        let points = CollocationPoints::new(&contact, loading);
        let own = points.explicit_slope_terms(&|point| surface.height(point))?;
        let slopes = match points.slope {
            FrictionSlope::Body => contact.slopes_of_body(own),
            _ => contact.slopes_of_surface(&own, &mut reuse.plans),
        };
        let (friction, adjoint) = contact.adjoint(&slopes, &mut reuse.plans)?;
        let shares = contact.elements.iter().zip(&contact.loads);
        let shares = shares.map(|(&element, load)| mesh.weight(element) * load / contact.total);
        let gradients = GradientAssembly {
            contact: &contact,
            loading,
            adjoint,
            slope: points.slope,
        };
        Ok(Self {
            friction_coefficient: friction * points.slope_unit(),
            shares: shares.collect(),
            n_unknowns: contact.n_touching(),
            unassembled_gradients: gradients.all(),
            kernel: KernelParameters::new(&loading.creep, &mesh)?,
            points,
        })
    }

    fn assemble(
        self,
        sums: &mut impl Iterator<Item = (Basis, (f64, f64))>,
        loading: &Loading,
    ) -> State {
        let (mut gradients, mut by_thickness, mut by_track) = (Vec::new(), Vec::new(), Vec::new());
        for (draft, (basis, (by_log_thickness, by_log_track))) in
            self.unassembled_gradients.into_iter().zip(sums)
        {
            by_thickness.push(draft.unit * by_log_thickness);
            by_track.push(draft.unit * by_log_track);
            gradients.push(QuantityGradient {
                unit: draft.unit,
                by_height: draft.by_height,
                by_load: draft.unit * draft.by_load,
                basis,
            });
        }
        State {
            friction_coefficient: self.friction_coefficient,
            points: self.points,
            shares: self.shares,
            gradients,
            by_thickness,
            by_track,
            control: loading.control,
            n_unknowns: self.n_unknowns,
            has_measures: !loading.has_edges,
            dilation: None,
        }
    }
}

impl State {
    /// The excess R of each quantity, and what the measures of the contact change by.
    fn dilation(&self, surface: &dyn Surface, strip: Option<f64>) -> Result<Dilation, BemError> {
        let scaled = |[wide, high]: [f64; 2]| {
            move |[x, y]: [f64; 2]| high * surface.height([x / wide, y / wide])
        };
        let changed = |[from, to]: [[f64; 2]; 2]| {
            let changes = self.between_heights([&scaled(from), &scaled(to)])?;
            let width = (to[1] / from[1]).ln();
            Ok::<_, BemError>(changes.into_iter().map(move |change| change / width))
        };
        let by_height = changed([[1.0, 1.0 - DILATION], [1.0, 1.0 + DILATION]])?;
        let by_lengths = changed([[1.0 - DILATION; 2], [1.0 + DILATION; 2]])?;
        // Powers of a length in the load that is given, and in the other one.
        let power_of_force = if strip.is_some() { 1.0 } else { 2.0 };
        let (given, power, power_of_other) = match self.control {
            // That on a strip is the force per length on all of it.
            Control::NormalForce(force) => (force / strip.unwrap_or(1.0), power_of_force, 1.0),
            Control::IndentationDepth(depth) => (depth, 1.0, power_of_force),
        };
        let by_lengths = by_lengths.zip(by_height).zip(&self.gradients);
        let mut excess = Vec::new();
        for (index, ((by_lengths, by_height), gradient)) in by_lengths.enumerate() {
            let by_load = given * gradient.by_load;
            let changed = by_lengths
                + self.by_thickness[index]
                + self.by_track[index]
                + power * by_load
                + gradient.unit * gradient.basis.by_velocity();
            // Equations with these elements are linear: heights and load together scale depth and force.
            let is_other = index == 1 && self.gradients.len() > 3;
            let expected = if is_other {
                power_of_other * (by_height + by_load)
            } else {
                0.0
            };
            excess.push(changed - expected);
        }
        let [area, growth] = measures_of(&mut excess);
        Ok(Dilation {
            area,
            growth,
            excess,
            power_of_area: power_of_force,
        })
    }
}

impl State {
    pub(super) fn between_bodies(
        &self,
        [from, to]: [&dyn Surface; 2],
    ) -> Result<Change<f64>, BemError> {
        let heights: [Height; 2] = [&|point| from.height(point), &|point| to.height(point)];
        Ok(self.of_all(self.between_heights(heights)?))
    }

    /// The change of each quantity with these elements.
    fn between_heights(&self, [from, to]: [Height; 2]) -> Result<Vec<f64>, BemError> {
        let heights = differences(self.points.heights(from)?, &self.points.heights(to)?);
        let slopes = differences(
            self.points.explicit_slope_terms(from)?,
            &self.points.explicit_slope_terms(to)?,
        );
        let gradients = self.gradients.iter();
        let changes = gradients.map(|one| one.unit * weighted(&one.by_height, &heights));
        let mut changes: Vec<f64> = changes.collect();
        if let Some(friction) = changes.first_mut() {
            *friction += self.points.slope_unit() * weighted(&self.shares, &slopes);
        }
        Ok(changes)
    }

    /// On the base of the state.
    pub(super) fn between_materials(
        &self,
        ends: [&SlidingCreep; 2],
    ) -> Result<Change<f64>, BemError> {
        let [from, to] = ends.map(SlidingCreep::over_distance);
        if [&from, &to]
            .iter()
            .all(|end| self.has_same_retardations(end))
        {
            return Ok(self.change(|basis| basis.between_creeps([&from, &to])));
        }
        let [from, to] = ends.map(|end| Basis::to_elastomer(&self.bases(), end));
        let pairs = from?.into_iter().zip(to?);
        let pairs = pairs.zip(&self.gradients);
        let changes = pairs.map(|((from, to), one)| one.unit * (to - from));
        Ok(self.of_all(changes.collect()))
    }

    /// From that of each state to another; the kernels are computed once for all.
    pub(super) fn all_to_elastomer(
        states: &[Self],
        creep: &SlidingCreep,
    ) -> Result<Vec<Change<f64>>, BemError> {
        let gradients = states.iter().flat_map(|state| &state.gradients);
        let bases: Vec<&Basis> = gradients.map(|one| &one.basis).collect();
        let mut changes = Basis::to_elastomer(&bases, creep)?.into_iter();
        let of = |state: &Self| {
            let pairs = state.gradients.iter().zip(&mut changes);
            state.of_all(pairs.map(|(one, change)| one.unit * change).collect())
        };
        Ok(states.iter().map(of).collect())
    }

    /// By the logarithms of the storage and of the loss modulus in each band of frequencies.
    pub(super) fn by_moduli(&self, bands: &[[f64; 2]]) -> Result<Vec<[Change<f64>; 2]>, BemError> {
        let of_band = |sums: Vec<[f64; 2]>| {
            [0, 1].map(|part| {
                let pairs = self.gradients.iter().zip(&sums);
                self.of_all(pairs.map(|(one, sums)| one.unit * sums[part]).collect())
            })
        };
        let sums = Basis::by_moduli(&self.bases(), bands)?;
        Ok(sums.into_iter().map(of_band).collect())
    }

    pub(super) fn by_load(&self) -> Change<f64> {
        self.of_all(self.gradients.iter().map(|one| one.by_load).collect())
    }

    /// By the logarithm of the velocity.
    pub(super) fn by_velocity(&self) -> Change<f64> {
        self.change(Basis::by_velocity)
    }

    pub(super) fn by_thickness(&self) -> Change<f64> {
        self.of_all(self.by_thickness.clone())
    }

    pub(super) fn by_track(&self) -> Change<f64> {
        self.of_all(self.by_track.clone())
    }

    pub(super) const fn n_unknowns(&self) -> usize {
        self.n_unknowns
    }

    /// The force or the depth, whichever is given.
    pub(super) const fn given(&self) -> f64 {
        let (Control::NormalForce(given) | Control::IndentationDepth(given)) = self.control;
        given
    }

    fn has_same_retardations(&self, creep: &CreepOverDistance) -> bool {
        self.gradients
            .iter()
            .all(|one| one.basis.has_same_retardations(creep))
    }

    fn bases(&self) -> Vec<&Basis> {
        self.gradients.iter().map(|one| &one.basis).collect()
    }

    fn change(&self, of: impl Fn(&Basis) -> f64) -> Change<f64> {
        let changes = self.gradients.iter();
        self.of_all(changes.map(|one| one.unit * of(&one.basis)).collect())
    }

    /// With the elements that the change brings into the contact.
    fn of_all(&self, mut changes: Vec<f64>) -> Change<f64> {
        let measures = self.has_measures.then(|| measures_of(&mut changes));
        let known = self.dilation.as_ref().zip(measures);
        let contact_area = known.map(|(dilation, [area, growth])| {
            let grown = growth / dilation.growth;
            for (change, excess) in changes.iter_mut().zip(&dilation.excess) {
                *change -= grown * excess;
            }
            dilation.power_of_area * area / dilation.area
        });
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

/// Takes the area and the growth, which are the last two, from the quantities.
fn measures_of(quantities: &mut Vec<f64>) -> [f64; 2] {
    let mut last = || quantities.pop().unwrap_or(f64::NAN);
    let growth = last();
    [last(), growth]
}

fn weighted(weights: &[f64], values: &[f64]) -> f64 {
    let pairs = weights.iter().zip(values);
    pairs.map(|(weight, value)| weight * value).sum()
}

/// Makes the derivatives of a contact.
struct GradientAssembly<'a> {
    contact: &'a LoadedContact<'a>,
    loading: &'a Loading,
    adjoint: AdjointLoads,
    slope: FrictionSlope,
}

/// A quantity whose kernel is not assemble yet.
struct UnassembledGradient {
    unit: f64,
    /// By the height of each element, its image included.
    by_height: Vec<f64>,
    /// In units of the quantity.
    by_load: f64,
    correlation: Correlation,
}

impl GradientAssembly<'_> {
    /// Of the friction, of the depth under a force or the force at a depth, of the area and of the growth.
    fn all(&self) -> Vec<UnassembledGradient> {
        let Loading {
            control,
            strip,
            creep,
            depth_scale,
            ..
        } = self.loading;
        // The derivative of the total load by the depth.
        let stiffness = self.contact.sum(&self.adjoint.depth);
        let other = match control {
            Control::NormalForce(_) => {
                let has_depth = creep.fluidity() <= 0.0 && strip.is_none();
                let by_load = self.per_newton() / stiffness;
                has_depth.then(|| self.of_depth(*depth_scale, stiffness.recip(), by_load))
            }
            Control::IndentationDepth(_) => {
                let unit = self.contact.mesh.loading.force_of(1.0);
                Some(self.of_depth(unit, -1.0, stiffness / depth_scale))
            }
        };
        let mut unassembled_gradients = vec![self.of_friction(stiffness)];
        unassembled_gradients.extend(other);
        let measures = self.contact.measures().zip(&self.adjoint.measures);
        unassembled_gradients.extend(measures.map(|(measure, by_loads)| {
            let mut draft = self.of_loads(by_loads, 1.0, stiffness);
            draft.correlation = draft.correlation.with_bend(measure.by_second_difference);
            draft
        }));
        unassembled_gradients
    }

    /// Total load in the units of the mesh per unit of the given force.
    fn per_newton(&self) -> f64 {
        let Loading { control, strip, .. } = self.loading;
        let (Control::NormalForce(given) | Control::IndentationDepth(given)) = control;
        self.contact.total * strip.unwrap_or(1.0) / given
    }

    fn of_friction(&self, stiffness: f64) -> UnassembledGradient {
        let unit = self.loading.depth_scale / self.contact.mesh.options.spacing[0];
        let mut draft = self.of_loads(&self.adjoint.friction, unit, stiffness);
        if self.slope != FrictionSlope::Body {
            draft.correlation = draft.correlation.and(&self.contact.slope_correlation());
        }
        draft
    }

    /// Of a function of the loads with these adjoint loads.
    fn of_loads(&self, by_loads: &[f64], unit: f64, stiffness: f64) -> UnassembledGradient {
        let rise = self.contact.sum(by_loads);
        let (constant, by_load) = match self.loading.control {
            Control::NormalForce(_) => (rise / stiffness, rise / stiffness * self.per_newton()),
            Control::IndentationDepth(_) => (0.0, rise / self.loading.depth_scale),
        };
        let pairs = by_loads.iter().zip(&self.adjoint.depth);
        let adjoint: Vec<f64> = pairs.map(|(one, low)| constant * low - one).collect();
        self.draft(unit, &adjoint, by_load)
    }

    /// Of what follows from the depth, with so many times its adjoint loads.
    fn of_depth(&self, unit: f64, factor: f64, by_load: f64) -> UnassembledGradient {
        let depth = self.adjoint.depth.iter();
        let adjoint: Vec<f64> = depth.map(|load| factor * load).collect();
        self.draft(unit, &adjoint, by_load)
    }

    fn draft(&self, unit: f64, adjoint: &[f64], by_load: f64) -> UnassembledGradient {
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
