//! Shift of the times and moduli of a material by the wavelength of the pressure, as by a temperature that changes with the depth.

use std::sync::Arc;

use numerics::{InvalidParameter, in_range, positive};

/// Factors of all times and moduli of a material for pressure waves of one length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShiftOfWave {
    /// Wave number q > 0, \[rad/m].
    pub wave_number: f64,
    /// Factor > 0 of all relaxation times, such as a_T of time–temperature superposition.
    pub time_factor: f64,
    /// Factor > 0 of all moduli, such as b_T.
    pub modulus_factor: f64,
}

/// Factors of times and moduli over the wave number q of the pressure: the modulus of the wave is b(q) G*(a(q) ω).
///
/// A wave strains the material down to a depth of about 3/(2q). Where temperature changes with the depth, waves of each length therefore
/// have a temperature of their own (Persson 2006, J. Phys.: Condens. Matter 18, 7789).
#[derive(Debug, Clone, PartialEq)]
pub struct WaveShift {
    /// Logarithms of wave number, time factor and modulus factor, in increasing order of the wave number.
    nodes: Arc<[[f64; 3]]>,
}

impl WaveShift {
    /// The shift with the given factors at some wave numbers. In between, the logarithms of the factors are linear in that of the wave
    /// number; beyond the first and the last wave number the factors are constant.
    ///
    /// # Errors
    /// [`InvalidParameter`] without waves, for wave numbers that do not increase, and for numbers that are not finite and greater than 0.
    pub fn new(waves: &[ShiftOfWave]) -> Result<Self, InvalidParameter> {
        let count = waves.len() as f64;
        in_range("number of waves", count, count > 0.0, "at least 1")?;
        let mut before = 0.0;
        for wave in waves {
            positive("time_factor", wave.time_factor)?;
            positive("modulus_factor", wave.modulus_factor)?;
            let q = positive("wave_number", wave.wave_number)?;
            in_range("wave_number", q, q > before, "greater than the one before")?;
            before = q;
        }
        let logarithms = |wave: &ShiftOfWave| {
            [wave.wave_number, wave.time_factor, wave.modulus_factor].map(f64::ln)
        };
        Ok(Self {
            nodes: waves.iter().map(logarithms).collect(),
        })
    }

    /// Factors of times and moduli for a wave number q ≥ 0 \[rad/m].
    pub(crate) fn factors(&self, wave_number: f64) -> [f64; 2] {
        let log = wave_number.ln();
        let upper = self.nodes.partition_point(|[node, _, _]| *node < log);
        let [left, right] = [
            self.nodes[upper.saturating_sub(1)],
            self.nodes[upper.min(self.nodes.len() - 1)],
        ];
        let distance = right[0] - left[0];
        let part = if distance > 0.0 {
            (log - left[0]) / distance
        } else {
            0.0
        };
        [1, 2].map(|index| (left[index] + part * (right[index] - left[index])).exp())
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Between two waves the factors are powers of the wave number, beyond them constant; wrong numbers are refused.
    #[test]
    fn factors_are_powers_between_waves() {
        let wave = |wave_number, time_factor| ShiftOfWave {
            wave_number,
            time_factor,
            modulus_factor: 1.0,
        };
        let shift = WaveShift::new(&[wave(1.0, 1.0), wave(100.0, 1e-4)]).expect("a shift");
        for (q, factor) in [
            (0.0, 1.0),
            (0.5, 1.0),
            (10.0, 1e-2),
            (100.0, 1e-4),
            (1e9, 1e-4),
        ] {
            let [time, modulus] = shift.factors(q);
            assert_relative_eq!(time, factor, max_relative = 1e-14);
            assert_eq!(modulus.to_bits(), 1.0_f64.to_bits());
        }
        for wrong in [
            &[][..],
            &[wave(1.0, 0.0)],
            &[wave(-1.0, 1.0)],
            &[wave(2.0, 1.0), wave(2.0, 1.0)],
            &[wave(1.0, f64::NAN)],
        ] {
            assert!(WaveShift::new(wrong).is_err(), "{wrong:?}");
        }
    }
}
