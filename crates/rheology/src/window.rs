//! Which part of a dissipated power comes from frequencies at which a material was not measured.
//!
//! In a stationary state every wave of the stress oscillates at one frequency, and dissipates in proportion to its square and to
//! ω J''(ω). Over a band in which the square has a constant density
//!
//! ```text
//! ∫ ω J''(ω) dω = ω/η_f + Σ J_k/λ_k² (x − atan x),        x = ω λ_k
//! ```

use numerics::fourier_power;

use crate::CreepSpectrum;

/// Waves per decade of the spectrum along a line; the longest over the length of the contact or of the slowest retardation, and
/// the shortest over the shortest distance of two points, beyond which jumps have a thousandth of their power.
const PER_DECADE: f64 = 40.0;
const LONGEST: f64 = 1e-2;
const SHORTEST: f64 = 1e2;

/// What the stress of a stationary state has at some angular frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressBand {
    /// Lowest and highest of them, \[rad/s]; the same twice for one wave.
    pub band: [f64; 2],
    /// Square of the stress times the compliance of the body over that of the material, in any unit: its mean density over
    /// the band times the width, or that of the one wave.
    pub weight: f64,
}

/// Parts of a dissipated power that come from outside of a window of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutsideWindow {
    /// From below it, 0 to 1.
    pub below: f64,
    /// From above it, 0 to 1.
    pub above: f64,
}

impl CreepSpectrum {
    /// The parts of the dissipated power that come from below and above a `window` of angular frequencies \[rad/s]; none where
    /// nothing is dissipated.
    pub fn outside_window(
        &self,
        [lowest, highest]: [f64; 2],
        bands: impl IntoIterator<Item = StressBand>,
    ) -> Option<OutsideWindow> {
        let [mut below, mut above, mut all] = [0.0; 3];
        for StressBand { band, weight } in bands {
            let [start, end] = band;
            let width = end - start;
            let part = |[from, to]: [f64; 2]| {
                if width > 0.0 {
                    weight / width * (self.loss_integral(to) - self.loss_integral(from))
                } else {
                    weight * self.loss_rate(from)
                }
            };
            all += part(band);
            if end <= lowest {
                below += part(band);
            } else if start < lowest {
                below += part([start, lowest]);
            }
            if start >= highest && end > lowest {
                above += part(band);
            } else if end > highest {
                above += part([start.max(highest), end]);
            }
        }
        let share = |part: f64| (part / all).clamp(0.0, 1.0);
        (all > 0.0 && all.is_finite()).then(|| OutsideWindow {
            below: share(below),
            above: share(above),
        })
    }

    /// The frequencies of a stationary load per length that slides at a `velocity` \[m/s]: straight between `points` of
    /// increasing positions \[m], with a `compliance` that depends on the wave number [1/m], in any unit.
    pub fn bands_along(
        &self,
        points: &[[f64; 2]],
        velocity: f64,
        compliance: impl Fn(f64) -> f64,
    ) -> Vec<StressBand> {
        let steps = points.windows(2).map(|pair| pair[1][0] - pair[0][0]);
        let shortest = steps.clone().filter(|step| *step > 0.0);
        let shortest = SHORTEST / shortest.fold(f64::INFINITY, f64::min);
        let slowest = self.elements().last().map(|one| one.retardation_time);
        let length = steps.sum::<f64>();
        let longest = LONGEST / length.max(velocity * slowest.unwrap_or(0.0));
        let step = 10_f64.powf(PER_DECADE.recip());
        let waves = std::iter::successors(Some(longest), |wave| Some(wave * step));
        // As wide as the waves are apart, around their middle.
        let ends = [step.sqrt().recip(), step.sqrt()].map(|end| end * velocity);
        let band = |wave: f64| StressBand {
            band: ends.map(|end| end * wave),
            weight: fourier_power(points, wave) * (compliance(wave) * wave),
        };
        waves.take_while(|w| *w < shortest).map(band).collect()
    }

    /// ω J''(ω).
    fn loss_rate(&self, omega: f64) -> f64 {
        let elements = self.elements().iter();
        let rates = elements.map(|element| {
            let x = omega * element.retardation_time;
            element.compliance * omega * (x / (1.0 + x * x))
        });
        self.fluidity() + rates.sum::<f64>()
    }

    /// ∫ ω J'' dω from zero.
    fn loss_integral(&self, omega: f64) -> f64 {
        let elements = self.elements().iter();
        let integrals = elements.map(|element| {
            let time = element.retardation_time;
            element.compliance * (above_its_angle(omega * time) / time / time)
        });
        self.fluidity() * omega + integrals.sum::<f64>()
    }
}

/// x − atan x for x ≥ 0, of which little is left where x is small: there the series, to 1e-9.
fn above_its_angle(x: f64) -> f64 {
    if x > 0.1 {
        return x - x.atan();
    }
    let square = x * x;
    x * square * (1.0 / 3.0 - square * (0.2 - square * (1.0 / 7.0 - square / 9.0)))
}
