//! Formats counts, lists and numbers for texts.

pub(crate) const MENTIONED: usize = 4;
const SHOWN: usize = 60;
const LINE: usize = 64;

pub(crate) fn counted(count: i64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

pub(crate) fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let first: Vec<&str> = names.iter().take(MENTIONED).map(AsRef::as_ref).collect();
    let more = names.len().saturating_sub(MENTIONED);
    first.join(", ") + &if more > 0 { format!(" and {more} more") } else { String::new() }
}

/// Rounds to `digits` significant digits, without zeros at the end, such as `0.5` or `1e+06`.
pub(crate) fn rounded(number: f64, digits: usize) -> String {
    if !number.is_finite() {
        let name = if number.is_nan() { "nan" } else { "inf" };
        return format!("{}{name}", if number < 0.0 { "-" } else { "" });
    }
    let scientific = format!("{number:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if exponent < -4 || exponent >= digits as i32 {
        let sign = if exponent < 0 { '-' } else { '+' };
        return format!("{}e{sign}{:02}", without_zeros(mantissa), exponent.abs());
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    without_zeros(&format!("{number:.decimals$}")).to_owned()
}

fn without_zeros(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

/// Numbers in brackets, such as `(0, 0, 4)`.
pub(crate) fn bracketed(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|&number| rounded(number, 6)).collect();
    format!("({})", numbers.join(", "))
}

pub(crate) fn quoted(text: &str) -> String {
    let mark = if text.contains('\'') && !text.contains('"') { '"' } else { '\'' };
    let mut out = String::from(mark);
    for letter in text.chars() {
        match letter {
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            _ if letter == mark || letter == '\\' => out.extend(['\\', letter]),
            _ if is_printable(letter) => out.push(letter),
            _ => out.push_str(&escaped(u32::from(letter))),
        }
    }
    out.push(mark);
    out
}

fn escaped(code: u32) -> String {
    match code {
        0..=0xff => format!("\\x{code:02x}"),
        0x100..=0xffff => format!("\\u{code:04x}"),
        _ => format!("\\U{code:08x}"),
    }
}

/// Replaces line breaks and control characters.
pub(crate) fn printable(text: &str) -> String {
    text.chars().map(|letter| if is_printable(letter) { letter } else { '\u{fffd}' }).collect()
}

pub(crate) fn shown(value: &str) -> String {
    let text = printable(value);
    if text.chars().count() <= SHOWN {
        return text.split_whitespace().collect::<Vec<_>>().join(" ");
    }
    text.chars().take(SHOWN - 1).chain(['…']).collect()
}

pub(crate) fn line(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ").chars().filter(|&letter| is_printable(letter)).take(LINE).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_python() {
        for (number, digits, text) in [
            (0.0, 6, "0"),
            (4.0, 4, "4"),
            (1.297_837_8, 4, "1.298"),
            (-249.511_718_75, 6, "-249.512"),
            (0.3, 3, "0.3"),
            (999.96, 4, "1000"),
            (123_456.0, 4, "1.235e+05"),
            (0.000_012_3, 3, "1.23e-05"),
            (f64::NEG_INFINITY, 3, "-inf"),
            (f64::NAN, 3, "nan"),
        ] {
            assert_eq!(rounded(number, digits), text);
        }
        assert_eq!(bracketed(&[0.0, -0.5, 4e9]), "(0, -0.5, 4e+09)");
    }

    #[test]
    fn lists_are_short() {
        assert_eq!(listed(&["a", "b"]), "a, b");
        assert_eq!(listed(&["a", "b", "c", "d", "e", "f"]), "a, b, c, d and 2 more");
        assert_eq!((counted(1, "slice"), counted(2, "slice")), ("1 slice".into(), "2 slices".into()));
    }

    #[test]
    fn texts_stay_on_their_line() {
        assert_eq!(printable("a\x1b[31m\n\u{202e}ü e\u{301}"), "a\u{fffd}[31m\u{fffd}\u{fffd}ü e\u{301}");
        assert_eq!(line(" Abdomen \n 2.0\u{200b} "), "Abdomen 2.0");
        assert_eq!(line(&"7".repeat(80)).len(), 64);
        assert_eq!(shown(&"7".repeat(80)).chars().count(), 60);
        assert_eq!(quoted("it's\u{1b}"), "\"it's\\x1b\"");
        assert_eq!(quoted("a'\"\\\u{202e}"), "'a\\'\"\\\\\\u202e'");
    }
}
