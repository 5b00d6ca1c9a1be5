//! The truth that phantoms state agrees with their voxels.
#![allow(clippy::unwrap_used)]

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_phantom::{
    Phantom, PlaqueKind, aorta, calcified_wall, cervical, collinear_run, crossing, helix, runoff, stenosis,
    straight_tube, trefoil, y_junction,
};

const LUMEN: f64 = 350.0;
const WALL: f64 = 60.0;
const SOFT: f64 = 40.0;
const FAT: f64 = -100.0;

type Workload = fn(u64, f64) -> Result<Phantom>;
/// Each workload with its number of cycles: the bypass, and the ring of both vertebral arteries.
const WORKLOADS: [(Workload, usize); 3] = [(aorta, 0), (runoff, 1), (cervical, 1)];

/// The value at a world point inside the volume, linear between voxels.
fn sample(phantom: &Phantom, point: DVec3) -> f64 {
    let index = phantom.world_from_index.inverse().transform_point3(point);
    let last = DVec3::from(phantom.size.map(|n| (n - 2) as f64));
    let low = index.floor().clamp(DVec3::ZERO, last);
    let (share, [i, j, k]) = (index - low, low.to_array().map(|n| n as usize));
    let [ni, nj, _] = phantom.size;
    (0..8)
        .map(|c| {
            let [x, y, z] = [c & 1, c >> 1 & 1, c >> 2];
            let part = |far: usize, share: f64| if far == 1 { share } else { 1.0 - share };
            let voxel = f64::from(phantom.voxels[((k + z) * nj + j + y) * ni + i + x]);
            voxel * part(x, share.x) * part(y, share.y) * part(z, share.z)
        })
        .sum()
}

/// The mean distance (mm) from a point, across the vessel, at which values fall below a threshold.
fn radius(phantom: &Phantom, point: DVec3, tangent: DVec3, threshold: f64) -> f64 {
    let u = tangent.normalize().any_orthonormal_vector();
    let v = tangent.normalize().cross(u);
    let reach = |turn: i32| {
        let (sine, cosine) = (f64::from(turn) / 36.0 * TAU).sin_cos();
        let at = |n: i32| 0.02 * f64::from(n);
        let is_out = |n: &i32| sample(phantom, point + (u * cosine + v * sine) * at(*n)) < threshold;
        at((0..400).find(is_out).unwrap())
    };
    (0..36).map(reach).sum::<f64>() / 36.0
}

fn assert_near(found: f64, expected: f64, most: f64, what: &str) {
    assert!((found - expected).abs() <= most, "{what}: found {found}, expected {expected}");
}

#[test]
fn small_phantoms_hold_their_tree_and_fill_their_lumen() {
    let half = || stenosis(50.0);
    let all: [(&str, &dyn Fn() -> Result<Phantom>); 8] = [
        ("straight_tube", &straight_tube),
        ("helix", &helix),
        ("y_junction", &y_junction),
        ("crossing", &crossing),
        ("trefoil", &trefoil),
        ("collinear_run", &collinear_run),
        ("stenosis", &half),
        ("calcified_wall", &calcified_wall),
    ];
    for (name, make) in all {
        let made = make().unwrap();
        assert_eq!(made.name, name);
        let sides = made.world_from_index.matrix3;
        assert_eq!([sides.x_axis.length(), sides.y_axis.length(), sides.z_axis.length()], [0.5; 3]);
        for (vessel, reference) in made.tree.vessels().iter().zip(&made.reference_radius) {
            for (n, point) in vessel.points().iter().enumerate() {
                assert_near(sample(&made, *point), LUMEN, 1.0, name);
                assert!(vessel.radius_or_zero(n) <= reference[n]);
            }
            assert_eq!(reference.len(), vessel.points().len());
        }
        let last = made.voxels.len() - 1;
        let row = made.size[0] - 1;
        assert_eq!([0, row, last - row, last].map(|n| f64::from(made.voxels[n])), [FAT; 4]);
    }
}

#[test]
fn measured_radii_are_the_true_ones() {
    for make in [straight_tube, helix, crossing, trefoil] {
        let made = make().unwrap();
        for vessel in made.tree.vessels() {
            let points = vessel.points();
            for n in (5..points.len() - 5).step_by(11) {
                let found = radius(&made, points[n], points[n + 1] - points[n - 1], (LUMEN + WALL) / 2.0);
                assert_near(found, vessel.radius_or_zero(n), 0.15, made.name);
            }
        }
    }
}

#[test]
fn the_wall_lies_around_the_lumen() {
    let made = straight_tube().unwrap();
    let thickness = 0.5 + 0.08 * 4.0;
    assert_near(sample(&made, DVec3::X * (4.0 + thickness / 2.0)), WALL, 60.0, "wall");
    let outside = radius(&made, DVec3::ZERO, DVec3::Z, f64::midpoint(WALL, FAT));
    assert_near(outside, 4.0 + thickness, 0.15, "radius of the wall");
}

#[test]
fn a_stenosis_shows_the_stated_percentage() {
    for percent in [0.0, 30.0, 70.0] {
        let made = stenosis(percent).unwrap();
        let stated = made.stenoses[0];
        assert_eq!((stated.vessel, stated.arc_length, stated.percent), (0, 30.0, percent));
        let [narrow, healthy] =
            [0.0, 20.0].map(|z| radius(&made, DVec3::Z * z, DVec3::Z, f64::midpoint(LUMEN, SOFT)));
        assert_near(100.0 * (1.0 - narrow / healthy), percent, 4.0, "measured");
        let lumen = made.tree.vessels()[0].radius().unwrap();
        let least = lumen.iter().copied().fold(f64::INFINITY, f64::min);
        let most = lumen.iter().copied().fold(0.0, f64::max);
        assert_near(100.0 * (1.0 - least / most), percent, 1e-6, "stated");
        assert_eq!(made.plaques[0].kind, PlaqueKind::Soft);
        if percent == 70.0 {
            let middle = 4.0 - made.plaques[0].thickness / 2.0;
            for side in [DVec3::X, DVec3::NEG_Y] {
                assert_near(sample(&made, side * middle), SOFT, 1.0, "plaque");
            }
        }
    }
}

#[test]
fn a_calcification_lies_where_it_is_stated() {
    let made = calcified_wall().unwrap();
    let plaque = made.plaques[0];
    assert_eq!(plaque.kind, PlaqueKind::Calcified);
    assert!(plaque.position.distance(DVec3::X * 5.0) < 1e-9);
    let [ni, nj, _] = made.size;
    let place = |n: usize| {
        let index = DVec3::new((n % ni) as f64, (n / ni % nj) as f64, (n / ni / nj) as f64);
        made.world_from_index.transform_point3(index)
    };
    let bright: Vec<DVec3> = (0..made.voxels.len()).filter(|n| made.voxels[*n] > 500).map(place).collect();
    let mean = bright.iter().sum::<DVec3>() / bright.len() as f64;
    assert!(mean.distance(plaque.position) < 0.9, "{mean}");
    let extent = |of: &dyn Fn(&DVec3) -> f64| {
        let all = || bright.iter().map(of);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    assert_near(extent(&|point| point.z), plaque.length, 1.1, "length");
    assert_near(extent(&|point| point.y.atan2(point.x)), plaque.angular_extent, 0.3, "angle");
    assert!(radius(&made, DVec3::ZERO, DVec3::Z, 205.0) > 4.0, "it lies outside the lumen");
}

#[test]
fn points_that_are_shared_are_the_same_to_the_bit() {
    let fork = y_junction().unwrap();
    let [trunk, right, left] = [0, 1, 2].map(|n| fork.tree.vessels()[n].points());
    assert_eq!([right[0], left[0]], [trunk[trunk.len() - 1]; 2]);
    let knot = trefoil().unwrap();
    let points = knot.tree.vessels()[0].points();
    assert_eq!(points[0], points[points.len() - 1]);
    let run = collinear_run().unwrap();
    let [bend, end_on] = [0, 1].map(|n| run.tree.vessels()[n].points());
    assert!(end_on.iter().all(|point| (point.x, point.z) == (end_on[0].x, end_on[0].z)));
    let is_along: Vec<bool> =
        bend.windows(2).map(|two| (two[0].x, two[0].z) == (two[1].x, two[1].z)).collect();
    assert_eq!(is_along.iter().filter(|along| **along).count(), 30);
    assert!(!is_along[0] && !is_along[is_along.len() - 1]);
}

#[test]
fn vessels_of_workloads_shine_and_have_names() {
    for (make, _) in WORKLOADS {
        let made = make(0, 0.25).unwrap();
        let mut names = made.vessel_names.clone();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), made.tree.vessels().len());
        for vessel in made.tree.vessels() {
            for (n, point) in vessel.points().iter().enumerate() {
                // The noise is 14 HU; voxels of 3 mm blur only vessels narrower than that.
                if vessel.radius_or_zero(n) > 4.0 {
                    assert_near(sample(&made, *point), LUMEN, 90.0, made.name);
                }
            }
        }
    }
}

#[test]
fn vessels_of_workloads_meet_to_the_bit() {
    for (make, cycles) in WORKLOADS {
        let made = make(0, 0.05).unwrap();
        let key = |point: DVec3| point.to_array().map(f64::to_bits);
        let mut number = HashMap::new();
        let mut ends = Vec::new();
        for vessel in made.tree.vessels() {
            let points = vessel.points();
            ends.push([points[0], points[points.len() - 1]].map(|point| {
                let next = number.len();
                *number.entry(key(point)).or_insert(next)
            }));
        }
        let mut part: Vec<usize> = (0..number.len()).collect();
        for [one, other] in &ends {
            let (from, to) = (part[*one], part[*other]);
            part.iter_mut().filter(|p| **p == from).for_each(|p| *p = to);
        }
        assert!(part.iter().all(|p| *p == part[0]), "{}: one tree", made.name);
        // Each cycle adds an edge to a tree.
        assert_eq!(ends.len() + 1 - number.len(), cycles, "{}", made.name);
    }
}

#[test]
fn lesions_of_workloads_match_their_radii() {
    for (make, _) in WORKLOADS {
        let made = make(0, 0.05).unwrap();
        assert!(!made.stenoses.is_empty());
        assert!(made.plaques.iter().any(|plaque| plaque.kind == PlaqueKind::Calcified));
        for stated in &made.stenoses {
            let (vessel, reference) =
                (&made.tree.vessels()[stated.vessel], &made.reference_radius[stated.vessel]);
            let near = |n: &usize| (vessel.arc_length()[*n] - stated.arc_length).abs() < stated.length / 2.0;
            let narrowed = |n: usize| 100.0 * (1.0 - vessel.radius_or_zero(n) / reference[n]);
            let most = (0..reference.len()).filter(near).map(narrowed).fold(0.0, f64::max);
            assert_near(most, stated.percent, 0.5, made.name);
        }
        for plaque in &made.plaques {
            let points = made.tree.vessels()[plaque.vessel].points();
            let away = points.iter().map(|p| p.distance(plaque.position)).fold(f64::INFINITY, f64::min);
            let wide = made.reference_radius[plaque.vessel].iter().copied().fold(0.0, f64::max);
            assert!(away < wide + plaque.thickness + 2.0, "{}: {plaque:?}", made.name);
        }
    }
}

/// Length and mean radius (mm) of each vessel, and the mean values of 4 × 4 × 4 parts of the volume.
fn summary(made: &Phantom) -> Vec<(String, Vec<f64>)> {
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    let vessels = made.tree.vessels().iter().zip(&made.vessel_names);
    let mut rows: Vec<(String, Vec<f64>)> = vessels
        .map(|(vessel, name)| {
            let length = vessel.arc_length()[vessel.points().len() - 1];
            (format!("{} {name}", made.name), vec![length, mean(vessel.radius().unwrap())])
        })
        .collect();
    let mut parts = vec![Vec::new(); 64];
    for (n, value) in made.voxels.iter().enumerate() {
        let [ni, nj, nk] = made.size;
        let [i, j, k] = [n % ni * 4 / ni, n / ni % nj * 4 / nj, n / (ni * nj) * 4 / nk];
        parts[i + 4 * (j + 4 * k)].push(f64::from(*value));
    }
    let layers = parts.chunks(16).enumerate();
    rows.extend(
        layers.map(|(k, layer)| {
            (format!("{} {k}", made.name), layer.iter().map(|values| mean(values)).collect())
        }),
    );
    rows
}

#[test]
fn workloads_are_those_that_are_stored() {
    let found: Vec<(String, Vec<f64>)> =
        WORKLOADS.iter().flat_map(|(make, _)| summary(&make(0, 0.25).unwrap())).collect();
    let line = |(name, numbers): &(String, Vec<f64>)| {
        let numbers: Vec<String> = numbers.iter().map(|number| format!("{number:.2}")).collect();
        format!("{name}: {}", numbers.join(" "))
    };
    let text: Vec<String> = found.iter().map(line).collect();
    let stored = include_str!("workloads.txt").lines().filter(|line| !line.starts_with('#'));
    let stored: Vec<&str> = stored.collect();
    let is_near = |(row, stored): (&(String, Vec<f64>), &&str)| {
        let Some((name, numbers)) = stored.split_once(": ") else { return false };
        let near = |(number, text): (&f64, &str)| (number - text.parse::<f64>().unwrap()).abs() < 0.02;
        name == row.0 && row.1.iter().zip(numbers.split(' ')).all(near)
    };
    let is_stored = found.len() == stored.len() && found.iter().zip(&stored).all(is_near);
    assert!(is_stored, "found other workloads than those stored:\n{}", text.join("\n"));
}
