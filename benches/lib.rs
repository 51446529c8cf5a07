//! Timings of the workspace; see `benches/`.
