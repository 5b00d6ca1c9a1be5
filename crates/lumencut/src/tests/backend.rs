use std::pin::pin;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::task::{Poll, Waker};

use glam::{DAffine3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::reformations::cr::CrParameters;
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::{Volume, Voxels};

use super::*;

fn at_once<T>(work: impl Future<Output = T>) -> T {
    match pin!(work).poll(&mut std::task::Context::from_waker(Waker::noop())) {
        Poll::Ready(done) => done,
        Poll::Pending => panic!("the CPU waits for nothing"),
    }
}

#[test]
fn an_interrupted_picture_leaves_the_reason_of_the_fall_back_to_the_next() {
    let voxels: Vec<i16> = (0..512).collect();
    let volume = Volume::new(Voxels::I16(&voxels), [8; 3], [1, 8, 64], DAffine3::IDENTITY).unwrap();
    let camera = Camera::new(DVec3::splat(3.5), DVec3::Y, DVec3::Z, [9, 8], 1.0).unwrap();
    let settings = Settings { samples: 2, ..Settings::default() };
    let reason = Error::new(ErrorKind::Device, "device", "too little memory", "more");
    let (asked, allowed) = (AtomicUsize::new(0), AtomicUsize::new(usize::MAX));
    let stop = || asked.fetch_add(1, Ordering::Relaxed) >= allowed.load(Ordering::Relaxed);
    let request = Request { stop: &stop, ..Request::new(&camera, &settings) };
    let render = |limit| {
        let scene = Scene::default().with_volume(volume);
        let computer = Computer::Cpu(CpuRenderer::default());
        let mut backend = Backend { computer, unreported: Some(reason.clone()) };
        asked.store(0, Ordering::Relaxed);
        allowed.store(limit, Ordering::Relaxed);
        let first = at_once(backend.render(&scene, &request)).map(|(_, described)| described);
        let checks = asked.load(Ordering::Relaxed);
        allowed.store(usize::MAX, Ordering::Relaxed);
        let (frame, described) = at_once(backend.render(&scene, &request)).unwrap();
        assert!(!frame.image.is_empty());
        (first, described, checks)
    };
    let (first, second, checks) = render(usize::MAX);
    assert_eq!((first, second), (Ok(Some(reason.clone())), None));
    // The first of five pictures asks at least once whether to stop, and so does every sample.
    assert!(checks >= 5, "{checks}");
    for limit in 0..checks {
        let (first, second, _) = render(limit);
        assert_eq!(first.unwrap_err().kind, ErrorKind::Interrupted, "{limit} of {checks}");
        assert_eq!(second, Some(reason.clone()), "{limit} of {checks}");
    }
}

#[test]
fn reformations_need_a_tree_and_a_cut_surface_does_not() {
    let voxels: Vec<i16> = (0..512).collect();
    let volume = Volume::new(Voxels::I16(&voxels), [8; 3], [1, 8, 64], DAffine3::IDENTITY).unwrap();
    let camera = Camera::new(DVec3::splat(3.5), DVec3::Y, DVec3::Z, [9, 8], 1.0).unwrap();
    let settings = Settings::default();
    let request = Request::new(&camera, &settings);
    let alone = Scene::default().with_volume(volume);
    let line = Vessel::new(vec![DVec3::new(2.0, 3.0, 0.0), DVec3::new(5.0, 4.0, 7.0)], None).unwrap();
    let whole = alone.clone().with_tree(VesselTree::new(vec![line]).unwrap());
    for method in [Method::MpCpr, Method::Cr(CrParameters::default())] {
        let mut backend = Backend { computer: Computer::Cpu(CpuRenderer::default()), unreported: None };
        let refused = at_once(backend.render_by(method, &alone, &request)).map(|_| ()).unwrap_err();
        assert_eq!(refused.kind, ErrorKind::VesselTree);
        let (frame, described) = at_once(backend.render_by(method, &whole, &request)).unwrap();
        assert_eq!((frame.image.len(), frame.vessel.len(), described), (72, 72, None));
        // Only mpCPR marks folded pixels.
        assert_eq!(frame.folded.len(), if method == Method::MpCpr { 72 } else { 0 });
    }
}
