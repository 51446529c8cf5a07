//! Uncertainty budget of an answer: standard uncertainties to first order, after the Guide to the expression of uncertainty
//! in measurement (JCGM 100:2008).
//!
//! ```text
//! u² = a²/3 + q² gᵀ C g + Σ (q d ln q/d ln θ · u_θ)²
//! ```
//! with the error a of the computation, taken as the half width of a uniform distribution. C is the covariance of the moduli,
//! g the derivatives by their logarithms, and u_θ the relative uncertainty of a number of the scene.

use numerics::Estimate;
use serde::ser::{Serialize, SerializeMap as _, Serializer};

use super::Sensitivity;
use super::parameters::Number;
use crate::scene::{MaterialTable, Scene};
use crate::solve::answer::Answer;

/// Standard uncertainties of the quantities of an answer, each in the unit of its quantity; `None` if not known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Uncertainties {
    /// Standard uncertainty of the friction coefficient.
    pub friction_coefficient: Option<f64>,
    /// Standard uncertainty of the normal force, \[N] or \[N/m]; `None` if the force is given.
    pub normal_force: Option<f64>,
    /// Standard uncertainty of the indentation depth, \[m]; `None` if the depth is given.
    pub indentation_depth: Option<f64>,
    /// Standard uncertainty of the contact area, \[m²] or \[m].
    pub contact_area: Option<f64>,
}

/// A source of uncertainty.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Source {
    /// The error estimate of the computation.
    Numerics,
    /// The covariance of the moduli.
    Material,
    /// A number of the scene, by its path.
    Number(String),
}

/// The uncertainties of an answer by source; empty if nothing is uncertain.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Budget {
    /// Contribution of each source.
    pub entries: Vec<(Source, Uncertainties)>,
}

/// The budget of an answer from its derivatives, in the order of the numbers.
pub(super) fn budget(
    material: &MaterialTable,
    scene: &Scene,
    numbers: &[Number],
    sensitivity: &[Sensitivity],
    answer: &Answer,
) -> Budget {
    let quantities = Quantities::of(answer);
    let mut entries = Vec::new();
    if let Some(covariance) = material.covariance() {
        let paths = modulus_paths(material, covariance.relative.len());
        let of_material = quantities.uncertain(|nth| {
            let derivative = |path: &String| {
                let one = sensitivity.iter().find(|one| one.parameter == *path);
                one.and_then(|one| one.named()[nth].1)
            };
            let known: Vec<Option<Estimate>> = paths.iter().map(derivative).collect();
            // A modulus of 0 has no logarithmic derivative and contributes nothing.
            let value = |known: &Option<Estimate>| known.map_or(0.0, |known| known.value);
            let derivatives: Vec<f64> = known.iter().map(value).collect();
            let is_known = known.iter().any(Option::is_some);
            is_known.then(|| covariance.uncertainty(&derivatives))
        });
        entries.push((Source::Material, of_material));
    }
    for (number, one) in numbers.iter().zip(sensitivity) {
        let path = number.path();
        if let Some(given) = scene.uncertainty.get(&path) {
            let relative = number.relative(*given);
            let of_number = quantities.uncertain(|nth| {
                let derivative = one.named()[nth].1?;
                Some((derivative.value * relative).abs())
            });
            entries.push((Source::Number(path), of_number));
        }
    }
    let mut budget = Budget { entries };
    if !budget.entries.is_empty() {
        // Without derivatives the error of the computation alone is not a budget.
        let mut bars = [None; 4];
        for ((bar, known), (_, sum)) in bars
            .iter_mut()
            .zip(quantities.0)
            .zip(budget.total().named())
        {
            *bar = known.and_then(|known| sum.map(|_| known.error / 3.0_f64.sqrt()));
        }
        let numerics = (Source::Numerics, Uncertainties::from(bars));
        budget.entries.insert(0, numerics);
    }
    budget
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

/// The computed quantities of an answer, in the order of [`Sensitivity::named`].
struct Quantities([Option<Estimate>; 4]);

impl Quantities {
    fn of(answer: &Answer) -> Self {
        // An error of 0 marks a given quantity.
        let found = |known: &Estimate| known.error > 0.0;
        Self([
            answer.friction_coefficient,
            Some(answer.normal_force).filter(found),
            answer.indentation_depth.filter(found),
            answer.contact_area,
        ])
    }

    /// Absolute uncertainties from the relative uncertainty of each quantity.
    fn uncertain(&self, relative: impl Fn(usize) -> Option<f64>) -> Uncertainties {
        let mut all = [None; 4];
        for (nth, (one, known)) in all.iter_mut().zip(self.0).enumerate() {
            *one = known.and_then(|known| Some(relative(nth)? * known.value.abs()));
        }
        Uncertainties::from(all)
    }
}

impl From<[Option<f64>; 4]> for Uncertainties {
    fn from(all: [Option<f64>; 4]) -> Self {
        let [
            friction_coefficient,
            normal_force,
            indentation_depth,
            contact_area,
        ] = all;
        Self {
            friction_coefficient,
            normal_force,
            indentation_depth,
            contact_area,
        }
    }
}

impl Uncertainties {
    /// The uncertainties by the names of their quantities.
    pub const fn named(&self) -> [(&'static str, Option<f64>); 4] {
        [
            ("friction_coefficient", self.friction_coefficient),
            ("normal_force", self.normal_force),
            ("indentation_depth", self.indentation_depth),
            ("contact_area", self.contact_area),
        ]
    }

    /// Uncertainty of the quantity with a given name; `None` if it is not known.
    pub fn of(&self, quantity: &str) -> Option<f64> {
        let mut named = self.named().into_iter();
        named.find(|(name, _)| *name == quantity)?.1
    }
}

impl Budget {
    /// Contribution of the covariance of the moduli; all `None` without a covariance.
    pub fn material(&self) -> Uncertainties {
        let mut entries = self.entries.iter();
        let of_material = entries.find(|(source, _)| *source == Source::Material);
        of_material.map_or_else(Uncertainties::default, |(_, known)| *known)
    }

    /// Root of the sum of squares over all sources; all `None` without entries.
    pub fn total(&self) -> Uncertainties {
        let mut sums = [None; 4];
        for (_, known) in &self.entries {
            for (sum, (_, known)) in sums.iter_mut().zip(known.named()) {
                if let Some(known) = known {
                    *sum = Some(sum.unwrap_or(0.0_f64).hypot(known));
                }
            }
        }
        Uncertainties::from(sums)
    }
}

impl Source {
    /// Name in a table; for a number its path.
    pub fn name(&self) -> &str {
        match self {
            Self::Numerics => "numerics",
            Self::Material => "material",
            Self::Number(path) => path,
        }
    }
}

/// Serializes a list with one entry per source and the total as the last.
impl Serialize for Budget {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let entries = self.entries.iter();
        let entries = entries.map(|(source, known)| Entry(source.name(), *known));
        serializer.collect_seq(entries.chain([Entry("total", self.total())]))
    }
}

/// One line of the budget in JSON: the source and its contributions.
struct Entry<'a>(&'a str, Uncertainties);

impl Serialize for Entry<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("source", self.0)?;
        for (name, known) in self.1.named() {
            if let Some(known) = known {
                map.serialize_entry(name, &known)?;
            }
        }
        map.end()
    }
}
