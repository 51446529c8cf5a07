//! Periodic surfaces through the heights of a map: trigonometric interpolation.

use numerics::transforms::Real;
use numerics::{in_range, not_negative, positive};
use rustfft::num_complex::Complex;

use crate::rough::{PeriodicSurface, Wave};
use crate::{HeightMap, IndenterError};

/// Ratio of an amplitude to the largest height up to which it counts as rounding of the transform, and the wave is left out.
/// Chosen: some hundred roundings of f64, as in a transform of a large map.
const AMPLITUDE_ROUNDING: f64 = 1e-13;

impl PeriodicSurface {
    /// The trigonometric polynomial through the heights of a periodic map, without its mean and without waves shorter than
    /// `shortest_wavelength` ≥ 0 \[m].
    ///
    /// The row after the last one is the first one, and so for the columns. Waves of two elements along an axis are always
    /// left out, because the heights do not determine their phase. A map whose opposite edges differ has a step there, with
    /// waves of all lengths.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] for equal heights, and for a `shortest_wavelength` that leaves no wave.
    pub fn from_map(map: &HeightMap, shortest_wavelength: f64) -> Result<Self, IndenterError> {
        not_negative("shortest_wavelength", shortest_wavelength)?;
        let heights = map.heights().iter();
        let highest = positive(
            "largest height above the lowest",
            heights.copied().fold(0.0, f64::max),
        )?;
        let ([rows, columns], spacing) = (map.shape(), map.spacing());
        let period = [rows as f64 * spacing[0], columns as f64 * spacing[1]];
        let spectrum = transform(map);
        // Collect one wave for each pair ±(m, n) that the map resolves.
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
                let is_resolved = 2.0 * m.abs() < rows as f64 && 2.0 * n < columns as f64;
                // Keep only one of the two waves ±(m, n), because both are the same wave.
                let is_representative = n > 0.0 || m > 0.0;
                if is_resolved && is_representative && length >= shortest_wavelength * (1.0 - 1e-12)
                {
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
        waves.retain(|wave| wave.amplitude > AMPLITUDE_ROUNDING * highest);
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

/// Discrete Fourier transform Σ h_jk e^(−2πi (m j/rows + n k/columns)) of the heights \[m], not normalised, for 0 ≤ n ≤ columns/2.
///
/// It is stored by n, with the `rows` numbers m of each n next to each other; m above rows/2 stands for m − rows.
fn transform(map: &HeightMap) -> Vec<Complex<f64>> {
    let [rows, columns] = map.shape();
    // Fourier transform the heights along y, row by row, then along x.
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
