//! Renders and picks the reformation shown next to the straightened CPR.

use glam::{DVec2, DVec3};
use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::pipeline::{self, Request};
use lumencut_core::reformations::cpr::Straightened;
use lumencut_core::settings::{RimValue, Settings, Slab, SlabMode};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::Vessel;
use lumencut_vessels::measure::profile::Profile;
use std::sync::Arc;

use crate::along_vessels::Legend;
use crate::axes_words::Axes;
use crate::lumen_map::{Ostium, ostia, thickness, walls};
use crate::lumen_wall::{FoundWall, lumen_wall};
use crate::network;
use crate::study::failure::{Failure, Result};
use crate::study::held_volume::no_volume;
use crate::study::open_study::{Study, shown_flat};
use crate::study::picking::Pick;
use crate::study::reformations::{
    BAND, Laid, MapOf, Mark, ReformationMessage, Reformed, ReformedPicture, head_up, map, spiral, uncurl,
    untangled,
};
use crate::value_colours::{Colours, coloured, scale_end};

const MAP_BLACK: &str = " Black: openings of branches, no wall, or outside the scan.";
const MAP_BRIGHT: &str = " A vein or bone that touches the wall looks like calcium.";

impl Study {
    pub(crate) fn reformed(
        &mut self,
        message: ReformationMessage,
        size: [usize; 2],
        (window, stop): ([f64; 2], Stop),
    ) -> Result<ReformedPicture> {
        let reformed = match self.reformed.take() {
            Some(kept) if kept.message == message && kept.size == size => kept,
            kept => {
                let laid = self.laid_out(&message, size, (kept.as_ref(), stop))?;
                let value = self.values_of(&message, &laid, stop)?;
                Reformed { message, size, laid, value }
            }
        };
        let picture = self.picture_of(&reformed, (window, stop))?;
        self.reformed = Some(reformed);
        Ok(picture)
    }

    /// What a position in the last reformation shows; None if it shows nothing.
    pub(crate) fn pick_reformed(&self, pixel: [f64; 2]) -> Result<Option<Pick>> {
        let none = || Failure::of_message("reformation", &"none", "a reformation shown before");
        let reformed = self.reformed.as_ref().ok_or_else(none)?;
        let point = reformed.laid.layout().world_from_pixel(DVec2::from_array(pixel));
        if !point.is_finite() {
            return Ok(None);
        }
        let (vessel, along) = match &reformed.laid {
            Laid::Untangled(layout) => {
                layout.vessel_at(DVec2::from_array(pixel)).map_or((None, None), |(n, at)| (Some(n), Some(at)))
            }
            laid => (reformed.message.vessel(), laid.arc_length(pixel)),
        };
        let pick = self.pick_at(point, vessel);
        Ok(Some(Pick { arc_length: along.or(pick.arc_length), ..pick }))
    }

    /// Column and row of a world point in the last reformation; None if it does not show the point.
    pub(crate) fn on_reformed(&self, point: [f64; 3]) -> Option<[f64; 2]> {
        let pixel = self.reformed.as_ref()?.laid.layout().pixel_from_world(DVec3::from_array(point));
        pixel.is_finite().then(|| pixel.to_array())
    }

    fn laid_out(
        &mut self,
        message: &ReformationMessage,
        size: [usize; 2],
        (before, stop): (Option<&Reformed>, Stop),
    ) -> Result<Laid> {
        Ok(match message {
            ReformationMessage::Untangled { side } | ReformationMessage::Network { side } => {
                let before = before.and_then(|kept| match &kept.laid {
                    Laid::Untangled(layout) if kept.message == *message => Some(layout),
                    _ => None,
                });
                let none = || Failure::of_message("vessels of the untangled CPR", &"none", "one or more");
                let tree = self.content.tree().ok_or_else(none)?;
                Laid::Untangled(untangled(tree.tree(), side, size, (before, stop))?)
            }
            ReformationMessage::Uncurl { vessel, side, amount } => {
                Laid::Uncurl(uncurl(self.vessel(*vessel)?, side, *amount, size)?, *amount)
            }
            ReformationMessage::Spiral { vessel, angle } => {
                let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
                Laid::Spiral(spiral(self.vessel(*vessel)?, *angle, volume.smallest_side(), size)?)
            }
            ReformationMessage::Map { vessel, of } => {
                let (path, found) = self.wall_of(*vessel, stop)?;
                let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
                let level = found.levels.map(crate::lumen_map::calcium_level);
                Laid::Map(map(&volume, (&path, &found), (*of, size), stop)?, level)
            }
            ReformationMessage::Endoscopy { vessel, at, lens, backwards } => {
                self.seen_inside((*vessel, *at), (*lens, *backwards, size), (before, stop))?
            }
        })
    }

    /// The path of a vessel, and its wall: from its profile, or from its radii if no lumen can be measured.
    pub(super) fn wall_of(&mut self, number: usize, stop: Stop) -> Result<(Arc<CenterlinePath>, FoundWall)> {
        let vessel = self.vessel(number)?.clone();
        let line = self.content.named.as_ref().and_then(|named| named.lines.get(number)).copied();
        if let Some(line) = line
            && let Err(error) = self.measured(line, stop)
            && (vessel.radius().is_none() || error.kind == "interrupted")
        {
            return Err(error);
        }
        let profile = self.profile_of(number);
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let path = Arc::new(CenterlinePath::new(&Vessel::new(vessel.points().to_vec(), None)?, 0.0)?);
        let straightened = Straightened::new(Arc::clone(&path), &head_up())?;
        let found = lumen_wall(&volume, &vessel, &straightened, profile)?;
        Ok((path, found))
    }

    /// The last profile of a vessel, if it was measured.
    pub(super) fn profile_of(&self, number: usize) -> Option<&Profile> {
        let line = self.content.named.as_ref()?.lines.get(number).copied()?;
        self.profiles.any_of(line)
    }

    /// The value of each pixel: a value of the volume, or a length (mm); NaN if the pixel is empty.
    fn values_of(&self, message: &ReformationMessage, laid: &Laid, stop: Stop) -> Result<Vec<f32>> {
        if let Laid::Endoscopy(layout, _) = laid {
            return self.behind_wall(layout, stop);
        }
        let volume = self.scene()?.volume.ok_or_else(no_volume)?;
        let of = match message {
            ReformationMessage::Map { of, .. } => Some(*of),
            _ => None,
        };
        let in_walls = |map: &dyn Fn(usize) -> f32, open: Vec<bool>| {
            open.iter().enumerate().map(|(n, open)| if *open { f32::NAN } else { map(n) }).collect()
        };
        match (of, laid) {
            (Some(MapOf::Radius), Laid::Map(layout, _)) => {
                let wall = layout.wall(stop)?;
                Ok(in_walls(&|n| wall[n] as f32, layout.open(stop)?))
            }
            (Some(MapOf::Thickness), Laid::Map(layout, level)) => {
                let level = level.ok_or_else(no_level)?;
                let held = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
                let thick = thickness(&held, layout, (BAND, level), stop)?;
                Ok(in_walls(&|n| thick[n], layout.open(stop)?))
            }
            _ if matches!(message, ReformationMessage::Network { .. }) => Ok(Vec::new()),
            _ => {
                let (camera, flat) = shown_flat([0.0, 1.0])?;
                let band = Slab { thickness: BAND[1] - BAND[0], mode: SlabMode::Max };
                let settings = Settings { slab: of.map(|_| band), ..flat };
                let request = Request {
                    images: ImageSet::of(&[Image::Value]),
                    stop,
                    ..Request::new(&camera, &settings)
                };
                let frame = Frame::of(Geometry::Curved(laid.layout().curved(stop)?));
                Ok(self.cpu.look(&volume, frame, &request)?.value)
            }
        }
    }

    fn picture_of(&self, reformed: &Reformed, (window, stop): ([f64; 2], Stop)) -> Result<ReformedPicture> {
        let layout = reformed.laid.layout();
        let size = layout.size();
        let is_network = matches!(reformed.message, ReformationMessage::Network { .. });
        let axes = if is_network { Axes::Network } else { reformed.laid.axes() };
        let mut words = axes.words();
        let is_length =
            matches!(reformed.message, ReformationMessage::Map { of: MapOf::Radius | MapOf::Thickness, .. });
        if let ReformationMessage::Map { of, .. } = reformed.message {
            words += MAP_BLACK;
            words += if of == MapOf::Radius { "" } else { MAP_BRIGHT };
        }
        let pixels = if let (ReformationMessage::Network { .. }, Laid::Untangled(laid)) =
            (reformed.message, &reformed.laid)
        {
            let along = self.along(RimValue::Diameter, &[])?;
            let Legend { ends: [low, high], .. } = along.legend;
            words += &format!(" Colours: diameter from {low} mm (dark blue) to {high} mm (pale green).");
            network::drawn(laid, &along, stop)?
        } else if let Laid::Endoscopy(layout, inside) = &reformed.laid {
            let (pixels, doubts) = self.picture_inside((layout, &**inside), &reformed.value, stop)?;
            words += &doubts;
            pixels
        } else if is_length {
            let end = scale_end(&reformed.value);
            words += &format!(" Colours: from 0 (dark blue) to {end} mm (yellow).");
            coloured(&reformed.value, [0.0, end], Colours::Viridis)
        } else {
            pipeline::picture(&reformed.value, size, (&shown_flat(window)?.1, stop))?
        };
        let (bytes, pixel_spacing) = (pixels.into_flattened(), layout.pixel_spacing());
        let marks = self.marks_of(&reformed.laid);
        Ok(ReformedPicture { size, bytes, words, pixel_spacing, marks })
    }

    fn marks_of(&self, laid: &Laid) -> Vec<Mark> {
        let Some(named) = self.content.named.as_ref() else { return Vec::new() };
        let places: Vec<(usize, [f64; 2])> = match laid {
            Laid::Untangled(layout) => layout.ends().iter().map(DVec2::to_array).enumerate().collect(),
            Laid::Map(layout, _) => ostia(&walls(layout), named.leveled.tree().vessels())
                .iter()
                .map(|one| {
                    (one.vessel, [layout.column(one.around), one.at / layout.parameters().pixel_spacing])
                })
                .collect(),
            Laid::Endoscopy(layout, inside) => {
                let ostia = inside.ostia(named.leveled.tree().vessels());
                let mouth = |one: &Ostium| Some((one.vessel, inside.mouth(layout, one)?.to_array()));
                ostia.iter().filter_map(mouth).collect()
            }
            Laid::Uncurl(..) | Laid::Spiral(_) => Vec::new(),
        };
        let mark = |(vessel, pixel): (usize, [f64; 2])| {
            let words = named.names.get(vessel).filter(|name| !name.is_empty())?.clone();
            Some(Mark { words, pixel })
        };
        places.into_iter().filter_map(mark).collect()
    }
}

fn no_level() -> Failure {
    let found = "no level, for a vessel whose lumen could not be measured";
    Failure::of_message("level of calcium of the lumen map", &found, "a vessel whose lumen can be measured")
}

#[cfg(test)]
#[path = "tests/reforming.rs"]
mod tests;
