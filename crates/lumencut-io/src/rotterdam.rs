//! Reads reference centerlines of the Rotterdam Coronary Artery Algorithm Evaluation (`reference.txt`).

use crate::centerlines::{Centerlines, Line};
use crate::error::{Error, Result, excerpt};
use crate::table;
use crate::text::{self, Separator};

/// Possible numbers of columns: x, y, z, radius, and usually the variance between observers.
const COLUMNS: [usize; 2] = [4, 5];

/// One line, without a space or unit. Rejects files whose first column only counts rows.
pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let (mut points, mut radius) = (Vec::new(), Vec::new());
    for (number, row) in text::data_lines(bytes) {
        let fields = text::fields(&row, Separator::Blanks);
        let ([x, y, z, r] | [x, y, z, r, _]) = fields[..] else {
            let expected = "4 or 5 numbers: x y z radius [variance]";
            return Err(Error::new(format!("line {number}"), excerpt(&row), expected));
        };
        if let Some(variance) = fields.get(4) {
            text::number(number, variance)?;
        }
        points.push(text::point(number, [x, y, z])?);
        radius.push(text::number(number, r)?);
    }
    let mut out = Centerlines::of("Rotterdam reference");
    out.lines.push(Line { points, radius: Some(radius), ..Line::default() });
    table::refuse_counter(&out.lines)?;
    out.without_zero_radii().tidy()
}

/// Whether a row fits: four or five columns in `reference.txt`, or five without header elsewhere.
pub(crate) fn is_row(row: &str, file_name: &str) -> bool {
    let fields = text::fields(row, Separator::Blanks);
    let named = file_name.ends_with("reference.txt");
    COLUMNS.contains(&fields.len())
        && (named || fields.len() == COLUMNS[1])
        && fields.iter().all(|field| text::number(0, field).is_ok())
}
