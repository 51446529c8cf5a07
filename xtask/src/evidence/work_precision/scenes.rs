//! The scenes, and how they are solved.

use viscofriction::scene::{Accuracy, Method, Model};

use crate::evidence::request::Request;

/// A scene with its name and, where the file leaves it open, the speed \[m/s].
pub(super) struct Scene {
    pub(super) name: &'static str,
    pub(super) text: &'static str,
    pub(super) velocity: Option<f64>,
}

const fn scene(name: &'static str, text: &'static str) -> Scene {
    Scene {
        name,
        text,
        velocity: None,
    }
}

/// Speeds at which the standard solid is soft, viscous and stiff.
const fn solid(name: &'static str, velocity: f64) -> Scene {
    Scene {
        velocity: Some(velocity),
        ..scene(name, include_str!("scenes/standard-solid.toml"))
    }
}

const PARABOLOID: Scene = scene("paraboloid", include_str!("scenes/paraboloid.toml"));
const INDENTATION: Scene = scene("indentation", include_str!("scenes/indentation.toml"));

/// Scenes of a full measurement; those that slide come first.
pub(super) const SCENES: [Scene; 10] = [
    scene("cone", include_str!("scenes/cone.toml")),
    PARABOLOID,
    scene("r^0.75", include_str!("scenes/cusp.toml")),
    scene("r^8", include_str!("scenes/blunt.toml")),
    solid("standard solid, slow", 0.1),
    solid("standard solid, middle", 3.0),
    solid("standard solid, fast", 100.0),
    scene("rubber, 20 branches", include_str!("scenes/rubber.toml")),
    INDENTATION,
    scene(HERTZ, include_str!("scenes/hertz.toml")),
];
pub(super) const QUICK_SCENES: [Scene; 2] = [PARABOLOID, INDENTATION];
/// All such contacts are similar.
pub(super) const HERTZ: &str = "Hertz";

/// Closed forms are asked for this, so that the table of s(p) takes part.
pub(super) const CLOSED: f64 = 1e-2;
/// Relative errors asked of the stationary solvers.
const LINE_ERRORS: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];
const HALF_SPACE_ERRORS: [f64; 5] = [1e-2, 1e-3, 3e-4, 1e-4, 5e-5];
/// Elements along the contact.
const LINES: [usize; 5] = [16, 48, 144, 432, 1296];
const GRIDS: [usize; 5] = [6, 12, 24, 48, 96];
const MARCHES: [usize; 5] = [6, 8, 12, 16, 24];
const PRESSED: [usize; 5] = [16, 32, 64, 128, 256];

/// Series of at most `runs` resolutions, closed forms first in each model; without sliding both models are the same, and
/// all results are of the half space.
pub(super) fn requests(presses: bool, runs: usize) -> Vec<Request> {
    let errors = |model, method, values: &[f64]| {
        let request = |error: &f64| Request::to_error(model, method, *error);
        values.iter().take(runs).map(request).collect::<Vec<_>>()
    };
    let elements = |model, method, values: &[usize]| {
        let request = |count: &usize| Request::new(model, method, Accuracy::Elements(*count));
        values.iter().take(runs).map(request).collect()
    };
    if presses {
        return [
            errors(Model::HalfSpace, Method::Analytic, &[CLOSED]),
            elements(Model::HalfSpace, Method::BemTransient, &PRESSED),
        ]
        .concat();
    }
    [
        errors(Model::Line, Method::Analytic, &[CLOSED]),
        errors(Model::Line, Method::MdrSteady, &LINE_ERRORS),
        elements(Model::Line, Method::MdrTransient, &LINES),
        errors(Model::HalfSpace, Method::Analytic, &[CLOSED]),
        errors(Model::HalfSpace, Method::BemSteady, &HALF_SPACE_ERRORS),
        elements(Model::HalfSpace, Method::BemSteady, &GRIDS),
        elements(Model::HalfSpace, Method::BemTransient, &MARCHES),
    ]
    .concat()
}
