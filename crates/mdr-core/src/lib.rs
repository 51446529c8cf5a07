//! mdr-core
