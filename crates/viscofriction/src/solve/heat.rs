//! Temperature to which a stationary contact is heated by the friction that it has.
//!
//! The shear of the interface heats the contact area uniformly with τ_f v, and the bulk is heated where its material dissipates. Together
//! both are F_t v.
//!
//! Theory: docs/theory/heat.md.

use bem_halfspace::heat::{ContactKind, Counterface, DepthProfile, HeatConductor, SlidingContact};
use bem_halfspace::{BemError, Grid, PressureField};
use numerics::{Estimate, MessageNumber, in_range};
use rheology::KELVIN_AT_ZERO_CELSIUS;

use super::answer::Answer;
use super::body::Body;
use super::error::{Result, SolveError};
use super::half_space::{HalfSpace, Simple};
use super::problem::{Motion, Problem};
use crate::scene::{Accuracy, MaterialTable, Model, Scene, SceneError};

/// Ratio of the relative error of the strain to that requested of the friction. Chosen: friction follows the strain with a power below 1,
/// and a correction of the strain does not use up its error.
const STRAIN_ERROR_OVER_REQUEST: f64 = 0.3;

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

    /// The error of a temperature with the key of the scene to change.
    fn at_key(&self, error: &BemError) -> SceneError {
        match error {
            BemError::DiffusivityTooSmall { .. } => {
                let problem = format!("{error}; give a larger one, or a smaller load.velocity");
                SceneError::at("heat.diffusivity", problem)
            }
            BemError::InvalidParameter(refused) if !refused.value.is_finite() => {
                let conductivity = MessageNumber(self.conductor.conductivity());
                let problem =
                    format!("{error}, with a conductivity of {conductivity} W/m/K; check its unit");
                SceneError::at("heat.conductivity", problem)
            }
            _ => SceneError::at("heat", error.to_string()),
        }
    }
}

impl Problem {
    /// Rejects heat where the temperature is not computed: without stationary sliding, on a layer or a track, in the one-dimensional
    /// model, and on a periodic surface without the time for which it has been sliding.
    pub(super) fn check_heat(&self) -> Result<(), SceneError> {
        let Some(heating) = self.heating() else {
            return Ok(());
        };
        self.check_stationary_half_space("heat")?;
        let refused = |key: &str, problem: &str| Err(SceneError::at(key, problem));
        let Motion::Sliding(load) = self.motion() else {
            return Ok(());
        };
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

    /// Rejects strain dependence where the strain of the contact is not computed: without stationary sliding, on a layer or a track, in the
    /// one-dimensional model, and for a material that does not dissipate or flows.
    pub(super) fn check_strain(&self) -> Result<(), SceneError> {
        if self.strain_dependence().is_none() {
            return Ok(());
        }
        self.check_stationary_half_space("strain")?;
        let refused = |problem: &str| Err(SceneError::at("strain", problem));
        if self.simple() == Some(&Simple::Elastic) {
            return refused(
                "its strain is weighted with the power that the material dissipates, and an elastic one dissipates none; leave it out",
            );
        }
        if self.material().creep().fluidity() > 0.0 {
            return refused(
                "a material that flows is strained without limit; give it an equilibrium modulus",
            );
        }
        Ok(())
    }

    /// Rejects the table `key` unless the scene is stationary sliding on an incompressible half space, not on a track.
    fn check_stationary_half_space(&self, key: &str) -> Result<(), SceneError> {
        let refused = |problem: &str| Err(SceneError::at(key, problem));
        let Motion::Sliding(load) = self.motion() else {
            return refused(
                "it needs a body that slides at a constant load.velocity, and this one does not; leave it out",
            );
        };
        if self.model() == Model::Line {
            return refused(
                "the scene asks for the one-dimensional model, which does not know the pressure in the contact; boundary elements do",
            );
        }
        if load.sliding_distance().is_some() {
            return refused(
                "it is computed for the stationary state; leave out solve.duration and solve.sliding_distance",
            );
        }
        if load.track().is_some() {
            return refused(
                "earlier passes over the same place are not computed with it; leave load.track out",
            );
        }
        if self.thickness().is_finite() {
            return refused(
                "what happens below the surface is computed on the half space, not in a layer; leave the layer out",
            );
        }
        if self.material().poisson_ratio() < 0.5 {
            return refused(
                "what happens below the surface is known for an incompressible material; give poisson_ratio = 0.5",
            );
        }
        Ok(())
    }

    /// Adds the strain of the contact, and the temperature to which its friction heats it, to an answer.
    pub(super) fn with_bulk(&self, answer: Answer) -> Result<Answer> {
        let Motion::Sliding(load) = self.motion() else {
            return Ok(answer);
        };
        if self.heating().is_none() && self.strain_dependence().is_none() {
            return Ok(answer);
        }
        let velocity = load.velocity();
        let Some(pressure) = pressure_field(&answer)? else {
            let method = answer.method;
            return Err(SolveError::NoPressureBelow { method });
        };
        let power_of = |friction: Option<Estimate>| {
            friction.unwrap_or(Estimate::exact(0.0)) * (answer.normal_force.value * velocity)
        };
        let [shear, bulk] = [answer.friction_from_shear, answer.hysteresis()].map(power_of);
        let contact = SlidingContact {
            pressure: &pressure,
            material: self.material(),
            factors: self.modulus_factors(),
            wave_shift: self.wave_shift(),
            velocity,
            shear_power: shear.value,
            contact_area: answer.contact_area.filter(|area| area.value > 0.0),
            bulk_power: bulk.value,
        };
        let duration = self.heating().and_then(|heating| heating.duration);
        let kind = match self.body() {
            Body::Periodic(_) => ContactKind::Period {
                duration: duration.unwrap_or_default(),
            },
            Body::Cylinder(_) => ContactKind::Line,
            Body::Revolution(_) | Body::HeightMap(_) => ContactKind::Body,
        };
        let mut answer = answer;
        if self.strain_dependence().is_some() {
            let needed = match self.accuracy() {
                Accuracy::RelativeError(asked) => STRAIN_ERROR_OVER_REQUEST * asked,
                Accuracy::Elements(_) => 0.0,
            };
            let found = contact
                .strain_amplitude(kind, needed)
                .map_err(|error| SceneError::at("strain", error.to_string()))?;
            // The square of the strain is relative to the power.
            let relative_error = 0.5 * bulk.error / bulk.value;
            answer.strain = Some(found.widened(relative_error * found.value));
        }
        let Some(heating) = self.heating() else {
            return Ok(answer);
        };
        let found = contact
            .temperature(&heating.conductor, heating.counterface, kind)
            .map_err(|error| heating.at_key(&error))?;
        // The temperature is proportional to the dissipated power. Its bars contain the error of the contact area, and so that of the shear.
        let power = shear.value + bulk.value;
        let relative_error = if power > 0.0 { bulk.error / power } else { 0.0 };
        let widened = |rise: Estimate| rise.widened(relative_error * rise.value.abs());
        answer.largest_temperature_rise = Some(widened(found.largest));
        answer.mean_temperature_rise = Some(widened(found.mean));
        let of_material =
            (found.by_depth.as_ref()).map_or(found.flux_weighted_mean, DepthProfile::mean);
        answer.dissipation_weighted_rise = Some(widened(of_material));
        answer.temperature_by_depth = found.by_depth;
        answer.fields.temperature = Some(TemperatureField {
            grid: found.grid,
            origin: pressure.origin,
            rise: found.temperature,
        });
        Ok(answer)
    }
}

/// Pressure field of an answer; of a line contact with one column of elements. `None` if the answer has none.
pub(super) fn pressure_field(answer: &Answer) -> Result<Option<PressureField>> {
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
