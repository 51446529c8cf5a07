//! Drawing surface in pixels; the only file that knows kuva.

use kuva::backend::svg::SvgBackend;
use kuva::plot::colormap::ColorMap;
use kuva::render::color::Color;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

use super::font::FAMILY;

/// Pixels from the left and the top.
pub(super) type Pixel = [f64; 2];

/// Rectangle in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Area {
    pub(super) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    pub(super) fn contains(&self, [x, y]: Pixel, margin: f64) -> bool {
        let across = (self.left - margin..=self.right() + margin).contains(&x);
        across && (self.top - margin..=self.bottom() + margin).contains(&y)
    }
}

/// Pen of a line or outline.
#[derive(Debug, Clone)]
pub(super) struct Pen<'a> {
    pub(super) colour: &'a str,
    pub(super) width: f64,
    /// Lengths of dashes and gaps, \[px\].
    pub(super) dash: Option<String>,
}

impl<'a> Pen<'a> {
    pub(super) fn solid(colour: &'a str, width: f64) -> Self {
        Self {
            colour,
            width,
            dash: None,
        }
    }
}

/// Place of a text relative to its point; all but `Upwards` run to the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
    /// Centred and turned by a quarter to the left.
    Upwards,
}

/// Picture under construction.
pub(super) struct Canvas {
    scene: Scene,
}

impl Canvas {
    /// White canvas, \[px\].
    pub(super) fn new(width: f64, height: f64) -> Self {
        let mut scene = Scene::new(width, height);
        scene.font_family = Some(format!("{FAMILY}, Verdana, sans-serif"));
        scene.text_color = Some("#000000".into());
        let mut canvas = Self { scene };
        canvas.start_group(r#"stroke-linejoin="round""#);
        canvas
    }

    /// SVG text of the picture.
    pub(super) fn finish(mut self) -> String {
        self.end_group();
        let (width, height) = (self.scene.width, self.scene.height);
        let svg = SvgBackend::new()
            .with_pretty(true)
            .render_scene(&self.scene);
        // kuva writes no viewBox; without one a viewer crops the picture instead of scaling it.
        svg.replacen(
            "<svg ",
            &format!(r#"<svg viewBox="0 0 {width:.2} {height:.2}" "#),
            1,
        )
    }

    pub(super) fn line(&mut self, from: Pixel, to: Pixel, pen: &Pen) {
        self.scene.add(Primitive::Line {
            x1: from[0],
            y1: from[1],
            x2: to[0],
            y2: to[1],
            stroke: Color::from(pen.colour),
            stroke_width: pen.width,
            stroke_dasharray: pen.dash.clone(),
        });
    }

    pub(super) fn polyline(&mut self, points: Vec<Pixel>, pen: &Pen) {
        self.scene.add(Primitive::PolyLine {
            points: points.into_iter().map(|[x, y]| (x, y)).collect(),
            stroke: Color::from(pen.colour),
            stroke_width: pen.width,
            stroke_dasharray: pen.dash.clone(),
        });
    }

    pub(super) fn circle(&mut self, [cx, cy]: Pixel, radius: f64, fill: &str, pen: &Pen) {
        self.scene.add(Primitive::Circle {
            cx,
            cy,
            r: radius,
            fill: Color::from(fill),
            fill_opacity: None,
            stroke: Some(Color::from(pen.colour)),
            stroke_width: Some(pen.width),
        });
    }

    /// Closed shape given as SVG path data.
    pub(super) fn shape(&mut self, path: String, fill: &str, pen: &Pen) {
        self.scene.add(Primitive::Path(Box::new(PathData {
            d: path,
            fill: Some(Color::from(fill)),
            stroke: Color::from(pen.colour),
            stroke_width: pen.width,
            opacity: None,
            stroke_dasharray: None,
        })));
    }

    pub(super) fn rectangle(&mut self, area: Area, fill: &str, pen: &Pen) {
        self.scene.add(Primitive::Rect {
            x: area.left,
            y: area.top,
            width: area.width,
            height: area.height,
            fill: Color::from(fill),
            stroke: Some(Color::from(pen.colour)),
            stroke_width: Some(pen.width),
            opacity: None,
        });
    }

    /// Text whose baseline passes through the point.
    pub(super) fn text(&mut self, [x, y]: Pixel, text: &str, size: u32, anchor: Anchor) {
        let (place, rotate) = match anchor {
            Anchor::Start => (TextAnchor::Start, None),
            Anchor::Middle => (TextAnchor::Middle, None),
            Anchor::End => (TextAnchor::End, None),
            Anchor::Upwards => (TextAnchor::Middle, Some(-90.0)),
        };
        self.scene.add(Primitive::Text {
            x,
            y,
            content: text.into(),
            size,
            anchor: place,
            rotate,
            bold: false,
            color: None,
        });
    }

    /// Opens a group in which a cell of the given size, \[px\], has the size 1 by 1, with the origin in the lower
    /// left corner of the area and y upwards; neighbouring fills meet without seams.
    pub(super) fn start_mosaic(&mut self, area: Area, [width, height]: [f64; 2]) {
        let place = format!("translate({:.3} {:.3})", area.left, area.bottom());
        let size = format!("scale({width:.6} {:.6})", -height);
        self.start_group(&format!(
            r#"shape-rendering="crispEdges" transform="{place} {size}""#
        ));
    }

    /// Closes the group opened last.
    pub(super) fn end_group(&mut self) {
        self.scene.add(Primitive::GroupEnd);
    }

    fn start_group(&mut self, attributes: &str) {
        self.scene.add(Primitive::GroupStart {
            transform: None,
            title: None,
            extra_attrs: Some(attributes.into()),
        });
    }
}

/// Colour of a share between 0 and 1 of a colour scale, dark blue to yellow.
pub(super) fn scale_colour(share: f64) -> String {
    ColorMap::Viridis.map(share)
}
