//! Legends: entries and placement.

use crate::canvas::{Anchor, Area, Canvas, Pen, Pixel};
use crate::error::PlotError;
use crate::font::fitting_width;
use crate::frame::Frame;
use crate::marks::{MARKER_RADIUS, draw_marker, ends, line_pen, visible_pieces};
use crate::series::Series;
use crate::ticks::whole_numbers;

/// Place of the legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LegendPlace {
    /// The first corner without data under the legend, or below the chart if there is none.
    #[default]
    Free,
    /// Below the label of the x axis.
    Below,
}

/// Text size of the entries, \[px\].
const TEXT_SIZE: u32 = 12;
/// Height of a row, \[px\].
const ROW_HEIGHT: f64 = 18.0;
/// Length of the line drawn as a sample, \[px\].
const SAMPLE_LENGTH: f64 = 34.0;
/// Distance between sample, text and outline, \[px\].
const PADDING: f64 = 6.0;
/// Distance from the frame, \[px\], larger than the ticks.
const FRAME_DISTANCE: f64 = 10.0;
/// Distance of columns below a chart, \[px\].
const COLUMN_GAP: f64 = 18.0;

/// Legend with its layout.
pub(crate) struct Legend<'a> {
    /// Series with their labels.
    entries: Vec<(&'a Series, &'a str)>,
    /// Width of one column with sample and text, \[px\].
    column: f64,
    /// Number of rows in each column.
    rows: usize,
    /// Rectangle inside the frame; `None` for a legend below the chart.
    inside: Option<Area>,
}

impl<'a> Legend<'a> {
    /// Layout of the legend of the series in a frame.
    pub(crate) fn new(
        series: &'a [Series],
        frame: &Frame,
        place: LegendPlace,
    ) -> Result<Self, PlotError> {
        let entries: Vec<_> = series
            .iter()
            .filter_map(|one| Some((one, one.label.as_deref()?)))
            .collect();
        let available =
            frame.area.width - 2.0 * (FRAME_DISTANCE + PADDING) - SAMPLE_LENGTH - PADDING;
        let mut widest = 0.0_f64;
        for (_, label) in &entries {
            widest = widest.max(fitting_width(label, TEXT_SIZE, available)?);
        }
        let mut legend = Self {
            column: SAMPLE_LENGTH + PADDING + widest,
            rows: entries.len(),
            entries,
            inside: None,
        };
        if place == LegendPlace::Free {
            legend.inside = legend.free_corner(&frame.area, &marked_pixels(series, frame));
        }
        if legend.inside.is_none() {
            legend.rows = legend.rows_below(frame.area.width);
        }
        Ok(legend)
    }

    /// Height taken below the chart, \[px\].
    pub(crate) fn height_below(&self) -> f64 {
        if self.entries.is_empty() || self.inside.is_some() {
            return 0.0;
        }
        self.rows as f64 * ROW_HEIGHT + PADDING
    }

    /// Draws the legend of a frame.
    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        if self.entries.is_empty() {
            return;
        }
        let [left, top] = if let Some(area) = self.inside {
            canvas.rectangle(area, "#ffffff", &Pen::solid("#999999", 0.7));
            [area.left + PADDING, area.top]
        } else {
            let count = self.entries.len().div_ceil(self.rows) as f64;
            let width = count * self.column + (count - 1.0) * COLUMN_GAP;
            let left = frame.area.left + (frame.area.width - width) / 2.0;
            [left, frame.bottom()]
        };
        for (index, &(series, label)) in self.entries.iter().enumerate() {
            let [column, row] = [index / self.rows, index % self.rows].map(|count| count as f64);
            let left = left + column * (self.column + COLUMN_GAP);
            let middle = top + PADDING / 2.0 + (row + 0.5) * ROW_HEIGHT;
            draw_entry(canvas, [left, middle], series, label);
        }
    }

    /// First corner, starting from the upper right, in which the legend covers no data; `None` if there is none.
    fn free_corner(&self, frame: &Area, marks: &[Pixel]) -> Option<Area> {
        let width = self.column + 2.0 * PADDING;
        let height = self.rows as f64 * ROW_HEIGHT + PADDING;
        let [left, top] = [frame.left + FRAME_DISTANCE, frame.top + FRAME_DISTANCE];
        let right = frame.right() - FRAME_DISTANCE - width;
        let bottom = frame.bottom() - FRAME_DISTANCE - height;
        let corners = [[right, top], [left, top], [right, bottom], [left, bottom]];
        let boxes = corners.map(|[left, top]| Area {
            left,
            top,
            width,
            height,
        });
        let overlaps = |area: &Area, pixel| area.contains(pixel, MARKER_RADIUS + 4.0);
        boxes
            .into_iter()
            .find(|area| !marks.iter().any(|&pixel| overlaps(area, pixel)))
    }

    /// Number of rows below the chart for the largest number of columns that fits.
    fn rows_below(&self, width: f64) -> usize {
        let fits = |count: &usize| *count as f64 * (self.column + COLUMN_GAP) <= width + COLUMN_GAP;
        let columns = (1..=self.entries.len()).take_while(fits).count().max(1);
        self.entries.len().div_ceil(columns)
    }
}

/// Pixels along all lines, error bars, bands and markers, at most 3 px apart.
fn marked_pixels(series: &[Series], frame: &Frame) -> Vec<Pixel> {
    let mut marks = Vec::new();
    for one in series {
        let pixels = frame.pixels(&one.points);
        let mut strokes = ends(frame, one, &one.errors);
        strokes.extend(ends(frame, one, &one.band));
        if one.line.is_some() {
            let pieces = visible_pieces(frame, one);
            let pairs = pieces.iter().flat_map(|piece| piece.windows(2));
            strokes.extend(pairs.map(|pair| [pair[0], pair[1]]));
        }
        for [[x, y], end] in strokes {
            let [right, down] = [end[0] - x, end[1] - y];
            let steps = (right.hypot(down) / 3.0).ceil().max(1.0);
            let parts = whole_numbers(0.0, steps).map(|step| step / steps);
            marks.extend(parts.map(|part| [x + part * right, y + part * down]));
        }
        marks.extend(pixels);
    }
    marks
}

/// Draws line, marker and text of an entry, with its middle line at a height \[px\].
fn draw_entry(canvas: &mut Canvas, [left, middle]: Pixel, series: &Series, label: &str) {
    if let Some(line) = series.line {
        let end = [left + SAMPLE_LENGTH, middle];
        canvas.line([left, middle], end, &line_pen(line, series.colour));
    }
    if let Some(marker) = series.marker {
        let centre = [left + SAMPLE_LENGTH / 2.0, middle];
        draw_marker(canvas, centre, marker, series.colour.hex());
    }
    let baseline = middle + 0.36 * f64::from(TEXT_SIZE);
    let start = left + SAMPLE_LENGTH + PADDING;
    canvas.text([start, baseline], label, TEXT_SIZE, Anchor::Start);
}
