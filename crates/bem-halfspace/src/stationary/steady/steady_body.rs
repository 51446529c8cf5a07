//! The body of a stationary problem: a surface, or a profile in plane strain.

use indenters::{SlidingLoad, Surface};

use crate::stationary::steady::SteadyOptions;
use crate::stationary::steady::line::Strip;
use crate::stationary::steady::loading::Loading;
use crate::{BemError, Elastomer};

/// A rigid body that slides, in three dimensions or in plane strain.
#[derive(Clone, Copy)]
pub enum SteadyBody<'a> {
    /// A body in three dimensions. A reference to a surface is converted to it.
    Body(&'a dyn Surface),
    /// A smooth profile that is infinite along y, whose heights at y = 0 matter. The normal force of its load is per length, \[N/m], and
    /// a number of elements is that along the contact of a cylinder on an elastic half space.
    Line(&'a dyn Surface),
}

impl<'a, S: Surface> From<&'a S> for SteadyBody<'a> {
    fn from(surface: &'a S) -> Self {
        Self::Body(surface)
    }
}

impl<'a> From<&'a dyn Surface> for SteadyBody<'a> {
    fn from(surface: &'a dyn Surface) -> Self {
        Self::Body(surface)
    }
}

impl std::fmt::Debug for SteadyBody<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Body(_) => "Body",
            Self::Line(_) => "Line",
        })
    }
}

impl<'a> SteadyBody<'a> {
    /// Surface of the body, or of its profile.
    pub const fn surface(self) -> &'a dyn Surface {
        match self {
            Self::Body(surface) | Self::Line(surface) => surface,
        }
    }

    /// The surface that is solved for, its loading and its grid. A strip replaces an infinite profile; the options of a line along y have
    /// no effect.
    pub(super) fn on_grid(
        self,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &SteadyOptions,
    ) -> Result<(Box<dyn Surface + 'a>, Loading, SteadyOptions), BemError> {
        match self {
            Self::Body(surface) => {
                let loading = Loading::new(surface, elastomer, load, &options.footprint)?;
                Ok((Box::new(surface), loading, *options))
            }
            Self::Line(profile) => {
                let x = options.footprint.x;
                let loading = Loading::per_length(profile, elastomer, load, x)?;
                let strip = Strip::new(profile, &loading);
                let grid = SteadyOptions {
                    spacing: [options.spacing[0], strip.length],
                    phase: [options.phase[0], 0.0],
                    footprint: strip.footprint(x),
                    ..*options
                };
                Ok((Box::new(strip), loading, grid))
            }
        }
    }
}
