//! Esri's ASCII grid: names and numbers, then the heights in rows.

use super::memory::Memory;
use super::text::{Notation, lines, text_of};
use super::{Topography, Unread};
use numerics::whole_part;

const DEFAULT_MISSING: f64 = -9999.0;

pub(super) fn read(contents: &[u8], memory: Memory) -> Result<Topography, Unread> {
    memory.holds_text(contents)?;
    let text = text_of(contents);
    let notation = Notation::of(&text);
    let (mut known, mut heights) = (Vec::new(), Vec::new());
    for (_, line) in lines(&text) {
        let mut words = line.split_whitespace();
        let name = words.next().unwrap_or_default();
        if heights.is_empty() && NAMES.contains(&&*name.to_ascii_lowercase()) {
            let number = words.next().and_then(|word| notation.number(word));
            let number = number.ok_or_else(|| format!("no number after '{name}'"))?;
            known.push((name.to_ascii_lowercase(), number));
            continue;
        }
        for cell in notation.cells(line) {
            let height = notation.height(cell);
            heights.push(height.ok_or_else(|| format!("a height '{cell:.40}'"))?);
        }
    }
    let find = |name: &str| known.iter().find(|(known, _)| known == name);
    let number = |names: [&str; 2]| {
        let found = names.into_iter().find_map(find).map(|(_, number)| *number);
        found.ok_or_else(|| format!("no {}", names[0]))
    };
    let [columns, rows] = [number(["ncols"; 2])?, number(["nrows"; 2])?];
    let spacing = [number(["cellsize", "dx"])?, number(["cellsize", "dy"])?];
    let missing = number(["nodata_value"; 2]).unwrap_or(DEFAULT_MISSING);
    if [columns, rows].iter().any(|count| count.fract() != 0.0)
        || columns * rows - heights.len() as f64 != 0.0
    {
        let count = heights.len();
        return Err(format!("{count} heights for {columns} × {rows} points").into());
    }
    for height in &mut heights {
        if height.to_bits() == missing.to_bits() {
            *height = f64::NAN;
        }
    }
    let shape = [rows, columns].map(whole_part);
    Ok(Topography::of_rows(shape, spacing, heights))
}

const NAMES: [&str; 10] = [
    "ncols",
    "nrows",
    "xllcorner",
    "yllcorner",
    "xllcenter",
    "yllcenter",
    "cellsize",
    "dx",
    "dy",
    "nodata_value",
];
