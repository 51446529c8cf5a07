//! The materials among which one is sought: that of a scene with other moduli, or with another shift law.

use std::f64::consts::LN_10;

use measurements::friction::{FreeParameter, FrictionPoint, Prior};
use numerics::least_squares::{ParameterRange, inverse};
use rheology::{
    ArrheniusShift, KELVIN_AT_ZERO_CELSIUS, Material, RheologyError, Shift, ShiftLaw, WlfShift,
};

use super::{Free, FrictionFitError, FrictionPrior};
use crate::files::{Files, ReadFile};
use crate::scene::{Covariance, MaterialTable, Scene, SceneError};
use crate::solve::half_space::{half_space, of_table_in};
use crate::solve::sensitivity::{Number, Numbers};

/// Keys of moduli, which are proportional to a stress.
const STRESSES: [&str; 6] = [
    "modulus",
    "equilibrium_modulus",
    "maxwell_modulus",
    "shear_modulus",
    "viscosity",
    "coefficient",
];
/// Keys of the other parameters of power laws.
const EXPONENT: &str = "exponent";
const TIME: &str = "relaxation_time";
/// Range of a modulus or viscosity about the sum of all of its unit, and of a time about its start.
const MODULI: [f64; 2] = [1e-5, 1e3];
const TIMES: [f64; 2] = [1e-4, 1e4];
/// Ranges of C₁, C₂ \[K] and activation energies [J/mol], which hold those of all polymers.
const C1: [f64; 2] = [0.1, 1e3];
const HIGHEST_C2: f64 = 1e4;
const ENERGIES: [f64; 2] = [1e3, 1e7];
/// Range of exponents, as scenes allow them.
const EXPONENTS: [f64; 2] = [0.01, 0.99];
/// Part of the distance from the lowest temperature to the pole of the WLF law that is left at least.
const FROM_POLE: f64 = 1.01;
/// Relative standard deviation that is added to the covariance of moduli, so that combinations that it holds for exact have a
/// finite weight; friction is hardly ever measured as well.
const LEAST_DEVIATION: f64 = 1e-3;
/// Largest change of a logarithm in one step.
const STEP: f64 = 2.0;

/// A scene whose material has free parameters.
pub(super) struct Family<'a> {
    /// With the material in it, of whatever file it was.
    pub(super) scene: Scene,
    /// Temperature of the material of points without one, \[°C].
    temperature: Option<f64>,
    numbers: Numbers<'a>,
    files: Files<'a>,
    /// Of the moduli of the scene.
    covariance: Option<Covariance>,
    /// The free moduli and other numbers of the material, then those of the law.
    moduli: Vec<Number>,
    shift: Option<Shift>,
    shift_is_free: bool,
}

/// A constant of a shift law.
struct Constant {
    name: &'static str,
    unit: &'static str,
    start: f64,
    bounds: [f64; 2],
}

impl<'a> Family<'a> {
    pub(super) fn new(
        scene: &Scene,
        (folder, read): (&'a std::path::Path, ReadFile),
        free: Free,
    ) -> Result<Self, FrictionFitError> {
        let files = Files::of(scene, folder, read)?;
        let (mut scene, temperature) = with_material(scene, &files)?;
        let covariance = scene.material.covariance().cloned();
        if free != Free::Shift {
            scene.material = scene.material.without_covariance();
        }
        let numbers = Numbers::new(&scene, folder, read)?;
        let moduli = match free {
            Free::Shift => Vec::new(),
            Free::Moduli | Free::Both => free_numbers(&numbers, &scene.material),
        };
        let shift_is_free = free != Free::Moduli;
        let key = scene.material.key();
        let shift = scene.material.shift().cloned();
        if shift_is_free && shift.is_none() {
            let problem = "to find its shift law the material needs one to begin with: shift = { temperature, \
                           temperature_range, law = { wlf = [C1, C2] } or { arrhenius = E } } of a prony series";
            return Err(SceneError::at(key, problem).into());
        }
        if moduli.is_empty() && !shift_is_free {
            let problem =
                "an elastic material has no friction, from which its modulus could be found";
            return Err(SceneError::at(key, problem).into());
        }
        Ok(Self {
            scene,
            temperature,
            numbers,
            files,
            covariance,
            moduli,
            shift,
            shift_is_free,
        })
    }

    /// The parameters with the start of each, as logarithms.
    pub(super) fn parameters(&self, points: &[FrictionPoint]) -> (Vec<FreeParameter>, Vec<f64>) {
        let of_material = self.moduli.iter().map(|number| {
            let [lowest, highest] = self.range(number);
            let parameter = FreeParameter {
                name: number.path().trim_start_matches("material.").to_owned(),
                unit: unit(number),
                range: range([lowest, highest]),
            };
            (parameter, number.value.ln())
        });
        let of_law = self.law(self.furthest_below(points)).into_iter();
        let of_law = of_law.map(|constant| {
            let parameter = FreeParameter {
                name: constant.name.to_owned(),
                unit: constant.unit,
                range: range(constant.bounds),
            };
            (parameter, constant.start.ln())
        });
        of_material.chain(of_law).unzip()
    }

    /// What is known of the logarithms of the parameters before the fit; `start` are those of the scene.
    pub(super) fn prior(&self, known: FrictionPrior, start: &[f64]) -> Option<Prior> {
        let (places, covariance) = match known {
            FrictionPrior::None => return None,
            FrictionPrior::Relative(spread) => self.independent(spread.ln_1p()),
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

    /// Places of the moduli of elements that relax at measured frequencies, and their covariance with this standard deviation.
    fn independent(&self, deviation: f64) -> (Vec<usize>, Vec<f64>) {
        let moduli = self.moduli.iter().enumerate();
        let moduli = moduli.filter(|(_, number)| is_stress(number) && self.is_measured(number));
        let places: Vec<usize> = moduli.map(|(place, _)| place).collect();
        let rank = places.len();
        let entries = (0..rank * rank).map(|at| {
            if at / rank == at % rank {
                deviation * deviation
            } else {
                0.0
            }
        });
        let entries = entries.collect();
        (places, entries)
    }

    /// Places of the moduli in the covariance of the material, and that; `None` if the material has none.
    fn covariance(&self) -> Option<(Vec<usize>, Vec<f64>)> {
        let known = self.covariance.as_ref()?;
        let moduli = self.moduli.iter().enumerate();
        let moduli = moduli.filter_map(|(place, number)| match number.ends() {
            // It comes first in the covariance.
            [_, "equilibrium_modulus"] => Some((place, 0)),
            [_, "modulus"] => Some((place, branch_of(number)? + 1)),
            _ => None,
        });
        let moduli: Vec<(usize, usize)> = moduli.collect();
        let entries = moduli.iter().flat_map(|&(row, from)| {
            moduli.iter().map(move |&(column, to)| {
                let least = if row == column { LEAST_DEVIATION } else { 0.0 };
                known.relative[from][to] + least * least
            })
        });
        let entries = entries.collect();
        Some((moduli.iter().map(|(place, _)| *place).collect(), entries))
    }

    /// What of the prior that is asked for there is: a material without a covariance has none.
    pub(super) fn known(&self, asked: FrictionPrior) -> FrictionPrior {
        let has_covariance = self.covariance.is_some() && !self.moduli.is_empty();
        match asked {
            FrictionPrior::Covariance if !has_covariance => FrictionPrior::None,
            FrictionPrior::Relative(_) if self.moduli.is_empty() => FrictionPrior::None,
            other => other,
        }
    }

    /// How many of the parameters are those of the material itself.
    pub(super) const fn n_of_material(&self) -> usize {
        self.moduli.len()
    }

    /// Whether the parameter is a modulus or a viscosity.
    pub(super) fn is_stress(&self, parameter: usize) -> bool {
        self.moduli.get(parameter).is_some_and(is_stress)
    }

    pub(super) const fn shift_is_free(&self) -> bool {
        self.shift_is_free
    }

    fn range(&self, number: &Number) -> [f64; 2] {
        let [_, key] = number.ends();
        if key == EXPONENT {
            return EXPONENTS;
        }
        if key == TIME {
            return TIMES.map(|factor| factor * number.value);
        }
        let alike = self
            .moduli
            .iter()
            .filter(|other| unit(other) == unit(number));
        let all: f64 = alike.map(|other| other.value).sum();
        MODULI.map(|factor| factor * all)
    }

    /// Whether the element relaxes at frequencies at which the material was measured, which all do where none are named.
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

    /// The constants of the law that is free, which is known down to so far below its temperature, \[K].
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
                constant("C1", "", c1, C1),
                constant("C2", "K", c2, [FROM_POLE * below.max(1.0), HIGHEST_C2]),
            ],
            Some(ShiftLaw::Arrhenius(energy)) => vec![constant("E_a", "J/mol", energy, ENERGIES)],
            None => Vec::new(),
        }
    }

    /// How far the coldest point is below the temperature of the law, \[K].
    fn furthest_below(&self, points: &[FrictionPoint]) -> f64 {
        let reference = self.shift.as_ref().map_or(0.0, |shift| shift.temperature);
        let temperatures = points.iter().filter_map(|point| self.temperature_of(point));
        temperatures.fold(0.0, |most, temperature| most.max(reference - temperature))
    }

    fn temperature_of(&self, point: &FrictionPoint) -> Option<f64> {
        point.temperature.or(self.temperature)
    }

    /// The material at the logarithms of the parameters.
    pub(super) fn material(&self, logs: &[f64]) -> Result<Box<dyn Material>, SceneError> {
        let table = self.table(logs)?;
        Ok(half_space(&table, &self.files)?.material)
    }

    fn table(&self, logs: &[f64]) -> Result<MaterialTable, SceneError> {
        let values = self.moduli.iter().zip(logs);
        let values = values.map(|(number, log)| (number, log.exp()));
        Ok(self.numbers.scene_with_all(values)?.material)
    }

    /// ln a_T of a point, and its derivatives by the logarithms of the constants of the law that is free.
    pub(super) fn shift_of(
        &self,
        point: &FrictionPoint,
        logs: &[f64],
    ) -> Result<(f64, Vec<f64>), RheologyError> {
        let (Some(shift), Some(temperature)) = (&self.shift, self.temperature_of(point)) else {
            return Ok((0.0, vec![0.0; logs.len() - self.moduli.len()]));
        };
        if !self.shift_is_free {
            return Ok((LN_10 * shift.log10_factor(temperature)?, Vec::new()));
        }
        let above = temperature - shift.temperature;
        let kelvin = |celsius: f64| celsius + KELVIN_AT_ZERO_CELSIUS;
        let constants: Vec<f64> = logs[self.moduli.len()..]
            .iter()
            .map(|log| log.exp())
            .collect();
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

    /// The factor of all moduli at a point.
    pub(super) fn modulus_factor_of(&self, point: &FrictionPoint) -> Result<f64, RheologyError> {
        match (&self.shift, self.temperature_of(point)) {
            // The range of a law that is free is that of the points.
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

    /// The table of the material that was found, with its law.
    pub(super) fn found(
        &self,
        logs: &[f64],
        points: &[FrictionPoint],
    ) -> Result<MaterialTable, SceneError> {
        let mut table = self.table(logs)?;
        let constants: Vec<f64> = logs[self.moduli.len()..]
            .iter()
            .map(|log| log.exp())
            .collect();
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

    /// Refuses points whose temperatures mean nothing, and temperatures that are all those of the law, of which that says nothing.
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

fn range(bounds: [f64; 2]) -> ParameterRange {
    ParameterRange {
        bounds: bounds.map(f64::ln),
        largest_step: STEP,
    }
}

fn is_stress(number: &Number) -> bool {
    let [_, key] = number.ends();
    STRESSES.contains(&key)
}

/// The branch whose modulus a number is, counted from 0.
fn branch_of(number: &Number) -> Option<usize> {
    let path = number.path();
    let (_, branch) = path.strip_suffix("].modulus")?.rsplit_once("branches[")?;
    branch.parse().ok()
}

fn unit(number: &Number) -> &'static str {
    match number.ends() {
        [_, "viscosity"] => "Pa s",
        [_, "coefficient"] => "Pa s^a",
        [_, EXPONENT] => "",
        [_, TIME] => "s",
        _ => "Pa",
    }
}

/// The numbers of the material that are free: its moduli and viscosities, and of power laws the exponent and the time.
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

/// The scene with the material that its file holds, and the temperature at which it wants it.
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
    let material = of_table_in(path, files, Ok)?;
    let material = material.with_given(*poisson_ratio, *valid_frequencies)?;
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
