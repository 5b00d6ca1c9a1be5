//! Tests that profiles are measured once and then cached.

use lumencut_core::error::ErrorKind;
use lumencut_core::volume::Voxels;
use lumencut_phantom::Phantom;
use lumencut_vessels::measure::profile::Source;
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::wall::{WallRequest, WallSource};

use super::*;

fn with_junction(look: impl FnOnce(Scan)) {
    let Phantom { voxels, size, world_from_index, tree, .. } =
        lumencut_phantom::y_junction().expect("a phantom");
    let strides = [1, size[0], size[0] * size[1]];
    let volume = Volume::new(Voxels::I16(&voxels), size, strides, world_from_index).expect("a volume");
    look(Scan { volume: &volume, tree: tree.vessels() });
}

fn parameters<'a>(fwhm: Option<f64>, stop: Stop<'a>) -> MeasureParameters<'a> {
    MeasureParameters { step: 3.0, fwhm, wall: WallRequest::Automatic, stop }
}

#[test]
fn a_profile_is_measured_once() {
    with_junction(|scan| {
        let mut kept = KeptProfiles::default();
        let vessel = &scan.tree[1];
        let go_on = || false;
        let first = kept.of(1, vessel, scan, &parameters(None, &go_on)).expect("a profile");
        let never = || true;
        assert_eq!(kept.of(1, vessel, scan, &parameters(None, &never)).expect("what was kept"), first);
        let request = MeasureRequest {
            step: 3.0,
            fwhm: None,
            wall: WallRequest::Automatic,
            tree: scan.tree,
            stop: &go_on,
        };
        let anew = measure(scan.volume, vessel, &request).expect("a profile");
        let found = kept.kept(first);
        assert_eq!((found.fwhm, &found.area), (anew.fwhm, &anew.area));
    });
}

#[test]
fn what_is_asked_for_in_another_way_is_measured_anew() {
    with_junction(|scan| {
        let mut kept = KeptProfiles::default();
        let go_on = || false;
        kept.of(0, &scan.tree[0], scan, &parameters(None, &go_on)).expect("a profile");
        let never = || true;
        let finer = MeasureParameters { step: 2.0, ..parameters(None, &never) };
        let without_wall = MeasureParameters { wall: WallRequest::Off, ..parameters(None, &never) };
        for parameters in [finer, without_wall, parameters(Some(1.0), &never)] {
            let error = kept.of(0, &scan.tree[0], scan, &parameters).expect_err("it was stopped");
            assert_eq!(error.kind, ErrorKind::Interrupted);
        }
        let without_wall = MeasureParameters { wall: WallRequest::Off, ..parameters(None, &go_on) };
        let estimates = kept.of(0, &scan.tree[0], scan, &without_wall).expect("a profile");
        assert_eq!(kept.kept(estimates).wall_source, WallSource::NotAsked);
        let given = kept.of(0, &scan.tree[0], scan, &parameters(Some(1.0), &go_on)).expect("a profile");
        assert_eq!((kept.kept(given).fwhm, &kept.kept(given).fwhm_source), (1.0, &Source::Given));
    });
}

#[test]
fn all_vessels_of_a_scan_have_one_point_spread() {
    with_junction(|scan| {
        let mut kept = KeptProfiles::default();
        let go_on = || false;
        let mut spread = |number: usize| {
            let found =
                kept.of(number, &scan.tree[number], scan, &parameters(None, &go_on)).expect("a profile");
            (kept.kept(found).fwhm, kept.kept(found).fwhm_source.clone())
        };
        assert_eq!(spread(0), spread(1));
    });
}
