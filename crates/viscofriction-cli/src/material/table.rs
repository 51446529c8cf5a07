//! Measurements read from a file, or the place and the reason of the first cell that is wrong.

use std::fmt::Display;
use std::path::Path;

use csv::StringRecord;
use rheology::fit::{Isotherm, ModulusPoint, RelaxationPoint};
use viscofriction::{WrongInput, line_of_record};

use super::columns::{NAMES, Quantity};

type Result<T, E = WrongInput> = std::result::Result<T, E>;

/// A whole table, in SI and in shear.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) measurements: Measurements,
    /// Whether temperatures are in °C.
    pub(super) celsius: bool,
}

#[derive(Debug)]
pub(super) enum Measurements {
    Oscillation(Vec<Isotherm>),
    Relaxation(Vec<RelaxationPoint>),
}

/// Within an isotherm the temperature may drift by this much, \[K].
const DRIFT: f64 = 1.0;

impl Table {
    /// Reads the contents of a file; moduli in tension are multiplied by `shear_per_tension`.
    pub(super) fn read(file: &Path, contents: &[u8], shear_per_tension: f64) -> Result<Self> {
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(contents);
        let records: Result<Vec<StringRecord>, csv::Error> = reader.records().collect();
        let records = records.map_err(|error| {
            let line = line_of_record(contents, error.position());
            wrong_line(file, line, &error)
        })?;
        let [names, units, rows @ ..] = &records[..] else {
            let needed = "a line of names and a line of units are needed";
            return Err(wrong_line(file, 1, &needed));
        };
        let mut head = Head {
            file,
            contents,
            names,
            columns: Vec::new(),
        };
        for (place, name) in names.iter().enumerate() {
            if let Some(quantity) = Quantity::of(name) {
                let column = head.column(quantity, place, units, shear_per_tension)?;
                head.columns.push(column);
            }
        }
        if rows.len() < 2 {
            let last = records.last().map_or(1, |last| head.line(last));
            let needed = "at least 2 measurements are needed after the lines of names and units";
            let problem = format!("{needed}, but there are {}", rows.len());
            return Err(wrong_line(file, last, &problem));
        }
        let is_celsius = |column: &Column| units.get(column.place) != Some("K");
        Ok(Self {
            celsius: head.find(Quantity::Temperature).is_some_and(is_celsius),
            measurements: head.measurements(rows)?,
        })
    }
}

/// Where the quantities stand.
struct Head<'a> {
    file: &'a Path,
    contents: &'a [u8],
    names: &'a StringRecord,
    columns: Vec<Column>,
}

#[derive(Debug)]
struct Column {
    quantity: Quantity,
    is_tension: bool,
    place: usize,
    /// To SI and to shear.
    factor: f64,
}

/// Rows of one temperature.
struct Group {
    line: usize,
    temperatures: Vec<f64>,
    set: Option<f64>,
    /// Of each row what is increased, and the moduli.
    rows: Vec<Vec<f64>>,
}

impl Head<'_> {
    fn column(
        &self,
        quantity: Quantity,
        place: usize,
        units: &StringRecord,
        shear_per_tension: f64,
    ) -> Result<Column> {
        let name = &self.names[place];
        if self.find(quantity).is_some() {
            let once = "a quantity once, in tension (E) or in shear (G)";
            return Err(self.wrong(self.names, place, once));
        }
        let unit = units.get(place).unwrap_or_default();
        let Some((_, factor)) = quantity.units().iter().find(|(known, _)| *known == unit) else {
            let known: Vec<&str> = quantity.units().iter().map(|(unit, _)| *unit).collect();
            let expected = format!("the unit of {name}: {}", known.join(", "));
            return Err(self.wrong(units, place, &expected));
        };
        let is_tension = name.starts_with('E');
        Ok(Column {
            quantity,
            is_tension,
            place,
            factor: factor * if is_tension { shear_per_tension } else { 1.0 },
        })
    }

    fn measurements(&self, records: &[StringRecord]) -> Result<Measurements> {
        if self.find(Quantity::Time).is_some() {
            let groups = self.groups(records, &[Quantity::Time, Quantity::Relaxation])?;
            if let Some(second) = groups.get(1) {
                let problem =
                    "relaxation at several temperatures is not shifted: give a master curve";
                return Err(wrong_line(self.file, second.line, &problem));
            }
            let point = |row: Vec<f64>| RelaxationPoint {
                time: row[0],
                modulus: row[1],
            };
            let rows = groups.into_iter().flat_map(|group| group.rows);
            return Ok(Measurements::Relaxation(rows.map(point).collect()));
        }
        let quantities = [Quantity::Frequency, Quantity::Storage, Quantity::Loss];
        let [_, storage, loss] = quantities.map(|quantity| self.find(quantity));
        if let (Some(storage), Some(loss)) = (storage, loss)
            && storage.is_tension != loss.is_tension
        {
            let expected = format!("a loss modulus to go with {}", &self.names[storage.place]);
            return Err(self.wrong(self.names, loss.place, &expected));
        }
        let point = |row: Vec<f64>| ModulusPoint {
            angular_frequency: row[0],
            storage: row[1],
            loss: row[2],
        };
        let isotherm = |group: Group| Isotherm {
            temperature: group.temperatures.iter().sum::<f64>() / group.rows.len() as f64,
            points: group.rows.into_iter().map(point).collect(),
        };
        let groups = self.groups(records, &quantities)?;
        Ok(Measurements::Oscillation(
            groups.into_iter().map(isotherm).collect(),
        ))
    }

    /// The numbers of these quantities in all rows, by isotherms; within one the first quantity must increase.
    fn groups(&self, records: &[StringRecord], quantities: &[Quantity]) -> Result<Vec<Group>> {
        let needed = |quantity: &Quantity| {
            let what = quantity.usual();
            let problem = format!("there must be a column {what}; the names are {NAMES}");
            let column = self.find(*quantity);
            column.ok_or_else(|| wrong_line(self.file, 1, &problem))
        };
        let columns: Vec<&Column> = quantities.iter().map(needed).collect::<Result<_>>()?;
        let mut groups: Vec<Group> = Vec::new();
        for record in records {
            let numbers = columns.iter().map(|column| self.positive(record, column));
            let row: Vec<f64> = numbers.collect::<Result<_>>()?;
            let temperature = self.optional(record, Quantity::Temperature)?;
            let set = self.optional(record, Quantity::Set)?;
            match groups.last_mut() {
                Some(group) if group.has(temperature, set) => {
                    let before = group.rows.last().map_or(0.0, |last| last[0]);
                    if row[0] <= before {
                        let before = before / columns[0].factor;
                        let expected = format!("more than in the line before, {before}");
                        return Err(self.wrong(record, columns[0].place, &expected));
                    }
                    group.temperatures.extend(temperature);
                    group.rows.push(row);
                }
                _ => groups.push(Group {
                    line: self.line(record),
                    temperatures: temperature.into_iter().collect(),
                    set,
                    rows: vec![row],
                }),
            }
        }
        Ok(groups)
    }

    fn find(&self, quantity: Quantity) -> Option<&Column> {
        let mut columns = self.columns.iter();
        columns.find(|column| column.quantity == quantity)
    }

    fn positive(&self, record: &StringRecord, column: &Column) -> Result<f64> {
        let number = self.number(record, column)?;
        let in_si = number * column.factor;
        if in_si > 0.0 && in_si.is_finite() {
            return Ok(in_si);
        }
        let expected = if number > 0.0 {
            "a number that is finite and greater than 0 in SI too"
        } else {
            "a number greater than 0"
        };
        Err(self.wrong(record, column.place, expected))
    }

    fn optional(&self, record: &StringRecord, quantity: Quantity) -> Result<Option<f64>> {
        let column = self.find(quantity);
        column.map(|column| self.number(record, column)).transpose()
    }

    fn number(&self, record: &StringRecord, column: &Column) -> Result<f64> {
        let number = record.get(column.place).and_then(|cell| cell.parse().ok());
        let number = number.filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| self.wrong(record, column.place, "a finite number"))
    }

    fn wrong(&self, record: &StringRecord, place: usize, expected: &str) -> WrongInput {
        let line = self.line(record);
        let [name, cell] = [self.names, record].map(|record| record.get(place).unwrap_or_default());
        let (column, cell) = (place + 1, shown(cell));
        let file = self.file.display();
        WrongInput(format!(
            "{file}, line {line}, column {column} ({name}): expected {expected}, but found '{cell}'"
        ))
    }

    fn line(&self, record: &StringRecord) -> usize {
        line_of_record(self.contents, record.position())
    }
}

/// What is wrong with a whole line.
fn wrong_line(file: &Path, line: usize, problem: &dyn Display) -> WrongInput {
    WrongInput(format!("{}, line {line}: {problem}", file.display()))
}

impl Group {
    /// Whether a row of this temperature and number is of the isotherm.
    fn has(&self, temperature: Option<f64>, set: Option<f64>) -> bool {
        match (set, self.set, temperature, self.temperatures.first()) {
            (Some(set), Some(own), ..) => set.total_cmp(&own).is_eq(),
            (.., Some(temperature), Some(first)) => (temperature - first).abs() <= DRIFT,
            _ => true,
        }
    }
}

/// A cell as a part of one line; a quote that is never closed makes the rest of the file one cell.
fn shown(cell: &str) -> String {
    let is_end = |(at, character): &(usize, char)| *at >= 40 || character.is_control();
    match cell.char_indices().find(is_end) {
        Some((end, _)) => format!("{}…", &cell[..end]),
        None => cell.to_owned(),
    }
}
