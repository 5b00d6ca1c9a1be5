//! Endoscopies in the viewer: the eye of a message, and the picture.

use std::sync::Arc;

use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::pipeline::Request;
use lumencut_core::reformations::Layout as _;
use lumencut_core::reformations::cpr::Straightened;
use lumencut_core::reformations::endoscopy::{Endoscopy, Lens};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::stop::Stop;

use crate::endoscopy::{BEHIND_MM, EndoscopyRequest, Inside, shades};
use crate::study::failure::Result;
use crate::study::held_volume::no_volume;
use crate::study::open_study::{Study, shown_flat};
use crate::study::reformations::{Laid, LensOf, ReformationMessage, Reformed, head_up};

impl LensOf {
    fn lens(self) -> Lens {
        match self {
            Self::Perspective => Lens::Perspective,
            Self::Fisheye => Lens::Fisheye,
        }
    }
}

impl Study {
    /// The view of an eye at a place of a vessel; the inside of the view before is used again.
    pub(super) fn seen_inside(
        &mut self,
        (vessel, at): (usize, f64),
        (lens, is_backwards, size): (LensOf, bool, [usize; 2]),
        (before, stop): (Option<&Reformed>, Stop),
    ) -> Result<Laid> {
        let kept = before.and_then(|kept| match (&kept.message, &kept.laid) {
            (ReformationMessage::Endoscopy { vessel: own, .. }, Laid::Endoscopy(_, inside)) => {
                (*own == vessel).then(|| Arc::clone(inside))
            }
            _ => None,
        });
        let inside = kept.map_or_else(|| self.inside_of(vessel, stop), Ok)?;
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let lens = lens.lens();
        let at = at.clamp(0.0, inside.length());
        let request = EndoscopyRequest { at, lens, field_of_view: None, size, roll: 0.0, is_backwards };
        Ok(Laid::Endoscopy(inside.seen(&volume, &request, stop)?, inside))
    }

    fn inside_of(&mut self, vessel: usize, stop: Stop) -> Result<Arc<Inside>> {
        let (path, found) = self.wall_of(vessel, stop)?;
        let straightened = Straightened::new(Arc::clone(&path), &head_up())?;
        Ok(Arc::new(Inside::new((path, straightened), &found, self.profile_of(vessel))?))
    }

    /// The volume behind the wall.
    pub(super) fn behind_wall(&self, layout: &Endoscopy, stop: Stop) -> Result<Vec<f32>> {
        let volume = self.scene()?.volume.ok_or_else(no_volume)?;
        let (camera, settings) = shown_flat([0.0, 1.0])?;
        let images = ImageSet::of(&[Image::Value]);
        let request = Request { images, stop, ..Request::new(&camera, &settings) };
        let frame = Frame::of(Geometry::Curved(layout.behind(BEHIND_MM).curved(stop)?));
        Ok(self.cpu.look(&volume, frame, &request)?.value)
    }

    /// The picture from the values behind the wall, and doubts about it as sentences.
    pub(super) fn picture_inside(
        &self,
        (layout, inside): (&Endoscopy, &Inside),
        value: &[f32],
        stop: Stop,
    ) -> Result<(Vec<[u8; 4]>, String)> {
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let pixels = inside.picture(&shades(layout, &volume, stop)?, value);
        let doubts = inside.doubts(&volume, layout.eye());
        Ok((pixels, doubts.iter().map(|doubt| format!(" Uncertain: {doubt}.")).collect()))
    }
}
