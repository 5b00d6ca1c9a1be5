//! Recognises a file by its first bytes, else by its name, and reads its header.

use crate::error::{Error, Stop};
use crate::known::Known;
use crate::plan::{Format, Plan};
use crate::text::latin1;
use crate::{metaimage, nifti, nrrd};

/// Number of unpacked bytes from which the format of a file is recognised.
pub const HEAD: usize = 4096;

/// Reads the header of the file `name` (without its folder) from `known`, which the host has fetched so far. `chosen`
/// are the numbers of the segments to read of a segmentation; None reads all. Fails with [`Stop::Need`] if `known`
/// lacks something: the host adds it and calls again. Fails with [`Stop::Unknown`] for a file of another format, and
/// with [`Stop::Refused`] for a file that cannot be read.
pub fn open(name: &str, known: &Known, chosen: Option<&[u32]>) -> Result<Plan, Stop> {
    let head = known.head(name, HEAD)?;
    if head.is_empty() {
        let expected = "a NIfTI, NRRD or MetaImage volume";
        return Err(Error::new(name, "an empty file", expected).mend("copy or export it again").into());
    }
    let plan = match format_of(name, &head) {
        Some(Format::Nrrd) => nrrd::open(name, known, chosen)?,
        Some(Format::MetaImage) => metaimage::open(name, known)?,
        Some(Format::Nifti1 | Format::Nifti2) => nifti::open(name, known)?,
        None => return Err(Stop::Unknown),
    };
    // `Fill` checks it for the stated size, after it has refused a size that the file does not fill.
    plan.grid.check(name, [1; 3])?;
    Ok(plan)
}

/// The format that the first bytes of a file (unpacked) and its name state. If only the name is that of NIfTI, the
/// file counts as NIfTI-1, so that the reader of NIfTI states what is wrong.
#[must_use]
pub fn format_of(name: &str, head: &[u8]) -> Option<Format> {
    let name = name.to_ascii_lowercase();
    if head.starts_with(b"NRRD") {
        return Some(Format::Nrrd);
    }
    if name.ends_with(".mha") || name.ends_with(".mhd") || states_image(head) {
        return Some(Format::MetaImage);
    }
    let plain = name.strip_suffix(".gz").unwrap_or(&name);
    let has_name = [".nii", ".hdr", ".img"].iter().any(|ending| plain.ends_with(ending));
    nifti::format_of(head).or(has_name.then_some(Format::Nifti1))
}

fn states_image(head: &[u8]) -> bool {
    latin1(head).lines().any(|line| {
        let (name, value) = line.split_once('=').unwrap_or_default();
        name.trim_end().ends_with("ObjectType") && value.trim_start().starts_with("Image")
    })
}
