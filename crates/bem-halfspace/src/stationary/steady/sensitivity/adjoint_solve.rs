//! Adjoint loads: solutions with the transposed kernel, which is that of the motion in the opposite direction.
//!
//! A contact that is reversed along x has the transposed equations as its own, so that the same kernel and preconditioner serve both.
//!
//! Theory: docs/theory/sensitivities.md.

use crate::BemError;
use crate::dense;
use crate::stationary::conjugate_residuals::{gcr, norm};
use crate::stationary::steady::contact_equations::{
    GCR_LIMITS, MAX_GCR_STEPS, prefers_direct_solve,
};
use crate::stationary::steady::filter::KernelOperator;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::wiener_hopf::WienerHopf;

/// Ratio of the norm of the residual of the adjoint equations to that of the right side, at which the iteration ends. Chosen far
/// below the error that the size of the elements causes in the derivatives (case of `evidence tuning`).
const ADJOINT_TOLERANCE: f64 = 1e-9;

/// Direction of the motion in the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum KernelDirection {
    /// The motion of the contact, with the kernel K.
    Forward,
    /// Motion in the opposite direction, whose kernel is the transpose Kᵀ.
    Reversed,
}

/// Solves `K y = r` for several right sides on a contact, given by indices of candidates, in the units of the mesh; `Kᵀ y = r` for the
/// reversed motion.
///
/// # Errors
/// [`BemError::ContactNotConverged`] with the largest relative residual.
pub(super) fn solve(
    mesh: &Mesh,
    plans: &mut Plans,
    contact: &[usize],
    motion: KernelDirection,
    right_sides: &[Vec<f64>],
) -> Result<Vec<Vec<f64>>, BemError> {
    // Small systems are solved by factorisation, which is faster than an iteration.
    let mut region = mesh.region(contact.iter().copied());
    let n = contact.len();
    if prefers_direct_solve(n, region.n_box_elements()) {
        return solve_directly(mesh, contact, motion, right_sides)
            .ok_or_else(|| not_converged(1.0));
    }

    // Large systems are solved by GCR: for the reversed motion on the contact reversed along x.
    if motion == KernelDirection::Reversed {
        region = region.reversed();
    }
    let mut operator = KernelOperator::new(plans.kernel(region.shape), &region);
    let mut preconditioner = WienerHopf::new(plans.inverse_factors(region.shape), &region);
    let (mut worst_residual, mut converged) = (0.0_f64, true);
    let solve_one = |right: &Vec<f64>| {
        let allowed = ADJOINT_TOLERANCE * norm(right);
        let mut loads = vec![0.0; n];
        let mut residual: Vec<f64> = right.iter().map(|value| -value).collect();
        gcr(
            &mut loads,
            &mut residual,
            GCR_LIMITS,
            |state, direction, image| {
                if state.residual_square.sqrt() <= allowed {
                    return false;
                }
                direction.copy_from_slice(&preconditioner.approximate_loads(state.source, &region));
                image.copy_from_slice(&operator.apply(0, direction, &region));
                true
            },
        );
        worst_residual = worst_residual.max(ADJOINT_TOLERANCE * norm(&residual) / allowed);
        converged &= norm(&residual) <= allowed;
        loads
    };
    let solutions = right_sides.iter().map(solve_one).collect();
    if converged {
        return Ok(solutions);
    }

    // A material that is nearly viscous over the contact length may need as many directions as unknowns.
    (n <= dense::MAX_UNKNOWNS)
        .then(|| solve_directly(mesh, contact, motion, right_sides))
        .flatten()
        .ok_or_else(|| not_converged(worst_residual))
}

/// Solves by LU factorisation. `None` if the matrix is singular.
fn solve_directly(
    mesh: &Mesh,
    contact: &[usize],
    motion: KernelDirection,
    right_sides: &[Vec<f64>],
) -> Option<Vec<Vec<f64>>> {
    let entry = |row: usize, column: usize| {
        let [to, from] = [contact[row], contact[column]];
        match motion {
            KernelDirection::Forward => mesh.influence(to, from),
            KernelDirection::Reversed => mesh.reversed_influence(to, from),
        }
    };
    dense::solve(entry, right_sides.to_vec())
}

/// The error for adjoint equations that leave a relative `residual`.
const fn not_converged(residual: f64) -> BemError {
    BemError::ContactNotConverged {
        iterations: MAX_GCR_STEPS,
        residual,
        tolerance: ADJOINT_TOLERANCE,
    }
}
