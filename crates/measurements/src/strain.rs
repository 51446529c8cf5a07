//! Reader of strain sweeps: moduli of filled rubber over the strain amplitude at one frequency.

use std::path::Path;

use rheology::{ModulusFactors, RheologyError, StrainDependence, StrainPoint};

use crate::MeasurementError;
use crate::moduli::Deformation;
use crate::table::Quantity::{self, Loss, LossFactor, Other, Storage, StorageFactor, Strain};
use crate::table::{Line, Meaning, Source, Table, Vocabulary, text_of};

/// Information that a strain sweep does not contain.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct StrainSweepOptions {
    /// Deformation of strains and moduli whose names do not state it.
    pub deformation: Option<Deformation>,
    /// True if strains are given from peak to peak, so that the amplitude is half of them.
    pub is_double: bool,
}

/// Names by which the columns of a strain sweep are recognised, and the columns that it needs.
pub(crate) static SWEEP: Vocabulary = Vocabulary {
    names: "strain with storage_factor and loss_factor, or with E' and E'' (or G' and G''), or with E' (or G') and tan delta",
    known: &KNOWN_NAMES,
    is_head: |columns| columns.len() > 1 && columns.contains(&Strain),
    needed,
    optional: &[],
    has_order: true,
};

/// Deformation of a name that states Young's modulus E.
const TENSION: Option<Deformation> = Some(Deformation::Tension);
/// Deformation of a name that states a shear.
const SHEAR: Option<Deformation> = Some(Deformation::Shear);

/// Known names, without blanks, points, dashes, underscores and accents.
const KNOWN_NAMES: [(Quantity, Option<Deformation>, &str); 15] = [
    (Strain, None, "strain strainamplitude amplitude ε dsa"),
    (Strain, None, "dynamicstrain doublestrainamplitude"),
    (Strain, None, "dehnung dehnungsamplitude deformation"),
    (
        Strain,
        SHEAR,
        "γ gamma shearstrain scherung scherdeformation",
    ),
    (StorageFactor, None, "storagefactor"),
    (Storage, None, "storagemodulus speichermodul"),
    (Storage, TENSION, "E' Estor Estorage"),
    (Storage, SHEAR, "G' Gstor Gstorage shearstoragemodulus"),
    (Loss, None, "lossmodulus verlustmodul"),
    (Loss, TENSION, "E'' Eloss"),
    (Loss, SHEAR, "G'' Gloss shearlossmodulus"),
    (LossFactor, None, "tandelta tan(delta) tanδ tan(δ)"),
    (LossFactor, None, "lossfactor dampingfactor verlustfaktor"),
    (Other, None, "f freq frequency frequenz"),
    (Other, None, "T temp temperature temperatur"),
];

/// The columns that every row must have: the strain with two factors, two moduli, or a modulus and the loss factor tan δ.
fn needed(columns: &[Quantity]) -> Vec<Quantity> {
    if columns.contains(&StorageFactor) {
        vec![Strain, StorageFactor, LossFactor]
    } else if columns.contains(&Loss) {
        vec![Strain, Storage, Loss]
    } else {
        vec![Strain, Storage, LossFactor]
    }
}

/// Reads the factors of the moduli over the strain amplitude from the contents of a file; the path is used for messages only.
///
/// The table has a line of names and one row for each strain. Moduli are divided by those of the smallest strain, which must be in the
/// linear range. Strains in shear are divided by √3, so that they are equivalent strains.
///
/// # Errors
/// [`MeasurementError`] with file, line and column.
pub fn strain_sweep(
    file: &Path,
    contents: &[u8],
    options: &StrainSweepOptions,
) -> Result<StrainDependence, MeasurementError> {
    let text = text_of(contents, &SWEEP);
    let meaning = Meaning {
        deformation: options.deformation,
        scale: &|_| 1.0,
    };
    let source = Source::new(file, &text, &SWEEP, meaning);
    let tables = source.tables()?;
    if let Some((second, _)) = tables.get(1) {
        let problem = "a second table begins here; put one strain sweep into the file";
        return Err(source.wrong_line(second.line, &problem));
    }
    let (table, lines) = &tables[0];
    let scale = scale_of_strain(table, options);
    let rows: Vec<[f64; 3]> = lines
        .iter()
        .map(|line| row(table, line, scale))
        .collect::<Result<_, MeasurementError>>()?;
    // Factors are relative to the moduli at the smallest strain.
    let is_modulus = table.needed[1] == Storage;
    let first = rows.iter().min_by(|one, other| one[0].total_cmp(&other[0]));
    let [_, storage_at_rest, loss_at_rest] = first.filter(|_| is_modulus).unwrap_or(&[1.0; 3]);
    let mut points = Vec::with_capacity(rows.len());
    for ([strain, storage, loss], line) in rows.iter().zip(lines) {
        let factors = ModulusFactors::new(storage / storage_at_rest, loss / loss_at_rest);
        let wrong = |error: RheologyError| source.wrong_line(line.number, &error);
        points.push(StrainPoint {
            strain: *strain,
            factors: factors.map_err(wrong)?,
        });
    }
    StrainDependence::table(&points).map_err(|error| {
        let line = match &error {
            RheologyError::InvalidElement { index, .. } => lines.get(*index),
            _ => lines.last(),
        };
        source.wrong_line(line.map_or(table.line, |line| line.number), &error)
    })
}

/// Factor from the strains of a table to amplitudes of the equivalent strain.
fn scale_of_strain(table: &Table<'_>, options: &StrainSweepOptions) -> f64 {
    let stated = |quantity| table.find(quantity).and_then(|column| column.deformation);
    let deformation = stated(Strain).or(stated(table.needed[1]));
    let is_shear = deformation.or(options.deformation) == SHEAR;
    let name = table.find(Strain).map_or("", |column| column.name);
    let name = name.to_lowercase();
    let is_double = options.is_double || name.contains("double") || name.contains("dsa");
    let of_shear = if is_shear {
        3.0_f64.sqrt().recip()
    } else {
        1.0
    };
    if is_double { 0.5 * of_shear } else { of_shear }
}

/// Equivalent strain, storage and loss modulus or their factors, of a line.
fn row(table: &Table<'_>, line: &Line<'_>, scale: f64) -> Result<[f64; 3], MeasurementError> {
    let numbers = table.positives(line)?;
    let [strain, storage, last] = [numbers[0], numbers[1], numbers[2]];
    let loss = if table.needed[1..] == [Storage, LossFactor] {
        storage * last
    } else {
        last
    };
    Ok([scale * strain, storage, loss])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(contents: &str, options: StrainSweepOptions) -> Result<StrainDependence, String> {
        let found = strain_sweep(Path::new("payne.csv"), contents.as_bytes(), &options);
        found.map_err(|error| error.to_string())
    }

    /// The same sweep as factors, as moduli in tension, in shear, with tan δ, in per cent, and from peak to peak.
    #[test]
    fn a_sweep_is_read_as_instruments_export_it() {
        let plain =
            "strain,storage_factor,loss_factor\n0.001,1.0,1.0\n0.01,0.5,1.5\n0.1,0.25,0.75\n";
        let expected = read(plain, StrainSweepOptions::default()).expect("a sweep");
        let same = [
            "Strain [%];E' [MPa];E'' [MPa]\n0,1;8;2\n1;4;3\n10;2;1,5\n",
            "strain (%)\tE' (MPa)\ttan delta\n0.1\t8\t0.25\n1\t4\t0.75\n10\t2\t0.75\n",
            "Double strain amplitude (%),E' (MPa),E'' (MPa)\n0.2,8,2\n2,4,3\n20,2,1.5\n",
            "shear strain,G' [kPa],G'' [kPa]\n0.00173205080756888,80,20\n0.0173205080756888,40,30\n0.173205080756888,20,15\n",
        ];
        for text in same {
            let found = read(text, StrainSweepOptions::default()).expect(text);
            for strain in [0.0, 1e-3, 3e-3, 0.01, 0.05, 0.1, 1.0] {
                let [found, expected] = [&found, &expected].map(|law| law.factors(strain));
                let off = (found.storage() / expected.storage() - 1.0)
                    .abs()
                    .max((found.loss() / expected.loss() - 1.0).abs());
                assert!(off < 1e-12, "{text} at {strain}: {found:?}, {expected:?}");
            }
        }
        let options = StrainSweepOptions {
            deformation: SHEAR,
            is_double: true,
        };
        let scaled = read(plain, options);
        let refused =
            scaled.is_ok_and(|law| law.measured_range().is_some_and(|range| range[1] < 0.03));
        assert!(refused, "half the strain over the root of three");
    }

    #[test]
    fn a_wrong_sweep_is_refused_with_its_line() {
        for (text, words) in [
            (
                "strain,storage_factor,loss_factor\n0.01,1,1\n0.1,0.5,1\n",
                ["line 2", "0.002"],
            ),
            (
                "strain,storage_factor,loss_factor\n0.001,1,1\n0.001,0.5,1\n",
                ["line 3", "different"],
            ),
            (
                "strain,storage_factor,loss_factor\n0.001,1,1\n0.1,-0.5,1\n",
                ["line 3", "greater than 0"],
            ),
            ("strain,E' [MPa]\n0.001,1\n0.1,0.5\n", ["line 1", "loss"]),
            (
                "strain,storage_factor,loss_factor\n0.001,1,1\n",
                ["line 2", "2"],
            ),
        ] {
            let refused = read(text, StrainSweepOptions::default()).expect_err(text);
            for word in words {
                assert!(refused.contains(word), "{text}: {refused}");
            }
        }
    }
}
