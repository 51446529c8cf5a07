//! Grids of heights.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use viscofriction_cli::InputKind;

fuzz_target!(|contents: &[u8]| {
    for file in ["map.csv", "map.npy", "map.gsf", "map.sur", "map.x3p", "map.asc", "map.xyz"] {
        let checked = fuzz::check(InputKind::HeightMap, Path::new(file), contents);
        checked.expect("a refusal that says where the file is wrong");
    }
});
