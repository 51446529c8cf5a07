//! The stationary contacts as maps of the pressure.

use crate::figures::stationary::{Contact, Row};
use viscofriction_plot::{
    Axis, Colour, ColourScale, Dash, Figure, Line, Map, Marker, Proportions, Series, Shape,
};

/// Window of every panel, in contact lengths of the one-dimensional model.
const WINDOW: [[f64; 2]; 2] = [[-0.2, 1.8], [-1.4, 1.4]];
/// Pressures above this many times the mean share a colour: along the front edge they have no limit.
const BRIGHTEST: f64 = 3.0;
/// Elements that share a cell of the map, along x and along y.
const SHARE: usize = 2;
/// Steps of the circle from one end to the other.
const ARC: u32 = 90;

pub(super) fn figure(contacts: &[Contact]) -> Figure {
    Figure::new(contacts.iter().map(map), 2)
}

/// What the maps show, with the length of the contact along its middle and its breadth.
pub(super) fn caption(contacts: &[Contact]) -> String {
    let list = |value: fn(&Contact) -> f64| {
        let values = contacts
            .iter()
            .map(value)
            .map(|value| format!("{value:.2}"));
        values.collect::<Vec<_>>().join(", ")
    };
    format!(
        "Stationary contact of the profiles c r<sup>p</sup>, seen from above: the body moves to the right, the cross is \
         its lowest point. All lengths are in contact lengths of the one-dimensional model, whose contact reaches from \
         that point to the dotted circle. Only the front half touches. Along the front edge the pressure is singular, \
         like the inverse square root of the distance, so that it has no largest value; colours end at {BRIGHTEST} \
         times the mean pressure and are the same above. At the rear it falls to zero smoothly. \
         The contact of the cone reaches back to its tip, where the pressure is singular too; with growing p the contact \
         withdraws to the steep rim of the body, a crescent that narrows. For p = 1, 2, 4, 16 it is {} long in its \
         middle, and {} broad from the middle to a side.",
        list(|contact| contact.middle().front - contact.middle().rear),
        list(Contact::half_breadth),
    )
}

fn map(contact: &Contact) -> Map {
    let cell = SHARE as f64 / contact.elements as f64;
    let cells = WINDOW.map(|[from, to]| whole((to - from) / cell));
    let values = (0..cells[0] * cells[1]).map(|index| {
        let corner = [(0, index % cells[0]), (1, index / cells[0])]
            .map(|(axis, step)| WINDOW[axis][0] + step as f64 * cell);
        pressure(contact, corner)
    });
    Map {
        title: Some(format!("h = c rᵖ, p = {}", contact.exponent)),
        x: Axis::linear("x / contact length,  motion →", WINDOW[0]),
        y: Axis::linear("y / contact length", WINDOW[1]),
        columns: cells[0],
        values: values.collect(),
        colours: ColourScale::new("P / mean P", [0.0, BRIGHTEST]),
        proportions: Proportions::True,
        overlays: vec![
            outline(contact),
            circle(),
            Series::markers(vec![[0.0, 0.0]], Marker::filled(Shape::Plus), Colour::Red),
        ],
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
