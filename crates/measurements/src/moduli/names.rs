//! Names of moduli and of their independent variables in tables.

use super::Deformation;
use crate::table::{Quantity, Vocabulary};
use Quantity::{
    Creep, Frequency, Loss, LossFactor, Magnitude, Phase, Relaxation, Set, Storage, Temperature,
    Time,
};

/// Names by which the columns of a table of moduli are recognised, and the columns that it needs.
pub(crate) static MODULI: Vocabulary = Vocabulary {
    names: "f or ω with two of E', E'' and tan delta (or G' and G''), or with one of E', E'' and |E*| (or G', G'' and |G*|) and a \
            phase angle or tan delta, or t with E_relax (or G_relax) or J(t) (or D(t)), and perhaps T and Set",
    known: &KNOWN_NAMES,
    is_head,
    needed,
    optional: &[Temperature, Set],
    has_order: false,
};

/// Deformation of a name that states Young's modulus E.
const TENSION: Option<Deformation> = Some(Deformation::Tension);
/// Deformation of a name that states the shear modulus G.
const SHEAR: Option<Deformation> = Some(Deformation::Shear);

/// Known names, without blanks, points, dashes, underscores and accents.
const KNOWN_NAMES: [(Quantity, Option<Deformation>, &str); 54] = [
    (Frequency, None, "f freq frequency frequenz ω omega w"),
    (Frequency, None, "angularfrequency angfrequency"),
    (Frequency, None, "kreisfrequenz"),
    (Frequency, None, "frequence frequenceangulaire pulsation"),
    (Frequency, None, "frecuencia frecuenciaangular"),
    (Frequency, None, "frequenza frequenzaangolare pulsazione"),
    (Frequency, None, "频率 角频率 頻率 周波数 角周波数"),
    (Time, None, "t time zeit temps tiempo tempo 时间 時間"),
    (Storage, None, "storagemodulus speichermodul"),
    (Storage, None, "moduledeconservation moduledestockage"),
    (Storage, None, "modulodealmacenamiento moduloconservativo"),
    (Storage, None, "modulodiaccumulo modulodiimmagazzinamento"),
    (Storage, None, "储能模量 儲能模量 貯蔵弾性率"),
    (Storage, TENSION, "E' Estor Estorage"),
    (Storage, SHEAR, "G' Gstor Gstorage"),
    (Storage, SHEAR, "shearstoragemodulus"),
    (Storage, SHEAR, "shearmodulus(elasticcomponent)"),
    (Storage, SHEAR, "貯蔵せん断弾性率"),
    (Loss, None, "lossmodulus verlustmodul"),
    (Loss, None, "moduledeperte moduledepertes"),
    (Loss, None, "modulodeperdida modulodeperdidas"),
    (Loss, None, "modulodissipativo modulodiperdita"),
    (Loss, None, "损耗模量 損耗模量 損失弾性率"),
    (Loss, TENSION, "E'' Eloss"),
    (Loss, SHEAR, "G'' Gloss"),
    (Loss, SHEAR, "shearlossmodulus"),
    (Loss, SHEAR, "shearmodulus(viscouscomponent)"),
    (Loss, SHEAR, "損失せん断弾性率"),
    (LossFactor, None, "tandelta tan(delta) tanδ tan(δ)"),
    (LossFactor, None, "lossfactor dampingfactor verlustfaktor"),
    (LossFactor, None, "facteurdeperte facteurd'amortissement"),
    (LossFactor, None, "factordeperdida factordeperdidas"),
    (LossFactor, None, "fattorediperdita fattoredidissipazione"),
    (LossFactor, None, "损耗因子 损耗角正切 損失正接 損失係数"),
    (Magnitude, TENSION, "|E*| E* |E|"),
    (Magnitude, SHEAR, "|G*| G* |G|"),
    (Magnitude, SHEAR, "complexshearmodulus"),
    (Magnitude, TENSION, "complexyoungsmodulus"),
    (
        Magnitude,
        None,
        "complexmodulus komplexermodul komplexmodul",
    ),
    (
        Magnitude,
        None,
        "modulecomplexe modulocomplejo modulocomplesso",
    ),
    (Magnitude, None, "复数模量 複素弾性率"),
    (
        Phase,
        None,
        "δ delta phase phaseangle phaseshift phaseshiftangle lossangle",
    ),
    (
        Phase,
        None,
        "phasenwinkel phasenverschiebung phasenverschiebungswinkel verlustwinkel",
    ),
    (
        Phase,
        None,
        "angledephase angledeperte angulodefase angolodifase sfasamento 相位角 位相角",
    ),
    (
        Creep,
        None,
        "creepcompliance kriechnachgiebigkeit complaisance",
    ),
    (Creep, TENSION, "D D(t)"),
    (Creep, SHEAR, "J J(t)"),
    (Relaxation, TENSION, "E E(t) Erelax"),
    (Relaxation, SHEAR, "G G(t) Grelax"),
    (Set, None, "set"),
    (Temperature, None, "T Ts temp temperature temperatur"),
    (Temperature, None, "sampletemperature"),
    (Temperature, None, "temperatura"),
    (Temperature, None, "温度 溫度"),
];

/// Whether a line of names is the head of a table of moduli.
fn is_head(columns: &[Quantity]) -> bool {
    let mut quantities = columns.iter();
    columns.len() >= 2 && quantities.any(|one| one.is_modulus() || *one == LossFactor)
}

/// The columns that every row must have, of a table with the given ones: time and modulus or compliance, or frequency and two
/// of the moduli, loss factor and phase. A table of an oscillation may have a column of times, too.
fn needed(columns: &[Quantity]) -> Vec<Quantity> {
    let has = |quantity: &Quantity| columns.contains(quantity);
    if has(&Time) && (has(&Relaxation) || has(&Creep) || !has(&Frequency)) {
        let compliance = has(&Creep) && !has(&Relaxation);
        return vec![Time, if compliance { Creep } else { Relaxation }];
    }
    if has(&Storage) && has(&Loss) {
        return vec![Frequency, Storage, Loss];
    }
    let modulus = [Storage, Loss, Magnitude].into_iter().find(has);
    let angle = [LossFactor, Phase].into_iter().find(has);
    match (modulus, angle) {
        (Some(modulus), Some(angle)) => vec![Frequency, modulus, angle],
        (Some(Magnitude), None) => vec![Frequency, Magnitude, Phase],
        _ => vec![Frequency, Storage, Loss],
    }
}
