//! The warnings of many answers as a few sentences.

use std::fmt;

/// A warning of some of many answers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SharedWarning {
    /// As the first of them has it; others differ in their numbers only.
    pub sentence: String,
    /// Number of answers that have it.
    pub answers: usize,
    /// Number of all answers.
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

/// Every warning once, in the order in which they come first.
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

/// What two sentences have in common that say the same of two answers.
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
