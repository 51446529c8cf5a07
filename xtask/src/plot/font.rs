//! The bundled font: the renderer of the PNG also measures the texts, so that both agree.

use std::sync::{Arc, LazyLock};

use resvg::usvg::{Node, Options, Tree, fontdb};

use super::error::PlotError;

/// Family name of the bundled font.
pub(super) const FAMILY: &str = "DejaVu Sans";

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(include_bytes!("../../assets/DejaVuSans.ttf").to_vec());
    fonts.set_sans_serif_family(FAMILY);
    Arc::new(fonts)
});

/// Reader options that know the bundled font and no other.
pub(super) fn svg_options() -> Options<'static> {
    Options {
        fontdb: Arc::clone(&FONTS),
        font_family: FAMILY.into(),
        ..Options::default()
    }
}

/// Width of a text, \[px\]; refuses characters that the font cannot draw.
pub(super) fn text_width(text: &str, size: u32) -> Result<f64, PlotError> {
    let refuse = || PlotError::Glyph { text: text.into() };
    let content = text.replace('&', "&amp;").replace('<', "&lt;");
    let svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><text y="9" font-size="{size}">{content}</text></svg>"#
    );
    let tree =
        Tree::from_str(&svg, &svg_options()).map_err(|error| PlotError::Svg(error.to_string()))?;
    let Some(Node::Text(node)) = tree.root().children().first() else {
        return Err(refuse());
    };
    let mut glyphs = node
        .layouted()
        .iter()
        .flat_map(|span| &span.positioned_glyphs);
    if glyphs.any(|glyph| glyph.id.0 == 0) {
        return Err(refuse());
    }
    Ok(f64::from(node.bounding_box().width()))
}

/// Refuses a text that is wider than its place, \[px\].
pub(super) fn check_fit(text: &str, size: u32, available: f64) -> Result<(), PlotError> {
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
        let expected = 4.0 * 1303.0 / 2048.0 * 100.0;
        for text in ["1234", "0000"] {
            let got = text_width(text, 100).expect("digits are in the font");
            assert!(
                (got - expected).abs() < 1e-3 * expected,
                "expected a width of {expected} px for {text}, got {got}"
            );
        }
    }

    #[test]
    fn greek_and_superscripts_have_glyphs_and_unknown_signs_are_refused() {
        for text in [
            "tan δ(Ω), μ, η, γ̇, κ",
            "10⁻⁰¹²³⁴⁵⁶⁷⁸⁹",
            "F_N/(ηv) ≤ 3 · 2 × ∞ − ½ & <a>",
            "G′ G″",
        ] {
            let got = text_width(text, 12);
            assert!(got.is_ok(), "expected glyphs for '{text}', got {got:?}");
        }
        for text in ["摩擦", ""] {
            let got = text_width(text, 12);
            assert_eq!(
                got,
                Err(PlotError::Glyph { text: text.into() }),
                "text '{text}'"
            );
        }
    }
}
