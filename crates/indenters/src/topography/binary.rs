//! Heights in binary behind a short header.

use super::{Topography, metres, text_of};

/// Gwyddion Simple Field: a text, one to four zeros, and f32 from the upper row down
/// (<https://gwyddion.net/documentation/user-guide-en/gsf.html>).
pub(super) fn simple_field(contents: &[u8]) -> Result<Topography, String> {
    let end = contents.iter().position(|byte| *byte == 0).unwrap_or(0);
    let head = text_of(&contents[..end]);
    let (first, head) = head.split_once('\n').unwrap_or_default();
    if first.trim() != "Gwyddion Simple Field 1.0" {
        return Err("another beginning".to_owned());
    }
    let found = |key: &str, otherwise: &'static str| {
        let mut pairs = head.lines().filter_map(|line| line.split_once('='));
        let found = pairs.find(|(name, _)| name.trim() == key);
        found.map_or(otherwise, |(_, value)| value.trim())
    };
    let number = |key: &str| {
        let given = found(key, "1.0");
        given.parse::<f64>().map_err(|_| format!("{key} = {given}"))
    };
    let count = |key: &str| {
        let given = found(key, "none");
        let count = given.parse::<usize>().ok().filter(|count| *count > 0);
        count.ok_or_else(|| format!("{key} = {given}"))
    };
    let shape = [count("XRes")?, count("YRes")?];
    let unit = metres(found("XYUnits", "m"))?;
    let height = metres(found("ZUnits", "m"))?;
    let spacing = [
        unit * number("XReal")? / shape[0] as f64,
        unit * number("YReal")? / shape[1] as f64,
    ];
    // The zeros end at a multiple of four bytes.
    let values = contents.get(4 * (end / 4 + 1)..).unwrap_or_default();
    let values = values.as_chunks().0;
    if shape[0].checked_mul(shape[1]) != Some(values.len()) {
        return Err(format!("{} heights for {shape:?}", values.len()));
    }
    Ok(Topography::of_rows(shape, spacing, true, |index| {
        height * f64::from(f32::from_le_bytes(values[index]))
    }))
}

/// Digital Surf: 512 bytes, two comments, and integers. The places in the header are those that SurfaceTopography (Pastewka
/// and others, `IO/SUR.py`) reads; the offset of all heights has no effect.
pub(super) fn digital_surf(contents: &[u8]) -> Result<Topography, String> {
    if contents.len() < 512 || !contents.starts_with(b"DIGITAL SURF") {
        return Err("another beginning".to_owned());
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
        bits => return Err(format!("{bits} bits for a point")),
    };
    let shape = [count(108), count(112)];
    let begin = 512 + short(334) + short(336);
    let points = shape[0].checked_mul(shape[1]);
    let needed = points.and_then(|points| points.checked_mul(bytes));
    let given = contents.len().saturating_sub(begin);
    if short(18) != 2 || needed.is_none_or(|needed| needed == 0 || needed > given) {
        return Err(format!("kind {}, {given} bytes for {shape:?}", short(18)));
    }
    let spacing = [real(120) * unit(180)?, real(124) * unit(196)?];
    // Inverted, and perhaps mirrored, which changes neither friction nor area.
    let sign = if short(290) == 0 { 1.0 } else { -1.0 };
    let step = sign * real(128) * unit(212)?;
    let missing = (short(86) == 1).then(|| i32::from_le_bytes(four(100)).wrapping_sub(2));
    Ok(Topography::of_rows(shape, spacing, false, |index| {
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
    }))
}
