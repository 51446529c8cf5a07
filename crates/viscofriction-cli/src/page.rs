//! Self-contained HTML pages, without other files and network access.

use std::fmt::{Display, Write as _};

use comfy_table::{Row, Table};
use viscofriction_plot::{Figure, draw};

/// Style sheet of the page.
const STYLE: &str = include_str!("page.css");

/// A page under construction.
#[derive(Debug)]
pub(crate) struct Page {
    /// Title, with HTML characters escaped.
    title: String,
    /// HTML of the elements so far.
    body: String,
}

impl Page {
    /// An empty page with a title.
    pub(crate) fn new(title: &str) -> Self {
        Self {
            title: escaped(title),
            body: String::new(),
        }
    }

    /// Appends an HTML element `tag` whose content is an escaped text.
    fn tagged(&mut self, tag: &str, text: &dyn Display) {
        let text = escaped(&text.to_string());
        writeln!(self.body, "<{tag}>{text}</{tag}>").ok();
    }

    /// Appends a heading.
    pub(crate) fn heading(&mut self, text: &str) {
        self.tagged("h2", &text);
    }

    /// Appends a paragraph.
    pub(crate) fn paragraph(&mut self, text: &str) {
        self.tagged("p", &text);
    }

    /// Appends a list.
    pub(crate) fn list(&mut self, items: impl IntoIterator<Item = impl Display>) {
        self.body += "<ul>\n";
        for item in items {
            self.tagged("li", &item);
        }
        self.body += "</ul>\n";
    }

    /// Appends collapsed text that opens by its summary.
    pub(crate) fn hidden(&mut self, summary: &str, text: &str) {
        let [summary, text] = [summary, text].map(escaped);
        let summary = format!("<summary>{summary}</summary>");
        writeln!(self.body, "<details>{summary}<pre>{text}</pre></details>").ok();
    }

    /// Appends a table.
    pub(crate) fn table(&mut self, table: &Table) {
        let row = |row: &Row, tag: &str| {
            let cells = row.cell_iter().map(|cell| {
                let content = escaped(&cell.content());
                format!("<{tag}>{content}</{tag}>")
            });
            format!("<tr>{}</tr>\n", cells.collect::<String>())
        };
        self.body += "<div class=\"wide\"><table>\n";
        if let Some(header) = table.header() {
            self.body += &row(header, "th");
        }
        self.body
            .extend(table.row_iter().map(|cells| row(cells, "td")));
        self.body += "</table></div>\n";
    }

    /// Appends a picture as inline SVG.
    pub(crate) fn picture(&mut self, figure: &Figure, caption: &str) -> anyhow::Result<()> {
        let file = draw(figure)?.svg;
        // Inline SVG starts at its element, without the XML declaration.
        let svg = file.find("<svg").map_or("", |start| &file[start..]);
        let caption = escaped(caption);
        writeln!(
            self.body,
            "<figure>{svg}<figcaption>{caption}</figcaption></figure>"
        )?;
        Ok(())
    }

    /// Completes the page, with the command that reproduces it.
    pub(crate) fn finish(mut self) -> String {
        self.heading("The same again");
        self.tagged("pre", &command_line_text());
        self.paragraph(&format!(
            "viscofriction {}; the numbers are the same to the last bit with any number of threads.",
            env!("CARGO_PKG_VERSION")
        ));
        let Self { title, body } = self;
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width\"/>\n<title>{title}</title>\n\
             <style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n{body}</body>\n</html>\n"
        )
    }
}

/// The command line of this run, with words quoted for a shell where necessary.
fn command_line_text() -> String {
    let is_plain = |sign: char| sign.is_alphanumeric() || "-_./=,:+".contains(sign);
    let quoted = |word: String| {
        if !word.is_empty() && word.chars().all(is_plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    };
    let words: Vec<String> = std::env::args_os()
        .skip(1)
        .map(|word| quoted(word.to_string_lossy().into_owned()))
        .collect();
    format!("viscofriction {}", words.join(" "))
}

/// Text with escaped HTML characters.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
