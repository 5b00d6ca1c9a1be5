//! Links the side of a track to a wider track of another tree, as at a trunk that divides in two.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::trace::find::links::groups::Groups;
use crate::trace::find::links::landings::Landings;
use crate::trace::find::links::link::{Link, WayEnd, lowest_level};
use crate::trace::find::scan::Scan;
use crate::trace::find::track::{Track, TrackPoint};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Minimum confidence of both tracks, and minimum radius of the narrower one (voxels).
const CONFIDENCE: f64 = 0.7;
const LEAST_RADIUS: f64 = 1.5;

/// Maximum distance between the walls: radii of the narrower track, and mm.
const WALLS: f64 = 3.0;
const FARTHEST_WALL: f64 = 12.0;

/// Maximum difference of the levels (fraction of the contrast), and minimum level along the link.
const MAX_LEVEL_DIFFERENCE: f64 = 0.3;
const MIN_LEVEL: f64 = 0.7;

/// Maximum cosine between the directions: parallel tracks are an artery and its vein, which are not linked.
const SIDE_BY_SIDE: f64 = 0.8;

/// Maximum number of points tried per pair of trees.
const PLACES_TRIED: usize = 8;

pub(crate) fn side_links(
    scan: &Scan,
    tracks: &[Track],
    groups: &Groups,
    landings: &Landings,
    stop: Stop,
) -> Result<Vec<Link>> {
    let group: Vec<usize> = (0..tracks.len()).map(|track| groups.group(track)).collect();
    let radii: Vec<f64> = tracks.iter().map(Track::radius).collect();
    let sides = Sides { scan, tracks, landings, group: &group, radii: &radii };
    let of_track = |number: usize| {
        go_on(stop)?;
        let is_sure = tracks[number].confidence >= CONFIDENCE;
        let points = if is_sure { tracks[number].points.len() } else { 0 };
        Ok((0..points).flat_map(|point| sides.nearest([number, point])).collect())
    };
    let found: Vec<Vec<Link>> = (0..tracks.len()).into_par_iter().map(of_track).collect::<Result<_>>()?;
    let mut pairs: BTreeMap<[usize; 2], Vec<Link>> = BTreeMap::new();
    for link in found.into_iter().flatten() {
        let [a, b] = [group[link.from[0]], group[link.to[0]]];
        pairs.entry([a.min(b), a.max(b)]).or_default().push(link);
    }
    let pairs: Vec<Vec<Link>> = pairs.into_values().collect();
    let shortest = |links: &Vec<Link>| {
        go_on(stop)?;
        Ok(sides.first_of_lumen(links))
    };
    let links: Vec<Option<Link>> = pairs.par_iter().map(shortest).collect::<Result<_>>()?;
    Ok(links.into_iter().flatten().collect())
}

struct Sides<'a, 'v> {
    scan: &'a Scan<'v>,
    tracks: &'a [Track],
    landings: &'a Landings<'a, 'v>,
    group: &'a [usize],
    radii: &'a [f64],
}

impl Sides<'_, '_> {
    fn nearest(&self, from: [usize; 2]) -> Vec<Link> {
        let point = self.point(from);
        let mut best: Vec<Link> = Vec::new();
        if point.radius < LEAST_RADIUS * self.scan.side {
            return best;
        }
        let most = (WALLS * point.radius).min(FARTHEST_WALL);
        self.landings.near(point.place, most + point.radius, f64::MAX, |to, away| {
            if self.group[to[0]] == self.group[from[0]] || !self.may_join(from, to) {
                return;
            }
            let gap = (away - point.radius - self.point(to).radius).max(0.0);
            let link = Link { from, to, cost: gap, gap, level: 0.0 };
            let tree = |link: &Link| self.group[link.to[0]];
            match best.iter_mut().find(|known| tree(known) == tree(&link)) {
                Some(known) if link.order(known).is_lt() => *known = link,
                Some(_) => (),
                None => best.push(link),
            }
        });
        best
    }

    fn may_join(&self, from: [usize; 2], to: [usize; 2]) -> bool {
        let [narrow, wide] = [from, to].map(|of| self.point(of));
        let unlike = (narrow.level - wide.level).abs() / narrow.contrast.max(wide.contrast);
        self.tracks[to[0]].confidence >= CONFIDENCE
            && self.radii[to[0]] > self.radii[from[0]]
            && unlike < MAX_LEVEL_DIFFERENCE
            && narrow.direction.dot(wide.direction).abs() <= SIDE_BY_SIDE
    }

    fn first_of_lumen(&self, links: &[Link]) -> Option<Link> {
        let mut links = links.to_vec();
        links.sort_unstable_by(Link::order);
        links.into_iter().take(PLACES_TRIED).find_map(|link| {
            let [from, to] = [link.from, link.to].map(|of| {
                let point = self.point(of);
                WayEnd { place: point.place, level: point.level, contrast: point.contrast }
            });
            let level = lowest_level(self.scan, from, to);
            (level >= MIN_LEVEL).then_some(Link { level, ..link })
        })
    }

    fn point(&self, [track, point]: [usize; 2]) -> &TrackPoint {
        &self.tracks[track].points[point]
    }
}
