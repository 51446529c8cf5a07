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
    /// Reads symbols separated by blanks, those of the denominator behind a `/` each, such as `Pa s`, `rad/s` or `W/m/K`. A newton is a
    /// stress times an extent; angles and temperatures count as numbers. Fails for other symbols.
    pub(super) fn parse(text: &str) -> Result<Self> {
        let mut unit = Self::default();
        for (position, symbols) in text.split('/').enumerate() {
            let sign = if position == 0 { 1 } else { -1 };
            for symbol in symbols.split_whitespace() {
                let name = symbol.trim_end_matches(['²', '³']);
                let power = sign
                    * match &symbol[name.len()..] {
                        "²" => 2,
                        "³" => 3,
                        _ => 1,
                    };
                // Powers of \[m], \[Pa], \[s] and of the extent.
                let [length, stress, time, extent] = match name {
                    "m" => [1, 0, 0, 0],
                    "Pa" => [0, 1, 0, 0],
                    "s" => [0, 0, 1, 0],
                    "N" => [0, 1, 0, 1],
                    "J" => [3, 1, 0, 0],
                    "W" => [3, 1, -1, 0],
                    "kg" => [1, 1, 2, 0],
                    "1" | "rad" | "°C" | "K" => [0; 4],
                    // With the temperatures the thermal energy RT, \[J/mol], stays as it is.
                    "mol" => [3, 1, 0, 0],
                    _ => bail!("the unit {text:?} of a number of the scene is not known"),
                };
                unit.length += power * length;
                unit.stress += power * stress;
                unit.time += power * time;
                unit.extent += power * extent;
            }
        }
        Ok(unit)
    }
}
