//! Who may depend on whom.
//!
//! A new dependency of a library crate is a decision: it is made here and in the manifest together.

use anyhow::{Context, Result};
use toml::{Table, Value};

/// What one crate under `crates/` may depend on.
struct Rule {
    name: &'static str,
    /// Dependencies without which its mathematics cannot do.
    required: &'static [&'static str],
    /// Dependencies that must be optional.
    optional: &'static [&'static str],
    /// Crates of this workspace that only its tests may use.
    in_tests: &'static [&'static str],
}

const RULES: [Rule; 8] = [
    Rule {
        name: "viscofriction-numerics",
        required: &["thiserror"],
        optional: &["serde"],
        in_tests: &[],
    },
    Rule {
        name: "indenters",
        required: &["libm", "numerics", "thiserror"],
        optional: &["serde"],
        in_tests: &["casebook"],
    },
    Rule {
        name: "rheology",
        required: &["libm", "thiserror"],
        optional: &["nalgebra", "serde"],
        in_tests: &["casebook"],
    },
    Rule {
        name: "friction-analytic",
        required: &["indenters", "numerics", "rheology", "thiserror"],
        optional: &["serde"],
        in_tests: &["casebook"],
    },
    Rule {
        name: "mdr-core",
        required: &["indenters", "numerics", "rheology", "thiserror"],
        optional: &["rayon", "serde"],
        in_tests: &["casebook", "friction-analytic"],
    },
    Rule {
        name: "bem-halfspace",
        required: &[
            "faer",
            "indenters",
            "numerics",
            "realfft",
            "rheology",
            "rustfft",
            "thiserror",
        ],
        optional: &["rayon", "serde"],
        in_tests: &["casebook", "friction-analytic"],
    },
    Rule {
        name: "viscofriction-plot",
        required: &["colorous", "resvg", "thiserror", "ttf-parser", "xmlwriter"],
        optional: &[],
        in_tests: &[],
    },
    Rule {
        name: "casebook",
        required: &["serde_json"],
        optional: &[],
        in_tests: &[],
    },
];

/// Members of the workspace that see all crates and that no crate may see.
const ABOVE: [&str; 2] = ["xtask", "benches"];

/// Checks the manifest of the workspace; returns what is broken.
pub(super) fn check_workspace(text: &str) -> Result<Vec<String>> {
    let manifest: Table = text.parse().context("reading Cargo.toml")?;
    let shared = manifest.get("workspace").and_then(Value::as_table);
    let dependencies = shared.and_then(|table| table.get("dependencies"));
    let dependencies = dependencies.and_then(Value::as_table);
    let renamed = dependencies.into_iter().flatten().filter(is_renamed);
    Ok(renamed
        .map(|(name, _)| {
            format!("Cargo.toml: `{name}` is a renamed dependency, which hides what it is")
        })
        .collect())
}

/// Checks the manifest of a crate under `crates/`; returns what is broken.
pub(super) fn check_crate(file: &str, text: &str) -> Result<Vec<String>> {
    let manifest: Table = text.parse().with_context(|| format!("reading {file}"))?;
    let name = manifest
        .get("package")
        .and_then(|package| package.get("name"));
    let name = name.and_then(Value::as_str).unwrap_or_default();
    let Some(rule) = RULES.iter().find(|rule| rule.name == name) else {
        let table = "the table in xtask/src/ci/invariants/manifests.rs";
        return Ok(vec![format!(
            "{file}: the crate `{name}` is missing from {table}"
        )]);
    };
    let mut broken = Vec::new();
    for kind in ["dependencies", "build-dependencies"] {
        let broken_here = entries(&manifest, kind).filter_map(|entry| rule.refuses(entry));
        broken.extend(broken_here.map(|why| format!("{file}: [{kind}] {why}")));
    }
    let in_tests = entries(&manifest, "dev-dependencies");
    let broken_here = in_tests.filter_map(|entry| rule.refuses_in_tests(entry));
    broken.extend(broken_here.map(|why| format!("{file}: [dev-dependencies] {why}")));
    if manifest.contains_key("target") {
        broken.push(format!(
            "{file}: [target] a library crate is the same on all platforms"
        ));
    }
    Ok(broken)
}

type Entry<'a> = (&'a String, &'a Value);

fn entries<'a>(manifest: &'a Table, kind: &str) -> impl Iterator<Item = Entry<'a>> {
    manifest
        .get(kind)
        .and_then(Value::as_table)
        .into_iter()
        .flatten()
}

/// Crates of this workspace may have a longer name on the registry.
fn is_renamed((_, value): &Entry<'_>) -> bool {
    value.get("package").is_some() && value.get("path").is_none()
}

impl Rule {
    /// Why a dependency is not allowed, if it is not.
    fn refuses(&self, entry: Entry<'_>) -> Option<String> {
        let (name, value) = entry;
        if is_renamed(&entry) {
            return Some(format!("`{name}` is renamed, which hides what it is"));
        }
        if self.optional.contains(&name.as_str()) {
            let is_optional = value.get("optional").and_then(Value::as_bool) == Some(true);
            return (!is_optional).then(|| format!("`{name}` must be optional"));
        }
        (!self.required.contains(&name.as_str())).then(|| {
            let allowed = [self.required, self.optional].concat().join(", ");
            format!("`{name}` is not allowed; `{}` may use {allowed}", self.name)
        })
    }

    /// Why a dependency of the tests is not allowed, if it is not; other people's crates are.
    fn refuses_in_tests(&self, entry: Entry<'_>) -> Option<String> {
        let (name, _) = entry;
        if is_renamed(&entry) {
            return Some(format!("`{name}` is renamed, which hides what it is"));
        }
        let name = name.as_str();
        let is_ours = RULES.iter().any(|rule| rule.name == name) || ABOVE.contains(&name);
        (is_ours && !self.in_tests.contains(&name)).then(|| {
            let allowed = self.in_tests.join(", ");
            format!(
                "`{name}` is not allowed; of this workspace the tests of `{}` may use {allowed}",
                self.name
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is broken in a manifest of the crate `name` with these lines.
    fn broken(name: &str, lines: &str) -> Vec<String> {
        let text = format!("[package]\nname = \"{name}\"\n{lines}");
        check_crate("crates/x/Cargo.toml", &text).expect("the manifest is TOML")
    }

    fn assert_refused(name: &str, lines: &str, why: &str) {
        let broken = broken(name, lines);
        assert!(
            broken.len() == 1
                && broken[0].contains(why)
                && broken[0].starts_with("crates/x/Cargo.toml: "),
            "expected one line with {why:?} for\n{lines}\nbut got {broken:?}"
        );
    }

    #[test]
    fn methods_must_not_see_each_other() {
        for (one, other) in [
            ("mdr-core", "bem-halfspace"),
            ("bem-halfspace", "mdr-core"),
            ("mdr-core", "friction-analytic"),
            ("friction-analytic", "mdr-core"),
        ] {
            let lines = format!("[dependencies]\n{other}.workspace = true");
            assert_refused(one, &lines, &format!("`{other}` is not allowed"));
        }
        let oracle = "[dev-dependencies]\nfriction-analytic.workspace = true";
        assert_eq!(
            broken("mdr-core", oracle),
            [""; 0],
            "the oracle is allowed in tests"
        );
        assert_refused(
            "friction-analytic",
            "[dev-dependencies]\nmdr-core.workspace = true",
            "of this workspace",
        );
        assert_refused(
            "mdr-core",
            "[dev-dependencies]\nbem-halfspace.workspace = true",
            "of this workspace",
        );
    }

    #[test]
    fn leaves_see_nobody_but_the_casebook_in_tests() {
        assert_refused(
            "indenters",
            "[dependencies]\nrheology.workspace = true",
            "`rheology` is not allowed",
        );
        assert_refused(
            "rheology",
            "[dev-dependencies]\nindenters.workspace = true",
            "`indenters` is not allowed",
        );
        assert_refused(
            "rheology",
            "[dependencies]\ncasebook.workspace = true",
            "`casebook` is not allowed",
        );
        let casebook = "[dev-dependencies]\ncasebook.workspace = true\nproptest.workspace = true";
        assert_eq!(
            broken("rheology", casebook),
            [""; 0],
            "the casebook is allowed in tests"
        );
    }

    #[test]
    fn files_and_command_lines_stay_above_the_libraries() {
        for name in ["csv", "clap", "indicatif", "xtask"] {
            let lines = format!("[dependencies]\n{name} = \"1\"");
            assert_refused("bem-halfspace", &lines, &format!("`{name}` is not allowed"));
        }
        assert_refused(
            "mdr-core",
            "[build-dependencies]\ncc = \"1\"",
            "[build-dependencies] `cc`",
        );
        assert_refused(
            "mdr-core",
            "[target.'cfg(unix)'.dependencies]\nlibc = \"1\"",
            "[target]",
        );
    }

    #[test]
    fn serialization_must_be_optional() {
        for lines in [
            "[dependencies]\nserde.workspace = true",
            "[dependencies]\nserde = { workspace = true, optional = false }",
        ] {
            assert_refused("rheology", lines, "`serde` must be optional");
        }
        let optional = "[dependencies]\nserde = { workspace = true, optional = true }";
        assert_eq!(
            broken("rheology", optional),
            [""; 0],
            "an optional serde is allowed"
        );
    }

    #[test]
    fn another_name_does_not_hide_a_dependency() {
        assert_refused(
            "rheology",
            "[dependencies]\nthiserror = { package = \"csv\", version = \"1\" }",
            "renamed",
        );
        let shared = "[workspace.dependencies]\nthiserror = { package = \"csv\", version = \"1\" }";
        let broken = check_workspace(shared).expect("the manifest is TOML");
        assert_eq!(broken.len(), 1, "{broken:?}");
    }

    #[test]
    fn a_new_crate_needs_a_rule() {
        assert_refused("tribology", "", "`tribology` is missing from the table");
    }

    #[test]
    fn a_manifest_that_cannot_be_read_is_named() {
        let error = check_crate("crates/x/Cargo.toml", "[package").expect_err("this is no TOML");
        assert_eq!(
            error.to_string(),
            "reading crates/x/Cargo.toml",
            "{error:#}"
        );
    }
}
