//! Parts of an error bar by their sources.

/// Absolute parts of an error bar, in the unit of its value; a part is `None` if the method does not have it.
///
/// The error bar is at least their sum.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ErrorParts {
    /// Error of elements of finite size, and of time steps if their size follows from that of the elements.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub discretisation: Option<f64>,
    /// Error of a system of equations that is solved to a tolerance.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub iteration: Option<f64>,
    /// Error of the history variables of the material over a time step.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub time_stepping: Option<f64>,
    /// Error of a finite sliding distance in the place of the stationary state.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub truncation: Option<f64>,
    /// Error of a series of branches in the place of another material law.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub material: Option<f64>,
}

impl ErrorParts {
    /// The parts of a method without any of these errors.
    pub const NONE: Self = Self {
        discretisation: None,
        iteration: None,
        time_stepping: None,
        truncation: None,
        material: None,
    };

    /// A discretisation error without other parts.
    pub const fn discretisation_only(error: f64) -> Self {
        Self {
            discretisation: Some(error),
            ..Self::NONE
        }
    }

    /// Whether no part is known.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Parts of the error with their names in JSON and CSV; `None` for a part that the method does not have.
    pub const fn named(&self) -> [(&'static str, Option<f64>); 5] {
        [
            ("discretisation", self.discretisation),
            ("iteration", self.iteration),
            ("time_stepping", self.time_stepping),
            ("truncation", self.truncation),
            ("material", self.material),
        ]
    }

    /// Sum of the known parts.
    pub fn sum(&self) -> f64 {
        self.named().iter().filter_map(|(_, part)| *part).sum()
    }

    /// Error parts of the product of the value and a factor ≥ 0.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        self.combined_by(Self::NONE, |part, _| part.map(|part| factor * part))
    }

    /// The sum of both, part by part; a part that only one of them has is kept.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        self.combined_by(other, |part, other| match (part, other) {
            (Some(part), Some(other)) => Some(part + other),
            (part, other) => part.or(other),
        })
    }

    /// Combines each part of this error bar with the same part of another one.
    fn combined_by(
        self,
        other: Self,
        combine: impl Fn(Option<f64>, Option<f64>) -> Option<f64>,
    ) -> Self {
        Self {
            discretisation: combine(self.discretisation, other.discretisation),
            iteration: combine(self.iteration, other.iteration),
            time_stepping: combine(self.time_stepping, other.time_stepping),
            truncation: combine(self.truncation, other.truncation),
            material: combine(self.material, other.material),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_part_is_lost_when_two_error_bars_are_added() {
        let truncated = ErrorParts {
            discretisation: Some(2.0),
            truncation: Some(4.0),
            ..ErrorParts::NONE
        };
        let sum = ErrorParts::discretisation_only(1.0).plus(truncated);
        let expected = ErrorParts {
            discretisation: Some(3.0),
            ..truncated
        };
        assert_eq!(sum, expected, "1, and {truncated:?}");
        let halves = sum.scaled(0.5).named().map(|(_, part)| part);
        assert_eq!(
            halves,
            [Some(1.5), None, None, Some(2.0), None],
            "of {sum:?}"
        );
        let known = [sum, ErrorParts::NONE].map(|parts| parts.is_none());
        assert_eq!(known, [false, true], "no part");
    }
}
