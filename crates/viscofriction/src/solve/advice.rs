//! Advice appended to error messages: which key of the scene to change. The methods name their own numbers; a user has keys.

use bem_halfspace::BemError;
use friction_analytic::FrictionError;
use indenters::IndenterError;
use mdr_core::MdrError;

/// Advice for grids or time marches that are too large.
const FEWER: &str = "; give solve.elements, fewer where they are given, or a shorter solve.sliding_distance, or none for the \
     stationary state";
/// Advice for too many elements of the one-dimensional model.
const OTHER_DISTANCE: &str = "; give fewer solve.elements, or a longer solve.sliding_distance";
/// Advice for grids that are too coarse.
const MORE_ELEMENTS: &str = "; give more solve.elements, or a smaller solve.relative_error";
/// Advice if the relative error was not reached.
const LARGER_ERROR: &str = "; give a larger solve.relative_error, or another solve.method";
/// Advice if the contact did not converge on one grid.
const OTHER_ELEMENTS: &str =
    "; give another number of solve.elements, or a larger solve.relative_error";
/// Advice if the contact reaches the edge of the body.
const LESS_LOAD: &str =
    "; lower load.normal_force or load.indentation_depth, or give a body that reaches further";
/// Advice if the contact reaches a vertical wall.
const NO_WALL: &str =
    "; lower load.normal_force or load.indentation_depth, or give a body without a wall there";
/// Advice if the track is shorter than the contact allows.
const LONGER_TRACK: &str = "; give a longer load.track";
/// Advice if a cycle is too short for the relaxation times.
const LOWER_FREQUENCY: &str =
    "; give a lower load.frequency, or a material of shorter relaxation times";
/// Advice if a sliding distance is required.
const DISTANCE: &str = "; give solve.sliding_distance";
/// Advice if the stationary state cannot be reached by marching.
const DISTANCE_OR_STEADY: &str = "; give solve.method = \"bem-steady\", or solve.sliding_distance";
/// Advice if the material has no equilibrium state.
const DURATION: &str = "; give solve.duration";
/// Advice if a number computed from indenter, material and load leaves the range of f64 or of a parameter.
const UNITS: &str = "; check the units of indenter, material and load, from which it follows";

/// True for an error of a half-space method on a grid that is too coarse.
pub(super) const fn is_too_coarse(error: &BemError) -> bool {
    matches!(
        error,
        BemError::GridTooCoarse { .. }
            | BemError::ElementsTooFew { .. }
            | BemError::PeriodTooCoarse { .. }
            | BemError::SlopeNotResolved { .. }
    )
}

/// Advice for an error of the half-space methods; empty if there is none.
pub(super) const fn of_half_space(error: &BemError) -> &'static str {
    match error {
        BemError::GridTooLarge { .. } | BemError::TooManySteps { .. } => FEWER,
        coarse if is_too_coarse(coarse) => MORE_ELEMENTS,
        BemError::ContactNotConverged { .. } | BemError::SingularContact { .. } => OTHER_ELEMENTS,
        BemError::NotReached { .. }
        | BemError::TimeNotResolved { .. }
        | BemError::NotPeriodic { .. } => LARGER_ERROR,
        BemError::CycleTooShort { .. } => LOWER_FREQUENCY,
        BemError::ContactReachesBoundary { .. } => LESS_LOAD,
        BemError::VerticalWall { .. } => NO_WALL,
        BemError::TrackTooShort { .. } => LONGER_TRACK,
        BemError::SlidingDistanceMissing { .. } => DISTANCE,
        BemError::MemoryTooLong { .. } | BemError::NotStationary { .. } => DISTANCE_OR_STEADY,
        BemError::NoEquilibrium => DURATION,
        BemError::InvalidParameter(_) => UNITS,
        BemError::Indenter(error) => of_body(error),
        _ => "",
    }
}

/// Advice for an error of the one-dimensional model; empty if there is none.
pub(super) const fn of_line(error: &MdrError) -> &'static str {
    match error {
        MdrError::TooManyElements { .. } => OTHER_DISTANCE,
        MdrError::TooCoarse { .. } => MORE_ELEMENTS,
        MdrError::NotConverged { .. }
        | MdrError::WorkNotReached(_)
        | MdrError::HistoryNotReached { .. }
        | MdrError::MotionNotReached { .. }
        | MdrError::NotPeriodic { .. }
        | MdrError::SlidingNotReached { .. }
        | MdrError::TooMuchDetail { .. } => LARGER_ERROR,
        MdrError::DepthBeyondEdge { .. } => LESS_LOAD,
        MdrError::TrackTooShort { .. } => LONGER_TRACK,
        MdrError::NotStationary { .. } => DISTANCE,
        MdrError::NoEquilibrium => DURATION,
        MdrError::InvalidParameter(_) | MdrError::NonFinite { .. } => UNITS,
        MdrError::Indenter(error) => of_body(error),
        _ => "",
    }
}

/// Advice for an error of the closed forms; empty if there is none.
pub(super) const fn of_closed_form(error: &FrictionError) -> &'static str {
    match error {
        FrictionError::NoStationaryState { .. } => LESS_LOAD,
        FrictionError::InvalidParameter(_) | FrictionError::OutOfRange { .. } => UNITS,
        FrictionError::Indenter(error) => of_body(error),
        _ => "",
    }
}

/// Advice for an error of the rigid body; empty if there is none.
pub(super) const fn of_body(error: &IndenterError) -> &'static str {
    match error {
        IndenterError::OutOfDomain { .. }
        | IndenterError::NonMonotoneLine { .. }
        | IndenterError::NotHighEnough { .. } => LESS_LOAD,
        IndenterError::InvalidParameter(_) => UNITS,
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use bem_halfspace::BemError;
    use mdr_core::MdrError;

    use crate::SolveError;

    /// A scene has no spacing but that of a measurement. What scenes easily lead to is tested with the program.
    #[test]
    fn what_is_not_reached_names_keys_of_the_scene() {
        let unsolved = BemError::ContactNotConverged {
            iterations: 100,
            residual: 1e-3,
            tolerance: 1e-9,
        };
        let few = MdrError::TooCoarse {
            n_contact: 2,
            needed: 3,
            spacing: 1e-3,
        };
        for (error, key) in [
            (unsolved.into(), "a larger solve.relative_error"),
            (few.into(), "give more solve.elements"),
        ] {
            let message = SolveError::to_string(&error);
            let advice = message.split_once("; ").map(|(_, advice)| advice);
            let holds = advice.is_some_and(|advice| advice.contains(key));
            assert!(holds, "no {key} in {message}");
            assert!(!message.contains("take a"), "{message}");
        }
    }
}
