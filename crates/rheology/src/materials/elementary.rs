//! Spring, dashpot, and both in parallel or in series.
//!
//! ```text
//! σ = 2 η dε/dt        (3), the linear viscous law of the paper
//! ```

use crate::{
    CreepSpectrum, Material, RelaxationBranch, RelaxationSpectrum, RetardationElement,
    RheologyError,
};
use numerics::positive;

/// Defines a material with positive parameters: the struct, its checked constructor `new`, and its getters.
macro_rules! elementary {
    (
        $(#[$doc:meta])*
        $material:ident;
        $(#[$new:meta])*
        new;
        $($(#[$parameter_doc:meta])* $parameter:ident, its inverse $inverse:literal;)+
        $(=> viscosity over modulus $time:literal;)?
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        pub struct $material {
            $($parameter: f64,)+
        }

        impl $material {
            $(#[$new])*
            ///
            /// # Errors
            /// [`RheologyError::InvalidParameter`] when a parameter, its inverse or the time η/G is not finite and greater
            /// than zero.
            pub fn new($($parameter: f64),+) -> Result<Self, RheologyError> {
                $(positive(stringify!($parameter), $parameter)?;)+
                $(positive($inverse, $parameter.recip())?;)+
                let material = Self { $($parameter),+ };
                $(positive($time, material.viscosity / material.shear_modulus)?;)?
                Ok(material)
            }

            $(
                $(#[$parameter_doc])*
                pub const fn $parameter(&self) -> f64 {
                    self.$parameter
                }
            )+
        }
    };
}

elementary! {
    /// A spring: an elastic material, incompressible.
    Elastic;
    /// A material of `shear_modulus` G > 0, \[Pa].
    new;
    /// Shear modulus G, \[Pa].
    shear_modulus, its inverse "compliance";
}

elementary! {
    /// A dashpot: an incompressible, linearly viscous material.
    Viscous;
    /// A material of shear `viscosity` η > 0, [Pa s].
    new;
    /// Shear viscosity η, [Pa s].
    viscosity, its inverse "fluidity";
}

elementary! {
    /// A solid: a spring and a dashpot in parallel, incompressible.
    KelvinVoigt;
    /// A solid of `shear_modulus` G > 0 \[Pa] and `viscosity` η > 0 [Pa s].
    new;
    /// Shear modulus G of the spring, \[Pa].
    shear_modulus, its inverse "compliance";
    /// Shear viscosity η of the dashpot, [Pa s].
    viscosity, its inverse "fluidity";
    => viscosity over modulus "retardation_time";
}

elementary! {
    /// A fluid: a spring and a dashpot in series, incompressible.
    Maxwell;
    /// A fluid of `shear_modulus` G > 0 \[Pa] and `viscosity` η > 0 [Pa s].
    new;
    /// Shear modulus G of the spring, \[Pa].
    shear_modulus, its inverse "compliance";
    /// Shear viscosity η of the dashpot, [Pa s].
    viscosity, its inverse "fluidity";
    => viscosity over modulus "relaxation_time";
}

impl Material for Elastic {
    /// G(t) = G.
    fn relaxation(&self) -> RelaxationSpectrum {
        RelaxationSpectrum::from_valid(self.shear_modulus, 0.0, Vec::new())
    }

    /// J(t) = 1/G.
    fn creep(&self) -> CreepSpectrum {
        CreepSpectrum::from_valid(self.shear_modulus.recip(), 0.0, Vec::new())
    }
}

impl Material for Viscous {
    /// G(t) = η δ(t).
    fn relaxation(&self) -> RelaxationSpectrum {
        RelaxationSpectrum::from_valid(0.0, self.viscosity, Vec::new())
    }

    /// J(t) = t/η.
    fn creep(&self) -> CreepSpectrum {
        CreepSpectrum::from_valid(0.0, self.viscosity.recip(), Vec::new())
    }
}

impl Material for KelvinVoigt {
    /// G(t) = G + η δ(t).
    fn relaxation(&self) -> RelaxationSpectrum {
        RelaxationSpectrum::from_valid(self.shear_modulus, self.viscosity, Vec::new())
    }

    /// J(t) = (1 − e^(−G t/η))/G.
    fn creep(&self) -> CreepSpectrum {
        let element = RetardationElement {
            compliance: self.shear_modulus.recip(),
            retardation_time: self.viscosity / self.shear_modulus,
        };
        CreepSpectrum::from_valid(0.0, 0.0, vec![element])
    }
}

impl Material for Maxwell {
    /// G(t) = G e^(−G t/η).
    fn relaxation(&self) -> RelaxationSpectrum {
        let branch = RelaxationBranch::new(self.shear_modulus, self.viscosity / self.shear_modulus);
        RelaxationSpectrum::from_valid(0.0, 0.0, vec![branch])
    }

    /// J(t) = 1/G + t/η.
    fn creep(&self) -> CreepSpectrum {
        let [compliance, fluidity] = [self.shear_modulus, self.viscosity].map(f64::recip);
        CreepSpectrum::from_valid(compliance, fluidity, Vec::new())
    }
}
