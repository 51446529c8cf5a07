//! What material feels that a wave of a moving surface never leaves, as in full contact.
//!
//! ```text
//! u(t) = e^(−i q x(t)),      σ(t) = ∫ G(t − s) du(s),      work = ∮ Re(σ du*/dt) dt = Σ_n T |c_n|² n ω G''(n ω)
//! ```
//!
//! for the wave number q along x and u = Σ c_n e^(i n ω t), by Jacobi and Anger's expansion a sum of Bessel functions where x is
//! a cosine. Paths that are straight between points are integrated in closed form, branch by branch. Steps that hold the
//! pressure turn σ into another displacement than u; a surface with this one has exactly the pressure σ in full contact.

use std::f64::consts::TAU;

use indenters::{MovingLoad, MovingStep, Shape};
use numerics::transforms::Real;
use numerics::whole_part;
use rheology::{CreepSpectrum, ExponentialStep, RelaxationBranch, RelaxationSpectrum};
use rustfft::num_complex::Complex;

use crate::BemError;
use crate::transform::plane_transform::ZERO;

/// Times of a cycle for each radian of the phase of the shortest wave, and besides: harmonics beyond are below rounding.
const TIMES_PER_RADIAN: f64 = 4.0;
const TIMES_BESIDES: f64 = 96.0;

/// All waves along x at the end of a step, by their number in the period.
#[derive(Debug, Clone)]
pub(super) struct WaveStates {
    /// u.
    pub(super) displacement: Vec<Complex<f64>>,
    /// σ, \[Pa].
    pub(super) stress: Vec<Complex<f64>>,
    /// The displacement under σ where that is held over every step.
    pub(super) held: Vec<Complex<f64>>,
}

/// A motion as waves see it.
#[derive(Debug)]
pub(super) struct WaveMotion {
    /// Before the first step, and at the end of each.
    pub(super) states: Vec<WaveStates>,
    /// Work on unit waves by their number, \[Pa].
    pub(super) work: Vec<f64>,
}

/// The material, in both forms.
pub(super) struct Spectra {
    pub(super) relaxation: RelaxationSpectrum,
    pub(super) creep: CreepSpectrum,
}

/// Stresses of a unit wave \[Pa], before the first step and at the end of each, and the work on it \[Pa].
type Stressed = (Vec<Complex<f64>>, f64);

/// A step of a path: how long it takes, and where it begins and ends.
struct Leg {
    duration: f64,
    ends: [f64; 2],
    velocity: f64,
}

impl WaveMotion {
    /// FourierMultiplier of some numbers along x \[rad/m]; in a cycle all that came before was the same, and before a path the surface has
    /// been at its beginning without end.
    pub(super) fn new(
        load: &MovingLoad,
        steps: &[MovingStep],
        wave_numbers: &[f64],
        spectra: &Spectra,
    ) -> Result<Self, BemError> {
        let legs = legs(load, steps);
        let is_straight = load
            .stages()
            .iter()
            .all(|stage| stage.shape() == Shape::Triangular);
        let stresses = if is_straight {
            let relaxation = &spectra.relaxation;
            let period = load.is_cycle().then(|| load.duration());
            let stress = |q: &f64| straight(*q, &legs, relaxation, period);
            wave_numbers.iter().map(stress).collect()
        } else {
            harmonic(load, steps.len(), wave_numbers, &spectra.relaxation)?
        };
        let places = std::iter::once(0.0).chain(legs.iter().map(|leg| leg.ends[1]));
        let state = |(index, place): (usize, f64)| WaveStates {
            displacement: wave_numbers
                .iter()
                .map(|q| Complex::from_polar(1.0, -q * place))
                .collect(),
            stress: stresses.iter().map(|(stress, _)| stress[index]).collect(),
            held: Vec::new(),
        };
        let mut motion = Self {
            states: places.enumerate().map(state).collect(),
            work: stresses.iter().map(|(_, work)| *work).collect(),
        };
        motion.hold(load, &legs, spectra)?;
        Ok(motion)
    }

    /// Finds the displacements under stresses that are held.
    fn hold(&mut self, load: &MovingLoad, legs: &[Leg], spectra: &Spectra) -> Result<(), BemError> {
        let creep = &spectra.creep;
        let n_values = 2 * self.work.len();
        let step_of = |leg: &Leg| ExponentialStep::creep(creep, leg.duration);
        let n_fields = step_of(&legs[0])?.n_fields();
        let mut memory = vec![0.0; n_fields * n_values];
        let elements = creep.elements();
        if load.is_cycle() {
            for (leg, state) in legs.iter().zip(&self.states[1..]) {
                step_of(leg)?.advance(&parts(&state.stress), &mut memory);
            }
            let period = load.duration();
            for (element, field) in elements.iter().zip(memory.chunks_exact_mut(n_values)) {
                let left = -(-period / element.retardation_time).exp_m1();
                field.iter_mut().for_each(|value| *value /= left);
            }
        } else {
            let first = &self.states[0];
            let [stress, displacement] = [&first.stress, &first.displacement].map(|v| parts(v));
            for (index, field) in memory.chunks_exact_mut(n_values).enumerate() {
                // What flows has given way until nothing presses any more.
                let (values, factor) = match elements.get(index) {
                    Some(element) => (&stress, element.compliance),
                    None => (&displacement, 1.0),
                };
                for (place, value) in field.iter_mut().zip(values) {
                    *place = factor * value;
                }
            }
        }
        self.states[0].held = self.states[0].displacement.clone();
        let mut displaced = vec![0.0; n_values];
        for (leg, state) in legs.iter().zip(&mut self.states[1..]) {
            let (step, stress) = (step_of(leg)?, parts(&state.stress));
            step.history(&memory, &mut displaced);
            for (value, stress) in displaced.iter_mut().zip(&stress) {
                *value += step.response() * stress;
            }
            step.advance(&stress, &mut memory);
            let (real, imaginary) = displaced.split_at(n_values / 2);
            let pairs = real.iter().zip(imaginary);
            state.held = pairs.map(|(re, im)| Complex::new(*re, *im)).collect();
        }
        if let (true, Some(last)) = (load.is_cycle(), self.states.last()) {
            self.states[0].held = last.held.clone();
        }
        Ok(())
    }
}

/// Real and imaginary parts, one after the other.
fn parts(values: &[Complex<f64>]) -> Vec<f64> {
    let real = values.iter().map(|value| value.re);
    real.chain(values.iter().map(|value| value.im)).collect()
}

/// Positions from the beginning on.
fn legs(load: &MovingLoad, steps: &[MovingStep]) -> Vec<Leg> {
    let start = load.stages()[0].start.position;
    let mut before = 0.0;
    let leg = |step: &MovingStep| {
        let stage = &load.stages()[step.stage];
        let ends = [before, step.end.position - start];
        before = ends[1];
        Leg {
            duration: step.duration,
            ends,
            velocity: stage.distance() / stage.duration(),
        }
    };
    steps.iter().map(leg).collect()
}

/// Stresses and work of a wave along a path that is straight between its points; it has a period \[s] or none.
fn straight(
    q: f64,
    legs: &[Leg],
    relaxation: &RelaxationSpectrum,
    period: Option<f64>,
) -> Stressed {
    let at = |place: f64| Complex::from_polar(1.0, -q * place);
    let first = relaxation.equilibrium_modulus() * at(0.0);
    let mut work = 0.0;
    let mut stresses = vec![first];
    for leg in legs {
        // Of spring and dashpot; the spring gives back what it takes in a cycle.
        let frequency = q * leg.velocity;
        let modulus = Complex::new(
            relaxation.equilibrium_modulus(),
            -relaxation.viscosity() * frequency,
        );
        stresses.push(modulus * at(leg.ends[1]));
        work += relaxation.viscosity() * frequency * frequency * leg.duration;
    }
    for branch in relaxation.branches() {
        let mut start = ZERO;
        if let Some(period) = period {
            let (end, _) = branch_stress(q, legs, branch, start, |_, _| ());
            start = end / -(-period / branch.relaxation_time).exp_m1();
        }
        stresses[0] += start;
        let add = |index: usize, stress| stresses[index + 1] += stress;
        work += branch_stress(q, legs, branch, start, add).1;
    }
    if let (Some(_), Some(last)) = (period, stresses.last().copied()) {
        stresses[0] = last;
    }
    (stresses, work)
}

/// The stress of a branch at the end of a path, and the work on it; `each` is told that at the end of every leg.
fn branch_stress(
    q: f64,
    legs: &[Leg],
    branch: &RelaxationBranch,
    start: Complex<f64>,
    mut each: impl FnMut(usize, Complex<f64>),
) -> (Complex<f64>, f64) {
    let (mut stress, mut work) = (start, 0.0);
    for (index, leg) in legs.iter().enumerate() {
        let [from, to] = leg.ends.map(|place| Complex::from_polar(1.0, -q * place));
        let turning = Complex::new(0.0, -q * leg.velocity);
        let rate = turning + branch.relaxation_time.recip();
        // The part of the stress that turns with the wave, and the one that relaxes.
        let forced = turning * branch.modulus / rate;
        let free = stress - forced * from;
        let passed = -exp_m1(-rate * leg.duration) / rate;
        work += (turning.conj() * (free * from.conj() * passed + forced * leg.duration)).re;
        stress = free * (-leg.duration / branch.relaxation_time).exp() + forced * to;
        each(index, stress);
    }
    (stress, work)
}

/// e^z − 1 without cancellation.
fn exp_m1(z: Complex<f64>) -> Complex<f64> {
    let half = (0.5 * z.im).sin();
    Complex::new(
        z.re.exp_m1() * z.im.cos() - 2.0 * half * half,
        z.re.exp() * z.im.sin(),
    )
}

/// Stresses and work of waves under a surface whose position is a cosine of time, from their harmonics.
fn harmonic(
    load: &MovingLoad,
    n_steps: usize,
    wave_numbers: &[f64],
    relaxation: &RelaxationSpectrum,
) -> Result<Vec<Stressed>, BemError> {
    let [rear, front] = load.range();
    let (half, period) = (0.5 * (front - rear), load.duration());
    let shortest = wave_numbers.iter().copied().fold(0.0, f64::max);
    let needed = TIMES_PER_RADIAN * shortest * half + TIMES_BESIDES;
    let finer = whole_part((needed / n_steps as f64).ceil()).max(1);
    let count = finer * n_steps;
    let order = |index: usize| index.min(count - index);
    let frequency = |order: usize| TAU * order as f64 / period;
    let modulus = |index: usize| {
        let modulus = relaxation.complex_modulus(frequency(order(index)))?;
        let sign = if 2 * index > count { -1.0 } else { 1.0 };
        Ok(Complex::new(modulus.storage, sign * modulus.loss))
    };
    let moduli: Vec<Complex<f64>> = (0..count).map(modulus).collect::<Result<_, BemError>>()?;
    let (forward, inverse) = (f64::forward(count), f64::inverse(count));
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
        (ends.collect(), work)
    };
    Ok(wave_numbers.iter().map(of_wave).collect())
}
