//! Reader of arrays in the format of `numpy.save`: a header in the notation of Python, then the numbers.

use super::memory::Memory;
use super::{ReadFailure, Topography};

/// Signature with which a file of `numpy.save` begins.
const MAGIC: &[u8] = b"\x93NUMPY";
/// Length of a number of the type `<f4`, \[bytes].
const F32_BYTES: usize = size_of::<f32>();
/// Length of a number of the type `<f8`, \[bytes].
const F64_BYTES: usize = size_of::<f64>();

/// Reads little-endian floats of the shape (n_y, n_x), in which NaN is a missing height.
pub(super) fn read(
    contents: &[u8],
    spacing: [f64; 2],
    memory: Memory,
) -> Result<Topography, ReadFailure> {
    // Read type, order and shape of the numbers from the header, and check the length of the file.
    let (header, numbers) = split_header(contents)?;
    let size = size_of_number(header)?;
    let by_column = is_by_column(header)?;
    let shape @ [rows, columns] = shape_of(header)?;
    let count = rows.checked_mul(columns);
    if count.and_then(|count| count.checked_mul(size)) != Some(numbers.len()) {
        let bytes = numbers.len();
        let needed = format!("{rows} x {columns} numbers of {size} bytes are needed");
        return Err(format!("{needed}, but there are {bytes} bytes").into());
    }
    memory.require_heights(Some(numbers.len() / size))?;
    // Read the heights, which have four or eight bytes each.
    let mut heights: Vec<f64> = if size == F32_BYTES {
        let number = |bytes: &[u8; F32_BYTES]| f32::from_le_bytes(*bytes).into();
        numbers.as_chunks().0.iter().map(number).collect()
    } else {
        let number = |bytes: &[u8; F64_BYTES]| f64::from_le_bytes(*bytes);
        numbers.as_chunks().0.iter().map(number).collect()
    };
    // If the file stores column after column, put the heights into the order of rows.
    if by_column {
        let place = |index: usize| index / columns + index % columns * rows;
        let in_rows = (0..heights.len()).map(|index| heights[place(index)]);
        heights = in_rows.collect();
    }
    if let Some(index) = heights.iter().position(|height| height.is_infinite()) {
        let ([row, column], value) = ([index / columns, index % columns], heights[index]);
        let needed = format!("[{row}, {column}]: a finite height is needed");
        return Err(format!("{needed}, and not {value}").into());
    }
    Ok(Topography::of_rows(shape, spacing, heights))
}

/// Splits a file into its header and the bytes of the numbers.
fn split_header(bytes: &[u8]) -> Result<(&str, &[u8]), String> {
    let (start, length) = match bytes.strip_prefix(MAGIC) {
        Some([1, 0, low, high, ..]) => (10, u32::from(u16::from_le_bytes([*low, *high]))),
        Some([2 | 3, 0, a, b, c, d, ..]) => (12, u32::from_le_bytes([*a, *b, *c, *d])),
        _ => return Err("an array of NumPy in the format 1.0, 2.0 or 3.0 is needed".to_owned()),
    };
    let needed = usize::try_from(length).map_or(usize::MAX, |length| length.saturating_add(start));
    let length = bytes.len();
    let too_short = || format!("the header ends after {needed} bytes, but the file has {length}");
    let header = bytes.get(start..needed).ok_or_else(too_short)?;
    let header = std::str::from_utf8(header).map_err(|_| without("anything in UTF-8"))?;
    Ok((header, &bytes[needed..]))
}

/// Message for a header without an entry of NumPy, which `what` describes.
fn without(what: &str) -> String {
    format!("the header does not say {what}")
}

/// The rest of the header from the value of a key on, as `'<f8', …` for `'descr'`; `None` without the key.
fn value_of<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    let (_, value) = header.split_once(key)?;
    Some(value.trim_start().strip_prefix(':')?.trim_start())
}

/// Length of a number, \[bytes]; fails for all types but little-endian floats.
fn size_of_number(header: &str) -> Result<usize, String> {
    match value_of(header, "'descr'") {
        Some(value) if value.starts_with("'<f8'") => Ok(F64_BYTES),
        Some(value) if value.starts_with("'<f4'") => Ok(F32_BYTES),
        Some(value) => {
            let found: String = value
                .chars()
                .filter(|letter| !letter.is_control())
                .take_while(|letter| *letter != ',')
                .take(40)
                .collect();
            let needed = "little-endian floats are needed, '<f8' or '<f4'";
            Err(format!(
                "{needed}, and not {found}: save heights.astype(\"<f8\")"
            ))
        }
        None => Err(without("the type of its numbers, as in 'descr': '<f8'")),
    }
}

/// Whether the first index is the fastest, as in a transposed array.
fn is_by_column(header: &str) -> Result<bool, String> {
    match value_of(header, "'fortran_order'") {
        Some(value) if value.starts_with("True") => Ok(true),
        Some(value) if value.starts_with("False") => Ok(false),
        _ => Err(without(
            "the order of its numbers, as in 'fortran_order': False",
        )),
    }
}

/// The numbers of rows and columns of the array; fails for another number of dimensions.
fn shape_of(header: &str) -> Result<[usize; 2], String> {
    let stated_lengths = || -> Option<Vec<usize>> {
        let tuple = value_of(header, "'shape'")?.strip_prefix('(')?;
        let (tuple, _) = tuple.split_once(')')?;
        // A tuple may end with a comma.
        let lengths = tuple.trim().split_terminator(',');
        lengths.map(|length| length.trim().parse().ok()).collect()
    };
    let lengths = stated_lengths().ok_or_else(|| without("its shape, as in 'shape': (3, 4)"))?;
    <[usize; 2]>::try_from(lengths).map_err(|lengths| {
        let dimensions = lengths.len();
        format!("an array of 2 dimensions is needed, and not of {dimensions}")
    })
}
