use rheology::{Elastic, KelvinVoigt, Material, Maxwell, Viscous};

use crate::support::{assert_same, casebook_spectrum, named_spectrum, solid};

fn elementary(case: &casebook::Case) -> Box<dyn Material> {
    let [g, eta] = ["G", "eta"].map(|name| {
        if case.has_input(name) {
            case.input(name)
        } else {
            f64::NAN
        }
    });
    match case.id() {
        "RHE-03/elastic" => Box::new(Elastic::new(g).unwrap()),
        "RHE-03/viscous" => Box::new(Viscous::new(eta).unwrap()),
        "RHE-03/kelvin-voigt" => Box::new(KelvinVoigt::new(g, eta).unwrap()),
        "RHE-03/maxwell" => Box::new(Maxwell::new(g, eta).unwrap()),
        "RHE-03/sls" => Box::new(solid(["G1", "G2", "eta"].map(|name| case.input(name)))),
        other => panic!("{other} has no material"),
    }
}

#[test]
fn elementary_materials_match_the_textbook() {
    for case in casebook::group("RHE-03") {
        let material = elementary(&case);
        let (t, omega) = (case.input("t"), case.input("omega"));
        case.check("J_t", material.creep_compliance(t).unwrap());
        case.check("G_storage", material.storage_modulus(omega).unwrap());
        case.check("G_loss", material.loss_modulus(omega).unwrap());
        match case.expected("tan_delta") {
            Some(f64::INFINITY) => assert_same(
                case.id(),
                material.loss_tangent(omega).unwrap(),
                f64::INFINITY,
            ),
            _ => case.check("tan_delta", material.loss_tangent(omega).unwrap()),
        }
        if case.expected("G_t").is_some() {
            case.check("G_t", material.relaxation_modulus(t).unwrap());
        }
        if case.expected("J_storage").is_some() {
            let compliance = material.complex_compliance(omega).unwrap();
            case.check("J_storage", compliance.storage);
            case.check("J_loss", compliance.loss);
        }
        if case.expected("tau_c").is_some() {
            let creep = material.creep();
            case.check("tau_c", creep.elements()[0].retardation_time);
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

#[test]
fn prony_series_match_over_13_decades() {
    for case in casebook::group("RHE-04") {
        let prony = named_spectrum(case.input_text("model"));
        if case.has_input("G") {
            let given = casebook_spectrum(&case);
            case.check("G_glass", given.glass_modulus());
            case.check("eta0", given.zero_shear_viscosity());
            // ω G'' tends to α; at Ω = ω τ_1 = 1e10 the next term is 1e-20 of it.
            let omega = 1e10 / given.branches()[0].relaxation_time;
            let loss = given.complex_modulus(omega).unwrap().loss;
            case.check("alpha", omega * loss);
        } else if case.has_input("omega") {
            let omega = case.input("omega");
            let modulus = prony.complex_modulus(omega).unwrap();
            case.check("G_storage", modulus.storage);
            case.check("G_loss", modulus.loss);
            case.check("tan_delta", prony.loss_tangent(omega).unwrap());
        } else {
            case.check("G_t", prony.relaxation_modulus(case.input("t")).unwrap());
        }
    }
}

/// Far below every 1/τ the storage modulus of a fluid underflows, its loss tangent does not.
#[test]
fn loss_tangent_of_a_fluid_survives_the_underflow_of_its_storage_modulus() {
    let fluid = Maxwell::new(2.0, 6.0).unwrap();
    for omega in [1e-150, 1e-200, 1e-300] {
        let expected = 1.0 / (3.0 * omega);
        let actual = fluid.loss_tangent(omega).unwrap();
        assert!(
            (actual / expected - 1.0).abs() < 1e-15,
            "tan δ at ω = {omega:e} is {actual:e}, expected {expected:e}"
        );
    }
    assert_same(
        "tan δ at rest",
        fluid.loss_tangent(0.0).unwrap(),
        f64::INFINITY,
    );
    let elastic = Elastic::new(2.0).unwrap();
    assert_same("tan δ of a spring", elastic.loss_tangent(0.0).unwrap(), 0.0);
}

/// ∫ f d ln x over (−∞, ∞) by the trapezoidal rule with nodes half a step off x = `centre`.
///
/// The integrands are analytic within π/2 of the real axis and die out like 1/x at both ends: the step 0.2 errs by
/// e^(−π²/0.2), the ends at e^±50 by 1e-20. A simple pole at the centre, half a step away on both sides, leaves its
/// principal value.
fn integral_over_logarithm(centre: f64, integrand: impl Fn(f64) -> f64) -> f64 {
    let step = 0.2;
    let nodes = (-250..250).map(|k| centre * (step * (f64::from(k) + 0.5)).exp());
    nodes.map(integrand).sum::<f64>() * step
}

#[test]
fn storage_and_loss_obey_kramers_and_kronig() {
    for case in casebook::group("RHE-06") {
        let material = named_spectrum(case.input_text("model"));
        let loss = |x: f64| material.complex_modulus(x).unwrap().loss;
        if case.expected("int_Gloss_dlnw").is_some() {
            case.check("int_Gloss_dlnw", integral_over_logarithm(1.0, loss));
            continue;
        }
        let omega = case.input("omega");
        // G' = G_∞ + 2/π P∫ G''(x) ω²/(ω² − x²) d ln x
        let transform = integral_over_logarithm(omega, |x| {
            let ratio = x / omega;
            loss(x) / ((1.0 - ratio) * (1.0 + ratio))
        });
        let storage = material.equilibrium_modulus() + transform * std::f64::consts::FRAC_2_PI;
        case.check("G_storage", storage);
        case.check(
            "G_storage",
            material.complex_modulus(omega).unwrap().storage,
        );
    }
}
