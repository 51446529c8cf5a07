//! Data series: points, error bars, and the look of their line and markers.

use crate::axis::Axis;
use crate::colour::Colour;
use crate::error::PlotError;

/// Points with a line through them, markers on them, or both.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Text in the legend; a series without one is left out there.
    pub label: Option<String>,
    /// Points (x, y) in the units of the axes, in drawing order.
    pub points: Vec<[f64; 2]>,
    /// Half lengths of symmetric error bars in y, one per point.
    pub errors: Option<Vec<f64>>,
    /// Line through the points.
    pub line: Option<Line>,
    /// Markers on the points.
    pub marker: Option<Marker>,
    /// Colour of line, markers and error bars.
    pub colour: Colour,
}

/// Look of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Pattern.
    pub dash: Dash,
    /// Width, \[px\] of a picture 480 px wide.
    pub width: f64,
}

/// Pattern of a line.
#[allow(
    clippy::enum_variant_names,
    reason = "a dash-dot line has no other name"
)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Unbroken.
    Solid,
    /// Dashes.
    Dashed,
    /// Dashes and dots in turn.
    DashDot,
    /// Dots.
    Dotted,
}

/// Look and spacing of markers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Marker {
    /// Outline.
    pub shape: Shape,
    /// Inside.
    pub fill: Fill,
    /// A marker on every n-th point, from the first on; at least 1.
    pub every: usize,
}

/// Outline of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Circle.
    Circle,
    /// Square.
    Square,
    /// Square on its corner.
    Diamond,
    /// Two strokes, filled or not.
    Plus,
}

/// Inside of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fill {
    /// White.
    Open,
    /// In the colour of the series.
    Filled,
}

impl Line {
    /// Line of usual width.
    #[must_use]
    pub const fn thick(dash: Dash) -> Self {
        Self { dash, width: 1.8 }
    }

    /// Line of half the usual width.
    #[must_use]
    pub const fn thin(dash: Dash) -> Self {
        Self { dash, width: 0.9 }
    }
}

impl Marker {
    /// White marker with coloured outline on every point.
    #[must_use]
    pub const fn open(shape: Shape) -> Self {
        Self {
            shape,
            fill: Fill::Open,
            every: 1,
        }
    }

    /// Coloured marker on every point.
    #[must_use]
    pub const fn filled(shape: Shape) -> Self {
        Self {
            shape,
            fill: Fill::Filled,
            every: 1,
        }
    }
}

impl Series {
    /// Line without markers, label or error bars.
    #[must_use]
    pub const fn line(points: Vec<[f64; 2]>, line: Line, colour: Colour) -> Self {
        Self {
            label: None,
            points,
            errors: None,
            line: Some(line),
            marker: None,
            colour,
        }
    }

    /// Markers without line, label or error bars.
    #[must_use]
    pub const fn markers(points: Vec<[f64; 2]>, marker: Marker, colour: Colour) -> Self {
        Self {
            label: None,
            points,
            errors: None,
            line: None,
            marker: Some(marker),
            colour,
        }
    }

    /// Refuses points and error bars that the axes do not show.
    pub(crate) fn validate(&self, x: &Axis, y: &Axis) -> Result<(), PlotError> {
        let name = self.name();
        self.validate_look(name)?;
        for (index, &[at, value]) in self.points.iter().enumerate() {
            x.check(at, name, index)?;
            y.check(value, name, index)?;
        }
        let Some(errors) = &self.errors else {
            return Ok(());
        };
        if errors.len() != self.points.len() {
            return Err(PlotError::Count {
                of: format!("error bars of {name}"),
                needed: self.points.len(),
                given: errors.len(),
            });
        }
        for (index, (&[_, value], &error)) in self.points.iter().zip(errors).enumerate() {
            if error < 0.0 {
                return Err(PlotError::NegativeError {
                    of: name.into(),
                    index,
                    value: error,
                });
            }
            y.check(value - error, name, index)?;
            y.check(value + error, name, index)?;
        }
        Ok(())
    }

    fn validate_look(&self, name: &str) -> Result<(), PlotError> {
        let empty = |what: &str| {
            Err(PlotError::Empty {
                what: format!("the {what} of {name}"),
            })
        };
        if self.points.is_empty() {
            return empty("list of points");
        }
        if self.marker.is_some_and(|marker| marker.every == 0) {
            return empty("marker spacing");
        }
        if self
            .line
            .is_some_and(|line| !line.width.is_finite() || line.width <= 0.0)
        {
            return empty("line width");
        }
        // A line through one point leaves no trace.
        let visible = self.marker.is_some() || (self.line.is_some() && self.points.len() > 1);
        if visible { Ok(()) } else { empty("look") }
    }

    fn name(&self) -> &str {
        self.label.as_deref().unwrap_or("a series without label")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STAR: Marker = Marker::filled(Shape::Plus);

    fn refusal(series: &Series) -> Option<PlotError> {
        let x = Axis::linear("x [m]", [0.0, 1.0]);
        let y = Axis::log10("y [Pa]", [0.1, 10.0]);
        series.validate(&x, &y).err()
    }

    #[test]
    fn points_that_would_vanish_are_refused() {
        for point in [
            [f64::NAN, 1.0],
            [0.5, f64::INFINITY],
            [1.1, 1.0],
            [0.5, 0.0],
            [0.5, 11.0],
        ] {
            let got = refusal(&Series::markers(vec![[0.5, 1.0], point], STAR, Colour::Red));
            assert!(
                matches!(
                    got,
                    Some(
                        PlotError::NotFinite { index: 1, .. }
                            | PlotError::OutsideRange { index: 1, .. }
                    )
                ),
                "expected point 1 = {point:?} to be refused, got {got:?}"
            );
        }
    }

    #[test]
    fn error_bars_must_match_the_points_and_stay_inside() {
        let with = |errors: Vec<f64>| {
            refusal(&Series {
                errors: Some(errors),
                ..Series::markers(vec![[0.5, 1.0]], STAR, Colour::Red)
            })
        };
        assert_eq!(
            with(vec![0.5]),
            None,
            "an error bar inside the axis is drawn"
        );
        for errors in [
            vec![],
            vec![0.1, 0.1],
            vec![-0.1],
            vec![f64::NAN],
            vec![1.0],
            vec![9.5],
        ] {
            let text = format!("{errors:?}");
            assert!(
                with(errors).is_some(),
                "expected error bars {text} to be refused"
            );
        }
    }

    #[test]
    fn series_without_a_trace_are_refused() {
        let line = Line::thick(Dash::Solid);
        let unseen = [
            Series::line(vec![], line, Colour::Blue),
            Series::line(vec![[0.5, 1.0]], line, Colour::Blue),
            Series::markers(vec![[0.5, 1.0]], Marker { every: 0, ..STAR }, Colour::Blue),
            Series {
                line: None,
                ..Series::line(vec![[0.5, 1.0], [0.6, 1.0]], line, Colour::Blue)
            },
        ];
        for series in unseen {
            let got = refusal(&series);
            assert!(
                matches!(got, Some(PlotError::Empty { .. })),
                "expected {series:?} to be refused as empty, got {got:?}"
            );
        }
    }
}
