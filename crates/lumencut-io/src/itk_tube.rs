//! Reads tubes of ITK and TubeTK (`.tre`), which are MetaIO scenes with points as text or bytes.

use std::collections::HashMap;

use glam::{DAffine3, DMat3, DVec3};

use crate::centerlines::{Centerlines, Line};
use crate::data_array::{ByteOrder, NumberType, number_of_word};
use crate::error::{Error, Result, excerpt};
use crate::meta_object::{MetaObject, one_of};
use crate::space::Space;
use crate::unit::Unit;
use crate::vtk_cursor::Cursor;

const MOST_PARENTS: usize = 64;

/// One line per tube, in LPS and mm, as the format defines. Points are multiplied by `ElementSpacing`, radii
/// by its first component. Then the transforms of the tube and of its parents apply.
pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let mut out = Centerlines::of("ITK tube");
    (out.space, out.unit) = (Some(Space::Lps), Some(Unit::Millimetre));
    let objects = objects(bytes, &mut out)?;
    let scene = Scene::new(&objects);
    for tube in &objects {
        if let Some(line) = &tube.line {
            let world = scene.world_from_object(tube, &mut out)?;
            let line = placed(line.clone(), world, &mut out);
            out.lines.push(line);
        }
    }
    if out.lines.is_empty() {
        return Err(Error::new("", format!("{} object(s) but no tube", objects.len()), "a scene with tubes"));
    }
    out.without_zero_radii().tidy()
}

/// All objects of the file; the lines are not yet transformed.
fn objects(bytes: &[u8], out: &mut Centerlines) -> Result<Vec<MetaObject>> {
    let mut cursor = Cursor::new(bytes.trim_ascii_start());
    let mut objects: Vec<MetaObject> = Vec::new();
    while let Some(text) = cursor.line() {
        if text.is_empty() {
            continue;
        }
        let Some((key, value)) = text.split_once('=').map(|(key, value)| (key.trim(), value.trim())) else {
            return Err(Error::new("", excerpt(&text), "a MetaIO field 'Key = value'"));
        };
        match (key, objects.last_mut()) {
            ("ObjectType", last) => {
                last.map_or(Ok(()), |last| last.check_points())?;
                objects.push(MetaObject::new(value));
            }
            ("Points", Some(object)) if object.is_tube() => {
                let line = points(object, &mut cursor).map_err(|e| e.in_file(&object.title()))?;
                object.line = Some(line);
            }
            ("Points", Some(_)) => {
                out.note_once("objects other than tubes were ignored".into());
                cursor.skip_to(b"ObjectType");
            }
            (_, Some(object)) => object.set(key, value),
            // Text before the first object is a comment.
            (_, None) => {}
        }
    }
    objects.last().map_or(Ok(()), MetaObject::check_points)?;
    Ok(objects)
}

fn points(object: &MetaObject, cursor: &mut Cursor) -> Result<Line> {
    let dimensions = object.get("NDims").unwrap_or_default();
    if dimensions != "3" {
        return Err(Error::new("NDims", excerpt(dimensions), "3: a tube in space"));
    }
    let names: Vec<&str> = object.get("PointDim").unwrap_or_default().split_whitespace().collect();
    let of = |wanted: &[&str]| names.iter().position(|name| one_of(name, wanted));
    let (Some(x), Some(y), Some(z)) = (of(&["x"]), of(&["y"]), of(&["z"])) else {
        return Err(Error::new("PointDim", excerpt(&names.join(" ")), "the names x, y and z"));
    };
    let radius = of(&["r", "rad", "radius", "s"]);
    let values = values(object, cursor, names.len())?;
    let spacing = object.spacing()?;
    let rows = values.chunks_exact(names.len());
    Ok(Line {
        points: rows.clone().map(|row| DVec3::new(row[x], row[y], row[z]) * spacing).collect(),
        radius: radius.map(|r| rows.map(|row| row[r] * spacing.x).collect()),
        group: None,
        name: object.get("Name").filter(|name| !name.is_empty()).map(str::to_owned),
        ..Line::default()
    })
}

fn values(object: &MetaObject, cursor: &mut Cursor, columns: usize) -> Result<Vec<f64>> {
    let count = object.get("NPoints").unwrap_or_default();
    let count: usize =
        count.parse().map_err(|_| Error::new("NPoints", excerpt(count), "a whole number from 0"))?;
    let count = count.saturating_mul(columns);
    if !object.is_true("BinaryData") {
        return (0..count)
            .map(|read| {
                let word = cursor.next_word().ok_or_else(|| {
                    Error::truncated("Points", format!("{read} numbers"), format!("{count} numbers"))
                })?;
                number_of_word("Points", &word, NumberType::F64)
            })
            .collect();
    }
    if object.is_true("CompressedData") {
        return Err(Error::new("CompressedData", "compressed points", "points that are not compressed"));
    }
    let element = object.get("ElementType").unwrap_or("MET_FLOAT");
    if element != "MET_FLOAT" {
        return Err(Error::new("ElementType", excerpt(element), "MET_FLOAT, the type of binary points"));
    }
    let msb = object.is_true("BinaryDataByteOrderMSB") || object.is_true("ElementByteOrderMSB");
    let order = if msb { ByteOrder::Big } else { ByteOrder::Little };
    let bytes = cursor.bytes("Points", count.saturating_mul(NumberType::F32.size()))?;
    // Older programs leave unused bytes after the points.
    cursor.skip_to(b"ObjectType");
    Ok(NumberType::F32.numbers(bytes, order))
}

struct Scene<'a> {
    objects: &'a [MetaObject],
    by_id: HashMap<i64, usize>,
}

impl<'a> Scene<'a> {
    fn new(objects: &'a [MetaObject]) -> Self {
        let mut by_id = HashMap::new();
        for (i, object) in objects.iter().enumerate() {
            if let Some(id) = object.id("ID") {
                by_id.entry(id).or_insert(i);
            }
        }
        Self { objects, by_id }
    }

    fn world_from_object(&self, object: &MetaObject, out: &mut Centerlines) -> Result<DAffine3> {
        let mut world = object.parent_from_object()?;
        let mut at = object;
        for _ in 0..MOST_PARENTS {
            let Some(id) = at.id("ParentID") else { return Ok(world) };
            let Some(parent) = self.by_id.get(&id) else {
                out.note_once(
                    "objects whose parent is not in the file are treated as top-level objects".into(),
                );
                return Ok(world);
            };
            at = &self.objects[*parent];
            let transform = at.parent_from_object()?;
            if transform != DAffine3::IDENTITY {
                out.note_once("transforms of parent objects were applied to their children".into());
            }
            world = transform * world;
        }
        let found = format!("more than {MOST_PARENTS} parents, or a cycle of parents");
        Err(Error::new(object.title(), found, "a chain of parents that ends at -1"))
    }
}

fn placed(mut line: Line, world: DAffine3, out: &mut Centerlines) -> Line {
    if world == DAffine3::IDENTITY {
        return line;
    }
    line.points.iter_mut().for_each(|p| *p = world.transform_point3(*p));
    let scale = DMat3::determinant(&world.matrix3).abs().cbrt();
    if (scale - 1.0).abs() > 1e-6 {
        line.radius.iter_mut().flatten().for_each(|r| *r *= scale);
        out.note_once("the scaling of a transform was also applied to the radius".into());
    }
    line
}
