//! Scenes of layers.

use crate::support::{Folder, assert_close, number};

const CYLINDER: &str =
    "indenter.cylinder.radius = 1.0\nload = { velocity = 0.01, normal_force = 0.02 }\n";

/// A ball of 1 m that is held at a depth.
fn pressed(depth: f64) -> String {
    let load = format!("load = {{ velocity = 0.0, indentation_depth = {depth:?} }}");
    format!("indenter.sphere.radius = 1.0\nsolve.duration = 1.0\n{load}\n")
}

fn belt(poisson_ratio: f64) -> String {
    let moduli = "equilibrium_modulus = 0.25, maxwell_modulus = 2.25, viscosity = 2.25";
    format!("material.standard-solid = {{ {moduli}, poisson_ratio = {poisson_ratio:?} }}\n")
}

fn write(folder: &Folder, body_and_load: &str, poisson_ratio: f64, thickness: f64) {
    let layer = format!("layer.thickness = {thickness:?}\n");
    let scene = format!("{body_and_load}{}{layer}", belt(poisson_ratio));
    folder.write("scene.toml", scene);
}

/// The Winkler foundation is the one-dimensional model at the force
/// `winkler_line_force` and of the paraboloid whose equivalent line is the profile of the cylinder.
#[test]
fn a_cylinder_slides_on_a_thin_layer_as_on_springs() {
    let folder = Folder::new("layers");
    write(&folder, CYLINDER, 0.3, 0.001);
    let thin = folder.json("scene.toml");
    let force = 0.02 * 0.4 * 0.001 / 0.49;
    let load = format!("load = {{ velocity = 0.01, normal_force = {force:?} }}\n");
    let line = "indenter.paraboloid.curvature = 0.25\nsolve.model = \"line\"\n";
    folder.write("winkler.toml", [line, &load, &belt(0.3)].concat());
    let winkler = folder.json("winkler.toml");
    let [thin, winkler] = [thin, winkler].map(|result| number(&result, "friction_coefficient"));
    assert_close("friction", thin, winkler, 0.02);
}

#[test]
fn what_knows_no_layer_says_so() {
    let folder = Folder::new("layers-refused");
    write(&folder, CYLINDER, 0.5, 1e-9);
    folder.ends("scene.toml", 1, "at least 1/32 of the edge");
    write(&folder, &pressed(0.01), 0.5, 0.1);
    for method in ["analytic", "mdr-transient"] {
        let line = format!("scene.toml --method {method}");
        folder.ends(&line, 2, "it knows no layer");
    }
    let warnings = &folder.json("scene.toml")["warnings"];
    assert_eq!(warnings.to_string(), "[]", "of a shallow contact");
    write(&folder, &pressed(0.04), 0.5, 0.1);
    let warnings = folder.json("scene.toml")["warnings"].to_string();
    let warned = warnings.contains("more than a third of the thickness");
    assert!(warned, "{warnings}");
}
