//! The table of section flags for Python package and viewer: names, words, meanings and colours.

use lumencut_vessels::measure::section::flags::{
    AT_LIMIT, BRANCH, BY_HAND, CALCIUM, IRREGULAR, LINE_BY_HAND, METAL, NEIGHBOR, NO_EDGE, OUTSIDE, PLAQUE,
    RECENTERED, RESTLESS_LINE,
};
use serde::Serialize;

/// A flag of a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct FlagLook {
    /// The name of the flag's constant, such as `NO_EDGE`.
    #[serde(skip)]
    pub name: &'static str,
    /// The flag's bit in the flags of a section.
    #[serde(skip)]
    pub bit: u32,
    /// The word for the flag in tables and reports, such as `no clear wall`; it is part of the file formats.
    pub word: &'static str,
    /// What the flag means, as part of a sentence.
    pub meaning: &'static str,
    /// The colour of the flag on paper, `#rrggbb`.
    #[serde(skip)]
    pub paper: &'static str,
    /// The colour of the flag on a dark screen, `#rrggbb`.
    pub screen: &'static str,
}

const fn look(
    (name, bit): (&'static str, u32),
    [word, meaning]: [&'static str; 2],
    [paper, screen]: [&'static str; 2],
) -> FlagLook {
    FlagLook { name, bit, word, meaning, paper, screen }
}

/// All flags, in the order of plots and tables.
pub const FLAGS: [FlagLook; 13] = [
    look(
        ("AT_LIMIT", AT_LIMIT),
        [
            "near the blur",
            "the lumen is narrower than 1.5 times the blur (FWHM), or twice the spacing of thick slices, or an unknown blur leaves 7 % of it unsure",
        ],
        ["#7b5ea7", "#b59ae0"],
    ),
    look(
        ("BRANCH", BRANCH),
        ["branch", "the section lies in a junction, or the lumen continues sideways"],
        ["#3a7d44", "#63b972"],
    ),
    look(
        ("CALCIUM", CALCIUM),
        ["calcium", "something in the wall is brighter than the lumen and does not count as lumen"],
        ["#b8860b", "#e0ac2b"],
    ),
    look(
        ("METAL", METAL),
        [
            "metal",
            "something brighter surrounds the lumen, is far brighter than it, or repeats along it: a stent",
        ],
        ["#4d4d4d", "#b4b4b4"],
    ),
    look(
        ("NEIGHBOR", NEIGHBOR),
        ["vessel beside", "another vessel, or bone, touches the wall"],
        ["#20808d", "#45b9c8"],
    ),
    look(("OUTSIDE", OUTSIDE), ["outside", "the section reaches beyond the volume"], ["#8c564b", "#c99184"]),
    look(
        ("NO_EDGE", NO_EDGE),
        ["no clear wall", "no wall was found, or only an implausible one"],
        ["#d62728", "#ff6f6f"],
    ),
    look(
        ("RECENTERED", RECENTERED),
        ["centre moved", "the centerline lies outside the measured lumen"],
        ["#e377c2", "#f09fd6"],
    ),
    look(
        ("IRREGULAR", IRREGULAR),
        ["not round", "the wall is far from an ellipse: the shortest and longest diameters are unreliable"],
        ["#6b8e23", "#a4c957"],
    ),
    look(
        ("RESTLESS_LINE", RESTLESS_LINE),
        ["restless line", "the centerline turns by more than 75° within one diameter, which no vessel does"],
        ["#1f5fbf", "#7fb2ff"],
    ),
    look(
        ("PLAQUE", PLAQUE),
        ["bright plaque", "plaque beside the lumen is nearly as bright as it: the lumen may be narrower"],
        ["#a0522d", "#d98a5f"],
    ),
    look(("BY_HAND", BY_HAND), ["by hand", "the reader drew the contour"], ["#00708a", "#6fd3ff"]),
    look(
        ("LINE_BY_HAND", LINE_BY_HAND),
        ["line by hand", "the reader moved the centerline"],
        ["#5a6b00", "#c3d94a"],
    ),
];

pub(crate) fn set_in(bits: u32) -> impl Iterator<Item = &'static FlagLook> {
    FLAGS.iter().filter(move |flag| bits & flag.bit > 0)
}

#[cfg(test)]
#[path = "tests/flag_table.rs"]
mod tests;
