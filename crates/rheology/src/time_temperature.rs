//! Time–temperature superposition: a change of temperature multiplies all times by a factor a_T.
//!
//! ```text
//! WLF:        log₁₀ a_T = −C₁ (T − T_r)/(C₂ + T − T_r)
//! Arrhenius:  ln a_T = E_a/R (1/T − 1/T_r),  temperatures above absolute zero
//! ```
//! (Williams, Landel & Ferry 1955, J. Am. Chem. Soc. 77, 3701, DOI 10.1021/ja01619a008)

use crate::{RelaxationBranch, RelaxationSpectrum, RheologyError};
use numerics::{finite, positive};

/// Gas constant R, [J/(mol K)], exact in the SI since 2019.
const GAS_CONSTANT: f64 = 8.314_462_618_153_24;

/// The law of Williams, Landel and Ferry; temperatures may be in °C or in K.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WlfShift {
    /// Constant C₁.
    c1: f64,
    /// Constant C₂, \[K].
    c2: f64,
    /// Reference temperature T_r, \[°C] or \[K].
    reference_temperature: f64,
}

/// The law of Arrhenius.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ArrheniusShift {
    /// Activation energy, \[J/mol].
    activation_energy: f64,
    /// Reference temperature T_r, \[K].
    reference_temperature: f64,
}

impl WlfShift {
    /// The law with the constants C₁ > 0 and C₂ > 0 \[K] about a reference temperature.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when a number is not finite or a constant not greater than zero.
    pub fn new(c1: f64, c2: f64, reference_temperature: f64) -> Result<Self, RheologyError> {
        Ok(Self {
            c1: positive("c1", c1)?,
            c2: positive("c2", c2)?,
            reference_temperature: finite("temperature", reference_temperature)?,
        })
    }

    /// Constants C₁ (dimensionless) and C₂, \[K].
    pub const fn constants(&self) -> [f64; 2] {
        [self.c1, self.c2]
    }

    /// log₁₀ a_T at a temperature.
    ///
    /// # Errors
    /// [`RheologyError::BelowWlfPole`] at and below T_r − C₂, where the law has no meaning.
    pub fn log10_factor(&self, temperature: f64) -> Result<f64, RheologyError> {
        let above_reference = finite("temperature", temperature)? - self.reference_temperature;
        if above_reference <= -self.c2 {
            return Err(RheologyError::BelowWlfPole {
                temperature,
                pole: self.reference_temperature - self.c2,
            });
        }
        Ok(-self.c1 * above_reference / (self.c2 + above_reference))
    }

    /// The law with another reference temperature.
    ///
    /// # Errors
    /// [`RheologyError::BelowWlfPole`] at and below T_r − C₂.
    pub fn with_reference(&self, reference_temperature: f64) -> Result<Self, RheologyError> {
        self.log10_factor(reference_temperature)?;
        let c2 = self.c2 + (reference_temperature - self.reference_temperature);
        Self::new(self.c1 * self.c2 / c2, c2, reference_temperature)
    }

    /// Least-squares fit of the law to measured pairs of temperature and log₁₀ a_T.
    ///
    /// The equation C₁ ΔT + C₂ log₁₀ a_T = −ΔT log₁₀ a_T is linear in the constants. Iteratively updated weights make its least
    /// squares those of log₁₀ a_T.
    ///
    /// # Errors
    /// [`RheologyError::TooFewPoints`] with fewer than two temperatures besides the reference;
    /// [`RheologyError::InvalidParameter`] when no positive constants describe the pairs.
    pub fn fit(shifts: &[[f64; 2]], reference_temperature: f64) -> Result<Self, RheologyError> {
        let pairs: Vec<[f64; 2]> = shifts
            .iter()
            .map(|[t, log]| [t - reference_temperature, *log])
            .filter(|[difference, _]| *difference != 0.0)
            .collect();
        if pairs.len() < 2 {
            return Err(RheologyError::TooFewPoints {
                needed: 2,
                given: pairs.len(),
            });
        }
        let mut constants = linear_constants(&pairs, |_| 1.0);
        // An error of log₁₀ a_T enters the linear equation with the factor C₂ + ΔT, the inverse root of the weight.
        for _ in 0..N_REWEIGHTINGS {
            let [_, c2] = constants;
            constants = linear_constants(&pairs, |difference| (c2 + difference).powi(-2));
        }
        let [c1, c2] = constants;
        Self::new(c1, c2, reference_temperature)
    }
}

/// Number of updates of the weights of the linear equations. Chosen: many more than such an iteration takes to converge,
/// which is not tested, because each one only solves two equations.
const N_REWEIGHTINGS: usize = 30;

/// Weighted least-squares solution C₁ and C₂ of the linear equations for pairs of ΔT and log₁₀ a_T.
fn linear_constants(pairs: &[[f64; 2]], weight: impl Fn(f64) -> f64) -> [f64; 2] {
    // Compute weighted sums of products of d = ΔT and l = log₁₀ a_T, which form the normal equations.
    let [mut dd, mut dl, mut ll, mut ddl, mut dll] = [0.0; 5];
    for &[d, l] in pairs {
        let w = weight(d);
        dd += w * d * d;
        dl += w * d * l;
        ll += w * l * l;
        ddl += w * d * d * l;
        dll += w * d * l * l;
    }
    let determinant = dd * ll - dl * dl;
    [dl * dll - ll * ddl, dl * ddl - dd * dll].map(|numerator| numerator / determinant)
}

impl ArrheniusShift {
    /// The law with an activation energy E_a > 0 [J/mol] about a reference temperature > 0 \[K].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when one of them is not finite and greater than zero.
    pub fn new(activation_energy: f64, reference_temperature: f64) -> Result<Self, RheologyError> {
        Ok(Self {
            activation_energy: positive("activation_energy", activation_energy)?,
            reference_temperature: positive("reference_temperature", reference_temperature)?,
        })
    }

    /// Least-squares fit of the law to pairs of a temperature > 0 \[K] and log₁₀ a_T.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when no positive energy describes the pairs.
    pub fn fit(shifts: &[[f64; 2]], reference_temperature: f64) -> Result<Self, RheologyError> {
        // The logarithm of a shift factor is proportional to the activation energy: fit a straight line through the origin.
        let per_energy = Self::new(1.0, reference_temperature)?;
        let [mut products, mut squares] = [0.0; 2];
        for &[temperature, log] in shifts {
            let slope = per_energy.log10_factor(temperature)?;
            products += slope * log;
            squares += slope * slope;
        }
        Self::new(products / squares, reference_temperature)
    }

    /// Activation energy E_a, [J/mol].
    pub const fn activation_energy(&self) -> f64 {
        self.activation_energy
    }

    /// log₁₀ a_T at a temperature > 0 \[K].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the temperature is not finite and greater than zero.
    pub fn log10_factor(&self, temperature: f64) -> Result<f64, RheologyError> {
        let temperature = positive("temperature", temperature)?;
        let reference = self.reference_temperature;
        let inverse_difference = (reference - temperature) / temperature / reference;
        let exponent = self.activation_energy / GAS_CONSTANT * inverse_difference;
        Ok(exponent * std::f64::consts::LOG10_E)
    }
}

impl RelaxationSpectrum {
    /// The spectrum at another temperature, with all times multiplied by the shift factor a_T > 0.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the factor, or a time, is not finite and greater than zero.
    pub fn shifted(&self, shift_factor: f64) -> Result<Self, RheologyError> {
        positive("shift_factor", shift_factor)?;
        let branches = self.branches().iter().map(|branch| {
            RelaxationBranch::new(branch.modulus, branch.relaxation_time * shift_factor)
        });
        let viscosity = self.viscosity() * shift_factor;
        Self::new(self.equilibrium_modulus(), viscosity, branches.collect())
    }
}
