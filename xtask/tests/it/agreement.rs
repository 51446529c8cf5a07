//! Answers of random scenes of a fixed seed do not contradict each other.

use std::collections::BTreeSet;

use crate::support::Evidence;

/// The command fails where a relation that holds to rounding does not, or bars hold too seldom. The seed has all kinds of scenes, and
/// none that takes long.
#[test]
fn answers_do_not_contradict_each_other() {
    let evidence = Evidence::quick("agreement", "agreement --seed 33");
    let rows = evidence.rows("agreement");
    let column = |name: &str| {
        rows.iter()
            .map(|row| row[name].clone())
            .collect::<BTreeSet<_>>()
    };
    assert!(column("indenter").len() >= 12, "kinds of bodies");
    assert_eq!(column("material").len(), 9, "kinds of materials");
    let relations = column("relation");
    assert!(relations.len() >= 12, "tried were {relations:?}");
    let compared = rows.iter().filter(|row| !row["part"].is_empty()).count();
    assert!(compared >= 25, "{compared} comparisons");
}

/// The last of the first scenes is a map of heights that the reader refuses, which ends no search.
#[test]
fn an_interrupted_search_goes_on() {
    let evidence = Evidence::quick("agreement-again", "agreement --scenes 4 --seed 12");
    let first = evidence.rows("agreement");
    evidence.again("agreement --scenes 5 --seed 12");
    let second = evidence.rows("agreement");
    assert_eq!(second[..first.len()], first, "rows that were there");
    let scenes: BTreeSet<&str> = second.iter().map(|row| &*row["scene"]).collect();
    assert_eq!(scenes.len(), 5, "{scenes:?}");
}
