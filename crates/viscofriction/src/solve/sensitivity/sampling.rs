//! Monte Carlo samples of a scene with uncertain numbers, for uncertainties beyond first order.
//!
//! A sample depends on its index alone (SplitMix64: Steele, Lea & Flood 2014), so samples can be computed in any order and on any
//! machine. Pairs of uniform numbers give pairs of normal ones (Box & Muller 1958). Quasi-random sequences are efficient in a few
//! dimensions only, and a material has dozens of moduli.

use std::f64::consts::TAU;
use std::path::Path;

use super::parameters::{Number, Numbers};
use crate::files::{Files, ReadFile};
use crate::scene::{MaterialTable, Scene, SceneError};

/// Sample number `sample` of a scene; sample 0 is the scene itself.
///
/// With a standard normal number z, numbers are multiplied by e^(u z) and a temperature is shifted by u z. Moduli are
/// multiplied by 1 + δ with δ from their joint covariance, but at least by 0. A Poisson ratio above 1/2 is reflected at 1/2.
///
/// # Errors
/// [`SceneError`] for invalid uncertainties, for standard errors of a table of shear strengths, and for files that cannot be read.
pub fn sampled(
    scene: &Scene,
    (folder, read): (&Path, ReadFile),
    sample: usize,
) -> Result<Scene, SceneError> {
    if sample == 0 {
        return Ok(scene.clone());
    }
    let files = Files::of(scene, folder, read)?;
    let law = scene.interface.as_ref().map(|table| table.law(&files));
    if law
        .transpose()?
        .is_some_and(|law| !law.uncertain_rows.is_empty())
    {
        return Err(SceneError::at("interface.table.file", NO_DRAWN_TABLE));
    }
    let mut normal = Normal::new(sample);
    let mut numbers = Numbers::new(scene, folder, read)?;
    // Draw the temperature first, because moduli and times at other temperatures follow from it.
    if let Some(temperature) = numbers.uncertain_temperature() {
        let drawn = temperature.value + numbers.uncertainty(&temperature) * normal.next();
        numbers = Numbers::new(&numbers.scene_with(&temperature, drawn)?, folder, read)?;
    }
    // Draw all numbers of the scene at its best values before any is replaced: each draw has a fixed place in the sequence.
    let mut values = Vec::new();
    for number in numbers.all() {
        let relative = scene.uncertainty.get(&number.path);
        if let Some(relative) = relative {
            values.push((perturbed(&number, relative * normal.next()), number));
        }
    }
    let mut drawn = numbers.scene()?;
    for (value, number) in values {
        drawn = Numbers::new(&drawn, folder, read)?.scene_with(&number, value)?;
    }
    draw_moduli(&mut drawn.material, &mut normal);
    Ok(drawn)
}

/// Message if the rows of a table of shear strengths have standard errors, which samples do not draw.
const NO_DRAWN_TABLE: &str = "samples do not draw the standard errors of its rows; leave out the column shear_strength_error_pa, or ask \
     for the sensitivity instead of samples";

/// A number multiplied by e^`exponent`; a Poisson ratio is reflected at its upper limit.
fn perturbed(number: &Number, exponent: f64) -> f64 {
    let value = number.value * exponent.exp();
    match number.ends() {
        [_, "poisson_ratio"] if value > MAX_POISSON_RATIO => 2.0 * MAX_POISSON_RATIO - value,
        _ => value,
    }
}

/// Upper limit of the Poisson ratio, that of an incompressible material.
const MAX_POISSON_RATIO: f64 = 0.5;

/// Multiplies the moduli of a Prony series by 1 + L z, at least by 0, with the Cholesky factor L of their relative covariance
/// and standard normal numbers z. Other materials stay unchanged.
fn draw_moduli(material: &mut MaterialTable, normal: &mut Normal) {
    let MaterialTable::Prony {
        equilibrium_modulus,
        branches,
        covariance: Some(covariance),
        ..
    } = material
    else {
        return;
    };
    // The covariance was validated when the scene was read.
    let Ok(factor) = covariance.factor() else {
        return;
    };
    let independent: Vec<f64> = factor.iter().map(|_| normal.next()).collect();
    let moduli = branches.iter_mut().map(|branch| &mut branch.modulus);
    for (modulus, row) in std::iter::once(equilibrium_modulus)
        .chain(moduli)
        .zip(&factor)
    {
        let change: f64 = row
            .iter()
            .zip(&independent)
            .map(|(one, other)| one * other)
            .sum();
        *modulus *= (1.0 + change).max(0.0);
    }
}

/// Generator of independent standard normal numbers for one sample.
struct Normal {
    /// State of SplitMix64.
    state: u64,
    /// Second number of the last pair; `None` if it has been used.
    left: Option<f64>,
}

impl Normal {
    /// The generator of a sample, whose numbers depend on the index of the sample alone.
    const fn new(sample: usize) -> Self {
        let mut normal = Self {
            state: 0,
            left: None,
        };
        // Hash the index, so that the states of neighbouring samples are far apart.
        normal.state = sample as u64;
        normal.state = normal.bits();
        normal
    }

    /// Next standard normal number (Box & Muller 1958).
    fn next(&mut self) -> f64 {
        if let Some(left) = self.left.take() {
            return left;
        }
        let [one, other] = [self.uniform(), self.uniform()];
        let radius = (-2.0 * (1.0 - one).ln()).sqrt();
        let (sine, cosine) = (TAU * other).sin_cos();
        self.left = Some(radius * sine);
        radius * cosine
    }

    /// Next uniform number in [0, 1).
    const fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Next 64 bits of SplitMix64 (Steele, Lea & Flood 2014).
    const fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.state;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }
}

#[cfg(test)]
mod tests {
    use super::Normal;

    /// Mean, variance and correlations of 4000 samples are those of independent normal numbers, within four standard errors.
    #[test]
    fn coordinates_are_normal_and_independent() {
        const COUNT: usize = 4000;
        const AXES: usize = 20;
        let draw = |sample| {
            let mut normal = Normal::new(sample);
            (0..AXES).map(|_| normal.next()).collect::<Vec<f64>>()
        };
        let samples: Vec<Vec<f64>> = (1..=COUNT).map(draw).collect();
        for one in 0..AXES {
            let mean = samples.iter().map(|sample| sample[one]).sum::<f64>() / COUNT as f64;
            assert!(mean.abs() < 0.064, "axis {one}: mean {mean}");
            for other in 0..=one {
                let product = samples.iter().map(|sample| sample[one] * sample[other]);
                let product = product.sum::<f64>() / COUNT as f64;
                let expected = if one == other { 1.0 } else { 0.0 };
                assert!(
                    (product - expected).abs() < 0.1,
                    "{one}, {other}: {product}"
                );
            }
        }
    }
}
