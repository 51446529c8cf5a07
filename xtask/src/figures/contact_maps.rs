//! The stationary contacts as maps of the pressure.

use crate::figures::stationary::Contact;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

/// Ranges of x and y of every panel, in contact lengths of the one-dimensional model. Chosen: all contacts fit in, and share
/// one scale.
const WINDOW: [[f64; 2]; 2] = [[-0.2, 1.8], [-1.4, 1.4]];
/// Ratio of pressure to mean pressure above which all pressures share a colour. Chosen, since there is no upper bound along the
/// front edge.
const MAX_DRAWN_PRESSURE: f64 = 3.0;
/// Number of elements along each edge of a cell of the map. Chosen: the means over four elements still show the rise at the
/// edges, with a quarter of the size of the file.
const ELEMENTS_PER_CELL: usize = 2;
/// Number of straight pieces of the arc that [`circle`] draws. Chosen: an angle of 2.3° between them is too small to be
/// seen.
const CIRCLE_STEPS: u32 = 90;

/// Figure with one map of the pressure for each contact.
pub(super) fn figure(contacts: &[Contact]) -> Figure {
    Figure::new(contacts.iter().map(map), 2)
}

/// Ratio of the pressure to its mean, the outline of the contact, the circle of the contact length, and the lowest point of the
/// body.
fn map(contact: &Contact) -> Chart {
    // Choose the number of cells for the window, which is two contact lengths long and 2.8 wide.
    let cells = [10, 14].map(|fifths| fifths * contact.elements / 5 / ELEMENTS_PER_CELL);
    let colours = Axis::linear("P / mean P", [0.0, MAX_DRAWN_PRESSURE]);
    let field = Field::new(cells, colours, |column, row| {
        pressure(contact, [column, row])
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

/// Mean of the pressures over the loaded elements of a cell `[column, row]`; `None` where half of them or more are free.
fn pressure(contact: &Contact, cell: [usize; 2]) -> Option<f64> {
    let centre = |axis: usize, step: usize| {
        let element = (cell[axis] * ELEMENTS_PER_CELL + step) as f64 + 0.5;
        WINDOW[axis][0] + element / contact.elements as f64
    };
    let pressures = (0..ELEMENTS_PER_CELL * ELEMENTS_PER_CELL).map(|index| {
        contact.pressure([
            centre(0, index / ELEMENTS_PER_CELL),
            centre(1, index % ELEMENTS_PER_CELL),
        ])
    });
    let loads: Vec<f64> = pressures.filter(|pressure| *pressure > 0.0).collect();
    let mean = loads.iter().sum::<f64>() / loads.len() as f64;
    (2 * loads.len() > ELEMENTS_PER_CELL * ELEMENTS_PER_CELL).then(|| mean.min(MAX_DRAWN_PRESSURE))
}

/// The closed outline of a contact, along the front and back along the rear, one point for each row of cells.
fn outline(contact: &Contact) -> Series {
    let rows = || contact.outline.iter().step_by(ELEMENTS_PER_CELL);
    let front = rows().map(|row| [row.front, row.y]);
    let rear = rows().map(|row| [row.rear, row.y]);
    let mut points: Vec<[f64; 2]> = front.chain(rear.rev()).collect();
    points.extend(points.first().copied());
    Series::line(points, Line::thin(Dash::Solid), Colour::Black)
}

/// The circle around the lowest point whose radius is one contact length, as far as the window shows it.
fn circle() -> Series {
    let last = WINDOW[0][0].acos();
    let angle = |step: u32| last * (2.0 * f64::from(step) / f64::from(CIRCLE_STEPS) - 1.0);
    let points = (0..=CIRCLE_STEPS).map(|step| [angle(step).cos(), angle(step).sin()]);
    Series::line(points.collect(), Line::thin(Dash::Dotted), Colour::Black)
}
