//! Converts header texts to printable lines and numbers, and writes numbers as Python does.

use std::borrow::Cow;

use crate::built_in;

const SHOWN: usize = 60;

/// A text in which replacement characters stand for line breaks and control characters.
#[must_use]
pub fn printable(text: &str) -> String {
    text.chars().map(|letter| if is_printable(letter) { letter } else { '\u{fffd}' }).collect()
}

/// A value of a header's field as one short printable line.
pub(crate) fn shown(value: &str) -> String {
    let text = printable(value);
    if text.chars().count() <= SHOWN {
        return text.split_whitespace().collect::<Vec<_>>().join(" ");
    }
    text.chars().take(SHOWN - 1).chain(['…']).collect()
}

pub(crate) fn quoted(text: &str) -> String {
    let mark = if text.contains('\'') && !text.contains('"') { '"' } else { '\'' };
    let mut out = String::from(mark);
    for letter in text.chars() {
        if letter == mark || letter == '\\' {
            out.push('\\');
        }
        out.push(letter);
    }
    out.push(mark);
    out
}

pub(crate) fn is_all_printable(text: &str) -> bool {
    text.chars().all(is_printable)
}

/// Whether a character may be shown; false for control, unassigned and unusual blank characters.
fn is_printable(letter: char) -> bool {
    if letter.is_ascii() { !letter.is_ascii_control() } else { built_in::is_printable(letter) }
}

/// A line of a header as UTF-8, or as Latin-1 if it is not valid UTF-8, since file names may use either.
pub(crate) fn decoded(line: &[u8]) -> String {
    std::str::from_utf8(line).map_or_else(|_| latin1(line), ToOwned::to_owned)
}

pub(crate) fn latin1(bytes: &[u8]) -> String {
    bytes.iter().map(|&byte| char::from(byte)).collect()
}

pub(crate) fn number(word: &str) -> Option<f64> {
    built_in::real(&ungrouped(word.trim()))
}

/// A number without the underscores that Python allows between digits.
pub(crate) fn ungrouped(word: &str) -> Cow<'_, str> {
    let is_digit =
        |at: Option<usize>| at.and_then(|at| word.as_bytes().get(at)).is_some_and(u8::is_ascii_digit);
    let is_between = |(at, _): (usize, &str)| is_digit(at.checked_sub(1)) && is_digit(Some(at + 1));
    if word.contains('_') && word.match_indices('_').all(is_between) {
        return word.chars().filter(|&letter| letter != '_').collect::<String>().into();
    }
    word.into()
}

pub(crate) fn listed<T: ToString>(values: &[T]) -> String {
    let words: Vec<String> = values.iter().map(T::to_string).collect();
    format!("[{}]", words.join(", "))
}

/// A number with this many significant digits (at most 17), without trailing zeros. The last digit may be off by one.
pub(crate) fn short(value: f64, digits: u32) -> String {
    if !value.is_finite() || value == 0.0 {
        let text = if value.is_nan() { "nan" } else { "inf" };
        return format!("{}{}", sign(value), if value == 0.0 { "0" } else { text });
    }
    let mut exponent = 0;
    let mut left = value.abs();
    while left >= 10.0 {
        left /= 10.0;
        exponent += 1;
    }
    while left < 1.0 {
        left *= 10.0;
        exponent -= 1;
    }
    let most = 10_u64.pow(digits);
    // Powers up to 22 are exact, so that this rounds once before the last digit is rounded.
    let shift = i32::try_from(digits).unwrap_or(i32::MAX) - 1 - exponent;
    let scaled = match shift {
        0..=22 => value.abs() * 10_f64.powi(shift),
        -22..0 => value.abs() / 10_f64.powi(-shift),
        _ => left * (most / 10) as f64,
    };
    let mut number = scaled.round() as u64;
    if number == most {
        number /= 10;
        exponent += 1;
    }
    laid_out(value, &number.to_string(), exponent, i32::try_from(digits).unwrap_or(i32::MAX))
}

fn sign(value: f64) -> &'static str {
    if value.is_sign_negative() && !value.is_nan() { "-" } else { "" }
}

/// A number with these digits, the first of which precedes the point; in exponent form below 10⁻⁴ or from 10^`most`.
pub(crate) fn laid_out(value: f64, digits: &str, exponent: i32, most: i32) -> String {
    let sign = sign(value);
    let digits = digits.trim_end_matches('0');
    if exponent < -4 || exponent >= most {
        let (first, rest) = digits.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        let direction = if exponent < 0 { '-' } else { '+' };
        return format!("{sign}{first}{point}{rest}e{direction}{:02}", exponent.abs());
    }
    if exponent < 0 {
        let zeros = "0".repeat(exponent.unsigned_abs() as usize - 1);
        return format!("{sign}0.{zeros}{digits}");
    }
    let before = exponent.unsigned_abs() as usize + 1;
    if digits.len() <= before {
        return format!("{sign}{digits}{}", "0".repeat(before - digits.len()));
    }
    let (whole, part) = digits.split_at(before);
    format!("{sign}{whole}.{part}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_python_writes_them() {
        let cases = [
            (0.0, "0"),
            (-1.5, "-1.5"),
            (1e16, "1e+16"),
            (0.0001, "0.0001"),
            (0.00001, "1e-05"),
            (999_999.5, "1e+06"),
            (123_456_789.0, "1.23457e+08"),
            (f64::from(0.1_f32), "0.1"),
            (-1024.0, "-1024"),
            (f64::NAN, "nan"),
            (f64::NEG_INFINITY, "-inf"),
        ];
        for (value, six) in cases {
            assert_eq!(short(value, 6), six);
        }
    }

    #[test]
    fn values_are_one_short_printable_line() {
        assert_eq!(shown(" a\n b  c "), "a\u{fffd} b c");
        assert_eq!(shown(&"x".repeat(61)).chars().count(), 60);
        assert_eq!(quoted("it's"), "\"it's\"");
    }
}
