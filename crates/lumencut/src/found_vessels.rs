//! The vessels that were found in a scan, automatically or from a seed, with notes for readers.

use std::collections::BTreeMap;

use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::volume::Volume;
use lumencut_vessels::kind::{Kind, Words};
use lumencut_vessels::trace::clicks::doubts::{Doubt, Doubted};
use lumencut_vessels::trace::find::found::{FoundVessel, Trees};
use lumencut_vessels::trace::find::from_seed::find_from;
use lumencut_vessels::trace::find::{self, FindRequest, one_vessel, refusals};
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::voxels::Voxels;
use rayon::prelude::*;

use crate::text::{fixed, rounded};

/// A vessel that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundLine {
    /// Points, radii and confidence.
    pub line: Centerline,
    /// Why the vessel is doubtful; None if it is not.
    pub doubt: Option<&'static str>,
    /// Places from which a confident vessel is doubtful, as told of a traced one.
    pub(crate) places: Vec<Doubt>,
    /// Number of the connected part; part 0 is the most important one.
    pub part: usize,
}

impl FoundLine {
    /// The places from which a confident vessel is doubtful, one sentence each.
    pub fn doubts_of(&self, name: &str) -> Vec<String> {
        self.places.iter().map(|doubt| format!("{name}: {}", doubt.words)).collect()
    }
}

/// All vessels found in a scan, with notes.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundTree {
    /// Confident vessels, ordered by part, then the doubtful ones.
    pub vessels: Vec<FoundLine>,
    /// Notes about the scan, one sentence each.
    pub notes: Vec<String>,
    /// How many vessels are doubtful for each reason, one sentence each.
    pub doubts: Vec<String>,
}

/// Finds all vessels of a scan. At least one of them must be confident. Fails as [`find::find_vessels`] does, and
/// with [`lumencut_core::error::ErrorKind::Tracing`] if no vessel is confident.
pub fn find_vessels(volume: &Volume, request: &FindRequest) -> Result<FoundTree> {
    confident_tree(volume, &find::find_vessels(volume, request)?)
}

/// Describes the vessels found; at least one of them must be confident. Fails with
/// [`lumencut_core::error::ErrorKind::Tracing`] if no vessel is confident.
pub(crate) fn confident_tree(volume: &Volume, trees: &Trees) -> Result<FoundTree> {
    if trees.sure_length() > 0.0 {
        return Ok(found_in(volume, trees.clone()));
    }
    Err(refusals::no_vessel(trees))
}

/// As [`confident_tree`], but accepts a result with only doubtful vessels.
pub(crate) fn tree_with_doubtful(volume: &Volume, trees: &Trees) -> Result<FoundTree> {
    if trees.vessels.is_empty() {
        return Err(refusals::no_vessel(trees));
    }
    Ok(found_in(volume, trees.clone()))
}

/// Finds the vessels connected to the one that contains a seed (mm, LPS).
pub fn trace_from(volume: &Volume, seed: DVec3, request: &FindRequest) -> Result<FoundTree> {
    Ok(found_in(volume, find_from(volume, seed, request)?))
}

/// The vessel at a click (mm, LPS): from the nearest existing vessel (one of `beside`) to the vessel's end.
pub(crate) fn one_vessel(
    volume: &Volume,
    trees: &Trees,
    click: DVec3,
    beside: &[Centerline],
) -> Result<Centerline> {
    let voxels = Voxels::new(volume);
    if !click.is_finite() || voxels.voxel_at(click).is_none() {
        return Err(refusals::outside(click));
    }
    let side = voxels.mean_side();
    let refused = |reason| refusals::no_whole_vessel((click, voxels.shown_at(click)), trees.kind, reason);
    one_vessel::one_vessel(trees, click, side, beside).map_err(refused)
}

fn found_in(volume: &Volume, trees: Trees) -> FoundTree {
    let voxels = Voxels::new(volume);
    found(trees, &|line| Doubted { line, bridged: &[], clicks: &[] }.doubts(&voxels))
}

fn found(trees: Trees, doubts_of: &(dyn Fn(&Centerline) -> Vec<Doubt> + Sync)) -> FoundTree {
    let Trees { vessels, level, contrast, other, kind, .. } = trees;
    let (sure, doubtful): (Vec<FoundVessel>, _) =
        vessels.into_iter().partition(|vessel| vessel.doubt.is_none());
    let line = |FoundVessel { line, part, doubt, .. }: FoundVessel| {
        let places = if doubt.is_none() { doubts_of(&line) } else { Vec::new() };
        FoundLine { line, doubt: doubt.map(|doubt| doubt.words(kind)), places, part }
    };
    let vessels: Vec<FoundLine> = sure.into_par_iter().chain(doubtful).map(line).collect();
    let [level, contrast] = [level, contrast].map(about);
    let mut notes = vec![format!(
        "the lumen of the {} has about {level}; its contrast to the surroundings is {contrast}",
        kind.words().several
    )];
    notes.extend(other.map(|reading| {
        let [level, contrast] = reading.map(about);
        let (side, paler) = match kind {
            Kind::CtVessels | Kind::Vessels => ("above", "paler ones may be organs"),
            Kind::Airways | Kind::DarkLumens => ("below", "brighter ones may be tissue"),
        };
        format!("other tubes have about {level}, {contrast} {side} theirs: the {paler}")
    }));
    let doubts = doubts(&vessels, kind.words());
    FoundTree { vessels, notes, doubts }
}

fn about(value: f64) -> String {
    if value.abs() < 100.0 { rounded(value, 2) } else { fixed(value, 0) }
}

fn doubts(vessels: &[FoundLine], words: &Words) -> Vec<String> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for doubt in vessels.iter().filter_map(|vessel| vessel.doubt) {
        *counts.entry(doubt).or_default() += 1;
    }
    let mut counts: Vec<(&str, usize)> = counts.into_iter().collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let sentence = |(doubt, count): (&str, usize)| {
        format!("{count} {} doubtful: {doubt}", if count == 1 { words.one } else { words.several })
    };
    counts.into_iter().map(sentence).collect()
}

/// For each connected part, the indices of its confident vessels; the most important part comes first.
pub fn sure_parts(tree: &FoundTree) -> Vec<Vec<usize>> {
    let mut parts: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (number, vessel) in tree.vessels.iter().enumerate().filter(|(_, vessel)| vessel.doubt.is_none()) {
        parts.entry(vessel.part).or_default().push(number);
    }
    parts.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumencut_vessels::trace::find::track::TrackDoubt;

    fn vessel(part: usize, doubt: Option<TrackDoubt>) -> FoundVessel {
        let line = Centerline {
            points: vec![DVec3::ZERO, DVec3::X * (1.0 + part as f64)],
            radius: vec![1.0; 2],
            confidence: vec![0.8; 2],
        };
        FoundVessel { line, part, confidence: 0.8, doubt }
    }

    #[test]
    fn a_found_vessel_has_the_doubts_of_a_traced_one() {
        let doubt =
            Doubt { words: "Doubtful from 3 mm on.".to_owned(), kind: "turns too tightly", at: Some(3.0) };
        let vessels = vec![vessel(0, None), vessel(0, Some(TrackDoubt::Short))];
        let tree = found(Trees { vessels, ..Trees::default() }, &|_| vec![doubt.clone()]);
        assert_eq!(tree.vessels[0].doubts_of("Vessel 1"), ["Vessel 1: Doubtful from 3 mm on."]);
        assert!(tree.vessels[1].places.is_empty(), "a doubtful vessel is doubtful as a whole");
    }

    #[test]
    fn sure_vessels_come_first_and_doubts_are_counted_by_their_reasons() {
        let [short, flat] = [TrackDoubt::Short, TrackDoubt::Flat].map(Some);
        let vessels = [(0, None), (0, flat), (0, None), (1, short), (2, None), (2, short)];
        let vessels = vessels.map(|(part, doubt)| vessel(part, doubt)).to_vec();
        let tree =
            found(Trees { vessels, level: 330.4, contrast: 322.2, ..Trees::default() }, &|_| Vec::new());
        assert_eq!(sure_parts(&tree), [vec![0, 1], vec![2]]);
        let parts: Vec<usize> = tree.vessels.iter().map(|vessel| vessel.part).collect();
        assert_eq!(parts, [0, 0, 2, 0, 1, 2]);
        let short = format!("2 vessels doubtful: {}", TrackDoubt::Short.words(Kind::Vessels));
        let flat = format!("1 vessel doubtful: {}", TrackDoubt::Flat.words(Kind::Vessels));
        assert_eq!(
            tree.notes,
            ["the lumen of the vessels has about 330; its contrast to the surroundings is 322"]
        );
        assert_eq!(tree.doubts, [short, flat]);
        let other = Some([29.0, 15.2]);
        let paler =
            found(Trees { level: 129.0, contrast: 115.0, other, ..Trees::default() }, &|_| Vec::new());
        assert_eq!(
            paler.notes[1],
            "other tubes have about 29, 15 above theirs: the paler ones may be organs"
        );
        assert_eq!([about(0.0421), about(-3.44), about(1713.6)], ["0.042", "-3.4", "1714"]);
    }
}
