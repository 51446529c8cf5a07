//! Arrays as NumPy keeps them: a header in the notation of Python, then the numbers.

use indenters::topography::Topography;

const MAGIC: &[u8] = b"\x93NUMPY";
const VERSION: [u8; 2] = [1, 0];

/// An array as NumPy reads it (format 1.0), little-endian, the last index fastest.
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
pub(crate) struct NpyTable {
    /// Rows and columns.
    pub(crate) shape: [usize; 2],
    /// Row by row.
    pub(crate) values: Vec<f64>,
}

const SINGLE: usize = size_of::<f32>();
const DOUBLE: usize = size_of::<f64>();

/// The table in a file that `numpy.save` wrote, little-endian floats in rows and columns, or why it is none.
pub(crate) fn from_npy(bytes: &[u8], memory: u64) -> Result<NpyTable, String> {
    let (header, numbers) = parts(bytes)?;
    let size = size_of_number(header)?;
    let by_column = is_by_column(header)?;
    let [rows, columns] = shape(header)?;
    let count = rows.checked_mul(columns);
    if count.and_then(|count| count.checked_mul(size)) != Some(numbers.len()) {
        return Err(format!(
            "{rows} x {columns} numbers of {size} bytes are needed, but there are {} bytes",
            numbers.len()
        ));
    }
    let points = numbers.len() / size;
    Topography::check_memory(points, memory).map_err(|error| error.to_string())?;
    let mut values: Vec<f64> = if size == SINGLE {
        let number = |bytes: &[u8; SINGLE]| f32::from_le_bytes(*bytes).into();
        numbers.as_chunks().0.iter().map(number).collect()
    } else {
        let number = |bytes: &[u8; DOUBLE]| f64::from_le_bytes(*bytes);
        numbers.as_chunks().0.iter().map(number).collect()
    };
    if by_column {
        let place = |index: usize| index / columns + index % columns * rows;
        let in_rows = (0..values.len()).map(|index| values[place(index)]);
        values = in_rows.collect();
    }
    Ok(NpyTable {
        shape: [rows, columns],
        values,
    })
}

/// The header, and the bytes of the numbers.
fn parts(bytes: &[u8]) -> Result<(&str, &[u8]), String> {
    let (start, length) = match bytes.strip_prefix(MAGIC) {
        Some([1, 0, low, high, ..]) => (10, u32::from(u16::from_le_bytes([*low, *high]))),
        Some([2 | 3, 0, a, b, c, d, ..]) => (12, u32::from_le_bytes([*a, *b, *c, *d])),
        _ => return Err("an array of NumPy in the format 1.0, 2.0 or 3.0 is needed".to_owned()),
    };
    let needed = usize::try_from(length).map_or(usize::MAX, |length| length.saturating_add(start));
    let length = bytes.len();
    let short = || format!("the header ends after {needed} bytes, but the file has {length}");
    let header = bytes.get(start..needed).ok_or_else(short)?;
    let header = std::str::from_utf8(header).map_err(|_| without("anything in UTF-8"))?;
    Ok((header, &bytes[needed..]))
}

/// The header does not say something as NumPy does.
fn without(what: &str) -> String {
    format!("the header does not say {what}")
}

/// What follows a key.
fn after<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    let (_, value) = header.split_once(key)?;
    Some(value.trim_start().strip_prefix(':')?.trim_start())
}

fn size_of_number(header: &str) -> Result<usize, String> {
    match after(header, "'descr'") {
        Some(value) if value.starts_with("'<f8'") => Ok(DOUBLE),
        Some(value) if value.starts_with("'<f4'") => Ok(SINGLE),
        Some(value) => {
            let letters = value.chars().filter(|letter| !letter.is_control());
            let letters = letters.take_while(|letter| *letter != ',').take(40);
            let needed = "little-endian floats are needed, '<f8' or '<f4'";
            Err(format!("{needed}, and not {}", letters.collect::<String>()))
        }
        None => Err(without("the type of its numbers, as in 'descr': '<f8'")),
    }
}

/// Whether the first index is the fastest, as of a transposed array.
fn is_by_column(header: &str) -> Result<bool, String> {
    match after(header, "'fortran_order'") {
        Some(value) if value.starts_with("True") => Ok(true),
        Some(value) if value.starts_with("False") => Ok(false),
        _ => Err(without(
            "the order of its numbers, as in 'fortran_order': False",
        )),
    }
}

fn shape(header: &str) -> Result<[usize; 2], String> {
    let lengths = || {
        let tuple = after(header, "'shape'")?.strip_prefix('(')?;
        let (tuple, _) = tuple.split_once(')')?;
        // A tuple may end with a comma.
        let lengths = tuple.trim().split_terminator(',');
        lengths.map(|length| length.trim().parse().ok()).collect()
    };
    let lengths: Option<Vec<usize>> = lengths();
    let lengths = lengths.ok_or_else(|| without("its shape, as in 'shape': (3, 4)"))?;
    <[usize; 2]>::try_from(lengths).map_err(|lengths| {
        let dimensions = lengths.len();
        format!("an array of 2 dimensions is needed, and not of {dimensions}")
    })
}
