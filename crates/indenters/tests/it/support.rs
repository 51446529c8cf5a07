//! Bodies, lines and comparisons for the tests.

use casebook::superposition;
use indenters::{
    Axisymmetric, FlatCone, Hyperboloid, IndenterError, PiecewiseLinearProfile, PowerProfile,
    RoundTippedCone, SampledLine, Sphere, Spheroid, TruncatedParaboloid,
};

pub(crate) fn boxed<S: Axisymmetric + 'static>(
    shape: Result<S, IndenterError>,
) -> Box<dyn Axisymmetric> {
    Box::new(shape.unwrap())
}

/// A position beyond the upper end of a domain from zero on.
pub(crate) const fn out_of_domain(position: f64, upper: f64) -> IndenterError {
    IndenterError::OutOfDomain {
        position,
        lower: 0.0,
        upper,
    }
}

pub(crate) fn table(radii: &[f64], heights: &[f64]) -> PiecewiseLinearProfile {
    PiecewiseLinearProfile::new(radii.to_vec(), heights.to_vec()).unwrap()
}

pub(crate) fn sampled(positions: &[f64], heights: &[f64]) -> SampledLine {
    SampledLine::new(positions.to_vec(), heights.to_vec()).unwrap()
}

/// The shapes of [`all_shapes`] that implement `closed_radius`, the inverse of their line.
pub(crate) const CLOSED_RADII: [&str; 7] = [
    "root",
    "needle",
    "cone",
    "paraboloid",
    "power 7.3",
    "sphere",
    "spheroid",
];

/// Every shape of the crate with a line that is not flat, of about the size 1.
pub(crate) fn all_shapes() -> Vec<(&'static str, Box<dyn Axisymmetric>)> {
    let power = |c: f64, p: f64| boxed(PowerProfile::new(c, p));
    let sum = superposition(&[(1.0, 2.0), (0.2, 0.7), (-0.5, 4.0)]);
    let table = table(&[0.0, 0.4, 0.7, 2.0], &[0.0, 0.1, 0.4, 1.0]);
    vec![
        ("root", power(0.3, 0.5)),
        ("needle", power(0.3, 0.05)),
        ("cone", boxed(PowerProfile::cone(0.3))),
        ("paraboloid", boxed(PowerProfile::paraboloid(2.0))),
        ("power 7.3", power(2.0, 7.3)),
        ("sphere", boxed(Sphere::new(1.1))),
        ("spheroid", boxed(Spheroid::new(1.1, 0.4))),
        ("flat cone", boxed(FlatCone::new(0.5, 0.3))),
        ("worn paraboloid", boxed(TruncatedParaboloid::new(0.5, 0.3))),
        ("round-tipped cone", boxed(RoundTippedCone::new(0.5, 0.3))),
        ("hyperboloid", boxed(Hyperboloid::new(0.5, 0.3))),
        ("sum", Box::new(sum)),
        ("table", Box::new(table)),
    ]
}
