//! Derivatives against differences of solutions on one and the same grid, whose contact does not change.

use std::f64::consts::PI;

use indenters::{Cylinder, FlatCone, PowerProfile, Surface};
use rheology::{Compressible, Elastic, Prony, RelaxationBranch, RelaxationSpectrum, Viscous};

use super::*;
use crate::stationary::steady::{SteadyBody, SteadySliding, steady, steady_grid};
use crate::{Footprint, Layer};

/// Relative step of the differences.
const STEP: f64 = 1e-6;

fn prony(scale: f64, time: f64, poisson_ratio: f64) -> Compressible {
    let branch = |modulus, relaxation_time| RelaxationBranch {
        modulus,
        relaxation_time,
    };
    let branches = vec![branch(3.0 * scale, time), branch(2.0, 1.0)];
    let spectrum = RelaxationSpectrum::new(1.0, 0.0, branches).expect("a spectrum");
    let material = Prony::new(spectrum).expect("a material");
    Compressible::new(&material, poisson_ratio).expect("a material")
}

/// Factors of the numbers of a problem: curvature, a modulus, its time, Poisson ratio, thickness, load, velocity, track.
type Factors = [f64; 8];

struct Case {
    name: &'static str,
    body: fn(f64) -> Box<dyn Surface>,
    thickness: f64,
    control: Control,
    flows: bool,
    track: Option<f64>,
}

impl Case {
    fn material(&self, factors: &Factors) -> Compressible {
        if self.flows {
            let viscous = Viscous::new(factors[1]).expect("a material");
            return Compressible::new(&viscous, 0.3 * factors[3]).expect("a material");
        }
        prony(factors[1], 0.3 * factors[2], 0.3 * factors[3])
    }

    fn load(&self, factors: &Factors) -> SlidingLoad {
        let velocity = 2.0 * factors[6];
        let load = match self.control {
            Control::NormalForce(force) => SlidingLoad::new(force * factors[5], velocity),
            Control::IndentationDepth(depth) => SlidingLoad::at_depth(depth * factors[5], velocity),
        };
        let on_track = |load: SlidingLoad| match self.track {
            Some(track) => load.on_track(track * factors[7]),
            None => Ok(load),
        };
        load.and_then(on_track).expect("a load")
    }

    fn state(
        &self,
        factors: &Factors,
        options: SteadyOptions,
        start: Option<&SteadySliding>,
    ) -> (SensitivityOnGrid, SteadySliding) {
        let (surface, material) = ((self.body)(factors[0]), self.material(factors));
        let layer = Layer::new(&material, self.thickness * factors[4]).expect("a layer");
        let loading = Loading::new(&*surface, &layer, &self.load(factors), &options.footprint);
        let mut reuse = Reuse {
            solution: start.cloned(),
            ..Reuse::default()
        };
        let (loading, phases) = (loading.expect("a loading"), [options.phase]);
        let state =
            SensitivityOnGrid::on_shifted_grids(&*surface, &loading, &options, &phases, &mut reuse);
        let state = state.expect("a state");
        (state, reuse.solution.expect("a solution"))
    }

    /// Friction, and depth or force.
    fn solved(&self, factors: &Factors, options: SteadyOptions, start: &SteadySliding) -> [f64; 2] {
        let (state, found) = self.state(factors, options, Some(start));
        let other = match self.control {
            Control::NormalForce(_) => found.depth.at_distance(None),
            Control::IndentationDepth(_) => found.normal_force,
        };
        [state.friction_coefficient(), other]
    }
}

/// What of a problem a factor changes.
const NAMES: [&str; 8] = [
    "curvature",
    "modulus",
    "time",
    "ratio",
    "thickness",
    "load",
    "velocity",
    "track",
];

fn changed(case: &Case, state: &SensitivityOnGrid, index: usize) -> Change<f64> {
    let ends = [-STEP, STEP].map(|step| {
        let mut factors = [1.0; 8];
        factors[index] += step;
        factors
    });
    let materials = ends.map(|factors| case.material(&factors));
    let change = match NAMES[index] {
        "curvature" => {
            let bodies = ends.map(|factors| (case.body)(factors[0]));
            state.between_bodies(bodies.each_ref().map(|body| &**body))
        }
        "load" => {
            let [Control::NormalForce(given) | Control::IndentationDepth(given)] = [case.control];
            Ok(scaled(state.by_load(), 2.0 * STEP * given))
        }
        "track" => Ok(scaled(
            state.changes(|gradient| gradient.kernel.by_log_track),
            2.0 * STEP,
        )),
        name => {
            let creeps = [0, 1].map(|end| {
                let thickness = case.thickness * ends[end][4];
                let layer = Layer::new(&materials[end], thickness).expect("a layer");
                SlidingCreep::new(&layer, case.load(&ends[end]).velocity()).expect("a creep")
            });
            match name {
                "ratio" | "thickness" => state
                    .to_elastomer(&creeps[1])
                    .map(|found| scaled(found, 2.0)),
                _ => state.between_creeps(&creeps),
            }
        }
    };
    change.expect("a change")[0]
}

/// Changes of the friction, and of the depth or the force.
fn values(change: &Change<f64>) -> [f64; 2] {
    let other = change.indentation_depth.or(change.normal_force);
    [change.friction_coefficient, other.unwrap_or(0.0)]
}

fn scaled(changes: Vec<Change<f64>>, factor: f64) -> Vec<Change<f64>> {
    let changes = changes.iter();
    changes
        .map(|change| change.map(|value| factor * value))
        .collect()
}

fn cases() -> [Case; 6] {
    let paraboloid =
        |factor| Box::new(PowerProfile::paraboloid(factor).expect("a body")) as Box<dyn Surface>;
    let cone =
        |factor| Box::new(PowerProfile::cone(0.3 * factor).expect("a body")) as Box<dyn Surface>;
    let flat =
        |factor| Box::new(FlatCone::new(0.3, 0.3 * factor).expect("a body")) as Box<dyn Surface>;
    let case = |name, body, control| Case {
        name,
        body,
        thickness: f64::INFINITY,
        control,
        flows: false,
        track: None,
    };
    let force = Control::NormalForce(4.0);
    [
        case("paraboloid", paraboloid, force),
        case("cone", cone, Control::IndentationDepth(0.3)),
        Case {
            thickness: 0.8,
            ..case("layer", paraboloid, force)
        },
        Case {
            flows: true,
            ..case("dashpot", paraboloid, force)
        },
        case("flat cone", flat, Control::NormalForce(1.0)),
        Case {
            track: Some(8.0),
            ..case("track", paraboloid, force)
        },
    ]
}

/// Derivatives of friction, and of depth or force, by differences and by the adjoint loads.
fn compared(case: &Case, index: usize, options: SteadyOptions) -> [[f64; 2]; 2] {
    let (mut state, solution) = case.state(&[1.0; 8], options, None);
    if let Some(dilation) = &mut state.contacts[0].dilation {
        dilation.defects = dilation.defects.map(|_| 0.0);
    }
    let ends = [-STEP, STEP].map(|step| {
        let mut factors = [1.0; 8];
        factors[index] += step;
        case.solved(&factors, options, &solution)
    });
    let change = changed(case, &state, index);
    let has_other = change.indentation_depth.or(change.normal_force).is_some();
    let got = values(&change).map(|change| change / STEP);
    [0, 1].map(|quantity| {
        let expected = (ends[1][quantity] - ends[0][quantity]) / STEP;
        if quantity == 0 || has_other {
            [expected, got[quantity]]
        } else {
            [expected; 2]
        }
    })
}

/// The place of the gap in an element follows material and velocity, and the derivatives leave that out, which vanishes with
/// the elements.
#[test]
fn derivatives_are_those_of_the_equations_on_the_grid() {
    let side = [-1.7, 1.7];
    let mut options = SteadyOptions::new([0.05; 2], Footprint { x: side, y: side });
    options.tolerance = 1e-12;
    for case in cases() {
        let (state, solution) = case.state(&[1.0; 8], options, None);
        let found = if case.flows {
            solution.friction_coefficient
        } else {
            solution.friction_from_dissipation
        };
        let off = (state.friction_coefficient() - found).abs();
        assert!(off < 1e-11, "{}: {off:e}", case.name);
        let rows = [0, 1, 2, 3, 4, 5, 6, 7].map(|index| compared(&case, index, options));
        for quantity in 0..2 {
            let sizes = rows.iter().map(|row| row[quantity][0].abs());
            let largest = sizes.fold(0.0, f64::max);
            for (row, name) in rows.iter().zip(NAMES) {
                let [expected, got] = row[quantity];
                let moves = ["modulus", "time", "velocity"].contains(&name);
                let allowed = if moves { 6e-3 } else { 2e-6 };
                assert!(
                    (got - expected).abs() < allowed * largest,
                    "{}, {name}, {quantity}: {got:e} instead of {expected:e}, largest {largest:e}",
                    case.name
                );
            }
        }
    }
}

/// The change of the complex modulus from one material to another, weighted by the derivatives at each frequency: for both
/// quantities, with the sum of the absolute values.
fn by_frequencies(
    case: &Case,
    state: &SensitivityOnGrid,
    index: usize,
    options: SteadyOptions,
) -> [[f64; 2]; 2] {
    const PER_DECADE: f64 = 40.0;
    let materials = [-STEP, STEP].map(|step| {
        let mut factors = [1.0; 8];
        factors[index] += step;
        case.material(&factors)
    });
    let last = 20.0 * PI * 2.0 / options.spacing[0];
    let edges = (-240..).map(|index| 10.0_f64.powf(f64::from(index) / PER_DECADE));
    let edges = edges.take_while(|edge| *edge < last);
    let edges: Vec<f64> = [0.0].into_iter().chain(edges).collect();
    let bands: Vec<[f64; 2]> = edges.windows(2).map(|ends| [ends[0], ends[1]]).collect();
    let found = bands.iter().map(|band| {
        let by_moduli = state.by_moduli(*band).expect("derivatives");
        by_moduli.map(|changes| changes[0])
    });
    let [mut sums, mut sizes] = [[0.0; 2]; 2];
    for ([from, to], derivatives) in bands.iter().zip(found) {
        let [before, after] = materials.each_ref().map(|material| {
            let modulus = material.complex_modulus((from * to).sqrt().max(1e-3 * to));
            let modulus = modulus.expect("a modulus");
            [modulus.storage, modulus.loss]
        });
        for part in 0..2 {
            let change = if before[part] > 0.0 {
                (after[part] / before[part]).ln()
            } else {
                0.0
            };
            let parts = values(&derivatives[part]);
            for quantity in 0..2 {
                sums[quantity] += change * parts[quantity] / STEP;
                sizes[quantity] += (change * parts[quantity] / STEP).abs();
            }
        }
    }
    [sums, sizes]
}

/// Waves are another way to the same number: those of a modulus, of a time and of the unit of stress.
#[test]
fn derivatives_by_frequencies_add_up_to_those_by_moduli_and_times() {
    let side = [-1.7, 1.7];
    let options = SteadyOptions::new([0.05; 2], Footprint { x: side, y: side });
    for case in cases() {
        let (state, _) = case.state(&[1.0; 8], options, None);
        if case.track.is_some() {
            let refused = state.by_moduli([0.0, 1.0]);
            assert!(matches!(refused, Err(BemError::Indenter(_))), "waves");
            continue;
        }
        for index in [1, 2] {
            let expected = values(&changed(&case, &state, index));
            let [got, sizes] = by_frequencies(&case, &state, index, options);
            for quantity in 0..2 {
                let [expected, got] = [expected[quantity] / STEP, got[quantity]];
                assert!(
                    (got - expected).abs() <= 1e-4 * sizes[quantity],
                    "{}, {}: {got:e} instead of {expected:e}",
                    case.name,
                    NAMES[index]
                );
            }
        }
    }
}

/// A cylinder is a strip of one long element across the motion.
#[test]
fn frequencies_of_a_cylinder_add_up_to_the_unit_of_stress() {
    for thickness in [f64::INFINITY, 0.5] {
        a_cylinder_adds_up(thickness);
    }
}

/// Whether finer grids are solved must not depend on the unit of length: the relative errors are the same.
#[test]
fn derivatives_of_a_cylinder_do_not_depend_on_the_unit_of_length() {
    let branch = RelaxationBranch {
        modulus: 3.0,
        relaxation_time: 0.3,
    };
    let spectrum = RelaxationSpectrum::new(1.0, 0.0, vec![branch]).expect("a spectrum");
    let material = Prony::new(spectrum).expect("a material");
    let in_unit = |unit: f64| {
        let cylinder = Cylinder::new(unit).expect("a body");
        let load = SlidingLoad::new(0.5 * unit, 2.0 * unit).expect("a load");
        let options = SteadyOptions {
            tolerance: 1e-10,
            max_iterations: 100,
            ..SteadyOptions::new([0.02 * unit; 2], Footprint::square(1.5 * unit))
        };
        let near = SteadySensitivity::new(SteadyBody::Line(&cylinder), &material, &load, &options);
        let by_load = near.expect("a sensitivity").by_load().friction_coefficient;
        by_load.error / by_load.value
    };
    let [expected, actual] = [1.0, 1e-9].map(in_unit);
    assert!(
        (actual / expected - 1.0).abs() < 1e-3,
        "{actual} instead of {expected}"
    );
}

fn a_cylinder_adds_up(thickness: f64) {
    let cylinder = Cylinder::new(1.0).expect("a body");
    let materials = [1.0, 1.0 + STEP].map(|scale| {
        let branches = vec![RelaxationBranch {
            modulus: 3.0 * scale,
            relaxation_time: 0.3,
        }];
        let spectrum = RelaxationSpectrum::new(scale, 0.0, branches).expect("a spectrum");
        Prony::new(spectrum).expect("a material")
    });
    let load = SlidingLoad::new(0.5, 2.0).expect("a load");
    let options = SteadyOptions {
        tolerance: 1e-10,
        max_iterations: 100,
        ..SteadyOptions::new([0.02; 2], Footprint::square(1.5))
    };
    let [layer, stiffer] = materials
        .each_ref()
        .map(|material| Layer::new(material, thickness).expect("a layer"));
    let sensitivity = SteadySensitivity::new(SteadyBody::Line(&cylinder), &layer, &load, &options);
    let sensitivity = sensitivity.expect("a sensitivity");
    let change = sensitivity.to_elastomer(&stiffer, 2.0);
    let expected = change.expect("a change").friction_coefficient.value / STEP;
    let ends = [0.9, 1.1].map(|factor| {
        let load = SlidingLoad::new(0.5 * factor, 2.0).expect("a load");
        let answer = steady(SteadyBody::Line(&cylinder), &layer, &load, 1e-4).expect("an answer");
        answer.friction_coefficient.value
    });
    let slope = (ends[1] / ends[0]).ln() / (1.1_f64 / 0.9).ln();
    let by_load = 0.5 * sensitivity.by_load().friction_coefficient.value;
    let by_load = by_load / sensitivity.friction_coefficient().value;
    assert!(
        (by_load - slope).abs() < 5e-3,
        "{thickness}: {by_load} instead of {slope}"
    );
    let bands = sensitivity.by_moduli(&[0.0, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4]);
    let parts = bands.expect("bands").into_iter().map(|band| {
        let by = [band.storage_modulus, band.loss_modulus];
        by.map(|change| change.friction_coefficient.value)
    });
    let parts: Vec<f64> = parts.flatten().collect();
    let got: f64 = parts.iter().sum();
    let size: f64 = parts.iter().map(|part| part.abs()).sum();
    assert!(
        (got - expected).abs() < 1e-4 * size,
        "{thickness}: {got:e} instead of {expected:e}"
    );
}

/// On every grid, where without the motion of the contact the power of a paraboloid on a dashpot, μ ∝ F^½, is off by 7 %.
#[test]
fn derivatives_add_up_in_units_of_length() {
    let side = [-1.7, 1.7];
    let options = SteadyOptions::new([0.05; 2], Footprint { x: side, y: side });
    for case in cases().iter().filter(|case| case.name != "flat cone") {
        let (state, solution) = case.state(&[1.0; 8], options, None);
        let by_logarithm = NAMES.map(|name| {
            let index = NAMES.iter().position(|other| *other == name);
            let change = changed(case, &state, index.expect("a name"));
            values(&change).map(|change| 0.5 * change / STEP)
        });
        let [curvature, _, _, _, thickness, load, velocity, track] = by_logarithm;
        let powers = match case.control {
            _ if case.flows => [-1.0, 2.0, 0.0],
            Control::NormalForce(_) => [-1.0, 2.0, solution.depth.at_distance(None)],
            Control::IndentationDepth(_) => [0.0, 1.0, 2.0 * solution.normal_force],
        };
        let expected = [0.0, powers[2]];
        for quantity in 0..2 {
            let layer = if case.thickness.is_finite() {
                thickness[quantity]
            } else {
                0.0
            };
            let sum = powers[0] * curvature[quantity] + powers[1] * load[quantity];
            let sum = sum + velocity[quantity] + layer + track[quantity];
            let off = (sum - expected[quantity]).abs();
            let size = solution.friction_coefficient + expected[quantity];
            assert!(off < 1e-5 * size, "{}, {quantity}: {sum:e}", case.name);
        }
        if case.flows {
            let power = load[0] / state.friction_coefficient();
            assert!((power - 0.5).abs() < 1e-6, "{power} instead of 1/2");
        }
    }
}

/// Against differences of areas with bars, over a factor that is wide enough for them.
#[test]
fn derivatives_of_areas_are_those_of_counted_ones() {
    const WIDE: f64 = 1.5;
    let side = [-1.7, 1.7];
    let options = SteadyOptions::new([0.05; 2], Footprint { x: side, y: side });
    let cases = cases();
    let cases = cases.iter().filter(|case| case.name != "flat cone");
    // All cases have the derivative by the body; those by modulus and load take turns with those by time and velocity.
    let turns = [&[0, 1, 5][..], &[0, 2, 6]];
    for (case, indices) in cases.zip(turns.into_iter().cycle()) {
        let grids = |factor: f64| SteadyOptions {
            spacing: options.spacing.map(|spacing| factor * spacing),
            ..options
        };
        let states =
            [1.0, COARSE_SPACING_FACTOR].map(|factor| case.state(&[1.0; 8], grids(factor), None).0);
        let area = |factors: &Factors| {
            let (body, material) = ((case.body)(factors[0]), case.material(factors));
            let layer = Layer::new(&material, case.thickness * factors[4]).expect("a layer");
            let found = steady(&*body, &layer, &case.load(factors), 1e-3).expect("an answer");
            found.contact_area
        };
        for &index in indices {
            let [fine, coarse] = [0, 1].map(|grid| changed(case, &states[grid], index));
            let got = EXTRAPOLATION
                .limit_of_single(fine, coarse)
                .contact_area
                .expect("an area")
                * (0.5 / STEP);
            let ends = [WIDE.recip(), WIDE].map(|factor| {
                let mut factors = [1.0; 8];
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
            let is_near = off < allowed + got.error && off < 0.07;
            assert!(
                is_near,
                "{}, {}: {got:?} instead of {expected}",
                case.name, NAMES[index]
            );
        }
    }
}

/// Under Hertz's pressure the effective area is 8/9 of π a², with a³ = 3 F R/(16 G), and in plane strain 3 π²/16 a, with
/// a² = F R/(π G).
#[test]
fn effective_areas_are_those_of_hertz() {
    let rubber = Elastic::new(1.0).expect("a material");
    let load = SlidingLoad::new(0.1, 1.0).expect("a load");
    let ball = PowerProfile::paraboloid(0.5).expect("a body");
    let options = steady_grid(&ball, &rubber, &load, 24).expect("a grid");
    let state = SensitivityOnGrid::new(&ball, &rubber, &load, &options).expect("a state");
    let radius = (3.0 * 0.1 / 16.0_f64).cbrt();
    let roll = Cylinder::new(1.0).expect("a body");
    let options = steady_grid(SteadyBody::Line(&roll), &rubber, &load, 48).expect("a grid");
    let line =
        SensitivityOnGrid::new(SteadyBody::Line(&roll), &rubber, &load, &options).expect("a state");
    let half_width = (0.1 / PI).sqrt();
    for (state, expected) in [
        (state, 8.0 / 9.0 * PI * radius * radius),
        (line, 3.0 * PI * PI / 16.0 * half_width),
    ] {
        let found = state.effective_area();
        assert!(
            (found / expected - 1.0).abs() < 0.01,
            "{found} for {expected}"
        );
        let force = state.normal_force();
        assert!((force / 0.1 - 1.0).abs() < 1e-9, "{force}");
    }
}
