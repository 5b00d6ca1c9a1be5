//! Tests the modules of tracing on synthetic scenes.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use glam::{DAffine3, DVec3};
use lumencut_core::error::ErrorKind;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::{Phantom, straight_tube, y_junction};
use lumencut_vessels::trace::clicks::Traced;
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::lines::directions::frames;
use lumencut_vessels::trace::lines::directions::{chord_directions, point_directions};
use lumencut_vessels::trace::lines::even_steps::{curve_in_even_steps, in_even_steps};
use lumencut_vessels::trace::lines::nearest_point;
use lumencut_vessels::trace::lines::smoothing::{smoothed_by_gaussian, smoothed_by_parabolas};
use lumencut_vessels::trace::lumen::cross_section::{HALF, Probe};
use lumencut_vessels::trace::lumen::refine::refined;
use lumencut_vessels::trace::lumen::surroundings::Surroundings;
use lumencut_vessels::trace::mask::{MaskRequest, TracedMask, trace_mask};
use lumencut_vessels::trace::ways::front::{Found, Front, Reach};
use lumencut_vessels::trace::ways::region::{Region, Stopper, Strictness};
use lumencut_vessels::voxels;

/// A quarter of a circle with a radius of 20 mm.
fn arc(count: u32) -> Vec<DVec3> {
    let angle = |n: u32| PI / 2.0 * f64::from(n) / f64::from(count);
    (0..=count).map(|n| 20.0 * DVec3::new(angle(n).cos(), angle(n).sin(), 0.0)).collect()
}

#[test]
fn lines_in_even_steps_keep_their_ends_and_curves_their_radius() {
    let corner = [DVec3::ZERO, DVec3::X * 3.0, DVec3::new(3.0, 1.0, 0.0)];
    let even = in_even_steps(&corner, 1.0);
    assert_eq!(even.len(), 5);
    assert_eq!([even[0], even[3], even[4]], corner);
    let curve = curve_in_even_steps(&arc(10), 0.5);
    // Points near the ends are skipped, because they have neighbours on one side only.
    let inner = &curve[8..curve.len() - 8];
    assert!(inner.len() > 40 && inner.iter().all(|point| (point.length() - 20.0).abs() < 0.02));
    assert_eq!([curve[0], curve[curve.len() - 1]], [arc(10)[0], arc(10)[10]]);
}

#[test]
fn directions_of_an_arc_are_its_tangents_and_frames_do_not_turn_about_it() {
    let points = arc(40);
    let reach = vec![2.0; points.len()];
    for along in [point_directions(&points, 2.0), chord_directions(&points, &reach, false)] {
        let off = |n: &usize| along[*n].dot(points[*n] / 20.0).abs();
        assert!((5..35).all(|n| off(&n) < 1e-3));
        let across = frames(&points, &along);
        let turned = across.iter().map(|[first, second]| [first.z, second.z]);
        let first = [across[0][0].z, across[0][1].z];
        assert!(turned.into_iter().all(|z| (z[0] - first[0]).abs() < 1e-9 && (z[1] - first[1]).abs() < 1e-9));
    }
    assert_eq!(nearest_point(&points, points[7] * 1.3), 7);
}

#[test]
fn parabolas_keep_bends_and_gaussians_keep_ends_and_straight_lines() {
    let points = arc(40);
    let lengths = arc_lengths(&points);
    let values: Vec<[f64; 1]> = lengths.iter().map(|s| [1.0 + 0.5 * s - 0.03 * s * s]).collect();
    let smooth = smoothed_by_parabolas(&lengths, &values, &vec![1.0; values.len()], |_| 3.0);
    assert!(smooth.iter().zip(&values).all(|(new, old)| (new[0] - old[0]).abs() < 1e-9));
    let zigzag: Vec<DVec3> =
        (0..=60).map(|n| DVec3::new(f64::from(n), f64::from(n % 2) * 0.2, 0.0)).collect();
    let smooth = smoothed_by_gaussian(&zigzag, &vec![3.0; 61], false);
    assert_eq!([smooth[0], smooth[60]], [zigzag[0], zigzag[60]]);
    assert!((15..45).all(|n| (smooth[n].y - 0.1).abs() < 1e-3 && (smooth[n].x - n as f64).abs() < 1e-3));
}

#[test]
fn a_line_beside_the_middle_of_a_tube_is_moved_to_it_with_its_radius() {
    let phantom = straight_tube().unwrap();
    let volume = phantom.volume().unwrap();
    let voxels = voxels::Voxels::new(&volume);
    let model = Surroundings::of(&voxels, &[DVec3::ZERO]).model(&voxels, &[DVec3::ZERO]).unwrap();
    assert!(
        (model.low - 350.0).abs() < 5.0 && model.membership(350.0) == 1.0 && model.membership(-100.0) == 0.0
    );
    let probe = Probe { voxels: &voxels, model: &model, rays: 24, fall: HALF };
    let section = probe.look(DVec3::new(1.0, -0.5, 3.0), [DVec3::X, DVec3::Y], None).unwrap();
    let (off, radius) = (section.center.distance(DVec3::Z * 3.0), section.radius);
    assert!(off < 0.2 && (radius - 4.0).abs() < 0.2, "{off} {radius}");
    assert!(probe.look(DVec3::new(12.0, 0.0, 0.0), [DVec3::X, DVec3::Y], None).is_none());
    let way: Vec<DVec3> = (-20..=20).map(|n| DVec3::new(1.2, 0.6, f64::from(n))).collect();
    let line = refined(&voxels, &model, &way, &|| false).unwrap();
    let off = line.points.iter().map(|point| point.truncate().length()).fold(0.0, f64::max);
    assert!(off < 0.1, "{off}");
    // The value midway between lumen and fat is up to a third of a voxel outside the edge.
    assert!(line.radius.iter().all(|radius| (0.0..0.2).contains(&(radius - 4.0))), "{:?}", line.radius);
}

#[test]
fn a_front_comes_along_a_tube_and_not_past_a_stopper_across_it() {
    let phantom = straight_tube().unwrap();
    let volume = phantom.volume().unwrap();
    let voxels = voxels::Voxels::new(&volume);
    let model = Surroundings::of(&voxels, &[DVec3::ZERO]).model(&voxels, &[DVec3::ZERO]).unwrap();
    let ends = [-20.0, 20.0].map(|z| voxels.voxel_at(DVec3::Z * z).unwrap());
    let grow = |stoppers: Vec<Stopper>, most_voxels: usize| {
        let mut region = Region::new(voxels.size, model, stoppers, Strictness::Lumen);
        let reach = Reach { longest_gap: Some(5.0), most_voxels, pull: 1.0 };
        let mut front = Front::new(&voxels, &mut region, ends[0], reach);
        let found = front.grow(&voxels, &mut region, ends[1], &|| false, &|_| ()).unwrap();
        (found, front.way_to(ends[1]))
    };
    let (found, way) = grow(Vec::new(), 1_000_000);
    assert_eq!(found, Found::Target);
    assert_eq!([way[0], way[way.len() - 1]], ends);
    // The cheapest path takes one step per slice.
    assert_eq!(way.len() as i32, ends[1][2] - ends[0][2] + 1);
    let stopper = Stopper { center: DVec3::ZERO, radius: 10.0 };
    assert_eq!(grow(vec![stopper], 1_000_000).0, Found::NoWay);
    assert_eq!(grow(Vec::new(), 50).0, Found::TooFar);
}

fn traced(phantom: &Phantom, clicks: &Clicks) -> lumencut_core::error::Result<Vec<Traced>> {
    Tracer::default().trace(&phantom.volume().unwrap(), clicks, &|| false, None)
}

#[test]
fn an_occlusion_is_refused_or_bridged() {
    let mut phantom = straight_tube().unwrap();
    let [ni, nj, _] = phantom.size;
    for (n, voxel) in phantom.voxels.iter_mut().enumerate() {
        let index = DVec3::new((n % ni) as f64, (n / ni % nj) as f64, (n / (ni * nj)) as f64);
        if phantom.world_from_index.transform_point3(index).z.abs() < 6.0 {
            *voxel = -100;
        }
    }
    let mut clicks = Clicks { vessels: vec![vec![DVec3::Z * -20.0, DVec3::Z * 20.0]], ..Clicks::default() };
    assert_eq!(traced(&phantom, &clicks).unwrap_err().kind, ErrorKind::Tracing);
    clicks.bridge = true;
    let vessels = traced(&phantom, &clicks).unwrap();
    let Traced { line, bridged, .. } = &vessels[0];
    for (point, is_bridged) in line.points.iter().zip(bridged) {
        // In an occlusion, the centre of the lumen is not visible.
        let most = if point.z.abs() > 12.0 { 0.3 } else { 4.0 };
        assert!(point.truncate().length() < most, "{point}");
        assert!(*is_bridged || point.z.abs() > 4.5, "{point}");
        assert!(!is_bridged || point.z.abs() < 7.5, "{point}");
    }
}

#[test]
fn a_later_vessel_begins_at_a_point_of_the_earlier_one() {
    let phantom = y_junction().unwrap();
    let to = |x: f64| vec![DVec3::Z * -20.0, DVec3::new(x, 0.0, 21.0)];
    let clicks = Clicks { vessels: vec![to(-14.0), to(14.0)], ..Clicks::default() };
    let vessels = traced(&phantom, &clicks).unwrap();
    let start = vessels[1].line.points[0];
    assert!(vessels[0].line.points.contains(&start));
    assert!(start.length() < 8.0, "{start}");
}

/// Centerlines of tubes, given by ends and radii, that are traced as a mask in 1 mm voxels.
fn masked(tubes: &[(DVec3, DVec3, f64)]) -> TracedMask {
    const SIZE: usize = 60;
    let is_within = |place: DVec3| {
        tubes.iter().any(|(from, to, radius)| {
            let way = *to - *from;
            let share = ((place - *from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            place.distance(*from + way * share) <= *radius
        })
    };
    let place =
        |n: usize| DVec3::new((n % SIZE) as f64, (n / SIZE % SIZE) as f64, (n / (SIZE * SIZE)) as f64);
    let cells: Vec<u8> = (0..SIZE.pow(3)).map(|n| u8::from(is_within(place(n)))).collect();
    let strides = [1, SIZE, SIZE * SIZE];
    let mask = Volume::new(Voxels::U8(&cells), [SIZE; 3], strides, DAffine3::IDENTITY).unwrap();
    let request = MaskRequest {
        labels: None,
        parent_radii: 2.0,
        step: 0.5,
        bridge: 0.0,
        refine: None,
        stop: &|| false,
        progress: None,
    };
    trace_mask(&mask, &request).unwrap()
}

#[test]
fn a_bump_of_a_mask_is_no_branch_and_a_long_one_is() {
    let tube = (DVec3::new(20.0, 30.0, 8.0), DVec3::new(20.0, 30.0, 52.0), 5.0);
    let branch = |length: f64| (DVec3::new(20.0, 30.0, 30.0), DVec3::new(20.0 + length, 30.0, 30.0), 2.0);
    let alone = masked(&[tube, branch(6.0)]).vessels;
    assert_eq!(alone.len(), 1);
    let inner = alone[0].points.iter().filter(|point| (12.0..48.0).contains(&point.z));
    assert!(inner.clone().count() > 60);
    assert!(inner.clone().all(|point| point.distance(DVec3::new(20.0, 30.0, point.z)) < 0.6));
    let parted = masked(&[tube, branch(25.0)]).vessels;
    assert_eq!(parted.len(), 3);
    let tip = DVec3::new(47.0, 30.0, 30.0);
    assert!(parted.iter().any(|vessel| vessel.points[vessel.points.len() - 1].distance(tip) < 1.5));
}

#[test]
fn pieces_of_a_mask_are_counted_with_the_gap_between_them() {
    let tube = |from: f64, to: f64| (DVec3::new(30.0, 30.0, from), DVec3::new(30.0, 30.0, to), 3.0);
    let found = masked(&[tube(6.0, 24.0), tube(36.0, 54.0)]);
    assert_eq!((found.pieces, found.vessels.len(), found.gaps.len()), (2, 2, 1));
    assert!((found.gaps[0].width - 6.0).abs() < 1.5, "{}", found.gaps[0].width);
}
