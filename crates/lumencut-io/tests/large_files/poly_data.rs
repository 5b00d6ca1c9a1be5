//! Test data: a tree in the VTK formats.

use std::fmt::Write as _;
use std::io::Write as _;

use crate::Row;

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

pub fn vtk(tree: &[Vec<Row>], binary: bool) -> Vec<u8> {
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

/// The tree with every segment as a separate line.
pub fn segments(tree: &[Vec<Row>]) -> Vec<u8> {
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

pub fn vtp(tree: &[Vec<Row>], format: &str) -> Vec<u8> {
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
