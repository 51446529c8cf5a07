//! Sensitivity of the stationary contact of a periodic surface: first-order changes with surface, material, layer and load.
//!
//! As for [single bodies](crate::steady::sensitivity), one adjoint solution per quantity J gives all derivatives. With the pressures
//! p on the active set, the adjoint loads λ solve
//!
//! ```text
//! Kᵀ λ = η − ∂J/∂p in the contact,      Σ λ = 0,      dJ/dθ = ∂J/∂θ + λᵀ (∂K/∂θ p + ∂h/∂θ),      dJ/dΣp = η
//! ```
//!
//! and Σ λ = 1 with J = 0 for the depth. The transposed kernel is that of a surface that slides the other way. Reversed along x,
//! the equations on the active set are therefore those of the adjoint loads. The kernel is a factor for each q_x, and the change by
//! a material is a sum over them.
//!
//! The contact changes by whole elements, many of them at its boundary, and different ones on each grid. Hence the error bars come
//! from two grids.
//!
//! Theory: docs/theory/sensitivities.md.

mod adjoint;

use indenters::rough::PeriodicSurface;
use numerics::{Estimate, in_range};
use rheology::Material;
use rustfft::num_complex::Complex;

use crate::error::check_length;
use crate::parallel::chunks::in_pool;
use crate::parallel::reductions::{add_scaled, dot, mean};
use crate::stationary::change;
use crate::stationary::periodic::contact::PeriodicContact;
use crate::stationary::periodic::kernel::{MaterialAtSpeed, PeriodicKernel};
use crate::stationary::periodic::nested::interpolated;
use crate::stationary::periodic::refinement::check_periods;
use crate::stationary::periodic::{PeriodicControl, PeriodicLoad, PeriodicOptions, solve_from};
use crate::steady::sensitivity::{ByModuli, Change, TwoGridExtrapolation};
use crate::substrate::base::check_unchanged_moduli;
use crate::{BemError, Elastomer, Grid, PressureField};
use adjoint::{Adjoint, Gradient, KernelChange, unit_pressure};

/// Derivatives and error bars from two grids. The derivatives are those on the fine grid, because the elements at the contact
/// boundary differ from grid to grid without a common order. The error bar is 2.5 times the difference of the grids. The factor
/// is chosen: an error of the first order would need 1, one of the order 1/2 needs 2.4.
const EXTRAPOLATION: TwoGridExtrapolation = TwoGridExtrapolation {
    correction: 0.0,
    area_correction: 0.0,
    error: 2.5,
};

/// A stationary contact of a periodic surface with its adjoint loads, on two grids whose difference gives the error bars.
///
/// Depths are those of the mean plane, and forces are those of one period.
#[derive(Debug)]
#[must_use]
pub struct PeriodicSensitivity {
    /// Contact on the grid of the state.
    fine: State,
    /// Contact on half as many elements along each axis.
    coarse: State,
}

/// The contact on one grid, with the gradients of its quantities under a constant mean pressure.
#[derive(Debug)]
struct State {
    /// Grid of one period.
    grid: Grid,
    /// Material and speed.
    sliding: MaterialAtSpeed,
    /// Prescribed mean pressure or depth.
    control: PeriodicControl,
    /// Mean pressure, \[Pa].
    mean_pressure: f64,
    /// Pressure of the elements less its mean, \[Pa].
    pressure: Vec<f64>,
    /// Wave number q_x of each row of a transformed field, \[rad/m].
    along_x: Vec<f64>,
    /// Derivatives of friction, depth and logarithm of the area by heights and kernel, under a constant mean pressure.
    gradients: Change<Gradient>,
}

impl PeriodicSensitivity {
    /// Linearises around the stationary state on the grid of `pressure`, and on one of half as many elements along each axis.
    ///
    /// `pressure` is the first guess, such as that of [an estimate](super::steady).
    ///
    /// ```
    /// use bem_halfspace::indenters::rough::{PeriodicSurface, Wave};
    /// use bem_halfspace::periodic::sensitivity::PeriodicSensitivity;
    /// use bem_halfspace::rheology::{StandardSolid, StandardSolidParameters};
    /// use bem_halfspace::{PeriodicLoad, periodic};
    ///
    /// let wave = |numbers| Wave { numbers, amplitude: 1e-5, phase: 0.0 };
    /// let road = PeriodicSurface::new([1e-3; 2], vec![wave([1, 1]), wave([3, -2])])?;
    /// let rubber = StandardSolid::new(StandardSolidParameters {
    ///     equilibrium_modulus: 1e6,
    ///     maxwell_modulus: 9e6,
    ///     viscosity: 9e2,
    /// })?;
    /// let load = PeriodicLoad::new(1e4, 0.1)?;
    /// let state = periodic::steady(&road, &rubber, &load, 0.05)?;
    /// let near = PeriodicSensitivity::new(&road, &rubber, &load, &state.finest.pressure)?;
    /// // In light contact the area grows in proportion to the pressure.
    /// let by_pressure = near.by_load().contact_area.expect("an area") * 1e4;
    /// assert!(by_pressure.value > 0.5 && by_pressure.value < 1.1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`steady_on_grid`](super::steady_on_grid), and [`BemError::InvalidParameter`] for a grid of other periods, and for
    /// one that is not twice one on which all waves fit, and without sliding.
    pub fn new(
        surface: &PeriodicSurface,
        elastomer: &dyn Elastomer,
        load: &PeriodicLoad,
        pressure: &PressureField,
    ) -> Result<Self, BemError> {
        check_unchanged_moduli(elastomer)?;
        if let Some(duration) = load.duration() {
            in_range("duration", duration, false, "that of a load that slides")?;
        }
        let sliding = MaterialAtSpeed::new(elastomer, load.velocity())?;
        let control = load.require_stationary()?;
        let grid = pressure.grid;
        // Each edge must have an even number of elements, because the coarse grid has half as many, and the guess must fill the grid.
        let names = ["elements along x", "elements along y"];
        for (name, edge) in names.into_iter().zip(grid.shape()) {
            in_range(name, edge as f64, edge.is_multiple_of(2), "even")?;
        }
        check_length("pressure", pressure.pressure.len(), grid.n_elements())?;
        let on = |grid: &Grid, guess: Vec<f64>| {
            check_periods(surface, grid)?;
            let heights = surface.heights(grid.shape())?;
            in_pool(grid.n_elements(), || {
                State::new(&sliding, grid, &heights, control, guess)
            })
        };
        let shape = grid.shape();
        let coarse = interpolated(&pressure.pressure, shape, shape.map(|n| n / 2));
        Ok(Self {
            fine: on(&grid, pressure.pressure.clone())?,
            coarse: on(&grid.blocks(), coarse)?,
        })
    }

    /// The change from one surface to another, both near that of the state, under the same mean pressure or at the same depth.
    ///
    /// Their periods may differ, as those of a height map with another spacing do: the elements are stretched with them.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for waves that do not fit on the grids, and [`BemError::Material`].
    pub fn between_surfaces(
        &self,
        surfaces: [&PeriodicSurface; 2],
    ) -> Result<Change<Estimate>, BemError> {
        self.with_error(|state| state.between_surfaces(surfaces))
    }

    /// The change from one material and velocity to another, both near those of the state, on the same base.
    ///
    /// # Errors
    /// [`BemError::FlowsUnderWaves`], and [`BemError::Material`].
    pub fn between_materials(
        &self,
        materials: [&dyn Material; 2],
        velocities: [f64; 2],
    ) -> Result<Change<Estimate>, BemError> {
        let [from, to] = [0, 1].map(|end| MaterialAtSpeed::new(&materials[end], velocities[end]));
        let ends = [from?, to?];
        self.with_error(|state| state.between_materials(ends.each_ref()))
    }

    /// The change from one elastomer and velocity to another, including their bases, such as layers of different thickness or
    /// Poisson ratio.
    ///
    /// # Errors
    /// As for [`between_materials`](Self::between_materials).
    pub fn between_elastomers(
        &self,
        elastomers: [&dyn Elastomer; 2],
        velocities: [f64; 2],
    ) -> Result<Change<Estimate>, BemError> {
        elastomers
            .into_iter()
            .try_for_each(check_unchanged_moduli)?;
        let [from, to] = [0, 1].map(|end| MaterialAtSpeed::new(elastomers[end], velocities[end]));
        let ends = [from?, to?];
        self.with_error(|state| state.between_elastomers(ends.each_ref()))
    }

    /// The derivative by the mean pressure, per pascal, or by the depth, per metre, whichever is prescribed.
    pub fn by_load(&self) -> Change<Estimate> {
        EXTRAPOLATION.limit_of_single(self.fine.by_load(), self.coarse.by_load())
    }

    /// The derivatives by the logarithms of the storage and of the loss modulus in bands of angular frequencies, as
    /// [of single bodies](crate::steady::sensitivity::SteadySensitivity::by_moduli). Waves along x have the multiples of one frequency,
    /// 2π v/L_x; moduli between two of them have no effect.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for frequencies that are negative or not increasing, and [`BemError::Material`] where the
    /// material is not known at them.
    pub fn by_moduli(&self, frequencies: &[f64]) -> Result<Vec<ByModuli>, BemError> {
        change::by_moduli(frequencies, |band| {
            let [fine, coarse] = [&self.fine, &self.coarse].map(|one| one.by_moduli(band));
            let ([fine_storage, fine_loss], [storage, loss]) = (fine?, coarse?);
            Ok([
                EXTRAPOLATION.limit_of_single(fine_storage, storage),
                EXTRAPOLATION.limit_of_single(fine_loss, loss),
            ])
        })
    }

    /// A change of the state with its discretisation error, from the changes `on_grid(state)` on the fine and on the coarse grid.
    fn with_error(
        &self,
        on_grid: impl Fn(&State) -> Result<Change<f64>, BemError>,
    ) -> Result<Change<Estimate>, BemError> {
        Ok(EXTRAPOLATION.limit_of_single(on_grid(&self.fine)?, on_grid(&self.coarse)?))
    }
}

impl State {
    /// Solves the contact on a grid, beginning with a guess of its pressure, and its adjoint equations.
    fn new(
        sliding: &MaterialAtSpeed,
        grid: &Grid,
        heights: &[f64],
        control: PeriodicControl,
        mut guess: Vec<f64>,
    ) -> Result<Self, BemError> {
        let problem = PeriodicContact {
            sliding,
            grid,
            heights,
            control,
            options: PeriodicOptions::default(),
        };
        // Solve the contact from the guess, then its adjoint equations for the gradients.
        let mut pressure = solve_from(&mut guess, problem)?.pressure.pressure;
        let mut adjoint = Adjoint::new(sliding, grid, heights, &pressure)?;
        let gradients = adjoint.gradients()?;
        let along_x = adjoint.waves.along_x;
        let mean_pressure = mean(&pressure);
        pressure
            .iter_mut()
            .for_each(|value| *value -= mean_pressure);
        Ok(Self {
            grid: *grid,
            sliding: sliding.clone(),
            control,
            mean_pressure,
            pressure,
            along_x,
            gradients,
        })
    }

    /// The change from one surface to another of the same shape of grid: by heights, and by the kernel where the periods differ.
    fn between_surfaces(&self, surfaces: [&PeriodicSurface; 2]) -> Result<Change<f64>, BemError> {
        let [from, to] = surfaces.map(|surface| surface.heights(self.grid.shape()));
        let (from, mut heights) = (from?, to?);
        add_scaled(&mut heights, -1.0, &from);
        let [from, to] = surfaces.map(PeriodicSurface::period);
        if (0..2).all(|axis| from[axis].total_cmp(&to[axis]).is_eq()) {
            return Ok(self.total_change(|gradient| dot(&gradient.by_height, &heights)));
        }
        // Stretched elements have another kernel, with the same heights and pressures.
        let [from, to] = [from, to].map(|period| self.stretched_grid(period));
        let (from, to) = (from?, to?);
        let kernel = self.between_kernels([(&self.sliding, &from), (&self.sliding, &to)])?;
        let change = self.total_change(|gradient| {
            dot(&gradient.by_height, &heights) + gradient.by_kernel(&kernel)
        });
        // Force and contact area also change with the area of the period itself.
        let [from, to] = [from, to].map(|grid| grid.element_area());
        let n_elements = self.pressure.len() as f64;
        Ok(Change {
            normal_force: change
                .normal_force
                .map(|force| force + self.mean_pressure * n_elements * (to - from)),
            contact_area: change.contact_area.map(|area| area + (to / from).ln()),
            ..change
        })
    }

    /// The grid of the state with other periods.
    fn stretched_grid(&self, period: [f64; 2]) -> Result<Grid, BemError> {
        let shape = self.grid.shape();
        Grid::new(shape, [0, 1].map(|axis| period[axis] / shape[axis] as f64))
    }

    /// The change from one material to another on the same base, by the compliances of the waves along x.
    fn between_materials(&self, ends: [&MaterialAtSpeed; 2]) -> Result<Change<f64>, BemError> {
        let [from, to] = ends.map(|end| end.compliances(&self.along_x));
        let (from, to) = (from?, to?);
        let changes: Vec<_> = to.iter().zip(&from).map(|(to, from)| to - from).collect();
        Ok(self.total_change(|gradient| gradient.by_compliances(&changes)))
    }

    /// The change from one elastomer and velocity to another, by the displacements under the pressures.
    fn between_elastomers(&self, ends: [&MaterialAtSpeed; 2]) -> Result<Change<f64>, BemError> {
        let kernel = self.between_kernels(ends.map(|end| (end, &self.grid)))?;
        Ok(self.total_change(|gradient| gradient.by_kernel(&kernel)))
    }

    /// The change from one kernel to another, each that of a material on a grid with the shape of this one.
    fn between_kernels(
        &self,
        ends: [(&MaterialAtSpeed, &Grid); 2],
    ) -> Result<KernelChange, BemError> {
        let n = self.pressure.len();
        // Subtract the displacements by both kernels from each other, under the pressures and under a unit pressure.
        let mut field = vec![0.0; n];
        let mut change = KernelChange {
            displacement: vec![0.0; n],
            unit_response: vec![0.0; n],
            uniform_displacement: 0.0,
            log_wave_numbers: 0.0,
        };
        for ((sliding, grid), sign) in ends.into_iter().zip([-1.0, 1.0]) {
            let mut kernel = PeriodicKernel::new(sliding, grid)?;
            kernel.displace_centres(&self.pressure, &mut field);
            add_scaled(&mut change.displacement, sign, &field);
            kernel.displace_centres(&unit_pressure(n), &mut field);
            add_scaled(&mut change.unit_response, sign, &field);
            change.uniform_displacement += sign * sliding.mean_compliance()? * self.mean_pressure;
            change.log_wave_numbers -= sign * grid.spacing()[0].ln();
        }
        Ok(change)
    }

    /// The derivatives by the prescribed mean pressure, per pascal, or by the prescribed depth, per metre.
    fn by_load(&self) -> Change<f64> {
        let by_pressure = self.gradients.map(|gradient| gradient.by_pressure);
        match self.control {
            PeriodicControl::MeanPressure(_) => by_pressure,
            PeriodicControl::MeanDepth(_) => Change::by_depth(&self.by_force()),
        }
    }

    /// The changes by relative changes of the storage and of the loss modulus, of equal size at all frequencies of a
    /// half-open band \[rad/s].
    fn by_moduli(&self, band: [f64; 2]) -> Result<[Change<f64>; 2], BemError> {
        let compliances = self.sliding.compliances(&self.along_x)?;
        // A compliance is the inverse of a modulus, so that it changes by δC = −C² δG*.
        let of = |part: fn(Complex<f64>) -> Complex<f64>| {
            let rows = compliances.iter().zip(&self.along_x);
            let changes = rows.map(|(compliance, q_x)| {
                let frequency = self.sliding.frequency(*q_x);
                if frequency < band[0] || frequency >= band[1] {
                    return Complex::default();
                }
                -compliance * compliance * part(compliance.inv())
            });
            let changes: Vec<_> = changes.collect();
            self.total_change(|gradient| gradient.by_compliances(&changes))
        };
        Ok([
            of(|modulus| Complex::new(modulus.re, 0.0)),
            of(|modulus| Complex::new(0.0, modulus.im)),
        ])
    }

    /// The change of all quantities while the prescribed mean pressure or depth is held fixed. `under_pressure(gradient)` is the
    /// change of one quantity under a constant mean pressure.
    fn total_change(&self, under_pressure: impl Fn(&Gradient) -> f64) -> Change<f64> {
        let change = self.gradients.map(under_pressure);
        match self.control {
            PeriodicControl::MeanPressure(_) => change,
            PeriodicControl::MeanDepth(_) => change.at_constant_depth(&self.by_force()),
        }
    }

    /// The derivatives by the normal force of a period, per newton.
    fn by_force(&self) -> Change<f64> {
        let area = self.grid.element_area() * self.grid.n_elements() as f64;
        self.gradients.map(|gradient| gradient.by_pressure / area)
    }
}
