//! The derivatives of a force along a path of the depth are those of differences, and the force that of `indent_along`.

use indenters::{Axisymmetric, Control, FlatCone, PowerProfile, Sphere};
use mdr_core::{CurvePoint, ForceDerivatives, HistoryPoint, MdrError, force_derivatives};
use rheology::{Material, Prony};

use crate::histories_match_quadrature::{follow, knots, material, path, prony};

/// What may vary: the spectrum, a shift of all depths, and the logarithm of a stretch of the body.
#[derive(Clone)]
struct Varied {
    spring: f64,
    viscosity: f64,
    branches: Vec<[f64; 2]>,
    shift: f64,
    stretch: f64,
}

impl Varied {
    fn of(material: &Prony) -> Self {
        let spectrum = material.relaxation();
        let branches = spectrum.branches().iter();
        Self {
            spring: spectrum.equilibrium_modulus(),
            viscosity: spectrum.viscosity(),
            branches: branches.map(|b| [b.modulus, b.relaxation_time]).collect(),
            shift: 0.0,
            stretch: 0.0,
        }
    }

    /// Of a sphere the radius is stretched.
    fn body(&self, name: &str) -> Box<dyn Axisymmetric> {
        let by = self.stretch.exp();
        match name {
            "paraboloid" => Box::new(PowerProfile::paraboloid(0.5 * by).expect("a paraboloid")),
            "cone" => Box::new(PowerProfile::cone(0.3 * by).expect("a cone")),
            "sphere" => Box::new(Sphere::new(by).expect("a sphere")),
            "flat-cone" => Box::new(FlatCone::new(0.02, 0.4 * by).expect("a cone")),
            _ => Box::new(PowerProfile::new(0.4 * by, 1.5).expect("a power")),
        }
    }

    fn vary(&mut self, parameter: Parameter, by: f64) {
        match parameter {
            Parameter::Spring => self.spring += by,
            Parameter::Dashpot => self.viscosity += by,
            Parameter::Modulus(k) => self.branches[k][0] += by,
            Parameter::Time(k) => self.branches[k][1] += by,
            Parameter::Depth => self.shift += by,
            Parameter::Stretch => self.stretch += by,
        }
    }

    fn force(&self, body: &str, path: &[HistoryPoint]) -> Vec<f64> {
        let material = prony(self.spring, self.viscosity, &self.branches);
        let path: Vec<HistoryPoint> = path
            .iter()
            .map(|point| shifted(point, self.shift))
            .collect();
        let curve = force_derivatives(&*self.body(body), &material, &path);
        curve.expect("a curve").normal_force
    }
}

fn shifted(point: &HistoryPoint, by: f64) -> HistoryPoint {
    let (Control::IndentationDepth(value) | Control::NormalForce(value)) = point.control;
    HistoryPoint {
        control: Control::IndentationDepth(value + by),
        ..*point
    }
}

#[derive(Debug, Clone, Copy)]
enum Parameter {
    Spring,
    Dashpot,
    Modulus(usize),
    Time(usize),
    Depth,
    Stretch,
}

/// Every parameter with a scale on which the force changes smoothly, and the derivative.
fn columns(
    exact: ForceDerivatives,
    varied: &Varied,
    shape: &str,
) -> Vec<(Parameter, f64, Vec<f64>)> {
    use Parameter::{Dashpot, Depth, Modulus, Spring, Stretch, Time};
    let stretch = exact.stretch.iter().zip(&exact.normal_force);
    // R ∂F/∂R of a sphere.
    let by_radius = f64::from(u8::from(shape == "sphere"));
    let stretch = stretch.map(|(stretch, force)| stretch + by_radius * force);
    let mut columns = vec![
        (Stretch, 1.0, stretch.collect()),
        (Depth, 2e-4, exact.depth),
        (Spring, varied.spring, exact.equilibrium_modulus),
        (Dashpot, varied.viscosity, exact.viscosity),
    ];
    let branches = exact.moduli.into_iter().zip(exact.relaxation_times);
    for (k, (moduli, times)) in branches.enumerate() {
        let [modulus, time] = varied.branches[k];
        columns.extend([(Modulus(k), modulus, moduli), (Time(k), time, times)]);
    }
    columns.retain(|(_, scale, _)| *scale > 0.0);
    columns
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
        let path = path(knots, &(0..48).map(time).collect::<Vec<f64>>());
        let case = format!("{name}, {shape}, {along}");
        let varied = Varied::of(&material(name));
        let body = varied.body(shape);
        let exact = force_derivatives(&*body, &material(name), &path).expect("a curve");
        assert_eq!(exact.exact_until, path.len(), "{case}: one approach");
        assert_same(&exact, &follow(&*body, &material(name), &path), &case);
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let radius = exact.contact_radius.clone();
        let (scale, wide) = (largest(&exact.normal_force), 0.3 * largest(&radius));
        for (parameter, step, derivative) in columns(exact, &varied, shape) {
            let differences = differences(&varied, (parameter, step), shape, &path);
            for (n, [difference, there]) in differences.into_iter().enumerate() {
                let got = derivative[n] * step;
                let is_clear = radius[n] > wide || there <= 0.0;
                assert!(
                    !is_clear || (got - difference).abs() <= 3e-8 * scale,
                    "{case}, {:?}: s ∂F/∂s of {parameter:?} is {got}, by differences {difference}, F up to {scale}",
                    path[n]
                );
            }
        }
    }
}

/// s ∂F/∂s by differences, and the largest force that went into them.
fn differences(
    varied: &Varied,
    (parameter, step): (Parameter, f64),
    shape: &str,
    path: &[HistoryPoint],
) -> Vec<[f64; 2]> {
    let at = |by: f64| {
        let mut varied = varied.clone();
        varied.vary(parameter, by * step / 200.0);
        varied.force(shape, path)
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

/// Elements that are touched again as if they had never been left: wrong in the second order of the dip.
#[test]
fn a_dip_in_a_dwell_is_wrong_in_second_order() {
    let body = PowerProfile::paraboloid(0.5).expect("a paraboloid");
    let error = |dip: f64| {
        let knots = [
            [0.0, 0.0],
            [1.0, 0.01],
            [2.0, 0.01],
            [2.1, 0.01 - dip],
            [2.2, 0.01],
            [3.0, 0.01],
            [4.0, 0.0],
        ];
        let times: Vec<f64> = (1..80).map(|n| 0.05 * f64::from(n)).collect();
        let path = path(&knots, &times);
        let fast = force_derivatives(&body, &material("solid"), &path).expect("a curve");
        let begins = path[fast.exact_until].time;
        assert!(
            (begins - 2.15).abs() < 1e-12 || dip < 1e-4,
            "touched again at {begins}"
        );
        let exact = follow(&body, &material("solid"), &path);
        let pairs = fast.normal_force.iter().zip(&exact);
        pairs
            .map(|(fast, exact)| (fast - exact.normal_force.value).abs())
            .fold(0.0, f64::max)
    };
    let ratios = [error(2e-3) / error(1e-3), error(1e-3) / error(1e-4)];
    let expected = (3.5..4.5).contains(&ratios[0]) && (80.0..120.0).contains(&ratios[1]);
    assert!(
        expected,
        "ratios of the errors of dips of 2, 1 and 0.1 mm: {ratios:?}"
    );
}

#[test]
fn forces_are_not_differentiated_and_a_body_above_has_none() {
    let body = PowerProfile::paraboloid(0.5).expect("a paraboloid");
    let point = |control| [0.0, 1.0].map(|time| HistoryPoint { time, control });
    let refused = force_derivatives(&body, &material("solid"), &point(Control::NormalForce(1.0)));
    let named = matches!(&refused, Err(MdrError::InvalidParameter(refused)) if refused.parameter == "control");
    assert!(named, "{refused:?}");
    let above = point(Control::IndentationDepth(-1e-3));
    let above = force_derivatives(&body, &material("solid"), &above).expect("a curve");
    assert_eq!(
        [&above.normal_force, &above.depth, &above.moduli[0]],
        [&vec![0.0; 2]; 3],
        "no contact"
    );
}
