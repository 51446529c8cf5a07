//! Ticks and their labels: decades with minor ticks, or steps of 1, 2, 5 times a power of ten.

use crate::axis::{Axis, Scale};

/// Mark on an axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    /// Position in the unit of the axis.
    pub(crate) value: f64,
    /// Long or short.
    pub(crate) major: bool,
    /// Text, if it has one.
    pub(crate) label: Option<String>,
}

/// Largest number of labelled steps on a linear axis.
const MOST_STEPS: f64 = 6.0;
/// Largest number of labelled decades on a logarithmic axis.
const MOST_DECADES: f64 = 8.0;

/// Ticks of an axis from its lower to its upper end.
pub(crate) fn ticks(axis: &Axis) -> Vec<Tick> {
    match axis.scale {
        Scale::Linear => linear_ticks(axis),
        Scale::Log10 => log_ticks(axis),
    }
}

fn linear_ticks(axis: &Axis) -> Vec<Tick> {
    let [from, to] = axis.range;
    let (step, parts) = linear_step(to - from);
    let small = step / parts;
    let slack = 1e-6;
    let form = LinearForm::new(axis.range, step);
    let mut ticks = Vec::new();
    let mut count = (from / small - slack).ceil();
    while count <= to / small + slack {
        let value = small * count;
        let major = count.rem_euclid(parts) < 0.5;
        let label = major.then(|| form.label(value));
        ticks.push(Tick {
            value,
            major,
            label,
        });
        count += 1.0;
    }
    ticks
}

/// Distance of the labelled ticks and the number of parts minor ticks divide it into.
fn linear_step(span: f64) -> (f64, f64) {
    let least = span / MOST_STEPS;
    let decade = 10_f64.powf(least.log10().floor());
    let steps = [(1.0, 5.0), (2.0, 4.0), (5.0, 5.0)];
    steps
        .into_iter()
        .map(|(mantissa, parts)| (mantissa * decade, parts))
        .find(|&(step, _)| step >= least * (1.0 - 1e-9))
        .unwrap_or((10.0 * decade, 5.0))
}

/// Number form shared by all labels of a linear axis.
struct LinearForm {
    exponent: f64,
    decimals: usize,
}

impl LinearForm {
    fn new([from, to]: [f64; 2], step: f64) -> Self {
        let magnitude = from.abs().max(to.abs()).log10().floor();
        let plain = magnitude < 5.0 && step >= 0.999e-4;
        let exponent = if plain { 0.0 } else { magnitude };
        let mut decimals = 0;
        let mut rest = step / 10_f64.powf(exponent);
        while rest < 0.999 {
            rest *= 10.0;
            decimals += 1;
        }
        Self { exponent, decimals }
    }

    fn label(&self, value: f64) -> String {
        let mantissa = value / 10_f64.powf(self.exponent);
        let digits = format!("{mantissa:.*}", self.decimals);
        let is_zero = !digits.contains(|c: char| ('1'..='9').contains(&c));
        if is_zero {
            return "0".into();
        }
        let digits = digits.replace('-', "\u{2212}");
        if self.exponent.abs() < 0.5 {
            digits
        } else {
            format!("{digits}·{}", power_of_ten(self.exponent))
        }
    }
}

fn log_ticks(axis: &Axis) -> Vec<Tick> {
    let [from, to] = axis.range;
    let (first, last) = (from.log10().floor(), to.log10().ceil());
    let inside = |value: f64| value >= from * (1.0 - 1e-9) && value <= to * (1.0 + 1e-9);
    let form = LogForm::new(axis.range);
    let mut ticks = Vec::new();
    let mut exponent = first;
    while exponent <= last {
        let mut mantissa = 1.0;
        while mantissa < 9.5 {
            let value = mantissa * 10_f64.powf(exponent);
            if inside(value) && form.shows(mantissa) {
                ticks.push(Tick {
                    value,
                    major: mantissa < 1.5,
                    label: form.label(mantissa, exponent),
                });
            }
            mantissa += 1.0;
        }
        exponent += 1.0;
    }
    ticks
}

/// Choice of labels of a logarithmic axis.
struct LogForm {
    /// Every n-th decade is labelled.
    stride: f64,
    /// Number of powers of ten on the axis.
    powers: f64,
    /// Decimal numbers instead of powers of ten.
    plain: bool,
}

impl LogForm {
    fn new([from, to]: [f64; 2]) -> Self {
        let powers = (to.log10() + 1e-9).floor() - (from.log10() - 1e-9).ceil() + 1.0;
        Self {
            stride: (powers / MOST_DECADES).ceil().max(1.0),
            powers,
            plain: powers < 1.5 && from >= 0.999e-3 && to <= 1.001e5,
        }
    }

    /// Minor ticks are left out where they would run together.
    fn shows(&self, mantissa: f64) -> bool {
        mantissa < 1.5 || self.powers < MOST_DECADES + 1.5
    }

    fn label(&self, mantissa: f64, exponent: f64) -> Option<String> {
        let is_power = mantissa < 1.5;
        let labelled = if self.powers > 1.5 {
            is_power && exponent.rem_euclid(self.stride) < 0.5
        } else if self.powers > 0.5 {
            [1.0, 2.0, 5.0]
                .iter()
                .any(|shown| (mantissa - shown).abs() < 0.5)
        } else {
            true
        };
        labelled.then(|| self.text(mantissa, exponent))
    }

    fn text(&self, mantissa: f64, exponent: f64) -> String {
        if self.plain {
            let decimals = [-1.0, -2.0, -3.0]
                .iter()
                .filter(|&&e| exponent < e + 0.5)
                .count();
            return format!("{:.*}", decimals, mantissa * 10_f64.powf(exponent));
        }
        if mantissa < 1.5 {
            power_of_ten(exponent)
        } else {
            format!("{mantissa:.0}·{}", power_of_ten(exponent))
        }
    }
}

/// 10 with a superscript exponent.
fn power_of_ten(exponent: f64) -> String {
    let superscript = |c: char| match c {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        other => other,
    };
    // Adding zero turns a negative zero into zero.
    let digits = format!("{:.0}", exponent + 0.0);
    format!("10{}", digits.chars().map(superscript).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        ticks(axis)
            .into_iter()
            .filter_map(|tick| tick.label)
            .collect()
    }

    #[test]
    fn decades_are_labelled_with_superscripts() {
        let got = labels(&Axis::log10("Ω", [1e-4, 1e2]));
        let expected = ["10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹", "10²"];
        assert_eq!(got, expected, "labels of 1e-4 to 1e2");
    }

    #[test]
    fn each_decade_has_eight_minor_ticks() {
        let got = ticks(&Axis::log10("Ω", [1e-4, 1e2]));
        let minor = got.iter().filter(|tick| !tick.major).count();
        assert_eq!(minor, 48, "minor ticks on six decades");
        assert_eq!(got.len(), 55, "all ticks on six decades");
    }

    #[test]
    fn decades_far_below_unity_keep_their_ticks() {
        let got = labels(&Axis::log10("e", [1e-16, 1e-12]));
        let expected = ["10⁻¹⁶", "10⁻¹⁵", "10⁻¹⁴", "10⁻¹³", "10⁻¹²"];
        assert_eq!(got, expected, "labels of 1e-16 to 1e-12");
    }

    #[test]
    fn short_logarithmic_axes_are_labelled_between_the_decades() {
        let cases: [([f64; 2], &[&str]); 3] = [
            ([40.0, 800.0], &["50", "100", "200", "500"]),
            ([0.02, 0.2], &["0.02", "0.05", "0.1", "0.2"]),
            (
                [2e-7, 6e-7],
                &["2·10⁻⁷", "3·10⁻⁷", "4·10⁻⁷", "5·10⁻⁷", "6·10⁻⁷"],
            ),
        ];
        for (range, expected) in cases {
            assert_eq!(
                labels(&Axis::log10("n", range)),
                expected,
                "labels of {range:?}"
            );
        }
    }

    #[test]
    fn many_decades_are_labelled_in_strides() {
        let got = labels(&Axis::log10("t", [1e-12, 1e6]));
        let expected = ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰", "10³", "10⁶"];
        assert_eq!(got, expected, "labels of 1e-12 to 1e6");
    }

    #[test]
    fn linear_steps_are_round_and_share_their_decimals() {
        let cases: [([f64; 2], &[&str]); 5] = [
            ([0.0, 0.2], &["0", "0.05", "0.10", "0.15", "0.20"]),
            ([0.0, 16.0], &["0", "5", "10", "15"]),
            ([-1.0, 1.0], &["−1.0", "−0.5", "0", "0.5", "1.0"]),
            (
                [0.0, 3e6],
                &[
                    "0",
                    "0.5·10⁶",
                    "1.0·10⁶",
                    "1.5·10⁶",
                    "2.0·10⁶",
                    "2.5·10⁶",
                    "3.0·10⁶",
                ],
            ),
            (
                [0.0, 2e-6],
                &["0", "0.5·10⁻⁶", "1.0·10⁻⁶", "1.5·10⁻⁶", "2.0·10⁻⁶"],
            ),
        ];
        for (range, expected) in cases {
            assert_eq!(
                labels(&Axis::linear("x", range)),
                expected,
                "labels of {range:?}"
            );
        }
    }
}
