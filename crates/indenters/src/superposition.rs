//! Sums of power profiles.
//!
//! ```text
//! h(r) = Σ c_k r^(p_k)        h̃(x) = Σ κ(p_k) c_k |x|^(p_k)
//! ```

use crate::power::scaled_power;
use crate::table::check_min_length;
use crate::{Axisymmetric, IndenterError, LinePoint, ProfilePoint, stretch, surface_of_revolution};
use numerics::{bracketed_root, in_range, positive};

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
///
/// If the highest power has a negative coefficient, the body ends at its outermost crest, because the profile falls without limit
/// beyond it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Superposition {
    /// Terms of the profile by increasing exponent.
    terms: Vec<PowerTerm>,
    /// Terms of the equivalent line by increasing exponent.
    #[cfg_attr(feature = "serde", serde(skip))]
    line_terms: Vec<PowerTerm>,
    /// Radius at which the body ends, \[m]; `+∞` if it does not.
    #[cfg_attr(feature = "serde", serde(skip))]
    max_radius: f64,
    /// Radius beyond which the equivalent line only rises, \[m].
    #[cfg_attr(feature = "serde", serde(skip))]
    falling_up_to: f64,
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
        let is_endless = terms[terms.len() - 1].coefficient > 0.0;
        let crest = outermost_turn(&terms);
        Ok(Self {
            max_radius: if is_endless { f64::INFINITY } else { crest },
            falling_up_to: if is_endless {
                outermost_turn(&line_terms)
            } else {
                crest
            },
            terms,
            line_terms,
        })
    }

    /// The terms by increasing exponent.
    pub fn terms(&self) -> &[PowerTerm] {
        &self.terms
    }
}

impl Axisymmetric for Superposition {
    fn profile(&self, radius: f64) -> ProfilePoint {
        if radius > self.max_radius {
            return ProfilePoint::ENDED;
        }
        ProfilePoint {
            height: derivative(&self.terms, 0.0, |_| 1.0, radius),
            slope: derivative(&self.terms, 1.0, |p| p, radius),
            curvature: derivative(&self.terms, 2.0, |p| p * (p - 1.0), radius),
        }
    }

    fn profile_exponent(&self) -> f64 {
        self.terms[0].exponent
    }

    fn max_radius(&self) -> f64 {
        self.max_radius
    }

    fn falling_up_to(&self) -> f64 {
        self.falling_up_to
    }

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        if x > self.max_radius {
            return Some(LinePoint::ENDED);
        }
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

/// Largest radius at which the slope of a sum of powers changes its sign, \[m]; 0 if it does not.
fn outermost_turn(terms: &[PowerTerm]) -> f64 {
    let slope: Vec<PowerTerm> = terms
        .iter()
        .map(|term| PowerTerm {
            coefficient: term.coefficient * term.exponent,
            ..*term
        })
        .collect();
    sign_changes(&slope)
        .last()
        .map_or(0.0, |logarithm| logarithm.exp())
}

/// Logarithms t of the radii at which a sum Σ a e^(p t) of powers, by increasing exponent, changes its sign, in increasing order.
///
/// Divided by its first power the sum has a derivative with one term fewer, between whose sign changes it is monotone and changes its
/// own sign once at most. This is the proof of Descartes' rule of signs for real exponents (Pólya & Szegő 1971, Part V, no. 77).
fn sign_changes(terms: &[PowerTerm]) -> Vec<f64> {
    let ([first, rest @ ..], [others @ .., last]) = (terms, terms) else {
        return Vec::new();
    };
    let derivative: Vec<PowerTerm> = rest
        .iter()
        .map(|term| PowerTerm {
            coefficient: term.coefficient * (term.exponent - first.exponent),
            exponent: term.exponent - first.exponent,
        })
        .collect();
    // Below the first of these bounds the first term, and above the second one the last term exceeds the sum of all others.
    let size = |term: &PowerTerm| (terms.len() as f64 * term.coefficient.abs()).ln();
    let equal = |dominant: &PowerTerm, other: &PowerTerm| {
        (size(other) - dominant.coefficient.abs().ln()) / (dominant.exponent - other.exponent)
    };
    let lowest = rest.iter().map(|term| equal(first, term));
    let highest = others.iter().map(|term| equal(last, term));
    let mut bounds = vec![lowest.fold(f64::INFINITY, f64::min)];
    bounds.extend(sign_changes(&derivative));
    bounds.push(highest.fold(f64::NEG_INFINITY, f64::max));
    bounds.sort_by(f64::total_cmp);
    let sum = |t: f64| {
        let logarithm = |term: &PowerTerm| term.coefficient.abs().ln() + term.exponent * t;
        let largest = terms
            .iter()
            .map(logarithm)
            .fold(f64::NEG_INFINITY, f64::max);
        let scaled = |term| (logarithm(term) - largest).exp().copysign(term.coefficient);
        terms.iter().map(scaled).sum::<f64>()
    };
    bounds
        .windows(2)
        .filter_map(|ends| bracketed_root(sum, [ends[0], ends[1]]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_whose_highest_power_falls_ends_at_its_outermost_crest() {
        // Its slope is r (1 − r²) (4 − r²) (9 − r²): crests at 1 and 3, with a valley between them.
        let power = |coefficient: f64, exponent: f64| PowerTerm {
            coefficient: coefficient / exponent,
            exponent,
        };
        let terms = vec![
            power(36.0, 2.0),
            power(-49.0, 4.0),
            power(14.0, 6.0),
            power(-1.0, 8.0),
        ];
        let body = Superposition::new(terms).expect("a body");
        assert!((body.max_radius() - 3.0).abs() < 1e-14, "{body:?}");
        assert!(body.profile(2.999_999).slope > 0.0, "{body:?}");
        assert_eq!(body.profile(3.000_001), ProfilePoint::ENDED);
        // Squares of this crest, and ratios of these coefficients, are beyond the range of f64.
        let sum = |c: f64| Superposition::new(vec![power(2e-200, 2.0), power(-4.0 * c, 4.0)]);
        let crest = sum(1e200).expect("a body").max_radius() * 1e200;
        assert!((crest - 0.5_f64.sqrt()).abs() < 1e-12, "{crest}");
        let rising = Superposition::new(vec![power(1.0, 2.0), power(-1.0, 3.0), power(1.0, 5.0)]);
        assert!(rising.expect("a body").max_radius().is_infinite());
    }
}
