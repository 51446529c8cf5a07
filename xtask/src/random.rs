//! Numbers that look random and are the same every time.

use std::f64::consts::TAU;

/// SplitMix64, a pseudorandom generator with a state of 64 bits (Steele, Lea & Flood, "Fast splittable pseudorandom number
/// generators", 2014). Written here so that the cases of the evidence do not change with the version of a crate.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Random {
    state: u64,
}

impl Random {
    /// The generator whose numbers follow from `seed`.
    pub(crate) const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// A number that is uniformly distributed in [0, 1), a multiple of 2⁻⁵³.
    pub(crate) fn uniform(&mut self) -> f64 {
        // The state runs through all 2⁶⁴ values in steps of 2⁶⁴ over the golden ratio, which is odd. Two multiplications with
        // shifts then spread each bit of it over all bits of the result.
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.state;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number that is uniformly distributed in [low, high).
    pub(crate) fn between(&mut self, [low, high]: [f64; 2]) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// 10^x with x uniformly distributed between −n and n.
    pub(crate) fn decades(&mut self, n: f64) -> f64 {
        10_f64.powf(self.between([-n, n]))
    }

    /// A number from the normal distribution of mean 0 and variance 1 (Box & Muller 1958); it consumes two uniform ones.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (TAU * self.uniform()).cos()
    }

    /// One of the items, each as likely as any other.
    pub(crate) fn choice<T: Copy>(&mut self, items: &[T]) -> T {
        // Count the items that the product passes instead of truncating it, because rounding could make it the number of items.
        let mark = self.uniform() * items.len() as f64;
        let passed = |index: &usize| *index as f64 <= mark;
        items[(1..items.len()).take_while(passed).count()]
    }
}
