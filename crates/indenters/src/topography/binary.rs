//! Heights in binary behind a short header.

use super::memory::Memory;
use super::text::text_of;
use super::{Topography, Unread, metres};

/// The text of a Gwyddion Simple Field is written by a program and short, \[bytes].
const LARGEST_HEAD: usize = 1 << 16;

/// Gwyddion Simple Field: a text, one to four zeros, and f32 row by row
/// (<https://gwyddion.net/documentation/user-guide-en/gsf.html>).
pub(super) fn simple_field(contents: &[u8], memory: Memory) -> Result<Topography, Unread> {
    let head = &contents[..contents.len().min(LARGEST_HEAD)];
    let end = head.iter().position(|byte| *byte == 0).unwrap_or(0);
    let head = text_of(&contents[..end]);
    let (first, head) = head.split_once('\n').unwrap_or_default();
    if first.trim() != "Gwyddion Simple Field 1.0" {
        return Err("another beginning".to_owned().into());
    }
    let found = |key: &str, otherwise: &'static str| {
        let mut pairs = head.lines().filter_map(|line| line.split_once('='));
        let found = pairs.find(|(name, _)| name.trim() == key);
        found.map_or(otherwise, |(_, value)| value.trim())
    };
    let number = |key: &str| {
        let given = found(key, "1.0");
        given
            .parse::<f64>()
            .map_err(|_| format!("{key} = {given:.40}"))
    };
    let count = |key: &str| {
        let given = found(key, "none");
        let count = given.parse::<usize>().ok().filter(|count| *count > 0);
        count.ok_or_else(|| format!("{key} = {given:.40}"))
    };
    let [columns, rows] = [count("XRes")?, count("YRes")?];
    let unit = metres(found("XYUnits", "m"))?;
    let height = metres(found("ZUnits", ""))?;
    let spacing = [
        unit * number("XReal")? / columns as f64,
        unit * number("YReal")? / rows as f64,
    ];
    // The zeros end at a multiple of four bytes.
    let values = contents.get(4 * (end / 4 + 1)..).unwrap_or_default();
    let values = values.as_chunks().0;
    if columns.checked_mul(rows) != Some(values.len()) {
        let count = values.len();
        return Err(format!("{count} heights for {columns} × {rows} points").into());
    }
    memory.holds(Some(values.len()))?;
    let values = values
        .iter()
        .map(|value| height * f64::from(f32::from_le_bytes(*value)));
    Ok(Topography {
        states_unit: !found("ZUnits", "").is_empty(),
        ..Topography::of_rows([rows, columns], spacing, values.collect())
    })
}

/// Digital Surf: 512 bytes, two comments, and integers. The places in the header are those that SurfaceTopography (Pastewka
/// and others, `IO/SUR.py`) reads; the offset of all heights has no effect.
pub(super) fn digital_surf(contents: &[u8], memory: Memory) -> Result<Topography, Unread> {
    if contents.len() < 512 || !contents.starts_with(b"DIGITAL SURF") {
        return Err("another beginning".to_owned().into());
    }
    let two = |at: usize| [contents[at], contents[at + 1]];
    let four = |at: usize| std::array::from_fn(|byte| contents[at + byte]);
    let short = |at: usize| usize::from(u16::from_le_bytes(two(at)));
    let real = |at: usize| f64::from(f32::from_le_bytes(four(at)));
    let unit = |at: usize| metres(&text_of(&contents[at..at + 16]));
    let count = |at: usize| u32::from_le_bytes(four(at)) as usize;
    let bytes = match short(98) {
        16 => 2,
        32 => 4,
        bits => return Err(format!("{bits} bits for a point").into()),
    };
    let [columns, rows] = [count(108), count(112)];
    let begin = 512 + short(334) + short(336);
    let points = columns.checked_mul(rows);
    let needed = points.and_then(|points| points.checked_mul(bytes));
    let given = contents.len().saturating_sub(begin);
    if short(18) != 2 || needed.is_none_or(|needed| needed == 0 || needed > given) {
        let kind = short(18);
        let points = format!("{columns} × {rows} points");
        return Err(format!("kind {kind}, {given} bytes for {points}").into());
    }
    memory.holds(points)?;
    let spacing = [real(120) * unit(180)?, real(124) * unit(196)?];
    // Inverted heights.
    let sign = if short(290) == 0 { 1.0 } else { -1.0 };
    let step = sign * real(128) * unit(212)?;
    let missing = (short(86) == 1).then(|| i32::from_le_bytes(four(100)).wrapping_sub(2));
    let height = |index: usize| {
        let at = begin + bytes * index;
        let value = match bytes {
            2 => i32::from(i16::from_le_bytes(two(at))),
            _ => i32::from_le_bytes(four(at)),
        };
        if Some(value) == missing {
            f64::NAN
        } else {
            step * f64::from(value)
        }
    };
    let heights = (0..columns * rows).map(height).collect();
    let unit_of_heights = text_of(&contents[212..228]);
    Ok(Topography {
        states_unit: !unit_of_heights.trim_matches(['\0', ' ']).is_empty(),
        ..Topography::of_rows([rows, columns], spacing, heights)
    })
}
