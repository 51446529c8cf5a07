//! What is known along a history.

use std::iter;

use numerics::Estimate;
use serde::ser::{Serialize, SerializeMap, Serializer};

/// The contact at the points of a history, or of a motion; none where nothing was followed.
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
pub(crate) const POSITION: [&str; 2] = ["position", "m"];
pub(crate) const TANGENTIAL: [&str; 2] = ["tangential_force", "n"];

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

    /// What it is called in JSON.
    pub fn name(&self) -> &'static str {
        let moves = self.column(POSITION[0]).is_some();
        if moves { "motion" } else { "history" }
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
        let name = self.name();
        map.serialize_entry(name, &rows.collect::<Vec<Named>>())?;
        map.serialize_entry(&format!("{name}_error"), &Named(errors.collect()))
    }
}

/// Numbers by their names.
struct Named(Vec<(&'static str, f64)>);

impl Serialize for Named {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}
