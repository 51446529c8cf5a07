//! By which methods a scene is solved, and how accurately.

use viscofriction::scene::{Accuracy, MaterialTable, Method, Model};

use super::scene::Scene;
use crate::evidence::request::{Request, presses};
use crate::random::Random;

/// How much is computed.
pub(super) struct Extent {
    /// Memory of one solution.
    pub(super) memory: &'static str,
    /// Every n-th scene is also solved on the half space, which costs most.
    half_space_every: f64,
    /// Decimal logarithms of the relative errors asked of the stationary half space.
    half_space_errors: [f64; 2],
    /// The same of rough surfaces and flat ends.
    coarse_errors: [f64; 2],
    /// The same of a march on the line.
    march_errors: [f64; 2],
    /// Elements along the contact.
    grids: [usize; 5],
    marches: [usize; 5],
    /// Where nothing but flow is slow, so that the sliding distance is shorter.
    marches_on_dashpot: [usize; 5],
}

pub(super) const FULL: Extent = Extent {
    memory: "128 MiB",
    half_space_every: 1.5,
    half_space_errors: [-2.5, -2.0],
    coarse_errors: [-1.7, -1.3],
    march_errors: [-2.0, -1.4],
    grids: [8, 12, 16, 24, 32],
    marches: [8, 8, 10, 10, 12],
    marches_on_dashpot: [8, 12, 16, 20, 24],
};

pub(super) const QUICK: Extent = Extent {
    memory: "48 MiB",
    half_space_every: 6.0,
    half_space_errors: [-2.0, -2.0],
    coarse_errors: [-1.3, -1.3],
    march_errors: [-1.6, -1.3],
    grids: [8, 8, 12, 12, 16],
    marches: [8; 5],
    marches_on_dashpot: [8; 5],
};

/// Elements along the contact on the line and in plane strain, and of a body that is pressed on the half space.
const LINES: [usize; 6] = [16, 32, 64, 128, 256, 512];
const PRESSED: [usize; 3] = [16, 32, 64];
/// Closed forms are asked for this, so that the table of s(p) takes part.
const CLOSED: Accuracy = Accuracy::RelativeError(1e-2);

/// What is asked of a scene, by model, closed forms first; not every one is offered there.
///
/// Left out is what costs too much or has no reference: a chain to an error at a cusp or an edge, where errors fall too
/// slowly; an edge on the line with a dashpot, where the friction is infinite; rough surfaces at rest; the half space before
/// the stationary state, and in the scenes between.
pub(super) fn requests(random: &mut Random, scene: &Scene, extent: &Extent) -> Vec<Request> {
    if presses(&scene.file) {
        let asked = pressed(random);
        return if scene.is_rough() { Vec::new() } else { asked };
    }
    if scene.is_rough() {
        let asked = (Method::BemSteady, error(random, extent.coarse_errors));
        return of_model(Model::HalfSpace, &[asked]);
    }
    if scene.is_cylinder() {
        return plane_strain(random, extent);
    }
    let is_slow = |request: &Request| {
        request.method == Method::MdrTransient && !request.is_by_elements() && scene.is_sharp()
    };
    let mut requests = line(random, extent);
    requests.retain(|request| !is_slow(request));
    if scene.is_flat() && scene.has_dashpot() {
        requests.clear();
    }
    let on_half_space = half_space(random, scene, extent);
    let is_turn = random.uniform() * extent.half_space_every < 1.0;
    if scene.is_stationary() && is_turn {
        requests.extend(on_half_space);
    }
    requests
}

/// Both models are the same where nothing slides.
fn pressed(random: &mut Random) -> Vec<Request> {
    let line = error(random, [-4.0, -2.0]);
    let grid = error(random, [-2.5, -2.0]);
    let asked = [
        (Method::Analytic, CLOSED),
        (Method::MdrTransient, line),
        (Method::BemTransient, grid),
        (Method::BemTransient, elements(random, &PRESSED)),
    ];
    of_model(Model::HalfSpace, &asked)
}

fn line(random: &mut Random, extent: &Extent) -> Vec<Request> {
    let asked = [
        (Method::Analytic, CLOSED),
        (Method::MdrSteady, error(random, [-6.0, -2.0])),
        (Method::MdrTransient, error(random, extent.march_errors)),
        (Method::MdrTransient, elements(random, &LINES)),
    ];
    of_model(Model::Line, &asked)
}

fn half_space(random: &mut Random, scene: &Scene, extent: &Extent) -> Vec<Request> {
    let marches = if matches!(scene.file.material, MaterialTable::Viscous { .. }) {
        &extent.marches_on_dashpot
    } else {
        &extent.marches
    };
    let errors = if scene.is_flat() {
        extent.coarse_errors
    } else {
        extent.half_space_errors
    };
    let asked = [
        (Method::Analytic, CLOSED),
        (Method::BemSteady, error(random, errors)),
        (Method::BemSteady, elements(random, &extent.grids)),
        (Method::BemTransient, elements(random, marches)),
    ];
    of_model(Model::HalfSpace, &asked)
}

/// Of a cylinder.
fn plane_strain(random: &mut Random, extent: &Extent) -> Vec<Request> {
    let asked = [
        (Method::BemSteady, error(random, extent.half_space_errors)),
        (Method::BemSteady, elements(random, &LINES)),
    ];
    of_model(Model::HalfSpace, &asked)
}

fn of_model(model: Model, asked: &[(Method, Accuracy)]) -> Vec<Request> {
    let request = |&(method, accuracy): &_| Request::new(model, method, accuracy);
    asked.iter().map(request).collect()
}

/// A relative error, evenly distributed in its logarithm.
fn error(random: &mut Random, logarithms: [f64; 2]) -> Accuracy {
    Accuracy::RelativeError(10_f64.powf(random.between(logarithms)))
}

fn elements(random: &mut Random, counts: &[usize]) -> Accuracy {
    Accuracy::Elements(random.choice(counts))
}
