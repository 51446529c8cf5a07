//! What a scene asks, and what comes back; one binary, one module per claim.
#![expect(
    clippy::disallowed_methods,
    reason = "scenes name files, which these tests write and read for the library"
)]

mod answers_agree;
mod explained_omissions;
#[cfg(feature = "fit")]
mod friction_fits;
mod gaps;
mod heat;
mod height_maps_of_numpy;
mod histories;
mod histories_on_layers;
mod layers;
mod malformed;
mod motions;
#[cfg(feature = "fit")]
mod own_materials;
mod rough_scenes;
mod scenes;
mod sensitivities;
mod sensitivities_of_more_scenes;
mod shared;
mod shear;
mod strain;
mod support;
mod sweeps_share_bodies;
mod warnings;
mod windows;

/// Cases of the tests.
const TABLES: [&str; 3] = [
    include_str!("../data/answers.txt"),
    include_str!("../data/cases.txt"),
    include_str!("../data/malformed.txt"),
];
