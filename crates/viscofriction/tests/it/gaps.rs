//! Answers have the gap around their contact, with the moduli that heat and strain leave.

use std::f64::consts::PI;
use std::fs;

use viscofriction::bem_halfspace::GapField;
use viscofriction::scene::Scene;
use viscofriction::{Answer, Problem, solve};

use crate::support::{Folder, example};

/// Pressures, on a line along x too, and gaps of the same elements; and the largest gap of the field.
fn pairs(answer: &Answer) -> (Vec<[f64; 2]>, f64) {
    let field = answer.fields.gap.as_ref().expect("a gap");
    let largest = field.gap.iter().copied().fold(0.0, f64::max);
    let pressure_at = |place: [f64; 2]| match &answer.fields.pressure {
        Some(pressure) => pressure.pressure_at(place),
        None => on_line(answer, place[0]),
    };
    let pairs = (places(field).into_iter()).zip(&field.gap);
    let pairs = pairs.map(|(place, gap)| [pressure_at(place), *gap]);
    (pairs.collect(), largest)
}

/// Pressure of the element of a line contact at a place \[m].
fn on_line(answer: &Answer, x: f64) -> f64 {
    let line = &answer.fields.line_pressure;
    let half_edge = 0.5 * (line[1][0] - line[0][0]);
    let found = line.iter().find(|[place, _]| (place - x).abs() < half_edge);
    found.map_or(0.0, |[_, pressure]| *pressure)
}

/// Centres of the elements of a field, \[m].
fn places(field: &GapField) -> Vec<[f64; 2]> {
    let [_, columns] = field.grid.shape();
    let [dx, dy] = field.grid.spacing();
    let place = |index: usize| {
        let [row, column] = [index / columns, index % columns].map(|at| at as f64);
        [field.origin[0] + row * dx, field.origin[1] + column * dy]
    };
    (0..field.gap.len()).map(place).collect()
}

#[test]
fn where_there_is_pressure_there_is_no_gap() {
    let folder = Folder::new("gaps");
    for scene in [
        "IN/sphere-standard-solid.toml",
        "IN/cylinder-solid.toml",
        "IN/hot-ball.toml",
        "IN/filled-rubber.toml",
        "IN/half-space-run-in.toml --method bem-transient",
        "IN/hertz.toml --method bem-transient",
        "IN/rough-road.toml",
    ] {
        let (pairs, largest) = pairs(&folder.solved(scene).answer);
        assert!(largest > 0.0, "{scene}: {largest:e}");
        let mut n_loaded = 0;
        for [pressure, gap] in pairs {
            let is_loaded = pressure > 0.0;
            n_loaded += usize::from(is_loaded);
            let allowed = if is_loaded { 1e-4 * largest } else { largest };
            assert!(
                (-1e-4 * largest..=allowed).contains(&gap),
                "{scene}: {gap:e} at {pressure:e} Pa"
            );
        }
        assert!(n_loaded > 10, "{scene}: {n_loaded} elements");
    }
}

#[test]
fn around_a_pressed_ball_it_is_that_of_hertz() {
    let folder = Folder::new("gap_of_hertz");
    let answer = folder.solved("IN/hertz.toml --method bem-transient").answer;
    let field = answer.fields.gap.as_ref().expect("a gap");
    let radius = (answer.contact_area.expect("an area").value / PI).sqrt();
    let depth = answer.indentation_depth.expect("a depth").value;
    let ball = radius * radius / depth;
    let largest = field.gap.iter().copied().fold(0.0, f64::max);
    for ([x, y], gap) in places(field).into_iter().zip(&field.gap) {
        let ratio = x.hypot(y) / radius;
        let opened = (ratio * ratio - 1.0).max(0.0).sqrt()
            + (ratio * ratio - 2.0) * ratio.max(1.0).recip().acos();
        let hertz = radius * radius / (PI * ball) * opened;
        assert!(
            (gap - hertz).abs() < 0.02 * largest,
            "{gap:e}, not {hertz:e}"
        );
    }
}

#[test]
fn it_is_there_where_it_is_asked_for_and_known() {
    let folder = Folder::new("gap_asked_for");
    let with = folder.solved("IN/sphere-standard-solid.toml");
    let text = fs::read_to_string(example("sphere-standard-solid.toml")).expect("a scene");
    let scene: Scene = text.parse().expect("a scene");
    let without = solve(&Problem::try_from(&scene).expect("a problem")).expect("an answer");
    assert_eq!(without.fields.gap, None, "nobody asked");
    let asked = with.answer.fields;
    assert_eq!(asked.pressure, without.fields.pressure, "the same contact");
    assert!(asked.gap.is_some(), "it was asked for");
    let closed = folder.solved("IN/hertz.toml").answer;
    assert_eq!(closed.fields.gap, None, "closed forms have none");
}
