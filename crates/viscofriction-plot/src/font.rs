//! The bundled font, with which texts are both measured and drawn into the PNG.

use resvg::tiny_skia::PathBuilder;
use ttf_parser::{Face, OutlineBuilder};

use crate::error::PlotError;
use crate::symbols::{Run, SUBSCRIPT_DROP, SUBSCRIPT_SIZE, Style, runs};

/// Family name of the bundled font.
pub(crate) const FAMILY: &str = "DejaVu Sans";
/// Font units per text size.
pub(crate) const UNITS_PER_EM: f32 = 2048.0;

/// Slant of italic letters: horizontal over vertical distance, that of DejaVu Sans Oblique (11°).
const SLANT: f32 = 0.194;

/// Outlines of the letters of a text, in font units from the start of the baseline, y upwards.
#[derive(Default)]
pub(crate) struct Outline {
    /// Curves of the letters.
    pub(crate) path: PathBuilder,
    /// Length of the text along the baseline.
    pub(crate) length: f32,
    /// Horizontal over vertical distance in the letters of the current part.
    slant: f32,
    /// Size of the letters of the current part, relative to the text size.
    scale: f32,
    /// Distance of the current part below the baseline of the text.
    drop: f32,
}

impl Outline {
    /// Outline of a text; an empty text and characters without a glyph are refused.
    pub(crate) fn new(text: &str) -> Result<Self, PlotError> {
        let refuse = || PlotError::Glyph(text.into());
        let face = Face::parse(include_bytes!("../assets/DejaVuSans.ttf"), 0)
            .map_err(|error| PlotError::Render(error.to_string()))?;
        let mut outline = Self::default();
        for Run { text, style } in runs(text) {
            outline.set_style(style);
            for character in text.chars() {
                let glyph = face.glyph_index(character).ok_or_else(refuse)?;
                // A blank has no outline.
                face.outline_glyph(glyph, &mut outline);
                let advance = f32::from(face.glyph_hor_advance(glyph).ok_or_else(refuse)?);
                outline.length += outline.scale * advance;
            }
        }
        if text.is_empty() {
            return Err(refuse());
        }
        Ok(outline)
    }

    /// Sets slant, size and drop of the following letters.
    fn set_style(&mut self, style: Style) {
        #[expect(clippy::cast_possible_truncation, reason = "constants of two digits")]
        let [size, drop] = [SUBSCRIPT_SIZE as f32, SUBSCRIPT_DROP as f32 * UNITS_PER_EM];
        (self.slant, self.scale, self.drop) = match style {
            Style::Upright => (0.0, 1.0, 0.0),
            Style::Italic => (SLANT, 1.0, 0.0),
            Style::Subscript => (0.0, size, drop),
        };
    }

    /// Position of a point (x, y) of the outline of a letter, in font units, after the letters before it.
    fn place(&self, x: f32, y: f32) -> [f32; 2] {
        let right = self.length + self.scale * (x + self.slant * y);
        [right, self.scale * y - self.drop]
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let [[x1, y1], [x, y]] = [self.place(x1, y1), self.place(x, y)];
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let [[x1, y1], [x2, y2], [x, y]] =
            [self.place(x1, y1), self.place(x2, y2), self.place(x, y)];
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

/// Width of a text, \[px\]; the errors are those of [`Outline::new`].
pub(crate) fn text_width(text: &str, size: u32) -> Result<f64, PlotError> {
    Ok(f64::from(Outline::new(text)?.length / UNITS_PER_EM) * f64::from(size))
}

/// Width of a text that must not exceed the available width, \[px\].
pub(crate) fn fitting_width(text: &str, size: u32, available: f64) -> Result<f64, PlotError> {
    let needed = text_width(text, size)?;
    if needed <= available {
        return Ok(needed);
    }
    Err(PlotError::TextWidth {
        text: text.into(),
        needed,
        available,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_measured_with_the_bundled_font() {
        // DejaVu Sans: each digit advances by 1303 of 2048 units.
        let expected = Ok(4.0 * 1303.0 / 2048.0 * 100.0);
        assert_eq!(text_width("1230", 100), expected, "width of four digits");
    }

    #[test]
    fn greek_and_superscripts_have_glyphs() {
        for text in [
            "tan δ(Ω), μ, η, γ̇, κ",
            "10⁻⁰¹²³⁴⁵⁶⁷⁸⁹",
            "F_N/(ηv) ≤ 3 · 2 × ∞ − ½ & <a>",
            "G′ G″",
        ] {
            let got = text_width(text, 12);
            assert!(got.is_ok(), "expected glyphs for '{text}', got {got:?}");
        }
    }
}
