//! Drawing surface in pixels.
//!
//! Every mark is written twice, because a viewer of the SVG has fonts and wants texts, and the renderer of the PNG has none
//! and wants outlines.

use std::fmt::Display;

use xmlwriter::{Options, XmlWriter};

use crate::error::PlotError;
use crate::font::{FAMILY, outline};

/// Pixels from the left and the top.
pub(crate) type Pixel = [f64; 2];

/// Rectangle in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Area {
    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    pub(crate) fn contains(&self, [x, y]: Pixel, margin: f64) -> bool {
        let across = (self.left - margin..=self.right() + margin).contains(&x);
        across && (self.top - margin..=self.bottom() + margin).contains(&y)
    }
}

/// Pen of a line or outline.
#[derive(Debug, Clone)]
pub(crate) struct Pen<'a> {
    pub(crate) colour: &'a str,
    pub(crate) width: f64,
    /// Lengths of dashes and gaps, \[px\].
    pub(crate) dash: Option<String>,
}

/// For shapes without an outline.
pub(crate) const NO_PEN: Pen<'static> = Pen::solid("none", 0.0);
/// For frames, axes and ticks.
pub(crate) const FRAME_PEN: Pen<'static> = Pen::solid("#000000", 1.0);

impl<'a> Pen<'a> {
    pub(crate) const fn solid(colour: &'a str, width: f64) -> Self {
        Self {
            colour,
            width,
            dash: None,
        }
    }
}

/// Place of a text relative to its point; all but `Upwards` run to the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
    /// Centred and turned by a quarter to the left.
    Upwards,
}

/// A finished picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Drawing {
    /// As an SVG text.
    pub svg: String,
    /// The same with the outlines of all letters in place of texts.
    pub(crate) outlined: String,
}

/// Picture under construction.
pub(crate) struct Canvas {
    svg: XmlWriter,
    outlined: XmlWriter,
    /// The first text that has no outline.
    refused: Option<PlotError>,
}

impl Canvas {
    /// White canvas, \[px\].
    pub(crate) fn new(width: f64, height: f64) -> Self {
        let writer = || XmlWriter::new(Options::default());
        let mut canvas = Self {
            svg: writer(),
            outlined: writer(),
            refused: None,
        };
        canvas.each(|xml| {
            xml.start_element("svg");
            xml.write_attribute("xmlns", "http://www.w3.org/2000/svg");
            xml.write_attribute_fmt("viewBox", format_args!("0 0 {width} {height}"));
            xml.write_attribute("width", &width);
            xml.write_attribute("height", &height);
            xml.write_attribute_fmt("font-family", format_args!("{FAMILY}, Verdana, sans-serif"));
            xml.write_attribute("stroke-linejoin", "round");
            xml.start_element("rect");
            for (name, value) in [("width", "100%"), ("height", "100%"), ("fill", "white")] {
                xml.write_attribute(name, value);
            }
            xml.end_element();
        });
        canvas
    }

    /// The picture; an error if a text could not be drawn.
    pub(crate) fn finish(self) -> Result<Drawing, PlotError> {
        if let Some(refused) = self.refused {
            return Err(refused);
        }
        Ok(Drawing {
            svg: self.svg.end_document(),
            outlined: self.outlined.end_document(),
        })
    }

    pub(crate) fn line(&mut self, [x1, y1]: Pixel, [x2, y2]: Pixel, pen: &Pen) {
        let ends = [("x1", x1), ("y1", y1), ("x2", x2), ("y2", y2)];
        self.mark("line", &ends, &[], pen);
    }

    pub(crate) fn polyline(&mut self, points: &[Pixel], pen: &Pen) {
        let place = |[x, y]: &Pixel| format!("{},{}", rounded(*x), rounded(*y));
        let places: Vec<String> = points.iter().map(place).collect();
        let texts = [("points", &*places.join(" ")), ("fill", "none")];
        self.mark("polyline", &[], &texts, pen);
    }

    pub(crate) fn circle(&mut self, [x, y]: Pixel, radius: f64, fill: &str, pen: &Pen) {
        let places = [("cx", x), ("cy", y), ("r", radius)];
        self.mark("circle", &places, &[("fill", fill)], pen);
    }

    /// Closed shape given as SVG path data.
    pub(crate) fn shape(&mut self, path: &str, fill: &str, pen: &Pen) {
        self.mark("path", &[], &[("d", path), ("fill", fill)], pen);
    }

    pub(crate) fn rectangle(&mut self, area: Area, fill: &str, pen: &Pen) {
        let [width, height] = [("width", area.width), ("height", area.height)];
        let places = [("x", area.left), ("y", area.top), width, height];
        self.mark("rect", &places, &[("fill", fill)], pen);
    }

    /// Text whose baseline passes through the point.
    pub(crate) fn text(&mut self, [x, y]: Pixel, text: &str, size: u32, anchor: Anchor) {
        let (place, part) = match anchor {
            Anchor::Start => ("start", 0.0),
            Anchor::Middle | Anchor::Upwards => ("middle", 0.5),
            Anchor::End => ("end", 1.0),
        };
        let turn = |xml: &mut XmlWriter| {
            if anchor == Anchor::Upwards {
                let [x, y] = [rounded(x), rounded(y)];
                xml.write_attribute_fmt("transform", format_args!("rotate(-90 {x} {y})"));
            }
        };
        let xml = &mut self.svg;
        xml.start_element("text");
        write_places(xml, &[("x", x), ("y", y)]);
        xml.write_attribute("font-size", &size);
        xml.write_attribute("text-anchor", place);
        turn(xml);
        xml.set_preserve_whitespaces(true);
        // The writer escapes the other sign of markup.
        xml.write_text(&text.replace('&', "&amp;"));
        xml.end_element();
        xml.set_preserve_whitespaces(false);
        match outline(text, size, [x, y], part) {
            Ok(path) => {
                self.outlined.start_element("path");
                self.outlined.write_attribute("d", &path);
                turn(&mut self.outlined);
                self.outlined.end_element();
            }
            Err(refused) => {
                self.refused.get_or_insert(refused);
            }
        }
    }

    /// Fills paths, each given with its colour, in which a cell of the given size, \[px\], has the size 1 by 1, with the
    /// origin in the lower left corner of the area and y upwards; neighbouring fills meet without seams.
    pub(crate) fn mosaic(
        &mut self,
        area: Area,
        [width, height]: [f64; 2],
        paths: impl IntoIterator<Item = (String, String)>,
    ) {
        let [left, bottom, down] = [area.left, area.bottom(), -height];
        let transform = format!("translate({left:.3} {bottom:.3}) scale({width:.6} {down:.6})");
        self.each(|xml| {
            xml.start_element("g");
            xml.write_attribute("shape-rendering", "crispEdges");
            xml.write_attribute("transform", &transform);
        });
        for (colour, path) in paths {
            self.shape(&path, &colour, &NO_PEN);
        }
        self.each(XmlWriter::end_element);
    }

    /// One element with its places, other attributes and pen, in this order.
    fn mark(&mut self, name: &str, places: &[(&str, f64)], texts: &[(&str, &str)], pen: &Pen) {
        self.each(|xml| {
            xml.start_element(name);
            write_places(xml, places);
            for (name, text) in texts {
                xml.write_attribute(name, *text);
            }
            xml.write_attribute("stroke", pen.colour);
            if pen.colour != NO_PEN.colour {
                xml.write_attribute("stroke-width", &pen.width);
            }
            if let Some(dash) = &pen.dash {
                xml.write_attribute("stroke-dasharray", dash);
            }
            xml.end_element();
        });
    }

    fn each(&mut self, write: impl Fn(&mut XmlWriter)) {
        write(&mut self.svg);
        write(&mut self.outlined);
    }
}

fn write_places(xml: &mut XmlWriter, places: &[(&str, f64)]) {
    for (name, value) in places {
        xml.write_attribute(name, &rounded(*value));
    }
}

/// A hundredth of a pixel is not seen.
fn rounded(value: f64) -> impl Display {
    // No zero has a sign.
    (100.0 * value).round() / 100.0 + 0.0
}

/// Exact for any number of cells, entries or columns that fits into a picture.
#[allow(clippy::cast_precision_loss, reason = "counts are far below 2^52")]
pub(crate) fn to_f64(count: usize) -> f64 {
    count as f64
}
