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

/// The friction of full contact is a sum over waves of q q_x a² G″(q_x v).
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

/// Two waves on two grids give the same answer.
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

/// With little memory three grids from four elements per shortest wave on are too large, and the first has only the longer waves.
#[test]
fn with_little_memory_all_waves_are_answered_on_coarser_grids() {
    let folder = Folder::new("rough-many-waves");
    let answer = |memory: &str| {
        let scene = SURFACE.replace(" 0.25,", " 0.05,");
        let scene = scene.replace("= 0.1\nload", &format!("= 0.1\n{memory}load"));
        folder.answer(format!("{scene}mean_pressure = 0.1\n"))
    };
    let [little, much] = ["solve.max_memory = \"48 MiB\"\n", ""].map(answer);
    for name in ["friction_coefficient", "area_fraction"] {
        let [[a, a_bar], [b, b_bar]] = [&little, &much]
            .map(|one| [name, &format!("{name}_error")].map(|name| number(one, name)));
        assert!(
            (a - b).abs() <= a_bar + b_bar && b_bar < a_bar,
            "{little} {much}"
        );
    }
}

/// The mean of the answers of the single surfaces, with the mean of their bars and a standard error of its own; in another file and
/// unit a spectrum is the same.
#[test]
fn realisations_have_the_mean_of_their_answers_and_scatter() {
    let folder = Folder::new("rough-realisations");
    folder.write("a.csv", "wave_number,density\n6.2,1e-6\n25,2e-8\n");
    let factor = TAU * TAU;
    let [first, second] = [1e-6 * factor, 2e-8 * factor];
    folder.write(
        "b.csv",
        format!("wave_number,density,waves\n6.2,{first},1\n25,{second},2\n"),
    );
    let (_, rest) = SURFACE.split_once('\n').expect("lines");
    let answer = |keys: &str| {
        let body = format!("indenter.spectrum = {{ period = [2.0, 1.0], {keys} }}");
        folder.answer(format!("{body}\n{rest}mean_pressure = 0.02\n"))
    };
    let of_seed = |seed: usize| answer(&format!("file = \"a.csv\", seed = {seed}"));
    let single = [3, 4, 5].map(of_seed);
    let all = answer("file = \"a.csv\", seed = 3, realisations = 3");
    let convention = "convention = \"surface-topography\"";
    let other = answer(&format!(
        "file = \"b.csv\", {convention}, seed = 3, realisations = 3"
    ));
    for name in ["friction_coefficient", "area_fraction"] {
        let values = single.each_ref().map(|one| number(one, name));
        let mean = values.iter().sum::<f64>() / 3.0;
        assert_close(name, number(&all, name), mean, 1e-12);
        assert_close(name, number(&other, name), mean, 1e-6);
        let name_of_error = format!("{name}_error");
        let errors = single.each_ref().map(|one| number(one, &name_of_error));
        let error = errors.iter().sum::<f64>() / 3.0;
        assert_close(name, number(&all, &name_of_error), error, 1e-12);
        let squares = values.map(|value| (value - mean).powi(2));
        let scatter = (squares.iter().sum::<f64>() / 2.0).sqrt();
        let found = ["scatter", "standard_error"].map(|end| number(&all, &format!("{name}_{end}")));
        assert_close(name, found[0], scatter, 1e-9);
        assert_close(name, found[1], scatter / 3.0_f64.sqrt(), 1e-9);
        let of = |index: usize| number(&all["realisations"][index], name);
        for (index, value) in values.into_iter().enumerate() {
            assert_close(index, of(index), value, 1e-15);
        }
    }
    let seeds: Vec<&Value> = (0..3)
        .map(|index| &all["realisations"][index]["seed"])
        .collect();
    assert_eq!(seeds, [3, 4, 5], "{all}");
    assert!(single[0].get("realisations").is_none(), "{}", single[0]);
}

/// Most surfaces are on a coarse grid, whose error the mean has not: it is that of the same surfaces when each is solved.
#[test]
fn a_coarse_grid_tells_surfaces_apart() {
    let folder = Folder::new("rough-standard-error");
    let scene = |keys: &str| {
        SURFACE.replace("seed = 3", &format!("seed = 3, {keys}")) + "mean_pressure = 0.02\n"
    };
    let found = folder.answer(scene("standard_error = 0.018"));
    let solved = found["realisations"].as_array().map_or(0, Vec::len);
    let more = found["realisations_on_coarse_grid"].as_u64();
    let count = solved as u64 + more.unwrap_or(0);
    assert!(solved == 10 && count > 40, "{found}");
    let all = folder.answer(scene(&format!("realisations = {count}")));
    assert!(all.get("realisations_on_coarse_grid").is_none(), "{all}");
    // The area is not what is asked for, and differs more from grid to grid.
    for (name, part) in [("friction_coefficient", 0.5), ("area_fraction", 2.0)] {
        let [error, scatter] =
            ["standard_error", "scatter"].map(|end| number(&found, &format!("{name}_{end}")));
        let value = number(&found, name);
        assert!(error < part * 0.036 * value, "{name}: {error}");
        let difference = value - number(&all, name);
        assert!(
            difference.abs() < part * error,
            "{name}: {difference} {error}"
        );
        assert_close(name, scatter, number(&all, &format!("{name}_scatter")), 0.2);
    }
    let area = number(&found, "contact_area") / number(&found, "area_fraction");
    assert_close("period", area, 2.0, 1e-12);
    for name in ["friction_coefficient", "area_fraction"] {
        let [one, other] = [&found, &all].map(|answer| number(&answer["persson"], name));
        assert_close(name, one, other, 1e-12);
    }
    for (keys, status, why) in [
        (
            "standard_error = 1e-3, realisations = 11",
            1,
            "the relative standard error 0.001 of the mean was not reached",
        ),
        (
            "standard_error = 0.9, realisations = 4",
            2,
            "realisations must be from 10 to 1000 with a standard_error",
        ),
    ] {
        folder.write("scene.toml", scene(keys));
        folder.ends("scene.toml", status, why);
    }
}

/// A folder with maps of 16 × 12 points: in unknown units, with its units in its head, with holes, and a flat one.
fn folder_of_maps(name: &str) -> Folder {
    let folder = Folder::new(name);
    let point = |(x, y): (u32, u32)| {
        let [along_x, along_y] = [f64::from(x) / 16.0, f64::from(y) / 12.0];
        let height = (TAU * along_x).cos() + 0.3 * (TAU * along_y).sin();
        format!("{x} {y} {}\n", 0.1 * height)
    };
    let with_holes = |most: u32| -> String {
        let all = (0..192).map(|index| (index % 16, index / 16));
        all.filter(|(x, y)| (x * 7 + y * 5) % 16 >= most)
            .map(point)
            .collect()
    };
    folder.write("map.xyz", with_holes(0));
    folder.write(
        "named.xyz",
        format!("# x [mm] y [mm] z [mm]\n{}", with_holes(0)),
    );
    folder.write("holes.xyz", with_holes(1));
    folder.write("gone.xyz", with_holes(9));
    folder.write("flat.csv", "1,1\n1,1\n");
    folder
}

/// The scene of a height map with these keys.
fn scene_of_map(keys: &str) -> String {
    let (_, rest) = SURFACE.split_once('\n').expect("lines");
    format!("indenter.height-map = {{ {keys} }}\n{rest}mean_pressure = 1000.0\n")
}

#[test]
fn strange_maps_are_warned_of() {
    let folder = folder_of_maps("rough-strange-maps");
    let periodic = "edges = \"periodic\"";
    for (keys, warning) in [
        ("file = \"map.xyz\"", "a period of 1.600e1 m"),
        (
            "file = \"map.xyz\", unit = \"nm\", lateral_unit = \"mm\"",
            "root mean square slope of 3.032e-8",
        ),
        (
            "file = \"named.xyz\", lateral_unit = \"um\"",
            "x and y: lateral_unit has no effect",
        ),
        (
            "file = \"holes.xyz\", fill_missing = true, unit = \"mm\"",
            "6.2 % of the heights",
        ),
    ] {
        let answer = folder.answer(scene_of_map(&format!("{keys}, {periodic}")));
        let warnings = answer["warnings"].to_string();
        assert!(warnings.contains(warning), "{keys}: {warnings}");
    }
    let mirrored = "file = \"map.xyz\", edges = \"mirrored\", unit = \"mm\"";
    let warnings = folder.answer(scene_of_map(mirrored))["warnings"].to_string();
    assert!(
        warnings.contains("four times those of the map alone"),
        "{warnings}"
    );
}

/// The friction of an elastic material is 0, whatever the rounding of slopes leaves of it: the depth decides how fine the elements are, also
/// under a body without a symmetry.
#[test]
fn an_elastic_map_without_symmetry_has_the_requested_depth() {
    let folder = Folder::new("elastic-map");
    let height = |row: i32, column: i32| {
        let [y, x] = [row, column].map(|index| 1e-4 * f64::from(index - 10));
        let steepness = if x < 0.0 { 1.0 } else { 2.0 };
        format!("{:e}", -100.0 * (steepness * x * x + y * y))
    };
    let line = |row| {
        (0..21)
            .map(|column| height(row, column))
            .collect::<Vec<_>>()
    };
    let lines: Vec<String> = (0..21).map(|row| line(row).join(",")).collect();
    folder.write("map.csv", lines.join("\n"));
    let [coarse, fine] = ["1e-3", "1e-4"].map(|error| {
        let answer = folder.answer(format!(
            "indenter.height-map = {{ file = \"map.csv\", spacing = [1e-4, 1e-4] }}\nmaterial.elastic.shear_modulus = 1e6\nload = {{ \
             normal_force = 0.1, velocity = 0.02 }}\nsolve.relative_error = {error}\n"
        ));
        assert!(number(&answer, "friction_coefficient").abs() < f64::MIN_POSITIVE);
        ["indentation_depth", "indentation_depth_error"].map(|key| number(&answer, key))
    });
    assert!(
        coarse[1] <= 1e-3 * coarse[0] && fine[1] <= 1e-4 * fine[0],
        "{coarse:?} {fine:?}"
    );
    assert!(
        (coarse[0] - fine[0]).abs() <= coarse[1] + fine[1],
        "{coarse:?} {fine:?}"
    );
}

#[test]
fn units_of_a_head_are_those_of_the_keys() {
    let folder = folder_of_maps("rough-units-of-maps");
    let force = |keys: &str| {
        let answer = folder.answer(scene_of_map(&format!("{keys}, edges = \"periodic\"")));
        number(&answer, "normal_force")
    };
    let same = ["file = \"map.xyz\", unit = \"mm\"", "file = \"named.xyz\""].map(force);
    assert_close("force", same[0], 1000.0 * 0.016 * 0.012, 1e-9);
    assert_close("force", same[1], same[0], 1e-12);
}

#[test]
fn maps_that_are_none_are_refused() {
    let folder = folder_of_maps("rough-no-maps");
    for (keys, reason) in [
        (
            "file = \"gone.xyz\", fill_missing = true",
            "more than a half",
        ),
        (
            "file = \"flat.csv\", spacing = [1.0, 1.0]",
            "the map is flat",
        ),
        (
            "file = \"flat.csv\", spacing = [1.0, 1.0], lateral_unit = \"mm\"",
            "the spacing is in m",
        ),
    ] {
        folder.write("scene.toml", scene_of_map(keys));
        folder.ends("scene.toml", 2, reason);
    }
}
