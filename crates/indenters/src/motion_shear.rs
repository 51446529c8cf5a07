//! Shear of the contact area along a motion.
//!
//! ```text
//! F_t = F_hysteresis + sign(v) τ_f(|v|) A,      μ_shear = ∫ τ_f A |dx| / ∫ F_N |dx|
//! ```

use numerics::Estimate;

use crate::moved::{MotionStep, Station, interpolate, peak, stations};
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

    /// Work ∫ τ_f A |dx| of the shear and its part of the friction coefficient.
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
        let mut normal_work = Estimate::exact(0.0);
        let mut elements = vec![Vec::new(); load.stages().len()];
        for interval in path_intervals(load) {
            let PathInterval { point, middle, .. } = interval;
            let ends = [point, point + 1];
            let [_, force, _, area] = interpolate(load, &steps, middle).values;
            let force = if is_force {
                let prescribed = load.stages()[middle.stage].point_at(middle.part);
                Estimate::exact(prescribed.control.value())
            } else {
                let errors = ends.map(|end| self.points[end].normal_force.error);
                Estimate::new(force, errors[0].max(errors[1]))
            };
            normal_work = normal_work + force * interval.distance.abs();
            let errors = ends.map(|end| areas[end].error);
            elements[middle.stage].push(PathElement {
                length: interval.distance.abs(),
                traction: traction(interval.velocity)?.abs(),
                area: Estimate::new(area, errors[0].max(errors[1])),
            });
        }
        let mean_areas = self.mean_contact_areas.iter().flatten();
        let stages = elements.iter().zip(mean_areas);
        let work = stages
            .map(|(elements, mean_area)| shear_work(elements, mean_area.error))
            .fold(Estimate::exact(0.0), |sum, work| sum + work);
        let friction = work.value / normal_work.value;
        let smallest = normal_work.value - normal_work.error;
        let error = (work.error + friction * normal_work.error) / smallest;
        Ok(ShearFriction {
            friction: Estimate::new(friction, if smallest > 0.0 { error } else { f64::INFINITY }),
            work,
        })
    }
}

/// An interval of the path between two points of a motion.
struct PathInterval {
    /// Index of the point before it.
    point: usize,
    /// Its middle, in time.
    middle: Station,
    /// Distance that the body moves, \[m].
    distance: f64,
    /// Mean velocity, \[m/s].
    velocity: f64,
}

/// A short part of the path of one stage.
#[derive(Clone)]
struct PathElement {
    /// Length, \[m].
    length: f64,
    /// Shear strength, \[Pa].
    traction: f64,
    /// Contact area, \[m²].
    area: Estimate,
}

/// Equal parts in time of the stages of a motion, [`INTERVALS_PER_POINT`] between two reported points.
fn path_intervals(load: &MovingLoad) -> impl Iterator<Item = PathInterval> {
    let stations = stations(load);
    (0..stations.len() - 1).flat_map(move |point| {
        let [from, to] = [stations[point], stations[point + 1]];
        let stage = &load.stages()[to.stage];
        let begin = if from.stage == to.stage {
            from.part
        } else {
            0.0
        };
        let width = (to.part - begin) / INTERVALS_PER_POINT as f64;
        (0..INTERVALS_PER_POINT).map(move |interval| {
            let part = begin + interval as f64 * width;
            let [from, end] = [part, part + width].map(|part| stage.point_at(part));
            let distance = end.position - from.position;
            PathInterval {
                point,
                middle: Station {
                    stage: to.stage,
                    part: part + 0.5 * width,
                },
                distance,
                velocity: distance / (end.time - from.time),
            }
        })
    })
}

/// Mean contact area ∫ A |dx| / ∫ |dx| over the path of each stage, \[m²]; 0 for a stage at rest. `steps` have times from the beginning
/// of the load.
pub(crate) fn mean_areas(load: &MovingLoad, steps: &[MotionStep]) -> Vec<f64> {
    let mut integrals = vec![[0.0; 2]; load.stages().len()];
    for interval in path_intervals(load) {
        let length = interval.distance.abs();
        let [.., area] = interpolate(load, steps, interval.middle).values;
        let [area_integral, path] = &mut integrals[interval.middle.stage];
        *area_integral += area * length;
        *path += length;
    }
    integrals
        .into_iter()
        .map(|[integral, path]| if path > 0.0 { integral / path } else { 0.0 })
        .collect()
}

/// Work ∫ τ_f A |dx| of the shear over the path of a stage, whose mean contact area has the error `mean_error`, \[J].
///
/// With the mean strength τ̄, the error of the work is ∫ τ̄ δA |dx|, which follows from that of the mean area, and ∫ (τ_f − τ̄) δA |dx|,
/// in which the errors of all points have the same sign at worst.
fn shear_work(elements: &[PathElement], mean_error: f64) -> Estimate {
    let integral = |of: &dyn Fn(&PathElement) -> f64| -> f64 {
        elements
            .iter()
            .map(|element| of(element) * element.length)
            .sum()
    };
    let path = integral(&|_| 1.0);
    if path == 0.0 {
        return Estimate::exact(0.0);
    }
    let mean_traction = integral(&|element| element.traction) / path;
    let of_points = integral(&|element| element.traction * element.area.error);
    let of_variation =
        integral(&|element| (element.traction - mean_traction).abs() * element.area.error);
    let of_mean = mean_traction * path * mean_error + of_variation;
    let work = integral(&|element| element.traction * element.area.value);
    Estimate::new(work, of_points.min(of_mean))
}

/// Shear along a motion.
struct ShearFriction {
    /// Work ∫ τ_f A |dx|, \[J].
    work: Estimate,
    /// Ratio of the work to ∫ F_N |dx|.
    friction: Estimate,
}
