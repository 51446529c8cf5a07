//! Complex modulus and complex compliance in oscillation.

/// Complex modulus G* = G' + i G''.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ComplexModulus {
    /// Storage modulus G', \[Pa].
    pub storage: f64,
    /// Loss modulus G'', \[Pa].
    pub loss: f64,
}

/// Complex compliance J* = J' − i J'' = 1/G*.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ComplexCompliance {
    /// Storage compliance J', \[1/Pa].
    pub storage: f64,
    /// Loss compliance J'', \[1/Pa].
    pub loss: f64,
}

/// Debye functions Ω²/(1 + Ω²) and Ω/(1 + Ω²) for Ω ≥ 0, without an overflow of the square.
pub(crate) fn debye(omega: f64) -> [f64; 2] {
    if omega <= 1.0 {
        let denominator = 1.0 + omega * omega;
        return [omega * omega / denominator, omega / denominator];
    }
    let inverse = omega.recip();
    let denominator = 1.0 + inverse * inverse;
    [denominator.recip(), inverse / denominator]
}
