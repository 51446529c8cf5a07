//! Units of the numbers of scenes and answers.

use anyhow::{Result, bail};
use serde::Deserialize;

/// Powers in which a unit of SI consists of base quantities that scale independently of each other (dimensional analysis).
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
pub(super) struct Unit {
    /// Power of \[m].
    pub(super) length: i32,
    /// Power of \[Pa].
    pub(super) stress: i32,
    /// Power of \[s].
    pub(super) time: i32,
    /// Power of what a stress has to be multiplied by to give a force: an area \[m²], and a length \[m] for an infinitely long
    /// cylinder, whose forces are per length.
    pub(super) extent: i32,
}

impl Unit {
    /// Reads symbols separated by blanks, those of the denominator behind one `/`, such as `Pa s` or `rad/s`. A newton is a
    /// stress times an extent; angles and degrees Celsius count as numbers. Fails for other symbols.
    pub(super) fn parse(text: &str) -> Result<Self> {
        let mut unit = Self::default();
        let (above, below) = text.split_once('/').unwrap_or((text, ""));
        for (symbols, power) in [(above, 1), (below, -1)] {
            for symbol in symbols.split_whitespace() {
                match symbol {
                    "m" => unit.length += power,
                    "Pa" => unit.stress += power,
                    "s" => unit.time += power,
                    "N" => {
                        unit.stress += power;
                        unit.extent += power;
                    }
                    "1" | "rad" | "°C" => {}
                    _ => bail!("the unit {text:?} of a number of the scene is not known"),
                }
            }
        }
        Ok(unit)
    }
}
