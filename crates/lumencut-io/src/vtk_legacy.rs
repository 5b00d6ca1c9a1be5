//! Reads legacy VTK poly data (`.vtk`), versions 1.0 to 5.1, ASCII and binary.

use crate::centerlines::{Centerlines, JOINED_MARK};
use crate::data_array::{NumberType, index};
use crate::error::{Error, Result, excerpt};
use crate::poly_data::{self, Array, PolyData};
use crate::unit::Unit;
use crate::vtk_cursor::{Cursor, ValueType};

pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let mut cursor = Cursor::new(bytes.trim_ascii_start());
    cursor.line();
    let title = cursor.line().unwrap_or_default();
    let encoding = cursor.line().unwrap_or_default();
    cursor.binary = match encoding.to_ascii_uppercase().as_str() {
        "ASCII" => false,
        "BINARY" => true,
        _ => return Err(Error::new("line 3", excerpt(&encoding), "'ASCII' or 'BINARY'")),
    };
    let mut out = Centerlines { space: space_of_title(&title), ..Centerlines::of("legacy VTK") };
    if title.contains(JOINED_MARK) {
        // A file that this crate wrote: its lines are vessels in mm.
        out.joined = true;
        out.unit = Some(Unit::Millimetre);
    }
    let mut sections = Sections { cursor, data: PolyData::default(), at: At::File, space: None };
    while let Some(keyword) = sections.cursor.next_word() {
        sections.section(&keyword.to_ascii_uppercase())?;
    }
    out.space = out.space.or(sections.space);
    sections.data.into_centerlines(&mut out)?;
    // Files that this crate writes are read back unchanged.
    if out.joined { out.tidy() } else { out.without_zero_radii().tidy() }
}

/// The space in the title: 3D Slicer writes `SPACE=LPS` or `SPACE=RAS`.
fn space_of_title(title: &str) -> Option<crate::Space> {
    let (_, stated) = title.split_once("SPACE=")?;
    poly_data::space_of(stated.get(..3)?)
}

#[derive(Clone, Copy)]
enum At {
    File,
    Points(usize),
    Cells(usize),
}

struct Sections<'a> {
    cursor: Cursor<'a>,
    data: PolyData,
    at: At,
    space: Option<crate::Space>,
}

impl Sections<'_> {
    fn section(&mut self, keyword: &str) -> Result<()> {
        match keyword {
            "DATASET" => {
                let kind = self.cursor.word("DATASET")?;
                if !kind.eq_ignore_ascii_case("POLYDATA") {
                    return Err(Error::new("DATASET", excerpt(&kind), "POLYDATA"));
                }
            }
            "METADATA" => {
                self.cursor.line();
                while self.cursor.line().is_some_and(|line| !line.is_empty()) {}
            }
            "POINTS" => {
                let count = self.cursor.count("POINTS")?;
                let kind = self.value_type("POINTS")?;
                self.data.points = self.cursor.values("POINTS", kind, count.saturating_mul(3))?;
            }
            "VERTICES" | "LINES" | "POLYGONS" | "TRIANGLE_STRIPS" => self.cells(keyword)?,
            "POINT_DATA" => self.at = At::Points(self.cursor.count(keyword)?),
            "CELL_DATA" => self.at = At::Cells(self.cursor.count(keyword)?),
            "FIELD" => self.field()?,
            _ => self.attribute(keyword)?,
        }
        Ok(())
    }

    fn value_type(&mut self, subject: &str) -> Result<ValueType> {
        let name = self.cursor.word(subject)?;
        ValueType::of_name(subject, &name)
    }

    /// Ids of type `bit` are rejected: eight of them in a byte take far more memory than the file.
    fn id_type(&mut self, subject: &str) -> Result<ValueType> {
        match self.value_type(subject)? {
            kind @ ValueType::Number(_) => Ok(kind),
            other => Err(Error::new(subject, format!("ids of the type {other:?}"), "whole numbers")),
        }
    }

    fn cells(&mut self, keyword: &str) -> Result<()> {
        let (first, second) = (self.cursor.count(keyword)?, self.cursor.count(keyword)?);
        let (ends, connectivity) = if self.cursor.is_next("OFFSETS") {
            self.cells_by_offsets(keyword, first, second)?
        } else {
            let numbers = self.cursor.values(keyword, ValueType::Number(NumberType::I32), second)?;
            cells_by_counts(keyword, &numbers, first)?
        };
        if keyword == "LINES" {
            (self.data.ends, self.data.connectivity) = (ends, connectivity);
            return Ok(());
        }
        self.data.other_cells += ends.len();
        if keyword == "VERTICES" {
            self.data.cells_before_lines = ends.len();
        }
        Ok(())
    }

    /// Reads cells as stored since version 5.0: first the offsets, then the ids of all points.
    fn cells_by_offsets(
        &mut self,
        keyword: &str,
        offsets: usize,
        ids: usize,
    ) -> Result<(Vec<f64>, Vec<f64>)> {
        self.cursor.word(keyword)?;
        let kind = self.id_type(keyword)?;
        let mut offsets = self.cursor.values(keyword, kind, offsets)?;
        let word = self.cursor.word(keyword)?;
        if !word.eq_ignore_ascii_case("CONNECTIVITY") {
            return Err(Error::new(keyword, excerpt(&word), "CONNECTIVITY"));
        }
        let kind = self.id_type(keyword)?;
        let connectivity = self.cursor.values(keyword, kind, ids)?;
        if offsets.first().is_some_and(|first| *first != 0.0) {
            return Err(Error::new(keyword, format!("a first offset of {}", offsets[0]), "offsets from 0"));
        }
        Ok((offsets.drain(..).skip(1).collect(), connectivity))
    }

    fn field(&mut self) -> Result<()> {
        self.cursor.word("FIELD")?;
        for _ in 0..self.cursor.count("FIELD")? {
            let name = self.cursor.word("FIELD")?;
            if name == "NULL_ARRAY" {
                continue;
            }
            let components = self.cursor.count(&name)?;
            let tuples = self.cursor.count(&name)?;
            let kind = self.value_type(&name)?;
            let values = self.cursor.values(&name, kind, components.saturating_mul(tuples))?;
            if name == "SPACE" {
                let text: String = values.iter().map(|code| char::from(*code as u8)).collect();
                self.space = poly_data::space_of(&text);
            }
            self.keep(name, components, values);
            if self.cursor.is_next("METADATA") {
                self.cursor.word("METADATA")?;
                self.section("METADATA")?;
            }
        }
        Ok(())
    }

    fn attribute(&mut self, keyword: &str) -> Result<()> {
        let (At::Points(count) | At::Cells(count)) = self.at else {
            return Err(unknown(keyword));
        };
        let name = self.cursor.word(keyword)?;
        let (components, kind) = match keyword {
            "SCALARS" => return self.scalars(name, count),
            "LOOKUP_TABLE" | "COLOR_SCALARS" => {
                let number = self.cursor.count(keyword)?;
                let rows = if keyword == "LOOKUP_TABLE" { 4 } else { count };
                let kind = ValueType::Number(NumberType::U8);
                return self.cursor.values(keyword, kind, number.saturating_mul(rows)).map(|_| ());
            }
            "VECTORS" | "NORMALS" => (3, self.value_type(keyword)?),
            "TENSORS" => (9, self.value_type(keyword)?),
            "TENSORS6" => (6, self.value_type(keyword)?),
            "TEXTURE_COORDINATES" => (self.cursor.count(keyword)?, self.value_type(keyword)?),
            "GLOBAL_IDS" | "PEDIGREE_IDS" | "EDGE_FLAGS" => (1, self.value_type(keyword)?),
            _ => return Err(unknown(keyword)),
        };
        let values = self.cursor.values(keyword, kind, count.saturating_mul(components))?;
        self.keep(name, components, values);
        Ok(())
    }

    fn scalars(&mut self, name: String, count: usize) -> Result<()> {
        let kind = self.value_type("SCALARS")?;
        let rest = self.cursor.line().unwrap_or_default();
        let components = match rest.as_str() {
            "" => 1,
            text => {
                text.parse().map_err(|_| Error::new("SCALARS", excerpt(text), "a number of components"))?
            }
        };
        if self.cursor.is_next("LOOKUP_TABLE") {
            self.cursor.word("SCALARS")?;
            self.cursor.word("LOOKUP_TABLE")?;
        } else {
            return Err(Error::new(
                format!("SCALARS {name}"),
                "no LOOKUP_TABLE",
                "LOOKUP_TABLE and its name",
            ));
        }
        let values = self.cursor.values(&name, kind, count.saturating_mul(components))?;
        self.keep(name, components, values);
        Ok(())
    }

    fn keep(&mut self, name: String, components: usize, values: Vec<f64>) {
        if !poly_data::wanted(&name) {
            return;
        }
        let array = Array { name, components, values };
        match self.at {
            At::File => {}
            At::Points(_) => self.data.point_arrays.push(array),
            At::Cells(_) => self.data.cell_arrays.push(array),
        }
    }
}

fn unknown(keyword: &str) -> Error {
    Error::new("", format!("the word {}", excerpt(keyword)), "a section of a legacy VTK poly data file")
}

/// Reads cells as stored before version 5.0: each is a count and then ids. Returns ends and connectivity.
fn cells_by_counts(keyword: &str, numbers: &[f64], cells: usize) -> Result<(Vec<f64>, Vec<f64>)> {
    let (mut ends, mut connectivity) = (Vec::new(), Vec::new());
    let mut rest = numbers;
    while let Some((count, tail)) = rest.split_first() {
        let count = index(&format!("{keyword}: size of cell {}", ends.len()), *count, tail.len() + 1)?;
        connectivity.extend_from_slice(&tail[..count]);
        ends.push(connectivity.len() as f64);
        rest = &tail[count..];
    }
    if ends.len() == cells {
        return Ok((ends, connectivity));
    }
    Err(Error::new(keyword, format!("{} cells", ends.len()), format!("{cells} cells")))
}
