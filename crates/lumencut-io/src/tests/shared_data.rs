//! Tests on samples from other programs, if the data folder exists.

use std::path::PathBuf;

use crate::junctions::vessels;
use crate::{Centerlines, Line, Space, Unit, read};

fn folder() -> Option<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    if !folder.is_dir() {
        println!("left out: the data folder ../shared/data is not beside the repository");
        return None;
    }
    Some(folder)
}

fn ok(folder: &std::path::Path, name: &str) -> Centerlines {
    let path = folder.join(name);
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
    let name = path.file_name().unwrap().to_string_lossy();
    read(&bytes, &name).unwrap_or_else(|error| panic!("{error}"))
}

fn counts(read: &Centerlines) -> Vec<usize> {
    read.lines.iter().map(|line| line.points.len()).collect()
}

#[test]
fn simvascular_paths_are_whole() {
    let Some(folder) = folder() else { return };
    for (name, count) in [("aorta", 316), ("left-iliac", 90), ("seeds", 100)] {
        let read = ok(&folder, &format!("centerlines/simvascular/{name}.pth"));
        assert_eq!(counts(&read), [count]);
        assert_eq!((read.unit, read.conventional_unit), (None, Some(Unit::Centimetre)));
    }
}

#[test]
fn coronary_tables_are_whole_and_agree_with_their_poly_data() {
    let Some(folder) = folder() else { return };
    // Each coronary tree is one list of points, branch after branch.
    let files: [(&str, &[usize]); 5] = [
        ("aorta", &[75]),
        ("lca", &[385, 91, 123, 124, 365, 4]),
        ("raw", &[188]),
        ("rca", &[463, 176, 36, 27, 116]),
        ("rca_short", &[463, 176, 31, 2, 116]),
    ];
    for (name, points) in files {
        let read = ok(&folder, &format!("centerlines/multimodars/centerline_{name}.csv"));
        assert_eq!((counts(&read).as_slice(), read.format), (points, "text table"), "{name}");
    }
}

#[test]
fn slicer_curves_have_their_radius_space_and_unit() {
    let Some(folder) = folder() else { return };
    for name in ["curve (0)", "curve (10)", "curve - LCCA", "curve - LVA", "curve - RCCA", "curve - RVA"] {
        let read = ok(&folder, &format!("centerlines/slicer/Centerline {name}.mrk.json"));
        assert_eq!((read.space, read.unit), (Some(Space::Lps), Some(Unit::Millimetre)));
        assert!(read.lines.len() == 1 && read.lines[0].radius.is_some(), "{name}");
    }
}

#[test]
fn all_poly_data_variants_are_equal() {
    let Some(folder) = folder() else { return };
    let first = ok(&folder, "formats/vtp_variants/aorta_ascii.vtp");
    assert_eq!(counts(&first).iter().sum::<usize>(), 3545);
    let mut names: Vec<String> = std::fs::read_dir(folder.join("formats/vtp_variants"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names.len(), 11);
    for name in names {
        let read = ok(&folder, &format!("formats/vtp_variants/{name}"));
        if name.contains("ascii_v") {
            let [apart, radius] = farthest(&read.lines, &first.lines);
            assert!(counts(&read) == counts(&first) && apart < 1e-3 && radius < 1e-4, "{name}: six digits");
        } else {
            assert!(read.lines == first.lines, "{name}");
        }
    }
}

/// Largest distance from points of `lines` to the nearest of `others`, and the radius difference there.
fn farthest(lines: &[Line], others: &[Line]) -> [f64; 2] {
    let all: Vec<_> =
        others.iter().flat_map(|line| line.points.iter().zip(line.radius.as_deref().unwrap())).collect();
    let mut out = [0.0f64; 2];
    for line in lines {
        for (point, radius) in line.points.iter().zip(line.radius.as_deref().unwrap()) {
            let near =
                all.iter().min_by(|a, b| a.0.distance(*point).total_cmp(&b.0.distance(*point))).unwrap();
            out = [out[0].max(near.0.distance(*point)), out[1].max((near.1 - radius).abs())];
        }
    }
    out
}

#[test]
fn one_tree_is_the_same_in_all_formats_within_their_digits() {
    let Some(folder) = folder() else { return };
    let vtp = ok(&folder, "formats/vtp_variants/aorta_ascii.vtp");
    let csv = ok(&folder, "formats/aorta_x_y_z_r.csv");
    assert_eq!(counts(&csv), counts(&vtp));
    assert!(csv.notes.contains(&"6 point(s) equal to the one before were dropped".to_owned()));
    let [apart, radius] = farthest(&csv.lines, &vtp.lines);
    assert!(apart < 1e-4 && radius < 1e-4, "{apart} {radius}");
    for (i, points) in [(0, 774), (1, 773)] {
        let reference = ok(&folder, &format!("formats/rotterdam/vessel{i}/reference.txt"));
        assert_eq!((counts(&reference), reference.format), (vec![points], "Rotterdam reference"));
        let [apart, radius] = farthest(&reference.lines, &vtp.lines);
        assert!(apart < 2e-6 && radius < 2e-6, "{apart} {radius}");
    }
    let swc = ok(&folder, "formats/aorta.swc");
    let [apart, radius] = farthest(&swc.lines, &vtp.lines);
    assert!(apart < 1e-3 && radius < 1e-3, "{apart} {radius}");
    let trees = [vtp, csv].map(vessels);
    assert_eq!(trees[0].lines.len(), trees[1].lines.len());
    println!("vtp {} vessels, swc {} vessels", trees[0].lines.len(), vessels(swc).lines.len());
}
