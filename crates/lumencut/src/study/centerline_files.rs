//! A file of centerlines becomes vessels in world space.

use crate::extent::Extent;
use crate::line_doubts::{DoubtedLine, LineDoubt, beside_doubts_of, order_doubts_of};
use crate::lumen_points::{Lines, lumen_count};
use crate::placement::{Judge, Known, placement};
use crate::places::Statement;
use crate::reordering::{in_order, parted_doubt};
use glam::DVec3;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::Volume;
use lumencut_io::{self as centerlines, Space, Unit, junctions};
use serde::Deserialize;

use crate::study::failure::Result;

/// In which space and unit centerlines are to be read, by names; what is left out is not asked for.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "CenterlineWish"))]
pub struct AskedMessage {
    /// `lps` or `ras`.
    #[cfg_attr(test, ts(optional))]
    pub coordinates: Option<String>,
    /// `um`, `mm`, `cm`, `dm` or `m`.
    #[cfg_attr(test, ts(optional))]
    pub unit: Option<String>,
    /// Whether the points of each line are put into their order.
    #[cfg_attr(test, ts(optional))]
    pub reorder: Option<bool>,
}

/// How centerlines are to be read.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked {
    /// Their space and unit.
    pub place: Statement,
    /// Whether the points of each line are put into their order.
    pub reorder: bool,
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
    /// What it asks for; other names ask for nothing.
    pub fn statement(self) -> Statement {
        let space = |space: &Space| Some(space.name()) == self.coordinates.as_deref();
        let unit = |unit: &Unit| Some(unit.name()) == self.unit.as_deref();
        Statement { space: Space::ALL.into_iter().find(space), unit: Unit::ALL.into_iter().find(unit) }
    }
}

/// Vessels, their names, and what was odd about their file.
#[derive(Clone, Debug)]
pub struct PlacedVessels {
    /// The vessels in world space.
    pub tree: VesselTree,
    /// The name of each vessel; empty where the file has none.
    pub names: Vec<String>,
    /// One sentence each.
    pub notes: Vec<String>,
    /// Whether points are in another order, and may be put in order.
    pub can_reorder: bool,
}

/// The vessels of the file `name` in world space, read in the space and unit that are asked for; what neither the file nor the
/// caller states of them the volume decides.
///
/// # Errors
/// `format` for a file that is damaged or holds no centerlines, and where nothing tells where they lie.
pub fn read_centerlines(
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
    let mut notes = placed.notes.clone();
    notes.extend((!found.decision.is_empty()).then_some(found.decision));
    let names: Vec<String> = placed.lines.iter().map(|line| line.name.clone().unwrap_or_default()).collect();
    doubts.extend(doubts_of(&vessels, &names));
    notes.extend(doubts.iter().map(LineDoubt::words));
    let can_reorder = doubts.iter().any(|doubt| doubt.mend.is_some());
    Ok(PlacedVessels { tree: VesselTree::new(vessels)?, names, notes, can_reorder })
}

/// What is doubtful about vessels of a file.
fn doubts_of(vessels: &[Vessel], names: &[String]) -> Vec<LineDoubt> {
    let pairs = vessels.iter().zip(names);
    let looked_at: Vec<DoubtedLine> =
        pairs.map(|(one, name)| DoubtedLine { points: one.points(), radius: one.radius(), name }).collect();
    let mut doubts = order_doubts_of(&looked_at);
    doubts.extend(beside_doubts_of(&looked_at));
    doubts
}
