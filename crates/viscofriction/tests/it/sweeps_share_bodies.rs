//! Points of a sweep share bodies and materials: files are read once, and a row is that of its scene alone.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use viscofriction::scene::Source;
use viscofriction::sweep::{Plan, SweepRow, Vary};
use viscofriction::{ReadFile, WrongInput};

use crate::sensitivities_of_more_scenes::bumps;

/// Number of times that each file was read.
static READ: Mutex<BTreeMap<PathBuf, usize>> = Mutex::new(BTreeMap::new());

/// A material for names in toml, heights for all others; the first letter distinguishes two of them.
fn file(path: &Path, most: u64) -> Result<Vec<u8>, WrongInput> {
    let name = path.display().to_string();
    let is_other = name.starts_with('b');
    if name.ends_with("toml") {
        let modulus = if is_other { 3e6 } else { 1e6 };
        let law = "maxwell_modulus = 9e6, viscosity = 9e4";
        let text =
            format!("material.standard-solid = {{ equilibrium_modulus = {modulus:e}, {law} }}\n");
        return Ok(text.into_bytes());
    }
    let heights = String::from_utf8(bumps(path, most)?).expect("a text");
    // Rows in the opposite order are another surface.
    let lines: Vec<&str> = heights.lines().collect();
    let lines: Vec<&str> = if is_other {
        lines.into_iter().rev().collect()
    } else {
        lines
    };
    Ok(lines.join("\n").into_bytes())
}

/// Counts the readings of [`file`].
fn counted(path: &Path, most: u64) -> Result<Vec<u8>, WrongInput> {
    let mut read = READ.lock().expect("counts");
    *read.entry(path.to_owned()).or_default() += 1;
    file(path, most)
}

/// A sweep of a rough surface over several keys.
fn sweep(vary: &[&str], read: ReadFile) -> Plan {
    let text = "
indenter.height-map = { file = \"a.csv\", unit = \"um\", spacing = [1e-4, 1e-4], edges = \"periodic\", shortest_wavelength = 6e-4 }
material.file = { path = \"a.toml\" }
load = { mean_pressure = 4e4, velocity = 0.02 }
solve = { elements = 192 }
";
    let source = Source::new(Path::new("scene.toml"), text.into()).expect("a text");
    let vary = vary.iter().map(|vary| vary.parse().expect("a key"));
    Plan::new(source, &vary.collect::<Vec<Vary>>(), read).expect("a sweep")
}

const KEYS: [&str; 3] = [
    "indenter.height-map.file=a.csv,b.csv",
    "load.velocity=0.02,0.03",
    "material.file.path=a.toml,b.toml",
];

#[test]
fn a_row_is_that_of_its_scene_alone() {
    let all: Vec<usize> = (0..8).collect();
    let plan = sweep(&KEYS, counted);
    plan.validate(&all).expect("valid points");
    let rows = Mutex::new(Vec::new());
    plan.solve_all(&all, |row| {
        rows.lock().expect("rows").push(row.expect("a row"));
        ControlFlow::Continue(())
    });
    let mut rows: Vec<SweepRow> = rows.into_inner().expect("rows");
    rows.sort_by_key(|row| row.point);
    // Once for the fingerprint and once for the body or the material.
    let read = READ.lock().expect("counts").clone();
    let expected = ["a.csv", "a.toml", "b.csv", "b.toml"].map(|name| (PathBuf::from(name), 2));
    assert_eq!(read, BTreeMap::from(expected), "times that files were read");
    for (point, row) in rows.iter().enumerate().rev() {
        let alone = sweep(&KEYS, file).solve(point).expect("a row");
        assert_eq!(*row, alone, "row and row alone of point {point}");
    }
    let frictions: Vec<&String> = rows.iter().map(|row| &row.fields[10]).collect();
    let mut distinct = frictions.clone();
    distinct.sort();
    distinct.dedup();
    assert_eq!(distinct.len(), 8, "{frictions:?} are those of all points");
}

/// A body that one limit allows is refused by a smaller one of the same sweep.
#[test]
fn memory_limits_hold_for_shared_bodies() {
    let plan = sweep(&["solve.max_memory=1 GiB,5 kB"], file);
    plan.validate(&[0]).expect("enough memory");
    let refused = plan.validate(&[0, 1]).expect_err("too little memory");
    assert!(refused.to_string().contains("(point 2: "), "{refused}");
}

/// A shard does not depend on points of other shards.
#[test]
fn a_shard_validates_its_own_points() {
    let plan = sweep(&["indenter.height-map.direction=0,45"], file);
    plan.validate(&[0]).expect("a valid point");
    let refused = plan.validate(&[1]).expect_err("a wrong direction");
    assert!(refused.to_string().contains("direction"), "{refused}");
}
