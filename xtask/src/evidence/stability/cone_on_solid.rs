//! The cone in the one-dimensional model of any linear viscoelastic material in closed form up to integrals: an exact solution
//! with which the solvers of that model are judged.
//!
//! With h̃ = s |x|, in contact from −y to x_r, each branch has the length l = v τ, and
//!
//! ```text
//! ahead    e = G s l (1 − e^(−z/l)),  z = x_r − x           behind   e = G s l (q e^(−z/l) − (1 − e^(−z/l))),  z = −x
//! w = G_∞ u ± η₀ v s + Σ e,   u = s (x_r − |x|),   q = 1 − e^(−x_r/l);   w(−y) = 0 or a jump below it at the apex
//! F_N = 4 ∫ w dx,    F_h = 4 ∫ w h̃' dx = 4 (energy that the dashpots take + what springs hold where they let go)
//! ```

use anyhow::{Context, Result};
use numerics::{bracketed_root, integrate};
use rheology::{RelaxationBranch, RelaxationSpectrum};

/// Stationary sliding of a cone.
pub(super) struct ConeOnSolid {
    /// Normal force F_N, in the unit of the moduli times the square of x_r.
    pub(super) normal_force: f64,
    /// Friction coefficient F_h/F_N.
    pub(super) friction_coefficient: f64,
}

/// Solves a cone whose line has the slope s = 1, with its front at x_r = 1, at speed v. Fails where no place y behind the apex
/// is found at which the load vanishes.
pub(super) fn cone_on_solid(material: &RelaxationSpectrum, velocity: f64) -> Result<ConeOnSolid> {
    let branch = |branch: &RelaxationBranch| Branch {
        modulus: branch.modulus,
        length: velocity * branch.relaxation_time,
    };
    let branches: Vec<Branch> = material.branches().iter().map(branch).collect();
    let spring = material.equilibrium_modulus();
    let dashpot = material.viscosity() * velocity;
    // Find the rear of the contact, where the load at a distance y behind the apex vanishes. A dashpot would need tension there, so that the
    // contact may end at the apex itself; a material that is nearly elastic is symmetric up to y = x_r.
    let behind = |y: f64| {
        let stresses: f64 = branches.iter().map(|branch| branch.behind(y)).sum();
        spring * (1.0 - y) - dashpot + stresses
    };
    let rear = if behind(0.0) <= 0.0 {
        0.0
    } else if behind(1.0) >= 0.0 {
        1.0
    } else {
        bracketed_root(behind, [0.0, 1.0]).context("no place where the load vanishes")?
    };
    // Compute load and work of the spring and the dashpot in closed form, then add those of each branch by quadrature.
    let left = 1.0 - rear;
    let mut load = 0.5 * spring * (2.0 - left * left) + dashpot * left;
    let mut work = dashpot * (1.0 + rear) + 0.5 * spring * left * left;
    for branch in &branches {
        let ahead = |distance: f64| branch.ahead(distance);
        let behind = |distance: f64| branch.behind(distance);
        load += integral(ahead, 1.0) + integral(behind, rear);
        let squares = integral(|z| ahead(z).powi(2), 1.0) + integral(|z| behind(z).powi(2), rear);
        work += squares / branch.stiffness() + 0.5 * behind(rear).powi(2) / branch.modulus;
    }
    Ok(ConeOnSolid {
        normal_force: 4.0 * load,
        friction_coefficient: work / load,
    })
}

/// Integral of a stress over the distance from the front or the apex, where quadrature refines: short branches fade there.
fn integral(stress: impl Fn(f64) -> f64, length: f64) -> f64 {
    integrate(stress, [0.0, length], 1e-12).value
}

/// A spring in series with a dashpot.
struct Branch {
    /// Modulus G of the spring.
    modulus: f64,
    /// Relaxation length l = v τ.
    length: f64,
}

impl Branch {
    /// G l: the stress that sliding at constant slope 1 approaches.
    fn stiffness(&self) -> f64 {
        self.modulus * self.length
    }

    /// Stress of the branch at a distance behind the front of the contact, before the apex.
    fn ahead(&self, distance: f64) -> f64 {
        -self.stiffness() * (-distance / self.length).exp_m1()
    }

    /// Stress of the branch at a distance behind the apex.
    fn behind(&self, distance: f64) -> f64 {
        let lost = (-distance / self.length).exp_m1();
        self.ahead(1.0) * (1.0 + lost) + self.stiffness() * lost
    }
}
