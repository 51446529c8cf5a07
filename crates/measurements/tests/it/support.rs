//! Comparisons and noise.

use std::fmt::Display;

/// Requires a value that is off by a part of what is expected at most.
#[track_caller]
pub(crate) fn assert_close(what: impl Display, value: f64, expected: f64, part: f64) {
    let off = (value / expected - 1.0).abs();
    let said = format!("{what}: {value} instead of {expected}");
    assert!(off < part, "{said}, off by {off:e}");
}

/// Standard normal numbers by Box and Muller from a generator like splitmix64.
pub(crate) struct Normal(pub(crate) u64);

impl Normal {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn draw(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}
