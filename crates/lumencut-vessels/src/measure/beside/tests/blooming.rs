use super::*;

fn free(edge: f64) -> Ray {
    Ray {
        edge: Some(edge),
        limit: f64::INFINITY,
        bright_at: None,
        brightest: 0.0,
        rim: [0.0; 2],
        outside_at: None,
    }
}

fn bright(rim: [f64; 2]) -> Ray {
    Ray { edge: None, limit: rim[0], bright_at: Some(rim[0]), brightest: 3.0, rim, ..free(0.0) }
}

#[test]
fn bounds_are_those_of_the_areas_with_and_without_what_is_bright() {
    // Bright material between 3 and 5 mm covers a quarter of the wall of a lumen with a radius of 4 mm.
    let rays: Vec<Ray> =
        (0..RAYS).map(|n| if n < RAYS / 4 { bright([3.0, 5.0]) } else { free(4.0) }).collect();
    let [low, high] = bounds(&rays, |_| 4.0, 1.0);
    // Blur of 1 mm hides two more rays on each side.
    let hidden = 0.25 + 4.0 / RAYS as f64;
    assert!((low - (1.0 - hidden + hidden * 9.0 / 16.0).sqrt()).abs() < 0.003, "{low}");
    assert!((high - (0.75_f64 + 0.25 * 25.0 / 16.0).sqrt()).abs() < 0.003, "{high}");
}

#[test]
fn what_lies_behind_the_edge_or_far_from_it_bounds_nothing() {
    let behind = Ray { edge: Some(4.0), ..bright([4.5, 6.0]) };
    for ray in [free(4.0), behind, bright([9.0, 10.0])] {
        assert_eq!(bounds(&[ray; RAYS], |_| 4.0, 1.0), [1.0, 1.0]);
    }
}

#[test]
fn the_measured_wall_lies_between_the_bounds_wherever_it_is() {
    for wall in [2.5, 3.5, 6.0] {
        let [low, high] = bounds(&[bright([3.0, 5.0]); RAYS], |_| wall, 1.0);
        assert!((low * wall - wall.min(3.0)).abs() < 1e-9 && (high * wall - wall.max(5.0)).abs() < 1e-9);
    }
}
