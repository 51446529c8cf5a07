//! Reader of tables of the Python package afmformats (`.tab`): names in the last comment, quantities in SI.

/// Names of the columns of a table of afmformats, and their units, which the format does not state.
const UNITS: [(&str, &str); 5] = [
    ("time", "s"),
    ("force", "N"),
    ("height (measured)", "m"),
    ("height (piezo)", "m"),
    ("tip position", "m"),
];

/// The text of a table of afmformats with the units added to its line of names; `None` for other texts.
pub(super) fn table(text: &str) -> Option<String> {
    if !(text.starts_with("# afmformats") || text.starts_with("# BEGIN METADATA")) {
        return None;
    }
    let is_comment = |line: &&str| line.starts_with('#') || line.trim().is_empty();
    let above = text.lines().take_while(is_comment).enumerate();
    let (head, line) = above.filter(|(_, line)| line.starts_with('#')).last()?;
    let with_unit = |name: &str| {
        let unit = UNITS.iter().find(|(known, _)| *known == name);
        unit.map_or_else(|| name.to_owned(), |(_, unit)| format!("{name} [{unit}]"))
    };
    let columns = line.trim_start_matches('#').trim().split('\t');
    let names: Vec<String> = columns.map(|name| with_unit(name.trim())).collect();
    let line_of_names = format!("# {}", names.join("\t"));
    let lines: Vec<&str> = text
        .lines()
        .enumerate()
        .map(|(at, line)| if at == head { &*line_of_names } else { line })
        .collect();
    Some(lines.join("\n"))
}
