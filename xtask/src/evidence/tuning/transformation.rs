//! Source texts in which constants become functions, so that one program can be given many values of each.
//!
//! ```text
//! const RATIO: f64 = 2.0;   →   fn RATIO() -> f64 { if chosen == 1 { return 0.5; } 2.0 }
//! x < RATIO                 →   x < RATIO()
//! ```
//!
//! An environment variable of the program chooses. Constants that are computed from such a constant become functions, too, and
//! functions that use one lose their `const`.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};

use super::cases::Case;

/// Source files by their path from the root of the checkout.
pub(super) type Sources = BTreeMap<PathBuf, Source>;

/// A source text.
pub(super) struct Source {
    /// The text as it is.
    text: String,
    /// The text with blanks in place of comments, literals in quotes, imports and tests; as many bytes.
    code: String,
    /// Declarations of constants, in their order.
    declarations: Vec<Declaration>,
}

/// Where a text declares a constant, in bytes.
struct Declaration {
    name: String,
    /// From `const` to the semicolon.
    all: Range<usize>,
    /// Type of the constant.
    kind: Range<usize>,
    /// Between the equals sign and the semicolon.
    initialiser: Range<usize>,
}

/// A constant that becomes a function.
struct Constant<'a> {
    /// The file that declares it.
    file: &'a Path,
    declaration: &'a Declaration,
    /// Folder of the files that may use the constant.
    scope: PathBuf,
    /// The case with other values; `None` if the constant is computed from another one.
    case: Option<&'a Case>,
}

/// The environment variable that chooses a value of a constant: 1 for the first that is tried, and so on.
pub(super) fn variable(case: &Case) -> String {
    format!("{}:{}", case.source.display(), case.constant)
}

/// The new texts of the files that change when the constants of the cases become functions.
pub(super) fn transform(cases: &[Case], sources: &Sources) -> Result<BTreeMap<PathBuf, String>> {
    let declared = cases.iter().map(|case| Constant::of_case(case, sources));
    let mut constants = declared.collect::<Result<Vec<_>>>()?;
    // Add constants that are computed from those found, until there are no more.
    let mut n_known = 0;
    while n_known < constants.len() {
        n_known = constants.len();
        for (file, source) in sources {
            for declaration in &source.declarations {
                let mut known = constants.iter();
                let is_known = known.any(|other| std::ptr::eq(other.declaration, declaration));
                if !is_known
                    && !source
                        .uses(file, &constants, &declaration.initialiser)
                        .is_empty()
                {
                    constants.push(Constant::new(file, source, declaration, None));
                }
            }
        }
    }
    let mut texts = BTreeMap::new();
    for (file, source) in sources {
        let uses = source.uses(file, &constants, &(0..source.code.len()));
        let constant_functions = uses.iter().filter_map(|end| {
            let name = source.code[..*end].rfind("fn ")?;
            let is_constant = source.code[..name].ends_with("const ");
            is_constant.then(|| (name - "const ".len()..name, String::new()))
        });
        let mut edits: Vec<_> = constant_functions.collect();
        edits.extend(uses.iter().map(|end| (*end..*end, "()".to_owned())));
        let declared = constants.iter().filter(|constant| constant.file == file);
        edits.extend(declared.flat_map(|constant| constant.function(source)));
        if !edits.is_empty() {
            // Replace from the end, so that earlier places stay where they are.
            edits.sort_by_key(|(place, _)| Reverse(place.end));
            // Remove equal edits, because several uses may be in one function.
            edits.dedup();
            let mut text = source.text.clone();
            for (place, replacement) in edits {
                text.replace_range(place, &replacement);
            }
            texts.insert(file.clone(), text);
        }
    }
    Ok(texts)
}

impl<'a> Constant<'a> {
    /// The constant with its scope: the crates if it is public, otherwise the folder of its file.
    fn new(
        file: &'a Path,
        source: &Source,
        declaration: &'a Declaration,
        case: Option<&'a Case>,
    ) -> Self {
        let before = line_before(&source.code[..declaration.all.start]);
        let is_public = before == "pub" || before == "pub(crate)";
        let folder = file.parent().filter(|_| !is_public);
        let scope = folder.unwrap_or(Path::new("crates"));
        Self {
            file,
            declaration,
            scope: scope.to_owned(),
            case,
        }
    }

    /// The constant of a case. Fails unless it is declared once and its initialiser is that of `cases.toml`.
    fn of_case(case: &'a Case, sources: &'a Sources) -> Result<Self> {
        let Case {
            constant,
            source,
            present,
            ..
        } = case;
        let mut found = Vec::new();
        for (file, text) in sources.iter().filter(|(file, _)| file.starts_with(source)) {
            let declarations = text.declarations.iter();
            let of_name = declarations.filter(|declaration| declaration.name == *constant);
            found.extend(of_name.map(|declaration| (file, text, declaration)));
        }
        let n = found.len();
        ensure!(
            n == 1,
            "{constant} is declared {n} times in {}",
            source.display()
        );
        let (file, text, declaration) = found[0];
        let value = &text.text[declaration.initialiser.clone()];
        let is_present = value.split_whitespace().eq(present.split_whitespace());
        ensure!(
            is_present,
            "{constant} is {value}, but {present} in cases.toml"
        );
        Ok(Self::new(file, text, declaration, Some(case)))
    }

    /// The edits of `source`, the file that declares it, that make the declaration a function.
    fn function(&self, source: &Source) -> [(Range<usize>, String); 2] {
        let Declaration {
            name,
            all,
            kind,
            initialiser,
        } = self.declaration;
        let kind = &source.text[kind.clone()];
        let mut head = format!("fn {name}() -> {kind} {{ ");
        if let Some(case) = self.case {
            head += &format!(
                "static CHOSEN: std::sync::LazyLock<usize> = std::sync::LazyLock::new(|| \
                 std::env::var({:?}).map_or(0, |chosen| chosen.parse().unwrap_or_default())); ",
                variable(case)
            );
            for tried in case.tried() {
                head += &format!(
                    "if *CHOSEN == {} {{ return {}; }} ",
                    tried.place, tried.value
                );
            }
        }
        [
            (all.start..initialiser.start, head),
            (initialiser.end..all.end, " }".to_owned()),
        ]
    }
}

impl Source {
    /// Finds the declarations of constants in a text.
    pub(super) fn new(text: String) -> Self {
        let code = code(&text);
        let starts = code.match_indices("const ");
        let declarations = starts.filter_map(|(start, _)| Declaration::at(&code, start));
        Self {
            declarations: declarations.collect(),
            text,
            code,
        }
    }

    /// Ends of the names of constants in a part of this file, but for their declarations.
    fn uses(&self, file: &Path, constants: &[Constant], part: &Range<usize>) -> Vec<usize> {
        let mut uses = Vec::new();
        let is_part_of_name = |letter: char| letter.is_alphanumeric() || letter == '_';
        for constant in constants {
            let name = &*constant.declaration.name;
            let is_hidden = self.declarations.iter().any(|other| other.name == name);
            if constant.file != file && (is_hidden || !file.starts_with(&constant.scope)) {
                continue;
            }
            for (start, _) in self.code[part.clone()].match_indices(name) {
                let (before, after) = self.code.split_at(part.start + start);
                let is_whole = !before.ends_with(is_part_of_name)
                    && !after[name.len()..].starts_with(is_part_of_name);
                if is_whole && !before.ends_with("const ") {
                    uses.push(before.len() + name.len());
                }
            }
        }
        uses
    }
}

impl Declaration {
    /// The declaration whose keyword begins at some place, if it is one of a constant with a value.
    fn at(code: &str, start: usize) -> Option<Self> {
        let name = start + "const ".len();
        let kind = name + code[name..].find(": ")? + 2;
        let equals = kind + code[kind..].find(" =")?;
        let end = equals + code[equals..].find(";\n")?;
        let initialiser = end - code[equals + 2..end].trim_start().len();
        let is_name =
            |letter: char| letter.is_ascii_uppercase() || letter.is_ascii_digit() || letter == '_';
        let before = line_before(&code[..start]);
        let is_constant = (before.is_empty() || before.starts_with("pub"))
            && code[name..kind - 2].chars().all(is_name)
            && !code[kind..equals].contains('\n');
        is_constant.then(|| Self {
            name: code[name..kind - 2].to_owned(),
            all: start..end + 1,
            kind: kind..equals,
            initialiser: initialiser..end,
        })
    }
}

/// The last line, without blanks at its ends.
fn line_before(code: &str) -> &str {
    code.rsplit('\n').next().unwrap_or_default().trim()
}

/// The text with blanks in place of comments, literals in quotes, imports and the tests at the end.
fn code(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    while code.len() < text.len() {
        let rest = &text[code.len()..];
        let until = |end: &str, from: usize| {
            let end = rest[from..].find(end).map(|found| from + found + end.len());
            end.unwrap_or(rest.len())
        };
        let line = line_before(&code);
        let is_import = (line.is_empty() || line.starts_with("pub")) && rest.starts_with("use ");
        let hashes = rest
            .bytes()
            .skip(1)
            .take_while(|byte| *byte == b'#')
            .count();
        let is_raw = rest.starts_with('r') && rest[1 + hashes..].starts_with('"');
        let is_letter = rest.starts_with('\'') && rest.chars().nth(2) == Some('\'');
        let hidden = if rest.starts_with("#[cfg(test)]\nmod ") {
            rest.len()
        } else if rest.starts_with("//") {
            until("\n", 0) - 1
        } else if rest.starts_with("/*") {
            until("*/", 2)
        } else if is_import {
            until(";", 0)
        } else if is_raw && !line.ends_with(|letter: char| letter.is_alphanumeric()) {
            until(&format!("\"{}", "#".repeat(hashes)), 2 + hashes)
        } else if rest.starts_with('"') {
            let mut is_escaped = true;
            let is_end = |byte| {
                let is_end = byte == b'"' && !is_escaped;
                is_escaped = byte == b'\\' && !is_escaped;
                is_end
            };
            let end = rest.bytes().position(is_end);
            end.map_or(rest.len(), |end| end + 1)
        } else if rest.starts_with("'\\") {
            until("'", 3)
        } else if is_letter {
            until("'", 1)
        } else {
            0
        };
        if hidden == 0 {
            code.extend(rest.chars().next());
        }
        code.extend(std::iter::repeat_n(' ', hidden));
    }
    code
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(source: &str) -> Case {
        let text = format!(
            "constant = \"RATIO\"\nsource = {source:?}\npresent = \"2.0\"\nsmaller = [\"0.5\"]\nlarger = [\"8.0\"]\nscenes = []"
        );
        toml::from_str(&text).expect("a case")
    }

    fn transformed(texts: &[(&str, &str)]) -> Result<BTreeMap<PathBuf, String>> {
        let sources = texts.iter().map(|(file, text)| {
            let text = Source::new((*text).to_owned());
            (PathBuf::from(file), text)
        });
        transform(&[case("crates/a/src")], &sources.collect())
    }

    #[test]
    fn constants_become_functions_where_they_are_used() {
        let text = r#"
/// [`RATIO`]
pub(crate) const RATIO: f64 = 2.0;
const BOTH: [f64; 2] = [1.0, RATIO];
fn f<'a>(x: f64) -> f64 { println!("RATIO '{x}'"); /* RATIO */ x + RATIO * BOTH[0] + MAX_RATIO } // RATIO
"#;
        let user = "use crate::b::RATIO;\nconst C: char = '\"'; const fn g() -> f64 { b::RATIO * b::RATIO }\n#[cfg(test)]\nmod tests { RATIO }\n";
        let own = "const RATIO: f64 = 3.0;\nfn h() -> f64 { RATIO }";
        let texts = [
            ("crates/a/src/b.rs", text),
            ("crates/a/src/c.rs", user),
            ("crates/d/src/e.rs", own),
        ];
        let changed = transformed(&texts).expect("texts");
        let expected = r#"
/// [`RATIO`]
pub(crate) fn RATIO() -> f64 { CHOICE if *CHOSEN == 1 { return 0.5; } if *CHOSEN == 2 { return 8.0; } 2.0 }
fn BOTH() -> [f64; 2] { [1.0, RATIO()] }
fn f<'a>(x: f64) -> f64 { println!("RATIO '{x}'"); /* RATIO */ x + RATIO() * BOTH()[0] + MAX_RATIO } // RATIO
"#;
        let found = &changed[Path::new("crates/a/src/b.rs")];
        let (before, after) = found.split_once("static").expect("a choice");
        let after = &after[after.find("if").expect("values")..];
        assert_eq!(format!("{before}CHOICE {after}"), expected, "{found}");
        let found = &changed[Path::new("crates/a/src/c.rs")];
        assert_eq!(
            *found,
            user.replace("b::RATIO ", "b::RATIO() ")
                .replace("const fn", "fn")
        );
        assert_eq!(changed.len(), 2, "{changed:?}");
    }

    #[test]
    fn other_texts_are_refused() {
        for (text, complaint) in [
            ("const RATIOS: f64 = 1.0;\n", "declared 0 times"),
            ("const RATIO: f64 = 1.0;\n", "RATIO is 1.0, but 2.0"),
        ] {
            let error = transformed(&[("crates/a/src/b.rs", text)]).expect_err(text);
            assert!(error.to_string().contains(complaint), "{text}: {error}");
        }
    }
}
