//! What has been found: vessels in parts that hang together, with what makes them doubtful.

use crate::trace::find::track::TrackDoubt;
use crate::trace::lines::centerline::Centerline;

/// The vessels of a scan.
#[derive(Clone, Debug)]
pub struct Trees {
    /// The vessels, part by part, the most important part first; within a part the root first.
    pub vessels: Vec<FoundVessel>,
    /// The usual level of vessels, how far that lies above their surroundings, and the noise, in the unit of the volume.
    pub level: f64,
    /// See `level`.
    pub contrast: f64,
    /// See `level`.
    pub noise: f64,
    /// Whether the scan shows vessels as an angiography does; else none of them is sure unless a seed says that there is one.
    pub is_angiography: bool,
}

/// A vessel that was found.
#[derive(Clone, Debug)]
pub struct FoundVessel {
    /// Its points, radii and confidence, from the root outwards.
    pub line: Centerline,
    /// Which part it belongs to, 0 for the most important one.
    pub part: usize,
    /// How sure it is that this is a vessel, 0 to 1.
    pub confidence: f64,
    /// Why it is doubtful; none where it is sure.
    pub doubt: Option<TrackDoubt>,
}

/// Why a click gives no vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoVessel {
    /// None was found there: how far the nearest one is (mm); infinitely far where none was found at all.
    NotHere(f64),
    /// The click lies within a vessel that there is already, or all that it would add does.
    Already,
}

/// From this confidence on a vessel is sure.
pub const SURE: f64 = 0.7;

impl TrackDoubt {
    /// Every reason.
    pub const ALL: [Self; 10] = [
        Self::BrightSides,
        Self::Flat,
        Self::Uneven,
        Self::PaleAndWide,
        Self::Short,
        Self::Rough,
        Self::Faint,
        Self::Open,
        Self::Gap,
        Self::Scarce,
    ];

    /// The doubt in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Scarce => {
                "hardly any vessel of the scan is long, round and bright: it may have no contrast medium"
            }
            Self::BrightSides => "it is bright on most sides: bone?",
            Self::Flat => "it is flat, like a plate of bone",
            Self::Uneven => "it is uneven inside, like marrow",
            Self::PaleAndWide => "it is wide and paler than the vessels, like an organ",
            Self::Short => "it is short",
            Self::Rough => "its width changes from place to place",
            Self::Faint => "its contrast is low",
            Self::Open => "few of its walls are seen",
            Self::Gap => "it bridges a gap",
        }
    }

    /// The doubt in a word or two, for a row of a list and for counts.
    pub fn short(self) -> &'static str {
        match self {
            Self::Scarce => "no contrast?",
            Self::BrightSides => "beside bone",
            Self::Flat => "flat",
            Self::Uneven => "uneven inside",
            Self::PaleAndWide => "like an organ",
            Self::Short => "short",
            Self::Rough => "uneven width",
            Self::Faint => "faint",
            Self::Open => "few walls",
            Self::Gap => "across a gap",
        }
    }
}
