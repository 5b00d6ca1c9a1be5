//! Scenes made from formulas, with the truth beside them.
