//! Macro for bodies with positive parameters.

/// Defines a body with finite positive parameters: the struct, its checked constructor `new`, and its getters.
macro_rules! shape {
    (
        $(#[$doc:meta])*
        $shape:ident;
        $(#[$new:meta])*
        new;
        $($(#[$parameter_doc:meta])* $parameter:ident: $getter:ident;)+
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        pub struct $shape {
            $($parameter: f64,)+
        }

        impl $shape {
            $(#[$new])*
            ///
            /// # Errors
            /// [`IndenterError::InvalidParameter`](crate::IndenterError::InvalidParameter) when a parameter is not finite and
            /// greater than zero.
            pub fn new($($parameter: f64),+) -> Result<Self, $crate::IndenterError> {
                Ok(Self {
                    $($parameter: numerics::positive(stringify!($parameter), $parameter)?,)+
                })
            }

            $(
                $(#[$parameter_doc])*
                pub const fn $getter(&self) -> f64 {
                    self.$parameter
                }
            )+
        }
    };
}

pub(crate) use shape;
