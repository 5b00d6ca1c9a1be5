//! The segments that 3D Slicer describes in the header of a `.seg.nrrd`.

use crate::error::Error;
use crate::numbers::Kind;
use crate::text::printable;

const MOST_LAYERS: u64 = 1000;
const LARGEST_NUMBER: u32 = 65535;
const FIELDS: [&str; 4] = ["Name", "LabelValue", "Layer", "ID"];

/// A segment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Segment {
    /// The number in the label map.
    pub number: u32,
    /// The name.
    pub name: String,
    /// The layer that holds the voxels.
    pub layer: u64,
    /// The value of the voxels in that layer.
    pub value: u32,
}

/// The layers of a segmentation; each holds one value per voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layers {
    /// Number of layers.
    pub count: u64,
    /// Number of grid axes that vary faster than the axis of the layers.
    pub after: usize,
}

/// The segments of a file, with the data to merge them into one label map.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Segmentation {
    /// All segments of the file.
    pub segments: Vec<Segment>,
    /// Numbers of the segments to read; None for all.
    pub chosen: Option<Vec<u32>>,
    /// Number of values per voxel.
    pub layers: u64,
    /// Number of grid axes that vary faster than the axis of the layers.
    pub after: usize,
    /// Whether the stored values are the label map.
    pub is_as_stored: bool,
}

impl Segment {
    fn words(&self) -> String {
        format!("{} {}", self.number, self.name)
    }
}

impl Segmentation {
    pub(crate) fn read(
        path: &str,
        lines: &[String],
        layers: Layers,
        chosen: Option<&[u32]>,
    ) -> Result<Self, Box<Error>> {
        let segments = segments_of(lines, layers.count);
        let has_labels = segments.iter().all(|one| one.number == one.value);
        let read = Self {
            is_as_stored: layers.count == 1 && chosen.is_none() && has_labels,
            segments,
            chosen: chosen.map(<[u32]>::to_vec),
            layers: layers.count,
            after: layers.after,
        };
        read.check(path)?;
        Ok(read)
    }

    pub(crate) fn is_renumbered(&self) -> bool {
        self.segments.iter().any(|one| one.number != one.value)
    }

    pub(crate) fn kind(&self) -> Kind {
        let most = self.segments.iter().map(|one| one.number).max().unwrap_or(0);
        if most <= u32::from(u8::MAX) { Kind::Uint8 } else { Kind::Uint16 }
    }

    pub(crate) fn names(&self) -> Vec<(i64, String)> {
        self.segments.iter().map(|one| (one.number.into(), one.name.clone())).collect()
    }

    pub(crate) fn read_ones(&self) -> impl Iterator<Item = &Segment> {
        let is_read = |one: &&Segment| self.chosen.as_ref().is_none_or(|chosen| chosen.contains(&one.number));
        self.segments.iter().filter(is_read)
    }

    /// The number of layers and all segments, in the words of a report.
    #[must_use]
    pub fn details(&self) -> [String; 2] {
        let layers = if self.layers == 1 { "1 layer".into() } else { format!("{} layers", self.layers) };
        [layers, self.segments.iter().map(Segment::words).collect::<Vec<_>>().join("; ")]
    }

    fn check(&self, path: &str) -> Result<(), Box<Error>> {
        for number in self.chosen.iter().flatten() {
            if !self.segments.iter().any(|one| one.number == *number) {
                let known = self.segments.iter().map(Segment::words).collect::<Vec<_>>().join(", ");
                let known = if known.is_empty() { "none" } else { &known };
                let expected = format!("segments of the file: {known}");
                return Err(Error::new(path, format!("no segment {number}"), expected));
            }
        }
        for one in &self.segments {
            if one.layer >= self.layers || self.layers > MOST_LAYERS {
                let found = format!("segment {} in layer {} of {}", one.words(), one.layer, self.layers);
                return Err(
                    Error::new(path, found, "a layer of the file").mend("save the segmentation again")
                );
            }
            if !(1..=LARGEST_NUMBER).contains(&one.number) {
                let found = format!("segment {} with the label {}", one.name, one.number);
                let expected = format!("labels from 1 to {LARGEST_NUMBER}");
                return Err(Error::new(path, found, expected).mend("save it again"));
            }
        }
        Ok(())
    }
}

pub(crate) fn has_segments(lines: &[String]) -> bool {
    lines.iter().any(|line| field_of(line).is_some())
}

fn field_of(line: &str) -> Option<(u32, usize, &str)> {
    let (name, value) = line.trim().strip_prefix("Segment")?.split_once(":=")?;
    let (number, field) = name.split_once('_')?;
    let is_number = (1..=6).contains(&number.len()) && number.bytes().all(|digit| digit.is_ascii_digit());
    let field = FIELDS.iter().position(|one| *one == field)?;
    is_number.then(|| Some((number.parse().ok()?, field, value.trim())))?
}

/// Segments have the numbers of their labels; if several share a label, all are numbered from 1. Files from before
/// 2020 state neither layers nor labels: each of their segments has its own layer.
fn segments_of(lines: &[String], layers: u64) -> Vec<Segment> {
    let mut stated: Vec<(u32, [&str; 4])> = Vec::new();
    for (number, field, value) in lines.iter().filter_map(|line| field_of(line)) {
        let place = stated.partition_point(|(one, _)| *one < number);
        if stated.get(place).is_none_or(|(one, _)| *one != number) {
            stated.insert(place, (number, [""; 4]));
        }
        stated[place].1[field] = value;
    }
    let mut segments: Vec<Segment> = Vec::new();
    let mut numbers: Vec<u32> = Vec::new();
    for (place, (_, [name, value, layer, _])) in stated.into_iter().enumerate() {
        let first = if layers > 1 { place as u64 } else { 0 };
        let layer = whole(layer).map_or(first, u64::from);
        let value = whole(value).unwrap_or(1);
        let name = if name.is_empty() { format!("segment {}", place + 1) } else { printable(name) };
        segments.push(Segment { number: value, name, layer, value });
        if let Err(place) = numbers.binary_search(&value) {
            numbers.insert(place, value);
        }
    }
    if numbers.len() < segments.len() {
        for (number, segment) in (1..).zip(&mut segments) {
            segment.number = number;
        }
    }
    segments
}

fn whole(text: &str) -> Option<u32> {
    let is_number = (1..=9).contains(&text.len()) && text.bytes().all(|digit| digit.is_ascii_digit());
    is_number.then(|| text.parse().ok())?
}
