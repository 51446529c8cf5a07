//! The bodies on which the error bars are tested, each in a scene whose depth scale F_N/(4ηv) is 1.

use anyhow::Result;
use bem_halfspace::BemError;
use bem_halfspace::steady::{FrictionEstimate, FrictionOptions, steady_friction};
use indenters::{
    Axisymmetric, FlatCone, Hyperboloid, PowerProfile, PowerTerm, RoundTippedCone, SlidingLoad,
    Sphere, Superposition, Surface, TruncatedParaboloid,
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
/// Up to the first and from the second exponent on a small error costs a minute or more.
const COSTLY: [f64; 2] = [0.7, 12.0];
/// Relative errors asked for, and those of the references over them.
const ASKED: f64 = 1e-3;
const ASKED_WHERE_COSTLY: f64 = 3e-3;
const FINER: f64 = 0.1;
const FINER_WHERE_COSTLY: f64 = 0.2;
const QUICK_ASKED: f64 = 3e-3;

type Solve = Box<dyn Fn(&FrictionOptions) -> Result<FrictionEstimate, BemError>>;

/// A body, and how its friction is computed.
pub(super) struct Case {
    pub(super) name: String,
    /// p of a power profile.
    pub(super) exponent: Option<f64>,
    /// Relative error asked for.
    pub(super) relative_error: f64,
    /// Relative error of the reference over that.
    finer: f64,
    pub(super) solve: Solve,
}

impl Case {
    fn new(
        name: impl Into<String>,
        exponent: Option<f64>,
        body: impl Axisymmetric + Surface + 'static,
    ) -> Result<Self> {
        let (material, load) = (Viscous::new(1.0)?, SlidingLoad::new(4.0, 1.0)?);
        Ok(Self {
            name: name.into(),
            exponent,
            relative_error: ASKED,
            finer: FINER,
            solve: Box::new(move |options| steady_friction(&body, &material, &load, options)),
        })
    }

    fn power(exponent: f64) -> Result<Self> {
        let body = PowerProfile::new(1.0, exponent)?;
        let case = Self::new(format!("r^{exponent}"), Some(exponent), body)?;
        if exponent > COSTLY[0] && exponent < COSTLY[1] {
            return Ok(case);
        }
        Ok(Self {
            relative_error: ASKED_WHERE_COSTLY,
            finer: FINER_WHERE_COSTLY,
            ..case
        })
    }

    /// How the solution is computed that the others are compared with.
    pub(super) fn reference(&self) -> FrictionOptions {
        let is_crescent = self.exponent.is_some_and(|p| p >= CRESCENT);
        FrictionOptions {
            relative_error: self.finer * self.relative_error,
            aspect: if is_crescent { 1.0 } else { 0.5 },
            ..FrictionOptions::default()
        }
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
        case.relative_error = QUICK_ASKED;
    }
    Ok(cases)
}
