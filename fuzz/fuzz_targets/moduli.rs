//! Tables of measured moduli.

#![no_main]

use libfuzzer_sys::fuzz_target;
use viscofriction_cli::InputKind;

fuzz_target!(|contents: &[u8]| fuzz::check(InputKind::Moduli, "moduli.csv", contents));
