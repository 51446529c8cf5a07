//! Measured curves, as instruments export them.

use std::path::Path;

use numerics::{InvalidParameter, in_range, positive};

use super::{IndentationCurve, igor};
use crate::MeasurementError;
use crate::moduli::Deformation;
use crate::table::Quantity::{self, Deflection, Depth, Force, Height, Other, Piezo, Time, Tip};
use crate::table::{Column, Line, Meaning, Source, Table, Vocabulary, text_of};

static CURVES: Vocabulary = Vocabulary {
    names: "t, force (or deflection) and depth (or tip position, piezo or height)",
    known: &KNOWN,
    is_head: |columns| {
        columns.iter().any(|one| [Force, Deflection].contains(one)) && columns.len() > 1
    },
    needed,
    optional: &[],
    has_order: true,
};

/// The first name of a quantity counts: what was measured, and not what was smoothed or asked of a piezo.
const KNOWN: [(Quantity, Option<Deformation>, &str); 18] = [
    (Time, None, "seriestime"),
    (Time, None, "t time zeit"),
    (Force, None, "F force load kraft normalforce"),
    (Force, None, "vdeflection(force)"),
    (Depth, None, "d depth indentation indentationdepth"),
    (Depth, None, "eindringtiefe δ delta"),
    (Tip, None, "tipposition verticaltipposition separation"),
    (Piezo, None, "zsensor zsnsr heightsensor"),
    (Piezo, None, "z piezo piezoposition zpiezo"),
    (Piezo, None, "displacement calcramp raw"),
    (Height, None, "measuredheight height(measured)"),
    (Height, None, "straingaugeheight capacitivesensorheight"),
    (
        Height,
        None,
        "smoothedmeasuredheight smoothedstraingaugeheight",
    ),
    (Height, None, "smoothedcapacitivesensorheight"),
    (Height, None, "height"),
    (Deflection, None, "deflection vdeflection auslenkung defl"),
    (Other, None, "height(piezo)"),
    (Other, None, "segment index"),
];

/// The depth is measured, or follows from the piezo and the deflection, and the force from the deflection.
fn needed(columns: &[Quantity]) -> Vec<Quantity> {
    let has = |quantity: &Quantity| columns.contains(quantity);
    let load = [Force, Deflection].into_iter().find(has);
    let place = [Depth, Tip, Piezo, Height].into_iter().find(has);
    let time = has(&Time).then_some(Time);
    let others = [load.unwrap_or(Force), place.unwrap_or(Depth)];
    time.into_iter().chain(others).collect()
}

/// What a table of a curve does not say.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CurveOptions {
    /// Stiffness of the cantilever, \[N/m], for a deflection, and for the depth from a piezo or a height; none: what the
    /// table says.
    pub spring_constant: Option<f64>,
    /// Deflection per volt, \[m/V], for a deflection in volts.
    pub sensitivity: Option<f64>,
    /// Ramps per second, there and back at the same speed, \[1/s], of a table of the two halves of a ramp without times.
    pub ramp_rate: Option<f64>,
}

/// Reads the contents of a file, which need not be there: tables with a line of names each, among other text, or Igor text.
/// Cells without a number are NaN, of which [`fit_indentation`](super::fit_indentation) says where they are.
///
/// A piezo and a depth grow towards the sample, a height and the position of the tip fall; piezo and height less the
/// deflection are the depth.
///
/// # Errors
/// [`MeasurementError`] with file, line and column, or with the option that is missing, out of range or without effect.
pub fn indentation_curve(
    file: &Path,
    contents: &[u8],
    options: &CurveOptions,
) -> Result<IndentationCurve, MeasurementError> {
    options.check_ranges()?;
    let given = options;
    let text = text_of(contents, &CURVES);
    let stiffness = options.spring_constant.or_else(|| stated_stiffness(&text));
    let options = &CurveOptions {
        spring_constant: stiffness,
        ..*options
    };
    // Igor may end its lines with a carriage return alone.
    let unix = (!text.contains('\n')).then(|| text.replace('\r', "\n"));
    let text = unix.as_deref().unwrap_or(&text);
    let table = igor::table(text);
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
    let mut curve = IndentationCurve::default();
    let tables = source.tables()?;
    let several = tables.len() > 1;
    for (table, rows) in tables {
        given.check_needed(&table)?;
        let segment = Segment::of(&source, &table, options)?;
        let points = segment.points(&table, &rows)?;
        // JPK may end with two points of a pause, seconds apart.
        if !(several && points.len() < 3) {
            segment.append(&mut curve, points);
        }
    }
    Ok(curve)
}

impl CurveOptions {
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

    /// Refuses what changes nothing beside the columns of a table.
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

/// The stiffness that JPK and Asylum write beside their numbers, \[N/m].
fn stated_stiffness(text: &str) -> Option<f64> {
    let (_, stated) = text.split_once("pringConstant:")?;
    let stated = stated.trim_start();
    let end = stated.find(|one: char| !one.is_ascii_alphanumeric() && !".+-".contains(one));
    let stiffness = stated[..end.unwrap_or(stated.len())].parse().ok()?;
    (stiffness > 0.0).then_some(stiffness)
}

fn is_volts(column: &Column) -> bool {
    column.quantity == Deflection && column.unit.ends_with('V')
}

/// How a table is read.
struct Segment {
    /// Force of a load of 1, \[N] or \[N/m].
    of_load: f64,
    /// Depth of a place of 1, and of a force, \[m/N].
    of_place: f64,
    of_force: f64,
    /// Of half a ramp without times, \[s].
    duration: Option<f64>,
}

impl Segment {
    fn of(
        source: &Source,
        table: &Table,
        options: &CurveOptions,
    ) -> Result<Self, MeasurementError> {
        let missing = |what: &str| source.wrong_line(table.line, &format!("{what} is needed"));
        let stiffness = || {
            let needed = missing("the stiffness of the cantilever (spring_constant)");
            options.spring_constant.ok_or(needed)
        };
        let duration = options.ramp_rate.filter(|_| table.is_half);
        if table.find(Time).is_none() && duration.is_none() {
            let of_halves = "or for columns _Ex and _Rt the ramps per second (ramp_rate)";
            return Err(missing(&format!("a column t, {of_halves},")));
        }
        let load = table.find(Deflection);
        if load.is_some_and(is_volts) && options.sensitivity.is_none() {
            return Err(missing("the deflection per volt (sensitivity)"));
        }
        let of_load = match load {
            Some(load) if !load.unit.ends_with('N') => stiffness()?,
            _ => 1.0,
        };
        let is_there = |quantity| table.find(quantity).is_some();
        let [of_place, of_force] = match () {
            () if is_there(Depth) => [1.0, 0.0],
            () if is_there(Tip) => [-1.0, 0.0],
            () if is_there(Piezo) => [1.0, -stiffness()?.recip()],
            () => [-1.0, -stiffness()?.recip()],
        };
        Ok(Self {
            of_load,
            of_place,
            of_force,
            duration: duration.map(|rate| 0.5 / rate),
        })
    }

    /// Time, depth and force of every row.
    fn points(&self, table: &Table, rows: &[&Line]) -> Result<Vec<[f64; 3]>, MeasurementError> {
        let point = |line: &&Line| {
            let numbers = table.numbers(line)?;
            let [.., load, place] = numbers[..] else {
                return Ok(None);
            };
            // The shorter half of a ramp ends with empty cells.
            let is_nothing = table.is_half && load.is_nan() && place.is_nan();
            let force = self.of_load * load;
            let depth = self.of_place * place + self.of_force * force;
            Ok((!is_nothing).then_some([numbers[0], depth, force]))
        };
        let points: Result<Vec<_>, MeasurementError> = rows.iter().map(point).collect();
        Ok(points?.into_iter().flatten().collect())
    }

    /// Half a ramp may have begun at either end; it goes on from where the other half ended.
    fn append(&self, curve: &mut IndentationCurve, mut points: Vec<[f64; 3]>) {
        if let Some(duration) = self.duration {
            let step = duration / points.len() as f64;
            if let (Some(last), [first, .., end]) = (curve.depth.last(), &points[..])
                && (end[1] - last).abs() < (first[1] - last).abs()
            {
                points.reverse();
            }
            let begin = curve.time.last().map_or(0.0, |last| last + step);
            let timed = points.iter_mut().enumerate();
            timed.for_each(|(i, point)| point[0] = begin + i as f64 * step);
        }
        for [time, depth, force] in points {
            curve.time.push(time);
            curve.depth.push(depth);
            curve.force.push(force);
        }
    }
}
