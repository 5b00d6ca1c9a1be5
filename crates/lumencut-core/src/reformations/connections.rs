//! The points at which vessels of a tree meet, and distances between its points along the tree.

use std::borrow::Cow;
use std::collections::{BinaryHeap, HashMap};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;

use crate::math::position_map::PositionMap;
use crate::math::projection::Level;
use crate::math::same_place::VESSEL_END;

#[derive(Clone, Copy, Debug)]
struct Meeting {
    vessel: u32,
    arc_length: f64,
    junction: u32,
}

/// An index into `Connections::meetings`, reachable from a junction, and its distance (mm).
#[derive(Clone, Copy, Debug)]
struct Reached {
    meeting: u32,
    distance: f32,
}

/// The largest number of reachable meetings cached over all junctions; others are recomputed on each use.
const MAX_CACHED: usize = 1 << 24;

/// The points at which vessels of a tree meet: one of them ends there, at a point of another.
#[derive(Debug)]
pub struct Connections {
    meetings: Vec<Meeting>,
    first_of_vessel: Vec<u32>,
    of_junction: Vec<Vec<u32>>,
    /// The meetings reachable from each junction, computed on first use, and their number so far.
    reached: Vec<OnceLock<Vec<Reached>>>,
    kept: AtomicUsize,
    /// The longest distance along the tree (mm) between points that count as near.
    threshold: f64,
}

impl Connections {
    /// The connections of the vessels of `level`, for distances along the tree up to `threshold` mm.
    pub fn new(level: &Level, threshold: f64) -> Self {
        let slots = level.first_slot.windows(2).flat_map(|slots| [slots[0], slots[1] - 1]);
        let ends = Ends::of(slots.map(|slot| level.points[slot as usize]));
        let (mut meetings, mut first_of_vessel) = (Vec::new(), vec![0]);
        let mut of_junction = vec![Vec::new(); ends.count as usize];
        for (vessel, slots) in (0..).zip(level.first_slot.windows(2)) {
            for slot in slots[0] as usize..slots[1] as usize {
                let Some(junction) = ends.at(level.points[slot]) else { continue };
                of_junction[junction as usize].push(meetings.len() as u32);
                let arc_length = f64::from(level.arc_length[slot]);
                meetings.push(Meeting { vessel, arc_length, junction });
            }
            first_of_vessel.push(meetings.len() as u32);
        }
        let reached = of_junction.iter().map(|_| OnceLock::new()).collect();
        Self { meetings, first_of_vessel, of_junction, reached, kept: AtomicUsize::new(0), threshold }
    }

    /// Whether two points, each a vessel and an arc length (mm), lie within the threshold along the tree.
    pub fn are_near(&self, (vessel, arc_length): (i32, f32), (other, other_arc_length): (i32, f32)) -> bool {
        let (from, to) = (f64::from(arc_length), f64::from(other_arc_length));
        if vessel == other && (from - to).abs() <= self.threshold {
            return true;
        }
        let [first, end] = [other, other + 1].map(|id| self.first_of_vessel[id as usize]);
        self.meetings_of(vessel as u32).iter().any(|meeting| {
            let left = self.threshold - (meeting.arc_length - from).abs();
            if left < 0.0 {
                return false;
            }
            let reached = self.reached(meeting.junction);
            let start = reached.partition_point(|at| at.meeting < first);
            let there = reached[start..].iter().take_while(|at| at.meeting < end);
            there.into_iter().any(|at| {
                let arc_length = self.meetings[at.meeting as usize].arc_length;
                f64::from(at.distance) + (arc_length - to).abs() <= left
            })
        })
    }

    /// Parts of vessels that may lie within the threshold: vessel id, first and last arc length (mm).
    pub fn stretches(&self, vessel: u32, [low, high]: [f64; 2]) -> Vec<(u32, [f64; 2])> {
        let mut stretches = vec![(vessel, [low - self.threshold, high + self.threshold])];
        for meeting in self.meetings_of(vessel) {
            let left = self.threshold - (low - meeting.arc_length).max(meeting.arc_length - high).max(0.0);
            if left < 0.0 {
                continue;
            }
            for at in self.reached(meeting.junction).iter() {
                let Meeting { vessel, arc_length, .. } = self.meetings[at.meeting as usize];
                let further = left - f64::from(at.distance);
                if further >= 0.0 {
                    stretches.push((vessel, [arc_length - further, arc_length + further]));
                }
            }
        }
        stretches
    }

    fn meetings_of(&self, vessel: u32) -> &[Meeting] {
        let [first, end] = [vessel, vessel + 1].map(|id| self.first_of_vessel[id as usize] as usize);
        &self.meetings[first..end]
    }

    fn reached(&self, junction: u32) -> Cow<'_, [Reached]> {
        let known = &self.reached[junction as usize];
        if let Some(reached) = known.get() {
            return Cow::Borrowed(reached);
        }
        let mut reached = Vec::new();
        for (junction, distance) in self.shortest_ways(junction) {
            let there = self.of_junction[junction as usize].iter();
            reached.extend(there.map(|meeting| Reached { meeting: *meeting, distance: distance as f32 }));
        }
        reached.sort_unstable_by_key(|at| at.meeting);
        if self.kept.fetch_add(reached.len(), Ordering::Relaxed) + reached.len() > MAX_CACHED {
            return Cow::Owned(reached);
        }
        Cow::Borrowed(known.get_or_init(|| reached))
    }

    /// Junctions within the threshold of `start`, with distances along the tree (mm): Dijkstra's algorithm.
    fn shortest_ways(&self, start: u32) -> Vec<(u32, f64)> {
        let mut known: HashMap<u32, f64> = HashMap::from([(start, 0.0)]);
        // Bits of non-negative floats sort like the floats; the heap pops the largest first.
        let mut waiting = BinaryHeap::from([(std::cmp::Reverse(0.0f64.to_bits()), start)]);
        while let Some((std::cmp::Reverse(bits), junction)) = waiting.pop() {
            let distance = f64::from_bits(bits);
            if known[&junction] < distance {
                continue;
            }
            for n in &self.of_junction[junction as usize] {
                let here = self.meetings[*n as usize];
                for there in self.meetings_of(here.vessel) {
                    let further = distance + (there.arc_length - here.arc_length).abs();
                    let shortest = known.get(&there.junction).copied().unwrap_or(f64::MAX);
                    if further <= self.threshold && further < shortest {
                        known.insert(there.junction, further);
                        waiting.push((std::cmp::Reverse(further.to_bits()), there.junction));
                    }
                }
            }
        }
        known.into_iter().collect()
    }
}

/// The ends of all vessels; ends at the same position are one junction.
pub(super) struct Ends {
    places: PositionMap<u32>,
    pub count: u32,
}

impl Ends {
    pub(super) fn of(places: impl Iterator<Item = DVec3>) -> Self {
        let mut ends = Self { places: PositionMap::new(VESSEL_END), count: 0 };
        places.for_each(|end| ends.add(end));
        ends
    }

    fn add(&mut self, end: DVec3) {
        if self.at(end).is_none() {
            self.places.add(end, &self.count);
            self.count += 1;
        }
    }

    pub(super) fn at(&self, point: DVec3) -> Option<u32> {
        self.places.at(point).copied()
    }
}
