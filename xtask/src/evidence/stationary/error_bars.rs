//! Error bars against the deviation from much finer solutions.

use anyhow::{Context, Result};
use bem_halfspace::steady::steady_refined;
use casebook::superposition;
use indenters::{
    FlatCone, Hyperboloid, PowerProfile, RoundTippedCone, Sphere, Surface, TruncatedParaboloid,
};
use numerics::Estimate;
use serde::Serialize;

use super::Table;
use crate::meter::median;
use crate::scene::{Scene, as_far_as_reached, refined_to};
use crate::tasks::in_turn;

/// Exponents of the power profiles.
const EXPONENTS: [f64; 14] = [
    0.6, 0.7, 0.85, 1.0, 1.2, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 30.0,
];
/// Sizes of tips and flat ends; the depth scale is 1.
const RADII: [f64; 3] = [0.1, 0.3, 1.0];
/// From this exponent on the contact is a narrow crescent, for which narrow elements are no help.
const CRESCENT: f64 = 4.0;
/// Up to the first and from the second exponent on a small error costs a minute or more.
const COSTLY: [f64; 2] = [0.7, 12.0];
/// Relative errors asked for, and those of the references over them.
const ASKED: f64 = 1e-3;
const ASKED_WHERE_COSTLY: f64 = 3e-3;
const FINER: f64 = 0.1;
const FINER_WHERE_COSTLY: f64 = 0.2;
/// Shapes of the elements.
const ASPECTS: [f64; 3] = [0.5, 1.0, 2.0];
/// Bodies that are solved in milliseconds.
const QUICK: [&str; 4] = ["r^1", "r^1.5", "r^2", "hyperboloid, radius 0.3"];
/// What is asked of the bars: the fraction that holds, and how much wider than needed they may be at the median.
const NEEDED_FRACTION: f64 = 0.95;
const WIDEST_MEDIAN: f64 = 30.0;
/// Cases with the largest deviations that are printed even if their bars hold.
const WORST: usize = 8;

/// A body, in a scene whose depth scale F_N/(4ηv) is 1.
struct Case {
    name: String,
    /// p of a power profile.
    exponent: Option<f64>,
    body: Box<dyn Surface>,
}

impl Case {
    fn new(name: impl Into<String>, body: impl Surface + 'static) -> Self {
        Self {
            name: name.into(),
            exponent: None,
            body: Box::new(body),
        }
    }

    fn power(exponent: f64) -> Result<Self> {
        let body = PowerProfile::new(1.0, exponent)?;
        Ok(Self {
            exponent: Some(exponent),
            ..Self::new(format!("r^{exponent}"), body)
        })
    }

    /// r^low/2 + coefficient r^high.
    fn sum(name: &str, low: f64, coefficient: f64, high: f64) -> Self {
        Self::new(name, superposition(&[(0.5, low), (coefficient, high)]))
    }

    /// Power profiles, and bodies whose shape depends on the load.
    fn all() -> Result<Vec<Self>> {
        let powers = EXPONENTS.into_iter().map(Self::power);
        let mut cases = powers.collect::<Result<Vec<_>>>()?;
        cases.extend([
            Self::new("sphere, radius 5", Sphere::new(5.0)?),
            Self::new("sphere, radius 2", Sphere::new(2.0)?),
            Self::sum("r/2 + r²/2", 1.0, 0.5, 2.0),
            Self::sum("r²/2 + 2 r⁶", 2.0, 2.0, 6.0),
        ]);
        for radius in RADII {
            let name = |body: &str| format!("{body}, radius {radius}");
            let round = RoundTippedCone::new(radius, 1.0)?;
            let worn = TruncatedParaboloid::new(radius, 1.0)?;
            cases.extend([
                Self::new(name("cone with round tip"), round),
                Self::new(name("hyperboloid"), Hyperboloid::new(radius, 1.0)?),
                Self::new(name("paraboloid with flat end"), worn),
                Self::new(name("cone with flat end"), FlatCone::new(radius, 1.0)?),
            ]);
        }
        Ok(cases)
    }

    /// A bar for each shape of the elements; a quick run asks for less.
    fn rows(&self, quick: bool) -> Result<Vec<Row>> {
        let is_costly = |p| p <= COSTLY[0] || p >= COSTLY[1];
        let is_costly = self.exponent.is_some_and(is_costly);
        let asked = if quick || is_costly {
            ASKED_WHERE_COSTLY
        } else {
            ASKED
        };
        let finer = if is_costly { FINER_WHERE_COSTLY } else { FINER };
        let is_crescent = self.exponent.is_some_and(|p| p >= CRESCENT);
        let aspect = if is_crescent { 1.0 } else { 0.5 };
        let reference = self.solve(finer * asked, aspect)?;
        let row = |aspect| self.row(asked, aspect, reference);
        ASPECTS.into_iter().map(row).collect()
    }

    fn row(&self, asked: f64, aspect: f64, reference: Estimate) -> Result<Row> {
        let friction = self.solve(asked, aspect)?;
        let deviation = (friction.value - reference.value).abs();
        Ok(Row {
            case: self.name.clone(),
            exponent: self.exponent,
            aspect,
            relative_error_asked: asked,
            friction: friction.value,
            error_bar: friction.error,
            reference_friction: reference.value,
            reference_error: reference.error,
            deviation,
            deviation_over_bar: deviation / friction.error,
            holds: deviation <= friction.error + reference.error,
        })
    }

    fn solve(&self, relative_error: f64, aspect: f64) -> Result<Estimate> {
        let Scene { material, load, .. } = Scene::unit(1.0)?;
        let options = refined_to(relative_error, aspect);
        let reached = as_far_as_reached(steady_refined(&self.body, &material, &load, &options));
        reached.with_context(|| format!("{}, {options:?}", self.name))
    }
}

/// One bar. Friction coefficients belong to F_N/(4ηv) = 1 and bodies of the size 1.
#[derive(Debug, Clone, Serialize)]
struct Row {
    case: String,
    /// Of a power profile.
    exponent: Option<f64>,
    aspect: f64,
    relative_error_asked: f64,
    friction: f64,
    error_bar: f64,
    reference_friction: f64,
    reference_error: f64,
    deviation: f64,
    deviation_over_bar: f64,
    /// Whether the deviation is within the bar and the error of the reference.
    holds: bool,
}

/// Judges the bars of all bodies, or of a few.
pub(super) fn measure(quick: bool) -> Result<(Table, String)> {
    let mut cases = Case::all()?;
    cases.retain(|case| !quick || QUICK.contains(&&*case.name));
    let rows = in_turn("error bars", &cases, |case| case.rows(quick))?.concat();
    Ok((Table::new("error_bars", &rows)?, summary(&rows)?))
}

/// How many bars hold, how wide they are, and the cases that fail or come closest to it.
fn summary(rows: &[Row]) -> Result<String> {
    let held = rows.iter().filter(|row| row.holds).count();
    let fraction = held as f64 / rows.len() as f64;
    let width = 1.0 / median(rows.iter().map(|row| row.deviation_over_bar).collect());
    let verdict = |good: bool| if good { "as asked" } else { "NOT as asked" };
    let mut worst: Vec<&Row> = rows.iter().collect();
    worst.sort_by(|one, other| other.deviation_over_bar.total_cmp(&one.deviation_over_bar));
    worst.truncate(WORST.max(rows.len() - held));
    let columns = "case aspect relative_error_asked friction error_bar deviation \
                   deviation_over_bar holds";
    let table = Table::new("worst", &worst)?.markdown(columns)?;
    Ok(format!(
        "{held} of {} error bars hold, {:.1} %: {}\nmedian of bar/deviation {width:.1}: {}\n{table}",
        rows.len(),
        100.0 * fraction,
        verdict(fraction >= NEEDED_FRACTION),
        verdict(width <= WIDEST_MEDIAN)
    ))
}
