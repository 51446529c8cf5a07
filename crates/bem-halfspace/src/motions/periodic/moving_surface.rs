//! The motion of a periodic surface on one grid: in closed form in full contact, or by a march.
//!
//! The elements are fixed in the material, and the surface is shifted over them by any distance, since the grids resolve all its
//! waves. The pressure is constant in each step, as in [`crate::march::periodic`], and exact in full contact; a cycle in full contact
//! has a closed form. In partial contact the error is of the first order in the spacing, and so is that of the steps, which are
//! refined with the elements.
//!
//! Theory: docs/theory/transient-half-space.md, "Motions".

use std::cell::RefCell;
use std::f64::consts::TAU;

use indenters::rough::PeriodicSurface;
use indenters::{Control, MotionRecord, MotionStep, MovingLoad, MovingStep};
use numerics::{Accuracy, Estimate};
use rheology::Material as _;
use rustfft::num_complex::Complex;

use super::full_contact::{FullContactSurface, value_of_row};
use super::stresses::{Spectra, WaveMotion, WaveStates};
use super::{CONTACT_TOLERANCE, elements_of_motion, initial_shape};
use crate::march::MAX_STEPS;
use crate::march::periodic::PeriodicMarch;
use crate::motions::any_motion::LimitCycle;
use crate::stationary::periodic::fourier_multiplier::FourierMultiplier;
use crate::stationary::periodic::nested::interpolated;
use crate::stationary::periodic::perimeter_error::area_fraction;
use crate::substrate::base::check_unchanged_moduli;
use crate::{BemError, ContactOptions, Elastomer, Grid};

/// Largest product of the number of elements and the number of steps of a cycle or path. Chosen: grids with a larger product are
/// not used, so that a march takes at most a few minutes.
const MAX_ELEMENT_STEPS: f64 = 6e7;

/// The problem of a moving periodic surface, which can be solved on any number of elements.
pub(super) struct MovingSurface<'a> {
    /// Surface that moves.
    surface: &'a PeriodicSurface,
    /// Half space or layer under it.
    elastomer: &'a dyn Elastomer,
    /// Motion and load.
    load: &'a MovingLoad,
    /// Relaxation and creep spectrum of the material in shear.
    pub(super) spectra: Spectra,
    /// Wave number q_x by the number of waves in the period, \[rad/m].
    wave_numbers: Vec<f64>,
    /// Search for the limit cycle; `None` for a motion through points.
    pub(super) limit_cycle: Option<LimitCycle>,
    /// Shape of the last grid on which a limit cycle was found, with the history variables at its end, `[field][row][column]`.
    last_cycle: RefCell<Option<([usize; 2], Vec<f64>)>>,
}

/// A motion on one grid.
struct MotionOnGrid {
    /// Grid of one period.
    grid: Grid,
    /// Heights at the centres of the elements, \[m].
    heights: Vec<f64>,
    /// Time steps of the motion.
    steps: Vec<MovingStep>,
    /// Displacements and stresses of all waves along x over all steps.
    waves: WaveMotion,
}

/// Forces, depth and contact at the end of a step of the motion.
#[derive(Clone, Copy)]
struct StepEnd {
    /// Tangential force, \[N].
    tangential_force: f64,
    /// Normal force, \[N].
    normal_force: f64,
    /// Depth of the mean plane, \[m].
    depth: f64,
    /// Contact area with the error of its perimeter correction, \[m²].
    contact_area: Estimate,
    /// Number of elements in contact.
    n_contact: usize,
}

impl<'a> MovingSurface<'a> {
    /// Prepares a motion for all grids: spectra of the material, wave numbers along x, and the search for the limit cycle.
    ///
    /// # Errors
    /// [`BemError::DepthFromRest`] for a prescribed depth; [`BemError::NoCycle`] for a reciprocating motion on a material that flows;
    /// other errors for a material without finite spectra, and for too few elements.
    pub(super) fn new(
        surface: &'a PeriodicSurface,
        elastomer: &'a dyn Elastomer,
        load: &'a MovingLoad,
        accuracy: Accuracy,
    ) -> Result<Self, BemError> {
        // Find the spectra of the material. Refuse a reciprocating motion without a limit cycle, and what is not supported.
        check_unchanged_moduli(elastomer)?;
        let (relaxation, creep) = {
            let material = elastomer.material();
            (material.relaxation(), material.creep())
        };
        let limit_cycle = LimitCycle::new(load, &creep, accuracy)?;
        if matches!(load.largest_control(), Control::IndentationDepth(_)) {
            return Err(BemError::DepthFromRest);
        }
        elastomer.base().check_flow(creep.fluidity())?;
        // List the wave numbers of all waves along x, which are multiples of 2π over the period.
        let unit = TAU / surface.period()[0];
        let numbers = 0..=surface.largest_numbers()[0];
        let problem = Self {
            surface,
            elastomer,
            load,
            spectra: Spectra { relaxation, creep },
            wave_numbers: numbers.map(|number| number as f64 * unit).collect(),
            limit_cycle,
            last_cycle: RefCell::default(),
        };
        if let Accuracy::Elements(elements) = accuracy {
            problem.check_coarsest(elements)?;
        }
        Ok(problem)
    }

    /// Fails with [`BemError::PeriodTooCoarse`] if the coarsest grid of an error estimate, with three eighths of the elements, does not
    /// resolve all waves.
    fn check_coarsest(&self, elements: usize) -> Result<(), BemError> {
        let resolves_all_waves = |elements: usize| {
            let coarsest = (3 * elements).div_ceil(8);
            let numbers = self.surface.largest_numbers();
            let mut pairs = self.shape(coarsest).into_iter().zip(numbers);
            pairs.all(|(elements, number)| elements > 2 * number)
        };
        if resolves_all_waves(elements) {
            return Ok(());
        }
        let most = elements_of_motion(self.surface);
        let needed = (elements..=most).find(|elements| resolves_all_waves(*elements));
        Err(BemError::PeriodTooCoarse {
            elements,
            needed: needed.unwrap_or(most),
        })
    }

    /// Shape of a grid for a number of elements along its longer edge; both numbers are even.
    pub(super) fn shape(&self, elements: usize) -> [usize; 2] {
        let initial = initial_shape(self.surface);
        let longest = initial[0].max(initial[1]);
        initial.map(|edge| 2 * edge.saturating_mul(elements).div_ceil(2 * longest))
    }

    /// Edges of an element, \[m].
    fn spacing(&self, shape: [usize; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.surface.period()[axis] / shape[axis] as f64)
    }

    /// Largest number of steps on a grid of a shape: [`MAX_STEPS`], or fewer so that elements times steps are at most
    /// [`MAX_ELEMENT_STEPS`].
    fn max_steps(shape: [usize; 2]) -> f64 {
        let n_elements = shape.map(|n| n as f64).iter().product::<f64>();
        MAX_STEPS.min(MAX_ELEMENT_STEPS / n_elements)
    }

    /// Number of steps on a grid with a number of elements along its longer edge and their `shape`; fails for too many.
    pub(super) fn n_steps(&self, elements: usize, shape: [usize; 2]) -> Result<f64, BemError> {
        let [spacing, _] = self.spacing(shape);
        Ok(self
            .load
            .n_steps(elements, spacing, Self::max_steps(shape))?)
    }

    /// The largest number of elements along the longer edge, among doublings of `first`, whose steps are not too many.
    pub(super) fn max_elements(&self, first: usize) -> usize {
        let mut elements = first;
        while self.n_steps(2 * elements, self.shape(2 * elements)).is_ok() {
            elements *= 2;
        }
        elements
    }

    /// Area of the period, \[m²].
    fn area(&self) -> f64 {
        self.surface.period().iter().product()
    }

    /// Heights, steps and waves of the motion on a grid with a number of elements along its longer edge.
    fn on_grid(&self, elements: usize) -> Result<MotionOnGrid, BemError> {
        let shape = self.shape(elements);
        let spacing = self.spacing(shape);
        let max_steps = Self::max_steps(shape);
        let steps = self.load.steps(elements, spacing[0], max_steps)?;
        let waves = WaveMotion::new(self.load, &steps, &self.wave_numbers, &self.spectra)?;
        Ok(MotionOnGrid {
            heights: self.surface.heights(shape)?,
            grid: Grid::new(shape, spacing)?,
            steps,
            waves,
        })
    }

    /// True for a cycle in full contact, tested on twice the elements of the first estimate, to exclude gaps between elements.
    pub(super) fn is_full(&self) -> bool {
        let elements = 2 * elements_of_motion(self.surface);
        let fine = || self.on_grid(elements).ok();
        let found = self.load.is_cycle().then(fine).flatten();
        found.is_some_and(|fine| self.full_contact_on(&fine).is_full(&fine.waves))
    }

    /// The record of the motion on a grid with a number of elements along its longer edge: in closed form if the contact `is_full`,
    /// else by a march.
    pub(super) fn solve_on_grid(
        &self,
        elements: usize,
        is_full: bool,
        report: &dyn Fn(f64),
    ) -> Result<MotionRecord, BemError> {
        let on_grid = self.on_grid(elements)?;
        let spacing = on_grid.grid.spacing();
        let record = if is_full {
            self.full_contact_record(&on_grid)
        } else {
            self.follow_march(&on_grid, report)?
        };
        Ok(MotionRecord {
            spacing: spacing[0],
            rms_slope: self.surface.rms_slope(),
            ..record
        })
    }

    /// The surface in full contact on a grid, under the largest mean pressure of the motion.
    fn full_contact_on<'b>(&self, on_grid: &'b MotionOnGrid) -> FullContactSurface<'b> {
        FullContactSurface {
            grid: &on_grid.grid,
            heights: &on_grid.heights,
            waves: FourierMultiplier::new(&on_grid.grid, &self.elastomer.base()),
            factor: 0.5 * self.elastomer.material().half_space_factor(),
            mean_pressure: self.load.largest_control().value() / self.area(),
            largest_numbers: self.surface.largest_numbers(),
        }
    }

    /// Record of a cycle in which the contact is full all the time, in closed form.
    fn full_contact_record(&self, on_grid: &MotionOnGrid) -> MotionRecord {
        let closed = self.full_contact_on(on_grid);
        let compliance = closed.factor * self.spectra.creep.equilibrium_compliance();
        let depth =
            closed.mean_pressure * (compliance * self.elastomer.base().uniform_compliance());
        let found = closed.cycle(&on_grid.waves, &self.wave_numbers);
        let (normal_force, area) = (self.load.largest_control().value(), self.area());
        let end = |stress: &f64| StepEnd {
            tangential_force: stress * area,
            normal_force,
            depth,
            contact_area: Estimate::exact(area),
            n_contact: on_grid.grid.n_elements(),
        };
        // The limit cycle begins with the state in which it ends, so that the last state is repeated in front of the first one.
        let last = found.stresses.last();
        let ends: Vec<StepEnd> = last.into_iter().chain(&found.stresses).map(end).collect();
        let mut record = self.record(&ends, &on_grid.steps);
        record.work = found.work * area;
        record
    }

    /// Record of the motion on a grid by a march from the first touch, for a cycle in its limit cycle.
    fn follow_march(
        &self,
        on_grid: &MotionOnGrid,
        report: &dyn Fn(f64),
    ) -> Result<MotionRecord, BemError> {
        let (grid, heights, steps) = (&on_grid.grid, &on_grid.heights, &on_grid.steps);
        let touch = steps[0].duration;
        let mut march = PeriodicMarch::new(grid, heights, self.elastomer, touch)?;
        let start = self.load.stages()[0].start.control;
        let touched = self.solve_step(&mut march, grid, touch, start, &on_grid.waves.states[0])?;
        let Some(limit_cycle) = &self.limit_cycle else {
            let mut ends = vec![touched];
            ends.extend(self.solve_steps(&mut march, on_grid, report)?);
            return Ok(self.record(&ends, steps));
        };

        // The first cycle begins with the history variables after the first touch, or with those of the limit cycle on the
        // previous grid.
        let first = self.before_cycles(&march.history, grid.shape());
        let cycle = |from: &[f64], report: &dyn Fn(f64)| {
            march.history.copy_from_slice(from);
            let mut ends = self.solve_steps(&mut march, on_grid, report)?;
            // The limit cycle begins with the state in which it ends, so that the last state is repeated in front of the first
            // one.
            ends.insert(0, ends[ends.len() - 1]);
            Ok((self.record(&ends, steps), march.history.clone()))
        };
        let record = limit_cycle.find(first, cycle, report)?;
        self.last_cycle.replace(Some((grid.shape(), march.history)));
        Ok(record)
    }

    /// History variables before the first cycle on a grid of a `shape`: those of the first touch on the first grid, later those of the
    /// limit cycle on the previous grid, interpolated. A slow material has then nearly reached its limit cycle.
    fn before_cycles(&self, touched: &[f64], shape: [usize; 2]) -> Vec<f64> {
        let last_cycle = self.last_cycle.borrow();
        let Some((from, history)) = &*last_cycle else {
            return touched.to_vec();
        };
        let fields = history.chunks_exact(from[0] * from[1]);
        fields
            .flat_map(|field| interpolated(field, *from, shape))
            .collect()
    }

    /// Solves all steps of the path, or of one cycle, and returns the state at the end of each; `report` receives the fraction done.
    fn solve_steps(
        &self,
        march: &mut PeriodicMarch<'_>,
        MotionOnGrid {
            grid, steps, waves, ..
        }: &MotionOnGrid,
        report: &dyn Fn(f64),
    ) -> Result<Vec<StepEnd>, BemError> {
        let pairs = steps.iter().zip(&waves.states[1..]).enumerate();
        let end = |(index, (step, state)): (usize, (&MovingStep, &WaveStates))| {
            report(index as f64 / steps.len() as f64);
            self.solve_step(march, grid, step.duration, step.end.control, state)
        };
        pairs.map(end).collect()
    }

    /// Solves one step of a `duration` \[s] and returns the forces and the depth at its end, where the waves are in `state`.
    fn solve_step(
        &self,
        march: &mut PeriodicMarch<'_>,
        grid: &Grid,
        duration: f64,
        control: Control,
        state: &WaveStates,
    ) -> Result<StepEnd, BemError> {
        // Set the duration of the step, and the factors from the waves of the surface at the position 0 to those of heights and slopes at the end
        // of the step. The heights have the correction for pressures that are held over the step (`stresses.rs`), the slopes have none.
        let rows = march.rows();
        let waves = state.displacement.iter().zip(&self.wave_numbers);
        let slopes: Vec<Complex<f64>> = waves.map(|(u, q)| Complex::i() * q * u).collect();
        march.set_step(duration, |row| {
            [&state.with_held_pressure, &slopes].map(|values| value_of_row(values, row, rows))
        })?;
        // Solve the contact under the normal force, which the march needs as a mean pressure.
        let options = ContactOptions {
            tolerance: CONTACT_TOLERANCE,
            ..ContactOptions::default()
        };
        let normal_force = control.value();
        let row = march.step(normal_force / self.area(), &options)?;
        let presses = normal_force > 0.0;
        let area = area_fraction(grid, march.state.pressure(), self.surface);
        Ok(StepEnd {
            tangential_force: if presses {
                row.friction_coefficient * normal_force
            } else {
                0.0
            },
            normal_force,
            depth: row.mean_depth,
            contact_area: area * self.area(),
            n_contact: march.state.contact().len(),
        })
    }

    /// Record of a motion with the mean of each step, from the states `ends` before the first step and after each step.
    fn record(&self, ends: &[StepEnd], steps: &[MovingStep]) -> MotionRecord {
        // Record each step with the means of the states at its ends.
        let mut record = MotionRecord::default();
        let mut begin = self.load.stages()[0].start.position;
        for (step, ends) in steps.iter().zip(ends.windows(2)) {
            let mean = |of: fn(&StepEnd) -> f64| 0.5 * (of(&ends[0]) + of(&ends[1]));
            let distance = step.end.position - begin;
            let of_step = MotionStep {
                stage: step.stage,
                time: step.end.time - 0.5 * step.duration,
                position: begin + 0.5 * distance,
                tangential_force: mean(|end| end.tangential_force),
                normal_force: mean(|end| end.normal_force),
                indentation_depth: mean(|end| end.depth),
                contact_area: Some(Estimate::new(
                    mean(|end| end.contact_area.value),
                    mean(|end| end.contact_area.error),
                )),
                contact: None,
                n_contact: ends[1].n_contact,
            };
            record.push(of_step, distance);
            begin = step.end.position;
        }
        record
    }
}

#[cfg(test)]
mod tests {
    use indenters::rough::Wave;
    use indenters::{Shape, Stroke};
    use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};

    use super::super::move_along;
    use super::*;
    use crate::march::largest_retardation_time;

    /// Retardation times of the slowest element after which the first touch has relaxed.
    const MEMORIES: f64 = 8.0;

    fn surface() -> PeriodicSurface {
        let wave = |(numbers, amplitude, phase)| Wave {
            numbers,
            amplitude,
            phase,
        };
        let waves = [
            ([1, 0], 0.01, 0.2),
            ([2, -1], 0.01, 1.0),
            ([0, 2], 0.006, 2.0),
        ];
        PeriodicSurface::new([1.0; 2], waves.map(wave).to_vec()).expect("a surface")
    }

    fn rubber() -> Prony {
        let branch = |(modulus, relaxation_time)| RelaxationBranch {
            modulus,
            relaxation_time,
        };
        let branches = [(2.0, 0.1), (4.0, 0.02)].map(branch).to_vec();
        Prony::new(RelaxationSpectrum::new(1.0, 0.0, branches).expect("a spectrum"))
            .expect("a solid")
    }

    /// The test also covers the points between its elements and between its steps.
    #[test]
    fn a_cycle_is_full_where_none_of_its_pressures_is_a_tension() {
        let (surface, rubber) = (surface(), rubber());
        let stroke = Stroke {
            length: 0.3,
            frequency: 2.0,
            shape: Shape::Sinusoidal,
        };
        let is_full = |mean_pressure: f64, elements: Option<usize>| {
            let load = MovingLoad::reciprocating(Control::NormalForce(mean_pressure), stroke);
            let load = load.expect("a motion");
            let accuracy = Accuracy::RelativeError(0.1);
            let problem =
                MovingSurface::new(&surface, &rubber, &load, accuracy).expect("a problem");
            let Some(elements) = elements else {
                return problem.is_full();
            };
            let fine = problem.on_grid(elements).expect("a grid");
            problem.full_contact_on(&fine).is_full(&fine.waves)
        };
        let [mut low, mut high] = [0.1, 10.0];
        while high > 1.001 * low {
            let middle = f64::midpoint(low, high);
            let end = if is_full(middle, None) {
                &mut high
            } else {
                &mut low
            };
            *end = middle;
        }
        let finest = 8 * elements_of_motion(&surface);
        assert!(is_full(high, Some(finest)), "{high}");
        assert!(!is_full(0.95 * high, Some(finest)), "{high}");
    }

    /// What the dashpots take in the last cycle of many, as in `tests/it/dissipated_energy.rs`, \[J].
    fn heat(load: &MovingLoad, elements: usize) -> f64 {
        let (surface, rubber) = (surface(), rubber());
        let accuracy = Accuracy::Elements(elements);
        let problem = MovingSurface::new(&surface, &rubber, load, accuracy).expect("a problem");
        let MotionOnGrid {
            grid,
            heights,
            steps,
            waves,
        } = problem.on_grid(elements).expect("a grid");
        let mut march = PeriodicMarch::new(&grid, &heights, &rubber, 1e-4).expect("a march");
        let mut kernel = FourierMultiplier::new(&grid, &rubber.base());
        let creep = &problem.spectra.creep;
        let mut springs = vec![vec![0.0; heights.len()]; creep.elements().len()];
        let mut u = vec![0.0; heights.len()];
        let count = MEMORIES * largest_retardation_time(creep) / load.duration() + 2.0;
        let mut heat = 0.0;
        for _ in 0..numerics::whole_part(count) {
            heat = 0.0;
            for (step, state) in steps.iter().zip(&waves.states[1..]) {
                let _end = problem
                    .solve_step(&mut march, &grid, step.duration, step.end.control, state)
                    .expect("a contact");
                let pressure = march.state.pressure();
                for (element, springs) in creep.elements().iter().zip(&mut springs) {
                    let pairs = pressure.iter().zip(springs.iter());
                    let dashpot: Vec<f64> = pairs.map(|(all, spring)| all - spring).collect();
                    // Find the displacement that the pressures of the dashpot cause on an incompressible half space of the
                    // modulus 1.
                    kernel.apply(&dashpot, &mut u, |w| (0.5 / w.reduced_wave_number).into());
                    let work: f64 = dashpot.iter().zip(&u).map(|(p, u)| p * u).sum();
                    let times = step.duration / element.retardation_time;
                    let passed = -(-2.0 * times).exp_m1();
                    heat += 0.5 * passed * element.compliance * work * grid.element_area();
                    for (spring, rest) in springs.iter_mut().zip(dashpot) {
                        *spring -= (-times).exp_m1() * rest;
                    }
                }
            }
        }
        heat
    }

    /// The bar of the work is that of the motion, that of the dashpots what half the elements change.
    #[test]
    fn the_work_of_a_cycle_is_dissipated_by_the_dashpots() {
        for (length, frequency, shape) in [
            (0.3, 2.0, Shape::Sinusoidal),
            (0.02, 5.0, Shape::Sinusoidal),
            (0.5, 3.0, Shape::Triangular),
        ] {
            let stroke = Stroke {
                length,
                frequency,
                shape,
            };
            let load = MovingLoad::reciprocating(Control::NormalForce(0.2), stroke);
            let load = load.expect("a motion");
            let [coarse, fine] = [20, 40].map(|elements| heat(&load, elements));
            let heat = Estimate::new(2.0 * fine - coarse, (fine - coarse).abs());
            let cycle = move_along(&surface(), &rubber(), &load, Accuracy::Elements(36));
            let energy = cycle.expect("a cycle").dissipated_energy.expect("energy");
            let (apart, bars) = ((energy.value - heat.value).abs(), energy.error + heat.error);
            assert!(apart <= bars, "{stroke:?}: {energy:?}, {heat:?}");
            assert!(
                bars < 0.15 * energy.value,
                "{stroke:?}: {energy:?}, {heat:?}"
            );
        }
    }
}
