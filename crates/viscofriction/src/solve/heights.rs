//! The rigid body of a height map, with plausibility checks of its units and edges.

use indenters::rough::PeriodicSurface;
use indenters::topography::{LateralUnit, Topography};
use indenters::{HeightMap, IndenterError};
use numerics::whole_part;

use super::body::{Body, BodyOfScene};
use crate::scene::{Edges, HeightMapTable, SceneError};

/// Rms slope above which a warning says that the unit of the heights is probably wrong. Chosen: linear theory needs slopes
/// far below 1, and rough surfaces in contact rarely have steeper ones.
pub(super) const MAX_RMS_SLOPE: f64 = 1.0;
/// Rms slope below which a warning says that the unit of heights or distances is probably wrong. Chosen: optical flats have 1e-5.
const MIN_RMS_SLOPE: f64 = 1e-5;
/// Length of a map, \[m], above which a warning says that the unit of its distances is probably wrong. Chosen: instruments
/// that measure roughness scan less.
const MAX_PERIOD: f64 = 1.0;
/// Fraction of the heights that were missing and have been filled in, above which a warning is given. Chosen: so few heights
/// hardly change the friction, wherever they are.
const MAX_FILLED_FRACTION: f64 = 0.01;
/// Largest fraction of the mean square slope that the step at the edge of a periodic map may contribute without a warning.
/// Chosen: a larger step contributes more than the surface itself.
const MAX_STEP_FRACTION: f64 = 0.5;

/// Builds the rigid body from measured heights, given by a scene or an array.
///
/// # Errors
/// [`SceneError`] for the first key that does not match the heights.
pub fn body_of_heights(
    table: &HeightMapTable,
    surface: Topography,
) -> Result<BodyOfScene, SceneError> {
    let key = |key: &str| format!("indenter.height-map.{key}");
    let in_file = |problem: String| {
        let file = table.file.display();
        SceneError::at(key("file"), format!("{file}: {problem}"))
    };
    let surface = table.prepared(surface)?;
    let map = surface.body().map_err(|error| in_file(error.to_string()))?;
    let mut warnings = warnings(table, &surface, &map, &Advice::SCENE);
    warnings.extend(surface.notes.iter().cloned());
    if table.edges == Edges::Mirrored {
        let [x, y] = surface.periods().map(|period| 2.0 * period);
        warnings.push(format!(
            "forces and areas are those of the map with its three mirror images, {x:.3e} m × {y:.3e} m, and four times those of \
             the map alone; pressures, parts and friction coefficients are the same"
        ));
    }
    let periodic = |map: &HeightMap| {
        let shortest = table.shortest_wavelength.unwrap_or(0.0);
        let waves = PeriodicSurface::from_map(map, shortest);
        waves.map_err(|error| match error {
            IndenterError::InvalidParameter(refused)
                if refused.parameter == "shortest_wavelength" =>
            {
                SceneError::within("indenter.height-map", refused)
            }
            other => in_file(other.to_string()),
        })
    };
    let body = match table.edges {
        Edges::Periodic => Body::Periodic(periodic(&map)?),
        Edges::Mirrored => Body::Periodic(periodic(&map.mirrored())?),
        Edges::Wall if map.extent().into_iter().flatten().any(|end| end == 0.0) => {
            let problem = "the point that touches first lies on the edge of the map, where the contact would end with it; \
                           edges = \"periodic\" repeats the map, and \"mirrored\" its mirror images too";
            return Err(SceneError::at(key("file"), problem));
        }
        Edges::Wall => Body::HeightMap(map),
    };
    Ok(BodyOfScene { body, warnings })
}

/// Advice about implausible heights, in the terms of the caller's input.
#[derive(Debug, Clone, Copy)]
pub struct Advice {
    /// Advice if the unit of the heights is probably wrong.
    pub unit: &'static str,
    /// Advice if the unit of the distances is probably wrong.
    pub lateral_unit: &'static str,
    /// Advice if a periodic map has a step at its edge.
    pub step: &'static str,
}

impl Advice {
    /// Advice in the keys of a scene file.
    pub const SCENE: Self = Self {
        unit: "unit = \"mm\", \"um\" or \"nm\" says another one",
        lateral_unit: "lateral_unit = \"mm\", \"um\" or \"nm\" says another one of x and y in files, and a spacing is in m",
        step: "level = true takes a tilt out, and edges = \"mirrored\" has no step",
    };
}

/// Warnings about implausible heights, with the numbers.
pub fn warnings(
    table: &HeightMapTable,
    surface: &Topography,
    map: &HeightMap,
    advice: &Advice,
) -> Vec<String> {
    let mut warnings = units_without_effect(table, surface);
    let (points, filled) = (surface.heights.len(), surface.n_filled);
    if filled as f64 > MAX_FILLED_FRACTION * points as f64 {
        let part = 100.0 * filled as f64 / points as f64;
        warnings.push(format!(
            "{part:.1} % of the heights were missing and are filled from their neighbours, smoother than a surface: {filled} of {points}"
        ));
    }
    warnings.extend(unit_warnings(table, surface, map, advice));
    if table.edges == Edges::Periodic {
        for (axis, name) in ["x", "y"].into_iter().enumerate() {
            let half = 0.5 * table.shortest_wavelength.unwrap_or(0.0) / map.spacing()[axis];
            let most = (map.shape()[axis] / 2) as f64;
            let steps = Steps::of(map, axis, whole_part(half.round().max(1.0).min(most)));
            warnings.extend(steps.warning(name, advice.step));
        }
    }
    warnings
}

/// Warnings about given units that have no effect because the file states its own.
fn units_without_effect(table: &HeightMapTable, surface: &Topography) -> Vec<String> {
    let is_stated = surface.lateral_unit == LateralUnit::Stated;
    let units = [
        (
            surface.states_unit && table.unit.is_some(),
            "its heights: unit",
        ),
        (
            is_stated && table.lateral_unit.is_some(),
            "x and y: lateral_unit",
        ),
    ];
    let sentence =
        |(_, of): (bool, &str)| format!("the file states the unit of {of} has no effect");
    units
        .into_iter()
        .filter(|(holds, _)| *holds)
        .map(sentence)
        .collect()
}

/// Warnings about an rms slope outside [`MIN_RMS_SLOPE`] to [`MAX_RMS_SLOPE`], and a length above [`MAX_PERIOD`], which suggest
/// a wrong unit.
fn unit_warnings(
    table: &HeightMapTable,
    surface: &Topography,
    map: &HeightMap,
    advice: &Advice,
) -> Vec<String> {
    let [x, y] = map.extent().map(|[from, to]| to - from);
    let slopes = [0, 1].map(|axis| Steps::of(map, axis, 1).rms_slope());
    let slope = slopes[0].hypot(slopes[1]);
    let highest = map.heights().iter().copied().fold(0.0, f64::max);
    // A finite body may be steep far from its contact, so only a height above its width counts.
    let is_steep = slope > MAX_RMS_SLOPE && (table.edges != Edges::Wall || highest > x.max(y));
    let mut sentences = Vec::new();
    if is_steep || slope < MIN_RMS_SLOPE {
        let question = if surface.states_unit {
            "is the unit in the file right?".to_owned()
        } else {
            format!("are they in that unit? {}", advice.unit)
        };
        sentences.push(format!(
            "the heights span {highest:.3e} m over {x:.3e} m × {y:.3e} m, with a root mean square slope of {slope:.3e}: {question}"
        ));
    }
    let [along_x, along_y] = surface.periods();
    if along_x.max(along_y) > MAX_PERIOD {
        let lateral = advice.lateral_unit;
        sentences.push(format!(
            "the map has a period of {along_x:.3e} m × {along_y:.3e} m: are these metres? {lateral}"
        ));
    }
    sentences
}

/// Height differences at a fixed lag along an axis.
struct Steps {
    /// Sum of squared differences inside the map, \[m²], and their number.
    inside: [f64; 2],
    /// Sum of squared differences across the periodic edge, \[m²], and their number.
    across: [f64; 2],
    /// Lag, \[m].
    length: f64,
}

impl Steps {
    /// Height differences between points `lag` points apart along `axis` (0 for x, 1 for y); those across the edge are between
    /// the last and the first points of the periodic map.
    fn of(map: &HeightMap, axis: usize, lag: usize) -> Self {
        let (shape, heights) = (map.shape(), map.heights());
        let stride = [shape[1], 1][axis];
        let mut sums = [[0.0; 2]; 2];
        for (index, height) in heights.iter().enumerate() {
            let ahead = index / stride % shape[axis] + lag;
            let is_across = ahead >= shape[axis];
            let back = if is_across { shape[axis] * stride } else { 0 };
            let sum = &mut sums[usize::from(is_across)];
            sum[0] += (heights[index + lag * stride - back] - height).powi(2);
            sum[1] += 1.0;
        }
        let [inside, across] = sums;
        Self {
            inside,
            across,
            length: lag as f64 * map.spacing()[axis],
        }
    }

    /// Rms slope inside the map, from the difference quotients.
    fn rms_slope(&self) -> f64 {
        let [sum, count] = self.inside;
        (sum / count).sqrt() / self.length
    }

    /// A warning if the step across the edge makes up more than [`MAX_STEP_FRACTION`] of the mean square slope.
    fn warning(&self, axis: &str, advice: &str) -> Option<String> {
        let [inside, across] = [self.inside, self.across].map(|[sum, count]| (sum / count).sqrt());
        let all = self.inside[0] + self.across[0];
        let part = (self.across[0] - inside * inside * self.across[1]) / all;
        (part > MAX_STEP_FRACTION).then(|| {
            format!(
                "{:.0} % of the mean square slope along {axis} belong to the step at the edge of the map, where it is \
                 repeated: {across:.3e} m (root mean square) over {:.3e} m, and {inside:.3e} m elsewhere; {advice}",
                100.0 * part, self.length
            )
        })
    }
}
