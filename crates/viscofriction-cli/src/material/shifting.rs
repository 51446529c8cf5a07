//! Isotherms onto one curve.

use rheology::fit::{Isotherm, MasterCurve, automatic_master_curve, shifted_master_curve};
use rheology::{ArrheniusShift, RheologyError, WlfShift};

use super::FitMaterial;

const KELVIN_AT_ZERO_CELSIUS: f64 = 273.15;

/// The master curve of several isotherms, at the temperature asked for or at that of the isotherm in the middle.
pub(super) fn master_curve(
    isotherms: &[Isotherm],
    celsius: bool,
    options: &FitMaterial,
) -> Result<MasterCurve, RheologyError> {
    let mut temperatures: Vec<f64> = isotherms.iter().map(|one| one.temperature).collect();
    temperatures.sort_by(f64::total_cmp);
    let middle = temperatures[temperatures.len() / 2];
    let reference = options.reference_temperature.unwrap_or(middle);
    if let Some([c1, c2]) = options.wlf.as_deref() {
        let law = WlfShift::new([*c1, *c2], reference)?;
        let log10_factor = |temperature| law.log10_factor(temperature);
        return shifted_master_curve(isotherms, reference, log10_factor);
    }
    if let Some(energy) = options.arrhenius {
        let zero = if celsius { KELVIN_AT_ZERO_CELSIUS } else { 0.0 };
        let law = ArrheniusShift::new(energy, reference + zero)?;
        let log10_factor = |temperature| law.log10_factor(temperature + zero);
        return shifted_master_curve(isotherms, reference, log10_factor);
    }
    automatic_master_curve(isotherms, reference)
}
