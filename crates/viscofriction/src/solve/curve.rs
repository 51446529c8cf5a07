//! What is known along a history.

use std::iter;

use numerics::Estimate;
use serde::ser::{Serialize, SerializeMap, Serializer};

/// The contact at the points of a history; none where nothing was followed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curve {
    /// Times, \[s].
    pub times: Vec<f64>,
    /// Force, depth, radius or area of the contact, and the work since the first point, where it is known.
    pub columns: Vec<CurveColumn>,
}

/// One quantity along a history; errors of 0 say that it is given.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveColumn {
    /// Its name and its unit, as tables write them.
    pub name: [&'static str; 2],
    /// Its values at all points.
    pub values: Vec<Estimate>,
}

/// Names of columns.
pub(crate) const FORCE: [&str; 2] = ["normal_force", "n"];
pub(crate) const DEPTH: [&str; 2] = ["indentation_depth", "m"];
pub(crate) const RADIUS: [&str; 2] = ["contact_radius", "m"];
pub(crate) const AREA: [&str; 2] = ["contact_area", "m2"];
pub(crate) const WORK: [&str; 2] = ["work", "j"];

/// The name of a column, and its value at a point.
pub(crate) type OfPoint<P> = ([&'static str; 2], fn(&P) -> Estimate);

impl CurveColumn {
    /// The largest value, at least 0.
    pub fn largest(&self) -> f64 {
        self.over(|known| known.value.abs())
    }

    /// The largest error of all points.
    pub fn error(&self) -> f64 {
        self.over(|known| known.error)
    }

    fn over(&self, of: fn(&Estimate) -> f64) -> f64 {
        self.values.iter().map(of).fold(0.0, f64::max)
    }
}

impl Curve {
    /// Columns of the points that a method found.
    pub(crate) fn of<P>(points: &[P], time: fn(&P) -> f64, columns: [OfPoint<P>; 3]) -> Self {
        let column = |(name, of): OfPoint<P>| CurveColumn {
            name,
            values: points.iter().map(of).collect(),
        };
        Self {
            times: points.iter().map(time).collect(),
            columns: columns.map(column).into(),
        }
    }

    /// The column of a name; none where it is not known.
    pub fn column(&self, name: &str) -> Option<&CurveColumn> {
        self.columns.iter().find(|column| column.name[0] == name)
    }

    /// The largest value of a quantity, 0 where it is not known.
    pub(crate) fn largest(&self, [name, _]: [&str; 2]) -> f64 {
        self.column(name).map_or(0.0, CurveColumn::largest)
    }

    /// The last value of a quantity.
    pub(crate) fn last(&self, [name, _]: [&str; 2]) -> Option<Estimate> {
        self.column(name)?.values.last().copied()
    }

    /// In JSON: the values at all points, and the largest error of each.
    pub(crate) fn serialize_into<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        let rows = self.times.iter().enumerate().map(|(index, time)| {
            let columns = self.columns.iter();
            let values = columns.map(|column| (column.name[0], column.values[index].value));
            Named(iter::once(("time", *time)).chain(values).collect())
        });
        let columns = self.columns.iter();
        let errors = columns.map(|column| (column.name[0], column.error()));
        map.serialize_entry("history", &rows.collect::<Vec<Named>>())?;
        map.serialize_entry("history_error", &Named(errors.collect()))
    }
}

/// Numbers by their names.
struct Named(Vec<(&'static str, f64)>);

impl Serialize for Named {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}
