use super::*;
use crate::stop::NEVER;
use crate::vessel_tree::Vessel;

const FRONT: View = View { up: DVec3::Z, angle: 0.0, normal: None };
const FINE: SpiralParameters =
    SpiralParameters { pitch: 1.0, radius: 16.0, sampling: Sampling::Arc, pixel_spacing: 0.25, angle: 0.0 };

fn path(points: Vec<DVec3>) -> Arc<CenterlinePath> {
    Arc::new(CenterlinePath::new(&Vessel::new(points, None).unwrap(), 0.0).unwrap())
}

fn straight(parameters: SpiralParameters) -> Spiral {
    Spiral::new(path(vec![DVec3::new(0.0, 0.0, 10.0), DVec3::ZERO]), &FRONT, parameters).unwrap()
}

fn helix() -> Arc<CenterlinePath> {
    path(
        (0..400)
            .map(|n| f64::from(n) * 0.02)
            .map(|t| DVec3::new(30.0 * t.cos(), 30.0 * t.sin(), -8.0 * t))
            .collect(),
    )
}

fn width(spiral: &Spiral, is_inside: impl Fn(DVec2) -> bool) -> f64 {
    let inside = spiral.columns.iter().filter(|[place, _]| is_inside(*place)).count();
    inside as f64 * spiral.parameters.pixel_spacing
}

#[test]
fn the_width_of_a_region_is_its_area_by_the_pitch() {
    type Region = fn(DVec2) -> bool;
    let regions: [(Region, f64); 3] = [
        (|q| q.length() < 10.0, 100.0),
        (|q| (q / DVec2::new(12.0, 5.0)).length() < 1.0, 60.0),
        (|q| (q - DVec2::new(4.0, 3.0)).length() < 7.0, 49.0),
    ];
    // Discs in the middle are exact; the ends of an ellipse fall between windings, depending on its rotation.
    for (pitch, pixel_spacing, most) in [(1.0, 0.03, [5e-3, 2e-2, 2e-2]), (0.25, 0.12, [2e-3, 5e-3, 5e-3])] {
        for (n, (is_inside, area)) in regions.iter().enumerate() {
            for turn in 0..8 {
                let angle = f64::from(turn) * PI / 8.0;
                let parameters = SpiralParameters { pitch, pixel_spacing, radius: 13.0, angle, ..FINE };
                let found = pitch * width(&straight(parameters), is_inside) / (area * PI) - 1.0;
                assert!(found.abs() < most[n], "region {n} at a pitch of {pitch} mm, turned {turn}: {found}");
            }
        }
    }
}

#[test]
fn neighbours_are_a_pixel_apart() {
    for sampling in [Sampling::Arc, Sampling::Angle] {
        let spiral = straight(SpiralParameters { sampling, pixel_spacing: 0.05, ..FINE });
        let steps: Vec<f64> = spiral.columns.windows(2).map(|two| two[0][0].distance(two[1][0])).collect();
        match sampling {
            Sampling::Arc => assert!(steps.iter().all(|step| (0.0495..=0.05001).contains(step))),
            // Equal angles are closer together towards the middle.
            Sampling::Angle => {
                assert!((steps[0] - 0.05).abs() < 0.001 && steps[steps.len() / 2] < 0.002);
            }
        }
    }
}

#[test]
fn windings_are_a_pitch_apart() {
    let spiral = straight(SpiralParameters { pixel_spacing: 0.05, ..FINE });
    // Along any ray from the middle, windings are one pitch apart.
    let mut passes: Vec<f64> = spiral
        .columns
        .windows(2)
        .filter(|two| two[0][0].x * two[1][0].x <= 0.0 && two[0][0].y > 0.0)
        .map(|two| two[0][0].y)
        .collect();
    passes.sort_by(f64::total_cmp);
    // The innermost half winding is not yet a circle.
    passes.remove(0);
    assert!(passes.windows(2).all(|two| (two[1] - two[0] - 1.0).abs() < 0.015), "{passes:?}");
    let [place, across] = spiral.columns[5];
    let next = spiral.columns[6][0];
    assert!((next - place).normalize().dot(across).abs() < 0.02 && across.dot(place) != 0.0);
}

#[test]
fn places_and_pixels_are_inverse() {
    for sampling in [Sampling::Arc, Sampling::Angle] {
        let parameters = SpiralParameters { sampling, angle: 0.8, radius: 8.0, ..FINE };
        let spiral = Spiral::new(helix(), &FRONT, parameters).unwrap();
        let [width, height] = spiral.size();
        for (i, j) in (0..width).step_by(7).zip((3..height - 3).step_by(5).cycle()) {
            let pixel = DVec2::new(i as f64 + 0.2, j as f64 - 0.3);
            let back = spiral.pixel_from_world(spiral.world_from_pixel(pixel));
            // The middle belongs to both spirals and is left out.
            if (pixel.x - spiral.middle()).abs() > 1.0 {
                assert!(back.distance(pixel) < 1e-5, "{pixel} came back as {back}");
            }
        }
        let curved = spiral.curved(NEVER).unwrap();
        let there = spiral.world_from_pixel(DVec2::new(9.0, 4.0));
        assert!(curved.position()[4 * width + 9].distance(there) < 1e-9);
        assert!(spiral.pixel_from_world(DVec3::new(0.0, 0.0, 99.0)).is_nan());
    }
}

#[test]
fn a_rod_along_the_vessel_is_a_straight_column() {
    let spiral = straight(FINE);
    let rod = |z: f64| spiral.pixel_from_world(DVec3::new(3.0, 4.0, z));
    assert!((0..10).all(|z| (rod(f64::from(z)).x - rod(5.0).x).abs() < 1e-9));
}

#[test]
fn what_cannot_be_wound_up_is_refused() {
    let refused = |parameters| Spiral::new(helix(), &FRONT, parameters).err();
    let too_fine = refused(SpiralParameters { pitch: 0.001, ..FINE }).unwrap();
    assert!(too_fine.to_string().contains("pitch of"), "{too_fine}");
    for parameters in [
        SpiralParameters { pitch: 0.0, ..FINE },
        SpiralParameters { radius: f64::NAN, ..FINE },
        SpiralParameters { pixel_spacing: -1.0, ..FINE },
        SpiralParameters { angle: f64::INFINITY, ..FINE },
    ] {
        assert_eq!(refused(parameters).map(|error| error.kind), Some(ErrorKind::Camera));
    }
    let words = too_fine.to_string();
    let pitch: f64 = words.split("pitch of ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!(refused(SpiralParameters { pitch, ..FINE }).is_none(), "a pitch of {pitch} mm was told to fit");
}

#[test]
fn a_place_beside_the_middle_is_shown_by_what_is_nearest_to_it_in_all_directions() {
    let spiral = straight(FINE);
    for turn in 0..64 {
        let around = DVec2::from_angle(f64::from(turn) * PI / 32.0 - PI);
        for away in [1e-9, 0.2, 0.45, 0.8, 2.3] {
            let point = spiral.straightened.world_from_straightened((around * away).extend(5.0));
            let shown = spiral.world_from_pixel(spiral.pixel_from_world(point));
            assert!(shown.distance(point) <= FINE.pitch / 2.0 + 1e-9, "{away} mm away at turn {turn}");
        }
    }
}
