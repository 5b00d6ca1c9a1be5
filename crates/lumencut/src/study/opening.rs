//! Opens and closes volumes and centerlines.

use lumencut_core::vessel_tree::VesselTree;

use crate::study::centerline_files::{Asked, OpenedLines, read_centerlines};
use crate::study::failure::Result;
use crate::study::held_volume::{HeldVolume, VolumeHeader};
use crate::study::open_study::Study;

impl Study {
    /// Closes the current study and allocates memory for a volume, whose voxels then follow as bytes. Fails with an
    /// error of kind `settings` for an invalid header; of kind `volume` if memory is insufficient or the grid is
    /// invalid.
    pub fn begin_volume(&mut self, header: &str) -> Result<()> {
        let header = VolumeHeader::read(header)?;
        self.close();
        self.content.held = Some(header.held()?);
        Ok(())
    }

    /// `count` writable bytes of voxels from `offset` on. Fails with an error of kind `volume` if the bytes lie
    /// beyond the end of the volume.
    pub fn voxel_bytes(&mut self, offset: usize, count: usize) -> Result<&mut [u8]> {
        HeldVolume::bytes(self.content.held.as_mut(), offset, count)
    }

    /// Discards caches after the voxels have changed.
    pub fn voxels_changed(&mut self) {
        self.tracer = Default::default();
        self.trees = None;
        self.forget_profiles();
        self.content.forget_windows();
        self.content.without_bone = Default::default();
        if let Some(held) = &mut self.content.held {
            held.key = Default::default();
        }
    }

    /// Closes the current study and opens a volume with named vessels. Fails with an error of kind `vessel tree` for
    /// an invalid tree.
    pub fn open(&mut self, held: HeldVolume, tree: VesselTree, names: Vec<String>) -> Result<()> {
        self.close();
        self.content.held = Some(held);
        self.show_tree(tree, names)
    }

    /// Opens centerlines in place of the current ones, and returns notes. After an error the current vessels stay.
    pub(crate) fn open_centerlines(
        &mut self,
        bytes: &[u8],
        name: &str,
        asked: impl Into<Asked>,
    ) -> Result<OpenedLines> {
        let volume = self.content.held.as_ref().map(HeldVolume::volume).transpose()?;
        let read = read_centerlines(bytes, name, asked.into(), volume.as_ref())?;
        self.content.forget_windows();
        self.show_tree(read.tree, read.names)?;
        self.content.can_reorder = read.can_reorder;
        Ok(OpenedLines { notes: read.notes, doubt: read.doubt })
    }

    /// Closes the study and frees the memory that it used.
    pub fn close(&mut self) {
        let mut lines = std::mem::take(&mut self.lines);
        lines.clear();
        *self = Self { lines, ..Self::default() };
    }
}
