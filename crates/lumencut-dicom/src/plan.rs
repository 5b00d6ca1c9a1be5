//! How a series becomes a volume: what a host needs to know to read its pixels.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::geometry::Stack;
use crate::keyword::Keyword;
use crate::oddities::images_of;
use crate::scan::Scan;
use crate::series::Series;
use crate::slices::{Pair, Slice};
use crate::uids;
use crate::wording::{listed, shown};

/// The volume that a series becomes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// The number of voxels along i, j, k.
    pub size: [i64; 3],
    /// The affine from voxel indices to the patient's space (mm, LPS), by its rows; shear is kept.
    pub world_from_index: [[f64; 4]; 4],
    /// The type of stored numbers in NumPy's words, such as `i2` or `f4`.
    pub stored_type: String,
    /// The slices in the order of their places.
    pub slices: Vec<PlannedSlice>,
    /// Whether the places of slices may be fractions.
    pub is_resampled: bool,
    /// The indices k at which there is no slice.
    pub missing: Vec<i64>,
    /// How each of them is made of its neighbours.
    pub fills: Vec<Fill>,
    /// Frames that are taken for one: where values differ, the host judges again with these pairs as
    /// [`Headers::unlike`](crate::Headers::unlike).
    pub compared: Vec<Compared>,
    /// What a reader of the volume should know.
    pub notes: Vec<String>,
    /// What else is told of the series.
    pub details: Details,
    /// How its scan was made.
    pub scan: Scan,
}

/// One slice that is read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlannedSlice {
    /// The number of its file.
    pub file: usize,
    /// The number of its frame, from 0.
    pub frame: usize,
    /// The index k at which it lies.
    pub place: f64,
    /// The factor from stored numbers to values.
    pub slope: f64,
    /// What is added to them.
    pub intercept: f64,
}

/// A slice that is read, and one that is left out if its values are the same.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compared {
    /// The one that is read.
    pub kept: PlannedSlice,
    /// The one that is left out.
    pub other: PlannedSlice,
}

/// A slice that is made of two that are read: (1 - part) × before + part × after.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fill {
    /// The index k at which it lies.
    pub k: i64,
    /// The number of the slice before it in [`Plan::slices`].
    pub before: usize,
    /// The number of the slice after it.
    pub after: usize,
    /// How far it is from the one to the other.
    pub part: f64,
}

/// What is told of a series whoever reads it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Details {
    /// Its number and description.
    pub series: String,
    /// Its unique identifier.
    pub series_uid: String,
    /// Its modality.
    pub modality: String,
    /// How many files it is read from.
    pub files: String,
    /// The transfer syntaxes of its pixels.
    pub pixels: String,
}

impl Plan {
    /// The plan for the stack of a series.
    pub fn new(series: &Series, stack: &Stack, copies: &[Pair], notes: Vec<String>) -> Self {
        let missing = stack.missing();
        Self {
            size: stack.size(),
            world_from_index: rows(stack),
            stored_type: stored_type(stack),
            slices: planned(stack),
            is_resampled: stack.is_resampled,
            fills: fills(&stack.places, &missing),
            missing,
            compared: copies.iter().chain(&stack.repeats).map(compared).collect(),
            notes,
            details: details(series, stack),
            scan: Scan::of(series, &stack.slices),
        }
    }
}

fn rows(stack: &Stack) -> [[f64; 4]; 4] {
    let [i, j, k] = stack.steps.map(|step| step.to_array());
    let origin = stack.origin.to_array();
    let row = |n: usize| [i[n], j[n], k[n], origin[n]];
    [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
}

fn stored_type(stack: &Stack) -> String {
    let image = stack.slices[0].image;
    let bits = image.get(Keyword::BitsAllocated).integer().unwrap_or_default();
    let kind = match image.get(Keyword::PixelRepresentation).integer() {
        _ if image.header.pixels != "PixelData" => 'f',
        Some(1) => 'i',
        _ => 'u',
    };
    format!("{kind}{}", bits / 8)
}

fn planned(stack: &Stack) -> Vec<PlannedSlice> {
    stack.slices.iter().zip(&stack.places).map(|(one, &place)| planned_at(one, place)).collect()
}

fn planned_at(one: &Slice, place: f64) -> PlannedSlice {
    let (slope, intercept) = one.scaling;
    PlannedSlice { file: one.image.file, frame: one.frame, place, slope, intercept }
}

fn compared((kept, other): &Pair) -> Compared {
    Compared { kept: planned_at(kept, 0.0), other: planned_at(other, 0.0) }
}

fn fills(places: &[f64], missing: &[i64]) -> Vec<Fill> {
    let fill = |&k: &i64| {
        let after = places.partition_point(|&place| place < k as f64).clamp(1, places.len() - 1);
        let (low, high) = (places[after - 1], places[after]);
        Fill { k, before: after - 1, after, part: (k as f64 - low) / (high - low) }
    };
    missing.iter().map(fill).collect()
}

fn details(series: &Series, stack: &Stack) -> Details {
    let or = |text: String, otherwise: &str| if text.is_empty() { otherwise.to_owned() } else { text };
    let number = or(series.number(), "not stated");
    let description = or(series.description(), "no description");
    let images = images_of(stack);
    let name = |uid: &str| shown(uids::name(uid).unwrap_or(uid));
    let names: BTreeSet<String> = images.iter().map(|image| name(&image.header.transfer_syntax)).collect();
    Details {
        series: format!("number {number}, {description}"),
        series_uid: series.uid.clone(),
        modality: series.modality(),
        files: images.len().to_string(),
        pixels: listed(&names.into_iter().collect::<Vec<_>>()),
    }
}
