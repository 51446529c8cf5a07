//! Loads of either sign that satisfy the contact equations on a given active set.
//!
//! ```text
//! h + K x − δ = 0  on the active set,      α δ + β Σ x = γ
//! ```
//!
//! x are loads and δ is the depth, both in the units of the mesh (`mesh.rs`). The second equation, with the coefficients of
//! [`ControlEquation`](super::loading::ControlEquation), prescribes the force or the depth. Small systems are solved directly, large
//! ones by preconditioned GCR.
//!
//! Theory: docs/theory/stationary-half-space.md, "The equations of one contact".

use crate::BemError;
use crate::dense;
use crate::parallel::reductions::{add_scaled, dot, larger};
use crate::stationary::conjugate_residuals::{GcrLimits, gcr, norm};
use crate::stationary::search::{FixedSetSolver, ForcingTerms};
use crate::stationary::steady::filter::KernelOperator;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;
use crate::stationary::steady::wiener_hopf::WienerHopf;

/// Largest n³/N for which n unknowns are solved for directly, in a box of N elements on which the transforms of an iteration
/// work. This is about 120 unknowns for a compact contact and far more for a thin crescent. Up to it the direct solve is faster,
/// and exact to rounding.
///
/// Measured: beyond the limit the few steps from a good guess are faster. At 145 unknowns they take 0.1 to 0.3 ms against 0.4 ms,
/// at 557 unknowns 0.4 to 0.7 ms against 7 ms. It has a case of `evidence tuning`.
const DIRECT_SOLVE_WORK_PER_ELEMENT: f64 = 5e3;
/// Largest number of GCR steps on one active set, and of directions in the basis. Chosen to limit time and memory; a
/// preconditioned contact needs some tens. Beyond it the search of a contact continues with the loads so far. Adjoint equations are
/// then solved directly, or fail if they are too large.
pub(super) const MAX_GCR_STEPS: usize = 150;
/// GCR without truncation: the basis keeps all directions.
pub(super) const GCR_LIMITS: GcrLimits = GcrLimits {
    max_steps: MAX_GCR_STEPS,
    truncation_depth: MAX_GCR_STEPS,
};

/// The equations of a body on a mesh, with the current active set.
pub(super) struct ContactEquations<'mesh> {
    /// Elements, heights and kernel.
    mesh: &'mesh Mesh,
    /// Spectra of the kernel and of its inverse factors.
    plans: &'mesh mut Plans,
    /// All candidates, the elements that may touch, in their bounding box.
    candidates: Region,
    /// K on all candidates.
    operator: KernelOperator,
    /// Indices of the candidates of the active set; loads and gaps are in this order.
    active: Vec<usize>,
    /// Loads x on the active set, of either sign.
    loads: Vec<f64>,
    /// Gaps h + K x − δ on the active set.
    gaps: Vec<f64>,
    /// Number of active sets so far.
    pub(super) n_active_sets: usize,
    /// True if the last active set was solved directly, false if by iteration.
    pub(super) solved_directly: bool,
}

impl FixedSetSolver for ContactEquations<'_> {
    /// False: a single body has ends along x.
    const PERIODIC_ALONG_X: bool = false;
    /// Forcing terms of the contact of a body. Chosen on the time; the contact that is found is the same. With ten times these
    /// values there are 1.4 times as many active sets, which take a tenth longer in total. With a third of these values hardly
    /// anything changes.
    const FORCING: ForcingTerms = ForcingTerms {
        usual: 0.02,
        after_growth: 0.006,
    };

    /// Rows and columns of the footprint.
    fn shape(&self) -> [usize; 2] {
        self.mesh.shape()
    }

    /// Row and column of a candidate in the footprint.
    fn row_and_column(&self, element: usize) -> [usize; 2] {
        self.mesh.indices(element)[0]
    }

    /// Creep of an element under its own unit load, which is positive also where displacements have an undetermined constant.
    fn self_influence(&self) -> f64 {
        self.mesh.self_creep()
    }

    /// Writes the displacements K x of all candidates, in units of the depth scale; residuals are relative to that scale.
    fn displace(&mut self, pressure: &[f64], displacement: &mut [f64]) -> f64 {
        displacement.copy_from_slice(&self.operator.apply(0, pressure, &self.candidates));
        1.0
    }

    /// Depth δ from the control equation, in units of the depth scale; `None` under a given force.
    fn depth(&self, pressure: &[f64]) -> Option<f64> {
        let control = self.mesh.loading.control;
        let total = self.mesh.total_load(pressure.iter().copied().enumerate());
        (control.depth != 0.0).then(|| (control.right - control.load * total) / control.depth)
    }

    /// Makes the active candidates with their loads and gaps the active set, and counts it.
    fn set_active_set(&mut self, active: &[bool], pressure: &[f64], gap: &[f64]) {
        let elements = (0..active.len()).filter(|element| active[*element]);
        self.active = elements.collect();
        let packed = |field: &[f64]| self.active.iter().map(|element| field[*element]).collect();
        (self.loads, self.gaps) = (packed(pressure), packed(gap));
        self.n_active_sets += 1;
    }

    /// Root mean square of the gaps of the active set, in units of the depth scale.
    fn residual_rms(&self) -> f64 {
        norm(&self.gaps) / (self.active.len() as f64).sqrt()
    }

    /// Solves the equations on the active set directly if that is cheaper, else by GCR until the RMS gap is below `rms` or the
    /// largest below `max`, in units of the depth scale.
    fn solve(&mut self, rms: f64, max: f64) -> Result<(), BemError> {
        let region = self.mesh.region(self.active.iter().copied());
        self.solved_directly = prefers_direct_solve(self.active.len(), region.n_box_elements());
        if self.solved_directly {
            return self.solve_directly();
        }
        self.iterate(&region, rms, max);
        Ok(())
    }

    /// Writes the loads of the active set, of either sign, into a vector over all candidates.
    fn copy_pressure_to(&self, pressure: &mut [f64]) {
        for (element, load) in self.active.iter().zip(&self.loads) {
            pressure[*element] = *load;
        }
    }

    /// Scales loads to the given force; at a given depth nothing changes.
    fn scale_to_force(&self, pressure: &mut [f64]) {
        self.mesh.scale_to_force(pressure);
    }

    /// The budget counts active sets.
    fn iterations(&self) -> usize {
        self.n_active_sets
    }

    /// True from [`SteadyOptions::max_iterations`](super::SteadyOptions::max_iterations) active sets on.
    fn budget_is_exhausted(&self) -> bool {
        self.n_active_sets >= self.mesh.options.max_iterations
    }
}

impl<'mesh> ContactEquations<'mesh> {
    /// Equations of a body on a mesh, with an empty active set.
    pub(super) fn new(mesh: &'mesh Mesh, plans: &'mesh mut Plans) -> Self {
        let candidates = mesh.region(0..mesh.n_elements());
        Self {
            mesh,
            operator: KernelOperator::new(plans.kernel(candidates.shape), &candidates),
            plans,
            candidates,
            active: Vec::new(),
            loads: Vec::new(),
            gaps: Vec::new(),
            n_active_sets: 0,
            solved_directly: false,
        }
    }

    /// Solves the equations by LU factorisation, with the depth as the last unknown. Fails with [`BemError::SingularContact`].
    fn solve_directly(&mut self) -> Result<(), BemError> {
        let (mesh, active) = (self.mesh, &self.active);
        let n = active.len();
        let control = mesh.loading.control;
        // The first n equations close the gaps of the active set, and the last one prescribes force or depth. The last unknown is
        // the depth.
        let entry = |row, column| match (row < n, column < n) {
            (true, true) => mesh.influence(active[row], active[column]),
            (true, false) => -1.0,
            (false, true) => control.load * mesh.n_images(active[column]),
            (false, false) => control.depth,
        };
        let heights = active.iter().map(|&element| -mesh.height(element));
        let right_side = heights.chain([control.right]).collect();
        let mut solutions = dense::solve(entry, vec![right_side])
            .ok_or(BemError::SingularContact { elements: n })?;
        self.loads = solutions.remove(0);
        self.loads.truncate(n);
        self.gaps.fill(0.0);
        Ok(())
    }

    /// Iterates by GCR until the RMS gap or the largest |gap| is small enough.
    fn iterate(&mut self, region: &Region, rms: f64, max: f64) {
        let mut directions = Directions::new(self, region);
        let n = self.active.len() as f64;
        gcr(
            &mut self.loads,
            &mut self.gaps,
            GCR_LIMITS,
            |state, direction, image| {
                let largest = || {
                    let gaps = state.residual.iter();
                    gaps.fold(0.0, |max, gap| larger(max, gap.abs()))
                };
                // The largest |gap| is at least the RMS: find it only if that is small.
                let residual_rms = (state.residual_square / n).sqrt();
                let continues = residual_rms > rms && (residual_rms > max || largest() > max);
                if continues {
                    directions.write_direction(state.source, direction, image);
                }
                continues
            },
        );
    }
}

/// True if a direct solve is cheaper than an iteration, for a number of unknowns in a box of `n_box_elements` elements.
pub(super) fn prefers_direct_solve(n_unknowns: usize, n_box_elements: usize) -> bool {
    let work = (n_unknowns as f64).powi(3);
    n_unknowns <= dense::MAX_UNKNOWNS
        && work <= DIRECT_SOLVE_WORK_PER_ELEMENT * n_box_elements as f64
}

/// GCR directions on one active set: the preconditioner with the control of force or depth.
struct Directions<'a> {
    /// Kernel and control.
    mesh: &'a Mesh,
    /// Elements of the active set in their bounding box.
    region: &'a Region,
    /// Number of images of each element, itself included: 1, or 2 with a mirror image.
    n_images: Vec<f64>,
    /// K on the active set.
    operator: KernelOperator,
    /// Approximate inverse of K on the active set.
    preconditioner: WienerHopf,
    /// Preconditioned loads under unit displacements of all elements of the active set.
    unit_depth_response: Vec<f64>,
}

impl<'a> Directions<'a> {
    /// Search directions on the active set of `equations`, whose bounding box is `region`.
    fn new<'mesh: 'a>(equations: &mut ContactEquations<'mesh>, region: &'a Region) -> Self {
        let (mesh, plans) = (equations.mesh, &mut *equations.plans);
        let mut preconditioner = WienerHopf::new(plans.inverse_factors(region.shape), region);
        let active = equations.active.iter();
        Self {
            unit_depth_response: preconditioner
                .approximate_loads(&vec![1.0; equations.active.len()], region),
            operator: KernelOperator::new(plans.kernel(region.shape), region),
            n_images: active.map(|element| mesh.n_images(*element)).collect(),
            preconditioner,
            region,
            mesh,
        }
    }

    /// Writes a `direction` of loads x that nearly close the `gaps`, up to the sign, and its `image`, the gaps K x − δ that they
    /// add. The change δ of the depth keeps the prescribed force or depth.
    fn write_direction(&mut self, gaps: &[f64], direction: &mut [f64], image: &mut [f64]) {
        let control = self.mesh.loading.control;
        // Apply the preconditioner to the gaps. The depth then changes so that the direction keeps the prescribed force or depth.
        let mut loads = self.preconditioner.approximate_loads(gaps, self.region);
        let stiffness = control.depth + control.load * self.total(&self.unit_depth_response);
        let depth = -control.load * self.total(&loads) / stiffness;
        add_scaled(&mut loads, depth, &self.unit_depth_response);
        // Compute the gaps that these loads and the change of the depth add.
        let displacements = self.operator.apply(0, &loads, self.region);
        for (gap, displacement) in image.iter_mut().zip(displacements) {
            *gap = displacement - depth;
        }
        direction.copy_from_slice(&loads);
    }

    /// Sum of the loads of the active set, in units of the mesh, mirror images included.
    fn total(&self, loads: &[f64]) -> f64 {
        dot(loads, &self.n_images)
    }
}
