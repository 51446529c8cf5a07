//! Measurements read from a file, or the place and the reason of the first cell that is wrong.

use std::path::Path;

use csv::StringRecord;
use rheology::fit::{ModulusPoint, RelaxationPoint};

use super::columns::{Deformation, NAMES, Quantity, quantity};
use viscofriction::{WrongInput, line_of_record};

/// A whole table, in SI and in shear.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) measurements: Measurements,
    /// Whether temperatures are in °C.
    pub(super) celsius: bool,
}

/// The rows of a table.
#[derive(Debug)]
pub(super) enum Measurements {
    Oscillation(Vec<Row<ModulusPoint>>),
    Relaxation(Vec<Row<RelaxationPoint>>),
}

/// One measurement.
#[derive(Debug)]
pub(super) struct Row<P> {
    pub(super) point: P,
    pub(super) temperature: Option<f64>,
    /// Whether it is the first of an isotherm.
    pub(super) starts_isotherm: bool,
}

/// Within an isotherm the temperature may drift by this much, \[K].
const DRIFT: f64 = 1.0;

impl Table {
    /// Reads the contents of a file; moduli in tension are multiplied by `shear_per_tension`.
    pub(super) fn read(
        file: &Path,
        contents: &[u8],
        shear_per_tension: f64,
    ) -> Result<Self, WrongInput> {
        let wrong = |error: csv::Error| {
            let line = line_of_record(contents, error.position());
            WrongInput(format!("{}, line {line}: {error}", file.display()))
        };
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(contents);
        let records: Vec<StringRecord> =
            reader.records().collect::<Result<_, _>>().map_err(wrong)?;
        let head = Head::read((file, contents), &records, shear_per_tension)?;
        let rows = records.get(2..).unwrap_or_default();
        if rows.len() < 2 {
            return Err(WrongInput(format!(
                "{}, line {}: at least 2 measurements are needed after the lines of names and units, but there are {}",
                file.display(),
                records.last().map_or(1, |last| head.line(last)),
                rows.len()
            )));
        }
        head.rows(rows)
    }
}

/// Where the quantities stand, and their factors to SI.
struct Head<'a> {
    file: &'a Path,
    contents: &'a [u8],
    names: &'a StringRecord,
    columns: Vec<Column>,
    celsius: bool,
}

#[derive(Debug, Clone, Copy)]
struct Column {
    quantity: Quantity,
    place: usize,
    factor: f64,
}

impl<'a> Head<'a> {
    fn read(
        (file, contents): (&'a Path, &'a [u8]),
        records: &'a [StringRecord],
        shear_per_tension: f64,
    ) -> Result<Self, WrongInput> {
        let (Some(names), Some(units)) = (records.first(), records.get(1)) else {
            return Err(WrongInput(format!(
                "{}, line 1: a line of names and a line of units are needed",
                file.display()
            )));
        };
        let mut head = Self {
            file,
            contents,
            names,
            columns: Vec::new(),
            celsius: false,
        };
        for (place, name) in names.iter().enumerate() {
            if let Some(quantity) = quantity(name) {
                head.add(quantity, place, units)?;
            }
        }
        for column in &mut head.columns {
            if column.quantity.deformation() == Some(Deformation::Tension) {
                column.factor *= shear_per_tension;
            }
        }
        Ok(head)
    }

    fn add(
        &mut self,
        quantity: Quantity,
        place: usize,
        units: &StringRecord,
    ) -> Result<(), WrongInput> {
        if self
            .columns
            .iter()
            .any(|column| column.quantity == quantity)
        {
            return Err(self.wrong(self.names, place, "a quantity once", &self.names[place]));
        }
        let unit = units.get(place).unwrap_or_default();
        let Some(factor) = quantity.factor(unit) else {
            let expected = format!("the unit of {}: {}", &self.names[place], quantity.units());
            return Err(self.wrong(units, place, &expected, unit));
        };
        self.celsius |= quantity == Quantity::Temperature && unit != "K";
        self.columns.push(Column {
            quantity,
            place,
            factor,
        });
        Ok(())
    }

    fn rows(&self, records: &[StringRecord]) -> Result<Table, WrongInput> {
        let measurements = if self.find(Quantity::Time).is_some() {
            let time = self.needed(Quantity::Time)?;
            let modulus = self.one_of(Quantity::Relaxation)?;
            let point = |record: &StringRecord| {
                Ok(RelaxationPoint {
                    time: self.positive(record, time)?,
                    modulus: self.positive(record, modulus)?,
                })
            };
            Measurements::Relaxation(self.isotherms(records, time, point)?)
        } else {
            let frequency = self.needed(Quantity::Frequency)?;
            let storage = self.one_of(Quantity::Storage)?;
            let loss = self.one_of(Quantity::Loss)?;
            self.same_deformation(storage, loss)?;
            let point = |record: &StringRecord| {
                Ok(ModulusPoint {
                    angular_frequency: self.positive(record, frequency)?,
                    storage: self.positive(record, storage)?,
                    loss: self.positive(record, loss)?,
                })
            };
            Measurements::Oscillation(self.isotherms(records, frequency, point)?)
        };
        Ok(Table {
            measurements,
            celsius: self.celsius,
        })
    }

    /// Reads all rows and finds where a new isotherm begins; within one the `running` quantity must increase.
    fn isotherms<P>(
        &self,
        records: &[StringRecord],
        running: Column,
        point: impl Fn(&StringRecord) -> Result<P, WrongInput>,
    ) -> Result<Vec<Row<P>>, WrongInput> {
        let mut rows = Vec::with_capacity(records.len());
        let mut last: Option<Last> = None;
        for record in records {
            let point = point(record)?;
            let now = Last {
                value: self.positive(record, running)?,
                temperature: self.optional(record, Quantity::Temperature)?,
                set: self.optional(record, Quantity::Set)?,
            };
            let starts_isotherm = last
                .as_ref()
                .is_none_or(|last| now.starts_isotherm_after(last));
            if let Some(last) = last
                .as_ref()
                .filter(|last| !starts_isotherm && now.value <= last.value)
            {
                let before = last.value / running.factor;
                let expected = format!("more than in the line before, {before}");
                return Err(self.wrong(record, running.place, &expected, &record[running.place]));
            }
            rows.push(Row {
                point,
                temperature: now.temperature,
                starts_isotherm,
            });
            let first_temperature = last
                .filter(|_| !starts_isotherm)
                .and_then(|last| last.temperature);
            last = Some(Last {
                temperature: first_temperature.or(now.temperature),
                ..now
            });
        }
        Ok(rows)
    }

    fn find(&self, quantity: Quantity) -> Option<Column> {
        self.columns
            .iter()
            .copied()
            .find(|column| column.quantity == quantity)
    }

    fn needed(&self, quantity: Quantity) -> Result<Column, WrongInput> {
        self.find(quantity).ok_or_else(|| self.missing(quantity))
    }

    /// The column of a modulus, in tension or in shear.
    fn one_of(&self, quantity: fn(Deformation) -> Quantity) -> Result<Column, WrongInput> {
        let both = [Deformation::Tension, Deformation::Shear].map(|d| self.find(quantity(d)));
        match both {
            [Some(tension), Some(_)] => Err(self.wrong(
                self.names,
                tension.place,
                "either moduli in tension (E) or in shear (G)",
                &self.names[tension.place],
            )),
            [Some(column), None] | [None, Some(column)] => Ok(column),
            [None, None] => Err(self.missing(quantity(Deformation::Shear))),
        }
    }

    fn same_deformation(&self, storage: Column, loss: Column) -> Result<(), WrongInput> {
        if storage.quantity.deformation() == loss.quantity.deformation() {
            return Ok(());
        }
        let expected = format!("a loss modulus to go with {}", &self.names[storage.place]);
        Err(self.wrong(self.names, loss.place, &expected, &self.names[loss.place]))
    }

    fn positive(&self, record: &StringRecord, column: Column) -> Result<f64, WrongInput> {
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
        Err(self.wrong(record, column.place, expected, &record[column.place]))
    }

    fn optional(
        &self,
        record: &StringRecord,
        quantity: Quantity,
    ) -> Result<Option<f64>, WrongInput> {
        self.find(quantity)
            .map(|column| self.number(record, column))
            .transpose()
    }

    fn number(&self, record: &StringRecord, column: Column) -> Result<f64, WrongInput> {
        let cell = record.get(column.place).unwrap_or_default();
        let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| self.wrong(record, column.place, "a finite number", cell))
    }

    fn missing(&self, quantity: Quantity) -> WrongInput {
        let what = match quantity {
            Quantity::Frequency => "f or ω",
            Quantity::Storage(_) => "E' or G'",
            Quantity::Loss(_) => "E'' or G''",
            Quantity::Relaxation(_) => "E_relax or G_relax",
            Quantity::Time => "t",
            Quantity::Temperature => "T",
            Quantity::Set => "Set",
        };
        WrongInput(format!(
            "{}, line 1: there must be a column {what}; the names are {NAMES}",
            self.file.display()
        ))
    }

    fn wrong(&self, record: &StringRecord, place: usize, expected: &str, got: &str) -> WrongInput {
        let line = self.line(record);
        let name = self.names.get(place).unwrap_or_default();
        WrongInput(format!(
            "{}, line {line}, column {} ({name}): expected {expected}, but found '{}'",
            self.file.display(),
            place + 1,
            shown(got)
        ))
    }

    fn line(&self, record: &StringRecord) -> usize {
        line_of_record(self.contents, record.position())
    }
}

/// A cell as a part of one line; a quote that is never closed makes the rest of the file one cell.
fn shown(cell: &str) -> String {
    match cell
        .char_indices()
        .find(|(at, character)| *at >= 40 || character.is_control())
    {
        Some((end, _)) => format!("{}…", &cell[..end]),
        None => cell.to_owned(),
    }
}

/// What the rows so far say about the isotherm that the next one may belong to.
struct Last {
    value: f64,
    /// Of the first row of the isotherm.
    temperature: Option<f64>,
    set: Option<f64>,
}

impl Last {
    fn starts_isotherm_after(&self, last: &Self) -> bool {
        match (self.set, last.set, self.temperature, last.temperature) {
            (Some(set), Some(before), ..) => set.total_cmp(&before).is_ne(),
            (.., Some(temperature), Some(first)) => (temperature - first).abs() > DRIFT,
            _ => false,
        }
    }
}

impl Quantity {
    const fn deformation(self) -> Option<Deformation> {
        match self {
            Self::Storage(deformation)
            | Self::Loss(deformation)
            | Self::Relaxation(deformation) => Some(deformation),
            Self::Frequency | Self::Time | Self::Temperature | Self::Set => None,
        }
    }
}
