//! Tests that session files are read back, are centerline files too, and are rejected if damaged.

use glam::DVec3;

use crate::centerlines::Line;
use crate::read;
use crate::session_file::*;

fn sample() -> SessionFile {
    let points = vec![DVec3::new(0.1, -2.0, 1.0 / 3.0), DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 4.0, 4.0)];
    let line = Line {
        points,
        radius: Some(vec![1.5, 1.25, 0.1]),
        name: Some("left renal".into()),
        ..Line::default()
    };
    let marks = Marks {
        at_mm: Some(1.5),
        references_mm: vec![0.5, 3.0],
        method: "nascet".into(),
        stretch_mm: Some([0.0, 2.0]),
        ..Marks::default()
    };
    let state = VesselState {
        color: "#00aaFF".into(),
        clicks: Some(vec![[0.1, -2.0, 1.0 / 3.0], [4.0, 4.0, 4.0]]),
        confidence: Some(vec![1.0, 0.5, 0.0]),
        bridged: Some(vec![false, false, true]),
        marks: Some(marks),
        ..VesselState::default()
    };
    let camera = Camera {
        center: [0.0; 3],
        direction: [0.0, 1.0, 0.0],
        up: [0.0, 0.0, 1.0],
        size: [640, 480],
        pixel_spacing: 0.5,
    };
    let view = View {
        camera,
        method: "csr".into(),
        settings: [("window".to_owned(), serde_json::json!([300.0, 900.0]))].into(),
        layout: "measure".into(),
        cross_hair: Some([1.0, 2.0, 3.0]),
        picked: Some(Picked { vessel: 0, at_mm: 1.5 }),
        slices: None,
    };
    let session = Session {
        format: 1,
        software: "lumencut 0".into(),
        notice: "Lumencut is not a medical device.".into(),
        scan: Some(Scan { size: [10, 11, 12], world_from_index: [[1.0, 0.0, 0.0, 0.5]; 4] }),
        vessels: vec![state],
        doubtful: vec![DoubtfulBranch {
            color: "#ff8800".into(),
            doubt: "it leaves sideways".into(),
            points: vec![[0.0; 3], [1.0; 3]],
            ..DoubtfulBranch::default()
        }],
        stoppers: vec![Stopper { center: [5.0; 3], radius_mm: 3.0 }],
        bridge: true,
        rulers: vec![Ruler { from: [0.0; 3], to: [3.0, 4.0, 0.0] }],
        fwhm_mm: Some(0.9),
        view: Some(view),
        one_millimetre_assumed: false,
        bone_hidden: false,
        dark: false,
        compared: None,
    };
    SessionFile { lines: vec![line], session }
}

fn written(file: &SessionFile) -> String {
    String::from_utf8(write_session(file, "lumencut 0").unwrap()).unwrap()
}

fn refused(text: &str) -> String {
    read_session(text.as_bytes(), "saved.mrk.json").unwrap_err().to_string()
}

#[test]
fn a_session_comes_back_to_the_bit() {
    let text = written(&sample());
    assert!(is_session(text.as_bytes()));
    assert_eq!(read_session(text.as_bytes(), "saved.mrk.json").unwrap(), sample());
}

#[test]
fn an_assumed_millimetre_comes_back_and_is_of_format_2() {
    let mut file = sample();
    file.session.one_millimetre_assumed = true;
    let text = written(&file);
    file.session.format = 2;
    assert_eq!(read_session(text.as_bytes(), "saved.mrk.json").unwrap(), file);
    // Content that fits into version 1 is written as version 1, even if version 2 was read.
    file.session.one_millimetre_assumed = false;
    assert_eq!(written(&file), written(&sample()));
    let early = text.replace("\"format\":2", "\"format\":1");
    assert!(refused(&early).contains("found an assumed millimetre in version 1; expected version 2"));
}

#[test]
fn hidden_bone_comes_back_and_is_of_format_2() {
    let mut file = sample();
    file.session.bone_hidden = true;
    let text = written(&file);
    file.session.format = 2;
    assert_eq!(read_session(text.as_bytes(), "saved.mrk.json").unwrap(), file);
    let early = text.replace("\"format\":2", "\"format\":1");
    assert!(refused(&early).contains("found hidden bone in version 1; expected version 2"));
}

#[test]
fn dark_lumens_come_back_and_are_of_format_2() {
    let mut file = sample();
    file.session.dark = true;
    let text = written(&file);
    file.session.format = 2;
    assert_eq!(read_session(text.as_bytes(), "saved.mrk.json").unwrap(), file);
    let early = text.replace("\"format\":2", "\"format\":1");
    assert!(refused(&early).contains("found dark lumens in version 1; expected version 2"));
}

#[test]
fn a_compared_scan_comes_back_and_is_of_format_2() {
    let mut file = sample();
    file.session.compared = Some(ComparedScan {
        scan: Scan { size: [5, 6, 7], world_from_index: [[0.5; 4]; 4] },
        is_earlier: true,
        pairs_mm: vec![[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]],
    });
    let text = written(&file);
    file.session.format = 2;
    assert_eq!(read_session(text.as_bytes(), "saved.mrk.json").unwrap(), file);
    let early = text.replace("\"format\":2", "\"format\":1");
    assert!(refused(&early).contains("found a compared scan in version 1; expected version 2"));
}

#[test]
fn planes_of_slices_come_back_and_are_of_format_2() {
    let mut file = sample();
    let axes = |right, down| SliceAxes { right, down };
    file.session.view.as_mut().unwrap().slices = Some(Slices {
        axial: axes([0.8, 0.6, 0.0], [-0.6, 0.8, 0.0]),
        coronal: axes([0.8, 0.6, 0.0], [0.0, 0.0, -1.0]),
        sagittal: axes([-0.6, 0.8, 0.0], [0.0, 0.0, -1.0]),
        slab: Some((10.0, "max".into())),
    });
    let text = written(&file);
    file.session.format = 2;
    assert_eq!(read_session(text.as_bytes(), "saved.mrk.json").unwrap(), file);
    let early = text.replace("\"format\":2", "\"format\":1");
    assert!(refused(&early).contains("found planes of slices in version 1; expected version 2"));
}

#[test]
fn noted_diameters_come_back_and_are_of_format_2() {
    let mut file = sample();
    file.session.vessels[0].marks =
        Some(Marks { diameters_mm: vec![3.5], confirmed_mm: vec![2.5], ..Marks::default() });
    file.session.vessels[0].marks.as_mut().expect("marks").method = "nascet".to_owned();
    let text = written(&file);
    file.session.format = 2;
    assert_eq!(read_session(text.as_bytes(), "saved.mrk.json").unwrap(), file);
    let early = text.replace("\"format\":2", "\"format\":1");
    assert!(refused(&early).contains("found noted diameters in version 1; expected version 2"));
}

#[test]
fn format_1_has_the_fields_that_it_always_had() {
    let mut file = sample();
    file.lines.clear();
    file.session.vessels.clear();
    file.session.doubtful.clear();
    let fields = "{\"format\":1,\"software\":\"lumencut 0\",\"notice\":\"Lumencut is not a medical device.\",\
        \"scan\":null,\"vessels\":[],\"doubtful\":[],\"stoppers\":[],\"bridge\":false,\"rulers\":[],\
        \"fwhm_mm\":null,\"view\":null}";
    let session = Session {
        scan: None,
        stoppers: vec![],
        bridge: false,
        rulers: vec![],
        fwhm_mm: None,
        view: None,
        ..file.session
    };
    let bare = written(&SessionFile { lines: vec![], session });
    assert!(bare.contains(&format!("\"{FIELD}\": {fields},\n")), "{bare}");
}

#[test]
fn a_session_without_vessels_comes_back() {
    let mut file = sample();
    file.lines.clear();
    file.session.vessels.clear();
    file.session.view = None;
    let text = written(&file);
    assert_eq!(read_session(text.as_bytes(), "saved.mrk.json").unwrap(), file);
}

#[test]
fn its_vessels_are_centerlines_to_every_reader() {
    let text = written(&sample());
    let read = read(text.as_bytes(), "saved.mrk.json").unwrap();
    assert_eq!(read.lines, sample().lines);
    assert!(read.joined, "they are vessels already");
}

#[test]
fn markups_without_a_session_are_none() {
    let text = String::from_utf8(crate::write_mrk_json(&sample().lines).unwrap()).unwrap();
    assert!(!is_session(text.as_bytes()));
    assert!(refused(&text).contains("found no field LumencutSession"));
}

#[test]
fn damaged_sessions_are_refused_by_name() {
    let text = written(&sample());
    let cases = [
        (text[..text.len() / 2].to_owned(), "damaged JSON"),
        (text.replace("\"format\":1", "\"format\":3"), "found version 3; expected version 1 or 2"),
        (text.replace("\"format\":1", "\"format\":3"), "open it with a newer version of Lumencut"),
        (text.replace("\"format\":1", "\"format\":1.5"), "found version 1.5"),
        (text.replace("\"format\":1,", ""), "found no version"),
        (text.replace("\"bridge\":true", "\"bridge\":3"), "invalid type"),
        (text.replace("\"bridge\":true", "\"bridge\":true,\"patient\":\"x\""), "unknown field"),
        (text.replace("#00aaFF", "red"), "color of vessel 0"),
        (text.replace("\"nascet\"", "\"guessed\""), "method of vessel 0"),
        (text.replace("[1.0,0.5,0.0]", "[1.0,0.5]"), "found 2 for 3 points"),
        (text.replace("\"vessel\":0", "\"vessel\":7"), "picked vessel"),
        (text.replace("\"fwhm_mm\":0.9", "\"fwhm_mm\":0"), "FWHM of the session"),
        (text.replace("[0.5,3.0]", "[0.5,3.0,4.0]"), "found 3 references"),
    ];
    for (damaged, expected) in cases {
        assert_ne!(damaged, text, "{expected}: the sample holds what is replaced");
        let message = refused(&damaged);
        assert!(message.contains(expected) && message.starts_with("saved.mrk.json"), "{message}");
    }
}

#[test]
fn parts_that_do_not_go_together_are_not_written() {
    let mut file = sample();
    file.session.vessels.clear();
    assert!(write_session(&file, "lumencut 0").unwrap_err().to_string().contains("found 0 for 1 curve(s)"));
}
