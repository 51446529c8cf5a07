//! The cone on a line of any linear viscoelastic material, by its own formulas: the judge of the one-dimensional solvers.
//!
//! With h̃ = s |x|, in contact from −y to x_r, each branch has the length l = v τ, and
//!
//! ```text
//! ahead    e = G s l (1 − e^(−z/l)),  z = x_r − x           behind   e = G s l (q e^(−z/l) − (1 − e^(−z/l))),  z = −x
//! w = G_∞ u ± η₀ v s + Σ e,   u = s (x_r − |x|),   q = 1 − e^(−x_r/l);   w(−y) = 0 or a jump below it at the apex
//! F_N = 4 ∫ w dx,    F_h = 4 ∫ w h̃' dx = 4 (energy that the dashpots take + what springs hold where they let go)
//! ```

use anyhow::{Context, Result};
use numerics::bracketed_root;
use rheology::{RelaxationBranch, RelaxationSpectrum};

/// Stationary sliding of a cone.
#[derive(Debug, Clone, Copy)]
pub(super) struct ConeOnSolid {
    pub(super) normal_force: f64,
    pub(super) friction_coefficient: f64,
}

/// A cone whose line has the slope s = 1, with its front at x_r = 1, at speed v.
pub(super) fn cone_on_solid(material: &RelaxationSpectrum, velocity: f64) -> Result<ConeOnSolid> {
    let branch = |branch: &RelaxationBranch| Branch {
        modulus: branch.modulus,
        length: velocity * branch.relaxation_time,
    };
    let branches: Vec<Branch> = material.branches().iter().map(branch).collect();
    let spring = material.equilibrium_modulus();
    let dashpot = material.viscosity() * velocity;
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
    let left = 1.0 - rear;
    let mut load = 0.5 * spring * (2.0 - left * left) + dashpot * left;
    let mut work = dashpot * (1.0 + rear) + 0.5 * spring * left * left;
    for branch in &branches {
        load += branch.load(rear);
        work += branch.work(rear);
    }
    Ok(ConeOnSolid {
        normal_force: 4.0 * load,
        friction_coefficient: work / load,
    })
}

struct Branch {
    modulus: f64,
    length: f64,
}

impl Branch {
    fn stiffness(&self) -> f64 {
        self.modulus * self.length
    }

    fn charge(&self) -> f64 {
        -(-1.0 / self.length).exp_m1()
    }

    /// Stress at a distance behind the apex.
    fn behind(&self, distance: f64) -> f64 {
        let lost = (-distance / self.length).exp_m1();
        self.stiffness() * (self.charge() * (1.0 + lost) + lost)
    }

    /// ∫ e dx from −y to 1.
    fn load(&self, y: f64) -> f64 {
        let z = y / self.length;
        let behind = -self.charge() * (-z).exp_m1() - filled(z);
        self.stiffness() * self.length * (filled(1.0 / self.length) + behind)
    }

    /// ∫ e² dx / (G l) from −y to 1 and e²/(2 G) at −y.
    fn work(&self, y: f64) -> f64 {
        let z = y / self.length;
        let q = self.charge();
        let lost = -(-z).exp_m1();
        let behind = -0.5 * q * q * (-2.0 * z).exp_m1() - q * lost * lost + filled_square(z);
        let dissipated =
            self.stiffness() * self.length * (filled_square(1.0 / self.length) + behind);
        let held = self.behind(y);
        dissipated + 0.5 * held * held / self.modulus
    }
}

/// ∫₀^z (1 − e^(−t)) dt = z − 1 + e^(−z).
fn filled(z: f64) -> f64 {
    if z > 0.5 {
        return z + (-z).exp_m1();
    }
    // z²/2! − z³/3! + …
    series(z, 2, |_| 1.0)
}

/// ∫₀^z (1 − e^(−t))² dt = z − 2 (1 − e^(−z)) + (1 − e^(−2z))/2.
fn filled_square(z: f64) -> f64 {
    if z > 0.5 {
        return z + 2.0 * (-z).exp_m1() - 0.5 * (-2.0 * z).exp_m1();
    }
    // Σ (2^(k−1) − 2) (−1)^(k+1) z^k/k! from k = 3
    -series(z, 3, |k| 2_f64.powi(k - 1) - 2.0)
}

/// Σ weight(k) (−z)^k/k! from k = `first`.
fn series(z: f64, first: i32, weight: impl Fn(i32) -> f64) -> f64 {
    let mut term = (1..first).fold(1.0, |term, k| term * (-z / f64::from(k)));
    let mut sum = 0.0;
    for k in first..first + 30 {
        term *= -z / f64::from(k);
        sum += weight(k) * term;
    }
    sum
}
