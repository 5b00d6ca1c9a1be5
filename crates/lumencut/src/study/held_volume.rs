//! A volume in memory for a viewer, which passes first the header, and then the voxels as bytes.

use std::collections::BTreeMap;

use glam::{DAffine3, DMat4, DVec4};
use lumencut_core::scene::{SharedVolume, VolumeKey};
use lumencut_core::volume::Volume;
use serde::Deserialize;

use crate::mask_grid::Grid;
use crate::scan_details::ScanDetails;
use crate::study::failure::{Failure, Result};
use crate::study::voxels::Stored;

#[derive(Clone, Debug, Deserialize)]
pub(crate) struct VolumeHeader {
    /// Voxels along (i, j, k); i varies fastest.
    pub size: [usize; 3],
    pub(crate) dtype: String,
    /// Affine from voxel indices to world positions (LPS, mm), row by row.
    pub world_from_index: [[f64; 4]; 4],
    #[serde(default)]
    pub scan: ScanDetails,
    /// Label names of a mask, if its file has them.
    #[serde(default)]
    pub(crate) label_names: BTreeMap<i64, String>,
}

impl VolumeHeader {
    pub(crate) fn read(text: &str) -> Result<Self> {
        let expected = "size, dtype and world_from_index as JSON";
        serde_json::from_str(text)
            .map_err(|error| Failure::of_message("header of the volume", &error, expected))
    }

    pub(crate) fn held(&self) -> Result<HeldVolume> {
        let count = self.size.iter().map(|side| *side as f64).product();
        let stored = Stored::zeros(&self.dtype, count)?;
        let (size, world_from_index) = (self.size, self.affine());
        let (key, scan) = (VolumeKey::default(), self.scan.clone());
        let held = HeldVolume { stored, size, world_from_index, key, scan };
        held.volume()?;
        Ok(held)
    }

    pub(crate) fn grid(&self) -> Grid {
        Grid { size: self.size, world_from_index: self.affine() }
    }

    fn affine(&self) -> DAffine3 {
        DAffine3::from_mat4(
            DMat4::from_cols_array_2d(&self.world_from_index.map(|row| DVec4::from(row).to_array()))
                .transpose(),
        )
    }
}

/// The open volume.
#[derive(Debug)]
pub struct HeldVolume {
    /// The voxels, i fastest.
    pub stored: Stored,
    /// Voxels along (i, j, k).
    pub size: [usize; 3],
    /// Affine from voxel indices to world positions (LPS, mm).
    pub world_from_index: DAffine3,
    /// Identifies the voxels in caches.
    pub key: VolumeKey,
    /// How the scan was made.
    pub scan: ScanDetails,
}

impl HeldVolume {
    /// `count` writable bytes of the voxels, from `offset` on. Fails with an error of kind `volume` if the bytes lie
    /// beyond the end of the voxels, or if there is no volume.
    pub fn bytes(held: Option<&mut Self>, offset: usize, count: usize) -> Result<&mut [u8]> {
        let bytes = held.map_or(&mut [][..], |held| held.stored.bytes_mut());
        let expected = format!("at most the {} that the header states", bytes.len());
        let end = offset.saturating_add(count);
        bytes.get_mut(offset..end).ok_or_else(|| Failure {
            kind: "volume",
            ..Failure::of_message("bytes of the volume", &end, &expected)
        })
    }

    /// The volume as the type of the core, which borrows the voxels. Fails with an error of kind `volume` for an
    /// invalid grid.
    pub fn volume(&self) -> Result<Volume<'_>> {
        let [ni, nj, _] = self.size;
        Ok(Volume::new(self.stored.voxels(), self.size, [1, ni, ni * nj], self.world_from_index)?)
    }

    /// As [`HeldVolume::volume`], for renderers.
    pub fn shared(&self) -> Result<SharedVolume<'_>> {
        Ok(SharedVolume::new(self.volume()?, self.key.clone()))
    }
}

#[derive(Debug)]
pub(crate) struct HeldMask {
    pub held: HeldVolume,
    pub(crate) label_names: BTreeMap<i64, String>,
}

pub(crate) fn no_volume() -> Failure {
    Failure { kind: "volume", ..Failure::of_message("volume", &"none", "an open volume") }
}
