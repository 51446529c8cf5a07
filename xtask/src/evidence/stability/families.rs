//! All families, in the order of the table.

use indenters::{Hyperboloid, PowerProfile, RoundTippedCone, Sphere};
use rheology::{KelvinVoigt, Maxwell};

use super::case::{Family, decades, families};
use super::line::sixteen_branches;
use super::{half_space, line, range};
use crate::scene::solid;

const LINE: [f64; 18] = [
    0.1, 0.5, 0.501, 0.51, 0.55, 0.6, 0.75, 0.9, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0, 300.0,
    1000.0,
];
const HALF_SPACE: [f64; 14] = [
    0.5, 0.55, 0.6, 0.75, 0.9, 1.0, 1.5, 2.0, 4.0, 8.0, 16.0, 100.0, 300.0, 1000.0,
];
const WIDTHS: [f64; 6] = [0.2, 0.5, 1.0, 2.0, 5.0, 10.0];

pub(super) fn all() -> Vec<Family> {
    let usual = shapes().into_iter().chain(on_the_line());
    let usual = usual.chain(on_the_half_space());
    usual.chain(range::families()).collect()
}

fn ratios() -> impl Iterator<Item = f64> {
    decades(-12, 12, 1)
}

/// Bodies that are almost flat, and needles.
fn shapes() -> Vec<Family> {
    let tips = decades(-12, -3, 1).chain(decades(3, 12, 1));
    families! {
        Cheap "line, cone with round tip", "tip / m", ratios() => |tip| line::both(&RoundTippedCone::new(tip, 1.0)?);
        Cheap "line, sphere", "radius/depth", decades(0, 12, 1) => |radius| line::both(&Sphere::new(radius)?);
        Cheap "line, hyperboloid", "radius/depth", ratios() => |radius| line::both(&Hyperboloid::new(radius, 1.0)?);
        Cheap "line, cone, any slope", "slope", ratios() => |slope| line::both(&PowerProfile::cone(slope)?);
        Costly "half space, cone, any slope", "slope", decades(-12, 12, 3) => half_space::any_slope;
        Costly "half space, cone with flat end", "end/contact", decades(-12, -4, 1) => half_space::flat_end;
        Costly "half space, cone with round tip", "tip / m", tips => half_space::round_tip;
    }
}

/// Ratios are distances that a branch or a retardation takes, over the front of the contact.
fn on_the_line() -> Vec<Family> {
    let gammas = || decades(-12, 3, 1);
    let cone = || PowerProfile::cone(0.1);
    let paraboloid = || PowerProfile::paraboloid(0.1);
    families! {
        Cheap "line, dashpot, stationary", "p", LINE => line::power_profile;
        Cheap "line, cone on Kelvin–Voigt", "vλ/x_r", ratios() => move |ratio| line::kelvin_voigt(&cone()?, ratio);
        Cheap "line, paraboloid on Kelvin–Voigt", "vλ/x_r", ratios() => move |ratio| line::kelvin_voigt(&paraboloid()?, ratio);
        Cheap "line, cone on Maxwell", "vτ/x_r", ratios() => move |ratio| line::maxwell(&cone()?, ratio);
        Cheap "line, paraboloid on Maxwell", "vτ/x_r", ratios() => move |ratio| line::maxwell(&paraboloid()?, ratio);
        Cheap "line, cone on 16 branches over 15 decades", "v/x_r", ratios() => |speed| line::cone_at_depth(&sixteen_branches(), speed);
        Cheap "line, cone on three elements, vτ = x_r", "γ", gammas() => |gamma| line::cone_at_depth(&solid(gamma)?, 1.0);
        Cheap "line, cone on three elements, slow", "γ", gammas() => |gamma| line::cone_at_depth(&solid(gamma)?, 1e-3 * gamma);
        Cheap "line, pressed, Kelvin–Voigt", "Δt/λ", ratios() => |ratio| line::pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio);
        Cheap "line, pressed, Maxwell", "Δt/τ", ratios() => |ratio| line::pressed(&Maxwell::new(1.0, 1.0)?, ratio);
        Cheap "line, pressed, 16 branches", "Δt", ratios() => |ratio| line::pressed(&sixteen_branches(), ratio);
        Cheap "line, march, cone on Maxwell", "vτ/x_r", ratios().step_by(2) => line::march;
    }
}

fn on_the_half_space() -> Vec<Family> {
    let gammas = || decades(-12, 3, 3);
    let limits = || decades(-12, -5, 1).chain(decades(5, 12, 1));
    families! {
        Costly "half space, dashpot, stationary", "p", HALF_SPACE => half_space::power_profile;
        Costly "half space, three elements, slow", "γ", gammas() => half_space::slow;
        Costly "half space, three elements, fast", "γ", gammas() => half_space::fast;
        Costly "half space, slender paraboloid", "width/length", WIDTHS => half_space::slender;
        Cheap "half space, pressed, Kelvin–Voigt", "Δt/λ", ratios() => |ratio| half_space::pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio);
        Cheap "half space, pressed, Maxwell", "Δt/τ", ratios() => |ratio| half_space::pressed(&Maxwell::new(1.0, 1.0)?, ratio);
        Cheap "half space, pressed, 16 branches", "Δt", ratios() => |ratio| half_space::pressed(&sixteen_branches(), ratio);
        Cheap "half space, march on Maxwell", "Δt/τ", limits() => half_space::march_on_maxwell;
        Cheap "half space, march on three elements", "Δt/τ", limits() => half_space::march_on_solid;
    }
}
