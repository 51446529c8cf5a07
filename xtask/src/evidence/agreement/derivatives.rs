//! Derivatives of an answer by all numbers of its scene must add up to nothing: in other units of length, stress or time the
//! scene and its answer are the same.

use anyhow::{Context as _, Result};
use toml::Value;
use viscofriction::Estimate;
use viscofriction::scene::Indenter;
use viscofriction::solve::{Answer, Sensitivity};

use super::judge::{Comparison, quantities};
use super::relation::Answered;
use super::units::Powers;
use crate::evidence::request::{derivatives, number_at};

/// Ratio of the error from rounding that is allowed of a sum to the sum of the absolute values of its terms. Chosen far above the
/// unit of rounding, since large terms of stiff scenes cancel.
const SUM_ROUNDING_TOLERANCE: f64 = 1e-6;

/// For each quantity q and each of the units of length, stress and time: the sum of ∂ln q/∂ln x · ln(x'/x) over all numbers x
/// of the scene, compared with ln(q'/q), where the prime means the value in a unit half as large (Euler's theorem on
/// homogeneous functions). Empty where there are no derivatives, and of a scene with files, by whose numbers nothing is
/// differentiated.
pub(super) fn sums(first: Answered) -> Result<Vec<Comparison>> {
    let case = first.case;
    if case.lengths.is_some() || case.material.is_some() {
        return Ok(Vec::new());
    }
    let problem = case.problem(first.folder)?;
    let answer = first.answer.clone();
    let known = derivatives(&case.scene, &problem, answer)?;
    let one = Powers::default();
    let units = [
        Powers { length: 1, ..one },
        Powers { stress: 1, ..one },
        Powers { time: 1, ..one },
    ];
    // Skip units of length for a rough surface, because answers are not differentiated by the lengths that choose its waves.
    let has_waves = matches!(case.scene.indenter, Indenter::SelfAffine(_));
    let mut sums = Vec::new();
    for unit in units {
        if has_waves && unit.length != 0 {
            continue;
        }
        let mut other = case.clone();
        unit.apply(&mut other)?;
        let scenes = [&case.scene, &other.scene].map(Value::try_from);
        let [here, there] = scenes;
        sums.extend(sums_in(&known, [here?, there?], unit, first.answer)?);
    }
    Ok(sums)
}

/// The sums for one `unit`. `known`: derivatives of logarithms by logarithms; `scenes`: the scene in both units.
fn sums_in(
    known: &[Sensitivity],
    mut scenes: [Value; 2],
    unit: Powers,
    answer: &Answer,
) -> Result<Vec<Comparison>> {
    let factors = unit.factors(answer.is_per_length)?;
    let mut sums = Vec::new();
    for (name, _) in quantities(answer) {
        let (mut sum, mut moduli) = (Estimate::exact(0.0), 0.0);
        let mut terms = 0;
        for one in known {
            let Some(derivative) = one.derivatives.of(&name) else {
                continue;
            };
            // Compute ln(x'/x) of each number x, which changes to x' in the other unit, and multiply it by the derivative.
            let [from, to] = scenes.each_mut().map(|scene| {
                number_at(scene, &one.parameter)
                    .copied()
                    .context("no number")
            });
            let change = (to? / from?).ln();
            sum = Estimate::new(
                sum.value + derivative.value * change,
                sum.error + derivative.error * change.abs(),
            );
            moduli += (derivative.value * change).abs();
            terms += 1;
        }
        if terms > 0 {
            let factor = factors
                .get(&name)
                .with_context(|| format!("{name} has no unit"))?;
            let expected = factor.ln();
            sums.push(Comparison {
                quantity: name,
                values: [sum.value, expected],
                deviation: (sum.value - expected).abs(),
                allowed: sum.error + SUM_ROUNDING_TOLERANCE * moduli,
            });
        }
    }
    Ok(sums)
}
