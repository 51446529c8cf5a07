//! Names and units at the head of a table.

use std::f64::consts::TAU;

use super::Deformation;
use Quantity::{Frequency, Loss, LossFactor, Relaxation, Set, Storage, Temperature, Time};

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Frequency,
    Time,
    Storage,
    Loss,
    LossFactor,
    Relaxation,
    Temperature,
    /// Number of the isotherm.
    Set,
}

/// All names, for messages.
pub(super) const NAMES: &str = "f or ω with two of E', E'' and tan delta (or G' and G''), or t with E_relax (or G_relax), and perhaps T and Set";

/// A name and its unit, as `E'`, `E' (MPa)`, `E' [MPa]` or `E' / MPa` may be divided; without a unit that is empty.
pub(super) fn divided(cell: &str) -> impl Iterator<Item = (&str, &str)> {
    let bracket = cell.strip_suffix([')', ']']);
    let bracket = bracket.and_then(|cell| cell.rsplit_once(['(', '[']));
    let parts = [Some((cell, "")), bracket, cell.split_once('/')];
    parts.into_iter().flatten()
}

const TENSION: Option<Deformation> = Some(Deformation::Tension);
const SHEAR: Option<Deformation> = Some(Deformation::Shear);

/// Names without blanks, points, dashes and underlines.
const KNOWN: [(Quantity, Option<Deformation>, &str); 25] = [
    (Frequency, None, "f freq frequency frequenz ω omega w"),
    (Frequency, None, "angularfrequency angfrequency"),
    (Frequency, None, "kreisfrequenz"),
    (Time, None, "t time zeit"),
    (Storage, None, "storagemodulus speichermodul"),
    (Storage, TENSION, "E' Estor Estorage E'storagemodulus"),
    (Storage, TENSION, "storagemodulusE' storagemodulus(E')"),
    (Storage, SHEAR, "G' Gstor Gstorage G'storagemodulus"),
    (Storage, SHEAR, "storagemodulusG' storagemodulus(G')"),
    (Storage, SHEAR, "shearstoragemodulus"),
    (Storage, SHEAR, "shearmodulus(elasticcomponent)"),
    (Loss, None, "lossmodulus verlustmodul"),
    (Loss, TENSION, "E'' Eloss E''lossmodulus lossmodulusE''"),
    (Loss, TENSION, "lossmodulus(E'')"),
    (Loss, SHEAR, "G'' Gloss G''lossmodulus lossmodulusG''"),
    (Loss, SHEAR, "lossmodulus(G'')"),
    (Loss, SHEAR, "shearlossmodulus"),
    (Loss, SHEAR, "shearmodulus(viscouscomponent)"),
    (LossFactor, None, "tandelta tan(delta) tanδ tan(δ)"),
    (LossFactor, None, "lossfactor dampingfactor verlustfaktor"),
    (Relaxation, TENSION, "E E(t) Erelax"),
    (Relaxation, SHEAR, "G G(t) Grelax"),
    (Set, None, "set"),
    (Temperature, None, "T Ts temp temperature temperatur"),
    (Temperature, None, "sampletemperature"),
];

/// What a name stands for. Capitals count in letters that stand alone: T is a temperature and t a time, and F is a force.
pub(super) fn known(name: &str) -> Option<&'static (Quantity, Option<Deformation>, &'static str)> {
    let name = name
        .replace(['′', '’', '´', '`', '\u{92}'], "'")
        .replace(['″', '”', '"', '\u{94}'], "''")
        .replace([' ', '_', '-', '.'], "");
    let is_same = |word: &str| {
        word == name || (name.chars().count() > 1 && word.to_lowercase() == name.to_lowercase())
    };
    let mut known = KNOWN.iter();
    known.find(|(.., words)| words.split(' ').any(is_same))
}

impl Quantity {
    /// The usual names, for messages.
    pub(super) const fn usual(self) -> &'static str {
        match self {
            Frequency => "f or ω",
            Time => "t",
            Storage => "E' or G'",
            Loss => "E'' or G''",
            LossFactor => "tan delta",
            Relaxation => "E_relax or G_relax",
            Temperature => "T",
            Set => "Set",
        }
    }

    pub(super) const fn is_modulus(self) -> bool {
        matches!(self, Storage | Loss | Relaxation)
    }

    /// The unit, and the factor that turns a number into SI; temperatures stay as they are.
    pub(super) fn unit(self, unit: &str) -> Option<(&'static str, f64)> {
        let unit = unit.trim().trim_matches(['[', ']', '(', ')']).trim();
        let same = SAME_UNITS.iter().find(|(other, _)| *other == unit);
        let unit = same.map_or(unit, |(_, usual)| usual);
        let mut known = self.units().iter();
        known.find(|(known, _)| *known == unit).copied()
    }

    /// Units and the factors that turn a number into SI.
    pub(super) const fn units(self) -> &'static [(&'static str, f64)] {
        match self {
            Frequency => &FREQUENCIES,
            Time => &[("s", 1.0), ("ms", 1e-3), ("min", 60.0), ("h", 3600.0)],
            Storage | Loss | Relaxation => &MODULI,
            Temperature => &[("C", 1.0), ("°C", 1.0), ("K", 1.0)],
            LossFactor | Set => &[("-", 1.0), ("", 1.0), ("1", 1.0)],
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
/// Other ways to write them.
const SAME_UNITS: [(&str, &str); 7] = [
    ("N/mm²", "MPa"),
    ("N/mm^2", "MPa"),
    ("rad/sec", "rad/s"),
    ("s-1", "1/s"),
    ("sec", "s"),
    ("ºC", "°C"),
    ("deg C", "°C"),
];
