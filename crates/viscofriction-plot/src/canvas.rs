//! Drawing surface in pixels.
//!
//! Every mark is written twice, because a viewer of the SVG has fonts and wants texts, and the renderer of the PNG has none
//! and wants outlines.

use std::fmt::Display;

use colorous::VIRIDIS;
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

impl<'a> Pen<'a> {
    pub(crate) fn solid(colour: &'a str, width: f64) -> Self {
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
        let mut canvas = Self {
            svg: XmlWriter::new(Options::default()),
            outlined: XmlWriter::new(Options::default()),
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
            xml.write_attribute("width", "100%");
            xml.write_attribute("height", "100%");
            xml.write_attribute("fill", "white");
            xml.end_element();
        });
        canvas
    }

    /// The picture; an error if a text could not be drawn.
    pub(crate) fn finish(self) -> Result<Drawing, PlotError> {
        match self.refused {
            Some(refused) => Err(refused),
            None => Ok(Drawing {
                svg: self.svg.end_document(),
                outlined: self.outlined.end_document(),
            }),
        }
    }

    pub(crate) fn line(&mut self, from: Pixel, to: Pixel, pen: &Pen) {
        self.each(|xml| {
            xml.start_element("line");
            let ends = [
                ("x1", from[0]),
                ("y1", from[1]),
                ("x2", to[0]),
                ("y2", to[1]),
            ];
            write_places(xml, &ends);
            write_pen(xml, pen);
            xml.end_element();
        });
    }

    pub(crate) fn polyline(&mut self, points: &[Pixel], pen: &Pen) {
        let places: Vec<String> = points
            .iter()
            .map(|[x, y]| format!("{},{}", rounded(*x), rounded(*y)))
            .collect();
        self.each(|xml| {
            xml.start_element("polyline");
            xml.write_attribute("points", &places.join(" "));
            xml.write_attribute("fill", "none");
            write_pen(xml, pen);
            xml.end_element();
        });
    }

    pub(crate) fn circle(&mut self, [cx, cy]: Pixel, radius: f64, fill: &str, pen: &Pen) {
        self.each(|xml| {
            xml.start_element("circle");
            write_places(xml, &[("cx", cx), ("cy", cy), ("r", radius)]);
            xml.write_attribute("fill", fill);
            write_pen(xml, pen);
            xml.end_element();
        });
    }

    /// Closed shape given as SVG path data.
    pub(crate) fn shape(&mut self, path: &str, fill: &str, pen: &Pen) {
        self.each(|xml| {
            xml.start_element("path");
            xml.write_attribute("d", path);
            xml.write_attribute("fill", fill);
            write_pen(xml, pen);
            xml.end_element();
        });
    }

    pub(crate) fn rectangle(&mut self, area: Area, fill: &str, pen: &Pen) {
        self.each(|xml| {
            xml.start_element("rect");
            let places = [
                ("x", area.left),
                ("y", area.top),
                ("width", area.width),
                ("height", area.height),
            ];
            write_places(xml, &places);
            xml.write_attribute("fill", fill);
            write_pen(xml, pen);
            xml.end_element();
        });
    }

    /// Text whose baseline passes through the point.
    pub(crate) fn text(&mut self, [x, y]: Pixel, text: &str, size: u32, anchor: Anchor) {
        let (place, part) = match anchor {
            Anchor::Start => ("start", 0.0),
            Anchor::Middle | Anchor::Upwards => ("middle", 0.5),
            Anchor::End => ("end", 1.0),
        };
        let turn = (anchor == Anchor::Upwards)
            .then(|| format!("rotate(-90 {} {})", rounded(x), rounded(y)));
        let write_turn = |xml: &mut XmlWriter| {
            if let Some(turn) = &turn {
                xml.write_attribute("transform", turn);
            }
        };
        write_text(&mut self.svg, ([x, y], text), size, |xml| {
            xml.write_attribute("text-anchor", place);
            write_turn(xml);
        });
        match outline(text, size, ([x, y], part)) {
            Ok(path) => {
                self.outlined.start_element("path");
                self.outlined.write_attribute("d", &path);
                write_turn(&mut self.outlined);
                self.outlined.end_element();
            }
            Err(refused) => {
                self.refused.get_or_insert(refused);
            }
        }
    }

    /// Opens a group in which a cell of the given size, \[px\], has the size 1 by 1, with the origin in the lower
    /// left corner of the area and y upwards; neighbouring fills meet without seams.
    pub(crate) fn start_mosaic(&mut self, area: Area, [width, height]: [f64; 2]) {
        self.each(|xml| {
            xml.start_element("g");
            xml.write_attribute("shape-rendering", "crispEdges");
            xml.write_attribute_fmt(
                "transform",
                format_args!(
                    "translate({:.3} {:.3}) scale({width:.6} {:.6})",
                    area.left,
                    area.bottom(),
                    -height
                ),
            );
        });
    }

    /// Closes the group opened last.
    pub(crate) fn end_group(&mut self) {
        self.each(XmlWriter::end_element);
    }

    fn each(&mut self, write: impl Fn(&mut XmlWriter)) {
        write(&mut self.svg);
        write(&mut self.outlined);
    }
}

fn write_text(
    xml: &mut XmlWriter,
    ([x, y], text): (Pixel, &str),
    size: u32,
    write_more: impl Fn(&mut XmlWriter),
) {
    xml.start_element("text");
    write_places(xml, &[("x", x), ("y", y)]);
    xml.write_attribute("font-size", &size);
    write_more(xml);
    xml.set_preserve_whitespaces(true);
    // The writer escapes the other sign of markup.
    xml.write_text(&text.replace('&', "&amp;"));
    xml.end_element();
    xml.set_preserve_whitespaces(false);
}

fn write_places(xml: &mut XmlWriter, places: &[(&str, f64)]) {
    for (name, value) in places {
        xml.write_attribute(name, &rounded(*value));
    }
}

fn write_pen(xml: &mut XmlWriter, pen: &Pen) {
    xml.write_attribute("stroke", pen.colour);
    if pen.colour != "none" {
        xml.write_attribute("stroke-width", &pen.width);
    }
    if let Some(dash) = &pen.dash {
        xml.write_attribute("stroke-dasharray", dash);
    }
}

/// A hundredth of a pixel is not seen.
fn rounded(value: f64) -> impl Display {
    // No zero has a sign.
    (100.0 * value).round() / 100.0 + 0.0
}

/// Colour of a share between 0 and 1 of a colour scale, dark blue to yellow.
pub(crate) fn scale_colour(share: f64) -> String {
    format!("#{:x}", VIRIDIS.eval_continuous(share))
}
