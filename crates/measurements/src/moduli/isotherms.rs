//! Rows of a table by their temperatures.

use std::collections::BTreeMap;

/// A measurement, in SI and in shear.
pub(super) struct IsothermRow {
    pub(super) line: usize,
    /// ω or t, greater than 0.
    pub(super) at: f64,
    /// G' and G'', or G(t) twice.
    pub(super) moduli: [f64; 2],
    pub(super) temperature: Option<f64>,
    pub(super) set: Option<f64>,
}

impl IsothermRow {
    /// Whether this is the same measurement a second time, of the same temperature and at the same frequency.
    fn repeats(&self, other: &Self) -> bool {
        let moduli = |row: &Self| row.moduli.map(f64::to_bits);
        self.temperature == other.temperature && moduli(self) == moduli(other)
    }
}

/// Rows of one temperature.
pub(super) struct Group {
    /// Where it begins.
    pub(super) line: usize,
    pub(super) temperatures: Vec<f64>,
    set: Option<f64>,
    /// By the bits of ω or t, which are in the order of the numbers.
    pub(super) rows: BTreeMap<u64, IsothermRow>,
}

/// Within an isotherm the temperature may drift by this much, \[K].
const DRIFT: f64 = 1.0;

/// Puts a row into the isotherm of the nearest temperature where its frequency is missing, or into a new one. The
/// frequencies may come in any order, and so may the temperatures, and a row that is there already counts once; says what was expected when the latest isotherm has a row
/// of this frequency and temperature.
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
    /// How far a row is from the first one in temperature, where it may be of this isotherm.
    fn distance(&self, row: &IsothermRow) -> Option<f64> {
        if let (Some(set), Some(own)) = (row.set, self.set) {
            return set.total_cmp(&own).is_eq().then_some(0.0);
        }
        let both = row.temperature.zip(self.temperatures.first());
        let distance = both.map_or(0.0, |(temperature, first)| (temperature - first).abs());
        (distance <= DRIFT).then_some(distance)
    }
}
