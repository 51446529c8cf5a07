//! Friction of the three-element solid from the soft elastic limit through the viscous plateau to the stiff one, and
//! where in it the paper's viscous law holds.

mod border;
mod pictures;
mod sliding;

use anyhow::Result;
use friction_analytic::scaling_factor;
use serde::Serialize;

use super::{Report, Table};
use crate::tasks::in_parallel;
use sliding::Sliding;

/// Exponents of the profiles: cone and paraboloid, in this order in every table.
const EXPONENTS: [f64; 2] = [1.0, 2.0];

/// Values from 10^first to 10^last, evenly spaced in the logarithm.
#[derive(Debug, Clone, Copy)]
struct Decades {
    first: i32,
    last: i32,
    per_decade: i32,
}

const fn decades(first: i32, last: i32, per_decade: i32) -> Decades {
    Decades {
        first,
        last,
        per_decade,
    }
}

impl Decades {
    fn values(self) -> impl Iterator<Item = f64> {
        (self.first * self.per_decade..=self.last * self.per_decade)
            .map(move |step| 10_f64.powf(f64::from(step) / f64::from(self.per_decade)))
    }
}

/// What is computed; errors are relative.
#[derive(Debug, Clone, Copy)]
struct Extent {
    curve_ratios: &'static [f64],
    curve_speeds: Decades,
    curve_error: f64,
    map_ratios: Decades,
    map_speeds: Decades,
    map_error: f64,
}

const FULL: Extent = Extent {
    curve_ratios: &[1e-6, 1e-4, 1e-2],
    curve_speeds: decades(-9, 3, 5),
    curve_error: 3e-3,
    map_ratios: decades(-6, 0, 2),
    map_speeds: decades(-8, 2, 4),
    map_error: 1e-2,
};

const QUICK: Extent = Extent {
    curve_ratios: &[1e-4],
    curve_speeds: decades(-7, 3, 1),
    curve_error: 2e-2,
    map_ratios: decades(-3, -1, 1),
    map_speeds: decades(-4, 1, 1),
    map_error: 3e-2,
};

/// Friction at one speed, in units of the mean slope d/a; errors are absolute.
#[derive(Debug, Clone, Serialize)]
struct Point {
    exponent: f64,
    /// γ = G₁/G₂.
    stiffness_ratio: f64,
    /// vτ/a.
    speed: f64,
    /// F_N/(G₂ a d).
    normal_force: f64,
    line: f64,
    line_error: f64,
    half_space: f64,
    half_space_error: f64,
    /// s(p, vτ/a, γ), half space over line.
    ratio: f64,
    ratio_error: f64,
}

/// Friction and what the viscous law of the same loss modulus predicts of it.
#[derive(Debug, Clone, Serialize)]
struct Prediction {
    exponent: f64,
    stiffness_ratio: f64,
    speed: f64,
    loss_tangent: f64,
    line: f64,
    /// By (12) and (16).
    predicted_line: f64,
    half_space: f64,
    half_space_error: f64,
    /// s_p times that of the line.
    predicted_half_space: f64,
}

/// Computes curves, map and border; a quick run takes fewer speeds and stiffness ratios, and wider error bars.
pub(super) fn report(quick: bool) -> Result<Report> {
    let extent = if quick { QUICK } else { FULL };
    let problems = problems(extent.curve_ratios.iter().copied(), extent.curve_speeds);
    let curves: Result<Vec<Point>> = in_parallel("friction over speed", &problems, |sliding| {
        Point::of(*sliding, extent.curve_error)
    });
    let problems = self::problems(extent.map_ratios.values(), extent.map_speeds);
    let map: Result<Vec<Prediction>> = in_parallel("viscous law", &problems, |sliding| {
        Prediction::of(*sliding, extent.map_error)
    });
    let (curves, map) = (curves?, map?);
    let borders = border::find(&map, extent.map_error)?;
    let border = Table::new("validity_border", &borders)?;
    Ok(Report {
        name: "speed_range",
        summary: border.markdown(border::COLUMNS)?,
        tables: vec![
            Table::new("friction_over_speed", &curves)?,
            Table::new("validity", &map)?,
            border,
        ],
        pictures: vec![
            ("friction_over_speed", pictures::friction(&curves, &extent)),
            ("ratio_over_speed", pictures::ratio(&curves, &extent)?),
            ("validity", pictures::validity(&map, &borders, &extent)?),
        ],
        failure: None,
    })
}

/// Speed by speed for each stiffness ratio of each profile.
fn problems(ratios: impl Iterator<Item = f64>, speeds: Decades) -> Vec<Sliding> {
    let ratios: Vec<f64> = ratios.collect();
    let mut problems = Vec::new();
    for exponent in EXPONENTS {
        for &stiffness_ratio in &ratios {
            problems.extend(speeds.values().map(|speed| Sliding {
                exponent,
                stiffness_ratio,
                speed,
            }));
        }
    }
    problems
}

impl Point {
    fn of(sliding: Sliding, relative_error: f64) -> Result<Self> {
        let (line, normal_force) = sliding.line()?;
        let half_space = sliding.half_space(normal_force, relative_error)?;
        let ratio = half_space.value / line.value;
        Ok(Self {
            exponent: sliding.exponent,
            stiffness_ratio: sliding.stiffness_ratio,
            speed: sliding.speed,
            normal_force,
            line: line.value,
            line_error: line.error,
            half_space: half_space.value,
            half_space_error: half_space.error,
            ratio,
            ratio_error: (half_space.error + ratio * line.error) / line.value,
        })
    }
}

impl Prediction {
    fn of(sliding: Sliding, relative_error: f64) -> Result<Self> {
        let point = Point::of(sliding, relative_error)?;
        let predicted_line = sliding.viscous_law(point.normal_force)?;
        Ok(Self {
            exponent: point.exponent,
            stiffness_ratio: point.stiffness_ratio,
            speed: point.speed,
            loss_tangent: sliding.loss_tangent()?,
            line: point.line,
            predicted_line,
            half_space: point.half_space,
            half_space_error: point.half_space_error,
            predicted_half_space: plateau(point.exponent)? * predicted_line,
        })
    }

    const fn sliding(&self) -> Sliding {
        Sliding {
            exponent: self.exponent,
            stiffness_ratio: self.stiffness_ratio,
            speed: self.speed,
        }
    }

    /// |prediction/friction − 1|.
    fn deviation(&self, model: Model) -> f64 {
        let [friction, predicted] = self.pair(model);
        (predicted / friction - 1.0).abs()
    }

    /// Friction and its prediction.
    const fn pair(&self, model: Model) -> [f64; 2] {
        match model {
            Model::Line => [self.line, self.predicted_line],
            Model::HalfSpace => [self.half_space, self.predicted_half_space],
        }
    }
}

/// Which friction is predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Model {
    Line,
    HalfSpace,
}

impl Model {
    const BOTH: [Self; 2] = [Self::Line, Self::HalfSpace];

    const fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::HalfSpace => "half space",
        }
    }
}

/// s_p, the plateau between 1/2 and 1.
fn plateau(exponent: f64) -> Result<f64> {
    Ok(scaling_factor(exponent)?.value)
}
