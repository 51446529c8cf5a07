//! Factors of storage and loss modulus of a filled rubber over the strain amplitude (Payne effect).

use numerics::{in_range, positive};

use crate::error::with_list_index;
use crate::{ComplexModulus, RheologyError};

/// Factors f > 0 of the storage modulus and g > 0 of the loss modulus, by which a strain amplitude changes them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModulusFactors {
    /// Factor f of G'.
    storage: f64,
    /// Factor g of G''.
    loss: f64,
}

/// Without influence of the strain.
impl Default for ModulusFactors {
    fn default() -> Self {
        Self::NONE
    }
}

impl ModulusFactors {
    /// The moduli at small strains: both factors are 1.
    pub const NONE: Self = Self {
        storage: 1.0,
        loss: 1.0,
    };

    /// Factors of storage and loss modulus.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] unless both are finite and greater than 0.
    pub fn new(storage: f64, loss: f64) -> Result<Self, RheologyError> {
        Ok(Self {
            storage: positive("storage_factor", storage)?,
            loss: positive("loss_factor", loss)?,
        })
    }

    /// Factor f of the storage modulus.
    pub const fn storage(&self) -> f64 {
        self.storage
    }

    /// Factor g of the loss modulus.
    pub const fn loss(&self) -> f64 {
        self.loss
    }

    /// True if both factors are the same, so that the material remains one with a relaxation spectrum.
    pub(crate) const fn are_equal(&self) -> bool {
        self.storage.to_bits() == self.loss.to_bits()
    }

    /// The complex modulus f G' + i g G''.
    #[must_use]
    pub fn on(&self, modulus: ComplexModulus) -> ComplexModulus {
        ComplexModulus {
            storage: self.storage * modulus.storage,
            loss: self.loss * modulus.loss,
        }
    }
}

/// Factors of the moduli as a function of the amplitude of the equivalent strain ε.
///
/// The equivalent (von Mises) strain is the strain of a uniaxial test, and γ/√3 of a shear γ. An amplitude is half of the distance from
/// peak to peak.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum StrainDependence {
    /// The form of Kraus.
    Kraus(KrausModel),
    /// Measured factors.
    Table(StrainTable),
}

/// Moduli over the strain amplitude by Kraus (1984), J. Appl. Polym. Sci. Appl. Polym. Symp. 39, 75:
///
/// ```text
/// f = r + (1 − r)/(1 + x²)        g = 1 + 2 (p − 1) x/(1 + x²)        x = (ε/ε_c)^m
/// ```
///
/// The loss modulus has its maximum at ε_c, where half of the decrease of the storage modulus has taken place, and at large strains
/// the value of small ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KrausModel {
    /// Amplitude ε_c > 0 of the equivalent strain of the largest loss modulus.
    pub critical_strain: f64,
    /// Exponent m > 0; about 0.6 for carbon black.
    pub exponent: f64,
    /// Ratio r of the storage modulus at large to that at small strains, 0 < r ≤ 1.
    pub storage_ratio: f64,
    /// Ratio p of the largest loss modulus to that at small strains, p ≥ 1.
    pub loss_peak_ratio: f64,
}

/// Measured factors; their logarithms are interpolated linearly over that of the strain.
#[derive(Debug, Clone, PartialEq)]
pub struct StrainTable {
    /// ln ε, ln f and ln g with increasing ln ε.
    rows: Vec<[f64; 3]>,
}

/// A row of a table of measured factors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainPoint {
    /// Amplitude of the equivalent strain > 0.
    pub strain: f64,
    /// Factors of the moduli.
    pub factors: ModulusFactors,
}

/// Largest strain at which a table must begin. Chosen: filled rubber is linear at amplitudes of some 0.1 % (Payne 1962, J. Appl. Polym.
/// Sci. 6, 57).
const LARGEST_FIRST_STRAIN: f64 = 2e-3;

impl StrainDependence {
    /// The form of Kraus.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] for the first number out of range.
    pub fn kraus(model: KrausModel) -> Result<Self, RheologyError> {
        positive("critical_strain", model.critical_strain)?;
        positive("exponent", model.exponent)?;
        let ratio = model.storage_ratio;
        let holds = ratio > 0.0 && ratio <= 1.0;
        in_range("storage_ratio", ratio, holds, "above 0 and at most 1")?;
        let peak = model.loss_peak_ratio;
        let holds = peak.is_finite() && peak >= 1.0;
        in_range("loss_peak_ratio", peak, holds, "finite and at least 1")?;
        Ok(Self::Kraus(model))
    }

    /// Measured factors, in any order. They are those of the first row below its strain, and those of the last above.
    ///
    /// # Errors
    /// [`RheologyError::InvalidElement`] for a strain that is not positive or occurs twice, and for a first strain above 0.002, beyond
    /// which filled rubber is not linear; [`RheologyError::TooFewPoints`] for less than two rows.
    pub fn table(points: &[StrainPoint]) -> Result<Self, RheologyError> {
        let refused_at = |index| with_list_index("table", index);
        for (index, row) in points.iter().enumerate() {
            positive("strain", row.strain).map_err(refused_at(index))?;
        }
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|a, b| points[*a].strain.total_cmp(&points[*b].strain));
        if let Some(first) = order.first() {
            let strain = points[*first].strain;
            let allowed = "at most 0.002 in the first row: the factors are those of the linear moduli, which filled rubber has at strains \
                           of some 0.1 %";
            let holds = strain <= LARGEST_FIRST_STRAIN;
            in_range("strain", strain, holds, allowed).map_err(refused_at(*first))?;
        }
        let mut rows: Vec<[f64; 3]> = Vec::with_capacity(points.len());
        for index in order {
            let StrainPoint { strain, factors } = points[index];
            let row = [strain.ln(), factors.storage.ln(), factors.loss.ln()];
            let is_new = rows.last().is_none_or(|last| last[0] < row[0]);
            let allowed = "different from that of every other row";
            in_range("strain", strain, is_new, allowed).map_err(refused_at(index))?;
            rows.push(row);
        }
        match rows.len() {
            given if given < 2 => Err(RheologyError::TooFewPoints { needed: 2, given }),
            _ => Ok(Self::Table(StrainTable { rows })),
        }
    }

    /// Factors of the moduli at an amplitude ε ≥ 0 of the equivalent strain; at 0 they are those of small strains.
    #[must_use]
    pub fn factors(&self, strain: f64) -> ModulusFactors {
        match self {
            Self::Kraus(model) => model.factors(strain),
            Self::Table(table) => table.factors(strain),
        }
    }

    /// Largest −d ln f/d ln ε, by which the storage modulus falls with the strain.
    pub fn steepness(&self) -> f64 {
        match self {
            Self::Kraus(model) => {
                // Of f = r + (1 − r)/(1 + x²), which is steepest where r x⁴ = 1.
                let root = model.storage_ratio.sqrt();
                2.0 * model.exponent * (1.0 - root) / (1.0 + root)
            }
            Self::Table(table) => {
                let slope =
                    |pair: &[[f64; 3]]| (pair[0][1] - pair[1][1]) / (pair[1][0] - pair[0][0]);
                table.rows.windows(2).map(slope).fold(0.0, f64::max)
            }
        }
    }

    /// Range of measured strains; `None` without measurements.
    pub fn measured_range(&self) -> Option<[f64; 2]> {
        let Self::Table(table) = self else {
            return None;
        };
        let [first, last] = [table.rows.first()?, table.rows.last()?];
        Some([first[0].exp(), last[0].exp()])
    }
}

impl KrausModel {
    fn factors(&self, strain: f64) -> ModulusFactors {
        let x = (strain / self.critical_strain).powf(self.exponent);
        // Divide by x where x² may overflow.
        let [falling, peaked] = if x <= 1.0 {
            [(1.0 + x * x).recip(), x / (1.0 + x * x)]
        } else {
            let inverse = x.recip();
            let peaked = inverse / (1.0 + inverse * inverse);
            [inverse * peaked, peaked]
        };
        ModulusFactors {
            storage: self.storage_ratio + (1.0 - self.storage_ratio) * falling,
            loss: 1.0 + 2.0 * (self.loss_peak_ratio - 1.0) * peaked,
        }
    }
}

impl StrainTable {
    fn factors(&self, strain: f64) -> ModulusFactors {
        let rows = &self.rows;
        let log = strain.ln().clamp(rows[0][0], rows[rows.len() - 1][0]);
        let above = rows.partition_point(|row| row[0] < log).max(1);
        let [below, above] = [rows[above - 1], rows[above]];
        let part = (log - below[0]) / (above[0] - below[0]);
        let [storage, loss] =
            [1, 2].map(|column| (below[column] + part * (above[column] - below[column])).exp());
        ModulusFactors { storage, loss }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kraus() -> KrausModel {
        KrausModel {
            critical_strain: 0.01,
            exponent: 0.6,
            storage_ratio: 0.25,
            loss_peak_ratio: 1.8,
        }
    }

    #[test]
    fn the_form_of_kraus_has_its_limits_and_its_peak() {
        let law = StrainDependence::kraus(kraus()).expect("a law");
        assert_eq!(law.factors(0.0), ModulusFactors::NONE);
        let middle = law.factors(0.01);
        assert!((middle.storage() - 0.625).abs() < 1e-15, "{middle:?}");
        assert!((middle.loss() - 1.8).abs() < 1e-15, "{middle:?}");
        for far in [1e300, f64::MAX] {
            let far = law.factors(far);
            assert!((far.storage() - 0.25).abs() < 1e-15, "{far:?}");
            assert!((far.loss() - 1.0).abs() < 1e-15, "{far:?}");
        }
        // The steepest slope by differences.
        let slope = |index: i32| {
            let strains = [index, index + 1].map(|index| 10_f64.powf(0.01 * f64::from(index)));
            let [one, other] = strains.map(|strain| law.factors(strain).storage().ln());
            (one - other) / (0.01 * 10_f64.ln())
        };
        let steepest = (-400..400).map(slope).fold(0.0, f64::max);
        assert!((steepest - law.steepness()).abs() < 1e-4, "{steepest}");
        for wrong in [
            KrausModel {
                critical_strain: 0.0,
                ..kraus()
            },
            KrausModel {
                exponent: f64::NAN,
                ..kraus()
            },
            KrausModel {
                storage_ratio: 1.5,
                ..kraus()
            },
            KrausModel {
                loss_peak_ratio: 0.5,
                ..kraus()
            },
        ] {
            assert!(StrainDependence::kraus(wrong).is_err(), "{wrong:?}");
        }
    }

    #[test]
    fn a_table_is_interpolated_and_ends_with_its_rows() {
        let row = |strain, storage, loss| StrainPoint {
            strain,
            factors: ModulusFactors::new(storage, loss).expect("positive"),
        };
        let rows = [
            row(0.1, 0.25, 1.0),
            row(1e-3, 1.0, 1.0),
            row(1e-2, 0.5, 2.0),
        ];
        let law = StrainDependence::table(&rows).expect("a table");
        for row in rows {
            let found = law.factors(row.strain);
            assert!((found.storage() / row.factors.storage() - 1.0).abs() < 1e-14);
            assert!((found.loss() / row.factors.loss() - 1.0).abs() < 1e-14);
        }
        let between = law.factors((1e-2_f64 * 0.1).sqrt());
        assert!((between.storage() / 0.125_f64.sqrt() - 1.0).abs() < 1e-14);
        assert_eq!(law.factors(0.0), law.factors(1e-3));
        assert_eq!(law.factors(9.0), law.factors(0.1));
        assert!((law.steepness() - 2.0_f64.log10()).abs() < 1e-14);
        let [first, last] = law.measured_range().expect("measured");
        assert!((first / 1e-3 - 1.0).abs() < 1e-14 && (last / 0.1 - 1.0).abs() < 1e-14);
        for wrong in [
            vec![],
            vec![row(1e-3, 1.0, 1.0)],
            vec![row(1e-3, 1.0, 1.0), row(1e-3, 0.5, 1.0)],
            vec![row(0.01, 1.0, 1.0), row(0.1, 0.5, 1.0)],
            vec![row(-1e-3, 1.0, 1.0), row(0.1, 0.5, 1.0)],
        ] {
            assert!(StrainDependence::table(&wrong).is_err(), "{wrong:?}");
        }
        assert!(ModulusFactors::new(0.0, 1.0).is_err());
        assert!(ModulusFactors::new(1.0, f64::INFINITY).is_err());
    }
}
