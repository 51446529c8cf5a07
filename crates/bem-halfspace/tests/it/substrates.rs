//! Substrates of one's own: a coating on a half space, whose limits are known, and which between them moves as elasticity
//! and quadrature have it.

use std::f64::consts::PI;

use bem_halfspace::steady::steady;
use bem_halfspace::{
    Base, BemError, Control, Convolution, Elastomer, Grid, Layer, Substrate, press,
};
use indenters::{PowerProfile, SlidingLoad};
use nalgebra::{Matrix6, Vector6};
use numerics::{Estimate, integrate};
use rheology::{Compressible, Elastic, Material, Viscous};

use crate::support::{assert_close, assert_near, assert_refused, paraboloid, three_elements};

/// A half space of another modulus and Poisson ratio, to which the layer is bonded.
#[derive(Debug, Clone, Copy)]
struct Coated {
    thickness: f64,
    /// Shear modulus of the layer over that of the half space below.
    contrast: f64,
    /// Poisson ratio of the half space below.
    poisson_ratio: f64,
}

impl Substrate for Coated {
    fn thickness(&self) -> f64 {
        self.thickness
    }

    /// (Perriot & Barthel 2004, J. Mater. Res. 19, 600)
    fn compliance_ratio(&self, s: f64, poisson_ratio: f64) -> f64 {
        let [above, below] = [poisson_ratio, self.poisson_ratio].map(|nu| 3.0 - 4.0 * nu);
        let a = (self.contrast * below - above) / (1.0 + self.contrast * below);
        let b = (self.contrast - 1.0) / (self.contrast + above);
        let decay = (-2.0 * s).exp();
        let numerator = 1.0 + 4.0 * b * s * decay - a * b * decay * decay;
        numerator / (1.0 - (a + b + 4.0 * b * s * s) * decay + a * b * decay * decay)
    }
}

/// U and W of `u_x = U sin qx`, `u_z = W cos qx`, σ_zz and σ_xz over 2G and G, at the depth z, with q = 1: of the two solutions
/// that decay downwards (`down` = 1) or upwards (−1).
fn waves(z: f64, nu: f64, down: f64) -> [[f64; 4]; 2] {
    let (kappa, decay) = (3.0 - 4.0 * nu, (-down * z).exp());
    let of = |u: f64, w: f64, du: f64, dw: f64| {
        let dilation = u + dw;
        [u, w, dw + nu / (1.0 - 2.0 * nu) * dilation, du - w].map(|value| value * decay)
    };
    let first = of(1.0, down, -down, -1.0);
    let u = down * z - kappa;
    let second = of(u, z, down * (1.0 - u), 1.0 - down * z);
    [first, second]
}

/// M for a wave of the wave number s on a layer of the thickness 1, by the equations of elasticity of layer and half space.
fn by_elasticity(s: f64, nu: f64, coated: &Coated) -> f64 {
    let moduli = [2.0, 1.0].map(|factor| [factor * coated.contrast, factor]);
    let [surface, bottom] = [0.0, s].map(|z| [waves(z, nu, 1.0), waves(z, nu, -1.0)].concat());
    let below = waves(s, coated.poisson_ratio, 1.0);
    let mut matrix = Matrix6::zeros();
    for column in 0..4 {
        for row in 0..2 {
            matrix[(row, column)] = moduli[row][0] * surface[column][2 + row];
            matrix[(2 + row, column)] = bottom[column][row];
            matrix[(4 + row, column)] = moduli[row][0] * bottom[column][2 + row];
        }
    }
    for column in 0..2 {
        for row in 0..2 {
            matrix[(2 + row, 4 + column)] = -below[column][row];
            matrix[(4 + row, 4 + column)] = -moduli[row][1] * below[column][2 + row];
        }
    }
    let right = Vector6::new(-1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let solved = matrix.lu().solve(&right).expect("a regular matrix");
    let moved: f64 = (0..4)
        .map(|column| solved[column] * surface[column][1])
        .sum();
    moved * coated.contrast / (1.0 - nu)
}

#[test]
fn a_coating_has_the_compliance_of_elasticity() {
    for (contrast, below, nu) in [(0.1, 0.3, 0.45), (1.0, 0.2, 0.4), (7.0, 0.45, 0.1)] {
        let coated = Coated {
            thickness: 1.0,
            contrast,
            poisson_ratio: below,
        };
        for s in [1e-3, 0.1, 0.5, 1.0, 2.0, 5.0] {
            let expected = by_elasticity(s, nu, &coated);
            assert_close(
                (contrast, s),
                coated.compliance_ratio(s, nu),
                expected,
                1e-9,
            );
        }
    }
}

/// Under the pressure e^(−r²), whose transform is π e^(−q²/4), the potential in the middle is π ∫ e^(−q²/4) M(qt) dq, to
/// second order in the elements.
#[test]
fn a_coating_has_the_displacement_of_quadrature_under_a_smooth_pressure() {
    let material = Compressible::new(&Elastic::new(1.0).expect("a modulus"), 0.4).expect("ν");
    for (thickness, contrast) in [(0.4, 0.2), (0.7, 0.01), (0.7, 30.0), (4.0, 5.0)] {
        let coated = Coated {
            thickness,
            contrast,
            poisson_ratio: 0.3,
        };
        let layer = Layer::on(&material, coated).expect("a coating");
        let integrand =
            |q: f64| PI * (-0.25 * q * q).exp() * coated.compliance_ratio(q * thickness, 0.4);
        let expected = integrate(integrand, [0.0, 14.0], 1e-13).value;
        let [coarse, fine] = [63, 127].map(|n| {
            let edge = 10.0 / n as f64;
            let place = |index: usize| (index as f64 - 0.5 * (n as f64 - 1.0)) * edge;
            let squares = |k: usize| place(k / n).powi(2) + place(k % n).powi(2);
            let pressure: Vec<f64> = (0..n * n).map(|k| (-squares(k)).exp()).collect();
            let grid = Grid::new([n; 2], [edge; 2]).expect("a grid");
            let convolution = Convolution::for_elastomer(&layer, &grid);
            let mut moved = vec![0.0; n * n];
            let mut workspace = convolution.workspace();
            convolution.apply(&mut workspace, &pressure, &mut moved);
            moved[n * n / 2] / expected - 1.0
        });
        let order = (coarse / fine).abs().ln() / (127.0_f64 / 63.0).ln();
        let extrapolated = fine - (coarse - fine) / ((127.0_f64 / 63.0).powi(2) - 1.0);
        let holds = (order - 2.0).abs() < 0.3 && extrapolated.abs() < 2e-4;
        assert!(holds, "{coated:?}: {coarse:e}, {fine:e}, order {order}");
    }
}

/// The depth under a force of 0.1 on a paraboloid of the radius 1.
fn pressed(elastomer: &impl Elastomer) -> f64 {
    let ball = paraboloid(0.5);
    let contact = press(&ball, elastomer, Control::NormalForce(0.1), 1e-3).expect("a contact");
    contact.indentation_depth.expect("a depth").value
}

#[test]
fn coatings_have_the_half_spaces_and_the_layer_for_limits() {
    let shear = Elastic::new(1.0).expect("a modulus");
    let material = Compressible::new(&shear, 0.4).expect("ν");
    let coated = |thickness: f64, contrast: f64| {
        let coated = Coated {
            thickness,
            contrast,
            poisson_ratio: 0.4,
        };
        pressed(&Layer::on(&material, coated).expect("a coating"))
    };
    let half_space = pressed(&material);
    // The half space of the same material, up to the difference of the elements.
    assert_close("alike", coated(0.2, 1.0), half_space, 2e-4);
    // A thick coating is a half space up to the contact radius over the thickness.
    assert_close("thick", coated(1e4, 3.0), half_space, 3e-4);
    // A thin coating is negligible: the other half space is 1.2 times as compliant.
    let below = Elastic::new(1.0 / 1.2).expect("a modulus");
    let below = Compressible::new(&below, 0.4).expect("ν");
    assert_close("thin", coated(0.01, 1.2), pressed(&below), 1e-2);
    // A coating on a far stiffer half space is a layer on a rigid base.
    let rigid = pressed(&Layer::new(&material, 0.2).expect("a layer"));
    assert_close("rigid", coated(0.2, 1e-9), rigid, 1e-7);
    // Between, a stiff base leaves less depth than the half space, and a soft one more.
    assert!(
        coated(0.2, 0.5) < half_space && half_space < coated(0.2, 2.0),
        "between"
    );
}

#[test]
fn friction_on_a_coating_is_that_on_a_layer_where_its_base_is_stiff() -> Result<(), BemError> {
    let rubber = three_elements(0.1, 2.0, 0.5);
    let load = SlidingLoad::new(0.05, 0.5)?;
    let on_coating = |contrast| -> Result<Estimate, BemError> {
        let coated = Coated {
            thickness: 0.3,
            contrast,
            poisson_ratio: rubber.poisson_ratio(),
        };
        let layer = Layer::on(&rubber, coated)?;
        Ok(steady(&paraboloid(0.5), &layer, &load, 1e-2)?.friction_coefficient)
    };
    let (stiff, alike) = (on_coating(1e-9)?, on_coating(1.0)?);
    let layer = Layer::new(&rubber, 0.3)?;
    let expected = steady(&paraboloid(0.5), &layer, &load, 1e-2)?.friction_coefficient;
    assert_close("layer", stiff.value, expected.value, 1e-6);
    let expected = steady(&paraboloid(0.5), &rubber, &load, 1e-2)?.friction_coefficient;
    let allowed = alike.error + expected.error;
    assert_near("half space", alike.value, expected.value, allowed);
    Ok(())
}

/// A substrate with the given thickness and compliance ratio M, at least one of which is not allowed.
#[derive(Debug)]
struct Wrong(f64, fn(f64) -> f64);

impl Substrate for Wrong {
    fn thickness(&self) -> f64 {
        self.0
    }

    fn compliance_ratio(&self, s: f64, _: f64) -> f64 {
        (self.1)(s)
    }
}

impl Wrong {
    fn base(self) -> Result<Base, BemError> {
        Ok(Base::new(self, 0.5)?)
    }
}

#[test]
fn substrates_without_meaning_are_refused() {
    for thickness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let base = Wrong(thickness, |_| 1.0).base();
        assert_refused(thickness, base, "thickness");
    }
    let ratios: [fn(f64) -> f64; 4] = [
        |s| 1.0 + 1.0 / (1.0 + s),
        |_| f64::NAN,
        |s| 1.0 - 3.0 * (-2.0 * s).exp(),
        |_| 2.0,
    ];
    for ratio in ratios {
        let base = Wrong(1.0, ratio).base();
        assert_refused("M", base, "compliance ratio of a wave");
    }
    // A flowing coating on another half space is refused.
    let fluid = Viscous::new(1.0).expect("a viscosity");
    let soft = Layer::on(&fluid, Wrong(1.0, |s| 1.0 + (-3.0 * s).exp())).expect("a base");
    let load = SlidingLoad::new(1.0, 1.0).expect("a load");
    let cone = PowerProfile::cone(0.1).expect("a cone");
    assert_refused("fluid", steady(&cone, &soft, &load, 1e-2), "fluidity");
}
