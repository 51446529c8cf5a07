//! The temperature rise on a grid, its largest value and means, and their error bars.

use numerics::{Estimate, InvalidParameter, finite, in_range, not_negative, positive};

use crate::error::check_length;
use crate::heat::contact_kind::coarsened;
use crate::heat::operator::HeatOperator;
use crate::heat::source::SourceDepth;
use crate::heat::time_rule::KERNEL_ERROR;
use crate::heat::{ContactKind, Counterface, DepthProfile, HeatConductor, HeatSource};
use crate::parallel::chunks::in_pool;
use crate::{BemError, Grid, PressureField};

/// Largest Péclet number vL/(4D) of a grid of the length L. Chosen: 100 m/s over a metre of rubber have 2e8, and the number of time
/// nodes grows with its square root.
const MAX_PECLET_NUMBER: f64 = 1e10;

/// Operator from fluxes on one grid to the temperature rise of the surface, for one conductor and velocity.
///
/// The influence coefficients of sources at the surface are computed once, those of each profile of sources in the bulk when they are
/// used. The flux is constant per element, and the temperature is that at the centre. Errors are of the order Δ² for smooth
/// fluxes, and of the order Δ where the flux jumps and for the largest rise at Péclet numbers ≫ 1.
#[derive(Debug, Clone)]
pub struct SurfaceTemperature {
    /// What the fluxes are part of.
    kind: ContactKind,
    /// Operator on the grid of the fluxes, and on the grid of elements with twice the edges.
    operators: [HeatOperator; 2],
}

/// Temperature rise of the surface above the temperature far below it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
#[must_use]
pub struct TemperatureRise {
    /// Grid of the temperature.
    pub grid: Grid,
    /// Temperature rise at the centre of each element, row-major, \[K].
    pub temperature: Vec<f64>,
    /// Largest rise of an element with a flux, \[K]; 0 if there is none. For all error bars see [`SurfaceTemperature::of`].
    pub largest: Estimate,
    /// Mean rise over the area of the elements with a flux, \[K].
    pub mean: Estimate,
    /// Mean rise weighted with the flux of all sources before the counterface takes its share, \[K].
    pub flux_weighted_mean: Estimate,
    /// Temperature below the surface; `None` unless a [`SlidingContact`](crate::heat::SlidingContact) dissipates there.
    pub by_depth: Option<DepthProfile>,
    /// Power of all sources, \[W]; on a line per length, \[W/m].
    pub total_power: f64,
    /// Power that the elastomer receives, \[W]; on a line per length, \[W/m].
    pub absorbed_power: f64,
}

/// Largest value and means of a temperature on one grid.
#[derive(Debug, Clone, Copy, Default)]
struct Averages {
    /// Largest value on elements with a flux.
    largest: f64,
    /// Mean over the heated area.
    mean: f64,
    /// Mean weighted with the flux.
    flux_weighted_mean: f64,
}

/// Flux of all sources on one grid.
struct TotalFlux {
    /// Sum of the fluxes per element.
    flux: Vec<f64>,
    /// Fraction of each element that is heated.
    heated_fraction: Vec<f64>,
}

impl SurfaceTemperature {
    /// The stationary temperature under a contact that moves along +x with `velocity` ≥ 0 \[m/s]. The edges of the grid of a
    /// [period](ContactKind::Period) are the periods; otherwise the half space is unbounded.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a velocity that is not finite and at least 0, or elements with an aspect ratio out of the range
    /// of numbers; for a line at rest, or with several elements along y; and for a duration that is not finite and at least 0.
    /// [`BemError::DiffusivityTooSmall`] for a Péclet number vL/(4D) of the grid above 1e10.
    pub fn new(
        grid: &Grid,
        kind: ContactKind,
        conductor: &HeatConductor,
        velocity: f64,
    ) -> Result<Self, BemError> {
        let wake_length = wake_length(grid, conductor, velocity)?;
        match kind {
            ContactKind::Body => {}
            ContactKind::Line => {
                let moves =
                    "greater than 0, because a line source at rest has no stationary temperature";
                in_range("velocity", velocity, wake_length.is_finite(), moves)?;
                let columns = grid.shape()[1];
                let name = "number of elements along y";
                in_range(name, columns as f64, columns == 1, "1 on a line")?;
            }
            ContactKind::Period { duration } => drop(not_negative("duration", duration)?),
        }
        // The difference from a grid with twice the edges gives the error bars.
        let coarse = kind.coarse_grid(grid, 2)?;
        let operator = |grid| HeatOperator::new(grid, kind, conductor, velocity);
        let [fine, coarse] = in_pool(grid.n_elements(), || [operator(grid), operator(&coarse)]);
        Ok(Self {
            kind,
            operators: [fine?, coarse?],
        })
    }

    /// The temperature rise by `sources` on the grid; temperatures of several sources add up.
    ///
    /// The error bars are the differences from the same flux on elements with twice the edges. With the convergence order 1, the lowest
    /// that occurs, the difference is the error of the finer grid; with the order 2 of smooth fluxes it is three times the error. The
    /// bar of the largest rise also contains twice the change over half an element around the hottest centre. The maximum is not at a
    /// centre, and the difference of the largest values may vanish by chance. Bars do not contain errors of the given flux, such as
    /// that of the area of a contact of whole elements.
    ///
    /// # Errors
    /// [`BemError::LengthMismatch`] for a flux without one value per element; [`BemError::InvalidParameter`] for a flux that is not
    /// finite and at least 0, a share of the elastomer outside of 0 to 1, and a temperature or power out of the range of numbers.
    pub fn of(
        &self,
        sources: &[HeatSource<'_>],
        counterface: Counterface,
    ) -> Result<TemperatureRise, BemError> {
        let share = counterface.elastomer_share()?;
        for source in sources {
            self.check_flux(source.flux)?;
        }
        // Only the heat of the interface is shared with the counterface.
        let absorbed_share = |source: &HeatSource<'_>| match source.depth {
            SourceDepth::Surface => share,
            SourceDepth::Bulk(_) | SourceDepth::Plane(_) => 1.0,
        };
        // Superpose the temperatures of all sources, on the fine and on the coarse grid.
        let [fine, coarse] = &self.operators;
        let grid = fine.grid;
        let temperature_on = |operator: &HeatOperator, is_coarse: bool| {
            let mut temperature = vec![0.0; operator.grid.n_elements()];
            for source in sources.iter().filter(|source| absorbed_share(source) > 0.0) {
                let share = absorbed_share(source);
                let flux = source.flux.iter().map(|flux| flux * share).collect();
                let mut field = if is_coarse {
                    self.coarsened(flux)
                } else {
                    flux
                };
                operator.add_temperature(source.depth, &mut field, &mut temperature);
            }
            temperature
        };
        let [temperature, coarse_temperature] = in_pool(grid.n_elements(), || {
            [temperature_on(fine, false), temperature_on(coarse, true)]
        });

        // Compare the averages on both grids.
        let total = TotalFlux::of(sources, grid.n_elements());
        let coarse_total = TotalFlux {
            flux: self.coarsened(total.flux.clone()),
            heated_fraction: self.coarsened(total.heated_fraction.clone()),
        };
        let averages = Averages::over(&temperature, &total);
        let hottest = hottest_element(&temperature, &total.heated_fraction);
        let sampling_error = hottest.map_or(0.0, |hottest| {
            sampling_error(&temperature, hottest, grid.shape())
        });
        let coarse_averages = Averages::over(&coarse_temperature, &coarse_total);
        let power = |source| self.power(source);
        let absorbed_power = |source| absorbed_share(source) * self.power(source);
        Ok(TemperatureRise {
            grid,
            temperature,
            largest: estimate(averages.largest, coarse_averages.largest)?.widened(sampling_error),
            mean: estimate(averages.mean, coarse_averages.mean)?,
            flux_weighted_mean: estimate(
                averages.flux_weighted_mean,
                coarse_averages.flux_weighted_mean,
            )?,
            by_depth: None,
            total_power: finite("total power", sources.iter().map(power).sum())?,
            absorbed_power: sources.iter().map(absorbed_power).sum(),
        })
    }

    /// Checks the length and the values of a flux.
    fn check_flux(&self, flux: &[f64]) -> Result<(), BemError> {
        check_length("heat flux", flux.len(), self.operators[0].grid.n_elements())?;
        for value in flux {
            not_negative("heat flux", *value)?;
        }
        Ok(())
    }

    /// Power of a source, \[W]; on a line per length, \[W/m].
    fn power(&self, source: &HeatSource<'_>) -> f64 {
        source.flux.iter().sum::<f64>() * self.kind.area_of_element(&self.operators[0].grid)
    }

    /// Means of a field over the elements of the coarse grid; elements outside of the grid count as 0.
    fn coarsened(&self, field: Vec<f64>) -> Vec<f64> {
        let [fine, coarse] = &self.operators;
        let field = PressureField {
            grid: fine.grid,
            origin: [0.0; 2],
            pressure: field,
        };
        coarsened(&field, &coarse.grid).pressure
    }
}

impl TotalFlux {
    /// The sum of the fluxes of `sources` on a grid of `n_elements` elements.
    fn of(sources: &[HeatSource<'_>], n_elements: usize) -> Self {
        let mut flux = vec![0.0; n_elements];
        for source in sources {
            for (sum, value) in flux.iter_mut().zip(source.flux) {
                *sum += value;
            }
        }
        let is_heated = |flux: &f64| if *flux > 0.0 { 1.0 } else { 0.0 };
        Self {
            heated_fraction: flux.iter().map(is_heated).collect(),
            flux,
        }
    }
}

impl Averages {
    /// Averages of a temperature over the heated elements; 0 if there are none.
    fn over(temperature: &[f64], total: &TotalFlux) -> Self {
        let Some(hottest) = hottest_element(temperature, &total.heated_fraction) else {
            return Self::default();
        };
        Self {
            largest: temperature[hottest],
            mean: weighted_mean(temperature, &total.heated_fraction),
            flux_weighted_mean: weighted_mean(temperature, &total.flux),
        }
    }
}

/// Twice the excess of a temperature over that of the centre of its hottest element. The maximum is at most half an element away, and
/// up to there the temperature rises by half the mean difference from the neighbours along each axis. The excess counts twice, because
/// it may also hide as much of the difference from the coarse grid.
pub(super) fn sampling_error(temperature: &[f64], hottest: usize, shape: [usize; 2]) -> f64 {
    let [rows, columns] = shape;
    let [row, column] = [hottest / columns, hottest % columns];
    let along = |index: usize, n: usize, stride: usize| {
        let before = (index > 0).then(|| temperature[hottest - stride]);
        let behind = (index + 1 < n).then(|| temperature[hottest + stride]);
        let neighbours = [before, behind].into_iter().flatten();
        let (sum, count) = neighbours.fold((0.0, 0.0_f64), |(sum, count), value| {
            (sum + temperature[hottest] - value, count + 1.0)
        });
        sum.abs() / count.max(1.0)
    };
    along(row, rows, columns) + along(column, columns, 1)
}

/// The element with the largest temperature of those of which a fraction is heated; `None` if none is heated.
pub(super) fn hottest_element(temperature: &[f64], heated_fraction: &[f64]) -> Option<usize> {
    let heated = (0..temperature.len()).filter(|element| heated_fraction[*element] > 0.0);
    heated.max_by(|left, right| temperature[*left].total_cmp(&temperature[*right]))
}

/// Mean of values with weights whose sum is greater than 0.
pub(super) fn weighted_mean(values: &[f64], weights: &[f64]) -> f64 {
    let products = values
        .iter()
        .zip(weights)
        .map(|(value, weight)| value * weight);
    products.sum::<f64>() / weights.iter().sum::<f64>()
}

/// A temperature with its difference from that on the coarse grid as error, and the error of the influence coefficients.
pub(super) fn estimate(fine: f64, coarse: f64) -> Result<Estimate, InvalidParameter> {
    let value = finite("temperature rise", fine)?;
    Ok(Estimate::new(value, (fine - coarse).abs()).widened(KERNEL_ERROR * value.abs()))
}

/// The wake length λ = 4D/v \[m], at which diffusion length √(4Dt) and distance vt are equal; infinite at rest.
pub(super) fn wake_length(
    grid: &Grid,
    conductor: &HeatConductor,
    velocity: f64,
) -> Result<f64, BemError> {
    not_negative("velocity", velocity)?;
    let diffusivity = conductor.diffusivity();
    let wake_length = 4.0 * diffusivity / velocity;
    let length = grid.shape()[0] as f64 * grid.spacing()[0];
    if length / wake_length > MAX_PECLET_NUMBER {
        return Err(BemError::DiffusivityTooSmall {
            velocity,
            diffusivity,
            least: velocity * length / (4.0 * MAX_PECLET_NUMBER),
        });
    }
    positive("ratio of the edges", grid.spacing()[1] / grid.spacing()[0])?;
    Ok(wake_length)
}
