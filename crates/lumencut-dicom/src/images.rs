//! Selects the images from the files.

use crate::error::{Error, Result};
use crate::headers::{Header, Headers};
use crate::image::{Image, kind};
use crate::keyword::Keyword;
use crate::wording::{listed, printable};

/// Name of the SOP class of a disc directory.
const DIRECTORY: &str = "Media Storage Directory";
/// Names of SOP classes with contours but no voxels.
const SHAPES: [&str; 2] = ["RT Structure Set Storage", "Surface Segmentation Storage"];

pub(crate) fn images<'a>(headers: &'a Headers, notes: &mut Vec<String>) -> Result<Vec<Image<'a>>> {
    let (mut images, mut foreign) = (Vec::new(), Vec::new());
    for (number, file) in headers.files.iter().enumerate() {
        match &file.header {
            Some(header) if has_size(header) => {
                let is_decodable = headers.transfer_syntaxes.contains(&header.transfer_syntax);
                images.push(Image::new(number, file, header, is_decodable)?);
            }
            Some(_) if kind(file).ends_with("Image Storage") => {
                let error = Error::new("an image without rows and columns", "a whole file");
                return Err(error.of(number).mend("copy the file again"));
            }
            _ => foreign.push(format!("{} ({})", printable(&file.name), printable(kind(file)))),
        }
    }
    if images.is_empty() {
        return Err(no_image(&foreign));
    }
    if !foreign.is_empty() {
        notes.push(format!("left out, no images: {}", listed(&foreign)));
    }
    Ok(images)
}

fn has_size(header: &Header) -> bool {
    let states = |keyword| header.attributes.get(keyword).is_some_and(|value| !value.is_nothing());
    states(Keyword::Rows) && states(Keyword::Columns)
}

fn no_image(foreign: &[String]) -> Error {
    let Some(first) = foreign.first() else {
        return Error::new("nothing in it", "DICOM images");
    };
    let error = Error::new(format!("no image: {}", listed(foreign)), "DICOM images");
    if first.contains(DIRECTORY) {
        return error.mend("give the folder that it is in");
    }
    if SHAPES.iter().any(|shapes| foreign.iter().any(|name| name.contains(shapes))) {
        return error.mend(
            "convert its contours to a DICOM segmentation (SEG) or a label map, as the module Segmentations of 3D \
             Slicer does",
        );
    }
    error
}
