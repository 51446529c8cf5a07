//! Scene files, up to the choice of the method.

#![no_main]

use libfuzzer_sys::fuzz_target;
use viscofriction_cli::InputKind;

fuzz_target!(|contents: &[u8]| fuzz::check(InputKind::Scene, "scene.toml", contents));
