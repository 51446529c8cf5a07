//! Raster images of fields, which are far smaller than a shape per cell.

use resvg::tiny_skia::{Pixmap, PremultipliedColorU8};

use crate::canvas::Area;
use crate::error::PlotError;

/// Image that fills an area of the drawing, each of its pixels with one colour.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Raster {
    pub(crate) area: Area,
    pub(crate) pixels: Pixmap,
}

impl Raster {
    /// Image of `[columns, rows]` pixels; `colour` gets the column from the left and the row from the bottom, and is `None` for a
    /// transparent pixel.
    pub(crate) fn new(
        area: Area,
        [columns, rows]: [u32; 2],
        colour: impl Fn(u32, u32) -> Option<[u8; 3]>,
    ) -> Result<Self, PlotError> {
        let refused = || PlotError::Render(format!("an image of {columns} × {rows} pixels"));
        let mut pixels = Pixmap::new(columns, rows).ok_or_else(refused)?;
        let places = (0..rows)
            .rev()
            .flat_map(|row| (0..columns).map(move |column| (column, row)));
        for ((column, row), pixel) in places.zip(pixels.pixels_mut()) {
            let opaque = colour(column, row).and_then(|[red, green, blue]| {
                PremultipliedColorU8::from_rgba(red, green, blue, 255)
            });
            if let Some(opaque) = opaque {
                *pixel = opaque;
            }
        }
        Ok(Self { area, pixels })
    }

    /// The image as a URL with its PNG file.
    pub(crate) fn data_url(&self) -> Result<String, PlotError> {
        let png = self
            .pixels
            .encode_png()
            .map_err(|error| PlotError::Render(error.to_string()))?;
        Ok(format!("data:image/png;base64,{}", base64(&png)))
    }
}

/// Bytes in the encoding base64 (RFC 4648, Section 4).
fn base64(bytes: &[u8]) -> String {
    /// Letters of the digits 0 to 63.
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let bits = (0..3).fold(0_usize, |bits, index| {
            (bits << 8) | usize::from(group.get(index).copied().unwrap_or(0))
        });
        for index in 0..4 {
            // A group of n bytes has n + 1 digits.
            let digit = DIGITS[(bits >> (18 - 6 * index)) & 63];
            text.push(if index <= group.len() {
                char::from(digit)
            } else {
                '='
            });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_encoded_as_in_the_examples_of_the_standard() {
        for (bytes, expected) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), expected, "of '{bytes}'");
        }
    }
}
