//! Cells of tables: texts as spreadsheets show them, and do not run them.

use std::borrow::Cow;

/// How a cell begins that spreadsheets run as a formula.
const FORMULA: [char; 6] = ['=', '+', '-', '@', '\t', '\r'];

/// The text of a cell. One that begins as a formula does and is no number stands behind an apostrophe. So does one that begins with
/// apostrophes before such a sign: each cell is read back as the text that it was.
pub fn marked_cell(text: &str) -> Cow<'_, str> {
    if text.trim_start_matches('\'').starts_with(FORMULA) && !is_number(text) {
        return Cow::Owned(format!("'{text}"));
    }
    Cow::Borrowed(text)
}

/// Whether a text is a decimal number.
fn is_number(text: &str) -> bool {
    text.chars().all(|c| c.is_ascii_digit() || "+-.eE".contains(c)) && text.parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_begins_as_a_formula_is_marked() {
        for text in [
            "=1+1", "+1+1", "-1-", "@SUM(1)", "\t=1", "\r=1", "-", "--1", "+e5", "'=1", "''@", "-inf", "+nan",
        ] {
            assert_eq!(marked_cell(text), format!("'{text}"));
        }
        for text in ["", "LAD", "-1", "+.5", "-2.5e-3", "-3.", "1=1", "'LAD", "'", " =1"] {
            assert_eq!(marked_cell(text), text);
        }
    }
}
