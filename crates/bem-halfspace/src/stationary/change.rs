//! First-order changes of a stationary contact, of single bodies and of periodic surfaces alike.
//!
//! Theory: docs/theory/sensitivities.md.

use numerics::{Estimate, InvalidParameter, in_range, not_negative};

use crate::BemError;

/// The change of a stationary state to first order. For a periodic surface forces are those of one period, and the depth is that of the
/// mean plane.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub struct Change<T> {
    /// Change of the friction coefficient.
    pub friction_coefficient: T,
    /// Change of the indentation depth under a given force, \[m]. `None` at a given depth, in plane strain, and on a half space
    /// that flows.
    pub indentation_depth: Option<T>,
    /// Change of the normal force at a given depth, \[N]. `None` under a given force.
    pub normal_force: Option<T>,
    /// Change of the logarithm of the contact area, or of the width in plane strain. `None` under bodies with edges.
    pub contact_area: Option<T>,
}

/// The derivatives by the complex modulus in a band of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub struct ByModuli {
    /// Lowest and highest angular frequency of the band, \[rad/s].
    pub frequencies: [f64; 2],
    /// Derivative by the logarithm of the storage modulus in the band.
    pub storage_modulus: Change<Estimate>,
    /// Derivative by the logarithm of the loss modulus in the band.
    pub loss_modulus: Change<Estimate>,
}

impl<T> Change<T> {
    /// Applies a function to the change of each quantity; quantities without a change stay `None`.
    pub fn map<U>(&self, mut function: impl FnMut(&T) -> U) -> Change<U> {
        Change {
            friction_coefficient: function(&self.friction_coefficient),
            indentation_depth: self.indentation_depth.as_ref().map(&mut function),
            normal_force: self.normal_force.as_ref().map(&mut function),
            contact_area: self.contact_area.as_ref().map(&mut function),
        }
    }
}

impl Change<f64> {
    /// The change at a constant depth, from this change under a constant force and the derivatives by the force (chain rule).
    ///
    /// The force of the result is NaN if the depth has no change, as in plane strain.
    pub(crate) fn at_constant_depth(&self, by_force: &Self) -> Self {
        // The force changes so that the depth stays: by minus the change of the depth over the derivative of the depth by the force.
        let depths = self.indentation_depth.zip(by_force.indentation_depth);
        let force = depths.map_or(f64::NAN, |(change, by_force)| -change / by_force);
        let areas = self.contact_area.zip(by_force.contact_area);
        Self {
            friction_coefficient: self.friction_coefficient + force * by_force.friction_coefficient,
            indentation_depth: None,
            normal_force: Some(force),
            contact_area: areas.map(|(change, by_force)| change + force * by_force),
        }
    }

    /// The derivatives by a given depth, per metre, from those by the force, per newton.
    pub(crate) fn by_depth(by_force: &Self) -> Self {
        // A change of the given depth acts like the opposite change of the depth under a constant force.
        let sinking = Self {
            indentation_depth: Some(-1.0),
            ..by_force.map(|_| 0.0)
        };
        sinking.at_constant_depth(by_force)
    }
}

/// The derivatives by the moduli in the bands between successive `frequencies` \[rad/s].
///
/// `in_band` returns the derivatives by the logarithms of [storage modulus, loss modulus] in one band.
///
/// # Errors
/// [`BemError::InvalidParameter`] for frequencies that are negative or not increasing, and those of a band.
pub(crate) fn by_moduli(
    frequencies: &[f64],
    in_band: impl Fn([f64; 2]) -> Result<[Change<Estimate>; 2], BemError>,
) -> Result<Vec<ByModuli>, BemError> {
    // Check each band before its derivatives are computed.
    let bands = frequencies.windows(2).map(checked_band);
    let by_moduli = bands.map(|valid_band| {
        let frequencies = valid_band?;
        let [storage_modulus, loss_modulus] = in_band(frequencies)?;
        Ok(ByModuli {
            frequencies,
            storage_modulus,
            loss_modulus,
        })
    });
    by_moduli.collect()
}

/// The band between two frequencies \[rad/s]; fails unless the first is not negative and the second is larger.
fn checked_band(ends: &[f64]) -> Result<[f64; 2], InvalidParameter> {
    not_negative("frequency", ends[0])?;
    let is_increasing = ends[1] > ends[0];
    let allowed = "greater than the one before";
    in_range("frequency", ends[1], is_increasing, allowed)?;
    Ok([ends[0], ends[1]])
}
