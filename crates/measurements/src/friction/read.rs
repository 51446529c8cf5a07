//! Reader of tables of measured friction over speed.

use std::path::Path;

use numerics::{not_negative, positive};

use super::FrictionPoint;
use super::runs::{self, Run};
use crate::MeasurementError;
use crate::moduli::Deformation;
use crate::table::Quantity::{
    self, Force, Friction, FrictionError, FrictionForce, Radius, Temperature, Time, Velocity,
};
use crate::table::{Line, Meaning, Source, Table, Vocabulary, text_of};

type Result<T> = std::result::Result<T, MeasurementError>;

/// Information that a table of friction does not contain.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FrictionTableOptions {
    /// Radius of the track > 0, \[m], for rotational speeds without a column of radii.
    pub track_radius: Option<f64>,
    /// Run-in time ≥ 0 that is excluded from the mean of every run at constant speed, \[s].
    pub run_in: Option<f64>,
}

/// A table of friction.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct FrictionTable {
    /// One point for each row, or for each run of a time series.
    pub points: Vec<FrictionPoint>,
    /// Notes on assumptions of the reader: signs, means of runs.
    pub notes: Vec<String>,
}

/// Names by which the columns of a table of friction are recognised, and the columns that it needs.
pub(crate) static FRICTION: Vocabulary = Vocabulary {
    names: "v (or rpm) and mu (or friction force and normal force), and perhaps t, T, normal force, track radius and standard error",
    known: &KNOWN_NAMES,
    is_head: |columns| {
        let is_friction = |one: &Quantity| [Friction, FrictionForce].contains(one);
        columns.len() > 1
            && columns
                .iter()
                .any(|one| is_friction(one) || *one == Velocity)
    },
    needed,
    optional: &[Temperature, Time, Radius],
    has_order: true,
};

/// Known names, without blanks, points, dashes, underscores and accents. Of several columns of a quantity the one whose name
/// comes first is read, so that speeds along the track precede rotational ones.
const KNOWN_NAMES: [(Quantity, Option<Deformation>, &str); 21] = [
    (Velocity, None, "v velocity speed geschwindigkeit vitesse"),
    (
        Velocity,
        None,
        "slidingvelocity slidingspeed linearspeed gleitgeschwindigkeit",
    ),
    (Velocity, None, "rollingvelocity rollingspeed"),
    (
        Velocity,
        None,
        "rpm rotationalspeed rotationspeed spindlespeed drehzahl",
    ),
    (Friction, None, "mu μ µ cof frictioncoefficient"),
    (
        Friction,
        None,
        "coefficientoffriction friction frictionfactor",
    ),
    (
        Friction,
        None,
        "rollingresistance rollingresistancecoefficient",
    ),
    (
        Friction,
        None,
        "reibungszahl reibungskoeffizient reibwert reibungszahlμ reibungszahlµ reibwertμ reibwertµ frictioncoefficientμ frictioncoefficientµ",
    ),
    (FrictionError, None, "standarderror muerror error stderr"),
    (
        FrictionError,
        None,
        "frictioncoefficienterror standarderrorofmu",
    ),
    (FrictionError, None, "frictionerror standardfehler"),
    (
        FrictionForce,
        None,
        "frictionforce tangentialforce lateralforce Ft Ff",
    ),
    (
        FrictionForce,
        None,
        "reibungskraft reibkraft tangentialkraft",
    ),
    (
        Force,
        None,
        "normalforce FN Fn load normalload normalkraft force",
    ),
    (Temperature, None, "T temp temperature temperatur"),
    (Temperature, None, "sampletemperature"),
    (Time, None, "t time zeit temps testtime"),
    (
        Radius,
        None,
        "radius trackradius weartrackradius bahnradius",
    ),
    (Radius, None, "testradius messradius"),
    (Quantity::Other, None, "index nr"),
    (Quantity::Other, None, "remark"),
];

/// The columns that every row must have, of a table with the given ones: speed, friction coefficient or both forces, and normal
/// force and standard error if there is a column of them.
fn needed(columns: &[Quantity]) -> Vec<Quantity> {
    let has = |quantity: &Quantity| columns.contains(quantity);
    let friction = if has(&FrictionForce) && !has(&Friction) {
        vec![FrictionForce, Force]
    } else {
        vec![Friction]
    };
    let others = [Force, FrictionError]
        .into_iter()
        .filter(|other| has(other) && !friction.contains(other));
    [vec![Velocity], friction.clone(), others.collect()].concat()
}

/// Reads a table of friction from the contents of a file; the path is used for messages only.
///
/// The table has a line of names and one row for each speed, or a time series of runs at constant speed, whose means are
/// taken. Speeds, coefficients, forces and errors are greater than 0. A force that is negative in nearly all rows has the
/// sign convention of its instrument; it is inverted, with a note.
///
/// # Errors
/// [`MeasurementError`] with file, line and column.
pub fn friction_points(
    file: &Path,
    contents: &[u8],
    options: &FrictionTableOptions,
) -> Result<FrictionTable> {
    if let Some(radius) = options.track_radius {
        positive("track_radius", radius)?;
    }
    not_negative("run_in", options.run_in.unwrap_or_default())?;
    let text = text_of(contents, &FRICTION);
    let meaning = Meaning {
        deformation: None,
        scale: &|_| 1.0,
    };
    let source = Source::new(file, &text, &FRICTION, meaning);
    let tables = source.tables()?;
    if let Some((second, _)) = tables.get(1) {
        let problem = "a second table begins here; put all rows below one line of names";
        return Err(source.wrong_line(second.line, &problem));
    }
    let (table, lines) = &tables[0];
    let mut notes = Vec::new();
    let rows = Rows::new(table, lines, options, &mut notes)?;
    let points = rows.points(options, &mut notes)?;
    let wrong = |problem| source.wrong_line(table.line, &problem);
    FrictionPoint::check_all(&points).map_err(wrong)?;
    Ok(FrictionTable { points, notes })
}

/// One row of the table, in SI units; `None` for a quantity without a column.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// Line in the file, from 1.
    pub(super) line: usize,
    /// Time, \[s].
    pub(super) time: Option<f64>,
    /// Speed along the track, \[m/s].
    pub(super) velocity: f64,
    /// Friction coefficient, or friction force \[N] if the table has forces.
    pub(super) friction: f64,
    /// Normal force, \[N].
    pub(super) normal_force: Option<f64>,
    /// Standard error of the friction coefficient.
    pub(super) standard_error: Option<f64>,
    /// Temperature, \[°C].
    pub(super) temperature: Option<f64>,
}

/// All rows of a table with their lines in the file.
struct Rows<'a> {
    table: &'a Table<'a>,
    lines: &'a [&'a Line<'a>],
    rows: Vec<Row>,
    /// Whether the friction of a row is a force.
    has_forces: bool,
}

/// Fraction of rows with a negative force from which the sign is a convention of the instrument, and the force is inverted.
/// Chosen: below 1, because noise turns the sign of small forces.
const NEGATIVE_SIGN_FRACTION: f64 = 0.9;

impl<'a> Rows<'a> {
    /// Converts all rows to SI units, rotational speeds by the radius of the track, and corrects the signs of forces.
    fn new(
        table: &'a Table<'a>,
        lines: &'a [&'a Line<'a>],
        options: &FrictionTableOptions,
        notes: &mut Vec<String>,
    ) -> Result<Self> {
        let has_forces = table.needed.contains(&FrictionForce);
        let friction = if has_forces { FrictionForce } else { Friction };
        let radius = track_radius(table, options)?;
        let row = |line: &&Line| {
            let speed = table.positive_of(line, Velocity)?.unwrap_or(f64::NAN);
            let radius = match radius {
                TrackRadius::Column => table.positive_of(line, Radius)?.unwrap_or(f64::NAN),
                TrackRadius::Given(radius) => radius,
                TrackRadius::NotNeeded => 1.0,
            };
            Ok(Row {
                line: line.number,
                time: table.in_si(line, Time)?,
                velocity: speed * radius,
                friction: table.in_si(line, friction)?.unwrap_or(f64::NAN),
                normal_force: table.in_si(line, Force)?,
                standard_error: table.positive_of(line, FrictionError)?,
                temperature: table.celsius(line)?,
            })
        };
        let rows = lines.iter().map(row).collect::<Result<Vec<Row>>>()?;
        let mut rows = Self {
            table,
            lines,
            rows,
            has_forces,
        };
        if has_forces {
            rows.correct_sign("friction force", |row| Some(&mut row.friction), notes);
        }
        rows.correct_sign("normal force", |row| row.normal_force.as_mut(), notes);
        Ok(rows)
    }

    /// Inverts a force, with a note, if it is negative in at least [`NEGATIVE_SIGN_FRACTION`] of the rows; `force` selects it
    /// in a row.
    fn correct_sign(
        &mut self,
        name: &str,
        force: impl Fn(&mut Row) -> Option<&mut f64>,
        notes: &mut Vec<String>,
    ) {
        let is_negative = |row: &mut Row| force(row).is_some_and(|force| *force < 0.0);
        let n_negative = self
            .rows
            .iter_mut()
            .filter_map(|row| is_negative(row).then_some(()))
            .count();
        if n_negative == 0 || (n_negative as f64) < NEGATIVE_SIGN_FRACTION * self.rows.len() as f64
        {
            return;
        }
        for row in &mut self.rows {
            if let Some(force) = force(row) {
                *force = -*force;
            }
        }
        notes.push(format!(
            "the {name} is negative in {n_negative} of {} rows, which is taken for the sign of the instrument",
            self.rows.len()
        ));
    }

    /// One point for each row, or for a time series with a run-in the mean of each run. Refuses runs of many rows without a
    /// run-in, and a run-in without such runs.
    fn points(
        &self,
        options: &FrictionTableOptions,
        notes: &mut Vec<String>,
    ) -> Result<Vec<FrictionPoint>> {
        let runs = runs::split(&self.rows);
        let longest = runs
            .iter()
            .max_by_key(|run| run.len())
            .filter(|run| run.len() >= runs::MIN_ROWS);
        match (options.run_in, longest) {
            (Some(run_in), Some(_)) => self.means(&runs, run_in, notes),
            (None, Some(run)) => Err(self.table.wrong_row(run[0].line, &without_run_in(run))),
            (Some(_), None) => {
                let problem = "a run-in has no effect, because the table has no run of at least ten rows at one speed with a \
                               column of time: leave it out";
                Err(self.table.wrong_row(self.table.line, &problem))
            }
            (None, None) => {
                let pairs = self.rows.iter().zip(self.lines);
                let points = pairs.map(|(row, line)| self.point(row, line));
                let points: Vec<FrictionPoint> = points.collect::<Result<_>>()?;
                self.check_forces(&points)?;
                Ok(points)
            }
        }
    }

    /// The point of one row. Refuses a force or a coefficient that is not greater than 0, and a coefficient above 10.
    fn point(&self, row: &Row, line: &Line) -> Result<FrictionPoint> {
        if row.normal_force.is_some_and(|force| force <= 0.0) {
            return Err(self.table.wrong_in(line, Force, "a number greater than 0"));
        }
        let friction = if self.has_forces {
            FrictionForce
        } else {
            Friction
        };
        let coefficient = match (self.has_forces, row.normal_force) {
            (true, Some(normal)) => row.friction / normal,
            _ => row.friction,
        };
        if coefficient <= 0.0 {
            let expected = "a number greater than 0";
            return Err(self.table.wrong_in(line, friction, expected));
        }
        if coefficient > FrictionPoint::LARGEST_COEFFICIENT {
            return Err(self.table.wrong_in(line, friction, self.expected_range()));
        }
        Ok(FrictionPoint {
            velocity: row.velocity,
            friction_coefficient: coefficient,
            standard_error: row.standard_error,
            temperature: row.temperature,
            normal_force: row.normal_force,
        })
    }

    /// What a message expects of a friction that is too large.
    const fn expected_range(&self) -> &'static str {
        if self.has_forces {
            "at most 10 times the normal force (are the columns of the two forces exchanged, or a unit wrong?)"
        } else {
            "a friction coefficient of at most 10 (in per cent the name is \"mu (%)\"; are columns exchanged?)"
        }
    }

    /// The mean of each run after its first `run_in` \[s], with notes on all runs. Standard errors are dropped if one run has
    /// none.
    fn means(
        &self,
        runs: &[&[Row]],
        run_in: f64,
        notes: &mut Vec<String>,
    ) -> Result<Vec<FrictionPoint>> {
        let mut points = Vec::new();
        notes.push(format!(
            "time series: {} rows are {} runs at constant speed, and the mean of each without its first {run_in} s is a point",
            self.rows.len(),
            runs.len()
        ));
        for rows in runs {
            let wrong = |problem: String| self.table.wrong_row(rows[0].line, &problem);
            let run = Run::new(rows, run_in, self.has_forces).map_err(wrong)?;
            let coefficient = run.point.friction_coefficient;
            if coefficient > FrictionPoint::LARGEST_COEFFICIENT {
                let expected = self.expected_range();
                return Err(wrong(format!(
                    "expected {expected}, but the mean friction of the run is {coefficient:.4}"
                )));
            }
            notes.push(run.to_string());
            points.push(run.point);
        }
        self.check_forces(&points)?;
        // If the error of one run is unknown, because its rows do not scatter, the errors of the others are dropped too.
        if points.iter().any(|point| point.standard_error.is_none()) {
            points
                .iter_mut()
                .for_each(|point| point.standard_error = None);
        }
        Ok(points)
    }

    /// Refuses exchanged forces: a normal force that is smaller than the friction at every point and varies more.
    fn check_forces(&self, points: &[FrictionPoint]) -> Result<()> {
        let is_above = |point: &FrictionPoint| point.friction_coefficient > 1.0;
        let forces = |of: fn(&FrictionPoint) -> f64| {
            let forces = points.iter().map(of);
            forces.clone().fold(0.0, f64::max) / forces.fold(f64::INFINITY, f64::min)
        };
        let normal = |point: &FrictionPoint| point.normal_force.unwrap_or(f64::NAN);
        let friction = |point: &FrictionPoint| {
            point.friction_coefficient * point.normal_force.unwrap_or(f64::NAN)
        };
        let spread = forces(normal) / forces(friction);
        if !self.has_forces || !points.iter().all(is_above) || spread < EXCHANGED_SPREAD {
            return Ok(());
        }
        let problem = "the friction force is larger than the normal force at every speed, and the normal force is the one that changes: \
                       the columns of the two forces are exchanged";
        Err(self.table.wrong_row(self.table.line, &problem))
    }
}

/// Smallest ratio of the variation of the normal force to that of the friction force from which the columns count as
/// exchanged. A variation is the ratio of the largest to the smallest value. Chosen: a normal force that is held varies less
/// than the friction; 20 % are left for its noise.
const EXCHANGED_SPREAD: f64 = 1.2;

/// Message for a run of rows at one speed without an option for the run-in.
fn without_run_in(run: &[Row]) -> String {
    let last = run[run.len() - 1].line;
    format!(
        "the rows from here to line {last} are one run at {} m/s over time, of which the mean counts: name the run-in that is left \
         out of it, --run-in SECONDS (run_in in Python; 0 for none)",
        rounded(run[0].velocity)
    )
}

/// A value rounded to four significant digits.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Source of the radius of the track.
enum TrackRadius {
    /// The speeds are along the track.
    NotNeeded,
    /// A column of the table.
    Column,
    /// The option, \[m].
    Given(f64),
}

/// Where the radius of the track comes from. Refuses rotational speeds without a radius, and an option that has no effect.
fn track_radius(table: &Table, options: &FrictionTableOptions) -> Result<TrackRadius> {
    let speed = table.find(Velocity);
    let is_rotational = speed.is_some_and(|column| ROTATIONAL_UNITS.contains(&column.unit));
    let option = "the track radius (--track-radius)";
    match (is_rotational, table.find(Radius), options.track_radius) {
        (true, Some(column), Some(_)) => Err(table.without_effect(option, &[column])),
        (true, Some(_), None) => Ok(TrackRadius::Column),
        (true, None, Some(radius)) => Ok(TrackRadius::Given(radius)),
        (true, None, None) => {
            let problem = "a rotational speed needs the radius of the track: a column track radius, or --track-radius in m \
                           (track_radius in Python)";
            Err(table.wrong_row(table.line, &problem))
        }
        (false, _, Some(_)) => {
            let speed: Vec<_> = speed.into_iter().collect();
            Err(table.without_effect(option, &speed))
        }
        (false, _, None) => Ok(TrackRadius::NotNeeded),
    }
}

/// Units of rotational speeds; all are converted to rad/s.
pub(crate) const ROTATIONAL_UNITS: [&str; 3] = ["rpm", "Hz", "rad/s"];
