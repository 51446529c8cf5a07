//! Reader of Igor text, the export format of Asylum Research: waves of numbers with a time scale and a unit.

use std::fmt::Write as _;

/// Channels of a curve, which are suffixes of its name or labels of its columns.
const CHANNELS: [&str; 6] = ["ZSnsr", "ZSensor", "Defl", "Force", "Raw", "Ind"];

/// One column of a wave.
struct Wave<'a> {
    name: &'a str,
    /// Index of the column in a wave with several columns.
    column: usize,
    label: &'a str,
    cells: Vec<&'a str>,
    /// Time of the first row, and time step of the rows, \[s].
    scale: Option<[f64; 2]>,
    unit: &'a str,
}

impl Wave<'_> {
    /// Channel of the wave, and the rest of its name, which is that of the curve; `None` without a known channel. Approach and
    /// retraction are separate curves.
    fn channel(&self) -> Option<(&'static str, String)> {
        let text = if self.label.is_empty() {
            self.name
        } else {
            self.label
        };
        let channel = CHANNELS.iter().find(|channel| text.contains(**channel))?;
        Some((channel, self.name.replace(channel, "")))
    }
}

/// Curves of Igor text, each as a table with a line of names; `None` for other texts.
pub(super) fn table(text: &str) -> Option<String> {
    let waves = text.trim_start().starts_with("IGOR").then(|| waves(text))?;
    let known = waves
        .iter()
        .filter_map(|wave| Some((wave, wave.channel()?)));
    let known: Vec<_> = known.collect();
    let mut curves: Vec<&String> = known.iter().map(|(_, (_, curve))| curve).collect();
    curves.dedup();
    let mut table = String::new();
    for curve in curves {
        let mut heads = Vec::new();
        let mut columns = Vec::new();
        for (wave, (channel, _)) in known.iter().filter(|(_, (_, one))| one == curve) {
            if let (true, Some([start, step])) = (columns.is_empty(), wave.scale) {
                heads.push("t [s]".to_owned());
                let times = (0..wave.cells.len()).map(|i| start + step * i as f64);
                columns.push(times.map(|time| format!("{time:?}")).collect::<Vec<_>>());
            }
            heads.push(format!("{channel} [{}]", wave.unit));
            columns.push(wave.cells.iter().map(ToString::to_string).collect());
        }
        let n_rows = columns.iter().map(Vec::len).min().unwrap_or_default();
        let row = |i: usize| {
            let cells: Vec<&str> = columns.iter().map(|cells| &cells[i][..]).collect();
            cells.join("\t")
        };
        let rows: Vec<String> = (0..n_rows).map(row).collect();
        let _ = writeln!(table, "{}\n{}", heads.join("\t"), rows.join("\n"));
    }
    Some(table)
}

/// All columns of all waves of a text, with their scales, units and labels.
fn waves(text: &str) -> Vec<Wave<'_>> {
    let mut waves: Vec<Wave> = Vec::new();
    let mut lines = text.lines().map(str::trim);
    while let Some(line) = lines.next() {
        if let Some(rest) = line.strip_prefix("WAVES") {
            let names: Vec<&str> = rest
                .split([' ', '\t'])
                .filter(|name| !name.starts_with('/'))
                .map(|name| name.trim_matches(['\'', ',']))
                .filter(|name| !name.is_empty())
                .collect();
            let rows = lines.by_ref().take_while(|line| *line != "END");
            let rows: Vec<Vec<&str>> = rows
                .skip(1)
                .map(|row| row.split_whitespace().collect())
                .collect();
            for column in 0..rows.first().map_or(0, Vec::len) {
                waves.push(Wave {
                    name: names
                        .get(column)
                        .or(names.last())
                        .copied()
                        .unwrap_or_default(),
                    column,
                    label: "",
                    cells: rows
                        .iter()
                        .map(|row| row.get(column).copied().unwrap_or_default())
                        .collect(),
                    scale: None,
                    unit: "m",
                });
            }
        } else if let Some(commands) = line.strip_prefix("X ") {
            commands
                .split(';')
                .for_each(|command| apply(&mut waves, command.trim()));
        }
    }
    waves
}

/// Applies `SetScale/P x start,step,"s",wave`, `SetScale d 0,0,"unit",wave` or `SetDimLabel 1,column,label,wave`.
fn apply<'a>(waves: &mut [Wave<'a>], command: &'a str) {
    let Some((verb, arguments)) = command.split_once(' ') else {
        return;
    };
    let arguments = arguments
        .split(',')
        .map(|one| one.trim().trim_matches(['"', '\'']));
    let arguments: Vec<&str> = arguments.collect();
    let [first, second, third, ref names @ ..] = arguments[..] else {
        return;
    };
    let number = |text: &str| text.trim().parse::<f64>().ok();
    for wave in waves.iter_mut().filter(|wave| names.contains(&wave.name)) {
        match (verb, first.strip_prefix("x ")) {
            ("SetScale/P", Some(start)) => {
                let scale = number(start).zip(number(second));
                wave.scale = scale.map(|(start, step)| [start, step]);
            }
            ("SetDimLabel", _) if second.parse() == Ok(wave.column) => wave.label = third,
            (_, None) if first.starts_with(['d', 'y']) && !third.is_empty() => wave.unit = third,
            _ => {}
        }
    }
}
