//! Relative links of all pages lead to files and headings that are there.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::repository;

/// Markdown files below a folder, without what is built or hidden.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && !name.starts_with('.') && name != "target" {
            found.extend(pages(&path));
        } else if path.extension().is_some_and(|extension| extension == "md") {
            found.push(path);
        }
    }
    found
}

/// The lines of a page that are no code, with their numbers from 1.
fn prose(page: &str) -> Vec<(usize, String)> {
    let mut is_code = false;
    let mut lines = Vec::new();
    for (index, line) in page.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        } else if !is_code {
            lines.push((index + 1, line.to_owned()));
        }
    }
    lines
}

/// A line without the code between backticks.
fn without_code(line: &str) -> String {
    let parts = line.split('`').enumerate();
    let parts = parts.map(|(place, part)| if place % 2 == 0 { part } else { "" });
    parts.collect()
}

/// Where the links and pictures of a line lead.
fn targets(line: &str) -> Vec<String> {
    let line = without_code(line);
    let inline = line.split("](").skip(1).filter_map(|rest| {
        let end = rest.find(')')?;
        Some(rest[..end].split_whitespace().next()?.to_owned())
    });
    let mut all: Vec<String> = inline.collect();
    if let Some((_, rest)) = line.split_once("]: ")
        && line.starts_with('[')
    {
        all.extend(rest.split_whitespace().next().map(str::to_owned));
    }
    all.retain(|target| !target.contains("://") && !target.starts_with("mailto:"));
    all
}

/// The anchors of a page, as GitHub makes them of its headings.
fn anchors(page: &str) -> Vec<String> {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let mut anchors = Vec::new();
    for (_, line) in prose(page) {
        let Some(heading) = line.strip_prefix('#') else {
            continue;
        };
        let heading = heading.trim_start_matches('#').trim().to_lowercase();
        // Of a link its text.
        let heading = heading
            .split("](")
            .map(|part| part.split_once(')').map_or(part, |(_, rest)| rest));
        let heading: String = heading.collect();
        let is_kept = |letter: &char| letter.is_alphanumeric() || " -_".contains(*letter);
        let slug: String = heading.chars().filter(is_kept).collect();
        let slug = slug.replace(' ', "-");
        let count = counts.entry(slug.clone()).or_default();
        anchors.push(match *count {
            0 => slug,
            n => format!("{slug}-{n}"),
        });
        *count += 1;
    }
    anchors
}

/// What is wrong with a link of a page.
fn problem(page: &Path, target: &str) -> Option<String> {
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let path = match file {
        "" => page.to_owned(),
        file => page.parent()?.join(file),
    };
    if !path.exists() {
        return Some("no such file".to_owned());
    }
    if anchor.is_empty() {
        return None;
    }
    let known = anchors(&fs::read_to_string(&path).ok()?);
    let is_there = known.iter().any(|known| known == anchor);
    (!is_there).then(|| format!("no such heading; there are {}", known.join(", ")))
}

#[test]
fn links_of_all_pages_lead_somewhere() {
    let repository = repository();
    let pages = pages(&repository);
    let mut n_links = 0;
    let mut wrong = Vec::new();
    for page in &pages {
        let text = fs::read_to_string(page).expect("a page");
        for (number, line) in prose(&text) {
            for target in targets(&line) {
                n_links += 1;
                if let Some(problem) = problem(page, &target) {
                    wrong.push(format!("{}:{number}: {target}: {problem}", page.display()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(
        pages.len() > 40 && n_links > 300,
        "only {n_links} links on {} pages were found",
        pages.len()
    );
}

#[test]
fn the_book_has_every_page_of_the_docs() {
    let docs = repository().join("docs");
    let summary = fs::read_to_string(docs.join("SUMMARY.md")).expect("the contents");
    let named: Vec<PathBuf> = summary
        .lines()
        .flat_map(targets)
        .map(|target| docs.join(target))
        .collect();
    let mut missing = pages(&docs);
    missing.retain(|page| !named.contains(page) && !page.ends_with("SUMMARY.md"));
    assert!(
        missing.is_empty(),
        "docs/SUMMARY.md does not name {missing:?}: links to them would be dead in the book"
    );
}

#[test]
fn what_leads_nowhere_is_found() {
    let page = repository().join("docs/scenes.md");
    for (target, expected) in [
        ("methods.md", None),
        ("#one-scene", None),
        ("methods.md#two-models", None),
        ("no-such-page.md", Some("no such file")),
        ("methods.md#no-such-heading", Some("no such heading")),
    ] {
        let found = problem(&page, target);
        let holds = match (&found, expected) {
            (Some(found), Some(expected)) => found.starts_with(expected),
            (found, expected) => found.is_none() && expected.is_none(),
        };
        assert!(holds, "{target}: {found:?} instead of {expected:?}");
    }
    let line = "see [a page](a.md#x), `[no](link.md)` and ![a picture](b.svg \"title\") or [out](https://c.org)";
    assert_eq!(targets(line), ["a.md#x", "b.svg"], "of a line");
}
