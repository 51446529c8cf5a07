//! Moduli, shift laws and shear strengths come back from friction that was computed with them, with intervals that say what is not
//! determined.

use std::path::Path;

use measurements::Finding;
use measurements::friction::{FrictionNoise, FrictionPoint};
use viscofriction::friction_fit::{
    FittedFriction, Free, FrictionFitError, FrictionFitOptions, FrictionPrior, fit_friction,
};
use viscofriction::scene::{EnergyUnit, Interface, MaterialTable, Shift, ShiftLaw, VerticalLaw};
use viscofriction::{Problem, Scene, WrongInput, solve};

const BALL: &str = "[indenter.sphere]\nradius = 5e-3\n[load]\nnormal_force = 1.0\nvelocity = 1.0\n";
const LINE: &str = "[solve]\nmodel = \"line\"\n";

/// A ball on a rubber with a spring and a slow and a fast branch, and what stands beside its moduli.
fn rubber([spring, slow, fast]: [f64; 3], beside: &str, solve: &str) -> Scene {
    let text = format!(
        "{BALL}[material.prony]\nequilibrium_modulus = {spring:e}\n{beside}\nbranches = [{{ modulus = {slow:e}, \
         relaxation_time = 0.1 }}, {{ modulus = {fast:e}, relaxation_time = 1e-3 }}]\n{solve}"
    );
    text.parse().expect("a scene")
}

const TRUE: [f64; 3] = [1e6, 5e5, 2e6];
const START: [f64; 3] = [1e6; 3];

/// A material without times of its own under a paraboloid, which has a closed form in the one-dimensional model.
fn damped(spring: f64, viscosity: f64, beside: &str) -> Scene {
    format!(
        "[indenter.paraboloid]\ncurvature = 100.0\n[load]\nnormal_force = 1.0\nvelocity = 1.0\n[material.prony]\n\
         equilibrium_modulus = {spring:e}\nviscosity = {viscosity:e}\nbranches = []\n{beside}\n{LINE}"
    )
    .parse()
    .expect("a scene")
}

/// Friction at these speeds, with the standard error.
fn measured(scene: &Scene, speeds: &[f64], error: Option<f64>) -> Vec<FrictionPoint> {
    let point = |&velocity: &f64| {
        let mut scene = scene.clone();
        scene.load.velocity = Some(velocity);
        let problem = Problem::try_from(&scene).expect("a problem");
        let friction = solve(&problem).expect("an answer").friction_coefficient;
        let friction = friction.expect("a friction").value;
        FrictionPoint {
            velocity,
            friction_coefficient: friction,
            standard_error: error.map(|error| error * friction),
            ..FrictionPoint::default()
        }
    };
    speeds.iter().map(point).collect()
}

fn speeds(slowest: f64, fastest: f64, n: i32) -> Vec<f64> {
    let at = |k: i32| slowest * (fastest / slowest).powf(f64::from(k) / f64::from(n - 1));
    (0..n).map(at).collect()
}

fn fit(
    scene: &Scene,
    points: &[FrictionPoint],
    options: FrictionFitOptions,
) -> Result<FittedFriction, FrictionFitError> {
    let no_files = |path: &Path, _| Err(WrongInput(path.display().to_string()));
    fit_friction(scene, (Path::new(""), no_files), points, &options, &|_| ())
}

#[track_caller]
fn assert_near(finding: &Finding, truth: f64, deviations: f64) {
    let found = finding.estimate.expect("determined");
    assert!(
        (found.value - truth).abs() <= deviations * found.error,
        "{}: {} ± {}, and {truth} is true",
        finding.name,
        found.value,
        found.error
    );
}

/// Without noise the fit is the truth, up to what the last step leaves.
#[test]
fn moduli_come_back_from_the_one_dimensional_model() {
    let points = measured(&rubber(TRUE, "", LINE), &speeds(1e-4, 3.0, 8), Some(0.02));
    let known = "covariance.relative = [[0.01, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.0, 0.01]]";
    let start = rubber(START, known, LINE);
    // It is of another material.
    let options = FrictionFitOptions {
        prior: FrictionPrior::None,
        ..FrictionFitOptions::default()
    };
    let found = fit(&start, &points, options).expect("a fit");
    assert!(
        found.material.covariance().is_none(),
        "other moduli are not known as those of the scene are"
    );
    let names = [
        "branches[0].modulus",
        "branches[1].modulus",
        "equilibrium_modulus",
    ];
    let truth = [TRUE[1], TRUE[2], TRUE[0]];
    for ((finding, name), truth) in found.fit.findings.iter().zip(names).zip(truth) {
        assert_eq!(finding.name, format!("prony.{name}"), "the order");
        assert_near(finding, truth, 0.05);
    }
    assert!(
        found.fit.residual < 1e-2 && found.fit.flags.is_empty(),
        "{:?}",
        found.fit
    );
}

/// The grids of the fit are coarse, and what they lack is corrected: below a quarter of the noise of 2 % of each point.
#[test]
fn moduli_come_back_from_the_half_space_on_any_number_of_threads() {
    let points = measured(&rubber(TRUE, "", ""), &speeds(1e-3, 3.0, 6), Some(0.02));
    let on_threads = |n: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build();
        let options = FrictionFitOptions::default();
        let fit = || fit(&rubber(START, "", ""), &points, options).expect("a fit");
        pool.expect("threads").install(fit)
    };
    let found = on_threads(2);
    let truth = [TRUE[1], TRUE[2], TRUE[0]];
    for (finding, truth) in found.fit.findings.iter().zip(truth) {
        assert_near(finding, truth, 0.25);
    }
    assert_eq!(found, on_threads(1), "on one thread");
}

/// Where the dashpot bears everything, the spring may be as soft as it likes.
#[test]
fn what_friction_does_not_tell_is_not_determined() {
    let points = measured(&damped(1e6, 1e4, ""), &speeds(1.0, 10.0, 8), Some(0.05));
    let found = fit(
        &damped(2e6, 3e3, ""),
        &points,
        FrictionFitOptions::default(),
    );
    let findings = found.expect("a fit").fit.findings;
    let spring = &findings[0];
    assert_eq!(
        (spring.estimate, spring.interval[0]),
        (None, None),
        "{spring:?}"
    );
    assert!(
        spring.interval[1].is_some_and(|upper| upper > 1e6),
        "{spring:?}"
    );
    assert_near(&findings[1], 1e4, 0.05);
}

/// A fast branch beside a slow one at low speeds is not determined; what is known beforehand is, of branches that relax at the
/// frequencies at which the material was measured.
#[test]
fn priors_are_for_measured_frequencies() {
    let points = measured(&rubber(TRUE, "", LINE), &speeds(1e-4, 5e-3, 4), Some(0.02));
    let fast = |window: &str| {
        let options = FrictionFitOptions {
            prior: FrictionPrior::Relative(0.1),
            ..FrictionFitOptions::default()
        };
        let found = fit(&rubber(START, window, LINE), &points, options).expect("a fit");
        found.fit.findings[1].clone()
    };
    let free = fast("valid_frequencies = [0.01, 1.0]");
    assert_eq!((free.estimate, free.interval[0]), (None, None), "{free:?}");
    let known = fast("valid_frequencies = [500.0, 2e3]");
    let spread = known.estimate.expect("determined").error / START[2];
    assert!((0.05..0.11).contains(&spread), "{known:?}");
}

/// Friction at several temperatures by this law.
fn at_temperatures(shift: &Shift) -> Vec<FrictionPoint> {
    let isotherm = |temperature: f64| {
        let factor = 10_f64.powf(shift.log10_factor(temperature).expect("a factor"));
        // The colder, the slower is the material.
        let faster = speeds(1e-3, 1.0, 6);
        let faster: Vec<f64> = faster.iter().map(|speed| speed * factor).collect();
        let stiffer = shift.modulus_factor(temperature).expect("a factor");
        let material = damped(1e6 * stiffer, 1e4 * stiffer, "");
        let row = measured(&material, &faster, Some(0.02));
        row.into_iter().map(move |point| FrictionPoint {
            velocity: point.velocity / factor,
            temperature: Some(temperature),
            ..point
        })
    };
    let temperatures = [-10.0, 5.0, 20.0, 40.0, 60.0];
    temperatures.into_iter().flat_map(isotherm).collect()
}

#[test]
fn shift_laws_come_back_from_several_temperatures() {
    let laws = [
        (ShiftLaw::Wlf([12.0, 70.0]), ShiftLaw::Wlf([17.44, 51.6])),
        (ShiftLaw::Arrhenius(1.2e5), ShiftLaw::Arrhenius(5e4)),
    ];
    let vertical = [None, Some(VerticalLaw::Entropic)];
    for ((truth, start), vertical) in laws.into_iter().zip(vertical) {
        let shift = Shift {
            temperature: 20.0,
            temperature_range: [-20.0, 60.0],
            law: truth,
            vertical,
        };
        let points = at_temperatures(&shift);
        let mut scene = damped(1e6, 1e4, "");
        if let MaterialTable::Prony { shift: own, .. } = &mut scene.material {
            *own = Some(Shift {
                law: start,
                ..shift
            });
        }
        let options = FrictionFitOptions {
            free: vec![Free::Shift],
            ..FrictionFitOptions::default()
        };
        let found = fit(&scene, &points, options).expect("a fit");
        let constants = match truth {
            ShiftLaw::Wlf(constants) => constants.to_vec(),
            ShiftLaw::Arrhenius(energy) => vec![energy],
        };
        assert_eq!(
            found.fit.findings.len(),
            constants.len(),
            "{:?}",
            found.fit.findings
        );
        for (finding, truth) in found.fit.findings.iter().zip(constants) {
            assert_near(finding, truth, 0.05);
        }
        let written: Scene = format!("{}{BALL}", found.material_file().expect("TOML"))
            .parse()
            .expect("a scene");
        assert_eq!(
            written.material, found.material,
            "what is written is what was found"
        );
    }
}

/// A bell of the shear strength with a_T = 1 at 20 °C.
fn bell(
    shear_strength: f64,
    velocity: f64,
    width: f64,
    activation_energy: Option<f64>,
) -> Interface {
    Interface::Bell {
        shear_strength,
        velocity,
        width,
        activation_energy,
        activation_energy_unit: EnergyUnit::JoulePerMole,
        reference_temperature: 20.0,
    }
}

/// A cylinder of 5 mm radius under 100 N/m on a rubber whose moduli shift with the temperature.
fn dry_cylinder(interface: Option<Interface>) -> Scene {
    let mut scene: Scene = "[indenter.cylinder]\nradius = 5e-3\n[load]\nnormal_force = 100.0\nvelocity = 1.0\n[material.prony]\n\
         equilibrium_modulus = 1e6\nbranches = [{ modulus = 2e6, relaxation_time = 1e-4 }, { modulus = 1e6, relaxation_time = \
         1e-2 }]\nshift = { temperature = 20.0, temperature_range = [0.0, 40.0], law = { wlf = [8.86, 101.6] }, vertical = \"entropic\" }\n[solve]\n\
         elements = 1024\n"
        .parse()
        .expect("a scene");
    scene.interface = interface;
    scene
}

/// Dry friction of [`dry_cylinder`] at these speeds and temperatures \[°C] with the shear strength τ_f(v, T): hysteresis and area
/// at the speed v a_T and under the force over b_T = T/T_0, shear at the speed v. Errors are 3 %, with these numbers of standard deviations.
fn dry_friction(
    speeds: &[f64],
    temperatures: &[f64],
    strength: impl Fn(f64, f64) -> f64,
    mut deviations: impl Iterator<Item = f64>,
) -> Vec<FrictionPoint> {
    let mut points = Vec::new();
    for &celsius in temperatures {
        for &velocity in speeds {
            let log_shift = -8.86 * (celsius - 20.0) / (101.6 + celsius - 20.0);
            let mut scene = dry_cylinder(None);
            scene.load.velocity = Some(velocity * 10_f64.powf(log_shift));
            scene.load.normal_force = Some(100.0 / ((celsius + 273.15) / 293.15));
            let answer = solve(&Problem::try_from(&scene).expect("a problem")).expect("an answer");
            let [hysteresis, area] = [answer.friction_coefficient, answer.contact_area];
            let shear = strength(velocity, celsius) * area.expect("an area").value / 100.0;
            let friction = hysteresis.expect("a friction").value + shear;
            let deviation = deviations.next().expect("endless");
            points.push(FrictionPoint {
                velocity,
                friction_coefficient: friction * (1.0 + 0.03 * deviation),
                standard_error: Some(0.03 * friction),
                temperature: Some(celsius),
                normal_force: None,
            });
        }
    }
    points
}

/// τ_0 = 50 kPa, v_0 = 5 mm/s, w = 2 and ε = 80 kJ/mol, with R = 8.314 J/(mol K).
fn bell_strength(velocity: f64, celsius: f64) -> f64 {
    let log_shift = 8e4 / 8.314_462_618 * (1.0 / (celsius + 273.15) - 1.0 / 293.15);
    let decades = ((velocity / 5e-3).ln() + log_shift) / std::f64::consts::LN_10;
    5e4 * (-(decades / 2.0).powi(2)).exp()
}

/// Numbers from −√3 to √3 with mean 0 and variance 1: multiples of the golden ratio.
fn scatter() -> impl Iterator<Item = f64> {
    let golden = 0.5 * (5_f64.sqrt() - 1.0);
    (1..).map(move |n: i32| 12_f64.sqrt() * ((golden * f64::from(n)).fract() - 0.5))
}

/// Keys of the bell, its numbers and their relative standard errors from 24 points of 3 %: those of linear least squares of ln τ_f.
const BELL: [(&str, f64, f64); 4] = [
    ("activation_energy", 8e4, 0.0154),
    ("shear_strength", 5e4, 0.0081),
    ("velocity", 5e-3, 0.0259),
    ("width", 2.0, 0.0071),
];

/// The material is kept, and the contact of each point is solved once. The intervals contain the true values.
#[test]
fn a_bell_comes_back_from_dry_friction_at_three_temperatures() {
    let start = dry_cylinder(Some(bell(2e4, 1e-3, 3.0, Some(1.2e5))));
    let temperatures = [0.0, 20.0, 40.0];
    let points = dry_friction(
        &speeds(1e-5, 1e-1, 8),
        &temperatures,
        bell_strength,
        scatter(),
    );
    let found = fit(&start, &points, FrictionFitOptions::default()).expect("a fit");
    assert_eq!(
        found.free,
        [Free::Interface],
        "of a scene with an interface"
    );
    assert_eq!(found.material, start.material, "it is kept");
    assert!(found.fit.flags.is_empty(), "{:?}", found.fit.flags);
    assert!(found.solver_error < 5e-3, "{}", found.solver_error);
    for (finding, (key, truth, error)) in found.fit.findings.iter().zip(BELL) {
        assert_eq!(finding.name, format!("interface.bell.{key}"), "the order");
        assert_near(finding, truth, 1.96);
        let found = finding.estimate.expect("determined").error / truth;
        assert!(
            (0.85..1.15).contains(&(found / error)),
            "{key}: {found} for {error}"
        );
    }
    let written = found.interface_file().expect("TOML").expect("an interface");
    let written: toml::Table = written.parse().expect("TOML");
    let again = Interface::try_from(written).expect("an interface");
    assert_eq!(
        Some(again),
        found.interface,
        "what is written is what was found"
    );
}

/// Below the speed v_0 the bell is as well a stronger one at a higher speed.
#[test]
fn a_bell_on_one_side_of_its_peak_is_not_determined() {
    let start = dry_cylinder(Some(bell(5e4, 5e-3, 2.0, None)));
    let points = dry_friction(&speeds(1e-7, 3e-7, 8), &[20.0], bell_strength, scatter());
    let found = fit(&start, &points, FrictionFitOptions::default()).expect("a fit");
    for finding in &found.fit.findings {
        assert_eq!(finding.estimate, None, "{finding:?}");
    }
    let said = found.fit.flags.join("\n");
    let expected = "do not determine interface.bell.shear_strength, interface.bell.velocity";
    assert!(said.contains(expected), "{said}");
}

/// Moduli and a constant shear strength together, on the half space.
#[test]
fn moduli_and_a_shear_strength_come_back_together() {
    let strength = 2e4;
    let constant = |shear_strength| Some(Interface::Constant { shear_strength });
    let points = dry_friction(
        &speeds(1e-3, 3.0, 8),
        &[20.0],
        |_, _| strength,
        std::iter::repeat(0.0),
    );
    let mut start = dry_cylinder(constant(5e4));
    if let MaterialTable::Prony { branches, .. } = &mut start.material {
        branches.iter_mut().for_each(|branch| branch.modulus *= 0.7);
    }
    let options = FrictionFitOptions {
        free: vec![Free::Moduli, Free::Interface],
        ..FrictionFitOptions::default()
    };
    let found = fit(&start, &points, options).expect("a fit");
    let truth = [2e6, 1e6, 1e6, strength];
    assert_eq!(
        found.fit.findings.len(),
        truth.len(),
        "{:?}",
        found.fit.findings
    );
    for (finding, truth) in found.fit.findings.iter().zip(truth) {
        assert_near(finding, truth, 0.3);
    }
    // A strength that is kept is part of the model.
    let kept = dry_cylinder(constant(strength));
    let options = FrictionFitOptions {
        free: vec![Free::Moduli],
        ..FrictionFitOptions::default()
    };
    let found = fit(&kept, &points, options).expect("a fit");
    for (finding, truth) in found.fit.findings.iter().zip(truth) {
        assert_near(finding, truth, 0.3);
    }
    assert_eq!(found.interface, kept.interface, "it is kept");
}

/// The law of fractional elements is found as a whole.
#[test]
fn power_laws_come_back() {
    let scene = |coefficient: f64, exponent: f64| -> Scene {
        format!(
            "{BALL}[material.springpot]\ncoefficient = {coefficient:e}\nexponent = {exponent}\ntime_range = [1e-6, 1e3]\n\
             {LINE}relative_error = 1e-4\n"
        )
        .parse()
        .expect("a scene")
    };
    let points = measured(&scene(1e6, 0.3), &speeds(1e-3, 1.0, 5), Some(0.02));
    let found = fit(&scene(3e6, 0.2), &points, FrictionFitOptions::default()).expect("a fit");
    for (finding, truth) in found.fit.findings.iter().zip([1e6, 0.3]) {
        assert_near(finding, truth, 0.05);
    }
}

#[test]
fn a_wrong_model_is_flagged() {
    let mut points = measured(&rubber(TRUE, "", LINE), &speeds(1e-4, 3.0, 24), Some(0.02));
    let one_time = damped(1e6, 1e4, "");
    let found = fit(&one_time, &points, FrictionFitOptions::default()).expect("a fit");
    assert_eq!(found.fit.flags.len(), 2, "{:?}", found.fit.flags);
    for point in &mut points {
        point.standard_error = None;
    }
    for noise in [FrictionNoise::Relative, FrictionNoise::Absolute] {
        let options = FrictionFitOptions {
            noise,
            ..FrictionFitOptions::default()
        };
        let found = fit(&one_time, &points, options).expect("a fit");
        assert!(
            found.fit.flags[0].contains("neighbouring speeds"),
            "{:?}",
            found.fit.flags
        );
    }
}

#[test]
fn what_cannot_be_fitted_is_refused_with_its_key() {
    let mut deep = rubber(START, "", "");
    deep.load.normal_force = None;
    deep.load.indentation_depth = Some(1e-5);
    let elastic = format!("{BALL}[material.elastic]\nshear_modulus = 1e6\n");
    let elastic: Scene = elastic.parse().expect("a scene");
    let law = "shift = { temperature = 20.0, temperature_range = [0.0, 40.0], law = { arrhenius = 1e5 } }";
    let (moduli, shift, shear) = (Free::Moduli, Free::Shift, Free::Interface);
    let plain = || rubber(START, "", "");
    let (cold, warm) = (None, Some(20.0));
    let shear_strength = 1e5;
    let mut dry = rubber(START, "", LINE);
    dry.interface = Some(Interface::Constant { shear_strength });
    let mut weak = plain();
    weak.interface = Some(Interface::Constant {
        shear_strength: -shear_strength,
    });
    let mut table = plain();
    let file = "shear.csv".into();
    table.interface = Some(Interface::Table { file });
    let mut no_temperature = plain();
    no_temperature.interface = Some(bell(1e5, 1e-3, 2.0, Some(8e4)));
    let cases = [
        (plain(), 3, cold, moduli, "at least 4 points"),
        (plain(), 0, cold, moduli, "at least 1 points"),
        (deep, 9, cold, moduli, "load.indentation_depth"),
        (elastic, 9, cold, moduli, "material.elastic"),
        (
            dry,
            9,
            cold,
            shear,
            "interface: the scene asks for the one-dimensional model",
        ),
        (weak, 9, cold, shear, "interface.constant.shear_strength"),
        (
            table,
            9,
            cold,
            shear,
            "interface: a table has no parameters",
        ),
        (
            plain(),
            9,
            cold,
            shear,
            "[interface.constant] or [interface.bell]",
        ),
        (
            no_temperature,
            9,
            cold,
            shear,
            "interface: it depends on the temperature",
        ),
        (plain(), 9, cold, shift, "needs one to begin with"),
        (rubber(START, law, ""), 9, warm, shift, "other temperatures"),
        (plain(), 9, warm, moduli, "has no shift law"),
    ];
    for (scene, n_points, temperature, free, expected) in cases {
        let point = FrictionPoint {
            velocity: 0.1,
            friction_coefficient: 0.1,
            temperature,
            ..FrictionPoint::default()
        };
        let options = FrictionFitOptions {
            free: vec![free],
            ..FrictionFitOptions::default()
        };
        let refused = fit(&scene, &vec![point; n_points], options).expect_err(expected);
        assert!(refused.to_string().contains(expected), "{refused}");
    }
}

#[test]
fn numbers_out_of_range_are_refused() {
    let point = FrictionPoint {
        velocity: 0.1,
        friction_coefficient: 0.1,
        ..FrictionPoint::default()
    };
    let many = vec![point; 9];
    let refused = |points: &[FrictionPoint], prior| {
        let options = FrictionFitOptions {
            prior,
            ..FrictionFitOptions::default()
        };
        let refused = fit(&rubber(START, "", ""), points, options);
        refused.expect_err("out of range").to_string()
    };
    let with = |change: fn(&mut FrictionPoint)| {
        let mut points = many.clone();
        change(&mut points[0]);
        points
    };
    let cases = [
        (
            with(|one| one.standard_error = Some(0.01)),
            "number of standard errors",
        ),
        (
            with(|one| one.friction_coefficient = -0.1),
            "friction coefficient",
        ),
        (with(|one| one.velocity = 0.0), "velocity"),
    ];
    for (points, expected) in cases {
        let refused = refused(&points, FrictionPrior::None);
        assert!(refused.contains(expected), "{refused}");
    }
    let refused = refused(&many, FrictionPrior::Relative(-1.0));
    assert!(refused.contains("prior"), "{refused}");
}
