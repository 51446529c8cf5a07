//! A long cylinder, of three elements a million times as long as wide, slides as in the plane (Hunter 1961; Morland 1967).

use bem_halfspace::Footprint;
use bem_halfspace::steady::{SteadyOptions, SteadySliding, steady};
use casebook::group;
use indenters::{SlidingLoad, Surface};
use rheology::{
    Material, Prony, RelaxationBranch, RelaxationSpectrum, StandardSolid, StandardSolidParameters,
};

/// Length of the cylinder over half the length of the contact.
const LENGTH: f64 = 1e6;
/// Elements along half the contact.
const ELEMENTS: [f64; 2] = [14.0, 28.0];

/// h = x²/2 between its ends.
#[derive(Debug)]
struct Cylinder {
    length: f64,
}

impl Surface for Cylinder {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        if y.abs() > 0.5 * self.length {
            f64::INFINITY
        } else {
            0.5 * x * x
        }
    }

    fn gradient(&self, [x, _]: [f64; 2]) -> [f64; 2] {
        [x, 0.0]
    }
}

/// Load per length, and friction coefficient, of the middle one of the three columns.
fn middle(solution: &SteadySliding) -> [f64; 2] {
    let field = &solution.pressure;
    let [rows, columns] = field.grid.shape();
    let [dx, _] = field.grid.spacing();
    let (mut load, mut moment) = (0.0, 0.0);
    for row in 0..rows {
        let pressure = field.pressure[row * columns + columns / 2];
        load += pressure * dx;
        moment += pressure * dx * (field.origin[0] + row as f64 * dx);
    }
    [load, moment / load]
}

/// Friction coefficient of a cylinder of radius 1 under a load per length that makes a contact of the half length
/// `half_length`.
fn friction(
    material: &dyn Material,
    velocity: f64,
    [line_load, half_length]: [f64; 2],
    elements: f64,
) -> f64 {
    let length = LENGTH * half_length;
    let spacing = half_length / elements;
    let options = SteadyOptions {
        spacing: [spacing, length / 3.0],
        phase: [0.5, 0.0],
        footprint: Footprint {
            x: [-2.2 * half_length, 4.2 * half_length],
            y: [-length, length],
        },
        tolerance: 1e-11,
        max_iterations: 500,
    };
    // The ends of the cylinder carry more than the middle.
    let mut force = line_load * length;
    for _ in 0..4 {
        let load = SlidingLoad::new(force, velocity).expect("a valid load");
        let solution = steady(&Cylinder { length }, material, &load, &options).expect("a solution");
        let [carried, friction] = middle(&solution);
        if (carried / line_load - 1.0).abs() < 1e-6 {
            return friction;
        }
        force *= line_load / carried;
    }
    panic!("the force was not found");
}

/// The friction converges with the order 3/2; what is left after its elimination is below 2e-3, and below 5e-4 of the
/// slope at the end of the contact where the friction is a small difference.
fn check(material: &dyn Material, velocity: f64, loads: [f64; 2], expected: f64, name: &str) {
    let [coarse, fine] = ELEMENTS.map(|elements| friction(material, velocity, loads, elements));
    let actual = fine + (fine - coarse) / (8.0_f64.sqrt() - 1.0);
    let allowed = 2e-3 * expected + 5e-4 * loads[1];
    assert!(
        (actual - expected).abs() < allowed,
        "{name}: {coarse}, {fine}, extrapolated {actual} instead of {expected}, allowed {allowed:e}"
    );
}

#[test]
fn a_cylinder_on_a_three_element_solid_is_hunters() {
    for case in group("VIS-04") {
        let (gamma, z) = (case.input("gamma"), case.input("z"));
        let material = StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus: gamma,
            maxwell_modulus: 1.0,
            viscosity: 1.0,
        })
        .expect("a material");
        let factor = case.expected("P").expect("a load");
        let line_load = factor * std::f64::consts::PI * gamma;
        // In units of half the contact length l: speed l/(zτ), force P π G₁ l²/R, friction μ R/l.
        let expected = case.expected("muR_over_l").expect("a friction coefficient");
        check(&material, 1.0 / z, [line_load, 1.0], expected, case.id());
    }
}

#[test]
fn a_cylinder_on_three_branches_is_that_of_the_spectral_reference() {
    for case in group("VIS-05") {
        let moduli = case.input_list("G");
        let times = case.input_list("tau");
        let branch = |(&modulus, &relaxation_time): (&f64, &f64)| RelaxationBranch {
            modulus,
            relaxation_time,
        };
        let branches = moduli.iter().zip(&times).map(branch).collect();
        let spectrum =
            RelaxationSpectrum::new(case.input("Ge"), 0.0, branches).expect("a spectrum");
        let material = Prony::new(spectrum).expect("a material");
        let line_load = case.expected("line_force").expect("a load");
        let expected = case.expected("mu").expect("a friction coefficient");
        check(
            &material,
            case.input("v"),
            [line_load, 1.0],
            expected,
            case.id(),
        );
    }
}
