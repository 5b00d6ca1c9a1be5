//! Which patient images name: the slices of one scan are of one patient.

use std::collections::BTreeMap;

use crate::error::{Error, Result};
use crate::image::Image;
use crate::keyword::Keyword;
use crate::value::Value;
use crate::wording::{counted, listed, quoted, shown};

/// Whom an image names; a text is empty where the image does not state it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Patient {
    id: String,
    issuer: String,
    name: String,
    birth: String,
}

impl Patient {
    /// The patient that an image names.
    pub fn of(image: &Image) -> Self {
        let stated = |keyword| unpadded(image.get(keyword));
        Self {
            id: stated(Keyword::PatientID),
            issuer: stated(Keyword::IssuerOfPatientID),
            name: plain_name(&stated(Keyword::PatientName)),
            birth: stated(Keyword::PatientBirthDate),
        }
    }

    /// Whether another image surely names another patient: by the ID and its issuer, or by name and birth date where an ID is
    /// missing.
    fn differs(&self, other: &Self) -> bool {
        if differ(&self.id, &other.id) {
            return true;
        }
        if !self.id.is_empty() && self.id == other.id {
            return differ(&self.issuer, &other.issuer);
        }
        differ(&self.name, &other.name) || differ(&self.birth, &other.birth)
    }

    /// The ID and its issuer as a message shows them.
    fn named(&self) -> String {
        if self.id.is_empty() {
            return "no PatientID".to_owned();
        }
        let issuer =
            if self.issuer.is_empty() { String::new() } else { format!(" of {}", told(&self.issuer)) };
        told(&self.id) + &issuer
    }
}

/// Refuses images that name several patients; messages name them by ID alone.
pub fn require_one_patient(images: &[Image]) -> Result<()> {
    let mut firsts: BTreeMap<Patient, &Image> = BTreeMap::new();
    for image in images {
        firsts.entry(Patient::of(image)).or_insert(image);
    }
    let patients: Vec<&Patient> = firsts.keys().collect();
    let pairs = patients.iter().flat_map(|one| patients.iter().map(move |other| (*one, *other)));
    let Some((one, other)) = pairs.into_iter().find(|(one, other)| one.differs(other)) else { return Ok(()) };
    let found = if one.named() == other.named() {
        let names = format!("{} and {}", firsts[one].name, firsts[other].name);
        format!("slices of several patients: PatientName or PatientBirthDate differs in {names}")
    } else {
        format!("slices of several patients: PatientID is {}", ids(images))
    };
    Err(Error::new(found, "one patient").mend("move the slices of each patient to a folder of their own"))
}

/// Which IDs images have, and how many have each.
fn ids(images: &[Image]) -> String {
    let mut counts: BTreeMap<String, (i64, &str)> = BTreeMap::new();
    for image in images {
        counts.entry(Patient::of(image).named()).or_insert((0, &image.name)).0 += 1;
    }
    let each = counts.iter();
    let each = each.map(|(id, (count, first))| format!("{id} in {} ({first})", counted(*count, "image")));
    listed(&each.collect::<Vec<_>>())
}

fn differ(one: &str, other: &str) -> bool {
    !one.is_empty() && !other.is_empty() && one != other
}

/// A text without the blanks around it, which mean nothing.
fn unpadded(value: &Value) -> String {
    match value {
        Value::Empty | Value::Odd => String::new(),
        stated => stated.to_string().trim_matches([' ', '\0']).to_owned(),
    }
}

/// The first way of writing a name, without padding, empty parts at its end and case.
fn plain_name(name: &str) -> String {
    let written = name.split('=').find(|group| !group.trim().is_empty()).unwrap_or_default();
    let parts: Vec<String> = written.split('^').map(|part| part.trim().to_uppercase()).collect();
    parts.join("^").trim_end_matches('^').to_owned()
}

fn told(text: &str) -> String {
    quoted(&shown(text))
}
