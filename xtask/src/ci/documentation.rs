//! `ci`, step `documentation`: pages and examples of the documentation of all crates, from what is compiled already.
//!
//! `cargo doc` checks all dependencies once more, because it takes nothing that cargo has compiled to be run. `cargo test --doc`
//! does, and calls rustdoc for each crate. This program takes the place of rustdoc there, and calls it twice: for the pages, with
//! warnings denied, and for the examples.

use std::env;
use std::ffi::OsString;
use std::path::Path;
use std::process::{Command, ExitCode};

use anyhow::{Context, Result};

use super::cargo::cargo;
use super::workspace::Workspace;

/// Environment variable with the folder for the pages; this program is called as rustdoc if it is set.
const PAGES: &str = "XTASK_RUSTDOC_PAGES";

/// Cargo with `arguments` of `cargo test` that select crates and features.
pub(super) fn command(arguments: &str, workspace: &Workspace) -> Result<Command> {
    let mut command = cargo(&format!("test --doc --no-fail-fast {arguments}"));
    command.env("RUSTDOC", env::current_exe()?);
    command.env(PAGES, workspace.target_directory.join("doc"));
    Ok(command)
}

/// Does what cargo wants from rustdoc, and returns its exit status; `None` if cargo has not called this program as rustdoc.
pub(crate) fn as_rustdoc() -> Option<ExitCode> {
    let pages = env::var_os(PAGES)?;
    let arguments: Vec<OsString> = env::args_os().skip(1).collect();
    match pages_and_examples(&arguments, Path::new(&pages)) {
        Ok(true) => Some(ExitCode::SUCCESS),
        Ok(false) => Some(ExitCode::FAILURE),
        Err(error) => {
            eprintln!("error: {error:#}");
            Some(ExitCode::FAILURE)
        }
    }
}

/// Writes the pages if rustdoc is asked for the examples of a crate, then runs rustdoc as asked. False if either fails.
fn pages_and_examples(arguments: &[OsString], pages: &Path) -> Result<bool> {
    let mut is_right = true;
    if arguments.iter().any(|argument| argument == "--test") {
        let name = after("--crate-name", arguments).context("a crate without a name")?;
        let known = Workspace::read_all()?.dependencies_of_library(name);
        let mut rustdoc = Command::new("rustdoc");
        rustdoc.args(arguments_of_pages(arguments, &known));
        rustdoc.arg("--deny=warnings").arg("--out-dir").arg(pages);
        is_right = rustdoc.status().context("rustdoc")?.success();
    }
    let status = Command::new("rustdoc").args(arguments).status();
    Ok(status.context("rustdoc")?.success() && is_right)
}

/// The argument that follows `name`.
fn after<'a>(name: &str, arguments: &'a [OsString]) -> Option<&'a str> {
    let place = arguments.iter().position(|argument| argument == name)?;
    arguments.get(place + 1)?.to_str()
}

/// The arguments for pages from those for examples. Pages know the crates `known` only, since they must not link to
/// dependencies of the tests, which are not documented where the crate is published.
fn arguments_of_pages<'a>(arguments: &'a [OsString], known: &[String]) -> Vec<&'a OsString> {
    let mut kept = Vec::new();
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.to_str() {
            Some("--test") => {}
            Some("--test-run-directory") => {
                rest.next();
            }
            Some("--extern") => {
                let value = rest.next();
                let text = value.and_then(|value| value.to_str()).unwrap_or_default();
                let name = text.split('=').next().unwrap_or_default();
                let name = name.rsplit(':').next().unwrap_or_default();
                if known.iter().any(|known| known == name) {
                    kept.push(argument);
                    kept.extend(value);
                }
            }
            _ => kept.push(argument),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use std::ffi::OsString;

    use super::{after, arguments_of_pages};

    #[test]
    fn pages_are_made_without_examples_and_without_dependencies_of_tests() {
        let line = "--crate-name a --test src/lib.rs --test-run-directory crates/a --extern b_c=b.rlib --extern a=a.rlib \
                    --extern priv:d=d.rlib -C x=y";
        let arguments: Vec<OsString> = line.split_whitespace().map(OsString::from).collect();
        assert_eq!(after("--crate-name", &arguments), Some("a"), "{line}");
        let known = ["b_c", "d"].map(str::to_owned);
        let found: Vec<String> = arguments_of_pages(&arguments, &known)
            .iter()
            .map(|argument| argument.to_string_lossy().into_owned())
            .collect();
        let expected =
            "--crate-name a src/lib.rs --extern b_c=b.rlib --extern priv:d=d.rlib -C x=y";
        assert_eq!(found.join(" "), expected, "{line}");
    }
}
