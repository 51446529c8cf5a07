//! What is made of derivatives on several grids.

use numerics::Estimate;

use crate::stationary::steady::sensitivity::Change;

/// A mean over shifted grids, and how far they are apart.
pub(super) type Apart = [f64; 2];

/// The mean over shifted grids.
pub(super) fn mean(changes: Vec<Change<f64>>) -> Change<Apart> {
    let of = |values: Vec<f64>| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let apart = values.iter().map(|value| (value - mean).abs());
        [mean, apart.fold(0.0, f64::max)]
    };
    let optional = |quantity: fn(&Change<f64>) -> Option<f64>| {
        let values: Option<Vec<f64>> = changes.iter().map(quantity).collect();
        values.map(of)
    };
    Change {
        friction_coefficient: of(changes.iter().map(|one| one.friction_coefficient).collect()),
        indentation_depth: optional(|one| one.indentation_depth),
        normal_force: optional(|one| one.normal_force),
        contact_area: optional(|one| one.contact_area),
    }
}

/// What is made of the difference between fine and coarse grids.
#[derive(Clone, Copy)]
pub(crate) struct Limit {
    /// Part of it by which the limit lies beyond the fine grids.
    pub(crate) beyond: f64,
    /// The same of the area.
    pub(crate) beyond_of_area: f64,
    /// Bar over it.
    pub(crate) bar: f64,
}

impl Limit {
    /// Of one grid of either spacing.
    #[cfg(any(feature = "rough", test))]
    pub(crate) fn of_single(self, fine: Change<f64>, coarse: Change<f64>) -> Change<Estimate> {
        let [fine, coarse] = [fine, coarse].map(|change| mean(vec![change]));
        self.of(fine, coarse)
    }

    pub(super) fn of(self, fine: Change<Apart>, coarse: Change<Apart>) -> Change<Estimate> {
        let estimate = |beyond: f64| {
            move |([value, apart], [other, _]): (Apart, Apart)| {
                let step = value - other;
                Estimate::new(value + beyond * step, self.bar * step.abs() + apart)
            }
        };
        let both = |of: fn(&Change<Apart>) -> Option<Apart>, beyond: f64| {
            of(&fine).zip(of(&coarse)).map(estimate(beyond))
        };
        let friction = (fine.friction_coefficient, coarse.friction_coefficient);
        Change {
            friction_coefficient: estimate(self.beyond)(friction),
            indentation_depth: both(|one| one.indentation_depth, self.beyond),
            normal_force: both(|one| one.normal_force, self.beyond),
            contact_area: both(|one| one.contact_area, self.beyond_of_area),
        }
    }
}
