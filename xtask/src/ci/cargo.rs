//! Calls of cargo and other programs, what they print, and the count of the tests that cargo ran.

use std::fmt;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

/// The folder of the workspace, of which this crate is a subfolder.
pub(crate) fn workspace_root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Cargo with arguments that are separated by blanks, in the folder of the workspace.
pub(crate) fn cargo(arguments: &str) -> Command {
    // Run the cargo that runs `cargo xtask`, which it names in this variable.
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(arguments.split_whitespace());
    command.current_dir(workspace_root());
    command
}

/// Prints a command and runs it with its output shown; fails unless it succeeds.
pub(super) fn run(command: &mut Command) -> Result<()> {
    println!("{command:?}");
    let status = command.status().with_context(|| format!("{command:?}"))?;
    ensure!(status.success(), "{command:?}: {status}");
    Ok(())
}

/// What a program prints to standard output. Fails unless it succeeds, with what it printed to standard error.
pub(crate) fn output(command: &mut Command) -> Result<String> {
    let output = command.output().with_context(|| format!("{command:?}"))?;
    let errors = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{command:?}: {errors}");
    Ok(String::from_utf8(output.stdout)?)
}

/// What the programs of some steps print, with the number of tests that have passed and failed.
#[derive(Debug, Default)]
pub(super) struct Transcript {
    pub(super) tests: TestCount,
    /// Lines that are not shown yet, of steps that run beside others; `None` if every line is shown at once.
    held: Option<String>,
}

/// Number of tests.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct TestCount {
    passed: u64,
    failed: u64,
}

impl Transcript {
    /// A transcript whose lines are shown together, when [`Self::show`] is called.
    pub(super) fn held() -> Self {
        Self {
            held: Some(String::new()),
            ..Self::default()
        }
    }

    /// Adds a line.
    pub(super) fn add(&mut self, line: &str) {
        match &mut self.held {
            Some(held) => *held += &format!("{line}\n"),
            None => println!("{line}"),
        }
    }

    /// Shows the lines that are held.
    pub(super) fn show(&mut self) {
        if let Some(held) = &mut self.held {
            // One call of the macro, because no other thread prints between its lines then.
            print!("{held}");
            held.clear();
        }
    }

    /// Runs cargo, see [`Self::run`].
    pub(super) fn cargo(&mut self, arguments: &str) -> Result<()> {
        self.run(cargo(arguments))
    }

    /// Runs a program, adds what it prints to both outputs, and counts the tests that it reports. Fails unless it succeeds.
    pub(super) fn run(&mut self, mut command: Command) -> Result<()> {
        let call = call(&command);
        self.add(&call);
        let (output, input) = std::io::pipe()?;
        command.stdout(input.try_clone()?).stderr(input);
        let mut child = command.spawn().with_context(|| call.clone())?;
        // Drop the command, and with it our ends of the pipe, which then closes when the child ends.
        drop(command);
        for bytes in BufReader::new(output).split(b'\n') {
            let bytes = bytes?;
            let line = String::from_utf8_lossy(&bytes);
            self.add(&line);
            self.tests.count(&line);
        }
        let status = child.wait()?;
        ensure!(status.success(), "{call}: {status}");
        Ok(())
    }
}

/// A program, without its folder, and its arguments.
fn call(command: &Command) -> String {
    let program = Path::new(command.get_program()).file_stem();
    let words = program.into_iter().chain(command.get_args());
    let words: Vec<_> = words.map(|word| word.to_string_lossy()).collect();
    words.join(" ")
}

impl TestCount {
    /// The tests of two transcripts together.
    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            passed: self.passed + other.passed,
            failed: self.failed + other.failed,
        }
    }

    /// Adds the tests passed and failed if `line` is the closing line of a run of cargo or nextest; ignores other lines.
    fn count(&mut self, line: &str) {
        // Count a line of `test result` only if no blank precedes it: a test that has failed shows its own run below it,
        // indented.
        if !line.starts_with("test result: ") && !line.trim_start().starts_with("Summary [") {
            return;
        }
        let words: Vec<&str> = line.split([' ', ',', ';']).collect();
        for pair in words.windows(2) {
            match (pair[0].parse::<u64>(), pair[1]) {
                (Ok(number), "passed") => self.passed += number,
                (Ok(number), "failed" | "timed") => self.failed += number,
                _ => {}
            }
        }
    }
}

impl fmt::Display for TestCount {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} passed, {} failed", self.passed, self.failed)
    }
}

#[cfg(test)]
mod tests {
    use super::TestCount;

    #[test]
    fn the_last_line_is_the_sum_over_all_runs() {
        let mut tests = TestCount::default();
        for line in [
            "running 3 tests",
            "test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.10s",
            "test result: FAILED. 3 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.20s",
            "     Summary [   1.005s] 9 tests run: 7 passed (1 slow), 2 failed, 4 skipped",
            "    test result: FAILED. 0 passed; 1 failed; 0 ignored; 0 measured; 9 filtered out; finished in 0.10s",
            "99 passed; this is no result",
        ] {
            tests.count(line);
        }
        assert_eq!(tests.to_string(), "22 passed, 4 failed", "{tests:?}");
    }
}
