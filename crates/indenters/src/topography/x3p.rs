//! ISO 25178-72: a zip archive with a description in XML and the heights in binary, x fastest, all in metres.

use std::io::{Cursor, Read as _};
use std::str::FromStr;

use roxmltree::{Document, Node};
use zip::ZipArchive;

use super::Topography;

/// Bytes of a part at most, so that no small archive takes all memory.
const LARGEST: u64 = 1 << 32;

pub(super) fn read(contents: &[u8]) -> Result<Topography, String> {
    let mut archive = ZipArchive::new(Cursor::new(contents)).map_err(|error| error.to_string())?;
    let mut part = |name: &str| -> Result<Vec<u8>, String> {
        let wrong = |error: &dyn std::fmt::Display| format!("{name}: {error}");
        let file = archive.by_name(name).map_err(|error| wrong(&error))?;
        let mut bytes = Vec::new();
        let read = file.take(LARGEST).read_to_end(&mut bytes);
        read.map(|_| bytes).map_err(|error| wrong(&error))
    };
    let main = String::from_utf8(part("main.xml")?).map_err(|error| error.to_string())?;
    let main = Main(Document::parse(&main).map_err(|error| error.to_string())?);
    let axes = ["CX", "CY"].map(|axis| main.text(&format!("Record1/Axes/{axis}/AxisType")));
    if axes != ["I", "I"] || main.number::<usize>("Record3/MatrixDimension/SizeZ")? != 1 {
        return Err(format!("axes {axes:?}"));
    }
    let size = |axis: &str| main.number::<usize>(&format!("Record3/MatrixDimension/Size{axis}"));
    let increment = |axis: &str| main.number::<f64>(&format!("Record1/Axes/C{axis}/Increment"));
    let [columns, rows] = [size("X")?, size("Y")?];
    let spacing = [increment("X")?, increment("Y")?];
    let kind = main.text("Record1/Axes/CZ/DataType");
    let is_integer = ["I", "L"].contains(&kind);
    let valid = main.text("Record3/DataLink/ValidPointsLink");
    let heights = Heights {
        kind,
        step: if is_integer { increment("Z")? } else { 1.0 },
        data: part(main.text("Record3/DataLink/PointDataLink"))?,
        valid: (!valid.is_empty()).then(|| part(valid)).transpose()?,
    };
    let points = columns.checked_mul(rows);
    let points = points.filter(|points| *points > 0 && heights.are(*points));
    let bytes = heights.data.len();
    let wrong = || format!("{bytes} bytes of type '{kind}' for {columns} × {rows} points");
    let heights = (0..points.ok_or_else(wrong)?).map(|index| heights.at(index));
    Ok(Topography {
        states_unit: true,
        ..Topography::of_rows([rows, columns], spacing, heights.collect())
    })
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
        text.parse().map_err(|_| format!("{path} '{text}'"))
    }
}

struct Heights<'a> {
    kind: &'a str,
    step: f64,
    data: Vec<u8>,
    /// One bit for each point, the lowest first.
    valid: Option<Vec<u8>>,
}

impl Heights<'_> {
    fn bytes(&self) -> Option<usize> {
        let kinds = [("I", 2), ("L", 4), ("F", 4), ("D", 8)];
        let found = kinds.into_iter().find(|(kind, _)| *kind == self.kind);
        found.map(|(_, bytes)| bytes)
    }

    fn are(&self, points: usize) -> bool {
        let are_there = |bytes| points <= self.data.len() / bytes;
        let have_bits = |bits: &Vec<u8>| points.div_ceil(8) <= bits.len();
        self.bytes().is_some_and(are_there) && self.valid.as_ref().is_none_or(have_bits)
    }

    fn at(&self, index: usize) -> f64 {
        let is_valid = |bits: &Vec<u8>| bits[index / 8] >> (index % 8) & 1 == 1;
        if !self.valid.as_ref().is_none_or(is_valid) {
            return f64::NAN;
        }
        let at = &self.data[self.bytes().unwrap_or_default() * index..];
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
