//! Adjoint loads: solutions with the transposed kernel, which is that of the motion in the opposite direction.
//!
//! A contact that is turned about across the motion has the transposed equations as its own, so that the kernel and the
//! preconditioner of the contact serve both.

use nalgebra::{DMatrix, DVector};

use crate::BemError;
use crate::stationary::conjugate_residuals::{minimise, norm};
use crate::stationary::steady::contact_equations::{MOST_DIRECTIONS, is_factorised};
use crate::stationary::steady::filter::Product;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::wiener_hopf::WienerHopf;

/// Residual of the adjoint equations over their right side.
const TOLERANCE: f64 = 1e-9;
/// Unknowns that are factorised where the iteration does not end; their matrix takes 32 MB.
const MOST_FACTORISED: usize = 2000;

/// Which way the contact moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Motion {
    /// As it does, with the kernel K.
    Own,
    /// Backwards, with its transpose.
    Turned,
}

/// The loads on a contact that solve `K y = r` for each of the right sides, in the units of the mesh, with the kernel of the
/// motion; or the residual that is left, relative to the right side.
pub(super) fn solve(
    mesh: &Mesh,
    plans: &mut Plans,
    (contact, motion): (&[usize], Motion),
    right: &[Vec<f64>],
) -> Result<Vec<Vec<f64>>, BemError> {
    let mut region = mesh.region(contact.iter().copied());
    let n = contact.len();
    if is_factorised(n, region.n_places()) {
        return factorise(mesh, (contact, motion), right).ok_or_else(|| not_solved(1.0));
    }
    if motion == Motion::Turned {
        region = region.turned();
    }
    let mut product = Product::new(plans.kernel(region.shape), &region);
    let mut preconditioner = WienerHopf::new(plans.inverse_factors(region.shape), &region);
    let (mut left, mut has_ended) = (0.0_f64, true);
    let solved = right.iter().map(|right| {
        let allowed = TOLERANCE * norm(right);
        let mut loads = vec![0.0; n];
        let mut residual: Vec<f64> = right.iter().map(|value| -value).collect();
        let unknowns = [&mut loads[..], &mut residual[..]];
        let most = [MOST_DIRECTIONS; 2];
        minimise(
            unknowns,
            None,
            most,
            |size, [_, from], [direction, image]| {
                if size.sqrt() <= allowed {
                    return false;
                }
                direction.copy_from_slice(&preconditioner.loads(from, &region));
                image.copy_from_slice(&product.apply(0, direction, &region));
                true
            },
        );
        left = left.max(TOLERANCE * norm(&residual) / allowed);
        has_ended &= norm(&residual) <= allowed;
        loads
    });
    let solved = solved.collect();
    if has_ended {
        return Ok(solved);
    }
    // What is nearly viscous over the length of the contact may need a direction for every unknown.
    let few = (n <= MOST_FACTORISED).then(|| factorise(mesh, (contact, motion), right));
    few.flatten().ok_or_else(|| not_solved(left))
}

fn factorise(
    mesh: &Mesh,
    (contact, motion): (&[usize], Motion),
    right: &[Vec<f64>],
) -> Option<Vec<Vec<f64>>> {
    let n = contact.len();
    let entry = |row: usize, column: usize| {
        let [to, from] = [contact[row], contact[column]];
        match motion {
            Motion::Own => mesh.influence(to, from),
            Motion::Turned => mesh.reversed(to, from),
        }
    };
    let factors = DMatrix::from_fn(n, n, entry).lu();
    let solved = right.iter().map(|right| {
        let solved = factors.solve(&DVector::from_column_slice(right))?;
        Some(Vec::from(solved.data))
    });
    solved.collect()
}

const fn not_solved(residual: f64) -> BemError {
    BemError::ContactNotConverged {
        iterations: MOST_DIRECTIONS,
        residual,
        tolerance: TOLERANCE,
    }
}
