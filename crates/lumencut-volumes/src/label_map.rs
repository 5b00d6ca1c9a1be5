//! Merges the layers of a segmentation into one label map.

use std::ops::Range;

use crate::convert::{reals, write_number};
use crate::error::{Error, ErrorKind};
use crate::numbers::Kind;
use crate::plan::Stored;
use crate::segments::{Segment, Segmentation};

/// Number of values in memory; more if the layers of a voxel are farther apart in the file.
const HELD: usize = 1 << 16;

/// Receives the values of all layers in the order of the file, and returns labels. It keeps voxels until all their
/// layers are read: few voxels if layers are the fastest axis, all if they are the slowest.
pub(crate) struct LabelMap {
    stored: Stored,
    kind: Kind,
    segmentation: Segmentation,
    /// For each layer: the values of its segments in rising order, with the indices of these segments.
    of_layer: Vec<Vec<(u32, usize)>>,
    /// Number of values between two layers of one voxel.
    inner: usize,
    /// For each voxel of the block: the index of its segment plus 1, or 0.
    block: Vec<u32>,
    /// Number of voxels without returned labels, including those of the block.
    left: u64,
    at: usize,
    given: usize,
    overlaps: Vec<([usize; 2], u64)>,
}

impl LabelMap {
    pub(crate) fn new(segmentation: &Segmentation, size: [u64; 3], stored: Stored) -> Option<Self> {
        let mut of_layer = vec![Vec::new(); usize::try_from(segmentation.layers).ok()?];
        for segment in segmentation.read_ones() {
            let place = segmentation.segments.iter().position(|one| one == segment)?;
            let values: &mut Vec<(u32, usize)> = &mut of_layer[usize::try_from(segment.layer).ok()?];
            values.insert(values.partition_point(|(one, _)| *one <= segment.value), (segment.value, place));
        }
        let product = |sides: &[u64]| sides.iter().try_fold(1_u64, |all, &side| all.checked_mul(side));
        let inner = usize::try_from(product(&size[..segmentation.after])?).ok()?;
        let left = product(&size)?;
        let block = inner * (HELD / inner.checked_mul(of_layer.len())?).max(1);
        let block = vec![0; usize::try_from(left).unwrap_or(block).min(block)];
        let (kind, segmentation) = (segmentation.kind(), segmentation.clone());
        let overlaps = Vec::new();
        Some(Self { stored, kind, segmentation, of_layer, inner, block, left, at: 0, given: 0, overlaps })
    }

    fn values(&self) -> usize {
        self.block.len() * self.of_layer.len()
    }

    /// Whether all values of the block are read, so that its labels can be returned.
    pub(crate) fn has_labels(&self) -> bool {
        self.at == self.values() && self.left > 0
    }

    /// Reads complete values up to the end of the block; returns the number of bytes read.
    pub(crate) fn take(&mut self, from: &[u8]) -> usize {
        let unit = self.stored.kind.bytes();
        let count = (from.len() / unit).min(self.values() - self.at);
        let mut values = vec![0.0; count];
        reals(self.stored, &from[..count * unit], &mut values);
        let mut last = (0, f64::NAN, 0..0);
        for value in values {
            let outer = self.at / self.inner / self.of_layer.len();
            let layer = self.at / self.inner % self.of_layer.len();
            let voxel = outer * self.inner + self.at % self.inner;
            self.at += 1;
            if (last.0, last.1) != (layer, value) {
                last = (layer, value, self.places(layer, value));
            }
            for place in last.2.clone() {
                self.put(voxel, self.of_layer[layer][place].1);
            }
        }
        count * unit
    }

    fn places(&self, layer: usize, value: f64) -> Range<usize> {
        let values = &self.of_layer[layer];
        let start = values.partition_point(|(one, _)| f64::from(*one) < value);
        let count = values[start..].iter().take_while(|(one, _)| f64::from(*one) == value).count();
        start..start + count
    }

    fn put(&mut self, voxel: usize, place: usize) {
        let label = &mut self.block[voxel];
        if let Some(other) = label.checked_sub(1) {
            let pair = [place.min(other as usize), place.max(other as usize)];
            match self.overlaps.iter_mut().find(|(one, _)| *one == pair) {
                Some((_, count)) => *count += 1,
                None => self.overlaps.push((pair, 1)),
            }
        }
        *label = u32::try_from(place + 1).unwrap_or(u32::MAX);
    }

    pub(crate) fn give(&mut self, to: &mut [u8]) -> usize {
        let unit = self.kind.bytes();
        let labels = &mut self.block[self.given..];
        let count = labels.len().min(to.len() / unit);
        for (label, bytes) in labels[..count].iter_mut().zip(to.chunks_exact_mut(unit)) {
            let place = std::mem::take(label).checked_sub(1);
            let number = place.map_or(0, |place| self.segmentation.segments[place as usize].number);
            write_number(self.kind, number.into(), 0.0, bytes);
        }
        self.given += count;
        if self.given == self.block.len() {
            self.left -= self.given as u64;
            let next = usize::try_from(self.left).unwrap_or(usize::MAX).min(self.block.len());
            self.block.truncate(next);
            (self.given, self.at) = (0, 0);
        }
        count * unit
    }

    /// Rejects overlapping segments, because a label map holds one number per voxel.
    pub(crate) fn refuse_overlaps(&self, subject: &str) -> Result<(), Box<Error>> {
        let mut found: Option<&([usize; 2], u64)> = None;
        for one in &self.overlaps {
            found = Some(found.filter(|most| most.1 >= one.1).unwrap_or(one));
        }
        let Some((pair, count)) = found else { return Ok(()) };
        let words = |place: usize| {
            let Segment { number, name, .. } = &self.segmentation.segments[place];
            format!("{number} {name}")
        };
        let others = self.overlaps.len() - 1;
        let more = if others > 0 { format!(" and {others} more pairs") } else { String::new() };
        let (first, second) = (words(pair[0]), words(pair[1]));
        let found = format!("segments that overlap: {first} and {second} in {count} voxels{more}");
        let mend =
            "choose segments that do not, by segments=(1,) of read_volume or --label of lumencut trace";
        let error = Error::new(subject, found, "at most one segment in each voxel");
        Err(error.mend(mend).of(ErrorKind::Overlap))
    }
}
