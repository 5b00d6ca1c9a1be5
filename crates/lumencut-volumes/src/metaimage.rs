//! MetaImage (.mha, .mhd): always LPS; the rows of `TransformMatrix` are the directions of i, j, k, as in ITK.

use crate::error::{Error, Opening};
use crate::known::Known;
use crate::numbers::{Kind, Scaling};
use crate::plan::require_inside;
use crate::plan::{Affine, Format, Grid, Place, Plan, Stored, detached};
use crate::stream::Codec;
use crate::text::{decoded, listed, number, short, shown};

const LONGEST_HEADER: u64 = 1 << 16;
const MOST_DIMS: f64 = 10.0;
const LARGEST: f64 = (1_u64 << 40) as f64;
const SPACING: [&str; 2] = ["ElementSpacing", "ElementSize"];
const ORIGIN: [&str; 3] = ["Offset", "Position", "Origin"];
const DIRECTION: [&str; 3] = ["TransformMatrix", "Rotation", "Orientation"];
const INTENSITY: [(&str, f64); 2] =
    [("ElementToIntensityFunctionSlope", 1.0), ("ElementToIntensityFunctionOffset", 0.0)];
const KINDS: [(&str, Kind); 12] = [
    ("MET_CHAR", Kind::Int8),
    ("MET_UCHAR", Kind::Uint8),
    ("MET_SHORT", Kind::Int16),
    ("MET_USHORT", Kind::Uint16),
    ("MET_INT", Kind::Int32),
    ("MET_UINT", Kind::Uint32),
    ("MET_LONG", Kind::Int32),
    ("MET_ULONG", Kind::Uint32),
    ("MET_LONG_LONG", Kind::Int64),
    ("MET_ULONG_LONG", Kind::Uint64),
    ("MET_FLOAT", Kind::Float32),
    ("MET_DOUBLE", Kind::Float64),
];

/// The fields of a header, and the byte after it.
struct Header<'a> {
    path: &'a str,
    /// If a name occurs several times, its last value counts.
    fields: Vec<(String, String)>,
    end: u64,
}

pub(crate) fn open(path: &str, known: &Known) -> Opening<Plan> {
    let header = Header::read(path, known.first(path, LONGEST_HEADER)?)?;
    let dims = header.whole("NDims", 1)?[0];
    if !(3.0..=MOST_DIMS).contains(&dims) {
        return Err(
            Error::new(path, format!("NDims = {}", dims as i64), "3 axes, or more of length 1").into()
        );
    }
    let dims = dims as usize;
    let size = header.size(dims)?;
    let channels = header.get("ElementNumberOfChannels").unwrap_or("1");
    if channels != "1" {
        let found = format!("{} channels per voxel", shown(channels));
        return Err(Error::new(path, found, "one").mend("write one channel").into());
    }
    let mut notes = Vec::new();
    let stored = header.stored()?;
    let world_from_index = header.affine(dims, &mut notes)?;
    let label = header.get("AnatomicalOrientation");
    let agrees = label.is_none_or(|label| label_agrees(label, &world_from_index, &mut notes));
    header.note_intensity(&mut notes);
    let place = header.place(known)?;
    let grid = Grid {
        size,
        world_from_index,
        states_spacing: header.first(&SPACING).is_some(),
        // If the label contradicts the matrix, neither orientation is reliable.
        states_orientation: agrees && (label.is_some() || header.first(&DIRECTION).is_some()),
        space: "LPS (as every MetaImage)".into(),
    };
    Ok(Plan {
        name: path.into(),
        format: Format::MetaImage,
        grid,
        stored,
        place,
        notes,
        remarks: Vec::new(),
        label_names: Vec::new(),
        segmentation: None,
        description: String::new(),
    })
}

impl<'a> Header<'a> {
    fn read(path: &'a str, head: &[u8]) -> Result<Self, Box<Error>> {
        let (mut fields, mut end) = (Vec::new(), 0);
        for line in head.split_inclusive(|&byte| byte == b'\n') {
            end += line.len() as u64;
            let line = decoded(line);
            let Some((name, value)) = line.split_once(['=', ':']) else { break };
            let name = name.trim();
            fields.push((name.into(), value.trim().into()));
            if name == "ElementDataFile" {
                return Ok(Self { path, fields, end });
            }
        }
        Err(Error::new(path, "a header without ElementDataFile", "a MetaImage header"))
    }

    fn get(&self, name: &str) -> Option<&str> {
        self.fields.iter().rev().find(|(one, _)| one == name).map(|(_, value)| value.as_str())
    }

    /// The text of the first of these synonymous fields that exists.
    fn first(&self, names: &[&str]) -> Option<&str> {
        names.iter().find_map(|name| self.get(name))
    }

    fn numbers(&self, names: &[&str], count: usize) -> Result<Vec<f64>, Box<Error>> {
        let text = self.first(names);
        let values: Option<Vec<f64>> = text.unwrap_or("").split_whitespace().map(number).collect();
        let values = values.unwrap_or_default();
        if values.len() == count && values.iter().all(|value| value.is_finite()) {
            return Ok(values);
        }
        let found = format!("{} = {}", names[0], text.map_or_else(|| "nothing".into(), shown));
        Err(Error::new(self.path, found, format!("{count} finite numbers")))
    }

    fn numbers_or(&self, names: &[&str], otherwise: Vec<f64>) -> Result<Vec<f64>, Box<Error>> {
        if self.first(names).is_some() { self.numbers(names, otherwise.len()) } else { Ok(otherwise) }
    }

    fn whole(&self, name: &str, count: usize) -> Result<Vec<f64>, Box<Error>> {
        let values = self.numbers(&[name], count)?;
        if values.iter().any(|value| value.fract() != 0.0 || value.abs() > LARGEST) {
            let found = format!("{name} = {}", shown(self.get(name).unwrap_or("")));
            return Err(Error::new(self.path, found, "whole numbers"));
        }
        Ok(values)
    }

    /// As in MetaIO, only the first letter of the text counts.
    fn is_true(&self, name: &str, otherwise: bool) -> bool {
        self.get(name).map_or(otherwise, |text| text.starts_with(['T', 't', '1']))
    }

    fn size(&self, dims: usize) -> Result<[u64; 3], Box<Error>> {
        let sizes = self.whole("DimSize", dims)?;
        if sizes[3..].iter().any(|&side| side != 1.0) || sizes.iter().any(|&side| side < 1.0) {
            let found = format!(
                "DimSize {}",
                shown(&listed(&sizes.iter().map(|&side| side as i64).collect::<Vec<_>>()))
            );
            let expected = "3 axes, or more of length 1";
            return Err(Error::new(self.path, found, expected).mend("write one time point"));
        }
        Ok([sizes[0] as u64, sizes[1] as u64, sizes[2] as u64])
    }

    fn stored(&self) -> Result<Stored, Box<Error>> {
        let name = self.get("ElementType").unwrap_or("");
        let Some(&(_, kind)) = KINDS.iter().find(|(known, _)| *known == name) else {
            let name = shown(name);
            let found = format!("ElementType = {}", if name.is_empty() { "nothing" } else { &name });
            let names: Vec<&str> = KINDS.iter().map(|(name, _)| *name).collect();
            return Err(Error::new(self.path, found, format!("one of {}", names.join(", "))));
        };
        let is_big =
            self.is_true("BinaryDataByteOrderMSB", false) || self.is_true("ElementByteOrderMSB", false);
        Ok(Stored { kind, is_big, scaling: Scaling::NONE })
    }

    fn affine(&self, dims: usize, notes: &mut Vec<String>) -> Result<Affine, Box<Error>> {
        if self.first(&SPACING).is_none() {
            notes.push("no ElementSpacing: 1 mm assumed".into());
        }
        let spacing = self.numbers_or(&SPACING, vec![1.0; dims])?;
        let origin = self.numbers_or(&ORIGIN, vec![0.0; dims])?;
        let identity = (0..dims * dims).map(|at| f64::from(u8::from(at % (dims + 1) == 0))).collect();
        let matrix = self.numbers_or(&DIRECTION, identity)?;
        if spacing[..3].iter().any(|&step| step <= 0.0) {
            let steps: Vec<String> = spacing.iter().map(|&step| short(step, 6)).collect();
            let found = format!("ElementSpacing = {}", listed(&steps));
            return Err(Error::new(self.path, found, "positive distances in mm"));
        }
        let of = |axis: usize, column: usize| matrix[column * dims + axis] * spacing[column];
        let row = |axis| [of(axis, 0), of(axis, 1), of(axis, 2), origin[axis]];
        Ok([row(0), row(1), row(2)])
    }

    /// Notes a scaling of the values; as in ITK, it is not applied.
    fn note_intensity(&self, notes: &mut Vec<String>) {
        for (name, neutral) in INTENSITY {
            if self.get(name).is_some_and(|text| number(text) != Some(neutral)) {
                notes.push(format!("{name} is not applied, as ITK does not"));
            }
        }
    }

    fn place(&self, known: &Known) -> Opening<Place> {
        const FIELD: &str = "ElementDataFile";
        let is_binary = self.is_true("BinaryData", true);
        let is_plain = is_binary && !self.is_true("CompressedData", false);
        let codec = match (is_binary, is_plain) {
            (false, _) => Codec::Text,
            (true, false) => Codec::Zlib,
            (true, true) => Codec::Raw,
        };
        let stated = self.get(FIELD).unwrap_or("");
        let is_local = stated.eq_ignore_ascii_case("LOCAL");
        let name = if is_local {
            self.path.into()
        } else {
            let found = |name: &str| format!("{FIELD} = {}", shown(name));
            let name = detached(self.path, stated, FIELD, found, ".mha")?;
            require_inside(known, self.path, &name, FIELD)?;
            name
        };
        let before = if self.get("HeaderSize").is_some() { self.whole("HeaderSize", 1)?[0] } else { 0.0 };
        let is_odd = is_local && ![-1.0, 0.0, self.end as f64].contains(&before);
        if before < if is_plain { -1.0 } else { 0.0 } || is_odd {
            // For voxels in the same file, ITK counts from the start of the file; others would count from the end of
            // the header.
            let expected = "0 or more bytes before the voxels of another file, or -1 with plain voxels";
            let error = Error::new(self.path, format!("HeaderSize = {}", before as i64), expected);
            return Err(error.mend("write a single .mha").into());
        }
        let start = if before < 0.0 { None } else { Some(if is_local { self.end } else { before as u64 }) };
        Ok(Place { name, start, lines: 0, skip: 0, codec })
    }
}

/// Whether the label agrees with the matrix. Its letters, as written by ITK, are the sides on which the axes begin.
fn label_agrees(label: &str, affine: &Affine, notes: &mut Vec<String>) -> bool {
    if label.len() != 3 || !label.chars().all(|letter| "RLAPIS".contains(letter)) {
        return true;
    }
    let side = |column: usize| {
        let along = [0, 1, 2].map(|axis| affine[axis][column]);
        let axis =
            (1..3).fold(0, |best, axis| if along[axis].abs() > along[best].abs() { axis } else { best });
        let (positive, negative) = [("R", "L"), ("A", "P"), ("I", "S")][axis];
        if along[axis] < 0.0 { negative } else { positive }
    };
    let sides = [0, 1, 2].map(side).concat();
    if label != sides {
        notes.push(format!("AnatomicalOrientation = {label}, the matrix says {sides}: the matrix is used"));
    }
    label == sides
}
