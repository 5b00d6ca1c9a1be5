//! The thresholds of CR, and the pieces of a tree in one view: the nearest piece, and the foremost whose disc contains a pixel.

use super::chains::Chains;
use crate::camera::Camera;
use crate::error::{Error, ErrorKind, Result};
use crate::math::cost::Rule;
use crate::math::hierarchy::Hierarchy;
use crate::math::lanes::PIXELS;
use crate::math::pieces::Envelope;
use crate::math::projection::{Level, Projected, ProjectedLevel, Radii};
use crate::math::tile::Tile;
use crate::math::walk::{Seeds, lowest_keys};
use crate::pipeline::Request;
use crate::reformations::connections::Connections;
use crate::stages::depth::Sheet;

pub(super) struct CrView<'a> {
    pub level: &'a Level,
    pub camera: &'a Camera,
    projected: Vec<Projected>,
    /// The pieces without depth and radius, so that the smallest key is the smallest distance.
    plane: Hierarchy,
    pub plane_rule: Rule,
    /// The pieces with disc radii: the smallest key is the foremost disc that contains the pixel.
    discs: Hierarchy,
    disc_rule: Rule,
    pub chains: Chains,
    pub connections: Connections,
}

impl<'a> CrView<'a> {
    pub(super) fn new(level: &'a Level, parameters: &CrParameters, request: &Request<'a>) -> Self {
        let &Request { camera, settings, .. } = request;
        let side = camera.pixel_spacing();
        let mut view = ProjectedLevel::new(level);
        view.project(level, camera, Radii { scale: 1.0, unknown: settings.unknown_radius as f32 });
        let (tree_reach, chains) = (view.reach(), Chains::new(level, &view));
        let ProjectedLevel { projected, hierarchy } = view;
        let (mut plane, mut discs) = (hierarchy.clone(), hierarchy);
        plane.flatten();
        discs.widen((parameters.radius_offset * side) as f32);
        let view_reach = camera.view_x(0).abs().max(camera.view_y(0).abs()) as f32;
        let disc_rule = Rule { margin: 0.0, ..Rule::new(settings, tree_reach, view_reach) };
        let connections = Connections::new(level, parameters.arc_threshold * side);
        let plane_rule = Rule { weight: 1.0, ..disc_rule };
        Self { level, camera, projected, plane, plane_rule, discs, disc_rule, chains, connections }
    }

    /// The piece nearest to each pixel in the image; the first of equally near ones.
    #[inline(always)]
    pub(super) fn nearest_pieces(&self, tile: &Tile, seeds: &mut Seeds) -> [u32; PIXELS] {
        let mut nearest = Envelope::new(&[1.0; PIXELS]);
        lowest_keys::<false>(&self.plane, tile, &self.plane_rule, seeds, &mut nearest);
        *seeds = Seeds::collect(&nearest, &self.level.bundle_of_slot);
        nearest.piece
    }

    /// The foremost piece whose disc contains each pixel, or [`NO_PIECE`].
    #[inline(always)]
    pub(super) fn foremost(&self, tile: &Tile, seeds: &mut Seeds) -> [u32; PIXELS] {
        let mut foremost = Envelope::new(&[1.0; PIXELS]);
        // Pieces whose discs do not contain the pixel have larger keys than this.
        foremost.key = [-1.5 * self.disc_rule.lift; PIXELS];
        lowest_keys::<true>(&self.discs, tile, &self.disc_rule, seeds, &mut foremost);
        *seeds = Seeds::collect(&foremost, &self.level.bundle_of_slot);
        foremost.piece
    }

    pub(super) fn around(&self, chain: u32) -> Vec<[u32; 2]> {
        let slot = self.chains.bundles[chain as usize].slot[0];
        let vessel = self.level.vessel_of_slot[slot as usize];
        let span = self.chains.span(self.level, vessel, chain);
        let stretches = self.connections.stretches(vessel as u32, span);
        let chains =
            stretches.into_iter().map(|(vessel, span)| self.chains.between(self.level, vessel, span));
        let mut chains: Vec<_> = chains.collect();
        chains.sort_unstable();
        chains.dedup_by(|next, last| {
            let meets = next[0] <= last[1];
            last[1] = if meets { last[1].max(next[1]) } else { last[1] };
            meets
        });
        chains
    }

    #[inline(always)]
    pub(super) fn seen(&self, piece: u32, x: f32, y: f32) -> Seen {
        let here = &self.projected[(piece / 2) as usize];
        let [z, radius, arc_length] = [here.point[2], here.radius, here.arc_length];
        let at_start = Seen {
            piece,
            vessel: here.vessel,
            is_covered: false,
            distance: 0.0,
            z,
            radius,
            arc_length,
            slope: [0.0; 2],
        };
        if piece.is_multiple_of(2) {
            let (covered, distance) = here.wedge().cover(x, y);
            return Seen { is_covered: covered & here.stands, distance, ..at_start };
        }
        if !here.has_stripe() {
            return at_start;
        }
        let next = &self.projected[(piece / 2) as usize + 1];
        let foot = here.stripe(next).foot(x, y);
        Seen {
            is_covered: foot.covered,
            distance: foot.distance,
            z: z + foot.t * (next.point[2] - z),
            radius: radius + foot.t * (next.radius - radius),
            arc_length: arc_length + foot.t * (next.arc_length - arc_length),
            slope: here.slope(next),
            ..at_start
        }
    }
}

pub(super) const NO_PIECE: u32 = u32::MAX;

#[derive(Clone, Copy)]
pub(super) struct Seen {
    /// Twice the slot of the piece, plus 1 for a stripe.
    pub piece: u32,
    pub vessel: i32,
    pub is_covered: bool,
    /// Distance from the pixel in the image (mm).
    pub distance: f32,
    pub z: f32,
    radius: f32,
    arc_length: f32,
    slope: [f32; 2],
}

impl Seen {
    #[inline(always)]
    pub(super) fn place(&self) -> (i32, f32) {
        (self.vessel, self.arc_length)
    }

    #[inline(always)]
    pub(super) fn sheet(&self) -> Sheet {
        let radius = if self.distance <= self.radius { self.radius } else { -self.radius };
        [self.slope[0], self.slope[1], radius, 0.0]
    }
}

const MAX_THRESHOLD_PIXELS: f64 = 1e6;

/// The two thresholds of CR.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrParameters {
    /// A vessel hides what lies behind it up to this distance beyond its radius (pixels).
    pub radius_offset: f64,
    /// Points nearer than this along the tree (pixels) form a stretch; its point nearest to a pixel is shown.
    pub arc_threshold: f64,
}

impl Default for CrParameters {
    /// The thresholds of the paper's picture of the neck.
    fn default() -> Self {
        Self { radius_offset: 50.0, arc_threshold: 150.0 }
    }
}

impl CrParameters {
    /// Fails with [`ErrorKind::Settings`] for a threshold that is not from 0 to a million pixels.
    pub fn check(&self) -> Result<()> {
        for (name, value) in [("radius_offset", self.radius_offset), ("arc_threshold", self.arc_threshold)] {
            if !(0.0..=MAX_THRESHOLD_PIXELS).contains(&value) {
                let expected = "a finite number of pixels between 0 and 1e6";
                return Err(Error::new(ErrorKind::Settings, name, format!("{value}"), expected));
            }
        }
        Ok(())
    }
}
