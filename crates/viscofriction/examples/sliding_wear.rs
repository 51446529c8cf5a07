//! Archard's wear of a ball that reciprocates on a rubber: per distance, its surface loses the depth k p, with the pressure p.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use viscofriction::bem_halfspace::{Grid, SlidingLoad, steady};
use viscofriction::indenters::HeightMap;
use viscofriction::rheology::{StandardSolid, StandardSolidParameters};

/// Heights along an edge, and their distance, \[m].
const N: usize = 31;
const SPACING: f64 = 8e-5;
/// Radius of the ball, \[m].
const RADIUS: f64 = 5e-3;
/// Normal force \[N] and speed \[m/s].
const FORCE: f64 = 0.1;
const VELOCITY: f64 = 0.1;
/// k times the length of a stroke, which is much longer than the contact, \[m/Pa].
///
/// One stroke must not wear off more than the shortest waves of the heights, π/Δx √2, under their own pressure 2 G q h.
const DEPTH_PER_PRESSURE: f64 = 1e-12;
const STROKES: usize = 10;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rubber = StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: 1e6,
        maxwell_modulus: 1e7,
        viscosity: 1e4,
    })?;
    let load = SlidingLoad::new(FORCE, VELOCITY)?;
    let grid = Grid::new([N; 2], [SPACING; 2])?;
    let place = |index: usize| (index as f64 - 0.5 * (N as f64 - 1.0)) * SPACING;
    let ball =
        |index: usize| (place(index / N).powi(2) + place(index % N).powi(2)) / (2.0 * RADIUS);
    let mut gaps: Vec<f64> = (0..N * N).map(ball).collect();
    for stroke in 1..=STROKES {
        // The pressure of a stationary stroke stays where it is on the body.
        let map = HeightMap::from_gaps([N; 2], [SPACING; 2], gaps.clone())?;
        let state = steady(&map, &rubber, &load, 5e-2)?;
        let [[rear, _], [side, _]] = map.extent();
        let pressure = state.finest.pressure.resampled(&grid, [rear, side]);
        for (gap, pressure) in gaps.iter_mut().zip(&pressure.pressure) {
            *gap += DEPTH_PER_PRESSURE * pressure;
        }
        println!(
            "stroke {stroke}: μ = {}, area {} m²",
            state.friction_coefficient, state.contact_area
        );
        // On the way back the rear of the body is its front: x changes its sign.
        gaps = gaps.chunks(N).rev().flatten().copied().collect();
    }
    // The worn volume is k F_N s exactly, because the resampled pressure carries the whole force.
    let volume: f64 = (0..N * N)
        .map(|index| gaps[index] - ball(index))
        .sum::<f64>()
        * SPACING
        * SPACING;
    let archard = DEPTH_PER_PRESSURE * FORCE * STROKES as f64;
    println!("worn volume {volume:.4e} m³, k F_N s {archard:.4e} m³");
    assert!((volume / archard - 1.0).abs() < 1e-6, "the volume is exact");
    Ok(())
}
