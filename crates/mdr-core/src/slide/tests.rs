//! Parts of the error of a march, each compared with the deviation that it estimates.

use casebook::standard_solid;
use indenters::{EquivalentLine, PowerProfile};
use rheology::{Maxwell, StandardSolid};

use super::*;
use crate::steady::steady;

fn solid(times: f64) -> StandardSolid {
    standard_solid([1.0, 3.0, 3.0 * times]).expect("a material")
}

/// Terms of higher order are smaller by the number of elements along the layer or the contact: about a tenth on 256
/// elements, of which 26 are along the shortest distance of relaxation.
#[test]
fn the_error_of_the_step_is_that_of_a_march_with_relaxation() {
    let load = SlidingLoad::new(4.0, 1.0).expect("a load");
    let maxwell = Maxwell::new(5.0, 1.0).expect("a material");
    let solids = [0.2, 1.0].map(solid);
    let materials: [&dyn Material; 3] = [&maxwell, &solids[0], &solids[1]];
    for (exponent, material) in [1.0, 2.0].iter().flat_map(|p| materials.map(|m| (*p, m))) {
        let body = PowerProfile::new(1.0, exponent).expect("a body");
        let line = EquivalentLine(&body);
        let motion = Motion::new(&line, material, &load).expect("a motion");
        let march = motion.march(256, &|_| ()).expect("a march");
        let parts = motion.errors_of_step(&march, &|_| ()).expect("a march");
        let part = parts.expect("a memory")[0];
        let exact = steady(&line, material, &load, 1e-8).expect("a stationary state");
        let deviation =
            march.transient.last.friction_coefficient - exact.friction_coefficient.value;
        let ratio = part / deviation.abs();
        assert!(
            (0.95..1.15).contains(&ratio),
            "p = {exponent} on {material:?}: off by {deviation:e}, and the part is {part:e}"
        );
    }
}

#[test]
fn a_longer_march_changes_the_friction_by_less_than_the_truncation() {
    let load = SlidingLoad::new(4.0, 1.0).expect("a load");
    for times in [0.1, 1.0, 10.0] {
        let body = PowerProfile::paraboloid(1.0).expect("a body");
        let (line, material) = (EquivalentLine(&body), solid(times));
        let motion = Motion::new(&line, &material, &load).expect("a motion");
        let march = |drift_tolerance: f64| {
            let options = SlideOptions::with_elements(32, &line, &material, &load);
            let options = options.expect("options");
            let options = SlideOptions {
                drift_tolerance,
                max_sliding_distance: 10.0 * options.max_sliding_distance,
                ..options
            };
            slide_on_grid(&line, &material, &load, &options).expect("a march")
        };
        // Rounding is far below what is left after the shorter one.
        let [shorter, longer] = [1e-5, 1e-10].map(march);
        let [friction, limit] = [&shorter, &longer].map(|march| march.last.friction_coefficient);
        let parts = motion.remaining_changes(&shorter.rows).expect("parts");
        let part = parts[0].expect("a part");
        let change = (limit - friction).abs();
        assert!(
            change <= part && part < 1e-3 * friction,
            "{times} s: {change:e}, and the part is {part:e}"
        );
    }
}
