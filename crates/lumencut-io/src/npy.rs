//! Reads NumPy arrays (`.npy`), versions 1 to 3.

use glam::DVec3;

use crate::centerlines::{Centerlines, Line};
use crate::data_array::{ByteOrder, NumberType};
use crate::error::{Error, Result, excerpt};

pub(crate) const MAGIC: &[u8] = b"\x93NUMPY";

/// Maximum length of the header (bytes). The limit of NumPy is 10,000 characters.
const LONGEST_HEADER: usize = 1 << 16;

/// The array as one line, or as several lines split at jumps. Its rows are x, y, z and an optional radius.
pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let (header, data) = split(bytes)?;
    let (kind, order) = number_type(header)?;
    let (rows, columns) = shape(header)?;
    let size = rows.checked_mul(columns).and_then(|count| count.checked_mul(kind.size()));
    let data = size.and_then(|size| data.get(..size)).ok_or_else(|| {
        let found = format!("{} bytes of data", data.len());
        Error::truncated("data", found, format!("{rows} x {columns} numbers of {} bytes", kind.size()))
    })?;
    let values = kind.numbers(data, order);
    let by_columns = match value_of(header, "fortran_order")? {
        text if text.starts_with("True") => true,
        text if text.starts_with("False") => false,
        other => return Err(Error::new("fortran_order", excerpt(other), "True or False")),
    };
    let at = |row: usize, column: usize| match by_columns {
        true => values[column * rows + row],
        false => values[row * columns + column],
    };
    let mut out = Centerlines::of("NumPy array");
    out.lines.push(Line {
        points: (0..rows).map(|i| DVec3::new(at(i, 0), at(i, 1), at(i, 2))).collect(),
        radius: (columns == 4).then(|| (0..rows).map(|i| at(i, 3)).collect()),
        ..Line::default()
    });
    out.doubt_unnamed_columns();
    out.parted_at_jumps().without_zero_radii().tidy()
}

fn split(bytes: &[u8]) -> Result<(&str, &[u8])> {
    let broken =
        || Error::truncated("header", "fewer bytes than the header states", "a complete NumPy header");
    let rest = bytes.get(MAGIC.len()..).ok_or_else(broken)?;
    let ([major, _], rest) = rest.split_first_chunk::<2>().ok_or_else(broken)?;
    let (length, rest) = match major {
        1 => rest.split_first_chunk().map(|(n, rest)| (usize::from(u16::from_le_bytes(*n)), rest)),
        2 | 3 => rest.split_first_chunk().map(|(n, rest)| (u32::from_le_bytes(*n) as usize, rest)),
        _ => return Err(Error::new("header", format!("version {major}"), "version 1, 2 or 3")),
    }
    .ok_or_else(broken)?;
    if length > LONGEST_HEADER {
        let expected = format!("at most {LONGEST_HEADER} bytes");
        return Err(Error::new("header", format!("a length of {length} bytes"), expected));
    }
    let (header, data) = rest.split_at_checked(length).ok_or_else(broken)?;
    let header = std::str::from_utf8(header)
        .map_err(|_| Error::new("header", "bytes that are not text", "a NumPy header"))?;
    Ok((header, data))
}

/// The text after a key of the header, which is a Python dictionary with three keys.
fn value_of<'a>(header: &'a str, key: &str) -> Result<&'a str> {
    let quoted = [format!("'{key}'"), format!("\"{key}\"")];
    let behind = quoted.iter().find_map(|key| header.split_once(key.as_str()));
    let value = behind.and_then(|(_, rest)| rest.trim_start().strip_prefix(':')).map(str::trim_start);
    value.ok_or_else(|| Error::new("header", format!("no '{key}'"), "a NumPy header that states it"))
}

fn number_type(header: &str) -> Result<(NumberType, ByteOrder)> {
    let text = value_of(header, "descr")?;
    let name = text.strip_prefix(['\'', '"']).and_then(|rest| rest.split(['\'', '"']).next());
    let Some(name) = name else {
        return Err(Error::new("descr", excerpt(text), "one number type for all columns")
            .mend("save the columns x, y, z as one array of floats"));
    };
    let order = if name.starts_with('>') { ByteOrder::Big } else { ByteOrder::Little };
    let kind = match name.trim_start_matches(['<', '>', '|', '=']) {
        "f4" => NumberType::F32,
        "f8" => NumberType::F64,
        "i2" => NumberType::I16,
        "i4" => NumberType::I32,
        "i8" => NumberType::I64,
        other => {
            let found = if other.starts_with('O') { "Python objects (pickle)".into() } else { excerpt(name) };
            return Err(
                Error::new("descr", found, "f4, f8, i2, i4 or i8").mend("save the points with astype(float)")
            );
        }
    };
    Ok((kind, order))
}

fn shape(header: &str) -> Result<(usize, usize)> {
    let text = value_of(header, "shape")?;
    let inside = text.strip_prefix('(').and_then(|rest| rest.split_once(')')).map(|(inside, _)| inside);
    let sizes = inside.map(|inside| inside.split(',').map(str::trim).filter(|size| !size.is_empty()));
    let sizes: Option<Vec<usize>> = sizes.and_then(|sizes| sizes.map(|size| size.parse().ok()).collect());
    match sizes.as_deref() {
        Some([rows, columns @ (3 | 4)]) => Ok((*rows, *columns)),
        _ => {
            let found = inside.map_or_else(|| excerpt(text), |inside| format!("({})", inside.trim()));
            Err(Error::new("shape", found, "(n, 3) of x, y, z or (n, 4) with the radius")
                .mend("save the points of one line as rows"))
        }
    }
}
