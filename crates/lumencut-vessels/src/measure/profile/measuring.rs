//! Entry points of measuring: for a single vessel, or for a tree with a common point spread and wall level.

use std::cmp::Ordering;
use std::sync::OnceLock;

use glam::DVec3;
use rayon::prelude::*;

use super::prepared::PreparedVessel;
use super::request::MeasureRequest;
use super::{PointSpread, Profile, Source, TreeFindings};
use crate::measure::along::assumed_spread::AssumedSpread;
use crate::measure::along::point_spread::{SharpEdges, SpreadEstimate, TOO_NARROW, TOO_SHARP};
use crate::measure::section::known_radius;
use crate::measure::wall::WallRequest;
use crate::measure::wall::tree::VesselWall;
use crate::voxels::Voxels;
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::stop::{Stop, go_on};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;

/// Default maximum distance between sections (mm).
pub const STEP: f64 = 0.5;

/// Maximum number of vessels from which point spread and wall level are estimated; the widest ones are used.
const MAX_CONTRIBUTING: usize = 8;

/// Measures the profile of a vessel. Errors: [`ErrorKind::Measuring`] for a vessel outside the volume or
/// without a lumen, [`ErrorKind::Settings`] for an invalid step or point spread, [`ErrorKind::VesselTree`]
/// for a vessel without length, [`ErrorKind::Interrupted`].
pub fn measure(volume: &Volume, vessel: &Vessel, request: &MeasureRequest) -> Result<Profile> {
    request.check()?;
    let voxels = Voxels::new(volume);
    let prepared = PreparedVessel::new(&voxels, vessel, request)?;
    let found = match request.fwhm {
        None if request.tree.is_empty() => {
            TreeFindings { spread: own_spread(&prepared, &voxels, request.stop)?, walls: Vec::new() }
        }
        _ => tree_findings(volume, request)?,
    };
    prepared.profile(&voxels, vessel, request, found)
}

pub(super) fn own_spread(prepared: &PreparedVessel, voxels: &Voxels, stop: Stop) -> Result<PointSpread> {
    Ok(match prepared.point_spread(voxels, stop)? {
        SpreadEstimate::Width(found) => spread_of(&found, found.on()),
        SpreadEstimate::Nothing(reason) => assumed(voxels, prepared.assumed, reason),
    })
}

/// Like [`measure`], but uses an existing result of [`tree_findings`]. Errors: those of [`measure`].
pub fn measure_with(
    findings: TreeFindings,
    volume: &Volume,
    vessel: &Vessel,
    request: &MeasureRequest,
) -> Result<Profile> {
    let voxels = Voxels::new(volume);
    PreparedVessel::new(&voxels, vessel, request)?.profile(&voxels, vessel, request, findings)
}

/// Estimates the point spread (unless it is given) and the wall levels from the widest vessels of a tree.
/// Errors: [`ErrorKind::Settings`] for an invalid width, [`ErrorKind::Interrupted`].
pub fn tree_findings(volume: &Volume, request: &MeasureRequest) -> Result<TreeFindings> {
    TreeMeasuring::new(volume, request)?.findings(request.stop)
}

/// The vessels of a tree in a volume; intermediate results are cached.
pub struct TreeMeasuring<'a, 'v> {
    voxels: Voxels<'v>,
    request: MeasureRequest<'a>,
    prepared: Vec<OnceLock<PreparedVessel>>,
}

impl<'a, 'v> TreeMeasuring<'a, 'v> {
    /// Prepares the vessels. Errors: [`ErrorKind::Settings`] for an invalid point spread or wall.
    pub fn new(volume: &Volume<'v>, request: &MeasureRequest<'a>) -> Result<Self> {
        request.check()?;
        let prepared = request.tree.iter().map(|_| OnceLock::new()).collect();
        Ok(Self { voxels: Voxels::new(volume), request: *request, prepared })
    }

    /// Point spread and wall levels of the tree; see [`tree_findings`].
    pub fn findings(&self, stop: Stop) -> Result<TreeFindings> {
        let request = MeasureRequest { stop, ..self.request };
        let spread = match request.fwhm {
            Some(fwhm) => given(fwhm),
            None => self.estimated_spread(&request)?,
        };
        let walls = self.wall_levels(spread.fwhm, &request)?;
        Ok(TreeFindings { spread, walls })
    }

    /// Measures vessel number `n` of the tree. Errors: those of [`measure`].
    pub fn profile(&self, n: usize, findings: TreeFindings, stop: Stop) -> Result<Profile> {
        let request = MeasureRequest { stop, ..self.request };
        self.prepared(n, &request)?.profile(&self.voxels, &request.tree[n], &request, findings)
    }

    /// Indices of the widest vessels; their order in the tree does not matter.
    fn widest_vessels(&self) -> Vec<usize> {
        let tree = self.request.tree;
        let mut order: Vec<usize> = (0..tree.len()).collect();
        order.sort_by(|a, b| wider(&tree[*a], &tree[*b]).then(a.cmp(b)));
        order.truncate(MAX_CONTRIBUTING);
        order
    }

    /// Wall levels of the widest vessels for a point spread (FWHM, mm); empty if there is only one vessel.
    fn wall_levels(&self, fwhm: f64, request: &MeasureRequest) -> Result<Vec<VesselWall>> {
        if request.tree.len() < 2 || request.wall == WallRequest::Off {
            return Ok(Vec::new());
        }
        let wall = |n: usize| -> Result<Option<VesselWall>> {
            let Some(prepared) = self.prepared_or_none(n, request)? else { return Ok(None) };
            let level = prepared.wall_level(&self.voxels, fwhm, request.stop)?;
            Ok(level.map(|level| VesselWall { vessel: n, level }))
        };
        let found: Vec<Option<VesselWall>> =
            self.widest_vessels().into_par_iter().map(wall).collect::<Result<_>>()?;
        Ok(found.into_iter().flatten().collect())
    }

    fn estimated_spread(&self, request: &MeasureRequest) -> Result<PointSpread> {
        let mut why = TOO_NARROW;
        for n in self.widest_vessels() {
            go_on(request.stop)?;
            let Some(wide) = self.prepared_or_none(n, request)? else { continue };
            match wide.point_spread(&self.voxels, request.stop)? {
                SpreadEstimate::Width(found) => {
                    // Neither numbers nor names are the same in all hosts.
                    let length = request.tree[n].arc_length().last().copied().unwrap_or(0.0);
                    let on = format!("{} of the vessel of {length:.0} mm", found.on());
                    return Ok(spread_of(&found, on));
                }
                SpreadEstimate::Nothing(TOO_NARROW) => {}
                SpreadEstimate::Nothing(reason) => why = reason,
            }
        }
        let widest = self.widest_vessels().into_iter().find_map(|n| self.prepared[n].get());
        let assumed = widest.map_or_else(
            || AssumedSpread::of_voxels(self.voxels.world_from_index.matrix3),
            |one| one.assumed,
        );
        Ok(self::assumed(&self.voxels, assumed, why))
    }

    fn prepared_or_none(&self, n: usize, request: &MeasureRequest) -> Result<Option<&PreparedVessel>> {
        match self.prepared(n, request) {
            Ok(prepared) => Ok(Some(prepared)),
            Err(error) if error.kind == ErrorKind::Interrupted => Err(error),
            Err(_) => Ok(None),
        }
    }

    fn prepared(&self, n: usize, request: &MeasureRequest) -> Result<&PreparedVessel> {
        if let Some(prepared) = self.prepared[n].get() {
            return Ok(prepared);
        }
        let prepared = PreparedVessel::new(&self.voxels, &request.tree[n], request)?;
        Ok(self.prepared[n].get_or_init(|| prepared))
    }
}

/// Sorts vessels: wider ones first, then longer ones, then by coordinates.
fn wider(one: &Vessel, other: &Vessel) -> Ordering {
    let radius = |vessel: &Vessel| known_radius(vessel).unwrap_or(0.0);
    let length = |vessel: &Vessel| vessel.arc_length().last().copied().unwrap_or(0.0);
    let points = |vessel: &Vessel| vessel.points().iter().map(DVec3::to_array).collect::<Vec<_>>();
    let by_width = radius(other).total_cmp(&radius(one));
    let by_length = || length(other).total_cmp(&length(one));
    by_width
        .then_with(by_length)
        .then_with(|| points(one).partial_cmp(&points(other)).unwrap_or(Ordering::Equal))
}

fn given(fwhm: f64) -> PointSpread {
    PointSpread { fwhm, deviation: 0.0, source: Source::Given, without_wall: None }
}

fn spread_of(found: &SharpEdges, on: String) -> PointSpread {
    let source = Source::Estimated { on };
    PointSpread { fwhm: found.fwhm, deviation: found.deviation, source, without_wall: found.without_wall }
}

fn assumed(voxels: &Voxels, usual: AssumedSpread, reason: &str) -> PointSpread {
    let by_voxels = || AssumedSpread::of_voxels(voxels.world_from_index.matrix3);
    let spread = if reason == TOO_SHARP { by_voxels() } else { usual };
    let [fwhm, deviation] = spread.fwhm;
    let source = Source::Assumed { from: format!("{}, as {reason}", spread.from()) };
    PointSpread { fwhm, deviation, source, without_wall: None }
}
