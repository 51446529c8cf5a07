//! Tables of measured moduli.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use viscofriction_cli::InputKind;

fuzz_target!(|contents: &[u8]| {
    for file in ["moduli.csv"] {
        let checked = fuzz::check(InputKind::Moduli, Path::new(file), contents);
        checked.expect("a refusal that says where the file is wrong");
    }
});
