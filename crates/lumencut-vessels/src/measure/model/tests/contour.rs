use super::*;
use crate::measure::model::ellipse::{Boundary, Whitening};
use glam::DMat2;

#[test]
fn moments_give_the_ellipse_that_walls_enclose() {
    let ellipse = Ellipse { center: DVec2::ZERO, mean: 3.0, stretch: DVec2::new(0.5, -0.8) };
    let wall: Vec<f64> = (0..RAYS).map(|n| ellipse.radius_towards(direction(n))).collect();
    let found = ellipse_within(DVec2::new(1.0, 2.0), &wall).unwrap();
    assert!(found.center.distance(DVec2::new(1.0, 2.0)) < 1e-9);
    // The polygon with 64 corners has slightly less area than the ellipse.
    assert!((found.mean / ellipse.mean - 1.0).abs() < 5e-3);
    assert!(found.stretch.distance(ellipse.stretch) < 0.01);
    assert!(irregularity(&ellipse, &wall) < 1e-12);
}

#[test]
fn rays_that_see_the_blurred_ellipse_tell_its_own_wall() {
    let ellipse = Ellipse { center: DVec2::new(0.2, 0.1), mean: 0.9, stretch: DVec2::new(0.2, 0.1) };
    let boundary = Boundary::new(&ellipse, Whitening::new(DMat2::from_diagonal(DVec2::splat(0.15))));
    let level = 0.5 * boundary.value(ellipse.center);
    let rays: Vec<Ray> = (0..RAYS)
        .map(|n| {
            // Finds the true crossing by bisection.
            let (mut low, mut high) = (0.0, 4.0);
            for _ in 0..40 {
                let middle = f64::midpoint(low, high);
                let value = boundary.value(ellipse.center + direction(n) * middle);
                if value > level { low = middle } else { high = middle }
            }
            Ray {
                edge: Some(low),
                limit: f64::INFINITY,
                bright_at: None,
                brightest: 0.0,
                rim: [0.0; 2],
                outside_at: None,
            }
        })
        .collect();
    for (n, wall) in wall(&ellipse, &boundary, &rays, level).iter().enumerate() {
        let own = ellipse.radius_towards(direction(n));
        assert!((wall - own).abs() < 0.01, "{n}: {wall} instead of {own}");
    }
}

#[test]
fn the_largest_ball_touches_the_nearest_wall_of_its_neighbours() {
    let ring = |at: f64, radius: f64| -> Vec<DVec3> {
        (0..RAYS).map(|n| (direction(n) * radius).extend(at)).collect()
    };
    let at: Vec<f64> = (0..9).map(f64::from).collect();
    let centers: Vec<DVec3> = at.iter().map(|at| DVec3::new(0.0, 0.0, *at)).collect();
    // A tube with a radius of 3 mm, but of 1 mm at arc length 4 mm; the wall is missing at 8 mm.
    let contours: Vec<Vec<DVec3>> = at
        .iter()
        .map(|at| match *at {
            8.0 => Vec::new(),
            4.0 => ring(4.0, 1.0),
            at => ring(at, 3.0),
        })
        .collect();
    let found = inscribed(&at, &centers, &contours);
    for (n, expected) in [3.0, 3.0, 5.0_f64.sqrt(), 2.0_f64.sqrt(), 1.0].into_iter().enumerate() {
        assert!((found[n] - expected).abs() < 1e-9, "{n}: {} instead of {expected}", found[n]);
    }
    assert!(found[8].is_nan());
}
