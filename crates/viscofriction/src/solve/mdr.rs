//! Sliding on the one-dimensional model.

use super::error::Result;
use indenters::{Axisymmetric, EquivalentLine, SlidingLoad};
use mdr_core::{
    MdrError, SlideOptions, SlideRow, SlidingDepth, SteadyOptions, slide, steady, steady_at_depth,
};
use rheology::Material;

use super::answer::{Answer, HistoryRow, within};
use super::body::Revolution;
use super::memory::ahead;
use super::order_of_apex;
use crate::scene::{Accuracy, Control, Method, Model};
use numerics::{ErrorParts, Estimate, Goal, Quantity, refine};

/// Elements along the contact after which a march in time gives up.
const LARGEST_CHAIN: usize = 4096;
/// Relative rounding of the stationary state; on a sphere of 46 times the contact 5e-12 was measured.
const STEADY_ROUNDING: f64 = 1e-11;
/// Rounding of forces times slopes, relative to the mean slope.
const ROUNDING: f64 = 1e-12;

/// The stationary state.
pub(crate) fn stationary(
    body: &Revolution,
    material: &dyn Material,
    (control, velocity): (Control, f64),
    relative_error: f64,
) -> Result<Answer> {
    let options = SteadyOptions { relative_error };
    let line = EquivalentLine(body);
    let state = match control {
        Control::NormalForce(force) => steady(
            &line,
            material,
            &SlidingLoad::new(force, velocity)?,
            &options,
        ),
        Control::IndentationDepth(indentation_depth) => {
            let motion = SlidingDepth {
                indentation_depth,
                velocity,
            };
            steady_at_depth(&line, material, &motion, &options)
        }
    }?;
    let error =
        state.friction_coefficient_error + STEADY_ROUNDING * state.friction_coefficient.abs();
    let (force, depth) = match control {
        Control::NormalForce(force) => {
            let depth = within(state.indentation_depth, relative_error);
            (Estimate::exact(force), depth)
        }
        Control::IndentationDepth(depth) => (
            within(state.normal_force, relative_error),
            Estimate::exact(depth),
        ),
    };
    Ok(Answer {
        friction_coefficient: Some(Estimate {
            value: state.friction_coefficient,
            error,
        }),
        indentation_depth: Some(depth),
        error_parts: ErrorParts::of_elements(state.friction_coefficient_error),
        unknowns: state.n_pieces,
        ..Answer::new(Method::MdrSteady, Model::Line, force)
    })
}

/// Changes that fall more slowly from contact length to contact length are rounding.
const SLOWEST_RATIO: f64 = 0.99;

/// A body that slides over a chain.
struct Ride<'a> {
    body: &'a Revolution,
    load: &'a SlidingLoad,
    /// From first touch \[m]; none for the stationary state.
    distance: Option<f64>,
}

/// From first touch to the stationary state, or over a distance.
pub(crate) fn transient(
    body: &Revolution,
    material: &dyn Material,
    (load, distance): (&SlidingLoad, Option<f64>),
    accuracy: Accuracy,
) -> Result<Answer> {
    let ride = Ride {
        body,
        load,
        distance,
    };
    let solve = |elements: usize| ride.march(material, &ride.options(material, elements)?);
    let goal = Goal {
        accuracy,
        largest: LARGEST_CHAIN,
        order: order_of_apex(body.profile_exponent()),
    };
    let others = |elements: usize, rows: &Vec<SlideRow>| {
        Ok([ErrorParts {
            time_stepping: ride.error_of_step(material, elements, rows)?,
            truncation: ride.rest_of_the_way(rows),
            ..ErrorParts::NONE
        }])
    };
    let resolved = refine(&goal, solve, |rows| [ride.friction(rows)], others)?;
    let (rows, [error], [parts]) = (resolved.value, resolved.error, resolved.parts);
    let last = last(&rows)?;
    let force = Estimate::exact(load.require_normal_force()?);
    let mut answer = Answer {
        friction_coefficient: Some(Estimate {
            value: ride.friction(&rows).value,
            error,
        }),
        error_parts: parts,
        unknowns: last.n_contact,
        iterations: rows.len(),
        ..Answer::new(Method::MdrTransient, Model::Line, force)
    };
    answer.fields.history = rows.iter().map(history).collect();
    Ok(answer)
}

impl Ride<'_> {
    fn options(&self, material: &dyn Material, elements: usize) -> Result<SlideOptions> {
        let mut options = SlideOptions::with_elements(elements, self.body, material, self.load)?;
        if let Some(distance) = self.distance {
            let steps = (distance / options.spacing).ceil().max(1.0);
            options.spacing = distance / steps;
            // Half a step more than the last step, so that rounding does not lose it.
            options.max_sliding_distance = distance + 0.5 * options.spacing;
        }
        Ok(options)
    }

    /// One step or more.
    fn march(&self, material: &dyn Material, options: &SlideOptions) -> Result<Vec<SlideRow>> {
        let rows = match slide(&EquivalentLine(self.body), material, self.load, options) {
            Ok(transient) => transient.rows,
            Err(MdrError::NotStationary { rows, .. }) if self.distance.is_some() => rows,
            Err(error) => return Err(error.into()),
        };
        last(&rows)?;
        Ok(rows)
    }

    /// The friction of a step belongs to its middle; on the way to the stationary state the end is half a step further.
    fn friction(&self, rows: &[SlideRow]) -> Quantity {
        let value = match rows {
            [.., before, last] if self.distance.is_some() => {
                1.5 * last.friction_coefficient - 0.5 * before.friction_coefficient
            }
            [.., last] => last.friction_coefficient,
            [] => 0.0,
        };
        let rounding = rows.last().map_or(0.0, |last| {
            ROUNDING * (last.indentation_depth / last.contact_length)
        });
        Quantity {
            rounding,
            ..Quantity::from(value)
        }
    }

    /// What is left of an exponential approach, by its change over the last contact length and over the one before; on
    /// the way to the stationary state nothing is left out.
    ///
    /// A march may end after little more than one contact length; then the change before it is that since the first step.
    fn rest_of_the_way(&self, rows: &[SlideRow]) -> Option<f64> {
        let (last, None) = (rows.last()?, self.distance) else {
            return None;
        };
        let back = |lengths: usize| {
            let row = (rows.len() - 1).saturating_sub(lengths * last.n_contact);
            rows[row].friction_coefficient
        };
        let [now, before, earlier] = [0, 1, 2].map(back);
        let [change, change_before] = [now - before, before - earlier].map(f64::abs);
        let ratio = (change / change_before).min(SLOWEST_RATIO);
        Some(change * ratio / (1.0 - ratio)).filter(|rest| rest.is_finite())
    }

    /// What the step does to the memory of the material, if it has one.
    fn error_of_step(
        &self,
        material: &dyn Material,
        elements: usize,
        rows: &[SlideRow],
    ) -> Result<Option<f64>> {
        let options = self.options(material, elements)?;
        let Some(ahead) = ahead(material, options.spacing / self.load.velocity())? else {
            return Ok(None);
        };
        let rows_ahead = self.march(&ahead, &options)?;
        let [value, value_ahead] = [rows, &rows_ahead].map(|rows| self.friction(rows).value);
        Ok(Some((value_ahead - value).abs()))
    }
}

fn last(rows: &[SlideRow]) -> Result<&SlideRow> {
    rows.last()
        .ok_or_else(|| super::error::SolveError::NotReached("the march made no step".to_owned()))
}

fn history(row: &SlideRow) -> HistoryRow {
    HistoryRow {
        sliding_distance_m: row.sliding_distance,
        time_s: row.time,
        indentation_depth_m: row.indentation_depth,
        friction_coefficient: row.friction_coefficient,
    }
}

#[cfg(test)]
mod tests {
    use indenters::PowerProfile;
    use rheology::{Elastic, Maxwell, StandardSolid, StandardSolidParameters};

    use super::*;

    fn body(exponent: f64) -> Revolution {
        Revolution::Power(PowerProfile::new(1.0, exponent).expect("a body"))
    }

    fn solid(times: f64) -> StandardSolid {
        let parameters = StandardSolidParameters {
            equilibrium_modulus: 1.0,
            maxwell_modulus: 3.0,
            viscosity: 3.0 * times,
        };
        StandardSolid::new(parameters).expect("a material")
    }

    fn exact(body: &Revolution, material: &dyn Material, load: &SlidingLoad) -> f64 {
        let options = SteadyOptions::default();
        let state = steady(&EquivalentLine(body), material, load, &options);
        state.expect("a stationary state").friction_coefficient
    }

    /// What is not of first order is smaller by the number of elements along the layer or the contact, and is seen to be:
    /// a tenth on 256 elements, of which 26 are along the shortest way of relaxation.
    #[test]
    fn the_error_of_the_step_is_that_of_a_chain_with_memory() {
        let load = SlidingLoad::new(4.0, 1.0).expect("a load");
        let maxwell = Maxwell::new(5.0, 1.0).expect("a material");
        let solids = [0.2, 1.0].map(solid);
        let materials: [&dyn Material; 3] = [&maxwell, &solids[0], &solids[1]];
        for (exponent, material) in [1.0, 2.0].iter().flat_map(|p| materials.map(|m| (*p, m))) {
            let body = body(exponent);
            let ride = Ride {
                body: &body,
                load: &load,
                distance: None,
            };
            let elements = 256;
            let options = ride.options(material, elements).expect("options");
            let rows = ride.march(material, &options).expect("a march");
            let part = ride.error_of_step(material, elements, &rows);
            let part = part.expect("a march").expect("a memory");
            let deviation = (ride.friction(&rows).value - exact(&body, material, &load)).abs();
            let ratio = part / deviation;
            assert!(
                (0.95..1.15).contains(&ratio),
                "p = {exponent} on {material:?}: off by {deviation:e}, and the part is {part:e}"
            );
        }
    }

    #[test]
    fn a_longer_march_changes_the_friction_by_less_than_the_truncation() {
        let load = SlidingLoad::new(4.0, 1.0).expect("a load");
        for times in [0.1, 1.0, 10.0] {
            let (body, material) = (body(2.0), solid(times));
            let ride = Ride {
                body: &body,
                load: &load,
                distance: None,
            };
            let march = |drift_tolerance: f64| {
                let options = ride.options(&material, 32).expect("options");
                let options = SlideOptions {
                    drift_tolerance,
                    max_sliding_distance: 10.0 * options.max_sliding_distance,
                    ..options
                };
                ride.march(&material, &options).expect("a march")
            };
            // Rounding is far below what is left after the shorter one.
            let [rows, longer] = [1e-5, 1e-10].map(march);
            let change = (ride.friction(&longer).value - ride.friction(&rows).value).abs();
            let part = ride.rest_of_the_way(&rows).expect("a part");
            assert!(
                change <= part && part < 1e-3 * ride.friction(&rows).value,
                "{times} s: {change:e}, and the part is {part:e}"
            );
        }
    }
    /// The friction of an elastic chain is rounding from the first step on, so that its march ends at once.
    #[test]
    fn a_march_of_one_contact_length_has_a_truncation_too() {
        let load = SlidingLoad::new(4.0, 1.0).expect("a load");
        let (body, material) = (body(2.0), Elastic::new(1.0).expect("a material"));
        let ride = Ride {
            body: &body,
            load: &load,
            distance: None,
        };
        let options = ride.options(&material, 32).expect("options");
        let rows = ride.march(&material, &options).expect("a march");
        let lengths = rows.len() as f64 / rows[rows.len() - 1].n_contact as f64;
        assert!(lengths < 2.0, "a march of {lengths} contact lengths");
        let part = ride.rest_of_the_way(&rows).expect("a part");
        let rounding = ride.friction(&rows).rounding;
        assert!(
            part <= rounding,
            "{part:e} is more than the rounding {rounding:e}"
        );
    }
}
