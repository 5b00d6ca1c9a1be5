//! Tests that every encoding of every format gives the same lines, notes and errors.

use glam::DVec3;

use super::sample::{self, RADIUS};
use crate::{Centerlines, Space, Unit, read};

fn assert_is_sample(read: &Centerlines, what: &str) {
    assert_eq!(read.space, Some(Space::Ras), "{what}");
    assert_eq!(read.lines.len(), 2, "{what}");
    assert_eq!(read.lines[0].points, sample::line(0), "{what}");
    assert_eq!(read.lines[1].points, sample::line(1), "{what}");
    assert_eq!(read.lines[0].radius.as_deref(), Some(&RADIUS[..3]), "{what}");
    assert_eq!(read.lines[1].radius.as_deref(), Some(&RADIUS[3..]), "{what}");
}

fn message(bytes: &[u8], name: &str) -> String {
    read(bytes, name).unwrap_err().to_string()
}

fn replaced(bytes: Vec<u8>, from: &str, to: &str) -> Vec<u8> {
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.contains(from), "{from} is not in {text}");
    text.replace(from, to).into_bytes()
}

fn ascii_vtp() -> Vec<u8> {
    sample::vtp(sample::styles()[0])
}

#[test]
fn every_vtp_encoding_gives_the_same_lines() {
    for style in sample::styles() {
        let read = read(&sample::vtp(style), "a.vtp").unwrap_or_else(|error| panic!("{style:?}: {error}"));
        assert_is_sample(&read, &format!("{style:?}"));
        assert_eq!(read.lines.iter().map(|l| l.group).collect::<Vec<_>>(), [Some(4), Some(5)]);
        assert_eq!(read.notes, ["radius from the point array 'MaximumInscribedSphereRadius'"]);
    }
}

#[test]
fn every_legacy_form_gives_the_same_lines() {
    for (binary, offsets) in [(false, false), (false, true), (true, false), (true, true)] {
        let read = read(&sample::vtk(binary, offsets), "a.vtk").unwrap();
        assert_is_sample(&read, &format!("binary {binary}, offsets {offsets}"));
        assert_eq!(read.lines.iter().map(|l| l.group).collect::<Vec<_>>(), [Some(4), Some(5)]);
    }
}

#[test]
fn markups_are_read_in_their_space_and_unit() {
    for (space, unit, in_mm) in [("RAS", Unit::Millimetre, 1.0), ("0", Unit::Centimetre, 10.0)] {
        let read = read(&sample::mrk_json(space, unit.name(), 1.0), "a.mrk.json").unwrap();
        assert_eq!((read.unit, read.format), (Some(unit), "3D Slicer markups"));
        assert_eq!(read.lines[1].points, sample::line(1), "points stay in the file's unit");
        assert_eq!(read.space, Some(Space::Ras));
        assert_eq!(read.lines[1].name.as_deref(), Some("curve 3"));
        let read = read.scaled(unit.in_mm()).unwrap();
        let expected: Vec<DVec3> = sample::line(1).into_iter().map(|p| p * in_mm).collect();
        assert_eq!(read.lines[1].points, expected);
        let radius = read.lines[1].radius.as_ref().unwrap();
        let near = radius.iter().zip(&RADIUS[3..]).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near && radius.len() == 4, "the sample's radius is in mm whatever the coordinates");
    }
    assert_eq!(read(&sample::mrk_json("LPS", "mm", 1.0), "a.json").unwrap().space, Some(Space::Lps));
    let silent = replaced(sample::mrk_json("LPS", "mm", 1.0), "\"coordinateSystem\": \"LPS\",", "");
    assert_eq!(read(&silent, "a.json").unwrap().space, None);
    let silent = replaced(sample::mrk_json("LPS", "cm", 1.0), "\"coordinateUnits\": \"cm\",", "");
    assert_eq!(read(&silent, "a.json").unwrap().unit, Some(Unit::Millimetre));
    let expected = "a.json: markup 0: coordinateSystem: found 'IJK'; expected 'LPS' or 'RAS'";
    assert_eq!(message(&sample::mrk_json("IJK", "mm", 1.0), "a.json"), expected);
    assert!(message(&sample::mrk_json("LPS", "inch", 1.0), "a.json").contains("coordinateUnits"));
}

fn mixed(first: Vec<u8>, second: Vec<u8>) -> Vec<u8> {
    let [first, second] = [first, second].map(|bytes| String::from_utf8(bytes).unwrap());
    let at = |text: &str| text.find("{\"type\": \"Curve\", \"name\": \"curve 3\"").unwrap();
    (first[..at(&first)].to_owned() + &second[at(&second)..]).into_bytes()
}

#[test]
fn markups_in_two_units_are_brought_into_the_first() {
    let bytes = mixed(sample::mrk_json("RAS", "mm", 1.0), sample::mrk_json("RAS", "cm", 0.125));
    let read = read(&bytes, "a.mrk.json").unwrap();
    assert_eq!(read.unit, Some(Unit::Millimetre));
    assert_eq!(read.lines[0].points, sample::line(0));
    assert_eq!(read.lines[1].points, sample::line(1).iter().map(|p| *p * 1.25).collect::<Vec<_>>());
    assert_eq!(read.lines[1].radius.as_deref(), Some(&RADIUS[3..]));
    assert!(read.notes.iter().any(|note| note.contains("different units were converted to mm")));
}

#[test]
fn units_of_markups_may_be_codes() {
    let coded = |unit: &str, by: &str| {
        let stated = format!("\"coordinateUnits\": [\"{unit}\", \"{by}\", \"length\"]");
        replaced(sample::mrk_json("RAS", "mm", 1.0), "\"coordinateUnits\": \"mm\"", &stated)
    };
    assert_eq!(read(&coded("cm", "UCUM"), "a.mrk.json").unwrap().unit, Some(Unit::Centimetre));
    assert!(message(&coded("cm", "DCM"), "a.mrk.json").contains("coordinateUnits: found"));
    assert!(message(&coded("[in_i]", "UCUM"), "a.mrk.json").contains("coordinateUnits: found '\\\"[in_i]"));
}

#[test]
fn scaling_checks_the_limit_again() {
    let read = read(&ascii_vtp(), "a.vtp").unwrap();
    assert_eq!((read.unit, read.conventional_unit), (None, Some(Unit::Millimetre)));
    let twice = read.clone().scaled(2.0).unwrap();
    assert_eq!(twice.lines[0].points[2], sample::line(0)[2] * 2.0);
    assert_eq!(twice.lines[0].radius.as_ref().unwrap()[0], 2.0 * RADIUS[0]);
    assert_eq!((twice.notes, twice.unit), (read.notes.clone(), read.unit));
    let error = read.clone().scaled(1e6).unwrap_err().to_string();
    assert!(error.ends_with("expected coordinates of at most 1e6 mm"), "{error}");
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(read.clone().scaled(factor).unwrap_err().to_string().contains("a finite factor above 0"));
    }
}

#[test]
fn markups_in_two_spaces_are_brought_into_the_first() {
    let bytes = mixed(sample::mrk_json("RAS", "mm", 1.0), sample::mrk_json("LPS", "mm", 1.0));
    let read = read(&bytes, "a.mrk.json").unwrap();
    assert_is_sample(&read, "second markup in LPS");
    assert!(read.notes.iter().any(|note| note.contains("different coordinate systems")));
}

#[test]
fn closed_curves_close_and_other_markups_are_left_out() {
    let closed = replaced(
        sample::mrk_json("RAS", "mm", 1.0),
        "\"type\": \"Curve\", \"name\": \"curve 3\"",
        "\"type\": \"ClosedCurve\"",
    );
    let line = &read(&closed, "a.mrk.json").unwrap().lines[1];
    assert_eq!(line.points.first(), line.points.last());
    assert_eq!(line.points.len(), 5);
    let fiducial = replaced(
        sample::mrk_json("RAS", "mm", 1.0),
        "\"type\": \"Curve\", \"name\": \"curve 3\"",
        "\"type\": \"Fiducial\"",
    );
    let read = read(&fiducial, "a.mrk.json").unwrap();
    assert_eq!(read.lines.len(), 1);
    assert!(read.notes.iter().any(|note| note.contains("'Fiducial'")));
    let none = replaced(fiducial, "\"type\": \"Curve\"", "\"type\": \"Plane\"");
    assert!(message(&none, "a.mrk.json").contains("'Plane', 'Fiducial'; expected a markup of type Curve"));
}

#[test]
fn control_points_without_a_place_are_left_out_with_their_radius() {
    let bytes = replaced(
        sample::mrk_json("RAS", "mm", 1.0),
        "{\"position\": [1.0, 2.0, 8.0], \"positionStatus\": \"defined\"}",
        "{\"positionStatus\": \"undefined\"}",
    );
    let read = read(&bytes, "a.mrk.json").unwrap();
    assert_eq!(read.lines[1].points.len(), 3);
    assert_eq!(read.lines[1].radius.as_deref(), Some(&[2.0, 1.5, 0.5][..]));
    assert!(read.notes.iter().any(|note| note.starts_with("1 control point(s)")));
}

#[test]
fn points_without_lines_are_named() {
    let bytes = replaced(ascii_vtp(), "NumberOfLines=\"2\"", "NumberOfLines=\"0\" NumberOfVerts=\"1\"");
    let text = message(&bytes, "frame.vtp");
    assert!(
        text.starts_with("frame.vtp: lines: found 7 point(s), 1 other cell(s) but no line; expected"),
        "{text}"
    );
}

#[test]
fn a_cloud_of_points_and_a_document_type_are_refused_by_name() {
    let cloud = b"# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 1 1\nVERTICES 2 4\n1 0 1 1\n";
    let expected = "a.vtk: lines: found 2 point(s), 2 other cell(s) but no line; expected at least one line \
                    through the points; give a file of centerlines, not of points or surfaces";
    assert_eq!(message(cloud, "a.vtk"), expected);
    let bomb = replaced(ascii_vtp(), "<VTKFile", "<!DOCTYPE a [<!ENTITY b \"c\">]><VTKFile");
    assert!(message(&bomb, "a.vtp").contains("found a document type (<!DOCTYPE)"));
}

#[test]
fn nan_points_wild_ids_and_negative_radii_are_named() {
    let nan = replaced(ascii_vtp(), "-4\n 2\n 8.125", "-4\n nan\n 8.125");
    assert!(message(&nan, "a.vtp").contains("points of line 0: found [-4, NaN, 8.125] at point 2"));
    let far = replaced(ascii_vtp(), "-4\n 2\n 8.125", "-4\n 2e300\n 8.125");
    assert!(message(&far, "a.vtp").contains("at point 2; expected coordinates of at most 1e9"));
    let id = replaced(ascii_vtp(), ">0\n 1\n 2\n", ">0\n 7\n 2\n");
    assert!(
        message(&id, "a.vtp")
            .contains("point ids of the lines: found 7; expected a whole number from 0 to below 7")
    );
    let radius = replaced(ascii_vtp(), "0.75", "-0.75");
    assert!(message(&radius, "a.vtp").contains("radius of line 1: found -0.75 at point 2"));
    let offset = replaced(ascii_vtp(), ">3\n 7\n", ">7\n 3\n");
    assert!(message(&offset, "a.vtp").contains("offsets of the lines"));
}

#[test]
fn lies_about_sizes_are_named() {
    let huge = replaced(ascii_vtp(), "NumberOfPoints=\"7\"", "NumberOfPoints=\"4000000000000000000\"");
    assert!(message(&huge, "a.vtp").contains("21 numbers"));
    let huge = replaced(sample::vtk(false, false), "POINTS 7 float", "POINTS 18446744073709551615 float");
    assert!(message(&huge, "a.vtk").starts_with("a.vtk: POINTS: found"));
    let mut deep = "<VTKFile type=\"PolyData\">".to_owned();
    deep.push_str(&"<a>".repeat(100_000));
    assert!(message(deep.as_bytes(), "a.vtp").contains("nested deeper than"));
    let deep = format!("{{\"markups\": {}", "[".repeat(100_000));
    assert!(message(deep.as_bytes(), "a.json").contains("damaged JSON"));
}

#[test]
fn a_bomb_is_refused_by_its_size() {
    use crate::compression::{Budget, Compressor};
    let zeros = vec![0; 1 << 20];
    let packed = sample::pack(Compressor::Zlib, &zeros);
    let mut out = Vec::new();
    let error = Compressor::Zlib.unpack("array", &packed, 1000, &mut out).unwrap_err();
    assert!(error.to_string().contains("does not unpack to 1000 bytes") && out.len() <= 1001);
    let mut budget = Budget::of_file(packed.len());
    assert!(budget.take("array", 1 << 20).is_ok());
    let error = budget.take("array", 1 << 40).unwrap_err();
    assert!(error.to_string().contains("1099511627776 bytes to unpack"), "{error}");
}

#[test]
fn groups_of_points_cut_a_line_where_the_group_changes() {
    let bytes = replaced(ascii_vtp(), "Name=\"GroupIds\"", "Name=\"Other\"");
    let bytes = replaced(bytes, "Name=\"Abscissas\"", "Name=\"GroupIds\"");
    let bytes = replaced(bytes, &"0\n ".repeat(7), "1 1 1 1 1 3 3");
    let read = read(&bytes, "a.vtp").unwrap();
    let lines: Vec<_> = read.lines.iter().map(|l| (l.points.len(), l.group)).collect();
    assert_eq!(lines, [(3, Some(1)), (2, Some(1)), (3, Some(3))]);
    assert_eq!(read.lines[1].points.last(), read.lines[2].points.first());
}

#[test]
fn repeated_points_and_lines_of_one_place_are_dropped_and_noted() {
    let bytes =
        replaced(sample::vtk(false, false), "LINES 2 9\n3 0 1 2 4 3", "LINES 3 13\n4 0 1 1 2 2 5 5 4 3");
    let bytes = replaced(bytes, "CELL_DATA 3", "CELL_DATA 4");
    let bytes = replaced(bytes, "9 4 5", "9 4 5 6");
    let read = read(&bytes, "a.vtk");
    let read = read.unwrap();
    assert_eq!(read.lines.len(), 2);
    assert_eq!(read.lines[0].points, sample::line(0));
    assert_eq!(read.lines[0].radius.as_deref(), Some(&RADIUS[..3]));
    assert!(read.notes.contains(&"1 line(s) of fewer than two different points were dropped".to_owned()));
    assert!(read.notes.contains(&"2 point(s) equal to the one before were dropped".to_owned()));
}

#[test]
fn content_that_is_no_centerline_file_is_named() {
    assert!(message(b"", "a.vtp").contains("an empty file"));
    assert!(message(b"GIF89a", "a.vtp").contains("expected a VTK XML file"));
    assert!(
        message(b"GIF89a", "a.gif").contains("the name ends in 'gif'); expected a .vtp, .vtk, .mrk.json")
    );
    let grid = replaced(ascii_vtp(), "type=\"PolyData\"", "type=\"ImageData\"");
    assert_eq!(
        message(&grid, "a.vtp"),
        "a.vtp: found a VTK XML file of type 'ImageData'; expected type 'PolyData'"
    );
    let grid = replaced(sample::vtk(false, false), "POLYDATA", "STRUCTURED_GRID");
    assert!(message(&grid, "a.vtk").contains("DATASET: found 'STRUCTURED_GRID'; expected POLYDATA"));
}
