//! Summary of the warnings of many answers.

use std::fmt;

/// A warning that some of many answers share.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SharedWarning<W> {
    /// The warning of the first answer.
    pub warning: W,
    /// Whether those of others differ from it in their numbers.
    pub numbers_differ: bool,
    /// Number of answers with this warning.
    pub answers: usize,
    /// Total number of answers.
    pub of: usize,
}

impl<W: fmt::Display> fmt::Display for SharedWarning<W> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            warning,
            numbers_differ,
            answers,
            of,
        } = self;
        let numbers = if *numbers_differ {
            ", with the numbers of the first"
        } else {
            ""
        };
        write!(out, "{warning} (at {answers} of {of} points{numbers})")
    }
}

/// Each warning once, in order of first appearance; warnings are the same if their sentences differ only in their numbers.
pub fn each_once<W: fmt::Display>(
    answers: impl IntoIterator<Item = Vec<W>>,
) -> Vec<SharedWarning<W>> {
    let mut found: Vec<(String, SharedWarning<W>)> = Vec::new();
    let mut of = 0;
    for warnings in answers {
        of += 1;
        for warning in warnings {
            let sentence = warning.to_string();
            let kind = without_numbers(&sentence);
            match found.iter_mut().find(|(known, _)| *known == kind) {
                Some((_, shared)) => {
                    shared.answers += 1;
                    shared.numbers_differ |= shared.warning.to_string() != sentence;
                }
                None => {
                    let answers = 1;
                    let shared = SharedWarning {
                        warning,
                        numbers_differ: false,
                        answers,
                        of,
                    };
                    found.push((kind, shared));
                }
            }
        }
    }
    let counted = found
        .into_iter()
        .map(|(_, shared)| SharedWarning { of, ..shared });
    counted.collect()
}

/// A sentence with `#` in place of each number, so that equal warnings of different answers compare equal.
fn without_numbers(sentence: &str) -> String {
    let words = sentence.split(' ').map(|word| {
        let bare = word.trim_matches(|mark: char| ",.;:%()".contains(mark));
        if bare.parse::<f64>().is_ok() {
            "#"
        } else {
            word
        }
    });
    words.collect::<Vec<_>>().join(" ")
}
