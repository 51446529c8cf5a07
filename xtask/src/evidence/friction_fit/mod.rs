//! Do the intervals of moduli from friction hold?
//!
//! Friction is computed with the material of each case, gets random errors, and is fitted from moduli that are off by a random
//! factor each.

use std::path::Path;

use anyhow::{Context, Result};
use measurements::Finding;
use measurements::friction::FrictionPoint;
use serde::{Deserialize, Serialize};
use toml::Value;
use viscofriction::friction_fit::{FrictionFitOptions, fit_friction};
use viscofriction::scene::{Method, Model, Scene};

use super::request::{Request, no_file, number_at};
use super::{Report, Share};
use crate::random::Random;
use crate::table::Table;
use crate::tasks::in_parallel;

/// Relative error of the friction on the half space before random errors are added. Chosen: it is far below the random
/// errors, which are of the order of per cents.
const TRUTH_ERROR: f64 = 1e-3;
/// Relative error of the friction in the one-dimensional model before random errors are added. Chosen: it is negligible, and
/// costs little in this model.
const TRUTH_ERROR_ON_LINE: f64 = 1e-9;
/// Largest |x| of the factor 10^x by which the moduli of a start deviate from the true ones. Chosen: a factor of three, as from a
/// data sheet.
const START_DECADES: f64 = 0.5;
/// Smallest and largest percentage of the experiments in which an interval that claims 95 % may hold. Chosen: the number of
/// experiments scatters the percentage, and 95 % hold only for models that are linear in their parameters.
const ALLOWED_COVERAGE: [f64; 2] = [93.0, 97.0];

/// Contents of `cases.toml`.
#[derive(Deserialize)]
struct Cases {
    /// One entry for each material and kind of errors.
    case: Vec<Case>,
}

/// A material behind many experiments.
#[derive(Deserialize)]
struct Case {
    /// Name of the case in the table.
    name: String,
    /// Number of experiments of a full run.
    experiments: usize,
    /// Number of experiments of a quick run; 0 leaves the case out.
    quick: usize,
    /// Lowest and highest speed, \[m/s].
    speeds: [f64; 2],
    /// Number of speeds, evenly spaced in their logarithm.
    points: usize,
    /// Ratio of the standard error of a point to its friction.
    noise: f64,
    /// Whether the fit is given the standard errors; otherwise it estimates them from the residuals.
    is_known: bool,
    /// The scene with the true material; its speed is replaced.
    scene: Scene,
}

/// How often the intervals of a quantity hold; percentages of all experiments.
#[derive(Debug, Clone, Serialize)]
struct Row {
    case: String,
    experiments: usize,
    quantity: String,
    /// The modulus or the viscosity with which friction was computed, in SI.
    truth: f64,
    /// Percentage of the experiments whose interval contains `truth`.
    holds_percent: f64,
    /// Binomial standard deviation of `holds_percent`.
    holds_percent_error: f64,
    /// Experiments in which at least one end of the interval is missing, because the points do not bound the quantity.
    open_percent: f64,
    /// Experiments without a fit, which count as intervals that do not hold.
    failed: usize,
}

/// Fits the experiments of all cases; a quick run takes fewer, of the cheap cases.
pub(super) fn report(quick: bool) -> Result<Report> {
    let Cases { mut case } = toml::from_str(include_str!("cases.toml"))?;
    if quick {
        case.retain(|case| case.quick > 0);
        case.iter_mut()
            .for_each(|case| case.experiments = case.quick);
    }
    let by_case = case.iter().map(Case::rows).collect::<Result<Vec<_>>>()?;
    let rows = by_case.concat();
    let Share { held, all } = rows.iter().map(Row::is_as_asked).collect();
    let table = Table::new("friction_fit", &rows)?;
    let columns =
        "case experiments quantity truth holds_percent holds_percent_error open_percent failed";
    let summary = format!(
        "{}\n{held} of {all} intervals hold in {} to {} %, within two standard errors of that",
        table.markdown(columns)?,
        ALLOWED_COVERAGE[0],
        ALLOWED_COVERAGE[1]
    );
    Ok(Report {
        name: "friction_fit",
        tables: vec![table],
        summary,
        ..Report::default()
    })
}

impl Row {
    /// Whether the percentage is within [`ALLOWED_COVERAGE`], up to two of its standard deviations on either side.
    fn is_as_asked(&self) -> bool {
        let margin = 2.0 * self.holds_percent_error;
        (ALLOWED_COVERAGE[0] - margin..=ALLOWED_COVERAGE[1] + margin).contains(&self.holds_percent)
    }
}

impl Case {
    /// Fits all experiments; a row for each quantity that is fitted. Fails where no experiment has a fit.
    fn rows(&self) -> Result<Vec<Row>> {
        let truth = self.truth()?;
        let mut scene = Value::try_from(&self.scene)?;
        let numbers: Vec<u64> = (0..self.experiments as u64).collect();
        let found = in_parallel(self.name.clone(), &numbers, |number| {
            Ok(self.findings(&truth, *number).ok())
        })?;
        let first = found
            .iter()
            .flatten()
            .next()
            .with_context(|| format!("{}: no experiment has a fit", self.name))?;
        let quantities = first.iter().enumerate();
        let row = |(k, finding): (usize, &Finding)| -> Result<Row> {
            let path = format!("material.{}", finding.name);
            let value = number_at(&mut scene, &path)
                .copied()
                .with_context(|| format!("{path} is not in the scene"))?;
            let share = |is: &dyn Fn([Option<f64>; 2]) -> bool| -> Share {
                let is = |found: &Option<Vec<Finding>>| {
                    found.as_ref().is_some_and(|all| is(all[k].interval))
                };
                found.iter().map(is).collect()
            };
            let holds = share(&|[lower, upper]| {
                lower.is_none_or(|lower| lower <= value) && upper.is_none_or(|upper| value <= upper)
            });
            let open = share(&|ends| ends.contains(&None));
            Ok(Row {
                case: self.name.clone(),
                experiments: self.experiments,
                quantity: finding.name.clone(),
                truth: value,
                holds_percent: 100.0 * holds.fraction(),
                holds_percent_error: 100.0 * holds.scatter(holds.fraction()),
                open_percent: 100.0 * open.fraction(),
                failed: found.iter().filter(|found| found.is_none()).count(),
            })
        };
        quantities.map(row).collect()
    }

    /// Friction at all speeds with the true material, to an error far below the random ones that are added later.
    fn truth(&self) -> Result<Vec<FrictionPoint>> {
        let [slowest, fastest] = self.speeds;
        let numbers: Vec<usize> = (0..self.points).collect();
        in_parallel("truth", &numbers, |number| {
            let place = *number as f64 / (self.points - 1) as f64;
            let velocity = slowest * (fastest / slowest).powf(place);
            let mut scene = self.scene.clone();
            scene.load.velocity = Some(velocity);
            let request = match scene.solve.model {
                Some(Model::Line) => {
                    Request::to_error(Model::Line, Method::MdrSteady, TRUTH_ERROR_ON_LINE)
                }
                _ => Request::to_error(Model::HalfSpace, Method::BemSteady, TRUTH_ERROR),
            };
            let answer = request.solve(&scene)?;
            Ok(FrictionPoint {
                velocity,
                friction_coefficient: answer.requested_quantity().value,
                ..FrictionPoint::default()
            })
        })
    }

    /// What the fit finds in the experiment of this number: friction gets normally distributed errors, and moduli start from
    /// wrong values, both from a generator of this seed.
    fn findings(&self, truth: &[FrictionPoint], number: u64) -> Result<Vec<Finding>> {
        // Draw the errors of each experiment with its own seed; neighbouring seeds give numbers that have nothing in common.
        let mut random = Random::new(number);
        let points: Vec<FrictionPoint> = truth
            .iter()
            .map(|point| {
                let error = self.noise * point.friction_coefficient;
                FrictionPoint {
                    friction_coefficient: point.friction_coefficient + error * random.normal(),
                    standard_error: self.is_known.then_some(error),
                    ..*point
                }
            })
            .collect();
        let mut scene = self.scene.clone();
        let mut material = Value::try_from(&scene.material)?;
        move_moduli(&mut material, &mut random);
        scene.material = material.try_into()?;
        let options = FrictionFitOptions::default();
        let fit = fit_friction(&scene, (Path::new(""), no_file), &points, &options, &|_| ())?;
        Ok(fit.fit.findings)
    }
}

/// Multiplies all positive moduli and viscosities within `value`, a table of a scene, by random factors of up to
/// [`START_DECADES`].
fn move_moduli(value: &mut Value, random: &mut Random) {
    match value {
        Value::Table(table) => {
            for (key, value) in table.iter_mut() {
                let is_moved = key.contains("modulus") || key == "viscosity";
                match value {
                    Value::Float(number) if is_moved && *number > 0.0 => {
                        *number *= random.decades(START_DECADES);
                    }
                    other => move_moduli(other, random),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(|one| move_moduli(one, random)),
        _ => {}
    }
}
