//! From SVG to PNG with the bundled font.

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::Tree;

use super::error::PlotError;
use super::font::svg_options;

/// Usual width of a picture, \[px\].
pub(crate) const PNG_WIDTH: u32 = 1600;

/// PNG file of an SVG text on white, `width` pixels wide.
///
/// # Errors
/// An SVG that cannot be read, or a size that cannot be allocated.
pub(crate) fn render_png(svg: &str, width: u32) -> Result<Vec<u8>, PlotError> {
    let tree =
        Tree::from_str(svg, &svg_options()).map_err(|error| PlotError::Svg(error.to_string()))?;
    let refuse = |reason: String| PlotError::Png { width, reason };
    let size = tree.size().to_int_size();
    let scaled = size
        .scale_to_width(width)
        .ok_or_else(|| refuse("no such size".into()))?;
    let mut pixels = Pixmap::new(scaled.width(), scaled.height())
        .ok_or_else(|| refuse("no such size".into()))?;
    pixels.fill(Color::WHITE);
    let [x, y] = [
        f64::from(scaled.width()) / f64::from(tree.size().width()),
        f64::from(scaled.height()) / f64::from(tree.size().height()),
    ];
    #[allow(
        clippy::cast_possible_truncation,
        reason = "a scale needs no more digits"
    )]
    let scale = Transform::from_scale(x as f32, y as f32);
    resvg::render(&tree, scale, &mut pixels.as_mut());
    pixels
        .encode_png()
        .map_err(|error| refuse(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20"><text x="0" y="18" font-family="DejaVu Sans" font-size="20" fill="#000000">μ⁻¹</text></svg>"##;

    fn pixels(svg: &str, width: u32) -> Pixmap {
        let png = render_png(svg, width).expect("the picture is sound");
        Pixmap::decode_png(&png).expect("a PNG file")
    }

    #[test]
    fn the_picture_has_the_width_asked_for_and_a_white_ground() {
        let got = pixels(SVG, 400);
        assert_eq!(
            (got.width(), got.height()),
            (400, 200),
            "size of a picture of 40 x 20"
        );
        let corner = got.pixel(399, 0).expect("a pixel").demultiply();
        assert_eq!(
            (corner.red(), corner.green(), corner.blue(), corner.alpha()),
            (255, 255, 255, 255),
            "colour of the upper right corner"
        );
    }

    #[test]
    fn text_is_drawn_with_the_bundled_font() {
        let got = pixels(SVG, 400);
        let dark = got
            .pixels()
            .iter()
            .filter(|pixel| pixel.red() < 128)
            .count();
        // Three strokes of about 20 x 140, 20 x 140 and less: some percent of 80000 pixels.
        assert!(
            (2000..20_000).contains(&dark),
            "expected letters, got {dark} dark pixels"
        );
    }

    #[test]
    fn a_picture_is_the_same_file_every_time() {
        assert_eq!(
            render_png(SVG, 300),
            render_png(SVG, 300),
            "two pictures of one text"
        );
    }

    #[test]
    fn broken_texts_and_empty_sizes_are_refused() {
        let broken = render_png("<svg", 100);
        assert!(
            matches!(broken, Err(PlotError::Svg(_))),
            "expected a reading error, got {broken:?}"
        );
        let empty = render_png(SVG, 0);
        assert!(
            matches!(empty, Err(PlotError::Png { width: 0, .. })),
            "expected a size error, got {empty:?}"
        );
    }
}
