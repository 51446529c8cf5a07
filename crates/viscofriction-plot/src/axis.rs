//! Axes: label, scale, range, and the position of a value on the axis.

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
    /// Quantity and unit, such as "velocity v [m/s]".
    pub label: String,
    /// Spacing of values.
    pub scale: Scale,
    /// Lower and upper end, in the unit of the label.
    pub range: [f64; 2],
}

/// Largest distance of a value beyond the end of an axis, relative to its length (chosen: far below a pixel).
const EDGE_TOLERANCE: f64 = 1e-9;

impl Axis {
    /// Linear axis.
    pub fn linear(label: impl Into<String>, range: [f64; 2]) -> Self {
        Self {
            label: label.into(),
            scale: Scale::Linear,
            range,
        }
    }

    /// Logarithmic axis; the range must be positive.
    pub fn log10(label: impl Into<String>, range: [f64; 2]) -> Self {
        Self {
            scale: Scale::Log10,
            ..Self::linear(label, range)
        }
    }

    /// Logarithmic axis over the whole decades around positive values; one decade when there are none.
    pub fn decades(label: impl Into<String>, values: impl Iterator<Item = f64>) -> Self {
        let [low, high] = values.fold([f64::INFINITY, 0.0_f64], |[low, high], value| {
            [low.min(value), high.max(value)]
        });
        if high <= 0.0 {
            return Self::log10(label, [0.1, 1.0]);
        }
        let first = low.log10().floor();
        let last = (high.log10() * (1.0 + f64::EPSILON))
            .ceil()
            .max(first + 1.0);
        Self::log10(label, [first, last].map(|decade| 10_f64.powf(decade)))
    }

    /// Refuses a range that cannot be drawn.
    pub(crate) fn validate(&self) -> Result<(), PlotError> {
        let [from, to] = self.range;
        if self.label.is_empty() {
            return Err(PlotError::Empty("the label of an axis".into()));
        }
        let span = to - from;
        // For a smaller span neighbouring ticks would be equal after rounding.
        let least = EDGE_TOLERANCE * from.abs().max(to.abs());
        if !span.is_finite() || span <= least {
            return Err(self.refused("be finite and increase"));
        }
        if self.scale == Scale::Log10 && (from <= 0.0 || to / from < 2.0) {
            return Err(self.refused("be positive and span a factor of 2 or more"));
        }
        Ok(())
    }

    /// Error for a range that does not satisfy a condition.
    pub(crate) fn refused(&self, needed: &'static str) -> PlotError {
        let [from, to] = self.range;
        PlotError::Range {
            axis: self.label.clone(),
            needed,
            from,
            to,
        }
    }

    /// Position on the axis, 0 at its lower and 1 at its upper end; not finite for a value without a position.
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        let coordinate = |value: f64| match self.scale {
            Scale::Linear => value,
            Scale::Log10 => value.log10(),
        };
        let [from, to] = self.range.map(coordinate);
        (coordinate(value) - from) / (to - from)
    }

    /// Refuses a value without a position on the axis or its continuation; `of` and `index` name it in the message.
    pub(crate) fn check_position(
        &self,
        value: f64,
        of: &str,
        index: usize,
    ) -> Result<(), PlotError> {
        if self.fraction(value).is_finite() {
            return Ok(());
        }
        Err(PlotError::Value {
            of: of.into(),
            needed: format!("have a position along '{}'", self.label),
            index,
            value,
        })
    }

    /// Refuses a value outside the range; `of` and `index` name it in the message.
    pub(crate) fn check(&self, value: f64, of: &str, index: usize) -> Result<(), PlotError> {
        if (-EDGE_TOLERANCE..=1.0 + EDGE_TOLERANCE).contains(&self.fraction(value)) {
            return Ok(());
        }
        let [from, to] = self.range;
        Err(PlotError::Value {
            of: of.into(),
            needed: format!("lie in {from} to {to} of '{}'", self.label),
            index,
            value,
        })
    }
}
