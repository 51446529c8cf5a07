//! Ticks and their labels: decades with minor ticks, or steps of 1, 2, 5 times a power of ten.

use std::iter::successors;

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
        Scale::Linear => linear_ticks(axis.range),
        Scale::Log10 => log_ticks(axis.range),
    }
}

fn linear_ticks([from, to]: [f64; 2]) -> Vec<Tick> {
    let (step, parts) = linear_step(to - from);
    let small = step / parts;
    let slack = 1e-6;
    let form = LinearForm::new([from, to], step);
    let last = to / small + slack;
    counts((from / small - slack).ceil(), last)
        .map(|count| {
            let value = small * count;
            let major = count.rem_euclid(parts) < 0.5;
            Tick {
                value,
                major,
                label: major.then(|| form.label(value)),
            }
        })
        .collect()
}

/// Whole numbers.
fn counts(first: f64, last: f64) -> impl Iterator<Item = f64> {
    successors(Some(first), |count| Some(count + 1.0)).take_while(move |count| *count <= last)
}

/// Distance of the labelled ticks and the number of parts minor ticks divide it into.
fn linear_step(span: f64) -> (f64, f64) {
    let least = span / MOST_STEPS;
    let decade = 10_f64.powf(least.log10().floor());
    let steps = [(1.0, 5.0), (2.0, 4.0), (5.0, 5.0)].into_iter();
    steps
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
        let rest = step / 10_f64.powf(exponent);
        let decimals = successors(Some(rest), |rest| Some(10.0 * rest)).take_while(|r| *r < 0.999);
        Self {
            exponent,
            decimals: decimals.count(),
        }
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

fn log_ticks([from, to]: [f64; 2]) -> Vec<Tick> {
    let form = LogForm::new([from, to]);
    let inside = |value: f64| value >= from * (1.0 - 1e-9) && value <= to * (1.0 + 1e-9);
    counts(from.log10().floor(), to.log10().ceil())
        .flat_map(|exponent| counts(1.0, 9.0).map(move |mantissa| (mantissa, exponent)))
        .map(|(mantissa, exponent)| Tick {
            value: mantissa * 10_f64.powf(exponent),
            major: mantissa < 1.5,
            label: form.label(mantissa, exponent),
        })
        .filter(|tick| inside(tick.value) && (tick.major || form.shows_minor()))
        .collect()
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
    fn shows_minor(&self) -> bool {
        self.powers < MOST_DECADES + 1.5
    }

    fn label(&self, mantissa: f64, exponent: f64) -> Option<String> {
        let is_near = |shown: &f64| (mantissa - shown).abs() < 0.5;
        let labelled = if self.powers > 1.5 {
            is_near(&1.0) && exponent.rem_euclid(self.stride) < 0.5
        } else {
            self.powers < 0.5 || [1.0, 2.0, 5.0].iter().any(is_near)
        };
        labelled.then(|| self.text(mantissa, exponent))
    }

    fn text(&self, mantissa: f64, exponent: f64) -> String {
        if self.plain {
            let behind_point = |place: &&f64| exponent < *place + 0.5;
            let decimals = [-1.0, -2.0, -3.0].iter().filter(behind_point).count();
            format!("{:.*}", decimals, mantissa * 10_f64.powf(exponent))
        } else if mantissa < 1.5 {
            power_of_ten(exponent)
        } else {
            format!("{mantissa:.0}·{}", power_of_ten(exponent))
        }
    }
}

/// 10 with a superscript exponent.
fn power_of_ten(exponent: f64) -> String {
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
            (linear([0.0, 0.2]), "0 0.05 0.10 0.15 0.20"),
            (linear([0.0, 16.0]), "0 5 10 15"),
            (linear([-1.0, 1.0]), "−1.0 −0.5 0 0.5 1.0"),
            (
                linear([0.0, 3e6]),
                "0 0.5·10⁶ 1.0·10⁶ 1.5·10⁶ 2.0·10⁶ 2.5·10⁶ 3.0·10⁶",
            ),
            (linear([0.0, 2e-6]), "0 0.5·10⁻⁶ 1.0·10⁻⁶ 1.5·10⁻⁶ 2.0·10⁻⁶"),
        ];
        for (axis, expected) in cases {
            let labels = ticks(&axis).into_iter().filter_map(|tick| tick.label);
            let got = labels.collect::<Vec<_>>().join(" ");
            assert_eq!(got, expected, "labels of {axis:?}");
        }
    }

    #[test]
    fn each_decade_has_eight_minor_ticks() {
        let got = ticks(&Axis::log10("Ω", [1e-4, 1e2]));
        let minor = got.iter().filter(|tick| !tick.major).count();
        assert_eq!(
            [minor, got.len()],
            [48, 55],
            "minor and all ticks on six decades"
        );
    }
}
