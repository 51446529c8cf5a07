//! Figs. 7 and 8: friction over sliding speed by theory, chain and half space.

use anyhow::{Context, Result};
use indenters::{IndenterError, PowerProfile, SlidingLoad};
use rheology::Viscous;
use serde::Serialize;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

use crate::figures::{Part, chain, factors};
use crate::output::points;
use crate::scene::Scene;
use crate::tasks::in_parallel;

/// Slope of the cone, as Kürschner (2014) gives it.
const CONE_SLOPE: f64 = 0.1;
/// Coefficient c of the paraboloid c r² at the radius r, \[1/m]. Chosen, with force and viscosity: contacts measure from 0.1
/// mm to 2 cm.
const CURVATURE: f64 = 10.0;
/// Normal force on both bodies, \[N]. Chosen, see [`CURVATURE`].
const NORMAL_FORCE: f64 = 1.0;
/// Viscosity η of the half space, \[Pa s]. Chosen, see [`CURVATURE`].
const VISCOSITY: f64 = 1e5;
/// Number of speeds from 10⁻³ to 10⁻¹ m/s. Chosen: six per decade.
pub(super) const SPEEDS: u32 = 13;
/// Ratio of the sliding distance on the half space to the contact length of the one-dimensional model. Chosen: it ends with
/// a drift below [`DRIFT_TOLERANCE`], and the remaining change to the stationary state is extrapolated.
const SLIDING_LENGTHS: f64 = 32.0;
/// Smallest number of elements along the contact length of the one-dimensional model. Chosen: the grids are small, because
/// there are 26 simulations.
const MIN_ELEMENTS: f64 = 12.0;
/// Largest relative change of friction over the second half of the distance with which the end may be extrapolated. Chosen:
/// the extrapolation removes most of the remaining change, which is of the same order.
const DRIFT_TOLERANCE: f64 = 0.03;
/// Label of the ordinate of the figures.
const FRICTION: &str = "coefficient of friction μ";

/// The indenter of a figure.
pub(super) struct Indenter {
    title: &'static str,
    /// Name of the table.
    pub(super) name: &'static str,
    /// Names of the pictures, and their axes of friction.
    pictures: &'static [Picture],
    /// Exponent p of the profile.
    pub(super) exponent: f64,
    body: fn() -> Result<PowerProfile, IndenterError>,
}

/// Name of a picture, and its axis of friction.
type Picture = (&'static str, fn() -> Axis);

/// The indenter of Fig. 7 of Kürschner (2014).
pub(super) const CONE: Indenter = Indenter {
    title: "Fig. 7, cone",
    name: "fig7_cone",
    pictures: &[("fig7_cone", || Axis::linear(FRICTION, [0.0, 0.2]))],
    exponent: 1.0,
    body: || PowerProfile::cone(CONE_SLOPE),
};
/// The indenter of Fig. 8 of Kürschner (2014).
pub(super) const PARABOLOID: Indenter = Indenter {
    title: "Fig. 8, paraboloid",
    name: "fig8_paraboloid",
    pictures: &[
        ("fig8_paraboloid", || Axis::linear(FRICTION, [0.0, 0.35])),
        ("fig8_paraboloid_log", || Axis::log10(FRICTION, [0.01, 1.0])),
    ],
    exponent: 2.0,
    body: || PowerProfile::paraboloid(CURVATURE),
};

/// Friction coefficients at one speed. Columns with a unit have it in their name.
#[derive(Debug, Serialize)]
pub(super) struct Row {
    velocity_m_per_s: f64,
    /// Closed form, Eqs. (21) and (22) of Kürschner (2014).
    theory: f64,
    chain: f64,
    /// Friction on the half space, extrapolated to an infinite sliding distance; below the error of the extrapolation.
    half_space: f64,
    half_space_distance_error: f64,
    /// At the end of the run, with the slope at the end of the step: the plain reading of the paper.
    half_space_plain: f64,
    /// Theory times the converged scaling factor.
    scaled_theory: f64,
    spacing_m: f64,
    elements_along_contact: f64,
    sliding_distance_m: f64,
    /// Relative change of the half space's friction over the second half of the distance.
    drift: f64,
}

/// The table and pictures of an indenter. Every speed is computed anew, although by similarity one would do.
pub(super) fn part(indenter: &Indenter, factor: &factors::Row) -> Result<Part> {
    let speeds: Vec<u32> = (0..SPEEDS).collect();
    let rows = in_parallel(indenter.title, &speeds, |&speed| {
        row(indenter, speed, factor.converged)
    })?;
    let figure = |(name, y): &Picture| (*name, Figure::single(chart(&rows, factor.paper, y())));
    let pictures: Vec<_> = indenter.pictures.iter().map(figure).collect();
    Part::new(indenter.name, &rows, pictures)
}

/// The row of the speed of index `speed`, counted from the slowest; `factor` is the converged scaling factor.
pub(super) fn row(indenter: &Indenter, speed: u32, factor: f64) -> Result<Row> {
    let velocity = 10.0_f64.powf(f64::from(speed) / 6.0 - 3.0);
    let scene = Scene {
        body: (indenter.body)()?,
        material: Viscous::new(VISCOSITY)?,
        load: SlidingLoad::new(NORMAL_FORCE, velocity)?,
    };
    let theory = scene.theory()?;
    let spacing = spacing(theory.contact_length());
    let chain = chain::slide(&scene, spacing)?;
    let last = chain.last().context("a chain that did not move")?;
    let transient = scene.half_space(spacing, SLIDING_LENGTHS)?;
    let stationary = transient.stationary(DRIFT_TOLERANCE)?;
    Ok(Row {
        velocity_m_per_s: velocity,
        theory: theory.friction_coefficient,
        chain: last.friction_coefficient,
        half_space: stationary.friction_coefficient,
        half_space_distance_error: stationary.distance_error,
        half_space_plain: transient.last().friction_coefficient_end_of_step,
        scaled_theory: factor * theory.friction_coefficient,
        spacing_m: spacing,
        elements_along_contact: theory.contact_length() / spacing,
        sliding_distance_m: transient.last().sliding_distance,
        drift: stationary.drift,
    })
}

/// The coarsest spacing 2^k mm, k whole, with at least [`MIN_ELEMENTS`] along a contact length \[m]; in metres. With a spacing
/// proportional to the contact the discrete problems of all speeds would be similar, so that they would test nothing.
fn spacing(contact_length: f64) -> f64 {
    let millimetre = 1e-3;
    let steps = (contact_length / MIN_ELEMENTS / millimetre).log2().floor();
    millimetre * steps.exp2()
}

/// Friction over the speed, with the paper's factor of the body.
fn chart(rows: &[Row], paper: f64, y: Axis) -> Chart {
    let points = |value: fn(&Row) -> f64| points(rows, |row| row.velocity_m_per_s, value);
    let [squares, circles] = [Shape::Square, Shape::Circle].map(Marker::open);
    let crosses = Marker::filled(Shape::Plus);
    let line = Line::thick(Dash::Solid);
    let theory = Series::line(points(|row| row.theory), line, Colour::Blue);
    let chain = Series::markers(points(|row| row.chain), squares, Colour::Blue);
    let scaled = Series::markers(points(|row| row.scaled_theory), circles, Colour::Black);
    let theory_times_paper = points(|row| row.theory)
        .into_iter()
        .map(|[speed, theory]| [speed, paper * theory]);
    let dashed = Line::thin(Dash::Dashed);
    let of_paper = Series::line(theory_times_paper.collect(), dashed, Colour::Black);
    let errors = rows.iter().map(|row| row.half_space_distance_error);
    let half_space = Series {
        errors: errors.collect(),
        ..Series::markers(points(|row| row.half_space), crosses, Colour::Red)
    };
    let series = vec![
        theory.labelled("theory (MDR)"),
        chain.labelled("chain of dashpots (MDR)"),
        scaled.labelled("theory × converged factor"),
        of_paper.labelled(format!("theory × {paper} (paper)")),
        // Draw this series last, because it would vanish behind the open circles.
        half_space.labelled("half space (BEM)"),
    ];
    let x = Axis::log10("sliding speed v [m/s]", [8e-4, 1.25e-1]);
    Chart::new(x, y, series)
}
