//! Canvas: SVG elements in pixel coordinates.

use std::fmt::Display;

use xmlwriter::{Options, XmlWriter};

use crate::error::PlotError;
use crate::font::FAMILY;
use crate::raster::Raster;
use crate::symbols::{Run, SUBSCRIPT_DROP, SUBSCRIPT_SIZE, Style, runs};

/// Pixels from the left and the top.
pub(crate) type Pixel = [f64; 2];

/// Rectangle in pixels, y downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Area {
    /// Right edge, \[px\].
    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Lower edge, \[px\].
    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Whether a pixel is in the rectangle, or at most `margin` \[px\] outside.
    pub(crate) fn contains(&self, [x, y]: Pixel, margin: f64) -> bool {
        let across = (self.left - margin..=self.right() + margin).contains(&x);
        across && (self.top - margin..=self.bottom() + margin).contains(&y)
    }

    /// Part of a straight line inside the rectangle; `None` if it is outside (Liang and Barsky 1984).
    pub(crate) fn clip(&self, [start, end]: [Pixel; 2]) -> Option<[Pixel; 2]> {
        let direction = [end[0] - start[0], end[1] - start[1]];
        let lower = [self.left, self.top];
        let upper = [self.right(), self.bottom()];
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (step, at) = (direction[axis], start[axis]);
            if step == 0.0 {
                if at < lower[axis] || at > upper[axis] {
                    return None;
                }
                continue;
            }
            let [one, other] = [lower[axis], upper[axis]].map(|edge| (edge - at) / step);
            from = from.max(one.min(other));
            to = to.min(one.max(other));
        }
        let place = |part: f64| {
            [
                start[0] + part * direction[0],
                start[1] + part * direction[1],
            ]
        };
        (from < to).then(|| [place(from), place(to)])
    }
}

/// Pen of a line or outline.
pub(crate) struct Pen {
    /// Colour as #rrggbb, or "none".
    pub(crate) colour: &'static str,
    pub(crate) width: f64,
    /// Lengths of dashes and gaps, \[px\].
    pub(crate) dash: Option<String>,
}

/// Pen of shapes without an outline.
pub(crate) const NO_PEN: Pen = Pen::solid("none", 0.0);
/// Pen of frames, axes and ticks.
pub(crate) const FRAME_PEN: Pen = Pen::solid("#000000", 1.0);

impl Pen {
    /// Pen of an unbroken line.
    pub(crate) const fn solid(colour: &'static str, width: f64) -> Self {
        Self {
            colour,
            width,
            dash: None,
        }
    }
}

/// Position of a text relative to its point; all but `Upwards` are horizontal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// The text begins at its point.
    Start,
    /// The text is centred about its point.
    Middle,
    /// The text ends at its point.
    End,
    /// Centred and rotated by 90° counterclockwise.
    Upwards,
}

/// Text whose baseline passes through a point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Text {
    /// Point on the baseline.
    pub(crate) at: Pixel,
    pub(crate) text: String,
    /// Size of the letters, \[px\].
    pub(crate) size: u32,
    pub(crate) anchor: Anchor,
}

/// A finished picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The drawing as SVG.
    pub svg: String,
    /// Texts of the drawing, which the PNG renderer draws itself because its SVG library has no fonts.
    pub(crate) texts: Vec<Text>,
    /// Images of the drawing, below all lines, which the PNG renderer draws itself because its SVG library decodes none.
    pub(crate) rasters: Vec<Raster>,
}

/// White rectangle below everything else.
pub(crate) const BACKGROUND: &str = r#"<rect width="100%" height="100%" fill="white"/>"#;

/// Picture under construction.
pub(crate) struct Canvas {
    xml: XmlWriter,
    texts: Vec<Text>,
    rasters: Vec<Raster>,
}

impl Canvas {
    /// White canvas of the given size, \[px\].
    pub(crate) fn new(width: f64, height: f64) -> Self {
        let mut xml = XmlWriter::new(Options::default());
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
        Self {
            xml,
            texts: Vec::new(),
            rasters: Vec::new(),
        }
    }

    /// Finished drawing.
    pub(crate) fn finish(self) -> Drawing {
        Drawing {
            svg: self.xml.end_document(),
            texts: self.texts,
            rasters: self.rasters,
        }
    }

    /// Straight line between two pixels.
    pub(crate) fn line(&mut self, [x1, y1]: Pixel, [x2, y2]: Pixel, pen: &Pen) {
        let ends = [("x1", x1), ("y1", y1), ("x2", x2), ("y2", y2)];
        self.element("line", &ends, &[], pen);
    }

    /// Straight lines from pixel to pixel, without fill.
    pub(crate) fn polyline(&mut self, points: &[Pixel], pen: &Pen) {
        let place = |[x, y]: &Pixel| format!("{},{}", rounded(*x), rounded(*y));
        let places: Vec<String> = points.iter().map(place).collect();
        let texts = [("points", &*places.join(" ")), ("fill", "none")];
        self.element("polyline", &[], &texts, pen);
    }

    /// Circle about a pixel with a radius \[px\], filled with a colour as #rrggbb.
    pub(crate) fn circle(&mut self, [x, y]: Pixel, radius: f64, fill: &str, pen: &Pen) {
        let places = [("cx", x), ("cy", y), ("r", radius)];
        self.element("circle", &places, &[("fill", fill)], pen);
    }

    /// Closed shape given as SVG path data.
    pub(crate) fn shape(&mut self, path: &str, fill: &str, pen: &Pen) {
        self.element("path", &[], &[("d", path), ("fill", fill)], pen);
    }

    /// Translucent closed shape given as SVG path data.
    pub(crate) fn translucent_shape(&mut self, path: &str, fill: &str) {
        let texts = [("d", path), ("fill", fill), ("fill-opacity", "0.3")];
        self.element("path", &[], &texts, &NO_PEN);
    }

    /// Rectangle, filled with a colour as #rrggbb or "none".
    pub(crate) fn rectangle(&mut self, area: Area, fill: &str, pen: &Pen) {
        let [width, height] = [("width", area.width), ("height", area.height)];
        let places = [("x", area.left), ("y", area.top), width, height];
        self.element("rect", &places, &[("fill", fill)], pen);
    }

    /// Text whose baseline passes through the point.
    pub(crate) fn text(&mut self, at: Pixel, text: &str, size: u32, anchor: Anchor) {
        let place = match anchor {
            Anchor::Start => "start",
            Anchor::Middle | Anchor::Upwards => "middle",
            Anchor::End => "end",
        };
        let [x, y] = at;
        self.start_element("text", &[("x", x), ("y", y)]);
        self.xml.write_attribute("font-size", &size);
        self.xml.write_attribute("text-anchor", place);
        if anchor == Anchor::Upwards {
            let turn = format!("rotate(-90 {} {})", rounded(x), rounded(y));
            self.xml.write_attribute("transform", &turn);
        }
        let runs = runs(text);
        if runs.len() > 1 {
            // Programs that read or search the text find it in one piece.
            let label = text.replace('&', "&amp;").replace('<', "&lt;");
            self.xml.write_attribute("aria-label", &label);
        }
        self.xml.set_preserve_whitespaces(true);
        self.write_runs(&runs, f64::from(size));
        self.xml.end_element();
        self.xml.set_preserve_whitespaces(false);
        self.texts.push(Text {
            at,
            text: text.to_owned(),
            size,
            anchor,
        });
    }

    /// Writes the parts of a text of a size \[px\] into the open element.
    fn write_runs(&mut self, runs: &[Run], size: f64) {
        let mut is_lowered = false;
        for Run { text, style } in runs {
            let drop = rounded(SUBSCRIPT_DROP * size);
            let is_span = *style != Style::Upright || is_lowered;
            if is_span {
                self.xml.start_element("tspan");
            }
            // Baseline shifts are relative to the part before.
            if is_lowered {
                self.xml.write_attribute_fmt("dy", format_args!("-{drop}"));
            }
            match style {
                Style::Upright => (),
                Style::Italic => self.xml.write_attribute("font-style", "italic"),
                Style::Subscript => {
                    let size = rounded(SUBSCRIPT_SIZE * size);
                    self.xml.write_attribute("dy", &drop);
                    self.xml.write_attribute("font-size", &size);
                }
            }
            is_lowered = *style == Style::Subscript;
            // The writer escapes "<" only.
            self.xml.write_text(&text.replace('&', "&amp;"));
            if is_span {
                self.xml.end_element();
            }
        }
    }

    /// Image that fills its area, without smoothing between its pixels.
    pub(crate) fn image(&mut self, raster: Raster) -> Result<(), PlotError> {
        let Area {
            left,
            top,
            width,
            height,
        } = raster.area;
        let places = [
            ("x", left),
            ("y", top),
            ("width", width),
            ("height", height),
        ];
        self.start_element("image", &places);
        self.xml.write_attribute("preserveAspectRatio", "none");
        // Viewers that do not know the property of CSS take the attribute.
        self.xml.write_attribute("image-rendering", "optimizeSpeed");
        self.xml
            .write_attribute("style", "image-rendering:pixelated");
        self.xml.write_attribute("href", &raster.data_url()?);
        self.xml.end_element();
        self.rasters.push(raster);
        Ok(())
    }

    /// Writes an element with its coordinates, other attributes and pen, in this order.
    fn element(&mut self, name: &str, places: &[(&str, f64)], texts: &[(&str, &str)], pen: &Pen) {
        self.start_element(name, places);
        for (name, text) in texts {
            self.xml.write_attribute(name, *text);
        }
        self.xml.write_attribute("stroke", pen.colour);
        if pen.colour != NO_PEN.colour {
            self.xml.write_attribute("stroke-width", &pen.width);
        }
        if let Some(dash) = &pen.dash {
            self.xml.write_attribute("stroke-dasharray", dash);
        }
        self.xml.end_element();
    }

    /// Begins an element with its coordinates, rounded to a hundredth of a pixel.
    fn start_element(&mut self, name: &str, places: &[(&str, f64)]) {
        self.xml.start_element(name);
        for (name, value) in places {
            self.xml.write_attribute(name, &rounded(*value));
        }
    }
}

/// A coordinate rounded to a hundredth of a pixel.
fn rounded(value: f64) -> impl Display {
    // Adding zero turns a negative zero into zero.
    (100.0 * value).round() / 100.0 + 0.0
}
