use super::*;
use crate::trace::find::made::{LEVEL, away, blurred, with_scan};
use crate::trace::find::refusals::no_vessel;
use lumencut_core::error::Mend;

/// The vessels of a scan with a tube of 54 mm and a radius of 0.75 mm, in voxels of 0.5 mm.
fn found(smallest_radius: Option<f64>) -> Trees {
    let line = [DVec3::new(3.0, 15.0, 12.0), DVec3::new(57.0, 18.0, 16.0)];
    // Sixteen values around the mean, in an order that looks like noise.
    let grain =
        |place: DVec3| (place.dot(DVec3::new(158.0, 226.0, 374.0)).sin() * 1e4).rem_euclid(16.0) - 7.5;
    let value = |place: DVec3| blurred(0.75 - away(place, &line)) + grain(place);
    with_scan([120, 60, 56], 0.5, value, |scan| {
        let request = FindRequest { smallest_radius, stop: &|| false, progress: None };
        find_in(scan.voxels, &request).expect("vessels")
    })
}

#[test]
fn by_default_it_is_one_mm_or_less_in_fine_voxels() {
    let of = |side: f64| with_scan([4; 3], side, |_| 0.0, |scan| smallest_radius(scan.voxels));
    assert_eq!([of(0.5), of(2.0)], [VOXELS_PER_RADIUS * 0.5, SMALLEST_RADIUS]);
    let words = format!("{SMALLEST_RADIUS} mm, or {VOXELS_PER_RADIUS} voxel sides if that is less");
    assert_eq!(SMALLEST_RADIUS_WORDS, words);
}

#[test]
fn a_narrow_vessel_in_fine_voxels_is_found_by_default_and_a_refusal_tells_of_it() {
    let narrow = found(None);
    assert!((narrow.sure_length() - 54.0).abs() < 5.0, "{}", narrow.sure_length());
    // Half the resolution would show 155.
    assert!(narrow.level > 0.7 * LEVEL, "{}", narrow.level);
    let refusal = no_vessel(&found(Some(1.0)));
    assert!(refusal.found.starts_with("none whose radius is 1 mm or more; from 0.7 mm on, 5"), "{refusal}");
    assert_eq!(refusal.mended_by, Some(Mend::SmallerRadius));
}
