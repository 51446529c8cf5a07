//! One row of a sweep, with a checksum that detects a changed cell.

use thiserror::Error;

use super::plan::Plan;

/// Name of the checksum column, which follows the values of a point.
const CHECK: &str = "check";
/// Names of the columns that a row is checked by: the checksum of all other cells, and the program.
pub(super) const CHECKS: [&str; 2] = [CHECK, "program"];
/// Name and version of the program in each row.
const PROGRAM: &str = concat!("viscofriction ", env!("CARGO_PKG_VERSION"));

/// Reason why a row is rejected.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RowError {
    /// The row has no checksum.
    #[error(
        "the column `check` has no check of the answers, which older versions of this program did not write; compute the sweep \
         anew"
    )]
    NoCheck,
    /// One cell was changed.
    #[error("column {number}, {column}, is {found:?}, and not what was computed")]
    Cell {
        /// Name of the column.
        column: String,
        /// Number of the column, counted from 1.
        number: usize,
        /// Contents of the changed cell.
        found: String,
    },
    /// Several cells or the checksum were changed.
    #[error(
        "the row is not what was computed: several cells were changed, as a spreadsheet rounds them, or the check itself"
    )]
    Cells,
    /// The row was computed by another version of the program.
    #[error("the row was computed by {found}, and this is {PROGRAM}")]
    Program {
        /// Name and version of that program.
        found: String,
    },
}

/// One row of a sweep: the point and its results. Run times are left out, because they differ from run to run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SweepRow {
    /// Index of the point, counted from 0.
    pub point: usize,
    /// Cells in the order of the [`header`](super::header).
    pub fields: Vec<String>,
}

impl SweepRow {
    /// The row of a point from its [`identity`](Plan::identity) and its results, with the checksum.
    pub(super) fn new(plan: &Plan, point: usize, results: Vec<String>) -> Self {
        let mut fields = plan.identity(point);
        let check = fields.len();
        fields.extend([String::new(), PROGRAM.to_owned()]);
        fields.extend(results);
        fields[check] = checksum_text(checksum(&super::header(plan), &fields));
        Self { point, fields }
    }

    /// Rejects a row with a changed cell, and a row of another version of the program.
    ///
    /// Numbers are compared by value, so their notation may differ.
    ///
    /// # Errors
    /// [`RowError`], with the column if a single cell was changed.
    pub fn check(&self, header: &[String]) -> Result<(), RowError> {
        let place = header.iter().position(|name| name == CHECK);
        let cell = place.and_then(|place| self.fields.get(place));
        let expected = cell
            .and_then(|cell| parse_checksum(cell))
            .ok_or(RowError::NoCheck)?;
        let found = checksum(header, &self.fields);
        if found != expected {
            return Err(self.changed(header, expected, found));
        }
        let program = place.and_then(|place| self.fields.get(place + 1));
        match program {
            Some(program) if program == PROGRAM => Ok(()),
            program => Err(RowError::Program {
                found: program.cloned().unwrap_or_default(),
            }),
        }
    }

    /// The error for a row whose checksum is `found` instead of `expected`. A single changed cell n changes the two sums by d
    /// and n d, so that n is the factor between their changes.
    fn changed(&self, header: &[String], expected: [u64; 2], found: [u64; 2]) -> RowError {
        let [plain, weighted] = [0, 1].map(|sum| found[sum].wrapping_sub(expected[sum]));
        let explains = |number: &usize| plain.wrapping_mul(*number as u64) == weighted;
        match (1..=header.len()).find(explains) {
            Some(number) if plain != 0 => RowError::Cell {
                column: header[number - 1].clone(),
                number,
                found: self.fields.get(number - 1).cloned().unwrap_or_default(),
            },
            _ => RowError::Cells,
        }
    }

    /// True if the request was not met.
    pub fn failed(&self) -> bool {
        self.fields.last().is_some_and(|why| !why.is_empty())
    }

    /// Warnings of the answer.
    pub fn warnings(&self) -> Vec<&str> {
        let before = self.fields.len().checked_sub(2);
        let cell = before.map_or("", |place| &self.fields[place]);
        let sentences = cell.split(BETWEEN_WARNINGS);
        sentences.filter(|sentence| !sentence.is_empty()).collect()
    }
}

/// Separator of the sentences in a cell.
pub(super) const BETWEEN_WARNINGS: &str = " | ";

/// Canonical form of a cell for comparison: numbers and truth values by value, whichever program wrote them.
pub(super) fn canonical(cell: &str) -> String {
    let number = cell.trim().parse::<f64>().ok();
    match number.filter(|number| number.is_finite()) {
        // Adding 0 turns −0 into 0, so that equal numbers have equal texts.
        Some(number) => format!("{:?}", number + 0.0),
        None if ["true", "false"].contains(&&*cell.to_lowercase()) => cell.to_lowercase(),
        None => cell.to_owned(),
    }
}

/// Sums of hₙ and of n hₙ over the cells n = 1, 2, … of a row, modulo 2⁶⁴, without the checksum. The hash hₙ includes the name of
/// the column. A change of one cell changes the sums by d and n d, which determines n.
fn checksum(header: &[String], fields: &[String]) -> [u64; 2] {
    let mut sums = [0_u64; 2];
    for (index, cell) in fields.iter().enumerate() {
        let name = header.get(index).map_or("", String::as_str);
        if name != CHECK {
            let hash = hashed(hashed(EMPTY_HASH, name.as_bytes()), b"=");
            let hash = hashed(hash, canonical(cell).as_bytes());
            let number = index as u64 + 1;
            sums[0] = sums[0].wrapping_add(hash);
            sums[1] = sums[1].wrapping_add(hash.wrapping_mul(number));
        }
    }
    sums
}

/// Prefix of a hash in a cell. Without it some hashes look like numbers (as 1e5), which spreadsheets reformat.
const NO_NUMBER: char = 'x';

/// A hash as the text of a cell: the prefix and 16 hexadecimal digits.
pub(super) fn hash_text(hash: u64) -> String {
    format!("{NO_NUMBER}{hash:016x}")
}

/// Both sums as the text of the checksum cell.
fn checksum_text([plain, weighted]: [u64; 2]) -> String {
    format!("{}{weighted:016x}", hash_text(plain))
}

/// Both sums from a checksum cell; `None` if it is malformed.
fn parse_checksum(check: &str) -> Option<[u64; 2]> {
    let digits = check.strip_prefix(NO_NUMBER)?;
    let (plain, weighted) = digits.split_at_checked(16)?;
    let number = |digits| u64::from_str_radix(digits, 16).ok();
    Some([number(plain)?, number(weighted)?])
}

/// FNV-1a hash of no bytes, 64 bits (offset basis of the algorithm).
pub(super) const EMPTY_HASH: u64 = 0xcbf2_9ce4_8422_2325;

/// Continues a FNV-1a hash with more bytes.
pub(super) fn hashed(before: u64, more: &[u8]) -> u64 {
    more.iter().fold(before, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header() -> Vec<String> {
        let names = [
            "sweep",
            "point",
            "points",
            "load.velocity",
            CHECK,
            "program",
            "friction",
            "depth",
        ];
        names.map(str::to_owned).to_vec()
    }

    /// A row of a version of the program, with its checksum.
    fn row(program: &str) -> SweepRow {
        let cells = [
            "x12",
            "1",
            "2",
            "1e-3",
            "",
            program,
            "0.018260853751863163",
            "true",
        ];
        let mut fields = cells.map(str::to_owned).to_vec();
        fields[4] = checksum_text(checksum(&header(), &fields));
        SweepRow { point: 0, fields }
    }

    #[test]
    fn the_cell_that_was_changed_is_named() {
        for index in [0, 1, 2, 3, 5, 6, 7] {
            for found in ["", "nan", "7.5", "text"] {
                let mut changed = row(PROGRAM);
                changed.fields[index] = found.to_owned();
                let cell = RowError::Cell {
                    column: header()[index].clone(),
                    number: index + 1,
                    found: found.to_owned(),
                };
                assert_eq!(changed.check(&header()), Err(cell));
            }
        }
    }

    #[test]
    fn cells_that_were_exchanged_or_renamed_are_noticed() {
        let mut exchanged = row(PROGRAM);
        exchanged.fields.swap(6, 7);
        assert_eq!(exchanged.check(&header()), Err(RowError::Cells));
        let mut names = header();
        names.swap(6, 7);
        assert_eq!(row(PROGRAM).check(&names), Err(RowError::Cells));
        let mut unchecked = row(PROGRAM);
        unchecked.fields[4] = "3fe9e164d0f51dd8".to_owned();
        assert_eq!(unchecked.check(&header()), Err(RowError::NoCheck));
    }

    #[test]
    fn a_number_may_be_written_otherwise() {
        let mut same = row(PROGRAM);
        for (index, cell) in [
            (1, "1.0"),
            (3, "0.001"),
            (6, "1.8260853751863163E-02"),
            (7, "TRUE"),
        ] {
            same.fields[index] = cell.to_owned();
        }
        assert_eq!(same.check(&header()), Ok(()));
    }

    #[test]
    fn a_row_of_another_version_is_refused_by_its_name() {
        let found = "viscofriction 0.0.1".to_owned();
        let refused = row(&found).check(&header());
        assert_eq!(refused, Err(RowError::Program { found }));
    }
}
