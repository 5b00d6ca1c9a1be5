//! The projection of a level's slots for one view: edges, depths, and the wedge at each point.

use std::ops::Range;

use glam::DVec3;

use super::hierarchy::{Hierarchy, NO_SLOT, spatial_order};
use super::lanes::{ABSENT, FAN};
use super::pieces::{Stripe, Wedge};
use crate::camera::Camera;
use crate::settings::Settings;
use crate::vessel_tree::VesselTree;

/// A segment whose projection is shorter than this (mm) is collinear with the view and has no stripe: far
/// below any voxel, well above the rounding of `f32`.
pub const COLLINEAR_LENGTH: f32 = 1e-3;

/// Number of tiers by which lumen and wall of a chosen vessel both precede lumen and wall of others.
const TIERS_OF_FIRST: f32 = 2.0;

/// One level of detail, made once per tree: its distinct points as slots, and their order in space.
#[derive(Debug)]
pub struct Level {
    /// The first slot of each vessel, and the number of slots at the end.
    pub first_slot: Vec<u32>,
    pub points: Vec<DVec3>,
    /// The radius at each slot (mm), 0 if unknown.
    pub radii: Vec<f32>,
    /// Arc length of each slot (mm); never falls along a vessel.
    pub arc_length: Vec<f32>,
    /// The slot in each entry of each bundle.
    pub order: Vec<u32>,
    pub(crate) bundle_of_slot: Vec<u32>,
    pub vessel_of_slot: Vec<i32>,
}

impl Level {
    /// A point nearer than [`COLLINEAR_LENGTH`] to the previous one gets no slot: its segment has no direction.
    pub fn new(tree: &VesselTree) -> Self {
        let slots = tree.segment_count() + tree.vessels().len();
        let (mut points, mut radii) = (Vec::with_capacity(slots), Vec::with_capacity(slots));
        let mut arc_length = Vec::with_capacity(slots);
        let mut vessel_of_slot = Vec::with_capacity(slots);
        let mut first_slot = vec![0];
        for (id, vessel) in tree.vessels().iter().enumerate() {
            for (i, point) in vessel.points().iter().enumerate() {
                let far = |kept: &DVec3| kept.distance(*point) >= f64::from(COLLINEAR_LENGTH);
                if i == 0 || points.last().is_none_or(far) {
                    points.push(*point);
                    radii.push(vessel.radius_or_zero(i) as f32);
                    arc_length.push(vessel.arc_length()[i] as f32);
                    vessel_of_slot.push(id as i32);
                }
            }
            first_slot.push(points.len() as u32);
        }
        let last = |slot: usize| vessel_of_slot.get(slot + 1) != Some(&vessel_of_slot[slot]);
        let middle = |slot: usize| (points[slot] + points[if last(slot) { slot } else { slot + 1 }]) * 0.5;
        let order = spatial_order(&(0..points.len()).map(middle).collect::<Vec<_>>());
        let mut bundle_of_slot = vec![0; points.len()];
        for (place, slot) in order.iter().enumerate().filter(|(_, slot)| **slot != NO_SLOT) {
            bundle_of_slot[*slot as usize] = (place / FAN) as u32;
        }
        Self { first_slot, points, radii, arc_length, order, bundle_of_slot, vessel_of_slot }
    }

    pub fn bundle_count(&self) -> usize {
        self.order.len() / FAN
    }
}

#[derive(Clone, Copy, Debug, Default)]
pub struct Projected {
    pub point: [f32; 3],
    pub radius: f32,
    /// The edge e to the next point (mm); zero if missing or collinear with the view.
    pub edge: [f32; 2],
    pub before: [f32; 2],
    /// 1 / |e|; zero if e is zero.
    pub inverse_length: f32,
    pub arc_length: f32,
    pub vessel: i32,
    pub stands: bool,
}

impl Projected {
    #[inline(always)]
    pub fn has_stripe(&self) -> bool {
        self.inverse_length > 0.0
    }

    #[inline(always)]
    pub fn stripe(&self, next: &Self) -> Stripe {
        let [start, end] = [self, next].map(|p| [p.point[0], p.point[1]]);
        Stripe::new(start, end, self.edge, self.inverse_length)
    }

    #[inline(always)]
    pub fn wedge(&self) -> Wedge {
        Wedge { point: [self.point[0], self.point[1]], before: self.before, edge: self.edge }
    }

    /// How the depth of the stripe to `next` changes along view x and y (mm per mm); 0 if `next` is `self`.
    #[inline(always)]
    pub fn slope(&self, next: &Self) -> [f32; 2] {
        let per_mm = self.inverse_length * self.inverse_length * (next.point[2] - self.point[2]);
        [self.edge[0] * per_mm, self.edge[1] * per_mm]
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Radii {
    /// Factor on radii: 1 if radii count, else 0.
    pub scale: f32,
    /// The radius of points without a known one (mm).
    pub unknown: f32,
}

impl Radii {
    pub fn new(settings: &Settings) -> Self {
        let unknown = if settings.lumen_first { settings.unknown_radius as f32 } else { 0.0 };
        Self { scale: f32::from(u8::from(settings.preserve_lumen)), unknown }
    }

    pub fn of(self, radius: f32) -> f32 {
        let known = radius * self.scale;
        if known > 0.0 { known } else { self.unknown }
    }
}

/// A level in one view; the buffers are kept from view to view.
#[derive(Debug)]
pub struct ProjectedLevel {
    pub projected: Vec<Projected>,
    pub hierarchy: Hierarchy,
}

impl ProjectedLevel {
    pub fn new(level: &Level) -> Self {
        let along = level.arc_length.iter().zip(&level.vessel_of_slot);
        let place = |(arc_length, vessel): (&f32, &i32)| Projected {
            arc_length: *arc_length,
            vessel: *vessel,
            ..Projected::default()
        };
        let projected = along.map(place).collect();
        Self { projected, hierarchy: Hierarchy::new(level.bundle_count()) }
    }

    /// Gives lumen and wall of these slots (a range per vessel) precedence over all others in later views.
    pub fn put_first(&mut self, level: &Level, chosen: &[Range<u32>]) {
        for (place, slot) in level.order.iter().enumerate().filter(|(_, slot)| **slot != NO_SLOT) {
            let is_first = chosen[level.vessel_of_slot[*slot as usize] as usize].contains(slot);
            let tiers = if is_first { TIERS_OF_FIRST } else { 0.0 };
            self.hierarchy.bundles[place / FAN].tiers[place % FAN] = tiers;
        }
    }

    pub fn project(&mut self, level: &Level, camera: &Camera, radii: Radii) {
        for ((projected, point), radius) in self.projected.iter_mut().zip(&level.points).zip(&level.radii) {
            projected.point = camera.view_from_world(*point).as_vec3().to_array();
            projected.radius = radii.of(*radius);
        }
        for ends in level.first_slot.windows(2) {
            stand(&mut self.projected[ends[0] as usize..ends[1] as usize]);
        }
        for (place, slot) in level.order.iter().enumerate().filter(|(_, slot)| **slot != NO_SLOT) {
            self.place(place, *slot as usize);
        }
        self.hierarchy.enclose();
    }

    fn place(&mut self, place: usize, slot: usize) {
        let (bundle, s) = (&mut self.hierarchy.bundles[place / FAN], place % FAN);
        let here = self.projected[slot];
        let stripe = here.has_stripe();
        // A collinear segment has no stripe, so its slot's second point is the first one.
        let end = self.projected[slot + usize::from(stripe)];
        bundle.slot[s] = slot as u32;
        (bundle.x[s], bundle.y[s]) = (here.point[0], here.point[1]);
        (bundle.next_x[s], bundle.next_y[s]) = (end.point[0], end.point[1]);
        (bundle.edge_x[s], bundle.edge_y[s]) = (here.edge[0], here.edge[1]);
        (bundle.before_x[s], bundle.before_y[s]) = (here.before[0], here.before[1]);
        bundle.inverse_length[s] = here.inverse_length;
        bundle.stripe_z[s] = if stripe { here.point[2] } else { ABSENT };
        bundle.stripe_dz[s] = end.point[2] - here.point[2];
        bundle.wedge_z[s] = if here.stands { here.point[2] } else { ABSENT };
        bundle.radius[s] = here.radius;
        bundle.radius_change[s] = end.radius - here.radius;
    }

    pub fn reach(&self) -> f32 {
        let coordinates = self.projected.iter().flat_map(|p| p.point);
        coordinates.fold(0.0, |reach, c| reach.max(c.abs()))
    }
}

/// Decides for one vessel which segments are collinear and which piece lies at each point: a wedge at inner points; a
/// half-plane at an end, or before a run (consecutive collinear segments); a full plane at an end in a run.
fn stand(vessel: &mut [Projected]) {
    let last = vessel.len() - 1;
    for i in 0..=last {
        let next = vessel[(i + 1).min(last)].point;
        let here = vessel[i].point;
        let edge = [next[0] - here[0], next[1] - here[1]];
        let square = edge[0] * edge[0] + edge[1] * edge[1];
        let collinear = square < COLLINEAR_LENGTH * COLLINEAR_LENGTH;
        vessel[i].edge = if collinear { [0.0; 2] } else { edge };
        vessel[i].inverse_length = if collinear { 0.0 } else { 1.0 / square.sqrt() };
        vessel[i].before = [0.0; 2];
        vessel[i].stands = false;
    }
    let Some(first_stripe) = vessel.iter().position(Projected::has_stripe) else {
        let nearest = (0..=last).min_by(|a, b| vessel[*a].point[2].total_cmp(&vessel[*b].point[2]));
        vessel[nearest.unwrap_or(0)].stands = true;
        return;
    };
    let last_stripe = vessel.iter().rposition(Projected::has_stripe).unwrap_or(first_stripe);
    // The first point has no edge before it: it has a half-plane, or a full plane if a run begins there.
    vessel[0].stands = true;
    for i in first_stripe + 1..=last_stripe {
        // After a stripe there is a wedge, or a half-plane if a run begins; other points have nothing.
        vessel[i].stands = vessel[i - 1].has_stripe();
        vessel[i].before = vessel[i - 1].edge;
    }
    // The last point has a half-plane, or a full plane if a run ends the vessel.
    vessel[last].stands = true;
    vessel[last].before = if last_stripe + 1 == last { vessel[last_stripe].edge } else { [0.0; 2] };
}
