//! Splits text files into lines and fields, and reads numbers.

use std::borrow::Cow;

use glam::DVec3;

use crate::error::{Error, Result, excerpt};

type Numbered<'t> = (usize, Cow<'t, str>);

const MOST_FIELDS: usize = 1024;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Separator {
    Character(char),
    Blanks,
}

/// Text lines, numbered from 1. They end with LF or CR LF, or with CR if there is no LF.
pub(crate) fn lines(text: &[u8]) -> impl Iterator<Item = Numbered<'_>> {
    let end = if text.contains(&b'\n') { b'\n' } else { b'\r' };
    text.split(move |b| *b == end)
        .enumerate()
        .map(|(i, line)| (i + 1, String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(line))))
}

/// Text lines that are neither blank nor comments with `#`.
pub(crate) fn data_lines(text: &[u8]) -> impl Iterator<Item = Numbered<'_>> {
    lines(text).filter(|(_, line)| !line.trim_start().is_empty() && !line.trim_start().starts_with('#'))
}

/// Rows with the number of their first text line; quoted text may extend over several.
pub(crate) fn rows<'t>(
    mut lines: impl Iterator<Item = Numbered<'t>>,
    separator: Separator,
) -> impl Iterator<Item = Result<Numbered<'t>>> {
    std::iter::from_fn(move || {
        let (number, mut row) = lines.next()?;
        let Separator::Character(separator) = separator else { return Some(Ok((number, row))) };
        if row.trim_start().starts_with('#') {
            return Some(Ok((number, row)));
        }
        let mut at = At::Begin.behind(&row, separator);
        while at == At::Quoted {
            let Some((_, more)) = lines.next() else {
                let found = "an unclosed quotation mark";
                return Some(Err(Error::new(format!("line {number}"), found, "a closing quotation mark")));
            };
            at = at.behind(&more, separator);
            row = Cow::Owned(row.into_owned() + "\n" + &more);
        }
        Some(Ok((number, row)))
    })
}

/// State of the parser. A field is quoted if it starts with a quotation mark. A doubled mark does not end it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum At {
    Begin,
    Plain,
    Quoted,
    /// After a quotation mark that either ends the field or is the first one of two.
    Closed,
}

impl At {
    fn after(self, c: char, separator: char) -> Self {
        match self {
            Self::Quoted if c == '"' => Self::Closed,
            Self::Quoted => Self::Quoted,
            _ if c == separator => Self::Begin,
            Self::Begin | Self::Closed if c == '"' => Self::Quoted,
            Self::Begin if c.is_whitespace() => Self::Begin,
            _ => Self::Plain,
        }
    }

    fn behind(self, text: &str, separator: char) -> Self {
        text.chars().fold(self, |at, c| at.after(c, separator))
    }
}

/// Splits a row into its fields, without surrounding blanks and quotes. Separators inside quotes are text.
pub(crate) fn fields(line: &str, separator: Separator) -> Vec<&str> {
    match separator {
        Separator::Blanks => line.split_ascii_whitespace().take(MOST_FIELDS + 1).map(unquoted).collect(),
        Separator::Character(separator) => {
            let mut at = At::Begin;
            let ends = |c: char| {
                at = at.after(c, separator);
                at == At::Begin && c == separator
            };
            line.split(ends).take(MOST_FIELDS + 1).map(unquoted).collect()
        }
    }
}

fn unquoted(field: &str) -> &str {
    let field = field.trim();
    field.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).map_or(field, str::trim)
}

pub(crate) fn number(line: usize, field: &str) -> Result<f64> {
    let number = field.parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| Error::new(format!("line {line}"), excerpt(field), "a finite number"))
}

pub(crate) fn point(line: usize, [x, y, z]: [&str; 3]) -> Result<DVec3> {
    Ok(DVec3::new(number(line, x)?, number(line, y)?, number(line, z)?))
}
