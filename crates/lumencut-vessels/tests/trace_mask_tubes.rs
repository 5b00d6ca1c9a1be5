//! Traces masks of tubes with known axes, radii, pieces and cycles, on grids of any kind.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::volume::Voxels;
use lumencut_vessels::trace::mask::{MaskRequest, TracedMask, trace_mask};

type Tubes<'a> = &'a [(&'a [[f64; 3]], f64)];

struct Mask {
    size: [usize; 3],
    affine: DAffine3,
    cells: Vec<u8>,
}

impl Mask {
    fn new(size: [usize; 3], affine: DAffine3, tubes: Tubes) -> Self {
        let is_within = |place: DVec3, from: DVec3, to: DVec3, radius: f64| {
            let way = to - from;
            let share = ((place - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            place.distance(from + way * share) <= radius
        };
        let is_lumen = |n: usize| {
            let index = [n % size[0], n / size[0] % size[1], n / (size[0] * size[1])].map(|c| c as f64);
            let place = affine.transform_point3(index.into());
            tubes.iter().any(|(line, radius)| {
                line.windows(2).any(|ends| is_within(place, ends[0].into(), ends[1].into(), *radius))
            })
        };
        let cells = (0..size.iter().product()).map(|n| u8::from(is_lumen(n))).collect();
        Self { size, affine, cells }
    }

    fn cubes(tubes: Tubes) -> Self {
        Self::new([40; 3], DAffine3::IDENTITY, tubes)
    }

    fn traced(&self) -> TracedMask {
        let volume = lumencut_scenes::volumes::volume(Voxels::U8(&self.cells), self.size, self.affine);
        let (labels, refine, progress) = (None, None, None);
        let stop = &|| false;
        let request =
            MaskRequest { labels, parent_radii: 2.0, step: 0.5, bridge: 0.0, refine, stop, progress };
        trace_mask(&volume, &request).unwrap()
    }
}

/// Pieces and cycles of the lines, which meet at bit-identical end points.
fn topology(found: &TracedMask) -> [usize; 2] {
    let key = |point: &DVec3| point.to_array().map(f64::to_bits);
    let mut ends: Vec<[u64; 3]> = Vec::new();
    let mut of = |point: &DVec3| {
        let key = key(point);
        ends.iter().position(|end| *end == key).unwrap_or_else(|| {
            ends.push(key);
            ends.len() - 1
        })
    };
    let pairs: Vec<[usize; 2]> = found
        .vessels
        .iter()
        .map(|vessel| [of(&vessel.points[0]), of(&vessel.points[vessel.points.len() - 1])])
        .collect();
    let mut piece: Vec<usize> = (0..ends.len()).collect();
    for [a, b] in &pairs {
        let (from, to) = (piece[*a], piece[*b]);
        piece.iter_mut().filter(|one| **one == from).for_each(|one| *one = to);
    }
    let pieces = (0..ends.len()).filter(|n| piece[*n] == *n).count();
    [pieces, pairs.len() + pieces - ends.len()]
}

const ACROSS: [&[[f64; 3]]; 2] =
    [&[[20.0, 5.0, 20.0], [20.0, 35.0, 20.0]], &[[5.0, 20.0, 20.0], [35.0, 20.0, 20.0]]];

fn ring() -> Vec<[f64; 3]> {
    let at = |n: u32| std::f64::consts::TAU * f64::from(n) / 60.0;
    (0..=60).map(|n| [20.0 + 12.0 * at(n).cos(), 20.0 + 12.0 * at(n).sin(), 20.0]).collect()
}

#[test]
fn pieces_and_cycles_stay() {
    let ring = ring();
    let spoke: &[[f64; 3]] = &[[8.0, 20.0, 20.0], [32.0, 20.0, 20.0]];
    let apart: [&[[f64; 3]]; 2] =
        [&[[5.0, 8.0, 8.0], [35.0, 8.0, 8.0]], &[[5.0, 30.0, 30.0], [35.0, 30.0, 30.0]]];
    let alone: [&[[f64; 3]]; 2] = [&ring, spoke];
    let cases = [
        (&ACROSS[..1], [1, 0]),
        (&alone[..1], [1, 1]),
        (&alone[..], [1, 2]),
        (&ACROSS[..], [1, 0]),
        (&apart[..], [2, 0]),
    ];
    for (lines, expected) in cases {
        let tubes: Vec<(&[[f64; 3]], f64)> = lines.iter().map(|line| (*line, 2.6)).collect();
        let found = Mask::cubes(&tubes).traced();
        assert_eq!(topology(&found), expected);
        assert_eq!(found.gaps.len(), expected[0] - 1);
    }
}

#[test]
fn points_are_close_and_ends_reach_the_caps() {
    let found = Mask::cubes(&[(&[[6.0, 20.0, 20.0], [34.0, 20.0, 20.0]], 4.3)]).traced();
    let [vessel] = &found.vessels[..] else { panic!("{} vessels", found.vessels.len()) };
    assert!(vessel.points.windows(2).all(|two| two[0].distance(two[1]) <= 0.5 + 1e-9));
    let [first, last] = [vessel.points[0].x, vessel.points[vessel.points.len() - 1].x];
    assert!((first.min(last) - 1.5).abs() <= 0.5 && (first.max(last) - 38.5).abs() <= 0.5, "{first} {last}");
    for (point, radius) in vessel.points.iter().zip(&vessel.radius) {
        assert!((point.y - 20.0).abs() < 0.02 && (point.z - 20.0).abs() < 0.02, "{point}");
        assert!(!(8.0..32.0).contains(&point.x) || (radius - 4.3).abs() < 0.2, "{point} {radius}");
    }
}

#[test]
fn vessels_that_meet_share_their_ends() {
    let found = Mask::cubes(&[(ACROSS[0], 2.6), (ACROSS[1], 2.6)]).traced();
    let ends: Vec<DVec3> =
        found.vessels.iter().flat_map(|one| [one.points[0], one.points[one.points.len() - 1]]).collect();
    let times = |end: &DVec3| ends.iter().filter(|other| *other == end).count();
    let shared: Vec<&DVec3> = ends.iter().filter(|end| times(end) > 1).collect();
    assert_eq!(shared.len(), 4);
    assert!(shared.iter().all(|end| **end == *shared[0] && end.distance(DVec3::splat(20.0)) < 0.9));
}

#[test]
fn vessels_lead_outwards_from_the_widest_free_end() {
    let (trunk, fork) = ([20.0, 20.0, 2.0], [20.0, 20.0, 18.0]);
    let arms = [[8.0, 20.0, 36.0], [32.0, 20.0, 36.0]];
    let found =
        Mask::cubes(&[(&[trunk, fork], 5.0), (&[arms[0], fork], 2.6), (&[fork, arms[1]], 2.6)]).traced();
    let fork = DVec3::from(fork);
    for vessel in &found.vessels {
        let away = |n: usize| vessel.points[n].distance(fork);
        let last = vessel.points.len() - 1;
        let is_trunk = vessel.points[0].z.min(vessel.points[last].z) < 6.0;
        assert_eq!(is_trunk, away(0) > away(last), "{} to {}", vessel.points[0], vessel.points[last]);
    }
    assert!(found.vessels.len() >= 3);
}

#[test]
fn cavities_are_filled_and_counted() {
    let mut mask = Mask::cubes(&[(&[[5.0, 20.0, 20.0], [35.0, 20.0, 20.0]], 5.0)]);
    let solid = mask.traced();
    for k in 19..22 {
        for j in 19..22 {
            mask.cells[40 * (j + 40 * k)..][12..15].fill(0);
        }
    }
    mask.cells[40 * (20 + 40 * 20) + 25] = 0;
    let hollow = mask.traced();
    assert_eq!((solid.filled, hollow.filled), ([0, 0], [2, 28]));
    assert_eq!(hollow.vessels[0].points, solid.vessels[0].points);
}

#[test]
fn a_flat_cut_leaves_no_fork() {
    let found = Mask::cubes(&[(&[[20.0, 20.0, -20.0], [20.0, 20.0, 60.0]], 6.4)]).traced();
    let [vessel] = &found.vessels[..] else { panic!("{} vessels", found.vessels.len()) };
    let [first, last] = [vessel.points[0].z, vessel.points[vessel.points.len() - 1].z];
    assert!((first.min(last) + 0.5).abs() < 0.05 && (first.max(last) - 39.5).abs() < 0.05, "{first} {last}");
    assert!(vessel.radius.iter().all(|radius| (radius - 6.4).abs() < 0.25));
}

fn star() -> Mask {
    let arm: &[[f64; 3]] = &[[20.0, 20.0, 20.0], [31.0, 27.0, 35.0]];
    Mask::cubes(&[(ACROSS[0], 2.6), (ACROSS[1], 2.6), (arm, 2.6)])
}

#[test]
fn reversed_axes_and_the_number_of_threads_do_not_matter() {
    let star = star();
    let expected = star.traced();
    assert!(expected.vessels.len() >= 5);
    for axis in 0..3 {
        let stride = [1, 40, 1600][axis];
        let mirror = |n: usize| n + stride * 39 - 2 * stride * (n / stride % 40);
        let cells = (0..star.cells.len()).map(|n| star.cells[mirror(n)]).collect();
        let mut sides = DMat3::IDENTITY;
        sides.col_mut(axis)[axis] = -1.0;
        let affine = DAffine3::from_mat3_translation(sides, DVec3::AXES[axis] * 39.0);
        let other = Mask { size: [40; 3], affine, cells }.traced();
        assert_eq!(other.vessels.len(), expected.vessels.len());
        for (one, vessel) in other.vessels.iter().zip(&expected.vessels) {
            assert_eq!(one.points.len(), vessel.points.len(), "{axis}");
            let pairs = one.points.iter().zip(&vessel.points);
            assert!(pairs.into_iter().all(|(a, b)| a.distance(*b) < 1e-9), "{axis}");
        }
    }
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let lines = |one: TracedMask| one.vessels.into_iter().map(|vessel| (vessel.points, vessel.radius));
        pool.install(|| lines(star.traced()).collect::<Vec<_>>())
    };
    assert_eq!(of(1), of(3));
}

#[test]
fn axes_are_found_on_anisotropic_and_sheared_grids() {
    for columns in [
        [[0.6, 0.0, 0.0], [0.0, 0.6, 0.0], [0.0, 0.0, 1.5]],
        [[0.8, 0.0, 0.0], [0.0, 0.8, 0.3], [0.0, 0.0, 1.0]],
        [[0.5, 0.1, 0.0], [-0.2, 0.6, 0.0], [0.3, 0.1, 0.9]],
    ] {
        let sides = DMat3::from_cols_array_2d(&columns);
        let affine = DAffine3::from_mat3_translation(sides, DVec3::new(-10.0, 4.0, 30.0));
        let ends =
            [[12.0, 20.0, 20.0], [30.0, 22.0, 24.0]].map(|index| affine.transform_point3(index.into()));
        let found = Mask::new([44; 3], affine, &[(&ends.map(|end| end.to_array()), 3.0)]).traced();
        let [vessel] = &found.vessels[..] else { panic!("{} vessels", found.vessels.len()) };
        let (along, middle) = ((ends[1] - ends[0]).normalize(), ends[0].midpoint(ends[1]));
        let smallest = [0, 1, 2].map(|a| sides.col(a).length()).into_iter().fold(f64::MAX, f64::min);
        for (point, radius) in vessel.points.iter().zip(&vessel.radius) {
            let way = *point - middle;
            let off = (way - along * way.dot(along)).length();
            assert!(way.length() > 4.0 || (radius - 3.0).abs() < 0.3, "{radius}");
            assert!(way.length() > 4.0 || off < 0.5 * smallest, "{off}");
        }
    }
}
