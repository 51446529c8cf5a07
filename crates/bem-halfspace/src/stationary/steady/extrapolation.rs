//! The limit of a sequence of refinements by √2, and how far it may be off.

use numerics::Estimate;

/// Powers of the elements that are believed where they are observed.
pub(super) const OBSERVED_ORDERS: [f64; 2] = [0.5, 1.5];
/// Those where elements hide an edge: values may turn around once it is seen, so that nothing observed is believed.
pub(super) const HIDDEN_EDGE_ORDERS: [f64; 2] = [0.5, 0.5];

/// Powers of the elements with which the friction of materials that recover is seen to converge: 2 from the dissipated power, and
/// under cones, up to 5/2 from slopes.
const CREEPING_ORDERS: [f64; 2] = [2.0, 2.5];
/// Part of an error that that of another order must be below, to be taken: the least of several bars holds less often than each of
/// them. With it all of 104 hold on 60 random scenes under r, r^1.5, r² and r⁴, as without other orders, and the median is 0.6 of
/// that.
const HIGHER_ORDER_ERROR_RATIO: f64 = 0.5;

/// Extrapolates values on grids of which each has √2 times as many elements along a length as the one before.
///
/// The error of a grid falls with the spacing to the power `order`, and with the next power after that. Each power is
/// eliminated over a factor of two in the spacing. One elimination is enough, unless the order is below 1 or the second
/// one narrows the error bar to less than half.
pub(super) fn extrapolate(values: &[f64], order: f64) -> Estimate {
    let once = eliminate_order(values, order);
    let twice = eliminate_order(&once, next_order(order));
    let value = values.last().copied().unwrap_or(f64::MAX);
    let unknown = Estimate::new(value, value.abs());
    let first = estimate_limit(&once, values).filter(|_| order >= 1.0);
    match (first, estimate_limit(&twice, &once)) {
        (Some(first), Some(second)) if second.error >= 0.5 * first.error => first,
        (_, Some(second)) => second,
        (Some(first), None) => first,
        (None, None) => unknown,
    }
}

/// Extrapolates values whose error is known to fall with the power `order`, or faster: where elements resolve what creeps in the
/// contact, the friction of a material that recovers does so with one of [`CREEPING_ORDERS`].
pub(super) fn extrapolate_faster(values: &[f64], order: f64) -> Estimate {
    let mut best = extrapolate(values, order);
    for faster in CREEPING_ORDERS {
        let limit = estimate_limit(&eliminate_order(values, faster), values);
        if let Some(limit) =
            limit.filter(|limit| limit.error < HIGHER_ORDER_ERROR_RATIO * best.error)
        {
            best = limit;
        }
    }
    best
}

/// By how much the limit changes if errors fall with the observed power, between two `powers`, instead of `order`.
///
/// Where the edge of a flat end is just inside the contact, elements that are longer than what is around it see a punch, whose
/// errors fall with the root of the elements. The larger of the last two counts, because one may agree by accident.
pub(super) fn change_at_observed_order(values: &[f64], order: f64, powers: [f64; 2]) -> f64 {
    let [slowest, fastest] = powers.map(f64::exp2);
    let change = |window: &[f64]| {
        let [before, last] = [window[2] - window[0], window[4] - window[2]];
        if last == 0.0 {
            return 0.0;
        }
        let ratio = (before / last).clamp(slowest, fastest);
        (last / (ratio - 1.0) - last / (order.exp2() - 1.0)).abs()
    };
    let windows = values.windows(5).rev();
    windows.take(2).map(change).fold(0.0, f64::max)
}

/// Power of the error that is left when that of `order` is eliminated: the apex leaves 1 below that, then the front 3/2,
/// then the smooth part 2.
const fn next_order(order: f64) -> f64 {
    if order < 1.0 {
        1.0
    } else if order < 1.5 {
        1.5
    } else {
        2.0
    }
}

/// The last limit with what the last two refinements changed and what the last elimination did. Two limits may agree by
/// accident, three seldom do: with two of them the bar held in three of four cases, with three in 97 of 100.
fn estimate_limit(limits: &[f64], eliminated: &[f64]) -> Option<Estimate> {
    let [.., earlier, before, value] = limits else {
        return None;
    };
    let changes = (value - before).abs().max(0.5 * (before - earlier).abs());
    let elimination = (value - eliminated.last()?).abs();
    Some(Estimate::new(*value, changes + 0.25 * elimination))
}

/// Removes the error of one order from a sequence; two values are used up.
fn eliminate_order(values: &[f64], order: f64) -> Vec<f64> {
    // 2^order − 1, which is small for the sharpest cusps.
    let gain = (order * std::f64::consts::LN_2).exp_m1();
    let limit = |window: &[f64]| window[2] + (window[2] - window[0]) / gain;
    values.windows(3).map(limit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values whose limit is 3.
    fn sequence(orders: [f64; 2], length: i32) -> Vec<f64> {
        let spacing = |level: i32| 2.0_f64.powf(-0.5 * f64::from(level));
        let terms = |h: f64| 3.0 - h.powf(orders[0]) + 0.2 * h.powf(orders[1]);
        (0..length).map(|level| terms(spacing(level))).collect()
    }

    #[test]
    fn two_powers_are_eliminated() {
        for orders in [[0.1, 1.0], [1.0, 1.5], [1.5, 2.0]] {
            let limit = extrapolate(&sequence(orders, 7), orders[0]);
            assert!((limit.value - 3.0).abs() < 1e-12, "{orders:?}: {limit:?}");
            assert!(limit.error < 1.0, "{orders:?}: {limit:?}");
        }
    }

    #[test]
    fn errors_that_fall_faster_are_seen() {
        for faster in CREEPING_ORDERS {
            let values = sequence([faster, 3.5], 9);
            let [slow, fast] = [extrapolate(&values, 1.0), extrapolate_faster(&values, 1.0)];
            assert!(fast.error < 0.3 * slow.error, "{slow:?}, {fast:?}");
            assert!((fast.value - 3.0).abs() <= fast.error, "{fast:?}");
        }
        for order in [1.0, 1.5] {
            let values = sequence([order, order + 1.0], 9);
            let limit = extrapolate_faster(&values, order);
            assert!(
                (limit.value - 3.0).abs() <= limit.error,
                "{order}: {limit:?}"
            );
        }
    }

    #[test]
    fn the_error_covers_what_the_eliminations_leave() {
        for length in 1..9 {
            for orders in [[1.5, 2.0], [1.5, 2.5], [0.3, 1.4], [1.0, 1.2]] {
                let limit = extrapolate(&sequence(orders, length), orders[0]);
                let holds = (limit.value - 3.0).abs() <= limit.error + 1e-12;
                assert!(holds, "{orders:?}, {length} values: {limit:?} instead of 3");
            }
        }
    }
}
