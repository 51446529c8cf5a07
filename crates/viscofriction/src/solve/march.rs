//! Sliding on the half space from first touch on, under a force or at a depth.

use super::error::{Result, bail};
use bem_halfspace::slide::{
    MIN_CONTACT_ELEMENTS, March, Motion, MotionRow, PressureField, SlideOptions, SlideRow,
    StationaryOptions, Transient, slide, slide_to_stationary,
};
use bem_halfspace::{BemError, ContactOptions, Footprint, Resolution};
use indenters::{SlidingLoad, Surface};
use rheology::{CreepSpectrum, Material};

use super::answer::{Answer, ContactBox, Grid, HistoryRow};
use super::bem::widened;
use super::order_of_apex;
use super::shape::{COARSEST_ELEMENTS, Drive, Shape};
use crate::scene::{Accuracy, Control, Method, Model};
use numerics::{ErrorParts, Goal, Quantity, Refined, refine};

/// Elements along the contact after which a march in time gives up; it takes about a minute.
const LARGEST_GRID: usize = 32;
/// Contact lengths of the one-dimensional model until the state counts as stationary where nothing but flow is slow.
const LENGTHS: f64 = 24.0;
const DRIFT: f64 = 0.05;
/// Distances v λ of the slowest element until a solid counts as stationary.
const MEMORIES: f64 = 12.0;
/// Contact lengths after which a march to the stationary state is not begun.
const LONGEST: f64 = 500.0;
/// Change of the friction by which a solid counts as stationary, relative to the error asked for.
const SETTLED: f64 = 0.1;

/// Steps at a depth after which a march is not begun.
const MOST_STEPS: f64 = 1e5;

/// What one march ends with.
struct End {
    friction: f64,
    /// What the finite distance leaves open of the stationary state, where that is asked for.
    distance_error: Option<f64>,
    depth: f64,
    force: f64,
    contact_area: f64,
    contact_box: ContactBox,
    n_contact: usize,
    history: Vec<HistoryRow>,
    pressure: PressureField,
}

/// A body that slides from first touch on.
pub(crate) struct Scene<'a, S> {
    body: &'a S,
    material: &'a dyn Material,
    drive: &'a Drive,
    creep: CreepSpectrum,
    footprint: Footprint,
    /// Contact length of the one-dimensional model, about, \[m].
    length: f64,
    apex_exponent: f64,
    accuracy: Accuracy,
}

/// From first touch to the stationary state, or over a distance.
pub(crate) fn transient(
    body: &impl Shape,
    (material, drive): (&dyn Material, &Drive),
    accuracy: Accuracy,
) -> Result<Answer> {
    let scene = Scene::new(body, (material, drive), accuracy)?;
    let solve = |elements: usize| scene.march(scene.length / elements as f64);
    let goal = Goal {
        accuracy,
        largest: LARGEST_GRID,
        order: order_of_apex(scene.apex_exponent),
    };
    let others = |_, end: &End| Ok([scene.other_parts(end), ErrorParts::NONE]);
    let resolved = refine(&goal, solve, |end| scene.quantities(end), others)?;
    Ok(scene.answer(resolved))
}

impl<'a, S: Shape> Scene<'a, S> {
    pub(crate) fn new(
        body: &'a S,
        (material, drive): (&'a dyn Material, &'a Drive),
        accuracy: Accuracy,
    ) -> Result<Self> {
        let ladder = body.ladder(material, drive)?;
        Ok(Self {
            body,
            material,
            drive,
            creep: material.creep(),
            footprint: ladder.footprint,
            length: COARSEST_ELEMENTS * ladder.coarsest_spacing,
            apex_exponent: ladder.apex_exponent,
            accuracy,
        })
    }

    fn is_elastic(&self) -> bool {
        self.creep.elements().is_empty() && self.creep.fluidity() == 0.0
    }

    /// Friction and force; nothing rubs on an elastic half space, where the depth stands for the friction.
    fn quantities(&self, end: &End) -> [Quantity; 2] {
        let first = if self.is_elastic() {
            end.depth
        } else {
            end.friction
        };
        [first, end.force].map(Quantity::from)
    }

    /// What the contact solver and the finite distance leave open of the friction.
    fn other_parts(&self, end: &End) -> ErrorParts {
        if self.is_elastic() {
            return ErrorParts::NONE;
        }
        ErrorParts {
            iteration: Some(error_of_gaps(self.body, &end.pressure)),
            truncation: end.distance_error,
            ..ErrorParts::NONE
        }
    }

    fn answer(&self, resolved: Refined<End, 2>) -> Answer {
        let (end, [error, force_error]) = (resolved.value, resolved.error);
        // The friction of an elastic half space is what the elements leave of none.
        let (friction_error, parts) = if self.is_elastic() {
            let error = end.friction.abs();
            (error, ErrorParts::of_elements(error))
        } else {
            let [parts, _] = resolved.parts;
            (error, parts)
        };
        let at_force = matches!(self.drive.control, Control::NormalForce(_));
        // Without a distance the depth on a material that flows has no meaning: it never stops to grow.
        let has_depth = self.drive.distance.is_some() || self.creep.fluidity() == 0.0;
        let mut answer = Answer {
            normal_force_error: (!at_force).then_some(force_error),
            indentation_depth: has_depth.then_some(end.depth),
            contact_area: Some(end.contact_area),
            contact_box: Some(end.contact_box),
            unknowns: end.n_contact,
            iterations: end.history.len(),
            grid: Some(Grid {
                spacing: end.pressure.grid.spacing()[0],
                factorised: false,
            }),
            ..Answer::new(Method::BemTransient, Model::HalfSpace, end.force)
                .with_friction(end.friction, friction_error)
                .with_parts(parts)
        };
        answer.fields.history = end.history;
        answer.fields.pressure = Some(end.pressure);
        answer
    }

    fn march(&self, spacing: f64) -> Result<End> {
        match (self.drive.control, self.drive.distance) {
            (Control::NormalForce(force), Some(distance)) => {
                let load = SlidingLoad::new(force, self.drive.velocity)?;
                let options = self.options(spacing, distance);
                let transient = slide(self.body, self.material, &load, &options)?;
                let friction = transient.last().friction_coefficient;
                Ok(End::of(transient, force, (friction, None)))
            }
            (Control::NormalForce(force), None) => self.to_stationary(force, spacing),
            (Control::IndentationDepth(_), Some(distance)) => self.at_depth([spacing, distance]),
            (Control::IndentationDepth(_), None) => {
                bail!("at a depth the method marches over a distance only")
            }
        }
    }

    fn options(&self, spacing: f64, sliding_distance: f64) -> SlideOptions {
        SlideOptions {
            spacing: [spacing; 2],
            footprint: self.footprint,
            sliding_distance,
            contact: ContactOptions::default(),
        }
    }

    /// The march over a distance, ready for its first step.
    pub(crate) fn over(
        &self,
        [spacing, distance]: [f64; 2],
        contact: ContactOptions,
    ) -> Result<March<'a, S>> {
        match self.drive.control {
            Control::NormalForce(force) => {
                let load = SlidingLoad::new(force, self.drive.velocity)?;
                let options = SlideOptions {
                    contact,
                    ..self.options(spacing, distance)
                };
                Ok(March::sliding(self.body, self.material, &load, &options)?)
            }
            Control::IndentationDepth(depth) => {
                let resolution = Resolution {
                    spacing: [spacing; 2],
                    footprint: widened(&self.footprint, spacing),
                    contact,
                };
                let motions = self.motions(depth, [spacing, distance]);
                Ok(March::new(self.body, self.material, &motions, &resolution)?)
            }
        }
    }

    fn to_stationary(&self, force: f64, spacing: f64) -> Result<End> {
        let load = SlidingLoad::new(force, self.drive.velocity)?;
        let memory = self.memory();
        if memory == 0.0 {
            return self.flow(&load, &self.options(spacing, LENGTHS * self.length));
        }
        self.settle(&load, memory, spacing)
    }

    /// Slides over the distance of the options, and beyond it by extrapolation.
    fn flow(&self, load: &SlidingLoad, options: &SlideOptions) -> Result<End> {
        let transient = slide(self.body, self.material, load, options)?;
        let reached = if self.is_elastic() {
            (transient.last().friction_coefficient, None)
        } else {
            let state = transient.stationary(DRIFT)?;
            (state.friction_coefficient, Some(state.distance_error))
        };
        Ok(End::of(transient, load.require_normal_force()?, reached))
    }

    /// Slides until a material that recovers has forgotten the first touch.
    fn settle(&self, load: &SlidingLoad, memory: f64, spacing: f64) -> Result<End> {
        let distance = LENGTHS * self.length + MEMORIES * memory;
        if distance > LONGEST * self.length {
            bail!(
                "a march to the stationary state is longer than {LONGEST} contact lengths: its slowest retardation takes \
                 {memory:e} m of sliding, and the contact is about {:e} m long; bem-steady solves for the stationary \
                 state, and solve.sliding_distance asks for one on the way",
                self.length
            );
        }
        let stationary = StationaryOptions {
            tolerance: match self.accuracy {
                Accuracy::RelativeError(error) => SETTLED * error,
                Accuracy::Elements(_) => SETTLED * DRIFT,
            },
            over_distance: 2.0 * self.length + memory,
        };
        let options = self.options(spacing, distance);
        let slide = slide_to_stationary(self.body, self.material, (load, &options), &stationary)?;
        let friction = slide.friction_coefficient;
        let left = slide.change * friction.abs();
        Ok(End::of(
            slide.transient,
            load.require_normal_force()?,
            (friction, Some(left)),
        ))
    }

    /// Distance in which the slowest element forgets, \[m].
    fn memory(&self) -> f64 {
        let times = self
            .creep
            .elements()
            .iter()
            .map(|element| element.retardation_time);
        self.drive.velocity * times.fold(0.0, f64::max)
    }

    fn at_depth(&self, [spacing, distance]: [f64; 2]) -> Result<End> {
        if distance > MOST_STEPS * spacing {
            bail!(
                "a march over {distance} m in steps of {spacing:e} m has more than {MOST_STEPS:e} of them"
            );
        }
        let mut march = self.over([spacing, distance], ContactOptions::default())?;
        let mut rows = Vec::new();
        while let Some(row) = march.step()? {
            rows.push(row);
        }
        End::of_motion(rows, march.pressure()?)
    }

    /// Steps of one element; the last, of a half to one and a half, ends at the distance.
    fn motions(&self, depth: f64, [spacing, distance]: [f64; 2]) -> Vec<Motion> {
        let ends = (1_u32..).map(|step| f64::from(step) * spacing);
        let before = ends.take_while(|position| *position < distance - 0.5 * spacing);
        let motion = |position: f64| Motion {
            time: position / self.drive.velocity,
            position,
            control: Control::IndentationDepth(depth),
        };
        before.chain([distance]).map(motion).collect()
    }
}

impl End {
    fn of(
        transient: Transient,
        force: f64,
        (friction, distance_error): (f64, Option<f64>),
    ) -> Self {
        let last = transient.last();
        Self {
            friction,
            distance_error,
            depth: last.indentation_depth,
            force,
            contact_area: last.contact_area,
            contact_box: ContactBox::around(last.contact_x, last.contact_y),
            n_contact: last.n_contact,
            history: transient.rows.iter().map(sliding).collect(),
            pressure: transient.pressure,
        }
    }

    fn of_motion(rows: Vec<MotionRow>, pressure: PressureField) -> Result<Self> {
        let [length, width] = pressure.grid.shape();
        let Some((last, [x, y])) = rows.last().and_then(|last| {
            let edges = [last.contact_x?, last.contact_y?];
            (length.min(width) >= MIN_CONTACT_ELEMENTS).then_some((last, edges))
        }) else {
            return Err(BemError::GridTooCoarse {
                elements: length.min(width),
                needed: MIN_CONTACT_ELEMENTS,
            }
            .into());
        };
        Ok(Self {
            friction: last.tangential_force / last.normal_force,
            distance_error: None,
            depth: last.indentation_depth,
            force: last.normal_force,
            contact_area: last.contact_area,
            contact_box: ContactBox::around(x, y),
            n_contact: last.n_contact,
            history: rows.iter().filter_map(moving).collect(),
            pressure,
        })
    }
}

/// What gaps of the size of the tolerance change of the friction.
///
/// A gap that alternates from element to element changes the pressure by as many times its part of the displacement as
/// there are elements along the contact, and the friction by as much of the mean modulus of the slope.
fn error_of_gaps(surface: &impl Surface, field: &PressureField) -> f64 {
    let ([rows, columns], [dx, dy]) = (field.grid.shape(), field.grid.spacing());
    let [mut load, mut climb] = [0.0; 2];
    for (index, pressure) in field.pressure.iter().enumerate() {
        let x = field.origin[0] + (index / columns) as f64 * dx;
        let y = field.origin[1] + (index % columns) as f64 * dy;
        let rise = surface.height([x + 0.5 * dx, y]) - surface.height([x - 0.5 * dx, y]);
        load += pressure;
        if *pressure > 0.0 {
            climb += pressure * (rise / dx).abs();
        }
    }
    ContactOptions::default().tolerance * rows as f64 * (climb / load)
}

fn sliding(row: &SlideRow) -> HistoryRow {
    HistoryRow {
        sliding_distance_m: row.sliding_distance,
        time_s: row.time,
        indentation_depth_m: row.indentation_depth,
        friction_coefficient: row.friction_coefficient,
    }
}

/// Without a force there is no coefficient.
fn moving(row: &MotionRow) -> Option<HistoryRow> {
    (row.normal_force > 0.0).then(|| HistoryRow {
        sliding_distance_m: row.position,
        time_s: row.time,
        indentation_depth_m: row.indentation_depth,
        friction_coefficient: row.tangential_force / row.normal_force,
    })
}

#[cfg(test)]
mod tests {
    use indenters::PowerProfile;
    use rheology::Viscous;

    use super::*;
    use crate::solve::Revolution;

    const ELEMENTS: f64 = 10.0;
    const FORCE: f64 = 1.0;

    fn on_dashpot<T>(exponent: f64, ask: impl Fn(&Scene<'_, Revolution>, &SlideOptions) -> T) -> T {
        let body = PowerProfile::new(0.3, exponent).expect("a body");
        let material = Viscous::new(1.0).expect("a material");
        let drive = Drive {
            control: Control::NormalForce(FORCE),
            velocity: 1.0,
            distance: None,
        };
        let body = Revolution::Power(body);
        let accuracy = Accuracy::Elements(10);
        let scene = Scene::new(&body, (&material, &drive), accuracy).expect("a scene");
        let options = scene.options(scene.length / ELEMENTS, LENGTHS * scene.length);
        ask(&scene, &options)
    }

    fn flow(scene: &Scene<'_, Revolution>, options: &SlideOptions) -> End {
        let load = SlidingLoad::new(FORCE, 1.0).expect("a load");
        scene.flow(&load, options).expect("a march")
    }

    #[test]
    fn twice_the_distance_changes_the_friction_by_less_than_the_truncation() {
        for exponent in [0.75, 1.0, 2.0] {
            on_dashpot(exponent, |scene, options| {
                let end = flow(scene, options);
                let farther = SlideOptions {
                    sliding_distance: 2.0 * options.sliding_distance,
                    ..*options
                };
                let end_farther = flow(scene, &farther);
                let change = (end_farther.friction - end.friction).abs();
                let [part, other] = [&end, &end_farther]
                    .map(|end| scene.other_parts(end).truncation.expect("a part"));
                // What is left after twice the distance is not nothing.
                assert!(
                    change <= part + other && part < 0.02 * end.friction,
                    "p = {exponent}: {change:e}, and the parts are {part:e} and {other:e}"
                );
            });
        }
    }

    #[test]
    fn smaller_gaps_change_the_friction_by_less_than_the_iteration() {
        for exponent in [0.75, 1.0, 2.0] {
            on_dashpot(exponent, |scene, options| {
                let end = flow(scene, options);
                let exact = SlideOptions {
                    contact: ContactOptions {
                        tolerance: 1e-13,
                        max_iterations: 10_000,
                    },
                    ..*options
                };
                let change = (flow(scene, &exact).friction - end.friction).abs();
                let iteration = scene.other_parts(&end).iteration.expect("a part");
                assert!(
                    change <= iteration && iteration < 1e-6 * end.friction,
                    "p = {exponent}: {change:e}, and the part is {iteration:e}"
                );
            });
        }
    }
}
