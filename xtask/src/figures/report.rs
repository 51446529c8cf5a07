//! The page that shows every figure beside the paper's statement about it.

use std::fmt::Write as _;

use anyhow::Result;
use serde::Serialize;

use crate::figures::friction_over_speed::{
    CONE_SLOPE, CURVATURE, NORMAL_FORCE, Row, SLIDING_LENGTHS, VISCOSITY,
};
use crate::figures::pictures::Picture;
use crate::figures::{Data, factors};
use crate::output::to_csv;

const STYLE: &str = "body{font:16px/1.5 Georgia,serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#111}\
h1,h2{font-weight:normal;line-height:1.2}h2{margin-top:3rem;border-bottom:1px solid #bbb}\
figure{margin:1.5rem 0}figure svg{width:100%;max-width:44rem;height:auto}figcaption{font-size:.9rem;color:#333}\
table{border-collapse:collapse;font-size:.85rem;margin:1rem 0}th,td{border-bottom:1px solid #ddd;padding:.2rem .6rem;text-align:right}\
th{border-bottom:1px solid #333;font-weight:normal;vertical-align:bottom}td:first-child,th:first-child{text-align:left}\
.paper{border-left:3px solid #999;padding-left:1rem;color:#333}details{margin:1rem 0}.wide{overflow-x:auto}";

/// Picture of `cargo xtask evidence stability`, which the figures do not recompute.
const STABILITY: &str = include_str!("../../../docs/figures/stability.svg");

pub(super) fn html(data: &Data, pictures: &[Picture]) -> Result<String> {
    let mut page = String::new();
    write!(
        page,
        "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\">\
         <title>Friction on a viscous half space</title><style>{STYLE}</style></head><body>\
         <h1>Friction between a rigid body and a viscous half space</h1>\
         <p>Every number on this page, up to the last section, was computed by <code>cargo xtask reproduce-figures</code>, \
         version {}. \
         The statements beside the figures are those of S. Kürschner, <i>Friction between a rigid body and a model \
         elastomer having a linear viscous rheology</i>, Z. Angew. Math. Mech. (2014).</p>",
        env!("CARGO_PKG_VERSION")
    )?;
    write_factors(&mut page, &data.factors)?;
    write_loss_tangent(&mut page, data, pictures)?;
    write_friction(&mut page, &data.cone, pictures, &CONE)?;
    write_friction(&mut page, &data.paraboloid, pictures, &PARABOLOID)?;
    write_approach(&mut page, pictures)?;
    write_scaling_function(&mut page, pictures)?;
    page.push_str(
        "<h2>The stationary contact</h2><p>Not in the paper; from the stationary problem, solved directly.</p>",
    );
    write_picture(&mut page, pictures, "stationary_contact")?;
    write!(
        page,
        "<h2>Stiff and extreme cases</h2><p>Not in the paper; as committed, from <code>cargo xtask evidence stability</code>: one \
         row per family, one cell per case.</p><figure>{STABILITY}</figure>"
    )?;
    page.push_str(NOT_STATED);
    page.push_str(WORK_PRECISION);
    page.push_str("</body></html>\n");
    Ok(page)
}

fn write_factors(page: &mut String, rows: &[factors::Row]) -> Result<()> {
    page.push_str(
        "<h2>Scaling factors</h2><p class=\"paper\">Paper: the half space differs from the one-dimensional model by a \
         constant factor only, s₁ ≈ 0.55 for the cone and s₂ ≈ 0.67 for the paraboloid; the function s(p) is unknown.</p>\
         <table><tr><th>profile</th><th>paper</th><th>plain<br>simulation</th><th>+ time level<br>of the slope</th>\
         <th>+ sliding<br>distance</th><th>+ grid</th><th>= converged</th><th>error</th></tr>",
    );
    for row in rows {
        let name = if row.exponent < 1.5 {
            "cone, p = 1"
        } else {
            "paraboloid, p = 2"
        };
        write!(
            page,
            "<tr><td>{name}</td><td>{}</td><td>{:.4}</td><td>{:+.4}</td><td>{:+.4}</td><td>{:+.4}</td>\
             <td><b>{:.4}</b></td><td>± {:.4}</td></tr>",
            row.paper,
            row.plain,
            row.time_level_bias,
            row.distance_bias,
            row.grid_bias,
            row.converged,
            row.error
        )?;
    }
    write!(
        page,
        "</table><p>The plain simulation does what the paper describes: {} elements along the contact length of the \
         one-dimensional model, one element per time step, {} contact lengths of sliding from first touch, friction \
         from the pressure and the slope at the end of each step. Ten elements are few, and that is the point: the \
         contact is then about as coarse as the perturbations mentioned with Fig. 7 suggest. Forty contact lengths are \
         the first doubling of five after which friction changes by less than one per cent over the second half of the \
         way (here {:.1e} and {:.1e}).</p>\
         <p>It errs in three ways, each measured. The pressure of a step belongs to the motion during the step, so that the \
         slope at its end is too small: the mean slope over the step removes that first-order error. The surface ahead \
         of the indenter sinks like the logarithm of the sliding distance, so that friction approaches its limit like \
         the reciprocal of the distance. The elements are finite. The converged value is that of the stationary problem, solved directly \
         without time, averaged over shifted grids, refined and extrapolated until its error is below {:e} of it.</p>",
        rows[0].plain_elements,
        rows[0].plain_lengths,
        rows[0].plain_drift,
        rows[1].plain_drift,
        factors::RELATIVE_ERROR
    )?;
    write_data(page, rows)
}

fn write_loss_tangent(page: &mut String, data: &Data, pictures: &[Picture]) -> Result<()> {
    page.push_str(
        "<h2>Fig. 1: loss tangent of the three-element solid</h2><p class=\"paper\">Paper: loss tangent over the \
         dimensionless frequency for γ = G₁/G₂ = 1/1000, 1/100, 1/10; storage and loss modulus for γ = 1/100, scaled by \
         10/G₂.</p>",
    );
    write_picture(page, pictures, "fig1_loss_tangent")?;
    page.push_str(
        "<p>The paper defines Ω := ω G₂/η, which has the dimension of a squared frequency; with Ω := ω η/G₂ its three \
         formulas and its curves are right, and that is what is drawn.</p>",
    );
    write_data(page, &data.loss_tangent)
}

fn write_approach(page: &mut String, pictures: &[Picture]) -> Result<()> {
    page.push_str(
        "<h2>The transition zone</h2><p class=\"paper\">Paper: after passing a transition zone a stationary state is \
         reached (not shown).</p>",
    );
    write_picture(page, pictures, "approach")?;
    write_picture(page, pictures, "pressure")
}

fn write_scaling_function(page: &mut String, pictures: &[Picture]) -> Result<()> {
    page.push_str(
        "<h2>The function s(p)</h2><p class=\"paper\">Paper: the function s(p) for other exponents is unknown.</p>",
    );
    write_picture(page, pictures, "scaling_function")
}

/// What differs between Fig. 7 and Fig. 8.
struct SpeedFigure {
    picture: &'static str,
    title: &'static str,
    paper: &'static str,
    shape: (&'static str, f64, &'static str),
}

const CONE: SpeedFigure = SpeedFigure {
    picture: "fig7_cone",
    title: "Fig. 7: cone",
    paper: "friction does not depend on the speed; chain and theory coincide up to small perturbations from the \
            discretization; the half space gives a constant fraction, s₁ ≈ 0.55, of it.",
    shape: ("slope c₁", CONE_SLOPE, "(paper)"),
};

const PARABOLOID: SpeedFigure = SpeedFigure {
    picture: "fig8_paraboloid",
    title: "Fig. 8: paraboloid of revolution",
    paper: "friction falls like the square root of the speed, Eq. (22); the half space gives a constant fraction, \
            s₂ ≈ 0.67, of it.",
    shape: ("curvature c₂", CURVATURE, "1/m (not stated in the paper)"),
};

fn write_friction(
    page: &mut String,
    rows: &[Row],
    pictures: &[Picture],
    figure: &SpeedFigure,
) -> Result<()> {
    write!(
        page,
        "<h2>{}</h2><p class=\"paper\">Paper: {}</p>",
        figure.title, figure.paper
    )?;
    write_picture(page, pictures, figure.picture)?;
    let (name, value, source) = figure.shape;
    let elements = rows.iter().map(|row| row.elements_along_contact);
    let [fewest, most] = [
        elements.clone().fold(f64::INFINITY, f64::min),
        elements.fold(0.0, f64::max),
    ];
    let chain = largest_deviation(rows, |row| row.chain);
    let half_space = largest_deviation(rows, |row| row.half_space * row.theory / row.scaled_theory);
    let distance = rows
        .iter()
        .map(|row| row.half_space_distance_error / row.half_space)
        .fold(0.0, f64::max);
    write!(
        page,
        "<p>{name} = {value} {source}; normal force {NORMAL_FORCE} N, viscosity {VISCOSITY:e} Pa s (not stated in the \
         paper); {} speeds, each computed anew. Spacings of 2<sup>−k</sup> mm put {fewest:.1} to {most:.1} elements \
         along the contact length of the one-dimensional model; the half space slides over {SLIDING_LENGTHS} contact \
         lengths and is extrapolated from there. The chain deviates from the theory by at most {chain:.1e}, the half \
         space from the scaled theory by at most {half_space:.1e} (scatter of the grids), the extrapolation in the \
         distance errs by at most {distance:.1e}.</p>",
        rows.len()
    )?;
    write_data(page, rows)
}

fn largest_deviation(rows: &[Row], value: impl Fn(&Row) -> f64) -> f64 {
    rows.iter()
        .map(|row| (value(row) / row.theory - 1.0).abs())
        .fold(0.0, f64::max)
}

fn write_picture(page: &mut String, pictures: &[Picture], name: &str) -> Result<()> {
    if let Some(picture) = pictures.iter().find(|picture| picture.name == name) {
        write!(
            page,
            "<figure>{}<figcaption>{}</figcaption></figure>",
            picture.drawing.svg, picture.caption
        )?;
    }
    Ok(())
}

/// The numbers behind a figure, folded away.
fn write_data<R: Serialize>(page: &mut String, rows: &[R]) -> Result<()> {
    page.push_str("<details><summary>data</summary><div class=\"wide\"><table>");
    for (line, record) in to_csv(rows)?.lines().enumerate() {
        let tag = if line == 0 { "th" } else { "td" };
        page.push_str("<tr>");
        for cell in record.split(',') {
            let short = cell
                .parse::<f64>()
                .map_or_else(|_| cell.replace('_', " "), |number| format!("{number:.6e}"));
            write!(page, "<{tag}>{short}</{tag}>")?;
        }
        page.push_str("</tr>");
    }
    page.push_str("</table></div></details>");
    Ok(())
}

const NOT_STATED: &str = "<h2>What the paper does not state</h2><p>Force, viscosity, the curvature c₂, the range of \
     speeds, the size of the elements, the time step, the sliding distance, the criterion of stationarity, and at which \
     instant of a step the slope is taken. Figures 7 and 8 therefore agree with the paper in their shape, in the cone's \
     friction (π/2) c₁ and in the scaling factors, and cannot agree in the position of single points.</p>\
     <p>The depth of the half space is not shown, because it has no stationary value: it grows with the logarithm of the \
     sliding distance. Friction and contact do become stationary.</p>";

/// Times depend on the machine, so that the committed picture is shown and not a new one.
const WORK_PRECISION: &str = concat!(
    "<h2>What an accuracy costs</h2><p>Not in the paper, and not computed with this page: measured by <code>cargo xtask evidence \
     work-precision</code>, as docs/work-precision.md says.</p><figure>",
    include_str!("../../../docs/figures/work_precision_sliding.svg"),
    "<figcaption>Error of the friction coefficient over the processor time, each method against a reference of its \
     model.</figcaption></figure>"
);
