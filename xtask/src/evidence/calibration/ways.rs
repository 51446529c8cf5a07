//! What is asked about a scene: by which method, how exactly, and against which reference.

use crate::random::Random;

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
    pub(super) grids: [usize; 5],
    pub(super) marches: [usize; 5],
    /// Where nothing but flow is slow, so that the way is shorter.
    pub(super) marches_on_dashpot: [usize; 5],
}

pub(super) const FULL: Extent = Extent {
    half_space_every: 3,
    half_space_errors: [-2.5, -2.0],
    chain_errors: [-2.0, -1.4],
    grids: [8, 12, 16, 24, 32],
    marches: [8, 8, 10, 10, 12],
    marches_on_dashpot: [8, 12, 16, 20, 24],
};

pub(super) const QUICK: Extent = Extent {
    half_space_every: 4,
    half_space_errors: [-2.0, -2.0],
    chain_errors: [-1.6, -1.3],
    grids: [8, 8, 12, 12, 16],
    marches: [8; 5],
    marches_on_dashpot: [8; 5],
};

/// Elements along the contact of a chain.
const CHAINS: [usize; 6] = [16, 32, 64, 128, 256, 512];
/// Elements along the contact of a body that is pressed.
const PRESSES: [usize; 3] = [16, 32, 64];
/// Closed forms are asked for this, so that the table of s(p) answers too.
const CLOSED: Accuracy = Accuracy::RelativeError(1e-2);

/// What is asked of a scene, and why some is not.
#[derive(Debug)]
pub(super) struct Ways {
    /// Not every one is offered there.
    pub(super) asked: Vec<Way>,
    /// One reason per way that is left out.
    pub(super) left_out: Vec<&'static str>,
}

const SLOW: &str = "a chain to an error at a cusp or an edge, where errors fall too slowly";
const SLOW_EDGE: &str = "the half space at an edge, where errors fall too slowly for a reference";
const NO_REFERENCE: &str = "the half space on its way, of which there is no reference";
const EXPENSIVE: &str = "the half space in the scenes between, because it costs most";

/// The ways of a scene.
pub(super) fn ways(random: &mut Random, scene: &Scene, extent: &Extent) -> Ways {
    let mut ways = Ways {
        asked: Vec::new(),
        left_out: Vec::new(),
    };
    if scene.presses() {
        ways.asked = pressed(random);
        return ways;
    }
    for way in line(random, extent) {
        let is_slow = way.method == Method::MdrTransient && !way.is_by_elements();
        ways.add(way, (scene.is_sharp() && is_slow).then_some(SLOW));
    }
    let is_stationary = scene.file.solve.sliding_distance.is_none();
    let why = if !is_stationary {
        Some(NO_REFERENCE)
    } else if !scene.number.is_multiple_of(extent.half_space_every) {
        Some(EXPENSIVE)
    } else if scene.has_edge() {
        Some(SLOW_EDGE)
    } else {
        None
    };
    for way in half_space(random, scene, extent) {
        ways.add(way, why);
    }
    ways
}

impl Ways {
    fn add(&mut self, way: Way, why_not: Option<&'static str>) {
        match why_not {
            None => self.asked.push(way),
            Some(reason) => self.left_out.push(reason),
        }
    }
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

fn half_space(random: &mut Random, scene: &Scene, extent: &Extent) -> Vec<Way> {
    let marches = if scene.is_viscous() {
        &extent.marches_on_dashpot
    } else {
        &extent.marches
    };
    let asked = [
        (Method::Analytic, CLOSED),
        (Method::BemSteady, error(random, extent.half_space_errors)),
        (Method::BemSteady, elements(random, &extent.grids)),
        (Method::BemTransient, elements(random, marches)),
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
