//! Uncertainty budget of an answer: standard uncertainties to first order, after the Guide to the expression of uncertainty
//! in measurement (JCGM 100:2008).
//!
//! ```text
//! u² = a²/3 + q² gᵀ C g + (q d ln q/d ln τ_f · u_τ)² + Σ (q d ln q/d ln θ · u_θ)²
//! ```
//! with the error a of the computation, taken as the half width of a uniform distribution. C is the covariance of the moduli,
//! g the derivatives by their logarithms, u_τ the relative uncertainty of a table of shear strengths, and u_θ that of a number of
//! the scene.

use numerics::Estimate;
use serde::{Serialize, Serializer};

use super::Derivatives;
use super::parameters::Number;
use crate::quantity::ByQuantity;
use crate::scene::{MaterialTable, Scene};
use crate::solve::answer::Answer;

/// A source of uncertainty.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Source {
    /// The error estimate of the computation.
    Numerics,
    /// The covariance of the moduli.
    Material,
    /// The standard errors of a table of shear strengths.
    ShearTable,
    /// A number of the scene, by its path.
    Number(String),
}

/// The uncertainties of an answer by source; empty if nothing is uncertain.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Budget {
    /// Each source with its standard uncertainties of the quantities, in the units of these.
    pub entries: Vec<(Source, ByQuantity<f64>)>,
}

/// The budget of an answer from its derivatives, in the order of the numbers. `shear_strength` is the relative uncertainty of a table
/// of shear strengths; 0 if it has none.
pub(super) fn budget(
    material: &MaterialTable,
    scene: &Scene,
    numbers: &[Number],
    derivatives: &Derivatives,
    answer: &Answer,
    shear_strength: f64,
) -> Budget {
    let mut entries = Vec::new();
    if let Some(covariance) = material.covariance() {
        let paths = modulus_paths(material, covariance.relative.len());
        let of_material = uncertainties(answer, |key| {
            let derivative = |path: &String| {
                let one = derivatives
                    .by_numbers
                    .iter()
                    .find(|one| one.parameter == *path);
                one.and_then(|one| one.derivatives.of(key))
            };
            let known: Vec<Option<Estimate>> = paths.iter().map(derivative).collect();
            // A modulus of 0 has no logarithmic derivative and contributes nothing.
            let value = |known: &Option<Estimate>| known.map_or(0.0, |known| known.value);
            let by_moduli: Vec<f64> = known.iter().map(value).collect();
            let is_known = known.iter().any(Option::is_some);
            is_known.then(|| covariance.uncertainty(&by_moduli))
        });
        entries.push((Source::Material, of_material));
    }
    if let Some(by_strength) = &derivatives.by_shear_strength
        && shear_strength > 0.0
    {
        let of_table = uncertainties(answer, |key| {
            Some((by_strength.derivatives.of(key)?.value * shear_strength).abs())
        });
        entries.push((Source::ShearTable, of_table));
    }
    for number in numbers {
        let path = &number.path;
        let by_number = derivatives
            .by_numbers
            .iter()
            .find(|one| one.parameter == *path);
        if let (Some(given), Some(one)) = (scene.uncertainty.get(path), by_number) {
            let relative = number.relative(*given);
            let of_number = uncertainties(answer, |key| {
                Some((one.derivatives.of(key)?.value * relative).abs())
            });
            entries.push((Source::Number(path.clone()), of_number));
        }
    }
    let mut budget = Budget { entries };
    if !budget.entries.is_empty() {
        // Add the error of the computation only to quantities with derivatives, because alone it is no budget.
        let total = budget.total();
        let numerics = ByQuantity::new(|quantity| {
            let known = total.of(quantity.key).and((quantity.of)(answer))?;
            Some(known.error / 3.0_f64.sqrt())
        });
        budget.entries.insert(0, (Source::Numerics, numerics));
    }
    budget
}

/// Absolute uncertainties of the computed quantities of an answer from their relative ones; an error of 0 marks a given quantity.
fn uncertainties(answer: &Answer, relative: impl Fn(&str) -> Option<f64>) -> ByQuantity<f64> {
    ByQuantity::new(|quantity| {
        let known = (quantity.of)(answer).filter(|known| known.error > 0.0)?;
        Some(relative(quantity.key)? * known.value.abs())
    })
}

/// The paths of the moduli in the order of the covariance.
fn modulus_paths(material: &MaterialTable, n: usize) -> Vec<String> {
    let key = material.key();
    let path = |place: usize| match place.checked_sub(1) {
        None => format!("{key}.equilibrium_modulus"),
        Some(branch) => format!("{key}.branches[{branch}].modulus"),
    };
    (0..n).map(path).collect()
}

impl Budget {
    /// Contribution of the covariance of the moduli; empty without a covariance.
    pub fn material(&self) -> ByQuantity<f64> {
        let mut entries = self.entries.iter();
        let of_material = entries.find(|(source, _)| *source == Source::Material);
        of_material.map_or_else(ByQuantity::default, |(_, known)| known.clone())
    }

    /// Root of the sum of squares over all sources; empty without entries.
    pub fn total(&self) -> ByQuantity<f64> {
        ByQuantity::new(|quantity| {
            let entries = self.entries.iter();
            let parts = entries.filter_map(|(_, known)| known.of(quantity.key));
            parts.reduce(f64::hypot)
        })
    }

    /// The name of each source with its uncertainties, and as the last entry the total.
    pub fn rows(&self) -> Vec<(&str, ByQuantity<f64>)> {
        let entries = self.entries.iter();
        let rows = entries.map(|(source, known)| (source.name(), known.clone()));
        rows.chain([("total", self.total())]).collect()
    }
}

impl Source {
    /// Name of the source of uncertainty in a table; for a number of the scene its path.
    pub fn name(&self) -> &str {
        match self {
            Self::Numerics => "numerics",
            Self::Material => "material",
            Self::ShearTable => "interface.table",
            Self::Number(path) => path,
        }
    }
}

/// Serializes the [`rows`](Budget::rows).
impl Serialize for Budget {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let rows = self.rows().into_iter();
        serializer.collect_seq(rows.map(|(source, known)| Row { source, known }))
    }
}

/// One line of the budget in JSON.
#[derive(Serialize)]
struct Row<'a> {
    source: &'a str,
    #[serde(flatten)]
    known: ByQuantity<f64>,
}
