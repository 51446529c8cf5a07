//! Roots of the secular equation of relaxation and retardation times.
//!
//! ```text
//! S(x) = Σ w_i/(x − p_i) − e = 0    p_0 < p_1 < …,  e ≥ 0
//! ```
//! With positive weights, S decreases from +∞ to −∞ between two poles, and from +∞ to −e above the last one. There is one root in
//! every gap, and one above all poles if e > 0. In general, S changes its sign in each gap between weights of the same sign, above the
//! last pole if its weight is positive and e > 0, and below the first one if its weight is negative; there must be one root in each of
//! these intervals, and no other. A root is stored as its offset from the nearer pole, so that differences of roots and poles do not
//! cancel.

/// A pole p and its weight w ≠ 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pole {
    /// Position p.
    pub(super) position: f64,
    /// Weight w.
    pub(super) weight: f64,
}

/// A root x of the equation.
pub(super) struct Root {
    /// Position x.
    pub(super) position: f64,
    /// Value −1/(x S'(x)), which does not overflow if −1/S' does.
    pub(super) relative_inverse_slope: f64,
}

/// Smallest distance of a root from a pole, as a fraction of half the gap, if weights have both signs. Chosen: below the ratios of all
/// relaxation times that fractional laws are expanded in, and far above underflow.
const SMALLEST_OFFSET: f64 = 1e-100;

/// Roots of the secular equation in increasing order, with the constant term e = `level`.
pub(super) fn roots(poles: &[Pole], level: f64) -> Vec<Root> {
    let equation = Secular { poles, level };
    let mut places = Vec::new();
    if poles.first().is_some_and(|first| first.weight < 0.0) {
        places.push(equation.root_below());
    }
    let changes_sign = |upper: &usize| poles[upper - 1].weight * poles[*upper].weight > 0.0;
    let gaps = (1..poles.len()).filter(changes_sign);
    places.extend(gaps.map(|upper| equation.root_in_gap(upper)));
    if level > 0.0 && poles.last().is_some_and(|last| last.weight > 0.0) {
        places.push(equation.root_above());
    }
    let root = |index: usize| Root {
        position: poles[places[index].near].position + places[index].offset,
        relative_inverse_slope: equation.relative_inverse_slope(&places, index),
    };
    (0..places.len()).map(root).collect()
}

/// The equation S(x) = 0.
struct Secular<'a> {
    /// Poles in increasing order.
    poles: &'a [Pole],
    /// Constant e.
    level: f64,
}

/// A point at an offset from the pole `near` of at most half the gap on that side.
#[derive(Debug, Clone, Copy)]
struct RootPosition {
    /// Index of the pole.
    near: usize,
    /// Offset from this pole.
    offset: f64,
}

/// Magnitudes of the sums of the positive and the negative terms of S at one point; of −S in gaps between negative weights.
struct Balance {
    /// Sum of the positive terms.
    up: f64,
    /// Sum of the moduli of the negative terms.
    down: f64,
    /// Rates over the logarithm of the distance from the pole `near` at which `up` falls along x, and `down` rises.
    slopes: [f64; 2],
}

impl Secular<'_> {
    /// The root between the poles of the indices `upper − 1` and `upper`, as the offset from the nearer one.
    fn root_in_gap(&self, upper: usize) -> RootPosition {
        let [below, above] = [self.poles[upper - 1], self.poles[upper]];
        let half_gap = 0.5 * (above.position - below.position);
        let middle = self.balance(RootPosition {
            near: upper - 1,
            offset: half_gap,
        });
        // Find a lower bound of the distance of the root from the nearer pole. If all weights are positive, the term of that pole is at
        // most the sum of the other sign, which is largest in the middle.
        let is_positive = self.poles[0].weight > 0.0;
        let least = |weight: f64, other: f64| {
            if is_positive {
                (weight / other).min(half_gap)
            } else {
                SMALLEST_OFFSET * half_gap
            }
        };
        if middle.up <= middle.down {
            let least = least(below.weight, middle.down);
            return self.root_beside(upper - 1, 1.0, [least, half_gap]);
        }
        let least = least(above.weight, middle.up);
        self.root_beside(upper, -1.0, [least, half_gap])
    }

    /// The root above the last pole, whose weight is positive. With `N` the sum of w/(p_last − p) over the negative weights,
    /// w_last/(e + N) ≤ x − p_last ≤ Σ w/e, where the second sum is over the positive weights.
    fn root_above(&self) -> RootPosition {
        let last = self.poles.len() - 1;
        let (mut positive, mut negative) = (0.0, 0.0);
        for pole in self.poles {
            if pole.weight > 0.0 {
                positive += pole.weight;
            } else {
                negative -= pole.weight / (self.poles[last].position - pole.position);
            }
        }
        let least = self.poles[last].weight / (self.level + negative);
        let mut most = positive / self.level;
        if self.level == 0.0 {
            // Far above all poles S is Σ w/x, which is negative then.
            most = least;
            let is_short = |most: f64| {
                let balance = self.balance(RootPosition {
                    near: last,
                    offset: most,
                });
                balance.up > balance.down
            };
            while most.is_finite() && is_short(most) {
                most *= 4.0;
            }
        }
        self.root_beside(last, 1.0, [least, most])
    }

    /// The root below the first pole, whose weight is negative: that above the last pole of S(−x).
    fn root_below(&self) -> RootPosition {
        let mirrored = |pole: &Pole| Pole {
            position: -pole.position,
            weight: -pole.weight,
        };
        let poles: Vec<Pole> = self.poles.iter().rev().map(mirrored).collect();
        let root = Secular {
            poles: &poles,
            level: self.level,
        }
        .root_above();
        RootPosition {
            near: 0,
            offset: -root.offset,
        }
    }

    /// The root above (`side` = 1) or below (−1) the pole `near`, at a distance within the bracket.
    ///
    /// Newton's method for ln(up/down) = 0 in the logarithm of the distance, in which the function is nearly linear.
    /// Bisection replaces a step that leaves the bracket or is longer than half of the previous one.
    fn root_beside(&self, near: usize, side: f64, [mut low, mut high]: [f64; 2]) -> RootPosition {
        /// Relative tolerance with which the distance of a root from its pole is found: a few roundings.
        const TOLERANCE: f64 = 4.0 * f64::EPSILON;
        // Compute the geometric mean as low √(high/low), which scales exactly with the unit.
        let middle = |low: f64, high: f64| match high / low {
            ratio if ratio.is_finite() => low * ratio.sqrt(),
            _ => low.sqrt() * high.sqrt(),
        };
        let place = |distance: f64| RootPosition {
            near,
            offset: side * distance,
        };
        let mut distance = middle(low, high);
        let mut last_step = f64::INFINITY;
        while high > low * (1.0 + TOLERANCE) {
            let Balance { up, down, slopes } = self.balance(place(distance));
            // The excess is positive if the root is farther from the pole than this place.
            let excess = side * (up / down).ln();
            let rate = slopes[0] / up + slopes[1] / down;
            let step = excess / rate;
            if step.abs() <= TOLERANCE && rate > 0.0 {
                break;
            }
            if excess > 0.0 {
                low = distance;
            } else {
                high = distance;
            }
            let newton = distance * step.exp();
            let trusted =
                rate > 0.0 && newton > low && newton < high && step.abs() <= 0.5 * last_step;
            let next = if trusted { newton } else { middle(low, high) };
            if next <= low || next >= high {
                // Stop if the interval between subnormal ends cannot be divided.
                break;
            }
            last_step = (next / distance).ln().abs();
            distance = next;
        }
        place(distance)
    }

    /// Sums of the positive and of the negative terms of S, or of −S beside a pole of negative weight, at a point, with their slopes.
    fn balance(&self, place: RootPosition) -> Balance {
        let sign = self.poles[place.near].weight.signum();
        let mut balance = Balance {
            up: 0.0,
            down: self.level,
            slopes: [0.0; 2],
        };
        if sign < 0.0 {
            balance.up = self.level;
            balance.down = 0.0;
        }
        for (index, pole) in self.poles.iter().enumerate() {
            let difference = self.above_pole(place, index);
            let term = (pole.weight / difference).abs();
            // Compute the slope with a ratio of lengths, because the square of a difference may underflow.
            let steepness = term * (place.offset / difference).abs();
            let weight = sign * pole.weight;
            // Every term with a positive weight falls along x, and every other one rises.
            let slope = steepness.copysign(weight);
            if (difference > 0.0) == (weight > 0.0) {
                balance.up += term;
                balance.slopes[0] += slope;
            } else {
                balance.down += term;
                balance.slopes[1] += slope;
            }
        }
        balance
    }

    /// Difference x − p_i of a point and the pole with this index, without cancellation.
    fn above_pole(&self, place: RootPosition, pole: usize) -> f64 {
        (self.poles[place.near].position - self.poles[pole].position) + place.offset
    }

    /// Value −1/(x S'(x)) at the root of an `index` in `places`, which holds all roots, from the product over all roots and poles.
    ///
    /// ```text
    /// S(x) = −e Π(x − x_l)/Π(x − p_l)         −S'(x_k) = e Π_{l≠k} |x_k − x_l| / Π |x_k − p_l|
    /// ```
    /// and, for e = 0 with one root less, the same with Σ w in place of −e. The sum −S' = Σ w/(x − p)² would be accurate for
    /// each rounded root alone. Together such slopes would describe no material: for poles at a distance δ, moduli would
    /// have errors ε/δ. The product is consistent with all rounded roots (Gu & Eisenstat 1994, SIAM J. Matrix Anal. Appl.
    /// 15, 1266).
    fn relative_inverse_slope(&self, places: &[RootPosition], index: usize) -> f64 {
        let place = places[index];
        let position = self.poles[place.near].position + place.offset;
        // Combine root and pole of the same gap in one factor, so that the product does not overflow.
        let factors = places.iter().enumerate().map(|(l, other)| {
            let from_pole = self.above_pole(place, l);
            if l == index {
                return from_pole / position;
            }
            let between = self.poles[place.near].position - self.poles[other.near].position;
            from_pole / (between + (place.offset - other.offset))
        });
        let product: f64 = factors.product();
        if self.level > 0.0 {
            return product / self.level;
        }
        let last = self.poles.len() - 1;
        let total: f64 = self.poles.iter().map(|pole| pole.weight).sum();
        -self.above_pole(place, last) * product / total
    }
}
