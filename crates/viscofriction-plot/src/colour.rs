//! Colours that stay apart for colour-blind readers.

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
    /// #b0b0b0, for areas only.
    Grey,
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
            Self::Grey => "#b0b0b0",
        }
    }
}
