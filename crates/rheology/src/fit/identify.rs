//! The Prony series behind a measured curve.

use super::curve::MeasuredCurve;
use super::nnls::nnls;
use super::refine::{Series, refine};
use super::system::{Row, rows};
use crate::error::{not_negative, positive};
use crate::{RelaxationBranch, RelaxationSpectrum, RheologyError};

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

/// A Prony series, and how well it fits.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Identification {
    /// The series.
    pub spectrum: RelaxationSpectrum,
    /// Root of the mean over all points of the squared relative error |G*_fit/G* − 1|², or of (G_fit(t)/G(t) − 1)².
    pub rms_relative_error: f64,
    /// The largest of these relative errors.
    pub max_relative_error: f64,
}

/// How far beyond the measured window, as a factor, a time may move.
const WINDOW_MARGIN: f64 = 10.0;
const DENSE_PER_DECADE: f64 = 4.0;
const MAX_BRANCHES: usize = 200;

/// The Prony series with moduli ≥ 0 that has the least mean squared relative error.
///
/// # Errors
/// [`RheologyError::InvalidParameter`] when an option is out of range; [`RheologyError::FitNotConverged`];
/// [`RheologyError::NoStiffness`] when no branch can lower the error.
pub fn identify(
    curve: &MeasuredCurve,
    options: &IdentifyOptions,
) -> Result<Identification, RheologyError> {
    let problem = Problem {
        rows: rows(curve),
        window: curve.time_window(),
        ending: options.ending,
    };
    let series = match options.control {
        Control::Branches(n_branches) => problem.refined(legal(n_branches)?)?,
        Control::Parsimony { tolerance } => problem.fewest(positive("tolerance", tolerance)?)?,
        Control::Smooth { n_branches, weight } => {
            let times = problem.spaced(legal(n_branches)?);
            problem.solved(times, not_negative("weight", weight)?)?
        }
    };
    problem.assessed(&series)
}

struct Problem {
    rows: Vec<Row>,
    window: [f64; 2],
    ending: Ending,
}

impl Problem {
    /// Times equally spaced in the logarithm, from end to end of the measured window.
    fn spaced(&self, n_branches: usize) -> Vec<f64> {
        let [shortest, longest] = self.window;
        if n_branches == 1 {
            return vec![(shortest * longest).sqrt()];
        }
        let log_ratio = (longest / shortest).ln() / (n_branches - 1) as f64;
        (0..n_branches)
            .map(|k| shortest * (log_ratio * k as f64).exp())
            .collect()
    }

    /// The best moduli at given times; `smoothing` weighs their second differences.
    fn solved(&self, times: Vec<f64>, smoothing: f64) -> Result<Series, RheologyError> {
        let mut target: Vec<f64> = self.rows.iter().map(|row| row.weight * row.value).collect();
        let column = |response: &dyn Fn(&Row) -> f64| -> Vec<f64> {
            let weighted = self.rows.iter().map(|row| row.weight * response(row));
            weighted.collect()
        };
        let mut columns: Vec<Vec<f64>> = times
            .iter()
            .map(|&time| column(&|row| row.branch(time)[0]))
            .collect();
        smooth(&mut columns, &mut target, smoothing);
        if self.ending == Ending::Solid {
            let mut spring = column(&Row::spring);
            spring.resize(target.len(), 0.0);
            columns.push(spring);
        }
        let mut moduli = nnls(&columns, &target)?;
        let spring = (self.ending == Ending::Solid)
            .then(|| moduli.pop())
            .flatten();
        Ok(Series {
            spring,
            moduli,
            times,
        })
    }

    /// At most `n_branches`, with their times at a local optimum.
    fn refined(&self, n_branches: usize) -> Result<Series, RheologyError> {
        let [shortest, longest] = self.window;
        let window = [shortest / WINDOW_MARGIN, longest * WINDOW_MARGIN];
        let start = self.solved(self.spaced(n_branches), 0.0)?;
        let moved = refine(&self.rows, start.revived(), window);
        let end = self.solved(moved.times, 0.0)?;
        let better = end.squares(&self.rows) < start.squares(&self.rows);
        Ok(if better { end } else { start })
    }

    /// The fewest branches that are nearly as good as many.
    fn fewest(&self, tolerance: f64) -> Result<Series, RheologyError> {
        let decades = (self.window[1] / self.window[0]).log10();
        let inner = (1..MAX_BRANCHES).take_while(|&k| k as f64 <= DENSE_PER_DECADE * decades);
        let dense = 2 + inner.count();
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

    fn assessed(&self, series: &Series) -> Result<Identification, RheologyError> {
        let branches = series.moduli.iter().zip(&series.times);
        let branches = branches.map(|(&modulus, &relaxation_time)| RelaxationBranch {
            modulus,
            relaxation_time,
        });
        let spring = series.spring.unwrap_or_default();
        let spectrum = RelaxationSpectrum::new(spring, 0.0, branches.collect())?;
        let errors = self.point_errors(series);
        Ok(Identification {
            spectrum,
            rms_relative_error: (errors.iter().sum::<f64>() / errors.len() as f64).sqrt(),
            max_relative_error: errors.into_iter().fold(0.0, f64::max).sqrt(),
        })
    }

    /// Squared relative error of every point; the two rows of a frequency are one point.
    fn point_errors(&self, series: &Series) -> Vec<f64> {
        let square = |row: &Row| (row.weight * (series.value(row) - row.value)).powi(2);
        let rows_per_point = self
            .rows
            .iter()
            .take_while(|row| row.same_point(&self.rows[0]));
        let points = self.rows.chunks(rows_per_point.count().max(1));
        points.map(|point| point.iter().map(square).sum()).collect()
    }
}

impl Series {
    /// Branches that the first guess left out come back small, where they can grow.
    fn revived(&self) -> Self {
        let mut series = self.clone();
        let largest = series.moduli.iter().copied().fold(0.0, f64::max);
        let least = series
            .moduli
            .iter()
            .copied()
            .filter(|&modulus| modulus > 0.0);
        let seed = 1e-2 * least.fold(largest, f64::min);
        for modulus in series.moduli.iter_mut().chain(series.spring.as_mut()) {
            *modulus = modulus.max(seed);
        }
        series
    }
}

/// Adds one row for every second difference of neighbouring moduli, in units of what each does to the weighted data.
fn smooth(columns: &mut [Vec<f64>], target: &mut Vec<f64>, weight: f64) {
    if weight == 0.0 || columns.len() < 3 {
        return;
    }
    let n_rows = target.len();
    let norms = columns
        .iter()
        .map(|column| column.iter().map(|x| x * x).sum::<f64>().sqrt());
    let norms: Vec<f64> = norms.collect();
    target.resize(n_rows + columns.len() - 2, 0.0);
    for (index, column) in columns.iter_mut().enumerate() {
        column.resize(target.len(), 0.0);
        // Row k holds x_k − 2 x_(k+1) + x_(k+2).
        let differences = &mut column[n_rows..];
        for (place, factor) in [1.0, -2.0, 1.0].into_iter().enumerate() {
            if let Some(entry) = index
                .checked_sub(place)
                .and_then(|k| differences.get_mut(k))
            {
                *entry = weight * factor * norms[index];
            }
        }
    }
}

fn legal(n_branches: usize) -> Result<usize, RheologyError> {
    if (1..=MAX_BRANCHES).contains(&n_branches) {
        return Ok(n_branches);
    }
    Err(RheologyError::InvalidParameter {
        parameter: "n_branches",
        value: n_branches as f64,
        allowed: "from 1 to 200",
    })
}
