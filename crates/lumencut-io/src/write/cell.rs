//! Writes cells of tables in such a way that spreadsheets show but do not execute them.

use std::borrow::Cow;

/// Characters with which a formula starts.
const FORMULA: [char; 6] = ['=', '+', '-', '@', '\t', '\r'];

/// The text of a cell. If it looks like a formula but is not a number, an apostrophe is put in front. If text
/// begins with apostrophes before a formula, it gets one more, so that reading can restore it.
pub fn marked_cell(text: &str) -> Cow<'_, str> {
    if text.trim_start_matches('\'').starts_with(FORMULA) && !is_number(text) {
        return Cow::Owned(format!("'{text}"));
    }
    Cow::Borrowed(text)
}

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
