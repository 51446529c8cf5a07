//! Rigid lines given by formulas.

use std::fmt;

use crate::table::check_increasing;
use crate::{IndenterError, RigidLine};
use numerics::finite;

/// A rigid line whose height and slope are functions of the position.
#[derive(Clone)]
pub struct AnalyticLine<H, S> {
    /// Height \[m] as a function of the position \[m].
    height: H,
    /// Slope as a function of the position \[m].
    slope: S,
    /// Rear and front end of the line, \[m].
    domain: [f64; 2],
}

impl<H: Fn(f64) -> f64, S: Fn(f64) -> f64> AnalyticLine<H, S> {
    /// The line with the given `height` \[m] and `slope`, which is the derivative of the height, on the closed interval
    /// `domain` \[m].
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when the domain, or the height at one of its ends, is not finite;
    /// [`IndenterError::NotIncreasing`] when the domain is empty. Heights inside are checked by the functions that sample
    /// them.
    pub fn new(height: H, slope: S, domain: [f64; 2]) -> Result<Self, IndenterError> {
        for end in domain {
            finite("end of the domain", end)?;
        }
        check_increasing("domain", &domain)?;
        for end in domain {
            finite("height of the line", height(end))?;
        }
        Ok(Self {
            height,
            slope,
            domain,
        })
    }
}

impl<H: Fn(f64) -> f64, S: Fn(f64) -> f64> RigidLine for AnalyticLine<H, S> {
    fn height(&self, x: f64) -> f64 {
        let [lower, upper] = self.domain;
        if (lower..=upper).contains(&x) {
            return (self.height)(x);
        }
        f64::INFINITY
    }

    fn slope(&self, x: f64) -> f64 {
        (self.slope)(x)
    }

    fn domain(&self) -> [f64; 2] {
        self.domain
    }
}

impl<H, S> fmt::Debug for AnalyticLine<H, S> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "AnalyticLine on {:?}", self.domain)
    }
}
