//! Nonlinear least squares in the logarithms of moduli and relaxation times, which keeps both positive.

use nalgebra::{DMatrix, DVector, DVectorViewMut};
use numerics::least_squares::{ParameterRange, QuadraticModel, minimise};

use super::system::Measurement;
use crate::RelaxationBranch;

/// A Prony series during the fit: the equilibrium modulus, if there is one, and the branches.
#[derive(Debug, Clone)]
pub(super) struct Series {
    /// Equilibrium modulus, \[Pa]; `None` for a liquid.
    pub(super) spring: Option<f64>,
    /// Relaxing branches.
    pub(super) branches: Vec<RelaxationBranch>,
}

/// Relative improvement of the sum of squares below which the iteration ends. Chosen; a smaller one costs more steps.
const SUFFICIENT_IMPROVEMENT: f64 = 1e-4;
/// Largest change of the natural logarithm of a modulus or time in one step, a factor of 7.4. Chosen: a wrong start is
/// corrected in a few steps, and a step in a wrong direction loses less than a decade.
const MAX_LOG_STEP: f64 = 2.0;

/// Moves positive moduli and times to a local minimum of the squared residuals, with the times in the `window` \[s].
pub(super) fn refine(rows: &[Measurement], start: Series, window: [f64; 2]) -> Series {
    let range = |bounds| ParameterRange {
        bounds,
        largest_step: MAX_LOG_STEP,
    };
    // Moduli may take any positive value; relaxation times must stay within the window.
    let anywhere = range([f64::NEG_INFINITY, f64::INFINITY]);
    let within = range(window.map(f64::ln));
    let spring = start.spring.map(|_| anywhere);
    let branches = start.branches.iter().flat_map(|_| [anywhere, within]);
    let ranges: Vec<ParameterRange> = spring.into_iter().chain(branches).collect();
    let linearise = |logarithms: &[f64]| Some(start.with_logarithms(logarithms).linearise(rows));
    let found = minimise(
        linearise,
        start.logarithms(),
        &ranges,
        SUFFICIENT_IMPROVEMENT,
    );
    found.map_or_else(
        || start.clone(),
        |found| start.with_logarithms(&found.parameters),
    )
}

impl Series {
    /// Logarithms of the equilibrium modulus if there is one, then of modulus and time of every branch.
    fn logarithms(&self) -> Vec<f64> {
        let branches = self
            .branches
            .iter()
            .flat_map(|branch| [branch.modulus, branch.relaxation_time]);
        let parameters = self.spring.into_iter().chain(branches);
        parameters.map(f64::ln).collect()
    }

    /// The series of the same form with other [logarithms](Self::logarithms).
    fn with_logarithms(&self, logarithms: &[f64]) -> Self {
        let (spring, branches) = logarithms.split_at(usize::from(self.spring.is_some()));
        let branch = |pair: &[f64]| RelaxationBranch::new(pair[0].exp(), pair[1].exp());
        Self {
            spring: spring.first().map(|modulus| modulus.exp()),
            branches: branches.chunks_exact(2).map(branch).collect(),
        }
    }

    /// Value of the series for a measured number: G', G'' or G(t) at its frequency or time, \[Pa].
    pub(super) fn value(&self, row: &Measurement) -> f64 {
        let branches = self.branches.iter();
        let relaxing =
            branches.map(|branch| branch.modulus * row.branch(branch.relaxation_time)[0]);
        self.spring.unwrap_or_default() * row.spring() + relaxing.sum::<f64>()
    }

    /// Sum of squared weighted errors.
    pub(super) fn squares(&self, rows: &[Measurement]) -> f64 {
        let error = |row: &Measurement| row.weight * (self.value(row) - row.value);
        rows.iter().map(error).map(|error| error * error).sum()
    }

    /// Quadratic model of the sum of squares, by the logarithms of all parameters.
    fn linearise(&self, rows: &[Measurement]) -> QuadraticModel {
        let n = self.branches.len() * 2 + usize::from(self.spring.is_some());
        // Compute the weighted residuals, data less series, and their derivatives by each modulus and time.
        let mut slopes = DMatrix::zeros(n, rows.len());
        let errors = rows.iter().zip(slopes.column_iter_mut());
        let errors =
            errors.map(|(row, slopes)| row.weight * (row.value - self.slopes(row, slopes)));
        let errors = DVector::from_vec(errors.collect());
        QuadraticModel {
            sum: errors.norm_squared(),
            matrix: (&slopes * slopes.transpose()).data.into(),
            descent: (slopes * errors).data.into(),
        }
    }

    /// Value of the series; `slopes` receives its weighted derivatives by the logarithms of the parameters.
    fn slopes(&self, row: &Measurement, mut slopes: DVectorViewMut<f64>) -> f64 {
        let mut entries = slopes.iter_mut();
        let mut put = |slope: f64| {
            if let Some(entry) = entries.next() {
                *entry = row.weight * slope;
            }
        };
        let spring = self.spring.map(|modulus| modulus * row.spring());
        spring.into_iter().for_each(&mut put);
        let mut value = spring.unwrap_or_default();
        for branch in &self.branches {
            let [response, by_log_time] = row.branch(branch.relaxation_time);
            value += branch.modulus * response;
            put(branch.modulus * response);
            put(branch.modulus * by_log_time);
        }
        value
    }
}
