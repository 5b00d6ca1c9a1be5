//! Formats numbers in messages in the same way as Python.

/// The shortest text that identifies a number, such as `0.5`, `2.0`, `1e-05` or `nan`.
pub(crate) fn shortest(number: f64) -> String {
    let magnitude = number.abs();
    if !number.is_finite() {
        return special(number);
    }
    if magnitude == 0.0 || (1e-4..1e16).contains(&magnitude) {
        return format!("{number:?}");
    }
    let scientific = format!("{number:e}");
    let (digits, exponent) = parts(&scientific);
    format!("{digits}e{}", two_digits(exponent))
}

/// Rounded to `digits` significant digits without trailing zeros, such as `0.5`, `12.3` or `1e+06`.
pub(crate) fn rounded(number: f64, digits: usize) -> String {
    if !number.is_finite() {
        return special(number);
    }
    let scientific = format!("{number:.*e}", digits - 1);
    let (mantissa, exponent) = parts(&scientific);
    if exponent < -4 || exponent >= digits as i32 {
        return format!("{}e{}", without_zeros(mantissa), two_digits(exponent));
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    without_zeros(&format!("{number:.decimals$}")).to_owned()
}

/// With `decimals` digits after the point, such as `12.30`.
pub(crate) fn fixed(number: f64, decimals: usize) -> String {
    if number.is_finite() { format!("{number:.decimals$}") } else { special(number) }
}

fn special(number: f64) -> String {
    let name = match number {
        _ if number.is_nan() => "nan",
        _ if number > 0.0 => "inf",
        _ => "-inf",
    };
    name.to_owned()
}

/// Mantissa and exponent of a number such as `1.5e-7`.
fn parts(scientific: &str) -> (&str, i32) {
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((scientific, "0"));
    (mantissa, exponent.parse().unwrap_or(0))
}

fn two_digits(exponent: i32) -> String {
    format!("{}{:02}", if exponent < 0 { '-' } else { '+' }, exponent.abs())
}

fn without_zeros(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_form_is_that_of_python() {
        let cases = [
            (0.0, "0.0"),
            (-0.0, "-0.0"),
            (1.0, "1.0"),
            (0.1, "0.1"),
            (1e-4, "0.0001"),
            (1e-5, "1e-05"),
            (-1.25e-7, "-1.25e-07"),
            (9_999_999_999_999_998.0, "9999999999999998.0"),
            (1e16, "1e+16"),
            (1.5e300, "1.5e+300"),
            (f64::NAN, "nan"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
        ];
        for (number, text) in cases {
            assert_eq!(shortest(number), text);
        }
    }

    #[test]
    fn digits_behind_the_point_are_those_of_python() {
        let cases =
            [(2.5, 0, "2"), (49.5, 0, "50"), (0.125, 2, "0.12"), (-0.04, 1, "-0.0"), (f64::NAN, 2, "nan")];
        for (number, decimals, text) in cases {
            assert_eq!(fixed(number, decimals), text);
        }
    }

    #[test]
    fn three_digits_are_those_of_python() {
        let cases = [
            (0.0, "0"),
            (5.0, "5"),
            (-12.34, "-12.3"),
            (999.5, "1e+03"),
            (999.4, "999"),
            (123_456.0, "1.23e+05"),
            (0.000_123_4, "0.000123"),
            (0.000_012_3, "1.23e-05"),
            (1e13, "1e+13"),
            (f64::INFINITY, "inf"),
        ];
        for (number, text) in cases {
            assert_eq!(rounded(number, 3), text);
        }
    }
}
