//! Pointers to bodies, lines and surfaces are such themselves.

/// Implements a trait for references, boxes and other pointers to what implements it.
macro_rules! forward {
    ($trait:ident $(+ $auto:ident)*, {
        $(fn $method:ident(&self $(, $argument:ident: $type:ty)?) -> $result:ty;)+
    }) => {
        impl<P: std::ops::Deref<Target: $trait> $(+ $auto)*> $trait for P {
            $(fn $method(&self $(, $argument: $type)?) -> $result {
                (**self).$method($($argument)?)
            })+
        }
    };
}

pub(crate) use forward;
