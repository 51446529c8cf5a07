//! From the outlines of a drawing to PNG.

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use crate::canvas::Drawing;
use crate::error::PlotError;

/// Usual width of a picture, \[px\].
pub const PNG_WIDTH: u32 = 1600;

/// PNG file of a drawing on white, `width` pixels wide.
///
/// # Errors
/// A drawing that cannot be read, or a size that cannot be allocated.
pub fn render_png(drawing: &Drawing, width: u32) -> Result<Vec<u8>, PlotError> {
    let tree = Tree::from_str(&drawing.outlined, &Options::default());
    let tree = tree.map_err(|error| PlotError::Svg(error.to_string()))?;
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
    use crate::canvas::{Anchor, Canvas};

    fn drawing() -> Drawing {
        let mut canvas = Canvas::new(40.0, 20.0);
        canvas.text([0.0, 18.0], "μ⁻¹", 20, Anchor::Start);
        canvas.finish().expect("a drawing")
    }

    fn pixels(width: u32) -> Pixmap {
        let png = render_png(&drawing(), width).expect("the picture is sound");
        Pixmap::decode_png(&png).expect("a PNG file")
    }

    #[test]
    fn the_picture_has_the_width_asked_for_and_a_white_ground() {
        let got = pixels(400);
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
        let got = pixels(400);
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
            render_png(&drawing(), 300),
            render_png(&drawing(), 300),
            "two pictures of one text"
        );
    }

    #[test]
    fn broken_texts_and_empty_sizes_are_refused() {
        let broken = Drawing {
            outlined: "<svg".into(),
            ..drawing()
        };
        let broken = render_png(&broken, 100);
        assert!(
            matches!(broken, Err(PlotError::Svg(_))),
            "expected a reading error, got {broken:?}"
        );
        let empty = render_png(&drawing(), 0);
        assert!(
            matches!(empty, Err(PlotError::Png { width: 0, .. })),
            "expected a size error, got {empty:?}"
        );
    }
}
