//! Pages of the documentation that state what an experiment found.

use std::fs;
use std::path::Path;

const COMMIT: &str = "measured at commit `";
const DIGITS: usize = 8;

/// Numbers of a page are those of one state of the program, which may have changed since.
#[test]
fn a_page_with_numbers_of_an_experiment_names_the_commit() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let mut named = 0;
    for entry in fs::read_dir(docs).expect("the documentation") {
        let path = entry.expect("a file").path();
        let text = fs::read_to_string(&path).unwrap_or_default();
        let command = |line: &str| {
            line.trim_start_matches('`')
                .starts_with("cargo xtask evidence")
        };
        if path.extension().is_none_or(|end| end != "md") || !text.lines().any(command) {
            continue;
        }
        let commit = text
            .split(COMMIT)
            .nth(1)
            .and_then(|rest| rest.split('`').next());
        let is_hash = |commit: &str| {
            commit.len() == DIGITS && commit.bytes().all(|digit| digit.is_ascii_hexdigit())
        };
        let page = path.display();
        assert!(
            commit.is_some_and(is_hash),
            "{page}: {commit:?} after {COMMIT}"
        );
        named += 1;
    }
    assert!(named > 5, "{named} pages");
}
