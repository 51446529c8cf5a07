//! The bundled font: what measures the texts also draws them into the PNG, so that both agree.

use std::fmt::Write as _;
use std::sync::LazyLock;

use ttf_parser::{Face, FaceParsingError, GlyphId, OutlineBuilder};

use crate::error::PlotError;

/// Family name of the bundled font.
pub(crate) const FAMILY: &str = "DejaVu Sans";

static FACE: LazyLock<Result<Face<'static>, FaceParsingError>> =
    LazyLock::new(|| Face::parse(include_bytes!("../assets/DejaVuSans.ttf"), 0));

fn face() -> Result<&'static Face<'static>, PlotError> {
    let face = FACE.as_ref();
    face.map_err(|error| PlotError::Render(error.to_string()))
}

/// Pixels per unit of the font.
fn scale(face: &Face, size: u32) -> f64 {
    f64::from(size) / f64::from(face.units_per_em())
}

/// The glyphs of a text and where each begins in units of the font, and where the last ends.
fn layout(face: &Face, text: &str) -> Result<(Vec<(GlyphId, f64)>, f64), PlotError> {
    let refuse = || PlotError::Glyph(text.into());
    let mut end = 0.0;
    let mut glyphs = Vec::new();
    for character in text.chars() {
        let glyph = face.glyph_index(character).ok_or_else(refuse)?;
        glyphs.push((glyph, end));
        end += f64::from(face.glyph_hor_advance(glyph).ok_or_else(refuse)?);
    }
    if glyphs.is_empty() {
        return Err(refuse());
    }
    Ok((glyphs, end))
}

/// Width of a text, \[px\]; refuses characters that the font cannot draw.
pub(crate) fn text_width(text: &str, size: u32) -> Result<f64, PlotError> {
    let face = face()?;
    let (_, end) = layout(face, text)?;
    Ok(end * scale(face, size))
}

/// Width of the widest of some texts, \[px\].
pub(crate) fn widest<'a>(
    mut texts: impl Iterator<Item = &'a str>,
    size: u32,
) -> Result<f64, PlotError> {
    texts.try_fold(0.0, |widest: f64, text| {
        Ok(widest.max(text_width(text, size)?))
    })
}

/// Path data of a text with a `part` of it to the left of the point, through which its baseline passes; refuses characters
/// that the font cannot draw.
pub(crate) fn outline(
    text: &str,
    size: u32,
    [x, y]: [f64; 2],
    part: f64,
) -> Result<String, PlotError> {
    let face = face()?;
    let (glyphs, end) = layout(face, text)?;
    let scale = scale(face, size);
    let mut path = GlyphPath {
        data: String::new(),
        origin: [x, y],
        scale,
    };
    for (glyph, start) in glyphs {
        path.origin[0] = x + (start - part * end) * scale;
        // A blank has no outline.
        face.outline_glyph(glyph, &mut path);
    }
    Ok(path.data)
}

/// Path data of the glyph that begins at the origin, in pixels.
struct GlyphPath {
    data: String,
    origin: [f64; 2],
    scale: f64,
}

impl GlyphPath {
    /// Adds a step through points in units of the font, whose y is upwards.
    fn push(&mut self, step: char, points: &[[f32; 2]]) {
        self.data.push(step);
        for [x, y] in points {
            let x = self.origin[0] + f64::from(*x) * self.scale;
            let y = self.origin[1] - f64::from(*y) * self.scale;
            // A text takes all that is written to it.
            let _always = write!(self.data, "{x:.3} {y:.3} ");
        }
    }
}

impl OutlineBuilder for GlyphPath {
    fn move_to(&mut self, x: f32, y: f32) {
        self.push('M', &[[x, y]]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.push('L', &[[x, y]]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.push('Q', &[[x1, y1], [x, y]]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.push('C', &[[x1, y1], [x2, y2], [x, y]]);
    }

    fn close(&mut self) {
        self.data.push('Z');
    }
}

/// Refuses a text that is wider than its place, \[px\].
pub(crate) fn check_fit(text: &str, size: u32, available: f64) -> Result<(), PlotError> {
    let needed = text_width(text, size)?;
    if needed <= available {
        return Ok(());
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
