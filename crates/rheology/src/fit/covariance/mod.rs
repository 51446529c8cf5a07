//! Covariance of the moduli of a fitted series.
//!
//! The weighted errors of the data are e = X x + ε for relative changes x of the moduli, and least squares give x = A ε.
//! The prior of a relative change is 0 ± 1, because a modulus is not negative: A = (XᵀX + λ)⁻¹ Xᵀ and
//!
//! ```text
//! C = (1 − A X)(1 − A X)ᵀ + A T Σ Tᵀ Aᵀ,        T = 1 − D B
//! ```
//! - The first term is the prior of directions that the data do not determine.
//! - Σ has the scatter of single points, separately for G' and G'', and that of a factor common to an isotherm.
//! - B ε is the error of the shifts ln a_T and ln b_T of the isotherms, D their effect on the weighted data.
//!
//! Two terms are added: the error of the temperature of the reference isotherm, which changes all times by one factor; and,
//! if the isotherms leave undecided whether their moduli change with the absolute temperature, half the square of that effect.

mod linear;
mod scatter;
mod shifts;

use nalgebra::DMatrix;

use super::curve::MeasuredCurve;
use super::system::Measurement;
use crate::RelaxationSpectrum;
use linear::{Linear, Residuals};
use scatter::Scatter;
use shifts::ShiftEffects;

/// Covariance of the moduli of a series, and the scatter behind it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ModuliCovariance {
    /// Covariances relative to the products of the two moduli, row by row: equilibrium modulus, then branches by time.
    ///
    /// Rows and columns of a modulus of 0 are 0.
    pub relative: Vec<Vec<f64>>,
    /// Relative scatter of single points of G' and G'', or of G(t), without the common factor of an isotherm.
    pub noise: Vec<f64>,
    /// Relative scatter of the common factor of the moduli of an isotherm; `None` for a single curve.
    pub factor: Option<f64>,
    /// Scatter of the temperatures of the isotherms, \[K]; `None` if it has no effect.
    pub temperature: Option<f64>,
    /// Whether the isotherms leave undecided that moduli change with the absolute temperature.
    ///
    /// The covariance then includes the change with the probability 1/2.
    pub vertical_is_undecided: bool,
    /// Standard errors of ln a_T and of ln b_T of the isotherms in their order; empty for a single curve.
    ///
    /// They come from the scatter of points and factors, without errors of the temperatures. They are 0 for the reference
    /// isotherm and for given shifts.
    pub shift_errors: Vec<[f64; 2]>,
}

impl ModuliCovariance {
    /// Relative standard errors of the moduli: equilibrium modulus, then branches; 0 for a modulus of 0.
    pub fn standard_errors(&self) -> Vec<f64> {
        let rows = self.relative.iter().enumerate();
        rows.map(|(place, row)| row[place].sqrt()).collect()
    }

    /// Description of the method and of the scatter, as a sentence.
    pub fn description(&self) -> String {
        let percent = |part: f64| format!("{:.2} %", 100.0 * part);
        let noise: Vec<String> = self.noise.iter().copied().map(percent).collect();
        let noise = match &noise[..] {
            [storage, loss] => format!("{storage} of G' and {loss} of G''"),
            _ => format!("{} of G(t)", noise.join(", ")),
        };
        let factor = self.factor.map(|factor| {
            let [found, assumed] = [factor, scatter::FACTOR_SCALE].map(percent);
            format!(
                ", {found} of a factor that an isotherm has in common (assumed before: {assumed})"
            )
        });
        let temperature = self.temperature.map(|temperature| {
            let assumed = scatter::TEMPERATURE_SCALE;
            format!(", {temperature:.2} K of the temperatures of isotherms (assumed before: {assumed} K)")
        });
        let [factor, temperature] = [factor, temperature].map(Option::unwrap_or_default);
        let undecided = if self.vertical_is_undecided {
            ", moduli that change with the absolute temperature as likely as not"
        } else {
            ""
        };
        format!(
            "propagation of the scatter of the residuals, {noise}{factor}{temperature}{undecided}; without errors that all points have in common"
        )
    }
}

/// Covariance of the moduli of a series fitted to weighted rows; `None` on overflow.
pub(super) fn covariance(
    rows: &[Measurement],
    curve: &MeasuredCurve,
    spectrum: &RelaxationSpectrum,
) -> Option<ModuliCovariance> {
    // Linearise the fit and the shifts, estimate the scatter from the residuals, and propagate it.
    let fit = Linear::new(rows, spectrum)?;
    let joined = ShiftEffects::new(&fit, rows, curve.joined.as_ref());
    let residuals = Residuals::new(&fit, &joined);
    let scatter = Scatter::new(&fit, rows, &joined, &residuals);
    let found = fit.covariance(&joined, &scatter);
    // A modulus of 0 is not part of the linear fit; its row and column of the covariance are zero.
    let moduli = linear::moduli(spectrum);
    let mut places = moduli.iter().scan(0, |next, modulus| {
        let place = (*modulus > 0.0).then_some(*next);
        *next += usize::from(place.is_some());
        Some(place)
    });
    let places: Vec<Option<usize>> = places.by_ref().collect();
    // Read one triangle, so that the matrix is symmetric to the last bit.
    let entry = |row: Option<usize>, column: Option<usize>| {
        row.zip(column).map_or(0.0, |(row, column)| {
            found[(row.max(column), row.min(column))]
        })
    };
    let row = |row: &Option<usize>| places.iter().map(|column| entry(*row, *column)).collect();
    let relative: Vec<Vec<f64>> = places.iter().map(row).collect();
    let is_finite = relative.iter().flatten().all(|entry| entry.is_finite());
    is_finite.then(|| ModuliCovariance {
        relative,
        noise: scatter.noise_by_quantity(),
        factor: (joined.factors.ncols() > 1).then(|| scatter.factor.sqrt()),
        temperature: joined
            .has_temperature_effect()
            .then(|| scatter.temperature.sqrt()),
        vertical_is_undecided: joined.undecided.ncols() > 0,
        shift_errors: joined.shift_errors(&scatter),
    })
}

/// Product M Mᵀ.
fn outer_square(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    matrix * matrix.transpose()
}
