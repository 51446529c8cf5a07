//! Materials of any number of elements, given by one of their spectra.

use crate::{CreepSpectrum, Material, RelaxationSpectrum, RheologyError};

/// A material with both of its spectra, the other of which follows from the one that is given.
macro_rules! generalised {
    (
        $(#[$doc:meta])*
        $material:ident;
        $(#[$new:meta])*
        new: $given:ident: $spectrum:ty, $other:ident by $conversion:ident;
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        pub struct $material {
            relaxation: RelaxationSpectrum,
            creep: CreepSpectrum,
        }

        impl $material {
            $(#[$new])*
            pub fn new($given: $spectrum) -> Result<Self, RheologyError> {
                let $other = $given.$conversion()?;
                Ok(Self { $given, $other })
            }
        }

        impl Material for $material {
            fn relaxation(&self) -> RelaxationSpectrum {
                self.relaxation.clone()
            }

            fn creep(&self) -> CreepSpectrum {
                self.creep.clone()
            }
        }
    };
}

generalised! {
    /// Maxwell branches in parallel, with or without a lone spring and a lone dashpot, incompressible: its relaxation modulus
    /// is a Prony series.
    Prony;
    /// The material that relaxes like this.
    ///
    /// # Errors
    /// [`RheologyError`] when a compliance or a time of its creep is outside the range of `f64`.
    new: relaxation: RelaxationSpectrum, creep by to_creep;
}

generalised! {
    /// Kelvin–Voigt elements in series, with or without a lone spring and a lone dashpot, incompressible.
    KelvinChain;
    /// The material that creeps like this.
    ///
    /// # Errors
    /// [`RheologyError`] when a modulus or a time of its relaxation is outside the range of `f64`.
    new: creep: CreepSpectrum, relaxation by to_relaxation;
}
