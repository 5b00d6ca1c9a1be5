use super::*;

fn stated() -> ScanDetails {
    ScanDetails {
        series_number: Some("3".to_owned()),
        series_description: Some("CTA 0.75".to_owned()),
        phase: Some("70 % of the cardiac cycle".to_owned()),
        slice_thickness_mm: Some(0.75),
        kernel: Some("Bv40f, 3".to_owned()),
    }
}

#[test]
fn words_tell_what_is_stated_and_what_is_not() {
    let all = "series 3, CTA 0.75; phase 70 % of the cardiac cycle; slice thickness 0.75 mm; kernel Bv40f, 3";
    assert_eq!(stated().words(), all);
    let part = ScanDetails { series_number: None, phase: None, kernel: None, ..stated() };
    assert_eq!(part.words(), "series CTA 0.75; slice thickness 0.75 mm; phase, kernel not stated");
    assert_eq!(ScanDetails::default().words(), "series, phase, slice thickness, kernel not stated");
}

#[test]
fn columns_say_what_is_not_stated() {
    let values = |scan: &ScanDetails| scan.columns().map(|(_, value)| value);
    assert_eq!(values(&stated()), ["3", "CTA 0.75", "70 % of the cardiac cycle", "0.75", "Bv40f, 3"]);
    let none = values(&ScanDetails::default());
    assert_eq!(none, ["not stated", "not stated", "not stated", "", "not stated"]);
}
