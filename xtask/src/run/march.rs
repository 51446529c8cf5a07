//! Sliding on the half space from first touch on, under a force or at a depth.

use anyhow::{Result, bail};
use bem_halfspace::slide::{
    MIN_CONTACT_ELEMENTS, March, Motion, MotionRow, PressureField, SlideOptions, SlideRow,
    StationaryOptions, Transient, slide, slide_to_stationary,
};
use bem_halfspace::{BemError, ContactOptions, Footprint, Resolution};
use indenters::SlidingLoad;
use rheology::{CreepSpectrum, Material};

use super::answer::{Answer, ContactBox, Grid, HistoryRow};
use super::bem::widened;
use super::resolution::{Resolved, resolve};
use super::shape::{COARSEST_ELEMENTS, Drive, Shape};
use crate::scene_file::{Accuracy, Control, Method, Model};

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
    /// What the finite distance leaves open.
    distance_error: f64,
    depth: f64,
    force: f64,
    contact_area: f64,
    contact_box: ContactBox,
    n_contact: usize,
    history: Vec<HistoryRow>,
    pressure: PressureField,
}

/// A body that slides from first touch on.
pub(super) struct Scene<'a, S> {
    body: &'a S,
    material: &'a dyn Material,
    drive: &'a Drive,
    creep: CreepSpectrum,
    footprint: Footprint,
    /// Contact length of the one-dimensional model, about, \[m].
    length: f64,
    accuracy: Accuracy,
}

/// From first touch to the stationary state, or over a distance.
pub(super) fn transient(
    body: &impl Shape,
    (material, drive): (&dyn Material, &Drive),
    accuracy: Accuracy,
) -> Result<Answer> {
    let scene = Scene::new(body, (material, drive), accuracy)?;
    let solve = |elements: usize| scene.march(scene.length / elements as f64);
    let Resolved { value, error, .. } =
        resolve(accuracy, LARGEST_GRID, solve, |end| scene.quantities(end))?;
    Ok(scene.answer(value, error))
}

impl<'a, S: Shape> Scene<'a, S> {
    pub(super) fn new(
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
            accuracy,
        })
    }

    fn is_elastic(&self) -> bool {
        self.creep.elements().is_empty() && self.creep.fluidity() == 0.0
    }

    /// Friction and force; nothing rubs on an elastic half space, where the depth stands for the friction.
    fn quantities(&self, end: &End) -> [f64; 2] {
        let first = if self.is_elastic() {
            end.depth
        } else {
            end.friction
        };
        [first, end.force]
    }

    fn answer(&self, end: End, [error, force_error]: [f64; 2]) -> Answer {
        let friction_error = if self.is_elastic() {
            end.friction.abs()
        } else {
            error
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
                .with_friction(end.friction, friction_error + end.distance_error)
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
                Ok(End::of(transient, force, [friction, 0.0]))
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
    pub(super) fn over(
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
            let options = self.options(spacing, LENGTHS * self.length);
            let transient = slide(self.body, self.material, &load, &options)?;
            if self.is_elastic() {
                let friction = transient.last().friction_coefficient;
                return Ok(End::of(transient, force, [friction, 0.0]));
            }
            let state = transient.stationary(DRIFT)?;
            let reached = [state.friction_coefficient, state.distance_error];
            return Ok(End::of(transient, force, reached));
        }
        self.settle(&load, memory, spacing)
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
            load.normal_force(),
            [friction, left],
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
            control: bem_halfspace::Control::IndentationDepth(depth),
        };
        before.chain([distance]).map(motion).collect()
    }
}

impl End {
    fn of(transient: Transient, force: f64, [friction, distance_error]: [f64; 2]) -> Self {
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
            distance_error: 0.0,
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
