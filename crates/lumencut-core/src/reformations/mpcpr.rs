//! Multipath curved planar reformation (mpCPR): the projected CPRs of all vessels of a tree in one image.
//!
//! Kanitsar, Wegenkittl, Fleischmann and Gröller, "Advanced Curved Planar Reformation: Flattening of Vascular
//! Structures", IEEE Visualization 2003, doi:10.1109/VISUAL.2003.1250353. Each vessel c(t) is cut along the
//! surface c(t) + s·(v × u), with v the direction of view and u upwards in the image. So every row cuts a
//! vessel in points, and a pixel shows the depth of the point nearest in its row.

use rayon::prelude::*;

use super::found::{Found, PixelContent, expect_lengths, work};
use crate::camera::Camera;
use crate::error::Result;
use crate::frame::Frame;
use crate::math::projection::{Level, Radii};
use crate::pipeline::Request;
use crate::scene::LeveledTree;
use crate::stages::depth::Sheet;

const POINTS_PER_BLOCK: usize = 64;

/// The slope (mm per mm) is clamped to this; if a vessel runs along a row, it would be unbounded.
const MAX_SLOPE: f64 = 1e9;

/// The position of every pixel of a view by mpCPR. The setting `centerline_smoothing` applies, and
/// `unknown_radius` if silhouettes ask for lumen; there are neither levels of detail nor a depth filter.
///
/// Rows that no vessel crosses lie beyond every volume ([`crate::math::lanes::FAR`]) and have the vessel
/// [`super::NO_VESSEL`]. Fails with [`crate::error::ErrorKind::Settings`] for a setting outside its range,
/// [`crate::error::ErrorKind::VesselTree`] for a vessel without length.
pub fn mpcpr(tree: &LeveledTree, request: &Request) -> Result<Frame> {
    request.settings.check()?;
    let levels = tree.levels(0, request.settings.centerline_smoothing);
    expect_lengths(&levels[0])?;
    let (camera, work) = (request.camera, work(request));
    let radii = Radii { scale: 1.0, unknown: request.settings.unknown_radius as f32 };
    let (lines, width) = (Lines::new(&levels[0], camera, radii), camera.size()[0]);
    let mut found = Found::nothing(work.pixels());
    let Found { depth, vessel, sheet, folded } = &mut found;
    let rows = depth.par_chunks_mut(width).zip(vessel.par_chunks_mut(width));
    let rows = rows.zip(sheet.par_chunks_mut(width)).zip(folded.par_chunks_mut(width));
    rows.enumerate().try_for_each(|(j, (((depth, vessel), sheet), folded))| {
        work.begin(width)?;
        let mut row = lines.row(camera.view_y(j));
        for i in 0..width {
            let Some(place) = row.nearest_place(camera.view_x(i)) else { break };
            (depth[i], vessel[i], sheet[i], folded[i]) =
                (place.depth, place.vessel, place.sheet, place.is_folded);
        }
        Ok(())
    })?;
    found.into_frame(request)
}

#[derive(Clone, Copy)]
struct Point {
    x: f64,
    y: f64,
    z: f64,
    radius: f64,
    vessel: i32,
}

struct Lines {
    points: Vec<Point>,
    /// The smallest and largest y of the segments that start in each block of points.
    blocks: Vec<[f64; 2]>,
}

impl Lines {
    fn new(level: &Level, camera: &Camera, radii: Radii) -> Self {
        let slots = level.points.iter().zip(&level.radii).zip(&level.vessel_of_slot);
        let points: Vec<Point> = slots
            .map(|((point, radius), vessel)| {
                let view = camera.view_from_world(*point);
                Point {
                    x: view.x,
                    y: view.y,
                    z: view.z,
                    radius: f64::from(radii.of(*radius)),
                    vessel: *vessel,
                }
            })
            .collect();
        let range = |start: usize| {
            // The last segment of a block ends at the first point of the next one.
            let ends = points[start..points.len().min(start + POINTS_PER_BLOCK + 1)].iter();
            ends.fold([f64::MAX, f64::MIN], |[low, high], p| [low.min(p.y), high.max(p.y)])
        };
        let blocks = (0..points.len()).step_by(POINTS_PER_BLOCK).map(range).collect();
        Self { points, blocks }
    }

    fn row(&self, y: f64) -> Row {
        let mut row = Row::default();
        for (n, &[low, high]) in self.blocks.iter().enumerate() {
            if low <= y && y <= high {
                let starts = n * POINTS_PER_BLOCK..(self.points.len() - 1).min((n + 1) * POINTS_PER_BLOCK);
                starts.for_each(|slot| self.cross(slot, y, &mut row));
            }
        }
        row.finish();
        row
    }

    /// Adds the crossing of the row with the segment from `slot`. A segment includes its start but not its
    /// end, except for the last segment of a vessel; so each crossing counts once.
    fn cross(&self, slot: usize, y: f64, row: &mut Row) {
        let (a, b) = (self.points[slot], self.points[slot + 1]);
        if a.vessel != b.vessel {
            return;
        }
        let is_last = self.points.get(slot + 2).is_none_or(|next| next.vessel != a.vessel);
        if a.y == y && b.y == y {
            row.runs.push(Run { a, b, slot });
        } else if a.y == y || (a.y < y && y < b.y) || (b.y < y && y < a.y) {
            row.crossings.push(Crossing::new(&a, &b, slot, y));
        } else if is_last && b.y == y {
            row.crossings.push(Crossing { slot: slot + 1, ..Crossing::new(&a, &b, slot, y) });
        }
    }
}

#[derive(Clone, Copy)]
struct Crossing {
    x: f64,
    z: f64,
    vessel: i32,
    /// The slot of the segment, by which the points of a vessel are ordered.
    slot: usize,
    /// Change of depth upwards (mm per mm).
    slope: f64,
    radius: f64,
    /// Distance of the surface from the centerline (mm) per mm along the row.
    lean: f64,
    is_folded: bool,
}

impl Crossing {
    fn new(a: &Point, b: &Point, slot: usize, y: f64) -> Self {
        let [dx, dy, dz] = [b.x - a.x, b.y - a.y, b.z - a.z];
        let t = (y - a.y) / dy;
        Self {
            x: a.x + t * dx,
            z: a.z + t * dz,
            vessel: a.vessel,
            slot,
            slope: (dz / dy).clamp(-MAX_SLOPE, MAX_SLOPE),
            radius: a.radius + t * (b.radius - a.radius),
            lean: dy.hypot(dz) / dx.hypot(dy).hypot(dz),
            is_folded: false,
        }
    }

    /// Which of two equally near points wins: nearer to the viewer, then smaller vessel id, then slot.
    fn comes_before(&self, other: &Self) -> bool {
        (self.z, self.vessel, self.slot) < (other.z, other.vessel, other.slot)
    }

    fn place(&self, x: f64) -> PixelContent {
        let is_lumen = (x - self.x).abs() * self.lean <= self.radius;
        let radius = if is_lumen { self.radius } else { -self.radius };
        let sheet: Sheet = [0.0, self.slope as f32, radius as f32, 0.0];
        PixelContent { depth: self.z as f32, vessel: self.vessel, sheet, is_folded: self.is_folded }
    }
}

struct Run {
    a: Point,
    b: Point,
    slot: usize,
}

impl Run {
    fn nearest_crossing(&self, x: f64) -> Crossing {
        let dx = self.b.x - self.a.x;
        let t = if dx == 0.0 {
            // A segment along the view has a single x; its end nearer to the viewer counts.
            f64::from(u8::from(self.b.z < self.a.z))
        } else {
            ((x - self.a.x) / dx).clamp(0.0, 1.0)
        };
        Crossing {
            x: self.a.x + t * dx,
            z: self.a.z + t * (self.b.z - self.a.z),
            vessel: self.a.vessel,
            slot: self.slot,
            slope: 0.0,
            radius: self.a.radius + t * (self.b.radius - self.a.radius),
            lean: 1.0,
            is_folded: true,
        }
    }
}

#[derive(Default)]
struct Row {
    /// After `finish`, the points are sorted from left to right, with one point per x.
    crossings: Vec<Crossing>,
    runs: Vec<Run>,
    /// The first point that is not to the left of the previous pixel.
    next: usize,
}

impl Row {
    fn finish(&mut self) {
        for group in self.crossings.chunk_by_mut(|a, b| a.vessel == b.vessel) {
            let vessel = group[0].vessel;
            let is_folded = group.len() > 1 || self.runs.iter().any(|run| run.a.vessel == vessel);
            group.iter_mut().for_each(|crossing| crossing.is_folded = is_folded);
        }
        self.crossings.sort_by(|a, b| {
            let place = |c: &Crossing| (c.vessel, c.slot);
            a.x.total_cmp(&b.x).then(a.z.total_cmp(&b.z)).then(place(a).cmp(&place(b)))
        });
        self.crossings.dedup_by(|later, first| later.x == first.x);
    }

    /// The content of the pixel at view `x`, if any vessel is in the row; pixels come from left to right.
    fn nearest_place(&mut self, x: f64) -> Option<PixelContent> {
        while self.crossings.get(self.next).is_some_and(|crossing| crossing.x < x) {
            self.next += 1;
        }
        let left = self.next.checked_sub(1).map(|n| self.crossings[n]);
        let right = self.crossings.get(self.next).copied();
        let in_runs = self.runs.iter().map(|run| run.nearest_crossing(x));
        let nearest = left.into_iter().chain(right).chain(in_runs).reduce(|best, other| {
            let [far, near] = [&best, &other].map(|crossing| (x - crossing.x).abs());
            if near < far || (near == far && other.comes_before(&best)) { other } else { best }
        });
        nearest.map(|crossing| crossing.place(x))
    }
}
