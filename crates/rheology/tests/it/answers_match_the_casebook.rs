use casebook::{Case, assert_close};
use rheology::{CreepSpectrum, Elastic, KelvinVoigt, Material, Maxwell, Viscous};

use crate::support::{assert_same, solid, spectrum};

fn material(case: &Case) -> Box<dyn Material> {
    let input = |name| case.input(name);
    match case.id() {
        "RHE-03/elastic" => Box::new(Elastic::new(input("G")).unwrap()),
        "RHE-03/viscous" => Box::new(Viscous::new(input("eta")).unwrap()),
        "RHE-03/kelvin-voigt" => Box::new(KelvinVoigt::new(input("G"), input("eta")).unwrap()),
        "RHE-03/maxwell" => Box::new(Maxwell::new(input("G"), input("eta")).unwrap()),
        _ if case.has_input("eta") => Box::new(solid(["G1", "G2", "eta"].map(input))),
        _ if case.has_input("G1") => {
            let [g1, g2, tau] = ["G1", "G2", "tau"].map(input);
            Box::new(solid([g1, g2, tau * g2]))
        }
        _ => Box::new(case.material()),
    }
}

/// A quantity of a material by its name in the casebook.
fn answer(name: &str, case: &Case, material: &dyn Material) -> f64 {
    let (relaxation, creep) = (material.relaxation(), material.creep());
    let modulus = || material.complex_modulus(case.input("omega")).unwrap();
    let compliance = |omega| material.complex_compliance(omega).unwrap();
    match name {
        "G_t" => material.relaxation_modulus(case.input("t")).unwrap(),
        "J_t" => material.creep_compliance(case.input("t")).unwrap(),
        "G_storage" => modulus().storage,
        "G_loss" => modulus().loss,
        "tan_delta" => material.loss_tangent(case.input("omega")).unwrap(),
        "J_storage" => compliance(case.input("omega")).storage,
        "J_loss" => compliance(case.input("omega")).loss,
        "J_storage_w037" => compliance(0.37).storage,
        "J_loss_w037" => compliance(0.37).loss,
        "G_glass" => relaxation.glass_modulus(),
        "J_glass" => creep.instantaneous_compliance(),
        "J_eq" => creep.equilibrium_compliance(),
        // A fluid has it in both spectra.
        "eta0" if creep.fluidity() > 0.0 => creep.fluidity().recip(),
        "eta0" => relaxation.zero_shear_viscosity(),
        "tau" => relaxation.branches()[0].relaxation_time,
        "tau_c" => creep.elements()[0].retardation_time,
        "alpha" => {
            // ω G'' tends to α; at Ω = ω τ_1 = 1e10 the next term is 1e-20 of it.
            let omega = 1e10 / relaxation.branches()[0].relaxation_time;
            omega * material.complex_modulus(omega).unwrap().loss
        }
        other => panic!("{} asks for {other}", case.id()),
    }
}

fn check_elements(case: &Case, creep: &CreepSpectrum) {
    let expected = ["J", "lam"].map(|name| case.expected_list(name).expect("a list"));
    assert_eq!(creep.elements().len(), expected[0].len(), "{}", case.id());
    let tolerance = case.relative_tolerance();
    for (index, element) in creep.elements().iter().enumerate() {
        let what = format!("{}: element {index}", case.id());
        assert_close!(element.compliance => expected[0][index], within tolerance; "{what}");
        assert_close!(element.retardation_time => expected[1][index], within tolerance; "{what}");
    }
}

#[test]
fn every_material_answers_as_in_the_casebook() {
    let groups = ["RHE-01", "RHE-03", "RHE-04", "RHE-05", "EXT-04"].map(casebook::group);
    for case in groups.concat() {
        let material = material(&case);
        // Each of the four factors of J is rounded once, even as the spring vanishes.
        let is_creep = case.id().starts_with("EXT-04/SLS");
        let tolerance = if is_creep {
            1e-15
        } else {
            case.relative_tolerance()
        };
        // Friction is tested where it is computed.
        let names = case.expected_names();
        for name in names.filter(|name| !["F", "mu"].contains(name)) {
            let answer = answer(name, &case, &material);
            if case.expected(name) == Some(f64::INFINITY) {
                assert_same(case.id(), answer, f64::INFINITY);
            } else {
                case.check_within(name, answer, tolerance);
            }
        }
        if case.expected_list("J").is_some() {
            check_elements(&case, &material.creep());
        }
    }
}

/// A series with a spring that vanishes creeps like the fluid without it.
#[test]
fn a_vanishing_spring_leaves_a_fluid() {
    for (moduli, times) in [(vec![1.0], vec![1.0]), (vec![1.0, 3.0], vec![0.5, 2.0])] {
        for time in [1e-3, 3.0, 1e6] {
            let [solid, fluid] = [1e-300, 0.0].map(|spring| {
                let creep = spectrum(spring, 0.0, &moduli, &times).to_creep();
                creep.unwrap().creep_compliance(time).unwrap()
            });
            assert_close!(solid => fluid, within 1e-14; "{moduli:?} at t = {time:e}");
        }
    }
}

#[test]
fn a_lone_dashpot_makes_the_first_instant_rigid() {
    let dashpots: [&dyn Material; 2] = [
        &Viscous::new(3.0).unwrap(),
        &KelvinVoigt::new(2.0, 3.0).unwrap(),
    ];
    for (material, later) in dashpots.into_iter().zip([0.0, 2.0]) {
        let [first, second] = [0.0, 1e-30].map(|t| material.relaxation_modulus(t).unwrap());
        assert_same(&format!("G(0) of {material:?}"), first, f64::INFINITY);
        assert_same(&format!("G of {material:?}"), second, later);
    }
}

/// Far below every 1/τ the storage modulus of a fluid underflows, its loss tangent does not.
#[test]
fn loss_tangent_of_a_fluid_survives_the_underflow_of_its_storage_modulus() {
    let fluid = Maxwell::new(2.0, 6.0).unwrap();
    for omega in [1e-150, 1e-200, 1e-300] {
        let actual = fluid.loss_tangent(omega).unwrap();
        assert_close!(actual => 1.0 / (3.0 * omega), within 1e-15; "ω = {omega:e}");
    }
    let at_rest = |material: &dyn Material| material.loss_tangent(0.0).unwrap();
    assert_same("tan δ at rest", at_rest(&fluid), f64::INFINITY);
    assert_same(
        "tan δ of a spring",
        at_rest(&Elastic::new(1e-300).unwrap()),
        0.0,
    );
    // ω η/G of a solid that is as soft.
    let soft = KelvinVoigt::new(1e-300, 1e-300).unwrap();
    assert_close!(soft.loss_tangent(0.5).unwrap() => 0.5, within 1e-15);
}
