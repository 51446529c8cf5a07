//! Compliance kernel of a sliding material for waves of pressure.
//!
//! ```text
//! û(q) = 2 p̂(q) M / (|q| E*(−q_x v)) = (1 − ν) [J'(q_x v) + i J''(q_x v)] p̂(q) M / |q|,        q_x ≥ 0
//! ```
//!
//! with the transforms û of the displacement and p̂ of the pressure, the complex creep compliance in shear J* = J' − i J'', and
//! the Poisson ratio ν. The wave vector is q, the sliding speed v, and the compliance ratio of a layer M (1 on a half space). In
//! the frame that moves with the surface a wave has the angular frequency −q_x v.
//!
//! Theory: docs/theory/stationary-half-space.md, "Periodic surfaces" and "Where the gap is evaluated".

use std::f64::consts::PI;

use numerics::positive;
#[cfg(feature = "rough")]
use rheology::CreepSpectrum;
use rheology::{Material as _, StationaryCreep, check_spectra};
use rustfft::num_complex::Complex;

use crate::parallel::reductions::mean;
use crate::stationary::periodic::fourier_multiplier::FourierMultiplier;
use crate::{Base, BemError, Elastomer, Grid};

/// A material under a surface that slides at a constant speed.
#[derive(Debug, Clone)]
pub(crate) struct Sliding {
    /// Creep of the material in shear, at the strain amplitude of the state.
    pub(super) creep: StationaryCreep,
    /// Factor 1 − ν, for the Poisson ratio ν.
    pub(crate) factor: f64,
    /// Sliding speed, \[m/s].
    velocity: f64,
    /// Base of the material: a half space of the same material, or a substrate.
    base: Base,
}

impl Sliding {
    /// Creep, base and Poisson factor of an elastomer, with the sliding speed \[m/s]. A material that flows is refused as
    /// [`BemError::FlowsUnderWaves`].
    pub(crate) fn new(elastomer: &dyn Elastomer, velocity: f64) -> Result<Self, BemError> {
        check_spectra(&elastomer.material())?;
        let creep = StationaryCreep::new(&elastomer.material(), elastomer.modulus_factors())?;
        if creep.retarded().fluidity() > 0.0 {
            return Err(BemError::FlowsUnderWaves);
        }
        Ok(Self {
            factor: 0.5
                * positive(
                    "half-space factor",
                    elastomer.material().half_space_factor(),
                )?,
            creep,
            velocity,
            base: elastomer.base(),
        })
    }

    /// The material at rest, a `time` \[s] after a step of pressure: a spring with its creep compliance at that time.
    #[cfg(feature = "rough")]
    pub(super) fn at_rest(elastomer: &dyn Elastomer, time: f64) -> Result<Self, BemError> {
        let creep = elastomer.material().creep();
        let spring = CreepSpectrum::new(creep.creep_compliance(time)?, 0.0, Vec::new())?;
        Ok(Self {
            creep: spring.into(),
            factor: 0.5 * elastomer.material().half_space_factor(),
            velocity: 0.0,
            base: elastomer.base(),
        })
    }

    /// True if the material rests on a rigid base, so that a uniform pressure displaces it by a finite distance.
    pub(super) fn is_on_rigid_base(&self) -> bool {
        self.base.is_rigid()
    }

    /// Base of the material: a half space of the same material, or a substrate.
    #[cfg(feature = "rough")]
    pub(super) const fn base(&self) -> &Base {
        &self.base
    }

    /// Sliding speed, \[m/s].
    pub(crate) const fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Angular frequency of waves with the wave number q_x \[rad/m], \[rad/s].
    pub(super) fn frequency(&self, q_x: f64) -> f64 {
        (q_x * self.velocity).abs()
    }

    /// Displacement of a layer at rest per mean pressure, \[m/Pa]; 0 for a half space, whose displacements are measured from their
    /// mean.
    pub(super) fn mean_compliance(&self) -> Result<f64, BemError> {
        Ok(self.compliances(&[0.0])?[0].re * self.base.uniform_compliance())
    }

    /// Complex compliances (1 − ν) [J'(|q_x| v) + i sign(q_x) J''(|q_x| v)], one for each wave number q_x \[rad/m] in `along_x`,
    /// \[1/Pa].
    pub(crate) fn compliances(&self, along_x: &[f64]) -> Result<Vec<Complex<f64>>, BemError> {
        let compliance = |q_x: &f64| {
            let compliance = self.creep.complex_compliance(self.frequency(*q_x))?;
            positive("storage compliance", compliance.storage)?;
            let loss = compliance.loss.copysign(*q_x);
            Ok(Complex::new(compliance.storage, loss) * self.factor)
        };
        along_x.iter().map(compliance).collect()
    }
}

/// The kernel K on one grid: a Fourier multiplier with a complex compliance for each row of the transform, that is each q_x.
///
/// A mean pressure compresses a layer, and leaves the mean of a half space where it is.
pub(super) struct PeriodicKernel {
    /// Transforms of the grid, with the stiffness |q|/M of each wave.
    waves: FourierMultiplier,
    /// Displacement per mean pressure, \[m/Pa]; 0 for a half space.
    pub(super) mean_compliance: f64,
    /// Compliance |q| û/(p̂ M) of each row at the centre of an element, \[1/Pa].
    at_centre: Vec<Complex<f64>>,
    /// Phase shift from the centre to the point at which the gap is evaluated.
    shift: Vec<Complex<f64>>,
    /// Product of both: the compliance at the point where the gap is evaluated.
    at_gap: Vec<Complex<f64>>,
}

impl PeriodicKernel {
    /// Kernel of a material at its speed on a grid, as a compliance for each wave.
    pub(super) fn new(sliding: &Sliding, grid: &Grid) -> Result<Self, BemError> {
        // Compute the compliance of each row of the transform, and from the loss angle of the shortest wave the shift θ in elements.
        let dx = grid.spacing()[0];
        let waves = FourierMultiplier::new(grid, &sliding.base);
        let along_x = &waves.along_x;
        let mut at_centre = sliding.compliances(along_x)?;
        let shortest = sliding.compliances(&[PI / dx])?[0];
        let theta = -shortest.arg() / PI;
        // A shift of the points by this distance multiplies each wave by a phase factor.
        let turn = |q_x: &f64| Complex::from_polar(1.0, q_x * theta * dx);
        let mut shift: Vec<_> = along_x.iter().map(turn).collect();
        let mut at_gap: Vec<_> = at_centre.iter().zip(&shift).map(|(c, s)| c * s).collect();
        let rows = along_x.len();
        if rows.is_multiple_of(2) {
            // The shortest wave stands for both directions, so that its symbols are real.
            let middle = rows / 2;
            at_gap[middle] = Complex::from(at_gap[middle].norm());
            for symbols in [&mut at_centre, &mut shift] {
                symbols[middle] = Complex::from(symbols[middle].re);
            }
        }
        Ok(Self {
            waves,
            mean_compliance: sliding.mean_compliance()?,
            at_centre,
            shift,
            at_gap,
        })
    }

    /// Displacements \[m] under a pressure field \[Pa], at the points where the gaps are evaluated.
    pub(super) fn displace(&mut self, pressure: &[f64], result: &mut [f64]) {
        let symbol = |row: usize, [_, q]: [f64; 2]| self.at_gap[row] / q;
        self.waves.apply(pressure, result, symbol);
        set_mean(result, self.mean_compliance * mean(pressure));
    }

    /// Displacements \[m] under a pressure field \[Pa], at the centres of the elements; the mean has no meaning.
    #[cfg(feature = "rough")]
    pub(super) fn displace_centres(&mut self, pressure: &[f64], result: &mut [f64]) {
        let symbol = |row: usize, [_, q]: [f64; 2]| self.at_centre[row] / q;
        self.waves.apply(pressure, result, symbol);
    }

    /// Symbols of K over `self_influence`, and of the inverse of that, for
    /// [`apply_single_precision`](Self::apply_single_precision).
    ///
    /// The inverse has the mean of the longest wave, so that it exists on a half space too.
    pub(super) fn symbols(&self, self_influence: f64) -> [Vec<Complex<f32>>; 2] {
        let factor = |row: usize, q: f64| self.at_gap[row] / (q * self_influence);
        let mean = self.mean_compliance / self_influence;
        [
            self.waves.symbols(Some(mean), factor),
            self.waves.symbols(None, |row, q| factor(row, q).inv()),
        ]
    }

    /// The pressure without mean \[Pa] under which the points where gaps are evaluated are displaced by a field \[m] less its mean.
    pub(super) fn invert(&mut self, field: &[f64], result: &mut [f64]) {
        let symbol = |row: usize, [_, q]: [f64; 2]| self.at_gap[row].inv() * q;
        self.waves.apply(field, result, symbol);
        set_mean(result, 0.0);
    }

    /// The pressure \[Pa] under which the centres of all elements are displaced by a field \[m]; its mean has no meaning.
    pub(super) fn invert_at_centre(&mut self, field: &[f64], result: &mut [f64]) {
        let symbol = |row: usize, [_, q]: [f64; 2]| self.at_centre[row].inv() * q;
        self.waves.apply(field, result, symbol);
    }

    /// Symbols of K (1 + w K)⁻¹ at the centres, with K over `self_influence` and one `weight` w for all elements.
    pub(super) fn relaxation(&self, weight: f64, self_influence: f64) -> Vec<Complex<f32>> {
        let mean = self.mean_compliance / self_influence;
        self.waves
            .symbols(Some(mean / (mean * weight + 1.0)), |row, q| {
                let kernel = self.at_centre[row] / self_influence;
                kernel / (kernel * weight + q)
            })
    }

    /// Multiplies every wave of a field by its symbol, in single precision.
    pub(super) fn apply_single_precision(
        &mut self,
        symbols: &[Complex<f32>],
        field: &[f32],
        result: &mut [f32],
    ) {
        self.waves.apply_single_precision(field, result, symbols);
    }

    /// Heights at the points where the gaps are evaluated, by trigonometric interpolation of those at the centres.
    pub(super) fn shifted(&mut self, heights: &[f64], result: &mut [f64]) {
        self.waves.apply(heights, result, |row, _| self.shift[row]);
    }

    /// Slopes ∂h/∂x at the centres of the elements, of the trigonometric polynomial through the heights.
    pub(super) fn slopes(&mut self, heights: &[f64], result: &mut [f64]) {
        let rows = self.shift.len();
        self.waves.apply(heights, result, |row, [q_x, _]| {
            // The slope of the shortest wave vanishes at the centres.
            Complex::new(0.0, if 2 * row == rows { 0.0 } else { q_x })
        });
    }

    /// The field −∂u/∂x of the displacement u under a pressure field, of which only the dissipative part is kept. Its mean product with
    /// the pressure is the dissipated power per area and velocity, \[Pa].
    pub(super) fn dissipate(&mut self, pressure: &[f64], result: &mut [f64]) {
        let symbol =
            |row: usize, [q_x, q]: [f64; 2]| Complex::from(q_x * self.at_centre[row].im / q);
        self.waves.apply(pressure, result, symbol);
    }
}

/// Adds a constant to a field so that its mean is `prescribed`.
fn set_mean(field: &mut [f64], prescribed: f64) {
    let shift = prescribed - mean(field);
    field.iter_mut().for_each(|value| *value += shift);
}
