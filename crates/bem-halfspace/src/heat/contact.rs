//! Temperature of a stationary contact that is heated by its own friction.
//!
//! The shear of the interface heats the contact area, and the material dissipates below and around it, see [`bulk`](super::bulk). The
//! heat of the bulk varies slowly along the surface: it is computed on the surroundings of the contact, with larger elements, and
//! interpolated.
//!
//! Theory: docs/theory/heat.md, "Temperature of a contact".

use numerics::{Estimate, finite, not_negative, positive, whole_part};
use rheology::{Material, ModulusFactors};

use crate::heat::bulk::{BulkHeat, POWER_DEPTH_RULE, Pressed, STRAIN_DEPTH_RULE};
use crate::heat::contact_kind::coarsened;
use crate::heat::depth::{Beside, DEPTH_ERROR, DepthHeat, DepthProfile, FoundProfile};
use crate::heat::depth_below_body::FREE_DEPTH_ERROR;
use crate::heat::operator::HeatOperator;
use crate::heat::rise::{
    TemperatureRise, estimate, hottest_element, sampling_error, wake_length, weighted_mean,
};
use crate::heat::source::SourceDepth;
use crate::heat::{ContactKind, Counterface, HeatConductor};
use crate::parallel::chunks::in_pool;
use crate::transform::fast_length::fast_length;
use crate::{BemError, Grid, PressureField, WaveShift};

/// Resolution of fields below the surface.
#[derive(Clone, Copy)]
struct BulkGrid {
    /// Largest number of elements along the contact, or along a period. The bars contain the error of the elements.
    most_elements: usize,
    /// Ratio of the period on which it is computed to the contact.
    period_over_contact: usize,
}

impl BulkGrid {
    /// Multiple of the edges of the finest elements from which the strain is refined by halves, for a contact of a number of elements. It is 2
    /// for a period, because coarser elements would leave waves out.
    fn coarsest_multiple(self, elements: usize) -> usize {
        let finest = elements.div_ceil(elements.div_ceil(self.most_elements));
        let halvings = match self.period_over_contact {
            1 => 1,
            _ => (finest / FEWEST_STRAIN_ELEMENTS).max(2).ilog2(),
        };
        1 << halvings
    }

    /// Half the elements along the contact.
    const fn coarser(self) -> Self {
        Self {
            most_elements: self.most_elements / 2,
            ..self
        }
    }
}

/// Grid of a body. Measured: with a period of 4 contact lengths instead of 16, the mean temperature under a pressure of Hertz on a
/// standard solid is off by 0.75 % where the power is off by 2.1 %; on a dashpot by 2.2 % and 20 %. With 48 elements a ball on a material
/// of 14 branches takes 1.4 times as long as with 24, and with 96 three times as long.
const OF_BODY: BulkGrid = BulkGrid {
    most_elements: 48,
    period_over_contact: 6,
};
/// Grid of a line contact, whose stress falls with the first power of the distance. Chosen: one row of elements costs little.
const OF_LINE: BulkGrid = BulkGrid {
    most_elements: 256,
    period_over_contact: 64,
};
/// Grid of a period. Chosen: shorter waves dissipate a small part of the power.
const OF_PERIOD: BulkGrid = BulkGrid {
    most_elements: 256,
    period_over_contact: 1,
};
/// Finest grid of the strain below a body. Chosen: the contact of a strongly dissipating material is a crescent, which needs many elements,
/// and with twice as many it would take seconds.
const STRAIN_OF_BODY: BulkGrid = BulkGrid {
    most_elements: 192,
    period_over_contact: 4,
};
/// Smallest number of elements along a contact on which its strain is computed. Chosen: below a sphere it is then known to some per cent.
const FEWEST_STRAIN_ELEMENTS: usize = 16;
/// Number of elements along a body on which the effect of the period on the strain is computed. Measured: under a pressure of Hertz, 12
/// elements change the strain by 1e-4.
const ELEMENTS_OF_PERIODS: usize = 16;
/// Range of the ratio of successive changes by doubled periods. Derived: stresses fall with the square of the distance or its cube.
/// Measured: from 4 to 8 and to 16 contact lengths the strain increases by 2.6 % and by 0.5 % of Hertz, and by 3.2 % and 0.8 % under a
/// crescent.
const CHANGE_RATIOS: [f64; 2] = [4.0, 8.0];
/// Grid of the strain below a period. Chosen: waves of all lengths strain the material equally, so that none are left out.
const STRAIN_OF_PERIOD: BulkGrid = BulkGrid {
    most_elements: usize::MAX,
    period_over_contact: 1,
};
/// Relative error of the temperature by the bulk over that of its power, by waves that the surroundings do not resolve. Measured: see
/// [`OF_BODY`].
const ERROR_OVER_POWER_ERROR: f64 = 0.5;

/// Error of the strain over its change from elements with twice the edges. Derived: 1/(2^(3/2) − 1), for the order 3/2 of a pressure that
/// falls to zero like a root.
const ERROR_OVER_CHANGE: f64 = 0.547;
/// Error of the strain below a body over this change. Measured: 1.05 on 24 elements below a cone, at whose tip the pressure has no limit and the order is the first; a
/// tenth is added. More elements are needed for the order 3/2 where the contact is a crescent.
const ERROR_OVER_CHANGE_OF_BODY: f64 = 1.15;
/// Smallest ratio of successive changes of the strain that a bar uses, because elements may resolve a contact alike by chance. Chosen, as
/// for the area of rough contacts.
const MIN_CHANGE_RATIO: f64 = 0.3;

/// Range of the exponents n with which the temperature by a given power of the shear falls with the contact area, T ∝ A^(−n), without the
/// mean over a period. Derived: T ∝ P/(ka) for the contact radius a and Pe ≪ 1, T ∝ P √(Da/v)/(ka²) for Pe ≫ 1.
const AREA_EXPONENTS: [f64; 2] = [0.5, 0.75];
/// Range of the exponents n with which this temperature falls with the width a of line contacts, T ∝ a^(−n). Derived: the logarithm of
/// the width at Pe ≪ 1, T ∝ 1/√a at Pe ≫ 1.
const WIDTH_EXPONENTS: [f64; 2] = [0.0, 0.5];

/// Largest ratio of the temperatures by the bulk on successive grids that the error of an unresolved layer assumes. Measured: it grows at
/// most in proportion to the number of elements, by ratios of 1.6 to 1.7 from 24 to 192 elements under a ball on a glassy material; larger
/// ratios are those of grids that are too coarse.
const LARGEST_GROWTH: f64 = 2.0;

/// A contact that slides along +x in its stationary state.
#[derive(Debug, Clone, Copy)]
pub struct SlidingContact<'a> {
    /// Pressure in the contact.
    pub pressure: &'a PressureField,
    /// Incompressible material of the half space, at small strains.
    pub material: &'a dyn Material,
    /// Factors of its moduli at the strain amplitude of the contact.
    pub factors: ModulusFactors,
    /// Shift of its times and moduli by the wavelength of the pressure on a period; `None` for the same material under all waves.
    pub wave_shift: Option<&'a WaveShift>,
    /// Velocity v > 0, \[m/s].
    pub velocity: f64,
    /// Power ≥ 0 of the shear of the interface, which is uniform in the contact, \[W]; per length of a line contact, \[W/m].
    pub shear_power: f64,
    /// Contact area A with its error, \[m²], or the width of a line contact, \[m], if it is known better than from the elements in
    /// contact. The temperature by shear is then corrected for the difference, and its bars contain the error of A, to which the power of
    /// the shear is proportional. With `None` the area is that of the elements, without an error.
    pub contact_area: Option<Estimate>,
    /// Power ≥ 0 dissipated in the bulk, \[W] or \[W/m]. It is F_h v with the tangential force F_h of hysteresis.
    pub bulk_power: f64,
}

/// Temperatures on the elements of the pressure field, and their averages.
#[derive(Default)]
struct Solution {
    temperature: Vec<f64>,
    averages: Averages,
    /// The part of the averages by the heat of the bulk.
    by_bulk: Averages,
    /// Number of times that the elements of the bulk have to be halved to resolve the layer that is heated while the contact passes; 0 or
    /// less where they do.
    halvings_to_layer: f64,
    /// Errors of the averages by waves that the grid of the bulk does not resolve, and by the contact area.
    errors: Averages,
    /// Error of the largest temperature because the maximum is between centres of elements.
    sampling_error: f64,
    /// Temperature below the surface of a period that dissipates there.
    by_depth: Option<DepthProfile>,
    /// Error of its mean by the same.
    error_by_depth: f64,
}

/// Averages of the temperature rise of the surface, \[K].
#[derive(Clone, Copy, Default)]
struct Averages {
    largest: f64,
    /// Mean over the contact area.
    mean: f64,
}

impl SlidingContact<'_> {
    /// Temperature rise of the surface, in the stationary state or after the duration of [`ContactKind::Period`].
    ///
    /// The flux of [`flux_weighted_mean`](TemperatureRise::flux_weighted_mean) is that of the interface, which is uniform in the contact. The
    /// temperature of the material that dissipates is that in the depth, [`by_depth`](TemperatureRise::by_depth).
    ///
    /// # Errors
    /// [`BemError::WaveShiftWithoutPeriod`] for a shift by the wavelength unless the contact is a period;
    /// [`BemError::InvalidParameter`] for a velocity that is not positive, a negative power, a contact without pressure, and results that
    /// overflow.
    pub fn temperature(
        &self,
        conductor: &HeatConductor,
        counterface: Counterface,
        kind: ContactKind,
    ) -> Result<TemperatureRise, BemError> {
        positive("velocity", self.velocity)?;
        self.check_wave_shift(kind)?;
        let shear_power = not_negative("power of the shear", self.shear_power)?;
        let bulk_power = not_negative("power of the bulk", self.bulk_power)?;
        let largest = self.pressure.pressure.iter().copied().fold(0.0, f64::max);
        positive("largest pressure", largest)?;
        wake_length(&self.pressure.grid, conductor, self.velocity)?;
        let share = counterface.elastomer_share()?;
        // Solve with elements of twice the edges, too; the difference is the error.
        let is_loaded = |pressure: &f64| if *pressure > 0.0 { 1.0 } else { 0.0 };
        let loaded = PressureField {
            pressure: self.pressure.pressure.iter().map(is_loaded).collect(),
            ..self.pressure.clone()
        };
        let elements = loaded.pressure.iter().sum::<f64>() * kind.area_of_element(&loaded.grid);
        let heated = Heated {
            contact: *self,
            conductor,
            share,
            kind,
            area: AreaCorrection::new(elements, self.contact_area, kind)?,
        };
        // Choose the resolution of the bulk, whose stress and power have a grid of their own.
        let bulk_grid = match kind {
            // Where the interface heats more than the bulk, coarser elements suffice.
            ContactKind::Body if share * shear_power > bulk_power => OF_BODY.coarser(),
            ContactKind::Body => OF_BODY,
            ContactKind::Line => OF_LINE,
            ContactKind::Period { .. } => OF_PERIOD,
        };
        let coarse_bulk_grid = bulk_grid.coarser();
        let coarse_grid = kind.coarse_grid(&self.pressure.grid, 2)?;
        let [half, half_loaded] =
            [self.pressure, &loaded].map(|field| coarsened(field, &coarse_grid));
        let [fine, coarse] = in_pool(self.pressure.grid.n_elements(), || {
            [
                heated.on(self.pressure, &loaded.pressure, bulk_grid),
                heated.on(&half, &half_loaded.pressure, coarse_bulk_grid),
            ]
        });
        let [fine, coarse] = [fine?, coarse?];
        // Widen the difference of both grids by the errors that it does not show.
        let known = |of: fn(&Averages) -> f64| {
            let rise = estimate(of(&fine.averages), of(&coarse.averages))?;
            let unresolved = layer_error(
                of(&fine.by_bulk),
                of(&coarse.by_bulk),
                fine.halvings_to_layer,
            );
            Ok::<_, BemError>(rise.widened(of(&fine.errors) + unresolved))
        };
        // The mean over the depth also has the error of the quadrature over ln z.
        let by_depth = match (fine.by_depth, coarse.by_depth) {
            (Some(fine_profile), Some(coarse)) => {
                let mean = estimate(fine_profile.mean().value, coarse.mean().value)?;
                let of_rule = match kind {
                    ContactKind::Period { .. } => DEPTH_ERROR,
                    ContactKind::Body | ContactKind::Line => FREE_DEPTH_ERROR,
                };
                let error = fine.error_by_depth + of_rule * mean.value.abs();
                Some(fine_profile.with_mean(mean.widened(error)))
            }
            _ => None,
        };
        Ok(TemperatureRise {
            grid: self.pressure.grid,
            temperature: fine.temperature,
            largest: known(|rise| rise.largest)?.widened(fine.sampling_error),
            mean: known(|rise| rise.mean)?,
            flux_weighted_mean: known(|rise| rise.mean)?,
            by_depth,
            total_power: finite("total power", shear_power + bulk_power)?,
            absorbed_power: share * shear_power + bulk_power,
        })
    }
}

/// Error of a temperature by the bulk beyond its difference from that on elements with twice the edges, \[K], if the elements have to be
/// halved `halvings` times to resolve the layer that is heated while the contact passes.
///
/// Only heat of this layer reaches the surface of a fast contact, and short waves dissipate there. As long as the elements are larger, the
/// temperature grows with each halving, by a ratio that falls: the last ratio bounds those to come.
fn layer_error(fine: f64, coarse: f64, halvings: f64) -> f64 {
    let ratio = (fine / coarse).min(LARGEST_GROWTH);
    if halvings > 0.0 && ratio > 1.0 {
        let growth = fine * (ratio.powf(halvings) - 1.0);
        (growth - (fine - coarse)).max(0.0)
    } else {
        0.0
    }
}

impl SlidingContact<'_> {
    /// Amplitude of the equivalent (von Mises) strain: its root mean square over the half space, weighted with the power that is dissipated
    /// at each place.
    ///
    /// Under one wave in full contact it is half of the root mean square slope of the surface. The pressure of a body or a line is averaged over
    /// larger elements, as long as the amplitude changes by at most `relative_error` where they are halved; with 0 they are the finest. The
    /// error bar is about this change below a body, and half of it otherwise. Around a body it also has what larger periods may add; on periods,
    /// half of the relative difference between the power of the waves and [`bulk_power`](Self::bulk_power).
    ///
    /// # Errors
    /// [`BemError::WaveShiftWithoutPeriod`] as for [`temperature`](Self::temperature); [`BemError::InvalidParameter`] for a velocity that
    /// is not positive, a negative `relative_error`, a contact without pressure, and a material that flows or does not dissipate.
    pub fn strain_amplitude(
        &self,
        kind: ContactKind,
        relative_error: f64,
    ) -> Result<Estimate, BemError> {
        not_negative("relative_error", relative_error)?;
        positive("velocity", self.velocity)?;
        self.check_wave_shift(kind)?;
        positive("power of the bulk", self.bulk_power)?;
        let equilibrium = self.material.relaxation().equilibrium_modulus();
        positive("equilibrium modulus", equilibrium)?;
        let strain_on = |grid: BulkGrid, multiple: usize| -> Result<[f64; 2], BemError> {
            // Scale the pressure by its maximum, because the weighted strain is proportional to its fourth power.
            let mut around = surroundings(self.pressure, kind, grid, multiple)?;
            let largest = around.pressure.iter().copied().fold(0.0, f64::max);
            positive("largest pressure", largest)?;
            around.pressure.iter_mut().for_each(|one| *one /= largest);
            let is_periodic = matches!(kind, ContactKind::Period { .. });
            let bulk = BulkHeat::of(self.pressed(&around, is_periodic), STRAIN_DEPTH_RULE)?;
            let n_elements = around.grid.n_elements() as f64;
            let area = n_elements * kind.area_of_element(&around.grid);
            let [power, weighted] = bulk.power_and_weighted_strain().map(|mean| area * mean);
            // A period dissipates as much as its waves. Around a body the power includes that far behind it, where strains are
            // negligible.
            let amplitude = if is_periodic {
                (weighted / power).sqrt() * largest
            } else {
                weighted.sqrt() * (largest / self.bulk_power.sqrt()) * largest
            };
            Ok([amplitude, power * largest * largest])
        };
        let grid = match kind {
            ContactKind::Body => STRAIN_OF_BODY,
            ContactKind::Line => OF_LINE,
            ContactKind::Period { .. } => STRAIN_OF_PERIOD,
        };
        let (fine, change, power) = in_pool(self.pressure.grid.n_elements(), || {
            let longest = self.pressure.grid.shape().into_iter().max().unwrap_or(1);
            let mut multiple = grid.coarsest_multiple(longest);
            let [mut coarse, _] = strain_on(grid, multiple)?;
            let mut change_before = 0.0;
            loop {
                // Halve the elements until the strain changes little; it may change little by chance once.
                multiple /= 2;
                let [fine, power] = strain_on(grid, multiple)?;
                let change = (coarse - fine).abs().max(MIN_CHANGE_RATIO * change_before);
                if multiple == 1 || change <= relative_error * fine {
                    return Ok::<_, BemError>((fine, change, power));
                }
                (coarse, change_before) = (fine, change);
            }
        })?;
        let error_over_change = match kind {
            ContactKind::Body => ERROR_OVER_CHANGE_OF_BODY,
            ContactKind::Line | ContactKind::Period { .. } => ERROR_OVER_CHANGE,
        };
        let resolved = estimate(fine, fine + error_over_change * change)?;
        match kind {
            ContactKind::Line => Ok(resolved),
            ContactKind::Period { .. } => {
                let unresolved = ERROR_OVER_POWER_ERROR * (power / self.bulk_power - 1.0).abs();
                Ok(resolved.widened(unresolved * fine))
            }
            // The periods around a body strain each other, which does not depend on the elements.
            ContactKind::Body => {
                let on_period = |multiple: usize| {
                    let grid = BulkGrid {
                        most_elements: ELEMENTS_OF_PERIODS,
                        period_over_contact: multiple * STRAIN_OF_BODY.period_over_contact,
                    };
                    strain_on(grid, 1).map(|[strain, _]| strain)
                };
                let [short, long] = [on_period(1)?, on_period(2)?];
                let (mut last, mut remaining) = (long, remaining_change(long - short));
                if remaining.error > relative_error * short {
                    last = on_period(4)?;
                    remaining = remaining_change(last - long);
                }
                let limit = (last + remaining.value) / short;
                Ok((resolved * limit).widened(remaining.error / short * fine))
            }
        }
    }

    /// Refuses a shift by the wavelength of a contact that is not a period.
    const fn check_wave_shift(&self, kind: ContactKind) -> Result<(), BemError> {
        match (self.wave_shift, kind) {
            (None, _) | (_, ContactKind::Period { .. }) => Ok(()),
            (Some(_), ContactKind::Body | ContactKind::Line) => {
                Err(BemError::WaveShiftWithoutPeriod)
            }
        }
    }

    /// The material that passes below a pressure on a period.
    const fn pressed<'a>(&'a self, pressure: &'a PressureField, is_periodic: bool) -> Pressed<'a> {
        Pressed {
            pressure,
            is_periodic,
            material: self.material,
            factors: self.factors,
            wave_shift: self.wave_shift,
            velocity: self.velocity,
        }
    }
}

/// The pressure on the grid on which fields below the surface are computed, with elements of a `multiple` of its edges; around a body on a
/// period in whose middle it is.
fn surroundings(
    pressure: &PressureField,
    kind: ContactKind,
    resolution: BulkGrid,
    multiple: usize,
) -> Result<PressureField, BemError> {
    // Merge elements until the longer side of the grid has no more than the resolution allows.
    let longest = pressure.grid.shape().into_iter().max().unwrap_or(1);
    let factor = longest.div_ceil(resolution.most_elements);
    let coarse_grid = kind.coarse_grid(&pressure.grid, factor * multiple)?;
    let around = coarsened(pressure, &coarse_grid);
    if resolution.period_over_contact == 1 {
        return Ok(around);
    }
    // Put a body or line into the middle of a longer period, of a length with fast transforms.
    let (shape, spacing) = (around.grid.shape(), around.grid.spacing());
    let period = [0, 1].map(|axis| match shape[axis] {
        1 if kind == ContactKind::Line => 1,
        n => fast_length(resolution.period_over_contact * n),
    });
    let grid = Grid::new(period, spacing)?;
    let origin = [0, 1].map(|axis| {
        let before = (period[axis] - shape[axis]) / 2;
        around.origin[axis] - before as f64 * spacing[axis]
    });
    Ok(around.resampled(&grid, origin))
}

/// A contact with the way in which its heat is conducted.
struct Heated<'a> {
    contact: SlidingContact<'a>,
    conductor: &'a HeatConductor,
    /// Share of the elastomer of the heat of the interface.
    share: f64,
    kind: ContactKind,
    area: AreaCorrection,
}

/// Correction of the temperature by shear for the difference between the area of the elements in contact and the contact area.
#[derive(Clone, Copy)]
struct AreaCorrection {
    /// Factor of the temperature, without its mean over a period.
    factor: f64,
    /// Relative error of this factor by the range of the exponents.
    exponent_error: f64,
    /// Relative error of the temperature at a shear strength by that of the contact area, without its mean over a period.
    local_error: f64,
    /// Relative error of the contact area, and of the mean temperature of a period, which is proportional to the power.
    area_error: f64,
}

impl AreaCorrection {
    /// The correction for the area of the `elements` in contact, \[m²], or their width, \[m].
    fn new(
        elements: f64,
        contact_area: Option<Estimate>,
        kind: ContactKind,
    ) -> Result<Self, BemError> {
        let area = contact_area.unwrap_or(Estimate::exact(elements));
        positive("contact area", area.value)?;
        let [slow, fast] = match kind {
            ContactKind::Line => WIDTH_EXPONENTS,
            ContactKind::Body | ContactKind::Period { .. } => AREA_EXPONENTS,
        };
        let log_ratio = (elements / area.value).ln();
        let area_error = area.relative_error();
        Ok(Self {
            factor: (0.5 * (slow + fast) * log_ratio).exp(),
            exponent_error: 0.5 * (fast - slow) * log_ratio.abs(),
            // T ∝ P A^(−n), with the power P ∝ A.
            local_error: (1.0 - slow) * area_error,
            area_error,
        })
    }

    /// Error of a temperature by shear that is not corrected, without its mean over a period, \[K].
    fn error_without_correction(&self, temperature: f64) -> f64 {
        self.error(temperature, 0.0) + (self.factor - 1.0).abs() * temperature.abs()
    }

    /// Error of a temperature by shear, of which `mean` is the part of its mean over a period, \[K].
    fn error(&self, temperature: f64, mean: f64) -> f64 {
        let local_error = self.local_error + self.exponent_error;
        local_error * (temperature - mean).abs() + self.area_error * mean.abs()
    }
}

/// Change of the strain by all longer periods from the last change by a doubled one, within the range of [`CHANGE_RATIOS`].
fn remaining_change(last: f64) -> Estimate {
    let [most, least] = CHANGE_RATIOS.map(|ratio| last / (ratio - 1.0));
    Estimate::new(0.5 * (most + least), 0.5 * (most - least).abs())
}

/// A field on a grid around the contact, with the pressure in the middle of it.
struct Surroundings {
    /// The pressure, on the elements of the surroundings.
    pressure: PressureField,
    /// Rise of the temperature by the heat of the bulk, \[K].
    rise: Vec<f64>,
    /// Relative error of the rise by waves that the grid does not resolve.
    relative_error: f64,
    /// Power per volume at each depth, in units of `scale`.
    bulk: BulkHeat,
    /// Power per volume of one unit of `bulk`, \[W/m³].
    scale: f64,
}

impl Heated<'_> {
    /// The temperature for a pressure field, and for the parts of its elements that are in contact, 0 to 1; that by the bulk on `bulk_grid`.
    fn on(
        &self,
        pressure: &PressureField,
        contact: &[f64],
        bulk_grid: BulkGrid,
    ) -> Result<Solution, BemError> {
        let grid = &pressure.grid;
        let area = self.kind.area_of_element(grid);
        // The shear of the interface heats the elements in contact uniformly.
        let shear_flux = self.contact.shear_power / (area * contact.iter().sum::<f64>());
        let flux: Vec<f64> = contact.iter().map(|part| part * shear_flux).collect();
        let absorbed = self.share * self.contact.shear_power;
        let mut by_shear = vec![0.0; grid.n_elements()];
        if absorbed > 0.0 {
            by_shear = self.rise_by_shear(grid, &flux, self.share)?;
        }
        // The bulk heats the surface of its own grid; interpolate from there to the elements.
        let mut by_bulk = vec![0.0; grid.n_elements()];
        let mut around = None;
        let mut halvings_to_layer = 0.0;
        if self.contact.bulk_power > 0.0 {
            let found = self.surroundings(pressure, bulk_grid)?;
            halvings_to_layer = self.halvings_to_layer(grid, &found.pressure.grid);
            for (index, rise) in by_bulk.iter_mut().enumerate() {
                let [row, column] = [index / grid.shape()[1], index % grid.shape()[1]];
                let place = |axis: usize, number: usize| {
                    pressure.origin[axis] + number as f64 * grid.spacing()[axis]
                };
                *rise = found.at([place(0, row), place(1, column)]);
            }
            around = Some(found);
        }
        let temperature: Vec<f64> = (by_shear.iter().zip(&by_bulk))
            .map(|(shear, bulk)| shear + bulk)
            .collect();
        let Some(hottest) = hottest_element(&temperature, contact) else {
            return Ok(Solution {
                temperature,
                ..Solution::default()
            });
        };
        let averages_of = |rises: &[f64]| Averages {
            largest: rises[hottest],
            mean: weighted_mean(rises, contact),
        };
        let averages = averages_of(&temperature);
        // The contact area is an error of the heat of the interface.
        let of_shear = averages_of(&by_shear);
        let mean_by_shear = self.mean_of_period(&by_shear);
        // Waves that are not resolved are an error of the heat of the bulk, and of the places where it is dissipated.
        let relative_error = around.as_ref().map_or(0.0, |found| found.relative_error);
        let of_bulk = averages_of(&by_bulk);
        let error = |bulk: f64, shear: f64| {
            relative_error * bulk.abs() + self.area.error(shear, mean_by_shear)
        };
        let errors = Averages {
            largest: error(of_bulk.largest, of_shear.largest),
            mean: error(of_bulk.mean, of_shear.mean),
        };
        // Find the temperature over the depth by the bulk and the share of the interface.
        let by_depth = match &around {
            Some(around) => {
                let flux = PressureField {
                    pressure: flux.iter().map(|flux| self.share * flux).collect(),
                    ..pressure.clone()
                };
                self.depth_profile(around, flux, averages.mean)?
            }
            None => None,
        };
        let error_by_depth = by_depth.as_ref().map_or(0.0, |found| {
            let mean = found.profile.mean().value;
            match self.kind {
                // The mean over a period is known, and what is dissipated elsewhere is found at other depths.
                ContactKind::Period { .. } => {
                    let from_contact = (mean - averages.mean).abs();
                    errors.mean + relative_error / ERROR_OVER_POWER_ERROR * from_contact
                }
                // The temperature of the depth is not corrected for the contact area.
                ContactKind::Body | ContactKind::Line => {
                    let by_bulk = mean - found.by_interface;
                    relative_error * by_bulk.abs()
                        + self.area.error_without_correction(found.by_interface)
                }
            }
        });
        Ok(Solution {
            averages,
            by_bulk: of_bulk,
            halvings_to_layer,
            errors,
            sampling_error: sampling_error(&temperature, hottest, grid.shape()),
            temperature,
            by_depth: by_depth.map(|found| found.profile),
            error_by_depth,
        })
    }

    /// The temperature below the elements of the bulk by them and by a flux of the interface \[W/m²], with the mean rise `contact` of the
    /// contact area \[K]; `None` if nothing is dissipated there.
    fn depth_profile(
        &self,
        around: &Surroundings,
        flux: PressureField,
        contact: f64,
    ) -> Result<Option<FoundProfile>, BemError> {
        let (grid, origin) = (&around.pressure.grid, around.pressure.origin);
        let diffusivity = self.conductor.diffusivity();
        // Standing waves of a period diffuse over √(4Dt); other contacts are alone on a half space.
        let beside = match self.kind {
            ContactKind::Period { duration } => Beside::Periods {
                mean_length: 2.0 * (diffusivity.sqrt() * duration.sqrt()),
            },
            ContactKind::Body | ContactKind::Line => Beside::HalfSpace {
                contact_length: flux.grid.shape()[0] as f64 * flux.grid.spacing()[0],
                is_line: self.kind == ContactKind::Line,
            },
        };
        let heat = DepthHeat {
            bulk: &around.bulk,
            unit_power: around.scale,
            grid,
            surface_flux: &flux.resampled(grid, origin).pressure,
            velocity_over_diffusivity: self.contact.velocity / diffusivity,
            conductivity: self.conductor.conductivity(),
            beside,
        };
        heat.profile(contact)
    }

    /// Mean of a temperature over a period; 0 for other contacts, which heat the half space around them alone.
    fn mean_of_period(&self, rises: &[f64]) -> f64 {
        match self.kind {
            ContactKind::Period { .. } => rises.iter().sum::<f64>() / rises.len() as f64,
            ContactKind::Body | ContactKind::Line => 0.0,
        }
    }

    /// Temperature rise \[K] on a grid by `share` times the flux of the interface \[W/m²] into its elements, corrected for the contact area.
    fn rise_by_shear(&self, grid: &Grid, flux: &[f64], share: f64) -> Result<Vec<f64>, BemError> {
        let mut rises = self.rise(grid, [(&SourceDepth::Surface, flux)], share)?;
        let mean = self.mean_of_period(&rises);
        for rise in &mut rises {
            *rise = mean + self.area.factor * (*rise - mean);
        }
        Ok(rises)
    }

    /// Temperature rise \[K] on a grid by `share` times the fluxes \[W/m²] at some depths.
    fn rise<'a>(
        &self,
        grid: &Grid,
        fluxes: impl IntoIterator<Item = (&'a SourceDepth, &'a [f64])>,
        share: f64,
    ) -> Result<Vec<f64>, BemError> {
        let operator = HeatOperator::new(grid, self.kind, self.conductor, self.contact.velocity)?;
        let mut rise = vec![0.0; grid.n_elements()];
        for (depth, flux) in fluxes {
            let mut field: Vec<f64> = flux.iter().map(|flux| share * flux).collect();
            operator.add_temperature(depth, &mut field, &mut rise);
        }
        Ok(rise)
    }

    /// Number of times that the elements of `bulk_grid` have to be halved until two of them fit into the layer that heat crosses while the
    /// contact on `grid` passes. On a period it is 0: there the temperature is that of the whole power, which is known.
    fn halvings_to_layer(&self, grid: &Grid, bulk_grid: &Grid) -> f64 {
        if matches!(self.kind, ContactKind::Period { .. }) {
            return 0.0;
        }
        let length = grid.shape()[0] as f64 * grid.spacing()[0];
        let layer = (self.conductor.diffusivity() * (length / self.contact.velocity)).sqrt();
        (2.0 * bulk_grid.spacing()[0] / layer).log2()
    }

    /// The heat of the bulk around a contact.
    fn surroundings(
        &self,
        pressure: &PressureField,
        bulk_grid: BulkGrid,
    ) -> Result<Surroundings, BemError> {
        let mut around = surroundings(pressure, self.kind, bulk_grid, 1)?;
        // Scale the pressure, on whose square the power depends.
        let largest = around.pressure.iter().copied().fold(0.0, f64::max);
        around
            .pressure
            .iter_mut()
            .for_each(|pressure| *pressure /= largest);
        let bulk = BulkHeat::of(self.contact.pressed(&around, true), POWER_DEPTH_RULE)?;
        let planes: Vec<(SourceDepth, Vec<f64>)> = bulk
            .planes()
            .map(|(depth, of_plane)| (SourceDepth::Plane(depth), of_plane))
            .collect();
        let all = planes.iter().flat_map(|(_, of_plane)| of_plane);
        let sum = all.sum::<f64>() * self.kind.area_of_element(&around.grid);
        let resolved = largest * largest * positive("power of the material", sum)?;
        let power_error = (resolved / self.contact.bulk_power - 1.0).abs();
        // Waves that a period does not resolve are short, and dissipate where the others do. Those around a body are long, and dissipate far
        // away.
        let scale = match self.kind {
            ContactKind::Period { .. } => self.contact.bulk_power / sum,
            ContactKind::Body | ContactKind::Line => largest * largest,
        };
        let fluxes = planes.iter().map(|(depth, flux)| (depth, &**flux));
        let rise = self.rise(&around.grid, fluxes, scale)?;
        Ok(Surroundings {
            pressure: around,
            rise,
            relative_error: ERROR_OVER_POWER_ERROR * power_error,
            bulk,
            scale,
        })
    }
}

impl Surroundings {
    /// Rise by the heat of the bulk at a place of the surface \[m], bilinear between the centres of the elements.
    fn at(&self, place: [f64; 2]) -> f64 {
        let (grid, origin) = (&self.pressure.grid, self.pressure.origin);
        let [along, across] = [0, 1].map(|axis| {
            // Element numbers count from a period before the first, so that they are positive.
            let n = grid.shape()[axis];
            let number = (place[axis] - origin[axis]) / grid.spacing()[axis] + n as f64;
            let lower = whole_part(number);
            let fraction = number - lower as f64;
            [(lower % n, 1.0 - fraction), ((lower + 1) % n, fraction)]
        });
        let columns = grid.shape()[1];
        let corners = along.into_iter().flat_map(|(row, part)| {
            across.map(move |(column, other)| (row * columns + column, part * other))
        });
        corners.map(|(index, part)| part * self.rise[index]).sum()
    }
}
