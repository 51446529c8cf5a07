//! A cycle of a reciprocating sphere: on the one-dimensional model with ten branches, with 512 elements along the contact and to
//! 1e-3, and on the half space on a standard solid to two per cent.

use std::error::Error;

use bem_halfspace::numerics::Accuracy;
use benches::report_error;
use criterion::Criterion;
use indenters::{Control, EquivalentLine, MovingLoad, Shape, Sphere, Stroke};
use rheology::{
    Prony, RelaxationBranch, RelaxationSpectrum, StandardSolid, StandardSolidParameters,
};

/// Friction coefficient of the line with 2048 elements, with an error of 5.2e-8.
const ON_LINE: f64 = 0.033_051_975;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    let ball = Sphere::new(5e-3)?;
    let stroke = Stroke {
        length: 10e-3,
        frequency: 2.0,
        shape: Shape::Sinusoidal,
    };
    let load = MovingLoad::reciprocating(Control::NormalForce(2.0), stroke)?;
    let (line, rubber) = (EquivalentLine(&ball), rubber(10)?);
    let on_line = |accuracy| mdr_core::move_along(&line, &rubber, &load, accuracy);
    for (name, accuracy) in [
        ("motion/line/512 elements", Accuracy::Elements(512)),
        ("motion/line/1e-3", Accuracy::RelativeError(1e-3)),
    ] {
        let mut found = None;
        criterion.bench_function(name, |bencher| {
            bencher.iter(|| found = Some(on_line(accuracy)));
        });
        if let Some(found) = found {
            let friction = found?.friction_coefficient;
            report_error(name, "friction coefficient", [friction.value, ON_LINE]);
        }
    }
    let solid = StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: 1e6,
        maxwell_modulus: 1e7,
        viscosity: 1e5,
    })?;
    let on_half_space = || bem_halfspace::move_along(&ball, &solid, &load, 2e-2);
    let name = "motion/half space/2e-2";
    let mut found = None;
    criterion.bench_function(name, |bencher| {
        bencher.iter(|| found = Some(on_half_space()));
    });
    if let Some(found) = found {
        let friction = found?.friction_coefficient;
        let bar = [friction.value + friction.error, friction.value];
        report_error(name, "friction coefficient, at most", bar);
    }
    criterion.final_summary();
    Ok(())
}

/// Some branches over four decades around the time of a contact, 10 ms.
fn rubber(count: u8) -> Result<Prony, Box<dyn Error>> {
    let branch = |index: u8| {
        let part = f64::from(index) / f64::from(count - 1).max(1.0);
        RelaxationBranch::new(1e6, 10.0_f64.powf(-4.0 + 4.0 * part))
    };
    let branches = (0..count).map(branch).collect();
    Ok(Prony::new(RelaxationSpectrum::new(1e6, 0.0, branches)?)?)
}
