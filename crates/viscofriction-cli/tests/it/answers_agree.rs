//! Answers against closed forms and from method to method.

use std::fs;

use viscofriction::Estimate;

use crate::support::{Folder, assert_agree, assert_close, estimate, example, rows};

/// Scene | what it is compared with, if that is another scene | quantities, each with its exact value unless it is compared
/// with that scene, and the part of it that the error bars may be, as of [`assert_agree`].
///
/// - Equation (21) of the paper: μ = (π/2) 0.1 of a cone of the slope 0.1 on the viscous line, and F = 4 η v d (12).
/// - Marches in time on the line, and pressing, against closed forms.
/// - Friction of the half space at once, from first touch on, and from the table of s(p).
/// - Hertz with R = 10 mm, G = 1 MPa, ν = 0.3 and E* = 2 G/(1 − ν): F = (4/3) E* √R d^(3/2) at d = 0.1 mm, pressed and
///   sliding, where the slope at the rim is 0.1; a³ = 3 F R/(4 E*), d = a²/R, p₀ = 3 F/(2 π a²) under F = 1 N; and
///   b = √(4 F' R/(π E*)), p₀ = 2 F'/(π b) under a cylinder with F' = 2000 N/m.
/// - A force that has relaxed: F(t)/F(∞) = G(t)/G(∞), on a solid of which a third of the modulus stays.
/// - A map of a paraboloid against the paraboloid.
/// - Hunter's closed form for γ = 0.1 and z = l/(vτ) = 2 (casebook, VIS-04): a contact of the half length l = 1 mm under a
///   cylinder of R = 0.1 m, with G₁ = 0.1 MPa and τ = 1 ms. The area is known up to one element at either end.
const ANSWERS: &str = r#"
cone; viscous; normal_force = 1.0, velocity = 0.01; method = "analytic", model = "line" |  | friction_coefficient 0.15707963267948966 1e-3
cone; viscous; normal_force = 1.0, velocity = 0.01; method = "mdr-steady" |  | friction_coefficient 0.15707963267948966 1e-3
cone; viscous; normal_force = 1.0, velocity = 0.01; method = "mdr-transient" |  | friction_coefficient 0.15707963267948966 1e-3
cone; viscous; indentation_depth = 1e-3, velocity = 0.1; model = "line" |  | indentation_depth 1e-3 0, normal_force 4 1e-11
paraboloid; viscous; normal_force = 1.0, velocity = 0.01; sliding_distance = 2e-3, method = "mdr-transient", relative_error = 1e-2 | paraboloid; viscous; normal_force = 1.0, velocity = 0.01; sliding_distance = 2e-3, method = "analytic", model = "line" | friction_coefficient 1e-2
paraboloid; maxwell; normal_force = 1.0, velocity = 0.05; method = "mdr-transient", elements = 128 | paraboloid; maxwell; normal_force = 1.0, velocity = 0.05; method = "analytic", model = "line" | friction_coefficient 0.1
cone; solid; normal_force = 2.0, velocity = 0; duration = 1e-3, method = "bem-transient", relative_error = 1e-2 | cone; solid; normal_force = 2.0, velocity = 0; duration = 1e-3, method = "analytic" | indentation_depth 1e-2
cone; solid; normal_force = 2.0, velocity = 0; duration = 1e-3, method = "mdr-transient", relative_error = 1e-2 | cone; solid; normal_force = 2.0, velocity = 0; duration = 1e-3, method = "analytic" | indentation_depth 1e-2
indenter.table.file = "profile.csv"; maxwell; normal_force = 0.5, velocity = 0; duration = 0.02, method = "mdr-transient", relative_error = 1e-2 | indenter.table.file = "profile.csv"; maxwell; normal_force = 0.5, velocity = 0; duration = 0.02, method = "analytic" | indentation_depth 1e-2
cone; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-steady", relative_error = 1e-2 | cone; viscous; normal_force = 1.0, velocity = 0.01; method = "analytic" | friction_coefficient 0.02
cone; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-transient", elements = 12 | cone; viscous; normal_force = 1.0, velocity = 0.01; method = "analytic" | friction_coefficient 0.02
paraboloid; solid; normal_force = 1.0, velocity = 0.5; method = "bem-transient", elements = 16 | paraboloid; solid; normal_force = 1.0, velocity = 0.5; method = "bem-steady", relative_error = 1e-2 | friction_coefficient 0.1
paraboloid; solid; indentation_depth = 1e-4, velocity = 0.5; method = "bem-transient", elements = 16, sliding_distance = 1e-2 | paraboloid; solid; indentation_depth = 1e-4, velocity = 0.5; method = "bem-steady", relative_error = 1e-2 | friction_coefficient 0.1, normal_force 3e-2
paraboloid; elastic; indentation_depth = 1e-4, velocity = 0; method = "bem-transient", duration = 3, relative_error = 1e-2 |  | normal_force 0.38095238095238093 0.1
paraboloid; elastic; indentation_depth = 1e-4, velocity = 0.1; method = "bem-steady", relative_error = 1e-3 |  | normal_force 0.38095238095238093 0.1, friction_coefficient 0 1e-6
paraboloid; elastic; indentation_depth = 1e-4, velocity = 0.1; method = "bem-steady", elements = 24 |  | normal_force 0.38095238095238093 0.1, friction_coefficient 0 1e-6
paraboloid; elastic; indentation_depth = 1e-4, velocity = 0.1; method = "bem-transient", elements = 12, sliding_distance = 1e-3 |  | normal_force 0.38095238095238093 0.1, friction_coefficient 0 1e-6
paraboloid; elastic; normal_force = 1.0, velocity = 0; duration = 1 |  | indentation_depth 0.00019029156527550627 1e-9, contact_area 5.978185835096331e-06 1e-9, peak_pressure 250912.24016388066 1e-9
indenter.cylinder.radius = 0.01; elastic; normal_force = 2000, velocity = 0; duration = 1 |  | contact_area 0.0059708213214418465 2e-14, peak_pressure 426487.23724584613 2e-14, normal_force 2000 0
cylinder; elastic; normal_force = 1e3, velocity = 0.1;  |  | friction_coefficient 0 0
paraboloid; solid; indentation_depth = 1e-4, velocity = 0; duration = 1e-3, method = "bem-transient", elements = 16 | paraboloid; solid; indentation_depth = 1e-4, velocity = 0; duration = 1e-3, method = "analytic" | normal_force 0.1
map; viscous; normal_force = 1.0, velocity = 0.01; relative_error = 1e-2 | paraboloid; viscous; normal_force = 1.0, velocity = 0.01;  | friction_coefficient 0.1
map; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-steady", elements = 24 | paraboloid; viscous; normal_force = 1.0, velocity = 0.01;  | friction_coefficient 0.1
map; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-transient", elements = 12 | paraboloid; viscous; normal_force = 1.0, velocity = 0.01;  | friction_coefficient 0.1
map; material.elastic.shear_modulus = 5e3; normal_force = 1.0, velocity = 0; duration = 1, relative_error = 1e-2 | paraboloid; material.elastic.shear_modulus = 5e3; normal_force = 1.0, velocity = 0; duration = 1, relative_error = 1e-2 | indentation_depth 0.1
map; material.elastic.shear_modulus = 5e3; indentation_depth = 1e-3, velocity = 0; duration = 1, relative_error = 1e-2 | paraboloid; material.elastic.shear_modulus = 5e3; indentation_depth = 1e-3, velocity = 0; duration = 1, relative_error = 1e-2 | normal_force 0.1
cylinder; material.standard-solid = { equilibrium_modulus = 1e5, maxwell_modulus = 1e6, viscosity = 1e3 }; normal_force = 20.772577561137837, velocity = 0.5; relative_error = 1e-4 |  | friction_coefficient 0.0116237190576151 2e-2, contact_area 2e-3 0.05
cylinder; material.standard-solid = { equilibrium_modulus = 1e5, maxwell_modulus = 1e6, viscosity = 1e3 }; normal_force = 20.772577561137837, velocity = 0.5; elements = 300 |  | friction_coefficient 0.0116237190576151 2e-2, contact_area 2e-3 0.05
"#;

/// Bilinear heights lie at most c p²/2 above the paraboloid c r²: relative to the height at the contact radius a, and with
/// it friction, force and depth, by less than (p/a)², which is 1e-2 for a = 4 mm.
const BILINEAR: f64 = 1e-2;

#[test]
fn answers_are_those_of_closed_forms_and_of_other_methods() {
    let folder = Folder::new("same-answers");
    folder.write("map.csv", map());
    fs::copy(example("profile.csv"), folder.path("profile.csv")).expect("a profile");
    for [parts, other, required] in rows(ANSWERS) {
        let result = folder.answer(&parts);
        let method = result["method"].as_str().expect("a method");
        let named = format!("method = \"{method}\"");
        let is_asked = parts.contains(&named) || !parts.contains("method");
        assert!(is_asked, "{parts}: {result}");
        let is_line = parts.contains("\"mdr-") || parts.contains("\"line\"");
        let model = ["half-space", "line"][usize::from(is_line)];
        assert_eq!(result["model"], model, "{parts}: {result}");
        let is_cylinder = parts.contains("cylinder");
        let lacks = |field: &str| result[field].is_null();
        let is_area_known = !is_line || lacks("contact_area");
        let is_depth_known = !is_cylinder || lacks("indentation_depth");
        assert!(is_area_known && is_depth_known, "{parts}: {result}");
        let other = (!other.is_empty()).then(|| folder.answer(&other));
        for required in required.split(", ") {
            let (field, numbers) = required.split_once(' ').expect("a quantity");
            let number = |word: &str| word.parse().expect("a number");
            let mut numbers = numbers.split(' ').map(number);
            let expected = other.as_ref().map(|other| estimate(other, field));
            let exact = || Estimate::exact(numbers.next().expect("a value"));
            let mut expected = expected.unwrap_or_else(exact);
            if parts.starts_with("map") {
                expected.error += BILINEAR * expected.value;
            }
            let part = numbers.next().expect("a part");
            let what = format!("{field} of {parts}");
            assert_agree(what, estimate(&result, field), expected, part);
        }
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
