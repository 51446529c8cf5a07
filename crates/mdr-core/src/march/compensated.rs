//! Compensated summation: a sum whose rounding error does not grow with the number of terms.
//!
//! Knuth's exact sum of two numbers, and the sum of the remainders (Ogita, Rump & Oishi 2005, SIAM J. Sci. Comput. 26, 1955).

/// Running sum, and the sum of its rounding errors.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct CompensatedSum {
    /// Rounded sum.
    sum: f64,
    /// Sum of the rounding errors.
    remainder: f64,
}

impl CompensatedSum {
    /// Adds a term, and its rounding error to the remainder.
    pub(crate) fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        let added = sum - self.sum;
        self.remainder += (self.sum - (sum - added)) + (term - added);
        self.sum = sum;
    }

    /// The sum, corrected by the rounding errors.
    pub(crate) fn value(self) -> f64 {
        self.sum + self.remainder
    }
}
