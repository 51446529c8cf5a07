//! Derivatives of a stationary contact by its parameters: one adjoint solution for each quantity.
//!
//! With the loads x of the contact, the kernel K, the heights h and the depth δ the contact solves `K x + h − δ = 0`, and for
//! a quantity J(x) the adjoint loads λ solve
//!
//! ```text
//! Kᵀ λ = η − ∂J/∂x,      Σ λ = 0 under a force, η = 0 at a depth,      dJ/dθ = ∂J/∂θ + λᵀ (∂K/∂θ x + ∂h/∂θ)
//! ```
//!
//! (Tardieu & Constantinescu 2000). The contact boundary itself moves. Where the pressure vanishes at it, the motion has an effect of
//! second order only. All derivatives then are sums: over the offsets between elements for the material, over the elements for the body.
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
//! with a measure G of the motion of the boundary, in which each place has the weight of its effect, `elements/contact_boundary.rs`. The
//! area is a sum over the boundary, too; its derivative is divided by that of the dilation and multiplied by 2. With this correction all
//! derivatives add up exactly under a change of the unit of length, as they do without it under changes of the units of stress and time.
//!
//! Theory: docs/sensitivity.md, "What is known of them".

mod adjoint_solve;
mod basis;
mod boundary_measures;
mod collocation_points;
mod contact_derivatives;
mod correlation;
mod correlation_spectrum;
mod loaded_contact;
mod two_grid_extrapolation;

use indenters::{Control, SlidingLoad, Surface};
use numerics::{Estimate, InvalidParameter, in_range, not_negative};
use rheology::Material;

use crate::stationary::steady::line::Strip;
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::sliding_creep::SlidingCreep;
use crate::stationary::steady::{LineOptions, Reuse, SteadyOptions};
use crate::{BemError, Elastomer};
use contact_derivatives::ContactDerivatives;
pub(crate) use two_grid_extrapolation::TwoGridExtrapolation;
use two_grid_extrapolation::{MeanAndSpread, mean_over_shifts};

/// Spacing of the coarse grids over that of the fine ones.
const COARSE_SPACING_FACTOR: f64 = 2.0;
/// Error of ∂ln μ/∂ln F and ∂ln μ/∂ln v above which the spacing is halved; chosen.
const LOG_DERIVATIVE_TOLERANCE: f64 = 4e-3;
/// Largest number of unknown pressures for which the spacing is halved; chosen.
const HALVING_MAX_UNKNOWNS: usize = 2000;
/// Largest tolerance of a contact; chosen. The gaps behind a rear that opens slowly are small.
const MAX_CONTACT_TOLERANCE: f64 = 1e-10;
/// Spacing in plane strain over that of the options; chosen. The options have few elements, so that finer grids still take little time.
const STRIP_SPACING_FACTOR: f64 = 0.25;
/// Shifts along x and y of the grids that are averaged, in elements.
const SENSITIVITY_PHASES: [[f64; 2]; 2] = [[0.0, 0.0], [0.5, 0.5]];
/// Shifts in plane strain, in elements.
const STRIP_SENSITIVITY_PHASES: [[f64; 2]; 2] = [[0.0, 0.0], [0.5, 0.0]];
/// Limit − fine over fine − coarse at the order 3/2 of the singular front: 1/(2^(3/2) − 1) = (2^(3/2) + 1)/7.
const FRONT_CORRECTION: f64 = (2.0 * std::f64::consts::SQRT_2 + 1.0) / 7.0;
/// Extrapolation with the order 3/2 of the singular front, and with the order 1 of the area. The factor of the error is chosen.
const EXTRAPOLATION: TwoGridExtrapolation = TwoGridExtrapolation {
    correction: FRONT_CORRECTION,
    area_correction: 1.0,
    error: 2.0,
};
/// Allowed fluidity at a given depth, for an error message.
const ALLOWED_FLUIDITY_AT_DEPTH: &str =
    "0 on a half space at a depth, which otherwise belongs to a distance";

/// The change of a stationary state to first order. For a periodic surface forces are those of one period, and the depth is that of the
/// mean plane.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub struct Change<T> {
    /// Change of the friction coefficient.
    pub friction_coefficient: T,
    /// Change of the indentation depth under a given force, \[m]. `None` at a given depth, in plane strain, and on a half space that flows.
    pub indentation_depth: Option<T>,
    /// Change of the normal force at a given depth, \[N]. `None` under a given force.
    pub normal_force: Option<T>,
    /// Change of the logarithm of the contact area, or of the width in plane strain. `None` under bodies with edges.
    pub contact_area: Option<T>,
}

/// The derivatives by the complex modulus in a band of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub struct ByModuli {
    /// Lowest and highest angular frequency of the band, \[rad/s].
    pub frequencies: [f64; 2],
    /// Derivative by the logarithm of the storage modulus in the band.
    pub storage_modulus: Change<Estimate>,
    /// Derivative by the logarithm of the loss modulus in the band.
    pub loss_modulus: Change<Estimate>,
}

/// A stationary contact with its adjoint loads on fine and coarse grids, whose difference gives the errors of all derivatives.
#[derive(Debug)]
#[must_use]
pub struct SteadySensitivity {
    fine: SensitivityOnGrid,
    coarse: SensitivityOnGrid,
}

/// A stationary contact with its adjoint loads on shifted grids of one spacing, without errors.
#[derive(Debug)]
#[must_use]
pub struct SensitivityOnGrid {
    contacts: Vec<ContactDerivatives>,
}

impl SteadySensitivity {
    /// Solves the stationary state on a grid, such as the finest one of an [estimate](super::steady()), and on one with twice the
    /// spacing. If their derivatives differ, and the contact has few elements, a grid with half the spacing replaces the coarse one.
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
    pub fn new(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &SteadyOptions,
    ) -> Result<Self, BemError> {
        let loading = loading(surface, elastomer, load, options)?;
        Self::on_shifted_grids(surface, &loading, options, &SENSITIVITY_PHASES)
    }

    /// Like [`new`](Self::new), in plane strain as [`steady_line`](super::steady_line()), on elements of a quarter of the spacing.
    ///
    /// # Errors
    /// As for [`steady_line_on_grid`](super::steady_line_on_grid).
    pub fn of_line(
        profile: &dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &LineOptions,
    ) -> Result<Self, BemError> {
        let loading = Loading::per_length(&profile, elastomer, load, options.footprint)?;
        let strip = Strip::new(&profile, &loading);
        let mut options = options.on_strip(&strip);
        options.spacing[0] *= STRIP_SPACING_FACTOR;
        Self::on_shifted_grids(&strip, &loading, &options, &STRIP_SENSITIVITY_PHASES)
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
        if sensitivity.fine.n_unknowns() > HALVING_MAX_UNKNOWNS || sensitivity.is_accurate() {
            return Ok(sensitivity);
        }
        Ok(Self {
            fine: on_grids(COARSE_SPACING_FACTOR.recip())?,
            coarse: sensitivity.fine,
        })
    }

    /// True if the derivatives of the friction by load and velocity are accurate to the tolerance.
    fn is_accurate(&self) -> bool {
        let error = |derivative: fn(&ContactDerivatives) -> Change<f64>| {
            self.limit_of(derivative).friction_coefficient.error
        };
        let by_load = error(ContactDerivatives::by_load) * self.fine.given();
        let allowed = LOG_DERIVATIVE_TOLERANCE * self.fine.friction_coefficient().abs();
        by_load.max(error(ContactDerivatives::by_velocity)) <= allowed
    }

    /// The extrapolated limit of a derivative.
    fn limit_of(
        &self,
        derivative: impl Fn(&ContactDerivatives) -> Change<f64>,
    ) -> Change<Estimate> {
        let mean = |grids: &SensitivityOnGrid| grids.mean_over_grids(&derivative);
        EXTRAPOLATION.limit(mean(&self.fine), mean(&self.coarse))
    }

    /// The extrapolated limit of a change that may fail on a grid.
    fn limit_of_change(
        &self,
        change: impl Fn(&SensitivityOnGrid) -> Result<Change<MeanAndSpread>, BemError>,
    ) -> Result<Change<Estimate>, BemError> {
        Ok(EXTRAPOLATION.limit(change(&self.fine)?, change(&self.coarse)?))
    }

    /// The change from one body to another, both near that of the state.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] where a height in the contact is not finite.
    pub fn between_bodies(&self, bodies: [&dyn Surface; 2]) -> Result<Change<Estimate>, BemError> {
        self.limit_of_change(|grids| grids.try_mean(|state| state.between_bodies(bodies)))
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
        self.limit_of_change(|grids| grids.mean_between(materials, velocities))
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
        let creep = SlidingCreep::new(elastomer, velocity)?;
        self.limit_of_change(|grids| {
            Ok(mean_over_shifts(ContactDerivatives::all_to_elastomer(
                &grids.contacts,
                &creep,
            )?))
        })
    }

    /// The extrapolated friction coefficient.
    pub fn friction_coefficient(&self) -> Estimate {
        let friction = |contact: &ContactDerivatives| Change {
            friction_coefficient: contact.friction_coefficient,
            indentation_depth: None,
            normal_force: None,
            contact_area: None,
        };
        self.limit_of(friction).friction_coefficient
    }

    /// The derivative by the given normal force, per newton, or by the given depth, per metre.
    pub fn by_load(&self) -> Change<Estimate> {
        self.limit_of(ContactDerivatives::by_load)
    }

    /// The derivatives by the logarithm of the thickness of the layer; 0 on a half space.
    pub fn by_thickness(&self) -> Change<Estimate> {
        self.limit_of(ContactDerivatives::by_thickness)
    }

    /// The derivatives by the logarithm of the length of the track; 0 without one.
    pub fn by_track(&self) -> Change<Estimate> {
        self.limit_of(ContactDerivatives::by_track)
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
        let bands = bands(frequencies)?;
        // Means over the shifts, for each band by storage and by loss modulus.
        let means =
            |grids: &SensitivityOnGrid| -> Result<Vec<[Change<MeanAndSpread>; 2]>, BemError> {
                let by_contact = grids
                    .contacts
                    .iter()
                    .map(|state| state.by_moduli(&bands))
                    .collect::<Result<Vec<_>, _>>()?;
                let of_band = |band: usize| {
                    [0, 1].map(|modulus| {
                        let changes = by_contact.iter().map(|state| state[band][modulus]);
                        mean_over_shifts(changes.collect())
                    })
                };
                Ok((0..bands.len()).map(of_band).collect())
            };
        let pairs = means(&self.fine)?.into_iter().zip(means(&self.coarse)?);
        let found = pairs.zip(&bands).map(|((fine, coarse), &frequencies)| {
            let [storage_modulus, loss_modulus] =
                [0, 1].map(|modulus| EXTRAPOLATION.limit(fine[modulus], coarse[modulus]));
            ByModuli {
                frequencies,
                storage_modulus,
                loss_modulus,
            }
        });
        Ok(found.collect())
    }
}

impl SensitivityOnGrid {
    /// Solves the stationary state on one grid, such as that of [`steady_grid`](super::steady_grid).
    ///
    /// # Errors
    /// As for [`SteadySensitivity::new`].
    pub fn new(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &SteadyOptions,
    ) -> Result<Self, BemError> {
        let loading = loading(surface, elastomer, load, options)?;
        let phases = [options.phase];
        Self::on_shifted_grids(surface, &loading, options, &phases, &mut Reuse::default())
    }

    /// Like [`new`](Self::new), in plane strain, on a grid such as that of [`steady_line_grid`](super::steady_line_grid).
    ///
    /// # Errors
    /// As for [`SteadySensitivity::of_line`].
    pub fn of_line(
        profile: &dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &LineOptions,
    ) -> Result<Self, BemError> {
        let loading = Loading::per_length(&profile, elastomer, load, options.footprint)?;
        let strip = Strip::new(&profile, &loading);
        let options = options.on_strip(&strip);
        let phases = [options.phase];
        Self::on_shifted_grids(&strip, &loading, &options, &phases, &mut Reuse::default())
    }

    fn on_shifted_grids(
        surface: &dyn Surface,
        loading: &Loading,
        options: &SteadyOptions,
        phases: &[[f64; 2]],
        reuse: &mut Reuse,
    ) -> Result<Self, BemError> {
        let tolerance = options.tolerance.min(MAX_CONTACT_TOLERANCE);
        let grids = phases.iter().map(|&phase| SteadyOptions {
            phase,
            tolerance,
            ..*options
        });
        Ok(Self {
            contacts: ContactDerivatives::on_grids(surface, loading, grids, reuse)?,
        })
    }

    /// The mean friction coefficient of the grids.
    pub fn friction_coefficient(&self) -> f64 {
        let all = self.contacts.iter().map(|state| state.friction_coefficient);
        all.sum::<f64>() / self.contacts.len() as f64
    }

    /// The change of the friction coefficient, see [`SteadySensitivity::between_materials`].
    ///
    /// # Errors
    /// As for [`SteadySensitivity::between_materials`].
    pub fn between_materials(
        &self,
        materials: [&dyn Material; 2],
        velocities: [f64; 2],
    ) -> Result<f64, BemError> {
        let change = self.mean_between(materials, velocities)?;
        Ok(change.friction_coefficient.mean)
    }

    /// Number of unknown pressures of one grid.
    fn n_unknowns(&self) -> usize {
        self.contacts
            .first()
            .map_or(0, ContactDerivatives::n_unknowns)
    }

    /// The given force or depth.
    fn given(&self) -> f64 {
        self.contacts.first().map_or(0.0, ContactDerivatives::given)
    }

    /// The mean over the shifted grids of a derivative.
    fn mean_over_grids(
        &self,
        of: impl Fn(&ContactDerivatives) -> Change<f64>,
    ) -> Change<MeanAndSpread> {
        mean_over_shifts(self.contacts.iter().map(of).collect())
    }

    /// The mean change between two materials and velocities.
    fn mean_between(
        &self,
        materials: [&dyn Material; 2],
        velocities: [f64; 2],
    ) -> Result<Change<MeanAndSpread>, BemError> {
        let [from, to] = [0, 1].map(|end| SlidingCreep::new(&materials[end], velocities[end]));
        let ends = [from?, to?];
        self.try_mean(|state| state.between_materials(ends.each_ref()))
    }

    /// The mean over the shifted grids of a change that may fail.
    fn try_mean(
        &self,
        of: impl Fn(&ContactDerivatives) -> Result<Change<f64>, BemError>,
    ) -> Result<Change<MeanAndSpread>, BemError> {
        let changes = self.contacts.iter().map(of).collect::<Result<_, _>>()?;
        Ok(mean_over_shifts(changes))
    }
}

/// The loading, if the contact has derivatives under it.
///
/// # Errors
/// [`BemError::InvalidParameter`] at a depth on a half space that flows.
fn loading(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &SteadyOptions,
) -> Result<Loading, BemError> {
    let loading = Loading::new(surface, elastomer, load, &options.footprint)?;
    let given = matches!(loading.control, Control::IndentationDepth(_));
    let fluidity = loading.creep.fluidity();
    in_range(
        "fluidity",
        fluidity,
        !given || fluidity <= 0.0,
        ALLOWED_FLUIDITY_AT_DEPTH,
    )?;
    Ok(loading)
}

/// The bands between increasing frequencies.
pub(crate) fn bands(frequencies: &[f64]) -> Result<Vec<[f64; 2]>, InvalidParameter> {
    let band = |ends: &[f64]| {
        not_negative("frequency", ends[0])?;
        let increases = ends[1] > ends[0];
        in_range(
            "frequency",
            ends[1],
            increases,
            "greater than the one before",
        )?;
        Ok([ends[0], ends[1]])
    };
    frequencies.windows(2).map(band).collect()
}

#[cfg(test)]
mod tests;
