//! Grouping of the rows of a table into isotherms.

use std::collections::BTreeMap;

/// A measurement, in SI and in shear.
pub(super) struct IsothermRow {
    pub(super) line: usize,
    /// Angular frequency ω \[rad/s] or time t \[s], greater than 0.
    pub(super) at: f64,
    /// Moduli G' and G'' \[Pa], or G(t) or J(t) twice.
    pub(super) moduli: [f64; 2],
    /// Temperature in the unit of the table.
    pub(super) temperature: Option<f64>,
    /// Number of the isotherm, if the table has a column of it.
    pub(super) set: Option<f64>,
}

impl IsothermRow {
    /// Whether two rows of the same frequency repeat the same measurement.
    fn repeats(&self, other: &Self) -> bool {
        let moduli = |row: &Self| row.moduli.map(f64::to_bits);
        self.temperature == other.temperature && moduli(self) == moduli(other)
    }
}

/// Rows of one temperature.
pub(super) struct Group {
    /// First line of the group.
    pub(super) line: usize,
    /// Temperatures of all rows, in the unit of the table.
    pub(super) temperatures: Vec<f64>,
    set: Option<f64>,
    /// Rows by the bits of ω or t, whose order is that of the positive numbers.
    pub(super) rows: BTreeMap<u64, IsothermRow>,
}

/// Largest difference between the temperature of a row and that of the first row of its isotherm, \[K]. A row that differs
/// more belongs to another isotherm. Chosen: it is above the fluctuation of a temperature chamber and below the steps
/// between isotherms, usually 3 K or more.
const MAX_TEMPERATURE_DRIFT: f64 = 1.0;

/// Inserts a row into the isotherm of the nearest temperature without this frequency, or into a new one.
///
/// Frequencies and temperatures may come in any order; a repeated row counts once. The error is the expectation that a
/// second, different row of the same frequency and temperature violates.
pub(super) fn insert(groups: &mut Vec<Group>, row: IsothermRow) -> Result<(), &'static str> {
    let key = row.at.to_bits();
    let is_repeated = |group: &Group| group.rows.get(&key).is_some_and(|same| same.repeats(&row));
    if groups.iter().any(is_repeated) {
        return Ok(());
    }
    let distance = |group: &Group| group.distance(&row);
    if let Some(last) = groups.last()
        && let Some(same) = last.rows.get(&key)
        && distance(last).is_some()
        && (row.set.is_some() || same.temperature == row.temperature)
    {
        return Err("a value that no row before has at this temperature");
    }
    // Insert the row into the isotherm with the nearest temperature; among equally near ones the latest takes it.
    let latest = groups.iter_mut().rev();
    let free = latest.filter(|group| !group.rows.contains_key(&key));
    let near = free.filter_map(|group| Some((distance(group)?, group)));
    match near.min_by(|one, other| one.0.total_cmp(&other.0)) {
        Some((_, group)) => {
            group.temperatures.extend(row.temperature);
            group.rows.insert(key, row);
        }
        None => groups.push(Group {
            line: row.line,
            temperatures: row.temperature.into_iter().collect(),
            set: row.set,
            rows: BTreeMap::from([(key, row)]),
        }),
    }
    Ok(())
}

impl Group {
    /// Distance of a row from the first one in temperature, \[K]; `None` if it is of another isotherm.
    fn distance(&self, row: &IsothermRow) -> Option<f64> {
        if let (Some(set), Some(own)) = (row.set, self.set) {
            return set.total_cmp(&own).is_eq().then_some(0.0);
        }
        let both = row.temperature.zip(self.temperatures.first());
        let distance = both.map_or(0.0, |(temperature, first)| (temperature - first).abs());
        (distance <= MAX_TEMPERATURE_DRIFT).then_some(distance)
    }
}
