//! Units and sizes stated in the lines above the heights of a text.

use super::TopographyError;
use super::text::shown;
use super::units::{length, metres};

/// Units and sizes that a text states.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Stated {
    /// Unit of the heights: its length \[m] and its spelling.
    pub(super) heights: Option<(f64, String)>,
    /// Unit of x and y: its length \[m] and its spelling.
    pub(super) lateral: Option<(f64, String)>,
    /// Lengths of the map along x and y, \[m].
    pub(super) size: Option<[f64; 2]>,
}

impl Stated {
    /// Units and sizes in the lines of a header.
    ///
    /// Recognised are names of columns with units such as `x [um]`, `X/µm` or `z_nm`; pairs such as `Value units: nm`; and
    /// the size in a text of Gwyddion: width, height and unit of the values in three successive lines, in any language.
    ///
    /// # Errors
    /// [`TopographyError::Line`] for names of columns whose units are no lengths, or differ between x and y.
    pub(super) fn of(head: &[(usize, &str)]) -> Result<Self, TopographyError> {
        let mut stated = Self::default();
        // Read units from names of columns and from pairs.
        for &(line, text) in head {
            let [x, y, z] = units_of_columns(text);
            if let (Some(x), Some(y)) = (x, y) {
                let wrong = |problem: String| TopographyError::Line { line, problem };
                let known = |unit: &str| {
                    let length = metres(unit);
                    let known = length.map(|length| (length, unit.to_owned()));
                    known.ok_or_else(|| wrong(format!("the unit '{}' is no length", shown(unit))))
                };
                if x != y {
                    return Err(wrong(format!(
                        "x is in '{}' and y in '{}'",
                        shown(x),
                        shown(y)
                    )));
                }
                stated.lateral = Some(known(x)?);
                stated.heights = z.map(known).transpose()?.or(stated.heights);
            } else if let Some(unit) = z.filter(|_| !is_size(text)) {
                stated.heights = known_unit(unit).or(stated.heights);
            }
            if let Some((of, unit)) = stated_unit(text) {
                stated.heights = known_unit(unit);
                if of == StatedQuantity::Everything {
                    stated.lateral = stated.lateral.or_else(|| known_unit(unit));
                }
            }
        }
        // Read the size from three successive lines of Gwyddion.
        let values: Vec<_> = head.iter().map(|(_, text)| value_text(text)).collect();
        for (three, (line, _)) in values.windows(3).zip(&head[head.len().min(2)..]) {
            let size = (three[0].and_then(length), three[1].and_then(length));
            let ((Some(x), Some(y)), Some(unit)) = (size, three[2]) else {
                continue;
            };
            stated.size = Some([x, y]);
            if !unit.is_empty() {
                let problem = || format!("the values are in '{}', which is no length", shown(unit));
                let height = metres(unit).ok_or_else(|| TopographyError::Line {
                    line: *line,
                    problem: problem(),
                })?;
                stated.heights = Some((height, unit.to_owned()));
            }
        }
        Ok(stated)
    }

    /// Note on the stated units and sizes; `None` if there are none.
    pub(super) fn note(&self) -> Option<String> {
        let name = |unit: &Option<(f64, String)>, of: &str| {
            unit.as_ref().map(|(_, unit)| format!("{of} in {unit}"))
        };
        let units = [
            name(&self.lateral, "x and y"),
            name(&self.heights, "heights"),
        ];
        let size = self
            .size
            .map(|[x, y]| format!("a size of {x:e} m × {y:e} m"));
        let units: Vec<String> = units.into_iter().flatten().chain(size).collect();
        (!units.is_empty()).then(|| format!("the head of the file states {}", units.join(" and ")))
    }
}

/// Text after the first colon or equals sign of a line, without blanks around it; `None` without such a sign.
fn value_text(line: &str) -> Option<&str> {
    let (_, value_text) = line.split_once([':', '='])?;
    Some(value_text.trim())
}

/// Length \[m] and spelling of a unit; `None` if it is no unit of length.
fn known_unit(unit: &str) -> Option<(f64, String)> {
    metres(unit).map(|length| (length, unit.to_owned()))
}

/// Whether a line states a size such as `Height (um): 72` rather than the name of a column.
fn is_size(line: &str) -> bool {
    value_text(line).is_some_and(|value_text| value_text.replace(',', ".").parse::<f64>().is_ok())
}

/// The quantities to which a stated unit belongs.
#[derive(Clone, Copy, PartialEq)]
enum StatedQuantity {
    /// Heights only.
    Heights,
    /// Heights and x and y: the line names no quantity.
    Everything,
}

/// The unit in a line such as `Value units: nm`, `Z unit = um`, `Height unit: µm` or `Unit: µm`, and its quantity.
fn stated_unit(line: &str) -> Option<(StatedQuantity, &str)> {
    let (key, unit) = line.split_once([':', '='])?;
    let key = key.to_lowercase();
    // The key has the word unit, alone or with a name of the heights, and no name of x or y.
    let words = key.split(|letter: char| !letter.is_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    let has = |names: &[&str]| words.iter().any(|word| names.contains(word));
    let unit = unit.trim().trim_matches(['[', ']', '(', ')', '"']);
    let of_heights = [
        "z", "height", "heights", "value", "values", "data", "zunit", "zunits",
    ];
    let is_unit = has(&["unit", "units", "zunit", "zunits"]) && metres(unit).is_some();
    let is_lateral = has(&["x", "y", "xy", "lateral"]);
    match words.len() {
        1 if has(&["unit", "units"]) && is_unit => Some((StatedQuantity::Everything, unit)),
        _ if is_unit && has(&of_heights) && !is_lateral => Some((StatedQuantity::Heights, unit)),
        _ => None,
    }
}

/// The units after the names of x, y and z in a line of column names.
fn units_of_columns(line: &str) -> [Option<&str>; 3] {
    let names: [&[&str]; 3] = [&["x"], &["y"], &["z", "height", "heights"]];
    names.map(|names| names.iter().find_map(|name| unit_behind(line, name)))
}

/// The unit after a word, in brackets or after a slash or an underscore.
fn unit_behind<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    // Find the name as a whole word, and take the unit in brackets, or after a slash or an underscore.
    let mut start = 0;
    while let Some(word) = line[start..].find(char::is_alphanumeric) {
        let begin = start + word;
        let end = line[begin..]
            .find(|letter: char| !letter.is_alphanumeric())
            .map_or(line.len(), |length| begin + length);
        start = end;
        if !line[begin..end].eq_ignore_ascii_case(name) {
            continue;
        }
        let rest = line[end..].trim_start();
        for [open, close] in [['[', ']'], ['(', ')']] {
            if let Some((unit, _)) = rest
                .strip_prefix(open)
                .and_then(|rest| rest.split_once(close))
            {
                return Some(unit.trim());
            }
        }
        let unit = rest.strip_prefix(['/', '_'])?.trim_start();
        return unit.split([' ', '\t', ',', ';', '"']).next();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stated(text: &str) -> Result<Stated, TopographyError> {
        let lines = text.lines().enumerate();
        Stated::of(
            &lines
                .map(|(index, line)| (index + 1, line))
                .collect::<Vec<_>>(),
        )
    }

    #[test]
    fn units_are_found_where_programs_write_them() {
        for text in [
            "# x [um] y [um] z [nm]",
            "X(µm),Y(µm),Height (nm)",
            "x/um;y/um;z/nm",
            "\"x_um\"\t\"y_um\"\t\"z_nm\"",
            "# X [ um ]\t Y [ um ]\t Z [ nm ]",
        ] {
            let found = stated(text).expect(text);
            assert_eq!(
                found.lateral,
                Some((1e-6, found.lateral.clone().expect(text).1)),
                "{text}"
            );
            assert_eq!(found.heights.map(|(unit, _)| unit), Some(1e-9), "{text}");
        }
        for text in [
            "# Channel: Topo\n# Width: 64.00 µm\n# Height: 72 um\n# Value units: nm",
            "# Kanal: Topo\n# Breite: 64,00 µm\n# Höhe: 0.072 mm\n# Werteeinheiten: nm",
        ] {
            let found = stated(text).expect(text);
            let [x, y] = found.size.expect(text);
            assert!(
                (x - 64e-6).abs() < 1e-18 && (y - 72e-6).abs() < 1e-18,
                "{text}: {x}, {y}"
            );
            assert_eq!(found.heights.map(|(unit, _)| unit), Some(1e-9), "{text}");
        }
    }

    #[test]
    fn only_units_of_lengths_count() {
        let found = stated("Z unit = um\nX unit = mm").expect("a unit");
        assert_eq!(
            (found.heights.map(|(unit, _)| unit), found.lateral),
            (Some(1e-6), None)
        );
        let found = stated("# Units = µm").expect("a unit");
        let units = (
            found.heights.map(|(unit, _)| unit),
            found.lateral.map(|(unit, _)| unit),
        );
        assert_eq!(units, (Some(1e-6), Some(1e-6)));
        for text in [
            "Height (um): 72",
            "# um",
            "# x y z",
            "# Height (relative to the mean)",
            "x: 3 V\ny: 2\nz: V",
        ] {
            assert_eq!(stated(text), Ok(Stated::default()), "{text}");
        }
        let volts = "# Channel: Amplitude\n# Width: 64 um\n# Height: 72 um\n# Value units: V";
        for text in [
            volts,
            "x [px] y [px] z [nm]",
            "x [um] y [mm] z [um]",
            "x (um), y (um), z (V)",
        ] {
            stated(text).expect_err(text);
        }
    }
}
