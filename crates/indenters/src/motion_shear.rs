//! Shear of the contact area along a motion.
//!
//! ```text
//! F_t = F_hysteresis + sign(v) τ_f(|v|) A,      μ_shear = ∫ τ_f A |dx| / ∫ F_N |dx|
//! ```

use numerics::Estimate;

use crate::moved::{Station, interpolate, peak, stations};
use crate::{Control, Moved, MovingLoad};

/// Number of intervals of the midpoint rule between two points of a motion. Chosen: about as many as the time steps of a coarse
/// march; the integrals are exact where area and speed, or area and shear strength, are constant.
const INTERVALS_PER_POINT: usize = 8;
/// Ratio of a speed to the largest one of the motion below which the body is at rest. Derived: the rounding of a sine that vanishes
/// at a turning point.
const REST_SPEED: f64 = 1e-12;

/// The two parts of the friction coefficient of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionParts {
    /// Part from the dissipation in the bulk of the elastomer.
    pub hysteresis: Estimate,
    /// Part from the shear of the contact area.
    pub shear: Estimate,
}

impl Moved {
    /// Adds the shear of the contact area to forces, friction coefficients and energy. `strength` is the shear strength at a speed
    /// above 0 \[m/s], \[Pa]; a body at rest has no shear. `None` if the contact area is not known: then nothing changes.
    ///
    /// # Errors
    /// Those of `strength`.
    pub fn add_shear<E>(
        &mut self,
        load: &MovingLoad,
        strength: impl Fn(f64) -> Result<f64, E>,
    ) -> Result<Option<FrictionParts>, E> {
        let areas: Option<Vec<Estimate>> =
            self.points.iter().map(|point| point.contact_area).collect();
        let Some(areas) = areas else {
            return Ok(None);
        };
        let traction = |velocity: f64| match velocity.abs() {
            speed if speed <= REST_SPEED * load.fastest() => Ok(0.0),
            speed => strength(speed).map(|strength| strength.copysign(velocity)),
        };
        let shear = self.shear_friction(load, &areas, traction)?;

        // Add the shear to the forces of points and steps, each with the velocity at its time.
        let mut peak_error = self.peak_friction.error;
        let points = self.points.iter_mut().zip(stations(load)).zip(&areas);
        for ((point, station), area) in points {
            let traction = traction(load.stages()[station.stage].velocity(station.part))?;
            let force = &mut point.tangential_force;
            *force = *force + *area * traction;
            if point.normal_force.value > 0.0 {
                let error = (traction * area.error / point.normal_force.value).abs();
                peak_error = peak_error.max(self.peak_friction.error + error);
            }
        }
        for step in &mut self.steps {
            let stage = &load.stages()[step.stage];
            let part = (step.time - load.start_time() - stage.start.time) / stage.duration();
            step.tangential_force += traction(stage.velocity(part))? * step.known_area();
        }
        self.peak_friction = Estimate::new(peak(&self.steps), peak_error);
        self.dissipated_energy = self.dissipated_energy.map(|energy| energy + shear.work);
        let hysteresis = self.friction_coefficient;
        self.friction_coefficient = hysteresis + shear.friction;
        Ok(Some(FrictionParts {
            hysteresis,
            shear: shear.friction,
        }))
    }

    /// Work ∫ τ_f A |dx| of the shear and its part of the friction coefficient. Errors of all points have the same sign at worst.
    fn shear_friction<E>(
        &self,
        load: &MovingLoad,
        areas: &[Estimate],
        traction: impl Fn(f64) -> Result<f64, E>,
    ) -> Result<ShearFriction, E> {
        let mut steps = self.steps.clone();
        for step in &mut steps {
            step.time -= load.start_time();
        }
        let is_force = matches!(load.largest_control(), Control::NormalForce(_));
        let mut work = Estimate::exact(0.0);
        let mut normal_work = Estimate::exact(0.0);
        for (index, ends) in stations(load).windows(2).enumerate() {
            let stage = &load.stages()[ends[1].stage];
            let begin = if ends[0].stage == ends[1].stage {
                ends[0].part
            } else {
                0.0
            };
            let width = (ends[1].part - begin) / INTERVALS_PER_POINT as f64;
            let largest_error = |of: &dyn Fn(usize) -> f64| of(index).max(of(index + 1));
            let area_error = largest_error(&|point| areas[point].error);
            let force_error = largest_error(&|point| self.points[point].normal_force.error);
            for interval in 0..INTERVALS_PER_POINT {
                let part = begin + interval as f64 * width;
                let [from, to] = [part, part + width].map(|part| stage.point_at(part));
                let distance = to.position - from.position;
                let traction = traction(distance / (to.time - from.time))?;
                let middle = Station {
                    stage: ends[1].stage,
                    part: part + 0.5 * width,
                };
                let [_, force, _, area] = interpolate(load, &steps, middle).values;
                let force = if is_force {
                    stage.point_at(middle.part).control.value()
                } else {
                    force
                };
                work = work + Estimate::new(area, area_error) * (traction * distance);
                normal_work = normal_work + Estimate::new(force, force_error) * distance.abs();
            }
        }
        let friction = work.value / normal_work.value;
        let smallest = normal_work.value - normal_work.error;
        let error = (work.error + friction * normal_work.error) / smallest;
        Ok(ShearFriction {
            friction: Estimate::new(friction, if smallest > 0.0 { error } else { f64::INFINITY }),
            work,
        })
    }
}

/// Shear along a motion.
struct ShearFriction {
    /// Work ∫ τ_f A |dx|, \[J].
    work: Estimate,
    /// Ratio of the work to ∫ F_N |dx|.
    friction: Estimate,
}
