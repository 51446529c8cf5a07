//! At which frequencies a body strains a solid half space over which it slides slowly.
//!
//! The pressure is that of the elastic contact, whose transform is the cosine transform of the load on the equivalent line, and a
//! wave of length 2π/q at an angle θ to the motion oscillates at q v cos θ:
//!
//! ```text
//! p̂(q) ∝ ∫₀^a [h̃(a) − h̃(x)] cos(qx) dx,        F_h v ∝ ∫∫ |p̂(q)|² ω J''(ω) dq dθ
//! ```

use std::f64::consts::FRAC_PI_2;

use indenters::Axisymmetric;
use rheology::StressBand;

use crate::ElasticContact;

/// Points of the load, and of the angles in a quarter turn.
const POINTS: u32 = 400;
const ANGLES: u32 = 32;
/// Waves over the inverse of the radius, of which the others dissipate a hundredth at most, and how many of them are taken.
const DECADES: [f64; 2] = [-2.0, 2.0];
const WAVES: u32 = 100;

/// The frequencies of the elastic contact, [rad/s].
pub fn slow_spectrum(body: &dyn Axisymmetric, contact: ElasticContact) -> Vec<StressBand> {
    let ElasticContact {
        contact_radius: radius,
        velocity,
    } = contact;
    let steps = |count: u32| (0..count).map(move |k| (f64::from(k) + 0.5) / f64::from(count));
    let depth = body.line_height(radius);
    let loads = steps(POINTS).map(|part| [part, 1.0 - body.line_height(part * radius) / depth]);
    let loads: Vec<[f64; 2]> = loads.collect();
    let wave = |part: f64| 10_f64.powf(DECADES[0] + part * (DECADES[1] - DECADES[0]));
    let mut bands = Vec::new();
    for wave in steps(WAVES).map(wave) {
        let products = loads.iter().map(|[x, load]| load * (wave * x).cos());
        let square = products.sum::<f64>().powi(2);
        bands.extend(steps(ANGLES).map(|turn| StressBand {
            band: [wave / radius * velocity * (turn * FRAC_PI_2).cos(); 2],
            // The waves are equally spaced in the logarithm, so that dq is in proportion to q.
            weight: square * wave,
        }));
    }
    bands
}
