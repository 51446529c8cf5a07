//! Readers of binary heights behind a short header: Gwyddion Simple Field and Digital Surf.

use super::memory::Memory;
use super::text::text_of;
use super::{LateralUnit, ReadFailure, Topography, metres};

/// Largest length of the text header of a Gwyddion Simple Field, \[bytes]. Chosen: a file without the zero that ends it is
/// refused without a search through all of it.
const MAX_HEADER_BYTES: usize = 1 << 16;

/// Reads a Gwyddion Simple Field: a text header, one to four zeros, and f32 row by row
/// (<https://gwyddion.net/documentation/user-guide-en/gsf.html>).
pub(super) fn simple_field(contents: &[u8], memory: Memory) -> Result<Topography, ReadFailure> {
    let head = &contents[..contents.len().min(MAX_HEADER_BYTES)];
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
        let given = found(key, "none");
        given.parse::<f64>().map_err(|_| {
            format!("{key} = {given:.40}, without which the size of the map is unknown")
        })
    };
    let count = |key: &str| {
        let given = found(key, "none");
        let count = given.parse::<usize>().ok().filter(|count| *count > 0);
        count.ok_or_else(|| format!("{key} = {given:.40}"))
    };
    let [columns, rows] = [count("XRes")?, count("YRes")?];
    let unit = unit_of(found("XYUnits", ""))?;
    let height = unit_of(found("ZUnits", ""))?;
    let size = [number("XReal")?, number("YReal")?].map(|size| size * unit.unwrap_or(1.0));
    let spacing = [size[0] / columns as f64, size[1] / rows as f64];
    // The header ends with zeros up to a multiple of four bytes, behind which the heights begin.
    let data = contents.get(4 * (end / 4 + 1)..).unwrap_or_default();
    let values = data.as_chunks().0;
    if columns.checked_mul(rows) != Some(values.len()) {
        let count = values.len();
        return Err(format!("{count} heights for {columns} × {rows} points").into());
    }
    memory.require_heights(Some(values.len()))?;
    let values = values
        .iter()
        .map(|value| height.unwrap_or(1.0) * f64::from(f32::from_le_bytes(*value)));
    Ok(Topography {
        states_unit: height.is_some(),
        lateral_unit: lateral_unit(unit),
        ..Topography::of_rows([rows, columns], spacing, values.collect())
    })
}

/// Length of a unit as a file states it, \[m]; `None` if it states none.
fn unit_of(text: &str) -> Result<Option<f64>, String> {
    let unit = text.trim_matches(['\0', ' ']);
    if unit.is_empty() {
        return Ok(None);
    }
    let known = metres(unit).ok_or_else(|| format!("the unit '{unit:.40}', which is no length"));
    known.map(Some)
}

/// Source of the unit of the spacing: the file if it states a unit of x and y.
fn lateral_unit(unit: Option<f64>) -> LateralUnit {
    unit.map_or(LateralUnit::Unstated, |_| LateralUnit::Stated)
}

/// Reads a surface of Digital Surf: a header of 512 bytes, two comments, and integers.
///
/// The offsets in the header are those of SurfaceTopography (`IO/SUR.py`). The common offset of the heights has no effect.
pub(super) fn digital_surf(contents: &[u8], memory: Memory) -> Result<Topography, ReadFailure> {
    if contents.len() < 512 || !contents.starts_with(b"DIGITAL SURF") {
        return Err("another beginning".to_owned().into());
    }
    // Read the numbers and units of the header.
    let short = |at: usize| usize::from(u16::from_le_bytes(bytes_at(contents, at)));
    let real = |at: usize| f64::from(f32::from_le_bytes(bytes_at(contents, at)));
    let unit = |at: usize| unit_of(&text_of(&contents[at..at + 16]));
    let count = |at: usize| u32::from_le_bytes(bytes_at(contents, at)) as usize;
    let bytes = match short(98) {
        16 => 2,
        32 => 4,
        bits => return Err(format!("{bits} bits for a point").into()),
    };
    // Check the number of points against the length of the file.
    let [columns, rows] = [count(108), count(112)];
    let begin = 512 + short(334) + short(336);
    let points = columns.checked_mul(rows);
    let needed = points.and_then(|points| points.checked_mul(bytes));
    let given = contents.len().saturating_sub(begin);
    let [objects, kind] = [short(14), short(18)];
    let is_held = needed.is_some_and(|needed| (1..=given).contains(&needed));
    if objects > 1 || kind != 2 || !is_held {
        let points = format!("{columns} × {rows} points");
        let found = format!("{objects} objects of kind {kind}, {given} bytes for {points}");
        return Err(found.into());
    }
    memory.require_heights(points)?;
    // Read the units of the three axes, then the spacings and the height of one step in metres.
    let [unit_x, unit_y, unit_z] = [unit(180)?, unit(196)?, unit(212)?];
    let length = |at: usize, unit: Option<f64>| real(at) * unit.unwrap_or(1.0);
    let spacing = [length(120, unit_x), length(124, unit_y)];
    let step = length(128, unit_z);
    // Read the heights, which are whole numbers of two or four bytes; a special one marks missing heights.
    let missing =
        (short(86) == 1).then(|| i32::from_le_bytes(bytes_at(contents, 100)).wrapping_sub(2));
    let height = |index: usize| {
        let at = begin + bytes * index;
        let value = match bytes {
            2 => i32::from(i16::from_le_bytes(bytes_at(contents, at))),
            _ => i32::from_le_bytes(bytes_at(contents, at)),
        };
        if Some(value) == missing {
            f64::NAN
        } else {
            step * f64::from(value)
        }
    };
    let heights = (0..columns * rows).map(height).collect();
    let surface = Topography {
        states_unit: unit_z.is_some(),
        lateral_unit: lateral_unit(unit_x.and(unit_y)),
        ..Topography::of_rows([rows, columns], spacing, heights)
    };
    Ok(undo_inversion(surface, short(290))?)
}

/// The `N` bytes from an offset on; the contents must have them.
fn bytes_at<const N: usize>(contents: &[u8], at: usize) -> [u8; N] {
    std::array::from_fn(|byte| contents[at + byte])
}

/// Undoes the inversion of a stored surface: none (0), heights (1), heights and x (2), heights and y (3).
///
/// Gwyddion (`surffile.c`) does the same. Other readers take the numbers as they are; therefore a note reports it.
fn undo_inversion(mut surface: Topography, inversion: usize) -> Result<Topography, String> {
    let columns = surface.shape[1];
    let mirrored = match inversion {
        0 => return Ok(surface),
        1 => "",
        2 => {
            surface
                .heights
                .chunks_exact_mut(columns)
                .for_each(<[f64]>::reverse);
            " and mirrored along x"
        }
        3 => {
            let rows = surface.heights.chunks_exact(columns).rev();
            surface.heights = rows.flatten().copied().collect();
            " and mirrored along y"
        }
        other => return Err(format!("the inversion {other}, where 0 to 3 are known")),
    };
    surface.notes.push(format!(
        "the file says that its heights were inverted{mirrored} (inversion {inversion}), which was taken back as Gwyddion does; \
         heights_are = \"gap\" turns heights that are upside down"
    ));
    Ok(surface.scaled(-1.0))
}
