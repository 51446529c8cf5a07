//! Do the intervals of moduli and shear strengths from friction hold?
//!
//! Friction is computed with the scene of each case, gets random errors, and is fitted from parameters that are off by a random
//! factor each.

use std::path::Path;

use anyhow::{Context, Result};
use measurements::Finding;
use measurements::friction::FrictionPoint;
use serde::{Deserialize, Serialize};
use toml::Value;
use viscofriction::friction_fit::{Free, FrictionFitOptions, fit_friction};
use viscofriction::scene::{Accuracy, Method, Model, Scene};

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
/// Number of elements along the contact of scenes with shear before random errors are added. Chosen: the contact area then has an
/// error of 0.1 % in plane strain, far below the random errors.
const TRUTH_ELEMENTS_WITH_SHEAR: usize = 2048;
/// Largest |x| of the factor 10^x by which the parameters of a start deviate from the true ones. Chosen: a factor of three, as from
/// a data sheet.
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
    /// Temperatures at which every speed is measured, \[°C]; none for the temperature of the material.
    #[serde(default)]
    temperatures: Vec<f64>,
    /// The parameters that are sought; empty for those that the fit chooses by itself.
    #[serde(default)]
    free: Vec<Free>,
    /// The scene with the true material and interface; its speed is replaced.
    scene: Scene,
}

/// How often the intervals of a quantity hold; percentages of all experiments.
#[derive(Debug, Clone, Serialize)]
struct Row {
    case: String,
    experiments: usize,
    quantity: String,
    /// The number with which friction was computed, in SI.
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
            let path = match finding.name.split_once('.') {
                Some(("interface", _)) => finding.name.clone(),
                _ => format!("material.{}", finding.name),
            };
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

    /// Friction at all speeds and temperatures with the true scene, to an error far below the random ones that are added later.
    fn truth(&self) -> Result<Vec<FrictionPoint>> {
        let [slowest, fastest] = self.speeds;
        let temperatures = if self.temperatures.is_empty() {
            vec![None]
        } else {
            self.temperatures.iter().copied().map(Some).collect()
        };
        let speed = |number: usize| {
            let place = number as f64 / (self.points - 1) as f64;
            slowest * (fastest / slowest).powf(place)
        };
        let points: Vec<FrictionPoint> = temperatures
            .into_iter()
            .flat_map(|temperature| {
                (0..self.points).map(move |number| FrictionPoint {
                    velocity: speed(number),
                    temperature,
                    ..FrictionPoint::default()
                })
            })
            .collect();
        in_parallel("truth", &points, |point| {
            let friction_coefficient = self.friction(point)?;
            Ok(FrictionPoint {
                friction_coefficient,
                ..*point
            })
        })
    }

    /// Friction with the true scene at the speed and the temperature of a point: hysteresis and area at the speed reduced to the
    /// reference temperature of the material, shear at the speed itself.
    fn friction(&self, point: &FrictionPoint) -> Result<f64> {
        let mut scene = self.scene.clone();
        let shift = scene.material.shift().cloned();
        let decades = match (shift, point.temperature) {
            (Some(shift), Some(temperature)) => shift.log10_factor(temperature)?,
            _ => 0.0,
        };
        scene.load.velocity = Some(point.velocity * 10_f64.powf(decades));
        let interface = scene.interface.take();
        let request = match (scene.solve.model, &interface) {
            (Some(Model::Line), _) => {
                Request::to_error(Model::Line, Method::MdrSteady, TRUTH_ERROR_ON_LINE)
            }
            (_, None) => Request::to_error(Model::HalfSpace, Method::BemSteady, TRUTH_ERROR),
            (_, Some(_)) => {
                let accuracy = Accuracy::Elements(TRUTH_ELEMENTS_WITH_SHEAR);
                Request::new(Model::HalfSpace, Method::BemSteady, accuracy)
            }
        };
        let answer = request.solve(&scene)?;
        let shear = match (interface, answer.contact_area) {
            (Some(interface), Some(area)) => {
                let law = interface.shear_strength()?;
                law.at(point.velocity, point.temperature)? * area.value / answer.normal_force.value
            }
            (Some(_), None) => anyhow::bail!("{}: no contact area", self.name),
            (None, _) => 0.0,
        };
        Ok(answer.requested_quantity().value + shear)
    }

    /// What the fit finds in the experiment of this number: friction gets normally distributed errors, and parameters start from
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
        if self.scene.interface.is_none() || self.free.contains(&Free::Moduli) {
            let mut material = Value::try_from(&scene.material)?;
            move_numbers(&mut material, &mut random, &|key| {
                key.contains("modulus") || key == "viscosity"
            });
            scene.material = material.try_into()?;
        }
        if let Some(interface) = &mut scene.interface {
            let mut moved = Value::try_from(&*interface)?;
            move_numbers(&mut moved, &mut random, &|key| {
                key != "reference_temperature"
            });
            *interface = moved.try_into()?;
        }
        let options = FrictionFitOptions {
            free: self.free.clone(),
            ..FrictionFitOptions::default()
        };
        let fit = fit_friction(&scene, (Path::new(""), no_file), &points, &options, &|_| ())?;
        Ok(fit.fit.findings)
    }
}

/// Multiplies all positive numbers within `value`, a table of a scene, whose keys are chosen by `is_moved`, by random factors of up
/// to [`START_DECADES`].
fn move_numbers(value: &mut Value, random: &mut Random, is_moved: &dyn Fn(&str) -> bool) {
    match value {
        Value::Table(table) => {
            for (key, value) in table.iter_mut() {
                match value {
                    Value::Float(number) if is_moved(key) && *number > 0.0 => {
                        *number *= random.decades(START_DECADES);
                    }
                    other => move_numbers(other, random, is_moved),
                }
            }
        }
        Value::Array(list) => list
            .iter_mut()
            .for_each(|one| move_numbers(one, random, is_moved)),
        _ => {}
    }
}
