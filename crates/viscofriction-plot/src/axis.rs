//! Axes: label, scale, range, and the way from a value to a fraction of the axis.

use crate::error::PlotError;

/// Spacing of values along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps in the value.
    Linear,
    /// Equal steps in the decimal logarithm of the value.
    Log10,
}

/// One axis of a picture; values outside the range are refused.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity and unit, as "velocity v [m/s]".
    pub label: String,
    /// Spacing of values.
    pub scale: Scale,
    /// Lower and upper end, in the unit of the label.
    pub range: [f64; 2],
}

/// Share of an axis by which a value may miss its end through rounding (far below a pixel).
const ROUNDING: f64 = 1e-9;

impl Axis {
    /// Linear axis.
    #[must_use]
    pub fn linear(label: impl Into<String>, range: [f64; 2]) -> Self {
        Self {
            label: label.into(),
            scale: Scale::Linear,
            range,
        }
    }

    /// Logarithmic axis; the range must be positive.
    #[must_use]
    pub fn log10(label: impl Into<String>, range: [f64; 2]) -> Self {
        Self {
            label: label.into(),
            scale: Scale::Log10,
            range,
        }
    }

    /// Logarithmic axis over the whole decades around positive values; one decade when there are none.
    #[must_use]
    pub fn decades(label: impl Into<String>, values: impl Iterator<Item = f64>) -> Self {
        let [mut low, mut high] = [f64::INFINITY, 0.0_f64];
        for value in values {
            low = low.min(value);
            high = high.max(value);
        }
        if high <= 0.0 {
            return Self::log10(label, [0.1, 1.0]);
        }
        let [low, high] = [
            low.log10().floor(),
            (high.log10() * (1.0 + f64::EPSILON)).ceil(),
        ];
        Self::log10(label, [10_f64.powf(low), 10_f64.powf(high.max(low + 1.0))])
    }

    /// Refuses a range that cannot be drawn.
    pub(crate) fn validate(&self) -> Result<(), PlotError> {
        let [from, to] = self.range;
        let axis = || self.label.clone();
        if self.label.is_empty() {
            return Err(PlotError::Empty {
                what: "the label of an axis".into(),
            });
        }
        let span = to - from;
        // Below this span neighbouring ticks could not be told apart in floating point.
        let least = ROUNDING * from.abs().max(to.abs());
        if !span.is_finite() || span <= least {
            return Err(PlotError::Range {
                axis: axis(),
                from,
                to,
            });
        }
        if self.scale == Scale::Log10 && (from <= 0.0 || to / from < 2.0) {
            return Err(PlotError::LogRange {
                axis: axis(),
                from,
                to,
            });
        }
        Ok(())
    }

    /// Position on the axis, 0 at its lower and 1 at its upper end; not finite for a value that has none.
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        let [from, to] = self.range.map(|end| self.coordinate(end));
        (self.coordinate(value) - from) / (to - from)
    }

    /// Refuses a value that the axis does not show; `of` and `index` name it.
    pub(crate) fn check(&self, value: f64, of: &str, index: usize) -> Result<(), PlotError> {
        if !value.is_finite() {
            return Err(PlotError::NotFinite {
                of: of.into(),
                index,
                value,
            });
        }
        if (-ROUNDING..=1.0 + ROUNDING).contains(&self.fraction(value)) {
            return Ok(());
        }
        let [from, to] = self.range;
        Err(PlotError::OutsideRange {
            of: of.into(),
            axis: self.label.clone(),
            index,
            value,
            from,
            to,
        })
    }

    fn coordinate(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Log10 => value.log10(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_that_cannot_be_drawn_are_refused() {
        for range in [
            [1.0, 1.0],
            [2.0, 1.0],
            [f64::NAN, 1.0],
            [0.0, f64::INFINITY],
            [-f64::MAX, f64::MAX],
        ] {
            let got = Axis::linear("x [m]", range).validate();
            assert!(
                matches!(got, Err(PlotError::Range { .. })),
                "expected a range error for {range:?}, got {got:?}"
            );
        }
        for range in [[0.0, 1.0], [-1.0, 1.0], [1.0, 1.5]] {
            let got = Axis::log10("x [m]", range).validate();
            assert!(
                matches!(got, Err(PlotError::LogRange { .. })),
                "expected a logarithmic range error for {range:?}, got {got:?}"
            );
        }
    }

    #[test]
    fn values_outside_the_range_are_refused_and_its_ends_are_not() {
        let axis = Axis::log10("e [1]", [1e-14, 1e2]);
        for value in [1e-14, 10_f64.powf(-14.0), 3.0, 100.000_000_000_001] {
            assert_eq!(
                axis.check(value, "curve", 0),
                Ok(()),
                "{value} lies on the axis"
            );
        }
        for value in [0.99e-14, 101.0, 0.0, -1.0] {
            let got = axis.check(value, "curve", 7);
            assert!(
                matches!(got, Err(PlotError::OutsideRange { index: 7, .. })),
                "expected {value} to be refused, got {got:?}"
            );
        }
        for value in [f64::NAN, f64::INFINITY] {
            let got = axis.check(value, "curve", 3);
            assert!(
                matches!(got, Err(PlotError::NotFinite { index: 3, .. })),
                "expected {value} to be refused, got {got:?}"
            );
        }
    }

    #[test]
    fn tiny_values_keep_their_place_on_a_logarithmic_axis() {
        let got = Axis::log10("e [1]", [1e-16, 1.0]).fraction(1e-12);
        assert!((got - 0.25).abs() < 1e-12, "expected 0.25, got {got}");
    }
}
