//! The images of one series, and the slices in them.

use crate::copies::{compared, without_copies};
use crate::error::{Error, Result};
use crate::grey::require_grey;
use crate::grouping::groups;
use crate::headers::Unlike;
use crate::image::Image;
use crate::keyword::Keyword;
use crate::patients::require_one_patient;
use crate::slices::{Pair, Slice, slices_of};
use crate::wording::{counted, listed};

#[derive(Debug)]
pub(crate) struct Series<'a> {
    /// UID of the series; may be empty.
    pub uid: String,
    /// Number of one-slice series that were joined to this one; 1 for ordinary series.
    pub part_count: usize,
    /// Images; at least one.
    pub images: Vec<Image<'a>>,
}

#[derive(Debug)]
pub(crate) struct Placed<'a> {
    pub slices: Vec<Slice<'a>>,
    /// Pairs of slices: one that is read, and its copy.
    pub copies: Vec<Pair<'a>>,
}

impl Series<'_> {
    pub(crate) fn number(&self) -> String {
        plain(&self.text(Keyword::SeriesNumber))
    }

    pub(crate) fn has_uid(&self, uid: &str) -> bool {
        self.uid == uid || self.images.iter().any(|image| image.text(Keyword::SeriesInstanceUID) == uid)
    }

    pub(crate) fn description(&self) -> String {
        self.text(Keyword::SeriesDescription)
    }

    pub(crate) fn modality(&self) -> String {
        self.text(Keyword::Modality)
    }

    pub(crate) fn image_count(&self) -> i64 {
        self.images.iter().fold(0, |sum, image| sum.saturating_add(image.frame_count))
    }

    /// All slices without copies; localisers are left out if there are other slices.
    pub(crate) fn slices(&self, unlike: &[Unlike], notes: &mut Vec<String>) -> Result<Placed<'_>> {
        require_one_patient(&self.images)?;
        let is_scout = |image: &&Image| image.frame_count == 1 && image.is_localizer(0);
        let (scouts, mut images): (Vec<&Image>, Vec<&Image>) = self.images.iter().partition(is_scout);
        if images.is_empty() {
            images = scouts;
        } else if !scouts.is_empty() {
            let names: Vec<&str> = scouts.iter().map(|image| image.name.as_str()).collect();
            notes.push(format!("left out, localisers: {}", listed(&names)));
        }
        images.iter().try_for_each(|image| require_grey(image))?;
        require_positions(&images)?;
        let (kept, copies) = without_copies(&images);
        let slices: Result<Vec<Vec<Slice>>> = kept.into_iter().map(slices_of).collect();
        let copies = compared(&copies, unlike, notes)?;
        Ok(Placed { slices: slices?.into_iter().flatten().collect(), copies })
    }

    fn text(&self, keyword: Keyword) -> String {
        self.images.first().map(|image| image.text(keyword)).unwrap_or_default()
    }
}

pub(crate) fn grouped(images: Vec<Image>) -> Vec<Series> {
    let groups = groups(images.iter().map(|image| image.text(Keyword::SeriesInstanceUID)));
    let mut images: Vec<Option<Image>> = images.into_iter().map(Some).collect();
    let series = groups.into_iter().map(|numbers| {
        let images: Vec<Image> = numbers.into_iter().filter_map(|number| images[number].take()).collect();
        Series { uid: images[0].text(Keyword::SeriesInstanceUID), part_count: 1, images }
    });
    series.collect()
}

/// A number without leading zeros and plus sign; other texts stay unchanged.
pub(crate) fn plain(number: &str) -> String {
    let digits = number.strip_prefix(['+', '-']).unwrap_or(number);
    if digits.is_empty() || digits.len() > 64 || !digits.bytes().all(|digit| digit.is_ascii_digit()) {
        return number.to_owned();
    }
    match digits.trim_start_matches('0') {
        "" => "0".to_owned(),
        value if number.starts_with('-') => format!("-{value}"),
        value => value.to_owned(),
    }
}

fn require_positions(images: &[&Image]) -> Result<()> {
    let mut missing = Vec::new();
    for image in images {
        let frames = 0..usize::try_from(image.frame_count).unwrap_or_default();
        missing
            .extend(frames.filter(|&frame| !image.has_position(frame)).map(|frame| image.frame_name(frame)));
    }
    if missing.is_empty() {
        return Ok(());
    }
    let total = images.iter().map(|image| image.frame_count).sum();
    let without = format!("{} of {}", missing.len(), counted(total, "image"));
    let error = Error::new(
        format!("no ImagePositionPatient in {without}: {}", listed(&missing)),
        "a position for each slice",
    );
    Err(error.mend("leave those images out"))
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn numbers_of_series_are_numbers() {
        for (stated, number) in
            [("0003", "3"), ("+5", "5"), ("-07", "-7"), ("-0", "0"), ("", ""), ("1.2", "1.2"), ("x", "x")]
        {
            assert_eq!(plain(stated), number);
        }
    }
}
