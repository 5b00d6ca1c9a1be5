//! The volume without bone, which the context shows on request.

use crate::study::held_volume::HeldVolume;

#[derive(Debug, Default)]
pub(crate) struct WithoutBone {
    pub(crate) held: Option<HeldVolume>,
    /// The lines whose voxels are kept.
    pub(crate) lines: Vec<usize>,
    pub(crate) is_shown: bool,
}

impl WithoutBone {
    /// The volume without bone, while bone is hidden.
    pub(crate) fn shown(&self) -> Option<&HeldVolume> {
        self.held.as_ref().filter(|_| self.is_shown)
    }
}
