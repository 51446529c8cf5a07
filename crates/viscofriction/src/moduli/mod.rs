//! Tables of measured moduli, as instruments export them.
//!
//! [`measured_moduli`] goes from bytes to text (the encoding), from text to lines of cells (separator and decimal mark),
//! from a line of names to columns with units, and from the rows below to isotherms in SI.

mod columns;
mod isotherms;
mod layout;
mod table;

use std::fmt::Display;
use std::path::Path;

use numerics::in_range;
use rheology::InvalidParameter;
use rheology::fit::{Isotherm, ModulusPoint, RelaxationPoint};

use crate::WrongInput;
use columns::NAMES;
use isotherms::{Group, Row, insert};
use layout::{Layout, text_of};
use table::{Line, Table, is_head};

/// What was measured, in SI and in shear.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct MeasuredModuli {
    /// The moduli.
    pub measurements: Measurements,
    /// Whether temperatures are in °C, and not in K.
    pub celsius: bool,
}

/// Moduli over frequency or over time.
#[derive(Debug, Clone, PartialEq)]
pub enum Measurements {
    /// Isotherms in the order in which they begin in the table; without temperatures there is one, whose own means nothing.
    Oscillation(Vec<Isotherm>),
    /// Points at increasing times.
    Relaxation(Vec<RelaxationPoint>),
}

/// How a body was deformed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Deformation {
    /// In tension, compression or bending: the modulus is Young's, E.
    Tension,
    /// In shear: the modulus is G.
    Shear,
}

/// What a table does not say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableOptions {
    /// G/E, greater than 0; see [`shear_per_tension`].
    pub shear_per_tension: f64,
    /// What a "storage modulus" is that has neither E nor G in its name.
    pub deformation: Option<Deformation>,
}

/// G/E = 1/(2 (1 + ν)) at a constant Poisson ratio.
///
/// # Errors
/// When the Poisson ratio is not greater than −1 and at most 0.5.
pub fn shear_per_tension(poisson_ratio: f64) -> Result<f64, InvalidParameter> {
    let holds = poisson_ratio > -1.0 && poisson_ratio <= 0.5;
    let allowed = "greater than -1 and at most 0.5";
    in_range("poisson_ratio", poisson_ratio, holds, allowed)?;
    Ok(0.5 / (1.0 + poisson_ratio))
}

/// Reads the contents of a file, which need not be there: tables with a line of names each, among other text.
///
/// # Errors
/// [`WrongInput`] with file, line and column.
pub fn measured_moduli(
    file: &Path,
    contents: &[u8],
    options: &TableOptions,
) -> Result<MeasuredModuli, WrongInput> {
    let text = text_of(contents);
    let layout = Layout::of(text.lines());
    let lines = text.lines().enumerate().map(|(index, text)| Line {
        number: index + 1,
        text,
        cells: layout.cells(text),
    });
    let lines: Vec<Line> = lines.filter(|line| !line.is_empty()).collect();
    let source = Source {
        file,
        layout,
        options,
    };
    let is_head = |at: &usize| is_head(&source.columns(&lines[*at]));
    let heads: Vec<usize> = (0..lines.len()).filter(is_head).collect();
    let mut groups = Vec::new();
    let mut kind = None;
    for (nth, &head) in heads.iter().enumerate() {
        let next = heads.get(nth + 1);
        let block = &lines[head..next.copied().unwrap_or(lines.len())];
        let table = Table::new(&source, block)?;
        if *kind.get_or_insert(table.kind()) != table.kind() {
            let problem =
                "in all tables of a file the same must be measured, with temperatures in one unit";
            return Err(source.wrong_line(lines[head].number, &problem));
        }
        for line in table.rows(block, next.is_none()) {
            insert(&mut groups, table.row(line)?)
                .map_err(|problem| table.wrong_first(line, problem))?;
        }
    }
    let kind = kind.ok_or_else(|| source.without_head(&lines))?;
    source.enough(&groups, &lines)?;
    Ok(MeasuredModuli {
        measurements: source.measurements(groups, kind.is_relaxation)?,
        celsius: kind.celsius.unwrap_or_default(),
    })
}

/// Where a table comes from, and how it is read.
#[derive(Debug)]
struct Source<'a> {
    file: &'a Path,
    layout: Layout,
    options: &'a TableOptions,
}

impl Source<'_> {
    /// What is wrong with a whole line.
    fn wrong_line(&self, line: usize, problem: &dyn Display) -> WrongInput {
        WrongInput(format!("{}, line {line}: {problem}", self.file.display()))
    }

    /// The columns that were found, for messages.
    fn found(&self, line: &Line) -> String {
        let names = self.layout.names(line.text);
        let names = names.iter().map(|name| format!("'{}'", shown(name, 40)));
        let names = shown(&names.collect::<Vec<_>>().join(", "), 400);
        let separators = self.layout.separators();
        format!("separated by {separators}, the columns are {names}")
    }

    fn without_head(&self, lines: &[Line]) -> WrongInput {
        let needed = format!("a line of names is needed: {NAMES}");
        let several = lines.iter().find(|line| line.cells.len() > 1);
        let Some(line) = several.or(lines.first()) else {
            return self.wrong_line(1, &needed);
        };
        self.wrong_line(line.number, &format!("{needed}; {}", self.found(line)))
    }

    fn enough(&self, groups: &[Group], lines: &[Line]) -> Result<(), WrongInput> {
        let n_rows: usize = groups.iter().map(|group| group.rows.len()).sum();
        if n_rows >= 2 {
            return Ok(());
        }
        let last = lines.last().map_or(1, |line| line.number);
        let needed = "at least 2 measurements are needed after the names and units";
        Err(self.wrong_line(last, &format!("{needed}, but there are {n_rows}")))
    }

    fn measurements(
        &self,
        groups: Vec<Group>,
        is_relaxation: bool,
    ) -> Result<Measurements, WrongInput> {
        if !is_relaxation {
            let isotherms = groups.into_iter().map(isotherm).collect();
            return Ok(Measurements::Oscillation(isotherms));
        }
        if let Some(second) = groups.get(1) {
            let problem = "relaxation at several temperatures is not shifted: give a master curve";
            return Err(self.wrong_line(second.line, &problem));
        }
        let rows = groups
            .into_iter()
            .flat_map(|group| group.rows.into_values());
        let point = |Row { at, moduli, .. }: Row| RelaxationPoint {
            time: at,
            modulus: moduli[0],
        };
        Ok(Measurements::Relaxation(rows.map(point).collect()))
    }
}

fn isotherm(group: Group) -> Isotherm {
    let point = |Row { at, moduli, .. }: Row| ModulusPoint {
        angular_frequency: at,
        storage: moduli[0],
        loss: moduli[1],
    };
    Isotherm {
        temperature: group.temperatures.iter().sum::<f64>() / group.rows.len() as f64,
        points: group.rows.into_values().map(point).collect(),
    }
}

/// A cell as a part of one line; a quote that is never closed makes the rest of the line one cell.
fn shown(cell: &str, most: usize) -> String {
    let is_end = |(at, character): &(usize, char)| *at >= most || character.is_control();
    match cell.char_indices().find(is_end) {
        Some((end, _)) => format!("{}…", &cell[..end]),
        None => cell.to_owned(),
    }
}
