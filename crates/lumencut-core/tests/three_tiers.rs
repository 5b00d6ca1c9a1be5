//! The setting `lumen_first` on parallel tubes, in closed form: lumens precede walls, walls precede the rest.
#![allow(clippy::unwrap_used)]

use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_scenes::brute_force::by_hierarchy;
use lumencut_scenes::compare::different_pixels;
use lumencut_scenes::random::Random;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::settings::unfiltered;
use lumencut_scenes::trees::{tree, vessel};
use lumencut_scenes::views::{front, pixel, view};

#[derive(Clone, Copy)]
struct Tube {
    height: f64,
    depth: f64,
    radius: f64,
}

impl Tube {
    fn vessel(self) -> Vessel {
        vessel(&[[-500.0, self.depth, self.height], [500.0, self.depth, self.height]], self.radius)
    }

    /// Distance of the height `y` in the view from the tube's lumen (mm).
    fn beyond(self, y: f64, settings: &Settings) -> f64 {
        let is_known = settings.preserve_lumen && self.radius > 0.0;
        let radius = if is_known { self.radius } else { settings.unknown_radius };
        (y - self.height).abs() - radius
    }

    /// The tier at a height, and the number that orders tubes within the tier.
    fn key(self, y: f64, settings: &Settings) -> (u8, f64) {
        let beyond = self.beyond(y, settings);
        if beyond <= 0.0 {
            (0, self.depth)
        } else if beyond <= settings.lumen_margin {
            (1, self.depth)
        } else {
            (2, self.depth + settings.cost_weight * beyond)
        }
    }
}

/// The height of the view in pixels of [`SIDE`] mm.
const ROWS: usize = 800;
const SIDE: f64 = 0.1;

/// The vessel shown at each height of the view, from the top.
fn shown(tubes: &[Tube], settings: &Settings) -> Vec<(f64, i32)> {
    let scene = tree(tubes.iter().map(|tube| tube.vessel()).collect());
    let camera = front([3, ROWS], SIDE);
    let frame = by_hierarchy(&scene, &camera, settings);
    (0..ROWS).map(|j| (camera.view_y(j), frame.vessel[j * 3 + 1])).collect()
}

/// The vessels shown at some heights (mm).
fn at(tubes: &[Tube], settings: &Settings, heights: &[f64]) -> Vec<i32> {
    let frame = by_hierarchy(
        &tree(tubes.iter().map(|tube| tube.vessel()).collect()),
        &front([3, ROWS], SIDE),
        settings,
    );
    heights.iter().map(|y| frame.vessel[pixel(&frame, 0.0, *y)]).collect()
}

fn tube(height: f64, depth: f64, radius: f64) -> Tube {
    Tube { height, depth, radius }
}

#[test]
fn lumen_beats_wall_and_wall_beats_surroundings_whatever_the_depth() {
    // Heights: far tube, lumen to 2, wall to 2.75; nearer tube, wall from 2.75, lumen from 3.5; nearest tube above.
    let tubes = [tube(0.0, 1000.0, 2.0), tube(5.0, 500.0, 1.5), tube(12.0, -900.0, 0.5)];
    let thin_wall = Settings { lumen_margin: 0.75, ..unfiltered() };
    assert_eq!(
        at(&tubes, &thin_wall, &[0.05, 1.95, 2.65, 3.15, 3.55, 6.45, 11.55, 12.55]),
        [0, 0, 0, 1, 1, 1, 2, 2]
    );
    assert_eq!(at(&tubes, &thin_wall, &[7.15, 7.35, -2.65, -2.85]), [1, 2, 0, 2]);
    // The walls overlap between 2.5 and 3, and the nearer wins; the farther lumen beats the nearer wall.
    let wall = Settings { lumen_margin: 1.0, ..unfiltered() };
    assert_eq!(at(&tubes, &wall, &[2.45, 2.55, 2.95]), [0, 1, 1]);
    let thick_wall = Settings { lumen_margin: 6.0, ..unfiltered() };
    assert_eq!(
        at(&tubes, &thick_wall, &[1.95, 2.05, 3.45, 3.55, 5.45, 5.55, 6.45, 6.55]),
        [0, 1, 1, 1, 1, 1, 1, 2]
    );
}

#[test]
fn within_lumen_and_within_wall_the_nearest_wins() {
    let tubes = [tube(0.0, 40.0, 8.0), tube(1.0, -40.0, 3.0), tube(-1.0, 0.0, 5.0)];
    assert_eq!(
        at(&tubes, &unfiltered(), &[3.95, 0.05, -1.95, -2.05, -5.95, -6.05, -7.95]),
        [1, 1, 1, 2, 2, 0, 0]
    );
    // Above 9 there is no lumen, and the three walls end at 12, 13 and 12.5.
    let walls = Settings { lumen_margin: 4.0, ..unfiltered() };
    let above = [tube(0.0, 40.0, 8.0), tube(6.0, 0.0, 3.0), tube(6.0, -40.0, 2.5)];
    assert_eq!(at(&above, &walls, &[9.05, 12.45, 12.55, 12.95]), [2, 2, 1, 1]);
}

#[test]
fn without_margin_there_is_no_wall() {
    // Just above the farther lumen the nearer tube's surroundings cost 10·(6 − 2) = 40; the farther's, 100.
    let tubes = [tube(0.0, 100.0, 3.0), tube(9.0, 0.0, 2.0)];
    let none = Settings { lumen_margin: 0.0, ..unfiltered() };
    let some = Settings { lumen_margin: 0.5, ..unfiltered() };
    assert_eq!(at(&tubes, &none, &[2.95, 3.05, 3.45, 3.55]), [0, 1, 1, 1]);
    assert_eq!(at(&tubes, &some, &[2.95, 3.05, 3.45, 3.55]), [0, 0, 0, 1]);
}

#[test]
fn a_line_without_radius_keeps_its_own_centerline_before_a_deeper_lumen() {
    let line = Vessel::new(vessel(&[[-500., 0., 0.], [500., 0., 0.]], 1.0).points().to_vec(), None).unwrap();
    let of_zero = tube(0.0, 0.0, 0.0).vessel();
    let deeper = tube(0.0, 100.0, 4.0).vessel();
    for thin in [line, of_zero] {
        let scene = tree(vec![deeper.clone(), thin]);
        let ids = |unknown_radius: f64| {
            let settings = Settings { unknown_radius, ..unfiltered() };
            let frame = by_hierarchy(&scene, &front([3, ROWS], SIDE), &settings);
            [0.05, 0.95, 1.05, 2.45, 2.55, 3.95].map(|y| frame.vessel[pixel(&frame, 0.0, y)])
        };
        assert_eq!(ids(1.0), [1, 1, 0, 0, 0, 0]);
        assert_eq!(ids(2.5), [1, 1, 1, 1, 0, 0]);
        assert_eq!(ids(0.0), [0; 6], "nothing of its own");
    }
}

#[test]
fn lumen_that_is_not_preserved_counts_as_without_radius() {
    let scene = random_tree(51, 9, 40, 2.0, 50.0).unwrap();
    let bare = scene.vessels().iter().map(|v| Vessel::new(v.points().to_vec(), None).unwrap());
    let bare: VesselTree = tree(bare.collect());
    let camera = view([0.3, 1.0, -0.4], [70, 60], 1.6);
    for unknown_radius in [0.0, 1.5] {
        let known = Settings { unknown_radius, ..unfiltered() };
        let lost = Settings { preserve_lumen: false, ..known.clone() };
        let [a, b] = [(&scene, &lost), (&bare, &known)].map(|(tree, s)| by_hierarchy(tree, &camera, s));
        assert_eq!(different_pixels(&a, &b), 0);
        assert_ne!(a.vessel, by_hierarchy(&scene, &camera, &known).vessel, "radii change nothing");
    }
}

fn tiers(random: &mut Random) -> Settings {
    Settings {
        lumen_margin: if random.once_in(3) { 0.0 } else { random.number() * 4.0 },
        unknown_radius: if random.once_in(3) { 0.0 } else { random.number() * 3.0 },
        preserve_lumen: !random.once_in(4),
        cost_weight: random.number() * 20.0,
        ..unfiltered()
    }
}

fn random_tubes(random: &mut Random) -> Vec<Tube> {
    let one = |_| Tube {
        height: random.number() * 60.0 - 30.0,
        depth: random.number() * 200.0 - 100.0,
        radius: if random.once_in(4) { 0.0 } else { random.number() * 8.0 },
    };
    (0..7).map(one).collect()
}

#[test]
fn parallel_tubes_show_what_the_tiers_say() {
    let mut random = Random::new(12);
    let (mut certain, mut seen) = (0, [false; 3]);
    for _ in 0..60 {
        let (settings, tubes) = (tiers(&mut random), random_tubes(&mut random));
        for (y, found) in shown(&tubes, &settings) {
            let best = |y: f64| {
                let keys = tubes.iter().enumerate().map(|(id, tube)| (tube.key(y, &settings), id as i32));
                keys.min_by(|a, b| a.0.0.cmp(&b.0.0).then(a.0.1.total_cmp(&b.0.1))).unwrap()
            };
            let ((tier, _), expected) = best(y);
            // Heights at a border are left out, because rounding decides there.
            if [y - 1e-3, y + 1e-3].iter().all(|beside| best(*beside).1 == expected) {
                assert_eq!(found, expected, "at y = {y}, tier {tier}, {settings:?}");
                certain += 1;
                seen[usize::from(tier)] = true;
            }
        }
    }
    assert!(certain > 60 * ROWS * 9 / 10 && seen == [true; 3], "{certain} pixels, tiers {seen:?}");
}
