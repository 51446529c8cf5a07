//! Names of moduli, and of what they are measured over.

use super::Deformation;
use crate::table::{Quantity, Vocabulary};
use Quantity::{Frequency, Loss, LossFactor, Relaxation, Set, Storage, Temperature, Time};

pub(super) static MODULI: Vocabulary = Vocabulary {
    names: "f or ω with two of E', E'' and tan delta (or G' and G''), or t with E_relax (or G_relax), and perhaps T and Set",
    known: &KNOWN,
    is_head,
    needed,
    optional: &[Temperature, Set],
};

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

/// Whether names are those of moduli over something else.
fn is_head(columns: &[Quantity]) -> bool {
    let mut quantities = columns.iter();
    columns.len() >= 2 && quantities.any(|one| one.is_modulus() || *one == LossFactor)
}

/// Oscillation is measured over the time, too.
fn needed(columns: &[Quantity]) -> Vec<Quantity> {
    let has = |quantity| columns.contains(&quantity);
    match [Storage, Loss, LossFactor].map(has) {
        _ if has(Time) && (has(Relaxation) || !has(Frequency)) => vec![Time, Relaxation],
        [true, false, true] => vec![Frequency, Storage, LossFactor],
        [false, true, true] => vec![Frequency, Loss, LossFactor],
        _ => vec![Frequency, Storage, Loss],
    }
}
