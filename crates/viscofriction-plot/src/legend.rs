//! The legend: where it stands and what it shows.

use crate::canvas::{Anchor, Area, Canvas, Pen, Pixel};
use crate::error::PlotError;
use crate::font::text_width;
use crate::frame::Frame;
use crate::marks::{MARKER_RADIUS, draw_marker, error_ends, line_pen};
use crate::series::Series;

/// Place of the legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LegendPlace {
    /// The first corner without data under the legend, or below the chart if there is none.
    #[default]
    Free,
    /// Inside, upper left corner.
    TopLeft,
    /// Inside, upper right corner.
    TopRight,
    /// Inside, lower left corner.
    BottomLeft,
    /// Inside, lower right corner.
    BottomRight,
    /// Below the label of the x axis.
    Below,
    /// Nowhere.
    Hidden,
}

const TEXT_SIZE: u32 = 12;
const ROW: f64 = 18.0;
/// Length of the line drawn as a sample, \[px\].
const SAMPLE: f64 = 34.0;
const PADDING: f64 = 6.0;
/// Distance from the frame, \[px\]; clear of the ticks.
const INSET: f64 = 10.0;
const COLUMN_GAP: f64 = 18.0;

/// Legend with its place found.
pub(crate) struct Legend<'a> {
    entries: Vec<(&'a Series, &'a str)>,
    /// Width of one column with sample and text, \[px\].
    column: f64,
    columns: usize,
    spot: Spot,
}

enum Spot {
    Nowhere,
    Inside(Area),
    Below,
}

/// Finds the place of the legend of some series in a frame.
pub(crate) fn plan<'a>(
    series: &'a [Series],
    frame: &Frame,
    place: LegendPlace,
) -> Result<Legend<'a>, PlotError> {
    let entries: Vec<_> = series
        .iter()
        .filter_map(|one| Some((one, one.label.as_deref()?)))
        .collect();
    let mut column: f64 = 0.0;
    for (_, label) in &entries {
        column = column.max(SAMPLE + PADDING + text_width(label, TEXT_SIZE)?);
    }
    let mut legend = Legend {
        entries,
        column,
        columns: 1,
        spot: Spot::Nowhere,
    };
    if legend.entries.is_empty() || place == LegendPlace::Hidden {
        return Ok(legend);
    }
    legend.check_width(frame)?;
    legend.spot = legend.find_spot(series, frame, place);
    if matches!(legend.spot, Spot::Below) {
        legend.columns = legend.columns_below(frame.area.width);
    }
    Ok(legend)
}

impl Legend<'_> {
    /// Height taken below the chart, \[px\].
    pub(crate) fn height_below(&self) -> f64 {
        match self.spot {
            Spot::Below => to_f64(self.rows()) * ROW + PADDING,
            Spot::Inside(_) | Spot::Nowhere => 0.0,
        }
    }

    /// Draws the legend; `bottom` is where a legend below the chart begins.
    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame, bottom: f64) {
        let start = match self.spot {
            Spot::Nowhere => return,
            Spot::Inside(area) => {
                canvas.rectangle(area, "#ffffff", &Pen::solid("#999999", 0.7));
                [area.left + PADDING, area.top + PADDING / 2.0]
            }
            Spot::Below => {
                let count = to_f64(self.columns);
                let width = count * self.column + (count - 1.0) * COLUMN_GAP;
                [
                    frame.area.left + (frame.area.width - width) / 2.0,
                    bottom + PADDING / 2.0,
                ]
            }
        };
        for (index, &(series, label)) in self.entries.iter().enumerate() {
            let (column, row) = (index / self.rows(), index % self.rows());
            let left = start[0] + to_f64(column) * (self.column + COLUMN_GAP);
            let middle = start[1] + (to_f64(row) + 0.5) * ROW;
            draw_entry(canvas, [left, middle], series, label);
        }
    }

    fn check_width(&self, frame: &Frame) -> Result<(), PlotError> {
        let available = frame.area.width - 2.0 * (INSET + PADDING);
        if self.column <= available {
            return Ok(());
        }
        let labels: Vec<&str> = self.entries.iter().map(|&(_, label)| label).collect();
        Err(PlotError::TextWidth {
            text: labels.join(", "),
            needed: self.column,
            available,
        })
    }

    fn find_spot(&self, series: &[Series], frame: &Frame, place: LegendPlace) -> Spot {
        let corners = [
            LegendPlace::TopRight,
            LegendPlace::TopLeft,
            LegendPlace::BottomRight,
            LegendPlace::BottomLeft,
        ];
        if place == LegendPlace::Below {
            return Spot::Below;
        }
        if place != LegendPlace::Free {
            return Spot::Inside(self.box_at(frame, place));
        }
        let marks = marked_pixels(series, frame);
        let margin = MARKER_RADIUS + 4.0;
        let is_free = |area: &Area| !marks.iter().any(|&pixel| area.contains(pixel, margin));
        let boxes = corners.map(|corner| self.box_at(frame, corner));
        boxes
            .into_iter()
            .find(is_free)
            .map_or(Spot::Below, Spot::Inside)
    }

    fn box_at(&self, frame: &Frame, place: LegendPlace) -> Area {
        let width = self.column + 2.0 * PADDING;
        let height = to_f64(self.entries.len()) * ROW + PADDING;
        let is_left = matches!(place, LegendPlace::TopLeft | LegendPlace::BottomLeft);
        let is_top = matches!(place, LegendPlace::TopLeft | LegendPlace::TopRight);
        let area = frame.area;
        Area {
            left: if is_left {
                area.left + INSET
            } else {
                area.right() - INSET - width
            },
            top: if is_top {
                area.top + INSET
            } else {
                area.bottom() - INSET - height
            },
            width,
            height,
        }
    }

    fn columns_below(&self, width: f64) -> usize {
        let fits =
            |count: &usize| to_f64(*count) * (self.column + COLUMN_GAP) <= width + COLUMN_GAP;
        let widest = (1..=self.entries.len()).take_while(fits).count().max(1);
        // Spread the entries evenly over the rows that the widest arrangement needs.
        self.entries
            .len()
            .div_ceil(self.entries.len().div_ceil(widest))
    }

    fn rows(&self) -> usize {
        self.entries.len().div_ceil(self.columns)
    }
}

/// Pixels along all lines, error bars and markers, close enough to find what a rectangle covers.
fn marked_pixels(series: &[Series], frame: &Frame) -> Vec<Pixel> {
    let mut marks = Vec::new();
    for one in series {
        let pixels: Vec<Pixel> = one.points.iter().map(|&point| frame.pixel(point)).collect();
        if one.line.is_some() {
            for pair in pixels.windows(2) {
                push_between(&mut marks, pair[0], pair[1]);
            }
        }
        for (&point, &error) in one.points.iter().zip(one.errors.iter().flatten()) {
            let [upper, lower] = error_ends(frame, point, error);
            push_between(&mut marks, upper, lower);
        }
        marks.extend(pixels);
    }
    marks
}

fn push_between(marks: &mut Vec<Pixel>, from: Pixel, to: Pixel) {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let steps = (length / 3.0).ceil();
    let mut step = 0.0;
    while step < steps {
        let share = step / steps;
        marks.push([
            from[0] + share * (to[0] - from[0]),
            from[1] + share * (to[1] - from[1]),
        ]);
        step += 1.0;
    }
}

fn draw_entry(canvas: &mut Canvas, [left, middle]: Pixel, series: &Series, label: &str) {
    if let Some(line) = series.line {
        canvas.line(
            [left, middle],
            [left + SAMPLE, middle],
            &line_pen(line, series),
        );
    }
    if let Some(marker) = series.marker {
        draw_marker(
            canvas,
            [left + SAMPLE / 2.0, middle],
            marker,
            series.colour.hex(),
        );
    }
    let baseline = middle + 0.36 * f64::from(TEXT_SIZE);
    canvas.text(
        [left + SAMPLE + PADDING, baseline],
        label,
        TEXT_SIZE,
        Anchor::Start,
    );
}

/// Exact for any number of entries or columns that fits into a picture.
#[allow(clippy::cast_precision_loss, reason = "small counts")]
fn to_f64(count: usize) -> f64 {
    count as f64
}
