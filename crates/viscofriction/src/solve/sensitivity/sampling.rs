//! Scenes whose uncertain numbers are drawn: what a straight line does not know of an uncertainty.
//!
//! The numbers of a sample follow from its own number alone (Steele, Lea & Flood 2014), so that samples can be computed in any order
//! and on any machine; pairs of them become two normal numbers (Box & Muller 1958). Sequences that fill a cube more evenly do so for
//! a handful of numbers, and a material has dozens of moduli.

use std::f64::consts::TAU;
use std::path::Path;

use super::parameters::{Number, Numbers};
use crate::files::ReadFile;
use crate::scene::{MaterialTable, Scene, SceneError};

/// A sample of a scene, counted from 1; the scene itself is sample 0.
///
/// Positive numbers are multiplied by e^(u z), a temperature is shifted by u z, and moduli are changed by what their covariance
/// gives, which leaves their sums as well known as they are; a modulus that comes out negative is 0. A Poisson ratio above 1/2 is as
/// far below it.
///
/// # Errors
/// [`SceneError`] for uncertainties that are none, and files that cannot be read.
pub fn sampled(
    scene: &Scene,
    (folder, read): (&Path, ReadFile),
    sample: usize,
) -> Result<Scene, SceneError> {
    if sample == 0 {
        return Ok(scene.clone());
    }
    let mut normal = Normal::new(sample);
    let mut numbers = Numbers::new(scene, folder, read)?;
    if let Some(temperature) = numbers.uncertain_temperature() {
        let drawn = temperature.value + numbers.uncertainty(&temperature) * normal.next();
        numbers = Numbers::new(&numbers.scene_with(&temperature, drawn)?, folder, read)?;
    }
    let mut values = Vec::new();
    for number in numbers.all() {
        let relative = scene.uncertainty.get(&number.path());
        if let Some(relative) = relative {
            values.push((drawn(&number, relative * normal.next()), number));
        }
    }
    let mut drawn = numbers.scene()?;
    for (value, number) in values {
        drawn = Numbers::new(&drawn, folder, read)?.scene_with(&number, value)?;
    }
    draw_moduli(&mut drawn.material, &mut normal);
    Ok(drawn)
}

fn drawn(number: &Number, exponent: f64) -> f64 {
    let value = number.value * exponent.exp();
    match number.ends() {
        [_, "poisson_ratio"] if value > LARGEST_RATIO => 2.0 * LARGEST_RATIO - value,
        _ => value,
    }
}

/// Of an incompressible material.
const LARGEST_RATIO: f64 = 0.5;

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
    // It was checked when the scene was read.
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

/// Independent numbers of the standard normal distribution that belong to a sample.
struct Normal {
    state: u64,
    /// The second one of a pair.
    left: Option<f64>,
}

impl Normal {
    const fn new(sample: usize) -> Self {
        let mut normal = Self {
            state: 0,
            left: None,
        };
        // Neighbouring samples begin far apart.
        normal.state = sample as u64;
        normal.state = normal.bits();
        normal
    }

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

    /// From 0 to 1, without 1.
    const fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

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

    /// Of four thousand samples mean, variance and correlations are those of independent normal numbers, to four standard errors.
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
