//! One step in time, exact for any ratio of step and time constants.
//!
//! ```text
//! u_new = α w_new + history    α = J(Δt)    w held at w_new over the step
//! ```
//! The history is the sum over fields that decay by e^(−Δt/λ) in a step and then gain their share of the input.

use crate::{ComplexCompliance, CreepSpectrum, RheologyError};
use numerics::positive;

/// Coefficients of a step of fixed length.
///
/// The state of `n` points is `n_fields() · n` numbers, field after field, zero at rest. A step calls
/// [`history`](Self::history), solves for the input, then calls [`advance`](Self::advance).
#[derive(Debug, Clone, PartialEq)]
pub struct ExponentialStep {
    /// What the input adds at once, without a field.
    direct: f64,
    fields: Vec<Field>,
}

/// A decay e^(−Δt/λ), 1 for free flow, and the gain per unit of input.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Field {
    decay: f64,
    gain: f64,
}

impl ExponentialStep {
    /// From load potential w \[Pa m] to displacement u \[m], with w held at its new value over a `time_step` \[s].
    ///
    /// One field per retardation element, and one for free flow; none for an elastic material.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the step, or its compliance, is not finite and greater than zero.
    pub fn creep(spectrum: &CreepSpectrum, time_step: f64) -> Result<Self, RheologyError> {
        positive("time_step", time_step)?;
        let flow = (spectrum.fluidity() > 0.0).then(|| Field {
            decay: 1.0,
            gain: spectrum.fluidity() * time_step,
        });
        let delayed = spectrum.elements().iter().map(|element| Field {
            decay: (-time_step / element.retardation_time).exp(),
            gain: element.yielded(time_step),
        });
        let step = Self {
            direct: spectrum.instantaneous_compliance(),
            fields: delayed.chain(flow).collect(),
        };
        positive("step_compliance", step.response())?;
        Ok(step)
    }

    /// What one unit of input adds to the output of its step: α \[1/Pa].
    pub fn response(&self) -> f64 {
        let gains: f64 = self.fields.iter().map(|field| field.gain).sum();
        self.direct + gains
    }

    /// Output of the last of very many steps whose inputs turn by an `angle` \[rad] from each to the next, over the last
    /// input: the complex compliance at the frequency angle/Δt, of inputs that are held over each step.
    pub fn turning_response(&self, angle: f64) -> ComplexCompliance {
        let mut response = ComplexCompliance {
            storage: self.direct,
            loss: 0.0,
        };
        for Field { decay, gain } in &self.fields {
            // gain/(1 − decay e^(−i angle)), without cancellation for small angles.
            let [real, imaginary] = [
                (1.0 - decay) + 2.0 * decay * (0.5 * angle).sin().powi(2),
                decay * angle.sin(),
            ];
            let square = real * real + imaginary * imaginary;
            response.storage += gain * real / square;
            response.loss += gain * imaginary / square;
        }
        response
    }

    /// Number of stored values per point.
    pub fn n_fields(&self) -> usize {
        self.fields.len()
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
        for (field, values) in self.fields.iter().zip(state.chunks_exact(history.len())) {
            for (sum, value) in history.iter_mut().zip(values) {
                *sum += field.decay * value;
            }
        }
    }

    /// Moves the state to the end of the step, given the `input` of every point: w held over the step.
    ///
    /// # Panics
    /// If `state` does not have `n_fields() · input.len()` values.
    pub fn advance(&self, input: &[f64], state: &mut [f64]) {
        let n_values = self.n_fields() * input.len();
        assert_eq!(state.len(), n_values, "shape of the state");
        if input.is_empty() {
            return;
        }
        for (field, values) in self.fields.iter().zip(state.chunks_exact_mut(input.len())) {
            for (value, input) in values.iter_mut().zip(input) {
                *value = field.decay * *value + field.gain * input;
            }
        }
    }
}
