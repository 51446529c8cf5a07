//! The table of radii and heights that a scene names.

use std::path::Path;

use indenters::PiecewiseLinearProfile;
use serde::Deserialize;

use super::SceneError;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    radius_m: f64,
    height_m: f64,
}

/// Reads a profile from a CSV file with the columns `radius_m` and `height_m`.
///
/// # Errors
/// [`SceneError::Together`] at the key of the file when it cannot be read or is no profile.
pub(crate) fn read_profile(path: &Path) -> Result<PiecewiseLinearProfile, SceneError> {
    let wrong = |problem: String| {
        let problem = format!("{}: {problem}", path.display());
        SceneError::together("indenter.table.file", problem)
    };
    let mut reader = csv::Reader::from_path(path).map_err(|error| wrong(error.to_string()))?;
    let rows = reader.deserialize().collect::<Result<Vec<Row>, _>>();
    let rows = rows.map_err(|error| wrong(error.to_string()))?;
    let radii = rows.iter().map(|row| row.radius_m).collect();
    let heights = rows.iter().map(|row| row.height_m).collect();
    PiecewiseLinearProfile::new(radii, heights).map_err(|error| wrong(error.to_string()))
}
