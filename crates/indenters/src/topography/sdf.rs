//! Reader of ISO 25178-71, and of the older BCR with the same header: a header and heights as text or binary
//! (<https://physics.nist.gov/VSC/jsp/DataFormat.jsp>).

use std::str::FromStr;

use super::text::{shown, text_of};
use super::{Memory, ReadFailure, Topography};

/// Length of the field with the version of the format, with which the file begins, \[bytes].
const VERSION_BYTES: usize = 8;
/// Length of manufacturer and dates after the version, \[bytes].
const MANUFACTURER_AND_DATES_BYTES: usize = 34;

/// The entries of the header of a file that are used.
struct Head {
    /// Number of points along x.
    columns: usize,
    /// Number of profiles, one for each y.
    rows: usize,
    /// Distances of points along x and y, and unit of the heights, \[m].
    scales: [f64; 3],
    /// Number format of the heights.
    data_type: DataType,
}

/// Number format of a height; integers with their length in bytes.
#[derive(Clone, Copy, PartialEq)]
enum DataType {
    /// Integer without a sign.
    Unsigned(usize),
    /// Integer in two's complement.
    Signed(usize),
    /// Number of 32 bits (IEEE 754).
    Single,
    /// Number of 64 bits (IEEE 754).
    Double,
}

impl DataType {
    /// The format of a code in the header, the entry `DataType`.
    fn of(number: i64) -> Result<Self, String> {
        Ok(match number {
            0 => Self::Unsigned(1),
            1 => Self::Unsigned(2),
            2 => Self::Unsigned(4),
            3 => Self::Single,
            4 => Self::Signed(1),
            5 => Self::Signed(2),
            6 => Self::Signed(4),
            7 => Self::Double,
            _ => return Err(format!("DataType = {number}, where 0 to 7 are known")),
        })
    }

    /// Length of a number, \[bytes].
    const fn bytes(self) -> usize {
        match self {
            Self::Unsigned(bytes) | Self::Signed(bytes) => bytes,
            Self::Single => 4,
            Self::Double => 8,
        }
    }

    /// Marker of a missing height: the smallest number of the format; `None` for unsigned integers.
    fn missing(self) -> Option<f64> {
        match self {
            Self::Unsigned(_) => None,
            Self::Signed(bytes) => Some(-(2.0_f64.powi(8 * i32::try_from(bytes).ok()? - 1))),
            Self::Single => Some(f64::from(f32::MIN)),
            Self::Double => Some(f64::MIN),
        }
    }

    /// The number in little-endian bytes; NaN if it is missing.
    fn number(self, bytes: &[u8]) -> f64 {
        // Assemble the bytes, the lowest first; shifts to the top and back extend the sign.
        let whole = bytes
            .iter()
            .rev()
            .fold(0_u64, |whole, byte| whole << 8 | u64::from(*byte));
        let number = match self {
            Self::Unsigned(_) => whole as f64,
            Self::Signed(count) => {
                let unused = 64 - 8 * count;
                ((whole << unused).cast_signed() >> unused) as f64
            }
            Self::Single => f64::from(f32::from_bits(u32::try_from(whole).unwrap_or_default())),
            Self::Double => f64::from_bits(whole),
        };
        self.nan_if_missing(number)
    }

    /// The number, or NaN if it is at most the marker of missing heights.
    fn nan_if_missing(self, number: f64) -> f64 {
        if self.missing().is_some_and(|missing| number <= missing) {
            f64::NAN
        } else {
            number
        }
    }
}

impl Head {
    /// Refuses compression, checksums, an empty grid, and scales that are no lengths.
    fn validated(self, compression: i64, check: i64) -> Result<Self, String> {
        for (name, number) in [("Compression", compression), ("CheckType", check)] {
            if number != 0 {
                return Err(format!("{name} = {number}, where 0 is needed"));
            }
        }
        let ([x, y, z], Self { columns, rows, .. }) = (self.scales, &self);
        if *columns == 0 || *rows == 0 {
            return Err(format!("{columns} × {rows} points"));
        }
        let are_lengths = x > 0.0 && y > 0.0 && [x, y, z].iter().all(|scale| scale.is_finite());
        if !are_lengths {
            return Err(format!(
                "Xscale = {x}, Yscale = {y} and Zscale = {z}, where lengths in m are needed"
            ));
        }
        Ok(self)
    }

    /// The surface with heights row by row, in the unit of the header.
    fn surface(self, heights: Vec<f64>) -> Topography {
        let [x, y, z] = self.scales;
        let mut surface = Topography::of_rows([self.rows, self.columns], [x, y], heights).scaled(z);
        surface.states_unit = true;
        surface
    }
}

/// Reads a text, which begins with `a`, or a binary file, which begins with `b`.
pub(super) fn read(contents: &[u8], memory: Memory) -> Result<Topography, ReadFailure> {
    match contents.first() {
        Some(b'a') => {
            memory.require_text(contents)?;
            return Ok(read_text(&text_of(contents))?);
        }
        Some(b'b') => {}
        _ => return Err("another beginning".to_owned().into()),
    }
    // Check the length, and split the heights from what follows them.
    let (head, rest) = binary_head(contents)?;
    let points = head.columns.checked_mul(head.rows);
    let needed = points.and_then(|points| points.checked_mul(head.data_type.bytes()));
    let Some((data, trailer)) = needed.and_then(|needed| rest.split_at_checked(needed)) else {
        let (Head { columns, rows, .. }, given) = (head, rest.len());
        return Err(format!("{given} bytes for {columns} × {rows} points").into());
    };
    memory.require_heights(points)?;
    let heights = data
        .chunks_exact(head.data_type.bytes())
        .map(|bytes| head.data_type.number(bytes))
        .collect();
    let mut surface = head.surface(heights);
    if !trailer.is_empty() {
        let bytes = trailer.len();
        surface
            .notes
            .push(format!("{bytes} bytes behind the heights were not read"));
    }
    Ok(surface)
}

/// Splits binary contents into the header and the bytes after it.
fn binary_head(contents: &[u8]) -> Result<(Head, &[u8]), String> {
    // Take the fields of the header one after the other: they have no names, and their order is fixed.
    let mut rest = contents
        .get(VERSION_BYTES + MANUFACTURER_AND_DATES_BYTES..)
        .ok_or("the end within the header")?;
    let mut take = |count: usize| {
        let bytes = rest.split_off(..count).ok_or("the end within the header")?;
        Ok::<_, String>(bytes)
    };
    // Counts have two bytes in the first version, and four in the second.
    let size = if contents[1..VERSION_BYTES].ends_with(b"2.0") {
        4
    } else {
        2
    };
    let mut count = || {
        let bytes = take(size)?;
        let count = bytes
            .iter()
            .rev()
            .fold(0, |count, byte| count << 8 | usize::from(*byte));
        Ok::<_, String>(count)
    };
    let [columns, rows] = [count()?, count()?];
    let mut real = || {
        let bytes = take(8)?;
        Ok::<_, String>(DataType::Double.number(bytes))
    };
    let [x, y, z, _resolution] = [real()?, real()?, real()?, real()?];
    let codes = take(3)?;
    let head = Head {
        columns,
        rows,
        scales: [x, y, z],
        data_type: DataType::of(codes[1].into())?,
    };
    Ok((head.validated(codes[0].into(), codes[2].into())?, rest))
}

/// Reads a text: a header of names and values, and heights between two stars, any number in a line.
fn read_text(text: &str) -> Result<Topography, String> {
    // Stars separate the header, the heights and the rest.
    let mut parts = text.split('*');
    let (header, data) = parts
        .next()
        .zip(parts.next())
        .ok_or("no '*' behind the header")?;
    let names = Entries(header);
    let head = Head {
        columns: names.parsed("NumPoints")?,
        rows: names.parsed("NumProfiles")?,
        scales: [
            names.parsed("Xscale")?,
            names.parsed("Yscale")?,
            names.parsed("Zscale")?,
        ],
        data_type: DataType::of(names.parsed("DataType")?)?,
    }
    .validated(names.parsed("Compression")?, names.parsed("CheckType")?)?;
    // Read the heights and check their number; the words bad and nan mark missing ones.
    let height = |word: &str| {
        if word.eq_ignore_ascii_case("bad") || word.eq_ignore_ascii_case("nan") {
            return Ok(f64::NAN);
        }
        let height = word
            .replace(',', ".")
            .parse::<f64>()
            .ok()
            .filter(|height| height.is_finite())
            .ok_or_else(|| format!("a height '{}'", shown(word)))?;
        Ok(head.data_type.nan_if_missing(height))
    };
    let heights = data
        .split_whitespace()
        .map(height)
        .collect::<Result<Vec<f64>, String>>()?;
    if head.columns.checked_mul(head.rows) != Some(heights.len()) {
        let (Head { columns, rows, .. }, count) = (head, heights.len());
        return Err(format!("{count} heights for {columns} × {rows} points"));
    }
    Ok(head.surface(heights))
}

/// Lines of the header, each with a name and a value.
struct Entries<'a>(&'a str);

impl Entries<'_> {
    /// The number behind a name, of which capitals do not matter; fails without it.
    fn parsed<N: FromStr>(&self, name: &str) -> Result<N, String> {
        let mut pairs = self.0.lines().filter_map(|line| line.split_once('='));
        let found = pairs.find(|(key, _)| key.trim().eq_ignore_ascii_case(name));
        let (_, value) = found.ok_or_else(|| format!("no {name}"))?;
        let decimal = value.trim().replace(',', ".");
        decimal
            .parse()
            .map_err(|_| format!("{name} = {}", shown(&decimal)))
    }
}
