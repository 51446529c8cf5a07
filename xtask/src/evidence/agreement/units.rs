//! A scene whose lengths, stresses and times are multiplied by powers of two: the same scene in other units.

use viscofriction::scene::{Indenter, Load, MaterialTable, Term};

use crate::evidence::sample::Case;

/// Factors of lengths, stresses and times.
#[derive(Clone, Copy)]
struct Units {
    length: f64,
    stress: f64,
    time: f64,
}

/// By what a quantity of an answer is multiplied when lengths, stresses and times are multiplied by these powers of two;
/// none for a name that is not known here.
pub(super) fn factor(name: &str, is_per_length: bool, powers: [i32; 3]) -> Option<f64> {
    let [length, stress, _] = powers;
    let extent = if is_per_length { 1 } else { 2 };
    let power = match name {
        "normal_force" | "tangential_force" => stress + extent * length,
        "indentation_depth" | "contact_radius" | "x_min" | "x_max" | "y_min" | "y_max" => length,
        "contact_area" => extent * length,
        "peak_pressure" | "mean_pressure" => stress,
        "work" => stress + 3 * length,
        "friction_coefficient"
        | "area_fraction"
        | "friction_from_dissipation"
        | "persson_area_fraction"
        | "persson_friction_coefficient"
        | "persson_friction_coefficient_2006"
        | "dissipation_outside_window"
        | "dissipation_below_window"
        | "dissipation_above_window"
        | "dissipation_shortest_octave" => 0,
        _ => return None,
    };
    Some(2.0_f64.powi(power))
}

/// Multiplies every number of the scene; those of its files too.
pub(super) fn in_other_units(case: &mut Case, powers: [i32; 3]) {
    let [length, stress, time] = powers.map(|power| 2.0_f64.powi(power));
    let units = Units {
        length,
        stress,
        time,
    };
    let scene = &mut case.scene;
    units.body(&mut scene.indenter);
    units.material(&mut scene.material);
    if let Some(material) = &mut case.material {
        units.material(material);
    }
    if let Some(lengths) = &mut case.lengths {
        lengths.values.iter_mut().for_each(|value| *value *= length);
    }
    let is_per_length = matches!(scene.indenter, Indenter::Cylinder { .. });
    let extent = if is_per_length {
        length
    } else {
        length * length
    };
    units.load(&mut scene.load, stress * extent);
    case.contact *= length;
    let lengths = [scene.layer.as_mut().map(|layer| &mut layer.thickness)];
    let lengths = lengths
        .into_iter()
        .chain([scene.solve.sliding_distance.as_mut()]);
    lengths.flatten().for_each(|value| *value *= length);
    let duration = scene.solve.duration.iter_mut();
    duration.for_each(|value| *value *= time);
}

impl Units {
    fn body(self, body: &mut Indenter) {
        let length = self.length;
        match body {
            Indenter::Power {
                coefficient,
                exponent,
            } => *coefficient *= length.powf(1.0 - *exponent),
            Indenter::Superposition { terms } => {
                for Term {
                    coefficient,
                    exponent,
                } in terms
                {
                    *coefficient *= length.powf(1.0 - *exponent);
                }
            }
            Indenter::Cone { slope: _ } => {}
            Indenter::Paraboloid { curvature } => *curvature /= length,
            Indenter::Sphere { radius }
            | Indenter::FlatPunch { radius }
            | Indenter::FlatCone { radius, .. }
            | Indenter::RoundTippedCone { radius, .. }
            | Indenter::Hyperboloid { radius, .. }
            | Indenter::Cylinder { radius } => *radius *= length,
            Indenter::TruncatedParaboloid { radius, curvature } => {
                *radius *= length;
                *curvature /= length;
            }
            Indenter::SelfAffine(surface) => {
                let period = surface.period.iter_mut();
                let waves = [
                    &mut surface.longest_wavelength,
                    &mut surface.shortest_wavelength,
                ];
                let lengths = period.chain(waves).chain(&mut surface.roll_off_wavelength);
                lengths.for_each(|value| *value *= length);
            }
            Indenter::HeightMap(map) => {
                map.spacing
                    .iter_mut()
                    .flatten()
                    .for_each(|value| *value *= length);
            }
            Indenter::Table { .. } => {}
        }
    }

    #[expect(clippy::too_many_lines, reason = "one arm for each kind")]
    fn material(self, material: &mut MaterialTable) {
        let Self { stress, time, .. } = self;
        match material {
            MaterialTable::Viscous { viscosity, .. } => *viscosity *= stress * time,
            MaterialTable::Elastic { shear_modulus, .. } => *shear_modulus *= stress,
            MaterialTable::KelvinVoigt {
                shear_modulus,
                viscosity,
                ..
            }
            | MaterialTable::Maxwell {
                shear_modulus,
                viscosity,
                ..
            } => {
                *shear_modulus *= stress;
                *viscosity *= stress * time;
            }
            MaterialTable::StandardSolid {
                equilibrium_modulus,
                maxwell_modulus,
                viscosity,
                ..
            } => {
                *equilibrium_modulus *= stress;
                *maxwell_modulus *= stress;
                *viscosity *= stress * time;
            }
            MaterialTable::Prony {
                equilibrium_modulus,
                viscosity,
                branches,
                valid_frequencies,
                ..
            } => {
                *equilibrium_modulus *= stress;
                *viscosity *= stress * time;
                let window = valid_frequencies.iter_mut().flatten();
                window.for_each(|frequency| *frequency /= time);
                for branch in branches {
                    branch.modulus *= stress;
                    branch.relaxation_time *= time;
                }
            }
            MaterialTable::Springpot {
                coefficient,
                exponent,
                equilibrium_modulus,
                time_range,
                ..
            } => {
                *coefficient *= stress * time.powf(*exponent);
                *equilibrium_modulus *= stress;
                time_range.iter_mut().for_each(|value| *value *= time);
            }
            MaterialTable::FractionalMaxwell {
                shear_modulus,
                relaxation_time,
                equilibrium_modulus,
                time_range,
                ..
            } => {
                *shear_modulus *= stress;
                *equilibrium_modulus *= stress;
                let times = time_range.iter_mut().chain([relaxation_time]);
                times.for_each(|value| *value *= time);
            }
            // What the file holds is multiplied.
            MaterialTable::File { .. } => {}
        }
    }

    fn load(self, load: &mut Load, force: f64) {
        let Self {
            length,
            stress,
            time,
        } = self;
        let Load {
            normal_force,
            indentation_depth,
            mean_pressure,
            velocity,
            history,
            history_file: _,
        } = load;
        let given = [
            (normal_force, force),
            (indentation_depth, length),
            (mean_pressure, stress),
            (velocity, length / time),
        ];
        for (value, factor) in given {
            value.iter_mut().for_each(|value| *value *= factor);
        }
        for point in history.iter_mut().flatten() {
            point.time *= time;
            point
                .normal_force
                .iter_mut()
                .for_each(|value| *value *= force);
            let depth = point.indentation_depth.iter_mut();
            depth.for_each(|value| *value *= length);
        }
    }
}
