//! What is opened and closed: volumes, phantoms and centerlines.

use lumencut_phantom::Phantom;

use crate::failure::Result;
use crate::files::{VolumeHeader, read_centerlines};
use crate::phantoms::phantom;
use crate::session::Session;
use crate::study::Held;
use crate::voxels::Stored;

impl Session {
    /// Makes room for a volume and puts it in the place of all that is open; its voxels follow as bytes.
    ///
    /// # Errors
    /// `settings` for a header that is none, `volume` for more voxels than there is memory for and for a grid that is none.
    pub fn begin_volume(&mut self, header: &str) -> Result<()> {
        let header = VolumeHeader::read(header)?;
        self.close();
        self.study.held = Some(header.held()?);
        Ok(())
    }

    /// The bytes of the voxels from `offset` on, `count` of them, to be written.
    ///
    /// # Errors
    /// `volume` where the volume ends before.
    pub fn voxel_bytes(&mut self, offset: usize, count: usize) -> Result<&mut [u8]> {
        Held::bytes(self.study.held.as_mut(), offset, count)
    }

    /// What is known of the voxels no longer counts: some of them are others now.
    pub fn voxels_changed(&mut self) {
        self.tracer = Default::default();
        self.forget_profiles();
        self.study.forget_windows();
        if let Some(held) = &mut self.study.held {
            held.key = Default::default();
        }
    }

    /// Opens a phantom in the place of all that is open, in `scale` times as many voxels along each axis where it is one that
    /// has scales.
    ///
    /// # Errors
    /// `settings` for another name, `volume` where there is no memory for it.
    pub fn open_phantom(&mut self, name: &str, scale: f64) -> Result<()> {
        self.close();
        let Phantom { voxels, size, world_from_index, tree, vessel_names, .. } = phantom(name, scale)?;
        let stored = Stored::I16(voxels);
        self.study.held = Some(Held { stored, size, world_from_index, key: Default::default() });
        self.show_tree(tree, vessel_names)
    }

    /// Opens centerlines beside the volume, in the place of those before, in the space (`lps` or `ras`) that is named; tells what
    /// was odd about them.
    ///
    /// # Errors
    /// `format` for a file that is damaged or holds none; the tree before stays then.
    pub fn open_centerlines(&mut self, bytes: &[u8], name: &str, space: Option<&str>) -> Result<Vec<String>> {
        let volume = self.study.held.as_ref().map(Held::volume).transpose()?;
        let read = read_centerlines(bytes, name, space, volume.as_ref())?;
        self.study.forget_windows();
        self.show_tree(read.tree, read.names)?;
        Ok(read.notes)
    }

    /// Closes what is open; its memory is free again.
    pub fn close(&mut self) {
        let mut lines = std::mem::take(&mut self.lines);
        lines.clear();
        *self = Self { lines, ..Self::default() };
    }
}
