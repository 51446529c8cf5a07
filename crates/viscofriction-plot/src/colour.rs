//! Colours that colour-blind readers can distinguish.

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
    /// #767676, for references beside the data.
    Grey,
    /// Step from dark blue (0) to green (8), for ordered series; larger steps are the last one.
    Step(u8),
}

/// Viridis from dark blue to green, at equal steps up to where it becomes too bright for markers on white.
const STEPS: [&str; 9] = [
    "#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58",
    "#b5de2b",
];

impl Colour {
    /// Colour of a series at a fraction of an ordered sequence, from 0 for the first to 1 for the last.
    pub fn between(part: f64) -> Self {
        let steps = (1..STEPS.len()).take_while(|step| *step as f64 <= part * STEPS.len() as f64);
        Self::Step(u8::try_from(steps.count()).unwrap_or(0))
    }

    /// Value as #rrggbb.
    pub(crate) const fn hex(self) -> &'static str {
        match self {
            Self::Blue => "#0072b2",
            Self::Red => "#d55e00",
            Self::Green => "#009e73",
            Self::Magenta => "#aa3377",
            Self::Black => "#000000",
            Self::Grey => "#767676",
            Self::Step(step) => {
                let last = STEPS.len() - 1;
                STEPS[if (step as usize) < last {
                    step as usize
                } else {
                    last
                }]
            }
        }
    }
}

/// Number of distinct colours of a field (chosen: fine enough for the eye, coarse enough for a small file).
pub(crate) const LEVELS: u8 = 100;

/// Index of the colour of a field at a fraction of its scale, from 0 to [`LEVELS`] − 1.
pub(crate) fn level_at(fraction: f64) -> u8 {
    (1..LEVELS)
        .take_while(|&next| f64::from(next) <= fraction * f64::from(LEVELS))
        .last()
        .unwrap_or(0)
}

/// Red, green and blue of a colour step, from dark blue to yellow.
pub(crate) fn level_colour(level: u8) -> [u8; 3] {
    let share = (f64::from(level) + 0.5) / f64::from(LEVELS);
    let colour = VIRIDIS.eval_continuous(share);
    [colour.r, colour.g, colour.b]
}
