//! Heat of sliding: the temperature of the contact, and friction at this temperature.

use std::f64::consts::PI;

use serde_json::Value;
use viscofriction::{Problem, Scene};

use crate::support::{Folder, assert_close, number};

/// A ball on a rubber with a shift law, on the branch where friction falls with temperature.
const BALL: &str = "[indenter.sphere]\nradius = 5e-3\n[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{ modulus = 1e7, \
     relaxation_time = 1e-3 }, { modulus = 3e6, relaxation_time = 0.1 }]\nshift = { temperature = 20.0, temperature_range = [-20.0, 120.0], law = \
     { wlf = [8.86, 101.6] } }\n[load]\nnormal_force = 1.0\nvelocity = 0.1\n[solve]\nrelative_error = 0.05\n";
/// Shear that heats the ball by a few kelvin.
const SHEAR: &str = "[interface.constant]\nshear_strength = 5e5\n";
/// Heat of a rubber.
const HEAT: &str = "[heat]\nconductivity = 0.25\ndiffusivity = 1.2e-7\n";

/// A scene with other words in the place of some of its own.
fn with(text: &str, [from, to]: [&str; 2]) -> String {
    assert!(text.contains(from), "{from} is not in {text}");
    text.replace(from, to)
}

/// Value and error of a temperature rise.
fn rise(answer: &Value, name: &str) -> [f64; 2] {
    ["", "_error"].map(|end| number(&answer["temperature_rise"], &format!("{name}{end}")))
}

/// Requires that two values differ by no more than the sum of their errors.
#[track_caller]
fn assert_within_bars(name: &str, [one, other]: [&Value; 2]) {
    let error = format!("{name}_error");
    let [a, b] = [one, other].map(|answer| number(answer, name));
    let bars = [one, other].map(|answer| number(answer, &error));
    assert!(
        (a - b).abs() <= bars[0] + bars[1],
        "{name}: {a} and {b}, bars {bars:?}"
    );
}

/// An elastic paraboloid is heated by its shear alone, uniformly on the disc of Hertz: 0.55542 and 0.73244 of q a/k at the Péclet number 1.
#[test]
fn the_shear_of_an_elastic_paraboloid_heats_a_disc() {
    let folder = Folder::new("heat-disc");
    let (radius, force, modulus) = (5e-3, 1.0, 1e6);
    let contact_radius = (3.0_f64 * force * radius / (16.0 * modulus)).cbrt();
    let velocity = 2.0 * 1.2e-7 / contact_radius;
    let answer = folder.answer(format!(
        "[indenter.paraboloid]\ncurvature = {}\n[material.elastic]\nshear_modulus = {modulus}\n[load]\nnormal_force = {force}\nvelocity = \
         {velocity}\n[solve]\nrelative_error = 5e-3\n{SHEAR}{HEAT}",
        0.5 / radius
    ));
    let scale = 5e5 * velocity * contact_radius / 0.25;
    for (name, expected) in [("mean", 0.55542), ("largest", 0.73244)] {
        let [value, error] = rise(&answer, name);
        let off = (value - expected * scale).abs();
        assert!(
            off <= error && error < 0.05 * value,
            "{name}: {value} ± {error}, not {}",
            expected * scale
        );
    }
    assert!(
        answer.get("effective_temperature").is_none(),
        "nothing depends on it: {answer}"
    );
    assert_eq!(answer["not_modelled"], serde_json::json!(["adhesion"]));
    let area = PI * contact_radius.powi(2);
    let off = (number(&answer, "contact_area") / area - 1.0).abs();
    assert!(off < 0.02, "the contact of Hertz: {off}");
}

/// The coarsest grid of a light rough contact has a few elements in contact, whose bars reach to 0; finer ones have the requested error.
#[test]
fn a_light_rough_contact_has_the_requested_error() {
    let folder = Folder::new("heat-light");
    let answer = folder.answer(format!(
        "[indenter.self-affine]\nperiod = [1e-2, 1e-2]\nhurst_exponent = 0.8\nrms_slope = 0.2\nlongest_wavelength = 5e-3\nshortest_wavelength \
         = 1.25e-3\nseed = 3\n[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{{ modulus = 1e7, relaxation_time = 1e-4 }}]\nshift = {{ \
         temperature = 20.0, temperature_range = [-20.0, 150.0], law = {{ wlf = [8.86, 101.6] }} }}\n{SHEAR}{HEAT}duration = \
         1.0\n[load]\nmean_pressure = 2e3\nvelocity = 0.1\n[solve]\nrelative_error = 0.1\n"
    ));
    let [friction, error] =
        ["friction_coefficient", "friction_coefficient_error"].map(|key| number(&answer, key));
    assert!(error <= 0.1 * friction, "{friction} ± {error}");
}

/// Without friction to heat it, or with a perfect conductor, a contact has its isothermal friction to the last bit.
#[test]
fn a_perfect_conductor_keeps_the_isothermal_answer() {
    let folder = Folder::new("heat-none");
    let isothermal = folder.answer(format!("{BALL}{SHEAR}"));
    let cold = with(HEAT, ["0.25", "1e30"]);
    let conducting = folder.answer(format!("{BALL}{SHEAR}{cold}"));
    for key in [
        "friction_coefficient",
        "friction_from_shear",
        "contact_area",
        "peak_pressure",
        "indentation_depth",
    ] {
        let [one, other] = [&isothermal, &conducting].map(|answer| number(answer, key));
        assert_eq!(one.to_bits(), other.to_bits(), "{key}: {one} and {other}");
    }
    assert!((number(&conducting, "effective_temperature") - 20.0).abs() < f64::EPSILON);
}

/// The hysteresis with heat is the isothermal one at the effective temperature, which is that of the material: of the surroundings plus a mean
/// rise in the depth.
#[test]
fn hysteresis_is_that_at_the_effective_temperature() {
    let folder = Folder::new("heat-effective");
    let insulator = with(HEAT, ["0.25", "0.0025"]);
    let insulator = with(&insulator, ["1.2e-7", "1.2e-6"]);
    let heated = folder.answer(format!(
        "{BALL}{SHEAR}{insulator}counterface = \"conducting\"\n"
    ));
    let temperature = number(&heated, "effective_temperature");
    assert!((22.0..40.0).contains(&temperature), "{temperature}");
    // The same material at this temperature: with a shift law whose reference it is, and times that are shorter by a_T.
    let factor = |celsius: f64| 10_f64.powf(-8.86 * (celsius - 20.0) / (101.6 + celsius - 20.0));
    let times = [1e-3, 0.1].map(|time| format!("relaxation_time = {}", time * factor(temperature)));
    let shifted = with(BALL, ["relaxation_time = 1e-3", &times[0]]);
    let shifted = with(&shifted, ["relaxation_time = 0.1", &times[1]]);
    let isothermal = folder.answer(format!("{shifted}{SHEAR}"));
    for key in [
        "friction_coefficient",
        "friction_from_hysteresis",
        "contact_area",
    ] {
        assert_within_bars(key, [&heated, &isothermal]);
    }
    let [mean, largest] = ["mean", "largest"].map(|name| rise(&heated, name)[0]);
    assert!(
        mean < temperature - 20.0 + 1.0 && temperature - 20.0 < largest,
        "{mean} {largest}"
    );
    let error = number(&heated, "friction_coefficient_error");
    assert!(
        error <= 0.05 * number(&heated, "friction_coefficient"),
        "{error}"
    );
    let spread = number(&heated, "temperature_model_spread");
    assert!(spread > 0.0, "{spread}");
}

/// The shear of a fast contact heats a layer at the surface, and not the depth where the material dissipates. Its strength is that at the mean
/// temperature of the contact area.
#[test]
fn shear_heats_the_surface_and_not_the_depth() {
    let folder = Folder::new("heat-surface");
    let bell = "[interface.bell]\nshear_strength = 1e6\nvelocity = 1e-2\nactivation_energy = 50e3\nwidth = 2.0\n";
    let scene = format!("{BALL}{bell}{HEAT}");
    let heated = folder.answer(&scene);
    let cold = folder.answer(format!("{BALL}{bell}"));
    assert!(number(&heated, "effective_temperature") < 20.1, "{heated}");
    let of_material = "friction_from_hysteresis";
    let ratio = number(&heated, of_material) / number(&cold, of_material);
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    let [mean, error] = rise(&heated, "mean");
    assert!(mean > 3.0, "{mean}");
    let shear_at = |rise: f64| {
        let log_shift = 50e3 / 8.314_462_6 * (1.0 / (293.15 + rise) - 1.0 / 293.15);
        let decades = (0.1 / 1e-2 * log_shift.exp()).log10();
        1e6 * (-(0.5 * decades).powi(2)).exp() * number(&heated, "contact_area") / 1.0
    };
    let [coldest, hottest] = [mean - error, mean + error].map(shear_at);
    let [shear, bar] =
        ["", "_error"].map(|end| number(&heated, &format!("friction_from_shear{end}")));
    let is_within = shear - bar <= coldest.max(hottest) && coldest.min(hottest) <= shear + bar;
    assert!(is_within, "{shear} ± {bar}, not {coldest} to {hottest}");
}

/// A counterface that takes the heat of the shear leaves that of the bulk, and half of it lies between.
#[test]
fn the_counterface_takes_its_share() {
    let folder = Folder::new("heat-share");
    let [insulating, half, conducting] = ["\"insulating\"", "{ share = 0.5 }", "\"conducting\""]
        .map(|word| folder.answer(format!("{BALL}{SHEAR}{HEAT}counterface = {word}\n")))
        .map(|answer| rise(&answer, "mean")[0]);
    assert!(conducting < 0.05 * insulating, "{conducting} {insulating}");
    // Shear does not depend on the temperature here, and the area changes little with it.
    assert_close("half", half, 0.5 * (insulating + conducting), 0.03);
}

/// Where friction grows with temperature, a contact may be kept at one of two temperatures: a warning names the hotter one.
#[test]
fn two_temperatures_are_told() {
    let folder = Folder::new("heat-two");
    let glassy = "[indenter.sphere]\nradius = 5e-3\n[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{ modulus = 1e7, relaxation_time = \
         1e-3 }]\nshift = { temperature = 20.0, temperature_range = [-20.0, 150.0], law = { wlf = [8.86, 101.6] } }\n[load]\nnormal_force = \
         10.0\nvelocity = 0.2\n[solve]\nrelative_error = 0.1\n[heat]\nconductivity = 0.02\ndiffusivity = 1e-3\nambient_temperature = -18.0\n";
    let cold = folder.answer(glassy);
    assert!(number(&cold, "effective_temperature") < -15.0, "{cold}");
    let warnings = cold["warnings"].as_array().expect("a list");
    let is_told = warnings.iter().any(|one| {
        one.as_str()
            .is_some_and(|one| one.contains("one of two temperatures"))
    });
    assert!(is_told, "{warnings:?}");
    // A much worse conductor has the hot state alone, in which friction falls by an eighth for each kelvin.
    let rough = with(glassy, ["relative_error = 0.1", "elements = 24"]);
    let hot = folder.answer(with(&rough, ["0.02", "0.0002"]));
    assert!(number(&hot, "effective_temperature") > 20.0, "{hot}");
}

/// Where friction falls steeply with temperature, an answer to a tenth agrees with a finer one: the temperature is corrected until it
/// causes itself.
#[test]
fn a_steep_law_has_the_temperature_that_it_causes() {
    let folder = Folder::new("heat-steep");
    let steep = with(BALL, ["normal_force = 1.0", "normal_force = 5.0"]);
    let steep = with(&steep, ["velocity = 0.1", "velocity = 0.5"]);
    let bell = "[interface.bell]\nshear_strength = 1e6\nvelocity = 1e-2\nactivation_energy = 200e3\nwidth = 1.0\n";
    let at = |error: &str| {
        let asked = with(&steep, ["relative_error = 0.05", error]);
        folder.answer(format!("{asked}{bell}{HEAT}"))
    };
    let [coarse, fine] = ["relative_error = 0.1", "relative_error = 0.04"].map(at);
    for key in ["friction_coefficient", "effective_temperature"] {
        assert_within_bars(key, [&coarse, &fine]);
    }
}

/// The highest temperature of a law is not exceeded by rounding when a second state is looked for.
#[test]
fn the_highest_temperature_is_within_the_range_of_the_law() {
    let folder = Folder::new("heat-rounding");
    let text = with(BALL, ["120.0]", "59.93]"]);
    let conductor = with(HEAT, ["0.25", "25.0"]);
    folder.answer(format!("{text}{conductor}ambient_temperature = 21.7\n"));
    let highest = folder.answer(format!("{text}{conductor}ambient_temperature = 59.93\n"));
    let temperature = number(&highest, "effective_temperature");
    assert!((temperature - 59.93).abs() < 1e-3, "{temperature}");
}

/// A periodic surface that slides for longer is hotter, and a material without a shift law keeps its moduli, with a warning.
#[test]
fn a_rough_surface_grows_hotter_with_time() {
    let folder = Folder::new("heat-rough");
    let at = |duration: f64| {
        folder.answer(format!(
            "[indenter.self-affine]\nperiod = [1e-2, 1e-2]\nhurst_exponent = 0.8\nrms_slope = 0.1\nlongest_wavelength = \
             1e-2\nshortest_wavelength = 2.5e-3\nseed = 1\n[material.standard-solid]\nequilibrium_modulus = 1e6\nmaxwell_modulus = \
             1e7\nviscosity = 1e4\n[load]\nmean_pressure = 1e5\nvelocity = 0.1\n[solve]\nrelative_error = 0.05\n{SHEAR}{HEAT}duration = \
             {duration}\n"
        ))
    };
    let [early, late] = [1e3, 4e3].map(at);
    let [of_early, of_late] = [&early, &late].map(|answer| rise(answer, "mean"));
    // The waves are as hot as before; the mean flux has heated the surface by 2 Q √(t/(π k ρ c)).
    let flux = number(&late, "friction_coefficient") * 1e5 * 0.1;
    let growth = 2.0 * flux / 0.25 * (1.2e-7 / PI).sqrt() * (4e3_f64.sqrt() - 1e3_f64.sqrt());
    let off = (of_late[0] - of_early[0]) / growth - 1.0;
    assert!(off.abs() < 0.02, "{of_early:?} {of_late:?} {growth}");
    let warnings = late["warnings"].as_array().expect("a list");
    let is_told = warnings
        .iter()
        .any(|one| one.as_str().is_some_and(|one| one.contains("no shift law")));
    assert!(is_told, "{warnings:?}");
    let [one, other] = [&early, &late].map(|answer| number(answer, "friction_coefficient"));
    assert_eq!(
        one.to_bits(),
        other.to_bits(),
        "the moduli stay: {one} {other}"
    );
}

/// A rough surface with a perfect conductor has its isothermal friction to the last bit.
#[test]
fn a_perfect_conductor_under_a_rough_surface_keeps_the_isothermal_answer() {
    let folder = Folder::new("heat-rough-none");
    let (_, rubber) = BALL.split_once("[material").expect("a material");
    let scene = format!(
        "[indenter.self-affine]\nperiod = [1e-2, 1e-2]\nhurst_exponent = 0.8\nrms_slope = 0.1\nlongest_wavelength = 1e-2\nshortest_wavelength = \
         2.5e-3\nseed = 1\n[material{rubber}{SHEAR}"
    );
    let scene = with(&scene, ["normal_force = 1.0", "mean_pressure = 1e5"]);
    let isothermal = folder.answer(&scene);
    let cold = with(HEAT, ["0.25", "1e30"]);
    let conducting = folder.answer(format!("{scene}{cold}duration = 10.0\n"));
    for key in [
        "friction_coefficient",
        "contact_area",
        "friction_coefficient_error",
    ] {
        let [one, other] = [&isothermal, &conducting].map(|answer| number(answer, key));
        assert_eq!(one.to_bits(), other.to_bits(), "{key}: {one} and {other}");
    }
}

/// One wave in full contact has the temperature of its depth, where it dissipates like 4 q³ z² e^(−2qz), everywhere alike: a scalar
/// fixed point of a double integral. The surface is colder at first, and hotter by the heat of an interface.
#[test]
fn one_wave_in_full_contact_has_the_temperature_of_its_depth() {
    let folder = Folder::new("heat-wave");
    let (n, amplitude, period, pressure) = (32_i32, 1e-4, 1e-3, 2e7);
    let height = |place: i32| -amplitude * (2.0 * PI * f64::from(place) / f64::from(n)).cos();
    let line: Vec<String> = (0..n).map(|place| format!("{:e}", height(place))).collect();
    folder.write("wave.csv", vec![line.join(","); 8].join("\n"));
    let (spacing, velocity, relaxation_time) = (period / f64::from(n), 1.0, 8e-4);
    let q = 2.0 * PI / period;
    for (duration, shear) in [(0.004_f64, 0.0_f64), (0.06, 0.0), (0.06, 1e5)] {
        let interface = format!("[interface.constant]\nshear_strength = {shear}\n");
        let answer = folder.answer(format!(
            "[indenter.height-map]\nfile = \"wave.csv\"\nspacing = [{spacing}, {spacing}]\nedges = \"periodic\"\n{}[material.prony]\n\
             equilibrium_modulus = 1e6\nbranches = [{{ modulus = 4e6, relaxation_time = {relaxation_time} }}]\nshift = {{ temperature = 20.0, \
             temperature_range = [-20.0, 200.0], law = {{ wlf = [8.86, 101.6] }} }}\n{HEAT}duration = {duration}\n[load]\nmean_pressure = \
             {pressure}\nvelocity = {velocity}\n[solve]\nrelative_error = 0.03\n",
            if shear > 0.0 { &interface } else { "" }
        ));
        // Rise per power: the temperature of a plane at the other depth and of its mirror image (Carslaw & Jaeger 1959, § 2.5).
        let length = 2.0 * (1.2e-7 * duration).sqrt();
        let ierfc = |x: f64| (-x * x).exp() / PI.sqrt() - x * libm::erfc(x);
        let rise_at = |z: f64, source: f64| {
            0.5 * length / 0.25
                * (ierfc((z - source).abs() / length) + ierfc((z + source) / length))
        };
        let layers = 400;
        let layer = |index: i32| (f64::from(index) + 0.5) * 10.0 / (f64::from(layers) * q);
        let thickness = 10.0 / (f64::from(layers) * q);
        let share = |z: f64| 4.0 * q * (q * z).powi(2) * (-2.0 * q * z).exp() * thickness;
        let [mut of_bulk, mut of_shear] = [0.0; 2];
        for place in (0..layers).map(layer) {
            of_shear += share(place) * rise_at(place, 0.0);
            for source in (0..layers).map(layer) {
                of_bulk += share(place) * share(source) * rise_at(place, source);
            }
        }
        let friction = |rise: f64| {
            let omega = q * velocity * relaxation_time * 10_f64.powf(-8.86 * rise / (101.6 + rise));
            4e6 * omega / (1.0 + omega * omega) * (q * amplitude).powi(2) / pressure
        };
        // The caused rise falls with the rise: bisect.
        let [mut lower, mut upper] = [0.0, 180.0];
        for _ in 0..60 {
            let rise = 0.5 * (lower + upper);
            let caused = (of_bulk * friction(rise) * pressure + of_shear * shear) * velocity;
            if caused > rise {
                lower = rise;
            } else {
                upper = rise;
            }
        }
        let key = if shear > 0.0 {
            "friction_from_hysteresis"
        } else {
            "friction_coefficient"
        };
        let [found, error] = ["", "_error"].map(|end| number(&answer, &format!("{key}{end}")));
        let off = (found - friction(lower)).abs();
        assert!(
            off < error,
            "{duration} s, {shear} Pa: {found} ± {error}, not {}",
            friction(lower)
        );
        assert!(error < 0.04 * found, "{duration} s: {found} ± {error}");
        assert!(
            (friction(lower) / friction(0.0) - 1.0).abs() > 0.01,
            "{lower} K: {answer}"
        );
    }
}

/// Where the surface is hotter than the laws of the material, the waves there have their moduli at the highest temperature, which a
/// warning says.
#[test]
fn waves_hotter_than_the_laws_are_told() {
    let folder = Folder::new("heat-beyond-laws");
    let height = |place: i32| format!("{:e}", -1e-4 * (PI * f64::from(place) / 16.0).cos());
    let line: Vec<String> = (0..32).map(height).collect();
    folder.write("wave.csv", vec![line.join(","); 8].join("\n"));
    let answer = folder.answer(format!(
        "[indenter.height-map]\nfile = \"wave.csv\"\nspacing = [3.125e-5, 3.125e-5]\nedges = \"periodic\"\n[interface.constant]\n\
         shear_strength = 1e5\n[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{{ modulus = 4e6, relaxation_time = 8e-4 }}]\nshift = \
         {{ temperature = 20.0, temperature_range = [-20.0, 50.0], law = {{ wlf = [8.86, 101.6] }} }}\n{HEAT}duration = 0.06\n[load]\n\
         mean_pressure = 2e7\nvelocity = 1.0\n[solve]\nrelative_error = 0.1\n"
    ));
    assert!(number(&answer, "effective_temperature") < 50.0, "{answer}");
    let told = "known up to 50 °C, so that what is hotter is taken to have this temperature";
    assert!(answer["warnings"].to_string().contains(told), "{answer}");
}

/// Requires that a scene is refused with these words.
#[track_caller]
fn assert_refused(text: &str, words: &str) {
    let refused = text
        .parse::<Scene>()
        .map_err(|error| error.to_string())
        .and_then(|scene| Problem::try_from(&scene).map_err(|error| error.to_string()));
    let refused = refused.err().unwrap_or_default();
    assert!(refused.contains(words), "{words}: {refused:?}\n{text}");
}

#[test]
fn wrong_numbers_of_heat_are_refused() {
    // Words in the table of heat with what stands in their place, and what the refusal says.
    for (from, to, words) in [
        ("diffusivity = 1.2e-7\n", "", "give diffusivity [m²/s]"),
        (
            "diffusivity = 1.2e-7",
            "density = 1e3",
            "heat.density: beside density",
        ),
        (
            "diffusivity = 1.2e-7",
            "heat_capacity = 1e3",
            "heat.heat_capacity: beside",
        ),
        (
            "diffusivity",
            "density = 1e3\ndiffusivity",
            "heat.diffusivity: the diffusivity follows",
        ),
        (
            "0.25",
            "-0.25",
            "heat.conductivity must be finite and greater than 0",
        ),
        (
            "diff",
            "counterface = { share = 1.5 }\ndiff",
            "heat.counterface.share must be from 0 to 1",
        ),
        ("diff", "counterface = \"wet\"\ndiff", "heat.counterface"),
        (
            "diff",
            "duration = 1.0\ndiff",
            "heat.duration: the temperature under a body",
        ),
        (
            "diff",
            "ambient_temperature = 300.0\ndiff",
            "heat.ambient_temperature: the temperature must be from",
        ),
        (
            "diff",
            "ambient_temperature = -300.0\ndiff",
            "above absolute zero",
        ),
    ] {
        assert_refused(&format!("{BALL}{}", with(HEAT, [from, to])), words);
    }
}

#[test]
fn heat_is_refused_where_it_is_not_computed() {
    for (from, to, words) in [
        (
            "relative_error",
            "model = \"line\"\nrelative_error",
            "boundary elements do",
        ),
        (
            "relative_error",
            "duration = 1.0\nrelative_error",
            "stationary state",
        ),
        (
            "velocity = 0.1",
            "stroke = 1e-3\nfrequency = 1.0",
            "constant load.velocity",
        ),
        (
            "velocity = 0.1",
            "velocity = 0.1\ntrack = 1.0",
            "leave load.track out",
        ),
        (
            "[load]",
            "[layer]\nthickness = 1e-2\n[load]",
            "leave the layer out",
        ),
        ("equil", "poisson_ratio = 0.4\nequil", "poisson_ratio = 0.5"),
    ] {
        assert_refused(&format!("{}{HEAT}", with(BALL, [from, to])), words);
    }
    let rough = "[indenter.self-affine]\nperiod = [1e-2, 1e-2]\nhurst_exponent = 0.8\nrms_slope = 0.1\nlongest_wavelength = \
         1e-2\nshortest_wavelength = 5e-3\nseed = 1\n";
    let periodic = with(BALL, ["[indenter.sphere]\nradius = 5e-3\n", rough]);
    let periodic = with(&periodic, ["normal_force = 1.0", "mean_pressure = 1e4"]);
    assert_refused(&format!("{periodic}{HEAT}"), "duration [s]");
    let short = "duration = 0.05\n";
    assert_refused(&format!("{periodic}{HEAT}{short}"), "less than its period");
}

/// A contact that heats itself beyond the range of its laws says so, with what was reached.
#[test]
fn a_contact_that_leaves_the_range_of_the_law_is_refused() {
    let folder = Folder::new("heat-too-hot");
    let text = with(&format!("{BALL}{SHEAR}{HEAT}"), ["120.0]", "21.0]"]);
    let text = with(&text, ["0.25", "0.0025"]);
    let text = with(&text, ["1.2e-7", "1.2e-6"]);
    folder.write("scene.toml", text);
    let refused = folder.ends("scene.toml", 1, "beyond 21 °C");
    assert!(refused.contains("would heat it to"), "{refused}");
}
