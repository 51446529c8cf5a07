//! The scene file: indenter, material, load and what is asked, as a person types them.
//!
//! Tables are externally tagged, because only then an error knows the line and the key it belongs to.

mod error;
mod height_map_file;
mod indenter;
mod load;
mod material;
mod solve;
mod source;
mod table_file;

use schemars::JsonSchema;
use serde::Deserialize;

pub(crate) use error::{SceneError, in_range, not_negative, positive};
pub(crate) use height_map_file::height_map;
pub(crate) use indenter::{HeightMapFile, Indenter, Term};
pub(crate) use load::{Control, Load};
pub(crate) use material::{Branch, MaterialTable};
pub(crate) use solve::{Accuracy, Method, Model, Solve};
pub(crate) use source::{Source, scene_file, split_index};
pub(crate) use table_file::profile;

/// A rigid body on a half space, and what is asked about it.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneFile {
    /// The rigid body.
    pub(crate) indenter: Indenter,
    /// The half space.
    pub(crate) material: MaterialTable,
    /// How the body is pressed and moved.
    pub(crate) load: Load,
    /// What is asked, and how well.
    #[serde(default)]
    pub(crate) solve: Solve,
}

/// The JSON Schema of the scene file, as docs/scene.schema.json holds it.
pub(crate) fn json_schema() -> anyhow::Result<String> {
    let mut text = serde_json::to_string_pretty(&schemars::schema_for!(SceneFile))?;
    text.push('\n');
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::json_schema;

    /// `cargo xtask scene-schema > docs/scene.schema.json` makes it current.
    #[test]
    fn the_committed_schema_is_that_of_the_types() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scene.schema.json");
        let committed = std::fs::read_to_string(path).expect("the schema is committed");
        let current = json_schema().expect("the types have a schema");
        assert!(
            committed == current,
            "docs/scene.schema.json is not current; \
             `cargo xtask scene-schema > docs/scene.schema.json` makes it so"
        );
    }
}
