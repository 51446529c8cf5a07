//! Reasons to refuse a picture.

use thiserror::Error;

/// The reason for which a figure is refused.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlotError {
    /// The range of an axis or colour scale cannot be drawn.
    #[error("the range of '{axis}' must {needed}, it is {from} to {to}")]
    Range {
        /// Label of the axis or colour scale.
        axis: String,
        /// Condition that is not satisfied.
        needed: &'static str,
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// A value, or the end of its error bar, is not finite or lies outside the range that is drawn.
    #[error("value {index} of '{of}' must {needed}, it is {value}")]
    Value {
        /// Series, axis or colour scale.
        of: String,
        /// Condition that is not satisfied.
        needed: String,
        /// Position in the data, counted from zero.
        index: usize,
        /// Refused value.
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
    /// A part of a figure that would be invisible.
    #[error("{0} must not be empty")]
    Empty(String),
    /// The font lacks a character of this text.
    #[error("the font has no glyph for a character of '{0}'")]
    Glyph(String),
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
    /// The font or the SVG cannot be read, or the pixels cannot be allocated or encoded.
    #[error("the picture cannot be rendered: {0}")]
    Render(String),
}
