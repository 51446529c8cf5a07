//! What is asked about a scene: by which method, how exactly, and against which reference.

use benches::Random;

use super::draw::{Scene, between, choice};
use crate::scene_file::{Accuracy, Method, Model};

/// A method of one model, and how exactly it is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Way {
    pub(super) model: Model,
    pub(super) method: Method,
    pub(super) accuracy: Accuracy,
}

/// How much is asked.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    /// Every n-th scene is also asked on the half space, which costs most.
    pub(super) half_space_every: usize,
    /// Decimal logarithms of the relative errors asked of the stationary half space.
    pub(super) half_space_errors: [f64; 2],
    /// The same of a chain.
    pub(super) chain_errors: [f64; 2],
    /// Elements along the contact.
    pub(super) grids: [usize; 3],
    pub(super) marches: [usize; 3],
}

pub(super) const FULL: Extent = Extent {
    half_space_every: 3,
    half_space_errors: [-2.5, -2.0],
    chain_errors: [-2.3, -1.6],
    grids: [8, 12, 16],
    marches: [8, 8, 10],
};

pub(super) const QUICK: Extent = Extent {
    half_space_every: 4,
    half_space_errors: [-2.0, -2.0],
    chain_errors: [-1.8, -1.5],
    grids: [8, 12, 16],
    marches: [8; 3],
};

/// Elements along the contact of a chain.
const CHAINS: [usize; 6] = [16, 32, 64, 128, 256, 512];
/// Elements along the contact of a body that is pressed.
const PRESSES: [usize; 3] = [16, 32, 64];
/// Closed forms are asked for this, so that the table of s(p) answers too.
const CLOSED: Accuracy = Accuracy::RelativeError(1e-2);

/// The ways of a scene; not every one is offered there.
pub(super) fn ways(random: &mut Random, scene: &Scene, extent: &Extent) -> Vec<Way> {
    if scene.presses() {
        return pressed(random);
    }
    let mut ways = line(random, extent);
    if scene.has_cusp() {
        // Errors of a chain fall too slowly there.
        ways.retain(|way| way.method != Method::MdrTransient || way.is_by_elements());
    }
    let half_space = half_space(random, extent);
    // On its way the half space has no reference.
    let is_stationary = scene.file.solve.sliding_distance.is_none();
    if is_stationary && scene.number.is_multiple_of(extent.half_space_every) {
        ways.extend(half_space);
    }
    ways
}

/// Both models are the same where nothing slides.
fn pressed(random: &mut Random) -> Vec<Way> {
    let chain = error(random, [-4.0, -2.0]);
    let grid = error(random, [-2.5, -2.0]);
    let asked = [
        (Method::Analytic, CLOSED),
        (Method::MdrTransient, chain),
        (Method::MdrTransient, elements(random, &CHAINS)),
        (Method::BemTransient, grid),
        (Method::BemTransient, elements(random, &PRESSES)),
    ];
    of_model(Model::HalfSpace, asked)
}

fn line(random: &mut Random, extent: &Extent) -> Vec<Way> {
    let asked = [
        (Method::Analytic, CLOSED),
        (Method::MdrSteady, error(random, [-6.0, -2.0])),
        (Method::MdrTransient, error(random, extent.chain_errors)),
        (Method::MdrTransient, elements(random, &CHAINS)),
    ];
    of_model(Model::Line, asked)
}

fn half_space(random: &mut Random, extent: &Extent) -> Vec<Way> {
    let asked = [
        (Method::Analytic, CLOSED),
        (Method::BemSteady, error(random, extent.half_space_errors)),
        (Method::BemSteady, elements(random, &extent.grids)),
        (Method::BemTransient, elements(random, &extent.marches)),
    ];
    of_model(Model::HalfSpace, asked)
}

fn of_model<const N: usize>(model: Model, asked: [(Method, Accuracy); N]) -> Vec<Way> {
    let way = |(method, accuracy)| Way {
        model,
        method,
        accuracy,
    };
    asked.map(way).to_vec()
}

/// A relative error, evenly distributed in its logarithm.
fn error(random: &mut Random, logarithms: [f64; 2]) -> Accuracy {
    Accuracy::RelativeError(10_f64.powf(between(random, logarithms)))
}

fn elements<const N: usize>(random: &mut Random, counts: &[usize; N]) -> Accuracy {
    Accuracy::Elements(choice(random, counts))
}

impl Way {
    fn is_by_elements(&self) -> bool {
        matches!(self.accuracy, Accuracy::Elements(_))
    }

    /// What the table of the results calls it.
    pub(super) fn name(&self, scene: &Scene) -> String {
        let method = self.method.name();
        let resolution = if self.is_by_elements() {
            ", elements"
        } else {
            ""
        };
        let of = match (self.method, self.model) {
            _ if scene.presses() => ", pressed",
            (Method::Analytic, Model::HalfSpace) => ", half space",
            _ => "",
        };
        format!("{method}{of}{resolution}")
    }
}
