//! Rejects images that are not readable slices of grey values.

use crate::error::{Error, Result};
use crate::image::Image;
use crate::keyword::Keyword;
use crate::uids;
use crate::value::Value;

/// Colour types that errors may name. Other texts are not shown, because they may contain anything.
const COLOURS: [&str; 12] = [
    "PALETTE COLOR",
    "RGB",
    "HSV",
    "ARGB",
    "CMYK",
    "XYB",
    "YBR_FULL",
    "YBR_FULL_422",
    "YBR_PARTIAL_422",
    "YBR_PARTIAL_420",
    "YBR_ICT",
    "YBR_RCT",
];

pub(crate) fn require_grey(image: &Image) -> Result<()> {
    let refused = require_size(image)
        .and_then(|()| require_one_number(image))
        .and_then(|()| require_rescaling(image))
        .and_then(|()| require_decoder(image))
        .and_then(|()| require_bits(image))
        .and_then(|()| require_groups(image));
    refused.map_err(|error| error.of(image.file))
}

pub(crate) fn photometric(image: &Image) -> String {
    match image.get(Keyword::PhotometricInterpretation) {
        Value::Empty => String::new(),
        stated => stated.to_string(),
    }
}

pub(crate) fn plane_size(image: &Image) -> Option<[i64; 2]> {
    let length = |keyword| image.get(keyword).integer();
    Some([length(Keyword::Columns)?, length(Keyword::Rows)?])
}

fn require_size(image: &Image) -> Result<()> {
    let numbers = plane_size(image).map(|_| ());
    numbers.ok_or_else(|| Error::new("Rows and Columns that are not numbers", "one number each"))
}

fn require_one_number(image: &Image) -> Result<()> {
    let photometric = photometric(image);
    if image.samples == 1 && photometric.starts_with("MONOCHROME") {
        return Ok(());
    }
    let kind = if photometric.contains("PALETTE") { "a palette" } else { "a colour" };
    let named = match photometric.as_str() {
        "" => "not stated",
        known if COLOURS.contains(&known) => known,
        _ => "unknown",
    };
    let found = format!("{kind} image (PhotometricInterpretation {named})");
    Err(Error::new(found, "MONOCHROME2"))
}

fn require_rescaling(image: &Image) -> Result<()> {
    if image.get(Keyword::ModalityLUTSequence).is_nothing() {
        return Ok(());
    }
    Err(Error::new("a modality look-up table", "RescaleSlope and RescaleIntercept"))
}

fn require_decoder(image: &Image) -> Result<()> {
    if image.is_decodable {
        return Ok(());
    }
    let named = uids::name(&image.header.transfer_syntax).unwrap_or("an unknown transfer syntax");
    let expected = "uncompressed, RLE, JPEG, JPEG-LS, JPEG 2000 or HTJ2K pixels";
    let mend = "convert it to one of these, lossless if possible";
    Err(Error::new(format!("pixels in {named}"), expected).mend(mend))
}

fn require_bits(image: &Image) -> Result<()> {
    let allocated = image.count(Keyword::BitsAllocated)?;
    let stated = |bits: Option<i64>| bits.map_or_else(|| "not stated".to_owned(), |count| count.to_string());
    let Some(most) = allocated.filter(|bits| [8, 16, 32, 64].contains(bits)) else {
        return Err(Error::new(format!("BitsAllocated {}", stated(allocated)), "8, 16, 32 or 64"));
    };
    if image.header.pixels != "PixelData" {
        return Ok(());
    }
    let stored = image.count(Keyword::BitsStored)?;
    if !stored.is_some_and(|bits| (1..=most).contains(&bits)) {
        return Err(Error::new(format!("BitsStored {}", stated(stored)), format!("1 to {most}")));
    }
    if !matches!(image.get(Keyword::PixelRepresentation).integer(), Some(0 | 1)) {
        let found = "PixelRepresentation not stated";
        return Err(Error::new(found, "PixelRepresentation 0 or 1"));
    }
    Ok(())
}

/// Rejects several frames if they are not described individually.
fn require_groups(image: &Image) -> Result<()> {
    let (count, described) = (image.frame_count, image.header.frames.len());
    if count < 1 || (count > 1 && described == 0) {
        let found = format!("a multi-frame image of {count} frames without a position for each");
        let mend = "convert it to single-frame or enhanced DICOM, NIfTI or NRRD";
        return Err(Error::new(found, "one slice per file, or functional groups").mend(mend));
    }
    if described > 0 && i64::try_from(described) != Ok(count) {
        let found = format!("{count} frames and functional groups for {described}");
        return Err(Error::new(found, "one group for each frame").mend("copy the file again"));
    }
    Ok(())
}
