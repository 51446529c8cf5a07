//! Derivatives of a stationary contact by its parameters: one adjoint solution for each quantity.
//!
//! With the loads x of the contact, the kernel K, the heights h and the depth δ the contact solves `K x + h − δ = 0`, and for
//! a quantity J(x) the adjoint loads λ solve
//!
//! ```text
//! Kᵀ λ = η − ∂J/∂x,      Σ λ = 0 under a force, η = 0 at a depth,      dJ/dθ = ∂J/∂θ + λᵀ (∂K/∂θ x + ∂h/∂θ)
//! ```
//!
//! (Tardieu & Constantinescu 2000). The contact boundary itself moves. Where the pressure vanishes at it, the motion has an effect
//! of second order only. All derivatives then are sums: over the offsets between elements for the material, over the elements for
//! the body.
//!
//! On a grid the contact boundary moves by whole elements, which is the largest part of the error. For a change of scale the exact
//! derivative is known. Multiply all lengths of the body, the layer and the sliding per time by λ, and the force by λ². Then the
//! friction does not change, and the depth is multiplied by λ. The defect R of this scaling identity on fixed elements is the missing
//! effect of the boundary when the contact grows by λ,
//!
//! ```text
//! R = ∂J/∂ln λ − (power of λ in J) J,      dJ/dθ → dJ/dθ − R (dG/dθ)/(∂G/∂ln λ)
//! ```
//!
//! with a measure G of the motion of the boundary, the boundary weight, in which each pair of elements has the weight of its
//! effect (`elements/contact_boundary.rs`). The area is a sum over the boundary, too. Its derivative is divided by that of the
//! dilation and multiplied by 2, the power of λ in the area. With this correction all derivatives add up exactly under a change
//! of the unit of length. Under changes of the units of stress and time they do so without it.
//!
//! Theory: docs/theory/sensitivities.md, "How they are computed".

mod adjoint_solve;
mod collocation_points;
mod contact_derivatives;
mod correlation;
mod kernel_gradient;
mod kernel_table;
mod kernel_waves;
mod loaded_contact;
mod two_grid_extrapolation;

use indenters::{Control, SlidingLoad, Surface};
use numerics::{Estimate, in_range};
use rheology::Material;

use crate::parallel::reductions::mean;
use crate::stationary::change;
pub use crate::stationary::change::{ByModuli, Change};
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::sliding_creep::SlidingCreep;
use crate::stationary::steady::steady_body::SteadyBody;
use crate::stationary::steady::{Reuse, SteadyOptions};
use crate::substrate::base::check_unchanged_moduli;
use crate::{BemError, Elastomer};
use contact_derivatives::{ContactDerivatives, Gradient};
use kernel_gradient::{CreepChange, GridKernel};
pub(crate) use two_grid_extrapolation::TwoGridExtrapolation;
use two_grid_extrapolation::mean_over_shifts;

/// Ratio of the spacing of the coarse grids to that of the fine ones. Chosen; the factors of [`EXTRAPOLATION`] are derived for
/// this ratio and would change with it.
const COARSE_SPACING_FACTOR: f64 = 2.0;
/// Error of the derivatives of the logarithm of the friction, by the logarithms of load and velocity, above which the spacing is
/// halved. Chosen; from 1e-3 to 0.1 no digit of an answer changes (case of `evidence tuning`).
const LOG_DERIVATIVE_TOLERANCE: f64 = 4e-3;
/// Largest number of unknown pressures for which the spacing is halved. Chosen to limit the time: larger contacts keep their
/// spacing and the error of their derivatives.
const HALVING_MAX_UNKNOWNS: usize = 2000;
/// Largest tolerance of a contact, because the gaps behind a rear that opens slowly are small. Chosen; with 1e-12 no answer
/// changes by more than 4 % of its bar, with 1e-7 a bar is 59 times as wide (case of `evidence tuning`).
const MAX_CONTACT_TOLERANCE: f64 = 1e-10;
/// Factor on the spacing of the options for derivatives in plane strain. Chosen (case of `evidence tuning`): such grids have few
/// elements, so that finer ones still take little time.
const STRIP_SPACING_FACTOR: f64 = 0.25;
/// Shifts along x and y of the grids that are averaged, in elements. Chosen as one diagonal pair, which cancels the first
/// harmonic of the scatter along either axis; more shifts take more time.
const SENSITIVITY_PHASES: [[f64; 2]; 2] = [[0.0, 0.0], [0.5, 0.5]];
/// Shifts along x and y of the grids that are averaged in plane strain, in elements. Chosen as one pair, which cancels the first
/// harmonic of the scatter along x; more shifts take more time.
const STRIP_SENSITIVITY_PHASES: [[f64; 2]; 2] = [[0.0, 0.0], [0.5, 0.0]];
/// Factor from the difference fine − coarse to limit − fine at the order 3/2 of the singular front. Derived:
/// 1/(2^(3/2) − 1) = (2^(3/2) + 1)/7.
const FRONT_CORRECTION: f64 = (2.0 * std::f64::consts::SQRT_2 + 1.0) / 7.0;
/// Extrapolation with the order 3/2 of the singular front, and with the order 1 of the area. The error is twice the difference of
/// the grids. The factor is chosen: bars are proportional to it, and the extrapolation itself moves the value by 0.55 of the
/// difference.
const EXTRAPOLATION: TwoGridExtrapolation = TwoGridExtrapolation {
    correction: FRONT_CORRECTION,
    area_correction: 1.0,
    error: 2.0,
};
/// Allowed fluidity at a given depth, for an error message.
const ALLOWED_FLUIDITY_AT_DEPTH: &str =
    "0 on a half space at a depth, which otherwise belongs to a distance";

/// A stationary contact with its adjoint loads on fine and coarse grids, whose difference gives the errors of all derivatives.
#[derive(Debug)]
#[must_use]
pub struct SteadySensitivity {
    /// Derivatives on the grids of the smaller spacing.
    fine: SensitivityOnGrid,
    /// Derivatives on the grids of twice that spacing.
    coarse: SensitivityOnGrid,
}

/// A stationary contact with its adjoint loads on shifted grids of one spacing, without errors.
#[derive(Debug)]
#[must_use]
pub struct SensitivityOnGrid {
    /// Kernel of the grids, which is the same for all shifts.
    kernel: GridKernel,
    /// Contact on each shifted grid.
    contacts: Vec<ContactDerivatives>,
}

impl SteadySensitivity {
    /// Solves the stationary state on a grid, such as the finest one of an [estimate](super::steady()), and on one with twice the
    /// spacing. If their derivatives differ, and the contact has few elements, a grid with half the spacing replaces the coarse one. The
    /// elements of a line have a quarter of the spacing given.
    ///
    /// ```
    /// use bem_halfspace::indenters::Sphere;
    /// use bem_halfspace::rheology::{Prony, RelaxationBranch, RelaxationSpectrum};
    /// use bem_halfspace::steady::sensitivity::SteadySensitivity;
    /// use bem_halfspace::{SlidingLoad, steady};
    ///
    /// let ball = Sphere::new(5e-3)?;
    /// let branch = RelaxationBranch { modulus: 9e6, relaxation_time: 1e-2 };
    /// let rubber = Prony::new(RelaxationSpectrum::new(1e6, 0.0, vec![branch])?)?;
    /// let load = SlidingLoad::new(2.0, 0.05)?;
    /// let state = steady(&ball, &rubber, &load, 1e-2)?;
    /// let near = SteadySensitivity::new(&ball, &rubber, &load, &state.options)?;
    /// // In per cent of the friction by a per cent of the force; μ ∝ F^(1/3) where the shape of the contact stays as it is.
    /// let by_force = near.by_load().friction_coefficient * (2.0 / state.friction_coefficient.value);
    /// assert!(by_force.value > 0.0 && by_force.value < 1.0 && by_force.error < 0.02);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As for [`steady_on_grid`](super::steady_on_grid), and [`BemError::InvalidParameter`] at a depth on a half space that
    /// flows, which belongs to a distance.
    pub fn new<'a>(
        body: impl Into<SteadyBody<'a>>,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &SteadyOptions,
    ) -> Result<Self, BemError> {
        let body = body.into();
        let (surface, loading, mut grid) = with_derivatives(body, elastomer, load, options)?;
        let phases = match body {
            SteadyBody::Body(_) => SENSITIVITY_PHASES,
            SteadyBody::Line(_) => {
                grid.spacing[0] *= STRIP_SPACING_FACTOR;
                STRIP_SENSITIVITY_PHASES
            }
        };
        Self::on_shifted_grids(&surface, &loading, &grid, &phases)
    }

    /// Solves on coarse and fine grids with some shifts, and on finer ones where that is needed.
    fn on_shifted_grids(
        surface: &dyn Surface,
        loading: &Loading,
        options: &SteadyOptions,
        phases: &[[f64; 2]],
    ) -> Result<Self, BemError> {
        let mut reuse = Reuse::default();
        let mut on_grids = |factor: f64| {
            let options = SteadyOptions {
                spacing: loading.scaled(options.spacing, factor),
                ..*options
            };
            SensitivityOnGrid::on_shifted_grids(surface, loading, &options, phases, &mut reuse)
        };
        // Coarse before fine, because the solution on the coarse grid is the initial guess on the fine one.
        let coarse = on_grids(COARSE_SPACING_FACTOR)?;
        let fine = on_grids(1.0)?;
        let sensitivity = Self { fine, coarse };

        // Halve the spacing where the derivatives are inaccurate and the contact has few elements.
        let is_large = sensitivity.fine.contacts[0].n_unknowns > HALVING_MAX_UNKNOWNS;
        if is_large || sensitivity.is_accurate(loading.control) {
            return Ok(sensitivity);
        }
        Ok(Self {
            fine: on_grids(COARSE_SPACING_FACTOR.recip())?,
            coarse: sensitivity.fine,
        })
    }

    /// True if the derivatives of the friction by load and velocity are accurate to the tolerance.
    fn is_accurate(&self, control: Control) -> bool {
        // In plane strain the control is the force on the strip, and derivatives are by the force per length.
        let given = match control {
            Control::NormalForce(_) => self.fine.contacts[0].normal_force,
            Control::IndentationDepth(depth) => depth,
        };
        let by_load = self.by_load().friction_coefficient.error * given;
        let by_velocity = limit(self.fine.by_velocity(), self.coarse.by_velocity());
        let allowed = LOG_DERIVATIVE_TOLERANCE * self.fine.friction_coefficient().abs();
        by_load.max(by_velocity.friction_coefficient.error) <= allowed
    }

    /// Change of all quantities to first order when one body replaces another, both near that of the state.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] where a height in the contact is not finite.
    pub fn between_bodies(&self, bodies: [&dyn Surface; 2]) -> Result<Change<Estimate>, BemError> {
        self.limit(|grids| grids.between_bodies(bodies))
    }

    /// The change from one material and velocity to another, both near those of the state, on the same base. It is fast if both
    /// have as many retardation elements as the material of the state.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a velocity out of range, and [`BemError::Material`].
    pub fn between_materials(
        &self,
        materials: [&dyn Material; 2],
        velocities: [f64; 2],
    ) -> Result<Change<Estimate>, BemError> {
        let ends = creeps(materials, velocities)?;
        self.limit(|grids| grids.between_creeps(&ends))
    }

    /// The change from the elastomer and velocity of the state to others near them, such as a layer of another Poisson ratio.
    ///
    /// # Errors
    /// As for [`between_materials`](Self::between_materials).
    pub fn to_elastomer(
        &self,
        elastomer: &dyn Elastomer,
        velocity: f64,
    ) -> Result<Change<Estimate>, BemError> {
        check_unchanged_moduli(elastomer)?;
        let creep = SlidingCreep::new(elastomer, velocity)?;
        self.limit(|grids| grids.to_elastomer(&creep))
    }

    /// The extrapolated limit of a change, from the changes `on_grids(grids)` on the shifted fine and coarse grids.
    fn limit(
        &self,
        on_grids: impl Fn(&SensitivityOnGrid) -> Result<Vec<Change<f64>>, BemError>,
    ) -> Result<Change<Estimate>, BemError> {
        Ok(limit(on_grids(&self.fine)?, on_grids(&self.coarse)?))
    }

    /// The extrapolated friction coefficient.
    pub fn friction_coefficient(&self) -> Estimate {
        let [fine, coarse] = [&self.fine, &self.coarse].map(|grids| {
            let frictions = grids.contacts.iter().map(|one| one.friction_coefficient);
            let no_others = |friction_coefficient| Change {
                friction_coefficient,
                indentation_depth: None,
                normal_force: None,
                contact_area: None,
            };
            frictions.map(no_others).collect()
        });
        limit(fine, coarse).friction_coefficient
    }

    /// The derivative by the given normal force, per newton, or by the given depth, per metre.
    pub fn by_load(&self) -> Change<Estimate> {
        limit(self.fine.by_load(), self.coarse.by_load())
    }

    /// The derivatives by the logarithm of the thickness of the layer; 0 on a half space.
    pub fn by_thickness(&self) -> Change<Estimate> {
        let [fine, coarse] = [&self.fine, &self.coarse]
            .map(|grids| grids.changes(|gradient| gradient.kernel.by_log_thickness));
        limit(fine, coarse)
    }

    /// The derivatives by the logarithm of the length of the track; 0 without one.
    pub fn by_track(&self) -> Change<Estimate> {
        let [fine, coarse] = [&self.fine, &self.coarse]
            .map(|grids| grids.changes(|gradient| gradient.kernel.by_log_track));
        limit(fine, coarse)
    }

    /// The derivatives by the logarithms of the storage and of the loss modulus in bands of angular frequencies \[rad/s], each between
    /// two that follow each other. Each is the change of a quantity if the modulus changes by one e-fold in the band only.
    ///
    /// The sums of both over all frequencies from 0 on are the change by the unit of stress. Above about `π v/Δx` waves are
    /// shorter than two elements, and the derivatives are meaningless.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for frequencies that are negative or not increasing, [`BemError::Material`] where the
    /// material is not known at them, and [`BemError::Indenter`] on a track, which only discrete waves fit.
    pub fn by_moduli(&self, frequencies: &[f64]) -> Result<Vec<ByModuli>, BemError> {
        change::by_moduli(frequencies, |band| {
            let [fine, coarse] = [&self.fine, &self.coarse].map(|grids| grids.by_moduli(band));
            let ([fine_storage, fine_loss], [storage, loss]) = (fine?, coarse?);
            Ok([limit(fine_storage, storage), limit(fine_loss, loss)])
        })
    }
}

impl SensitivityOnGrid {
    /// Solves the stationary state on one grid, such as that of [`steady_grid`](super::steady_grid).
    ///
    /// # Errors
    /// As for [`SteadySensitivity::new`].
    pub fn new<'a>(
        body: impl Into<SteadyBody<'a>>,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &SteadyOptions,
    ) -> Result<Self, BemError> {
        let (surface, loading, grid) = with_derivatives(body.into(), elastomer, load, options)?;
        let phases = [grid.phase];
        Self::on_shifted_grids(&surface, &loading, &grid, &phases, &mut Reuse::default())
    }

    /// Solves on grids with the shifts `phases`, each from the solution on the one before.
    fn on_shifted_grids(
        surface: &dyn Surface,
        loading: &Loading,
        options: &SteadyOptions,
        phases: &[[f64; 2]],
        reuse: &mut Reuse,
    ) -> Result<Self, BemError> {
        // Solve the contact and its adjoint equations on each shifted grid.
        let tolerance = options.tolerance.min(MAX_CONTACT_TOLERANCE);
        let mut on_grid = |&phase| {
            let options = SteadyOptions {
                phase,
                tolerance,
                ..*options
            };
            ContactDerivatives::new(surface, loading, &options, reuse)
        };
        let mut contacts: Vec<_> = phases.iter().map(&mut on_grid).collect::<Result<_, _>>()?;

        // Contract the correlations of all of them with the kernel; then find the defects of the scaling identity.
        let gradients = contacts.iter_mut();
        let mut gradients: Vec<_> = gradients
            .flat_map(ContactDerivatives::kernel_gradients)
            .collect();
        let max_offsets = gradients
            .iter()
            .map(|gradient| gradient.correlation.max_offsets())
            .fold([0; 2], |largest, one| {
                [0, 1].map(|axis| largest[axis].max(one[axis]))
            });
        let kernel = GridKernel::new(&loading.creep, options.spacing, max_offsets)?;
        kernel.contract(&mut gradients)?;
        for contact in &mut contacts {
            contact.find_dilation(surface, loading.strip, &kernel)?;
        }
        Ok(Self { kernel, contacts })
    }

    /// The mean friction coefficient of the grids.
    pub fn friction_coefficient(&self) -> f64 {
        self.mean_over_grids(|contact| contact.friction_coefficient)
    }

    /// The mean normal force of the grids, \[N]; in plane strain per length, \[N/m].
    pub fn normal_force(&self) -> f64 {
        self.mean_over_grids(|contact| contact.normal_force)
    }

    /// The contact area as the pressure weights it, (∫ p dA)²/∫ p² dA, \[m²]; in plane strain a width, \[m].
    ///
    /// It is 8/9 of the area under Hertz's pressure. It changes continuously with load and material, unlike the number of elements
    /// in contact.
    pub fn effective_area(&self) -> f64 {
        self.mean_over_grids(|contact| contact.effective_area)
    }

    /// The mean of a quantity over the shifted grids.
    fn mean_over_grids(&self, quantity: impl Fn(&ContactDerivatives) -> f64) -> f64 {
        mean(&self.contacts.iter().map(quantity).collect::<Vec<_>>())
    }

    /// The change of all quantities, see [`SteadySensitivity::between_materials`].
    ///
    /// # Errors
    /// As for [`SteadySensitivity::between_materials`].
    pub fn between_materials(
        &self,
        materials: [&dyn Material; 2],
        velocities: [f64; 2],
    ) -> Result<Change<f64>, BemError> {
        let changes = self.between_creeps(&creeps(materials, velocities)?)?;
        Ok(mean_over_shifts(changes).map(|over_shifts| over_shifts.mean))
    }

    /// The change on each grid; `on_fixed_elements(gradient)` is that of one quantity on fixed elements under a constant force.
    fn changes(&self, on_fixed_elements: impl Fn(&Gradient) -> f64) -> Vec<Change<f64>> {
        let contacts = self.contacts.iter();
        contacts
            .map(|contact| contact.total_change(&on_fixed_elements))
            .collect()
    }

    /// Derivative by the given force or depth, one entry per shifted grid.
    fn by_load(&self) -> Vec<Change<f64>> {
        let contacts = self.contacts.iter();
        contacts.map(ContactDerivatives::by_load).collect()
    }

    /// Change by a change of the creep, one entry per shifted grid.
    fn by_creep(&self, change: &CreepChange) -> Vec<Change<f64>> {
        self.changes(|gradient| gradient.kernel.by_creep(change))
    }

    /// Derivative by the logarithm of the velocity, one entry per shifted grid.
    fn by_velocity(&self) -> Vec<Change<f64>> {
        self.by_creep(&self.kernel.by_velocity())
    }

    /// Change when one body replaces another, one entry per shifted grid.
    fn between_bodies(&self, bodies: [&dyn Surface; 2]) -> Result<Vec<Change<f64>>, BemError> {
        let contacts = self.contacts.iter();
        contacts
            .map(|contact| contact.between_bodies(bodies))
            .collect()
    }

    /// Change when one material and velocity replace another, on the base of the contact; one entry per shifted grid.
    fn between_creeps(&self, ends: &[SlidingCreep; 2]) -> Result<Vec<Change<f64>>, BemError> {
        // With as many retardation elements as here the derivatives by them suffice; otherwise contract both whole kernels.
        let [from, to] = ends.each_ref().map(SlidingCreep::over_distance);
        let kernel = &self.kernel;
        if [&from, &to]
            .into_iter()
            .all(|end| kernel.has_same_retardations(end))
        {
            return Ok(self.by_creep(&kernel.between_creeps(&from, &to)));
        }
        let [from, to] = ends.clone().map(|end| kernel.of_material(end));
        let (from, to) = (from?, to?);
        Ok(self.changes(|Gradient { kernel, .. }| {
            kernel.correlation.contract(&to) - kernel.correlation.contract(&from)
        }))
    }

    /// The change from the elastomer of the state to that of another creep on each grid.
    fn to_elastomer(&self, creep: &SlidingCreep) -> Result<Vec<Change<f64>>, BemError> {
        let other = self.kernel.of_elastomer(creep.clone())?;
        let present = self.kernel.whole_creep();
        Ok(self.changes(|Gradient { kernel, .. }| {
            kernel.correlation.contract(&other) - kernel.by_creep(&present)
        }))
    }

    /// The derivatives by the logarithms of the storage and of the loss modulus in a band of frequencies.
    fn by_moduli(&self, band: [f64; 2]) -> Result<[Vec<Change<f64>>; 2], BemError> {
        let kernels = self.kernel.by_moduli(band)?;
        Ok(kernels.map(|kernel| self.changes(|one| one.kernel.correlation.contract(&kernel))))
    }
}

/// The extrapolated limit of changes on fine and coarse grids.
fn limit(fine: Vec<Change<f64>>, coarse: Vec<Change<f64>>) -> Change<Estimate> {
    EXTRAPOLATION.limit(mean_over_shifts(fine), mean_over_shifts(coarse))
}

/// The creep of two materials at their velocities.
fn creeps(
    materials: [&dyn Material; 2],
    velocities: [f64; 2],
) -> Result<[SlidingCreep; 2], BemError> {
    let [from, to] = [0, 1].map(|end| SlidingCreep::new(&materials[end], velocities[end]));
    Ok([from?, to?])
}

/// The problem of a contact that has derivatives, as [`SteadyBody::on_grid`]: not a depth on a half space that flows.
///
/// # Errors
/// [`BemError::InvalidParameter`] at a depth on a half space that flows.
fn with_derivatives<'a>(
    body: SteadyBody<'a>,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &SteadyOptions,
) -> Result<(Box<dyn Surface + 'a>, Loading, SteadyOptions), BemError> {
    check_unchanged_moduli(elastomer)?;
    let problem = body.on_grid(elastomer, load, options)?;
    let loading = &problem.1;
    let is_at_depth = matches!(loading.control, Control::IndentationDepth(_));
    let fluidity = loading.creep.fluidity();
    in_range(
        "fluidity",
        fluidity,
        !is_at_depth || fluidity <= 0.0,
        ALLOWED_FLUIDITY_AT_DEPTH,
    )?;
    Ok(problem)
}

#[cfg(test)]
mod tests;
