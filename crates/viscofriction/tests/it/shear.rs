//! Shear of the real contact: its part of the friction is τ_f A/F_N, with the error of the area.

use std::f64::consts::PI;
use std::path::Path;

use numerics::{Estimate, SilentProgress};
use serde_json::Value;
use viscofriction::solve::{Source, plan, sampled, with_sensitivity};
use viscofriction::{Answer, Problem, Scene, WrongInput, solve};

use crate::sensitivities::{answered, of};
use crate::support::{Folder, assert_close, number};

/// A ball on a rubber, slower and faster than its relaxation.
const BALL: &str = "[indenter.sphere]\nradius = 5e-3\n[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{ modulus = 1e7, \
     relaxation_time = 1e-3 }, { modulus = 3e6, relaxation_time = 0.1 }]\n[load]\nnormal_force = 1.0\nvelocity = 0.01\n";

/// Requires that the parts of the friction add up, and that shear is the strength times the area over the force.
#[track_caller]
fn check_parts(answer: &Value, strength: f64) {
    let [sum, hysteresis, shear] = ["coefficient", "from_hysteresis", "from_shear"]
        .map(|part| number(answer, &format!("friction_{part}")));
    assert_close("sum", sum, hysteresis + shear, 1e-14);
    let [force, area] = ["normal_force", "contact_area"].map(|key| number(answer, key));
    assert_close("shear", shear, strength * area / force, 1e-14);
    let [error, of_area] =
        ["friction_from_shear_error", "contact_area_error"].map(|key| number(answer, key));
    assert_close("its error", error, strength * of_area / force, 1e-12);
    let [total, of_hysteresis] = [
        "friction_coefficient_error",
        "friction_from_hysteresis_error",
    ]
    .map(|key| number(answer, key));
    assert_close("error of the sum", total, of_hysteresis + error, 1e-12);
}

/// An elastic body slides with the shear of the contact of Hertz, a³ = 3 F R/(4 E*), E* = 4 G.
#[test]
fn an_elastic_ball_has_the_shear_of_hertz() {
    let folder = Folder::new("shear-hertz");
    let answer = folder.answer(
        "[indenter.paraboloid]\ncurvature = 100.0\n[material.elastic]\nshear_modulus = 1e6\n[interface.constant]\nshear_strength = \
         1e5\n[load]\nnormal_force = 1.0\nvelocity = 0.01\n",
    );
    let radius = (3.0 * 5e-3 / (4.0 * 4e6_f64)).cbrt();
    assert_close(
        "friction",
        number(&answer, "friction_coefficient"),
        1e5 * PI * radius * radius,
        1e-10,
    );
    let hysteresis = number(&answer, "friction_from_hysteresis");
    assert!(hysteresis.abs() < f64::MIN_POSITIVE, "{hysteresis}");
    check_parts(&answer, 1e5);
}

/// The sum has the requested error, whichever part prevails; hysteresis is that without an interface.
#[test]
fn the_sum_has_the_requested_error() {
    let folder = Folder::new("shear-sum");
    let asked = "[solve]\nrelative_error = 5e-3\n";
    let alone = folder.answer(format!("{BALL}{asked}"));
    assert!(alone.get("friction_from_shear").is_none(), "{alone}");
    for strength in [1e3, 1e5, 1e7] {
        let text = format!("{BALL}{asked}[interface.constant]\nshear_strength = {strength:e}\n");
        let answer = folder.answer(text);
        check_parts(&answer, strength);
        let [sum, error] =
            ["friction_coefficient", "friction_coefficient_error"].map(|key| number(&answer, key));
        assert!(error <= 5e-3 * sum, "{strength:e}: {sum} ± {error}");
        let [same, bar] =
            ["", "_error"].map(|end| number(&answer, &format!("friction_from_hysteresis{end}")));
        let [hysteresis, own] =
            ["friction_coefficient", "friction_coefficient_error"].map(|key| number(&alone, key));
        assert!(
            (same - hysteresis).abs() <= bar + own,
            "{same} for {hysteresis}"
        );
        let words = answer["not_modelled"].to_string();
        assert!(
            !words.contains("shear") && words.contains("adhesion"),
            "{words}"
        );
    }
}

/// Coarse grids of a rough surface suffice for a friction that is mostly shear, within their bars; hysteresis has its own grids.
#[test]
fn mostly_shear_needs_fewer_elements() {
    let folder = Folder::new("shear-coarse");
    let scene = |strength: Option<f64>, solve: &str| {
        let interface = strength.map_or(String::new(), |strength| {
            format!("[interface.constant]\nshear_strength = {strength}\n")
        });
        folder.answer(format!(
            "[indenter.self-affine]\nperiod = [1e-2, 1e-2]\nhurst_exponent = 0.8\nrms_slope = 0.2\nlongest_wavelength = 5e-3\n\
             shortest_wavelength = 6.25e-4\nseed = 7\n[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{{ modulus = 1e7, \
             relaxation_time = 1e-3 }}]\n[load]\nmean_pressure = 2e5\nvelocity = 0.1\n[solve]\n{solve}\n{interface}"
        ))
    };
    let of = |answer: &Value, key: &str| number(answer, key);
    let [coarse, fine] =
        ["relative_error = 0.05", "elements = 512"].map(|solve| scene(Some(1e6), solve));
    let off = of(&coarse, "friction_coefficient") - of(&fine, "friction_coefficient");
    let bars = of(&coarse, "friction_coefficient_error") + of(&fine, "friction_coefficient_error");
    assert!(off.abs() <= bars, "{off}, and bars {bars}");
    let [alone, beside] =
        [None, Some(1e3)].map(|strength| scene(strength, "relative_error = 0.05"));
    let elements = |answer: &Value| of(answer, "unknowns") / of(answer, "area_fraction");
    assert!(
        elements(&coarse) < 0.3 * elements(&alone),
        "{} and {} elements",
        elements(&coarse),
        elements(&alone)
    );
    assert_eq!(beside["unknowns"], alone["unknowns"], "little shear");
}

/// The derivatives of the sum are those of its parts, by the shear strength as by numbers that both parts depend on.
#[test]
fn derivatives_of_the_sum_are_slopes_between_answers() {
    let folder = Folder::new("shear-derivatives");
    let scene = |strength: f64, velocity: f64, force: f64| {
        let ball = BALL.replace("velocity = 0.01", &format!("velocity = {velocity:e}"));
        let ball = ball.replace("normal_force = 1.0", &format!("normal_force = {force:e}"));
        format!(
            "{ball}[solve]\nrelative_error = 5e-3\n[interface.bell]\nshear_strength = {strength:e}\nvelocity = 1e-4\nwidth = 2.0\n"
        )
    };
    let (answer, known) = answered(&scene(1e5, 0.01, 1.0));
    let known = known.expect("derivatives");
    let [friction, shear] = [answer.friction_coefficient, answer.friction_from_shear]
        .map(|part| part.expect("a part of the friction").value);
    let derivative = |path: &str| {
        let found = of(&known, path).derivatives.of("friction_coefficient");
        let found = found.expect("a derivative");
        [found.value, found.error]
    };
    let [by_strength, error] = derivative("interface.bell.shear_strength");
    let part = shear / friction;
    assert!(
        (by_strength - part).abs() < error + 1e-12,
        "{by_strength} ± {error}"
    );
    // ln τ changes by −2 log₁₀(v/v_0)/(w² ln 10) with ln v, and with ln v_0 by the opposite.
    let [by_peak, error] = derivative("interface.bell.velocity");
    let slope = 2.0 * 2.0 / (4.0 * 10.0_f64.ln());
    assert!(
        (by_peak - slope * part).abs() < error + 1e-6,
        "{by_peak} ± {error}"
    );
    for (path, [velocity, force]) in [
        ("load.velocity", [1.05, 1.0]),
        ("load.normal_force", [1.0, 1.05]),
    ] {
        let at = |side: f64| {
            let text = scene(
                1e5,
                0.01 * f64::powf(velocity, side),
                f64::powf(force, side),
            );
            let answer = folder.answer(text);
            ["friction_coefficient", "friction_coefficient_error"].map(|key| number(&answer, key))
        };
        let ([low, low_error], [high, high_error]) = (at(-1.0), at(1.0));
        let width = 2.0 * 1.05_f64.ln();
        let slope = (high / low).ln() / width;
        let bar = (high_error / high + low_error / low) / width;
        let [found, error] = derivative(path);
        assert!(
            (found - slope).abs() < error + bar,
            "{path}: {found} ± {error} for {slope} ± {bar}"
        );
    }
}

/// A table of shear strengths, known to 10 and to 20 %.
#[expect(
    clippy::unnecessary_wraps,
    reason = "the signature of functions that read files"
)]
fn uncertain_table(_: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    let rows = "velocity_m_per_s,shear_strength_pa,shear_strength_error_pa\n1e-3,1e5,1e4\n1e-1,4e5,8e4\n1.0,1e5,1e5\n";
    Ok(rows.as_bytes().to_vec())
}

/// At 10 mm/s ln τ_f is the mean of two rows of the table: its uncertainty is √(0.1² + 0.2²)/2 = 0.112.
#[test]
fn errors_of_a_table_enter_the_budget() {
    let asked = "[solve]\nrelative_error = 0.01\n[interface.table]\nfile = \"table.csv\"\n";
    let scene: Scene = format!("{BALL}{asked}").parse().expect("a scene");
    let files = (Path::new(""), uncertain_table as _);
    let problem = Problem::new(&scene, files.0, files.1).expect("a problem");
    let answer = solve(&problem).expect("an answer");
    let answer = with_sensitivity(&scene, files, &problem, answer, &SilentProgress);
    let answer = answer.expect("derivatives");
    let (source, known) = &answer.budget.entries[1];
    assert_eq!(*source, Source::ShearTable, "beside the numerics");
    let shear = answer.friction_from_shear.expect("shear").value;
    let expected = 0.5 * 0.1_f64.hypot(0.2) * shear;
    for (key, expected) in [
        ("friction_coefficient", expected),
        ("friction_from_shear", expected),
        ("friction_from_hysteresis", 0.0),
    ] {
        let found = known.of(key).expect("an uncertainty");
        let off = (found - expected).abs();
        assert!(off <= 1e-12 * shear, "{key}: {found} and not {expected}");
    }
    let refused = sampled(&scene, files, 1).expect_err("errors of rows");
    let expected = "interface.table.file: samples do not draw";
    assert!(refused.to_string().contains(expected), "{refused}");
}

/// A reciprocating elastic ball has the contact of Hertz all the time: F_t = ±τ A, and a cycle dissipates τ A times its length.
#[test]
fn an_elastic_ball_rubs_with_the_area_of_hertz_to_and_fro() {
    let folder = Folder::new("shear-strokes");
    let radius = (3.0 * 5e-3 / (4.0 * 4e6_f64)).cbrt();
    let force = 1e5 * PI * radius * radius;
    let cases = [
        ("triangular", "elements = 16"),
        ("sinusoidal", "elements = 16"),
        ("triangular", "relative_error = 4e-3"),
    ];
    for (shape, accuracy) in cases {
        let text = format!(
            "[indenter.paraboloid]\ncurvature = 100.0\n[material.elastic]\nshear_modulus = 1e6\n[interface.constant]\nshear_strength \
             = 1e5\n[load]\nnormal_force = 1.0\nstroke = 5e-4\nfrequency = 2.0\nshape = \"{shape}\"\n[solve]\n{accuracy}\n"
        );
        folder.write("stroke.toml", text);
        let answer = folder.solved("stroke.toml").answer;
        let check = |what: &str, found: Option<Estimate>, expected: f64| {
            let found = found.expect("an estimate");
            let holds = (found.value - expected).abs() <= found.error + 1e-9 * expected;
            assert!(
                holds && found.error < 0.03 * expected,
                "{shape}, {accuracy}, {what}: {found} for {expected}"
            );
        };
        check("friction", answer.friction_coefficient, force);
        check("shear", answer.friction_from_shear, force);
        check("peak", answer.peak_friction, force);
        check("energy", answer.dissipated_energy, 2.0 * 5e-4 * force);
        check("area", answer.contact_area, PI * radius * radius);
        let [found, places] = ["tangential_force", "position"]
            .map(|name| &answer.fields.curve.column(name).expect("a column").values);
        for (index, pair) in places.windows(2).enumerate() {
            // A sinusoidal motion is at rest where it turns.
            let turns = shape == "sinusoidal" && places[index + 1].value.abs() > 2.499_999e-4;
            let sign = if turns {
                0.0
            } else {
                (pair[1].value - pair[0].value).signum()
            };
            let off = (found[index + 1].value - sign * force).abs();
            assert!(
                off <= found[index + 1].error + 1e-9 * force,
                "{shape}: {} for {sign} {force}",
                found[index + 1]
            );
        }
    }
}

/// Along a path the shear has the sign of the velocity and its strength at that speed, and a dwell has none.
#[test]
fn shear_along_a_path_follows_the_velocity() {
    let folder = Folder::new("shear-path");
    let path = BALL.replace(
        "velocity = 0.01",
        "motion = [{ time = 1.0, position = 0.0 }, { time = 1.1, position = 4e-4 }, { time = 1.2, position = 4e-4 }, { time = 1.25, \
         position = 0.0 }]",
    );
    let asked = format!("{path}[solve]\nelements = 12\n");
    let bell = "[interface.bell]\nshear_strength = 1e5\nvelocity = 4e-3\nwidth = 0.5\n";
    folder.write("alone.toml", &asked);
    folder.write("sum.toml", format!("{asked}{bell}"));
    let [alone, sum] = ["alone.toml", "sum.toml"].map(|file| folder.solved(file).answer);
    let column = |answer: &Answer, name: &str| {
        answer
            .fields
            .curve
            .column(name)
            .expect("a column")
            .values
            .clone()
    };
    let [without, with] = [&alone, &sum].map(|answer| column(answer, "tangential_force"));
    let areas = column(&sum, "contact_area");
    // The bell has its maximum at 4 mm/s; at twice the speed it is exp(−(log₁₀ 2/w)²) of it.
    let back = -1e5 * (-(2.0_f64.log10() / 0.5).powi(2)).exp();
    for (index, time) in sum.fields.curve.times.iter().enumerate().skip(1) {
        let strength = match time {
            time if *time < 1.1 + 1e-9 => 1e5,
            time if *time < 1.2 + 1e-9 => 0.0,
            _ => back,
        };
        let shear = with[index].value - without[index].value;
        assert_close(
            "shear",
            1.0 + shear,
            1.0 + strength * areas[index].value,
            1e-12,
        );
        let error = with[index].error - without[index].error;
        assert_close(
            "error",
            1.0 + error,
            1.0 + strength.abs() * areas[index].error,
            1e-12,
        );
    }
    let [hysteresis, same] = [sum.friction_from_hysteresis, alone.friction_coefficient];
    assert_eq!(hysteresis, same, "hysteresis");
    assert!(
        sum.peak_friction.expect("a peak").value
            > alone.peak_friction.expect("a peak").value + 0.02,
        "{sum:?}"
    );
}

/// After a distance from first touch the steps before the end have shear too.
#[test]
fn steps_from_first_touch_have_shear() {
    let folder = Folder::new("shear-steps");
    let scene = format!("{BALL}[solve]\nsliding_distance = 5e-4\nrelative_error = 0.05\n");
    let interface = "[interface.constant]\nshear_strength = 1e5\n";
    folder.write("alone.toml", &scene);
    folder.write("sum.toml", format!("{scene}{interface}"));
    let [alone, sum] = ["alone.toml", "sum.toml"].map(|file| folder.solved(file).answer);
    check_parts(&serde_json::to_value(&sum).expect("JSON"), 1e5);
    let friction = sum.friction_coefficient.expect("friction");
    let last = sum
        .fields
        .history
        .last()
        .expect("a step")
        .friction_coefficient;
    let off = (last - friction.value).abs();
    assert!(off < friction.error, "{last} for {friction}");
    let first = |answer: &Answer| answer.fields.history[0].friction_coefficient;
    assert!(
        first(&sum) > first(&alone) + 0.05,
        "{} {}",
        first(&sum),
        first(&alone)
    );
}

/// The planned method answers, also where another would meet a coarser request for the hysteresis beside a large shear.
#[test]
fn the_planned_method_answers() {
    for velocity in ["1e-4", "3e-4", "1e-3", "3e-3"] {
        let ball = BALL.replace("velocity = 0.01", &format!("velocity = {velocity}"));
        let asked = "[solve]\nrelative_error = 0.01\n[interface.constant]\nshear_strength = 1e7\n";
        let scene: Scene = format!("{ball}{asked}").parse().expect("a scene");
        let problem = Problem::try_from(&scene).expect("a problem");
        let planned = plan(&problem).expect("a plan").method();
        let answer = solve(&problem).expect("an answer");
        assert_eq!(answer.method, planned, "at {velocity} m/s");
    }
}

/// Cylinders, height maps and periodic surfaces have the shear of their areas; realisations that of each surface.
#[test]
fn every_kind_of_body_has_shear() {
    let folder = Folder::new("shear-bodies");
    folder.write("map.csv", "4,1,4,9\n1,0,1,4\n4,1,4,9\n9,4,9,16\n");
    let rubber = "[material.standard-solid]\nequilibrium_modulus = 1e6\nmaxwell_modulus = 4e6\nviscosity = 4e4\n";
    let rough = "[indenter.self-affine]\nperiod = [1e-3, 1e-3]\nhurst_exponent = 0.8\nrms_slope = 0.1\nlongest_wavelength = \
         1e-3\nshortest_wavelength = 2.5e-4\nseed = 1\n";
    let two = rough.replace("seed = 1", "seed = 1\nrealisations = 2");
    // On a dashpot the closed form of the friction knows no area, and another method is chosen.
    let dashpot = "[material.viscous]\nviscosity = 1e4\n";
    for (body, load) in [
        (
            "[indenter.cylinder]\nradius = 5e-3\n",
            "normal_force = 100.0",
        ),
        (
            "[indenter.height-map]\nfile = \"map.csv\"\nspacing = [1e-3, 1e-3]\nunit = \"um\"\nheights_are = \"gap\"\n",
            "normal_force = 2e-3",
        ),
        ("[indenter.cone]\nslope = 0.1\n", "normal_force = 1.0"),
        (rough, "mean_pressure = 1e5"),
        (&two, "mean_pressure = 1e5"),
    ] {
        let material = if body.contains("cone") {
            dashpot
        } else {
            rubber
        };
        let text = format!(
            "{body}{material}[interface.constant]\nshear_strength = 2e4\n[load]\n{load}\nvelocity = 0.02\n[solve]\nrelative_error = 0.05\n"
        );
        let answer = folder.answer(text);
        check_parts(&answer, 2e4);
        if let Some(fraction) = answer.get("area_fraction") {
            let shear = 2e4 * fraction.as_f64().expect("a number") / 1e5;
            assert_close(
                "of the fraction",
                number(&answer, "friction_from_shear"),
                shear,
                1e-12,
            );
        }
    }
}

/// What has no shear, or a law that says nothing about the scene, is refused with its key.
#[test]
fn scenes_without_shear_are_refused() {
    let folder = Folder::new("shear-refused");
    folder.write(
        "table.csv",
        "velocity_m_per_s,shear_strength_pa\n1e-3,1e5\n5e-3,2e5\n",
    );
    folder.write(
        "short.csv",
        "velocity_m_per_s,shear_strength_pa\n1e-3,1e5\n",
    );
    folder.write(
        "negative.csv",
        "velocity_m_per_s,shear_strength_pa\n1e-3,1e5\n5e-3,-2e5\n",
    );
    folder.write(
        "uncertain.csv",
        "velocity_m_per_s,shear_strength_pa,shear_strength_error_pa\n1e-3,1e5,1e4\n5e-1,2e5,-1e4\n",
    );
    folder.write(
        "partly.csv",
        "velocity_m_per_s,shear_strength_pa,shear_strength_error_pa\n1e-3,1e5,1e4\n5e-1,2e5,\n",
    );
    let constant = "[interface.constant]\nshear_strength = 1e5\n";
    let pressed = BALL.replace("velocity = 0.01", "velocity = 0.0\n[solve]\nduration = 1.0");
    let stroke = BALL.replace("velocity = 0.01", "stroke = 1e-3\nfrequency = 1.0");
    let slow = stroke.replace("frequency = 1.0", "frequency = 0.1\nshape = \"triangular\"");
    for (text, needed) in [
        (
            format!("{BALL}{}", constant.replace("1e5", "-1e5")),
            "interface.constant.shear_strength must be finite and greater than 0",
        ),
        (
            format!("{BALL}[solve]\nmodel = \"line\"\n{constant}"),
            "one-dimensional",
        ),
        (format!("{pressed}{constant}"), "nothing slides"),
        (
            format!("{stroke}[solve]\nmodel = \"line\"\n{constant}"),
            "one-dimensional",
        ),
        (
            format!("{stroke}[interface.table]\nfile = \"table.csv\"\n"),
            "interface: a sinusoidal motion passes all speeds from 0 to 0.0031",
        ),
        (
            format!("{slow}[interface.table]\nfile = \"table.csv\"\n"),
            "velocity [m/s] must be from 0.001 to 0.005",
        ),
        (
            format!("{BALL}[interface.table]\nfile = \"table.csv\"\n"),
            "velocity [m/s] must be from 0.001 to 0.005",
        ),
        (
            format!("{BALL}[interface.table]\nfile = \"short.csv\"\n"),
            "short.csv:2: at least 2 points",
        ),
        (
            format!("{BALL}[interface.table]\nfile = \"negative.csv\"\n"),
            "negative.csv, line 3, column 2 (shear_strength_pa): expected a number greater than 0",
        ),
        (
            format!("{BALL}[interface.table]\nfile = \"uncertain.csv\"\n"),
            "uncertain.csv, line 3, column 3 (shear_strength_error_pa): expected a number of at least 0",
        ),
        (
            format!("{BALL}[interface.table]\nfile = \"partly.csv\"\n"),
            "partly.csv, line 3, column 3 (shear_strength_error_pa)",
        ),
        (
            format!("{BALL}[interface.table]\nfile = \"none.csv\"\n"),
            "none.csv",
        ),
        (
            format!(
                "{BALL}[interface.bell]\nshear_strength = 1e5\nvelocity = 1e-3\nactivation_energy = 1.0\nactivation_energy_unit = \"eV\"\n"
            ),
            "depends on the temperature",
        ),
        (
            format!("{BALL}[interface.bell]\nshear_strength = 1e5\nvelocity = 1e-3\nwidth = 0.0\n"),
            "interface.bell.width",
        ),
    ] {
        folder.write("scene.toml", text);
        folder.ends("scene.toml", 2, needed);
    }
}

/// The shear strength of a bell has the temperature of the material: 40 °C act like 1/a_T times the velocity.
#[test]
fn a_bell_has_the_temperature_of_the_material() {
    let folder = Folder::new("shear-temperature");
    folder.write(
        "material.toml",
        "[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{ modulus = 1e7, relaxation_time = 1e-3 }]\n[material.prony.shift]\n\
         temperature = 20.0\ntemperature_range = [0.0, 60.0]\nlaw = { arrhenius = 1.0e5 }\n",
    );
    let scene = |celsius: f64, velocity: f64| {
        format!(
            "[indenter.sphere]\nradius = 5e-3\n[material.file]\npath = \"material.toml\"\ntemperature = {celsius}\n[interface.bell]\n\
             shear_strength = 1e5\nvelocity = 1e-3\nwidth = 2.0\nactivation_energy = 1e5\n[load]\nnormal_force = 1.0\nvelocity = \
             {velocity:e}\n[solve]\nrelative_error = 0.01\n"
        )
    };
    // With the same activation energy, moduli and shear strength depend on a_T v alone.
    let shift = (1e5 / 8.314_462_618_153_24_f64 * (1.0 / 313.15 - 1.0 / 293.15)).exp();
    let warm = folder.answer(scene(40.0, 0.01));
    let cold = folder.answer(scene(20.0, 0.01 * shift));
    for key in [
        "friction_coefficient",
        "friction_from_shear",
        "contact_area",
    ] {
        assert_close(key, number(&warm, key), number(&cold, key), 1e-9);
    }
}

/// A layer and a compressible half space are answered with a warning about the coupling that is neglected.
#[test]
fn neglected_coupling_is_said() {
    let folder = Folder::new("shear-coupling");
    let interface = "[solve]\nrelative_error = 0.05\n[interface.constant]\nshear_strength = 1e5\n";
    let compressible = BALL.replace("[load]", "poisson_ratio = 0.3\n[load]");
    let layer = format!("{BALL}{interface}[layer]\nthickness = 1e-3\n");
    for (text, needed) in [
        (format!("{BALL}{interface}"), None),
        (
            format!("{compressible}{interface}"),
            Some("Poisson ratio of 0.3"),
        ),
        (layer, Some("on a layer")),
    ] {
        let warnings = folder.answer(text)["warnings"].to_string();
        let says = warnings.contains("shear of the contact");
        assert_eq!(says, needed.is_some(), "{warnings}");
        assert!(warnings.contains(needed.unwrap_or_default()), "{warnings}");
    }
}
