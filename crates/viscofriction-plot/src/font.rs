//! The bundled font, with which texts are both measured and drawn into the PNG.

use resvg::tiny_skia::PathBuilder;
use ttf_parser::{Face, OutlineBuilder};

use crate::error::PlotError;

/// Family name of the bundled font.
pub(crate) const FAMILY: &str = "DejaVu Sans";
/// Font units per text size.
pub(crate) const UNITS_PER_EM: f32 = 2048.0;

/// Outlines of the letters of a text, in font units from the start of the baseline, y upwards.
#[derive(Default)]
pub(crate) struct Outline {
    /// Curves of the letters.
    pub(crate) path: PathBuilder,
    /// Length of the text along the baseline.
    pub(crate) length: f32,
}

impl Outline {
    /// Outline of a text; an empty text and characters without a glyph are refused.
    pub(crate) fn new(text: &str) -> Result<Self, PlotError> {
        let refuse = || PlotError::Glyph(text.into());
        let face = Face::parse(include_bytes!("../assets/DejaVuSans.ttf"), 0)
            .map_err(|error| PlotError::Render(error.to_string()))?;
        let mut outline = Self::default();
        for character in text.chars() {
            let glyph = face.glyph_index(character).ok_or_else(refuse)?;
            // A blank has no outline.
            face.outline_glyph(glyph, &mut outline);
            outline.length += f32::from(face.glyph_hor_advance(glyph).ok_or_else(refuse)?);
        }
        if text.is_empty() {
            return Err(refuse());
        }
        Ok(outline)
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.length + x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.length + x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let [x1, x] = [x1, x].map(|x| self.length + x);
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let [x1, x2, x] = [x1, x2, x].map(|x| self.length + x);
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
