//! Normal indentation, on any material.
//!
//! While the contact grows, or stays as it is, half space and line agree exactly (Lee & Radok 1960), and a constant force
//! acts on every material like the impulse F J(t) on a dashpot of unit viscosity:
//!
//! ```text
//! 8 ∫₀^a x h̃' dx = 2 (1 − ν) F J(t)         constant force
//! F(t) = 8 G(t)/(2 (1 − ν)) ∫₀^a x h̃' dx    constant depth, contact radius a
//! ```

use super::error::{Result, bail};
use bem_halfspace::indent::IndentStep;
use friction_analytic::indentation_after_impulse;
use indenters::{Axisymmetric, EquivalentLine};
use rheology::{Material, RheologyError, Viscous};

use super::answer::Answer;
use super::body::Revolution;
use crate::scene::{Accuracy, Control, Method, Model};
use numerics::{Estimate, Goal, Quantity, Refined, no_other_error, refine};

/// The dashpot on which an impulse does what the material does with F J(t).
pub(crate) fn unit_dashpot() -> Result<Viscous, RheologyError> {
    Viscous::new(1.0)
}

pub(crate) fn impulse(material: &dyn Material, force: f64, duration: f64) -> Result<f64> {
    let compliance = material.half_space_factor() * material.creep_compliance(duration)?;
    Ok(force * compliance)
}

/// Force at a depth that was held for a duration, over the impulse that leads to it on the unit dashpot, [1/s].
pub(crate) fn stiffness(material: &dyn Material, duration: f64) -> Result<f64> {
    let modulus = material.relaxation_modulus(duration)?;
    let stiffness = modulus / material.half_space_factor();
    if !(stiffness.is_finite() && stiffness > 0.0) {
        bail!(
            "at a depth held for {duration} s the force has relaxed: the relaxation modulus is {modulus:e} Pa there"
        );
    }
    Ok(stiffness)
}

/// The chain of elements, in as many steps as elements.
pub(crate) fn chain(
    body: &Revolution,
    material: &dyn Material,
    (force, duration): (f64, f64),
    accuracy: Accuracy,
) -> Result<Answer> {
    let radius = radius(body, material, force, duration)?;
    let solve = |elements: usize| {
        let times: Vec<f64> = (1..=elements)
            .map(|step| duration * (step as f64 / elements as f64))
            .collect();
        let spacing = 2.0 * radius / elements as f64;
        let options = mdr_core::IndentOptions { spacing };
        let line = EquivalentLine(body);
        let rows = mdr_core::indent(&line, material, force, &times, &options)?;
        last(rows)
    };
    let goal = goal(accuracy, LARGEST_CHAIN);
    let depth = |row: &mdr_core::IndentRow| {
        [Quantity {
            least: error_of_outline(body, row),
            ..Quantity::from(row.indentation_depth)
        }]
    };
    let Refined {
        value: row,
        error: [error],
        parts: [parts],
        elements,
    } = refine(&goal, solve, depth, no_other_error)?;
    Ok(Answer {
        indentation_depth: Some(Estimate {
            value: row.indentation_depth,
            error,
        }),
        error_parts: parts,
        unknowns: row.n_contact,
        iterations: elements,
        ..Answer::new(Method::MdrTransient, Model::Line, Estimate::exact(force))
    })
}

/// The outermost elements are loaded as wholes, whatever part of them touches: at the edge of a flat end they carry as much
/// as any, at every resolution.
fn error_of_outline(body: &Revolution, row: &mdr_core::IndentRow) -> f64 {
    let depth = row.indentation_depth;
    let carried = row.contact.map_or(depth, |[_, front]| {
        (depth - body.line_height(front)).clamp(0.0, depth)
    });
    carried / row.n_contact as f64
}

/// Depth and force converge faster than that, cusps or not.
const ORDER: f64 = 1.0;

fn goal(accuracy: Accuracy, largest: usize) -> Goal {
    Goal {
        accuracy,
        largest,
        order: ORDER,
    }
}

/// What does in a second on the dashpot of unit viscosity what the control does to the material.
pub(crate) fn on_unit_dashpot(
    material: &dyn Material,
    (control, duration): (Control, f64),
) -> Result<Control> {
    Ok(match control {
        Control::NormalForce(force) => Control::NormalForce(impulse(material, force, duration)?),
        depth @ Control::IndentationDepth(_) => depth,
    })
}

/// A second of a constant force, or of a depth that grows in proportion to time.
pub(crate) fn in_steps(control: Control, n_steps: usize) -> Vec<IndentStep> {
    let step = |step: usize| {
        let time = step as f64 / n_steps as f64;
        let control = match control {
            Control::NormalForce(force) => Control::NormalForce(force),
            Control::IndentationDepth(depth) => Control::IndentationDepth(time * depth),
        };
        IndentStep { time, control }
    };
    (1..=n_steps).map(step).collect()
}

const LARGEST_CHAIN: usize = 16_384;

/// The radius that the contact will have, for the size of the elements only.
fn radius(body: &Revolution, material: &dyn Material, force: f64, duration: f64) -> Result<f64> {
    let impulse = impulse(material, force, duration)?;
    Ok(indentation_after_impulse(body, &unit_dashpot()?, impulse)?.contact_radius)
}

fn last<R>(rows: Vec<R>) -> Result<R> {
    match rows.into_iter().next_back() {
        Some(row) => Ok(row),
        None => bail!("the march made no step"),
    }
}

#[cfg(test)]
mod tests {
    use indenters::FlatCone;
    use rheology::Elastic;

    use indenters::PressingLoad;

    use super::super::analytic::pressed;
    use super::*;

    /// The flanks carry a little, and no element sees it: all resolutions agree, and are wrong.
    #[test]
    fn the_bar_of_a_flat_end_holds_where_no_element_sees_its_flanks() {
        let material = Elastic::new(1.0).expect("a material");
        let cone = FlatCone::new(1.0, 0.4).expect("a body");
        let body = Revolution::Other(Box::new(cone));
        for force in [1e-3, 1e-2, 1e-1, 1.0, 10.0] {
            let load = PressingLoad::new(Control::NormalForce(force), 1.0).expect("a load");
            let exact = pressed(&body, &material, &load).expect("a depth");
            for elements in [16, 64, 512] {
                let accuracy = Accuracy::Elements(elements);
                let got = chain(&body, &material, (force, 1.0), accuracy).expect("a depth");
                let [value, expected] =
                    [&got, &exact].map(|answer| answer.indentation_depth.expect("a depth"));
                let (bar, value, expected) = (value.error, value.value, expected.value);

                assert!(
                    (value - expected).abs() <= bar && bar < 0.2 * expected,
                    "{force} N, {elements} elements: {value} ± {bar} instead of {expected}"
                );
            }
        }
    }
}
