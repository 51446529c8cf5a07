//! Bodies, lines and comparisons for the tests.

use casebook::superposition;
use indenters::{
    Axisymmetric, FlatCone, Hyperboloid, IndenterError, PiecewiseLinearProfile, PowerProfile,
    RoundTippedCone, SampledLine, Sphere, TruncatedParaboloid,
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

/// Every shape of the crate with a line that is not flat, of about the size 1 in a unit of length.
pub(crate) fn all_shapes(unit: f64) -> Vec<(&'static str, Box<dyn Axisymmetric>)> {
    let power = |c: f64, p: f64| boxed(PowerProfile::new(c * unit.powf(1.0 - p), p));
    let term = |c: f64, p: f64| (c * unit.powf(1.0 - p), p);
    let sum = superposition(&[term(1.0, 2.0), term(0.2, 0.7), term(-0.5, 4.0)]);
    let radii = [0.0, 0.4, 0.7, 2.0].map(|radius| radius * unit);
    let heights = [0.0, 0.1, 0.4, 1.0].map(|height| height * unit);
    let (tip, worn) = (0.5 * unit, 0.3 / unit);
    vec![
        ("root", power(0.3, 0.5)),
        ("needle", power(0.3, 0.05)),
        ("cone", boxed(PowerProfile::cone(0.3))),
        ("paraboloid", boxed(PowerProfile::paraboloid(2.0 / unit))),
        ("power 7.3", power(2.0, 7.3)),
        ("sphere", boxed(Sphere::new(1.1 * unit))),
        ("flat cone", boxed(FlatCone::new(tip, 0.3))),
        (
            "worn paraboloid",
            boxed(TruncatedParaboloid::new(tip, worn)),
        ),
        ("round-tipped cone", boxed(RoundTippedCone::new(tip, 0.3))),
        ("hyperboloid", boxed(Hyperboloid::new(tip, 0.3))),
        ("sum", Box::new(sum)),
        ("table", Box::new(table(&radii, &heights))),
    ]
}
