//! Test data: a small Y of two lines, in every encoding of every format.

use glam::DVec3;

use crate::compression::Compressor;
use crate::data_array::ByteOrder;

/// Two lines that share two points. Multiples of 1/8 are exact in all number types and in text.
pub const POINTS: [[f64; 3]; 7] = [
    [-1.5, 2.25, 0.0],
    [-1.5, 2.25, 4.0],
    [-4.0, 2.0, 8.125],
    [-1.5, 2.25, 0.0],
    [-1.5, 2.25, 4.0],
    [1.0, 2.0, 8.0],
    [3.0, 2.0, 16.0],
];
pub const RADIUS: [f64; 7] = [2.0, 1.5, 1.0, 2.0, 1.5, 0.75, 0.5];
pub const ENDS: [usize; 2] = [3, 7];

pub fn line(i: usize) -> Vec<DVec3> {
    let range = if i == 0 { 0..ENDS[0] } else { ENDS[0]..ENDS[1] };
    POINTS[range].iter().map(|p| DVec3::from(*p)).collect()
}

#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// `ascii`, `binary` (inline base64), `base64` or `raw` (both appended).
    pub format: &'static str,
    pub compressor: Option<Compressor>,
    pub order: ByteOrder,
    pub wide_header: bool,
    /// Whether numbers are Float64 and Int64 instead of Float32 and Int32.
    pub wide: bool,
}

pub fn styles() -> Vec<Style> {
    let mut out = Vec::new();
    for format in ["ascii", "binary", "base64", "raw"] {
        for compressor in [None, Some(Compressor::Zlib), Some(Compressor::Lz4), Some(Compressor::Lzma)] {
            for (order, wide_header, wide) in [
                (ByteOrder::Little, false, false),
                (ByteOrder::Little, true, true),
                (ByteOrder::Big, false, true),
                (ByteOrder::Big, true, false),
            ] {
                out.push(Style { format, compressor, order, wide_header, wide });
            }
        }
    }
    out
}

fn ordered(little: &[u8], order: ByteOrder) -> Vec<u8> {
    let mut bytes = little.to_vec();
    if order == ByteOrder::Big {
        bytes.reverse();
    }
    bytes
}

fn number(value: f64, integer: bool, wide: bool, order: ByteOrder) -> Vec<u8> {
    match (integer, wide) {
        (true, true) => ordered(&(value as i64).to_le_bytes(), order),
        (true, false) => ordered(&(value as i32).to_le_bytes(), order),
        (false, true) => ordered(&value.to_le_bytes(), order),
        (false, false) => ordered(&(value as f32).to_le_bytes(), order),
    }
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::new();
    for chunk in bytes.chunks(3) {
        let bits = (0..3).fold(0u32, |sum, i| sum << 8 | u32::from(*chunk.get(i).unwrap_or(&0)));
        for place in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * place) & 63) as usize];
            out.push(if place <= chunk.len() { char::from(letter) } else { '=' });
        }
    }
    out
}

pub fn pack(compressor: Compressor, block: &[u8]) -> Vec<u8> {
    use std::io::Write;
    match compressor {
        Compressor::Zlib => {
            let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
            encoder.write_all(block).unwrap();
            encoder.finish().unwrap()
        }
        Compressor::Lz4 => lz4_flex::block::compress(block),
        Compressor::Lzma => {
            let options = lzma_rust2::XzOptions::default();
            let mut encoder = lzma_rust2::XzWriter::new(Vec::new(), options).unwrap();
            encoder.write_all(block).unwrap();
            encoder.finish().unwrap()
        }
    }
}

/// Header and data of an array; compressed data has blocks of 32 bytes.
fn blocks(style: Style, content: &[u8]) -> (Vec<u8>, Vec<u8>) {
    let word = |n: usize| match style.wide_header {
        true => ordered(&(n as u64).to_le_bytes(), style.order),
        false => ordered(&(n as u32).to_le_bytes(), style.order),
    };
    let Some(compressor) = style.compressor else { return (word(content.len()), content.to_vec()) };
    let packed: Vec<Vec<u8>> = content.chunks(32).map(|chunk| pack(compressor, chunk)).collect();
    let head = [packed.len(), 32, content.len() % 32];
    let header = head.into_iter().chain(packed.iter().map(Vec::len)).flat_map(word).collect();
    (header, packed.concat())
}

/// Arrays, each with section, name, whether integer, number of components, and values.
type Arrays = Vec<(&'static str, &'static str, bool, usize, Vec<f64>)>;

fn arrays() -> Arrays {
    let ids = (0..7).map(f64::from).collect();
    vec![
        ("PointData", "Abscissas", false, 1, vec![0.0; 7]),
        ("PointData", "MaximumInscribedSphereRadius", false, 1, RADIUS.to_vec()),
        ("CellData", "GroupIds", true, 1, vec![4.0, 5.0]),
        ("Points", "Points", false, 3, POINTS.concat()),
        ("Lines", "connectivity", true, 1, ids),
        ("Lines", "offsets", true, 1, ENDS.map(|n| n as f64).to_vec()),
    ]
}

pub fn vtp(style: Style) -> Vec<u8> {
    let mut appended = Vec::new();
    let mut elements = std::collections::BTreeMap::<&str, String>::new();
    for (section, name, integer, components, values) in arrays() {
        let kind = match (integer, style.wide) {
            (true, true) => "Int64",
            (true, false) => "Int32",
            (false, true) => "Float64",
            (false, false) => "Float32",
        };
        let content: Vec<u8> =
            values.iter().flat_map(|v| number(*v, integer, style.wide, style.order)).collect();
        let (header, data) = blocks(style, &content);
        let (format, text) = match style.format {
            "ascii" => ("format=\"ascii\"".to_owned(), values.iter().map(|v| format!("{v}\n ")).collect()),
            "binary" => {
                let text = match style.compressor {
                    Some(_) => base64(&header) + &base64(&data),
                    None => base64(&[header, data].concat()),
                };
                ("format=\"binary\"".to_owned(), format!("\n  {text}\n"))
            }
            appending => {
                let offset = appended.len();
                match (appending, style.compressor) {
                    ("raw", _) => appended.extend([header, data].concat()),
                    (_, Some(_)) => appended.extend((base64(&header) + &base64(&data)).bytes()),
                    (_, None) => appended.extend(base64(&[header, data].concat()).bytes()),
                }
                (format!("format=\"appended\" offset=\"{offset}\""), String::new())
            }
        };
        let key = "<InformationKey name=\"L2_NORM_RANGE\"><Value index=\"0\"> 7 </Value></InformationKey>";
        elements.entry(section).or_default().push_str(&format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" {format}>{text}{key}</DataArray>"
        ));
    }
    let sections: String = elements.iter().map(|(name, text)| format!("<{name}>{text}</{name}>\n")).collect();
    let order = if style.order == ByteOrder::Little { "LittleEndian" } else { "BigEndian" };
    let header_type = if style.wide_header { "UInt64" } else { "UInt32" };
    let compressor = match style.compressor {
        None => "",
        Some(Compressor::Zlib) => " compressor=\"vtkZLibDataCompressor\"",
        Some(Compressor::Lz4) => " compressor=\"vtkLZ4DataCompressor\"",
        Some(Compressor::Lzma) => " compressor=\"vtkLZMADataCompressor\"",
    };
    let mut out = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" byte_order=\"{order}\" header_type=\"{header_type}\"{compressor}>\n\
         <PolyData><FieldData><Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">82 65 83 0</Array>\
         </FieldData><Piece NumberOfPoints=\"7\" NumberOfLines=\"2\">{sections}</Piece></PolyData>"
    )
    .into_bytes();
    if !appended.is_empty() {
        let encoding = style.format;
        out.extend(format!("<AppendedData encoding=\"{encoding}\">\n_").into_bytes());
        out.extend(appended);
        out.extend(b"\n</AppendedData>");
    }
    out.extend(b"\n</VTKFile>\n");
    out
}

/// A `.vtk` file; `offsets` selects the form of version 5.
pub fn vtk(binary: bool, offsets: bool) -> Vec<u8> {
    let version = if offsets { "5.1" } else { "3.0" };
    let encoding = if binary { "BINARY" } else { "ASCII" };
    let mut out =
        format!("# vtk DataFile Version {version}\nMade. SPACE=RAS\n{encoding}\nDATASET POLYDATA\n")
            .into_bytes();
    let put = |out: &mut Vec<u8>, head: &str, values: &[f64], integer: bool, wide: bool| {
        out.extend(head.bytes());
        for value in values {
            match binary {
                true => out.extend(number(*value, integer, wide, ByteOrder::Big)),
                false => out.extend(format!("{value} ").bytes()),
            }
        }
        out.push(b'\n');
    };
    put(&mut out, "POINTS 7 float\n", &POINTS.concat(), false, false);
    out.extend(b"METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1 \n\n");
    let ids: Vec<f64> = (0..7).map(f64::from).collect();
    if offsets {
        put(&mut out, "VERTICES 2 1\nOFFSETS vtktypeint64\n", &[0.0, 1.0], true, true);
        put(&mut out, "CONNECTIVITY vtktypeint64\n", &[0.0], true, true);
        put(&mut out, "LINES 3 7\nOFFSETS vtktypeint64\n", &[0.0, 3.0, 7.0], true, true);
        put(&mut out, "CONNECTIVITY vtktypeint64\n", &ids, true, true);
    } else {
        put(&mut out, "VERTICES 1 2\n", &[1.0, 0.0], true, false);
        let numbers = [&[3.0][..], &ids[..3], &[4.0], &ids[3..]].concat();
        put(&mut out, "LINES 2 9\n", &numbers, true, false);
    }
    put(
        &mut out,
        "CELL_DATA 3\nSCALARS GroupIds int 1\nLOOKUP_TABLE default\n",
        &[9.0, 4.0, 5.0],
        true,
        false,
    );
    put(&mut out, "POINT_DATA 7\nNORMALS n double\n", &[0.0; 21], false, true);
    put(&mut out, "FIELD FieldData 1\nRadius 1 7 double\n", &RADIUS, false, true);
    out.extend(b"METADATA\nINFORMATION 0\n\n");
    out
}

pub fn mrk_json(space: &str, unit: &str, per_mm: f64) -> Vec<u8> {
    let sign = if space.contains('R') || space == "0" { 1.0 } else { -1.0 };
    let curve = |begin: usize, end: usize| {
        let controls: Vec<String> = POINTS[begin..end]
            .iter()
            .map(|[x, y, z]| [sign * x * per_mm, sign * y * per_mm, z * per_mm])
            .map(|p| format!("{{\"position\": {p:?}, \"positionStatus\": \"defined\"}}"))
            .collect();
        format!(
            "{{\"type\": \"Curve\", \"name\": \"curve {begin}\", \"coordinateSystem\": \"{space}\", \
             \"coordinateUnits\": \"{unit}\", \"controlPoints\": [{}], \"measurements\": [{{\"name\": \"length\"}}, \
             {{\"name\": \"Radius\", \"units\": \"mm\", \"controlPointValues\": {:?}}}]}}",
            controls.join(", "),
            &RADIUS[begin..end]
        )
    };
    format!("{{\"markups\": [{}, {}]}}", curve(0, ENDS[0]), curve(ENDS[0], ENDS[1])).into_bytes()
}

pub fn pth() -> Vec<u8> {
    let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<format version=\"1.0\"/>\n".to_owned();
    for i in 0..2 {
        let positions: String = line(i)
            .iter()
            .map(|p| {
                format!(
                    "<path_point id=\"0\">\n<pos x=\"{}\" y=\"{}\" z=\"{}\" />\n</path_point>\n",
                    p.x, p.y, p.z
                )
            })
            .collect();
        out += &format!(
            "<path id=\"{i}\" version=\"1.0\"><timestep id=\"0\"><path_element method=\"0\"><control_points>\
             <point id=\"0\" x=\"0\" y=\"0\" z=\"0\"/></control_points><path_points>{positions}</path_points>\
             </path_element></timestep></path>\n"
        );
    }
    out.into_bytes()
}

fn rows(i: usize) -> Vec<[f64; 4]> {
    let begin = if i == 0 { 0 } else { ENDS[0] };
    line(i).iter().zip(&RADIUS[begin..]).map(|(p, r)| [p.x, p.y, p.z, *r]).collect()
}

pub fn npy(rows: &[[f64; 4]], columns: usize, kind: &str, fortran: bool, version: u8) -> Vec<u8> {
    let order = if kind.starts_with('>') { ByteOrder::Big } else { ByteOrder::Little };
    let header = format!(
        "{{'descr': '{kind}', 'fortran_order': {}, 'shape': ({}, {columns}), }}\n",
        if fortran { "True" } else { "False" },
        rows.len()
    );
    let mut out = b"\x93NUMPY".to_vec();
    out.extend([version, 0]);
    match version {
        1 => out.extend((header.len() as u16).to_le_bytes()),
        _ => out.extend((header.len() as u32).to_le_bytes()),
    }
    out.extend(header.bytes());
    let mut put = |value: f64| out.extend(number(value, kind.contains('i'), kind.ends_with('8'), order));
    match fortran {
        true => (0..columns).for_each(|column| rows.iter().for_each(|row| put(row[column]))),
        false => rows.iter().for_each(|row| row[..columns].iter().for_each(|value| put(*value))),
    }
    out
}

/// The sample, or its first line, in each format, with the names of file and format.
pub fn other_files() -> Vec<(Vec<u8>, &'static str, &'static str)> {
    let row =
        |separator: &str, [x, y, z, r]: [f64; 4]| format!("{x}{separator}{y}{separator}{z}{separator}{r}\n");
    let text = |i: usize, prefix: &str, separator: &str| -> String {
        rows(i).into_iter().map(|values| format!("{prefix}{}", row(separator, values))).collect()
    };
    let swc = |first: usize, i: usize| -> String {
        let node = |(k, [x, y, z, r]): (usize, [f64; 4])| {
            let parent = if k == 0 { -1 } else { (first + k - 1) as i64 };
            format!("{} 0 {x} {y} {z} {r} {parent}\n", first + k)
        };
        rows(i).into_iter().enumerate().map(node).collect()
    };
    let tube = |i: usize| {
        let count = rows(i).len();
        let points = text(i, "", " ");
        format!(
            "ObjectType = VesselTube\nNDims = 3\nID = {i}\nPointDim = x y z r\nNPoints = {count}\nPoints = \n{points}"
        )
    };
    let fiducials =
        "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n# columns = id,x,y,z,w\n"
            .to_owned();
    let reference: String = text(0, "", " ").replace('\n', " 0.0\n");
    vec![
        (pth(), "a.pth", "SimVascular path"),
        ((swc(1, 0) + &swc(11, 1)).into_bytes(), "a.swc", "SWC"),
        ((tube(0) + &tube(1)).into_bytes(), "a.tre", "ITK tube"),
        ((fiducials + &text(0, "p,", ",")).into_bytes(), "a.fcsv", "3D Slicer fiducials"),
        (reference.into_bytes(), "reference.txt", "Rotterdam reference"),
        ((text(0, "", " ") + "\n" + &text(1, "", " ")).into_bytes(), "a.txt", "text table"),
        (
            ("line,x,y,z,radius\n".to_owned() + &text(0, "a,", ",") + &text(1, "b,", ",")).into_bytes(),
            "a.csv",
            "text table",
        ),
        (npy(&rows(0), 4, "<f8", false, 1), "a.npy", "NumPy array"),
    ]
}

/// One small file of each kind, with its file name.
pub fn files() -> Vec<(Vec<u8>, &'static str)> {
    let mut out: Vec<_> = styles().into_iter().map(|style| (vtp(style), "a.vtp")).collect();
    for binary in [false, true] {
        out.extend([false, true].map(|offsets| (vtk(binary, offsets), "a.vtk")));
    }
    out.push((mrk_json("RAS", "mm", 1.0), "a.mrk.json"));
    out.extend(other_files().into_iter().map(|(content, name, _)| (content, name)));
    out
}
