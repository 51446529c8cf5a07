//! Data series: points, error bars, and the style of line and markers.

use crate::axis::Axis;
use crate::colour::Colour;
use crate::error::PlotError;

/// Points with a line through them, markers on them, or both.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Text in the legend; `None` for a series without an entry.
    pub label: Option<String>,
    /// Points (x, y) in the units of the axes, in drawing order.
    pub points: Vec<[f64; 2]>,
    /// Half lengths of symmetric error bars in y, one per point or none at all.
    pub errors: Vec<f64>,
    /// Half widths of a shaded band around the points in y, one per point or none at all.
    pub band: Vec<f64>,
    /// Line through the points.
    pub line: Option<Line>,
    /// Markers on the points.
    pub marker: Option<Marker>,
    /// Colour of line, markers and error bars.
    pub colour: Colour,
    /// Whether the line may leave the frame in y, where it is cut: for a reference that must not set the range of the axis.
    pub is_reference: bool,
    /// Number of arrowheads on the line, at equal distances, in the order of the points.
    pub arrows: usize,
}

/// Style of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    pub(crate) dash: Dash,
    /// Width of the line, \[px\].
    pub(crate) width: f64,
}

/// Pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Unbroken.
    Solid,
    /// Dashes.
    Dashed,
    /// Alternating dashes and dots.
    DashDot,
    /// Dots.
    Dotted,
}

/// Style and spacing of markers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Marker {
    /// Shape of the outline.
    pub shape: Shape,
    /// Fill of the interior.
    pub fill: Fill,
    /// Spacing n ≥ 1: markers are on every n-th point, starting with the first.
    pub every: usize,
}

/// Shape of the outline of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Circle.
    Circle,
    /// Square.
    Square,
    /// Square on its corner.
    Diamond,
    /// Two strokes; the fill has no effect.
    Plus,
    /// Small disc for many points under a line; the fill has no effect.
    Dot,
}

/// Fill of the interior of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fill {
    /// White.
    Open,
    /// In the colour of the series.
    Filled,
}

impl Line {
    /// Line of usual width.
    pub const fn thick(dash: Dash) -> Self {
        Self { dash, width: 1.8 }
    }

    /// Line of half the usual width.
    pub const fn thin(dash: Dash) -> Self {
        Self { dash, width: 0.9 }
    }
}

impl Marker {
    /// White marker with coloured outline on every point.
    pub const fn open(shape: Shape) -> Self {
        Self {
            shape,
            fill: Fill::Open,
            every: 1,
        }
    }

    /// Coloured marker on every point.
    pub const fn filled(shape: Shape) -> Self {
        Self {
            fill: Fill::Filled,
            ..Self::open(shape)
        }
    }
}

impl Series {
    /// Line without markers, label or error bars.
    pub const fn line(points: Vec<[f64; 2]>, line: Line, colour: Colour) -> Self {
        Self {
            label: None,
            points,
            errors: Vec::new(),
            band: Vec::new(),
            line: Some(line),
            marker: None,
            colour,
            is_reference: false,
            arrows: 0,
        }
    }

    /// Thin line that may leave the frame in y, where it is cut, without label.
    pub const fn reference(points: Vec<[f64; 2]>, dash: Dash, colour: Colour) -> Self {
        let mut series = Self::line(points, Line::thin(dash), colour);
        series.is_reference = true;
        series
    }

    /// Markers without line, label or error bars.
    pub fn markers(points: Vec<[f64; 2]>, marker: Marker, colour: Colour) -> Self {
        Self {
            line: None,
            marker: Some(marker),
            ..Self::line(points, Line::thin(Dash::Solid), colour)
        }
    }

    /// The series with a text in the legend.
    #[must_use]
    pub fn labelled(self, label: impl Into<String>) -> Self {
        Self {
            label: Some(label.into()),
            ..self
        }
    }

    /// Refuses points and error bars outside the axes, and an invisible series.
    pub(crate) fn validate(&self, x: &Axis, y: &Axis) -> Result<(), PlotError> {
        let name = self.label.as_deref().unwrap_or("a series without label");
        if let Some(what) = self.invisible_part() {
            return Err(PlotError::Empty(format!("the {what} of {name}")));
        }
        for (index, &[at, value]) in self.points.iter().enumerate() {
            x.check(at, name, index)?;
            if self.is_reference {
                y.check_position(value, name, index)?;
            } else {
                y.check(value, name, index)?;
            }
        }
        for (what, lengths) in [("error bars", &self.errors), ("band", &self.band)] {
            self.check_lengths(format!("{what} of {name}"), lengths, y)?;
        }
        Ok(())
    }

    /// Refuses missing or negative half lengths, and those that reach beyond the y axis.
    fn check_lengths(&self, of: String, lengths: &[f64], y: &Axis) -> Result<(), PlotError> {
        let [needed, given] = [self.points.len(), lengths.len()];
        if given > 0 && given != needed {
            return Err(PlotError::Count { of, needed, given });
        }
        for (index, (&[_, value], &length)) in self.points.iter().zip(lengths).enumerate() {
            if length < 0.0 {
                return Err(PlotError::Value {
                    of,
                    needed: "not be negative".into(),
                    index,
                    value: length,
                });
            }
            let name = self.label.as_deref().unwrap_or("a series without label");
            y.check(value - length, name, index)?;
            y.check(value + length, name, index)?;
        }
        Ok(())
    }

    /// The part that makes the series invisible; `None` for a visible one.
    fn invisible_part(&self) -> Option<&'static str> {
        // A line through one point is invisible.
        let is_drawn = self.marker.is_some() || (self.line.is_some() && self.points.len() > 1);
        if self.points.is_empty() {
            Some("list of points")
        } else if self.marker.is_some_and(|marker| marker.every == 0) {
            Some("marker spacing")
        } else {
            (!is_drawn).then_some("line and markers")
        }
    }
}
