//! Creep of a stationary state in which storage and loss modulus have factors of their own.
//!
//! ```text
//! f G'(ω) + i g G''(ω) = a G*(ω) + b conj G*(ω)        a = (f + g)/2,  b = (f − g)/2
//! ```
//!
//! The second term precedes its cause: for f ≠ g this is no relaxation, but in a stationary state it has a meaning. With λ = −1/s as
//! in [`super::conversion`] it is a secular equation with the poles τ_i and −τ_i,
//!
//! ```text
//! a Q(λ) + b Q(−λ) = f G_∞ − g η₀/λ − Σ a G_i τ_i/(λ − τ_i) + Σ b G_i τ_i/(λ + τ_i)
//! ```
//!
//! whose roots are all real: N above zero, and as many below. The roots below zero are retardation elements that look ahead in time;
//! their compliances have the sign of b.

use numerics::{finite, positive};

use super::secular::{Pole, roots};
use crate::complex::debye;
use crate::{
    ComplexCompliance, CreepSpectrum, Material, ModulusFactors, RetardationElement, RheologyError,
};

/// Creep of a material in a stationary state, in which strains may also depend on later stresses.
///
/// ```text
/// J*(ω) = 1/(f G'(ω) + i g G''(ω)) = J₀ + 1/(iωη_f) + Σ J_k/(1 + iωλ_k) + Σ J_k/(1 − iωλ_k)
/// ```
///
/// The first sum is over retarded, the second over advanced elements.
#[derive(Debug, Clone, PartialEq)]
pub struct StationaryCreep {
    /// The part that depends on earlier stresses.
    retarded: CreepSpectrum,
    /// Elements that depend on later stresses; compliances of either sign.
    advanced: Vec<RetardationElement>,
}

impl StationaryCreep {
    /// Creep of a `material` whose moduli have factors. Without factors, and with equal ones, no element is advanced.
    ///
    /// # Errors
    /// [`RheologyError`] when a compliance or a time overflows or underflows.
    pub fn new(
        material: &(impl Material + ?Sized),
        factors: ModulusFactors,
    ) -> Result<Self, RheologyError> {
        let [storage, loss] = [factors.storage(), factors.loss()];
        if factors.are_equal() {
            return Ok(Self {
                retarded: scaled(material.creep(), storage)?,
                advanced: Vec::new(),
            });
        }
        let spectrum = material.relaxation();
        let [following, preceding] = [0.5 * (storage + loss), 0.5 * (storage - loss)];
        let branches = spectrum.branches().iter();
        let mirrored = branches.clone().rev().map(|branch| Pole {
            position: -branch.relaxation_time,
            weight: -preceding * branch.viscosity(),
        });
        let at_zero = (spectrum.viscosity() > 0.0).then(|| Pole {
            position: 0.0,
            weight: loss * spectrum.viscosity(),
        });
        let direct = branches.map(|branch| Pole {
            position: branch.relaxation_time,
            weight: following * branch.viscosity(),
        });
        let poles: Vec<Pole> = mirrored.chain(at_zero).chain(direct).collect();
        let (mut retarded, mut advanced) = (Vec::new(), Vec::new());
        for root in roots(&poles, storage * spectrum.equilibrium_modulus()) {
            let element = RetardationElement {
                compliance: finite("compliance", root.relative_inverse_slope)?,
                retardation_time: positive("retardation_time", root.position.abs())?,
            };
            if root.position > 0.0 {
                retarded.push(element);
            } else {
                advanced.push(element);
            }
        }
        advanced.reverse();
        let fluidity = if spectrum.equilibrium_modulus() > 0.0 {
            0.0
        } else {
            (loss * spectrum.zero_shear_viscosity()).recip()
        };
        // An infinite instantaneous modulus gives the instantaneous compliance 0.
        let instantaneous = (storage * spectrum.glass_modulus()).recip();
        Ok(Self {
            retarded: CreepSpectrum::new(instantaneous, fluidity, retarded)?,
            advanced,
        })
    }

    /// The part that depends on earlier stresses, with the instantaneous compliance and the free flow.
    pub const fn retarded(&self) -> &CreepSpectrum {
        &self.retarded
    }

    /// Elements whose strain precedes the stress, in increasing order of time; their compliances may be negative.
    pub fn advanced(&self) -> &[RetardationElement] {
        &self.advanced
    }

    /// Whether the compliance does not depend on frequency.
    pub fn is_elastic(&self) -> bool {
        self.advanced.is_empty() && self.retarded.is_elastic()
    }

    /// Complex compliance J' − i J'' at an angular frequency ω ≥ 0 \[rad/s]; the loss of a fluid is infinite at ω = 0.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    pub fn complex_compliance(
        &self,
        angular_frequency: f64,
    ) -> Result<ComplexCompliance, RheologyError> {
        let mut compliance = self.retarded.complex_compliance(angular_frequency)?;
        for element in &self.advanced {
            let omega = angular_frequency * element.retardation_time;
            compliance.storage += element.compliance * debye(omega.recip())[0];
            compliance.loss -= element.compliance * debye(omega)[1];
        }
        Ok(compliance)
    }
}

/// A material without factors.
impl From<CreepSpectrum> for StationaryCreep {
    fn from(retarded: CreepSpectrum) -> Self {
        Self {
            retarded,
            advanced: Vec::new(),
        }
    }
}

/// The creep of a material whose moduli have the same `factor`.
fn scaled(creep: CreepSpectrum, factor: f64) -> Result<CreepSpectrum, RheologyError> {
    if factor.to_bits() == 1.0_f64.to_bits() {
        return Ok(creep);
    }
    let elements = creep.elements().iter().map(|element| RetardationElement {
        compliance: element.compliance / factor,
        ..*element
    });
    CreepSpectrum::new(
        creep.instantaneous_compliance() / factor,
        creep.fluidity() / factor,
        elements.collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ComplexModulus, Prony, RelaxationBranch, RelaxationSpectrum};

    /// Materials: a standard solid, a fluid, one with a dashpot, twenty branches over fifteen decades, and two branches close together.
    fn materials() -> Vec<Prony> {
        let branch = |modulus, time| RelaxationBranch::new(modulus, time);
        let many = (0..20).map(|index| {
            let decade = 0.75 * f64::from(index) - 9.0;
            branch(1e6 * (1.0 + f64::from(index % 3)), 10_f64.powf(decade))
        });
        let spectra = [
            (1e6, 0.0, vec![branch(9e6, 1e-3)]),
            (0.0, 0.0, vec![branch(9e6, 1e-3), branch(1e5, 2.0)]),
            (1e6, 30.0, vec![branch(9e6, 1e-3)]),
            (0.0, 30.0, vec![branch(9e6, 1e-3)]),
            (1e3, 0.0, many.collect()),
            (1e6, 0.0, vec![branch(1e6, 1e-3), branch(1e6, 1.000_01e-3)]),
            (1e6, 30.0, Vec::new()),
        ];
        let material = |(modulus, viscosity, branches)| {
            let spectrum = RelaxationSpectrum::new(modulus, viscosity, branches);
            Prony::new(spectrum.expect("a spectrum")).expect("a material")
        };
        spectra.into_iter().map(material).collect()
    }

    /// The compliance is the inverse of the modulus with its factors, to 1e-10, at all frequencies.
    #[test]
    fn the_compliance_is_the_inverse_of_the_modulus() {
        for material in materials() {
            for (storage, loss) in [(1.0, 1.0), (0.3, 0.3), (0.4, 1.7), (0.9, 0.2), (2.0, 1e-3)] {
                let factors = ModulusFactors::new(storage, loss).expect("positive");
                let creep = StationaryCreep::new(&material, factors).expect("a creep");
                for decade in -44..44 {
                    let frequency = 10_f64.powf(0.25 * f64::from(decade));
                    let modulus = material.complex_modulus(frequency).expect("a modulus");
                    let ComplexModulus {
                        storage: in_phase,
                        loss: out_of_phase,
                    } = factors.on(modulus);
                    let compliance = creep.complex_compliance(frequency).expect("a compliance");
                    let real = in_phase * compliance.storage + out_of_phase * compliance.loss;
                    let imaginary = out_of_phase * compliance.storage - in_phase * compliance.loss;
                    let deviation = (real - 1.0).hypot(imaginary);
                    assert!(
                        deviation < 1e-10,
                        "{material:?} with {storage}, {loss} at {frequency}: {deviation}"
                    );
                }
            }
        }
    }

    /// Elements that precede have the sign of f − g; without factors nothing changes.
    #[test]
    fn the_sign_of_advanced_elements_is_that_of_the_difference() {
        for material in materials() {
            let creep = |storage, loss| {
                let factors = ModulusFactors::new(storage, loss).expect("positive");
                StationaryCreep::new(&material, factors).expect("a creep")
            };
            assert_eq!(creep(1.0, 1.0), material.creep().into());
            assert!(creep(2.0, 2.0).advanced().is_empty());
            let n = material.relaxation().branches().len();
            for (storage, loss) in [(0.4, 1.7), (0.9, 0.2)] {
                let creep = creep(storage, loss);
                assert_eq!(creep.advanced().len(), n);
                let is_right =
                    |element: &RetardationElement| element.compliance * (storage - loss) > 0.0;
                assert!(creep.advanced().iter().all(is_right), "{creep:?}");
            }
        }
    }
}
