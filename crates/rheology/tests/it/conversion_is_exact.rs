use casebook::assert_close;
use rheology::{CreepSpectrum, RelaxationSpectrum};

use crate::support::{casebook_spectrum, spectrum};

fn spectrum_of(model: &str) -> RelaxationSpectrum {
    let cases = casebook::group("RHE-05");
    let case = cases
        .iter()
        .find(|case| case.id() == format!("RHE-05/{model}/spectrum"))
        .expect("the model is in RHE-05");
    casebook_spectrum(case)
}

fn check_elements(case: &casebook::Case, creep: &CreepSpectrum) {
    let expected = ["J", "lam"].map(|name| case.expected_list(name).expect("a list"));
    assert_eq!(creep.elements().len(), expected[0].len(), "{}", case.id());
    for (index, element) in creep.elements().iter().enumerate() {
        let what = format!("{}: J[{index}]", case.id());
        let tolerance = case.relative_tolerance();
        assert_close!(element.compliance => expected[0][index], within tolerance; "{what}");
        let what = format!("{}: λ[{index}]", case.id());
        assert_close!(element.retardation_time => expected[1][index], within tolerance; "{what}");
    }
}

#[test]
fn creep_of_prony_series_matches_exact_numbers() {
    for case in casebook::group("RHE-05") {
        let relaxation = spectrum_of(case.input_text("model"));
        let creep = relaxation.to_creep().unwrap();
        if case.expected("J_t").is_some() {
            case.check("J_t", creep.creep_compliance(case.input("t")).unwrap());
            continue;
        }
        check_elements(&case, &creep);
        case.check("J_glass", creep.instantaneous_compliance());
        if case.expected("J_eq").is_some() {
            case.check("J_eq", creep.equilibrium_compliance());
        }
        if case.expected("eta0").is_some() {
            case.check("eta0", creep.fluidity().recip());
        }
        let compliance = creep.complex_compliance(0.37).unwrap();
        case.check("J_storage_w037", compliance.storage);
        case.check("J_loss_w037", compliance.loss);
    }
}

#[test]
fn equal_times_are_one_branch() {
    for case in casebook::group("EXT-04") {
        if !case.has_input("Ge") {
            continue;
        }
        let relaxation = casebook_spectrum(&case);
        let creep = relaxation.to_creep().unwrap();
        check_elements(&case, &creep);
        case.check("J_glass", creep.instantaneous_compliance());
        let modulus = relaxation.complex_modulus(case.input("omega")).unwrap();
        case.check("G_storage", modulus.storage);
        case.check("G_loss", modulus.loss);
    }
}

#[test]
fn a_branch_without_modulus_is_dropped() {
    let with = spectrum(1.0, 0.0, &[2.0, 0.0, 3.0], &[0.1, 1.0, 10.0]);
    assert_eq!(
        with,
        spectrum(1.0, 0.0, &[3.0, 2.0], &[10.0, 0.1]),
        "sorted and without zeros"
    );
}
