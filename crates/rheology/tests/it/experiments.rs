//! Made-up measurements, and what is asked of the materials that are fitted to them.

use std::f64::consts::TAU;

use rheology::fit::ModuliCovariance;
use rheology::{RelaxationBranch, RelaxationSpectrum};

/// Numbers that look random and are the same every time (Steele, Lea & Flood 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.uniform()).ln()).sqrt() * (TAU * self.uniform()).cos()
    }
}

/// What friction depends on: J'' around a frequency.
pub(crate) fn dissipation(material: &RelaxationSpectrum) -> f64 {
    let part = |k: i32| {
        let decades = 0.1 * f64::from(k);
        let modulus = material.complex_modulus(30.0 * 10_f64.powf(decades));
        let modulus = modulus.expect("moduli");
        let size = modulus.storage.hypot(modulus.loss);
        (-4.0 * decades * decades).exp() * modulus.loss / (size * size)
    };
    (-15..=15).map(part).sum()
}

/// √(gᵀ C g) with the derivatives by the logarithms of the moduli.
pub(crate) fn uncertainty(material: &RelaxationSpectrum, covariance: &ModuliCovariance) -> f64 {
    const STEP: f64 = 1e-5;
    let changed = |place: usize, factor: f64| {
        let of = |own: usize, modulus: f64| {
            if own == place {
                factor * modulus
            } else {
                modulus
            }
        };
        let branches = material.branches().iter().enumerate();
        let branches = branches
            .map(|(k, one)| RelaxationBranch::new(of(k + 1, one.modulus), one.relaxation_time));
        let spring = of(0, material.equilibrium_modulus());
        let changed = RelaxationSpectrum::new(spring, 0.0, branches.collect());
        dissipation(&changed.expect("a material"))
    };
    let n = covariance.relative.len();
    let slope = |k| (changed(k, 1.0 + STEP) - changed(k, 1.0 - STEP)) / (2.0 * STEP);
    let slopes: Vec<f64> = (0..n).map(slope).collect();
    let row = |k: usize| -> f64 {
        let entries = covariance.relative[k].iter().zip(&slopes);
        slopes[k] * entries.map(|(entry, slope)| entry * slope).sum::<f64>()
    };
    (0..n).map(row).sum::<f64>().sqrt()
}
