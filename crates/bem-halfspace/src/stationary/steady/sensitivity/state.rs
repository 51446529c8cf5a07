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

/// A contact, and what each of its quantities asks of a change.
#[derive(Debug)]
pub(super) struct State {
    /// Of which the derivatives are.
    pub(super) friction_coefficient: f64,
    points: Points,
    /// Part of the load on each element, its image included.
    shares: Vec<f64>,
    /// Of the friction, and of the depth under a force or the force at a depth, where that has a meaning.
    gradients: Vec<Gradient>,
    control: Control,
}

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
        let own = points.own_slopes(surface)?;
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
        Ok(Self {
            friction_coefficient: friction * points.slope_unit(),
            shares: shares.collect(),
            gradients: gradients.all()?,
            points,
            control: loading.control,
        })
    }
}

impl State {
    pub(super) fn between_bodies(
        &self,
        [from, to]: [&dyn Surface; 2],
    ) -> Result<Change<f64>, BemError> {
        let heights = differences(self.points.heights(from)?, &self.points.heights(to)?);
        let slopes = differences(self.points.own_slopes(from)?, &self.points.own_slopes(to)?);
        let mut change = self.change(|gradient| Ok(weighted(&gradient.by_height, &heights)))?;
        change.friction_coefficient += self.points.slope_unit() * weighted(&self.shares, &slopes);
        Ok(change)
    }

    /// On the base of the state.
    pub(super) fn between_materials(
        &self,
        ends: [&SlidingCreep; 2],
    ) -> Result<Change<f64>, BemError> {
        let [from, to] = ends.map(SlidingCreep::moving);
        if [&from, &to].iter().all(|end| self.has_delays_of(end)) {
            return self.change(|gradient| Ok(gradient.basis.between_creeps([&from, &to])));
        }
        self.between_elastomers(ends)
    }

    /// Each on its own base.
    pub(super) fn between_elastomers(
        &self,
        ends: [&SlidingCreep; 2],
    ) -> Result<Change<f64>, BemError> {
        self.change(|gradient| gradient.basis.between_elastomers(ends))
    }

    /// By the logarithms of the storage and of the loss modulus in each band of frequencies.
    pub(super) fn by_moduli(&self, bands: &[[f64; 2]]) -> Result<Vec<[Change<f64>; 2]>, BemError> {
        let bases: Vec<&Basis> = self.gradients.iter().map(|one| &one.basis).collect();
        let of_band = |sums: Vec<[f64; 2]>| {
            [0, 1].map(|part| {
                let pairs = self.gradients.iter().zip(&sums);
                self.of_all(pairs.map(|(one, sums)| one.unit * sums[part]).collect())
            })
        };
        let sums = Basis::by_moduli(&bases, bands)?;
        Ok(sums.into_iter().map(of_band).collect())
    }

    pub(super) fn by_load(&self) -> Change<f64> {
        self.of_all(self.gradients.iter().map(|one| one.by_load).collect())
    }

    fn has_delays_of(&self, creep: &MovingCreep) -> bool {
        self.gradients
            .iter()
            .all(|one| one.basis.has_delays_of(creep))
    }

    fn change(
        &self,
        of: impl Fn(&Gradient) -> Result<f64, BemError>,
    ) -> Result<Change<f64>, BemError> {
        let of = |gradient: &Gradient| Ok(gradient.unit * of(gradient)?);
        let changes: Result<Vec<f64>, BemError> = self.gradients.iter().map(of).collect();
        Ok(self.of_all(changes?))
    }

    fn of_all(&self, changes: Vec<f64>) -> Change<f64> {
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
    fn heights_at(&self, surface: &dyn Surface, shift: f64) -> Result<Vec<f64>, BemError> {
        let height = |&[x, y]: &[f64; 2]| {
            let height = surface.height([x + shift * self.spacing, y]);
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

    fn heights(&self, surface: &dyn Surface) -> Result<Vec<f64>, BemError> {
        self.heights_at(surface, self.shift)
    }

    /// What the slope of the body adds to that of which the friction is the mean, in units of the depth scale over the length
    /// of an element.
    fn own_slopes(&self, surface: &dyn Surface) -> Result<Vec<f64>, BemError> {
        let rise = |from: f64, to: f64| -> Result<Vec<f64>, BemError> {
            let behind = self.heights_at(surface, from)?;
            Ok(differences(behind, &self.heights_at(surface, to)?))
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
    /// Of the friction, and of the depth under a force or the force at a depth.
    fn all(&self) -> Result<Vec<Gradient>, BemError> {
        let Loading {
            control,
            strip,
            creep,
            depth_scale,
            ..
        } = self.loading;
        let mesh = self.contact.mesh;
        // Derivatives of the total load and of the friction by the depth.
        let stiffness = self.contact.sum(&self.adjoint.depth);
        let rise = self.contact.sum(&self.adjoint.friction);
        let (by_load, constant, other) = match control {
            Control::NormalForce(force) => {
                let constant = rise / stiffness;
                let per_newton = self.contact.total * strip.unwrap_or(1.0) / force;
                let has_depth = creep.fluidity() <= 0.0 && strip.is_none();
                let by_load = per_newton / stiffness;
                let depth = || self.of_depth(*depth_scale, stiffness.recip(), by_load);
                (constant * per_newton, constant, has_depth.then(depth))
            }
            Control::IndentationDepth(_) => {
                let unit = mesh.loading.force_of(1.0);
                let force = self.of_depth(unit, -1.0, stiffness / depth_scale);
                (rise / depth_scale, 0.0, Some(force))
            }
        };
        let mut drafts = vec![self.of_friction(constant, by_load)];
        drafts.extend(other);
        self.summed(drafts)
    }

    fn of_friction(&self, constant: f64, by_load: f64) -> Draft {
        let Adjoint { friction, depth } = &self.adjoint;
        let pairs = friction.iter().zip(depth);
        let adjoint: Vec<f64> = pairs.map(|(one, low)| constant * low - one).collect();
        let mut offsets = self.contact.offsets(&adjoint);
        if self.slope != Slope::OfBody {
            offsets = offsets.and(&self.contact.offsets_of_slope());
        }
        Draft {
            unit: self.loading.depth_scale / self.contact.mesh.options.spacing[0],
            adjoint,
            by_load,
            offsets,
        }
    }

    /// Of what follows from the depth, with so many times its adjoint loads.
    fn of_depth(&self, unit: f64, factor: f64, by_load: f64) -> Draft {
        let adjoint: Vec<f64> = self
            .adjoint
            .depth
            .iter()
            .map(|load| factor * load)
            .collect();
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
