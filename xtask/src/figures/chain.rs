//! The chain of dashpots of the paper, Sect. 3 and 4, with its fixed step: in each step the line moves on by one element, and
//! sinks until the dashpots carry the normal force.
//!
//! ```text
//! Σ (d − h_i − u_i)⁺ = F_N/(4 η v) = D,   μ = Σ (d − h_i − u_i)⁺ (h_(i+1) − h_i)/(Δx D)
//! ```

use anyhow::Result;
use indenters::{EquivalentLine, RigidLine};
use numerics::whole_part;

use crate::scene::Scene;

/// Ratio of the sliding distance to the contact length. Chosen: the approach to the stationary state is exponential, and e^(−24)
/// = 4e-11 is left.
const SLID_CONTACT_LENGTHS: f64 = 24.0;

/// The chain after one step.
pub(super) struct ChainStep {
    /// μ of this step.
    pub(super) friction_coefficient: f64,
    /// Indentation depth d, \[m].
    pub(super) indentation_depth: f64,
}

/// Slides the chain from first touch into the stationary state, on elements of a spacing \[m]; one entry for each step.
pub(super) fn slide(scene: &Scene, spacing: f64) -> Result<Vec<ChainStep>> {
    let theory = scene.theory()?;
    let (compression, length) = (theory.indentation_depth, theory.contact_length());
    let line = EquivalentLine(&scene.body);

    // Place elements from behind the rear to the first one in front of the contact, with the lowest point of the body over one of
    // them.
    let n_ahead = whole_part((length / spacing).ceil()) + 1;
    let position = |element: usize| (element as f64 - n_ahead as f64) * spacing;
    let heights: Vec<f64> = (0..=2 * n_ahead)
        .map(|element| line.height(position(element)))
        .collect();
    let mut displacements = vec![0.0; heights.len()];

    let step = |_| {
        // Move the body by one element: displacements go back by one place, and an undeformed element enters in front.
        displacements.rotate_left(1);
        displacements[2 * n_ahead] = 0.0;

        // Let the body sink to the depth at which the compressions add up to the given sum.
        let depths = heights.iter().zip(&displacements).map(|(h, u)| h + u);
        let depth = depth_of(depths.collect(), compression);
        let mut friction = 0.0;
        for (element, u) in displacements.iter_mut().enumerate() {
            let compressed = (depth - heights[element] - *u).max(0.0);
            if compressed > 0.0 {
                let rise = heights[element + 1] - heights[element];
                friction += compressed / compression * rise / spacing;
                *u += compressed;
            }
        }
        ChainStep {
            friction_coefficient: friction,
            indentation_depth: depth,
        }
    };
    let n_steps = whole_part(SLID_CONTACT_LENGTHS * length / spacing);
    Ok((0..n_steps).map(step).collect())
}

/// The depth d with Σ (d − t_i)⁺ = `compression`, from the depths t_i at which the line touches the elements. The sum is
/// piecewise linear in d: with the n smallest t_i below d, d = (compression + Σ t_i)/n, and n grows until the next t_i is not
/// below.
fn depth_of(mut touches: Vec<f64>, compression: f64) -> f64 {
    touches.sort_by(f64::total_cmp);
    let mut sum = compression;
    let mut depth = f64::INFINITY;
    for (n_before, touch) in touches.into_iter().enumerate() {
        if touch >= depth {
            break;
        }
        sum += touch;
        depth = sum / (n_before + 1) as f64;
    }
    depth
}
