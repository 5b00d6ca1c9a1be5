//! What reading large files of the usual shape takes at its peak: at most ten times the file, in every format.
#![allow(unsafe_code, clippy::unwrap_used)]

#[path = "../fuzz/src/memory.rs"]
mod memory;

use std::fmt::Write as _;
use std::io::Write as _;

use lumencut_io::{Line, junctions, read, write_mrk_json, write_vtp};

const MOST_TIMES: usize = 10;
const BRANCHES: usize = 20;

/// A point and its radius.
type Row = [f64; 4];

/// Branches of a tree, each from a point of the one before, with the digits that programs compute.
fn branches(points: usize) -> Vec<Vec<Row>> {
    let mut random = 0x2545_f491_4f6c_dd1d_u64;
    let mut noise = || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        f64::from((random >> 40) as u32) / f64::from(1 << 24) - 0.5
    };
    let mut out: Vec<Vec<Row>> = Vec::new();
    for branch in 0..BRANCHES {
        let mut at = out.last().map_or([-120.0, 80.0, -400.0, 12.0], |before| before[before.len() / 2]);
        let way = [noise(), noise(), noise()];
        let mut rows = vec![at];
        for _ in 1..points / BRANCHES + branch {
            (0..3).for_each(|axis| at[axis] += (way[axis] + 0.2 * noise()) * 0.05);
            at[3] = (at[3] + 0.01 * noise()).clamp(0.5, 15.0);
            rows.push(at);
        }
        out.push(rows);
    }
    out
}

fn text(tree: &[Vec<Row>], head: &str, row: impl Fn(usize, usize, &Row) -> String) -> Vec<u8> {
    let mut out = head.to_owned();
    for (i, rows) in tree.iter().enumerate() {
        rows.iter().enumerate().for_each(|(k, values)| out.push_str(&row(i, k, values)));
    }
    out.into_bytes()
}

fn swc(tree: &[Vec<Row>]) -> Vec<u8> {
    let mut out = String::new();
    let (mut id, mut parent) = (0, -1);
    for rows in tree {
        let begin = id + 1 - i64::from(parent > 0);
        for [x, y, z, r] in rows.iter().skip(usize::from(parent > 0)) {
            id += 1;
            writeln!(out, "{id} 3 {x:.4} {y:.4} {z:.4} {r:.4} {parent}").unwrap();
            parent = id;
        }
        parent = begin + (rows.len() / 2) as i64;
    }
    out.into_bytes()
}

fn pth(tree: &[Vec<Row>]) -> Vec<u8> {
    let mut out = String::new();
    for (i, rows) in tree.iter().enumerate() {
        write!(out, "<path id=\"{i}\"><timestep id=\"0\"><path_element><path_points>\n").unwrap();
        for (k, [x, y, z, _]) in rows.iter().enumerate() {
            write!(out, "<path_point id=\"{k}\">\n<pos x=\"{x}\" y=\"{y}\" z=\"{z}\" />\n</path_point>\n")
                .unwrap();
        }
        out.push_str("</path_points></path_element></timestep></path>\n");
    }
    out.into_bytes()
}

fn tre(tree: &[Vec<Row>], binary: bool) -> Vec<u8> {
    let mut out = Vec::new();
    for (i, rows) in tree.iter().enumerate() {
        let count = rows.len();
        write!(out, "ObjectType = Tube\nNDims = 3\nID = {i}\nBinaryData = {binary}\nPointDim = x y z r\nNPoints = {count}\nPoints = \n").unwrap();
        for row in rows {
            if binary {
                row.iter().for_each(|v| out.extend((*v as f32).to_le_bytes()));
            } else {
                let [x, y, z, r] = row;
                writeln!(out, "{x:.5} {y:.5} {z:.5} {r:.4}").unwrap();
            }
        }
        out.push(b'\n');
    }
    out
}

fn npy(tree: &[Vec<Row>], columns: usize, wide: bool) -> Vec<u8> {
    let rows: Vec<&Row> = tree.iter().flatten().collect();
    let kind = if wide { "<f8" } else { "<f4" };
    let head =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}, {columns}), }}\n", rows.len());
    let mut out = b"\x93NUMPY\x01\x00".to_vec();
    out.extend((head.len() as u16).to_le_bytes());
    out.extend(head.bytes());
    for value in rows.iter().flat_map(|row| &row[..columns]) {
        if wide {
            out.extend(value.to_le_bytes());
        } else {
            out.extend((*value as f32).to_le_bytes());
        }
    }
    out
}

fn slicer(tree: &[Vec<Row>]) -> Vec<u8> {
    let mut out = "{\n    \"markups\": [\n".to_owned();
    for (i, rows) in tree.iter().enumerate() {
        out.push_str(if i > 0 { ",\n" } else { "" });
        out.push_str("{\n \"type\": \"Curve\",\n \"coordinateSystem\": \"LPS\",\n \"controlPoints\": [\n");
        for (k, [x, y, z, _]) in rows.iter().enumerate() {
            out.push_str(if k > 0 { ",\n" } else { "" });
            write!(out, "{{\n \"id\": \"{k}\",\n \"label\": \"C-{k}\",\n \"position\": [{x}, {y}, {z}],\n \"orientation\": [-1.0, -0.0, -0.0, -0.0, -1.0, -0.0, 0.0, 0.0, 1.0],\n \"selected\": true,\n \"positionStatus\": \"defined\"\n}}").unwrap();
        }
        out.push_str("]}");
    }
    (out + "]}\n").into_bytes()
}

/// One array of a poly data: its numbers as text and as bytes.
struct Numbers {
    name: &'static str,
    kind: &'static str,
    values: Vec<f64>,
}

impl Numbers {
    fn bytes(&self, big: bool) -> Vec<u8> {
        let ordered = |mut bytes: [u8; 4]| {
            if big {
                bytes.reverse();
            }
            bytes
        };
        let number = |v: &f64| {
            ordered(if self.kind == "Int32" { (*v as i32).to_le_bytes() } else { (*v as f32).to_le_bytes() })
        };
        self.values.iter().flat_map(number).collect()
    }

    fn text(&self) -> String {
        self.values.iter().fold(String::new(), |out, v| out + &(*v as f32).to_string() + " ")
    }
}

/// Points, radii, offsets and point ids.
fn arrays(tree: &[Vec<Row>]) -> [Numbers; 4] {
    let rows: Vec<&Row> = tree.iter().flatten().collect();
    let ends = tree
        .iter()
        .scan(0, |end, rows| {
            *end += rows.len();
            Some(*end as f64)
        })
        .collect();
    [
        Numbers {
            name: "Points",
            kind: "Float32",
            values: rows.iter().flat_map(|row| row[..3].to_vec()).collect(),
        },
        Numbers { name: "Radius", kind: "Float32", values: rows.iter().map(|row| row[3]).collect() },
        Numbers { name: "offsets", kind: "Int32", values: ends },
        Numbers { name: "connectivity", kind: "Int32", values: (0..rows.len()).map(|i| i as f64).collect() },
    ]
}

fn vtk(tree: &[Vec<Row>], binary: bool) -> Vec<u8> {
    let [points, radius, ends, ids] = arrays(tree);
    let count = ids.values.len();
    let encoding = if binary { "BINARY" } else { "ASCII" };
    let mut out = format!("# vtk DataFile Version 3.0\nt\n{encoding}\nDATASET POLYDATA\n").into_bytes();
    let mut cells = Numbers { name: "", kind: "Int32", values: Vec::new() };
    let mut start = 0;
    for end in &ends.values {
        let end = *end as usize;
        cells.values.push((end - start) as f64);
        cells.values.extend(&ids.values[start..end]);
        start = end;
    }
    let mut section = |head: String, numbers: &Numbers| {
        out.extend(head.bytes());
        out.extend(if binary { numbers.bytes(true) } else { numbers.text().into_bytes() });
        out.push(b'\n');
    };
    section(format!("POINTS {count} float\n"), &points);
    section(format!("LINES {} {}\n", ends.values.len(), cells.values.len()), &cells);
    section(format!("POINT_DATA {count}\nSCALARS Radius float\nLOOKUP_TABLE default\n"), &radius);
    out
}

/// Every segment a line of its own.
fn segments(tree: &[Vec<Row>]) -> Vec<u8> {
    let rows: Vec<&Row> = tree.iter().flatten().collect();
    let mut out =
        format!("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS {} float\n", rows.len());
    rows.iter().for_each(|[x, y, z, _]| writeln!(out, "{} {} {}", *x as f32, *y as f32, *z as f32).unwrap());
    writeln!(out, "LINES {} {}", rows.len() - 1, 3 * (rows.len() - 1)).unwrap();
    (1..rows.len()).for_each(|i| writeln!(out, "2 {} {i}", i - 1).unwrap());
    out.into_bytes()
}

fn zlib(content: &[u8]) -> Vec<u8> {
    let blocks: Vec<Vec<u8>> = content
        .chunks(32768)
        .map(|block| {
            let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
            encoder.write_all(block).unwrap();
            encoder.finish().unwrap()
        })
        .collect();
    let head = [blocks.len(), 32768, content.len() % 32768].into_iter().chain(blocks.iter().map(Vec::len));
    let mut out: Vec<u8> = head.flat_map(|n| (n as u32).to_le_bytes()).collect();
    out.extend(blocks.concat());
    out
}

fn vtp(tree: &[Vec<Row>], format: &str) -> Vec<u8> {
    let arrays = arrays(tree);
    let mut data = Vec::new();
    let elements = arrays.each_ref().map(|array| {
        let head = format!("<DataArray Name=\"{}\" type=\"{}\"", array.name, array.kind);
        if format == "ascii" {
            return format!("{head} format=\"ascii\">\n{}\n</DataArray>", array.text());
        }
        let at = data.len();
        let bytes = array.bytes(false);
        if format == "zlib" {
            data.extend(zlib(&bytes));
        } else {
            data.extend((bytes.len() as u32).to_le_bytes());
            data.extend(bytes);
        }
        format!("{head} format=\"appended\" offset=\"{at}\"/>")
    });
    let [points, radius, ends, ids] = &elements;
    let compressor = if format == "zlib" { " compressor=\"vtkZLibDataCompressor\"" } else { "" };
    let text = format!(
        "<VTKFile type=\"PolyData\"{compressor}><PolyData><Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\">\n\
         <PointData>{radius}</PointData><Points>{points}</Points><Lines>{ids}{ends}</Lines></Piece></PolyData>",
        arrays[3].values.len(),
        tree.len()
    );
    match format {
        "ascii" => (text + "</VTKFile>\n").into_bytes(),
        _ => [text.as_bytes(), b"<AppendedData encoding=\"raw\">_", &data, b"</AppendedData></VTKFile>"]
            .concat(),
    }
}

/// Every line from the root on, as tools write them that go to every outlet.
fn with_trunks(tree: &[Vec<Row>]) -> Vec<Vec<Row>> {
    let mut out: Vec<Vec<Row>> = Vec::new();
    for rows in tree {
        let trunk = out.last().map_or(&[][..], |before| {
            let at = before.iter().position(|row| row == &rows[0]).unwrap_or(0);
            &before[at.saturating_sub(2000)..at]
        });
        out.push([trunk, rows].concat());
    }
    out
}

fn lines(tree: &[Vec<Row>]) -> Vec<Line> {
    let line = |rows: &Vec<Row>| Line {
        points: rows.iter().map(|[x, y, z, _]| [*x, *y, *z].into()).collect(),
        radius: Some(rows.iter().map(|row| row[3]).collect()),
        ..Line::default()
    };
    tree.iter().map(line).collect()
}

#[test]
fn no_large_file_takes_more_than_ten_times_its_size() {
    let mut wrong = Vec::new();
    for count in [100_000, 140_000] {
        let tree = branches(count);
        let files = [
            ("ascii", "a.vtp", vtp(&tree, "ascii")),
            ("raw", "a.vtp", vtp(&tree, "raw")),
            ("zlib", "a.vtp", vtp(&tree, "zlib")),
            ("zlib, trunks", "a.vtp", vtp(&with_trunks(&tree), "zlib")),
            ("ascii, trunks", "a.vtp", vtp(&with_trunks(&tree), "ascii")),
            ("written", "a.vtp", write_vtp(&lines(&tree)).unwrap()),
            ("ascii", "a.vtk", vtk(&tree, false)),
            ("binary", "a.vtk", vtk(&tree, true)),
            ("segments", "a.vtk", segments(&tree)),
            ("Slicer's", "a.mrk.json", slicer(&tree)),
            ("written", "a.mrk.json", write_mrk_json(&lines(&tree)).unwrap()),
            ("", "a.pth", pth(&tree)),
            ("", "a.swc", swc(&tree)),
            ("text", "a.tre", tre(&tree, false)),
            ("binary", "a.tre", tre(&tree, true)),
            (
                "",
                "a.fcsv",
                text(&tree, "# Markups fiducial file version = 4.11\n", |_, k, [x, y, z, _]| {
                    format!("{k},{x:.3},{y:.3},{z:.3},0,0,0,1,1,1,0,F-{k},,\n")
                }),
            ),
            (
                "",
                "reference.txt",
                text(&tree, "", |_, _, [x, y, z, r]| format!("{x:.6} {y:.6} {z:.6} {r:.6} 0.1\n")),
            ),
            (
                "4 columns",
                "a.csv",
                text(&tree, "line,x,y,z,r\n", |i, _, [x, y, z, r]| {
                    format!("{i},{x:.3},{y:.3},{z:.3},{r:.3}\n")
                }),
            ),
            ("3 columns", "a.csv", text(&tree, "", |_, _, [x, y, z, _]| format!("{x:.2},{y:.2},{z:.2}\n"))),
            ("f4 x 3", "a.npy", npy(&tree, 3, false)),
            ("f4 x 4", "a.npy", npy(&tree, 4, false)),
            ("f8 x 4", "a.npy", npy(&tree, 4, true)),
        ];
        for (what, name, bytes) in files {
            let (read_alone, first) =
                memory::peak_of(|| read(&bytes, name).unwrap_or_else(|error| panic!("{error}")));
            drop(read_alone);
            let (vessels, peak) = memory::peak_of(|| {
                read(&bytes, name).and_then(|read| read.scaled(1.0)).map(junctions::vessels)
            });
            let vessels = vessels.unwrap_or_else(|error| panic!("{what}: {error}"));
            let times = |peak: usize| peak as f64 / bytes.len() as f64;
            println!(
                "{name} {what}: {} bytes, {:.1} times to read, {:.1} in all, {} vessels",
                bytes.len(),
                times(first),
                times(peak),
                vessels.lines.len()
            );
            if peak > MOST_TIMES * bytes.len() {
                wrong.push(format!("{name} {what}: {peak} bytes for {}", bytes.len()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
