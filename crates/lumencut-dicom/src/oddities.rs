//! Adds notes about unusual header values of a stack that can nevertheless be read.

use std::collections::BTreeSet;

use crate::geometry::Stack;
use crate::grey::photometric;
use crate::image::Image;
use crate::keyword::Keyword;
use crate::value::Value;
use crate::wording::{counted, listed, shown};

pub(crate) fn note_oddities(stack: &Stack, notes: &mut Vec<String>) {
    note_missing(stack, notes);
    note_rescaling(stack, notes);
    let images = images_of(stack);
    if images.iter().any(|image| is_high_bit_odd(image)) {
        notes.push("HighBit is not BitsStored - 1: the lowest BitsStored bits are read".to_owned());
    }
    if images.iter().any(|image| image.get(Keyword::LossyImageCompression).to_string() == "01") {
        notes.push("the images were compressed with loss".to_owned());
    }
    if images.iter().any(|image| photometric(image) == "MONOCHROME1") {
        notes.push("MONOCHROME1 (meant to be shown inverted): values are read as they are".to_owned());
    }
    note_padding(&images, notes);
}

pub(crate) fn images_of<'a>(stack: &Stack<'a>) -> Vec<&'a Image<'a>> {
    let mut seen = BTreeSet::new();
    stack.slices.iter().map(|one| one.image).filter(|image| seen.insert(image.file)).collect()
}

fn note_missing(stack: &Stack, notes: &mut Vec<String>) {
    let missing = stack.missing();
    if !missing.is_empty() && !stack.is_resampled {
        let names: Vec<String> = missing.iter().map(ToString::to_string).collect();
        let count = counted(missing.len() as i64, "missing slice");
        notes.push(format!("{count} interpolated: k = {}", listed(&names)));
    }
}

fn note_rescaling(stack: &Stack, notes: &mut Vec<String>) {
    let mut scalings: Vec<(f64, f64)> = stack.slices.iter().map(|one| one.scaling).collect();
    scalings.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    scalings.dedup();
    if scalings.len() > 1 {
        let count = scalings.len();
        notes.push(format!("{count} different rescale slopes and intercepts: applied slice by slice"));
    }
    if scalings.iter().any(|(slope, intercept)| slope.fract() != 0.0 || intercept.fract() != 0.0) {
        notes.push("rescaling makes fractions: read as float32".to_owned());
    }
}

fn is_high_bit_odd(image: &Image) -> bool {
    let stored = image.get(Keyword::BitsStored).integer().unwrap_or_default();
    let stated = image.header.attributes.get(Keyword::HighBit);
    stated.is_some_and(|high| high.integer() != Some(stored - 1))
}

fn note_padding(images: &[&Image], notes: &mut Vec<String>) {
    let stated = images.iter().filter_map(|image| image.header.attributes.get(Keyword::PixelPaddingValue));
    // A damaged value may be any text, so only numbers are quoted.
    let numbers = stated.filter(|value| matches!(value, Value::Integer(_) | Value::Number(_)));
    let values: BTreeSet<String> = numbers.map(|value| shown(&value.to_string())).collect();
    if !values.is_empty() {
        let values: Vec<String> = values.into_iter().collect();
        let values = listed(&values);
        notes.push(format!("stored value {values} marks pixels outside the scan: read as they are"));
    }
}
