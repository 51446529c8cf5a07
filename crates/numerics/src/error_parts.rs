//! What an error bar consists of.

/// Parts of an error bar, absolute, of the same unit as its value; a part that a method does not have is left out.
///
/// The bar is not smaller than their sum.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ErrorParts {
    /// Of the elements, and of the steps in time where their size follows from that of the elements.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub discretisation: Option<f64>,
    /// Of a system of equations that is solved to a tolerance.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub iteration: Option<f64>,
    /// Of the memory of the material over a step.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub time_stepping: Option<f64>,
    /// Of the distance that is left to the stationary state.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub truncation: Option<f64>,
    /// Of a series of branches that stands for another law.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub material: Option<f64>,
}

impl ErrorParts {
    /// Of a method that has no such parts.
    pub const NONE: Self = Self {
        discretisation: None,
        iteration: None,
        time_stepping: None,
        truncation: None,
        material: None,
    };

    /// An error of elements only.
    pub const fn of_elements(error: f64) -> Self {
        Self {
            discretisation: Some(error),
            ..Self::NONE
        }
    }

    /// Whether no part is known.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// The parts by their names in JSON and CSV.
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

    /// Of a value that is so many times as large.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        self.each_with(Self::NONE, |part, _| part.map(|part| factor * part))
    }

    /// All parts of both; what both have is added.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        self.each_with(other, |part, other| match (part, other) {
            (Some(part), Some(other)) => Some(part + other),
            (part, other) => part.or(other),
        })
    }

    fn each_with(
        self,
        other: Self,
        joined: impl Fn(Option<f64>, Option<f64>) -> Option<f64>,
    ) -> Self {
        Self {
            discretisation: joined(self.discretisation, other.discretisation),
            iteration: joined(self.iteration, other.iteration),
            time_stepping: joined(self.time_stepping, other.time_stepping),
            truncation: joined(self.truncation, other.truncation),
            material: joined(self.material, other.material),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_part_is_lost_when_two_bars_are_joined() {
        let truncated = ErrorParts {
            discretisation: Some(2.0),
            truncation: Some(4.0),
            ..ErrorParts::NONE
        };
        let got = ErrorParts::of_elements(1.0).and(truncated);
        let expected = ErrorParts {
            discretisation: Some(3.0),
            ..truncated
        };
        assert_eq!(got, expected, "1, and {truncated:?}");
        let halves = got.times(0.5).named().map(|(_, part)| part);
        assert_eq!(
            halves,
            [Some(1.5), None, None, Some(2.0), None],
            "of {got:?}"
        );
        let known = [got, ErrorParts::NONE].map(|parts| parts.is_none());
        assert_eq!(known, [false, true], "no part");
    }
}
