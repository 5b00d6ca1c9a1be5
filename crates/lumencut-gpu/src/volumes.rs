//! The volumes on a GPU: each is sent once, whichever renderer shows it first.

use std::sync::{Arc, Mutex, PoisonError, Weak};

use lumencut_core::error::Result;
use lumencut_core::scene::{SharedVolume, WeakVolumeKey};
use lumencut_core::stop::Stop;

use crate::device::Device;
use crate::volume::DeviceVolume;

/// The volumes that some renderers of one GPU have on it, as long as any of them shows them.
#[derive(Debug, Default)]
pub(crate) struct Volumes(Mutex<Vec<(WeakVolumeKey, Weak<DeviceVolume>)>>);

impl Volumes {
    /// The volume on the GPU, sent where it is not there yet.
    ///
    /// # Errors
    /// As [`DeviceVolume::new`].
    pub fn kept(&self, device: &Device, shared: &SharedVolume, stop: Stop) -> Result<Arc<DeviceVolume>> {
        if let Some(volume) = self.find(shared) {
            return Ok(volume);
        }
        // Sent without holding the lock: large volumes take their time.
        let volume = Arc::new(DeviceVolume::new(device, &shared.volume, stop)?);
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push((shared.key.downgrade(), Arc::downgrade(&volume)));
        Ok(volume)
    }

    fn find(&self, shared: &SharedVolume) -> Option<Arc<DeviceVolume>> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.retain(|(_, volume)| volume.strong_count() > 0);
        kept.iter().find(|(key, _)| key.is(&shared.key)).and_then(|(_, volume)| volume.upgrade())
    }
}
