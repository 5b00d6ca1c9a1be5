use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::section::flags::{BRANCH, CALCIUM};
use lumencut_vessels::measure::stenosis::{Compared, Method};
use lumencut_vessels::measure::wall::WallSource;

use super::*;
use crate::measure_words::MILLIMETRE_ASSUMED;
use crate::profile_json::vessels_json;
use crate::profile_marks::{Grade, Marked};
use crate::profile_table::vessels_csv;
use crate::scan_details::ScanDetails;
use crate::tube::tube;

fn marked(at: Option<f64>, reference: &[f64]) -> Marked {
    let compared = Compared { reference: reference.to_vec(), ..Compared::default() };
    Marked { at, method: Method::Nascet, compared, group: None, diameters: Vec::new(), confirmed: Vec::new() }
}

fn shown() -> Shown {
    Shown {
        scan: None,
        saved: None,
        stated: Stated { has_units: true, has_orientation: true },
        asked: Asked { step_mm: 0.5, ..Asked::default() },
        window: [300.0, 700.0],
        settings: Vec::new(),
    }
}

fn page_of<'a>(
    profile: &'a Profile,
    name: &str,
    marked: &Marked,
    grade: Option<&'a Grade>,
) -> VesselPage<'a> {
    let marks: Vec<ReportMark> = marked.places(profile).iter().map(ReportMark::from).collect();
    VesselPage {
        measured: Measured {
            id: "0".to_owned(),
            name: Some(name.to_owned()),
            suggested_name: None,
            profile,
            scan: &ScanDetails::NOTHING,
            grade,
            is_millimetre_assumed: false,
        },
        sections: vec!["QUJD".to_owned(); marks.len()],
        marks,
        lengths: Lengths::default(),
        view: None,
        strip: Some(Strip { picture: "QUJD".to_owned(), size: [1344, 100], spacing: 60.0 / 1344.0 }),
    }
}

fn html_of(shown: &Shown, marked: &Marked) -> String {
    let profile = tube();
    let grade = marked.grade(&profile);
    html(shown, &[page_of(&profile, "LAD", marked, grade.as_ref())]).expect("a report")
}

#[test]
fn names_stand_in_it_as_they_are_and_nothing_runs() {
    let profile = tube();
    let odd = "<script>alert(1)</script> \"A\" & 'B'";
    let shown = Shown { scan: Some("<img src=x onerror=y>".to_owned()), ..shown() };
    let mut page = page_of(&profile, odd, &marked(None, &[]), None);
    page.view = Some(View { picture: "QUJD".to_owned(), method: "<csr>".to_owned() });
    let text = html(&shown, &[page]).expect("a report");
    assert!(text.contains("&lt;script&gt;alert(1)&lt;/script&gt; &quot;A&quot; &amp; &#39;B&#39;"));
    assert!(!text.contains("<script") && !text.contains("<img src=x") && !text.contains("<csr>"));
    for address in ["http", "//", "@import", "url(", "<link", "<iframe", "javascript:"] {
        assert!(!text.contains(address), "{address}");
    }
}

#[test]
fn a_picture_that_is_not_base64_is_refused() {
    let profile = tube();
    for odd in ["", "QUJD\" onload=\"alert(1)"] {
        let mut page = page_of(&profile, "LAD", &marked(None, &[]), None);
        page.sections[0] = odd.to_owned();
        let error = html(&shown(), &[page]).expect_err("no picture");
        assert_eq!(error.expected, "a PNG in base64");
    }
}

#[test]
fn a_percentage_has_its_method_and_references_and_what_makes_it_doubtful() {
    let text = html_of(&shown(), &marked(Some(30.0), &[20.0, 55.0]));
    assert!(text.contains("<p class=\"finding\">50 ± 2 % of the diameter (NASCET; doubtful, as a section does not count: branch): 4.00 ± "));
    let doubts = text.matches("<p class=\"doubt\">").count();
    assert_eq!(doubts, 2, "flags of the places, and a branch between");
    assert!(text.contains("marked place</td><td>30.0</td><td>4.00 ± 0.10</td><td>3.60</td>"));
    assert!(text.contains("reference before</td><td>20.0</td>") && text.contains("reference after</td>"));
}

#[test]
fn a_narrower_place_than_the_marked_one_is_told_with_the_finding() {
    let mut profile = tube();
    let far = profile.nearest_section(45.0);
    for n in far - 1..=far + 1 {
        (profile.area[n], profile.flags[n]) = (std::f64::consts::PI, CALCIUM);
    }
    for marked in [marked(Some(30.0), &[]), marked(Some(30.0), &[20.0])] {
        let grade = marked.grade(&profile);
        let text = html(&shown(), &[page_of(&profile, "LAD", &marked, grade.as_ref())]).expect("a report");
        assert!(text.contains("<p class=\"doubt\">Narrower, but not suggested: 2.00 mm at 4"), "{text}");
    }
}

#[test]
fn a_place_that_is_not_graded_keeps_its_rows_and_says_why() {
    let text = html_of(&shown(), &marked(Some(30.0), &[]));
    assert!(text.contains("<p class=\"finding\">4.00 ± 0.10 mm at 30.0 mm. No percentage: mark a reference"));
    assert!(text.contains("marked place</td><td>30.0</td>") && !text.contains(" % of the diameter"));
}

#[test]
fn flags_of_a_place_that_is_not_graded_are_in_the_report() {
    let mut profile = tube();
    let place = profile.nearest_section(30.0);
    profile.flags[place] = CALCIUM;
    let marked = marked(Some(30.0), &[]);
    let grade = marked.grade(&profile);
    let text = html(&shown(), &[page_of(&profile, "LAD", &marked, grade.as_ref())]).expect("a report");
    assert!(text.contains("<p class=\"doubt\">At these places: calcium."), "{text}");
}

#[test]
fn beside_calcium_a_diameter_is_told_from_both_sides() {
    let row = "<td class=\"words\">calcium, 7.00 mm if brighter material is excluded, 9.00 mm if it is included</td>";
    assert_eq!(html_of(&shown(), &marked(Some(30.0), &[20.0])).matches(row).count(), 1);
    let without = html_of(
        &Shown { stated: Stated { has_units: false, has_orientation: true }, ..shown() },
        &marked(Some(30.0), &[20.0]),
    );
    assert!(without.contains("calcium, 7.00 if brighter material is excluded, 9.00 if it is included"));
}

#[test]
fn what_nobody_confirmed_stands_apart() {
    let text = html_of(&shown(), &marked(Some(30.0), &[]));
    let (looked, offered) = text.split_once("<h2>Suggestions, not confirmed</h2>").expect("suggestions");
    assert!(looked.contains("marked place at 30.0 mm</figcaption>") && !looked.contains("(suggestion)</td>"));
    assert!(offered.contains("reference before (suggestion)</td>"));
    assert!(offered.contains("longest diameter (suggestion)</td>"));
    assert!(html_of(&shown(), &marked(None, &[])).contains("<p>No place is marked.</p>"));
}

#[test]
fn the_scan_and_the_date_stand_in_it_only_where_they_are_given() {
    let none = html_of(&shown(), &marked(None, &[]));
    assert!(none.contains("<h1>LAD, 60.0 mm</h1>") && !none.contains("Saved on"));
    let named = Shown { scan: Some("CT 4".to_owned()), saved: Some("2024-05-06".to_owned()), ..shown() };
    let text = html_of(&named, &marked(None, &[]));
    assert!(text.contains("<h1>CT 4 – LAD, 60.0 mm</h1>") && text.contains("<p>Saved on 2024-05-06</p>"));
}

#[test]
fn lengths_have_no_unit_where_the_file_states_no_spacing() {
    let with = html_of(&shown(), &marked(Some(30.0), &[20.0]));
    assert!(with.contains("<th>shortest (mm)</th>") && with.contains("<th>area (mm²)</th>"));
    let without = html_of(
        &Shown { stated: Stated { has_units: false, has_orientation: true }, ..shown() },
        &marked(Some(30.0), &[20.0]),
    );
    assert!(without.contains("<th>shortest</th>") && without.contains("<th>area</th>"));
    assert!(without.contains("4.00 ± ") && !without.contains(" mm at "));
    assert!(without.contains("Settings: step 0.5; window W 700 L 300"));
    let explained = without.replace(EXPLAINED, "").replace(UNITLESS, "");
    let (_, body) = explained.split_once("<body>").expect("a page");
    assert!(!body.contains(" mm") && without.contains(UNITLESS) && !with.contains(UNITLESS));
}

#[test]
fn an_assumed_millimetre_is_told_in_every_output_and_only_where_it_is() {
    let profile = tube();
    let outputs = |is_millimetre_assumed: bool| {
        let mut page = page_of(&profile, "LAD", &marked(None, &[]), None);
        page.measured.is_millimetre_assumed = is_millimetre_assumed;
        let one = [page.measured.clone()];
        [html(&shown(), &[page]).expect("a report"), vessels_json(&Asked::default(), &one), vessels_csv(&one)]
    };
    for (without, with) in outputs(false).iter().zip(&outputs(true)) {
        assert!(!without.contains("assumed between voxels"));
        assert!(with.contains(MILLIMETRE_ASSUMED));
    }
    let [report, json, table] = outputs(true);
    assert!(report.contains("<th>shortest (mm)</th>") && !report.contains(UNITLESS));
    assert!(json.contains(&format!("\"assumed\": \"{MILLIMETRE_ASSUMED}\"")));
    assert!(table.lines().next().is_some_and(|names| names.ends_with(",not_graded,assumed")));
    assert!(table.lines().skip(1).all(|line| line.ends_with(MILLIMETRE_ASSUMED)));
}

#[test]
fn lengths_that_a_reader_measured_are_told() {
    let profile = tube();
    let method_text = |shown: &Shown| {
        let mut page = page_of(&profile, "LAD", &marked(None, &[]), None);
        page.lengths = Lengths {
            stretches: vec![[10.0, 30.0], [30.0, 50.0]],
            diameters: vec![10.0],
            distances: vec![12.34],
        };
        html(shown, &[page]).expect("a report")
    };
    let text = method_text(&shown());
    assert!(text.contains("<p>Stretch: length 20.0 mm, straight 20.0 mm, tortuosity 1.000, C-arm "));
    assert!(text.contains("<p>Angle between both stretches: 0°</p>"));
    assert!(text.contains("<p>Straight distance 1: 12.3 mm</p>"));
    assert!(text.contains(">Diameter: 8.00 ± 0.10 mm at 10.0 mm, 7.20 to 8.80 mm</p>"));
    assert!(!text.contains("No percentage") && !text.contains("No reference is suggested"));
    assert!(
        !method_text(&Shown { stated: Stated { has_units: true, has_orientation: false }, ..shown() })
            .contains("C-arm")
    );
}

#[test]
fn the_plot_shows_curves_flags_and_places() {
    let text = html_of(&shown(), &marked(Some(30.0), &[20.0]));
    let count = |part: &str| text.matches(part).count();
    // Each flag that occurs has a row; the branch is a single bar.
    assert_eq!([count("<text class=\"flag\""), count("<rect x=")], [2, 4]);
    // The places are the marks, and the reference offered after the marked place.
    assert_eq!(count("<g class=\"place\""), 3);
    assert_eq!(count("class=\"left-out\""), 20);
    assert!(
        text.contains("1.5 × FWHM: 1.80 mm") && text.contains("<image href=\"data:image/png;base64,QUJD\"")
    );
    // The diameter curve is not interrupted, and ends at the branch.
    let (_, curve) = text.split_once("<path class=\"width\" d=\"").expect("a curve");
    let (curve, _) = curve.split_once('"').expect("its end");
    assert_eq!(curve.matches(['M', 'L']).count(), 101);
}

#[test]
fn how_it_was_measured_is_told() {
    let asked =
        Asked { step_mm: 0.5, fwhm_mm: Some(1.2), reference_mm: Some(vec![10.0, 50.0]), ..Asked::default() };
    let settings = vec![["view".to_owned(), "CSR".to_owned()]];
    let text = html_of(&Shown { asked, settings, ..shown() }, &marked(None, &[]));
    let words = "Settings: step 0.5 mm; FWHM 1.2 mm; window W 700 L 300; reference 10.0 mm and 50.0 mm; view CSR. \
                 FWHM of the point spread 1.20 mm, given. Walls: not separated, as requested. 121 sections, of which 101 count; flags: branch 20, calcium 1. \
                 Contrast to noise 25, contrast 250 in the unit of the volume.";
    assert!(text.contains(words), "{text}");
    let unknown = Profile { wall_source: WallSource::OtherUnit, ..tube() };
    let page = page_of(&unknown, "LAD", &marked(None, &[]), None);
    let text_of_unknown = html(&shown(), &[page]).expect("a report");
    assert!(text_of_unknown.contains("contrast 250 in the unit of the volume."));
    assert!(text.contains(". Imaging: series, phase, slice thickness, kernel not stated. Settings"));
    assert!(text.contains(NOTICE));
}

#[test]
fn a_vessel_of_which_nothing_counts_says_so() {
    let mut profile = tube();
    profile.flags.fill(BRANCH);
    let text = html(&shown(), &[page_of(&profile, "LAD", &marked(None, &[]), None)]).expect("a report");
    assert!(
        text.contains("No place is marked, and no section is reliable enough to suggest: see the flags.")
    );
    assert!(!text.contains("Sections at these places"));
}
