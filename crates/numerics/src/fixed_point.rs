//! A state that one pass of a slow process leaves as it is.
//!
//! Of a contraction x → g(x) every second pass begins with the combination of the ends of those before for which g(x) − x is
//! least (Anderson 1965, J. ACM 12, 547; Walker & Ni 2011, SIAM J. Numer. Anal. 49, 1715). One more pass without it shows how
//! much still changes.

/// Passes that are made as they are at first.
const FIRST_PASSES: usize = 3;
/// Passes that are combined.
const COMBINED: usize = 8;
/// Smallest pivot of the equations of a combination, relative to the first.
const SINGULAR: f64 = 1e-12;

/// How a search has ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Settled<T> {
    /// What the last pass gave, and the number of passes.
    Found(T, usize),
    /// So much may be left after all passes that were allowed.
    Missed(f64),
}

/// Lists as long as the state that [`settle`] keeps, at most.
pub const KEPT_STATES: usize = 4 * (COMBINED + 1);

/// Makes passes until what is left, which follows from the results of two passes one after the other, is at most a
/// tolerance; a pass gives its result and the state at its end.
///
/// # Errors
/// Those of a pass.
pub fn settle<T, E>(
    mut state: Vec<f64>,
    (most, tolerance): (usize, f64),
    mut pass: impl FnMut(&[f64]) -> Result<(T, Vec<f64>), E>,
    mut left: impl FnMut(&mut T, &T) -> f64,
) -> Result<Settled<T>, E> {
    let mut pairs: Vec<[Vec<f64>; 2]> = Vec::new();
    let mut before: Option<T> = None;
    let mut rest = f64::INFINITY;
    for n_passes in 1..=most {
        let (mut found, end) = pass(&state)?;
        pairs.push([state, end.clone()]);
        state = end;
        let Some(last) = before.take() else {
            before = Some(found);
            continue;
        };
        rest = left(&mut found, &last);
        if rest <= tolerance {
            return Ok(Settled::Found(found, n_passes));
        }
        if n_passes < FIRST_PASSES {
            before = Some(found);
        } else {
            let excess = pairs.len().saturating_sub(COMBINED);
            pairs.drain(..excess);
            combine(&pairs, &mut state);
        }
    }
    Ok(Settled::Missed(rest))
}

/// The best combination of the ends of passes, of which the last is the state.
fn combine(pairs: &[[Vec<f64>; 2]], state: &mut [f64]) {
    let residuals: Vec<Vec<f64>> = pairs.iter().map(|[x, g]| minus(g, x)).collect();
    let (Some((_, others)), Some((residual, before))) =
        (pairs.split_last(), residuals.split_last())
    else {
        return;
    };
    let changes: Vec<Vec<f64>> = before.iter().map(|one| minus(residual, one)).collect();
    let last = state.to_vec();
    for (weight, [_, end]) in weights(&changes, residual).iter().zip(others) {
        for (value, (last, end)) in state.iter_mut().zip(last.iter().zip(end)) {
            *value -= weight * (last - end);
        }
    }
}

fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `a` − `factor` · `b`.
fn subtract(a: &mut [f64], factor: f64, b: &[f64]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a -= factor * b;
    }
}

/// Weights γ for which |b − Σ γ_k a_k| is least, by orthogonalisation; 0 for what depends on the others.
fn weights(vectors: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    let mut weights = vec![0.0; vectors.len()];
    // Each basis vector is a combination of the vectors, whose weights are its row; the last passes come first.
    let mut basis: Vec<[Vec<f64>; 2]> = Vec::new();
    for (index, vector) in vectors.iter().enumerate().rev() {
        let mut vector = vector.clone();
        let mut row = vec![0.0; vectors.len()];
        row[index] = 1.0;
        let size = dot(&vector, &vector);
        for [other, other_row] in &basis {
            let part = dot(other, &vector);
            subtract(&mut vector, part, other);
            subtract(&mut row, part, other_row);
        }
        let left = dot(&vector, &vector);
        if left > SINGULAR * size && left > 0.0 {
            let scale = left.sqrt().recip();
            vector
                .iter_mut()
                .chain(&mut row)
                .for_each(|value| *value *= scale);
            basis.push([vector, row]);
        }
    }
    for [vector, row] in &basis {
        subtract(&mut weights, -dot(vector, target), row);
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Modes that lose from nearly all to a ten thousandth of their distance in a pass.
    #[test]
    fn slow_modes_take_few_passes() {
        let rates = [0.1, 0.9, 0.99, 0.999, 0.9999];
        let pass = |state: &[f64]| {
            let modes = state.iter().zip(rates);
            let end: Vec<f64> = modes.map(|(x, rate)| 1.0 + rate * (x - 1.0)).collect();
            Ok::<_, ()>((end.clone(), end))
        };
        let left = |now: &mut Vec<f64>, before: &Vec<f64>| {
            let changes = now.iter().zip(before).map(|(a, b)| (a - b).abs());
            1e4 * changes.fold(0.0, f64::max)
        };
        let found = settle(vec![0.0; 5], (100, 1e-6), pass, left);
        let Ok(Settled::Found(state, passes)) = found else {
            panic!("{found:?}");
        };
        let error = state.iter().map(|x| (x - 1.0).abs()).fold(0.0, f64::max);
        assert!(
            error <= 1e-6 && passes < 20,
            "{state:?} after {passes} passes"
        );
    }
}
