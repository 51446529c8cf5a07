//! Other forms of rough surfaces with the same answer: mirrored and turned height maps, and a tabulated spectrum.

use std::f64::consts::TAU;

use anyhow::Result;
use viscofriction::indenters::HeightMap;
use viscofriction::indenters::rough::{PeriodicSurface, TabulatedSpectrum};
use viscofriction::scene::{
    Edges, HeightsAre, Indenter, SelfAffineSurface, SpectrumConvention, SpectrumSurface,
};

use crate::evidence::sample::{Case, Lengths, SPECTRUM};

/// Mirrors a height map across the motion; or, if `is_turned`, replaces it by heights of opposite sign in the opposite order
/// together with the keys that undo both. `None` for other bodies.
pub(super) fn other_map(case: &mut Case, is_turned: bool) -> Option<()> {
    let Indenter::HeightMap(map) = &mut case.scene.indenter else {
        return None;
    };
    let lengths = case.lengths.as_mut()?;
    // Turn the map by 180 degrees, which puts all heights into the opposite order.
    if is_turned {
        map.direction = 180.0;
        map.heights_are = HeightsAre::Surface;
        let heights = lengths.values.iter_mut();
        heights.for_each(|height| *height = -*height);
    } else {
        let rows = lengths.values.chunks_mut(lengths.columns);
        rows.for_each(<[f64]>::reverse);
    }
    lengths.values.reverse();
    Some(())
}

/// A self-affine surface without roll-off as a surface of a tabulated spectrum, and the table: wave numbers \[1/m] and spectral
/// density \[m⁴] of the two ends of the power law, scaled such that the surface of this seed has the same root mean square
/// slope.
pub(super) fn as_spectrum(surface: &SelfAffineSurface) -> Result<(Indenter, Lengths)> {
    let ends = [surface.longest_wavelength, surface.shortest_wavelength];
    let [first, last] = ends.map(|length| TAU / length);
    let falls = (last / first).powf(-2.0 - 2.0 * surface.hurst_exponent);
    let spectrum = TabulatedSpectrum::new(vec![first, last], vec![1.0, falls])?;
    let drawn = spectrum.surface(surface.period, TAU / last, surface.seed)?;
    let density = (surface.rms_slope / drawn.rms_slope()).powi(2);
    let table = Lengths {
        file: SPECTRUM,
        columns: 2,
        values: vec![first, density, last, density * falls],
    };
    let other = SpectrumSurface {
        file: SPECTRUM.into(),
        convention: SpectrumConvention::Persson,
        period: surface.period,
        shortest_wavelength: None,
        seed: surface.seed,
        realisations: surface.realisations,
        standard_error: surface.standard_error,
    };
    Ok((Indenter::Spectrum(other), table))
}

/// Interpolates a periodic height map by its Fourier series on twice as many heights along both edges; `None` for other bodies.
pub(super) fn resampled(case: &mut Case) -> Option<()> {
    let Indenter::HeightMap(map) = &mut case.scene.indenter else {
        return None;
    };
    let lengths = case.lengths.as_mut()?;
    let spacing = map.spacing.as_mut()?;
    let shape = [lengths.values.len() / lengths.columns, lengths.columns];
    let given = HeightMap::from_gaps(shape, [1.0; 2], lengths.values.clone()).ok()?;
    let waves = PeriodicSurface::from_map(&given, 0.0).ok()?;
    let is_periodic = map.edges == Edges::Periodic;
    lengths.values = waves.heights(shape.map(|count| 2 * count)).ok()?;
    lengths.columns *= 2;
    *spacing = spacing.map(|spacing| 0.5 * spacing);
    is_periodic.then_some(())
}
