//! Synthetic scenes whose true geometry is known.
//!
//! Small phantoms have closed-form answers: [`straight_tube`], [`helix`], [`y_junction`], [`crossing`], [`trefoil`],
//! [`collinear_run`], [`stenosis`], [`calcified_wall`]. [`airways`] has dark lumens with walls in lung. Three workloads have the sizes of the paper's Table 2: [`aorta`],
//! [`runoff`], [`cervical`]; their anatomy of way points and simple solids resembles CT.
//!
//! Lumen has 350 HU (−1000 in airways), vessel wall 60 HU, soft plaque 40 HU, calcification 1000 HU. Edges are ramps one voxel wide, centred on the
//! true surface. A lumen is a union of round-ended segments with linearly varying radius.

mod airways;
mod anatomy;
mod curve;
mod lesion;
mod network;
mod paint;
pub mod random;
mod shape;
mod small;
mod tissue;
mod workload;

use glam::DAffine3;
use lumencut_core::error::Result;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::{Volume, Voxels};

pub use airways::airways;
pub use lesion::{Plaque, PlaqueKind, Stenosis};
pub use small::{
    calcified_wall, collinear_run, crossing, helix, stenosis, straight_tube, trefoil, y_junction,
};
pub use workload::{AORTA, CERVICAL, RUNOFF, Workload, aorta, cervical, runoff};

/// A volume and its vessel tree, with the true geometry and lesions.
#[derive(Clone, Debug)]
pub struct Phantom {
    /// Name of the function that makes the phantom.
    pub name: &'static str,
    /// Voxels (HU), i fastest.
    pub voxels: Vec<i16>,
    /// Voxels along (i, j, k).
    pub size: [usize; 3],
    /// World position (mm, LPS) of a continuous index.
    pub world_from_index: DAffine3,
    /// The vessels with their true lumen radius (mm).
    pub tree: VesselTree,
    /// Vessel names.
    pub vessel_names: Vec<String>,
    /// Radius of the healthy lumen at each point (mm).
    pub reference_radius: Vec<Vec<f64>>,
    /// All stenoses.
    pub stenoses: Vec<Stenosis>,
    /// All plaques.
    pub plaques: Vec<Plaque>,
}

impl Phantom {
    /// The volume.
    pub fn volume(&self) -> Result<Volume<'_>> {
        let [ni, nj, _] = self.size;
        Volume::new(Voxels::I16(&self.voxels), self.size, [1, ni, ni * nj], self.world_from_index)
    }

    fn of(
        name: &'static str,
        (grid, scene): (&paint::Grid, &paint::Scene),
        vasculature: network::Vasculature,
        stop: Stop,
    ) -> Result<Self> {
        let voxels = paint::paint(grid, scene, &vasculature, stop)?;
        let vessel_names = vasculature.vessels.iter().map(|v| v.name.clone()).collect();
        let reference_radius = vasculature.vessels.iter().map(|v| v.reference.clone()).collect();
        let vessel = |v: network::KnownVessel| Vessel::new(v.points, Some(v.lumen));
        let vessels = vasculature.vessels.into_iter().map(vessel).collect::<Result<Vec<_>>>()?;
        Ok(Self {
            name,
            voxels,
            size: grid.size,
            world_from_index: grid.world_from_index(),
            tree: VesselTree::new(vessels)?,
            vessel_names,
            reference_radius,
            stenoses: vasculature.stenoses,
            plaques: vasculature.plaques,
        })
    }
}

/// Wall thickness for a healthy lumen of radius `reference` (mm).
pub fn wall_thickness(reference: f64) -> f64 {
    0.5 + 0.08 * reference
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use lumencut_core::error::ErrorKind;

    use super::*;

    type Workload = fn(u64, f64) -> Result<Phantom>;

    const WORKLOADS: [(Workload, usize); 3] = [(aorta, 800), (runoff, 2200), (cervical, 1100)];

    fn hu(phantom: &Phantom, x: f64, y: f64, z: f64) -> i16 {
        let index = phantom.world_from_index.inverse().transform_point3(DVec3::new(x, y, z)).round();
        let [i, j, k] = index.to_array().map(|n| n as usize);
        phantom.voxels[(k * phantom.size[1] + j) * phantom.size[0] + i]
    }

    #[test]
    fn lumen_and_fat_have_their_values() {
        let tube = straight_tube().unwrap();
        assert_eq!(hu(&tube, 0.0, 0.0, 0.0), 350);
        assert_eq!(hu(&tube, 3.5, 0.0, 12.0), 350);
        assert_eq!(hu(&tube, 6.0, 0.0, 12.0), -100);
        tube.volume().unwrap();
    }

    #[test]
    fn soft_plaque_fills_a_stenosis() {
        let tube = stenosis(70.0).unwrap();
        assert_eq!(hu(&tube, 0.5, 0.0, 0.0), 350);
        assert_eq!(hu(&tube, 2.5, 0.0, 0.0), 40);
        assert_eq!(hu(&tube, 2.5, 0.0, 20.0), 350);
        assert_eq!(tube.stenoses[0].percent, 70.0);
    }

    #[test]
    fn calcium_lies_on_its_side_of_the_wall() {
        let tube = calcified_wall().unwrap();
        assert_eq!(hu(&tube, 5.0, 0.0, 0.0), 1000);
        assert!(hu(&tube, -5.0, 0.0, 0.0) < 100);
        assert!(tube.plaques[0].position.distance(DVec3::X * 5.0) < 1e-9);
    }

    #[test]
    fn the_number_of_threads_changes_no_voxel() {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| cervical(4, 0.06).unwrap().voxels)
        };
        assert!(with(1) == with(3));
    }

    #[test]
    fn the_seed_changes_voxels_and_vessels() {
        let [a, b] = [1, 2].map(|seed| aorta(seed, 0.05).unwrap());
        assert!(a.voxels != b.voxels);
        assert!(a.tree != b.tree);
    }

    #[test]
    fn workloads_have_their_segments_inside_their_volume() {
        for (make, segments) in WORKLOADS {
            let phantom = make(0, 0.04).unwrap();
            let count = phantom.tree.segment_count();
            assert!(count.abs_diff(segments) * 100 <= 3 * segments, "{}: {count}", phantom.name);
            let corners = phantom.volume().unwrap().corners();
            let (low, high) = phantom.tree.bounds();
            assert!(low.cmpge(corners[0]).all() && high.cmple(corners[7]).all(), "{}", phantom.name);
            assert!(phantom.voxels.iter().all(|v| (-1024..=3071).contains(v)));
        }
    }

    #[test]
    fn a_workload_stops_where_its_caller_asks() {
        let asked = std::sync::atomic::AtomicUsize::new(0);
        let stop = || asked.fetch_add(1, std::sync::atomic::Ordering::Relaxed) >= 3;
        let error = AORTA.make(0, 0.1, &stop).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Interrupted);
        // Only slices that other threads had already started still ask whether to stop.
        assert!(asked.into_inner() < 26);
    }

    #[test]
    fn arguments_outside_their_range_are_named() {
        for scale in [0.0, -1.0, 2.1, f64::NAN] {
            assert_eq!(aorta(0, scale).unwrap_err().kind, ErrorKind::Settings);
        }
        for percent in [-0.1, 100.0, f64::NAN] {
            assert_eq!(stenosis(percent).unwrap_err().subject, "percent");
        }
    }
}
