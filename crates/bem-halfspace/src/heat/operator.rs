//! Temperature of the elements of one grid by fluxes on them.

use crate::Grid;
use crate::heat::periodic_waves::PeriodicWaves;
use crate::heat::source::SourceDepth;
use crate::heat::time_rule::TimeRule;
use crate::transform::fast_length::fast_length;
use crate::transform::plane_transform::complex_product::Spectrum;
use crate::transform::plane_transform::{PlaneTransform, Workspace};

/// Kernel of moving heat sources on the elements of a grid.
#[derive(Debug, Clone)]
pub(super) enum HeatKernel {
    /// Sources of one body or of a line.
    Free(TimeRule),
    /// Sources on one period of a periodic surface.
    Periodic(PeriodicWaves),
}

/// Fluxes to temperatures on one grid.
#[derive(Debug, Clone)]
pub(super) struct HeatOperator {
    /// Grid of the elements, in units of `unit`.
    pub(super) grid: Grid,
    /// Length unit of the grid, \[m].
    unit: f64,
    /// Kernel from which spectra for any depth follow.
    kernel: HeatKernel,
    /// Plans of the transforms.
    transform: PlaneTransform,
}

impl HeatOperator {
    /// The operator of a kernel on `grid`, whose lengths are in units of `unit` \[m].
    pub(super) fn new(grid: &Grid, unit: f64, kernel: HeatKernel) -> Self {
        let transform = PlaneTransform::new(match kernel {
            // Zero padding makes the circular convolution of the transform equal to the free one.
            HeatKernel::Free(_) => grid.shape().map(|n| fast_length(2 * n - 1)),
            HeatKernel::Periodic(_) => grid.shape(),
        });
        Self {
            grid: *grid,
            unit,
            kernel,
            transform,
        }
    }

    /// Spectrum of the kernel for sources at a `depth`.
    fn spectrum(&self, depth: &SourceDepth) -> Spectrum {
        match &self.kernel {
            HeatKernel::Free(rule) => rule.spectrum(&self.transform, depth, self.unit),
            HeatKernel::Periodic(waves) => waves.spectrum(&self.transform, depth, self.unit),
        }
    }

    /// Adds the temperature k T/unit by a flux at a `depth` to `temperature`; `field` holds the flux, and is overwritten.
    pub(super) fn add_temperature(
        &self,
        depth: &SourceDepth,
        field: &mut [f64],
        temperature: &mut [f64],
    ) {
        let mut workspace = Workspace::new(&self.transform, self.grid.shape());
        let spectrum = self.spectrum(depth);
        self.transform.filter(&mut workspace, field, &spectrum);
        for (sum, value) in temperature.iter_mut().zip(field) {
            *sum += *value;
        }
    }
}
