//! Parses numbers and recognises printable characters. Rust's tables for this would be a fifth of the page's small
//! module, so in browsers JavaScript does it.

#[cfg(target_arch = "wasm32")]
pub(crate) use browser::{is_printable, real};

/// The number that a word states, rounded to the nearest float.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn real(word: &str) -> Option<f64> {
    word.parse().ok()
}

/// Whether a character outside ASCII may be shown.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn is_printable(letter: char) -> bool {
    // Rust escapes exactly these characters, and combining marks, but the latter only at the start of a text.
    let mut bytes = [b'a'; 5];
    let length = 1 + letter.encode_utf8(&mut bytes[1..]).len();
    std::str::from_utf8(&bytes[..length]).is_ok_and(|pair| pair.escape_debug().count() == 2)
}

#[cfg(target_arch = "wasm32")]
mod browser {
    use wasm_bindgen::prelude::wasm_bindgen;

    #[wasm_bindgen]
    extern "C" {
        /// NaN if the text is not a number.
        #[wasm_bindgen(js_name = Number)]
        fn number(text: &str) -> f64;

        type RegExp;

        #[wasm_bindgen(constructor)]
        fn new(pattern: &str, flags: &str) -> RegExp;

        #[wasm_bindgen(method)]
        fn test(this: &RegExp, text: &str) -> bool;
    }

    pub(crate) fn real(word: &str) -> Option<f64> {
        let plain = word.strip_prefix(['+', '-']).unwrap_or(word);
        let is_part = |byte: u8| byte.is_ascii_digit() || b".eE+-".contains(&byte);
        let value = if plain.eq_ignore_ascii_case("inf") || plain.eq_ignore_ascii_case("infinity") {
            f64::INFINITY
        } else if plain.eq_ignore_ascii_case("nan") {
            f64::NAN
        } else if !plain.is_empty() && !plain.starts_with(['+', '-']) && plain.bytes().all(is_part) {
            Some(number(plain)).filter(|value| !value.is_nan())?
        } else {
            return None;
        };
        Some(if word.starts_with('-') { -value } else { value })
    }

    pub(crate) fn is_printable(letter: char) -> bool {
        let mut bytes = [0; 4];
        !RegExp::new(r"\p{C}|\p{Z}", "u").test(letter.encode_utf8(&mut bytes))
    }
}
