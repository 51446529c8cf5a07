//! Lengths whose Fourier transform is fast.

/// The smallest even number 2^a 3^b 5^c that is not below `minimum`.
pub(crate) fn fast_length(minimum: usize) -> usize {
    let mut length = minimum.max(2);
    while !length.is_multiple_of(2) || !is_smooth(length) {
        length += 1;
    }
    length
}

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
        for (minimum, expected) in [
            (1, 2),
            (7, 8),
            (11, 12),
            (13, 16),
            (127, 128),
            (1021, 1024),
            (2049, 2160),
        ] {
            assert_eq!(fast_length(minimum), expected, "for at least {minimum}");
        }
    }
}
