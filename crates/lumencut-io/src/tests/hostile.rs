//! Tests with content of other formats, and with content that is expensive to read.

use crate::{junctions, read};

fn message(content: &[u8], name: &str) -> String {
    read(content, name).unwrap_err().to_string()
}

const NAMES: [&str; 12] = [
    "a.vtp",
    "a.vtk",
    "a.mrk.json",
    "a.pth",
    "a.swc",
    "a.tre",
    "a.fcsv",
    "reference.txt",
    "a.csv",
    "a.txt",
    "a.npy",
    "a",
];

#[test]
fn foreign_content_is_refused_under_every_name() {
    let utf16: Vec<u8> = "\u{feff}x,y,z\n1,2,3\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let garbage: Vec<u8> = (0..4096u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    for name in NAMES {
        assert!(message(b"", name).contains("an empty file"), "{name}");
        assert!(
            message(&utf16, name).contains("text in UTF-16; expected a centerline file; save it as UTF-8")
        );
        assert!(message(b"\x1f\x8b\x08\0", name).contains("a gzip file"), "{name}");
        assert!(message(b"PK\x03\x04\0", name).contains("archive"), "{name}");
        for content in
            [&garbage[..], b"\xef\xbb\xbf", b"\n\n\n", b"#", b"\0\0\0\0", b",,,\n,,,\n", b"<", b"{"]
        {
            assert!(message(content, name).starts_with(name), "{name}");
        }
    }
    assert!(message(&utf16[2..], "a.csv").contains("found binary content"), "UTF-16 without its mark");
}

#[test]
fn a_line_of_ten_megabytes_is_refused_without_delay() {
    for unit in ["1 ", "1,", "1;", "1", "a", "\"", "<a>", "<", "x=", "[", "# "] {
        let line = unit.repeat(10_000_000 / unit.len());
        for name in ["a.csv", "a.swc", "a.tre", "a.fcsv", "reference.txt", "a.pth"] {
            assert!(message(line.as_bytes(), name).len() < 400);
        }
    }
}

#[test]
fn many_small_objects_take_no_long_time() {
    let tubes: String = (0..20_000)
        .map(|i| format!("ObjectType = Tube\nNDims = 3\nID = {i}\nParentID = {}\nPointDim = x y z\nNPoints = 0\nPoints =\n", i - 1))
        .collect();
    assert!(message(tubes.as_bytes(), "a.tre").contains("more than 64 parents"));
    let star: String = "1 0 0 0 0 1 -1\n".to_owned()
        + &(2..100_000).map(|i| format!("{i} 0 {i} 1 1 1 1\n")).collect::<String>();
    assert_eq!(read(star.as_bytes(), "a.swc").unwrap().lines.len(), 99_998);
    let keys: String =
        "line,x,y,z\n".to_owned() + &(0..100_000).map(|i| format!("{},{i},0,0\n", i / 2)).collect::<String>();
    assert_eq!(read(keys.as_bytes(), "a.csv").unwrap().lines.len(), 50_000);
}

#[test]
fn a_million_points_are_read() {
    let swc: String = (1..=1_000_000)
        .map(|i| format!("{i} 0 {}.125 2.5 3.25 1.5 {}\n", i % 2, if i == 1 { -1 } else { i - 1 }))
        .collect();
    let csv: String = (1..=1_000_000).map(|i| format!("{}.125,2.5,3.25,1.5\n", i % 2)).collect();
    for (content, name) in [(swc, "a.swc"), (csv, "a.csv")] {
        assert_eq!(read(content.as_bytes(), name).unwrap().lines[0].points.len(), 1_000_000);
    }
}

#[test]
fn vessels_keep_what_the_file_states() {
    let read = read(b"x_cm,y_cm,z_cm\n1,2,3\n1,2,4\n", "a.csv").unwrap();
    let vessels = junctions::vessels(read.clone().scaled(10.0).unwrap());
    assert_eq!((vessels.unit, vessels.format), (read.unit, "text table"));
    assert_eq!(vessels.conventional_unit, read.conventional_unit);
}
