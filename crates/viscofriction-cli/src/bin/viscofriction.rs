//! The program `viscofriction`.

use std::process::ExitCode;

fn main() -> ExitCode {
    viscofriction_cli::execute()
}
