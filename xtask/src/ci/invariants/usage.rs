//! No crate declares a dependency that it does not use.

use anyhow::{Context, Result};
use toml::{Table, Value};

use super::code::tokens;

/// The dependencies of one kind that none of the sources names.
pub(super) fn check(
    file: &str,
    manifest: &str,
    kind: &str,
    sources: &[String],
) -> Result<Vec<String>> {
    let manifest: Table = manifest
        .parse()
        .with_context(|| format!("reading {file}"))?;
    let declared = manifest.get(kind).and_then(Value::as_table);
    let names = declared.into_iter().flat_map(Table::keys);
    let is_used = |name: &&String| {
        let identifier = name.replace('-', "_");
        sources
            .iter()
            .any(|source| tokens(source).contains(&&*identifier))
    };
    Ok(names
        .filter(|name| !is_used(name))
        .map(|name| format!("{file}: [{kind}] `{name}` is used nowhere"))
        .collect())
}

#[cfg(test)]
mod tests {
    use super::check;

    #[test]
    fn a_dependency_that_no_source_names_is_refused() {
        let manifest =
            "[dependencies]\nlibm = \"1\"\nnum-complex = \"1\"\nthiserror.workspace = true\n";
        let sources = [
            "use num_complex::Complex; // libm",
            "#[derive(thiserror::Error)] struct A;",
        ];
        let broken = check(
            "x/Cargo.toml",
            manifest,
            "dependencies",
            &sources.map(str::to_owned),
        );
        let expected = ["x/Cargo.toml: [dependencies] `libm` is used nowhere"];
        assert_eq!(
            broken.expect("the manifest is TOML"),
            expected,
            "of {sources:?}"
        );
    }
}
