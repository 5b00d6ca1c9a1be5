//! The strips of all pieces in the image, and the maps between image positions and the world.

use glam::{DVec2, DVec3};

use super::growth::Growth;
use super::pieces::Piece;
use super::strip::{Strip, normals};
use crate::math::same_place::ON_PICTURE;
use crate::reformations::cut_locus::MIN_DISTANCE_EXCESS;
use crate::reformations::segments::Segments;

/// The largest number of bisections in the search for a section; this many reach the resolution of an f64.
const BISECTIONS: usize = 60;

const MAX_MOVES: usize = 4;

#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    /// Position in the image (mm).
    pub place: DVec2,
    /// To the right in the image.
    pub normal: DVec2,
    /// Position in the world (mm, LPS), and the direction to the right there.
    pub point: DVec3,
    pub across: DVec3,
    /// Arc length along the vessel (mm).
    pub at: f64,
}

/// A position on a sheet: segment, share along it (below 0 or above 1 beyond free ends), offset right (mm).
#[derive(Clone, Copy, Debug)]
pub(super) struct SheetPosition {
    pub segment: usize,
    pub share: f64,
    pub aside: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Sheet {
    /// The stations, piece by piece: vessels in their order, pieces along each vessel.
    stations: Vec<Station>,
    start: Vec<usize>,
    piece: Vec<usize>,
    seen: Segments,
    world: Segments,
    /// Width of the sheet on each side (mm), and largest distance of its points from vessels.
    width: f64,
    reach: f64,
}

impl Sheet {
    pub(super) fn new(pieces: &[Piece], strips: &[Strip], places: &[Vec<DVec2>], width: f64) -> Self {
        let (mut stations, mut start, mut piece_of) = (Vec::new(), Vec::new(), Vec::new());
        for (n, piece) in pieces.iter().enumerate() {
            let first = stations.len();
            let normals = normals(&places[n]);
            stations.extend((0..piece.at.len()).map(|i| Station {
                place: places[n][i],
                normal: normals[i],
                point: piece.points[i],
                across: strips[n].across[i],
                at: piece.at[i],
            }));
            start.extend(first..stations.len() - 1);
            piece_of.resize(start.len(), n);
        }
        let ends = |place: &dyn Fn(&Station) -> DVec3| {
            Segments::new(start.iter().map(|n| [place(&stations[*n]), place(&stations[n + 1])]).collect())
        };
        let seen = ends(&|station| station.place.extend(0.0));
        let world = ends(&|station| station.point);
        let longest = stations.iter().map(|station| station.across.length()).fold(1.0, f64::max);
        let reach = width * longest * (1.0 + ON_PICTURE) + ON_PICTURE;
        Self { seen, world, reach, stations, start, piece: piece_of, width }
    }

    pub(super) fn stations_of(&self, piece: usize) -> &[Station] {
        let [first, end] = [piece, piece + 1].map(|n| self.piece.partition_point(|of| *of < n));
        &self.stations[self.start[first]..self.start[end - 1] + 2]
    }

    pub(super) fn piece(&self, place: &SheetPosition) -> usize {
        self.piece[place.segment]
    }

    /// The segments that may be nearest to some position within `radius` (mm) of a point of the image.
    pub(super) fn near(&self, middle: DVec2, radius: f64) -> Vec<usize> {
        let middle = middle.extend(0.0);
        let Some((_, squared)) = self.seen.nearest(middle, self.width + radius) else { return Vec::new() };
        // The radius has a margin for rounding.
        self.seen.within(middle, (squared.sqrt() + 2.0 * radius) * (1.0 + 1e-9) + ON_PICTURE)
    }

    /// The position of an image point (mm) on the nearest segment, or on the first of equally near ones.
    pub(super) fn place(&self, seen: DVec2) -> Option<SheetPosition> {
        self.place_within(seen, self.width)
    }

    fn place_within(&self, seen: DVec2, limit: f64) -> Option<SheetPosition> {
        let (segment, _) = self.seen.nearest(seen.extend(0.0), limit)?;
        Some(self.on_segment(segment, seen))
    }

    /// The nearest segment within the width, of `segments` in rising order; the first of equally near ones.
    pub(super) fn nearest_among(&self, segments: &[usize], seen: DVec2) -> Option<usize> {
        let mut best = (None, self.width * self.width);
        for segment in segments {
            let squared = self.seen.squared_distance(*segment, seen.extend(0.0));
            if squared < best.1 || (squared == best.1 && best.0.is_none()) {
                best = (Some(*segment), squared);
            }
        }
        best.0
    }

    /// The position of an image point on a segment; at a corner, it may be on the next segment.
    pub(super) fn on_segment(&self, mut segment: usize, seen: DVec2) -> SheetPosition {
        let mut place = self.across_segment(segment, seen);
        for _ in 0..MAX_MOVES {
            let next = if place.share > 1.0 { segment + 1 } else { segment.wrapping_sub(1) };
            let is_inside = (0.0..=1.0).contains(&place.share);
            if is_inside || self.piece.get(next) != self.piece.get(segment) {
                break;
            }
            let other = self.across_segment(next, seen);
            let comes_back = if next > segment { other.share < 0.0 } else { other.share > 1.0 };
            if comes_back {
                place.share = place.share.clamp(0.0, 1.0);
                break;
            }
            (segment, place) = (next, other);
        }
        self.ended(place)
    }

    fn ended(&self, place: SheetPosition) -> SheetPosition {
        let is_same = |other: usize| self.piece.get(other) == self.piece.get(place.segment);
        let low = if is_same(place.segment.wrapping_sub(1)) { 0.0 } else { f64::NEG_INFINITY };
        let high = if is_same(place.segment + 1) { 1.0 } else { f64::INFINITY };
        SheetPosition { share: place.share.clamp(low, high), ..place }
    }

    /// The position of an image point on a segment: on the line across it that runs through the point.
    fn across_segment(&self, segment: usize, seen: DVec2) -> SheetPosition {
        let [a, b] = self.ends(segment);
        let step = b.place - a.place;
        let length = step.length();
        let along = step / length;
        let right = DVec2::new(along.y, -along.x);
        let from = seen - a.place;
        let aside = from.dot(right);
        // The parallel to the segment through the point meets the lines across the segment's ends at these lengths.
        let start = aside * a.normal.dot(along);
        let end = length + aside * b.normal.dot(along);
        let share = if end > start { (from.dot(along) - start) / (end - start) } else { 0.5 };
        if share > 1.0 {
            return SheetPosition { segment, share: 1.0 + (from.dot(along) - end) / length, aside };
        }
        if share < 0.0 {
            return SheetPosition { segment, share: (from.dot(along) - start) / length, aside };
        }
        SheetPosition { segment, share, aside }
    }

    fn ends(&self, segment: usize) -> [Station; 2] {
        let start = self.start[segment];
        [self.stations[start], self.stations[start + 1]]
    }

    pub(super) fn point(&self, place: &SheetPosition) -> DVec3 {
        let [a, b] = self.ends(place.segment);
        self.center(place) + a.across.lerp(b.across, place.share.clamp(0.0, 1.0)) * place.aside
    }

    /// The point of the vessel at a position, extrapolated straight at ends.
    fn center(&self, place: &SheetPosition) -> DVec3 {
        let [a, b] = self.ends(place.segment);
        a.point.lerp(b.point, place.share)
    }

    /// The direction of a slab, across the sheet; into the scene if the vessel is seen from its side.
    pub(super) fn slab_direction(&self, place: &SheetPosition) -> DVec3 {
        let [a, b] = self.ends(place.segment);
        let across = a.across.lerp(b.across, place.share.clamp(0.0, 1.0));
        (b.point - a.point).cross(across).normalize_or_zero()
    }

    pub(super) fn arc_length(&self, place: &SheetPosition) -> f64 {
        let [a, b] = self.ends(place.segment);
        a.at + (b.at - a.at) * place.share.clamp(0.0, 1.0)
    }

    pub(super) fn seen(&self, place: &SheetPosition) -> DVec2 {
        let [a, b] = self.ends(place.segment);
        let share = place.share.clamp(0.0, 1.0);
        a.place.lerp(b.place, place.share) + a.normal.lerp(b.normal, share) * place.aside
    }

    /// Whether the sheet runs backwards, or another part of the tree is nearer to the point that it shows.
    pub(super) fn is_folded(&self, place: &SheetPosition) -> bool {
        let [a, b] = self.ends(place.segment);
        let along = b.point - a.point;
        let is_beyond = !(0.0..=1.0).contains(&place.share);
        let advance = along + (b.across - a.across) * place.aside;
        if !is_beyond && advance.dot(along) <= 0.0 {
            return true;
        }
        let excess = (place.share - place.share.clamp(0.0, 1.0)) * along.length();
        let nearer = place.aside.hypot(excess) * (1.0 - MIN_DISTANCE_EXCESS) - ON_PICTURE;
        nearer > 0.0 && self.world.any_within(self.point(place), nearer)
    }

    /// The position that shows a world point; of several, that nearest to the sheet, then to its vessel.
    pub(super) fn place_of(&self, point: DVec3) -> Option<SheetPosition> {
        let mut best: Option<(SheetPosition, [f64; 2])> = None;
        for segment in self.world.within(point, self.reach) {
            for place in self.sections(segment, point) {
                let off = self.point(&place).distance(point);
                let rank = [if off > ON_PICTURE { 1.0 } else { 0.0 }, self.center(&place).distance(point)];
                let is_better = best
                    .is_none_or(|(_, best)| rank[0] < best[0] || (rank[0] == best[0] && rank[1] < best[1]));
                if is_better && self.is_shown(&place) {
                    best = Some((place, rank));
                }
            }
        }
        best.map(|(place, _)| place)
    }

    fn is_shown(&self, place: &SheetPosition) -> bool {
        // Tolerates rounding at the very edge.
        let there = self.place_within(self.seen(place), self.width + ON_PICTURE);
        let Some(there) = there else { return false };
        self.piece(&there) == self.piece(place)
            && (self.arc_length(&there) - self.arc_length(place)).abs() < ON_PICTURE.sqrt()
    }

    /// The positions on a segment, or beyond it at an end of the piece, whose sections contain a world point.
    fn sections(&self, segment: usize, point: DVec3) -> Vec<SheetPosition> {
        let [a, b] = self.ends(segment);
        let along = b.point - a.point;
        // `ahead`: the point's distance beyond the section at a share of the segment (scaled); `aside`: to the right.
        let ahead = |share: f64| {
            let across = a.across.lerp(b.across, share);
            let normal = along * across.length_squared() - across * along.dot(across);
            (point - a.point.lerp(b.point, share)).dot(normal)
        };
        let aside = |share: f64, inner: f64| {
            let across = a.across.lerp(b.across, inner);
            (point - a.point.lerp(b.point, share)).dot(across) / across.length_squared()
        };
        let place = |share: f64| SheetPosition { segment, share, aside: aside(share, share.clamp(0.0, 1.0)) };
        let (first, last) = (ahead(0.0), ahead(1.0));
        let mut found = Vec::new();
        if (first >= 0.0) != (last >= 0.0) {
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..BISECTIONS {
                let middle = f64::midpoint(low, high);
                let half = if (ahead(middle) >= 0.0) == (first >= 0.0) { &mut low } else { &mut high };
                *half = middle;
            }
            found.push(place(f64::midpoint(low, high)));
        }
        // There may be no section that contains the point, if it lies off the sheet, or by rounding.
        let beyond = |share: f64, towards: DVec3| {
            share + (point - a.point.lerp(b.point, share)).dot(towards) / along.length_squared()
        };
        if first <= 0.0 {
            let share = beyond(0.0, perpendicular(along, a.across));
            found.push(self.ended(place(share)));
        }
        if last >= 0.0 {
            found.push(self.ended(place(beyond(1.0, perpendicular(along, b.across)))));
        }
        found.retain(|place| place.aside.abs() <= self.width);
        found
    }
}

fn perpendicular(along: DVec3, across: DVec3) -> DVec3 {
    along - across * (along.dot(across) / across.length_squared())
}

/// The stations in the image (mm): each piece begins where its predecessor ends, turned with it.
pub(super) fn placed(
    pieces: &[Piece],
    growth: &Growth,
    places: &[Vec<DVec2>],
    turns: &[f64],
    roots: &[DVec2],
) -> Vec<Vec<DVec2>> {
    let mut placed: Vec<Vec<DVec2>> = vec![Vec::new(); pieces.len()];
    let mut turned = turns.to_vec();
    let mut begin = vec![DVec2::ZERO; pieces.len()];
    for (part, root) in growth.parts.iter().zip(roots) {
        part.first.iter().for_each(|piece| begin[*piece] = *root);
        for &piece in &part.order {
            let turn = DVec2::from_angle(turned[piece]);
            placed[piece] = places[piece].iter().map(|place| begin[piece] + turn.rotate(*place)).collect();
            let end = if growth.is_reversed[piece] { 0 } else { placed[piece].len() - 1 };
            for child in &growth.children[piece] {
                begin[*child] = placed[piece][end];
                turned[*child] += turned[piece];
            }
        }
    }
    placed
}
