//! Measured friction over speed, as a table.

use std::path::Path;

use super::FrictionPoint;
use crate::MeasurementError;
use crate::moduli::Deformation;
use crate::table::Quantity::{
    self, Force, Friction, FrictionError, FrictionForce, Temperature, Velocity,
};
use crate::table::{Line, Meaning, Source, Table, Vocabulary, text_of};

static FRICTION: Vocabulary = Vocabulary {
    names: "v and mu (or friction force and normal force), and perhaps T, normal force and standard error",
    known: &KNOWN,
    is_head: |columns| {
        let is_friction = |one: &Quantity| [Friction, FrictionForce].contains(one);
        columns.len() > 1
            && columns
                .iter()
                .any(|one| is_friction(one) || *one == Velocity)
    },
    needed,
    optional: &[Temperature],
    has_order: true,
};

/// Names without blanks, points, dashes, underlines and accents.
const KNOWN: [(Quantity, Option<Deformation>, &str); 16] = [
    (Velocity, None, "v velocity speed geschwindigkeit vitesse"),
    (Velocity, None, "slidingvelocity slidingspeed"),
    (Velocity, None, "rollingvelocity rollingspeed"),
    (Friction, None, "mu μ µ cof frictioncoefficient"),
    (Friction, None, "coefficientoffriction friction"),
    (
        Friction,
        None,
        "rollingresistance rollingresistancecoefficient",
    ),
    (Friction, None, "reibungszahl reibungskoeffizient"),
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
        "frictionforce tangentialforce Ft reibungskraft",
    ),
    (Force, None, "normalforce FN Fn load normalkraft force"),
    (Temperature, None, "T temp temperature temperatur"),
    (Temperature, None, "sampletemperature"),
    (Quantity::Other, None, "index nr"),
    (Quantity::Other, None, "remark"),
];

/// What is there of the forces and errors is needed in every row.
fn needed(columns: &[Quantity]) -> Vec<Quantity> {
    let has = |quantity: &Quantity| columns.contains(quantity);
    let friction = if has(&FrictionForce) && !has(&Friction) {
        vec![FrictionForce, Force]
    } else {
        vec![Friction]
    };
    let others = [Force, FrictionError].into_iter().filter(has);
    let others = others.filter(|other| !friction.contains(other));
    [vec![Velocity], friction.clone(), others.collect()].concat()
}

/// Reads the contents of a file, which need not be there: one table with a line of names. Speeds, coefficients, forces and errors
/// are greater than 0.
///
/// # Errors
/// [`MeasurementError`] with file, line and column.
pub fn friction_points(
    file: &Path,
    contents: &[u8],
) -> Result<Vec<FrictionPoint>, MeasurementError> {
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
    let mut points = Vec::new();
    for (table, rows) in &tables {
        let rows = rows.iter().map(|line| point(table, line));
        points.extend(rows.collect::<Result<Vec<_>, _>>()?);
    }
    Ok(points)
}

fn point(table: &Table, line: &Line) -> Result<FrictionPoint, MeasurementError> {
    let numbers = table.positives(line)?;
    let mut of = table.needed.iter().zip(numbers);
    let find = |quantity: Quantity| {
        let found = of.clone().find(|(one, _)| **one == quantity);
        found.map(|(_, number)| number)
    };
    let normal_force = find(Force);
    let friction = match (find(Friction), find(FrictionForce), normal_force) {
        (Some(friction), ..) => friction,
        (None, Some(force), Some(normal)) => force / normal,
        _ => return Err(table.wrong_first(line, "a friction coefficient")),
    };
    let standard_error = find(FrictionError);
    let velocity = of.next().map_or(f64::NAN, |(_, velocity)| velocity);
    Ok(FrictionPoint {
        velocity,
        friction_coefficient: friction,
        standard_error,
        temperature: table.celsius(line)?,
        normal_force,
    })
}
