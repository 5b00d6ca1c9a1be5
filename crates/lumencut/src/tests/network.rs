//! The map of a straight vessel against closed forms.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::reformations::untangled::UntangledParameters;
use lumencut_core::settings::RimValue;
use lumencut_core::vessel_tree::{Vessel, VesselTree};

use super::*;
use crate::along_vessels::Along;

const SPACING: f64 = 0.5;

fn map(vessel: &Vessel) -> (Untangled, ValuesAlong, Vec<[u8; 4]>) {
    let tree = VesselTree::new(vec![vessel.clone()]).unwrap();
    let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [8, 8], 1.0).unwrap();
    let parameters = UntangledParameters { width: 10.0, ..UntangledParameters::new(SPACING) };
    let laid = Untangled::new(&tree, &camera, parameters, &|| false).unwrap();
    let along = Along { vessel, profile: None, stenoses: &[] };
    let along = ValuesAlong::new(RimValue::Diameter, &[along]).unwrap();
    let pixels = drawn(&laid, &along, &|| false).unwrap();
    (laid, along, pixels)
}

#[test]
fn a_line_is_as_long_and_as_wide_as_its_vessel_and_coloured_by_its_diameter() {
    // The vessel runs along the view for a part, which the map shows in true length.
    let points = (0..=60)
        .map(|n| if n <= 40 { DVec3::Z * f64::from(n) } else { DVec3::new(0.0, f64::from(n - 40), 40.0) });
    let radius = (0..=60).map(|n| 2.0 + f64::from(n) / 20.0).collect();
    let vessel = Vessel::new(points.collect(), Some(radius)).unwrap();
    let (laid, along, pixels) = map(&vessel);
    let part = &laid.laid_out()[0];
    let length: f64 = part.pixels.windows(2).map(|two| two[0].distance(two[1])).sum();
    assert!((length * SPACING - 60.0).abs() < 0.1, "{length} pixels");
    let width = laid.size()[0];
    for at in [10.0, 20.0, 30.0] {
        let n = part.arc_length.partition_point(|known| *known < at);
        let place = part.pixels[n].round();
        let middle = place.y as usize * width + place.x as usize;
        let colour = along.colours()[0][along.place(0, part.arc_length[n]).unwrap()];
        let apart = (0..4).map(|c| pixels[middle][c].abs_diff(colour[c])).max();
        assert!(apart <= Some(4), "{:?} is not {colour:?} at {at} mm", pixels[middle]);
        let row = &pixels[place.y as usize * width..][..width];
        let covered: f64 = row.iter().map(|pixel| f64::from(pixel[3]) / 255.0).sum();
        assert!((covered * SPACING - (4.0 + at / 10.0)).abs() < 0.2, "{covered} pixels wide at {at} mm");
    }
}

#[test]
fn a_vessel_without_a_value_is_a_grey_line() {
    let known = Vessel::new(vec![DVec3::ZERO, DVec3::Z * 20.0], Some(vec![3.0; 2])).unwrap();
    let unknown = Vessel::new(vec![DVec3::Z * 20.0, DVec3::Z * 50.0], None).unwrap();
    let tree = VesselTree::new(vec![known.clone(), unknown.clone()]).unwrap();
    let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [8, 8], 1.0).unwrap();
    let laid = Untangled::new(&tree, &camera, UntangledParameters::new(SPACING), &|| false).unwrap();
    let vessels = [&known, &unknown].map(|vessel| Along { vessel, profile: None, stenoses: &[] });
    let along = ValuesAlong::new(RimValue::Diameter, &vessels).unwrap();
    let pixels = drawn(&laid, &along, &|| false).unwrap();
    let grey = pixels.iter().filter(|pixel| pixel[..3] == UNKNOWN);
    let area: f64 = grey.map(|pixel| f64::from(pixel[3]) / 255.0).sum();
    // 30 mm of a line 2.5 pixels wide; its start lies in the other vessel.
    assert!((120.0..160.0).contains(&area), "{area} grey pixels");
}
