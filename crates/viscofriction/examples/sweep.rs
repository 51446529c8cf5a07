//! Friction of a cone over six decades of speed: one row per point, as the program `viscofriction sweep` writes it.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::path::Path;

use viscofriction::WrongInput;
use viscofriction::scene::Source;
use viscofriction::sweep::{Plan, header};

const SCENE: &str = "
    indenter.cone = { slope = 0.1 }
    material.standard-solid = { equilibrium_modulus = 1e5, maxwell_modulus = 1e7, viscosity = 1e4 }
    load = { normal_force = 1.0, velocity = 1.0 }
    solve = { relative_error = 1e-2 }
";

fn main() -> Result<(), WrongInput> {
    let source = Source::new(Path::new("cone"), SCENE.as_bytes().to_vec())?;
    let no_files = |path: &Path, _| Err(WrongInput(format!("{} is not read", path.display())));
    let speeds = "load.velocity=1e-4:1e2:7:log".parse().map_err(WrongInput)?;
    let sweep = Plan::new(source, &[speeds], no_files)?;
    println!("{}", header(&sweep).join(","));
    for point in 0..sweep.n_points() {
        println!("{}", sweep.solve(point)?.fields.join(","));
    }
    Ok(())
}
