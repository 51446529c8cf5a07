//! Derivatives of answers by the numbers of their scenes.

use std::path::Path;
use std::sync::Mutex;

use numerics::{Estimate, Progress, SilentProgress};
use viscofriction::solve::{Sensitivity, Source, spectral_sensitivity, with_sensitivity};
use viscofriction::{Answer, Problem, Quantity, Scene, SolveError, WrongInput, solve};

pub(crate) fn no_file(path: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    Err(WrongInput(format!("{}: no file", path.display())))
}

/// The completed fractions, in the order of their reports.
#[derive(Debug, Default)]
pub(crate) struct Told(pub(crate) Mutex<Vec<f64>>);

impl Told {
    /// More and more was done, and in the end all.
    fn assert_done(self) {
        let told = self.0.into_inner().expect("parts");
        assert!(told.len() > 2 && told.is_sorted(), "{told:?}");
        assert!((told[told.len() - 1] - 1.0).abs() < 1e-12, "{told:?}");
    }
}

impl Progress for Told {
    fn may_refine(&self, _: usize) -> bool {
        true
    }

    fn report(&self, part: f64) {
        self.0.lock().expect("parts").push(part);
    }
}

fn solved(text: &str) -> Answer {
    let scene: Scene = text.parse().expect("a scene");
    solve(&Problem::try_from(&scene).expect("a problem")).expect("an answer")
}

pub(crate) fn answered(text: &str) -> (Answer, Result<Vec<Sensitivity>, SolveError>) {
    let scene: Scene = text.parse().expect("a scene");
    let problem = Problem::try_from(&scene).expect("a problem");
    let answer = solve(&problem).expect("an answer");
    let files = (Path::new(""), no_file as _);
    let known = with_sensitivity(&scene, files, &problem, answer.clone(), &SilentProgress);
    (answer, known.map(|answer| answer.sensitivity))
}

pub(crate) fn of<'a>(known: &'a [Sensitivity], parameter: &str) -> &'a Sensitivity {
    let mut all = known.iter();
    let one = all.find(|one| one.parameter == parameter);
    one.unwrap_or_else(|| panic!("{parameter} is not in {known:?}"))
}

/// d³ ∝ F² k/G² and A³ ∝ F²/(G² k²) (Hertz 1881); ν is the largest there is.
#[test]
fn a_pressed_sphere_has_the_powers_of_its_closed_form() {
    let text = "indenter.paraboloid.curvature = 5.0\nmaterial.elastic = { shear_modulus = 1e6, poisson_ratio = 0.5 }\n\
                load = { normal_force = 2.0, velocity = 0.0 }\nsolve.duration = 1.0";
    let (_, known) = answered(text);
    let known = known.expect("derivatives");
    for (parameter, [depth, area]) in [
        ("load.normal_force", [2.0, 2.0]),
        ("material.elastic.shear_modulus", [-2.0, -2.0]),
        ("material.elastic.poisson_ratio", [-2.0, -2.0]),
        ("indenter.paraboloid.curvature", [1.0, -2.0]),
        ("solve.duration", [0.0, 0.0]),
    ] {
        let one = of(&known, parameter);
        for (known, expected) in [
            (one.derivatives.of("indentation_depth"), depth),
            (one.derivatives.of("contact_area"), area),
        ] {
            let known = known.expect("a derivative");
            let off = (known.value - expected / 3.0).abs();
            assert!(
                off <= known.error && known.error < 5e-6,
                "{parameter}: {known:?}"
            );
        }
    }
}

/// Over its contact it is a dashpot but for a thousandth: the adjoint equation is not solved in as many directions as are tried.
#[test]
fn a_nearly_viscous_cylinder_has_derivatives() {
    let text = "indenter.cylinder.radius = 1.36\n\
                material.kelvin-voigt = { shear_modulus = 4.22e4, viscosity = 350.0, poisson_ratio = 0.5 }\n\
                load = { normal_force = 1.73e4, velocity = 1.71e3 }\nsolve.relative_error = 0.02";
    let (_, known) = answered(text);
    let known = known.expect("derivatives");
    let [load, velocity, viscosity, modulus] = [
        "load.normal_force",
        "load.velocity",
        "material.kelvin-voigt.viscosity",
        "material.kelvin-voigt.shear_modulus",
    ]
    .map(|parameter| {
        let one = of(&known, parameter).derivatives.of("friction_coefficient");
        one.expect("a derivative")
    });
    // The friction depends on η v and on F/G with η v/G.
    let off = (load.value + viscosity.value + modulus.value).abs();
    let allowed = load.error + viscosity.error + modulus.error;
    assert!(off <= allowed, "{off} with {allowed}");
    let off = (velocity.value - viscosity.value).abs();
    assert!(off <= velocity.error + viscosity.error, "{off}");
}

/// Where the pressure is singular at the front, as on this cylinder, the gap ahead of it says how far the front moves.
#[test]
fn areas_with_a_singular_front_follow_the_gap_ahead() {
    let cylinder = "indenter.cylinder.radius = 5e-3\n\
                    material.kelvin-voigt = { shear_modulus = 1e6, viscosity = 3e3 }\n\
                    load = { normal_force = 100.0, velocity = 0.3 }\nsolve.relative_error = 1e-4";
    let (_, known) = answered(cylinder);
    let load = of(&known.expect("derivatives"), "load.normal_force").clone();
    let area = load
        .derivatives
        .of("contact_area")
        .expect("of the gap ahead");
    // By widths to 1e-5 of forces that differ by e^0.4 and e^0.8, to the fourth order.
    let (expected, error) = (1.0557, 0.0141);
    let is_near = (area.value - expected).abs() <= area.error + error;
    assert!(is_near && area.error < 0.03, "{area:?}");

    let slow = cylinder
        .replace("velocity = 0.3", "velocity = 1e-3")
        .replace("1e-4", "1e-3");
    let (_, known) = answered(&slow);
    let load = of(&known.expect("derivatives"), "load.normal_force").clone();
    let area = load
        .derivatives
        .of("contact_area")
        .expect("of Hertz, nearly");
    assert!((area.value - 0.5).abs() < 0.02, "{area:?}");

    let cone = "indenter.cone.slope = 0.1\nmaterial.viscous.viscosity = 3e3\n\
                load = { normal_force = 1.0, velocity = 0.1 }\nsolve.method = \"bem-steady\"";
    let (_, known) = answered(cone);
    let load = of(&known.expect("derivatives"), "load.normal_force").clone();
    let area = load
        .derivatives
        .of("contact_area")
        .expect("of a cone, by its one length");
    assert!((area.value - 2.0).abs() <= area.error, "{area:?}");
}

/// A sphere in contact up to a fifth of its radius has no power of the area: that of the sphere of Segedin (1957), with
/// F = E* ((a² + R²) artanh(a/R) − a R).
#[test]
fn areas_of_a_sphere_are_those_of_its_closed_form() {
    let sphere = "indenter.sphere.radius = 5e-3\n\
                  material.standard-solid = { equilibrium_modulus = 1e6, maxwell_modulus = 1.0, viscosity = 1.0 }\n\
                  load = { normal_force = 1.0, velocity = 0.3 }\nsolve.relative_error = 1e-3";
    let (_, known) = answered(sphere);
    let load = of(&known.expect("derivatives"), "load.normal_force").clone();
    let area = load.derivatives.of("contact_area").expect("an area");
    let off = (area.value - 0.659_762_3).abs();
    assert!(off <= area.error && area.error < 1e-3, "{area:?}");
}

/// The mean of the derivatives at both ends of a step is the slope over it, to the third order.
#[test]
fn derivatives_are_the_slopes_between_answers() {
    const STEP: f64 = 0.2;
    let scene = |load: &str, number: f64, value: f64| {
        format!(
            "indenter.sphere.radius = 5e-3\nlayer.thickness = 2e-3\nmaterial.standard-solid = {{ equilibrium_modulus = 1e6, \
             maxwell_modulus = {:?}, viscosity = 1e4 }}\nload = {{ {load} = {value:?}, velocity = 0.05 }}\n{}",
            number * 1e7,
            "solve.relative_error = 2e-3"
        )
    };
    for (load, value) in [("normal_force", 2.0), ("indentation_depth", 5e-5)] {
        let factor = STEP.exp();
        let start = answered(&scene(load, 1.0, value));
        for (parameter, end) in [
            (
                "material.standard-solid.maxwell_modulus",
                scene(load, factor, value),
            ),
            (
                &format!("load.{load}")[..],
                scene(load, 1.0, factor * value),
            ),
        ] {
            let end = answered(&end);
            let found = [&start, &end];
            let quantities: [fn(&Answer) -> Estimate; 2] = [
                |answer| answer.friction_coefficient.expect("a friction"),
                |answer| match answer.indentation_depth {
                    Some(depth) if depth.error > 0.0 => depth,
                    _ => answer.normal_force,
                },
            ];
            for (index, quantity) in quantities.into_iter().enumerate() {
                let [from, to] = found.map(|(answer, _)| quantity(answer));
                let slope = (to.value / from.value).ln() / STEP;
                let of_answers = (from.error / from.value + to.error / to.value) / STEP;
                let derivatives = found.map(|(_, known)| {
                    let one = of(known.as_ref().expect("derivatives"), parameter);
                    let other = one
                        .derivatives
                        .of("indentation_depth")
                        .or(one.derivatives.of("normal_force"));
                    [one.derivatives.of("friction_coefficient"), other][index]
                        .expect("a derivative")
                });
                let mean = 0.5 * (derivatives[0].value + derivatives[1].value);
                let bars = 0.5 * (derivatives[0].error + derivatives[1].error);
                let off = (mean - slope).abs();
                assert!(
                    off <= bars + of_answers + 1e-3 && bars < 0.06,
                    "{parameter}, {load}, {index}: {mean} ± {bars} instead of {slope} ± {of_answers}"
                );
            }
        }
    }
}

/// Two grids agree by chance, while it is not known how much the contact grows.
#[test]
fn the_bar_of_a_friction_holds_what_is_not_known_of_the_size_of_its_contact() {
    let text = "indenter.superposition.terms = [{ coefficient = 10.865801765311621, exponent = 1.5744304099241888 }, \
                { coefficient = 325316.8221865663, exponent = 3.4843142768959803 }]\n\
                material.viscous = { viscosity = 349.9653932122356, poisson_ratio = 0.2572669934172961 }\n\
                load = { normal_force = 0.012358296887792422, velocity = 0.03977760884442775 }\n\
                solve = { method = \"bem-steady\", model = \"half-space\", relative_error = 1e-3 }";
    let (_, known) = answered(text);
    let known = known.expect("derivatives");
    let by_velocity = of(&known, "load.velocity")
        .derivatives
        .of("friction_coefficient");
    let by_velocity = by_velocity.expect("a derivative");
    // By `xtask evidence derivatives`, from answers to 3e-5.
    let (expected, error) = (-0.460_73, 2.6e-4);
    let off = (by_velocity.value - expected).abs();
    let is_sharp = by_velocity.error < 1e-2;
    assert!(
        off <= by_velocity.error + error && is_sharp,
        "{by_velocity:?} instead of {expected}"
    );
}

/// The friction of a cone on a springpot is the same under every force; the series that stands for it has ripples.
#[test]
fn the_error_of_a_series_is_in_the_bars_of_derivatives() {
    let text = "indenter.cone.slope = 0.03\nload = { normal_force = 54.3, velocity = 2.7 }\nsolve.relative_error = 2e-2\n\
                material.springpot = { coefficient = 3.5e4, exponent = 0.336, time_range = [6.6e-5, 66.0] }";
    let (_, known) = answered(text);
    let known = known.expect("derivatives");
    let by_force = of(&known, "load.normal_force")
        .derivatives
        .of("friction_coefficient");
    let by_force = by_force.expect("a derivative");
    let is_small = by_force.error < 1e-5;
    assert!(
        by_force.value.abs() <= by_force.error && is_small,
        "{by_force:?}"
    );
}

/// The least exponent of a springpot has the derivative of one beside it.
#[test]
fn a_number_that_is_the_least_allowed_one_has_a_derivative() {
    let at = |exponent: f64| {
        let text = format!(
            "indenter.cone.slope = 0.03\nload = {{ normal_force = 54.3, velocity = 2.7 }}\nsolve.relative_error = 2e-2\n\
             material.springpot = {{ coefficient = 3.5e4, exponent = {exponent:?}, time_range = [6.6e-5, 66.0] }}"
        );
        let (_, known) = answered(&text);
        let known = known.expect("derivatives");
        let known = of(&known, "material.springpot.exponent")
            .derivatives
            .of("friction_coefficient");
        known.expect("a derivative")
    };
    let [least, beside] = [0.01, 0.0101].map(at);
    let off = (least.value - beside.value).abs();
    let is_near = off < least.error + beside.error && off < 0.05 * beside.value.abs();
    assert!(is_near, "{least:?}, {beside:?}");
}

#[test]
fn answers_without_derivatives_say_where_there_are_some() {
    let text = "indenter.sphere.radius = 5e-3\nmaterial.viscous.viscosity = 1e4\n\
                load = { normal_force = 2.0, velocity = 0.05 }\nsolve = { sliding_distance = 0.05, elements = 8 }";
    let (_, known) = answered(text);
    let error = known.expect_err("a march has none").to_string();
    assert!(error.contains("bem-steady"), "{error}");
}

/// On a layer: what a modulus, its time and the unit of stress change is what they change of G' and G'' at each frequency.
#[test]
fn derivatives_by_frequencies_are_those_by_the_numbers_of_the_material() {
    let text = "indenter.sphere.radius = 5e-3\nlayer.thickness = 2e-3\nload = { normal_force = 2.0, velocity = 0.05 }\n\
                material.prony = { equilibrium_modulus = 1e6, valid_frequencies = [50.0, 2e3], branches = [\
                { modulus = 1e7, relaxation_time = 1e-3 }, { modulus = 1e6, relaxation_time = 0.1 }] }";
    let scene: Scene = text.parse().expect("a scene");
    let problem = Problem::try_from(&scene).expect("a problem");
    let (answer, known) = answered(text);
    let known = known.expect("derivatives");
    let told = Told::default();
    let spectral = spectral_sensitivity(&problem, &answer, &told).expect("derivatives");
    told.assert_done();
    let ends = spectral.bands.iter().flat_map(|band| band.frequencies);
    let ends: Vec<f64> = ends.collect();
    assert!(ends[0] == 0.0 && ends.contains(&50.0) && ends.contains(&2e3));
    let outside = spectral.outside_valid_frequencies.expect("a window");
    assert!((0.05..0.6).contains(&outside), "{outside}");
    // G' and G'' of a branch over those of all, at one frequency.
    let share = |branch: [f64; 2], frequency: f64| {
        let part = |[modulus, time]: [f64; 2]| {
            let x = frequency * time;
            [x, 1.0].map(|factor| modulus * x * factor / (1.0 + x * x))
        };
        let [soft, stiff] = [part([1e6, 0.1]), part([1e7, 1e-3])];
        let own = part(branch);
        [
            own[0] / (1e6 + soft[0] + stiff[0]),
            own[1] / (soft[1] + stiff[1]),
        ]
    };
    for (index, branch) in [[1e7, 1e-3], [1e6, 0.1]].into_iter().enumerate() {
        let (mut sum, mut error) = (0.0, 0.0);
        for band in &spectral.bands {
            let [from, to] = band.frequencies;
            let shares = share(branch, (from.max(1e-3 * to) * to).sqrt());
            for (share, by) in shares
                .iter()
                .zip([&band.storage_modulus, &band.loss_modulus])
            {
                let by = by
                    .derivatives
                    .of("friction_coefficient")
                    .expect("a derivative");
                sum += share * by.value;
                error += share * by.error;
            }
        }
        let name = format!("material.prony.branches[{index}].modulus");
        let expected = of(&known, &name).derivatives.of("friction_coefficient");
        let expected = expected.expect("a derivative");
        let allowed = error + expected.error;
        assert!(
            (sum - expected.value).abs() < allowed && allowed < 0.06,
            "{name}: {sum} instead of {expected:?}, {allowed}"
        );
    }
}

/// d³ ∝ F²/G² (Hertz 1881), with two moduli in parallel of which only the sum is known, and with the error bar in its place.
#[test]
fn a_budget_adds_up_its_sources() {
    let scene = |covariance: &str, uncertainty: &str| {
        let text = format!(
            "indenter.paraboloid.curvature = 5.0\nload = {{ normal_force = 2.0, velocity = 0.0 }}\nsolve.duration = 1e-9\n\
             material.prony = {{ equilibrium_modulus = 1e6, branches = [{{ modulus = 3e6, relaxation_time = 1e3 }}], \
             covariance.relative = {covariance} }}\n{uncertainty}"
        );
        let scene: Scene = text.parse().expect("a scene");
        let problem = Problem::try_from(&scene).expect("a problem");
        let files = (Path::new(""), no_file as _);
        let answer = solve(&problem).expect("an answer");
        with_sensitivity(&scene, files, &problem, answer, &SilentProgress).expect("derivatives")
    };
    // 1e6 ± 30 % and 3e6 ∓ 10 % have the sum 4e6, and as independent ones 4e6 ± 0.424e6.
    let uncertainty = "uncertainty.\"load.normal_force\" = 0.02";
    for (covariance, material) in [
        ("[[0.09, -0.03], [-0.03, 0.01]]", 0.0),
        ("[[0.09, 0.0], [0.0, 0.01]]", 0.3 * 2.0_f64.sqrt() / 4.0),
    ] {
        let answer = scene(covariance, uncertainty);
        let depth = answer.indentation_depth.expect("a depth");
        let of = |source: &Source| {
            let entry = answer.budget.entries.iter().find(|(one, _)| one == source);
            let known = entry.and_then(|(_, known)| known.of("indentation_depth"));
            known.unwrap_or_else(|| panic!("{source:?} in {:?}", answer.budget))
        };
        let number = of(&Source::Number("load.normal_force".to_owned()));
        let parts = [of(&Source::Numerics), of(&Source::Material), number];
        let expected = [
            depth.error / 3.0_f64.sqrt(),
            2.0 / 3.0 * material * depth.value,
            2.0 / 3.0 * 0.02 * depth.value,
        ];
        for (part, expected) in parts.into_iter().zip(expected) {
            let off = (part - expected).abs() / depth.value;
            assert!(off < 1e-5, "{part} and not {expected}");
        }
        let total = answer
            .budget
            .total()
            .of("indentation_depth")
            .expect("a total");
        let squares: f64 = parts.iter().map(|part| part * part).sum();
        assert!((total / squares.sqrt() - 1.0).abs() < 1e-12, "{total}");
        let json = serde_json::to_value(&answer).expect("JSON");
        let of_material = &json["indentation_depth_material_error"];
        assert_eq!(of_material.as_f64(), Some(parts[1]), "{json}");
        assert_eq!(json["budget"][3]["source"], "total", "{json}");
    }
}

#[test]
fn uncertainties_of_what_is_no_number_are_refused() {
    let prony =
        "prony = { equilibrium_modulus = 1e6, branches = [], covariance.relative = [[0.01]] }";
    let elastic = "elastic.shear_modulus = 1e6";
    for (material, uncertainty, needed) in [
        (
            elastic,
            "\"load.normal_force\" = -0.01",
            "uncertainty.\"load.normal_force\" must be from 0 to 1, a part of the number, as 0.05 is 5 %, but is -0.01",
        ),
        (
            elastic,
            "\"load.normal_force\" = nan",
            "uncertainty.\"load.normal_force\" must be",
        ),
        (
            elastic,
            "\"load.force\" = 0.01",
            "uncertainty.\"load.force\": this is no number of the scene that may be uncertain; these are: \"indenter.",
        ),
        (
            elastic,
            "\"material.file.temperature\" = 0.5",
            "only of a material of a file",
        ),
        (
            elastic,
            "load.normal_force = 0.5",
            "uncertainty.load.normal_force: the path of an uncertain number is in quotes: \"load.normal_force\" = 0.5",
        ),
        (elastic, "\"load.normal_force\" = 1000", "but is 1000"),
        (
            prony,
            "\"material.prony.equilibrium_modulus\" = 0.1",
            "the covariance of the material says",
        ),
    ] {
        let text = format!(
            "indenter.paraboloid.curvature = 5.0\nmaterial.{material}\nload = {{ normal_force = 2.0, velocity = 0.0 }}\n\
             solve.duration = 1.0\nuncertainty.{uncertainty}"
        );
        let scene = text.parse::<Scene>().map_err(|error| error.to_string());
        let refused = scene.and_then(|scene| {
            let problem = Problem::try_from(&scene);
            problem.map(drop).map_err(|error| error.to_string())
        });
        let refused = refused.expect_err(needed);
        assert!(refused.contains(needed), "{needed}: {refused}");
    }
}

/// In other units of stress friction and area of a rough surface are the same.
#[test]
fn derivatives_of_a_rough_surface_add_up_and_those_of_many_are_refused() {
    let scene = |realisations: &str| {
        format!(
            "indenter.self-affine = {{ period = [2.0, 1.0], hurst_exponent = 0.8, rms_slope = 0.1, longest_wavelength = 1.0, \
             shortest_wavelength = 0.25, seed = 3{realisations} }}\n\
             material.standard-solid = {{ equilibrium_modulus = 1e6, maxwell_modulus = 9e6, viscosity = 9e4 }}\n\
             load = {{ mean_pressure = 2e4, velocity = 10.0 }}\nsolve.relative_error = 0.1"
        )
    };
    let (_, known) = answered(&scene(""));
    let known = known.expect("derivatives");
    let stresses = ["equilibrium_modulus", "maxwell_modulus", "viscosity"];
    let stresses = stresses.map(|name| format!("material.standard-solid.{name}"));
    let all = || {
        stresses
            .iter()
            .map(|name| &name[..])
            .chain(["load.mean_pressure"])
    };
    let frictions = || all().map(|name| of(&known, name).derivatives.of("friction_coefficient"));
    let areas = || all().map(|name| of(&known, name).derivatives.of("contact_area"));
    for known in [frictions().collect::<Option<Vec<_>>>(), areas().collect()] {
        let known = known.expect("derivatives");
        let sum: f64 = known.iter().map(|one| one.value).sum();
        let size: f64 = known.iter().map(|one| one.value.abs()).sum();
        assert!(sum.abs() < 2e-5 * size, "{known:?}");
    }
    let (_, refused) = answered(&scene(", realisations = 2"));
    let refused = refused.expect_err("a mean").to_string();
    assert!(refused.contains("realisations"), "{refused}");
}

/// A hot ball on an elastic half space: the shear strength τ_f(T) at T = T_0 + C τ_f(T), so that friction and rise have the derivatives 1/(1 − s)
/// by the strength and −s/(1 − s), −1/(1 − s) by the conductivity, with s = (T − T_0) d ln τ_f/dT.
#[test]
fn derivatives_follow_the_temperature_that_friction_causes() {
    let text = "uncertainty.\"heat.ambient_temperature\" = 2.0\n\
                indenter.sphere.radius = 5e-3\nmaterial.elastic.shear_modulus = 1e6\n\
                interface.bell = { shear_strength = 1e6, velocity = 1.0, activation_energy = 8e4 }\n\
                heat = { conductivity = 0.25, diffusivity = 1e-7, ambient_temperature = 20.0 }\n\
                load = { normal_force = 5.0, velocity = 0.1 }\nsolve.relative_error = 0.02";
    let scene: Scene = text.parse().expect("a scene");
    let problem = Problem::try_from(&scene).expect("a problem");
    let answer = solve(&problem).expect("an answer");
    let files = (Path::new(""), no_file as _);
    let answer = with_sensitivity(&scene, files, &problem, answer, &SilentProgress);
    let answer = answer.expect("derivatives");
    let known = &answer.sensitivity;
    let temperature = answer.effective_temperature.expect("a temperature").value;
    // log₁₀ a_T = E/(R ln 10) (1/T − 1/T_r), and ln τ_f = −(log₁₀(v a_T/v_0)/w)² + constant with w = √10.
    let kelvin = temperature + 273.15;
    let per_reciprocal = 8e4 / (8.314_462_618 * 10.0_f64.ln());
    let log_speed = 0.1_f64.log10() + per_reciprocal * (kelvin.recip() - 293.15_f64.recip());
    let slope = 2.0 * log_speed / 10.0 * per_reciprocal / kelvin.powi(2);
    let share = (temperature - 20.0) * slope;
    assert!(share < -0.15, "the temperature matters: {share}");
    for (parameter, quantity, expected) in [
        (
            "interface.bell.shear_strength",
            "friction_coefficient",
            1.0 / (1.0 - share),
        ),
        (
            "interface.bell.shear_strength",
            "mean_temperature_rise",
            1.0 / (1.0 - share),
        ),
        (
            "heat.conductivity",
            "friction_coefficient",
            -share / (1.0 - share),
        ),
        (
            "heat.conductivity",
            "mean_temperature_rise",
            -1.0 / (1.0 - share),
        ),
        ("heat.conductivity", "contact_area", 0.0),
    ] {
        let by_number = of(known, parameter).derivatives.of(quantity);
        let by_number = by_number.unwrap_or_else(|| panic!("{parameter}, {quantity}"));
        let off = (by_number.value - expected).abs();
        // The temperature itself has an error, and so has the expected derivative.
        let allowed = by_number.error + 0.01 * expected.abs();
        assert!(
            off <= allowed,
            "{parameter}, {quantity}: {by_number:?} for {expected}"
        );
        assert!(
            by_number.error < 0.05,
            "{parameter}, {quantity}: {by_number:?}"
        );
    }
    // The surroundings are uncertain by 2 K, which heat or cool the contact by 2 K/(1 − s).
    let friction = answer.friction_coefficient.expect("a friction").value;
    let expected = friction * 2.0 * slope.abs() / (1.0 - share);
    let ambient = Source::Number("heat.ambient_temperature".to_owned());
    let mut entries = answer.budget.entries.iter();
    let (_, found) = entries
        .find(|(source, _)| *source == ambient)
        .expect("an entry");
    let found = found.of("friction_coefficient").expect("an uncertainty");
    assert!(
        (found / expected - 1.0).abs() < 0.05,
        "{found} for {expected}"
    );
}

/// Derivatives with strain dependence are the slopes between answers on given elements, and add up in units of stress and time.
#[test]
fn derivatives_follow_the_strain_that_the_contact_causes() {
    let scene = |force: f64| {
        format!(
            "indenter.cylinder.radius = 5e-3\n\
             material.standard-solid = {{ equilibrium_modulus = 1e6, maxwell_modulus = 1e7, viscosity = 1e4 }}\n\
             strain.kraus = {{ critical_strain = 0.02, storage_ratio = 0.2, loss_peak_ratio = 1.3 }}\n\
             load = {{ normal_force = {force}, velocity = 0.1 }}\nsolve.elements = 96"
        )
    };
    let (_, known) = answered(&scene(400.0));
    let known = known.expect("derivatives");
    let friction = |parameter: &str| {
        let derivatives = &of(&known, parameter).derivatives;
        derivatives
            .of("friction_coefficient")
            .expect("a derivative")
    };
    let [lower, upper] = [380.0, 420.0].map(|force| solved(&scene(force)));
    for quantity in ["friction_coefficient", "contact_area", "strain"] {
        let log = |answer: &Answer| {
            let known = Quantity::named(quantity).and_then(|of| (of.of)(answer));
            known.expect("a quantity").value.ln()
        };
        let expected = (log(&upper) - log(&lower)) / (420.0_f64 / 380.0).ln();
        let by_load = of(&known, "load.normal_force").derivatives.of(quantity);
        let by_load = by_load.expect("a derivative");
        // The fixed point of an answer is found to a part of its error.
        let allowed = by_load.error + 0.01;
        assert!(
            (by_load.value - expected).abs() <= allowed,
            "{quantity}: {by_load:?} for {expected}"
        );
    }
    let moduli = ["equilibrium_modulus", "maxwell_modulus", "viscosity"]
        .map(|key| friction(&format!("material.standard-solid.{key}")));
    let of_stress = moduli
        .into_iter()
        .fold(friction("load.normal_force"), |sum, one| sum + one);
    let of_time = friction("load.velocity") + moduli[2] * -1.0;
    for (unit, sum) in [("stress", of_stress), ("time", of_time)] {
        assert!(
            sum.value.abs() <= sum.error && sum.error < 0.05,
            "{unit}: {sum:?}"
        );
    }
}
