//! Lowest and highest speed at which the viscous law is right within ten per cent.

use anyhow::{Context, Result, bail};
use numerics::{Estimate, bracketed_root};
use serde::Serialize;
use viscofriction::scene::Model;

use super::sliding::LINE_ERROR;
use super::{Law, MODELS, Prediction, plateau};
use crate::tasks::in_parallel;

/// Largest |prediction/friction − 1| that is right.
const ALLOWED: f64 = 0.1;

/// The range of one profile and stiffness ratio; no speeds where the law is right at none of the map.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Row {
    pub(super) exponent: f64,
    pub(super) model: Model,
    pub(super) stiffness_ratio: f64,
    /// vτ/a.
    pub(super) lowest_speed: Option<f64>,
    lowest_speed_error: Option<f64>,
    pub(super) highest_speed: Option<f64>,
    highest_speed_error: Option<f64>,
    /// tan δ at ω = v/a, at both speeds.
    loss_tangent_at_lowest: Option<f64>,
    loss_tangent_at_lowest_error: Option<f64>,
    loss_tangent_at_highest: Option<f64>,
    loss_tangent_at_highest_error: Option<f64>,
    /// Smallest |prediction/friction − 1| on the map.
    smallest_deviation: f64,
    smallest_deviation_error: f64,
}

/// The ranges of all rows of the map; `error` is the relative one that the half space has on them.
pub(super) fn find(map: &[Prediction], error: f64) -> Result<Vec<Row>> {
    let key = |(at, _): &Prediction| [at.exponent, at.stiffness_ratio].map(f64::to_bits);
    let speeds = || map.chunk_by(|one, other| key(one) == key(other));
    let scans = |model| speeds().map(move |speeds| Scan { model, speeds });
    let scans: Vec<Scan> = MODELS.into_iter().flat_map(scans).collect();
    let mut rows = in_parallel("border of the viscous law", &scans, |scan| scan.row(error))?;
    rows.sort_by(|one, other| one.exponent.total_cmp(&other.exponent));
    Ok(rows)
}

/// The speeds of one stiffness ratio.
struct Scan<'a> {
    model: Model,
    speeds: &'a [Prediction],
}

impl Scan<'_> {
    fn row(&self, error: f64) -> Result<Row> {
        let (first, _) = &self.speeds[0];
        let deviations = self.speeds.iter().map(|(_, law)| law.deviation(self.model));
        let right = |deviation: f64| deviation <= ALLOWED;
        let lowest = deviations.clone().position(right);
        let lowest = lowest.map(|at| self.crossing(at.checked_sub(1), at, error));
        let highest = deviations.clone().rposition(right);
        let highest = highest.map(|at| self.crossing(Some(at), at + 1, error));
        let (lowest, highest) = (lowest.transpose()?, highest.transpose()?);
        let loss_tangent = |speed: Estimate| -> Result<Estimate> {
            let at = |speed: f64| first.at_speed(speed).loss_tangent();
            let value = at(speed.value)?;
            let error = (at(speed.value + speed.error)? - value).abs();
            Ok(Estimate::new(value, error))
        };
        let low = lowest.map(loss_tangent).transpose()?;
        let high = highest.map(loss_tangent).transpose()?;
        Ok(Row {
            exponent: first.exponent,
            model: self.model,
            stiffness_ratio: first.stiffness_ratio,
            lowest_speed: lowest.map(|speed| speed.value),
            lowest_speed_error: lowest.map(|speed| speed.error),
            highest_speed: highest.map(|speed| speed.value),
            highest_speed_error: highest.map(|speed| speed.error),
            loss_tangent_at_lowest: low.map(|tangent| tangent.value),
            loss_tangent_at_lowest_error: low.map(|tangent| tangent.error),
            loss_tangent_at_highest: high.map(|tangent| tangent.value),
            loss_tangent_at_highest_error: high.map(|tangent| tangent.error),
            smallest_deviation: deviations.fold(f64::INFINITY, f64::min),
            smallest_deviation_error: match self.model {
                Model::Line => LINE_ERROR,
                Model::HalfSpace => error,
            },
        })
    }

    /// The speed at which the deviation is the one allowed, between two neighbours on the map.
    fn crossing(&self, low: Option<usize>, high: usize, error: f64) -> Result<Estimate> {
        let (Some(low), Some(high)) = (low, self.speeds.get(high)) else {
            let (first, _) = self.speeds[0];
            bail!("the viscous law is right up to the edge of the map: {first:?}");
        };
        let (model, low, high) = (self.model, self.speeds[low].clone(), high.clone());
        let border = Border { model, low, high };
        match self.model {
            Model::Line => Ok(border.between()?.with_error(LINE_ERROR)),
            Model::HalfSpace => border.of_half_space(error / 3.0),
        }
    }
}

/// Two speeds; at one of them the law is right, at the other it is not.
struct Border {
    model: Model,
    low: Prediction,
    high: Prediction,
}

/// Where the deviation is the one allowed.
struct Crossing {
    speed: f64,
    /// Change of the deviation over the logarithm of the speed.
    slope: f64,
}

impl Crossing {
    /// The speed, if friction has a relative error.
    fn with_error(&self, relative_error: f64) -> Estimate {
        Estimate::new(
            self.speed,
            self.speed * (1.0 + ALLOWED) * relative_error / self.slope.abs(),
        )
    }
}

impl Border {
    /// The ratio of half space and line changes slowly: it is interpolated first, and then solved anew at the border that
    /// this gives, twice.
    fn of_half_space(mut self, relative_error: f64) -> Result<Estimate> {
        let Crossing { speed, slope } = self.between()?;
        let mut border = Estimate::exact(speed);
        for _ in 0..2 {
            let sliding = self.low.0.at_speed(border.value);
            let law = Law::of(sliding, relative_error)?;
            let error = law.half_space_error / law.half_space;
            let right = |law: &Law| law.deviation(self.model) <= ALLOWED;
            if right(&law) == right(&self.low.1) {
                self.low = (sliding, law);
            } else {
                self.high = (sliding, law);
            }
            // The slope is that between speeds that are far from each other.
            let speed = self.between()?.speed;
            let next = Crossing { speed, slope }.with_error(error);
            border = Estimate::new(next.value, next.error + (next.value - border.value).abs());
        }
        Ok(border)
    }

    /// The speed at which the deviation is the one allowed, if friction is that of the line, solved anew, times the ratio
    /// of the two models, interpolated.
    fn between(&self) -> Result<Crossing> {
        let plateau = plateau(self.low.0.exponent)?;
        let [low, high] = [&self.low.1, &self.high.1].map(|law| match self.model {
            Model::Line => plateau,
            Model::HalfSpace => law.half_space / law.line,
        });
        let [first, last] = [self.low.0.speed, self.high.0.speed];
        let excess = |logarithm: f64| {
            let place = (logarithm - first.ln()) / (last / first).ln();
            let ratio = low + place * (high - low);
            let at = self.low.0.at_speed(logarithm.exp());
            let quotient = at
                .line()
                .and_then(|(line, force)| Ok(at.viscous_law(force)? / line.value));
            quotient.map_or(f64::NAN, |quotient| {
                (quotient * plateau / ratio - 1.0).abs() - ALLOWED
            })
        };
        let ends = [first.ln(), last.ln()];
        let root = bracketed_root(excess, ends);
        let root = root.context("a border between two speeds of the map")?;
        Ok(Crossing {
            speed: root.exp(),
            slope: 0.5 * (excess(root + STEP) - excess(root - STEP)) / STEP,
        })
    }
}

/// Step of the difference that gives the slope.
const STEP: f64 = 0.02;

/// Columns that are printed.
pub(super) const COLUMNS: &str = "exponent model stiffness_ratio lowest_speed highest_speed \
                                  loss_tangent_at_lowest loss_tangent_at_highest smallest_deviation";
