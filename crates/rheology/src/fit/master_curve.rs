//! Master curves: one curve over many decades from isotherms over a few.

use std::f64::consts::LN_10;

use super::curve::{JoinedIsotherms, MeasuredCurve, ModulusPoint};
use super::superposition::{
    LinkedBy, Superposed, SuperpositionOptions, VerticalChoice, VerticalShift, superpose,
};
use crate::RheologyError;

/// Moduli over frequency at one temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct Isotherm {
    /// Temperature, in the unit of the reference temperature.
    pub temperature: f64,
    /// Points at increasing frequencies.
    pub points: Vec<ModulusPoint>,
}

/// Shift factors of an isotherm on a master curve: G*(ω, T) = b_T G*(a_T ω, T_r).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsothermShift {
    /// Temperature, in the unit of the reference temperature.
    pub temperature: f64,
    /// Logarithm log₁₀ a_T of the horizontal shift.
    pub log10_factor: f64,
    /// Vertical shift b_T.
    pub modulus_factor: f64,
    /// Whether the shift follows from the law of other pairs, because a pair between it and the reference overlaps too little.
    pub placed_by_law: bool,
}

/// Isotherms shifted to the reference temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct MasterCurve {
    /// All points at increasing reduced frequencies a_T ω, their moduli divided by b_T.
    pub curve: MeasuredCurve,
    /// Points of the curve, \[rad/s] and \[Pa].
    pub points: Vec<ModulusPoint>,
    /// Index in `shifts` of the isotherm of every point; of one of them for an averaged point.
    pub isotherms: Vec<usize>,
    /// Temperature of the curve.
    pub reference_temperature: f64,
    /// Shifts in the order of the isotherms.
    pub shifts: Vec<IsothermShift>,
    /// Change of the moduli with temperature.
    pub vertical: VerticalShift,
    /// Reason for this change.
    pub vertical_choice: VerticalChoice,
}

impl MasterCurve {
    /// The curve at another temperature, with all times multiplied by `10^log10_factor` and all moduli by `modulus_factor` > 0.
    ///
    /// # Errors
    /// The errors of [`MeasuredCurve::oscillation`] if a frequency or a modulus overflows or underflows.
    pub fn at_temperature(
        mut self,
        temperature: f64,
        log10_factor: f64,
        modulus_factor: f64,
    ) -> Result<Self, RheologyError> {
        // Shift all points to the new temperature: longer times are lower frequencies. The shifts of the isotherms become
        // relative to it.
        let factor = 10_f64.powf(log10_factor);
        for point in &mut self.points {
            point.angular_frequency /= factor;
            point.storage *= modulus_factor;
            point.loss *= modulus_factor;
        }
        for shift in &mut self.shifts {
            shift.log10_factor -= log10_factor;
            shift.modulus_factor /= modulus_factor;
        }
        let mut curve = MeasuredCurve::oscillation(self.points.clone())?;
        if let Some(joined) = self.curve.joined.take() {
            curve = curve.with_isotherms(&self.isotherms, joined);
        }
        Ok(Self {
            curve,
            reference_temperature: temperature,
            ..self
        })
    }
}

/// Master curve with log₁₀ a_T given as a function of temperature.
///
/// The master curve is at the temperature of the isotherm nearest to the requested `temperature`.
///
/// # Errors
/// The errors of `log10_factor` and of [`MeasuredCurve::oscillation`]; [`RheologyError::TooFewPoints`] without an isotherm.
pub fn shifted_master_curve(
    isotherms: &[Isotherm],
    temperature: f64,
    log10_factor: impl Fn(f64) -> Result<f64, RheologyError>,
    options: &SuperpositionOptions,
) -> Result<MasterCurve, RheologyError> {
    let chain = Chain::new(isotherms, temperature)?;
    // Compute the shift of each isotherm by the law, relative to the reference isotherm.
    let log_factor = |isotherm: &Isotherm| Ok(LN_10 * log10_factor(isotherm.temperature)?);
    let known = isotherms.iter().map(log_factor);
    let mut known: Vec<f64> = known.collect::<Result<_, RheologyError>>()?;
    let reference = known[chain.reference];
    known
        .iter_mut()
        .for_each(|log_factor| *log_factor -= reference);
    let superposed = superpose(isotherms, &chain.pairs, Some(&known), options)?;
    join(isotherms, &chain, superposed)
}

/// Master curve with every isotherm shifted onto its neighbour, so that both moduli agree in the overlap.
///
/// Each modulus is weighted by its information on the shift: on a plateau of the storage modulus the loss modulus decides. If
/// the two contradict each other, the storage modulus decides, because it is measured better; on a material that is not
/// quite thermorheologically simple, the loss moduli would separate the curves. An isotherm that overlaps too little with
/// its neighbour is placed by the WLF law through the shifts around it.
///
/// The reference is the isotherm nearest to the `temperature` asked for; the curve belongs to its temperature.
///
/// # Errors
/// - [`RheologyError::OneFrequency`] when one of several isotherms has one point;
/// - [`RheologyError::NoOverlap`] when the moduli of two neighbours differ by more than a quarter at every shift, and no law
///   of others bridges them;
/// - [`RheologyError::TooFewPoints`] without an isotherm, or for one with fewer than two points;
/// - the errors of [`MeasuredCurve::oscillation`].
pub fn automatic_master_curve(
    isotherms: &[Isotherm],
    temperature: f64,
    options: &SuperpositionOptions,
) -> Result<MasterCurve, RheologyError> {
    // An isotherm of one frequency overlaps with no other.
    let is_single = |isotherm: &&Isotherm| isotherm.points.len() == 1;
    if let Some(first) = isotherms.iter().find(is_single)
        && isotherms.len() > 1
    {
        return Err(RheologyError::OneFrequency {
            count: isotherms.iter().filter(is_single).count(),
            given: isotherms.len(),
            temperature: first.temperature,
        });
    }
    let chain = Chain::new(isotherms, temperature)?;
    for isotherm in isotherms {
        MeasuredCurve::oscillation(isotherm.points.clone())?;
    }
    let superposed = superpose(isotherms, &chain.pairs, None, options)?;
    join(isotherms, &chain, superposed)
}

/// Order in which isotherms are shifted onto one another.
struct Chain {
    /// The reference isotherm.
    reference: usize,
    /// Pairs of neighbours from the reference outwards, the isotherm nearer to it first.
    pairs: Vec<[usize; 2]>,
}

impl Chain {
    /// Chain from the isotherm whose temperature is nearest to the given one, through its neighbours by temperature.
    fn new(isotherms: &[Isotherm], temperature: f64) -> Result<Self, RheologyError> {
        // Order the isotherms by temperature, and go from the nearest one upwards, then downwards.
        let mut order: Vec<usize> = (0..isotherms.len()).collect();
        let temperature_of = |place: usize| isotherms[place].temperature;
        order.sort_by(|&a, &b| temperature_of(a).total_cmp(&temperature_of(b)));
        let distance = |place: &usize| (temperature_of(order[*place]) - temperature).abs();
        let nearest = (0..order.len())
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .ok_or(RheologyError::TooFewPoints {
                needed: 1,
                given: 0,
            })?;
        let upwards = (nearest + 1..order.len()).map(|place| [place - 1, place]);
        let downwards = (0..nearest).rev().map(|place| [place + 1, place]);
        let pairs = upwards
            .chain(downwards)
            .map(|pair| pair.map(|place| order[place]));
        Ok(Self {
            reference: order[nearest],
            pairs: pairs.collect(),
        })
    }
}

/// Master curve of all points of the isotherms, with the shifts of their superposition along a chain.
fn join(
    isotherms: &[Isotherm],
    chain: &Chain,
    superposed: Superposed,
) -> Result<MasterCurve, RheologyError> {
    let mut by_law = vec![false; isotherms.len()];
    for link in &superposed.links {
        by_law[link.moved] = by_law[link.fixed] || matches!(link.by, LinkedBy::Law(_));
    }
    // A pair that the law has placed makes all isotherms beyond it depend on the law.
    let shift = |place: usize| IsothermShift {
        temperature: isotherms[place].temperature,
        log10_factor: superposed.log_factors[place] / LN_10,
        modulus_factor: superposed.log_moduli[place].exp(),
        placed_by_law: by_law[place],
    };
    let shifts: Vec<IsothermShift> = (0..isotherms.len()).map(shift).collect();
    // Reduce frequencies and moduli, and sort all points by frequency.
    let pairs = isotherms.iter().zip(&shifts).enumerate();
    let shifted = pairs.flat_map(|(place, (isotherm, shift))| {
        let factor = 10_f64.powf(shift.log10_factor);
        let points = isotherm.points.iter().map(move |point| ModulusPoint {
            angular_frequency: point.angular_frequency * factor,
            storage: point.storage / shift.modulus_factor,
            loss: point.loss / shift.modulus_factor,
        });
        points.map(move |point| (place, point))
    });
    let mut shifted: Vec<(usize, ModulusPoint)> = shifted.collect();
    shifted.sort_by(|(_, a), (_, b)| a.angular_frequency.total_cmp(&b.angular_frequency));
    // Average the moduli of isotherms that meet at one reduced frequency.
    shifted.dedup_by(|(_, next), (_, kept)| {
        let same = next.angular_frequency <= kept.angular_frequency;
        if same {
            kept.storage = 0.5 * (kept.storage + next.storage);
            kept.loss = 0.5 * (kept.loss + next.loss);
        }
        same
    });
    let (places, points): (Vec<usize>, Vec<ModulusPoint>) = shifted.into_iter().unzip();
    let isotherms = JoinedIsotherms {
        temperatures: shifts.iter().map(|shift| shift.temperature).collect(),
        log_factors: superposed.log_factors,
        links: superposed.links,
        undecided: superposed.undecided,
    };
    Ok(MasterCurve {
        curve: MeasuredCurve::oscillation(points.clone())?.with_isotherms(&places, isotherms),
        points,
        isotherms: places,
        reference_temperature: shifts[chain.reference].temperature,
        shifts,
        vertical: superposed.vertical,
        vertical_choice: superposed.choice,
    })
}
