//! Runs of the program: answer and processor time.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread::sleep;
use std::time::Duration;

use anyhow::{Context, Result, ensure};
use serde_json::Value;
use viscofriction::Estimate;

use super::cases::{BenchmarkScene, Case};
use super::transformation::variable;

/// A program that solves scenes.
pub(super) struct Program {
    file: PathBuf,
}

/// A value of a constant that a program is given.
#[derive(Clone, Copy)]
pub(super) struct Tried<'a> {
    pub(super) case: &'a Case,
    /// Place of the value among those of the case, from 1 on.
    pub(super) place: usize,
    pub(super) value: &'a str,
}

/// What one run of the program gave.
pub(super) struct Run {
    pub(super) answer: Result<Answer, Failure>,
    /// Processor time of the run \[s].
    pub(super) processor_seconds: f64,
}

/// The parts of an answer that are compared.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Answer {
    /// Compared quantities by name, in SI units.
    pub(super) quantities: BTreeMap<String, Estimate>,
    /// Number of unknowns, and below of iterations, if the program states them.
    pub(super) unknowns: Option<f64>,
    pub(super) iterations: Option<f64>,
}

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Failure {
    /// The program ended with an error, whose last line this is.
    Refused(String),
    /// The program was ended after this processor time, \[s].
    Unfinished(f64),
}

/// Pause between two checks whether a run has ended. Chosen: it is short against the shortest runs, and almost no load.
const POLLING_INTERVAL: Duration = Duration::from_millis(2);

impl Program {
    /// The program `viscofriction` in the build of `folder`.
    pub(super) fn new(folder: &Path) -> Self {
        let file = folder.join("viscofriction");
        Self {
            file: file.with_extension(std::env::consts::EXE_EXTENSION),
        }
    }

    /// Solves the scene in `file` with the arguments of `scene` on one thread. A run that takes more processor time than the
    /// limit \[s] is ended. Its output is kept in the folder of the program.
    pub(super) fn solve(
        &self,
        scene: &BenchmarkScene,
        file: &Path,
        limit: f64,
        tried: Option<Tried>,
    ) -> Result<Run> {
        let [printed, errors] =
            ["tuning.json", "tuning.err"].map(|extension| self.file.with_extension(extension));
        let before = processor_seconds("self", FIELDS_BEFORE_CHILDREN)?;
        let mut command = Command::new(&self.file);
        command.arg("run").arg(file).args(["--format", "json"]);
        command.args(&scene.arguments).env("RAYON_NUM_THREADS", "1");
        command.envs(tried.map(|tried| (variable(tried.case), tried.place.to_string())));
        command
            .stdout(File::create(&printed)?)
            .stderr(File::create(&errors)?);
        let mut child = command.spawn().with_context(|| format!("{command:?}"))?;
        let process = child.id().to_string();
        let mut status = child.try_wait()?;
        while status.is_none() && processor_seconds(&process, FIELDS_BEFORE_OWN)? < limit {
            sleep(POLLING_INTERVAL);
            status = child.try_wait()?;
        }
        if status.is_none() {
            child.kill()?;
            child.wait()?;
        }
        let answer = match status {
            None => Err(Failure::Unfinished(limit)),
            Some(status) if status.success() => Ok(Answer::read(&printed, &scene.quantities)?),
            Some(_) => {
                let text = fs::read_to_string(&errors)?;
                Err(Failure::Refused(
                    text.lines().last().unwrap_or_default().to_owned(),
                ))
            }
        };
        Ok(Run {
            answer,
            processor_seconds: processor_seconds("self", FIELDS_BEFORE_CHILDREN)? - before,
        })
    }
}

impl Answer {
    /// Reads the quantities `names` from an answer in JSON; a name is a path within it, separated by slashes. Fails where one
    /// of them or its error is missing.
    fn read(printed: &Path, names: &[String]) -> Result<Self> {
        let answer: Value = serde_json::from_str(&fs::read_to_string(printed)?)?;
        let number = |name: &str| answer.pointer(&format!("/{name}")).and_then(Value::as_f64);
        let known = |name: &String| {
            let value = number(name).with_context(|| format!("the answer has no {name}"))?;
            let error = number(&format!("{name}_error"))
                .with_context(|| format!("the answer has no error of {name}"))?;
            Ok((name.clone(), Estimate::new(value, error)))
        };
        Ok(Self {
            quantities: names.iter().map(known).collect::<Result<_>>()?,
            unknowns: number("unknowns"),
            iterations: number("iterations"),
        })
    }
}

/// Number of fields in `/proc/PROCESS/stat` between the name of the program, in parentheses, and `utime` and `stime`, the user
/// and system time of the process (man 5 proc_pid_stat).
const FIELDS_BEFORE_OWN: usize = 11;
/// Number of fields in the same file between the name of the program and `cutime` and `cstime`, the times of its children that
/// have ended.
const FIELDS_BEFORE_CHILDREN: usize = 13;
/// Clock ticks per second in `/proc` (`USER_HZ` of Linux), on all architectures for which there is a Rust compiler.
const TICKS_PER_SECOND: f64 = 100.0;

/// Processor time of a process, or of its children that have ended, \[s], which Linux counts in steps of 10 ms.
fn processor_seconds(process: &str, fields_before: usize) -> Result<f64> {
    let text = fs::read_to_string(format!("/proc/{process}/stat"))
        .context("processor times need Linux")?;
    let fields = text.rsplit_once(')').map_or("", |(_, fields)| fields);
    let times = fields.split_whitespace().skip(fields_before).take(2);
    let ticks = times
        .map(|time| Ok(time.parse::<f64>()?))
        .collect::<Result<Vec<_>>>()?;
    ensure!(
        ticks.len() == 2,
        "/proc/{process}/stat has no times: {text}"
    );
    Ok((ticks[0] + ticks[1]) / TICKS_PER_SECOND)
}
