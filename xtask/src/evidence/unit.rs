//! Units of the numbers of scenes and answers.

use anyhow::{Result, bail};
use serde::Deserialize;

/// Powers of length, stress and time; the extent is an area, for an infinitely long cylinder a length.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
pub(super) struct Unit {
    pub(super) length: i32,
    pub(super) stress: i32,
    pub(super) time: i32,
    pub(super) extent: i32,
}

impl Unit {
    /// Reads a unit of SI such as `rad/s`; [N] is a stress times an extent.
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
