//! How well the moduli of a fitted series are known.
//!
//! For relative changes x of the moduli the weighted errors of the data are e = X x + ε, and a series of least squares takes up
//! x = A ε. Each modulus is known to itself at least, because it is not negative, so that A = (XᵀX + λ)⁻¹ Xᵀ and
//!
//! ```text
//! C = (1 − A X)(1 − A X)ᵀ + A T Σ Tᵀ Aᵀ
//! ```
//! where directions that the data do not know keep the first term. Σ has the scatter of single points, apart for G' and G'', and
//! that of a factor common to all moduli of an isotherm; T = 1 − D B says that an isotherm which is shifted onto its
//! neighbour goes astray by B ε in ln ω, and D what its points are then off by. Added to that is the error of the temperature of
//! the isotherm that stays where it is, by which all times are off together, and where the isotherms do not show whether their moduli
//! change with the absolute temperature, half the square of what that makes of the moduli.

mod linear;
mod scatter;
mod shifts;

use nalgebra::DMatrix;

use super::curve::MeasuredCurve;
use super::system::Measurement;
use crate::RelaxationSpectrum;
use linear::{Linear, Residuals};
use scatter::Scatter;
use shifts::Joined;

/// Covariance of the moduli of a series, and the scatter behind it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ModuliCovariance {
    /// Covariances over the products of the two moduli, row by row: the equilibrium modulus, and the branches in the order of their
    /// times. Rows and columns of a modulus of 0 are 0.
    pub relative: Vec<Vec<f64>>,
    /// Relative scatter of single points of G' and G'', or of G(t), without what the points of an isotherm have in common.
    pub noise: Vec<f64>,
    /// Relative scatter of a factor that all moduli of an isotherm have in common; none of a single curve.
    pub factor: Option<f64>,
    /// Scatter of the temperatures of the isotherms, \[K]; none where it leaves no trace.
    pub temperature: Option<f64>,
    /// Whether moduli that change with the absolute temperature, of which the isotherms do not show whether they do, are in it as
    /// likely as not.
    pub vertical_is_undecided: bool,
    /// Standard errors of ln a_T and of ln b_T of the isotherms, in their order, by the scatter of points and factors: 0 of the one that
    /// stays where it is and of what was given; none of a single curve. What an isotherm is off by in temperature is not in it.
    pub shift_errors: Vec<[f64; 2]>,
}

impl ModuliCovariance {
    /// Relative standard errors of the moduli: the equilibrium modulus, and the branches; 0 of a modulus of 0.
    pub fn standard_errors(&self) -> Vec<f64> {
        let rows = self.relative.iter().enumerate();
        rows.map(|(place, row)| row[place].sqrt()).collect()
    }

    /// How it was found, as a sentence.
    pub fn in_words(&self) -> String {
        let percent = |part: f64| format!("{:.2} %", 100.0 * part);
        let noise: Vec<String> = self.noise.iter().copied().map(percent).collect();
        let noise = match &noise[..] {
            [storage, loss] => format!("{storage} of G' and {loss} of G''"),
            _ => format!("{} of G(t)", noise.join(", ")),
        };
        let factor = self.factor.map(|factor| {
            let [found, assumed] = [factor, scatter::FACTOR].map(percent);
            format!(
                ", {found} of a factor that an isotherm has in common (assumed before: {assumed})"
            )
        });
        let temperature = self.temperature.map(|temperature| {
            let assumed = scatter::TEMPERATURE;
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

/// The covariance for a series that was fitted to these weighted rows; none where the numbers leave the range of `f64`.
pub(super) fn covariance(
    rows: &[Measurement],
    curve: &MeasuredCurve,
    spectrum: &RelaxationSpectrum,
) -> Option<ModuliCovariance> {
    let fit = Linear::new(rows, spectrum)?;
    let joined = Joined::new(&fit, rows, curve.joined.as_ref());
    let residuals = Residuals::new(&fit, &joined);
    let scatter = Scatter::new(&fit, rows, &joined, &residuals);
    let found = fit.covariance(&joined, &scatter);
    let moduli = linear::moduli(spectrum);
    let mut places = moduli.iter().scan(0, |next, modulus| {
        let place = (*modulus > 0.0).then_some(*next);
        *next += usize::from(place.is_some());
        Some(place)
    });
    let places: Vec<Option<usize>> = places.by_ref().collect();
    // Both halves are the same number.
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
            .knows_temperature()
            .then(|| scatter.temperature.sqrt()),
        vertical_is_undecided: joined.undecided.ncols() > 0,
        shift_errors: joined.shift_errors(&scatter),
    })
}

/// M Mᵀ.
fn squared(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    matrix * matrix.transpose()
}
