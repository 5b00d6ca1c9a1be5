//! The plan for reading the pixels of a volume.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::geometry::Stack;
use crate::keyword::Keyword;
use crate::oddities::images_of;
use crate::patients::PatientId;
use crate::scan::Scan;
use crate::series::Series;
use crate::slices::{Pair, Slice};
use crate::uids;
use crate::wording::{listed, shown};

/// How to read the volume of a series.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// Number of voxels along i, j, k.
    pub size: [i64; 3],
    /// Affine from voxel indices to patient space (mm, LPS), row by row, including shear.
    pub world_from_index: [[f64; 4]; 4],
    /// NumPy type of the stored numbers, such as `i2` or `f4`.
    pub stored_type: String,
    /// Slices to read, in order.
    pub slices: Vec<PlannedSlice>,
    /// Whether slices are resampled; only then may their indices not be integers.
    pub is_resampled: bool,
    /// Indices k that have no slice.
    pub missing: Vec<i64>,
    /// How each missing slice is interpolated.
    pub fills: Vec<Fill>,
    /// Pairs of frames that the plan treats as equal. If their values differ, the caller plans again with
    /// these pairs as [`Headers::unlike`](crate::Headers::unlike).
    pub compared: Vec<Compared>,
    /// Notes for the user, one sentence each.
    pub notes: Vec<String>,
    /// Details of the series.
    pub details: Details,
    /// How the scan was made.
    pub scan: Scan,
    /// The patient of the series.
    pub patient: PatientId,
}

/// A slice that is read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlannedSlice {
    /// Number of the file.
    pub file: usize,
    /// Number of the frame, from 0.
    pub frame: usize,
    /// Index k of the slice.
    pub place: f64,
    /// Factor that converts stored numbers to values.
    pub slope: f64,
    /// Offset that is added after the multiplication.
    pub intercept: f64,
}

/// A slice that is read, and one that is skipped if its values are equal.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compared {
    /// The slice that is read.
    pub kept: PlannedSlice,
    /// The slice that is skipped.
    pub other: PlannedSlice,
}

/// A missing slice, interpolated as (1 - part) × before + part × after.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fill {
    /// Index k of the missing slice.
    pub k: i64,
    /// Number of the slice before it, in [`Plan::slices`].
    pub before: usize,
    /// Number of the slice after it, in [`Plan::slices`].
    pub after: usize,
    /// Position between these two slices, from 0 to 1.
    pub part: f64,
}

/// Details of a series that do not identify the patient.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Details {
    /// Number and description of the series.
    pub series: String,
    /// UID of the series.
    pub series_uid: String,
    /// Modality of the series.
    pub modality: String,
    /// Number of files that are read.
    pub files: String,
    /// Transfer syntaxes of the files.
    pub pixels: String,
}

impl Plan {
    pub(crate) fn new(series: &Series, stack: &Stack, copies: &[Pair], notes: Vec<String>) -> Self {
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
            patient: PatientId::of(stack.slices[0].image),
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
