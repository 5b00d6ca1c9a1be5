//! Reads and writes session files.

use glam::DMat4;
use lumencut_io as centerlines;
use lumencut_io::session_file::{DoubtfulBranch, Scan, Session, SessionFile, read_session, write_session};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::study::failure::{Failure, Result};
use crate::study::held_volume::HeldVolume;
use crate::study::lines::{Line, Lines, NamedLine};
use crate::study::open_study::Study;
use crate::study::planes::check_slices;

const SOFTWARE: &str = concat!("lumencut ", env!("CARGO_PKG_VERSION"));

/// How much rounding may change the scan's grid in a file (mm).
const GRID_TOLERANCE_MM: f64 = 1e-3;

/// A session as the page stores it: lines by number, and everything else as in the file, without the data of points.
#[derive(Debug, Deserialize, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct SessionContent {
    lines: Vec<NamedLine>,
    doubtful_lines: Vec<NamedLine>,
    #[cfg_attr(test, ts(as = "Session"))]
    session: Value,
}

pub(crate) fn written(content: SessionContent, lines: &Lines) -> Result<Vec<u8>> {
    let SessionContent { lines: named, doubtful_lines, session } = content;
    let session = session_of(session, (named.len(), doubtful_lines.len()))?;
    let mut file = SessionFile { lines: Vec::new(), session };
    for (named, state) in named.iter().zip(&mut file.session.vessels) {
        let line = lines.get(named.line)?;
        state.confidence.clone_from(&line.confidence);
        state.bridged.clone_from(&line.bridged);
        state.by_hand.clone_from(&line.by_hand);
        // The session stores both with the vessel, so the line omits them.
        file.lines.push(centerlines::Line { confidence: None, by_hand: None, ..line.in_file(&named.name) });
    }
    for (named, branch) in doubtful_lines.iter().zip(&mut file.session.doubtful) {
        let line = lines.get(named.line)?.in_file(&named.name);
        branch.name.clone_from(&named.name);
        branch.points = line.points.iter().map(|point| point.to_array()).collect();
        (branch.radius, branch.confidence) = (line.radius, line.confidence);
    }
    Ok(write_session(&file, SOFTWARE)?)
}

/// Adds the fields that the page omits, and parses the session.
fn session_of(mut said: Value, counts: (usize, usize)) -> Result<Session> {
    let wrong = |found: &str| Failure::of_message("session", &found, "a session as JSON");
    let count = |list: &str| said.get(list).and_then(Value::as_array).map(Vec::len);
    if (count("vessels"), count("doubtful")) != (Some(counts.0), Some(counts.1)) {
        return Err(wrong("different numbers of vessels and lines"));
    }
    let add = |to: &mut Value, fields: Value| {
        if let (Some(to), Value::Object(fields)) = (to.as_object_mut(), fields) {
            to.extend(fields);
        }
    };
    add(&mut said, json!({"format": 0, "software": "", "notice": ""}));
    for branch in said["doubtful"].as_array_mut().into_iter().flatten() {
        add(branch, json!({"name": "", "points": []}));
    }
    serde_json::from_value(said).map_err(|error| wrong(&error.to_string()))
}

impl Study {
    pub(crate) fn write_session(&self, content: SessionContent) -> Result<Vec<u8>> {
        written(content, &self.lines)
    }

    /// The content of a session file of the open scan. Its lines are kept, but not shown yet.
    pub(crate) fn read_session(&mut self, bytes: &[u8], name: &str) -> Result<SessionContent> {
        let Some(held) = &self.content.held else {
            return Err(not_of_scan(name, "a session without its scan", "a scan that is open"));
        };
        let file = read_session(bytes, name)?;
        if let Some(scan) = file.session.scan.as_ref().filter(|scan| !is_of(scan, held)) {
            let [ni, nj, nk] = scan.size;
            let found = format!("a session of a scan of {ni} × {nj} × {nk} voxels in another place");
            return Err(not_of_scan(name, &found, "a session of the open scan"));
        }
        if let Some(slices) = file.session.view.as_ref().and_then(|view| view.slices.as_ref()) {
            check_slices(slices)?;
        }
        taken(file, &mut self.lines)
    }
}

fn is_of(saved: &Scan, held: &HeldVolume) -> bool {
    let here = DMat4::from(held.world_from_index).transpose().to_cols_array();
    let there = saved.world_from_index.as_flattened();
    saved.size == held.size
        && here.iter().zip(there).all(|(here, there)| (here - there).abs() <= GRID_TOLERANCE_MM)
}

fn not_of_scan(name: &str, found: &str, expected: &str) -> Failure {
    let mend = "open the session's own scan, then the session".to_owned();
    Failure { kind: "session", mend, ..Failure::of_message(name, &found, expected) }
}

fn taken(file: SessionFile, lines: &mut Lines) -> Result<SessionContent> {
    let SessionFile { lines: curves, mut session } = file;
    let mut named = Vec::with_capacity(curves.len());
    for (curve, state) in curves.into_iter().zip(&mut session.vessels) {
        let line = Line {
            points: curve.points,
            radius: curve.radius,
            confidence: state.confidence.take(),
            bridged: state.bridged.take(),
            by_hand: state.by_hand.take(),
        };
        named.push(NamedLine { line: lines.add(line)?, name: curve.name.unwrap_or_default() });
    }
    let doubtful: Vec<DoubtfulBranch> = session.doubtful.iter_mut().map(std::mem::take).collect();
    let mut doubtful_lines = Vec::with_capacity(doubtful.len());
    for (branch, kept) in doubtful.into_iter().zip(&mut session.doubtful) {
        (kept.color, kept.doubt) = (branch.color, branch.doubt);
        let points = branch.points.into_iter().map(Into::into).collect();
        let (radius, confidence) = (branch.radius, branch.confidence);
        let line = lines.add(Line { points, radius, confidence, ..Line::default() })?;
        doubtful_lines.push(NamedLine { line, name: branch.name });
    }
    let text = session.json()?;
    let session = serde_json::from_str(&text)
        .map_err(|error| Failure::of_message("session", &error, "a session as JSON"))?;
    Ok(SessionContent { lines: named, doubtful_lines, session })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn line(bridged: Option<Vec<bool>>) -> Line {
        Line {
            points: vec![DVec3::ZERO, DVec3::new(1.0, 1.0 / 3.0, 0.0)],
            radius: Some(vec![1.5, 1.25]),
            confidence: Some(vec![1.0, 0.5]),
            bridged,
            by_hand: None,
        }
    }

    fn said() -> Value {
        let vessel = json!({"color": "#1177aa", "hidden": true, "clicks": [[0.0, 0.0, 0.0]], "marks": null});
        json!({
            "scan": null, "vessels": [vessel], "doubtful": [{"color": "#ff8800", "doubt": "it leaves sideways"}],
            "stoppers": [], "bridge": false, "rulers": [], "fwhm_mm": null, "view": null,
        })
    }

    fn content(lines: &mut Lines, session: Value) -> SessionContent {
        let sure = lines.add(line(Some(vec![false, true]))).expect("a line");
        let doubtful = lines.add(line(None)).expect("a line");
        let named = |line, name: &str| vec![NamedLine { line, name: name.to_owned() }];
        SessionContent { lines: named(sure, "renal"), doubtful_lines: named(doubtful, ""), session }
    }

    #[test]
    fn a_session_comes_back_with_its_lines() {
        let mut lines = Lines::default();
        let content = content(&mut lines, said());
        let bytes = written(content, &lines).expect("a file");
        let mut other = Lines::default();
        let file = read_session(&bytes, "saved.mrk.json").expect("a session");
        let back = taken(file, &mut other).expect("a session");
        assert_eq!(*other.get(back.lines[0].line).expect("a line"), line(Some(vec![false, true])));
        assert_eq!(*other.get(back.doubtful_lines[0].line).expect("a line"), line(None));
        assert_eq!(back.lines[0].name, "renal");
        for (name, value) in said().as_object().expect("an object") {
            if !["vessels", "doubtful"].contains(&name.as_str()) {
                assert_eq!(back.session[name], *value, "{name}");
            }
        }
        assert_eq!(back.session["vessels"][0]["hidden"], true);
        assert_eq!(back.session["doubtful"][0]["doubt"], "it leaves sideways");
    }

    #[test]
    fn an_assumed_millimetre_comes_back_and_is_said_only_where_it_is() {
        let mut lines = Lines::default();
        for is_assumed in [false, true] {
            let mut session = said();
            session["one_millimetre_assumed"] = json!(is_assumed);
            let bytes = written(content(&mut lines, session), &lines).expect("a file");
            let file = read_session(&bytes, "saved.mrk.json").expect("a session");
            assert_eq!(file.session.format, 1 + u32::from(is_assumed));
            let back = taken(file, &mut lines).expect("a session");
            let expected = if is_assumed { json!(true) } else { Value::Null };
            assert_eq!(back.session["one_millimetre_assumed"], expected);
        }
    }

    #[test]
    fn what_does_not_go_together_is_refused() {
        let mut lines = Lines::default();
        let mut fewer = said();
        fewer["vessels"] = json!([]);
        let content_of = |session, lines: &mut Lines| content(lines, session);
        let refused = |content, lines: &Lines| written(content, lines).expect_err("no session").found;
        let few = content_of(fewer, &mut lines);
        assert_eq!(refused(few, &lines), "different numbers of vessels and lines");
        let mut odd = said();
        odd["bridge"] = json!("yes");
        let odd = content_of(odd, &mut lines);
        assert!(refused(odd, &lines).contains("invalid type"));
    }

    /// A volume of 2 × 3 × 4 voxels, at `place` mm along the first axis.
    fn study_at(place: f64) -> Study {
        let mut study = Study::default();
        let rows = [[1.0, 0.0, 0.0, place], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
        let header = json!({"size": [2, 3, 4], "dtype": "uint8", "world_from_index": rows});
        study.begin_volume(&header.to_string()).expect("room");
        study
    }

    #[test]
    fn a_session_goes_on_with_its_own_scan_alone() {
        let mut study = study_at(5.0);
        let mut with_scan = said();
        let rows = [[1.0, 0.0, 0.0, 5.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
        with_scan["scan"] = json!({"size": [2, 3, 4], "world_from_index": rows});
        let content = content(&mut study.lines, with_scan);
        let bytes = study.write_session(content).expect("a file");
        let back = study.read_session(&bytes, "saved.mrk.json").expect("a session");
        assert_eq!(*study.lines.get(back.lines[0].line).expect("a line"), line(Some(vec![false, true])));
        // A grid that differs by rounding belongs to the same scan; others do not.
        assert!(study_at(5.0005).read_session(&bytes, "saved.mrk.json").is_ok());
        let other = study_at(5.1).read_session(&bytes, "saved.mrk.json").expect_err("another scan");
        assert_eq!((other.kind, other.subject.as_str()), ("session", "saved.mrk.json"));
        assert_eq!(other.found, "a session of a scan of 2 × 3 × 4 voxels in another place");
        let none = Study::default().read_session(&bytes, "saved.mrk.json").expect_err("no scan");
        assert_eq!(none.found, "a session without its scan");
        assert_eq!(study.read_session(b"{}", "no.mrk.json").expect_err("no session").kind, "format");
    }
}
