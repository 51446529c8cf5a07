//! Curves of force over depth of known materials.

use friction_analytic::{BondedLayer, LayerProfile};
use indenters::{Axisymmetric, Control, HistoryPoint, Sphere};
use mdr_core::{HistoryOptions, indent_along};
use measurements::indentation::{
    FitOptions, IndentationCurve, IndentationFit, Rheology, Thickness, fit_indentation,
};
use rheology::{Prony, RelaxationBranch, RelaxationSpectrum, Springpot};

use crate::support::Normal;

/// A body on a known material; contact point, baseline and tilt of its curves are always the same.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) body: Box<dyn Axisymmetric>,
    /// Thickness of the sample, if it is not a half space, \[m].
    pub(crate) thickness: Option<f64>,
    pub(crate) material: Prony,
    pub(crate) rheology: Rheology,
    /// In the order of the findings.
    pub(crate) truth: Vec<f64>,
}

pub(crate) const CONTACT_POINT: f64 = 0.437e-6;
const BASELINE: f64 = 2e-10;
pub(crate) const TILT: f64 = -1e-5;

impl Case {
    /// The moduli and times of a series, or G(1 s) and the exponent of a power law.
    pub(crate) fn new(
        name: &'static str,
        body: impl Axisymmetric + 'static,
        of_material: &[f64],
    ) -> Self {
        let (spectrum, rheology) = if of_material[1] < 1.0 {
            let unit = Springpot::new(1.0, of_material[1]).expect("a springpot");
            let coefficient = of_material[0] / unit.relaxation_modulus(1.0).expect("a modulus");
            let pot = Springpot::new(coefficient, of_material[1]).expect("a springpot");
            let expansion = pot.expand([1e-3, 1e5], 1e-6).expect("an expansion");
            (expansion.spectrum, Rheology::PowerLaw)
        } else {
            let branches = of_material[1..]
                .chunks(2)
                .map(|pair| RelaxationBranch::new(pair[0], pair[1]));
            let spectrum = RelaxationSpectrum::new(of_material[0], 0.0, branches.collect());
            (spectrum.expect("a spectrum"), Rheology::StandardSolid)
        };
        Self {
            name,
            body: Box::new(body),
            thickness: None,
            material: Prony::new(spectrum).expect("a material"),
            rheology,
            truth: [of_material, &[CONTACT_POINT, BASELINE, TILT]].concat(),
        }
    }

    /// With white noise of the force alone.
    pub(crate) fn curve(&self, points: usize, level: f64, seed: u64) -> IndentationCurve {
        self.noisy_curve(points, level, &NOISES[0], seed)
    }

    /// The exact force of an approach for a second to 1.5 µm, a dwell, and the way back, and Gaussian noise of a part of its
    /// peak.
    pub(crate) fn noisy_curve(
        &self,
        points: usize,
        level: f64,
        kind: &Noise,
        seed: u64,
    ) -> IndentationCurve {
        let time = (0..points).map(|i| 3.0 * i as f64 / (points - 1) as f64);
        let time: Vec<f64> = time.collect();
        let depth = time.iter().map(|t| 1.5e-6 * t.min(1.0).min(3.0 - t));
        let mut depth: Vec<f64> = depth.collect();
        let history = time.iter().zip(&depth).map(|(&time, depth)| HistoryPoint {
            time,
            control: Control::IndentationDepth(depth - CONTACT_POINT),
        });
        let history: Vec<HistoryPoint> = history.collect();
        let follow = |profile| {
            indent_along(
                profile,
                &self.material,
                &history,
                &HistoryOptions::default(),
            )
        };
        let exact = match self.thickness {
            None => follow(&self.body),
            Some(thickness) => follow(&on_layer(&self.body, thickness)),
        };
        let exact = exact.expect("a curve").into_iter().zip(&depth);
        let force =
            exact.map(|(point, d)| point.normal_force.value + BASELINE + TILT * (d - 0.75e-6));
        let mut force: Vec<f64> = force.collect();
        let noise = level * peak(&force);
        let mut normal = Normal(seed);
        let mut last = normal.draw();
        for force in &mut force {
            *force += noise * last;
            let news = (1.0 - kind.correlation * kind.correlation).sqrt();
            last = kind.correlation * last + news * normal.draw();
        }
        change(&mut depth, |depth| {
            depth + 1.5e-6 * kind.depth * normal.draw()
        });
        IndentationCurve { time, depth, force }
    }

    pub(crate) fn fit(&self, curve: &IndentationCurve) -> Result<IndentationFit, String> {
        let rheology = self.rheology;
        let options = FitOptions {
            rheology,
            thickness: self.thickness.map_or(Thickness::Infinite, Thickness::Known),
            ..FitOptions::default()
        };
        fit_indentation(&*self.body, curve, &options).map_err(|error| error.to_string())
    }
}

/// Number of curves of a test: `VISCOFRICTION_CURVES`, if it is set, for the tables of docs/fit-indentation.md.
#[expect(
    clippy::disallowed_methods,
    reason = "the table is for whoever asks for it"
)]
pub(crate) fn n_curves(few: usize) -> usize {
    let given = std::env::var("VISCOFRICTION_CURVES");
    given.map_or(few, |n| n.parse().expect("a number"))
}

/// Writes what a test has counted, for whoever asks for it.
#[expect(
    clippy::disallowed_methods,
    reason = "the table is for whoever asks for it"
)]
pub(crate) fn write_table(name: &str, table: &str) {
    let file = format!("{}/{name}", env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(file, table).expect("the table can be written");
}

fn on_layer(body: &dyn Axisymmetric, thickness: f64) -> LayerProfile {
    let layer = BondedLayer::new(thickness, 0.5).expect("a layer");
    LayerProfile::new(body, &layer, 1.5e-6).expect("a profile")
}

pub(crate) fn peak(force: &[f64]) -> f64 {
    force.iter().copied().fold(0.0, f64::max)
}

pub(crate) fn sphere(of_material: &[f64]) -> Case {
    Case::new("sphere", Sphere::new(5e-6).expect("a sphere"), of_material)
}

/// The contact is 1.4 thicknesses wide.
pub(crate) fn thin() -> Case {
    let ball = Sphere::new(5e-5).expect("a sphere");
    Case {
        thickness: Some(6e-6),
        ..Case::new("sphere, thin sample", ball, &[1e3, 2e3, 0.3])
    }
}

/// Noise of the force, from point to point, and of the depth, in parts of its range.
pub(crate) struct Noise {
    pub(crate) name: &'static str,
    pub(crate) correlation: f64,
    pub(crate) depth: f64,
}

pub(crate) const NOISES: [Noise; 4] = [
    Noise::new("white", 0.0, 0.0),
    Noise::new("correlation 0.9", 0.9, 0.0),
    Noise::new("correlation 0.99", 0.99, 0.0),
    Noise::new("white, depth 0.3 %", 0.0, 0.003),
];

impl Noise {
    pub(crate) const fn new(name: &'static str, correlation: f64, depth: f64) -> Self {
        Self {
            name,
            correlation,
            depth,
        }
    }
}

pub(crate) fn change(numbers: &mut [f64], mut to: impl FnMut(f64) -> f64) {
    numbers.iter_mut().for_each(|number| *number = to(*number));
}
