//! Derivatives of periodic surfaces against differences of solutions on one and the same grid.

use bem_halfspace::indenters::rough::{PeriodicSurface, SelfAffine};
use bem_halfspace::periodic::sensitivity::PeriodicSensitivity;
use bem_halfspace::periodic::{self, steady_on_grid};
use bem_halfspace::rheology::{Compressible, Prony, RelaxationBranch, RelaxationSpectrum};
use bem_halfspace::steady::sensitivity::Change;
use bem_halfspace::{Grid, Layer, PeriodicLoad, PeriodicOptions, PressureField};
use numerics::{Accuracy, Estimate};

const SHAPE: [usize; 2] = [64, 48];
/// Relative step of the differences.
const STEP: f64 = 1e-6;
/// Height, a modulus, its time, Poisson ratio, thickness, load, velocity, and the periods along both axes.
const NAMES: [&str; 9] = [
    "height",
    "modulus",
    "time",
    "ratio",
    "thickness",
    "load",
    "velocity",
    "period along x",
    "period along y",
];
type Factors = [f64; 9];

#[derive(Clone, Copy)]
enum Held {
    Pressure,
    Depth,
}

struct Case {
    thickness: f64,
    held: Held,
    mean_pressure: f64,
}

impl Case {
    fn surface(&self, factors: &Factors) -> PeriodicSurface {
        let surface = SelfAffine {
            period: [1.0, 0.8],
            hurst_exponent: 0.8,
            rms_slope: 0.1 * factors[0],
            longest_wavelength: 0.6,
            shortest_wavelength: 0.15,
            roll_off_wavelength: 0.6,
            seed: 3,
        };
        let surface = surface.surface().expect("a surface");
        // The same waves on stretched periods.
        let [length, width] = surface.period();
        let period = [length * factors[7], width * factors[8]];
        PeriodicSurface::new(period, surface.waves().to_vec()).expect("a surface")
    }

    fn material(&self, factors: &Factors) -> Compressible {
        let branches = vec![
            RelaxationBranch::new(3.0 * factors[1], 0.05 * factors[2]),
            RelaxationBranch::new(2.0, 0.5),
        ];
        let spectrum = RelaxationSpectrum::new(1.0, 0.0, branches).expect("a spectrum");
        let material = Prony::new(spectrum).expect("a material");
        Compressible::new(&material, 0.3 * factors[3]).expect("a material")
    }

    fn load(&self, factors: &Factors) -> PeriodicLoad {
        let velocity = factors[6];
        match self.held {
            Held::Pressure => PeriodicLoad::new(self.mean_pressure * factors[5], velocity),
            Held::Depth => PeriodicLoad::at_depth(-0.008 * factors[5], velocity),
        }
        .expect("a load")
    }

    /// Friction, and depth or force.
    fn solved(&self, factors: &Factors) -> [f64; 2] {
        let surface = self.surface(factors);
        let spacing = [0, 1].map(|axis| surface.period()[axis] / SHAPE[axis] as f64);
        let grid = Grid::new(SHAPE, spacing).expect("a grid");
        let heights = surface.heights(SHAPE).expect("heights");
        let material = self.material(factors);
        let layer = Layer::new(&material, self.thickness * factors[4]).expect("a layer");
        let options = PeriodicOptions {
            tolerance: 1e-11,
            max_applications: 100_000,
        };
        let found = steady_on_grid(&grid, &heights, &layer, &self.load(factors), &options);
        let found = found.expect("a state");
        let force: f64 = found.pressure.pressure.iter().sum::<f64>() * grid.element_area();
        let other = match self.held {
            Held::Pressure => found.mean_depth,
            Held::Depth => force,
        };
        [found.friction_from_dissipation, other]
    }
}

fn changed(case: &Case, near: &PeriodicSensitivity, index: usize) -> Change<Estimate> {
    let ends = [-STEP, STEP].map(|step| {
        let mut factors = [1.0; 9];
        factors[index] += step;
        factors
    });
    let materials = ends.each_ref().map(|factors| case.material(factors));
    let velocities = ends.map(|factors| factors[6]);
    let change = match NAMES[index] {
        "height" | "period along x" | "period along y" => {
            let [from, to] = ends.map(|factors| case.surface(&factors));
            near.between_surfaces([&from, &to])
        }
        "load" => {
            let given = match case.held {
                Held::Pressure => case.mean_pressure,
                Held::Depth => -0.008,
            };
            let by_load = near.by_load();
            Ok(by_load.map(|known| *known * (2.0 * STEP * given)))
        }
        "ratio" | "thickness" => {
            let layers = [0, 1].map(|end| {
                let thickness = case.thickness * ends[end][4];
                Layer::new(&materials[end], thickness).expect("a layer")
            });
            near.between_elastomers([&layers[0], &layers[1]], velocities)
        }
        _ => near.between_materials([&materials[0], &materials[1]], velocities),
    };
    change.expect("a change")
}

fn values(change: &Change<Estimate>) -> [f64; 2] {
    let other = change.indentation_depth.or(change.normal_force);
    [
        change.friction_coefficient.value,
        other.expect("another quantity").value,
    ]
}

/// A pressure from which the contact is found.
fn start(shape: [usize; 2]) -> PressureField {
    let spacing = [0, 1].map(|axis| [1.0, 0.8][axis] / shape[axis] as f64);
    PressureField {
        grid: Grid::new(shape, spacing).expect("a grid"),
        origin: [0.0; 2],
        pressure: vec![0.01; shape[0] * shape[1]],
    }
}

fn near(case: &Case) -> PeriodicSensitivity {
    let ones = [1.0; 9];
    let (surface, material) = (case.surface(&ones), case.material(&ones));
    let layer = Layer::new(&material, case.thickness).expect("a layer");
    PeriodicSensitivity::new(&surface, &layer, &case.load(&ones), &start(SHAPE))
        .expect("derivatives")
}

const CASES: [Case; 5] = [
    Case {
        thickness: f64::INFINITY,
        held: Held::Pressure,
        mean_pressure: 0.02,
    },
    Case {
        thickness: f64::INFINITY,
        held: Held::Pressure,
        mean_pressure: 3.0,
    },
    Case {
        thickness: f64::INFINITY,
        held: Held::Depth,
        mean_pressure: 0.0,
    },
    Case {
        thickness: 0.1,
        held: Held::Pressure,
        mean_pressure: 0.05,
    },
    Case {
        thickness: 0.1,
        held: Held::Depth,
        mean_pressure: 0.0,
    },
];

/// The place of the gap in an element follows material and velocity, which derivatives leave out.
#[test]
fn derivatives_are_those_of_the_equations_on_the_grid() {
    for (number, case) in CASES.iter().enumerate() {
        let near = near(case);
        let rows: Vec<[[f64; 2]; 2]> = (0..NAMES.len())
            .map(|index| {
                let got = values(&changed(case, &near, index)).map(|change| change / STEP);
                let ends = [-STEP, STEP].map(|step| {
                    let mut factors = [1.0; 9];
                    factors[index] += step;
                    case.solved(&factors)
                });
                [0, 1].map(|quantity| {
                    [
                        (ends[1][quantity] - ends[0][quantity]) / STEP,
                        got[quantity],
                    ]
                })
            })
            .collect();
        for quantity in 0..2 {
            let largest = rows
                .iter()
                .map(|row| row[quantity][0].abs())
                .fold(0.0, f64::max);
            for (row, name) in rows.iter().zip(NAMES) {
                let [expected, got] = row[quantity];
                let moves = ["modulus", "time", "velocity", "period along x"].contains(&name);
                let allowed = if moves { 2e-3 } else { 1e-5 } * largest + 1e-9;
                assert!(
                    (got - expected).abs() < allowed,
                    "{number}, {name}, {quantity}: {got:e} instead of {expected:e}, largest {largest:e}"
                );
            }
        }
    }
}

/// Moduli and pressure in another unit of stress leave friction, area and depth as they are.
#[test]
fn derivatives_by_frequencies_add_up_to_the_unit_of_stress() {
    for case in CASES
        .iter()
        .filter(|case| matches!(case.held, Held::Pressure))
    {
        let near = near(case);
        let frequencies = [0.0, 1.0, 10.0, 100.0, 1e4];
        let bands = near.by_moduli(&frequencies).expect("bands");
        let by_load = near.by_load();
        let of = |quantity: fn(&Change<Estimate>) -> f64| {
            let by_pressure = case.mean_pressure * quantity(&by_load);
            let parts = bands.iter().flat_map(|band| {
                [
                    quantity(&band.storage_modulus),
                    quantity(&band.loss_modulus),
                ]
            });
            let parts: Vec<f64> = parts.chain([by_pressure]).collect();
            let sum: f64 = parts.iter().sum();
            let size: f64 = parts.iter().map(|part| part.abs()).sum();
            // In full contact the depth depends on no modulus: what is left are 1e-8 of the heights.
            assert!(sum.abs() < 1e-6 * size + 1e-10, "{parts:?}");
        };
        of(|change| change.friction_coefficient.value);
        of(|change| change.indentation_depth.expect("a depth").value);
        of(|change| change.contact_area.expect("an area").value);
    }
}

/// Against differences of areas with bars, over a factor that is wide enough for them.
#[test]
fn derivatives_of_areas_are_those_of_counted_ones() {
    const WIDE: f64 = 1.3;
    let case = &CASES[0];
    let ones = [1.0; 9];
    let near = {
        let (surface, material) = (case.surface(&ones), case.material(&ones));
        PeriodicSensitivity::new(&surface, &material, &case.load(&ones), &start([192; 2]))
    };
    let near = near.expect("derivatives");
    let area = |factors: &Factors| {
        let (surface, material) = (case.surface(factors), case.material(factors));
        let found = periodic::steady(
            &surface,
            &material,
            &case.load(factors),
            Accuracy::Elements(384),
        );
        let [length, width] = surface.period();
        found.expect("an answer").area_fraction * (length * width)
    };
    for index in [0, 1, 2, 5, 6, 7, 8] {
        let got = changed(case, &near, index).contact_area.expect("an area") * (0.5 / STEP);
        let ends = [WIDE.recip(), WIDE].map(|factor| {
            let mut factors = ones;
            factors[index] *= factor;
            area(&factors)
        });
        let width = 2.0 * WIDE.ln();
        let expected = (ends[1].value / ends[0].value).ln() / width;
        let allowed = ends
            .map(|end| end.error / end.value / width)
            .iter()
            .sum::<f64>();
        let off = (got.value - expected).abs();
        assert!(
            off < allowed + got.error,
            "{}: {got:?} instead of {expected}",
            NAMES[index]
        );
        assert!(
            off < 0.03,
            "{}: {got:?} instead of {expected}",
            NAMES[index]
        );
    }
}
