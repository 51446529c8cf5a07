//! Inverse Abel transform: the body of revolution of an equivalent line.
//!
//! ```text
//! h(r) = (2 / π) ∫₀^r h̃(x) / √(r² − x²) dx  =  (2 / π) ∫₀^{π/2} h̃(r sin φ) dφ
//! ```

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use crate::{IndenterError, RigidLine};
use numerics::{finite, integrate, positive};

/// Largest number of bisections in search of kinks that the line does not report. Chosen; one kink takes about 30.
const MAX_BISECTIONS: usize = 1000;

/// Height h(r) \[m] of the body of revolution whose equivalent line is the right half of `line`, at a `radius` r > 0 \[m].
///
/// Kinks that the line does not report are found by bisection; reported ones cost nothing. The tolerance bounds the
/// estimated error relative to the integral of |h̃|; 1e-9 is a good value.
///
/// # Errors
/// [`IndenterError::OutOfDomain`] when the line does not reach from 0 to `radius`, `InvalidParameter` when a number is out
/// of its range or a height not finite, `NotConverged` when the tolerance is not reached.
pub fn inverse_abel(
    line: &(impl RigidLine + ?Sized),
    radius: f64,
    relative_tolerance: f64,
) -> Result<f64, IndenterError> {
    let radius = positive("radius", radius)?;
    positive("relative_tolerance", relative_tolerance)?;
    let [lower, upper] = line.domain();
    if lower > 0.0 || radius > upper {
        return Err(IndenterError::OutOfDomain {
            position: if lower > 0.0 { 0.0 } else { radius },
            lower,
            upper,
        });
    }
    let height = |phi: f64| line.height(radius * phi.sin());
    // Split the quarter turn of the integration angle at the reported kinks, because quadrature is accurate only between them.
    let kinks = line.kinks().into_iter();
    let inner = kinks.filter(|kink| *kink > 0.0 && *kink < radius);
    let mut angles = vec![0.0];
    angles.extend(inner.map(|kink| (kink / radius).asin()));
    angles.push(FRAC_PI_2);
    mean_over_angles(height, &angles, relative_tolerance)
}

/// Integral (2 / π) ∫ f dφ from the first to the last angle, with bisection of the intervals that do not converge.
fn mean_over_angles(
    function: impl Fn(f64) -> f64,
    angles: &[f64],
    relative_tolerance: f64,
) -> Result<f64, IndenterError> {
    let piece = |ends: [f64; 2]| integrate(&function, ends, 0.01 * relative_tolerance);
    let mut open: Vec<[f64; 2]> = angles.windows(2).map(|a| [a[0], a[1]]).collect();
    // A rough value of ∫ |f| dφ is the scale of the error.
    let magnitude = |ends: &[f64; 2]| integrate(|phi| function(phi).abs(), *ends, 0.01).value;
    let scale = open.iter().map(magnitude).sum();
    finite("height of the line", scale)?;
    let (mut value, mut error, mut bisections) = (0.0, 0.0, 0);
    while let Some(ends) = open.pop() {
        let integral = piece(ends);
        finite("height of the line", integral.value)?;
        // An interval may take 1 % of the tolerance: the number of intervals around a kink grows with the logarithm of
        // the accuracy.
        if integral.error > 0.01 * relative_tolerance * scale && bisections < MAX_BISECTIONS {
            let middle = 0.5 * (ends[0] + ends[1]);
            open.extend([[ends[0], middle], [middle, ends[1]]]);
            bisections += 1;
            continue;
        }
        value += integral.value;
        error += integral.error;
    }
    if error > relative_tolerance * scale {
        return Err(IndenterError::NotConverged {
            value: FRAC_2_PI * value,
            reached: error / scale,
            relative_tolerance,
        });
    }
    Ok(FRAC_2_PI * value)
}
