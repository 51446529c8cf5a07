//! Periodic surfaces that slide, from `rough.json`.

use rheology::Prony;
use serde_json::Value;

use crate::prony;

/// A surface with periods of length 1 that slides on a material.
#[derive(Debug, Clone)]
pub struct RoughCase {
    /// Name.
    pub id: String,
    /// Waves [m, n, a, φ] of the heights Σ a cos(2π (m x + n y) + φ).
    pub waves: Vec<[f64; 4]>,
    /// ν = 1/2.
    pub material: Prony,
    /// \[m/s].
    pub velocity: f64,
    /// \[Pa].
    pub mean_pressure: f64,
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Part of the period in contact.
    pub area: f64,
}

/// All cases of `"cases"`, in partial contact, or of `"full_contact"`.
pub fn rough_cases(group: &str) -> Vec<RoughCase> {
    let book: Value = serde_json::from_str(include_str!("../rough.json")).expect("a valid table");
    let rows = book[group].as_array().expect("a group of cases");
    rows.iter().map(|row| case(&book, row)).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn case(book: &Value, row: &Value) -> RoughCase {
    let name = |key: &str| row[key].as_str().expect("a name");
    let list = |value: &Value| value.as_array().expect("a list").clone();
    let wave = |wave: &Value| std::array::from_fn(|index| number(&wave[index]));
    let moduli = &book["materials"][name("material")];
    // E* = 2 G/(1 − ν).
    let branch = |branch: &Value| (0.25 * number(&branch["E"]), number(&branch["tau"]));
    let branches: Vec<_> = list(&moduli["branches"]).iter().map(branch).collect();
    let waves = list(&book["surfaces"][name("surface")]);
    RoughCase {
        id: name("id").to_owned(),
        waves: waves.iter().map(wave).collect(),
        material: prony([0.25 * number(&moduli["E0"]), 0.0], &branches),
        velocity: number(&row["v"]),
        mean_pressure: number(&row["p0"]),
        friction_coefficient: number(&row["mu"]),
        area: number(&row["area"]),
    }
}
