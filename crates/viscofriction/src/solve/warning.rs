//! Limits of the validity of an answer, as numbers and as sentences.

use numerics::Rounded;
use serde::{Serialize, Serializer};
use thiserror::Error;

use super::validity::{MAX_MEAN_SLOPE, MAX_USUAL_FRICTION, USUAL_ACTIVATION_ENERGIES};

/// A limit of the validity of an answer, with the numbers that exceed it.
///
/// [`Display`](std::fmt::Display) and JSON give the sentence that the program prints.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Warning {
    /// The surface is too steep in the contact for linear theory.
    #[error(
        "the mean slope of the surface in contact is {mean_slope:.2}, and linear theory needs a small one: above {MAX_MEAN_SLOPE} its answers \
         are rough"
    )]
    SteepContact {
        /// Mean slope from the lowest point to the farthest edge of the contact; the rms slope of a periodic surface; the friction
        /// coefficient if no edge is known.
        mean_slope: f64,
    },
    /// The depth is large relative to the radius of a sphere.
    #[error(
        "the indentation depth {indentation_depth:.3e} m is more than a third of the radius {} m of the sphere, where linear theory ends",
        Rounded(*radius)
    )]
    DeepForSphere {
        /// Largest indentation depth, \[m].
        indentation_depth: f64,
        /// Radius of the sphere, \[m].
        radius: f64,
    },
    /// The depth is large relative to the thickness of a layer.
    #[error(
        "the indentation depth {indentation_depth:.3e} m is more than a third of the thickness {} m of the layer, where linear theory ends",
        Rounded(*thickness)
    )]
    DeepForLayer {
        /// Largest indentation depth, \[m].
        indentation_depth: f64,
        /// Thickness of the layer, \[m].
        thickness: f64,
    },
    /// The friction coefficient is larger than those that are measured on elastomers.
    #[error(
        "elastomers seldom have friction coefficients above {MAX_USUAL_FRICTION}, and this one is {}: check the units of load, moduli and \
         shear strength",
        Rounded(*friction_coefficient)
    )]
    LargeFriction {
        /// Friction coefficient, or its peak.
        friction_coefficient: f64,
    },
    /// An activation energy is not that of a polymer, so that it probably has another unit.
    #[error(
        "{key} is {} J/mol, and polymers have activation energies from {:.0} J/mol to {:.0} J/mol: check its unit",
        Rounded(*activation_energy), USUAL_ACTIVATION_ENERGIES[0], USUAL_ACTIVATION_ENERGIES[1]
    )]
    UnusualActivationEnergy {
        /// Its key: `shift.law.arrhenius` of the material, or `interface.bell.activation_energy`.
        key: &'static str,
        /// The energy, [J/mol].
        activation_energy: f64,
    },
    /// The shear of the contact moves the surface vertically, and the contact without shear is computed.
    #[error("{}", neglected_coupling(*poisson_ratio, *is_layer))]
    NeglectedCoupling {
        /// Poisson ratio ν.
        poisson_ratio: f64,
        /// True on a layer, where there is coupling for every Poisson ratio.
        is_layer: bool,
    },
    /// Heat does not change the moduli, because the material has no shift law.
    #[error(
        "the material has no shift law, so that its moduli are the same at every temperature; fit-material finds one from moduli at several \
         temperatures"
    )]
    ModuliWithoutTemperature,
    /// The hottest place of the contact is hotter than the laws of material and shear strength are known for.
    #[error(
        "the hottest place of the contact has {temperature:.1} °C, and material and shear strength are known up to {} °C, so that {}the \
         temperature model spread is not known",
        Rounded(*highest),
        if *is_limited { "what is hotter is taken to have this temperature, and " } else { "" }
    )]
    HotterThanLaws {
        /// Largest temperature in the contact or below it, \[°C].
        temperature: f64,
        /// Highest temperature of the laws, \[°C].
        highest: f64,
        /// True if the material, one of its waves or the contact area is hotter, and not only the hottest place.
        is_limited: bool,
    },
    /// The friction heats the contact to one of two temperatures; the answer is that of the lower one.
    #[error(
        "friction increases with temperature and keeps the contact at one of two temperatures: this answer is that of the lower one, which is \
         reached from rest; the other is about {temperature:.0} °C{}",
        second_friction(*friction_coefficient)
    )]
    SecondTemperature {
        /// The higher temperature, \[°C].
        temperature: f64,
        /// Friction coefficient at the higher temperature; `None` if it is not known.
        friction_coefficient: Option<f64>,
    },
    /// The strain of the contact is larger than those of the table of factors, whose last ones are used.
    #[error(
        "the strain {strain:.2e} of the contact is above {largest:.2e}, the largest of strain.table.file, whose last factors are used"
    )]
    UnmeasuredStrain {
        /// Amplitude of the equivalent strain.
        strain: f64,
        /// Largest strain of the table.
        largest: f64,
    },
    /// The contact strains the material to one of two amplitudes; the answer is that of the smaller one.
    #[error(
        "the moduli fall so steeply with strain that the contact has one of two strains: this answer is that of the lower one, which is \
         reached from rest; the other is about {strain:.1e}{}",
        second_friction(*friction_coefficient)
    )]
    SecondStrain {
        /// The larger amplitude of the equivalent strain.
        strain: f64,
        /// Friction coefficient at the larger strain; `None` if it is not known.
        friction_coefficient: Option<f64>,
    },
    /// Friction comes from frequencies at which the material was not measured.
    #[error(
        "{} of the friction comes from frequencies at which the material was not measured: {} from below {} rad/s and {} from above {} rad/s; \
         there its moduli are extrapolated",
        percent(*outside_window), percent(outside[0]), Rounded(valid_frequencies[0]), percent(outside[1]), Rounded(valid_frequencies[1])
    )]
    UnmeasuredFrequencies {
        /// Fractions of the friction from frequencies below and above the measured ones.
        outside: [f64; 2],
        /// Fraction of the friction from all of these frequencies.
        outside_window: f64,
        /// Lowest and highest measured angular frequency, \[rad/s].
        valid_frequencies: [f64; 2],
    },
    /// The load takes times at which the material was not measured.
    #[error(
        "what happens takes from {:.3e} s to {:.3e} s, and the frequencies at which the material was measured are those of times from \
         {:.3e} s to {:.3e} s; beyond them its moduli are extrapolated",
        times[0], times[1], valid_times[0], valid_times[1]
    )]
    UnmeasuredTimes {
        /// Shortest and longest time of the load, \[s].
        times: [f64; 2],
        /// Shortest and longest measured time, the inverse of the measured angular frequencies, \[s].
        valid_times: [f64; 2],
    },
    /// The answer depends on the shortest waves of a rough surface.
    #[error(
        "the answer depends on the shortest waves that were kept: without the shortest octave, whose own root mean square slope is {} of that \
         of all waves, {}",
        percent(*relative_slope), without_shortest_waves(*friction_factor, *area_factor)
    )]
    ShortestWaves {
        /// Rms slope of the shortest octave, relative to that of all waves.
        relative_slope: f64,
        /// Factor on the friction coefficient if the shortest octave is left out; `None` without friction.
        friction_factor: Option<f64>,
        /// Factor on the contact area if the shortest octave is left out; `None` without contact.
        area_factor: Option<f64>,
    },
    /// The file of the body has implausible contents, in words.
    #[error("{_0}")]
    File(String),
    /// The requested uncertainties are not known; the reason in words.
    #[error("the columns of uncertainty are empty, because there are no derivatives: {_0}")]
    NoUncertainty(String),
    /// Some of several random surfaces have a warning.
    #[error("{warning} (of {surfaces} of {of} surfaces)")]
    OfSurfaces {
        /// The warning of the first of them; those of others may differ in their numbers.
        warning: Box<Self>,
        /// Number of surfaces with this warning.
        surfaces: usize,
        /// Number of all surfaces.
        of: usize,
    },
}

/// A fraction in percent.
fn percent(fraction: f64) -> String {
    format!("{:.0} %", 100.0 * fraction)
}

/// The words for the friction coefficient of a second state; empty if it is not known.
fn second_friction(friction_coefficient: Option<f64>) -> String {
    let words = |friction| format!(", with the friction coefficient {friction:.1e}");
    friction_coefficient.map(words).unwrap_or_default()
}

/// How much the shear of the contact would change pressure and area.
fn neglected_coupling(poisson_ratio: f64, is_layer: bool) -> String {
    if is_layer {
        return "on a layer the shear of the contact also moves the surface vertically, and its effect on pressure and area is neglected"
            .to_owned();
    }
    // Ratio of the vertical displacements by a tangential and by a normal traction (Johnson 1985, § 3.2).
    let coupling = (1.0 - 2.0 * poisson_ratio) / (2.0 * (1.0 - poisson_ratio));
    format!(
        "with a Poisson ratio of {} the shear of the contact also moves the surface vertically, which is neglected: pressure and area change by a \
         part of the order of {coupling:.2} times the friction coefficient from shear",
        Rounded(poisson_ratio)
    )
}

/// What the answer would be without the shortest octave of waves: factors on friction and area.
fn without_shortest_waves(friction_factor: Option<f64>, area_factor: Option<f64>) -> String {
    let changes = [("friction", friction_factor), ("area", area_factor)];
    let change = |(name, factor): (&str, Option<f64>)| {
        factor.map(|factor| format!("the {name} would be {factor:.2} times as large"))
    };
    let changes: Vec<String> = changes.into_iter().filter_map(change).collect();
    changes.join(" and ")
}

impl Serialize for Warning {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
