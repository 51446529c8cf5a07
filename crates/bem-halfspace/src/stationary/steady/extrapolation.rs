//! Richardson extrapolation of a sequence of refinements by √2, with an error estimate.
//!
//! Theory: docs/theory/stationary-half-space.md, "Scatter, order, error bar".

use numerics::Estimate;

use crate::estimate::bars::FRONT_ORDER;

/// Convergence order at the edge of a flat end just inside the contact, where the elements resolve a punch only. Derived: the
/// pressure of a punch grows like the inverse root of the distance, so that an element at the edge carries a part like the root
/// of its length.
pub(super) const FLAT_END_ORDER: f64 = 0.5;
/// Range to which the observed convergence order is limited under a body with edges. Derived: its ends are the orders of a flat end
/// that the elements do not resolve, and of a front without edges.
pub(super) const OBSERVED_ORDERS: [f64; 2] = [FLAT_END_ORDER, FRONT_ORDER];
/// Range of the convergence order as long as the elements do not resolve an edge near the front: that of a flat end alone. The
/// observed order does not count, because the values may change their trend once the edge is resolved.
pub(super) const HIDDEN_EDGE_ORDERS: [f64; 2] = [FLAT_END_ORDER; 2];

/// Convergence orders that are observed for the friction on any material but a dashpot. The order is 2 from the dissipated power.
/// From slopes it is 2 under cones, and 2 to 5/2 under smooth bodies (docs/theory/stationary-half-space.md, "Scatter, order,
/// error bar"; case of `evidence tuning`).
pub(super) const CREEPING_ORDERS: [f64; 2] = [2.0, 2.5];
/// Ratio of the error of another limit to that of the present one, below which the other is accepted. It may have a higher order
/// or a second elimination, or be the friction from dissipation. The smallest of several error estimates holds less often than
/// each of them. Chosen (case of `evidence tuning`).
///
/// Measured on 60 random scenes under the profiles r, r^1.5, r² and r⁴: all of 104 error estimates hold with this value, as they
/// do without higher orders. The median error is 0.6 of that without them.
pub(super) const ACCEPTED_ERROR_RATIO: f64 = 0.5;

/// Ratio of the errors of second order on two successive grids, 1/√2². The second order is the highest that an elimination leaves
/// ([`next_order`]).
const SECOND_ORDER_RATIO: f64 = 0.5;

/// Extrapolates values on grids of which each has √2 times as many elements along a length as the one before.
///
/// The error of a grid is of the order `order` in the spacing, with a term of the next order after that. Each order is eliminated
/// over a factor of two in the spacing. One elimination is enough, unless the order is below 1 or the second one reduces the error
/// to less than half. Where elements resolve the creep in the contact, errors may fall with one of the `faster_orders`, each of
/// which is tried.
pub(super) fn extrapolate(values: &[f64], order: f64, faster_orders: &[f64]) -> Estimate {
    // Compute the sequences of limits after one and after two eliminations.
    let once = eliminate_order(values, order);
    let twice = eliminate_order(&once, next_order(order));
    let value = values.last().copied().unwrap_or(f64::MAX);
    // Below the order 1 too much of the error is left after one elimination, so that only the second one counts.
    let first = estimate_limit(&once, values).filter(|_| order >= 1.0);
    let mut best = match (first, estimate_limit(&twice, &once)) {
        (Some(first), Some(second)) if second.error >= ACCEPTED_ERROR_RATIO * first.error => first,
        (first, second) => second
            .or(first)
            .unwrap_or(Estimate::new(value, value.abs())),
    };
    for faster in faster_orders {
        let limit = estimate_limit(&eliminate_order(values, *faster), values);
        best = limit
            .filter(|limit| limit.error < ACCEPTED_ERROR_RATIO * best.error)
            .unwrap_or(best);
    }
    best
}

/// Absolute change of the extrapolated limit of `values` if the observed convergence order, limited to a range, replaces `order`.
/// The observed order is that of two successive changes over two refinements each, which halve the elements.
///
/// Where the edge of a flat end is just inside the contact, elements that are longer than the contact beyond it resolve a punch
/// only. Its errors fall with the order 1/2. The larger of the last two changes counts, because one may be small by accident.
pub(super) fn change_at_observed_order(values: &[f64], order: f64, range: [f64; 2]) -> f64 {
    let [min_ratio, max_ratio] = range.map(f64::exp2);
    let change = |window: &[f64]| {
        let [before, last] = [window[2] - window[0], window[4] - window[2]];
        if last == 0.0 {
            return 0.0;
        }
        // The ratio of successive changes is 2^order for the observed order.
        let ratio = (before / last).clamp(min_ratio, max_ratio);
        (last / (ratio - 1.0) - last / (order.exp2() - 1.0)).abs()
    };
    let windows = values.windows(5).rev();
    windows.take(2).map(change).fold(0.0, f64::max)
}

/// Order of the error that remains when that of `order` is eliminated: 1 for cusps, 3/2 from the front, then 2.
const fn next_order(order: f64) -> f64 {
    if order < 1.0 {
        1.0
    } else if order < FRONT_ORDER {
        FRONT_ORDER
    } else {
        2.0
    }
}

/// The last of the `limits`, with an error from the changes by the last two refinements and from its difference to the last of
/// `eliminated`, the values before the last elimination. `None` for fewer than three limits. Two limits may agree by accident,
/// three seldom do: with two the error held in three of four cases, with three in 97 of 100.
fn estimate_limit(limits: &[f64], eliminated: &[f64]) -> Option<Estimate> {
    let [.., earlier, before, last] = limits else {
        return None;
    };
    // The earlier change counts as far as an error of second order would have left of it on the last grid. The elimination goes over
    // two refinements.
    let changes = (last - before)
        .abs()
        .max(SECOND_ORDER_RATIO * (before - earlier).abs());
    let elimination = (last - eliminated.last()?).abs();
    Some(Estimate::new(
        *last,
        changes + SECOND_ORDER_RATIO * SECOND_ORDER_RATIO * elimination,
    ))
}

/// Eliminates the error of one order from values on grids with spacings in the ratio √2, over a factor of two (Richardson); the
/// result is two values shorter.
fn eliminate_order(values: &[f64], order: f64) -> Vec<f64> {
    // The gain is 2^order − 1, which is computed without cancellation because it is small for the sharpest cusps.
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
            let limit = extrapolate(&sequence(orders, 7), orders[0], &[]);
            assert!((limit.value - 3.0).abs() < 1e-12, "{orders:?}: {limit:?}");
            assert!(limit.error < 1.0, "{orders:?}: {limit:?}");
        }
    }

    #[test]
    fn errors_that_fall_faster_are_seen() {
        for faster in CREEPING_ORDERS {
            let values = sequence([faster, 3.5], 9);
            let [slow, fast] =
                [&[][..], &CREEPING_ORDERS].map(|faster| extrapolate(&values, 1.0, faster));
            assert!(fast.error < 0.3 * slow.error, "{slow:?}, {fast:?}");
            assert!((fast.value - 3.0).abs() <= fast.error, "{fast:?}");
        }
        for order in [1.0, 1.5] {
            let values = sequence([order, order + 1.0], 9);
            let limit = extrapolate(&values, order, &CREEPING_ORDERS);
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
                let limit = extrapolate(&sequence(orders, length), orders[0], &[]);
                let holds = (limit.value - 3.0).abs() <= limit.error + 1e-12;
                assert!(holds, "{orders:?}, {length} values: {limit:?} instead of 3");
            }
        }
    }
}
