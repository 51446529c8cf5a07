//! The stationary contacts as maps of the pressure.

use crate::figures::stationary::{Contact, Row};
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

/// Window of every panel, in contact lengths of the one-dimensional model.
const WINDOW: [[f64; 2]; 2] = [[-0.2, 1.8], [-1.4, 1.4]];
/// Pressures above this many times the mean share a colour: along the front edge they have no limit.
pub(super) const BRIGHTEST: f64 = 3.0;
/// Elements that share a cell of the map, along x and along y.
const SHARE: usize = 2;
/// Steps of the circle from one end to the other.
const ARC: u32 = 90;

pub(super) fn figure(contacts: &[Contact]) -> Figure {
    Figure::new(contacts.iter().map(map), 2)
}

/// Lengths of the contacts along their middle, and breadths to a side.
pub(super) fn extents(contacts: &[Contact]) -> [String; 2] {
    let list = |value: fn(&Contact) -> f64| {
        let values = contacts.iter().map(value);
        let values = values.map(|value| format!("{value:.2}"));
        values.collect::<Vec<_>>().join(", ")
    };
    [
        list(|contact| contact.middle().front - contact.middle().rear),
        list(Contact::half_breadth),
    ]
}

fn map(contact: &Contact) -> Chart {
    let cell = SHARE as f64 / contact.elements as f64;
    let cells = WINDOW.map(|[from, to]| whole((to - from) / cell));
    let colours = Axis::linear("P / mean P", [0.0, BRIGHTEST]);
    let field = Field::new(cells, colours, |column, row| {
        let corner = [(0, column), (1, row)]
            .map(|(axis, step): (usize, usize)| WINDOW[axis][0] + step as f64 * cell);
        pressure(contact, corner)
    });
    let x = Axis::linear("x / contact length,  motion →", WINDOW[0]);
    let y = Axis::linear("y / contact length", WINDOW[1]);
    let lowest = Series::markers(vec![[0.0, 0.0]], Marker::filled(Shape::Plus), Colour::Red);
    Chart {
        title: Some(format!("h = c rᵖ, p = {}", contact.exponent)),
        series: vec![outline(contact), circle(), lowest],
        ..Chart::map(x, y, field)
    }
}

/// Mean over the elements of a cell, given by its corner; none where half of them or more are free.
fn pressure(contact: &Contact, corner: [f64; 2]) -> Option<f64> {
    let element = 1.0 / contact.elements as f64;
    let centre = |axis: usize, step: usize| corner[axis] + (0.5 + step as f64) * element;
    let pressures = (0..SHARE * SHARE)
        .map(|index| contact.pressure([centre(0, index / SHARE), centre(1, index % SHARE)]));
    let loads: Vec<f64> = pressures.filter(|pressure| *pressure > 0.0).collect();
    let mean = loads.iter().sum::<f64>() / loads.len() as f64;
    (2 * loads.len() > SHARE * SHARE).then(|| mean.min(BRIGHTEST))
}

/// Along the front from right to left, and back along the rear; a point for the columns that share a cell.
fn outline(contact: &Contact) -> Series {
    let columns = || contact.outline.chunks(SHARE);
    let front = columns().map(|rows| [mean(rows, |row| row.front), mean(rows, |row| row.y)]);
    let rear = columns().map(|rows| [mean(rows, |row| row.rear), mean(rows, |row| row.y)]);
    let mut points: Vec<[f64; 2]> = front.chain(rear.rev()).collect();
    points.extend(points.first().copied());
    Series::line(points, Line::thin(Dash::Solid), Colour::Black)
}

/// Mean of neighbouring columns.
fn mean(rows: &[Row], value: fn(&Row) -> f64) -> f64 {
    rows.iter().map(value).sum::<f64>() / rows.len() as f64
}

/// Points at one contact length from the lowest point, as far as the window shows them.
fn circle() -> Series {
    let last = WINDOW[0][0].acos();
    let angle = |step: u32| last * (2.0 * f64::from(step) / f64::from(ARC) - 1.0);
    let points = (0..=ARC).map(|step| [angle(step).cos(), angle(step).sin()]);
    Series::line(points.collect(), Line::thin(Dash::Dotted), Colour::Black)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number of cells"
)]
fn whole(count: f64) -> usize {
    count.round() as usize
}
