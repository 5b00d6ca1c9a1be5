//! The looks: several settings under one name, for users to choose.

use super::context::{ContextFrom, ContextName};
use super::focus::Focus;
use super::slab::{Slab, SlabMode};
use super::value::Value;
use crate::named::Named;

/// A focus that shows only the context.
const NOTHING_OF_THE_CUT: Focus = Focus { margin: -1e6, fade: 0.0 };
/// Thickness of the look with a thick slab (mm).
const THICK_SLAB_MM: f64 = 10.0;
/// How much the look with a focus darkens the context around the cut.
const HALO: f64 = 0.6;

/// Several settings under one name; all others have their defaults.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// The name of the look on the command line and in Python.
    pub name: &'static str,
    /// The label of the look on a page.
    pub words: &'static str,
    /// A sentence that says what the look shows.
    pub sentence: &'static str,
    /// The settings that the look changes, and their values.
    pub values: fn() -> Vec<(&'static str, Value)>,
}

/// All looks, in display order.
pub const LOOKS: [Look; 5] = [
    Look {
        name: "lumen",
        words: "Lumen",
        sentence: "the cut through the middle of every vessel, over all of the picture",
        values: Vec::new,
    },
    Look {
        name: "focus",
        words: "Lumen in 3D",
        sentence: "the cut around the vessels amid the shaded body",
        values: focus,
    },
    Look { name: "body", words: "Body in 3D", sentence: "the shaded body alone, nothing cut", values: body },
    Look {
        name: "mip",
        words: "MIP",
        sentence: "the largest value along each ray, nothing cut",
        values: mip,
    },
    Look {
        name: "slab",
        words: "Thick slab",
        sentence: "the largest value of 10 mm around the cut",
        values: slab,
    },
];

fn focus() -> Vec<(&'static str, Value)> {
    let mut chosen = shaded(Focus::default());
    chosen.extend([("context_halo", Value::Number(HALO)), ("context_body", Value::Flag(true))]);
    chosen
}

fn body() -> Vec<(&'static str, Value)> {
    let mut chosen = shaded(NOTHING_OF_THE_CUT);
    chosen.push(("context_from", Value::Name(ContextFrom::Whole.name().to_owned())));
    chosen
}

fn shaded(focus: Focus) -> Vec<(&'static str, Value)> {
    vec![
        ("focus", Value::Focus(focus)),
        ("context", Value::Name(ContextName::Mida.name().to_owned())),
        ("context_shading", Value::Flag(true)),
    ]
}

fn mip() -> Vec<(&'static str, Value)> {
    vec![
        ("focus", Value::Focus(NOTHING_OF_THE_CUT)),
        ("context", Value::Name(ContextName::Mip.name().to_owned())),
    ]
}

fn slab() -> Vec<(&'static str, Value)> {
    vec![("slab", Value::Slab(Slab { thickness: THICK_SLAB_MM, mode: SlabMode::Max }))]
}
