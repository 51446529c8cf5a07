//! An answer says where it goes beyond the frequencies at which its material was measured.

use crate::support::{Folder, assert_close, number};

const SOLID: &str = "[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{ modulus = 1e7, relaxation_time = 1e-3 }]\n";
const SPHERE: &str = "[indenter.sphere]\nradius = 5e-3\n[load]\nnormal_force = 2.0\n";

/// Parts of the friction below and above a window, and both; a warning says more than a tenth.
fn parts(folder: &Folder, scene: &str, window: [f64; 2]) -> [f64; 3] {
    let measured = format!("]\nvalid_frequencies = {window:?}\n");
    let at = scene.find("[material.").expect("a material");
    let (before, material) = scene.split_at(at);
    let result = folder.answer(format!(
        "{before}{}",
        material.replacen("]\n", &measured, 1)
    ));
    let share = |name: &str| number(&result["dissipation"], name);
    let shares = ["below_window", "above_window", "outside_window"].map(share);
    let is_said = result["warnings"].to_string().contains("was not measured");
    assert_eq!(is_said, shares[2] > 0.1, "{scene}: {result}");
    shares
}

/// The parts of the friction below and above two windows that meet add up, and those of two methods agree.
#[test]
fn friction_from_outside_of_the_measured_frequencies_is_said() {
    let folder = Folder::new("window");
    // Over a contact of 2 mm the waves have about v/(1 mm).
    let cases = [
        ("", 1e-6),
        ("", 0.1),
        ("method = \"bem-transient\"\nelements = 16", 0.1),
        ("sliding_distance = 1e-2\nelements = 16", 0.1),
        ("model = \"line\"", 1e-6),
        ("model = \"line\"", 0.1),
        ("method = \"mdr-transient\"\nelements = 64", 0.1),
        (
            "model = \"line\"\nsliding_distance = 1e-2\nelements = 64",
            0.1,
        ),
    ];
    let mut found = Vec::new();
    for (solve, velocity) in cases {
        let scene = format!("{SPHERE}velocity = {velocity}\n[solve]\n{solve}\n{SOLID}");
        let middle = 1e3 * velocity;
        let [below, none, outside] = parts(&folder, &scene, [middle, 1e30]);
        let [zero, above, _] = parts(&folder, &scene, [1e-30, middle]);
        assert_close("both sides", below + above, 1.0, 1e-12);
        assert_close("all outside", outside, below + none, 1e-12);
        assert!(
            none.max(zero) < 1e-20,
            "{none} and {zero} beyond everything"
        );
        let is_inside = (0.05..0.95).contains(&below);
        assert!(is_inside, "{below} below {middle} rad/s: {scene}");
        found.push(below);
    }
    for [one, other] in [[1, 2], [1, 3], [5, 6], [5, 7]].map(|pair| pair.map(|at| found[at])) {
        assert!((one - other).abs() < 0.02, "{found:?}");
    }
}

/// On a dashpot the line carries the same along all of the leading edge of a cone, of the length L, and every wave dissipates by
/// its square: below ω = 2xv/L the part is (2/π)(Si(2x) − sin²x/x) (Python, the midpoint rule with 200 000 steps).
#[test]
fn waves_of_a_cone_on_a_dashpot_have_their_parts() {
    let folder = Folder::new("window-of-a-cone");
    let cone = "[indenter.cone]\nslope = 0.1\n[load]\nnormal_force = 1.0\nvelocity = 0.01\n[solve]\nmodel = \"line\"\n";
    let scene = format!("{cone}[material.viscous]\nviscosity = 1e4\n");
    let length = 2.5e-3 / (std::f64::consts::FRAC_PI_2 * 0.1);
    for (x, expected) in [
        (0.5, 0.309_643),
        (1.0, 0.571_264),
        (2.0, 0.856_121),
        (5.0, 0.938_658),
    ] {
        let [below, ..] = parts(&folder, &scene, [2.0 * x * 0.01 / length, 1e30]);
        assert!((below - expected).abs() < 3e-3, "{x}: {below}, {expected}");
    }
    let needed = "analytic does not answer this scene: it does not say which part of the friction comes from outside of";
    folder.ends("scene.toml --method analytic", 2, needed);
    let slides = scene.replace("model = \"line\"\n", "elements = 12\n");
    let result = folder.answer(slides.replace("]\nvis", "]\nvalid_frequencies = [1.0, 2.0]\nvis"));
    assert_eq!(result["method"], "bem-steady", "{result}");
}

/// Where nothing slides, times say whether the material was measured.
#[test]
fn presses_and_histories_beyond_the_measured_times_are_said() {
    let folder = Folder::new("window-of-times");
    let material = SOLID.replacen("]\n", "]\nvalid_frequencies = [0.1, 100.0]\n", 1);
    let held =
        |seconds: f64| format!("normal_force = 2.0\nvelocity = 0.0\n[solve]\nduration = {seconds}");
    let curve = |first: f64, last: f64| {
        let point =
            |time: f64, depth: f64| format!("{{ time = {time}, indentation_depth = {depth} }}");
        let points = [
            point(0.0, 0.0),
            point(first, 1e-5),
            point(first, 2e-5),
            point(last, 0.0),
        ];
        format!("history = [{}]", points.join(", "))
    };
    for (load, said) in [
        (held(5.0), None),
        (held(20.0), Some("from 2.000e1 s to 2.000e1 s")),
        (held(1e-3), Some("from 1.000e-3 s to 1.000e-3 s")),
        (curve(1.0, 10.0), None),
        (curve(1.0, 11.0), Some("from 1.000e0 s to 1.100e1 s")),
        (curve(9e-3, 5.0), Some("from 9.000e-3 s to 5.000e0 s")),
    ] {
        let body = "[indenter.sphere]\nradius = 5e-3\n";
        let result = folder.answer(format!("{body}{material}[load]\n{load}\n"));
        let warnings = result["warnings"].to_string();
        let numbers = "times from 1.000e-2 s to 1.000e1 s";
        let holds = said.map_or(warnings == "[]", |said| {
            warnings.contains(said) && warnings.contains(numbers)
        });
        assert!(holds, "{load}: {result}");
        assert!(result.get("dissipation").is_none(), "{result}");
    }
}

#[test]
fn a_window_has_two_ends_in_order() {
    let folder = Folder::new("window-refused");
    let material = SOLID.replacen("]\n", "]\nvalid_frequencies = [1.0, 1.0]\n", 1);
    folder.write("scene.toml", format!("{SPHERE}velocity = 0.1\n{material}"));
    let refused = "material.prony.valid_frequencies[1] must be finite and greater than valid_frequencies[0], but is 1";
    folder.ends("scene.toml", 2, refused);
}
