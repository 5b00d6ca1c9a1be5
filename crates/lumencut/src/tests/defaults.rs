use lumencut_core::reformations::cr::CrParameters;
use lumencut_core::reformations::untangled::UntangledParameters;
use lumencut_core::settings::Focus;

use super::*;

#[test]
fn the_pixel_side_is_that_of_the_voxels_within_its_bounds() {
    let sides = [0.01, 0.05, 0.2, 0.25, 0.26, 3.0].map(pixel_side);
    assert_eq!(sides, [0.05, 0.05, 0.2, 0.25, 0.25, 0.25]);
    assert_eq!(PIXEL_SIDE_WORDS, "the smallest voxel side, at least 0.05 and at most 0.25 mm");
}

#[test]
fn every_default_lies_in_its_range_and_every_name_stands_once() {
    for (n, row) in QUANTITIES.iter().enumerate() {
        let [low, high] = row.range;
        assert!((low..=high).contains(&row.default), "{}", row.name);
        assert!(row.about.ends_with('.') && row.name.contains('.'), "{}", row.name);
        assert!(QUANTITIES[..n].iter().all(|other| other.name != row.name), "{}", row.name);
    }
}

/// The core states the defaults of its own parameters; the table repeats them for the hosts.
#[test]
fn defaults_are_those_of_the_core() {
    let untangled = UntangledParameters::new(1.0);
    let CrParameters { radius_offset, arc_threshold } = CrParameters::default();
    let Focus { margin, fade } = Focus::default();
    for (row, core) in [
        (UNTANGLED_WIDTH, untangled.width),
        (HULL_MARGIN, untangled.hull_margin),
        (UNTANGLED_SMOOTHING, untangled.smoothing),
        (RADIUS_OFFSET, radius_offset),
        (ARC_THRESHOLD, arc_threshold),
        (FOCUS_MARGIN, margin),
        (FOCUS_FADE, fade),
    ] {
        assert_eq!(row.default, core, "{}", row.name);
    }
}
