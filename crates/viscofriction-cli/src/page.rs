//! A page in HTML that needs no other file and no network.

use std::fmt::{Display, Write as _};

use comfy_table::{Row, Table};
use viscofriction_plot::{Figure, draw};

const STYLE: &str = include_str!("page.css");

/// A page that is being written.
#[derive(Debug)]
pub(crate) struct Page {
    title: String,
    body: String,
}

impl Page {
    pub(crate) fn new(title: &str) -> Self {
        Self {
            title: escaped(title),
            body: String::new(),
        }
    }

    fn tagged(&mut self, tag: &str, text: &dyn Display) {
        let text = escaped(&text.to_string());
        writeln!(self.body, "<{tag}>{text}</{tag}>").ok();
    }

    pub(crate) fn heading(&mut self, text: &str) {
        self.tagged("h2", &text);
    }

    pub(crate) fn paragraph(&mut self, text: &str) {
        self.tagged("p", &text);
    }

    pub(crate) fn list(&mut self, items: impl IntoIterator<Item = impl Display>) {
        self.body += "<ul>\n";
        for item in items {
            self.tagged("li", &item);
        }
        self.body += "</ul>\n";
    }

    /// Text that opens when its summary is clicked.
    pub(crate) fn hidden(&mut self, summary: &str, text: &str) {
        let [summary, text] = [summary, text].map(escaped);
        let summary = format!("<summary>{summary}</summary>");
        writeln!(self.body, "<details>{summary}<pre>{text}</pre></details>").ok();
    }

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

    pub(crate) fn picture(&mut self, figure: &Figure, caption: &str) -> anyhow::Result<()> {
        let svg = draw(figure)?.svg;
        // What stands before the element is for files of their own.
        let svg = svg.find("<svg").map_or("", |start| &svg[start..]);
        let caption = escaped(caption);
        writeln!(
            self.body,
            "<figure>{svg}<figcaption>{caption}</figcaption></figure>"
        )?;
        Ok(())
    }

    /// The page, with the command that makes it again at its end.
    pub(crate) fn finish(mut self) -> String {
        self.heading("The same again");
        self.tagged("pre", &typed());
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

/// The words that were typed; what a shell would take for more than a word is quoted.
fn typed() -> String {
    let is_plain = |sign: char| sign.is_alphanumeric() || "-_./=,:+".contains(sign);
    let quoted = |word: String| {
        if !word.is_empty() && word.chars().all(is_plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    };
    let words = std::env::args_os().skip(1);
    let words = words.map(|word| quoted(word.to_string_lossy().into_owned()));
    format!("viscofriction {}", words.collect::<Vec<_>>().join(" "))
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}
