//! Roots of the equation that relaxation and retardation times share.
//!
//! ```text
//! Σ w_i/(x − p_i) = e    w_i > 0,  0 ≤ p_0 < p_1 < …,  e ≥ 0
//! ```
//! The left side falls from +∞ to −∞ between two poles, and from +∞ to 0 above the last one: one root in every gap, and
//! one above when e > 0.

/// The pole p ≥ 0 and its weight w > 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pole {
    pub(super) position: f64,
    pub(super) weight: f64,
}

/// A root, and its distances x − p_i from the poles, which rounding of x would destroy where they are small.
#[derive(Debug, Clone)]
pub(super) struct Root {
    pub(super) position: f64,
    /// x Σ w_i/(x − p_i)².
    pub(super) slope: f64,
}

/// All roots in increasing order.
pub(super) fn roots(poles: &[Pole], level: f64) -> Vec<Root> {
    let gaps = (1..poles.len()).map(|upper| root_in_gap(poles, upper, level));
    let mut roots: Vec<Root> = gaps.collect();
    if level > 0.0 && !poles.is_empty() {
        roots.push(root_above(poles, level));
    }
    roots
}

/// The root between the poles `upper − 1` and `upper`, sought as a distance from the nearer of them.
fn root_in_gap(poles: &[Pole], upper: usize, level: f64) -> Root {
    let half_gap = 0.5 * (poles[upper].position - poles[upper - 1].position);
    let in_lower_half = Search {
        poles,
        level,
        near: upper - 1,
        side: 1.0,
    };
    // At the middle of the gap: what pulls the root up, and what pulls it down.
    let middle = in_lower_half.balance(half_gap);
    if middle.up <= middle.down {
        let least = poles[upper - 1].weight / middle.down;
        return in_lower_half.root([least.min(half_gap), half_gap]);
    }
    let in_upper_half = Search {
        near: upper,
        side: -1.0,
        ..in_lower_half
    };
    let least = poles[upper].weight / middle.up;
    in_upper_half.root([least.min(half_gap), half_gap])
}

/// The root above the last pole: w_last/x ≤ e ≤ Σ w/x, with x the distance from that pole.
fn root_above(poles: &[Pole], level: f64) -> Root {
    let near = poles.len() - 1;
    let total: f64 = poles.iter().map(|pole| pole.weight).sum();
    let search = Search {
        poles,
        level,
        near,
        side: 1.0,
    };
    search.root([poles[near].weight / level, total / level])
}

/// A root at a distance from the pole `near`, above it (`side` = 1) or below it (−1).
struct Search<'a> {
    poles: &'a [Pole],
    level: f64,
    near: usize,
    side: f64,
}

/// Both sides of the equation at one point, sums of positive terms, with their derivatives.
struct Balance {
    /// Σ w_i/(x − p_i) over the poles below x.
    up: f64,
    /// e + Σ w_i/(p_i − x) over the poles above x.
    down: f64,
    /// The derivatives of `up` and `down` by x, without sign.
    slopes: [f64; 2],
}

impl Search<'_> {
    /// x − p_i at a distance from the near pole. It is at most half a gap, so that the sum never cancels.
    fn difference(&self, pole: &Pole, distance: f64) -> f64 {
        (self.poles[self.near].position - pole.position) + self.side * distance
    }

    fn balance(&self, distance: f64) -> Balance {
        let mut balance = Balance {
            up: 0.0,
            down: self.level,
            slopes: [0.0; 2],
        };
        for pole in self.poles {
            let difference = self.difference(pole, distance);
            let term = (pole.weight / difference).abs();
            let slope = term / difference.abs();
            if difference > 0.0 {
                balance.up += term;
                balance.slopes[0] += slope;
            } else {
                balance.down += term;
                balance.slopes[1] += slope;
            }
        }
        balance
    }

    /// Newton's method for ln(up/down) = 0 in the logarithm of the distance, where both are nearly straight; bisection
    /// where it leaves the bracket or stops halving its steps.
    fn root(&self, [mut low, mut high]: [f64; 2]) -> Root {
        let tolerance = 4.0 * f64::EPSILON;
        let mut distance = low.sqrt() * high.sqrt();
        let mut last_step = f64::INFINITY;
        while high > low * (1.0 + tolerance) {
            let Balance { up, down, slopes } = self.balance(distance);
            // Moving away from the near pole lowers up/down on its upper side and raises it on its lower side.
            let excess = self.side * (up / down).ln();
            if excess > 0.0 {
                low = distance;
            } else {
                high = distance;
            }
            let decline = distance * (slopes[0] / up + slopes[1] / down);
            let mut step = excess / decline;
            let next = distance * step.exp();
            let trusted = next > low && next < high && step.abs() <= 0.5 * last_step;
            if step.abs() <= tolerance {
                break;
            }
            if trusted {
                distance = next;
            } else {
                let middle = low.sqrt() * high.sqrt();
                step = (middle / distance).ln();
                distance = middle;
            }
            last_step = step.abs();
        }
        self.root_at(distance)
    }

    fn root_at(&self, distance: f64) -> Root {
        let position = self.poles[self.near].position + self.side * distance;
        let terms = self.poles.iter().map(|pole| {
            let difference = self.difference(pole, distance);
            (pole.weight / difference) * (position / difference)
        });
        Root {
            position,
            slope: terms.sum(),
        }
    }
}
