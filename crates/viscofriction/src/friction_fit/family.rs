//! The family of scenes that is fitted: the scene with free moduli, a free shift law, a free shear strength, or several of them.

use std::f64::consts::LN_10;

use measurements::friction::{FreeParameter, FrictionPoint, Prior};
use numerics::least_squares::{ParameterRange, inverse};
use rheology::{
    ArrheniusShift, KELVIN_AT_ZERO_CELSIUS, Material, RheologyError, Shift, ShiftLaw, WlfShift,
};

use super::shear::{Shear, Strength};
use super::{Free, FrictionFitError, FrictionPrior};
use crate::files::{Files, ReadFile};
use crate::scene::{Covariance, EnergyUnit, Interface, MaterialTable, Scene, SceneError};
use crate::solve::half_space::{half_space, read_material_file};
use crate::solve::sensitivity::{Number, Numbers};
use crate::solve::shear::NO_TEMPERATURE;

/// Keys of moduli, viscosities and coefficients, all proportional to a stress.
const STRESSES: [&str; 6] = [
    "modulus",
    "equilibrium_modulus",
    "maxwell_modulus",
    "shear_modulus",
    "viscosity",
    "coefficient",
];
/// Key in the scene of the exponent of a power-law material.
const EXPONENT: &str = "exponent";
/// Key in the scene of the relaxation time of a power-law material.
const TIME: &str = "relaxation_time";
/// Key in the scene of the velocity v_0 of the largest shear strength.
pub(super) const PEAK_VELOCITY: &str = "velocity";
/// Key in the scene of the width w of a bell.
pub(super) const WIDTH: &str = "width";
/// Key in the scene of the activation energy of a bell.
pub(super) const ACTIVATION_ENERGY: &str = "activation_energy";
/// Lower and upper bound of the ratio of a modulus or viscosity to the sum of the start values of all free parameters of the same
/// unit. Chosen. A parameter that the points do not determine runs into a bound, and its interval is left open there.
const MODULUS_BOUNDS: [f64; 2] = [1e-5, 1e3];
/// Lower and upper bound of the ratio of the relaxation time of a power law to its start value. Chosen: four decades either way.
const TIME_BOUNDS: [f64; 2] = [1e-4, 1e4];
/// Lower and upper bound of the constant C₁ of the WLF law. Chosen; C₁ is about 17 for most polymers at the glass transition.
const C1_BOUNDS: [f64; 2] = [0.1, 1e3];
/// Upper bound of the constant C₂ of the WLF law, \[K]. Chosen; C₂ is about 50 K for most polymers at the glass transition.
const MAX_C2: f64 = 1e4;
/// Lower and upper bound of the exponent of a power law: the range that scenes accept.
const EXPONENT_BOUNDS: [f64; 2] = [0.01, 0.99];
/// Lower bound of the ratio of C₂ to the distance \[K] of the coldest point below the reference temperature. Chosen. The WLF law
/// has its pole C₂ below the reference; the pole thus stays 1 % of the distance below that point.
const MIN_C2_OVER_DISTANCE: f64 = 1.01;
/// Relative standard deviation of a modulus whose square is added to each variance of the covariance of the moduli. Chosen, below
/// the accuracy of measured friction. Without it a combination of moduli of zero variance would have infinite weight in the
/// prior.
const MIN_RELATIVE_DEVIATION: f64 = 1e-3;
/// Lower and upper bound of the ratio of the shear strength τ_0 to its start value. Chosen: four decades either way, more than the
/// ratio of the strengths of dry and lubricated contacts.
const STRENGTH_BOUNDS: [f64; 2] = [1e-4, 1e4];
/// Lower and upper bound of the ratio of the velocity v_0 to its start value. Chosen: eight decades either way, more than the
/// speeds of any experiment extend over.
const PEAK_VELOCITY_BOUNDS: [f64; 2] = [1e-8, 1e8];
/// Lower and upper bound of the ratio of the width of a bell, and of its activation energy, to the start value. Chosen.
const SHAPE_BOUNDS: [f64; 2] = [0.03, 30.0];
/// Largest change of the natural logarithm of a parameter in one step of the least squares: the parameter changes by a factor of
/// at most 7.4. Chosen.
const MAX_LOG_STEP: f64 = 2.0;

/// A scene with free parameters, and the map from these to its material and its interface.
pub(super) struct Family<'a> {
    /// The scene with the file of its material resolved.
    pub(super) scene: Scene,
    /// Temperature of points without one of their own, \[°C]; `None` if the scene states none.
    temperature: Option<f64>,
    /// The numbers of the scene by their paths, and the scene with other values of them.
    numbers: Numbers<'a>,
    files: Files<'a>,
    /// Covariance of the moduli of the scene; `None` if the material has none.
    covariance: Option<Covariance>,
    /// The free numbers of the material. The vector of parameters holds their logarithms, then those of the free constants of
    /// the shift law, then those of the free numbers of the interface.
    moduli: Vec<Number>,
    /// The shift law of the material of the scene; `None` if it has none.
    shift: Option<Shift>,
    /// True if the constants of the shift law are parameters of the fit.
    shift_is_free: bool,
    /// The free numbers of the interface.
    strengths: Vec<Number>,
}

/// A free constant of the shift law: name and unit, and start and bounds in this unit.
struct Constant {
    name: &'static str,
    unit: &'static str,
    start: f64,
    bounds: [f64; 2],
}

impl<'a> Family<'a> {
    /// Reads the material of a scene and lists the `free` parameters. Refuses free moduli of an elastic material, which has no
    /// friction, a free shift law of a material without one, and a free shear strength without an interface that has numbers.
    pub(super) fn new(
        scene: &Scene,
        (folder, read): (&'a std::path::Path, ReadFile),
        free: &[Free],
        points: &[FrictionPoint],
    ) -> Result<Self, FrictionFitError> {
        let files = Files::of(scene, folder, read)?;
        let (mut scene, temperature) = with_material(scene, &files)?;
        let covariance = scene.material.covariance().cloned();
        let moduli_are_free = free.contains(&Free::Moduli);
        if moduli_are_free {
            scene.material = scene.material.without_covariance();
        }
        let numbers = Numbers::new(&scene, folder, read)?;
        let moduli = if moduli_are_free {
            free_numbers(&numbers, &scene.material)
        } else {
            Vec::new()
        };
        let shift_is_free = free.contains(&Free::Shift);
        let key = scene.material.key();
        let shift = scene.material.shift().cloned();
        if shift_is_free && shift.is_none() {
            let problem = "to find its shift law the material needs one to begin with: shift = { temperature, \
                           temperature_range, law = { wlf = [C1, C2] } or { arrhenius = E } } of a prony series";
            return Err(SceneError::at(key, problem).into());
        }
        if moduli_are_free && moduli.is_empty() {
            let problem =
                "an elastic material has no friction, from which its modulus could be found";
            return Err(SceneError::at(key, problem).into());
        }
        let mut family = Self {
            scene,
            temperature,
            numbers,
            files,
            covariance,
            moduli,
            shift,
            shift_is_free,
            strengths: Vec::new(),
        };
        if free.contains(&Free::Interface) {
            family.strengths = family.free_strengths(points)?;
        }
        Ok(family)
    }

    /// The numbers of the interface that are sought; the activation energy only from points at several temperatures. Refuses a
    /// scene without an interface, and a table, which has no such numbers.
    fn free_strengths(&self, points: &[FrictionPoint]) -> Result<Vec<Number>, SceneError> {
        let problem = match self.scene.interface {
            Some(Interface::Table { .. }) => Some(
                "a table has no parameters to be found: give interface.bell or interface.constant with values to begin with, or keep \
                 the table and let the moduli be free",
            ),
            None => Some(
                "to find the shear strength the scene needs one to begin with: [interface.constant] or [interface.bell]",
            ),
            Some(_) => None,
        };
        if let Some(problem) = problem {
            return Err(SceneError::at("interface", problem));
        }
        let mut temperatures = points.iter().map(|point| self.contact_temperature(point));
        let first = temperatures.next();
        let has_several = temperatures.any(|other| Some(other) != first);
        let mut sought = self.numbers.all();
        sought.retain(|number| {
            let [table, key] = number.ends();
            table == "interface" && (key != ACTIVATION_ENERGY || has_several)
        });
        Ok(sought)
    }

    /// The free parameters with their bounds, and the logarithms of their start values; the points bound C₂ from below.
    pub(super) fn parameters(&self, points: &[FrictionPoint]) -> (Vec<FreeParameter>, Vec<f64>) {
        let of_material = self.moduli.iter().map(|number| {
            let [lowest, highest] = self.bounds_of(number);
            let parameter = FreeParameter {
                name: number.path.trim_start_matches("material.").to_owned(),
                unit: unit(number),
                range: log_range([lowest, highest]),
            };
            (parameter, number.value.ln())
        });
        let constants = self.law(self.furthest_below(points)).into_iter();
        let of_law = constants.map(|constant| {
            let parameter = FreeParameter {
                name: constant.name.to_owned(),
                unit: constant.unit,
                range: log_range(constant.bounds),
            };
            (parameter, constant.start.ln())
        });
        let of_interface = self.strengths.iter().map(|number| {
            let mut bounds = strength_bounds(number).map(|factor| factor * number.value);
            if let ([_, ACTIVATION_ENERGY], Some(unit)) = (number.ends(), self.energy_unit()) {
                let [lowest, highest] = unit.energy_range();
                bounds = [bounds[0].max(lowest), bounds[1].min(highest)];
            }
            let parameter = FreeParameter {
                name: number.path.clone(),
                unit: self.strength_unit(number),
                range: log_range(bounds),
            };
            (parameter, number.value.ln())
        });
        of_material.chain(of_law).chain(of_interface).unzip()
    }

    /// Gaussian prior of the logarithms of the parameters, with the mean `start`; `None` without prior knowledge, or if its
    /// covariance is singular.
    pub(super) fn prior(&self, known: FrictionPrior, start: &[f64]) -> Option<Prior> {
        let (places, covariance) = match known {
            FrictionPrior::None => return None,
            FrictionPrior::Relative(spread) => self.independent_moduli(spread.ln_1p()),
            FrictionPrior::Covariance => self.covariance()?,
        };
        let (n, rank) = (start.len(), places.len());
        let inverse = inverse(&covariance, rank)?;
        let mut precision = vec![0.0; n * n];
        for (at, entry) in inverse.into_iter().enumerate() {
            precision[places[at / rank] * n + places[at % rank]] = entry;
        }
        Some(Prior {
            mean: start.to_vec(),
            precision,
            rank,
        })
    }

    /// Indices of the moduli of elements that relax at measured frequencies, and their covariance matrix, row by row:
    /// `deviation` squared on the diagonal, 0 elsewhere.
    fn independent_moduli(&self, deviation: f64) -> (Vec<usize>, Vec<f64>) {
        let moduli = self.moduli.iter().enumerate();
        let measured = moduli.filter(|(_, number)| is_stress(number) && self.is_measured(number));
        let places: Vec<usize> = measured.map(|(place, _)| place).collect();
        let rank = places.len();
        let entries = (0..rank * rank).map(|at| {
            if at / rank == at % rank {
                deviation * deviation
            } else {
                0.0
            }
        });
        (places, entries.collect())
    }

    /// Indices of the free moduli, and their relative covariance matrix in the material, row by row, with the square of
    /// [`MIN_RELATIVE_DEVIATION`] added on the diagonal. `None` if the material has no covariance.
    fn covariance(&self) -> Option<(Vec<usize>, Vec<f64>)> {
        let known = self.covariance.as_ref()?;
        let place_and_row = |(place, number): (usize, &Number)| match number.ends() {
            // In the covariance matrix the equilibrium modulus has the first row, and the moduli of the branches follow.
            [_, "equilibrium_modulus"] => Some((place, 0)),
            [_, "modulus"] => Some((place, branch_of(number)? + 1)),
            _ => None,
        };
        let moduli: Vec<(usize, usize)> = self
            .moduli
            .iter()
            .enumerate()
            .filter_map(place_and_row)
            .collect();
        let entries = moduli.iter().flat_map(|&(row, from)| {
            moduli.iter().map(move |&(column, to)| {
                let least = if row == column {
                    MIN_RELATIVE_DEVIATION
                } else {
                    0.0
                };
                known.relative[from][to] + least * least
            })
        });
        let places = moduli.iter().map(|(place, _)| *place);
        Some((places.collect(), entries.collect()))
    }

    /// The prior that can be applied: that asked for, or [`FrictionPrior::None`] if it needs a covariance that the material
    /// does not have, or if no modulus is free.
    pub(super) fn known(&self, asked: FrictionPrior) -> FrictionPrior {
        let has_covariance = self.covariance.is_some() && !self.moduli.is_empty();
        match asked {
            FrictionPrior::Covariance if !has_covariance => FrictionPrior::None,
            FrictionPrior::Relative(_) if self.moduli.is_empty() => FrictionPrior::None,
            other => other,
        }
    }

    /// Number of free parameters of the material, without those of the shift law.
    pub(super) const fn n_of_material(&self) -> usize {
        self.moduli.len()
    }

    /// Unit of a number of the interface in the scene.
    fn strength_unit(&self, number: &Number) -> &'static str {
        let [_, key] = number.ends();
        match key {
            ACTIVATION_ENERGY => self.energy_unit().unwrap_or_default().name(),
            PEAK_VELOCITY => "m/s",
            WIDTH => "decades",
            _ => "Pa",
        }
    }

    /// Unit of the activation energy of the interface; `None` if it has none.
    fn energy_unit(&self) -> Option<EnergyUnit> {
        self.scene.interface.as_ref()?.energy_unit()
    }

    /// True if the first search multiplies the start value of a parameter by powers of ten: of all moduli; if none is free, of the
    /// constants of the shift law; if these are not free either, of the velocity of the largest shear strength.
    pub(super) fn is_scaled_at_start(&self, parameter: usize) -> bool {
        if self.is_material_fixed() {
            let [_, key] = self.strengths[parameter].ends();
            return key == PEAK_VELOCITY;
        }
        match self.moduli.get(parameter) {
            Some(number) => is_stress(number),
            None => self.moduli.is_empty() && parameter < self.law(0.0).len(),
        }
    }

    /// True if neither moduli nor the shift law are free, so that the contacts of the points do not depend on the parameters.
    pub(super) const fn is_material_fixed(&self) -> bool {
        self.moduli.is_empty() && !self.shift_is_free
    }

    /// True if shear adds to the friction.
    pub(super) const fn has_shear(&self) -> bool {
        self.scene.interface.is_some()
    }

    /// Part of the logarithms of the parameters: the constants of the shift law.
    fn constants<'l>(&self, logs: &'l [f64]) -> &'l [f64] {
        &logs[self.moduli.len()..logs.len() - self.strengths.len()]
    }

    /// True if the constants of the shift law are free.
    pub(super) const fn shift_is_free(&self) -> bool {
        self.shift_is_free
    }

    /// Lower and upper bound of a free number of the material, in its unit.
    fn bounds_of(&self, number: &Number) -> [f64; 2] {
        let [_, key] = number.ends();
        if key == EXPONENT {
            return EXPONENT_BOUNDS;
        }
        if key == TIME {
            return TIME_BOUNDS.map(|factor| factor * number.value);
        }
        let alike = self
            .moduli
            .iter()
            .filter(|other| unit(other) == unit(number));
        let all: f64 = alike.map(|other| other.value).sum();
        MODULUS_BOUNDS.map(|factor| factor * all)
    }

    /// True if 1/τ of the branch of a modulus is within the valid frequencies of the material. Of a Prony series with such
    /// frequencies, the equilibrium modulus counts as not measured. True for every number of other materials.
    fn is_measured(&self, number: &Number) -> bool {
        let Some([lowest, highest]) = self.scene.material.valid_frequencies() else {
            return true;
        };
        let MaterialTable::Prony { branches, .. } = &self.scene.material else {
            return true;
        };
        let own = branch_of(number).and_then(|branch| branches.get(branch));
        own.is_some_and(|branch| (lowest..=highest).contains(&branch.relaxation_time.recip()))
    }

    /// The constants of the shift law, empty if it is not free. It must hold down to `below` \[K] under its reference
    /// temperature.
    fn law(&self, below: f64) -> Vec<Constant> {
        let constant = |name, unit, start, bounds| Constant {
            name,
            unit,
            start,
            bounds,
        };
        let law = self.shift.as_ref().filter(|_| self.shift_is_free);
        match law.map(|shift| shift.law) {
            Some(ShiftLaw::Wlf([c1, c2])) => vec![
                constant("C1", "", c1, C1_BOUNDS),
                constant(
                    "C2",
                    "K",
                    c2,
                    [MIN_C2_OVER_DISTANCE * below.max(1.0), MAX_C2],
                ),
            ],
            Some(ShiftLaw::Arrhenius(energy)) => {
                let bounds = EnergyUnit::JoulePerMole.energy_range();
                vec![constant("E_a", "J/mol", energy, bounds)]
            }
            None => Vec::new(),
        }
    }

    /// Distance of the coldest point below the reference temperature of the law, \[K]; at least 0.
    fn furthest_below(&self, points: &[FrictionPoint]) -> f64 {
        let reference = self.shift.as_ref().map_or(0.0, |shift| shift.temperature);
        let temperatures = points.iter().filter_map(|point| self.temperature_of(point));
        temperatures.fold(0.0, |most, temperature| most.max(reference - temperature))
    }

    /// Temperature of the contact at a point, \[°C]: its own, that of the scene, or the reference temperature of the material.
    /// `None` if there is none of them.
    fn contact_temperature(&self, point: &FrictionPoint) -> Option<f64> {
        let reference = self.shift.as_ref().map(|shift| shift.temperature);
        self.temperature_of(point).or(reference)
    }

    /// Temperature of a point, \[°C]; that of the scene if the point has none, `None` if the scene has none either.
    fn temperature_of(&self, point: &FrictionPoint) -> Option<f64> {
        point.temperature.or(self.temperature)
    }

    /// The material at its reference temperature, for given logarithms of the parameters.
    pub(super) fn material(&self, logs: &[f64]) -> Result<Box<dyn Material>, SceneError> {
        let table = self.table(logs)?;
        Ok(half_space(&table, &self.files)?.material)
    }

    /// The material table for given logarithms of the parameters.
    fn table(&self, logs: &[f64]) -> Result<MaterialTable, SceneError> {
        Ok(self.scene_with(&self.moduli, logs)?.material)
    }

    /// The interface for given logarithms of the parameters; `None` if the scene has none.
    pub(super) fn interface(&self, logs: &[f64]) -> Result<Option<Interface>, SceneError> {
        if self.strengths.is_empty() {
            return Ok(self.scene.interface.clone());
        }
        let own = &logs[logs.len() - self.strengths.len()..];
        Ok(self.scene_with(&self.strengths, own)?.interface)
    }

    /// The scene with other values of some numbers, given by their logarithms.
    fn scene_with(&self, numbers: &[Number], logs: &[f64]) -> Result<Scene, SceneError> {
        let values = numbers.iter().zip(logs.iter().map(|log| log.exp()));
        self.numbers.scene_with_all(values)
    }

    /// The shear strengths at the points, \[Pa]; 0 without an interface. An error at a point without the temperature that the
    /// strength depends on.
    pub(super) fn strengths(
        &self,
        points: &[FrictionPoint],
        logs: &[f64],
    ) -> Result<Vec<Strength>, SceneError> {
        let Some(interface) = self.interface(logs)? else {
            return Ok(points.iter().map(|_| Strength::default()).collect());
        };
        let shear = Shear::new(interface, &self.strengths, &self.files)?;
        let of_point = |point: &FrictionPoint| match self.contact_temperature(point) {
            None if shear.depends_on_temperature() => {
                Err(SceneError::at("interface", NO_TEMPERATURE))
            }
            temperature => shear.at(point.velocity, temperature),
        };
        points.iter().map(of_point).collect()
    }

    /// ln a_T at the temperature of a point, and its derivatives by the logarithms of the free constants of the law: with ln
    /// a_T = −C₁ ln 10 (T − T_r)/(C₂ + T − T_r) these are ln a_T and −ln a_T C₂/(C₂ + T − T_r). For the law of Arrhenius,
    /// proportional to its energy, it is ln a_T. Both are 0 without a temperature.
    pub(super) fn shift_of(
        &self,
        point: &FrictionPoint,
        logs: &[f64],
    ) -> Result<(f64, Vec<f64>), RheologyError> {
        let (Some(shift), Some(temperature)) = (&self.shift, self.temperature_of(point)) else {
            return Ok((0.0, vec![0.0; self.constants(logs).len()]));
        };
        if !self.shift_is_free {
            return Ok((LN_10 * shift.log10_factor(temperature)?, Vec::new()));
        }
        let above = temperature - shift.temperature;
        let kelvin = |celsius: f64| celsius + KELVIN_AT_ZERO_CELSIUS;
        let constants: Vec<f64> = self.constants(logs).iter().map(|log| log.exp()).collect();
        match constants[..] {
            [c1, c2] => {
                let law = WlfShift::new(c1, c2, shift.temperature)?;
                let log = LN_10 * law.log10_factor(temperature)?;
                Ok((log, vec![log, -log * c2 / (c2 + above)]))
            }
            [energy] => {
                let law = ArrheniusShift::new(energy, kelvin(shift.temperature))?;
                let log = LN_10 * law.log10_factor(kelvin(temperature))?;
                Ok((log, vec![log]))
            }
            _ => Ok((0.0, Vec::new())),
        }
    }

    /// Factor b_T on all moduli at the temperature of a point, relative to the reference temperature; 1 without a shift law or
    /// temperature.
    pub(super) fn modulus_factor_of(&self, point: &FrictionPoint) -> Result<f64, RheologyError> {
        match (&self.shift, self.temperature_of(point)) {
            // A shift law that is fitted is valid at the temperatures of the measured points too, so the range is extended to
            // them.
            (Some(shift), Some(temperature)) if self.shift_is_free => {
                let [low, high] = shift.temperature_range;
                let temperature_range = [low.min(temperature), high.max(temperature)];
                let shift = Shift {
                    temperature_range,
                    ..shift.clone()
                };
                shift.modulus_factor(temperature)
            }
            (Some(shift), Some(temperature)) => shift.modulus_factor(temperature),
            _ => Ok(1.0),
        }
    }

    /// The material table for given logarithms of the parameters. A free shift law gets the fitted constants, and is valid from
    /// the lowest to the highest temperature of the points, its reference included.
    pub(super) fn fitted_table(
        &self,
        logs: &[f64],
        points: &[FrictionPoint],
    ) -> Result<MaterialTable, SceneError> {
        let mut table = self.table(logs)?;
        let constants: Vec<f64> = self.constants(logs).iter().map(|log| log.exp()).collect();
        if let (
            MaterialTable::Prony {
                shift: Some(shift), ..
            },
            true,
        ) = (&mut table, self.shift_is_free)
        {
            shift.law = match constants[..] {
                [c1, c2] => ShiftLaw::Wlf([c1, c2]),
                [energy] => ShiftLaw::Arrhenius(energy),
                _ => shift.law,
            };
            let temperatures = points.iter().filter_map(|point| self.temperature_of(point));
            let start = [shift.temperature; 2];
            shift.temperature_range = temperatures.fold(start, |[low, high], temperature| {
                [low.min(temperature), high.max(temperature)]
            });
        }
        Ok(table)
    }

    /// Rejects temperatures without a shift law, and a free shift law without a point at another than the reference temperature.
    pub(super) fn check_temperatures(
        &self,
        points: &[FrictionPoint],
    ) -> Result<(), FrictionFitError> {
        let warm = points
            .iter()
            .filter(|point| point.temperature.is_some())
            .count();
        if warm > 0 && self.shift.is_none() {
            let problem = "the points have temperatures, and the material has no shift law for them; leave out the \
                           temperatures, or give the material a shift";
            return Err(SceneError::at(self.scene.material.key(), problem).into());
        }
        let mut others = points.iter().filter_map(|point| self.temperature_of(point));
        let reference = self
            .shift
            .as_ref()
            .map_or(f64::NAN, |shift| shift.temperature);
        let says = others.any(|temperature| (temperature - reference).abs() > 0.0);
        if self.shift_is_free && !says {
            let problem = "a shift law is found from points at other temperatures than that of the material, and there are none";
            return Err(
                SceneError::at(format!("{}.shift", self.scene.material.key()), problem).into(),
            );
        }
        Ok(())
    }
}

/// The bounds of a parameter as logarithms, with the largest step of a logarithm.
fn log_range(bounds: [f64; 2]) -> ParameterRange {
    ParameterRange {
        bounds: bounds.map(f64::ln),
        largest_step: MAX_LOG_STEP,
    }
}

/// True if a number is proportional to a stress.
fn is_stress(number: &Number) -> bool {
    let [_, key] = number.ends();
    STRESSES.contains(&key)
}

/// Index of the branch whose modulus a number is; `None` for other numbers.
fn branch_of(number: &Number) -> Option<usize> {
    let path = &number.path;
    let (_, branch) = path.strip_suffix("].modulus")?.rsplit_once("branches[")?;
    branch.parse().ok()
}

/// Lower and upper bound of the ratio of a number of the interface to its start value.
fn strength_bounds(number: &Number) -> [f64; 2] {
    match number.ends() {
        [_, "shear_strength"] => STRENGTH_BOUNDS,
        [_, PEAK_VELOCITY] => PEAK_VELOCITY_BOUNDS,
        _ => SHAPE_BOUNDS,
    }
}

/// Unit of a number of the material; empty for an exponent.
fn unit(number: &Number) -> &'static str {
    match number.ends() {
        [_, "viscosity"] => "Pa s",
        [_, "coefficient"] => "Pa s^a",
        [_, EXPONENT] => "",
        [_, TIME] => "s",
        _ => "Pa",
    }
}

/// The free numbers of a material: moduli and viscosities, for power laws also exponent and relaxation time. None for an
/// elastic material, which has no friction at any modulus.
fn free_numbers(numbers: &Numbers, material: &MaterialTable) -> Vec<Number> {
    let is_power_law = matches!(
        material,
        MaterialTable::Springpot { .. } | MaterialTable::FractionalMaxwell { .. }
    );
    if matches!(material, MaterialTable::Elastic { .. }) {
        return Vec::new();
    }
    let mut free = numbers.all();
    free.retain(|number| {
        let [table, key] = number.ends();
        let is_law = is_power_law && (key == EXPONENT || key == TIME);
        table == "material" && (STRESSES.contains(&key) || is_law)
    });
    free
}

/// The scene with the file of its material resolved at its reference temperature, and the temperature \[°C] that the scene states.
fn with_material(scene: &Scene, files: &Files<'_>) -> Result<(Scene, Option<f64>), SceneError> {
    let MaterialTable::File {
        path,
        temperature,
        poisson_ratio,
        valid_frequencies,
    } = &scene.material
    else {
        return Ok((scene.clone(), None));
    };
    let material =
        read_material_file(path, files, Ok)?.with_given(*poisson_ratio, *valid_frequencies)?;
    if let (Some(_), None) = (temperature, material.shift()) {
        let problem = "the file has no shift law, as fit-material writes it for isotherms of several temperatures";
        return Err(SceneError::at("material.file.temperature", problem));
    }
    let scene = Scene {
        material,
        ..scene.clone()
    };
    Ok((scene, *temperature))
}
