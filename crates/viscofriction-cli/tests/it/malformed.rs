//! Every malformed file that a command reads ends with status 2 and one line that names the file and the place in it, says
//! what is needed, and prints nothing else.

use crate::support::{Folder, npy, rows, scene};

/// A scene that is right.
const SCENE: &str = "\
[indenter.power]
coefficient = 0.5
exponent = 1.5

[material.viscous]
viscosity = 1.0e4

[load]
normal_force = 1.0
velocity = 0.01

[solve]
relative_error = 1e-3";

/// Lines that are replaced | by what | line that is named | what is said.
const SCENES: &str = r#"
2 | coefficient = 1e400 | 2
2 | coefficient = 2020-01-01 | 2 | indenter.power.coefficient
2 | coefficient =  | 2
3 | coefficient = 2.0 | 3 | duplicate key
3 | exponent = 1.5\nradius = 1.0 | 4 | indenter.power.radius: unknown field `radius`, expected `coefficient` or `exponent`
1 | [indenter.pwoer] | 1 | indenter.pwoer: unknown variant
1 | [indentor.power] | 1 | indentor: unknown field
1 | [indenter] | 1 | indenter: exactly one kind is needed, as in [indenter.kind], but there are 2: coefficient, exponent
1 | [indenter.power | 1
1 | [indenter.sphere]\nradius = 1.0\n[indenter.power] | 1 | indenter: exactly one kind is needed
6 | viscosity = 1.0e4\npoisson_ratio = 0.6 | 7 | material.viscous.poisson_ratio must be greater than -1 and at most 0.5, but is 0.6
6 | viscosity = 1.0e4\npoisson_ratio = -1 | 7 | material.viscous.poisson_ratio
9 | normal_force = 0.0 | 9 | load.normal_force must be finite and greater than 0, but is 0
9 | indentation_depth = -1.0 | 9 | load.indentation_depth must be finite and greater than 0, but is -1
9 | normal_force = 1.0\nindentation_depth = 1.0 | 10 | load.indentation_depth: either normal_force or indentation_depth
9 | mean_pressure = 1.0 | 9 | load.mean_pressure: only a periodic surface has a mean pressure
9 |  | 8 | load.normal_force: normal_force or indentation_depth is missing
10 | velocity = -0.01 | 10 | load.velocity must be finite and at least 0, but is -0.01
10 | velocity = nan | 10 | load.velocity must be finite and at least 0, but is NaN
10 | velocity = 0.0 | 10 | load.velocity: a velocity of 0 is pure indentation, which needs solve.duration
10 |  | 8 | load.velocity: missing field
10 | speed = 0.01 | 10 | load.speed: unknown field
9-10 | history = [{ time = 0, indentation_depth = 0 }] | 9 | load.history: at least two points are needed
9-10 | history = [\n{ time = 0, indentation_depth = 0 },\n{ time = -1, indentation_depth = 0 },\n] | 11 | load.history[1].time must be finite, at least 0, and not before the time of the point before, but is -1
9-10 | history = [\n{ time = 0, indentation_depth = 0 },\n{ time = nan, indentation_depth = 0 },\n] | 11 | load.history[1].time must be finite
9-10 | history = [\n{ time = 0, normal_force = 0 },\n{ time = 1, normal_force = -1 },\n] | 11 | load.history[1].normal_force must be finite and at least 0, but is -1
9-10 | history = [\n{ time = 0, normal_force = 0 },\n{ time = 1, indentation_depth = 1 },\n] | 11 | load.history[1]: all points have a force, or all a depth
9-10 | history = [\n{ time = 0, normal_force = 0, indentation_depth = 0 },\n{ time = 1, normal_force = 1 },\n] | 10 | load.history[0]: either normal_force or indentation_depth is needed
9 | history = [{ time = 0, normal_force = 0 }, { time = 1, normal_force = 1 }] | 10 | load.velocity: a history says how the body moves
10 | history = [{ time = 0, normal_force = 0 }, { time = 1, normal_force = 1 }] | 9 | load.normal_force: a history says how the body moves
9-13 | history = [{ time = 0, normal_force = 0 }, { time = 1, normal_force = 1 }]\n[solve]\nduration = 1.0 | 11 | solve.duration: a history ends with its last point
9-10 | history_file = "is-not-there.csv" | 9 | is-not-there.csv
9-10 | history_file = "is-not-there.csv"\nhistory = [] | 9 | load.history_file: either history or history_file
12 | [[solve]] | 12 | solve: a table is needed, and not a value of type array
13 | relative_error = 0.0 | 13 | solve.relative_error must be greater than 0 and at most 0.1, but is 0
13 | relative_error = 0.5 | 13 | solve.relative_error must be greater than 0 and at most 0.1, but is 0.5
13 | relative_error = 1e-3\nelements = 32 | 14 | solve.elements: either relative_error or elements
13 | elements = 7 | 13 | solve.elements must be from 8 to 100000, but is 7
13 | elements = -8 | 13 | solve.elements
13 | elements = 32.0 | 13 | solve.elements
13 | threads = 0 | 13 | solve.threads must be from 1 to 1024, but is 0
13 | max_memory = 8 | 13 | solve.max_memory
13 | max_memory = "8 GiX" | 13 | solve.max_memory: a positive number with one of the units B, kB
13 | max_memory = "-1 GiB" | 13 | solve.max_memory: a positive number with one of the units B, kB
13 | method = "bem-steady"\nelements = 100000 | 14 | solve.elements: bem-steady needs up to
13 | method = "bem-steady"\nelements = 4800\nmax_memory = "9 GiB" | 14 | of memory for 4800 elements along the contact, and max_memory allows 9.0 GiB; give fewer elements or a larger max_memory
13 | method = "bem-steady"\nmax_memory = "10 kB" | 14 | solve.max_memory: bem-steady needs up to
13 | method = "bem-transient"\nelements = 32\nmax_memory = "1e6B" | 14 | give fewer elements, a shorter sliding_distance or a larger max_memory
13 | method = "mdr-transient"\nelements = 100000\nmax_memory = "0.1 GB" | 14 | solve.elements: mdr-transient needs up to
13 | duration = 1.0\nsliding_distance = 1.0 | 14 | solve.sliding_distance: either duration or sliding_distance
13 | duration = -1.0 | 13 | solve.duration must be finite and greater than 0, but is -1
13 | sliding_distance = 0.0 | 13 | solve.sliding_distance
13 | method = "magic" | 13 | solve.method.magic: unknown variant `magic`, expected one of `analytic`
13 | method = 1 | 13 | solve.method
13 | model = "plane" | 13 | solve.model.plane: unknown variant
13 | method = "analytic"\nelements = 32 | 13 | solve.method: analytic does not answer this scene: closed forms have no elements
13 | method = "mdr-steady"\nsliding_distance = 1.0 | 13 | these do: mdr-transient
13 | method = "bem-steady"\nmodel = "line" | 13 | these do: analytic, mdr-steady, mdr-transient
13 | [layer]\nthickness = 0.0 | 14 | layer.thickness must be finite and greater than 0, but is 0
13 | [layer]\nthickness = nan | 14 | layer.thickness must be finite and greater than 0, but is NaN
1-3 | [indenter.superposition]\nterms = [] | 2 | indenter.superposition.terms
1-3 | [indenter.superposition]\nterms = [\n{ coefficient = 1.0, exponent = 1.0 },\n{ coefficient = 0.0, exponent = 2.0 },\n] | 4 | indenter.superposition.terms[1].coefficient must be finite and not 0, but is 0
1-3 | [indenter.superposition]\nterms = [{ coefficient = 1.0 }] | 2 | missing field `exponent`
1-3 | [indenter.table]\nfile = "is-not-there.csv" | 2 | is-not-there.csv
1-3 | [indenter.cylinder]\nradius = 0.01 | 1 | no method answers this scene yet
1-3 | [indenter.height-map]\nfile = "h.csv"\nspacing = 0 | 3 | indenter.height-map.spacing
1-3 | [indenter.height-map]\nfile = "h.csv"\nspacing = [1, 0] | 3 | indenter.height-map.spacing[1] must be finite and greater than 0, but is 0
1-3 | [indenter.height-map]\nfile = "h.csv"\nspacing = [1, 1, 1] | 3 | indenter.height-map.spacing
1-3 | [indenter.height-map]\nfile = "is-not-there.csv"\nspacing = [1, 1] | 2 | is-not-there.csv
1-3 | [indenter.height-map]\nfile = "h.csv" | 1 | indenter.height-map.spacing: missing field
5-6 | [material.prony]\nequilibrium_modulus = 1e6\nbranches = [\n{ modulus = 1e6, relaxation_time = 1 },\n{ modulus = 1e6, relaxation_time = 0 },\n] | 9 | material.prony.branches[1].relaxation_time must be finite and greater than 0, but is 0
5-6 | [material.prony]\nequilibrium_modulus = 0\nbranches = [] | 5 | material.prony: a material needs
1-3 | [indenter]\ncone = [0.1] | 2 | indenter.cone[0]: a table is needed
1-3 | [indenter.superposition]\nterms = [[1.0, 2.0]] | 2 | indenter.superposition.terms[0]: a table is needed
9-13 | indentation_depth = 1.0e-3\nvelocity = 0.01\n[solve]\nelements = 32 | 1 | no method answers this scene yet
1-13 |  | 1 | indenter: missing field
7-13 |  | 1 | load: missing field
1-13 | \0 | 1
"#;

/// Profile | line that is named | what is said.
const PROFILES: &str = r#"
 | 1 | radii must have at least 2 entries, but has 0
radius_m,height_m\n | 1 | radii must have at least 2 entries, but has 0
radius_m,height_m\n0,0\n | 2 | radii must have at least 2 entries, but has 1
0,0\n1,1\n2,2\n | 2 | unknown field `0`
radius_m\n0\n1\n | 2 | missing field `height_m`
radius_m,height_m,width_m\n0,0,0\n1,1,1\n | 2 | unknown field `width_m`
radius_m,height_m\n0,0\n1\n | 3 | 2 values are needed, but there are 1
radius_m,height_m\n0,0\n1,one\n | 3 | height_m: invalid float literal
radius_m,height_m\n0,0\n,1\n | 3 | radius_m: cannot parse float from empty string
radius_m;height_m\n0;0\n1;1\n | 2 | unknown field `radius_m;height_m`
"radius\nm",height_m\n0,0\n1,1\n | 3 | unknown field `radius m`
radius_m,height_m\n0,0\n1,nan\n | 3 | heights must be finite, but is NaN
radius_m,height_m\n0,0\n1,1\ninf,2\n | 4 | radii must be finite, but is inf
radius_m,height_m\n0,0\n2,1\n1,2\n | 4 | entry 2 is 1 after 2
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
1,1,1\n1,0,\n1,1,1\n | 2 | column 3: a finite height in m is needed, and not ''
1,1,1\n\n1,nan,1\n | 3 | column 2: a finite height in m is needed, and not 'nan'
1;1;1\n1;0;1\n1;1;1\n | 1 | column 1: a finite height in m is needed, and not '1;1;1'
1,1,1\n1,0,\xff\n | 2 | the text is no UTF-8
1,1,1\n1,-1e308,1\n1,1,1e308\n | 3 | height above the lowest must be finite
"#;

/// Height map that is lowest at its edge | line of the scene | what is said.
const EDGE: &str = r"0,1\n1,1\n | 2 | on the edge of the map";

/// Header | length of the numbers | what is said.
const ARRAYS: &str = r#"
{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), } | 47 | 2 x 3 numbers of 8 bytes are needed, but there are 47 bytes
{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), } | 25 | 2 x 3 numbers of 4 bytes are needed, but there are 25 bytes
{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296), } | 0 | 4294967296 x 4294967296 numbers of 8 bytes are needed, but there are 0 bytes
{'descr': '<f8', 'fortran_order': False, 'shape': (6,), } | 48 | an array of 2 dimensions is needed, and not of 1
{'descr': '>f8', 'fortran_order': False, 'shape': (2, 3), } | 48 | little-endian floats are needed, '<f8' or '<f4', and not '>f8'
{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (2, 3), } | 48 | little-endian floats are needed, '<f8' or '<f4', and not [('x'
{'descr': '<f8', 'fortran_order': False, } | 48 | the header does not say its shape
{'descr': '<f8', 'fortran_order': False, 'shape': (2, -3), } | 48 | the header does not say its shape
{'descr': '<f8', 'fortran_order': None, 'shape': (2, 3), } | 48 | the header does not say the order of its numbers
{'descr': '<f8', 'fortran_order': False, 'shape': (1, 6), } | 48 | rows of heights must have at least 2 entries, but has 1
"#;

/// Rows of a sweep | line that is named | what is said.
const ROWS: &str = r#"
a,1\n | 2 | no row of a sweep
a,0,2,0.5,\n | 2 | the number of its point is missing
a,-1,2,0.5,\n | 2 | the number of its point is missing
a,1,2,0.5,\na,1,2,0.7,\n | 3 | the row is of another sweep
a,1,2,0.5,\nb,2,2,0.7,\n | 3 | the row is of another sweep
"#;

/// Measured moduli | place in the file | what is said.
const MODULI: &str = r#"
f,E',E''\nHz,MPa,MPa\n1,10,1\n1,11,1\n | line 4, column 1 (f) | expected a value that no row before has at this temperature, but found '1'
f,E',E''\nHz,MPa,MPa\n1,10,1\n2,-11,1\n | line 4, column 2 (E') | expected a number greater than 0, but found '-11'
f,E',E''\nHz,MPa,MPa\n0,10,1\n2,11,1\n | line 3, column 1 (f) | expected a number greater than 0, but found '0'
f,E',E''\nHz,MPa,MPa\n1,10,nan\n2,11,1\n | line 3, column 3 (E'') | expected a finite number, but found 'nan'
f,E',E''\nHz,MPa,MPa\n1,10,1\n2,11\n | line 4, column 3 (E'') | expected a finite number, but found ''
f,E',E''\nHz,MPa,MPa\n1,ten,1\n2,11,1\n | line 3, column 2 (E') | expected a finite number, but found 'ten'
f,E',E''\n1,10,1\n2,11,1\n | line 2, column 1 (f) | expected the unit of f: Hz, mHz, kHz, rad/s, 1/s, but found '1'
f,E',E''\nHz,MPa,psi\n1,10,1\n2,11,1\n | line 2, column 3 (E'') | expected the unit of E'': Pa, kPa, MPa, GPa, but found 'psi'
f,E''\nHz,MPa\n1,1\n2,1\n | line 1 | there must be a column E' or G'
f,E'\nHz,MPa\n1,1\n2,1\n | line 1 | there must be a column E'' or G''
E',E''\nMPa,MPa\n1,1\n2,1\n | line 1 | there must be a column f or ω
f,E',G''\nHz,MPa,MPa\n1,1,1\n2,1,1\n | line 1, column 3 (G'') | expected a loss modulus to go with E', but found 'G'''
f,E',E'',E'\nHz,MPa,MPa,MPa\n1,1,1,1\n2,1,1,1\n | line 1, column 4 (E') | expected a quantity once
f,E',E'',G'\nHz,MPa,MPa,MPa\n1,1,1,1\n2,1,1,1\n | line 1, column 4 (G') | expected a quantity once, in tension (E) or in shear (G)
t,E_relax,T\ns,MPa,C\n1,10,20\n2,9,20\n1,8,40\n | line 5 | relaxation at several temperatures is not shifted
f,E',E''\nHz,MPa,MPa\n1,10,1\n | line 3 | at least 2 measurements are needed after the names and units, but there are 1
f;E2;T\nHz;MPa;C\n1,5;2,5;20\n2,5;3;20\n | line 1 | a line of names is needed: f or ω with two of E'
f;E2;T\nHz;MPa;C\n1,5;2,5;20\n2,5;3;20\n | line 1 | separated by semicolons, the columns are 'f', 'E2', 'T'
f;E' (MPa)\nHz;MPa\n1,5;2,5\n2,5;3\n | line 1 | separated by semicolons, the columns are 'f', 'E' (MPa)'
f (Hz),G' (psi),G'' (Pa)\n1,10,1\n2,11,1\n | line 1, column 2 (G' (psi)) | expected the unit of G' (psi): Pa, kPa, MPa, GPa, but found 'psi'
# f [Hz];Storage modulus [Pa];Loss modulus [Pa]\n1;10;1\n2;11;1\n | line 1, column 2 (Storage modulus [Pa]) | or else the option deformation
f (Hz);G' (Pa);tan delta\n1,5;2;0,1\n2.5;2;0,1\n2,5;2;0,1\n | line 3, column 1 (f (Hz)) | expected a finite number, but found '2.5'
 | line 1 | a line of names is needed
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

/// Body, material, load and solution that no method, or not this one, answers | line that is named | what is said.
const UNANSWERED: &str = r#"
map; viscous; normal_force = 1.0, velocity = 0.01; method = "mdr-steady" | 2 | a height map is none; boundary elements take it; no other method does either
map; viscous; normal_force = 1.0, velocity = 0.01; model = "line" | 3 | no method answers this scene yet
paraboloid; viscous; indentation_depth = 1e-4, velocity = 0.01; method = "bem-steady" | 2 | a depth belongs to a distance; give solve.sliding_distance
paraboloid; solid; indentation_depth = 1e-4, velocity = 0.01; method = "bem-transient" | 2 | at a depth it marches over a distance; give solve.sliding_distance
cylinder; solid; indentation_depth = 1e-4, velocity = 0.01; relative_error = 1e-2 | 3 | a line contact has no depth
cylinder; viscous; normal_force = 1.0, velocity = 0.01; relative_error = 1e-2 | 3 | a half space that flows sinks the faster
cylinder; solid; normal_force = 1.0, velocity = 0.01; model = "line" | 3 | the one-dimensional model is for bodies of revolution
cylinder; solid; normal_force = 1.0, velocity = 0.01; method = "bem-transient" | 2 | its elements end, and a cylinder or a periodic surface does not; these do: bem-steady
cylinder; solid; normal_force = 1.0, velocity = 0.01; method = "mdr-steady" | 2 | a cylinder is none; no other method does either
"#;

/// Body, material, load and solution that are not reached | what is said, with the keys to change.
const UNREACHED: &str = r#"
map; solid; normal_force = 1.0, velocity = 0.01; relative_error = 1e-3 | are allowed; give solve.elements, fewer where they are given, or a shorter
map; viscous; normal_force = 10.0, velocity = 0.01; elements = 8 | at least 3 are needed; give more solve.elements, or a smaller solve.relative_error
paraboloid; prony; normal_force = 1.0, velocity = 1.0; method = "bem-transient", elements = 16 | long; give solve.method = "bem-steady", or solve.sliding_distance
cylinder; solid; normal_force = 1.0, velocity = 0.01; relative_error = 1e-7 | give a larger solve.relative_error, or another solve.method
paraboloid; viscous; normal_force = 1.0, velocity = 0.01; method = "mdr-transient", elements = 8, sliding_distance = 1e-9 | give fewer solve.elements, or a longer solve.sliding_distance
paraboloid; maxwell; normal_force = 1.0, velocity = 0.05; method = "mdr-transient", relative_error = 1e-5, max_memory = "10 MB" | another solve.method; solve.max_memory: mdr-transient needs up to 11.9 MiB of memory for 256 elements along the contact, and max_memory allows 9.5 MiB
cone; solid; normal_force = 1.0, velocity = 1.0; method = "bem-steady", relative_error = 2e-5, max_memory = "16 MB" | another solve.method; solve.max_memory: bem-steady needs up to 17.0 MiB of memory for 29 elements
"#;

/// Contents of a file, the place in it that is named, and what is said.
type Case = (Vec<u8>, String, String);

/// The cases of a table of contents, places and what is said.
fn cases(table: &str, place: impl Fn(&str) -> String) -> Vec<Case> {
    let contents = |cell: String| match cell.strip_suffix("\\xff\n") {
        Some(start) => [start.as_bytes(), b"\xff\n"].concat(),
        None => cell.into(),
    };
    rows(table)
        .map(|[text, at, needed]| (contents(text), place(&at), needed))
        .collect()
}

/// Runs the command on every one of the contents of the file: it ends with status 2, prints nothing, and says one line
/// that begins with the place.
fn assert_refused(folder: &Folder, file: &str, line: &str, cases: Vec<Case>) {
    let mut wrong = Vec::new();
    for (contents, place, needed) in cases {
        folder.write(file, &contents);
        let said = folder.run(line);
        let message = &said.stderr;
        let helpful =
            message.starts_with(&format!("error: {place}: ")) && message.contains(&needed);
        let brief = message.trim_end().lines().count() == 1 && said.stdout.is_empty();
        if said.status != Some(2) || !helpful || !brief {
            let contents = String::from_utf8_lossy(&contents);
            wrong.push(format!(
                "{contents}\n--- needs {place:?} and {needed:?}, but {said:?}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// The scene with some lines replaced, `from-to` or a single one, counted from 1.
fn replaced(lines: &str, text: &str) -> String {
    let (first, last) = lines.split_once('-').unwrap_or((lines, lines));
    let [first, last] = [first, last].map(|line| line.parse::<usize>().expect("a line"));
    let scene: Vec<&str> = SCENE.lines().collect();
    let parts = [&scene[..first - 1], &[text], &scene[last..]];
    parts.concat().join("\n")
}

/// Every number that must be positive, replaced by all that is none, misspelt and left out.
fn numbers() -> Vec<Case> {
    let mut cases = Vec::new();
    for [table, keys] in rows(NUMBERS) {
        let is_body = table.starts_with("indenter");
        let (place, first) = if is_body { ("1-3", 1) } else { ("5-6", 5) };
        let keys: Vec<&str> = keys.split(' ').collect();
        for (index, key) in keys.iter().enumerate() {
            let wrong = rows(NO_NUMBERS).map(|[value, why]| (format!("{key} = {value}"), why));
            let unknown = (
                format!("{key}s = 0.5"),
                format!("s: unknown field `{key}s`"),
            );
            let missing = (String::new(), format!(": missing field `{key}`"));
            for (line, why) in wrong.chain([unknown, missing]) {
                // A key that is missing is missing in its table.
                let named = if line.is_empty() { 0 } else { 1 + index };
                let right = |key: &&str| format!("{key} = 0.5");
                let mut lines: Vec<String> = keys.iter().map(right).collect();
                lines[index] = line;
                let scene = replaced(place, &format!("[{table}]\n{}", lines.join("\n")));
                let named = format!("scene.toml:{}", first + named);
                cases.push((scene.into(), named, format!("{table}.{key}{why}")));
            }
        }
    }
    cases
}

#[test]
fn a_malformed_scene_is_refused_with_line_and_key() {
    let folder = Folder::new("malformed");
    folder.write("map.csv", "1,1,1\n1,0,1\n1,1,1\n");
    let mut cases = numbers();
    let place = |line: &str| format!("scene.toml:{line}");
    cases.extend(rows(SCENES).map(|[lines, text, named, needed]| {
        let scene = replaced(&lines, &text.replace("\\0", "\0"));
        (scene.into(), place(&named), needed)
    }));
    let unanswered = rows(UNANSWERED).map(|[parts, line, needed]| (scene(&parts), line, needed));
    cases.extend(unanswered.map(|(scene, line, needed)| (scene.into(), place(&line), needed)));
    assert!(cases.len() >= 280, "only {} scenes", cases.len());
    assert_refused(&folder, "scene.toml", "run scene.toml", cases);
    folder.write("scene.toml", SCENE);
    folder.done("run scene.toml");
}

#[test]
fn what_is_not_reached_says_which_keys_to_change() {
    let folder = Folder::new("unreached");
    folder.write("map.csv", "1,1,1\n1,0,1\n1,1,1\n");
    for [parts, needed] in rows(UNREACHED) {
        folder.write("scene.toml", scene(&parts));
        let said = folder.ends("run scene.toml", 1, &needed);
        assert_eq!(said.stderr.lines().count(), 1, "{parts}: {said:?}");
    }
}

/// A folder with a scene that names a file, and the beginning of what is said about that.
fn naming(body: &str, file: &str) -> (Folder, String) {
    let folder = Folder::new(&format!("malformed-{file}"));
    let spacing = ["", "spacing = [1, 1]"][usize::from(body == "height-map")];
    let table = format!("[indenter.{body}]\nfile = \"{file}\"\n{spacing}");
    folder.write("scene.toml", replaced("1-3", &table));
    let place = format!("scene.toml:2: indenter.{body}.file: {file}");
    (folder, place)
}

#[test]
fn a_malformed_table_of_a_scene_is_refused_with_both_lines() {
    let (folder, place) = naming("table", "profile.csv");
    let wrong = cases(PROFILES, |line| format!("{place}:{line}"));
    assert_refused(&folder, "profile.csv", "run scene.toml", wrong);
    let (folder, place) = naming("height-map", "map.csv");
    let mut wrong = cases(MAPS, |line| format!("{place}:{line}"));
    wrong.extend(cases(EDGE, |line| format!("scene.toml:{line}")));
    assert_refused(&folder, "map.csv", "run scene.toml", wrong);
}

/// Contents of the file of a material | the line that is named | what is said.
const MATERIALS: &str = r#"
 | 1 | missing field `material`
[material] | 1 | exactly one kind is needed
[material.steel] | 1 | unknown variant `steel`
[material.viscous]\nviscosity = -1 | 2 | material.viscous.viscosity must be finite and greater than 0, but is -1
[material.viscous]\nviscosity = 1\n[load] | 3 | load: unknown field `load`
[material.file]\npath = "other.toml" | 2 | other.toml: the file of a material names no other
[material.viscous | 1 | unclosed table
\xff\n | 1 | the text is no UTF-8
"#;

#[test]
fn a_malformed_file_of_a_material_is_refused_with_both_lines() {
    let folder = Folder::new("malformed-material");
    let scene = replaced("5-6", "[material.file]\npath = \"rubber.toml\"");
    folder.write("scene.toml", &scene);
    let place = "scene.toml:6: material.file.path: rubber.toml";
    let wrong = cases(MATERIALS, |line| format!("{place}:{line}"));
    assert_refused(&folder, "rubber.toml", "run scene.toml", wrong);
    folder.write("rubber.toml", "[material.viscous]\nviscosity = 1\n");
    folder.done("run scene.toml");
    let outside = scene.replace("rubber.toml\"", "rubber.toml\"\npoisson_ratio = 0.6");
    let place = "scene.toml:7: material.file.poisson_ratio must be";
    folder.write("scene.toml", outside);
    folder.ends("run scene.toml", 2, place);
}

#[test]
fn a_malformed_array_of_heights_is_refused_with_its_file() {
    let (folder, place) = naming("height-map", "map.NPY");
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }";
    let whole = npy(header, &[]);
    let heights = [1.0, 1.0, 0.0, 1.0, 1.0, f64::NAN].map(f64::to_le_bytes);
    let no_array = "an array of NumPy in the format 1.0";
    let short = "the header ends after 128 bytes, but the file has 60";
    let infinite = "[2, 1]: a finite height in m is needed, and not NaN";
    let mut cases: Vec<Case> = [
        (Vec::new(), no_array),
        (b"1,0\n0,1\n".to_vec(), no_array),
        (whole[..9].to_vec(), no_array),
        (whole[..60].to_vec(), short),
        (npy(header, &heights.concat()), infinite),
    ]
    .map(|(array, needed)| (array, place.clone(), needed.to_owned()))
    .into();
    cases.extend(rows(ARRAYS).map(|[header, length, needed]| {
        let numbers = vec![0; length.parse().expect("a length")];
        (npy(&header, &numbers), place.clone(), needed)
    }));
    assert_refused(&folder, "map.NPY", "run scene.toml", cases);
}

#[test]
fn malformed_rows_and_moduli_are_refused_with_their_line_and_leave_nothing() {
    let folder = Folder::new("malformed-rows");
    let mut wrong = cases(ROWS, |line| format!("rows.csv:{line}"));
    for (rows, ..) in &mut wrong {
        rows.splice(0..0, *b"sweep,point,points,load.velocity,failure\n");
    }
    let merge = "sweep --out out --merge rows.csv";
    assert_refused(&folder, "rows.csv", merge, wrong);
    let wrong = cases(MODULI, |place| format!("moduli.csv, {place}"));
    let fit = "fit-material moduli.csv --out out";
    assert_refused(&folder, "moduli.csv", fit, wrong);
    let left = folder.names("").join(" ");
    assert_eq!(left, "moduli.csv rows.csv", "left of wrong files");
}
