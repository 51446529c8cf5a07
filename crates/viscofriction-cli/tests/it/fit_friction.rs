//! Tables of friction, and what the program makes of them.

use std::fs;

use serde_json::Value;

use crate::support::{Folder, assert_close, number};

/// A body and a material with a closed form in the one-dimensional model.
pub(crate) const SCENE: &str = "[indenter.paraboloid]\ncurvature = 100.0\n[material.kelvin-voigt]\nshear_modulus = 3e6\nviscosity = 2e3\n\
     [load]\nnormal_force = 1.0\n[solve]\nmodel = \"line\"\n";

/// Speeds and friction coefficients with 1 MPa and 10 kPa s.
pub(crate) fn points(folder: &Folder, count: usize) -> Vec<[f64; 2]> {
    let truth = SCENE.replace("3e6", "1e6").replace("2e3", "1e4");
    folder.write(
        "true.toml",
        truth.replace("[solve]", "velocity = 1.0\n[solve]"),
    );
    let speeds = format!("--vary load.velocity=1e-3:1:{count}:log");
    folder.done(format!("sweep true.toml {speeds} --out true.csv"));
    let columns = ["load.velocity", "friction_coefficient"].map(|name| {
        let table = csv::Reader::from_path(folder.path("true.csv"));
        let mut table = table.expect("a table");
        let place = table
            .headers()
            .expect("names")
            .iter()
            .position(|one| one == name);
        let place = place.expect("a column");
        let rows = table
            .records()
            .map(|row| row.expect("a row")[place].parse::<f64>());
        rows.collect::<Result<Vec<f64>, _>>().expect("numbers")
    });
    let [speeds, friction] = columns;
    speeds
        .into_iter()
        .zip(friction)
        .map(|(v, mu)| [v, mu])
        .collect()
}

#[test]
fn the_material_may_be_that_of_a_file() {
    let folder = Folder::new("friction-of-file");
    let rows = points(&folder, 8)
        .into_iter()
        .map(|[v, mu]| format!("{v},{mu},{}\n", 0.02 * mu));
    let table = format!("v (m/s),mu,standard error\n{}", rows.collect::<String>());
    folder.write("friction.csv", table);
    let start = SCENE.find("[material").expect("a material");
    let end = SCENE.find("[load]").expect("a load");
    folder.write("start.toml", &SCENE[start..end]);
    let scene = [
        &SCENE[..start],
        "[material.file]\npath = \"start.toml\"\n",
        &SCENE[end..],
    ];
    folder.write("scene.toml", scene.concat());
    folder.done("fit-friction friction.csv scene.toml --out out");
    let found = folder.column("out/findings.csv", 2);
    for (found, truth) in found.iter().zip([1e6, 1e4]) {
        assert_close("of a file", *found, truth, 1e-3);
    }
    let material = fs::read_to_string(folder.path("out/material.toml")).expect("a material");
    assert!(material.contains("[material.kelvin-voigt"), "{material}");
}

#[test]
fn names_and_units_are_found_and_the_files_are_those_of_the_fit() {
    let folder = Folder::new("friction");
    folder.write("scene.toml", SCENE);
    let points = points(&folder, 8);
    let table = |head: &str, row: &dyn Fn(f64, f64) -> String| {
        let rows = points.iter().map(|&[v, mu]| row(v, mu) + "\n");
        format!("{head}\n{}", rows.collect::<String>())
    };
    let tables = [
        table("v (mm/s),mu,standard error", &|v, mu| {
            format!("{},{mu},{}", 1e3 * v, 0.02 * mu)
        }),
        table(
            "mu (%);normal force (mN);speed (m/s);mu error (%)",
            &|v, mu| format!("{};1e3;{v};{}", 1e2 * mu, 2.0 * mu),
        ),
        table(
            "v\tnormal force\tfriction force\tstandard error\num/s\tN\tN\t-",
            &|v, mu| format!("{}\t1\t{mu}\t{}", 1e6 * v, 0.02 * mu),
        ),
    ];
    for (index, table) in tables.iter().enumerate() {
        folder.write("friction.csv", table);
        let printed = folder
            .done("fit-friction friction.csv scene.toml --out out --overwrite")
            .stdout;
        assert!(printed.contains("kelvin-voigt.viscosity"), "{printed}");
        let found = folder.column("out/findings.csv", 2);
        for (found, truth) in found.iter().zip([1e6, 1e4]) {
            assert_close(format!("table {index}"), *found, truth, 1e-3);
        }
    }
    let residuals = folder.column("out/fit.csv", 7);
    assert_eq!(residuals.len(), points.len(), "one row for each point");
    let material = fs::read_to_string(folder.path("out/material.toml")).expect("a material");
    let rest =
        "[indenter.paraboloid]\ncurvature = 100.0\n[load]\nnormal_force = 1.0\nvelocity = 0.01\n";
    folder.write(
        "again.toml",
        format!("{material}{rest}[solve]\nmodel = \"line\"\n"),
    );
    folder.done("run again.toml");
    folder.ends(
        "fit-friction friction.csv scene.toml --out out",
        2,
        "--overwrite",
    );
}

#[test]
fn wrong_input_is_named_with_file_line_and_column() {
    let folder = Folder::new("wrong-friction");
    folder.write("scene.toml", SCENE);
    for (table, expected) in [
        (
            "v (m/s),mu\n1e-3,0.1\n1e-2,none\n",
            "friction.csv, line 3, column 2 (mu): expected a finite number",
        ),
        (
            "v (m/s),mu\n1e-3,-0.1\n",
            "line 2, column 2 (mu): expected a number greater than 0",
        ),
        (
            "v,mu\n1e-3,0.1\n",
            "column 1 (v) has no unit, in brackets behind its name or in the line below: m/s, mm/s",
        ),
        (
            "v (m/s),friction force (N)\n1,2\n",
            "there must be a column force",
        ),
        ("a,b\n1,2\n", "a line of names is needed: v (or rpm) and mu"),
        ("v (m/s),mu\n1,0.1\n2,0.2\n", "at least 3 points"),
        (
            "v (m/s),mu,T (C)\n1,0.1,20\n2,0.2,20\n3,0.2,20\n",
            "scene.toml:3: material.kelvin-voigt: the points have temperatures",
        ),
    ] {
        folder.write("friction.csv", table);
        folder.ends("fit-friction friction.csv scene.toml", 2, expected);
    }
    folder.write("friction.csv", "v (m/s),mu\n1,0.1\n2,0.2\n3,0.2\n");
    folder.ends(
        "fit-friction friction.csv scene.toml --prior -1",
        2,
        "--prior must be",
    );
    folder.ends(
        "fit-friction friction.csv scene.toml --free shift",
        2,
        "needs one to begin with",
    );
}

/// Rows of a table over time: for each run its speed and the friction of its rows, which fall from three times that in the first
/// ten seconds.
fn runs(points: &[[f64; 2]], row: &dyn Fn(f64, f64, f64) -> String) -> String {
    let run = |(number, &[v, mu]): (usize, &[f64; 2])| {
        let rows = (0..40).map(move |at| {
            let time = f64::from(at);
            let scatter = if at % 2 == 0 { 1.01 } else { 0.99 };
            let run_in = if at < 10 { 3.0 } else { 1.0 };
            row(time + 1e3 * number as f64, v, mu * scatter * run_in) + "\n"
        });
        rows.collect::<String>()
    };
    points.iter().enumerate().map(run).collect()
}

#[test]
fn runs_over_time_are_read_as_their_means() {
    let folder = Folder::new("friction-over-time");
    folder.write("scene.toml", SCENE);
    let points = points(&folder, 8);
    // A track of 30 mm, and a sensor whose normal force is negative.
    let of_disc = |time: f64, v: f64, mu: f64| {
        let turns = v / 0.03 * 60.0 / std::f64::consts::TAU;
        format!("{time};{turns};{};-2000", 2.0 * mu)
    };
    let rows = runs(&points, &of_disc);
    let table = format!("t (s);rpm;Ft (N);Fn (mN)\n{rows}");
    folder.write("friction.csv", &table);
    let line = "fit-friction friction.csv scene.toml --track-radius 0.03";
    folder.ends(line, 2, "name the run-in");
    let printed = folder.done(format!("{line} --run-in 10")).stdout;
    for expected in [
        "the normal force is negative in 320 of 320 rows",
        "320 rows are 8 runs at constant speed",
        "lines 2 to 41: 0.001 m/s, friction",
        "of 30 rows\n",
    ] {
        assert!(printed.contains(expected), "no {expected} in {printed}");
    }
    let line = format!("{line} --run-in 10 --format json");
    let found: Value = serde_json::from_str(&folder.done(line).stdout).expect("JSON");
    let read = found["points"].as_array().expect("points");
    for (point, [v, mu]) in read.iter().zip(&points) {
        assert_close("speed", number(point, "velocity"), *v, 1e-6);
        assert_close("friction", number(point, "friction_coefficient"), *mu, 1e-9);
        assert_close("force", number(point, "normal_force"), 2.0, 1e-12);
        // Rows that alternate by 1 % have a mean known at least as well as that of 30 independent ones.
        let error = number(point, "standard_error") / mu;
        assert!((1e-4..2e-3).contains(&error), "{error}");
    }
    assert_eq!(read.len(), points.len(), "one point for each run");
    let short = folder.ends(
        "fit-friction friction.csv scene.toml --track-radius 0.03 --run-in 35",
        2,
        "friction.csv, line 2: the run from here to line 41 lasts 39 s, and 5 of its 40 rows",
    );
    assert!(short.stdout.is_empty(), "{short:?}");
}

/// Tables, options, and what is said.
const REFUSED: [[&str; 3]; 10] = [
    [
        "rpm,mu\n100,0.1\n",
        "",
        "needs the radius of the track: a column track radius, or --track-radius",
    ],
    [
        "rpm,radius (mm),mu\n100,30,0.1\n",
        "--track-radius 0.03",
        "has no effect, because there is 'radius (mm)'",
    ],
    [
        "v (m/s),mu\n1,0.1\n",
        "--track-radius 0.03",
        "has no effect, because there is 'v (m/s)'",
    ],
    [
        "v (m/s),mu\n1,0.1\n",
        "--track-radius -1",
        "--track-radius must be finite and greater than 0",
    ],
    [
        "v (m/s),mu\n1,0.1\n",
        "--run-in 3",
        "a run-in has no effect",
    ],
    [
        "v (m/s),mu\n1,0.1\n2,30\n",
        "",
        "line 3, column 2 (mu): expected a friction coefficient of at most 10",
    ],
    [
        "v (m/s),mu\n0.1,1e-4\n0.11,1e-2\n0.12,1\n",
        "",
        "are the columns of speed and friction exchanged?",
    ],
    [
        "v (m/s),Ft (N),Fn (N)\n0.1,5,1\n1,5,1.5\n10,5,2\n",
        "",
        "the columns of the two forces are exchanged",
    ],
    [
        "v (m/s),Ft (N),Fn (N)\n0.1,50,1\n",
        "",
        "at most 10 times the normal force",
    ],
    [
        "v (m/s),Ft (N),Fn (N)\n0.1,5,0\n",
        "",
        "line 2, column 3 (Fn (N)): expected a number greater than 0",
    ],
];

#[test]
fn tables_that_are_no_friction_over_speed_are_refused() {
    let folder = Folder::new("no-friction");
    folder.write("scene.toml", SCENE);
    for [table, options, expected] in REFUSED {
        folder.write("friction.csv", table);
        let line = format!("fit-friction friction.csv scene.toml {options}");
        folder.ends(&line, 2, expected);
    }
    let stroke = |at: i32| if at % 2 == 0 { 0.3 } else { -0.3 };
    let in_percent = |at: i32| 20.0 + f64::from(at % 2);
    let cases: [(&dyn Fn(i32) -> f64, &str); 2] = [
        (&stroke, "of a reciprocating motion give the rows of one"),
        (&in_percent, "but the mean friction of the run is 20.5"),
    ];
    for (friction, expected) in cases {
        let rows = (0..40).map(|at| format!("{at},0.1,{}\n", friction(at)));
        let table = format!("t (s),v (m/s),mu\n{}", rows.collect::<String>());
        folder.write("friction.csv", table);
        folder.ends(
            "fit-friction friction.csv scene.toml --run-in 0",
            2,
            expected,
        );
    }
}

/// A ball on a rubber in the one-dimensional model, with a fast branch of which slow friction tells nothing.
fn rubber(slow: &str, covariance: &str) -> String {
    format!(
        "[indenter.sphere]\nradius = 5e-3\n[load]\nnormal_force = 1.0\nvelocity = 1e-3\n[solve]\nmodel = \"line\"\n[material.prony]\n\
         equilibrium_modulus = 1e6\nbranches = [{{ modulus = {slow}, relaxation_time = 0.1 }}, {{ modulus = 2e6, \
         relaxation_time = 1e-6 }}]\n{covariance}"
    )
}

const COVARIANCE: &str =
    "covariance.relative = [[0.01, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.0, 0.04]]\n";

#[test]
fn the_covariance_of_the_material_is_known_before_the_fit() {
    let folder = Folder::new("friction-prior");
    folder.write("true.toml", rubber("5e5", ""));
    folder.done("sweep true.toml --vary load.velocity=1e-4:1e-2:5:log --out true.csv");
    let table = folder.text("true.csv");
    let names: Vec<&str> = table
        .lines()
        .next()
        .unwrap_or_default()
        .split(',')
        .collect();
    let column = |name: &str| names.iter().position(|one| *one == name).expect("a column");
    let speeds = folder.column("true.csv", column("load.velocity"));
    let friction = folder.column("true.csv", column("friction_coefficient"));
    let rows = speeds
        .iter()
        .zip(&friction)
        .map(|(v, mu)| format!("{v},{mu},{}\n", 0.02 * mu));
    folder.write(
        "friction.csv",
        format!("v (m/s),mu,standard error\n{}", rows.collect::<String>()),
    );
    folder.write("scene.toml", rubber("5e5", COVARIANCE));
    let fit = |prior: &str| {
        let line = format!("fit-friction friction.csv scene.toml --format json {prior}");
        serde_json::from_str::<Value>(&folder.done(line).stdout).expect("JSON")
    };
    let found = fit("");
    assert_eq!(found["prior"], "covariance", "{found}");
    let fast = &found["fit"]["findings"][1];
    let spread = number(&fast["estimate"], "error") / 2e6;
    assert!((0.15..0.25).contains(&spread), "{fast}");
    let free = fit("--prior none");
    assert_eq!(free["prior"], "none", "{free}");
    assert!(free["fit"]["findings"][1]["estimate"].is_null(), "{free}");
    let said = folder
        .done("fit-friction friction.csv scene.toml --prior 0.1")
        .stdout;
    let expected = "known before: the moduli of the scene, each to 10 %";
    assert!(said.contains(expected), "{said}");
    // Friction of another material.
    folder.write("scene.toml", rubber("5e6", COVARIANCE));
    let said = folder.done("fit-friction friction.csv scene.toml").stdout;
    let expected = "friction and prior contradict each other";
    assert!(said.contains(expected), "{said}");
}

/// Accuracy of scenes with a shear strength.
const ELEMENTS: &str = "elements = 512\n";

/// A cylinder on a solid, with a shear strength of the contact.
fn dry_cylinder(interface: &str, solve: &str) -> String {
    format!(
        "[indenter.cylinder]\nradius = 5e-3\n[load]\nnormal_force = 100.0\nvelocity = 1.0\n[material.kelvin-voigt]\n\
         shear_modulus = 1e6\nviscosity = 1e3\n{interface}[solve]\n{solve}"
    )
}

#[test]
fn a_shear_strength_is_written_for_scenes() {
    let folder = Folder::new("dry-friction");
    let constant = |strength: &str| format!("[interface.constant]\nshear_strength = {strength}\n");
    folder.write("true.toml", dry_cylinder(&constant("3e4"), ELEMENTS));
    folder.done("sweep true.toml --vary load.velocity=1e-3:1e-1:3:log --out true.csv");
    let table = folder.text("true.csv");
    let [speeds, friction] = ["load.velocity", "friction_coefficient"].map(|column| {
        let mut names = table.lines().next().unwrap_or_default().split(',');
        let place = names.position(|name| name == column);
        folder.column("true.csv", place.expect("a column"))
    });
    let rows = speeds.iter().zip(&friction);
    let rows = rows.map(|(v, mu)| format!("{v},{mu},{}\n", 0.02 * mu));
    let rows = rows.collect::<String>();
    folder.write("dry.csv", format!("v (m/s),mu,standard error\n{rows}"));
    folder.write("dry.toml", dry_cylinder(&constant("1e5"), ""));
    let printed = folder
        .done("fit-friction dry.csv dry.toml --out out")
        .stdout;
    for expected in [
        "interface.constant.shear_strength",
        "known before: the moduli of the scene",
    ] {
        assert!(printed.contains(expected), "no {expected} in {printed}");
    }
    let found = folder.column("out/findings.csv", 2);
    assert_close("shear strength", found[0], 3e4, 5e-3);
    // The answer of the scene with the written interface is the measured friction.
    let interface = folder.text("out/interface.toml");
    assert!(interface.starts_with("# dry.csv\n"), "{interface}");
    let again = dry_cylinder(&interface, ELEMENTS)
        .replace("velocity = 1.0", &format!("velocity = {}", speeds[1]));
    folder.write("again.toml", again);
    let computed = number(&folder.json("again.toml"), "friction_coefficient");
    assert_close("friction", computed, friction[1], 5e-3);
    // Moduli alone, with the shear strength of the scene.
    let printed = folder
        .done("fit-friction dry.csv true.toml --free moduli")
        .stdout;
    assert!(printed.contains("its shear strength is kept"), "{printed}");
    folder.write(
        "table.csv",
        "velocity_m_per_s,shear_strength_pa\n1e-3,3e4\n1e-1,3e4\n",
    );
    for (interface, options, expected) in [
        (constant("-3e4"), "", "interface.constant.shear_strength"),
        (
            "[interface.table]\nfile = \"table.csv\"\n".to_owned(),
            "",
            "a table has no parameters",
        ),
        (
            String::new(),
            "--free moduli,interface",
            "[interface.constant] or [interface.bell]",
        ),
        (constant("3e4"), "--free both", "invalid value 'both'"),
    ] {
        folder.write("wrong.toml", dry_cylinder(&interface, ""));
        folder.ends(
            &format!("fit-friction dry.csv wrong.toml {options}"),
            2,
            expected,
        );
    }
}

#[test]
fn scenes_whose_friction_is_not_fitted_say_what_to_do() {
    let folder = Folder::new("friction-of-a-road");
    folder.write("friction.csv", "v (m/s),mu\n1e-3,0.1\n1e-2,0.2\n0.1,0.1\n");
    for (scene, expected) in [
        (
            "IN/rough-road.toml",
            "take the moduli from fit-material, or fit them to the friction of a ball",
        ),
        (
            "IN/reciprocating.toml",
            "load.stroke: friction is fitted at constant speeds",
        ),
        (
            "IN/start-stop.toml",
            "load.motion: friction is fitted at constant speeds",
        ),
        (
            "IN/press-hold-pull-press.toml",
            "load.history: friction is fitted at constant speeds",
        ),
    ] {
        folder.ends(&format!("fit-friction friction.csv {scene}"), 2, expected);
    }
}
