//! Comparison of measured friction with the computed friction of a sweep: points for the picture, and residuals.

use std::path::{Path, PathBuf};

use anyhow::Result;
use measurements::friction::{FrictionPoint, FrictionTable, FrictionTableOptions};
use viscofriction::WrongInput;
use viscofriction::numerics::Estimate;

use super::file::{RowTable, line};
use super::picture::{FRICTION, Key, abscissa, keys};
use crate::friction::read_points;
use crate::output::eprint_line;

/// Key over which measured and computed friction are compared.
pub(super) const SPEED: &str = "load.velocity";
/// Largest difference of the natural logarithms of two speeds that count as one. Chosen, above the rounding of the table.
const SAME_SPEED: f64 = 1e-9;
/// Largest relative difference between a measured normal force and that of a computed curve with which both are compared.
/// Chosen: it is the accuracy of a normal force that is held.
const SAME_FORCE: f64 = 0.02;
/// Largest difference between a measured temperature and that of a computed curve with which both are compared, \[K].
/// Chosen: it is the accuracy of a temperature that is held.
const SAME_TEMPERATURE: f64 = 1.0;
/// Smallest number of computed speeds for an interpolation. Derived: three define a parabola, whose difference from linear
/// interpolation is the error estimate.
const MIN_NODES: usize = 3;

/// A quantity of the table, other than the speed, on which friction depends.
struct Condition {
    name: &'static str,
    unit: &'static str,
    /// Key of the sweep that varies it.
    key: &'static str,
    /// Value of a point, in the unit of the condition; `None` if the table has none.
    value: fn(&FrictionPoint) -> Option<f64>,
    /// True if a measured and a computed value count as the same.
    is_same: fn(f64, f64) -> bool,
}

/// The quantities of the table that must equal those of a curve.
const CONDITIONS: [Condition; 2] = [
    Condition {
        name: "normal forces",
        unit: "N",
        key: "load.normal_force",
        value: |point| point.normal_force,
        is_same: |one, other| (one / other - 1.0).abs() <= SAME_FORCE,
    },
    Condition {
        name: "temperatures",
        unit: "°C",
        key: "material.file.temperature",
        value: |point| point.temperature,
        is_same: |one, other| (one - other).abs() <= SAME_TEMPERATURE,
    },
];

/// A table of measured friction.
pub(super) struct Measured {
    path: PathBuf,
    points: Vec<FrictionPoint>,
}

/// Differences between measured and computed friction.
pub(super) struct Residuals {
    /// A row for every point of every curve.
    pub(super) csv: String,
    /// Number of points with a residual, and their root mean square.
    pub(super) summary: String,
}

/// A measured point and the computed friction at its speed.
struct Compared<'a> {
    /// Cells of the varied keys other than the speed.
    cells: Vec<&'a str>,
    point: &'a FrictionPoint,
    /// `None` outside of the computed speeds.
    computed: Option<Estimate>,
}

impl Measured {
    /// Reads the table, and reports assumptions of the reader.
    pub(super) fn new(path: &Path, options: &FrictionTableOptions) -> Result<Self, WrongInput> {
        let FrictionTable { points, notes } = read_points(path, options)?;
        let wrong = |error| WrongInput(format!("{}: {error}", path.display()));
        FrictionPoint::check_all(&points).map_err(wrong)?;
        notes.iter().for_each(|note| eprint_line(note));
        Ok(Self {
            path: path.to_owned(),
            points,
        })
    }

    /// Rejects a table that has no point on a curve of the sweep. The rows need no results yet.
    pub(super) fn check(&self, table: &RowTable) -> Result<(), WrongInput> {
        let wrong = |problem: String| WrongInput(format!("{}: {problem}", self.path.display()));
        let keys = keys(table).map_err(|error| wrong(error.to_string()))?;
        let speeds = ends(self.points.iter().map(|point| point.velocity));
        let advice = format!(
            "--vary {SPEED}={:e}:{:e}:20:log covers the table",
            speeds[0], speeds[1]
        );
        // Measured points can only be drawn if the picture is over the speed, and if measured and computed speeds overlap.
        let over = abscissa(&keys).filter(|over| keys[*over].name == SPEED);
        let Some(over) = over else {
            return Err(wrong(format!(
                "measured friction is compared over the speed, and {SPEED} is not the key with the most numbers; {advice}"
            )));
        };
        let computed = ends(keys[over].numbers().into_iter().flatten());
        if speeds[0] > computed[1] || speeds[1] < computed[0] {
            return Err(wrong(format!(
                "its speeds, {}, are outside of those of the sweep, {}: is their unit in the table right? {advice}",
                range(speeds, "m/s"),
                range(computed, "m/s")
            )));
        }
        // Refuse a table whose normal forces or temperatures are not those of the computed curves.
        for condition in &CONDITIONS {
            let Condition {
                name, unit, key, ..
            } = condition;
            let measured: Vec<f64> = self.points.iter().filter_map(condition.value).collect();
            let Some(&first) = measured.first() else {
                continue;
            };
            let found = range(ends(measured.iter().copied()), unit);
            let Some(column) = keys.iter().find(|column| column.name == *key) else {
                if measured
                    .iter()
                    .all(|&value| (condition.is_same)(value, first))
                {
                    continue;
                }
                return Err(wrong(format!(
                    "it has several {name}, {found}, and the sweep only one; vary {key} too, or give a table of one of them"
                )));
            };
            let values: Vec<f64> = column.numbers().into_iter().flatten().collect();
            let is_known = |&one: &f64| values.iter().any(|&other| (condition.is_same)(one, other));
            if !measured.iter().any(is_known) {
                let varied = range(ends(values.iter().copied()), unit);
                return Err(wrong(format!(
                    "none of its {name}, {found}, is one of {key}, {varied}: is their unit in the table right?"
                )));
            }
        }
        Ok(())
    }

    /// Points under the conditions of a row, in the order of the table.
    pub(super) fn points_at(
        &self,
        keys: &[Key<'_>],
        row: usize,
    ) -> impl Iterator<Item = &FrictionPoint> {
        let given = |condition: &Condition| -> Option<f64> {
            let key = keys.iter().find(|key| key.name == condition.key)?;
            key.cells[row].parse().ok()
        };
        let given = CONDITIONS.each_ref().map(given);
        self.points.iter().filter(move |point| {
            CONDITIONS.iter().zip(given).all(|(condition, given)| {
                let values = (condition.value)(point).zip(given);
                values.is_none_or(|(one, other)| (condition.is_same)(one, other))
            })
        })
    }

    /// Residuals of the measured points on each computed curve.
    pub(super) fn residuals(&self, table: &RowTable) -> Result<Residuals> {
        // A curve is a combination of the other varied keys; along it friction is interpolated over the speed.
        let mut others = keys(table)?;
        let over = others.iter().position(|key| key.name == SPEED);
        let speeds = over.map(|over| others.remove(over).numbers());
        let compared = self.compared(&others, &speeds.unwrap_or_default(), table);
        let names = others.iter().map(|key| key.name);
        let results = [
            FRICTION,
            "standard_error",
            "computed",
            "computed_error",
            "residual",
        ];
        let header = std::iter::once(SPEED).chain(names).chain(results);
        let mut csv = line(&header.map(str::to_owned).collect::<Vec<_>>())?;
        let mut squares = Vec::new();
        for Compared {
            cells,
            point,
            computed,
        } in &compared
        {
            let measured = point.friction_coefficient;
            let residual = computed.map(|computed| measured - computed.value);
            squares.extend(residual.map(|residual| residual * residual));
            let numbers = [
                Some(measured),
                point.standard_error,
                computed.map(|computed| computed.value),
                computed.map(|computed| computed.error),
                residual,
            ];
            let cell = |number: Option<f64>| number.map_or(String::new(), |one| format!("{one:?}"));
            let fields: Vec<String> = std::iter::once(cell(Some(point.velocity)))
                .chain(cells.iter().map(|&cell| cell.to_owned()))
                .chain(numbers.map(cell))
                .collect();
            csv += &line(&fields)?;
        }
        let n = squares.len();
        let rms = (squares.iter().sum::<f64>() / n as f64).sqrt();
        let mut summary = format!(
            "{n} of {} measured points are within the computed speeds",
            compared.len()
        );
        if n > 0 {
            summary += &format!(": root mean square residual {rms:.2e}");
        }
        Ok(Residuals { csv, summary })
    }

    /// The points of each curve with the computed friction at their speeds, curve by curve.
    fn compared<'a>(
        &'a self,
        others: &[Key<'a>],
        speeds: &[Option<f64>],
        table: &RowTable,
    ) -> Vec<Compared<'a>> {
        let [values, errors] = ["", "_error"].map(|end| table.numbers(&format!("{FRICTION}{end}")));
        // Collect the computed friction over the speed, one curve for each combination of the other keys.
        let mut curves: Vec<Curve> = Vec::new();
        for (row, speed) in speeds.iter().enumerate() {
            let cells: Vec<&str> = others.iter().map(|key| key.cells[row]).collect();
            let known = curves.iter().position(|curve| curve.cells == cells);
            let curve = known.unwrap_or_else(|| {
                let nodes = Vec::new();
                curves.push(Curve { row, cells, nodes });
                curves.len() - 1
            });
            if let (Some(speed), Some(value)) = (speed.filter(|speed| *speed > 0.0), values[row]) {
                curves[curve].nodes.push(Node {
                    log_speed: speed.ln(),
                    friction: Estimate::new(value, errors[row].unwrap_or(0.0)),
                });
            }
        }
        // Interpolate the computed friction at the speeds of the points that were measured under the conditions of the curve.
        let mut compared = Vec::new();
        for Curve {
            row,
            cells,
            mut nodes,
        } in curves
        {
            nodes.sort_by(|one, other| one.log_speed.total_cmp(&other.log_speed));
            nodes.dedup_by(|one, other| one.log_speed - other.log_speed <= SAME_SPEED);
            compared.extend(self.points_at(others, row).map(|point| Compared {
                cells: cells.clone(),
                point,
                computed: interpolated(&nodes, point.velocity.ln()),
            }));
        }
        compared
    }
}

/// Rows of a sweep that differ in their speed only.
struct Curve<'a> {
    /// The first of the rows.
    row: usize,
    /// Cells of the varied keys other than the speed.
    cells: Vec<&'a str>,
    nodes: Vec<Node>,
}

/// Computed friction at the logarithm of a speed.
#[derive(Clone, Copy)]
struct Node {
    log_speed: f64,
    friction: Estimate,
}

/// Friction at the logarithm `at` of a speed, from nodes in increasing order. It is the mean of the two parabolas in ln v that
/// pass through both neighbours and one node more; at the ends there is one parabola. The error is that of the nodes plus the
/// largest difference of a parabola from linear interpolation. `None` outside of the nodes, and for fewer than [`MIN_NODES`].
fn interpolated(nodes: &[Node], at: f64) -> Option<Estimate> {
    let is_same = |node: &&Node| (node.log_speed - at).abs() <= SAME_SPEED;
    if let Some(node) = nodes.iter().find(is_same) {
        return Some(node.friction);
    }
    let above = nodes.partition_point(|node| node.log_speed < at);
    if above == 0 || above == nodes.len() || nodes.len() < MIN_NODES {
        return None;
    }
    let linear = lagrange_polynomial(&nodes[above - 1..=above], at).value;
    let first_nodes = [above.checked_sub(2), Some(above - 1)]
        .into_iter()
        .flatten();
    let parabolas = first_nodes.filter_map(|first| nodes.get(first..first + 3));
    let parabolas: Vec<Estimate> = parabolas
        .map(|nodes| lagrange_polynomial(nodes, at))
        .collect();
    let n = parabolas.len() as f64;
    let value = parabolas.iter().map(|found| found.value).sum::<f64>() / n;
    let of_nodes = parabolas.iter().map(|found| found.error).sum::<f64>() / n;
    let bends = parabolas.iter().map(|found| (found.value - linear).abs());
    Some(Estimate::new(value, of_nodes + bends.fold(0.0, f64::max)))
}

/// Lagrange's polynomial in ln v through the nodes, at the logarithm `at` of a speed, with the errors of the nodes propagated.
fn lagrange_polynomial(nodes: &[Node], at: f64) -> Estimate {
    let weight = |one: &Node| -> f64 {
        nodes
            .iter()
            .map(|node| node.log_speed)
            .filter(|other| other.total_cmp(&one.log_speed).is_ne())
            .map(|other| (at - other) / (one.log_speed - other))
            .product()
    };
    let terms = nodes.iter().map(|node| (weight(node), node.friction));
    terms.fold(Estimate::exact(0.0), |sum, (weight, friction)| {
        Estimate::new(
            sum.value + weight * friction.value,
            sum.error + weight.abs() * friction.error,
        )
    })
}

/// Smallest and largest of some numbers.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

/// A range as text, `0.1 to 10 UNIT`; a single number if its ends are equal.
fn range([low, high]: [f64; 2], unit: &str) -> String {
    if low < high {
        format!("{low:?} to {high:?} {unit}")
    } else {
        format!("{low:?} {unit}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors of the interpolation of a smooth curve are within its bars, and nodes are exact.
    #[test]
    fn interpolation_is_within_its_error() {
        let friction = |log_speed: f64| 0.1 / log_speed.cosh();
        let nodes: Vec<Node> = (-10..=10)
            .map(|index| {
                let log_speed = 0.3 * f64::from(index);
                let friction = Estimate::new(friction(log_speed), 1e-6);
                Node {
                    log_speed,
                    friction,
                }
            })
            .collect();
        assert_eq!(
            interpolated(&nodes, nodes[4].log_speed),
            Some(nodes[4].friction)
        );
        for index in 0..500 {
            let at = -3.0 + 6.0 * (f64::from(index) + 0.37) / 500.0;
            let found = interpolated(&nodes, at).expect("inside");
            let off = (found.value - friction(at)).abs();
            assert!(
                off <= found.error,
                "{at}: {found:?}, and {} is exact",
                friction(at)
            );
        }
        assert_eq!(interpolated(&nodes, 3.1), None, "above the nodes");
        assert_eq!(interpolated(&nodes[..2], -2.9), None, "two nodes");
    }
}
