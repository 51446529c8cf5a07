//! The NumPy array format: a header in Python notation, then the numbers.

/// First bytes of every NPY file, by which readers recognise it.
const MAGIC: &[u8] = b"\x93NUMPY";
/// Major and minor version of the NPY format, 1.0, which follow the first bytes.
const VERSION: [u8; 2] = [1, 0];

/// The bytes of an NPY 1.0 file: little-endian `f64` in row-major order, with the lengths of the axes in `shape`, whose product
/// is the number of values.
pub fn to_npy(values: &[f64], shape: &[usize]) -> Vec<u8> {
    let lengths: String = shape.iter().map(|length| format!("{length},")).collect();
    let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({lengths}), }}");
    // Pad the header with blanks: the format requires that magic, version, length and header together fill a multiple of 64 bytes
    // and end with a line feed.
    let unpadded = MAGIC.len() + VERSION.len() + 2 + header.len() + 1;
    header.push_str(&" ".repeat(unpadded.next_multiple_of(64) - unpadded));
    header.push('\n');
    let mut bytes = [MAGIC, &VERSION].concat();
    // Version 1.0 stores the length of the header in two bytes, which suffice for this header.
    bytes.extend(&header.len().to_le_bytes()[..2]);
    bytes.extend(header.bytes());
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}
