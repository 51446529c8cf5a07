use casebook::{NEGATIVE, NOT_POSITIVE, fixed_cases, refused, refuses, standard_solid};
use proptest::prelude::*;
use rheology::{
    ArrheniusShift, Compressible, CreepSpectrum, Elastic, ExponentialStep, KelvinVoigt, Material,
    Maxwell, Prony, RelaxationBranch, RelaxationSpectrum, RetardationElement, RheologyError,
    Springpot, StandardSolid, Viscous, WlfShift, check_spectra,
};

use crate::support::{assert_same, fractional_maxwell, solid};

#[test]
fn materials_refuse_moduli_viscosities_and_ratios_outside_their_range() {
    let bad = NOT_POSITIVE;
    let solid_of = standard_solid;
    refuses("equilibrium_modulus", bad, |x| solid_of([x, 1.0, 1.0]));
    refuses("maxwell_modulus", bad, |x| standard_solid([1.0, x, 1.0]));
    refuses("viscosity", bad, |x| standard_solid([1.0, 1.0, x]));
    refuses("viscosity", bad, Viscous::new);
    refuses("shear_modulus", bad, Elastic::new);
    refuses("shear_modulus", bad, |x| Maxwell::new(x, 1.0));
    refuses("viscosity", bad, |x| Maxwell::new(1.0, x));
    refuses("shear_modulus", bad, |x| KelvinVoigt::new(x, 1.0));
    refuses("viscosity", bad, |x| KelvinVoigt::new(1.0, x));
    // Numbers whose inverse or quotient does not exist.
    let tiny = 1e-320;
    refused("fluidity", Viscous::new(tiny));
    refused("compliance", Elastic::new(tiny));
    refused("compliance", Maxwell::new(tiny, 1.0));
    refused("fluidity", KelvinVoigt::new(1.0, tiny));
    refused("relaxation_time", Maxwell::new(1e-300, 1e300));
    for (numbers, name) in [
        ([1e300, 1e-300, 1.0], "stiffness_ratio"),
        ([1e-200, 1e200, 1.0], "stiffness_ratio"),
        ([1e-200, 1e-200, 1e200], "relaxation_time"),
        ([1e-200, 1.0, 1e200], "retardation_time"),
        ([1e-320, 1.0, 1e-20], "retardation_compliance"),
        ([f64::MAX, f64::MAX, 1.0], "glass_modulus"),
    ] {
        refused(name, standard_solid(numbers));
    }
    let elastic = Elastic::new(1.0).unwrap();
    let compressible = |ratio| Compressible::new(&elastic, ratio);
    let bad = &[f64::NAN, f64::INFINITY, -1.0, -2.0, 0.500_001];
    refuses("poisson_ratio", bad, compressible);
    assert_same("incompressible", elastic.half_space_factor(), 1.0);
    for (ratio, factor) in [(0.5, 1.0), (0.25, 1.5), (0.0, 2.0), (-0.5, 3.0)] {
        let factor_there = compressible(ratio).unwrap().half_space_factor();
        assert_same(&format!("ν = {ratio}"), factor_there, factor);
    }
}

fn relaxing(
    spring: f64,
    dashpot: f64,
    branch: [f64; 2],
) -> Result<RelaxationSpectrum, RheologyError> {
    let branches = [[1.0, 1.0], branch].map(|[modulus, relaxation_time]| RelaxationBranch {
        modulus,
        relaxation_time,
    });
    RelaxationSpectrum::new(spring, dashpot, branches.to_vec())
}

fn creeping(spring: f64, dashpot: f64, element: [f64; 2]) -> Result<CreepSpectrum, RheologyError> {
    let [compliance, retardation_time] = element;
    let element = RetardationElement {
        compliance,
        retardation_time,
    };
    CreepSpectrum::new(spring, dashpot, vec![element])
}

#[test]
fn spectra_name_the_list_and_the_place_of_a_bad_number() {
    let one = [1.0, 1.0];
    let branch = |g, tau| relaxing(0.0, 0.0, [g, tau]);
    refuses("equilibrium_modulus", NEGATIVE, |x| relaxing(x, 0.0, one));
    refuses("viscosity", NEGATIVE, |x| relaxing(0.0, x, one));
    refuses("modulus of branches[1]", NEGATIVE, |x| branch(x, 1.0));
    let time = "relaxation_time of branches[1]";
    refuses(time, NOT_POSITIVE, |x| branch(1.0, x));
    refused("glass_modulus", relaxing(f64::MAX, 0.0, [f64::MAX, 1.0]));
    refused("zero_shear_viscosity", branch(1e200, 1e200));
    let element = |j, lambda| creeping(0.0, 0.0, [j, lambda]);
    let instantaneous = "instantaneous_compliance";
    refuses(instantaneous, NEGATIVE, |x| creeping(x, 0.0, one));
    refuses("fluidity", NEGATIVE, |x| creeping(0.0, x, one));
    refuses("compliance of elements[0]", NEGATIVE, |x| element(x, 1.0));
    let time = "retardation_time of elements[0]";
    refuses(time, NOT_POSITIVE, |x| element(1.0, x));
    let sum = creeping(f64::MAX, 0.0, [f64::MAX, 1.0]);
    refused("recoverable_compliance", sum);
    refused("initial_fluidity", element(1e200, 1e-200));
    let nothing = RelaxationSpectrum::new(0.0, 0.0, Vec::new());
    assert_eq!(nothing, Err(RheologyError::NoStiffness), "no stiffness");
    let rigid = element(0.0, 1.0);
    assert_eq!(rigid, Err(RheologyError::NoCompliance), "no compliance");
}

#[test]
fn times_frequencies_and_steps_outside_their_range_are_refused() {
    let (maxwell, solid) = (Maxwell::new(1.0, 1.0).unwrap(), solid([1.0, 2.0, 3.0]));
    let creep = maxwell.creep();
    refuses("time_step", NOT_POSITIVE, |step| {
        ExponentialStep::creep(&creep, step)
    });
    refuses("time", NEGATIVE, |x| maxwell.creep_compliance(x));
    refuses("time", NEGATIVE, |x| maxwell.relaxation_modulus(x));
    let omega = "angular_frequency";
    refuses(omega, NEGATIVE, |x| solid.complex_modulus(x));
    refuses(omega, NEGATIVE, |x| solid.complex_compliance(x));
    refuses(omega, NEGATIVE, |x| solid.loss_tangent(x));
}

#[test]
fn fractional_elements_and_their_expansions_refuse_what_has_no_series() {
    let no_exponent = [0.0, 1.0, -0.5, f64::NAN];
    let maxwell = fractional_maxwell;
    refuses("coefficient", NOT_POSITIVE, |x| Springpot::new(x, 0.5));
    refuses("exponent", &no_exponent, |x| Springpot::new(1.0, x));
    refuses("shear_modulus", NOT_POSITIVE, |x| maxwell([x, 1.0, 0.5]));
    refuses("relaxation_time", NOT_POSITIVE, |x| maxwell([1.0, x, 0.5]));
    refuses("exponent", &no_exponent, |x| maxwell([1.0, 1.0, x]));
    let springpot = Springpot::new(1.0, 0.5).unwrap();
    refuses("time", NEGATIVE, |x| springpot.relaxation_modulus(x));
    refuses("time", NEGATIVE, |x| springpot.creep_compliance(x));
    let (omega, element) = ("angular_frequency", maxwell([1.0, 1.0, 0.5]).unwrap());
    refuses(omega, NEGATIVE, |x| springpot.complex_modulus(x));
    refuses(omega, NEGATIVE, |x| element.complex_modulus(x));
    let expand = |low, high, error| springpot.expand([low, high], error);
    refuses("lowest_frequency", NOT_POSITIVE, |x| expand(x, 1.0, 1e-3));
    refuses("highest_frequency", NOT_POSITIVE, |x| expand(1.0, x, 1e-3));
    refuses("highest_frequency", &[1.0, 0.5], |x| expand(1.0, x, 1e-3));
    refuses("relative_error", NOT_POSITIVE, |x| expand(1.0, 2.0, x));
    refuses("relative_error", &[1e-16, 0.5], |x| expand(1.0, 2.0, x));
}

#[test]
fn shifts_refuse_constants_and_temperatures_outside_their_range() {
    let (wlf, arrhenius) = (WlfShift::new, ArrheniusShift::new);
    refuses("c1", NOT_POSITIVE, |x| wlf(x, 1.0, 20.0));
    refuses("c2", NOT_POSITIVE, |x| wlf(1.0, x, 20.0));
    let infinite = &[f64::NAN, f64::INFINITY];
    refuses("temperature", infinite, |x| wlf(1.0, 1.0, x));
    let law = wlf(1.0, 1.0, 20.0).unwrap();
    refuses("temperature", infinite, |x| law.log10_factor(x));
    refuses("activation_energy", NOT_POSITIVE, |x| arrhenius(x, 300.0));
    let reference = "reference_temperature";
    refuses(reference, NOT_POSITIVE, |x| arrhenius(1.0, x));
    let law = ArrheniusShift::new(1.0, 300.0).unwrap();
    refuses("temperature", NOT_POSITIVE, |x| law.log10_factor(x));
    let spectrum = relaxing(1.0, 0.0, [1.0, 1.0]).unwrap();
    refuses("shift_factor", NOT_POSITIVE, |x| spectrum.shifted(x));
}

proptest! {
    #![proptest_config(fixed_cases(256))]

    /// Whatever is accepted answers with numbers.
    #[test]
    fn accepted_materials_never_answer_nan(
        logs in prop::array::uniform3(-320.0_f64..320.0),
        log_omega in -320.0_f64..320.0,
    ) {
        if let Ok(solid) = standard_solid(logs.map(|log| 10_f64.powf(log))) {
            let omega = 10_f64.powf(log_omega).min(f64::MAX);
            let peak = solid.loss_peak();
            let mut answers = vec![
                solid.relaxation_modulus(omega).unwrap(),
                solid.creep_compliance(omega).unwrap(),
                peak.angular_frequency,
                peak.loss_tangent,
            ];
            for omega in [0.0, omega] {
                let modulus = solid.complex_modulus(omega).unwrap();
                answers.extend([modulus.storage, modulus.loss, solid.loss_tangent(omega).unwrap()]);
                let compliance = solid.complex_compliance(omega).unwrap();
                answers.extend([compliance.storage, compliance.loss]);
            }
            prop_assert!(answers.iter().all(|x| !x.is_nan()), "{:?}: {:?}", solid, answers);
        }
    }
}

/// A material that relaxes as one solid and creeps as another.
#[derive(Debug)]
struct Contradictory {
    relaxing: StandardSolid,
    creeping: StandardSolid,
}

impl Material for Contradictory {
    fn relaxation(&self) -> RelaxationSpectrum {
        self.relaxing.relaxation()
    }

    fn creep(&self) -> CreepSpectrum {
        self.creeping.creep()
    }
}

#[test]
fn spectra_that_contradict_each_other_are_refused() {
    let one = standard_solid([1.0, 10.0, 1.0]).unwrap();
    let branches = (0..60).map(|n| {
        let decades = f64::from(n) / 3.0 - 10.0;
        RelaxationBranch::new(10_f64.powf(-0.3 * decades), 10_f64.powf(decades))
    });
    let broad = RelaxationSpectrum::new(1e-3, 0.0, branches.collect()).unwrap();
    let right: [Box<dyn Material>; 7] = [
        Box::new(Elastic::new(1e150).unwrap()),
        Box::new(Viscous::new(1e-150).unwrap()),
        Box::new(KelvinVoigt::new(2.0, 3.0).unwrap()),
        Box::new(Maxwell::new(2.0, 3e9).unwrap()),
        Box::new(one),
        Box::new(Compressible::new(&one, 0.3).unwrap()),
        Box::new(Prony::new(broad).unwrap()),
    ];
    for material in right {
        let found = check_spectra(&material);
        assert!(found.is_ok(), "{material:?}: {found:?}");
    }
    for factor in [1.0 + 1e-5, 10.0] {
        let wrong = Contradictory {
            relaxing: one,
            creeping: standard_solid([factor, 10.0, 1.0]).unwrap(),
        };
        let refused = check_spectra(&wrong)
            .expect_err("two materials")
            .to_string();
        assert!(
            refused.contains("both spectra must describe the same material"),
            "{refused}"
        );
    }
}
