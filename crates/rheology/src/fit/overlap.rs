//! Shift of two overlapping isotherms at which their moduli agree.
//!
//! Curves are piecewise linear in ln ω and ln G' or ln G''. A residual is the distance of a point of one isotherm from the curve
//! of the other; the residuals of both are used. Their weights taper to zero at the ends of a curve, so that the sum of
//! squares is continuous in the shift.

use numerics::golden_section;

use super::curve::ModulusPoint;

/// Points of ln ω and ln of a modulus, with linear interpolation.
pub(super) struct LogCurve(Vec<[f64; 2]>);

/// Curves of the storage and the loss modulus of an isotherm.
pub(super) struct LogCurves([LogCurve; 2]);

/// Value of a curve at a frequency.
struct Interpolated {
    /// ln of the modulus.
    value: f64,
    /// Weight from 0 at the ends of the curve to 1 from the second point on.
    weight: f64,
}

/// Sums of the residuals of ln of a modulus, moved isotherm less fixed one.
#[derive(Debug, Clone, Copy, Default)]
struct Residuals {
    /// Sum of the weights.
    weight: f64,
    /// Weighted sum of the residuals.
    sum: f64,
    /// Weighted sum of the squares of the residuals.
    squares: f64,
}

/// An isotherm and the one that it is shifted onto.
pub(super) struct Pair<'a> {
    /// Curves of the isotherm that stays.
    pub(super) fixed: &'a LogCurves,
    /// Curves of the isotherm that is shifted.
    pub(super) moved: &'a LogCurves,
    /// Variances of the residuals of ln G' and ln G'' from the scatter of points alone.
    pub(super) scatter: [f64; 2],
}

/// Prior of the modulus factor b of the moved isotherm relative to the fixed one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ModulusFactor {
    /// Mean of ln b.
    pub(super) centre: f64,
    /// Standard deviation of ln b; `None` if b is given.
    pub(super) spread: Option<f64>,
}

/// Placement of the moved isotherm relative to the fixed one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// Shift ln a of the frequencies.
    pub(super) log_factor: f64,
    /// Shift ln b of the moduli.
    pub(super) log_modulus: f64,
    /// Variances with which the residuals of ln G' and ln G'' are weighted.
    pub(super) variances: [f64; 2],
    /// Mean squares of the residuals of ln G' and ln G''.
    pub(super) mean_squares: [f64; 2],
    /// Sums of the weights of the residuals of ln G' and ln G'', about their numbers.
    pub(super) overlaps: [f64; 2],
}

impl Place {
    /// Whether the overlap is near the smallest admissible one, so that the true shift may be larger.
    pub(super) fn has_minimal_overlap(&self) -> bool {
        self.overlaps[0] < 1.2 * MIN_OVERLAP
    }
}

/// Smallest sum of weights of the points in an overlap, about one and a half intervals between points. Chosen: a pair with less
/// is placed by the law of other pairs, or refused.
const MIN_OVERLAP: f64 = 2.5;
/// Largest root mean square distance of ln G' with which two isotherms meet, a quarter of the modulus. Chosen: scatter and a
/// vertical shift are smaller; a larger distance means isotherms of different curves.
const MAX_RMS_DISTANCE: f64 = 0.23;
/// Number of trial shifts, from contact at one end to contact at the other. Chosen: the best one is refined by golden section.
const N_TRIALS: u32 = 1000;

impl LogCurves {
    /// Logarithms of frequency and moduli of an isotherm.
    pub(super) fn new(points: &[ModulusPoint]) -> Self {
        let line = |modulus: fn(&ModulusPoint) -> f64| {
            let logs = points
                .iter()
                .map(|point| [point.angular_frequency, modulus(point)].map(f64::ln));
            // Omit a modulus of zero, because it has no logarithm.
            LogCurve(logs.filter(|point| point[1].is_finite()).collect())
        };
        Self([line(|point| point.storage), line(|point| point.loss)])
    }

    /// Squared scatter of ln G' and ln G'' of single points, one for each point with two neighbours on each side.
    pub(super) fn scatter(&self) -> [Vec<f64>; 2] {
        [0, 1].map(|quantity| {
            let points = self.0[quantity].0.windows(5);
            points.map(squared_scatter).collect()
        })
    }
}

/// Squared distance of the third of five points from the cubic through the others, divided by its variance for unit
/// variances of the points.
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

impl LogCurve {
    /// Lowest and highest ln ω of the curve; NaN for a curve without points.
    fn ends(&self) -> [f64; 2] {
        [self.0.first(), self.0.last()].map(|point| point.map_or(f64::NAN, |p| p[0]))
    }

    /// Linear interpolation at ln ω; `None` outside the curve.
    fn interpolate(&self, log_frequency: f64) -> Option<Interpolated> {
        let next = self.0.partition_point(|point| point[0] < log_frequency);
        let [below, above] = [self.0.get(next.checked_sub(1)?)?, self.0.get(next)?];
        let part = (log_frequency - below[0]) / (above[0] - below[0]);
        Some(Interpolated {
            value: below[1] + part * (above[1] - below[1]),
            weight: taper(next, self.0.len(), part),
        })
    }
}

/// Weight of a residual at a fraction `part` of the interval before point `next` of a curve of `n_points`.
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
    /// Residuals in the overlap at a shift ln a, of the points of either curve from the line through the other.
    fn new(fixed: &LogCurve, moved: &LogCurve, shift: f64) -> Self {
        // Compare the points of the moved curve with the line of the fixed one, then the reverse with the opposite sign.
        let mut residuals = Self::default();
        for (points, line, offset, sign) in
            [(moved, fixed, shift, 1.0), (fixed, moved, -shift, -1.0)]
        {
            for [log_frequency, log_modulus] in &points.0 {
                if let Some(other) = line.interpolate(log_frequency + offset) {
                    let residual = sign * (log_modulus - other.value);
                    residuals.weight += other.weight;
                    residuals.sum += other.weight * residual;
                    residuals.squares += other.weight * residual * residual;
                }
            }
        }
        residuals
    }

    /// Weighted sum of squares after division of the moved moduli by a factor b, from ln b.
    fn squares(&self, log_modulus: f64) -> f64 {
        let squares = self.squares - log_modulus * (2.0 * self.sum - log_modulus * self.weight);
        squares.max(0.0)
    }

    /// Weighted mean square after division of the moved moduli by a factor b, from ln b; 0 without overlap.
    fn mean_square(&self, log_modulus: f64) -> f64 {
        if self.weight > 0.0 {
            self.squares(log_modulus) / self.weight
        } else {
            0.0
        }
    }
}

impl Pair<'_> {
    /// Residuals of ln G' and ln G'' at a shift ln a.
    fn residuals(&self, shift: f64) -> [Residuals; 2] {
        [0, 1].map(|k| Residuals::new(&self.fixed.0[k], &self.moved.0[k], shift))
    }

    /// Placement at a shift ln a, with the best modulus factor.
    fn place(&self, log_factor: f64, factor: ModulusFactor, variances: [f64; 2]) -> Place {
        let residuals = self.residuals(log_factor);
        let log_modulus = factor.best_log_modulus(&residuals, variances);
        Place {
            log_factor,
            log_modulus,
            variances,
            mean_squares: residuals.map(|one| one.mean_square(log_modulus)),
            overlaps: residuals.map(|one| one.weight),
        }
    }

    /// Placement at a given shift ln a; `None` if the isotherms overlap too little there.
    pub(super) fn place_at(&self, log_factor: f64, factor: ModulusFactor) -> Option<Place> {
        let place = self.place(log_factor, factor, self.scatter);
        let variances = [0, 1].map(|k| self.scatter[k] + place.mean_squares[k]);
        (place.overlaps[0] >= MIN_OVERLAP).then_some(Place { variances, ..place })
    }

    /// Whether the isotherms agree in their overlap at a given shift; true without overlap.
    pub(super) fn is_compatible(&self, log_factor: f64, factor: ModulusFactor) -> bool {
        let place = self.place_at(log_factor, factor);
        place.is_none_or(|place| place.mean_squares[0] <= MAX_RMS_DISTANCE * MAX_RMS_DISTANCE)
    }

    /// Placement with the best agreement of both moduli; `None` if the storage moduli disagree at every shift.
    ///
    /// The storage modulus is measured better and decides if the two contradict each other: the variance of the loss modulus
    /// is its smallest mean square at shifts that the storage modulus admits. A plateau of the storage modulus admits all
    /// shifts, so that the loss modulus decides.
    pub(super) fn best_place(&self, factor: ModulusFactor) -> Option<Place> {
        // Compute the residuals at equally spaced trial shifts between those at which only the ends meet.
        let [fixed, moved] = [self.fixed, self.moved].map(|lines| lines.0[0].ends());
        let [lowest, highest] = [fixed[0] - moved[1], fixed[1] - moved[0]];
        let step = (highest - lowest) / f64::from(N_TRIALS);
        let trials: Vec<Trial> = (1..N_TRIALS)
            .map(|k| lowest + step * f64::from(k))
            .map(|shift| Trial {
                shift,
                residuals: self.residuals(shift),
            })
            .filter(|trial| trial.residuals[0].weight >= MIN_OVERLAP)
            .collect();
        // The variance of the storage modulus is its smallest mean square with the best factor for it alone.
        let of_storage = |[own, _]: &[Residuals; 2]| {
            let alone = [*own, Residuals::default()];
            own.squares(factor.best_log_modulus(&alone, self.scatter))
        };
        let least_storage = trials
            .iter()
            .map(|trial| of_storage(&trial.residuals) / trial.residuals[0].weight)
            .fold(f64::INFINITY, f64::min);
        if least_storage > MAX_RMS_DISTANCE * MAX_RMS_DISTANCE {
            return None;
        }
        let storage = self.scatter[0] + least_storage;
        // The variance of the loss modulus comes from shifts at which the storage modulus is within three standard deviations of
        // its expected sum of squares.
        let least_loss = trials
            .iter()
            .map(|trial| &trial.residuals)
            .filter(|both| {
                let weight = both[0].weight;
                of_storage(both) <= storage * (weight + 3.0 * (2.0 * weight).sqrt())
            })
            .map(|both| both[1].mean_square(factor.best_log_modulus(both, self.scatter)))
            .fold(f64::INFINITY, f64::min);
        // A misfit of G'' beyond its scatter is common to all points, which together count as one.
        let n_points = trials
            .iter()
            .map(|trial| trial.residuals[0].weight)
            .fold(0.0, f64::max);
        let contradiction = (least_loss - self.scatter[1]).max(0.0);
        let variances = [
            storage,
            self.scatter[1] + least_loss + n_points * contradiction,
        ];
        let cost = |residuals: &[Residuals; 2]| factor.cost(residuals, variances);
        // Minimise the cost over the shift: take the best trial, then search around it by golden section.
        let best = trials
            .iter()
            .min_by(|a, b| cost(&a.residuals).total_cmp(&cost(&b.residuals)))?;
        let within = [best.shift - step, best.shift + step];
        let shift = golden_section(|shift| cost(&self.residuals(shift)), within);
        let found = self.place(shift, factor, variances);
        Some(found).filter(|found| found.mean_squares[0] <= MAX_RMS_DISTANCE * MAX_RMS_DISTANCE)
    }
}

/// Residuals of both moduli at a trial shift.
struct Trial {
    /// Shift ln a.
    shift: f64,
    /// Residuals of ln G' and ln G''.
    residuals: [Residuals; 2],
}

impl ModulusFactor {
    /// Posterior mean of ln b for residuals with these variances.
    fn best_log_modulus(self, residuals: &[Residuals; 2], variances: [f64; 2]) -> f64 {
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

    /// Cost that is minimised: half of the sum of squares divided by the variances, less its expectation.
    fn cost(self, residuals: &[Residuals; 2], variances: [f64; 2]) -> f64 {
        let log_modulus = self.best_log_modulus(residuals, variances);
        let away = log_modulus - self.centre;
        let known = self.spread.map_or(0.0, |spread| (away / spread).powi(2));
        let parts = residuals.iter().zip(variances);
        let part =
            |(one, variance): (&Residuals, f64)| one.squares(log_modulus) / variance - one.weight;
        0.5 * (known + parts.map(part).sum::<f64>())
    }
}
