//! Follows a tube in both directions from a candidate, with running estimates of level, contrast and radius.

use std::ops::Range;

use glam::DVec3;

use crate::trace::find::candidates::{Candidate, Floors};
use crate::trace::find::paint::{Paint, Painted};
use crate::trace::find::pyramid::{Level, Pyramid};
use crate::trace::find::section::{Section, TOUCHED};
use crate::trace::find::track::TrackPoint;

/// Step as a fraction of the radius; its maximum (voxels of the level) and minimum (finest-level voxels).
const STEP: f64 = 0.45;
const LONGEST_STEP: f64 = 1.5;
const SHORTEST_STEP: f64 = 0.5;

const ROUNDS: usize = 2;

/// Limits of a good section: closure, fraction of contrasting rays, radius relative to the running one
/// (factor and voxels), and shift from the expected position (radii plus voxels).
const LEAST_CLOSURE: f64 = 0.6;
const LEAST_CONTRAST_SHARE: f64 = 0.6;
const NARROWER: [f64; 2] = [0.6, 0.3];
const WIDER: [f64; 2] = [1.5, 0.3];
const MOST_SHIFT: [f64; 2] = [0.6, 0.4];

/// Maximum radius of a tracked tube (mm).
const WIDEST: f64 = 22.0;

/// Limits of a section: level difference and contrast (times the running contrast), contrast (times the noise).
const LEVEL: f64 = 0.45;
const CONTRAST: f64 = 0.45;
const NOISES: f64 = 3.0;

/// Weight of a new section in the running level and contrast, and in the running radius.
const OF_LEVEL: f64 = 0.15;
const OF_RADIUS: f64 = 0.3;

/// Length of the chord that gives the direction: a multiple of the radius plus some voxels.
const CHORD: [f64; 2] = [1.2, 1.0];

/// Maximum length of a gap: radii, or voxels if larger. Steps darker than `DARK` (of the contrast) count twice.
const GAP_RADII: f64 = 2.2;
const GAP_VOXELS: f64 = 3.0;
const DARK: f64 = 0.6;

/// A track ends where it meets another one, unless that one is darker by more than this fraction of the contrast.
pub(crate) const DARKER: f64 = 0.35;

pub(crate) const MOST_STEPS: usize = 20_000;

/// A track has returned to itself if it comes within `RETURNED` radii of a point `BEHIND` radii back on it.
const RETURNED: f64 = 0.8;
const BEHIND: f64 = 4.0;

/// Data for tracking. Lengths are in finest-level voxels.
pub(crate) struct Tracker<'a> {
    pub(crate) pyramid: &'a Pyramid,
    pub levels_examined: Range<usize>,
    pub paint: &'a Paint,
    /// Intensity level of each painted track.
    pub levels: &'a [f64],
    pub(crate) floors: Floors,
}

#[derive(Clone, Copy)]
struct Running {
    place: DVec3,
    direction: DVec3,
    radius: f64,
    level: f64,
    contrast: f64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Seen {
    Tube,
    BesideBone,
    Nothing,
}

type Look = fn(&Level, DVec3, DVec3, f64) -> Section;

impl Tracker<'_> {
    /// Points of the track through a candidate (finest-level voxels), with at most `most_steps` per direction.
    pub(crate) fn track(&self, from: &Candidate, most_steps: usize) -> Option<Vec<TrackPoint>> {
        let level = self.pyramid.level_for(from.radius, &self.levels_examined);
        let section = Section::look(level, from.place, from.direction, from.radius);
        let contrast = section.contrast;
        if contrast <= self.floors.of_section() || section.closure < LEAST_CLOSURE {
            return None;
        }
        let place = from.place + section.shift;
        let start = Running {
            place,
            direction: from.direction,
            radius: section.radius,
            level: section.level,
            contrast,
        };
        let turned = Running { direction: -from.direction, ..start };
        let mut points = self.follow(turned, &[], most_steps);
        points.reverse();
        for point in &mut points {
            point.direction = -point.direction;
        }
        points.push(point(&start, &section, true));
        let behind: Vec<DVec3> = points.iter().map(|point| point.place).collect();
        points.extend(self.follow(start, &behind, most_steps));
        Some(points)
    }

    fn side(&self) -> f64 {
        self.pyramid.levels[self.levels_examined.start].side
    }

    fn step(&self, radius: f64) -> f64 {
        let level = self.pyramid.level_for(radius, &self.levels_examined);
        (STEP * radius).min(LONGEST_STEP * level.side).max(SHORTEST_STEP * self.side())
    }

    fn follow(&self, mut running: Running, before: &[DVec3], most_steps: usize) -> Vec<TrackPoint> {
        let mut points: Vec<TrackPoint> = Vec::new();
        let mut way: Vec<DVec3> = before.to_vec();
        way.push(running.place);
        // Sections next to bone are kept only if the tube continues after them or meets another track.
        let (mut gap, mut sure, mut last) = (0.0, 0, 0);
        for _ in 0..most_steps {
            let step = self.step(running.radius);
            let ahead = running.place + running.direction * step;
            if !self.pyramid.grid.holds(ahead) {
                break;
            }
            if self.ends_in(ahead, &running) {
                sure = last;
                break;
            }
            let (place, section, seen) = self.best(ahead, &running);
            if seen != Seen::Nothing {
                running = self.moved(running, place, &section, &way);
                points.push(point(&running, &section, true));
                (gap, last) = (0.0, points.len());
                if seen == Seen::Tube {
                    sure = last;
                }
                if has_returned(&way, &running, step) {
                    break;
                }
            } else {
                let is_dark = section.level < running.level - DARK * running.contrast;
                gap += if is_dark { 2.0 * step } else { step };
                if gap > (GAP_RADII * running.radius).max(GAP_VOXELS * self.side()) {
                    break;
                }
                running.place = ahead;
                points.push(point(&running, &section, false));
            }
            way.push(running.place);
        }
        points.truncate(sure);
        points
    }

    fn ends_in(&self, place: DVec3, running: &Running) -> bool {
        match self.paint.at(place) {
            Painted::Lumen(track) => self.levels[track as usize] >= running.level - DARKER * running.contrast,
            Painted::Empty | Painted::Rejected => false,
        }
    }

    /// The centred section and its kind. If it is not that of a tube, it is examined again as that of an artery next
    /// to bone.
    fn best(&self, ahead: DVec3, running: &Running) -> (DVec3, Section, Seen) {
        let good = |look: Look, seen: Seen| {
            let (place, section) = self.centered(ahead, running, look);
            let is_good = self.is_good(&section, place, ahead, running);
            (place, section, if is_good { seen } else { Seen::Nothing })
        };
        let plain = good(Section::look, Seen::Tube);
        if plain.2 == Seen::Tube || running.radius > TOUCHED * self.side() {
            return plain;
        }
        good(Section::beside_bone, Seen::BesideBone)
    }

    fn centered(&self, ahead: DVec3, running: &Running, look: Look) -> (DVec3, Section) {
        let at = |place: DVec3, radius: f64| {
            look(self.pyramid.level_for(radius, &self.levels_examined), place, running.direction, radius)
        };
        let mut place = ahead;
        let mut section = at(place, running.radius);
        for _ in 1..ROUNDS {
            place += section.shift;
            section = at(place, section.radius.max(SHORTEST_STEP));
        }
        (place + section.shift, section)
    }

    fn is_good(&self, section: &Section, place: DVec3, ahead: DVec3, running: &Running) -> bool {
        let side = self.side();
        let radius = section.radius;
        section.closure >= LEAST_CLOSURE
            && section.contrast_share >= LEAST_CONTRAST_SHARE
            && radius > NARROWER[0] * running.radius - NARROWER[1] * side
            && radius < WIDER[0] * running.radius + WIDER[1] * side
            && radius * self.pyramid.grid.side < WIDEST
            && place.distance(ahead) < MOST_SHIFT[0] * running.radius + MOST_SHIFT[1] * side
            && (section.level - running.level).abs() < LEVEL * running.contrast
            && section.contrast > (CONTRAST * running.contrast).max(NOISES * self.floors.noise)
    }

    fn moved(&self, running: Running, place: DVec3, section: &Section, way: &[DVec3]) -> Running {
        let reach = CHORD[0] * running.radius + CHORD[1] * self.side();
        let from = way.iter().rev().find(|point| point.distance(place) >= reach).or(way.first());
        let chord = from.map_or(DVec3::ZERO, |from| (place - *from).normalize_or_zero());
        // Points behind the start were tracked in the opposite direction, so they do not give the direction.
        let chord = if chord.dot(running.direction) > 0.0 { chord } else { DVec3::ZERO };
        let toward = |old: f64, new: f64, share: f64| old + share * (new - old);
        Running {
            place,
            direction: (running.direction + chord).normalize_or(running.direction),
            radius: toward(running.radius, section.radius, OF_RADIUS),
            level: toward(running.level, section.level, OF_LEVEL),
            contrast: toward(running.contrast, section.contrast, OF_LEVEL),
        }
    }
}

fn point(running: &Running, section: &Section, is_good: bool) -> TrackPoint {
    TrackPoint {
        place: running.place,
        direction: running.direction,
        radius: running.radius,
        level: if is_good { section.level } else { running.level },
        contrast: if is_good { section.contrast } else { running.contrast },
        closure: section.closure,
        is_good,
    }
}

fn has_returned(way: &[DVec3], running: &Running, step: f64) -> bool {
    let near = (BEHIND * running.radius / step).ceil() as usize + 4;
    let far = way.len().saturating_sub(near);
    way[..far].iter().any(|point| point.distance(running.place) < RETURNED * running.radius)
}

#[cfg(test)]
#[path = "tests/one_track.rs"]
mod tests;
