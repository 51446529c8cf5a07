//! How a stationary contact changes with what it was solved for, to first order: one adjoint solution for each quantity.
//!
//! With the loads x of the contact, the kernel K, the heights h and the depth δ the contact solves `K x + h − δ = 0`, and for
//! a quantity J(x) the adjoint loads λ solve
//!
//! ```text
//! Kᵀ λ = η − ∂J/∂x,      Σ λ = 0 under a force, η = 0 at a depth,      dJ/dθ = ∂J/∂θ + λᵀ (∂K/∂θ x + ∂h/∂θ)
//! ```
//!
//! (Tardieu & Constantinescu 2000). The contact itself moves, but where the pressure vanishes at its edge its motion counts in
//! second order only. Everything that is asked for afterwards is a sum: over the correlation between elements for the material,
//! over the elements for the body.
//!
//! On a grid the contact moves by elements, and what this leaves is the largest part of the error. Of the motion that changes its
//! size it is known: if all lengths are λ times as long, those of the body, of the layer and of the sliding per time, and the
//! force is λ² times as large, friction stays as it is and the depth is λ times as large. What the derivatives with these
//! elements lack to that is what the elements have to change when the contact grows by λ,
//!
//! ```text
//! R = ∂J/∂ln λ − (power of λ in J) J,      dJ/dθ → dJ/dθ − R (dG/dθ)/(∂G/∂ln λ)
//! ```
//!
//! with a measure G of how much the rim moves, weighted as what is left undone there is, `elements/contact_boundary.rs`. The area is a sum over the
//! rim, too, whose derivative is divided by that of the dilation and multiplied by 2. Then all derivatives add up in units of length, as
//! they do in those of stress and time without it.

mod adjoint_solve;
mod basis;
mod boundary_measures;
mod collocation_points;
mod correlation;
mod correlation_spectrum;
mod loaded_contact;
mod state;
mod two_grid_extrapolation;

use indenters::{Control, SlidingLoad, Surface};
use numerics::{Estimate, InvalidParameter, in_range, not_negative};
use rheology::Material;

use crate::stationary::steady::line::Strip;
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::sliding_creep::SlidingCreep;
use crate::stationary::steady::{LineOptions, Reuse, SteadyOptions};
use crate::{BemError, Elastomer};
use state::State;
pub(crate) use two_grid_extrapolation::Limit;
use two_grid_extrapolation::{Apart, mean};

/// Spacing of the grids whose derivatives are compared with those of the finest.
const COARSER: f64 = 2.0;
/// Error of the derivatives of the logarithm of the friction by those of the load and of the velocity above which elements are
/// halved, up to so many unknowns.
const TOLERANCE: f64 = 4e-3;
const MOST_UNKNOWNS: usize = 2000;
/// Largest tolerance of a contact: gaps beside a rear that opens slowly are small.
const LARGEST_TOLERANCE: f64 = 1e-10;
/// Spacing of a strip over that of the options: few elements give its answer, and take next to no time.
const FINER_STRIP: f64 = 0.25;
/// Shifts of the grids that are averaged.
const PHASES: [[f64; 2]; 2] = [[0.0, 0.0], [0.5, 0.5]];
const PHASES_OF_STRIP: [[f64; 2]; 2] = [[0.0, 0.0], [0.5, 0.0]];
/// Beyond the fine grids lies the limit of what converges with the order 3/2 of the singular front, by 1/(2^1.5 − 1) of the
/// difference from the coarse ones; areas converge with the order 1.
const LIMIT: Limit = Limit {
    beyond: 0.547,
    beyond_of_area: 1.0,
    bar: 2.0,
};
/// Where a depth has derivatives.
const AT_A_DEPTH: &str = "0 on a half space at a depth, which otherwise belongs to a distance";

/// The change of a stationary state to first order; of a periodic surface that of one period, and of its mean plane.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub struct Change<T> {
    /// Of the friction coefficient.
    pub friction_coefficient: T,
    /// Of the indentation depth under a force, \[m]; none in plane strain, and where the half space flows.
    pub indentation_depth: Option<T>,
    /// Of the normal force at a depth, \[N].
    pub normal_force: Option<T>,
    /// Of the logarithm of the contact area, or of the width in plane strain; none under bodies with edges.
    pub contact_area: Option<T>,
}

/// The derivatives by the complex modulus in a band of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub struct ByModuli {
    /// Lowest and highest angular frequency of the band, \[rad/s].
    pub frequencies: [f64; 2],
    /// By the logarithm of the storage modulus in the band.
    pub storage_modulus: Change<Estimate>,
    /// By the logarithm of the loss modulus in the band.
    pub loss_modulus: Change<Estimate>,
}

/// A stationary contact with its adjoint loads, on grids whose difference gives the bars.
#[derive(Debug)]
#[must_use]
pub struct SteadySensitivity {
    fine: SensitivityOnGrid,
    coarse: SensitivityOnGrid,
}

/// A stationary contact with its adjoint loads, on shifted grids of one spacing, without bars.
#[derive(Debug)]
#[must_use]
pub struct SensitivityOnGrid {
    states: Vec<State>,
}

impl SteadySensitivity {
    /// Around the stationary state on a grid, such as the finest one of an [estimate](super::steady()), and on one of elements
    /// twice as long; on finer ones of few elements where these two differ.
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
        Self::of(surface, &loading, options, &PHASES)
    }

    /// The same in plane strain, as of [`steady_line`](super::steady_line()), on elements of a quarter of the length.
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
        options.spacing[0] *= FINER_STRIP;
        Self::of(&strip, &loading, &options, &PHASES_OF_STRIP)
    }

    fn of(
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
            SensitivityOnGrid::of(surface, loading, &options, (phases, &mut reuse))
        };
        let coarse = on_grids(COARSER)?;
        let fine = on_grids(1.0)?;
        let near = Self { fine, coarse };
        if near.fine.n_unknowns() > MOST_UNKNOWNS || near.is_known() {
            return Ok(near);
        }
        Ok(Self {
            fine: on_grids(COARSER.recip())?,
            coarse: near.fine,
        })
    }

    /// Whether the derivatives of the friction by the load and by the velocity are known well enough.
    fn is_known(&self) -> bool {
        let of = |of: &dyn Fn(&State) -> Change<f64>| {
            let [fine, coarse] = [&self.fine, &self.coarse].map(|grids| grids.mean_by(of));
            LIMIT.of(fine, coarse).friction_coefficient.error
        };
        let by_load = of(&State::by_load) * self.fine.given();
        let allowed = TOLERANCE * self.fine.friction_coefficient().abs();
        by_load.max(of(&State::by_velocity)) <= allowed
    }

    /// The change from one body to another, both near that of the state.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] where a height in the contact is not finite.
    pub fn between_bodies(&self, bodies: [&dyn Surface; 2]) -> Result<Change<Estimate>, BemError> {
        self.change(|grids| grids.mean_of(|state| state.between_bodies(bodies)))
    }

    /// The change from one material and velocity to another, both near those of the state, on the same base; fast where all
    /// have as many retardation elements.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a velocity out of range, and [`BemError::Material`].
    pub fn between_materials(
        &self,
        materials: [&dyn Material; 2],
        velocities: [f64; 2],
    ) -> Result<Change<Estimate>, BemError> {
        self.change(|grids| grids.mean_between(materials, velocities))
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
        self.change(|grids| Ok(mean(State::all_to_elastomer(&grids.states, &creep)?)))
    }

    /// The friction coefficient on these grids.
    pub fn friction_coefficient(&self) -> Estimate {
        let of = |grids: &SensitivityOnGrid| {
            let change = |state: &State| Change {
                friction_coefficient: state.friction_coefficient,
                indentation_depth: None,
                normal_force: None,
                contact_area: None,
            };
            mean(grids.states.iter().map(change).collect())
        };
        LIMIT
            .of(of(&self.fine), of(&self.coarse))
            .friction_coefficient
    }

    /// The derivative by the normal force, per newton, or by the depth, per metre, whichever is given.
    pub fn by_load(&self) -> Change<Estimate> {
        let of = |grids: &SensitivityOnGrid| grids.mean_by(State::by_load);
        LIMIT.of(of(&self.fine), of(&self.coarse))
    }

    /// The derivatives by the logarithm of the thickness of the layer; 0 on a half space.
    pub fn by_thickness(&self) -> Change<Estimate> {
        let of = |grids: &SensitivityOnGrid| grids.mean_by(State::by_thickness);
        LIMIT.of(of(&self.fine), of(&self.coarse))
    }

    /// The derivatives by the logarithm of the length of the track; 0 without one.
    pub fn by_track(&self) -> Change<Estimate> {
        let of = |grids: &SensitivityOnGrid| grids.mean_by(State::by_track);
        LIMIT.of(of(&self.fine), of(&self.coarse))
    }

    /// The derivatives by the logarithms of the storage and of the loss modulus in bands of angular frequencies \[rad/s], each
    /// between two that follow each other: how much a quantity changes when the modulus does by one e-fold there and stays as it
    /// is elsewhere.
    ///
    /// The sums of both over all frequencies from 0 on are the change by the unit of stress. Beyond about `π v/Δx` waves are
    /// shorter than two elements, and say nothing.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for frequencies that are negative or not increasing, [`BemError::Material`] where the
    /// material is not known at them, and [`BemError::Indenter`] on a track, into which only some waves fit.
    pub fn by_moduli(&self, frequencies: &[f64]) -> Result<Vec<ByModuli>, BemError> {
        let bands = bands(frequencies)?;
        let of = |grids: &SensitivityOnGrid| -> Result<Vec<[Change<Apart>; 2]>, BemError> {
            let found = grids.states.iter().map(|state| state.by_moduli(&bands));
            let found = found.collect::<Result<Vec<_>, _>>()?;
            let of_band = |band: usize| {
                [0, 1].map(|part| mean(found.iter().map(|state| state[band][part]).collect()))
            };
            Ok((0..bands.len()).map(of_band).collect())
        };
        let pairs = of(&self.fine)?.into_iter().zip(of(&self.coarse)?);
        let found = pairs.zip(&bands).map(|((fine, coarse), &frequencies)| {
            let [storage_modulus, loss_modulus] =
                [0, 1].map(|part| LIMIT.of(fine[part], coarse[part]));
            ByModuli {
                frequencies,
                storage_modulus,
                loss_modulus,
            }
        });
        Ok(found.collect())
    }

    fn change(
        &self,
        of: impl Fn(&SensitivityOnGrid) -> Result<Change<Apart>, BemError>,
    ) -> Result<Change<Estimate>, BemError> {
        Ok(LIMIT.of(of(&self.fine)?, of(&self.coarse)?))
    }
}

impl SensitivityOnGrid {
    /// Around the stationary state on one grid, such as [`steady_grid`](super::steady_grid) makes.
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
        Self::of(surface, &loading, options, (&phases, &mut Reuse::default()))
    }

    /// The same in plane strain, on a grid such as [`steady_line_grid`](super::steady_line_grid) makes.
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
        Self::of(&strip, &loading, &options, (&phases, &mut Reuse::default()))
    }

    fn of(
        surface: &dyn Surface,
        loading: &Loading,
        options: &SteadyOptions,
        (phases, reuse): (&[[f64; 2]], &mut Reuse),
    ) -> Result<Self, BemError> {
        let tolerance = options.tolerance.min(LARGEST_TOLERANCE);
        let grids = phases.iter().map(|&phase| SteadyOptions {
            phase,
            tolerance,
            ..*options
        });
        Ok(Self {
            states: State::all(surface, loading, grids, reuse)?,
        })
    }

    /// The friction coefficient.
    pub fn friction_coefficient(&self) -> f64 {
        let all = self.states.iter().map(|state| state.friction_coefficient);
        all.sum::<f64>() / self.states.len() as f64
    }

    /// The change of the friction coefficient as of [`SteadySensitivity::between_materials`].
    ///
    /// # Errors
    /// As there.
    pub fn between_materials(
        &self,
        materials: [&dyn Material; 2],
        velocities: [f64; 2],
    ) -> Result<f64, BemError> {
        let [change, _] = self
            .mean_between(materials, velocities)?
            .friction_coefficient;
        Ok(change)
    }

    /// Unknown pressures of one grid.
    fn n_unknowns(&self) -> usize {
        self.states.first().map_or(0, State::n_unknowns)
    }

    /// The force or the depth, whichever is given.
    fn given(&self) -> f64 {
        self.states.first().map_or(0.0, State::given)
    }

    fn mean_by(&self, of: impl Fn(&State) -> Change<f64>) -> Change<Apart> {
        mean(self.states.iter().map(of).collect())
    }

    fn mean_between(
        &self,
        materials: [&dyn Material; 2],
        velocities: [f64; 2],
    ) -> Result<Change<Apart>, BemError> {
        let [from, to] = [0, 1].map(|end| SlidingCreep::new(&materials[end], velocities[end]));
        let ends = [from?, to?];
        self.mean_of(|state| state.between_materials(ends.each_ref()))
    }

    fn mean_of(
        &self,
        of: impl Fn(&State) -> Result<Change<f64>, BemError>,
    ) -> Result<Change<Apart>, BemError> {
        let changes = self.states.iter().map(of).collect::<Result<_, _>>()?;
        Ok(mean(changes))
    }
}

/// A load under which the contact has derivatives.
fn loading(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &SteadyOptions,
) -> Result<Loading, BemError> {
    let loading = Loading::new(surface, elastomer, load, &options.footprint)?;
    let given = matches!(loading.control, Control::IndentationDepth(_));
    let fluidity = loading.creep.fluidity();
    in_range("fluidity", fluidity, !given || fluidity <= 0.0, AT_A_DEPTH)?;
    Ok(loading)
}

/// Bands between frequencies that increase.
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
