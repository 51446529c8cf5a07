//! Better relaxation times: least squares in the logarithms of moduli and times, which keeps both positive.
//!
//! Levenberg's and Marquardt's method (Marquardt 1963, DOI 10.1137/0111030) with the damping on the diagonal.

use nalgebra::{DMatrix, DVector, DVectorViewMut};

use super::system::Row;
use crate::RelaxationBranch;

/// A series while it is refined: the lone spring, if there is one, and the branches.
#[derive(Debug, Clone)]
pub(super) struct Series {
    pub(super) spring: Option<f64>,
    pub(super) branches: Vec<RelaxationBranch>,
}

const MAX_STEPS: usize = 100;
/// A step that improves the sum of squares by less than this is the last one.
const SUFFICIENT: f64 = 1e-4;

/// Moves moduli and times, all of them positive, to a local minimum of the squared residuals; the times stay within the
/// `window`.
pub(super) fn refine(rows: &[Row], start: Series, window: [f64; 2]) -> Series {
    let mut series = start;
    let mut squares = series.squares(rows);
    let mut damping = 1e-3;
    for _ in 0..MAX_STEPS {
        let linear = series.linearised(rows);
        let mut gained = None;
        while gained.is_none() && damping < 1e9 {
            let step = linear.step(damping);
            let trial = step.map(|step| series.moved(step.as_slice(), window));
            let trial = trial.map(|trial| (trial.squares(rows), trial));
            match trial.filter(|(trial, _)| *trial < squares) {
                Some((trial_squares, trial)) => {
                    gained = Some(1.0 - trial_squares / squares);
                    (series, squares) = (trial, trial_squares);
                    damping *= 0.2;
                }
                None => damping *= 4.0,
            }
        }
        if gained.is_none_or(|fraction| fraction < SUFFICIENT) {
            break;
        }
    }
    series
}

/// Normal matrix and gradient.
struct Linearised {
    normal: DMatrix<f64>,
    gradient: DVector<f64>,
}

impl Linearised {
    /// The damped step of all logarithms; none where the damping is too small for the matrix.
    fn step(&self, damping: f64) -> Option<DVector<f64>> {
        let mut damped = self.normal.clone();
        let diagonal = self.normal.diagonal() * (1.0 + damping);
        damped.set_diagonal(&diagonal);
        Some(damped.cholesky()?.solve(&self.gradient))
    }
}

impl Series {
    pub(super) fn value(&self, row: &Row) -> f64 {
        let branches = self.branches.iter();
        let relaxing =
            branches.map(|branch| branch.modulus * row.branch(branch.relaxation_time)[0]);
        self.spring.unwrap_or_default() * row.spring() + relaxing.sum::<f64>()
    }

    /// Sum of squared relative errors.
    pub(super) fn squares(&self, rows: &[Row]) -> f64 {
        let error = |row: &Row| row.weight * (self.value(row) - row.value);
        rows.iter().map(error).map(|error| error * error).sum()
    }

    fn linearised(&self, rows: &[Row]) -> Linearised {
        let n = self.branches.len() * 2 + usize::from(self.spring.is_some());
        let mut slopes = DMatrix::zeros(n, rows.len());
        let errors = rows.iter().zip(slopes.column_iter_mut());
        let errors =
            errors.map(|(row, slopes)| row.weight * (row.value - self.slopes(row, slopes)));
        let errors = DVector::from_vec(errors.collect());
        Linearised {
            normal: &slopes * slopes.transpose(),
            gradient: slopes * errors,
        }
    }

    /// Value of the series; into `slopes` go its weighted derivatives by the logarithms of spring, moduli and times.
    fn slopes(&self, row: &Row, mut slopes: DVectorViewMut<f64>) -> f64 {
        let mut entries = slopes.iter_mut();
        let mut put = |slope: f64| {
            if let Some(entry) = entries.next() {
                *entry = row.weight * slope;
            }
        };
        let spring = self.spring.map(|modulus| modulus * row.spring());
        spring.into_iter().for_each(&mut put);
        let mut value = spring.unwrap_or_default();
        for &RelaxationBranch {
            modulus,
            relaxation_time,
        } in &self.branches
        {
            let [response, by_log_time] = row.branch(relaxation_time);
            value += modulus * response;
            put(modulus * response);
            put(modulus * by_log_time);
        }
        value
    }

    fn moved(&self, step: &[f64], [shortest, longest]: [f64; 2]) -> Self {
        // No quantity changes by more than a factor of e² at once.
        let factor = |step: f64| step.clamp(-2.0, 2.0).exp();
        let (spring, branches) = step.split_at(usize::from(self.spring.is_some()));
        let spring_factor = spring.first().copied().map_or(1.0, factor);
        let mut moved = self.clone();
        moved.spring = moved.spring.map(|modulus| modulus * spring_factor);
        for (branch, pair) in moved.branches.iter_mut().zip(branches.chunks_exact(2)) {
            branch.modulus *= factor(pair[0]);
            let time = branch.relaxation_time * factor(pair[1]);
            branch.relaxation_time = time.clamp(shortest, longest);
        }
        moved
    }
}
