//! Reads tables of numbers as text (`.csv`, `.tsv`, `.txt`), with or without a header row.

use std::borrow::Cow;
use std::collections::HashSet;

use crate::centerlines::{Centerlines, Line};
use crate::error::{Error, Result, excerpt};
use crate::placed_points::note_left_out;
use crate::table_columns::{Columns, name_coordinates};
use crate::text::{self, Separator};
use crate::unit::Unit;

/// Each row is a point. A first row `sep=;` is skipped. Lines are separated by blank rows, or by a change in
/// a column such as `line` or `GroupId`; without such a column, also by jumps. Decimal commas are allowed
/// with semicolons. Fails for damaged rows or unclear columns.
pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let Some((first, row)) = text::data_lines(bytes).find(|(_, row)| !names_separator(row)) else {
        return Err(Error::new("", "no row", "a table with a point per row"));
    };
    let separator = separator_of(&row);
    let fields = fields_of(&row, separator);
    let has_header = !all_numbers(&fields, separator);
    let named = match has_header {
        true => Some(Columns::of_header(first, &row, &fields_of(&closed_up(&row, separator), separator))?),
        false => header_in_comment(bytes, first, fields.len())?,
    };
    let guessed = named.is_none();
    let count = || fields.len() + usize::from(has_empty_last(bytes, &row, separator));
    let mut columns = named.map_or_else(|| Columns::of_count(first, count()), Ok)?;
    if columns.unit.is_none() {
        unit_in_comments(bytes, first, &mut columns);
    }
    let mut rows = Rows::new(columns, separator);
    let lines = text::lines(bytes).skip(first - usize::from(!has_header));
    for row in text::rows(lines, separator) {
        let (number, line) = row?;
        if line.trim_start().starts_with('#') {
            continue;
        }
        // Spreadsheets write blank rows as rows of separators.
        match line.trim_matches([' ', '\t', ',', ';']) {
            "" => rows.finish_line(),
            _ => rows.add(number, &line)?,
        }
    }
    rows.finish_line();
    note_left_out(&mut rows.out, rows.undefined, "undefined point(s)", "defined points")?;
    if guessed {
        rows.out.doubt_unnamed_columns();
        refuse_counter(&rows.out.lines)?;
    }
    // If a column separates lines, lines are not split at gaps.
    let whole = rows.columns.key.is_some();
    let out = if whole { rows.out } else { rows.out.parted_at_jumps() };
    out.without_zero_radii().tidy()
}

/// Whether a row only states the separator, as spreadsheets expect.
fn names_separator(row: &str) -> bool {
    let named = row.trim().trim_matches('"').strip_prefix("sep=");
    named.is_some_and(|separator| separator.chars().count() <= 1)
}

/// Removes blanks in front of units (`x (mm)` to `x(mm)`) if blanks separate columns.
fn closed_up(header: &str, separator: Separator) -> Cow<'_, str> {
    if separator != Separator::Blanks {
        return Cow::Borrowed(header);
    }
    Cow::Owned(header.replace(" (", "(").replace(" [", "["))
}

/// Takes the unit from a leading comment like `units: cm`; else notes a unit named in comments.
fn unit_in_comments(bytes: &[u8], first: usize, columns: &mut Columns) {
    let mut other = None;
    for (_, line) in text::lines(bytes).take(first - 1).filter(|(_, line)| line.starts_with('#')) {
        let comment = line.to_lowercase();
        let signs = |c: char| c.is_whitespace() || "#()[],;:=.".contains(c);
        let mut words = comment.split(signs).filter(|word| !word.is_empty());
        // A single letter `m` may mean something other than metres.
        let known = |word: &str| Unit::of_name(word).filter(|unit| *unit != Unit::Metre);
        let Some(unit) = words.clone().find_map(known) else { continue };
        let said = [words.next(), words.next(), words.next()];
        if let [Some("unit" | "units"), Some(word), None] = said
            && known(word).is_some()
        {
            columns.unit = Some(unit);
            columns.notes.push(format!("unit from the comment {}", excerpt(line.trim())));
            return;
        }
        other.get_or_insert_with(|| excerpt(line.trim()));
    }
    if let Some(comment) = other {
        columns.notes.push(format!("the comment {comment} was not taken as the unit of the coordinates"));
    }
}

/// Whether a row can be the first one of a table: at least three numbers, or a header with coordinates.
pub(crate) fn is_first_row(line: &str) -> bool {
    let separator = separator_of(line);
    let fields = fields_of(line, separator);
    let numbers = fields.len() >= 3 && all_numbers(&fields, separator);
    numbers || name_coordinates(&fields)
}

/// Separator of a row. If tabs separate, blanks do too, unless names contain blanks.
fn separator_of(row: &str) -> Separator {
    if let Some(separator) = [';', ','].into_iter().find(|separator| row.contains(*separator)) {
        return Separator::Character(separator);
    }
    let words = text::fields(row, Separator::Blanks);
    if row.contains('\t') && !all_numbers(&words, Separator::Blanks) {
        Separator::Character('\t')
    } else {
        Separator::Blanks
    }
}

fn fields_of(row: &str, separator: Separator) -> Vec<&str> {
    let mut fields = text::fields(row, separator);
    if fields.len() > 1 && fields.last() == Some(&"") {
        fields.pop();
    }
    fields
}

/// Whether the last field is empty in the first row, but not in all rows.
fn has_empty_last(bytes: &[u8], first: &str, separator: Separator) -> bool {
    let count = text::fields(first, separator).len();
    count > fields_of(first, separator).len()
        && text::data_lines(bytes).any(|(_, row)| fields_of(&row, separator).len() == count)
}

/// The radius in a field; NaN if not stated.
fn radius_of(number: usize, field: &str) -> Result<f64> {
    let is_unknown = ["", "nan", "na", "n/a"].into_iter().any(|name| field.eq_ignore_ascii_case(name));
    if is_unknown { Ok(f64::NAN) } else { text::number(number, field) }
}

fn all_numbers(fields: &[&str], separator: Separator) -> bool {
    fields.iter().all(|field| with_point(field, separator).parse::<f64>().is_ok())
}

/// Converts a decimal comma, which is possible only in tables with semicolons.
fn with_point(field: &str, separator: Separator) -> Cow<'_, str> {
    if separator == Separator::Character(';') && field.contains(',') {
        Cow::Owned(field.replace(',', "."))
    } else {
        Cow::Borrowed(field)
    }
}

/// The columns that the last comment before the data names, if their number is right.
fn header_in_comment(bytes: &[u8], first: usize, count: usize) -> Result<Option<Columns>> {
    let comment = text::lines(bytes).take(first - 1).filter(|(_, line)| line.starts_with('#')).last();
    let Some((number, line)) = comment else { return Ok(None) };
    let names = line.trim_start_matches('#');
    let separator = separator_of(names);
    let names = &*closed_up(names, separator);
    let fields = fields_of(names, separator);
    if fields.len() != count || !name_coordinates(&fields) {
        return Ok(None);
    }
    Columns::of_header(number, names, &fields).map(Some)
}

/// Rejects four unnamed columns whose first one only counts rows. They would be read as x, y, z and radius,
/// but probably are a counter, x, y and z.
pub(crate) fn refuse_counter(lines: &[Line]) -> Result<()> {
    let mut x = lines.iter().flat_map(|line| &line.points).map(|p| p.x).enumerate();
    let begins = x.next().map(|(_, first)| first).filter(|first| *first == 0.0 || *first == 1.0);
    let counts = begins.is_some_and(|first| x.all(|(i, x)| x == first + i as f64));
    if !counts || lines.iter().all(|line| line.radius.is_none()) {
        return Ok(());
    }
    Err(Error::new("column 1", "a row number", "columns x, y, z, radius")
        .mend("name the columns in the first line, or remove the row number"))
}

struct Rows {
    columns: Columns,
    separator: Separator,
    out: Centerlines,
    line: Line,
    /// Value of the current centerline in the column that states which centerline a row belongs to.
    key: Option<String>,
    known_keys: HashSet<String>,
    /// Number of points without a position.
    undefined: usize,
}

impl Rows {
    fn new(mut columns: Columns, separator: Separator) -> Self {
        let mut out = Centerlines::of("text table");
        (out.unit, out.space) = (columns.unit, columns.space);
        out.notes = std::mem::take(&mut columns.notes);
        let (line, key, known_keys) = (Line::default(), None, HashSet::new());
        Self { columns, separator, out, line, key, known_keys, undefined: 0 }
    }

    fn add(&mut self, number: usize, row: &str) -> Result<()> {
        let mut fields = text::fields(row, self.separator);
        // Separators at the end of a row are ignored.
        while fields.len() > self.columns.count && fields.last() == Some(&"") {
            fields.pop();
        }
        if fields.len() != self.columns.count {
            let found = format!("{} column(s), {}", fields.len(), excerpt(row));
            return Err(Error::new(
                format!("line {number}"),
                found,
                format!("{} columns", self.columns.count),
            ));
        }
        if !self.is_placed(number, &fields)? {
            self.undefined += 1;
            return Ok(());
        }
        if let Some((column, _)) = self.columns.key {
            self.begin_line(fields[column]);
        }
        let field = |column: usize| with_point(fields[column], self.separator);
        let [x, y, z] = self.columns.xyz.map(field);
        self.line.points.push(text::point(number, [&x, &y, &z])?);
        if let Some((column, factor)) = self.columns.radius {
            let radius = radius_of(number, &field(column))? * factor;
            self.line.radius.get_or_insert_default().push(radius);
        }
        Ok(())
    }

    fn is_placed(&self, number: usize, fields: &[&str]) -> Result<bool> {
        let Some((column, placed)) = self.columns.placed else { return Ok(true) };
        let subject = format!("line {number}: column '{}'", placed.name());
        placed.is_placed(fields[column]).map_err(|error| error.in_file(&subject))
    }

    fn begin_line(&mut self, key: &str) {
        if self.key.as_deref() == Some(key) {
            return;
        }
        self.finish_line();
        if !self.known_keys.insert(key.to_owned()) {
            self.out.note_once(
                "rows of one line are not consecutive: each run of rows is a separate line".into(),
            );
        }
        self.key = Some(key.to_owned());
    }

    fn finish_line(&mut self) {
        let mut line = std::mem::take(&mut self.line);
        if line.points.is_empty() {
            return;
        }
        if let (Some(key), Some((_, is_group))) = (&self.key, self.columns.key) {
            let number = key.parse::<f64>().ok();
            line.group = number.filter(|n| is_group && n.fract() == 0.0).map(|n| n as i64);
            line.name = Some(key.clone()).filter(|key| number.is_none() && !key.is_empty());
        }
        self.out.lines.push(line);
    }
}
