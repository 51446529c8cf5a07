//! Pressed in without sliding, depth and contact depend on the impulse F t alone (casebook MDR-01): the steps in time
//! do not matter, the spacing does.

use indenters::{EquivalentLine, PowerProfile};

use crate::support::{VISCOSITY, indent, material, observed_orders};

const FORCE: f64 = 2.0;
const TIME: f64 = 3.0;

/// Exact [d, a] of h = c r^p: d = (((p + 1)/p) (κ c)^(1/p) F t / (8 η))^(p/(p+1)), a = (d/(κ c))^(1/p).
fn exact(body: &PowerProfile, time: f64) -> [f64; 2] {
    let p = body.exponent();
    let line = body.stretch() * body.coefficient();
    let impulse = FORCE * time / (8.0 * VISCOSITY);
    let depth = ((p + 1.0) / p * line.powf(1.0 / p) * impulse).powf(p / (p + 1.0));
    [depth, body.line_position(depth)]
}

/// Relative error of the depth at [`TIME`] with n elements on each side of the apex.
fn depth_error(exponent: f64, n: f64) -> f64 {
    let body = PowerProfile::new(0.4, exponent).expect("a power profile");
    let [depth, radius] = exact(&body, TIME);
    let spacing = radius / n;
    let rows = indent(
        &EquivalentLine(&body),
        &material(VISCOSITY),
        FORCE,
        &[TIME],
        spacing,
    )
    .expect("a contact");
    rows[0].indentation_depth / depth - 1.0
}

/// The trapezoidal sum over d − h̃ has the order 2, at the cusp of p < 1 the order p + 1.
#[test]
fn depth_converges_with_the_order_of_the_trapezoidal_sum() {
    for (exponent, expected) in [(0.5, 1.5), (0.75, 1.75), (1.5, 2.0), (2.0, 2.0), (4.0, 2.0)] {
        let errors = [16.0, 32.0, 64.0, 128.0, 256.0].map(|n| depth_error(exponent, n));
        for order in observed_orders(&errors) {
            assert!(
                (order - expected).abs() < 0.15,
                "p = {exponent}: order {order} instead of {expected}, errors {errors:?}"
            );
        }
    }
}

/// The trapezoidal sum of a triangle is its area.
#[test]
fn cone_is_exact() {
    let error = depth_error(1.0, 20.0);
    assert!(error.abs() < 1e-13, "relative error {error}");
}

/// Casebook rows, at the two ends of six decades in time, with 2000 elements along the contact: depth to the
/// trapezoidal sum (p + 1 below one, 2 above, larger with p²), radius to one element.
#[test]
fn casebook_rows_come_out() {
    let mut n_rows = 0;
    for case in casebook::group("MDR-01") {
        if !case.has_input("p") {
            continue;
        }
        n_rows += 1;
        let exponent = case.input("p");
        let body = PowerProfile::new(case.input("c"), exponent).expect("a power profile");
        let radius = case.expected("a").expect("a radius");
        let spacing = radius / 1000.0;
        let material = material(case.input("eta"));
        let times = [case.input("t")];
        let rows = indent(
            &EquivalentLine(&body),
            &material,
            case.input("F"),
            &times,
            spacing,
        )
        .expect("a contact");
        let tolerance = 2.0 * exponent.max(1.0) * 1000.0_f64.powf(-(exponent + 1.0).min(2.0));
        case.check_within("d", rows[0].indentation_depth, tolerance);
        let [_, front] = rows[0].contact.expect("a contact");
        case.check_within("a", front, 1.01e-3);
        case.check_within("a", 0.5 * rows[0].contact_length, 1.01e-3);
    }
    assert!(n_rows >= 12, "only {n_rows} rows");
}

/// One step or a thousand, even or clustered at the start: the same depth to rounding, although d ∼ t^(p/(p+1)).
#[test]
fn number_of_time_steps_does_not_matter() {
    for exponent in [0.5, 1.0, 2.0, 4.0] {
        let body = PowerProfile::new(0.4, exponent).expect("a power profile");
        let spacing = exact(&body, TIME)[1] / 50.3;
        let last_depth = |times: &[f64]| {
            let line = EquivalentLine(&body);
            let rows = indent(&line, &material(VISCOSITY), FORCE, times, spacing);
            rows.expect("a contact")[times.len() - 1].indentation_depth
        };
        let at_once = last_depth(&[TIME]);
        for (n_steps, clustering) in [(10, 1), (1000, 1), (1000, 6)] {
            let fraction = |k: i32| f64::from(k) / f64::from(n_steps);
            let times: Vec<f64> = (1..=n_steps)
                .map(|k| TIME * fraction(k).powi(clustering))
                .collect();
            let depth = last_depth(&times);
            // A thousand steps each round the depth once.
            assert!(
                (depth / at_once - 1.0).abs() < 1e-12,
                "p = {exponent}, {n_steps} steps: {depth} instead of {at_once}"
            );
        }
    }
}

/// The history is d(t), a(t) at every recorded time at which the contact has some elements.
#[test]
fn history_follows_the_power_law() {
    let body = PowerProfile::paraboloid(0.4).expect("a paraboloid");
    let [_, radius] = exact(&body, TIME);
    let spacing = radius / 400.0;
    let times: Vec<f64> = (1..=60).map(|k| TIME * f64::from(k) / 60.0).collect();
    let rows = indent(
        &EquivalentLine(&body),
        &material(VISCOSITY),
        FORCE,
        &times,
        spacing,
    )
    .expect("a contact");
    for row in rows {
        let [depth, radius] = exact(&body, row.time);
        let n = radius / spacing;
        let [rear, front] = row.contact.expect("a contact");
        assert!(
            (row.indentation_depth / depth - 1.0).abs() < n.powi(-2)
                && (front - radius).abs() <= 1.01 * spacing
                && (rear + front).abs() <= 1e-12 * radius,
            "{row:?} instead of depth {depth}, radius {radius}"
        );
    }
}
