//! Scenes of layers.

use crate::support::{Folder, assert_close, number};

const BELT: &str = "[material.standard-solid]
equilibrium_modulus = 0.25
maxwell_modulus = 2.25
viscosity = 2.25
";
const CYLINDER: &str = "[indenter.cylinder]
radius = 1.0
[load]
velocity = 0.01
normal_force = 0.02
";
const PRESSED: &str = "[indenter.sphere]
radius = 1.0
[solve]
duration = 1.0
[load]
velocity = 0.0
";

fn write(folder: &Folder, body_and_load: &str, material: &str, thickness: &str) {
    let layer = format!("[layer]\nthickness = {thickness}\n");
    let scene = format!("{body_and_load}\n{BELT}{material}{layer}");
    folder.write("scene.toml", scene);
}

/// The Winkler foundation is the one-dimensional model at the force
/// `winkler_line_force` and of the paraboloid whose equivalent line is the profile of the cylinder.
#[test]
fn a_cylinder_slides_on_a_thin_layer_as_on_springs() {
    let folder = Folder::new("layers");
    let compressible = "poisson_ratio = 0.3\n";
    write(&folder, CYLINDER, compressible, "0.001");
    let thin = folder.json("scene.toml");
    let printed = folder.done("run scene.toml").stdout;
    assert!(printed.contains("layer of 0.001"), "{printed}");
    let line = "[indenter.paraboloid]\ncurvature = 0.25\n[solve]\nmodel = \"line\"\n[load]\nvelocity = 0.01\nnormal_force = ";
    let force = 0.02 * 0.4 * 0.001 / 0.49;
    let winkler = format!("{line}{force}\n{BELT}{compressible}");
    folder.write("winkler.toml", winkler);
    let winkler = folder.json("winkler.toml");
    let [thin, winkler] = [thin, winkler].map(|result| number(&result, "friction_coefficient"));
    assert_close("friction", thin, winkler, 0.02);
}

#[test]
fn what_knows_no_layer_says_so() {
    let folder = Folder::new("layers-refused");
    write(&folder, CYLINDER, "", "1e-9");
    folder.ends("run scene.toml", 1, "at least 1/32 of the edge");
    let [shallow, deep] =
        ["0.01", "0.04"].map(|depth| format!("{PRESSED}indentation_depth = {depth}"));
    write(&folder, &shallow, "", "0.1");
    for method in ["analytic", "mdr-transient"] {
        let line = format!("run scene.toml --method {method}");
        folder.ends(&line, 2, "it knows no layer");
    }
    let warnings = &folder.json("scene.toml")["warnings"];
    assert_eq!(warnings.to_string(), "[]", "of a shallow contact");
    write(&folder, &deep, "", "0.1");
    let warnings = folder.json("scene.toml")["warnings"].to_string();
    let warned = warnings.contains("more than a third of the thickness");
    assert!(warned, "{warnings}");
}
