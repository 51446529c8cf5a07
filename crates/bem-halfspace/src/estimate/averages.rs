//! Quantities averaged over shifted grids of one spacing.

/// A quantity over shifted grids.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Average {
    /// Mean.
    pub value: f64,
    /// Standard deviation; of friction half the difference between the means over two halves of the shifts.
    pub scatter: f64,
}

impl Average {
    pub(crate) fn over_shifts<State>(states: &[State], quantity: impl Fn(&State) -> f64) -> Self {
        let count = states.len() as f64;
        let value = states.iter().map(&quantity).sum::<f64>() / count;
        let squares = states.iter().map(|state| (quantity(state) - value).powi(2));
        Self {
            value,
            scatter: (squares.sum::<f64>() / (count - 1.0)).sqrt(),
        }
    }

    /// Of shifts of which the second half lies between the first half: each half alone leaves twice as long waves.
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

    pub(crate) fn times(self, factor: f64) -> Self {
        Self {
            value: factor * self.value,
            scatter: factor * self.scatter,
        }
    }
}

/// One refinement: averages over shifted grids; in plane strain forces and areas are per length along y.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Refinement {
    /// Δx, \[m], the mean over the shifts: where a contact does not settle, its elements are 1 or 2 % finer.
    pub spacing: f64,
    /// Friction coefficient.
    pub friction_coefficient: Average,
    /// Friction coefficient [from dissipation](crate::stationary::steady::SteadySliding::friction_from_dissipation).
    pub friction_from_dissipation: Average,
    /// Part of the friction that elements may miss because the surface forgets within them.
    pub unresolved: f64,
    /// Whether the contact ends within a few elements of an edge of the body, so that the elements do not see which of the two
    /// it ends at.
    pub hides_edge: bool,
    /// Normal force, \[N].
    pub normal_force: Average,
    /// Depth after the sliding distance of the load, or the
    /// [reference depth](crate::stationary::steady::SinkingDepth::reference_depth) without one, \[m].
    pub indentation_depth: Average,
    /// [Area](crate::PressureField::contact_area) of the contact, \[m²].
    pub contact_area: Average,
    /// Largest pressure of an element, \[Pa].
    pub peak_pressure: Average,
    /// Unknown pressures on the largest of the grids.
    pub unknowns: usize,
}
