//! Forward model: forces at the points of a curve, and their derivatives by the parameters of a fit.
//!
//! The parameters are the logarithms of moduli and times (for a power law ln G₁ and β), contact point, baseline and tilt,
//! and the logarithm of the thickness of the sample if it is fitted.

use indenters::{Control, EquivalentProfile, HistoryPoint};
use mdr_core::{ForceDerivatives, MdrError, force_derivatives};
use rheology::{
    Compressible, Prony, RelaxationBranch, RelaxationSpectrum, RheologyError, Springpot,
};

use super::depth::min_max;
use super::sample::Sample;
use super::{FitOptions, IndentationCurve};
use crate::MeasurementError;

/// A material with free parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// This number of branches.
    Branches(usize),
    /// G(t) = G₁ (t/1 s)^−β.
    PowerLaw,
}

impl Kind {
    /// Number of fitted parameters of a material of this kind.
    pub(super) const fn n_parameters(self) -> usize {
        match self {
            Self::Branches(n) => 2 * n + 1,
            Self::PowerLaw => 2,
        }
    }

    /// True if the parameter of the material with this index is fitted as its logarithm.
    pub(super) fn is_logarithm(self, parameter: usize) -> bool {
        parameter < self.n_parameters() && (self, parameter) != (Self::PowerLaw, 1)
    }
}

/// Relative error requested of a Prony series that approximates a power law. Chosen, far below the noise of a curve.
const EXPANSION_ERROR: f64 = 1e-4;
/// Largest relative difference of two relaxation times that count as those of one branch. Chosen, above the rounding of exp and
/// ln.
const TIME_TOLERANCE: f64 = 1e-7;
/// Step of the natural logarithm of the thickness for the derivative of the forces by a difference quotient. Chosen: it is
/// far below the step of the table of profiles, over which the forces are smooth, and far above rounding.
const THICKNESS_STEP: f64 = 1e-4;
/// Step of the exponent β of a power law for the derivative of the forces by a difference quotient. Chosen: the nodes of the
/// Prony series rarely change over it.
const BETA_STEP: f64 = 1e-6;

/// Model of a body that follows the depth of a curve.
#[derive(Clone)]
pub(super) struct Model<'a> {
    /// Body and sample.
    pub(super) sample: Sample<'a>,
    /// Curve whose depths the body follows.
    pub(super) curve: &'a IndentationCurve,
    pub(super) kind: Kind,
    pub(super) poisson_ratio: f64,
    /// True if the force without contact has a slope over the depth.
    pub(super) tilt: bool,
    /// Middle of the range of depths, \[m].
    pub(super) middle: f64,
    /// Shortest time step and duration of the curve, \[s].
    pub(super) times: [f64; 2],
}

/// Residuals, derivatives and contact forces of a model.
pub(super) struct Forces {
    /// Residuals, measured less modelled force, \[N].
    pub(super) residuals: Vec<f64>,
    /// Derivatives of the modelled forces, one row per parameter.
    pub(super) rows: Vec<Vec<f64>>,
    /// Forces without baseline and tilt, \[N].
    pub(super) contact: Vec<f64>,
}

impl<'a> Model<'a> {
    /// The model of a curve for a kind of material.
    pub(super) fn new(
        sample: &Sample<'a>,
        curve: &'a IndentationCurve,
        kind: Kind,
        options: &FitOptions,
    ) -> Self {
        let time = &curve.time;
        let steps = time.windows(2).map(|pair| pair[1] - pair[0]);
        let shortest = steps.fold(f64::INFINITY, f64::min);
        let [low, high] = min_max(&curve.depth);
        Self {
            sample: sample.clone(),
            curve,
            kind,
            poisson_ratio: options.poisson_ratio,
            tilt: options.tilt,
            middle: 0.5 * (low + high),
            times: [shortest, time[time.len() - 1] - time[0]],
        }
    }

    /// Number of all parameters: material, contact point, baseline, and tilt and thickness if they are fitted.
    pub(super) const fn n_parameters(&self) -> usize {
        self.kind.n_parameters() + 2 + self.tilt as usize + self.sample.is_fitted() as usize
    }

    /// Index of the thickness among the parameters; `None` if it is not fitted.
    pub(super) fn thickness(&self) -> Option<usize> {
        self.sample.is_fitted().then(|| self.n_parameters() - 1)
    }

    /// True if the parameter with this index, of the material or the sample, is fitted as its logarithm.
    pub(super) fn is_logarithm(&self, parameter: usize) -> bool {
        self.kind.is_logarithm(parameter) || self.thickness() == Some(parameter)
    }

    /// Index of the contact point among the parameters; baseline and tilt follow.
    pub(super) const fn contact_point(&self) -> usize {
        self.kind.n_parameters()
    }

    /// Relaxation spectrum of the material for these parameters, with moduli \[Pa] and times \[s].
    pub(super) fn spectrum(&self, parameters: &[f64]) -> Result<RelaxationSpectrum, RheologyError> {
        let Kind::Branches(n) = self.kind else {
            return self.power_law(parameters[0].exp(), parameters[1]);
        };
        let pairs = parameters[1..=2 * n].chunks_exact(2);
        let branches = pairs.map(|pair| RelaxationBranch::new(pair[0].exp(), pair[1].exp()));
        RelaxationSpectrum::new(parameters[0].exp(), 0.0, branches.collect())
    }

    /// Power law as a Prony series; its springpot has K = G₁ Γ(1 − β), because G(1 s) = K/Γ(1 − β).
    fn power_law(&self, modulus: f64, beta: f64) -> Result<RelaxationSpectrum, RheologyError> {
        let unit = Springpot::new(1.0, beta)?.relaxation_modulus(1.0)?;
        let band = [0.1 / self.times[1], 10.0 / self.times[0]];
        let expansion = Springpot::new(modulus / unit, beta)?.expand(band, EXPANSION_ERROR)?;
        Ok(expansion.spectrum)
    }

    /// Residuals and derivatives at all points for these parameters. An error if the body is not high enough for a depth, or a
    /// parameter is out of range.
    pub(super) fn forces(&self, parameters: &[f64]) -> Result<Forces, MeasurementError> {
        let spectrum = self.spectrum(parameters).map_err(MdrError::from)?;
        let place = self.contact_point();
        let [contact_point, baseline] = [parameters[place], parameters[place + 1]];
        let tilt = if self.tilt {
            parameters[place + 2]
        } else {
            0.0
        };
        let history = self.history(contact_point);
        let material = Prony::new(spectrum.clone())
            .and_then(|prony| Compressible::new(&prony, self.poisson_ratio))
            .map_err(MdrError::from)?;
        let thickness = self.thickness().map_or(0.0, |place| parameters[place]);
        let with_profile =
            |profile: &dyn EquivalentProfile| force_derivatives(profile, &material, &history);
        let found = with_profile(&*self.sample.profile(thickness)?)?;
        // Baseline and tilt are added to the contact force, since they act out of contact too.
        let relative_depths = self.curve.depth.iter().map(|depth| depth - self.middle);
        let relative_depths: Vec<f64> = relative_depths.collect();
        let pairs = found.normal_force.iter().zip(&relative_depths);
        let values = pairs.map(|(force, relative_depth)| force + baseline + tilt * relative_depth);
        let measured = self.curve.force.iter().zip(values);
        let residuals = measured.map(|(force, value)| force - value).collect();
        // Collect the derivatives of the forces, one row for each parameter: material, contact point, baseline, tilt and
        // thickness in this order.
        let mut rows = self
            .material_rows(parameters, &spectrum, &found)
            .map_err(MdrError::from)?;
        rows.push(found.depth.iter().map(|slope| -slope).collect());
        rows.push(vec![1.0; relative_depths.len()]);
        if self.tilt {
            rows.push(relative_depths);
        }
        if self.sample.is_fitted() {
            let thinner = with_profile(&*self.sample.profile(thickness - THICKNESS_STEP)?)?;
            let pairs = found.normal_force.iter().zip(&thinner.normal_force);
            rows.push(
                pairs
                    .map(|(one, other)| (one - other) / THICKNESS_STEP)
                    .collect(),
            );
        }
        Ok(Forces {
            residuals,
            rows,
            contact: found.normal_force,
        })
    }

    /// Depths of the curve below a contact point \[m] as the history of an indentation.
    pub(super) fn history(&self, contact_point: f64) -> Vec<HistoryPoint> {
        let points = self.curve.time.iter().zip(&self.curve.depth);
        let point = |(&time, depth): (&f64, &f64)| HistoryPoint {
            time,
            control: Control::IndentationDepth(depth - contact_point),
        };
        points.map(point).collect()
    }

    /// Derivatives of the forces by the parameters of the material, one row per parameter: ∂F/∂ ln G and ∂F/∂ ln τ, of a power
    /// law ∂F/∂ ln G₁ = F and ∂F/∂β.
    fn material_rows(
        &self,
        parameters: &[f64],
        spectrum: &RelaxationSpectrum,
        found: &ForceDerivatives,
    ) -> Result<Vec<Vec<f64>>, RheologyError> {
        let branches = spectrum.branches();
        let spring = (spectrum.equilibrium_modulus(), &found.equilibrium_modulus);
        let scaled = |(factor, row): (f64, &Vec<f64>)| row.iter().map(|s| factor * s).collect();
        if let Kind::Branches(n) = self.kind {
            // A spectrum orders its branches and merges those of equal times: find each branch by its time.
            let rows = (0..n).flat_map(|k| {
                let [modulus, time] = [1, 2].map(|place| parameters[place + 2 * k].exp());
                let place = branches
                    .partition_point(|one| one.relaxation_time < time * (1.0 - TIME_TOLERANCE))
                    .min(branches.len() - 1);
                let part = modulus / branches[place].modulus * branches[place].relaxation_time;
                let [moduli, times] = [&found.moduli, &found.relaxation_times];
                [(modulus, &moduli[place]), (part, &times[place])]
            });
            return Ok([spring].into_iter().chain(rows).map(scaled).collect());
        }
        let modulus = |branch: &RelaxationBranch| branch.modulus;
        let moduli = branches.iter().map(modulus).zip(&found.moduli);
        let other = self.power_law(parameters[0].exp(), parameters[1] + BETA_STEP)?;
        let others = other
            .branches()
            .iter()
            .map(modulus)
            .chain([other.equilibrium_modulus(), other.viscosity()]);
        let ends = [spring, (spectrum.viscosity(), &found.viscosity)];
        let mut by_beta = vec![0.0; found.normal_force.len()];
        for ((modulus, row), other) in moduli.chain(ends).zip(others) {
            let slope = (other - modulus) / BETA_STEP;
            let sums = by_beta.iter_mut().zip(row);
            sums.for_each(|(sum, by_modulus)| *sum += slope * by_modulus);
        }
        Ok(vec![found.normal_force.clone(), by_beta])
    }
}
