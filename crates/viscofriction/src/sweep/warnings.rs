//! Summary of the warnings of many answers.

use std::fmt;

/// A warning that some of many answers share.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SharedWarning {
    /// The sentence of the first answer; others may differ in their numbers.
    pub sentence: String,
    /// Number of answers with this warning.
    pub answers: usize,
    /// Total number of answers.
    pub of: usize,
}

impl fmt::Display for SharedWarning {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            sentence,
            answers,
            of,
        } = self;
        write!(out, "{sentence} (at {answers} of {of} points)")
    }
}

/// Each warning once, in order of first appearance.
pub fn each_once<'a>(answers: impl IntoIterator<Item = Vec<&'a str>>) -> Vec<SharedWarning> {
    let mut found: Vec<(String, SharedWarning)> = Vec::new();
    let mut of = 0;
    for warnings in answers {
        of += 1;
        for sentence in warnings {
            let kind = without_numbers(sentence);
            match found.iter_mut().find(|(known, _)| *known == kind) {
                Some((_, warning)) => warning.answers += 1,
                None => {
                    let sentence = sentence.to_owned();
                    let answers = 1;
                    found.push((
                        kind,
                        SharedWarning {
                            sentence,
                            answers,
                            of,
                        },
                    ));
                }
            }
        }
    }
    let counted = found
        .into_iter()
        .map(|(_, warning)| SharedWarning { of, ..warning });
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
