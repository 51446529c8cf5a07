//! Calls of cargo and other programs, and the count of the tests that cargo ran.

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

/// Cargo, with the number of tests that have passed and failed under it.
#[derive(Debug, Default)]
pub(super) struct Cargo {
    passed: u64,
    failed: u64,
}

impl Cargo {
    /// Runs cargo, shows what it prints to both outputs, and counts the tests that it reports.
    pub(super) fn run(&mut self, arguments: &str) -> Result<()> {
        let (output, input) = std::io::pipe()?;
        let mut command = cargo(arguments);
        command.stdout(input.try_clone()?).stderr(input);
        let mut child = command.spawn().context("calling cargo")?;
        // Drop the command, and with it our ends of the pipe, which then closes when the child ends.
        drop(command);
        for bytes in BufReader::new(output).split(b'\n') {
            let bytes = bytes?;
            let line = String::from_utf8_lossy(&bytes);
            println!("{line}");
            self.count(&line);
        }
        let status = child.wait()?;
        ensure!(status.success(), "cargo {arguments}: {status}");
        Ok(())
    }

    /// Runs all tests of a `scope`, arguments of cargo such as `--workspace`: by nextest and then those in the documentation,
    /// which nextest does not run, or, where nextest is not installed, all by cargo itself.
    pub(super) fn test(&mut self, scope: &str) -> Result<()> {
        let scope = format!("--no-fail-fast {scope}");
        if output(&mut cargo("nextest --version")).is_err() {
            return self.run(&format!("test --profile ci {scope}"));
        }
        let nextest = self.run(&format!(
            "nextest run --cargo-profile ci --no-tests pass {scope}"
        ));
        self.run(&format!("test --profile ci --doc {scope}"))?;
        nextest
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

impl fmt::Display for Cargo {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} passed, {} failed", self.passed, self.failed)
    }
}

#[cfg(test)]
mod tests {
    use super::Cargo;

    #[test]
    fn the_last_line_is_the_sum_over_all_runs() {
        let mut cargo = Cargo::default();
        for line in [
            "running 3 tests",
            "test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.10s",
            "test result: FAILED. 3 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.20s",
            "     Summary [   1.005s] 9 tests run: 7 passed (1 slow), 2 failed, 4 skipped",
            "    test result: FAILED. 0 passed; 1 failed; 0 ignored; 0 measured; 9 filtered out; finished in 0.10s",
            "99 passed; this is no result",
        ] {
            cargo.count(line);
        }
        assert_eq!(cargo.to_string(), "22 passed, 4 failed", "{cargo:?}");
    }
}
