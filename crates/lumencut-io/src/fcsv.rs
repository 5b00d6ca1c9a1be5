//! Reads fiducial lists of 3D Slicer (`.fcsv`).

use crate::centerlines::{Centerlines, Line};
use crate::error::{Error, Result, excerpt};
use crate::placed_points::{has_place, note_left_out};
use crate::space::Space;
use crate::text::{self, Separator};
use crate::unit::Unit;

/// The columns of files that do not name them.
const COLUMNS: &str = "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID";

/// The fiducials as one line, in mm, as the format defines. Coordinates in voxels are rejected.
pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let mut out = Centerlines::of("3D Slicer fiducials");
    out.unit = Some(Unit::Millimetre);
    let mut columns = Columns::of(COLUMNS)?;
    for (number, line) in text::lines(bytes) {
        let Some((key, value)) = line.trim_start().strip_prefix('#').and_then(|text| text.split_once('='))
        else {
            continue;
        };
        match key.trim() {
            "CoordinateSystem" => {
                out.space = Some(space(value.trim()).map_err(|e| e.in_file(&format!("line {number}")))?);
            }
            "columns" => columns = Columns::of(value).map_err(|e| e.in_file(&format!("line {number}")))?,
            _ => {}
        }
    }
    let mut line = Line::default();
    let (mut hidden, mut without_place) = (0, 0);
    let separator = Separator::Character(',');
    for row in text::rows(text::data_lines(bytes), separator) {
        let (number, row) = row?;
        let fields = text::fields(&row, separator);
        let [Some(x), Some(y), Some(z)] = columns.xyz.map(|column| fields.get(column).copied()) else {
            return Err(Error::truncated(
                format!("line {number}"),
                excerpt(&row),
                "the columns of the header",
            ));
        };
        // 3D Slicer writes the status after the named columns.
        let status = fields.get(columns.count).copied().unwrap_or_default();
        if !has_place(status).map_err(|e| e.in_file(&format!("line {number}: positionStatus")))? {
            without_place += 1;
            continue;
        }
        let visible = columns.visible.and_then(|column| fields.get(column));
        hidden += usize::from(visible.is_some_and(|visible| *visible == "0"));
        line.points.push(text::point(number, [x, y, z])?);
    }
    out.notes.push(format!("the {} fiducials are read as one line, in file order", line.points.len()));
    out.lines.push(line);
    note_left_out(&mut out, without_place, "fiducial(s) without a position", "with one")?;
    if hidden > 0 {
        out.notes.push(format!("{hidden} fiducial(s) hidden in 3D Slicer are included"));
    }
    out.tidy()
}

/// The space, given by its name, or by its number before version 4.11.
fn space(text: &str) -> Result<Space> {
    match text.split(',').next().unwrap_or_default().trim() {
        "RAS" | "0" => Ok(Space::Ras),
        "LPS" | "1" => Ok(Space::Lps),
        "IJK" | "2" => Err(Error::new("CoordinateSystem", "IJK, indices of voxels", "RAS or LPS")
            .mend("save the fiducials in RAS or LPS")),
        other => Err(Error::new("CoordinateSystem", excerpt(other), "RAS (0) or LPS (1)")),
    }
}

struct Columns {
    xyz: [usize; 3],
    visible: Option<usize>,
    count: usize,
}

impl Columns {
    fn of(names: &str) -> Result<Self> {
        let names: Vec<&str> = names.split(',').map(str::trim).collect();
        let of = |wanted: &str| names.iter().position(|name| *name == wanted);
        let (Some(x), Some(y), Some(z)) = (of("x"), of("y"), of("z")) else {
            return Err(Error::new("columns", excerpt(&names.join(",")), "the columns x, y and z"));
        };
        Ok(Self { xyz: [x, y, z], visible: of("vis"), count: names.len() })
    }
}
