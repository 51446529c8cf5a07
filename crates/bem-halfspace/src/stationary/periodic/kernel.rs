//! Compliance kernel of a sliding material for waves of pressure.
//!
//! ```text
//! û(q) = 2 p̂(q) M / (|q| E*(−q_x v)) = (1 − ν) [J'(q_x v) + i J''(q_x v)] p̂(q) M / |q|,        q_x ≥ 0
//! ```
//!
//! with the transforms û of the displacement and p̂ of the pressure, the complex creep compliance in shear J* = J' − i J'', and
//! the Poisson ratio ν. The wave vector is q, the sliding speed v, and the compliance ratio of a layer M (1 on a half space). In
//! the frame that moves with the surface a wave has the angular frequency −q_x v. For q = 0 see `fourier_multiplier.rs`.
//!
//! The operator K of these files contains the compliance of the material; that of `march` is the one of the influence coefficients alone.
//!
//! The gap of an element is evaluated at the distance θ Δx from its centre along x. The shift cancels the loss angle δ of the shortest
//! (Nyquist) wave along x, whose symbol is then real and positive: θ = −δ/π, which is −1/2, the rear edge, on a dashpot and 0, the centre,
//! on a spring. Pressures are those at the centres.
//!
//! Theory: docs/theory/stationary-half-space.md, "Periodic surfaces" and "Where the gap is evaluated".

use std::f64::consts::PI;

use numerics::positive;
use rheology::{CreepSpectrum, Material as _, StationaryCreep, check_spectra};
use rustfft::num_complex::Complex;

use crate::parallel::reductions::mean;
use crate::stationary::periodic::fourier_multiplier::{FourierMultiplier, Wave};
use crate::stationary::periodic::load::PeriodicLoad;
use crate::substrate::base::check_no_wave_shift;
use crate::{Base, BemError, Elastomer, Grid, WaveShift};

/// A material at a constant sliding speed v, at which waves of the wave number q_x have the frequency q_x v; or at rest, some time after a
/// step of pressure, where it is a spring with the creep compliance at that time.
#[derive(Debug, Clone)]
pub(crate) struct MaterialAtSpeed {
    /// Creep of the material in shear, at the strain amplitude of the state.
    pub(super) creep: StationaryCreep,
    /// Factor 1 − ν, for the Poisson ratio ν.
    pub(crate) factor: f64,
    /// Sliding speed, \[m/s].
    velocity: f64,
    /// Base of the material: a half space of the same material, or a substrate.
    base: Base,
    /// Shift of the creep by the wavelength; `None` for the same creep under all waves.
    wave_shift: Option<WaveShift>,
}

impl MaterialAtSpeed {
    /// The material under a load: at its sliding speed, or at rest after the duration of its pressure.
    pub(super) fn under_load(
        elastomer: &dyn Elastomer,
        load: &PeriodicLoad,
    ) -> Result<Self, BemError> {
        match load.duration() {
            None => Self::new(elastomer, load.velocity()),
            Some(duration) => Self::at_rest(elastomer, duration),
        }
    }

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
            wave_shift: elastomer.wave_shift(),
        })
    }

    /// The material at rest, a `time` \[s] after a step of pressure: a spring with its creep compliance at that time.
    fn at_rest(elastomer: &dyn Elastomer, time: f64) -> Result<Self, BemError> {
        check_no_wave_shift(elastomer)?;
        let creep = elastomer.material().creep();
        let spring = CreepSpectrum::new(creep.creep_compliance(time)?, 0.0, Vec::new())?;
        Ok(Self {
            creep: spring.into(),
            factor: 0.5 * elastomer.material().half_space_factor(),
            velocity: 0.0,
            base: elastomer.base(),
            wave_shift: None,
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
        Ok(self.compliance(0.0, 0.0)?.re * self.base.uniform_compliance())
    }

    /// Complex compliances (1 − ν) [J'(|q_x| v) + i sign(q_x) J''(|q_x| v)], one for each wave number q_x \[rad/m] in `along_x`,
    /// \[1/Pa], of waves that are not shifted.
    pub(crate) fn compliances(&self, along_x: &[f64]) -> Result<Vec<Complex<f64>>, BemError> {
        let compliance = |q_x: &f64| self.compliance_at(*q_x, self.frequency(*q_x));
        along_x.iter().map(compliance).collect()
    }

    /// Complex compliance of a wave with the wave numbers q_x along x and q in all, \[rad/m].
    fn compliance(&self, q_x: f64, q: f64) -> Result<Complex<f64>, BemError> {
        let [time_factor, modulus_factor] =
            (self.wave_shift.as_ref()).map_or([1.0; 2], |shift| shift.factors(q));
        let compliance = self.compliance_at(q_x, self.frequency(q_x) * time_factor)?;
        Ok(compliance / modulus_factor)
    }

    /// Complex compliance at an angular frequency \[rad/s], with the sign of the wave number q_x \[rad/m].
    fn compliance_at(&self, q_x: f64, frequency: f64) -> Result<Complex<f64>, BemError> {
        let compliance = self.creep.complex_compliance(frequency)?;
        positive("storage compliance", compliance.storage)?;
        let loss = compliance.loss.copysign(q_x);
        Ok(Complex::new(compliance.storage, loss) * self.factor)
    }
}

/// Complex compliances of the waves of a grid, \[1/Pa].
struct PerWave {
    /// One compliance for each row of the transform, or one for each wave, `[column][row]`.
    values: Vec<Complex<f64>>,
    /// True if all waves of a row have the same compliance.
    is_by_row: bool,
}

impl PerWave {
    /// The compliance of a wave.
    fn of(&self, wave: &Wave) -> Complex<f64> {
        self.values[if self.is_by_row { wave.row } else { wave.index }]
    }
}

/// The kernel K on one grid: a Fourier multiplier with a complex compliance for each row of the transform, or for each wave if times and
/// moduli depend on the wavelength.
///
/// A mean pressure compresses a layer. The displacements of a half space are measured from their mean.
pub(super) struct PeriodicKernel {
    /// Transforms of the grid, with the reduced wave number |q|/M of each wave.
    waves: FourierMultiplier,
    /// Displacement per mean pressure, \[m/Pa]; 0 for a half space.
    pub(super) mean_compliance: f64,
    /// Compliance |q| û/(p̂ M) for displacements at the centres of the elements.
    at_centre: PerWave,
    /// Phase factor e^(i q_x θ Δx) of each row, from the centres to the points where gaps are evaluated.
    shift: Vec<Complex<f64>>,
    /// Product of compliance and phase factor: the compliance for displacements at the points where gaps are evaluated.
    at_gap: PerWave,
}

impl PeriodicKernel {
    /// Kernel of a material at its speed on a grid, as a compliance for each wave.
    pub(super) fn new(sliding: &MaterialAtSpeed, grid: &Grid) -> Result<Self, BemError> {
        // Compute the compliance of each row of the transform, or of each wave, and from the loss angle of the shortest wave the shift θ in
        // elements (head of this file).
        let dx = grid.spacing()[0];
        let waves = FourierMultiplier::new(grid, &sliding.base);
        let along_x = &waves.along_x;
        let is_by_row = sliding.wave_shift.is_none();
        let mut at_centre: Vec<Complex<f64>> = if is_by_row {
            sliding.compliances(along_x)?
        } else {
            let of_waves = waves.wave_numbers();
            of_waves
                .map(|[q_x, q]| sliding.compliance(q_x, q))
                .collect::<Result<_, _>>()?
        };
        let theta = -sliding.compliance(PI / dx, PI / dx)?.arg() / PI;
        // The shift multiplies each wave by a phase factor.
        let turn = |q_x: &f64| Complex::from_polar(1.0, q_x * theta * dx);
        let mut shift: Vec<_> = along_x.iter().map(turn).collect();
        let of_rows = shift.iter().cycle();
        let mut at_gap: Vec<_> = at_centre.iter().zip(of_rows).map(|(c, s)| c * s).collect();
        let rows = along_x.len();
        if rows.is_multiple_of(2) {
            // The shortest wave along x stands for both directions, so that its symbols are real.
            for middle in (rows / 2..at_gap.len()).step_by(rows) {
                at_gap[middle] = Complex::from(at_gap[middle].norm());
                at_centre[middle] = Complex::from(at_centre[middle].re);
            }
            shift[rows / 2] = Complex::from(shift[rows / 2].re);
        }
        let [at_centre, at_gap] = [at_centre, at_gap].map(|values| PerWave { values, is_by_row });
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
        let symbol = |wave: &Wave| self.at_gap.of(wave) / wave.reduced_wave_number;
        self.waves.apply(pressure, result, symbol);
        set_mean(result, self.mean_compliance * mean(pressure));
    }

    /// Displacements \[m] under a pressure field \[Pa], at the centres of the elements; their mean is arbitrary.
    #[cfg(feature = "rough")]
    pub(super) fn displace_centres(&mut self, pressure: &[f64], result: &mut [f64]) {
        let symbol = |wave: &Wave| self.at_centre.of(wave) / wave.reduced_wave_number;
        self.waves.apply(pressure, result, symbol);
    }

    /// Symbols of K over `self_influence`, and of the inverse of that, for
    /// [`apply_single_precision`](Self::apply_single_precision).
    ///
    /// The inverse has for the mean the symbol of the longest wave.
    pub(super) fn symbols(&self, self_influence: f64) -> [Vec<Complex<f32>>; 2] {
        let factor = |w: &Wave| self.at_gap.of(w) / (w.reduced_wave_number * self_influence);
        let mean = self.mean_compliance / self_influence;
        [
            self.waves.symbols(Some(mean), factor),
            self.waves.symbols(None, |wave| factor(wave).inv()),
        ]
    }

    /// The pressure without mean \[Pa] under which the points where gaps are evaluated are displaced by a field \[m] less its mean.
    pub(super) fn invert(&mut self, field: &[f64], result: &mut [f64]) {
        let symbol = |wave: &Wave| self.at_gap.of(wave).inv() * wave.reduced_wave_number;
        self.waves.apply(field, result, symbol);
        set_mean(result, 0.0);
    }

    /// The pressure \[Pa] under which the centres of all elements are displaced by a field \[m]; its mean is arbitrary.
    pub(super) fn invert_at_centre(&mut self, field: &[f64], result: &mut [f64]) {
        let symbol = |wave: &Wave| self.at_centre.of(wave).inv() * wave.reduced_wave_number;
        self.waves.apply(field, result, symbol);
    }

    /// Symbols of (K⁻¹ + w)⁻¹ = K (1 + w K)⁻¹ at the centres, with K over `self_influence`: the compliance K in parallel with springs of
    /// one conductance `w` for all elements.
    pub(super) fn parallel_compliance(&self, w: f64, self_influence: f64) -> Vec<Complex<f32>> {
        let mean = self.mean_compliance / self_influence;
        self.waves.symbols(Some(mean / (mean * w + 1.0)), |wave| {
            let kernel = self.at_centre.of(wave) / self_influence;
            kernel / (kernel * w + wave.reduced_wave_number)
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
        self.waves
            .apply(heights, result, |wave| self.shift[wave.row]);
    }

    /// Slopes ∂h/∂x at the centres of the elements, of the trigonometric polynomial through the heights.
    pub(super) fn slopes(&mut self, heights: &[f64], result: &mut [f64]) {
        let rows = self.shift.len();
        self.waves.apply(heights, result, |wave| {
            // The slope of the shortest wave vanishes at the centres.
            Complex::new(0.0, if 2 * wave.row == rows { 0.0 } else { wave.q_x })
        });
    }

    /// Slopes −∂u''/∂x at the centres, without unit, of the displacement u'' by the loss compliances under a pressure field \[Pa]. Their mean
    /// product with the pressure is the dissipated power per area and velocity, \[Pa].
    pub(super) fn negative_loss_slopes(&mut self, pressure: &[f64], result: &mut [f64]) {
        let symbol =
            |w: &Wave| Complex::from(w.q_x * self.at_centre.of(w).im / w.reduced_wave_number);
        self.waves.apply(pressure, result, symbol);
    }
}

/// Adds a constant to a field so that its mean is `prescribed`.
fn set_mean(field: &mut [f64], prescribed: f64) {
    let shift = prescribed - mean(field);
    field.iter_mut().for_each(|value| *value += shift);
}
