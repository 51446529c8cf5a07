//! The bodies on which the error bars are tested, each in a scene whose depth scale F_N/(4ηv) is 1.

use anyhow::Result;
use bem_halfspace::BemError;
use bem_halfspace::steady::{FrictionEstimate, FrictionOptions, steady_friction};
use indenters::{
    Axisymmetric, FlatCone, Hyperboloid, PowerProfile, PowerTerm, RoundTippedCone, SlidingLoad,
    Sphere, Superposition, TruncatedParaboloid,
};
use rheology::Viscous;

/// Exponents of the power profiles.
const EXPONENTS: [f64; 14] = [
    0.6, 0.7, 0.85, 1.0, 1.2, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 30.0,
];
/// Sizes of tips and flat ends; the depth scale is 1.
const RADII: [f64; 3] = [0.1, 0.3, 1.0];
/// From this exponent on the contact is a narrow crescent, for which narrow elements are no help.
const CRESCENT: f64 = 4.0;
/// From this exponent on, and below the other, solutions far finer than the others cost too much.
const DULL: f64 = 20.0;
const SHARP: f64 = 0.7;

type Solve = Box<dyn Fn(&FrictionOptions) -> Result<FrictionEstimate, BemError>>;

/// A body, and how its friction is computed.
pub(super) struct Case {
    pub(super) name: String,
    /// p of a power profile.
    pub(super) exponent: Option<f64>,
    /// How the solution is computed that the others are compared with.
    pub(super) reference: FrictionOptions,
    pub(super) solve: Solve,
}

impl Case {
    fn new(
        name: impl Into<String>,
        exponent: Option<f64>,
        body: impl Axisymmetric + 'static,
    ) -> Result<Self> {
        let (material, load) = (Viscous::new(1.0)?, SlidingLoad::new(4.0, 1.0)?);
        Ok(Self {
            name: name.into(),
            exponent,
            reference: reference(exponent),
            solve: Box::new(move |options| steady_friction(&body, &material, &load, options)),
        })
    }

    fn power(exponent: f64) -> Result<Self> {
        let body = PowerProfile::new(1.0, exponent)?;
        Self::new(format!("r^{exponent}"), Some(exponent), body)
    }
}

fn reference(exponent: Option<f64>) -> FrictionOptions {
    let costly = |p: f64| p >= DULL || p <= SHARP;
    FrictionOptions {
        relative_error: if exponent.is_some_and(costly) {
            4e-4
        } else {
            1e-4
        },
        aspect: if exponent.is_some_and(|p| p >= CRESCENT) {
            1.0
        } else {
            0.5
        },
        ..FrictionOptions::default()
    }
}

/// Power profiles, and bodies whose shape depends on the load.
pub(super) fn all() -> Result<Vec<Case>> {
    let powers = EXPONENTS.into_iter().map(Case::power);
    let mut cases = powers.collect::<Result<Vec<_>>>()?;
    cases.extend([
        Case::new("sphere, radius 5", None, Sphere::new(5.0)?)?,
        Case::new("sphere, radius 2", None, Sphere::new(2.0)?)?,
        sum("r/2 + r²/2", [(0.5, 1.0), (0.5, 2.0)])?,
        sum("r²/2 + 2 r⁶", [(0.5, 2.0), (2.0, 6.0)])?,
    ]);
    for radius in RADII {
        let name = |body: &str| format!("{body}, radius {radius}");
        cases.extend([
            Case::new(
                name("cone with round tip"),
                None,
                RoundTippedCone::new(radius, 1.0)?,
            )?,
            Case::new(name("hyperboloid"), None, Hyperboloid::new(radius, 1.0)?)?,
            Case::new(
                name("paraboloid with flat end"),
                None,
                TruncatedParaboloid::new(radius, 1.0)?,
            )?,
            Case::new(
                name("cone with flat end"),
                None,
                FlatCone::new(radius, 1.0)?,
            )?,
        ]);
    }
    Ok(cases)
}

fn sum(name: &str, terms: [(f64, f64); 2]) -> Result<Case> {
    let terms = terms.map(|(coefficient, exponent)| PowerTerm {
        coefficient,
        exponent,
    });
    Case::new(name, None, Superposition::new(terms.to_vec())?)
}

/// Four bodies that are solved in milliseconds.
pub(super) fn quick() -> Result<Vec<Case>> {
    let mut cases = [1.0, 1.5, 2.0]
        .into_iter()
        .map(Case::power)
        .collect::<Result<Vec<_>>>()?;
    cases.push(Case::new(
        "hyperboloid, radius 0.3",
        None,
        Hyperboloid::new(0.3, 1.0)?,
    )?);
    for case in &mut cases {
        case.reference.relative_error = 3e-4;
    }
    Ok(cases)
}
