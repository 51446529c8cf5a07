//! The materials that rows name.

use rheology::{
    Prony, RelaxationBranch, RelaxationSpectrum, RheologyError, StandardSolid,
    StandardSolidParameters,
};

use crate::{Case, group};

/// The material of a lone spring \[Pa], a lone dashpot \[Pa s], and branches of modulus \[Pa] and relaxation time \[s].
pub fn prony([equilibrium_modulus, viscosity]: [f64; 2], branches: &[(f64, f64)]) -> Prony {
    let branch = |&(modulus, time)| RelaxationBranch::new(modulus, time);
    let in_order = branches.iter().map(branch).collect();
    let relaxation = RelaxationSpectrum::new(equilibrium_modulus, viscosity, in_order);
    Prony::new(relaxation.expect("moduli")).expect("a material")
}

/// The standard solid of the moduli of its lone spring and of its branch \[Pa] and of the viscosity [Pa s].
///
/// # Errors
/// When a number is out of its range.
pub fn standard_solid(
    [equilibrium_modulus, maxwell_modulus, viscosity]: [f64; 3],
) -> Result<StandardSolid, RheologyError> {
    StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus,
        maxwell_modulus,
        viscosity,
    })
}

/// A model that rows name, `"P3"` or `"P10"`, by its numbers in group RHE-05.
pub fn model(name: &str) -> Prony {
    group("RHE-05")
        .into_iter()
        .find(|row| row.has_input("Ge") && row.input_text("model") == name)
        .expect("a model of RHE-05")
        .material()
}

impl Case {
    /// The material whose moduli the row gives, or else that of the model that it names.
    pub fn material(&self) -> Prony {
        if !self.has_input("Ge") {
            return model(self.input_text("model"));
        }
        let [moduli, times] = ["G", "tau"].map(|name| self.input_list(name));
        let branches: Vec<(f64, f64)> = moduli.into_iter().zip(times).collect();
        let has_dashpot = self.has_input("eta");
        let viscosity = has_dashpot.then(|| self.input("eta"));
        prony([self.input("Ge"), viscosity.unwrap_or(0.0)], &branches)
    }
}
