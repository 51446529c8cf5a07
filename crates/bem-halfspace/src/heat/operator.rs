//! Temperature of the elements of one grid by fluxes on them.

use crate::heat::periodic_waves::PeriodicWaves;
use crate::heat::source::SourceDepth;
use crate::heat::time_rule::TimeRule;
use crate::heat::{ContactKind, HeatConductor};
use crate::transform::fast_length::fast_length;
use crate::transform::plane_transform::complex_product::Spectrum;
use crate::transform::plane_transform::{PlaneTransform, Workspace};
use crate::{BemError, Grid};

/// Kernel of moving heat sources on the elements of a grid.
#[derive(Debug, Clone)]
enum HeatKernel {
    /// Sources of one body or of a line.
    Free(TimeRule),
    /// Sources on one period of a periodic surface.
    Periodic(PeriodicWaves),
}

/// Fluxes to temperatures on one grid.
#[derive(Debug, Clone)]
pub(super) struct HeatOperator {
    /// Grid of the elements.
    pub(super) grid: Grid,
    /// Length unit of the kernel, the edge of an element along x, \[m].
    unit: f64,
    /// Factor from fluxes to temperatures of the kernel: the unit of length over the conductivity.
    scale: f64,
    /// Kernel from which spectra for any depth follow.
    kernel: HeatKernel,
    /// Plans of the transforms.
    transform: PlaneTransform,
}

impl HeatOperator {
    /// The operator on the elements of `grid` for a contact that moves along +x with a velocity \[m/s].
    pub(super) fn new(
        grid: &Grid,
        kind: ContactKind,
        conductor: &HeatConductor,
        velocity: f64,
    ) -> Result<Self, BemError> {
        // With the edge along x as the unit of length, kernels depend on ratios of lengths only.
        let unit = grid.spacing()[0];
        let scaled = Grid::new(grid.shape(), grid.spacing().map(|edge| edge / unit))?;
        let diffusivity = conductor.diffusivity();
        let wake_length = 4.0 * diffusivity / velocity / unit;
        let kernel = match kind {
            ContactKind::Body => HeatKernel::Free(TimeRule::of_body(&scaled, wake_length)),
            ContactKind::Line => HeatKernel::Free(TimeRule::of_line(&scaled, wake_length)),
            ContactKind::Period { duration } => HeatKernel::Periodic(PeriodicWaves {
                grid: scaled,
                velocity_over_diffusivity: velocity * unit / diffusivity,
                mean_length: 2.0 * (diffusivity.sqrt() * duration.sqrt()) / unit,
            }),
        };
        let transform = PlaneTransform::new(match kernel {
            // Zero padding makes the circular convolution of the transform equal to the free one.
            HeatKernel::Free(_) => grid.shape().map(|n| fast_length(2 * n - 1)),
            HeatKernel::Periodic(_) => grid.shape(),
        });
        Ok(Self {
            grid: *grid,
            unit,
            scale: unit / conductor.conductivity(),
            kernel,
            transform,
        })
    }

    /// Spectrum of the kernel for sources at a `depth`.
    fn spectrum(&self, depth: &SourceDepth) -> Spectrum {
        match &self.kernel {
            HeatKernel::Free(rule) => rule.spectrum(&self.transform, depth, self.unit),
            HeatKernel::Periodic(waves) => waves.spectrum(&self.transform, depth, self.unit),
        }
    }

    /// Adds the temperature \[K] by a flux \[W/m²] at a `depth` to `temperature`; `field` holds the flux, and is overwritten.
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
            *sum += self.scale * *value;
        }
    }
}
