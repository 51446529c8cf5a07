//! Shift of a pair of isotherms that do not overlap, by a WLF law through the pairs around it.

use std::f64::consts::LN_10;

use nalgebra::{Matrix2, Vector2};
use numerics::golden_section;

/// A pair of isotherms with a known shift.
pub(super) struct KnownShift {
    /// Index of the pair in the list of links.
    pub(super) link: usize,
    /// Temperatures of both isotherms, \[K].
    pub(super) temperatures: [f64; 2],
    /// ln of the ratio of the frequency factors, second isotherm over first.
    pub(super) log_factor: f64,
}

/// Largest number of known pairs, the nearest ones, to which the law is fitted. Chosen: with more, some may lie on the other side
/// of a glass transition, where another law holds.
const MAX_PAIRS: usize = 4;
/// Largest misfit of the natural logarithm of a shift factor with which the law holds. It is also the largest distance from
/// the law at which a doubtful placement is kept. Chosen: a tenth of a decade, about the error of measured shifts.
pub(super) const LAW_TOLERANCE: f64 = 0.1 * LN_10;
/// Largest ratio of the misfit to the shift of a pair with which the law holds. Chosen: 0.5 K and 0.5 K of error in pairs 10 K
/// apart.
const LAW_RELATIVE_TOLERANCE: f64 = 0.15;
/// Range in which the logarithm of the distance of the pole below the coldest isotherm is searched; the distance is in
/// kelvins. Chosen: 1 K to 8000 K, from a law that changes within a kelvin to one that is nearly a straight line.
const LOG_POLE_RANGE: [f64; 2] = [0.0, 9.0];

/// A shift by the law, and its dependence on the known shifts.
pub(super) struct LawShift {
    /// ln of the ratio of the frequency factors of the pair.
    pub(super) log_factor: f64,
    /// Links of the known pairs with the derivatives of `log_factor` by their shifts.
    pub(super) weights: Vec<(usize, f64)>,
}

/// Shift of a pair of temperatures \[K] by the WLF law through the shifts of the nearest known pairs.
///
/// `None` for fewer than two known pairs, and if the law does not describe them. With a pole at absolute zero it is the law
/// of Arrhenius.
pub(super) fn shift_by_law(mut known: Vec<KnownShift>, sought: [f64; 2]) -> Option<LawShift> {
    // Keep the pairs of isotherms whose mean temperature is nearest to that of the sought pair.
    let middle = |[one, other]: [f64; 2]| one.midpoint(other);
    let distance = |pair: &KnownShift| (middle(pair.temperatures) - middle(sought)).abs();
    known.sort_by(|one, other| distance(one).total_cmp(&distance(other)));
    known.truncate(MAX_PAIRS);
    if known.len() < 2 {
        return None;
    }
    let temperatures = known.iter().map(|pair| pair.temperatures).chain([sought]);
    let coldest = temperatures.flatten().fold(f64::INFINITY, f64::min);
    // Fit the law by least squares: its steepness is linear and follows from a formula, its pole is found by search.
    let law = |log_pole: f64| {
        let mut law = Law {
            coldest,
            pole: log_pole.exp(),
            steepness: 0.0,
        };
        let [products, squares] = known.iter().fold([0.0; 2], |[products, squares], pair| {
            let own = law.shift_per_steepness(pair.temperatures);
            [products + own * pair.log_factor, squares + own * own]
        });
        law.steepness = products / squares;
        law
    };
    let misfit = |law: &Law, pair: &KnownShift| law.shift(pair.temperatures) - pair.log_factor;
    let squares = |log_pole: f64| {
        let law = law(log_pole);
        known
            .iter()
            .map(|pair| misfit(&law, pair).powi(2))
            .sum::<f64>()
    };
    let law = law(golden_section(squares, LOG_POLE_RANGE));
    let holds = known.iter().all(|pair| {
        let tolerance = LAW_TOLERANCE.max(LAW_RELATIVE_TOLERANCE * pair.log_factor.abs());
        misfit(&law, pair).abs() <= tolerance
    });
    if !holds || law.steepness <= 0.0 {
        return None;
    }
    // Propagate the known shifts through the least squares.
    let derivatives: Vec<Vector2<f64>> = known
        .iter()
        .map(|pair| law.derivatives(pair.temperatures))
        .collect();
    let normal: Matrix2<f64> = derivatives.iter().map(|own| own * own.transpose()).sum();
    // If the pole is distant, its effect is indistinguishable from that of the steepness; a ridge keeps the matrix regular.
    let ridge = Matrix2::from_diagonal(&(normal.diagonal() * NORMAL_ROUNDING));
    let of_sought = (normal + ridge).try_inverse()? * law.derivatives(sought);
    let weights = known
        .iter()
        .zip(&derivatives)
        .map(|(pair, own)| (pair.link, own.dot(&of_sought)));
    Some(LawShift {
        log_factor: law.shift(sought),
        weights: weights.collect(),
    })
}

/// Ratio of the ridge of the normal equations to their diagonal. Chosen, above rounding.
const NORMAL_ROUNDING: f64 = 1e-9;

/// WLF law d ln a/dT = −k/(T − T_∞)² with the pole T_∞.
struct Law {
    /// Lowest temperature of the isotherms T_c, \[K].
    coldest: f64,
    /// Distance T_c − T_∞ of the pole, \[K].
    pole: f64,
    /// Steepness k/(T_c − T_∞).
    steepness: f64,
}

impl Law {
    /// Ratios (T_c − T_∞)/(T − T_∞) at both temperatures \[K].
    fn relative_poles(&self, temperatures: [f64; 2]) -> [f64; 2] {
        temperatures.map(|temperature| self.pole / (temperature - self.coldest + self.pole))
    }

    /// Shift ln a of a pair of temperatures \[K] by a law of steepness 1: the difference of the ratios, second less first.
    fn shift_per_steepness(&self, temperatures: [f64; 2]) -> f64 {
        let [from, to] = self.relative_poles(temperatures);
        to - from
    }

    /// Shift ln a of the second isotherm of a pair less that of the first, at their temperatures \[K].
    fn shift(&self, temperatures: [f64; 2]) -> f64 {
        self.steepness * self.shift_per_steepness(temperatures)
    }

    /// Derivatives of the shift of a pair of temperatures \[K] by the steepness and by ln of the pole distance, in this order.
    fn derivatives(&self, temperatures: [f64; 2]) -> Vector2<f64> {
        // Differentiate the relative pole r = p/(T − T_c + p) by the logarithm of its distance p below the coldest temperature
        // T_c: d r/d ln p = r (1 − r).
        let [from, to] = self
            .relative_poles(temperatures)
            .map(|inverse| inverse * (1.0 - inverse));
        Vector2::new(
            self.shift_per_steepness(temperatures),
            self.steepness * (to - from),
        )
    }
}
