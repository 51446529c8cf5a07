//! Colours that stay apart for colour-blind readers.

use colorous::VIRIDIS;

/// Line and marker colours: Okabe and Ito's palette, with a magenta dark enough for thin lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colour {
    /// #0072B2.
    Blue,
    /// #D55E00 (vermilion).
    Red,
    /// #009E73 (bluish).
    Green,
    /// #AA3377.
    Magenta,
    /// #000000.
    Black,
}

impl Colour {
    /// Value as #rrggbb.
    pub(crate) const fn hex(self) -> &'static str {
        match self {
            Self::Blue => "#0072b2",
            Self::Red => "#d55e00",
            Self::Green => "#009e73",
            Self::Magenta => "#aa3377",
            Self::Black => "#000000",
        }
    }
}

/// Number of distinct colours of a field: fine enough for the eye, coarse enough for a small file.
pub(crate) const LEVELS: u8 = 100;

/// Colour step at a fraction of the scale.
pub(crate) fn level(fraction: f64) -> u8 {
    (1..LEVELS)
        .take_while(|&next| f64::from(next) <= fraction * f64::from(LEVELS))
        .last()
        .unwrap_or(0)
}

/// Colour step as #rrggbb, from dark blue to yellow.
pub(crate) fn level_colour(level: u8) -> String {
    let share = (f64::from(level) + 0.5) / f64::from(LEVELS);
    format!("#{:x}", VIRIDIS.eval_continuous(share))
}
