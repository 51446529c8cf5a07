//! The result of the stationary solver, in SI units.

use numerics::ErrorParts;

use crate::BemError;
use crate::elements::area::boundary_uncertainty;
use crate::elements::bounds::Bounds;
use crate::elements::mirror::NO_MIRRORS;
use crate::elements::pressure_field::PressureField;
use crate::error::check_contact_elements;
use crate::estimate::bars::{ContactEstimate, OnGrid};
use crate::estimate::quantities::Quantities;
use crate::stationary::steady::SteadyOptions;
use crate::stationary::steady::body_contact::Solution;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::patch_resolution::{MIN_ELEMENTS_ACROSS, check_patches};
use crate::stationary::steady::sinking_depth::SinkingDepth;
use crate::stationary::steady::sliding_creep::SlidingCreep;

/// A stationary state with the error of every quantity.
pub type SteadyEstimate = ContactEstimate<SteadySliding, SteadyOptions>;

/// A stationary solution on one grid. In plane strain force and area are per length along y, \[N/m] and \[m].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct SteadySliding {
    /// Friction coefficient μ = F_h/F_N.
    pub friction_coefficient: f64,
    /// Friction coefficient from the dissipated power: from the displacements of both neighbours of each element, also outside the
    /// contact. Equal to `friction_coefficient` where a body with edges slides on a material that is more of a fluid at the length
    /// of an element.
    pub friction_from_dissipation: f64,
    /// Mean of |∂h/∂x| under the load: the upper bound of the friction coefficient, which is a difference of slopes.
    pub mean_slope: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Depth of the lowest point, which depends on the sliding distance where the material flows.
    pub depth: SinkingDepth,
    /// Contact area with a boundary that divides elements, \[m²]; in plane strain the length of the contact.
    pub contact_area: f64,
    /// Rear and front of the contact relative to the lowest point, \[m].
    pub contact_x: [f64; 2],
    /// Sides of the contact relative to the lowest point, \[m].
    pub contact_y: [f64; 2],
    /// Number of unknown pressures: elements in contact, of one half where the problem is mirror symmetric.
    pub unknowns: usize,
    /// Number of active sets.
    pub iterations: usize,
    /// Largest residual |h + u − d| in the contact relative to the depth scale, see
    /// [`SteadyOptions::tolerance`].
    pub residual: f64,
    /// Pressure over the contact.
    pub pressure: PressureField,
    /// True if the last active set was solved directly.
    factorised: bool,
}

impl SteadySliding {
    /// True if the equations of this contact were solved directly, by factorisation; false if by iteration with transforms.
    pub const fn is_factorised(&self) -> bool {
        self.factorised
    }

    /// Absolute error of the friction coefficient by the remaining residual of the contact.
    pub(crate) fn iteration_error(&self) -> f64 {
        self.residual * self.mean_slope
    }

    /// Input of an error estimate for one grid: the quantities of this state, and the errors that differences between grids do not
    /// reveal. `kinks` is the sum of the squared jumps of the slope, as [`GridPlan::kinks`](crate::estimate::plan::GridPlan::kinks).
    pub(super) fn on_grid(
        self,
        creep: &SlidingCreep,
        kinks: f64,
        options: SteadyOptions,
        sliding_distance: Option<f64>,
    ) -> OnGrid<Self, SteadyOptions> {
        // Estimate the friction of details that the elements do not resolve.
        let fraction = self.subgrid_friction_fraction(creep, kinks);
        let subgrid_friction = fraction * self.friction_coefficient.abs();
        OnGrid {
            quantities: Quantities {
                friction_coefficient: self.friction_coefficient,
                normal_force: self.normal_force,
                indentation_depth: self.depth.at_distance(sliding_distance),
                contact_area: self.contact_area,
                peak_pressure: self.pressure.largest(),
            },
            common_error: ErrorParts {
                iteration: Some(self.iteration_error()),
                ..ErrorParts::discretisation_only(subgrid_friction)
            },
            target_uncertainty: 0.0,
            area_uncertainty: self.area_uncertainty(),
            area_order: None,
            spacing: options.spacing[0],
            state: self,
            options,
        }
    }

    /// Discretisation error of the contact area, \[m²]: the contact boundary lies anywhere within the elements at the edge.
    fn area_uncertainty(&self) -> f64 {
        let PressureField { grid, pressure, .. } = &self.pressure;
        let bounds = Bounds {
            lower: [0; 2],
            upper: grid.shape(),
        };
        grid.element_area() * boundary_uncertainty(pressure, &bounds, NO_MIRRORS)
    }

    /// Fraction of the friction that the elements may miss because the material relaxes within them.
    pub(super) fn subgrid_friction_fraction(&self, creep: &SlidingCreep, kinks: f64) -> f64 {
        let [rear, front] = self.contact_x;
        let half_length = 0.5 * (front - rear);
        creep.subgrid_friction_fraction(self.pressure.grid.spacing()[0], half_length, kinks)
    }

    /// True if the front is closer to an edge of the body than [`MIN_ELEMENTS_ACROSS`] elements, so that these do not separate the two;
    /// `radii` are those of the edges, \[m].
    pub(super) fn hides_edge(&self, radii: &[f64]) -> bool {
        let unresolved_distance = MIN_ELEMENTS_ACROSS as f64 * self.pressure.grid.spacing()[0];
        let [_, front] = self.contact_x;
        radii
            .iter()
            .any(|radius| (front - radius).abs() < unresolved_distance)
    }

    /// Converts a solution in the units of the mesh to SI units.
    ///
    /// # Errors
    /// Those of a contact that the grid does not resolve, that reaches the boundary of the footprint, or that touches a vertical wall.
    pub(super) fn new(mesh: &Mesh, solution: &Solution) -> Result<Self, BemError> {
        // Refuse contacts that reach the boundary of the footprint, touch a wall, or are not resolved by the grid.
        let loaded = mesh.loaded_indices(&solution.loads);
        let bounds = checked_bounds(mesh, &loaded)?;
        check_walls(mesh, &solution.loads)?;
        check_slopes(mesh, &solution.loads)?;
        if mesh.loading.may_have_patches {
            check_patches(&loaded, &bounds)?;
        }

        // Convert loads to pressures on the box around the contact, whose outer edges bound the contact.
        let spacing = mesh.options.spacing;
        let edges = [0, 1].map(|axis| {
            let half = 0.5 * spacing[axis];
            [
                mesh.centre(axis, bounds.lower[axis]) - half,
                mesh.centre(axis, bounds.upper[axis] - 1) + half,
            ]
        });
        let origin = [0, 1].map(|axis| mesh.centre(axis, bounds.lower[axis]));
        let unit = mesh.loading.pressure_unit();
        let pressures = loaded.iter().map(|(element, load)| (*element, load * unit));
        let pressure = PressureField::from_elements(&bounds, spacing, origin, pressures)?;

        // Friction, force, depth and area follow from sums over the loads. In plane strain force and area are per length of the strip.
        let slopes = mesh.mean_slopes(&solution.loads);
        let total_load = mesh.total_load(solution.loads.iter().copied());
        let per_length = if mesh.loading.is_strip {
            spacing[1].recip()
        } else {
            1.0
        };
        Ok(Self {
            friction_coefficient: slopes.slope,
            friction_from_dissipation: if mesh.loading.is_solid_for_elements()
                || !mesh.loading.has_edges
            {
                slopes.dissipating_slope
                    - solution.gap_difference * mesh.loading.depth_scale / spacing[0]
            } else {
                slopes.slope
            },
            mean_slope: slopes.absolute_slope,
            normal_force: mesh.loading.force_of(total_load) * per_length,
            depth: SinkingDepth::new(mesh, solution, edges[0][1] - edges[0][0]),
            contact_area: solution.contact_area * spacing[0] * spacing[1] * per_length,
            contact_x: edges[0],
            contact_y: edges[1],
            unknowns: solution.loads.len(),
            iterations: solution.iterations,
            residual: solution.residual,
            pressure,
            factorised: solution.solved_directly,
        })
    }
}

/// Fails with [`BemError::VerticalWall`] if a wall of the body is in contact. Mirror images are not checked: by rounding, an image
/// may lie beyond the end of a surface, its element not.
fn check_walls(mesh: &Mesh, loads: &[(usize, f64)]) -> Result<(), BemError> {
    // Refuse a loaded element next to a wall of the body.
    let mut indices = loads.iter().map(|(element, _)| mesh.indices(*element)[0]);
    match indices.find(|indices| mesh.faces_wall(*indices)) {
        Some([row, column]) => Err(BemError::VerticalWall {
            x: mesh.centre(0, row),
            y: mesh.centre(1, column),
        }),
        None => Ok(()),
    }
}

/// Fails with [`BemError::SlopeNotResolved`] if the surface rises by more than the depth scale over one element in contact.
fn check_slopes(mesh: &Mesh, loads: &[(usize, f64)]) -> Result<(), BemError> {
    let depth_scale = mesh.loading.depth_scale;
    let rise = mesh.max_rise(loads) * depth_scale;
    if rise > depth_scale {
        return Err(BemError::SlopeNotResolved { rise, depth_scale });
    }
    Ok(())
}

/// The box around the loaded elements. Fails if it reaches the boundary of the footprint or covers too few elements.
fn checked_bounds(mesh: &Mesh, loaded: &[([usize; 2], f64)]) -> Result<Bounds, BemError> {
    let bounds =
        Bounds::enclosing(loaded.iter().map(|(element, _)| *element)).unwrap_or(Bounds::EMPTY);
    if bounds != Bounds::EMPTY && !mesh.contains_inside(&bounds) {
        return Err(mesh.options.footprint.boundary_reached(0.0));
    }
    // The contact needs enough elements along x, and also across it unless it is a strip of one element along y.
    let [rows, columns] = bounds.shape();
    let is_strip = mesh.loading.is_strip;
    check_contact_elements(if is_strip { rows } else { rows.min(columns) })?;
    Ok(bounds)
}
