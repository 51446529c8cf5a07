//! One curve over many decades from isotherms over a few.

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

/// Where an isotherm is on a master curve: G*(ω, T) = b_T G*(a_T ω, T_r).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsothermShift {
    /// Temperature, in the unit of the reference temperature.
    pub temperature: f64,
    /// log₁₀ a_T.
    pub log10_factor: f64,
    /// b_T.
    pub modulus_factor: f64,
    /// Whether it overlaps too little with its neighbour, so that the law of the others says where it, and what is beyond it, belongs.
    pub placed_by_law: bool,
}

/// Isotherms shifted to the reference temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct MasterCurve {
    /// All points at increasing reduced frequencies a_T ω, their moduli divided by b_T.
    pub curve: MeasuredCurve,
    /// The same points, \[rad/s] and \[Pa].
    pub points: Vec<ModulusPoint>,
    /// The isotherm of every point, by its place in `shifts`; of points that were averaged that of one of them.
    pub isotherms: Vec<usize>,
    /// Temperature that the curve belongs to.
    pub reference_temperature: f64,
    /// In the order of the isotherms.
    pub shifts: Vec<IsothermShift>,
    /// How the moduli change with temperature.
    pub vertical: VerticalShift,
    /// Why they are taken to.
    pub vertical_choice: VerticalChoice,
}

impl MasterCurve {
    /// The same at another temperature, at which all times are `10^log10_factor` and all moduli `modulus_factor` > 0 of those at this one.
    ///
    /// # Errors
    /// Those of [`MeasuredCurve::oscillation`], where a frequency or a modulus leaves the range of `f64`.
    pub fn about(
        mut self,
        temperature: f64,
        log10_factor: f64,
        modulus_factor: f64,
    ) -> Result<Self, RheologyError> {
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
            curve = curve.of_isotherms(&self.isotherms, joined);
        }
        Ok(Self {
            curve,
            reference_temperature: temperature,
            ..self
        })
    }
}

/// The master curve at the temperature of the isotherm that is nearest to the one asked for, with log₁₀ a_T given as a function of
/// temperature.
///
/// # Errors
/// Those of `log10_factor`, of [`MeasuredCurve::oscillation`], and [`RheologyError::TooFewPoints`] without an isotherm.
pub fn shifted_master_curve(
    isotherms: &[Isotherm],
    temperature: f64,
    log10_factor: impl Fn(f64) -> Result<f64, RheologyError>,
    options: &SuperpositionOptions,
) -> Result<MasterCurve, RheologyError> {
    let chain = Chain::new(isotherms, temperature)?;
    let log_factor = |isotherm: &Isotherm| Ok(LN_10 * log10_factor(isotherm.temperature)?);
    let known = isotherms.iter().map(log_factor);
    let mut known: Vec<f64> = known.collect::<Result<_, RheologyError>>()?;
    let reference = known[chain.reference];
    known
        .iter_mut()
        .for_each(|log_factor| *log_factor -= reference);
    let superposed = superpose(isotherms, &chain.pairs, Some(&known), options)?;
    joined(isotherms, &chain, superposed)
}

/// The master curve with every isotherm shifted onto its neighbour, so that both moduli lie on one line where they overlap.
///
/// Each modulus is weighed by what it says: on a plateau of the storage modulus the loss modulus decides. Where the two contradict
/// each other the storage modulus does: it is the one that is measured well, and on a material that is not quite
/// thermorheologically simple the loss moduli would pull the curves apart. An isotherm that has too little in common with its
/// neighbour is placed by the law of Williams, Landel and Ferry through the shifts around it.
///
/// The isotherm nearest to the temperature asked for stays where it is; the curve belongs to its temperature.
///
/// # Errors
/// [`RheologyError::OneFrequency`] when one of several isotherms has one point; [`RheologyError::NoOverlap`] when two neighbours
/// stay farther apart than a quarter of their moduli, and no law of others bridges that; [`RheologyError::TooFewPoints`]
/// when there is no isotherm, or one with less than two points; those of [`MeasuredCurve::oscillation`].
pub fn automatic_master_curve(
    isotherms: &[Isotherm],
    temperature: f64,
    options: &SuperpositionOptions,
) -> Result<MasterCurve, RheologyError> {
    let single = |isotherm: &&Isotherm| isotherm.points.len() == 1;
    if let Some(first) = isotherms.iter().find(single)
        && isotherms.len() > 1
    {
        return Err(RheologyError::OneFrequency {
            count: isotherms.iter().filter(single).count(),
            given: isotherms.len(),
            temperature: first.temperature,
        });
    }
    let chain = Chain::new(isotherms, temperature)?;
    for isotherm in isotherms {
        MeasuredCurve::oscillation(isotherm.points.clone())?;
    }
    let superposed = superpose(isotherms, &chain.pairs, None, options)?;
    joined(isotherms, &chain, superposed)
}

/// In which order isotherms are shifted onto one another.
struct Chain {
    /// The isotherm that stays where it is.
    reference: usize,
    /// Of an isotherm and its neighbour that is farther from the reference, from that one outwards.
    pairs: Vec<[usize; 2]>,
}

impl Chain {
    /// From the isotherm whose temperature is nearest.
    fn new(isotherms: &[Isotherm], temperature: f64) -> Result<Self, RheologyError> {
        let mut order: Vec<usize> = (0..isotherms.len()).collect();
        let temperature_of = |place: usize| isotherms[place].temperature;
        order.sort_by(|&a, &b| temperature_of(a).total_cmp(&temperature_of(b)));
        let distance = |place: &usize| (temperature_of(order[*place]) - temperature).abs();
        let nearest = (0..order.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let nearest = nearest.ok_or(RheologyError::TooFewPoints {
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

fn joined(
    isotherms: &[Isotherm],
    chain: &Chain,
    superposed: Superposed,
) -> Result<MasterCurve, RheologyError> {
    let mut by_law = vec![false; isotherms.len()];
    for link in &superposed.links {
        by_law[link.moved] = by_law[link.fixed] || matches!(link.by, LinkedBy::Law(_));
    }
    let shift = |place: usize| IsothermShift {
        temperature: isotherms[place].temperature,
        log10_factor: superposed.log_factors[place] / LN_10,
        modulus_factor: superposed.log_moduli[place].exp(),
        placed_by_law: by_law[place],
    };
    let shifts: Vec<IsothermShift> = (0..isotherms.len()).map(shift).collect();
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
    // Two isotherms may meet at one reduced frequency: there the mean of both is the measurement.
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
        curve: MeasuredCurve::oscillation(points.clone())?.of_isotherms(&places, isotherms),
        points,
        isotherms: places,
        reference_temperature: shifts[chain.reference].temperature,
        shifts,
        vertical: superposed.vertical,
        vertical_choice: superposed.choice,
    })
}
