//! Rejects slices that belong to several patients.

use crate::error::{Error, Result};
use crate::grouping::groups;
use crate::image::Image;
use crate::keyword::Keyword;
use crate::value::Value;
use crate::wording::{counted, listed, printable, quoted, shown};
use serde::Serialize;

/// The patient of a series, by which two scans are compared; empty where none is stated. It is never shown as part of a volume.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PatientId {
    /// PatientID.
    pub id: String,
    /// IssuerOfPatientID.
    pub issuer: String,
}

impl PatientId {
    pub(crate) fn of(image: &Image) -> Self {
        let Patient { id, issuer, .. } = Patient::of(image);
        Self { id: printable(&id), issuer: printable(&issuer) }
    }
}

#[derive(Debug)]
pub(crate) struct Patient {
    id: String,
    issuer: String,
    name: String,
    birth: String,
}

impl Patient {
    pub(crate) fn of(image: &Image) -> Self {
        let stated = |keyword| unpadded(image.get(keyword));
        Self {
            id: stated(Keyword::PatientID),
            issuer: stated(Keyword::IssuerOfPatientID),
            name: plain_name(&stated(Keyword::PatientName)),
            birth: stated(Keyword::PatientBirthDate),
        }
    }

    /// Whether two images certainly name different patients: by ID and issuer, or without an ID by name and
    /// birth date.
    fn differs(&self, other: &Self) -> bool {
        if differ(&self.id, &other.id) {
            return true;
        }
        if !self.id.is_empty() && self.id == other.id {
            return differ(&self.issuer, &other.issuer);
        }
        differ(&self.name, &other.name) || differ(&self.birth, &other.birth)
    }

    fn named(&self) -> String {
        if self.id.is_empty() {
            return "no PatientID".to_owned();
        }
        let issuer =
            if self.issuer.is_empty() { String::new() } else { format!(" of {}", as_shown(&self.issuer)) };
        as_shown(&self.id) + &issuer
    }
}

/// Rejects images of several patients. The error names patients only by ID.
pub(crate) fn require_one_patient(images: &[Image]) -> Result<()> {
    let every: Vec<Patient> = images.iter().map(Patient::of).collect();
    let firsts: Vec<usize> =
        groups(every.iter().map(|one| format!("{one:?}"))).iter().map(|group| group[0]).collect();
    let pairs = firsts.iter().flat_map(|&a| firsts.iter().map(move |&b| (a, b)));
    let Some((a, b)) = pairs.into_iter().find(|&(a, b)| every[a].differs(&every[b])) else { return Ok(()) };
    let found = if every[a].named() == every[b].named() {
        let names = format!("{} and {}", images[a].name, images[b].name);
        format!("slices of several patients: PatientName or PatientBirthDate differs in {names}")
    } else {
        format!("slices of several patients: PatientID is {}", ids(images, &every))
    };
    Err(Error::new(found, "one patient").mend("move the slices of each patient to a separate folder"))
}

fn ids(images: &[Image], every: &[Patient]) -> String {
    let each = groups(every.iter().map(Patient::named)).into_iter().map(|group| {
        let count = counted(group.len() as i64, "image");
        format!("{} in {count} ({})", every[group[0]].named(), images[group[0]].name)
    });
    listed(&each.collect::<Vec<_>>())
}

fn differ(one: &str, other: &str) -> bool {
    !one.is_empty() && !other.is_empty() && one != other
}

/// The text without surrounding blanks, which have no meaning.
fn unpadded(value: &Value) -> String {
    match value {
        Value::Empty | Value::Odd => String::new(),
        stated => stated.to_string().trim_matches([' ', '\0']).to_owned(),
    }
}

/// The first spelling of a name in capitals, without blanks around its parts and empty parts at its end.
fn plain_name(name: &str) -> String {
    let written = name.split('=').find(|group| !group.trim().is_empty()).unwrap_or_default();
    let parts: Vec<String> = written.split('^').map(|part| part.trim().to_uppercase()).collect();
    parts.join("^").trim_end_matches('^').to_owned()
}

fn as_shown(text: &str) -> String {
    quoted(&shown(text))
}
