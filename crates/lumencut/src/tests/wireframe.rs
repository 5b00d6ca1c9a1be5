use super::*;

const GREY: [u8; 4] = [100, 100, 100, 255];
const WIRE: [u8; 4] = [60, 190, 255, 255];

/// A tube of radius 20 mm along x, from -60 to 60 mm, drawn over grey by a camera of 1 mm pixels.
fn drawn(direction: DVec3, radius: Option<f64>, unknown_radius: f64) -> Vec<[u8; 4]> {
    let points = (-6..=6).map(|n| DVec3::X * 10.0 * f64::from(n)).collect::<Vec<_>>();
    let radius = radius.map(|radius| vec![radius; points.len()]);
    let tree = VesselTree::new(vec![Vessel::new(points, radius).unwrap()]).unwrap();
    let camera = Camera::new(DVec3::ZERO, direction, DVec3::Z, [160, 80], 1.0).unwrap();
    let mut image = vec![GREY; 160 * 80];
    draw_wireframe(&mut image, &camera, &tree, &Settings { unknown_radius, ..Settings::default() });
    image
}

#[test]
fn the_outline_of_a_tube_lies_at_its_radius() {
    let image = drawn(DVec3::Y, Some(20.0), 1.0);
    let column = |i: usize| (0..80).map(|j| image[j * 160 + i]).collect::<Vec<_>>();
    // Between two rings, the outermost wires cover half of the pixels on each side of 20 mm.
    let between = column(95);
    let half = mixed(GREY, 0.5);
    assert_eq!([between[19], between[20], between[59], between[60]], [half; 4]);
    assert!(between[..19].iter().chain(&between[61..]).all(|pixel| *pixel == GREY));
    // Seven wires of the near side; those of the far side lie behind them.
    let rows: Vec<_> = (0..80).filter(|j| between[*j] != GREY).collect();
    let expected = (0..7).map(|side| 40.0 - 20.0 * (TAU * f64::from(side) / 12.0).cos());
    for place in expected {
        assert!(rows.iter().any(|j| (*j as f64 + 0.5 - place).abs() <= 0.51), "{place}");
    }
    // Beyond its ends nothing is drawn.
    assert!(column(17).iter().chain(&column(142)).all(|pixel| *pixel == GREY));
    assert!(column(20).iter().filter(|pixel| **pixel != GREY).count() > 30);
}

#[test]
fn the_far_side_is_fainter() {
    let direction = DVec3::new(1.0, 1.0, 0.0).normalize();
    let image = drawn(direction, Some(20.0), 1.0);
    // The first ring seen at 45°: its near half lies right of its middle, its far half left of it.
    let middle = 80.0 - 60.0 / 2.0_f64.sqrt();
    let [near, far] = [1.0, -1.0].map(|side| {
        let i = (middle + side * 20.0 / 2.0_f64.sqrt()) as usize;
        (i - 1..=i + 1).map(|i| image[39 * 160 + i][2].max(image[40 * 160 + i][2])).max().unwrap()
    });
    assert!(near > far && far > GREY[2], "{near} {far}");
}

#[test]
fn a_vessel_without_radius_has_the_unknown_radius() {
    assert_eq!(drawn(DVec3::Y, None, 20.0), drawn(DVec3::Y, Some(20.0), 1.0));
    assert_ne!(drawn(DVec3::Y, None, 10.0), drawn(DVec3::Y, Some(20.0), 1.0));
}

#[test]
fn wires_mix_with_the_opacity_below() {
    assert_eq!(mixed(GREY, 0.0), GREY);
    assert_eq!(mixed(GREY, 1.0), WIRE);
    assert_eq!(mixed([0, 0, 0, 0], 0.5), [60, 190, 255, 128]);
    assert_eq!(mixed(GREY, 0.5), [80, 145, 178, 255]);
}

#[test]
fn wires_outside_the_picture_change_nothing() {
    let tree = |x: f64| {
        let points = vec![DVec3::new(x, 0.0, -5e4), DVec3::new(x, 0.0, 5e4)];
        VesselTree::new(vec![Vessel::new(points, Some(vec![3.0; 2])).unwrap()]).unwrap()
    };
    let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [64, 64], 1.0).unwrap();
    let mut image = vec![GREY; 64 * 64];
    draw_wireframe(&mut image, &camera, &tree(1e5), &Settings::default());
    assert!(image.iter().all(|pixel| *pixel == GREY));
    draw_wireframe(&mut image, &camera, &tree(0.0), &Settings::default());
    assert!(image.chunks(64).all(|row| row[35] != GREY));
}

#[test]
fn thin_vessels_have_fewer_lines() {
    assert_eq!([20.0, 8.0, 5.0, 3.0, 2.0, 1.0, 0.1].map(corners_between), [1, 1, 2, 3, 4, 6, 6]);
}
