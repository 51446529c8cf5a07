//! Scene files, up to the choice of the method.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use viscofriction_cli::InputKind;

fuzz_target!(|contents: &[u8]| {
    for file in ["scene.toml"] {
        let checked = fuzz::check(InputKind::Scene, Path::new(file), contents);
        checked.expect("a refusal that says where the file is wrong");
    }
});
