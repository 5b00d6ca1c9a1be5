//! Tests of SimVascular, SWC, ITK tubes, fiducials, Rotterdam references and NumPy arrays.

use glam::DVec3;

use super::sample::{self, POINTS, RADIUS};
use crate::{Centerlines, Space, Unit, read};

fn ok(content: impl AsRef<[u8]>, name: &str) -> Centerlines {
    read(content.as_ref(), name).unwrap_or_else(|error| panic!("{error}"))
}

fn message(content: impl AsRef<[u8]>, name: &str) -> String {
    read(content.as_ref(), name).unwrap_err().to_string()
}

fn lengths(read: &Centerlines) -> Vec<usize> {
    read.lines.iter().map(|line| line.points.len()).collect()
}

#[test]
fn the_same_tree_is_read_from_every_format() {
    let vtp = ok(sample::vtp(sample::styles()[0]), "a.vtp");
    for (content, name, format) in sample::other_files() {
        let read = ok(&content, name);
        assert_eq!(read.format, format);
        let count = read.lines.len();
        let expected = &vtp.lines[..count];
        for (line, expected) in read.lines.iter().zip(expected) {
            assert_eq!(line.points, expected.points, "{format}");
            assert!(line.radius.is_none() || line.radius == expected.radius, "{format}");
        }
        let silent = read.lines.iter().all(|line| line.radius.is_none());
        assert_eq!(read.notes.iter().any(|note| note == "no radius in the file"), silent, "{format}");
        assert_eq!(count == 1, !matches!(format, "SimVascular path" | "SWC" | "ITK tube" | "text table"));
    }
}

#[test]
fn simvascular_paths_come_with_one_root_or_two() {
    let two = String::from_utf8(sample::pth()).unwrap();
    let read = ok(&two, "a.pth");
    assert_eq!((read.unit, read.conventional_unit), (None, Some(Unit::Centimetre)));
    assert_eq!(read.space, None);
    let one = two.replace("<format version=\"1.0\"/>", "");
    assert_eq!(ok(&one, "other.xml").lines, read.lines, "told by its content");
    let later = one.replacen("</path>", "<timestep id=\"1\"><path_element><path_points><path_point id=\"0\"><pos x=\"9\" y=\"9\" z=\"9\"/></path_point></path_points></path_element></timestep></path>", 1);
    let read_later = ok(&later, "a.pth");
    assert_eq!(read_later.lines, read.lines);
    assert!(read_later.notes.contains(&"1 time step(s) after the first were ignored".to_owned()));
}

#[test]
fn simvascular_paths_without_points_take_the_control_points() {
    let path = "<path id=\"1\"><timestep id=\"0\"><path_element><control_points>\
                <point id=\"0\" x=\"1\" y=\"2\" z=\"3\"/><point id=\"1\" x=\"4\" y=\"5\" z=\"6\"/>\
                </control_points><path_points></path_points></path_element></timestep></path>";
    let read = ok(path, "a.pth");
    assert_eq!(read.lines[0].points, [DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 6.0)]);
    assert!(read.notes[0].starts_with("no path points"));
    assert!(
        message(path.replace("x=\"4\"", "x=\"1e400\""), "a.pth").contains("x of <point> 1: found '1e400'")
    );
    assert!(message(path.replace(" y=\"5\"", ""), "a.pth").contains("y of <point> 1: found ''"));
    assert!(message(&path[..path.len() - 7], "a.pth").contains("no end of the element 'path'"));
    let entity =
        path.replace("<path id", "<!DOCTYPE p [<!ENTITY a \"9\">]><path id").replace("\"4\"", "\"&a;\"");
    assert!(message(entity, "a.pth").contains("found a document type (<!DOCTYPE)"));
    assert!(message(path.replace("\"4\"", "\"&a;\""), "a.pth").contains("damaged XML attributes"));
    assert!(message("<path></path>", "a.pth").contains("XML without a path_element"));
}

#[test]
fn swc_branches_share_their_ends_whatever_the_order_of_nodes() {
    let tree = "# comment \u{b5}\r\n4 3 0 0 3 1 3\r\n1 1 0 0 0 2 -1\r\n3 3 0 0 2 1.5 2\r\n2 3 0 0 1 1.75 1\r\n\
                5 3 0 1 3 1 3\r\n6 3 0 2 4 0.5 5\r\n9 3 5 5 5 1 -1\r\n";
    let read = ok(tree, "a.swc");
    assert_eq!(lengths(&read), [3, 2, 3]);
    let fork = DVec3::new(0.0, 0.0, 2.0);
    assert_eq!(read.lines[0].points, [DVec3::ZERO, DVec3::Z, fork]);
    assert_eq!([read.lines[1].points[0], read.lines[2].points[0]], [fork; 2]);
    assert_eq!(read.lines[2].radius.as_deref(), Some(&[1.5, 1.0, 0.5][..]));
    assert!(read.notes[0].starts_with("1 line(s) of fewer than two"), "the root without children");
    assert_eq!(ok(tree, "a.txt").format, "SWC", "told by its content");
    let scaled = ok(format!("# SCALE 1.0 1.0 1.0\n{tree}"), "a.swc");
    assert_eq!(scaled.notes, read.notes);
    let scaled = ok(format!("# SCALE 0.5 0.5 2\n{tree}"), "a.swc");
    assert_eq!(scaled.notes[0], "the comment 'SCALE 0.5 0.5 2' was not applied");
    assert!(message("1 1 0 0 0 2 0\n2 1 0 0 1 2 1\n", "a.swc").ends_with("write -1 as the parent of roots"));
    let zero = ok("1 1 0 0 0 0 -1\n2 1 0 0 1 0 1\n", "a.swc");
    assert!(zero.lines[0].radius.is_none() && zero.notes[0].contains("every radius is 0"));
    let unnamed = ok(sample::npy(&[[1.5, 2.0, 3.0, 1.0], [1.5, 2.0, 4.0, 1.0]], 4, "<f8", false, 1), "a.npy");
    assert_eq!(unnamed.notes, ["radius from the unnamed fourth column (1 everywhere)"]);
    assert_eq!(ok("1.0 1 0 0 0 2 -1.0\n2.0 1 0 0 1 2 1.0", "a.swc").lines.len(), 1);
}

#[test]
fn swc_errors_name_the_line() {
    let swc = |nodes: &str| message(format!("1 0 0 0 0 1 -1\n{nodes}\n"), "a.swc");
    assert!(swc("2 0 0 0 1 1 7").contains("line 2: found the parent 7, which is not a node"));
    assert!(swc("1 0 0 0 1 1 -1").contains("line 2: found the id 1 again, first used in line 1"));
    assert!(
        swc("2 0 0 0 1 1 3\n3 0 0 0 2 1 2").contains("line 2: found the node 2, whose parents form a cycle")
    );
    assert!(swc("2 0 0 0 1 1 2").contains("form a cycle"));
    assert!(swc("2 0 0 0 1 1").contains("line 2: found '2 0 0 0 1 1'; expected 7 numbers"));
    assert!(swc("2 0 0 nan 1 1 1").contains("line 2: found 'nan'; expected a finite number"));
    assert!(swc("2 0 0 1e400 1 1 1").contains("line 2: found '1e400'"));
    assert!(swc("2.5 0 0 0 1 1 1").contains("line 2: found '2.5'; expected a whole number"));
    assert!(swc("2 0 0 0 1 -1 1").contains("radius of line 0: found -1 at point 1"));
    assert!(message("# nothing\n", "a.swc").contains("no node"));
}

fn tube(fields: &str, points: &str) -> String {
    format!(
        "ObjectType = Scene\nNDims = 3\nNObjects = 1\nObjectType = Tube\nObjectSubType = Vessel\nNDims = 3\n{fields}\n\
         PointDim = id x y z red mark r\nNPoints = 2\nPoints = \n{points}\n"
    )
}

const TWO: &str = "0 1 2 3 0 1 0.5\n1 4 5 6 0 1 0.25";

#[test]
fn tubes_stand_in_steps_of_the_spacing_under_their_transforms() {
    let read = ok(tube("ID = 3\nParentID = -1\nName = LCA\nElementSpacing = 2 2 4", TWO), "a.tre");
    assert_eq!(read.lines[0].points, [DVec3::new(2.0, 4.0, 12.0), DVec3::new(8.0, 10.0, 24.0)]);
    assert_eq!(read.lines[0].radius.as_deref(), Some(&[1.0, 0.5][..]));
    assert_eq!(read.lines[0].name.as_deref(), Some("LCA"));
    assert_eq!((read.unit, read.space), (Some(Unit::Millimetre), Some(Space::Lps)));
    let turned = ok(tube("TransformMatrix = 0 -1 0 1 0 0 0 0 1\nOffset = 10 20 30", TWO), "a.tre");
    assert_eq!(turned.lines[0].points[0], DVec3::new(10.0 - 2.0, 20.0 + 1.0, 33.0));
    assert_eq!(turned.lines[0].radius.as_deref(), Some(&[0.5, 0.25][..]));
    let scaled = ok(tube("TransformMatrix = 2 0 0 0 2 0 0 0 2", TWO), "a.tre");
    assert_eq!(scaled.lines[0].radius.as_ref().unwrap()[0], 1.0);
}

#[test]
fn transforms_of_parents_apply_and_circles_are_refused() {
    let group = |parent: i32| format!("ObjectType = Group\nID = 7\nParentID = {parent}\nOffset = 0 0 100\n");
    let child = tube("ID = 3\nParentID = 7", TWO);
    let read_child = ok(child.clone() + &group(-1), "a.tre");
    assert_eq!(read_child.lines[0].points[0], DVec3::new(1.0, 2.0, 103.0));
    assert!(read_child.notes.iter().any(|note| note.contains("transforms of parent objects")));
    assert!(message(child.clone() + &group(3), "a.tre").contains("a cycle of parents"));
    let alone = ok(child, "a.tre");
    assert!(alone.notes.iter().any(|note| note.contains("whose parent is not in the file")));
}

#[test]
fn binary_tubes_are_read_in_both_byte_orders() {
    let numbers: Vec<f32> = TWO.split_ascii_whitespace().map(|word| word.parse().unwrap()).collect();
    for msb in [false, true] {
        let bytes: Vec<u8> =
            numbers.iter().flat_map(|n| if msb { n.to_be_bytes() } else { n.to_le_bytes() }).collect();
        let order = if msb { "True" } else { "False" };
        let fields = format!("BinaryData = True\nBinaryDataByteOrderMSB = {order}");
        let text = tube(&fields, "@");
        let (head, _) = text.split_at(text.find('@').unwrap());
        let mut content = head.as_bytes().to_vec();
        content.extend(&bytes);
        // Unused bytes, as older programs leave them, and a second tube.
        content.extend([1; 9]);
        content.extend(tube("", TWO).as_bytes());
        let read = ok(&content, "a.tre");
        assert_eq!(read.lines.len(), 2);
        assert_eq!(read.lines[0], read.lines[1]);
        let cut = head.len() + bytes.len() - 1;
        assert!(message(&content[..cut], "a.tre").contains("Points: found 55 bytes to the end of the file"));
    }
}

#[test]
fn odd_tubes_are_named() {
    let with = |from: &str, to: &str| message(tube("", TWO).replace(from, to), "a.tre");
    assert!(with("NPoints = 2", "NPoints = 99999999999999").contains("found 14 numbers"));
    assert!(with("NPoints = 2", "NPoints = -1").contains("NPoints: found '-1'"));
    assert!(with("x y z", "x y").contains("PointDim"));
    assert!(with("Vessel\nNDims = 3", "Vessel\nNDims = 2").contains("NDims: found '2'; expected 3"));
    assert!(with("4 5 6", "4 nan 6").contains("points of line 0: found [4, NaN, 6]"));
    assert!(with("ObjectSubType = Vessel", "ElementSpacing = 1 0 1").contains("3 numbers above 0"));
    assert!(with("ObjectSubType = Vessel", "TransformMatrix = 1 0").contains("TransformMatrix: found '1 0'"));
    assert!(with("Points = \n", "Point = \n").contains("a MetaIO field"));
    let compressed = with("ObjectSubType = Vessel", "BinaryData = True\nCompressedData = True");
    assert!(compressed.contains("compressed points"));
    assert!(message("ObjectType = Scene\nNDims = 3\n", "a.tre").contains("1 object(s) but no tube"));
    assert!(message("ObjectType = Tube\nNDims = 3\n", "a.tre").contains("no Points"));
}

#[test]
fn fiducials_are_one_line_in_their_space() {
    let head = "# Markups fiducial file version = 4.10\n# CoordinateSystem = 0\n\
                # columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
    let rows =
        "a,1,2,3,0,0,0,1,1,1,0,\"F,1\",,\nb,4,5,6,0,0,0,1,0,1,0,F-2,,,2,0\nc,0,0,0,0,0,0,1,1,1,0,F-3,,,0,0\n";
    let read = ok(head.to_owned() + rows, "a.fcsv");
    assert_eq!(read.lines[0].points, [DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 6.0)]);
    assert_eq!((read.space, read.unit), (Some(Space::Ras), Some(Unit::Millimetre)));
    let notes = read.notes.join("; ");
    assert!(notes.contains("the 2 fiducials are read as one line"), "{notes}");
    assert!(notes.contains("1 fiducial(s) without a position") && notes.contains("1 fiducial(s) hidden"));
    let lps = head.replace("= 0", "= LPS") + rows;
    assert_eq!(ok(lps, "a.csv").space, Some(Space::Lps), "told by its content");
    assert!(
        message(head.replace("= 0", "= IJK") + rows, "a.fcsv")
            .contains("line 2: CoordinateSystem: found IJK")
    );
    assert!(message(head.to_owned() + "a,1,inf,3\n", "a.fcsv").contains("line 4: found 'inf'"));
    assert!(message(head.to_owned() + "a,1,2\n", "a.fcsv").contains("line 4: found 'a,1,2'"));
    let none = message(
        head.to_owned() + "c,0,0,0,0,0,0,1,1,1,0,F-3,,,0,0\nb,4,5,6,0,0,0,1,0,1,0,F-2,,,1,0\n",
        "a.fcsv",
    );
    assert!(none.contains("2 fiducial(s) without a position; expected at least 2 with one"), "{none}");
    let described = rows.replace("F-2,,", "F-2,\"two\nlines, quoted\",");
    assert_eq!(ok(head.to_owned() + &described, "a.fcsv").lines[0].points.len(), 2);
    let old = "# columns = label,x,y,z,sel,visibility\nF,1,2,3,1,1\nF,1,2,4,1,1\n";
    let read = ok(old, "a.fcsv");
    assert_eq!((read.space, read.lines[0].points[1].z), (None, 4.0));
}

#[test]
fn a_point_array_of_vtk_is_a_radius_only_by_its_name() {
    let head = "# vtk DataFile Version 3.0\n-\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n0 0 0\n0 0 9\n\
                LINES 1 3\n2 0 1\nPOINT_DATA 2\n";
    let with = |arrays: &[(&str, &str)]| {
        let of = |(name, values): &(&str, &str)| {
            format!("SCALARS {name} double\nLOOKUP_TABLE default\n{values}\n")
        };
        ok(head.to_owned() + &arrays.iter().map(of).collect::<String>(), "a.vtk").lines[0].radius.clone()
    };
    assert_eq!(with(&[("GradientMagnitude", "3 4")]), None);
    assert_eq!(with(&[("RadiusOfCurvature", "3 4")]), None);
    assert_eq!(with(&[("Radius", "0 0")]), None, "no program knows a vessel of no size");
    assert_eq!(with(&[("Radius", "0 4")]), Some(vec![0.0, 4.0]));
    assert_eq!(with(&[("Diameter", "3 4")]), Some(vec![1.5, 2.0]));
    assert_eq!(with(&[("MinDiameter", "3 4"), ("MeanRadius", "5 6")]), Some(vec![5.0, 6.0]));
}

#[test]
fn references_are_told_by_their_five_columns_or_their_name() {
    let five = "1 2 3 0.5 0.1\n1 2 4 0.5 0.1\n";
    let read = ok(five, "vessel.txt");
    assert_eq!(read.format, "Rotterdam reference");
    assert_eq!((read.space, read.unit), (None, None));
    assert_eq!(ok("1 2 3 0.5\n1 2 4 0.5\n", "Reference.txt").format, "Rotterdam reference");
    assert!(message("1 2 3 0.5 0.1\n1 2 4\n", "reference.txt").contains("line 2: found '1 2 4'"));
}

#[test]
fn arrays_of_every_type_and_order_are_read() {
    for (kind, fortran, version) in [("<f8", false, 1), (">f4", true, 2), ("<i4", false, 3), (">i8", true, 1)]
    {
        let rows: Vec<[f64; 4]> = (0..3).map(|i| [f64::from(i), 2.0, -3.0, 1.0]).collect();
        let read = ok(sample::npy(&rows, 4, kind, fortran, version), "a.npy");
        let points: Vec<DVec3> = rows.iter().map(|r| DVec3::new(r[0], r[1], r[2])).collect();
        assert_eq!(read.lines[0].points, points, "{kind}");
        assert_eq!(read.lines[0].radius.as_deref(), Some(&[1.0; 3][..]));
    }
    let rows = POINTS.map(|[x, y, z]| [x, y, z, RADIUS[0]]);
    let good = sample::npy(&rows[..3], 3, "<f8", false, 1);
    assert!(message(&good[..good.len() - 1], "a.npy").contains("data: found 71 bytes of data"));
    let with = |from: &str, to: &str| {
        let at = good.windows(from.len()).position(|w| w == from.as_bytes()).unwrap();
        let mut bytes = good.clone();
        bytes.splice(at..at + from.len(), to.bytes());
        message(bytes, "a.npy")
    };
    assert!(with("'<f8'", "'|O' ").contains("Python objects (pickle)"));
    assert!(with("'<f8'", "[('x'").contains("one number type for all columns"));
    assert!(with("(3, 3)", "(3, 2)").contains("shape: found (3, 2)"));
    assert!(with("(3, 3)", "(9999999999999999999999, 3)").contains("shape: found"));
    assert!(
        with("(3, 3), }", "(999999999, 3),}").contains("found 72 bytes of data")
            || with("(3, 3)", "(9, 3)").contains("72 bytes")
    );
    assert!(with("\x01\x00", "\x09\x00").contains("version 9"));
    assert!(message(b"PK\x03\x04....", "a.npz").contains("an archive of NumPy arrays (.npz)"));
}
