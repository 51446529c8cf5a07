//! Time series of friction: runs at constant speed, and their means after the run-in.

use std::fmt;

use numerics::vectors::mean;

use super::FrictionPoint;
use super::read::{Row, rounded};
use crate::indentation::correlated_points;

/// Smallest number of rows from which the friction of a run is averaged. Chosen: the standard error of a mean of 10
/// independent rows has itself a relative error of 1/√18, 24 %.
pub(super) const MIN_ROWS: usize = 10;
/// Largest relative deviation of the speed of a row from that of the first row of its run. A row that deviates more begins
/// another run. Chosen: it is above the ripple of a speed control and below the steps from one speed to the next.
const SPEED_TOLERANCE: f64 = 0.02;
/// Fraction of the rows of a run whose friction has the opposite sign of the mean, above which the run is refused. Chosen:
/// single rows change their sign by noise; where more of them do, the run contains a turn, or its friction is below the
/// noise.
const MAX_OPPOSITE_SIGN_FRACTION: f64 = 0.1;
/// Difference of the mean friction in the two halves of a run above which a drift is reported, in standard errors of the
/// difference. Chosen: in one of 16 000 runs noise alone exceeds it.
const DRIFT_STANDARD_ERRORS: f64 = 4.0;
/// Smallest ratio of the difference of the mean friction in the two halves of a run to the mean of the run, above which a
/// drift is reported. Chosen: the friction of repeated runs scatters by as much, so that a smaller drift does not matter.
const MIN_RELATIVE_DRIFT: f64 = 0.05;

/// Splits rows into runs of consecutive rows at one speed and increasing time; without times every row is a run.
pub(super) fn split(rows: &[Row]) -> Vec<&[Row]> {
    let mut runs = Vec::new();
    let mut start = 0;
    for at in 1..=rows.len() {
        let goes_on = rows.get(at).is_some_and(|row| {
            let is_later = row.time > rows[at - 1].time;
            let off = (row.velocity / rows[start].velocity - 1.0).abs();
            is_later && off <= SPEED_TOLERANCE
        });
        if !goes_on {
            runs.push(&rows[start..at]);
            start = at;
        }
    }
    runs
}

/// The mean of a run at constant speed.
pub(super) struct Run {
    /// Means of speed, friction, temperature and force.
    pub(super) point: FrictionPoint,
    /// First and last line of the run.
    lines: [usize; 2],
    /// Number of rows after the run-in.
    n_rows: usize,
    /// Standard deviation of the friction coefficient of a row.
    scatter: f64,
    /// Relative change of the mean from the first half to the second; `None` if it is not significant.
    drift: Option<f64>,
}

impl Run {
    /// Mean of the rows later than `run_in` \[s] after the first one. Of forces the coefficient is the ratio of their means.
    /// The error is a message.
    pub(super) fn new(rows: &[Row], run_in: f64, has_forces: bool) -> Result<Self, String> {
        let steady = after_run_in(rows, run_in)?;
        let mean_of = |of: &dyn Fn(&Row) -> Option<f64>| {
            let values: Option<Vec<f64>> = steady.iter().map(of).collect();
            values.map(|values| mean(&values))
        };
        let normal_force = mean_of(&|row| row.normal_force);
        if let Some(force) = normal_force.filter(|force| *force <= 0.0) {
            return Err(format!(
                "the mean normal force of the run is {force:.4} N, and must be greater than 0"
            ));
        }
        let unit = normal_force.filter(|_| has_forces).unwrap_or(1.0);
        let coefficients: Vec<f64> = steady.iter().map(|row| row.friction / unit).collect();
        check_signs(&coefficients)?;
        let (coefficient, scatter, error) = mean_and_errors(&coefficients);
        Ok(Self {
            point: FrictionPoint {
                velocity: mean_of(&|row| Some(row.velocity)).unwrap_or(f64::NAN),
                friction_coefficient: coefficient,
                standard_error: Some(error).filter(|error| *error > 0.0),
                temperature: mean_of(&|row| row.temperature),
                normal_force,
            },
            lines: [rows[0].line, rows[rows.len() - 1].line],
            n_rows: steady.len(),
            scatter,
            drift: drift(&coefficients),
        })
    }
}

/// The rows later than `run_in` \[s] after the first one; a message if they are fewer than [`MIN_ROWS`].
fn after_run_in(rows: &[Row], run_in: f64) -> Result<Vec<Row>, String> {
    let time = |row: &Row| row.time.unwrap_or_default();
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    let is_steady = |row: &&Row| time(row) - time(first) >= run_in;
    let steady: Vec<Row> = rows.iter().filter(is_steady).copied().collect();
    if steady.len() >= MIN_ROWS {
        return Ok(steady);
    }
    Err(format!(
        "the run from here to line {} lasts {} s, and {} of its {} rows are later than the run-in of {run_in} s: at least {MIN_ROWS} \
         are needed, so shorten the run-in or take this run out",
        last.line,
        rounded(time(last) - time(first)),
        steady.len(),
        rows.len()
    ))
}

/// Relative change of the mean from the first half to the second; `None` if it is small or not significant.
fn drift(coefficients: &[f64]) -> Option<f64> {
    let (first, second) = coefficients.split_at(coefficients.len() / 2);
    let [first, second] = [first, second].map(mean_and_errors);
    let change = second.0 - first.0;
    let relative = change / mean(coefficients);
    let is_significant = change.abs() > DRIFT_STANDARD_ERRORS * first.2.hypot(second.2);
    (is_significant && relative.abs() > MIN_RELATIVE_DRIFT).then_some(relative)
}

impl fmt::Display for Run {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, last] = self.lines;
        let point = &self.point;
        write!(
            formatter,
            "lines {first} to {last}: {} m/s, friction {:.4}",
            rounded(point.velocity),
            point.friction_coefficient
        )?;
        if let Some(error) = point.standard_error {
            write!(formatter, " ± {error:.1e} (standard error of the mean)")?;
        }
        write!(
            formatter,
            ", scatter {:.1e} of {} rows",
            self.scatter, self.n_rows
        )?;
        match self.drift {
            Some(drift) => write!(
                formatter,
                "; no plateau: its second half differs by {:.0} %, so name a longer run-in",
                100.0 * drift
            ),
            None => Ok(()),
        }
    }
}

/// Refuses friction of alternating sign, as of a reciprocating motion.
fn check_signs(coefficients: &[f64]) -> Result<(), String> {
    let negative = coefficients.iter().filter(|value| **value < 0.0).count();
    let part = negative as f64 / coefficients.len() as f64;
    if part <= MAX_OPPOSITE_SIGN_FRACTION && mean(coefficients) > 0.0 {
        return Ok(());
    }
    Err(format!(
        "the friction is negative in {:.0} % of the rows of the run that begins here: of a reciprocating motion give the rows of one \
         direction, or the mean of its absolute value",
        100.0 * part
    ))
}

/// Mean, standard deviation s of a value, and standard error s √(τ/n) of the mean of n correlated values, with their integrated
/// autocorrelation time τ (Sokal 1997).
fn mean_and_errors(values: &[f64]) -> (f64, f64, f64) {
    let mean = mean(values);
    let residuals: Vec<f64> = values.iter().map(|value| value - mean).collect();
    let squares: f64 = residuals.iter().map(|one| one * one).sum();
    let n = values.len() as f64;
    let deviation = (squares / (n - 1.0)).sqrt();
    (
        mean,
        deviation,
        deviation * (correlated_points(&residuals) / n).sqrt(),
    )
}
