//! Tests that clicks are accepted next to lumen, or with nothing but lumen around them.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::straight_tube;
use lumencut_vessels::trace::clicks::Traced;
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::lumen::surroundings::Surroundings;
use lumencut_vessels::trace::lumen::wander::wandering;
use lumencut_vessels::trace::lumen::wander::without_wander;
use lumencut_vessels::voxels;

fn traced(volume: &Volume, clicks: &[DVec3]) -> lumencut_core::error::Result<Traced> {
    let clicks = Clicks { vessels: vec![clicks.to_vec()], ..Clicks::default() };
    Tracer::default().trace(volume, &clicks, &|| false, None).map(|mut lines| lines.remove(0))
}

/// A chamber of blood (470 HU, noise 40, radius 48 mm) in fat. Within 30 mm of its centre there is only blood.
fn chamber() -> (Vec<i16>, [usize; 3], DAffine3) {
    let side = 72;
    let mut seed = 7u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 16) / 65536.0 - 0.5
    };
    let value = |n: usize| {
        let index = DVec3::new((n % side) as f64, (n / side % side) as f64, (n / (side * side)) as f64);
        let is_blood = (index - DVec3::splat(35.5)).length() * 1.5 < 48.0;
        // The sum of twelve uniform random numbers is nearly normal.
        let deviate: f64 = (0..12).map(|_| noise()).sum();
        (if is_blood { 470.0 } else { -90.0 } + 40.0 * deviate).round() as i16
    };
    let affine = DAffine3::from_scale(DVec3::splat(1.5)) * DAffine3::from_translation(DVec3::splat(-35.5));
    ((0..side * side * side).map(value).collect(), [side; 3], affine)
}

#[test]
fn clicks_in_blood_alone_are_no_tissue_whatever_the_noise() {
    let (values, size, affine) = chamber();
    let strides = [1, size[0], size[0] * size[1]];
    let volume = Volume::new(Voxels::I16(&values), size, strides, affine).unwrap();
    let clicks = [DVec3::new(0.4, -0.3, -10.0), DVec3::new(-0.6, 0.2, 9.0)];
    let line = traced(&volume, &clicks);
    assert!(line.is_ok(), "{:?}", line.err());
    assert!(traced(&volume, &[clicks[0], DVec3::Z * 51.0]).is_err(), "fat is refused as before");
}

#[test]
fn a_click_next_to_lumen_means_the_lumen_and_one_farther_away_is_refused() {
    let phantom = straight_tube().unwrap();
    let volume = phantom.volume().unwrap();
    let (from, to) = (DVec3::Z * -15.0, DVec3::new(0.3, 0.2, 15.0));
    // The radius is 4 mm, and points up to 3 mm from the centre have lumen on all sides.
    for first in [DVec3::new(4.6, 0.0, -15.0), DVec3::new(0.0, -4.6, -15.0)] {
        let line = traced(&volume, &[first, to]).unwrap().line;
        assert!(line.points[0].truncate().length() < 1.0, "{}", line.points[0]);
        assert!(traced(&volume, &[from, first + DVec3::Z * 30.0]).is_ok());
    }
    let refused = traced(&volume, &[from, DVec3::new(7.0, 0.0, 15.0)]).unwrap_err();
    assert!(refused.mend.contains("the nearest place that looks like lumen"), "{refused}");
    // Checking a single first click gives the same answer.
    let tracer = Tracer::default();
    assert!(tracer.check_click(&volume, DVec3::new(4.6, 0.0, -15.0)).is_ok());
    assert!(tracer.check_click(&volume, DVec3::new(7.0, 0.0, -15.0)).is_err());
}

/// A tube of radius 4 mm (300, noise 8) in tissue (100) and a brighter layer (150), without negative values as in MR.
fn in_mr() -> (Vec<i16>, [usize; 3], DAffine3) {
    let size = [48, 48, 40];
    let mut seed = 3u32;
    let mut uniform = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 16) / 65536.0 - 0.5
    };
    let value = |n: usize| {
        let [x, y] = [(n % 48) as f64 - 23.5, (n / 48 % 48) as f64 - 23.5];
        let tissue = if x > 12.0 { 150.0 } else { 100.0 };
        let deviate: f64 = (0..12).map(|_| uniform()).sum();
        (if x.hypot(y) < 4.0 { 300.0 } else { tissue } + 8.0 * deviate).round() as i16
    };
    let count = size.iter().product();
    ((0..count).map(value).collect(), size, DAffine3::from_translation(DVec3::new(-23.5, -23.5, -19.5)))
}

#[test]
fn a_first_click_in_tissue_of_mr_is_refused_with_the_nearest_lumen() {
    let (values, size, affine) = in_mr();
    let volume = Volume::new(Voxels::I16(&values), size, [1, size[0], size[0] * size[1]], affine).unwrap();
    let tracer = Tracer::default();
    for inside in [DVec3::ZERO, DVec3::new(2.0, -1.0, 5.0)] {
        assert!(tracer.check_click(&volume, inside).is_ok());
    }
    let refused = tracer.check_click(&volume, DVec3::new(0.0, 11.0, 0.0)).unwrap_err();
    assert!(refused.found.starts_with("tissue, or blood without signal"), "{refused}");
    assert!(refused.mend.contains("the nearest place that looks like lumen"), "{refused}");
    assert!(tracer.check_click(&volume, DVec3::new(0.0, 20.0, 0.0)).is_err(), "far from lumen, too");
    // A second click in tissue is refused because of the first one, and lines between good clicks are traced.
    let ends = [DVec3::Z * -12.0, DVec3::Z * 12.0];
    assert!(traced(&volume, &ends).is_ok());
}

#[test]
fn a_line_that_folds_back_within_a_lumen_is_made_calm_and_a_straight_one_stays() {
    let phantom = straight_tube().unwrap();
    let volume = phantom.volume().unwrap();
    let voxels = voxels::Voxels::new(&volume);
    let model = Surroundings::of(&voxels, &[DVec3::ZERO]).model(&voxels, &[DVec3::ZERO]).unwrap();
    let line = |corners: &[DVec3]| {
        let points: Vec<DVec3> = corners
            .windows(2)
            .flat_map(|ends| (0..20).map(move |n| ends[0].lerp(ends[1], f64::from(n) / 20.0)))
            .collect();
        let count = points.len();
        Centerline { points, radius: vec![4.0; count], confidence: vec![0.5; count] }
    };
    let length =
        |line: &Centerline| line.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>();
    let wanders = |line: &Centerline| wandering(line).contains(&true);
    let [from, to] = [-12.0, 12.0].map(|z| DVec3::Z * z);
    let folded = line(&[from, DVec3::new(1.0, 0.0, 3.0), DVec3::new(-1.0, 0.5, -3.0), to]);
    assert!(wanders(&folded) && length(&folded) > 34.0);
    let calm = without_wander(&voxels, &model, folded, &|| false).unwrap();
    assert!(!wanders(&calm) && length(&calm) < 27.0, "{}", length(&calm));
    let straight = line(&[from, to]);
    assert_eq!(without_wander(&voxels, &model, straight.clone(), &|| false).unwrap(), straight);
}
