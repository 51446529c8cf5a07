//! The chain in motion.

use indenters::{RigidLine, SlidingLoad};
use rheology::Viscous;

use crate::compensated::CompensatedSum;
use crate::contact::{Contact, Element, Instant};
use crate::element_heights::{ElementHeights, checked_height};
use crate::error::{finite, positive};
use crate::slide::MIN_CONTACT;
use crate::{MdrError, SlideRow};

/// A line moving over a chain. All lists run from the rear to the front of the line.
pub(crate) struct March {
    line: ElementHeights,
    /// Rise h̃(x + Δx) − h̃(x) of the line over an element during a step that ends at x, \[m].
    rises: Vec<f64>,
    /// h̃'(x) at the end of a step.
    end_slopes: Vec<f64>,
    /// Displacements of the elements, \[m]; the last one is the element that enters next, undeformed.
    displacements: Vec<f64>,
    element: Element,
    normal_force: f64,
    time_step: f64,
    spacing: f64,
    n_steps: usize,
    depth: f64,
}

impl March {
    /// The undeformed chain, touched at the lowest point, ready for contacts up to the `stationary_depth` \[m].
    pub(crate) fn from_first_touch(
        line: &(impl RigidLine + ?Sized),
        material: &Viscous,
        load: &SlidingLoad,
        spacing: f64,
        stationary_depth: f64,
    ) -> Result<Self, MdrError> {
        let sampled = ElementHeights::below(line, spacing, stationary_depth)?;
        check_leading_edge(line, sampled.lowest_height, stationary_depth)?;
        let n_elements = sampled.heights.len();
        let time_step = spacing / load.velocity();
        let element = Element::new(spacing, material.step_compliance(time_step))?;
        positive("compression", element.compression(load.normal_force()))?;
        let end_slopes = (0..n_elements)
            .map(|element| line.slope(sampled.position(element)))
            .collect();
        let mut rises: Vec<f64> = sampled.heights.windows(2).map(|h| h[1] - h[0]).collect();
        // The last element never carries load: see `advance`.
        rises.push(f64::INFINITY);
        Ok(Self {
            rises,
            end_slopes,
            displacements: vec![0.0; n_elements + 1],
            element,
            normal_force: load.normal_force(),
            time_step,
            spacing,
            n_steps: 0,
            depth: 0.0,
            line: sampled,
        })
    }

    /// Distance slid at the end of the step to come, \[m].
    pub(crate) fn next_sliding_distance(&self) -> f64 {
        (self.n_steps + 1) as f64 * self.spacing
    }

    /// One step; with the row, the number of elements from the rearmost to the foremost loaded one.
    pub(crate) fn advance(&mut self) -> Result<(SlideRow, usize), MdrError> {
        self.n_steps += 1;
        let time = self.n_steps as f64 * self.time_step;
        // The line has moved on: the element that was under one height is now under the one behind it.
        let instant =
            Instant::unchecked(&self.line.heights, &self.displacements[1..], self.element);
        let contact = instant.solve(self.normal_force, self.depth);
        finite("indentation depth", contact.indentation_depth, time)?;
        if contact.n_contact == 0 {
            return Err(MdrError::TooCoarse {
                n_contact: 0,
                needed: MIN_CONTACT,
                spacing: self.spacing,
            });
        }
        let load = self.settle(contact.indentation_depth);
        if load.front + 1 == self.line.heights.len() {
            return Err(MdrError::ContactReachesBoundary {
                position: self.line.position(load.front),
                indentation_depth: contact.indentation_depth,
                time,
            });
        }
        let row = self.row(contact, load, time)?;
        self.depth = contact.indentation_depth;
        Ok((row, load.front + 1 - load.rear))
    }

    /// Moves every element to the end of the step, and sums what the loaded ones exert on the line.
    fn settle(&mut self, depth: f64) -> Loaded {
        let mut loaded = Loaded::new(self.line.heights.len());
        for (here, height) in self.line.heights.iter().enumerate() {
            let before = self.displacements[here + 1];
            let compression = depth - (height + before);
            if compression <= 0.0 {
                self.displacements[here] = before;
                continue;
            }
            self.displacements[here] = depth - height;
            loaded.rear = loaded.rear.min(here);
            loaded.front = here;
            loaded.rise.add(compression * self.rises[here]);
            loaded.end_slope.add(compression * self.end_slopes[here]);
        }
        loaded
    }

    fn row(&self, contact: Contact, loaded: Loaded, time: f64) -> Result<SlideRow, MdrError> {
        let compression = self.element.compression(self.normal_force);
        let friction = loaded.rise.value() / (compression * self.spacing);
        let end_of_step = loaded.end_slope.value() / compression;
        let depth = contact.indentation_depth;
        Ok(SlideRow {
            sliding_distance: self.n_steps as f64 * self.spacing,
            time,
            indentation_depth: depth,
            friction_coefficient: finite("friction coefficient", friction, time)?,
            friction_coefficient_end_of_step: end_of_step.is_finite().then_some(end_of_step),
            sinking_velocity: (depth - self.depth) / self.time_step,
            contact: [loaded.rear, loaded.front].map(|element| self.line.position(element)),
            n_contact: contact.n_contact,
            contact_length: contact.n_contact as f64 * self.spacing,
        })
    }
}

/// What the loaded elements of a step sum up to.
#[derive(Debug, Clone, Copy)]
struct Loaded {
    rear: usize,
    front: usize,
    /// Σ compression · rise of the line over the element during the step.
    rise: CompensatedSum,
    /// Σ compression · slope of the line at the end of the step.
    end_slope: CompensatedSum,
}

impl Loaded {
    fn new(n_elements: usize) -> Self {
        Self {
            rear: n_elements,
            front: 0,
            rise: CompensatedSum::default(),
            end_slope: CompensatedSum::default(),
        }
    }
}

/// A line that ends in front must end above the stationary depth: its last point belongs to the leading edge.
fn check_leading_edge(
    line: &(impl RigidLine + ?Sized),
    lowest_height: f64,
    stationary_depth: f64,
) -> Result<(), MdrError> {
    let front = line.domain()[1];
    if front.is_infinite() {
        return Ok(());
    }
    let available = checked_height(line, front)? - lowest_height;
    if available >= stationary_depth {
        return Ok(());
    }
    Err(MdrError::NoStationaryState {
        stationary_depth,
        available,
    })
}
