//! Calls of cargo.

use std::ffi::OsString;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

/// The folder of the workspace.
pub(super) fn workspace_root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Runs cargo with its output on the terminal.
pub(super) fn cargo(arguments: &[&str], variables: &[(&str, &str)]) -> Result<()> {
    let mut command = command(arguments);
    command.envs(variables.iter().copied());
    let status = command.status().with_context(|| say(arguments))?;
    ensure!(status.success(), "{}: {status}", say(arguments));
    Ok(())
}

/// Runs cargo and returns what it prints.
pub(super) fn cargo_output(arguments: &[&str]) -> Result<String> {
    let output = command(arguments).stderr(Stdio::inherit()).output();
    let output = output.with_context(|| say(arguments))?;
    ensure!(
        output.status.success(),
        "{}: {}",
        say(arguments),
        output.status
    );
    String::from_utf8(output.stdout).with_context(|| say(arguments))
}

/// Runs all tests of a scope, and passes each line of their output to the terminal and to `read`.
pub(super) fn cargo_test(scope: &[&str], mut read: impl FnMut(&str)) -> Result<()> {
    let arguments = [&["test", "--release", "--no-fail-fast"], scope].concat();
    let mut child = command(&arguments)
        .stdout(Stdio::piped())
        .spawn()
        .with_context(|| say(&arguments))?;
    let output = child.stdout.take().context("the tests have no output")?;
    let echoed = echo(BufReader::new(output), &mut read);
    let status = child.wait().with_context(|| say(&arguments))?;
    echoed?;
    ensure!(status.success(), "{}: {status}", say(&arguments));
    Ok(())
}

fn echo(mut output: impl BufRead, read: &mut impl FnMut(&str)) -> Result<()> {
    let mut line = Vec::new();
    while output.read_until(b'\n', &mut line)? > 0 {
        std::io::stdout().write_all(&line)?;
        read(&String::from_utf8_lossy(&line));
        line.clear();
    }
    Ok(())
}

fn command(arguments: &[&str]) -> Command {
    // Under `cargo xtask` this is the cargo that runs it.
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
    let mut command = Command::new(cargo);
    command.args(arguments).current_dir(workspace_root());
    command
}

fn say(arguments: &[&str]) -> String {
    format!("cargo {}", arguments.join(" "))
}
