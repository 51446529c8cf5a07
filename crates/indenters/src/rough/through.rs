//! Periodic surfaces through heights on a grid.

use numerics::transforms::Real;
use numerics::{in_range, not_negative, positive};
use rustfft::num_complex::Complex;

use crate::rough::{PeriodicSurface, Wave};
use crate::{HeightMap, IndenterError};

/// Amplitudes below this part of the largest height are the rounding of a transform.
const ROUNDING: f64 = 1e-13;

impl PeriodicSurface {
    /// The trigonometric polynomial through the heights of a map that repeats itself, of which the first row follows on the
    /// last and the first column on the last, without its mean and without waves shorter than `shortest_wavelength` ≥ 0 \[m].
    ///
    /// Waves of two elements along an axis are left out always, because heights do not tell their phase. A map whose opposite
    /// edges do not fit together has a step there, with waves of all lengths.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] for heights that are all the same, and a `shortest_wavelength` that leaves no wave.
    pub fn through(map: &HeightMap, shortest_wavelength: f64) -> Result<Self, IndenterError> {
        not_negative("shortest_wavelength", shortest_wavelength)?;
        let heights = map.heights().iter();
        let highest = positive(
            "largest height above the lowest",
            heights.copied().fold(0.0, f64::max),
        )?;
        let ([rows, columns], spacing) = (map.shape(), map.spacing());
        let period = [rows as f64 * spacing[0], columns as f64 * spacing[1]];
        let spectrum = spectrum(map);
        let mut waves = Vec::new();
        for (n, column) in spectrum.chunks_exact(rows).enumerate() {
            for (row, coefficient) in column.iter().enumerate() {
                let m = if 2 * row > rows {
                    row as f64 - rows as f64
                } else {
                    row as f64
                };
                let n = n as f64;
                let length = (m / period[0]).hypot(n / period[1]).recip();
                let is_told = 2.0 * m.abs() < rows as f64 && 2.0 * n < columns as f64;
                // Of two waves with opposite numbers one.
                let is_one = n > 0.0 || m > 0.0;
                if is_told && is_one && length >= shortest_wavelength * (1.0 - 1e-12) {
                    #[expect(clippy::cast_possible_truncation, reason = "below half of the shape")]
                    let numbers = [m, n].map(|number| number as i32);
                    waves.push(Wave {
                        numbers,
                        amplitude: 2.0 * coefficient.norm() / (rows as f64 * columns as f64),
                        phase: coefficient.arg(),
                    });
                }
            }
        }
        waves.retain(|wave| wave.amplitude > ROUNDING * highest);
        let allowed = "short enough for a wave of the map";
        in_range(
            "shortest_wavelength",
            shortest_wavelength,
            !waves.is_empty(),
            allowed,
        )?;
        Self::new(period, waves)
    }
}

/// Σ h e^(−i(…)), column by column of the numbers along y, which are not negative.
fn spectrum(map: &HeightMap) -> Vec<Complex<f64>> {
    let [rows, columns] = map.shape();
    let along_y = f64::real_forward(columns);
    let (mut row, mut found) = (along_y.make_input_vec(), along_y.make_output_vec());
    let mut spectrum = vec![Complex::default(); found.len() * rows];
    for (index, heights) in map.heights().chunks_exact(columns).enumerate() {
        row.copy_from_slice(heights);
        let done = along_y.process(&mut row, &mut found);
        assert!(done.is_ok(), "the lengths are those of the plan");
        for (column, coefficient) in spectrum.chunks_exact_mut(rows).zip(&found) {
            column[index] = *coefficient;
        }
    }
    f64::forward(rows).process(&mut spectrum);
    spectrum
}
