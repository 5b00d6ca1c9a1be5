//! The slices of an image: one slice, or one per frame of an enhanced multi-frame image.

use glam::DVec3;

use crate::directions::Directions;
use crate::error::{Error, Result};
use crate::grey::plane_size;
use crate::headers::Unlike;
use crate::image::Image;
use crate::keyword::Keyword;
use crate::value::Value;

pub(crate) type Pair<'a> = (Slice<'a>, Slice<'a>);

pub(crate) fn are_unlike((kept, other): &Pair, unlike: &[Unlike]) -> bool {
    let is = |slice: &Slice, frame: crate::headers::FrameOf| {
        slice.image.file == frame.file && slice.frame == frame.frame
    };
    unlike.iter().any(|pair| is(kept, pair.kept) && is(other, pair.other))
}

#[derive(Debug, Clone)]
pub(crate) struct Slice<'a> {
    pub image: &'a Image<'a>,
    pub frame: usize,
    pub size: [i64; 2],
    pub position: DVec3,
    pub directions: Directions,
    /// Distance between columns, then between rows (mm).
    pub spacing: [f64; 2],
    /// Slope and intercept that convert stored numbers to values.
    pub scaling: (f64, f64),
}

impl<'a> Slice<'a> {
    pub(crate) fn name(&self) -> String {
        self.image.frame_name(self.frame)
    }

    /// The direction along which slices are sorted.
    pub(crate) fn normal(&self) -> DVec3 {
        self.directions.normal()
    }

    pub(crate) fn get(&self, keyword: Keyword) -> &'a Value {
        self.image.of_frame(self.frame, keyword)
    }
}

/// The slices of an image; localisers are left out if there are other frames.
pub(crate) fn slices_of<'a>(image: &'a Image<'a>) -> Result<Vec<Slice<'a>>> {
    let frames = 0..usize::try_from(image.frame_count).unwrap_or_default();
    let mut wanted: Vec<usize> = frames.clone().filter(|&frame| !image.is_localizer(frame)).collect();
    if wanted.is_empty() {
        wanted = frames.collect();
    }
    let placed = wanted.into_iter().map(|frame| placed(image, frame));
    placed.collect::<Result<_>>().map_err(|error| error.of(image.file))
}

fn placed<'a>(image: &'a Image<'a>, frame: usize) -> Result<Slice<'a>> {
    let position = DVec3::from_array(numbers(image, frame, Keyword::ImagePositionPatient)?);
    let cosines = numbers::<6>(image, frame, Keyword::ImageOrientationPatient)?;
    let spacing = numbers::<2>(image, frame, Keyword::PixelSpacing)?;
    let directions = Directions::of(&cosines).ok_or_else(|| {
        Error::new(format!("ImageOrientationPatient {cosines:?}"), "two orthogonal unit vectors")
    })?;
    if !spacing.iter().all(|&distance| distance > 0.0) {
        return Err(Error::new(format!("PixelSpacing {spacing:?}"), "2 positive distances in mm"));
    }
    Ok(Slice {
        image,
        frame,
        size: plane_size(image).unwrap_or_default(),
        position,
        directions,
        // The header states the distance between rows first, but i runs along a row, between columns.
        spacing: [spacing[1], spacing[0]],
        scaling: scaling(image, frame)?,
    })
}

fn scaling(image: &Image, frame: usize) -> Result<(f64, f64)> {
    let slope = image.number(frame, Keyword::RescaleSlope)?.unwrap_or(1.0);
    let intercept = image.number(frame, Keyword::RescaleIntercept)?.unwrap_or(0.0);
    if !(slope.is_finite() && intercept.is_finite()) {
        let text = |number: f64| format!("{number:?}").replace("NaN", "nan");
        let found = format!("slope and intercept ({}, {})", text(slope), text(intercept));
        return Err(Error::new(found, "finite numbers"));
    }
    if slope == 0.0 {
        let error = Error::new("RescaleSlope 0, which makes all values equal", "a slope other than 0");
        return Err(error.mend("export the series again"));
    }
    Ok((slope, intercept))
}

fn numbers<const COUNT: usize>(image: &Image, frame: usize, keyword: Keyword) -> Result<[f64; COUNT]> {
    let stated = image.of_frame(frame, keyword);
    let read: Vec<Option<f64>> = stated.all().iter().map(Value::number).collect();
    let values: Option<Vec<f64>> =
        read.iter().map(|value| value.filter(|number| number.is_finite())).collect();
    // A damaged value may be the name of a patient, so it is not quoted.
    let odd =
        values.as_ref().map_or_else(|| "damaged values".to_owned(), |all| format!("{} numbers", all.len()));
    values.and_then(|all| all.try_into().ok()).ok_or_else(|| {
        let name = keyword.name();
        let found = if stated.is_empty() { format!("no {name}") } else { format!("{odd} in {name}") };
        Error::new(found, format!("{COUNT} finite numbers"))
    })
}
