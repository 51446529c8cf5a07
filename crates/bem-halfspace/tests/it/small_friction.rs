//! The friction of slow and fast solids is a small difference of slopes.

use bem_halfspace::steady;
use casebook::prony;
use indenters::{PowerProfile, SlidingLoad, Sphere, Surface};

use crate::support::assert_bar;

/// Slow, but too fast for its closed form; the values are extrapolated from 160 000 unknowns by the orders that are observed there.
#[test]
fn a_small_friction_is_reached_to_three_in_ten_thousand() {
    let cone = PowerProfile::cone(0.1).expect("a body");
    let sphere = Sphere::new(5e-3).expect("a body");
    let under_cone = prony(
        [1e6, 0.0],
        &[
            (4_785_883.764_488_61, 2.535_022_162_995_501e-4),
            (1_777_666.628_438_045_5, 9.893_082_500_399_62e-4),
            (1_070_589.170_199_295, 1.984_231_404_195_013_8e-3),
        ],
    );
    let under_sphere = prony(
        [1e6, 0.0],
        &[
            (2_490_751.332_562_101_5, 2.484_431_322_943_685e-4),
            (4_595_350.649_054_349, 1.585_697_932_797_007_4e-3),
            (2_901_240.830_578_220_5, 2.940_106_435_995_620_7e-3),
        ],
    );
    let cases: [(&dyn Surface, _, f64, f64); 2] = [
        (&cone, under_cone, 0.015_396_654_681_664_295, 0.009_444_0),
        (
            &sphere,
            under_sphere,
            0.004_114_126_917_746_606,
            0.012_950_08,
        ),
    ];
    for (body, solid, velocity, expected) in cases {
        let load = SlidingLoad::new(1.0, velocity).expect("a load");
        let state = steady(body, &solid, &load, 3e-4).expect("a state");
        assert_bar(velocity, state.friction_coefficient, expected, 3e-4);
    }
}
