//! One table: its columns with their units, and its rows.

use super::columns::Quantity::{
    self, Frequency, Loss, LossFactor, Relaxation, Set, Storage, Temperature, Time,
};
use super::columns::{NAMES, divided, known};
use super::isotherms::Row;
use super::layout::is_comment;
use super::{Deformation, Source, shown};
use crate::WrongInput;

type Result<T, E = WrongInput> = std::result::Result<T, E>;

/// A line that is not empty.
#[derive(Debug)]
pub(super) struct Line<'a> {
    /// Counted from 1.
    pub(super) number: usize,
    pub(super) text: &'a str,
    pub(super) cells: Vec<&'a str>,
}

impl Line<'_> {
    pub(super) fn is_empty(&self) -> bool {
        self.cells.iter().all(|cell| cell.is_empty())
    }
}

/// A column with a known name.
#[derive(Debug)]
pub(super) struct Column<'a> {
    quantity: Quantity,
    deformation: Option<Deformation>,
    name: &'a str,
    place: usize,
    unit: &'a str,
    /// To SI and to shear.
    factor: f64,
}

/// What all tables of a file have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kind {
    pub(super) is_relaxation: bool,
    /// Whether temperatures are in °C, where there are some.
    pub(super) celsius: Option<bool>,
}

/// The columns of a table.
#[derive(Debug)]
pub(super) struct Table<'a> {
    source: &'a Source<'a>,
    /// ω or t, and what the moduli follow from.
    needed: Vec<Quantity>,
    /// Those of needed quantities, temperature and set.
    columns: Vec<Column<'a>>,
    /// Lines of names and units.
    n_heads: usize,
}

/// Whether names are those of moduli over something else.
pub(super) fn is_head(columns: &[Column]) -> bool {
    let mut quantities = columns.iter().map(|column| column.quantity);
    columns.len() >= 2 && quantities.any(|one| one.is_modulus() || one == LossFactor)
}

/// What is needed of these columns; oscillation is measured over the time, too.
fn needed(columns: &[Column]) -> Vec<Quantity> {
    let has = |quantity| columns.iter().any(|column| column.quantity == quantity);
    match [Storage, Loss, LossFactor].map(has) {
        _ if has(Time) && (has(Relaxation) || !has(Frequency)) => vec![Time, Relaxation],
        [true, false, true] => vec![Frequency, Storage, LossFactor],
        [false, true, true] => vec![Frequency, Loss, LossFactor],
        _ => vec![Frequency, Storage, Loss],
    }
}

impl Source<'_> {
    pub(super) fn columns<'a>(&self, line: &Line<'a>) -> Vec<Column<'a>> {
        let names = self.layout.names(line.text).into_iter().enumerate();
        let columns = names.filter_map(|(place, name)| {
            let mut parts = divided(name);
            let (found, unit) = parts.find_map(|(name, unit)| Some((known(name)?, unit)))?;
            let (quantity, deformation, _) = *found;
            let deformation = deformation.or(self.options.deformation);
            Some(Column {
                quantity,
                deformation: deformation.filter(|_| quantity.is_modulus()),
                name,
                place,
                unit,
                factor: 1.0,
            })
        });
        columns.collect()
    }

    fn wrong(&self, line: usize, column: &Column, expected: &str, cell: &str) -> WrongInput {
        let [name, cell] = [column.name, cell].map(|text| shown(text, 40));
        let place = column.place + 1;
        let problem = format!("column {place} ({name}): expected {expected}, but found '{cell}'");
        WrongInput(format!("{}, line {line}, {problem}", self.file.display()))
    }
}

impl<'a> Table<'a> {
    /// The table of a block of lines that begins with the names.
    pub(super) fn new(source: &'a Source<'a>, block: &[Line<'a>]) -> Result<Self> {
        let head = &block[0];
        let mut columns = source.columns(head);
        let needed = needed(&columns);
        let has = |quantity: Quantity| columns.iter().any(|column| column.quantity == quantity);
        if let Some(missing) = needed.iter().find(|quantity| !has(**quantity)) {
            let [what, found] = [missing.usual(), &source.found(head)];
            let problem = format!("there must be a column {what}; the names are {NAMES}; {found}");
            return Err(source.wrong_line(head.number, &problem));
        }
        columns.retain(|column| {
            [Temperature, Set].contains(&column.quantity) || needed.contains(&column.quantity)
        });
        let mut table = Self {
            source,
            needed,
            columns,
            n_heads: 1,
        };
        table.check_names(head.number)?;
        table.read_units(block)?;
        Ok(table)
    }

    /// A frequency may be there in Hz and in rad/s, and the first one counts; everything else is there once.
    fn check_names(&self, line: usize) -> Result<()> {
        for column in &self.columns {
            let first = self.find(column.quantity);
            let is_again = first.is_some_and(|first| {
                first.place < column.place
                    && (first.quantity != Frequency || first.name == column.name)
            });
            let storage = self.find(Storage).filter(|_| column.quantity == Loss);
            let other = storage.filter(|storage| storage.deformation != column.deformation);
            let expected = match other {
                _ if is_again => "a quantity once, in tension (E) or in shear (G)",
                _ if column.quantity.is_modulus() && column.deformation.is_none() => {
                    "E (tension) or G (shear) in the name, or else the option deformation"
                }
                Some(storage) => &format!("a loss modulus to go with {}", shown(storage.name, 40)),
                None => continue,
            };
            return Err(self.source.wrong(line, column, expected, column.name));
        }
        Ok(())
    }

    /// Reads the units, which are in the names or in the line below.
    fn read_units(&mut self, block: &[Line<'a>]) -> Result<()> {
        let layout = self.source.layout;
        let is_open = |one: &Column| one.unit.is_empty() && one.quantity.unit("").is_none();
        let below = block.get(1).filter(|_| self.columns.iter().any(is_open));
        self.n_heads += usize::from(below.is_some());
        let mut units = below.map_or(Vec::new(), |line| layout.names(line.text));
        if layout.is_blank() {
            // The first columns may be without.
            let missing = layout
                .names(block[0].text)
                .len()
                .saturating_sub(units.len());
            units.splice(0..0, vec![""; missing]);
        }
        for column in &mut self.columns {
            let mut line = &block[0];
            if let Some(below) = below.filter(|_| column.unit.is_empty()) {
                line = below;
                column.unit = units.get(column.place).copied().unwrap_or_default();
            }
            let Some((unit, factor)) = column.quantity.unit(column.unit) else {
                let known = column.quantity.units().iter().map(|(unit, _)| *unit);
                let known = known.collect::<Vec<_>>().join(", ");
                let expected = format!("the unit of {}: {known}", shown(column.name, 40));
                let source = self.source;
                return Err(source.wrong(line.number, column, &expected, column.unit));
            };
            let is_tension = column.deformation == Some(Deformation::Tension);
            let to_shear = [1.0, self.source.options.shear_per_tension][usize::from(is_tension)];
            column.unit = unit;
            column.factor = factor * to_shear;
        }
        Ok(())
    }

    fn find(&self, quantity: Quantity) -> Option<&Column<'a>> {
        let mut columns = self.columns.iter();
        columns.find(|column| column.quantity == quantity)
    }

    pub(super) fn kind(&self) -> Kind {
        let temperature = self.find(Temperature);
        Kind {
            is_relaxation: self.needed[0] == Time,
            celsius: temperature.map(|column| column.unit != "K"),
        }
    }

    /// The lines of measurements in its block; what introduces a next table stands at the end.
    pub(super) fn rows<'b>(&self, block: &'b [Line<'a>], is_last: bool) -> Vec<&'b Line<'a>> {
        let lines = block[self.n_heads..].iter();
        let mut lines: Vec<&Line> = lines.filter(|line| !is_comment(line.text)).collect();
        let is_number = |line, one| {
            self.find(one)
                .is_some_and(|one| self.number(line, one).is_ok())
        };
        let n_numbers = |line| {
            let columns = self.needed.iter();
            columns.filter(|one| is_number(line, **one)).count()
        };
        while !is_last && lines.last().is_some_and(|line| n_numbers(*line) < 2) {
            lines.pop();
        }
        lines
    }

    pub(super) fn row(&self, line: &Line) -> Result<Row> {
        let columns = self.needed.iter().filter_map(|one| self.find(*one));
        let numbers = columns.map(|column| self.positive(line, column));
        let numbers: Vec<f64> = numbers.collect::<Result<_>>()?;
        let [first, last] = [numbers[1], numbers[numbers.len() - 1]];
        let moduli = match self.needed[1..] {
            [Storage, LossFactor] => [first, first * last],
            [Loss, LossFactor] => [first / last, first],
            _ => [first, last],
        };
        let optional = |quantity| {
            let column = self.find(quantity);
            column.map(|column| self.number(line, column)).transpose()
        };
        Ok(Row {
            line: line.number,
            at: numbers[0],
            moduli,
            temperature: optional(Temperature)?,
            set: optional(Set)?,
        })
    }

    /// What is wrong with a frequency or time.
    pub(super) fn wrong_first(&self, line: &Line, expected: &str) -> WrongInput {
        let first = self.find(self.needed[0]).unwrap_or(&self.columns[0]);
        self.wrong(line, first, expected)
    }
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

    fn number(&self, line: &Line, column: &Column) -> Result<f64> {
        let cell = line.cells.get(column.place);
        let number = cell.and_then(|cell| self.source.layout.number(cell));
        number.ok_or_else(|| self.wrong(line, column, "a finite number"))
    }

    fn wrong(&self, line: &Line, column: &Column, expected: &str) -> WrongInput {
        let cell = line.cells.get(column.place).copied().unwrap_or_default();
        self.source.wrong(line.number, column, expected, cell)
    }
}
