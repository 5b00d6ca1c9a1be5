//! Synthetic scans and tracks for tests.

use glam::{DAffine3, DVec3};

use crate::trace::find::scan::Scan;
use crate::trace::find::track::{Track, TrackPoint};
use crate::voxels::Voxels;
use lumencut_core::volume::{self, Volume};

pub const LEVEL: f64 = 300.0;
pub const TISSUE: f64 = 50.0;

/// Runs `work` on a scan whose values are given by position (mm).
pub fn with_scan<T>(
    size: [usize; 3],
    side: f64,
    value: impl Fn(DVec3) -> f64,
    work: impl FnOnce(&Scan) -> T,
) -> T {
    let place = |n: usize| {
        let index = [n % size[0], n / size[0] % size[1], n / (size[0] * size[1])];
        side * DVec3::from_array(index.map(|i| i as f64))
    };
    let values: Vec<f32> = (0..size.iter().product()).map(|n| value(place(n)) as f32).collect();
    let strides = [1, size[0], size[0] * size[1]];
    let world = DAffine3::from_scale(DVec3::splat(side));
    let volume = Volume::new(volume::Voxels::F32(&values), size, strides, world).expect("a volume");
    let voxels = Voxels::new(&volume);
    let contrast = LEVEL - TISSUE;
    work(&Scan {
        voxels: &voxels,
        side,
        lowest: 0.0,
        level: LEVEL,
        contrast,
        noise: 5.0,
        is_hounsfield: false,
    })
}

/// Value at `depth` mm below a surface whose edge is blurred over 1 mm.
pub fn blurred(depth: f64) -> f64 {
    TISSUE + (LEVEL - TISSUE) * (depth + 0.5).clamp(0.0, 1.0)
}

/// Distance of a position from a polyline (mm).
pub fn away(place: DVec3, line: &[DVec3]) -> f64 {
    let from_segment = |pair: &[DVec3]| {
        let way = pair[1] - pair[0];
        let share = ((place - pair[0]).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        place.distance(pair[0] + share * way)
    };
    line.windows(2).map(from_segment).fold(f64::MAX, f64::min)
}

/// A straight track with points every 0.5 mm.
pub(crate) fn straight_track(from: DVec3, to: DVec3, radius: f64) -> Track {
    let count = (2.0 * from.distance(to)).round();
    let point = |n: usize| TrackPoint {
        place: from.lerp(to, n as f64 / count),
        direction: (to - from).normalize(),
        radius,
        level: LEVEL,
        contrast: LEVEL - TISSUE,
        closure: 1.0,
        is_good: true,
    };
    Track { points: (0..=count as usize).map(point).collect(), confidence: 0.9, doubt: None }
}

pub fn turned(mut track: Track) -> Track {
    track.points.reverse();
    for point in &mut track.points {
        point.direction = -point.direction;
    }
    track
}

pub(crate) fn with_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(count).build().expect("threads").install(work)
}
