//! Measured curves, as instruments export them.

use std::path::Path;

use super::IndentationCurve;
use crate::WrongInput;
use crate::moduli::Deformation;
use crate::table::Quantity::{self, Deflection, Depth, Force, Height, Other, Piezo, Time};
use crate::table::{Column, Meaning, Source, Vocabulary, text_of};

static CURVES: Vocabulary = Vocabulary {
    names: "t, force (or deflection) and depth (or piezo, or height)",
    known: &KNOWN,
    is_head: |columns| {
        columns.iter().any(|one| [Force, Deflection].contains(one)) && columns.len() > 1
    },
    needed,
    optional: &[],
};

const KNOWN: [(Quantity, Option<Deformation>, &str); 12] = [
    (Time, None, "t time zeit"),
    (Force, None, "F force load kraft normalforce"),
    (Force, None, "vdeflection(force)"),
    (Depth, None, "d depth indentation indentationdepth"),
    (Depth, None, "eindringtiefe δ delta"),
    (Piezo, None, "z piezo piezoposition zpiezo"),
    (Piezo, None, "displacement zsensor"),
    (Height, None, "height measuredheight height(measured)"),
    (Height, None, "smoothedmeasuredheight"),
    (Deflection, None, "deflection vdeflection auslenkung defl"),
    (Other, None, "height(piezo) tipposition"),
    (Other, None, "segment index"),
];

/// The depth is measured, or follows from the piezo and the deflection, and the force from the deflection.
fn needed(columns: &[Quantity]) -> Vec<Quantity> {
    let has = |quantity: &Quantity| columns.contains(quantity);
    let load = [Force, Deflection].into_iter().find(has);
    let place = [Depth, Piezo, Height].into_iter().find(has);
    vec![Time, load.unwrap_or(Force), place.unwrap_or(Depth)]
}

/// What a table of a curve does not say.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CurveOptions {
    /// Stiffness of the cantilever, \[N/m], for a deflection, and for the depth from a piezo or a height.
    pub spring_constant: Option<f64>,
    /// Deflection per volt, \[m/V], for a deflection in volts.
    pub sensitivity: Option<f64>,
}

/// Reads the contents of a file, which need not be there: tables with a line of names each, among other text. Cells without
/// a number are NaN, of which [`fit_indentation`](super::fit_indentation) says where they are.
///
/// A piezo and a depth grow towards the sample, and a height falls; piezo and height less the deflection are the depth.
///
/// # Errors
/// [`WrongInput`] with file, line and column, or with the option that is missing.
pub fn indentation_curve(
    file: &Path,
    contents: &[u8],
    options: &CurveOptions,
) -> Result<IndentationCurve, WrongInput> {
    let text = text_of(contents);
    let volts = |column: &Column| column.quantity == Deflection && column.unit.ends_with('V');
    let scale = |column: &Column| match options.sensitivity {
        Some(sensitivity) if volts(column) => sensitivity,
        _ => 1.0,
    };
    let meaning = Meaning {
        deformation: None,
        scale: &scale,
    };
    let source = Source::new(file, &text, &CURVES, meaning);
    let mut curve = IndentationCurve::default();
    for (table, rows) in source.tables()? {
        let [_, load, place] = table.needed[..] else {
            continue;
        };
        let missing = |what: &str| source.wrong_line(table.line, &format!("{what} is needed"));
        let stiffness = || {
            let needed = missing("the stiffness of the cantilever (spring_constant)");
            options.spring_constant.ok_or(needed)
        };
        if table.find(load).is_some_and(volts) && options.sensitivity.is_none() {
            return Err(missing("the deflection per volt (sensitivity)"));
        }
        let stiffness = match (load, place) {
            (Force, Depth) => f64::INFINITY,
            _ => stiffness()?,
        };
        for line in rows {
            let numbers = table.numbers(line)?;
            let [time, load_value, place_value] = [numbers[0], numbers[1], numbers[2]];
            let force = match load {
                Deflection => stiffness * load_value,
                _ => load_value,
            };
            curve.time.push(time);
            curve.force.push(force);
            curve.depth.push(match place {
                Depth => place_value,
                Piezo => place_value - force / stiffness,
                _ => -place_value - force / stiffness,
            });
        }
    }
    Ok(curve)
}
