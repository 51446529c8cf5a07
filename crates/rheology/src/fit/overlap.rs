//! Two isotherms on one line: the shift at which their moduli meet.
//!
//! Lines are straight between points of ln ω and ln G' or ln G''. A residual is that of a point of one isotherm beside the line of
//! the other; those of both count, and near the ends of a line they count less, so that nothing jumps where points come to overlap.

use numerics::golden_section;

use super::curve::ModulusPoint;

/// ln of frequencies and of a modulus, straight in between.
pub(super) struct Line(Vec<[f64; 2]>);

/// The storage and the loss modulus of an isotherm.
pub(super) struct Lines([Line; 2]);

/// A line at some frequency.
struct Reading {
    value: f64,
    /// From 0 at the ends of the line to 1 from the second point on.
    weight: f64,
}

/// Residuals of ln of a modulus, the moved isotherm less the one that stays.
#[derive(Debug, Clone, Copy, Default)]
struct Residuals {
    /// Sum of the weights, of the weighted residuals, and of their squares.
    weight: f64,
    sum: f64,
    squares: f64,
}

/// An isotherm beside the one that it is shifted onto.
pub(super) struct Pair<'a> {
    pub(super) fixed: &'a Lines,
    pub(super) moved: &'a Lines,
    /// Variances that residuals of ln G' and ln G'' have by the scatter of points alone.
    pub(super) scatter: [f64; 2],
}

/// What is known of the factor of the moduli of an isotherm over those of the one that stays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ModulusFactor {
    /// ln of it, or of what it is about.
    pub(super) centre: f64,
    /// How far it may be from there, as a standard deviation; none where it is known.
    pub(super) spread: Option<f64>,
}

/// Where an isotherm is put.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// ln of the factor of its frequencies, over that of the isotherm that stays.
    pub(super) log_factor: f64,
    /// ln of the factor of its moduli, over that of the isotherm that stays.
    pub(super) log_modulus: f64,
    /// What the residuals of ln G' and ln G'' are weighed by.
    pub(super) variances: [f64; 2],
    /// Mean squares of these residuals.
    pub(super) mean_squares: [f64; 2],
    /// Weight of the residuals of each, about their number.
    pub(super) overlaps: [f64; 2],
}

impl Place {
    /// Whether the isotherms overlap as little as they may, so that they may be farther apart in truth.
    pub(super) fn is_at_the_end(&self) -> bool {
        self.overlaps[0] < 1.2 * LEAST_OVERLAP
    }
}

/// Weight of residuals below which isotherms have too little in common: about one and a half intervals between points.
const LEAST_OVERLAP: f64 = 2.5;
/// Isotherms whose storage moduli are a quarter apart do not meet.
const FAR: f64 = 0.23;
/// Shifts that are tried, from just touching at one end to just touching at the other.
const N_TRIALS: u32 = 1000;
impl Lines {
    pub(super) fn new(points: &[ModulusPoint]) -> Self {
        let line = |modulus: fn(&ModulusPoint) -> f64| {
            let logs = points
                .iter()
                .map(|point| [point.angular_frequency, modulus(point)].map(f64::ln));
            // A modulus of zero has no logarithm.
            Line(logs.filter(|point| point[1].is_finite()).collect())
        };
        Self([line(|point| point.storage), line(|point| point.loss)])
    }

    /// Squares of the scatter of single points of G' and G'', one for each point that has two neighbours on each side.
    pub(super) fn scatter(&self) -> [Vec<f64>; 2] {
        [0, 1].map(|quantity| {
            let points = self.0[quantity].0.windows(5);
            points.map(squared_scatter).collect()
        })
    }
}

/// The squared distance of the third of five points from the cubic through the others, over the variance of that distance if each
/// point has the variance 1.
fn squared_scatter(five: &[[f64; 2]]) -> f64 {
    let others = [0, 1, 3, 4];
    let factor = |own: usize| -> f64 {
        let rest = others.iter().filter(|other| **other != own);
        rest.map(|&other| (five[2][0] - five[other][0]) / (five[own][0] - five[other][0]))
            .product()
    };
    let [mut distance, mut variance] = [five[2][1], 1.0];
    for own in others {
        let factor = factor(own);
        distance -= factor * five[own][1];
        variance += factor * factor;
    }
    distance * distance / variance
}

impl Line {
    fn ends(&self) -> [f64; 2] {
        [self.0.first(), self.0.last()].map(|point| point.map_or(f64::NAN, |p| p[0]))
    }

    fn at(&self, log_frequency: f64) -> Option<Reading> {
        let next = self.0.partition_point(|point| point[0] < log_frequency);
        let [below, above] = [self.0.get(next.checked_sub(1)?)?, self.0.get(next)?];
        let part = (log_frequency - below[0]) / (above[0] - below[0]);
        Some(Reading {
            value: below[1] + part * (above[1] - below[1]),
            weight: taper(next, self.0.len(), part),
        })
    }
}

/// The weight of a residual in the interval before point `next` of a line of so many points.
pub(super) fn taper(next: usize, n_points: usize, part: f64) -> f64 {
    let from_start = if next == 1 { part } else { 1.0 };
    let to_end = if next + 1 == n_points {
        1.0 - part
    } else {
        1.0
    };
    from_start.min(to_end)
}

impl Residuals {
    fn new(fixed: &Line, moved: &Line, shift: f64) -> Self {
        let mut residuals = Self::default();
        for (points, line, offset, sign) in
            [(moved, fixed, shift, 1.0), (fixed, moved, -shift, -1.0)]
        {
            for [log_frequency, log_modulus] in &points.0 {
                if let Some(other) = line.at(log_frequency + offset) {
                    let residual = sign * (log_modulus - other.value);
                    residuals.weight += other.weight;
                    residuals.sum += other.weight * residual;
                    residuals.squares += other.weight * residual * residual;
                }
            }
        }
        residuals
    }

    /// Sum of the squares when the moved moduli are divided by a factor.
    fn squares(&self, log_modulus: f64) -> f64 {
        let squares = self.squares - log_modulus * (2.0 * self.sum - log_modulus * self.weight);
        squares.max(0.0)
    }

    fn mean_square(&self, log_modulus: f64) -> f64 {
        if self.weight > 0.0 {
            self.squares(log_modulus) / self.weight
        } else {
            0.0
        }
    }
}

impl Pair<'_> {
    fn residuals(&self, shift: f64) -> [Residuals; 2] {
        [0, 1].map(|k| Residuals::new(&self.fixed.0[k], &self.moved.0[k], shift))
    }

    fn place(&self, log_factor: f64, factor: ModulusFactor, variances: [f64; 2]) -> Place {
        let residuals = self.residuals(log_factor);
        let log_modulus = factor.log(&residuals, variances);
        Place {
            log_factor,
            log_modulus,
            variances,
            mean_squares: residuals.map(|one| one.mean_square(log_modulus)),
            overlaps: residuals.map(|one| one.weight),
        }
    }

    /// The place at a shift that is known; none where the isotherms have too little in common there.
    pub(super) fn at(&self, log_factor: f64, factor: ModulusFactor) -> Option<Place> {
        let place = self.place(log_factor, factor, self.scatter);
        let variances = [0, 1].map(|k| self.scatter[k] + place.mean_squares[k]);
        (place.overlaps[0] >= LEAST_OVERLAP).then_some(Place { variances, ..place })
    }

    /// Whether the isotherms, where they overlap at a shift, are near each other.
    pub(super) fn allows(&self, log_factor: f64, factor: ModulusFactor) -> bool {
        let place = self.at(log_factor, factor);
        place.is_none_or(|place| place.mean_squares[0] <= FAR * FAR)
    }

    /// The shift at which both moduli meet best; none where the storage moduli stay apart.
    ///
    /// The storage modulus is the one that is measured well, and where the two contradict each other it decides: the loss
    /// modulus is weighed by what it is off at the shifts that the storage modulus allows. On a plateau that allows them
    /// all, and the loss modulus decides.
    pub(super) fn best(&self, factor: ModulusFactor) -> Option<Place> {
        let [fixed, moved] = [self.fixed, self.moved].map(|lines| lines.0[0].ends());
        let [lowest, highest] = [fixed[0] - moved[1], fixed[1] - moved[0]];
        let step = (highest - lowest) / f64::from(N_TRIALS);
        let trials = (1..N_TRIALS).map(|k| lowest + step * f64::from(k));
        let trials = trials.map(|shift| (shift, self.residuals(shift)));
        let enough = |trial: &(f64, [Residuals; 2])| trial.1[0].weight >= LEAST_OVERLAP;
        let trials: Vec<(f64, [Residuals; 2])> = trials.filter(enough).collect();
        // What each storage modulus leaves by itself.
        let of_storage = |[own, _]: &[Residuals; 2]| {
            let alone = [*own, Residuals::default()];
            own.squares(factor.log(&alone, self.scatter))
        };
        let least_storage = trials
            .iter()
            .map(|(_, both)| of_storage(both) / both[0].weight);
        let least_storage = least_storage.fold(f64::INFINITY, f64::min);
        if least_storage > FAR * FAR {
            return None;
        }
        let storage = self.scatter[0] + least_storage;
        // Within three standard deviations of the sum of the squares that is expected.
        let allowed = trials.iter().filter(|(_, both)| {
            let weight = both[0].weight;
            of_storage(both) <= storage * (weight + 3.0 * (2.0 * weight).sqrt())
        });
        let least_loss =
            allowed.map(|(_, both)| both[1].mean_square(factor.log(both, self.scatter)));
        let least_loss = least_loss.fold(f64::INFINITY, f64::min);
        // What is left of G'' beyond its scatter is no noise: it is alike at all points, which together say no more than one of them.
        let n_points = trials.iter().map(|(_, both)| both[0].weight);
        let n_points = n_points.fold(0.0, f64::max);
        let contradiction = (least_loss - self.scatter[1]).max(0.0);
        let variances = [
            storage,
            self.scatter[1] + least_loss + n_points * contradiction,
        ];
        let cost = |residuals: &[Residuals; 2]| factor.cost(residuals, variances);
        let best = trials
            .iter()
            .min_by(|a, b| cost(&a.1).total_cmp(&cost(&b.1)))?;
        let within = [best.0 - step, best.0 + step];
        let shift = golden_section(|shift| cost(&self.residuals(shift)), within);
        let found = self.place(shift, factor, variances);
        Some(found).filter(|found| found.mean_squares[0] <= FAR * FAR)
    }
}

impl ModulusFactor {
    /// ln of the factor that suits residuals of these variances best.
    fn log(self, residuals: &[Residuals; 2], variances: [f64; 2]) -> f64 {
        let Some(spread) = self.spread else {
            return self.centre;
        };
        let known = spread.powi(-2);
        let parts = residuals.iter().zip(variances);
        let (sum, weight) = parts.fold((0.0, 0.0), |(sum, weight), (one, variance)| {
            (sum + one.sum / variance, weight + one.weight / variance)
        });
        (sum + known * self.centre) / (weight + known)
    }

    /// What is minimised: half the squares over their variances, less what is expected of as many residuals.
    fn cost(self, residuals: &[Residuals; 2], variances: [f64; 2]) -> f64 {
        let log_modulus = self.log(residuals, variances);
        let away = log_modulus - self.centre;
        let known = self.spread.map_or(0.0, |spread| (away / spread).powi(2));
        let parts = residuals.iter().zip(variances);
        let part =
            |(one, variance): (&Residuals, f64)| one.squares(log_modulus) / variance - one.weight;
        0.5 * (known + parts.map(part).sum::<f64>())
    }
}
