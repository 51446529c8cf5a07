//! Stress and work of a material under the waves of a moving surface in full contact.
//!
//! ```text
//! u(t) = e^(−i q x(t)),      σ(t) = ∫ G(t − s) du(s),      work = ∮ Re(σ du*/dt) dt = Σ_n T |c_n|² n ω G''(n ω)
//! ```
//!
//! for the wave number q along x, the position x(t) of the surface and the relaxation modulus G. A cycle of the duration T has the
//! frequency ω = 2π/T and u = Σ c_n e^(i n ω t), with Bessel functions c_n if x is a cosine (Jacobi–Anger expansion). Paths that
//! are straight between points are integrated in closed form, branch by branch. Steps with constant pressure turn σ into a
//! displacement other than u; a surface with this displacement has exactly the pressure σ in full contact.

use std::f64::consts::TAU;

use indenters::{MovingLoad, MovingStep, Shape};
use numerics::transforms::Real;
use numerics::whole_part;
use rheology::{CreepSpectrum, ExponentialStep, RelaxationBranch, RelaxationSpectrum};
use rustfft::num_complex::Complex;

use crate::BemError;
use crate::transform::plane_transform::ZERO;

/// Number of time samples of a cycle per radian of the largest phase of the shortest wave. Derived: the harmonics of this wave
/// reach to about its phase in radians, which takes two samples per radian (Nyquist). Twice as many suppress the harmonics
/// beyond.
const SAMPLES_PER_RADIAN: f64 = 4.0;

/// Displacement and stress of unit waves at the end of a step, one entry for each number of waves along x in the period.
#[derive(Debug, Clone)]
pub(super) struct WaveStates {
    /// Displacement u = e^(−iqx) of a unit wave, without unit.
    pub(super) displacement: Vec<Complex<f64>>,
    /// Stress σ of a unit wave, \[Pa].
    pub(super) stress: Vec<Complex<f64>>,
    /// Displacement of a unit wave, without unit, if the stress σ at the end of each step acts during all of it. In place of u it gives a march,
    /// whose pressures are held over each step, the exact stress σ in full contact.
    pub(super) with_held_pressure: Vec<Complex<f64>>,
}

/// The waves over all steps of a motion.
#[derive(Debug)]
pub(super) struct WaveMotion {
    /// States before the first step, and at the end of each.
    pub(super) states: Vec<WaveStates>,
    /// Work on unit waves over the whole motion, one entry for each number of waves along x, \[Pa].
    pub(super) work: Vec<f64>,
}

/// Relaxation and creep spectrum of a material.
pub(super) struct Spectra {
    /// Relaxation spectrum in shear.
    pub(super) relaxation: RelaxationSpectrum,
    /// Creep spectrum in shear.
    pub(super) creep: CreepSpectrum,
}

/// Response of a unit wave to a motion.
struct WaveResponse {
    /// Stress before the first step and at the end of each, \[Pa].
    stresses: Vec<Complex<f64>>,
    /// Work over all steps, \[Pa].
    work: f64,
}

/// A step of a path at constant velocity.
struct PathStep {
    /// Duration, \[s].
    duration: f64,
    /// Positions at the beginning and at the end, \[m].
    ends: [f64; 2],
    /// Velocity, \[m/s].
    velocity: f64,
}

impl WaveMotion {
    /// States of the waves with the given wave numbers along x \[rad/m] over all steps. A cycle is the limit cycle; before a path the
    /// surface has always been at its beginning.
    pub(super) fn new(
        load: &MovingLoad,
        steps: &[MovingStep],
        wave_numbers: &[f64],
        spectra: &Spectra,
    ) -> Result<Self, BemError> {
        // Find the stresses of all waves, in closed form on straight paths and from harmonics on others.
        let path = path_of(load, steps);
        let is_straight = load
            .stages()
            .iter()
            .all(|stage| stage.shape() == Shape::Triangular);
        let responses = if is_straight {
            let relaxation = &spectra.relaxation;
            let period = load.is_cycle().then(|| load.duration());
            let response = |q: &f64| piecewise_linear_response(*q, &path, relaxation, period);
            wave_numbers.iter().map(response).collect()
        } else {
            harmonic_responses(load, steps.len(), wave_numbers, &spectra.relaxation)?
        };
        // Collect displacements and stresses of all waves at the beginning and at the ends of all steps.
        let positions = std::iter::once(0.0).chain(path.iter().map(|path_step| path_step.ends[1]));
        let state = |(index, position): (usize, f64)| WaveStates {
            displacement: wave_numbers
                .iter()
                .map(|q| Complex::from_polar(1.0, -q * position))
                .collect(),
            stress: responses.iter().map(|one| one.stresses[index]).collect(),
            with_held_pressure: Vec::new(),
        };
        let mut motion = Self {
            states: positions.enumerate().map(state).collect(),
            work: responses.iter().map(|one| one.work).collect(),
        };
        motion.update_with_held_pressure(load, &path, spectra)?;
        Ok(motion)
    }

    /// Computes [`WaveStates::with_held_pressure`] of all states: marches the creep law with stresses that are held over each step.
    fn update_with_held_pressure(
        &mut self,
        load: &MovingLoad,
        path: &[PathStep],
        spectra: &Spectra,
    ) -> Result<(), BemError> {
        let creep = &spectra.creep;
        let n_values = 2 * self.work.len();
        let step_of = |path_step: &PathStep| ExponentialStep::creep(creep, path_step.duration);
        let n_fields = step_of(&path[0])?.n_fields();
        let mut memory = vec![0.0; n_fields * n_values];
        let elements = creep.elements();
        // Find the history variables at the start: those of the limit cycle, or those of a surface that has always been at the
        // beginning of its path.
        if load.is_cycle() {
            for (path_step, state) in path.iter().zip(&self.states[1..]) {
                step_of(path_step)?.advance(&real_and_imaginary_parts(&state.stress), &mut memory);
            }
            let period = load.duration();
            for (element, field) in elements.iter().zip(memory.chunks_exact_mut(n_values)) {
                // All earlier cycles contribute to the limit cycle. Their sum is a geometric series with the ratio e^(−T/λ), for
                // the duration T of a cycle and the retardation time λ.
                let left = -(-period / element.retardation_time).exp_m1();
                field.iter_mut().for_each(|value| *value /= left);
            }
        } else {
            let first = &self.states[0];
            let [stress, displacement] =
                [&first.stress, &first.displacement].map(|v| real_and_imaginary_parts(v));
            for (index, field) in memory.chunks_exact_mut(n_values).enumerate() {
                // In a material that flows, the dashpot has yielded by the whole displacement, until the stress has vanished.
                let (values, factor) = match elements.get(index) {
                    Some(element) => (&stress, element.compliance),
                    None => (&displacement, 1.0),
                };
                for (entry, value) in field.iter_mut().zip(values) {
                    *entry = factor * value;
                }
            }
        }
        self.states[0].with_held_pressure = self.states[0].displacement.clone();
        // March over the steps: the displacement at the end of each follows from the history and from the stress, which is held
        // during the step.
        let mut displaced = vec![0.0; n_values];
        for (path_step, state) in path.iter().zip(&mut self.states[1..]) {
            let (step, stress) = (step_of(path_step)?, real_and_imaginary_parts(&state.stress));
            step.history(&memory, &mut displaced);
            for (value, stress) in displaced.iter_mut().zip(&stress) {
                *value += step.response() * stress;
            }
            step.advance(&stress, &mut memory);
            let pairs = displaced.chunks_exact(2);
            state.with_held_pressure = pairs.map(|pair| Complex::new(pair[0], pair[1])).collect();
        }
        if let (true, Some(last)) = (load.is_cycle(), self.states.last()) {
            self.states[0].with_held_pressure = last.with_held_pressure.clone();
        }
        Ok(())
    }
}

/// Real and imaginary part of each value, one after the other: twice as many numbers.
fn real_and_imaginary_parts(values: &[Complex<f64>]) -> Vec<f64> {
    values
        .iter()
        .flat_map(|value| [value.re, value.im])
        .collect()
}

/// The steps of a motion at the mean velocity of their stage, with positions relative to the beginning of the motion.
fn path_of(load: &MovingLoad, steps: &[MovingStep]) -> Vec<PathStep> {
    let start = load.stages()[0].start.position;
    let mut before = 0.0;
    let path_step = |step: &MovingStep| {
        let stage = &load.stages()[step.stage];
        let ends = [before, step.end.position - start];
        before = ends[1];
        PathStep {
            duration: step.duration,
            ends,
            velocity: stage.distance() / stage.duration(),
        }
    };
    steps.iter().map(path_step).collect()
}

/// Response of a wave of the wave number `q` \[rad/m] along a piecewise linear path, in closed form: spring, dashpot and each
/// relaxation branch. `period` \[s] is that of a limit cycle; `None` for a path from rest.
fn piecewise_linear_response(
    q: f64,
    path: &[PathStep],
    relaxation: &RelaxationSpectrum,
    period: Option<f64>,
) -> WaveResponse {
    let at = |position: f64| Complex::from_polar(1.0, -q * position);
    let first = relaxation.equilibrium_modulus() * at(0.0);
    let mut work = 0.0;
    let mut stresses = vec![first];
    for path_step in path {
        // Add the stresses of spring and dashpot at the end of the step, and the work on the dashpot. The work on the spring
        // vanishes over a cycle.
        let frequency = q * path_step.velocity;
        let modulus = Complex::new(
            relaxation.equilibrium_modulus(),
            -relaxation.viscosity() * frequency,
        );
        stresses.push(modulus * at(path_step.ends[1]));
        work += relaxation.viscosity() * frequency * frequency * path_step.duration;
    }
    // Add the stresses of the relaxation branches and the work on them. In a limit cycle each branch begins with the stress in
    // which it ends.
    for branch in relaxation.branches() {
        let mut start = ZERO;
        if let Some(period) = period {
            let (end, _) = branch_stress(q, path, branch, start, |_, _| ());
            start = end / -(-period / branch.relaxation_time).exp_m1();
        }
        stresses[0] += start;
        let add = |index: usize, stress| stresses[index + 1] += stress;
        work += branch_stress(q, path, branch, start, add).1;
    }
    if let (Some(_), Some(last)) = (period, stresses.last().copied()) {
        stresses[0] = last;
    }
    WaveResponse { stresses, work }
}

/// Stress of a relaxation branch at the end of a path, and the work on it, both \[Pa] for a unit wave of the wave number `q` \[rad/m].
///
/// The branch obeys σ' + σ/τ = G u'. It begins with the stress `start`; `add(index, stress)` receives the stress at the end of each
/// step.
fn branch_stress(
    q: f64,
    path: &[PathStep],
    branch: &RelaxationBranch,
    start: Complex<f64>,
    mut add: impl FnMut(usize, Complex<f64>),
) -> (Complex<f64>, f64) {
    let (mut stress, mut work) = (start, 0.0);
    for (index, path_step) in path.iter().enumerate() {
        // Compute the displacements of the wave at both ends of the step, and the exponent with which it changes in time.
        let [from, to] = path_step.ends.map(|x| Complex::from_polar(1.0, -q * x));
        let turning = Complex::new(0.0, -q * path_step.velocity);
        let rate = turning + branch.relaxation_time.recip();
        // The forced part of the stress turns with the wave, the free part relaxes.
        let forced = turning * branch.modulus / rate;
        let free = stress - forced * from;
        let passed = -exp_m1(-rate * path_step.duration) / rate;
        work += (turning.conj() * (free * from.conj() * passed + forced * path_step.duration)).re;
        stress = free * (-path_step.duration / branch.relaxation_time).exp() + forced * to;
        add(index, stress);
    }
    (stress, work)
}

/// Difference e^z − 1 without cancellation.
fn exp_m1(z: Complex<f64>) -> Complex<f64> {
    let half = (0.5 * z.im).sin();
    Complex::new(
        z.re.exp_m1() * z.im.cos() - 2.0 * half * half,
        z.re.exp() * z.im.sin(),
    )
}

/// Responses of waves with the given wave numbers \[rad/m] in the limit cycle of a surface whose position is a cosine of time, from
/// their harmonics by Fourier transforms of one cycle.
fn harmonic_responses(
    load: &MovingLoad,
    n_steps: usize,
    wave_numbers: &[f64],
    relaxation: &RelaxationSpectrum,
) -> Result<Vec<WaveResponse>, BemError> {
    // Choose the number of time samples: a multiple of the number of steps, and enough for the shortest wave. The number of steps
    // is added for the harmonics beyond its largest phase, which fall faster than exponentially.
    let [rear, front] = load.range();
    let (half, period) = (0.5 * (front - rear), load.duration());
    let shortest = wave_numbers.iter().copied().fold(0.0, f64::max);
    let needed = SAMPLES_PER_RADIAN * shortest * half;
    let finer = whole_part((needed / n_steps as f64).ceil()) + 1;
    let count = finer * n_steps;
    // This closure returns the complex modulus at the frequency of a harmonic, and its conjugate for a negative frequency.
    let order = |index: usize| index.min(count - index);
    let frequency = |order: usize| TAU * order as f64 / period;
    let modulus = |index: usize| {
        let modulus = relaxation.complex_modulus(frequency(order(index)))?;
        let sign = if 2 * index > count { -1.0 } else { 1.0 };
        Ok(Complex::new(modulus.storage, sign * modulus.loss))
    };
    let moduli: Vec<Complex<f64>> = (0..count).map(modulus).collect::<Result<_, BemError>>()?;
    let (forward, inverse) = (f64::forward(count), f64::inverse(count));
    // The response of a wave follows from its harmonics: transform the displacements of a cycle, multiply by the moduli, and
    // transform back.
    let of_wave = |q: &f64| {
        let at = |index: usize| {
            let quarter = (0.5 * TAU * index as f64 / count as f64).sin();
            Complex::from_polar(1.0, -q * 2.0 * half * quarter * quarter)
        };
        let mut values: Vec<Complex<f64>> = (0..count).map(at).collect();
        forward.process(&mut values);
        let mut work = 0.0;
        for (index, (value, modulus)) in values.iter_mut().zip(&moduli).enumerate() {
            *value /= count as f64;
            work += value.norm_sqr() * frequency(order(index)) * modulus.im.abs() * period;
            *value *= modulus;
        }
        inverse.process(&mut values);
        let ends = (0..=n_steps).map(|step| values[step * finer % count]);
        WaveResponse {
            stresses: ends.collect(),
            work,
        }
    };
    Ok(wave_numbers.iter().map(of_wave).collect())
}
