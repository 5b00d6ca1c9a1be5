//! Points of other tracks to which an end may be linked, the cheapest first.

use crate::trace::find::links::ends::{End, may_link};
use crate::trace::find::links::link::{Link, WayEnd, lowest_level};
use crate::trace::find::point_grid::PointGrid;
use crate::trace::find::scan::Scan;
use crate::trace::find::track::{Track, TrackPoint};

/// Maximum distance from an end to the centre of another track: a multiple of the end's radius plus some mm.
const LANDING_RADII: f64 = 2.5;
const REACH_BEYOND: f64 = 26.0;

/// Maximum distance from an end to the wall of a track, in radii of the end. It is at least `WALL_VOXELS`
/// voxels and at most `FARTHEST_WALL` mm.
const WALL: f64 = 3.0;
const WALL_VOXELS: f64 = 4.0;
const FARTHEST_WALL: f64 = 8.0;

/// An end lies inside another track up to this multiple of that track's radius, plus one voxel.
const INSIDE: f64 = 1.15;

/// Minimum level along a link (0 tissue, 1 lumen).
const LEVEL: f64 = 0.45;

/// Weight of turn and level difference in the cost of a link, relative to the link's length.
const TURN: f64 = 0.5;

/// Ends with a radius below this (voxels) are narrow.
const NARROW_VOXELS: f64 = 2.5;

/// Maximum number of points tried per track.
const PLACES_TRIED: usize = 3;

pub(crate) struct Limits {
    /// Minimum confidence of both tracks.
    pub confidence: f64,
    /// Minimum cosine of the turn, unless the end lies inside the other track.
    pub turn: f64,
    /// Maximum difference of levels (fraction of the contrast).
    pub unlike: f64,
    /// Factor of the level difference for a narrow end at a brighter track: narrow ends look darker than their lumen.
    pub narrow: f64,
}

/// Limits for the first link of an end, which allow turns up to 60°.
pub(crate) const OPEN_ENDS: Limits = Limits { confidence: 0.3, turn: 0.5, unlike: 0.5, narrow: 1.0 };

/// Limits for links to another tree, which allow turns up to 45°.
pub(crate) const BETWEEN_TREES: Limits =
    Limits { confidence: 0.6, turn: std::f64::consts::FRAC_1_SQRT_2, unlike: 0.4, narrow: 0.5 };

pub(crate) struct Landings<'a, 'v> {
    scan: &'a Scan<'v>,
    tracks: &'a [Track],
    /// Tracks grouped by width, because wide tracks are reached from farther away.
    widths: Vec<Width>,
}

struct Width {
    widest: f64,
    grid: PointGrid,
    points: Vec<[usize; 2]>,
}

/// Exponents of the widths, which are powers of two (mm).
const WIDTHS: std::ops::RangeInclusive<i32> = -3..=6;

struct Landing {
    link: Link,
    end: WayEnd,
}

impl<'a, 'v> Landings<'a, 'v> {
    pub(crate) fn new(scan: &'a Scan<'v>, tracks: &'a [Track]) -> Self {
        let all = || {
            let linked = tracks.iter().enumerate().filter(|(_, track)| may_link(track));
            linked.flat_map(|(t, track)| (0..track.points.len()).map(move |n| [t, n]))
        };
        let exponent = |radius: f64| (radius.log2().floor() as i32).clamp(*WIDTHS.start(), *WIDTHS.end());
        let of_width = |power: i32| {
            let is_so_wide = |[t, n]: &[usize; 2]| exponent(tracks[*t].points[*n].radius) == power;
            let points: Vec<[usize; 2]> = all().filter(is_so_wide).collect();
            let places = points.iter().map(|[t, n]| tracks[*t].points[*n].place).collect();
            let widest = f64::powi(2.0, power + 1);
            Width { widest, grid: PointGrid::new(places, widest + WALL_VOXELS * scan.side), points }
        };
        Self { scan, tracks, widths: WIDTHS.map(of_width).filter(|width| !width.points.is_empty()).collect() }
    }

    /// Visits points whose centre is closer than `reach` and whose wall is closer than `wall` (mm).
    pub(crate) fn near(
        &self,
        place: glam::DVec3,
        wall: f64,
        reach: f64,
        mut visit: impl FnMut([usize; 2], f64),
    ) {
        for width in &self.widths {
            width.grid.near(place, reach.min(wall + width.widest), |n| {
                let of = width.points[n];
                let point = &self.tracks[of[0]].points[of[1]];
                let away = point.place.distance(place);
                if away - point.radius < wall {
                    visit(of, away);
                }
            });
        }
    }

    pub(crate) fn of<'b>(&'b self, end: &'b End, limits: &Limits) -> impl Iterator<Item = Link> + 'b {
        let places = if self.tracks[end.of[0]].confidence < limits.confidence {
            Vec::new()
        } else {
            self.places(end, limits)
        };
        let mut tries: Vec<(usize, usize)> = Vec::new();
        let from = WayEnd { place: end.place, level: end.level, contrast: end.contrast };
        places.into_iter().filter_map(move |Landing { link, end }| {
            let known = tries.iter().position(|(track, _)| *track == link.to[0]);
            let tried = known.unwrap_or_else(|| {
                tries.push((link.to[0], 0));
                tries.len() - 1
            });
            if tries[tried].1 >= PLACES_TRIED {
                return None;
            }
            let level = lowest_level(self.scan, from, end);
            let is_lumen = level >= LEVEL;
            tries[tried].1 += if is_lumen { PLACES_TRIED } else { 1 };
            is_lumen.then_some(Link { level, ..link })
        })
    }

    fn places(&self, end: &End, limits: &Limits) -> Vec<Landing> {
        let wall = (WALL * end.radius).max(WALL_VOXELS * self.scan.side).min(FARTHEST_WALL);
        let mut places = Vec::new();
        self.near(end.place, wall, LANDING_RADII * end.radius + REACH_BEYOND, |to, away| {
            let other = &self.tracks[to[0]];
            if to[0] != end.of[0] && other.confidence >= limits.confidence {
                places.extend(self.place(end, limits, to, away));
            }
        });
        places.sort_unstable_by(|a: &Landing, b: &Landing| a.link.order(&b.link));
        places
    }

    /// A link from `end` to a track point; None if the limits exclude it.
    fn place(&self, end: &End, limits: &Limits, to: [usize; 2], away: f64) -> Option<Landing> {
        let point: &TrackPoint = &self.tracks[to[0]].points[to[1]];
        let is_inside = away <= INSIDE * point.radius + self.scan.side;
        let turn = if away > 0.0 { end.direction.dot(point.place - end.place) / away } else { 1.0 };
        let is_blurred = end.radius < NARROW_VOXELS * self.scan.side && end.level < point.level;
        let counts = if is_blurred { limits.narrow } else { 1.0 };
        let unlike = counts * (end.level - point.level).abs() / end.contrast.max(point.contrast);
        if unlike >= limits.unlike || (!is_inside && turn < limits.turn) {
            return None;
        }
        let gap = (away - point.radius).max(0.0);
        let cost = away + gap + TURN * away * (1.0 - turn + unlike);
        let link = Link { from: end.of, to, cost, gap, level: 0.0 };
        let end = WayEnd { place: point.place, level: point.level, contrast: point.contrast };
        Some(Landing { link, end })
    }
}
