//! How a vessel is measured: under the point spread that its tree or the vessel itself tells.

use std::sync::OnceLock;

use super::looked::{DEFAULT_FWHM, Looked, assumed};
use super::place::known_radius;
use super::point_spread::{NARROW, SharpEdges, Told};
use super::profile::{PointSpread, Profile, Source};
use super::request::MeasureRequest;
use crate::voxels::Voxels;
use lumencut_core::error::{ErrorKind, Result};
use lumencut_core::stop::{Stop, go_on};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;

/// The distance of sections unless somebody asks for another one (mm), at most.
pub const STEP: f64 = 0.5;

/// The standard deviation of a point spread that is assumed, as a share of it.
const ASSUMED: f64 = 0.2;

/// The point spread is estimated from at most this number of vessels of a tree, the widest ones.
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
    let spread = match request.fwhm {
        None if request.tree.is_empty() => match looked.point_spread(&voxels, request.stop)? {
            Told::Width(found) => told(&found, found.on()),
            Told::Nothing(reason) => default(&voxels, reason),
        },
        // As it is given, or as the tree tells it for all that is measured in its scan.
        _ => point_spread_of(volume, request)?,
    };
    looked.profile(&voxels, vessel, request, spread)
}

/// The profile of a vessel under the point spread that [`point_spread_of`] found for its tree: the same as that of [`measure`],
/// which finds it anew.
///
/// # Errors
/// As [`measure`].
pub fn measure_under(
    spread: PointSpread,
    volume: &Volume,
    vessel: &Vessel,
    request: &MeasureRequest,
) -> Result<Profile> {
    let voxels = Voxels::new(volume);
    Looked::new(&voxels, vessel, request)?.profile(&voxels, vessel, request, spread)
}

/// The point spread of a scan (FWHM, mm), as it is given or as the widest vessels of the tree tell it, and where it is from: the
/// same for all that is measured along the tree, its vessels and paths through several of them.
///
/// # Errors
/// [`ErrorKind::Settings`] for an invalid width, [`ErrorKind::Interrupted`].
pub fn point_spread_of(volume: &Volume, request: &MeasureRequest) -> Result<PointSpread> {
    TreeMeasuring::new(volume, request)?.point_spread()
}

/// The vessels of a tree in a volume. Those that told the point spread are not looked at again where they are measured.
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

    /// The point spread, as [`point_spread_of`].
    ///
    /// # Errors
    /// [`ErrorKind::Interrupted`].
    pub fn point_spread(&self) -> Result<PointSpread> {
        match self.request.fwhm {
            Some(fwhm) => Ok(given(fwhm)),
            None => self.told_spread(),
        }
    }

    /// The profile of a vessel of the tree, by its number, under a point spread; `stop` is asked whether to stop.
    ///
    /// # Errors
    /// As [`measure`].
    pub fn profile(&self, n: usize, spread: PointSpread, stop: Stop) -> Result<Profile> {
        let request = MeasureRequest { stop, ..self.request };
        self.looked(n, &request)?.profile(&self.voxels, &request.tree[n], &request, spread)
    }

    /// The point spread that the widest vessels tell.
    fn told_spread(&self) -> Result<PointSpread> {
        let radius = |n: &usize| known_radius(&self.request.tree[*n]).unwrap_or(0.0);
        let mut order: Vec<usize> = (0..self.request.tree.len()).collect();
        order.sort_by(|a, b| radius(b).total_cmp(&radius(a)).then(a.cmp(b)));
        let mut why = NARROW;
        for n in order.into_iter().take(MOST_ASKED) {
            go_on(self.request.stop)?;
            // A vessel that cannot be measured tells nothing.
            let wide = match self.looked(n, &self.request) {
                Ok(wide) => wide,
                Err(error) if error.kind == ErrorKind::Interrupted => return Err(error),
                Err(_) => continue,
            };
            match wide.point_spread(&self.voxels, self.request.stop)? {
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

    fn looked(&self, n: usize, request: &MeasureRequest) -> Result<&Looked> {
        if let Some(looked) = self.looked[n].get() {
            return Ok(looked);
        }
        let looked = Looked::new(&self.voxels, &request.tree[n], request)?;
        Ok(self.looked[n].get_or_init(|| looked))
    }
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
