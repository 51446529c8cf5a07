//! Pressure under a pressed body, and the contact since first touch.

use std::f64::consts::PI;

use friction_analytic::indentation_pressure;
use indenters::HistoryPoint;
use mdr_core::{CurvePoint, indent_along, work_along};
use numerics::Estimate;

use super::analytic::{pressed, stiffness};
use super::answer::Answer;
use super::body::Body;
use super::curve::{self, CurveColumn};
use super::half_space::Simple;
use super::problem::{Motion, Problem};
use super::{layer, mdr};
use crate::scene::Revolution;
use crate::scene::{Control, Method};

/// Number of sampled pressures on each side of the middle of the contact. Chosen; it changes only the resolution of the output.
const N_PLACES: usize = 100;
/// Error requested of the work along a history, relative to the largest absolute work. Chosen.
const WORK_ERROR: f64 = 1e-4;
/// Smallest number of steps along an indentation history. Chosen; it changes only the resolution of the output.
const N_STEPS: u32 = 160;
/// Number of intervals in time at whose ends the contact since first touch is evaluated. Chosen; output only.
const N_TIMES: usize = 60;

/// Adds pressure and history to a closed form of indentation, and the work to an indentation history of the one-dimensional
/// model. They may take longer than the answer; other answers have their fields already.
///
/// Some fields are left out. The pressure under a constant force on a material that creeps depends on how the contact has
/// grown. The pressure of a body whose slope jumps inside the contact, such as a flat cone, is infinite there. An elastic
/// material has no history.
#[must_use]
pub fn with_fields(problem: &Problem, mut answer: Answer) -> Answer {
    let pressure = match (problem.body(), answer.method) {
        (Body::Revolution(body), Method::Analytic) => {
            if let (Motion::Pressing(load), false) =
                (problem.motion(), problem.simple() == Some(&Simple::Elastic))
            {
                let points = since_touch(problem, body, load.duration());
                answer.fields.history_steps = points.iter().map(step).collect();
                answer.fields.curve = mdr::curve_of(&points);
            }
            pressure_of_revolution(problem, body, &answer)
        }
        (Body::Cylinder(_), Method::Analytic) => pressure_of_cylinder(&answer),
        _ => None,
    };
    if let Some(pressure) = pressure {
        answer.fields.line_pressure = pressure;
    }
    if let (Motion::History { points, .. }, Body::Revolution(body)) =
        (problem.motion(), problem.body())
        && answer.method != Method::BemTransient
    {
        let options = mdr::history_options(problem, WORK_ERROR);
        let profile = layer::equivalent_profile(problem, body, points).ok();
        if let Some(profile) = &profile {
            let steps = subdivided(points);
            // A picture without these steps shows the points alone.
            if let Ok(curve) = indent_along(&**profile, problem.material(), &steps, &options) {
                answer.fields.history_steps = curve.iter().map(step).collect();
            }
        }
        let work = profile
            .and_then(|profile| work_along(&*profile, problem.material(), points, &options).ok());
        let column = work.map(|values| CurveColumn {
            name: curve::WORK_DONE,
            values,
        });
        answer.fields.curve.columns.extend(column);
    }
    answer
}

/// Time, depth and force of a point of a curve.
fn step(point: &CurvePoint) -> [f64; 3] {
    let [depth, force] = [point.indentation_depth.value, point.normal_force.value];
    [point.time, depth, force]
}

/// A history with intermediate points, in which forces and depths are linear from point to point; jumps stay.
fn subdivided(points: &[HistoryPoint]) -> Vec<HistoryPoint> {
    let Some((first, last)) = points.first().zip(points.last()) else {
        return Vec::new();
    };
    let longest = (last.time - first.time) / f64::from(N_STEPS);
    let mut steps = vec![*first];
    for pair in points.windows(2) {
        let duration = pair[1].time - pair[0].time;
        let (from, to) = (pair[0].control.value(), pair[1].control.value());
        let parts = whole_parts(duration / longest);
        steps.extend((1..parts).map(|index| {
            let part = f64::from(index) / f64::from(parts);
            HistoryPoint {
                time: pair[0].time + part * duration,
                control: pair[0].control.with(from + part * (to - from)),
            }
        }));
        steps.push(pair[1]);
    }
    steps
}

/// Number of parts of an interval, at least 1; `ratio` is the ratio of the length of the interval to that of a part.
fn whole_parts(ratio: f64) -> u32 {
    (1..=2 * N_STEPS)
        .find(|count| f64::from(*count) >= ratio)
        .unwrap_or(1)
}

/// The contact at the times duration (k/60)⁴ \[s], dense just after first touch where it changes fastest. Times below those of
/// an expanded series, and times at which a quantity underflows, are left out.
fn since_touch(problem: &Problem, body: &Revolution, duration: f64) -> Vec<CurvePoint> {
    let point = |time: f64| {
        let answer = pressed(body, problem.material(), problem.motion().control(), time)
            .and_then(Answer::finite)
            .and_then(|answer| problem.with_modulus_error(answer))
            .ok()?;
        let contact = answer.contact_box?;
        Some(CurvePoint {
            time,
            indentation_depth: answer.indentation_depth?,
            normal_force: answer.normal_force,
            contact_radius: Estimate::new(contact.x[1], contact.error),
        })
    };
    let shortest = problem
        .expansion()
        .map_or(0.0, |series| series.time_range[0]);
    let time = |index: usize| duration * (index as f64 / N_TIMES as f64).powi(4);
    let times = (0..=N_TIMES).map(time).filter(|time| *time >= shortest);
    times.filter_map(point).collect()
}

/// Position \[m] and pressure \[Pa] along a diameter: that of a dashpot of 1 Pa s times G(t)/(2 (1 − ν)). `None` under a
/// constant force on a material that creeps, and if the slope of the body jumps inside the contact.
fn pressure_of_revolution(
    problem: &Problem,
    body: &Revolution,
    answer: &Answer,
) -> Option<Vec<[f64; 2]>> {
    let time = match (problem.motion(), problem.motion().control()) {
        _ if problem.simple() == Some(&Simple::Elastic) => 0.0,
        (Motion::Pressing(load), Control::IndentationDepth(_)) => load.duration(),
        _ => return None,
    };
    let modulus = stiffness(problem.material(), time).ok()?;
    let depth = answer.indentation_depth?.value;
    let [_, edge] = answer.contact_box.as_ref()?.x;
    // At a slope jump the pressure is infinite, and the quadrature is inaccurate nearby.
    let mut kinks = body.kinks().into_iter();
    if kinks.any(|kink| kink.radius < edge && kink.slope_jump != 0.0) {
        return None;
    }
    let pressure = |radius| Some(modulus * indentation_pressure(&**body, depth, radius).ok()?);
    symmetric_pressure(edge, edge < body.max_radius(), pressure)
}

/// Pressure under a cylinder, p = p₀ √(1 − (x/b)²) (Hertz 1881).
fn pressure_of_cylinder(answer: &Answer) -> Option<Vec<[f64; 2]>> {
    let peak = answer.peak_pressure?.value;
    let [_, edge] = answer.contact_box.as_ref()?.x;
    let pressure = |place: f64| Some(peak * (1.0 - (place / edge).powi(2)).sqrt());
    symmetric_pressure(edge, true, pressure)
}

/// Position \[m] and value of a symmetric pressure from −`edge` to `edge`, in order. The middle, and an edge of the body, are
/// left out, because the pressure may be infinite there. If the contact `ends_inside` the body, the pressure vanishes like a
/// square root, and the samples are dense there.
fn symmetric_pressure(
    edge: f64,
    ends_inside: bool,
    pressure: impl Fn(f64) -> Option<f64>,
) -> Option<Vec<[f64; 2]>> {
    let place = |index: usize| {
        let part = (index as f64 + 0.5) / N_PLACES as f64;
        let dense_at_ends = 0.5 - 0.5 * (PI * part).cos();
        edge * if ends_inside { dense_at_ends } else { part }
    };
    let at = |place: f64| Some([place, pressure(place)?]);
    let mut ahead: Vec<[f64; 2]> = (0..N_PLACES).map(place).map(at).collect::<Option<_>>()?;
    ahead.extend(ends_inside.then_some([edge, 0.0]));
    let behind = ahead.iter().rev().map(|[place, value]| [-place, *value]);
    Some(behind.chain(ahead.iter().copied()).collect())
}
