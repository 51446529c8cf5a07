//! Figs. 7 and 8: friction over sliding speed by theory, chain and half space.

use anyhow::Result;
use indenters::{IndenterError, PowerProfile, SlidingLoad};
use rheology::Viscous;
use serde::{Deserialize, Serialize};

use crate::figures::factors;
use crate::scene::Scene;
use crate::tasks::in_parallel;

/// The paper gives the slope of the cone only; force, viscosity and curvature are chosen so that contacts measure from
/// 0.1 mm to 2 cm.
const CONE_SLOPE: f64 = 0.1;
const CURVATURE: f64 = 10.0;
const NORMAL_FORCE: f64 = 1.0;
const VISCOSITY: f64 = 1e5;
/// Speeds from 10⁻³ to 10⁻¹ m/s, six per decade.
pub(super) const SPEEDS: u32 = 13;
/// The half space slides over this many contact lengths of the one-dimensional model.
const SLIDING_LENGTHS: f64 = 32.0;
/// At least so many elements lie along the contact length.
const MIN_ELEMENTS: f64 = 12.0;
const DRIFT_TOLERANCE: f64 = 0.03;

/// The indenter of a figure.
pub(super) struct Indenter {
    name: &'static str,
    pub(super) file: &'static str,
    /// Exponent p of the profile.
    pub(super) exponent: f64,
    body: fn() -> Result<PowerProfile, IndenterError>,
}

pub(super) const CONE: Indenter = Indenter {
    name: "Fig. 7, cone",
    file: "fig7_cone.csv",
    exponent: 1.0,
    body: || PowerProfile::cone(CONE_SLOPE),
};
pub(super) const PARABOLOID: Indenter = Indenter {
    name: "Fig. 8, paraboloid",
    file: "fig8_paraboloid.csv",
    exponent: 2.0,
    body: || PowerProfile::paraboloid(CURVATURE),
};

/// One speed. Units stand in the names where there is one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) velocity_m_per_s: f64,
    /// Eqs. (21) and (22).
    pub(super) theory: f64,
    pub(super) chain: f64,
    /// Extrapolated to an infinite sliding distance, with the error of that.
    pub(super) half_space: f64,
    pub(super) half_space_distance_error: f64,
    /// At the end of the run, with the slope at the end of the step: the plain reading of the paper.
    pub(super) half_space_plain: f64,
    /// Theory times the converged scaling factor.
    pub(super) scaled_theory: f64,
    pub(super) spacing_m: f64,
    pub(super) elements_along_contact: f64,
    pub(super) sliding_distance_m: f64,
    /// Relative change of the half space's friction over the second half of the distance.
    pub(super) drift: f64,
}

/// Computes every speed anew; similarity is not used.
pub(super) fn compute(indenter: &Indenter, factor: &factors::Row) -> Result<Vec<Row>> {
    let speeds: Vec<u32> = (0..SPEEDS).collect();
    in_parallel(indenter.name, &speeds, |&speed| {
        row(indenter, speed, factor.converged)
    })
}

/// The row of one speed, counted from the slowest.
pub(super) fn row(indenter: &Indenter, speed: u32, factor: f64) -> Result<Row> {
    let velocity = 10.0_f64.powf(f64::from(speed) / 6.0 - 3.0);
    let scene = Scene {
        body: (indenter.body)()?,
        material: Viscous::new(VISCOSITY)?,
        load: SlidingLoad::new(NORMAL_FORCE, velocity)?,
    };
    let theory = scene.theory()?;
    let spacing = spacing(theory.contact_length());
    let chain = scene.chain(spacing)?;
    let transient = scene.half_space(spacing, SLIDING_LENGTHS)?;
    let stationary = transient.stationary(DRIFT_TOLERANCE)?;
    Ok(Row {
        velocity_m_per_s: velocity,
        theory: theory.friction_coefficient,
        chain: chain.last.friction_coefficient,
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

/// The coarsest spacing 2^−k mm that puts enough elements along the contact. Steps that do not follow the contact
/// keep the discrete problems of different speeds apart: with a spacing proportional to the contact they would all be
/// the same one.
fn spacing(contact_length: f64) -> f64 {
    let millimetre = 1e-3;
    let steps = (contact_length / MIN_ELEMENTS / millimetre).log2().floor();
    millimetre * steps.exp2()
}
