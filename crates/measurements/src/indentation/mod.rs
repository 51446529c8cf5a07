//! Fit of a material to a measured force–indentation curve, with confidence intervals.
//!
//! ```text
//! F_i = F(t_i; d − z₀, G) + b + c (d_i − d̄) + noise
//! ```
//! F is the force of the method of dimensionality reduction, which is exact for bodies of revolution. Contact point z₀,
//! baseline b and tilt c are fitted together with the material. A damaged curve is refused with a reason, or flagged.

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
pub(crate) use read::CURVES;
pub use read::{CurveFile, CurveOptions, indentation_curve};

/// A measured curve in SI units, one value per point.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct IndentationCurve {
    /// Time t, increasing, \[s].
    pub time: Vec<f64>,
    /// Position of the lowest point of the body, increasing towards the sample, with any zero, \[m].
    pub depth: Vec<f64>,
    /// Force on the sample, with any zero, \[N].
    pub force: Vec<f64>,
}

impl IndentationCurve {
    /// The first `n` points.
    fn first(&self, n: usize) -> Self {
        self.map(|values| values[..n].to_vec())
    }

    /// Points at equal index steps, at least `most` of them if there are as many, and the last one.
    fn decimated(&self, most: usize) -> Self {
        let last = self.time.len() - 1;
        let inner = || (0..last).step_by((last / most).max(1));
        self.map(|values| inner().chain([last]).map(|i| values[i]).collect())
    }

    /// The curve with `column` applied to its times, depths and forces, one after the other.
    fn map(&self, column: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        Self {
            time: column(&self.time),
            depth: column(&self.depth),
            force: column(&self.force),
        }
    }
}

/// Kind of the material that is fitted.
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

/// Thickness of a sample; a sample of finite thickness is bonded to a rigid base.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Thickness {
    /// Half space.
    #[default]
    Infinite,
    /// Known thickness > 0, \[m].
    Known(f64),
    /// Thickness that is fitted together with the material.
    Fitted,
}

/// Options of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// Kind of the material.
    pub rheology: Rheology,
    /// Number of branches of [`Rheology::Prony`], 1 to 6; `None` for the number by Schwarz's information criterion.
    pub branches: Option<usize>,
    /// Poisson ratio ν, −1 < ν ≤ 1/2.
    pub poisson_ratio: f64,
    /// Thickness of the sample.
    pub thickness: Thickness,
    /// Whether the force without contact may depend on the depth.
    pub tilt: bool,
    /// Whether the points after the deepest one are excluded, because a body may stick.
    pub before_retraction: bool,
    /// Whether all intervals are those of the profile likelihood, rather than only those that a covariance cannot give.
    pub profile: bool,
}

impl Default for FitOptions {
    /// An incompressible standard solid as a half space, with a tilted baseline, from the whole curve.
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

/// Result of a fit.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct IndentationFit {
    /// Estimates of material, contact point, baseline and tilt.
    ///
    /// The material is elastic if the curve does not determine its relaxation.
    pub findings: Vec<Finding>,
    /// Correlation matrix of the parameters; of the logarithms of moduli and times.
    pub correlation: Vec<Vec<f64>>,
    /// Fitted material; a power law is expanded over the times of the curve.
    pub material: Prony,
    /// Lowest and highest angular frequency of the curve, \[rad/s]: the inverse of its duration and of its shortest step.
    pub valid_frequencies: [f64; 2],
    /// Standard deviation of the force before the contact, from the median, \[N]; `None` for fewer than 10 such points.
    pub noise: Option<f64>,
    /// Standard deviation of the residuals of all points, from the median, \[N].
    pub residual: f64,
    /// Number of correlated points per independent point, at least 1.
    pub correlated_points: f64,
    /// Fitted points: time, depth (smoothed if noisy), force and force of the fit; means of neighbours for long curves.
    pub points: Vec<[f64; 4]>,
    /// Warnings about the fit.
    pub flags: Vec<Flag>,
    /// Notes on decisions of the fit.
    pub notes: Vec<Note>,
}

/// Fits a material to a curve.
///
/// # Errors
/// [`MeasurementError`] for options out of range, a damaged curve, and a fit that does not converge or determine anything.
pub fn fit_indentation(
    body: &dyn Axisymmetric,
    curve: &IndentationCurve,
    options: &FitOptions,
) -> Result<IndentationFit, MeasurementError> {
    // Refuse a curve that is damaged, remove the retraction if that is requested, and average points of long curves.
    check(curve, options)?;
    let measured =
        checks::prepare(curve, options.before_retraction).map_err(MeasurementError::Damaged)?;
    let curve = &measured.curve;
    checks::check_scale(body, curve).map_err(MeasurementError::Damaged)?;
    let jump = pull_in::flag(&measured).map_err(MeasurementError::Damaged)?;
    // Fit the curve: the elastic fit gives initial values, the search the parameters, and their intervals and the tests of the
    // residuals follow.
    let sample = sample::Sample::new(body, curve, options)?;
    let begin = start::start(&sample, curve, options)?;
    checks::check_contact(&measured, &begin).map_err(MeasurementError::Damaged)?;
    let found = search::search(&sample, &measured, options, &begin)?;
    let statistics = intervals::Statistics::of(&found)?;
    let judgement = judgement::Judgement::new(&found, &begin, &statistics);
    let mut flags: Vec<Flag> = jump.into_iter().collect();
    flags.extend(judgement.flags().map_err(MeasurementError::Damaged)?);
    flags.extend(sample.too_deep(&found));
    let spectrum = found.model.spectrum(&found.parameters);
    let material = spectrum.and_then(Prony::new).map_err(MdrError::from)?;
    let findings = statistics.findings(&found, options.profile);
    // Refuse a fit in which the contact point and everything before it are undetermined. Of too many branches none is determined,
    // but the contact point is.
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

/// Checks the options and the lengths of the columns.
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
