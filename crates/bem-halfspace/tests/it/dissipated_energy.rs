//! The work of a cycle equals the energy that the material dissipates, which follows from the pressures alone.
//!
//! A retardation element is a spring and a dashpot side by side, both half spaces that move alike. With the pressure p on both the
//! spring carries s and the dashpot p − s,
//!
//! ```text
//! λ ds/dt + s = p,      power = (J/λ) ⟨p − s, K (p − s)⟩
//! ```
//!
//! where J K p is the displacement under p. No displacement of the march, and no slope of the body, enters.

use std::f64::consts::PI;

use bem_halfspace::indenters::{MovingLoad, Shape, Sphere, Stroke};
use bem_halfspace::numerics::{Accuracy, Estimate, whole_part};
use bem_halfspace::rheology::{Material as _, Prony, RelaxationBranch, RelaxationSpectrum};
use bem_halfspace::slide::{March, Motion};
use bem_halfspace::steady::steady_grid;
use bem_halfspace::{
    Control, Convolution, Elastomer, Footprint, Grid, GridOptions, Layer, SlidingLoad, move_along,
};

use crate::support::assert_bars_agree;

const FORCE: f64 = 2.0;
const ELEMENTS: usize = 10;
/// Duration of the motion over the largest retardation time: e^−7, a thousandth, of the first touch remains.
const DURATION_OVER_RETARDATION_TIME: f64 = 7.0;

fn ball() -> Sphere {
    Sphere::new(5e-3).expect("a sphere")
}

fn rubber() -> Prony {
    let branches = [(1e7, 1e-3), (3e6, 4e-3)].map(|(modulus, relaxation_time)| RelaxationBranch {
        modulus,
        relaxation_time,
    });
    let spectrum = RelaxationSpectrum::new(1e6, 0.0, branches.to_vec()).expect("a spectrum");
    Prony::new(spectrum).expect("a solid")
}

/// Elements along the contact, about, and their spacing, \[m].
type Grids = (usize, f64);

/// What springs carry, by retardation element, on the elements that the body passes.
struct Springs {
    grid: Grid,
    convolution: Convolution,
    carried: Vec<Vec<f64>>,
}

impl Springs {
    fn new(elastomer: &impl Elastomer, shape: [usize; 2], spacing: f64) -> Self {
        let grid = Grid::new(shape, [spacing; 2]).expect("a grid");
        let n_elements = elastomer.material().creep().elements().len();
        Self {
            convolution: Convolution::for_elastomer(elastomer, &grid),
            carried: vec![vec![0.0; grid.n_elements()]; n_elements],
            grid,
        }
    }

    /// Part p − s of a pressure that each dashpot carries.
    fn on_dashpots(&self, pressure: &[f64]) -> impl Iterator<Item = Vec<f64>> {
        let rest = |springs: &Vec<f64>| {
            let pairs = pressure.iter().zip(springs);
            pairs.map(|(all, spring)| all - spring).collect()
        };
        self.carried.iter().map(rest)
    }

    /// Energy that the dashpots dissipate while a pressure is held for a time, \[J].
    fn heat(&self, elastomer: &impl Elastomer, pressure: &[f64], time: f64) -> f64 {
        let material = elastomer.material();
        let per_compliance = material.half_space_factor() / (4.0 * PI) * self.grid.element_area();
        let mut workspace = self.convolution.workspace();
        let mut displacement = vec![0.0; pressure.len()];
        let mut energy = 0.0;
        let dashpots = self.on_dashpots(pressure);
        for (element, loads) in material.creep().elements().iter().zip(dashpots) {
            self.convolution
                .apply(&mut workspace, &loads, &mut displacement);
            let pairs = loads.iter().zip(&displacement);
            let work: f64 = pairs.map(|(load, moved)| load * moved).sum();
            let passed = -(-2.0 * time / element.retardation_time).exp_m1();
            energy += 0.5 * passed * element.compliance * per_compliance * work;
        }
        energy
    }

    /// Relaxes the springs towards the pressure for a time.
    fn hold(&mut self, elastomer: &impl Elastomer, pressure: &[f64], time: f64) {
        let dashpots: Vec<Vec<f64>> = self.on_dashpots(pressure).collect();
        let creep = elastomer.material().creep();
        let pairs = creep.elements().iter().zip(dashpots);
        for ((element, loads), springs) in pairs.zip(&mut self.carried) {
            let passed = -(-time / element.retardation_time).exp_m1();
            for (spring, load) in springs.iter_mut().zip(loads) {
                *spring += passed * load;
            }
        }
    }
}

/// Motion from rest until the first touch is relaxed, and the number of steps of its last cycle.
fn cycles(
    layer: &impl Elastomer,
    load: &MovingLoad,
    (elements, spacing): Grids,
) -> (Vec<Motion>, usize) {
    let steps = load.steps(elements, spacing, 1e5).expect("steps");
    let start = load.stages()[0].start;
    let touch = 1e-3 * steps[0].duration;
    let motion = |time: f64, position: f64| Motion {
        time: touch + time,
        position: position - start.position,
        control: start.control,
    };
    let creep = layer.material().creep();
    let times = creep.elements().iter();
    let times = times.map(|element| element.retardation_time);
    let slowest = times.fold(0.0, f64::max);
    let count = whole_part(DURATION_OVER_RETARDATION_TIME * slowest / load.duration()) + 2;
    let all = (0..count).flat_map(|cycle| {
        let before = cycle as f64 * load.duration();
        let steps = steps.iter();
        steps.map(move |step| motion(before + step.end.time, step.end.position))
    });
    let motions = std::iter::once(motion(0.0, start.position)).chain(all);
    (motions.collect(), steps.len())
}

/// Energy that the dashpots dissipate in the last cycle, \[J].
fn heat_of_cycle(layer: &impl Elastomer, load: &MovingLoad, grids: Grids) -> f64 {
    let (elements, spacing) = grids;
    let (motions, per_cycle) = cycles(layer, load, grids);
    let half = 1.7 * elements as f64 * spacing;
    let footprint = Footprint::square(half);
    let options = GridOptions::new([spacing; 2], footprint);
    let body = ball();
    let mut march = March::new(&body, layer, &motions, &options).expect("a march");
    let positions = motions.iter().map(|motion| motion.position / spacing);
    let [rear, front] = positions.fold([0.0_f64; 2], |[rear, front], position| {
        [rear.min(position), front.max(position)]
    });
    let margin = 2 * elements;
    let shape = [whole_part(front - rear) + 2 * margin + 2, 2 * margin + 1];
    let mut springs = Springs::new(layer, shape, spacing);
    let (mut heat, mut before) = (0.0, 0.0);
    for (index, motion) in motions.iter().enumerate() {
        march.step().expect("a step").expect("not the last");
        let field = march.pressure().expect("a pressure");
        let places = (0..shape[0]).flat_map(|row| (0..shape[1]).map(move |column| [row, column]));
        let pressure = places.map(|[row, column]| {
            let x = (row as f64 - margin as f64 + rear.floor()) * spacing;
            let y = (column as f64 - margin as f64) * spacing;
            field.pressure_at([x - motion.position, y])
        });
        let pressure: Vec<f64> = pressure.collect();
        let time = motion.time - before;
        if index + per_cycle >= motions.len() {
            heat += springs.heat(layer, &pressure, time);
        }
        springs.hold(layer, &pressure, time);
        before = motion.time;
    }
    heat
}

/// That the front of the contact moves by elements costs both energies something of the first order in their length. The bar of
/// the work is that of the motion; that of the dashpots what half the elements change.
#[test]
fn the_work_of_a_cycle_is_dissipated_by_the_dashpots() {
    let solid = rubber();
    for (length, frequency, shape, thickness) in [
        (4e-3, 10.0, Shape::Sinusoidal, f64::INFINITY),
        (4e-4, 40.0, Shape::Sinusoidal, f64::INFINITY),
        (3e-3, 40.0, Shape::Triangular, 2e-3),
    ] {
        let layer = Layer::new(&solid, thickness).expect("a thickness");
        let stroke = Stroke {
            length,
            frequency,
            shape,
        };
        let control = Control::NormalForce(FORCE);
        let load = MovingLoad::reciprocating(control, stroke).expect("a motion");
        let fastest = SlidingLoad::new(FORCE, load.fastest()).expect("a load");
        let [coarse, fine] = [ELEMENTS / 2, ELEMENTS].map(|elements| {
            let grid = steady_grid(&ball(), &layer, &fastest, elements).expect("a grid");
            heat_of_cycle(&layer, &load, (elements, grid.spacing[0]))
        });
        let heat = Estimate::new(2.0 * fine - coarse, (fine - coarse).abs());
        let cycle = move_along(&ball(), &layer, &load, Accuracy::Elements(ELEMENTS - 2));
        let energy = cycle.expect("a cycle").dissipated_energy.expect("energy");
        let what = (length, frequency, thickness);
        assert_bars_agree(what, energy, heat);
        let bars = energy.error + heat.error;
        assert!(bars < 0.1 * energy.value, "{what:?}: {energy:?}, {heat:?}");
    }
}
