//! The function s(p) that the paper does not give, from the table of `friction-analytic`.

use anyhow::{Result, ensure};
use friction_analytic::scaling_factor as tabulated;

use crate::figures::Part;
use crate::figures::factors::PAPER;
use crate::output::points;
use crate::scaling::{MAX_UNKNOWNS, Node, scaling_factor};
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

/// Name of table and picture.
pub(super) const NAME: &str = "scaling_function";
/// Number of rows of the table, evenly spaced in ln(2p − 1) with the exponent p. Chosen: more than twice the number of nodes
/// of the tabulated factor, so that the picture also shows the interpolation.
const ROWS: u32 = 181;
/// Smallest and largest 2p − 1, with the exponent p: nearly the range of the table of `friction-analytic`.
const ORDERS: [f64; 2] = [0.003, 127.0];
/// Exponents that the check solves anew, with the relative error requested of each. Chosen: they cover both sides of the
/// cone, and each reaches its error in little time.
const SOLVED_ANEW: [(f64, f64); 5] = [
    (0.7, 2e-3),
    (0.9, 2e-3),
    (1.5, 5e-4),
    (3.0, 1e-3),
    (6.0, 2e-3),
];

/// Table and picture of the scaling factor over the exponent.
pub(super) fn part() -> Result<Part> {
    let nodes = compute()?;
    Part::new(NAME, &nodes, [(NAME, figure(&nodes))])
}

/// Rows of the table, interpolated in the table of `friction-analytic`.
pub(super) fn compute() -> Result<Vec<Node>> {
    (0..ROWS).map(|index| node(exponent(index))).collect()
}

/// Exponent p of the row `index`, ascending.
fn exponent(index: u32) -> f64 {
    let fraction = f64::from(index) / f64::from(ROWS - 1);
    0.5 + 0.5 * ORDERS[0] * (ORDERS[1] / ORDERS[0]).powf(fraction)
}

/// s(p) at the exponent p, interpolated in the table; fails outside its range.
fn node(exponent: f64) -> Result<Node> {
    Ok(Node::new(exponent, tabulated(exponent)?))
}

/// Solves some exponents on the half space and compares them with the interpolated table, within both error bars; returns their
/// number.
pub(super) fn check_against_the_half_space() -> Result<usize> {
    for (exponent, relative_error) in SOLVED_ANEW {
        let tabulated = tabulated(exponent)?;
        let solved = scaling_factor(exponent, relative_error, MAX_UNKNOWNS)?.value();
        let difference = (tabulated.value - solved.value).abs();
        let allowed = tabulated.error + solved.error;
        ensure!(
            difference <= allowed,
            "s({exponent}): {} in the table, {} ± {:e} solved anew, off by {difference:e}, allowed {allowed:e}",
            tabulated.value,
            solved.value,
            solved.error
        );
    }
    Ok(SOLVED_ANEW.len())
}

/// Picture of the scaling factor over the exponent, with its relative error in a panel below.
fn figure(rows: &[Node]) -> Figure {
    let curve = |value: fn(&Node) -> f64| {
        let points = points(rows, |row| row.exponent, value);
        Series::line(points, Line::thick(Dash::Solid), Colour::Blue)
    };
    let paper = PAPER.map(|(p, s)| [p, s]).to_vec();
    let paper = Series::markers(paper, Marker::filled(Shape::Plus), Colour::Red);
    let function = vec![
        curve(|row| row.scaling_factor).labelled("boundary elements, converged"),
        paper.labelled("paper, p = 1 and 2"),
    ];
    let errors = vec![curve(|row| row.error / row.scaling_factor)];
    let factor = Axis::linear("scaling factor s(p)", [0.0, 0.8]);
    let error = Axis::log10("relative error bar", [1e-6, 1e-3]);
    let exponents = Axis::log10("exponent p", [0.4, 100.0]);
    let function = Chart::new(exponents.clone(), factor, function);
    Figure::new([function, Chart::new(exponents, error, errors)], 1)
}
