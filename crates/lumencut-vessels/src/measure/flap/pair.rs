//! The two lumens of one section.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::basins::{Basins, Dams, NONE};
use super::edges::{Edge, Rim, THICKEST_MM};
use super::found::{Flap, LumenPair};
use super::outlines::{Corner, outline};
use super::plane_map::PlaneMap;
use crate::measure::outer::outline::{area_and_middle, hull_area};
use crate::measure::section::SectionPlane;
use crate::measure::section::blur::Blur;
use crate::measure::section::rays::{RAYS, direction};
use crate::voxels::Voxels;
use lumencut_core::math::statistics::median;

/// Lumen is brighter than the flap by this fraction of the contrast. Brighter values than the lumen by `CAPPED` count as that.
const BRIGHT: f64 = 0.3;
const CAPPED: f64 = 1.0;

/// Lumens are searched up to this distance from the line (mm).
const REACH_MM: f64 = 45.0;

/// Rays meet something darker than this fraction of the contrast, and then this length of lumen (mm), on this many rays.
const DARKER: f64 = 0.7;
const BEHIND_MM: f64 = 3.0;
const LEAST_RAYS: usize = 6;

/// Smoothing of the map in which sheets are searched (blur widths), and its step (blur widths, or voxel sides if larger).
const SMOOTHING: f64 = 0.4;
const STEP: (f64, f64) = (0.3, 0.5);

/// Sheets part lumens if their second derivative exceeds the noise by this factor, and this fraction of the contrast per
/// squared blur width.
const LEAST_SHEET: (f64, f64) = (2.5, 0.3);

/// Minimum area of a lumen (mm²), and minimum diameter of both together (mm).
const LEAST_AREA: f64 = 12.0;
const LEAST_WHOLE_MM: f64 = 12.0;

/// Minimum width of a tear that makes one lumen of two (blur widths).
const LEAST_TEAR: f64 = 1.0;

/// Area of values far brighter than lumen (mm²) from which metal hides the lumens.
const METAL_AREA: f64 = 6.0;

/// What is dimmer than this fraction of the contrast of its lumen is no lumen, and puts the edge in doubt if it is more than
/// this fraction of it.
const DIM: (f64, f64) = (0.5, 0.05);

/// Minimum length of the flap, as a fraction of the diameter of the smaller lumen.
const LEAST_FLAP: f64 = 1.0;

/// Minimum area of the lumens and the flap together, as a fraction of that of their convex hull.
const SOLID: f64 = 0.9;

/// Standard deviation of the position of all outer edges, and of all edges at the flap (blur widths).
const EDGE_ERROR: [f64; 2] = [0.025, 0.05];

/// Neighbouring corners share noise.
const SHARED_CORNERS: f64 = 5.0;

/// Levels around a flap, in the volume's unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairLevels {
    pub lumen: f64,
    /// Level of the flap and its standard deviation.
    pub flap: [f64; 2],
    pub noise: f64,
}

impl PairLevels {
    fn at(&self, share: f64) -> f64 {
        self.flap[0] + share * (self.lumen - self.flap[0])
    }
}

/// The search for a flap in one section.
pub(crate) struct Search<'a, 'v> {
    pub voxels: &'a Voxels<'v>,
    pub place: &'a SectionPlane,
    pub levels: PairLevels,
    pub blur: &'a Blur,
}

/// One lumen: its contour in the plane, and its edges.
struct Lumen {
    corners: Vec<DVec2>,
    edges: Vec<Edge>,
}

impl Search<'_, '_> {
    /// Both lumens; why they are not visible otherwise.
    pub(crate) fn pair(&self) -> Result<LumenPair, Flap> {
        let reach = self.reach().ok_or(Flap::Absent)?;
        let width = self.blur.width(self.place);
        let (map, smooth, mut basins) = self.parted(reach, width);
        let own = map.nearest(DVec2::ZERO).map_or(NONE, |n| basins.of[n]);
        if own == NONE {
            return Err(Flap::Absent);
        }
        let other = behind(&map, &basins, own).ok_or(Flap::Absent)?;
        for lumen in [own, other] {
            let size = basins.size(lumen);
            if (size as f64) * map.step * map.step < LEAST_AREA {
                return Err(Flap::Absent);
            }
            let dim = basins.trim(&smooth, lumen, (self.levels.flap[0], DIM.0), (width / map.step) as isize);
            if dim as f64 > DIM.1 * size as f64 {
                return Err(Flap::Dim);
            }
        }
        let [first, second] = [own, other].map(|lumen| outline(&map, &basins, lumen));
        let is_open = |corner: &Corner| !map.holds(corner.at + corner.out * width);
        if first.iter().chain(&second).any(is_open) {
            return Err(Flap::Open);
        }
        let lumen = |lumens: [u32; 2], corners: &[Corner]| {
            let (dark, noise) = (self.levels.flap[0], self.levels.noise);
            let blur = [width, self.deviation(map.step)];
            let rim = Rim { map: &map, basins: &basins, lumens, dark, blur, noise };
            Lumen::of(corners, &rim.edges(corners)).ok_or(Flap::Open)
        };
        let pair = self.judged(&[lumen([own, other], &first)?, lumen([other, own], &second)?], width)?;
        let is_hidden = is_metal(&map, &basins, [own, other], self.levels.at(1.0 + CAPPED));
        if is_hidden { Err(Flap::Metal) } else { Ok(pair) }
    }

    /// The section up to `reach` mm from the line, as it is and smoothed, and its lumens; `width` is the blur (mm).
    fn parted(&self, reach: f64, width: f64) -> (PlaneMap, PlaneMap, Basins) {
        let step = (STEP.0 * width).max(STEP.1 * self.voxels.sampling_side);
        let map = PlaneMap::read(self.voxels, self.place, [reach, step], self.levels.at(1.0 + CAPPED));
        let smooth = map.smoothed(SMOOTHING * width);
        let sheets = smooth.sheets();
        let basins = Basins::of(&smooth, &sheets, &self.dams(&smooth, &sheets, width));
        (map, smooth, basins)
    }

    /// Standard deviation (mm) of the blur of a map with this step: by the scan and by interpolation.
    fn deviation(&self, step: f64) -> f64 {
        (self.blur.interpolated(self.place).determinant().sqrt() + step * step / 6.0).sqrt()
    }

    /// How far lumens reach from the line (mm); None if there is nothing behind something dark.
    fn reach(&self) -> Option<f64> {
        let step = 0.5 * self.voxels.sampling_side;
        let count = (REACH_MM / step) as usize;
        let [bright, darker] = [BRIGHT, DARKER].map(|share| self.levels.at(share));
        let (mut crossing, mut farthest) = (0, 0.0_f64);
        let mut values = Vec::new();
        for ray in 0..RAYS {
            let world = self.place.point(direction(ray) * step) - self.place.origin;
            let start = self.voxels.index_from_world.transform_point3(self.place.origin);
            let stride = self.voxels.index_from_world.transform_vector3(world);
            values.clear();
            while values.len() < count {
                self.voxels.along(start, stride, &mut values);
            }
            let (mut last, mut is_beyond, mut behind) = (0.0, false, 0.0);
            for (n, value) in values.iter().enumerate() {
                let (at, value) = (n as f64 * step, f64::from(*value));
                if at - last > THICKEST_MM {
                    break;
                }
                is_beyond |= value < darker;
                if value > bright {
                    last = at;
                    behind += if is_beyond { step } else { 0.0 };
                }
            }
            farthest = farthest.max(last);
            crossing += usize::from(behind > BEHIND_MM);
        }
        (crossing >= LEAST_RAYS).then(|| (1.3 * farthest + 4.0).min(REACH_MM))
    }

    fn dams(&self, smooth: &PlaneMap, sheets: &[f64], width: f64) -> Dams {
        let bright = self.levels.at(BRIGHT);
        let lit = (0..sheets.len()).filter(|n| smooth.values[*n] > self.levels.at(DARKER));
        let mut sizes: Vec<f64> = lit.map(|n| sheets[n].abs()).collect();
        let noise = 1.48 * median(&mut sizes).unwrap_or(0.0);
        let of_contrast = LEAST_SHEET.1 * (self.levels.lumen - self.levels.flap[0]) / (width * width);
        let least_size = (LEAST_AREA / (smooth.step * smooth.step)) as usize;
        Dams {
            bright,
            least_sheet: (LEAST_SHEET.0 * noise).max(of_contrast),
            least_size,
            least_gap: (LEAST_TEAR * width / smooth.step) as usize,
        }
    }

    fn judged(&self, lumens: &[Lumen; 2], width: f64) -> Result<LumenPair, Flap> {
        let areas = lumens.each_ref().map(|one| one.area());
        let diameters = areas.map(|area| 2.0 * (area / PI).sqrt());
        let flaps = lumens.each_ref().map(|one| one.flap());
        let flap = 0.5 * flaps.iter().map(|[length, thickness]| length * thickness).sum::<f64>();
        let whole = areas[0] + areas[1] + flap;
        let all = [&lumens[0].corners[..], &lumens[1].corners].concat();
        let is_flap = flaps.iter().all(|[length, _]| *length >= LEAST_FLAP * diameters[0].min(diameters[1]));
        let is_wide = 2.0 * (whole / PI).sqrt() >= LEAST_WHOLE_MM;
        if areas.iter().any(|area| *area < LEAST_AREA) || !is_flap || !is_wide {
            return Err(Flap::Absent);
        }
        if whole < SOLID * hull_area(&all) {
            return Err(Flap::Absent);
        }
        let area = |n: usize| [areas[n], lumens[n].unsure(flaps[n], self.levels.flap[1], width)];
        let contours = lumens.each_ref().map(|one| self.contour(&one.corners));
        Ok(LumenPair { found: Flap::Seen, contours, areas: [area(0), area(1)] })
    }

    fn contour(&self, corners: &[DVec2]) -> Vec<DVec3> {
        corners.iter().map(|corner| self.place.point(*corner)).collect()
    }
}

impl Lumen {
    /// The lumen within these edges; None if a quarter of them is not visible. Those take the place of the nearest one.
    fn of(corners: &[Corner], edges: &[Option<Edge>]) -> Option<Self> {
        if 4 * edges.iter().flatten().count() < 3 * RAYS {
            return None;
        }
        let nearest = |n: usize| {
            let near = (0..RAYS).flat_map(|m| [(n + m) % RAYS, (n + RAYS - m) % RAYS]);
            near.filter_map(|m| edges[m]).next()
        };
        let edges: Vec<Edge> = (0..RAYS).filter_map(nearest).collect();
        let corners = corners.iter().zip(&edges);
        let corners = corners.map(|(corner, edge)| corner.at + corner.out * edge.offset).collect();
        Some(Self { corners, edges })
    }

    fn area(&self) -> f64 {
        area_and_middle(&self.corners).map_or(0.0, |(area, _)| area)
    }

    /// Distance of neighbouring corners (mm).
    fn spacing(&self) -> f64 {
        let count = self.corners.len();
        (0..count).map(|n| self.corners[n].distance(self.corners[(n + 1) % count])).sum::<f64>()
            / count as f64
    }

    /// Length and median thickness of the flap (mm).
    fn flap(&self) -> [f64; 2] {
        let mut thickness: Vec<f64> = self.edges.iter().filter_map(|edge| edge.flap).collect();
        [thickness.len() as f64 * self.spacing(), median(&mut thickness).unwrap_or(0.0)]
    }

    /// Standard deviation of the area (mm²): errors of all edges, of the level of the flap, and noise.
    fn unsure(&self, [flap, thickness]: [f64; 2], level: f64, width: f64) -> f64 {
        let (count, spacing) = (self.edges.len(), self.spacing());
        let outer = count as f64 * spacing - flap;
        let contrast = self.edges.iter().map(|edge| edge.contrast).sum::<f64>() / count as f64;
        let by_level = 0.5 * thickness * level / contrast;
        let jitter = |n: usize| {
            let next = |m: usize| self.edges[(n + m) % count].offset;
            (next(0) - 0.5 * (next(count - 1) + next(1))).powi(2)
        };
        let noise = ((0..count).map(jitter).sum::<f64>() * SHARED_CORNERS).sqrt() * spacing;
        let edges = [outer * EDGE_ERROR[0] * width, flap * EDGE_ERROR[1] * width, flap * by_level, noise];
        edges.iter().map(|part| part * part).sum::<f64>().sqrt()
    }
}

/// The basin that lies behind the most corners of the outline of another one.
fn behind(map: &PlaneMap, basins: &Basins, own: u32) -> Option<u32> {
    let met = |corner: &Corner| {
        let steps = 1..=(THICKEST_MM / map.step) as usize;
        let places = steps.map(|n| corner.at + corner.out * (n as f64 * map.step));
        let mut found = places.filter_map(|place| map.nearest(place)).map(|n| basins.of[n]);
        found.find(|basin| *basin != NONE && *basin != own)
    };
    let all: Vec<u32> = outline(map, basins, own).iter().filter_map(met).collect();
    let count = |basin: u32| all.iter().filter(|other| **other == basin).count();
    all.iter().copied().max_by_key(|basin| (count(*basin), *basin))
}

/// Whether the lumens hold metal, whose values count as `most`.
fn is_metal(map: &PlaneMap, basins: &Basins, lumens: [u32; 2], most: f64) -> bool {
    let is_lumen = |n: &usize| lumens.contains(&basins.of[*n]);
    let capped = (0..basins.of.len()).filter(is_lumen).filter(|n| map.values[*n] > 0.999 * most).count();
    capped as f64 * map.step * map.step > METAL_AREA
}
