//! Texts of headers: as one printable line, as words, as numbers; and numbers as Python writes them.

const SHOWN: usize = 60;

/// A text without line breaks and control characters, which become replacement characters.
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

/// A text in quotation marks.
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
    if letter.is_ascii() {
        return !letter.is_ascii_control();
    }
    // Rust escapes exactly these characters, and combining marks, but the latter only at the start of a text.
    let mut bytes = [b'a'; 5];
    let length = 1 + letter.encode_utf8(&mut bytes[1..]).len();
    std::str::from_utf8(&bytes[..length]).is_ok_and(|pair| pair.escape_debug().count() == 2)
}

/// A line of a header as UTF-8, or as Latin-1 if it is invalid, since file names may use either.
pub(crate) fn decoded(line: &[u8]) -> String {
    std::str::from_utf8(line).map_or_else(|_| latin1(line), ToOwned::to_owned)
}

pub(crate) fn latin1(bytes: &[u8]) -> String {
    bytes.iter().map(|&byte| char::from(byte)).collect()
}

/// The number that a word stands for.
pub(crate) fn number(word: &str) -> Option<f64> {
    word.trim().parse().ok()
}

/// Numbers between brackets.
pub(crate) fn listed<T: ToString>(values: &[T]) -> String {
    let words: Vec<String> = values.iter().map(T::to_string).collect();
    format!("[{}]", words.join(", "))
}

/// A number with as many digits as tell it from its neighbours.
pub(crate) fn exact(value: f64) -> String {
    let text = laid_out(value, &format!("{:e}", value.abs()), 16);
    let is_whole = value.is_finite() && !text.contains(['.', 'e']);
    if is_whole { text + ".0" } else { text }
}

/// A number with some significant digits, without zeros at its end.
pub(crate) fn short(value: f64, digits: usize) -> String {
    laid_out(value, &format!("{:.*e}", digits - 1, value.abs()), digits)
}

/// Scientific notation as a plain number, unless its exponent is below −4 or at least `most`.
fn laid_out(value: f64, scientific: &str, most: usize) -> String {
    let sign = if value.is_sign_negative() && !value.is_nan() { "-" } else { "" };
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return format!("{sign}{}", scientific.to_lowercase());
    };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let digits: String = mantissa.chars().filter(|&letter| letter != '.').collect();
    let digits = digits.trim_end_matches('0');
    let digits = if digits.is_empty() { "0" } else { digits };
    if exponent < -4 || exponent >= i32::try_from(most).unwrap_or(i32::MAX) {
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
            (0.0, "0", "0.0"),
            (-1.5, "-1.5", "-1.5"),
            (1e16, "1e+16", "1e+16"),
            (0.0001, "0.0001", "0.0001"),
            (0.00001, "1e-05", "1e-05"),
            (123_456_789.0, "1.23457e+08", "123456789.0"),
            (f64::NAN, "nan", "nan"),
            (f64::NEG_INFINITY, "-inf", "-inf"),
        ];
        for (value, six, all) in cases {
            assert_eq!((short(value, 6).as_str(), exact(value).as_str()), (six, all));
        }
    }

    #[test]
    fn values_are_one_short_printable_line() {
        assert_eq!(shown(" a\n b  c "), "a\u{fffd} b c");
        assert_eq!(shown(&"x".repeat(61)).chars().count(), 60);
        assert_eq!(quoted("it's"), "\"it's\"");
    }
}
