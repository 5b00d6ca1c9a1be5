//! Tests that lines in order raise no doubt, unlike disorder, stray points, gaps and two lines of one vessel.

use std::f64::consts::TAU;

use super::*;

fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn shuffled<T: Clone>(items: &[T], seed: u64) -> Vec<T> {
    let (mut items, mut next) = (items.to_vec(), numbers(seed));
    for n in (1..items.len()).rev() {
        items.swap(n, (next() * (n + 1) as f64) as usize);
    }
    items
}

fn along(count: usize, at: impl Fn(f64) -> [f64; 3]) -> Vec<DVec3> {
    (0..count).map(|n| DVec3::from(at(n as f64))).collect()
}

fn wavy(count: usize) -> Vec<DVec3> {
    along(count, |t| [6.0 + 8.0 * (t / 20.0).sin(), -3.0 + 4.0 * (t / 25.0).cos(), t])
}

fn doubts(points: &[DVec3]) -> Vec<LineDoubt> {
    order_doubts_of(&[DoubtedLine { points, radius: None, name: "" }])
}

fn kinds(points: &[DVec3]) -> Vec<&'static str> {
    doubts(points).iter().map(|doubt| doubt.kind).collect()
}

fn in_order() -> Vec<(&'static str, Vec<DVec3>)> {
    let helix = |pitch: f64, step: f64| {
        along(400, move |n| {
            let t = n * step / 5.0;
            [5.0 * t.cos(), 5.0 * t.sin(), pitch * t / TAU]
        })
    };
    let trefoil = |count: usize| {
        along(count, move |n| {
            let t = TAU * n / count as f64;
            [t.sin() + 2.0 * (2.0 * t).sin(), t.cos() - 2.0 * (2.0 * t).cos(), -(3.0 * t).sin()]
                .map(|x| 10.0 * x)
        })
    };
    let zigzag = |leg: usize, step: f64, apart: f64| {
        along(20 * leg, move |n| {
            let (row, on) = ((n as usize) / leg, (n as usize) % leg);
            let x = if row % 2 == 0 { on } else { leg - 1 - on };
            [x as f64 * step, row as f64 * apart, 0.0]
        })
    };
    let mut next = numbers(7);
    let mut z = 0.0;
    let mut uneven = Vec::new();
    for _ in 0..200 {
        z += 0.05 + 2.0 * next();
        uneven.push(DVec3::new(3.0 * (z / 9.0_f64).sin(), 0.0, z));
    }
    let mut next = numbers(8);
    let noisy: Vec<DVec3> =
        wavy(300).into_iter().map(|p| p + DVec3::new(next(), next(), next()) * 0.8).collect();
    let folded = along(300, |t| [0.4 * (t - 150.0).abs(), if t < 150.0 { 0.0 } else { 3.0 }, 0.0]);
    let ring = along(200, |n| [20.0 * (TAU * n / 200.0).cos(), 20.0 * (TAU * n / 200.0).sin(), 0.0]);
    vec![
        ("wavy", wavy(70)),
        ("helix", helix(4.0, 0.5)),
        ("tight helix of few points", helix(1.5, 3.0)),
        ("trefoil", trefoil(300)),
        ("trefoil of few points", trefoil(30)),
        ("zigzag", zigzag(25, 1.0, 2.0)),
        ("zigzag of corners", zigzag(2, 20.0, 10.0)),
        ("uneven", uneven),
        ("noisy", noisy),
        ("folded", folded),
        ("ring", ring),
        ("two points", along(2, |t| [0.0, 0.0, 90.0 * t])),
        ("clicks", vec![DVec3::ZERO, DVec3::Z * 3.0, DVec3::Z * 30.0, DVec3::new(9.0, 0.0, 60.0)]),
    ]
}

#[test]
fn lines_in_order_give_no_doubt() {
    for (name, line) in in_order() {
        assert_eq!(doubts(&line), [], "{name}");
        let reversed: Vec<DVec3> = line.into_iter().rev().collect();
        assert_eq!(doubts(&reversed), [], "{name} from its other end");
    }
}

#[test]
fn points_in_another_order_are_doubted() {
    for count in [12, 30, 70, 300] {
        let line = wavy(count);
        for turn in [1, 2, count / 3, count / 2, count - 1] {
            let mut rotated = line.clone();
            rotated.rotate_left(turn);
            assert_eq!(kinds(&rotated), ["order"], "{turn} of {count} points last");
            assert_eq!(doubts(&rotated)[0].mend, Some(OfCenterlines::Reorder.into()));
        }
        for seed in 1..9 {
            assert_eq!(kinds(&shuffled(&line, seed)), ["order"], "{count} points, seed {seed}");
        }
        let every_other: Vec<DVec3> =
            line.iter().step_by(2).chain(line.iter().skip(1).step_by(2)).copied().collect();
        assert_eq!(kinds(&every_other), ["order"], "{count} points, every other one first");
        let mut turned = line.clone();
        turned[count / 3..2 * count / 3].reverse();
        assert_eq!(kinds(&turned), ["order"], "{count} points, the middle third turned round");
    }
    let words = doubts(&shuffled(&wavy(70), 3))[0].words();
    assert!(
        words.contains("a path through its points only 72.4") && words.contains("wrong order"),
        "{words}"
    );
}

#[test]
fn a_shuffled_coil_is_doubted_and_an_unclear_one_has_no_mend() {
    for (name, line) in in_order().into_iter().filter(|(_, line)| line.len() >= 30) {
        let found = doubts(&shuffled(&line, 5));
        assert_eq!(found.iter().map(|doubt| doubt.kind).collect::<Vec<_>>(), ["order"], "{name}");
        assert_eq!(found[0].mend.is_some(), found_order(&line).is_some(), "{name}");
    }
    let ring = in_order().into_iter().find(|(name, _)| *name == "ring").expect("a ring").1;
    assert_eq!(found_order(&ring), None, "a ring begins anywhere");
}

#[test]
fn points_far_from_all_others_are_named() {
    for (n, place) in
        [(20, DVec3::ZERO), (0, DVec3::splat(900.0)), (69, DVec3::splat(-300.0)), (35, DVec3::X * 500.0)]
    {
        let mut line = wavy(70);
        line[n] = place;
        let found = doubts(&line);
        assert_eq!(kinds(&line), ["far"], "point {n} at {place}: {found:?}");
        assert!(found[0].found.contains(&format!("point {n} at (")), "{}", found[0].found);
    }
    let mut line = wavy(70);
    (line[10], line[40]) = (DVec3::splat(400.0), DVec3::splat(400.0));
    assert!(
        doubts(&line)[0].found.contains("2 points (10, 40) lie far from all others"),
        "{:?}",
        doubts(&line)
    );
    let mut disordered = shuffled(&wavy(70), 4);
    disordered[5] = DVec3::splat(400.0);
    assert_eq!(kinds(&disordered), ["far", "order"]);
    assert!(doubts(&disordered).iter().all(|doubt| doubt.mend.is_none()), "first the point goes");
}

#[test]
fn a_part_that_is_missing_is_a_gap() {
    let mut line = wavy(120);
    line.drain(40..80);
    let found = doubts(&line);
    assert_eq!(kinds(&line), ["gap"]);
    assert!(found[0].found.contains("after point 39"), "{}", found[0].found);
    assert_eq!(found[0].mend, None);
}

#[test]
fn many_points_are_looked_at_whatever_their_order() {
    let line = along(100_000, |t| [30.0 * (t / 900.0).sin(), 30.0 * (t / 700.0).cos(), t / 50.0]);
    assert_eq!(kinds(&line), [] as [&str; 0]);
    assert_eq!(kinds(&shuffled(&line, 1)), ["order"]);
    let same = vec![DVec3::ONE; 1000];
    assert_eq!(kinds(&same), [] as [&str; 0]);
}

#[test]
fn points_at_one_place_and_radii_beyond_any_vessel_are_looked_at_in_time() {
    let many = |at: f64| along(100_000, move |n| [at, 0.0, if n < 99_998.0 { 0.0 } else { 1e6 * n }]);
    assert!(doubts(&many(0.0)).len() <= 1);
    let long = |at: f64| along(6, move |n| [at, 0.0, 5e4 * n]);
    let lines = [(long(0.0), Some(1e9)), (long(1.0), Some(1e9)), (long(2.0), None)];
    assert_eq!(beside(&lines), [""; 0], "lines that are shorter than their radii have no stretch");
}

fn beside(lines: &[(Vec<DVec3>, Option<f64>)]) -> Vec<String> {
    let radii: Vec<_> = lines.iter().map(|(points, radius)| radius.map(|r| vec![r; points.len()])).collect();
    let looked_at = lines.iter().zip(&radii).map(|((points, _), radius)| DoubtedLine {
        points,
        radius: radius.as_deref(),
        name: "",
    });
    beside_doubts_of(&looked_at.collect::<Vec<_>>()).into_iter().map(|doubt| doubt.found).collect()
}

#[test]
fn two_lines_of_one_vessel_lie_side_by_side() {
    let mut next = numbers(2);
    let mut jittered = |line: &[DVec3]| -> Vec<DVec3> {
        line.iter().map(|p| *p + (DVec3::new(next(), next(), next()) - 0.5) * 0.4).collect()
    };
    let trunk = along(61, |t| [0.1 * t, 0.0, t]);
    let longer = along(100, |t| [0.1 * t + (t - 60.0).max(0.0), 0.0, t]);
    for radius in [None, Some(2.0), Some(4.0)] {
        let found = beside(&[(jittered(&trunk), radius), (jittered(&longer), radius)]);
        assert_eq!(found.len(), 1, "{found:?}");
        let length = found[0].strip_prefix("vessels 0 and 1 lie side by side over ").expect("the words");
        let length: f64 = length.split(' ').next().expect("a number").parse().expect("a number");
        assert!((length - 60.0).abs() < 4.0, "{found:?}");
        let reversed: Vec<DVec3> = longer.iter().rev().copied().collect();
        assert_eq!(beside(&[(jittered(&trunk), radius), (jittered(&reversed), radius)]).len(), 1);
    }
    let corners = vec![trunk[0], trunk[60]];
    assert_eq!(beside(&[(jittered(&trunk), None), (corners, None)]).len(), 1, "of two points");
}

#[test]
fn vessels_that_meet_cross_or_run_apart_do_not_lie_side_by_side() {
    let line = |from: [f64; 3], step: [f64; 3]| {
        along(80, move |t| [from[0] + step[0] * t, from[1] + step[1] * t, from[2] + step[2] * t])
    };
    let trunk = line([0.0; 3], [0.0, 0.0, 1.0]);
    let cases = [
        ("crossing", line([-40.0, 0.0, 40.0], [1.0, 0.0, 0.0]), Some(3.0)),
        ("branch at 15°", line([0.0; 3], [0.26, 0.0, 0.97]), Some(3.0)),
        ("branch without radius", line([0.0; 3], [0.17, 0.0, 0.98]), None),
        ("artery and vein", line([2.2, 0.0, 0.0], [0.0, 0.0, 1.0]), Some(1.0)),
        ("thin artery and vein", line([0.6, 0.0, 0.0], [0.0, 0.0, 1.0]), Some(0.25)),
        ("continuing", line([0.0, 0.0, 79.0], [0.0, 0.0, 1.0]), Some(3.0)),
    ];
    for (name, other, radius) in cases {
        assert_eq!(beside(&[(trunk.clone(), radius), (other, radius)]), [] as [String; 0], "{name}");
    }
}
