//! Whether two scans can be compared: their patients and modalities.

use lumencut_core::error::{Error, ErrorKind, Mend, Result};
use serde::Deserialize;

/// What the header of a scan states about patient and modality; empty where it states nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(default)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ScanIdentity {
    /// PatientID without padding.
    pub patient: String,
    /// IssuerOfPatientID without padding.
    pub issuer: String,
    /// Modality.
    pub modality: String,
}

impl ScanIdentity {
    /// The patient by ID and issuer, never by name.
    fn named(&self) -> String {
        match (self.patient.as_str(), self.issuer.as_str()) {
            ("", _) => "no PatientID".to_owned(),
            (id, "") => format!("PatientID '{id}'"),
            (id, issuer) => format!("PatientID '{id}' of '{issuer}'"),
        }
    }

    fn is_comparable(&self, other: &Self) -> bool {
        !self.patient.is_empty() && !other.patient.is_empty()
    }

    /// Issuers count if both are stated, because two hospitals can give the same ID to two patients.
    fn differs(&self, other: &Self) -> bool {
        let has_issuers = !self.issuer.is_empty() && !other.issuer.is_empty();
        self.patient != other.patient || (has_issuers && self.issuer != other.issuer)
    }
}

/// The doubts about comparing an earlier and a later scan, one sentence each, which give the IDs of two patients if `is_named`. Fails
/// with [`ErrorKind::Measuring`] for scans of two patients, unless the caller accepts another patient.
pub fn doubts(
    [earlier, later]: &[ScanIdentity; 2],
    is_other_accepted: bool,
    is_named: bool,
) -> Result<Vec<String>> {
    let mut doubts = Vec::new();
    if !earlier.is_comparable(later) {
        doubts.push("at least one scan does not state its patient".to_owned());
    } else if earlier.differs(later) {
        let both = format!("{} and {}", earlier.named(), later.named());
        if !is_other_accepted {
            let error = Error::new(ErrorKind::Measuring, "scans to compare", both, "scans of one patient");
            return Err(error.mend("choose two scans of one patient").mended_by(Mend::OtherPatient));
        }
        let which = if is_named { format!(": {both}") } else { String::new() };
        doubts.push(format!("the scans are of two patients{which}"));
    }
    let (one, other) = (&earlier.modality, &later.modality);
    if !one.is_empty() && !other.is_empty() && one != other {
        doubts.push(format!(
            "the earlier scan is {one}, the later one {other}: a difference may come from the method"
        ));
    }
    Ok(doubts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scan(patient: &str, issuer: &str, modality: &str) -> ScanIdentity {
        let [patient, issuer, modality] = [patient, issuer, modality].map(str::to_owned);
        ScanIdentity { patient, issuer, modality }
    }

    #[test]
    fn scans_of_two_patients_are_refused_or_doubted_with_both_names() {
        let scans = [scan("A1", "", "CT"), scan("B2", "Ward", "CT")];
        let error = doubts(&scans, false, true).expect_err("two patients");
        assert_eq!(error.found, "PatientID 'A1' and PatientID 'B2' of 'Ward'");
        assert_eq!(error.mended_by, Some(Mend::OtherPatient));
        let accepted = |is_named| doubts(&scans, true, is_named).expect("accepted");
        assert_eq!(
            accepted(true),
            ["the scans are of two patients: PatientID 'A1' and PatientID 'B2' of 'Ward'"]
        );
        assert_eq!(accepted(false), ["the scans are of two patients"]);
    }

    #[test]
    fn issuers_count_only_if_both_are_stated() {
        let of = |issuer: &str| scan("A1", issuer, "CT");
        assert!(doubts(&[of("X"), of("Y")], false, true).is_err());
        assert_eq!(doubts(&[of("X"), of("")], false, true).expect("one patient"), Vec::<String>::new());
    }

    #[test]
    fn unknown_patients_and_two_modalities_are_doubts() {
        let found = doubts(&[scan("", "", "CT"), scan("A1", "", "MR")], false, true).expect("doubts");
        assert_eq!(found[0], "at least one scan does not state its patient");
        assert!(found[1].starts_with("the earlier scan is CT, the later one MR"), "{found:?}");
        assert_eq!(doubts(&Default::default(), false, true).expect("doubts").len(), 1);
    }
}
