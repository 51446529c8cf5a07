//! Quantities of the contact along a history or a motion.

use std::iter;

use numerics::Estimate;
use serde::ser::{Serialize, SerializeMap, Serializer};

/// The contact at the points of a history or a motion; empty if the load has none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curve {
    /// Times, \[s].
    pub times: Vec<f64>,
    /// The known ones of force, depth, position, contact radius, contact area, and work since the first point.
    pub columns: Vec<CurveColumn>,
}

/// One quantity along a history; an error of 0 marks a given value.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveColumn {
    /// Name and unit, as they appear in the header of a table.
    pub name: [&'static str; 2],
    /// Values at all points.
    pub values: Vec<Estimate>,
}

/// Name and unit of the column of the normal force.
pub(crate) const FORCE: [&str; 2] = ["normal_force", "n"];
/// Column of the indentation depth.
pub(crate) const DEPTH: [&str; 2] = ["indentation_depth", "m"];
/// Column of the contact radius.
pub(crate) const RADIUS: [&str; 2] = ["contact_radius", "m"];
/// Column of the contact area.
pub(crate) const AREA: [&str; 2] = ["contact_area", "m2"];
/// Column of the work done since the first point.
pub(crate) const WORK_DONE: [&str; 2] = ["work", "j"];
/// Column of the position along the surface.
pub(crate) const POSITION: [&str; 2] = ["position", "m"];
/// Column of the tangential force.
pub(crate) const TANGENTIAL: [&str; 2] = ["tangential_force", "n"];

/// Name and unit of a column, and the function that extracts its value from a point.
pub(crate) type OfPoint<P> = ([&'static str; 2], fn(&P) -> Estimate);

impl CurveColumn {
    /// Largest absolute value over all points.
    pub fn largest(&self) -> f64 {
        self.largest_of(|known| known.value.abs())
    }

    /// Largest absolute error over all points.
    pub fn error(&self) -> f64 {
        self.largest_of(|known| known.error)
    }

    /// Largest value over all points of `of`, which is not negative; 0 without points.
    fn largest_of(&self, of: fn(&Estimate) -> f64) -> f64 {
        self.values.iter().map(of).fold(0.0, f64::max)
    }
}

impl Curve {
    /// Builds the columns from the points computed by a method.
    pub(crate) fn of<P, const N: usize>(
        points: &[P],
        time: fn(&P) -> f64,
        columns: [OfPoint<P>; N],
    ) -> Self {
        let column = |(name, of): OfPoint<P>| CurveColumn {
            name,
            values: points.iter().map(of).collect(),
        };
        Self {
            times: points.iter().map(time).collect(),
            columns: columns.map(column).into(),
        }
    }

    /// Key in JSON: `motion` if there is a position, else `history`.
    pub fn name(&self) -> &'static str {
        let moves = self.column(POSITION[0]).is_some();
        if moves { "motion" } else { "history" }
    }

    /// The column with a given name; `None` if that quantity is not known.
    pub fn column(&self, name: &str) -> Option<&CurveColumn> {
        self.columns.iter().find(|column| column.name[0] == name)
    }

    /// Largest absolute value of a quantity; 0 if it is not known.
    pub(crate) fn largest(&self, [name, _]: [&str; 2]) -> f64 {
        self.column(name).map_or(0.0, CurveColumn::largest)
    }

    /// Last value of a quantity; `None` if it is not known or there are no points.
    pub(crate) fn last(&self, [name, _]: [&str; 2]) -> Option<Estimate> {
        self.column(name)?.values.last().copied()
    }

    /// Writes the JSON: the values at all points, and the largest error of each column.
    pub(crate) fn serialize_into<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        let rows = self.times.iter().enumerate().map(|(index, time)| {
            let columns = self.columns.iter();
            let values = columns.map(|column| (column.name[0], column.values[index].value));
            Named(iter::once(("time", *time)).chain(values).collect())
        });
        let columns = self.columns.iter();
        let errors = columns.map(|column| (column.name[0], column.error()));
        let name = self.name();
        map.serialize_entry(name, &rows.collect::<Vec<Named>>())?;
        map.serialize_entry(&format!("{name}_error"), &Named(errors.collect()))
    }
}

/// Named numbers, serialized as a map in this order.
struct Named(Vec<(&'static str, f64)>);

impl Serialize for Named {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}
