//! Rows of interrupted sweeps.

#![no_main]

use libfuzzer_sys::fuzz_target;
use viscofriction_cli::InputKind;

fuzz_target!(|contents: &[u8]| fuzz::check(InputKind::SweepRows, "sweep.csv", contents));
