//! The Prony series behind a measured curve.

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

/// What happens after a long time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// A lone spring holds.
    Solid,
    /// Everything flows.
    Liquid,
}

/// How many branches there are, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Control {
    /// At most this many branches, their times moved to the best places.
    Branches(usize),
    /// The fewest branches whose error is at most `1 + tolerance` times the error of a series with four branches per
    /// decade.
    Parsimony {
        /// Excess error allowed, greater than 0.
        tolerance: f64,
    },
    /// This many branches, their times equally spaced in the logarithm, with moduli that vary smoothly (Tikhonov).
    Smooth {
        /// Number of branches.
        n_branches: usize,
        /// Weight of the second differences of the moduli, each relative to the measured modulus at its time, against
        /// the relative errors; at least 0.
        weight: f64,
    },
}

/// What is sought.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IdentifyOptions {
    /// Solid or liquid.
    pub ending: Ending,
    /// Number and places of the branches.
    pub control: Control,
}

impl Default for IdentifyOptions {
    fn default() -> Self {
        Self {
            ending: Ending::Solid,
            control: Control::Parsimony { tolerance: 0.02 },
        }
    }
}

/// Errors of a modulus at all points, relative to its own size.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RelativeError {
    /// Root of the mean square.
    pub rms: f64,
    /// The largest.
    pub max: f64,
}

/// A Prony series, and how well it fits.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Identification {
    /// The series.
    pub spectrum: RelaxationSpectrum,
    /// The shortest and the longest time of the curve, 1/ω or t, \[s].
    pub time_range: [f64; 2],
    /// Root of the mean over all points of the squared relative error |G*_fit/G* − 1|², or of (G_fit(t)/G(t) − 1)².
    pub rms_relative_error: f64,
    /// The largest of these relative errors.
    pub max_relative_error: f64,
    /// Errors of G' by itself, relative to [`ModulusPoint::sizes`](super::ModulusPoint::sizes); none of G(t).
    pub storage_error: Option<RelativeError>,
    /// The same of G''.
    pub loss_error: Option<RelativeError>,
    /// Signs of the errors of G' along the frequency; none of G(t).
    pub storage_sign_changes: Option<SignChanges>,
    /// The same of G''.
    pub loss_sign_changes: Option<SignChanges>,
    /// How well the moduli are known; none where that leaves the range of `f64`.
    pub covariance: Option<ModuliCovariance>,
}

/// The series as one that stands for what was measured, with the largest error at the points.
impl From<Identification> for PronyExpansion {
    fn from(found: Identification) -> Self {
        Self {
            spectrum: found.spectrum,
            relative_error: found.max_relative_error,
            time_range: found.time_range,
        }
    }
}

/// How far beyond the measured window, as a factor m, a time may move. Beyond the window the loss modulus of a branch is then at most
/// (m + 1/m)/2 = 1.25 times what it is at the end of the window: a branch far outside would be an invention of its flank.
const WINDOW_MARGIN: f64 = 2.0;
const DENSE_PER_DECADE: f64 = 4.0;
pub(super) const MAX_BRANCHES: usize = 200;

/// The Prony series with moduli ≥ 0 that has the least mean squared relative error.
///
/// # Errors
/// [`RheologyError::InvalidParameter`] when an option is out of range; [`RheologyError::FitNotConverged`];
/// [`RheologyError::NoStiffness`] when no branch can lower the error; [`RheologyError::SwappedModuli`],
/// [`RheologyError::WrongTrend`] and [`RheologyError::NoMaterial`] when the moduli are those of no relaxing material.
pub fn identify(
    curve: &MeasuredCurve,
    options: &IdentifyOptions,
) -> Result<Identification, RheologyError> {
    let found = fitted(curve, options).and_then(|(problem, series)| {
        let found = problem.assessed(curve, &series)?;
        let covariance = covariance(&problem.rows, curve, &found.spectrum);
        Ok(Identification {
            covariance,
            ..found
        })
    });
    if !matches!(found, Err(RheologyError::InvalidParameter(_))) {
        plausible::check(curve, options.ending, found.as_ref().ok())?;
    }
    found
}

/// The same, however badly it fits, without a covariance.
pub(super) fn series_of(
    curve: &MeasuredCurve,
    options: &IdentifyOptions,
) -> Result<Identification, RheologyError> {
    let (problem, series) = fitted(curve, options)?;
    problem.assessed(curve, &series)
}

/// The series, and the rows with the weights that it was fitted with.
fn fitted(
    curve: &MeasuredCurve,
    options: &IdentifyOptions,
) -> Result<(Measured, Series), RheologyError> {
    let mut problem = Measured {
        rows: curve.rows.clone(),
        window: curve.time_window,
        ending: options.ending,
    };
    problem.weigh()?;
    let series = match options.control {
        Control::Branches(n_branches) => problem.refined(legal(n_branches)?)?,
        Control::Parsimony { tolerance } => problem.fewest(positive("tolerance", tolerance)?)?,
        Control::Smooth { n_branches, weight } => {
            let times = problem.spaced(legal(n_branches)?);
            problem.solved(times, not_negative("weight", weight)?)?
        }
    };
    Ok((problem, series))
}

/// Part of |G*| below which the errors of a modulus count relative to this part.
const OWN: f64 = 0.1;
/// Times by which G' may be off more for the sake of G'', before they are taken for moduli that contradict each other.
const CONTRADICTS: f64 = 3.0;

struct Measured {
    rows: Vec<Measurement>,
    window: [f64; 2],
    ending: Ending,
}

impl Measured {
    /// Divides G' and G'' by their own sizes instead of |G*|, unless they contradict each other: then G'', which is mostly the
    /// smaller one, would spoil G'.
    fn weigh(&mut self) -> Result<(), RheologyError> {
        let before = self.storage_error()?;
        let by_magnitude = self.rows.clone();
        for row in &mut self.rows {
            row.weight = row.value.max(OWN / row.weight).recip();
        }
        if self.storage_error()? > CONTRADICTS * before {
            self.rows = by_magnitude;
        }
        Ok(())
    }

    /// What many branches leave of G'.
    fn storage_error(&self) -> Result<f64, RheologyError> {
        let series = self.solved(self.spaced(self.dense()), 0.0)?;
        let error = self.error_of(&series, Quantity::Storage);
        Ok(error.map_or(0.0, |error| error.rms))
    }

    /// Four branches per decade of the window.
    fn dense(&self) -> usize {
        let decades = (self.window[1] / self.window[0]).log10();
        let inner = (1..MAX_BRANCHES).take_while(|&k| k as f64 <= DENSE_PER_DECADE * decades);
        2 + inner.count()
    }

    /// Times equally spaced in the logarithm, from end to end of the measured window.
    fn spaced(&self, n_branches: usize) -> Vec<f64> {
        let [shortest, longest] = self.window;
        if n_branches == 1 {
            return vec![(shortest * longest).sqrt()];
        }
        let log_ratio = (longest / shortest).ln() / (n_branches - 1) as f64;
        let time = |k| shortest * (log_ratio * k as f64).exp();
        (0..n_branches).map(time).collect()
    }

    /// The best moduli at given times; `smoothing` weighs their second differences.
    fn solved(&self, times: Vec<f64>, smoothing: f64) -> Result<Series, RheologyError> {
        let is_solid = self.ending == Ending::Solid;
        let [n_rows, n_branches] = [self.rows.len(), times.len()];
        let n_columns = n_branches + usize::from(is_solid);
        let mut matrix = DMatrix::from_fn(n_rows, n_columns, |index, k| {
            let row = &self.rows[index];
            let response = times.get(k).map(|&time| row.branch(time)[0]);
            row.weight * response.unwrap_or_else(|| row.spring())
        });
        let mut target =
            DVector::from_iterator(n_rows, self.rows.iter().map(|row| row.weight * row.value));
        if smoothing > 0.0 && n_branches > 2 {
            let differences = second_differences(&matrix.columns(0, n_branches)) * smoothing;
            matrix = matrix.resize_vertically(n_rows + n_branches - 2, 0.0);
            let mut below = matrix.view_mut((n_rows, 0), differences.shape());
            below.copy_from(&differences);
            target = target.resize_vertically(matrix.nrows(), 0.0);
        }
        let mut moduli: Vec<f64> = nnls(&matrix, &target)?.data.into();
        let spring = is_solid.then(|| moduli.pop()).flatten();
        let branches = moduli.into_iter().zip(times);
        let branches = branches.map(|(modulus, time)| RelaxationBranch::new(modulus, time));
        Ok(Series {
            spring,
            branches: branches.collect(),
        })
    }

    /// At most `n_branches`, with their times at a local optimum.
    fn refined(&self, n_branches: usize) -> Result<Series, RheologyError> {
        let [shortest, longest] = self.window;
        let window = [shortest / WINDOW_MARGIN, longest * WINDOW_MARGIN];
        let start = self.solved(self.spaced(n_branches), 0.0)?;
        let moved = refine(&self.rows, start.revived(), window);
        let times = moved.branches.iter().map(|branch| branch.relaxation_time);
        let end = self.solved(times.collect(), 0.0)?;
        let better = end.squares(&self.rows) < start.squares(&self.rows);
        Ok(if better { end } else { start })
    }

    /// The fewest branches that are nearly as good as many.
    fn fewest(&self, tolerance: f64) -> Result<Series, RheologyError> {
        let dense = self.dense();
        let best = self.solved(self.spaced(dense), 0.0)?;
        let allowed = (1.0 + tolerance).powi(2) * best.squares(&self.rows);
        for n_branches in 1..dense {
            let series = self.refined(n_branches)?;
            if series.squares(&self.rows) <= allowed {
                return Ok(series);
            }
        }
        Ok(best)
    }

    /// The errors of a series, by the sizes of the curve itself.
    fn assessed(
        &self,
        curve: &MeasuredCurve,
        series: &Series,
    ) -> Result<Identification, RheologyError> {
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

    /// Of a modulus by itself.
    fn error_of(&self, series: &Series, quantity: Quantity) -> Option<RelativeError> {
        let rows = self.rows.iter().filter(|row| row.quantity == quantity);
        let errors = rows.map(|row| (series.value(row) - row.value).abs() / row.size);
        let errors: Vec<f64> = errors.collect();
        let squares: f64 = errors.iter().map(|error| error * error).sum();
        let of_all = |n: usize| RelativeError {
            rms: (squares / n as f64).sqrt(),
            max: errors.iter().copied().fold(0.0, f64::max),
        };
        Some(errors.len()).filter(|n| *n > 0).map(of_all)
    }

    fn sign_changes_of(&self, series: &Series, quantity: Quantity) -> Option<SignChanges> {
        SignChanges::of(&self.rows, quantity, |row| series.value(row) - row.value)
    }

    /// Squared relative error of every point; the two rows of a frequency are one point.
    fn point_errors(&self, series: &Series) -> Vec<f64> {
        let square = |row: &Measurement| (row.weight * (series.value(row) - row.value)).powi(2);
        let points = self
            .rows
            .chunk_by(|one, other| one.at.to_bits() == other.at.to_bits());
        points.map(|point| point.iter().map(square).sum()).collect()
    }
}

impl Series {
    /// Branches that the first guess left out come back small, where they can grow.
    fn revived(&self) -> Self {
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

/// One row x_k − 2 x_(k+1) + x_(k+2) for every second difference of neighbouring moduli, in units of what each does to the
/// weighted data.
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

fn legal(n_branches: usize) -> Result<usize, InvalidParameter> {
    let holds = (1..=MAX_BRANCHES).contains(&n_branches);
    in_range("n_branches", n_branches as f64, holds, "from 1 to 200").map(|_| n_branches)
}
