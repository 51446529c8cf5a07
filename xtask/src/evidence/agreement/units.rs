//! A scene whose lengths, stresses and times are multiplied by powers of two: the same scene in other units.
//!
//! The units of the numbers of a scene are those of its schema. `units.csv` holds the powers of length, stress and time of the
//! numbers of answers, and the power of the extent: of an area, or of a length of a body that is infinite across.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use serde::Deserialize;
use toml::Value;
use viscofriction::scene::Indenter;

use crate::evidence::sample::Case;
use crate::evidence::unit::Unit;

/// A row of `units.csv`: a quantity of answers and its unit.
#[derive(Deserialize)]
struct Row {
    /// Name of the quantity in answers.
    quantity: String,
    #[serde(flatten)]
    unit: Unit,
}

/// Powers of two by which lengths, stresses and times are multiplied; they change no mantissa of f64.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Powers {
    /// All lengths are multiplied by 2 to this power.
    pub(super) length: i32,
    /// All moduli and pressures are multiplied by 2 to this power.
    pub(super) stress: i32,
    /// All times are multiplied by 2 to this power.
    pub(super) time: i32,
}

/// Factor by which a number of a scene or an answer is multiplied, by its name.
pub(super) type Factors = BTreeMap<String, f64>;

impl Powers {
    /// Factors of all numbers of scenes and answers. `is_per_length`: whether the body is infinite across the motion, so that
    /// forces are per length.
    pub(super) fn factors(self, is_per_length: bool) -> Result<Factors> {
        let extent = if is_per_length { 1 } else { 2 };
        let mut units = BTreeMap::new();
        // Collect the units of all keys but coefficients, whose unit depends on the exponent in the same table.
        for (key, unit) in viscofriction::scene::units() {
            if let Some(unit) = unit {
                units.insert(key.to_owned(), Unit::parse(unit)?);
            }
        }
        let answers = csv::Reader::from_reader(include_bytes!("units.csv").as_slice());
        for row in answers.into_deserialize() {
            let Row { quantity, unit } = row?;
            units.insert(quantity, unit);
        }
        let factor = |unit: Unit| {
            let length = (unit.length + unit.extent * extent) * self.length;
            let power = length + unit.stress * self.stress + unit.time * self.time;
            2.0_f64.powi(power)
        };
        let factors = units.into_iter();
        Ok(factors.map(|(key, unit)| (key, factor(unit))).collect())
    }

    /// Multiplies every number of the scene and of its files; fails where one has no unit.
    pub(super) fn apply(self, case: &mut Case) -> Result<()> {
        let is_per_length = matches!(case.scene.indenter, Indenter::Cylinder { .. });
        let factors = self.factors(is_per_length)?;
        let mut scene = Value::try_from(&case.scene)?;
        self.scale(&mut scene, "scene", &factors)?;
        case.scene = scene.try_into()?;
        if let Some(material) = &mut case.material {
            let mut value = Value::try_from(&*material)?;
            self.scale(&mut value, "material", &factors)?;
            *material = value.try_into()?;
        }
        let length = 2.0_f64.powi(self.length);
        if let Some(lengths) = &mut case.lengths {
            lengths.scale(length);
        }
        case.contact *= length;
        Ok(())
    }

    /// Multiplies all numbers in `value`, which stands at `key` of its table; tables and lists recursively.
    fn scale(self, value: &mut Value, key: &str, factors: &Factors) -> Result<()> {
        match value {
            Value::Float(number) => {
                let factor = factors.get(key);
                *number *= factor.with_context(|| format!("{key} has no unit"))?;
            }
            Value::Array(items) => {
                for item in items {
                    self.scale(item, key, factors)?;
                }
            }
            Value::Table(table) => {
                let mut factors = factors.clone();
                let [length, time] = [self.length, self.time].map(|power| 2.0_f64.powi(power));
                if let Some(exponent) = table.get("exponent").and_then(Value::as_float) {
                    // Compute the factor of a coefficient: K of a springpot is proportional to a stress and a power of the time,
                    // c of a profile c r^p to a power of the length.
                    let coefficient = if table.contains_key("time_range") {
                        2.0_f64.powi(self.stress) * time.powf(exponent)
                    } else {
                        length.powf(1.0 - exponent)
                    };
                    factors.insert("coefficient".to_owned(), coefficient);
                }
                let mut items = table.iter_mut();
                items.try_for_each(|(key, item)| self.scale(item, key, &factors))?;
            }
            _ => {}
        }
        Ok(())
    }
}
