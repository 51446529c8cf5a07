//! An own surface: implement one trait, with a height and a gradient.
#![expect(clippy::print_stdout, reason = "an example shows what it found")]

use indenters::Surface;

/// A paraboloid that is flatter across the direction of motion, as a barrel-shaped roller.
struct Barrel {
    radii: [f64; 2],
}

impl Surface for Barrel {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        0.5 * (x * x / self.radii[0] + y * y / self.radii[1])
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x / self.radii[0], y / self.radii[1]]
    }
}

fn main() {
    let barrel = Barrel {
        radii: [5e-3, 80e-3],
    };
    // What solvers ask of a surface: here, where it can touch at a depth of 10 µm.
    let [[rear, front], [right, left]] = barrel.extent_below(10e-6);
    println!("from {rear:.2e} to {front:.2e} m along x, {right:.2e} to {left:.2e} m along y");
    for (end, radius) in [(front, 5e-3), (left, 80e-3)] {
        let expected = (2.0 * radius * 10e-6_f64).sqrt();
        assert!(
            (end / expected - 1.0).abs() < 0.1,
            "{end} m instead of {expected} m"
        );
    }
}
