//! Tables of friction, and what the program makes of them.

use std::fs;

use crate::support::{Folder, assert_close};

/// A body and a material with a closed form in the one-dimensional model.
const SCENE: &str = "[indenter.paraboloid]\ncurvature = 100.0\n[material.kelvin-voigt]\nshear_modulus = 3e6\nviscosity = 2e3\n\
     [load]\nnormal_force = 1.0\n[solve]\nmodel = \"line\"\n";

/// Speeds and friction coefficients with 1 MPa and 10 kPa s.
fn points(folder: &Folder) -> Vec<[f64; 2]> {
    let truth = SCENE.replace("3e6", "1e6").replace("2e3", "1e4");
    folder.write(
        "true.toml",
        truth.replace("[solve]", "velocity = 1.0\n[solve]"),
    );
    folder.done("sweep true.toml --vary load.velocity=1e-3:1:8:log --out true.csv");
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
    let rows = points(&folder)
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
    let points = points(&folder);
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
        ("v,mu\n1e-3,0.1\n", "the unit of v: m/s, mm/s"),
        (
            "v (m/s),friction force (N)\n1,2\n",
            "there must be a column force",
        ),
        ("a,b\n1,2\n", "a line of names is needed: v and mu"),
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
