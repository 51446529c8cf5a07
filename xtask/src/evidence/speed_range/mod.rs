//! Friction of the three-element solid from the soft elastic limit through the viscous plateau to the stiff one, and
//! where in it the paper's viscous law holds.

mod border;
mod pictures;
mod sliding;

use anyhow::Result;
use friction_analytic::scaling_factor;
use serde::{Deserialize, Serialize};
use viscofriction::scene::Model;

use super::{Report, extent};
use crate::table::Table;
use crate::tasks::in_parallel;
use sliding::Sliding;

/// Exponents of the profiles: cone and paraboloid, in this order in every table.
const EXPONENTS: [f64; 2] = [1.0, 2.0];

/// Exponents of the first and the last power of ten, and number of values between and including them, evenly spaced in the
/// logarithm.
#[derive(Debug, Clone, Copy, Deserialize)]
struct Decades(i32, i32, i32);

impl Decades {
    /// The values, ascending.
    fn values(self) -> impl Iterator<Item = f64> {
        let place = move |index: i32| f64::from(self.0) + f64::from(index) * self.step();
        (0..self.2).map(move |index| 10_f64.powf(place(index)))
    }

    /// Decades between neighbouring values.
    fn step(self) -> f64 {
        let Self(first, last, count) = self;
        f64::from(last - first) / f64::from(count - 1)
    }
}

/// What is computed: a table of `extent.toml`. Ratios are γ = G₁/G₂, speeds vτ/a, errors relative ones of the half space.
#[derive(Deserialize)]
struct Extent {
    /// One curve for each ratio.
    curve_ratios: Vec<f64>,
    /// Points of a curve.
    curve_speeds: Decades,
    /// Relative error requested of all curves.
    curve_error: f64,
    /// Rows of the map.
    map_ratios: Decades,
    /// Columns of the map.
    map_speeds: Decades,
    /// Relative error requested of the whole map.
    map_error: f64,
}

/// A contact and its friction.
type Point = (Sliding, Friction);

/// Friction in units of the mean slope d/a; errors are absolute.
#[derive(Debug, Clone, Serialize)]
struct Friction {
    /// F_N/(G₂ a d).
    normal_force: f64,
    /// By the one-dimensional model.
    line: f64,
    line_error: f64,
    /// On the half space, under the force of the line.
    half_space: f64,
    half_space_error: f64,
    /// s(p, vτ/a, γ), half space over line.
    ratio: f64,
    ratio_error: f64,
}

/// A contact, and its friction beside that of the viscous law.
type Prediction = (Sliding, Law);

/// Friction and its prediction by the viscous law with the same loss modulus, both in units of the mean slope d/a.
#[derive(Debug, Clone, Serialize)]
struct Law {
    /// tan δ at ω = v/a.
    loss_tangent: f64,
    /// By the one-dimensional model.
    line: f64,
    /// By Eqs. (12) and (16) of the paper.
    predicted_line: f64,
    half_space: f64,
    half_space_error: f64,
    /// s_p times `predicted_line`.
    predicted_half_space: f64,
}

/// Computes curves, map and border; a quick run takes fewer speeds and stiffness ratios, and wider error bars.
pub(super) fn report(quick: bool) -> Result<Report> {
    let extent: Extent = extent(include_str!("extent.toml"), quick)?;
    let problems = problems(extent.curve_ratios.iter().copied(), extent.curve_speeds);
    let curves = in_parallel("friction over speed", &problems, |&at| {
        Ok((at, Friction::of(at, extent.curve_error)?))
    })?;
    let problems = self::problems(extent.map_ratios.values(), extent.map_speeds);
    let map = in_parallel("viscous law", &problems, |&at| {
        Ok((at, Law::of(at, extent.map_error)?))
    })?;
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
            ("friction_over_speed", pictures::friction(&curves, &extent)?),
            ("ratio_over_speed", pictures::ratio(&curves, &extent)?),
            ("validity", pictures::validity(&map, &borders, &extent)?),
        ],
        failure: None,
    })
}

/// All contacts in the order of the tables: by profile, then stiffness ratio, then speed.
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

impl Friction {
    /// Friction of a contact by both models, that of the half space to `relative_error`.
    fn of(sliding: Sliding, relative_error: f64) -> Result<Self> {
        let (line, normal_force) = sliding.line()?;
        let half_space = sliding.half_space(normal_force, relative_error)?;
        let ratio = half_space.value / line.value;
        Ok(Self {
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

impl Law {
    /// Friction of a contact, that of the half space to `relative_error`, and its prediction.
    fn of(sliding: Sliding, relative_error: f64) -> Result<Self> {
        let friction = Friction::of(sliding, relative_error)?;
        let predicted_line = sliding.viscous_law(friction.normal_force)?;
        Ok(Self {
            loss_tangent: sliding.loss_tangent()?,
            line: friction.line,
            predicted_line,
            half_space: friction.half_space,
            half_space_error: friction.half_space_error,
            predicted_half_space: plateau(sliding.exponent)? * predicted_line,
        })
    }

    /// |prediction/friction − 1| of a model.
    fn deviation(&self, model: Model) -> f64 {
        let [friction, predicted] = self.pair(model);
        (predicted / friction - 1.0).abs()
    }

    /// Friction of a model and its prediction.
    const fn pair(&self, model: Model) -> [f64; 2] {
        match model {
            Model::Line => [self.line, self.predicted_line],
            Model::HalfSpace => [self.half_space, self.predicted_half_space],
        }
    }
}

/// Both models, in the order in which tables and panels show them.
const MODELS: [Model; 2] = [Model::Line, Model::HalfSpace];

/// Factor s_p, the ratio of the friction of the half space to that of the one-dimensional model on a viscous material. For a
/// solid the ratio passes it as a plateau between 1/2 of slow and 1 of fast sliding.
fn plateau(exponent: f64) -> Result<f64> {
    Ok(scaling_factor(exponent)?.value)
}
