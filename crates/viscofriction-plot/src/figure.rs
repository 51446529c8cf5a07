//! Figures: one panel or several, side by side and in rows.

use crate::canvas::{Canvas, Drawing};
use crate::chart::Chart;
use crate::error::PlotError;
use crate::map::Map;
use crate::matrix::{MATRIX_WIDTH, Matrix};

/// One or more panels in one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Panels from left to right, then from top to bottom.
    pub panels: Vec<Panel>,
    /// Number of panels side by side.
    pub columns: usize,
}

/// Part of a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Panel {
    /// Series over a pair of axes.
    Chart(Chart),
    /// Field on a grid.
    Map(Map),
    /// Rows of cells.
    Matrix(Matrix),
}

/// Width of every panel but a matrix, \[px\].
pub(crate) const PANEL_WIDTH: f64 = 480.0;

impl From<Chart> for Panel {
    fn from(chart: Chart) -> Self {
        Self::Chart(chart)
    }
}

impl From<Map> for Panel {
    fn from(map: Map) -> Self {
        Self::Map(map)
    }
}

impl From<Matrix> for Panel {
    fn from(matrix: Matrix) -> Self {
        Self::Matrix(matrix)
    }
}

impl Figure {
    /// Figure of a single panel.
    #[must_use]
    pub fn single(panel: impl Into<Panel>) -> Self {
        Self {
            panels: vec![panel.into()],
            columns: 1,
        }
    }
}

/// Drawing of a figure, 480 px wide per column, or 960 px with a matrix in it.
///
/// # Errors
/// Whatever could not be drawn faithfully: see [`PlotError`].
pub fn draw(figure: &Figure) -> Result<Drawing, PlotError> {
    figure.validate()?;
    let margins = figure.left_margins()?;
    let rows: Vec<&[Panel]> = figure.panels.chunks(figure.columns).collect();
    let heights = rows
        .iter()
        .map(|row| row_height(row, &margins))
        .collect::<Result<Vec<f64>, _>>()?;
    let widths = figure.widths();
    let mut canvas = Canvas::new(widths.iter().sum(), heights.iter().sum());
    let mut top = 0.0;
    for (row, height) in rows.into_iter().zip(heights) {
        let mut left = 0.0;
        for ((panel, &margin), width) in row.iter().zip(&margins).zip(&widths) {
            panel.draw(&mut canvas, [left, top], margin)?;
            left += width;
        }
        top += height;
    }
    canvas.finish()
}

fn row_height(row: &[Panel], margins: &[f64]) -> Result<f64, PlotError> {
    let heights = row
        .iter()
        .zip(margins)
        .map(|(panel, &margin)| panel.height(margin));
    heights
        .into_iter()
        .try_fold(0.0, |tallest: f64, height| Ok(tallest.max(height?)))
}

impl Figure {
    fn validate(&self) -> Result<(), PlotError> {
        if self.panels.is_empty() || self.columns == 0 {
            return Err(PlotError::Empty {
                what: "the list of panels or of columns".into(),
            });
        }
        self.panels.iter().try_for_each(|panel| match panel {
            Panel::Chart(chart) => chart.validate(),
            Panel::Map(map) => map.validate(),
            Panel::Matrix(matrix) => matrix.validate(),
        })
    }

    /// Width of each column, \[px\].
    fn widths(&self) -> Vec<f64> {
        let mut widths = vec![PANEL_WIDTH; self.columns.min(self.panels.len())];
        for (index, panel) in self.panels.iter().enumerate() {
            if matches!(panel, Panel::Matrix(_)) {
                widths[index % self.columns] = MATRIX_WIDTH;
            }
        }
        widths
    }

    /// Left margin of each column, wide enough for all its panels so that their frames line up, \[px\].
    fn left_margins(&self) -> Result<Vec<f64>, PlotError> {
        let mut margins = vec![0.0; self.columns.min(self.panels.len())];
        for (index, panel) in self.panels.iter().enumerate() {
            let margin: &mut f64 = &mut margins[index % self.columns];
            *margin = margin.max(panel.left_margin()?);
        }
        Ok(margins)
    }
}

impl Panel {
    fn left_margin(&self) -> Result<f64, PlotError> {
        match self {
            Self::Chart(chart) => chart.left_margin(),
            Self::Map(map) => map.left_margin(),
            Self::Matrix(matrix) => matrix.left_margin(),
        }
    }

    fn height(&self, left: f64) -> Result<f64, PlotError> {
        match self {
            Self::Chart(chart) => chart.height(left),
            Self::Map(map) => map.height(left),
            Self::Matrix(matrix) => Ok(matrix.height(left)),
        }
    }

    fn draw(&self, canvas: &mut Canvas, origin: [f64; 2], left: f64) -> Result<(), PlotError> {
        match self {
            Self::Chart(chart) => chart.draw(canvas, origin, left),
            Self::Map(map) => map.draw(canvas, origin, left),
            Self::Matrix(matrix) => matrix.draw(canvas, origin, left),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Axis, Cell, Colour, ColourScale, Dash, LegendPlace, Line, Marker, MatrixRow, Series, Shape,
    };

    fn chart() -> Chart {
        let curve = vec![[1e-3, 0.157], [1e1, 0.157]];
        Chart {
            title: Some("Cone, c₁ = 0.1".into()),
            x: Axis::log10("velocity v [m/s]", [1e-3, 1e1]),
            y: Axis::linear("coefficient of friction μ [1]", [0.0, 0.2]),
            series: vec![
                Series {
                    label: Some("theory, s < 1 & more".into()),
                    ..Series::line(curve, Line::thick(Dash::DashDot), Colour::Blue)
                },
                Series {
                    label: Some("simulation".into()),
                    errors: Some(vec![0.01, 0.02]),
                    ..Series::markers(
                        vec![[1e-2, 0.08], [1.0, 0.09]],
                        Marker::open(Shape::Diamond),
                        Colour::Red,
                    )
                },
            ],
            legend: LegendPlace::Free,
        }
    }

    fn map() -> Map {
        Map {
            title: None,
            x: Axis::linear("x [mm]", [-2.0, 2.0]),
            y: Axis::linear("y [mm]", [-1.0, 1.0]),
            columns: 4,
            values: vec![
                Some(0.5),
                Some(0.5),
                Some(1.5),
                None,
                None,
                Some(1.0),
                Some(2.0),
                None,
            ],
            colours: ColourScale {
                label: "pressure p [MPa]".into(),
                range: [0.0, 2.0],
            },
            overlays: vec![],
        }
    }

    fn page() -> Figure {
        Figure {
            panels: vec![chart().into(), map().into(), chart().into()],
            columns: 2,
        }
    }

    fn svg(panel: impl Into<Panel>) -> String {
        let drawing = draw(&Figure::single(panel)).expect("the figure is sound");
        drawing.svg
    }

    #[test]
    fn a_figure_is_the_same_text_every_time() {
        let [first, second] = [draw(&page()), draw(&page())];
        assert!(first.is_ok(), "expected a picture, got {first:?}");
        assert_eq!(first, second, "two pictures of one figure");
    }

    #[test]
    fn all_texts_stand_in_the_svg() {
        let text = draw(&page()).expect("the figure is sound").svg;
        for label in [
            "velocity v [m/s]",
            "coefficient of friction μ [1]",
            "Cone, c₁ = 0.1",
            "theory, s &lt; 1 &amp; more",
            "simulation",
            "10⁻³",
            "0.15",
            "x [mm]",
            "pressure p [MPa]",
        ] {
            assert!(
                text.contains(&format!(">{label}</text>")),
                "expected '{label}' in {text}"
            );
        }
    }

    #[test]
    fn panels_share_the_width_and_line_up() {
        let text = draw(&page()).expect("the figure is sound").svg;
        assert!(
            text.contains(r#"width="960""#),
            "expected two columns of 480 px in {text}"
        );
        let single = svg(chart());
        assert!(
            single.contains(r#"viewBox="0 0 480 "#),
            "expected a view box 480 px wide in {single}"
        );
    }

    #[test]
    fn markers_stand_on_their_points() {
        let at = |y: f64| {
            Series::markers(
                vec![[1e-1, y]],
                Marker::filled(Shape::Circle),
                Colour::Black,
            )
        };
        let only = |y: f64| Chart {
            series: vec![at(y)],
            title: None,
            ..chart()
        };
        let height = |y: f64| -> f64 {
            let text = svg(only(y));
            let tail = text
                .split(r#" cy=""#)
                .nth(1)
                .expect("the chart has one circle");
            tail.split('"')
                .next()
                .and_then(|digits| digits.parse().ok())
                .expect("a number")
        };
        // The frame is 280 px high and begins 10 px below the upper edge.
        for (y, expected) in [(0.2, 10.0), (0.1, 150.0), (0.0, 290.0)] {
            let got = height(y);
            assert!(
                (got - expected).abs() < 0.011,
                "expected μ = {y} at {expected} px, got {got}"
            );
        }
    }

    #[test]
    fn a_legend_that_covers_no_data_stays_inside_and_moves_out_otherwise() {
        let height = |chart: Chart| -> f64 {
            let text = svg(chart);
            let tail = text
                .split(r#" height=""#)
                .nth(1)
                .expect("an svg has a height");
            tail.split('"')
                .next()
                .and_then(|digits| digits.parse().ok())
                .expect("a number")
        };
        let inside = height(chart());
        let below = height(Chart {
            legend: LegendPlace::Below,
            ..chart()
        });
        assert!(
            below > inside + 17.0,
            "expected a row more than {inside} px, got {below}"
        );
        let zigzag = (0..40).map(|k| {
            [
                10_f64.powf(-3.0 + 0.1 * f64::from(k)),
                0.1 + 0.1 * f64::from(k % 3 - 1),
            ]
        });
        let mut full = chart();
        full.series.push(Series::line(
            zigzag.collect(),
            Line::thin(Dash::Solid),
            Colour::Black,
        ));
        let got = height(full);
        assert!(
            (got - below).abs() < 0.011,
            "expected the legend below, {below} px, got {got}"
        );
    }

    #[test]
    fn cells_without_a_value_stay_white_and_neighbours_of_one_colour_merge() {
        let text = svg(map());
        for cell in [
            "M0 0h2v1h-2z",
            "M2 0h1v1h-1z",
            "M1 1h1v1h-1z",
            "M2 1h1v1h-1z",
        ] {
            assert!(
                text.contains(&format!(r#"d="{cell}""#)),
                "expected the cell {cell} in {text}"
            );
        }
        let drawn = text.matches("v1h-").count();
        assert_eq!(
            drawn, 104,
            "4 runs of cells and 100 steps of the colour bar"
        );
    }

    #[test]
    fn labels_of_the_x_axis_stand_clear_of_each_other() {
        let crowded = Chart {
            x: Axis::linear("time t [s]", [0.0, 3e-12]),
            series: vec![Series::markers(
                vec![[1e-12, 0.1]],
                Marker::filled(Shape::Plus),
                Colour::Black,
            )],
            ..chart()
        };
        let text = svg(crowded);
        let got: Vec<&str> = [
            "0.5·10⁻¹²",
            "1.0·10⁻¹²",
            "1.5·10⁻¹²",
            "2.0·10⁻¹²",
            "2.5·10⁻¹²",
            "3.0·10⁻¹²",
        ]
        .into_iter()
        .filter(|label| text.contains(&format!(">{label}<")))
        .collect();
        // A step of half a unit is 65 px, less than a label of some 62 px and the gap of 6 px.
        assert_eq!(
            got,
            ["1.0·10⁻¹²", "2.0·10⁻¹²", "3.0·10⁻¹²"],
            "labels in {text}"
        );
    }

    #[test]
    fn maps_that_would_mislead_are_refused() {
        let cases = [
            Map {
                columns: 3,
                ..map()
            },
            Map {
                columns: 0,
                ..map()
            },
            Map {
                values: vec![Some(2.1); 8],
                ..map()
            },
            Map {
                values: vec![Some(f64::NAN); 8],
                ..map()
            },
            Map {
                x: Axis::log10("x [mm]", [1.0, 10.0]),
                ..map()
            },
        ];
        for case in cases {
            let got = draw(&Figure::single(case.clone()));
            assert!(got.is_err(), "expected {case:?} to be refused");
        }
    }

    fn matrix(cells: Vec<Cell>) -> Matrix {
        Matrix {
            title: None,
            rows: vec![MatrixRow {
                name: "march".into(),
                cells,
                note: "Δt/τ from 1e-12 to 1e12".into(),
            }],
            colours: ColourScale {
                label: "log₁₀".into(),
                range: [-6.0, 0.0],
            },
            legend: vec![(Colour::Grey, "refused".into())],
        }
    }

    #[test]
    fn a_matrix_colours_every_cell_and_refuses_values_off_its_scale() {
        let cells = vec![
            Cell::Value(-6.0),
            Cell::Plain(Colour::Grey),
            Cell::Value(-6.0),
        ];
        let text = svg(matrix(cells));
        assert!(
            text.contains("M0 0h0.9v0.8h-0.9zM2 0h0.9v0.8h-0.9z"),
            "two cells of one colour in {text}"
        );
        // One cell and one sample of the legend.
        assert_eq!(text.matches(Colour::Grey.hex()).count(), 2, "{text}");
        for cells in [
            vec![Cell::Value(0.1)],
            vec![Cell::Value(f64::NAN)],
            Vec::new(),
        ] {
            let got = draw(&Figure::single(matrix(cells.clone())));
            assert!(got.is_err(), "expected {cells:?} to be refused");
        }
    }

    #[test]
    fn figures_without_content_or_with_texts_too_long_are_refused() {
        let empty = Figure {
            panels: vec![],
            columns: 1,
        };
        let long = Chart {
            title: Some(
                "friction of rigid indenters on viscous half spaces after Kürschner, 2014".into(),
            ),
            ..chart()
        };
        let bare = Chart {
            series: vec![],
            ..chart()
        };
        let outside = Chart {
            y: Axis::linear("μ [1]", [0.0, 0.1]),
            ..chart()
        };
        for figure in [
            empty,
            Figure::single(long),
            Figure::single(bare),
            Figure::single(outside),
        ] {
            let got = draw(&figure);
            assert!(got.is_err(), "expected a refusal, got {got:?}");
        }
    }
}
