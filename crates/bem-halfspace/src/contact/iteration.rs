//! Preconditioned conjugate gradients on a contact set that follows the solution.
//!
//! On a given set of elements in contact the load solves linear equations, whose matrix is a part of the convolution;
//! the same part of an approximate inverse preconditions it, so that the number of iterations hardly depends on the
//! grid. The set changes when its violations, tension inside and penetration outside, outweigh what is
//! left of the linear equations: all violating elements change sides at once (a primal-dual active set, Hintermüller,
//! Ito & Kunisch 2003, DOI 10.1137/S1052623401383558). Such a method ends on all but contrived problems; where the
//! number of violations does not fall, only the last of them changes sides, after an accurate solution, which ends
//! always (Júdice & Pires 1994, DOI 10.1016/0305-0548(94)90106-6).

use std::ops::Range;

use crate::contact::contact_set::{ContactSet, Run};
use crate::contact::lanes::{add, lower, reduce, sum};
use crate::contact::listed::Listed;
use crate::contact::preconditioner::Preconditioner;
use crate::contact::violations::Violations;
use crate::contact::{Accuracy, ContactState, Control, Outcome, Question};
use crate::{BemError, Convolution, ConvolutionWorkspace};

/// Changes of the set without fewer violations than ever before, after which one element at a time changes.
const PATIENCE: usize = 10;

/// The contact changes when its violations are this many times the gaps inside.
const PRIORITY: f64 = 2.0;

/// Buffers beside the load and its displacement.
#[derive(Debug, Clone)]
pub(super) struct Fields {
    preconditioner: Preconditioner,
    contact: ContactSet,
    listed: Listed,
    /// Values of one list or another; zero outside the contact.
    spread: Vec<f64>,
    /// What the influence makes of the direction.
    image: Vec<f64>,
}

impl Fields {
    fn new(convolution: &Convolution) -> Self {
        let grid = convolution.grid();
        let n = grid.n_elements();
        Self {
            preconditioner: Preconditioner::new(convolution),
            contact: ContactSet::new(grid.shape()),
            listed: Listed::new(n),
            spread: vec![0.0; n],
            image: vec![0.0; n],
        }
    }
}

pub(super) struct Iteration<'a> {
    convolution: &'a Convolution,
    separation: &'a [f64],
    control: Control,
    tolerance: f64,
    /// That of the last contact or, if that is as old, of the last [`refresh`](Self::refresh).
    load: &'a mut [f64],
    displacement: &'a mut [f64],
    workspace: &'a mut ConvolutionWorkspace,
    fields: &'a mut Fields,
    indentation_depth: f64,
    /// Lowest height of the deformed surface outside the contact.
    lowest_outside: f64,
    /// Residual times preconditioned residual in the previous iteration; 0 starts a new set of directions.
    previous_product: f64,
    /// Whether the displacement was computed from the load, and not updated along a direction.
    fresh: bool,
    /// Whether the load has been improved on the present contact set.
    improved: bool,
    fewest_wrong: usize,
    patience: usize,
}

impl<'a> Iteration<'a> {
    pub(super) fn new(
        (convolution, separation, control): Question<'a>,
        state: &'a mut ContactState,
    ) -> Self {
        Self {
            convolution,
            separation,
            control,
            tolerance: 0.0,
            load: &mut state.load,
            displacement: &mut state.displacement,
            workspace: state
                .workspace
                .get_or_insert_with(|| convolution.workspace()),
            fields: state
                .fields
                .get_or_insert_with(|| Box::new(Fields::new(convolution))),
            indentation_depth: 0.0,
            lowest_outside: f64::INFINITY,
            previous_product: 0.0,
            fresh: false,
            improved: false,
            fewest_wrong: usize::MAX,
            patience: PATIENCE,
        }
    }

    pub(super) fn run(mut self, accuracy: &Accuracy) -> Result<Outcome, BemError> {
        self.start();
        let mut iterations = 0;
        loop {
            self.find_depth();
            let violations = self.measure();
            let residual = violations.relative();
            if iterations == 0 {
                self.tolerance = accuracy.target(residual);
            }
            if residual <= self.tolerance && violations.tension <= 0.0 {
                if self.fresh {
                    return Ok(self.outcome(iterations, &violations));
                }
                self.refresh();
                continue;
            }
            // Where numbers overflow there is no way on.
            if iterations >= accuracy.max_iterations || residual.is_nan() {
                self.write_load();
                let residual = Some(residual).filter(|residual| !residual.is_nan());
                return Err(BemError::ContactNotConverged {
                    iterations,
                    residual: residual.unwrap_or(f64::INFINITY),
                    tolerance: self.tolerance,
                });
            }
            if self.set_is_due(&violations) {
                self.change_contact(&violations);
            } else {
                self.step();
            }
            iterations += 1;
        }
    }

    fn outcome(&self, iterations: usize, violations: &Violations) -> Outcome {
        Outcome {
            indentation_depth: self.indentation_depth,
            total_load: self.total_load(),
            iterations,
            deflection: violations.deflection,
            residual: violations.relative(),
        }
    }

    /// Takes the contact from the first guess; without one, from what lies below the given depth, or everywhere.
    fn start(&mut self) {
        let loaded = self.load.iter().any(|load| *load > 0.0);
        let (below, uniform) = match self.control {
            Control::NormalForce(_) => (f64::INFINITY, 1.0),
            Control::IndentationDepth(depth) => (depth, 0.0),
        };
        let vanishes = self.control == Control::NormalForce(0.0);
        let separation = self.separation;
        let Fields {
            contact, spread, ..
        } = &mut *self.fields;
        let load = &*self.load;
        contact.assign(|element| {
            let guessed = load[element] > 0.0 && separation[element].is_finite();
            !vanishes && (guessed || (!loaded && separation[element] < below))
        });
        let bands = contact.bands();
        bands.for_each([&mut *self.load, spread], |band, [load, spread]| {
            spread.fill(0.0);
            for (load, element) in load.iter_mut().zip(bands.elements(band)) {
                *load = match (contact.contains(element), loaded) {
                    (true, true) => *load,
                    (true, false) => uniform,
                    (false, _) => 0.0,
                };
            }
        });
        self.list_contact();
        self.match_force();
        self.refresh();
    }

    fn list_contact(&mut self) {
        let Fields {
            contact, listed, ..
        } = &mut *self.fields;
        contact.find_runs();
        listed.take(contact, [self.separation, self.load]);
    }

    /// Scales the load to the prescribed force.
    fn match_force(&mut self) {
        let Control::NormalForce(total) = self.control else {
            return;
        };
        let sum = self.total_load();
        for load in &mut self.fields.listed.load {
            // Multiplied last, because the quotient of extreme forces may overflow.
            *load = if sum > 0.0 { *load / sum * total } else { 0.0 };
        }
    }

    fn total_load(&self) -> f64 {
        let Fields {
            contact, listed, ..
        } = &*self.fields;
        contact.sum(|places| sum([&listed.load[places]], |[load]| load))
    }

    fn write_load(&mut self) {
        let Fields {
            contact, listed, ..
        } = &*self.fields;
        contact.scatter(&listed.load, self.load);
    }

    /// Computes the displacement from the load.
    fn refresh(&mut self) {
        self.write_load();
        let rows = self.convolution.grid().shape()[0];
        let (load, displacement) = (&self.load[..], &mut self.displacement[..]);
        self.convolution
            .apply(self.workspace, (load, 0..rows), (displacement, 0..rows));
        let Fields {
            contact, listed, ..
        } = &mut *self.fields;
        let (separation, displacement) = (self.separation, &*self.displacement);
        let bands = contact.bands();
        self.lowest_outside = contact.fold(
            [contact.list(&mut listed.displacement)],
            |band, [listed]| {
                contact.gather_in(band, displacement, listed);
                let elements = bands.elements(band);
                lowest_outside(
                    contact,
                    band,
                    [separation, displacement].map(|field| &field[elements.clone()]),
                )
            },
            lower,
        );
        self.fresh = true;
        self.previous_product = 0.0;
    }

    /// At a given force the depth is the mean height of the contact, so that the gaps there have the mean zero.
    fn find_depth(&mut self) {
        let Fields {
            contact, listed, ..
        } = &*self.fields;
        self.indentation_depth = match self.control {
            Control::IndentationDepth(depth) => depth,
            Control::NormalForce(_) if contact.len() == 0 => {
                let heights = self.separation.iter().copied();
                heights.fold(f64::INFINITY, f64::min)
            }
            Control::NormalForce(_) => {
                let mean = listed.mean_height_above(contact, 0.0);
                // Again from the first mean, because no direction removes what the long sum has rounded.
                mean + listed.mean_height_above(contact, mean)
            }
        };
    }

    /// Stores the residual of the linear equations, minus the gap in the contact, and finds what is violated.
    fn measure(&mut self) -> Violations {
        let Fields {
            contact, listed, ..
        } = &mut *self.fields;
        let (separation, displacement, load) =
            (&listed.separation, &listed.displacement, &listed.load);
        let own_influence = self.convolution.self_influence();
        let depth = self.indentation_depth;
        let in_band = |band, [residual]: [&mut [f64]; 1]| {
            let [separation, displacement, load] =
                [separation, displacement, load].map(|list| &list[contact.places(band)]);
            for (residual, (separation, displacement)) in
                residual.iter_mut().zip(separation.iter().zip(displacement))
            {
                *residual = depth - (separation + displacement);
            }
            Violations::inside(residual, [load, displacement], own_influence)
        };
        let residual = [contact.list(&mut listed.residual)];
        let inside = contact.fold(residual, in_band, Violations::worst);
        Violations {
            penetration: (depth - self.lowest_outside).max(0.0),
            ..inside
        }
    }

    fn set_is_due(&self, violations: &Violations) -> bool {
        let allowed = self.tolerance * violations.deflection;
        if violations.tension <= 0.0 && violations.penetration <= allowed {
            return false;
        }
        let worst = violations.tension.max(violations.penetration);
        let outweighed = worst >= PRIORITY * violations.gap;
        violations.gap <= allowed || (self.patience > 0 && self.improved && outweighed)
    }

    fn change_contact(&mut self, violations: &Violations) {
        self.write_load();
        let lowest = self.indentation_depth - self.tolerance * violations.deflection;
        let (load, separation, displacement) = (&*self.load, self.separation, &*self.displacement);
        // Under tension, or outside and below the height at which it penetrates.
        let is_wrong = |element: usize, inside: bool| {
            if inside {
                load[element] < 0.0
            } else {
                separation[element] + displacement[element] < lowest
            }
        };
        let contact = &mut self.fields.contact;
        let (n_wrong, last) = contact.find_last(is_wrong);
        if n_wrong < self.fewest_wrong {
            self.fewest_wrong = n_wrong;
            self.patience = PATIENCE;
        } else {
            self.patience = self.patience.saturating_sub(1);
        }
        let first = if self.patience == 0 { last } else { 0 };
        contact.change(|element, inside| element >= first && is_wrong(element, inside));
        self.clear_left();
        self.list_contact();
        self.improved = false;
        self.match_force();
        self.refresh();
    }

    /// Clears what has just left the contact, while the runs are still those before.
    fn clear_left(&mut self) {
        let Fields {
            contact, spread, ..
        } = &mut *self.fields;
        let bands = contact.bands();
        bands.for_each([&mut *self.load, spread], |band, fields| {
            let first = bands.elements(band).start;
            for field in fields {
                for element in contact.runs(band).iter().flat_map(Run::elements) {
                    if !contact.contains(element) {
                        field[element - first] = 0.0;
                    }
                }
            }
        });
    }

    /// Moves the load along a direction conjugate to the previous ones to where the residual does no work.
    fn step(&mut self) {
        self.find_direction();
        let rows = self.convolution.grid().shape()[0];
        let Fields {
            contact,
            listed,
            spread,
            image,
            ..
        } = &mut *self.fields;
        self.convolution
            .apply(self.workspace, (spread, 0..rows), (image, 0..rows));
        let direction = &listed.direction;
        let energy = contact.fold(
            [contact.list(&mut listed.image)],
            |band, [listed]| {
                contact.gather_in(band, image, listed);
                sum([&direction[contact.places(band)], listed], |[a, b]| a * b)
            },
            |left, right| left + right,
        );
        // The load of a single element has nowhere to go.
        let length = if energy == 0.0 {
            0.0
        } else {
            self.previous_product / energy
        };
        self.advance(length);
    }

    /// Moves load and displacement by so many directions.
    fn advance(&mut self, length: f64) {
        let Fields {
            contact,
            listed,
            image,
            ..
        } = &mut *self.fields;
        let Listed {
            load,
            displacement,
            direction,
            image: listed_image,
            ..
        } = listed;
        let (separation, bands) = (self.separation, contact.bands());
        let in_band = |band, [field, displacement, load]: [&mut [f64]; 3]| {
            let (elements, places) = (bands.elements(band), contact.places(band));
            add(field, length, &image[elements.clone()]);
            add(displacement, length, &listed_image[places.clone()]);
            add(load, length, &direction[places]);
            lowest_outside(contact, band, [&separation[elements], field])
        };
        let moved = [
            contact.field(self.displacement),
            contact.list(displacement),
            contact.list(load),
        ];
        self.lowest_outside = contact.fold(moved, in_band, lower);
        self.fresh = false;
        self.improved = true;
    }

    fn find_direction(&mut self) {
        let Fields {
            preconditioner,
            contact,
            listed,
            spread,
            ..
        } = &mut *self.fields;
        let Listed {
            residual,
            direction,
            image: preconditioned,
            ..
        } = listed;
        if !self.improved {
            // The first direction on a contact is not conjugate to any before.
            preconditioner.prepare(contact, spread, [direction, preconditioned]);
        }
        preconditioner.apply(contact, (residual, spread), preconditioned);
        let (residual, preconditioned) = (&*residual, &*preconditioned);
        let mean = match self.control {
            Control::NormalForce(_) => {
                let of_places = |places| sum([&preconditioned[places]], |[value]| value);
                contact.sum(of_places) / contact.len() as f64
            }
            Control::IndentationDepth(_) => 0.0,
        };
        let product = contact.sum(|places| {
            let lists = [residual, preconditioned].map(|list| &list[places.clone()]);
            sum(lists, |[residual, value]| residual * (value - mean))
        });
        let conjugation = if self.previous_product > 0.0 {
            product / self.previous_product
        } else {
            0.0
        };
        let fields = [contact.field(spread), contact.list(direction)];
        contact.for_each(fields, |band, [spread, direction]| {
            let values = &preconditioned[contact.places(band)];
            for (direction, value) in direction.iter_mut().zip(values) {
                *direction = value - mean + conjugation * *direction;
            }
            contact.scatter_in(band, direction, spread);
        });
        self.previous_product = product;
    }
}

/// The lowest height of the deformed surface outside the contact, from separation and displacement in a band.
fn lowest_outside(contact: &ContactSet, band: usize, fields: [&[f64]; 2]) -> f64 {
    let first = contact.bands().elements(band).start;
    let lowest_in = |gap: Range<usize>| {
        let fields = fields.map(|field| &field[gap.start - first..gap.end - first]);
        reduce(
            fields,
            f64::INFINITY,
            |[separation, displacement]| separation + displacement,
            lower,
        )
    };
    contact.gaps(band).map(lowest_in).fold(f64::INFINITY, lower)
}
