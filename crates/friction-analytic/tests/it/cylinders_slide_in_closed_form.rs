//! A cylinder in plane strain on solids with one relaxation time (Hunter 1961; casebook VIS-04).

use std::f64::consts::PI;

use casebook::{NOT_POSITIVE, assert_close, prony, refused, refuses};
use friction_analytic::{CylinderSliding, FrictionError, LineContact, cylinder_sliding};
use indenters::Cylinder;
use numerics::integrate;
use rheology::{Compressible, KelvinVoigt, Material, Maxwell, Prony};

/// G₁ = τ = 1.
fn three_elements(gamma: f64) -> Prony {
    prony([gamma, 0.0], &[(1.0, 1.0)])
}

fn slide(material: &dyn Material, velocity: f64) -> Result<CylinderSliding, FrictionError> {
    let contact = LineContact {
        half_length: 1.0,
        velocity,
    };
    cylinder_sliding(&Cylinder::new(1.0).unwrap(), material, contact)
}

/// F'/(π G_∞), x₀/l, μ R/l.
fn numbers(state: &CylinderSliding, gamma: f64) -> [f64; 3] {
    let [rear, front] = state.contact;
    assert_close!(front - rear => 2.0, within 1e-14);
    let middle = 0.5 * (rear + front);
    [
        state.line_load / (PI * gamma),
        middle,
        state.friction_coefficient,
    ]
}

/// γ, z, F'/(π G_∞) and μ R/l, with mpmath 1.3 and 40 digits.
const EXTREME: &str = include_str!("../data/cylinders.txt");

#[test]
fn cylinders_match_the_casebook_and_twelve_decades_of_speed() {
    for case in casebook::group("VIS-04") {
        let gamma = case.input("gamma");
        let (solid, velocity) = (three_elements(gamma), case.input("z").recip());
        let state = slide(&solid, velocity).unwrap();
        let larger = LineContact {
            half_length: 2.0,
            velocity: 2.0 * velocity,
        };
        let larger = cylinder_sliding(&Cylinder::new(4.0).unwrap(), &solid, larger).unwrap();
        for (end, expected) in larger.contact.into_iter().zip(state.contact) {
            assert_close!(end => 2.0 * expected, within 1e-14; "twice as long");
        }
        let slope = 2.0 * larger.friction_coefficient;
        assert_close!(slope => state.friction_coefficient, within 1e-14; "half as steep");
        assert_close!(larger.line_load => state.line_load, within 1e-14; "twice as long, half as steep");
        let compressible = slide(&Compressible::new(&solid, 0.2).unwrap(), velocity).unwrap();
        assert_close!(compressible.line_load => state.line_load / 1.6, within 1e-14; "compressible");
        let names = ["P", "x0_over_l", "muR_over_l"].into_iter();
        for (name, value) in names.zip(numbers(&state, gamma)) {
            case.check_within(name, value, 1e-13);
        }
    }
    for [gamma, z, load, friction] in casebook::numbers(EXTREME) {
        let state = slide(&three_elements(gamma), z.recip()).unwrap();
        let [actual, _, slope] = numbers(&state, gamma);
        assert_close!(actual => load, within 1e-13; "γ = {gamma}, z = {z}");
        assert_close!(slope => friction, within 1e-13; "γ = {gamma}, z = {z}");
    }
}

/// ∫ p dx = F' and ∫ p x dx = μ R F', where neither used the pressure.
#[test]
fn the_pressure_carries_load_and_friction() {
    let kelvin_voigt = KelvinVoigt::new(0.3, 1.0).unwrap();
    let compressible = Compressible::new(&three_elements(0.1), 0.2).unwrap();
    let solids = [1e-3, 0.1, 1.0, 1e3].map(three_elements);
    let materials = solids.iter().map(|solid| (solid as &dyn Material, 1e-11));
    // The pressure is infinite at the front.
    let others: [(&dyn Material, f64); 2] = [(&compressible, 1e-11), (&kelvin_voigt, 1e-7)];
    for (material, tolerance) in materials.chain(others) {
        for velocity in [1e-6, 1e-3, 0.05, 1.0, 20.0, 1e3, 1e6] {
            let state = slide(material, velocity).unwrap();
            let middle = 0.5 * (state.contact[0] + state.contact[1]);
            let moment = |power: i32| {
                let integrand = |s: f64| s.powi(power) * state.pressure(middle + s);
                integrate(integrand, [-1.0, 1.0], 1e-12).value
            };
            let load = moment(0);
            assert_close!(load => state.line_load, within tolerance; "{material:?}, {velocity}");
            let slope = moment(1) / load + middle;
            let error = (slope - state.friction_coefficient).abs();
            assert!(
                error <= tolerance * slope.max(1.0),
                "{slope} for {state:?}, {velocity}"
            );
            let ahead = state.pressure(state.contact[1] + 1e-9);
            assert!(ahead.abs() <= 0.0, "{ahead} ahead of {state:?}");
        }
    }
}

#[test]
fn stiff_branches_are_kelvin_voigt_and_soft_springs_maxwell() {
    for velocity in [1e-3, 0.1, 1.0, 30.0] {
        let kelvin_voigt = KelvinVoigt::new(0.3, 1.0).unwrap();
        let stiff = prony([0.3, 0.0], &[(1e15, 1e-15)]);
        let [limit, state] =
            [&kelvin_voigt as &dyn Material, &stiff].map(|m| slide(m, velocity).unwrap());
        let [limit, state] = [limit, state].map(|state| numbers(&state, 0.3));
        for (value, limit) in state.into_iter().zip(limit) {
            assert_close!(value => limit, within 1e-11; "{velocity}");
        }
        // Ten times as long a memory moves the contact by l a ln 10, and the force no more.
        let [near, far] =
            [1e-16, 1e-17].map(|gamma| slide(&three_elements(gamma), velocity).unwrap());
        assert_close!(near.line_load => far.line_load, within 1e-10; "{velocity}");
        let a = far.line_load / (2.0 * PI * velocity);
        let moved = far.contact[0] - near.contact[0];
        assert_close!(moved => a * 10_f64.ln(), within 1e-10; "{velocity}");
    }
    let elastic = prony([2.0, 0.0], &[]);
    let [load, middle, friction] = numbers(&slide(&elastic, 1.0).unwrap(), 2.0);
    let largest = middle.abs().max(friction.abs());
    assert!(largest <= 0.0, "{middle} or {friction} without loss");
    assert_close!(load => 1.0, within 1e-15);
}

#[test]
fn a_cylinder_needs_one_relaxation_time_a_length_and_a_speed() {
    let solid = three_elements(1.0);
    refuses("velocity", NOT_POSITIVE, |velocity| slide(&solid, velocity));
    let cylinder = Cylinder::new(1.0).unwrap();
    refuses("half_length", NOT_POSITIVE, |half_length| {
        let velocity = 1.0;
        let contact = LineContact {
            half_length,
            velocity,
        };
        cylinder_sliding(&cylinder, &solid, contact)
    });
    let maxwell = Maxwell::new(1.0, 1.0).unwrap();
    refused("equilibrium_modulus", slide(&maxwell, 1.0));
    let branches = prony([1.0, 0.0], &[(1.0, 1.0), (1.0, 2.0)]);
    for two in [branches, prony([1.0, 1.0], &[(1.0, 1.0)])] {
        refused("number of relaxing elements", slide(&two, 1.0));
    }
}
