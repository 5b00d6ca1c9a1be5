//! Tests that the section that is shown lies in the plane of its measured contour.

use glam::DVec3;
use lumencut_vessels::measure::profile::Profile;

use crate::study::open_study::Study;
use crate::study::tests::{opened, report_of};

/// Arc lengths along the helix (mm); most lie between two sections of the 0.5 mm grid.
const PLACES: [f64; 5] = [0.0, 40.13, 101.6, 160.37, 258.0];

fn profile_of_helix(study: &mut Study) -> Profile {
    let report = report_of(study);
    let line = report["vessels"][0]["line"].as_u64().expect("a line") as usize;
    study.profile(line, Some(0.8), &|| false).expect("a profile").clone()
}

/// The largest distance of points from the plane of a shown section (mm).
fn off_plane(section: [[f64; 3]; 3], points: &[DVec3]) -> f64 {
    let [middle, right, down] = section.map(DVec3::from_array);
    let normal = right.cross(down);
    points.iter().map(|point| (*point - middle).dot(normal).abs()).fold(0.0, f64::max)
}

#[test]
fn the_contour_lies_in_the_plane_that_is_looked_at() {
    let mut study = opened("helix");
    let profile = profile_of_helix(&mut study);
    for at in PLACES {
        let contour = &profile.contour[profile.nearest_section(at)];
        assert!(!contour.is_empty(), "no lumen at {at} mm");
        let away = off_plane(study.across(0, at).expect("a section"), contour);
        assert!(away < 1e-9, "{away} mm at {at} mm");
    }
}
