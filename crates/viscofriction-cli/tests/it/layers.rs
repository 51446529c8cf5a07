//! Scenes of layers.

use crate::support::{Folder, assert_close, estimate, number};

const BELT: &str = "[material.standard-solid]
equilibrium_modulus = 0.25
maxwell_modulus = 2.25
viscosity = 2.25
";
const CYLINDER: &str = "[indenter.cylinder]
radius = 1.0
[load]
velocity = 0.01
normal_force = ";

fn scene(load: &str, material: &str, thickness: &str) -> String {
    format!("{load}\n{BELT}{material}[layer]\nthickness = {thickness}\n")
}

/// casebook-2.json, "line", and the Winkler foundation, which is the one-dimensional model at the force
/// `winkler_line_force` and of the paraboloid whose equivalent line is the profile of the cylinder.
#[test]
fn a_cylinder_slides_on_layers() {
    let folder = Folder::new("layers");
    folder.write("thick.toml", scene(&format!("{CYLINDER}0.02"), "", "0.1"));
    let thick = folder.json("thick.toml");
    let friction = estimate(&thick, "friction_coefficient");
    assert!(
        (friction.value - 0.038_570_761_236_354_46).abs() <= friction.error,
        "{friction:?}"
    );
    let depth = estimate(&thick, "indentation_depth");
    assert!(
        (depth.value - 0.003_948_654_133_675_425).abs() <= depth.error,
        "{depth:?}"
    );
    let compressible = "poisson_ratio = 0.3\n";
    folder.write(
        "thin.toml",
        scene(&format!("{CYLINDER}0.02"), compressible, "0.001"),
    );
    let line = "[indenter.paraboloid]\ncurvature = 0.25\n[solve]\nmodel = \"line\"\n[load]\nvelocity = 0.01\nnormal_force = ";
    let force = 0.02 * 0.4 * 0.001 / 0.49;
    folder.write(
        "winkler.toml",
        format!("{line}{force}\n{BELT}{compressible}"),
    );
    let [thin, winkler] = ["thin.toml", "winkler.toml"]
        .map(|file| number(&folder.json(file), "friction_coefficient"));
    assert_close("friction", thin, winkler, 0.02);
    assert!(
        folder
            .done("run thin.toml")
            .stdout
            .contains("layer of 0.001")
    );
}

#[test]
fn what_knows_no_layer_says_so() {
    let folder = Folder::new("layers-refused");
    for (thickness, needed) in [
        ("0.0", "layer.thickness must be finite and greater than 0"),
        ("-1.0", "greater than 0"),
        ("nan", "greater than 0"),
    ] {
        folder.write(
            "wrong.toml",
            scene(&format!("{CYLINDER}0.02"), "", thickness),
        );
        folder.ends("run wrong.toml", 2, needed);
    }
    folder.write("film.toml", scene(&format!("{CYLINDER}0.02"), "", "1e-9"));
    folder.ends("run film.toml", 1, "at least 1/32 of the edge");
    let pressed = "[indenter.sphere]\nradius = 1.0\n[solve]\nduration = 1.0\n[load]\nvelocity = 0.0\nindentation_depth = ";
    folder.write("press.toml", scene(&format!("{pressed}0.01"), "", "0.1"));
    for method in ["analytic", "mdr-transient"] {
        folder.ends(
            &format!("run press.toml --method {method}"),
            2,
            "it knows no layer",
        );
    }
    assert!(
        folder.json("press.toml")["warnings"]
            .as_array()
            .expect("a list")
            .is_empty()
    );
    folder.write("deep.toml", scene(&format!("{pressed}0.04"), "", "0.1"));
    let deep = folder.json("deep.toml")["warnings"].to_string();
    assert!(
        deep.contains("more than a third of the thickness"),
        "{deep}"
    );
}
