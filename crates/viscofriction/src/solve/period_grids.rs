//! Grids of a periodic surface in stationary sliding, from the coarsest with an error bar to the finest that fits into the memory.
//!
//! The solver begins a request for a relative error with four elements per shortest wave, because the bars of the hysteresis hold less
//! often on coarser grids. The friction by shear follows the contact area, whose bars hold on coarser grids, too: on the coarsest grids
//! the area of 190 of 192 random surfaces was within its bar, and the others within 1.1 of it.
//!
//! Theory: docs/theory/rough-surfaces.md, "Grids".

use std::iter::successors;

use bem_halfspace::periodic;
use numerics::Estimate;

use super::answer::Answer;
use super::body::Body;
use super::problem::{Motion, Problem};
use crate::scene::Accuracy;

/// Expected ratio of the error of the contact area on a grid to that on the grid before it. Derived: the contact boundary is resolved to
/// the first order.
const ERROR_RATIO: f64 = 0.5;

/// Numbers of elements along the longer edge of the period, each twice the one before.
pub(super) struct PeriodGrids {
    /// The numbers that were not taken yet, the smallest last.
    edges: Vec<usize>,
}

impl PeriodGrids {
    /// The grids of a problem; none for other bodies and motions.
    pub(super) fn of(problem: &Problem) -> Self {
        let (Motion::Sliding(load), Body::Periodic(surface)) = (problem.motion(), problem.body())
        else {
            return Self { edges: Vec::new() };
        };
        if load.sliding_distance().is_some() {
            return Self { edges: Vec::new() };
        }
        let most = periodic::largest_grid(problem.max_memory().map(|bytes| bytes as f64));
        let coarsest = [
            periodic::edge_for_bars(surface) as f64,
            periodic::elements_for_bars(surface),
        ];
        let grids = successors(Some(coarsest), |[edge, elements]| {
            Some([2.0 * edge, 4.0 * elements])
        });
        let fitting = grids.take_while(|[_, elements]| *elements <= most);
        let mut edges: Vec<usize> = fitting
            .map(|[edge, _]| numerics::whole_part(edge))
            .collect();
        edges.reverse();
        Self { edges }
    }

    /// The next finer grid; `None` after the last one.
    pub(super) fn take(&mut self) -> Option<Accuracy> {
        self.edges.pop().map(Accuracy::Elements)
    }

    /// Leaves out the finer grids if the error of the `friction` would exceed the `allowed` one on all of them.
    pub(super) fn leave_out_if_too_coarse(&mut self, friction: Estimate, allowed: f64) {
        let halvings = f64::from(u32::try_from(self.edges.len()).unwrap_or(u32::MAX));
        // The bars of few elements in contact reach to 0, and those of the next grid need not.
        let has_few_elements = friction.error >= friction.value.abs();
        if !has_few_elements && friction.error * ERROR_RATIO.powf(halvings) > allowed {
            self.leave_out();
        }
    }

    /// Leaves out the finer grids.
    pub(super) fn leave_out(&mut self) {
        self.edges.clear();
    }
}

impl Answer {
    /// Whether the shear of the interface is at least half of the friction.
    pub(super) fn is_mostly_shear(&self) -> bool {
        let parts = self.friction_from_shear.zip(self.hysteresis());
        parts.is_some_and(|(shear, hysteresis)| shear.value >= hysteresis.value)
    }
}
