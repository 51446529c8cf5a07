//! Identification of a Prony series from a measured curve.

mod plausible;

use nalgebra::{DMatrix, DMatrixView, DVector};
use numerics::{InvalidParameter, in_range, not_negative, positive};

use super::covariance::{ModuliCovariance, covariance};
use super::curve::MeasuredCurve;
use super::nnls::nnls;
use super::refine::{Series, refine};
use super::sign_changes::SignChanges;
use super::system::{Measurement, Quantity};
use crate::{PronyExpansion, RelaxationBranch, RelaxationSpectrum, RheologyError};

/// Behaviour at long times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LongTimeLimit {
    /// Solid: equilibrium modulus ≥ 0, fitted.
    Solid,
    /// Liquid: no equilibrium modulus.
    Liquid,
}

/// Number and relaxation times of the branches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Control {
    /// At most this many branches with fitted relaxation times.
    Branches(usize),
    /// The fewest branches whose error is at most `1 + tolerance` times that of four branches per decade.
    Parsimony {
        /// Allowed relative excess of the error, greater than 0.
        tolerance: f64,
    },
    /// This many branches with times equally spaced in the logarithm and Tikhonov regularisation of the moduli.
    Smooth {
        /// Number of branches.
        n_branches: usize,
        /// Regularisation parameter ≥ 0: weight of the second differences of the moduli against the relative errors.
        ///
        /// Each modulus is scaled by its effect on the relative errors.
        weight: f64,
    },
}

/// Options of an identification.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IdentifyOptions {
    /// Behaviour at long times.
    pub long_time_limit: LongTimeLimit,
    /// Number and relaxation times of the branches.
    pub control: Control,
}

impl Default for IdentifyOptions {
    fn default() -> Self {
        Self {
            long_time_limit: LongTimeLimit::Solid,
            control: Control::Parsimony { tolerance: 0.02 },
        }
    }
}

/// Errors of a modulus at all points, relative to its own size.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RelativeError {
    /// Root mean square of the errors.
    pub rms: f64,
    /// Largest error.
    pub max: f64,
}

/// An identified Prony series with its errors.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Identification {
    /// Identified relaxation spectrum.
    pub spectrum: RelaxationSpectrum,
    /// Shortest and longest time of the curve, 1/ω or t, \[s].
    pub time_range: [f64; 2],
    /// Root mean square over all points of |G*_fit/G* − 1|, or of G_fit(t)/G(t) − 1.
    pub rms_relative_error: f64,
    /// Largest |G*_fit/G* − 1|, or |G_fit(t)/G(t) − 1|, of all points.
    pub max_relative_error: f64,
    /// Errors of G' relative to [`ModulusPoint::sizes`](super::ModulusPoint::sizes); `None` for G(t).
    pub storage_error: Option<RelativeError>,
    /// Errors of G'' relative to [`ModulusPoint::sizes`](super::ModulusPoint::sizes); `None` for G(t).
    pub loss_error: Option<RelativeError>,
    /// Sign changes of the errors of G' along the frequency; `None` for G(t).
    pub storage_sign_changes: Option<SignChanges>,
    /// Sign changes of the errors of G'' along the frequency; `None` for G(t).
    pub loss_sign_changes: Option<SignChanges>,
    /// Covariance of the moduli; `None` on overflow.
    pub covariance: Option<ModuliCovariance>,
}

/// Largest rms relative error of a modulus up to which systematic errors are not reported. Chosen: smaller than errors that
/// matter for friction.
const MIN_REPORTED_RMS: f64 = 0.01;

impl Identification {
    /// A sentence for each modulus whose relative errors change their sign too rarely from one frequency to the next to be noise,
    /// and have an rms of more than 1 %. A curve `of_isotherms` may have them because those do not lie on one curve.
    pub fn systematic_errors(&self, of_isotherms: bool) -> Vec<String> {
        let moduli = [
            ("G'", self.storage_error, self.storage_sign_changes),
            ("G''", self.loss_error, self.loss_sign_changes),
        ];
        let sentence = |(name, error, changes): (
            &str,
            Option<RelativeError>,
            Option<SignChanges>,
        )| {
            let (error, changes) = (error?, changes?);
            let matters = error.rms > MIN_REPORTED_RMS && changes.are_too_few();
            matters.then(|| {
                format!(
                    "the errors of {name}, {:.2} % rms, are not noise: from one frequency to the next they change their sign {} of {} times, \
                     and noise does every other time; {}the two moduli contradict each other, or the series does not have their form",
                    100.0 * error.rms,
                    changes.found,
                    changes.possible,
                    if of_isotherms { "the isotherms do not lie on one curve, " } else { "" }
                )
            })
        };
        moduli.into_iter().filter_map(sentence).collect()
    }
}

/// The identified series as an expansion of the measured curve, with the largest error at the points.
impl From<Identification> for PronyExpansion {
    fn from(found: Identification) -> Self {
        Self {
            spectrum: found.spectrum,
            relative_error: found.max_relative_error,
            time_range: found.time_range,
        }
    }
}

/// Factor m by which a relaxation time may lie outside the measured window. Chosen: the loss modulus of a branch then
/// exceeds its value at the end of the window by at most (m + 1/m)/2 = 1.25. A branch farther outside would be determined by
/// its flank only.
const WINDOW_MARGIN: f64 = 2.0;
/// Number of branches per decade of the reference series that shows the attainable error. Chosen: neighbouring times differ by a
/// factor of 1.8, less than the width of the response of one branch.
const DENSE_BRANCHES_PER_DECADE: f64 = 4.0;
/// Largest number of branches that a series may have. Chosen: it limits the time of a fit.
pub(super) const MAX_BRANCHES: usize = 200;

/// Prony series with moduli ≥ 0 and the smallest mean squared relative error.
///
/// # Errors
/// - [`RheologyError::InvalidParameter`] when an option is out of range;
/// - [`RheologyError::FitNotConverged`] when the least squares do not converge;
/// - [`RheologyError::NoStiffness`] when no branch can lower the error;
/// - [`RheologyError::SwappedModuli`], [`RheologyError::WrongTrend`] and [`RheologyError::NoMaterial`] when the moduli are
///   those of no relaxing material.
pub fn identify(
    curve: &MeasuredCurve,
    options: &IdentifyOptions,
) -> Result<Identification, RheologyError> {
    let found = fit_series(curve, options).and_then(|(problem, series)| {
        let found = problem.assess(curve, &series)?;
        let covariance = covariance(&problem.rows, curve, &found.spectrum);
        Ok(Identification {
            covariance,
            ..found
        })
    });
    // Say what is wrong with the data rather than that a fit is bad or has failed.
    if !matches!(found, Err(RheologyError::InvalidParameter(_))) {
        plausible::check(curve, options.long_time_limit, found.as_ref().ok())?;
    }
    found
}

/// Identified series without covariance and without a test of its plausibility.
pub(super) fn series_of(
    curve: &MeasuredCurve,
    options: &IdentifyOptions,
) -> Result<Identification, RheologyError> {
    let (problem, series) = fit_series(curve, options)?;
    problem.assess(curve, &series)
}

/// Fits the series; the returned problem has the weights that were used.
fn fit_series(
    curve: &MeasuredCurve,
    options: &IdentifyOptions,
) -> Result<(FitProblem, Series), RheologyError> {
    let mut problem = FitProblem {
        rows: curve.rows.clone(),
        window: curve.time_window,
        long_time_limit: options.long_time_limit,
    };
    // The weights do not depend on the number of branches: they follow from a dense series.
    problem.set_weights()?;
    let series = match options.control {
        Control::Branches(n_branches) => {
            problem.fit_moduli_and_times(valid_branch_count(n_branches)?)?
        }
        Control::Parsimony { tolerance } => {
            problem.fit_fewest_branches(positive("tolerance", tolerance)?)?
        }
        Control::Smooth { n_branches, weight } => {
            let times = problem.log_spaced_times(valid_branch_count(n_branches)?);
            problem.fit_moduli(times, not_negative("weight", weight)?)?
        }
    };
    Ok((problem, series))
}

/// Smallest ratio of the scale of the errors of a modulus in the fit to |G*|. Chosen: instruments measure a phase angle,
/// whose error changes the smaller modulus in proportion to |G*|.
const MIN_WEIGHT_SCALE: f64 = 0.1;
/// Largest ratio of the error of G' with individual weights to that with weights by |G*|. Chosen: beyond it the moduli
/// contradict each other, and a small G'' would spoil the fit of G'.
const MAX_STORAGE_ERROR_RATIO: f64 = 3.0;

/// The weighted data of a fit.
struct FitProblem {
    /// Measured numbers with their weights.
    rows: Vec<Measurement>,
    /// Shortest and longest time of the curve, \[s].
    window: [f64; 2],
    /// Behaviour at long times.
    long_time_limit: LongTimeLimit,
}

impl FitProblem {
    /// Weights G' and G'' by their own sizes instead of |G*|, unless they contradict each other.
    ///
    /// With contradicting moduli G'', mostly the smaller one, would degrade the fit of G'.
    fn set_weights(&mut self) -> Result<(), RheologyError> {
        // Fit with weights by |G*|, then weight each modulus by itself or by at least a tenth of |G*|, and compare the errors of
        // G'.
        let before = self.storage_error()?;
        let by_magnitude = self.rows.clone();
        for row in &mut self.rows {
            row.weight = row.value.max(MIN_WEIGHT_SCALE / row.weight).recip();
        }
        if self.storage_error()? > MAX_STORAGE_ERROR_RATIO * before {
            self.rows = by_magnitude;
        }
        Ok(())
    }

    /// Root mean square error of G' relative to its size, for the dense series with the present weights; 0 for G(t).
    fn storage_error(&self) -> Result<f64, RheologyError> {
        let series = self.fit_moduli(self.log_spaced_times(self.dense_branch_count()), 0.0)?;
        let error = self.error_of(&series, Quantity::Storage);
        Ok(error.map_or(0.0, |error| error.rms))
    }

    /// Number of branches of the dense series, [`DENSE_BRANCHES_PER_DECADE`] of the measured window, at least 2.
    fn dense_branch_count(&self) -> usize {
        let decades = (self.window[1] / self.window[0]).log10();
        let inner =
            (1..MAX_BRANCHES).take_while(|&k| k as f64 <= DENSE_BRANCHES_PER_DECADE * decades);
        2 + inner.count()
    }

    /// Relaxation times \[s] equally spaced in the logarithm, from end to end of the measured window.
    fn log_spaced_times(&self, n_branches: usize) -> Vec<f64> {
        let [shortest, longest] = self.window;
        if n_branches == 1 {
            return vec![(shortest * longest).sqrt()];
        }
        let log_ratio = (longest / shortest).ln() / (n_branches - 1) as f64;
        let time = |k| shortest * (log_ratio * k as f64).exp();
        (0..n_branches).map(time).collect()
    }

    /// Nonnegative least-squares fit of the moduli at given relaxation times \[s]; `smoothing` ≥ 0 weights their second differences.
    fn fit_moduli(&self, times: Vec<f64>, smoothing: f64) -> Result<Series, RheologyError> {
        let is_solid = self.long_time_limit == LongTimeLimit::Solid;
        let [n_rows, n_branches] = [self.rows.len(), times.len()];
        let n_columns = n_branches + usize::from(is_solid);
        // The columns are the responses of branches of unit modulus, and of a spring for a solid.
        let mut matrix = DMatrix::from_fn(n_rows, n_columns, |index, k| {
            let row = &self.rows[index];
            let response = times.get(k).map(|&time| row.branch(time)[0]);
            row.weight * response.unwrap_or_else(|| row.spring())
        });
        let mut target =
            DVector::from_iterator(n_rows, self.rows.iter().map(|row| row.weight * row.value));
        // Append rows with the second differences of the columns, which smooth the moduli (Tikhonov regularisation).
        if smoothing > 0.0 && n_branches > 2 {
            let differences = second_differences(&matrix.columns(0, n_branches)) * smoothing;
            matrix = matrix.resize_vertically(n_rows + n_branches - 2, 0.0);
            let mut below = matrix.view_mut((n_rows, 0), differences.shape());
            below.copy_from(&differences);
            target = target.resize_vertically(matrix.nrows(), 0.0);
        }
        // Solve for moduli that are not negative; that of the spring of a solid is the last.
        let mut moduli: Vec<f64> = nnls(&matrix, &target)?.data.into();
        let spring = is_solid.then(|| moduli.pop()).flatten();
        let branches = moduli
            .into_iter()
            .zip(times)
            .map(|(modulus, time)| RelaxationBranch::new(modulus, time));
        Ok(Series {
            spring,
            branches: branches.collect(),
        })
    }

    /// Series of at most `n_branches` with relaxation times at a local optimum.
    fn fit_moduli_and_times(&self, n_branches: usize) -> Result<Series, RheologyError> {
        // Fit the moduli at equally spaced times, move times and moduli together, and fit the moduli again, which may be zero.
        let [shortest, longest] = self.window;
        let window = [shortest / WINDOW_MARGIN, longest * WINDOW_MARGIN];
        let start = self.fit_moduli(self.log_spaced_times(n_branches), 0.0)?;
        let moved = refine(&self.rows, start.with_positive_moduli(), window);
        let times = moved.branches.iter().map(|branch| branch.relaxation_time);
        let end = self.fit_moduli(times.collect(), 0.0)?;
        let better = end.squares(&self.rows) < start.squares(&self.rows);
        Ok(if better { end } else { start })
    }

    /// Series with the fewest branches whose error is within the `tolerance` of the dense series.
    fn fit_fewest_branches(&self, tolerance: f64) -> Result<Series, RheologyError> {
        // The dense series shows the attainable error; take the fewest branches that come near to it.
        let dense_branch_count = self.dense_branch_count();
        let best = self.fit_moduli(self.log_spaced_times(dense_branch_count), 0.0)?;
        let allowed = (1.0 + tolerance).powi(2) * best.squares(&self.rows);
        for n_branches in 1..dense_branch_count {
            let series = self.fit_moduli_and_times(n_branches)?;
            if series.squares(&self.rows) <= allowed {
                return Ok(series);
            }
        }
        Ok(best)
    }

    /// Errors of a series with the weights of the curve.
    fn assess(
        &self,
        curve: &MeasuredCurve,
        series: &Series,
    ) -> Result<Identification, RheologyError> {
        // Errors are relative to |G*| whatever the weights of the fit were.
        let spring = series.spring.unwrap_or_default();
        let spectrum = RelaxationSpectrum::new(spring, 0.0, series.branches.clone())?;
        let measured = Self {
            rows: curve.rows.clone(),
            ..*self
        };
        let errors = measured.point_errors(series);
        Ok(Identification {
            spectrum,
            time_range: self.window,
            rms_relative_error: (errors.iter().sum::<f64>() / errors.len() as f64).sqrt(),
            max_relative_error: errors.into_iter().fold(0.0, f64::max).sqrt(),
            storage_error: measured.error_of(series, Quantity::Storage),
            loss_error: measured.error_of(series, Quantity::Loss),
            storage_sign_changes: measured.sign_changes_of(series, Quantity::Storage),
            loss_sign_changes: measured.sign_changes_of(series, Quantity::Loss),
            covariance: None,
        })
    }

    /// Relative errors of one measured quantity; `None` without measurements of it.
    fn error_of(&self, series: &Series, quantity: Quantity) -> Option<RelativeError> {
        let rows = self.rows.iter().filter(|row| row.quantity == quantity);
        let errors: Vec<f64> = rows
            .map(|row| (series.value(row) - row.value).abs() / row.size)
            .collect();
        let squares: f64 = errors.iter().map(|error| error * error).sum();
        let of_all = |n: usize| RelativeError {
            rms: (squares / n as f64).sqrt(),
            max: errors.iter().copied().fold(0.0, f64::max),
        };
        Some(errors.len()).filter(|n| *n > 0).map(of_all)
    }

    /// Sign changes of the residuals of one measured quantity, series less data; `None` without measurements of it.
    fn sign_changes_of(&self, series: &Series, quantity: Quantity) -> Option<SignChanges> {
        SignChanges::count(&self.rows, quantity, |row| series.value(row) - row.value)
    }

    /// Squared weighted errors of all points; the two numbers G' and G'' of a frequency are one point.
    fn point_errors(&self, series: &Series) -> Vec<f64> {
        let square = |row: &Measurement| (row.weight * (series.value(row) - row.value)).powi(2);
        let points = self
            .rows
            .chunk_by(|one, other| one.at.to_bits() == other.at.to_bits());
        points.map(|point| point.iter().map(square).sum()).collect()
    }
}

impl Series {
    /// The series with a hundredth of the smallest positive modulus in place of smaller ones, from which they can grow.
    fn with_positive_moduli(&self) -> Self {
        let mut series = self.clone();
        let moduli = series.branches.iter().map(|branch| branch.modulus);
        let grown: Vec<f64> = moduli.filter(|&modulus| modulus > 0.0).collect();
        let largest = grown.iter().copied().fold(0.0, f64::max);
        let seed = 1e-2 * grown.into_iter().fold(largest, f64::min);
        let moduli = series.branches.iter_mut().map(|branch| &mut branch.modulus);
        for modulus in moduli.chain(series.spring.as_mut()) {
            *modulus = modulus.max(seed);
        }
        series
    }
}

/// Matrix of the second differences x_k − 2 x_(k+1) + x_(k+2) of the moduli, each scaled by its effect on the weighted data.
fn second_differences(columns: &DMatrixView<f64>) -> DMatrix<f64> {
    let n_branches = columns.ncols();
    DMatrix::from_fn(n_branches - 2, n_branches, |row, k| {
        let factor = match k.checked_sub(row) {
            Some(0 | 2) => 1.0,
            Some(1) => -2.0,
            _ => 0.0,
        };
        factor * columns.column(k).norm()
    })
}

/// Returns a number of branches from 1 to [`MAX_BRANCHES`], and refuses others.
fn valid_branch_count(n_branches: usize) -> Result<usize, InvalidParameter> {
    let is_valid = (1..=MAX_BRANCHES).contains(&n_branches);
    in_range("n_branches", n_branches as f64, is_valid, "from 1 to 200").map(|_| n_branches)
}
