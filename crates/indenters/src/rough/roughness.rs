//! Roughness parameters of a measured surface.
//!
//! ```text
//! Sq² = ⟨z²⟩,   Ssk = ⟨z³⟩/Sq³,   Sku = ⟨z⁴⟩/Sq⁴,   Sa = ⟨|z|⟩          z = height out of the body, less its mean
//! Sdq² = ⟨|∇z|²⟩,   α = m₀ m₄/m₂²  with  m₀ = Sq²,  m₂ = Sdq²/2,  m₄ = 3/8 ⟨(∇²z)²⟩
//! ```
//!
//! The height parameters are those of ISO 25178-2; m₂ and m₄ are the moments of profiles of an isotropic surface (Nayak 1971).

use numerics::{in_range, positive};

use crate::rough::PeriodicSurface;
use crate::table::check_min_length;
use crate::{HeightMap, IndenterError};

/// Roughness parameters, exact for the given heights.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Roughness {
    /// Mean absolute deviation from the mean height, Sa \[m].
    pub mean_deviation: f64,
    /// Root mean square of the heights, Sq \[m].
    pub rms_height: f64,
    /// Skewness Ssk, positive if peaks stand out of a plain.
    pub skewness: f64,
    /// Kurtosis Sku, 3 for Gaussian heights.
    pub kurtosis: f64,
    /// Height of the highest peak above the mean, Sp \[m].
    pub peak: f64,
    /// Depth of the deepest pit below the mean, Sv \[m].
    pub pit: f64,
    /// Root mean squares of the slopes along x and y; Sdq is the root of the sum of their squares.
    pub rms_slopes: [f64; 2],
    /// Root mean square of the mean curvature ∇²z/2, \[1/m].
    pub rms_curvature: f64,
    /// Nayak's bandwidth parameter α ≥ 3/2 of an isotropic surface with these moments.
    pub nayak: f64,
}

impl Roughness {
    /// Roughness parameters of a map.
    ///
    /// Slopes and curvatures are those of the waves if the map `repeats` itself, otherwise first and second differences of
    /// neighbouring heights.
    ///
    /// # Errors
    /// [`IndenterError::TooFew`] for fewer than three rows or columns; [`IndenterError::InvalidParameter`] for equal heights,
    /// and for heights and spacings below 1e-30 m or above 1e30 m.
    pub fn of(map: &HeightMap, repeats: bool) -> Result<Self, IndenterError> {
        check_min_length(3, "heights along x", map.shape()[0])?;
        check_min_length(3, "heights along y", map.shape()[1])?;
        let surface = PeriodicSurface::from_map(map, 0.0)?;
        check_lengths(map)?;
        // Compute the mean squares of slopes and curvatures: from waves if the surface is periodic, else from differences of
        // heights. The moments of the heights follow.
        let [along_x, along_y, laplacian] = if repeats {
            mean_squares_of_waves(&surface)
        } else {
            mean_squares_of_differences(map)
        };
        let (heights, n) = (map.heights(), map.heights().len() as f64);
        let mean = heights.iter().sum::<f64>() / n;
        let highest = heights.iter().copied().fold(0.0, f64::max);
        // Heights of the map point into the body. Moments of heights relative to their range do not underflow.
        let relative = |height: &f64| (mean - height) / highest;
        let moment = |power: i32| {
            let powers = heights.iter().map(|height| relative(height).powi(power));
            powers.sum::<f64>() / n
        };
        let rms = moment(2).sqrt();
        let deviations = heights.iter().map(|height| (mean - height).abs());
        let slope = positive("mean square of the slopes", along_x + along_y)?;
        Ok(Self {
            mean_deviation: deviations.sum::<f64>() / n,
            rms_height: rms * highest,
            skewness: moment(3) / rms.powi(3),
            kurtosis: moment(4) / rms.powi(4),
            peak: mean,
            pit: highest - mean,
            rms_slopes: [along_x.sqrt(), along_y.sqrt()],
            rms_curvature: 0.5 * laplacian.sqrt(),
            nayak: 1.5 * (rms * highest * laplacian.sqrt() / slope).powi(2),
        })
    }

    /// Root mean square of the gradient, Sdq.
    pub fn rms_gradient(&self) -> f64 {
        self.rms_slopes[0].hypot(self.rms_slopes[1])
    }
}

/// Refuses lengths whose fourth powers, or ratios of these, overflow or underflow.
pub(super) fn check_lengths(map: &HeightMap) -> Result<(), IndenterError> {
    let [x, y] = map.spacing();
    let highest = map.heights().iter().copied().fold(0.0, f64::max);
    for (name, length) in [
        ("largest height above the lowest", highest),
        ("spacing along x", x),
        ("spacing along y", y),
    ] {
        let allowed = "between 1e-30 and 1e30 m (check the units)";
        in_range(name, length, (1e-30..=1e30).contains(&length), allowed)?;
    }
    Ok(())
}

/// Mean squares of ∂z/∂x, ∂z/∂y and ∇²z \[1/m²] of a sum of waves, in this order.
fn mean_squares_of_waves(surface: &PeriodicSurface) -> [f64; 3] {
    let mut squares = [0.0; 3];
    for wave in surface.waves() {
        let [x, y] = surface.wave_vector(wave).map(|q| q * q);
        let mean_square = 0.5 * wave.amplitude * wave.amplitude;
        for (sum, factor) in squares.iter_mut().zip([x, y, (x + y) * (x + y)]) {
            *sum += mean_square * factor;
        }
    }
    squares
}

/// Mean squares of ∂z/∂x, ∂z/∂y and ∇²z \[1/m²] by differences of neighbouring heights, in this order.
fn mean_squares_of_differences(map: &HeightMap) -> [f64; 3] {
    let ([rows, columns], [dx, dy]) = (map.shape(), map.spacing());
    let mean = |rows: usize, columns: usize, value: &dyn Fn(usize) -> f64| {
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| [row, column]));
        let squares = places.map(|[row, column]| value(row * map.shape()[1] + column).powi(2));
        squares.sum::<f64>() / (rows * columns) as f64
    };
    // Compute first and second differences between a height and the one `next` places later: 1 along y, a row along x.
    let heights = map.heights();
    let step = |at: usize, next: usize| heights[at + next] - heights[at];
    let second_difference = |at: usize, next: usize| step(at + next, next) - step(at, next);
    [
        mean(rows - 1, columns, &|at| step(at, columns) / dx),
        mean(rows, columns - 1, &|at| step(at, 1) / dy),
        mean(rows - 2, columns - 2, &|at| {
            second_difference(at + 1, columns) / (dx * dx)
                + second_difference(at + columns, 1) / (dy * dy)
        }),
    ]
}
