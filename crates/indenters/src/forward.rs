//! References and boxes of bodies, lines and surfaces are such themselves.

/// Implements a trait for references and boxes of what implements it.
macro_rules! forward {
    ($trait:ident, $methods:tt) => {
        forward!(@to &T, $trait, $methods);
        forward!(@to Box<T>, $trait, $methods);
    };
    (@to $pointer:ty, $trait:ident, {
        $(fn $method:ident(&self $(, $argument:ident: $type:ty)?) -> $result:ty;)+
    }) => {
        impl<T: $trait + ?Sized> $trait for $pointer {
            $(fn $method(&self $(, $argument: $type)?) -> $result {
                (**self).$method($($argument)?)
            })+
        }
    };
}

pub(crate) use forward;
