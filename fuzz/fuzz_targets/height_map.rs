//! Grids of heights.

#![no_main]

use libfuzzer_sys::fuzz_target;
use xtask::InputKind;

fuzz_target!(|contents: &[u8]| fuzz::check(InputKind::HeightMap, "map.csv", contents));
