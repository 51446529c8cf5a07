//! A layer of finite thickness t, bonded to a rigid base or another substrate and free of friction above.
//!
//! A pressure wave displaces its surface by `û = 2 p̂ M(|q|t)/(|q| E*)`, with E* as for the half space, where M is 1. M on a
//! rigid base is [`rheology::layer_factor`].
//!
//! Theory: docs/layers.md, "How it is computed".

use numerics::{InvalidParameter, in_range};
use rheology::{Material, ModulusFactors, layer_deficit, layer_factor};

use crate::substrate::correction::RIGID_BASE_INFLUENCE_RADIUS;
use crate::{Base, Elastomer, Substrate, WaveShift};

/// A layer of a material on a rigid base, or on a [`Substrate`] of one's own.
#[derive(Debug)]
pub struct Layer<'a, M: ?Sized> {
    /// Material of the layer.
    material: &'a M,
    /// Substrate under the layer.
    base: Base,
    /// Factors of its moduli.
    factors: ModulusFactors,
    /// Shift by the wavelength of the pressure.
    wave_shift: Option<WaveShift>,
}

/// The clone is of the same material, which need not be `Clone` itself.
impl<M: ?Sized> Clone for Layer<'_, M> {
    fn clone(&self) -> Self {
        Self {
            material: self.material,
            base: self.base.clone(),
            factors: self.factors,
            wave_shift: self.wave_shift.clone(),
        }
    }
}

impl<'a, M: Material + ?Sized> Layer<'a, M> {
    /// A layer of a thickness greater than 0 \[m], bonded to a rigid base. An infinite thickness gives a half space.
    ///
    /// # Errors
    /// [`InvalidParameter`] for a thickness that is not greater than 0.
    pub fn new(material: &'a M, thickness: f64) -> Result<Self, InvalidParameter> {
        in_range("thickness", thickness, thickness > 0.0, "greater than 0")?;
        if thickness.is_infinite() {
            return Ok(Self::over(material, Base::default()));
        }
        Self::on(material, RigidBase { thickness })
    }

    /// A layer on a substrate, of the thickness [`Substrate::thickness`].
    ///
    /// # Errors
    /// As for [`Base::new`].
    pub fn on(
        material: &'a M,
        substrate: impl Substrate + 'static,
    ) -> Result<Self, InvalidParameter> {
        let base = Base::new(substrate, material.poisson_ratio())?;
        Ok(Self::over(material, base))
    }

    /// A layer of a material on a base, which must have been made for the Poisson ratio of the material.
    pub(crate) const fn over(material: &'a M, base: Base) -> Self {
        Self {
            material,
            base,
            factors: ModulusFactors::NONE,
            wave_shift: None,
        }
    }

    /// The layer with factors on its moduli, at the strain amplitude of a stationary state (equivalent-linear). It slides like any
    /// other; motions, histories and derivatives refuse it.
    #[must_use]
    pub fn with_modulus_factors(self, factors: ModulusFactors) -> Self {
        Self { factors, ..self }
    }

    /// The layer with times and moduli that depend on the wavelength of the pressure, as at a temperature that changes with the
    /// depth. Only the stationary sliding of periodic surfaces has it; all other functions refuse it.
    #[must_use]
    pub fn with_wave_shift(self, shift: WaveShift) -> Self {
        Self {
            wave_shift: Some(shift),
            ..self
        }
    }
}

impl<M: Material + ?Sized> Elastomer for Layer<'_, M> {
    /// The material of the layer.
    fn material(&self) -> Box<dyn Material + '_> {
        Box::new(self.material)
    }

    /// The substrate under the layer, with its thickness.
    fn base(&self) -> Base {
        self.base.clone()
    }

    /// The factors of [`Layer::with_modulus_factors`].
    fn modulus_factors(&self) -> ModulusFactors {
        self.factors
    }

    /// The shift of [`Layer::with_wave_shift`].
    fn wave_shift(&self) -> Option<WaveShift> {
        self.wave_shift.clone()
    }
}

/// A rigid base to which a layer is bonded.
#[derive(Debug)]
struct RigidBase {
    /// Thickness of the layer, \[m].
    thickness: f64,
}

impl Substrate for RigidBase {
    /// Thickness of the layer, \[m].
    fn thickness(&self) -> f64 {
        self.thickness
    }

    /// M(s) of a layer that is bonded to a rigid base and free of friction above.
    fn compliance_ratio(&self, s: f64, poisson_ratio: f64) -> f64 {
        layer_factor(s, poisson_ratio)
    }

    /// M(s) − 1 without cancellation.
    fn compliance_excess(&self, s: f64, poisson_ratio: f64) -> f64 {
        -layer_deficit(s, poisson_ratio)
    }

    /// Uniaxial compression: the compliance t (1 − 2ν)/(2 G (1 − ν)) to uniform pressure, times E*/2 with E* = 2 G/(1 − ν).
    fn uniform_compliance(&self, thickness: f64, poisson_ratio: f64) -> f64 {
        0.5 * thickness * (1.0 - 2.0 * poisson_ratio) / (1.0 - poisson_ratio).powi(2)
    }

    /// Influence radius in thicknesses, beyond which displacements are below rounding.
    fn influence_radius(&self) -> f64 {
        RIGID_BASE_INFLUENCE_RADIUS
    }
}
