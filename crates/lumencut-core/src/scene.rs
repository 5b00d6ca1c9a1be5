//! What a view shows: a volume that all renderers share, and a tree that can be exchanged without touching the volume.

use std::sync::{Arc, Mutex, OnceLock, PoisonError, Weak};

use rayon::prelude::*;

use crate::error::Result;
use crate::math::blocks::Blocks;
use crate::math::centerline_smoothing::smooth_centerlines;
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

/// For how many values of `centerline_smoothing` the levels of a tree are kept: one picture with it and one without can
/// take turns, or two renderers.
const KEPT: usize = 2;

/// A tree with its levels of detail, which are made once for all renderers.
#[derive(Debug)]
pub struct LeveledTree {
    tree: VesselTree,
    /// The values of `centerline_smoothing` that were asked for last, the latest first, and their levels.
    kept: Mutex<Vec<(f64, Arc<Vec<Level>>)>>,
}

impl LeveledTree {
    /// A tree whose levels are made when they are first needed.
    pub fn new(tree: VesselTree) -> Self {
        Self { tree, kept: Mutex::default() }
    }

    /// The tree.
    pub fn tree(&self) -> &VesselTree {
        &self.tree
    }

    /// The tree's own points, smoothed by `smoothing` radii, and at least `coarsest` levels of detail, finest first.
    ///
    /// The levels of the two values of `smoothing` that were asked for last are kept.
    pub fn levels(&self, coarsest: usize, smoothing: f64) -> Arc<Vec<Level>> {
        if let Some(known) = self.latest(smoothing, None).filter(|known| known.len() > coarsest) {
            return known;
        }
        // Made outside the lock, for the reason that `SharedVolume::blocks` gives.
        let made = if smoothing > 0.0 {
            levels(&smooth_centerlines(&self.tree, smoothing), coarsest)
        } else {
            levels(&self.tree, coarsest)
        };
        let made = Arc::new(made.par_iter().map(Level::new).collect());
        self.latest(smoothing, Some(&made)).unwrap_or(made)
    }

    /// The levels of `smoothing`, which become the latest; `made` are kept where there are fewer.
    fn latest(&self, smoothing: f64, made: Option<&Arc<Vec<Level>>>) -> Option<Arc<Vec<Level>>> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let place = kept.iter().position(|(value, _)| *value == smoothing);
        let known = place.map(|place| kept.remove(place).1);
        // Of equally many the known ones stay, which others may hold already: the last of them counts.
        let most = [made, known.as_ref()].into_iter().flatten().max_by_key(|levels| levels.len()).cloned()?;
        kept.insert(0, (smoothing, Arc::clone(&most)));
        kept.truncate(KEPT);
        Some(most)
    }
}
