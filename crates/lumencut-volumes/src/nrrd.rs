//! NRRD (.nrrd, .nhdr): its space becomes LPS, voxels stay as they are.

mod axes;
mod fields;
mod placement;

use crate::error::{Error, Opening};
use crate::known::Known;
use crate::numbers::{Kind, Scaling};
use crate::plan::require_inside;
use crate::plan::{Format, Grid, Place, Plan, Stored, detached};
use crate::segments::{self, Layers, Segmentation};
use crate::stream::Codec;
use crate::text::shown;
use fields::{Header, LONGEST_HEADER};

const NAMES: [(Kind, &[&str]); 10] = [
    (Kind::Int8, &["signed char", "int8", "int8_t"]),
    (Kind::Uint8, &["uchar", "unsigned char", "uint8", "uint8_t"]),
    (Kind::Int16, &["short", "short int", "signed short", "signed short int", "int16", "int16_t"]),
    (Kind::Uint16, &["ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"]),
    (Kind::Int32, &["int", "signed int", "int32", "int32_t"]),
    (Kind::Uint32, &["uint", "unsigned int", "uint32", "uint32_t"]),
    (
        Kind::Int64,
        &[
            "longlong",
            "long long",
            "long long int",
            "signed long long",
            "signed long long int",
            "int64",
            "int64_t",
        ],
    ),
    (Kind::Uint64, &["ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"]),
    (Kind::Float32, &["float"]),
    (Kind::Float64, &["double"]),
];

pub(crate) fn open(path: &str, known: &Known, chosen: Option<&[u32]>) -> Opening<Plan> {
    let header = Header::read(path, known.first(path, LONGEST_HEADER)?)?;
    let mut notes = Vec::new();
    let mut remarks = Vec::new();
    let axes = header.axes()?;
    let kind = kind_of(&header)?;
    let is_big = is_big(&header, kind)?;
    let world_from_index = header.affine(&axes.of_grid, &mut notes)?;
    let place = place_of(&header, known)?;
    let layers = Layers { count: axes.layers, after: axes.after };
    let segmentation = segmentation_of(&header, layers, chosen)?;
    if segmentation.as_ref().is_some_and(Segmentation::is_renumbered) {
        remarks.push("several segments share a label: segments are numbered from 1".into());
    }
    let space = shown(header.text("space"));
    let grid = Grid {
        size: axes.of_grid.map(|axis| axes.sizes[axis]),
        world_from_index,
        states_spacing: header.states_spacing(&axes.of_grid)?,
        states_orientation: header.has("space directions") && header.names_patient_axes(),
        space: if space.is_empty() { "none stated".into() } else { space },
    };
    Ok(Plan {
        name: path.into(),
        format: Format::Nrrd,
        grid,
        stored: Stored { kind, is_big, scaling: Scaling::NONE },
        place,
        notes,
        remarks,
        label_names: segmentation.as_ref().map(Segmentation::names).unwrap_or_default(),
        segmentation,
        description: header.content,
    })
}

fn kind_of(header: &Header) -> Result<Kind, Box<Error>> {
    let name = header.required("type")?.to_ascii_lowercase();
    let found = NAMES.iter().find(|(_, names)| names.contains(&name.as_str()));
    let refused = || Error::new(header.path, format!("type: {}", shown(&name)), "an integer or float type");
    Ok(found.ok_or_else(refused)?.0)
}

fn is_big(header: &Header, kind: Kind) -> Result<bool, Box<Error>> {
    let endian = header.text("endian").to_ascii_lowercase();
    if kind.bytes() == 1 || codec_of(&header.text("encoding").to_ascii_lowercase()) == Some(Codec::Text) {
        return Ok(false);
    }
    match endian.as_str() {
        "little" => Ok(false),
        "big" => Ok(true),
        _ => {
            let stated = shown(&endian);
            let found = format!("endian: {}", if stated.is_empty() { "nothing" } else { &stated });
            Err(Error::new(header.path, found, "little or big"))
        }
    }
}

fn codec_of(encoding: &str) -> Option<Codec> {
    Some(match encoding {
        "raw" => Codec::Raw,
        "gzip" | "gz" => Codec::Zlib,
        "bzip2" | "bz2" => Codec::Bzip2,
        "ascii" | "text" | "txt" => Codec::Text,
        _ => return None,
    })
}

fn place_of(header: &Header, known: &Known) -> Opening<Place> {
    const FIELD: &str = "data file";
    let path = header.path;
    let encoding = header.required("encoding")?.to_ascii_lowercase();
    let Some(codec) = codec_of(&encoding) else {
        let error = Error::new(path, format!("encoding: {}", shown(&encoding)), "raw, ascii, gzip or bzip2");
        return Err(error.mend("write it with encoding gzip or raw").into());
    };
    let (lines, skip) = (header.whole("line skip")?, header.whole("byte skip")?);
    let Ok(lines) = u64::try_from(lines) else {
        return Err(Error::new(path, format!("line skip: {lines}"), "0 or more lines").into());
    };
    let is_last = codec == Codec::Raw && skip == -1;
    if skip < 0 && !is_last {
        let expected = "0 or more bytes, or -1 with encoding raw";
        return Err(Error::new(path, format!("byte skip: {skip}"), expected).into());
    }
    let mut name = path.to_owned();
    if header.has(FIELD) {
        let found = |name: &str| format!("{FIELD}: {}", shown(name));
        name = detached(path, header.text(FIELD), FIELD, found, ".nrrd")?;
        require_inside(known, path, &name, FIELD)?;
    }
    let start = if header.has(FIELD) { 0 } else { header.end };
    if is_last {
        return Ok(Place { name, start: None, lines: 0, skip: 0, codec });
    }
    Ok(Place { name, start: Some(start), lines, skip: skip.cast_unsigned(), codec })
}

fn segmentation_of(
    header: &Header,
    layers: Layers,
    chosen: Option<&[u32]>,
) -> Result<Option<Segmentation>, Box<Error>> {
    if !segments::has_segments(&header.lines) {
        return Ok(None);
    }
    Segmentation::read(header.path, &header.lines, layers, chosen).map(Some)
}
