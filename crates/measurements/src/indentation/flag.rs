//! What there is to say about a curve.

use numerics::MessageNumber;

/// What is wrong with a curve, or doubtful about a fit; with a count or the first point, a time \[s] or a force \[N].
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
    /// On the way in the body is drawn to the surface before it touches, or held by it.
    #[error(
        "the body jumps into contact: on the way in the force falls {fall:.1e} N below the baseline, {:.1} % of the largest force, \
         but the fit knows no adhesion",
        100.0 * part
    )]
    JumpToContact {
        /// Fall of the force below the baseline, \[N].
        fall: f64,
        /// The same as a part of the largest force.
        part: f64,
    },
    /// The body and the depths are of sizes that do not belong together.
    #[error(
        "the contact would be {0:.0e} times as wide as deep: are the size of the body, in metres or degrees, and the depths right?"
    )]
    OutOfScale(f64),
    /// On the way back the body sticks.
    #[error(
        "on the way back the body sticks or the force drifts, by {0:.1e} N: leave out the retraction"
    )]
    Sticks(f64),
    /// Before the first point the body touched already.
    #[error("fewer than 10 points are before the contact, which is therefore hardly known")]
    NoBaseline,
    /// After the contact the force is not what it was before.
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
        /// How many points one independent point stands for.
        correlated: f64,
    },
    /// A body that is so blunt is rather one in another unit.
    #[error("the contact is {0:.0e} times as wide as deep: is the radius of the body in metres?")]
    Blunt(f64),
    /// Linear theory ends long before, and mostly the unit is another one.
    #[error(
        "the contact is {0:.1e} times as deep as wide: are the radius of the body and the depth in metres?"
    )]
    Sharp(f64),
    /// Strains are no longer small.
    #[error(
        "the body goes {0:.0} % of the thickness of the sample deep, where strains are not small and linear theory ends"
    )]
    DeepInSample(f64),
    /// The body presses again, perhaps on a surface that has not recovered.
    #[error("the body presses again, where the force of the fit need not be exact")]
    PressedAgain,
}

/// As its sentence.
#[cfg(feature = "serde")]
impl serde::Serialize for Flag {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
