use super::*;

fn path(points: &[[f64; 3]], smoothing: f64) -> Result<CenterlinePath> {
    let points = points.iter().map(|p| DVec3::from_array(*p)).collect();
    CenterlinePath::new(&Vessel::new(points, None)?, smoothing)
}

#[test]
fn a_path_is_walked_along_and_goes_on_straight() {
    let corner = path(&[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 4.0, 0.0]], 0.0).unwrap();
    assert_eq!(corner.arc_length(), [0.0, 3.0, 7.0]);
    for (t, expected) in
        [(-1.0, [-1.0, 0.0, 0.0]), (3.0, [3.0, 0.0, 0.0]), (5.0, [3.0, 2.0, 0.0]), (9.0, [3.0, 6.0, 0.0])]
    {
        assert_eq!(corner.at(t), DVec3::from_array(expected));
    }
}

#[test]
fn smoothing_keeps_ends_and_straight_lines_and_flattens_a_zigzag() {
    let zigzag: Vec<_> = (0..41).map(|i| [f64::from(i), if i % 2 == 0 { 0.5 } else { -0.5 }, 0.0]).collect();
    let smooth = path(&zigzag, 4.0).unwrap();
    assert_eq!(
        (smooth.points()[0], smooth.points()[40]),
        (DVec3::new(0.0, 0.5, 0.0), DVec3::new(40.0, 0.5, 0.0))
    );
    assert!(smooth.points()[15..25].iter().all(|p| p.y.abs() < 0.01));
    let straight: Vec<_> = (0..9).map(|i| [0.0, 0.0, f64::from(i * i)]).collect();
    for (point, [.., z]) in path(&straight, 5.0).unwrap().points().iter().zip(straight) {
        assert!(point.distance(DVec3::new(0.0, 0.0, z)) < 1e-9);
    }
}

#[test]
fn paths_without_length_and_odd_smoothings_are_refused() {
    let error = path(&[[1.0, 2.0, 3.0], [1.0, 2.0, 3.0]], 0.0).unwrap_err();
    assert_eq!(error.kind, ErrorKind::VesselTree);
    assert!(error.to_string().contains("without length"), "{error}");
    for smoothing in [-1.0, f64::NAN, 1e4] {
        let error = path(&[[0.0; 3], [1.0; 3]], smoothing).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Settings);
    }
}
