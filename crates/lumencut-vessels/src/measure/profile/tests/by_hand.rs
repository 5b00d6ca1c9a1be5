use super::*;
use crate::measure::section::flags::{CALCIUM, LEFT_OUT, OUTSIDE};
use crate::measure::stenosis::made_profile::profile;

fn circle(radius: f64) -> Outline {
    Outline { at: 1.0, center: DVec2::ZERO, radii: [radius; RAYS] }
}

/// A profile of five sections of 4 mm; the third one has the contour of a circle of 4 mm.
fn made() -> Profile {
    let mut made = profile(&[[4.0, 0.3]; 5]);
    made.contour[2] = circle(2.0).points(&made.place(2));
    made
}

#[test]
fn a_drawn_ellipse_has_its_closed_form() {
    let [a, b] = [5.0, 3.0];
    let radius = |n: usize| {
        let way = direction(n);
        1.0 / (way.x / a).hypot(way.y / b)
    };
    let center = DVec2::new(0.5, -0.25);
    let outline = Outline { at: 1.0, center, radii: std::array::from_fn(radius) };
    let drawn = made().drawn(&[outline], 0.5);
    // A polygon within an ellipse is smaller by less than 1 % with 64 corners.
    assert!((drawn.area[2] / (PI * a * b) - 1.0).abs() < 0.01, "{}", drawn.area[2]);
    assert!((drawn.diameter_min[2] / 6.0 - 1.0).abs() < 0.01);
    assert!((drawn.diameter_max[2] / 10.0 - 1.0).abs() < 0.01);
    assert!(drawn.center[2].distance(DVec3::new(0.5, -0.25, 0.0)) < 1e-9);
    assert!(drawn.half_axes[2][1].normalize().dot(DVec3::X).abs() > 1.0 - 1e-9);
    // Other sections are those of the automatic profile.
    assert_eq!([drawn.area[1], drawn.area[3]], [made().area[1], made().area[3]]);
    assert_eq!(drawn.flags, [0, 0, BY_HAND, 0, 0]);
}

#[test]
fn the_reader_decides_about_the_contour_but_not_about_the_scan() {
    let mut doubtful = made();
    doubtful.flags[2] = NO_EDGE | BRANCH | CALCIUM;
    doubtful.area[2] = f64::NAN;
    let drawn = doubtful.drawn(&[circle(2.5)], 0.5);
    assert_eq!(drawn.flags[2], CALCIUM | BY_HAND);
    assert!(drawn.counts(2));
    doubtful.flags[2] = OUTSIDE;
    assert!(doubtful.drawn(&[circle(2.5)], 0.5).flags[2] & LEFT_OUT != 0);
}

#[test]
fn a_drawn_diameter_is_at_least_as_unsure_as_half_a_voxel() {
    let [fine, coarse] = [0.1, 2.0].map(|side| made().drawn(&[circle(2.0)], side).uncertainty[2]);
    assert_eq!(fine, 0.3);
    assert!((coarse - 2.0 * DRAWN).abs() < 1e-12);
    let mut unknown = made();
    unknown.uncertainty[2] = f64::NAN;
    let drawn = unknown.drawn(&[circle(2.0)], 0.5);
    assert_eq!(drawn.uncertainty[2], drawn.uncertainty_parts[2].total());
}

#[test]
fn the_outline_of_a_contour_is_its_own_and_survives_being_drawn() {
    let outline = made().outline(2);
    assert!(outline.radii.iter().all(|radius| (radius - 2.0).abs() < 1e-9));
    let pulled = outline.pulled(&made().place(2), DVec3::new(0.0, 3.5, 0.0));
    let again =
        Outline { center: pulled.center, ..made().drawn(std::slice::from_ref(&pulled), 0.5).outline(2) };
    assert_eq!(again.at, 1.0);
    // The new outline is seen from the new centre, so its points are on the old one.
    let drawn = made().drawn(&[pulled], 0.5);
    let far =
        |point: &DVec3| drawn.contour[2].iter().map(|one| one.distance(*point)).fold(f64::MAX, f64::min);
    assert!(drawn.outline(2).points(&drawn.place(2)).iter().all(|point| far(point) < 0.2));
}

#[test]
fn a_pull_passes_through_the_pointer_and_leaves_the_far_side_alone() {
    let place = made().place(2);
    for (angle, length) in [(0.3, 4.0), (2.0, 1.0), (-0.01, 2.5), (3.1, 0.5)] {
        let to = place.point(DVec2::from_angle(angle) * length);
        let pulled = circle(2.0).pulled(&place, to);
        let nearest = pulled.points(&place).iter().map(|one| one.distance(to)).fold(f64::MAX, f64::min);
        assert!(nearest < 0.25, "{angle}: {nearest}");
        for (n, radius) in pulled.radii.iter().enumerate() {
            let away = direction(n).angle_to(DVec2::from_angle(angle)).abs();
            assert!(away < PULLED || *radius == 2.0, "{n}");
            // Neighbours follow without passing the pointer.
            assert!(
                (radius - 2.0) * (length - 2.0) >= 0.0 && (radius - 2.0).abs() <= (length - 2.0).abs() + 1e-9
            );
        }
    }
    assert_eq!(circle(2.0).pulled(&place, place.origin), circle(2.0));
    assert_eq!(circle(2.0).pulled(&place, DVec3::NAN), circle(2.0));
    let most = circle(2.0).pulled(&place, DVec3::new(1e9, 0.0, 0.0));
    assert!(most.radii.iter().all(|radius| (RADII_MM[0]..=RADII_MM[1]).contains(radius)));
}

#[test]
fn a_section_without_a_contour_offers_a_circle_as_wide_as_the_vessel_nearby() {
    let mut made = made();
    made.contour[1] = Vec::new();
    (made.area[1], made.area[0]) = (f64::NAN, 4.0 * PI);
    made.area[2] = f64::NAN;
    assert!(made.outline(1).radii.iter().all(|radius| (radius - 2.0).abs() < 1e-9));
    made.area = vec![f64::NAN; 5];
    assert_eq!(made.outline(1).radii, [FIRST_RADIUS_MM; RAYS]);
}
