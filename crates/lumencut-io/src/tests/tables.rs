//! Tests of separators, headers, units and lines of tables, and that ambiguous tables are rejected.

use glam::DVec3;

use crate::{Centerlines, Space, Unit, read};

fn ok(content: &str) -> Centerlines {
    read(content.as_bytes(), "a.csv").unwrap_or_else(|error| panic!("{error}"))
}

fn message(content: &str) -> String {
    read(content.as_bytes(), "a.csv").unwrap_err().to_string()
}

const ENDS: [DVec3; 2] = [DVec3::new(12.9013, -2.0, 3.5), DVec3::new(4.0, 5.0, 6.25)];

#[test]
fn every_separator_and_line_end_gives_the_same_points() {
    let rows = [["1.290130000000000088e+01", "-2", "+3.5"], ["4.", "5", "6.25"]];
    for separator in [",", ";", "\t", " ", "  ", ", ", " ;", ",\t"] {
        for end in ["\n", "\r\n", "\r"] {
            let text: String = rows.iter().map(|row| row.join(separator) + end).collect();
            let read = ok(&text);
            assert_eq!(read.lines[0].points, ENDS, "{text:?}");
            assert_eq!((read.unit, read.space, read.lines[0].radius.is_none()), (None, None, true));
            assert_eq!(read.notes, ["no radius in the file"]);
            assert_eq!(ok(&format!("\u{feff}{text}")).lines, read.lines, "with a byte order mark");
        }
    }
    assert_eq!(ok("12,9013;-2;3,5\n4;5;6,25\n").lines[0].points, ENDS, "decimal commas");
    assert_eq!(ok("12.9013,-2,3.5,\n4,5,6.25,\n").lines[0].points, ENDS, "separators at the end");
}

#[test]
fn headers_name_the_columns() {
    let body = "9,12.9013,-2,3.5,1\n9,4,5,6.25,0.5\n";
    for (header, unit, space) in [
        ("i,x,y,z,r", None, None),
        ("i,X [mm],Y [mm],Z [mm],Radius [mm]", Some(Unit::Millimetre), None),
        ("i,x_cm,y_cm,z_cm,radius_cm", Some(Unit::Centimetre), None),
        ("i,x (\u{b5}m),y (\u{3bc}m),z (um),Radius", Some(Unit::Micrometre), None),
        ("i,\"Points:0\",\"Points:1\",\"Points:2\",\"MaximumInscribedSphereRadius\"", None, None),
        ("i,Points_0,Points_1,Points_2,mean_radius", None, None),
        ("i,L,P,S,r", None, Some(Space::Lps)),
        ("i,R,A,S,radius", None, Some(Space::Ras)),
        ("i,x,y,z,radius (mm)", Some(Unit::Millimetre), None),
    ] {
        let read = ok(&format!("{header}\n{body}"));
        assert_eq!(read.lines[0].points, ENDS, "{header}");
        assert_eq!(read.lines[0].radius.as_deref(), Some(&[1.0, 0.5][..]), "{header}");
        assert_eq!((read.unit, read.space), (unit, space), "{header}");
    }
    let read = ok(&format!("i,x,y,z,Diameter\n{body}"));
    assert_eq!(read.lines[0].radius.as_deref(), Some(&[0.5, 0.25][..]));
    assert_eq!(read.notes, ["radius from half the column 'Diameter'"]);
    let read = ok(&format!("i,x [cm],y [cm],z [cm],r [mm]\n{body}"));
    assert_eq!(read.lines[0].radius.as_deref(), Some(&[0.1, 0.05][..]), "in the unit of the points");
    let read = ok(&format!("# made today\n# i,x,y,z,r\n{body}"));
    assert_eq!(read.lines[0].points, ENDS, "a header in a comment");
}

#[test]
fn blank_rows_and_columns_part_lines() {
    let read = ok("\n1 2 3\n1 2 4\n\n \n5 6 7\n5 6 8\n5 6 9\n\n");
    assert_eq!(read.lines.iter().map(|l| l.points.len()).collect::<Vec<_>>(), [2, 3]);
    let read =
        ok("vessel;x;y;z\nLAD;1;2;3\nLAD;1;2;4\n\"R;CA\";0;0;0\n\"R;CA\";0;0;1\nLAD;9;9;9\nLAD;9;9;8\n");
    let names: Vec<_> = read.lines.iter().map(|line| line.name.as_deref().unwrap()).collect();
    assert_eq!(names, ["LAD", "R;CA", "LAD"]);
    assert!(read.notes.iter().any(|note| note.starts_with("rows of one line are not consecutive")));
    let read = ok("x,y,z,GroupIds\n1,2,3,4\n1,2,4,4\n1,2,5,6\n1,2,6,6\n");
    assert_eq!(read.lines.iter().map(|line| line.group).collect::<Vec<_>>(), [Some(4), Some(6)]);
    let read = ok("x,y,z,CenterlineIds,GroupIds\n1,2,3,0,4\n1,2,4,0,5\n1,2,5,1,4\n1,2,6,1,6\n");
    assert!(read.lines.len() == 2 && read.lines.iter().all(|l| l.group.is_none() && l.name.is_none()));
}

#[test]
fn what_is_not_clear_is_refused() {
    assert!(message("1,2\n3,4\n").contains("line 1: found 2 column(s) of numbers without a header"));
    assert!(message("1,2,3,4,5\n").contains("5 column(s) of numbers without a header"));
    assert!(message("0,1,2,3\n1,1,2,4\n2,1,2,5\n").contains("a row number"));
    assert!(message("x,y\n1,2\n").contains("line 1: found 'x,y'; expected numbers, or a header"));
    assert!(message("x_m,y_m,z_m\n1,2,3\n").contains("a header that names x, y, z"));
    assert!(message("hello world\n").contains("line 1: found 'hello world'"));
    assert!(message("1,2,3\n4,5\n").contains("line 2: found 2 column(s), '4,5'; expected 3 columns"));
    assert!(message("1,2,3\n4,five,6\n").contains("line 2: found 'five'; expected a finite number"));
    for wrong in ["nan", "inf", "-infinity", "1e400", ""] {
        let text = format!("1,2,3\r\n4,{wrong},6\r\n");
        assert!(message(&text).contains(&format!("line 2: found '{wrong}'; expected a finite number")));
    }
    assert!(
        message("x (px),y (px),z (px)\n1,2,3\n").contains("line 1: unit of the column 'x (px)': found 'px'")
    );
    assert!(message("# x (px),y (px),z (px)\n1,2,3\n").contains("line 1: unit of the column"));
    assert!(message("1 8 2 3 0\n2 8 2 3 0\n").contains("a row number"), "five columns");
    assert!(message("x (cm),y (mm),z (mm)\n1,2,3\n").contains("one unit for all three"));
    assert!(message("1,5 2,5 3,5\n1,5 2,5 4,5\n").contains("line 1"));
    assert!(message("1,2,3,4\n1,2,4,-1\n").contains("radius of line 0: found -1 at point 1"));
    assert!(message("# only a comment\n").contains("no row"));
    assert!(message("x_cm,y_cm,z_cm\n0,0,0\n200000,0,0\n").contains("at most 1e5 cm"));
}

#[test]
fn a_list_of_points_that_jumps_is_parted_where_no_column_tells_lines_apart() {
    let row = |x: f64, y: f64| format!("{x},{y},0\n");
    let tree: String =
        (0..12).map(|i| row(f64::from(i), 0.0)).chain((0..9).map(|i| row(4.0, f64::from(i)))).collect();
    assert_eq!(ok(&tree).lines.len(), 1, "a step back of 7.07 is no jump");
    let far: String =
        (0..12).map(|i| row(f64::from(i), 0.0)).chain((0..9).map(|i| row(40.0, f64::from(i)))).collect();
    let parted = ok(&far);
    assert_eq!(parted.lines.iter().map(|line| line.points.len()).collect::<Vec<_>>(), [12, 9]);
    assert!(parted.notes.iter().any(|note| note.contains("split into 2 lines")), "{:?}", parted.notes);
    let named =
        "line,x,y,z\n".to_owned() + &far.lines().map(|line| format!("a,{line}\n")).collect::<String>();
    assert_eq!(ok(&named).lines.len(), 1, "the column says that it is one line");
    assert_eq!(ok("0,0,0\n1,0,0\n200,0,0\n").lines.len(), 1, "too few points to tell");
}

#[test]
fn a_line_whose_points_stand_further_apart_in_a_part_stays_one() {
    let dense = (0..100).map(|i| f64::from(i) * 0.1);
    let list = |further: &[f64]| -> String {
        dense.clone().chain(further.iter().copied()).map(|x| format!("{x},0,0\n")).collect()
    };
    for further in [&[14.9, 19.9, 24.9][..], &[14.9], &[14.9, 14.9, 22.9, 27.0]] {
        let read = ok(&list(further));
        let last = read.lines[0].points.last().map(|p| p.x);
        assert_eq!((read.lines.len(), last), (1, further.last().copied()));
        assert!(read.notes.iter().any(|note| note.contains("were not split")), "{:?}", read.notes);
    }
    let parted = ok(&list(&[50.0, 50.1, 50.2]));
    assert_eq!(parted.lines.iter().map(|line| line.points.len()).collect::<Vec<_>>(), [100, 3]);
    let repeated = ok(&list(&[9.9, 50.0, 50.0, 50.1, 50.2]));
    assert_eq!(repeated.lines.iter().map(|line| line.points.len()).collect::<Vec<_>>(), [100, 3]);
}

#[test]
fn only_a_column_that_names_a_radius_is_one() {
    for other in ["gradient", "Gradient Magnitude", "radius_of_curvature", "CurvatureRadius", "radians"] {
        let read = ok(&format!("x,y,z,{other}\n1.5,2,3,7\n1.5,2,4,7\n"));
        assert_eq!(
            (read.lines[0].radius.is_none(), read.notes),
            (true, vec!["no radius in the file".into()])
        );
    }
    let read = ok("x,y,z,r\n1.5,2,3,0\n1.5,2,4,0\n");
    assert!(
        read.lines[0].radius.is_none() && read.notes.iter().any(|note| note.contains("every radius is 0"))
    );
    let read = ok("x,y,z,r\n1.5,2,3,0\n1.5,2,4,1\n");
    assert_eq!(read.lines[0].radius.as_deref(), Some(&[0.0, 1.0][..]));
    assert!(message("x,y,z,X,Y,Z\n1,2,3,4,5,6\n").contains("more than one column x"));
    assert_eq!(ok("R,A,S,r\n1.5,2,3,1\n1.5,2,4,1\n").lines[0].radius.as_deref(), Some(&[1.0, 1.0][..]));
}

#[test]
fn what_numbers_without_names_may_be_is_noted() {
    let notes = |content: &str| ok(content).notes.join("; ");
    assert!(notes("1.5 2 3 4\n1.5 2 4 5\n").contains("radius from the unnamed fourth column"));
    assert!(notes("1.5 2 3 1\n1.5 2 4 1\n").contains("fourth column (1 everywhere)"));
    assert!(notes("1 2 3\n1 2 4\n").contains("may be voxel indices"));
    assert_eq!(notes("x,y,z,r\n1,2,3,1\n1,2,4,1\n"), "radius from the column 'r'");
}

#[test]
fn units_in_comments_are_taken_or_noted() {
    let rows = "1.5 2 3\n1.5 2 4\n";
    for stated in ["# units: cm", "#unit = cm", "# Units (cm)", "# UNITS cm."] {
        let read = ok(&format!("{stated}\n{rows}"));
        let taken = read.notes.iter().any(|note| note.contains("from the comment"));
        assert_eq!((read.unit, taken), (Some(Unit::Centimetre), true), "{stated}");
    }
    for said in ["# all lengths in cm, from a model", "# unit cm or mm", "# step (cm)"] {
        let read = ok(&format!("{said}\n{rows}"));
        assert_eq!(read.unit, None, "{said}");
        assert!(read.notes.iter().any(|note| note.contains("was not taken as the unit")), "{said}");
    }
    assert_eq!(ok(&format!("# x (cm) y (cm) z (cm)\n{rows}")).unit, Some(Unit::Centimetre));
    assert!(message(&format!("# x y z (cm)\n{rows}")).contains("one unit for all three"));
    assert_eq!(ok("# units: cm\nx (mm),y (mm),z (mm)\n1,2,3\n1,2,4\n").unit, Some(Unit::Millimetre));
}

#[test]
fn the_first_row_of_a_spreadsheet_may_name_its_separator() {
    for first in ["sep=;", "\"sep=;\"", "sep=;\r"] {
        assert_eq!(ok(&format!("{first}\nx;y;z\n12,9013;-2;3,5\n4;5;6,25\n")).lines[0].points, ENDS);
        assert_eq!(ok(&format!("{first}\n12,9013;-2;3,5\n4;5;6,25\n")).lines[0].points, ENDS);
    }
}

/// Header of the table of control points that 3D Slicer writes.
const SLICER: &str = "label,r,a,s,defined,selected,visible,locked,description";

#[test]
fn empty_last_fields_are_fields() {
    let points = [DVec3::new(30.5, -35.0, 100.0), DVec3::new(30.0, -35.25, 102.0)];
    for (first, second) in [("", ""), ("\"\"", "\"\""), ("", "ostium"), ("x", ""), (" ", "\"a, b\"")] {
        for separator in [",", ";", "\t"] {
            for end in ["\n", "\r\n"] {
                let row = |place: &str, last: &str| {
                    let last = last.replace(", ", &format!("{separator} "));
                    format!("C-1,{place},1,1,1,0,").replace(',', separator) + &last + end
                };
                let head = SLICER.replace(',', separator) + end;
                let text = head + &row("30.5,-35,100", first) + &row("30,-35.25,102", second);
                for mark in ["", "\u{feff}"] {
                    let read = ok(&format!("{mark}{text}"));
                    assert_eq!((&read.lines[0].points[..], read.space), (&points[..], Some(Space::Ras)));
                    assert_eq!(read.notes, ["no radius in the file"], "{text:?}");
                }
            }
        }
    }
    // Separators at the end of a row are not missing fields.
    assert_eq!(ok("x,y,z\n1,2,3,,,\n1,2,4,,,\n").lines[0].points.len(), 2);
    assert!(
        message("x,y,z,name\n1,2,3\n").contains("line 2: found 3 column(s), '1,2,3'; expected 4 columns")
    );
    assert!(message("x,y,z\n1,2,3,,5\n").contains("found 5 column(s)"));
}

#[test]
fn points_that_are_not_defined_are_left_out_and_counted() {
    let rows = |defined: [&str; 4]| -> String {
        let row = |(i, defined): (usize, &&str)| {
            let place = if *defined == "1" { format!("{i},2,3") } else { ["0,0,0", ",,"][i % 2].into() };
            format!("C-{i},{place},{defined},1,1,0,x\n")
        };
        format!("{SLICER}\n") + &defined.iter().enumerate().map(row).collect::<String>()
    };
    let read = ok(&rows(["1", "0", "0", "1"]));
    assert_eq!(read.lines[0].points, [DVec3::new(0.0, 2.0, 3.0), DVec3::new(3.0, 2.0, 3.0)]);
    assert!(read.notes.contains(&"2 undefined point(s) were left out".into()), "{:?}", read.notes);
    assert_eq!(ok(&rows(["0", "False", "1", "1"]).replace("2,2,3,1", "2,2,3,TRUE")).lines[0].points.len(), 2);
    for few in [["0"; 4], ["0", "0", "0", "1"]] {
        let expected = "undefined point(s); expected at least 2 defined points";
        assert!(message(&rows(few)).contains(expected), "{}", message(&rows(few)));
    }
    assert!(message(&rows(["1", "1", "perhaps", "1"])).contains("line 4: column 'defined': found 'perhaps'"));
    let by_status =
        "x,y,z,positionStatus\n1,2,3,defined\n0,0,0,undefined\n0,0,0,preview\n0,0,0,missing\n1,2,4,defined\n";
    let placed = message(&by_status.replace("preview", "placed"));
    assert!(placed.contains("line 4: column 'positionStatus': found 'placed'"), "{placed}");
    assert_eq!(ok(by_status).lines[0].points.len(), 2);
}

#[test]
fn empty_radii_are_unknown() {
    for missing in ["", "\"\"", "nan", "NaN", "NA"] {
        let text = format!("x,y,z,radius\n1,2,3,{missing}\n1,2,4,2.5\n1,2,5,{missing}\n1,2,6,1\n");
        let read = ok(&text);
        assert_eq!(read.lines[0].radius.as_deref(), Some(&[0.0, 2.5, 0.0, 1.0][..]), "0 is unknown");
        assert!(read.notes.contains(&"2 of 4 radii are missing".into()), "{:?}", read.notes);
        let read =
            ok(&format!("line,x,y,z,diameter\na,1,2,3,{missing}\na,1,2,4,{missing}\nb,5,2,3,2\nb,5,2,4,2\n"));
        assert_eq!((&read.lines[0].radius, read.lines[1].radius.as_deref()), (&None, Some(&[1.0, 1.0][..])));
        assert!(read.notes.contains(&"1 of 2 lines have no radius".into()), "{:?}", read.notes);
    }
    for text in ["1,2.5,3,\n1,2.5,4,2\n", "1,2.5,3,2\n1,2.5,4,\n"] {
        let radius = ok(text).lines[0].radius.clone().expect("a fourth column");
        assert_eq!(radius.iter().filter(|r| **r == 0.0).count(), 1, "{text}");
    }
    assert!(message("x,y,z,r\n1,2,3,wide\n").contains("line 2: found 'wide'; expected a finite number"));
}

#[test]
fn quoted_fields_hold_separators_quotes_and_line_ends() {
    for (description, end) in
        [("a, b", "\n"), ("two\nlines", "\n"), ("two\r\nlines, \"\"x\"\"\r\n", "\r\n"), ("\n", "\n")]
    {
        let row = |z: f64| format!("C,30,-35,{z},1,1,1,0,\"{description}\"{end}");
        let read = ok(&(SLICER.to_owned() + end + &row(1.5) + &row(2.5) + &row(3.5)));
        let z: Vec<f64> = read.lines[0].points.iter().map(|p| p.z).collect();
        assert_eq!(z, [1.5, 2.5, 3.5], "{description:?}");
    }
    // An inch mark within a field does not start a quotation.
    assert_eq!(ok("name,x,y,z\n5\" wire,1,2,3\n5\" wire,1,2,4\n").lines[0].points.len(), 2);
    let open = message("x,y,z,name\n1,2,3,\"a\n1,2,4,b\n");
    assert!(open.contains("line 2: found an unclosed quotation mark"), "{open}");
}
