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
    let tree = tree.map_err(|error| PlotError::Render(error.to_string()))?;
    let refused = || PlotError::Render(format!("{width} pixels are no possible width"));
    let scaled = tree.size().to_int_size().scale_to_width(width);
    let scaled = scaled.ok_or_else(refused)?;
    let mut pixels = Pixmap::new(scaled.width(), scaled.height()).ok_or_else(refused)?;
    pixels.fill(Color::WHITE);
    let x = f64::from(scaled.width()) / f64::from(tree.size().width());
    let y = f64::from(scaled.height()) / f64::from(tree.size().height());
    #[allow(
        clippy::cast_possible_truncation,
        reason = "a scale needs no more digits"
    )]
    let scale = Transform::from_scale(x as f32, y as f32);
    resvg::render(&tree, scale, &mut pixels.as_mut());
    let png = pixels.encode_png();
    png.map_err(|error| PlotError::Render(error.to_string()))
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

    #[test]
    fn the_picture_has_the_width_asked_for_a_white_ground_and_letters() {
        let png = render_png(&drawing(), 400).expect("the picture is sound");
        let again = render_png(&drawing(), 400);
        assert_eq!(again.as_ref(), Ok(&png), "two pictures of one text");
        let got = Pixmap::decode_png(&png).expect("a PNG file");
        let size = (got.width(), got.height());
        assert_eq!(size, (400, 200), "size of a picture of 40 x 20");
        let corner = got.pixel(399, 0).map(|pixel| pixel.demultiply());
        let white = Some(Color::WHITE.to_color_u8());
        assert_eq!(corner, white, "colour of the upper right corner");
        let dark = got.pixels().iter().filter(|pixel| pixel.red() < 128);
        let dark = dark.count();
        // Three strokes of about 20 x 140, 20 x 140 and less: some percent of 80000 pixels.
        assert!(
            (2000..20_000).contains(&dark),
            "expected letters, got {dark} dark pixels"
        );
    }

    #[test]
    fn broken_texts_and_empty_sizes_are_refused() {
        let broken = Drawing {
            outlined: "<svg".into(),
            ..drawing()
        };
        for (drawing, width) in [(broken, 100), (drawing(), 0)] {
            let got = render_png(&drawing, width);
            assert!(
                matches!(got, Err(PlotError::Render(_))),
                "expected {drawing:?} with {width} pixels to be refused, got {got:?}"
            );
        }
    }
}
