//! Sums of power profiles.
//!
//! ```text
//! h(r) = Σ c_k r^(p_k)        h̃(x) = Σ κ(p_k) c_k |x|^(p_k)
//! ```

use crate::power::scaled_power;
use crate::table::check_min_length;
use crate::{Axisymmetric, IndenterError, LinePoint, ProfilePoint, stretch, surface_of_revolution};
use numerics::{in_range, positive};

/// One term `coefficient · r^exponent` of a [`Superposition`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PowerTerm {
    /// Coefficient c, [m^(1−p)]; finite, not zero, of either sign.
    pub coefficient: f64,
    /// Exponent p, finite and greater than zero.
    pub exponent: f64,
}

/// A body of revolution whose profile is a sum of powers, all with different exponents.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Superposition {
    /// Terms of the profile by increasing exponent.
    terms: Vec<PowerTerm>,
    /// Terms of the equivalent line by increasing exponent.
    #[cfg_attr(feature = "serde", serde(skip))]
    line_terms: Vec<PowerTerm>,
}

impl Superposition {
    /// The sum of the `terms`, given in any order.
    ///
    /// Negative coefficients are allowed except for the lowest exponent, which shapes the apex.
    ///
    /// # Errors
    /// [`IndenterError::TooFew`] without a term; [`IndenterError::InvalidParameter`] when a number is out of its range
    /// or two exponents agree.
    pub fn new(mut terms: Vec<PowerTerm>) -> Result<Self, IndenterError> {
        for term in &terms {
            positive("exponent", term.exponent)?;
            let is_valid = term.coefficient.is_finite() && term.coefficient != 0.0;
            in_range(
                "coefficient",
                term.coefficient,
                is_valid,
                "finite and not 0",
            )?;
        }
        terms.sort_by(|one, other| one.exponent.total_cmp(&other.exponent));
        check_min_length(1, "terms", terms.len())?;
        positive("coefficient of the lowest exponent", terms[0].coefficient)?;
        for pair in terms.windows(2) {
            let [before, exponent] = [pair[0].exponent, pair[1].exponent];
            let allowed = "different from the exponents of the other terms";
            in_range("exponent", exponent, before < exponent, allowed)?;
        }
        // The equivalent line is linear in the profile: each term is stretched by its own factor.
        let mut line_terms = terms.clone();
        for term in &mut line_terms {
            term.coefficient *= stretch(term.exponent)?;
        }
        Ok(Self { terms, line_terms })
    }

    /// The terms by increasing exponent.
    pub fn terms(&self) -> &[PowerTerm] {
        &self.terms
    }
}

impl Axisymmetric for Superposition {
    fn profile(&self, radius: f64) -> ProfilePoint {
        ProfilePoint {
            height: derivative(&self.terms, 0.0, |_| 1.0, radius),
            slope: derivative(&self.terms, 1.0, |p| p, radius),
            curvature: derivative(&self.terms, 2.0, |p| p * (p - 1.0), radius),
        }
    }

    fn profile_exponent(&self) -> f64 {
        self.terms[0].exponent
    }

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        Some(LinePoint {
            height: derivative(&self.line_terms, 0.0, |_| 1.0, x),
            slope: derivative(&self.line_terms, 1.0, |p| p, x),
        })
    }
}

surface_of_revolution!(Superposition);

/// Derivative Σ c w(p) r^(p − order) of a sum of powers; `weight` w(p) is p (p − 1) … (p − order + 1).
fn derivative(terms: &[PowerTerm], order: f64, weight: impl Fn(f64) -> f64, radius: f64) -> f64 {
    let power = |term: &PowerTerm, shift: f64| {
        let coefficient = term.coefficient * weight(term.exponent);
        scaled_power(coefficient, radius, term.exponent - shift)
    };
    let sum: f64 = terms.iter().map(|term| power(term, order)).sum();
    if !sum.is_nan() {
        return sum;
    }
    // Here the sum is ∞ − ∞. Factor out the dominant power: the highest one for large radii, the lowest one at the apex.
    let shift = match terms {
        [.., last] if radius > 1.0 => last.exponent,
        [first, ..] => first.exponent,
        [] => return sum,
    };
    let mantissa: f64 = terms.iter().map(|term| power(term, shift)).sum();
    scaled_power(mantissa, radius, shift - order)
}
