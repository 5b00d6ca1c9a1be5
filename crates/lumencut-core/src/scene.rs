//! What a view shows: a volume that all renderers share, and a tree that can be exchanged without touching the volume.

use std::sync::{Arc, Mutex, OnceLock, PoisonError, Weak};

use rayon::prelude::*;

use crate::error::Result;
use crate::math::blocks::Blocks;
use crate::math::projection::Level;
use crate::stages::levels::levels;
use crate::stop::Stop;
use crate::vessel_tree::VesselTree;
use crate::volume::Volume;

/// What is shown. A scene is cheap to make and to clone: whatever takes time is kept behind it, by the [`VolumeKey`] and
/// by the [`LeveledTree`].
#[derive(Clone, Debug, Default)]
pub struct Scene<'a> {
    /// The volume; without it only the cut surface can be made.
    pub volume: Option<SharedVolume<'a>>,
    /// The tree; without it only the context of the volume can be shown.
    pub tree: Option<Arc<LeveledTree>>,
}

impl<'a> Scene<'a> {
    /// A volume and a tree that was not used before.
    pub fn new(volume: Volume<'a>, tree: VesselTree) -> Self {
        Self::default().with_volume(volume).with_tree(tree)
    }

    /// The same scene with a volume that was not used before.
    #[must_use]
    pub fn with_volume(self, volume: Volume<'a>) -> Self {
        Self { volume: Some(SharedVolume::new(volume, VolumeKey::default())), ..self }
    }

    /// The same volume with another tree: what is known of the volume stays.
    #[must_use]
    pub fn with_tree(self, tree: VesselTree) -> Self {
        Self { tree: Some(Arc::new(LeveledTree::new(tree))), ..self }
    }
}

/// Stands for the voxels of one volume, wherever they are borrowed: what was learnt of them once, and what a GPU keeps
/// of them, is found by it. Clones stand for the same voxels.
#[derive(Clone, Debug, Default)]
pub struct VolumeKey {
    blocks: Arc<OnceLock<Blocks>>,
}

/// A [`VolumeKey`] that keeps nothing in memory.
#[derive(Clone, Debug)]
pub struct WeakVolumeKey(Weak<OnceLock<Blocks>>);

impl VolumeKey {
    /// The same key, which keeps nothing in memory.
    pub fn downgrade(&self) -> WeakVolumeKey {
        WeakVolumeKey(Arc::downgrade(&self.blocks))
    }
}

impl WeakVolumeKey {
    /// Whether it is this key.
    pub fn is(&self, key: &VolumeKey) -> bool {
        self.0.ptr_eq(&Arc::downgrade(&key.blocks))
    }
}

/// A volume together with what is known of its voxels.
#[derive(Clone, Debug)]
pub struct SharedVolume<'a> {
    /// The voxels and their grid.
    pub volume: Volume<'a>,
    /// Stands for the voxels.
    pub key: VolumeKey,
}

impl<'a> SharedVolume<'a> {
    /// `volume`, whose voxels `key` stands for.
    pub fn new(volume: Volume<'a>, key: VolumeKey) -> Self {
        Self { volume, key }
    }

    /// The smallest and largest values of the volume's blocks, made at the first call.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Interrupted`] once `stop` says so.
    pub fn blocks(&self, stop: Stop) -> Result<&Blocks> {
        if let Some(blocks) = self.key.blocks.get() {
            return Ok(blocks);
        }
        // Made outside the lock: a thread of the pool that waited for its part could take up another view and wait
        // for itself. Blocks that someone else made meanwhile are the same.
        let blocks = Blocks::new(&self.volume, stop)?;
        Ok(self.key.blocks.get_or_init(|| blocks))
    }
}

/// A tree with its levels of detail, which are made once for all renderers.
#[derive(Debug)]
pub struct LeveledTree {
    tree: VesselTree,
    levels: Mutex<Arc<Vec<Level>>>,
}

impl LeveledTree {
    /// A tree whose levels are made when they are first needed.
    pub fn new(tree: VesselTree) -> Self {
        Self { tree, levels: Mutex::default() }
    }

    /// The tree.
    pub fn tree(&self) -> &VesselTree {
        &self.tree
    }

    /// The tree's own points and at least `coarsest` levels of detail, finest first.
    pub fn levels(&self, coarsest: usize) -> Arc<Vec<Level>> {
        let known = self.kept(|_| ());
        if known.len() > coarsest {
            return known;
        }
        // Made outside the lock, for the reason that `SharedVolume::blocks` gives.
        let made: Arc<Vec<_>> = Arc::new(levels(&self.tree, coarsest).par_iter().map(Level::new).collect());
        self.kept(|kept| {
            if kept.len() <= coarsest {
                *kept = made;
            }
        })
    }

    fn kept(&self, update: impl FnOnce(&mut Arc<Vec<Level>>)) -> Arc<Vec<Level>> {
        let mut kept = self.levels.lock().unwrap_or_else(PoisonError::into_inner);
        update(&mut kept);
        Arc::clone(&kept)
    }
}
