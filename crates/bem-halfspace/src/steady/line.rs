//! Line contact: a profile that is infinite along y slides in plane strain.
//!
//! One element along y is so long that its ends are not felt: up to a constant, its potential is that of a line load,
//!
//! ```text
//! V(x) = 2 Δx ln(L/|x|) + O(x²/L²)
//! ```
//!
//! and the constant is absorbed in the depth, which in plane strain has no meaning. All forces and areas are per length
//! along y. On a half space that flows there is no such limit: the surface sinks the faster the longer the line is.

use indenters::{SlidingLoad, Surface};
use rheology::Material;

use crate::steady::estimate::climb;
use crate::steady::loading::{Loading, scale_of_profile};
use crate::steady::sliding_creep::SlidingCreep;
use crate::steady::{
    FrictionOptions, Ladder, Refinement, Reuse, SteadyOptions, SteadySliding, solve,
};
use crate::{BemError, Footprint};

/// Resolution of a stationary line contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineOptions {
    /// Length Δx of an element, \[m].
    pub spacing: f64,
    /// Where in its element the lowest point of the profile lies, in elements from its centre, between −1/2 and 1/2.
    pub phase: f64,
    /// From rear to front, where contact may occur: `footprint[0] < 0 < footprint[1]`, \[m].
    pub footprint: [f64; 2],
    /// Largest |gap| allowed in the contact, and largest penetration outside, relative to the depth scale
    /// D = h(a) = 2 (1 − ν) F' J(a/v)/(2π), with the force F' per length and the mean height h(a) at the distance a from
    /// the lowest point.
    pub tolerance: f64,
    /// Changes of the contact set after which the solver gives up.
    pub max_iterations: usize,
}

/// A stationary line contact on one grid.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct LineSliding {
    /// Friction coefficient μ.
    pub friction_coefficient: f64,
    /// Mean of |∂h/∂x| under the load.
    pub mean_slope: f64,
    /// Rear and front of the contact relative to the lowest point, \[m].
    pub contact: [f64; 2],
    /// Number of unknown pressures.
    pub unknowns: usize,
    /// Contact sets tried.
    pub iterations: usize,
    /// Largest |gap| in the contact relative to the depth scale, see [`LineOptions::tolerance`].
    pub residual: f64,
    /// Centre of each element from rear to front \[m], and its pressure \[Pa].
    pub pressure: Vec<[f64; 2]>,
}

/// Where the refinements of a profile begin, and how they converge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineLadder {
    /// From rear to front, where contact may occur, \[m].
    pub footprint: [f64; 2],
    /// Δx of the coarsest grids, \[m].
    pub coarsest_spacing: f64,
    /// p of the sharpest point h ∼ |x|^p in contact; 2 or more for a smooth profile.
    pub apex_exponent: f64,
}

/// The friction coefficient of a line contact with its error.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct LineFriction {
    /// Friction coefficient μ.
    pub friction_coefficient: f64,
    /// Estimated absolute error.
    pub error: f64,
    /// The part of it that comes from the gaps that the solver leaves in the contact.
    pub gap_error: f64,
    /// The refinements that led there, from coarse to fine; their forces are per length, \[N/m].
    pub refinements: Vec<Refinement>,
}

/// Elements of the coarsest grids along the half contact of a cylinder on an elastic half space.
const COARSEST: f64 = 4.0;
/// Rear of the footprint in the same lengths: nothing reaches further back than the elastic contact.
const REAR: f64 = 2.0;
/// Front of the footprint, and what a long memory adds: how far ahead the surface still rises grows with its logarithm.
const FRONT: f64 = 2.5;
const FRONT_BY_MEMORY: f64 = 0.5;

/// Unknown pressures at most; as many are factorised at once.
const MOST_UNKNOWNS: usize = 2000;

impl LineLadder {
    /// The refinements for a smooth profile under a load whose normal force is per length, \[N/m].
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a material that flows, or when the profile has no length for this load;
    /// [`BemError::Material`].
    pub fn of_profile(
        profile: &impl Surface,
        material: &(impl Material + ?Sized),
        load: &SlidingLoad,
    ) -> Result<Self, BemError> {
        let creep = SlidingCreep::new(material, load.velocity())?;
        let [_, length] = scale_of_profile(profile, &creep, load.require_normal_force()?)?;
        let front = FRONT + FRONT_BY_MEMORY * (creep.memory() / length).ln_1p();
        Ok(Self {
            footprint: [-REAR * length, front * length],
            coarsest_spacing: length / COARSEST,
            apex_exponent: 2.0,
        })
    }
}

/// Solves the stationary sliding of a `profile` on one grid, under a load whose normal force is per length, \[N/m].
///
/// Of the profile only the heights at y = 0 count.
///
/// # Errors
/// As for [`steady`](crate::steady::steady()), and [`BemError::InvalidParameter`] for a material that flows.
pub fn steady_line(
    profile: &impl Surface,
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    options: &LineOptions,
) -> Result<LineSliding, BemError> {
    let (loading, length) = Loading::per_length(profile, (material, load), options.footprint)?;
    let strip = Strip { profile, length };
    let grid = SteadyOptions {
        spacing: [options.spacing, length],
        phase: [options.phase, 0.0],
        footprint: strip.footprint(options.footprint),
        tolerance: options.tolerance,
        max_iterations: options.max_iterations,
    };
    let state = solve(&strip, &loading, (&grid, None), &mut Reuse::default())?;
    Ok(LineSliding::of(&state))
}

/// Computes the stationary friction coefficient of a `profile` to a relative error, under a load whose normal force is
/// per length, \[N/m].
///
/// # Errors
/// As for [`steady_friction_of_surface`](crate::steady::steady_friction_of_surface), and
/// [`BemError::InvalidParameter`] for a material that flows.
pub fn steady_line_friction(
    profile: &impl Surface,
    (material, load): (&(impl Material + ?Sized), &SlidingLoad),
    ladder: &LineLadder,
    relative_error: f64,
) -> Result<LineFriction, BemError> {
    let (loading, length) = Loading::per_length(profile, (material, load), ladder.footprint)?;
    let strip = Strip { profile, length };
    let grids = Ladder {
        footprint: strip.footprint(ladder.footprint),
        coarsest_spacing: ladder.coarsest_spacing,
        apex_exponent: ladder.apex_exponent,
    };
    let options = FrictionOptions {
        relative_error,
        max_unknowns: MOST_UNKNOWNS,
        ..FrictionOptions::default()
    };
    let estimate = climb(&strip, loading, &grids, &options)?;
    let per_length = |refinement: Refinement| Refinement {
        normal_force: refinement.normal_force / length,
        force_scatter: refinement.force_scatter / length,
        ..refinement
    };
    Ok(LineFriction {
        friction_coefficient: estimate.friction_coefficient,
        error: estimate.error,
        gap_error: estimate.gap_error,
        refinements: estimate.refinements.into_iter().map(per_length).collect(),
    })
}

impl LineSliding {
    fn of(state: &SteadySliding) -> Self {
        let field = &state.pressure;
        let [first, _] = field.origin;
        let [dx, _] = field.grid.spacing();
        // One element along y: the rows are all there is.
        let row = |(row, pressure): (usize, &f64)| [first + row as f64 * dx, *pressure];
        Self {
            friction_coefficient: state.friction_coefficient,
            mean_slope: state.mean_slope,
            contact: state.contact_x,
            unknowns: state.unknowns,
            iterations: state.iterations,
            residual: state.residual,
            pressure: field.pressure.iter().enumerate().map(row).collect(),
        }
    }
}

/// A profile that is as long along y as one element.
struct Strip<'a, S> {
    profile: &'a S,
    length: f64,
}

impl<S> Strip<'_, S> {
    /// With an empty element on either side.
    fn footprint(&self, x: [f64; 2]) -> Footprint {
        let y = [-self.length, self.length];
        Footprint { x, y }
    }
}

impl<S: Surface> Surface for Strip<'_, S> {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        if y.abs() > 0.5 * self.length {
            f64::INFINITY
        } else {
            self.profile.height([x, 0.0])
        }
    }

    fn gradient(&self, [x, _]: [f64; 2]) -> [f64; 2] {
        self.profile.gradient([x, 0.0])
    }

    fn mirrors(&self) -> [bool; 2] {
        let [along_x, _] = self.profile.mirrors();
        [along_x, true]
    }
}
