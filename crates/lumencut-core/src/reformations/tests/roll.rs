use super::*;

/// A wall of an ellipse with half axes of 6 and 3 mm; the longer axis turns along the vessel.
fn ellipse(length: f64, turned: impl Fn(f64) -> f64) -> Wall {
    let at: Vec<f64> = (0..=(2.0 * length) as usize).map(|n| n as f64 / 2.0).collect();
    let polar = |t: f64| 18.0 / (9.0 * t.cos().powi(2) + 36.0 * t.sin().powi(2)).sqrt();
    let radius: Vec<f64> = at
        .iter()
        .flat_map(|at| {
            let turn = turned(*at);
            (0..360).map(move |k| polar(f64::from(k).to_radians() - turn))
        })
        .collect();
    let open = vec![false; radius.len()];
    Wall::new(at, radius, open).unwrap()
}

fn diameter(wall: &Wall, at: f64, around: f64) -> f64 {
    wall.radius(at, around) + wall.radius(at, around + PI)
}

#[test]
fn it_follows_an_ellipse_that_turns() {
    let wall = ellipse(50.0, |at| 0.3 + at / 50.0 * PI / 2.0);
    let narrow = Roll::following(&wall, 50.0, Side::Narrowest);
    let wide = Roll::following(&wall, 50.0, Side::Widest);
    for n in 0..=500 {
        let at = f64::from(n) / 10.0;
        let [least, most] = [&narrow, &wide].map(|roll| diameter(&wall, at, roll.angle(at)));
        assert!(least < 6.04, "{least} mm at {at} mm");
        // The ellipse bends more at its wide side, so the same angle in degrees is more mm there.
        assert!(most > 11.7, "{most} mm at {at} mm");
        assert!((narrow.angle(at) - narrow.angle((at - 0.5).max(0.0))).abs() <= PI / 48.0 + 1e-12);
    }
}

#[test]
fn where_all_sides_are_alike_it_stays() {
    let wall = Wall::new(vec![0.0, 30.0], vec![4.0; 2], vec![false; 2]).unwrap();
    for side in [Side::Narrowest, Side::Widest] {
        let roll = Roll::following(&wall, 30.0, side);
        assert!((0..=30).all(|at| roll.angle(f64::from(at)) == 0.0));
    }
}

#[test]
fn it_goes_on_through_whole_turns() {
    let wall = ellipse(200.0, |at| at / 50.0 * PI / 2.0);
    let roll = Roll::following(&wall, 200.0, Side::Narrowest);
    assert!((roll.angle(190.0) - roll.angle(10.0) - 180.0 / 50.0 * PI / 2.0).abs() < 0.1);
}

#[test]
fn the_cheapest_way_is_that_of_all_ways() {
    // Tries all paths of five positions with few directions, and compares the costs.
    let random = |n: usize| ((n as f64 * 12.9898).sin() * 43758.5453).fract().abs();
    let cost: Vec<Vec<f64>> = (0..DIRECTIONS).map(|k| (0..5).map(|n| random(k * 5 + n)).collect()).collect();
    let total = |way: &[i32]| -> f64 {
        let own = |(n, k): (usize, &i32)| cost[k.rem_euclid(DIRECTIONS as i32) as usize][n];
        let changes: i32 = way.windows(2).map(|ends| (ends[1] - ends[0]).abs()).sum();
        way.iter().enumerate().map(own).sum::<f64>() + CHANGE_COST_MM * f64::from(changes)
    };
    let mut least = f64::INFINITY;
    for start in 0..DIRECTIONS as i32 {
        for steps in 0..81 {
            let mut way = vec![start];
            for n in 0..4 {
                way.push(way[n as usize] + steps / 3i32.pow(n) % 3 - 1);
            }
            least = least.min(total(&way));
        }
    }
    assert!((total(&cheapest(&cost)) - least).abs() < 1e-12);
}

#[test]
fn rolls_that_are_none_are_refused() {
    for (at, angle) in
        [(vec![], vec![]), (vec![0.0], vec![f64::NAN]), (vec![1.0, 1.0], vec![0.0; 2]), (vec![0.0], vec![])]
    {
        assert!(Roll::new(at, angle).is_err());
    }
}
