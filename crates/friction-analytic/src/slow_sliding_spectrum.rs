//! Frequencies at which a slowly sliding body strains a solid half space, weighted by the squared pressure.
//!
//! The pressure is that of the elastic contact. Its two-dimensional Fourier transform is the cosine transform of the load on
//! the equivalent line. A wave of length 2π/q at an angle θ to the motion oscillates at q v cos θ:
//!
//! ```text
//! p̂(q) ∝ ∫₀^a [h̃(a) − h̃(x)] cos(qx) dx,        F_h v ∝ ∫∫ |p̂(q)|² ω J''(ω) dq dθ
//! ```

use std::f64::consts::FRAC_PI_2;

use indenters::Axisymmetric;
use rheology::StressBand;

use crate::ElasticContact;

/// Number of midpoints of the load on the equivalent line, in the cosine transform: 25 per wave at the largest of
/// [`WAVE_NUMBER_DECADES`].
const LOAD_POINTS: u32 = 400;
/// Number of angles θ in a quarter turn. Chosen: neighbouring frequencies v q cos θ then differ by far less than a decade over
/// most of the turn. The spectrum weighs frequencies by decades, and is no part of a bar.
const ANGLES: u32 = 32;
/// Decadic logarithms of the smallest and the largest wave number times the contact radius. Derived for cone and paraboloid:
/// shorter waves dissipate at most 1 % of the energy, namely where ω J'' grows with the square of ω, and longer waves 0.5 %,
/// where ω J'' is constant.
const WAVE_NUMBER_DECADES: [f64; 2] = [-2.0, 2.0];
/// Number of wave numbers, equally spaced in their logarithm: 25 per decade. Chosen: the spectrum weighs frequencies
/// by decades, and is no part of a bar.
const WAVE_NUMBERS: u32 = 100;

/// Frequencies \[rad/s] at which the elastic contact strains the half space, with weights proportional to |p̂|² dq dθ.
pub fn slow_sliding_spectrum(body: &dyn Axisymmetric, contact: ElasticContact) -> Vec<StressBand> {
    let ElasticContact {
        contact_radius: radius,
        velocity,
    } = contact;
    let midpoints = |count: u32| (0..count).map(move |k| (f64::from(k) + 0.5) / f64::from(count));
    // `loads` holds the load divided by its maximum, at positions divided by the contact radius.
    let depth = body.line_height(radius);
    let loads: Vec<[f64; 2]> = midpoints(LOAD_POINTS)
        .map(|x| [x, 1.0 - body.line_height(x * radius) / depth])
        .collect();
    let [first, last] = WAVE_NUMBER_DECADES;
    let wave_number = |part: f64| 10_f64.powf(first + part * (last - first));
    let mut bands = Vec::new();
    // `q` is the wave number times the contact radius.
    for q in midpoints(WAVE_NUMBERS).map(wave_number) {
        // `power` is the squared cosine transform of the load, up to a constant factor.
        let products = loads.iter().map(|[x, load]| load * (q * x).cos());
        let power = products.sum::<f64>().powi(2);
        bands.extend(midpoints(ANGLES).map(|turn| StressBand {
            band: [q / radius * velocity * (turn * FRAC_PI_2).cos(); 2],
            // Equal spacing in the logarithm makes dq proportional to q.
            weight: power * q,
        }));
    }
    bands
}
