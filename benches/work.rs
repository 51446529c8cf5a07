//! Time, error, peak memory and iterations of contact solves, and the time as a multiple of one real Fourier transform
//! there and back of the padded grid, measured between the solves.
//!
//! `cargo bench -p benches --bench work -- hertz 256 512` · `… -- hertz-aside 256` · `… -- rough 512 1024`; with
//! `--features rayon` also the time on the wall on two threads. The first has two mirrors, the others have none. Instead
//! of a number of elements along the edge, `rough` takes a file with the heights of a square grid on a side of length 1
//! as little-endian numbers of eight bytes.

#![expect(clippy::print_stdout, reason = "the table is the purpose")]

use std::fs;
use std::time::Instant;

use bem_halfspace::{Contact, ContactState, Convolution, Grid};
use benches::{ContactScene, Failure, report_each, rough_heights, with_memory};
use casebook::deviation;
use cpu_time::ThreadTime;

const COLUMNS: &str = "scene n iterations error bytes/element setup[s] solve[s] pair[s] \
                       solve/pair wall[s]";
const REFERENCE_TOLERANCE: f64 = 1e-12;
const REPETITIONS: usize = 3;
/// Solves on the wall are repeated at least that long, because other guests of the machine disturb short ones more, \[s].
const WALL_TIME: f64 = 5.0;
/// Distance of the apex from the middle, in elements.
const ASIDE: f64 = 0.3;
/// Numbers of threads for which the wall time is measured.
const THREADS: &[usize] = if cfg!(feature = "rayon") {
    &[1, 2]
} else {
    &[1]
};

struct Scene {
    name: &'static str,
    contact: ContactScene,
    /// Reaches an error of the pressure of 1e-8.
    tolerance: f64,
    /// Time to make heights and convolution, \[s].
    setup: f64,
    /// Edge of the grid that the transforms of a plain solver have.
    padded: usize,
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.split_last() {
        Some((&"--bench", [name, sizes @ ..])) if !sizes.is_empty() => {
            println!("{COLUMNS} on {THREADS:?} threads");
            report_each(&[name], sizes)
        }
        Some((size, [name])) => on_threads(1, || report(&scene(name, size)?))?,
        _ => on_threads(1, || report(&scene("hertz", "256")?))?,
    }
}

fn scene(name: &str, size: &str) -> Result<Scene, Failure> {
    match (name, size.parse()) {
        ("hertz", Ok(n)) => hertz("hertz", n, 0.0),
        ("hertz-aside", Ok(n)) => hertz("hertz-aside", n, ASIDE),
        ("rough", Ok(n)) => rough(rough_heights(n, 1)?),
        ("rough", Err(_)) => rough(heights_in(size)?),
        _ => Err(format!("there is no scene {name} {size}").into()),
    }
}

fn hertz(name: &'static str, n: usize, offset: f64) -> Result<Scene, Failure> {
    let start = ThreadTime::now();
    Ok(Scene {
        name,
        contact: ContactScene::hertz(n, offset)?,
        setup: start.elapsed().as_secs_f64(),
        tolerance: 5e-10,
        padded: 2 * n,
    })
}

fn rough(heights: Vec<f64>) -> Result<Scene, Failure> {
    let n = heights.len().isqrt();
    let start = ThreadTime::now();
    Ok(Scene {
        name: "rough",
        contact: ContactScene::periodic(heights)?,
        setup: start.elapsed().as_secs_f64(),
        tolerance: 5e-9,
        padded: n,
    })
}

fn heights_in(file: &str) -> Result<Vec<f64>, Failure> {
    let bytes = fs::read(file)?;
    let (numbers, _) = bytes.as_chunks::<8>();
    Ok(numbers
        .iter()
        .map(|bytes| -f64::from_le_bytes(*bytes))
        .collect())
}

fn solve(scene: &Scene, tolerance: f64) -> Result<(Contact, ContactState, f64), Failure> {
    let start = ThreadTime::now();
    let (contact, state) = scene.contact.solve(tolerance)?;
    Ok((contact, state, start.elapsed().as_secs_f64()))
}

fn report(scene: &Scene) -> Result<(), Failure> {
    let grid = scene.contact.convolution.grid();
    let (solved, bytes) = with_memory(|| solve(scene, scene.tolerance))?;
    let bytes = bytes / grid.n_elements() as f64;
    let (contact, state, mut fastest) = solved;
    let mut pair = f64::INFINITY;
    for _ in 0..REPETITIONS {
        pair = pair.min(transform_pair(scene.padded)?);
        fastest = fastest.min(solve(scene, scene.tolerance)?.2);
    }
    let (_, reference, _) = solve(scene, REFERENCE_TOLERANCE)?;
    let error = deviation(state.pressure(), reference.pressure());
    drop((state, reference));
    println!(
        "{} {} {} {error:.1e} {bytes:.0} {:.3} {fastest:.4} {pair:.4} {:.1} {:.3?}",
        scene.name,
        grid.shape()[0],
        contact.iterations,
        scene.setup,
        fastest / pair,
        wall_times(scene)?,
    );
    Ok(())
}

/// Shortest times on the wall, \[s], one per number of threads, which take turns.
fn wall_times(scene: &Scene) -> Result<Vec<f64>, Failure> {
    let mut shortest = vec![f64::INFINITY; THREADS.len()];
    let (begin, mut turns) = (Instant::now(), 0);
    while turns < REPETITIONS || begin.elapsed().as_secs_f64() < WALL_TIME {
        for (&threads, shortest) in THREADS.iter().zip(&mut shortest) {
            let start = Instant::now();
            on_threads(threads, || solve(scene, scene.tolerance).map(drop))??;
            *shortest = shortest.min(start.elapsed().as_secs_f64());
        }
        turns += 1;
    }
    Ok(shortest)
}

/// Time of a real transform there and back, with a multiplication between, of a grid with this edge, \[s].
fn transform_pair(edge: usize) -> Result<f64, Failure> {
    let convolution = Convolution::periodic(&Grid::new([edge; 2], [1.0; 2])?);
    let mut workspace = convolution.workspace();
    let values = vec![1.0; edge * edge];
    let mut result = vec![0.0; edge * edge];
    let (start, mut pairs) = (ThreadTime::now(), 0.0);
    let mut spent = 0.0;
    // Longer than the steps in which the system counts.
    while spent < 0.2 {
        convolution.apply(&mut workspace, &values, &mut result);
        pairs += 1.0;
        spent = start.elapsed().as_secs_f64();
    }
    Ok(spent / pairs)
}

/// Does the work in a pool of `threads` threads.
#[cfg(feature = "rayon")]
fn on_threads<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> Result<R, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    Ok(pool.build()?.install(work))
}

/// Does the work on one thread.
#[cfg(not(feature = "rayon"))]
fn on_threads<R>(_: usize, work: impl FnOnce() -> R) -> Result<R, Failure> {
    Ok(work())
}
