//! Tests that written files are read back bit-identically.

use glam::DVec3;

use super::robust::Random;
use super::sample;
use crate::junctions::vessels;
use crate::{Error, Line, Space, Unit, read, write_csv, write_mrk_json, write_swc, write_vtk, write_vtp};

type Writer = fn(&[Line]) -> Result<Vec<u8>, Error>;

const FORMATS: [(Writer, &str); 2] = [(write_vtp, "a.vtp"), (write_mrk_json, "a.mrk.json")];

fn bits(lines: &[Line]) -> String {
    format!("{lines:?}")
}

fn assert_round_trip(lines: &[Line]) {
    for (write, name) in FORMATS {
        let bytes = write(lines).unwrap();
        let read = read(&bytes, name).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(read.unit, Some(Unit::Millimetre), "{name}");
        let back = vessels(read.scaled(1.0).unwrap());
        assert_eq!(bits(&back.lines), bits(lines), "{name}");
        assert_eq!(back.space, Some(Space::Lps), "{name}");
        assert!(back.joined, "{name}");
        assert!(back.notes.iter().all(|note| note.contains("radi")), "{name}: {:?}", back.notes);
    }
}

/// Legacy VTK files store everything except names.
#[test]
fn legacy_vtk_comes_back_but_for_names() {
    let mut random = Random(0x5851_f42d_4c95_7f2d);
    for _ in 0..500 {
        let mut lines = tree(&mut random);
        let read = read(&write_vtk(&lines).unwrap(), "a.vtk").unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((read.unit, read.space, read.joined), (Some(Unit::Millimetre), Some(Space::Lps), true));
        lines.iter_mut().for_each(|line| line.name = None);
        assert_eq!(bits(&vessels(read.scaled(1.0).unwrap()).lines), bits(&lines));
    }
}

fn straight(from: [f64; 3], to: [f64; 3], radius: Option<f64>) -> Line {
    let [from, to] = [from, to].map(DVec3::from);
    let points: Vec<DVec3> = (0..=8).map(|i| from.lerp(to, f64::from(i) / 8.0)).collect();
    let radius = radius.map(|radius| vec![radius; points.len()]);
    Line { points, radius, ..Line::default() }
}

fn fork(radius: Option<f64>) -> Vec<Line> {
    let end = [0.0, 0.0, 20.0];
    [([0.0; 3], end), (end, [9.0, 0.0, 30.0]), (end, [-9.0, 0.0, 31.0])]
        .map(|(from, to)| straight(from, to, radius))
        .into()
}

#[test]
fn a_fork_comes_back_from_tables_and_nodes() {
    for radius in [Some(0.1), None] {
        for (write, name) in [(write_csv as Writer, "a.csv"), (write_swc, "a.swc"), (write_vtk, "a.vtk")] {
            let back = vessels(read(&write(&fork(radius)).unwrap(), name).unwrap().scaled(1.0).unwrap());
            assert_eq!(bits(&back.lines), bits(&fork(radius)), "{name}");
        }
    }
    let table = read(&write_csv(&fork(None)).unwrap(), "a.csv").unwrap();
    assert_eq!((table.space, table.unit), (Some(Space::Lps), Some(Unit::Millimetre)));
}

/// Branches in front of their trunk, and vessels in a loop: every node still comes after its parent.
#[test]
fn nodes_follow_their_parents() {
    let mut lines = fork(Some(2.0));
    lines.reverse();
    let text = String::from_utf8(write_swc(&lines).unwrap()).unwrap();
    let nodes: Vec<Vec<&str>> =
        text.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(' ').collect()).collect();
    assert_eq!(nodes.len(), 9 + 8 + 8);
    assert_eq!(nodes.iter().filter(|node| node[6] == "-1").count(), 1);
    for node in &nodes {
        let [id, parent] = [0, 6].map(|column| node[column].parse::<i64>().unwrap());
        assert!(parent < id, "{node:?}");
    }
    let [a, b] = [[0.0; 3], [5.0, 0.0, 0.0]];
    let circle = [straight(a, b, None), straight(b, a, None)];
    assert_eq!(read(&write_swc(&circle).unwrap(), "a.swc").unwrap().lines.len(), 1);
}

#[test]
fn names_stand_in_tables_and_in_legacy_vtk() {
    let mut lines = fork(None);
    lines[0].name = Some("a, \"b\"".into());
    lines[2].name = Some("50 %".into());
    let table = String::from_utf8(write_csv(&lines).unwrap()).unwrap();
    assert!(table.starts_with("line,name,l (mm),p (mm),s (mm)\n0,\"a, \"\"b\"\"\",0.0,0.0,0.0\n"), "{table}");
    assert_eq!(read(table.as_bytes(), "a.csv").unwrap().lines.len(), 3);
    let mut formula = fork(None);
    formula[0].name = Some("=1+1".into());
    let table = String::from_utf8(write_csv(&formula).unwrap()).unwrap();
    assert!(table.contains("\n0,'=1+1,0.0,"), "{table}");
    let vtk = String::from_utf8(write_vtk(&lines).unwrap()).unwrap();
    assert!(vtk.contains("Name 1 3 string\na,%20%22b%22\n\n50%20%25\n"), "{vtk}");
    lines[0].name = Some("two\nlines".into());
    let error = write_csv(&lines).unwrap_err().to_string();
    assert!(error.contains("name of line 0: found a line break"), "{error}");
}

/// Extreme numbers, and some that are not exact as decimals.
const EXTREMES: [f64; 10] = [0.0, -0.0, 1e-300, 5e-324, -1e6, 1e6, 0.1, 1.0 / 3.0, -2.225e-308, 1e-5];

fn number(random: &mut Random) -> f64 {
    match random.below(3) {
        0 => EXTREMES[random.below(EXTREMES.len())],
        1 => random.below(1000) as f64 / 8.0,
        _ => (random.below(1 << 53) as f64 / (1u64 << 52) as f64 - 1.0) * 1e6,
    }
}

const NAMES: [&str; 8] =
    ["", "LAD", "a \"quoted\" <b> & c", "línea 静脈 🩸", "two\nlines\r\n\ttab", " ", "]]>", "\\u0041"];

/// A tree in which most vessels start on others, run along them, or cross them.
fn tree(random: &mut Random) -> Vec<Line> {
    let mut out: Vec<Line> = Vec::new();
    for _ in 0..=random.below(6) {
        let mut points = vec![DVec3::from([(); 3].map(|()| number(random)))];
        if !out.is_empty() && random.below(4) > 0 {
            let other = &out[random.below(out.len())].points;
            points[0] = other[random.below(other.len())];
        }
        for _ in 0..=random.below(9) {
            let last = points[points.len() - 1];
            let step = DVec3::from([(); 3].map(|()| random.below(9) as f64 * 1e-4));
            let near = (last + step).min(DVec3::splat(1e6));
            points.push(if random.below(2) == 0 {
                near
            } else {
                DVec3::from([(); 3].map(|()| number(random)))
            });
        }
        points.dedup();
        if points.len() < 2 {
            points.push(points[0] * 0.5 + DVec3::splat(1.5));
        }
        let radius = (random.below(3) > 0).then(|| points.iter().map(|_| number(random).abs()).collect());
        let name = (random.below(3) > 0).then(|| NAMES[random.below(NAMES.len())].to_owned());
        out.push(Line { points, radius, group: None, name, ..Line::default() });
    }
    out
}

#[test]
fn random_trees_come_back_to_the_bit() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for _ in 0..2000 {
        assert_round_trip(&tree(&mut random));
    }
}

#[test]
fn vessels_of_a_file_come_back_to_the_bit() {
    let mut forks = 0;
    for (bytes, name) in sample::files() {
        let mut lines = vessels(read(&bytes, name).unwrap()).lines;
        forks += usize::from(lines.len() == 3);
        lines.iter_mut().for_each(|line| line.group = None);
        assert_round_trip(&lines);
    }
    assert!(forks > 5, "{forks} files of a tree that forks");
}

/// Lines of a file from another program are joined. Once this crate has written them, they are not.
/// Points that a reader moved are marked in both formats that the viewer writes; other files have no such marks.
#[test]
fn points_moved_by_hand_are_marked_and_the_lines_come_back() {
    let plain = fork(Some(0.5));
    let mut lines = plain.clone();
    lines[1].by_hand = Some((0..9).map(|n| n == 4).collect());
    for (write, name) in FORMATS {
        let text = String::from_utf8(write(&lines).unwrap()).unwrap();
        let marked = text.split_once("ByHand").expect("marks").1.split(['<', ']']).next().unwrap();
        assert_eq!(marked.matches("1.0").count(), 1, "{name}");
        let back = vessels(read(text.as_bytes(), name).unwrap().scaled(1.0).unwrap());
        assert_eq!(bits(&back.lines), bits(&plain), "{name}");
        assert!(!String::from_utf8(write(&plain).unwrap()).unwrap().contains("ByHand"), "{name}");
        let mut short = lines.clone();
        short[1].by_hand = Some(vec![true]);
        assert_eq!(write(&short).unwrap_err().subject, "points by hand of line 1");
    }
}

#[test]
fn the_mark_of_vessels_keeps_lines_apart() {
    let lines: Vec<Line> =
        [0, 1].map(|i| Line { points: sample::line(i), ..Line::default() }).into_iter().collect();
    assert_round_trip(&lines);
    for (write, name) in FORMATS {
        let text = String::from_utf8(write(&lines).unwrap()).unwrap();
        assert_eq!(text.matches("LumencutVessels").count(), 1);
        let unmarked = text.replace("LumencutVessels", "Other");
        assert_eq!(vessels(read(unmarked.as_bytes(), name).unwrap()).lines.len(), 3);
    }
}

#[test]
fn what_cannot_come_back_is_refused() {
    let line = |points: &[[f64; 3]]| Line {
        points: points.iter().map(|p| DVec3::from(*p)).collect(),
        ..Line::default()
    };
    let good = line(&[[0.0; 3], [1.0; 3]]);
    let wrong = [
        (vec![], "vessels: found none"),
        (vec![good.clone(), line(&[[0.0; 3]])], "points of line 1: found 1 point(s)"),
        (vec![line(&[[0.0; 3], [-0.0; 3], [1.0; 3]])], "points of line 0: found point 1 equal to the one"),
        (vec![line(&[[0.0; 3], [f64::NAN; 3]])], "points of line 0: found [NaN"),
        (vec![line(&[[0.0; 3], [1.1e6; 3]])], "points of line 0: found [1100000"),
        (vec![Line { radius: Some(vec![1.0]), ..good.clone() }], "radius of line 0: found 1 radii for 2"),
        (vec![Line { radius: Some(vec![1.0, -1.0]), ..good.clone() }], "radius of line 0: found -1"),
    ];
    for (lines, expected) in &wrong {
        for (write, _) in FORMATS {
            let error = write(lines).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        }
    }
    let null = [Line { name: Some("a\0b".into()), ..good }];
    let error = write_vtp(&null).unwrap_err().to_string();
    assert!(error.contains("null character") && error.contains(".mrk.json"), "{error}");
    let back = read(&write_mrk_json(&null).unwrap(), "a.mrk.json").unwrap();
    assert_eq!(back.lines, null);
}
