//! Names and units at the head of a table.

use std::f64::consts::TAU;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Frequency,
    Time,
    Storage(Deformation),
    Loss(Deformation),
    Relaxation(Deformation),
    Temperature,
    /// Number of the isotherm.
    Set,
}

/// How the sample was deformed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Deformation {
    /// E
    Tension,
    /// G
    Shear,
}

/// The names that stand for a quantity.
pub(super) fn quantity(name: &str) -> Option<Quantity> {
    use Deformation::{Shear, Tension};
    let name = name
        .replace(['′', '’'], "'")
        .replace(['″', '”', '"'], "''")
        .replace([' ', '_', '-'], "");
    Some(match name.as_str() {
        "f" | "freq" | "frequency" | "Frequency" | "ω" | "omega" | "w" | "angularfrequency" => {
            Quantity::Frequency
        }
        "t" | "time" | "Time" => Quantity::Time,
        "E'" | "Estor" | "Estorage" => Quantity::Storage(Tension),
        "G'" | "Gstor" | "Gstorage" => Quantity::Storage(Shear),
        "E''" | "Eloss" => Quantity::Loss(Tension),
        "G''" | "Gloss" => Quantity::Loss(Shear),
        "E" | "E(t)" | "Erelax" => Quantity::Relaxation(Tension),
        "G" | "G(t)" | "Grelax" => Quantity::Relaxation(Shear),
        "T" | "temperature" | "Temperature" => Quantity::Temperature,
        "set" | "Set" => Quantity::Set,
        _ => return None,
    })
}

/// All names, for messages.
pub(super) const NAMES: &str =
    "f or ω with E' and E'' (or G' and G''), or t with E_relax (or G_relax), and perhaps T and Set";

impl Quantity {
    /// The factor that turns a number in this unit into SI (temperatures stay as they are), when the quantity has the
    /// unit.
    pub(super) fn factor(self, unit: &str) -> Option<f64> {
        let units: &[(&str, f64)] = match self {
            Self::Frequency => &FREQUENCIES,
            Self::Time => &TIMES,
            Self::Storage(_) | Self::Loss(_) | Self::Relaxation(_) => &MODULI,
            Self::Temperature => &TEMPERATURES,
            Self::Set => &[("-", 1.0), ("", 1.0), ("1", 1.0)],
        };
        let known = units.iter().find(|(name, _)| *name == unit);
        known.map(|(_, factor)| *factor)
    }

    /// The units that a quantity has, for messages.
    pub(super) const fn units(self) -> &'static str {
        match self {
            Self::Frequency => "Hz, mHz, kHz or rad/s",
            Self::Time => "s, ms, min or h",
            Self::Storage(_) | Self::Loss(_) | Self::Relaxation(_) => "Pa, kPa, MPa or GPa",
            Self::Temperature => "C or K",
            Self::Set => "-",
        }
    }
}

const FREQUENCIES: [(&str, f64); 5] = [
    ("Hz", TAU),
    ("mHz", 1e-3 * TAU),
    ("kHz", 1e3 * TAU),
    ("rad/s", 1.0),
    ("1/s", 1.0),
];
const TIMES: [(&str, f64); 4] = [("s", 1.0), ("ms", 1e-3), ("min", 60.0), ("h", 3600.0)];
const MODULI: [(&str, f64); 4] = [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)];
const TEMPERATURES: [(&str, f64); 3] = [("C", 1.0), ("°C", 1.0), ("K", 1.0)];
