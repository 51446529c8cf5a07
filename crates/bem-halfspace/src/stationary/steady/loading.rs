//! The load of a stationary problem: a force, or a depth after a sliding distance.
//!
//! Theory: docs/theory/stationary-half-space.md, "Any linear viscoelastic material", "Units", and "Line contact".

use std::f64::consts::PI;

use indenters::{Control, SlidingLoad, Surface};
use numerics::{in_range, positive};

use crate::estimate::plan::{NEGLIGIBLE_FRACTION, kinks};
use crate::stationary::steady::contact_scale::{depth_scale, mean_height, profile_scale};
use crate::stationary::steady::sliding_creep::{ElementCreep, SlidingCreep};
use crate::{BemError, Elastomer, Footprint};

/// Why a depth on a material that flows requires a sliding distance, for an error message.
const SINKS_WITHOUT_LIMIT: &str =
    "on a material that flows the body sinks without limit, so that a depth belongs to a distance";
/// Sliding distance, in lengths of the footprint, that is assumed for a given depth on a solid. Chosen; on a solid the distance
/// has no effect on the solution, so that any other would do.
const DISTANCE_ON_SOLID: f64 = 100.0;

/// The equation `depth · δ + load · Σ x = right` that prescribes depth or force, in the units of the mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct ControlEquation {
    /// Coefficient of the depth δ; 0 under a given force.
    pub(super) depth: f64,
    /// Coefficient of the total load Σ x in the equation.
    pub(super) load: f64,
    /// Right side of the equation, in its unit.
    pub(super) right: f64,
}

/// Scale and control of a stationary problem on any grid.
pub(super) struct Loading {
    /// Creep of the material at the sliding speed.
    pub(super) creep: SlidingCreep,
    /// Unit of heights D, \[m].
    pub(super) depth_scale: f64,
    /// The given force or depth. In plane strain the force is that on the whole strip.
    pub(super) control: Control,
    /// Sliding distance, \[m]. Never `None` at a given depth.
    pub(super) sliding_distance: Option<f64>,
    /// Length along y of a strip that stands for an infinite profile, \[m]. `None` for a body of finite width.
    pub(super) strip: Option<f64>,
    /// True if the slope of the body jumps inside the contact.
    pub(super) has_edges: bool,
    /// True if patches of the contact are checked. False under a body of revolution, where only the elements break up a thin crescent.
    pub(super) may_have_patches: bool,
}

/// Smallest tolerance of a contact, relative to the depth scale. Chosen above the rounding error of the transforms, below
/// which a residual has no meaning (case of `evidence tuning`).
pub(super) const MIN_TOLERANCE: f64 = 1e-12;

impl Loading {
    /// The loading of a body. Under a force, D is about the depth at which it is carried; at a depth, D is that depth.
    pub(super) fn new(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        footprint: &Footprint,
    ) -> Result<Self, BemError> {
        let creep = SlidingCreep::for_load(elastomer, load)?;
        let [rear, front] = footprint.x;
        // Choose the unit of heights. A given depth is that unit itself, and belongs to a sliding distance on a material that flows.
        let (depth_scale, sliding_distance) = match load.control() {
            Control::NormalForce(force) => {
                let max_length = footprint
                    .edge_distances()?
                    .concat()
                    .into_iter()
                    .fold(0.0, f64::max);
                let height = |distance| mean_height(surface, distance);
                let depth = depth_scale(&creep, force, height, max_length, f64::INFINITY)?;
                (depth, load.sliding_distance())
            }
            Control::IndentationDepth(depth) => {
                let distance = distance_at_depth(&creep, load, front - rear)?;
                (depth, Some(distance))
            }
        };
        Ok(Self {
            has_edges: kinks(surface, depth_scale, footprint)? > NEGLIGIBLE_FRACTION,
            may_have_patches: surface.as_axisymmetric().is_none(),
            creep,
            depth_scale,
            control: load.control(),
            sliding_distance,
            strip: None,
        })
    }

    /// The loading of a profile in plane strain, under a force per length \[N/m], with contact within a footprint
    /// \[m].
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a material that flows; [`BemError::Indenter`] for a depth.
    pub(super) fn per_length(
        profile: &dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        footprint: [f64; 2],
    ) -> Result<Self, BemError> {
        let creep = SlidingCreep::for_load(elastomer, load)?;
        let force = load.require_normal_force()?;
        // Choose a strip so long that its ends have no influence on the contact: the relative difference from an infinite strip is
        // about the inverse square of the ratio of its length to those of its footprint and of its memory. It carries the force per
        // length times its length.
        let length_ratio = MIN_TOLERANCE.sqrt().recip();
        let depth_scale = profile_scale(profile, &creep, force)?.depth_scale;
        let length = length_ratio * (footprint[1] - footprint[0] + creep.memory_length());
        let strip = positive("length of a strip", length)?;
        let force = positive("force on a strip", force * strip)?;
        Ok(Self {
            creep,
            depth_scale,
            control: Control::NormalForce(force),
            sliding_distance: None,
            strip: Some(strip),
            has_edges: false,
            may_have_patches: false,
        })
    }

    /// Edges of an element that is `factor` times as long. The width of a strip does not change.
    pub(super) fn scaled(&self, spacing: [f64; 2], factor: f64) -> [f64; 2] {
        let factor_across = self.strip.map_or(factor, |_| 1.0);
        [factor * spacing[0], factor_across * spacing[1]]
    }

    /// Scale, control and creep of the loading in the units of a grid with the given spacing \[m].
    pub(super) fn on_grid(&self, spacing: [f64; 2]) -> Result<GridLoading, BemError> {
        // Find the units of the grid: the creep over an element, and the force that belongs to the depth scale.
        let creep = self.creep.over_element(spacing[0])?;
        let compliance = self.creep.compliance(spacing[0])?;
        let force_scale = 4.0 * self.depth_scale / compliance * spacing[0];
        let force_scale = positive("4 D Δx / (2 (1 - ν) J(Δx/v))", force_scale)?;
        let aspect = spacing[1] / spacing[0];

        // Write the control in these units. On a material that flows the depth depends on the load and the sliding distance.
        let control = match self.control {
            Control::NormalForce(force) => ControlEquation {
                depth: 0.0,
                load: 1.0,
                right: force / force_scale / (PI * aspect),
            },
            Control::IndentationDepth(_) => {
                let sinking_in_e_folds = |distance| sinking_in_e_folds(distance, spacing[0]);
                ControlEquation {
                    depth: 1.0,
                    load: creep.flow
                        * aspect
                        * self.sliding_distance.map_or(0.0, sinking_in_e_folds),
                    right: 1.0,
                }
            }
        };
        Ok(GridLoading {
            creep,
            control,
            depth_scale: self.depth_scale,
            force_scale,
            spacing,
            is_strip: self.strip.is_some(),
            has_edges: self.has_edges,
            may_have_patches: self.may_have_patches,
        })
    }
}

/// The sliding distance to which a given depth belongs, \[m].
///
/// # Errors
/// [`BemError::SlidingDistanceMissing`] on a material that flows; [`BemError::InvalidParameter`] for a distance shorter than the footprint.
fn distance_at_depth(
    creep: &SlidingCreep,
    load: &SlidingLoad,
    footprint_length: f64,
) -> Result<f64, BemError> {
    let Some(distance) = load.sliding_distance() else {
        if creep.fluidity() > 0.0 {
            return Err(BemError::SlidingDistanceMissing {
                why: SINKS_WITHOUT_LIMIT,
            });
        }
        return Ok(DISTANCE_ON_SOLID * footprint_length);
    };
    let is_allowed = distance >= footprint_length;
    let allowed = "longer than the footprint, because the depth is known only after the contact has become stationary";
    Ok(in_range("sliding_distance", distance, is_allowed, allowed)?)
}

/// Scales and control on one grid, for loads in units of 4π D/(2 (1 − ν) J(Δx/v) Δx).
pub(super) struct GridLoading {
    /// Creep over an element.
    pub(super) creep: ElementCreep,
    /// Equation of the given force or depth.
    pub(super) control: ControlEquation,
    /// Unit of heights D, \[m].
    pub(super) depth_scale: f64,
    /// Unit of forces 4 D Δx/(2 (1 − ν) J(Δx/v)), which is 4ηvD for the dashpot, \[N].
    force_scale: f64,
    /// Edges [Δx, Δy] of an element, \[m].
    spacing: [f64; 2],
    /// True if one element along y stands for an infinite strip.
    pub(super) is_strip: bool,
    /// True if the slope of the body jumps inside the contact, as [`Loading::has_edges`].
    pub(super) has_edges: bool,
    /// True if patches of the contact are checked, as [`Loading::may_have_patches`].
    pub(super) may_have_patches: bool,
}

impl GridLoading {
    /// True if the collocation points lie near the centres of the elements: the material is more of a solid than a fluid at the
    /// shortest wave of the grid. Then the friction of a body with edges follows from the displacements of the neighbours of an
    /// element.
    pub(super) fn is_solid_for_elements(&self) -> bool {
        self.creep.collocation_shift > -0.25
    }

    /// Normal force \[N] of a total load, the sum of the loads in the units of the grid.
    pub(super) fn force_of(&self, total_load: f64) -> f64 {
        self.force_scale * (PI * (self.spacing[1] / self.spacing[0]) * total_load)
    }

    /// Pressure of the unit load, \[Pa].
    pub(super) fn pressure_unit(&self) -> f64 {
        PI * (self.force_scale / self.spacing[0] / self.spacing[0])
    }
}

/// Depth ln(2s/L) by which the surface sinks after the sliding distance s, in units of F_N/(4πηv), for a kernel with lengths in
/// units of L; s and L are in \[m].
pub(super) fn sinking_in_e_folds(sliding_distance: f64, unit_length: f64) -> f64 {
    (2.0 * (sliding_distance / unit_length)).ln()
}
