//! Reasons to refuse a picture.

use thiserror::Error;

/// What a figure must satisfy and what was given instead.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlotError {
    /// An axis or colour range is not finite or does not increase.
    #[error("the range of '{axis}' must be finite and increase, it is {from} to {to}")]
    Range {
        /// Label of the axis.
        axis: String,
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// A logarithmic range is not positive or too short to carry tick labels.
    #[error(
        "the logarithmic range of '{axis}' must be positive and span a factor of 2 or more, it is {from} to {to}"
    )]
    LogRange {
        /// Label of the axis.
        axis: String,
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// A map was given a logarithmic axis.
    #[error("a map needs linear axes, '{axis}' is logarithmic")]
    LogMap {
        /// Label of the axis.
        axis: String,
    },
    /// A value is NaN or infinite.
    #[error("value {index} of '{of}' must be finite, it is {value}")]
    NotFinite {
        /// Series, axis or colour scale.
        of: String,
        /// Position in the data, counted from zero.
        index: usize,
        /// Refused value.
        value: f64,
    },
    /// A value, or the end of its error bar, lies outside the range that is drawn.
    #[error("value {index} of '{of}' must lie in {from} to {to} of '{axis}', it reaches {value}")]
    OutsideRange {
        /// Series or map.
        of: String,
        /// Axis or colour scale that does not reach so far.
        axis: String,
        /// Position in the data, counted from zero.
        index: usize,
        /// Refused value.
        value: f64,
        /// Lower end of the axis.
        from: f64,
        /// Upper end of the axis.
        to: f64,
    },
    /// An error bar has a negative length.
    #[error("error bar {index} of '{of}' must not be negative, it is {value}")]
    NegativeError {
        /// Series.
        of: String,
        /// Position in the data, counted from zero.
        index: usize,
        /// Refused length.
        value: f64,
    },
    /// Two lists that belong together differ in length.
    #[error("'{of}' needs {needed} values, {given} were given")]
    Count {
        /// Series or map.
        of: String,
        /// Number of values needed.
        needed: usize,
        /// Number of values given.
        given: usize,
    },
    /// Something that would leave no trace in the picture.
    #[error("{what} must not be empty")]
    Empty {
        /// Part of the figure.
        what: String,
    },
    /// The font lacks a character.
    #[error("the font has no glyph for a character of '{text}'")]
    Glyph {
        /// Refused text.
        text: String,
    },
    /// A text does not fit into its place.
    #[error("'{text}' needs {needed:.0} pixels, {available:.0} are available")]
    TextWidth {
        /// Refused text.
        text: String,
        /// Width of the text, \[px\].
        needed: f64,
        /// Width at hand, \[px\].
        available: f64,
    },
    /// The bundled font could not be read.
    #[error("the bundled font cannot be read: {0}")]
    Font(String),
    /// The SVG could not be read.
    #[error("the SVG cannot be read: {0}")]
    Svg(String),
    /// The pixel picture could not be made.
    #[error("a picture {width} pixels wide cannot be made: {reason}")]
    Png {
        /// Width asked for, \[px\].
        width: u32,
        /// What the renderer said.
        reason: String,
    },
}
