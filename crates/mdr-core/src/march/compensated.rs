//! Compensated summation: a sum whose rounding error does not grow with the number of terms.
//!
//! Knuth's exact sum of two numbers, and the sum of the remainders (Ogita, Rump & Oishi 2005, SIAM J. Sci. Comput. 26, 1955).

/// Running sum, and the sum of its rounding errors.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct CompensatedSum {
    sum: f64,
    remainder: f64,
}

impl CompensatedSum {
    pub(crate) fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        let added = sum - self.sum;
        self.remainder += (self.sum - (sum - added)) + (term - added);
        self.sum = sum;
    }

    pub(crate) fn value(self) -> f64 {
        self.sum + self.remainder
    }
}
