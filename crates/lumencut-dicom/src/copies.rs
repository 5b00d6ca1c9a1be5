//! Detects copies of an image. The caller compares their pixel values.

use crate::error::{Error, Result};
use crate::grouping::groups;
use crate::headers::{Attributes, Unlike};
use crate::image::Image;
use crate::keyword::Keyword;
use crate::slices::{Pair, are_unlike, slices_of};
use crate::value::Value;
use crate::wording::{counted, listed};

const OF_THE_PATIENT: [Keyword; 4] =
    [Keyword::PatientID, Keyword::IssuerOfPatientID, Keyword::PatientName, Keyword::PatientBirthDate];

type Copy<'i, 'a> = (&'i Image<'a>, &'i Image<'a>);

pub(crate) fn without_copies<'i, 'a>(images: &[&'i Image<'a>]) -> (Vec<&'i Image<'a>>, Vec<Copy<'i, 'a>>) {
    let identifier = |(number, image): (usize, &&Image)| match image.get(Keyword::SOPInstanceUID) {
        uid if uid.is_empty() => format!("without, {number}"),
        uid => uid.to_string(),
    };
    let (mut kept, mut copies) = (Vec::new(), Vec::new());
    for group in groups(images.iter().enumerate().map(identifier)) {
        let first = images[group[0]];
        kept.push(first);
        copies.extend(group[1..].iter().map(|&number| (first, images[number])));
    }
    (kept, copies)
}

/// Pairs of slices that the caller must compare. Rejects copies whose attributes or values differ.
pub(crate) fn compared<'i>(
    copies: &[Copy<'i, 'i>],
    unlike: &[Unlike],
    notes: &mut Vec<String>,
) -> Result<Vec<Pair<'i>>> {
    let mut pairs = Vec::new();
    for (kept, copy) in copies {
        if let Some(keyword) = differing(kept, copy) {
            return Err(no_copy(kept, copy, keyword.name()));
        }
        let before = pairs.len();
        pairs.extend(slices_of(kept)?.into_iter().zip(slices_of(copy)?));
        if pairs[before..].iter().any(|pair| are_unlike(pair, unlike)) {
            return Err(no_copy(kept, copy, "values"));
        }
    }
    if !copies.is_empty() {
        let names: Vec<&str> = copies.iter().map(|(_, copy)| copy.name.as_str()).collect();
        let count = counted(copies.len() as i64, "file");
        notes.push(format!(
            "left out, {count} with the SOPInstanceUID and values of another: {}",
            listed(&names)
        ));
    }
    Ok(pairs)
}

fn no_copy(kept: &Image, copy: &Image, what: &str) -> Error {
    let found = format!("the SOPInstanceUID of {}, but different {what}", kept.name);
    let error = Error::new(found, "a unique identifier for each image").of(copy.file);
    error.mend("remove the wrong one of the two, or export the series again")
}

fn differing(one: &Image, other: &Image) -> Option<Keyword> {
    let (a, b) = (one.header, other.header);
    let frames = a.frames.iter().zip(&b.frames);
    let levels =
        std::iter::once((&a.attributes, &b.attributes)).chain([(&a.shared, &b.shared)]).chain(frames);
    let counted = Some(Keyword::NumberOfFrames).filter(|_| a.frames.len() != b.frames.len());
    counted.or_else(|| levels.into_iter().find_map(|(a, b)| differs(a, b)))
}

fn differs(one: &Attributes, other: &Attributes) -> Option<Keyword> {
    let values =
        |of: &Attributes, keyword| of.get(keyword).map(|value| value.all().to_vec()).unwrap_or_default();
    let is_same = |keyword| {
        let (a, b) = (values(one, keyword), values(other, keyword));
        a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| is_equal(a, b))
    };
    let of_image = Keyword::ALL.iter().copied().filter(|keyword| !OF_THE_PATIENT.contains(keyword));
    of_image.into_iter().find(|&keyword| !is_same(keyword))
}

/// Whether two values are equal; a number may be written in several ways.
fn is_equal(one: &Value, other: &Value) -> bool {
    one == other || one.number().is_some_and(|number| other.number() == Some(number))
}
