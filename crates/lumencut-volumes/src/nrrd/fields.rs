//! The fields of an NRRD header that place and describe the voxels.

use crate::error::Error;
use crate::text::{decoded, number};

/// Number of bytes in which the end of the header is searched.
pub(crate) const LONGEST_HEADER: u64 = 1 << 20;
const LONGEST_VALUE: usize = 4096;
const NEWEST: i64 = 5;
const FIELDS: [&str; 16] = [
    "type",
    "dimension",
    "sizes",
    "encoding",
    "endian",
    "kinds",
    "data file",
    "line skip",
    "byte skip",
    "space",
    "space dimension",
    "space directions",
    "space origin",
    "space units",
    "spacings",
    "axis mins",
];

pub(crate) type Direction = Option<Vec<f64>>;

pub(crate) struct Header<'a> {
    pub(crate) path: &'a str,
    fields: Vec<(&'static str, String)>,
    pub(crate) lines: Vec<String>,
    pub(crate) end: u64,
    pub(crate) content: String,
}

impl<'a> Header<'a> {
    pub(crate) fn read(path: &'a str, head: &[u8]) -> Result<Self, Box<Error>> {
        if !head.starts_with(b"NRRD") {
            let error = Error::new(path, "a compressed NRRD file", "a plain one");
            return Err(error.mend("decompress it first"));
        }
        let (mut lines, end) = lines_of(path, head)?;
        let version = lines.remove(0).strip_prefix("NRRD").and_then(|text| text.trim().parse::<i64>().ok());
        if version.is_none_or(|version| version > NEWEST) {
            return Err(Error::new(path, "a newer or no NRRD version", "NRRD0001 to NRRD0005"));
        }
        let mut header = Self { path, fields: Vec::new(), lines, end, content: String::new() };
        header.fields = header.stated()?;
        header.content = header.content_of();
        header.check()?;
        Ok(header)
    }

    fn stated(&self) -> Result<Vec<(&'static str, String)>, Box<Error>> {
        let mut fields: Vec<(&'static str, String)> = Vec::new();
        for line in &self.lines {
            let Some((name, value)) = line.split_once(':') else { continue };
            let Some(name) = full_name(name) else { continue };
            if line.starts_with('#') || value.starts_with('=') {
                continue;
            }
            if fields.iter().any(|(known, _)| *known == name) {
                let found = format!("two fields '{name}'");
                return Err(Error::new(self.path, found, "one").mend("remove one of them"));
            }
            let letters = value.chars().count();
            if letters > LONGEST_VALUE {
                let found = format!("{letters} letters in the field '{name}'");
                return Err(Error::new(self.path, found, format!("at most {LONGEST_VALUE}")));
            }
            fields.push((name, value.trim().into()));
        }
        Ok(fields)
    }

    fn content_of(&self) -> String {
        let mut fields = self.lines.iter().filter_map(|line| line.split_once(':'));
        let content = fields.find(|(name, _)| name.trim().eq_ignore_ascii_case("content"));
        content.map(|(_, value)| value.trim().to_owned()).unwrap_or_default()
    }

    fn check(&self) -> Result<(), Box<Error>> {
        for name in ["dimension", "line skip", "byte skip", "space dimension"] {
            self.whole(name)?;
        }
        for name in ["sizes", "spacings", "axis mins"] {
            self.numbers(name)?;
        }
        self.directions()?;
        self.origin()?;
        self.words("space units")?;
        Ok(())
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.fields.iter().any(|(known, _)| *known == name)
    }

    pub(crate) fn text(&self, name: &str) -> &str {
        self.fields.iter().find(|(known, _)| *known == name).map_or("", |(_, value)| value)
    }

    pub(crate) fn required(&self, name: &str) -> Result<&str, Box<Error>> {
        if self.has(name) {
            return Ok(self.text(name));
        }
        let expected = "an NRRD header with type, dimension, sizes, encoding";
        Err(Error::new(self.path, format!("no field '{name}'"), expected))
    }

    /// The integer in a field; 0 if it is not stated.
    pub(crate) fn whole(&self, name: &str) -> Result<i64, Box<Error>> {
        if self.has(name) { self.text(name).parse().map_err(|_| self.unreadable()) } else { Ok(0) }
    }

    pub(crate) fn numbers(&self, name: &str) -> Result<Vec<f64>, Box<Error>> {
        let words = self.text(name).split_whitespace();
        words.map(|word| number(word).ok_or_else(|| self.unreadable())).collect()
    }

    /// The sizes, truncated to integers; those outside the 64-bit range become the smallest integer.
    pub(crate) fn sizes(&self) -> Result<Vec<i64>, Box<Error>> {
        const LIMIT: f64 = (1_u64 << 63) as f64;
        let whole = |value: f64| if value.abs() < LIMIT { value as i64 } else { i64::MIN };
        Ok(self.numbers("sizes")?.into_iter().map(whole).collect())
    }

    /// The vectors of the axes; None if the field is not stated. Axes without a direction are `none` or all NaN.
    pub(crate) fn directions(&self) -> Result<Option<Vec<Direction>>, Box<Error>> {
        const FIELD: &str = "space directions";
        if !self.has(FIELD) {
            return Ok(None);
        }
        let mut vectors = Vec::new();
        let mut rest = self.text(FIELD);
        while !rest.is_empty() {
            let end = if rest.starts_with('(') { rest.find(')').map(|at| at + 1) } else { None };
            let end = end.or_else(|| rest.find(char::is_whitespace)).unwrap_or(rest.len());
            let (word, after) = rest.split_at(end);
            let vector = if word.eq_ignore_ascii_case("none") { None } else { Some(self.vector(word)?) };
            vectors.push(vector);
            rest = after.trim_start();
            if rest.len() == after.len() && !rest.is_empty() {
                return Err(self.unreadable());
            }
        }
        let mut lengths = vectors.iter().flatten().map(Vec::len);
        let first = lengths.next();
        if vectors.is_empty() || lengths.any(|length| Some(length) != first) {
            return Err(self.unreadable());
        }
        let has_numbers = |vector: &Vec<f64>| !vector.iter().all(|value| value.is_nan());
        Ok(Some(vectors.into_iter().map(|vector| vector.filter(has_numbers)).collect()))
    }

    pub(crate) fn origin(&self) -> Result<Option<Vec<f64>>, Box<Error>> {
        const FIELD: &str = "space origin";
        if self.has(FIELD) { self.vector(self.text(FIELD)).map(Some) } else { Ok(None) }
    }

    fn vector(&self, word: &str) -> Result<Vec<f64>, Box<Error>> {
        let inside = word.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
        let inside = inside.ok_or_else(|| self.unreadable())?;
        inside.split(',').map(|word| number(word).ok_or_else(|| self.unreadable())).collect()
    }

    /// The words of a field, split as a shell does, with both kinds of quotation marks and backslashes.
    pub(crate) fn words(&self, name: &str) -> Result<Vec<String>, Box<Error>> {
        let mut words = Vec::new();
        let mut word: Option<String> = None;
        let mut mark = None;
        let mut letters = self.text(name).chars();
        while let Some(letter) = letters.next() {
            match (mark, letter) {
                (Some(open), _) if letter == open => mark = None,
                (None, '\'' | '"') => {
                    mark = Some(letter);
                    word.get_or_insert_default();
                }
                (None | Some('"'), '\\') => {
                    let escaped = letters.next().ok_or_else(|| self.unreadable())?;
                    word.get_or_insert_default().push(escaped);
                }
                (None, ' ' | '\t' | '\r' | '\n') => words.extend(word.take()),
                _ => word.get_or_insert_default().push(letter),
            }
        }
        if mark.is_some() {
            return Err(self.unreadable());
        }
        words.extend(word);
        Ok(words)
    }

    fn unreadable(&self) -> Box<Error> {
        let found = "a field of the header that cannot be read";
        Error::new(self.path, found, "numbers as NRRD writes them")
    }
}

fn full_name(name: &str) -> Option<&'static str> {
    let name = name.to_ascii_lowercase().split_whitespace().collect::<Vec<_>>().join(" ");
    let is_same = |field: &str| field.bytes().filter(|&byte| byte != b' ').eq(name.bytes());
    FIELDS.into_iter().find(|field| *field == name || is_same(field))
}

/// The lines of a header, up to an empty line or the end of the file, and the byte after them.
fn lines_of(path: &str, head: &[u8]) -> Result<(Vec<String>, u64), Box<Error>> {
    let (mut lines, mut end) = (Vec::new(), 0);
    for line in head.split_inclusive(|&byte| byte == b'\n') {
        if !line.ends_with(b"\n") && head.len() as u64 == LONGEST_HEADER {
            let found = format!("a header of over {LONGEST_HEADER} bytes");
            return Err(Error::new(path, found, "an NRRD header"));
        }
        end += line.len() as u64;
        let line = decoded(line.trim_ascii_end());
        if line.is_empty() {
            break;
        }
        lines.push(line);
    }
    Ok((lines, end))
}
