//! Tests the error messages of tracing and measuring.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::wall::WallRequest;
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::tracer::Tracer;

/// Errors for clicks in a uniform volume, outside the volume, and twice at the same place.
fn tracing_errors() -> Vec<Error> {
    let voxels = [0i16; 27];
    let volume = Volume::new(Voxels::I16(&voxels), [3; 3], [1, 3, 9], DAffine3::IDENTITY).unwrap();
    let traced = |points: [DVec3; 2]| {
        let clicks = Clicks { vessels: vec![points.to_vec()], ..Clicks::default() };
        Tracer::default().trace(&volume, &clicks, &|| false, None).unwrap_err()
    };
    vec![
        traced([DVec3::ZERO, DVec3::splat(2.0)]),
        traced([DVec3::ZERO, DVec3::splat(9.0)]),
        traced([DVec3::ONE, DVec3::ONE]),
    ]
}

/// Errors for a vessel in a uniform volume, and for one outside the volume.
fn measuring_errors() -> Vec<Error> {
    let voxels = [0i16; 1000];
    let volume = Volume::new(Voxels::I16(&voxels), [10; 3], [1, 10, 100], DAffine3::IDENTITY).unwrap();
    let measured = |shift: f64| {
        let points = [0.0, 9.0].map(|z| DVec3::new(5.0 + shift, 5.0, z)).to_vec();
        let request = MeasureRequest {
            step: 1.0,
            fwhm: None,
            wall: WallRequest::Automatic,
            tree: &[],
            stop: &|| false,
        };
        measure(&volume, &Vessel::new(points, None).unwrap(), &request).unwrap_err()
    };
    vec![measured(0.0), measured(50.0)]
}

#[test]
fn errors_name_what_was_found_and_what_was_expected() {
    for error in tracing_errors().iter().chain(&measuring_errors()) {
        let line = error.to_string();
        assert!(line.contains("found ") && line.contains("expected ") && !line.contains('\n'), "{line}");
        assert!(!error.subject.is_empty() && !error.found.is_empty() && !error.expected.is_empty(), "{line}");
    }
}

#[test]
fn tracing_and_measuring_have_kinds_of_their_own() {
    assert!(tracing_errors().iter().any(|error| error.kind == ErrorKind::Tracing));
    assert!(measuring_errors().iter().any(|error| error.kind == ErrorKind::Measuring));
}
