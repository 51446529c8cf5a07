//! How deep a steel ball sinks into a viscous floor, and how long it takes to a given depth.
#![expect(clippy::print_stdout, reason = "an example shows what it found")]

use friction_analytic::{impulse_to_depth, indentation_after_impulse};
use indenters::Sphere;
use rheology::Viscous;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ball = Sphere::new(5e-3)?;
    let pitch = Viscous::new(2e8)?; // shear viscosity [Pa s]
    let force = 0.04; // its weight [N]
    for hours in [1.0, 6.0, 24.0] {
        let contact = indentation_after_impulse(&ball, &pitch, force * 3600.0 * hours)?;
        println!(
            "after {hours:6} h: {:.2} mm deep, contact radius {:.2} mm",
            1e3 * contact.indentation_depth,
            1e3 * contact.contact_radius
        );
    }
    let depth = 1e-4;
    let time = impulse_to_depth(&ball, &pitch, depth)? / force;
    let contact = indentation_after_impulse(&ball, &pitch, force * time)?;
    let reached = contact.indentation_depth;
    assert!(
        (reached / depth - 1.0).abs() < 1e-10,
        "{reached} m instead of {depth} m"
    );
    Ok(())
}
