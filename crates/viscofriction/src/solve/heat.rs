//! Temperature to which a stationary contact is heated by the friction that it has.
//!
//! The shear of the interface heats the contact area uniformly with τ_f v, and the bulk is heated where its material dissipates. Together
//! both are F_t v.
//!
//! Theory: docs/theory/heat.md.

use bem_halfspace::heat::{ContactKind, Counterface, HeatConductor, SlidingContact};
use bem_halfspace::{Grid, PressureField};
use numerics::{Estimate, in_range};
use rheology::KELVIN_AT_ZERO_CELSIUS;

use super::answer::Answer;
use super::body::Body;
use super::error::{Result, SolveError};
use super::half_space::HalfSpace;
use super::problem::{Motion, Problem};
use crate::scene::{MaterialTable, Model, Scene, SceneError};

/// Heat of sliding of a scene.
#[derive(Debug, Clone)]
pub(crate) struct Heating {
    /// The elastomer as a conductor of heat.
    conductor: HeatConductor,
    /// What the body does with the heat of the interface.
    counterface: Counterface,
    /// Temperature far from the contact, \[°C]; `None` if neither the scene nor the material states one.
    pub(super) ambient: Option<f64>,
    /// Time for which a periodic surface has been sliding, \[s]; `None` for other bodies.
    duration: Option<f64>,
}

/// Rise of the surface temperature above that far from the contact, at the centres of the elements of a grid.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct TemperatureField {
    /// The grid of the field.
    pub grid: Grid,
    /// Centre of the first element relative to the lowest point of the body, \[m].
    pub origin: [f64; 2],
    /// Temperature rise, \[K], row-major with y fastest; ahead of a fast contact it is zero within its error.
    pub rise: Vec<f64>,
}

impl Heating {
    /// The heat of a scene, checked against the temperature of its material; `None` if the scene has none.
    pub(super) fn of(scene: &Scene, half_space: &HalfSpace) -> Result<Option<Self>, SceneError> {
        let Some(table) = &scene.heat else {
            return Ok(None);
        };
        table.check()?;
        let of_file = match &scene.material {
            MaterialTable::File { temperature, .. } => *temperature,
            _ => None,
        };
        if let (Some(ambient), Some(of_file)) = (table.ambient_temperature, of_file)
            && ambient.total_cmp(&of_file).is_ne()
        {
            let problem = format!(
                "it is {ambient} °C, and material.file.temperature is {of_file} °C; the material has the temperature of its surroundings, so \
                 leave one of them out"
            );
            return Err(SceneError::at("heat.ambient_temperature", problem));
        }
        let ambient = table.ambient_temperature;
        if let Some(celsius) = ambient {
            let holds = celsius.is_finite() && celsius > -KELVIN_AT_ZERO_CELSIUS;
            let allowed = "finite and above absolute zero, -273.15 °C";
            in_range("heat.ambient_temperature", celsius, holds, allowed)?;
        }
        Ok(Some(Self {
            conductor: table.conductor()?,
            counterface: table.counterface.into(),
            ambient: ambient.or_else(|| half_space.temperature()),
            duration: table.duration,
        }))
    }
}

impl Problem {
    /// Rejects heat where the temperature is not computed: without stationary sliding, on a layer or a track, in the one-dimensional
    /// model, and on a periodic surface without the time for which it has been sliding.
    pub(super) fn check_heat(&self) -> Result<(), SceneError> {
        let Some(heating) = self.heating() else {
            return Ok(());
        };
        let refused = |key: &str, problem: &str| Err(SceneError::at(key, problem));
        let Motion::Sliding(load) = self.motion() else {
            return refused(
                "heat",
                "the temperature is that of a body that slides at a constant load.velocity, and this one does not; leave it out",
            );
        };
        if self.model() == Model::Line {
            return refused(
                "heat",
                "the scene asks for the one-dimensional model, which does not know the pressure in the contact that heats it; boundary \
                 elements do",
            );
        }
        if load.sliding_distance().is_some() {
            return refused(
                "heat",
                "the temperature is that of the stationary state; leave out solve.duration and solve.sliding_distance",
            );
        }
        if load.track().is_some() {
            return refused(
                "heat",
                "the heat of earlier passes over the same place is not computed; leave load.track out",
            );
        }
        if self.thickness().is_finite() {
            return refused(
                "heat",
                "the flow of heat from a layer into its base is not computed; leave the layer out",
            );
        }
        if self.material().poisson_ratio() < 0.5 {
            return refused(
                "heat",
                "where the power is dissipated below the surface is known for an incompressible material; give poisson_ratio = 0.5",
            );
        }
        if let (Body::Periodic(surface), Some(duration)) = (self.body(), heating.duration) {
            let period = surface.period()[0];
            let distance = load.velocity() * duration;
            if distance < period {
                let problem = format!(
                    "in {duration:e} s the surface slides over {distance:.3e} m, less than its period of {period:e} m, and its temperature is not \
                     yet stationary; give at least {:.3e} s",
                    period / load.velocity()
                );
                return refused("heat.duration", &problem);
            }
        }
        match (self.body(), heating.duration) {
            (Body::Periodic(_), None) => refused(
                "heat",
                "the mean temperature of a periodic surface grows as long as it slides: give the time for which it has been sliding, \
                 duration [s]",
            ),
            (Body::Periodic(_), Some(_)) | (_, None) => Ok(()),
            (_, Some(_)) => refused(
                "heat.duration",
                "the temperature under a body that ends, and under a cylinder, is stationary; leave it out",
            ),
        }
    }

    /// Adds the temperature to which the friction of an answer heats the contact.
    pub(super) fn with_temperature_rise(&self, answer: Answer) -> Result<Answer> {
        let (Some(heating), Motion::Sliding(load)) = (self.heating(), self.motion()) else {
            return Ok(answer);
        };
        let velocity = load.velocity();
        let Some(pressure) = pressure_field(&answer)? else {
            let method = answer.method;
            return Err(SolveError::NoPressureForHeat { method });
        };
        let power_of = |friction: Option<Estimate>| {
            friction.unwrap_or(Estimate::exact(0.0)) * (answer.normal_force.value * velocity)
        };
        let [shear, bulk] = [answer.friction_from_shear, answer.hysteresis()].map(power_of);
        let area = AreaOfElements::of(&pressure, &answer);
        let contact = SlidingContact {
            pressure: &pressure,
            material: self.material(),
            velocity,
            shear_power: shear.value * area.correction,
            bulk_power: bulk.value,
        };
        let kind = match self.body() {
            Body::Periodic(_) => ContactKind::Period {
                duration: heating.duration.unwrap_or_default(),
            },
            Body::Cylinder(_) => ContactKind::Line,
            Body::Revolution(_) | Body::HeightMap(_) => ContactKind::Body,
        };
        let found = contact.temperature(&heating.conductor, heating.counterface, kind);
        let found = found.map_err(|error| SceneError::at("heat", error.to_string()))?;
        // The temperature is proportional to the dissipated power.
        let power = shear + bulk;
        let relative_error = if power.value > 0.0 {
            power.error / power.value + area.relative_error
        } else {
            0.0
        };
        let widened = |rise: Estimate| rise.widened(relative_error * rise.value.abs());
        let mut answer = Answer {
            largest_temperature_rise: Some(widened(found.largest)),
            mean_temperature_rise: Some(widened(found.mean)),
            dissipation_weighted_rise: Some(widened(found.flux_weighted_mean)),
            ..answer
        };
        answer.fields.temperature = Some(TemperatureField {
            grid: found.grid,
            origin: pressure.origin,
            rise: found.temperature,
        });
        Ok(answer)
    }
}

/// Range of the exponents n with which the temperature by a given power of the shear falls with the contact area, T ∝ A^(−n): of slow
/// and of fast contacts of bodies. Derived: T ∝ P/(ka) for the contact radius a and Pe ≪ 1, T ∝ P √(Da/v)/(ka²) for Pe ≫ 1.
const AREA_EXPONENTS: [f64; 2] = [0.5, 0.75];
/// The same for the width of line contacts. Derived: the logarithm of the width at Pe ≪ 1, T ∝ 1/√a at Pe ≫ 1.
const WIDTH_EXPONENTS: [f64; 2] = [0.0, 0.5];

/// Correction of a temperature by shear for the difference between the area of the elements in contact and the contact area.
struct AreaOfElements {
    /// Factor on the temperature.
    correction: f64,
    /// Relative error of the corrected temperature by that of the area and of the exponent.
    relative_error: f64,
}

impl AreaOfElements {
    fn of(pressure: &PressureField, answer: &Answer) -> Self {
        let Some(area) = answer.contact_area.filter(|area| area.value > 0.0) else {
            return Self {
                correction: 1.0,
                relative_error: 0.0,
            };
        };
        let loaded = pressure.pressure.iter().filter(|pressure| **pressure > 0.0);
        let (area_of_element, [slow, fast]) = if answer.is_per_length {
            (pressure.grid.spacing()[0], WIDTH_EXPONENTS)
        } else {
            (pressure.grid.element_area(), AREA_EXPONENTS)
        };
        let ratio = loaded.count() as f64 * area_of_element / area.value;
        let [mean, spread] = [0.5 * (slow + fast), 0.5 * (fast - slow)];
        Self {
            correction: ratio.powf(mean),
            relative_error: fast * area.error / area.value + spread * ratio.ln().abs(),
        }
    }
}

/// Pressure field of an answer; of a line contact with one column of elements. `None` if the answer has none.
fn pressure_field(answer: &Answer) -> Result<Option<PressureField>> {
    let fields = &answer.fields;
    let [first, second] = match (&fields.pressure, &fields.line_pressure[..]) {
        (Some(pressure), _) => return Ok(Some(pressure.clone())),
        (None, [first, second, ..]) => [first, second],
        (None, _) => return Ok(None),
    };
    let edge = second[0] - first[0];
    let grid = Grid::new([fields.line_pressure.len(), 1], [edge; 2])?;
    Ok(Some(PressureField {
        grid,
        origin: [first[0], 0.0],
        pressure: fields
            .line_pressure
            .iter()
            .map(|[_, pressure]| *pressure)
            .collect(),
    }))
}
