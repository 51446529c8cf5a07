//! Extrapolation of derivatives from two grids, with their errors.
//!
//! Theory: docs/theory/sensitivities.md, "How they are computed".

use numerics::Estimate;

use crate::parallel::reductions::mean;
use crate::stationary::steady::sensitivity::Change;

/// A mean over shifted grids, and the largest deviation of a grid from it.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeanAndSpread {
    /// Mean over the shifts.
    pub(super) mean: f64,
    /// Largest deviation from the mean.
    pub(super) spread: f64,
}

impl MeanAndSpread {
    /// Mean of the values on all shifted grids, and their largest deviation from it.
    fn over(values: Vec<f64>) -> Self {
        let mean = mean(&values);
        let deviations = values.iter().map(|value| (value - mean).abs());
        Self {
            mean,
            spread: deviations.fold(0.0, f64::max),
        }
    }
}

/// The mean and the spread of each quantity over shifted grids; `None` for a quantity that one of them lacks.
pub(super) fn mean_over_shifts(changes: Vec<Change<f64>>) -> Change<MeanAndSpread> {
    let optional = |quantity: fn(&Change<f64>) -> Option<f64>| {
        let values: Option<Vec<f64>> = changes.iter().map(quantity).collect();
        values.map(MeanAndSpread::over)
    };
    let friction = changes.iter().map(|one| one.friction_coefficient);
    Change {
        friction_coefficient: MeanAndSpread::over(friction.collect()),
        indentation_depth: optional(|one| one.indentation_depth),
        normal_force: optional(|one| one.normal_force),
        contact_area: optional(|one| one.contact_area),
    }
}

/// Richardson extrapolation from a coarse and a fine grid; all numbers are factors on the difference fine − coarse.
#[derive(Clone, Copy)]
pub(crate) struct TwoGridExtrapolation {
    /// Factor to limit − fine for all quantities but the area: 1/(2^order − 1) for spacings in the ratio 2, or 0 for no extrapolation.
    pub(crate) correction: f64,
    /// Factor to limit − fine for the area.
    pub(crate) area_correction: f64,
    /// Factor to the error of the limit.
    pub(crate) error: f64,
}

impl TwoGridExtrapolation {
    /// The limit from one fine and one coarse grid, without shifts.
    #[cfg(any(feature = "rough", test))]
    pub(crate) fn limit_of_single(
        self,
        fine: Change<f64>,
        coarse: Change<f64>,
    ) -> Change<Estimate> {
        let [fine, coarse] = [fine, coarse].map(|change| mean_over_shifts(vec![change]));
        self.limit(fine, coarse)
    }

    /// The limit from the means over shifted grids. Its error contains the spread on the fine grids.
    pub(super) fn limit(
        self,
        fine: Change<MeanAndSpread>,
        coarse: Change<MeanAndSpread>,
    ) -> Change<Estimate> {
        // Extrapolate the mean; the error contains the difference of the grids and the spread.
        let estimate = |correction: f64| {
            move |(fine, coarse): (MeanAndSpread, MeanAndSpread)| {
                let difference = fine.mean - coarse.mean;
                Estimate::new(
                    fine.mean + correction * difference,
                    self.error * difference.abs() + fine.spread,
                )
            }
        };
        let limit_of = |of: fn(&Change<MeanAndSpread>) -> Option<MeanAndSpread>,
                        correction: f64| {
            of(&fine).zip(of(&coarse)).map(estimate(correction))
        };
        let friction = (fine.friction_coefficient, coarse.friction_coefficient);
        Change {
            friction_coefficient: estimate(self.correction)(friction),
            indentation_depth: limit_of(|one| one.indentation_depth, self.correction),
            normal_force: limit_of(|one| one.normal_force, self.correction),
            contact_area: limit_of(|one| one.contact_area, self.area_correction),
        }
    }
}
