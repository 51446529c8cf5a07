//! The half space at a depth, on any material, and under a height map, and line contacts, against closed forms and from
//! method to method.

use std::f64::consts::PI;

use viscofriction::Estimate;

use crate::support::{Folder, assert_agree, assert_close, estimate, number};

/// F = (4/3) E* √R d^(3/2) with R = 10 mm, G = 1 MPa, ν = 0.3 and d = 0.1 mm (Hertz), pressed and sliding.
#[test]
fn elastic_contact_at_a_depth_has_the_force_of_hertz_and_no_friction() {
    let folder = Folder::new("hertz-depth");
    let effective = 2.0 * 1.0e6 / (1.0 - 0.3);
    let expected = Estimate::exact(4.0 / 3.0 * effective * 0.1 * 1e-4_f64.powf(1.5));
    for motion in [
        r#"velocity = 0; method = "bem-transient", duration = 3, relative_error = 1e-2"#,
        r#"velocity = 0.1; method = "bem-steady", relative_error = 1e-3"#,
        r#"velocity = 0.1; method = "bem-steady", elements = 24"#,
        r#"velocity = 0.1; method = "bem-transient", elements = 12, sliding_distance = 1e-3"#,
    ] {
        let parts = format!("paraboloid; elastic; indentation_depth = 1e-4, {motion}");
        let result = folder.answer(&parts);
        assert_agree(motion, estimate(&result, "normal_force"), expected, 0.1);
        if !motion.starts_with("velocity = 0;") {
            let Estimate { value, error } = estimate(&result, "friction_coefficient");
            // The slope at the rim is 0.1.
            assert!(
                value.abs() <= error && error < 1e-6,
                "{motion}: {value} ± {error}"
            );
        }
    }
}

/// A force that has relaxed: F(t)/F(∞) = G(t)/G(∞), on a solid of which a third of the modulus stays.
#[test]
fn a_depth_that_is_held_relaxes_like_the_modulus() {
    let folder = Folder::new("relaxing");
    let held = "paraboloid; solid; indentation_depth = 1e-4, velocity = 0; duration = 1e-3";
    let elements = folder.answer(&format!(
        "{held}, method = \"bem-transient\", elements = 16"
    ));
    let exact = folder.answer(&format!("{held}, method = \"analytic\""));
    let exact = Estimate::exact(number(&exact, "normal_force"));
    assert_agree("force", estimate(&elements, "normal_force"), exact, 0.1);
}

/// The depth of a force is the depth at which that force is found.
#[test]
fn force_and_depth_lead_to_each_other() {
    let folder = Folder::new("force-and-depth");
    for (material, distance) in [("solid", ""), ("viscous", ", sliding_distance = 1.0")] {
        let solve = format!("method = \"bem-steady\", relative_error = 2e-3{distance}");
        let under = |load: &str| {
            folder.answer(&format!(
                "paraboloid; {material}; {load}, velocity = 0.05; {solve}"
            ))
        };
        let held = under("indentation_depth = 1e-4");
        let force = estimate(&held, "normal_force");
        let pressed = under(&format!("normal_force = {:?}", force.value));
        let [of_depth, mut of_force] = [&held, &pressed].map(friction);
        // The friction grows slower than the force.
        of_force.error += of_depth.value * force.error / force.value;
        assert_agree(material, of_depth, of_force, 0.1);
        // The depth under a force is that of one grid, which is off by less than the force by twice the error asked for.
        assert_close(material, number(&pressed, "indentation_depth"), 1e-4, 1e-2);
    }
}

fn friction(result: &serde_json::Value) -> Estimate {
    estimate(result, "friction_coefficient")
}

/// μ and F of the stationary state, from first touch on and at once.
#[test]
fn a_march_on_a_solid_arrives_at_its_stationary_state() {
    let folder = Folder::new("solid-march");
    for (load, distance) in [
        ("normal_force = 1.0", ""),
        ("indentation_depth = 1e-4", ", sliding_distance = 1e-2"),
    ] {
        let scene = format!("paraboloid; solid; {load}, velocity = 0.5; method");
        let march = format!("{scene} = \"bem-transient\", elements = 16{distance}");
        let direct = format!("{scene} = \"bem-steady\", relative_error = 1e-2");
        let [march, direct] = [march, direct].map(|parts| folder.answer(&parts));
        assert_agree(load, friction(&march), friction(&direct), 0.1);
        let [force, expected] = [march, direct].map(|result| number(&result, "normal_force"));
        assert_close(load, force, expected, 3e-2);
    }
}

/// Heights of a paraboloid on a grid of 0.4 mm, up to 11 mm from the tip, which lies off the middle.
fn map() -> String {
    let row = |row: i32| {
        let height = |column: i32| {
            let [x, y] = [row - 30, column - 28].map(|index| 4e-4 * f64::from(index));
            format!("{:?}", 0.3 + 50.0 * (x * x + y * y))
        };
        (0..57).map(height).collect::<Vec<_>>().join(",")
    };
    (0..59).map(row).collect::<Vec<_>>().join("\n")
}

/// Bilinear heights lie at most c p²/2 above the paraboloid c r²: relative to the height at the contact radius a, and with
/// it friction, force and depth, by less than (p/a)², which is 1e-2 for a = 4 mm.
#[test]
fn a_map_of_a_paraboloid_is_the_paraboloid() {
    let folder = Folder::new("map");
    folder.write("map.csv", map());
    let sliding = "viscous; normal_force = 1.0, velocity = 0.01";
    let exact = folder.answer(&format!("paraboloid; {sliding}; model = \"half-space\""));
    let mut exact = friction(&exact);
    exact.error += 1e-2 * exact.value;
    for solve in [
        "relative_error = 1e-2",
        "method = \"bem-steady\", elements = 24",
        "method = \"bem-transient\", elements = 12",
    ] {
        let result = folder.answer(&format!("map; {sliding}; {solve}"));
        assert_agree(solve, friction(&result), exact, 0.1);
    }
    for (load, field) in [
        ("normal_force = 1.0", "indentation_depth"),
        ("indentation_depth = 1e-3", "normal_force"),
    ] {
        let soft =
            format!("material.elastic.shear_modulus = 5e3; {load}, velocity = 0; duration = 1");
        let value = number(&folder.answer(&format!("paraboloid; {soft}")), field);
        let result = folder.answer(&format!("map; {soft}, relative_error = 1e-2"));
        assert_eq!(result["method"], "bem-transient", "{result}");
        let error = 1e-2 * value;
        let exact = Estimate { value, error };
        assert_agree(field, estimate(&result, field), exact, 0.1);
    }
}

/// Hunter's closed form for γ = 0.1 and z = l/(vτ) = 2 (casebook, VIS-04): a contact of the half length l = 1 mm under a
/// cylinder of R = 0.1 m, with G₁ = 0.1 MPa and τ = 1 ms.
#[test]
fn a_sliding_cylinder_has_the_friction_of_hunter() {
    let folder = Folder::new("hunter");
    let moduli = "equilibrium_modulus = 1e5, maxwell_modulus = 1e6, viscosity = 1e3";
    let load = 6.61211679922975 * PI * 1e5 * 1e-6 / 0.1;
    let expected = Estimate::exact(1.16237190576151 * 1e-3 / 0.1);
    for solve in ["relative_error = 1e-4", "elements = 200"] {
        let result = folder.answer(&format!(
            "cylinder; material.standard-solid = {{ {moduli} }}; normal_force = {load:?}, velocity = 0.5; {solve}"
        ));
        assert_eq!(result["method"], "bem-steady", "{result}");
        assert_agree(solve, friction(&result), expected, 2e-2);
        // One element at either end.
        assert_close(solve, number(&result, "contact_area"), 2e-3, 0.05);
        assert!(result["indentation_depth"].is_null(), "{result}");
    }
}

/// Hertz with R = 10 mm, G = 1 MPa, ν = 0.3 and E* = 2 G/(1 − ν): a³ = 3 F R/(4 E*), d = a²/R, p₀ = 3 F/(2 π a²) under a
/// paraboloid with F = 1 N, and b = √(4 F' R/(π E*)), p₀ = 2 F'/(π b) under a cylinder with F' = 2000 N/m.
#[test]
fn hertz_comes_out_as_in_the_textbook() {
    let [radius, effective]: [f64; 2] = [0.01, 2.0 * 1.0e6 / (1.0 - 0.3)];
    let contact = (0.75 * radius / effective).cbrt();
    let half_width = (4.0 * 2000.0 * radius / (PI * effective)).sqrt();
    let [point, line] = ["hertz.toml", "cylinder-hertz.toml"];
    for (scene, field, expected) in [
        (point, "indentation_depth", contact * contact / radius),
        (point, "contact_area", PI * contact * contact),
        (point, "peak_pressure", 1.5 / (PI * contact * contact)),
        (line, "contact_area", 2.0 * half_width),
        (line, "peak_pressure", 4000.0 / (PI * half_width)),
        (line, "normal_force", 2000.0),
    ] {
        let result = Folder::new("hertz").json(&format!("IN/{scene}"));
        let part = if scene == line { 1e-14 } else { 1e-9 };
        assert_close(field, number(&result, field), expected, part);
    }
}

#[test]
fn units_per_length_are_printed_and_the_pressure_is_written() {
    let folder = Folder::new("line-contact");
    let said = folder.done("run IN/cylinder-solid.toml --out out");
    for unit in ["N/m", "m²/m"] {
        assert!(said.stdout.contains(unit), "no {unit} in {}", said.stdout);
    }
    let [x, pressure] = [0, 1].map(|column| folder.column("out/line_pressure.csv", column));
    let force = (x[1] - x[0]) * pressure.iter().sum::<f64>();
    assert_close("force of 2000 N/m", force, 2000.0, 1e-9);
}
