//! Finds all vessels of phantoms, whose lines and radii are known, and none where there is none.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::math::statistics;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::{
    Phantom, calcified_wall, collinear_run, crossing, helix, straight_tube, trefoil, y_junction,
};
use lumencut_scenes::random::Random;
use lumencut_vessels::trace::find::found::Trees;
use lumencut_vessels::trace::find::from_seed::find_from;
use lumencut_vessels::trace::find::{FindRequest, find_vessels};

use crate::scans::noise;

fn request(smallest_radius: Option<f64>) -> FindRequest<'static> {
    FindRequest { smallest_radius, stop: &|| false, progress: None }
}

fn found(volume: &Volume) -> Trees {
    find_vessels(volume, &request(None)).unwrap()
}

fn away<'a>(place: DVec3, lines: impl Iterator<Item = &'a [DVec3]>) -> f64 {
    let from_segment = |pair: &[DVec3]| {
        let way = pair[1] - pair[0];
        let share = ((place - pair[0]).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        place.distance(pair[0] + share * way)
    };
    lines.flat_map(|line| line.windows(2).map(from_segment)).fold(f64::MAX, f64::min)
}

fn median(of: &[f64]) -> f64 {
    statistics::median(&mut of.to_vec()).unwrap()
}

fn truth(made: &Phantom) -> impl Iterator<Item = &[DVec3]> + Clone {
    made.tree.vessels().iter().map(|vessel| vessel.points())
}

fn lines(trees: &Trees) -> impl Iterator<Item = &[DVec3]> + Clone {
    trees.vessels.iter().map(|vessel| &vessel.line.points[..])
}

#[test]
fn single_tubes_are_found_whole_in_their_middle_with_their_radius() {
    let made = [straight_tube(), helix(), crossing(), collinear_run(), calcified_wall(), trefoil()];
    for (made, radius) in made.map(Result::unwrap).iter().zip([4.0, 3.0, 3.0, 3.0, 4.0, 3.0]) {
        let trees = found(&made.volume().unwrap());
        let parts: Vec<usize> = trees.vessels.iter().map(|vessel| vessel.part).collect();
        assert_eq!(parts, (0..made.tree.vessels().len()).collect::<Vec<_>>(), "{}", made.name);
        // Tubes have round ends, so they are up to a radius longer than their line at each end.
        assert!(
            truth(made).flatten().all(|point| away(*point, lines(&trees)) < 0.3 * radius),
            "{}",
            made.name
        );
        for vessel in &trees.vessels {
            let line = &vessel.line;
            let off: Vec<f64> = line.points.iter().map(|point| away(*point, truth(made))).collect();
            assert!(median(&off) < 0.3, "{}", made.name);
            assert!((median(&line.radius) / radius - 1.0).abs() < 0.1, "{}", made.name);
            assert!(line.confidence.iter().all(|confidence| (0.0..=1.0).contains(confidence)));
            assert!(line.points.windows(2).all(|two| two[0].distance(two[1]) < 0.55));
            assert_eq!(vessel.doubt, None);
        }
    }
}

#[test]
fn a_closed_vessel_stays_closed() {
    let made = trefoil().unwrap();
    let seed = made.tree.vessels()[0].points()[40];
    let trees = find_from(&made.volume().unwrap(), seed, &request(None)).unwrap();
    let [vessel] = &trees.vessels[..] else { panic!("{} vessels", trees.vessels.len()) };
    assert_eq!(vessel.line.points.first(), vessel.line.points.last());
}

#[test]
fn a_fork_is_a_whole_vessel_from_its_root_and_a_branch_of_it() {
    let made = y_junction().unwrap();
    let trees = found(&made.volume().unwrap());
    let [trunk, branch] = &trees.vessels[..] else { panic!("{} vessels", trees.vessels.len()) };
    assert!(trunk.line.points[0].distance(DVec3::Z * -30.0) < 6.0);
    assert!(trunk.line.points.contains(&branch.line.points[0]));
    let ends = [trunk, branch].map(|vessel| vessel.line.points[vessel.line.points.len() - 1].x);
    assert!(ends[0] * ends[1] < 0.0, "{ends:?}");
    assert!((trees.level / 350.0 - 1.0).abs() < 0.02 && (trees.contrast / 450.0 - 1.0).abs() < 0.02);
    for point in lines(&trees).flatten().filter(|point| point.z.abs() > 14.0) {
        assert!(away(*point, truth(&made)) < 5.0, "{point}");
    }
    let scaled: Vec<f64> = made.voxels.iter().map(|value| f64::from(*value) * 0.1 + 1000.0).collect();
    let mut holes: Vec<f32> = made.voxels.iter().map(|value| f32::from(*value)).collect();
    holes[..made.size[0] * made.size[1] * 4].fill(f32::NAN);
    holes[made.size[0] * made.size[1] * 5..][..9].fill(f32::INFINITY);
    for voxels in [Voxels::F64(&scaled), Voxels::F32(&holes)] {
        let other = found(&lumencut_scenes::volumes::volume(voxels, made.size, made.world_from_index));
        assert_eq!(other.vessels.len(), 2);
        let inner = lines(&other).flatten().filter(|point| point.z > -22.0);
        assert!(inner.into_iter().all(|point| away(*point, lines(&trees)) < 0.3));
    }
    let widths = made.tree.vessels().iter().map(|vessel| median(vessel.radius().unwrap()));
    let mut widths: Vec<f64> = widths.collect();
    widths.sort_by(f64::total_cmp);
    let least = f64::midpoint(widths[widths.len() - 1], widths[widths.len() - 2]);
    let wide = find_from(&made.volume().unwrap(), DVec3::Z * -20.0, &request(Some(least))).unwrap();
    assert_eq!(wide.vessels.len(), 1);
}

fn made(size: [usize; 3], noisy: f64, value: impl Fn(DVec3) -> f64) -> Vec<f32> {
    let mut random = Random::new(3);
    let mut voxel = |n: usize| {
        let index = [n % size[0], n / size[0] % size[1], n / (size[0] * size[1])];
        let place = DVec3::from(index.map(|c| 0.8 * c as f64)) - affine(size).translation.abs();
        (value(place) + noisy * noise(&mut random)) as f32
    };
    (0..size.iter().product()).map(&mut voxel).collect()
}

fn affine(size: [usize; 3]) -> DAffine3 {
    let middle = DVec3::from(size.map(|n| -0.4 * (n - 1) as f64));
    DAffine3::from_translation(middle) * DAffine3::from_scale(DVec3::splat(0.8))
}

fn share(depth: f64) -> f64 {
    (0.5 + depth / 0.8).clamp(0.0, 1.0)
}

fn found_in(size: [usize; 3], noisy: f64, value: impl Fn(DVec3) -> f64) -> Trees {
    let values = made(size, noisy, value);
    found(&lumencut_scenes::volumes::volume(Voxels::F32(&values), size, affine(size)))
}

fn is_sure(trees: &Trees) -> bool {
    trees.vessels.iter().any(|vessel| vessel.doubt.is_none())
}

#[test]
fn where_no_vessel_is_none_is_found() {
    let bone = |place: DVec3| {
        let away =
            [-24.0, 0.0, 24.0].map(|z| place.distance(DVec3::Z * z)).into_iter().fold(f64::MAX, f64::min);
        50.0 + 1100.0 * share(10.0 - away) - 900.0 * share(8.0 - away)
    };
    let plates = |place: DVec3| {
        50.0 + 300.0 * share(1.2 - (place.y + 7.0).abs()) + 1100.0 * share(0.8 - (place.x - 9.0).abs())
    };
    for trees in [
        found_in([60; 3], 20.0, |_| 0.0),
        found_in([100; 3], 20.0, bone),
        found_in([80; 3], 10.0, plates),
        found_in([30; 3], 0.0, |_| 40.0),
        found_in([30; 3], 0.0, |_| f64::NAN),
        found_in([1, 60, 60], 0.0, |place| 300.0 * share(1.0 - place.y.abs())),
        found_in([40; 3], 20.0, |place| 450.0 * share(7.0 - place.length()) - 100.0),
    ] {
        assert!(!is_sure(&trees), "{} vessels", trees.vessels.len());
    }
}

#[test]
fn bone_beside_a_vessel_is_left_out_and_narrower_vessels_are_if_that_is_asked_for() {
    let size = [70, 50, 80];
    let tube = |place: DVec3, x: f64, radius: f64| share(radius - (place.x - x).hypot(place.y));
    let body = |place: DVec3| share(6.0 - place.distance(DVec3::new(9.5, 0.0, 4.0)));
    let trees = found_in(size, 20.0, |place| {
        let around = 50.0 + 1100.0 * body(place);
        around + (350.0 - around) * tube(place, 0.0, 2.5)
    });
    let axis = [DVec3::Z * -32.0, DVec3::Z * 32.0];
    assert!(lines(&trees).flatten().all(|point| away(*point, std::iter::once(&axis[..])) < 4.0));
    assert!((-28..28).all(|z| away(DVec3::Z * f64::from(z), lines(&trees)) < 2.0));
    let values = made(size, 10.0, |place| 50.0 + 300.0 * (tube(place, -12.0, 4.0) + tube(place, 12.0, 1.4)));
    let volume = lumencut_scenes::volumes::volume(Voxels::F32(&values), size, affine(size));
    let sides = |least| -> Vec<bool> {
        let trees = find_vessels(&volume, &request(least)).unwrap();
        let sure = trees.vessels.iter().filter(|vessel| vessel.doubt.is_none());
        sure.map(|vessel| vessel.line.points[0].x > 0.0).collect()
    };
    assert_eq!(sides(None), [false, true]);
    assert_eq!(sides(Some(2.0)), [false]);
}

#[test]
fn a_faint_artery_of_a_ct_is_sure_and_a_vessel_without_contrast_medium_is_doubtful() {
    let ct = |lumen: f64, around: f64| {
        found_in([50, 50, 120], 10.0, |place| {
            let tissue = if place.z < -45.0 { -1000.0 } else { around };
            tissue + (lumen - tissue) * share(3.0 - place.truncate().length())
        })
    };
    assert!(is_sure(&ct(115.0, 50.0)));
    let plain = ct(45.0, -100.0);
    assert!(!plain.vessels.is_empty() && !is_sure(&plain));
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let made = y_junction().unwrap();
    let mut random = Random::new(4);
    let noisy = made.voxels.iter().map(|value| f32::from(*value) + 20.0 * noise(&mut random) as f32);
    let noisy: Vec<f32> = noisy.collect();
    let volume = lumencut_scenes::volumes::volume(Voxels::F32(&noisy), made.size, made.world_from_index);
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let trees = pool.install(|| found(&volume));
        trees.vessels.into_iter().map(|vessel| (vessel.line, vessel.doubt)).collect::<Vec<_>>()
    };
    assert_eq!(of(1), of(3));
}
