//! Shear strength of the contact between an elastomer and a rigid body, over velocity and temperature.

use numerics::{in_range, positive};

use crate::error::with_list_index;
use crate::{ArrheniusShift, KELVIN_AT_ZERO_CELSIUS, RheologyError};

/// Frictional shear stress τ_f of the real contact while it slides, \[Pa].
///
/// It acts against the motion, is independent of the pressure, and multiplied by the real contact area it is the part of the
/// friction that does not come from the bulk of the elastomer.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ShearStrength {
    /// Constant at every velocity and temperature.
    Constant(ConstantShearStrength),
    /// A bell over the logarithm of the velocity.
    Bell(BellShearStrength),
    /// Measured values.
    Table(ShearStrengthTable),
}

/// A shear strength that depends on neither velocity nor temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstantShearStrength(f64);

/// Shear strength that is largest at one velocity, τ_f = τ_0 exp(−(log₁₀(v a_T/v_0)/w)²).
///
/// Rubber chains bind to the body and are torn off: at low velocity thermal motion frees them, at high velocity they have no time to
/// bind (Schallamach 1963). The form is that of Lorenz et al. (2015), J. Chem. Phys. 142, 194701, with 1/w² = c = 0.1 there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BellShearStrength {
    parameters: BellParameters,
    shift: Option<ArrheniusShift>,
}

/// Numbers of a [`BellShearStrength`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BellParameters {
    /// Largest shear strength τ_0 > 0, \[Pa].
    pub shear_strength: f64,
    /// Velocity v_0 > 0 of the largest shear strength at the reference temperature, \[m/s].
    pub velocity: f64,
    /// Decades w > 0 of velocity over which the shear strength falls from τ_0 to τ_0/e.
    pub width: f64,
    /// Activation energy > 0 of a_T = exp((ε/R)(1/T − 1/T_0)), [J/mol]; `None` if the temperature has no influence.
    pub activation_energy: Option<f64>,
    /// Temperature T_0 at which a_T = 1, \[°C].
    pub reference_temperature: f64,
}

/// Width w of a bell with c = 1/w² = 0.1, in decades (Lorenz et al. 2015).
pub const DEFAULT_BELL_WIDTH: f64 = 3.162_277_660_168_379_5;

/// Measured shear strengths; ln τ_f is interpolated linearly over ln v, and over the temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct ShearStrengthTable {
    /// Temperatures in increasing order, \[°C]; empty if the rows have none.
    temperatures: Vec<f64>,
    /// For each temperature, or once without temperatures, pairs of ln v and ln τ_f with increasing ln v.
    curves: Vec<Vec<[f64; 2]>>,
}

/// A row of a table of measured shear strengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearStrengthPoint {
    /// Sliding velocity > 0, \[m/s].
    pub velocity: f64,
    /// Shear strength > 0, \[Pa].
    pub shear_strength: f64,
    /// Temperature, \[°C]; all rows have one, or none.
    pub temperature: Option<f64>,
}

impl ShearStrength {
    /// Shear strength τ_f > 0 at a velocity > 0 \[m/s] and a temperature \[°C], \[Pa].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] for a velocity or a temperature out of range, and for a missing temperature that the law
    /// needs, which counts as not finite; [`RheologyError::OutsideShearTable`] outside a table.
    pub fn at(&self, velocity: f64, temperature: Option<f64>) -> Result<f64, RheologyError> {
        positive("velocity", velocity)?;
        match self {
            Self::Constant(ConstantShearStrength(strength)) => Ok(*strength),
            Self::Bell(bell) => bell.at(velocity, temperature),
            Self::Table(table) => table.at(velocity, temperature),
        }
    }

    /// True if the shear strength depends on the temperature, so that [`Self::at`] needs it.
    pub const fn depends_on_temperature(&self) -> bool {
        match self {
            Self::Constant(_) => false,
            Self::Bell(bell) => bell.shift.is_some(),
            Self::Table(table) => !table.temperatures.is_empty(),
        }
    }

    /// Activation energy of its change with temperature, [J/mol]; `None` unless it is a bell that has one.
    pub const fn activation_energy(&self) -> Option<f64> {
        match self {
            Self::Bell(bell) => bell.parameters.activation_energy,
            Self::Constant(_) | Self::Table(_) => None,
        }
    }

    /// Highest temperature at which it is known, \[°C]; infinite unless it is a table over the temperature.
    pub fn highest_temperature(&self) -> f64 {
        match self {
            Self::Table(table) => table.temperatures.last().copied(),
            Self::Constant(_) | Self::Bell(_) => None,
        }
        .unwrap_or(f64::INFINITY)
    }

    /// A shear strength that depends on neither velocity nor temperature.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] unless it is finite and greater than 0.
    pub fn constant(shear_strength: f64) -> Result<Self, RheologyError> {
        let strength = positive("shear_strength", shear_strength)?;
        Ok(Self::Constant(ConstantShearStrength(strength)))
    }

    /// A bell over the logarithm of the velocity.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] for the first number out of range.
    pub fn bell(parameters: BellParameters) -> Result<Self, RheologyError> {
        positive("shear_strength", parameters.shear_strength)?;
        positive("velocity", parameters.velocity)?;
        positive("width", parameters.width)?;
        let reference = parameters.reference_temperature + KELVIN_AT_ZERO_CELSIUS;
        in_range(
            "reference_temperature",
            parameters.reference_temperature,
            reference > 0.0 && reference.is_finite(),
            "finite and above absolute zero, -273.15 °C",
        )?;
        let shift = parameters
            .activation_energy
            .map(|energy| ArrheniusShift::new(energy, reference))
            .transpose()?;
        Ok(Self::Bell(BellShearStrength { parameters, shift }))
    }

    /// Measured shear strengths, in any order.
    ///
    /// # Errors
    /// [`RheologyError::InvalidElement`] for the first number out of range, for a temperature that only some rows have, and for two
    /// rows of the same velocity and temperature; [`RheologyError::TooFewPoints`] for a temperature with one velocity.
    pub fn table(points: &[ShearStrengthPoint]) -> Result<Self, RheologyError> {
        ShearStrengthTable::new(points).map(Self::Table)
    }
}

impl BellShearStrength {
    fn at(&self, velocity: f64, temperature: Option<f64>) -> Result<f64, RheologyError> {
        let shift = match &self.shift {
            None => 0.0,
            // A missing temperature is refused as one that is not a number.
            Some(shift) => {
                let celsius = temperature.unwrap_or(f64::NAN);
                shift.log10_factor(celsius + KELVIN_AT_ZERO_CELSIUS)?
            }
        };
        let BellParameters {
            shear_strength,
            velocity: peak,
            width,
            ..
        } = self.parameters;
        let decades = velocity.log10() - peak.log10() + shift;
        Ok(shear_strength * (-(decades / width).powi(2)).exp())
    }
}

impl ShearStrengthTable {
    fn new(points: &[ShearStrengthPoint]) -> Result<Self, RheologyError> {
        // Check each row by itself.
        let has_temperature = points.first().is_some_and(|row| row.temperature.is_some());
        for (index, row) in points.iter().enumerate() {
            let at = with_list_index("table", index);
            positive("velocity", row.velocity).map_err(&at)?;
            positive("shear_strength", row.shear_strength).map_err(&at)?;
            let celsius = row.temperature.unwrap_or(0.0);
            let holds = row.temperature.is_some() == has_temperature
                && celsius.is_finite()
                && celsius > -KELVIN_AT_ZERO_CELSIUS;
            let allowed =
                "finite and above absolute zero, -273.15 °C, in all rows or left out in all";
            let stated = row.temperature.unwrap_or(f64::NAN);
            in_range("temperature", stated, holds, allowed).map_err(at)?;
        }
        // Sort the rows into one curve for each temperature, and reject velocities that occur twice.
        let mut order: Vec<usize> = (0..points.len()).collect();
        let key = |index: &usize| {
            let row = points[*index];
            [row.temperature.unwrap_or(0.0), row.velocity]
        };
        order.sort_by(|a, b| {
            let ([hot, fast], [other_hot, other_fast]) = (key(a), key(b));
            hot.total_cmp(&other_hot).then(fast.total_cmp(&other_fast))
        });
        let mut temperatures: Vec<f64> = Vec::new();
        let mut curves: Vec<Vec<[f64; 2]>> = Vec::new();
        for index in order {
            let row = points[index];
            let celsius = row.temperature.unwrap_or(0.0);
            if temperatures.last().is_none_or(|last| *last < celsius) {
                temperatures.push(celsius);
                curves.push(Vec::new());
            }
            let curve = &mut curves[temperatures.len() - 1];
            let point = [row.velocity.ln(), row.shear_strength.ln()];
            let is_new = curve.last().is_none_or(|last| last[0] < point[0]);
            let allowed = "different from that of every other row of the same temperature";
            in_range("velocity", row.velocity, is_new, allowed)
                .map_err(with_list_index("table", index))?;
            curve.push(point);
        }
        match curves.iter().map(Vec::len).min() {
            Some(given) if given >= 2 => Ok(Self {
                temperatures: if has_temperature {
                    temperatures
                } else {
                    Vec::new()
                },
                curves,
            }),
            given => Err(RheologyError::TooFewPoints {
                needed: 2,
                given: given.unwrap_or(0),
            }),
        }
    }

    /// Range of velocities that every temperature of the table covers, \[m/s].
    fn velocity_range(&self) -> [f64; 2] {
        let ends = |curve: &Vec<[f64; 2]>| [curve[0][0], curve[curve.len() - 1][0]];
        let ends = self.curves.iter().map(ends);
        let [lowest, highest] = ends.fold([f64::MIN, f64::MAX], |range, ends| {
            [range[0].max(ends[0]), range[1].min(ends[1])]
        });
        [lowest.exp(), highest.exp()]
    }

    fn at(&self, velocity: f64, temperature: Option<f64>) -> Result<f64, RheologyError> {
        let outside = |name, value, [lowest, highest]: [f64; 2]| RheologyError::OutsideShearTable {
            name,
            value,
            lowest,
            highest,
        };
        // Interpolate over the velocity at each temperature, and between the results over the temperature.
        let on_curve = |curve: &[[f64; 2]]| {
            let ends = self.velocity_range();
            let found = interpolated(curve, velocity.ln());
            found.ok_or_else(|| outside("velocity [m/s]", velocity, ends))
        };
        let (Some(first), Some(last)) = (self.temperatures.first(), self.temperatures.last())
        else {
            return on_curve(&self.curves[0]).map(f64::exp);
        };
        // A missing temperature is refused as one that is not a number.
        let celsius = temperature.unwrap_or(f64::NAN);
        let logs = self.temperatures.iter().zip(&self.curves);
        let logs = logs.map(|(celsius, curve)| Ok([*celsius, on_curve(curve)?]));
        let logs: Vec<[f64; 2]> = logs.collect::<Result<_, RheologyError>>()?;
        let found = interpolated(&logs, celsius).map(f64::exp);
        found.ok_or_else(|| outside("temperature [°C]", celsius, [*first, *last]))
    }
}

/// Value at `x` of the polygon through points with increasing first numbers; `None` outside them.
fn interpolated(points: &[[f64; 2]], x: f64) -> Option<f64> {
    let ([first, of_first], [last, _]) = (*points.first()?, *points.last()?);
    if !(first..=last).contains(&x) {
        return None;
    }
    let above = points.partition_point(|point| point[0] < x);
    let Some(below) = above.checked_sub(1) else {
        return Some(of_first);
    };
    let ([below, of_below], [above, of_above]) = (points[below], points[above]);
    let part = (x - below) / (above - below);
    Some(of_below + part * (of_above - of_below))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(found: f64, expected: f64, tolerance: f64) {
        let error = (found / expected - 1.0).abs();
        assert!(error < tolerance, "{found} for {expected}");
    }

    fn bell() -> BellParameters {
        BellParameters {
            shear_strength: 5e6,
            velocity: 1e-3,
            width: DEFAULT_BELL_WIDTH,
            activation_energy: Some(96_485.332_12),
            reference_temperature: 20.0,
        }
    }

    /// At v = v_0/a_T the strength is τ_0; w decades beside it τ_0/e. An activation energy of 1 eV halves a_T about every 6 K.
    #[test]
    fn a_bell_has_its_peak_and_its_width() {
        let law = ShearStrength::bell(bell()).expect("a law");
        let at = |velocity: f64, celsius| law.at(velocity, Some(celsius)).expect("a strength");
        assert_close(at(1e-3, 20.0), 5e6, 1e-14);
        let beside = 1e-3 * 10_f64.powf(DEFAULT_BELL_WIDTH);
        assert_close(at(beside, 20.0), 5e6 * (-1.0_f64).exp(), 1e-12);
        let log_shift: f64 = 96_485.332_12 / 8.314_462_618 * (1.0 / 313.15 - 1.0 / 293.15);
        assert_close(at(1e-3 / log_shift.exp(), 40.0), 5e6, 1e-9);
        assert!(law.at(1e-3, None).is_err(), "its temperature is needed");
        assert!(law.at(0.0, Some(20.0)).is_err());
    }

    #[test]
    fn a_table_is_interpolated_and_never_extrapolated() {
        let row = |velocity, shear_strength, celsius| ShearStrengthPoint {
            velocity,
            shear_strength,
            temperature: Some(celsius),
        };
        let rows = [
            row(1e-2, 4e5, 60.0),
            row(1e-4, 1e5, 20.0),
            row(1e-4, 2e5, 60.0),
            row(1e-2, 1e6, 20.0),
        ];
        let law = ShearStrength::table(&rows).expect("a table");
        let at = |velocity: f64, celsius| law.at(velocity, Some(celsius));
        for row in &rows {
            let found = at(row.velocity, row.temperature.expect("one")).expect("a strength");
            assert_close(found, row.shear_strength, 1e-12);
        }
        let middle = at(1e-3, 40.0).expect("inside");
        let expected = (1e5_f64 * 1e6 * 2e5 * 4e5).powf(0.25);
        assert_close(middle, expected, 1e-12);
        for (velocity, celsius, name) in [
            (1e-5, 20.0, "velocity"),
            (2e-2, 40.0, "velocity"),
            (1e-3, 19.0, "temperature"),
            (1e-3, 61.0, "temperature"),
        ] {
            let refused = at(velocity, celsius).expect_err("outside");
            assert!(refused.to_string().contains(name), "{refused}");
        }
        assert!(law.at(1e-3, None).is_err(), "its temperature is needed");
    }

    #[test]
    fn rows_that_contradict_each_other_are_refused() {
        let row = |velocity, temperature| ShearStrengthPoint {
            velocity,
            shear_strength: 1e5,
            temperature,
        };
        for rows in [
            vec![],
            vec![row(1e-3, None)],
            vec![row(1e-3, None), row(1e-3, None)],
            vec![row(1e-3, None), row(1e-2, Some(20.0))],
            vec![row(1e-3, Some(20.0)), row(1e-2, Some(40.0))],
            vec![row(-1e-3, None), row(1e-2, None)],
            vec![row(f64::NAN, None), row(1e-2, None)],
        ] {
            assert!(ShearStrength::table(&rows).is_err(), "{rows:?}");
        }
        let one = ShearStrength::table(&[row(1e-3, None), row(1e-2, None)]).expect("a table");
        assert!(!one.depends_on_temperature());
        assert_eq!(one.at(1e-2, Some(500.0)).ok(), one.at(1e-2, None).ok());
    }
}
