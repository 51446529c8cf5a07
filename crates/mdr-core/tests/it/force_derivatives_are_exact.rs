//! The derivatives of a force along a path of the depth are those of differences, and the force that of `indent_along`.

use indenters::{Control, HistoryPoint};
use mdr_core::{CurvePoint, ForceDerivatives, MdrError, force_derivatives};
use rheology::Material;

use crate::histories_match_quadrature::{body, follow, knots, material, numbers, path, stretched};
use crate::support::{history, prony};

/// What may vary: the stretch, a shift of all depths, the equilibrium spring and the parallel dashpot, and modulus and time of each branch.
fn parameters(material: &dyn Material) -> Vec<f64> {
    let spectrum = material.relaxation();
    let lone = [spectrum.equilibrium_modulus(), spectrum.viscosity()];
    let branches = spectrum.branches().iter();
    let branches = branches.flat_map(|branch| [branch.modulus, branch.relaxation_time]);
    [0.0; 2].into_iter().chain(lone).chain(branches).collect()
}

fn force(shape: &str, parameters: &[f64], path: &[HistoryPoint]) -> Vec<f64> {
    let branches = parameters[4..].chunks(2).map(|pair| (pair[0], pair[1]));
    let branches: Vec<(f64, f64)> = branches.collect();
    let material = prony([parameters[2], parameters[3]], &branches);
    let shifted = path.iter().map(|point| match point.control {
        Control::IndentationDepth(depth) => [point.time, depth + parameters[1]],
        Control::NormalForce(_) => panic!("{point:?} has no depth"),
    });
    let path = history(shifted, Control::IndentationDepth);
    let curve = force_derivatives(&stretched(shape, parameters[0]), &material, &path);
    curve.expect("a curve").normal_force
}

/// The derivatives by all parameters.
fn derivatives(exact: ForceDerivatives, shape: &str) -> Vec<Vec<f64>> {
    let stretch = exact.stretch.iter().zip(&exact.normal_force);
    // R ∂F/∂R of a sphere.
    let by_radius = f64::from(u8::from(shape == "sphere"));
    let stretch = stretch.map(|(stretch, force)| stretch + by_radius * force);
    let lone = [exact.equilibrium_modulus, exact.viscosity];
    let branches = exact.moduli.into_iter().zip(exact.relaxation_times);
    let branches = branches.flat_map(|(modulus, time)| [modulus, time]);
    let first = [stretch.collect(), exact.depth].into_iter().chain(lone);
    first.chain(branches).collect()
}

/// Differences of fourth order over h = s/200 of a scale s err by h⁴/30 ∂⁵F/∂p⁵ + 1e-15 F/h: with derivatives as those of a
/// power or an exponential of p/s, at most 1e3 F/s⁵, by 3e-8 F/s. The end of contact, where F has a root, is left out.
#[test]
fn derivatives_are_those_of_differences() {
    let cases = [
        ("solid", "paraboloid", "late"),
        ("solid", "sphere", "late dwell"),
        ("three", "sphere", "late"),
        ("three", "power", "late dwell"),
        ("kelvin-voigt", "cone", "late"),
        ("fluid", "paraboloid", "late dwell"),
        ("solid", "flat-cone", "late"),
    ];
    for (name, shape, along) in cases {
        let knots = knots(along);
        let [start, end] = [knots[0][0], knots[knots.len() - 1][0]];
        let time = |n: u8| start + (end - start) * (f64::from(n) + 0.3) / 48.0;
        let path = path(&knots, &(0..48).map(time).collect::<Vec<f64>>());
        let case = format!("{name}, {shape}, {along}");
        let (body, material) = (body(shape), material(name));
        let exact = force_derivatives(&body, &material, &path).expect("a curve");
        assert_eq!(exact.exact_until, path.len(), "{case}: one approach");
        assert_same(&exact, &follow(&*body, &material, &path), &case);
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let radius = exact.contact_radius.clone();
        let (scale, wide) = (largest(&exact.normal_force), 0.3 * largest(&radius));
        let parameters = parameters(&material);
        for (varied, derivative) in derivatives(exact, shape).into_iter().enumerate() {
            // On this scale the force changes smoothly; what is not there does not change it.
            let step = [1.0, 2e-4].get(varied).unwrap_or(&parameters[varied]);
            if *step <= 0.0 {
                continue;
            }
            let differences = differences(&parameters, (varied, *step), shape, &path);
            for (n, [difference, there]) in differences.into_iter().enumerate() {
                let got = derivative[n] * step;
                let is_clear = radius[n] > wide || there <= 0.0;
                assert!(
                    !is_clear || (got - difference).abs() <= 3e-8 * scale,
                    "{case}, {:?}: s ∂F/∂s of parameter {varied} is {got}, by differences {difference}, F up to {scale}",
                    path[n]
                );
            }
        }
    }
}

/// s ∂F/∂s by differences, and the largest force that went into them.
fn differences(
    parameters: &[f64],
    (varied, step): (usize, f64),
    shape: &str,
    path: &[HistoryPoint],
) -> Vec<[f64; 2]> {
    let at = |by: f64| {
        let mut parameters = parameters.to_vec();
        parameters[varied] += by * step / 200.0;
        force(shape, &parameters, path)
    };
    let [plus, minus, plus2, minus2] = [1.0, -1.0, 2.0, -2.0].map(at);
    let of = |n: usize| {
        let difference = 8.0 * (plus[n] - minus[n]) - plus2[n] + minus2[n];
        [difference * 200.0 / 12.0, plus2[n].max(minus2[n])]
    };
    (0..path.len()).map(of).collect()
}

/// Force and radius are those of `indent_along`.
fn assert_same(exact: &ForceDerivatives, curve: &[CurvePoint], case: &str) {
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let scales = [largest(&exact.normal_force), largest(&exact.contact_radius)];
    for (n, point) in curve.iter().enumerate() {
        let off = [
            (point.normal_force.value - exact.normal_force[n]) / scales[0],
            (point.contact_radius.value - exact.contact_radius[n]) / scales[1],
        ];
        let same = off.iter().all(|off| off.abs() <= 1e-12);
        assert!(same, "{case}: {point:?}, off by {off:?}");
    }
}

/// Elements that come into contact again count as if they had never separated: an error of second order in the dip.
#[test]
fn a_dip_in_a_dwell_is_wrong_in_second_order() {
    let body = body("paraboloid");
    let error = |dip: f64| {
        let mut knots = numbers::<2>("0 0, 1 0.01, 2 0.01, 2.1 0.01, 2.2 0.01, 3 0.01, 4 0");
        knots[3][1] -= dip;
        let times: Vec<f64> = (1..80).map(|n| 0.05 * f64::from(n)).collect();
        let path = path(&knots, &times);
        let fast = force_derivatives(&body, &material("solid"), &path).expect("a curve");
        let begins = path[fast.exact_until].time;
        let is_seen = (begins - 2.15).abs() < 1e-12 || dip < 1e-4;
        assert!(is_seen, "touched again at {begins}");
        let exact = follow(&*body, &material("solid"), &path);
        let pairs = fast.normal_force.iter().zip(&exact);
        let errors = pairs.map(|(fast, exact)| (fast - exact.normal_force.value).abs());
        errors.fold(0.0, f64::max)
    };
    let ratios = [error(2e-3) / error(1e-3), error(1e-3) / error(1e-4)];
    let expected = (3.5..4.5).contains(&ratios[0]) && (80.0..120.0).contains(&ratios[1]);
    assert!(expected, "errors of dips of 2, 1 and 0.1 mm: {ratios:?}");
}

#[test]
fn forces_are_not_differentiated_and_a_body_above_has_none() {
    let body = body("paraboloid");
    let held = |value, control| history([[0.0, value], [1.0, value]], control);
    let forces = held(1.0, Control::NormalForce);
    let refused = force_derivatives(&body, &material("solid"), &forces);
    let named = matches!(&refused, Err(MdrError::InvalidParameter(refused)) if refused.parameter == "control");
    assert!(named, "{refused:?}");
    let above = held(-1e-3, Control::IndentationDepth);
    let above = force_derivatives(&body, &material("solid"), &above).expect("a curve");
    let forces = [&above.normal_force, &above.depth, &above.moduli[0]];
    assert_eq!(forces, [&vec![0.0; 2]; 3], "no contact");
}
