//! Scenes and tolerances for the tests and benches of the other crates; no part of the product.
//!
//! A scene here is right by its making: where one is not, its builder panics, and so the test fails that asked for it.
#![allow(clippy::unwrap_used)]

pub mod brute_force;
pub mod compare;
pub mod identical;
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
