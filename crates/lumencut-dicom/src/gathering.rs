//! Joins series of one slice each that together form one scan; some anonymisers split scans in this way.

use crate::error::Result;
use crate::geometry::{Mending, Stack, stacked};
use crate::grouping::groups;
use crate::image::Image;
use crate::keyword::Keyword;
use crate::patients::Patient;
use crate::series::{Series, grouped};

const FEWEST: usize = 3;
/// Attributes besides the grid that must be equal in all slices of such a scan.
const SHARED: [Keyword; 6] = [
    Keyword::StudyInstanceUID,
    Keyword::FrameOfReferenceUID,
    Keyword::Modality,
    Keyword::SeriesNumber,
    Keyword::Rows,
    Keyword::Columns,
];

pub(crate) fn gathered(every: Vec<Series>) -> Vec<Series> {
    let numbers: Vec<usize> = (0..every.len()).filter(|&n| is_single(&every[n])).collect();
    let parts = groups(numbers.iter().map(|&n| shared(&every[n].images[0])));
    let mut every: Vec<Option<Series>> = every.into_iter().map(Some).collect();
    let mut apart = Vec::new();
    for part in parts.into_iter().filter(|part| part.len() >= FEWEST) {
        let places: Vec<usize> = part.into_iter().map(|n| numbers[n]).collect();
        let own: Vec<Series> = places.iter().filter_map(|&n| every[n].take()).collect();
        let one = Series {
            uid: own[0].uid.clone(),
            part_count: own.len(),
            images: own.into_iter().flat_map(|series| series.images).collect(),
        };
        if is_scan(&one) {
            every[places[0]] = Some(one);
        } else {
            apart.push((places, one));
        }
    }
    for (places, one) in apart {
        for (n, series) in places.into_iter().zip(grouped(one.images)) {
            every[n] = Some(series);
        }
    }
    every.into_iter().flatten().collect()
}

fn shared(image: &Image) -> String {
    let texts = SHARED.map(|keyword| image.text(keyword));
    format!("{texts:?} {:?}", Patient::of(image))
}

pub(crate) fn note_parts(series: &Series, notes: &mut Vec<String>) {
    if series.part_count > 1 {
        notes.push(format!(
            "{} series of one slice each are read as one scan: they share study, patient, number and grid",
            series.part_count
        ));
    }
}

fn is_single(series: &Series) -> bool {
    let first = &series.images[0];
    let uid = first.get(Keyword::SOPInstanceUID);
    let is_same = |image: &Image| !uid.is_empty() && image.get(Keyword::SOPInstanceUID) == uid;
    first.frame_count == 1 && !first.is_localizer(0) && series.images[1..].iter().all(is_same)
}

fn is_scan(series: &Series) -> bool {
    let stack = || -> Result<Stack> {
        let placed = series.slices(&[], &mut Vec::new())?;
        stacked(placed.slices, Mending::default(), &[], &mut Vec::new())
    };
    match stack() {
        Ok(stack) => stack.slices.len() >= FEWEST,
        Err(error) => error.mended_by.is_some() && place_count(series) >= FEWEST,
    }
}

fn place_count(series: &Series) -> usize {
    groups(series.images.iter().map(|image| image.get(Keyword::ImagePositionPatient).to_string())).len()
}
