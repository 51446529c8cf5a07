//! Derivatives of the force along a path of the depth by material, position of first contact and shape of the body.
//!
//! The element at the edge of a shrinking contact carries the load w = 0, so that its time of contact t₁ does not affect the
//! force. The derivatives are therefore those of the closed form in `approach.rs` at constant t₁.

use indenters::{Control, EquivalentProfile, HistoryPoint};
use numerics::{in_range, positive};
use rheology::Material;

use super::approach::{Approach, EdgePlace};
use super::radius::Radii;
use super::validated_points;
use crate::{MdrError, error};

/// The force along a history and its derivatives; each list has one entry per point of the history, 0 without contact.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct ForceDerivatives {
    /// Normal force F, \[N].
    pub normal_force: Vec<f64>,
    /// Contact radius a, \[m].
    pub contact_radius: Vec<f64>,
    /// Derivative ∂F/∂G_∞ by the equilibrium modulus, \[m²].
    pub equilibrium_modulus: Vec<f64>,
    /// Derivative ∂F/∂η₀ by the viscosity of the parallel dashpot, [m²/s].
    pub viscosity: Vec<f64>,
    /// Derivatives ∂F/∂G_k by the moduli, \[m²], branch by branch in the order of the relaxation spectrum.
    pub moduli: Vec<Vec<f64>>,
    /// Derivatives ∂F/∂τ_k by the relaxation times, [N/s], branch by branch.
    pub relaxation_times: Vec<Vec<f64>>,
    /// Derivative by a shift of all depths, [N/m]: minus the derivative by the position of first contact.
    pub depth: Vec<f64>,
    /// Derivative ∂F/∂ln c, \[N], of a body whose heights are all multiplied by c: the slope of a cone, the inverse radius of a
    /// paraboloid; for the radius R of a sphere ∂F/∂R is the sum of F and this over R.
    pub stretch: Vec<f64>,
    /// Number of points up to which all derivatives are exact; afterwards elements come into contact again.
    pub exact_until: usize,
}

/// The force along a path of the depth and its derivatives, for a contact that grows once and shrinks once, with holds.
///
/// Small dips of the depth are allowed: an element that comes into contact again counts as if it had never separated, an
/// error of second order in the dip. A surface counts as recovered once the body is above its undeformed position. The
/// first such point is [`ForceDerivatives::exact_until`]; [`indent_along`](super::indent_along) is exact there too.
///
/// # Errors
/// Like [`indent_along`](super::indent_along); [`MdrError::InvalidParameter`] for a force, too.
pub fn force_derivatives(
    body: &dyn EquivalentProfile,
    material: &dyn Material,
    history: &[HistoryPoint],
) -> Result<ForceDerivatives, MdrError> {
    let points = validated_points(history)?;
    if let Control::NormalForce(force) = history[0].control {
        let allowed = "a depth, whose force is differentiated";
        in_range("control", force, false, allowed)?;
    }
    // The result begins empty, with one list for each branch. A body that never goes below the surface has neither force nor
    // derivatives.
    let deepest = points.iter().map(|[_, depth]| *depth).fold(0.0, f64::max);
    let spectrum = material.relaxation();
    let branch_lists = vec![Vec::new(); spectrum.branches().len()];
    let mut result = ForceDerivatives {
        moduli: branch_lists.clone(),
        relaxation_times: branch_lists,
        ..ForceDerivatives::default()
    };
    if deepest == 0.0 {
        result.exact_until = points.len();
        points.iter().for_each(|_| result.push_point(None, 0.0));
        return Ok(result);
    }
    let mut approach = Approach::new(Radii::new(body, deepest)?, &spectrum, points.len(), true);
    approach.start(points[0][0], points[0][1]);
    let factor = 8.0 / material.half_space_factor();
    // Follow the path, and append force and derivatives at each point.
    for (index, point) in points.iter().enumerate() {
        if approach.viscosity > 0.0 && index > 0 {
            positive("time between two depths", point[0] - points[index - 1][0])?;
        }
        approach.follow(point[0], point[1]);
        let place = approach.edge.place;
        result.push_point(place.map(|place| (&approach, place)), factor);
        error::finite("normal force", result.normal_force[index], point[0])?;
        if !approach.has_recontact {
            result.exact_until = index + 1;
        }
    }
    Ok(result)
}

impl ForceDerivatives {
    /// Appends the force and its derivatives at the present point; 0 without contact (`None`). `factor` is 8/(2 (1 − ν)).
    fn push_point(&mut self, contact: Option<(&Approach, EdgePlace)>, factor: f64) {
        let n_branches = self.moduli.len();
        let [mut force, mut by_depth, mut by_stretch] = [0.0; 3];
        let [mut by_viscosity, mut contact_radius] = [0.0; 2];
        let mut columns = vec![[0.0; 2]; n_branches + 1];
        if let Some((approach, place)) = contact {
            let EdgePlace {
                radius,
                slope,
                depth,
            } = place;
            contact_radius = approach.radius();

            // The dashpot gives the derivative by the viscosity η₀. A change of the depth or of the heights of the body also
            // shifts the edge, where the element carries `edge.load`.
            let (edge, at_contact, rates) = (&approach.edge, &approach.at_contact, &approach.rates);
            by_viscosity = approach.speed * radius;
            force = approach.viscosity * by_viscosity;
            by_depth = slope * edge.load;
            by_stretch = -depth * slope * edge.load;
            for (k, time_weighted) in at_contact.time_weighted.iter().enumerate() {
                let (modulus, decay, lag) = (approach.moduli[k], edge.decays[k], edge.lag);
                by_depth += modulus * decay * time_weighted.edge;
                by_stretch += modulus * decay * time_weighted.stretch;
                // The derivative by a relaxation time is ∂F/∂τ_k = −∂F/∂(1/τ_k)/τ_k². That by the rate 1/τ_k follows from
                // integrals weighted by the time that has passed.
                let slower = approach.now.time_weighted[k].depth
                    - decay * (time_weighted.depth + lag * at_contact.depth[k]);
                let by_rate =
                    -radius * slower - decay * (time_weighted.load + lag * at_contact.load[k]);
                force += modulus * edge.sums[k];
                columns[k] = [edge.sums[k], -modulus * by_rate * rates[k] * rates[k]];
            }
        }
        self.normal_force.push(factor * force);
        self.contact_radius.push(contact_radius);
        self.viscosity.push(factor * by_viscosity);
        self.depth.push(factor * by_depth);
        self.stretch.push(factor * by_stretch);
        self.equilibrium_modulus
            .push(factor * columns[n_branches][0]);
        for (k, [by_modulus, by_time]) in columns[..n_branches].iter().enumerate() {
            self.moduli[k].push(factor * by_modulus);
            self.relaxation_times[k].push(factor * by_time);
        }
    }
}
