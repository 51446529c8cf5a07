//! `release`, step `book`: the pages of `docs` as HTML, with formulas in MathML and links that lead somewhere.
//!
//! The pages write formulas as `$…$` and `$$…$$`, which GitHub shows and mdBook does not: its backslashes and underscores
//! would be read as Markdown. A copy of the pages has the formulas as MathML, which browsers draw without a script.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{ParserError, Storage, push_mathml};

use super::cargo::{run, workspace_root};

/// Address of the sources of this version: links of the pages to files outside `docs`, which the book does not have, lead
/// there.
const REPOSITORY: &str = concat!(
    env!("CARGO_PKG_REPOSITORY"),
    "/blob/v",
    env!("CARGO_PKG_VERSION")
);

/// Extensions of CommonMark that the parser has to know, because the pages use them.
const SYNTAX: Options = Options::ENABLE_TABLES.union(Options::ENABLE_MATH);

/// Converts `docs` into pages for mdBook in the folder `copy`, builds the book from them in the folder `book`, and checks the
/// links of all its pages. Fails where mdbook does, where a formula cannot be read, and where a link is dead.
pub(super) fn build(copy: &Path, book: &Path) -> Result<()> {
    let docs = docs();
    for file in files(&docs)? {
        let place = file.strip_prefix(&docs)?;
        let copied = copy.join(place);
        fs::create_dir_all(copied.parent().unwrap_or(copy))?;
        if has_extension(&file, "md") {
            let page = for_mdbook(&fs::read_to_string(&file)?, place);
            fs::write(copied, page.with_context(|| file.display().to_string())?)?;
        } else {
            fs::copy(&file, copied)?;
        }
    }
    let mut mdbook = Command::new("mdbook");
    run(mdbook.arg("build").arg(copy).arg("--dest-dir").arg(book))?;
    let dead = dead_links(book)?;
    ensure!(
        dead.is_empty(),
        "links of the book that lead nowhere:\n{}",
        dead.join("\n")
    );
    Ok(())
}

/// Folder with the pages of the documentation.
fn docs() -> PathBuf {
    workspace_root().join("docs")
}

/// All files in a folder and in those below it.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            files.extend(self::files(&path)?);
        } else {
            files.push(path);
        }
    }
    Ok(files)
}

/// Whether the name of a file ends with `.` and `extension`.
fn has_extension(file: &Path, extension: &str) -> bool {
    file.extension().is_some_and(|own| own == extension)
}

/// The text `page` of a file in Markdown with MathML for formulas and addresses in [`REPOSITORY`] for links that leave `docs`.
/// `place` is the path of the file below `docs`; it decides how many `../` lead out of there. Code stays as it is.
fn for_mdbook(page: &str, place: &Path) -> Result<String> {
    let to_root = "../".repeat(place.components().count());
    // Collect the edits first, since the parser borrows the page and its ranges are those of the original.
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    let mut is_code = false;
    for (event, range) in Parser::new_ext(page, SYNTAX).into_offset_iter() {
        match event {
            Event::InlineMath(formula) => {
                edits.push((range, mathml(&formula, DisplayMode::Inline)?));
            }
            Event::DisplayMath(formula) => {
                edits.push((range, mathml(&formula, DisplayMode::Block)?));
            }
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                if let Some(file) = dest_url.strip_prefix(&to_root) {
                    let start = page[range.clone()].rfind(&*dest_url);
                    let start = range.start + start.context("a link by reference")?;
                    let address = format!("{REPOSITORY}/{file}");
                    edits.push((start..start + dest_url.len(), address));
                }
            }
            Event::Start(Tag::CodeBlock(_)) => is_code = true,
            Event::End(TagEnd::CodeBlock) => is_code = false,
            // Refuse a `$` that is left in the text: the parser of Markdown takes a formula with unbalanced braces, for example,
            // for text.
            Event::Text(text) if !is_code => {
                ensure!(
                    !text.contains('$'),
                    "no formula begins or ends at `$` in {text:?}"
                );
            }
            _ => {}
        }
    }
    // Apply the edits from the end of the page, so that earlier ranges stay valid. They are sorted first, because the address of
    // a link comes after the formulas of its text.
    edits.sort_by_key(|(range, _)| range.start);
    let mut converted = page.to_owned();
    for (range, text) in edits.iter().rev() {
        converted.replace_range(range.clone(), text);
    }
    Ok(converted)
}

/// A formula in LaTeX as MathML, with every character that Markdown would interpret written as a numeric entity.
fn mathml(formula: &str, display_mode: DisplayMode) -> Result<String> {
    let storage = Storage::new();
    // Refuse a formula that the parser cannot read, because the writer would draw the error in red.
    let events = pulldown_latex::Parser::new(formula, &storage)
        .collect::<Result<Vec<_>, ParserError>>()
        .with_context(|| format!("the formula ${formula}$"))?;
    let config = RenderConfig {
        display_mode,
        ..RenderConfig::default()
    };
    let mut mathml = String::new();
    push_mathml(
        &mut mathml,
        events.into_iter().map(Ok::<_, ParserError>),
        config,
    )?;
    // Repair what pulldown-latex 0.8 writes for `\Big(` and `<`, which is neither XML nor a tag of Markdown.
    let repaired = mathml
        .replace("\"minsize=", "\" minsize=")
        .replace("<mo><</mo>", "<mo>&lt;</mo>");
    let mut escaped = String::new();
    for letter in repaired.chars() {
        match letter {
            '$' | '*' | '[' | '\\' | ']' | '_' | '`' | '|' | '~' => {
                escaped += &format!("&#{};", u32::from(letter));
            }
            _ => escaped.push(letter),
        }
    }
    Ok(escaped)
}

/// Relative links in the HTML files below a folder whose file or anchor does not exist, each as `page: target`.
fn dead_links(folder: &Path) -> Result<Vec<String>> {
    let mut dead = Vec::new();
    for page in files(folder)? {
        // Skip the page for unknown addresses, because its links begin at the root of its server.
        if !has_extension(&page, "html") || page.ends_with("404.html") {
            continue;
        }
        let text = fs::read_to_string(&page)?;
        for target in targets(&text) {
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let file = match file {
                "" => page.clone(),
                file => page.with_file_name("").join(file),
            };
            let is_there = match anchor {
                "" => file.exists(),
                anchor => fs::read_to_string(&file)
                    .is_ok_and(|text| text.contains(&format!("id=\"{anchor}\""))),
            };
            if !is_there {
                dead.push(format!("{}: {target}", page.display()));
            }
        }
    }
    Ok(dead)
}

/// Values of all `href` and `src` of a page in HTML that have no scheme, so that they lead into the same book.
fn targets(html: &str) -> impl Iterator<Item = &str> {
    let attributes = [" href=\"", " src=\""].into_iter();
    let values = attributes.flat_map(|attribute| html.split(attribute).skip(1));
    let targets = values.filter_map(|rest| rest.split('"').next());
    targets.filter(|target| !target.contains(':'))
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use pulldown_cmark::{Event, Parser, TagEnd};

    use super::{REPOSITORY, SYNTAX, dead_links, docs, files, for_mdbook, has_extension};

    /// The structure of a page: where its headings, paragraphs, cells and so on end; and the number of its formulas.
    fn structure(page: &str) -> (Vec<TagEnd>, usize) {
        let mut ends = Vec::new();
        let mut n_formulas = 0;
        for event in Parser::new_ext(page, SYNTAX) {
            match event {
                Event::End(end) => ends.push(end),
                Event::InlineMath(_) | Event::DisplayMath(_) => n_formulas += 1,
                _ => {}
            }
        }
        (ends, n_formulas)
    }

    #[test]
    fn every_formula_of_the_pages_becomes_mathml() {
        let docs = docs();
        let mut n_formulas = 0;
        for file in files(&docs).expect("the pages") {
            if !has_extension(&file, "md") {
                continue;
            }
            let page = fs::read_to_string(&file).expect("a page");
            let place = file.strip_prefix(&docs).expect("a file in the folder");
            let converted = for_mdbook(&page, place)
                .unwrap_or_else(|error| panic!("{}: {error:#}", place.display()));
            let (ends, n_own) = structure(&page);
            assert_eq!(
                structure(&converted),
                (ends, 0),
                "{}: MathML changes the Markdown around it",
                place.display()
            );
            for formula in converted.split("<math").skip(1) {
                let formula = formula.split("</math>").next().unwrap_or_default();
                let formula = format!("<math{}</math>", formula.replace("&nbsp;", " "));
                if let Err(error) = roxmltree::Document::parse(&formula) {
                    panic!("{}: {formula}: {error}", place.display());
                }
            }
            assert_eq!(
                converted.matches("<math").count(),
                n_own,
                "{}",
                place.display()
            );
            n_formulas += n_own;
        }
        assert!(n_formulas > 800, "only {n_formulas} formulas were found");
    }

    #[test]
    fn formulas_and_links_that_leave_the_docs_are_converted() {
        let page = "`$HOME` [$a_1$ *b*](../../README.md), [own](../scenes.md#x) $|x| < \\big(y$\n";
        let converted = for_mdbook(page, Path::new("theory/page.md")).expect("a page");
        for part in [
            "`$HOME` [<math",
            "</math> *b*](",
            &format!("]({REPOSITORY}/README.md), "),
            "[own](../scenes.md#x)",
            "<mi>&#124;</mi><mi>x</mi><mi>&#124;</mi><mo>&lt;</mo>",
        ] {
            assert!(converted.contains(part), "no {part} in {converted}");
        }
        for (page, expected) in [
            ("wrong: $\\nocommand$", "the formula $\\nocommand$"),
            ("wrong: $\\frac{1$", "no formula begins or ends"),
        ] {
            let error = for_mdbook(page, Path::new("page.md")).expect_err(page);
            assert!(format!("{error:#}").contains(expected), "{error:#}");
        }
    }

    #[test]
    fn dead_links_of_a_book_are_found() {
        let book = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| {
            fs::write(book.path().join(name), text).expect("a file");
        };
        write("b.html", "<h1 id=\"there\">B</h1>");
        write(
            "a.html",
            "<a href=\"b.html#there\"> <a href=\"#nowhere\"> <img src=\"b.svg\"> <a href=\"https://c.org/d\"> \
             <a class=\"x\" href=\"b.html#elsewhere\"> <a href=\"b.html\">",
        );
        let mut dead = dead_links(book.path()).expect("a book");
        for link in &mut dead {
            *link = link.rsplit(' ').next().unwrap_or_default().to_owned();
        }
        assert_eq!(
            dead,
            ["#nowhere", "b.html#elsewhere", "b.svg"],
            "dead links"
        );
    }
}
