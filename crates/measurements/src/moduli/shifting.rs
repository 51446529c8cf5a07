//! Master curves of measured isotherms at a given reference temperature.

use numerics::finite;
use rheology::fit::{
    Isotherm, IsothermShift, MasterCurve, SuperpositionOptions, VerticalShift,
    automatic_master_curve, shifted_master_curve,
};
use rheology::{
    ArrheniusShift, KELVIN_AT_ZERO_CELSIUS, RheologyError, Shift, ShiftLaw, VerticalLaw, WlfShift,
};

/// Options for shifting isotherms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shifting {
    /// Reference temperature in the unit of the table; `None` for that of the middle isotherm.
    pub reference_temperature: Option<f64>,
    /// Shift law about the reference temperature; `None` shifts the isotherms onto one another.
    pub law: Option<ShiftLaw>,
    /// Temperature of the master curve in the unit of the table; `None` for the reference temperature.
    ///
    /// The two differ only for a given law, whose constants are those about the reference temperature.
    pub temperature: Option<f64>,
    /// Vertical shift of the moduli; `None` lets the isotherms decide.
    pub vertical: Option<VerticalShift>,
}

/// A master curve and its shift law.
#[derive(Debug, Clone, PartialEq)]
pub struct Shifted {
    /// Master curve with temperatures in the unit of the table.
    pub master: MasterCurve,
    /// Given law, or law fitted to the shifts, with its range of temperatures.
    ///
    /// A fitted law deviates from the shifts in its range by at most a tenth of a decade. `None` for one isotherm, and if
    /// warmer isotherms are not faster.
    pub shift: Option<Shift>,
}

/// Master curve of isotherms, whose temperatures are in °C or in K.
///
/// Between two isotherms it is that of the nearest one, shifted by the law of the isotherms around it.
///
/// # Errors
/// The errors of [`automatic_master_curve`] and [`shifted_master_curve`]; [`RheologyError::OutsideShiftLaw`] beyond the range
/// of the isotherms; [`RheologyError::NoShiftLaw`] if no law describes the shifts.
pub fn master_curve(
    isotherms: &[Isotherm],
    celsius: bool,
    shifting: Shifting,
) -> Result<Shifted, RheologyError> {
    let table = Table {
        isotherms,
        to_celsius: if celsius {
            0.0
        } else {
            -KELVIN_AT_ZERO_CELSIUS
        },
    };
    let temperatures = table.temperatures();
    let middle = temperatures
        .get(temperatures.len() / 2)
        .ok_or(RheologyError::TooFewPoints {
            needed: 1,
            given: 0,
        })?;
    let reference = shifting.reference_temperature.unwrap_or(*middle);
    finite("reference_temperature", reference)?;
    let wanted = shifting.temperature.unwrap_or(reference);
    finite("temperature", wanted)?;
    let options = SuperpositionOptions {
        vertical: shifting.vertical,
        kelvin_at_zero: table.to_celsius + KELVIN_AT_ZERO_CELSIUS,
    };
    match shifting.law {
        Some(law) => {
            let law = table.law_about(wanted, law, reference)?;
            table.by_law(wanted, law, &options)
        }
        None => table.automatic(wanted, &options),
    }
}

/// Isotherms of a table.
struct Table<'a> {
    /// Isotherms in the order of the table, with temperatures in its unit.
    isotherms: &'a [Isotherm],
    /// Offset from the temperatures of the table to °C.
    to_celsius: f64,
}

impl Table<'_> {
    /// Temperatures of the isotherms in increasing order.
    fn temperatures(&self) -> Vec<f64> {
        let temperatures = self.isotherms.iter().map(|one| one.temperature);
        let mut temperatures: Vec<f64> = temperatures.collect();
        temperatures.sort_by(f64::total_cmp);
        temperatures
    }

    /// A law with its constants about the `reference` temperature, for all isotherms and the `wanted` temperature.
    fn shift_about(&self, reference: f64, law: ShiftLaw, wanted: f64) -> Shift {
        let celsius = |temperature: f64| temperature + self.to_celsius;
        let all = self.temperatures().into_iter().chain([reference, wanted]);
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        Shift {
            temperature: celsius(reference),
            temperature_range: all
                .map(celsius)
                .fold(start, |[low, high], one| [low.min(one), high.max(one)]),
            law,
            vertical: None,
        }
    }

    /// A law about the `reference` temperature, with its constants about the `wanted` temperature.
    fn law_about(
        &self,
        wanted: f64,
        law: ShiftLaw,
        reference: f64,
    ) -> Result<ShiftLaw, RheologyError> {
        if wanted.total_cmp(&reference).is_eq() {
            return Ok(law);
        }
        let shift = self.shift_about(reference, law, wanted);
        Ok(shift.with_reference(wanted + self.to_celsius)?.law)
    }

    /// Master curve at the temperature `wanted`, in the unit of the table, shifted by a given law about it.
    fn by_law(
        &self,
        wanted: f64,
        law: ShiftLaw,
        options: &SuperpositionOptions,
    ) -> Result<Shifted, RheologyError> {
        let celsius = |temperature: f64| temperature + self.to_celsius;
        let mut shift = self.shift_about(wanted, law, wanted);
        let log10_factor = |temperature| shift.log10_factor(celsius(temperature));
        let master = shifted_master_curve(self.isotherms, wanted, log10_factor, options)?;
        shift.vertical = self.vertical_law(&master);
        // The master curve is at the nearest isotherm: shift it from there to the wanted temperature by the law.
        let nearest = celsius(master.reference_temperature);
        let [log10_factor, modulus_factor] = [
            -shift.log10_factor(nearest)?,
            shift.modulus_factor(nearest)?.recip(),
        ];
        Ok(Shifted {
            master: master.at_temperature(wanted, log10_factor, modulus_factor)?,
            shift: Some(shift),
        })
    }

    /// Master curve of isotherms shifted onto one another. If none has the temperature `wanted`, in the unit of the table, it
    /// is shifted there by a law fitted to the shifts.
    fn automatic(
        &self,
        wanted: f64,
        options: &SuperpositionOptions,
    ) -> Result<Shifted, RheologyError> {
        let celsius = |temperature: f64| temperature + self.to_celsius;
        let master = automatic_master_curve(self.isotherms, wanted, options)?;
        let nearest = master.reference_temperature;
        let pair = |shift: &IsothermShift| [celsius(shift.temperature), shift.log10_factor];
        let mut shifts: Vec<[f64; 2]> = master.shifts.iter().map(pair).collect();
        shifts.sort_by(|one, other| one[0].total_cmp(&other[0]));
        // The law is needed to go on to another temperature, and kept with the master curve if there is one.
        let vertical = self.vertical_law(&master);
        let shift =
            fit_law_around(&shifts, [nearest, wanted].map(celsius)).map(|horizontal| Shift {
                vertical,
                ..horizontal
            });
        if wanted.total_cmp(&nearest).is_eq() {
            return Ok(Shifted { master, shift });
        }
        let shift = shift.ok_or(RheologyError::NoShiftLaw {
            temperature: wanted,
            nearest,
        })?;
        let log10_factor = shift.log10_factor(celsius(wanted))?;
        let modulus_factor = shift.modulus_factor(celsius(wanted))?;
        Ok(Shifted {
            master: master.at_temperature(wanted, log10_factor, modulus_factor)?,
            shift: Some(shift.with_reference(celsius(wanted))?),
        })
    }

    /// Law of the factor b_T on the moduli of a master curve, over °C; `None` if moduli do not change.
    fn vertical_law(&self, master: &MasterCurve) -> Option<VerticalLaw> {
        let of_isotherm =
            |shift: &IsothermShift| [shift.temperature + self.to_celsius, shift.modulus_factor];
        match master.vertical {
            VerticalShift::None => None,
            VerticalShift::Entropic => Some(VerticalLaw::Entropic),
            VerticalShift::Free => {
                let mut table: Vec<[f64; 2]> = master.shifts.iter().map(of_isotherm).collect();
                table.sort_by(|one, other| one[0].total_cmp(&other[0]));
                // If several isotherms have the same temperature, the table of vertical shifts keeps the first.
                table.dedup_by(|next, kept| next[0] <= kept[0]);
                Some(VerticalLaw::Table(table))
            }
        }
    }
}

/// Largest deviation, in decades, with which a law still describes measured shifts; isotherms beyond it are outside its range.
/// Chosen.
const LAW_TOLERANCE: f64 = 0.1;

/// Fits a law about the `nearest` isotherm, and extends its range from the `wanted` temperature outwards while it holds.
///
/// Shifts are pairs of °C and log₁₀ a_T in increasing order of temperature.
fn fit_law_around(shifts: &[[f64; 2]], [nearest, wanted]: [f64; 2]) -> Option<Shift> {
    let mut order: Vec<usize> = (0..shifts.len()).collect();
    let distance = |place: &usize| (shifts[*place][0] - wanted).abs();
    order.sort_by(|one, other| distance(one).total_cmp(&distance(other)));
    let start = shifts
        .iter()
        .position(|shift| shift[0].total_cmp(&nearest).is_eq())?;
    let [mut first, mut last] = [start; 2];
    let mut found = None;
    for place in order {
        // The range is contiguous: it does not continue beyond an isotherm that deviates.
        if place + 1 != first && place != last + 1 {
            continue;
        }
        let held = &shifts[first.min(place)..=last.max(place)];
        if let Some(shift) =
            fit_closest_law(held, nearest).filter(|shift| deviation(shift, held) <= LAW_TOLERANCE)
        {
            [first, last] = [first.min(place), last.max(place)];
            found = Some(shift);
        }
    }
    found
}

/// The law of WLF or of Arrhenius, about the temperature `reference` \[°C], with the smaller largest deviation from the shifts
/// (°C, log₁₀ a_T); `None` if neither can be fitted.
fn fit_closest_law(shifts: &[[f64; 2]], reference: f64) -> Option<Shift> {
    let kelvin = |celsius: f64| celsius + KELVIN_AT_ZERO_CELSIUS;
    let in_kelvin: Vec<[f64; 2]> = shifts.iter().map(|[t, log]| [kelvin(*t), *log]).collect();
    let wlf = WlfShift::fit(shifts, reference);
    let arrhenius = ArrheniusShift::fit(&in_kelvin, kelvin(reference));
    let laws = [
        wlf.map(|law| ShiftLaw::Wlf(law.constants())),
        arrhenius.map(|law| ShiftLaw::Arrhenius(law.activation_energy())),
    ];
    let shift = |law| Shift {
        temperature: reference,
        temperature_range: [shifts[0][0], shifts[shifts.len() - 1][0]],
        law,
        vertical: None,
    };
    let misfit = |shift: &Shift| deviation(shift, shifts);
    laws.into_iter()
        .filter_map(Result::ok)
        .map(shift)
        .min_by(|one, other| misfit(one).total_cmp(&misfit(other)))
}

/// Largest deviation of shifts from a law, in decades.
fn deviation(shift: &Shift, shifts: &[[f64; 2]]) -> f64 {
    let misfits = shifts.iter().map(|[temperature, log]| {
        let of_law = shift.log10_factor(*temperature);
        of_law.map_or(f64::INFINITY, |of_law| (of_law - log).abs())
    });
    misfits.fold(0.0, f64::max)
}
