use super::*;
use crate::tube::tube;

/// The marks as `name at`, with a question mark after suggestions.
fn described(at: Option<f64>, references: &[f64]) -> Vec<String> {
    let found = marks(&tube(), at, references).expect("places on it");
    let word = |mark: &Mark| {
        let offered = if mark.is_suggestion { "?" } else { "" };
        format!("{} {}{offered}", mark.name, mark.at)
    };
    found.iter().map(word).collect()
}

#[test]
fn where_nothing_is_marked_all_places_are_offered() {
    assert_eq!(described(None, &[]), ["narrowest place 26.5?", "reference 18?", "reference 36?"]);
}

#[test]
fn beside_one_reference_another_one_is_offered_on_the_other_side() {
    assert_eq!(described(Some(30.0), &[40.0]), ["marked place 30", "reference 22?", "reference 40"]);
    assert_eq!(described(Some(30.0), &[12.0]), ["marked place 30", "reference 12", "reference 38?"]);
    assert_eq!(described(None, &[45.0]), ["narrowest place 26.5?", "reference 18?", "reference 45"]);
}

#[test]
fn beside_two_references_none_is_offered() {
    assert_eq!(described(Some(30.0), &[12.0, 45.0]), ["marked place 30", "reference 12", "reference 45"]);
    assert_eq!(described(Some(20.0), &[40.0, 45.0]), ["marked place 20", "reference 40", "reference 45"]);
}

#[test]
fn an_offered_reference_is_never_graded_with() {
    let compared = Compared { reference: vec![40.0], ..Compared::default() };
    let marked = Marked {
        at: Some(30.0),
        method: Method::Nascet,
        compared,
        group: None,
        diameters: Vec::new(),
        confirmed: Vec::new(),
    };
    let grade = marked.grade(&tube()).expect("a marked place");
    let places: Vec<f64> =
        grade.stenosis().expect("a percentage").references.iter().map(|[at, _]| *at).collect();
    assert_eq!(places, [40.0]);
    assert_eq!(marked.places(&tube()).iter().filter(|mark| mark.is_suggestion).count(), 1);
}

#[test]
fn noted_diameters_follow_the_other_places_and_grade_nothing() {
    let diameters = vec![40.0, 10.0];
    let marked = Marked {
        at: None,
        method: Method::Nascet,
        compared: Compared::default(),
        group: None,
        diameters,
        confirmed: Vec::new(),
    };
    let noted: Vec<f64> =
        marked.places(&tube()).iter().filter(|mark| mark.name == NOTED).map(|mark| mark.at).collect();
    assert_eq!(noted, [10.0, 40.0]);
    assert_eq!(marked.grade(&tube()), None);
}
