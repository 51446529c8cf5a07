//! The material behind a measured force–indentation curve, with intervals that hold.
//!
//! ```text
//! F_i = F(t_i; d − z₀, G) + b + c (d_i − d̄) + noise
//! ```
//! with the force of the one-dimensional model, which is exact for bodies of revolution: contact point z₀, baseline b and
//! tilt c are fitted with the material. A curve that is damaged is refused with a reason, or flagged.

mod afmformats;
mod checks;
mod depth;
mod flag;
mod igor;
mod intervals;
mod join;
mod judgement;
mod means;
mod model;
mod noise;
mod note;
mod pull_in;
mod read;
mod sample;
mod search;
mod start;

use indenters::Axisymmetric;
use mdr_core::MdrError;
use rheology::Prony;

use crate::{Finding, MeasurementError};
pub use flag::Flag;
pub(crate) use noise::correlated_points;
pub use note::Note;
pub use read::{CurveFile, CurveOptions, indentation_curve};

/// What was measured, one value per point, in SI.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct IndentationCurve {
    /// Time t, increasing, \[s].
    pub time: Vec<f64>,
    /// Position of the lowest point of the body, larger towards the sample, from any zero, \[m].
    pub depth: Vec<f64>,
    /// Force on the sample, from any zero, \[N].
    pub force: Vec<f64>,
}

impl IndentationCurve {
    /// The first points.
    fn first(&self, n: usize) -> Self {
        self.map(|values| values[..n].to_vec())
    }

    /// At most about so many points, and the last one.
    fn decimated(&self, most: usize) -> Self {
        let last = self.time.len() - 1;
        let inner = || (0..last).step_by((last / most).max(1));
        self.map(|values| inner().chain([last]).map(|i| values[i]).collect())
    }

    fn map(&self, column: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        Self {
            time: column(&self.time),
            depth: column(&self.depth),
            force: column(&self.force),
        }
    }
}

/// The material that is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Rheology {
    /// G(t) = G.
    Elastic,
    /// G(t) = G_∞ + G₁ e^(−t/τ).
    StandardSolid,
    /// G(t) = G_∞ + Σ G_k e^(−t/τ_k).
    Prony,
    /// G(t) = G₁ (t/1 s)^−β.
    PowerLaw,
}

/// How thick a sample is; one of a finite thickness is bonded to a rigid base.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Thickness {
    /// So thick that it is a half space.
    #[default]
    Infinite,
    /// Greater than 0, \[m].
    Known(f64),
    /// Found with the material.
    Fitted,
}

/// How a curve is fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// The material.
    pub rheology: Rheology,
    /// Branches of [`Rheology::Prony`], 1 to 6; none: as many as Schwarz's information criterion takes.
    pub branches: Option<usize>,
    /// Poisson ratio ν, −1 < ν ≤ 1/2.
    pub poisson_ratio: f64,
    /// Thickness of the sample.
    pub thickness: Thickness,
    /// Whether the force without contact may depend on the depth.
    pub tilt: bool,
    /// Whether the points after the deepest one are left out, where a body may stick.
    pub before_retraction: bool,
    /// Whether all intervals are those of the profile likelihood, and not only those that a covariance cannot give.
    pub profile: bool,
}

impl Default for FitOptions {
    /// A standard solid that is incompressible and thick, with a tilted baseline, from the whole curve.
    fn default() -> Self {
        Self {
            rheology: Rheology::StandardSolid,
            branches: None,
            poisson_ratio: 0.5,
            thickness: Thickness::Infinite,
            tilt: true,
            before_retraction: false,
            profile: false,
        }
    }
}

/// A material found in a curve.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct IndentationFit {
    /// Material, contact point, baseline and tilt; the material is elastic where the curve does not determine how it relaxes.
    pub findings: Vec<Finding>,
    /// Correlation of the errors of the findings (of the logarithms of moduli and times).
    pub correlation: Vec<Vec<f64>>,
    /// The material, of a power law its expansion over the times of the curve.
    pub material: Prony,
    /// The lowest and the highest angular frequency that the curve tells of: one over its whole time, and over its shortest step,
    /// \[rad/s].
    pub valid_frequencies: [f64; 2],
    /// Standard deviation of the force about the fit, by the median, \[N]: of the points before the contact, where there are
    /// at least 10, and of all.
    pub noise: Option<f64>,
    /// Of all points, \[N].
    pub residual: f64,
    /// How many points one independent point stands for, at least 1.
    pub correlated_points: f64,
    /// The points that were fitted, of many thousands means of neighbours: time, depth (smoothed where it is noisy), force and
    /// force of the fit.
    pub points: Vec<[f64; 4]>,
    /// What is doubtful about it.
    pub flags: Vec<Flag>,
    /// What was decided for the caller.
    pub notes: Vec<Note>,
}

/// Finds the material behind a curve.
///
/// # Errors
/// [`MeasurementError`] with the reason.
pub fn fit_indentation(
    body: &dyn Axisymmetric,
    curve: &IndentationCurve,
    options: &FitOptions,
) -> Result<IndentationFit, MeasurementError> {
    check(curve, options)?;
    let measured =
        checks::usable(curve, options.before_retraction).map_err(MeasurementError::Damaged)?;
    let curve = &measured.curve;
    checks::scale(body, curve).map_err(MeasurementError::Damaged)?;
    let jump = pull_in::flag(&measured).map_err(MeasurementError::Damaged)?;
    let sample = sample::Sample::new(body, curve, options)?;
    let begin = start::start(&sample, curve, options)?;
    checks::before(&measured, &begin).map_err(MeasurementError::Damaged)?;
    let found = search::search(&sample, &measured, options, &begin)?;
    let statistics = intervals::Statistics::of(&found)?;
    let judgement = judgement::Judgement::new(&found, &begin, &statistics);
    let mut flags: Vec<Flag> = jump.into_iter().collect();
    flags.extend(judgement.flags().map_err(MeasurementError::Damaged)?);
    flags.extend(sample.too_deep(&found));
    let spectrum = found.model.spectrum(&found.parameters);
    let material = spectrum.and_then(Prony::new).map_err(MdrError::from)?;
    let findings = statistics.findings(&found, options.profile);
    // More branches than a curve has are none of them determined, but its contact point is.
    let with_contact_point = &findings[..=found.model.contact_point()];
    if with_contact_point.iter().all(|one| one.estimate.is_none()) {
        return Err(MeasurementError::NotDetermined);
    }
    let [shortest, longest] = found.model.times;
    let residuals = statistics.forces.residuals.iter().enumerate();
    let points = residuals.map(|(i, residual)| {
        let force = curve.force[i];
        [curve.time[i], curve.depth[i], force, force - residual]
    });
    Ok(IndentationFit {
        findings,
        correlation: statistics.correlation(),
        material,
        valid_frequencies: [longest.recip(), shortest.recip()],
        noise: judgement.noise,
        residual: found.squares.scale,
        correlated_points: statistics.correlated_points,
        points: points.collect(),
        flags,
        notes: note::of_material(options, &found).into_iter().collect(),
    })
}

/// Whether options and lengths of columns are in their ranges.
fn check(curve: &IndentationCurve, options: &FitOptions) -> Result<(), MeasurementError> {
    crate::moduli::shear_per_tension(options.poisson_ratio)?;
    if let Thickness::Known(thickness) = options.thickness {
        numerics::positive("thickness", thickness)?;
    }
    let n = curve.time.len();
    for (name, other) in [("depths", &curve.depth), ("forces", &curve.force)] {
        let holds = other.len() == n;
        numerics::in_range(name, other.len() as f64, holds, "as many as times")?;
    }
    if let Some(branches) = options.branches {
        let holds = (1..=search::MAX_BRANCHES).contains(&branches);
        numerics::in_range("branches", branches as f64, holds, "from 1 to 6")?;
    }
    Ok(())
}
