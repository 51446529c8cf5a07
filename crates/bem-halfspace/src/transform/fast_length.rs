//! Lengths with a fast Fourier transform.

/// The smallest even number 2^a 3^b 5^c that is not below `minimum`.
pub(crate) fn fast_length(minimum: usize) -> usize {
    let mut length = minimum.max(2);
    while !length.is_multiple_of(2) || !is_smooth(length) {
        length += 1;
    }
    length
}

/// True if the number has no prime factor above 5.
fn is_smooth(mut number: usize) -> bool {
    for prime in [2, 3, 5] {
        while number.is_multiple_of(prime) {
            number /= prime;
        }
    }
    number == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_even_smooth_and_tight() {
        let lengths = [1, 7, 11, 13, 127, 1021, 2049].map(fast_length);
        assert_eq!(lengths, [2, 8, 12, 16, 128, 1024, 2160]);
    }
}
