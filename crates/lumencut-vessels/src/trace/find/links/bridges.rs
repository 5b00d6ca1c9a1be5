//! Bridges longer gaps between two ends that point at each other, as at bone that touches an artery.

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::find::links::ends::End;
use crate::trace::find::links::groups::Groups;
use crate::trace::find::links::link::{Link, WayEnd, lowest_level};
use crate::trace::find::point_grid::PointGrid;
use crate::trace::find::scan::Scan;
use crate::trace::find::track::Track;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Minimum confidence of both tracks at a bridge.
const CONFIDENCE: f64 = 0.3;

/// A bridge is no longer than this many radii of the wider end, and than this many mm.
const RADII: f64 = 16.0;
const LONGEST: f64 = 25.0;

/// Limits of both ends: minimum cosine of the turn, or maximum sideways miss (radii); ratio of the radii; difference
/// of the levels (fraction of the contrast). Last, the lowest level along the bridge (0 tissue, 1 lumen).
const STRAIGHT: f64 = 0.9;
const PAST: f64 = 1.5;
const ALIKE: f64 = 1.6;
const UNLIKE: f64 = 0.3;
const LEVEL: f64 = 0.6;

pub(crate) fn bridges(
    scan: &Scan,
    tracks: &[Track],
    ends: &[End],
    groups: &Groups,
    stop: Stop,
) -> Result<Vec<Link>> {
    let sure: Vec<&End> = ends.iter().filter(|end| tracks[end.of[0]].confidence >= CONFIDENCE).collect();
    let group: Vec<usize> = sure.iter().map(|end| groups.group(end.of[0])).collect();
    let grid = PointGrid::new(sure.iter().map(|end| end.place).collect(), LONGEST);
    let of_end = |a: usize| {
        go_on(stop)?;
        let mut found = Vec::new();
        grid.near(sure[a].place, LONGEST, |b| {
            if b > a && group[a] != group[b] {
                found.extend(bridge(scan, sure[a], sure[b]));
            }
        });
        Ok(found)
    };
    let found: Vec<Vec<Link>> = (0..sure.len()).into_par_iter().map(of_end).collect::<Result<_>>()?;
    Ok(found.into_iter().flatten().collect())
}

fn bridge(scan: &Scan, from: &End, to: &End) -> Option<Link> {
    let way = to.place - from.place;
    let gap = way.length();
    let [narrow, wide] = [from.radius.min(to.radius), from.radius.max(to.radius)];
    let unlike = (from.level - to.level).abs() / from.contrast.max(to.contrast);
    let is_straight = leads_to(from, way) && leads_to(to, -way);
    if gap > LONGEST.min(RADII * wide) || !is_straight || wide > ALIKE * narrow || unlike >= UNLIKE {
        return None;
    }
    let [first, last] =
        [from, to].map(|end| WayEnd { place: end.place, level: end.level, contrast: end.contrast });
    let level = lowest_level(scan, first, last);
    (level >= LEVEL).then_some(Link { from: from.of, to: to.of, cost: gap, gap, level })
}

fn leads_to(end: &End, way: DVec3) -> bool {
    let ahead = end.direction.dot(way);
    let past = (way - end.direction * ahead).length();
    ahead > 0.0 && (ahead >= STRAIGHT * way.length() || past <= PAST * end.radius)
}
