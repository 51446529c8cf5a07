//! Stationary sliding on materials that recover: limits, references, an independent sum, and extremes.

use std::f64::consts::{FRAC_2_PI, PI};

use bem_halfspace::steady::{SteadyEstimate, SteadyOptions, SteadySliding, steady, steady_on_grid};
use bem_halfspace::{BemError, Footprint, influence};
use casebook::{Case, group};
use indenters::{PowerProfile, SlidingLoad, Surface};
use numerics::Estimate;
use numerics::integrate;
use rheology::{
    Compressible, Elastic, KelvinVoigt, Material, Maxwell, Prony, RelaxationBranch,
    RelaxationSpectrum, StandardSolid, StandardSolidParameters, Viscous,
};

fn friction(
    body: &PowerProfile,
    material: &dyn Material,
    [force, velocity]: [f64; 2],
    relative_error: f64,
) -> Result<SteadyEstimate, BemError> {
    let load = SlidingLoad::new(force, velocity).expect("a valid load");
    steady(body, material, &load, relative_error)
}

fn solid(equilibrium_modulus: f64, maxwell_modulus: f64, time: f64) -> StandardSolid {
    StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus,
        maxwell_modulus,
        viscosity: maxwell_modulus * time,
    })
    .expect("a valid material")
}

/// One grid with so many `elements` along the contact, about.
fn one_grid(
    body: &PowerProfile,
    material: &dyn Material,
    [force, velocity]: [f64; 2],
    elements: f64,
) -> (SteadySliding, SteadyOptions) {
    let load = SlidingLoad::new(force, velocity).expect("a valid load");
    let footprint = Footprint::sliding(body, material, &load).expect("a footprint");
    // A paraboloid is at √3 of its contact as high as the footprint.
    let spacing = footprint.x[1] / (3.0_f64.sqrt() * elements);
    let options = SteadyOptions {
        tolerance: 1e-10,
        ..SteadyOptions::new([spacing, 0.5 * spacing], footprint)
    };
    let solution = steady_on_grid(body, material, &load, &options).expect("a solution");
    (solution, options)
}

/// A generalised Maxwell material of 20 branches over 12 decades, from 1e5 Pa to 2e9 Pa.
fn broad() -> Prony {
    let branch = |index: u32| {
        let relaxation_time = 10.0_f64.powf(-6.0 + 12.0 * f64::from(index) / 19.0);
        RelaxationBranch {
            modulus: 1e6 * relaxation_time.powf(-0.3),
            relaxation_time,
        }
    };
    let branches = (0..20).map(branch).collect();
    let spectrum = RelaxationSpectrum::new(1e5, 0.0, branches).expect("a valid spectrum");
    Prony::new(spectrum).expect("a valid material")
}

/// The force for which the casebook has the contact radius a: F = 8 G ∫ x g' dx with the line g = κc x^p.
fn force_of(case: &Case, modulus: f64) -> f64 {
    let p = case.input("p");
    8.0 * modulus * case.input("kappa_c") * p * case.input("a").powf(p + 1.0) / (p + 1.0)
}

/// Low speed: half the friction of the line; high speed: all of it, exactly (FRI-05). The speeds are moved towards the
/// middle, where friction is still in proportion to them up to 1e-4, and 1e-5 of the slope: that much is not rounding.
#[test]
fn both_ends_of_the_speed_are_exact() {
    const RELATIVE_ERROR: f64 = 1e-2;
    for case in group("FRI-05").iter().filter(|case| case.has_input("G1")) {
        let (soft, stiff) = (case.input("G1"), case.input("G1") + case.input("G2"));
        let p = case.input("p");
        let factor = if p > 1.5 { 0.5 } else { FRAC_2_PI };
        let body = PowerProfile::new(factor * case.input("kappa_c"), p).expect("a profile");
        let material = solid(soft, case.input("G2"), case.input("tau"));
        let ends = [
            ("mu_slow_3d", soft, case.input("v_slow"), 1e-6),
            ("mu_fast", stiff, case.input("v_fast"), 1e4),
        ];
        for (name, modulus, tabulated, velocity) in ends {
            let loads = [force_of(case, modulus), velocity];
            let estimate =
                friction(&body, &material, loads, RELATIVE_ERROR).expect("a friction coefficient");
            let ratio = if name == "mu_fast" {
                tabulated / velocity
            } else {
                velocity / tabulated
            };
            let expected = case.expected(name).expect("a value") * ratio;
            let Estimate { value, error } = estimate.friction_coefficient;
            let deviation = (value - expected).abs();
            assert!(
                deviation < RELATIVE_ERROR * expected,
                "{} {name}: {value} ± {error} instead of {expected}",
                case.id()
            );
        }
    }
}

/// Between the ends, against an independent computation (VIS-06) whose stated uncertainty is 1e-3 and tolerance 1e-2.
#[test]
fn friction_and_depth_agree_with_the_reference_at_middle_speeds() {
    for case in group("VIS-06") {
        let paraboloid = case.input_text("shape").starts_with("paraboloid");
        let body = if paraboloid {
            PowerProfile::paraboloid(0.5)
        } else {
            PowerProfile::cone(FRAC_2_PI)
        }
        .expect("a profile");
        let material = solid(case.input("G1"), case.input("G2"), case.input("tau"));
        let loads = [case.input("F"), case.input("v")];
        let estimate = friction(&body, &material, loads, 2e-3).expect("a friction coefficient");
        case.check_within("mu_3d", estimate.friction_coefficient.value, 4e-3);
        let depth = estimate.indentation_depth.expect("the depth of a solid");
        case.check_within("d_3d", depth.value, 4e-3);
    }
}

#[test]
fn an_elastic_body_slides_without_friction() {
    for exponent in [1.0, 2.0, 3.0] {
        let body = PowerProfile::new(0.3, exponent).expect("a profile");
        let material = Elastic::new(2.0).expect("a material");
        let estimate =
            friction(&body, &material, [0.5, 0.7], 1e-3).expect("a friction coefficient");
        let Estimate { value: mu, error } = estimate.friction_coefficient;
        assert!(
            mu.abs() <= error && error < 1e-8,
            "p = {exponent}: {mu:e} ± {error:e} instead of 0"
        );
    }
}

/// Hertz: F = (16/3) G √R d^(3/2) for h = r²/(2R), R = 2. The depth of one grid with 30 elements along the radius errs by less than 1/30².
#[test]
fn the_depth_of_an_elastic_paraboloid_is_that_of_hertz() {
    let body = PowerProfile::paraboloid(0.25).expect("a profile");
    let material = Elastic::new(3.0).expect("a material");
    let (solution, _) = one_grid(&body, &material, [0.4, 1.0], 30.0);
    let expected = (3.0 * 0.4 / (16.0 * 3.0 * 2.0_f64.sqrt())).powf(2.0 / 3.0);
    let depth = solution.depth.after(1e3).expect("a depth");
    assert!(
        (depth / expected - 1.0).abs() < 1e-3,
        "depth {depth} instead of {expected}"
    );
}

/// Materials that are dashpots but for a spring that the scene does not feel.
#[test]
fn all_materials_meet_at_the_dashpot() {
    let body = PowerProfile::paraboloid(1.0).expect("a profile");
    let loads = [4.0, 1.0];
    let dashpot = Viscous::new(1.0).expect("a material");
    let expected = friction(&body, &dashpot, loads, 1e-3).expect("a friction coefficient");
    let expected = expected.friction_coefficient.value;
    let materials: [Box<dyn Material>; 3] = [
        Box::new(Maxwell::new(1e7, 1.0).expect("a material")),
        Box::new(KelvinVoigt::new(1e-7, 1.0).expect("a material")),
        Box::new(solid(1e-7, 1e7, 1e-7)),
    ];
    for material in &materials {
        let actual = friction(&body, &**material, loads, 1e-3).expect("a friction coefficient");
        let actual = actual.friction_coefficient.value;
        assert!(
            (actual - expected).abs() < 1e-5 * expected,
            "{material:?}: {actual} instead of {expected}"
        );
    }
}

/// The displacement at a point by direct integration of its history, without tables or recursions:
/// u = J₀ w + (1/v) ∫ J' w, with a substitution-free quadrature between all scales.
fn displacement(
    solution: &SteadySliding,
    material: &dyn Material,
    velocity: f64,
    at: [f64; 2],
) -> f64 {
    let field = &solution.pressure;
    let (edges, columns) = (field.grid.spacing(), field.grid.shape()[1]);
    let potential = |x: f64| -> f64 {
        let of_element = |(index, pressure): (usize, &f64)| {
            let centre = [
                field.origin[0] + (index / columns) as f64 * edges[0],
                field.origin[1] + (index % columns) as f64 * edges[1],
            ];
            pressure * influence([x - centre[0], at[1] - centre[1]], edges) / (4.0 * PI)
        };
        let loaded = field
            .pressure
            .iter()
            .enumerate()
            .filter(|(_, pressure)| **pressure > 0.0);
        loaded.map(of_element).sum()
    };
    let creep = material.creep();
    let edges_ahead =
        (0..=field.grid.shape()[0]).map(|row| field.origin[0] + (row as f64 - 0.5) * edges[0]);
    let front = field.origin[0] + (field.grid.shape()[0] as f64 - 0.5) * edges[0];
    let mut total = creep.instantaneous_compliance() * potential(at[0]);
    for element in creep.elements() {
        let length = velocity * element.retardation_time;
        let end = front + 40.0 * length;
        let outside = (0..60).map(|power| front + edges[0] * 2.0_f64.powi(power));
        let mut ends: Vec<f64> = edges_ahead
            .clone()
            .chain(outside)
            .chain([at[0], end])
            .collect();
        ends.retain(|x| (at[0]..=end).contains(x));
        ends.sort_by(f64::total_cmp);
        let rate = |x: f64| (-(x - at[0]) / length).exp() / length * potential(x);
        let parts = ends.windows(2).filter(|pair| pair[0] < pair[1]);
        let integral: f64 = parts
            .map(|pair| integrate(rate, [pair[0], pair[1]], 1e-9).value)
            .sum();
        total += element.compliance * integral;
    }
    material.half_space_factor() * total
}

/// The gap closes in contact, at the depth of the solution, and is open elsewhere, when the displacement is integrated
/// over its history.
#[test]
fn the_contact_conditions_hold_for_displacements_integrated_directly() {
    let body = PowerProfile::paraboloid(1.0).expect("a profile");
    let material = Compressible::new(&solid(0.1, 1.0, 1.0), 0.3).expect("a material");
    for velocity in [0.03, 0.5, 8.0] {
        let (solution, options) = one_grid(&body, &material, [1.0, velocity], 4.0);
        let depth = solution.depth.reference_depth;
        let field = &solution.pressure;
        let spacing = options.spacing;
        let compliance = material
            .complex_compliance(PI * velocity / spacing[0])
            .expect("a compliance");
        let shift = -compliance.loss.atan2(compliance.storage) / PI * spacing[0];
        let [rows, columns] = field.grid.shape();
        // The first row behind and the first ahead of the contact, and some in between.
        for (row, column) in [(0, 1), (1, 3), (2, 2), (3, 4), (4, 1), (rows + 1, 2)] {
            let centre = [
                field.origin[0] + (row as f64 - 1.0) * spacing[0],
                field.origin[1] + column as f64 * spacing[1],
            ];
            let point = [centre[0] + shift, centre[1]];
            let gap =
                body.height(point) - depth + displacement(&solution, &material, velocity, point);
            let loaded =
                (1..=rows).contains(&row) && field.pressure[(row - 1) * columns + column] > 0.0;
            // The solver leaves 1e-10 of the depth scale, the quadrature 1e-9 of the displacement.
            let holds = if loaded {
                gap.abs() < 1e-8 * depth
            } else {
                gap > -1e-8 * depth
            };
            assert!(
                holds,
                "v = {velocity}, element ({row}, {column}), loaded: {loaded}: gap {gap:e}"
            );
        }
    }
}

/// A Poisson ratio does what a larger force does.
#[test]
fn compressible_materials_carry_less() {
    let body = PowerProfile::cone(0.3).expect("a profile");
    let material = solid(0.1, 1.0, 1.0);
    let softer = Compressible::new(&material, 0.2).expect("a material");
    let (actual, _) = one_grid(&body, &softer, [1.0, 0.5], 10.0);
    let (expected, _) = one_grid(&body, &material, [1.6, 0.5], 10.0);
    let ratios = [
        actual.friction_coefficient / expected.friction_coefficient,
        actual.depth.reference_depth / expected.depth.reference_depth,
        actual.contact_area / expected.contact_area,
    ];
    for ratio in ratios {
        assert!((ratio - 1.0).abs() < 1e-9, "{ratios:?}: {actual:?}");
    }
}

/// Metre, newton and second over 24 decades each.
#[test]
fn results_are_invariant_under_a_change_of_units() {
    let scene = |[metre, newton, second]: [f64; 3]| {
        let body = PowerProfile::new(0.3 * metre.powf(-0.5), 1.5).expect("a profile");
        let pascal = newton / metre / metre;
        let material = solid(0.1 * pascal, pascal, 0.5 * second);
        one_grid(&body, &material, [0.5 * newton, 0.7 * metre / second], 8.0).0
    };
    let expected = scene([1.0; 3]);
    for units in [
        [1e12, 1.0, 1.0],
        [1e-12, 1e9, 1e3],
        [1e3, 1e-12, 1e12],
        [1e9, 1e12, 1e-12],
    ] {
        let actual = scene(units);
        let ratios = [
            actual.friction_coefficient / expected.friction_coefficient,
            actual.depth.reference_depth / units[0] / expected.depth.reference_depth,
            actual.contact_area / units[0].powi(2) / expected.contact_area,
        ];
        for ratio in ratios {
            assert!((ratio - 1.0).abs() < 1e-9, "units {units:?}: {ratios:?}");
        }
    }
}

/// 20 branches over 12 decades, at speeds over 24: finite everywhere, and in proportion to the speed and to its inverse
/// at the two ends, as an expansion in the loss angle has it.
#[test]
fn a_broad_spectrum_has_friction_at_all_speeds_and_none_at_the_ends() {
    let body = PowerProfile::paraboloid(1.0).expect("a profile");
    let material = broad();
    let at = |decade: i32| {
        let estimate = friction(&body, &material, [1e4, 10.0_f64.powi(decade)], 3e-2);
        let mu = estimate.expect("a friction coefficient");
        let mu = mu.friction_coefficient.value;
        assert!(mu > 0.0 && mu < 1.0, "v = 1e{decade}: {mu}");
        mu
    };
    let speeds = (-12..=12).step_by(3);
    let values: Vec<f64> = speeds.map(at).collect();
    let [slow, fast] = [values[1] / values[0], values[8] / values[7]];
    for (name, ratio, power) in [("slow", slow, 1.0), ("fast", fast, -1.0)] {
        let actual = ratio.log10() / 3.0;
        // Both values have an error of 3 per cent, and three decades lie between them.
        assert!(
            (actual - power).abs() < 0.02,
            "{name}: power {actual} instead of {power}"
        );
    }
}

#[test]
fn force_and_depth_control_agree() {
    let body = PowerProfile::paraboloid(1.0).expect("a profile");
    let solid = solid(0.1, 1.0, 1.0);
    let fluid = Maxwell::new(1.0, 1.0).expect("a material");
    let materials: [&dyn Material; 2] = [&solid, &fluid];
    for material in materials {
        let (by_force, options) = one_grid(&body, material, [1.0, 0.5], 8.0);
        let distance = 1e3;
        let depth = by_force.depth.after(distance).expect("a depth");
        let load = SlidingLoad::at_depth(depth, 0.5).and_then(|load| load.after(distance));
        let by_depth = steady_on_grid(&body, material, &load.expect("a load"), &options);
        let by_depth = by_depth.expect("a solution");
        let ratios = [
            by_depth.normal_force,
            by_depth.friction_coefficient / by_force.friction_coefficient,
        ];
        for ratio in ratios {
            assert!((ratio - 1.0).abs() < 1e-8, "{material:?}: {ratios:?}");
        }
    }
}

/// Speeds at which a length over a speed, or the compliance over it, leaves the numbers.
#[test]
fn speeds_beyond_all_numbers_are_refused_or_answered() {
    let body = PowerProfile::paraboloid(1.0).expect("a profile");
    for velocity in [1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300] {
        match friction(&body, &solid(0.1, 1.0, 1.0), [1.0, velocity], 1e-2) {
            Ok(SteadyEstimate {
                friction_coefficient: Estimate { value, error },
                ..
            }) => assert!(
                value.abs() < 1e-8 && error.is_finite(),
                "v = {velocity:e}: {value} ± {error}"
            ),
            Err(error) => assert!(
                matches!(error, BemError::InvalidParameter { .. }),
                "v = {velocity:e}: {error}"
            ),
        }
    }
}

#[test]
fn a_contact_beyond_the_footprint_is_refused() {
    let body = PowerProfile::paraboloid(1.0).expect("a profile");
    let load = SlidingLoad::new(1.0, 1.0).expect("a load");
    let options = SteadyOptions::new([0.02; 2], Footprint::square(0.3));
    let refused = steady_on_grid(&body, &solid(0.1, 1.0, 1.0), &load, &options);
    assert!(
        matches!(refused, Err(BemError::ContactReachesBoundary { .. })),
        "{refused:?}"
    );
}
