//! The stationary solver refuses bad input with typed errors.

use bem_halfspace::steady::{SteadyOptions, steady, steady_on_grid};
use bem_halfspace::{BemError, Footprint};
use indenters::{FlatPunch, PowerProfile, Sphere, Surface};

use crate::support::Scene;

fn good(scene: &Scene) -> SteadyOptions {
    let spacing = scene.contact_length() / 6.0;
    let footprint = scene.options(6.0).footprint;
    SteadyOptions {
        tolerance: 1e-10,
        ..SteadyOptions::new([spacing; 2], footprint)
    }
}

fn refused(options: &SteadyOptions) -> BemError {
    let Scene {
        body,
        material,
        load,
    } = Scene::unit(2.0);
    match steady_on_grid(&body, &material, &load, options) {
        Err(error) => error,
        Ok(solution) => panic!("accepted {options:?}: {solution:?}"),
    }
}

#[test]
fn options_out_of_range_are_refused() {
    let good = good(&Scene::unit(2.0));
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for options in [
            SteadyOptions {
                spacing: [value, 0.1],
                ..good
            },
            SteadyOptions {
                spacing: [0.1, value],
                ..good
            },
            SteadyOptions {
                footprint: Footprint {
                    x: [-1.0, value],
                    ..good.footprint
                },
                ..good
            },
        ] {
            let error = refused(&options);
            assert!(
                matches!(error, BemError::InvalidParameter { .. }),
                "{options:?} gave {error}"
            );
        }
    }
    for value in [0.51, -0.6, f64::NAN] {
        let error = refused(&SteadyOptions {
            phase: [0.0, value],
            ..good
        });
        assert!(
            matches!(
                error,
                BemError::InvalidParameter {
                    parameter: "phase",
                    ..
                }
            ),
            "{error}"
        );
    }
}

#[test]
fn a_contact_that_does_not_fit_is_refused() {
    let scene = Scene::unit(2.0);
    let good = good(&scene);
    let length = scene.contact_length();
    let error = refused(&SteadyOptions {
        footprint: Footprint::square(0.8 * length),
        ..good
    });
    assert!(
        matches!(error, BemError::ContactReachesBoundary { .. }),
        "{error}"
    );
    let error = refused(&SteadyOptions {
        spacing: [length; 2],
        ..good
    });
    assert!(matches!(error, BemError::GridTooCoarse { .. }), "{error}");
    let error = refused(&SteadyOptions {
        spacing: [1e-9 * length; 2],
        ..good
    });
    assert!(matches!(error, BemError::GridTooLarge { .. }), "{error}");
}

#[test]
fn an_exhausted_search_for_the_contact_is_an_error() {
    let error = refused(&SteadyOptions {
        max_iterations: 1,
        ..good(&Scene::unit(2.0))
    });
    assert!(
        matches!(error, BemError::ContactNotConverged { iterations: 1, .. }),
        "{error}"
    );
}

#[test]
fn a_relative_error_out_of_range_is_refused() {
    let Scene {
        body,
        material,
        load,
    } = Scene::unit(2.0);
    for value in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let result = steady(&body, &material, &load, value).map(|_| ());
        assert!(
            matches!(result, Err(BemError::InvalidParameter { .. })),
            "{value}: {result:?}"
        );
    }
}

/// Tight and lopsided footprints, with and without symmetry on the grid: the same friction, or an error.
#[test]
fn no_footprint_breaks_the_symmetry() {
    let scene = Scene::unit(2.0);
    let good = good(&scene);
    let length = scene.contact_length();
    for phase in [[0.0, 0.0], [0.0, 0.5], [0.5, -0.5]] {
        let solve = |y: [f64; 2]| {
            let footprint = Footprint {
                y,
                ..good.footprint
            };
            let options = SteadyOptions {
                phase,
                footprint,
                ..good
            };
            steady_on_grid(&scene.body, &scene.material, &scene.load, &options)
                .map(|solution| solution.friction_coefficient)
        };
        let wide = solve(good.footprint.y).expect("a solution");
        for y in [[-1.5, 4.0], [-4.0, 1.5]] {
            let friction = solve(y.map(|end| end * length)).expect("a solution");
            assert!(
                (friction / wide - 1.0).abs() < 1e-10,
                "{phase:?}, {y:?}: {friction} and {wide}"
            );
        }
        for y in [[-0.6, 0.6], [-0.6, 4.0], [-4.0, 0.6], [-0.1, 0.1]] {
            let refused = solve(y.map(|end| end * length));
            assert!(
                matches!(refused, Err(BemError::ContactReachesBoundary { .. })),
                "{phase:?}, {y:?}: {refused:?}"
            );
        }
    }
}

/// Two runners on either side of the lowest point.
struct Sledge;

impl Surface for Sledge {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        let aside = y.abs() - 3.0;
        if aside.abs() < 1.0 {
            x * x + aside * aside
        } else {
            f64::INFINITY
        }
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [2.0 * x, 2.0 * (y.abs() - 3.0) * y.signum()]
    }

    fn mirrors(&self) -> [bool; 2] {
        [true; 2]
    }
}

#[test]
fn a_footprint_that_misses_the_image_of_the_body_is_refused() {
    let scene = Scene::unit(2.0);
    for y in [[-1.0, 5.0], [-5.0, 1.0]] {
        let options = SteadyOptions {
            spacing: [0.2; 2],
            footprint: Footprint { x: [-5.0, 5.0], y },
            ..good(&scene)
        };
        let refused = steady_on_grid(&Sledge, &scene.material, &scene.load, &options);
        assert!(
            matches!(
                refused,
                Err(BemError::InvalidParameter {
                    parameter: "number of elements of the footprint that may touch",
                    ..
                })
            ),
            "{y:?}: {refused:?}"
        );
    }
}

#[test]
fn bodies_without_a_finite_friction_are_refused() {
    let Scene { material, load, .. } = Scene::unit(2.0);
    for exponent in [0.2, 0.5] {
        let cusp = PowerProfile::new(1.0, exponent).expect("a profile");
        let result = steady(&cusp, &material, &load, 1e-3).map(|_| ());
        assert!(
            matches!(
                result,
                Err(BemError::InvalidParameter {
                    parameter: "apex exponent",
                    ..
                })
            ),
            "{result:?}"
        );
    }
    let options = SteadyOptions {
        footprint: Footprint::square(0.6),
        spacing: [0.02; 2],
        ..good(&Scene::unit(2.0))
    };
    let punch = FlatPunch::new(0.3).expect("a punch");
    let result = steady_on_grid(&punch, &material, &load, &options).map(|_| ());
    assert!(
        matches!(result, Err(BemError::InvalidParameter { value: 0.0, .. })),
        "{result:?}"
    );
    // A sphere whose equator is below the depth scale.
    let sphere = Sphere::new(0.05).expect("a sphere");
    let options = SteadyOptions {
        footprint: Footprint::square(0.2),
        spacing: [0.01; 2],
        ..options
    };
    let result = steady_on_grid(&sphere, &material, &load, &options).map(|_| ());
    assert!(
        matches!(result, Err(BemError::VerticalWall { .. })),
        "{result:?}"
    );
}

#[test]
fn a_slope_that_the_grid_does_not_resolve_is_refused() {
    let Scene { material, load, .. } = Scene::unit(2.0);
    let steep = PowerProfile::new(1.0, 1000.0).expect("a profile");
    let options = SteadyOptions {
        footprint: Footprint::square(1.5),
        spacing: [0.1; 2],
        ..good(&Scene::unit(2.0))
    };
    let result = steady_on_grid(&steep, &material, &load, &options).map(|_| ());
    assert!(
        matches!(result, Err(BemError::SlopeNotResolved { .. })),
        "{result:?}"
    );
}
