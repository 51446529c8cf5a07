//! Fraction of the dissipated power from frequencies outside the measured window of a material.
//!
//! In a stationary state every wave of the stress oscillates at one frequency and dissipates a power proportional to its square
//! and to ω J''(ω). Over a band in which the square has a constant density
//!
//! ```text
//! ∫ ω J''(ω) dω = ω/η_f + Σ J_k/λ_k² (x − atan x),        x = ω λ_k
//! ```

use numerics::fourier_power;

use crate::{CreepSpectrum, StationaryCreep};

/// Number of waves per decade of the spectrum along a line. Chosen: bands have 6 % in frequency, about which the fractions blur.
const WAVES_PER_DECADE: f64 = 40.0;
/// Smallest wave number of the spectrum of the stress along a line, times the longer of two lengths: that of the contact,
/// and the distance slid in the longest retardation time. Chosen: over longer waves neither stress nor compliance changes,
/// and they dissipate a negligible power.
const MIN_WAVE_NUMBER_FACTOR: f64 = 1e-2;
/// Largest wave number of the spectrum of the stress along a line, times the shortest distance of two points. Chosen: beyond
/// it a jump has a thousandth of its power.
const MAX_WAVE_NUMBER_FACTOR: f64 = 1e2;

/// Spectral weight of the stress of a stationary state in a band of angular frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressBand {
    /// Lowest and highest angular frequency, \[rad/s]; equal for a single wave.
    pub band: [f64; 2],
    /// Integral over the band of the squared stress times the ratio of the compliances of body and material, in any unit.
    pub weight: f64,
}

/// Fractions of the dissipated power from outside a window of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutsideWindow {
    /// Fraction from frequencies below the window, 0 to 1.
    pub below: f64,
    /// Fraction from frequencies above the window, 0 to 1.
    pub above: f64,
}

impl StationaryCreep {
    /// Fractions of the dissipated power from below and above a window of angular frequencies \[rad/s].
    ///
    /// `None` without dissipation.
    pub fn outside_window(
        &self,
        [lowest, highest]: [f64; 2],
        bands: impl IntoIterator<Item = StressBand>,
    ) -> Option<OutsideWindow> {
        let [mut below, mut above, mut all] = [0.0; 3];
        for StressBand { band, weight } in bands {
            let [start, end] = band;
            let width = end - start;
            // Compute the dissipation of a part of the band, or of a single frequency if the band has no width.
            let part = |[from, to]: [f64; 2]| {
                if width > 0.0 {
                    weight / width * (self.loss_integral(to) - self.loss_integral(from))
                } else {
                    weight * self.loss_rate(from)
                }
            };
            all += part(band);
            // Add the parts of the band below and above the window to the two sums.
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

    /// Loss rate ω J''(ω) at an angular frequency \[rad/s], [1/(Pa s)].
    fn loss_rate(&self, omega: f64) -> f64 {
        let rates = self.signed_elements().map(|[compliance, time]| {
            let x = omega * time;
            compliance * omega * (x / (1.0 + x * x))
        });
        self.retarded().fluidity() + rates.sum::<f64>()
    }

    /// Integral ∫ ω J'' dω from zero to an angular frequency \[rad/s], [1/(Pa s²)].
    fn loss_integral(&self, omega: f64) -> f64 {
        let integrals = self.signed_elements().map(|[compliance, time]| {
            compliance * (difference_from_arctangent(omega * time) / time / time)
        });
        self.retarded().fluidity() * omega + integrals.sum::<f64>()
    }

    /// Compliance and time of all elements; the loss of advanced ones has the opposite sign, and so have their compliances here.
    fn signed_elements(&self) -> impl Iterator<Item = [f64; 2]> {
        let retarded = (self.retarded().elements().iter())
            .map(|element| [element.compliance, element.retardation_time]);
        let advanced = self.advanced().iter();
        retarded.chain(advanced.map(|element| [-element.compliance, element.retardation_time]))
    }
}

impl CreepSpectrum {
    /// Bands of the frequencies of a stationary line load that slides at a `velocity` \[m/s].
    ///
    /// The load per length is linear between `points` of increasing positions \[m]. The `compliance` is a function of the wave
    /// number [1/m], in any unit.
    pub fn bands_along(
        &self,
        points: &[[f64; 2]],
        velocity: f64,
        compliance: impl Fn(f64) -> f64,
    ) -> Vec<StressBand> {
        // Take waves from the length of the contact, or of the memory of the material, down to the shortest distance of two
        // points.
        let steps = points.windows(2).map(|pair| pair[1][0] - pair[0][0]);
        let shortest = steps.clone().filter(|step| *step > 0.0);
        let shortest = MAX_WAVE_NUMBER_FACTOR / shortest.fold(f64::INFINITY, f64::min);
        let slowest = self.elements().last().map(|one| one.retardation_time);
        let length = steps.sum::<f64>();
        let longest = MIN_WAVE_NUMBER_FACTOR / length.max(velocity * slowest.unwrap_or(0.0));
        let step = 10_f64.powf(WAVES_PER_DECADE.recip());
        let waves = std::iter::successors(Some(longest), |wave| Some(wave * step));
        // Give each wave a band of frequencies; neighbouring bands meet halfway in the logarithm.
        let ends = [step.sqrt().recip(), step.sqrt()].map(|end| end * velocity);
        let band = |wave: f64| StressBand {
            band: ends.map(|end| end * wave),
            weight: fourier_power(points, wave) * (compliance(wave) * wave),
        };
        waves.take_while(|w| *w < shortest).map(band).collect()
    }
}

/// Difference x − atan x for x ≥ 0; for small x by its power series, with a relative error below 1e-9.
fn difference_from_arctangent(x: f64) -> f64 {
    if x > 0.1 {
        return x - x.atan();
    }
    let square = x * x;
    x * square * (1.0 / 3.0 - square * (0.2 - square * (1.0 / 7.0 - square / 9.0)))
}
