//! The one study that is open: a volume, a tree, or both.

use std::sync::{Arc, OnceLock};

use crate::windows;
use glam::{DAffine3, DVec3};
use lumencut_core::scene::{LeveledTree, Scene, SharedVolume, VolumeKey};
use lumencut_core::settings::Window;
use lumencut_core::vessel_tree::VesselTree;
use lumencut_core::volume::Volume;
use serde::Serialize;
use serde_json::json;

use crate::study::failure::{Failure, Result};
use crate::study::voxels::Stored;

/// A volume that the page holds.
#[derive(Debug)]
pub struct Held {
    /// Its voxels, i fastest.
    pub stored: Stored,
    /// The number of voxels along (i, j, k).
    pub size: [usize; 3],
    /// World position of a continuous index.
    pub world_from_index: DAffine3,
    /// Stands for the voxels.
    pub key: VolumeKey,
}

impl Held {
    /// The bytes of its voxels from `offset` on, `count` of them, to be written.
    ///
    /// # Errors
    /// `volume` where it ends before, and where there is none.
    pub fn bytes(held: Option<&mut Self>, offset: usize, count: usize) -> Result<&mut [u8]> {
        let bytes = held.map_or(&mut [][..], |held| held.stored.bytes_mut());
        let expected = format!("no more than the {} that the header tells of", bytes.len());
        let end = offset.saturating_add(count);
        bytes.get_mut(offset..end).ok_or_else(|| Failure {
            kind: "volume",
            ..Failure::of_message("bytes of the volume", &end, &expected)
        })
    }

    /// The volume as the core borrows it.
    ///
    /// # Errors
    /// `volume` for a grid that is none.
    pub fn volume(&self) -> Result<Volume<'_>> {
        let [ni, nj, _] = self.size;
        Ok(Volume::new(self.stored.voxels(), self.size, [1, ni, ni * nj], self.world_from_index)?)
    }

    /// The same for renderers.
    fn shared(&self) -> Result<SharedVolume<'_>> {
        Ok(SharedVolume::new(self.volume()?, self.key.clone()))
    }
}

/// A tree with the names and the lines of its vessels.
#[derive(Debug)]
pub struct Named {
    /// The tree.
    pub leveled: Arc<LeveledTree>,
    /// One name for each vessel; empty where it has none.
    pub names: Vec<String>,
    /// The number of the line of each vessel.
    pub lines: Vec<usize>,
}

impl Named {
    /// A tree of which nothing is known yet.
    pub fn new(tree: VesselTree, names: Vec<String>, lines: Vec<usize>) -> Self {
        Self { leveled: Arc::new(LeveledTree::new(tree)), names, lines }
    }
}

/// What is open.
#[derive(Debug, Default)]
pub struct Study {
    /// The volume.
    pub held: Option<Held>,
    /// The tree.
    pub named: Option<Named>,
    /// The windows of what was opened, once they were asked for.
    windows: OnceLock<Option<Windows>>,
}

/// Level and width of a window, as the page has them.
type LevelWidth = [f64; 2];

/// The windows that the data suggest.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Windows {
    /// That of cut surface and context.
    main: LevelWidth,
    /// That of a MIP.
    mip: LevelWidth,
    /// That of contexts of minimum and mean: air to lumen.
    whole: LevelWidth,
    /// From the smallest voxel to the largest.
    full: LevelWidth,
}

impl Study {
    /// What the renderers show.
    ///
    /// # Errors
    /// `volume` for a grid that is none.
    pub fn scene(&self) -> Result<Scene<'_>> {
        let volume = self.held.as_ref().map(Held::shared).transpose()?;
        Ok(Scene { volume, tree: self.tree().cloned() })
    }

    /// The tree, where one is open.
    pub fn tree(&self) -> Option<&Arc<LeveledTree>> {
        self.named.as_ref().map(|named| &named.leveled)
    }

    /// Takes the windows from the data anew when they are asked for.
    pub fn forget_windows(&mut self) {
        self.windows = OnceLock::new();
    }

    /// The windows that the data suggest, as they were when they were first asked for; none without a volume.
    ///
    /// # Errors
    /// `volume` for values beyond all windows.
    pub fn windows(&self) -> Result<Option<Windows>> {
        if let Some(known) = self.windows.get() {
            return Ok(*known);
        }
        let made = self.windows_of_data()?;
        Ok(*self.windows.get_or_init(|| made))
    }

    fn windows_of_data(&self) -> Result<Option<Windows>> {
        let Some(held) = &self.held else { return Ok(None) };
        let volume = &held.volume()?;
        let (main, mip) = match self.tree() {
            Some(tree) => {
                let along = windows::along(volume, tree.tree())?;
                (along, along)
            }
            None => (windows::of_volume(volume)?, windows::of_mip(volume)?),
        };
        let pair = |window: Window| [window.level, window.width];
        let [whole, full] = [windows::whole(volume)?, windows::full(volume)?].map(pair);
        Ok(Some(Windows { main: pair(main), mip: pair(mip), whole, full }))
    }

    /// What a view of all of it must show: the corners of the volume, or the points of the tree.
    pub fn outline(&self) -> Result<Vec<DVec3>> {
        let points = |named: &Named| {
            named.leveled.tree().vessels().iter().flat_map(|vessel| vessel.points()).copied().collect()
        };
        match (&self.named, &self.held) {
            (Some(named), _) => Ok(points(named)),
            (None, Some(held)) => Ok(held.volume()?.corners().to_vec()),
            (None, None) => Ok(Vec::new()),
        }
    }

    /// What the page must know of it: the volume's size, grid and windows, and the vessels with names and lengths.
    ///
    /// # Errors
    /// As [`Study::windows`].
    pub fn report(&self) -> Result<serde_json::Value> {
        let volume = self.held.as_ref().map(|held| {
            let corners = held.volume().map(|volume| volume.corners().map(|corner| corner.to_array()));
            let side = held.volume().map(|volume| volume.smallest_side());
            let rows = glam::DMat4::from(held.world_from_index).transpose().to_cols_array_2d();
            Ok::<_, Failure>(
                json!({"size": held.size, "world_from_index": rows, "corners": corners?, "smallest_side": side?}),
            )
        });
        let vessels = self.named.as_ref().map(|named| {
            let vessels = named.leveled.tree().vessels().iter().zip(&named.names).zip(&named.lines);
            let about = vessels.map(|((vessel, name), line)| {
                json!({"line": line, "name": name, "length": vessel.arc_length().last(), "has_radius": vessel.radius().is_some()})
            });
            about.collect::<Vec<_>>()
        });
        Ok(json!({"volume": volume.transpose()?, "vessels": vessels, "windows": self.windows()?}))
    }
}
