//! Ticks and their labels: decades with minor ticks, or steps of 1, 2 or 5 times a power of ten.

use std::iter::successors;

use crate::axis::{Axis, Scale};

/// Mark on an axis.
pub(crate) struct Tick {
    /// Position in the unit of the axis.
    pub(crate) value: f64,
    /// Whether the tick is a long one.
    pub(crate) major: bool,
    /// Text; `None` for a tick without a label.
    pub(crate) label: Option<String>,
}

/// Largest number of labelled steps on a linear axis. Chosen: with more the labels of a narrow axis would collide.
const MAX_LABELLED_STEPS: f64 = 6.0;
/// Largest number of labelled decades on a logarithmic axis (chosen); of more every n-th is labelled.
const MAX_LABELLED_DECADES: f64 = 8.0;
/// Largest number of decades of a logarithmic axis that is labelled in a prefixed unit. Chosen: neighbouring prefixes are
/// three decades apart.
const MAX_PREFIXED_DECADES: f64 = 3.0;
/// Largest number of decades of an axis whose labels stand at 1, 2 and 5 (chosen: more would collide).
const MAX_SUBDIVIDED_DECADES: f64 = 1.5;

/// Ticks of an axis from its lower to its upper end.
pub(crate) fn ticks(axis: &Axis) -> Vec<Tick> {
    match axis.scale {
        Scale::Linear => linear_ticks(axis),
        Scale::Log10 => log_ticks(axis.range, 10_f64.powf(log_exponent(axis))),
    }
}

/// Ticks of a linear axis: labelled ones at the steps of [`linear_step`], and minor ones between them.
fn linear_ticks(axis: &Axis) -> Vec<Tick> {
    let [from, to] = axis.range;
    let (step, parts) = linear_step(to - from);
    // All labels have the power of ten of the axis and the same number of decimals.
    let unit = 10_f64.powf(linear_exponent(axis));
    let rests = successors(Some(step / unit), |rest| Some(10.0 * rest));
    let decimals = rests.take_while(|rest| *rest < 0.999).count();
    let label = |value: f64| {
        let digits = format!("{:.decimals$}", value / unit);
        if !digits.contains(|c: char| ('1'..='9').contains(&c)) {
            return "0".into();
        }
        digits.replace('-', "\u{2212}")
    };
    let (small, slack) = (step / parts, 1e-6);
    whole_numbers((from / small - slack).ceil(), to / small + slack)
        .map(|count| {
            let (value, major) = (small * count, count.rem_euclid(parts) < 0.5);
            let label = major.then(|| label(value));
            Tick {
                value,
                major,
                label,
            }
        })
        .collect()
}

/// Power of ten in which the labels of a linear axis are expressed.
///
/// It is that of the prefix of the unit. For a unit without prefixes it is that of the step if plain numbers would be long,
/// else 0.
fn linear_exponent(axis: &Axis) -> f64 {
    let [from, to] = axis.range;
    let largest = from.abs().max(to.abs());
    if unit(axis).is_some_and(|unit| PREFIXED_UNITS.contains(&unit)) {
        return prefix_exponent(largest);
    }
    let (step, _) = linear_step(to - from);
    let is_plain = largest < 1e5 && step >= 0.999e-4;
    if is_plain {
        0.0
    } else {
        (step.log10() + 1e-9).floor()
    }
}

/// Power of ten of the prefix in which the labels of a logarithmic axis are expressed; 0 for a unit without prefixes, and for
/// more than [`MAX_PREFIXED_DECADES`], which powers of ten label better.
fn log_exponent(axis: &Axis) -> f64 {
    let [from, to] = axis.range;
    let is_short = to <= from * 10_f64.powf(MAX_PREFIXED_DECADES + 1e-9);
    let has_prefix = unit(axis).is_some_and(|unit| PREFIXED_UNITS.contains(&unit));
    if is_short && has_prefix {
        prefix_exponent(to)
    } else {
        0.0
    }
}

/// Exponent of the largest prefix with which a number is at least 1.
fn prefix_exponent(largest: f64) -> f64 {
    3.0 * ((largest.log10() + 1e-9) / 3.0).floor().clamp(-4.0, 3.0)
}

/// Units that take a prefix, such as lengths in mm, µm or nm.
const PREFIXED_UNITS: [&str; 6] = ["m", "s", "m/s", "N", "Pa", "N/m"];
/// Prefixes from 10⁻¹² in steps of 10³.
const PREFIXES: [&str; 8] = ["p", "n", "µ", "m", "", "k", "M", "G"];

/// Unit of an axis, in brackets after its quantity; `None` without one.
fn unit(axis: &Axis) -> Option<&str> {
    let bare = axis.label.strip_suffix(']')?;
    bare.rsplit_once('[').map(|(_, unit)| unit)
}

/// Label of an axis, with the prefix or the power of ten of its ticks before the unit.
pub(crate) fn label(axis: &Axis) -> String {
    let exponent = match axis.scale {
        Scale::Linear => linear_exponent(axis),
        Scale::Log10 => log_exponent(axis),
    };
    if exponent.abs() < 0.5 {
        return axis.label.clone();
    }
    let power = power_of_ten(exponent);
    let Some(unit) = unit(axis) else {
        return format!("{} [{power}]", axis.label);
    };
    let name = &axis.label[..axis.label.len() - unit.len() - 1];
    let steps = whole_numbers(-4.0, 3.0).map(|step| 3.0 * step);
    let mut prefixes = steps
        .zip(PREFIXES)
        .filter(|(step, _)| (step - exponent).abs() < 0.5);
    match prefixes.next().filter(|_| PREFIXED_UNITS.contains(&unit)) {
        Some((_, prefix)) => format!("{name}{prefix}{unit}]"),
        None => format!("{name}{power} {unit}]"),
    }
}

/// Whole numbers from `first` to `last`, as floating-point numbers.
pub(crate) fn whole_numbers(first: f64, last: f64) -> impl Iterator<Item = f64> {
    successors(Some(first), |count| Some(count + 1.0)).take_while(move |count| *count <= last)
}

/// Distance of the labelled ticks: the smallest of 1, 2 and 5 times a power of ten with at most [`MAX_LABELLED_STEPS`] steps in
/// `span`; and number of parts into which minor ticks divide it.
fn linear_step(span: f64) -> (f64, f64) {
    let least = span / MAX_LABELLED_STEPS;
    let decade = 10_f64.powf(least.log10().floor());
    let steps = [(1.0, 5.0), (2.0, 4.0), (5.0, 5.0)].into_iter();
    steps
        .map(|(mantissa, parts)| (mantissa * decade, parts))
        .find(|&(step, _)| step >= least * (1.0 - 1e-9))
        .unwrap_or((10.0 * decade, 5.0))
}

/// Ticks of a logarithmic axis: major ones at powers of ten, minor ones at their multiples. Over less than two decades the
/// multiples 2 and 5 are labelled too, over less than one all. The labels count in `unit`.
fn log_ticks(range: [f64; 2], unit: f64) -> Vec<Tick> {
    let [from, to] = range.map(|end| end / unit);
    let powers = (to.log10() + 1e-9).floor() - (from.log10() - 1e-9).ceil() + 1.0;
    // Every n-th decade is labelled.
    let stride = (powers / MAX_LABELLED_DECADES).ceil().max(1.0);
    let is_subdivided = (to / from).log10() < MAX_SUBDIVIDED_DECADES;
    let is_labelled = |mantissa: f64, exponent: f64| {
        let is_near = |shown: &f64| (mantissa - shown).abs() < 0.5;
        if !is_subdivided {
            is_near(&1.0) && exponent.rem_euclid(stride) < 0.5
        } else {
            powers < 0.5 || [1.0, 2.0, 5.0].iter().any(is_near)
        }
    };
    let is_prefixed = (unit - 1.0).abs() > 1e-9;
    let is_plain = (is_subdivided || is_prefixed) && from >= 0.999e-3 && to <= 1.001e5;
    let label = |mantissa: f64, exponent: f64| {
        if is_plain {
            let decimals = whole_numbers(1.0, -exponent).count();
            format!("{:.decimals$}", mantissa * 10_f64.powf(exponent))
        } else if mantissa < 1.5 {
            power_of_ten(exponent)
        } else {
            format!("{mantissa:.0}·{}", power_of_ten(exponent))
        }
    };
    // Minor ticks are left out if they would be too close.
    let shows_minor = powers < MAX_LABELLED_DECADES + 1.5;
    let is_inside = |value: f64| value >= from * (1.0 - 1e-9) && value <= to * (1.0 + 1e-9);
    whole_numbers(from.log10().floor(), to.log10().ceil())
        .flat_map(|exponent| whole_numbers(1.0, 9.0).map(move |mantissa| (mantissa, exponent)))
        .map(|(mantissa, exponent)| Tick {
            value: unit * mantissa * 10_f64.powf(exponent),
            major: mantissa < 1.5,
            label: is_labelled(mantissa, exponent).then(|| label(mantissa, exponent)),
        })
        .filter(|tick| is_inside(tick.value / unit) && (tick.major || shows_minor))
        .collect()
}

/// Text of 10 with a superscript exponent.
fn power_of_ten(exponent: f64) -> String {
    /// Superscripts of the digits 0 to 9.
    const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let superscript = |c: char| {
        c.to_digit(10)
            .map_or('⁻', |digit| SUPERSCRIPTS[digit as usize])
    };
    // Adding zero turns a negative zero into zero.
    let digits = format!("{:.0}", exponent + 0.0);
    format!("10{}", digits.chars().map(superscript).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_round_few_and_share_their_form() {
        let log = |range| Axis::log10("Ω", range);
        let linear = |range| Axis::linear("x", range);
        let cases = [
            (log([1e-4, 1e2]), "10⁻⁴ 10⁻³ 10⁻² 10⁻¹ 10⁰ 10¹ 10²"),
            (log([1e-16, 1e-12]), "10⁻¹⁶ 10⁻¹⁵ 10⁻¹⁴ 10⁻¹³ 10⁻¹²"),
            // Many decades are labelled in strides, short axes between the decades.
            (log([1e-12, 1e6]), "10⁻¹² 10⁻⁹ 10⁻⁶ 10⁻³ 10⁰ 10³ 10⁶"),
            (log([40.0, 800.0]), "50 100 200 500"),
            (log([0.02, 0.2]), "0.02 0.05 0.1 0.2"),
            (log([2e-7, 6e-7]), "2·10⁻⁷ 3·10⁻⁷ 4·10⁻⁷ 5·10⁻⁷ 6·10⁻⁷"),
            // The labels count in MPa.
            (Axis::log10("P [Pa]", [1.2e5, 2e6]), "0.2 0.5 1 2"),
            (Axis::log10("P [Pa]", [1e4, 1e6]), "0.01 0.1 1"),
            (linear([0.0, 0.2]), "0 0.05 0.10 0.15 0.20"),
            (linear([0.0, 16.0]), "0 5 10 15"),
            (linear([-1.0, 1.0]), "−1.0 −0.5 0 0.5 1.0"),
            (linear([0.0, 3e6]), "0 5 10 15 20 25 30"),
            (linear([-1e-6, 1e-6]), "−10 −5 0 5 10"),
        ];
        for (axis, expected) in cases {
            let labels = ticks(&axis).into_iter().filter_map(|tick| tick.label);
            let got = labels.collect::<Vec<_>>().join(" ");
            assert_eq!(got, expected, "labels of {axis:?}");
        }
    }

    #[test]
    fn the_power_of_ten_stands_at_the_axis() {
        let cases = [
            (Axis::linear("x [m]", [-1e-6, 1e-6]), "x [µm]"),
            (Axis::linear("x [m]", [0.0, 0.02]), "x [mm]"),
            (
                Axis::linear("pressure [Pa]", [0.0, 2.5e6]),
                "pressure [MPa]",
            ),
            (Axis::linear("k [1/m]", [0.0, 2e6]), "k [10⁵ 1/m]"),
            (Axis::linear("friction", [0.0, 2e-4]), "friction [10⁻⁵]"),
            (Axis::linear("x [m]", [0.0, 3.0]), "x [m]"),
            (Axis::log10("x [m]", [1e-9, 1e-3]), "x [m]"),
            (Axis::log10("x [m]", [1e-9, 1e-6]), "x [µm]"),
            (Axis::log10("P [Pa]", [1.2e5, 2e6]), "P [MPa]"),
        ];
        for (axis, expected) in cases {
            assert_eq!(label(&axis), expected, "label of {axis:?}");
        }
    }

    #[test]
    fn each_decade_has_eight_minor_ticks() {
        let got = ticks(&Axis::log10("Ω", [1e-4, 1e2]));
        let minor = got.iter().filter(|tick| !tick.major).count();
        let what = "minor and all ticks on six decades";
        assert_eq!([minor, got.len()], [48, 55], "{what}");
    }
}
