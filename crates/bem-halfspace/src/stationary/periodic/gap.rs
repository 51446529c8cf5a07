//! Gap below a periodic surface in contact, from its pressure.
//!
//! ```text
//! gap = h + u − d,        d = mean of h + u over the elements with pressure
//! ```
//!
//! Theory: docs/theory/stationary-half-space.md, "Periodic surfaces".

use indenters::rough::PeriodicSurface;

use crate::elements::gap_field::GapField;
use crate::parallel::chunks::in_pool;
use crate::stationary::periodic::kernel::{MaterialAtSpeed, PeriodicKernel};
use crate::stationary::periodic::load::PeriodicLoad;
use crate::stationary::periodic::refinement::{SampledSurface, check_periods};
use crate::{BemError, Elastomer, PressureField};

/// Gap between a periodic surface and the elastomer under a load, from the pressure of the stationary state or of the pressed
/// surface, and on its grid.
///
/// # Errors
/// As for [`steady`](super::steady), before anything is solved; [`BemError::LengthMismatch`] and [`BemError::InvalidParameter`] for a
/// field without one pressure per element, without a positive one, or with another period than the surface.
pub fn gap(
    surface: &PeriodicSurface,
    elastomer: &dyn Elastomer,
    load: &PeriodicLoad,
    field: &PressureField,
) -> Result<GapField, BemError> {
    load.require_stationary()?;
    field.check_contact()?;
    check_periods(surface, &field.grid)?;
    let sliding = MaterialAtSpeed::under_load(elastomer, load)?;
    let (grid, pressure) = (field.grid, &field.pressure);
    let SampledSurface { heights, .. } = SampledSurface::new(surface, grid.shape())?;
    let mut kernel = PeriodicKernel::new(&sliding, &grid)?;
    let gap = in_pool(grid.n_elements(), || {
        let [mut gap, mut raised] = [0; 2].map(|_| vec![0.0; grid.n_elements()]);
        // Add displacements and heights at the collocation points of the kernel.
        kernel.displace(pressure, &mut gap);
        kernel.shifted(&heights, &mut raised);
        // Subtract the depth, which is the mean of height and displacement in the contact.
        let (mut sum, mut count) = (0.0, 0.0);
        for ((gap, height), pressure) in gap.iter_mut().zip(&raised).zip(pressure) {
            *gap += height;
            if *pressure > 0.0 {
                sum += *gap;
                count += 1.0;
            }
        }
        let depth = sum / count;
        gap.iter_mut().for_each(|gap| *gap -= depth);
        gap
    });
    Ok(GapField {
        grid,
        origin: field.origin,
        gap,
    })
}
