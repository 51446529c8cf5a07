//! What building a crate takes.

use std::fs;

use anyhow::{Context, Result};

use crate::ci::command::cargo;

/// Unit of the times that Linux tells about processes, \[s].
const TICK: f64 = 0.01;

/// Builds a crate alone, without its optional features and from nothing; returns the processor time, \[s].
pub(super) fn processor_seconds(library: &str) -> Result<f64> {
    let folder = std::env::temp_dir().join(format!("build-{library}-{}", std::process::id()));
    let target = folder
        .to_str()
        .context("the folder for temporary files is no Unicode")?;
    let before = of_ended_children()?;
    let arguments = [
        "build",
        "--quiet",
        "--release",
        "--package",
        library,
        "--no-default-features",
    ];
    let built = cargo(&[&arguments[..], &["--target-dir", target]].concat(), &[]);
    fs::remove_dir_all(&folder).with_context(|| format!("removing {target}"))?;
    built?;
    Ok(of_ended_children()? - before)
}

/// User and system time of all processes that were waited for, \[s].
fn of_ended_children() -> Result<f64> {
    let file = "/proc/self/stat";
    let text = fs::read_to_string(file).context("processor times are known on Linux only")?;
    // Behind the name, which is in parentheses, the numbers of the children are the 14th and 15th.
    let numbers = text
        .rsplit_once(')')
        .map(|(_, rest)| rest.split_whitespace().skip(13).take(2));
    let ticks = numbers.map(|numbers| numbers.map(str::parse::<f64>).sum::<Result<f64, _>>());
    Ok(TICK * ticks.context(file)??)
}
