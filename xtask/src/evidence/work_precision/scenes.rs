//! The scenes, and what their methods are asked.

use super::series::Resolution;
use crate::scene_file::{Method, Model};

/// A scene with its name and, where the file leaves it open, the speed \[m/s].
#[derive(Debug, Clone, Copy)]
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

/// A method, and the resolutions that it is asked for.
pub(super) type Way = (Method, Vec<Resolution>);

/// Relative errors asked of the stationary solvers.
const LINE_ERRORS: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];
const HALF_SPACE_ERRORS: [f64; 5] = [1e-2, 1e-3, 3e-4, 1e-4, 5e-5];
/// Elements along the contact.
const CHAINS: [usize; 5] = [16, 48, 144, 432, 1296];
const GRIDS: [usize; 5] = [6, 12, 24, 48, 96];
const MARCHES: [usize; 5] = [6, 8, 12, 16, 24];
const PRESSES: [usize; 5] = [16, 32, 64, 128, 256];

/// Without sliding both models are the same, and all answers count for the half space.
pub(super) fn when_pressed() -> Vec<(Model, Vec<Way>)> {
    let ways = vec![
        (Method::Analytic, vec![Resolution::ClosedForm]),
        (Method::MdrTransient, elements(&CHAINS)),
        (Method::BemTransient, elements(&PRESSES)),
    ];
    vec![(Model::HalfSpace, ways)]
}

/// Line and half space differ.
pub(super) fn when_slid() -> Vec<(Model, Vec<Way>)> {
    let line = vec![
        (Method::Analytic, vec![Resolution::ClosedForm]),
        (Method::MdrSteady, errors(&LINE_ERRORS)),
        (Method::MdrTransient, elements(&CHAINS)),
    ];
    let half_space = vec![
        (Method::Analytic, vec![Resolution::ClosedForm]),
        (Method::BemSteady, errors(&HALF_SPACE_ERRORS)),
        (Method::BemSteady, elements(&GRIDS)),
        (Method::BemTransient, elements(&MARCHES)),
    ];
    vec![(Model::Line, line), (Model::HalfSpace, half_space)]
}

fn elements(counts: &[usize]) -> Vec<Resolution> {
    counts.iter().copied().map(Resolution::Elements).collect()
}

fn errors(asked: &[f64]) -> Vec<Resolution> {
    let asked = asked.iter().copied();
    asked.map(Resolution::RelativeError).collect()
}
