//! NIfTI-1 and -2, single files and pairs, gzipped or not. The RAS+ affine is converted to LPS; voxels stay in order.

mod header;
mod labels;
mod placement;
mod wide;

use crate::error::{Error, Opening};
use crate::known::{Found, Known};
use crate::numbers::{Kind, Scaling};
use crate::plan::{Grid, Place, Plan, Stored};
use crate::stream::{Codec, is_gzip};
use crate::text::{latin1, short};

pub(crate) use header::format_of;
use header::{HEADER_BYTES, Header};

const LONGEST: usize = 1 << 20;
const COMPLEX: (&str, &str) = ("complex voxels", "write their magnitude");
const COLOUR: (&str, &str) = ("colour voxels", "write one channel");

pub(crate) fn open(path: &str, known: &Known) -> Opening<Plan> {
    let home = partner(path, known, [".img", ".hdr"])?;
    if known.found(&home)? == Found::Missing {
        return Err(Error::missing(&home, &format!("the header of {path}")).into());
    }
    let head = known.head(&home, HEADER_BYTES)?;
    let mut header = Header::read(&home, &head)?;
    let kind = kind_of(&home, header.datatype)?;
    let data = if header.is_pair { partner(&home, known, [".hdr", ".img"])? } else { home.clone() };
    let mut notes = Vec::new();
    let is_single = data == home;
    let skip = header.voxel_offset(path, is_single, &mut notes)?;
    let size = header.size(path)?;
    header.mend(path, &mut notes)?;
    let world_from_index = header.placement(path, size, &mut notes)?;
    let scaling = scaling_of(path, &header)?;
    let remarks = if scaling.is_none() { Vec::new() } else { vec![scaling_remark(kind, scaling)] };
    let end = if is_single { usize::try_from(skip).unwrap_or(LONGEST) } else { LONGEST };
    let grid = Grid {
        size,
        world_from_index,
        states_spacing: header.states_spacing(),
        states_orientation: header.states_orientation(),
        space: header.space().into(),
    };
    Ok(Plan {
        name: path.into(),
        format: header.format,
        grid,
        stored: Stored { kind, is_big: header.is_big, scaling },
        place: Place { codec: codec_of(known, &data)?, name: data, start: Some(0), lines: 0, skip },
        notes,
        remarks,
        label_names: label_names(known, &home, &header, end)?,
        segmentation: None,
        description: latin1(&header.description),
    })
}

/// What the NIfTI header of an image in memory states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedUnits {
    /// Millimetres per unit of length; 1 if no unit is stated.
    pub millimetres: f64,
    /// Whether lengths in mm are known.
    pub spacing: bool,
    /// Whether the sides of the patient are known.
    pub orientation: bool,
}

/// What the bytes of a NIfTI header state; None if they are not a NIfTI header.
#[must_use]
pub fn stated_units(header: &[u8]) -> Option<StatedUnits> {
    let header = Header::read("", header).ok()?;
    let millimetres = header.millimetres(&mut Vec::new());
    Some(StatedUnits {
        millimetres,
        spacing: header.states_spacing(),
        orientation: header.states_orientation(),
    })
}

/// A missing file counts as uncompressed; it is reported when it is read.
fn codec_of(known: &Known, data: &str) -> Opening<Codec> {
    Ok(match known.found(data)? {
        Found::Size(_) | Found::Outside(_) if is_gzip(known.first(data, 2)?) => Codec::Zlib,
        _ => Codec::Raw,
    })
}

/// The other file of a pair if the name ends with `mine` (`x.hdr.gz` or `x.hdr` for `x.img.gz`), else the file
/// itself.
fn partner(path: &str, known: &Known, [mine, other]: [&str; 2]) -> Opening<String> {
    let is_zipped = path.to_ascii_lowercase().ends_with(".gz");
    let stem = if is_zipped { &path[..path.len() - 3] } else { path };
    if !stem.to_ascii_lowercase().ends_with(mine) {
        return Ok(path.into());
    }
    let ending =
        if stem.ends_with(&mine.to_ascii_uppercase()) { other.to_ascii_uppercase() } else { other.into() };
    let stem = &stem[..stem.len() - mine.len()];
    let tails = [if is_zipped { ".gz" } else { "" }, "", ".gz"];
    let names = tails.map(|tail| format!("{stem}{ending}{tail}"));
    Ok(known.first_found(&names)?.unwrap_or_else(|| names[0].clone()))
}

fn kind_of(path: &str, code: i16) -> Result<Kind, Box<Error>> {
    let (found, mend) = match code {
        2 => return Ok(Kind::Uint8),
        4 => return Ok(Kind::Int16),
        8 => return Ok(Kind::Int32),
        16 => return Ok(Kind::Float32),
        64 => return Ok(Kind::Float64),
        256 => return Ok(Kind::Int8),
        512 => return Ok(Kind::Uint16),
        768 => return Ok(Kind::Uint32),
        1024 => return Ok(Kind::Int64),
        1280 => return Ok(Kind::Uint64),
        0 => ("voxels of no stated type", "convert the file"),
        1 => ("voxels of one bit", "write bytes"),
        32 | 1792 | 2048 => COMPLEX,
        128 | 2304 => COLOUR,
        1536 => ("voxels of 128-bit floats", "write 64-bit floats"),
        _ => (&*format!("voxels of the unknown type {code}"), "convert the file"),
    };
    Err(Error::new(path, found, "one integer or float of up to 64 bits per voxel").mend(mend))
}

fn scaling_of(path: &str, header: &Header) -> Result<Scaling, Box<Error>> {
    let (slope, intercept) = (header.slope, header.intercept);
    if !slope.is_finite() || slope == 0.0 {
        return Ok(Scaling::NONE);
    }
    if !intercept.is_finite() {
        let found = format!("scl_slope {} and scl_inter {}", short(slope, 6), short(intercept, 6));
        return Err(Error::new(path, found, "finite numbers"));
    }
    Ok(Scaling { slope, intercept })
}

fn scaling_remark(kind: Kind, scaling: Scaling) -> String {
    let (slope, intercept) = (short(scaling.slope, 6), short(scaling.intercept, 6));
    let result = match kind {
        _ if kind.is_integer() && scaling.is_integral() => "integers where 64 bits hold them",
        Kind::Float64 => "read as float64",
        _ => "read as float32",
    };
    format!("values are scaled by {slope} and shifted by {intercept}: {result}")
}

fn label_names(known: &Known, home: &str, header: &Header, end: usize) -> Opening<Vec<(i64, String)>> {
    let length = header.length();
    let start = known.unpacked(home, length + 4)?;
    if !labels::has_extensions(&start, length) {
        return Ok(Vec::new());
    }
    let head = known.unpacked(home, LONGEST.min(end))?;
    Ok(labels::names_in(&head, length, header.is_big))
}
