//! Reader of measured force–indentation curves, as instruments export them.

use std::path::Path;

use numerics::{InvalidParameter, in_range, positive};

use super::join::{JoinedCurve, Point};
use super::{IndentationCurve, Note, afmformats, igor};
use crate::MeasurementError;
use crate::moduli::Deformation;
use crate::table::Quantity::{
    self, Deflection, Depth, Displacement, Force, Height, Other, Piezo, Time, Tip,
};
use crate::table::{Column, Half, Line, Meaning, Source, Table, Vocabulary, text_of};

/// Names and columns of a table of force over depth.
pub(crate) static CURVES: Vocabulary = Vocabulary {
    names: "t, force (or deflection) and depth (or tip position, displacement, piezo or height)",
    known: &KNOWN_NAMES,
    is_head: |columns| {
        columns.iter().any(|one| [Force, Deflection].contains(one)) && columns.len() > 1
    },
    needed,
    optional: &[],
    has_order: true,
};

/// Known names; the first one of a quantity takes precedence: measured values before smoothed or nominal ones.
const KNOWN_NAMES: [(Quantity, Option<Deformation>, &str); 24] = [
    (Time, None, "seriestime"),
    (Time, None, "timeonsample testtime elapsedtime"),
    (Time, None, "t time zeit temps prüfzeit"),
    (
        Force,
        None,
        "loadonsample normalforce normalload normalkraft",
    ),
    (Force, None, "F Fn force load kraft prüfkraft standardkraft"),
    (Force, None, "compressiveload compressiveforce rawload"),
    (Force, None, "vdeflection(force)"),
    (Depth, None, "displacementintosurface penetrationdepth Pd"),
    (Depth, None, "d depth indentation indentationdepth"),
    (Depth, None, "eindringtiefe profondeur δ delta h"),
    (Tip, None, "tipposition verticaltipposition separation"),
    (
        Displacement,
        None,
        "displacement deplacement weg standardweg",
    ),
    (
        Displacement,
        None,
        "extension compressiveextension rawdisplacement",
    ),
    (Piezo, None, "zsensor zsnsr zsense heightsensor"),
    (Piezo, None, "z Z piezo piezoposition zpiezo"),
    (Piezo, None, "piezodisplacement zdisplacement calcramp raw"),
    (Height, None, "measuredheight height(measured)"),
    (Height, None, "straingaugeheight capacitivesensorheight"),
    (
        Height,
        None,
        "smoothedmeasuredheight smoothedstraingaugeheight",
    ),
    (Height, None, "smoothedcapacitivesensorheight"),
    (Height, None, "height"),
    (
        Deflection,
        None,
        "deflection vdeflection auslenkung defl tb",
    ),
    (Other, None, "height(piezo)"),
    (Other, None, "segment index"),
];

/// Needed columns: the depth, or piezo and deflection, from which it follows; the force, or the deflection.
fn needed(columns: &[Quantity]) -> Vec<Quantity> {
    let has = |quantity: &Quantity| columns.contains(quantity);
    let load = [Force, Deflection].into_iter().find(has);
    let places = [Depth, Tip, Displacement, Piezo, Height];
    let place = places.into_iter().find(has);
    let time = has(&Time).then_some(Time);
    let others = [load.unwrap_or(Force), place.unwrap_or(Depth)];
    time.into_iter().chain(others).collect()
}

/// Information that a table of a curve does not contain.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CurveOptions {
    /// Stiffness of the cantilever, \[N/m], for a deflection, and for the depth from a piezo or a height.
    ///
    /// `None` for the value that the file states.
    pub spring_constant: Option<f64>,
    /// Deflection per volt, \[m/V], for a deflection in volts.
    pub sensitivity: Option<f64>,
    /// Frequency of the ramps, with equal speeds in both directions, \[1/s], for the halves of a ramp without times.
    pub ramp_rate: Option<f64>,
}

/// A curve of a file, and the assumptions of the reader.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CurveFile {
    /// Measured curve.
    pub curve: IndentationCurve,
    /// Notes on selected columns, quantities that the file states or lacks, and times that begin again.
    pub notes: Vec<Note>,
}

/// Reads a curve from the contents of a file: tables with a line of names each, among other text, or Igor text.
///
/// The path is used for messages only. Cells without a number are NaN; [`fit_indentation`](super::fit_indentation) reports
/// them.
///
/// Piezo position and depth increase towards the sample; height and tip position decrease. The depth is piezo position or
/// height less the deflection. A displacement next to a force is a depth; with a spring constant or a deflection it is the
/// travel of a piezo.
///
/// # Errors
/// [`MeasurementError`] with file, line and column, or with the option that is missing, out of range or without effect.
pub fn indentation_curve(
    file: &Path,
    contents: &[u8],
    options: &CurveOptions,
) -> Result<CurveFile, MeasurementError> {
    options.check_ranges()?;
    let given = options;
    let text = text_of(contents, &CURVES);
    let known = Stated::of(&text);
    let options = &known.complete(given);
    // Igor may end its lines with a carriage return alone.
    let unix = (!text.contains('\n')).then(|| text.replace('\r', "\n"));
    let text = unix.as_deref().unwrap_or(&text);
    let table = igor::table(text).or_else(|| afmformats::table(text));
    let text = table.as_deref().unwrap_or(text);
    let scale = |column: &Column| match options.sensitivity {
        Some(sensitivity) if is_volts(column) => sensitivity,
        _ => 1.0,
    };
    let meaning = Meaning {
        deformation: None,
        scale: &scale,
    };
    let source = Source::new(file, text, &CURVES, meaning);
    let mut joined = JoinedCurve::default();
    let tables = source.tables()?;
    let several = tables.len() > 1;
    for (table, rows) in tables {
        given.check_needed(&table)?;
        let segment = Segment::of(&source, &table, options, several)?;
        joined.notes.extend(left_out(&table));
        joined.notes.extend(known.notes(given, &table, &segment));
        joined.notes.extend(segment.displacement(&table));
        let points = segment.points(&table, &rows)?;
        // JPK may end with two points of a pause, seconds apart.
        if several && points.len() < 3 {
            continue;
        }
        let points = segment.with_times(&mut joined, points);
        joined.append(&source, &points)?;
    }
    Ok(joined.finish())
}

/// Note on the columns that are read if there are others of their kind.
fn left_out(table: &Table) -> Option<String> {
    let quoted = |names: &[&str]| {
        let quoted: Vec<String> = names.iter().map(|name| format!("'{name}'")).collect();
        quoted.join(", ")
    };
    let read = table.needed.iter().filter_map(|one| table.find(*one));
    let read: Vec<&str> = read.map(|column| column.name).collect();
    let [read, others] = [&read, &table.left_out].map(|names| quoted(names));
    (!others.is_empty()).then(|| format!("read from the columns {read}, and not from {others}"))
}

/// Constants that a file states in its text.
#[derive(Clone, Copy)]
struct Stated {
    /// Stiffness of the cantilever, \[N/m].
    spring_constant: Option<f64>,
    /// Deflection per volt, \[m/V].
    sensitivity: Option<f64>,
}

impl Stated {
    /// The constants in a text; `None` for those that it does not state.
    fn of(text: &str) -> Self {
        // Read the constants as JPK and Asylum, afmformats, Optics11 and AFM Workshop write them. A 1 of AFM Workshop is its
        // default and says nothing.
        let workshop = |name| number_after(text, name).filter(|number| differs(*number, 1.0));
        let stiffness = ["pringConstant:", "\"spring constant\":", "k (N/m)"]
            .iter()
            .find_map(|name| number_after(text, name));
        let gain = workshop("Light Lever Gain, mV/nm:");
        Self {
            spring_constant: stiffness.or_else(|| workshop("Force Constant, nN/nm:")),
            sensitivity: gain.map(|gain| 1e-6 / gain),
        }
    }

    /// The options; a spring constant or sensitivity that they leave out is that of the file.
    fn complete(self, options: &CurveOptions) -> CurveOptions {
        CurveOptions {
            spring_constant: options.spring_constant.or(self.spring_constant),
            sensitivity: options.sensitivity.or(self.sensitivity),
            ..*options
        }
    }

    /// Notes on constants taken from the file, or different from the given ones.
    fn notes(self, given: &CurveOptions, table: &Table, segment: &Segment) -> Vec<String> {
        let uses_stiffness = segment.of_force != 0.0 || segment.is_length;
        let is_in_volts = table.find(Deflection).is_some_and(is_volts);
        let all = [
            (
                "spring_constant",
                "N/m",
                given.spring_constant,
                self.spring_constant.filter(|_| uses_stiffness),
            ),
            (
                "sensitivity",
                "m/V",
                given.sensitivity,
                self.sensitivity.filter(|_| is_in_volts),
            ),
        ];
        let note = |(option, unit, given, stated): (&str, &str, Option<f64>, Option<f64>)| {
            let stated = stated?;
            match given {
                None => Some(format!("{option} = {stated:?} {unit} is that of the file")),
                Some(given) if differs(given, stated) => Some(format!(
                    "{option} = {given:?} {unit} is taken, but the file says {stated:?} {unit}"
                )),
                Some(_) => None,
            }
        };
        all.into_iter().filter_map(note).collect()
    }
}

/// Whether two numbers differ by more than the rounding of a file.
fn differs(number: f64, other: f64) -> bool {
    (number - other).abs() > 1e-6 * other
}

/// The number after the first `name` in a text; `None` if there is none, or it is not greater than 0.
fn number_after(text: &str, name: &str) -> Option<f64> {
    let (_, after) = text.split_once(name)?;
    let value = after.trim_start_matches([' ', '\t', ':', '"']);
    let end = value.find(|one: char| !one.is_ascii_alphanumeric() && !".+-".contains(one));
    let number: f64 = value[..end.unwrap_or(value.len())].parse().ok()?;
    (number > 0.0 && number.is_finite()).then_some(number)
}

impl CurveOptions {
    /// Refuses options out of their ranges.
    fn check_ranges(&self) -> Result<(), InvalidParameter> {
        let rates = [
            ("spring_constant", self.spring_constant),
            ("ramp_rate", self.ramp_rate),
        ];
        for (name, value) in rates {
            value.map_or(Ok(1.0), |value| positive(name, value))?;
        }
        let sensitivity = self.sensitivity.unwrap_or(1.0);
        let holds = sensitivity.is_finite() && sensitivity != 0.0;
        in_range("sensitivity", sensitivity, holds, "finite and not 0")?;
        Ok(())
    }

    /// Stiffness of the cantilever, \[N/m]; the error has the `reason` for which it is needed.
    fn stiffness(&self, reason: &str) -> Result<f64, String> {
        let needed = || {
            format!(
                "the stiffness of the cantilever, --spring-constant in N/m (spring_constant in Python), is needed, because {reason}"
            )
        };
        self.spring_constant.ok_or_else(needed)
    }

    /// Coefficients of the position and of the force \[m/N] in the depth of a table: ±1, and minus the compliance of the
    /// cantilever if the position is that of a piezo.
    fn depth_coefficients(&self, table: &Table) -> Result<[f64; 2], String> {
        let bending = |column: &Column| {
            let name = column.name;
            let reason = format!(
                "'{name}' is the place of a piezo; a column without the bending of the cantilever is named depth or tip position"
            );
            Ok::<f64, String>(-self.stiffness(&reason)?.recip())
        };
        let is_depth = table.find(Deflection).is_none() && self.spring_constant.is_none();
        let columns = [Depth, Tip, Displacement, Piezo, Height].map(|one| table.find(one));
        Ok(match columns {
            [Some(_), ..] => [1.0, 0.0],
            [_, Some(_), ..] => [-1.0, 0.0],
            [_, _, Some(_), ..] if is_depth => [1.0, 0.0],
            [_, _, Some(piezo), ..] | [_, _, _, Some(piezo), _] => [1.0, bending(piezo)?],
            [.., Some(height)] => [-1.0, bending(height)?],
            _ => return Err("a depth is needed".to_owned()),
        })
    }

    /// Refuses options without effect on the columns of a table.
    fn check_needed(&self, table: &Table) -> Result<(), MeasurementError> {
        let find = |quantities: &[Quantity]| quantities.iter().find_map(|one| table.find(*one));
        let load = find(&[Force, Deflection]);
        let force = load.filter(|load| load.unit.ends_with('N'));
        let depth = find(&[Depth, Tip]);
        let beside = [
            (
                "ramp_rate",
                self.ramp_rate,
                table.find(Time).map(|time| vec![time]),
            ),
            (
                "sensitivity",
                self.sensitivity,
                load.filter(|load| !is_volts(load)).map(|load| vec![load]),
            ),
            (
                "spring_constant",
                self.spring_constant,
                force.zip(depth).map(|(force, depth)| vec![force, depth]),
            ),
        ];
        for (option, given, beside) in beside {
            if let (Some(_), Some(columns)) = (given, beside) {
                return Err(table.without_effect(option, &columns));
            }
        }
        Ok(())
    }
}

/// True for a deflection in volts.
fn is_volts(column: &Column) -> bool {
    column.quantity == Deflection && column.unit.ends_with('V')
}

/// Conversion of the columns of a table to force and depth.
struct Segment {
    /// Coefficient of the load in the force: 1, or the stiffness \[N/m] for a deflection.
    of_load: f64,
    /// Whether the load is a length.
    is_length: bool,
    /// Coefficient of the position in the depth.
    of_place: f64,
    /// Coefficient of the force in the depth, \[m/N].
    of_force: f64,
    /// Duration of half a ramp without times, \[s].
    duration: Option<f64>,
}

impl Segment {
    /// How the columns of a table become SI units with these options. An error if a column or an option is missing.
    /// `several`: whether the curve has more than one table.
    fn of(
        source: &Source,
        table: &Table,
        options: &CurveOptions,
        several: bool,
    ) -> Result<Self, MeasurementError> {
        let wrong = |problem: &str| source.wrong_line(table.line, &problem);
        let missing = |what: &str| wrong(&format!("{what} is needed"));
        if table.half == Some(Half::Retract) && !several {
            return Err(wrong(
                "only the way back is there, but a fit begins with the way in",
            ));
        }
        let duration = options.ramp_rate.filter(|_| table.half.is_some());
        if table.find(Time).is_none() && duration.is_none() {
            let of_halves = "or for columns of the two halves of a ramp (_Ex and _Rt, Extend and Retract) the ramps per \
                             second, --ramp-rate (ramp_rate in Python)";
            return Err(missing(&format!("a column t, {of_halves},")));
        }
        let load = table.find(Deflection);
        if load.is_some_and(is_volts) && options.sensitivity.is_none() {
            return Err(missing(
                "the deflection per volt, --sensitivity in m/V (sensitivity in Python),",
            ));
        }
        let length = load.filter(|load| !load.unit.ends_with('N'));
        let of_load = length.map_or(Ok(1.0), |load| {
            let what = format!("'{}' is a length", load.name);
            options.stiffness(&what).map_err(|problem| wrong(&problem))
        })?;
        let place = options
            .depth_coefficients(table)
            .map_err(|problem| wrong(&problem));
        let [of_place, of_force] = place?;
        Ok(Self {
            of_load,
            is_length: length.is_some(),
            of_place,
            of_force,
            duration: duration.map(|rate| 0.5 / rate),
        })
    }

    /// Note that says whether a column of displacement was read as depth or as travel of a piezo; `None` without such a
    /// column.
    fn displacement(&self, table: &Table) -> Option<String> {
        let name = table.find(Displacement)?.name;
        Some(if self.of_force == 0.0 {
            format!(
                "'{name}' is taken for the depth of the body; with spring_constant it is the travel of a piezo"
            )
        } else {
            format!(
                "'{name}' is taken for the travel of a piezo, because there is a spring constant"
            )
        })
    }

    /// Points of all rows, in SI units; rows at the end of the shorter half of a ramp, which have no numbers, are left out.
    fn points(&self, table: &Table, rows: &[&Line]) -> Result<Vec<Point>, MeasurementError> {
        let point = |line: &&Line| {
            let numbers = table.numbers(line)?;
            let [.., load, place] = numbers[..] else {
                return Ok(None);
            };
            // The shorter half of a ramp ends with empty cells.
            let is_nothing = table.half.is_some() && load.is_nan() && place.is_nan();
            let force = self.of_load * load;
            let depth = self.of_place * place + self.of_force * force;
            Ok((!is_nothing).then_some(Point {
                time: numbers[0],
                depth,
                force,
                line: line.number,
            }))
        };
        let points: Result<Vec<_>, MeasurementError> = rows.iter().map(point).collect();
        Ok(points?.into_iter().flatten().collect())
    }

    /// Adds times to half a ramp without them, and reverses it if it is stored backwards.
    ///
    /// The approach moves towards the sample; the retraction continues at the end of the approach.
    fn with_times(&self, joined: &mut JoinedCurve, mut points: Vec<Point>) -> Vec<Point> {
        let (Some(duration), [first, .., end]) = (self.duration, &points[..]) else {
            return points;
        };
        let step = duration / points.len() as f64;
        let last = joined.curve.depth.last();
        let is_reversed = match last {
            Some(last) => (end.depth - last).abs() < (first.depth - last).abs(),
            None => end.depth < first.depth,
        };
        if is_reversed {
            let half = if last.is_some() { "back" } else { "in" };
            let from = first.line;
            joined.notes.push(format!(
                "the rows of the way {half}, from line {from} on, are taken from the last to the first"
            ));
            points.reverse();
        }
        let begin = joined.curve.time.last().map_or(0.0, |last| last + step);
        let timed = points.iter_mut().enumerate();
        timed.for_each(|(i, point)| point.time = begin + i as f64 * step);
        points
    }
}
