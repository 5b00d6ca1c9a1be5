//! Peak memory stays within 64 bytes per pixel and 400 per segment, without the volume. A further view
//! allocates nothing of the size of tree or volume.
#![allow(clippy::unwrap_used, unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DAffine3;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::trees::trefoil;
use lumencut_scenes::views::view;

/// Counts the bytes in use, their peak, and all bytes ever requested.
struct Counting;

static LIVE: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);
static TOTAL: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let live = LIVE.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        PEAK.fetch_max(live, Ordering::Relaxed);
        TOTAL.fetch_add(layout.size(), Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size(), Ordering::Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

// There is a single test, since the counters belong to the whole process.
#[test]
fn memory_stays_within_its_bounds() {
    let voxels = vec![100i16; 200usize.pow(3)];
    let affine = DAffine3::from_translation(glam::DVec3::splat(-99.5));
    let volume = Volume::new(Voxels::I16(&voxels), [200; 3], [1, 200, 40_000], affine).unwrap();
    let (large, small) = (view([0.3, 1.0, 0.2], [256, 256], 0.8), view([1.0, 0.0, 0.1], [32, 32], 6.0));
    // A first view starts the threads of the pool, once per process.
    let settings = Settings::default();
    let warm = Scene::default().with_tree(trefoil(9));
    CpuRenderer::default().render(&warm, &Request::new(&small, &settings)).unwrap();

    let before = LIVE.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    let tree = random_tree(41, 400, 200, 1.0, 100.0).unwrap();
    let segments = tree.segment_count();
    let (mut renderer, scene) = (CpuRenderer::default(), Scene::new(volume, tree));
    let frame = renderer.render(&scene, &Request::new(&large, &settings)).unwrap();
    let peak = PEAK.load(Ordering::Relaxed) - before;
    let allowed = 64 * 256 * 256 + 400 * segments;
    assert!(peak <= allowed, "{peak} bytes at the peak for {segments} segments, {allowed} allowed");
    drop(frame);

    let before = TOTAL.load(Ordering::Relaxed);
    renderer.render(&scene, &Request::new(&small, &settings)).unwrap();
    let further = TOTAL.load(Ordering::Relaxed) - before;
    assert!(further < 64 * 32 * 32 + 150_000, "{further} bytes for a further view of {segments} segments");
}
