use super::*;
use crate::trace::find::made::{straight_track, turned};
use glam::DVec3;

/// A trunk with a radius of 4 mm from 0 to `end` mm, and a branch linked to it at 30 mm.
fn fork(end: f64, branch: f64) -> (Vec<Track>, Vec<Link>) {
    let trunk = straight_track(DVec3::ZERO, DVec3::new(end, 0.0, 0.0), 4.0);
    let branch = straight_track(DVec3::new(33.0, 4.0, 0.0), DVec3::new(50.0, 20.0, 0.0), branch);
    let link = Link { from: [1, 0], to: [0, 60], cost: 5.0, gap: 0.0, level: 1.0 };
    (vec![trunk, branch], vec![link])
}

fn last(track: &Track) -> f64 {
    track.points[track.points.len() - 1].place.x
}

#[test]
fn what_runs_on_beyond_a_fork_for_less_than_so_many_radii_is_cut_off() {
    let (tracks, links) = fork(35.5, 3.0);
    let (cut, kept) = without_stubs(&tracks, &links, &|| false).expect("tracks");
    assert_eq!((last(&cut[0]), last(&cut[1])), (30.0, 50.0));
    assert_eq!(kept, links);
}

#[test]
fn longer_ends_and_those_beside_narrow_branches_stay() {
    for (end, branch) in [(36.5, 3.0), (35.5, 2.0)] {
        let (tracks, links) = fork(end, branch);
        assert_eq!(last(&without_stubs(&tracks, &links, &|| false).expect("tracks").0[0]), end);
    }
}

#[test]
fn a_stub_at_the_start_moves_the_numbers_of_the_points() {
    let (mut tracks, mut links) = fork(35.5, 3.0);
    tracks[0] = turned(tracks[0].clone());
    let count = tracks[0].points.len();
    links[0].to[1] = count - 1 - 60;
    let (cut, links) = without_stubs(&tracks, &links, &|| false).expect("tracks");
    assert_eq!((links[0].to, cut[0].points[0].place.x), ([0, 0], 30.0));
    assert_eq!(cut[0].points.len(), 61);
}
