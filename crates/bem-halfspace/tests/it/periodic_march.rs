//! Periodic surfaces that slide from rest come to the stationary state.

use bem_halfspace::periodic::slide_on_grid;
use bem_halfspace::{BemError, ContactOptions, Grid, PeriodicLoad, PeriodicTransient};
use casebook::rough_cases;
use rheology::Material;

use crate::support::{assert_close, assert_refused, elastic, prony};

const OPTIONS: ContactOptions = ContactOptions {
    tolerance: 1e-9,
    max_iterations: 500,
};

/// A unit square of waves [m, n, a, φ] slides over a distance.
fn slide(
    waves: &[[f64; 4]],
    n: usize,
    material: &impl Material,
    [pressure, velocity, distance]: [f64; 3],
) -> Result<PeriodicTransient, BemError> {
    let grid = Grid::new([n; 2], [1.0 / n as f64; 2]).expect("a valid grid");
    let height = |index: usize| -> f64 {
        let [x, y] = [index / n, index % n].map(|k| std::f64::consts::TAU * k as f64 / n as f64);
        let wave = |[m, n, a, phase]: &[f64; 4]| a * (m * x + n * y + phase).cos();
        waves.iter().map(wave).sum()
    };
    let heights: Vec<f64> = (0..n * n).map(height).collect();
    let load = PeriodicLoad::new(pressure, velocity)?.after(distance)?;
    slide_on_grid(&grid, &heights, material, &load, &OPTIONS)
}

#[test]
fn full_contact_ends_in_the_exact_friction() {
    for case in rough_cases("full_contact") {
        let elements = case.material.creep().elements().to_vec();
        let slowest = elements.iter().map(|element| element.retardation_time);
        // What is left of the start is below the tolerance.
        let distance = 25.0 * case.velocity * slowest.fold(0.0, f64::max);
        let n = 32;
        let scene = [case.mean_pressure, case.velocity, distance.clamp(0.5, 60.0)];
        let slid = slide(&case.waves, n, &case.material, scene).expect("a march");
        let last = slid.rows[slid.rows.len() - 1];
        assert_close(
            &case.id,
            last.friction_coefficient,
            case.friction_coefficient,
            1e-7,
        );
        assert_close(&case.id, last.area_fraction, 1.0, 1e-12);
    }
}

/// The error is of the first order in the edge of an element.
#[cfg(feature = "rough")]
#[test]
fn a_march_ends_in_the_stationary_state() {
    use crate::support::{assert_near, within};
    use bem_halfspace::periodic::{slide, steady};
    use indenters::rough::SelfAffine;
    use numerics::MaxElements;
    let surface = SelfAffine {
        period: [1.0; 2],
        hurst_exponent: 0.8,
        rms_slope: 0.1,
        longest_wavelength: 0.5,
        shortest_wavelength: 0.25,
        roll_off_wavelength: 0.5,
        seed: 4,
    };
    let surface = surface.surface().expect("a surface");
    for (material, load) in [
        (prony([1.0, 0.0], &[(9.0, 1.0)]), [0.3, 0.03]),
        (prony([1.0, 0.0], &[(49.0, 1.0), (50.0, 0.1)]), [1.0, 0.02]),
    ] {
        let pressed = PeriodicLoad::new(load[0], load[1]).expect("a load");
        let exact = steady(
            &surface,
            &material,
            &pressed,
            within(1e-3, &MaxElements(512)),
        );
        let exact = exact.expect("a stationary state");
        let way = pressed.after(1.0).expect("a distance");
        let march = |error| slide(&surface, &material, &way, within(error, &MaxElements(128)));
        let slid = march(0.07).expect("a march");
        let bar = slid.friction_coefficient;
        assert_near(load, bar.value, exact.friction_coefficient.value, bar.error);
        assert!(bar.error < 0.07 * bar.value, "{bar:?}");
        let bar = slid.area_fraction;
        assert_near(load, bar.value, exact.area_fraction.value, bar.error);
        let bar = slid.mean_depth;
        assert_near(load, bar.value, exact.mean_depth.value, bar.error);
        // From no friction at the start, when the material answers like a glass.
        let first = slid.finest.rows[0].friction_coefficient;
        assert!(
            first.abs() < 0.3 * exact.friction_coefficient.value,
            "{first}"
        );
        assert_refused(load, march(1e-4), "NotReached");
    }
}

/// A march ends at the distance that is asked for, whatever the elements, and its bar holds what finer steps say, also where the
/// distance is a part of an element.
#[cfg(feature = "rough")]
#[test]
fn a_march_ends_at_its_distance() {
    use bem_halfspace::periodic::slide;
    use indenters::rough::{PeriodicSurface, Wave};

    use crate::support::assert_bars_agree;
    let wave = |numbers, phase| Wave {
        numbers,
        amplitude: 0.01,
        phase,
    };
    let waves = vec![wave([1, 0], 0.3), wave([2, 1], 2.0), wave([0, 2], 1.0)];
    let surface = PeriodicSurface::new([1.0; 2], waves).expect("a surface");
    let material = prony([1.0, 0.0], &[(9.0, 1.0)]);
    let load = PeriodicLoad::new(0.1, 0.3).expect("a load");
    for distance in [0.02, 0.05, 0.13] {
        let load = load.after(distance).expect("a distance");
        let slid = |relative_error: f64| {
            let slid = slide(&surface, &material, &load, relative_error);
            let slid = slid.unwrap_or_else(|error| panic!("{distance}: {error}"));
            let rows = &slid.finest.rows;
            assert_close(
                "distance",
                rows[rows.len() - 1].sliding_distance,
                distance,
                1e-15,
            );
            slid.friction_coefficient
        };
        assert_bars_agree(distance, slid(0.5), slid(0.1));
    }
}

#[test]
fn unsupported_marches_are_refused() {
    let wave = [[1.0, 0.0, 0.1, 0.0]];
    let march = |scene| slide(&wave, 16, &elastic(1.0), scene);
    for (scene, name) in [
        ([1.0, 0.0, 1.0], "velocity"),
        ([1.0, 1.0, 0.0], "sliding_distance"),
        ([1.0, 1.0, f64::NAN], "sliding_distance"),
        ([1.0, 1.0, 1e20], "GridTooLarge"),
    ] {
        assert_refused(scene, march(scene), name);
    }
    let flowing = slide(&wave, 16, &prony([0.0, 1.0], &[]), [1.0, 1.0, 1.0]);
    assert_refused("a dashpot", flowing, "FlowsUnderWaves");
}
