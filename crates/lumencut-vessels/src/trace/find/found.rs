//! Results of finding vessels.

use crate::kind::Kind;
use crate::trace::find::track::TrackDoubt;
use crate::trace::lines::centerline::Centerline;
use lumencut_core::math::arc_length::arc_lengths;

/// All vessels found in a scan.
#[derive(Clone, Debug, Default)]
pub struct Trees {
    /// Vessels ordered by part, the most important part first. Each part begins with its root vessel.
    pub vessels: Vec<FoundVessel>,
    /// Intensity that vessels usually have, in the unit of the volume.
    pub level: f64,
    /// Contrast that vessels usually have to their surroundings, in the unit of the volume.
    pub contrast: f64,
    /// Level and contrast of another reading of the scan, if one of both is far paler.
    pub other: Option<[f64; 2]>,
    /// Noise of the voxels, in the unit of the volume.
    pub noise: f64,
    /// Whether the scan looks like an angiography. If not, and without a seed, no vessel is sure.
    pub is_angiography: bool,
    /// What the vessels are, for their words.
    pub kind: Kind,
    /// The smallest radius (mm) by which these vessels were found.
    pub smallest_radius: f64,
    /// What a smaller radius finds, if no vessel is sure here.
    pub below: Option<Below>,
}

/// Sure vessels that a smaller radius finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Below {
    /// That radius (mm).
    pub smallest_radius: f64,
    /// Length of the vessels (mm).
    pub length: f64,
}

impl Trees {
    /// Length of all sure vessels (mm).
    pub fn sure_length(&self) -> f64 {
        let sure = self.vessels.iter().filter(|vessel| vessel.doubt.is_none());
        sure.filter_map(|vessel| arc_lengths(&vessel.line.points).last().copied()).sum()
    }
}

/// A vessel that was found.
#[derive(Clone, Debug)]
pub struct FoundVessel {
    /// Points, radii and confidence, from the root outwards.
    pub line: Centerline,
    /// Index of the connected part to which the vessel belongs; 0 is the most important one.
    pub part: usize,
    /// Confidence that the line is a vessel, 0 to 1.
    pub confidence: f64,
    /// Reason to doubt the vessel; None if it is sure.
    pub doubt: Option<TrackDoubt>,
}

/// Why a click gives no vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoVessel {
    /// No vessel was found at the click. The value is the distance to the nearest one (mm), infinite if none exists.
    NotHere(f64),
    /// The click, or everything that it would add, lies in an existing vessel.
    Already,
}

/// Minimum confidence of a sure vessel.
pub(crate) const SURE: f64 = 0.7;

impl TrackDoubt {
    /// All reasons to doubt a vessel.
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

    /// The reason as a phrase for sentences, in the words of a kind of lumens.
    pub fn words(self, kind: Kind) -> &'static str {
        self.texts(kind)[0]
    }

    /// The reason in a word or two, for lists and counts.
    pub fn short(self, kind: Kind) -> &'static str {
        self.texts(kind)[1]
    }

    fn texts(self, kind: Kind) -> [&'static str; 2] {
        let words = kind.words();
        match self {
            Self::Scarce => words.scarce,
            Self::BrightSides => words.sides,
            Self::Flat => words.flat,
            Self::Uneven => words.uneven,
            Self::PaleAndWide => words.pale,
            Self::Short => ["it is short", "short"],
            Self::Rough => ["its width changes from place to place", "uneven width"],
            Self::Faint => ["its contrast is low", "faint"],
            Self::Open => ["few of its walls are seen", "open contour"],
            Self::Gap => ["it bridges a gap", "bridges a gap"],
        }
    }
}
