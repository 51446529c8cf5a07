//! Limits of the validity of an answer, as numbers and as sentences.

use std::fmt;

use numerics::Rounded;
use serde::{Serialize, Serializer};

use super::validity::{MAX_MEAN_SLOPE, MAX_USUAL_FRICTION, USUAL_ACTIVATION_ENERGIES};

/// A limit of the validity of an answer, with the numbers that exceed it.
///
/// [`Display`](fmt::Display) and JSON give the sentence that the program prints.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// The surface is too steep in the contact for linear theory.
    SteepContact {
        /// Mean slope from the lowest point to the farthest edge of the contact; the rms slope of a periodic surface; the friction
        /// coefficient if no edge is known.
        mean_slope: f64,
    },
    /// The depth is large relative to the radius of a sphere.
    DeepForSphere {
        /// Largest indentation depth, \[m].
        indentation_depth: f64,
        /// Radius of the sphere, \[m].
        radius: f64,
    },
    /// The depth is large relative to the thickness of a layer.
    DeepForLayer {
        /// Largest indentation depth, \[m].
        indentation_depth: f64,
        /// Thickness of the layer, \[m].
        thickness: f64,
    },
    /// The friction coefficient is larger than those that are measured on elastomers.
    LargeFriction {
        /// Friction coefficient, or its peak.
        friction_coefficient: f64,
    },
    /// An activation energy is not that of a polymer, so that it probably has another unit.
    UnusualActivationEnergy {
        /// Its key: `shift.law.arrhenius` of the material, or `interface.bell.activation_energy`.
        key: &'static str,
        /// The energy, [J/mol].
        activation_energy: f64,
    },
    /// The shear of the contact moves the surface vertically, and the contact without shear is computed.
    NeglectedCoupling {
        /// Poisson ratio ν.
        poisson_ratio: f64,
        /// True on a layer, where there is coupling for every Poisson ratio.
        is_layer: bool,
    },
    /// Heat does not change the moduli, because the material has no shift law.
    ModuliWithoutTemperature,
    /// The hottest place of the contact is hotter than the laws of material and shear strength are known for.
    HotterThanLaws {
        /// Largest temperature in the contact or below a periodic surface, \[°C].
        temperature: f64,
        /// Highest temperature of the laws, \[°C].
        highest: f64,
        /// True below a periodic surface, where each wave has the temperature of its depth.
        is_by_wave: bool,
    },
    /// The friction heats the contact to one of two temperatures; the answer is that of the lower one.
    SecondTemperature {
        /// The higher temperature, \[°C].
        temperature: f64,
        /// Friction coefficient at the higher temperature; `None` if it is not known.
        friction_coefficient: Option<f64>,
    },
    /// The strain of the contact is larger than those of the table of factors, whose last ones are used.
    UnmeasuredStrain {
        /// Amplitude of the equivalent strain.
        strain: f64,
        /// Largest strain of the table.
        largest: f64,
    },
    /// The contact strains the material to one of two amplitudes; the answer is that of the smaller one.
    SecondStrain {
        /// The larger amplitude of the equivalent strain.
        strain: f64,
        /// Friction coefficient at the larger strain; `None` if it is not known.
        friction_coefficient: Option<f64>,
    },
    /// Friction comes from frequencies at which the material was not measured.
    UnmeasuredFrequencies {
        /// Fractions of the friction from frequencies below and above the measured ones.
        outside: [f64; 2],
        /// Fraction of the friction from all of these frequencies.
        outside_window: f64,
        /// Lowest and highest measured angular frequency, \[rad/s].
        valid_frequencies: [f64; 2],
    },
    /// The load takes times at which the material was not measured.
    UnmeasuredTimes {
        /// Shortest and longest time of the load, \[s].
        times: [f64; 2],
        /// Shortest and longest measured time, the inverse of the measured angular frequencies, \[s].
        valid_times: [f64; 2],
    },
    /// The answer depends on the shortest waves of a rough surface.
    ShortestWaves {
        /// Rms slope of the shortest octave, relative to that of all waves.
        relative_slope: f64,
        /// Factor on the friction coefficient if the shortest octave is left out; `None` without friction.
        friction_factor: Option<f64>,
        /// Factor on the contact area if the shortest octave is left out; `None` without contact.
        area_factor: Option<f64>,
    },
    /// The file of the body has implausible contents, in words.
    File(String),
    /// The requested uncertainties are not known; the reason in words.
    NoUncertainty(String),
    /// Some of several random surfaces have a warning.
    OfSurfaces {
        /// The warning of the first of them; those of others may differ in their numbers.
        warning: Box<Self>,
        /// Number of surfaces with this warning.
        surfaces: usize,
        /// Number of all surfaces.
        of: usize,
    },
}

/// Writes that there is a second state, at `other`, because of `why`; its friction coefficient is left out if it is not known.
fn write_second_state(
    out: &mut fmt::Formatter<'_>,
    why: &str,
    other: &str,
    friction_coefficient: Option<f64>,
) -> fmt::Result {
    let words = |friction| format!(", with the friction coefficient {friction:.1e}");
    let friction = friction_coefficient.map(words).unwrap_or_default();
    write!(
        out,
        "{why}: this answer is that of the lower one, which is reached from rest; the other is about {other}{friction}"
    )
}

impl fmt::Display for Warning {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SteepContact { mean_slope } => write!(
                out,
                "the mean slope of the surface in contact is {mean_slope:.2}, and linear theory needs a small one: above {MAX_MEAN_SLOPE} \
                 its answers are rough"
            ),
            Self::DeepForSphere {
                indentation_depth,
                radius,
            } => {
                let limit = format!("radius {} m of the sphere", Rounded(*radius));
                write_deep(out, *indentation_depth, &limit)
            }
            Self::DeepForLayer {
                indentation_depth,
                thickness,
            } => {
                let limit = format!("thickness {} m of the layer", Rounded(*thickness));
                write_deep(out, *indentation_depth, &limit)
            }
            Self::LargeFriction {
                friction_coefficient,
            } => write!(
                out,
                "elastomers seldom have friction coefficients above {MAX_USUAL_FRICTION}, and this one is {}: check the units of load, moduli \
                 and shear strength",
                Rounded(*friction_coefficient)
            ),
            Self::UnusualActivationEnergy {
                key,
                activation_energy,
            } => write_unusual_energy(out, key, *activation_energy),
            Self::NeglectedCoupling { is_layer: true, .. } => out.write_str(
                "on a layer the shear of the contact also moves the surface vertically, and its effect on pressure and area is neglected",
            ),
            Self::NeglectedCoupling { poisson_ratio, .. } => {
                write_neglected_coupling(out, *poisson_ratio)
            }
            Self::ModuliWithoutTemperature => out.write_str(
                "the material has no shift law, so that its moduli are the same at every temperature; fit-material finds one from moduli \
                 at several temperatures",
            ),
            Self::HotterThanLaws {
                temperature,
                highest,
                is_by_wave,
            } => write_hotter(out, *temperature, *highest, *is_by_wave),
            Self::SecondTemperature {
                temperature,
                friction_coefficient,
            } => {
                let why = "friction increases with temperature and keeps the contact at one of two temperatures";
                write_second_state(out, why, &format!("{temperature:.0} °C"), *friction_coefficient)
            }
            Self::UnmeasuredStrain { strain, largest } => write!(
                out,
                "the strain {strain:.2e} of the contact is above {largest:.2e}, the largest of strain.table.file, whose last factors are used"
            ),
            Self::SecondStrain {
                strain,
                friction_coefficient,
            } => {
                let why = "the moduli fall so steeply with strain that the contact has one of two strains";
                write_second_state(out, why, &format!("{strain:.1e}"), *friction_coefficient)
            }
            Self::UnmeasuredFrequencies {
                outside,
                outside_window,
                valid_frequencies,
            } => write_unmeasured_frequencies(out, *outside, *outside_window, *valid_frequencies),
            Self::UnmeasuredTimes {
                times: [first, last],
                valid_times: [shortest, longest],
            } => write!(
                out,
                "what happens takes from {first:.3e} s to {last:.3e} s, and the frequencies at which the material was measured are \
                 those of times from {shortest:.3e} s to {longest:.3e} s; beyond them its moduli are extrapolated"
            ),
            Self::ShortestWaves {
                relative_slope,
                friction_factor,
                area_factor,
            } => write_shortest_waves(out, *relative_slope, [*friction_factor, *area_factor]),
            Self::File(sentence) => out.write_str(sentence),
            Self::NoUncertainty(why) => write!(
                out,
                "the columns of uncertainty are empty, because there are no derivatives: {why}"
            ),
            Self::OfSurfaces {
                warning,
                surfaces,
                of,
            } => write!(out, "{warning} (of {surfaces} of {of} surfaces)"),
        }
    }
}

/// Writes that an activation energy \[J/mol] at a key is not that of a polymer.
fn write_unusual_energy(out: &mut fmt::Formatter<'_>, key: &str, energy: f64) -> fmt::Result {
    let [lowest, highest] = USUAL_ACTIVATION_ENERGIES;
    write!(
        out,
        "{key} is {} J/mol, and polymers have activation energies from {lowest:.0} J/mol to {highest:.0} J/mol: check its unit",
        Rounded(energy)
    )
}

/// Writes which fractions of the friction come from frequencies below and above the measured ones \[rad/s], and from all of these.
fn write_unmeasured_frequencies(
    out: &mut fmt::Formatter<'_>,
    outside: [f64; 2],
    outside_window: f64,
    valid_frequencies: [f64; 2],
) -> fmt::Result {
    let percent = |fraction: f64| format!("{:.0} %", 100.0 * fraction);
    let [below, above] = outside.map(percent);
    let [lowest, highest] = valid_frequencies.map(Rounded);
    write!(
        out,
        "{} of the friction comes from frequencies at which the material was not measured: {below} from below {lowest} rad/s and {above} \
         from above {highest} rad/s; there its moduli are extrapolated",
        percent(outside_window)
    )
}

/// Writes that the depth exceeds a third of a length.
fn write_deep(out: &mut fmt::Formatter<'_>, indentation_depth: f64, length: &str) -> fmt::Result {
    write!(
        out,
        "the indentation depth {indentation_depth:.3e} m is more than a third of the {length}, where linear theory ends"
    )
}

/// The sentence of [`Warning::HotterThanLaws`].
fn write_hotter(
    out: &mut fmt::Formatter<'_>,
    temperature: f64,
    highest: f64,
    is_by_wave: bool,
) -> fmt::Result {
    let waves = match is_by_wave {
        true => "waves that are hotter have their moduli at this temperature, and ",
        false => "",
    };
    write!(
        out,
        "the hottest place of the contact has {temperature:.1} °C, and material and shear strength are known up to {} °C, so that {waves}the \
         temperature model spread is not known",
        Rounded(highest)
    )
}

/// Writes how much the shear of the contact would change pressure and area for a Poisson ratio below 1/2.
fn write_neglected_coupling(out: &mut fmt::Formatter<'_>, poisson_ratio: f64) -> fmt::Result {
    // Ratio of the vertical displacements by a tangential and by a normal traction (Johnson 1985, § 3.2).
    let coupling = (1.0 - 2.0 * poisson_ratio) / (2.0 * (1.0 - poisson_ratio));
    write!(
        out,
        "with a Poisson ratio of {} the shear of the contact also moves the surface vertically, which is neglected: pressure and area change by a \
         part of the order of {coupling:.2} times the friction coefficient from shear",
        Rounded(poisson_ratio)
    )
}

/// Writes what the answer would be without the shortest octave of waves: factors on friction and area.
fn write_shortest_waves(
    out: &mut fmt::Formatter<'_>,
    relative_slope: f64,
    [friction_factor, area_factor]: [Option<f64>; 2],
) -> fmt::Result {
    let changes = [("friction", friction_factor), ("area", area_factor)];
    let change = |(name, factor): (&str, Option<f64>)| {
        factor.map(|factor| format!("the {name} would be {factor:.2} times as large"))
    };
    let changes: Vec<String> = changes.into_iter().filter_map(change).collect();
    write!(
        out,
        "the answer depends on the shortest waves that were kept: without the shortest octave, whose own root mean square slope is {:.0} % of that \
         of all waves, {}",
        100.0 * relative_slope,
        changes.join(" and ")
    )
}

impl Serialize for Warning {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
