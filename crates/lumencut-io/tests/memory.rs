//! Tests the peak memory of reading the files that expand most.
#![allow(unsafe_code, clippy::unwrap_used)]

#[path = "../fuzz/src/memory.rs"]
mod memory;

use std::io::Write;

use lumencut_io::{junctions, read};

/// Maximum memory: ten times the size of the file, or of 1 MiB for smaller files.
const MOST: usize = 10 << 20;
const FILE: usize = 64 << 10;

fn zlib(content: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(content).unwrap();
    encoder.finish().unwrap()
}

fn lz4(content: &[u8]) -> Vec<u8> {
    lz4_flex::block::compress(content)
}

/// Packs content with the dictionary of 64 MiB that the strongest preset uses.
fn lzma(content: &[u8]) -> Vec<u8> {
    let mut encoder = lzma_rust2::XzWriter::new(Vec::new(), lzma_rust2::XzOptions::with_preset(9)).unwrap();
    encoder.write_all(content).unwrap();
    encoder.finish().unwrap()
}

type Packer = fn(&[u8]) -> Vec<u8>;

/// A `.vtp` of `FILE` bytes with three points and a line that visits them in turn.
fn turns(compressor: &str, pack: Packer, ids: usize) -> Vec<u8> {
    let block = |content: &[u8], claimed: usize| {
        let packed = pack(content);
        let header = [1, claimed as u32, 0, packed.len() as u32].map(u32::to_le_bytes).concat();
        [header, packed].concat()
    };
    let turns: Vec<u8> = (0..ids).map(|i| (i % 3) as u8).collect();
    let points = block(&[0, 0, 0, 1, 0, 0, 0, 1, 0], 9);
    let connectivity = block(&turns, ids);
    let ends = block(&(ids as u32).to_le_bytes(), 4);
    let head = format!(
        "<VTKFile type=\"PolyData\" compressor=\"{compressor}\"><PolyData><Piece NumberOfPoints=\"3\" \
         NumberOfLines=\"1\"><Points>{}</Points><Lines>{}{}</Lines></Piece></PolyData><AppendedData encoding=\"raw\">_",
        appended("Points", "Int8", 0),
        appended("connectivity", "Int8", points.len()),
        appended("offsets", "UInt32", points.len() + connectivity.len()),
    );
    let mut out = [head.into_bytes(), points, connectivity, ends].concat();
    out.resize(FILE, b' ');
    out
}

fn assert_small(what: &str, bytes: &[u8], name: &str, expected: &str) {
    let (result, peak) = memory::peak_of(|| read(bytes, name).map(junctions::vessels));
    let told = match result {
        Ok(vessels) => format!("{} vessel(s)", vessels.lines.len()),
        Err(error) => error.to_string(),
    };
    assert!(told.contains(expected), "{what}: {told}");
    assert!(bytes.len() <= FILE && peak <= MOST, "{what}: {peak} bytes for {}", bytes.len());
}

/// There is a single test, because the memory of concurrent tests would add up.
#[test]
fn no_small_file_takes_more_than_ten_times_a_mebibyte() {
    let packers: [(&str, Packer); 3] =
        [("vtkZLibDataCompressor", zlib), ("vtkLZ4DataCompressor", lz4), ("vtkLZMADataCompressor", lzma)];
    for (compressor, pack) in packers {
        assert_small(compressor, &turns(compressor, pack, 225_000), "a.vtp", "1 vessel(s)");
        assert_small(compressor, &turns(compressor, pack, 8_000_000), "a.vtp", "bytes to unpack");
    }
    // No memory may be allocated for content that is claimed but missing.
    let claim = |content: &[u8]| lz4(&content[..content.len().min(9)]);
    assert_small(
        "lz4",
        &turns("vtkLZ4DataCompressor", claim, 1 << 20),
        "a.vtp",
        "Lz4 data for 1048576 bytes",
    );
    for (what, begin, piece, end) in [
        ("objects", "{\"markups\": [", "{\"\":0},", "{}]}"),
        ("numbers", "{\"markups\": [", "0,", "0]}"),
        ("lists", "{\"markups\": [", "[[]],", "0]}"),
    ] {
        let text = format!("{begin}{}{end}", piece.repeat((FILE - 32) / piece.len()));
        assert_small(what, text.as_bytes(), "a.mrk.json", "unnamed type");
    }
    assert_small("lines of no point", &empty_lines(220_000), "a.vtp", "bytes to unpack");
    let fields = format!("ObjectType = Tube\n{}", "a=\n".repeat((FILE - 32) / 3));
    assert_small("fields", fields.as_bytes(), "a.tre", "no Points");
    assert_small("steps", &legacy("unsigned_char", FILE - 1000), "a.vtk", "vessel(s)");
    assert_small("bits", &legacy("bit", (FILE - 1000) * 8), "a.vtk", "ids of the type Bits");
}

/// A legacy file of one line through 256 points in random order, with ids of a given type.
fn legacy(kind: &str, ids: usize) -> Vec<u8> {
    let mut out = b"# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 256 char\n".to_vec();
    out.extend((0..=255u8).flat_map(|i| [i, i.wrapping_mul(i), 3]));
    out.extend(format!("\nLINES 2 {ids}\nOFFSETS int\n").bytes());
    out.extend([0, ids as u32].map(u32::to_be_bytes).concat());
    out.extend(format!("\nCONNECTIVITY {kind}\n").bytes());
    let mut random = 0u32;
    out.extend((0..FILE - 1000).map(|_| {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (random >> 24) as u8
    }));
    out
}

/// A `.vtp` of one line with points and many lines without.
fn empty_lines(count: usize) -> Vec<u8> {
    let block = |content: &[u8]| {
        let packed = zlib(content);
        let header = [1, content.len() as u32, 0, packed.len() as u32].map(u32::to_le_bytes).concat();
        [header, packed].concat()
    };
    let blocks = [block(&[0, 0, 0, 1, 0, 0]), block(&[0, 1]), block(&vec![2; count])];
    let places = [0, blocks[0].len(), blocks[0].len() + blocks[1].len()];
    let head = format!(
        "<VTKFile type=\"PolyData\" compressor=\"vtkZLibDataCompressor\"><PolyData><Piece NumberOfPoints=\"2\" \
         NumberOfLines=\"{count}\"><Points>{}</Points><Lines>{}{}</Lines></Piece></PolyData>\
         <AppendedData encoding=\"raw\">_",
        appended("Points", "Int8", places[0]),
        appended("connectivity", "Int8", places[1]),
        appended("offsets", "UInt8", places[2]),
    );
    let mut out = [head.into_bytes(), blocks.concat()].concat();
    out.resize(FILE, b' ');
    out
}

fn appended(name: &str, kind: &str, offset: usize) -> String {
    format!("<DataArray Name=\"{name}\" type=\"{kind}\" format=\"appended\" offset=\"{offset}\"/>")
}
