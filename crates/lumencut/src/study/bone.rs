//! Hides bone on request. Bone is found once; vessels that are listed later get their voxels back. Measurements, slices and the
//! cut always read the scan itself.

use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::polarity::Polarity;
use lumencut_core::scene::VolumeKey;
use lumencut_vessels::trace::find::bone_voxels::{BoneRequest, bone, for_each_voxel};
use lumencut_vessels::trace::find::found::Trees;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::voxels::Voxels;

use crate::study::failure::Result;
use crate::study::held_volume::{HeldVolume, no_volume};
use crate::study::lines::ListedLine;
use crate::study::open_study::Study;
use crate::study::tracing::Watch;
use crate::study::voxels::reserved;

/// Memory of the search for bone, for each voxel.
const SEARCH_BYTES: f64 = 3.0;

impl Study {
    /// Hides or shows bone around the vessels. No voxel of a listed line or of a sure vessel of the scan is hidden.
    pub(crate) fn hide_bone(&mut self, is_hidden: bool, listed: &[ListedLine], watch: Watch) -> Result<()> {
        if is_hidden {
            // Bone is told from bright vessels.
            let dark = self.content.polarity == Polarity::Dark;
            let is_known = self.content.without_bone.held.is_some();
            self.trace_dark(dark && is_known);
            let trees = if is_known { Ok(()) } else { self.trees(watch).map(|_| ()) };
            let hidden = trees.and_then(|()| self.leave_bone_out(listed, watch));
            self.trace_dark(dark);
            hidden?;
        }
        self.content.without_bone.is_shown = is_hidden;
        Ok(())
    }

    fn leave_bone_out(&mut self, listed: &[ListedLine], watch: Watch) -> Result<()> {
        let scan = self.content.held.as_ref().ok_or_else(no_volume)?;
        let known = &mut self.content.without_bone;
        let (mut new, mut vessels) = (Vec::new(), Vec::new());
        for one in listed.iter().filter(|one| !known.lines.contains(&one.line)) {
            new.push(one.line);
            vessels.push(self.lines.get(one.line)?.met());
        }
        match (&mut known.held, &self.trees) {
            (Some(held), _) if !vessels.is_empty() => give_back(held, scan, &vessels)?,
            (None, Some(trees)) => known.held = Some(without_bone(scan, trees, vessels, watch)?),
            _ => {}
        }
        known.lines.extend(new);
        Ok(())
    }
}

fn without_bone(
    scan: &HeldVolume,
    trees: &Trees,
    mut vessels: Vec<Centerline>,
    Watch { stop, .. }: Watch,
) -> Result<HeldVolume> {
    let sure = trees.vessels.iter().filter(|vessel| vessel.doubt.is_none());
    vessels.extend(sure.map(|vessel| vessel.line.clone()));
    let Trees { level, contrast, .. } = *trees;
    if vessels.is_empty() || contrast <= 0.0 {
        let expected = "a vessel, so that bone is distinguished from it";
        return Err(refused("no vessel of the scan", expected).mend("trace a vessel first").into());
    }
    // Without this memory the page would end during the search.
    drop(reserved::<u8>(SEARCH_BYTES * scan.size.iter().product::<usize>() as f64)?);
    let volume = scan.volume()?;
    let found = bone(&Voxels::new(&volume), &BoneRequest { level, contrast, vessels: &vessels, stop })?;
    if !found.contains(&true) {
        let expected = "large parts that are clearly brighter than the vessels";
        return Err(refused("none", expected).into());
    }
    // Bone gets the value of the tissue around the vessels, so that it leaves no hole with a surface.
    let stored = scan.stored.replaced(|n| found[n], level - contrast)?;
    let (size, world_from_index) = (scan.size, scan.world_from_index);
    Ok(HeldVolume { stored, size, world_from_index, key: VolumeKey::default(), scan: scan.scan.clone() })
}

fn refused(found: &str, expected: &str) -> Error {
    Error::new(ErrorKind::Tracing, "bone", found, expected)
}

/// Gives the voxels of vessels and their walls the values of the scan.
fn give_back(held: &mut HeldVolume, scan: &HeldVolume, vessels: &[Centerline]) -> Result<()> {
    let volume = scan.volume()?;
    let voxels = Voxels::new(&volume);
    for vessel in vessels {
        for_each_voxel(&voxels, vessel, &mut |n, _| held.stored.take_voxel(&scan.stored, n));
    }
    held.key = VolumeKey::default();
    Ok(())
}

#[cfg(test)]
#[path = "tests/bone.rs"]
mod tests;
