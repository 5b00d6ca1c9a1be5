//! Builds compressed `.vtp` files, because random changes of compressed blocks only break their checksums.

use std::io::Write;

use flate2::{Compression, write::ZlibEncoder};
use lzma_rust2::{XzOptions, XzWriter};

struct Style {
    compressor: u8,
    big: bool,
    wide: bool,
    floats: bool,
    block: usize,
    /// Number of bytes that the last block claims to have but does not have.
    lie: i8,
}

/// Makes a `.vtp` file from `data`: five bytes are options and counts; then follow points, radii, groups,
/// offsets and point ids. None if `data` is too short.
pub fn vtp(data: &[u8]) -> Option<Vec<u8>> {
    let ([choice, block, lie, points, lines], mut rest) = data.split_first_chunk::<5>()?;
    let bit = |i: u8| choice >> i & 1 == 1;
    let style = Style {
        compressor: choice % 4,
        big: bit(2),
        wide: bit(3),
        floats: bit(4),
        block: usize::from(*block) + 1,
        lie: lie.cast_signed(),
    };
    let mut take = |count: usize| rest.split_off(..count.min(rest.len())).unwrap_or_default();
    let (points, lines) = (usize::from(*points), usize::from(*lines));
    let coordinates = take(3 * points * if style.floats { 4 } else { 1 });
    let parts = [coordinates, take(points), take(lines), take(lines), take(usize::MAX)];
    let parts = parts.map(|part| style.packed(part));
    let mut offset = 0;
    let mut array = |i: usize, name: &str, kind: &str| {
        let at = offset;
        offset += parts[i].len();
        format!("<DataArray Name=\"{name}\" type=\"{kind}\" format=\"appended\" offset=\"{at}\"/>")
    };
    let body = [
        format!("<Points>{}</Points>", array(0, "Points", if style.floats { "Float32" } else { "Int8" })),
        format!("<PointData>{}</PointData>", array(1, "Radius", "UInt8")),
        format!(
            "<CellData>{}</CellData>",
            if bit(5) { array(2, "GroupIds", "Int8") } else { array(2, "a", "Int8") }
        ),
        format!("<Lines>{}{}</Lines>", array(3, "offsets", "UInt8"), array(4, "connectivity", "UInt8")),
    ]
    .concat();
    let head = format!(
        "<VTKFile type=\"PolyData\" {}><PolyData><Piece NumberOfPoints=\"{points}\" NumberOfLines=\"{lines}\">\
         {body}</Piece></PolyData><AppendedData encoding=\"raw\">_",
        style.attributes()
    );
    Some([head.into_bytes(), parts.concat()].concat())
}

impl Style {
    fn attributes(&self) -> String {
        let order = if self.big { "BigEndian" } else { "LittleEndian" };
        let header = if self.wide { "UInt64" } else { "UInt32" };
        let compressor = match self.compressor {
            0 | 1 => "vtkZLibDataCompressor",
            2 => "vtkLZ4DataCompressor",
            _ => "vtkLZMADataCompressor",
        };
        format!("byte_order=\"{order}\" header_type=\"{header}\" compressor=\"{compressor}\"")
    }

    fn packed(&self, content: &[u8]) -> Vec<u8> {
        let blocks: Vec<Vec<u8>> = content.chunks(self.block).map(|block| self.block(block)).collect();
        let last = (content.len() % self.block).wrapping_add_signed(isize::from(self.lie));
        let mut out = Vec::new();
        for number in [blocks.len(), self.block, last].into_iter().chain(blocks.iter().map(Vec::len)) {
            let mut bytes = (number as u64).to_le_bytes()[..if self.wide { 8 } else { 4 }].to_vec();
            if self.big {
                bytes.reverse();
            }
            out.extend(bytes);
        }
        out.extend(blocks.concat());
        out
    }

    fn block(&self, content: &[u8]) -> Vec<u8> {
        match self.compressor {
            0 | 1 => written(ZlibEncoder::new(Vec::new(), Compression::fast()), content, ZlibEncoder::finish),
            2 => lz4_flex::block::compress(content),
            _ => {
                let encoder = XzWriter::new(Vec::new(), XzOptions::with_preset(0)).expect("an encoder");
                written(encoder, content, XzWriter::finish)
            }
        }
    }
}

fn written<W: Write>(mut out: W, content: &[u8], finish: fn(W) -> std::io::Result<Vec<u8>>) -> Vec<u8> {
    out.write_all(content).and_then(|()| finish(out)).expect("no end of the memory")
}
