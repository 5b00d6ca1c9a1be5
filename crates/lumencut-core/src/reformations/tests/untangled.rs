use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::*;
use crate::stop::NEVER;
use crate::vessel_tree::Vessel;

fn go() -> bool {
    false
}

fn front() -> Camera {
    Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [64, 64], 1.0).unwrap()
}

fn tree(vessels: &[(&[[f64; 3]], f64)]) -> VesselTree {
    let vessel = |(points, radius): &(&[[f64; 3]], f64)| {
        let points: Vec<DVec3> = points.iter().map(|point| DVec3::from_array(*point)).collect();
        let radius = vec![*radius; points.len()];
        Vessel::new(points, Some(radius)).unwrap()
    };
    VesselTree::new(vessels.iter().map(vessel).collect()).unwrap()
}

fn untangled(tree: &VesselTree, changes: UntangledParameters) -> Untangled {
    Untangled::new(tree, &front(), changes, &go).unwrap()
}

fn length(part: &LaidOut, spacing: f64) -> f64 {
    part.pixels.windows(2).map(|ends| ends[0].distance(ends[1]) * spacing).sum()
}

const PIXEL: f64 = 0.5;

/// Random numbers from 0 to 1 by splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let at = DVec3::new(self.next(), self.next(), self.next()) * 2.0 - 1.0;
            if (0.01..1.0).contains(&at.length()) {
                return at.normalize();
            }
        }
    }
}

fn random_tree(random: &mut Random, count: usize) -> VesselTree {
    let mut vessels = Vec::new();
    let mut waiting = std::collections::VecDeque::from([(DVec3::ZERO, DVec3::NEG_Z, 4.0)]);
    while let (true, Some((mut at, mut along, radius))) = (vessels.len() < count, waiting.pop_front()) {
        let bend = random.direction() * 0.02;
        let mut points = vec![at];
        for _ in 0..40 {
            at += along;
            along = (along + bend).normalize();
            points.push(at);
        }
        let radii = vec![radius; points.len()];
        vessels.push(Vessel::new(points, Some(radii)).unwrap());
        for _ in 0..2 {
            waiting.push_back((
                at,
                (along + random.direction() * 0.8).normalize(),
                f64::max(radius * 0.8, 1.0),
            ));
        }
    }
    VesselTree::new(vessels).unwrap()
}

fn planar_fork() -> VesselTree {
    tree(&[
        (&[[0.0, 5.0, 40.0], [0.0, 5.0, 0.0]], 3.0),
        (&[[0.0, 5.0, 0.0], [30.0, 5.0, -30.0]], 2.0),
        (&[[0.0, 5.0, 0.0], [-20.0, 5.0, -20.0], [-20.0, 5.0, -60.0]], 2.0),
    ])
}

#[test]
fn a_tree_in_the_plane_of_the_view_is_shown_as_it_is() {
    let made =
        untangled(&planar_fork(), UntangledParameters { smoothing: 0.0, ..UntangledParameters::new(PIXEL) });
    assert_eq!(made.rotations(), [0.0; 3]);
    assert!(made.overlaps().is_empty());
    let origin = made.pixel_from_world(DVec3::new(0.0, 5.0, 0.0));
    let (curved, [width, _]) = (made.curved(NEVER).unwrap(), made.size());
    let folded = made.folded(NEVER).unwrap();
    for (n, point) in curved.position().iter().enumerate().filter(|(_, point)| point.is_finite()) {
        let from = (DVec2::new((n % width) as f64, (n / width) as f64) - origin) * PIXEL;
        let expected = DVec3::new(from.x, 5.0, -from.y);
        assert!(point.distance(expected) < 1e-9, "{n}: {point} instead of {expected}");
        assert!(!folded[n]);
        assert!(curved.slab_direction()[n].as_dvec3().distance(DVec3::Y) < 1e-6);
    }
    for (vessel, point) in made.vessel(NEVER).unwrap().iter().zip(curved.position()) {
        assert_eq!(*vessel >= 0, point.is_finite());
    }
}

#[test]
fn lengths_are_true_whatever_the_smoothing() {
    let turn = |t: f64| DVec3::new(10.0 * t.cos(), 10.0 * t.sin(), -4.0 * t);
    let points: Vec<DVec3> = (0..=600).map(|n| turn(TAU * 3.0 * f64::from(n) / 600.0)).collect();
    let vessel = Vessel::new(points, Some(vec![2.0; 601])).unwrap();
    let whole = vessel.arc_length()[600];
    let helix = VesselTree::new(vec![vessel]).unwrap();
    for smoothing in [0.0, 4.0, 30.0] {
        let made = untangled(&helix, UntangledParameters { smoothing, ..UntangledParameters::new(PIXEL) });
        assert_eq!(made.laid_out().len(), 1);
        assert!((length(&made.laid_out()[0], PIXEL) - whole).abs() < 1e-9);
    }
}

#[test]
fn two_vessels_one_before_the_other_turn_apart_by_the_same_angle() {
    let twins = tree(&[
        (&[[0.0, 0.0, 30.0], [0.0, 0.0, 0.0]], 3.0),
        (&[[0.0, 0.0, 0.0], [0.0, 20.0, -40.0]], 3.0),
        (&[[0.0, 0.0, 0.0], [0.0, -20.0, -40.0]], 3.0),
    ]);
    let made = untangled(&twins, UntangledParameters::new(PIXEL));
    let [none, first, second] = made.rotations().try_into().unwrap();
    // The bound sets sectors apart completely; hulls need less, as only their discs must not overlap.
    let most = (5.0f64 / (1.5 * 5.0 + 2.0)).asin();
    assert_eq!(none, 0.0);
    assert!(made.overlaps().is_empty());
    assert!(
        (first + second).abs() < 1e-12 && first < 0.0 && second <= most + 1e-9,
        "{first} {second} {most}"
    );
    assert!((second - most).abs() < 1e-3, "{second} instead of {most}");
}

#[test]
fn sectors_move_by_the_least_sum_of_squares() {
    let sector = |low: f64, high: f64| sectors::Sector { low, high };
    let room = sector(-PI, PI);
    let half = 0.4;
    let two = sectors::turns(&[sector(-half, half), sector(-half, half)], room);
    assert!((two[0] + half).abs() < 1e-12 && (two[1] - half).abs() < 1e-12);
    assert_eq!(sectors::turns(&[sector(-1.0, -0.5), sector(0.5, 1.0)], room), [0.0, 0.0]);
    let three = sectors::turns(&[sector(0.0, 0.6), sector(-0.5, 0.1), sector(2.0, 3.0)], room);
    assert!((three[0] - 0.05).abs() < 1e-12 && (three[1] + 0.05).abs() < 1e-12 && three[2] == 0.0);
    let narrow = sectors::turns(&[sector(-0.5, 0.5), sector(1.0, 2.0)], sector(-0.2, 1.8));
    assert!((narrow[0] - 0.3).abs() < 1e-12 && (narrow[1] + 0.2).abs() < 1e-12);
}

/// The last vessel common to the paths from the root to two vessels; vessel n has children 2n + 1 and 2n + 2.
fn common([mut first, mut second]: [usize; 2]) -> usize {
    while first != second {
        let later = if first > second { &mut first } else { &mut second };
        *later = (*later - 1) / 2;
    }
    first
}

/// Asserts that hulls of two vessels overlap only near the point at which the paths to them part.
fn assert_apart(made: &Untangled, tree: &VesselTree, pair: [usize; 2]) {
    let radius = |vessel: usize| tree.vessels()[vessel].radius_or_zero(0) + 2.0;
    let parting = common(pair);
    let node = *made.laid_out()[parting].pixels.last().unwrap() * PIXEL;
    let within = made.may_overlap_within(radius(parting));
    let [hull, other] = pair.map(|vessel| -> Vec<DVec2> {
        let places = made.laid_out()[vessel].pixels.iter().map(|pixel| *pixel * PIXEL);
        places.filter(|place| place.distance(node) >= within).collect()
    });
    for place in hull {
        for other in &other {
            let apart = place.distance(*other) - radius(pair[0]) - radius(pair[1]);
            assert!(apart > -1e-6, "vessels {pair:?} overlap by {apart} mm");
        }
    }
}

#[test]
fn no_hulls_overlap_beyond_branching_points_in_many_views() {
    let mut random = Random(7);
    let mut clear = 0;
    for n in 0..1000 {
        let count = 3 + n % 7;
        let tree = random_tree(&mut random, count);
        let camera = Camera::new(DVec3::ZERO, random.direction(), random.direction(), [8, 8], 1.0).unwrap();
        let made = Untangled::new(&tree, &camera, UntangledParameters::new(PIXEL), &go).unwrap();
        if !made.overlaps().is_empty() {
            continue;
        }
        clear += 1;
        let parts = made.laid_out();
        for second in 1..parts.len() {
            for first in 0..second {
                assert_apart(&made, &tree, [first, second]);
            }
        }
    }
    assert!(clear > 990, "{clear} of 1000 views without overlap");
}

#[test]
fn places_in_the_image_and_in_the_world_agree_both_ways() {
    let mut random = Random(3);
    for _ in 0..5 {
        let tree = random_tree(&mut random, 7);
        let camera = Camera::new(DVec3::ZERO, random.direction(), random.direction(), [8, 8], 1.0).unwrap();
        let made = Untangled::new(&tree, &camera, UntangledParameters::new(PIXEL), &go).unwrap();
        let (curved, folded, [width, _]) =
            (made.curved(NEVER).unwrap(), made.folded(NEVER).unwrap(), made.size());
        let (mut met, mut back) = (0, 0);
        for n in (0..folded.len()).step_by(37) {
            let (pixel, point) = (DVec2::new((n % width) as f64, (n / width) as f64), curved.position()[n]);
            assert!(made.world_from_pixel(pixel).distance(point) < 1e-9 || point.is_nan());
            if folded[n] || point.is_nan() {
                continue;
            }
            let found = made.pixel_from_world(point);
            met += 1;
            back += usize::from(found.distance(pixel) < 1e-5);
        }
        assert!(met > 100 && back == met, "{back} of {met}");
    }
}

#[test]
fn a_cycle_is_cut_open_where_the_longer_way_ends() {
    let ring = tree(&[
        (&[[0.0, 0.0, 40.0], [0.0, 0.0, 0.0]], 3.0),
        (&[[0.0, 0.0, 0.0], [20.0, 0.0, -20.0], [0.0, 0.0, -40.0]], 2.0),
        (&[[0.0, 0.0, 0.0], [-30.0, 0.0, -20.0], [0.0, 0.0, -40.0]], 2.0),
        (&[[0.0, 0.0, -40.0], [0.0, 0.0, -80.0]], 2.0),
    ]);
    let made = untangled(&ring, UntangledParameters::new(PIXEL));
    assert_eq!(made.closures().len(), 1);
    let [end, other] = made.closures()[0];
    let parts = made.laid_out();
    assert_eq!(end, *parts[2].pixels.last().unwrap());
    assert_eq!(other, *parts[1].pixels.last().unwrap());
    assert_eq!(other, parts[3].pixels[0]);
}

#[test]
fn a_tree_that_is_one_loop_needs_a_root() {
    let square = [[0.0, 0.0, 0.0], [40.0, 0.0, 0.0], [40.0, 0.0, 40.0], [0.0, 0.0, 40.0], [0.0, 0.0, 0.0]];
    let ring = tree(&[(&square, 2.0)]);
    let error = Untangled::new(&ring, &front(), UntangledParameters::new(PIXEL), &go).err().unwrap();
    assert_eq!(error.kind, ErrorKind::VesselTree);
    assert!(error.to_string().contains("loop"), "{error}");
    let root = Some(DVec3::ZERO);
    let made = untangled(&ring, UntangledParameters { root, ..UntangledParameters::new(PIXEL) });
    assert_eq!(made.closures(), [[*made.laid_out()[0].pixels.last().unwrap(), made.laid_out()[0].pixels[0]]]);
}

#[test]
fn parts_lie_beside_each_other_from_left_to_right() {
    let loose = tree(&[
        (&[[2.0, 0.0, 40.0], [2.0, 0.0, 0.0]], 2.0),
        (&[[-1.0, 30.0, 60.0], [-1.0, 30.0, 10.0]], 2.0),
        (&[[200.0, 0.0, 40.0], [200.0, 0.0, 0.0]], 2.0),
    ]);
    let made = untangled(&loose, UntangledParameters::new(PIXEL));
    let x = |n: usize| made.laid_out()[n].pixels[0].x * PIXEL;
    assert!((x(0) - x(1) - 18.0).abs() < 1e-9, "two hulls of 4 mm and 10 mm between them");
    assert!((x(2) - x(1) - 201.0).abs() < 1e-9, "as seen");
    assert!((made.laid_out()[0].pixels[0].y - made.laid_out()[1].pixels[0].y - 40.0).abs() < 1e-9);
}

#[test]
fn it_grows_from_the_widest_free_end_or_from_a_named_one() {
    let fork = planar_fork();
    let made = untangled(&fork, UntangledParameters::new(PIXEL));
    assert!(made.laid_out().iter().all(|part| !part.is_reversed));
    let root = Some(DVec3::new(30.0, 5.0, -31.0));
    let made = untangled(&fork, UntangledParameters { root, ..UntangledParameters::new(PIXEL) });
    let reversed: Vec<bool> = made.laid_out().iter().map(|part| part.is_reversed).collect();
    assert_eq!(reversed, [true, true, false]);
    // Of equally wide free ends, the first end of the first vessel is the root.
    let line = tree(&[(&[[0.0, 0.0, 0.0], [0.0, 0.0, 30.0]], 2.0)]);
    assert!(!untangled(&line, UntangledParameters::new(PIXEL)).laid_out()[0].is_reversed);
}

#[test]
fn a_vessel_along_the_view_and_one_that_branches_off_its_middle_are_laid_out() {
    let side = tree(&[
        (&[[0.0, 0.0, 40.0], [0.0, 0.0, 10.0], [0.0, 0.0, -40.0]], 3.0),
        (&[[0.0, 0.0, 10.0], [0.0, 50.0, 10.0]], 2.0),
    ]);
    let made = untangled(&side, UntangledParameters::new(PIXEL));
    assert_eq!(made.laid_out().len(), 3);
    assert!(made.overlaps().is_empty());
    let along = &made.laid_out()[2];
    assert!((length(along, PIXEL) - 50.0).abs() < 1e-9);
    assert!(along.turn.abs() > 0.1 && along.turn.abs() < FRAC_PI_2);
    assert_eq!(made.rotations()[1], along.turn);
}

#[test]
fn the_same_tree_gives_the_same_layout_to_the_bit() {
    let tree = random_tree(&mut Random(11), 9);
    let [first, second] = [(); 2].map(|()| untangled(&tree, UntangledParameters::new(PIXEL)));
    assert_eq!(first.laid_out(), second.laid_out());
    let bits = |made: &Untangled| -> Vec<u64> {
        made.curved(NEVER).unwrap().position().iter().map(|point| point.x.to_bits()).collect()
    };
    assert_eq!(bits(&first), bits(&second));
}

#[test]
fn bad_input_is_named() {
    let fork = planar_fork();
    let wrong = |changes: UntangledParameters| Untangled::new(&fork, &front(), changes, &go).err().unwrap();
    let right = UntangledParameters::new(PIXEL);
    for (changes, name) in [
        (UntangledParameters { width: 0.0, ..right }, "width"),
        (UntangledParameters { hull_margin: -1.0, ..right }, "hull_margin"),
        (UntangledParameters { smoothing: f64::NAN, ..right }, "smoothing"),
        (UntangledParameters { pixel_spacing: 0.0, ..right }, "pixel_spacing"),
        (UntangledParameters { pixel_spacing: 1e-4, ..right }, "size"),
        (UntangledParameters { root: Some(DVec3::NAN), ..right }, "root"),
    ] {
        let error = wrong(changes);
        assert_eq!(error.kind, ErrorKind::Camera);
        assert!(error.subject.starts_with(name), "{error}");
    }
    let point = tree(&[(&[[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], 2.0)]);
    let error = Untangled::new(&point, &front(), right, &go).err().unwrap();
    assert_eq!(error.subject, "vessel 0 of the tree");
    let stopped = Untangled::new(&fork, &front(), right, &|| true).err().unwrap();
    assert_eq!(stopped.kind, ErrorKind::Interrupted);
}

#[test]
fn other_pixels_show_the_same_layout_and_places_tell_their_vessel() {
    let tree = random_tree(&mut Random(5), 5);
    let fine = untangled(&tree, UntangledParameters::new(0.5));
    let coarse = fine.with_pixels(1.0).unwrap();
    let made = untangled(&tree, UntangledParameters::new(1.0));
    assert_eq!((coarse.size(), coarse.parameters()), (made.size(), made.parameters()));
    assert_eq!(coarse.vessel(NEVER).unwrap(), made.vessel(NEVER).unwrap());
    for (part, same) in coarse.laid_out().iter().zip(made.laid_out()) {
        assert!(part.pixels.iter().zip(&same.pixels).all(|(one, other)| one.distance(*other) < 1e-9));
    }
    for part in fine.laid_out() {
        let n = part.pixels.len() / 2;
        let (vessel, at) = fine.vessel_at(part.pixels[n]).unwrap();
        assert_eq!(vessel, part.vessel);
        assert!((at - part.arc_length[n]).abs() < 1e-6);
    }
    assert!(fine.vessel_at(DVec2::splat(-1e4)).is_none());
    for (vessel, end) in fine.ends().into_iter().enumerate() {
        let last = tree.vessels()[vessel].points().last().unwrap();
        assert!(fine.world_from_pixel(end).distance(*last) < 1e-6);
    }
    assert!(fine.with_pixels(0.0).is_err());
}
