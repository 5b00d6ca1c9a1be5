//! The image of a section: the volume in a plane across a vessel.

use glam::{DVec2, DVec3};

use super::Profile;
use crate::measure::section::{SectionPlane, Track, known_radius};
use crate::voxels::Voxels;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::limits::Limits;
use lumencut_core::math::same_place::ALONG_LINE;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;

const SIDE: Limits = Limits::new(1e-3, 1e3, "mm");

const MOST_PIXELS: f64 = 4096.0;

/// A section as an image of square pixels, centred on the vessel.
#[derive(Clone, Debug)]
pub struct CrossSection {
    /// The plane of the section.
    pub place: SectionPlane,
    /// Number of pixels along each side.
    pub pixels: usize,
    /// Side of a pixel (mm).
    pub pixel_spacing: f64,
    /// Value of each pixel, row by row from the top; NaN outside the volume.
    pub value: Vec<f32>,
}

impl CrossSection {
    /// Samples a square with sides of `size` mm. [`ErrorKind::Settings`] for an invalid size or pixel spacing.
    pub fn new(volume: &Volume, place: SectionPlane, size: f64, pixel_spacing: f64) -> Result<Self> {
        SIDE.check("size of the cross-section", size)?;
        SIDE.check("pixel_spacing of the cross-section", pixel_spacing)?;
        let pixels = (size / pixel_spacing).round().max(1.0);
        if pixels > MOST_PIXELS {
            let found = format!("{pixels} × {pixels} pixels");
            let expected = format!("at most {MOST_PIXELS} along a side");
            return Err(Error::new(ErrorKind::Settings, "size of the cross-section", found, expected));
        }
        let voxels = Voxels::new(volume);
        let mut section = Self { place, pixels: pixels as usize, pixel_spacing, value: Vec::new() };
        section.value = section.positions().into_iter().map(|point| voxels.at(point)).collect();
        Ok(section)
    }

    /// Position of each pixel (mm, LPS), row by row from the top.
    pub fn positions(&self) -> Vec<DVec3> {
        let n = self.pixels;
        let away = |i: usize| (i as f64 + 0.5 - n as f64 / 2.0) * self.pixel_spacing;
        (0..n * n).map(|pixel| self.place.point(DVec2::new(away(pixel % n), away(pixel / n)))).collect()
    }
}

/// Plane of the section at arc length `at` (mm): that of the nearest section of `profile` if given, otherwise
/// the plane across the centerline. Errors: [`ErrorKind::Measuring`] for a wrong arc length or profile,
/// [`ErrorKind::VesselTree`] for a vessel without length.
pub fn section_place(vessel: &Vessel, at: f64, profile: Option<&Profile>) -> Result<SectionPlane> {
    let length = vessel.arc_length().last().copied().unwrap_or(0.0);
    if !(0.0..=length).contains(&at) {
        let expected = format!("an arc length from 0 to {length:.3} mm");
        return Err(Error::new(ErrorKind::Measuring, "place on the vessel", format!("{at} mm"), expected));
    }
    let Some(profile) = profile else { return Ok(Track::new(vessel, known_radius(vessel))?.at(at)) };
    let is_end = |[own, measured]: [Option<&DVec3>; 2]| {
        own.zip(measured).is_some_and(|(own, measured)| own.distance(*measured) <= ALONG_LINE)
    };
    let (points, measured) = (vessel.points(), &profile.on_vessel);
    let has_ends = [[points.first(), measured.first()], [points.last(), measured.last()]].map(is_end);
    if has_ends == [true; 2] && (profile.length() - length).abs() <= ALONG_LINE {
        return Ok(profile.place(profile.nearest_section(at)));
    }
    let found = format!("that of another vessel, {:.3} mm long", profile.length());
    let expected = format!("the profile of this vessel, {length:.3} mm long");
    Err(Error::new(ErrorKind::Measuring, "profile of the cross-section", found, expected))
}
