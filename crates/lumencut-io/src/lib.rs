//! Readers and writers of centerline files, one module per format.
//!
//! [`read`] returns the [`Centerlines`] of a file in its own space and unit. [`Centerlines::scaled`] converts
//! them to mm. [`junctions::vessels`] turns repeated trunks and single segments into vessels that meet.
//!
//! | format | recognised by | unit and space | radius |
//! |---|---|---|---|
//! | VTK XML poly data, `.vtp` | `<VTKFile` | none; `SPACE` | a point array |
//! | legacy VTK, `.vtk` | `# vtk` | none; `SPACE=` in the title | a point array |
//! | 3D Slicer markups, `.mrk.json` | `{` | stated, else mm; stated | the measurement `Radius` |
//! | SimVascular path, `.pth` | `<path` or `<format` | none, usually cm; none | none |
//! | SWC, `.swc` | seven columns, or its name | none; none | the sixth column |
//! | ITK tube, `.tre` | `ObjectType =` | mm; LPS | `r` of `PointDim` |
//! | 3D Slicer fiducials, `.fcsv` | `# Markups fiducial`, or its name | mm; stated | none |
//! | Rotterdam reference, `.txt` | five columns of numbers, or its name | none; none | the fourth column |
//! | text table, `.csv`, `.tsv`, `.txt` | numbers or a header | the header's | the header's, or a fourth column |
//! | NumPy array, `.npy` | `\x93NUMPY` | none; none | a fourth column |
//!
//! Readers rely on a count or offset in a file only if the file is large enough for it. They unpack
//! compressed data within a budget that grows with the file size.

mod centerlines;
mod compression;
mod data_array;
mod encoding;
mod error;
mod fcsv;
mod itk_tube;
mod json;
mod jumps;
pub mod junctions;
mod kind;
mod mend;
mod meta_object;
mod mrk_json;
mod npy;
mod placed_points;
mod poly_data;
mod rotterdam;
pub mod session_file;
mod simvascular;
mod space;
mod swc;
mod table;
mod table_columns;
mod text;
mod unit;
mod vtk_cursor;
mod vtk_legacy;
mod vtp;
mod vtp_xml;
mod write;
mod xml;
mod xz;

#[cfg(test)]
mod tests;

pub use centerlines::{Centerlines, Line};
pub use error::{Error, Result};
pub use mend::Mend;
pub use space::Space;
pub use unit::Unit;
pub use write::{marked_cell, write_csv, write_mrk_json, write_swc, write_vtk, write_vtp};

use kind::Kind;

/// Reads the centerlines of a file, in the unit and space of the file.
///
/// Pass the result to [`Centerlines::scaled`] (factor 1 for mm), which enforces the limit of 1e6 mm. The
/// content decides the format, `file_name` only if the content is ambiguous. Fails for an unknown format,
/// damaged content, or a file without lines; the error states file and place.
pub fn read(bytes: &[u8], file_name: &str) -> Result<Centerlines> {
    read_unnamed(bytes, file_name).map_err(|error| error.in_file(file_name))
}

fn read_unnamed(bytes: &[u8], file_name: &str) -> Result<Centerlines> {
    if bytes.is_empty() {
        return Err(Error::truncated("", "an empty file", "a centerline file"));
    }
    let content = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match kind::of(content, file_name)? {
        Kind::VtkXml => vtp::read(content),
        Kind::VtkLegacy => vtk_legacy::read(content),
        Kind::Markups => mrk_json::read(content),
        Kind::SimVascular => simvascular::read(content),
        Kind::Swc => swc::read(content),
        Kind::ItkTube => itk_tube::read(content),
        Kind::Fiducials => fcsv::read(content),
        Kind::Rotterdam => rotterdam::read(content),
        Kind::Table => table::read(content),
        Kind::Npy => npy::read(content),
    }
}
