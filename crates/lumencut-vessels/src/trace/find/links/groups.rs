//! Groups of connected tracks, and distances along their tracks and links.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use crate::trace::find::links::link::Link;
use crate::trace::find::track::Track;
use lumencut_core::math::arc_length::arc_lengths;

/// Loops shorter than this enclose no tissue: radii at the link that closes them, or mm if that is larger.
pub(crate) const SMALL_LOOP: f64 = 12.0;
const SMALL_LOOP_LENGTH: f64 = 10.0;

pub(crate) struct Groups<'a> {
    tracks: &'a [Track],
    pub links: Vec<Link>,
    at_track: Vec<Vec<usize>>,
    /// Arc lengths of the points of each track (mm).
    lengths: Vec<Vec<f64>>,
    parents: Vec<usize>,
}

impl<'a> Groups<'a> {
    pub(crate) fn new(tracks: &'a [Track]) -> Self {
        let length =
            |track: &Track| arc_lengths(&track.points.iter().map(|point| point.place).collect::<Vec<_>>());
        Self {
            tracks,
            links: Vec::new(),
            at_track: vec![Vec::new(); tracks.len()],
            lengths: tracks.iter().map(length).collect(),
            parents: (0..tracks.len()).collect(),
        }
    }

    pub(crate) fn group(&self, track: usize) -> usize {
        let mut root = track;
        while self.parents[root] != root {
            root = self.parents[root];
        }
        root
    }

    pub(crate) fn are_apart(&self, link: &Link) -> bool {
        self.group(link.from[0]) != self.group(link.to[0])
    }

    pub(crate) fn add_between_trees(&mut self, link: Link) {
        if self.are_apart(&link) {
            self.add(link);
        }
    }

    /// Adds a link unless it closes a small loop. Larger loops are kept, such as the arterial circle of the brain.
    pub(crate) fn add_unless_small_loop(&mut self, link: Link) {
        let radius = |[track, point]: [usize; 2]| self.tracks[track].points[point].radius;
        let length = self.length_of(&link);
        let small = SMALL_LOOP_LENGTH.max(SMALL_LOOP * radius(link.from).max(radius(link.to))) - length;
        if self.are_apart(&link) || self.way(link.from, link.to, small).is_none() {
            self.add(link);
        }
    }

    fn add(&mut self, link: Link) {
        let [a, b] = [self.group(link.from[0]), self.group(link.to[0])];
        self.parents[a.max(b)] = a.min(b);
        for track in [link.from[0], link.to[0]] {
            self.at_track[track].push(self.links.len());
        }
        self.links.push(link);
    }

    fn length_of(&self, link: &Link) -> f64 {
        let place = |[track, point]: [usize; 2]| self.tracks[track].points[point].place;
        place(link.from).distance(place(link.to))
    }

    /// Shortest path between two points along tracks and links; None if longer than `most` mm.
    fn way(&self, from: [usize; 2], to: [usize; 2], most: f64) -> Option<f64> {
        let along =
            |[track, a]: [usize; 2], b: usize| (self.lengths[track][a] - self.lengths[track][b]).abs();
        // The bits of non-negative floats have the same order as their values.
        let mut open = BinaryHeap::from([Reverse((0, from))]);
        let mut done = BTreeSet::new();
        let mut shortest: Option<f64> = None;
        while let Some(Reverse((bits, here))) = open.pop() {
            let walked = f64::from_bits(bits);
            if walked > shortest.unwrap_or(most) {
                break;
            }
            if !done.insert(here) {
                continue;
            }
            if here[0] == to[0] {
                let whole = walked + along(here, to[1]);
                shortest = shortest.into_iter().chain((whole <= most).then_some(whole)).reduce(f64::min);
            }
            for &number in &self.at_track[here[0]] {
                let link = &self.links[number];
                for [near, far] in [[link.from, link.to], [link.to, link.from]] {
                    if near[0] == here[0] {
                        let way = walked + along(here, near[1]) + self.length_of(link);
                        open.push(Reverse((way.to_bits(), far)));
                    }
                }
            }
        }
        shortest
    }
}
