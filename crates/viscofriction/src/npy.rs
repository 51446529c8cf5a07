//! Arrays as NumPy keeps them: a header in the notation of Python, then the numbers.

use thiserror::Error;

const MAGIC: &[u8] = b"\x93NUMPY";
const VERSION: [u8; 2] = [1, 0];

/// An array as NumPy reads it (format 1.0), little-endian, the last index fastest.
#[must_use]
pub fn to_npy(values: &[f64], shape: &[usize]) -> Vec<u8> {
    let lengths: String = shape.iter().map(|length| format!("{length},")).collect();
    let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({lengths}), }}");
    // Magic, version, length and header together are a multiple of 64 bytes and end with a line feed.
    let unpadded = MAGIC.len() + VERSION.len() + 2 + header.len() + 1;
    header.push_str(&" ".repeat(unpadded.next_multiple_of(64) - unpadded));
    header.push('\n');
    let mut bytes = [MAGIC, &VERSION].concat();
    // A few lengths take no more bytes than two can count.
    bytes.extend(&header.len().to_le_bytes()[..2]);
    bytes.extend(header.bytes());
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}

/// Numbers in rows and columns.
#[derive(Debug, Clone, PartialEq)]
pub struct NpyTable {
    /// Rows and columns.
    pub shape: [usize; 2],
    /// Row by row.
    pub values: Vec<f64>,
}

/// Why a file is no table of numbers.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NpyError {
    /// Another kind of file, or another version.
    #[error("an array of NumPy in the format 1.0, 2.0 or 3.0 is needed")]
    Format,
    /// The file ends before its numbers begin.
    #[error("the header ends after {needed} bytes, but the file has {length}")]
    HeaderCut {
        /// Bytes up to the end of the header.
        needed: usize,
        /// Bytes of the file.
        length: usize,
    },
    /// Something that the header does not say as NumPy does.
    #[error("the header does not say {what}")]
    Header {
        /// What is missing.
        what: &'static str,
    },
    /// Other numbers.
    #[error("little-endian floats are needed, '<f8' or '<f4', and not {descr}")]
    DataType {
        /// As the file writes it.
        descr: String,
    },
    /// Other than rows and columns.
    #[error("an array of 2 dimensions is needed, and not of {dimensions}")]
    Dimensions {
        /// Those of the file.
        dimensions: usize,
    },
    /// Numbers are missing, or there are more.
    #[error("{rows} x {columns} numbers of {size} bytes are needed, but there are {length} bytes")]
    Length {
        /// Rows by the header.
        rows: usize,
        /// Columns by the header.
        columns: usize,
        /// Bytes of a number.
        size: usize,
        /// Bytes behind the header.
        length: usize,
    },
}

/// The table in a file that `numpy.save` wrote.
///
/// # Errors
/// [`NpyError`] for everything but little-endian floats in rows and columns.
pub fn from_npy(bytes: &[u8]) -> Result<NpyTable, NpyError> {
    let (header, numbers) = parts(bytes)?;
    let size = size_of_number(header)?;
    let by_column = is_by_column(header)?;
    let [rows, columns] = shape(header)?;
    let count = rows.checked_mul(columns);
    if count.and_then(|count| count.checked_mul(size)) != Some(numbers.len()) {
        return Err(NpyError::Length {
            rows,
            columns,
            size,
            length: numbers.len(),
        });
    }
    let mut values = floats(numbers, size);
    if by_column {
        let place = |index: usize| index / columns + index % columns * rows;
        values = (0..values.len())
            .map(|index| values[place(index)])
            .collect();
    }
    Ok(NpyTable {
        shape: [rows, columns],
        values,
    })
}

const SINGLE: usize = size_of::<f32>();
const DOUBLE: usize = size_of::<f64>();

fn floats(bytes: &[u8], size: usize) -> Vec<f64> {
    if size == SINGLE {
        let (numbers, _) = bytes.as_chunks::<SINGLE>();
        return numbers
            .iter()
            .map(|bytes| f32::from_le_bytes(*bytes).into())
            .collect();
    }
    let (numbers, _) = bytes.as_chunks::<DOUBLE>();
    numbers
        .iter()
        .map(|bytes| f64::from_le_bytes(*bytes))
        .collect()
}

/// The header, and the bytes of the numbers.
fn parts(bytes: &[u8]) -> Result<(&str, &[u8]), NpyError> {
    let (start, length) = match bytes.strip_prefix(MAGIC) {
        Some([1, 0, low, high, ..]) => (10, u32::from(u16::from_le_bytes([*low, *high]))),
        Some([2 | 3, 0, a, b, c, d, ..]) => (12, u32::from_le_bytes([*a, *b, *c, *d])),
        _ => return Err(NpyError::Format),
    };
    let needed = usize::try_from(length).map_or(usize::MAX, |length| length.saturating_add(start));
    let length = bytes.len();
    let header = bytes
        .get(start..needed)
        .ok_or(NpyError::HeaderCut { needed, length })?;
    let what = "anything in UTF-8";
    let header = std::str::from_utf8(header).map_err(|_| NpyError::Header { what })?;
    Ok((header, &bytes[needed..]))
}

/// What follows a key.
fn after<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    let (_, value) = header.split_once(key)?;
    Some(value.trim_start().strip_prefix(':')?.trim_start())
}

fn size_of_number(header: &str) -> Result<usize, NpyError> {
    let what = "the type of its numbers, as in 'descr': '<f8'";
    let value = after(header, "'descr'").ok_or(NpyError::Header { what })?;
    if value.starts_with("'<f8'") {
        return Ok(DOUBLE);
    }
    if value.starts_with("'<f4'") {
        return Ok(SINGLE);
    }
    let letters = value.chars().filter(|letter| !letter.is_control());
    let descr = letters.take_while(|letter| *letter != ',').take(40);
    Err(NpyError::DataType {
        descr: descr.collect(),
    })
}

/// Whether the first index is the fastest, as of a transposed array.
fn is_by_column(header: &str) -> Result<bool, NpyError> {
    let what = "the order of its numbers, as in 'fortran_order': False";
    let value = after(header, "'fortran_order'").ok_or(NpyError::Header { what })?;
    match (value.starts_with("True"), value.starts_with("False")) {
        (true, _) => Ok(true),
        (_, true) => Ok(false),
        _ => Err(NpyError::Header { what }),
    }
}

fn shape(header: &str) -> Result<[usize; 2], NpyError> {
    let what = "its shape, as in 'shape': (3, 4)";
    let unclear = NpyError::Header { what };
    let tuple = after(header, "'shape'").and_then(|value| value.strip_prefix('('));
    let Some((tuple, _)) = tuple.and_then(|tuple| tuple.split_once(')')) else {
        return Err(unclear);
    };
    let mut lengths: Vec<&str> = tuple.split(',').map(str::trim).collect();
    // A tuple may end with a comma; that of no dimension is empty.
    if lengths.last().is_some_and(|last| last.is_empty()) {
        lengths.pop();
    }
    let lengths: Result<Vec<usize>, _> = lengths.into_iter().map(str::parse).collect();
    let lengths = lengths.map_err(|_| unclear)?;
    let dimensions = lengths.len();
    lengths
        .try_into()
        .map_err(|_| NpyError::Dimensions { dimensions })
}

#[cfg(test)]
mod tests {
    use super::{NpyTable, from_npy, to_npy};

    #[test]
    fn what_is_written_reads_back_to_the_last_bit() {
        let values = vec![0.1, -0.0, 5e-324, f64::MAX, 1.0 / 3.0, -7.25];
        let table = from_npy(&to_npy(&values, &[2, 3])).expect("a table");
        let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&table.values), bits(&values), "numbers");
        assert_eq!(table.shape, [2, 3], "shape");
    }

    /// `numpy.save` of NumPy 2.4.6 for `numpy.asfortranarray([[1, 2, 3], [4, 5, 6]]).astype("<f4")`.
    #[test]
    fn a_transposed_array_of_single_precision_is_read_row_by_row() {
        let header = "{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3), }";
        let mut bytes = [b"\x93NUMPY\x01\x00v\x00", header.as_bytes()].concat();
        bytes.resize(127, b' ');
        bytes.push(b'\n');
        for value in [1.0_f32, 4.0, 2.0, 5.0, 3.0, 6.0] {
            bytes.extend(value.to_le_bytes());
        }
        let expected = NpyTable {
            shape: [2, 3],
            values: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        };
        assert_eq!(from_npy(&bytes), Ok(expected));
    }
}
