//! The physical quantities of an answer.
//!
//! Tables, JSON, CSV, ensemble means, derivatives, uncertainties, pictures and the Python package are loops over [`QUANTITIES`].

use numerics::Estimate;
use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::solve::LINEAR_FRICTION;
use crate::solve::{Answer, AnswerChange, Coarse, relative_change};

/// A physical quantity of an answer.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct Quantity {
    /// Name in JSON, CSV and Python, such as `contact_area`.
    pub key: &'static str,
    /// Symbol; empty if it has none.
    pub symbol: &'static str,
    /// Unit; empty for a number.
    pub unit: Unit,
    /// Value and error in an answer; `None` if the answer does not have the quantity.
    pub of: fn(&Answer) -> Option<Estimate>,
    /// Field of the answer; `None` if the quantity is given, or a product or quotient of others.
    pub(crate) field: Option<fn(&mut Answer) -> &mut Option<Estimate>>,
    /// True if it vanishes on an elastic material.
    pub(crate) is_dissipative: bool,
    /// Value on the coarse grid of an ensemble; `None` if coarse solutions do not have it.
    pub(crate) on_coarse_grid: Option<fn(&Coarse) -> f64>,
    /// True if an ensemble answer states the standard error of its mean and its standard deviation over the random surfaces.
    pub(crate) has_scatter: bool,
    /// Derivative of its logarithm, from which sensitivities and uncertainties follow; `None` if the quantity has no
    /// derivatives.
    pub(crate) log_change: Option<LogChange>,
}

/// Change of the logarithm of a quantity of an answer for a change of the scene, with its error. `None` if the quantity is given.
pub(crate) type LogChange = fn(&Answer, &AnswerChange) -> Option<Estimate>;

/// Change of a quantity that is differentiated by differences of answers only.
const BY_DIFFERENCES: Option<LogChange> = Some(|_, _| None);

/// Unit of a quantity; empty for a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Unit {
    /// Unit for a finite body or one period of a surface.
    pub of_body: &'static str,
    /// Unit for a cylinder, per length along y.
    pub of_cylinder: &'static str,
}

impl Unit {
    /// No unit: a dimensionless number.
    pub(crate) const NUMBER: Self = Self::of_any("");
    /// Unit of depths, and of the edges of a contact.
    const LENGTH: Self = Self::of_any("m");
    /// Unit of pressures and moduli.
    const PRESSURE: Self = Self::of_any("Pa");
    /// Unit of contact areas.
    const AREA: Self = Self {
        of_body: "m²",
        of_cylinder: "m²/m",
    };
    /// Unit of normal and tangential forces.
    const FORCE: Self = Self {
        of_body: "N",
        of_cylinder: "N/m",
    };
    /// Unit of temperature rises.
    const TEMPERATURE_DIFFERENCE: Self = Self::of_any("K");
    /// Unit of works and dissipated energies.
    const ENERGY: Self = Self {
        of_body: "J",
        of_cylinder: "J/m",
    };

    /// A unit that holds for finite bodies and for cylinders.
    const fn of_any(unit: &'static str) -> Self {
        Self {
            of_body: unit,
            of_cylinder: unit,
        }
    }
}

/// A quantity that a function computes from an answer, without symbol, derivatives, scatter, and value on a coarse grid.
const fn computed(key: &'static str, unit: Unit, of: fn(&Answer) -> Option<Estimate>) -> Quantity {
    Quantity {
        key,
        symbol: "",
        unit,
        of,
        field: None,
        is_dissipative: false,
        on_coarse_grid: None,
        has_scatter: false,
        log_change: None,
    }
}

/// A quantity stored in the field of [`Answer`] that has its name; otherwise like [`computed`].
macro_rules! stored {
    ($field:ident, $unit:expr) => {
        Quantity {
            field: Some(|answer| &mut answer.$field),
            ..computed(stringify!($field), $unit, |answer| answer.$field)
        }
    };
}

/// All quantities, in the order of the output.
pub static QUANTITIES: [Quantity; 22] = [
    Quantity {
        symbol: "μ",
        is_dissipative: true,
        on_coarse_grid: Some(Coarse::friction_coefficient),
        has_scatter: true,
        log_change: Some(|answer, change| {
            let hysteresis = change.contact.friction_coefficient;
            let friction = match answer.friction_from_shear {
                None => hysteresis,
                Some(shear) => hysteresis + change.of_log_shear(answer)? * shear.value,
            };
            relative_change(Some(friction), answer.friction_coefficient)
        }),
        ..stored!(friction_coefficient, Unit::NUMBER)
    },
    Quantity {
        is_dissipative: true,
        on_coarse_grid: Some(|coarse| coarse.friction_from_hysteresis),
        log_change: Some(|answer, change| {
            let hysteresis = change.contact.friction_coefficient;
            relative_change(Some(hysteresis), answer.friction_from_hysteresis)
        }),
        ..stored!(friction_from_hysteresis, Unit::NUMBER)
    },
    Quantity {
        on_coarse_grid: Some(|coarse| coarse.friction_from_shear),
        log_change: Some(|answer, change| {
            answer.friction_from_shear?;
            change.of_log_shear(answer)
        }),
        ..stored!(friction_from_shear, Unit::NUMBER)
    },
    Quantity {
        symbol: "F",
        log_change: Some(|answer, change| {
            relative_change(change.contact.normal_force, Some(answer.normal_force))
        }),
        ..computed("normal_force", Unit::FORCE, |answer| {
            Some(answer.normal_force)
        })
    },
    Quantity {
        symbol: "F_t",
        is_dissipative: true,
        ..computed("tangential_force", Unit::FORCE, Answer::tangential_force)
    },
    Quantity {
        symbol: "d",
        on_coarse_grid: Some(|coarse| coarse.mean_depth),
        log_change: Some(|answer, change| {
            relative_change(change.contact.indentation_depth, answer.indentation_depth)
        }),
        ..stored!(indentation_depth, Unit::LENGTH)
    },
    Quantity {
        symbol: "A",
        on_coarse_grid: Some(|coarse| coarse.contact_area),
        log_change: Some(|_, change| change.contact.contact_area),
        ..stored!(contact_area, Unit::AREA)
    },
    stored!(peak_pressure, Unit::PRESSURE),
    computed(
        "mean_contact_pressure",
        Unit::PRESSURE,
        Answer::mean_contact_pressure,
    ),
    Quantity {
        symbol: "p",
        ..stored!(mean_pressure, Unit::PRESSURE)
    },
    Quantity {
        on_coarse_grid: Some(|coarse| coarse.area_fraction),
        has_scatter: true,
        ..stored!(area_fraction, Unit::NUMBER)
    },
    Quantity {
        is_dissipative: true,
        on_coarse_grid: Some(|coarse| coarse.friction_from_hysteresis),
        ..stored!(friction_from_dissipation, Unit::NUMBER)
    },
    Quantity {
        is_dissipative: true,
        ..stored!(peak_friction, Unit::NUMBER)
    },
    Quantity {
        is_dissipative: true,
        ..stored!(dissipated_energy, Unit::ENERGY)
    },
    Quantity {
        is_dissipative: true,
        ..stored!(largest_temperature_rise, Unit::TEMPERATURE_DIFFERENCE)
    },
    Quantity {
        is_dissipative: true,
        log_change: BY_DIFFERENCES,
        ..stored!(mean_temperature_rise, Unit::TEMPERATURE_DIFFERENCE)
    },
    Quantity {
        symbol: "T",
        ..stored!(effective_temperature, Unit::of_any("°C"))
    },
    stored!(temperature_model_spread, Unit::NUMBER),
    Quantity {
        symbol: "ε",
        log_change: BY_DIFFERENCES,
        ..stored!(strain, Unit::NUMBER)
    },
    stored!(storage_factor, Unit::NUMBER),
    stored!(loss_factor, Unit::NUMBER),
    computed(LINEAR_FRICTION, Unit::NUMBER, |answer| {
        answer.linear.as_ref()?.friction_coefficient
    }),
];

impl Quantity {
    /// The quantity with a given key; `None` if there is none.
    pub fn named(key: &str) -> Option<&'static Self> {
        QUANTITIES.iter().find(|quantity| quantity.key == key)
    }

    /// Name in tables, such as "contact area".
    pub fn name(&self) -> String {
        self.key.replace('_', " ")
    }

    /// Name, symbol and unit as at the axis of a picture, such as "contact area A \[m²]"; the unit is that of a finite body.
    pub fn label(&self) -> String {
        self.label_with(self.unit.of_body)
    }

    /// Label with the unit for a cylinder, whose forces, areas and energies are per length.
    pub fn label_of_cylinder(&self) -> String {
        self.label_with(self.unit.of_cylinder)
    }

    fn label_with(&self, unit: &str) -> String {
        let symbol = self.symbol;
        let unit = match unit {
            "" => String::new(),
            unit => format!("[{unit}]"),
        };
        format!("{} {symbol} {unit}", self.name())
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    }

    /// Unit in an answer.
    pub const fn unit_in(&self, answer: &Answer) -> &'static str {
        if answer.is_per_length {
            self.unit.of_cylinder
        } else {
            self.unit.of_body
        }
    }
}

/// The quantities that have derivatives and uncertainties.
pub fn differentiated() -> impl Iterator<Item = &'static Quantity> {
    QUANTITIES
        .iter()
        .filter(|quantity| quantity.log_change.is_some())
}

/// The quantities whose scatter over an ensemble is known.
pub fn scattered() -> impl Iterator<Item = &'static Quantity> {
    QUANTITIES.iter().filter(|quantity| quantity.has_scatter)
}

/// One number for each of some quantities, in the order of [`QUANTITIES`].
#[derive(Debug, Clone, PartialEq)]
pub struct ByQuantity<T>(Vec<(&'static str, T)>);

impl<T> Default for ByQuantity<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T: Copy> ByQuantity<T> {
    /// One number for each quantity for which a function returns `Some`.
    pub(crate) fn new(of: impl Fn(&Quantity) -> Option<T>) -> Self {
        let known = QUANTITIES.iter();
        Self(
            known
                .filter_map(|quantity| Some((quantity.key, of(quantity)?)))
                .collect(),
        )
    }

    /// The number of the quantity with a given key; `None` if it is not known.
    pub fn of(&self, key: &str) -> Option<T> {
        self.iter()
            .find(|(known, _)| *known == key)
            .map(|(_, number)| number)
    }

    /// Keys and numbers.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, T)> {
        self.0.iter().copied()
    }

    /// True if no number is known.
    pub const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl ByQuantity<Estimate> {
    /// The same numbers by other keys.
    pub(crate) fn with_keys(&self, key: impl Fn(&'static str) -> &'static str) -> Self {
        Self(self.iter().map(|(known, one)| (key(known), one)).collect())
    }

    /// Writes each value and its absolute error into a JSON object.
    pub(crate) fn serialize_into<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        self.iter().try_for_each(|(key, known)| {
            map.serialize_entry(key, &known.value)?;
            map.serialize_entry(&format!("{key}_error"), &known.error)
        })
    }
}

/// Each value followed by its absolute error.
impl Serialize for ByQuantity<Estimate> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        self.serialize_into(&mut map)?;
        map.end()
    }
}

impl Serialize for ByQuantity<f64> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}
