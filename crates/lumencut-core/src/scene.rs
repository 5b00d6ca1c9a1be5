//! The content of a view: a volume that all renderers share, and a tree that can be exchanged independently.

use std::sync::{Arc, Mutex, OnceLock, PoisonError, Weak};

use rayon::prelude::*;

use crate::error::Result;
use crate::math::blocks::Blocks;
use crate::math::body::Body;
use crate::math::centerline_smoothing::smooth_centerlines;
use crate::math::projection::Level;
use crate::stages::levels::levels;
use crate::stop::Stop;
use crate::vessel_tree::VesselTree;
use crate::volume::Volume;

/// The content of a view. Cloning is cheap: clones share the [`VolumeKey`] and the [`LeveledTree`].
#[derive(Clone, Debug, Default)]
pub struct Scene<'a> {
    /// The volume; without it only the cut surface can be rendered.
    pub volume: Option<SharedVolume<'a>>,
    /// The tree; without it only the context of the volume can be shown.
    pub tree: Option<Arc<LeveledTree>>,
    /// What the context shows instead of the volume, on the same grid and of the same type, such as the volume without bone.
    pub context: Option<SharedVolume<'a>>,
}

impl<'a> Scene<'a> {
    /// A scene of a new volume and a new tree.
    pub fn new(volume: Volume<'a>, tree: VesselTree) -> Self {
        Self::default().with_volume(volume).with_tree(tree)
    }

    /// Replaces the volume by a new one.
    #[must_use]
    pub fn with_volume(self, volume: Volume<'a>) -> Self {
        Self { volume: Some(SharedVolume::new(volume, VolumeKey::default())), ..self }
    }

    /// The volume that the context shows.
    pub fn shown_around(&self) -> Option<&SharedVolume<'a>> {
        self.context.as_ref().or(self.volume.as_ref())
    }

    /// Replaces the tree; data computed from the volume are kept.
    #[must_use]
    pub fn with_tree(self, tree: VesselTree) -> Self {
        Self { tree: Some(Arc::new(LeveledTree::new(tree))), ..self }
    }
}

/// Identifies the voxels of one volume for caches on CPU and GPU, independent of who borrows the voxels.
/// Clones share the key.
#[derive(Clone, Debug, Default)]
pub struct VolumeKey {
    found: Arc<Found>,
}

/// What was computed from the voxels of one volume.
#[derive(Debug, Default)]
struct Found {
    blocks: OnceLock<Blocks>,
    body: OnceLock<Option<Body>>,
}

/// A [`VolumeKey`] that keeps no cached data in memory.
#[derive(Clone, Debug)]
pub struct WeakVolumeKey(Weak<Found>);

impl VolumeKey {
    /// The same key; it keeps no cached data in memory.
    pub fn downgrade(&self) -> WeakVolumeKey {
        WeakVolumeKey(Arc::downgrade(&self.found))
    }
}

impl WeakVolumeKey {
    /// Whether this is the same key.
    pub fn is(&self, key: &VolumeKey) -> bool {
        self.0.ptr_eq(&Arc::downgrade(&key.found))
    }
}

/// A volume and what was computed from its voxels.
#[derive(Clone, Debug)]
pub struct SharedVolume<'a> {
    /// The voxels and their grid.
    pub volume: Volume<'a>,
    /// Identifies the voxels.
    pub key: VolumeKey,
}

impl<'a> SharedVolume<'a> {
    /// `volume`, whose voxels `key` identifies.
    pub fn new(volume: Volume<'a>, key: VolumeKey) -> Self {
        Self { volume, key }
    }

    /// The smallest and largest values of the volume's blocks, computed at the first call.
    pub fn blocks(&self, stop: Stop) -> Result<&Blocks> {
        if let Some(blocks) = self.key.found.blocks.get() {
            return Ok(blocks);
        }
        // Computed outside the lock: a waiting pool thread may start another view and then deadlock.
        let blocks = Blocks::new(&self.volume, stop)?;
        Ok(self.key.found.blocks.get_or_init(|| blocks))
    }

    /// The body in the volume, found at the first call; `None` without air around it.
    pub fn body(&self, stop: Stop) -> Result<Option<&Body>> {
        if let Some(body) = self.key.found.body.get() {
            return Ok(body.as_ref());
        }
        let body = Body::of(&self.volume, stop)?;
        Ok(self.key.found.body.get_or_init(|| body).as_ref())
    }
}

/// Number of `centerline_smoothing` values with cached levels, so that two renderers can alternate.
const CACHED_SMOOTHINGS: usize = 2;

/// A tree with its levels of detail, computed once for all renderers.
#[derive(Debug)]
pub struct LeveledTree {
    tree: VesselTree,
    kept: Mutex<Vec<(f64, Arc<Vec<Level>>)>>,
}

impl LeveledTree {
    /// A tree whose levels are computed when they are first needed.
    pub fn new(tree: VesselTree) -> Self {
        Self { tree, kept: Mutex::default() }
    }

    /// The tree.
    pub fn tree(&self) -> &VesselTree {
        &self.tree
    }

    /// The levels of the tree smoothed by `smoothing` radii, from the finest to `coarsest` or beyond. Levels
    /// of the last two smoothings stay cached.
    pub fn levels(&self, coarsest: usize, smoothing: f64) -> Arc<Vec<Level>> {
        if let Some(known) = self.latest(smoothing, None).filter(|known| known.len() > coarsest) {
            return known;
        }
        // Computed outside the lock, as in `SharedVolume::blocks`.
        let made = if smoothing > 0.0 {
            levels(&smooth_centerlines(&self.tree, smoothing), coarsest)
        } else {
            levels(&self.tree, coarsest)
        };
        let made = Arc::new(made.par_iter().map(Level::new).collect());
        self.latest(smoothing, Some(&made)).unwrap_or(made)
    }

    /// The cached levels of `smoothing`, which become the latest; or `made` if it has more levels.
    fn latest(&self, smoothing: f64, made: Option<&Arc<Vec<Level>>>) -> Option<Arc<Vec<Level>>> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let place = kept.iter().position(|(value, _)| *value == smoothing);
        let known = place.map(|place| kept.remove(place).1);
        // If both have as many levels, the cached ones win, since other views may already use them.
        let most = [made, known.as_ref()].into_iter().flatten().max_by_key(|levels| levels.len()).cloned()?;
        kept.insert(0, (smoothing, Arc::clone(&most)));
        kept.truncate(CACHED_SMOOTHINGS);
        Some(most)
    }
}
