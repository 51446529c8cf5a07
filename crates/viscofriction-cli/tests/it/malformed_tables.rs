//! Every malformed table that a scene or a sweep reads ends with status 2 and one line that names file and line.

use std::fs;

use crate::support::{argument, complaint, folder, npy};

const SCENE: &str = "[indenter.table]\nfile = \"profile.csv\"\n[material.viscous]\nviscosity = 1e4\n\
                     [load]\nnormal_force = 1\nvelocity = 1\n";

/// Profiles, the line that is named, and what is said.
const PROFILES: [(&[u8], usize, &str); 20] = [
    (b"", 1, "radii must have at least 2 entries, but has 0"),
    (
        b"radius_m,height_m\n",
        1,
        "radii must have at least 2 entries, but has 0",
    ),
    (
        b"radius_m,height_m\n0,0\n",
        2,
        "radii must have at least 2 entries, but has 1",
    ),
    (b"0,0\n1,1\n2,2\n", 2, "unknown field `0`"),
    (b"radius,height\n0,0\n1,1\n", 2, "unknown field `radius`"),
    (b"radius_m\n0\n1\n", 2, "missing field `height_m`"),
    (
        b"radius_m,height_m,width_m\n0,0,0\n1,1,1\n",
        2,
        "unknown field `width_m`",
    ),
    (
        b"radius_m,height_m\n0,0\n1\n",
        3,
        "2 values are needed, but there are 1",
    ),
    (
        b"radius_m,height_m\n0,0\n1,1,1\n",
        3,
        "2 values are needed, but there are 3",
    ),
    (
        b"radius_m,height_m\n0,0\n1,one\n",
        3,
        "height_m: invalid float literal",
    ),
    (
        b"radius_m,height_m\n0,0\n,1\n",
        3,
        "radius_m: cannot parse float from empty string",
    ),
    (
        b"radius_m;height_m\n0;0\n1;1\n",
        2,
        "unknown field `radius_m;height_m`",
    ),
    (
        b"radius_m,height_m\n0,0\n1,nan\n",
        3,
        "heights must be finite, but is NaN",
    ),
    (
        b"radius_m,height_m\n0,0\n1,1\ninf,2\n",
        4,
        "radii must be finite, but is inf",
    ),
    (
        b"radius_m,height_m\n0,0\n2,1\n1,2\n",
        4,
        "entry 2 is 1 after 2",
    ),
    (
        b"radius_m,height_m\n0,0\n1,1\n1,2\n",
        4,
        "entry 2 is 1 after 1",
    ),
    (
        b"radius_m,height_m\n0.5,0\n1,1\n",
        2,
        "first radius must be 0, but is 0.5",
    ),
    (
        b"radius_m,height_m\n0,0.25\n1,1\n",
        2,
        "first height must be 0, but is 0.25",
    ),
    (
        b"radius_m,height_m\n0,0\n1,1\n\n2,-1\n",
        5,
        "heights must be at least 0",
    ),
    (
        b"radius_m,height_m\n0,0\n1,\xff\n",
        3,
        "the text is no UTF-8",
    ),
];

const MAP_SCENE: &str = "[indenter.height-map]\nfile = \"map.csv\"\nspacing = [1, 1]\n\
                         [material.viscous]\nviscosity = 1e4\n[load]\nnormal_force = 1\nvelocity = 1\n";

/// Height maps, the line that is named, and what is said.
const MAPS: [(&[u8], usize, &str); 11] = [
    (
        b"",
        1,
        "rows of heights must have at least 2 entries, but has 0",
    ),
    (
        b"1,0,1\n",
        1,
        "rows of heights must have at least 2 entries, but has 1",
    ),
    (
        b"1\n0\n1\n",
        3,
        "columns of heights must have at least 2 entries, but has 1",
    ),
    (
        b"a,b,c\n1,0,1\n",
        1,
        "column 1: a finite height in m is needed, and not 'a'",
    ),
    (
        b"1,1,1\n1,0,1\n1,1\n",
        3,
        "3 values are needed, but there are 2",
    ),
    (
        b"1,1,1\n1,0,1\n1,1,1,1\n",
        3,
        "3 values are needed, but there are 4",
    ),
    (
        b"1,1,1\n1,0,\n1,1,1\n",
        2,
        "column 3: a finite height in m is needed, and not ''",
    ),
    (
        b"1,1,1\n\n1,nan,1\n",
        3,
        "column 2: a finite height in m is needed, and not 'nan'",
    ),
    (
        b"1;1;1\n1;0;1\n1;1;1\n",
        1,
        "column 1: a finite height in m is needed, and not '1;1;1'",
    ),
    (b"1,1,1\n1,0,\xff\n", 2, "the text is no UTF-8"),
    (
        b"1,1,1\n1,-1e308,1\n1,1,1e308\n",
        3,
        "height above the lowest must be finite",
    ),
];

/// Headers and lengths of the numbers of NPY files, and what is said.
const ARRAYS: [(&str, usize, &str); 12] = [
    (
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }",
        47,
        "2 x 3 numbers of 8 bytes are needed, but there are 47 bytes",
    ),
    (
        "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }",
        25,
        "2 x 3 numbers of 4 bytes are needed, but there are 25 bytes",
    ),
    (
        "{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296), }",
        0,
        "4294967296 x 4294967296 numbers of 8 bytes are needed, but there are 0 bytes",
    ),
    (
        "{'descr': '<f8', 'fortran_order': False, 'shape': (6,), }",
        48,
        "an array of 2 dimensions is needed, and not of 1",
    ),
    (
        "{'descr': '<f8', 'fortran_order': False, 'shape': (), }",
        8,
        "an array of 2 dimensions is needed, and not of 0",
    ),
    (
        "{'descr': '>f8', 'fortran_order': False, 'shape': (2, 3), }",
        48,
        "little-endian floats are needed, '<f8' or '<f4', and not '>f8'",
    ),
    (
        "{'descr': '<i8', 'fortran_order': False, 'shape': (2, 3), }",
        48,
        "little-endian floats are needed, '<f8' or '<f4', and not '<i8'",
    ),
    (
        "{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (2, 3), }",
        48,
        "little-endian floats are needed, '<f8' or '<f4', and not [('x'",
    ),
    (
        "{'descr': '<f8', 'fortran_order': False, }",
        48,
        "the header does not say its shape",
    ),
    (
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, -3), }",
        48,
        "the header does not say its shape",
    ),
    (
        "{'descr': '<f8', 'fortran_order': None, 'shape': (2, 3), }",
        48,
        "the header does not say the order of its numbers",
    ),
    (
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 6), }",
        48,
        "rows of heights must have at least 2 entries, but has 1",
    ),
];

const HEADER: &str = "sweep,point,points,load.velocity,failure\n";

/// Rows of a sweep, the line that is named, and what is said.
const ROWS: [(&str, usize, &str); 6] = [
    ("a,1\n", 2, "no row of a sweep"),
    ("a,one,2,0.5,\n", 2, "the number of its point is missing"),
    ("a,0,2,0.5,\n", 2, "the number of its point is missing"),
    ("a,-1,2,0.5,\n", 2, "the number of its point is missing"),
    ("a,1,2,0.5,\na,1,2,0.7,\n", 3, "the row is of another sweep"),
    ("a,1,2,0.5,\nb,2,2,0.7,\n", 3, "the row is of another sweep"),
];

#[test]
fn every_malformed_profile_names_scene_and_line_and_the_line_of_the_table() {
    let folder = folder("malformed-profiles");
    let [scene, table] = ["scene.toml", "profile.csv"].map(|name| folder.join(name));
    fs::write(&scene, SCENE).expect("a scene");
    let mut wrong = Vec::new();
    for (profile, line, needed) in PROFILES {
        fs::write(&table, profile).expect("a table");
        let place = format!(
            "{}:2: indenter.table.file: {}:{line}",
            scene.display(),
            table.display()
        );
        let complaint = complaint(&["run", argument(&scene)], &place, needed);
        let profile = String::from_utf8_lossy(profile);
        wrong.extend(complaint.map(|complaint| format!("{profile}--- {complaint}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn every_malformed_height_map_names_scene_and_line_and_the_line_of_the_map() {
    let folder = folder("malformed-maps");
    let [scene, map] = ["scene.toml", "map.csv"].map(|name| folder.join(name));
    fs::write(&scene, MAP_SCENE).expect("a scene");
    let mut wrong = Vec::new();
    for (heights, line, needed) in MAPS {
        fs::write(&map, heights).expect("a map");
        let place = format!(
            "{}:2: indenter.height-map.file: {}:{line}",
            scene.display(),
            map.display()
        );
        let complaint = complaint(&["run", argument(&scene)], &place, needed);
        let heights = String::from_utf8_lossy(heights);
        wrong.extend(complaint.map(|complaint| format!("{heights}--- {complaint}")));
    }
    fs::write(&map, "0,1\n1,1\n").expect("a map");
    let place = format!("{}:2", scene.display());
    wrong.extend(complaint(
        &["run", argument(&scene)],
        &place,
        "on the edge of the map",
    ));
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn every_malformed_array_of_heights_names_scene_and_line_and_the_array() {
    let folder = folder("malformed-arrays");
    let [scene, map] = ["scene.toml", "map.NPY"].map(|name| folder.join(name));
    fs::write(&scene, MAP_SCENE.replace("map.csv", "map.NPY")).expect("a scene");
    let place = format!(
        "{}:2: indenter.height-map.file: {}",
        scene.display(),
        map.display()
    );
    let whole = npy(
        "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }",
        &[],
    );
    let mut nan = whole.clone();
    nan.extend(
        [1.0, 1.0, 0.0, 1.0, 1.0, f64::NAN]
            .map(f64::to_le_bytes)
            .concat(),
    );
    let mut files: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "an array of NumPy in the format 1.0"),
        (
            b"1,0\n0,1\n".to_vec(),
            "an array of NumPy in the format 1.0",
        ),
        (whole[..9].to_vec(), "an array of NumPy in the format 1.0"),
        (
            whole[..60].to_vec(),
            "the header ends after 128 bytes, but the file has 60",
        ),
        (nan, "[2, 1]: a finite height in m is needed, and not NaN"),
    ];
    files.extend(ARRAYS.map(|(header, length, needed)| (npy(header, &vec![0; length]), needed)));
    let mut wrong = Vec::new();
    for (array, needed) in files {
        fs::write(&map, &array).expect("a map");
        let complaint = complaint(&["run", argument(&scene)], &place, needed);
        let array = String::from_utf8_lossy(&array);
        wrong.extend(complaint.map(|complaint| format!("{array}--- {complaint}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn every_malformed_file_of_rows_names_its_line() {
    let folder = folder("malformed-rows");
    let [rows, out] = ["rows.csv", "out.csv"].map(|name| folder.join(name));
    let mut wrong = Vec::new();
    for (lines, line, needed) in ROWS {
        fs::write(&rows, format!("{HEADER}{lines}")).expect("a file");
        let place = format!("{}:{line}", rows.display());
        let arguments = ["sweep", "--out", argument(&out), "--merge", argument(&rows)];
        let complaint = complaint(&arguments, &place, needed);
        wrong.extend(complaint.map(|complaint| format!("{lines}--- {complaint}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    assert!(!out.exists(), "a file was written from wrong ones");
}
