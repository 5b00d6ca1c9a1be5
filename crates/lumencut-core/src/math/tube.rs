//! The inside of a vessel as tables that rays follow: its course by arc length, and its wall around the course.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3, Vec4};

/// Number of radii in a row, at even steps of the [turn](turn_of).
pub const AROUND: usize = 256;
/// A ray advances by slightly more than the way on which a straight wall would end it.
pub const NEWTON: f32 = 1.02;
/// The shortest and longest step of a ray, as shares of the radius around it.
pub const SHORTEST: f32 = 0.02;
pub const LONGEST: f32 = 0.5;
/// The place of a wall is refined by at most this many steps, until it is this exact (mm).
pub const REFINED: usize = 8;
pub const EXACT: f32 = 1e-3;
/// A ray ends after this many steps.
pub const MAX_STEPS: usize = 1000;
/// Least divisor.
pub const LEAST: f32 = 1e-9;

/// A place on the course of a vessel. Has the layout of `TubeRow` in `math/tube.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct TubeRow {
    /// The middle (mm from the origin), and the value halfway from lumen to surroundings.
    pub middle: [f32; 4],
    /// The direction along the vessel, and the value from which calcium or metal begins.
    pub tangent: [f32; 4],
    /// The direction to the right, and 1 if the lumen is brighter than its surroundings, else -1.
    pub across: [f32; 4],
}

/// The course and the wall of a vessel.
#[derive(Clone, Debug)]
pub struct Tube {
    origin: DVec3,
    step: f32,
    rows: Vec<TubeRow>,
    /// Radii (mm) of each row; below 0 in the opening of a branch.
    radius: Vec<f32>,
}

/// A place in a tube.
#[derive(Clone, Copy, Debug, Default)]
pub struct TubePlace {
    row: usize,
    /// Distance beyond the middle of the row (mm).
    along: f32,
    /// Offset to the right and into the scene of the straightened vessel (mm).
    offset: [f32; 2],
}

/// What a ray meets, after how many mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Met {
    /// Nothing before its end.
    Nothing,
    /// The wall.
    Wall(f32),
    /// An opening of the wall, or an end of the vessel, next to this row.
    Opening(f32, usize),
}

/// From 0 to 4 once around, by a ratio that is cheaper than an angle.
pub fn turn_of([x, y]: [f32; 2]) -> f32 {
    let share = y / (x.abs() + y.abs()).max(LEAST);
    let turn = if x < 0.0 { 2.0 - share } else { share };
    if turn < 0.0 { turn + 4.0 } else { turn }
}

impl Tube {
    /// Rows `step` mm apart with [`AROUND`] radii each, relative to `origin` (mm, LPS).
    pub fn new(origin: DVec3, step: f64, rows: Vec<TubeRow>, radius: Vec<f32>) -> Self {
        debug_assert_eq!(radius.len(), rows.len() * AROUND);
        Self { origin, step: step as f32, rows, radius }
    }

    /// The origin of the rows (mm, LPS), and their distance (mm).
    pub fn origin_and_step(&self) -> (DVec3, f32) {
        (self.origin, self.step)
    }

    /// The rows and their radii.
    pub fn tables(&self) -> (&[TubeRow], &[f32]) {
        (&self.rows, &self.radius)
    }

    /// The row next to an arc length (mm).
    pub fn row_at(&self, at: f64) -> usize {
        ((at / f64::from(self.step)).round().max(0.0) as usize).min(self.rows.len() - 1)
    }

    /// The direction along the vessel at an arc length (mm).
    pub fn tangent(&self, at: f64) -> DVec3 {
        xyz(self.rows[self.row_at(at)].tangent).as_dvec3()
    }

    /// The place of a world point, found from a row near it.
    pub fn place_of(&self, point: DVec3, near: usize) -> TubePlace {
        self.find((point - self.origin).as_vec3(), near)
    }

    /// Arc length (mm) and distance from the middle (mm).
    pub fn arc_length_and_distance(&self, place: &TubePlace) -> [f32; 2] {
        let [x, y] = place.offset;
        [place.row as f32 * self.step + place.along, (x * x + y * y).sqrt()]
    }

    // Inlining it at each call would double the size in browsers.
    #[inline(never)]
    fn find(&self, point: Vec3, near: usize) -> TubePlace {
        let half = 0.5 * self.step;
        let mut row = near;
        let mut way = 0.0;
        loop {
            let at = &self.rows[row];
            let away = point - xyz(at.middle);
            let along = away.dot(xyz(at.tangent));
            let is_before = along < -half && row > 0 && way <= 0.0;
            let is_after = along > half && row + 1 < self.rows.len() && way >= 0.0;
            if is_before || is_after {
                way = along;
                row = if is_before { row - 1 } else { row + 1 };
                continue;
            }
            let across = xyz(at.across);
            let ahead = across.cross(xyz(at.tangent));
            return TubePlace { row, along, offset: [away.dot(across), away.dot(ahead)] };
        }
    }

    fn is_beyond(&self, place: &TubePlace) -> bool {
        let last = self.rows.len() - 1;
        (place.row == 0 && place.along < 0.0) || (place.row == last && place.along > 0.0)
    }

    /// The radius of the wall (mm) at a place, and whether it is open there.
    fn radius(&self, place: &TubePlace) -> (f32, bool) {
        let last = self.rows.len() - 1;
        let other = if place.along < 0.0 { place.row.max(1) - 1 } else { (place.row + 1).min(last) };
        let share = (place.along.abs() / self.step).min(1.0);
        let turn = turn_of(place.offset) * (AROUND as f32 / 4.0);
        let column = turn.floor();
        let part = turn - column;
        let columns = [column as usize % AROUND, (column as usize + 1) % AROUND];
        let [own, next] = [place.row, other].map(|row| {
            let [a, b] = columns.map(|column| self.radius[row * AROUND + column].abs());
            a + (b - a) * part
        });
        let nearest = self.radius[place.row * AROUND + columns[usize::from(part >= 0.5)]];
        (own + (next - own) * share, nearest < 0.0)
    }

    /// The first wall or opening that a ray from `eye` (mm from the origin) meets between two distances (mm).
    pub fn met(&self, eye: Vec3, ray: Vec3, [start, end]: [f32; 2], near: usize) -> Met {
        let mut away = start;
        let mut before = [away, 0.0];
        let mut place = self.find(eye + ray * away, near);
        for _ in 0..MAX_STEPS {
            if self.is_beyond(&place) {
                return Met::Opening(away, place.row);
            }
            let [inside, rise, radius] = self.inside(&place, ray);
            if inside <= 0.0 {
                return self.crossed([eye, ray], [before, [away, inside]], &place);
            }
            if away >= end {
                return Met::Nothing;
            }
            before = [away, inside];
            let straight = NEWTON * inside / rise.max(1e-3);
            away = (away + straight.clamp(SHORTEST * radius, LONGEST * radius)).min(end);
            place = self.find(eye + ray * away, place.row);
        }
        Met::Nothing
    }

    /// How far inside the wall a place lies (mm), how fast a ray leaves the middle there, and the radius (mm).
    fn inside(&self, place: &TubePlace, ray: Vec3) -> [f32; 3] {
        let at = &self.rows[place.row];
        let [x, y] = place.offset;
        let away = (x * x + y * y).sqrt();
        let across = xyz(at.across);
        let ahead = across.cross(xyz(at.tangent));
        let rise = (x * ray.dot(across) + y * ray.dot(ahead)) / away.max(LEAST);
        let radius = self.radius(place).0;
        [radius - away, rise, radius]
    }

    /// What a ray meets where it leaves the wall between two distances, each with the depth within the wall (mm).
    #[inline(never)]
    fn crossed(&self, [eye, ray]: [Vec3; 2], [low, high]: [[f32; 2]; 2], end: &TubePlace) -> Met {
        let ([mut low, mut inside], [mut high, mut outside]) = (low, high);
        let (mut away, mut place) = (high, *end);
        for _ in 0..REFINED {
            let share = inside / (inside - outside).max(LEAST);
            away = low + (high - low) * share.clamp(0.02, 0.98);
            place = self.find(eye + ray * away, place.row);
            let found = self.inside(&place, ray)[0];
            if found.abs() < EXACT {
                break;
            }
            if found > 0.0 {
                (low, inside) = (away, found);
            } else {
                (high, outside) = (away, found);
            }
        }
        if self.radius(&place).1 { Met::Opening(away, place.row) } else { Met::Wall(away) }
    }

    /// The unit normal of the wall at a place, outwards, from its slope over about `reach` mm.
    pub fn normal(&self, place: &TubePlace, reach: f32) -> Vec3 {
        let at = &self.rows[place.row];
        let (tangent, across) = (xyz(at.tangent), xyz(at.across));
        let ahead = across.cross(tangent);
        let [x, y] = place.offset;
        let away = (x * x + y * y).sqrt().max(LEAST);
        let turn = reach / away.max(reach);
        let [before, after] =
            [-turn, turn].map(|by| self.radius(&TubePlace { offset: [x - y * by, y + x * by], ..*place }).0);
        let rows = (reach / self.step).ceil() as usize;
        let ends = [place.row.saturating_sub(rows), (place.row + rows).min(self.rows.len() - 1)];
        let [above, below] = ends.map(|row| self.radius(&TubePlace { row, ..*place }).0);
        let along = (below - above) / ((ends[1] - ends[0]).max(1) as f32 * self.step);
        let around = (after - before) / (2.0 * turn * away);
        let outwards = (across * x + ahead * y) / away;
        let sideways = (ahead * x - across * y) / away;
        (outwards - sideways * around - tangent * along).normalize_or_zero()
    }
}

pub fn xyz(four: [f32; 4]) -> Vec3 {
    Vec4::from_array(four).truncate()
}
