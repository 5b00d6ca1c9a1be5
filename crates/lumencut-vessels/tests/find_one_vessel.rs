//! Tests which vessel one click selects, in synthetic trees.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lumencut_vessels::trace::find::found::{FoundVessel, NoVessel, Trees};
use lumencut_vessels::trace::find::one_vessel::one_vessel;
use lumencut_vessels::trace::find::track::TrackDoubt;
use lumencut_vessels::trace::lines::centerline::Centerline;

fn line(from: DVec3, to: DVec3, radius: f64) -> Centerline {
    let count = from.distance(to).round() as usize;
    let points: Vec<DVec3> = (0..=count).map(|n| from.lerp(to, n as f64 / count as f64)).collect();
    Centerline { radius: vec![radius; count + 1], confidence: vec![1.0; count + 1], points }
}

fn found(line: Centerline, part: usize) -> FoundVessel {
    FoundVessel { line, part, confidence: 0.9, doubt: None }
}

/// A trunk along z (radius 10 mm), an artery from z = 50 along x, and its branch from x = 30 along y.
fn tree() -> Trees {
    let trunk = line(DVec3::ZERO, DVec3::Z * 100.0, 10.0);
    let artery = line(DVec3::Z * 50.0, DVec3::new(60.0, 0.0, 50.0), 3.0);
    let branch = line(DVec3::new(30.0, 0.0, 50.0), DVec3::new(30.0, 40.0, 50.0), 1.5);
    let vessels = [trunk, artery, branch].map(|line| found(line, 0)).to_vec();
    Trees { vessels, level: 300.0, contrast: 250.0, ..Trees::default() }
}

fn lines(tree: &Trees) -> Vec<Centerline> {
    tree.vessels.iter().map(|vessel| vessel.line.clone()).collect()
}

const IN_TRUNK: DVec3 = DVec3::new(6.0, 2.0, 20.3);
const IN_ARTERY: DVec3 = DVec3::new(45.2, 1.0, 50.0);
const IN_BRANCH: DVec3 = DVec3::new(31.0, 20.4, 50.0);

#[test]
fn a_click_gives_the_whole_vessel_that_it_lies_in() {
    let tree = tree();
    let all = lines(&tree);
    for (click, number) in [(IN_TRUNK, 0), (IN_ARTERY, 1), (IN_BRANCH, 2)] {
        assert_eq!(one_vessel(&tree, click, 0.5, &[]), Ok(all[number].clone()), "{number}");
    }
}

#[test]
fn the_line_leads_back_to_the_vessel_that_there_is() {
    let tree = tree();
    let all = lines(&tree);
    // If the artery does not exist yet, the path to the branch leads through it.
    let way = one_vessel(&tree, IN_BRANCH, 0.5, &all[..1]).unwrap();
    assert_eq!(way.points[0], DVec3::new(0.0, 0.0, 50.0));
    assert_eq!(way.points.last(), all[2].points.last());
    let through: Vec<DVec3> = way.points.iter().copied().filter(|point| point.y == 0.0).collect();
    assert!(through.windows(2).all(|pair| pair[1].x > pair[0].x));
    assert!(through.contains(&DVec3::new(29.0, 0.0, 50.0)));
    assert_eq!(way.radius.len(), way.points.len());
    assert_eq!(way.confidence.len(), way.points.len());
    // If the artery exists, only the branch is found. It starts on a bit-identical point of the artery.
    let branch = one_vessel(&tree, IN_BRANCH, 0.5, &all[..2]).unwrap();
    assert_eq!(branch.points[0], DVec3::new(30.0, 0.0, 50.0));
    assert!((branch.points.len() as f64 - 40.0).abs() < 3.0);
}

#[test]
fn a_trunk_does_not_end_where_a_branch_that_there_is_hangs_on_it() {
    let tree = tree();
    let all = lines(&tree);
    assert_eq!(one_vessel(&tree, IN_TRUNK, 0.5, &all[1..]), Ok(all[0].clone()));
}

#[test]
fn a_line_ends_where_it_enters_a_vessel_that_there_is() {
    let tree = tree();
    // The last part of the artery exists already, and so does a vessel that follows it.
    let traced = line(DVec3::new(50.0, -20.0, 50.0), DVec3::new(50.0, 20.0, 50.0), 2.0);
    let artery = one_vessel(&tree, IN_ARTERY, 0.5, &[traced]).unwrap();
    assert_eq!(artery.points[0], DVec3::new(0.0, 0.0, 50.0));
    assert_eq!(artery.points.last(), Some(&DVec3::new(50.0, 0.0, 50.0)));
}

#[test]
fn a_sure_vessel_comes_before_a_doubtful_one() {
    let mut tree = tree();
    let beside = line(DVec3::new(6.0, 0.0, 0.0), DVec3::new(6.0, 0.0, 100.0), 2.0);
    tree.vessels.push(FoundVessel { doubt: Some(TrackDoubt::Flat), ..found(beside, 1) });
    assert_eq!(one_vessel(&tree, IN_TRUNK, 0.5, &[]), Ok(tree.vessels[0].line.clone()));
    let doubtful = line(DVec3::new(-60.0, 0.0, 0.0), DVec3::new(-60.0, 0.0, 40.0), 2.0);
    tree.vessels.push(FoundVessel { doubt: Some(TrackDoubt::Flat), ..found(doubtful.clone(), 2) });
    assert_eq!(one_vessel(&tree, DVec3::new(-60.0, 1.0, 20.0), 0.5, &[]), Ok(doubtful));
}

#[test]
fn a_click_in_no_vessel_and_one_in_a_vessel_that_there_is_are_refused() {
    let tree = tree();
    let all = lines(&tree);
    assert_eq!(one_vessel(&tree, IN_ARTERY, 0.5, &all), Err(NoVessel::Already));
    let refused = one_vessel(&tree, DVec3::new(45.0, 0.0, 57.0), 0.5, &[]);
    assert_eq!(refused, Err(NoVessel::NotHere(7.0)));
    let empty = Trees { vessels: Vec::new(), ..tree };
    let refused = one_vessel(&empty, IN_ARTERY, 0.5, &[]);
    assert_eq!(refused, Err(NoVessel::NotHere(f64::INFINITY)));
}

#[test]
fn a_click_behind_the_end_of_a_vessel_that_ends_in_another_one_adds_nothing() {
    let tree = tree();
    // The click lies outside the artery, beyond its last point.
    let traced = line(DVec3::new(60.0, -20.0, 50.0), DVec3::new(60.0, 20.0, 50.0), 1.0);
    assert_eq!(one_vessel(&tree, DVec3::new(62.0, 0.0, 50.0), 0.5, &[traced]), Err(NoVessel::Already));
}

#[test]
fn a_click_at_the_rim_of_a_vessel_that_there_is_adds_nothing() {
    let tree = tree();
    let mut traced = tree.vessels[1].line.clone();
    traced.radius.fill(2.0);
    // The click lies in the artery, but outside the smaller radius of the traced one.
    let rim = DVec3::new(30.0, -2.5, 50.0);
    assert_eq!(one_vessel(&tree, rim, 0.5, &[traced]), Err(NoVessel::Already));
    // A vessel that leaves it is still found.
    assert!(one_vessel(&tree, IN_BRANCH, 0.5, &lines(&tree)[..2]).is_ok());
}

#[test]
fn vessels_that_begin_at_one_point_lead_to_an_end() {
    let mut tree = tree();
    let twin = line(DVec3::ZERO, DVec3::X * -40.0, 4.0);
    tree.vessels.push(found(twin.clone(), 0));
    assert_eq!(one_vessel(&tree, DVec3::X * -30.0, 0.5, &[]), Ok(twin));
}
