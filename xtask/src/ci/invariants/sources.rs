//! What the source of a crate under `crates/` may contain.

use super::code::{tokens, without_tests};

/// Files are split before they get longer; their unit tests do not count.
const MAX_LINES: usize = 500;

/// Parts of the standard library that only the binaries may use.
const OUTSIDE_WORLD: [&str; 6] = ["env", "fs", "io", "net", "process", "time"];

const PRINTING: [&str; 5] = ["dbg", "eprint", "eprintln", "print", "println"];

/// Crates that appear in no public signature.
const HIDDEN: [&str; 3] = ["faer", "realfft", "rustfft"];

/// Checks one file; returns what is broken.
pub(super) fn check(file: &str, text: &str) -> Vec<String> {
    let text = without_tests(text);
    let n_lines = text.lines().count();
    let mut broken = Vec::new();
    if n_lines > MAX_LINES {
        broken.push(format!(
            "{n_lines} lines without unit tests, at most {MAX_LINES} are allowed"
        ));
    }
    let tokens = tokens(&text);
    broken.extend(
        outside_world(&tokens).map(|name| format!("std::{name} belongs above the library crates")),
    );
    broken
        .extend(printing(&tokens).map(|name| format!("{name}! belongs above the library crates")));
    broken.extend(exposed(&tokens).map(|(item, name)| {
        format!("the public `{item}` exposes `{name}`, an implementation detail")
    }));
    broken.iter().map(|why| format!("{file}: {why}")).collect()
}

/// Modules of the standard library that are named after `std::`, alone or in braces.
fn outside_world<'a>(tokens: &'a [&'a str]) -> impl Iterator<Item = &'a str> {
    let after_std = tokens
        .windows(3)
        .enumerate()
        .filter(|(_, window)| *window == ["std", ":", ":"]);
    let named = after_std.flat_map(|(at, _)| first_names(&tokens[at + 3..]));
    named.filter(|name| OUTSIDE_WORLD.contains(name))
}

/// The name that comes next, or the first name of each path in the braces that come next.
fn first_names<'a>(tokens: &[&'a str]) -> Vec<&'a str> {
    if tokens.first() != Some(&"{") {
        return tokens.first().copied().into_iter().collect();
    }
    let group = &tokens[..=closing(tokens)];
    let mut depth = 0;
    let mut names = Vec::new();
    for pair in group.windows(2) {
        depth += nesting(pair[0]);
        if depth == 1 && ["{", ","].contains(&pair[0]) {
            names.push(pair[1]);
        }
    }
    names
}

fn printing<'a>(tokens: &'a [&'a str]) -> impl Iterator<Item = &'a str> {
    let macros = tokens.windows(2).filter(|pair| pair[1] == "!");
    macros
        .map(|pair| pair[0])
        .filter(|name| PRINTING.contains(name))
}

/// Public items that name a hidden crate, or something imported from one.
fn exposed<'a>(tokens: &'a [&'a str]) -> impl Iterator<Item = (String, &'a str)> {
    let hidden = hidden_names(tokens);
    let public = tokens
        .iter()
        .enumerate()
        .filter(|(at, token)| **token == "pub" && tokens.get(at + 1) != Some(&"("));
    public.filter_map(move |(at, _)| {
        let item = public_part(&tokens[at + 1..]);
        let name = item.iter().find(|token| hidden.contains(token))?;
        Some((item[..item.len().min(2)].join(" "), *name))
    })
}

fn hidden_names<'a>(tokens: &[&'a str]) -> Vec<&'a str> {
    let mut names = HIDDEN.to_vec();
    for (at, pair) in tokens.windows(2).enumerate() {
        if pair[0] == "use" && HIDDEN.contains(&pair[1]) {
            let path = tokens[at + 1..].iter().take_while(|token| **token != ";");
            let starts_word = |token: &&&str| token.starts_with(|c: char| c.is_alphabetic());
            names.extend(
                path.filter(starts_word)
                    .filter(|name| !["self", "as"].contains(name)),
            );
        }
    }
    names
}

/// What others see of the item or field whose tokens follow `pub`.
fn public_part<'a>(tokens: &'a [&'a str]) -> &'a [&'a str] {
    let end = match tokens.first() {
        // All of it.
        Some(&("enum" | "trait")) => position_outside_brackets(tokens, &["{"])
            .map(|opening| opening + closing(&tokens[opening..])),
        // Private fields are not seen, public ones are items of their own.
        Some(&"struct") => position_outside_brackets(tokens, &["{", "(", ";"]),
        Some(&("fn" | "const" | "static" | "type" | "mod" | "use")) => {
            position_outside_brackets(tokens, &["{", ";"])
        }
        _ => position_outside_brackets(tokens, &[",", ")", "}"]),
    };
    &tokens[..end.unwrap_or(tokens.len())]
}

/// Index of the first of the `wanted` tokens that stands in no bracket opened before it.
fn position_outside_brackets(tokens: &[&str], wanted: &[&str]) -> Option<usize> {
    let mut depth = 0;
    tokens.iter().position(|token| {
        let found = depth == 0 && wanted.contains(token);
        depth += nesting(token);
        found
    })
}

/// Index of the bracket that closes the first one, or of the last token.
fn closing(tokens: &[&str]) -> usize {
    let mut depth = 0;
    let closes = |token: &&str| {
        depth += nesting(token);
        depth == 0
    };
    tokens.iter().position(closes).unwrap_or(tokens.len() - 1)
}

fn nesting(token: &str) -> i32 {
    match token {
        "{" | "(" | "[" => 1,
        "}" | ")" | "]" => -1,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_refused(text: &str, why: &str) {
        let broken = check("crates/x/src/y.rs", text);
        assert!(
            broken.len() == 1
                && broken[0].contains(why)
                && broken[0].starts_with("crates/x/src/y.rs: "),
            "expected one line with {why:?} for\n{text}\nbut got {broken:?}"
        );
    }

    fn assert_allowed(text: &str) {
        let broken = check("crates/x/src/y.rs", text);
        assert_eq!(broken, [""; 0], "for\n{text}");
    }

    #[test]
    fn long_files_are_refused_and_their_tests_do_not_count() {
        let lines = "// a line\n".repeat(MAX_LINES);
        assert_allowed(&format!(
            "{lines}#[cfg(test)]\nmod tests {{\n    fn a() {{}}\n}}\n"
        ));
        assert_refused(&format!("{lines}// one more\n"), "501 lines");
    }

    #[test]
    fn libraries_neither_print_nor_read_files_nor_clocks() {
        assert_refused("fn a() { println!(\"x\"); }", "println!");
        assert_refused("use std::fs::File;", "std::fs");
        assert_refused("use std::{fmt, io::{self, Write}, ops::Range};", "std::io");
        assert_refused("fn a() { let t = std::time::Instant::now(); }", "std::time");
        assert_allowed(
            "use std::{fmt, ops::{Add, fs}};\n// println! std::fs\nconst A: &str = \"std::fs\";",
        );
    }

    #[test]
    fn transforms_and_factorizations_stay_inside() {
        let import = "use rustfft::{Fft, num_complex::Complex};\n";
        for item in [
            "pub fn spectrum(\n    a: f64,\n) -> Vec<Complex<f64>> {}",
            "pub fn spectrum(a: [f64; 2], b: Complex<f64>) {}",
            "pub struct A { pub plan: Arc<dyn Fft<f64>>, b: f64 }",
            "pub struct A(pub Vec<Complex<f64>>, f64);",
            "pub enum E { One(Complex<f64>) }",
            "pub trait T { fn a(&self) -> Complex<f64>; }",
            "pub type A = Complex<f64>;",
        ] {
            assert_refused(&format!("{import}{item}"), "implementation detail");
        }
        assert_refused("pub use realfft::RealToComplex;", "`realfft`");
        assert_refused("pub fn solve(a: &faer::Mat<f64>) {}", "`faer`");
        for item in [
            "pub struct A { pub shape: [usize; 2], plan: Arc<dyn Fft<f64>> }",
            "pub struct A(Complex<f64>);",
            "pub(crate) fn spectrum() -> Complex<f64> {}",
            "pub fn a(b: f64) -> f64 { let c = Complex::new(b, b); c.re }",
        ] {
            assert_allowed(&format!("{import}{item}"));
        }
    }
}
