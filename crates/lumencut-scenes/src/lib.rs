//! Scenes and tolerances for tests and benches; not part of the product. An invalid scene panics, so the test fails.
#![allow(clippy::unwrap_used, missing_docs)]

pub mod brute_force;
pub mod compare;
pub mod contexts;
pub mod lumen;
pub mod pictures;
pub mod random;
pub mod random_tree;
pub mod settings;
pub mod timing;
pub mod tolerances;
pub mod trees;
pub mod views;
pub mod volumes;
pub mod workloads;
pub mod zones;
