//! Reader of ISO 25178-72: a zip archive with a description in XML and binary heights, x fastest, all in metres.

use std::io::{Cursor, Read as _};
use std::str::FromStr;

use roxmltree::{Document, Node};
use zip::ZipArchive;

use super::memory::Memory;
use super::{ReadFailure, Topography};

/// Largest length of the description, \[bytes]. Chosen: a small archive may expand to any length.
const MAX_DESCRIPTION_BYTES: u64 = 1 << 20;
/// Largest number of attributes in the description. Chosen, because the parser compares each with all others.
const MAX_ATTRIBUTES: usize = 4096;
/// Largest number of parts of an archive. Chosen; only a description and heights are needed.
const MAX_ARCHIVE_PARTS: usize = 1000;
/// Largest padding after the heights, \[bytes]. Chosen: programs fill up a block of a file at most; more bytes mean that the
/// number of heights is wrong.
const MAX_PADDING_BYTES: u64 = 4096;

/// Reads an archive with a description in XML and a matrix of heights.
pub(super) fn read(contents: &[u8], memory: Memory) -> Result<Topography, ReadFailure> {
    let mut archive = open_archive(contents)?;
    let mut read_part = |name: &str, max_bytes: u64| read_part(&mut archive, name, max_bytes);
    // Read the description main.xml of the archive, and refuse it if it has too many attributes.
    let main = read_part("main.xml", MAX_DESCRIPTION_BYTES)?;
    if main.iter().filter(|byte| **byte == b'=').count() > MAX_ATTRIBUTES {
        return Err(format!("main.xml: more than {MAX_ATTRIBUTES} attributes").into());
    }
    let main = String::from_utf8(main).map_err(|error| error.to_string())?;
    let main = Description(Document::parse(&main).map_err(|error| error.to_string())?);
    // Check that the points are equally spaced in one layer.
    let axes = ["CX", "CY"].map(|axis| main.text(&format!("Record1/Axes/{axis}/AxisType")));
    if axes != ["I", "I"] || main.number::<usize>("Record3/MatrixDimension/SizeZ")? != 1 {
        let [x, y] = axes;
        return Err(format!("axes '{x:.40}' and '{y:.40}'").into());
    }
    // Read shape, spacing and type of the numbers.
    let size = |axis: &str| main.number::<usize>(&format!("Record3/MatrixDimension/Size{axis}"));
    let increment = |axis: &str| main.number::<f64>(&format!("Record1/Axes/C{axis}/Increment"));
    let [columns, rows] = [size("X")?, size("Y")?];
    let spacing = [increment("X")?, increment("Y")?];
    let kind = main.text("Record1/Axes/CZ/DataType");
    let is_integer = ["I", "L"].contains(&kind);
    let valid = main.text("Record3/DataLink/ValidPointsLink");
    let points = columns.checked_mul(rows);
    memory.require_heights(points)?;
    let points = points.unwrap_or_default();
    let bytes = bytes_of(kind).ok_or_else(|| format!("the type '{kind:.40}'"))?;
    let link = main.text("Record3/DataLink/PointDataLink");
    let lengths = [points.saturating_mul(bytes), points.div_ceil(8)];
    let [max_bytes, bits] = lengths.map(|length| (length as u64).saturating_add(MAX_PADDING_BYTES));
    // Read the heights and the marks of valid points.
    let heights = Heights {
        kind,
        step: if is_integer { increment("Z")? } else { 1.0 },
        data: read_part(link, max_bytes)?,
        valid: (!valid.is_empty())
            .then(|| read_part(valid, bits))
            .transpose()?,
    };
    if points == 0 || !heights.are_complete(points) {
        let given = heights.data.len();
        let points = format!("{columns} × {rows} points");
        return Err(format!("{given} bytes of type '{kind}' for {points}").into());
    }
    let heights = (0..points).map(|index| heights.height(index));
    Ok(Topography {
        states_unit: true,
        ..Topography::of_rows([rows, columns], spacing, heights.collect())
    })
}

/// Zip archive in memory.
type Archive<'a> = ZipArchive<Cursor<&'a [u8]>>;

/// Opens the archive; fails for one of too many parts.
fn open_archive(contents: &[u8]) -> Result<Archive<'_>, String> {
    let parts = contents.windows(4).filter(|start| *start == b"PK\x01\x02");
    if parts.take(MAX_ARCHIVE_PARTS + 1).count() > MAX_ARCHIVE_PARTS {
        return Err(format!("an archive of more than {MAX_ARCHIVE_PARTS} parts"));
    }
    ZipArchive::new(Cursor::new(contents)).map_err(|error| error.to_string())
}

/// Reads a part of the archive of at most `max_bytes`.
fn read_part(archive: &mut Archive<'_>, name: &str, max_bytes: u64) -> Result<Vec<u8>, String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{name:.40}: {error}");
    let file = archive.by_name(name).map_err(|error| wrong(&error))?;
    let mut bytes = Vec::new();
    if file.size() <= max_bytes {
        // The part may be larger than the archive states.
        let read = file
            .take(max_bytes.saturating_add(1))
            .read_to_end(&mut bytes);
        read.map_err(|error| wrong(&error))?;
        if bytes.len() as u64 <= max_bytes {
            return Ok(bytes);
        }
    }
    Err(wrong(&format!("more than {max_bytes} bytes")))
}

/// The description of the surface.
struct Description<'a>(Document<'a>);

impl Description<'_> {
    /// Text of the element at a path of names; empty if there is none.
    fn text(&self, path: &str) -> &str {
        let named = |node: Node<'_, '_>, name: &str| node.tag_name().name() == name;
        let mut names = path.split('/');
        let inner = names.try_fold(self.0.root_element(), |node, name| {
            node.children().find(|child| named(*child, name))
        });
        inner.and_then(|node| node.text()).map_or("", str::trim)
    }

    /// The number in the element at a path of names; fails without it.
    fn number<N: FromStr>(&self, path: &str) -> Result<N, String> {
        let text = self.text(path);
        text.parse().map_err(|_| format!("{path} '{text:.40}'"))
    }
}

/// Numbers of the heights, and marks of valid points.
struct Heights<'a> {
    /// Type of the numbers: I, L, F or D.
    kind: &'a str,
    /// Factor from a number to a height, \[m].
    step: f64,
    /// Bytes of the numbers.
    data: Vec<u8>,
    /// One bit for each point, the lowest first.
    valid: Option<Vec<u8>>,
}

/// Length of a number of this type, \[bytes]; `None` for an unknown type.
fn bytes_of(kind: &str) -> Option<usize> {
    let kinds = [("I", 2), ("L", 4), ("F", 4), ("D", 8)];
    let found = kinds.into_iter().find(|(known, _)| *known == kind);
    found.map(|(_, bytes)| bytes)
}

impl Heights<'_> {
    /// True if there are numbers and marks for all points.
    fn are_complete(&self, points: usize) -> bool {
        let are_there = |bytes| points <= self.data.len() / bytes;
        let have_bits = |bits: &Vec<u8>| points.div_ceil(8) <= bits.len();
        bytes_of(self.kind).is_some_and(are_there) && self.valid.as_ref().is_none_or(have_bits)
    }

    /// Height of a point, \[m]; NaN if it is not valid.
    fn height(&self, index: usize) -> f64 {
        let is_valid = |bits: &Vec<u8>| bits[index / 8] >> (index % 8) & 1 == 1;
        if !self.valid.as_ref().is_none_or(is_valid) {
            return f64::NAN;
        }
        let height = &self.data[bytes_of(self.kind).unwrap_or_default() * index..];
        let four = || std::array::from_fn(|byte| height[byte]);
        self.step
            * match self.kind {
                "I" => f64::from(i16::from_le_bytes([height[0], height[1]])),
                "L" => f64::from(i32::from_le_bytes(four())),
                "F" => f64::from(f32::from_le_bytes(four())),
                _ => f64::from_le_bytes(std::array::from_fn(|byte| height[byte])),
            }
    }
}
