//! Flags: reasons to refuse a curve, and warnings about a fit.

use numerics::MessageNumber;

/// Defect of a curve, or warning about a fit; a value is a count, the first point, a time \[s] or a force \[N].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Flag {
    /// Less than 30 points.
    #[error("{0} points are too few: at least 30 are needed")]
    TooFew(usize),
    /// A cell without a number.
    #[error("point {0} has no number")]
    NotANumber(usize),
    /// The time does not increase, as where a second curve begins.
    #[error("at point {0} the time does not increase: are there two curves in one?")]
    TimeGoesBack(usize),
    /// A step in time that is more than 20 times as long as those around it.
    #[error("points are missing after the time {0} s")]
    Gap(f64),
    /// The depth is the same at all points, \[m].
    #[error("the depth does not change: it is {} m at every point", MessageNumber(*_0))]
    ConstantDepth(f64),
    /// The largest force stays exactly the same while the body goes on.
    #[error("the force is cut off at {:.1e} N", MessageNumber(*_0))]
    Saturated(f64),
    /// The force does not rise above its noise.
    #[error("there is no contact: the force does not rise above its noise of {:.1e} N", MessageNumber(*_0))]
    NoContact(f64),
    /// The force falls while the body goes down.
    #[error(
        "the force falls while the body goes down: is the sign of one of them wrong, or of both? A depth grows towards the \
         sample, and a force that presses is positive"
    )]
    WrongSign,
    /// Adhesion on the approach: the body is attracted by the surface before or in contact.
    #[error(
        "the body jumps into contact: on the way in the force falls {fall:.1e} N below the baseline, {:.1} % of the largest force, \
         but the fit knows no adhesion",
        100.0 * part
    )]
    JumpToContact {
        /// Fall of the force below the baseline, \[N].
        fall: f64,
        /// Fall relative to the largest force.
        part: f64,
    },
    /// The sizes of body and depths are inconsistent.
    #[error(
        "the contact would be {0:.0e} times as wide as deep: are the size of the body, in metres or degrees, and the depths right?"
    )]
    OutOfScale(f64),
    /// Adhesion on the retraction.
    #[error(
        "on the way back the body sticks or the force drifts, by {0:.1e} N: leave out the retraction"
    )]
    Sticks(f64),
    /// Too few points before the contact.
    #[error("fewer than 10 points are before the contact, which is therefore hardly known")]
    NoBaseline,
    /// The force without contact drifts.
    #[error("the force drifts: without contact it is {0:.1e} N off")]
    Drift(f64),
    /// The residuals are not noise like that before the contact.
    #[error(
        "the residuals of {residual:.1e} N are not the noise before the contact: one independent point stands for \
         {correlated:.1}; is it another material or body, a lag between force and depth, a thin sample, or a depth that contains \
         the bending of the cantilever?"
    )]
    Misfit {
        /// Standard deviation about the fit, \[N].
        residual: f64,
        /// Number of correlated points that count as one independent point.
        correlated: f64,
    },
    /// The contact is implausibly wide; the unit may be wrong.
    #[error("the contact is {0:.0e} times as wide as deep: is the radius of the body in metres?")]
    Blunt(f64),
    /// The contact is implausibly deep; the unit may be wrong.
    #[error(
        "the contact is {0:.1e} times as deep as wide: are the radius of the body and the depth in metres?"
    )]
    Sharp(f64),
    /// Strains are no longer small.
    #[error(
        "the body goes {0:.0} % of the thickness of the sample deep, where strains are not small and linear theory ends"
    )]
    DeepInSample(f64),
    /// The body presses again, possibly on a surface that has not recovered.
    #[error("the body presses again, where the force of the fit need not be exact")]
    PressedAgain,
}

/// Serialised as its message.
#[cfg(feature = "serde")]
impl serde::Serialize for Flag {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
