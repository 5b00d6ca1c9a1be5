//! The levels of detail of a tree on the GPU: uploaded once, and projected by the GPU for every view.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::math::chosen_slots::chosen_slots;
use lumencut_core::math::hierarchy::{Hierarchy, NO_SLOT};
use lumencut_core::math::lanes::{ABSENT, FAN, FAR};
use lumencut_core::math::levels::{CutSurfaceParameters, LevelLayout};
use lumencut_core::math::projection::Level;
use lumencut_core::settings::{MAX_LEVELS, Settings};
use wgpu::Buffer;

use crate::device::Device;
use crate::view::{AXIS_UNIT, power_above, split_at};

/// Has the layout of `Point` in `math/projection.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Point {
    /// Position relative to the tree's origin (mm), rounded to multiples of the tree's unit.
    pub coarse: [f32; 3],
    pub radius: f32,
    /// The remainder of the position (mm).
    pub fine: [f32; 3],
    /// The entry of the point's slot among the entries of all bundles.
    pub place: u32,
}

/// Has the layout of `Along` in `math/projection.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Along {
    pub next: u32,
    pub arc_length: f32,
    pub vessel: i32,
}

/// Has the layout of `Span` in `math/levels.wgsl`: the slots of one vessel at one level.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Span {
    pub first: u32,
    pub end: u32,
    pub level: u32,
    /// The slots whose lumen and wall take precedence: the first one, and the one after the last.
    pub first_chosen: u32,
    pub end_chosen: u32,
}

/// Has the layout of `Projected` in `math/levels.wgsl`; written and read only on the GPU.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Projected {
    pub point: [f32; 3],
    pub radius: f32,
    pub edge: [f32; 2],
    pub before: [f32; 2],
    pub inverse_length: f32,
    pub arc_length: f32,
    pub stands: u32,
    pub vessel: i32,
}

/// Has the layout of `Slot` in `math/pieces.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Slot {
    pub start: [f32; 2],
    pub next: [f32; 2],
    pub edge: [f32; 2],
    pub before: [f32; 2],
    pub inverse_length: f32,
    pub stripe_z: f32,
    pub stripe_dz: f32,
    pub wedge_z: f32,
    pub radius: f32,
    pub radius_change: f32,
    pub slot: u32,
    pub tiers: f32,
}

impl Slot {
    const EMPTY: Self = Self {
        start: [FAR; 2],
        next: [FAR; 2],
        edge: [0.0; 2],
        before: [0.0; 2],
        inverse_length: 0.0,
        stripe_z: ABSENT,
        stripe_dz: 0.0,
        wedge_z: ABSENT,
        radius: 0.0,
        radius_change: 0.0,
        slot: NO_SLOT,
        tiers: 0.0,
    };
}

/// Has the layout of `NodeBox` in `math/hierarchy.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct NodeBox {
    pub low: [f32; 2],
    pub high: [f32; 2],
    pub z: f32,
    pub radius: f32,
    pub tiers: f32,
    pub padding: f32,
}

impl NodeBox {
    const EMPTY: Self =
        Self { low: [FAR; 2], high: [FAR; 2], z: ABSENT, radius: 0.0, tiers: 0.0, padding: 0.0 };
}

#[derive(Debug)]
pub(crate) struct DeviceLevels {
    /// Total numbers of spans and of points up to and including each level.
    spans_up_to: Vec<u32>,
    points_up_to: Vec<u32>,
    places: [LevelLayout; MAX_LEVELS + 1],
    /// The origin of points (mm, LPS), and the largest distance of a point from it.
    origin: DVec3,
    reach: f64,
    unit: f64,
    /// The chosen vessels that were written last.
    first: Vec<usize>,
    all_spans: Vec<Span>,
    pub spans: Buffer,
    pub points: Buffer,
    pub alongs: Buffer,
    pub projected: Buffer,
    pub slots: Buffer,
    pub boxes: Buffer,
}

impl DeviceLevels {
    pub(crate) fn new(device: &Device, levels: &[Level]) -> Result<Self> {
        let origin = middle(&levels[0].points);
        let points = levels.iter().flat_map(|level| &level.points);
        let reach = points.map(|point| point.distance(origin)).fold(1.0, f64::max);
        // Eleven binary digits: products with the axes' digits have 22, sums of four such products have 24.
        let unit = power_above(reach) / 2048.0;
        let mut all = Arrays::default();
        for level in levels {
            all.append(level, origin, unit);
        }
        let slots = all.points.len();
        let limit = device.limits.max_storage_buffer_binding_size;
        if (all.bundles * FAN * size_of::<Slot>()) as u64 > limit {
            let most = limit as usize / size_of::<Slot>();
            let found = format!("{slots} points on all levels of detail");
            return Err(device.too_large("vessel tree", found, &format!("{most} points")));
        }
        Ok(Self {
            spans_up_to: all.spans_up_to,
            points_up_to: all.points_up_to,
            places: all.places,
            origin,
            reach,
            unit,
            first: Vec::new(),
            spans: device.upload("spans", &all.spans),
            points: device.upload("points", &all.points),
            alongs: device.upload("along vessels", &all.alongs),
            projected: device.image("projected points", slots, size_of::<Projected>()),
            slots: device.upload("slots", &vec![Slot::EMPTY; all.bundles * FAN]),
            boxes: device.upload("boxes", &vec![NodeBox::EMPTY; all.boxes]),
            all_spans: all.spans,
        })
    }

    /// Gives lumen and wall of these vessels precedence in all later views, from the point at which they
    /// leave the other vessels' lumens; `levels` are those of the tree.
    pub(crate) fn put_first(&mut self, device: &Device, levels: &[Level], vessels: &[usize]) {
        if self.first == vessels {
            return;
        }
        let chosen = levels.iter().flat_map(|level| chosen_slots(level, vessels));
        for (span, chosen) in self.all_spans.iter_mut().zip(chosen) {
            (span.first_chosen, span.end_chosen) = (span.level + chosen.start, span.level + chosen.end);
        }
        device.write(&self.spans, &self.all_spans);
        self.first = vessels.to_vec();
    }

    /// The number of vessels in the first levels; each vessel counts once per level.
    pub(crate) fn span_count(&self, coarsest: usize) -> u32 {
        self.spans_up_to[coarsest]
    }

    pub(crate) fn point_count(&self, coarsest: usize) -> u32 {
        self.points_up_to[coarsest]
    }

    pub(crate) fn parameters(&self, camera: &Camera, settings: &Settings) -> CutSurfaceParameters {
        let origin = camera.view_from_world(self.origin).to_array();
        let away = origin.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        let split = origin.map(|c| split_at(c, self.unit * AXIS_UNIT));
        let four = |n: usize| [split[0][n], split[1][n], split[2][n], 0.0];
        CutSurfaceParameters {
            origin_coarse: four(0),
            origin_fine: four(1),
            vessel_count: self.spans_up_to[0],
            levels: self.places,
            ..CutSurfaceParameters::new(settings, camera, (self.reach + away) as f32)
        }
    }
}

fn middle(points: &[DVec3]) -> DVec3 {
    let ends = points.iter().fold((DVec3::MAX, DVec3::MIN), |(low, high), p| (low.min(*p), high.max(*p)));
    (ends.0 + ends.1) * 0.5
}

#[derive(Default)]
struct Arrays {
    spans_up_to: Vec<u32>,
    points_up_to: Vec<u32>,
    places: [LevelLayout; MAX_LEVELS + 1],
    spans: Vec<Span>,
    points: Vec<Point>,
    alongs: Vec<Along>,
    bundles: usize,
    boxes: usize,
}

impl Arrays {
    fn append(&mut self, level: &Level, origin: DVec3, unit: f64) {
        let first_slot = self.points.len() as u32;
        let mut place_of_slot = vec![0; level.points.len()];
        for (place, slot) in level.order.iter().enumerate().filter(|(_, slot)| **slot != NO_SLOT) {
            place_of_slot[*slot as usize] = (self.bundles * FAN + place) as u32;
        }
        for ((point, radius), place) in level.points.iter().zip(&level.radii).zip(place_of_slot) {
            let split = (*point - origin).to_array().map(|c| split_at(c, unit));
            let (coarse, fine) = (split.map(|s| s[0]), split.map(|s| s[1]));
            self.points.push(Point { coarse, radius: *radius, fine, place });
        }
        let span = |ends: &[u32]| Span {
            first: first_slot + ends[0],
            end: first_slot + ends[1],
            level: first_slot,
            first_chosen: 0,
            end_chosen: 0,
        };
        self.spans.extend(level.first_slot.windows(2).map(span));
        for (vessel, ends) in level.first_slot.windows(2).enumerate() {
            let [first, last] = [ends[0], ends[1] - 1].map(|slot| first_slot + slot);
            let along = |point: u32| Along {
                next: (point + 1).min(last),
                arc_length: level.arc_length[(point - first_slot) as usize],
                vessel: vessel as i32,
            };
            self.alongs.extend((first..=last).map(along));
        }
        let mut place = LevelLayout {
            first_slot,
            first_bundle: self.bundles as u32,
            bundle_count: level.bundle_count() as u32,
            ..LevelLayout::default()
        };
        for (height, boxes) in Hierarchy::new(level.bundle_count()).heights.iter().enumerate() {
            place.heights[height] = self.boxes as u32;
            place.height_count += 1;
            self.boxes += boxes.len() * FAN;
        }
        self.places[self.spans_up_to.len()] = place;
        self.spans_up_to.push(self.spans.len() as u32);
        self.points_up_to.push(self.points.len() as u32);
        self.bundles += level.bundle_count();
    }
}
