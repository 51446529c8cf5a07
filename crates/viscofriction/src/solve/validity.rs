//! Limits of the linear theory of the contact.

use std::f64::consts::PI;

use indenters::Surface as _;

use super::answer::Answer;
use super::body::Body;
use super::curve::{AREA, DEPTH, RADIUS};
use super::half_space::Simple;
use super::problem::{Motion, Problem};
use super::warning::Warning;
use crate::scene::{Revolution, ShiftLaw};

/// Mean slope of the body in contact above which a warning is given. Chosen: linear theory neglects the square of the slope
/// against 1, here a quarter.
pub(super) const MAX_MEAN_SLOPE: f64 = 0.5;
/// Ratio of the indentation depth to the radius of a sphere, or to the thickness of a layer, above which a warning is given.
/// Chosen: strains are then a third or more, beyond the range in which the theory and most elastomers are linear.
const MAX_RELATIVE_DEPTH: f64 = 1.0 / 3.0;
/// Friction coefficient above which a warning is given. Chosen: dry rubber has up to 5, soft gels under small loads up to about 10.
pub(super) const MAX_USUAL_FRICTION: f64 = 10.0;

/// Smallest and largest activation energy without a warning, [J/mol]. Chosen: the law of Williams, Landel and Ferry, with the constants
/// C₁ = 17.44 and C₂ = 51.6 K that they found for most polymers (1955, J. Am. Chem. Soc. 77, 3701), has the apparent energy
/// R ln(10) C₁ T²/C₂ at the glass transition T: 0.3e6 of a rubber of 220 K, 0.9e6 of polystyrene. The smallest one is four times the
/// thermal energy RT at room temperature. Energies of this range in kJ/mol or eV are below it as numbers.
pub(super) const USUAL_ACTIVATION_ENERGIES: [f64; 2] = [1e4, 1e6];

/// Warnings about the validity of an answer, after those of its files; without any the linear theory holds.
pub(super) fn warnings(problem: &Problem, answer: &Answer) -> Vec<Warning> {
    let body = problem.body();
    let of_files = problem.warnings().iter().cloned();
    let mut warnings: Vec<Warning> = of_files.map(Warning::File).collect();
    if let Some(mean_slope) = mean_slope(body, answer).filter(|slope| *slope > MAX_MEAN_SLOPE) {
        warnings.push(Warning::SteepContact { mean_slope });
    }
    let last = answer.indentation_depth.map_or(0.0, |depth| depth.value);
    let depth = answer.fields.curve.largest(DEPTH).max(last);
    if let Body::Revolution(Revolution::Sphere(sphere)) = body
        && depth > MAX_RELATIVE_DEPTH * sphere.radius()
    {
        warnings.push(Warning::DeepForSphere {
            indentation_depth: depth,
            radius: sphere.radius(),
        });
    }
    if depth > MAX_RELATIVE_DEPTH * problem.thickness() {
        warnings.push(Warning::DeepForLayer {
            indentation_depth: depth,
            thickness: problem.thickness(),
        });
    }
    let friction = [answer.friction_coefficient, answer.peak_friction];
    let largest = friction.iter().flatten().map(|friction| friction.value);
    let friction_coefficient = largest.fold(0.0, f64::max);
    if friction_coefficient > MAX_USUAL_FRICTION {
        warnings.push(Warning::LargeFriction {
            friction_coefficient,
        });
    }
    warnings.extend(energy_warnings(problem));
    warnings.extend(coupling_warning(problem));
    if problem.heating().is_some() && dissipates(problem) && problem.shift().is_none() {
        warnings.push(Warning::ModuliWithoutTemperature);
    }
    warnings.extend(extrapolation_warning(problem, answer).or_else(|| duration_warning(problem)));
    warnings.extend(shortest_octave_warning(body, answer));
    warnings
}

/// Warnings about the activation energies of the material and of the interface that are outside [`USUAL_ACTIVATION_ENERGIES`].
fn energy_warnings(problem: &Problem) -> impl Iterator<Item = Warning> {
    let of_material = problem.shift().and_then(|shift| match shift.law {
        ShiftLaw::Arrhenius(energy) => Some(("shift.law.arrhenius", energy)),
        ShiftLaw::Wlf(_) => None,
    });
    let of_shear = problem
        .shear()
        .and_then(|shear| shear.law.strength.activation_energy())
        .map(|energy| ("interface.bell.activation_energy", energy));
    let [lowest, highest] = USUAL_ACTIVATION_ENERGIES;
    of_material
        .into_iter()
        .chain(of_shear)
        .filter(move |(_, energy)| !(lowest..=highest).contains(energy))
        .map(
            |(key, activation_energy)| Warning::UnusualActivationEnergy {
                key,
                activation_energy,
            },
        )
}

/// Warning if the shear of the contact moves the surface vertically, which is neglected: on a layer, and for a Poisson ratio below 1/2.
/// `None` otherwise.
fn coupling_warning(problem: &Problem) -> Option<Warning> {
    problem.shear()?;
    let poisson_ratio = problem.material().poisson_ratio();
    let is_layer = problem.thickness().is_finite();
    (is_layer || poisson_ratio < 0.5).then_some(Warning::NeglectedCoupling {
        poisson_ratio,
        is_layer,
    })
}

/// Warning if a large part of the friction comes from frequencies at which the material was not measured; `None` otherwise.
fn extrapolation_warning(problem: &Problem, answer: &Answer) -> Option<Warning> {
    let valid_frequencies = problem.window()?;
    let of_window = &answer.dissipation;
    let outside = [of_window.below_window, of_window.above_window];
    of_window
        .is_extrapolated()
        .then(|| Warning::UnmeasuredFrequencies {
            outside: outside.map(Option::unwrap_or_default),
            outside_window: of_window.outside_window.unwrap_or_default(),
            valid_frequencies,
        })
}

/// Warning if a duration of the load is outside the times 1/ω of the measured frequencies; `None` otherwise.
fn duration_warning(problem: &Problem) -> Option<Warning> {
    let [longest, shortest] = problem.window()?.map(f64::recip);
    let mut taken = problem.durations();
    taken.sort_by(f64::total_cmp);
    let (first, last) = (*taken.first()?, *taken.last()?);
    (first < shortest || last > longest).then_some(Warning::UnmeasuredTimes {
        times: [first, last],
        valid_times: [shortest, longest],
    })
}

/// Warning if the answer depends on the shortest octave of waves of a rough surface; `None` otherwise.
fn shortest_octave_warning(body: &Body, answer: &Answer) -> Option<Warning> {
    let Body::Periodic(surface) = body else {
        return None;
    };
    let without = answer.without_shortest_octave?;
    without.warning(answer, surface.rms_slope())
}

/// True unless the material is a spring.
fn dissipates(problem: &Problem) -> bool {
    problem.simple() != Some(&Simple::Elastic)
}

/// Effects in a measurement that no method models for this kind of scene.
pub(super) fn not_modelled(problem: &Problem) -> Vec<&'static str> {
    let slides = matches!(problem.motion(), Motion::Sliding(_) | Motion::Moving(_));
    let dissipates = dissipates(problem);
    let is_heated = slides && (dissipates || problem.shear().is_some());
    let words = [
        ("adhesion", true),
        (
            "strain dependence",
            dissipates && problem.strain_dependence().is_none(),
        ),
        ("heating", is_heated && problem.heating().is_none()),
        ("interfacial shear", slides && problem.shear().is_none()),
    ];
    words
        .into_iter()
        .filter(|(_, applies)| *applies)
        .map(|(word, _)| word)
        .collect()
}

/// Mean slope h(r)/r from the lowest point to the farthest edge r of the contact; for a periodic surface the rms slope. If no
/// edge is known it is the friction coefficient, which is a mean of the slope. `None` if that is not known, or the height at
/// the edge is infinite.
pub(super) fn mean_slope(body: &Body, answer: &Answer) -> Option<f64> {
    if let Body::Periodic(surface) = body {
        return Some(surface.rms_slope());
    }
    let curve = &answer.fields.curve;
    let widest = curve.largest(RADIUS).max((curve.largest(AREA) / PI).sqrt());
    let ends = answer.contact_box.as_ref().map(|contact| contact.x);
    let Some(ends) = ends.or((widest > 0.0).then_some([-widest, widest])) else {
        return answer.hysteresis().map(|friction| friction.value);
    };
    let radius = ends[0].abs().max(ends[1].abs()).max(widest);
    let height = match body {
        Body::Periodic(_) => return None,
        Body::Revolution(body) => body.profile_height(radius),
        Body::Cylinder(cylinder) => cylinder.height([radius, 0.0]),
        Body::HeightMap(map) => {
            let heights = ends.map(|x| map.height([x, 0.0])).into_iter();
            heights
                .filter(|height| height.is_finite())
                .fold(0.0, f64::max)
        }
    };
    (height.is_finite() && radius > 0.0).then(|| height / radius)
}
