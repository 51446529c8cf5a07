//! An element that comes into contact or separates inside a step.

use super::foundation::Foundation;
use super::linear_step::{StepWork, TimeStep};

/// Change of the instant of contact or separation, as a fraction of the step, at which Newton's method for it ends. Derived:
/// convergence is quadratic, so that the next change would be about its square, 1e-18, which is below rounding.
const CROSSING_TOLERANCE: f64 = 1e-9;
/// Largest number of iterations in the search for the instant at which a load or a gap vanishes. Derived: as many bisections
/// leave 2⁻⁶⁰ of the step, which is below rounding.
const MAX_CROSSING_STEPS: usize = 60;

/// One element in a step during which it is in contact for a part of the time.
pub(crate) struct ContactEvent<'a> {
    /// Viscoelastic law of the element.
    pub(crate) foundation: &'a Foundation,
    /// Duration of the step, \[s].
    pub(crate) duration: f64,
    /// History variables: stresses e_i in contact, amplitudes β_k of recovery if free.
    pub(crate) history: &'a mut [f64],
}

impl ContactEvent<'_> {
    /// Separates a loaded element when its load vanishes; `imposed` are its displacements at the beginning and at the end of the
    /// step, between which the line moves linearly, \[m].
    ///
    /// Returns the displacement u_∞ to which it recovers \[m], and its work until separation. The energy stored at separation
    /// counts as dissipated, because it does no work during recovery.
    pub(crate) fn separate(&mut self, imposed: [f64; 2]) -> (f64, StepWork) {
        let [from, to] = imposed;
        let foundation = self.foundation;
        let n_branches = foundation.branches.len();
        let rise = to - from;
        // `load` returns the load of the element and its derivative by `part`, after the fraction `part` of the step.
        let load = |part: f64| {
            let branches = foundation.branches.iter().zip(&self.history[..n_branches]);
            let viscous = foundation.dashpot * rise / self.duration;
            let start = [
                foundation.spring * (from + part * rise) + viscous,
                foundation.spring * rise,
            ];
            branches.fold(start, |[sum, rate], (branch, stress)| {
                let a = self.duration / branch.length;
                let work = branch.modulus * rise;
                let change = (-part * a).exp_m1();
                let remaining = 1.0 + change;
                let stress_at_part = stress * remaining - work * change / a;
                [sum + stress_at_part, rate + (work - a * stress) * remaining]
            })
        };
        // The element separates where its load falls to 0. A load that is negative at the beginning separates it there: with a
        // dashpot the load jumps where the speed does.
        let part = falling_zero(load);
        let mut work = StepWork::default();
        if part > 0.0 {
            let step = TimeStep::of_branches(foundation, part * self.duration);
            work = step.compress(from, part * rise, self.history);
        }
        let displacement = from + part * rise;
        work.dissipated += foundation.stored_energy(displacement, &self.history[..n_branches]);
        let remaining_time = (1.0 - part) * self.duration;
        (self.recover(displacement, remaining_time), work)
    }

    /// Separates a loaded element instantaneously; returns the displacement u_∞ to which it recovers \[m], and the energy that was
    /// stored in it, divided by the unit of stress, \[m²].
    pub(crate) fn separate_instantly(&mut self, displacement: f64) -> (f64, f64) {
        let foundation = self.foundation;
        let n_branches = foundation.branches.len();
        let stresses = &mut self.history[..n_branches];
        let stored = foundation.stored_energy(displacement, stresses);
        if foundation.has_dashpot() {
            return (self.recover(displacement, 0.0), stored);
        }
        // Without a parallel dashpot the element rebounds until the sum of the forces of its springs is 0.
        let load = foundation.spring * displacement + stresses.iter().sum::<f64>();
        let moduli = foundation.branches.iter().map(|branch| branch.modulus);
        let rebound = load / (foundation.spring + moduli.sum::<f64>());
        foundation.apply_strain_jump(stresses, -rebound);
        (self.recover(displacement - rebound, 0.0), stored)
    }

    /// Replaces the history variables of a loaded element, the stresses at separation, by those of a free one, the amplitudes of
    /// recovery at a time \[s] after it. Returns the displacement u_∞ after complete recovery, \[m].
    fn recover(&mut self, displacement: f64, time: f64) -> f64 {
        let foundation = self.foundation;
        let stresses = self.history[..foundation.branches.len()].to_vec();
        let mut limit = displacement;
        for (variable, mode) in self.history.iter_mut().zip(&foundation.modes) {
            let amplitude = foundation.amplitude(mode, displacement, &stresses);
            limit += amplitude;
            *variable = amplitude * (-time / mode.length).exp();
        }
        // A solid recovers completely, so that its limit is exactly 0; the computed sum would differ from 0 by rounding.
        if foundation.spring > 0.0 { 0.0 } else { limit }
    }

    /// Brings a free element that recovers to the displacement `limit` into contact, when the line meets it; `imposed` are the
    /// displacements of the line at the beginning and at the end of the step, between which it moves linearly, \[m].
    pub(crate) fn make_contact(&mut self, limit: f64, imposed: [f64; 2]) -> StepWork {
        let [from, to] = imposed;
        let foundation = self.foundation;
        let rise = to - from;
        // `gap` returns the height of the line above the recovering element and its derivative by `part`, after the fraction
        // `part` of the step.
        let gap = |part: f64| {
            let history = self.history.iter().zip(&foundation.modes);
            let start = [limit - (from + part * rise), -rise];
            history.fold(start, |[gap, rate], (variable, mode)| {
                let a = self.duration / mode.length;
                let remaining = variable * (-part * a).exp();
                [gap - remaining, rate + a * remaining]
            })
        };
        // The element recovers until the gap closes, and is compressed by the line for the rest of the step.
        let part = falling_zero(gap);
        for (variable, mode) in self.history.iter_mut().zip(&foundation.modes) {
            *variable *= (-part * self.duration / mode.length).exp();
        }
        let start = from + part * rise;
        let (displacement, recovered) = self.make_contact_instantly(limit, start);
        let remaining_time = (1.0 - part) * self.duration;
        let mut work = StepWork::default();
        if remaining_time > 0.0 {
            let step = TimeStep::of_branches(foundation, remaining_time);
            work = step.compress(displacement, to - displacement, self.history);
        }
        work.dissipated -= recovered;
        work
    }

    /// Brings a free element that recovers to the displacement `limit` into contact with a line that imposes a displacement,
    /// \[m]: its amplitudes are replaced by stresses. Returns its displacement \[m], and the energy stored in it, divided by the
    /// unit of stress, \[m²].
    pub(crate) fn make_contact_instantly(&mut self, limit: f64, imposed: f64) -> (f64, f64) {
        let foundation = self.foundation;
        let remaining = self.history[..foundation.modes.len()].to_vec();
        let mut displacement = limit - remaining.iter().sum::<f64>();
        for (variable, branch) in self.history.iter_mut().zip(&foundation.branches) {
            *variable = Foundation::free_stress(branch, &remaining);
        }
        let stresses = &mut self.history[..foundation.branches.len()];
        // A parallel dashpot resists a jump of the displacement, so that the element keeps the displacement to which it has
        // recovered.
        if !foundation.has_dashpot() {
            foundation.apply_strain_jump(stresses, imposed - displacement);
            displacement = imposed;
        }
        (
            displacement,
            foundation.stored_energy(displacement, stresses),
        )
    }
}

/// Zero in [0, 1] of a falling function that returns its value and its derivative, by Newton's method inside a bracket.
///
/// 0 if the function is not positive at 0, and 1 if it is not negative at 1.
fn falling_zero(function: impl Fn(f64) -> [f64; 2]) -> f64 {
    let [start, end] = [0.0, 1.0].map(|part| function(part)[0]);
    if start <= 0.0 {
        return 0.0;
    }
    if end >= 0.0 {
        return 1.0;
    }
    // Newton steps that leave the bracket are replaced by bisection.
    let (mut low, mut high) = (0.0, 1.0);
    let mut part = start / (start - end);
    for _ in 0..MAX_CROSSING_STEPS {
        let [value, rate] = function(part);
        if value > 0.0 {
            low = part;
        } else {
            high = part;
        }
        let newton = part - value / rate;
        let next = if low <= newton && newton <= high {
            newton
        } else {
            0.5 * (low + high)
        };
        let change = next - part;
        part = next;
        if change.abs() <= CROSSING_TOLERANCE {
            break;
        }
    }
    part
}
