//! Scenes of rough surfaces that slide.

use std::f64::consts::TAU;

use serde_json::Value;

use crate::support::{Folder, assert_close, number};

/// But for the load.
const SURFACE: &str =
    "indenter.self-affine = { period = [2.0, 1.0], hurst_exponent = 0.8, rms_slope = 0.1, \
    longest_wavelength = 1.0, shortest_wavelength = 0.25, seed = 3 }
material.standard-solid = { equilibrium_modulus = 0.25, maxwell_modulus = 2.25, viscosity = 2.25 }
solve.relative_error = 0.1
load.velocity = 0.03
load.";

fn answer(folder: &Folder, mean_pressure: f64) -> Value {
    folder.answer(format!("{SURFACE}mean_pressure = {mean_pressure}\n"))
}

/// The half space and the sum of the theory share no code.
#[test]
fn in_full_contact_persson_and_the_half_space_agree() {
    let folder = Folder::new("rough-full");
    let full = answer(&folder, 100.0);
    assert_close("area", number(&full, "area_fraction"), 1.0, 1e-15);
    assert_close("contact area", number(&full, "contact_area"), 2.0, 1e-15);
    assert_close("force", number(&full, "normal_force"), 200.0, 1e-15);
    let theory = number(&full["persson"], "friction_coefficient");
    for name in ["friction_coefficient", "friction_from_dissipation"] {
        assert_close(name, number(&full, name), theory, 1e-10);
    }
}

#[test]
fn partial_contact_has_two_frictions_within_their_bars() {
    let folder = Folder::new("rough-partial");
    let partial = answer(&folder, 0.02);
    let bar = |name: &str| [name, &format!("{name}_error")].map(|name| number(&partial, name));
    let [friction, bar_of_friction] = bar("friction_coefficient");
    let [dissipation, bar_of_dissipation] = bar("friction_from_dissipation");
    let [area, bar_of_area] = bar("area_fraction");
    let off = (friction - dissipation).abs();
    let agree = off <= bar_of_friction + bar_of_dissipation;
    assert!(agree, "{friction} and {dissipation}");
    let warnings = partial["warnings"].to_string();
    let warns = warnings.contains("depends on the shortest waves that were kept");
    assert!(warns, "{warnings}");
    let is_reached = bar_of_friction <= 0.1 * friction && bar_of_area < 0.5 * area;
    assert!(is_reached && area < 0.6, "{partial}");
}

/// From rest, and pressed without sliding; where the stationary contact is that of the first the bars of both say so.
#[test]
fn the_way_from_rest_ends_in_the_stationary_state() {
    let folder = Folder::new("rough-from-rest");
    let scene = format!("solve.sliding_distance = 2.0\n{SURFACE}mean_pressure = 0.02\n");
    folder.write("rest.toml", scene);
    let [slid, stationary] = [folder.json("rest.toml"), answer(&folder, 0.02)];
    for name in ["friction_coefficient", "area_fraction"] {
        let [[a, a_bar], [b, b_bar]] = [&slid, &stationary]
            .map(|one| [name, &format!("{name}_error")].map(|name| number(one, name)));
        assert!((a - b).abs() <= a_bar + b_bar, "{slid} {stationary}");
    }
    let way = folder.solved("rest.toml").answer.fields.history;
    let frictions = (way.first(), way.last());
    let [first, last] =
        <[_; 2]>::from(frictions).map(|row| row.map(|row| row.friction_coefficient));
    assert!(first < last.map(|last| 0.5 * last), "{way:?}");
    let scene = format!("solve.duration = 1e9\n{SURFACE}mean_pressure = 0.02\n");
    let pressed = folder.answer(scene.replace("0.03", "0.0"));
    assert!(pressed.get("friction_coefficient").is_none(), "{pressed}");
    // The relaxed solid touches more than the one that slides.
    let [more, less] = [&pressed, &stationary].map(|one| number(one, "area_fraction"));
    assert!(more > less, "{pressed}");
}

/// Of full contact the friction is a sum over waves of q q_x a² G″(q_x v).
#[test]
fn the_shortest_octave_has_the_part_of_the_friction_that_goes_without_it() {
    let folder = Folder::new("rough-cut-off");
    let velocity = 0.03;
    // G″ of the solid, whose relaxation takes 1 s.
    let loss = |frequency: f64| 2.25 * frequency / (1.0 + frequency * frequency);
    let map = |short: f64| {
        let height = |x: f64, y: f64| 0.02 * (TAU * x).cos() + short * (TAU * (4.0 * x + y)).cos();
        let line = |row: usize| {
            let heights = (0..32).map(|column| height(f64::from(column) / 32.0, row as f64 / 16.0));
            heights
                .map(|height| height.to_string())
                .collect::<Vec<_>>()
                .join(",")
        };
        (0..16).map(line).collect::<Vec<_>>().join("\n")
    };
    let table = "file = \"map.csv\", spacing = [0.0625, 0.0625], edges = \"periodic\"";
    let (_, rest) = SURFACE.split_once('\n').expect("lines");
    let scene = format!("indenter.height-map = {{ {table} }}\n{rest}mean_pressure = 100.0\n");
    folder.write("scene.toml", scene);
    for (short, warns) in [(2e-3, true), (2e-4, false)] {
        folder.write("map.csv", map(short));
        let answer = folder.json("scene.toml");
        let part = |q: [f64; 2], a: f64| q[0].hypot(q[1]) * q[0] * a * a * loss(q[0] * velocity);
        let long = part([TAU / 2.0, 0.0], 0.02);
        let short = part([4.0 * TAU / 2.0, TAU], short);
        let share = number(&answer["dissipation"], "shortest_octave");
        assert_close("share", share, short / (short + long), 1e-9);
        let warnings = answer["warnings"].to_string();
        assert_eq!(warnings.contains("the shortest octave"), warns, "{answer}");
    }
    // The shorter wave alone is no cut-off.
    folder.write("map.csv", map(0.0));
    let answer = folder.json("scene.toml");
    assert!(answer.get("dissipation").is_none(), "{answer}");
}

/// The same two waves, written on two grids.
#[test]
fn a_periodic_map_is_the_same_surface_on_any_grid() {
    let folder = Folder::new("rough-map");
    let wave = |x: f64, y: f64, phase: f64| 0.02 * (TAU * (x + y) + phase).cos();
    let answers = [[16, 8], [20, 15]].map(|[along_x, along_y]| {
        let part = |index: usize, of: usize| index as f64 / of as f64;
        let line = |row: usize| {
            let height = |column: usize| {
                let (x, y) = (part(column, along_x), part(row, along_y));
                let height = wave(x, 2.0 * y, 0.3) + 0.5 * wave(3.0 * x, -y, 1.0);
                height.to_string()
            };
            (0..along_x).map(height).collect::<Vec<_>>().join(",")
        };
        let lines: Vec<String> = (0..along_y).map(line).collect();
        folder.write("map.csv", lines.join("\n"));
        let spacing = [2.0 * part(1, along_x), part(1, along_y)];
        let (before, after) = SURFACE.split_once("\n").expect("lines");
        assert!(before.starts_with("indenter.self-affine"), "{before}");
        let map = format!("file = \"map.csv\", spacing = {spacing:?}, edges = \"periodic\"");
        let scene = format!("indenter.height-map = {{ {map} }}\n{after}mean_pressure = 0.02\n");
        folder.answer(scene)
    });
    for name in ["friction_coefficient", "area_fraction"] {
        let [one, other] = [0, 1].map(|index: usize| number(&answers[index], name));
        assert_close(name, one, other, 1e-9);
    }
}

/// With 144 waves in the longer period four elements for each of them need more than are usual, and with little memory twelve do:
/// the first grid has only the longer waves then.
#[test]
fn all_waves_are_answered_where_grids_are_large_or_memory_is_small() {
    let folder = Folder::new("rough-many-waves");
    let answer = |waves: f64, memory: &str| {
        let shortest = 2.0 / waves;
        let scene = SURFACE.replace(" 0.25,", &format!(" {shortest},"));
        let scene = scene.replace("= 0.1\nload", &format!("= 0.1\n{memory}load"));
        folder.answer(format!("{scene}mean_pressure = 0.1\n"))
    };
    let many = answer(144.0, "");
    let [area, bar] = ["area_fraction", "area_fraction_error"].map(|name| number(&many, name));
    assert!(bar < area && area < 0.3, "{many}");
    let [little, much] = ["solve.max_memory = \"48 MiB\"\n", ""].map(|memory| answer(40.0, memory));
    for name in ["friction_coefficient", "area_fraction"] {
        let [[a, a_bar], [b, b_bar]] = [&little, &much]
            .map(|one| [name, &format!("{name}_error")].map(|name| number(one, name)));
        assert!(
            (a - b).abs() <= a_bar + b_bar && b_bar < a_bar,
            "{little} {much}"
        );
    }
}
