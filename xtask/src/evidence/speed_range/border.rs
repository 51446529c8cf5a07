//! Lowest and highest speed at which the friction of the paper's viscous law is right within ten per cent.

use anyhow::{Context, Result};
use numerics::{Estimate, bracketed_root};
use serde::Serialize;
use viscofriction::scene::Model;

use super::sliding::LINE_ERROR;
use super::{Law, MODELS, Prediction, plateau};
use crate::tasks::in_parallel;

/// Largest |prediction/friction − 1| at which the law counts as right. Chosen: friction is hardly ever measured more
/// accurately.
const RIGHT_WITHIN: f64 = 0.1;
/// Step in ln v, with the speed v, of the central difference that gives the slope of the deviation. By the slope an error of the
/// friction becomes one of the speed. Chosen; a rough slope suffices.
const SLOPE_STEP: f64 = 0.02;

/// The range of speeds of one profile and stiffness ratio; without speeds where the law is right at none of the map.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Row {
    pub(super) exponent: f64,
    pub(super) model: Model,
    pub(super) stiffness_ratio: f64,
    /// Lowest speed vτ/a at which the law is right; `None` if it is beyond the map.
    pub(super) lowest_speed: Option<f64>,
    lowest_speed_error: Option<f64>,
    pub(super) highest_speed: Option<f64>,
    highest_speed_error: Option<f64>,
    /// Loss tangent tan δ at ω = v/a, at the lowest and at the highest speed.
    loss_tangent_at_lowest: Option<f64>,
    loss_tangent_at_lowest_error: Option<f64>,
    loss_tangent_at_highest: Option<f64>,
    loss_tangent_at_highest_error: Option<f64>,
    /// Smallest |prediction/friction − 1| on the map.
    smallest_deviation: f64,
    smallest_deviation_error: f64,
}

/// Names of the columns that are printed; the file has all columns.
pub(super) const COLUMNS: &str = "exponent model stiffness_ratio lowest_speed highest_speed \
                                  loss_tangent_at_lowest loss_tangent_at_highest smallest_deviation";

/// The ranges of all profiles and stiffness ratios of the map, of both models. `error` is the relative error of the friction on
/// the half space on the map.
pub(super) fn find(map: &[Prediction], error: f64) -> Result<Vec<Row>> {
    let key = |(at, _): &Prediction| [at.exponent, at.stiffness_ratio].map(f64::to_bits);
    let speeds = || map.chunk_by(|one, other| key(one) == key(other));
    let scans = |model| speeds().map(move |speeds| (model, speeds));
    let scans: Vec<(Model, &[Prediction])> = MODELS.into_iter().flat_map(scans).collect();
    let task = "border of the viscous law";
    let mut rows = in_parallel(task, &scans, |&(model, speeds)| row(model, speeds, error))?;
    rows.sort_by(|one, other| one.exponent.total_cmp(&other.exponent));
    Ok(rows)
}

/// The range of one profile and stiffness ratio, whose points on the map are `speeds`, ascending.
fn row(model: Model, speeds: &[Prediction], error: f64) -> Result<Row> {
    let (first, _) = &speeds[0];
    let deviations = || speeds.iter().map(|(_, law)| law.deviation(model));
    let right = |deviation: f64| deviation <= RIGHT_WITHIN;
    let crossing = |low, high| crossing(model, speeds, [low, high], error);
    // Find the first and the last point where the law is right; the border is between each and its neighbour where it is not.
    let lowest = deviations()
        .position(right)
        .map(|at| crossing(at.checked_sub(1), Some(at)))
        .transpose()?;
    let highest = deviations()
        .rposition(right)
        .map(|at| crossing(Some(at), Some(at + 1)))
        .transpose()?;
    let loss_tangent = |speed: Estimate| -> Result<Estimate> {
        let at = |speed: f64| first.at_speed(speed).loss_tangent();
        let value = at(speed.value)?;
        let error = (at(speed.value + speed.error)? - value).abs();
        Ok(Estimate::new(value, error))
    };
    let [low, high] = [lowest, highest].map(|speed| speed.map(loss_tangent).transpose());
    let parts = |known: Option<Estimate>| known.map(|known| (known.value, known.error)).unzip();
    let (lowest_speed, lowest_speed_error) = parts(lowest);
    let (highest_speed, highest_speed_error) = parts(highest);
    let (loss_tangent_at_lowest, loss_tangent_at_lowest_error) = parts(low?);
    let (loss_tangent_at_highest, loss_tangent_at_highest_error) = parts(high?);
    Ok(Row {
        exponent: first.exponent,
        model,
        stiffness_ratio: first.stiffness_ratio,
        lowest_speed,
        lowest_speed_error,
        highest_speed,
        highest_speed_error,
        loss_tangent_at_lowest,
        loss_tangent_at_lowest_error,
        loss_tangent_at_highest,
        loss_tangent_at_highest_error,
        smallest_deviation: deviations().fold(f64::INFINITY, f64::min),
        smallest_deviation_error: match model {
            Model::Line => LINE_ERROR,
            Model::HalfSpace => error,
        },
    })
}

/// The speed at which the deviation is [`RIGHT_WITHIN`] between the points `low` and `high` of the map; fails where one of them
/// is beyond its ends.
fn crossing(
    model: Model,
    speeds: &[Prediction],
    [low, high]: [Option<usize>; 2],
    error: f64,
) -> Result<Estimate> {
    let ends = low
        .zip(high)
        .and_then(|(low, high)| Some([speeds.get(low)?.clone(), speeds.get(high)?.clone()]))
        .with_context(|| {
            let (first, _) = &speeds[0];
            format!("the viscous law is right up to the edge of the map: {first:?}")
        })?;
    let border = Border { model, ends };
    match model {
        Model::Line => Ok(border.between()?.with_error(LINE_ERROR)),
        Model::HalfSpace => border.of_half_space(error / 3.0),
    }
}

/// Two points, ascending in speed; at one of them the law is right, at the other it is not.
struct Border {
    model: Model,
    ends: [Prediction; 2],
}

/// Where the deviation is [`RIGHT_WITHIN`].
struct Crossing {
    /// vτ/a.
    speed: f64,
    /// Derivative of the deviation by ln v.
    slope: f64,
}

impl Crossing {
    /// The speed with the error that follows from a relative error of the friction.
    fn with_error(&self, relative_error: f64) -> Estimate {
        let error = self.speed * (1.0 + RIGHT_WITHIN) * relative_error / self.slope.abs();
        Estimate::new(self.speed, error)
    }
}

impl Border {
    /// The crossing on the half space. The ratio of half space to line changes slowly with speed: it is interpolated, and then
    /// computed anew to `relative_error` at the speed that follows, twice. The last change is added to the error.
    fn of_half_space(mut self, relative_error: f64) -> Result<Estimate> {
        let Crossing { speed, slope } = self.between()?;
        let mut border = Estimate::exact(speed);
        for _ in 0..2 {
            let sliding = self.ends[0].0.at_speed(border.value);
            let law = Law::of(sliding, relative_error)?;
            let error = law.half_space_error / law.half_space;
            let right = |law: &Law| law.deviation(self.model) <= RIGHT_WITHIN;
            let is_low = right(&law) == right(&self.ends[0].1);
            self.ends[usize::from(!is_low)] = (sliding, law);
            // Add the change of the border to its error, because the slope is that between speeds that are far from each other.
            let speed = self.between()?.speed;
            let next = Crossing { speed, slope }.with_error(error);
            border = Estimate::new(next.value, next.error + (next.value - border.value).abs());
        }
        Ok(border)
    }

    /// The crossing, if friction is that of the line, computed at each speed tried, times the ratio of the two models,
    /// interpolated linearly in ln v between the two points.
    fn between(&self) -> Result<Crossing> {
        let plateau = plateau(self.ends[0].0.exponent)?;
        let [low, high] = self.ends.each_ref().map(|(_, law)| match self.model {
            Model::Line => plateau,
            Model::HalfSpace => law.half_space / law.line,
        });
        let [first, last] = self.ends.each_ref().map(|(at, _)| at.speed);
        let excess = |logarithm: f64| {
            let place = (logarithm - first.ln()) / (last / first).ln();
            let ratio = low + place * (high - low);
            let at = self.ends[0].0.at_speed(logarithm.exp());
            let line = at.line();
            let quotient = line.and_then(|(line, force)| Ok(at.viscous_law(force)? / line.value));
            quotient.map_or(f64::NAN, |quotient| {
                (quotient * plateau / ratio - 1.0).abs() - RIGHT_WITHIN
            })
        };
        let root = bracketed_root(excess, [first.ln(), last.ln()])
            .context("a border between two speeds of the map")?;
        Ok(Crossing {
            speed: root.exp(),
            slope: 0.5 * (excess(root + SLOPE_STEP) - excess(root - SLOPE_STEP)) / SLOPE_STEP,
        })
    }
}
