//! Better relaxation times: least squares in the logarithms of moduli and times, which keeps both positive.
//!
//! Levenberg's and Marquardt's method (Marquardt 1963, DOI 10.1137/0111030) with the damping on the diagonal.

use super::nnls::least_squares;
use super::system::Row;

/// A series while it is refined: the lone spring, if there is one, and the branches.
#[derive(Debug, Clone)]
pub(super) struct Series {
    pub(super) spring: Option<f64>,
    pub(super) moduli: Vec<f64>,
    pub(super) times: Vec<f64>,
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
            let trial = series.moved(&linear.step(damping), window);
            let trial_squares = trial.squares(rows);
            if trial_squares < squares {
                gained = Some(1.0 - trial_squares / squares);
                (series, squares) = (trial, trial_squares);
                damping *= 0.2;
            } else {
                damping *= 4.0;
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
    normal: Vec<Vec<f64>>,
    gradient: Vec<f64>,
}

impl Linearised {
    /// The damped step of all logarithms.
    fn step(&self, damping: f64) -> Vec<f64> {
        let mut columns = self.normal.clone();
        for (index, column) in columns.iter_mut().enumerate() {
            column[index] *= 1.0 + damping;
        }
        least_squares(columns, &self.gradient)
    }
}

impl Series {
    pub(super) fn value(&self, row: &Row) -> f64 {
        let branches = self.moduli.iter().zip(&self.times);
        let relaxing: f64 = branches
            .map(|(modulus, &time)| modulus * row.branch(time)[0])
            .sum();
        self.spring.unwrap_or_default() * row.spring() + relaxing
    }

    /// Sum of squared relative errors.
    pub(super) fn squares(&self, rows: &[Row]) -> f64 {
        let errors = rows
            .iter()
            .map(|row| row.weight * (self.value(row) - row.value));
        errors.map(|error| error * error).sum()
    }

    fn linearised(&self, rows: &[Row]) -> Linearised {
        let n = self.moduli.len() * 2 + usize::from(self.spring.is_some());
        let mut normal = vec![vec![0.0; n]; n];
        let mut gradient = vec![0.0; n];
        let mut slopes = Vec::with_capacity(n);
        for row in rows {
            let error = row.weight * (row.value - self.slopes(row, &mut slopes));
            for ((column, entry), slope) in normal.iter_mut().zip(&mut gradient).zip(&slopes) {
                *entry += slope * error;
                for (entry, other) in column.iter_mut().zip(&slopes) {
                    *entry += slope * other;
                }
            }
        }
        Linearised { normal, gradient }
    }

    /// Value of the series; into `slopes` go its weighted derivatives by the logarithms of spring, moduli and times.
    fn slopes(&self, row: &Row, slopes: &mut Vec<f64>) -> f64 {
        slopes.clear();
        let spring = self.spring.map(|modulus| modulus * row.spring());
        slopes.extend(spring.map(|value| row.weight * value));
        let mut value = spring.unwrap_or_default();
        for (modulus, &time) in self.moduli.iter().zip(&self.times) {
            let [response, by_log_time] = row.branch(time);
            value += modulus * response;
            slopes.push(row.weight * modulus * response);
            slopes.push(row.weight * modulus * by_log_time);
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
        for (k, pair) in branches.chunks_exact(2).enumerate() {
            moved.moduli[k] *= factor(pair[0]);
            moved.times[k] = (moved.times[k] * factor(pair[1])).clamp(shortest, longest);
        }
        moved
    }
}
