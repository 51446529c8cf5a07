//! Rendering of a drawing as PNG.

use resvg::tiny_skia::{Color, FillRule, Paint, Pixmap, PixmapPaint, Transform};
use resvg::usvg::{Options, Tree};

use crate::canvas::{Anchor, BACKGROUND, Drawing, Text};
use crate::error::PlotError;
use crate::font::{Outline, UNITS_PER_EM};
use crate::raster::Raster;

/// Default width of a PNG, \[px\].
pub const PNG_WIDTH: u32 = 1600;

/// PNG file of a drawing on white with the given `width` \[px\].
///
/// # Errors
/// [`PlotError::Render`] for a drawing that cannot be read, or a size that cannot be allocated.
pub fn render_png(drawing: &Drawing, width: u32) -> Result<Vec<u8>, PlotError> {
    // The pixels are white already, and the background would cover the images.
    let svg = drawing.svg.replacen(BACKGROUND, "", 1);
    let tree = Tree::from_str(&svg, &Options::default())
        .map_err(|error| PlotError::Render(error.to_string()))?;
    let refused = || PlotError::Render(format!("{width} pixels are no possible width"));
    let scaled = tree
        .size()
        .to_int_size()
        .scale_to_width(width)
        .ok_or_else(refused)?;
    let mut pixels = Pixmap::new(scaled.width(), scaled.height()).ok_or_else(refused)?;
    pixels.fill(Color::WHITE);
    let (from, to) = (tree.size(), scaled.to_size());
    let scale = Transform::from_scale(to.width() / from.width(), to.height() / from.height());
    for raster in &drawing.rasters {
        draw_raster(&mut pixels, raster, scale);
    }
    resvg::render(&tree, scale, &mut pixels.as_mut());
    for text in &drawing.texts {
        fill_text(&mut pixels, text, scale)?;
    }
    let png = pixels.encode_png();
    png.map_err(|error| PlotError::Render(error.to_string()))
}

/// Draws an image without smoothing between its pixels.
fn draw_raster(
    pixels: &mut Pixmap,
    Raster {
        area,
        pixels: image,
    }: &Raster,
    scale: Transform,
) {
    #[expect(clippy::cast_possible_truncation, reason = "far below a pixel")]
    let [left, top, width, height] =
        [area.left, area.top, area.width, area.height].map(|length| length as f32);
    let [columns, rows] = [image.width(), image.height()].map(|count| count as f32);
    let place = scale
        .pre_translate(left, top)
        .pre_scale(width / columns, height / rows);
    let paint = PixmapPaint::default();
    pixels.draw_pixmap(0, 0, image.as_ref(), &paint, place, None);
}

/// Draws the letters of a text in black; `scale` maps the pixels of the drawing to those of the PNG.
fn fill_text(pixels: &mut Pixmap, text: &Text, scale: Transform) -> Result<(), PlotError> {
    let outline = Outline::new(&text.text)?;
    let (part_before, turn) = match text.anchor {
        Anchor::Start => (0.0, 0.0),
        Anchor::Middle => (0.5, 0.0),
        Anchor::End => (1.0, 0.0),
        Anchor::Upwards => (0.5, -90.0),
    };
    #[expect(clippy::cast_possible_truncation, reason = "far below a pixel")]
    let [x, y, size] = [text.at[0], text.at[1], f64::from(text.size)].map(|length| length as f32);
    let unit = size / UNITS_PER_EM;
    let place = scale
        .pre_translate(x, y)
        .pre_rotate(turn)
        .pre_scale(unit, -unit)
        .pre_translate(-part_before * outline.length, 0.0);
    // A blank text has no outline.
    if let Some(path) = outline.path.finish() {
        pixels.fill_path(&path, &Paint::default(), FillRule::Winding, place, None);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::Canvas;

    fn drawing() -> Drawing {
        let mut canvas = Canvas::new(40.0, 20.0);
        canvas.text([0.0, 18.0], "μ⁻¹", 20, Anchor::Start);
        canvas.finish()
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
            svg: "<svg".into(),
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
