//! Hertz: an elastic half space under a paraboloid, with the largest pressure and its error.

#![expect(clippy::print_stdout, reason = "an example shows its results")]

use bem_halfspace::press;
use indenters::{Control, PowerProfile};
use rheology::Elastic;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // h = r²/(2R) with R = 5 mm, on a rubber of 1 MPa, under 2 N.
    let (radius, modulus, force) = (5e-3, 1e6, 2.0);
    let ball = PowerProfile::paraboloid(0.5 / radius)?;
    let contact = press(
        &ball,
        &Elastic::new(modulus)?,
        Control::NormalForce(force),
        1e-3,
    )?;

    let a = (3.0 * force * radius / (16.0 * modulus)).cbrt();
    let exact = 1.5 * force / (std::f64::consts::PI * a * a);
    let peak = contact
        .peak_pressure
        .ok_or("a smooth body has a largest pressure")?;
    println!(
        "largest pressure {:.5e} ± {:.1e} Pa, Hertz {exact:.5e} Pa",
        peak.value, peak.error
    );
    let depth = contact.indentation_depth.ok_or("no depth")?;
    println!("depth {:.5e} ± {:.1e} m", depth.value, depth.error);
    assert!((peak.value - exact).abs() <= peak.error, "the bar holds");
    Ok(())
}
