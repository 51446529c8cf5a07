//! A pair of isotherms that do not overlap, by the law of the pairs around it.

use std::f64::consts::LN_10;

use nalgebra::{Matrix2, Vector2};
use numerics::golden_section;

/// A pair whose shift is known.
pub(super) struct Known {
    /// What it is called by.
    pub(super) link: usize,
    /// Those of both isotherms, \[K].
    pub(super) temperatures: [f64; 2],
    /// ln of the factor of the frequencies of the second isotherm over that of the first.
    pub(super) log_factor: f64,
}

/// Pairs beside the one that is sought, the nearest ones: farther away the law may be another one, as on the other side of the glass
/// transition.
const N_PAIRS: usize = 4;
/// Distance from the law within which it holds, in ln a: a tenth of a decade, or this part of the shift of a pair, because temperatures
/// of isotherms that are ten kelvins apart are known to half a kelvin.
pub(super) const HOLDS: f64 = 0.1 * LN_10;
const HOLDS_IN_PART: f64 = 0.15;
/// ln of how far below the coldest isotherm the pole of the law may be, \[K].
const POLES: [f64; 2] = [0.0, 9.0];

/// The shift of a pair of temperatures \[K] by the law of Williams, Landel and Ferry through those of the pairs nearest to it, and
/// the part of each of these in it; none of fewer than two, or where the law does not hold for them.
///
/// With C₂ = T_r it is the law of Arrhenius.
pub(super) fn bridged(mut known: Vec<Known>, sought: [f64; 2]) -> Option<(f64, Vec<(usize, f64)>)> {
    let middle = |[one, other]: [f64; 2]| one.midpoint(other);
    let distance = |pair: &Known| (middle(pair.temperatures) - middle(sought)).abs();
    known.sort_by(|one, other| distance(one).total_cmp(&distance(other)));
    known.truncate(N_PAIRS);
    if known.len() < 2 {
        return None;
    }
    let temperatures = known.iter().map(|pair| pair.temperatures).chain([sought]);
    let coldest = temperatures.flatten().fold(f64::INFINITY, f64::min);
    let law = |log_pole: f64| {
        let mut law = Law {
            coldest,
            pole: log_pole.exp(),
            steepness: 0.0,
        };
        let [products, squares] = known.iter().fold([0.0; 2], |[products, squares], pair| {
            let own = law.per_steepness(pair.temperatures);
            [products + own * pair.log_factor, squares + own * own]
        });
        law.steepness = products / squares;
        law
    };
    let off = |law: &Law, pair: &Known| law.shift(pair.temperatures) - pair.log_factor;
    let squares = |log_pole: f64| {
        let law = law(log_pole);
        known
            .iter()
            .map(|pair| off(&law, pair).powi(2))
            .sum::<f64>()
    };
    let law = law(golden_section(squares, POLES));
    let holds = known.iter().all(|pair| {
        let holds = HOLDS.max(HOLDS_IN_PART * pair.log_factor.abs());
        off(&law, pair).abs() <= holds
    });
    if !holds || law.steepness <= 0.0 {
        return None;
    }
    let derivatives: Vec<Vector2<f64>> = known
        .iter()
        .map(|pair| law.derivatives(pair.temperatures))
        .collect();
    let normal: Matrix2<f64> = derivatives.iter().map(|own| own * own.transpose()).sum();
    // With a pole far away the two constants are one.
    let ridge = Matrix2::from_diagonal(&(normal.diagonal() * ROUNDING));
    let of_sought = (normal + ridge).try_inverse()? * law.derivatives(sought);
    let parts = known
        .iter()
        .zip(&derivatives)
        .map(|(pair, own)| (pair.link, own.dot(&of_sought)));
    Some((law.shift(sought), parts.collect()))
}

/// Part of the diagonal of the normal equations that is rounding.
const ROUNDING: f64 = 1e-9;

/// d ln a/dT = −k/(T − T_∞)².
struct Law {
    coldest: f64,
    /// How far below the coldest isotherm T_∞ is.
    pole: f64,
    /// k in the unit of `pole`.
    steepness: f64,
}

impl Law {
    /// Of the pole at both temperatures, over its distance from the coldest.
    fn inverses(&self, temperatures: [f64; 2]) -> [f64; 2] {
        temperatures.map(|temperature| self.pole / (temperature - self.coldest + self.pole))
    }

    fn per_steepness(&self, temperatures: [f64; 2]) -> f64 {
        let [from, to] = self.inverses(temperatures);
        to - from
    }

    fn shift(&self, temperatures: [f64; 2]) -> f64 {
        self.steepness * self.per_steepness(temperatures)
    }

    /// By the steepness and by ln of the pole.
    fn derivatives(&self, temperatures: [f64; 2]) -> Vector2<f64> {
        // p/(T − T_c + p) changes by its own part that is left to 1.
        let [from, to] = self
            .inverses(temperatures)
            .map(|inverse| inverse * (1.0 - inverse));
        Vector2::new(
            self.per_steepness(temperatures),
            self.steepness * (to - from),
        )
    }
}
