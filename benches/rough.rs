//! Products, error, peak memory and time of the stationary sliding of a self-affine surface, and of an
//! elastic contact of it by `solve_contact`.
//!
//! `cargo bench -p benches --bench rough -- 512 1024 2048`; waves from a quarter of the side to eight elements, standard
//! solids with two ratios of moduli at about the speed of the largest friction, a tenth of the area in contact.

#![expect(clippy::print_stdout, reason = "the table is the purpose")]

use std::time::Instant;

use bem_halfspace::periodic::steady_on_grid;
use bem_halfspace::{Grid, PeriodicLoad, PeriodicOptions, PeriodicSliding};
use benches::{ContactScene, Failure, report_each, rough_heights, with_memory};
use casebook::{deviation, prony};

const COLUMNS: &str =
    "n ratio applications error area time[s] bytes/element at-rest[s] sliding/at-rest";
/// Ratio of the moduli, speed, and mean pressure on 512² elements.
const SOLIDS: [[f64; 3]; 2] = [[100.0, 7e-4, 0.26], [1000.0, 3e-4, 1.2]];
/// More waves carry the pressure that closes a tenth of the area, with this power of their number.
const GROWTH: f64 = 0.7;
const RMS_SLOPE: f64 = 0.1;
const TOLERANCE: f64 = 1e-6;
const REFERENCE_TOLERANCE: f64 = 1e-8;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.split_last() {
        Some((&"--bench", sizes)) if !sizes.is_empty() => {
            println!("{COLUMNS}");
            report_each(&[], sizes)
        }
        Some((&size, _)) if size != "--bench" => report(size.parse()?),
        _ => report(256),
    }
}

fn report(n: usize) -> Result<(), Failure> {
    let steep = rough_heights(n, 1)?;
    let heights: Vec<f64> = steep.iter().map(|height| RMS_SLOPE * height).collect();
    let grid = Grid::new([n; 2], [1.0 / n as f64; 2])?;
    let scene = ContactScene::periodic(steep)?;
    let start = Instant::now();
    let _pressed = scene.solve(TOLERANCE)?;
    let at_rest = start.elapsed().as_secs_f64();
    let growth = (n as f64 / 512.0).powf(GROWTH);
    for [ratio, velocity, pressure] in SOLIDS {
        let material = prony([1.0, 0.0], &[(ratio - 1.0, 1.0)]);
        let solve = |velocity: f64, tolerance: f64| -> Result<(PeriodicSliding, f64), Failure> {
            let load = PeriodicLoad::new(pressure * growth, velocity)?;
            let options = PeriodicOptions {
                tolerance,
                ..PeriodicOptions::default()
            };
            let start = Instant::now();
            let solved = steady_on_grid(&grid, &heights, &material, &load, &options)?;
            Ok((solved, start.elapsed().as_secs_f64()))
        };
        let ((solved, time), bytes) = with_memory(|| solve(velocity, TOLERANCE))?;
        let bytes = bytes / grid.n_elements() as f64;
        let (reference, _) = solve(velocity, REFERENCE_TOLERANCE)?;
        let error = deviation(&solved.pressure.pressure, &reference.pressure.pressure);
        println!(
            "{n} {ratio} {} {error:.1e} {:.3} {time:.2} {bytes:.0} {at_rest:.2} {:.1}",
            solved.applications,
            solved.area_fraction,
            time / at_rest
        );
    }
    Ok(())
}
