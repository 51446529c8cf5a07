//! Quantities averaged over shifted grids of one spacing.
//!
//! Theory: docs/theory/stationary-half-space.md, "Scatter, order, error bar".

/// Mean and scatter of a quantity over shifted grids.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Average {
    /// Mean over the shifted grids.
    pub value: f64,
    /// Standard deviation; for friction half the difference between the means over two interleaved halves of the shifts.
    pub scatter: f64,
}

impl Average {
    /// Mean and standard deviation (n − 1 degrees of freedom) of a quantity over at least two shifts.
    pub(crate) fn over_shifts<State>(states: &[State], quantity: impl Fn(&State) -> f64) -> Self {
        let count = states.len() as f64;
        let value = states.iter().map(&quantity).sum::<f64>() / count;
        let squares = states.iter().map(|state| (quantity(state) - value).powi(2));
        Self {
            value,
            scatter: (squares.sum::<f64>() / (count - 1.0)).sqrt(),
        }
    }

    /// Mean of a quantity over all shifts, with half the difference between the means of two interleaved halves as scatter.
    ///
    /// The second half of `states` must have shifts between those of the first half. The mean over one half leaves errors of twice the
    /// wavelength of those that the mean over all shifts leaves.
    pub(crate) fn over_interleaved_shifts<State>(
        states: &[State],
        quantity: impl Fn(&State) -> f64,
    ) -> Self {
        let (first, second) = states.split_at(states.len() / 2);
        let [first, second] = [first, second].map(|half| Self::over_shifts(half, &quantity).value);
        Self {
            value: 0.5 * (first + second),
            scatter: 0.5 * (first - second).abs(),
        }
    }
}

/// Averages over the shifted grids of one spacing; in plane strain forces and areas are per length along y.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Refinement {
    /// Element length Δx, \[m], the mean over the shifts. A shift whose contact does not converge is solved on elements that are 1
    /// or 2 % finer.
    pub spacing: f64,
    /// Friction coefficient.
    pub friction_coefficient: Average,
    /// Friction coefficient [from dissipation](crate::stationary::steady::SteadySliding::friction_from_dissipation).
    pub friction_from_dissipation: Average,
    /// Normal force, \[N].
    pub normal_force: Average,
    /// Depth after the sliding distance of the load, or the
    /// [reference depth](crate::stationary::steady::SinkingDepth::reference_depth) without one, \[m].
    pub indentation_depth: Average,
    /// Contact [area](crate::PressureField::contact_area), \[m²].
    pub contact_area: Average,
    /// Largest pressure of an element, \[Pa].
    pub peak_pressure: Average,
    /// Unknown pressures on the largest of the grids.
    pub unknowns: usize,
}
