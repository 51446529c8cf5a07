//! All families, in the order of the table.

use indenters::{
    FlatCone, Hyperboloid, PowerProfile, RoundTippedCone, Sphere, TruncatedParaboloid,
};
use rheology::{KelvinVoigt, Maxwell};

use super::case::{Case, Family, decades, families};
use super::materials::prony_over;
use super::{contacts, half_space, line, materials, range, refusals, units};
use crate::scene::solid;

/// Numbers that no size, speed, force or modulus can be.
const NOT_POSITIVE: [f64; 5] = [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY];
const SPRINGPOTS: [f64; 9] = [0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95, 0.99];
const THEOREM: [f64; 13] = [
    0.5001, 0.501, 0.51, 0.6, 0.8, 1.0, 1.5, 2.0, 4.0, 16.0, 64.0, 200.0, 1000.0,
];
const LINE: [f64; 14] = [
    0.55, 0.6, 0.75, 0.9, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0, 300.0, 1000.0,
];
const HALF_SPACE: [f64; 10] = [0.55, 0.6, 0.75, 0.9, 1.0, 1.5, 2.0, 4.0, 8.0, 16.0];
const WIDTHS: [f64; 6] = [0.2, 0.5, 1.0, 2.0, 5.0, 10.0];
const ELEMENTS: [f64; 8] = [1.0, 2.0, 3.0, 4.0, 7.0, 30.0, 100.0, 1000.0];
const PATCHES: [f64; 8] = [1.0, 4.0, 16.0, 64.0, 256.0, 1024.0, 2025.0, 4096.0];

pub(super) fn all() -> Vec<Family> {
    let parts = [
        of_materials(),
        shapes(),
        on_the_line(),
        at_an_instant(),
        on_the_half_space(),
        range::families(),
        units::families(),
        refused(),
    ];
    parts.into_iter().flatten().collect()
}

fn ratios() -> impl Iterator<Item = f64> {
    decades(-12, 12, 1)
}

fn of_materials() -> Vec<Family> {
    families! {
        Cheap "creep of Kelvin–Voigt in steps", "Δt/λ", ratios() => materials::creep_steps;
        Cheap "relaxation of Maxwell in steps", "Δt/τ", ratios() => materials::relaxation_steps;
        Cheap "spectra of 16 branches", "decades of τ", (1..=15).map(f64::from) => materials::many_branches;
        Cheap "two branches of nearly one τ", "difference", decades(-15, -1, 1) => materials::close_branches;
        Cheap "three-element solid", "γ", decades(-12, 3, 1) => materials::three_elements;
        Cheap "springpot as Prony series", "exponent", SPRINGPOTS => materials::springpot;
    }
}

/// Cusps, flat ends, bodies that are almost flat, and needles.
fn shapes() -> Vec<Family> {
    let tips = decades(-12, -3, 1).chain(decades(3, 12, 1));
    families! {
        Cheap "quadrature beside closed form", "p", THEOREM => line::quadrature;
        Cheap "theorem, p → 1/2", "p − 1/2", decades(-14, -1, 1) => line::nearly_divergent;
        Cheap "line, cone with round tip", "tip / m", ratios() => |tip| line::both(&RoundTippedCone::new(tip, 1.0)?);
        Cheap "line, sphere", "radius/depth", decades(0, 12, 1) => |radius| line::both(&Sphere::new(radius)?);
        Cheap "line, hyperboloid", "radius/depth", ratios() => |radius| line::both(&Hyperboloid::new(radius, 1.0)?);
        Cheap "line, cone with flat end", "end / m", decades(-12, 8, 1) => |end| line::diverges(&FlatCone::new(end, 1.0)?);
        Cheap "line, worn paraboloid", "end / m", decades(-12, 3, 1) => |end| line::diverges(&TruncatedParaboloid::new(end, 1.0)?);
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
    let mut families = families! {
        Cheap "line, dashpot, stationary", "p", LINE => line::power_profile;
        Cheap "line, cone on Kelvin–Voigt", "vλ/x_r", ratios() => move |ratio| line::kelvin_voigt(&cone()?, ratio);
        Cheap "line, paraboloid on Kelvin–Voigt", "vλ/x_r", ratios() => move |ratio| line::kelvin_voigt(&paraboloid()?, ratio);
        Cheap "line, cone on Maxwell", "vτ/x_r", ratios() => move |ratio| line::maxwell(&cone()?, ratio);
        Cheap "line, paraboloid on Maxwell", "vτ/x_r", ratios() => move |ratio| line::maxwell(&paraboloid()?, ratio);
        Cheap "line, cone on 16 branches over 15 decades", "v/x_r", ratios() => |speed| line::cone_at_depth(&prony_over(15.0)?, speed);
        Cheap "line, cone on three elements, vτ = x_r", "γ", gammas() => |gamma| line::cone_at_depth(&solid(gamma)?, 1.0);
        Cheap "line, cone on three elements, slow", "γ", gammas() => |gamma| line::cone_at_depth(&solid(gamma)?, 1e-3 * gamma);
        Cheap "line, pressed, Kelvin–Voigt", "Δt/λ", ratios() => |ratio| line::pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio);
        Cheap "line, pressed, Maxwell", "Δt/τ", ratios() => |ratio| line::pressed(&Maxwell::new(1.0, 1.0)?, ratio);
        Cheap "line, pressed, 16 branches", "Δt", ratios() => |ratio| line::pressed(&prony_over(15.0)?, ratio);
        Cheap "line, march, cone on Maxwell", "vτ/x_r", ratios().step_by(2) => line::march;
        Cheap "line, march, cone on dashpot", "elements", ELEMENTS => line::coarse_march;
    };
    let sharp = [0.1, 0.5, 0.501, 0.51].map(|p| Case::new(p, move || line::too_sharp(p)));
    families[0].cases.splice(0..0, sharp);
    families
}

fn at_an_instant() -> Vec<Family> {
    let mut families = families! {
        Cheap "influence, far elements", "distance/edge", decades(0, 12, 1) => contacts::far;
        Cheap "influence, slender elements", "Δy/Δx", ratios() => contacts::slender;
        Cheap "contact, one element to a full box", "force", ratios() => contacts::any_force;
        Cheap "contact, slender", "width/length", decades(-4, 4, 1) => contacts::slender_contact;
        Cheap "contact, many patches", "patches", PATCHES => contacts::patches;
        Cheap "contact, heights far above zero", "height/displacement", decades(0, 12, 1) => contacts::high_above;
    };
    families[5].cases.extend(contacts::unusual_heights());
    families
}

fn on_the_half_space() -> Vec<Family> {
    let gammas = || decades(-12, 3, 3);
    let limits = || decades(-12, -5, 1).chain(decades(5, 12, 1));
    let mut families = families! {
        Costly "half space, dashpot, stationary", "p", HALF_SPACE => half_space::power_profile;
        Costly "half space, three elements, slow", "γ", gammas() => half_space::slow;
        Costly "half space, three elements, fast", "γ", gammas() => half_space::fast;
        Costly "half space, three elements, plateau", "γ", decades(-12, -8, 1) => half_space::plateau;
        Costly "half space, 16 branches over 15 decades", "vτ/a", decades(-12, 12, 2) => half_space::branches;
        Costly "half space, slender paraboloid", "width/length", WIDTHS => half_space::slender;
        Cheap "half space, pressed, Kelvin–Voigt", "Δt/λ", ratios() => |ratio| half_space::pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio);
        Cheap "half space, pressed, Maxwell", "Δt/τ", ratios() => |ratio| half_space::pressed(&Maxwell::new(1.0, 1.0)?, ratio);
        Cheap "half space, pressed, 16 branches", "Δt", ratios() => |ratio| half_space::pressed(&prony_over(15.0)?, ratio);
        Cheap "half space, march on Maxwell", "Δt/τ", limits() => half_space::march_on_maxwell;
        Cheap "half space, march on three elements", "Δt/τ", limits() => half_space::march_on_solid;
    };
    let powers = &mut families[0].cases;
    powers.insert(0, Case::new("0.5", half_space::too_sharp));
    let flat = [100.0, 300.0, 1000.0];
    powers.extend(flat.map(|p| Case::new(p, move || half_space::nearly_flat(p))));
    families
}

fn refused() -> Vec<Family> {
    let mut families = families! {
        Cheap "refused: viscosity", "number", NOT_POSITIVE => refusals::viscosity;
        Cheap "refused: force", "number", NOT_POSITIVE => |force| refusals::load(force, 1.0);
        Cheap "refused: speed", "number", NOT_POSITIVE => |velocity| refusals::load(1.0, velocity);
        Cheap "refused: exponent", "number", NOT_POSITIVE => refusals::exponent;
        Cheap "refused: step in time", "number", NOT_POSITIVE => refusals::time_step;
        Cheap "refused: relaxation time", "number", NOT_POSITIVE => refusals::relaxation_time;
    };
    let kinds = [
        ("refused: no stationary state", refusals::no_state()),
        ("refused: too coarse, too small", refusals::grids()),
    ];
    families.extend(kinds.map(|(name, cases)| Family::of(name, "scene", cases)));
    families
}
