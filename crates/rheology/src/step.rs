//! Exponential time step, exact for any ratio of step and time constants.
//!
//! ```text
//! u_new = α w_new + history    α = J(Δt)                  w held at w_new over the step
//!                              α = (1/Δt) ∫₀^Δt J dt      w linear from w_old to w_new
//! ```
//! The history is a sum over history variables, which decay by e^(−Δt/λ) in a step and then gain their share of the input
//! and, for a linear input, of the previous input. A held input is of the first order in Δt, a linear one of the second.
//!
//! With a prescribed displacement a linear input alternates: the error of a step is −β/α times that of the previous one,
//! where β is the response to w_old. Without an instantaneous compliance β/α tends to 1 for short steps.

use crate::{ComplexCompliance, CreepSpectrum, RheologyError};
use numerics::positive;

/// Coefficients of a step of fixed length.
///
/// The state of `n` points is `n_fields() · n` numbers, field after field, zero at rest. A step calls
/// [`history`](Self::history), solves for the input, then calls [`advance`](Self::advance).
#[derive(Debug, Clone, PartialEq)]
pub struct ExponentialStep {
    /// Instantaneous compliance, \[1/Pa].
    direct: f64,
    /// Coefficients of the history variables.
    fields: Vec<Field>,
    /// Whether the state ends with the last input.
    keeps_input: bool,
    /// Fraction of the step in which the input is linear rather than held.
    linear_share: f64,
}

/// Coefficients of one history variable.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Field {
    /// Decay e^(−Δt/λ) in a step, 1 for free flow.
    decay: f64,
    /// Gain per unit of input, \[1/Pa].
    gain: f64,
    /// Gain per unit of the previous input, \[1/Pa].
    gain_before: f64,
}

/// Largest ratio β/α with which the input is taken as linear over the whole step. Here β is the response to the previous input
/// and α that to the new one. Chosen: 0.7¹⁰ ≈ 1/35 after ten steps.
const MAX_ALTERNATION: f64 = 0.7;

impl ExponentialStep {
    /// Step from load potential w \[Pa m] to displacement u \[m], with w held at its new value over a `time_step` \[s].
    ///
    /// It has one field per retardation element, and one for free flow; none for an elastic material.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the step, or its compliance, is not finite and greater than zero.
    pub fn creep(spectrum: &CreepSpectrum, time_step: f64) -> Result<Self, RheologyError> {
        positive("time_step", time_step)?;
        let flow = (spectrum.fluidity() > 0.0).then(|| Field {
            decay: 1.0,
            gain: spectrum.fluidity() * time_step,
            gain_before: 0.0,
        });
        let delayed = spectrum.elements().iter().map(|element| Field {
            decay: (-time_step / element.retardation_time).exp(),
            gain: element.delayed_compliance(time_step),
            gain_before: 0.0,
        });
        let step = Self {
            direct: spectrum.instantaneous_compliance(),
            fields: delayed.chain(flow).collect(),
            keeps_input: false,
            linear_share: 0.0,
        };
        positive("step_compliance", step.response())?;
        Ok(step)
    }

    /// Step with w linear from its value at the end of the previous step, as far as prescribed displacements permit.
    ///
    /// In a fraction of the step that would cause alternation, w is held at its new value. This is the whole step for short
    /// steps on a material without instantaneous compliance. The state has one more field than for [`creep`](Self::creep),
    /// unless the material is elastic.
    ///
    /// # Errors
    /// The errors of [`creep`](Self::creep).
    pub fn creep_linear(spectrum: &CreepSpectrum, time_step: f64) -> Result<Self, RheologyError> {
        let mut step = Self::creep(spectrum, time_step)?;
        // Compute the response to the previous input if it is linear over the whole step, and its ratio β/α to the response α to
        // the new one.
        let delayed = spectrum.elements().iter().map(|one| one.lead(time_step));
        let leads = delayed.chain((spectrum.fluidity() > 0.0).then_some(0.5));
        let whole: f64 = leads
            .clone()
            .zip(&step.fields)
            .map(|(lead, field)| lead * field.gain)
            .sum();
        let alternation = whole / (step.response() - whole);
        // Move a share of each gain to the previous input. The share is 1 unless the ratio β/α exceeds [`MAX_ALTERNATION`], and
        // falls to 0 as the ratio reaches 1.
        let share = ((1.0 - alternation) / (1.0 - MAX_ALTERNATION)).clamp(0.0, 1.0);
        for (lead, field) in leads.zip(&mut step.fields) {
            field.gain_before = share * lead * field.gain;
            field.gain -= field.gain_before;
        }
        step.keeps_input = !step.fields.is_empty();
        step.linear_share = share;
        positive("step_compliance", step.response())?;
        Ok(step)
    }

    /// Fraction of the step in which the input is linear, from 0 to 1; in the remainder the new input is held.
    pub const fn linear_share(&self) -> f64 {
        self.linear_share
    }

    /// Response α to a unit input at the end of the step, \[1/Pa].
    pub fn response(&self) -> f64 {
        let gains: f64 = self.fields.iter().map(|field| field.gain).sum();
        self.direct + gains
    }

    /// Complex compliance of the discrete steps for an oscillating input with a phase `angle` ωΔt \[rad] per step.
    pub fn harmonic_response(&self, angle: f64) -> ComplexCompliance {
        let mut response = ComplexCompliance {
            storage: self.direct,
            loss: 0.0,
        };
        let (sin, cos) = angle.sin_cos();
        for Field {
            decay,
            gain,
            gain_before,
        } in &self.fields
        {
            // Compute (gain + gain_before e^(−i ωΔt))/(1 − decay e^(−i ωΔt)), the response to an oscillation of the frequency ω,
            // without cancellation for small angles.
            let [real, imaginary] = [
                (1.0 - decay) + 2.0 * decay * (0.5 * angle).sin().powi(2),
                decay * sin,
            ];
            let square = real * real + imaginary * imaginary;
            let [gain, before] = [gain + gain_before * cos, gain_before * sin];
            response.storage += (gain * real - before * imaginary) / square;
            response.loss += (gain * imaginary + before * real) / square;
        }
        response
    }

    /// Number of history variables per point.
    pub fn n_fields(&self) -> usize {
        self.fields.len() + usize::from(self.keeps_input)
    }

    /// Output at the end of the step with zero input, for every point.
    ///
    /// # Panics
    /// If `state` does not have `n_fields() · history.len()` values.
    pub fn history(&self, state: &[f64], history: &mut [f64]) {
        let n_values = self.n_fields() * history.len();
        assert_eq!(state.len(), n_values, "shape of the state");
        history.fill(0.0);
        if history.is_empty() {
            return;
        }
        // Sum the history variables as they decay, and the response to the previous input.
        for (field, values) in self.fields.iter().zip(state.chunks_exact(history.len())) {
            for (sum, value) in history.iter_mut().zip(values) {
                *sum += field.decay * value;
            }
        }
        if self.keeps_input {
            let response: f64 = self.fields.iter().map(|field| field.gain_before).sum();
            let before = &state[n_values - history.len()..];
            for (sum, input) in history.iter_mut().zip(before) {
                *sum += response * input;
            }
        }
    }

    /// Advances the state to the end of the step; `input` is w of every point at the end of the step, \[Pa m].
    ///
    /// # Panics
    /// If `state` does not have `n_fields() · input.len()` values.
    pub fn advance(&self, input: &[f64], state: &mut [f64]) {
        let n_values = self.n_fields() * input.len();
        assert_eq!(state.len(), n_values, "shape of the state");
        if input.is_empty() {
            return;
        }
        // Update the history variables for an input that is held at its new value over the step.
        if !self.keeps_input {
            for (field, values) in self.fields.iter().zip(state.chunks_exact_mut(input.len())) {
                for (value, input) in values.iter_mut().zip(input) {
                    *value = field.decay * *value + field.gain * input;
                }
            }
            return;
        }
        // Otherwise update them for an input that is linear from the previous one, which is stored behind the history variables.
        let (state, before) = state.split_at_mut(n_values - input.len());
        for (field, values) in self.fields.iter().zip(state.chunks_exact_mut(input.len())) {
            for ((value, input), before) in values.iter_mut().zip(input).zip(&*before) {
                *value = field.decay * *value + field.gain_before * before + field.gain * input;
            }
        }
        before.copy_from_slice(input);
    }
}
