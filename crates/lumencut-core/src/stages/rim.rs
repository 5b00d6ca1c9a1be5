//! The rim: a band around the vessels, outside their walls, coloured by values along them.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::depth::Foot;
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{Kernel, dispatch, larger, smaller};
use crate::math::projection::Level;
use crate::settings::Settings;

/// Distance (mm) from the lumen at which the rim begins, if the wall is thinner.
const FROM_LUMEN: f64 = 1.2;
/// Smallest distance (mm) between wall and rim.
const FROM_WALL: f64 = 0.2;
/// Width of the rim (mm), and its smallest width (pixels).
const WIDTH: f64 = 1.6;
const NARROWEST: f64 = 2.0;
/// The largest share of the rim's colour in a pixel; the rest is grey.
const MOST: f32 = 0.9;

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct RimParameters {
    /// Distances beyond the wall (mm) between which the rim lies.
    pub near: f32,
    pub far: f32,
    /// 1 / side of a pixel (per mm).
    pub per_side: f32,
    pub most: f32,
}

impl RimParameters {
    /// The soft edge of the rim, half a pixel wide on each side, touches neither lumen nor wall.
    pub fn new(settings: &Settings, camera: &Camera) -> Self {
        let side = camera.pixel_spacing();
        let near = (FROM_LUMEN - settings.lumen_margin).max(FROM_WALL) + side / 2.0;
        let far = near + WIDTH.max(NARROWEST * side);
        Self { near: near as f32, far: far as f32, per_side: (1.0 / side) as f32, most: MOST }
    }

    /// The share of the rim in a pixel, by its distance beyond the wall (mm).
    #[inline(always)]
    fn share(&self, beyond: f32) -> f32 {
        let within = |inside: f32| smaller(larger(inside * self.per_side + 0.5, 0.0), 1.0);
        within(beyond - self.near) * within(self.far - beyond) * self.most
    }
}

/// Where the colours of one vessel lie, and how many there are per mm of its arc length.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct RimStrip {
    pub first: u32,
    pub last: u32,
    pub per_mm: f32,
}

/// Colours along the vessels of a tree: RGBA, transparent where there is no value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RimColors {
    colors: Vec<[u8; 4]>,
    /// The first colour of each vessel, and the number of all colours.
    first: Vec<usize>,
}

impl RimColors {
    /// The colours of each vessel at equal steps of arc length from its start to its end; none if it has no rim.
    pub fn new(vessels: &[Vec<[u8; 4]>]) -> Self {
        let (mut colors, mut first) = (Vec::new(), vec![0]);
        for vessel in vessels {
            colors.extend_from_slice(if vessel.is_empty() { &[[0; 4]] } else { vessel });
            first.push(colors.len());
        }
        Self { colors, first }
    }

    /// The number of vessels.
    pub fn vessels(&self) -> usize {
        self.first.len().saturating_sub(1)
    }

    pub fn colors(&self) -> &[[u8; 4]] {
        &self.colors
    }

    /// The places of the colours for the finest level of a tree, whose lengths smoothing may have changed.
    pub fn strips(&self, finest: &Level) -> Vec<RimStrip> {
        let of_vessel = |(n, ends): (usize, &[usize])| {
            let end = finest.first_slot[n + 1] as usize;
            let length = finest.arc_length[end - 1];
            let steps = (ends[1] - ends[0] - 1) as f32;
            let per_mm = if length > 0.0 { steps / length } else { 0.0 };
            RimStrip { first: ends[0] as u32, last: (ends[1] - 1) as u32, per_mm }
        };
        self.first.windows(2).enumerate().map(of_vessel).collect()
    }
}

/// Writes colour and share of the rim at each pixel, by the value of the vessel that the pixel shows. `along` are the strips and
/// colours of the vessels, `places` the feet and vessels of the pixels.
pub fn rim(
    work: &Work,
    parameters: &RimParameters,
    along: (&[RimStrip], &[[u8; 4]]),
    places: (&[Foot], &[i32]),
    rim: &mut [[u8; 4]],
) -> Result<()> {
    let (foot, vessel) = places;
    work.expect_whole(Image::Foot, foot);
    work.expect_whole(Image::Vessel, vessel);
    work.expect_whole(Image::Rim, rim);
    let chunk = work.tile_row();
    let rows = rim.par_chunks_mut(chunk).zip(foot.par_chunks(chunk)).zip(vessel.par_chunks(chunk));
    rows.try_for_each(|((rim, foot), vessel)| {
        work.begin(rim.len())?;
        dispatch(work.isa, RimRows { parameters, along, foot, vessel, rim });
        Ok(())
    })
}

struct RimRows<'a> {
    parameters: &'a RimParameters,
    along: (&'a [RimStrip], &'a [[u8; 4]]),
    foot: &'a [Foot],
    vessel: &'a [i32],
    rim: &'a mut [[u8; 4]],
}

impl Kernel for RimRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (strips, colors) = self.along;
        for ((rim, [along, beyond, ..]), vessel) in self.rim.iter_mut().zip(self.foot).zip(self.vessel) {
            let share = self.parameters.share(*beyond);
            if share > 0.0 {
                let RimStrip { first, last, per_mm } = strips[*vessel as usize];
                let at = first + (along * per_mm + 0.5) as u32;
                let [red, green, blue, alpha] = colors[at.min(last) as usize];
                *rim = [red, green, blue, (share * f32::from(alpha)).round_ties_even() as u8];
            }
        }
    }
}
