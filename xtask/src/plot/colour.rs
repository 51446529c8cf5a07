//! Colours that stay apart for colour-blind readers.

/// Line and marker colours: Okabe and Ito's palette, with a magenta dark enough for thin lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Colour {
    /// #0072B2.
    Blue,
    /// #D55E00 (vermilion).
    Red,
    /// #009E73 (bluish).
    Green,
    /// #AA3377.
    Magenta,
    /// #E69F00.
    Orange,
    /// #56B4E9.
    SkyBlue,
    /// #000000.
    Black,
    /// #777777.
    Grey,
}

/// Colours in the order in which a chart of unrelated series should take them.
pub(crate) const PALETTE: [Colour; 7] = [
    Colour::Blue,
    Colour::Red,
    Colour::Green,
    Colour::Magenta,
    Colour::Orange,
    Colour::SkyBlue,
    Colour::Black,
];

impl Colour {
    /// Value as #rrggbb.
    pub(super) const fn hex(self) -> &'static str {
        match self {
            Self::Blue => "#0072b2",
            Self::Red => "#d55e00",
            Self::Green => "#009e73",
            Self::Magenta => "#aa3377",
            Self::Orange => "#e69f00",
            Self::SkyBlue => "#56b4e9",
            Self::Black => "#000000",
            Self::Grey => "#777777",
        }
    }
}
