//! Every malformed file that a command reads ends with status 2 and one line that names the file and the place in it, says
//! what is needed, and prints nothing else.

use std::fs;
use std::path::Path;

use crate::support::{argument, complaint, folder, npy, text};

/// A scene that is right, beside the numbers of its lines.
const SCENE: [&str; 13] = [
    /* 1 */ "[indenter.power]",
    /* 2 */ "coefficient = 0.5",
    /* 3 */ "exponent = 1.5",
    /* 4 */ "",
    /* 5 */ "[material.viscous]",
    /* 6 */ "viscosity = 1.0e4",
    /* 7 */ "",
    /* 8 */ "[load]",
    /* 9 */ "normal_force = 1.0",
    /* 10 */ "velocity = 0.01",
    /* 11 */ "",
    /* 12 */ "[solve]",
    /* 13 */ "relative_error = 1e-3",
];

/// Line that is replaced | by what | line that is named | what is said.
const ONE_LINE: &str = r#"
2 | coefficient = 1e400 | 2
2 | coefficient = 2020-01-01 | 2 | indenter.power.coefficient
2 | coefficient =  | 2
2 | coefficient 0.5 | 2
2 | coefficient = 0.5 0.6 | 2
3 | coefficient = 2.0 | 3 | duplicate key
3 | exponent = 1.5\nradius = 1.0 | 4 | indenter.power.radius: unknown field `radius`, expected `coefficient` or `exponent`
1 | [indenter.pwoer] | 1 | indenter.pwoer: unknown variant
1 | [indentor.power] | 1 | indentor: unknown field
1 | [indenter] | 1 | indenter: exactly one kind is needed, as in [indenter.kind], but there are 2: coefficient, exponent
1 | [indenter.power | 1
1 | indenter.power] | 1
1 | [indenter.sphere]\nradius = 1.0\n[indenter.power] | 1 | indenter: exactly one kind is needed
5 | [material.viscos] | 5 | material.viscos: unknown variant
5 | [materials.viscous] | 5 | materials: unknown field
6 | viscosity = 1.0e4\npoisson_ratio = 0.6 | 7 | material.viscous.poisson_ratio must be greater than -1 and at most 0.5, but is 0.6
6 | viscosity = 1.0e4\npoisson_ratio = -1 | 7 | material.viscous.poisson_ratio
6 | viscosity = 1.0e4\npoisson_ratio = nan | 7 | material.viscous.poisson_ratio
6 | shear_modulus = 1.0e4 | 6 | material.viscous.shear_modulus: unknown field
8 | [loads] | 8 | loads: unknown field
9 | normal_force = 0.0 | 9 | load.normal_force must be finite and greater than 0, but is 0
9 | normal_force = -1.0 | 9 | load.normal_force
9 | indentation_depth = -1.0 | 9 | load.indentation_depth must be finite and greater than 0, but is -1
9 | normal_force = 1.0\nindentation_depth = 1.0 | 10 | load.indentation_depth: either normal_force or indentation_depth
9 |  | 8 | load.normal_force: normal_force or indentation_depth is missing
10 | velocity = -0.01 | 10 | load.velocity must be finite and at least 0, but is -0.01
10 | velocity = nan | 10 | load.velocity must be finite and at least 0, but is NaN
10 | velocity = 0.0 | 10 | load.velocity: a velocity of 0 is pure indentation, which needs solve.duration
10 |  | 8 | load.velocity: missing field
10 | speed = 0.01 | 10 | load.speed: unknown field
12 | [solver] | 12 | solver: unknown field
12 | [[solve]] | 12 | solve: a table is needed, and not a value of type array
"#;

/// What stands in the table `[solve]` from line 13 on | line that is named | what is said.
const SOLVE: &str = r#"
relative_error = 0.0 | 13 | solve.relative_error must be greater than 0 and at most 0.1, but is 0
relative_error = 0.5 | 13 | solve.relative_error must be greater than 0 and at most 0.1, but is 0.5
relative_error = -1e-3 | 13 | solve.relative_error
relative_error = 1e-3\nelements = 32 | 14 | solve.elements: either relative_error or elements
elements = 7 | 13 | solve.elements must be from 8 to 100000, but is 7
elements = -8 | 13 | solve.elements
elements = 32.0 | 13 | solve.elements
threads = 0 | 13 | solve.threads must be from 1 to 1024, but is 0
duration = 1.0\nsliding_distance = 1.0 | 14 | solve.sliding_distance: either duration or sliding_distance
duration = -1.0 | 13 | solve.duration must be finite and greater than 0, but is -1
sliding_distance = 0.0 | 13 | solve.sliding_distance
method = "magic" | 13 | solve.method.magic: unknown variant `magic`, expected one of `analytic`
method = 1 | 13 | solve.method
model = "plane" | 13 | solve.model.plane: unknown variant
method = "analytic"\nelements = 32 | 13 | solve.method: analytic does not answer this scene: closed forms have no elements
method = "mdr-steady"\nsliding_distance = 1.0 | 13 | these do: mdr-transient
method = "bem-steady"\nmodel = "line" | 13 | these do: analytic, mdr-steady, mdr-transient
"#;

/// Another indenter or material | line that is named | what is said.
const TABLES: &str = r#"
[indenter.sphere]\ndiameter = 1 | 2 | indenter.sphere.diameter: unknown field
[indenter.flat_cone]\nradius = 1.0\nslope = 1 | 1 | indenter.flat_cone: unknown variant
[indenter.superposition]\nterms = [] | 2 | indenter.superposition.terms
[indenter.superposition]\nterms = [\n{ coefficient = 1.0, exponent = 1.0 },\n{ coefficient = 0.0, exponent = 2.0 },\n] | 4 | indenter.superposition.terms[1].coefficient must be finite and not 0, but is 0
[indenter.superposition]\nterms = [{ coefficient = 1.0 }] | 2 | missing field `exponent`
[indenter.table]\nfile = "is-not-there.csv" | 2 | is-not-there.csv
[indenter.cylinder]\nradius = 0.01 | 1 | no method answers this scene yet
[indenter.height-map]\nfile = "h.csv"\nspacing = 0 | 3 | indenter.height-map.spacing
[indenter.height-map]\nfile = "h.csv"\nspacing = [1, 0] | 3 | indenter.height-map.spacing[1] must be finite and greater than 0, but is 0
[indenter.height-map]\nfile = "h.csv"\nspacing = [1, 1, 1] | 3 | indenter.height-map.spacing
[indenter.height-map]\nfile = "is-not-there.csv"\nspacing = [1, 1] | 2 | is-not-there.csv
[indenter.height-map]\nfile = "h.csv" | 1 | indenter.height-map.spacing: missing field
[material.prony]\nequilibrium_modulus = 1e6\nbranches = [\n{ modulus = 1e6, relaxation_time = 1 },\n{ modulus = 1e6, relaxation_time = 0 },\n] | 5 | material.prony.branches[1].relaxation_time must be finite and greater than 0, but is 0
[material.prony]\nequilibrium_modulus = 0\nbranches = [] | 1 | material.prony: a material needs
"#;

/// Profile | line that is named | what is said.
const PROFILES: &str = r#"
 | 1 | radii must have at least 2 entries, but has 0
radius_m,height_m\n | 1 | radii must have at least 2 entries, but has 0
radius_m,height_m\n0,0\n | 2 | radii must have at least 2 entries, but has 1
0,0\n1,1\n2,2\n | 2 | unknown field `0`
radius,height\n0,0\n1,1\n | 2 | unknown field `radius`
radius_m\n0\n1\n | 2 | missing field `height_m`
radius_m,height_m,width_m\n0,0,0\n1,1,1\n | 2 | unknown field `width_m`
radius_m,height_m\n0,0\n1\n | 3 | 2 values are needed, but there are 1
radius_m,height_m\n0,0\n1,1,1\n | 3 | 2 values are needed, but there are 3
radius_m,height_m\n0,0\n1,one\n | 3 | height_m: invalid float literal
radius_m,height_m\n0,0\n,1\n | 3 | radius_m: cannot parse float from empty string
radius_m;height_m\n0;0\n1;1\n | 2 | unknown field `radius_m;height_m`
radius_m,height_m\n0,0\n1,nan\n | 3 | heights must be finite, but is NaN
radius_m,height_m\n0,0\n1,1\ninf,2\n | 4 | radii must be finite, but is inf
radius_m,height_m\n0,0\n2,1\n1,2\n | 4 | entry 2 is 1 after 2
radius_m,height_m\n0,0\n1,1\n1,2\n | 4 | entry 2 is 1 after 1
radius_m,height_m\n0.5,0\n1,1\n | 2 | first radius must be 0, but is 0.5
radius_m,height_m\n0,0.25\n1,1\n | 2 | first height must be 0, but is 0.25
radius_m,height_m\n0,0\n1,1\n\n2,-1\n | 5 | heights must be at least 0
radius_m,height_m\n0,0\n1,\xff\n | 3 | the text is no UTF-8
"#;

/// Height map | line that is named | what is said.
const MAPS: &str = r#"
 | 1 | rows of heights must have at least 2 entries, but has 0
1,0,1\n | 1 | rows of heights must have at least 2 entries, but has 1
1\n0\n1\n | 3 | columns of heights must have at least 2 entries, but has 1
a,b,c\n1,0,1\n | 1 | column 1: a finite height in m is needed, and not 'a'
1,1,1\n1,0,1\n1,1\n | 3 | 3 values are needed, but there are 2
1,1,1\n1,0,1\n1,1,1,1\n | 3 | 3 values are needed, but there are 4
1,1,1\n1,0,\n1,1,1\n | 2 | column 3: a finite height in m is needed, and not ''
1,1,1\n\n1,nan,1\n | 3 | column 2: a finite height in m is needed, and not 'nan'
1;1;1\n1;0;1\n1;1;1\n | 1 | column 1: a finite height in m is needed, and not '1;1;1'
1,1,1\n1,0,\xff\n | 2 | the text is no UTF-8
1,1,1\n1,-1e308,1\n1,1,1e308\n | 3 | height above the lowest must be finite
"#;

/// Header | length of the numbers | what is said.
const ARRAYS: &str = r#"
{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), } | 47 | 2 x 3 numbers of 8 bytes are needed, but there are 47 bytes
{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), } | 25 | 2 x 3 numbers of 4 bytes are needed, but there are 25 bytes
{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296), } | 0 | 4294967296 x 4294967296 numbers of 8 bytes are needed, but there are 0 bytes
{'descr': '<f8', 'fortran_order': False, 'shape': (6,), } | 48 | an array of 2 dimensions is needed, and not of 1
{'descr': '<f8', 'fortran_order': False, 'shape': (), } | 8 | an array of 2 dimensions is needed, and not of 0
{'descr': '>f8', 'fortran_order': False, 'shape': (2, 3), } | 48 | little-endian floats are needed, '<f8' or '<f4', and not '>f8'
{'descr': '<i8', 'fortran_order': False, 'shape': (2, 3), } | 48 | little-endian floats are needed, '<f8' or '<f4', and not '<i8'
{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (2, 3), } | 48 | little-endian floats are needed, '<f8' or '<f4', and not [('x'
{'descr': '<f8', 'fortran_order': False, } | 48 | the header does not say its shape
{'descr': '<f8', 'fortran_order': False, 'shape': (2, -3), } | 48 | the header does not say its shape
{'descr': '<f8', 'fortran_order': None, 'shape': (2, 3), } | 48 | the header does not say the order of its numbers
{'descr': '<f8', 'fortran_order': False, 'shape': (1, 6), } | 48 | rows of heights must have at least 2 entries, but has 1
"#;

/// Rows of a sweep | line that is named | what is said.
const ROWS: &str = r#"
a,1\n | 2 | no row of a sweep
a,one,2,0.5,\n | 2 | the number of its point is missing
a,0,2,0.5,\n | 2 | the number of its point is missing
a,-1,2,0.5,\n | 2 | the number of its point is missing
a,1,2,0.5,\na,1,2,0.7,\n | 3 | the row is of another sweep
a,1,2,0.5,\nb,2,2,0.7,\n | 3 | the row is of another sweep
"#;

/// Measured moduli | place in the file | what is said.
const MODULI: &str = r#"
f,E',E''\nHz,MPa,MPa\n2,10,1\n1,11,1\n | line 4, column 1 (f) | expected more than in the line before, 2, but found '1'
f,E',E''\nHz,MPa,MPa\n1,10,1\n1,11,1\n | line 4, column 1 (f) | expected more than in the line before, 1, but found '1'
f,E',E''\nHz,MPa,MPa\n1,10,1\n2,-11,1\n | line 4, column 2 (E') | expected a number greater than 0, but found '-11'
f,E',E''\nHz,MPa,MPa\n0,10,1\n2,11,1\n | line 3, column 1 (f) | expected a number greater than 0, but found '0'
f,E',E''\nHz,MPa,MPa\n1,10,nan\n2,11,1\n | line 3, column 3 (E'') | expected a finite number, but found 'nan'
f,E',E''\nHz,MPa,MPa\n1,10,1\n2,11\n | line 4, column 3 (E'') | expected a finite number, but found ''
f,E',E''\nHz,MPa,MPa\n1,ten,1\n2,11,1\n | line 3, column 2 (E') | expected a finite number, but found 'ten'
f,E',E''\n1,10,1\n2,11,1\n | line 2, column 1 (f) | expected the unit of f: Hz, mHz, kHz or rad/s, but found '1'
f,E',E''\nHz,MPa,psi\n1,10,1\n2,11,1\n | line 2, column 3 (E'') | expected the unit of E'': Pa, kPa, MPa or GPa, but found 'psi'
f,E''\nHz,MPa\n1,1\n2,1\n | line 1 | there must be a column E' or G'
f,E'\nHz,MPa\n1,1\n2,1\n | line 1 | there must be a column E'' or G''
E',E''\nMPa,MPa\n1,1\n2,1\n | line 1 | there must be a column f or ω
f,E',G''\nHz,MPa,MPa\n1,1,1\n2,1,1\n | line 1, column 3 (G'') | expected a loss modulus to go with E', but found 'G'''
f,E',E'',E'\nHz,MPa,MPa,MPa\n1,1,1,1\n2,1,1,1\n | line 1, column 4 (E') | expected a quantity once
f,E',E''\nHz,MPa,MPa\n1,10,1\n | line 3 | at least 2 measurements are needed after the lines of names and units, but there are 1
 | line 1 | a line of names and a line of units are needed
"#;
/// Tables of a scene, and keys of each that must be positive numbers.
const NUMBERS: &str = "
indenter.power | coefficient exponent
indenter.cone | slope
indenter.paraboloid | curvature
indenter.sphere | radius
indenter.flat-punch | radius
indenter.flat-cone | radius slope
indenter.round-tipped-cone | radius slope
indenter.hyperboloid | radius slope
indenter.truncated-paraboloid | radius curvature
indenter.cylinder | radius
material.viscous | viscosity
material.elastic | shear_modulus
material.kelvin-voigt | shear_modulus viscosity
material.maxwell | shear_modulus viscosity
material.standard-solid | equilibrium_modulus maxwell_modulus viscosity
";

/// What stands in the place of such a number | what is said about it.
const NO_NUMBERS: &str = r#"
0 |  must be finite and greater than 0, but is 0
-1 |  must be finite and greater than 0, but is -1
nan |  must be finite and greater than 0, but is NaN
inf |  must be finite and greater than 0, but is inf
-inf |  must be finite and greater than 0, but is -inf
"one" | : invalid type: string
false | : invalid type: boolean
[0.5] | : invalid type: sequence
"#;

/// Tables of scenes that are right, by their letters.
const RIGHT: [(char, &str); 7] = [
    (
        'h',
        "[indenter.height-map]\nfile = \"map.csv\"\nspacing = [1e-3, 1e-3]\n",
    ),
    ('y', "[indenter.cylinder]\nradius = 0.1\n"),
    ('p', "[indenter.paraboloid]\ncurvature = 50\n"),
    (
        's',
        "[material.standard-solid]\nequilibrium_modulus = 1e5\nmaxwell_modulus = 1e6\nviscosity = 1e3\n",
    ),
    ('v', "[material.viscous]\nviscosity = 1e4\n"),
    ('F', "[load]\nnormal_force = 1.0\nvelocity = 0.01\n"),
    ('D', "[load]\nindentation_depth = 1e-4\nvelocity = 0.01\n"),
];

/// Tables and `[solve]` of scenes that no method, or not this one, answers | line that is named | what is said.
const UNANSWERED: &str = r#"
hvF method = "mdr-steady" | 10 | a height map is none; boundary elements take it; no other method does either
hvF model = "line" | 1 | no method answers this scene yet
pvD method = "bem-steady" | 9 | a depth belongs to a distance; give solve.sliding_distance
psD method = "bem-transient" | 11 | at a depth it marches over a distance; give solve.sliding_distance
ysD relative_error = 1e-2 | 1 | a line contact has no depth
yvF relative_error = 1e-2 | 1 | a half space that flows sinks the faster
ysF model = "line" | 1 | the one-dimensional model is for bodies of revolution
ysF method = "bem-transient" | 11 | its elements end, and a cylinder does not; analytic presses it, and bem-steady slides it; these do: bem-steady
ysF method = "mdr-steady" | 11 | a cylinder is none; no other method does either
"#;

/// Contents of a file, the place in it that is named, and what is said.
type Case = (Vec<u8>, String, String);

/// The rows of a table, each of three cells, the last of which may be left out.
fn rows(table: &str) -> impl Iterator<Item = [String; 3]> {
    table.trim_matches('\n').lines().map(|line| {
        let mut cells = line.splitn(3, " | ").map(|cell| cell.replace("\\n", "\n"));
        [(); 3].map(|()| cells.next().unwrap_or_default())
    })
}

fn contents(cell: &str) -> Vec<u8> {
    match cell.strip_suffix("\\xff\n") {
        Some(start) => [start.as_bytes(), b"\xff\n"].concat(),
        None => cell.into(),
    }
}

/// The cases of a table of contents, places and what is said.
fn cases(table: &str, place: impl Fn(&str) -> String) -> Vec<Case> {
    let case = |[text, at, needed]: [String; 3]| (contents(&text), place(&at), needed);
    rows(table).map(case).collect()
}

/// Runs the command on every one of the contents of the file.
fn assert_refused(file: &Path, arguments: &[&str], cases: Vec<Case>) {
    let mut wrong = Vec::new();
    for (contents, place, needed) in cases {
        fs::write(file, &contents).expect("a file");
        let complaint = complaint(arguments, &place, &needed);
        wrong.extend(complaint.map(|complaint| format!("{}\n--- {complaint}", text(&contents))));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// The scene with some lines replaced.
fn scene(replaced: &[(usize, &str)]) -> String {
    let mut lines = SCENE;
    for (line, text) in replaced {
        lines[line - 1] = text;
    }
    lines.join("\n")
}

fn scenes() -> Vec<(String, String, String)> {
    let mut scenes = Vec::new();
    for [line, replacement, rest] in rows(ONE_LINE) {
        let (named, needed) = rest.split_once(" | ").unwrap_or((&rest, ""));
        let line = line.parse().expect("a line");
        scenes.push((
            scene(&[(line, &replacement)]),
            named.to_owned(),
            needed.to_owned(),
        ));
    }
    for [solve, named, needed] in rows(SOLVE) {
        scenes.push((scene(&[(13, &solve)]), named, needed));
    }
    for [table, named, needed] in rows(TABLES) {
        scenes.push((with_table(&table), named, needed));
    }
    for [letters, named, needed] in rows(UNANSWERED) {
        let (letters, solve) = letters.split_once(' ').expect("letters");
        let table = |letter| {
            RIGHT
                .iter()
                .find(|table| table.0 == letter)
                .map(|table| table.1)
        };
        let tables: String = letters.chars().filter_map(table).collect();
        scenes.push((format!("{tables}[solve]\n{solve}\n"), named, needed));
    }
    let at_depth = scene(&[(9, "indentation_depth = 1.0e-3"), (13, "elements = 32")]);
    for (scene, line, needed) in [
        (at_depth, "1", "no method answers this scene yet"),
        (
            with_table("[indenter]\ncone = [0.1]"),
            "2",
            "indenter.cone[0]: a table is needed",
        ),
        (
            with_table("[indenter.superposition]\nterms = [[1.0, 2.0]]"),
            "2",
            "indenter.superposition.terms[0]: a table is needed",
        ),
        (String::new(), "1", "indenter: missing field"),
        (SCENE[..6].join("\n"), "1", "load: missing field"),
        ("\u{0}".to_owned(), "1", ""),
    ] {
        scenes.push((scene, line.to_owned(), needed.to_owned()));
    }
    scenes
}

/// The scene with another indenter or material, which comes first.
fn with_table(table: &str) -> String {
    let other = if table.starts_with("[indenter") {
        &SCENE[4..6]
    } else {
        &SCENE[..3]
    };
    [table, &other.join("\n"), &SCENE[7..].join("\n")].join("\n")
}

/// Every number that must be positive, replaced by all that is none, misspelt and left out.
fn numbers() -> Vec<(String, String, String)> {
    let mut scenes = Vec::new();
    for [table, keys, _] in rows(NUMBERS) {
        let keys: Vec<&str> = keys.split(' ').collect();
        for (index, key) in keys.iter().enumerate() {
            let scene = |line: &str| {
                let mut lines: Vec<String> =
                    keys.iter().map(|key| format!("{key} = 0.5")).collect();
                line.clone_into(&mut lines[index]);
                with_table(&format!("[{table}]\n{}", lines.join("\n")))
            };
            let line = (index + 2).to_string();
            for [value, why, _] in rows(NO_NUMBERS) {
                let needed = format!("{table}.{key}{why}");
                scenes.push((scene(&format!("{key} = {value}")), line.clone(), needed));
            }
            let unknown = format!("{table}.{key}s: unknown field `{key}s`");
            scenes.push((scene(&format!("{key}s = 0.5")), line, unknown));
            let missing = format!("{table}.{key}: missing field `{key}`");
            scenes.push((scene(""), "1".to_owned(), missing));
        }
    }
    scenes
}

#[test]
fn a_malformed_scene_is_refused_with_line_and_key() {
    let path = folder("malformed").join("scene.toml");
    fs::write(path.with_file_name("map.csv"), "1,1,1\n1,0,1\n1,1,1\n").expect("a map");
    let scenes = [scenes(), numbers()].concat();
    assert!(scenes.len() >= 280, "only {} scenes", scenes.len());
    let case = |(scene, line, needed): (String, String, String)| {
        (scene.into(), format!("{}:{line}", path.display()), needed)
    };
    let arguments = ["run", argument(&path)];
    assert_refused(&path, &arguments, scenes.into_iter().map(case).collect());
    fs::write(&path, scene(&[])).expect("a scene");
    assert!(complaint(&arguments, "", "").is_some_and(|right| right.contains("exit status: 0")));
}

/// A scene with a file beside it, and where it names that.
fn naming(body: &str, file: &str) -> (std::path::PathBuf, std::path::PathBuf, String) {
    let folder = folder(&format!("malformed-{file}"));
    let [scene, path] = ["scene.toml", file].map(|name| folder.join(name));
    let spacing = if body == "height-map" {
        "spacing = [1, 1]\n"
    } else {
        ""
    };
    let rest = "[material.viscous]\nviscosity = 1e4\n[load]\nnormal_force = 1\nvelocity = 1\n";
    let text = format!("[indenter.{body}]\nfile = \"{file}\"\n{spacing}{rest}");
    fs::write(&scene, text).expect("a scene");
    let place = format!(
        "{}:2: indenter.{body}.file: {}",
        scene.display(),
        path.display()
    );
    (scene, path, place)
}

#[test]
fn a_malformed_table_of_a_scene_is_refused_with_both_lines() {
    for (body, file, table) in [
        ("table", "profile.csv", PROFILES),
        ("height-map", "map.csv", MAPS),
    ] {
        let (scene, path, place) = naming(body, file);
        let cases = cases(table, |line| format!("{place}:{line}"));
        assert_refused(&path, &["run", argument(&scene)], cases);
    }
    let (scene, path, _) = naming("height-map", "edge.csv");
    fs::write(path, "0,1\n1,1\n").expect("a map");
    let place = format!("{}:2", scene.display());
    let complaint = complaint(&["run", argument(&scene)], &place, "on the edge of the map");
    assert_eq!(complaint, None, "a map that is lowest at its edge");
}

#[test]
fn a_malformed_array_of_heights_is_refused_with_its_file() {
    let (scene, map, place) = naming("height-map", "map.NPY");
    let whole = npy(
        "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }",
        &[],
    );
    let heights = [1.0, 1.0, 0.0, 1.0, 1.0, f64::NAN].map(f64::to_le_bytes);
    let no_array = "an array of NumPy in the format 1.0";
    let mut cases: Vec<Case> = [
        (Vec::new(), no_array),
        (b"1,0\n0,1\n".to_vec(), no_array),
        (whole[..9].to_vec(), no_array),
        (
            whole[..60].to_vec(),
            "the header ends after 128 bytes, but the file has 60",
        ),
        (
            [whole, heights.concat()].concat(),
            "[2, 1]: a finite height in m is needed, and not NaN",
        ),
    ]
    .map(|(array, needed)| (array, place.clone(), needed.to_owned()))
    .into();
    cases.extend(rows(ARRAYS).map(|[header, length, needed]| {
        let numbers = vec![0; length.parse().expect("a length")];
        (npy(&header, &numbers), place.clone(), needed)
    }));
    assert_refused(&map, &["run", argument(&scene)], cases);
}

#[test]
fn malformed_rows_and_moduli_are_refused_with_their_line_and_leave_nothing() {
    let folder = folder("malformed-rows");
    let [rows, moduli, out] = ["rows.csv", "moduli.csv", "out"].map(|name| folder.join(name));
    let header = "sweep,point,points,load.velocity,failure\n";
    let with_header =
        |(row, place, needed): Case| ([header.as_bytes(), &row].concat(), place, needed);
    let wrong = cases(ROWS, |line| format!("{}:{line}", rows.display()));
    let arguments = ["sweep", "--out", argument(&out), "--merge", argument(&rows)];
    assert_refused(
        &rows,
        &arguments,
        wrong.into_iter().map(with_header).collect(),
    );
    let wrong = cases(MODULI, |place| format!("{}, {place}", moduli.display()));
    let arguments = ["fit-material", argument(&moduli), "--out", argument(&out)];
    assert_refused(&moduli, &arguments, wrong);
    assert!(!out.exists(), "something was written from wrong files");
}
