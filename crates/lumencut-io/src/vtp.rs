//! Reads VTK XML poly data (`.vtp`): ASCII, inline base64 or appended data, with or without compression.

use crate::centerlines::{Centerlines, JOINED_MARK, Line};
use crate::compression::{Budget, Compressor};
use crate::data_array::{ByteOrder, NumberType, numbers_of_text};
use crate::encoding::{self, Bytes, Layout};
use crate::error::{Error, Result, excerpt};
use crate::poly_data::{self, Array, PolyData};
use crate::unit::Unit;
use crate::vtp_xml::{self, Declared, Piece};
use crate::xml::Attributes;

pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let (head, appended) = split(bytes)?;
    let text = String::from_utf8_lossy(head);
    let document = vtp_xml::document(&text)?;
    let kind = document.file.get("type").unwrap_or_default();
    if kind != "PolyData" {
        return Err(Error::new("", format!("a VTK XML file of type {}", excerpt(kind)), "type 'PolyData'"));
    }
    if !document.complete && appended.is_none() {
        return Err(Error::truncated("", "no end of the VTKFile element", "a complete VTK XML file"));
    }
    let layout = layout(&document.file)?;
    let mut arrays = Arrays { layout, appended, budget: Budget::of_file(bytes.len()) };
    let field = |name| document.field_arrays.iter().find(|array| array.attributes.get("Name") == Some(name));
    let mut out = Centerlines::of("VTK XML PolyData");
    if field(JOINED_MARK).is_some() {
        // A file that this crate wrote: its lines are vessels in mm.
        out.joined = true;
        out.unit = Some(Unit::Millimetre);
    }
    if let Some(space) = field("SPACE") {
        let codes = arrays.numbers(space)?;
        out.space = poly_data::space_of(&codes.iter().map(|c| char::from(*c as u8)).collect::<String>());
    }
    for piece in &document.pieces {
        arrays.poly_data(piece)?.into_centerlines(&mut out)?;
    }
    // Files that this crate writes are read back unchanged.
    if out.joined { out.tidy() } else { out.without_zero_radii().tidy() }
}

fn split(bytes: &[u8]) -> Result<(&[u8], Option<Appended<'_>>)> {
    const TAG: &[u8] = b"<AppendedData";
    let Some(start) = bytes.windows(TAG.len()).position(|window| window == TAG) else {
        return Ok((bytes, None));
    };
    let (head, tail) = bytes.split_at(start);
    let broken = || Error::truncated("AppendedData", "no data behind '_'", "data behind '_'");
    let end_of_tag = tail.iter().position(|b| *b == b'>').ok_or_else(broken)?;
    let (tag, data) = tail.split_at(end_of_tag + 1);
    let begin = data.iter().position(|b| *b == b'_').ok_or_else(broken)?;
    let base64 = tag.windows(6).any(|window| window == b"base64");
    Ok((head, Some(Appended { base64, data: &data[begin + 1..] })))
}

fn layout(file: &Attributes) -> Result<Layout> {
    let order = match file.get("byte_order") {
        Some("LittleEndian") | None => ByteOrder::Little,
        Some("BigEndian") => ByteOrder::Big,
        Some(other) => {
            return Err(Error::new("byte_order", excerpt(other), "'LittleEndian' or 'BigEndian'"));
        }
    };
    let header_size = match file.get("header_type") {
        Some("UInt32") | None => 4,
        Some("UInt64") => 8,
        Some(other) => return Err(Error::new("header_type", excerpt(other), "'UInt32' or 'UInt64'")),
    };
    let named = file.get("compressor").filter(|name| !name.is_empty());
    Ok(Layout { order, header_size, compressor: named.map(Compressor::of_name).transpose()? })
}

#[derive(Clone, Copy)]
struct Appended<'a> {
    base64: bool,
    data: &'a [u8],
}

struct Arrays<'a> {
    layout: Layout,
    appended: Option<Appended<'a>>,
    budget: Budget,
}

impl Arrays<'_> {
    fn poly_data(&mut self, piece: &Piece) -> Result<PolyData> {
        let count = |name| piece.attributes.count(name);
        let (points, lines) = (count("NumberOfPoints")?, count("NumberOfLines")?);
        let cells_before_lines = count("NumberOfVerts")?;
        let after = count("NumberOfStrips")?.saturating_add(count("NumberOfPolys")?);
        let of = |section: &str, name: Option<&str>| {
            let fits =
                |a: &&Declared| a.section == section && (name.is_none() || a.attributes.get("Name") == name);
            piece.arrays.iter().find(fits)
        };
        let mut numbers = |what: &str, array: Option<&Declared>, expected: Option<usize>| {
            let Some(array) = array else {
                return match expected {
                    Some(0) => Ok(Vec::new()),
                    _ => Err(Error::new(what, "no such array", "the array that the counts refer to")),
                };
            };
            let values = self.numbers(array)?;
            match expected {
                Some(n) if n != values.len() => {
                    Err(Error::truncated(what, format!("{} numbers", values.len()), format!("{n} numbers")))
                }
                _ => Ok(values),
            }
        };
        let coordinates = numbers("Points", of("Points", None), points.checked_mul(3))?;
        let (ends, connectivity) = if lines == 0 {
            (Vec::new(), Vec::new())
        } else {
            let ends = numbers("offsets of Lines", of("Lines", Some("offsets")), Some(lines))?;
            (ends, numbers("connectivity of Lines", of("Lines", Some("connectivity")), None)?)
        };
        // Lines of fewer than two points take memory but no space in the file, so they count for the budget.
        let empty = lines.saturating_sub(connectivity.len() / 2).saturating_mul(size_of::<Line>());
        self.budget.take("Lines", empty as u64)?;
        Ok(PolyData {
            points: coordinates,
            connectivity,
            ends,
            cells_before_lines,
            other_cells: cells_before_lines.saturating_add(after),
            point_arrays: self.data_of(piece, "PointData")?,
            cell_arrays: self.data_of(piece, "CellData")?,
            names: self.names(piece)?,
        })
    }

    fn names(&mut self, piece: &Piece) -> Result<Option<Vec<String>>> {
        let is_name = |array: &&Declared| {
            let has = |key, value| array.attributes.get(key) == Some(value);
            array.section == "CellData" && has("type", "String") && has("Name", poly_data::NAMES)
        };
        let Some(array) = piece.arrays.iter().find(is_name) else { return Ok(None) };
        // VTK writes the bytes of texts as signed numbers.
        let codes: Vec<u8> =
            self.numbers(array)?.into_iter().map(|code| code.rem_euclid(256.0) as u8).collect();
        let texts = codes.strip_suffix(&[0]).unwrap_or(&codes).split(|code| *code == 0);
        Ok(Some(texts.map(|text| String::from_utf8_lossy(text).into_owned()).collect()))
    }

    fn data_of(&mut self, piece: &Piece, section: &str) -> Result<Vec<Array>> {
        let mut out: Vec<Array> = Vec::new();
        for array in piece.arrays.iter().filter(|array| array.section == section) {
            let name = array.attributes.get("Name").unwrap_or_default();
            if poly_data::wanted(name) && out.iter().all(|known| known.name != name) {
                let components = array.attributes.count("NumberOfComponents")?.max(1);
                out.push(Array { name: name.to_owned(), components, values: self.numbers(array)? });
            }
        }
        Ok(out)
    }

    fn numbers(&mut self, array: &Declared) -> Result<Vec<f64>> {
        let attributes = &array.attributes;
        let name = format!("array '{}'", attributes.get("Name").unwrap_or(&array.section));
        let kind = number_type(&name, attributes.get("type").unwrap_or_default())?;
        let bytes = match attributes.get("format").unwrap_or("ascii") {
            "ascii" => return numbers_of_text(&name, &array.text, kind),
            "binary" => Bytes::base64(array.text.as_bytes()),
            "appended" => {
                let missing =
                    || Error::truncated(&name, "no appended data", "the data that the array points to");
                self.appended.ok_or_else(missing)?.bytes(&name, attributes.count("offset")?)?
            }
            other => {
                return Err(Error::new(
                    name,
                    format!("format {}", excerpt(other)),
                    "ascii, binary or appended",
                ));
            }
        };
        let content = encoding::content(&name, bytes, self.layout, &mut self.budget)?;
        self.budget.take(&name, (content.len() / kind.size() * size_of::<f64>()) as u64)?;
        Ok(kind.numbers(&content, self.layout.order))
    }
}

impl<'a> Appended<'a> {
    fn bytes(self, name: &str, offset: usize) -> Result<Bytes<'a>> {
        let data = self.data.get(offset..).ok_or_else(|| {
            let found = format!("offset {offset} into {} bytes of appended data", self.data.len());
            Error::truncated(name, found, "an offset inside the appended data")
        })?;
        Ok(if self.base64 { Bytes::base64(data) } else { Bytes::raw(data) })
    }
}

fn number_type(subject: &str, name: &str) -> Result<NumberType> {
    Ok(match name {
        "Int8" => NumberType::I8,
        "UInt8" | "String" => NumberType::U8,
        "Int16" => NumberType::I16,
        "UInt16" => NumberType::U16,
        "Int32" => NumberType::I32,
        "UInt32" => NumberType::U32,
        "Int64" => NumberType::I64,
        "UInt64" => NumberType::U64,
        "Float32" => NumberType::F32,
        "Float64" => NumberType::F64,
        _ => {
            return Err(Error::new(subject, format!("type {}", excerpt(name)), "an Int, UInt or Float type"));
        }
    })
}
