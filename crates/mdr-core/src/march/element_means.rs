//! Tangential forces averaged over a sliding distance of one element.
//!
//! Behind a steep kink the slope is unbounded, and so is the force of the element under the kink. Only its mean over a distance
//! of one element is resolved; a shorter step catches a part of it by chance.

use indenters::MotionRecord;

/// Replaces the tangential force of every step by its mean over a distance of one element around the step, within its stage;
/// `step_lengths` are in \[m].
pub(super) fn average_tangential_forces(record: &mut MotionRecord, step_lengths: &[f64]) {
    let spacing = record.spacing;
    let stages = record.steps.chunk_by_mut(|a, b| a.stage == b.stage);
    let mut first = 0;
    for steps in stages {
        // Integrate the force over the distance of the stage.
        let step_lengths = &step_lengths[first..first + steps.len()];
        first += steps.len();
        let work =
            CumulativeWork::new(step_lengths, steps.iter().map(|step| step.tangential_force));
        let total = work.distance[steps.len()];
        // Average it over an element around the middle of each step.
        let window = spacing.min(total);
        if window > 0.0 {
            for (step, ends) in steps.iter_mut().zip(work.distance.windows(2)) {
                let middle = ends[0].midpoint(ends[1]);
                let start = (middle - 0.5 * window).clamp(0.0, total - window);
                step.tangential_force = (work.up_to(start + window) - work.up_to(start)) / window;
            }
        }
    }
}

/// Cumulative work over the sliding distance.
struct CumulativeWork {
    /// Distance up to the beginning of each step, and to the end of the last, \[m].
    distance: Vec<f64>,
    /// Work up to each of these distances, \[J].
    work: Vec<f64>,
}

impl CumulativeWork {
    /// Prefix sums over the steps: of their lengths \[m], and of force times length \[J].
    fn new(step_lengths: &[f64], forces: impl Iterator<Item = f64>) -> Self {
        let (mut distance, mut work) = (vec![0.0], vec![0.0]);
        let mut sums = [0.0, 0.0];
        for (length, force) in step_lengths.iter().zip(forces) {
            sums = [sums[0] + length, sums[1] + force * length];
            distance.push(sums[0]);
            work.push(sums[1]);
        }
        Self { distance, work }
    }

    /// Work up to a distance \[m], linear within a step, \[J].
    fn up_to(&self, length: f64) -> f64 {
        let last = self.distance.len() - 1;
        let index = self
            .distance
            .partition_point(|end| *end < length)
            .clamp(1, last);
        let [from, to] = [self.distance[index - 1], self.distance[index]];
        let part = if to > from {
            (length - from) / (to - from)
        } else {
            1.0
        };
        self.work[index - 1] + part.min(1.0) * (self.work[index] - self.work[index - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use casebook::assert_close;
    use indenters::MotionStep;

    fn record(forces: &[(usize, f64)], spacing: f64) -> MotionRecord {
        let step = |&(stage, tangential_force): &(usize, f64)| MotionStep {
            stage,
            time: 0.0,
            position: 0.0,
            tangential_force,
            normal_force: 1.0,
            indentation_depth: 0.0,
            contact_area: None,
            contact: None,
            n_contact: 0,
        };
        MotionRecord {
            steps: forces.iter().map(step).collect(),
            spacing,
            ..MotionRecord::default()
        }
    }

    #[test]
    fn a_peak_that_comes_back_with_every_element_is_its_mean() {
        // Four steps of a quarter of an element each, and the same backwards.
        let forces: Vec<(usize, f64)> = (0..2)
            .flat_map(|stage| {
                let sign = if stage == 0 { 1.0 } else { -1.0 };
                (0..12).map(move |k| (stage, sign * if k % 4 == 1 { 9.0 } else { 1.0 }))
            })
            .collect();
        let mut record = record(&forces, 1.0);
        average_tangential_forces(&mut record, &[0.25; 24]);
        for (index, step) in record.steps.iter().enumerate() {
            let expected = if index < 12 { 3.0 } else { -3.0 };
            assert_close!(step.tangential_force => expected, within 1e-12; "step {index}");
        }
    }

    #[test]
    fn steps_at_rest_and_steps_longer_than_an_element_keep_their_forces() {
        let forces = [(0, 5.0), (0, 4.0), (1, 2.0), (1, 7.0)];
        let mut record = record(&forces, 1.0);
        average_tangential_forces(&mut record, &[0.0, 0.0, 2.0, 2.0]);
        for (step, (_, force)) in record.steps.iter().zip(forces) {
            assert_close!(step.tangential_force => force, within 1e-12);
        }
    }
}
