//! What the pictures of the commands show.

use crate::support::{Folder, repository};

/// Numbers of points of the lines of a drawing.
fn points_of_lines(svg: &str) -> Vec<usize> {
    let lines = svg.split("<polyline points=\"").skip(1);
    let points = lines.filter_map(|line| line.split('"').next());
    points.map(|points| points.split(' ').count()).collect()
}

/// A drawing followed by the labels that have symbols, each in one piece.
fn plain(svg: &str) -> String {
    let labels = svg.split("aria-label=\"").skip(1);
    let labels = labels.filter_map(|label| label.split('"').next());
    let labels = labels.map(|label| format!(">{label}<"));
    svg.to_owned() + &labels.collect::<String>()
}

/// A scene with a measured road and its mirror images.
fn road() -> String {
    let map = repository().join("examples/data/road.x3p");
    format!(
        "[indenter.height-map]\nfile = {map:?}\nlevel = true\nedges = \"mirrored\"\nshortest_wavelength = 6.4e-4\n\
         [material.standard-solid]\nequilibrium_modulus = 1e6\nmaxwell_modulus = 1e7\nviscosity = 1e4\n\
         [load]\nmean_pressure = 3e5\nvelocity = 1.0\n[solve]\nrelative_error = 0.05\n"
    )
}

#[test]
fn a_history_is_a_curve_through_its_points_with_its_direction() {
    let folder = Folder::new("picture-of-history");
    folder.done("run IN/press-hold-pull-press.toml --out out");
    for (file, heads) in [("history", 4), ("history_over_time", 0)] {
        let svg = folder.text(&format!("out/{file}.svg"));
        let curves = points_of_lines(&svg);
        assert!(
            curves.iter().any(|points| *points > 100),
            "{file} has lines of {curves:?} points"
        );
        assert_eq!(svg.matches("<circle").count(), 5, "given points of {file}");
        let got = svg.matches("fill=\"#0072b2\" stroke=\"none\"").count();
        assert_eq!(got, heads, "arrowheads of {file}");
    }
}

#[test]
fn the_loop_of_a_motion_shows_its_direction() {
    let folder = Folder::new("picture-of-motion");
    folder.done("run IN/reciprocating.toml --out out");
    let svg = folder.text("out/motion.svg");
    let heads = svg.matches("fill=\"#0072b2\" stroke=\"none\"").count();
    assert_eq!(heads, 4, "arrowheads in {svg}");
    assert!(plain(&svg).contains(">tangential force F_t [mN]<"), "{svg}");
}

#[test]
fn a_map_of_the_pressure_has_the_lowest_point_of_the_body_and_its_motion() {
    let folder = Folder::new("picture-of-pressure");
    folder.done("run IN/sphere-standard-solid.toml --out ball");
    let svg = folder.text("ball/pressure.svg");
    let cross = svg.matches("stroke=\"#d55e00\"").count();
    assert_eq!(cross, 2, "strokes of the cross in {svg}");
    assert!(plain(&svg).contains(">pressure P [MPa]<"), "{svg}");
    folder.write("road.toml", road());
    folder.done("run road.toml --out road");
    let svg = plain(&folder.text("road/pressure.svg"));
    for text in [
        ">motion →; one of four mirror images<",
        ">pressure P, darkest: 1 % of load [MPa]<",
        // The map has 5.12 mm.
        ">5<",
    ] {
        assert!(svg.contains(text), "no {text} in {svg}");
    }
    assert!(!svg.contains(">6<"), "more than the map in {svg}");
}

/// A ridge touches with a contact that is much longer than wide: true proportions have no room for labels.
#[test]
fn a_narrow_contact_is_drawn_to_different_scales() {
    let folder = Folder::new("picture-of-ridge");
    let row = |column: i32| format!("{:e}", -6e-6 * f64::from((column - 31).abs()));
    let line = (0..64).map(row).collect::<Vec<String>>().join(",");
    folder.write("ridge.csv", format!("{line}\n").repeat(64));
    folder.write(
        "scene.toml",
        "[indenter.height-map]\nfile = \"ridge.csv\"\nspacing = [6e-5, 6e-5]\n\
         [material.standard-solid]\nequilibrium_modulus = 1e6\nmaxwell_modulus = 1e7\nviscosity = 1e4\n\
         [load]\nnormal_force = 0.3\nvelocity = 1.0\n[solve]\nelements = 24\n",
    );
    folder.done("run scene.toml --out out");
    let svg = folder.text("out/pressure.svg");
    assert!(svg.contains("x and y to different scales"), "{svg}");
}

#[test]
fn cut_offs_and_spectra_show_their_limits() {
    let folder = Folder::new("picture-of-limits");
    let scene = road();
    folder.write("road.toml", &scene);
    folder.done("road road.toml --cut-offs 2 --out cut-off.csv");
    let svg = folder.text("cut-off.svg");
    for text in ["theory, Persson (2006)", "theory, Xu and others (2024)"] {
        assert!(svg.contains(text), "no {text} in {svg}");
    }
    let map = repository().join("examples/data/road.x3p");
    folder.done(format!("surface {} --out surface", map.display()));
    let svg = plain(&folder.text("surface/surface.svg"));
    for text in [
        "self-affine, Hurst exponent 0.",
        ">4 points of the map<",
        ">wave number q = 2π/λ [1/m]<",
        ">yellow touches first; motion →<",
    ] {
        assert!(svg.contains(text), "no {text} in {svg}");
    }
}

#[test]
fn a_fit_of_friction_has_a_smooth_curve_and_bars() {
    let folder = Folder::new("picture-of-friction");
    let rows = crate::fit_friction::points(&folder, 8);
    let rows = rows
        .iter()
        .map(|[v, mu]| format!("{v},{mu},{}\n", 0.02 * mu));
    let table = format!("v (m/s),mu,standard error\n{}", rows.collect::<String>());
    folder.write("friction.csv", table);
    folder.write("scene.toml", crate::fit_friction::SCENE);
    folder.done("fit-friction friction.csv scene.toml --out out");
    let svg = folder.text("out/fit.svg");
    assert_eq!(points_of_lines(&svg), [40], "points of the curve");
    // A bar has a stroke and two caps, in both charts.
    let bars = svg
        .matches("stroke=\"#0072b2\" stroke-width=\"1.1\"")
        .count();
    assert_eq!(bars, 2 * 3 * 8, "strokes of error bars in {svg}");
}
