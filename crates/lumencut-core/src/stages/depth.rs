//! The depth of the cut surface: the piece with the smallest key at each pixel, and the blend of two levels
//! of detail (paper sections 3.1.3, 3.1.4, 3.2.1 and 3.3.2; Eq. 2).

mod blend;
mod blended;
mod nearest;
mod own;

use rayon::prelude::*;

pub use self::blended::Blend;
use self::blended::Blended;
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::cost::Rule;
use crate::math::decision::Part;
use crate::math::hierarchy::Hierarchy;
use crate::math::lanes::{COLUMNS, Kernel, PIXELS, ROWS, dispatch};
use crate::math::levels::CutSurfaceParameters;
use crate::math::own_pieces::{NearestPieces, OwnPieces};
use crate::math::pieces::Envelope;
use crate::math::projection::{Level, ProjectedLevel};
use crate::math::tile::{PIXEL_OF_LANE, Tile, gather, scatter};
use crate::math::walk::{Seeds, lowest_keys};
use crate::math::whole_curve;
use crate::settings::{DistanceRule, LevelChoice, MAX_LEVELS, Settings};

/// The levels of a tree in one view, the rule that orders their pieces, and how pixels select levels.
pub struct CutSurface<'a> {
    levels: &'a [Level],
    projected: &'a [ProjectedLevel],
    camera: &'a Camera,
    /// Places of the view (x and y, mm), a tile after the other, instead of the pixels of the camera.
    places: Option<&'a [[[f32; 2]; PIXELS]]>,
    rule: Rule,
    lumen_first: bool,
    level_choice: LevelChoice,
    distance_rule: DistanceRule,
    /// N / σ: at the distance D (mm) from the vessels, a pixel blends the levels around √(D · N / σ).
    selection: f32,
}

impl<'a> CutSurface<'a> {
    /// The cut surface of `projected`: the `levels` in the view of `camera`, finest first.
    pub fn new(
        levels: &'a [Level],
        projected: &'a [ProjectedLevel],
        camera: &'a Camera,
        settings: &Settings,
    ) -> Self {
        let tree_reach = projected.iter().map(ProjectedLevel::reach).fold(0.0, f32::max);
        let parameters = CutSurfaceParameters::new(settings, camera, tree_reach);
        Self {
            levels,
            projected,
            camera,
            places: None,
            rule: parameters.rule(),
            lumen_first: settings.lumen_first,
            level_choice: settings.level_choice,
            distance_rule: settings.distance_rule,
            selection: parameters.selection,
        }
    }

    pub(crate) fn level(&self, level: usize) -> &'a Level {
        &self.levels[level]
    }

    pub fn camera(&self) -> &'a Camera {
        self.camera
    }

    /// The same surface at `places`, a whole number of rows of [`PLACES_ACROSS`] tiles; [`entry_of_place`] states
    /// where they lie in images.
    #[must_use]
    pub(crate) fn at(self, places: &'a [[[f32; 2]; PIXELS]]) -> Self {
        Self { places: Some(places), ..self }
    }

    /// Number of columns of the images of this surface.
    #[inline(always)]
    pub(crate) fn width(&self) -> usize {
        if self.places.is_some() { PLACES_ACROSS * COLUMNS } else { self.camera.size()[0] }
    }

    /// The tile whose first pixel is (`i`, `j`).
    #[inline(always)]
    pub(crate) fn tile(&self, i: usize, j: usize) -> Tile {
        match self.places {
            Some(places) => Tile::of_places(&places[j / ROWS * PLACES_ACROSS + i / COLUMNS]),
            None => Tile::new(self.camera, i, j),
        }
    }

    pub fn finest(&self) -> &'a Hierarchy {
        self.hierarchy(0)
    }

    /// A bound on the rounding error of a projected distance (mm).
    pub fn distance_slack(&self) -> f32 {
        self.rule.distance_slack
    }

    #[inline(always)]
    pub(crate) fn hierarchy(&self, level: usize) -> &'a Hierarchy {
        &self.projected[level].hierarchy
    }

    #[inline(always)]
    pub(crate) fn own_pieces(&self, level: usize) -> OwnPieces<'_> {
        OwnPieces {
            level: &self.levels[level],
            projected: &self.projected[level].projected,
            rule: &self.rule,
        }
    }
}

/// Number of tiles of places in a row; a search begins with what it found in the tile before.
pub(crate) const PLACES_ACROSS: usize = 8;

/// The entry, in the images of a surface at places, of place `n`.
pub(crate) fn entry_of_place(n: usize) -> usize {
    let (tile, (r, c)) = (n / PIXELS, PIXEL_OF_LANE[n % PIXELS]);
    let (row, column) = (tile / PLACES_ACROSS * ROWS + r, tile % PLACES_ACROSS * COLUMNS + c);
    row * PLACES_ACROSS * COLUMNS + column
}

pub(crate) trait Search {
    fn lowest<const LUMEN_FIRST: bool>(
        &mut self,
        level: usize,
        tile: &Tile,
        rule: &Rule,
        envelope: &mut Envelope,
    );

    fn own<const SHEET: bool>(&mut self, pieces: OwnPieces, part: &Part, nearest: &mut NearestPieces);
}

/// Finds lowest keys in the hierarchy, first in the bundles that had those of the previous tile.
struct LowestKeySearch<'a> {
    surface: &'a CutSurface<'a>,
    seeds: [Seeds; MAX_LEVELS + 1],
}

impl Search for LowestKeySearch<'_> {
    #[inline(always)]
    fn lowest<const LUMEN_FIRST: bool>(
        &mut self,
        level: usize,
        tile: &Tile,
        rule: &Rule,
        envelope: &mut Envelope,
    ) {
        if self.surface.distance_rule == DistanceRule::WholeCurve {
            let projected = &self.surface.projected[level].projected;
            return whole_curve::lowest_keys::<LUMEN_FIRST>(projected, tile, rule, envelope);
        }
        let hierarchy = self.surface.hierarchy(level);
        lowest_keys::<LUMEN_FIRST>(hierarchy, tile, rule, &self.seeds[level], envelope);
        self.seeds[level] = Seeds::collect(envelope, &self.surface.levels[level].bundle_of_slot);
    }

    #[inline(always)]
    fn own<const SHEET: bool>(&mut self, pieces: OwnPieces, part: &Part, nearest: &mut NearestPieces) {
        pieces.find::<SHEET>(part, nearest);
    }
}

/// Per pixel: the change of depth to the right and upwards (mm per mm), the vessel's radius (mm, negative outside the
/// lumen), and the gap. This is the distance along the vessel between the two blended points (mm),
/// [`crate::math::lanes::FAR`] between different vessels, [`WALL_GAP`] minus the position along the
/// vessel in lumen and wall, or [`CHOSEN_GAP`] if a chosen vessel takes precedence there.
pub type Sheet = [f32; 4];

/// The gap in a sheet if a chosen vessel takes precedence at the pixel.
pub const CHOSEN_GAP: f32 = -1.0;
/// The gap in a sheet in lumen and wall, minus the position along the vessel (mm).
pub const WALL_GAP: f32 = -2.0;

/// Whether a gap is [`CHOSEN_GAP`].
#[inline(always)]
pub(super) fn is_chosen(gap: f32) -> bool {
    (gap < 0.0) & (gap > WALL_GAP)
}

/// Per pixel: the arc length (mm) and the distance beyond the wall (mm; 0 in lumen and wall) of the piece shown, which decide its
/// vessel, and two unused numbers: on the GPU, all details of a pixel have this size.
pub type Foot = [f32; 4];

/// The images that the stage writes. `sheet`, `blend` and `foot` are empty if nothing reads them.
#[derive(Debug)]
pub struct DepthImages<'a> {
    pub depth: &'a mut [f32],
    pub vessel: &'a mut [i32],
    pub sheet: &'a mut [Sheet],
    pub blend: &'a mut [Blend],
    pub foot: &'a mut [Foot],
}

/// Writes depth (mm), vessel id, sheet and blend of the cut surface at each pixel of the view. The level choice
/// `nearest` needs the distances; for `own` they may be empty.
pub fn depth(work: &Work, surface: &CutSurface, distance: &[f32], images: DepthImages) -> Result<()> {
    let seeds = [Seeds::default(); MAX_LEVELS + 1];
    depth_by(work, surface, distance, images, || LowestKeySearch { surface, seeds })
}

/// [`depth`], with a new search for each row of tiles.
pub(crate) fn depth_by<S: Search>(
    work: &Work,
    surface: &CutSurface,
    distance: &[f32],
    images: DepthImages,
    search: impl Fn() -> S + Sync,
) -> Result<()> {
    let DepthImages { depth, vessel, sheet, blend, foot } = images;
    work.expect_whole(Image::UnfilteredDepth, depth);
    work.expect_whole(Image::Vessel, vessel);
    if surface.level_choice == LevelChoice::Nearest {
        work.expect_whole(Image::Distance, distance);
    }
    if !sheet.is_empty() {
        work.expect_whole(Image::Sheet, sheet);
    }
    if !blend.is_empty() {
        work.expect_whole(Image::Blend, blend);
    }
    if !foot.is_empty() {
        work.expect_whole(Image::Foot, foot);
    }
    let chunk = work.tile_row();
    let row_count = depth.len().div_ceil(chunk);
    let [sheets, blends, feet] = [sheet, blend, foot].map(|image| rows_of(image, chunk, row_count));
    let rows =
        depth.par_chunks_mut(chunk).zip(vessel.par_chunks_mut(chunk)).zip(sheets).zip(blends).zip(feet);
    rows.enumerate().try_for_each(|(row, ((((depth, vessel), sheet), blend), foot))| {
        work.begin(depth.len())?;
        let from = (row * chunk).min(distance.len());
        let distance = &distance[from..(from + depth.len()).min(distance.len())];
        let (row, search) =
            (DepthRow { surface, row, distance, depth, vessel, sheet, blend, foot }, search());
        if surface.lumen_first {
            dispatch(work.isa, DepthKernel::<S, true> { row, search });
        } else {
            dispatch(work.isa, DepthKernel::<S, false> { row, search });
        }
        Ok(())
    })
}

/// The rows of tiles of an image; empty ones if the image is not made.
fn rows_of(image: &mut [[f32; 4]], chunk: usize, count: usize) -> Vec<&mut [[f32; 4]]> {
    let mut rows: Vec<_> = image.chunks_mut(chunk).collect();
    rows.resize_with(count, Default::default);
    rows
}

struct DepthRow<'a> {
    surface: &'a CutSurface<'a>,
    row: usize,
    distance: &'a [f32],
    depth: &'a mut [f32],
    vessel: &'a mut [i32],
    sheet: &'a mut [Sheet],
    blend: &'a mut [Blend],
    foot: &'a mut [Foot],
}

struct DepthKernel<'a, S: Search, const LUMEN_FIRST: bool> {
    row: DepthRow<'a>,
    search: S,
}

impl<S: Search, const LUMEN_FIRST: bool> Kernel for DepthKernel<'_, S, LUMEN_FIRST> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        self.row.fill::<LUMEN_FIRST>(&mut self.search);
    }
}

struct TileSurface {
    depth: [f32; PIXELS],
    vessel: [i32; PIXELS],
    sheet: [Sheet; PIXELS],
}

impl DepthRow<'_> {
    #[inline(always)]
    fn fill<const LUMEN_FIRST: bool>(self, search: &mut impl Search) {
        let surface = self.surface;
        let (width, with_sheet) = (surface.width(), !self.sheet.is_empty());
        for column in (0..width).step_by(COLUMNS) {
            let tile = surface.tile(column, self.row * ROWS);
            let mut blended = (!self.blend.is_empty()).then(|| Blended::new(surface.distance_rule));
            let mut feet = (!self.foot.is_empty()).then_some([[0.0; 4]; PIXELS]);
            let outputs = (blended.as_mut(), feet.as_mut());
            let over = match surface.level_choice {
                LevelChoice::Own if with_sheet => surface.own::<LUMEN_FIRST, true>(&tile, search, outputs),
                LevelChoice::Own => surface.own::<LUMEN_FIRST, false>(&tile, search, outputs),
                LevelChoice::Nearest => {
                    let distance = gather(self.distance, width, column);
                    surface.nearest_surface::<LUMEN_FIRST>(&tile, &distance, with_sheet, search, outputs)
                }
            };
            scatter(&over.depth, self.depth, width, column);
            scatter(&over.vessel, self.vessel, width, column);
            if with_sheet {
                scatter(&over.sheet, self.sheet, width, column);
            }
            if let Some(Blended { blend, .. }) = &blended {
                scatter(blend, self.blend, width, column);
            }
            if let Some(feet) = &feet {
                scatter(feet, self.foot, width, column);
            }
        }
    }
}
