//! Names and units at the head of a table.

use std::f64::consts::TAU;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Frequency,
    Time,
    Storage,
    Loss,
    Relaxation,
    Temperature,
    /// Number of the isotherm.
    Set,
}

/// All names, for messages.
pub(super) const NAMES: &str =
    "f or ω with E' and E'' (or G' and G''), or t with E_relax (or G_relax), and perhaps T and Set";

impl Quantity {
    /// The quantity that a name stands for; moduli in tension begin with E, and those in shear with G.
    pub(super) fn of(name: &str) -> Option<Self> {
        let name = name
            .replace(['′', '’'], "'")
            .replace(['″', '”', '"'], "''")
            .replace([' ', '_', '-'], "");
        Some(match &*name {
            "f" | "freq" | "frequency" | "Frequency" => Self::Frequency,
            "ω" | "omega" | "w" | "angularfrequency" => Self::Frequency,
            "t" | "time" | "Time" => Self::Time,
            "E'" | "Estor" | "Estorage" | "G'" | "Gstor" | "Gstorage" => Self::Storage,
            "E''" | "Eloss" | "G''" | "Gloss" => Self::Loss,
            "E" | "E(t)" | "Erelax" | "G" | "G(t)" | "Grelax" => Self::Relaxation,
            "T" | "temperature" | "Temperature" => Self::Temperature,
            "set" | "Set" => Self::Set,
            _ => return None,
        })
    }

    /// The usual names, for messages.
    pub(super) const fn usual(self) -> &'static str {
        match self {
            Self::Frequency => "f or ω",
            Self::Time => "t",
            Self::Storage => "E' or G'",
            Self::Loss => "E'' or G''",
            Self::Relaxation => "E_relax or G_relax",
            Self::Temperature => "T",
            Self::Set => "Set",
        }
    }

    /// Units and the factors that turn a number into SI; temperatures stay as they are.
    pub(super) const fn units(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Frequency => &FREQUENCIES,
            Self::Time => &[("s", 1.0), ("ms", 1e-3), ("min", 60.0), ("h", 3600.0)],
            Self::Storage | Self::Loss | Self::Relaxation => &MODULI,
            Self::Temperature => &[("C", 1.0), ("°C", 1.0), ("K", 1.0)],
            Self::Set => &[("-", 1.0), ("", 1.0), ("1", 1.0)],
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
const MODULI: [(&str, f64); 4] = [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)];
