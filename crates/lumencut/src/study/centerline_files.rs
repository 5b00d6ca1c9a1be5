//! Reads a centerline file into vessels in world space.

use crate::extent::Extent;
use crate::line_doubts::{DoubtedLine, LineDoubt, beside_doubts_of, order_doubts_of};
use crate::lumen_points::{Lines, lumen_count};
use crate::misplaced::{better_place, fits_nowhere};
use crate::placement::{Judge, Known, Origin, Placement, placement};
use crate::places::{CoordinateSystem, Statement};
use crate::reordering::{in_order, parted_doubt};
use glam::DVec3;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::Volume;
use lumencut_io::{self as centerlines, Space, Unit, junctions};
use serde::{Deserialize, Serialize};

use crate::study::failure::Result;

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "CenterlineWish"))]
pub(crate) struct AskedMessage {
    /// `lps` or `ras`.
    #[cfg_attr(test, ts(optional))]
    pub(crate) coordinates: Option<String>,
    /// `um`, `mm`, `cm`, `dm` or `m`.
    #[cfg_attr(test, ts(optional))]
    pub unit: Option<String>,
    #[cfg_attr(test, ts(optional))]
    pub(crate) reorder: Option<bool>,
}

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Asked {
    pub place: Statement,
    pub(crate) reorder: bool,
}

impl From<Statement> for Asked {
    fn from(place: Statement) -> Self {
        Self { place, reorder: false }
    }
}

impl From<AskedMessage> for Asked {
    fn from(message: AskedMessage) -> Self {
        Self { reorder: message.reorder.unwrap_or(false), place: message.statement() }
    }
}

impl AskedMessage {
    /// The requested space and unit. An unknown name is treated as no request.
    pub(crate) fn statement(self) -> Statement {
        let space = |space: &Space| Some(space.name()) == self.coordinates.as_deref();
        let unit = |unit: &Unit| Some(unit.name()) == self.unit.as_deref();
        Statement { space: Space::ALL.into_iter().find(space), unit: Unit::ALL.into_iter().find(unit) }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct PlacedVessels {
    pub tree: VesselTree,
    /// A name for each vessel; may be empty.
    pub names: Vec<String>,
    pub(crate) notes: Vec<String>,
    /// Whether points seem to be in the wrong order, and can be sorted.
    pub(crate) can_reorder: bool,
    /// Evidence against the space or unit in which the file was read.
    pub(crate) doubt: Option<PlaceDoubt>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct PlaceDoubt {
    /// The finding, in words.
    pub found: String,
    /// Other spaces and units that fit, such as `lps in cm`; may be empty.
    pub(crate) readings: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct OpenedLines {
    pub(crate) notes: Vec<String>,
    /// Evidence against the space or unit in which the file was read.
    pub(crate) doubt: Option<PlaceDoubt>,
}

/// Reads the vessels of the file `name`. The volume decides about space and unit if neither the caller nor the file states them.
pub(crate) fn read_centerlines(
    bytes: &[u8],
    name: &str,
    asked: Asked,
    volume: Option<&Volume>,
) -> Result<PlacedVessels> {
    let lines = centerlines::read(bytes, name)?;
    let known = Known {
        asked_space: asked.place.space,
        asked_unit: asked.place.unit,
        stated_space: lines.space,
        stated_unit: lines.unit,
        usual_unit: lines.conventional_unit.unwrap_or(Unit::Millimetre),
    };
    let points: Vec<DVec3> = lines.lines.iter().flat_map(|line| &line.points).copied().collect();
    let unknown = |line: &centerlines::Line| vec![f64::NAN; line.points.len()];
    let radii: Vec<f64> =
        lines.lines.iter().flat_map(|line| line.radius.clone().unwrap_or_else(|| unknown(line))).collect();
    let of_lines = Lines { points: &points, radii: &radii };
    let lumen = |place| volume.map_or_else(Default::default, |volume| lumen_count(volume, &of_lines, place));
    let judge = volume.map(|volume| Judge { extent: Extent::from(volume), lumen: &lumen });
    let found = placement(&known, &points, judge.as_ref()).map_err(|error| error.in_file(name))?;
    let mm = found.place.unit.in_mm();
    let mut doubts = if asked.reorder { Vec::new() } else { Vec::from_iter(parted_doubt(&lines)) };
    let ordered = |lines| if asked.reorder { in_order(lines) } else { Ok(lines) };
    let placed = lines.scaled(mm).and_then(ordered).map(junctions::vessels);
    let placed = placed.map_err(|error| error.in_file(name))?;
    let signs = found.place.scale() / mm;
    let vessel = |line: &centerlines::Line| {
        Vessel::new(line.points.iter().map(|p| *p * signs).collect(), line.radius.clone())
    };
    let vessels = placed.lines.iter().map(vessel).collect::<lumencut_core::error::Result<Vec<_>>>()?;
    let names: Vec<String> = placed.lines.iter().map(|line| line.name.clone().unwrap_or_default()).collect();
    doubts.extend(doubts_of(&vessels, &names));
    let tree = VesselTree::new(vessels)?;
    let mut notes = placed.notes;
    notes.extend(Some(found.decision.clone()).filter(|decision| !decision.is_empty()));
    let beside = volume.and_then(|volume| doubt_beside(&tree, volume, &found));
    let doubt = doubt_of_unit(&found).or(beside);
    notes.extend(doubt.iter().map(|doubt| doubt.found.clone()).filter(|words| *words != found.decision));
    notes.extend(doubts.iter().map(LineDoubt::words));
    let can_reorder = doubts.iter().any(|doubt| doubt.mend.is_some());
    Ok(PlacedVessels { tree, names, notes, doubt, can_reorder })
}

fn doubts_of(vessels: &[Vessel], names: &[String]) -> Vec<LineDoubt> {
    let pairs = vessels.iter().zip(names);
    let looked_at: Vec<DoubtedLine> =
        pairs.map(|(one, name)| DoubtedLine { points: one.points(), radius: one.radius(), name }).collect();
    let mut doubts = order_doubts_of(&looked_at);
    doubts.extend(beside_doubts_of(&looked_at));
    doubts
}

/// A doubt about the unit, if there is evidence against it or other units fit too.
fn doubt_of_unit(found: &Placement) -> Option<PlaceDoubt> {
    let of = |units: &[Unit]| {
        units.iter().map(|unit| CoordinateSystem { unit: *unit, ..found.place }.to_string()).collect()
    };
    if let Some(doubt) = &found.doubt {
        return Some(PlaceDoubt { found: doubt.found.clone(), readings: of(&doubt.units) });
    }
    let also = of(&found.also);
    (!found.also.is_empty()).then(|| PlaceDoubt { found: found.decision.clone(), readings: also })
}

/// A doubt if vessels lie outside the volume, or fit better in another space or unit that the caller neither chose nor was told.
fn doubt_beside(tree: &VesselTree, volume: &Volume, read: &Placement) -> Option<PlaceDoubt> {
    let points: Vec<DVec3> = tree.vessels().iter().flat_map(|vessel| vessel.points()).copied().collect();
    let radius =
        |vessel: &Vessel| (0..vessel.points().len()).map(|i| vessel.radius_or_zero(i)).collect::<Vec<_>>();
    let radii: Vec<f64> = tree.vessels().iter().flat_map(radius).collect();
    let lines = Lines { points: &points, radii: &radii };
    let lumen = |place| lumen_count(volume, &lines, place);
    let judge = Judge { extent: Extent::from(volume), lumen: &lumen };
    if fits_nowhere(&points, &judge.extent) {
        let found = "no point lies inside the volume; perhaps the centerlines are of another scan".to_owned();
        return Some(PlaceDoubt { found, readings: Vec::new() });
    }
    let is_told = read.is_unusual || read.space_from == Origin::Asked;
    let better = better_place(&points, &judge).filter(|_| !is_told)?;
    // `better` assumes that points were read as LPS. If they were read as RAS, the other space is meant.
    let space = if better.meant.space == read.place.space { Space::Lps } else { Space::Ras };
    let is_in_mm = read.place.unit == Unit::Millimetre;
    let meant = CoordinateSystem { space, ..better.meant };
    Some(PlaceDoubt {
        found: better.found,
        readings: is_in_mm.then(|| meant.to_string()).into_iter().collect(),
    })
}
