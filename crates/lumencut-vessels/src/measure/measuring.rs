//! How a vessel is measured: with what its tree tells of the point spread and of walls, or the vessel itself.

use std::cmp::Ordering;
use std::sync::OnceLock;

use glam::DVec3;
use rayon::prelude::*;

use super::looked::{DEFAULT_FWHM, Looked, assumed};
use super::place::known_radius;
use super::point_spread::{NARROW, SharpEdges, Told};
use super::profile::{PointSpread, Profile, Source};
use super::request::MeasureRequest;
use super::told_by_tree::ToldByTree;
use super::tree_walls::ToldWall;
use super::wall_level::WallRequest;
use crate::voxels::Voxels;
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::stop::{Stop, go_on};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;

/// The distance of sections unless somebody asks for another one (mm), at most.
pub const STEP: f64 = 0.5;

/// The standard deviation of a point spread that is assumed, as a share of it.
const ASSUMED: f64 = 0.2;

/// The point spread and the level of walls are told by at most this number of vessels of a tree, the widest ones.
const MOST_ASKED: usize = 8;

/// The profile of a vessel.
///
/// # Errors
/// [`ErrorKind::Measuring`] for a vessel outside the volume or without a lumen, [`ErrorKind::Settings`] for a step or a width of
/// the point spread that is invalid, [`ErrorKind::VesselTree`] for a vessel without length, [`ErrorKind::Interrupted`].
pub fn measure(volume: &Volume, vessel: &Vessel, request: &MeasureRequest) -> Result<Profile> {
    request.check()?;
    let voxels = Voxels::new(volume);
    let looked = Looked::new(&voxels, vessel, request)?;
    let found = match request.fwhm {
        None if request.tree.is_empty() => {
            let spread = match looked.point_spread(&voxels, request.stop)? {
                Told::Width(found) => told(&found, found.on()),
                Told::Nothing(reason) => default(&voxels, reason),
            };
            ToldByTree { spread, walls: Vec::new() }
        }
        // As it is given, or as the tree tells it for all that is measured in its scan.
        _ => told_by_tree(volume, request)?,
    };
    looked.profile(&voxels, vessel, request, found)
}

/// The profile of a vessel with what [`told_by_tree`] found for its tree: the same as that of [`measure`], which finds it anew.
///
/// # Errors
/// As [`measure`].
pub fn measure_under(
    told: ToldByTree,
    volume: &Volume,
    vessel: &Vessel,
    request: &MeasureRequest,
) -> Result<Profile> {
    let voxels = Voxels::new(volume);
    Looked::new(&voxels, vessel, request)?.profile(&voxels, vessel, request, told)
}

/// What a tree tells of all that is measured along it, its vessels and paths through several of them: the point spread of the scan,
/// as it is given or as the widest vessels tell it, and what these tell of the level of walls.
///
/// # Errors
/// [`ErrorKind::Settings`] for an invalid width, [`ErrorKind::Interrupted`].
pub fn told_by_tree(volume: &Volume, request: &MeasureRequest) -> Result<ToldByTree> {
    TreeMeasuring::new(volume, request)?.told(request.stop)
}

/// The vessels of a tree in a volume. Those that told something are not looked at again where they are measured.
pub struct TreeMeasuring<'a, 'v> {
    voxels: Voxels<'v>,
    request: MeasureRequest<'a>,
    looked: Vec<OnceLock<Looked>>,
}

impl<'a, 'v> TreeMeasuring<'a, 'v> {
    /// The vessels of the tree that is asked for.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] for a point spread or a wall that is invalid.
    pub fn new(volume: &Volume<'v>, request: &MeasureRequest<'a>) -> Result<Self> {
        request.check()?;
        let looked = request.tree.iter().map(|_| OnceLock::new()).collect();
        Ok(Self { voxels: Voxels::new(volume), request: *request, looked })
    }

    /// What the tree tells, as [`told_by_tree`]; `stop` is asked whether to stop.
    ///
    /// # Errors
    /// [`ErrorKind::Interrupted`].
    pub fn told(&self, stop: Stop) -> Result<ToldByTree> {
        let request = MeasureRequest { stop, ..self.request };
        let spread = match request.fwhm {
            Some(fwhm) => given(fwhm),
            None => self.told_spread(&request)?,
        };
        let walls = self.told_walls(spread.fwhm, &request)?;
        Ok(ToldByTree { spread, walls })
    }

    /// The profile of a vessel of the tree, by its number, with what the tree told; `stop` is asked whether to stop.
    ///
    /// # Errors
    /// As [`measure`].
    pub fn profile(&self, n: usize, told: ToldByTree, stop: Stop) -> Result<Profile> {
        let request = MeasureRequest { stop, ..self.request };
        self.looked(n, &request)?.profile(&self.voxels, &request.tree[n], &request, told)
    }

    /// The numbers of the vessels that are asked, from the widest on, whatever their order in the tree.
    fn asked(&self) -> Vec<usize> {
        let tree = self.request.tree;
        let mut order: Vec<usize> = (0..tree.len()).collect();
        order.sort_by(|a, b| wider(&tree[*a], &tree[*b]).then(a.cmp(b)));
        order.truncate(MOST_ASKED);
        order
    }

    /// What the widest vessels tell of the level of their walls under a point spread (FWHM, mm). One vessel alone tells nobody.
    fn told_walls(&self, fwhm: f64, request: &MeasureRequest) -> Result<Vec<ToldWall>> {
        if request.tree.len() < 2 || request.wall == WallRequest::Off {
            return Ok(Vec::new());
        }
        let wall = |n: usize| -> Result<Option<ToldWall>> {
            let Some(looked) = self.looked_or_none(n, request)? else { return Ok(None) };
            let level = looked.wall_level(&self.voxels, fwhm, request.stop)?;
            Ok(level.map(|level| ToldWall { vessel: n, level }))
        };
        let found: Vec<Option<ToldWall>> = self.asked().into_par_iter().map(wall).collect::<Result<_>>()?;
        Ok(found.into_iter().flatten().collect())
    }

    /// The point spread that the widest vessels tell.
    fn told_spread(&self, request: &MeasureRequest) -> Result<PointSpread> {
        let mut why = NARROW;
        for n in self.asked() {
            go_on(request.stop)?;
            let Some(wide) = self.looked_or_none(n, request)? else { continue };
            match wide.point_spread(&self.voxels, request.stop)? {
                Told::Width(found) => {
                    let on = format!("{} of vessel {n} of the tree", found.on());
                    return Ok(told(&found, on));
                }
                Told::Nothing(NARROW) => {}
                Told::Nothing(reason) => why = reason,
            }
        }
        Ok(default(&self.voxels, why))
    }

    /// A vessel that was looked at, or none where it cannot be measured: it tells nothing.
    fn looked_or_none(&self, n: usize, request: &MeasureRequest) -> Result<Option<&Looked>> {
        match self.looked(n, request) {
            Ok(looked) => Ok(Some(looked)),
            Err(error) if error.kind == ErrorKind::Interrupted => Err(error),
            Err(_) => Ok(None),
        }
    }

    fn looked(&self, n: usize, request: &MeasureRequest) -> Result<&Looked> {
        if let Some(looked) = self.looked[n].get() {
            return Ok(looked);
        }
        let looked = Looked::new(&self.voxels, &request.tree[n], request)?;
        Ok(self.looked[n].get_or_init(|| looked))
    }
}

/// Which of two vessels comes first: the wider one, else the longer one, else the one whose points are first.
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
    PointSpread { fwhm, deviation: 0.0, source: Source::Given }
}

fn told(found: &SharpEdges, on: String) -> PointSpread {
    PointSpread { fwhm: found.fwhm, deviation: found.deviation, source: Source::Estimated { on } }
}

fn default(voxels: &Voxels, reason: &str) -> PointSpread {
    let from = format!("{DEFAULT_FWHM} sides of a voxel, as {reason}");
    let fwhm = assumed(voxels);
    PointSpread { fwhm, deviation: ASSUMED * fwhm, source: Source::Assumed { from } }
}
