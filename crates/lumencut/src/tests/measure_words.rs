use super::*;
use crate::tube::tube;
use lumencut_vessels::measure::section::flags::{AT_LIMIT, BRANCH, CALCIUM, METAL, NO_EDGE};

fn graded(method: Method, references: Vec<[f64; 2]>) -> Stenosis {
    Stenosis {
        percent: 58.4,
        percent_uncertainty: 1.6,
        at: 41.25,
        diameter: 2.084,
        uncertainty: 0.06,
        reference: 5.0,
        references,
        method,
        doubts: Doubts::default(),
    }
}

#[test]
fn bounds_are_told_where_there_are_some() {
    let words = "2.10 mm if brighter material is excluded, 3.46 mm if it is included";
    assert_eq!(of_bounds([2.1, 3.456]).as_deref(), Some(words));
    assert_eq!(of_bounds([f64::NAN; 2]), None);
}

#[test]
fn a_stenosis_is_told_with_method_and_references() {
    assert_eq!(
        of_stenosis(&graded(Method::Nascet, vec![[20.0, 5.1], [60.04, 4.9]])),
        "58 ± 2 % of the diameter (NASCET): 2.08 ± 0.06 mm at 41.2 mm, reference 5.00 mm at 20.0 mm, 60.0 mm"
    );
    assert_eq!(
        of_stenosis(&graded(Method::Area, vec![[20.0, 5.1]])),
        "58 ± 2 % of the area (area): 2.08 ± 0.06 mm at 41.2 mm, reference 5.00 mm at 20.0 mm"
    );
    assert_eq!(
        of_stenosis(&graded(Method::Ecst, vec![[20.0, 5.1]])),
        "58 ± 2 % of the diameter (ECST): 2.08 ± 0.06 mm at 41.2 mm, assumed original 5.00 mm"
    );
}

#[test]
fn doubts_stand_behind_the_percentage() {
    let sure = graded(Method::Nascet, vec![[20.0, 5.1]]);
    assert_eq!(of_doubtful_stenosis(&sure), of_stenosis(&sure));
    assert!(of_doubts(&sure.doubts).is_empty());
    let doubts = Doubts { flags: CALCIUM | BRANCH, is_branch_between: true };
    let first_line =
        "58 ± 2 % of the diameter (NASCET; doubtful, as a section does not count: branch): 2.08 ± 0.06 mm";
    let described = [
        "At these places: branch, calcium.",
        "A branch lies between the place and a reference: beyond it a vessel may be of another width.",
    ];
    assert_eq!(of_doubts(&doubts), described);
    let doubtful = Stenosis { doubts, ..sure };
    assert!(of_stenosis(&doubtful).starts_with(first_line), "{}", of_stenosis(&doubtful));
    assert_eq!(
        of_doubtful_stenosis(&doubtful),
        format!("{}. {}", of_stenosis(&doubtful), described.join(" "))
    );
    assert_eq!(of_doubts(&Doubts { flags: 0, is_branch_between: true }), described[1..]);
}

#[test]
fn metal_at_a_place_is_told_in_the_first_line() {
    let first_line = |flags: u32| {
        let doubts = Doubts { flags, is_branch_between: false };
        of_stenosis(&Stenosis { doubts, ..graded(Method::Nascet, vec![[20.0, 5.1]]) })
    };
    let metal = first_line(METAL | CALCIUM);
    assert!(metal.contains("(NASCET; doubtful, as a place lies in metal): 2.08"), "{metal}");
    let both = first_line(METAL | BRANCH);
    assert!(
        both.contains("(NASCET; doubtful, as a section does not count: branch, and a place lies in metal)"),
        "{both}"
    );
    assert!(first_line(CALCIUM).contains("(NASCET): 2.08"));
}

#[test]
fn angles_of_a_c_arm_have_no_signs() {
    let described =
        |lao: f64, cranial: f64| of_c_arm(&CArm { lao: lao.to_radians(), cranial: cranial.to_radians() });
    assert_eq!(described(-20.2, 5.0), "RAO 20° CRAN 5°");
    assert_eq!(described(89.6, -30.0), "LAO 90° CAUD 30°");
    assert_eq!(described(0.0, 0.0), "LAO 0° CRAN 0°");
    // A fraction that rounds to 0 does not decide the side.
    assert_eq!(described(-1e-9, -0.4), "LAO 0° CRAN 0°");
}

#[test]
fn flags_and_sources_are_words() {
    assert_eq!(of_flags(AT_LIMIT | NO_EDGE), ["near the blur", "no clear wall"]);
    assert!(of_flags(0).is_empty());
    assert_eq!(of_source(&Source::Assumed { from: "two sides".to_owned() }), "assumed: two sides");
    assert_eq!(of_source(&Source::Given), "given");
}

#[test]
fn at_a_flap_the_words_state_which_lumen_is_measured() {
    let mut profile = tube();
    assert_eq!(of_lumens_at(&profile, 40), None);
    profile.flap[40] = Flap::Seen;
    profile.area_own_lumen[40] = [120.0, 3.0];
    profile.area_other_lumen[40] = [300.0, 4.0];
    let words = of_lumens_at(&profile, 40).expect("two lumens");
    assert_eq!(
        words[..2],
        ["lumen of the line, up to the flap, 120 ± 3 mm²", "other lumen next to it 300 ± 4 mm²"]
    );
    assert!(words[2].starts_with("both 420 ± "), "{words:?}");
}
