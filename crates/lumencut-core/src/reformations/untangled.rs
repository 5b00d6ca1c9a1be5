//! Untangled CPR: every vessel of a tree cut open in one image, without overlaps, with true lengths. Kanitsar,
//! Wegenkittl, Fleischmann and Gröller, "Advanced Curved Planar Reformation: Flattening of Vascular Structures", IEEE
//! Visualization 2003, doi:10.1109/VISUAL.2003.1250353, show an entire tree by minimal rotations at branching points.
//! Only the abstract of that method was available: layout and search are ours.

mod growth;
mod hull;
mod pieces;
mod room;
mod sectors;
mod sheet;
mod strip;
mod turning;

use std::sync::{Arc, OnceLock};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use self::growth::Growth;
use self::pieces::{Piece, pieces_of, vessels_of};
use self::room::{extent, roots, size_of};
use self::sheet::{Sheet, SheetPosition, placed};
use self::strip::Strip;
use self::turning::{OVERLAP_EXTRA_MM, Tree, Turning, untangle};
use super::found::NO_VESSEL;
use super::layout::{Layout, by_rows, curved_by_rows};
use crate::camera::{Camera, MAX_PIXEL_SPACING};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::Curved;
use crate::limits::Limits;
use crate::stop::{Stop, filled, go_on};
use crate::vessel_tree::VesselTree;

const WIDTH: Limits = Limits::new(1e-3, 1e4, "mm");
const HULL_MARGIN: Limits = Limits::new(0.0, 1e3, "mm");
const SMOOTHING: Limits = Limits::new(0.0, 1e3, "mm");
const PIXEL_SPACING: Limits = Limits::new(1e-6, MAX_PIXEL_SPACING, "mm");
const UNKNOWN_RADIUS: Limits = Limits::new(0.0, 1e6, "mm");

/// The side of a square of pixels that search for their nearest vessels together (pixels).
const TILE: usize = 8;

/// A pixel with no segment nearby.
const NO_SEGMENT: u32 = u32::MAX;

/// The parameters of the layout of a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UntangledParameters {
    /// Width shown on each side of a vessel (mm).
    pub width: f64,
    /// Width by which the hulls, which must not overlap, exceed the lumen (mm).
    pub hull_margin: f64,
    /// Standard deviation of the Gaussian that smooths the directions of vessels along them (mm).
    pub smoothing: f64,
    /// The side of a pixel (mm).
    pub pixel_spacing: f64,
    /// The radius of points whose radius is unknown (mm).
    pub unknown_radius: f64,
    /// The layout of a connected part of the tree starts at the vessel end nearest to this point (mm, LPS).
    /// Other parts start at the free end with the largest mean radius over 10 mm.
    pub root: Option<DVec3>,
}

impl UntangledParameters {
    /// The defaults, in pixels with a side of `pixel_spacing` mm.
    pub fn new(pixel_spacing: f64) -> Self {
        Self { width: 25.0, hull_margin: 2.0, smoothing: 4.0, pixel_spacing, unknown_radius: 1.0, root: None }
    }

    fn check(&self) -> Result<()> {
        let lengths = [
            (WIDTH, "width", self.width),
            (HULL_MARGIN, "hull_margin", self.hull_margin),
            (SMOOTHING, "smoothing", self.smoothing),
            (PIXEL_SPACING, "pixel_spacing", self.pixel_spacing),
        ];
        for (limits, name, value) in lengths {
            let checked = limits.check(&format!("{name} of the untangled CPR"), value);
            checked.map_err(|error| Error { kind: ErrorKind::Camera, ..error })?;
        }
        UNKNOWN_RADIUS.check("unknown_radius", self.unknown_radius)?;
        if self.root.is_some_and(|root| !root.is_finite()) {
            let found = "numbers that are not finite";
            return Err(Error::new(ErrorKind::Camera, "root of the untangled CPR", found, "a finite point"));
        }
        Ok(())
    }
}

/// A part of a vessel in the image, between two points where vessels meet or end.
#[derive(Clone, Debug, PartialEq)]
pub struct LaidOut {
    /// Id of the vessel.
    pub vessel: usize,
    /// Rising arc lengths along the vessel (mm).
    pub arc_length: Vec<f64>,
    /// The image positions (column, row) at these arc lengths.
    pub pixels: Vec<DVec2>,
    /// The turn of this part and of all parts that follow it (radians, counter-clockwise in the image).
    pub turn: f64,
    /// Whether the layout proceeds from the last point of the part to its first.
    pub is_reversed: bool,
}

/// A tree laid out without overlap, seen along the direction of a camera. Clones share the computed layout.
#[derive(Clone)]
pub struct Untangled {
    parameters: UntangledParameters,
    sheet: Arc<Sheet>,
    laid_out: Arc<Vec<LaidOut>>,
    vessels: usize,
    near: f64,
    overlaps: Vec<usize>,
    closures: Vec<[DVec2; 2]>,
    /// The centre of the first pixel (mm).
    origin: DVec2,
    /// Width and height of all that is shown (mm).
    extent: DVec2,
    size: [usize; 2],
    segments: Arc<OnceLock<Vec<u32>>>,
}

impl Untangled {
    /// Lays out a tree; only the directions of the camera apply. Fails with [`ErrorKind::Camera`] for a
    /// length outside its range or too many pixels, [`ErrorKind::VesselTree`] for a vessel without length or
    /// a part without a free end, [`ErrorKind::Settings`] for an invalid unknown radius.
    pub fn new(
        tree: &VesselTree,
        camera: &Camera,
        parameters: UntangledParameters,
        stop: Stop,
    ) -> Result<Self> {
        parameters.check()?;
        let (pieces, nodes) = pieces_of(tree, parameters.unknown_radius)?;
        let growth = Growth::new(&pieces, nodes, parameters.root)?;
        let strip = |piece: &Piece| {
            go_on(stop)?;
            Ok(Strip::new(piece, camera, parameters.smoothing))
        };
        let strips = pieces.par_iter().map(strip).collect::<Result<Vec<_>>>()?;
        let found =
            Tree { pieces: &pieces, strips: &strips, growth: &growth, hull_margin: parameters.hull_margin };
        let turning = untangle(found, stop)?;
        let roots = roots(&growth.parts, &turning.hulls, camera, parameters.width);
        let places = placed(&pieces, &growth, &turning.places, &turning.turns, &roots);
        let sheet = Sheet::new(&pieces, &strips, &places, parameters.width);
        let (origin, extent) = extent(&places, parameters.width);
        let size = size_of(extent, parameters.pixel_spacing)?;
        let mut made = Self {
            parameters,
            sheet: Arc::new(sheet),
            laid_out: Arc::default(),
            vessels: tree.vessels().len(),
            near: turning.near,
            overlaps: vessels_of(&pieces, &turning.overlaps),
            closures: Vec::new(),
            origin,
            extent,
            size,
            segments: Arc::default(),
        };
        made.laid_out =
            Arc::new((0..pieces.len()).map(|n| made.laid(n, &pieces, &growth, &turning)).collect());
        made.closures = growth.closures.iter().map(|closure| made.closure(&growth, closure)).collect();
        Ok(made)
    }

    /// The same layout with pixels of another side (mm), without a new search for turns. Fails with
    /// [`ErrorKind::Camera`] for a side outside its range or too many pixels.
    pub fn with_pixels(&self, pixel_spacing: f64) -> Result<Self> {
        let parameters = UntangledParameters { pixel_spacing, ..self.parameters };
        parameters.check()?;
        let finer = self.parameters.pixel_spacing / pixel_spacing;
        let scaled = |part: &LaidOut| LaidOut {
            pixels: part.pixels.iter().map(|place| *place * finer).collect(),
            ..part.clone()
        };
        Ok(Self {
            parameters,
            laid_out: Arc::new(self.laid_out.iter().map(scaled).collect()),
            closures: self.closures.iter().map(|ends| ends.map(|place| place * finer)).collect(),
            size: size_of(self.extent, pixel_spacing)?,
            segments: Arc::default(),
            ..self.clone()
        })
    }

    /// Width and height of all that is shown (mm).
    pub fn extent(&self) -> DVec2 {
        self.extent
    }

    /// The vessel id and arc length (mm) at an image position (column, row), if any.
    pub fn vessel_at(&self, pixel: DVec2) -> Option<(usize, f64)> {
        let place = self.sheet.place(self.seen(pixel))?;
        Some((self.laid_out[self.sheet.piece(&place)].vessel, self.sheet.arc_length(&place)))
    }

    /// The parameters of the layout.
    pub fn parameters(&self) -> &UntangledParameters {
        &self.parameters
    }

    /// The parts of all vessels between meeting points and ends, in the order of the vessels and along each.
    pub fn laid_out(&self) -> &[LaidOut] {
        &self.laid_out
    }

    /// The end of each vessel in the image (column, row), by id.
    pub fn ends(&self) -> Vec<DVec2> {
        let mut ends = vec![DVec2::NAN; self.vessels];
        for LaidOut { vessel, pixels, is_reversed, .. } in self.laid_out.iter() {
            let known = &mut ends[*vessel];
            if known.is_nan() || !is_reversed {
                *known = pixels[if *is_reversed { 0 } else { pixels.len() - 1 }];
            }
        }
        ends
    }

    /// The largest turn of each vessel's parts (radians, counter-clockwise in the image).
    pub fn rotations(&self) -> Vec<f64> {
        let mut rotations = vec![0.0f64; self.vessels];
        for part in self.laid_out.iter() {
            let known = &mut rotations[part.vessel];
            if part.turn.abs() > known.abs() {
                *known = part.turn;
            }
        }
        rotations
    }

    /// Radius around a branching point within which vessels may overlap (mm), if the widest hull there has a
    /// radius of `hull` mm.
    pub fn may_overlap_within(&self, hull: f64) -> f64 {
        self.near * hull + OVERLAP_EXTRA_MM
    }

    /// The vessels whose hulls still overlap others, or fold over themselves.
    pub fn overlaps(&self) -> &[usize] {
        &self.overlaps
    }

    /// Pairs of image positions that show the same point of the body, because a cycle is cut open there.
    pub fn closures(&self) -> &[[DVec2; 2]] {
        &self.closures
    }

    /// The vessel that each pixel shows, row by row; [`NO_VESSEL`] where nothing is shown.
    pub fn vessel(&self, stop: Stop) -> Result<Vec<i32>> {
        self.each(NO_VESSEL, stop, |place| self.laid_out[self.sheet.piece(place)].vessel as i32)
    }

    fn laid(&self, n: usize, pieces: &[Piece], growth: &Growth, turning: &Turning) -> LaidOut {
        let stations = self.sheet.stations_of(n);
        LaidOut {
            vessel: pieces[n].vessel,
            arc_length: stations.iter().map(|station| station.at).collect(),
            pixels: stations.iter().map(|station| self.pixel(station.place)).collect(),
            turn: turning.turns[n],
            is_reversed: growth.is_reversed[n],
        }
    }

    fn closure(&self, growth: &Growth, &(piece, there, end): &(usize, usize, usize)) -> [DVec2; 2] {
        let at = |piece: usize, end: usize| {
            let pixels = &self.laid_out[piece].pixels;
            pixels[if end == 0 { 0 } else { pixels.len() - 1 }]
        };
        [at(piece, usize::from(!growth.is_reversed[piece])), at(there, end)]
    }

    fn pixel(&self, seen: DVec2) -> DVec2 {
        let from = (seen - self.origin) / self.parameters.pixel_spacing;
        DVec2::new(from.x, -from.y)
    }

    fn seen(&self, pixel: DVec2) -> DVec2 {
        self.origin + DVec2::new(pixel.x, -pixel.y) * self.parameters.pixel_spacing
    }

    fn segments(&self, stop: Stop) -> Result<&[u32]> {
        // Computed outside the lock: a waiting pool thread may start other work and then deadlock.
        if let Some(known) = self.segments.get() {
            return Ok(known);
        }
        let [width, height] = self.size;
        let mut segments = filled(width * height, NO_SEGMENT, stop)?;
        segments.par_chunks_mut(TILE * width).enumerate().try_for_each(|(n, rows)| {
            (0..width).step_by(TILE).try_for_each(|first| {
                go_on(stop)?;
                self.fill_tile([first, n * TILE], rows);
                Ok(())
            })
        })?;
        Ok(self.segments.get_or_init(|| segments))
    }

    fn fill_tile(&self, [first, top]: [usize; 2], rows: &mut [u32]) {
        let width = self.size[0];
        let side = (TILE - 1) as f64 / 2.0;
        let middle = self.seen(DVec2::new(first as f64 + side, top as f64 + side));
        let near = self.sheet.near(middle, side * std::f64::consts::SQRT_2 * self.parameters.pixel_spacing);
        if near.is_empty() {
            return;
        }
        for (j, row) in rows.chunks_mut(width).enumerate() {
            for (i, segment) in row.iter_mut().enumerate().skip(first).take(TILE) {
                let seen = self.seen(DVec2::new(i as f64, (top + j) as f64));
                if let Some(found) = self.sheet.nearest_among(&near, seen) {
                    *segment = found as u32;
                }
            }
        }
    }

    fn shown(&self, segments: &[u32], [i, j]: [usize; 2]) -> Option<SheetPosition> {
        let segment = segments[j * self.size[0] + i];
        let seen = self.seen(DVec2::new(i as f64, j as f64));
        (segment != NO_SEGMENT).then(|| self.sheet.on_segment(segment as usize, seen))
    }

    fn each<T: Clone + Send>(
        &self,
        nothing: T,
        stop: Stop,
        value_of: impl Fn(&SheetPosition) -> T + Sync,
    ) -> Result<Vec<T>> {
        let segments = self.segments(stop)?;
        by_rows(self.size, nothing, stop, |j, row| {
            for (i, pixel) in row.iter_mut().enumerate() {
                if let Some(place) = self.shown(segments, [i, j]) {
                    *pixel = value_of(&place);
                }
            }
        })
    }
}

impl Layout for Untangled {
    fn size(&self) -> [usize; 2] {
        self.size
    }

    fn pixel_spacing(&self) -> f64 {
        self.parameters.pixel_spacing
    }

    fn curved(&self, stop: Stop) -> Result<Curved> {
        let segments = self.segments(stop)?;
        curved_by_rows(self.size, stop, |j, position, direction| {
            for i in 0..self.size[0] {
                if let Some(place) = self.shown(segments, [i, j]) {
                    position[i] = self.sheet.point(&place);
                    direction[i] = self.sheet.slab_direction(&place).as_vec3();
                }
            }
        })
    }

    fn arc_length(&self, stop: Stop) -> Result<Vec<f64>> {
        self.each(f64::NAN, stop, |place| self.sheet.arc_length(place))
    }

    fn folded(&self, stop: Stop) -> Result<Vec<bool>> {
        self.each(false, stop, |place| self.sheet.is_folded(place))
    }

    fn world_from_pixel(&self, pixel: DVec2) -> DVec3 {
        self.sheet.place(self.seen(pixel)).map_or(DVec3::NAN, |place| self.sheet.point(&place))
    }

    fn pixel_from_world(&self, point: DVec3) -> DVec2 {
        self.sheet.place_of(point).map_or(DVec2::NAN, |place| self.pixel(self.sheet.seen(&place)))
    }
}

#[cfg(test)]
#[path = "tests/untangled.rs"]
mod tests;
