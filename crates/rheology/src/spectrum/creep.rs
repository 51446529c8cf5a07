//! Creep spectrum: the strain after a step of stress.
//!
//! ```text
//! J(t) = J₀ + t/η_f + Σ J_k (1 − e^(−t/λ_k))
//! J'(ω) = J₀ + Σ J_k/(1 + Ω_k²)    J''(ω) = 1/(ω η_f) + Σ J_k Ω_k/(1 + Ω_k²)    Ω_k = ω λ_k
//! ```

use super::decays::{Decay, DecayNames, normal_form};
use crate::RheologyError;
use crate::complex::{ComplexCompliance, debye};
use numerics::not_negative;

/// One Kelvin–Voigt element: a spring and a dashpot in parallel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RetardationElement {
    /// Compliance J_k of the spring, \[1/Pa].
    pub compliance: f64,
    /// Retardation time λ_k, \[s].
    pub retardation_time: f64,
}

/// A spring, a dashpot and any number of Kelvin–Voigt elements in series.
///
/// The elements are in increasing order of distinct times, their compliances greater than zero.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CreepSpectrum {
    /// Instantaneous compliance, \[1/Pa].
    instantaneous_compliance: f64,
    /// Fluidity, the inverse of the viscosity of flow, \[1/(Pa s)].
    fluidity: f64,
    /// Retarded elements by increasing time.
    elements: Vec<RetardationElement>,
}

impl CreepSpectrum {
    /// The spectrum with a spring of compliance J₀ ≥ 0 \[1/Pa], a dashpot of fluidity 1/η_f ≥ 0 [1/(Pa s)], and
    /// `elements` in any order.
    ///
    /// Elements without compliance are dropped; those whose times differ by less than one part in 10⁸ become one.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] or [`RheologyError::InvalidElement`] when a number, or a sum of them, is not
    /// finite or has the wrong sign; [`RheologyError::NoCompliance`] when nothing is left.
    pub fn new(
        instantaneous_compliance: f64,
        fluidity: f64,
        elements: Vec<RetardationElement>,
    ) -> Result<Self, RheologyError> {
        not_negative("instantaneous_compliance", instantaneous_compliance)?;
        not_negative("fluidity", fluidity)?;
        // Order and merge the elements, then check that the sums are representable.
        let decays = elements.iter().map(|element| Decay {
            amplitude: element.compliance,
            time: element.retardation_time,
        });
        let names = DecayNames {
            list: "elements",
            amplitude: "compliance",
            time: "retardation_time",
        };
        let elements = normal_form(&names, decays.collect())?
            .into_iter()
            .map(|decay| RetardationElement {
                compliance: decay.amplitude,
                retardation_time: decay.time,
            });
        let spectrum = Self::from_valid(instantaneous_compliance, fluidity, elements.collect());
        let sum = spectrum.recoverable_compliance();
        if sum == 0.0 && fluidity == 0.0 {
            return Err(RheologyError::NoCompliance);
        }
        not_negative("recoverable_compliance", sum)?;
        not_negative("initial_fluidity", spectrum.initial_fluidity())?;
        Ok(spectrum)
    }

    /// The spectrum of valid numbers, with elements in increasing order of distinct times.
    pub(crate) const fn from_valid(
        instantaneous_compliance: f64,
        fluidity: f64,
        elements: Vec<RetardationElement>,
    ) -> Self {
        Self {
            instantaneous_compliance,
            fluidity,
            elements,
        }
    }

    /// Instantaneous compliance J₀, \[1/Pa].
    pub const fn instantaneous_compliance(&self) -> f64 {
        self.instantaneous_compliance
    }

    /// Fluidity 1/η_f of the free flow, [1/(Pa s)]; 0 for a solid.
    pub const fn fluidity(&self) -> f64 {
        self.fluidity
    }

    /// The Kelvin–Voigt elements in increasing order of time.
    pub fn elements(&self) -> &[RetardationElement] {
        &self.elements
    }

    /// Whether the compliance does not depend on time.
    pub fn is_elastic(&self) -> bool {
        self.elements.is_empty() && self.fluidity == 0.0
    }

    /// Compliance J₀ + Σ J_k without flow, \[1/Pa].
    fn recoverable_compliance(&self) -> f64 {
        let elements: f64 = self.elements.iter().map(|e| e.compliance).sum();
        self.instantaneous_compliance + elements
    }

    /// Compliance J(∞), \[1/Pa]; infinite for a fluid.
    pub fn equilibrium_compliance(&self) -> f64 {
        if self.fluidity > 0.0 {
            return f64::INFINITY;
        }
        self.recoverable_compliance()
    }

    /// Rate 1/η_f + Σ J_k/λ_k of the creep compliance at t = 0, [1/(Pa s)].
    pub(crate) fn initial_fluidity(&self) -> f64 {
        let rates = self.elements.iter().map(RetardationElement::fluidity);
        self.fluidity + rates.sum::<f64>()
    }

    /// Creep compliance J(t), \[1/Pa], at a time t ≥ 0 \[s] after the stress was applied.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the time is not finite or below zero.
    pub fn creep_compliance(&self, time: f64) -> Result<f64, RheologyError> {
        let time = not_negative("time", time)?;
        let delayed: f64 = self
            .elements
            .iter()
            .map(|e| e.delayed_compliance(time))
            .sum();
        Ok(self.instantaneous_compliance + self.fluidity * time + delayed)
    }

    /// Complex compliance at an angular frequency ω ≥ 0 \[rad/s]; the loss of a fluid is infinite at ω = 0.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    pub fn complex_compliance(
        &self,
        angular_frequency: f64,
    ) -> Result<ComplexCompliance, RheologyError> {
        let omega = not_negative("angular_frequency", angular_frequency)?;
        let mut compliance = ComplexCompliance {
            storage: self.instantaneous_compliance,
            loss: 0.0,
        };
        if self.fluidity > 0.0 {
            compliance.loss = self.fluidity / omega;
        }
        for element in &self.elements {
            // The storage compliance has the factor 1/(1 + Ω²), which is Ω²/(1 + Ω²) at the inverse of Ω.
            let omega = omega * element.retardation_time;
            compliance.storage += element.compliance * debye(omega.recip())[0];
            compliance.loss += element.compliance * debye(omega)[1];
        }
        Ok(compliance)
    }
}

impl RetardationElement {
    /// Fluidity J_k/λ_k of the dashpot, [1/(Pa s)].
    pub fn fluidity(&self) -> f64 {
        self.compliance / self.retardation_time
    }

    /// Delayed compliance J_k (1 − e^(−t/λ_k)) at a time t \[s], \[1/Pa].
    pub(crate) fn delayed_compliance(&self, time: f64) -> f64 {
        let x = time / self.retardation_time;
        // Use the limit t/η of a vanishing spring with the viscosity η, because a subnormal x has lost its digits.
        if x < f64::EPSILON {
            return self.fluidity() * time;
        }
        -self.compliance * (-x).exp_m1()
    }

    /// Fraction m = λ/Δt − 1/(e^(Δt/λ) − 1) of a step by which an input held over the step acts too early.
    ///
    /// It is 1/2 for short steps and λ/Δt for long ones.
    pub fn lead(&self, time_step: f64) -> f64 {
        0.5 * (1.0 - langevin(0.5 * time_step / self.retardation_time))
    }
}

/// Langevin function ℒ(y) = coth y − 1/y for y > 0, to rounding.
fn langevin(y: f64) -> f64 {
    if y < 0.02 {
        // Use the power series for small y, whose next term is below rounding.
        let square = y * y;
        return y / 3.0 * (1.0 - square / 15.0 * (1.0 - 2.0 * square / 21.0));
    }
    y.tanh().recip() - y.recip()
}
