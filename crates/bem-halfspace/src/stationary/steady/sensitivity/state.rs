//! One contact on one grid with the derivatives of its quantities.

use indenters::{Control, Surface};
use numerics::in_range;

use crate::BemError;
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::sensitivity::Change;
use crate::stationary::steady::sensitivity::basis::Basis;
use crate::stationary::steady::sensitivity::contact::{Adjoint, Contact};
use crate::stationary::steady::sensitivity::offsets::Offsets;
use crate::stationary::steady::sliding_creep::{MovingCreep, SlidingCreep};
use crate::stationary::steady::{Reuse, SteadyOptions, SteadySliding, solve_on_mesh};

/// Relative step of the differences by all lengths of a body.
const DILATION: f64 = 1e-5;

/// A contact, and what each of its quantities asks of a change.
#[derive(Debug)]
pub(super) struct State {
    /// Of which the derivatives are.
    pub(super) friction_coefficient: f64,
    points: Points,
    /// Part of the load on each element, its image included.
    shares: Vec<f64>,
    /// Of the friction, of the depth under a force or the force at a depth, where that has a meaning, and of the area that the
    /// loads are spread over.
    gradients: Vec<Gradient>,
    /// Of each of them by the logarithms of the thickness of a layer and of the length of a track.
    by_thickness: Vec<f64>,
    by_track: Vec<f64>,
    control: Control,
    pub(super) dilation: Option<Dilation>,
}

/// What the dilation of all lengths changes, with the elements where they are; see the [module](super).
#[derive(Debug)]
pub(super) struct Dilation {
    /// Of each quantity, beyond what it has to be.
    excess: Vec<f64>,
    /// Of the logarithm of the area.
    area: f64,
}

/// A height of a body, \[m], by a point.
type Height<'a> = &'a dyn Fn([f64; 2]) -> f64;

/// A quantity in the units of the mesh.
#[derive(Debug)]
struct Gradient {
    unit: f64,
    /// By the height of each element, its image included.
    by_height: Vec<f64>,
    /// By the force or the depth, whichever is given, both in SI.
    by_load: f64,
    basis: Basis,
}

/// Where a body is felt.
#[derive(Debug)]
struct Points {
    /// Centres of the elements, \[m], of one half where the contact is mirror symmetric.
    centres: Vec<[f64; 2]>,
    /// Where gaps are evaluated, in elements from these.
    shift: f64,
    spacing: f64,
    depth_scale: f64,
    slope: Slope,
}

/// What the friction is the mean of under the load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Slope {
    /// The slope of the body over each element.
    OfBody,
    /// The slope of the displacements at the centre of each element.
    OfSurface,
    /// The same where gaps are evaluated.
    BesidePoints,
}

impl State {
    pub(super) fn new(
        surface: &dyn Surface,
        loading: &Loading,
        options: SteadyOptions,
        reuse: &mut Reuse,
    ) -> Result<Self, BemError> {
        let (mesh, solution) = solve_on_mesh(surface, loading, &options, reuse)?;
        reuse.solution = Some(SteadySliding::new(&mesh, &solution)?);
        let contact = Contact::new(&mesh, &solution);
        let points = Points::new(&contact, loading);
        let own = points.own_slopes(&|point| surface.height(point))?;
        let slopes = match points.slope {
            Slope::OfBody => contact.slopes_of_body(own),
            _ => contact.slopes_of_surface(&own, &mut reuse.plans),
        };
        let (friction, adjoint) = contact.adjoint(&slopes, &mut reuse.plans)?;
        let shares = contact.elements.iter().zip(&contact.loads);
        let shares = shares.map(|(&element, load)| mesh.weight(element) * load / contact.total);
        let gradients = Gradients {
            contact: &contact,
            loading,
            adjoint,
            slope: points.slope,
        };
        let gradients = gradients.all()?;
        let bases: Vec<&Basis> = gradients.iter().map(|one| &one.basis).collect();
        let in_units = |changes: Vec<f64>| {
            let pairs = gradients.iter().zip(changes);
            pairs.map(|(one, change)| one.unit * change).collect()
        };
        let by_thickness = in_units(Basis::by_thickness(&bases)?);
        let by_track = in_units(Basis::by_track(&bases)?);
        let mut state = Self {
            friction_coefficient: friction * points.slope_unit(),
            shares: shares.collect(),
            by_thickness,
            by_track,
            gradients,
            points,
            control: loading.control,
            dilation: None,
        };
        // Elements at the edge of a body stay where they are.
        if !loading.has_edges {
            state.dilation = Some(state.dilated(surface, loading.strip)?);
        }
        Ok(state)
    }

    /// The excess R of each quantity, and ∂α/∂ln λ.
    fn dilated(&self, surface: &dyn Surface, strip: Option<f64>) -> Result<Dilation, BemError> {
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
            let is_other = index == 1 && self.gradients.len() > 2;
            let expected = if is_other {
                power_of_other * (by_height + by_load)
            } else {
                0.0
            };
            excess.push(changed - expected);
        }
        let area = excess.pop().unwrap_or(f64::NAN);
        Ok(Dilation { excess, area })
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
        let slopes = differences(self.points.own_slopes(from)?, &self.points.own_slopes(to)?);
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
        let [from, to] = ends.map(SlidingCreep::moving);
        if [&from, &to].iter().all(|end| self.has_delays_of(end)) {
            return Ok(self.change(|basis| basis.between_creeps([&from, &to])));
        }
        self.between_elastomers(ends)
    }

    /// Each on its own base.
    pub(super) fn between_elastomers(
        &self,
        ends: [&SlidingCreep; 2],
    ) -> Result<Change<f64>, BemError> {
        let changes = Basis::between_elastomers(&self.bases(), ends)?;
        let pairs = self.gradients.iter().zip(changes);
        Ok(self.of_all(pairs.map(|(one, change)| one.unit * change).collect()))
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

    pub(super) fn by_thickness(&self) -> Change<f64> {
        self.of_all(self.by_thickness.clone())
    }

    pub(super) fn by_track(&self) -> Change<f64> {
        self.of_all(self.by_track.clone())
    }

    fn has_delays_of(&self, creep: &MovingCreep) -> bool {
        self.gradients
            .iter()
            .all(|one| one.basis.has_delays_of(creep))
    }

    fn bases(&self) -> Vec<&Basis> {
        self.gradients.iter().map(|one| &one.basis).collect()
    }

    fn change(&self, of: impl Fn(&Basis) -> f64) -> Change<f64> {
        let changes = self.gradients.iter();
        self.of_all(changes.map(|one| one.unit * of(&one.basis)).collect())
    }

    /// With the elements that the change brings into the contact, as far as it is similar to itself.
    fn of_all(&self, mut changes: Vec<f64>) -> Change<f64> {
        let area = changes.pop().unwrap_or(f64::NAN);
        if let Some(dilation) = &self.dilation {
            for (change, excess) in changes.iter_mut().zip(&dilation.excess) {
                *change -= area / dilation.area * excess;
            }
        }
        let other = changes.get(1).copied();
        let (indentation_depth, normal_force) = match self.control {
            Control::NormalForce(_) => (other, None),
            Control::IndentationDepth(_) => (None, other),
        };
        Change {
            friction_coefficient: changes[0],
            indentation_depth,
            normal_force,
        }
    }
}

fn differences(mut from: Vec<f64>, to: &[f64]) -> Vec<f64> {
    from.iter_mut()
        .zip(to)
        .for_each(|(from, to)| *from = to - *from);
    from
}

fn weighted(weights: &[f64], values: &[f64]) -> f64 {
    let pairs = weights.iter().zip(values);
    pairs.map(|(weight, value)| weight * value).sum()
}

impl Points {
    fn new(contact: &Contact, loading: &Loading) -> Self {
        let on_grid = &contact.mesh.loading;
        let is_solid = on_grid.is_solid_for_elements();
        let elements = contact.elements.iter();
        Self {
            centres: elements
                .map(|&element| contact.mesh.position(element))
                .collect(),
            shift: on_grid.creep.shift,
            spacing: contact.mesh.options.spacing[0],
            depth_scale: loading.depth_scale,
            slope: match loading.has_edges {
                _ if loading.creep.only_flows() => Slope::OfBody,
                true if is_solid => Slope::BesidePoints,
                true => Slope::OfBody,
                false => Slope::OfSurface,
            },
        }
    }

    fn slope_unit(&self) -> f64 {
        self.depth_scale / self.spacing
    }

    /// Heights in units of the depth scale, so many elements from the centres.
    fn heights_at(&self, of_body: Height, shift: f64) -> Result<Vec<f64>, BemError> {
        let height = |&[x, y]: &[f64; 2]| {
            let height = of_body([x + shift * self.spacing, y]);
            in_range(
                "height in the contact",
                height,
                height.is_finite(),
                "finite",
            )?;
            Ok(height / self.depth_scale)
        };
        self.centres.iter().map(height).collect()
    }

    fn heights(&self, of_body: Height) -> Result<Vec<f64>, BemError> {
        self.heights_at(of_body, self.shift)
    }

    /// What the slope of the body adds to that of which the friction is the mean, in units of the depth scale over the length
    /// of an element.
    fn own_slopes(&self, of_body: Height) -> Result<Vec<f64>, BemError> {
        let rise = |from: f64, to: f64| -> Result<Vec<f64>, BemError> {
            let behind = self.heights_at(of_body, from)?;
            Ok(differences(behind, &self.heights_at(of_body, to)?))
        };
        match self.slope {
            Slope::OfBody => rise(-0.5, 0.5),
            Slope::BesidePoints => Ok(vec![0.0; self.centres.len()]),
            Slope::OfSurface => {
                let beside = rise(self.shift - 1.0, self.shift + 1.0)?;
                let pairs = rise(-0.5, 0.5)?.into_iter().zip(beside);
                Ok(pairs.map(|(over, beside)| over - 0.5 * beside).collect())
            }
        }
    }
}

/// Makes the derivatives of a contact.
struct Gradients<'a> {
    contact: &'a Contact<'a>,
    loading: &'a Loading,
    adjoint: Adjoint,
    slope: Slope,
}

/// A quantity whose kernel is not summed yet.
struct Draft {
    unit: f64,
    adjoint: Vec<f64>,
    /// In units of the quantity.
    by_load: f64,
    offsets: Offsets,
}

impl Gradients<'_> {
    /// Of the friction, of the depth under a force or the force at a depth, and of the area.
    fn all(&self) -> Result<Vec<Gradient>, BemError> {
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
        let mut drafts = vec![self.of_friction(stiffness)];
        drafts.extend(other);
        drafts.push(self.of_loads(&self.adjoint.area, 1.0, stiffness));
        self.summed(drafts)
    }

    /// Total load in the units of the mesh per unit of the given force.
    fn per_newton(&self) -> f64 {
        let Loading { control, strip, .. } = self.loading;
        let (Control::NormalForce(given) | Control::IndentationDepth(given)) = control;
        self.contact.total * strip.unwrap_or(1.0) / given
    }

    fn of_friction(&self, stiffness: f64) -> Draft {
        let unit = self.loading.depth_scale / self.contact.mesh.options.spacing[0];
        let mut draft = self.of_loads(&self.adjoint.friction, unit, stiffness);
        if self.slope != Slope::OfBody {
            draft.offsets = draft.offsets.and(&self.contact.offsets_of_slope());
        }
        draft
    }

    /// Of a function of the loads with these adjoint loads.
    fn of_loads(&self, by_loads: &[f64], unit: f64, stiffness: f64) -> Draft {
        let rise = self.contact.sum(by_loads);
        let (constant, by_load) = match self.loading.control {
            Control::NormalForce(_) => (rise / stiffness, rise / stiffness * self.per_newton()),
            Control::IndentationDepth(_) => (0.0, rise / self.loading.depth_scale),
        };
        let pairs = by_loads.iter().zip(&self.adjoint.depth);
        let adjoint: Vec<f64> = pairs.map(|(one, low)| constant * low - one).collect();
        Draft {
            unit,
            offsets: self.contact.offsets(&adjoint),
            adjoint,
            by_load,
        }
    }

    /// Of what follows from the depth, with so many times its adjoint loads.
    fn of_depth(&self, unit: f64, factor: f64, by_load: f64) -> Draft {
        let depth = self.adjoint.depth.iter();
        let adjoint: Vec<f64> = depth.map(|load| factor * load).collect();
        Draft {
            unit,
            offsets: self.contact.offsets(&adjoint),
            adjoint,
            by_load,
        }
    }

    fn summed(&self, drafts: Vec<Draft>) -> Result<Vec<Gradient>, BemError> {
        let Contact { mesh, elements, .. } = self.contact;
        let (mut offsets, mut others) = (Vec::new(), Vec::new());
        for draft in drafts {
            let pairs = elements.iter().zip(&draft.adjoint);
            let by_height = pairs.map(|(&element, load)| mesh.weight(element) * load);
            others.push((draft.unit, by_height.collect(), draft.unit * draft.by_load));
            offsets.push(draft.offsets);
        }
        let bases = Basis::of_all(offsets, &self.loading.creep, mesh)?;
        let gradient = |((unit, by_height, by_load), basis)| Gradient {
            unit,
            by_height,
            by_load,
            basis,
        };
        Ok(others.into_iter().zip(bases).map(gradient).collect())
    }
}
