//! What is traced, and the words for it.

use std::ops::Range;

use lumencut_core::polarity::Polarity;

/// Values of air in lumens (HU).
pub(crate) const AIR: Range<f64> = -1100.0..-700.0;

/// The kind of lumens in a scan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// Vessels with contrast medium in CT.
    CtVessels,
    /// Bright vessels in other scans.
    #[default]
    Vessels,
    /// Lumens with air in CT.
    Airways,
    /// Other lumens that are darker than the tissue around them.
    DarkLumens,
}

/// The words for a kind; of two texts, the second is short, for lists and counts.
#[derive(Debug)]
pub struct Words {
    /// One lumen.
    pub one: &'static str,
    /// The name of a lumen, before its number.
    pub name: &'static str,
    /// Several lumens.
    pub several: &'static str,
    /// The scan that tracing expects.
    pub scan: &'static str,
    pub(crate) scarce: [&'static str; 2],
    pub(crate) sides: [&'static str; 2],
    pub(crate) flat: [&'static str; 2],
    pub(crate) uneven: [&'static str; 2],
    pub(crate) pale: [&'static str; 2],
}

const ANGIOGRAPHY: &str = "an angiography, whose vessels are brighter than the tissue around them";

const CT_VESSELS: Words = Words {
    one: "vessel",
    name: "Vessel",
    several: "vessels",
    scan: ANGIOGRAPHY,
    scarce: [
        "hardly any vessel of the scan is long, round and bright: it may have no contrast medium",
        "no contrast agent?",
    ],
    sides: ["it is bright on most sides: bone?", "near bone"],
    flat: ["it is flat, like a plate of bone", "flat, like bone"],
    uneven: ["it is uneven inside, like marrow", "marrow-like"],
    pale: ["it is wide and paler than the vessels, like an organ", "wide and pale"],
};

const VESSELS: Words = Words {
    scarce: [
        "hardly any vessel of the scan is long, round and bright: it may be no angiography",
        "no angiography?",
    ],
    sides: ["it is bright on most sides: fat or skin?", "bright beside"],
    flat: ["it is flat, like a layer of tissue", "flat"],
    uneven: ["it is uneven inside, like tissue", "uneven inside"],
    ..CT_VESSELS
};

const DARK_LUMENS: Words = Words {
    one: "dark lumen",
    name: "Lumen",
    several: "dark lumens",
    scan: "a scan whose lumens are darker than the tissue around them",
    scarce: [
        "hardly any dark lumen of the scan is long and round: the lumens may be bright",
        "bright lumens?",
    ],
    sides: ["it is dark on most sides: fat or air?", "dark beside"],
    pale: ["it is wide and brighter than the other dark lumens, like fluid", "wide and bright"],
    ..VESSELS
};

const AIRWAYS: Words = Words {
    one: "airway",
    name: "Airway",
    several: "airways",
    scan: "a CT whose airways are darker than the tissue around them",
    scarce: ["hardly any airway of the scan is long and round: it may show none", "no airways?"],
    sides: ["it is dark on most sides: lung?", "in lung"],
    flat: ["it is flat, like a layer of air", "flat, like air"],
    uneven: ["it is uneven inside, like lung or bowel", "like lung"],
    pale: ["it is wide and brighter than the airways, like lung", "wide, like lung"],
};

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::CtVessels, Self::Vessels, Self::Airways, Self::DarkLumens];

    /// The kind of lumens with this polarity and usual value (unit of the volume).
    pub fn of(polarity: Polarity, is_ct: bool, value: f64) -> Self {
        match polarity {
            Polarity::Bright if is_ct => Self::CtVessels,
            Polarity::Bright => Self::Vessels,
            Polarity::Dark if AIR.contains(&value) => Self::Airways,
            Polarity::Dark => Self::DarkLumens,
        }
    }

    /// The kind that a scan is expected to show.
    pub fn of_scan(polarity: Polarity, is_ct: bool) -> Self {
        match polarity {
            Polarity::Dark if is_ct => Self::Airways,
            _ => Self::of(polarity, is_ct, 0.0),
        }
    }

    /// The words for this kind.
    pub fn words(self) -> &'static Words {
        match self {
            Self::CtVessels => &CT_VESSELS,
            Self::Vessels => &VESSELS,
            Self::Airways => &AIRWAYS,
            Self::DarkLumens => &DARK_LUMENS,
        }
    }
}
