//! A ball on a coated half space: a substrate of one's own is what it does to waves of pressure.

#![expect(clippy::print_stdout, reason = "an example shows its results")]

use bem_halfspace::{BemError, Control, Elastomer, Layer, Substrate, press};
use indenters::PowerProfile;
use rheology::Elastic;

/// A half space to which a coating is bonded, both incompressible: the thickness of the coating, and b = (α − 1)/(α + 1)
/// with the ratio α of its modulus to that of the half space.
#[derive(Debug)]
struct Coated(f64, f64);

impl Substrate for Coated {
    fn thickness(&self) -> f64 {
        self.0
    }

    /// (Perriot & Barthel 2004, J. Mater. Res. 19, 600)
    fn compliance_ratio(&self, s: f64, _poisson_ratio: f64) -> f64 {
        let (b, decay) = (self.1, (-2.0 * s).exp());
        let square = (b * decay).powi(2);
        let numerator = 1.0 + 4.0 * b * s * decay - square;
        numerator / (1.0 - 2.0 * b * (1.0 + 2.0 * s * s) * decay + square)
    }
}

fn depth(elastomer: &impl Elastomer) -> Result<f64, BemError> {
    // h = r²/(2R) with R = 5 mm, under 2 N.
    let ball = PowerProfile::paraboloid(100.0)?;
    let contact = press(&ball, elastomer, Control::NormalForce(2.0), 1e-3)?;
    let depth = contact.indentation_depth;
    Ok(depth.map_or(f64::NAN, |depth| depth.value))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [coating, below] = [Elastic::new(3e6)?, Elastic::new(1e6)?];
    let [hard, soft] = [depth(&coating)?, depth(&below)?];
    println!("without a half space below {hard:.4e} m, without a coating {soft:.4e} m");
    let mut depths = vec![soft];
    for thickness in [2e-4, 1e-3, 5e-3, 2e-1] {
        depths.push(depth(&Layer::on(&coating, Coated(thickness, 0.5))?)?);
    }
    println!("coated by 0, 0.2, 1, 5 and 200 mm: {depths:?} m");
    let falls = depths.is_sorted_by(|thin, thick| thin > thick);
    assert!(falls, "a coating helps, the thicker the more");
    assert!((depths[1] / soft - 1.0).abs() < 0.02, "a thin one little");
    assert!((depths[4] / hard - 1.0).abs() < 0.01, "a thick one alone");
    Ok(())
}
