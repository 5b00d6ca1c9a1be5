//! Scenes made from formulas, with the truth beside them.

pub mod random_tree;
