//! Isotherms onto one curve, at exactly the temperature that is wanted.

use numerics::finite;
use rheology::fit::{
    Isotherm, IsothermShift, MasterCurve, SuperpositionOptions, VerticalShift,
    automatic_master_curve, shifted_master_curve,
};
use rheology::{
    ArrheniusShift, KELVIN_AT_ZERO_CELSIUS, RheologyError, Shift, ShiftLaw, VerticalLaw, WlfShift,
};

/// How isotherms are shifted.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shifting {
    /// Temperature at which the material is wanted, in the unit of the table; without it that of the isotherm in the middle.
    pub reference_temperature: Option<f64>,
    /// The law, about that temperature; without one the isotherms are shifted onto one another.
    pub law: Option<ShiftLaw>,
    /// How the moduli change with temperature; without it as the isotherms show.
    pub vertical: Option<VerticalShift>,
}

/// Isotherms as one curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Shifted {
    /// Temperatures in the unit of the table.
    pub master: MasterCurve,
    /// The law that was given, or that is within a tenth of a decade of the shifts, with the temperatures at which it is; none of one
    /// isotherm, or where the warmer is not the faster.
    pub shift: Option<Shift>,
}

/// The master curve of `isotherms`, whose temperatures are in °C or in K.
///
/// Between two isotherms it is that of the nearest one, shifted by the law of those around.
///
/// # Errors
/// Those of [`automatic_master_curve`] and [`shifted_master_curve`]; [`RheologyError::OutsideShiftLaw`] where the law would have to
/// continue beyond the isotherms, and [`RheologyError::NoShiftLaw`] where none describes the shifts.
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
    let middle = temperatures.get(temperatures.len() / 2);
    let middle = middle.ok_or(RheologyError::TooFewPoints {
        needed: 1,
        given: 0,
    })?;
    let wanted = shifting.reference_temperature.unwrap_or(*middle);
    finite("reference_temperature", wanted)?;
    let options = SuperpositionOptions {
        vertical: shifting.vertical,
        kelvin_at_zero: table.to_celsius + KELVIN_AT_ZERO_CELSIUS,
    };
    match shifting.law {
        Some(law) => table.by_law(wanted, law, &options),
        None => table.automatic(wanted, &options),
    }
}

/// Isotherms of a table.
struct Table<'a> {
    isotherms: &'a [Isotherm],
    /// What is to be added to their temperatures for °C.
    to_celsius: f64,
}

impl Table<'_> {
    /// From the lowest one on.
    fn temperatures(&self) -> Vec<f64> {
        let temperatures = self.isotherms.iter().map(|one| one.temperature);
        let mut temperatures: Vec<f64> = temperatures.collect();
        temperatures.sort_by(f64::total_cmp);
        temperatures
    }

    /// By a law about the temperature that is wanted.
    fn by_law(
        &self,
        wanted: f64,
        law: ShiftLaw,
        options: &SuperpositionOptions,
    ) -> Result<Shifted, RheologyError> {
        let celsius = |temperature: f64| temperature + self.to_celsius;
        let all = self.temperatures().into_iter().chain([wanted]).map(celsius);
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        let mut shift = Shift {
            temperature: celsius(wanted),
            temperature_range: all.fold(start, |[low, high], one| [low.min(one), high.max(one)]),
            law,
            vertical: None,
        };
        let log10_factor = |temperature| shift.log10_factor(celsius(temperature));
        let master = shifted_master_curve(self.isotherms, wanted, log10_factor, options)?;
        shift.vertical = self.vertical_law(&master);
        let nearest = celsius(master.reference_temperature);
        let [log10_factor, modulus_factor] = [
            -shift.log10_factor(nearest)?,
            shift.modulus_factor(nearest)?.recip(),
        ];
        Ok(Shifted {
            master: master.about(wanted, log10_factor, modulus_factor)?,
            shift: Some(shift),
        })
    }

    /// Onto one another, and to the temperature that is wanted by the law of the shifts.
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
        let shift = law_around(&shifts, [nearest, wanted].map(celsius));
        let vertical = self.vertical_law(&master);
        let shift = shift.map(|shift| Shift { vertical, ..shift });
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
            master: master.about(wanted, log10_factor, modulus_factor)?,
            shift: Some(shift.about(celsius(wanted))?),
        })
    }

    /// How the moduli of a master curve change with temperature.
    fn vertical_law(&self, master: &MasterCurve) -> Option<VerticalLaw> {
        let of_isotherm =
            |shift: &IsothermShift| [shift.temperature + self.to_celsius, shift.modulus_factor];
        match master.vertical {
            VerticalShift::None => None,
            VerticalShift::Entropic => Some(VerticalLaw::Entropic),
            VerticalShift::Free => {
                let mut table: Vec<[f64; 2]> = master.shifts.iter().map(of_isotherm).collect();
                table.sort_by(|one, other| one[0].total_cmp(&other[0]));
                // Isotherms of the same temperature: the first one.
                table.dedup_by(|next, kept| next[0] <= kept[0]);
                Some(VerticalLaw::Table(table))
            }
        }
    }
}

/// Distance of shifts from a law, in decades, within which the law holds.
const HOLDS: f64 = 0.1;

/// The law about the `nearest` isotherm, and the temperatures up to which it holds, found from the one that is `wanted`
/// outwards. Shifts are pairs of °C and log₁₀ a_T, the colder first.
fn law_around(shifts: &[[f64; 2]], [nearest, wanted]: [f64; 2]) -> Option<Shift> {
    let mut order: Vec<usize> = (0..shifts.len()).collect();
    let distance = |place: &usize| (shifts[*place][0] - wanted).abs();
    order.sort_by(|one, other| distance(one).total_cmp(&distance(other)));
    let start = shifts
        .iter()
        .position(|shift| shift[0].total_cmp(&nearest).is_eq())?;
    let [mut first, mut last] = [start; 2];
    let mut found = None;
    for place in order {
        // Beyond an isotherm that is off the law does not come back.
        if place + 1 != first && place != last + 1 {
            continue;
        }
        let held = &shifts[first.min(place)..=last.max(place)];
        if let Some(shift) = closest(held, nearest).filter(|shift| deviation(shift, held) <= HOLDS)
        {
            [first, last] = [first.min(place), last.max(place)];
            found = Some(shift);
        }
    }
    found
}

/// The law of Williams, Landel and Ferry or that of Arrhenius, whichever comes closer.
fn closest(shifts: &[[f64; 2]], reference: f64) -> Option<Shift> {
    let kelvin = |celsius: f64| celsius + KELVIN_AT_ZERO_CELSIUS;
    let in_kelvin: Vec<[f64; 2]> = shifts.iter().map(|[t, log]| [kelvin(*t), *log]).collect();
    let wlf = WlfShift::through(shifts, reference);
    let arrhenius = ArrheniusShift::through(&in_kelvin, kelvin(reference));
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
    let off = |shift: &Shift| deviation(shift, shifts);
    let laws = laws.into_iter().filter_map(Result::ok).map(shift);
    laws.min_by(|one, other| off(one).total_cmp(&off(other)))
}

/// How far shifts are from a law at most.
fn deviation(shift: &Shift, shifts: &[[f64; 2]]) -> f64 {
    let off = shifts.iter().map(|[temperature, log]| {
        let of_law = shift.log10_factor(*temperature);
        of_law.map_or(f64::INFINITY, |of_law| (of_law - log).abs())
    });
    off.fold(0.0, f64::max)
}
