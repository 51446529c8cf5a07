//! Grids of heights.

#![no_main]

use libfuzzer_sys::fuzz_target;
use viscofriction_cli::InputKind;

fuzz_target!(|contents: &[u8]| {
    for file in ["map.csv", "map.npy"] {
        fuzz::check(InputKind::HeightMap, file, contents);
    }
});
