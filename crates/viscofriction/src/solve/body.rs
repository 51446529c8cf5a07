//! Construction of the rigid body of a scene.

use std::path::Path;

use bem_halfspace::SteadyBody;
use indenters::rough::{PeriodicSurface, SelfAffine};
use indenters::{Cylinder, HeightMap, Surface};

use super::heights::{MAX_RMS_SLOPE, body_of_heights};
use super::memory::check_waves_to_draw;
use crate::files::Files;
use crate::scene::{
    Indenter, Revolution, SceneError, SelfAffineSurface, SpectrumSurface, profile, spectrum,
};
use crate::text::WrongInput;

/// Relative deviation of the rms slope of a sampled surface from that of its spectrum, above which a warning is given.
/// Chosen: the friction of a rough surface is about proportional to its rms slope, and deviates as much.
const MAX_SLOPE_DEVIATION: f64 = 0.1;

/// The rigid body, by the kinds that methods distinguish.
#[derive(Debug)]
pub enum Body {
    /// A body of revolution.
    Revolution(Revolution),
    /// A cylinder, infinite along y.
    Cylinder(Cylinder),
    /// A grid of heights.
    HeightMap(HeightMap),
    /// A surface that is periodic along x and y.
    Periodic(PeriodicSurface),
}

impl Body {
    /// Surface of a finite body; `None` for a cylinder and a periodic surface, which are unbounded.
    pub fn surface(&self) -> Option<&dyn Surface> {
        match self {
            Self::Revolution(body) => Some(body.surface()),
            Self::HeightMap(map) => Some(map),
            Self::Cylinder(_) | Self::Periodic(_) => None,
        }
    }

    /// The body in stationary sliding on the half space; `None` for a periodic surface.
    pub(crate) fn steady_body(&self) -> Option<SteadyBody<'_>> {
        match self {
            Self::Cylinder(cylinder) => Some(SteadyBody::Line(cylinder)),
            body => body.surface().map(SteadyBody::Body),
        }
    }

    /// Memory of heights and waves, \[bytes]; 0 for other bodies.
    pub(crate) fn memory(&self) -> f64 {
        let bytes = match self {
            Self::HeightMap(map) => size_of_val(map.heights()),
            Self::Periodic(surface) => size_of_val(surface.waves()),
            Self::Revolution(_) | Self::Cylinder(_) => 0,
        };
        bytes as f64
    }

    /// Area of one period, \[m²]; `None` if the body is not periodic.
    pub(crate) fn period_area(&self) -> Option<f64> {
        match self {
            Self::Periodic(surface) => Some(surface.period().iter().product()),
            _ => None,
        }
    }
}

/// The rigid body of a scene, with the warnings of its files.
#[derive(Debug)]
pub struct BodyOfScene {
    /// The body.
    pub body: Body,
    /// Sentences about implausible contents of the files; every answer repeats them among its warnings.
    pub warnings: Vec<String>,
}

/// Builds the rigid body of an `indenter` table of the scene file.
///
/// # Errors
/// [`SceneError`] for the first number that is out of range.
pub fn body(indenter: &Indenter, files: &Files<'_>) -> Result<BodyOfScene, SceneError> {
    indenter.check()?;
    indenter.realisations()?;
    let body = match indenter {
        Indenter::Table { file } => Ok(table_profile(file, files)?),
        &Indenter::Cylinder { radius } => Cylinder::new(radius).map(Body::Cylinder),
        Indenter::HeightMap(table) => {
            let wrong = |WrongInput(problem)| SceneError::at("indenter.height-map.file", problem);
            let memory = files.memory();
            let contents = files.contents(&table.file, memory).map_err(wrong)?;
            let rest = memory.saturating_sub(contents.len() as u64);
            let surface = table.read(&files.folder.join(&table.file), &contents, rest)?;
            return body_of_heights(table, surface);
        }
        Indenter::SelfAffine(surface) => {
            check_waves_to_draw(surface.period, surface.shortest_wavelength, files.memory)?;
            self_affine(surface).surface().map(Body::Periodic)
        }
        Indenter::Spectrum(surface) => return drawn_from_spectrum(surface, files),
        _ => Ok(Body::Revolution(indenter.revolution()?)),
    };
    let body = body.map_err(|error| SceneError::of_body(&indenter.key(), error))?;
    Ok(BodyOfScene {
        body,
        warnings: Vec::new(),
    })
}

/// The parameters of a self-affine surface; the roll-off defaults to the longest wavelength.
fn self_affine(surface: &SelfAffineSurface) -> SelfAffine {
    let longest_wavelength = surface.longest_wavelength;
    SelfAffine {
        period: surface.period,
        hurst_exponent: surface.hurst_exponent,
        rms_slope: surface.rms_slope,
        longest_wavelength,
        shortest_wavelength: surface.shortest_wavelength,
        roll_off_wavelength: surface.roll_off_wavelength.unwrap_or(longest_wavelength),
        seed: surface.seed,
    }
}

/// Draws the waves of a random surface from a tabulated power spectrum, with warnings about an implausible rms slope and about
/// one that differs from that of the spectrum.
fn drawn_from_spectrum(
    surface: &SpectrumSurface,
    files: &Files<'_>,
) -> Result<BodyOfScene, SceneError> {
    let factor = surface.convention.factor();
    let read = |file: &Path, contents: &[u8]| spectrum(file, contents, factor);
    let spectrum = files.read_table("indenter.spectrum.file", &surface.file, read)?;
    let [_, shortest] = spectrum.wavelengths();
    let kept = surface.shortest_wavelength.unwrap_or(shortest);
    check_waves_to_draw(surface.period, kept, files.memory)?;
    let drawn = spectrum
        .surface(surface.period, kept, surface.seed)
        .map_err(|error| SceneError::of_body("indenter.spectrum", error))?;
    // Warn of an rms slope that linear theory does not allow, which suggests another unit. Warn of one that differs from that of
    // the spectrum, which suggests a period that is too short.
    let slope = drawn.rms_slope();
    let whole = spectrum.rms_slope();
    let strange = [
        (
            slope > MAX_RMS_SLOPE,
            "is the file in metres, and of that convention?",
        ),
        (
            surface.shortest_wavelength.is_none()
                && (slope / whole - 1.0).abs() > MAX_SLOPE_DEVIATION,
            "give a larger period, of which more waves are parts, or another seed",
        ),
    ];
    let warning = |(_, question): (bool, &str)| {
        format!(
            "the surface that was drawn has a root mean square slope of {slope:.3}, and the spectrum one of {whole:.3}: {question}"
        )
    };
    Ok(BodyOfScene {
        body: Body::Periodic(drawn),
        warnings: strange
            .into_iter()
            .filter(|(holds, _)| *holds)
            .map(warning)
            .collect(),
    })
}

/// A body of revolution from a CSV file of radii and heights \[m], straight between its rows.
fn table_profile(file: &Path, files: &Files<'_>) -> Result<Body, SceneError> {
    let shape = files.read_table("indenter.table.file", file, profile)?;
    Ok(Body::Revolution(Revolution::other(shape)))
}
