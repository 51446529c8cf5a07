//! The march of a periodic surface, and its sliding from rest.
//!
//! The elements move with the surface, and the material passes them by one element per step, or by a fraction of one. During a step
//! the pressure of each material point is held at its value at the end of the step:
//!
//! ```text
//! u = 2 (1 − ν) α w + H,        w = K p / (4π)        at the end of the step
//! ```
//!
//! Here u is the displacement, p the pressure and ν the Poisson ratio. α is the creep compliance after one step
//! ([`ExponentialStep::response`]), and H the displacement at the end of a step without load. K is the operator of the
//! influence coefficients; that of `stationary/periodic` contains the compliance of the material.
//!
//! *Correction for held pressures.* In the stationary state at the speed v, a wave of the wave number q_x has the frequency q_x v and the
//! complex compliance J. In the march it has another one, J_Δ, because its pressure is held ([`ExponentialStep::harmonic_response`]). The
//! heights of the march are therefore those of the surface with each wave multiplied by `held_ratio` = J_Δ/J: in full contact their
//! pressure is that of the stationary state. If the material mostly flows, the factor shifts the surface by half a step.
//!
//! *Fractions of elements.* The first step is shorter than the others, so that the last one ends at the sliding distance. At the end of a
//! step the surface may be a `shortfall` short of a whole number of elements, by which phase factors shift its waves.
//!
//! Theory: docs/theory/transient-half-space.md.

use std::f64::consts::PI;

use rheology::{CreepSpectrum, ExponentialStep, Material as _};
use rustfft::num_complex::Complex;

use crate::elements::area;
use crate::elements::grid::elements_along;
use crate::parallel::reductions::{add_scaled, dot, mean};
use crate::stationary::periodic::fourier_multiplier::FourierMultiplier;
use crate::stationary::periodic::kernel::MaterialAtSpeed;
use crate::stationary::periodic::{PeriodicLoad, check_surface};
use crate::substrate::base::check_unchanged_moduli;
use crate::transform::plane_transform::ZERO;
use crate::{
    Base, BemError, ContactOptions, ContactProblem, ContactState, Control, Convolution,
    ConvolutionWorkspace, Elastomer, GapField, Grid, PressureField, solve_contact,
};

/// The state at the end of a step of a periodic surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PeriodicRow {
    /// Sliding distance, \[m].
    pub sliding_distance: f64,
    /// Time, \[s].
    pub time: f64,
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Fraction of the period in contact, as in [`PeriodicSliding`](crate::PeriodicSliding).
    pub area_fraction: f64,
    /// Depth of the mean plane, as in [`PeriodicSliding`](crate::PeriodicSliding), \[m].
    pub mean_depth: f64,
}

/// A periodic surface that has slid from rest.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct PeriodicTransient {
    /// One entry for each step; the last is at the end of the distance.
    pub rows: Vec<PeriodicRow>,
    /// Pressure at the end, on the grid of the heights: its first element is at the origin.
    pub pressure: PressureField,
    /// Gap at the end, on the same grid.
    pub gap: GapField,
}

/// Presses a periodic surface into a material at rest and slides it over the sliding distance of the load, in steps of one element.
///
/// The first step is shorter if the distance is not a multiple of an element. `heights` are those of
/// [`steady_on_grid`](crate::periodic::steady_on_grid), whose state is reached after some contact lengths, once the slowest relevant
/// relaxation is over.
///
/// # Errors
/// [`BemError::InvalidParameter`] for a velocity of 0; [`BemError::SlidingDistanceMissing`]; [`BemError::DepthFromRest`];
/// [`BemError::GridTooLarge`] for a distance
/// of too many elements; otherwise those of [`steady_on_grid`](crate::periodic::steady_on_grid).
pub fn slide_on_grid(
    grid: &Grid,
    heights: &[f64],
    elastomer: &dyn Elastomer,
    load: &PeriodicLoad,
    options: &ContactOptions,
) -> Result<PeriodicTransient, BemError> {
    let steps = Steps {
        per_element: 1.0,
        options: *options,
        report: &|_| (),
    };
    slide_with(grid, heights, elastomer, load, &steps)
}

/// Steps in time of a march, and the accuracy of their contacts.
pub(crate) struct Steps<'a> {
    /// Number of steps per element of the distance, an integer.
    pub(crate) per_element: f64,
    /// Stopping criteria of the contact of each step.
    pub(crate) options: ContactOptions,
    /// Reports the finished fraction of the march.
    pub(crate) report: &'a dyn Fn(f64),
}

/// Like [`slide_on_grid`], with a number of steps per element, and with reports of the progress.
pub(crate) fn slide_with(
    grid: &Grid,
    heights: &[f64],
    elastomer: &dyn Elastomer,
    load: &PeriodicLoad,
    steps: &Steps,
) -> Result<PeriodicTransient, BemError> {
    check_surface(grid, heights)?;
    let ((mean_pressure, distance), velocity) = (load.require_march()?, load.velocity());
    let (steps_per_element, edge) = (steps.per_element, grid.spacing()[0]);
    let whole_step = edge / steps_per_element;
    // Prepare the march: the number of steps over the whole distance, the motion, and the elements of one period before the first
    // step.
    let n_steps = elements_along(distance, whole_step)?;
    let sliding = MaterialAtSpeed::new(elastomer, velocity)?;
    let mut march = PeriodicMarch::new(grid, heights, elastomer, edge / velocity)?;
    // Count the steps from the end of the distance, so that the last one ends there and the first one is the shorter one.
    let rows = (0..n_steps).rev().map(|left| {
        let (steps_after, is_first) = (left as f64, left + 1 == n_steps);
        let slid = distance - steps_after * whole_step;
        let steps_to_boundary = steps_after % steps_per_element;
        if is_first {
            march.set_sliding_step(&sliding, slid, steps_to_boundary * whole_step)?;
        } else if left + 2 == n_steps || steps_per_element > 1.0 {
            march.set_sliding_step(&sliding, whole_step, steps_to_boundary * whole_step)?;
        }
        // In the first step of each element the grid moves on by one element, so that the history variables shift. The surface is short of
        // the grid until the element is passed.
        if steps_to_boundary + 1.0 >= steps_per_element {
            march.shift_history();
        }
        let state = march.step(mean_pressure, &steps.options)?;
        (steps.report)(slid / distance);
        Ok(PeriodicRow {
            sliding_distance: slid,
            time: slid / velocity,
            ..state
        })
    });
    let rows: Vec<PeriodicRow> = rows.collect::<Result<_, BemError>>()?;
    // Every march has a step.
    let depth = rows.last().map_or(0.0, |last| last.mean_depth);
    Ok(PeriodicTransient {
        rows,
        gap: GapField {
            grid: *grid,
            origin: [0.0; 2],
            gap: march.take_gap(depth),
        },
        pressure: PressureField {
            grid: *grid,
            origin: [0.0; 2],
            pressure: march.state.pressure().to_vec(),
        },
    })
}

/// The elements of a period, with the history variables of the material under them.
pub(crate) struct PeriodicMarch<'a> {
    /// Heights of the surface at the centres of the elements, as given, \[m].
    given: &'a [f64],
    /// Creep spectrum of the material in shear.
    creep: CreepSpectrum,
    /// Transforms that multiply the waves of heights and slopes.
    waves: FourierMultiplier,
    /// Heights at the end of the step, filtered with the symbols of [`set_step`](Self::set_step), row-major, \[m].
    heights: Vec<f64>,
    /// Mean of the given heights, \[m].
    mean_height: f64,
    /// Slopes ∂h/∂x of the surface at the end of the step, row-major.
    slopes: Vec<f64>,
    /// Operator K on the period.
    convolution: Convolution,
    /// Buffers for applying K.
    workspace: ConvolutionWorkspace,
    /// Pressure of the last step.
    pub(crate) state: ContactState,
    /// Coefficients of the creep law over the present step.
    step: ExponentialStep,
    /// Factor 2 (1 − ν) from α w to the displacement.
    half_space_factor: f64,
    /// History variables of all elements, `[field][row][column]`.
    pub(crate) history: Vec<f64>,
    /// Initial gap h + H, at zero depth and without load, row-major, \[m].
    initial_gap: Vec<f64>,
    /// Input 2 (1 − ν) w of the history variables, \[Pa m].
    input: Vec<f64>,
}

impl<'a> PeriodicMarch<'a> {
    /// A march over an undeformed material with steps of `time_step` \[s]; `heights` \[m] are row-major.
    pub(crate) fn new(
        grid: &Grid,
        heights: &'a [f64],
        elastomer: &dyn Elastomer,
        time_step: f64,
    ) -> Result<Self, BemError> {
        let n = grid.n_elements();
        check_unchanged_moduli(elastomer)?;
        let creep = elastomer.material().creep();
        // Discretise the creep law of the material in time, and the influence of the half space or layer in space.
        let step = ExponentialStep::creep(&creep, time_step)?;
        let convolution = Convolution::periodic_for_elastomer(elastomer, grid);
        Ok(Self {
            given: heights,
            creep,
            waves: FourierMultiplier::new(grid, &Base::default()),
            heights: vec![0.0; n],
            mean_height: mean(heights),
            slopes: vec![0.0; n],
            state: ContactState::new(&convolution),
            workspace: convolution.workspace(),
            convolution,
            half_space_factor: elastomer.material().half_space_factor(),
            history: vec![0.0; n * step.n_fields()],
            initial_gap: vec![0.0; n],
            input: vec![0.0; n],
            step,
        })
    }

    /// Number of rows of elements along x.
    #[cfg(feature = "rough")]
    pub(crate) fn rows(&self) -> usize {
        self.convolution.grid().shape()[0]
    }

    /// Sets the duration \[s] of the next steps, and heights and slopes of the surface at their end.
    ///
    /// `symbols(row)` has the factors [heights, slopes \[1/m]] by which the waves in a row of the transform (`fourier_multiplier.rs`) are
    /// multiplied: the waves of the given surface become those of its heights and slopes at the end of a step.
    pub(crate) fn set_step(
        &mut self,
        time_step: f64,
        symbols: impl Fn(usize) -> [Complex<f64>; 2] + Sync,
    ) -> Result<(), BemError> {
        self.step = ExponentialStep::creep(&self.creep, time_step)?;
        let waves = &mut self.waves;
        waves.apply(self.given, &mut self.heights, |wave| symbols(wave.row)[0]);
        waves.apply(self.given, &mut self.slopes, |wave| symbols(wave.row)[1]);
        Ok(())
    }

    /// Sets steps of a `length` \[m] at constant speed. At their end the surface is `shortfall` \[m] short of a whole number of
    /// elements.
    ///
    /// The waves of the heights are multiplied by J_Δ/J and by the phase factor of the shortfall (head of this file).
    fn set_sliding_step(
        &mut self,
        sliding: &MaterialAtSpeed,
        length: f64,
        shortfall: f64,
    ) -> Result<(), BemError> {
        let time_step = length / sliding.velocity();
        let step = ExponentialStep::creep(&self.creep, time_step)?;
        // Find the symbols of the waves in each row: the phase factor of the shortfall times J_Δ/J for the heights, and times i q_x for
        // the slopes.
        let (along_x, factor) = (&self.waves.along_x, sliding.factor);
        let rows = along_x.len();
        let compliances = sliding.compliances(along_x)?.into_iter();
        let symbol = |(row, compliance): (usize, Complex<f64>)| {
            let q_x = along_x[row];
            let held_ratio = step.harmonic_response(q_x * length);
            let held_ratio =
                Complex::new(held_ratio.storage, held_ratio.loss) * factor / compliance;
            // The shortest wave stands for both directions, so that its symbols are real; its slope vanishes at the elements.
            if 2 * row == rows {
                [held_ratio.norm().into(), ZERO]
            } else {
                let phase_factor = Complex::from_polar(1.0, q_x * shortfall);
                [held_ratio * phase_factor, Complex::i() * q_x * phase_factor]
            }
        };
        let symbols: Vec<_> = compliances.enumerate().map(symbol).collect();
        self.set_step(time_step, |row| symbols[row])
    }

    /// Shifts the history variables by one element along −x: the material passes the surface.
    fn shift_history(&mut self) {
        let (n, columns) = (self.heights.len(), self.convolution.grid().shape()[1]);
        for field in self.history.chunks_exact_mut(n) {
            field.rotate_left(columns);
        }
    }

    /// Gap at the end of the last step, whose mean plane is at a `mean_depth` \[m], in the memory of the initial gap; the march ends.
    fn take_gap(&mut self, mean_depth: f64) -> Vec<f64> {
        let mut gap = std::mem::take(&mut self.initial_gap);
        add_scaled(&mut gap, self.step.response(), &self.input);
        let depth = mean_depth + self.mean_height;
        gap.iter_mut().for_each(|gap| *gap -= depth);
        gap
    }

    /// Solves the contact at the end of a step under a mean pressure \[Pa], and advances the history variables; distance and time of
    /// the row are 0.
    pub(crate) fn step(
        &mut self,
        mean_pressure: f64,
        options: &ContactOptions,
    ) -> Result<PeriodicRow, BemError> {
        let (n, columns) = (self.heights.len(), self.convolution.grid().shape()[1]);
        // Compute the initial gap h + H: the height of the surface plus the displacement without load, both at the end of the
        // step.
        self.step.history(&self.history, &mut self.initial_gap);
        add_scaled(&mut self.initial_gap, 1.0, &self.heights);

        // Solve the contact of the step, which is that of an elastic half space of the compliance 2 (1 − ν) α on this gap.
        let area = n as f64 * self.convolution.grid().element_area();
        let problem = ContactProblem {
            convolution: &self.convolution,
            separation: &self.initial_gap,
            compliance: self.half_space_factor * self.step.response(),
            largest_pressure: f64::INFINITY,
            control: Control::NormalForce(mean_pressure * area),
        };
        let contact = solve_contact(&problem, &mut self.state, options)?;

        // Advance the history variables to the end of the step with the input 2 (1 − ν) w, where w = K p/(4π) follows from the
        // new pressure.
        let pressure = self.state.pressure();
        self.convolution
            .apply(&mut self.workspace, pressure, &mut self.input);
        let per_load = self.half_space_factor / (4.0 * PI);
        self.input.iter_mut().for_each(|value| *value *= per_load);
        self.step.advance(&self.input, &mut self.history);

        Ok(PeriodicRow {
            sliding_distance: 0.0,
            time: 0.0,
            friction_coefficient: dot(pressure, &self.slopes) / pressure.iter().sum::<f64>(),
            area_fraction: area::area_fraction(columns, pressure).area,
            mean_depth: contact.indentation_depth - self.mean_height,
        })
    }
}

#[cfg(all(test, feature = "rough"))]
mod tests {
    use casebook::{decades, fixed_cases, prony};
    use indenters::rough::SelfAffine;
    use proptest::collection::vec;
    use proptest::prelude::*;
    use rheology::Prony;

    use super::*;

    /// Elements along an edge of the period.
    const N_ALONG: usize = 16;
    /// Number of steps of each part of a history.
    const STEPS: usize = 4;
    /// Phase factors of waves that have not moved.
    const STILL: [Complex<f64>; 2] = [Complex::new(1.0, 0.0); 2];

    /// Heights of self-affine surfaces.
    fn heights() -> impl Strategy<Value = Vec<f64>> {
        let heights = |(seed, hurst_exponent, waves): (u64, f64, f64)| {
            let surface = SelfAffine {
                period: [1.0; 2],
                hurst_exponent,
                rms_slope: 0.1,
                longest_wavelength: 1.01,
                shortest_wavelength: 1.0 / waves,
                roll_off_wavelength: 1.01,
                seed,
            };
            let surface = surface.surface().expect("a surface");
            surface.heights([N_ALONG; 2]).expect("heights")
        };
        (any::<u64>(), 0.3..0.9, 3.0..8.0).prop_map(heights)
    }

    /// Solids and fluids.
    fn material() -> impl Strategy<Value = Prony> {
        let equilibrium = prop_oneof![Just(0.0), Just(1.0)];
        let branches = vec((decades(1.0), decades(1.5)), 1..4);
        (equilibrium, branches)
            .prop_map(|(equilibrium, branches)| prony([equilibrium, 0.0], &branches))
    }

    /// Elements in contact after parts of a history, each with a duration and the pressure at its end.
    fn in_contact(heights: &[f64], material: &Prony, parts: &[(f64, f64)]) -> usize {
        let grid = Grid::new([N_ALONG; 2], [1.0 / N_ALONG as f64; 2]).expect("a grid");
        let mut march = PeriodicMarch::new(&grid, heights, material, 1.0).expect("a march");
        let options = ContactOptions {
            tolerance: 1e-9,
            ..ContactOptions::default()
        };
        let mut before = parts[parts.len() - 1].1;
        for (duration, end) in parts {
            march
                .set_step(duration / STEPS as f64, |_| STILL)
                .expect("a step");
            for step in 1..=STEPS {
                let pressure = before + step as f64 / STEPS as f64 * (end - before);
                let _: PeriodicRow = march.step(pressure, &options).expect("a contact");
            }
            before = *end;
        }
        let pressures = march.state.pressure().iter();
        pressures.filter(|pressure| **pressure > 0.0).count()
    }

    proptest! {
        #![proptest_config(fixed_cases(400))]

        /// After a higher pressure the contact is no smaller than if the lower one had been there for all the time (Li, Brenner
        /// and Frérot 2025), on any surface and any linear viscoelastic material.
        #[test]
        fn no_history_above_a_pressure_leaves_less_contact_than_that_pressure(
            heights in heights(),
            material in material(),
            above in vec((decades(1.0), 1.0..11.0), 2..6),
            last in decades(1.0),
            left in 0.0..1.0,
        ) {
            let last = 1e-2 * last;
            let parts: Vec<(f64, f64)> = above
                .into_iter()
                .map(|(duration, times)| (duration, times * last))
                .chain([(left, last)])
                .collect();
            let duration = parts.iter().map(|part| part.0).sum();
            let after = in_contact(&heights, &material, &parts);
            let held = in_contact(&heights, &material, &[(duration, last)]);
            prop_assert!(after >= held, "{} after {}", after, held);
        }
    }
}
