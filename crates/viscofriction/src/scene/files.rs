//! Readers of the CSV tables that a scene names: profiles, spectra, motions and histories.

use std::path::Path;

use csv::{ErrorKind, ReaderBuilder, StringRecord, Trim};
use encoding_rs::UTF_8;
use indenters::rough::TabulatedSpectrum;
use indenters::{IndenterError, PiecewiseLinearProfile};
#[cfg(feature = "fit")]
use measurements::strain::{StrainSweepOptions, strain_sweep};
use numerics::{InvalidParameter, MessageNumber, not_negative, positive};
use rheology::StrainDependence;
#[cfg(feature = "fit")]
use rheology::{RheologyError, ShearStrength, ShearStrengthPoint};
use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::interface::ShearLaw;
use super::load::{LoadPoint, MotionPoint};
use super::strain::{StrainAmplitude, StrainDeformation};
use crate::text::{RecordLines, line_of};

/// A row of the profile of a body of revolution, \[m].
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct ProfileRow {
    radius_m: f64,
    height_m: f64,
}

/// A profile from the contents of a CSV file with the columns `radius_m` and `height_m`.
///
/// # Errors
/// A message with file, line and problem.
pub fn profile(file: &Path, contents: &[u8]) -> Result<PiecewiseLinearProfile, String> {
    let wrong = |(line, problem): (usize, String)| located(file, line, &problem);
    let rows = rows::<ProfileRow>(contents).map_err(wrong)?;
    let radii = rows.iter().map(|(_, row)| row.radius_m).collect();
    let heights = rows.iter().map(|(_, row)| row.height_m).collect();
    PiecewiseLinearProfile::new(radii, heights)
        .map_err(|error| wrong((line_of_error(&error, &rows), error.to_string())))
}

/// A row of a power spectrum: wave number \[1/m] and density \[m⁴].
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct SpectrumRow {
    wave_number: f64,
    density: f64,
    /// Number of wave vectors in the ring of a measured spectrum; read and ignored.
    #[serde(rename = "waves")]
    _waves: Option<f64>,
}

/// A power spectrum from the contents of a CSV file with the columns `wave_number` and `density`; densities are multiplied by
/// `factor`.
///
/// # Errors
/// A message with file, line and problem.
pub fn spectrum(file: &Path, contents: &[u8], factor: f64) -> Result<TabulatedSpectrum, String> {
    let wrong = |(line, problem): (usize, String)| located(file, line, &problem);
    let rows = rows::<SpectrumRow>(contents).map_err(wrong)?;
    let mut before = 0.0;
    for (line, row) in &rows {
        let refused = |error: InvalidParameter| wrong((*line, error.to_string()));
        positive("wave_number", row.wave_number).map_err(refused)?;
        not_negative("density", row.density).map_err(refused)?;
        if row.wave_number <= before {
            let [found, before] = [row.wave_number, before].map(MessageNumber);
            let problem = "wave_number must be larger than in the row before, but is";
            return Err(wrong((*line, format!("{problem} {found} after {before}"))));
        }
        before = row.wave_number;
    }
    let wave_numbers = rows.iter().map(|(_, row)| row.wave_number).collect();
    let densities = rows.iter().map(|(_, row)| factor * row.density).collect();
    let last = rows.last().map_or(1, |(line, _)| *line);
    TabulatedSpectrum::new(wave_numbers, densities)
        .map_err(|error| wrong((last, error.to_string())))
}

/// Shear strengths from the contents of a table over velocity and temperature; the error is a message with file and line.
#[cfg(feature = "fit")]
pub(super) fn shear_strengths(file: &Path, contents: &[u8]) -> Result<ShearLaw, String> {
    let rows = measurements::shear::shear_strength_rows(file, contents)
        .map_err(|error| error.to_string())?;
    let points: Vec<ShearStrengthPoint> = rows.iter().map(|row| row.point).collect();
    let strength = ShearStrength::table(&points).map_err(|error| {
        let row = match &error {
            RheologyError::InvalidElement { index, .. } => rows.get(*index),
            _ => rows.last(),
        };
        located(file, row.map_or(1, |row| row.line), &error.to_string())
    })?;
    let uncertain = rows.iter().filter_map(|row| {
        let error = row.standard_error?;
        Some((row.point, error / row.point.shear_strength))
    });
    Ok(ShearLaw {
        strength,
        uncertain_rows: uncertain.collect(),
    })
}

/// Rejects a table of shear strengths, whose reader is that of measurements.
#[cfg(not(feature = "fit"))]
pub(super) fn shear_strengths(file: &Path, _: &[u8]) -> Result<ShearLaw, String> {
    Err(unread(file))
}

/// Factors of the moduli over the strain amplitude from the contents of a CSV file; the error is a message with file and line.
#[cfg(feature = "fit")]
pub(super) fn strain_dependence(
    file: &Path,
    contents: &[u8],
    deformation: Option<StrainDeformation>,
    amplitude: StrainAmplitude,
) -> Result<StrainDependence, String> {
    use measurements::moduli::Deformation;
    let options = StrainSweepOptions {
        deformation: deformation.map(|deformation| match deformation {
            StrainDeformation::Tension => Deformation::Tension,
            StrainDeformation::Shear => Deformation::Shear,
        }),
        is_double: amplitude == StrainAmplitude::Double,
    };
    strain_sweep(file, contents, &options).map_err(|error| error.to_string())
}

/// Without the readers of measured tables no strain sweep is read.
#[cfg(not(feature = "fit"))]
pub(super) fn strain_dependence(
    file: &Path,
    _: &[u8],
    _: Option<StrainDeformation>,
    _: StrainAmplitude,
) -> Result<StrainDependence, String> {
    Err(unread(file))
}

/// The error of a build without the readers of measured tables.
#[cfg(not(feature = "fit"))]
fn unread(file: &Path) -> String {
    let file = file.display();
    format!("{file}: this build reads no measured tables; the feature fit of viscofriction does")
}

/// A row of a load history: time \[s], and force \[N] or depth \[m].
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct HistoryTableRow {
    time_s: f64,
    normal_force_n: Option<f64>,
    indentation_depth_m: Option<f64>,
}

/// A row of a motion: time \[s], position along the surface \[m], and optionally force \[N] or depth \[m].
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct MotionTableRow {
    time_s: f64,
    position_m: f64,
    normal_force_n: Option<f64>,
    indentation_depth_m: Option<f64>,
}

/// A motion from the contents of a CSV file with the columns `time_s` and `position_m`, and optionally `indentation_depth_m`
/// or `normal_force_n`. Times increase; the error is a message with file and line.
pub(super) fn motion(file: &Path, contents: &[u8]) -> Result<Vec<MotionPoint>, String> {
    let wrong = |(line, problem): (usize, String)| located(file, line, &problem);
    let rows = rows::<MotionTableRow>(contents).map_err(wrong)?;
    check_count(rows.len(), rows.first().map(|(line, _)| *line)).map_err(wrong)?;
    let controls = |row: &MotionTableRow| [row.normal_force_n, row.indentation_depth_m];
    let first = controls(&rows[0].1).map(|one| one.is_some());
    let mut before = None;
    let point = |(line, row): (usize, MotionTableRow)| {
        let check = || {
            check_time(row.time_s, before, |time, before| time > before)?;
            check_finite("position_m", row.position_m)?;
            check_control(controls(&row), first)
        };
        check().map_err(|problem| wrong((line, problem)))?;
        before = Some(row.time_s);
        Ok(MotionPoint {
            time: row.time_s,
            position: row.position_m,
            normal_force: row.normal_force_n,
            indentation_depth: row.indentation_depth_m,
        })
    };
    rows.into_iter().map(point).collect()
}

/// A history from the contents of a CSV file with the columns `time_s` and `indentation_depth_m` or `normal_force_n`. Times do
/// not decrease; the error is a message with file and line.
pub(super) fn history(file: &Path, contents: &[u8]) -> Result<Vec<LoadPoint>, String> {
    let wrong = |(line, problem): (usize, String)| located(file, line, &problem);
    let rows = rows::<HistoryTableRow>(contents).map_err(wrong)?;
    check_count(rows.len(), rows.first().map(|(line, _)| *line)).map_err(wrong)?;
    let controls = |row: &HistoryTableRow| [row.normal_force_n, row.indentation_depth_m];
    let first = controls(&rows[0].1).map(|one| one.is_some());
    let mut before = None;
    let point = |(line, row): (usize, HistoryTableRow)| {
        let check = || {
            check_time(row.time_s, before, |time, before| time >= before)?;
            check_control(controls(&row), first)?;
            match controls(&row) {
                [None, None] => Err("normal_force_n or indentation_depth_m is needed".to_owned()),
                _ => Ok(()),
            }
        };
        check().map_err(|problem| wrong((line, problem)))?;
        before = Some(row.time_s);
        Ok(LoadPoint {
            time: row.time_s,
            normal_force: row.normal_force_n,
            indentation_depth: row.indentation_depth_m,
        })
    };
    rows.into_iter().map(point).collect()
}

/// Rejects a table of fewer than two rows; `first` is the line of its first row, if there is one. The error is line and
/// problem.
fn check_count(count: usize, first: Option<usize>) -> Result<(), (usize, String)> {
    match count {
        0 | 1 => {
            let problem = format!(
                "two rows below the line of names are needed at least, and there are {count}"
            );
            Err((first.unwrap_or(1), problem))
        }
        _ => Ok(()),
    }
}

/// Rejects a time \[s] that is not finite, is negative, or for which `follows(time, before)` does not hold.
fn check_time(time: f64, before: Option<f64>, follows: fn(f64, f64) -> bool) -> Result<(), String> {
    check_finite("time_s", time)?;
    if time < 0.0 {
        return Err(format!(
            "time_s must be at least 0, but is {}",
            MessageNumber(time)
        ));
    }
    match before {
        Some(before) if !follows(time, before) => {
            let [time, before] = [time, before].map(MessageNumber);
            Err(format!(
                "time_s must not go back, but is {time} after {before}"
            ))
        }
        _ => Ok(()),
    }
}

/// Rejects a number that is not finite.
fn check_finite(column: &str, number: f64) -> Result<(), String> {
    match number.is_finite() {
        true => Ok(()),
        false => Err(format!(
            "{column} must be finite, but is {}",
            MessageNumber(number)
        )),
    }
}

/// Rejects a row whose force and depth are not given like those of the first row, or are both given; and a negative force.
/// `controls` are force and depth of the row, `first` says which of them the first row has.
fn check_control(controls: [Option<f64>; 2], first: [bool; 2]) -> Result<(), String> {
    let names = ["normal_force_n", "indentation_depth_m"];
    for (name, number) in names.into_iter().zip(controls) {
        number.map_or(Ok(()), |number| check_finite(name, number))?;
    }
    if let [Some(force), _] = controls
        && force < 0.0
    {
        let force = MessageNumber(force);
        return Err(format!("normal_force_n must be at least 0, but is {force}"));
    }
    let given = controls.map(|one| one.is_some());
    match first {
        [true, true] => {
            Err("either normal_force_n or indentation_depth_m is given, not both".to_owned())
        }
        _ if given != first => {
            let found = |has: [bool; 2]| match has {
                [false, false] => "neither",
                [true, false] => names[0],
                [false, true] => names[1],
                [true, true] => "both",
            };
            let [found, first] = [found(given), found(first)];
            Err(format!(
                "all rows have a normal_force_n, all an indentation_depth_m, or none, but this has {found} and the first {first}"
            ))
        }
        _ => Ok(()),
    }
}

/// A message with file and line, as `FILE:LINE: PROBLEM`.
fn located(file: &Path, line: usize, problem: &str) -> String {
    format!("{}:{line}: {problem}", file.display())
}

/// The rows of a CSV table with their lines, or the line and problem of the first invalid row. The text is UTF-8, or UTF-16
/// with a byte-order mark; columns are separated by commas, semicolons or tabs; comments begin with `#`.
fn rows<R: DeserializeOwned>(contents: &[u8]) -> Result<Vec<(usize, R)>, (usize, String)> {
    let (text, separator) = decoded(contents)?;
    let mut reader = ReaderBuilder::new()
        .delimiter(separator)
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let mut lines = RecordLines::new(text.as_bytes());
    let names = reader.headers().cloned().map_err(|error| {
        let line = lines.of(error.position());
        (line, csv_problem(&error, [&StringRecord::new(); 2]))
    })?;
    let head = lines.of(names.position());
    let mut rows = Vec::new();
    for record in reader.records() {
        let wrong = |error: csv::Error, record: &StringRecord, lines: &mut RecordLines<'_>| {
            let is_of_names =
                matches!(error.kind(), ErrorKind::Deserialize { err, .. } if err.field().is_none());
            let line = if is_of_names {
                head
            } else {
                lines.of(error.position())
            };
            (line, csv_problem(&error, [&names, record]))
        };
        let record = record.map_err(|error| wrong(error, &StringRecord::new(), &mut lines))?;
        let row = record
            .deserialize(Some(&names))
            .map_err(|error| wrong(error, &record, &mut lines))?;
        rows.push((lines.of(record.position()), row));
    }
    Ok(rows)
}

/// The decoded text, with decimal points for decimal commas and empty lines for comments, so that line numbers stay. Also the
/// separator: the first comma, semicolon or tab in the line of names. The error is line and problem.
fn decoded(contents: &[u8]) -> Result<(String, u8), (usize, String)> {
    let (text, encoding, is_garbled) = UTF_8.decode(contents);
    if is_garbled {
        let first = contents.utf8_chunks().next();
        let n_valid_bytes = first.map_or(0, |chunk| chunk.valid().len());
        let problem = format!("the text is no {}", encoding.name());
        return Err((line_of(contents, n_valid_bytes), problem));
    }
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let is_read = |line: &str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let lines = text
        .lines()
        .map(|line| if is_read(line) { line } else { "" });
    let lines: Vec<&str> = lines.collect();
    let names = lines.iter().find(|line| !line.is_empty());
    let mut separators = names.into_iter().flat_map(|names| names.bytes());
    let separator = separators.find(|byte| b",;\t".contains(byte));
    let text = lines.join("\n");
    let Some(separator @ (b';' | b'\t')) = separator else {
        return Ok((text, b','));
    };
    // With semicolons or tabs a comma can only be a decimal comma.
    let mixed = lines
        .iter()
        .position(|line| line.contains(',') && text.contains('.'));
    if let Some(line) = mixed {
        let problem = "decimal commas are needed, or decimal points, and not both".to_owned();
        return Err((line + 1, problem));
    }
    Ok((text.replace(',', "."), separator))
}

/// Message for an error of the CSV reader, with the name of the column and the contents of the cell where they are known. The
/// two records are the names of the columns and the row.
fn csv_problem(error: &csv::Error, [names, record]: [&StringRecord; 2]) -> String {
    match error.kind() {
        ErrorKind::Deserialize { err, .. } => {
            let field = err.field().and_then(|field| usize::try_from(field).ok());
            match field.and_then(|field| Some((names.get(field)?, record.get(field)?))) {
                Some((name, found)) => format!("{name}: a number is needed, but it is {found:?}"),
                None => err.kind().to_string().replace(" field `", " column `"),
            }
        }
        ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => format!("{expected_len} values are needed, but there are {len}"),
        _ => error.to_string(),
    }
}

/// Line of the row of a profile that its constructor rejects; the last line if the error names no row.
fn line_of_error(error: &IndenterError, rows: &[(usize, ProfileRow)]) -> usize {
    let has = |row: &ProfileRow, value: f64| {
        let numbers = [row.radius_m, row.height_m];
        numbers.map(f64::to_bits).contains(&value.to_bits())
    };
    let row = match error {
        IndenterError::NotIncreasing { index, .. } => rows.get(*index),
        IndenterError::InvalidParameter(refused) => {
            rows.iter().find(|(_, row)| has(row, refused.value))
        }
        _ => rows.last(),
    };
    row.map_or(1, |(line, _)| *line)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The notations of different locales and programs give the same motion.
    #[test]
    fn a_path_is_read_from_every_plain_table() {
        let plain = "time_s,position_m\n0,0\n0.5,1.5e-3\n";
        let read = |text: &[u8]| motion(Path::new("path.csv"), text);
        let expected = read(plain.as_bytes()).expect("a path");
        let [semicolons, tabs] = [";", "\t"].map(|mark| plain.replace(',', mark).replace('.', ","));
        let wide = std::iter::once(0xfeff).chain(tabs.encode_utf16());
        let wide: Vec<u8> = wide.flat_map(u16::to_le_bytes).collect();
        for text in [
            semicolons.as_bytes(),
            tabs.as_bytes(),
            &wide,
            b"# of a drive\ntime_s , position_m\n0 , 0\n# half way\n0.5 , 1.5e-3\n",
            b" # of a drive\r \rtime_s;position_m\r0;0\r\t# half way\r0.5;1.5e-3\r",
            b"\xef\xbb\xbf\"time_s\",\"position_m\"\r\n0,0\r\n\r\n\"0.5\",1.5e-3\r\n",
        ] {
            assert_eq!(read(text), Ok(expected.clone()), "{}", text.escape_ascii());
        }
    }

    #[test]
    fn wrong_names_are_in_the_line_of_names() {
        let read =
            |text: &str| motion(Path::new("path.csv"), text.as_bytes()).expect_err("refused");
        for (text, place) in [
            ("time_s,place\n0,0\n", "path.csv:1: "),
            ("# a drive\n\ntime_s\n0\n", "path.csv:3: "),
            (
                "time_s;position_m\n0;0\n0.5;1,500\n",
                "path.csv:3: decimal commas",
            ),
            (
                " # drive\n\ntime_s,position_m\n0,0\n #\n1,x\n",
                "path.csv:6: position_m: ",
            ),
        ] {
            let refused = read(text);
            assert!(refused.starts_with(place), "{refused}");
        }
    }
}
