//! The contact of one instant, and the influence coefficients behind it.

use std::f64::consts::PI;

use anyhow::Result;
use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    influence, solve_contact,
};
use numerics::InvalidParameter;

use super::case::{Case, Comparison, Finding, cases, compare, refused};

/// Σ of 16 parts; far away also 1/r + h²/(24 r³) times the area, with an error of the order (h/r)⁴.
pub(super) fn far(distance: f64) -> Result<Finding> {
    let whole = influence([distance, 0.0], [1.0, 1.0]);
    let part = |k: i32| {
        let [x, y] = [k / 4, k % 4].map(|k| 0.25 * (f64::from(k) - 1.5));
        influence([distance + x, y], [0.25, 0.25])
    };
    let parts: f64 = (0..16).map(part).sum();
    let tolerance = 64.0 * f64::EPSILON;
    if distance < 1e4 {
        return compare!(within tolerance; "sum of parts" => whole, parts);
    }
    let exact = (1.0 + 1.0 / (24.0 * distance * distance)) / distance;
    compare!(within tolerance; "sum of parts" => whole, parts; "expansion" => whole, exact)
}

/// 2 b asinh(a/b) + 2 a asinh(b/a) in the middle of an element of edges a and b, a neighbour as the difference of
/// longer elements.
pub(super) fn slender(aspect: f64) -> Result<Finding> {
    let middle = |x: f64, y: f64| 2.0 * (y * (x / y).asinh() + x * (y / x).asinh());
    let neighbour = 0.5 * (middle(3.0, aspect) - middle(1.0, aspect));
    // The difference loses a digit or two where the elements are long.
    compare!(within 1e3 * f64::EPSILON;
        "own" => influence([0.0; 2], [1.0, aspect]), middle(1.0, aspect);
        "neighbour" => influence([1.0, 0.0], [1.0, aspect]), neighbour)
}

/// A contact on a compliance of 1 1/Pa from a cold start, and whether its pressure solves it.
fn to_tolerance(
    grid: &Grid,
    separation: &[f64],
    control: Control,
    options: &ContactOptions,
) -> Result<Finding, BemError> {
    let convolution = Convolution::new(grid);
    let mut state = ContactState::new(&convolution);
    let problem = ContactProblem {
        convolution: &convolution,
        separation,
        compliance: 1.0,
        control,
    };
    let contact = solve_contact(&problem, &mut state, options)?;
    // What the option promises, and the rounding of two different sums.
    let tolerance = 1.01 * options.tolerance;
    Ok(conditions(&problem, &contact, state.pressure(), tolerance))
}

/// Whether a pressure solves a contact, by sums over all pairs of elements: a contact has one solution, so that
/// conditions which hold are as good as a second solver. The gap is zero under load and nowhere negative, no pressure is negative, and the force is
/// the sum of the pressures.
///
/// Gaps are relative to the largest displacement, as in `ContactOptions::tolerance`.
fn conditions(
    problem: &ContactProblem,
    contact: &Contact,
    pressure: &[f64],
    tolerance: f64,
) -> Finding {
    let displacement = displacement(problem, pressure);
    let largest = displacement.iter().copied().fold(0.0, f64::max);
    let elements = problem.separation.iter().zip(&displacement).zip(pressure);
    let violations = elements.map(|((separation, moved), load)| {
        let gap = separation + moved - contact.indentation_depth;
        if *load > 0.0 { gap.abs() } else { -gap }
    });
    // Unlike `f64::max` this keeps what is not a number.
    let keeps = |worst: f64, violation| violation <= worst || worst.is_nan();
    let worst = violations.fold(
        0.0,
        |worst, next| if keeps(worst, next) { worst } else { next },
    );
    let lowest = pressure.iter().copied().fold(0.0, f64::min);
    let area = problem.convolution.grid().element_area();
    let force = area * pressure.iter().sum::<f64>();
    let (name, got, prescribed) = match problem.control {
        Control::NormalForce(prescribed) => ("prescribed force", force, prescribed),
        Control::IndentationDepth(prescribed) => {
            ("prescribed depth", contact.indentation_depth, prescribed)
        }
    };
    Finding::of(&[
        Comparison::relative("gap", worst, 0.0, tolerance).in_units_of(largest),
        Comparison::relative("tension", lowest, 0.0, 0.0).in_units_of(1.0),
        Comparison::relative("force", force, contact.normal_force, 1e-12).in_units_of(force),
        Comparison::relative(name, got, prescribed, 1e-12),
    ])
}

fn displacement(problem: &ContactProblem, pressure: &[f64]) -> Vec<f64> {
    let grid = problem.convolution.grid();
    let ([n_x, n_y], [dx, dy]) = (grid.shape(), grid.spacing());
    let factor = problem.compliance / (4.0 * PI);
    let kernel: Vec<f64> = (0..n_x * n_y)
        .map(|k| [dx * (k / n_y) as f64, dy * (k % n_y) as f64])
        .map(|offset| factor * influence(offset, [dx, dy]))
        .collect();
    let mut displacement = vec![0.0; n_x * n_y];
    for (source, load) in pressure.iter().enumerate().filter(|(_, load)| **load > 0.0) {
        let [row, column] = [source / n_y, source % n_y];
        for (target_row, values) in displacement.chunks_exact_mut(n_y).enumerate() {
            let kernel = &kernel[target_row.abs_diff(row) * n_y..][..n_y];
            for (target, value) in values.iter_mut().enumerate() {
                *value += kernel[target.abs_diff(column)] * load;
            }
        }
    }
    displacement
}

fn solved(grid: &Grid, separation: &[f64], control: Control) -> Result<Finding, BemError> {
    to_tolerance(grid, separation, control, &ContactOptions::default())
}

/// Heights over the elements of a grid around the origin.
fn heights(grid: &Grid, height: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let ([n_x, n_y], [dx, dy]) = (grid.shape(), grid.spacing());
    let position = |k: usize, n: usize, spacing: f64| spacing * (k as f64 - 0.5 * (n - 1) as f64);
    (0..n_x * n_y)
        .map(|k| height(position(k / n_y, n_x, dx), position(k % n_y, n_y, dy)))
        .collect()
}

/// A paraboloid with its tip over an element; small forces load that one, large ones the whole box.
pub(super) fn any_force(force: f64) -> Result<Finding> {
    let grid = Grid::new([33, 33], [1.0, 1.0])?;
    let separation = heights(&grid, |x, y| x * x + y * y);
    Ok(solved(&grid, &separation, Control::NormalForce(force))?)
}

pub(super) fn slender_contact(aspect: f64) -> Result<Finding> {
    let grid = Grid::new([48, 48], [1.0, aspect])?;
    let separation = heights(&grid, |x, y| x * x + (y / aspect).powi(2));
    let control = Control::IndentationDepth(300.0);
    Ok(solved(&grid, &separation, control)?)
}

/// A carton of eggs of different heights, each of which touches.
pub(super) fn patches(count: f64) -> Result<Finding> {
    let grid = Grid::new([128, 128], [1.0, 1.0])?;
    let waves = PI * count.sqrt() / 128.0;
    let separation = heights(&grid, |x, y| {
        let [phase_x, phase_y] = [x, y].map(|along| waves * (along + 64.0));
        let uneven = 0.1 * (1.0 + (7.3 * (phase_x / 3.1).floor() + 3.7 * phase_y).sin());
        1.0 - (phase_x.sin() * phase_y.sin()).powi(2) + uneven
    });
    let control = Control::IndentationDepth(0.6);
    Ok(solved(&grid, &separation, control)?)
}

/// Heights that are large beside what the pressure moves: rounding of the heights is all that can be seen of a gap.
pub(super) fn high_above(height: f64) -> Result<Finding> {
    let grid = Grid::new([17, 17], [1.0, 1.0])?;
    let separation = heights(&grid, |x, y| height + 0.01 * (x * x + y * y));
    let options = ContactOptions {
        tolerance: (64.0 * f64::EPSILON * height).clamp(1e-9, 1e-2),
        ..ContactOptions::default()
    };
    let control = Control::NormalForce(10.0);
    Ok(to_tolerance(&grid, &separation, control, &options)?)
}

pub(super) fn unusual_heights() -> Vec<Case> {
    let corner = |height: f64| {
        let solved = with_corner(height, Control::NormalForce(1.0))?;
        refused!(solved => BemError::InvalidHeight { row: 0, column: 0, .. })
    };
    let control = |control: Control| {
        let solved = with_corner(1.0, control)?;
        refused!(solved => BemError::InvalidParameter(InvalidParameter {
            parameter: "normal_force" | "indentation_depth",
            ..
        }))
    };
    cases! {
        "NaN" => corner(f64::NAN);
        "-inf" => corner(f64::NEG_INFINITY);
        "tension" => control(Control::NormalForce(-1.0));
        "depth ∞" => control(Control::IndentationDepth(f64::INFINITY));
        "a hole" => a_hole();
        "no body" => no_body();
    }
}

/// A small contact with one corner of another height.
fn with_corner(corner: f64, control: Control) -> Result<Result<Finding, BemError>> {
    let grid = Grid::new([5, 5], [1.0, 1.0])?;
    let mut separation = heights(&grid, |x, y| x * x + y * y);
    separation[0] = corner;
    Ok(solved(&grid, &separation, control))
}

fn a_hole() -> Result<Finding> {
    let grid = Grid::new([9, 9], [1.0, 1.0])?;
    let body = |x: f64, y: f64| {
        if x == 0.0 {
            f64::INFINITY
        } else {
            x * x + y * y
        }
    };
    Ok(solved(
        &grid,
        &heights(&grid, body),
        Control::NormalForce(40.0),
    )?)
}

fn no_body() -> Result<Finding> {
    let (grid, force) = (Grid::new([9, 9], [1.0, 1.0])?, Control::NormalForce(1.0));
    let solved = solved(&grid, &[f64::INFINITY; 81], force);
    refused!(solved => BemError::InvalidParameter(InvalidParameter { parameter: "separation", .. }))
}
