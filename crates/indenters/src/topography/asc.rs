//! Esri's ASCII grid: names and numbers, then the heights in rows, the upper one first.

use super::{Topography, text_of};
use numerics::whole_part;

const DEFAULT_MISSING: f64 = -9999.0;

pub(super) fn read(contents: &[u8]) -> Result<Topography, String> {
    let text = text_of(contents);
    let mut words = text.split_whitespace().peekable();
    let mut known: Vec<(String, f64)> = Vec::new();
    while let Some(name) = words.next_if(|word| word.starts_with(char::is_alphabetic)) {
        let number = words.next().and_then(|word| word.parse().ok());
        let number = number.ok_or_else(|| format!("no number after '{name:.40}'"))?;
        known.push((name.to_ascii_lowercase(), number));
    }
    let find = |name: &str| known.iter().find(|(known, _)| known == name);
    let number = |names: [&str; 2]| {
        let found = names.into_iter().find_map(find).map(|(_, number)| *number);
        found.ok_or_else(|| format!("no {}", names[0]))
    };
    let [columns, rows] = [number(["ncols"; 2])?, number(["nrows"; 2])?];
    let spacing = [number(["cellsize", "dx"])?, number(["cellsize", "dy"])?];
    let missing = number(["nodata_value"; 2]).unwrap_or(DEFAULT_MISSING);
    let heights = words.map(|word| word.parse().map_err(|_| format!("a height '{word:.40}'")));
    let heights: Vec<f64> = heights.collect::<Result<_, String>>()?;
    if [columns, rows].iter().any(|count| count.fract() != 0.0)
        || columns * rows - heights.len() as f64 != 0.0
    {
        let count = heights.len();
        return Err(format!("{count} heights for {columns} × {rows} points"));
    }
    let shape = [columns, rows].map(whole_part);
    let height = |at: usize| {
        let is_missing = heights[at].to_bits() == missing.to_bits();
        if is_missing { f64::NAN } else { heights[at] }
    };
    Ok(Topography::of_rows(shape, spacing, true, height))
}
