//! Volumes that are too large for a GPU, and volumes whose transfer is stopped.
#![allow(clippy::unwrap_used)]

use glam::DAffine3;
use lumencut_core::error::ErrorKind;
use lumencut_core::math::blocks::Blocks;
use lumencut_core::volume::Voxels;
use lumencut_scenes::views::view_beside_voxels;
use lumencut_scenes::volumes::{sheared, volume};

use super::device;
use super::placed::Placed;
use crate::blocks::first_that_fits;
use crate::volume::DeviceVolume;

#[test]
fn a_volume_longer_than_the_gpu_allows_is_refused() {
    let Some(device) = device() else { return };
    let side = device.limits.max_texture_dimension_3d as usize;
    let voxels = vec![0i8; side + 1];
    for (length, fits) in [(side, true), (side + 1, false)] {
        let volume = volume(Voxels::I8(&voxels), [1, length, 1], DAffine3::IDENTITY);
        let sent = DeviceVolume::new(device, &volume, &|| false);
        assert_eq!(sent.map_err(|error| error.kind).err(), (!fits).then_some(ErrorKind::Device));
    }
}

#[test]
fn sending_stops_when_asked() {
    let Some(device) = device() else { return };
    let volume = volume(Voxels::I8(&[0; 8]), [2; 3], sheared([2; 3]));
    let sent = DeviceVolume::new(device, &volume, &|| true);
    assert_eq!(sent.unwrap_err().kind, ErrorKind::Interrupted);
}

#[test]
fn blocks_that_do_not_fit_begin_with_larger_ones() {
    let Some(device) = device() else { return };
    let camera = view_beside_voxels([0.0, 1.0, 0.0], [1, 1], 1.0);
    let voxels = vec![7i8; 40 * 30 * 20];
    let volume = volume(Voxels::I8(&voxels), [40, 30, 20], sheared([40, 30, 20]));
    let places = Placed::new(device, &volume, &camera).blocks().places;
    let levels = &places.levels[..places.level_count as usize];
    assert_eq!(levels[..3], [[10, 8, 5, 0], [5, 4, 3, 400], [3, 2, 2, 460]]);
    assert_eq!(levels.last().unwrap()[..3], [1; 3]);
    let blocks = Blocks::new(&volume, &|| false).unwrap();
    let all: Vec<_> = blocks.levels().collect();
    for (room, first) in [(475, 0), (474, 1), (75, 1), (74, 2), (0, all.len() - 1)] {
        assert_eq!(first_that_fits(&all, room), first, "room for {room}");
    }
}
