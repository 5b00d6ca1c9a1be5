//! The piece of one vessel that is nearest to each pixel in the image, as in CR without an arc threshold.

use rayon::prelude::*;

use crate::camera::Camera;
use crate::error::Result;
use crate::math::cost::Rule;
use crate::math::hierarchy::Hierarchy;
use crate::math::lanes::{COLUMNS, Isa, Kernel, PIXELS, ROWS, dispatch};
use crate::math::pieces::Envelope;
use crate::math::projection::{Level, ProjectedLevel, Radii};
use crate::math::tile::{Tile, scatter};
use crate::math::walk::{Seeds, lowest_keys};
use crate::settings::Settings;
use crate::stop::{Stop, go_on};

/// The slot whose piece is nearest to each pixel of a camera, row by row; the first of equally near ones.
pub(in crate::reformations) fn nearest_slots(level: &Level, camera: &Camera, stop: Stop) -> Result<Vec<u32>> {
    let mut view = ProjectedLevel::new(level);
    view.project(level, camera, Radii { scale: 1.0, unknown: 0.0 });
    let view_reach = camera.view_x(0).abs().max(camera.view_y(0).abs()) as f32;
    let rule = Rule { margin: 0.0, weight: 1.0, ..Rule::new(&Settings::default(), view.reach(), view_reach) };
    let mut plane = view.hierarchy;
    plane.flatten();
    let [width, height] = camera.size();
    let mut slots = vec![0; width * height];
    slots.par_chunks_mut(ROWS * width).enumerate().try_for_each(|(row, slots)| {
        go_on(stop)?;
        dispatch(Isa::widest(), NearestRow { plane: &plane, rule: &rule, level, camera, row, slots });
        Ok(())
    })?;
    Ok(slots)
}

struct NearestRow<'a> {
    plane: &'a Hierarchy,
    rule: &'a Rule,
    level: &'a Level,
    camera: &'a Camera,
    row: usize,
    slots: &'a mut [u32],
}

impl Kernel for NearestRow<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (mut seeds, width) = (Seeds::default(), self.camera.size()[0]);
        for column in (0..width).step_by(COLUMNS) {
            let tile = Tile::new(self.camera, column, self.row * ROWS);
            let mut nearest = Envelope::new(&[1.0; PIXELS]);
            lowest_keys::<false>(self.plane, &tile, self.rule, &seeds, &mut nearest);
            seeds = Seeds::collect(&nearest, &self.level.bundle_of_slot);
            scatter(&nearest.piece.map(|piece| piece / 2), self.slots, width, column);
        }
    }
}
