use super::*;
use crate::profile_json::profile_json;
use crate::profile_marks::marks;
use crate::profile_table::profile_csv;
use crate::scan_details::ScanDetails;
use crate::tube::tube;
use lumencut_vessels::measure::section::flags::{CALCIUM, IRREGULAR, METAL, NEIGHBOR, NO_EDGE};

#[test]
fn where_places_are_suggested_or_marked_there_is_no_reason() {
    let tube = tube();
    assert_eq!(not_suggested(&tube, None, &[]), Vec::<String>::new());
    assert_eq!(not_suggested(&tube, Some(30.0), &[45.0]), Vec::<String>::new());
}

#[test]
fn where_nothing_is_safe_the_hindrances_are_told() {
    let mut stent = tube();
    stent.flags.fill(METAL);
    stent.flags[7] = CALCIUM;
    stent.uncertainty[9] = 20.0;
    let [reason] = &not_suggested(&stent, None, &[])[..] else { panic!("one reason") };
    // The flag of the branch is missing, since all flags were overwritten.
    assert_eq!(
        reason,
        "No narrowest place is suggested: each of the 121 sections that count has a doubt (metal, calcium, unsure diameter). Mark it yourself."
    );
    // A marked place then has no reference either.
    let [reason] = &not_suggested(&stent, Some(30.0), &[])[..] else { panic!("one reason") };
    assert!(reason.starts_with("No reference is suggested for 30.0 mm: no place within 50 mm"), "{reason}");
}

#[test]
fn a_narrower_place_that_is_not_suggested_is_told_with_the_reason() {
    let mut vessel = tube();
    let suggested = vessel.narrowest().expect("a place");
    let far = vessel.nearest_section(if suggested.at < 30.0 { 45.0 } else { 15.0 });
    for n in far - 1..=far + 1 {
        (vessel.area[n], vessel.flags[n]) = (std::f64::consts::PI, CALCIUM);
    }
    let at = vessel.arc_length[far];
    let reasons = not_suggested(&vessel, None, &[]);
    assert!(reasons[0].starts_with("Narrower, but not suggested: 2.00 mm at "), "{reasons:?}");
    assert!(reasons[0].ends_with("(calcium). Check it."), "{reasons:?}");
    let found = vessel.passed_over().expect("a place").0.at;
    assert!((found - at).abs() <= 0.5, "{found}");
    // A mark on a wider place, such as a confirmed suggestion, does not silence it; a mark at the place itself does.
    assert_eq!(not_suggested(&vessel, Some(suggested.at), &[45.0]), reasons[..1]);
    assert_eq!(narrower(&vessel, Some(at)), None);
    let marked = vessel.nearest_section(suggested.at);
    vessel.area[marked] = 3.0;
    assert_eq!(narrower(&vessel, Some(suggested.at)), None, "the marked place is narrower");
}

#[test]
fn where_no_section_counts_the_reasons_are_those_of_all_sections() {
    let mut vessel = tube();
    vessel.flags.fill(NO_EDGE);
    vessel.flags[..5].fill(NO_EDGE | METAL);
    let [reason] = &not_suggested(&vessel, None, &[])[..] else { panic!("one reason") };
    assert!(reason.contains("no section counts (no clear wall, metal)"), "{reason}");
    // Sections that do not count give no reasons where others count.
    vessel.flags[..5].fill(METAL);
    let [reason] = &not_suggested(&vessel, None, &[])[..] else { panic!("one reason") };
    assert!(reason.contains("each of the 5 sections that count has a doubt (metal)"), "{reason}");
}

#[test]
fn of_many_reasons_those_of_the_most_sections_are_told() {
    let mut stent = tube();
    stent.flags.fill(METAL);
    stent.flags[..60].fill(METAL | CALCIUM);
    stent.uncertainty[..20].fill(20.0);
    stent.flags[0] |= NEIGHBOR | IRREGULAR;
    let [reason] = &not_suggested(&stent, None, &[])[..] else { panic!("one reason") };
    assert!(reason.contains("(metal, calcium, unsure diameter)"), "{reason}");
}

#[test]
fn a_vessel_that_only_gets_thinner_says_so() {
    let mut taper = tube();
    for (n, area) in taper.area.iter_mut().enumerate() {
        *area = (12.0 - 0.05 * n as f64).powi(2);
    }
    taper.flags.fill(0);
    let [reason] = &not_suggested(&taper, None, &[])[..] else { panic!("one reason") };
    assert!(reason.contains("only tapers, to 6.80 mm at 60.0 mm"), "{reason}");
    // A narrower place with a doubt is named: the sure sections are not the whole vessel.
    for n in 80..90 {
        (taper.area[n], taper.flags[n]) = (std::f64::consts::PI, CALCIUM);
    }
    let [narrower, _] = &not_suggested(&taper, None, &[])[..] else { panic!("two reasons") };
    assert!(narrower.starts_with("Narrower, but not suggested: 2.00 mm at 4"), "{narrower}");
}

#[test]
fn a_throat_is_offered_in_words_json_and_table() {
    let mut vessel = tube();
    let n = vessel.nearest_section(30.0);
    (vessel.area[n], vessel.at_most[n], vessel.flags[n]) = (f64::NAN, 0.7, NO_EDGE);
    let [reason] = &not_suggested(&vessel, None, &[])[..] else { panic!("one reason") };
    assert_eq!(
        reason,
        "Narrowest place: no clear wall at 30.0 mm, where the lumen is at most 0.70 mm wide. Check the sections there."
    );
    let [first, ..] = &marks(&vessel, None, &[]).expect("marks")[..] else { panic!("a mark") };
    assert_eq!((first.name, first.at, first.is_suggestion), ("narrowest place", 30.0, true));
    assert_eq!(first.words, "no clear wall, at most 0.70 mm");
    assert!(first.diameter.is_nan());
    let json = profile_json(&vessel, &ScanDetails::default());
    let words: String = json.split_whitespace().collect();
    assert!(words.contains(r#""narrowest":null,"throat":{"arc_length_mm":30.0,"at_most_mm":0.7}"#), "{json}");
    let csv = profile_csv(&vessel, &ScanDetails::default());
    assert!(csv.starts_with("arc_length_mm,") && csv.contains("diameter_at_most_mm"));
    // A mark elsewhere does not hide its missing references, and the throat is not told again.
    assert!(not_suggested(&vessel, Some(15.0), &[40.0]).is_empty());
}
