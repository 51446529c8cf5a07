//! Friction of a ball on a rubber with a Prony series, on the half space, with its error bar.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use viscofriction::{Problem, Scene, solve};

const SCENE: &str = r#"
    indenter.sphere = { radius = 5e-3 }

    [material.prony]
    equilibrium_modulus = 1e6
    branches = [
        { modulus = 1e7, relaxation_time = 1e-3 },
        { modulus = 3e6, relaxation_time = 1e-1 },
    ]

    [load]
    normal_force = 2.0
    velocity = 0.1
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene: Scene = SCENE.parse()?;
    let answer = solve(&Problem::try_from(&scene)?)?;
    println!("{}", serde_json::to_string_pretty(&answer)?);
    Ok(())
}
