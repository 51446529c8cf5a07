//! The legend: where it stands and what it shows.

use std::iter::successors;

use crate::canvas::{Anchor, Area, Canvas, Pen, Pixel, to_f64};
use crate::error::PlotError;
use crate::font::widest;
use crate::frame::Frame;
use crate::marks::{MARKER_RADIUS, draw_marker, error_bars, line_pen};
use crate::series::Series;

/// Place of the legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LegendPlace {
    /// The first corner without data under the legend, or below the chart if there is none.
    #[default]
    Free,
    /// Below the label of the x axis.
    Below,
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
    /// Its rectangle inside the frame, or none below the chart.
    inside: Option<Area>,
}

impl<'a> Legend<'a> {
    /// Finds the place of the legend of some series in a frame.
    pub(crate) fn new(
        series: &'a [Series],
        frame: &Frame,
        place: LegendPlace,
    ) -> Result<Self, PlotError> {
        let labelled = series
            .iter()
            .filter_map(|one| Some((one, one.label.as_deref()?)));
        let entries: Vec<_> = labelled.collect();
        let labels = entries.iter().map(|&(_, label)| label);
        let mut legend = Self {
            column: SAMPLE + PADDING + widest(labels, TEXT_SIZE)?,
            entries,
            columns: 1,
            inside: None,
        };
        legend.check_width(frame)?;
        if place == LegendPlace::Free {
            legend.inside = legend.free_corner(&frame.area, &marked_pixels(series, frame));
        }
        if legend.inside.is_none() {
            legend.columns = legend.columns_below(frame.area.width);
        }
        Ok(legend)
    }

    /// Height taken below the chart, \[px\].
    pub(crate) fn height_below(&self) -> f64 {
        if self.entries.is_empty() || self.inside.is_some() {
            return 0.0;
        }
        to_f64(self.rows()) * ROW + PADDING
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
            let count = to_f64(self.columns);
            let width = count * self.column + (count - 1.0) * COLUMN_GAP;
            let left = frame.area.left + (frame.area.width - width) / 2.0;
            [left, frame.bottom()]
        };
        for (index, &(series, label)) in self.entries.iter().enumerate() {
            let (column, row) = (index / self.rows(), index % self.rows());
            let left = left + to_f64(column) * (self.column + COLUMN_GAP);
            let middle = top + PADDING / 2.0 + (to_f64(row) + 0.5) * ROW;
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

    /// The first corner, from the upper right one on, in which the legend covers no mark.
    fn free_corner(&self, frame: &Area, marks: &[Pixel]) -> Option<Area> {
        let width = self.column + 2.0 * PADDING;
        let height = to_f64(self.entries.len()) * ROW + PADDING;
        let [left, top] = [frame.left + INSET, frame.top + INSET];
        let right = frame.right() - INSET - width;
        let bottom = frame.bottom() - INSET - height;
        let corners = [[right, top], [left, top], [right, bottom], [left, bottom]];
        let boxes = corners.map(|[left, top]| Area {
            left,
            top,
            width,
            height,
        });
        let covers = |area: &Area, pixel| area.contains(pixel, MARKER_RADIUS + 4.0);
        boxes
            .into_iter()
            .find(|area| !marks.iter().any(|&pixel| covers(area, pixel)))
    }

    fn columns_below(&self, width: f64) -> usize {
        let fits =
            |count: &usize| to_f64(*count) * (self.column + COLUMN_GAP) <= width + COLUMN_GAP;
        let widest = (1..=self.entries.len()).take_while(fits).count().max(1);
        // Spread the entries evenly over the rows that the widest arrangement needs.
        let rows = self.entries.len().div_ceil(widest).max(1);
        self.entries.len().div_ceil(rows).max(1)
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
        for [upper, lower] in error_bars(frame, one) {
            push_between(&mut marks, upper, lower);
        }
        marks.extend(pixels);
    }
    marks
}

fn push_between(marks: &mut Vec<Pixel>, from: Pixel, to: Pixel) {
    let [right, down] = [to[0] - from[0], to[1] - from[1]];
    let steps = (right.hypot(down) / 3.0).ceil();
    let parts = successors(Some(0.0), |step| Some(step + 1.0)).take_while(|step| *step < steps);
    marks.extend(
        parts
            .map(|step| step / steps)
            .map(|part| [from[0] + part * right, from[1] + part * down]),
    );
}

fn draw_entry(canvas: &mut Canvas, [left, middle]: Pixel, series: &Series, label: &str) {
    if let Some(line) = series.line {
        let end = [left + SAMPLE, middle];
        canvas.line([left, middle], end, &line_pen(line, series.colour));
    }
    if let Some(marker) = series.marker {
        let centre = [left + SAMPLE / 2.0, middle];
        draw_marker(canvas, centre, marker, series.colour.hex());
    }
    let baseline = middle + 0.36 * f64::from(TEXT_SIZE);
    let start = left + SAMPLE + PADDING;
    canvas.text([start, baseline], label, TEXT_SIZE, Anchor::Start);
}
