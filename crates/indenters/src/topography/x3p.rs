//! ISO 25178-72: a zip archive with a description in XML and the heights in binary, x fastest, all in metres.

use std::io::{Cursor, Read as _};
use std::str::FromStr;

use roxmltree::{Document, Node};
use zip::ZipArchive;

use super::memory::Memory;
use super::{Topography, Unread};

/// The description is written by a program, and short, \[bytes].
const LARGEST_MAIN: u64 = 1 << 20;
/// Each of its attributes, which has a sign of equality, is compared with all others.
const MOST_ATTRIBUTES: usize = 4096;
/// An archive has a description, heights, and little else.
const MOST_PARTS: usize = 1000;
/// Bytes that may follow the heights, as where a writer fills a block.
const FILLED: u64 = 4096;

pub(super) fn read(contents: &[u8], memory: Memory) -> Result<Topography, Unread> {
    let mut archive = opened(contents)?;
    let mut part = |name: &str, most: u64| part(&mut archive, name, most);
    let main = part("main.xml", LARGEST_MAIN)?;
    if main.iter().filter(|byte| **byte == b'=').count() > MOST_ATTRIBUTES {
        return Err(format!("main.xml: more than {MOST_ATTRIBUTES} attributes").into());
    }
    let main = String::from_utf8(main).map_err(|error| error.to_string())?;
    let main = Main(Document::parse(&main).map_err(|error| error.to_string())?);
    let axes = ["CX", "CY"].map(|axis| main.text(&format!("Record1/Axes/{axis}/AxisType")));
    if axes != ["I", "I"] || main.number::<usize>("Record3/MatrixDimension/SizeZ")? != 1 {
        let [x, y] = axes;
        return Err(format!("axes '{x:.40}' and '{y:.40}'").into());
    }
    let size = |axis: &str| main.number::<usize>(&format!("Record3/MatrixDimension/Size{axis}"));
    let increment = |axis: &str| main.number::<f64>(&format!("Record1/Axes/C{axis}/Increment"));
    let [columns, rows] = [size("X")?, size("Y")?];
    let spacing = [increment("X")?, increment("Y")?];
    let kind = main.text("Record1/Axes/CZ/DataType");
    let is_integer = ["I", "L"].contains(&kind);
    let valid = main.text("Record3/DataLink/ValidPointsLink");
    let points = columns.checked_mul(rows);
    memory.holds(points)?;
    let points = points.unwrap_or_default();
    let bytes = bytes_of(kind).ok_or_else(|| format!("the type '{kind:.40}'"))?;
    let link = main.text("Record3/DataLink/PointDataLink");
    let lengths = [points.saturating_mul(bytes), points.div_ceil(8)];
    let [most, bits] = lengths.map(|length| (length as u64).saturating_add(FILLED));
    let heights = Heights {
        kind,
        step: if is_integer { increment("Z")? } else { 1.0 },
        data: part(link, most)?,
        valid: (!valid.is_empty()).then(|| part(valid, bits)).transpose()?,
    };
    if points == 0 || !heights.are(points) {
        let given = heights.data.len();
        let points = format!("{columns} × {rows} points");
        return Err(format!("{given} bytes of type '{kind}' for {points}").into());
    }
    let heights = (0..points).map(|index| heights.at(index));
    Ok(Topography {
        states_unit: true,
        ..Topography::of_rows([rows, columns], spacing, heights.collect())
    })
}

type Archive<'a> = ZipArchive<Cursor<&'a [u8]>>;

fn opened(contents: &[u8]) -> Result<Archive<'_>, String> {
    let parts = contents.windows(4).filter(|start| *start == b"PK\x01\x02");
    if parts.take(MOST_PARTS + 1).count() > MOST_PARTS {
        return Err(format!("an archive of more than {MOST_PARTS} parts"));
    }
    ZipArchive::new(Cursor::new(contents)).map_err(|error| error.to_string())
}

/// The bytes of a part, of which there are at most so many.
fn part(archive: &mut Archive<'_>, name: &str, most: u64) -> Result<Vec<u8>, String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{name:.40}: {error}");
    let file = archive.by_name(name).map_err(|error| wrong(&error))?;
    let mut bytes = Vec::new();
    if file.size() <= most {
        // It may be larger than the archive says.
        let read = file.take(most.saturating_add(1)).read_to_end(&mut bytes);
        read.map_err(|error| wrong(&error))?;
        if bytes.len() as u64 <= most {
            return Ok(bytes);
        }
    }
    Err(wrong(&format!("more than {most} bytes")))
}

/// The description.
struct Main<'a>(Document<'a>);

impl Main<'_> {
    /// What stands under these names, empty without them.
    fn text(&self, path: &str) -> &str {
        let named = |node: Node<'_, '_>, name: &str| node.tag_name().name() == name;
        let mut names = path.split('/');
        let inner = names.try_fold(self.0.root_element(), |node, name| {
            node.children().find(|child| named(*child, name))
        });
        inner.and_then(|node| node.text()).map_or("", str::trim)
    }

    fn number<N: FromStr>(&self, path: &str) -> Result<N, String> {
        let text = self.text(path);
        text.parse().map_err(|_| format!("{path} '{text:.40}'"))
    }
}

struct Heights<'a> {
    kind: &'a str,
    step: f64,
    data: Vec<u8>,
    /// One bit for each point, the lowest first.
    valid: Option<Vec<u8>>,
}

/// Bytes of a height.
fn bytes_of(kind: &str) -> Option<usize> {
    let kinds = [("I", 2), ("L", 4), ("F", 4), ("D", 8)];
    let found = kinds.into_iter().find(|(known, _)| *known == kind);
    found.map(|(_, bytes)| bytes)
}

impl Heights<'_> {
    fn are(&self, points: usize) -> bool {
        let are_there = |bytes| points <= self.data.len() / bytes;
        let have_bits = |bits: &Vec<u8>| points.div_ceil(8) <= bits.len();
        bytes_of(self.kind).is_some_and(are_there) && self.valid.as_ref().is_none_or(have_bits)
    }

    fn at(&self, index: usize) -> f64 {
        let is_valid = |bits: &Vec<u8>| bits[index / 8] >> (index % 8) & 1 == 1;
        if !self.valid.as_ref().is_none_or(is_valid) {
            return f64::NAN;
        }
        let at = &self.data[bytes_of(self.kind).unwrap_or_default() * index..];
        let four = || std::array::from_fn(|byte| at[byte]);
        self.step
            * match self.kind {
                "I" => f64::from(i16::from_le_bytes([at[0], at[1]])),
                "L" => f64::from(i32::from_le_bytes(four())),
                "F" => f64::from(f32::from_le_bytes(four())),
                _ => f64::from_le_bytes(std::array::from_fn(|byte| at[byte])),
            }
    }
}
