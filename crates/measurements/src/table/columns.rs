//! Names and units in the head of a table.

use std::f64::consts::TAU;

use super::Deformation;
use Quantity::{
    Creep, Deflection, Depth, Displacement, Force, Frequency, Friction, FrictionError,
    FrictionForce, Height, Loss, LossFactor, Magnitude, Other, Phase, Piezo, Radius, Relaxation,
    Set, ShearError, ShearStrength, Storage, StorageFactor, Strain, Temperature, Time, Tip,
    Velocity,
};

/// Quantity in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// Frequency f or ω.
    Frequency,
    /// Time t.
    Time,
    /// Storage modulus G' or E'.
    Storage,
    /// Loss modulus G'' or E''.
    Loss,
    /// Loss factor tan δ.
    LossFactor,
    /// Storage modulus over that of small strains.
    StorageFactor,
    /// Strain amplitude.
    Strain,
    /// Magnitude |G*| or |E*|.
    Magnitude,
    /// Phase angle δ by which strain lags behind stress.
    Phase,
    /// Relaxation modulus G(t) or E(t).
    Relaxation,
    /// Creep compliance.
    Creep,
    /// Temperature.
    Temperature,
    /// Number of the isotherm.
    Set,
    /// Normal force.
    Force,
    /// Indentation depth.
    Depth,
    /// Displacement of the body or of a piezo, towards the sample.
    Displacement,
    /// Extension of the piezo, towards the sample.
    Piezo,
    /// Position of the piezo, away from the sample.
    Height,
    /// Position of the tip, away from the sample.
    Tip,
    /// Deflection of a cantilever, as a length, a force or a voltage.
    Deflection,
    /// Speed of sliding or rolling, along the track or as a rotation.
    Velocity,
    /// Radius of a circular track.
    Radius,
    /// Friction coefficient.
    Friction,
    /// Standard error of the friction coefficient.
    FrictionError,
    /// Force along the surface.
    FrictionForce,
    /// Shear strength of the contact.
    ShearStrength,
    /// Standard error of the shear strength.
    ShearError,
    /// Known name of an ignored column.
    Other,
}

/// Names and columns of one kind of table.
pub(crate) struct Vocabulary {
    /// All names, for messages.
    pub(crate) names: &'static str,
    /// Known names, without blanks, points, dashes and underscores.
    pub(crate) known: &'static [(Quantity, Option<Deformation>, &'static str)],
    /// Whether columns with these quantities are the head of a table.
    pub(crate) is_head: fn(&[Quantity]) -> bool,
    /// Needed quantities of a table with these columns.
    pub(crate) needed: fn(&[Quantity]) -> Vec<Quantity>,
    /// Optional quantities.
    pub(crate) optional: &'static [Quantity],
    /// Whether the first of several columns of a quantity is read, in the order of `known` and of the units.
    pub(crate) has_order: bool,
}

impl Vocabulary {
    /// Index in `known` of a name, and the deformation that it states.
    ///
    /// Single letters are case-sensitive: T is a temperature, t a time and F a force.
    pub(super) fn meaning(&self, name: &str) -> Option<(usize, Option<Deformation>)> {
        let name = name
            .replace(['′', '’', '´', '`'], "'")
            // A quote in a cell in quotes is doubled (RFC 4180).
            .replace("\"\"", "\"")
            .replace(['″', '”', '"'], "''")
            .replace([' ', '_', '-', '.'], "");
        let with_symbol =
            |&(symbol, quantity, deformation): &(&str, Quantity, Option<Deformation>)| {
                let rest = name
                    .strip_suffix(')')
                    .unwrap_or(&name)
                    .strip_suffix(symbol)
                    .or_else(|| name.strip_prefix(symbol))?;
                let found = self.find(rest.trim_matches(['(', ')', ',']))?;
                (self.known[found].0 == quantity).then_some((found, deformation))
            };
        let found = self.find(&name).map(|found| (found, self.known[found].1));
        found.or_else(|| SYMBOLS.iter().find_map(with_symbol))
    }

    /// Index in `known` of a name; case and accents count only for single letters.
    fn find(&self, name: &str) -> Option<usize> {
        let folded = fold_accents(name);
        let is_same = |word: &str| {
            word == name || (name.chars().count() > 1 && word.to_lowercase() == folded)
        };
        let mut known = self.known.iter();
        known.position(|(.., words)| words.split(' ').any(is_same))
    }

    /// Whether a text has Chinese or Japanese names in it.
    pub(super) fn has_ideographs_in(&self, text: &str) -> bool {
        let is_ideograph = |letter| letter > '\u{3000}';
        self.known
            .iter()
            .flat_map(|(.., words)| words.split(' '))
            .any(|word| word.contains(is_ideograph) && text.contains(word))
    }
}

/// Symbols that may accompany a name, as in `Speichermodul E'` or `Loss modulus (G'')`.
const SYMBOLS: [(&str, Quantity, Option<Deformation>); 18] = [
    ("E''", Loss, Some(Deformation::Tension)),
    ("G''", Loss, Some(Deformation::Shear)),
    ("E'", Storage, Some(Deformation::Tension)),
    ("G'", Storage, Some(Deformation::Shear)),
    ("tandelta", LossFactor, None),
    ("tanδ", LossFactor, None),
    ("tan(δ)", LossFactor, None),
    ("|E*|", Magnitude, Some(Deformation::Tension)),
    ("|G*|", Magnitude, Some(Deformation::Shear)),
    ("E*", Magnitude, Some(Deformation::Tension)),
    ("G*", Magnitude, Some(Deformation::Shear)),
    ("δ", Phase, None),
    ("J(t)", Creep, Some(Deformation::Shear)),
    ("D(t)", Creep, Some(Deformation::Tension)),
    ("f", Frequency, None),
    ("ω", Frequency, None),
    ("t", Time, None),
    ("T", Temperature, None),
];

/// A name in lower case without accents.
fn fold_accents(name: &str) -> String {
    let accents = ["áàâ a", "éèê e", "íìî i", "óòô o", "úùû u"];
    let plain = |letter: char| {
        let same = accents.iter().find(|letters| letters.contains(letter));
        same.and_then(|letters| letters.chars().last())
            .unwrap_or(letter)
    };
    name.to_lowercase().chars().map(plain).collect()
}

/// Candidate divisions of a cell such as `E'`, `E' (MPa)`, `E' [MPa]`, `E' / MPa`, `"E', MPa"` or `Defl_pN_Ex` into name and
/// unit; a missing unit is empty.
pub(crate) fn split_unit(cell: &str) -> impl Iterator<Item = (&str, &str)> {
    let prefix = PREFIXES.iter().find(|(prefix, _)| cell.starts_with(prefix));
    let cell = prefix.map_or(cell, |(prefix, _)| &cell[prefix.len()..]);
    let bracket = cell
        .strip_suffix([')', ']', '）'])
        .and_then(|cell| cell.rsplit_once(['(', '[', '（']));
    // The name and the half of a ramp may have the unit between them or behind them.
    let half = |name| {
        SUFFIXES
            .iter()
            .find_map(|(half, _)| str::strip_suffix(name, half))
    };
    let name = half(cell).unwrap_or(cell);
    let ramp = name
        .rsplit_once('_')
        .and_then(|(name, unit)| match half(name) {
            None if name.len() + unit.len() + 1 == cell.len() => None,
            before => Some((before.unwrap_or(name), unit)),
        });
    let comma = cell.split_once(", ");
    let parts = [Some((cell, "")), bracket, cell.split_once('/'), comma, ramp];
    parts.into_iter().flatten()
}

/// Divisions of a cell such as `tau_MPa` or `velocity_m_per_s` at its underscores into name and unit, from the last one on.
pub(super) fn split_underscores(cell: &str) -> impl Iterator<Item = (&str, &str)> {
    let places = cell.rmatch_indices('_');
    places.map(|(at, _)| (&cell[..at], &cell[at + 1..]))
}

/// Half of a ramp; the columns of both halves may be in one table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Half {
    /// Towards the sample.
    Approach,
    /// Away from it.
    Retract,
}

/// Suffixes by which NanoScope marks the halves of a ramp, as in `Defl_pN_Ex` and `Calc_Ramp_Rt_nm`.
const SUFFIXES: [(&str, Half); 2] = [("_Ex", Half::Approach), ("_Rt", Half::Retract)];
/// Prefixes by which other instruments mark the halves of a ramp, as AFM Workshop in `Extend Z-Sense(nm)`.
const PREFIXES: [(&str, Half); 8] = [
    ("Extend ", Half::Approach),
    ("Approach ", Half::Approach),
    ("Loading ", Half::Approach),
    ("Trace ", Half::Approach),
    ("Retract ", Half::Retract),
    ("Withdraw ", Half::Retract),
    ("Unloading ", Half::Retract),
    ("Retrace ", Half::Retract),
];

/// Half of a ramp with which the name of a column is marked.
pub(super) fn half_of(name: &str) -> Option<Half> {
    let mut suffixes = SUFFIXES.iter();
    let mut prefixes = PREFIXES.iter();
    let found = suffixes
        .find(|(mark, _)| name.contains(mark))
        .or_else(|| prefixes.find(|(mark, _)| name.starts_with(mark)));
    found.map(|(_, half)| *half)
}

impl Quantity {
    /// Usual names for messages, and known units separated by blanks; one of these may be empty.
    const fn names(self) -> (&'static str, &'static str) {
        match self {
            Frequency => ("f or ω", "Hz mHz kHz rad/s 1/s"),
            Time => ("t", "s ms us min h"),
            Storage => ("E' or G'", "Pa kPa MPa GPa"),
            Loss => ("E'' or G''", "Pa kPa MPa GPa"),
            LossFactor => ("tan delta", "-  1"),
            StorageFactor => ("storage_factor", "-  1"),
            Strain => ("strain", "-  1 %"),
            Magnitude => ("|E*| or |G*|", "Pa kPa MPa GPa"),
            Phase => ("phase angle", "deg rad mrad"),
            Creep => ("J(t) or D(t)", "1/Pa 1/kPa 1/MPa 1/GPa"),
            Relaxation => ("E_relax or G_relax", "Pa kPa MPa GPa"),
            Temperature => ("T", "C °C K"),
            Set => ("Set", "-  1"),
            Force => ("force", "N mN uN nN pN kN"),
            Depth => ("depth", "m mm um nm pm A"),
            Displacement => ("displacement", "m mm um nm pm A"),
            Piezo => ("piezo", "m mm um nm pm A"),
            Height => ("height", "m mm um nm pm A"),
            Tip => ("tip position", "m mm um nm pm A"),
            Velocity => ("v", "m/s mm/s um/s cm/s km/h rpm Hz rad/s"),
            Radius => ("track radius", "m mm cm um"),
            Friction => ("mu", "-  1 %"),
            FrictionError => ("standard error of mu", "-  1 %"),
            FrictionForce => ("friction force", "N mN uN nN pN kN"),
            ShearStrength => ("tau", "Pa kPa MPa GPa"),
            ShearError => ("standard error of tau", "Pa kPa MPa GPa"),
            // A deflection may be stated as a force, as a length, or as the voltage of the detector.
            Deflection => ("deflection", "N mN uN nN pN m um nm pm V mV"),
            Other => ("", "-  1"),
        }
    }

    /// Usual names of the quantity, for messages.
    pub(crate) const fn usual(self) -> &'static str {
        self.names().0
    }

    /// Known units, separated by blanks; an empty one means that no unit is needed.
    pub(crate) const fn units(self) -> &'static str {
        self.names().1
    }

    /// True for moduli and compliances, which depend on the deformation.
    pub(crate) const fn is_modulus(self) -> bool {
        matches!(self, Storage | Loss | Magnitude | Relaxation | Creep)
    }

    /// Canonical unit with its factor to SI; `None` for an unknown unit. Temperatures are not converted.
    pub(crate) fn unit(self, unit: &str) -> Option<(&'static str, f64)> {
        let written = unit
            .trim()
            .trim_matches(['[', ']', '(', ')'])
            .trim()
            .replace(['µ', 'μ'], "u")
            .replace("_per_", "/");
        let same = SAME_UNITS.iter().find(|(other, _)| *other == written);
        let usual = same.map_or(&*written, |(_, usual)| usual);
        let known = self.units().split(' ').find(|known| *known == usual)?;
        Some((known, self.factor(known)))
    }

    /// Factor from one of the known units to SI.
    fn factor(self, unit: &str) -> f64 {
        let of_unit = match unit {
            "Hz" | "mHz" | "kHz" => TAU,
            "rpm" => return TAU / 60.0,
            "deg" => return TAU / 360.0,
            "rad" => return 1.0,
            "1/kPa" => return 1e-3,
            "1/MPa" => return 1e-6,
            "1/GPa" => return 1e-9,
            "min" => return 60.0,
            "h" => return 3600.0,
            "A" => return 1e-10,
            "m/s" => return 1.0,
            "cm/s" | "cm" | "%" => return 0.01,
            "km/h" => return 1.0 / 3.6,
            _ => 1.0,
        };
        let factors = [1e-12, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9];
        let prefixes = "pnumkMG".chars().zip(factors);
        let mut prefix = prefixes.filter(|(prefix, _)| unit.len() > 1 && unit.starts_with(*prefix));
        of_unit * prefix.next().map_or(1.0, |(_, factor)| factor)
    }
}

/// Other spellings of units, each with its usual one.
const SAME_UNITS: [(&str, &str); 26] = [
    ("pa", "Pa"),
    ("c", "C"),
    ("1/min", "rpm"),
    ("min-1", "rpm"),
    ("U/min", "rpm"),
    ("r/min", "rpm"),
    ("RPM", "rpm"),
    ("N/mm²", "MPa"),
    ("N/mm^2", "MPa"),
    ("rad/sec", "rad/s"),
    ("s-1", "1/s"),
    ("sec", "s"),
    ("ºC", "°C"),
    ("℃", "°C"),
    ("deg C", "°C"),
    ("Å", "A"),
    ("°", "deg"),
    ("º", "deg"),
    ("degrees", "deg"),
    ("Grad", "deg"),
    ("Pa-1", "1/Pa"),
    ("Pa^-1", "1/Pa"),
    ("Pa⁻¹", "1/Pa"),
    ("MPa-1", "1/MPa"),
    ("MPa^-1", "1/MPa"),
    ("MPa⁻¹", "1/MPa"),
];
