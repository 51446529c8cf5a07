//! Reader of tables as instruments export them.
//!
//! Four steps: bytes to text (encoding), text to lines of cells (separator and decimal mark), a line of names to columns with
//! units, and the rows below to numbers in SI.

mod cells;
mod choice;
mod columns;
mod layout;

use std::cmp::Reverse;
use std::fmt::Display;
use std::path::Path;

use rheology::KELVIN_AT_ZERO_CELSIUS;

use crate::MeasurementError;
use crate::friction::FRICTION;
use crate::indentation::CURVES;
use crate::moduli::MODULI;
use crate::shear::SHEAR;
use crate::strain::SWEEP as STRAIN;
use Quantity::{Frequency, Loss, Storage};
use choice::{retain_first, retain_half};
pub(crate) use columns::{Half, Quantity, Vocabulary};
use columns::{half_of, split_underscores, split_unit};
use layout::{Layout, is_comment, tagged};

/// Number of lines by which the kind of a file is recognised. Chosen: it limits the time for long files.
const LINES_OF_HEAD: usize = 100;
/// Kinds of tables, each with its meaning.
static KINDS: [(&Vocabulary, &str); 5] = [
    (&MODULI, "moduli"),
    (&FRICTION, "measured friction"),
    (&SHEAR, "shear strengths"),
    (&STRAIN, "factors of the moduli over the strain"),
    (&CURVES, "depth and force"),
];

type Result<T, E = MeasurementError> = std::result::Result<T, E>;

pub(crate) use layout::text_of;

/// Deformation of the sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Deformation {
    /// Tension, compression or bending: the modulus is Young's modulus E.
    Tension,
    /// Shear: the modulus is the shear modulus G.
    Shear,
}

/// The text of a file with its layout and vocabulary.
pub(crate) struct Source<'a> {
    /// Path for messages.
    file: &'a Path,
    /// Separator and decimal mark.
    layout: Layout,
    /// Names of the quantities.
    vocabulary: &'static Vocabulary,
    meaning: Meaning<'a>,
    /// Lines that are not empty.
    lines: Vec<Line<'a>>,
}

/// Meaning of columns that their names do not state.
pub(crate) struct Meaning<'a> {
    /// Deformation of moduli with neither E nor G in their names.
    pub(crate) deformation: Option<Deformation>,
    /// Factor on the numbers of a column in SI.
    pub(crate) scale: &'a dyn Fn(&Column) -> f64,
}

/// A line that is not empty.
pub(crate) struct Line<'a> {
    /// Line number, which counts from 1.
    pub(crate) number: usize,
    pub(crate) text: &'a str,
    pub(crate) cells: Vec<&'a str>,
}

/// A column with a known name.
pub(crate) struct Column<'a> {
    /// Quantity of its numbers.
    pub(crate) quantity: Quantity,
    pub(crate) deformation: Option<Deformation>,
    pub(crate) name: &'a str,
    /// Index of the column, counted from 0.
    place: usize,
    /// Index of its name in the vocabulary.
    order: usize,
    pub(crate) unit: &'a str,
    /// Factor to SI, including that of the meaning.
    factor: f64,
}

/// The columns of a table.
pub(crate) struct Table<'a> {
    source: &'a Source<'a>,
    /// Line number of the names.
    pub(crate) line: usize,
    /// Needed quantities, ω or t first.
    pub(crate) needed: Vec<Quantity>,
    /// Columns of needed and optional quantities.
    columns: Vec<Column<'a>>,
    /// Number of lines of names and units.
    n_heads: usize,
    /// Half of a ramp; `None` if the halves are not marked.
    pub(crate) half: Option<Half>,
    /// Names of known columns that are not read.
    pub(crate) left_out: Vec<&'a str>,
}

impl<'a> Source<'a> {
    /// Source of a text; empty lines are dropped.
    pub(crate) fn new(
        file: &'a Path,
        text: &'a str,
        vocabulary: &'static Vocabulary,
        meaning: Meaning<'a>,
    ) -> Self {
        let layout = Layout::of(text.lines());
        let lines = text.lines().enumerate().map(|(index, text)| Line {
            number: index + 1,
            text,
            cells: layout.cells(text),
        });
        let is_empty = |line: &Line| line.cells.iter().all(|cell| cell.is_empty());
        Self {
            file,
            layout,
            vocabulary,
            meaning,
            lines: lines.filter(|line| !is_empty(line)).collect(),
        }
    }

    /// All tables with their rows; each begins with a line of names and may be surrounded by other text.
    pub(crate) fn tables(&self) -> Result<Vec<(Table<'_>, Vec<&Line<'_>>)>> {
        let lines = &self.lines;
        let is_head = |at: &usize| {
            let columns = self.columns(&lines[*at]);
            (self.vocabulary.is_head)(&quantities(&columns))
        };
        let heads: Vec<usize> = (0..lines.len()).filter(is_head).collect();
        let ends = heads.iter().skip(1).copied().chain([lines.len()]);
        let blocks = heads.iter().zip(ends).map(|(&head, end)| &lines[head..end]);
        let blocks = blocks.flat_map(|block| {
            let columns = self.columns(&block[0]);
            let is_there = |half: &Half| columns.iter().any(|one| half_of(one.name) == Some(*half));
            let halves = [Half::Approach, Half::Retract].into_iter().filter(is_there);
            let halves: Vec<Option<Half>> = halves.map(Some).collect();
            let halves = if halves.is_empty() {
                vec![None]
            } else {
                halves
            };
            halves.into_iter().map(move |half| (block, half))
        });
        let tables = blocks.map(|(block, half)| {
            let table = Table::new(self, block, half)?;
            let is_last =
                block.last().map(|line| line.number) == lines.last().map(|line| line.number);
            let rows = table.rows(block, is_last);
            Ok((table, rows))
        });
        let tables: Vec<_> = tables.collect::<Result<_>>()?;
        if tables.is_empty() {
            return Err(self.without_head());
        }
        Ok(tables)
    }

    /// The columns of a line of names whose names are known, with the units in the names; their factors to SI are not known
    /// yet.
    fn columns<'b>(&self, line: &Line<'b>) -> Vec<Column<'b>> {
        self.columns_by(self.vocabulary, line)
    }

    /// The columns of a line of names by the names of a vocabulary.
    fn columns_by<'b>(&self, vocabulary: &Vocabulary, line: &Line<'b>) -> Vec<Column<'b>> {
        let names = self.layout.names(line.text).into_iter().enumerate();
        let columns = names.filter_map(|(place, name)| {
            if self.layout.number(name).is_some() {
                return None;
            }
            let meaning = |name| vocabulary.meaning(name);
            let mut parts = split_unit(name);
            let known = parts.find_map(|(name, unit)| Some((meaning(name)?, unit)));
            // Behind an underscore only a unit of the quantity is one: force_max is no force.
            let with_unit = |(name, unit): (_, &'b str)| {
                let found = meaning(name)?;
                let is_unit = vocabulary.known[found.0].0.unit(unit).is_some();
                (is_unit && unit.starts_with(char::is_alphabetic)).then_some((found, unit))
            };
            let (found, unit) = known.or_else(|| split_underscores(name).find_map(with_unit))?;
            let (order, deformation) = found;
            let quantity = vocabulary.known[order].0;
            // A name may be a unit, such as rpm.
            let is_unit = unit.is_empty() && quantity.unit("").is_none();
            let unit = if is_unit && quantity.unit(name).is_some() {
                name
            } else {
                unit
            };
            Some(Column {
                quantity,
                deformation: deformation
                    .or(self.meaning.deformation)
                    .filter(|_| quantity.is_modulus()),
                name,
                place,
                order,
                unit,
                factor: 1.0,
            })
        });
        columns.collect()
    }

    /// Error that names the file and a line, counted from 1, but no column.
    pub(crate) fn wrong_line(&self, line: usize, problem: &dyn Display) -> MeasurementError {
        MeasurementError::Table(format!("{}, line {line}: {problem}", self.file.display()))
    }

    /// Error for the whole text, at its last line.
    pub(crate) fn wrong_end(&self, problem: &dyn Display) -> MeasurementError {
        self.wrong_line(self.lines.last().map_or(1, |line| line.number), problem)
    }

    /// Resemblance to another kind of file, as the end of a message; empty if there is none.
    fn resemblance(&self) -> String {
        let first = || self.lines.iter().take(LINES_OF_HEAD);
        let is_number = |cell: &&str| cell.is_empty() || self.layout.number(cell).is_some();
        if first().all(|line| line.cells.iter().all(is_number)) {
            return "; these are numbers without names, as of a height map".to_owned();
        }
        // A line of names is that of a sweep, or has all columns of another kind of table.
        let kind = first().find_map(|line| {
            if line.cells.starts_with(&["sweep", "point"]) {
                return Some("results of a sweep");
            }
            let mut others =
                (KINDS.iter()).filter(|(other, _)| !std::ptr::eq(*other, self.vocabulary));
            let is_of = |vocabulary: &Vocabulary| {
                let known = quantities(&self.columns_by(vocabulary, line));
                let needed = (vocabulary.needed)(&known);
                (vocabulary.is_head)(&known) && needed.iter().all(|one| known.contains(one))
            };
            others
                .find(|(other, _)| is_of(other))
                .map(|(_, kind)| *kind)
        });
        kind.map_or(String::new(), |kind| format!("; this is a table of {kind}"))
    }

    /// List of the columns of a line, for messages.
    fn found(&self, line: &Line) -> String {
        let is_control = |letter: char| letter.is_control() && !letter.is_whitespace();
        let mut first = self.lines.iter().take(LINES_OF_HEAD);
        if first.any(|line| line.text.contains(is_control)) {
            return "the file is binary, as measured surfaces (x3p) and spreadsheets (xlsx) are, and no text".to_owned();
        }
        let names = self.layout.names(line.text);
        let quoted = names.iter().map(|name| format!("'{}'", shown(name, 40)));
        let list = shown(&quoted.collect::<Vec<_>>().join(", "), 400);
        let separators = self.layout.separators();
        let resemblance = self.resemblance();
        format!("separated by {separators}, the columns are {list}{resemblance}")
    }

    /// Error for a text without a line of names, at the line that is most similar to one.
    fn without_head(&self) -> MeasurementError {
        let needed = format!("a line of names is needed: {}", self.vocabulary.names);
        let is_number = |cell: &&&str| self.layout.number(cell).is_some();
        let is_row = |line: &Line| line.cells.iter().filter(is_number).count() > 1;
        let above = self.lines.iter().take_while(|line| !is_row(line));
        // The message shows the line with the most known names; among equals that with the most filled cells, then the first one.
        let rank = |line: &&Line| {
            let filled = line.cells.iter().filter(|cell| !cell.is_empty());
            Reverse([self.columns(line).len(), filled.count()])
        };
        let Some(line) = above.min_by_key(rank).or(self.lines.first()) else {
            return self.wrong_line(1, &needed);
        };
        self.wrong_line(line.number, &format!("{needed}; {}", self.found(line)))
    }

    /// Error for a cell of a column, with what was expected.
    fn wrong(&self, line: usize, column: &Column, expected: &str, cell: &str) -> MeasurementError {
        let [name, cell] = [column.shown(), shown(cell, 40)];
        let place = column.place + 1;
        let problem = format!("column {place} ({name}): expected {expected}, but found '{cell}'");
        MeasurementError::Table(format!("{}, line {line}, {problem}", self.file.display()))
    }
}

impl Column<'_> {
    /// Name of the column, shortened for messages.
    fn shown(&self) -> String {
        shown(self.name, 40)
    }
}

/// Quantities of columns, in their order.
fn quantities(columns: &[Column]) -> Vec<Quantity> {
    columns.iter().map(|column| column.quantity).collect()
}

/// The beginning of a cell for messages; an unclosed quote makes the rest of the line one cell.
fn shown(cell: &str, most: usize) -> String {
    let is_end = |(at, character): &(usize, char)| *at >= most || character.is_control();
    match cell.char_indices().find(is_end) {
        Some((end, _)) => format!("{}…", &cell[..end]),
        None => cell.to_owned(),
    }
}

impl<'a> Table<'a> {
    /// Table of a block of lines that begins with the names, with the columns of one half of a ramp.
    fn new(source: &'a Source<'a>, block: &[Line<'a>], half: Option<Half>) -> Result<Self> {
        let head = &block[0];
        let vocabulary = source.vocabulary;
        let mut columns = source.columns(head);
        retain_half(&mut columns, half);
        let known: Vec<(Quantity, &str)> =
            columns.iter().map(|one| (one.quantity, one.name)).collect();
        let quantities = quantities(&columns);
        let needed = (vocabulary.needed)(&quantities);
        if let Some(missing) = needed.iter().find(|one| !quantities.contains(one)) {
            let [what, names, found] = [missing.usual(), vocabulary.names, &source.found(head)];
            let problem = format!("there must be a column {what}; the names are {names}; {found}");
            return Err(source.wrong_line(head.number, &problem));
        }
        columns.retain(|column| {
            let quantity = &column.quantity;
            vocabulary.optional.contains(quantity) || needed.contains(quantity)
        });
        if vocabulary.has_order {
            retain_first(&mut columns);
        }
        let mut table = Self {
            source,
            line: head.number,
            needed,
            columns,
            n_heads: 1,
            half,
            left_out: Vec::new(),
        };
        let is_left_out = |name: &str| table.columns.iter().all(|one| one.name != name);
        let left_out = known
            .into_iter()
            .filter(|(quantity, name)| *quantity != Quantity::Other && is_left_out(name));
        table.left_out = left_out.map(|(_, name)| name).collect();
        table.check_names(head.number)?;
        table.read_units(block)?;
        Ok(table)
    }

    /// Refuses duplicate columns, and moduli of unknown or different deformations.
    ///
    /// A frequency may be given twice, in Hz and in rad/s; the first column is read.
    fn check_names(&self, line: usize) -> Result<()> {
        for column in &self.columns {
            let first = self.find(column.quantity);
            let is_again = first.is_some_and(|first| {
                let may_be_there = first.quantity == Frequency && first.name != column.name;
                first.place < column.place && !may_be_there
            });
            if let Some(first) = first.filter(|_| is_again) {
                return Err(self.twice(line, [first, column]));
            }
            let storage = self.find(Storage).filter(|_| column.quantity == Loss);
            let other = storage.filter(|storage| storage.deformation != column.deformation);
            let expected = match other {
                _ if column.quantity.is_modulus() && column.deformation.is_none() => {
                    "E (tension) or G (shear) in the name, or else --deformation tension or --deformation shear (in Python \
                     deformation=\"tension\" or \"shear\")"
                }
                Some(storage) => &format!("a loss modulus to go with {}", storage.shown()),
                None => continue,
            };
            return Err(self.source.wrong(line, column, expected, column.name));
        }
        Ok(())
    }

    /// Error for two columns of one quantity.
    fn twice(&self, line: usize, both: [&Column; 2]) -> MeasurementError {
        let [first, second] = both.map(|one| format!("{} ({})", one.place + 1, one.shown()));
        let quantity = both[0].quantity.usual();
        let file = self.source.file.display();
        MeasurementError::Table(format!(
            "{file}, line {line}, columns {first} and {second}: both are {quantity}; remove or rename the one that does not count"
        ))
    }

    /// Error for an option that has no effect because of these columns.
    pub(crate) fn without_effect(&self, option: &str, beside: &[&Column]) -> MeasurementError {
        let names: Vec<String> = beside
            .iter()
            .map(|one| format!("'{}'", one.shown()))
            .collect();
        let list = names.join(" and ");
        let problem = format!("{option} has no effect, because there is {list}: leave it out");
        self.source.wrong_line(self.line, &problem)
    }

    /// Reads the units in the names or in the line below, and sets the factors to SI. Refuses an unknown or missing unit.
    fn read_units(&mut self, block: &[Line<'a>]) -> Result<()> {
        let layout = self.source.layout;
        let is_open = |one: &Column| one.unit.is_empty() && one.quantity.unit("").is_none();
        let below = match tagged(block[0].text) {
            None => block.get(1),
            Some(_) => {
                let comments = block.iter().take_while(|line| is_comment(line.text));
                let mut units =
                    comments.filter(|line| matches!(tagged(line.text), Some(("units", _))));
                let needed = "a line '# units:' is needed below it";
                Some(
                    units
                        .next()
                        .ok_or_else(|| self.source.wrong_line(self.line, &needed))?,
                )
            }
        };
        let below = below.filter(|_| self.columns.iter().any(is_open));
        self.n_heads += usize::from(below.is_some());
        let mut units = below.map_or(Vec::new(), |line| layout.names(line.text));
        if layout.is_blank() {
            // If there are fewer units than names, the first columns are taken to have none.
            let n_names = layout.names(block[0].text).len();
            let missing = n_names.saturating_sub(units.len());
            units.splice(0..0, vec![""; missing]);
        }
        for column in &mut self.columns {
            let mut line = &block[0];
            if let Some(below) = below.filter(|_| column.unit.is_empty()) {
                line = below;
                column.unit = units.get(column.place).copied().unwrap_or_default();
            }
            let Some((unit, factor)) = column.quantity.unit(column.unit) else {
                let known = column.quantity.units().replace(' ', ", ");
                let (name, source) = (column.shown(), self.source);
                if layout.number(column.unit).is_some() {
                    let place = column.place + 1;
                    let problem = format!(
                        "column {place} ({name}) has no unit, in brackets behind its name or in the line below: {known}"
                    );
                    return Err(source.wrong_line(block[0].number, &problem));
                }
                let expected = format!("the unit of {name}: {known}");
                return Err(source.wrong(line.number, column, &expected, column.unit));
            };
            column.unit = unit;
            column.factor = factor * (self.source.meaning.scale)(column);
        }
        Ok(())
    }

    /// The first column of a quantity; `None` if the table has none.
    pub(crate) fn find(&self, quantity: Quantity) -> Option<&Column<'a>> {
        let mut columns = self.columns.iter();
        columns.find(|column| column.quantity == quantity)
    }

    /// Rows of measurements in a block; trailing lines that introduce the next table are dropped.
    fn rows<'b>(&self, block: &'b [Line<'a>], is_last: bool) -> Vec<&'b Line<'a>> {
        let lines = block[self.n_heads..].iter();
        let mut lines: Vec<&Line> = lines.filter(|line| !is_comment(line.text)).collect();
        let n_numbers = |line| {
            let columns = self.needed.iter().filter_map(|one| self.find(*one));
            columns.filter(|one| self.number(line, one).is_ok()).count()
        };
        while !is_last && lines.last().is_some_and(|line| n_numbers(*line) < 2) {
            lines.pop();
        }
        lines
    }

    /// Needed numbers of a line in SI, all greater than 0.
    pub(crate) fn positives(&self, line: &Line) -> Result<Vec<f64>> {
        let columns = self.needed.iter().filter_map(|one| self.find(*one));
        columns.map(|column| self.positive(line, column)).collect()
    }

    /// Needed numbers of a line in SI; NaN for a cell that is empty, infinite or NaN.
    pub(crate) fn numbers(&self, line: &Line) -> Result<Vec<f64>> {
        let columns = self.needed.iter().filter_map(|one| self.find(*one));
        let number = |column: &Column| {
            let cell = line.cells.get(column.place).copied().unwrap_or_default();
            let is_nothing = |number: f64| !number.is_finite();
            if cell.is_empty() || cell.parse().is_ok_and(is_nothing) {
                return Ok(f64::NAN);
            }
            Ok(self.number(line, column)? * column.factor)
        };
        columns.map(number).collect()
    }

    /// Optional number in its own unit; `None` without such a column.
    pub(crate) fn optional(&self, line: &Line, quantity: Quantity) -> Result<Option<f64>> {
        let column = self.find(quantity);
        column.map(|column| self.number(line, column)).transpose()
    }

    /// Temperature in its own unit; `None` without such a column.
    pub(crate) fn temperature(&self, line: &Line) -> Result<Option<f64>> {
        let Some(column) = self.find(Quantity::Temperature) else {
            return Ok(None);
        };
        let temperature = self.number(line, column)?;
        let zero = match column.unit {
            "K" => 0.0,
            _ => -KELVIN_AT_ZERO_CELSIUS,
        };
        if temperature > zero {
            Ok(Some(temperature))
        } else {
            Err(self.wrong(line, column, "a temperature above absolute zero"))
        }
    }

    /// Temperature in °C; `None` without such a column.
    pub(crate) fn celsius(&self, line: &Line) -> Result<Option<f64>> {
        let is_kelvin = self
            .find(Quantity::Temperature)
            .is_some_and(|column| column.unit == "K");
        let zero = if is_kelvin {
            KELVIN_AT_ZERO_CELSIUS
        } else {
            0.0
        };
        Ok(self
            .temperature(line)?
            .map(|temperature| temperature - zero))
    }

    /// Error in the cell of the frequency or the time of a line.
    pub(crate) fn wrong_first(&self, line: &Line, expected: &str) -> MeasurementError {
        let first = self.find(self.needed[0]).unwrap_or(&self.columns[0]);
        self.wrong(line, first, expected)
    }

    /// Number of a column in SI; an error unless it is greater than 0 and finite.
    fn positive(&self, line: &Line, column: &Column) -> Result<f64> {
        let number = self.number(line, column)?;
        let in_si = number * column.factor;
        if in_si > 0.0 && in_si.is_finite() {
            return Ok(in_si);
        }
        let expected = if number > 0.0 {
            "a number that is finite and greater than 0 in SI too"
        } else {
            "a number greater than 0"
        };
        Err(self.wrong(line, column, expected))
    }

    /// Number of a column in its own unit; an error for an empty cell and a text.
    fn number(&self, line: &Line, column: &Column) -> Result<f64> {
        let cell = line.cells.get(column.place);
        let number = cell.and_then(|cell| self.source.layout.number(cell));
        number.ok_or_else(|| self.wrong(line, column, "a finite number"))
    }

    /// Error for the cell of a column in a line, with what was expected.
    fn wrong(&self, line: &Line, column: &Column, expected: &str) -> MeasurementError {
        let cell = line.cells.get(column.place).copied().unwrap_or_default();
        self.source.wrong(line.number, column, expected, cell)
    }
}
