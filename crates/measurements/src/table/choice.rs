//! Selection of columns of a table.

use super::Column;
use super::columns::{Half, Quantity, half_of};

/// Keeps the columns of one half of a ramp, if the halves are marked; unmarked columns belong to both halves.
pub(super) fn retain_half(columns: &mut Vec<Column>, half: Option<Half>) {
    if half.is_none() {
        return;
    }
    let is_marked = |column: &Column| half_of(column.name) == half;
    let marked = columns.iter().filter(|one| is_marked(one));
    let marked: Vec<Quantity> = marked.map(|one| one.quantity).collect();
    columns.retain(|one| {
        let is_shared = half_of(one.name).is_none() && !marked.contains(&one.quantity);
        is_marked(one) || is_shared
    });
}

/// Keeps the columns of each quantity that come first by their names, then by their units.
pub(super) fn retain_first(columns: &mut Vec<Column>) {
    let rank = |column: &Column| {
        let mut units = column.quantity.units().split(' ');
        let known = column.quantity.unit(column.unit);
        let place = known.and_then(|(known, _)| units.position(|unit| unit == known));
        // Units of the quantity precede those of another one, such as volts for a force.
        let is_other = place.is_none() && !column.unit.is_empty();
        (column.order, is_other, place)
    };
    let ranks = columns.iter().map(|one| (one.quantity, rank(one)));
    let ranks: Vec<_> = ranks.collect();
    let is_first = |one: &Column| {
        let mut others = ranks
            .iter()
            .filter(|(quantity, _)| *quantity == one.quantity);
        others.all(|(_, other)| *other >= rank(one))
    };
    columns.retain(is_first);
}
